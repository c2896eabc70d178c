//! The server as a stranger meets it: who is answered, and what files can be reached.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use filpost_studio::Studio;
use serde_json::{Value, json};
use tempfile::TempDir;

/// A studio that runs, its host and its token.
struct Running {
    folder: TempDir,
    host: String,
    token: String,
    ended: Option<thread::JoinHandle<()>>,
}

impl Running {
    fn start() -> Running {
        let folder = tempfile::tempdir().unwrap();
        let studio = Studio::open(&folder.path().join("post"), 0).unwrap();
        let address = studio.address();
        let rest = address.strip_prefix("http://").unwrap().trim_end_matches('/');
        let (host, token) = rest.split_once('/').unwrap();
        let (host, token) = (host.to_string(), token.to_string());
        let ended = Some(thread::spawn(|| studio.serve()));
        Running { folder, host, token, ended }
    }

    fn post(&self) -> std::path::PathBuf {
        self.folder.path().join("post")
    }

    /// Status and body of an answer to bytes.
    fn send(&self, bytes: &[u8]) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        stream.write_all(bytes).unwrap();
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let answer = String::from_utf8_lossy(&answer);
        let (head, body) = answer.split_once("\r\n\r\n").unwrap_or((&answer, ""));
        (head.split(' ').nth(1).unwrap_or("0").parse().unwrap_or(0), body.to_string())
    }

    /// The status of a request whose lines are given; `HOST`, `TOKEN` and `ORIGIN` stand for the right ones.
    fn status(&self, head: &str, body: &str) -> u16 {
        let head = head
            .replace("ORIGIN", &format!("http://{}", self.host))
            .replace("HOST", &self.host)
            .replace("TOKEN", &self.token);
        let length = if body.is_empty() {
            String::new()
        } else {
            format!("Content-Length: {}\r\n", body.len())
        };
        let lines = head.replace('\n', "\r\n");
        self.send(format!("{lines}\r\n{length}\r\n{body}").as_bytes()).0
    }

    fn ask(&self, request: &Value) -> Value {
        let body = request.to_string();
        let Running { host, token, .. } = self;
        let head = format!(
            "POST /{token}/ask HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n\
             Content-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        );
        let (status, answer) = self.send(head.as_bytes());
        assert_eq!(status, 200, "{answer}");
        serde_json::from_str(&answer).unwrap()
    }

    fn write(&self, name: &str, text: &str) -> Value {
        self.ask(&json!({ "do": "write", "name": name, "text": text }))
    }
}

#[test]
fn the_page_and_its_files_are_there() {
    let studio = Running::start();
    for name in ["", "studio.js", "studio.css"] {
        let head =
            format!("GET /{}/{name} HTTP/1.1\r\nHost: {}\r\n\r\n", studio.token, studio.host);
        let (status, body) = studio.send(head.as_bytes());
        assert_eq!(status, 200, "{name}");
        assert!(body.len() > 500, "{name}: {}", body.len());
    }
    assert_eq!(studio.status("GET /TOKEN/other HTTP/1.1\nHost: HOST", ""), 404);
}

#[test]
fn who_is_not_the_page_is_refused() {
    let studio = Running::start();
    let files = r#"{"do":"files"}"#;
    let json = "Content-Type: application/json";
    let right = format!("POST /TOKEN/ask HTTP/1.1\nHost: HOST\nOrigin: ORIGIN\n{json}");
    assert_eq!(studio.status(&right, files), 200);
    let shorter = &studio.token[1..];
    for head in [
        // No token, another one, a part of it.
        format!("POST /ask HTTP/1.1\nHost: HOST\nOrigin: ORIGIN\n{json}"),
        format!("POST /{}/ask HTTP/1.1\nHost: HOST\nOrigin: ORIGIN\n{json}", "0".repeat(48)),
        format!("POST /{shorter}/ask HTTP/1.1\nHost: HOST\nOrigin: ORIGIN\n{json}"),
        "GET / HTTP/1.1\nHost: HOST".to_string(),
        "GET //TOKEN/ HTTP/1.1\nHost: HOST".to_string(),
        // A name that somebody made lead here.
        format!("POST /TOKEN/ask HTTP/1.1\nHost: evil.example\nOrigin: ORIGIN\n{json}"),
        "GET /TOKEN/ HTTP/1.1\nHost: localhost".to_string(),
        "GET /TOKEN/ HTTP/1.1\nHost: HOST\nHost: evil.example".to_string(),
        "GET /TOKEN/ HTTP/1.1".to_string(),
        // Another page, or a form of one.
        format!("POST /TOKEN/ask HTTP/1.1\nHost: HOST\nOrigin: http://evil.example\n{json}"),
        format!("POST /TOKEN/ask HTTP/1.1\nHost: HOST\nOrigin: null\n{json}"),
        format!("POST /TOKEN/ask HTTP/1.1\nHost: HOST\n{json}"),
        "POST /TOKEN/ask HTTP/1.1\nHost: HOST\nOrigin: ORIGIN\nContent-Type: text/plain"
            .to_string(),
        format!("{right}\nSec-Fetch-Site: cross-site"),
        format!("{right}\nSec-Fetch-Site: same-site"),
        "GET /TOKEN/ HTTP/1.1\nHost: HOST\nOrigin: http://evil.example".to_string(),
        "GET /TOKEN/alive HTTP/1.1\nHost: HOST\nSec-Fetch-Site: cross-site".to_string(),
    ] {
        let body = if head.starts_with("POST") { files } else { "" };
        assert_eq!(studio.status(&head, body), 403, "{head}");
    }
}

#[test]
fn what_is_too_large_is_refused() {
    let studio = Running::start();
    let head = "POST /TOKEN/ask HTTP/1.1\nHost: HOST\nContent-Length: 999999999";
    assert_eq!(studio.status(head, ""), 413);
    let long = format!("GET /TOKEN/ HTTP/1.1\nHost: HOST\nX: {}", "x".repeat(40_000));
    assert_eq!(studio.status(&long, ""), 413);
}

/// Names that lead out of the folder, or are none.
const WRONG_NAMES: [&str; 20] = [
    "",
    ".",
    "..",
    "../out.fil",
    "cases/../../out.fil",
    "/etc/passwd",
    "/tmp/out.fil",
    "a//b.fil",
    "./a.fil",
    ".git/hooks/pre-commit",
    ".bashrc",
    "a/.hidden.fil",
    r"..\out.fil",
    r"a\b.fil",
    "C:/out.fil",
    "nul.fil",
    "cases/com1.nc",
    "a\u{0}.fil",
    "a\n.fil",
    "a.fil ",
];

#[test]
fn no_name_leads_out_of_the_folder() {
    let studio = Running::start();
    std::fs::write(studio.folder.path().join("out.fil"), "outside").unwrap();
    for name in WRONG_NAMES {
        for request in [
            json!({ "do": "read", "name": name }),
            json!({ "do": "write", "name": name, "text": "x" }),
            json!({ "do": "remove", "name": name, "stamp": "0-0" }),
        ] {
            let answer = studio.ask(&request);
            assert!(answer["refused"].is_string(), "{request} gave {answer}");
        }
    }
    assert_eq!(std::fs::read(studio.folder.path().join("out.fil")).unwrap(), b"outside");
    assert_eq!(std::fs::read_dir(studio.post()).unwrap().count(), 0);
    assert_eq!(std::fs::read_dir(studio.folder.path()).unwrap().count(), 2);
}

#[cfg(unix)]
#[test]
fn no_link_leads_out_of_the_folder() {
    use std::os::unix::fs::symlink;

    let studio = Running::start();
    let outside = studio.folder.path().join("outside");
    std::fs::create_dir(&outside).unwrap();
    std::fs::write(outside.join("a.fil"), "outside").unwrap();
    symlink(&outside, studio.post().join("linked")).unwrap();
    symlink(outside.join("a.fil"), studio.post().join("a.fil")).unwrap();
    let listed = studio.ask(&json!({ "do": "files" }));
    assert_eq!(listed["files"], json!([]));
    for name in ["linked/a.fil", "a.fil"] {
        let read = studio.ask(&json!({ "do": "read", "name": name }));
        assert!(read["refused"].is_string(), "{name}: {read}");
        let written = studio.write(name, "inside");
        assert!(written["refused"].is_string() || written["changed"].is_string(), "{written}");
    }
    assert!(studio.write("linked/new.fil", "x")["refused"].is_string());
    assert_eq!(std::fs::read(outside.join("a.fil")).unwrap(), b"outside");
    assert_eq!(std::fs::read_dir(&outside).unwrap().count(), 1);
}

#[test]
fn files_are_written_whole_and_read_back() {
    let studio = Running::start();
    let written = studio.write("cases/first/part.ncl", "FINI\r\n");
    let read = studio.ask(&json!({ "do": "read", "name": "cases/first/part.ncl" }));
    assert_eq!((&read["text"], &read["stamp"]), (&json!("FINI\r\n"), &written["stamp"]));
    let listed = studio.ask(&json!({ "do": "files" }));
    assert_eq!(listed["files"][0]["name"], "cases/first/part.ncl");
    assert_eq!(listed["folder"], "post");
    let names: Vec<_> = std::fs::read_dir(studio.post().join("cases/first")).unwrap().collect();
    assert_eq!(names.len(), 1, "nothing is left beside it");
}

#[test]
fn a_new_file_is_a_text() {
    let studio = Running::start();
    for name in ["run.sh", "a.exe", "a.html", "Makefile", "a.fil.bat"] {
        assert!(studio.write(name, "x")["refused"].is_string(), "{name}");
    }
    assert_eq!(std::fs::read_dir(studio.post()).unwrap().count(), 0);
}

#[test]
fn what_another_program_has_changed_is_not_replaced() {
    let studio = Running::start();
    let first = studio.write("post.fil", "FINI\n");
    std::fs::write(studio.post().join("post.fil"), "$$ of somebody else\nFINI\n").unwrap();
    let again = json!({ "do": "write", "name": "post.fil", "text": "x", "stamp": first["stamp"] });
    assert_eq!(studio.ask(&again), json!({ "changed": "post.fil" }));
    assert_eq!(studio.write("post.fil", "x"), json!({ "changed": "post.fil" }));
    let removed = json!({ "do": "remove", "name": "post.fil", "stamp": first["stamp"] });
    assert_eq!(studio.ask(&removed), json!({ "changed": "post.fil" }));
    let text = std::fs::read_to_string(studio.post().join("post.fil")).unwrap();
    assert!(text.contains("somebody else"));
}

#[test]
fn a_file_keeps_its_encoding() {
    let studio = Running::start();
    // `$$ ÄÖ` in Windows' Latin.
    let old: &[u8] = b"$$ \xc4\xd6 \xfcber die Fr\xe4sung\nFINI\n";
    std::fs::write(studio.post().join("post.fil"), old).unwrap();
    let read = studio.ask(&json!({ "do": "read", "name": "post.fil" }));
    let text = read["text"].as_str().unwrap();
    assert!(text.contains("über die Fräsung"), "{read}");
    let write = |text: &str| {
        json!({ "do": "write", "name": "post.fil", "text": text, "stamp": read["stamp"],
            "encoding": read["encoding"] })
    };
    let refused = studio.ask(&write("$$ 漢\n"));
    assert!(refused["refused"].as_str().unwrap().contains('漢'), "{refused}");
    let written = studio.ask(&write(&text.replace("FINI", "$$\nFINI")));
    assert!(written["stamp"].is_string(), "{written}");
    let bytes = std::fs::read(studio.post().join("post.fil")).unwrap();
    assert_eq!(bytes, [&old[..old.len() - 5], b"$$\nFINI\n"].concat());
}

#[test]
fn what_is_no_text_is_not_read() {
    let studio = Running::start();
    std::fs::write(studio.post().join("a.nc"), [0, 159, 146, 150]).unwrap();
    assert!(studio.ask(&json!({ "do": "read", "name": "a.nc" }))["refused"].is_string());
}

#[test]
fn it_answers_as_the_library_does() {
    let studio = Running::start();
    let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
    let answer = studio.ask(&json!({ "do": "post", "ready": "fanuc-mill", "cl": cl }));
    assert!(answer["nc"].as_str().unwrap().contains("G1 G43 X1. Y2. Z3. F200. H1"), "{answer}");
    assert!(studio.ask(&json!({ "do": "launch" }))["misuse"].is_string());
}

#[test]
fn a_folder_that_is_a_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "x").unwrap();
    assert!(Studio::open(&file, 0).is_err());
    assert!(Studio::open(Path::new("/proc/none"), 0).is_err() || cfg!(not(target_os = "linux")));
}

#[test]
fn it_ends_when_its_last_page_is_closed() {
    let mut studio = Running::start();
    let stay = || {
        let mut stream = TcpStream::connect(&studio.host).unwrap();
        let Running { host, token, .. } = &studio;
        let head = format!("GET /{token}/alive HTTP/1.1\r\nHost: {host}\r\n\r\n");
        stream.write_all(head.as_bytes()).unwrap();
        let mut begun = [0; 15];
        stream.read_exact(&mut begun).unwrap();
        assert_eq!(&begun, b"HTTP/1.1 200 OK");
        stream
    };
    let first = stay();
    let second = stay();
    drop(first);
    thread::sleep(Duration::from_millis(200));
    let ended = studio.ended.take().unwrap();
    assert!(!ended.is_finished(), "a page is still open");
    let closed = Instant::now();
    drop(second);
    ended.join().unwrap();
    let waited = closed.elapsed();
    assert!(waited > Duration::from_secs(2) && waited < Duration::from_secs(20), "{waited:?}");
}

#[test]
fn a_long_text_is_sent_once() {
    let studio = Running::start();
    let post = |texts: Value| {
        studio.ask(&json!({ "do": "post", "ready": "fanuc-mill", "texts": { "cl": texts } }))
    };
    let cl = "UNITS / MM\nLOADTL / 1\nSPINDL / 900, RPM, CLW\nRAPID\nGOTO / 1, 2, 3\nFINI\n";
    let at = cl.find("1, 2").unwrap();
    let first = post(json!({ "keep": "a", "text": cl }));
    assert!(first["nc"].as_str().unwrap().contains("X1."), "{first}");
    assert_eq!(post(json!({ "kept": "a" }))["nc"], first["nc"]);
    let other = post(json!({ "keep": "b", "of": "a", "from": at, "to": at + 1, "text": "7" }));
    assert_eq!(other["nc"], first["nc"].as_str().unwrap().replace("X1.", "X7."));
    assert_eq!(post(json!({ "kept": "c" })), json!({ "unkept": true }));
}
