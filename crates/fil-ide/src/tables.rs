//! Texts of the tables of functions, statements, words and settings, as Markdown.

use filpost::builtins::BUILTINS;
use filpost::cl::Vocabulary;
use filpost::locations::{Location, TABLE, ValueUnit};
use filpost::postf::{Grade, POSTF, PostfInfo};
use filpost::statements::STATEMENTS;
use filpost::{CommonKind, Kind, check, commons, dispatch, word_pages};

fn grade(grade: Grade) -> &'static str {
    match grade {
        Grade::Published => "published",
        Grade::Inferred => "inferred",
        Grade::Own => "our own reading",
    }
}

/// A function or a form of TEXT/, by its name.
pub(crate) fn function(name: &str) -> Option<String> {
    let row = BUILTINS.iter().find(|row| row.name.eq_ignore_ascii_case(name))?;
    let extension = if row.extension { "; an extension, refused under `--strict`" } else { "" };
    Some(format!("`{}`\n\n{}\n\n*{}{extension}*", row.call(), row.doc, grade(row.grade)))
}

/// A number of POSTF.
pub(crate) fn postf(number: u32) -> Option<String> {
    let row = POSTF.iter().find(|row| u32::from(row.number) == number)?;
    Some(format!("`{}`\n\n{}\n\n*{}*", postf_call(row), row.doc, grade(row.grade)))
}

/// A call of POSTF as it is written.
pub(crate) fn postf_call(row: &PostfInfo) -> String {
    let arguments: Vec<String> = row.arguments.iter().map(|name| format!(",{name}")).collect();
    format!("POSTF({}{})", row.number, arguments.concat())
}

/// A statement of FIL.
pub(crate) fn statement(word: &str) -> Option<String> {
    let row = STATEMENTS.iter().find(|row| row.word.eq_ignore_ascii_case(word))?;
    Some(format!("```fil\n{}\n```\n\n{}\n\n*{}*", row.form, row.doc, grade(row.grade)))
}

/// A word of the vocabulary: its code, whether the post carries it out, its page.
pub(crate) fn word(name: &str) -> String {
    let vocabulary = Vocabulary::new();
    let Some(id) = vocabulary.find(name).filter(|id| vocabulary.is_known(*id)) else {
        return format!("`{name}`: a word of this script or of the CL file");
    };
    let class = if vocabulary.is_major(id) { "major word" } else { "minor word" };
    let code = if vocabulary.is_public(id) {
        format!(", code {}", vocabulary.code(id))
    } else {
        String::new()
    };
    let handled = dispatch::HANDLERS.iter().any(|(word, _)| *word == id);
    let post = match (vocabulary.is_major(id), handled) {
        (_, true) => "\n\nThe post carries it out.",
        (true, false) => "\n\nThe post does not know it: a section must take it.",
        (false, false) => "",
    };
    let page =
        word_pages::page(name).and_then(|page| page.split_once("\n\n")).map(|(_, page)| page);
    let page = page.map_or_else(String::new, |page| format!("\n\n{page}"));
    format!("`{}`: {class}{code}{post}{page}", vocabulary.name(id))
}

/// A setting, as the docs and `explain` show it.
pub(crate) fn location(row: &Location) -> String {
    let mut text = format!(
        "`{}` ({} {})\n\n{}\n\nUnit: {}, default: {}\n",
        row.name,
        row.kind.name(),
        row.number,
        row.meaning,
        row.unit,
        value(row.default_value()),
    );
    for (number, meaning) in row.choice_list() {
        text.push_str(&format!("- {number}: {meaning}\n"));
    }
    let acts = if row.used { "The post acts on it." } else { "The post does **not** act on it." };
    let why = if row.idle.is_empty() { String::new() } else { format!(" {}", row.idle) };
    text.push_str(&format!("\n{acts}{why} *Evidence: {}*", row.evidence));
    text
}

/// A value of a common; EMPTY is none.
pub(crate) fn value(number: f64) -> String {
    if number == commons::EMPTY { "none".into() } else { number.to_string() }
}

/// A common by the type and number of POSTF(1), (2) and (3).
pub(crate) fn common(kind: u32, number: u32) -> Option<String> {
    match kind {
        1 => common_of(CommonKind::Int, Kind::Int, number),
        2 => common_of(CommonKind::Rel, Kind::Rel, number),
        3 => common_of(CommonKind::Dbl, Kind::Dbl, number),
        _ => None,
    }
}

fn common_of(kind: CommonKind, of_machine: Kind, number: u32) -> Option<String> {
    let row = Location::numbered(of_machine, number);
    row.map(location).or_else(|| check::name_of_common(kind, number))
}

/// The short name of such a common.
pub(crate) fn common_name(kind: u32, number: u32) -> Option<String> {
    let kind = match kind {
        1 => CommonKind::Int,
        2 => CommonKind::Rel,
        3 => CommonKind::Dbl,
        _ => return None,
    };
    check::name_of_common(kind, number)
}

/// True for a common whose value is the number of a letter.
pub(crate) fn holds_letter(kind: u32, number: u32) -> bool {
    let kind = match kind {
        1 => Kind::Int,
        2 => Kind::Rel,
        3 => Kind::Dbl,
        _ => return false,
    };
    Location::numbered(kind, number).is_some_and(|row| row.unit == ValueUnit::Letter)
}

/// Minor words of a post word: those of the forms and examples of its page, and of CYCLE the
/// kinds that have a code in the table of settings.
pub(crate) fn minors_of(major: &str, vocabulary: &Vocabulary) -> Vec<String> {
    let Some(page) = word_pages::page(major) else { return Vec::new() };
    let mut found: Vec<String> = Vec::new();
    let mut add = |word: &str| {
        let known = vocabulary.find(word).is_some_and(|id| vocabulary.is_known(id));
        if word.len() > 1 && known && word != major && !found.iter().any(|own| own == word) {
            found.push(word.to_string());
        }
    };
    let kinds = TABLE.iter().filter(|_| major == "CYCLE").filter_map(|row| {
        row.name.strip_prefix("cycle.")?.strip_suffix("_code").map(str::to_ascii_uppercase)
    });
    kinds.for_each(|kind| add(&kind));
    let forms = page.split("\n## ").next().unwrap_or_default();
    let forms = forms.split('`').enumerate().filter(|(index, _)| index % 2 == 1);
    let examples = page.lines().filter(|line| line.starts_with(major) && line.contains('/'));
    for text in forms.map(|(_, form)| form).chain(examples) {
        text.split(|c: char| !c.is_ascii_uppercase()).for_each(&mut add);
    }
    found
}

/// The first form of a post word's page.
pub(crate) fn form_of(major: &str) -> Option<&'static str> {
    word_pages::page(major)?.split('`').nth(1)
}
