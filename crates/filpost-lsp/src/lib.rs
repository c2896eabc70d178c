//! The language server: `fil-ide` behind the language server protocol, over standard input
//! and output, one request after the other.
//!
//! **Goal.** FIL files, `machine.toml` and CL files in an editor: what is wrong while it is typed,
//! with repairs, hover, completion, names, symbols, formatting, and the program of a case beside it.
//!
//! **Model.** [`serve_stdio`] is what `filpost lsp` runs; [`serve`] takes a connection of the
//! `lsp-server` crate, for a server inside another program; [`Server`] answers requests one after
//! the other. Positions are lines and UTF-16 units, as the protocol has them; files are
//! `file:` addresses.
//!
//! **Quick start.** In a program that is started by an editor:
//!
//! ```no_run
//! fn main() -> Result<(), String> {
//!     filpost_lsp::serve_stdio()
//! }
//! ```
//!
//! **Limits.** One editor a process; the analysis is that of `fil-ide`. The messages are made and read as
//! JSON values, since the types of the whole protocol take 19 s to compile; the tests read each message
//! back as its type.
//!
//! A tool of [filpost](https://crates.io/crates/filpost), without an API of its own: its items may
//! change in any version.

mod answer;
mod capabilities;
mod cases;
mod documents;
mod last_run;
mod preview;
mod server;
mod uri;
mod wire;

use std::collections::HashMap;
use std::path::PathBuf;

use filpost::CancelToken;
use lsp_server::{Connection, Message, Notification, Request, Response};

pub use preview::Preview;
pub use server::{Fault, Server};

/// Serves one editor over standard input and output until it says exit.
///
/// # Errors
/// What went wrong with the connection, in a sentence.
pub fn serve_stdio() -> Result<(), String> {
    let (connection, editor) = Connection::memory();
    let threads = wire::threads(editor);
    let served = serve(&connection);
    drop(connection);
    // What ended the input says more than that the connection has ended.
    if served.is_err() && !threads.input_has_ended() { served } else { threads.join().and(served) }
}

/// Serves one editor over a connection.
///
/// # Errors
/// What went wrong with the connection, in a sentence.
pub fn serve(connection: &Connection) -> Result<(), String> {
    let params = connection.initialize(capabilities::own()).map_err(|error| error.to_string())?;
    let mut server = Server::new(&params);
    let mut posting: HashMap<PathBuf, CancelToken> = HashMap::new();
    for message in &connection.receiver {
        match message {
            Message::Request(request) => {
                if connection.handle_shutdown(&request).map_err(|error| error.to_string())? {
                    posting.values().for_each(CancelToken::cancel);
                    return Ok(());
                }
                if request.method == PREVIEW {
                    post_aside(connection, &server, request, &mut posting)?;
                    continue;
                }
                let response = match server.request(&request.method, &request.params) {
                    Ok(value) => Response::new_ok(request.id, value),
                    Err(fault) => Response::new_err(request.id, fault.code, fault.message),
                };
                send(connection, Message::Response(response))?;
            }
            Message::Notification(notification) => {
                for (method, params) in
                    server.notification(&notification.method, &notification.params)
                {
                    let message = Message::Notification(Notification { method, params });
                    send(connection, message)?;
                }
            }
            Message::Response(_) => {}
        }
    }
    Ok(())
}

/// The request for a case as it stands in the editor, posted.
const PREVIEW: &str = "filpost/preview";

/// Posts a case in a thread of its own: a long part holds up no keystroke. Of the previews of a
/// case only the last one counts; the one before is ended.
fn post_aside(
    connection: &Connection,
    server: &Server,
    request: Request,
    posting: &mut HashMap<PathBuf, CancelToken>,
) -> Result<(), String> {
    let preview = match server.preview(&request.params) {
        Ok(preview) => preview,
        Err(fault) => {
            let response = Response::new_err(request.id, fault.code, fault.message);
            return send(connection, Message::Response(response));
        }
    };
    let (sender, token) = (connection.sender.clone(), CancelToken::new());
    if let Some(before) = posting.insert(preview.case.clone(), token.clone()) {
        before.cancel();
    }
    std::thread::spawn(move || {
        let response = Response::new_ok(request.id, preview.answer(&token));
        // An editor that is gone asks for nothing.
        let _ = sender.send(Message::Response(response));
    });
    Ok(())
}

fn send(connection: &Connection, message: Message) -> Result<(), String> {
    connection.sender.send(message).map_err(|error| error.to_string())
}
