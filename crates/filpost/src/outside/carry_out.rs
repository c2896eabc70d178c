//! One record carried out by the post.

use fil_cl::vocabulary::words;
use fil_cl::{Record, Vocabulary, Word, record::kind};
use fil_diag::Diag;
use fil_machine::locations::MESSAGE_TO_TAPE;

use super::Outside;
use super::told::name_forms;
use crate::cancel::CancelToken;
use crate::event::Event;
use crate::overview::Counted;
use crate::report::Extents;
use crate::tally::{Before, Motion};
use crate::units::UnitSource;

impl Outside<'_, '_> {
    /// The post carries out a record, or what one means that is given as it is written.
    pub fn process(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
        if self.careful {
            return self.process_carefully(record, vocabulary);
        }
        self.carry_out(record, vocabulary)
    }

    #[cold]
    fn process_carefully(
        &mut self,
        record: &Record,
        vocabulary: &Vocabulary,
    ) -> Result<(), Box<Diag>> {
        if self.raw && record.line != 0 {
            return self.process_written(record, vocabulary);
        }
        self.carry_out_counted(record, vocabulary)
    }

    #[cold]
    fn process_written(
        &mut self,
        record: &Record,
        vocabulary: &Vocabulary,
    ) -> Result<(), Box<Diag>> {
        let place = |diag: Box<Diag>| {
            if diag.spans.is_empty() {
                Box::new(diag.at(self.place(record, vocabulary)))
            } else {
                diag
            }
        };
        match self.source.written.meant_by(record).map_err(place)? {
            None => self.carry_out_counted(record, vocabulary),
            Some(meant) => meant.iter().try_for_each(|one| self.carry_out_counted(one, vocabulary)),
        }
    }

    /// Carries out a record and counts its motion, where somebody looks on.
    fn carry_out_counted(
        &mut self,
        record: &Record,
        vocabulary: &Vocabulary,
    ) -> Result<(), Box<Diag>> {
        let before = Before::new(&self.post);
        self.last_done = record.number;
        self.carry_out(record, vocabulary)?;
        let Some(tally) = &mut self.tally else { return Ok(()) };
        let other_seconds = tally.total.other_seconds;
        let motion = tally.count(&before, record, &self.post);
        if let Some(overview) = self.pass.counted() {
            let counted = Counted {
                motion,
                other_seconds: tally.total.other_seconds
                    - other_seconds
                    - motion.as_ref().map_or(0.0, Motion::dwell),
                diameter: self.source.diameter(),
                corner: self.source.corner(),
                unit: self.post.unit(),
                is_moved: self.post.moves_points(),
                writes_z: writes_z(record, vocabulary),
            };
            overview.count(record, self.post.control.tape.cause.record, &counted);
        }
        if let Some(motion) = motion {
            for observer in self.observers.iter_mut() {
                observer(Event::Motion(motion));
            }
        }
        Ok(())
    }

    /// The post carries out a record; what it says gets the place in the CL file,
    /// or in FIL for a record that FIL has made.
    fn carry_out(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
        if record.major == words::PPRINT && !self.post.control.commons.read(MESSAGE_TO_TAPE) {
            for observer in self.observers.iter_mut() {
                observer(Event::Message(record.text.trim_end()));
            }
        }
        let author_blocks = self.post.control.warnings.author_blocks;
        let mut result = self.post.begin(record, vocabulary);
        if self.post.control.warnings.author_blocks != author_blocks && record.line != 0 {
            self.of_author.clone_from(record);
        }
        if result.is_ok() && self.post.has_more() {
            result = self.go_on();
        }
        if matches!(record.major, words::UNITS | words::UNIT) {
            self.report.unit = self.post.unit().map(|unit| (unit, UnitSource::Statement));
        }
        if result.is_err() || !self.post.control.warnings.is_empty() {
            let place = self.place(record, vocabulary);
            self.take_warnings(Some(&place), vocabulary);
            // The machine itself adds the FIL line to an error.
            let made_by_fil = self.fil_line(record).is_some();
            let name = vocabulary.name(record.major);
            let result = result.map_err(|diag| self.name_dialects(name_forms(diag, name)));
            let author = self.post.control.warnings.denied.take();
            let author = author.map(|author| self.place_of_author(author, vocabulary));
            result.map_err(|mut diag| {
                if !made_by_fil {
                    diag.spans.push(place);
                    diag.spans.extend(author.map(|place| place.label("this block leaves it open")));
                }
                diag
            })?;
        }
        if record.kind == kind::MOTION {
            if let Some(point) = self.post.point() {
                Extents::add(&mut self.report.extents, point);
            }
        } else if matches!(record.major, words::POSTN | words::REPEAT) {
            self.report.may_leave_extents = true;
        }
        self.ended |= record.kind == kind::FINI;
        Ok(())
    }

    /// Carries out the rest of a record of very many blocks; the finished ones leave memory.
    #[cold]
    fn go_on(&mut self) -> Result<(), Box<Diag>> {
        while self.post.has_more() {
            self.spill()?;
            self.cancel.as_ref().map_or(Ok(()), CancelToken::check)?;
            self.post.go_on()?;
        }
        Ok(())
    }
}

/// True for words of Z that no motion is.
fn writes_z(record: &Record, vocabulary: &Vocabulary) -> bool {
    let is_z = |word: &Word| matches!(word, Word::Minor(id) if vocabulary.name(*id) == "Z");
    matches!(record.major, words::POSTN | words::REPEAT) && record.data.iter().any(is_z)
}
