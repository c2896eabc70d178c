//! As much of HTTP/1.1 as a page on this computer needs: one request a connection.

use std::io::{Read, Write};

/// Longest head of a request, bytes.
const LONGEST_HEAD: usize = 16 << 10;

/// Longest body of a request, bytes: a CL file of 60 MB as JSON.
pub(crate) const LONGEST_BODY: usize = 128 << 20;

/// A request.
#[derive(Debug)]
pub(crate) struct Request {
    pub method: String,
    pub path: String,
    headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

impl Request {
    /// The value of a header, by its name in small letters. A header that is there twice has none, so that
    /// no two readers can take different ones.
    pub fn header(&self, name: &str) -> Option<&str> {
        let mut found = self.headers.iter().filter(|(own, _)| own == name);
        let first = found.next()?;
        found.next().is_none().then_some(first.1.as_str())
    }

    /// True when a header is there, once or more often.
    pub fn has(&self, name: &str) -> bool {
        self.headers.iter().any(|(own, _)| own == name)
    }
}

/// Why a request is not answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Refusal {
    /// It is no request of HTTP/1.1.
    Malformed,
    /// Its head or its body is too long.
    TooLarge,
    /// It lacks the token, or comes from another page.
    Forbidden,
    /// There is nothing of this name.
    NotFound,
    /// The connection broke, or too many are open.
    Unavailable,
}

impl Refusal {
    /// Number and words of the status line.
    pub fn status(self) -> &'static str {
        match self {
            Refusal::Malformed => "400 Bad Request",
            Refusal::TooLarge => "413 Content Too Large",
            Refusal::Forbidden => "403 Forbidden",
            Refusal::NotFound => "404 Not Found",
            Refusal::Unavailable => "503 Service Unavailable",
        }
    }
}

/// Reads one request.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn read(stream: &mut impl Read) -> Result<Request, Refusal> {
    let (head, begun) = read_head(stream)?;
    let mut request = parse_head(&head)?;
    if request.has("transfer-encoding") {
        return Err(Refusal::Malformed);
    }
    let length = match request.header("content-length") {
        Some(text) if text.bytes().all(|byte| byte.is_ascii_digit()) => {
            text.parse().map_err(|_| Refusal::TooLarge)?
        }
        None if !request.has("content-length") => 0,
        _ => return Err(Refusal::Malformed),
    };
    request.body = read_body(stream, begun, length)?;
    Ok(request)
}

/// The head without its empty line, and what was read of the body.
fn read_head(stream: &mut impl Read) -> Result<(Vec<u8>, Vec<u8>), Refusal> {
    let mut read = Vec::new();
    let mut piece = [0; 4096];
    loop {
        let length = stream.read(&mut piece).map_err(|_| Refusal::Unavailable)?;
        if length == 0 {
            return Err(Refusal::Malformed);
        }
        read.extend_from_slice(&piece[..length]);
        if let Some(end) = read.windows(4).position(|four| four == b"\r\n\r\n") {
            let body = read.split_off(end + 4);
            read.truncate(end);
            return Ok((read, body));
        }
        if read.len() > LONGEST_HEAD {
            return Err(Refusal::TooLarge);
        }
    }
}

fn parse_head(head: &[u8]) -> Result<Request, Refusal> {
    let text = std::str::from_utf8(head).map_err(|_| Refusal::Malformed)?;
    let mut lines = text.split("\r\n");
    let mut first = lines.next().unwrap_or_default().split(' ');
    let (Some(method), Some(path), Some("HTTP/1.1"), None) =
        (first.next(), first.next(), first.next(), first.next())
    else {
        return Err(Refusal::Malformed);
    };
    let header = |line: &str| {
        let (name, value) = line.split_once(':').ok_or(Refusal::Malformed)?;
        if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_graphic()) {
            return Err(Refusal::Malformed);
        }
        Ok((name.to_ascii_lowercase(), value.trim().to_string()))
    };
    Ok(Request {
        method: method.to_string(),
        path: path.to_string(),
        headers: lines.map(header).collect::<Result<_, _>>()?,
        body: Vec::new(),
    })
}

fn read_body(stream: &mut impl Read, begun: Vec<u8>, length: usize) -> Result<Vec<u8>, Refusal> {
    if length > LONGEST_BODY {
        return Err(Refusal::TooLarge);
    }
    if begun.len() > length {
        return Err(Refusal::Malformed);
    }
    let mut body = begun;
    let rest = (length - body.len()) as u64;
    stream.take(rest).read_to_end(&mut body).map_err(|_| Refusal::Unavailable)?;
    if body.len() == length { Ok(body) } else { Err(Refusal::Malformed) }
}

/// What every answer says: nothing comes from elsewhere, and nobody else may use it. Styles may stand in the page, as
/// its editor makes some; scripts may not.
const SAFETY: &str = "Content-Security-Policy: default-src 'none'; script-src 'self'; \
    style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
    Cross-Origin-Resource-Policy: same-origin\r\n\
    Cross-Origin-Opener-Policy: same-origin\r\n\
    Referrer-Policy: no-referrer\r\n\
    X-Content-Type-Options: nosniff\r\n\
    Cache-Control: no-store\r\n\
    Connection: close\r\n";

/// Writes an answer. A page that no longer listens gets none.
pub(crate) fn write(stream: &mut impl Write, status: &str, kind: &str, body: &[u8]) {
    let length = body.len();
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{SAFETY}\r\n"
    );
    let written = stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(body));
    let _ = written.and_then(|()| stream.flush());
}

/// Begins an answer that lasts as long as its page is open.
pub(crate) fn begin_stream(stream: &mut impl Write) -> std::io::Result<()> {
    let head = format!("HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n{SAFETY}\r\n");
    stream.write_all(head.as_bytes())?;
    stream.write_all(b": here\n\n")?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> Option<Refusal> {
        read(&mut text.as_bytes()).err()
    }

    #[test]
    fn a_request_is_read() {
        let text = "POST /x HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\n\r\nabc";
        let request = read(&mut text.as_bytes()).unwrap();
        assert_eq!((request.method.as_str(), request.path.as_str()), ("POST", "/x"));
        assert_eq!(request.header("host"), Some("a"));
        assert_eq!(request.body, b"abc");
    }

    #[test]
    fn what_two_readers_could_take_differently_is_refused() {
        for text in [
            "GET /\r\n\r\n",
            "GET / HTTP/1.0\r\n\r\n",
            "GET /a b HTTP/1.1\r\n\r\n",
            "GET / HTTP/1.1\r\nHost\r\n\r\n",
            "GET / HTTP/1.1\r\nHo st: a\r\n\r\n",
            "GET / HTTP/1.1\r\n",
            "POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\nab",
            "POST / HTTP/1.1\r\nContent-Length: +1\r\n\r\na",
            "POST / HTTP/1.1\r\nContent-Length: 1\r\n\r\nab",
            "POST / HTTP/1.1\r\nContent-Length: 3\r\n\r\nab",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
        ] {
            assert_eq!(refused(text), Some(Refusal::Malformed), "{text:?}");
        }
    }

    #[test]
    fn what_is_too_long_is_refused_before_it_is_read() {
        let head = format!("GET / HTTP/1.1\r\nX: {}", "x".repeat(2 * LONGEST_HEAD));
        assert_eq!(refused(&head), Some(Refusal::TooLarge));
        for length in [(LONGEST_BODY + 1).to_string(), "9".repeat(40)] {
            let text = format!("POST / HTTP/1.1\r\nContent-Length: {length}\r\n\r\n");
            assert_eq!(refused(&text), Some(Refusal::TooLarge));
        }
    }

    #[test]
    fn a_header_that_is_there_twice_has_no_value() {
        let text = "GET / HTTP/1.1\r\nHost: a\r\nhost: b\r\n\r\n";
        let request = read(&mut text.as_bytes()).unwrap();
        assert_eq!((request.header("host"), request.has("host")), (None, true));
    }
}
