//! The pages of the post words, as the reference has them: form, example, what is
//! written, words by position.

/// All pages, each from its heading on.
const PAGES: &str = include_str!("../data/words.md");

/// The page of a post word, letters in any case.
pub fn page(word: &str) -> Option<&'static str> {
    let heading = format!("# {}\n", word.to_ascii_uppercase());
    let start =
        if PAGES.starts_with(&heading) { 0 } else { PAGES.find(&format!("\n{heading}"))? + 1 };
    let page = &PAGES[start..];
    Some(page[1..].find("\n# ").map_or(page, |end| &page[..end + 2]))
}
