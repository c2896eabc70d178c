//! Arcs and the texts of scripts, as the model reads them.

use crate::path::{Axis, Point};

use super::expected::{Act, Arc, Rate, Want};
use super::geometry::{add, axes, principal, times};
use super::model::{Model, number};
use super::setup::CenterForm;
use super::statement::ArcShape;

impl Model<'_> {
    /// CIRCLE and the GOTO to its end.
    pub(super) fn arc(&mut self, shape: &ArcShape) {
        let Some(at) = self.at else { return self.out.unpredictable = true };
        let start = times(at, 1.0 / self.mm());
        let (center, end) = ends(shape, start);
        self.arc_text(shape, center, end);
        self.doubts(shape);
        let (center, end) = (times(center, self.mm()), times(end, self.mm()));
        let [.., along] = axes(shape.normal);
        let mut normal = [0.0; 3];
        normal[along] = if shape.ccw { 1.0 } else { -1.0 };
        let mirrored = self.frame.mirrors();
        let turned = times(self.frame.direction(normal), if mirrored { -1.0 } else { 1.0 });
        let Some((normal, ccw)) = principal(turned) else {
            // Not in a plane of the machine: it must become lines, which no step of
            // the model describes.
            return self.out.unpredictable = true;
        };
        if self.runs() {
            self.check_start();
        }
        let to = self.frame.apply(end);
        let from = self.frame.apply(at);
        let arc = Arc {
            from,
            to,
            center: self.frame.apply(center),
            normal,
            ccw,
            total: shape.total().to_radians(),
        };
        self.at = Some(end);
        self.is_left = false;
        let (across, along) = self.moves(to);
        self.settle(across, along);
        if self.no_feed() {
            self.must_refuse("a feed motion without a feed");
        }
        if self.is_nearly_a_point(&arc) {
            self.out.unpredictable = true;
        }
        self.push(Act::Arc(arc));
        self.stands(to);
    }

    /// The center counts from where the tape stands. A motion of less than a last digit
    /// may have left no block, so that much it may stand off.
    fn check_start(&mut self) {
        let off = self.off_tape();
        if off > self.last_digit() {
            self.must_refuse("an arc from a point that is not on the tape");
        } else if off > 1e-6 {
            self.may_refuse("an arc from nearly a point on the tape");
        }
    }

    /// The last digit of an axis word, mm.
    fn last_digit(&self) -> f64 {
        let (decimals, _) = self.setup.decimals(self.unit);
        0.1f64.powi(decimals) * self.mm()
    }

    /// True for an arc of so few last digits that a post may write it as lines, which
    /// lie beside it by as much as it is high.
    fn is_nearly_a_point(&self, arc: &Arc) -> bool {
        let away = [0, 1, 2].map(|axis| (arc.from[axis] - arc.center[axis]).powi(2));
        away.iter().sum::<f64>().sqrt() < 40.0 * self.last_digit()
    }

    /// What a post may rightly refuse in an arc.
    fn doubts(&mut self, shape: &ArcShape) {
        let (decimals, _) = self.setup.decimals(self.unit);
        let digit = 10f64.powi(-decimals);
        if shape.radius < 10.0 * digit {
            self.may_refuse("an arc of a few digits");
        }
        let near_half = |angle: f64| (angle - 180.0).abs() < 1.0 || angle > 359.0;
        if self.setup.center == CenterForm::Radius && near_half(shape.sweep) {
            self.may_refuse("an arc of half a turn by its radius");
        }
        if self.cycle.is_some() {
            self.may_refuse("an arc in a cycle");
        }
        if self.thread.is_some() {
            self.must_refuse("an arc in a thread");
        }
        let plane = if self.setup.turns() { Axis::Y } else { Axis::Z };
        if self.compensated() && shape.normal != plane {
            self.may_refuse("an arc in another plane under compensation");
        }
        if self.compensation_waits() || self.compensation_is_fresh {
            self.may_refuse("compensation that begins or ends on an arc");
        }
        if self.tape.is_none() || self.height_unknown {
            self.may_refuse("an arc from a place that is not known");
        }
    }

    fn arc_text(&mut self, shape: &ArcShape, center: Point, end: Point) {
        let [.., along] = axes(shape.normal);
        let mut axis = ["0.", "0.", "0."];
        axis[along] = if shape.ccw { "1." } else { "-1." };
        let [x, y, z] = center.map(number);
        let [i, j, k] = axis;
        let times =
            if shape.times > 0 { format!(", TIMES, {}", shape.times) } else { String::new() };
        let radius = number(shape.radius);
        self.line(&format!("CIRCLE / {x}, {y}, {z}, {i}, {j}, {k}, {radius}{times}"));
        self.goto(end);
    }

    /// A text that goes to the tape as it is: what it does to the machine.
    pub(super) fn text(&mut self, text: &str) {
        if text.starts_with('(') {
            return;
        }
        match text {
            "G4 P1.5" => return self.push(Act::Dwell(1.5 / self.setup.dwell_factor)),
            "M0" => return self.push(Act::Stop),
            "G1 X5. F50." => return self.text_motion(&[(0, 5.0)], Some(50.0), false),
            "G0 Z60." => return self.text_motion(&[(2, 60.0)], None, true),
            "G53 G0 Z0." => {
                self.text_motion(&[(2, 0.0)], None, true);
                // Where that is in the frame of the program nobody knows.
                self.height_unknown = true;
                return;
            }
            _ => {}
        }
        if text.contains("G41") {
            self.may_refuse("a text with compensation");
            self.any_compensation();
        }
        let has = |word: &str| text.split(' ').any(|found| found == word);
        let refused = ["G98", "G99", "G80", "G17", "G18", "G19", "G54"];
        if self.compensated() && refused.into_iter().any(has) {
            // The interpreter refuses these under compensation.
            self.out.unpredictable = true;
        }
        if ["M3", "M4", "M5", "G96", "G97"].into_iter().any(has) || text.starts_with('S') {
            self.any_spindle();
        }
        if ["M7", "M8", "M9"].into_iter().any(has) {
            self.any_coolant();
        }
        if ["G54", "G91", "G90"].into_iter().any(has) {
            self.may_refuse("a text that may move the frame");
        }
        if self.cycle.is_some() {
            self.may_refuse("a text in a cycle");
        }
    }

    /// A text with a motion: the machine goes there, the CL point stays.
    fn text_motion(&mut self, to: &[(usize, f64)], feed: Option<f64>, rapid: bool) {
        self.may_refuse("a text with a motion");
        let Some(mut target) = self.tape else { return self.out.unpredictable = true };
        if self.is_skipped() || self.cycle.is_some() || self.compensated() {
            return self.out.unpredictable = true;
        }
        for (axis, value) in to {
            target[*axis] = value * self.mm();
        }
        let kept = self.feed.clone();
        if let Some(value) = feed {
            // A minute or a revolution: as the blocks before it left it.
            let value = value * self.mm();
            let rates = [false, true].map(|per_revolution| Rate { value, per_revolution });
            self.feed = Want::OneOf(rates.to_vec());
        }
        self.push(if rapid { Act::Rapid(target) } else { Act::Feed(target) });
        self.feed = kept;
        self.tape = Some(target);
    }

    /// POSTN/OUT: letters as numbers, each with its value.
    pub(super) fn postn(&mut self, words: &[(char, f64)]) {
        let item = |(letter, value): &(char, f64)| {
            format!(", {}, {}", u32::from(*letter) - 64, number(*value))
        };
        let items: String = words.iter().map(item).collect();
        self.line(&format!("POSTN / OUT{items}"));
        let axis = |letter: char| "XYZ".find(letter);
        let to: Vec<(usize, f64)> =
            words.iter().filter_map(|(letter, value)| Some((axis(*letter)?, *value))).collect();
        let value_of = |letter| words.iter().find(|word| word.0 == letter).map(|word| word.1);
        if to.is_empty() {
            let text: Vec<String> =
                words.iter().map(|(letter, value)| format!("{letter}{value}")).collect();
            return self.text(&text.join(" "));
        }
        self.text_motion(&to, value_of('F'), value_of('G') == Some(0.0));
    }
}

/// Center and end of an arc that begins at a point.
pub(super) fn ends(shape: &ArcShape, start: Point) -> (Point, Point) {
    let [first, second, along] = axes(shape.normal);
    let place = |angle: f64| {
        let (sine, cosine) = libm::sincos(angle.to_radians());
        let mut offset = [0.0; 3];
        offset[first] = shape.radius * cosine;
        offset[second] = shape.radius * sine;
        offset
    };
    let center = add(start, times(place(shape.start), -1.0));
    let turn = if shape.ccw { shape.sweep } else { -shape.sweep };
    let mut end = if shape.sweep == 360.0 { start } else { add(center, place(shape.start + turn)) };
    end[along] += shape.rise;
    (center, end)
}
