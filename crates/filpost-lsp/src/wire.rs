//! Messages of an editor on standard input and output, none longer than there is room for.

use std::io::{self, BufRead, Read};
use std::thread::{self, JoinHandle};

use lsp_server::{Connection, Message};

/// No message of an editor is longer.
const LONGEST: u64 = 64 << 20;

/// Longest line of the head of a message.
const LONGEST_HEAD: u64 = 4096;

/// The threads between an editor and the server.
pub struct Threads {
    reading: JoinHandle<Result<(), String>>,
    writing: JoinHandle<io::Result<()>>,
}

/// Reads and writes for this end of the connection.
pub fn threads(editor: Connection) -> Threads {
    let Connection { sender, receiver } = editor;
    let reading = thread::spawn(move || {
        let mut input = io::stdin().lock();
        while let Some(message) = read(&mut input)? {
            let is_exit = matches!(&message, Message::Notification(told) if told.method == "exit");
            if sender.send(message).is_err() || is_exit {
                break;
            }
        }
        Ok(())
    });
    let writing = thread::spawn(move || {
        let mut output = io::stdout().lock();
        receiver.into_iter().try_for_each(|message| message.write(&mut output))
    });
    Threads { reading, writing }
}

impl Threads {
    /// True when nothing more comes from the editor.
    pub fn input_has_ended(&self) -> bool {
        self.reading.is_finished()
    }

    /// Waits for what is still to be written, and for the editor to leave.
    ///
    /// # Errors
    /// A message that is invalid or too long; an output that is closed.
    pub fn join(self) -> Result<(), String> {
        let fault = "a thread has failed".to_string();
        self.reading.join().map_err(|_| fault.clone())??;
        self.writing.join().map_err(|_| fault)?.map_err(|error| error.to_string())
    }
}

/// The next message; `None` at the end of the input.
///
/// # Errors
/// A header without a length; a message that is invalid or too long.
fn read(input: &mut impl BufRead) -> Result<Option<Message>, String> {
    let mut length = None;
    loop {
        let mut line = String::new();
        let read = input.by_ref().take(LONGEST_HEAD).read_line(&mut line);
        if read.map_err(|error| error.to_string())? == 0 {
            return Ok(None);
        }
        let line = line.trim();
        if line.is_empty() {
            break;
        }
        let head = line.split_once(':');
        let head = head.filter(|(name, _)| name.trim().eq_ignore_ascii_case("content-length"));
        if let Some((_, value)) = head {
            let number = value.trim().parse::<u64>();
            length = Some(number.map_err(|_| format!("`{line}` is no length"))?);
        }
    }
    let length = length.ok_or("a message without Content-Length")?;
    if length > LONGEST {
        return Err(format!("a message of {length} bytes; {LONGEST} are the most"));
    }
    let mut body = Vec::new();
    input.take(length).read_to_end(&mut body).map_err(|error| error.to_string())?;
    serde_json::from_slice(&body).map(Some).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_read_and_what_is_none_is_refused() {
        let body = r#"{"jsonrpc":"2.0","method":"exit"}"#;
        let text = format!("Content-Length: {}\r\n\r\n{body}", body.len());
        let mut input = text.as_bytes();
        assert!(matches!(read(&mut input), Ok(Some(Message::Notification(_)))));
        assert!(matches!(read(&mut input), Ok(None)));
        for text in ["\r\n", "Content-Length: x\r\n\r\n", "Content-Length: 9\r\n\r\n{}"] {
            assert!(read(&mut text.as_bytes()).is_err(), "{text:?}");
        }
        let huge = "Content-Length: 99999999999999\r\n\r\n{}";
        assert!(read(&mut huge.as_bytes()).expect_err("refused").contains("99999999999999"));
    }
}
