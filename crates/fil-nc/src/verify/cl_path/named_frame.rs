//! Frames that CSYS, MSYS, CATMAT and CATIA's comments name, and what a second one means.

use fil_cl::Record;
use fil_machine::locations::InputCsys;
use nalgebra::{Matrix3x4, Matrix4, Vector3};

use super::State;
use super::frame_words::{Matrix, Mover};
use crate::verify::statements::numbers;

/// Numbers of two frames that differ by less are the same.
const SAME: f64 = 1e-6;

/// The tool lies along the Z of a frame when their unit vectors differ by less.
const ALONG: f64 = 1e-4;

/// What the words have named.
#[derive(Default)]
pub(super) struct NamedFrames {
    /// Word, its first frame, and its frame now; each 4x4.
    of_words: Vec<(String, Matrix4<f64>, Matrix4<f64>)>,
    /// The word whose frame waits for a motion.
    waiting: Option<usize>,
    /// The tool was seen to lie along the Z of a turned frame: the points are the part's.
    in_part: bool,
}

impl NamedFrames {
    /// The word whose frame leaves it open what the points are of, where a motion with this tool
    /// axis is the first behind it.
    pub(super) fn doubt(&mut self, axis: Vector3<f64>) -> Option<String> {
        let (word, first, now) = &self.of_words[self.waiting.take()?];
        let up = Vector3::new(now[(0, 2)], now[(1, 2)], now[(2, 2)]);
        let upright = (up - Vector3::z()).norm() < ALONG;
        let along = (axis / axis.norm() - up).norm() < ALONG;
        if word == "CSYS" && !upright && along {
            self.in_part = true;
        }
        let is_first = near(first, now);
        let is_plain = self.in_part && (along || upright);
        (!is_first && !is_plain).then(|| word.clone())
    }
}

impl State {
    /// Takes the frame of a record that names one.
    pub(super) fn name_frame(&mut self, record: &Record, word: &str) {
        if !matches!(word, "CSYS" | "CATIA0" | "MSYS" | "CATMAT")
            || self.frame.words.is_without_effect(word)
        {
            return;
        }
        let Some(frame) = frame(word, &numbers(record)) else { return };
        let known = self.frame.named.of_words.iter().position(|(known, ..)| known == word);
        let at = known.unwrap_or_else(|| {
            self.frame.named.of_words.push((word.to_string(), frame, frame));
            self.frame.named.of_words.len() - 1
        });
        let (_, first, now) = &mut self.frame.named.of_words[at];
        if known.is_some() && near(now, &frame) {
            return;
        }
        *now = frame;
        if self.frame.words.csys == InputCsys::RefusedIfItChanges {
            self.frame.named.waiting = Some(at);
            return;
        }
        let into_first = first.try_inverse().unwrap_or_else(Matrix4::identity) * frame;
        let rows: Matrix3x4<f64> = into_first.fixed_rows::<3>(0).into_owned();
        let matrix = Matrix { rows, turns_axis: true, of: Mover::Record };
        self.frame.matrix = (!near(first, &frame)).then_some(matrix);
    }
}

/// A frame, 4x4: its axes and its origin as columns.
fn frame(word: &str, values: &[f64]) -> Option<Matrix4<f64>> {
    let mut frame = Matrix4::identity();
    match (word, values.len()) {
        ("CSYS" | "CATIA0", 12) => {
            for (at, value) in values.iter().enumerate() {
                frame[(at / 4, at % 4)] = *value;
            }
        }
        ("MSYS" | "CATMAT", 9 | 12) => {
            // The origin comes first, then the axes.
            for (at, value) in values.iter().take(9).enumerate() {
                frame[(at % 3, [3, 0, 1][at / 3])] = *value;
            }
            let axis = |n: usize| Vector3::new(frame[(0, n)], frame[(1, n)], frame[(2, n)]);
            let z = axis(0).cross(&axis(1));
            frame.fixed_view_mut::<3, 1>(0, 2).copy_from(&z);
        }
        _ => return None,
    }
    Some(frame)
}

fn near(one: &Matrix4<f64>, other: &Matrix4<f64>) -> bool {
    (one - other).amax() < SAME
}
