//! Files as they lie on the disk: their encoding and byte order mark are kept.

use encoding_rs::Encoding;
use fil_diag::{Diag, TextSpan};

use super::format;
use crate::encoding::{decode, encode};
use crate::errors::SyntaxCode;

/// The bytes of a FIL file in its canonical layout, in the encoding they were
/// in and with the byte order mark they had. `encoding` is a label such as
/// `cp1251`; without it the encoding is guessed. A file that has the layout
/// comes back byte by byte.
///
/// # Errors
/// As [`format()`] and [`decode`]; a text with bytes that its encoding has no
/// character for, which could not be written back.
pub fn format_bytes(
    file: &str,
    bytes: &[u8],
    encoding: Option<&str>,
) -> Result<Vec<u8>, Vec<Diag>> {
    let at_start = |diag: Diag| vec![diag.at(TextSpan::line(file, 1, String::new()))];
    let (text, name) = decode(bytes, encoding).map_err(at_start)?;
    let formatted = format(file, &text)?;
    if formatted == text {
        return Ok(bytes.to_vec());
    }
    let mark = match Encoding::for_bom(bytes) {
        Some((marked, length)) if marked.name() == name => &bytes[..length],
        _ => &[],
    };
    let back = |text: &str| Some([mark, &encode(text, name)?].concat());
    if back(&text).is_some_and(|same| same == bytes)
        && let Some(new) = back(&formatted)
    {
        return Ok(new);
    }
    let message = format!("the text is not valid {name} and could not be written back as it was");
    Err(at_start(Diag::new(SyntaxCode::WrongEncoding, message)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn formatted(bytes: &[u8], encoding: Option<&str>) -> Result<Vec<u8>, u16> {
        format_bytes("t.fil", bytes, encoding).map_err(|diags| diags[0].code.number)
    }

    #[test]
    fn encodings_and_marks_are_kept() {
        for label in ["utf-8", "windows-1251", "koi8-r", "utf-16le", "utf-16be"] {
            let bytes = |text| encode(text, label).expect("in the encoding").into_owned();
            let source = bytes("a=1 $$ начална точка на резбата\nFINI\n");
            let expected = bytes("A = 1  $$ начална точка на резбата\nFINI\n");
            assert_eq!(formatted(&source, Some(label)), Ok(expected.clone()), "{label}");
            assert_eq!(formatted(&expected, Some(label)), Ok(expected), "{label}");
        }
        let marked = |text: &[u8]| [b"\xEF\xBB\xBF", text].concat();
        assert_eq!(formatted(&marked(b"fini"), None), Ok(marked(b"FINI\n")));
        let wide = formatted(b"\xFF\xFEf\0i\0n\0i\0", None);
        assert_eq!(wide, Ok(b"\xFF\xFEF\0I\0N\0I\0\n\0".to_vec()));
    }

    #[test]
    fn what_could_not_be_written_back_is_refused() {
        let half = b"\xFF\xFE$\0$\0\x00\xD8\n\0f\0i\0n\0i\0";
        assert_eq!(formatted(half, None), Err(121));
        assert_eq!(formatted(b"$$ \xC0\nfini", Some("utf-8")), Err(121));
        assert_eq!(formatted(b"fini", Some("klingon")), Err(120));
        assert_eq!(formatted(b"A=(", None), Err(101));
    }
}
