//! The language suite: a FIL file whose header comment says what must happen.
//!
//! ```text
//! $$ cl: CYCLE / DRILL, 5     a line of the CL file; FINI is added
//! $$ expect: X1. Y2.          a line of the NC program, in order
//! $$ error: E0301 at 5        the refusal, with its line in the FIL file
//! $$ hint: write ENDIF        its hint
//! $$ warning: W0217 at 3      a warning that must come
//! $$ with: other.fil          a file loaded before this one
//! $$ set: key=value           a setting on top of the suite's machine.toml
//! $$ strict: yes              extensions are refused
//! $$ clock: 2026-01-31T12:00:00    the moment of DATEF and TIMEF
//! $$ grant: read              scripts may read the folder `with`
//! $$ grant: write             scripts may read and write an empty folder
//! $$ file: NAME: LINE         a line of a file there after the run, in order; no
//!                             other file may be there
//! ```
//!
//! Without `error:` the whole program is compared and every error or warning
//! that is not announced is a failure. The machine of the suite writes nothing
//! of its own accord, so that a test shows only what its FIL does.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;

use filpost::{Diag, Program, files, includes};

/// What the header of a test says.
#[derive(Default)]
struct Header {
    cl: Vec<String>,
    expect: Vec<String>,
    error: Option<String>,
    hint: Option<String>,
    warnings: Vec<String>,
    with: Vec<String>,
    set: Vec<String>,
    strict: bool,
    clock: Option<String>,
    grant: Option<String>,
    files: BTreeMap<String, String>,
}

fn header(text: &str) -> Result<Header, String> {
    let mut header = Header::default();
    for line in text.lines() {
        let Some((key, value)) = line.strip_prefix("$$ ").and_then(|line| line.split_once(": "))
        else {
            continue;
        };
        let value = value.trim().to_string();
        match key {
            "cl" => header.cl.push(value),
            "expect" => header.expect.push(value),
            "error" => header.error = Some(value),
            "hint" => header.hint = Some(value),
            "warning" => header.warnings.push(value),
            "with" => header.with.push(value),
            "set" => header.set.push(value),
            "strict" => header.strict = true,
            "clock" => header.clock = Some(value),
            "grant" => header.grant = Some(value),
            "file" => {
                let (name, line) = value.split_once(": ").ok_or("file: NAME: LINE")?;
                *header.files.entry(name.into()).or_default() += &format!("{line}\n");
            }
            _ => {}
        }
    }
    let says_nothing = header.expect.is_empty() && header.error.is_none();
    if says_nothing { Err("the header expects nothing".into()) } else { Ok(header) }
}

/// A test of the suite, ready to be posted.
pub struct Test {
    header: Header,
    name: String,
    builder: filpost::Builder,
    cl: String,
    /// The folder that scripts may write to; it goes with this value.
    written: tempfile::TempDir,
}

/// What messages call the CL file of a test.
pub const CL_NAME: &str = "part.ncl";

/// Reads a test of the suite.
///
/// # Errors
/// A header that is wrong, or a file that can't be read.
pub fn read(path: &Path) -> Result<Test, String> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let read = |path: &Path| files::read_text(path, None).map_err(|error| error.to_string());
    let text = read(path)?;
    let header = header(&text)?;
    let mut builder = Program::builder()
        .machine("machine.toml", &read(&folder.join("machine.toml"))?)
        .limits(filpost::Limits { fuel: 100_000, ..filpost::Limits::default() });
    for name in &header.with {
        builder = builder.fil(name, &read(&folder.join(name))?);
    }
    for setting in &header.set {
        builder = builder.set(setting);
    }
    let written = tempfile::tempdir().map_err(|error| error.to_string())?;
    builder = granted(builder.strict(header.strict), &header, folder, written.path())?;
    builder = builder.includes(includes::beside(&[path.to_path_buf()], None));
    let name = path.display().to_string();
    let cl: String = header.cl.iter().map(|line| format!("{line}\n")).collect();
    let (builder, cl) = (builder.fil(&name, &text), format!("{cl}FINI\n"));
    Ok(Test { header, name, builder, cl, written })
}

impl Test {
    /// The post of the test, the folder its scripts may write to, which must live as long, and
    /// the CL text.
    ///
    /// # Errors
    /// FIL that makes no post.
    pub fn post(self) -> Result<(Program, tempfile::TempDir, String), filpost::Error> {
        Ok((self.builder.build()?, self.written, self.cl))
    }
}

/// Runs a test of the suite; the text of a failure says what was wrong.
///
/// # Errors
/// Anything that is not as the header says.
pub fn run(path: &Path) -> Result<(), String> {
    let Test { header, name, builder, cl, written } = read(path)?;
    judge(&header, &name, post(builder, &cl))?;
    judge_files(&header, written.path())
}

fn granted(
    builder: filpost::Builder,
    header: &Header,
    folder: &Path,
    written: &Path,
) -> Result<filpost::Builder, String> {
    let mut builder = builder;
    if let Some(text) = &header.clock {
        let moment = filpost::Moment::parse(text).ok_or("clock: no moment")?;
        builder = builder.clock(filpost::Clock::Fixed(moment));
    }
    match header.grant.as_deref() {
        None => Ok(builder),
        Some("read") => Ok(builder.grant_read(folder.join("with"))),
        Some("write") => Ok(builder.grant_read(written).grant_write(written)),
        Some(other) => Err(format!("grant: {other} is not known")),
    }
}

/// Compares the files a script wrote.
fn judge_files(header: &Header, folder: &Path) -> Result<(), String> {
    for (name, wanted) in &header.files {
        let found =
            std::fs::read_to_string(folder.join(name)).map_err(|e| format!("{name}: {e}"))?;
        if found != *wanted {
            return Err(format!("{name}: expected:\n{wanted}got:\n{found}"));
        }
    }
    let names = std::fs::read_dir(folder).map_err(|error| error.to_string())?;
    let beyond = names
        .filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()))
        .find(|name| !header.files.contains_key(name));
    beyond.map_or(Ok(()), |name| Err(format!("the file {name} is there")))
}

type Posted = Result<(String, Vec<Diag>), Vec<Diag>>;

fn post(builder: filpost::Builder, cl: &str) -> Posted {
    let refused = |error: filpost::Error| error.diags().to_vec();
    let post = builder.build().map_err(refused)?;
    let mut nc = Vec::new();
    let report = post
        .start()
        .cl_name(CL_NAME)
        .stream_seekable(Cursor::new(cl.as_bytes()), &mut nc)
        .map_err(refused)?;
    let warnings = post.warnings().iter().cloned().chain(report.warnings).collect();
    Ok((String::from_utf8_lossy(&nc).into_owned(), warnings))
}

fn judge(header: &Header, file: &str, result: Posted) -> Result<(), String> {
    let said = |diags: &[Diag]| diags.iter().map(Diag::to_string).collect::<Vec<_>>().join("\n");
    match (result, &header.error) {
        (Err(diags), Some(error)) => match diags.as_slice() {
            [diag] if at(diag, file) == *error => match &header.hint {
                Some(hint) if diag.hint.as_ref() != Some(hint) => {
                    Err(format!("expected the hint {hint}, got {:?}", diag.hint))
                }
                _ => Ok(()),
            },
            _ => Err(format!("expected {error}, got:\n{}", said(&diags))),
        },
        (Err(diags), None) => Err(format!("refused:\n{}", said(&diags))),
        (Ok((nc, _)), Some(error)) => Err(format!("expected {error}, but it was posted:\n{nc}")),
        (Ok((nc, warnings)), None) => {
            let mut found: Vec<String> = warnings.iter().map(|diag| at(diag, file)).collect();
            let mut announced = header.warnings.clone();
            found.sort();
            announced.sort();
            if found != announced {
                return Err(format!(
                    "expected warnings {:?}:\n{}",
                    header.warnings,
                    said(&warnings)
                ));
            }
            let wanted: String = header.expect.iter().map(|line| format!("{line}\n")).collect();
            let nothing = header.expect == ["nothing"] && nc.is_empty();
            if nc == wanted || nothing {
                Ok(())
            } else {
                Err(format!("expected:\n{wanted}got:\n{nc}"))
            }
        }
    }
}

/// `E0301 at 5`; a place in another file keeps that file's name.
fn at(diag: &Diag, file: &str) -> String {
    match diag.spans.first() {
        None => diag.code.name(),
        Some(place) if place.file == file => format!("{} at {}", diag.code.name(), place.line),
        Some(place) => {
            let name = Path::new(&place.file).file_name().unwrap_or_default().to_string_lossy();
            format!("{} at {name}:{}", diag.code.name(), place.line)
        }
    }
}
