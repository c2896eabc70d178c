//! Views as SVG.

use std::cell::Cell;
use std::collections::HashSet;
use std::fmt::Write as _;

use fil_machine::Unit;

use super::labels::{Labels, SIZE, width as width_of};
use super::simplify::{Dot, Lines, dot};
use super::view::{Extent, View};
use super::{AXIS_COLOUR, CL_COLOUR, Drawing, Stroke, Trace};

/// Width of a view's field, pixels.
const WIDTH: f64 = 560.0;

/// Height of a view's field, pixels.
const HEIGHT: f64 = 400.0;

/// Room around fields, pixels.
const GAP: f64 = 16.0;

/// Room for the heading and the first line of the legend, and for each further line, pixels.
const HEAD: f64 = 64.0;
const LEGEND_LINE: f64 = 20.0;

/// Size of the letters of the heading, pixels.
const HEADING: f64 = 18.0;

/// Side of a cell that shows one direction of a tilting tool, and the length of that, pixels.
const CELL: f64 = 20.0;
const AXIS: f64 = 16.0;

/// Most tools told at one place, and most tool changes told in a view.
const TOOLS: usize = 8;
const CHANGES: usize = 400;

/// Least size of what is drawn, mm, so that a single point has a scale.
const LEAST: f64 = 1e-3;

/// From the part to a field.
struct Frame {
    view: View,
    /// Pixels of a millimetre.
    scale: f64,
    /// Pixels of the part's origin.
    origin: [f64; 2],
}

impl Frame {
    fn new(view: View, extent: &Extent, corner: [f64; 2]) -> Self {
        let corners = extent.corners().map(|corner| view.project(&corner));
        let side = |axis: usize| {
            let values = corners.iter().map(|corner| corner[axis]);
            let (low, high) = values
                .fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
            (low, high)
        };
        let (x, y) = (side(0), side(1));
        let room = [WIDTH - 9.0 * GAP, HEIGHT - 6.0 * GAP];
        let scale = (room[0] / (x.1 - x.0).max(LEAST)).min(room[1] / (y.1 - y.0).max(LEAST));
        let origin = [
            corner[0] + WIDTH / 2.0 - (x.0 + x.1) / 2.0 * scale,
            corner[1] + HEIGHT / 2.0 + GAP / 2.0 + (y.0 + y.1) / 2.0 * scale,
        ];
        Frame { view, scale, origin }
    }

    fn place(&self, point: &super::Point) -> [f64; 2] {
        let [right, up] = self.view.project(point);
        [self.origin[0] + right * self.scale, self.origin[1] - up * self.scale]
    }
}

/// Draws views of a path, two in a row. What is smaller than a part of a pixel, or
/// lies on what is drawn already, is left out, so that the size of the picture does
/// not grow with the number of motions.
pub fn svg(drawing: &Drawing<'_>, views: &[View]) -> String {
    let columns = views.len().clamp(1, 2);
    let rows = views.len().div_ceil(columns).max(1);
    let width = columns as f64 * (WIDTH + GAP) + GAP;
    let extent = drawing.extent();
    let (legend, lines) = legend(drawing, extent.as_ref(), width - GAP);
    let head = HEAD + (lines - 1.0) * LEGEND_LINE;
    let height = head + rows as f64 * (HEIGHT + GAP);
    // A long name is written smaller.
    let heading = HEADING.min((width - 2.0 * GAP) / width_of(&drawing.title, 1.0)).max(1.0);
    let mut out = String::new();
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <title>{0}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <text x=\"{GAP}\" y=\"26\" font-size=\"{1}\" fill=\"#222222\">{0}</text>\n{legend}",
        escape(&drawing.title),
        (heading * 10.0).floor() / 10.0
    );
    for (index, view) in views.iter().enumerate() {
        let corner = [
            GAP + (index % columns) as f64 * (WIDTH + GAP),
            head + (index / columns) as f64 * (HEIGHT + GAP),
        ];
        field(&mut out, drawing, extent.as_ref(), *view, corner);
    }
    out.push_str("</svg>\n");
    out
}

/// The samples of strokes and the extent, in lines up to a right edge; and the number of lines.
fn legend(drawing: &Drawing<'_>, extent: Option<&Extent>, edge: f64) -> (String, f64) {
    let (mut out, mut x, lines) = (String::new(), GAP, Cell::new(1.0));
    let mut room = |wide: f64| {
        if x > GAP && x + wide > edge {
            x = GAP;
            lines.set(lines.get() + 1.0);
        }
        let at = x;
        x += (wide + 22.0).ceil();
        (at, 50.0 + (lines.get() - 1.0) * LEGEND_LINE)
    };
    let mut sample = |out: &mut String, colour: &str, name: &str, style: &str| {
        let (x, y) = room(32.0 + width_of(name, SIZE));
        let _ = writeln!(
            out,
            "<path d=\"M{x} {}h26\" stroke=\"{colour}\"{style}/>\
             <text x=\"{}\" y=\"{y}\" fill=\"#444444\">{name}</text>",
            y - 4.0,
            x + 32.0
        );
    };
    for stroke in strokes(&drawing.path) {
        sample(&mut out, stroke.colour(), stroke.name(), style(stroke));
    }
    if drawing.under.is_some() {
        sample(&mut out, CL_COLOUR, drawing.under_name, UNDER);
    }
    if !drawing.path.axes.is_empty() {
        sample(&mut out, AXIS_COLOUR, "tool axis", "");
    }
    if let Some(extent) = extent {
        let sides = sides(extent, drawing);
        let (x, y) = room(width_of(&sides, SIZE));
        let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" fill=\"#444444\">{sides}</text>");
    }
    (out, lines.get())
}

/// From where to where a drawing goes, in its unit: X of a turned part as a diameter.
pub(super) fn sides(extent: &Extent, drawing: &Drawing<'_>) -> String {
    let unit = drawing.path.unit();
    let side = |axis: usize, sign: &str, times: f64| {
        let [from, to] = [extent.min, extent.max].map(|end| short(end[axis] * times, unit));
        format!("{sign}{from} to {sign}{to}")
    };
    let z = side(2, "", 1.0);
    if drawing.diameter && extent.min[1] == 0.0 && extent.max[1] == 0.0 {
        return format!("{} · Z {z} {unit}", side(0, "\u{2300}", 2.0));
    }
    format!("X {} · Y {} · Z {z} {unit}", side(0, "", 1.0), side(1, "", 1.0))
}

const UNDER: &str = " stroke-width=\"5\" stroke-opacity=\"0.5\"";

fn style(stroke: Stroke) -> &'static str {
    match stroke {
        Stroke::Rapid => " stroke-dasharray=\"5 3\"",
        Stroke::Thread => " stroke-width=\"2\" stroke-dasharray=\"1 2\"",
        Stroke::Feed | Stroke::Arc => " stroke-width=\"1.4\"",
    }
}

/// The strokes that a trace has.
fn strokes(trace: &Trace) -> impl Iterator<Item = Stroke> {
    let used = Stroke::ALL.map(|stroke| trace.pieces.iter().any(|piece| piece.stroke == stroke));
    Stroke::ALL.into_iter().zip(used).filter_map(|(stroke, used)| used.then_some(stroke))
}

fn field(
    out: &mut String,
    drawing: &Drawing<'_>,
    extent: Option<&Extent>,
    view: View,
    corner: [f64; 2],
) {
    let [x, y] = corner;
    let _ = writeln!(
        out,
        "<g>\n<rect x=\"{x}\" y=\"{y}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"none\" \
         stroke=\"#cccccc\"/><text x=\"{}\" y=\"{}\" fill=\"#666666\">{}</text>",
        x + 8.0,
        y + 20.0,
        view.name()
    );
    if let Some(extent) = extent {
        let frame = Frame::new(view, extent, corner);
        let mut labels = Labels::new([x, y, x + WIDTH, y + HEIGHT]);
        labels.take([x + 8.0, y + 8.0, x + 8.0 + width_of(view.name(), SIZE), y + 24.0]);
        axes(out, view, corner, &mut labels);
        if let Some(under) = &drawing.under {
            let all = collect(under, &frame, |_| true);
            path(out, &all, CL_COLOUR, UNDER);
        }
        for stroke in strokes(&drawing.path) {
            let lines = collect(&drawing.path, &frame, |of| of == stroke);
            path(out, &lines, stroke.colour(), style(stroke));
        }
        tool_axes(out, &drawing.path, &frame);
        changes(out, drawing, &frame, &mut labels);
    }
    out.push_str("</g>\n");
}

fn collect(trace: &Trace, frame: &Frame, wanted: impl Fn(Stroke) -> bool) -> Vec<Vec<Dot>> {
    let mut lines = Lines::default();
    for piece in trace.pieces.iter().filter(|piece| wanted(piece.stroke)) {
        let points = &trace.points[piece.range()];
        lines.add(points.iter().map(|point| dot(frame.place(point))));
    }
    lines.finish();
    lines.lines
}

/// Lines as one path, in steps from point to point.
fn path(out: &mut String, lines: &[Vec<Dot>], colour: &str, style: &str) {
    if lines.is_empty() {
        return;
    }
    let _ = write!(
        out,
        "<path fill=\"none\" stroke=\"{colour}\"{style} stroke-linejoin=\"round\" d=\""
    );
    for line in lines {
        let mut at = line[0];
        let _ = write!(out, "M{} {}", tenths(at[0]), tenths(at[1]));
        for (index, dot) in line[1..].iter().enumerate() {
            out.push_str(if index == 0 { "l" } else { " " });
            let _ = write!(out, "{} {}", tenths(dot[0] - at[0]), tenths(dot[1] - at[1]));
            at = *dot;
        }
    }
    out.push_str("\"/>\n");
}

fn tenths(value: i32) -> String {
    if value % 10 == 0 {
        (value / 10).to_string()
    } else {
        format!("{:.1}", f64::from(value) / 10.0)
    }
}

/// Directions of a tilting tool at the ends of motions, one in each cell of the picture.
fn tool_axes(out: &mut String, trace: &Trace, frame: &Frame) {
    if trace.axes.is_empty() {
        return;
    }
    let mut seen = HashSet::new();
    let mut axes = trace.axes.iter().peekable();
    let mut axis = [0.0, 0.0, 1.0];
    let _ = write!(out, "<path fill=\"none\" stroke=\"{AXIS_COLOUR}\" d=\"");
    for (index, piece) in trace.pieces.iter().enumerate() {
        while let Some((_, next)) = axes.next_if(|(from, _)| *from <= index) {
            axis = *next;
        }
        let place = frame.place(&trace.points[piece.last()]);
        // A tool that does not turn has no direction.
        if axis == [0.0; 3] {
            continue;
        }
        if !seen.insert(place.map(|value| (value / CELL).floor() as i64)) {
            continue;
        }
        let [right, up] = frame.view.project(&axis).map(|part| part * AXIS);
        let [x, y] = dot(place).map(tenths);
        let _ = write!(out, "M{x} {y}l{right:.1} {:.1}", -up);
    }
    out.push_str("\"/>\n");
}

/// Tool changes: a ring and the numbers, once at each place; so many that they can be told apart.
fn changes(out: &mut String, drawing: &Drawing<'_>, frame: &Frame, labels: &mut Labels) {
    let mut places: Vec<(Dot, [f64; 2], Vec<u32>)> = Vec::new();
    for change in &drawing.path.changes {
        let at = frame.place(&change.at);
        let key = dot(at);
        match places.iter().position(|(known, ..)| *known == key) {
            Some(place) if places[place].2.contains(&change.tool) => {}
            Some(place) => places[place].2.push(change.tool),
            None if places.len() < CHANGES => places.push((key, at, vec![change.tool])),
            None => {}
        }
    }
    for (_, [x, y], _) in &places {
        labels.take([x - 4.0, y - 4.0, x + 4.0, y + 4.0]);
        let _ = writeln!(
            out,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"#ffffff\" stroke=\"#222222\"/>"
        );
    }
    for (_, at, tools) in &places {
        let names: Vec<String> = tools.iter().take(TOOLS).map(|tool| format!("T{tool}")).collect();
        let more = if tools.len() > TOOLS { " and more" } else { "" };
        let label = names.join(" ") + more;
        let Some([x, y]) = labels.beside(&label, *at) else { continue };
        let _ = writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"#222222\">{label}</text>");
    }
}

/// Directions of the part's axes, in the corner of the field.
fn axes(out: &mut String, view: View, corner: [f64; 2], labels: &mut Labels) {
    let [x, y] = [corner[0] + 34.0, corner[1] + HEIGHT - 34.0];
    for (axis, name) in ["X", "Y", "Z"].iter().enumerate() {
        let mut unit = [0.0; 3];
        unit[axis] = 26.0;
        let [right, up] = view.project(&unit);
        if libm::hypot(right, up) > 1.0 {
            let [at_x, at_y] = [x + right * 1.25 - 3.0, y - up * 1.25 + 4.0];
            labels.take([at_x.min(x), at_y.min(y) - 10.0, at_x.max(x) + 8.0, at_y.max(y) + 2.0]);
            let _ = writeln!(
                out,
                "<path d=\"M{x} {y}l{right:.1} {:.1}\" stroke=\"#999999\"/>\
                 <text x=\"{at_x:.1}\" y=\"{at_y:.1}\" font-size=\"11\" fill=\"#666666\">{name}</text>",
                -up,
            );
        }
    }
}

/// A length of mm in a unit, with the digits after the point that its programs have.
fn short(length: f64, unit: Unit) -> String {
    let digits = if unit.is_metric() { 1e3 } else { 1e4 };
    ((length / unit.in_mm() * digits).round() / digits + 0.0).to_string()
}

/// Text within SVG and HTML.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            control if control.is_control() => out.push(' '),
            other => out.push(other),
        }
    }
    out
}
