//! A post in memory with its audit.

use std::io::Cursor;

use fil_nc::source::Source;

use super::Audit;
use crate::error::Error;
use crate::map::Names;
use crate::posted::Posted;
use crate::run::Run;

/// The name of the program in messages.
const NAME: &str = "the program";

impl Run<'_> {
    /// Posts the text of a CL file as [`Run::post`] does, and audits the program: what scripts and
    /// INSERT changed in it, and whether the rest does what the CL file asks for. A
    /// [`Verdict::Faulty`](super::Verdict::Faulty) program is not one to run.
    ///
    /// The CL file is posted once more, without scripts. Observers see the first run alone.
    ///
    /// ```
    /// use filpost::audit::Verdict;
    ///
    /// let fil = "CIMFIL/ON,COOLNT\nPOSTN/OUT,M,88\nCIMFIL/OFF\nFINI\n";
    /// let program = filpost::Program::builder().ready("fanuc-mill").fil("mill.fil", fil).build()?;
    /// let cl = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nCOOLNT / FLOOD\n\
    ///     FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
    /// let (posted, audit) = program.start().post_audited(cl)?;
    /// assert!(posted.text().contains("M88"));
    /// assert_eq!(audit.verdict(), Verdict::Changed);
    /// let change = audit.changes[0].to_string();
    /// assert!(change.starts_with("mill.fil:2 section COOLNT, CL line 4: `M8` -> `M88`"), "{change}");
    /// # Ok::<(), filpost::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Run::post`]; what the audit finds is no error.
    pub fn post_audited(self, cl: impl AsRef<[u8]>) -> Result<(Posted, Audit), Error> {
        self.post_text_audited(cl.as_ref())
    }

    fn post_text_audited(self, cl: &[u8]) -> Result<(Posted, Audit), Error> {
        let (judge, again) = (self.of_program(self.program.clone()), self.again());
        let names = Names { cl: self.name(), fil: self.program.fil_files(), ..Names::default() };
        let mut lines = Vec::new();
        let (mut posted, pending) =
            self.mapped(Cursor::new(cl), &names, &mut lines, |run, reader, first, map| {
                let (posted, pending, map) = run.post_text_read(reader, first, Some(map))?;
                Ok(((posted, pending), map))
            })?;
        again.warn_of_undecided(cl, &mut posted.report)?;
        let nc = Source::memory(posted.bytes());
        let audit = judge.audit(cl, (&nc, NAME), &mut Cursor::new(lines))?;
        pending.commit()?;
        Ok((posted, audit))
    }
}
