//! Places for labels on a picture, none over another one.

/// Size of letters, and what a label takes of its line above and below where they stand, pixels.
pub(super) const SIZE: f64 = 13.0;
const ABOVE: f64 = 11.0;
const BELOW: f64 = 3.0;

/// Distance of a label from its point, and of a line of labels from the next, pixels.
const ASIDE: f64 = 7.0;
const LINE: f64 = 14.0;

/// Lines above and below a point that are tried.
const LINES: u32 = 6;

/// A box on the picture: left, top, right, bottom, pixels.
pub(super) type Frame = [f64; 4];

/// The labels of a field, and what they must not lie on.
pub(super) struct Labels {
    field: Frame,
    taken: Vec<Frame>,
}

impl Labels {
    /// No label yet in a field.
    pub fn new(field: Frame) -> Self {
        Labels { field, taken: Vec::new() }
    }

    /// Keeps labels off a box.
    pub fn take(&mut self, frame: Frame) {
        self.taken.push(frame);
    }

    /// Takes a box unless something lies there, or it leaves the field.
    pub fn take_free(&mut self, frame: Frame) -> bool {
        let [left, top, right, bottom] = self.field;
        let inside = frame[0] >= left && frame[1] >= top && frame[2] <= right && frame[3] <= bottom;
        let apart = |other: &Frame| {
            frame[2] < other[0] || frame[0] > other[2] || frame[3] < other[1] || frame[1] > other[3]
        };
        let free = inside && self.taken.iter().all(apart);
        if free {
            self.taken.push(frame);
        }
        free
    }

    /// Where the letters of a label beside a point begin; `None` where all is taken.
    pub fn beside(&mut self, text: &str, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let width = width(text, SIZE);
        for line in 0..LINES {
            let away = LINE * f64::from(line);
            for [x, y] in [
                [x + ASIDE, y - 5.0 - away],
                [x + ASIDE, y + 14.0 + away],
                [x - ASIDE - width, y - 5.0 - away],
                [x - ASIDE - width, y + 14.0 + away],
            ] {
                if self.take_free([x, y - ABOVE, x + width, y + BELOW]) {
                    return Some([x, y]);
                }
            }
        }
        None
    }
}

/// Width of a text, with room for the fonts of different systems, pixels.
pub(super) fn width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * size * 0.6
}
