//! Lines on paper: what the eye can't tell apart is drawn once.

use std::collections::HashSet;
use std::f64::consts::PI;

/// Steps of a pixel in which places are kept.
const STEPS: f64 = 10.0;

/// A dot that leaves the straight line by less than this is not drawn, in steps.
const FLAT: f64 = 2.5;

/// A place on paper in steps of a tenth of a pixel.
pub(super) type Dot = [i32; 2];

/// Collects lines of one colour.
#[derive(Default)]
pub(super) struct Lines {
    /// The lines that are drawn.
    pub(super) lines: Vec<Vec<Dot>>,
    line: Vec<Dot>,
    /// The stretch after the last dot of the line, as far as it is straight.
    straight: Option<Straight>,
    drawn: HashSet<(Dot, Dot)>,
}

/// A straight stretch: all its dots lie within the sleeve around it.
#[derive(Clone, Copy)]
struct Straight {
    end: Dot,
    /// Greatest distance from its beginning.
    reach: f64,
    /// Middle and half width of the directions that pass all its dots, radians; `None`
    /// while all lie at its beginning.
    cone: Option<(f64, f64)>,
}

/// A place in pixels as a dot.
pub(super) fn dot(place: [f64; 2]) -> Dot {
    place.map(|value| (value * STEPS).round() as i32)
}

impl Lines {
    /// Adds a line; one that goes on where the last one ended is part of it.
    pub(super) fn add(&mut self, dots: impl IntoIterator<Item = Dot>) {
        let mut dots = dots.into_iter();
        let Some(first) = dots.next() else { return };
        let end = self.straight.map(|straight| straight.end).or(self.line.last().copied());
        if end != Some(first) {
            self.finish();
            self.line.push(first);
        }
        dots.for_each(|dot| self.extend(dot));
    }

    /// Ends the line that is being drawn.
    pub(super) fn finish(&mut self) {
        self.keep();
        let line = std::mem::take(&mut self.line);
        if line.len() > 1 {
            self.lines.push(line);
        }
    }

    fn extend(&mut self, dot: Dot) {
        let Some(from) = self.line.last().copied() else { return };
        let longer = match self.straight {
            None => Straight::new(from, dot),
            Some(straight) => straight.longer(from, dot),
        };
        if longer.is_none() {
            self.keep();
            let from = self.line.last().copied().unwrap_or(dot);
            self.straight = Straight::new(from, dot);
        } else {
            self.straight = longer;
        }
    }

    /// Draws the straight stretch; one that is on paper already is jumped over.
    fn keep(&mut self) {
        let (Some(straight), Some(from)) = (self.straight.take(), self.line.last().copied()) else {
            return;
        };
        let dot = straight.end;
        if from == dot {
            return;
        }
        let stretch = if from < dot { (from, dot) } else { (dot, from) };
        if self.drawn.insert(stretch) {
            self.line.push(dot);
            return;
        }
        let line = std::mem::replace(&mut self.line, vec![dot]);
        if line.len() > 1 {
            self.lines.push(line);
        }
    }
}

impl Straight {
    fn new(from: Dot, end: Dot) -> Option<Self> {
        Straight { end: from, reach: 0.0, cone: None }.longer(from, end)
    }

    /// The stretch up to a further dot; `None` when it would not be straight.
    fn longer(self, from: Dot, end: Dot) -> Option<Self> {
        let arm = [0, 1].map(|axis| f64::from(end[axis]) - f64::from(from[axis]));
        let distance = libm::hypot(arm[0], arm[1]);
        if distance < self.reach - FLAT {
            return None;
        }
        let reach = self.reach.max(distance);
        if distance <= FLAT {
            return Some(Straight { end, reach, ..self });
        }
        let (towards, width) = (libm::atan2(arm[1], arm[0]), libm::asin(FLAT / distance));
        let cone = match self.cone {
            None => (towards, width),
            Some((middle, half)) => {
                let off = (towards - middle + PI).rem_euclid(2.0 * PI) - PI;
                if off.abs() > half {
                    return None;
                }
                let (low, high) = ((-half).max(off - width), half.min(off + width));
                (middle + (low + high) / 2.0, (high - low) / 2.0)
            }
        };
        Some(Straight { end, reach, cone: Some(cone) })
    }
}
