//! The small reader of blocks that others put on the tape. It is made to say "I can't"
//! rather than guess; then all is unknown.

use fil_diag::Result;
use fil_machine::{Commons, Letter, letters, locations as loc};

use crate::control::Control;
use crate::control_state::{Effect, ForeignBlock, Rotation, Source, TextFrame, modal};
use crate::errors::PostCode;

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
pub fn refuse_other_diameters(control: &Control, block: &ForeignBlock) -> Result<()> {
    let is_lathe = control.commons.read(loc::LATHE_DIAMETER);
    match block.named(&["DIAMOF", "DIAM90", "DIAMCHAN"]).filter(|_| is_lathe) {
        Some(item) => PostCode::Family.err(format!("{item}: the post writes X as a diameter")),
        None => Ok(()),
    }
}

/// A text begins or ends a transformation, or chooses another master spindle.
pub fn transforms(block: &ForeignBlock) -> bool {
    let names = ["TRANSMIT", "TRACYL", "TRAANG", "TRAFOOF", "SETMS", "SPCON", "SPCOF"];
    block.named(&names).is_some()
}

/// Reads a block of others.
pub fn read(text: &str, commons: &Commons) -> ForeignBlock {
    let mut block = ForeignBlock::default();
    let mut text = without_comment(text).trim();
    if let Some(rest) = text.strip_prefix('/') {
        block.skipped = true;
        text = rest.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
    }
    if text.starts_with('%') {
        return block;
    }
    let mut items = items(text);
    if items.first().is_some_and(|item| item.starts_with('N') && is_digits(&item[1..])) {
        items.remove(0);
    }
    if items.first().is_some_and(|item| item == "MCALL") {
        let calls = items.len() > 1;
        block.effects.extend([
            Effect::Forget(modal::CYCLE_CODE.group),
            Effect::OtherCall,
            Effect::set(modal::CYCLE, calls),
        ]);
    } else if let Some(strange) = items.iter().position(|item| !take(item, &mut block, commons)) {
        block.cannot_read(&items[strange]);
        block.words.extend(items[strange..].iter().filter_map(|item| word(item)));
    }
    block.items = items;
    block
}

/// The words of a block as far as they can be read: `M1=3` is M3, SUPA is G53.
pub fn readable_words(block: &ForeignBlock) -> Vec<(Letter, f64)> {
    let words = block.items.iter().filter_map(|item| {
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

/// Nothing is known any more.
pub fn forget(control: &mut Control) {
    control.state.doubt_all(Source::Author);
    control.sinumerik.edge = None;
    control.state.forget(modal::TOOL_OFFSET, Source::Author);
    control.sinumerik.clockwise = None;
}

/// Takes an item up; false for one that can't be read.
fn take(item: &str, block: &mut ForeignBlock, commons: &Commons) -> bool {
    if let Some((name, _)) = item.split_once('(').filter(|(name, _)| !name.contains('=')) {
        return called(name, block);
    }
    if let Some((name, value)) = item.split_once('=') {
        return assigned(name, value, block, commons);
    }
    if HARMLESS.contains(&item) {
        return true;
    }
    if FRAMES.contains(&item) {
        block.effects.push(Effect::DoubtAxes);
        block.frame = match item {
            "SUPA" => TextFrame::OfTheMachine,
            "TRANS" | "ATRANS" => TextFrame::Shifted,
            _ => TextFrame::Turned,
        };
        return true;
    }
    let Some((letter, value)) = word(item) else { return false };
    match letter.byte() {
        b'D' => block.effects.push(Effect::Edge(value)),
        // A call of a subprogram, or a parameter without its value.
        b'L' | b'P' | b'R' => return false,
        b'M' if value == 17.0 => block.effects.push(Effect::set(modal::PROGRAM_END, true)),
        _ => block.words.push((letter, value)),
    }
    true
}

/// A letter with its number.
fn word(item: &str) -> Option<(Letter, f64)> {
    let mut rest = item.chars();
    let letter = rest.next().and_then(Letter::of_character)?;
    let value = rest.as_str().parse::<f64>().ok().filter(|value| value.is_finite())?;
    Some((letter, value))
}

fn called(name: &str, block: &mut ForeignBlock) -> bool {
    if HARMLESS_CALLS.contains(&name) {
        return true;
    }
    let drills = name.strip_prefix("CYCLE").and_then(|number| number.parse::<u32>().ok());
    let turns = FRAMES.contains(&name);
    if turns || drills.is_some_and(|number| (81..90).contains(&number)) {
        block.frame = if turns { TextFrame::Turned } else { TextFrame::Unread };
        block.effects.extend([
            Effect::DoubtAxes,
            Effect::Doubt(letters::F),
            Effect::Doubt(letters::S),
            Effect::Forget(modal::MOTION.group),
        ]);
        return true;
    }
    false
}

/// `X1=10`, `S1=1000`, `M1=3`, `CR=5`, `R5=10`, `T="MILL"`.
fn assigned(name: &str, value: &str, block: &mut ForeignBlock, commons: &Commons) -> bool {
    let number = value.parse::<f64>().ok().filter(|value| value.is_finite());
    let letters_of_name: String = name.chars().take_while(char::is_ascii_alphabetic).collect();
    let index = &name[letters_of_name.len()..];
    if !(index.is_empty() || is_digits(index) || index.starts_with('[')) {
        return false;
    }
    let of_some_spindle =
        matches!(letters_of_name.as_str(), "S" | "M" | "SPOS" | "SPOSA") && !index.is_empty();
    if of_some_spindle && commons.int_opt(loc::SPINDLE_SIDE_NUMBER).is_some() {
        return false;
    }
    let effect = match (letters_of_name.as_str(), number) {
        ("SPOS" | "SPOSA", Some(_)) => {
            let own = commons.int_opt(loc::CONTROL_SPINDLE_INDEX).unwrap_or(1);
            if !index.is_empty() && index != format!("[{own}]") {
                return true;
            }
            Effect::set(modal::SPINDLE, Rotation::Standing)
        }
        ("LIMS", Some(limit)) => Effect::set(modal::SPEED_LIMIT, limit),
        ("CTOL" | "ADIS" | "ADISPOS" | "OVR", Some(_)) => return true,
        ("T", number) => {
            block.words.push((letters::T, number.unwrap_or_default()));
            return true;
        }
        ("D", Some(value)) => Effect::Edge(value),
        // A parameter gets a value, and no mode and no axis is touched.
        ("R", Some(_)) => return is_digits(index),
        ("F" | "FB", _) => Effect::Doubt(letters::F),
        ("S", _) => Effect::Doubt(letters::S),
        ("M", Some(value)) => {
            block.words.push((letters::M, value));
            return true;
        }
        // The value of a calculation is not known here, and neither is where they stand.
        ("X" | "Y" | "Z" | "A" | "B" | "C" | "U" | "V" | "W" | "Q", _)
        | ("CR" | "AR" | "AP" | "RP" | "TURN" | "RND" | "CHF" | "CHR" | "I" | "J" | "K", _)
        | ("I1" | "J1" | "K1" | "FP", _) => {
            block.frame = TextFrame::Unread;
            Effect::DoubtAxes
        }
        _ => return false,
    };
    block.effects.push(effect);
    true
}

/// Another cutting edge, or none: the length of the tool is another one.
pub fn edge(control: &mut Control, value: f64) {
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

/// Learns from words of others which way the spindle turns, by its M functions, and the cutting
/// edge.
pub fn learn_words(control: &mut Control, words: &[(Letter, f64)]) {
    for (letter, value) in words {
        match (*letter, *value as i64) {
            (letters::M, 3) => control.sinumerik.clockwise = Some(true),
            (letters::M, 4) => control.sinumerik.clockwise = Some(false),
            (letters::D, _) => edge(control, *value),
            _ => {}
        }
    }
}

/// The cycle that MCALL calls is another one.
pub fn other_call(control: &mut Control) {
    control.sinumerik.called.clear();
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
