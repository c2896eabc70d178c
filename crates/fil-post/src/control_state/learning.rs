//! What the control learns from the functions and words of a block.

use fil_machine::address::Addresses;
use fil_machine::functions::{SpeedMode, WorkPlane};
use fil_machine::{FunctionCode, Letter, letters};

use super::modal::{
    CUTTER_COMP, CUTTER_PATH, CYCLE, CYCLE_CODE, DIAMETER_MODE, DISTANCE, FEED_MODE, LENGTH_WORD,
    MOTION, PLANE, RETURN_LEVEL, SURFACE_SPEED, TCP, UNITS, WORK_OFFSET, WORK_PLANE,
};
use super::{Codes, Compensation, ControlState, CutterPath, Distance, Meaning, Source};
use crate::block::Block;

impl ControlState {
    /// Learns from a block of words.
    #[inline]
    pub fn learn_block(&mut self, block: &Block, codes: &Codes, addresses: &Addresses) {
        if block.has_functions() {
            self.learn_functions_of(block, codes, addresses);
        }
        if !self.doubts.is_empty() {
            self.trust_words(block, addresses);
        }
        if !self.is(DISTANCE, Distance::Absolute) {
            self.doubt_axes();
        }
    }

    fn learn_functions_of(&mut self, block: &Block, codes: &Codes, addresses: &Addresses) {
        for (code, _) in block.g_codes() {
            let word = |letter| block.value(letter, addresses);
            self.learn_code(*code, codes, Source::Post, word);
        }
        for (code, _) in block.m_codes() {
            let word = |letter| block.value(letter, addresses);
            self.learn_auxiliary(*code, codes, Source::Post, word);
        }
    }

    /// The control has the words of a block.
    fn trust_words(&mut self, block: &Block, addresses: &Addresses) {
        let letters = block.positions().filter_map(|at| addresses.slot(at).letter);
        letters.for_each(|letter| self.doubts.remove(letter));
    }

    /// Learns what a preparatory function does; `word` gives the value of a word of its block.
    #[inline]
    pub fn learn_code(
        &mut self,
        code: FunctionCode,
        codes: &Codes,
        source: Source,
        word: impl Fn(Letter) -> Option<f64>,
    ) {
        match codes.meaning(code) {
            Meaning::Motion(_) => {
                self.set(MOTION, code);
                if codes.motion_ends_cycle() {
                    self.set(CYCLE, false);
                } else if self.is(CYCLE, true) && !codes.keeps_cycles() {
                    // Some controls leave the cycle, some don't.
                    self.forget(CYCLE, source);
                }
            }
            Meaning::Plane(plane) => self.set(PLANE, plane),
            Meaning::Distance(distance) => self.set(DISTANCE, distance),
            Meaning::Unit(unit) => {
                if !self.is(UNITS, unit) {
                    self.doubts.add_all();
                }
                self.set(UNITS, unit);
            }
            Meaning::FeedMode(mode) => {
                // Some controls forget F even when the mode stays.
                self.doubt(letters::F);
                self.set(FEED_MODE, mode);
            }
            Meaning::Compensation(side) => {
                let leaves = self.may_be(CUTTER_PATH, CutterPath::Leaving)
                    || self.compensates() && self.is(CUTTER_PATH, CutterPath::Moved);
                let path = match side == Compensation::Off && leaves {
                    true => CutterPath::Leaving,
                    false => CutterPath::Unmoved,
                };
                self.set(CUTTER_PATH, path);
                self.set(CUTTER_COMP, side);
            }
            Meaning::Cycle => {
                self.set(CYCLE, true);
                self.set(CYCLE_CODE, code);
                self.forget(MOTION, source);
            }
            Meaning::CycleEnd => {
                self.set(CYCLE, false);
                self.forget(MOTION, source);
            }
            Meaning::SpeedMode(mode) => {
                self.set(SURFACE_SPEED, mode == SpeedMode::SurfaceSpeed);
                if codes.speeds_are_feeds() {
                    self.doubt(letters::F);
                }
                let mode = codes.feed_behind_speed(code, self.get(FEED_MODE));
                self.groups.set_if_known(FEED_MODE, mode, source);
            }
            Meaning::DiameterMode => self.set(DIAMETER_MODE, true),
            Meaning::ReturnPlane => {
                self.set(RETURN_LEVEL, code);
                self.doubt(letters::R);
            }
            Meaning::TurningCycle => {
                self.forget(MOTION, source);
                self.doubt_axes();
                self.doubt(letters::F);
            }
            Meaning::LengthOffset(does) => {
                self.doubt(letters::XYZ[2]);
                self.learn_length(does, codes);
                if source == Source::Author {
                    self.set(LENGTH_WORD, true);
                }
                if !self.is(TCP, false) {
                    self.set(TCP, false);
                    self.doubt_axes();
                }
            }
            Meaning::Tcpc => {
                self.set(TCP, true);
                self.calls_length(true);
                self.doubt_axes();
            }
            Meaning::Origin(origin) => {
                self.doubt_axes();
                if let Some(offset) = codes.work_offset(code, word) {
                    self.set(WORK_OFFSET, offset);
                } else if !origin.keeps_offset() {
                    self.forget(WORK_OFFSET, source);
                }
            }
            Meaning::WorkPlane(to) => {
                match codes.turned(code, self.get(WORK_PLANE), word) {
                    None | Some(WorkPlane::Tilted) => self.forget(WORK_PLANE, source),
                    Some(_) => self.set(WORK_PLANE, to),
                }
                self.doubt_axes();
            }
            Meaning::Unknown => self.doubt_all(source),
            // It acts in its block alone, or is an M code.
            _ => {}
        }
    }
}
