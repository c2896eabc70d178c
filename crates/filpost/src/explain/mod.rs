//! What a code, a setting, a word, a function, a location, a G or M code, a ready post or an option
//! of one means, and a term of the trade: the texts of `filpost explain`.

mod nc_function;
mod option;
mod plain;
mod term;

use fil_cl::Vocabulary;
use fil_diag::{Code, CodeKind, suggest};
use fil_machine::locations::{Location, TABLE};
use fil_machine::{Commons, Kind, commons};
use fil_post::dispatch;
use fil_vm::builtins::BUILTINS;
use fil_vm::postf::{Grade, POSTF, PostfInfo};
use fil_vm::statements::STATEMENTS;

use crate::ready::{self, READY};
use crate::word_pages;

/// What a subject means, `E0501`, `rapid.split`, `CYCLE`, `POSTF 13`, `INTCOM 1861`, `G83`,
/// `haas-mill`, `preload`, `tool length offset`, or part of a name; `None` for an unknown one. `further` are codes
/// besides those of [`crate::all_codes`].
///
/// ```
/// let text = filpost::explain::explain("G83", &[]).expect("a code of drilling");
/// assert!(text.starts_with("G83\n"));
/// ```
pub fn explain(subject: &str, further: &[Code]) -> Option<String> {
    let text = match words(subject)[..] {
        [word] => one(word, further),
        [table, number] => numbered(table, number).or_else(|| several(subject, table, further)),
        [name, number, ..] if name.eq_ignore_ascii_case("POSTF") => numbered(name, number),
        [name, ..] => several(subject, name, further),
        [] => None,
    };
    text.map(|text| text.trim_end().to_string())
}

/// What several words mean together; else what the first of them means as a function or a code:
/// `SCALF(x)`, `G43 H1`.
fn several(subject: &str, first: &str, further: &[Code]) -> Option<String> {
    let term = term::explain(subject).or_else(|| term::explain_part(subject));
    let mut parts: Vec<String> = term.into_iter().collect();
    parts.extend(function(first).or_else(|| nc_function::explain(first)));
    if parts.is_empty() {
        parts.extend(term::search(subject, &codes_and(further)));
    }
    (!parts.is_empty()).then(|| parts.join("\n\n"))
}

fn codes_and(further: &[Code]) -> Vec<&Code> {
    crate::all_codes().into_iter().chain(further).collect()
}

/// The parts of a subject, such as `POSTF(13,2)` or `INTCOM 1861`.
fn words(subject: &str) -> Vec<&str> {
    subject.split([' ', ',', '(', ')']).filter(|word| !word.is_empty()).collect()
}

/// The known subject that is written most like this one.
pub fn nearest(subject: &str) -> Option<String> {
    let vocabulary = Vocabulary::new();
    let mut names: Vec<String> = TABLE.iter().map(|row| row.name.to_string()).collect();
    names.extend(STATEMENTS.iter().map(|row| row.word.to_string()));
    names.extend(BUILTINS.iter().map(|row| row.name.to_string()));
    names.extend(READY.iter().map(|post| post.name.to_string()));
    names.extend(dispatch::HANDLERS.iter().map(|(id, _)| vocabulary.name(*id).to_string()));
    names.extend(crate::all_codes().into_iter().map(Code::name));
    let subject = words(subject).join(" ");
    suggest::nearest(&subject, names.iter().map(String::as_str)).map(String::from)
}

fn one(word: &str, further: &[Code]) -> Option<String> {
    let mut parts: Vec<String> = Vec::new();
    parts.extend(code(word, further));
    parts.extend(Location::named(&word.to_ascii_lowercase()).map(location));
    parts.extend(statement(word));
    parts.extend(function(word));
    parts.extend(ready::find(word).map(|post| plain::text(post.readme())));
    parts.extend(nc_function::explain(word));
    if parts.is_empty() {
        parts.extend(term::explain(word));
        parts.extend(vocabulary_word(word));
    }
    parts.extend(group(word));
    if parts.is_empty() {
        parts.extend(term::explain_part(word));
    }
    let has_settings = parts.iter().any(|part| part.contains("Settings"));
    if parts.is_empty() || !has_settings && vocabulary_word(word).is_none() {
        parts.extend(part_of_names(word, further));
    }
    parts.extend(option::explain(&word.to_ascii_lowercase()));
    (!parts.is_empty()).then(|| parts.join("\n\n"))
}

/// Most ready posts that are named; of more their number is given.
const MOST_NAMED: usize = 6;

fn counted(names: &[&str]) -> String {
    if names.len() <= MOST_NAMED {
        names.join(", ")
    } else {
        format!("{} of {} ready posts", names.len(), READY.len())
    }
}

fn numbered(table: &str, number: &str) -> Option<String> {
    let number: u32 = number.parse().ok()?;
    let kind = match table.to_ascii_uppercase().as_str() {
        "POSTF" => {
            return Some(match POSTF.iter().find(|row| u32::from(row.number) == number) {
                Some(row) => postf(row),
                None => format!(
                    "POSTF({number},…): its meaning is not published; a script that calls it is refused.\n\
                     A compat file can give the number an operation."
                ),
            });
        }
        "INTCOM" | "INT" => Kind::Int,
        "RELCOM" | "REL" => Kind::Rel,
        "DBLCOM" | "DBL" => Kind::Dbl,
        _ => return None,
    };
    if number == 0 || number as usize > kind.size() {
        return Some(format!("{} has the locations 1 to {}.", kind.name(), kind.size()));
    }
    let known = Location::numbered(kind, number).map(location);
    known.or_else(|| Some(unnamed(kind, number)))
}

/// A location that is no row of the table.
fn unnamed(kind: Kind, number: u32) -> String {
    let name = kind.name();
    let letter = |index: u32| char::from(b'A' - 1 + index as u8);
    match (kind, number) {
        (Kind::Int, 1..=26) => format!(
            "{name} {number}: tape position of the letter {}; 53 when the machine has none.",
            letter(number)
        ),
        (Kind::Int, 53..=105) => {
            format!("{name} {number}: letter code at tape position {}.", number - 52)
        }
        (Kind::Int, 106..=158) => {
            format!("{name} {number}: number format of tape position {}.", number - 105)
        }
        (Kind::Int, 159..=211) => {
            format!("{name} {number}: zero and point rule of tape position {}.", number - 158)
        }
        (Kind::Dbl, 356..=381) => format!(
            "{name} {number}: last value written with the letter {}; EMPTY writes the next one again.",
            letter(number - 355)
        ),
        _ => format!("{name} {number}: its meaning is not published; the post does not act on it."),
    }
}

fn code(name: &str, further: &[Code]) -> Option<String> {
    let digits = name.strip_prefix(['E', 'W', 'e', 'w']).unwrap_or(name);
    let number: u16 = digits.parse().ok().filter(|_| digits.len() >= 3)?;
    let codes = crate::all_codes();
    let code = codes.into_iter().chain(further).find(|code| code.number == number)?;
    Some(code_text(code))
}

fn code_text(code: &Code) -> String {
    let kind = match code.kind {
        CodeKind::Warning => "Warning",
        CodeKind::Error => "Error: no program is written",
        CodeKind::Doubt => "Doubt: it can be posted, but may not be intended",
    };
    let level = crate::level_line(code).map_or_else(String::new, |line| format!("\n{line}"));
    format!(
        "{}  {}\n\n{kind}.{level}\n{}\n\nWhat to do: {}",
        code.name(),
        code.title,
        code.reason,
        code.hint
    )
}

fn postf(row: &PostfInfo) -> String {
    let arguments: Vec<String> = row.arguments.iter().map(|name| format!(",{name}")).collect();
    format!(
        "POSTF({}{})\n\n{}{}\n\nName in a compat file: {}",
        row.number,
        arguments.concat(),
        sentence(row.doc),
        grade(row.grade),
        crate::operation_name(row.op)
    )
}

fn statement(word: &str) -> Option<String> {
    let row = STATEMENTS.iter().find(|row| row.word.eq_ignore_ascii_case(word))?;
    Some(format!("{}\n\n{}{}", row.form, sentence(row.doc), grade(row.grade)))
}

fn function(name: &str) -> Option<String> {
    if name.eq_ignore_ascii_case("POSTF") {
        let rows: Vec<String> = POSTF
            .iter()
            .map(|row| format!("{:>4}  {}  {}", row.number, row.grade.letter(), row.doc))
            .collect();
        let legend =
            "P published, I inferred from published scripts, O the reading of filpost alone";
        return Some(format!(
            "POSTF(n,…): reads and changes records, settings and last output values.\n\n{}\n\n{legend}",
            rows.join("\n")
        ));
    }
    let row = BUILTINS.iter().find(|row| row.name.eq_ignore_ascii_case(name))?;
    let extension =
        if row.extension { "\nAn extension of filpost, refused under --strict." } else { "" };
    Some(format!("{}\n\n{}{}{extension}", row.call(), sentence(row.doc), grade(row.grade)))
}

/// What a reader has to know of a reading that no public source has.
fn grade(grade: Grade) -> &'static str {
    match grade {
        Grade::Published | Grade::Inferred => "",
        Grade::Own => "\n\nNo public source documents it: this is the reading of filpost.",
    }
}

fn location(row: &Location) -> String {
    let mut text = format!(
        "{}  ({} {})\n\n{}\n\nUnit: {}\nDefault: {}\n",
        row.name,
        row.kind.name(),
        row.number,
        row.meaning,
        row.unit,
        value(row.default_value()),
    );
    for (number, meaning) in row.choice_list() {
        text.push_str(&format!("  {number} = {meaning}\n"));
    }
    let used = match (row.used, row.idle) {
        (true, _) => String::new(),
        (false, "") => "It has no effect.".to_string(),
        (false, reason) => format!("It has no effect: {reason}"),
    };
    text.push_str(used.as_str());
    text
}

/// A value of a common as settings show it.
pub fn value(number: f64) -> String {
    if number == commons::EMPTY { "none".into() } else { number.to_string() }
}

fn vocabulary_word(name: &str) -> Option<String> {
    let vocabulary = Vocabulary::new();
    let Some(id) = vocabulary.find(name).filter(|id| vocabulary.is_known(*id)) else {
        return dialect_word(name);
    };
    let class = if vocabulary.is_major(id) { "major word" } else { "minor word" };
    let code = if vocabulary.is_public(id) {
        format!(", code {}", vocabulary.code(id))
    } else {
        String::new()
    };
    let handled = dispatch::HANDLERS.iter().any(|(word, _)| *word == id);
    let post = match (vocabulary.is_major(id), handled) {
        (_, true) => "",
        (true, false) => "\n\nThe post has no handler for it: a FIL section must take it.",
        (false, false) => "\n\nA word inside statements.",
    };
    let page = word_pages::page(name).map_or_else(String::new, |page| {
        let (_, text) = page.split_once("\n\n").unwrap_or_default();
        format!("\n\n{}", plain::text(text))
    });
    Some(format!("{}  {class}{code}{post}{page}", vocabulary.name(id)))
}

/// A word of one system, which the reader of its dialect takes.
fn dialect_word(name: &str) -> Option<String> {
    let (_, text) = word_pages::page(name)?.split_once("\n\n")?;
    Some(format!(
        "{}  major word of one CAM system\n\n{}",
        name.to_ascii_uppercase(),
        plain::text(text)
    ))
}

/// The settings of a group such as `rapid`.
fn group(prefix: &str) -> Option<String> {
    let start = format!("{}.", prefix.to_ascii_lowercase().trim_end_matches('.'));
    let rows: Vec<String> = TABLE
        .iter()
        .filter(|row| row.name.starts_with(&start))
        .map(|row| format!("{:<28} {}", row.name, row.meaning))
        .collect();
    (!rows.is_empty()).then(|| format!("Settings:\n{}", rows.join("\n")))
}

/// The ready posts with a text in their name, and the settings and codes with it.
fn part_of_names(part: &str, further: &[Code]) -> Option<String> {
    let lower = part.to_ascii_lowercase();
    if lower.len() < 3 {
        return None;
    }
    let posts: Vec<&str> =
        READY.iter().map(|post| post.name).filter(|name| name.contains(&lower)).collect();
    let mut text = Vec::new();
    if !posts.is_empty() {
        text.push(format!("Ready posts: {}", posts.join(", ")));
    }
    text.extend(term::search(part, &codes_and(further)).or_else(|| settings_named(&lower)));
    (!text.is_empty()).then(|| text.join("\n\n"))
}

/// The settings with a text anywhere in their name.
fn settings_named(part: &str) -> Option<String> {
    let named = TABLE.iter().filter(|row| row.name.contains(part));
    let rows: Vec<String> = named.map(|row| format!("{:<28} {}", row.name, row.meaning)).collect();
    (!rows.is_empty()).then(|| format!("Settings with `{part}`:\n{}", rows.join("\n")))
}

fn sentence(doc: &str) -> String {
    let mut characters = doc.trim_end_matches('.').chars();
    let first = characters.next().map(|first| first.to_uppercase().to_string());
    format!("{}{}.", first.unwrap_or_default(), characters.as_str())
}

/// The value of a setting with the meaning of its choice.
pub fn shown_value(row: &Location, commons: &Commons) -> String {
    let number = commons.get(row.kind, u32::from(row.number)).unwrap_or(commons::EMPTY);
    let choice = row.choice_list().into_iter().find(|(choice, _)| *choice == number);
    match choice {
        Some((_, meaning)) if number != commons::EMPTY => format!("{number} ({meaning})"),
        _ => value(number),
    }
}
