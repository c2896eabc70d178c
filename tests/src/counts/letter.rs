//! One character of a statement changed, and why such a change need not be noticed.

use super::excuse::{Excuse, Setting};
use super::statement::{Change, Statement, statements};

/// The axis of an arc may be longer or shorter than 1 by this.
const AXIS_LENGTH: f64 = 0.001 + 1e-9;

/// An arc that leaves the plane of the machine by this is in it, mm or inch: a last digit,
/// with what a difference of numbers leaves.
const IN_PLANE: f64 = 0.001 + 1e-9;

/// A statement with one character changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Mutant {
    /// Where the character stands in the statement, in bytes.
    pub at: usize,
    /// Length of what stands there now, in bytes: 0 where it was left out.
    pub length: usize,
    /// The character as it was.
    pub was: char,
    /// The statement with the change.
    pub text: String,
}

/// Each character of a statement left out, and each made another.
pub fn mutants(text: &str) -> Vec<Mutant> {
    let mut all = Vec::new();
    for (at, was) in text.char_indices().filter(|(_, character)| *character != '\n') {
        for new in [None, Some(another(was))] {
            let mut changed = text.to_string();
            let new = new.map_or(String::new(), String::from);
            changed.replace_range(at..at + was.len_utf8(), &new);
            all.push(Mutant { at, length: new.len(), was, text: changed });
        }
    }
    all
}

fn another(character: char) -> char {
    match character {
        '9' => '0',
        'Z' => 'A',
        'z' => 'a',
        '0'..='8' | 'A'..='Y' | 'a'..='y' => char::from(character as u8 + 1),
        ' ' | '/' => ',',
        ',' => '.',
        '.' => ',',
        '-' => '+',
        '+' => '-',
        '$' => ' ',
        _ => '?',
    }
}

/// Why a change need not be noticed; `None` when it must.
pub fn excuse(setting: &Setting<'_>, mutant: &Mutant) -> Option<&'static str> {
    let statement = &setting.all[setting.at];
    if is_comment(&statement.text, mutant.at) {
        return Some("in a comment");
    }
    if statement.in_comment && !matches!(&statement.major[..], "" | "CUTTER") {
        return Some("what Creo says in comments, of which only CUTTER is read");
    }
    if statement.is_text() {
        return of_text(setting, mutant);
    }
    if compact(&statement.text) == compact(&mutant.text) {
        return Some("a blank between items");
    }
    if let Some(reason) = of_form(setting, mutant) {
        return Some(reason);
    }
    let index = item_at(statement, mutant.at)?;
    if let Some(reason) = of_number(statement, index, mutant) {
        return Some(reason);
    }
    setting.excuse(index, Change::Other).map(said)
}

/// What is no item: the words, the slash and the commas.
fn of_form(setting: &Setting<'_>, mutant: &Mutant) -> Option<&'static str> {
    let statement = &setting.all[setting.at];
    let changed = statements(&mutant.text);
    let [changed] = &changed[..] else { return None };
    if (&statement.major[..], &changed.major[..]) == ("UNITS", "UNIT") {
        return Some("UNIT of SolidWorks CAM is UNITS");
    }
    if statement.items.is_empty() && mutant.was == '/' && mutant.length == 0 {
        return Some("a slash that nothing follows");
    }
    if item_at(statement, mutant.at).is_some() || !mean_nothing(setting) {
        return None;
    }
    let is_in_the_list = statement.items.first().is_some_and(|first| first.start <= mutant.at);
    match statement.major == "CUTTER" && statement.in_comment {
        _ if is_in_the_list => Some("a comma between items that mean nothing"),
        _ if mutant.was == '/' => Some("the slash of a record that means nothing"),
        true => Some("the form of a comment of Creo whose items mean nothing"),
        false => None,
    }
}

/// True when no item of the statement changes the program, whatever it is.
fn mean_nothing(setting: &Setting<'_>) -> bool {
    let statement = &setting.all[setting.at];
    let mut items = (0..statement.items.len()).filter(|index| !statement.item(*index).is_empty());
    let end = setting.excuse(statement.items.len(), Change::Banana);
    end.is_some() || items.all(|index| setting.excuse(index, Change::Other).is_some())
}

fn said(excuse: Excuse) -> &'static str {
    match excuse {
        Excuse::Row(row) => row.reason,
        Excuse::Other(reason) => reason,
    }
}

/// True behind the `$$` that begins a comment, in the line of the character.
fn is_comment(text: &str, at: usize) -> bool {
    let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let line = &text[start..];
    let sign = line.find("$$").filter(|sign| !line[*sign..].starts_with("$$->"));
    sign.is_some_and(|sign| at >= start + sign + 2)
}

/// The text without blanks and line ends.
fn compact(text: &str) -> String {
    text.chars().filter(|character| !character.is_whitespace()).collect()
}

fn item_at(statement: &Statement, at: usize) -> Option<usize> {
    statement.items.iter().position(|range| range.contains(&at))
}

/// A free text: blanks before and behind it, and a text that the table lists.
fn of_text(setting: &Setting<'_>, mutant: &Mutant) -> Option<&'static str> {
    let statement = &setting.all[setting.at];
    let Some(range) = statement.items.first().filter(|range| range.start <= mutant.at) else {
        return match (mutant.was, mutant.length) {
            ('/', 0) => Some("a text needs no slash before it"),
            (' ', _) if compact(&statement.text) == compact(&mutant.text) => {
                Some("a blank before the slash")
            }
            _ => None,
        };
    };
    if statement.text[range.clone()].trim() == mutant.text[range.start..].trim() {
        return Some("a blank before or behind the text");
    }
    setting.excuse(0, Change::Other).map(said)
}

/// A number or a word that means the same, or a number that is another by less than the
/// program can say.
fn of_number(statement: &Statement, index: usize, mutant: &Mutant) -> Option<&'static str> {
    let range = statement.items[index].clone();
    let end = range.end + mutant.length - mutant.was.len_utf8();
    let new = mutant.text.get(range.start..end)?.replace("$\n", "");
    let old = statement.item(index);
    if statement.major == "CYCLE" && (&old[..], new.trim()) == ("DEEP2", "DEEP") {
        return Some("DEEP2 is DEEP");
    }
    let (old, new): (f64, f64) = (old.parse().ok()?, new.trim().parse().ok()?);
    let change = (new - old).abs();
    let before = statement.word_before(index);
    if change == 0.0 {
        return Some("the same number");
    }
    if statement.major == "CIRCLE" && (3..6).contains(&index) {
        if old.abs() == 1.0 && change <= AXIS_LENGTH {
            return Some("an axis of nearly that length");
        }
        let radius: f64 = statement.items.get(6).map(|_| statement.item(6))?.parse().ok()?;
        return (change * radius <= IN_PLANE).then_some("an arc that near to the plane is in it");
    }
    match before.as_deref() {
        Some("RETURN" | "RTRCTO") if new < old => {
            Some("a level to return to below the one that the tool comes from")
        }
        _ => (change < resolution(&statement.major, before.as_deref()))
            .then_some("less than the program can say"),
    }
}

/// Changes that are smaller may be lost: half of the last digit of a coordinate, a feed or
/// a speed as the ready posts write it, and twice that for a number that is rounded on
/// both sides.
fn resolution(major: &str, before: Option<&str>) -> f64 {
    match (major, before) {
        ("SPINDL", _) => 1.0,
        ("FEDRAT", _) | ("CYCLE", Some("MMPM")) => 0.01,
        _ => 0.001,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::statement::statements;

    fn excused(cl: &str, at: usize, find: impl Fn(&Mutant) -> bool) -> Option<&'static str> {
        let commons = filpost::locations::default_commons();
        let all = statements(cl);
        let setting = Setting { all: &all, at, commons: &commons, inert: false };
        let mutant = mutants(&all[at].text).into_iter().find(find).expect("such a change");
        excuse(&setting, &mutant)
    }

    #[test]
    fn each_character_is_left_out_and_made_another() {
        let texts: Vec<String> = mutants("A, 9").into_iter().map(|one| one.text).collect();
        assert_eq!(texts, [", 9", "B, 9", "A 9", "A. 9", "A,9", "A,,9", "A, ", "A, 0"]);
    }

    #[test]
    fn other_forms_of_the_same_are_excused_and_no_more() {
        let cl = "UNITS / MM\nCYCLE / DEEP2, DEPTH, 9.5, MMPM, 80.0005, RETURN, 25\n\
                  CIRCLE / 0, 0, 0, 0.000, 0, 1, 1\nCUTTER / 5., 0,\nPPRINT / A\n\
                  $$-> CUTTER / 5.\nRAPID /\n";
        let dropped = |at| move |one: &Mutant| one.at == at && one.length == 0;
        let other = |at| move |one: &Mutant| one.at == at && one.length == 1;
        assert!(excused(cl, 0, dropped(4)).is_some() && excused(cl, 0, dropped(3)).is_none());
        assert_eq!(excused(cl, 1, dropped(12)), Some("DEEP2 is DEEP"));
        assert_eq!(excused(cl, 1, other(12)), None, "DEEP3");
        assert!(excused(cl, 1, other(39)).is_some() && excused(cl, 1, other(36)).is_none());
        assert!(excused(cl, 1, dropped(51)).is_some() && excused(cl, 1, other(51)).is_none());
        assert!(excused(cl, 2, other(22)).is_some() && excused(cl, 2, other(21)).is_none());
        assert!(excused(cl, 3, dropped(11)).is_some() && excused(cl, 3, dropped(14)).is_some());
        assert!(excused(cl, 3, dropped(3)).is_none(), "the major word");
        assert!(excused(cl, 4, dropped(7)).is_some() && excused(cl, 4, dropped(3)).is_none());
        assert!(excused(cl, 5, dropped(7)).is_some() && excused(cl, 6, dropped(6)).is_some());
    }

    #[test]
    fn only_what_means_nothing_is_excused() {
        let cl =
            "GOTO / 1.00041, 2., 3. $$ NOTE\n$$ NOTE\nPAINT / COLOR, 5\nGOTO / 1, 2, 3\nFINI\n";
        let goto = |at| move |one: &Mutant| one.at == at && one.length == 1;
        assert_eq!(excused(cl, 0, goto(12)), Some("less than the program can say"));
        assert_eq!(excused(cl, 0, goto(10)), None, "the digit before");
        assert_eq!(excused(cl, 0, goto(0)), None);
        assert_eq!(excused(cl, 0, goto(14)), None, "a comma");
        assert_eq!(
            excused(cl, 0, |one| one.at == 15 && one.length == 0),
            Some("a blank between items")
        );
        assert_eq!(excused(cl, 0, goto(28)), Some("in a comment"));
        assert_eq!(excused(cl, 1, goto(1)), None, "the sign of a comment");
        assert_eq!(excused(cl, 1, goto(4)), Some("in a comment"));
        assert!(excused(cl, 2, goto(9)).is_some() && excused(cl, 2, goto(13)).is_some());
        assert_eq!(excused(cl, 2, goto(1)), None, "the major word");
    }
}
