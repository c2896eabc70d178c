//! The pages of the post words, as the reference has them: form, example, what is
//! written, words by position.

use std::sync::OnceLock;

/// All pages, each from its heading on; none without the feature `word-pages`.
#[cfg(feature = "word-pages")]
const OWN: &str = include_str!("../data/words.md");
#[cfg(not(feature = "word-pages"))]
const OWN: &str = "";

/// Those that a host has given.
static GIVEN: OnceLock<String> = OnceLock::new();

/// Takes the pages, the text of `data/words.md`, from a host that was built without the feature
/// `word-pages`. The first ones stay.
pub fn give(pages: String) {
    let _ = GIVEN.set(pages);
}

/// The page of a post word, letters in any case.
pub fn page(word: &str) -> Option<&'static str> {
    let pages = GIVEN.get().map_or(OWN, String::as_str);
    let heading = format!("# {}\n", word.to_ascii_uppercase());
    let start =
        if pages.starts_with(&heading) { 0 } else { pages.find(&format!("\n{heading}"))? + 1 };
    let page = &pages[start..];
    Some(page[1..].find("\n# ").map_or(page, |end| &page[..end + 2]))
}

/// True where the page of a post word names another word, or the post word has no page.
pub fn names(word: &str, other: &str) -> bool {
    let names = |page: &str| page.split(|c: char| !c.is_alphanumeric()).any(|it| it == other);
    page(word).is_none_or(names)
}

/// The forms of a post word, as its page begins: `SPINDL/RPM,s,CLW`. `None` for a word without a page,
/// or a page without a form.
pub fn forms(word: &str) -> Option<String> {
    let begins = format!("- `{}", word.to_ascii_uppercase());
    let rows = page(word)?.lines().take_while(|line| !line.starts_with("## "));
    let forms: Vec<&str> = rows
        .filter(|row| row.starts_with(&begins))
        .filter_map(|row| row[2..].split(": ").next())
        .collect();
    (!forms.is_empty()).then(|| forms.join("; "))
}
