//! What a run has to tell at its end.

use std::collections::BTreeMap;
use std::path::PathBuf;

use fil_cl::{Recognized, SplineCounts};
use fil_diag::Diag;
use fil_machine::Unit;

use crate::select::Machin;
use crate::units::UnitSource;

/// Smallest box around the CL points of a run, in the unit of the CL file ([`Report::unit`]) and the
/// coordinates of the part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extents {
    /// Smallest x, y, z.
    pub min: [f64; 3],
    /// Largest x, y, z.
    pub max: [f64; 3],
}

impl Extents {
    /// Widens the box to a point.
    pub(crate) fn add(extents: &mut Option<Extents>, point: [f64; 3]) {
        let found = extents.get_or_insert(Extents { min: point, max: point });
        for (axis, value) in point.into_iter().enumerate() {
            // A point of a CL file is finite.
            if value < found.min[axis] {
                found.min[axis] = value;
            }
            if value > found.max[axis] {
                found.max[axis] = value;
            }
        }
    }
}

/// Counts, warnings and extents of a run.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Report {
    /// CL records read.
    pub records: u64,
    /// Blocks written.
    pub blocks: u64,
    /// Bytes written.
    pub bytes: u64,
    /// Warnings of the run, in the order they were found.
    pub warnings: Vec<Diag>,
    /// Warnings of [building](crate::Program::warnings) the program that was run; the same for
    /// each of its runs.
    pub build_warnings: Vec<Diag>,
    /// The dialect of the CL text, and why it was taken; `None` for records from memory.
    pub dialect: Option<Recognized>,
    /// The splines of the CL text that were read as lines, and the tolerance.
    pub splines: SplineCounts,
    /// The unit of CL file and program, and who has said it; `None` where nothing
    /// did, so that there is no motion.
    pub unit: Option<(Unit, UnitSource)>,
    /// The machines that MACHIN records name, each once, with the CL line.
    pub machines: Vec<(Machin, u32)>,
    /// The box around the points of the CL records that the post has carried out. The
    /// program itself may reach further: see [`Report::may_leave_extents`].
    pub extents: Option<Extents>,
    /// POSTN or REPEAT have written words beside those points, so that the program may
    /// leave `extents`: the summary and the listing don't show them.
    pub may_leave_extents: bool,
    /// Records for which a section gave the post nothing, by section. What the section
    /// kept of them in its variables may act later.
    pub swallowed: BTreeMap<String, u64>,
    /// Files that FIL has written or deleted.
    pub script_files: Vec<PathBuf>,
    /// Files that FIL has read, each once.
    pub script_reads: Vec<PathBuf>,
}

impl Report {
    /// All warnings: those of building the program, then those of the run.
    ///
    /// ```
    /// let machine = "base = 'fanuc-mill'\n[seqno]\nincrement = 5\n";
    /// let program = filpost::Program::builder().machine("machine.toml", machine).build()?;
    /// let posted = program.post("UNITS / MM\nLOADTL / 1\n")?;
    /// let codes: Vec<String> = posted.report().all_warnings().map(|w| w.code.to_string()).collect();
    /// assert!(codes.contains(&"W0752".to_string()), "FINI is missing");
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn all_warnings(&self) -> impl Iterator<Item = &Diag> {
        self.build_warnings.iter().chain(&self.warnings)
    }
}
