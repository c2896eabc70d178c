//! Back-check of an NC program: against the CL file, or against a second run.
//!
//! Without FIL the CL file says what the program must do, and the comparison shares
//! nothing with the post. FIL sections make motions that no CL file determines; then
//! the post runs again in memory and the program is compared with what that run
//! makes. That finds what was changed in a program, not what a script does wrong.

mod json;

use std::io::{self, Read, Seek};

use fil_cl::{Options, Reader};
use fil_diag::Diag;
use fil_nc::dialect::Dialect;
use fil_nc::events::ahead;
use fil_nc::interpret::{PassedOver, Running, has_skipped_blocks};
use fil_nc::source::Source;
use fil_nc::verify::{
    Check, Programs, Unfollowed, compare_programs, compare_words, refuse_another_part, verify,
};

use crate::error::Error;
use crate::files;
use crate::program::Program;
use crate::run::Run;
use crate::spool::{Spool, into_source, spool};
use crate::units;

#[doc(inline)]
pub use fil_nc::motion::work_offset;
#[doc(inline)]
pub use fil_nc::verify::{
    Allowed, Between, Deviation, Finding, FindingKind, Peak, Report, Unverified, Verdict,
};
pub use json::as_json;
pub(crate) use json::finding_as_json;

/// Bytes that are kept in memory of a text that is read twice; more lie in a file.
const IN_MEMORY: usize = 1 << 20;

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
    /// use filpost::verify::{Allowed, NcProgram, Verdict};
    ///
    /// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
    /// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n".as_bytes();
    /// let posted = program.post(cl)?;
    /// let nc = NcProgram { text: posted.bytes(), name: "part.nc" };
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
        cl: impl Read + Send,
        nc: NcProgram<'_>,
        allowed: Allowed,
    ) -> Result<(Report, Reference), Error> {
        self.verify_source(cl, (&Source::memory(nc.text), nc.name), allowed)
    }

    /// The same for a program wherever its text lies, with its name in messages. Of files
    /// only what the comparison looks ahead is kept in memory.
    ///
    /// # Errors
    /// As [`Run::verify`].
    #[doc(hidden)]
    pub fn verify_source(
        self,
        mut cl: impl Read + Send,
        nc: (&Source<'_>, &str),
        allowed: Allowed,
    ) -> Result<(Report, Reference), Error> {
        let dialect = Dialect::new(self.program.commons()).map_err(Error::Run)?;
        let nc = (&nc.0.in_page(self.program.nc_page()), nc.1);
        if !self.program.shared.module.files.is_empty() {
            let text = self.spool(&mut cl)?;
            let report = self.against_second_run(text, nc, &dialect, &allowed)?;
            return Ok((report, Reference::SecondRun));
        }
        if !has_skipped_blocks(nc.0, nc.1, &dialect).map_err(Error::Run)? {
            return Ok((self.against_cl(&mut cl, nc, &dialect, allowed)?, Reference::ClFile));
        }
        // What the operator may leave out is run both ways, one after the other.
        let mut text = self.spool(&mut cl)?;
        let report = self.against_cl(&mut text, nc, &dialect, allowed.clone())?;
        text.rewind().map_err(|error| files::cant_read(self.name().as_ref(), &error))?;
        let skipping = dialect.skipping_blocks();
        let left_out = self.against_cl(&mut text, nc, &skipping, allowed)?;
        Ok((report.with_blocks_left_out(left_out), Reference::ClFile))
    }

    /// A CL file that can be read twice, at its start.
    pub(crate) fn spool(&self, cl: &mut dyn Read) -> Result<Spool, Error> {
        let mut text = spool(IN_MEMORY);
        let spooled = io::copy(cl, &mut text).and_then(|_| text.rewind());
        spooled.map_err(|error| files::cant_read(self.name().as_ref(), &error))?;
        Ok(text)
    }

    /// Compares with the path of the CL file, one way of the switch that leaves blocks out.
    fn against_cl(
        &self,
        cl: &mut (dyn Read + Send),
        (nc, nc_name): (&Source<'_>, &str),
        dialect: &Dialect,
        allowed: Allowed,
    ) -> Result<Report, Error> {
        let name = self.name();
        let known =
            units::known_before(self.units, None, self.program.commons()).map_err(Error::Run)?;
        let passed = PassedOver::default();
        let program = Running::new(nc, nc_name, dialect).passing_over(&passed);
        let compared = ahead(program, |events| {
            verify(Check {
                cl: Reader::new(cl, &name, Options { raw: false, ..self.reading }),
                cl_name: &name,
                unit: known.map(|(unit, _)| unit),
                nc,
                nc_name,
                events,
                passed: &passed,
                commons: self.program.commons(),
                allowed,
                skips_blocks: dialect.leaves_blocks_out(),
            })
        });
        compared.map_err(Error::Run)
    }

    /// Compares with what another run makes; files of scripts are not written. When
    /// that run's own program can't be followed, the blocks are compared.
    fn against_second_run(
        self,
        cl: Spool,
        nc: (&Source<'_>, &str),
        dialect: &Dialect,
        allowed: &Allowed,
    ) -> Result<Report, Error> {
        let program: Program = self.program.clone();
        let mut again = spool(IN_MEMORY);
        self.run_pending(cl, &mut again)?;
        let again = into_source(again).into_page(program.nc_page());
        let again = (&again, "the second run");
        let compare = |dialect: &Dialect| {
            let mut reference = Running::new(again.0, again.1, dialect);
            let compared = ahead(Running::new(nc.0, nc.1, dialect), |found| {
                let commons = program.commons();
                compare_programs(Programs { reference: &mut reference, found, commons, allowed })
            });
            match compared {
                Ok(report) => Ok(report),
                Err(Unfollowed::Found(refused)) => Err(refused),
                Err(Unfollowed::Reference(refused)) => {
                    compare_words(again.0, nc, &refused, allowed.tolerance)
                }
            }
        };
        let both_ways = || -> Result<Report, Box<Diag>> {
            let report = compare(dialect)?;
            for (text, name) in [again, nc] {
                if has_skipped_blocks(text, name, dialect)? {
                    return Ok(report.with_blocks_left_out(compare(&dialect.skipping_blocks())?));
                }
            }
            Ok(report)
        };
        let report = both_ways().map_err(Error::Run)?;
        refuse_another_part(&report).map_err(Error::Run)?;
        Ok(report)
    }
}
