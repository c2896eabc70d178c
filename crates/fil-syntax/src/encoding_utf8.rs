//! Makes text of the bytes of a file, where the crate is built without the feature
//! `code-pages`: UTF-8 alone.

use std::borrow::Cow;

use fil_diag::Diag;

use crate::errors::SyntaxCode;
use crate::message::quote;

const NAME: &str = "UTF-8";

/// The bytes of a file as text, and the name of the encoding it was read in, which is
/// UTF-8. A byte order mark is dropped.
///
/// # Errors
/// Another label than `utf-8`, or bytes that are not UTF-8. The diagnostic has no place,
/// the bytes having no lines yet.
pub fn decode<'b>(
    bytes: &'b [u8],
    encoding: Option<&str>,
) -> Result<(Cow<'b, str>, &'static str), Diag> {
    if let Some(label) = encoding
        && !label.eq_ignore_ascii_case(NAME)
        && !label.eq_ignore_ascii_case("utf8")
    {
        let message = format!("{} is not known here, where all text is {NAME}", quote(label));
        return Err(Diag::new(SyntaxCode::UnknownEncoding, message));
    }
    let plain = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(plain).map_err(|_| {
        Diag::new(SyntaxCode::WrongEncoding, format!("the text is not valid {NAME}"))
    })?;
    Ok((text.into(), NAME))
}
