//! Repairs for what a run or a check of its program says: settings that the texts name, statements to put in, words
//! that were meant.

use filpost::commons::EMPTY;
use filpost::locations::Location;
use filpost::{CodeKind, Commons, Diag, Severity, TextSpan};

use crate::navigate::{Edit, Place};
use crate::text::{Position, Range};

/// A repair.
#[derive(Clone, Debug, PartialEq)]
pub struct Repair {
    /// What it does.
    pub title: String,
    /// How.
    pub act: Act,
}

/// How a repair is done.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// A key of `machine.toml` gets a value, as TOML writes it.
    Set {
        /// The dotted key.
        key: String,
        /// Its new value.
        value: String,
    },
    /// The setting is shown: what value it needs the author knows.
    Show(&'static str),
    /// Texts of files change.
    Write(Vec<Edit>),
}

/// Most values of a setting that are offered.
const MOST_CHOICES: usize = 4;

/// Statements that can be put in as hints name them: a word before `/` and the word behind it.
const STATEMENTS: [(&str, &str); 8] = [
    ("RAPID", ""),
    ("UNITS", "MM"),
    ("UNITS", "INCHES"),
    ("CUTCOM", "OFF"),
    ("CYCLE", "OFF"),
    ("CLAMP", "OFF"),
    ("MODE", "MILL"),
    ("MODE", "TURN"),
];

/// Repairs for what a run says. `machine` is the one it ran on, where it could be read; `cl_name` names the CL file.
pub fn of_diag(diag: &Diag, machine: Option<&Commons>, cl_name: &str) -> Vec<Repair> {
    let hint = diag.advice();
    let in_cl = diag.spans.first().filter(|place| place.file == cl_name);
    let mut found = in_cl.map(|place| meant(hint, diag, place)).unwrap_or_default();
    found.extend(in_cl.map(|place| statements(hint, place)).unwrap_or_default());
    found.extend(listed(hint, diag, machine));
    found.extend(values(hint, machine));
    let mut named = settings_in(hint).chain(settings_in(&diag.message)).map(|(row, _)| row);
    found.extend(shown(&mut named, &found));
    if diag.code.kind != CodeKind::Error && diag.severity == Severity::Warning {
        let (key, value) = (format!("levels.{}", diag.code.name()), "\"allow\"".to_string());
        let title = format!("allow {} on this machine", diag.code.name());
        found.push(Repair { title, act: Act::Set { key, value } });
    }
    found
}

/// What a finding of a check is about, and the settings that it depends on; `{}` is the letter of the axis that the
/// finding begins with.
const OF_KINDS: [(&str, &[&str]); 7] = [
    ("limit", &["limits.{}_min", "limits.{}_max", "limits.max_departure"]),
    ("between", &["rotary.tolerance"]),
    ("tool-axis", &["rotary.axis_tolerance"]),
    ("units", &["units.mode"]),
    ("end", &["program.end_code"]),
    ("start-mode", &["program.safe_start"]),
    ("order-of-axes", &["rapid.split"]),
];

/// Repairs for what a check of a program found: the settings of its kind, those that it names, and the work offset that
/// it misses in the CL file.
pub fn of_finding(kind: &str, message: &str) -> Vec<Repair> {
    let letter = message.chars().next().unwrap_or_default().to_ascii_lowercase();
    let is_axis = message.chars().nth(1).is_some_and(|next| next.is_ascii_digit() || next == '-');
    let of_kind = OF_KINDS.iter().filter(|(own, _)| *own == kind).flat_map(|(_, keys)| *keys);
    let known = of_kind
        .filter(|key| key.contains('{') == (is_axis && kind == "limit"))
        .filter_map(|key| Location::named(&key.replace("{}", &letter.to_string())));
    let mut rows = known.chain(settings_in(message).map(|(row, _)| row));
    shown(&mut rows, &[])
}

/// Repairs for a block that a check could not compare: what it does is said by `[effects]`.
pub fn of_open(what: &str) -> Vec<Repair> {
    let Some((_, rest)) = what.split_once('`') else { return Vec::new() };
    let Some((block, rest)) = rest.split_once('`') else { return Vec::new() };
    // What is no block of words `[effects]` can't name.
    if !rest.starts_with(" of an author: the machine has no ") || block.contains(['"', '\\']) {
        return Vec::new();
    }
    let block = without_number(block);
    let (key, value) = (format!("effects.\"{block}\""), "\"nothing\"".to_string());
    vec![Repair {
        title: format!("say that {block} changes nothing"),
        act: Act::Set { key, value },
    }]
}

/// A block without its number: the same block has another one elsewhere.
fn without_number(block: &str) -> &str {
    let rest = block
        .strip_prefix('N')
        .map(|rest| rest.trim_start_matches(|sign: char| sign.is_ascii_digit()));
    rest.and_then(|rest| rest.strip_prefix(' ')).unwrap_or(block)
}

/// `did you mean X?` and `did you mean X or Y?`: the word at the place becomes that.
fn meant(hint: &str, diag: &Diag, place: &TextSpan) -> Vec<Repair> {
    let words = hint.strip_prefix("did you mean ").and_then(|rest| rest.split('?').next());
    let (Some(words), Some(span)) = (words, wrong_word(diag, place)) else { return Vec::new() };
    let range = Range { start: position(place, span.start), end: position(place, span.end) };
    let write = |word: &str| Repair {
        title: format!("write {word}"),
        act: Act::Write(vec![edit(place, range, word.to_string())]),
    };
    words.split(" or ").map(write).collect()
}

/// The word of a place that is wrong: of several the one that the message names.
fn wrong_word(diag: &Diag, place: &TextSpan) -> Option<std::ops::Range<usize>> {
    let is_other = |letter: char| !letter.is_alphanumeric() && letter != '_';
    let text = place.excerpt.get(place.span.clone())?;
    if !text.is_empty() && !text.contains(is_other) {
        return Some(place.span.clone());
    }
    let is_named = |word: &&str| diag.message.split(is_other).any(|own| own == *word);
    let word = text.split(is_other).filter(|word| !word.is_empty()).find(is_named)?;
    // It is the first of its kind: none before it is named.
    let at = place.span.start + text.find(word)?;
    Some(at..at + word.len())
}

/// `put CYCLE / OFF before it`, `Put UNITS / MM or UNITS / INCHES first`: the statements, as lines of their own.
fn statements(hint: &str, place: &TextSpan) -> Vec<Repair> {
    let sentences =
        hint.split(['.', ';', ',']).map(|sentence| sentence.trim().trim_start_matches("or "));
    let asked = sentences.filter_map(|sentence| {
        sentence.strip_prefix("Put ").or_else(|| sentence.strip_prefix("put "))
    });
    let mut found = Vec::new();
    for words in asked {
        let (words, line, place_said) =
            match (words.split_once(" before "), words.strip_suffix(" first")) {
                (Some((words, _)), _) => (words, place.line, format!("before line {}", place.line)),
                (None, Some(words)) => (words, 1, "first".to_string()),
                (None, None) => continue,
            };
        let start = Position { line: line.saturating_sub(1), character: 0 };
        for words in words.split(" or ") {
            let (major, minor) = words.split_once('/').unwrap_or((words, ""));
            let is = |known: &&(&str, &str)| **known == (major.trim(), minor.trim());
            let Some((major, minor)) = STATEMENTS.iter().find(is) else { continue };
            let slash = if minor.is_empty() { "" } else { " / " };
            let statement = format!("{major}{slash}{minor}");
            let title = format!("put {statement} {place_said}");
            let lines = vec![edit(place, Range { start, end: start }, format!("{statement}\n"))];
            found.push(Repair { title, act: Act::Write(lines) });
        }
    }
    found
}

/// `list INDEX and COPY under words.without_effect`, `list it …`: those words on top of the ones that are listed.
fn listed(hint: &str, diag: &Diag, machine: Option<&Commons>) -> Option<Repair> {
    let (before, _) = hint.split_once(" under words.without_effect")?;
    let named = before.rsplit_once("list ")?.1;
    let own = diag.spans.first()?;
    let first = own.excerpt.split(['/', ',', ' ', '$']).find(|word| !word.is_empty());
    let words: Vec<&str> = match named {
        "it" | "the word" => first.into_iter().collect(),
        named => named.split(" and ").collect(),
    };
    let is_major = |word: &&str| {
        word.chars().all(|letter| letter.is_ascii_uppercase() || letter.is_ascii_digit())
    };
    if words.is_empty() || !words.iter().all(|word| is_major(word) && !word.is_empty()) {
        return None;
    }
    let known = machine?.words_without_effect();
    let all = known.iter().map(String::as_str).chain(words.iter().copied());
    let value = format!("[{}]", all.map(|word| format!("{word:?}")).collect::<Vec<_>>().join(", "));
    let title = format!("ignore {} on this machine", words.join(" and "));
    Some(Repair { title, act: Act::Set { key: "words.without_effect".into(), value } })
}

/// Values that a hint names: `set cycle.rapto = 1`; and the choices of a setting that it asks to set.
fn values(hint: &str, machine: Option<&Commons>) -> Vec<Repair> {
    let mut found = Vec::new();
    for (row, end) in settings_in(hint) {
        let now = machine.and_then(|machine| machine.get(row.kind, u32::from(row.number)).ok());
        let (before, rest) = (&hint[..end - row.name.len()], &hint[end..]);
        let mut set = |value: &str, meaning: &str| {
            let meaning = if meaning.is_empty() { String::new() } else { format!(" ({meaning})") };
            let title = format!("set {} = {value}{meaning}", row.name);
            let (key, value) = (row.name.to_string(), value.to_string());
            found.push(Repair { title, act: Act::Set { key, value } });
        };
        let choices = row.choice_list();
        // `a to b = 2` is about a row of settings.
        if let Some(value) = rest.strip_prefix(" = ").filter(|_| !before.ends_with(" to ")) {
            match first_number(value) {
                Some(value) if now != Some(value) => {
                    let meaning = choices.iter().find(|(choice, _)| *choice == value);
                    set(&value.to_string(), meaning.map_or("", |(_, meaning)| meaning));
                }
                None if value.starts_with("\"none\"") && now != Some(EMPTY) => set("\"none\"", ""),
                _ => {}
            }
        } else if names_first_of(rest, &choices) {
            let others = choices.iter().filter(|(value, _)| now != Some(*value) && *value != 0.0);
            others.take(MOST_CHOICES).for_each(|(value, meaning)| set(&value.to_string(), meaning));
        }
    }
    found
}

/// True for `: 1 at feed, 2 …` and ` (1 inch, 2 mm)` behind a setting with choices.
fn names_first_of(rest: &str, choices: &[(f64, &str)]) -> bool {
    let rest = rest.strip_prefix(": ").or_else(|| rest.strip_prefix(" ("));
    rest.and_then(first_number)
        .is_some_and(|number| choices.iter().any(|(value, _)| *value == number))
}

fn first_number(text: &str) -> Option<f64> {
    let end = text.find(|sign: char| !sign.is_ascii_digit() && sign != '-').unwrap_or(text.len());
    text[..end].parse().ok()
}

/// Settings to be looked at, without those that other repairs set.
fn shown(rows: &mut dyn Iterator<Item = &'static Location>, others: &[Repair]) -> Vec<Repair> {
    let mut found: Vec<Repair> = Vec::new();
    for row in rows {
        let is_set = others
            .iter()
            .any(|other| matches!(&other.act, Act::Set { key, .. } if key == row.name));
        let repair = Repair { title: format!("show {}", row.name), act: Act::Show(row.name) };
        if !is_set && !found.contains(&repair) {
            found.push(repair);
        }
    }
    found
}

/// The settings that a text names, each with where its name ends.
fn settings_in(text: &str) -> impl Iterator<Item = (&'static Location, usize)> + '_ {
    let is_part = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '.';
    let mut at = 0;
    std::iter::from_fn(move || {
        while let Some(start) = text[at..].find(is_part).map(|found| at + found) {
            let end = text[start..]
                .find(|letter| !is_part(letter))
                .map_or(text.len(), |found| start + found);
            at = end;
            let name = text[start..end].trim_end_matches('.');
            if let Some(row) = Location::named(name).filter(|_| name.contains('.')) {
                return Some((row, start + name.len()));
            }
        }
        None
    })
}

fn position(place: &TextSpan, byte: usize) -> Position {
    let head = place.excerpt.get(..byte).unwrap_or_default();
    let character = u32::try_from(head.encode_utf16().count()).unwrap_or(u32::MAX);
    Position { line: place.line.saturating_sub(1), character }
}

fn edit(place: &TextSpan, range: Range, text: String) -> Edit {
    Edit { place: Place { file: place.file.to_string(), range }, text }
}
