//! NC programs of `tests/stock/`: comments at their head say what they are cut from, and what a
//! simulation finds.
//!
//! ```text
//! ; post: haas-mill             the ready post whose machine it is for (fanuc-mill)
//! ; stock: box 100x80x30        the stock
//! ; part: step.stl              the finished part, a file of the folder
//! ; grid: 0.5                   size of a cell, mm
//! ; tool: 1=D10R0.5             a tool
//! ; offset: G55=60,0,0          a further work offset
//! ; level: E0971=warn           the level of a code
//! ; note: TEXT                  why
//! ; finding: error E0971 at 12: tool 1, 5 mm deep …      a finding, in order; `at 12-14` of several lines
//! ; removed: 1=12000            the volume that a tool removes, mm³
//! ; error: E0961                the refusal, `E0962 at 12` with its line
//! ```

use std::path::{Path, PathBuf};

use filpost::nc::motion::work_offset;
use filpost::plot::Text;
use filpost::stock::{Finding, Job, Mesh, Offsets, Report, Stock, Tool, Tools, place};
use filpost::{Error, Levels, Program, allowable, simulate};

/// What the head of a program says.
#[derive(Default)]
struct Head {
    post: Option<String>,
    stock: String,
    part: Option<String>,
    grid: Option<f64>,
    tools: Tools,
    offsets: Offsets,
    levels: Levels,
    /// Lines that must come of it.
    expected: Vec<String>,
}

impl Head {
    fn read(text: &str) -> Result<Head, String> {
        let mut head = Head::default();
        for line in text.lines().map_while(|line| line.strip_prefix("; ")) {
            head.take(line).ok_or_else(|| format!("`{line}`"))?;
        }
        Ok(head)
    }

    fn take(&mut self, line: &str) -> Option<()> {
        let (key, value) = line.split_once(": ")?;
        match key {
            "post" => self.post = Some(value.into()),
            "stock" => self.stock = value.into(),
            "part" => self.part = Some(value.into()),
            "grid" => self.grid = Some(value.parse().ok()?),
            "tool" => {
                let (number, size) = value.split_once('=')?;
                self.tools.insert(number.parse().ok()?, Tool::read(size).ok()?);
            }
            "offset" => {
                let (name, at) = value.split_once('=')?;
                self.offsets.insert(work_offset(name)?, place(at)?);
            }
            "level" => {
                let (code, level) = value.split_once('=')?;
                self.levels.set(allowable(code).ok()?.number, level.parse().ok()?);
            }
            "finding" | "removed" | "error" => self.expected.push(line.into()),
            "note" => {}
            _ => return None,
        }
        Some(())
    }
}

/// The programs, by name.
///
/// # Panics
/// When the folder is not there.
pub fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(crate::root().join("tests/stock")).expect("tests/stock");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "nc")).collect();
    files.sort();
    files
}

/// The codes that a program expects.
///
/// # Panics
/// When the file can't be read.
pub fn listed(path: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(path).expect("a program");
    let head = Head::read(&text).expect("a head");
    let codes = head.expected.iter().filter_map(|line| {
        line.split([' ', ':']).find(|word| word.len() == 5 && word.starts_with(['E', 'W']))
    });
    codes.map(String::from).collect()
}

/// Runs a program and compares what is found with its head.
///
/// # Errors
/// What differs.
pub fn check(path: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let head = Head::read(&text)?;
    let found = match run(path, &head, &text)? {
        Ok(report) => lines(&report),
        Err(error) => error.diags().iter().map(refusal).collect(),
    };
    if found == head.expected {
        return Ok(());
    }
    Err(format!("found\n{}\nnot\n{}", found.join("\n"), head.expected.join("\n")))
}

fn run(path: &Path, head: &Head, text: &str) -> Result<Result<Report, Error>, String> {
    let say = |diag: Box<filpost::Diag>| diag.to_string();
    let mesh = |name: &str| {
        let bytes = std::fs::read(path.with_file_name(name)).map_err(|error| error.to_string())?;
        Ok::<_, String>(Mesh::read(name, &bytes))
    };
    let stock = match Stock::read(&head.stock) {
        Ok(Some(stock)) => stock,
        Ok(None) => match mesh(&head.stock)? {
            Ok(mesh) => Stock::Mesh(mesh),
            Err(refused) => return Ok(Err(Error::Run(refused))),
        },
        Err(refused) => return Ok(Err(Error::Run(refused))),
    };
    let part = head.part.as_deref().map(mesh).transpose()?.transpose().map_err(say)?;
    let builder = Program::builder().generic(head.post.as_deref().unwrap_or("fanuc-mill"));
    let commons = builder.build_machine().map_err(|error| error.to_string())?;
    let job = Job {
        stock: &stock,
        tools: &head.tools,
        part: part.as_ref(),
        part_tolerance: 0.05,
        grid: head.grid,
        offsets: &head.offsets,
        levels: &head.levels,
    };
    let nc = Text { name: "out.nc", bytes: text.as_bytes() };
    Ok(simulate::program(nc, &commons, &job).map(|done| done.report))
}

fn lines(report: &Report) -> Vec<String> {
    let finding = |found: &Finding| {
        let last =
            if found.last == found.line { String::new() } else { format!("-{}", found.last) };
        let (severity, code) = (found.severity.name(), found.code.name());
        format!("finding: {severity} {code} at {}{last}: {}", found.line, found.message())
    };
    let removed =
        report.removed.iter().map(|(tool, volume)| format!("removed: {tool}={volume:.0}"));
    report.findings.iter().map(finding).chain(removed).collect()
}

fn refusal(diag: &filpost::Diag) -> String {
    let place = diag.spans.first().map_or(String::new(), |place| format!(" at {}", place.line));
    format!("error: {}{place}", diag.code.name())
}
