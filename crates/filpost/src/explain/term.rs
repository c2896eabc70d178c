//! Terms of the trade, from the table of the glossary, and settings and codes by several words.

use fil_diag::Code;
use fil_machine::locations::{Location, TABLE};

use super::plain;

/// The rows of the table in `docs/glossary.md`.
#[cfg(feature = "word-pages")]
const TERMS: &str = include_str!("../../data/terms.md");
#[cfg(not(feature = "word-pages"))]
const TERMS: &str = "";

/// Most settings and most codes that are listed.
const MOST: usize = 15;

/// Explains a term such as `tool length offset`, `TLO` or `block delete`; `None` for a text that
/// is in no row of the glossary.
pub fn explain(subject: &str) -> Option<String> {
    let wanted = normal(subject);
    let rows: Vec<[&str; 3]> = TERMS.lines().filter_map(cells).collect();
    let found = rows.iter().filter(|row| names(row[0]).any(|name| name == wanted));
    texts(found)
}

/// Explains the terms that have all words of the subject, such as `cutter comp`.
pub fn explain_part(subject: &str) -> Option<String> {
    let wanted = normal(subject);
    let rows: Vec<[&str; 3]> = TERMS.lines().filter_map(cells).collect();
    let found = rows.iter().filter(|row| has_words(&normal(row[0]), &wanted));
    (wanted.len() > 2).then(|| texts(found)).flatten()
}

/// Rows of the glossary as texts.
fn texts<'r>(rows: impl Iterator<Item = &'r [&'r str; 3]>) -> Option<String> {
    let text = |[term, meaning, place]: &[&str; 3]| {
        let place = named_pages(place);
        plain::text(&format!("{term}\n\n{}\nIn filpost: {place}", sentence(meaning)))
    };
    let texts: Vec<String> = rows.map(text).collect();
    (!texts.is_empty()).then(|| texts.join("\n\n"))
}

/// A cell whose links to pages name them: `[Lathes](lathe.md)` becomes `the page Lathes`.
fn named_pages(cell: &str) -> String {
    let is_code = |label: &str| label.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit());
    let mut text = String::new();
    let mut rest = cell;
    while let Some((before, after)) = rest.split_once('[') {
        text.push_str(before);
        let label = after.split(']').next().unwrap_or_default();
        if after[label.len()..].starts_with("](") && !is_code(label) && !label.starts_with('`') {
            text.push_str("the page ");
        }
        text.push('[');
        rest = after;
    }
    text.push_str(rest);
    text
}

/// Settings whose name or text has all words of the subject, and codes whose title has them.
pub fn search(subject: &str, codes: &[&Code]) -> Option<String> {
    let wanted = normal(subject);
    if wanted.len() < 3 {
        return None;
    }
    let is_meant = |row: &&Location| {
        has_words(
            &normal(&format!("{} {}", row.name.replace(['.', '_'], " "), row.meaning)),
            &wanted,
        )
    };
    let setting = |row: &Location| format!("{:<28} {}", row.name, row.meaning);
    let settings: Vec<String> = TABLE.iter().filter(is_meant).map(setting).collect();
    let titled = codes.iter().filter(|code| has_words(&normal(code.title), &wanted));
    let titles: Vec<String> =
        titled.map(|code| format!("{:<28} {}", code.name(), code.title)).collect();
    let lists = [("Settings", settings), ("Messages", titles)];
    let texts: Vec<String> = lists
        .iter()
        .filter(|(_, rows)| !rows.is_empty())
        .map(|(kind, rows)| format!("{kind} with `{subject}`:\n{}", list(rows)))
        .collect();
    (!texts.is_empty()).then(|| texts.join("\n\n"))
}

/// The first rows, and how many there are besides.
fn list(rows: &[String]) -> String {
    let mut text = rows.iter().take(MOST).cloned().collect::<Vec<_>>().join("\n");
    if rows.len() > MOST {
        text.push_str(&format!("\n… and {} more", rows.len() - MOST));
    }
    text
}

/// The cells of a row of a table.
fn cells(line: &str) -> Option<[&str; 3]> {
    let row = line.strip_prefix("| ")?.strip_suffix(" |")?;
    let mut cells = row.split(" | ");
    let three = [cells.next()?, cells.next()?, cells.next()?];
    cells.next().is_none().then_some(three)
}

/// The names in the first cell: `tool length offset, TLO (G43 H, G49)` has four.
fn names(term: &str) -> impl Iterator<Item = String> + '_ {
    term.split([',', '(', ')', ':']).map(normal).filter(|name| !name.is_empty())
}

/// A text in lower case, without hyphens, quotes and the `s` of a plural.
fn normal(text: &str) -> String {
    let text = text.to_lowercase().replace(['-', '`', '/'], " ");
    let word = |word: &str| match word.strip_suffix('s') {
        Some(one) if one.len() > 2 && !one.ends_with(['s', 'u', 'i']) => one.to_string(),
        _ => word.to_string(),
    };
    let trim =
        |part: &str| part.trim_matches(|c: char| !c.is_alphanumeric() && c != '%').to_string();
    text.split_whitespace()
        .map(trim)
        .filter(|part| !part.is_empty())
        .map(|part| word(&part))
        .collect::<Vec<_>>()
        .join(" ")
}

/// True if each wanted word begins a word of the text; a letter is a word of its own.
fn has_words(text: &str, wanted: &str) -> bool {
    let is_one = |want: &str, word: &str| {
        if want.len() == 1 { word == want } else { word.starts_with(want) }
    };
    wanted.split(' ').all(|want| text.split(' ').any(|word| is_one(want, word)))
}

fn sentence(text: &str) -> String {
    let mut characters = text.chars();
    let first = characters.next().map(|first| first.to_uppercase().to_string());
    format!("{}{}.", first.unwrap_or_default(), characters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_to_pages_name_them() {
        let cell = "THREAD; [Lathes](lathe.md#threads), [E0536](errors/E0536.md)";
        let plain = plain::text(&named_pages(cell));
        assert_eq!(plain, "THREAD; the page Lathes, E0536");
    }

    #[test]
    fn names_of_a_term_are_found_in_any_form() {
        let found: Vec<String> = names("tool length offset, TLO (G43 H, G49)").collect();
        assert_eq!(found, ["tool length offset", "tlo", "g43 h", "g49"]);
        assert_eq!(normal("Sub-Spindles"), "sub spindle");
        assert_eq!(normal("radius"), "radius");
        assert!(has_words("number of the work offset", "work offset"));
        assert!(!has_words("number of the work offset", "tool offset"));
    }
}
