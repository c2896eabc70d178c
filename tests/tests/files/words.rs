//! What each post word writes: one `.ncl` file a behaviour in `tests/words/`.
//!
//! The header comments of a file say what must happen:
//! `$$ post: NAME` a ready post (fanuc-mill when left out), `$$ set: KEY=VALUE` a
//! setting on top, `$$ fil: LINE` a line of FIL, `$$ expect: BLOCK` a block of the
//! program in order, `$$ warn: W0123` a warning that must come, `$$ error: E0123 at
//! LINE` a refusal. Sequence numbers, start and end of the program are switched
//! off unless `$$ whole` asks for them. A CR of the program is shown as `<CR>`.
//! `FILPOST_UPDATE=1` writes blocks and warnings anew; a refusal is typed by hand.

use std::io::Cursor;
use std::path::Path;

use filpost_tests::words::Header;
use libtest_mimic::{Failed, Trial};

fn check(path: &Path) -> Result<(), Failed> {
    let text = std::fs::read_to_string(path)?;
    let header = Header::read(&text).map_err(Failed::from)?;
    let mut nc = Vec::new();
    let result =
        header.post().and_then(|post| post.stream_seekable(Cursor::new(text.as_bytes()), &mut nc));
    match (result, &header.error) {
        (Err(error), Some(expected)) => {
            let diag = &error.diags()[0];
            let line = diag.spans.iter().find(|place| place.file == "CL").map(|place| place.line);
            let found = format!("{} at {}", diag.code.name(), line.unwrap_or(0));
            same(&found, expected).map_err(|failed| format!("{failed:?}\n{error}").into())
        }
        (Err(error), None) => Err(error.to_string().into()),
        (Ok(_), Some(expected)) => Err(format!("expected {expected}, but it was posted").into()),
        (Ok(report), None) => {
            let codes = report.warnings.iter().map(|diag| diag.code.name());
            let warnings: Vec<String> = codes.collect();
            let program = String::from_utf8_lossy(&nc).trim_end().replace('\r', "<CR>");
            let is_same = warnings == header.warnings && program == header.expected.join("\n");
            if !is_same && std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1") {
                return Ok(std::fs::write(path, updated(&text, &program, &warnings))?);
            }
            same(&warnings.join(" "), &header.warnings.join(" "))?;
            same(&program, &header.expected.join("\n"))
        }
    }
}

/// A file with other blocks and warnings at the end of its header.
fn updated(text: &str, program: &str, warnings: &[String]) -> String {
    let is_result = |line: &&str| line.starts_with("$$ expect:") || line.starts_with("$$ warn:");
    let (header, rest): (Vec<&str>, Vec<&str>) =
        text.lines().filter(|line| !is_result(line)).partition(|line| line.starts_with("$$ "));
    let warnings = warnings.iter().map(|code| format!("$$ warn: {code}"));
    let blocks = program.lines().map(|block| format!("$$ expect: {block}"));
    let header = header.into_iter().map(str::to_string).chain(warnings).chain(blocks);
    header.chain(rest.into_iter().map(str::to_string)).map(|line| line + "\n").collect()
}

fn same(found: &str, expected: &str) -> Result<(), Failed> {
    if found == expected {
        return Ok(());
    }
    Err(format!("expected:\n{expected}\nfound:\n{found}").into())
}

pub fn trials() -> Vec<Trial> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("words");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("tests/words")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "ncl"))
        .collect();
    files.sort();
    files
        .into_iter()
        .map(|path| {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            Trial::test(format!("words/{name}"), move || check(&path))
        })
        .collect()
}
