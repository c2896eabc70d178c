//! The server: who may ask, and what is answered.

use std::io::Read;
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use filpost::Error;
use serde_json::{Value, json};

use crate::folder::Folder;
use crate::http::{self, Refusal, Request};
use crate::page;
use crate::presence::Presence;
use crate::texts::Texts;
use crate::works::Works;

/// Most connections at a time.
const MOST_CONNECTIONS: usize = 64;

/// How long a page may take to send a request, or to take an answer.
const PATIENCE: Duration = Duration::from_secs(30);

/// Stack of the thread of a request: that of a main thread, as the parsers are made for one.
const STACK: usize = 8 << 20;

/// Random bytes in the address.
const TOKEN_BYTES: usize = 24;

const JSON: &str = "application/json";
const TEXT: &str = "text/plain; charset=utf-8";

/// A studio that listens.
pub struct Studio {
    listener: TcpListener,
    desk: Arc<Desk>,
}

/// What all requests share.
struct Desk {
    folder: Folder,
    token: String,
    /// `127.0.0.1:PORT`.
    host: String,
    presence: Presence,
    works: Works,
    texts: Texts,
    connections: AtomicUsize,
}

impl Studio {
    /// Opens a folder, which is made where it is not there, and listens on the loopback
    /// address; port 0 is any that is free.
    ///
    /// # Errors
    /// A folder that can't be made or read; a port that is taken; a system without random
    /// numbers.
    pub fn open(folder: &Path, port: u16) -> Result<Studio, Error> {
        let cant = |error: &std::io::Error| {
            filpost::files::cant_read(Path::new(&format!("127.0.0.1:{port}")), error)
        };
        let folder = Folder::open(folder)?;
        let listener =
            TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|error| cant(&error))?;
        let host = listener.local_addr().map_err(|error| cant(&error))?.to_string();
        let token = token().map_err(|error| cant(&error))?;
        let desk = Desk {
            folder,
            token,
            host,
            presence: Presence::default(),
            works: Works::default(),
            texts: Texts::default(),
            connections: AtomicUsize::new(0),
        };
        Ok(Studio { listener, desk: Arc::new(desk) })
    }

    /// The address of the page, with its token.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.desk.host, self.desk.token)
    }

    /// Answers in threads of its own until the last page is closed.
    pub fn serve(self) {
        let Studio { listener, desk } = self;
        let answering = Arc::clone(&desk);
        // It ends with the process: a connection that is taken is always answered.
        thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                take(&answering, stream);
            }
        });
        desk.presence.wait_for_the_end();
    }
}

/// Answers a connection in a thread of its own.
fn take(desk: &Arc<Desk>, mut stream: TcpStream) {
    if desk.connections.fetch_add(1, Ordering::SeqCst) >= MOST_CONNECTIONS {
        desk.connections.fetch_sub(1, Ordering::SeqCst);
        refuse(&mut stream, Refusal::Unavailable);
        return;
    }
    let own = Arc::clone(desk);
    let answer = move || {
        own.answer(&mut stream);
        own.connections.fetch_sub(1, Ordering::SeqCst);
    };
    if thread::Builder::new().stack_size(STACK).spawn(answer).is_err() {
        desk.connections.fetch_sub(1, Ordering::SeqCst);
    }
}

fn refuse(stream: &mut TcpStream, refusal: Refusal) {
    http::write(stream, refusal.status(), TEXT, refusal.status().as_bytes());
    // What was not read would break the connection before its answer is read.
    let _ = stream.set_read_timeout(Some(Duration::from_millis(200)));
    let _ = std::io::copy(&mut stream.take(1 << 20), &mut std::io::sink());
}

impl Desk {
    fn answer(&self, stream: &mut TcpStream) {
        let _ = stream.set_read_timeout(Some(PATIENCE));
        let _ = stream.set_write_timeout(Some(PATIENCE));
        let _ = stream.set_nodelay(true);
        if let Err(refusal) = self.try_answer(stream) {
            refuse(stream, refusal);
        }
    }

    fn try_answer(&self, stream: &mut TcpStream) -> Result<(), Refusal> {
        let request = http::read(stream)?;
        let name = self.admit(&request)?;
        match (request.method.as_str(), name) {
            ("GET", "alive") => self.stay(stream),
            ("GET", name) => {
                let (kind, bytes) = page::file(name).ok_or(Refusal::NotFound)?;
                http::write(stream, "200 OK", kind, bytes);
            }
            ("POST", "ask") => {
                let answer = self.ask(&request.body)?;
                http::write(stream, "200 OK", JSON, answer.to_string().as_bytes());
            }
            _ => return Err(Refusal::NotFound),
        }
        Ok(())
    }

    /// The name behind the token, for who may ask: the page itself, or the browser that opens it.
    fn admit<'r>(&self, request: &'r Request) -> Result<&'r str, Refusal> {
        let path = request.path.strip_prefix('/').ok_or(Refusal::Forbidden)?;
        let (token, name) = path.split_once('/').ok_or(Refusal::Forbidden)?;
        if !is_same(token, &self.token) || request.header("host") != Some(self.host.as_str()) {
            return Err(Refusal::Forbidden);
        }
        let own = format!("http://{}", self.host);
        let from_page = request.header("origin") == Some(own.as_str());
        if !from_page && (request.has("origin") || request.method != "GET") {
            return Err(Refusal::Forbidden);
        }
        match request.header("sec-fetch-site") {
            Some("same-origin" | "none") => {}
            None if !request.has("sec-fetch-site") => {}
            _ => return Err(Refusal::Forbidden),
        }
        if request.method == "POST" && request.header("content-type") != Some(JSON) {
            return Err(Refusal::Forbidden);
        }
        Ok(name)
    }

    /// Holds the connection of an open page until it closes.
    fn stay(&self, stream: &mut TcpStream) {
        if http::begin_stream(stream).is_err() {
            return;
        }
        self.presence.enter();
        let _ = stream.set_read_timeout(None);
        let mut byte = [0];
        while matches!(stream.read(&mut byte), Ok(1)) {}
        self.presence.leave();
    }

    fn ask(&self, body: &[u8]) -> Result<Value, Refusal> {
        let mut request: Value = serde_json::from_slice(body).map_err(|_| Refusal::Malformed)?;
        if self.texts.put_into(&mut request).is_err() {
            return Ok(json!({ "unkept": true }));
        }
        let own = self.folder.answer(&request).or_else(|| self.works.answer(&request));
        if let Some(answer) = own {
            return Ok(answer);
        }
        let names = request.as_object_mut().and_then(|fields| fields.remove("names"));
        let mut answer = self.works.watched(request, |request, watch| {
            // A fault of one request must not end the studio with what is not saved in its page.
            let work = AssertUnwindSafe(|| filpost_wasm::answer_watched(request, watch));
            catch_unwind(work)
                .unwrap_or_else(|_| json!({ "failure": "an internal fault of filpost" }))
        });
        if let Some(names) = names {
            self.texts.name_in(&mut answer, names);
        }
        Ok(answer)
    }
}

/// Compares two texts in a time that does not tell where they differ.
fn is_same(a: &str, b: &str) -> bool {
    let differing = a.bytes().zip(b.bytes()).fold(0, |sum, (a, b)| sum | (a ^ b));
    a.len() == b.len() && differing == 0
}

fn token() -> std::io::Result<String> {
    let mut bytes = [0; TOKEN_BYTES];
    getrandom::fill(&mut bytes).map_err(std::io::Error::other)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}
