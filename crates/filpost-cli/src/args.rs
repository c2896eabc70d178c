//! The command line.

mod learn;
mod levels;
mod machine;
mod names;
mod plot;
mod simulate;
mod studio;
mod test;
mod trace;

use std::path::PathBuf;

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use filpost::CodePage;
use filpost::cl::ClDialect;
use filpost::{Moment, Unit};

use crate::version;

pub use learn::LearnArgs;
pub use levels::LevelArgs;
pub use machine::{MachineArgs, MachineCommand};
pub use plot::{PlotArgs, Seen};
pub use simulate::{MaterialArgs, SimulateArgs};
pub use studio::StudioArgs;
pub use test::{Shard, TestArgs};
pub use trace::{AnswerFormat, TraceArgs};

/// Posts CL files with FIL macros into NC programs.
#[derive(Debug, Parser)]
#[command(name = "filpost", version, max_term_width = 100, long_version = version::LONG.as_str())]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Post a CL file: CL, FIL and machine in, NC program out
    Post(PostArgs),
    /// Check FIL files without a CL file
    Check(CheckArgs),
    /// Give FIL files their canonical layout
    Fmt(FmtArgs),
    /// Show the records of a CL file with their numbered words
    Cl(ClArgs),
    /// Compare two NC programs word by word, as a control reads them
    Diff(DiffArgs),
    /// Check an NC program against the CL file it was made from
    Verify(VerifyArgs),
    /// Draw the path of a CL file or of an NC program, as SVG or as a page
    Plot(PlotArgs),
    /// Cut stock with an NC program: rapid through stock, holder in stock, cuts below the part
    Simulate(SimulateArgs),
    /// Run regression cases (folders with a case.toml)
    Test(TestArgs),
    /// Show which CL record and FIL line produced a block, or what a record or FIL line produced
    Trace(TraceArgs),
    /// Explain an error code, a setting, a word, a function, a G or M code, or a ready post
    Explain(ExplainArgs),
    /// List the ready posts, or the options of one
    Posts(PostsArgs),
    /// Import and show machine settings
    Machine(MachineArgs),
    /// Find the settings of a post from pairs of CL file and proven NC program
    Learn(LearnArgs),
    /// Post a case at each save, and show what has changed
    Watch(WatchArgs),
    /// Serve an editor: the language server, over standard input and output
    Lsp,
    /// Serve an editor: the debugger, over standard input and output
    Dap,
    /// Make a folder with the start of your own post
    New(NewArgs),
    /// Create, run and check a post in one page of the browser
    Studio(StudioArgs),
    /// Print the manual page of filpost or of a command
    Man {
        /// A command, such as post
        command: Option<String>,
    },
    /// Print completions for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// Which post: machine, FIL and how they are read.
#[derive(Debug, Default, ClapArgs)]
pub struct Chosen {
    /// A ready post by name, or a folder with machine.toml and post.fil
    #[arg(short, long, value_name = "POST", value_parser = names::post(), hide_possible_values = true)]
    pub post: Option<String>,
    /// machine.toml, or an option file (uncx01.pNN); with --post a machine.toml over its settings
    #[arg(short, long, value_name = "FILE")]
    pub machine: Option<PathBuf>,
    /// One more setting on top (may be given again)
    #[arg(long, value_name = "KEY=VALUE", value_parser = names::setting(), hide_possible_values = true)]
    pub set: Vec<String>,
    /// An option of the post; `filpost posts POST` lists them (may be given again)
    #[arg(long, value_name = "NAME=VALUE", value_parser = option)]
    pub option: Vec<(String, String)>,
}

fn option(text: &str) -> Result<(String, String), String> {
    let given = text.split_once('=').filter(|(name, _)| !name.trim().is_empty());
    let given = given.map(|(name, value)| (name.trim().to_string(), value.trim().to_string()));
    given.ok_or_else(|| "write NAME=VALUE, as preload=no".to_string())
}

/// `filpost posts`
#[derive(Debug, ClapArgs)]
pub struct PostsArgs {
    /// The post whose options are listed: a ready post or a folder with machine.toml
    #[arg(value_name = "POST")]
    pub post: Option<String>,
    /// Write JSON
    #[arg(long)]
    pub json: bool,
}

/// `filpost new`
#[derive(Debug, ClapArgs)]
pub struct NewArgs {
    /// The folder to make; nothing of that name may be there
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// The ready post to start from (`filpost posts` lists them)
    #[arg(long, value_name = "POST", default_value = filpost::ready::GENERIC_MILL, value_parser = names::post(), hide_possible_values = true)]
    pub base: String,
}

/// How FIL is read.
#[derive(Debug, ClapArgs)]
pub struct Reading {
    /// File with your site's readings of POSTF numbers and sections, where ours differ
    #[arg(long, value_name = "FILE")]
    pub compat: Option<PathBuf>,
    /// Refuse filpost's extensions, to keep a script portable
    #[arg(long)]
    pub strict: bool,
    /// Levels of codes
    #[command(flatten)]
    pub levels: LevelArgs,
    /// Encoding of all input texts (utf-8, cp1251, koi8-r, …); guessed when left out
    #[arg(long, value_name = "LABEL")]
    pub encoding: Option<String>,
}

/// How CL text is read.
#[derive(Debug, Default, ClapArgs)]
pub struct ClReading {
    /// Dialect of the CL file, a name of `filpost cl --dialects`; recognized when left out
    #[arg(long, value_name = "NAME")]
    pub dialect: Option<ClDialect>,
}

/// In which form sections see the records of the CL file.
#[derive(Clone, Copy, Debug, Default, ClapArgs)]
pub struct RawRecords {
    /// Pass records to FIL sections as the CAM system wrote them, not converted to Creo's form; the
    /// post still carries out what they mean
    #[arg(long)]
    pub raw_records: bool,
}

/// The unit of the CL file.
#[derive(Clone, Copy, Debug, Default, ClapArgs)]
pub struct Units {
    /// The unit of a CL file that has no UNITS statement: mm or inch
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    pub units: Option<Unit>,
}

fn unit(name: &str) -> Result<Unit, String> {
    filpost::unit_named(name).ok_or_else(|| "write mm or inch".to_string())
}

/// `filpost post`
#[derive(Debug, ClapArgs)]
pub struct PostArgs {
    /// The CL file, or several, or a folder of them; - reads standard input
    #[arg(required = true, value_name = "CL")]
    pub cl: Vec<PathBuf>,
    #[command(flatten)]
    pub chosen: Chosen,
    /// A FIL file (may be given again; all share one name space)
    #[arg(short, long, value_name = "FILE")]
    pub fil: Vec<PathBuf>,
    #[command(flatten)]
    pub reading: Reading,
    #[command(flatten)]
    pub cl_reading: ClReading,
    #[command(flatten)]
    pub raw: RawRecords,
    #[command(flatten)]
    pub units: Units,
    #[command(flatten)]
    pub grants: Grants,
    /// The NC file; standard output when left out or -
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Write a program for each tool change, for a control without a tool changer: OUT_t1.nc and its CL
    /// file OUT_t1.ncl, OUT_t2.nc …
    #[arg(long, requires = "output", conflicts_with_all = ["listing", "profile", "shard"])]
    pub each_tool: bool,
    /// Write a listing: records, sections, and the blocks they made
    #[arg(long, value_name = "FILE")]
    pub listing: Option<PathBuf>,
    /// Write the line map for `filpost trace`; OUT.map when no FILE is given
    #[arg(long, value_name = "FILE")]
    pub map: Option<Option<PathBuf>>,
    /// Report the run time by CL word, section and FIL line; with a FILE also as a flame graph (SVG)
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true)]
    pub profile: Option<Option<PathBuf>>,
    /// List what scripts and INSERT changed, and judge the rest; with a FILE also as JSON
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true)]
    pub audit: Option<Option<PathBuf>>,
    /// A folder to look in for the option file that MACHIN names (may be given again)
    #[arg(long, value_name = "DIR")]
    pub post_path: Vec<PathBuf>,
    /// Write nothing when there are warnings, and exit with 1
    #[arg(long)]
    pub deny_warnings: bool,
    /// Post only every Nth CL file, starting with the Ith (2/4: the 2nd, 6th, 10th …)
    #[arg(long, value_name = "I/N", value_parser = test::shard)]
    pub shard: Option<Shard>,
}

/// What FIL scripts may reach outside of the post.
#[derive(Debug, Default, ClapArgs)]
pub struct Grants {
    /// Let FIL read, or write and delete, files of a folder (FILEF)
    #[arg(long, value_name = "read=DIR,write=DIR", value_delimiter = ',', value_parser = grant)]
    pub grant: Vec<Grant>,
    /// The moment DATEF and TIMEF give, as 2026-01-31T12:00:00
    #[arg(long, value_name = "MOMENT", value_parser = moment, conflicts_with = "clock")]
    pub set_clock: Option<Moment>,
    /// Let DATEF and TIMEF read the system clock; the program then differs from run to run
    #[arg(long, value_enum)]
    pub clock: Option<ClockSource>,
}

/// A folder granted to scripts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Grant {
    /// To read.
    Read(PathBuf),
    /// To write and delete.
    Write(PathBuf),
}

/// What `--clock` names.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ClockSource {
    /// The system's clock, in UTC
    System,
}

fn grant(text: &str) -> Result<Grant, String> {
    match text.split_once('=') {
        Some(("read", folder)) if !folder.is_empty() => Ok(Grant::Read(folder.into())),
        Some(("write", folder)) if !folder.is_empty() => Ok(Grant::Write(folder.into())),
        _ => Err("write read=DIR or write=DIR".to_string()),
    }
}

fn moment(text: &str) -> Result<Moment, String> {
    Moment::parse(text).ok_or_else(|| "write a moment as 2026-01-31T12:00:00".to_string())
}

/// `filpost check`
#[derive(Debug, ClapArgs)]
pub struct CheckArgs {
    /// FIL files, each checked by itself
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// The machine, for what depends on one
    #[command(flatten)]
    pub chosen: Chosen,
    /// Check all files as one post: they share one name space
    #[arg(long)]
    pub together: bool,
    /// Format of the findings
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    #[command(flatten)]
    pub reading: Reading,
    /// Exit with 1 when there are warnings
    #[arg(long)]
    pub deny_warnings: bool,
}

/// How `filpost check` writes its findings.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Format {
    /// For people, to standard error
    Text,
    /// One JSON array to standard output
    Json,
    /// A SARIF 2.1.0 log to standard output, for code hosts and editors
    Sarif,
}

/// `filpost fmt`
#[derive(Debug, ClapArgs)]
pub struct FmtArgs {
    /// FIL files, rewritten in place; - reads standard input and writes standard output
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Change nothing: list the files that would change, and exit with 1 if there are any
    #[arg(long)]
    pub check: bool,
    /// Encoding of the files (utf-8, cp1251, koi8-r, …), which they keep; guessed when left out
    #[arg(long, value_name = "LABEL")]
    pub encoding: Option<String>,
}

/// `filpost cl`
#[derive(Debug, ClapArgs)]
pub struct ClArgs {
    /// The CL file; - reads standard input
    #[arg(required_unless_present = "dialects")]
    pub cl: Option<PathBuf>,
    /// List the dialects of CL text instead: their names, how they are recognized, how they are read
    #[arg(long, conflicts_with_all = ["cl", "words", "dialect", "encoding", "units", "raw_records"])]
    pub dialects: bool,
    #[command(flatten)]
    pub cl_reading: ClReading,
    #[command(flatten)]
    pub raw: RawRecords,
    #[command(flatten)]
    pub units: Units,
    /// Write the file as a CL file of Creo, whatever system it is from
    #[arg(long, value_enum, value_name = "FORM", conflicts_with_all = ["dialects", "json", "words", "raw_records"])]
    pub to: Option<ClForm>,
    /// The file of --to; standard output when left out or -
    #[arg(short, long, value_name = "OUT", requires = "to")]
    pub output: Option<PathBuf>,
    /// Write JSON
    #[arg(long)]
    pub json: bool,
    /// Show each word with its number, as POSTF(7,n) counts them
    #[arg(long)]
    pub words: bool,
    /// Encoding of the texts (utf-8, cp1251, koi8-r, …); guessed when left out
    #[arg(long, value_name = "LABEL")]
    pub encoding: Option<String>,
}

/// The form that `filpost cl --to` writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ClForm {
    /// PTC Creo
    Ncl,
}

/// `filpost diff`
#[derive(Debug, ClapArgs)]
pub struct DiffArgs {
    /// The program that is known to be right; - reads standard input
    pub first: PathBuf,
    /// The program that is compared with it
    pub second: PathBuf,
    /// Largest difference of lengths and angles that is ignored
    #[arg(long, value_name = "STEP", default_value_t = 0.001, value_parser = tolerance)]
    pub tol: f64,
    /// What to ignore: n, comments, dates, points, spaces or letters of words
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = ignored)]
    pub ignore: Vec<String>,
    /// Report a modal word that only one of the programs repeats
    #[arg(long)]
    pub modal: bool,
    /// X is a diameter (needed to compare arcs of a lathe)
    #[arg(long)]
    pub diameter: bool,
    /// Encoding of both programs (windows-1252, cp850, shift_jis, …)
    #[arg(long, value_name = "LABEL", default_value = "utf-8", value_parser = code_page)]
    pub nc_encoding: CodePage,
    /// Equal lines shown around each difference
    #[arg(long, value_name = "LINES", default_value_t = 2)]
    pub context: usize,
    /// How differences are written
    #[arg(long, value_enum, default_value_t = Report::Text)]
    pub format: Report,
}

/// `filpost verify`
#[derive(Debug, ClapArgs)]
pub struct VerifyArgs {
    /// The CL file; - reads standard input
    pub cl: PathBuf,
    /// The NC program
    pub nc: PathBuf,
    #[command(flatten)]
    pub chosen: Chosen,
    /// A FIL file (may be given again); the program is then compared with a second run
    #[arg(short, long, value_name = "FILE")]
    pub fil: Vec<PathBuf>,
    #[command(flatten)]
    pub reading: Reading,
    #[command(flatten)]
    pub cl_reading: ClReading,
    #[command(flatten)]
    pub raw: RawRecords,
    #[command(flatten)]
    pub units: Units,
    #[command(flatten)]
    pub grants: Grants,
    /// A folder to look in for the option file that MACHIN names (may be given again)
    #[arg(long, value_name = "DIR")]
    pub post_path: Vec<PathBuf>,
    /// Allowed deviation, mm and degrees; by default the last digit of each address
    #[arg(long, value_name = "MM", value_parser = tolerance)]
    pub tol: Option<f64>,
    /// How far the tip may leave its line during a rotary move; by default LINTOL of the CL file
    #[arg(long, value_name = "MM", value_parser = tolerance)]
    pub between: Option<f64>,
    /// The line map of the run (`filpost post --map`): audit the program, scripts apart from the post
    #[arg(long, value_name = "FILE", conflicts_with_all = ["fil", "tol", "between", "allow_offset", "stock", "setup"])]
    pub map: Option<PathBuf>,
    /// Work offsets that the program may use if the CL file names none: G54,G54.1P3
    #[arg(long, value_name = "OFFSETS", value_delimiter = ',', value_parser = work_offset)]
    pub allow_offset: Vec<u32>,
    /// Stock to cut with the program, as `filpost simulate` does
    #[command(flatten)]
    pub material: MaterialArgs,
    /// Format of the findings
    #[arg(long, value_enum, default_value_t = Report::Text)]
    pub format: Report,
}

/// How a finding about NC programs is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Report {
    /// For people
    Text,
    /// JSON
    Json,
}

/// A work offset by its name, as the interpreter counts it.
fn work_offset(text: &str) -> Result<u32, String> {
    let known = filpost::nc::motion::work_offset(text.trim());
    known.ok_or_else(|| "G54, G54.1P3 or a letter with a number is needed".to_string())
}

fn code_page(label: &str) -> Result<CodePage, String> {
    let known = || CodePage::all().map(CodePage::name).collect::<Vec<_>>().join(", ");
    CodePage::named(label).ok_or_else(|| format!("the encodings of programs are {}", known()))
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "write a number".to_string())?;
    if value.is_finite() && value >= 0.0 { Ok(value) } else { Err("write 0 or more".to_string()) }
}

fn ignored(text: &str) -> Result<String, String> {
    let known = filpost::nc::diff::Ignore::default().add(text);
    known.map(|()| text.to_string()).map_err(|_| {
        "write n, comments, dates, points, spaces or a letter, with commas between".to_string()
    })
}

/// `filpost watch`
#[derive(Debug, ClapArgs)]
pub struct WatchArgs {
    /// The folder of the case, with its case.toml
    pub case: PathBuf,
    /// End after so many runs
    #[arg(long, value_name = "N", hide = true)]
    pub runs: Option<u32>,
}

/// `filpost explain`
#[derive(Debug, ClapArgs)]
pub struct ExplainArgs {
    /// E0501 | rapid.split | CYCLE | SQRTF | POSTF 13 | DBLCOM 486 | G83 | fanuc-mill | preload
    #[arg(required = true, value_parser = names::subject(), hide_possible_values = true)]
    pub subject: Vec<String>,
}
