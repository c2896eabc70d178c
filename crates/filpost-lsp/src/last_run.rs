//! A run of the case that a script belongs to: what the names of a line held when it ran last.

use std::collections::HashMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use filpost::case::{Case, Programs};
use filpost::cl::record::WordView;
use filpost::cl::{Record, Vocabulary};
use filpost::debug::{DebugEvent, DebugState, Debugger, Held, SharedDebugger, shown, stopped};
use filpost::{Diag, Program};

/// A run is left after this time: an editor waits for it.
const LONGEST: Duration = Duration::from_millis(300);
/// Words of a record that are shown.
const MOST_WORDS: usize = 20;

/// A line as it ran last.
struct Seen {
    values: Vec<(String, Held)>,
    /// The words of the record by their numbers.
    record: Option<Arc<str>>,
}

/// The lines of a case, by file and line, 1-based.
#[derive(Default)]
pub(crate) struct LastRun {
    case: String,
    lines: HashMap<(PathBuf, u32), Seen>,
}

impl LastRun {
    /// Runs a case; one that can't be run, or not to its end, tells of as much as it ran.
    pub fn of(folder: &Path) -> LastRun {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let lines = lines_of(folder).unwrap_or_default();
        LastRun { case: name, lines }
    }

    /// What a word held when the line ran last; of POSTF the words of the record.
    pub fn told(&self, file: &Path, line: u32, word: &str) -> Option<String> {
        let seen = self.lines.get(&(file.to_path_buf(), line))?;
        let is_record = word == "POSTF" || word.bytes().all(|byte| byte.is_ascii_digit());
        let what = match seen.values.iter().find(|(name, _)| name == word) {
            Some((name, value)) => format!("`{name} = {}`", shown(value)),
            None if is_record => seen.record.as_ref()?.to_string(),
            None => return None,
        };
        Some(format!("Before the line ran last, in the case `{}`: {what}", self.case))
    }
}

fn lines_of(folder: &Path) -> Option<HashMap<(PathBuf, u32), Seen>> {
    let case = Case::load(folder).ok()?;
    let program = Programs::for_debugging().get(&case).ok()?;
    let noted = Arc::new(Mutex::new(Noted::new()));
    let debugger: SharedDebugger = noted.clone();
    let run = case.start(&program).debug(&debugger);
    // A refused run has told of the lines before its error.
    let _ = run.run_pending(Cursor::new(case.cl_text().ok()?), std::io::sink());
    drop(debugger);
    let noted = Arc::into_inner(noted)?.into_inner().unwrap_or_else(PoisonError::into_inner);
    Some(noted.by_path(&program))
}

/// The debugger of the run.
struct Noted {
    until: Instant,
    record: Option<Arc<str>>,
    lines: HashMap<(u16, u32), Seen>,
}

impl Noted {
    fn new() -> Noted {
        Noted { until: Instant::now() + LONGEST, record: None, lines: HashMap::new() }
    }

    fn by_path(self, program: &Program) -> HashMap<(PathBuf, u32), Seen> {
        let files = program.fil_files();
        let real = |file: u16| {
            let path = Path::new(files.get(usize::from(file)).map_or("", String::as_str));
            path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
        };
        self.lines.into_iter().map(|((file, line), seen)| ((real(file), line), seen)).collect()
    }
}

impl Debugger for Noted {
    fn at(
        &mut self,
        event: DebugEvent<'_>,
        state: &mut DebugState<'_, '_>,
    ) -> Result<(), Box<Diag>> {
        if Instant::now() > self.until {
            return Err(stopped());
        }
        match event {
            DebugEvent::Enter => {
                let vocabulary = &state.fil.vocabulary;
                let record = state.fil.record.as_deref();
                self.record = record.map(|record| words(record, vocabulary));
            }
            DebugEvent::Statement => {
                if let Some(place) = state.fil.line() {
                    let (values, record) = (state.fil.used(), self.record.clone());
                    self.lines.insert(place, Seen { values, record });
                }
            }
            _ => {}
        }
        Ok(())
    }
}

/// `record 6, CL line 6: 2 = 5000, 3 = GOTO, …`
fn words(record: &Record, vocabulary: &Vocabulary) -> Arc<str> {
    let word = |n: usize| {
        let value = match record.word(n, vocabulary)? {
            WordView::Number(number) => shown(&Held::Number(number)),
            WordView::Word { name, .. } => name.to_string(),
            WordView::Text(text) => shown(&Held::Text(text.to_string())),
            WordView::Empty => "EMPTY".to_string(),
        };
        Some(format!("{n} = `{value}`"))
    };
    let list: Vec<String> = (2..=record.len().min(MOST_WORDS)).filter_map(word).collect();
    format!("record {}, CL line {}: {}", record.number, record.line, list.join(", ")).into()
}
