//! `filpost simulate`, and the simulation of `filpost verify --stock`.

mod case;
mod material;
mod text;

use std::io::Read;
use std::path::{Path, PathBuf};

use filpost::map::MapReader;
use filpost::nc::plot::Notes;
use filpost::nc::source::Source;
use filpost::plot::{self, ClText, Text};
use filpost::simulate::{ClTools, as_json, cl_tools};
use filpost::stock::{Job, Simulated};
use filpost::{Commons, Diag, Error, Levels, Program, files, select, simulate, stock};

use crate::args::{RawRecords, Report, SimulateArgs};
use crate::output::{self, Target};
use crate::setup::{From, Named};
use crate::{Status, post, setup};

pub use material::{Material, Places};
pub use text::write_report;

/// Simulates an NC program.
///
/// # Errors
/// Files that can't be read or written, a program that has no sure meaning or can't be simulated.
pub fn run(args: &SimulateArgs) -> Result<Status, Error> {
    if args.nc.join("case.toml").is_file() {
        return case::run(args);
    }
    let bytes = read(&args.nc)?;
    let name = output::input_name(&args.nc);
    let nc = Text { name: &name, bytes: &bytes };
    let cl = args.cl.as_ref().map(|path| Ok::<_, Error>((path, read(path)?))).transpose()?;
    let named = machine(args, nc, cl.as_ref().map(|(path, bytes)| (path.as_path(), &bytes[..])))?;
    let (program, title, post) = (named.builder.build()?, named.title, named.inputs);
    let files = args.cl.iter().chain([&args.nc]).map(PathBuf::as_path).collect();
    let places = Places { files, post: &post, root: Path::new("") };
    let Some(material) = Material::read(&args.material, program.commons(), &places)? else {
        return Ok(without_stock());
    };
    let mut inputs = post.clone();
    inputs.extend([&args.nc].into_iter().chain(&args.cl).chain(&args.map).cloned());
    refuse_over(args, &material, inputs)?;
    let found = cl.as_ref().map(|(path, bytes)| {
        let name = output::input_name(path);
        let options =
            setup::cl_options(args.encoding.as_deref(), &args.cl_reading, RawRecords::default())?;
        let text = Text { name: &name, bytes };
        cl_tools(&ClText { text, options, unit: args.units.units }, program.commons())
    });
    let found = found.transpose()?.unwrap_or_default();
    let mut done = cut(&material, &found, nc, program.commons(), &args.levels.levels)?;
    name_sources(&mut done.report, nc, &args.nc, args.map.as_deref())?;
    tell(args, nc, &program, &title, &done)
}

/// Refuses to write the stock over an input.
fn refuse_over(
    args: &SimulateArgs,
    material: &Material,
    mut inputs: Vec<PathBuf>,
) -> Result<(), Error> {
    inputs.extend(material.inputs.iter().cloned());
    output::refuse_over(
        [output::named(args.write_stock.as_deref())],
        inputs.iter().map(PathBuf::as_path),
    )
}

/// Writes the stock that is left, and prints the report.
fn tell(
    args: &SimulateArgs,
    nc: Text<'_>,
    program: &Program,
    title: &str,
    done: &Simulated,
) -> Result<Status, Error> {
    if let Some(path) = &args.write_stock {
        let stl = done.left.stl();
        Target::new(Some(path))
            .write(|out| out.write_all(&stl).map_err(|error| files::cant_write(path, &error)))?;
    }
    output::say(&format!("machine: {title}"));
    match args.format {
        Report::Json => output::print(format!("{:#}\n", as_json(&done.report)).as_bytes())?,
        Report::Text => write_report(nc, program.nc_page(), &done.report)?,
    }
    Ok(if done.report.fails { Status::Failed } else { Status::Done })
}

/// Asks for the stock.
pub fn without_stock() -> Status {
    output::say(
        "error: no stock is given: use --stock box:100x80x30 (top at Z0), or write \
         stock = \"box 100x80x30\" into stock.toml next to the part, or below [simulate] into \
         case.toml or machine.toml",
    );
    Status::Usage
}

/// Cuts the stock. Levels of the command line win over those of the machine, and tools of the
/// command line and of the setup over those of the CL file.
///
/// # Errors
/// What can't be simulated.
pub fn cut(
    material: &Material,
    found: &ClTools,
    nc: Text<'_>,
    commons: &Commons,
    levels: &Levels,
) -> Result<Simulated, Error> {
    let mut tools = found.tools.clone();
    tools.extend(material.tools.clone());
    let mut all_levels = commons.levels().clone();
    all_levels.lay_over(levels);
    let job = Job {
        stock: &material.stock,
        tools: &tools,
        part: material.part.as_ref(),
        part_tolerance: material.part_tolerance,
        grid: material.grid,
        offsets: &material.offsets,
        levels: &all_levels,
    };
    simulate::program(nc, commons, &job).map_err(|error| with_reasons(error, found))
}

/// Adds why tools of the CL file have no size.
fn with_reasons(error: Error, found: &ClTools) -> Error {
    match error {
        Error::Run(diag) if diag.code.number == 961 => {
            let reasons = found
                .unknown
                .iter()
                .map(|(tool, why)| format!("tool {tool} of the CL file is not taken: {why}"));
            Error::Run(Box::new(reasons.fold(*diag, Diag::note)))
        }
        other => other,
    }
}

/// Names what made the lines of findings, as far as a line map of the program is given or beside it.
///
/// # Errors
/// A given map that can't be read, or that is of another run.
pub fn name_sources(
    report: &mut stock::Report,
    nc: Text<'_>,
    path: &Path,
    map: Option<&Path>,
) -> Result<(), Error> {
    let notes = origins(nc, path, map)?;
    report.name_sources(&|line| simulate::source(&notes, line));
    Ok(())
}

/// What made the lines of a program, from its line map: the given one, or the one beside it.
fn origins(nc: Text<'_>, path: &Path, map: Option<&Path>) -> Result<Notes<'static>, Error> {
    let mut notes = Notes::default();
    let beside = post::beside(path);
    let is_beside = map.is_none() && beside.is_file();
    let Some(map) = map.or(is_beside.then_some(beside.as_path())) else { return Ok(notes) };
    let folder = map.parent().map(Path::to_path_buf).unwrap_or_default();
    let taken = MapReader::open(map).and_then(|map| {
        plot::note_origins(&mut notes, nc, map, &mut |name| std::fs::read(folder.join(name)).ok())
    });
    match taken {
        Err(error) if is_beside => {
            output::say(&format!("note: the map beside the program is not used: {error}"));
            Ok(Notes::default())
        }
        taken => taken.map(|()| notes),
    }
}

/// The machine of the command line, else the one that the CL file asks for, else the generic mill
/// of the program's family.
fn machine(args: &SimulateArgs, nc: Text<'_>, cl: Option<(&Path, &[u8])>) -> Result<Named, Error> {
    let source = Source::memory(nc.bytes);
    let encoding = args.encoding.as_deref();
    let from = match cl {
        Some((path, bytes)) => {
            let folders = select::beside_first(path, &[]);
            let options = setup::cl_options(encoding, &args.cl_reading, RawRecords::default())?;
            let name = output::input_name(path);
            let from =
                setup::from(&args.chosen, &folders, || select::asked(bytes, &name, options))?;
            let from = from.or_text_of(&args.chosen, &source, nc.name)?;
            setup::confirm(&from, || select::machines(bytes, &name, options), &name)?;
            from
        }
        None => From::CommandLine.or_text_of(&args.chosen, &source, nc.name)?,
    };
    setup::machine(&args.chosen, encoding, &from)
}

/// A whole file, or standard input.
///
/// # Errors
/// E0701
pub fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    output::open(path)?.read_to_end(&mut bytes).map_err(|error| files::cant_read(path, &error))?;
    Ok(bytes)
}
