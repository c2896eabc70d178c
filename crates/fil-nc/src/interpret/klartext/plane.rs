//! Tilted planes: `PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY`.

use nalgebra::Point3;

use super::super::Fault;
use super::super::tilt::{X, Y, Z, about};
use super::Klartext;
use super::line::Word;
use crate::errors::NcCode;
use crate::motion::Tilt;

impl Klartext<'_> {
    /// The angles are turns about X, Y and Z of the part, one after the other. STAY leaves
    /// the rotary axes where they stand, TURN and MOVE bring them to the plane.
    pub(super) fn plane(&mut self, words: &[Word]) -> Result<(), Fault> {
        if self.shift != [0.0; 3] {
            let message = "a tilted plane about a shifted datum is not followed";
            return Err(Fault::new(NcCode::ForeignCode, message));
        }
        let mut angles = [None; 3];
        let mut turns = None;
        for word in words {
            let named = ["SPA", "SPB", "SPC"]
                .iter()
                .enumerate()
                .find_map(|(n, name)| Some((n, word.value(name)?)));
            match (named, word.text.as_str()) {
                (Some((n, value)), _) => angles[n] = Some(value?),
                (None, "STAY") => turns = Some(false),
                (None, "TURN" | "MOVE") => turns = Some(true),
                (None, "FMAX" | "SEQ+" | "SEQ-") => {}
                (None, text) if text.starts_with(['F', 'D']) && turns == Some(true) => {}
                _ => return Err(word.no_meaning()),
            }
        }
        let [Some(a), Some(b), Some(c)] = angles else {
            return Err(Fault::new(NcCode::MissingWord, "SPA, SPB and SPC are needed"));
        };
        let turn = about(Z, c) * about(Y, b) * about(X, a);
        self.state.end_tilt();
        self.state.begin_tilt(Tilt { turn, origin: Point3::origin() })?;
        match turns {
            Some(true) => self.state.align(),
            Some(false) => self.state.check_along(),
            None => Err(Fault::new(NcCode::MissingWord, "STAY, TURN or MOVE is needed")),
        }
    }
}

/// PLANE RESET leaves the rotary axes only where it says STAY.
pub(super) fn check_reset(texts: &[&str], words: &[Word]) -> Result<(), Fault> {
    match (texts, words.first()) {
        (["STAY"], _) => Ok(()),
        (_, Some(word)) => Err(Fault::new(
            NcCode::ForeignCode,
            "where the rotary axes go with PLANE RESET is followed for STAY alone",
        )
        .at(&word.range)),
        (_, None) => Err(Fault::new(NcCode::MissingWord, "STAY is needed")),
    }
}

/// Tool-tip control with positions of the rotary axes, and F as the feed of the tip.
pub(super) fn check_tcpm(texts: &[&str]) -> Result<(), Fault> {
    match texts {
        ["F", "TCP", "AXIS", "POS", "PATHCTRL", "AXIS" | "VECTOR"]
        | ["F", "TCP", "AXIS", "POS", "PATHCTRL", "AXIS" | "VECTOR", "REFPNT", "TIP-TIP"] => Ok(()),
        _ => {
            let message = "FUNCTION TCPM is followed with F TCP AXIS POS and its PATHCTRL";
            Err(Fault::new(NcCode::ForeignCode, message))
        }
    }
}
