//! A case as it stands in the editor, posted: the program, what made each of its lines, and
//! its path as a page.

use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::time::Instant;

use filpost::case::{Case, Unsaved};
use filpost::cl::reader;
use filpost::map::{Entry, MapReader, Names};
use filpost::nc::plot::html;
use filpost::plot::{self, ClText, Text};
use filpost::{CancelToken, Diag, Error, Program};
use serde_json::{Value, json};

use crate::uri::uri_of;

/// What is to be posted: a case, the texts that are not saved, whether its path is drawn.
#[derive(Debug)]
pub struct Preview {
    pub(crate) case: PathBuf,
    pub(crate) unsaved: Unsaved,
    pub(crate) draws: bool,
}

/// A program with its map, both in memory.
struct Made {
    nc: Vec<u8>,
    map: Vec<u8>,
    cl: Vec<u8>,
    warnings: Vec<Diag>,
}

impl Preview {
    /// Posts the case; a token that is set ends the run. A case that is refused gives its
    /// messages and no program.
    pub fn answer(&self, token: &CancelToken) -> Value {
        let start = Instant::now();
        let made = Case::load(&self.case).and_then(|case| self.post(&case, token));
        let mut answer = match made {
            Ok(answer) => answer,
            Err(error) => {
                json!({ "refused": error.diags().iter().map(sentence).collect::<Vec<_>>() })
            }
        };
        answer["milliseconds"] = json!(start.elapsed().as_millis() as u64);
        answer
    }

    fn post(&self, case: &Case, token: &CancelToken) -> Result<Value, Error> {
        let program = case.program_with(&self.unsaved)?;
        let made = self.run(case, &program, token)?;
        let mut answer = told(case, &program, &made)?;
        if self.draws {
            answer["page"] = match page(case, &program, &made) {
                Ok(page) => json!(page),
                Err(error) => json!({ "refused": error.to_string() }),
            };
        }
        Ok(answer)
    }

    fn run(&self, case: &Case, program: &Program, token: &CancelToken) -> Result<Made, Error> {
        let path = case.folder.join(&case.file.cl);
        let real = path.canonicalize().unwrap_or(path);
        let cl = match self.unsaved.get(&real) {
            Some(text) => text.clone().into_bytes(),
            None => case.cl_text()?,
        };
        let names =
            Names { cl: case.file.cl.clone(), nc: PROGRAM.to_string(), fil: program.fil_files() };
        let (mut nc, mut map) = (Vec::new(), Vec::new());
        let run = case.start(program).cancel(token);
        // Files that the script writes are dropped with what is pending.
        let (report, _) = run.run_mapped(Cursor::new(&cl), &mut nc, &names, &mut map)?;
        let warnings = program.warnings().iter().cloned().chain(report.warnings).collect();
        Ok(Made { nc, map, cl, warnings })
    }
}

/// What the program is called in the map and the drawing.
const PROGRAM: &str = "program.nc";

/// The program, the files it is made of, and the CL line and FIL lines of each of its lines.
fn told(case: &Case, program: &Program, made: &Made) -> Result<Value, Error> {
    let mut map = MapReader::new(PROGRAM, Cursor::new(&made.map))?;
    let mut lines = Vec::new();
    while let Some(entry) = map.next() {
        let Entry::Line(line) = entry? else { continue };
        let stack = map.stack(line.cause).map_or(&[][..], |stack| &stack.lines);
        let fil: Vec<[u32; 2]> = stack.iter().map(|at| [u32::from(at.file), at.line]).collect();
        lines.push(json!([line.cause.line, fil]));
    }
    let fil = program.fil_files();
    let fil = fil.iter().map(|name| uri_of(&real(Path::new(name))));
    Ok(json!({
        "nc": program.nc_page().decode_all(&made.nc),
        "cl": uri_of(&real(&case.folder.join(&case.file.cl))),
        "fil": fil.collect::<Vec<_>>(),
        "lines": lines,
        "warnings": made.warnings.iter().map(sentence).collect::<Vec<_>>(),
    }))
}

/// The path of the program over that of the CL file, as a page.
fn page(case: &Case, program: &Program, made: &Made) -> Result<String, Error> {
    let nc = Text { name: PROGRAM, bytes: &made.nc };
    let mut drawing = plot::program(nc, program.commons())?;
    drawing.title = case.folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = Text { name: &case.file.cl, bytes: &made.cl };
    let options = reader::Options {
        dialect: case.file.dialect,
        raw: case.file.raw_records,
        ..reader::Options::default()
    };
    let cl = ClText { text, options, unit: case.file.units };
    plot::lay_under(&mut drawing, cl, program.commons())?;
    let map = MapReader::new(PROGRAM, Cursor::new(&made.map))?;
    let texts = program.fil_texts();
    plot::add_origins(&mut drawing, nc, map, &mut |name| {
        let fil = texts.iter().find(|(known, _)| known == name);
        let fil = fil.map(|(_, text)| text.as_bytes().to_vec());
        fil.or_else(|| (name == case.file.cl).then(|| made.cl.clone()))
    })?;
    Ok(html(&drawing))
}

/// `E0506 post.fil:3: …` with its hint.
fn sentence(diag: &Diag) -> String {
    let kind = diag.severity().name();
    let hint = diag.hint.as_deref().unwrap_or(diag.code.hint);
    format!("{kind} {diag}\n{hint}")
}

fn real(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}
