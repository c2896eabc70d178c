//! What the control learns from the functions and words of a block.

use fil_machine::address::Addresses;
use fil_machine::{FunctionCode, letters};

use super::{Codes, Compensation, ControlState, Distance, Meaning};
use crate::block::Block;

impl ControlState {
    /// Learns from a block of words.
    #[inline]
    pub fn learn_block(&mut self, block: &Block, codes: &Codes, addresses: &Addresses) {
        if !block.g_codes().is_empty() {
            let said_by_others = self.lengths_said;
            for (code, _) in block.g_codes() {
                self.learn_code(*code, codes);
            }
            self.lengths_said = said_by_others;
        }
        for (code, _) in block.m_codes() {
            self.learn_auxiliary(*code, codes);
        }
        if !self.doubts.is_empty() {
            self.trust_words(block, addresses);
        }
        if self.distance != Some(Distance::Absolute) {
            self.doubt_axes();
        }
    }

    /// The control has the words of a block.
    fn trust_words(&mut self, block: &Block, addresses: &Addresses) {
        let letters = block.positions().filter_map(|at| addresses.slot(at).letter);
        letters.for_each(|letter| self.doubts.remove(letter));
    }

    /// Learns what a preparatory function does.
    #[inline]
    pub fn learn_code(&mut self, code: FunctionCode, codes: &Codes) {
        match codes.meaning(code) {
            Meaning::Motion => {
                self.motion = Some(code);
                if codes.motion_ends_cycle() {
                    self.in_cycle = Some(false);
                } else if self.in_cycle == Some(true) && !codes.keeps_cycles() {
                    // Some controls leave the cycle, some don't.
                    self.in_cycle = None;
                }
            }
            Meaning::Plane(plane) => self.plane = Some(plane),
            Meaning::Distance(distance) => self.distance = Some(distance),
            Meaning::Unit(unit) => {
                if self.unit != Some(unit) {
                    self.doubts.add_all();
                }
                self.unit = Some(unit);
            }
            Meaning::FeedMode(mode) => {
                // Some controls forget F even when the mode stays.
                self.doubt(letters::F);
                self.feed_mode = Some(mode);
            }
            Meaning::Compensation(side) => {
                self.compensation_ends = side == Compensation::Off
                    && (self.compensation_ends || self.compensates() && self.compensation_begun);
                self.compensation_said = true;
                self.compensation = Some(side);
                self.compensation_begun = false;
            }
            Meaning::Cycle => {
                self.in_cycle = Some(true);
                self.cycle = Some(code);
                self.motion = None;
            }
            Meaning::CycleOff => {
                self.in_cycle = Some(false);
                self.motion = None;
            }
            Meaning::SurfaceSpeed(on) => {
                self.surface_speed = Some(on);
                self.counted_surface = on;
                if codes.speeds_are_feeds() {
                    self.doubt(letters::F);
                }
                self.feed_mode = codes.feed_behind_speed(code, self.feed_mode);
            }
            Meaning::Diameters => self.x_is_as_written = true,
            Meaning::OneBlock => {}
            Meaning::ReturnLevel => {
                self.return_level = Some(code);
                self.doubt(letters::R);
            }
            Meaning::Turning => {
                self.motion = None;
                self.doubt_axes();
                self.doubt(letters::F);
            }
            Meaning::ToolLength => {
                self.doubt(letters::XYZ[2]);
                self.learn_length(code, codes);
                if self.tip_control != Some(false) {
                    self.tip_control = Some(false);
                    self.doubt_axes();
                }
            }
            Meaning::TipControl => {
                self.tip_control = Some(true);
                self.calls_length(true);
                self.doubt_axes();
            }
            Meaning::Frame => {
                self.doubt_axes();
                if codes.is_fixture(code) {
                    self.fixture = Some(code);
                } else if !codes.keeps_fixture(code) {
                    self.fixture = None;
                }
            }
            Meaning::Tilt => {
                self.tilted = None;
                self.doubt_axes();
            }
            Meaning::Unknown => self.forget(),
        }
    }
}
