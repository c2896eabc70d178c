//! After the first error: the rest of the CL file is looked at for further ones. Nothing is
//! written, nobody is told of events, and memory does not grow.

use fil_cl::record::{kind, motion};
use fil_diag::{Code, Diag};
use fil_machine::Unit;
use fil_post::errors::PostCode;
use fil_post::site_word;

use crate::doubt::{Doubt, left_without, rests_on};
use crate::engine::Engine;
use crate::error::{Error, RunCode};
use crate::refusals::Refusals;

/// What was found by now, and what can't be judged any more.
#[derive(Default)]
struct Survey {
    refusals: Refusals,
    doubt: Doubt,
}

impl Engine<'_, '_> {
    /// All that is wrong with the CL file from the record on that was refused.
    pub(crate) fn survey(&mut self, first: Box<Diag>) -> Error {
        let at_start = self.outside.source.records == 0 && self.outside.source.is_sound();
        if at_start || is_of_the_run(first.code) {
            return Error::Run(first);
        }
        self.outside.observers.clear();
        let map = self.outside.map.take();
        let warnings = self.outside.report.warnings.len();
        let mut survey = Survey::default();
        let mut next = self.refused(&mut survey, first);
        while matches!(next, Ok(true)) && !self.outside.ended {
            next = self.look_at_next(&mut survey);
            self.outside.forget_blocks();
            self.outside.report.warnings.truncate(warnings);
        }
        self.outside.map = map;
        survey.refusals.note_listed(self.outside.post.control.commons.words_without_effect());
        match next {
            Err(stopped) => Error::Run(stopped),
            Ok(_) => Error::Refused(Box::new(survey.refusals)),
        }
    }

    /// Looks at the next record; false after the last one.
    ///
    /// # Errors
    /// The embedding program has stopped the run.
    fn look_at_next(&mut self, survey: &mut Survey) -> Result<bool, Box<Diag>> {
        match self.outside.read(&mut self.record, &mut self.vocabulary) {
            Ok(true) => {}
            Ok(false) => {
                if let Some(diag) = survey.ended(self.outside.end_of_file(&self.vocabulary).err()) {
                    survey.refusals.add(*diag);
                }
                return Ok(false);
            }
            Err(diag) => return self.refused(survey, diag),
        }
        let is_last = self.record.kind == kind::FINI;
        let ends_arc = self.outside.post.path.arc.is_some();
        let section = self.section();
        let runs = survey.doubt.is_none() && self.outside.program.shared.spawn.is_none();
        let result = match section {
            Some(section) if runs => self.watch_progress().and_then(|()| self.run_section(section)),
            Some(_) => {
                survey.doubt = Doubt::ALL;
                Ok(())
            }
            None => self.outside.process(&self.record, &self.vocabulary),
        };
        if let Err(diag) = result {
            return Ok(self.refused(survey, diag)? && !is_last);
        }
        let is_point = self.record.kind == kind::MOTION
            && matches!(self.record.sub, motion::GOTO | motion::FROM);
        if is_point && section.is_none() && !ends_arc {
            survey.doubt = survey.doubt.without(Doubt::POSITION);
        }
        Ok(!is_last && !self.outside.ended)
    }

    /// Notes the error of the current record; false when nothing can follow.
    ///
    /// # Errors
    /// The embedding program has stopped the run.
    fn refused(&mut self, survey: &mut Survey, diag: Box<Diag>) -> Result<bool, Box<Diag>> {
        if is_code(diag.code, RunCode::Cancelled) {
            return Err(diag);
        }
        let in_section = self.outside.section.take().is_some();
        if fil_vm::errors::RunCode::ALL.contains(diag.code) {
            survey.refusals.add(*diag);
            return Ok(false);
        }
        if let Some(unread) = self.outside.source.resume() {
            if survey.doubt.is_none() || !unread.leans_on_earlier {
                survey.refusals.add(*diag);
            }
            let left = unread.word.filter(|_| !in_section).map_or(Doubt::ALL, Doubt::left_by);
            survey.doubt = survey.doubt.and(left);
            self.let_go(survey.doubt);
            return Ok(unread.goes_on);
        }
        if in_section {
            // A section runs only while nothing is in doubt.
            survey.refusals.add(*diag);
            survey.doubt = Doubt::ALL;
        } else if self.may_be_without_effect(&diag) {
            // What follows is judged as if the word were listed.
            survey.refusals.note_word(self.vocabulary.name(self.record.major), true);
            survey.refusals.add(*diag);
            return Ok(true);
        } else {
            self.refused_by_post(survey, *diag);
        }
        self.let_go(survey.doubt);
        Ok(true)
    }

    /// True for the refusal of a word that may be without effect.
    fn may_be_without_effect(&self, diag: &Diag) -> bool {
        is_code(diag.code, PostCode::UnknownWord)
            && site_word::may_be_without_effect(&self.record, &self.vocabulary)
    }

    /// Notes the error of a record that the post has refused.
    fn refused_by_post(&self, survey: &mut Survey, diag: Diag) {
        let (code, mut word) = (diag.code, self.record.major);
        if is_code(code, PostCode::UnknownWord) {
            survey.refusals.note_word(self.vocabulary.name(word), false);
            let meant = site_word::perhaps_meant(word, &self.vocabulary);
            word = meant.and_then(|meant| self.vocabulary.find(meant)).unwrap_or(word);
        }
        if !survey.doubt.overlaps(rests_on(code, &self.record)) {
            survey.refusals.add(diag);
        }
        survey.doubt = survey.doubt.and(left_without(code)).and(Doubt::left_by(word));
    }

    /// Lets go of what the refused record has begun. Without a feed or a unit no motion could
    /// be looked at.
    fn let_go(&mut self, doubt: Doubt) {
        self.outside.post.let_go();
        if doubt.overlaps(Doubt::FEED) {
            self.outside.post.assume_feed();
        }
        if doubt.overlaps(Doubt::UNIT) {
            self.outside.post.assume_unit(Unit::Mm);
        }
    }
}

impl Survey {
    /// The error at the end of the file, where nothing is in doubt.
    fn ended(&self, error: Option<Box<Diag>>) -> Option<Box<Diag>> {
        error.filter(|_| self.doubt.is_none())
    }
}

/// True for an error that is no matter of the CL file.
fn is_of_the_run(code: &'static Code) -> bool {
    is_code(code, RunCode::Cancelled)
        || is_code(code, RunCode::CantRead)
        || is_code(code, RunCode::CantWrite)
}

fn is_code(code: &'static Code, other: impl Into<&'static Code>) -> bool {
    code == other.into()
}
