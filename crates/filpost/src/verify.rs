//! Back-check of an NC program: against the CL file, or against a second run.
//!
//! Without FIL the CL file says what the program must do, and the comparison shares
//! nothing with the post. FIL sections make motions that no CL file determines; then
//! the post runs again in memory and the program is compared with what that run
//! makes. That finds what was changed in a program, not what a script does wrong.

use std::io::{Cursor, Read};

use fil_nc::dialect::Dialect;
use fil_nc::interpret;
use fil_nc::verify::{
    Allowed, Check, Report, compare_programs, compare_words, look_at_blocks, refuse_another_part,
    verify,
};

use crate::builder::Post;
use crate::error::Error;

/// What a program is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// The path of the CL file.
    ClFile,
    /// What the post with its FIL makes of the CL file in a second run.
    SecondRun,
}

/// An NC program to be checked.
#[derive(Clone, Copy, Debug)]
pub struct Program<'a> {
    /// Its text.
    pub text: &'a [u8],
    /// Its name in messages.
    pub name: &'a str,
}

impl Post {
    /// Compares a program with the CL file that it should come from; `allowed` is what
    /// it may be off by.
    ///
    /// # Errors
    /// A program or a CL file that can't be read, a program of another part; what
    /// the second run of a post with FIL refuses.
    pub fn verify(
        &mut self,
        mut cl: impl Read,
        program: Program<'_>,
        allowed: Allowed,
    ) -> Result<(Report, Reference), Error> {
        let dialect = Dialect::new(self.commons()).map_err(Error::Run)?;
        if self.has_fil() {
            let mut text = Vec::new();
            let name = self.cl_name.clone();
            cl.read_to_end(&mut text)
                .map_err(|error| crate::files::cant_read(name.as_ref(), &error))?;
            let report = self.against_second_run(text, program, &dialect, allowed)?;
            return Ok((report, Reference::SecondRun));
        }
        let events = interpret::events(program.text, program.name, &dialect).map_err(Error::Run)?;
        let check = Check {
            cl,
            cl_name: &self.cl_name,
            options: self.options,
            nc: program.text,
            events: &events,
            commons: self.commons(),
            allowed,
        };
        Ok((verify(check).map_err(Error::Run)?, Reference::ClFile))
    }

    fn has_fil(&self) -> bool {
        !self.module.files.is_empty()
    }

    /// Compares with what another run makes; files of scripts are not written. When
    /// that run's own program can't be followed, the blocks are compared.
    fn against_second_run(
        &mut self,
        cl: Vec<u8>,
        program: Program<'_>,
        dialect: &Dialect,
        Allowed { tolerance, between }: Allowed,
    ) -> Result<Report, Error> {
        let mut again = Vec::new();
        self.run_held(Cursor::new(cl), &mut again)?;
        let compared = match interpret::events(&again, "the second run", dialect) {
            Ok(again) => {
                interpret::events(program.text, program.name, dialect).and_then(|events| {
                    let mut report = compare_programs(&again, &events, tolerance);
                    look_at_blocks(&events, self.commons(), between, &mut report)?;
                    Ok(report)
                })
            }
            Err(refused) => {
                compare_words(&again, (program.text, program.name), &refused, tolerance)
            }
        };
        let report = compared.map_err(Error::Run)?;
        refuse_another_part(&report).map_err(Error::Run)?;
        Ok(report)
    }
}
