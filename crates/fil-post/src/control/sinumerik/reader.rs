//! The small reader of blocks that others put on the tape. It is made to say "I can't"
//! rather than guess; then all is unknown.

use fil_diag::Result;
use fil_machine::{Letter, letters, locations as loc};

use crate::cause::Cause;
use crate::control::Control;
use crate::control::family::refuse;
use crate::control_state::{Rotation, Source, TextFrame, TextWords, modal};

/// Statements that change nothing the post counts on: how the path is smoothed and
/// driven, what stands beside the motions.
const HARMLESS: &[&str] = &[
    "SOFT",
    "BRISK",
    "DRIVE",
    "FFWON",
    "FFWOF",
    "COMPON",
    "COMPOF",
    "COMPCURV",
    "COMPCAD",
    "CFC",
    "CFTCP",
    "CFIN",
    "NORM",
    "KONT",
    "KONTC",
    "KONTT",
    "STOPRE",
    "UPATH",
    "SPATH",
    "DIAMON",
    "DIAMOF",
    "WALIMON",
    "WALIMOF",
    "RTLION",
    "RTLIOF",
    "CDON",
    "CDOF",
    "CDOF2",
    "CUT2D",
    "CUT2DF",
    "ORIWKS",
    "ORIMKS",
    "ORIAXES",
    "ORIVECT",
    "DYNNORM",
    "DYNPOS",
    "DYNROUGH",
    "DYNSEMIFIN",
    "DYNFINISH",
];

/// Calls that change nothing the post counts on.
const HARMLESS_CALLS: &[&str] = &["MSG", "WORKPIECE", "CYCLE832", "GROUP_BEGIN", "GROUP_END"];

/// Statements and calls that move the frame of the program or the axes in it.
const FRAMES: &[&str] =
    &["TRANS", "ATRANS", "ROT", "AROT", "SCALE", "ASCALE", "MIRROR", "AMIRROR", "SUPA", "CYCLE800"];

/// Refuses a text that changes what X of a lathe means.
///
/// # Errors
/// It does.
pub fn refuse_other_diameters(control: &Control, text: &str) -> Result<()> {
    let changes = ["DIAMOF", "DIAM90", "DIAMCHAN"];
    let said = items(without_comment(text));
    let is_lathe = control.commons.read(loc::LATHE_DIAMETER);
    match said.iter().find(|item| is_lathe && changes.contains(&item.as_str())) {
        Some(item) => refuse(format!("{item}: the post writes X as a diameter")),
        None => Ok(()),
    }
}

/// A text begins or ends a transformation, or chooses another master spindle.
pub fn transforms(text: &str) -> bool {
    let named = ["TRANSMIT", "TRACYL", "TRAANG", "TRAFOOF", "SETMS", "SPCON", "SPCOF"];
    let said = items(without_comment(text));
    said.iter().any(|item| named.contains(&item.split('(').next().unwrap_or(item)))
}

/// Learns from a block of others.
pub fn learn(control: &mut Control, text: &str) {
    let text = without_comment(text).trim();
    let mut words = TextWords::default();
    let text = match text.strip_prefix('/') {
        Some(rest) => {
            words.skipped = true;
            rest.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start()
        }
        None => text,
    };
    if text.is_empty() || text.starts_with('%') {
        return;
    }
    if words.skipped {
        // What a block does that may be skipped is known in no case that matters.
        control.state.doubt_all(Source::Author);
        return;
    }
    let items = items(text);
    let calls = items.first().is_some_and(|item| item == "MCALL");
    if calls {
        control.state.forget(modal::CYCLE_CODE, Source::Author);
        control.sinumerik.called.clear();
        control.state.set(modal::CYCLE, items.len() > 1);
        return;
    }
    for (number, item) in items.iter().enumerate() {
        let is_number = number == 0 && item.starts_with('N') && is_digits(&item[1..]);
        if !is_number && !take(control, item, &mut words) {
            control.state.doubt_all(Source::Author);
            control.sinumerik.edge = None;
            control.state.forget(modal::TOOL_OFFSET, Source::Author);
            control.sinumerik.clockwise = None;
            return;
        }
    }
    learn_turning(control, words.words.iter().copied());
    control.state.learn_text_words(&words, &control.codes, control.unit);
}

/// The words of a line as far as they can be read, its number left out: `M1=3` is M3, SUPA is G53.
pub fn readable_words(line: &str) -> Vec<(Letter, f64)> {
    let words = items(without_comment(line)).into_iter().filter_map(|item| {
        if item == "SUPA" {
            return Some((letters::G, 53.0));
        }
        let letter = item.chars().next().and_then(Letter::of_character)?;
        let value = item.split_once('=').map_or(&item[1..], |(_, value)| value);
        let inner = |text: &str| {
            let inside = text.split_once('(').map_or(text, |(_, inside)| inside);
            inside.trim_end_matches(')').trim_matches('"').parse::<f64>().ok()
        };
        // A tool has a name.
        let value = inner(value).or((letter == letters::T).then_some(0.0))?;
        value.is_finite().then_some((letter, value))
    });
    words.filter(|(letter, _)| *letter != letters::N).collect()
}

/// Learns from words that were written one after the other (POSTN, PREFUN, AUXFUN).
pub fn learn_words(control: &mut Control, words: &[(Letter, f64, Cause)]) {
    learn_turning(control, words.iter().map(|(letter, value, _)| (*letter, *value)));
    for (_, value, _) in words.iter().filter(|(letter, ..)| *letter == letters::D) {
        edge(control, *value);
    }
}

/// Takes an item up; false for one that can't be read.
fn take(control: &mut Control, item: &str, words: &mut TextWords) -> bool {
    if let Some((name, _)) = item.split_once('(').filter(|(name, _)| !name.contains('=')) {
        return called(control, name, words);
    }
    if let Some((name, value)) = item.split_once('=') {
        return assigned(control, name, value, words);
    }
    if HARMLESS.contains(&item) {
        return true;
    }
    if FRAMES.contains(&item) {
        control.state.doubt_axes();
        words.frame = match item {
            "SUPA" => TextFrame::OfTheMachine,
            "TRANS" | "ATRANS" => TextFrame::Shifted,
            _ => TextFrame::Turned,
        };
        return true;
    }
    let mut rest = item.chars();
    let letter = rest.next().and_then(Letter::of_character);
    let value = rest.as_str().parse::<f64>().ok().filter(|value| value.is_finite());
    let (Some(letter), Some(value)) = (letter, value) else { return false };
    match letter.byte() {
        b'D' => edge(control, value),
        // A call of a subprogram, or a parameter without its value.
        b'L' | b'P' | b'R' => return false,
        b'M' if value == 17.0 => control.state.set(modal::PROGRAM_END, true),
        _ => words.words.push((letter, value)),
    }
    true
}

fn called(control: &mut Control, name: &str, words: &mut TextWords) -> bool {
    if HARMLESS_CALLS.contains(&name) {
        return true;
    }
    let drills = name.strip_prefix("CYCLE").and_then(|number| number.parse::<u32>().ok());
    let turns = FRAMES.contains(&name);
    if turns || drills.is_some_and(|number| (81..90).contains(&number)) {
        words.frame = if turns { TextFrame::Turned } else { TextFrame::Unread };
        control.state.doubt_axes();
        control.state.doubt(letters::F);
        control.state.doubt(letters::S);
        control.state.forget(modal::MOTION, Source::Author);
        return true;
    }
    false
}

/// `X1=10`, `S1=1000`, `M1=3`, `CR=5`, `R5=10`, `T="MILL"`.
fn assigned(control: &mut Control, name: &str, value: &str, words: &mut TextWords) -> bool {
    let number = value.parse::<f64>().ok().filter(|value| value.is_finite());
    let letters_of_name: String = name.chars().take_while(char::is_ascii_alphabetic).collect();
    let index = &name[letters_of_name.len()..];
    if !(index.is_empty() || is_digits(index) || index.starts_with('[')) {
        return false;
    }
    let of_some_spindle =
        matches!(letters_of_name.as_str(), "S" | "M" | "SPOS" | "SPOSA") && !index.is_empty();
    if of_some_spindle && control.commons.int_opt(loc::SPINDLE_SIDE_NUMBER).is_some() {
        return false;
    }
    match (letters_of_name.as_str(), number) {
        ("SPOS" | "SPOSA", Some(_)) => {
            let own = control.commons.int_opt(loc::CONTROL_SPINDLE_INDEX).unwrap_or(1);
            if index.is_empty() || index == format!("[{own}]") {
                control.state.set(modal::SPINDLE, Rotation::Standing);
            }
            true
        }
        ("LIMS", Some(limit)) => {
            control.state.set(modal::SPEED_LIMIT, limit);
            true
        }
        ("CTOL" | "ADIS" | "ADISPOS" | "OVR", Some(_)) => true,
        ("T", number) => {
            words.words.push((letters::T, number.unwrap_or_default()));
            true
        }
        ("D", Some(value)) => {
            edge(control, value);
            true
        }
        // A parameter gets a value, and no mode and no axis is touched.
        ("R", Some(_)) => is_digits(index),
        ("F" | "FB", _) => {
            control.state.doubt(letters::F);
            true
        }
        ("S", _) => {
            control.state.doubt(letters::S);
            true
        }
        ("M", Some(value)) => {
            words.words.push((letters::M, value));
            true
        }
        // The value of a calculation is not known here, and neither is where they stand.
        ("X" | "Y" | "Z" | "A" | "B" | "C" | "U" | "V" | "W" | "Q", _)
        | ("CR" | "AR" | "AP" | "RP" | "TURN" | "RND" | "CHF" | "CHR" | "I" | "J" | "K", _)
        | ("I1" | "J1" | "K1" | "FP", _) => {
            words.frame = TextFrame::Unread;
            control.state.doubt_axes();
            true
        }
        _ => false,
    }
}

/// Another cutting edge, or none: the length of the tool is another one.
fn edge(control: &mut Control, value: f64) {
    let edge = (value.fract() == 0.0 && value >= 0.0).then_some(value as i64);
    control.state.doubt_axes();
    if edge.is_none() || edge != control.sinumerik.edge {
        control.state.tool_length_changes();
        control.state.set(modal::LENGTH_WORD, true);
    }
    control.sinumerik.edge = edge;
    control.state.set_if_known(modal::TOOL_OFFSET, edge, Source::Author);
    control.state.calls_length(edge != Some(0));
}

/// Which way the spindle turns, by its M functions.
fn learn_turning(control: &mut Control, words: impl Iterator<Item = (Letter, f64)>) {
    for (letter, value) in words {
        match (letter, value as i64) {
            (letters::M, 3) => control.sinumerik.clockwise = Some(true),
            (letters::M, 4) => control.sinumerik.clockwise = Some(false),
            _ => {}
        }
    }
}

fn is_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// A block without its comment.
fn without_comment(text: &str) -> &str {
    let mut quoted = false;
    let end = text.find(|c| {
        quoted ^= c == '"';
        c == ';' && !quoted
    });
    &text[..end.unwrap_or(text.len())]
}

/// The items of a block in upper case, without the blanks in calls and around `=`.
/// Blanks part them, and letters that follow a number.
fn items(text: &str) -> Vec<String> {
    let mut items: Vec<String> = Vec::new();
    let (mut item, mut depth, mut quoted) = (String::new(), 0i32, false);
    let joined = text.replace(" =", "=").replace("= ", "=");
    for c in joined.chars() {
        let open = quoted || depth > 0;
        quoted ^= c == '"';
        match c {
            '(' | '[' if !quoted => depth += 1,
            ')' | ']' if !quoted => depth -= 1,
            _ => {}
        }
        let blank = c.is_whitespace();
        if blank && open {
            continue;
        }
        let ends_word = !open && c.is_ascii_alphabetic() && ends_in_number(&item);
        if (blank || ends_word) && !item.is_empty() {
            items.push(std::mem::take(&mut item));
        }
        if !blank {
            item.push(c.to_ascii_uppercase());
        }
    }
    if !item.is_empty() {
        items.push(item);
    }
    items
}

/// True for `X10` and `X1=10`, behind which another word may begin without a blank.
fn ends_in_number(item: &str) -> bool {
    let mut chars = item.chars();
    let one_letter = chars.next().is_some_and(|c| c.is_ascii_alphabetic())
        && chars.next().is_some_and(|c| c.is_ascii_digit() || "+-.=".contains(c));
    one_letter && item.ends_with(|c: char| c.is_ascii_digit() || c == '.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_parted_by_blanks_and_packed() {
        assert_eq!(items("n10 G1X10 Y-2.5 CR=5"), ["N10", "G1", "X10", "Y-2.5", "CR=5"]);
        assert_eq!(items("MCALL CYCLE81(5, 0, 1)"), ["MCALL", "CYCLE81(5,0,1)"]);
        assert_eq!(items("T=\"A B\" M6"), ["T=\"AB\"", "M6"]);
        assert_eq!(items("X1 = 10 S2=500"), ["X1=10", "S2=500"]);
    }

    #[test]
    fn a_comment_begins_outside_of_texts() {
        assert_eq!(without_comment("MSG(\"A;B\") ; C"), "MSG(\"A;B\") ");
    }
}
