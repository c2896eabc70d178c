//! Breakpoints of all kinds, and whether they stop a run here.

use std::path::{Path, PathBuf};

use filpost::Kind;
use filpost::debug::{DebugState, Held, evaluate, shown};
use filpost::locations::Location;
use serde_json::{Value, json};

/// What a breakpoint asks for besides its place.
#[derive(Clone, Debug, Default)]
pub struct When {
    condition: Option<String>,
    hit: Option<Hit>,
    log: Option<String>,
    hits: u64,
}

/// A count of hits: `5` and `>= 5`, `> 5`, `== 5`, `% 5`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hit {
    AtLeast(u64),
    More(u64),
    Exactly(u64),
    Each(u64),
}

/// A breakpoint.
#[derive(Clone, Debug)]
pub struct Breakpoint {
    /// Its number for the client.
    pub id: u64,
    what: What,
    when: When,
    /// The last value of what a data breakpoint watches.
    last: Option<String>,
}

/// Where a breakpoint stops.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// At a statement of FIL.
    Fil(PathBuf, u32),
    /// At the first record that begins at or behind a line of the CL file.
    Cl(u32),
    /// At a block of the program, by its line.
    Nc(u64),
    /// At records of a major word.
    Record(String),
    /// At blocks with a text in them.
    Block(String),
    /// Where a section or macro begins, by the words of its title.
    Part(String),
    /// When a name gets another value.
    Name(String),
    /// When a location gets another value.
    Common(Kind, u32),
    /// When a letter is written with another value.
    Address(char),
}

/// What a breakpoint does to the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing.
    Passed,
    /// It stops it.
    Stops,
    /// It says something.
    Says(String),
}

/// All breakpoints.
#[derive(Default)]
pub struct Breakpoints {
    list: Vec<Breakpoint>,
    next: u64,
    /// Stop where the run is refused.
    pub on_errors: bool,
}

impl Breakpoints {
    /// Takes breakpoints in the place of those that `old` tells.
    pub fn replace(&mut self, old: impl Fn(&What) -> bool, new: Vec<(What, When)>) -> Vec<u64> {
        self.list.retain(|breakpoint| !old(&breakpoint.what));
        let mut ids = Vec::with_capacity(new.len());
        for (what, when) in new {
            self.next += 1;
            ids.push(self.next);
            self.list.push(Breakpoint { id: self.next, what, when, last: None });
        }
        ids
    }

    /// Takes all of them away.
    pub fn forget(&mut self) {
        self.list.clear();
        self.on_errors = false;
    }

    /// Counts from the start again, for a new run.
    pub fn begin_again(&mut self) {
        for breakpoint in &mut self.list {
            breakpoint.when.hits = 0;
            breakpoint.last = None;
        }
    }

    /// The numbers of those that stop a run where `is_here` says, and what log points say.
    pub fn hit(
        &mut self,
        is_here: impl Fn(&What) -> bool,
        state: &DebugState<'_, '_>,
    ) -> (Vec<u64>, Vec<String>) {
        let (mut stopping, mut said) = (Vec::new(), Vec::new());
        for breakpoint in self.list.iter_mut().filter(|breakpoint| is_here(&breakpoint.what)) {
            match breakpoint.when.verdict(state) {
                Verdict::Passed => {}
                Verdict::Stops => stopping.push(breakpoint.id),
                Verdict::Says(text) => said.push(text),
            }
        }
        (stopping, said)
    }

    /// The same for data breakpoints, with a sentence about each value that is another one.
    pub fn changed(&mut self, state: &DebugState<'_, '_>) -> (Vec<u64>, Vec<String>, Vec<String>) {
        let (mut stopping, mut said, mut changes) = (Vec::new(), Vec::new(), Vec::new());
        for breakpoint in &mut self.list {
            let Some(value) = watched(&breakpoint.what, state) else { continue };
            let before = breakpoint.last.replace(value.clone());
            let Some(before) = before.filter(|before| *before != value) else { continue };
            match breakpoint.when.verdict(state) {
                Verdict::Passed => continue,
                Verdict::Stops => stopping.push(breakpoint.id),
                Verdict::Says(text) => said.push(text),
            }
            changes.push(format!("{} was {before} and is {value}", title(&breakpoint.what)));
        }
        (stopping, said, changes)
    }
}

/// What a data breakpoint watches, as text; `None` for any other breakpoint.
fn watched(what: &What, state: &DebugState<'_, '_>) -> Option<String> {
    match what {
        What::Name(name) => Some(shown(&state.fil.value(name).unwrap_or(Held::Unset))),
        What::Common(kind, number) => {
            let value = state.commons().get(*kind, *number).ok()?;
            Some(shown(&Held::Number(value)))
        }
        What::Address(letter) => {
            let words = state.last_words();
            let word = words.iter().find(|(known, ..)| known == letter);
            Some(word.map_or_else(|| "not written".to_string(), |(_, value, _)| value.to_string()))
        }
        _ => None,
    }
}

fn title(what: &What) -> String {
    match what {
        What::Name(name) => name.clone(),
        What::Common(kind, number) => format!("{} {number}", kind.name()),
        What::Address(letter) => letter.to_string(),
        _ => String::new(),
    }
}

impl When {
    /// What the client asks for.
    ///
    /// # Errors
    /// A count of hits that can't be read as one.
    pub fn read(asked: &Value) -> Result<When, String> {
        let text = |key: &str| {
            let value = asked.get(key).and_then(Value::as_str).map(str::trim);
            value.filter(|text| !text.is_empty()).map(str::to_string)
        };
        let hit = text("hitCondition").map(|text| Hit::read(&text)).transpose()?;
        Ok(When { condition: text("condition"), hit, log: text("logMessage"), hits: 0 })
    }

    fn verdict(&mut self, state: &DebugState<'_, '_>) -> Verdict {
        if let Some(condition) = &self.condition {
            match evaluate(condition, state) {
                Ok(Held::Number(0.0)) => return Verdict::Passed,
                Ok(Held::Number(1.0)) => {}
                // To pass such a condition over silently would hide it.
                Ok(other) => {
                    let text = format!("the condition {condition} is {}", shown(&other));
                    return Verdict::Says(text);
                }
                Err(diag) => {
                    let text = format!("the condition {condition}: {}", diag.message);
                    return Verdict::Says(text);
                }
            }
        }
        self.hits += 1;
        if self.hit.is_some_and(|hit| !hit.fits(self.hits)) {
            return Verdict::Passed;
        }
        match &self.log {
            Some(message) => Verdict::Says(filled_in(message, state)),
            None => Verdict::Stops,
        }
    }
}

impl Hit {
    fn read(text: &str) -> Result<Hit, String> {
        let split = text.find(|c: char| c.is_ascii_digit()).unwrap_or(text.len());
        let (sign, number) = text.split_at(split);
        let wrong = || format!("`{text}` is no count of hits: 5, >= 5, > 5, == 5 or % 5");
        let number: u64 = number.trim().parse().map_err(|_| wrong())?;
        match sign.trim() {
            "" | ">=" => Ok(Hit::AtLeast(number)),
            ">" => Ok(Hit::More(number)),
            "==" | "=" => Ok(Hit::Exactly(number)),
            "%" if number > 0 => Ok(Hit::Each(number)),
            _ => Err(wrong()),
        }
    }

    fn fits(self, hits: u64) -> bool {
        match self {
            Hit::AtLeast(number) => hits >= number,
            Hit::More(number) => hits > number,
            Hit::Exactly(number) => hits == number,
            Hit::Each(number) => hits.is_multiple_of(number),
        }
    }
}

/// A message with each `{expression}` evaluated.
fn filled_in(message: &str, state: &DebugState<'_, '_>) -> String {
    let mut text = String::new();
    let mut rest = message;
    while let Some((before, behind)) = rest.split_once('{') {
        text.push_str(before);
        let Some((expression, behind)) = behind.split_once('}') else {
            text.push('{');
            rest = behind;
            continue;
        };
        match evaluate(expression, state) {
            Ok(value) => text.push_str(&shown(&value)),
            Err(diag) => text.push_str(&format!("{{{expression}: {}}}", diag.message)),
        }
        rest = behind;
    }
    text + rest
}

/// A function breakpoint by its name: `record CYCLE`, `block G83`, `section CYCLE`,
/// `macro DEEPHL`; one word alone is a section or a macro.
pub fn named(name: &str) -> Result<What, String> {
    let name = name.trim();
    let (kind, rest) = name.split_once(char::is_whitespace).unwrap_or(("", name));
    let rest = rest.trim();
    if rest.is_empty() {
        return Err("write record CYCLE, block G83, section CYCLE or macro NAME".to_string());
    }
    match kind.to_ascii_lowercase().as_str() {
        "record" => Ok(What::Record(rest.to_ascii_uppercase())),
        "block" => Ok(What::Block(rest.to_string())),
        "section" | "macro" => {
            let kind = kind.to_ascii_lowercase();
            Ok(What::Part(format!("{kind} {}", rest.to_ascii_uppercase())))
        }
        "" => Ok(What::Part(rest.to_ascii_uppercase())),
        _ => Err(format!("`{kind}` is not record, block, section or macro")),
    }
}

/// True for a breakpoint at a part of that title. A major word means all its sections.
pub fn is_part(wanted: &str, title: &str) -> bool {
    let begins = |whole: &str| {
        whole.strip_prefix(wanted).is_some_and(|rest| rest.is_empty() || rest.starts_with(','))
    };
    begins(title) || title.split_once(' ').is_some_and(|(_, name)| begins(name))
}

/// What a data breakpoint watches, by the identifier that the client gives back.
pub fn watched_by(id: &str) -> Option<What> {
    let (kind, rest) = id.split_once(' ')?;
    match kind {
        "name" => Some(What::Name(rest.to_string())),
        "address" => rest.chars().next().map(What::Address),
        kind => {
            let kind = [Kind::Int, Kind::Rel, Kind::Dbl].into_iter().find(|k| k.name() == kind)?;
            rest.parse().ok().map(|number| What::Common(kind, number))
        }
    }
}

/// The identifier of what a client wants to watch: a name of FIL, a setting by its name,
/// `INTCOM 1861`, or a letter that the control has; `address X` where X is a name too.
pub fn watch_id(name: &str, is_letter: bool, state: &DebugState<'_, '_>) -> Option<String> {
    let name = name.trim();
    if is_letter || (name.len() == 1 && state.fil.value(name).is_none()) {
        let letter = name.chars().next().filter(char::is_ascii_uppercase)?;
        return Some(format!("address {letter}"));
    }
    if state.fil.value(name).is_some() {
        return Some(format!("name {name}"));
    }
    if let Some(row) = Location::named(&name.to_ascii_lowercase()) {
        return Some(format!("{} {}", row.kind.name(), row.number));
    }
    let upper = name.to_ascii_uppercase();
    let id = upper.split_whitespace().collect::<Vec<_>>().join(" ");
    let letter = id.strip_prefix("ADDRESS ").filter(|letter| letter.len() == 1);
    if let Some(letter) = letter.filter(|letter| letter.as_bytes()[0].is_ascii_uppercase()) {
        return Some(format!("address {letter}"));
    }
    matches!(watched_by(&id), Some(What::Common(..))).then_some(id)
}

/// Two paths of one file.
pub fn same_file(one: &Path, other: &Path) -> bool {
    one == other || whole(one) == whole(other)
}

/// A path as the system calls it.
pub fn whole(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

/// A breakpoint as the client is told of it.
pub fn told(id: Option<u64>, line: Option<u64>, message: Option<&str>) -> Value {
    let mut told = json!({ "verified": message.is_none() });
    if let Some(id) = id {
        told["id"] = id.into();
    }
    if let Some(line) = line {
        told["line"] = line.into();
    }
    if let Some(message) = message {
        told["message"] = message.into();
    }
    told
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_hits_are_read() {
        let fits = |text: &str, hits: u64| Hit::read(text).unwrap().fits(hits);
        assert!(fits("3", 3) && fits("3", 4) && !fits("3", 2));
        assert!(fits("> 3", 4) && !fits(">3", 3));
        assert!(fits("== 3", 3) && !fits("==3", 4));
        assert!(fits("%3", 6) && !fits("% 3", 4));
        for wrong in ["", "x", "<3", "% 0", "3x"] {
            assert!(Hit::read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn function_breakpoints_are_named() {
        assert_eq!(named("record cycle"), Ok(What::Record("CYCLE".into())));
        assert_eq!(named("block G83 Z-"), Ok(What::Block("G83 Z-".into())));
        assert_eq!(named("Section cycle,deep"), Ok(What::Part("section CYCLE,DEEP".into())));
        assert_eq!(named("deephl"), Ok(What::Part("DEEPHL".into())));
        assert!(named("").is_err() && named("line 5").is_err());
        assert!(is_part("DEEPHL", "macro DEEPHL") && is_part("macro DEEPHL", "macro DEEPHL"));
        assert!(
            is_part("section CYCLE", "section CYCLE,DEEP") && is_part("CYCLE", "section CYCLE")
        );
        assert!(!is_part("section DEEPHL", "macro DEEPHL") && !is_part("CYC", "section CYCLE"));
    }

    #[test]
    fn watched_things_come_back() {
        assert_eq!(watched_by("name XX"), Some(What::Name("XX".into())));
        assert_eq!(watched_by("INTCOM 1861"), Some(What::Common(Kind::Int, 1861)));
        assert_eq!(watched_by("address X"), Some(What::Address('X')));
        assert_eq!(watched_by("INTCOM x"), None);
    }
}
