//! Material removal by an NC program: the tools that a CL file describes, the program's machine,
//! what made the lines of findings.

mod cl_tools;
mod json;
mod setup;

use fil_machine::commons::Commons;
use fil_nc::dialect::Dialect;
use fil_nc::forward::Forward;
use fil_nc::plot::Notes;
use fil_stock::{Job, Simulated, Source};

use crate::error::Error;
use crate::plot::Text;

pub use cl_tools::{ClTools, cl_tools};
pub use json::as_json;
pub use setup::Setup;

/// Simulates an NC program on the machine of these settings.
///
/// ```
/// use filpost::plot::Text;
/// use filpost::stock::{Job, Offsets, Stock, Tool, Tools};
///
/// let nc = b"G21 G90 G94 G17\nT1 M6\nS900 M3\nG0 X-10. Y10.\nG43 Z20. H1\nG0 X60. Z-2.\nM30\n";
/// let commons = filpost::Program::builder().ready("fanuc-mill").build_machine()?;
/// let tools = Tools::from([(1, Tool::read("D10").map_err(filpost::Error::Run)?)]);
/// let stock = Stock::read("box 50x20x10").map_err(filpost::Error::Run)?.expect("a box");
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
pub fn program(nc: Text<'_>, commons: &Commons, job: &Job<'_>) -> Result<Simulated, Error> {
    let dialect = Dialect::new(commons).map_err(Error::Run)?;
    let forward = Forward::from_commons(commons).map_err(Error::Run)?;
    let program =
        fil_stock::Program { text: nc.bytes, name: nc.name, dialect: &dialect, forward: &forward };
    fil_stock::simulate(&program, job).map_err(Error::Run)
}

/// What made a line of a program, from the notes of its line map; `None` where they tell nothing.
pub fn source(notes: &Notes, line: u32) -> Option<Source> {
    let cause = notes.causes.get((line as usize).checked_sub(1)?)?;
    let text = notes.origin(line as usize);
    (!text.is_empty()).then_some(Source { cl_line: cause.line, text })
}
