//! Makes text of the bytes of a file.
//!
//! Without a name for the encoding: a byte order mark decides; text that is
//! valid UTF-8 is UTF-8; all else is taken for one of windows-1251, KOI8-R and
//! windows-1252 by what its bytes above 127 would spell:
//!
//! * In a western text such letters stand beside ASCII letters, in a Cyrillic
//!   one beside each other and never in a word with ASCII letters. When those
//!   beside ASCII letters are not fewer, the text is windows-1252.
//! * windows-1251 and KOI8-R have the same bytes for letters in another order
//!   and with the cases swapped. The text is read both ways; each letter counts
//!   for how common it is in Russian and Bulgarian, an upper-case letter right
//!   after a lower-case one counts against. The higher sum wins, windows-1251
//!   when they are equal.

use std::borrow::Cow;

use encoding_rs::{Encoding, KOI8_R, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1251, WINDOWS_1252};
use fil_diag::Diag;
use fil_text::CodePage;

use crate::errors::SyntaxCode;
use crate::message::quote;

/// The bytes of a file as text, and the name of the encoding it was read in.
///
/// `encoding` is a label such as `utf-8`, `cp1251`, `cp932`, `cp850` or `koi8-r`; without it
/// the encoding is guessed. A byte order mark is dropped.
///
/// # Errors
/// A label that names no encoding, or bytes that mean nothing in the encoding
/// asked for. The diagnostic has no place, the bytes having no lines yet.
pub fn decode<'b>(
    bytes: &'b [u8],
    encoding: Option<&str>,
) -> Result<(Cow<'b, str>, &'static str), Diag> {
    let Some(label) = encoding else {
        let (text, used, _) = guess(bytes).decode(bytes);
        return Ok((text, used.name()));
    };
    let page = CodePage::named(label);
    if let Some(page) = page.filter(is_of_consoles) {
        let text = page.decode(bytes).ok_or_else(|| malformed_text(page.name()))?;
        return Ok((text, page.name()));
    }
    let web = page.map_or(label, |page| page.name());
    let asked = Encoding::for_label(web.as_bytes()).ok_or_else(|| {
        Diag::new(SyntaxCode::UnknownEncoding, format!("{} is no known encoding", quote(label)))
    })?;
    let (text, malformed) = asked.decode_with_bom_removal(bytes);
    if malformed {
        return Err(malformed_text(asked.name()));
    }
    Ok((text, asked.name()))
}

/// The pages of Windows' consoles, which the web does not have.
fn is_of_consoles(page: &CodePage) -> bool {
    page.name().starts_with("cp")
}

fn malformed_text(encoding: &str) -> Diag {
    Diag::new(SyntaxCode::WrongEncoding, format!("the text is not valid {encoding}"))
}

/// A text as the bytes of an encoding, by the name that [`decode`] gave;
/// `None` where the encoding lacks a character of the text.
pub(crate) fn encode<'t>(text: &'t str, encoding: &str) -> Option<Cow<'t, [u8]>> {
    if let Some(page) = CodePage::named(encoding).filter(is_of_consoles) {
        return page.encode(text).ok();
    }
    let encoding = Encoding::for_label(encoding.as_bytes())?;
    if encoding == UTF_16LE {
        return Some(text.encode_utf16().flat_map(u16::to_le_bytes).collect());
    }
    if encoding == UTF_16BE {
        return Some(text.encode_utf16().flat_map(u16::to_be_bytes).collect());
    }
    let (bytes, _, unmappable) = encoding.encode(text);
    (!unmappable).then_some(bytes)
}

/// The encoding of a file without a name for it.
fn guess(bytes: &[u8]) -> &'static Encoding {
    if let Some((marked, _)) = Encoding::for_bom(bytes) {
        return marked;
    }
    if std::str::from_utf8(bytes).is_ok() {
        return UTF_8;
    }
    if !letters_stand_together(bytes) {
        return WINDOWS_1252;
    }
    if score(bytes, KOI8_R) > score(bytes, WINDOWS_1251) { KOI8_R } else { WINDOWS_1251 }
}

/// True when more of the bytes that are Cyrillic letters in both code pages
/// stand in words of their own kind than in words with ASCII letters.
fn letters_stand_together(bytes: &[u8]) -> bool {
    let beside = |at: usize, is: fn(u8) -> bool| {
        let before = at.checked_sub(1).and_then(|at| bytes.get(at));
        before.is_some_and(|byte| is(*byte)) || bytes.get(at + 1).is_some_and(|byte| is(*byte))
    };
    let (mut western, mut cyrillic) = (0u64, 0u64);
    for (at, _) in bytes.iter().enumerate().filter(|(_, byte)| **byte >= 0xC0) {
        if beside(at, |byte| byte.is_ascii_alphabetic()) {
            western += 1;
        } else if beside(at, |byte| byte >= 0xC0) {
            cyrillic += 1;
        }
    }
    cyrillic > western
}

/// How much like Russian or Bulgarian the bytes look in an encoding.
fn score(bytes: &[u8], encoding: &'static Encoding) -> i64 {
    let (text, _) = encoding.decode_without_bom_handling(bytes);
    let mut total = 0;
    let mut after_lower = false;
    for letter in text.chars() {
        if after_lower && letter.is_uppercase() {
            total -= 5;
        }
        total += commonness(letter);
        after_lower = letter.is_lowercase() && !letter.is_ascii();
    }
    total
}

/// A rough rank of a Cyrillic letter: 3 for the most common, 0 for no letter.
fn commonness(letter: char) -> i64 {
    match letter.to_lowercase().next().unwrap_or(letter) {
        'о' | 'е' | 'а' | 'и' | 'н' | 'т' => 3,
        'с' | 'р' | 'в' | 'л' | 'к' | 'м' | 'д' | 'п' => 2,
        'у' | 'я' | 'ы' | 'ь' | 'ъ' | 'г' | 'з' | 'б' | 'ч' | 'й' => 1,
        'х' | 'ж' | 'ш' | 'ю' | 'ц' | 'щ' | 'э' | 'ф' | 'ё' => -1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use encoding_rs::SHIFT_JIS;

    use super::*;

    fn guessed(text: &str, encoding: &'static Encoding) -> (String, &'static str) {
        let (bytes, _, unmappable) = encoding.encode(text);
        assert!(!unmappable, "{text} cannot be written in {}", encoding.name());
        let (text, name) = decode(&bytes, None).expect("a guess always succeeds");
        (text.into_owned(), name)
    }

    #[test]
    fn cyrillic_comments_are_told_apart() {
        let samples = [
            "X=1 $$ начална точка на резбата по ос X",
            "PPRINT ФРЕЗА КОНЦЕВАЯ ДИАМЕТР 20",
            "A=5 $$ стъпка",
            "PPRINT Чистовая обработка паза, шаг 0.5",
            "PPRINT ЪГЪЛ ПРИ ВЪРХА НА РЕЗБАТА",
        ];
        for sample in samples {
            for encoding in [WINDOWS_1251, KOI8_R, UTF_8] {
                let expected = (sample.to_string(), encoding.name());
                assert_eq!(guessed(sample, encoding), expected);
            }
        }
    }

    #[test]
    fn single_letters_between_ascii_are_western() {
        for sample in ["PPRINT Fräser für Nut, 90° größer", "$$ pièce usinée à l'été"] {
            assert_eq!(guessed(sample, WINDOWS_1252), (sample.to_string(), "windows-1252"));
        }
    }

    #[test]
    fn a_byte_order_mark_is_dropped() {
        let (text, name) = decode(b"\xEF\xBB\xBFFINI", None).expect("UTF-8");
        assert_eq!((text.as_ref(), name), ("FINI", "UTF-8"));
        let (text, name) = decode(b"\xFF\xFEF\0I\0", None).expect("UTF-16");
        assert_eq!((text.as_ref(), name), ("FI", "UTF-16LE"));
    }

    #[test]
    fn a_label_overrides_the_guess() {
        let (text, name) = decode(b"\xC0", Some("koi8-r")).expect("a letter");
        assert_eq!((text.as_ref(), name), ("ю", "KOI8-R"));
        let (text, name) = decode(b"\xC0", Some("CP1251")).expect("a letter");
        assert_eq!((text.as_ref(), name), ("А", "windows-1251"));
    }

    #[test]
    fn texts_of_windows_are_read_in_the_page_that_is_named() {
        let part = "PPRINT 部品 能表ソ";
        let (bytes, _, unmappable) = SHIFT_JIS.encode(part);
        // The second byte of some of its characters is that of `\\`.
        assert!(!unmappable && bytes.contains(&b'\\'));
        for label in ["cp932", "932", "shift_jis", "ms932"] {
            let (text, name) = decode(&bytes, Some(label)).expect("Japanese");
            assert_eq!((text.as_ref(), name), (part, "Shift_JIS"), "{label}");
        }
        let dos = decode(b"PPRINT \x94RJE, \x84\x81\r\n", Some("cp850")).expect("a page of DOS");
        assert_eq!(dos, ("PPRINT öRJE, äü\r\n".into(), "cp850"));
        let russian = decode(b"\x84\x85\x92\x80\x8B\x9C", Some("cp866")).expect("Russian DOS");
        assert_eq!(russian, ("ДЕТАЛЬ".into(), "cp866"));
        assert_eq!(encode("ö", "cp850").as_deref(), Some(&b"\x94"[..]));
    }

    #[test]
    fn unknown_labels_and_wrong_bytes_are_refused() {
        let unknown = decode(b"FINI", Some("klingon")).expect_err("no such encoding");
        assert_eq!(unknown.code.number, 120);
        let wrong = decode(b"\xC0", Some("utf-8")).expect_err("not UTF-8");
        assert_eq!(wrong.code.number, 121);
    }
}
