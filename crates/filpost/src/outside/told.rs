//! What a run tells: warnings with their places, what observers hear, the report.

use std::cell::RefCell;

use fil_cl::{Record, Vocabulary};
use fil_diag::{Code, CodeKind, Diag, Level, TextSpan};
use fil_post::errors::PostCode;
use fil_post::warnings::Warning;
use fil_post::{Cause, FilLine};
use fil_vm::{OutputMacro, SectionId};

use super::Outside;
use crate::editing::edits;
use crate::error::RunCode;
use crate::event::{Event, LineEditor, RunEnd};
use crate::listing::ListingRules;
use crate::map;
use crate::statement::statement_text;
use crate::word_pages;

impl Outside<'_, '_> {
    /// Tells the warnings of the post, which came at this place; one of a doubt stands at the
    /// line of the author that left it.
    pub(super) fn take_warnings(&mut self, place: Option<&TextSpan>, vocabulary: &Vocabulary) {
        for Warning { mut diag, author } in self.post.control.warnings.take() {
            diag.spans.extend(author.map(|author| self.place_of_author(author, vocabulary)));
            diag.spans.extend(place.cloned());
            self.tell(diag);
        }
    }

    /// Where an author wrote a block: the line of FIL, or of the CL file.
    pub(super) fn place_of_author(&self, author: Cause, vocabulary: &Vocabulary) -> TextSpan {
        let fil = self.post.control.tape.stacks.lines(author.stack).first();
        match fil {
            Some(made) => {
                let file = &self.module.files[usize::from(made.file)];
                let text = file.text.lines().nth(made.line.saturating_sub(1) as usize);
                TextSpan::line(&file.name, made.line, text.unwrap_or_default())
            }
            None => {
                let is_it = self.of_author.line == author.line;
                let text =
                    if is_it { statement_text(&self.of_author, vocabulary) } else { String::new() };
                TextSpan::line(&self.cl_name, author.line, text)
            }
        }
    }

    /// Puts a warning into the report and tells the observers, at the level of its code; one
    /// that is denied ends the run behind its record.
    pub(super) fn tell(&mut self, warning: Diag) {
        let level = match warning.code.kind {
            CodeKind::Warning => self.post.control.warnings.levels.of_code(warning.code),
            _ => Level::Warn,
        };
        let Some(warning) = warning.at_level(level) else { return };
        if warning.is_error() {
            self.denied.get_or_insert_with(|| Box::new(warning));
            return;
        }
        for observer in self.observers.iter_mut() {
            observer(Event::Warning(&warning));
        }
        self.report.warnings.push(warning);
    }

    /// Notes in the report how far the run has come.
    pub fn note_counts(&mut self) {
        self.report.records = self.source.records;
        self.report.blocks = self.post.control.tape.count;
        self.report.dialect = self.source.recognized();
        self.report.splines = self.source.splines();
    }

    /// The FIL line that made a record.
    pub(super) fn fil_line(&self, record: &Record) -> Option<FilLine> {
        let tape = &self.post.control.tape;
        tape.stacks.lines(tape.cause.stack).first().copied().filter(|_| record.line == 0)
    }

    /// Where a record stands: in the CL file, or in FIL for one that FIL has made.
    pub fn place(&self, record: &Record, vocabulary: &Vocabulary) -> TextSpan {
        if let Some(made) = self.fil_line(record) {
            let file = &self.module.files[usize::from(made.file)].name;
            return TextSpan::line(file, made.line, statement_text(record, vocabulary));
        }
        let line = if record.line == 0 { self.post.control.tape.cause.line } else { record.line };
        TextSpan::line(&self.cl_name, line, statement_text(record, vocabulary))
    }

    /// Notes what a section did with its record, given by number and line.
    pub fn section_done(
        &mut self,
        section: SectionId,
        (record, line): (u32, u32),
        swallowed: bool,
    ) {
        let key = self.module.section_key(section);
        if swallowed {
            if let Some(map) = &mut self.map {
                map.taken(map::Taken { line, record, section: section.index() });
            }
            *self.report.swallowed.entry(key.to_string()).or_default() += 1;
        }
        for observer in self.observers.iter_mut() {
            observer(Event::Section { key, record, swallowed, traced: self.trace });
        }
    }

    /// Tells the observers that a record and all it has caused are over.
    ///
    /// # Errors
    /// What the script's macro for lines of listings refuses.
    pub fn record_done(&mut self) -> Result<(), Box<Diag>> {
        let failure = RefCell::new(None);
        let commons = &self.post.control.commons;
        let editor = self.editor.as_ref().filter(|_| edits(commons).listing);
        let edit = editor.map(|editor| {
            |line: &mut String| {
                if failure.borrow().is_none()
                    && let Err(diag) = editor.edit_line(OutputMacro::Listing, line, commons)
                {
                    *failure.borrow_mut() = Some(diag);
                }
            }
        });
        let edit = edit.as_ref().map(|edit| edit as &dyn Fn(&mut String));
        let rules = ListingRules::of(commons);
        for observer in self.observers.iter_mut() {
            observer(Event::RecordDone { lines: LineEditor(edit), rules });
        }
        failure.into_inner().map_or(Ok(()), Err)
    }

    /// Tells the observers what the run has counted.
    ///
    /// # Errors
    /// As [`Outside::record_done`].
    pub fn run_done(&mut self) -> Result<(), Box<Diag>> {
        if let Some(tally) = &self.tally {
            let (blocks, bytes) = (self.report.blocks, self.report.bytes);
            let end = RunEnd { tally, report: &self.report, blocks, bytes };
            for observer in self.observers.iter_mut() {
                observer(Event::End(end));
            }
        }
        self.record_done()
    }

    /// The CL file ended without FINI; the program ends here.
    ///
    /// # Errors
    /// A record that waits for its continuation.
    pub fn end_of_file(&mut self, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
        self.warn_of_other_signs();
        if self.source.records == 0 {
            self.tell(*RunCode::NoMotion.diag(format!("{} holds no record", self.cl_name)));
        } else if !self.fini_taken
            && self.source.recognized().is_none_or(|found| found.dialect.rules().writes_fini)
        {
            self.tell(*RunCode::NoFini.diag(format!("{} has no FINI", self.cl_name)));
        }
        let result = self.post.finish();
        self.take_warnings(None, vocabulary);
        result.map_err(|diag| self.name_dialects(diag))
    }

    /// Names the dialects that would turn the arcs the other way, where the sense of arcs is
    /// refused.
    pub(super) fn name_dialects(&self, mut diag: Box<Diag>) -> Box<Diag> {
        let sense: &Code = PostCode::ArcSense.into();
        let found = self.source.recognized().map(|found| found.dialect);
        if let Some(dialect) = found.filter(|_| diag.code == sense) {
            let fitting = dialect.turning_otherwise();
            let names: Vec<String> =
                fitting.iter().map(|other| format!("--dialect {other}")).collect();
            let as_they_are = match self.post.trust_settles_arcs() {
                true => format!("--dialect {dialect} says that they are as {dialect} means them"),
                false => "an arc that is right as it is can be written as lines (GOTO)".to_string(),
            };
            diag.hint = Some(match &names[..] {
                [] => format!(
                    "no dialect turns the arcs of {dialect} the other way: look at them in a \
                     backplot; {as_they_are}"
                ),
                _ => format!("{} reads them the other way; {as_they_are}", names.join(" or ")),
            });
        }
        diag
    }

    /// Warns of a sign that contradicts the dialect that was chosen.
    fn warn_of_other_signs(&mut self) {
        let Some(found) = self.source.recognized() else { return };
        let Some((other, line)) = found.against else { return };
        let message =
            format!("line {line} shows that the text is from {other}, read as {}", found.dialect);
        self.tell(RunCode::OtherSigns.diag(message).at(TextSpan::line(&self.cl_name, line, "")));
    }

    /// Warns of records after FINI.
    ///
    /// # Errors
    /// What the reader refuses.
    pub fn after_fini(
        &mut self,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<(), Box<Diag>> {
        let more = self.source.read(record, vocabulary)?;
        self.warn_of_other_signs();
        if more {
            let place = self.place(record, vocabulary);
            self.tell(RunCode::AfterFini.diag("what follows is not posted").at(place));
        }
        Ok(())
    }
}

/// Shows the forms of a word whose form is refused, where the refusal has no hint of its own, or one
/// that names a word which has no place in them.
pub(super) fn name_forms(mut diag: Box<Diag>, word: &str) -> Box<Diag> {
    let form: &Code = PostCode::WordForm.into();
    if diag.code != form {
        return diag;
    }
    let fits = |hint: &str| match hint.strip_prefix("did you mean ") {
        Some(meant) => word_pages::names(word, meant.trim_end_matches('?')),
        None => true,
    };
    if !diag.hint.as_deref().is_some_and(fits) {
        let forms = word_pages::forms(word).map(|forms| format!("Forms: {forms}. "));
        let forms = forms.unwrap_or_default();
        diag.hint = Some(format!("{forms}`filpost explain {word}` shows more."));
    }
    diag
}
