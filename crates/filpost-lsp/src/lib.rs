//! The language server: `fil-ide` behind the language server protocol, over standard input
//! and output, one request after the other.
//!
//! The messages are made and read as JSON values: the types of the whole protocol would
//! cost more time to compile than all else of the command.

mod answer;
mod capabilities;
mod cases;
mod documents;
mod last_run;
mod server;
mod uri;

use lsp_server::{Connection, Message, Notification, Response};

pub use server::{Fault, Server};

/// Serves one editor over standard input and output until it says exit.
///
/// # Errors
/// What went wrong with the connection, in a sentence.
pub fn serve_stdio() -> Result<(), String> {
    let (connection, threads) = Connection::stdio();
    serve(&connection)?;
    drop(connection);
    threads.join().map_err(|error| error.to_string())
}

/// Serves one editor over a connection.
///
/// # Errors
/// What went wrong with the connection, in a sentence.
pub fn serve(connection: &Connection) -> Result<(), String> {
    let params = connection.initialize(capabilities::own()).map_err(|error| error.to_string())?;
    let mut server = Server::new(&params);
    for message in &connection.receiver {
        match message {
            Message::Request(request) => {
                if connection.handle_shutdown(&request).map_err(|error| error.to_string())? {
                    return Ok(());
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

fn send(connection: &Connection, message: Message) -> Result<(), String> {
    connection.sender.send(message).map_err(|error| error.to_string())
}
