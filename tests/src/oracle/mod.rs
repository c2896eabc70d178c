//! A second reading of FIL: a slow and simple interpreter of the tree.
//!
//! It is written from the description of the language, not from the machine,
//! and shares nothing with it but the parser and the vocabulary's codes. What
//! it does to the outside is written down as lines of text, so that two runs
//! are compared by comparing lines.

mod collect;
mod execute;
mod expression;
mod functions;
mod postf;
pub mod value;

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use fil_cl::Vocabulary;
use fil_diag::LineIndex;
use fil_syntax::tree::{Item, Macro, Program, Section, SectionKey, Span, Stmt};

pub use value::{Class, EMPTY, Fault, NEVER_SET, PAST_END, Rec, Value, Word, exact};

/// What a section did, as the machine reports it.
#[derive(Clone, Copy, Debug, Default)]
struct Done {
    processed: bool,
    replaced: bool,
    edited: bool,
    commands: u32,
}

/// The interpreter with all it knows.
pub struct Oracle<'p> {
    program: &'p Program,
    lines: LineIndex,
    vocab: Vocabulary,
    macros: HashMap<&'p str, &'p Macro>,
    /// Names that some statement sets.
    assigned: HashSet<String>,
    variables: HashMap<String, Value>,
    arrays: HashMap<String, Vec<Option<Value>>>,
    /// Parameters of the macros that run, innermost last.
    frames: Vec<HashMap<String, Value>>,
    /// Lines of the calls, innermost last.
    callers: Vec<u32>,
    commons: BTreeMap<(u8, u32), f64>,
    records: Vec<Rec>,
    next: usize,
    current: Option<Rec>,
    saved: Option<Rec>,
    at_end: bool,
    limit: u64,
    fuel: u64,
    done: Done,
    events: Vec<String>,
    warnings: BTreeSet<(u16, u32)>,
}

impl<'p> Oracle<'p> {
    /// An interpreter of a program on a list of records.
    pub fn new(program: &'p Program, text: &str, records: Vec<Rec>, limit: u64) -> Self {
        let mut oracle = Oracle {
            program,
            lines: LineIndex::new(text),
            vocab: Vocabulary::new(),
            macros: HashMap::new(),
            assigned: HashSet::new(),
            variables: HashMap::new(),
            arrays: HashMap::new(),
            frames: Vec::new(),
            callers: Vec::new(),
            commons: BTreeMap::new(),
            records,
            next: 0,
            current: None,
            saved: None,
            at_end: false,
            limit,
            fuel: limit,
            done: Done::default(),
            events: Vec::new(),
            warnings: BTreeSet::new(),
        };
        for (index, letter) in ('A'..='Z').enumerate() {
            oracle.variables.insert(letter.to_string(), Value::Number(index as f64 + 1.0));
            oracle.assigned.insert(letter.to_string());
        }
        oracle.collect();
        oracle
    }

    /// Runs the global area and then the sections over all records.
    ///
    /// # Errors
    /// The fault that stops the run.
    pub fn run(&mut self) -> Result<(), Fault> {
        let globals: Vec<&Stmt> = self
            .program
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Stmt(stmt) => Some(stmt),
                _ => None,
            })
            .collect();
        self.body(&globals)?;
        while let Some(record) = self.records.get(self.next).cloned() {
            self.next += 1;
            match self.section_of(&record) {
                None => self.events.push(format!("= {record}")),
                Some(section) => self.section(section, record)?,
            }
        }
        Ok(())
    }

    /// What was done to the outside, in order.
    pub fn events(&self) -> &[String] {
        &self.events
    }

    /// Code and line of the warnings.
    pub fn warnings(&self) -> &BTreeSet<(u16, u32)> {
        &self.warnings
    }

    /// The names that statements set, with what they hold at the end.
    pub fn values(&self) -> impl Iterator<Item = (&str, Option<&Value>)> {
        let plain = self.assigned.iter().filter(|name| !self.arrays.contains_key(*name));
        plain.map(|name| (name.as_str(), self.variables.get(name)))
    }

    fn section(&mut self, section: &'p Section, record: Rec) -> Result<(), Fault> {
        self.current = Some(record);
        self.done = Done::default();
        let body: Vec<&Stmt> = section.body.iter().collect();
        self.body(&body)?;
        self.current = None;
        let Done { processed, replaced, edited, commands } = self.done;
        self.events.push(format!(
            "end processed={processed} replaced={replaced} edited={edited} commands={commands}"
        ));
        Ok(())
    }

    /// The section for a record: the most specific one.
    fn section_of(&self, record: &Rec) -> Option<&'p Section> {
        let sections = self.program.items.iter().filter_map(|item| match item {
            Item::Section(section) => Some(section),
            _ => None,
        });
        let graded =
            sections.filter_map(|section| Some((self.fit(&section.key, record)?, section)));
        graded.max_by_key(|(grade, _)| *grade).map(|(_, section)| section)
    }

    /// How well a key fits: `None` not at all; words before types, more before fewer.
    fn fit(&self, key: &SectionKey, record: &Rec) -> Option<usize> {
        match key {
            SectionKey::Words { major, minors } => {
                let stands = |(index, minor): (usize, &fil_syntax::tree::Name)| {
                    record.data.get(index) == Some(&Word::Minor(minor.text.clone()))
                };
                let fits = major.text == record.major && minors.iter().enumerate().all(stands);
                fits.then_some(10 + minors.len())
            }
            SectionKey::Types { kind, sub, .. } => {
                if *kind != record.kind {
                    return None;
                }
                match sub {
                    None => Some(1),
                    Some(sub) => (self.third_word(record) == f64::from(*sub)).then_some(2),
                }
            }
        }
    }

    fn third_word(&self, record: &Rec) -> f64 {
        if record.opens_with_word() { self.code(&record.major) } else { f64::from(record.sub) }
    }

    /// The code of a word; that of a word nobody knows depends on its name alone.
    fn code(&self, word: &str) -> f64 {
        match self.vocab.find(word) {
            Some(id) => self.vocab.code(id),
            None => {
                let mut vocab = Vocabulary::new();
                let id = vocab.intern(word);
                vocab.code(id)
            }
        }
    }

    fn line(&self, span: Span) -> u32 {
        self.lines.line(span.start as usize)
    }

    fn warn(&mut self, code: u16, span: Span) {
        let line = self.line(span);
        self.warnings.insert((code, line));
    }

    fn fault<T>(&self, class: Class, span: Span) -> Result<T, Fault> {
        Err(Fault { class, line: self.line(span) })
    }
}
