//! REPEAT: words that each motion block carries.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::letters::XYZ;
use fil_machine::{FunctionCode, Letter, letters};

use crate::cause::Cause;
use crate::control::Control;
use crate::control_state::{Meaning, TOOL_CHANGE, modal};
use crate::errors::PostCode;

/// Sets the words, or ends all of them. What they left on the tape is not where the
/// post believes the axes and the feed to be, so the next motion says these again.
///
/// # Errors
/// A letter the machine does not write, or a function that changes a mode.
pub fn set(control: &mut Control, words: Vec<(Letter, f64, Cause)>) -> Result<()> {
    if words.is_empty() {
        warn_of_what_stays(control);
        control.repeat.ended.extend(std::mem::take(&mut control.repeat.words).into_keys());
        return Ok(());
    }
    for (letter, value, cause) in words {
        control.require_letter(letter)?;
        refuse_center(letter)?;
        refuse_rotary(control, letter)?;
        refuse_mode(control, letter, value)?;
        control.repeat.ended.retain(|ended| *ended != letter);
        control.repeat.words.insert(letter, (value, cause));
    }
    Ok(())
}

/// Letters that change nothing about a motion; F means something else in a cycle.
const BESIDE_MOTION: &[u8] = b"DEFHMNOST";

/// Letters whose word stays in force when REPEAT ends, until the program says another.
const STAYING: &[u8] = b"DHMST";

/// REPEAT/OFF ends the repetition, not what the last words said.
fn warn_of_what_stays(control: &mut Control) {
    let staying: Vec<String> = control
        .repeat
        .words
        .iter()
        .filter(|(letter, _)| STAYING.contains(&letter.byte()))
        .map(|(letter, (value, _))| format!("{letter}{value}"))
        .collect();
    if !staying.is_empty() {
        let message = format!("REPEAT/OFF: {} stays in force", staying.join(" "));
        control.warnings.add(PostCode::IgnoredPart, message);
    }
}

/// Letters of an arc: on a line they are an alarm, or a chamfer.
const OF_AN_ARC: &[u8] = b"IJKR";

/// Refuses a rotary axis: each motion would turn the machine away from the tool axis of its
/// point, at a feed for another way.
fn refuse_rotary(control: &Control, letter: Letter) -> Result<()> {
    let mut rotary = AxisSet::ROTARY.and(control.tables.present()).numbers();
    if !rotary.any(|number| control.tables.axis(number).letter == letter) {
        return Ok(());
    }
    PostCode::WordForm
        .err(format!("REPEAT: {letter} is a rotary axis, whose position comes from the points"))
}

/// Refuses center and radius of an arc.
fn refuse_center(letter: Letter) -> Result<()> {
    if OF_AN_ARC.contains(&letter.byte()) {
        return PostCode::WordForm
            .err(format!("REPEAT: {letter} in each motion would bend lines and arcs"));
    }
    Ok(())
}

/// Refuses a word that would bend an arc or drill another hole.
fn refuse_in_arc_or_cycle(control: &Control, letter: Letter) -> Result<()> {
    let in_cycle = !control.state.is(modal::CYCLE, false)
        || control.block.g_codes().iter().any(|(code, _)| control.meaning(*code) == Meaning::Cycle);
    let arc = OF_AN_ARC.iter().any(|center| control.block_has(Letter::of(*center)));
    let beside = BESIDE_MOTION.contains(&letter.byte()) && !(in_cycle && letter == letters::F);
    if (in_cycle || arc) && !beside {
        let what = if in_cycle { "a cycle" } else { "an arc" };
        return PostCode::WordForm.err(format!("REPEAT: {letter} means something else in {what}"));
    }
    Ok(())
}

/// Refuses a function that changes a mode or the tool: the post would count on the old
/// one.
fn refuse_mode(control: &Control, letter: Letter, value: f64) -> Result<()> {
    let function = FunctionCode::of_value(value);
    if letter == letters::M && function == Some(TOOL_CHANGE) {
        return PostCode::WordForm.err("REPEAT: M6 in each motion would change the tool");
    }
    let is_of_block = function.is_some_and(|code| {
        matches!(control.meaning(code), Meaning::OneBlock | Meaning::Dwell | Meaning::SpeedLimit)
    });
    if letter == letters::G && !is_of_block {
        return PostCode::WordForm
            .err(format!("REPEAT: G{value} in each motion would change a mode"));
    }
    Ok(())
}

/// Puts what a REPEAT that is over left on the tape in doubt.
#[cold]
pub fn doubt_ended(control: &mut Control) {
    for letter in std::mem::take(&mut control.repeat.ended) {
        let said = control.repeat.written.iter().find(|(repeated, _)| *repeated == letter);
        match said.copied() {
            Some((_, value)) if XYZ.contains(&letter) => control.state.stand(letter, value),
            _ => control.state.doubt(letter),
        }
    }
    control.repeat.written.clear();
}

/// Writes the block under construction with the words of REPEAT whose letters it
/// does not have. The last output values stay those of the motion.
///
/// # Errors
/// As [`Control::write_block`].
pub fn write_with_repeats(control: &mut Control) -> Result<()> {
    let mut kept = Vec::new();
    control.repeat.written.clear();
    for (letter, (value, cause)) in control.repeat.words.clone() {
        if !control.block_has(letter) {
            refuse_in_arc_or_cycle(control, letter)?;
            kept.push((letter, control.commons.last_output(letter)));
            control.repeat.written.push((letter, value));
            control.because(cause, |control| control.word(letter, value))?;
        }
    }
    control.write_block()?;
    for (letter, value) in kept {
        control.commons.set_last_output(letter, value);
    }
    Ok(())
}
