//! Warnings of a run: each code and subject once, and never without end.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use fil_diag::{Code, Diag, Levels};

use crate::cause::{Cause, FilLine};
use crate::errors::PostCode;

/// Most warnings of one run.
const MOST: usize = 1000;

/// Codes by their numbers that comments of FIL allow: for a line, or for the whole file as
/// its line 0.
pub type AllowedLines = HashMap<FilLine, Vec<u16>>;

/// A warning of the post.
#[derive(Clone, Debug)]
pub struct Warning {
    /// The warning, without a place.
    pub diag: Diag,
    /// The block of an author that it is about.
    pub author: Option<Cause>,
}

/// The warnings of a run.
#[derive(Clone, Debug, Default)]
pub struct Warnings {
    /// Those not yet taken away.
    list: Vec<Warning>,
    /// Levels that the user has set.
    pub levels: Levels,
    /// What comments of FIL allow.
    pub allowed_lines: Arc<AllowedLines>,
    /// The last block of an author: INSERT, POSTN, PREFUN, a machine text, an edited block.
    pub author: Option<Cause>,
    /// How many there were.
    pub author_blocks: u64,
    /// The last one, if the post does not know what it does.
    pub unread_block: Option<String>,
    /// The block of an author that left the doubt which was denied.
    pub denied: Option<Cause>,
    known: HashSet<(u16, String)>,
}

impl Warnings {
    /// Warns once per code and subject; a run that warns without end stops at
    /// a thousand, so that memory does not grow with the CL file.
    pub fn add(&mut self, code: PostCode, message: String) {
        self.add_with(code, message, || None);
    }

    /// Warns once per code and subject, whatever the message.
    pub fn add_once(&mut self, code: PostCode, subject: &str, message: String) {
        let code: &'static Code = code.into();
        if self.is_new(code, subject) {
            let note = self.note();
            self.push(Diag::new(code, message + note), None);
        }
    }

    /// The same with a hint made for this case when the warning is a new one.
    pub fn add_with(
        &mut self,
        code: PostCode,
        message: String,
        hint: impl FnOnce() -> Option<String>,
    ) {
        let code: &'static Code = code.into();
        if self.is_new(code, &message) {
            let note = self.note();
            self.push(Diag { hint: hint(), ..Diag::new(code, message + note) }, None);
        }
    }

    /// The same for a warning of another crate.
    pub fn add_made(&mut self, mut diag: Diag) {
        if self.is_new(diag.code, &diag.message) {
            diag.message += self.note();
            self.push(diag, None);
        }
    }

    /// Warns of a doubt that a block of an author leaves: once for its line.
    pub(crate) fn add_of_author(&mut self, mut diag: Diag, author: Cause) {
        let place = if author.stack == 0 { author.line } else { author.stack };
        let subject = format!("{} {}/{place}", diag.message, author.stack != 0);
        if self.is_new(diag.code, &subject) {
            diag.message += self.note();
            self.push(diag, Some(author));
        }
    }

    /// A block of an author goes to the tape.
    pub(crate) fn author_writes(&mut self, cause: Cause) {
        self.author = Some(cause);
        self.unread_block = None;
        self.author_blocks += 1;
    }

    /// Adds warnings that have their places.
    pub fn extend(&mut self, diags: Vec<Diag>) {
        self.list.extend(diags.into_iter().map(|diag| Warning { diag, author: None }));
    }

    /// True when there is nothing to be taken away.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Takes the warnings away.
    pub fn take(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.list)
    }

    fn push(&mut self, diag: Diag, author: Option<Cause>) {
        self.list.push(Warning { diag, author });
    }

    fn is_new(&mut self, code: &'static Code, subject: &str) -> bool {
        self.known.len() < MOST && self.known.insert((code.number, subject.to_string()))
    }

    fn note(&self) -> &'static str {
        if self.known.len() == MOST { "; further warnings are not listed" } else { "" }
    }
}
