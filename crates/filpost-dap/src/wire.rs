//! Messages on the wire: a header with the length, then JSON.

use std::io::{BufRead, Write};

use serde_json::Value;

/// No request of a debugger is longer.
const LONGEST: usize = 64 << 20;

/// The next message; `None` at the end of the input.
///
/// # Errors
/// A header that gives no length, a body that is too long or no JSON, in a sentence.
pub fn read(input: &mut impl BufRead) -> Result<Option<Value>, String> {
    let mut length = None;
    loop {
        let mut line = String::new();
        if input.read_line(&mut line).map_err(|error| error.to_string())? == 0 {
            return Ok(None);
        }
        let line = line.trim();
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.trim().eq_ignore_ascii_case("content-length")
        {
            let number: usize =
                value.trim().parse().map_err(|_| format!("`{line}` is no length"))?;
            length = Some(number);
        }
    }
    let length = length.ok_or("a message without Content-Length")?;
    if length > LONGEST {
        return Err(format!("a message of {length} bytes"));
    }
    let mut body = vec![0; length];
    input.read_exact(&mut body).map_err(|error| error.to_string())?;
    serde_json::from_slice(&body).map(Some).map_err(|error| error.to_string())
}

/// Writes a message. A client that has gone hears nothing: the session ends when its input
/// does.
pub fn write(output: &mut dyn Write, message: &Value) {
    let body = message.to_string();
    let _ = write!(output, "Content-Length: {}\r\n\r\n{body}", body.len());
    let _ = output.flush();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let message = serde_json::json!({ "seq": 1, "text": "Фреза" });
        let mut bytes = Vec::new();
        write(&mut bytes, &message);
        let mut input = &bytes[..];
        assert_eq!(read(&mut input), Ok(Some(message)));
        assert_eq!(read(&mut input), Ok(None));
    }

    #[test]
    fn what_is_no_message_is_refused() {
        for text in ["\r\n", "Content-Length: x\r\n\r\n", "Content-Length: 9\r\n\r\n{}"] {
            assert!(read(&mut text.as_bytes()).is_err(), "{text:?}");
        }
        let huge = format!("Content-Length: {}\r\n\r\n", usize::MAX);
        assert!(read(&mut huge.as_bytes()).is_err());
    }
}
