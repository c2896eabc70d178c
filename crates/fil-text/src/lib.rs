//! Code pages of controls.
//!
//! **Goal.** Text as the bytes of a control, and back.
//!
//! **Model.** A [`CodePage`] encodes and decodes. A text is written in a page only as bytes that
//! read back as the same text; the first letter that a page lacks is named, and never replaced.
//! The pages and the numbers by which Windows knows them are those of
//! <https://learn.microsoft.com/windows/win32/intl/code-page-identifiers>; their tables are those
//! of <https://www.unicode.org/Public/MAPPINGS> and, where a character has two bytes, of
//! <https://encoding.spec.whatwg.org>.
//!
//! **Quick start.**
//!
//! ```
//! use fil_text::CodePage;
//!
//! let page = CodePage::named("windows-1252").ok_or("no such page")?;
//! assert_eq!(page.encode("(FRÄSER)").as_deref(), Ok(&b"(FR\xC4SER)"[..]));
//! assert_eq!(page.encode("(刀 Ä)"), Err('刀'));
//! assert_eq!(page.decode(b"(FR\xC4SER)").as_deref(), Some("(FRÄSER)"));
//! # Ok::<(), &str>(())
//! ```
//!
//! **Limits.** Whole texts in memory, no stream; no page is guessed from its bytes. Without the
//! feature `double-byte` the pages of East Asia are not there.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.

mod pages;

use std::borrow::Cow;
use std::fmt;

#[cfg(feature = "double-byte")]
use encoding_rs::Encoding;

use crate::pages::PAGES;

/// First of the characters of private use that stand for bytes without a meaning.
const STRAY: u32 = 0xF700;

/// A code page; the default is UTF-8.
#[derive(Clone, Copy)]
pub struct CodePage(&'static Page);

/// A row of the table.
struct Page {
    number: u16,
    name: &'static str,
    kind: Kind,
}

/// How the bytes of a page become characters.
enum Kind {
    Utf8,
    /// ASCII, and these characters for the bytes from 128 on.
    Single(&'static str),
    /// A character has one byte or two.
    #[cfg(feature = "double-byte")]
    Double(&'static Encoding),
}

impl CodePage {
    /// UTF-8, which has all letters.
    pub const UTF_8: CodePage = CodePage(&Page { number: 0, name: "UTF-8", kind: Kind::Utf8 });

    /// All of them.
    pub fn all() -> impl Iterator<Item = CodePage> {
        PAGES.iter().map(CodePage)
    }

    /// The page of a number of Windows, such as 1252; 0 is UTF-8.
    pub fn numbered(number: u16) -> Option<CodePage> {
        CodePage::all().find(|page| page.number() == number)
    }

    /// The page of a label such as `windows-1252`, `cp1252`, `1252`, `shift_jis` or `utf-8`.
    pub fn named(label: &str) -> Option<CodePage> {
        let label = label.trim();
        match number_of(label) {
            Some(65001) => Some(CodePage::UTF_8),
            Some(number) => CodePage::numbered(number).filter(|page| page.number() != 0),
            None if label.eq_ignore_ascii_case("utf8") => Some(CodePage::UTF_8),
            None if label.eq_ignore_ascii_case("sjis") => CodePage::numbered(932),
            None => CodePage::all().find(|page| page.name().eq_ignore_ascii_case(label)),
        }
    }

    /// Its number in Windows; 0 for UTF-8.
    pub fn number(self) -> u16 {
        self.0.number
    }

    /// Its name, as in `windows-1252`.
    pub fn name(self) -> &'static str {
        self.0.name
    }

    /// True for UTF-8.
    pub fn is_utf8(self) -> bool {
        matches!(self.0.kind, Kind::Utf8)
    }

    /// A text as bytes, which [`CodePage::decode`] reads back as the same text.
    ///
    /// # Errors
    /// The first letter that the page lacks.
    pub fn encode(self, text: &str) -> Result<Cow<'_, [u8]>, char> {
        if text.is_ascii() {
            return Ok(text.as_bytes().into());
        }
        match &self.0.kind {
            Kind::Utf8 => Ok(text.as_bytes().into()),
            Kind::Single(upper) => {
                text.chars().map(|letter| byte_of(letter, upper).ok_or(letter)).collect()
            }
            #[cfg(feature = "double-byte")]
            Kind::Double(page) => {
                if let Some(bytes) = in_double(text, page) {
                    return Ok(bytes);
                }
                let lacks =
                    |letter: &char| in_double(letter.encode_utf8(&mut [0; 4]), page).is_none();
                Err(text.chars().find(lacks).unwrap_or(char::REPLACEMENT_CHARACTER))
            }
        }
    }

    /// Bytes as text; `None` where some of them are no text of the page.
    pub fn decode(self, bytes: &[u8]) -> Option<Cow<'_, str>> {
        if let Some(text) = std::str::from_utf8(bytes).ok().filter(|text| text.is_ascii()) {
            return Some(text.into());
        }
        match &self.0.kind {
            Kind::Utf8 => std::str::from_utf8(bytes).ok().map(Cow::from),
            Kind::Single(upper) => {
                let letters = bytes.iter().map(|byte| letter_of(*byte, upper));
                letters.collect::<Option<String>>().map(Cow::from)
            }
            #[cfg(feature = "double-byte")]
            Kind::Double(page) => page.decode_without_bom_handling_and_without_replacement(bytes),
        }
    }

    /// Bytes as text, for a reader that has to go on: in bytes that are no text of the page
    /// each from 128 on becomes a character of private use, so that other bytes stay other texts.
    pub fn decode_all(self, bytes: &[u8]) -> Cow<'_, str> {
        self.decode(bytes).unwrap_or_else(|| bytes.iter().map(|byte| stray(*byte)).collect())
    }
}

impl Default for CodePage {
    fn default() -> Self {
        CodePage::UTF_8
    }
}

impl PartialEq for CodePage {
    fn eq(&self, other: &Self) -> bool {
        self.number() == other.number()
    }
}

impl Eq for CodePage {}

impl fmt::Debug for CodePage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CodePage({})", self.name())
    }
}

impl fmt::Display for CodePage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A text for people: bytes without a meaning, as [`CodePage::decode_all`] keeps them, are
/// written `\xC4`.
pub fn shown(text: &str) -> Cow<'_, str> {
    if !text.chars().any(|letter| byte_without_meaning(letter).is_some()) {
        return text.into();
    }
    let one = |letter| match byte_without_meaning(letter) {
        Some(byte) => format!("\\x{byte:02X}"),
        None => letter.to_string(),
    };
    text.chars().map(one).collect::<String>().into()
}

fn byte_without_meaning(letter: char) -> Option<u8> {
    u32::from(letter).checked_sub(STRAY).and_then(|byte| u8::try_from(byte).ok())
}

fn byte_of(letter: char, upper: &str) -> Option<u8> {
    if letter.is_ascii() {
        return Some(letter as u8);
    }
    let known = |at: &char| *at == letter && letter != char::REPLACEMENT_CHARACTER;
    let at = upper.chars().position(|at| known(&at))?;
    u8::try_from(at + 128).ok()
}

fn letter_of(byte: u8, upper: &str) -> Option<char> {
    match byte.checked_sub(128) {
        None => Some(byte.into()),
        Some(at) => {
            let letter = upper.chars().nth(at.into());
            letter.filter(|letter| *letter != char::REPLACEMENT_CHARACTER)
        }
    }
}

fn stray(byte: u8) -> char {
    match byte {
        0..128 => byte.into(),
        _ => char::from_u32(STRAY + u32::from(byte)).unwrap_or(char::REPLACEMENT_CHARACTER),
    }
}

/// A text as bytes, where they read back as the same text: Shift_JIS has bytes for the yen sign
/// and the minus that are read as other characters.
#[cfg(feature = "double-byte")]
fn in_double<'t>(text: &'t str, page: &'static Encoding) -> Option<Cow<'t, [u8]>> {
    let (bytes, _, unmappable) = page.encode(text);
    let back = page.decode_without_bom_handling_and_without_replacement(&bytes)?;
    (!unmappable && back == text).then(|| bytes.clone())
}

/// The number of a label such as `cp850`, `CP-850`, `ibm850`, `windows-932` or `850`.
fn number_of(label: &str) -> Option<u16> {
    let digits = label.trim_start_matches(|letter: char| !letter.is_ascii_digit());
    let prefix = label.strip_suffix(digits)?.to_ascii_lowercase();
    let known = ["", "cp", "cp-", "cp_", "ibm", "ibm-", "ms", "windows-", "oem", "oem-"];
    if !known.contains(&prefix.as_str()) || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    digits.parse().ok()
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use encoding_rs::Encoding;

    use super::*;

    fn page(label: &str) -> CodePage {
        CodePage::named(label).unwrap_or_else(|| panic!("no page {label}"))
    }

    #[test]
    fn texts_of_workshops_in_their_pages() {
        for (label, text, bytes) in [
            ("windows-1252", "FRÄSER Ø10 ±0,01", &b"FR\xC4SER \xD810 \xB10,01"[..]),
            ("cp850", "Größe 90°", b"Gr\x94\xE1e 90\xF8"),
            ("437", "Fräser ± 0.1", b"Fr\x84ser \xF1 0.1"),
            ("CP852", "Fréza, průměr", b"Fr\x82za, pr\x85m\xD8r"),
            ("cp866", "ДЕТАЛЬ", b"\x84\x85\x92\x80\x8B\x9C"),
            ("windows-1251", "СТОП", b"\xD1\xD2\xCE\xCF"),
            ("koi8-r", "СТОП", b"\xF3\xF4\xEF\xF0"),
            ("shift_jis", "部品", b"\x95\x94\x95\x69"),
            ("gbk", "刀具", b"\xB5\xB6\xBE\xDF"),
            ("euc-kr", "공구", b"\xB0\xF8\xB1\xB8"),
            ("big5", "刀具", b"\xA4\x4D\xA8\xE3"),
            ("UTF-8", "刀", b"\xE5\x88\x80"),
        ] {
            assert_eq!(page(label).encode(text).as_deref(), Ok(bytes), "{label}");
            assert_eq!(page(label).decode(bytes).as_deref(), Some(text), "{label}");
        }
    }

    #[test]
    fn the_first_letter_that_a_page_lacks_is_named() {
        for (label, text, lacks) in [
            ("windows-1252", "Ä刀具", '刀'),
            ("iso-8859-1", "5 €", '€'),
            ("cp437", "Ø", 'Ø'),
            ("shift_jis", "部 Ä", 'Ä'),
            // Bytes that a control would show as another character.
            ("shift_jis", "¥ 5", '¥'),
            ("windows-1252", "\u{fffd}", '\u{fffd}'),
            ("windows-1252", "\u{81}", '\u{81}'),
        ] {
            assert_eq!(page(label).encode(text), Err(lacks), "{label}");
        }
    }

    #[test]
    fn each_byte_of_a_page_reads_back() {
        for page in CodePage::all() {
            for byte in 0..=255 {
                if let Some(text) = page.decode(&[byte]) {
                    assert_eq!(page.encode(&text).as_deref(), Ok(&[byte][..]), "{page} {byte:#x}");
                }
            }
            if let Kind::Single(upper) = page.0.kind {
                assert_eq!(upper.chars().count(), 128, "{page}");
            }
        }
    }

    #[test]
    fn tables_are_those_of_the_web_where_it_has_them() {
        for page in CodePage::all() {
            let (Kind::Single(upper), Some(web)) =
                (&page.0.kind, Encoding::for_label(page.name().as_bytes()))
            else {
                continue;
            };
            // What the web calls ISO 8859-1 and -9 are pages of Windows; below 160 they differ.
            let first = if page.name().starts_with("iso") { 160 } else { 128 };
            for byte in first..=255u8 {
                let own = letter_of(byte, upper);
                let bytes = [byte];
                let (text, malformed) = web.decode_without_bom_handling(&bytes);
                let theirs = text.chars().next().filter(|at| !malformed && !at.is_control());
                let private = theirs.is_some_and(|at| ('\u{e000}'..'\u{f900}').contains(&at));
                // The web gives a letter of Hebrew to a byte that Windows leaves open.
                let theirs = theirs.filter(|_| !private && (own.is_some() || byte != 0xCA));
                assert_eq!(own, theirs, "{page} {byte:#x}");
            }
        }
    }

    #[test]
    fn bytes_without_meaning_stay_apart() {
        let page = page("windows-1252");
        assert_eq!(page.decode(b"\x81"), None);
        assert_ne!(page.decode_all(b"(\x81)"), page.decode_all(b"(\x8D)"));
        assert_eq!(CodePage::UTF_8.decode_all(b"(\xC4)"), "(\u{f7c4})");
        assert_eq!(shown(&CodePage::UTF_8.decode_all(b"(\xC4)")), "(\\xC4)");
    }

    #[test]
    fn labels() {
        for (label, name) in [
            ("1252", "windows-1252"),
            ("CP1252", "windows-1252"),
            (" ms932 ", "shift_jis"),
            ("Shift_JIS", "shift_jis"),
            ("sjis", "shift_jis"),
            ("utf8", "UTF-8"),
            ("cp65001", "UTF-8"),
            ("ibm-850", "cp850"),
        ] {
            assert_eq!(page(label).name(), name);
            assert_eq!(CodePage::numbered(page(label).number()), Some(page(label)));
        }
        for label in ["klingon", "0", "cp0", "", "cp", "850x", "utf-16le", "cp99999"] {
            assert_eq!(CodePage::named(label), None, "{label}");
        }
    }
}
