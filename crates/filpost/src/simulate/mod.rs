//! Material removal by an NC program: stock is cut with the tools of the program, and rapid traverse
//! through stock, a holder in stock, cutting with a stopped spindle and cuts below the finished part
//! are reported.
//!
//! [`Program::simulate`](crate::Program::simulate) does it, [`Run::cl_tools`](crate::Run::cl_tools)
//! takes the tools from the CL file. All lengths are millimeters in the coordinate system of the
//! part, volumes cubic millimeters, whatever the unit of the program.
//!
//! ```
//! use filpost::Levels;
//! use filpost::simulate::{Job, Offsets, Stock};
//! use filpost::verify::NcProgram;
//!
//! let program = filpost::Program::builder().ready("fanuc-mill").build()?;
//! let cl = "UNITS / MM\nCUTTER / 10\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nRAPID\nGOTO / -10, 10, 20\n\
//!     RAPID\nGOTO / -10, 10, -2\nFEDRAT / 200, MMPM\nGOTO / 60, 10, -2\nFINI\n";
//! let posted = program.post(cl)?;
//! let found = program.start().cl_tools(cl)?;
//! let stock = Stock::read("box 50x20x10")?.expect("a box");
//! let (levels, offsets) = (Levels::default(), Offsets::new());
//! let job = Job {
//!     stock: &stock, tools: &found.tools, part: None, part_tolerance: 0.05, grid: None, offsets: &offsets, levels: &levels,
//! };
//! let nc = NcProgram { text: posted.bytes(), name: "part.nc" };
//! let done = program.simulate(nc, &job)?;
//! assert!(done.report.findings.is_empty());
//! // A slot 50 long, 10 wide and 2 deep.
//! assert!((done.report.total() - 1000.0).abs() < 20.0);
//! # Ok::<(), filpost::Error>(())
//! ```

mod cl_tools;
mod json;
mod setup;

use fil_machine::commons::Commons;
use fil_nc::dialect::Dialect;
use fil_nc::forward::Forward;
use fil_nc::plot::Notes;

use crate::error::Error;
use crate::plot::{ClText, Text};
use crate::program::Program;
use crate::run::Run;
use crate::verify::NcProgram;

pub use cl_tools::ClTools;
#[doc(hidden)]
pub use cl_tools::cl_tools;
#[doc(inline)]
pub use fil_nc::motion::work_offset;
#[doc(inline)]
pub use fil_stock::{
    Body, Cylinder, Finding, Grid, HeightField, Insert, Job, Left, Mesh, Offsets, Profile, Report,
    Shape, Simulated, Size, Source, Stock, Tool, Tools,
};
pub use json::as_json;
pub use setup::Setup;
#[doc(hidden)]
pub use setup::stock_of;

impl Program {
    /// Cuts stock with an NC program of this machine; see [`mod@crate::simulate`].
    ///
    /// # Errors
    /// What has no sure meaning on the machine; E0961 for tools without a size, E0962 for a program
    /// that three axes in one coordinate system, or inserts of a lathe, do not describe, E0963 for too many cells, E0965
    /// for stock `auto` of a program without cuts below Z0.
    pub fn simulate(&self, nc: NcProgram<'_>, job: &Job<'_>) -> Result<Simulated, Error> {
        program(Text { name: nc.name, bytes: nc.text }, self.commons(), job)
    }
}

impl Run<'_> {
    /// The tools whose size a CL file gives, by the number of the tool change before or after
    /// CUTTER, `$$-> CUTTER` or TLDATA, for [`Program::simulate`].
    ///
    /// # Errors
    /// What the CL reader refuses.
    pub fn cl_tools(&self, cl: impl AsRef<[u8]>) -> Result<ClTools, Error> {
        let name = self.name();
        let text = Text { name: &name, bytes: cl.as_ref() };
        let cl = ClText { text, options: self.reading, unit: self.units };
        cl_tools(&cl, self.program.commons())
    }
}

/// Simulates an NC program on the machine of these settings.
///
/// ```
/// use filpost::plot::Text;
/// use filpost::stock::{Job, Offsets, Stock, Tool, Tools};
///
/// let nc = b"G21 G90 G94 G17\nT1 M6\nS900 M3\nG0 X-10. Y10.\nG43 Z20. H1\nG0 X60. Z-2.\nM30\n";
/// let commons = filpost::Program::builder().ready("fanuc-mill").build_machine()?;
/// let tools = Tools::from([(1, Tool::read("D10")?)]);
/// let stock = Stock::read("box 50x20x10")?.expect("a box");
/// let (levels, offsets) = (filpost::Levels::default(), Offsets::new());
/// let job = Job {
///     stock: &stock, tools: &tools, part: None, part_tolerance: 0.05, grid: None, offsets: &offsets, levels: &levels,
/// };
/// let nc = Text { name: "part.nc", bytes: nc };
/// let done = filpost::simulate::program(nc, &commons, &job)?;
/// assert_eq!(done.report.findings[0].code.name(), "E0971");
/// assert_eq!(done.report.findings[0].line, 6);
/// # Ok::<(), filpost::Error>(())
/// ```
///
/// # Errors
/// What has no sure meaning on the machine, and what can't be simulated (E0961 to E0965).
#[doc(hidden)]
pub fn program(nc: Text<'_>, commons: &Commons, job: &Job<'_>) -> Result<Simulated, Error> {
    let dialect = Dialect::new(commons).map_err(Error::Run)?;
    let forward = Forward::from_commons(commons).map_err(Error::Run)?;
    let program =
        fil_stock::Program { text: nc.bytes, name: nc.name, dialect: &dialect, forward: &forward };
    fil_stock::simulate(&program, job).map_err(Error::Run)
}

/// What made a line of a program, from the notes of its line map; `None` where they tell nothing.
#[doc(hidden)]
pub fn source(notes: &Notes<'_>, line: u32) -> Option<Source> {
    let cause = notes.causes.get((line as usize).checked_sub(1)?)?;
    let text = notes.origin(line as usize);
    (!text.is_empty()).then_some(Source { cl_line: cause.line, text })
}
