//! What each post word writes: one `.ncl` file a behaviour in `tests/words/`.
//!
//! The header comments of a file say what must happen:
//! `$$ post: NAME` a ready post (fanuc-mill when left out), `$$ set: KEY=VALUE` a
//! setting on top, `$$ fil: LINE` a line of FIL, `$$ expect: BLOCK` a block of the
//! program in order, `$$ warn: W0123` a warning that must come, `$$ error: E0123 at
//! LINE` a refusal. Sequence numbers, start and end of the program are switched
//! off unless `$$ whole` asks for them.

use std::path::Path;

use filpost::{Error, Post};
use libtest_mimic::{Arguments, Failed, Trial};

/// Settings that leave nothing of the program but the blocks of its records.
const BARE: &[&str] = &[
    "seqno.off_at_start=72",
    "tape.start_char=none",
    "tape.end_char=none",
    "program.number_address=none",
    "units.metric_code=none",
    "units.inch_code=none",
    "mode.position=none",
    "feed.mode=none",
    "circle.plane=none",
    "program.rewind_code=none",
    "program.end_code=none",
];

#[derive(Default)]
struct Header {
    post: Option<String>,
    settings: Vec<String>,
    fil: Vec<String>,
    expected: Vec<String>,
    warnings: Vec<String>,
    error: Option<String>,
    whole: bool,
}

impl Header {
    fn read(text: &str) -> Result<Header, Failed> {
        let mut header = Header::default();
        for line in text.lines().filter_map(|line| line.strip_prefix("$$ ")) {
            let (key, value) = line.split_once(':').unwrap_or((line, ""));
            let value = value.trim().to_string();
            match key.trim() {
                "post" => header.post = Some(value),
                "set" => header.settings.push(value),
                "fil" => header.fil.push(value),
                "expect" => header.expected.push(value),
                "warn" => header.warnings.push(value),
                "error" => header.error = Some(value),
                "whole" => header.whole = true,
                "note" => {}
                other => return Err(format!("unknown header line `{other}`").into()),
            }
        }
        Ok(header)
    }

    fn post(&self) -> Result<Post, Error> {
        let mut builder = Post::builder().ready(self.post.as_deref().unwrap_or("fanuc-mill"));
        let bare = if self.whole { &[] } else { BARE };
        for setting in bare.iter().copied().chain(self.settings.iter().map(String::as_str)) {
            builder = builder.set(setting);
        }
        if !self.fil.is_empty() {
            builder = builder.fil("header", &format!("{}\nFINI\n", self.fil.join("\n")));
        }
        builder.build()
    }
}

fn check(path: &Path) -> Result<(), Failed> {
    let text = std::fs::read_to_string(path)?;
    let header = Header::read(&text)?;
    let mut nc = Vec::new();
    let result = header.post().and_then(|mut post| post.run(text.as_bytes(), &mut nc));
    match (result, &header.error) {
        (Err(error), Some(expected)) => {
            let diag = &error.diags()[0];
            let line = diag.places.iter().find(|place| place.file == "CL").map(|place| place.line);
            let found = format!("{} at {}", diag.code.name(), line.unwrap_or(0));
            same(&found, expected).map_err(|failed| format!("{failed:?}\n{error}").into())
        }
        (Err(error), None) => Err(error.to_string().into()),
        (Ok(_), Some(expected)) => Err(format!("expected {expected}, but it was posted").into()),
        (Ok(report), None) => {
            let found: Vec<String> = report.warnings.iter().map(|diag| diag.code.name()).collect();
            same(&found.join(" "), &header.warnings.join(" "))?;
            same(String::from_utf8_lossy(&nc).trim_end(), &header.expected.join("\n"))
        }
    }
}

fn same(found: &str, expected: &str) -> Result<(), Failed> {
    if found == expected {
        return Ok(());
    }
    Err(format!("expected:\n{expected}\nfound:\n{found}").into())
}

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("words");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("tests/words")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "ncl"))
        .collect();
    files.sort();
    let trials = files
        .into_iter()
        .map(|path| {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            Trial::test(name, move || check(&path))
        })
        .collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}
