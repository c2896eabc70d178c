//! Back-check of an NC program: against the CL file, or against a second run.
//!
//! Without FIL the CL file says what the program must do, and the comparison shares
//! nothing with the post. FIL sections make motions that no CL file determines; then
//! the post runs again in memory and the program is compared with what that run
//! makes. That finds what was changed in a program, not what a script does wrong.

use std::io::{Cursor, Read};

use fil_cl::{Options, Reader};
use fil_diag::Diag;
use fil_machine::Commons;
use fil_nc::dialect::Dialect;
use fil_nc::interpret;
use fil_nc::motion::Event;
use fil_nc::verify::{
    Allowed, Check, Report, compare_programs, compare_words, look_at_blocks, refuse_another_part,
    verify,
};

use crate::error::Error;
use crate::program::Program;
use crate::run::Run;
use crate::units;

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
pub struct NcProgram<'a> {
    /// Its text.
    pub text: &'a [u8],
    /// Its name in messages.
    pub name: &'a str,
}

impl Run<'_> {
    /// Compares an NC program with the CL file that it should come from; `allowed`
    /// is what it may be off by. A program with FIL runs a second time, with the
    /// observers and the cancel token of this run.
    ///
    /// ```
    /// use filpost::nc::verify::{Allowed, Verdict};
    /// use filpost::verify::NcProgram;
    ///
    /// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
    /// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n".as_bytes();
    /// let mut nc = Vec::new();
    /// program.run(cl, &mut nc)?;
    /// let nc = NcProgram { text: &nc, name: "part.nc" };
    /// let (report, _) = program.start().verify(cl, nc, Allowed::default())?;
    /// assert_eq!(report.verdict(), Verdict::Agrees);
    /// # Ok::<(), filpost::Error>(())
    /// ```
    ///
    /// # Errors
    /// A program or a CL file that can't be read, a program of another part; what
    /// the second run of a post with FIL refuses.
    pub fn verify(
        self,
        mut cl: impl Read + Send,
        nc: NcProgram<'_>,
        allowed: Allowed,
    ) -> Result<(Report, Reference), Error> {
        self.against(&mut cl, nc, allowed)
    }

    fn against(
        self,
        cl: &mut (dyn Read + Send),
        nc: NcProgram<'_>,
        allowed: Allowed,
    ) -> Result<(Report, Reference), Error> {
        let dialect = Dialect::new(self.program.commons()).map_err(Error::Run)?;
        let name = self.name();
        if !self.program.shared.module.files.is_empty() {
            let mut text = Vec::new();
            cl.read_to_end(&mut text)
                .map_err(|error| crate::files::cant_read(name.as_ref(), &error))?;
            let report = self.against_second_run(text, nc, &dialect, allowed)?;
            return Ok((report, Reference::SecondRun));
        }
        if !interpret::has_skipped_blocks(nc.text, &dialect) {
            return Ok((self.against_cl(cl, nc, &dialect, allowed)?, Reference::ClFile));
        }
        // What the operator may leave out is run both ways.
        let mut text = Vec::new();
        cl.read_to_end(&mut text)
            .map_err(|error| crate::files::cant_read(name.as_ref(), &error))?;
        let report = self.against_cl(&mut &text[..], nc, &dialect, allowed.clone())?;
        let skipping = dialect.skipping_blocks();
        let left_out = self.against_cl(&mut &text[..], nc, &skipping, allowed)?;
        Ok((report.with_blocks_left_out(left_out), Reference::ClFile))
    }

    /// Compares with the path of the CL file, one way of the switch that leaves blocks out.
    fn against_cl(
        &self,
        cl: &mut (dyn Read + Send),
        nc: NcProgram<'_>,
        dialect: &Dialect,
        allowed: Allowed,
    ) -> Result<Report, Error> {
        let name = self.name();
        let events = events(nc, dialect).map_err(Error::Run)?;
        let known = units::known_before(self.units, self.program.commons()).map_err(Error::Run)?;
        let check = Check {
            cl: Reader::new(cl, &name, Options { raw: false, ..self.reading }),
            cl_name: &name,
            unit: known.map(|(unit, _)| unit),
            nc: nc.text,
            events: &events,
            commons: self.program.commons(),
            allowed,
            skips_blocks: dialect.leaves_blocks_out(),
        };
        verify(check).map_err(Error::Run)
    }

    /// Compares with what another run makes; files of scripts are not written. When
    /// that run's own program can't be followed, the blocks are compared.
    fn against_second_run(
        self,
        cl: Vec<u8>,
        nc: NcProgram<'_>,
        dialect: &Dialect,
        allowed: Allowed,
    ) -> Result<Report, Error> {
        let program: Program = self.program.clone();
        let mut again = Vec::new();
        self.run_pending(Cursor::new(cl), &mut again)?;
        let compare = |dialect: &Dialect| {
            compare_with_run(&again, nc, dialect, program.commons(), &allowed).map_err(Error::Run)
        };
        let mut report = compare(dialect)?;
        let texts = [&again[..], nc.text];
        if texts.iter().any(|text| interpret::has_skipped_blocks(text, dialect)) {
            report = report.with_blocks_left_out(compare(&dialect.skipping_blocks())?);
        }
        refuse_another_part(&report).map_err(Error::Run)?;
        Ok(report)
    }
}

/// Compares with a program that the post has made; when that can't be followed, by blocks.
fn compare_with_run(
    again: &[u8],
    nc: NcProgram<'_>,
    dialect: &Dialect,
    commons: &Commons,
    &Allowed { tolerance, between, .. }: &Allowed,
) -> Result<Report, Box<Diag>> {
    match interpret::events(again, "the second run", dialect) {
        Ok(again) => {
            let events = events(nc, dialect)?;
            let mut report = compare_programs(&again, &events, tolerance);
            look_at_blocks(&events, commons, between, &mut report)?;
            Ok(report)
        }
        Err(refused) => compare_words(again, (nc.text, nc.name), &refused, tolerance),
    }
}

/// What a program does; a refusal says when blocks are left out.
fn events(nc: NcProgram<'_>, dialect: &Dialect) -> Result<Vec<Event>, Box<Diag>> {
    interpret::events(nc.text, nc.name, dialect).map_err(|mut refused| {
        if dialect.leaves_blocks_out() {
            refused.message.push_str(", with the blocks behind / left out");
        }
        refused
    })
}
