//! A block of words as a line: `L X+10 Y+5 R0 F200 M8`, `C X+1 Y+2 DR+`, `M5 M9`.

use fil_diag::Result;
use fil_machine::letters::{F, IJK};

use super::line::{self, Line};
use super::reader;
use crate::block::Block;
use crate::control::{Control, vectors};
use crate::control_state::{Compensation, CutterPath, modal};
use crate::errors::PostCode;
use crate::noted::TEXT;

/// How a line begins.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Head {
    /// With its functions: `M5 M9`.
    #[default]
    Functions,
    /// `L`.
    Line,
    /// `C`, and `DR+` for counterclockwise behind its end.
    Arc {
        /// Counterclockwise.
        ccw: bool,
    },
    /// `CP`, the angle and the rise of a helix, and its sense.
    Helix {
        /// Degrees, counterclockwise above zero.
        degrees: f64,
        /// Along Z, scaled as its address writes it.
        rise: i64,
    },
}

/// Decimals of a polar angle.
const ANGLE: usize = 4;

/// What the line under construction says besides words.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phrase {
    /// How it begins.
    pub head: Head,
    /// FMAX: for this line only.
    pub rapid: bool,
    /// R0, RL or RR.
    pub side: Option<Compensation>,
    /// M99: the cycle is called where the line ends.
    pub calls_cycle: bool,
}

/// Names of the parts of the tool's direction.
const VECTOR: [&str; 3] = ["TX", "TY", "TZ"];

/// Letters whose words a line may hold: axes and the feed.
const WORDS: &[u8] = b"ABCFUVWXYZ";

/// Writes the block under construction as a line; the control learns from it.
///
/// # Errors
/// A word or function that Klartext does not have.
pub fn write(control: &mut Control) -> Result<()> {
    let phrase = std::mem::take(&mut control.klartext.phrase);
    let block = control.block.take();
    if let Some((code, _)) = block.g_codes().first() {
        return PostCode::Family.err(format!("G{}: Klartext has no G functions", code.value()));
    }
    block.check_functions(&control.tables.addresses)?;
    let cause = block.cause;
    let mut line = Line::default();
    match phrase.head {
        Head::Functions => {}
        Head::Line if leans(control, &block) => line.item(TEXT, "LN", cause),
        Head::Line => line.item(TEXT, "L", cause),
        Head::Arc { .. } => line.item(TEXT, "C", cause),
        Head::Helix { degrees, rise } => {
            line.item(TEXT, "CP", cause);
            line.item(TEXT, &format!("IPA{}", angle(degrees)), cause);
            let z = control.tables.axis(2).letter;
            let rise = line::scaled_text(control, z, rise).unwrap_or_default();
            line.item(z.byte(), &format!("I{z}{rise}"), cause);
        }
    }
    let mut feed = None;
    for position in block.positions() {
        let slot = *control.tables.addresses.slot(position);
        let (Some(letter), Some(scaled)) = (slot.letter, block.scaled_at(position)) else {
            continue;
        };
        let vector =
            IJK.contains(&letter) && phrase.head == Head::Line && vectors::are_in_force(control);
        if !(vector || WORDS.contains(&letter.byte())) {
            return PostCode::Family.err(format!("{letter}: a line of Klartext has no such word"));
        }
        let value = line::scaled_text(control, letter, scaled).unwrap_or_default();
        let word = match IJK.iter().position(|own| vector && *own == letter) {
            Some(part) => format!("{}{value}", VECTOR[part]),
            None => format!("{}{value}", char::from(slot.character)),
        };
        let word_cause = block.cause_at(position);
        control.commons.set_last_output(letter, slot.format.unscale(scaled));
        if letter == F {
            feed = Some((word, word_cause));
        } else {
            line.item(letter.byte(), &word, word_cause);
        }
    }
    let ccw = match phrase.head {
        Head::Arc { ccw } => Some(ccw),
        Head::Helix { degrees, .. } => Some(degrees > 0.0),
        Head::Functions | Head::Line => None,
    };
    if let Some(ccw) = ccw {
        line.item(TEXT, if ccw { "DR+" } else { "DR-" }, cause);
    }
    if let Some(side) = phrase.side {
        line.item(TEXT, side_text(side), cause);
    }
    if phrase.rapid {
        line.item(TEXT, "FMAX", cause);
    } else if let Some((word, cause)) = feed {
        line.item(F.byte(), &word, cause);
    }
    for (code, cause) in block.m_codes() {
        line.item(b'M', &format!("M{}", code.value()), *cause);
    }
    if phrase.calls_cycle {
        line.item(TEXT, "M99", cause);
    }
    line::put(control, &line)?;
    let addresses = &control.tables.addresses;
    control.state.learn_block(&block, &control.codes, addresses);
    for (code, _) in block.m_codes() {
        reader::learn_turning(control, code.value());
    }
    if let Some(side) = phrase.side {
        control.state.set(modal::CUTTER_COMP, side);
        control.state.set(modal::CUTTER_PATH, CutterPath::Unmoved);
    }
    Ok(())
}

/// The line says the direction of the tool.
fn leans(control: &Control, block: &Block) -> bool {
    let addresses = &control.tables.addresses;
    vectors::are_in_force(control) && IJK.into_iter().any(|letter| block.has(letter, addresses))
}

/// `+360`, `-90.25`.
fn angle(degrees: f64) -> String {
    let text = format!("{degrees:+.ANGLE$}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

fn side_text(side: Compensation) -> &'static str {
    match side {
        Compensation::Off => "R0",
        Compensation::Left => "RL",
        Compensation::Right => "RR",
    }
}
