//! The command line of `filpost simulate`, and of the stock of `filpost verify`.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use filpost::stock::{self, Tool};

use super::{Chosen, ClReading, LevelArgs, Report, Units};

/// `filpost simulate`
#[derive(Debug, ClapArgs)]
pub struct SimulateArgs {
    /// The NC program, or the folder of a case; - reads standard input
    pub nc: PathBuf,
    /// The machine that the program is for
    #[command(flatten)]
    pub chosen: Chosen,
    #[command(flatten)]
    pub material: MaterialArgs,
    /// The CL file of the program: its CUTTER and TLDATA statements give the tools
    #[arg(long, value_name = "PART")]
    pub cl: Option<PathBuf>,
    #[command(flatten)]
    pub units: Units,
    #[command(flatten)]
    pub cl_reading: ClReading,
    /// Encoding of the CL file's texts (utf-8, cp1251, koi8-r, …); guessed when left out
    #[arg(long, value_name = "LABEL")]
    pub encoding: Option<String>,
    /// The line map of the program; NC.map when it is there
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    #[command(flatten)]
    pub levels: LevelArgs,
    /// Write the stock after the last cut as STL
    #[arg(long, value_name = "OUT")]
    pub write_stock: Option<PathBuf>,
    /// Format of the findings
    #[arg(long, value_enum, default_value_t = Report::Text)]
    pub format: Report,
}

/// Stock, part and tools.
#[derive(Debug, Default, ClapArgs)]
pub struct MaterialArgs {
    /// The stock: box:100x80x30@X,Y,Z, cylinder:60x100@X,Y,Z, tube:60x20x100, auto, or an STL file;
    /// left out, that of the setup file, the case or the machine
    #[arg(long, value_name = "STOCK", num_args = 0..=1)]
    pub stock: Option<Option<String>>,
    /// The finished part, an STL file, below whose surface nothing may be cut
    #[arg(long, value_name = "FILE")]
    pub part: Option<PathBuf>,
    /// How far a cut may be within the part; 0.05mm when left out
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub part_tol: Option<f64>,
    /// Size of a cell; a 400th of the stock when left out
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub grid: Option<f64>,
    /// Size of a tool, as 1=D10R0.5L50H40x60: diameter, corner radius, length below the holder,
    /// holder; A point angle, F flat tip, C diameter without teeth (may be given again)
    #[arg(long, value_name = "N=SIZE", value_parser = tool)]
    pub tool: Vec<(u32, Tool)>,
    /// Where a further work offset lies, as G55=60,0,0: its zero in the first one (may be given again)
    #[arg(long, value_name = "G=X,Y,Z", value_parser = offset)]
    pub offset: Vec<(u32, [f64; 3])>,
    /// A TOML file with stock, part, part_tol, grid, and the tables `tools` and `offsets`; options
    /// win over it. Left out: stock.toml or case.toml next to the part, stock.toml next to the machine
    #[arg(long, value_name = "FILE")]
    pub setup: Option<PathBuf>,
}

impl MaterialArgs {
    /// True when an option asks for a simulation.
    pub fn is_asked(&self) -> bool {
        self.stock.is_some()
            || self.part.is_some()
            || self.part_tol.is_some()
            || self.grid.is_some()
            || !self.tool.is_empty()
            || !self.offset.is_empty()
            || self.setup.is_some()
    }
}

fn length(text: &str) -> Result<f64, String> {
    stock::length(text).ok_or_else(|| "write a length above 0: 0.5, 0.5mm or 0.02in".to_string())
}

/// A work offset with its place.
fn offset(text: &str) -> Result<(u32, [f64; 3]), String> {
    let wrong = || "write a work offset with its place: G55=60,0,0".to_string();
    let (name, place) = text.split_once('=').ok_or_else(wrong)?;
    let fixture = filpost::nc::motion::work_offset(name.trim()).ok_or_else(wrong)?;
    Ok((fixture, stock::place(place).ok_or_else(wrong)?))
}

/// A tool with its number.
fn tool(text: &str) -> Result<(u32, Tool), String> {
    let wrong = || "write N=SIZE, as 1=D10R0.5L50".to_string();
    let (number, size) = text.split_once('=').ok_or_else(wrong)?;
    let number = number.trim().parse().map_err(|_| wrong())?;
    Ok((number, Tool::read(size).map_err(|diag| diag.message)?))
}
