//! A host for tests: records from a list, commons in a map, a log of all it is told.

use std::collections::BTreeMap;
use std::sync::Arc;

use fil_cl::{Options, Reader, Record, Vocabulary, WordView};
use fil_diag::Diag;
use fil_vm::{
    CommonKind, Compat, FilFile, Functions, Host, Interpreter, Limits, LoadOptions, Loaded,
    Outcome, Site, load,
};

/// What the machine asked of its host.
#[derive(Default)]
pub struct Mock {
    pub records: Vec<Record>,
    /// Index of the record that is read next.
    pub next: usize,
    pub commons: BTreeMap<(CommonKind, u32), f64>,
    /// Records sent to the post, as text.
    pub log: Vec<String>,
    /// Stack of each of them.
    pub sites: Vec<Site>,
    pub warnings: Vec<Diag>,
    pub tracing: bool,
    /// How often the machine may still ask whether the run is cancelled.
    pub patience: Option<u32>,
}

impl Host for Mock {
    fn common(&mut self, kind: CommonKind, location: u32) -> Result<f64, Box<Diag>> {
        Ok(self.commons.get(&(kind, location)).copied().unwrap_or(999_999.0))
    }

    fn set_common(
        &mut self,
        kind: CommonKind,
        at: u32,
        value: f64,
    ) -> Result<Option<Box<Diag>>, Box<Diag>> {
        self.commons.insert((kind, at), value);
        Ok(None)
    }

    fn clear_common(
        &mut self,
        kind: CommonKind,
        location: u32,
    ) -> Result<Option<Box<Diag>>, Box<Diag>> {
        self.commons.remove(&(kind, location));
        Ok(None)
    }

    fn command(
        &mut self,
        record: &Record,
        vocab: &mut Vocabulary,
        site: &Site,
    ) -> Result<(), Box<Diag>> {
        self.log.push(show(record, vocab));
        self.sites.push(site.clone());
        Ok(())
    }

    fn next_record(&mut self, to: &mut Record, _: &mut Vocabulary) -> Result<bool, Box<Diag>> {
        let Some(record) = self.records.get(self.next) else { return Ok(false) };
        to.clone_from(record);
        self.next += 1;
        Ok(true)
    }

    fn seek_record(
        &mut self,
        number: u32,
        to: &mut Record,
        _: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        let Some(record) = self.records.get(number as usize - 1) else { return Ok(false) };
        to.clone_from(record);
        self.next = number as usize;
        Ok(true)
    }

    fn check_cancelled(&mut self) -> Result<(), Box<Diag>> {
        match &mut self.patience {
            None => Ok(()),
            Some(0) => fil_vm::errors::RunCode::Refused.err("cancelled"),
            Some(left) => {
                *left -= 1;
                Ok(())
            }
        }
    }

    fn warn(&mut self, diag: Diag) {
        self.warnings.push(diag);
    }

    fn trace(&mut self, on: bool) {
        self.tracing = on;
    }

    fn named_common(&mut self, name: &str) -> Option<Result<f64, Box<Diag>>> {
        (name == "output_scale_x").then(|| self.common(CommonKind::Dbl, 486))
    }

    fn neighbour(
        &mut self,
        next: bool,
        coordinate: usize,
        _: &mut Vocabulary,
    ) -> Result<Option<f64>, Box<Diag>> {
        let is_motion = |record: &&Record| record.kind == fil_cl::record::kind::MOTION;
        let (before, after) = self.records.split_at(self.next);
        let found = if next {
            after.iter().find(is_motion)
        } else {
            before.iter().rev().skip(1).find(is_motion)
        };
        Ok(found.and_then(|record| record.value(6 + coordinate, &Vocabulary::new())))
    }
}

/// A record as `MAJOR item item`, numbers in shortest form.
pub fn show(record: &Record, vocab: &Vocabulary) -> String {
    let mut line = vocab.name(record.major).to_string();
    for n in 4..=record.len() {
        line += &match record.word(n, vocab) {
            Some(WordView::Number(number)) => format!(" {number}"),
            Some(WordView::Word { name, .. }) => format!(" {name}"),
            Some(WordView::Text(text)) => format!(" '{text}'"),
            Some(WordView::Empty) | None => " -".to_string(),
        };
    }
    line
}

/// A machine with its host.
pub struct Bench {
    pub vocab: Vocabulary,
    pub machine: Interpreter,
    pub host: Mock,
    /// Warnings of the compiler.
    pub warnings: Vec<Diag>,
}

pub fn compile(text: &str) -> Result<Loaded, Vec<Diag>> {
    load(&[FilFile { name: "test.fil", text }], &mut Vocabulary::new(), LoadOptions::default())
}

impl Bench {
    /// Compiles a program that must be right.
    pub fn new(text: &str) -> Self {
        Self::with(text, Limits::default(), Compat::default(), Functions::new())
    }

    pub fn with(text: &str, limits: Limits, compat: Compat, functions: Functions) -> Self {
        let mut vocab = Vocabulary::new();
        let text =
            if text.trim_end().ends_with("FINI") { text } else { &format!("{text}\nFINI\n") };
        let options =
            LoadOptions { compat, limits, functions: Some(&functions), ..LoadOptions::default() };
        let Loaded { module, warnings } =
            load(&[FilFile { name: "test.fil", text }], &mut vocab, options)
                .unwrap_or_else(|diags| panic!("{}", lines(&diags)));
        let machine = Interpreter::new(Arc::new(module), limits, Arc::new(functions));
        Bench { vocab, machine, host: Mock::default(), warnings }
    }

    /// Runs the global area.
    pub fn globals(&mut self) -> Result<(), Box<Diag>> {
        self.machine.run_globals(&mut self.vocab, &mut self.host)
    }

    /// Gives the machine a CL file; records without a section are logged with `=`.
    pub fn records(&mut self, cl: &str) -> Result<Vec<Outcome>, Box<Diag>> {
        let mut reader = Reader::new(cl.as_bytes(), "test.ncl", Options::default());
        let mut record = Record::default();
        while reader.read(&mut self.vocab, &mut record)? {
            self.host.records.push(record.clone());
        }
        let mut outcomes = Vec::new();
        while self.host.next_record(&mut record, &mut self.vocab)? {
            match self.machine.module().find(&record, &self.vocab) {
                Some(section) => outcomes.push(self.machine.run_section(
                    section,
                    &mut record,
                    &mut self.vocab,
                    &mut self.host,
                )?),
                None => self.host.log.push(format!("= {}", show(&record, &self.vocab))),
            }
        }
        Ok(outcomes)
    }

    /// The number of a name, or the code of its word.
    pub fn number(&self, name: &str) -> f64 {
        let code = || self.machine.word(name).map(|id| self.vocab.code(id));
        let number = self.machine.number(name).or_else(code);
        number.unwrap_or_else(|| panic!("{name} holds no number"))
    }

    /// Numbers of the warnings of the run.
    pub fn warned(&self) -> Vec<u16> {
        self.host.warnings.iter().map(|diag| diag.code.number).collect()
    }
}

/// Runs a global area that must be right.
pub fn globals(text: &str) -> Bench {
    let mut bench = Bench::new(text);
    bench.globals().unwrap_or_else(|diag| panic!("{diag}\n{}", diag.notes.join("\n")));
    bench
}

/// Runs sections over a CL file; must be right.
pub fn run(fil: &str, cl: &str) -> Bench {
    let mut bench = globals(fil);
    bench.records(cl).unwrap_or_else(|diag| panic!("{diag}\n{}", diag.notes.join("\n")));
    bench
}

/// The error of running sections over a CL file.
pub fn fails(fil: &str, cl: &str) -> Diag {
    let mut bench = Bench::new(fil);
    match bench.globals().and_then(|()| bench.records(cl)) {
        Ok(_) => panic!("no error"),
        Err(diag) => *diag,
    }
}

pub fn lines(diags: &[Diag]) -> String {
    diags.iter().map(|diag| format!("{diag}\n")).collect()
}
