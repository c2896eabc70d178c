//! `filpost plot`

use std::io::{IsTerminal, Read, Write};
use std::path::{Path, PathBuf};

use filpost::cl::reader::Options;
use filpost::map::MapReader;
use filpost::nc::plot::{Drawing, Trace, View, svg, write_html};
use filpost::nc::source::Source;
use filpost::plot::{self, ClText, Text};
use filpost::{Error, files, select};

use crate::args::{PlotArgs, RawRecords, Seen};
use crate::output::{self, Target};
use crate::setup::{From, Named};
use crate::{Status, post, setup};

/// Most notes on lines that are not drawn.
const LEFT_OUT: usize = 8;

/// What is drawn, by the ending of the output file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Svg,
    Html,
}

/// Draws a CL file or an NC program.
///
/// # Errors
/// Files that can't be read or written, a program that has no sure meaning, a map
/// of another run.
pub fn run(args: &PlotArgs) -> Result<Status, Error> {
    let named = args
        .output
        .clone()
        .or_else(|| std::io::stdout().is_terminal().then(|| page_beside(&args.file)));
    let named = named.as_deref();
    let Some(form) = form(named) else {
        output::say("error: the name of the picture must end in .svg or .html");
        return Ok(Status::Usage);
    };
    let bytes = read(&args.file)?;
    let name = output::input_name(&args.file);
    let text = Text { name: &name, bytes: &bytes };
    let is_cl = plot::is_cl(&bytes);
    if is_cl && (args.cl.is_some() || args.map.is_some() || args.second.is_some()) {
        output::say(&format!(
            "error: {name} is a CL file; --cl, --second and --map go with an NC program"
        ));
        return Ok(Status::Usage);
    }
    let names = [Some(&args.file), args.cl.as_ref(), args.second.as_ref(), args.map.as_ref()];
    let mut inputs: Vec<PathBuf> = names.into_iter().flatten().cloned().collect();
    let (cl, second) = (beside(args.cl.as_deref())?, beside(args.second.as_deref())?);
    let [cl, second] =
        [&cl, &second].map(|beside| beside.as_ref().map(|(name, bytes)| Text { name, bytes }));
    let (drawing, machine) = if is_cl {
        (plot::cl_file(cl_text(args, text)?)?, None)
    } else {
        let (drawing, title) = program(args, text, (cl, second), &mut inputs)?;
        (drawing, Some(title))
    };
    let output = output::named(named);
    output::refuse_over([output], inputs.iter().map(PathBuf::as_path))?;
    let write = |out: &mut dyn Write| match form {
        Form::Svg => out.write_all(svg(&drawing, &views(&args.view)).as_bytes()),
        Form::Html => write_html(&drawing, out),
    };
    Target::new(named).write(|mut out| {
        let path = named.unwrap_or(Path::new(""));
        write(&mut out).map_err(|error| files::cant_write(path, &error))
    })?;
    tell_left_out(&name, &drawing.path);
    let motions = crate::summary::counted(drawing.path.pieces.len() as u64, "motion");
    let machine = machine.map_or(String::new(), |title| format!(" on {title}"));
    let into = match named {
        Some(path) if args.output.is_none() => format!(" to {}", path.display()),
        _ => String::new(),
    };
    output::say(&format!("{name}: {motions} drawn{machine}{into}"));
    Ok(Status::Done)
}

/// The page of a file, where no output is named.
fn page_beside(file: &Path) -> PathBuf {
    if file.as_os_str() == "-" {
        return PathBuf::from("plot.html");
    }
    let mut name = file.as_os_str().to_os_string();
    name.push(".html");
    PathBuf::from(name)
}

/// Notes which lines of a program are not drawn.
fn tell_left_out(name: &str, path: &Trace) {
    for left_out in path.left_out.iter().take(LEFT_OUT) {
        output::say(&format!("note: {name}:{}: {left_out}", left_out.line));
    }
    let more = path.left_out.iter().skip(LEFT_OUT).map(|left_out| u64::from(left_out.count));
    match more.sum() {
        0 => {}
        more => output::say(&format!(
            "note: {name}: {} left out too",
            crate::summary::counted(more, "more line")
        )),
    }
}

fn options(args: &PlotArgs) -> Result<Options, Error> {
    setup::cl_options(args.encoding.as_deref(), &args.cl_reading, RawRecords::default())
}

/// A CL file with how it is read.
fn cl_text<'t>(args: &PlotArgs, text: Text<'t>) -> Result<ClText<'t>, Error> {
    Ok(ClText { text, options: options(args)?, unit: args.units.units })
}

/// A program, with the CL file under it and the map's notes where they are given; and
/// what its machine is called. What is read besides is added to the inputs.
fn program<'t>(
    args: &PlotArgs,
    nc: Text<'t>,
    (cl, second): (Option<Text<'t>>, Option<Text<'t>>),
    inputs: &mut Vec<PathBuf>,
) -> Result<(Drawing<'t>, String), Error> {
    let named = machine(args, nc, args.cl.as_deref().zip(cl))?;
    inputs.extend(named.inputs);
    let (program, title) = (named.builder.build()?, named.title);
    let mut drawing = plot::program(nc, program.commons())?;
    if let Some(cl) = cl {
        plot::lay_under(&mut drawing, cl_text(args, cl)?, program.commons())?;
    }
    if let Some(second) = second {
        plot::lay_program_under(&mut drawing, second, program.commons())?;
        tell_left_out(second.name, drawing.under.as_ref().unwrap_or(&drawing.path));
    }
    if let Some(path) = &args.map {
        origins(&mut drawing, nc, path, inputs)?;
    } else if post::beside(&args.file).is_file()
        && let Err(error) = origins(&mut drawing, nc, &post::beside(&args.file), inputs)
    {
        output::say(&format!("note: the map beside the program is not used: {error}"));
    }
    Ok((drawing, title))
}

fn origins(
    drawing: &mut Drawing<'_>,
    nc: Text<'_>,
    path: &Path,
    inputs: &mut Vec<PathBuf>,
) -> Result<(), Error> {
    let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
    let map = MapReader::open(path)?;
    plot::add_origins(drawing, nc, map, &mut |name| {
        inputs.push(folder.join(name));
        std::fs::read(folder.join(name)).ok()
    })
}

/// The machine of the command line, else the one that the CL file asks for, else the
/// generic mill of the program's family.
fn machine(args: &PlotArgs, nc: Text<'_>, cl: Option<(&Path, Text<'_>)>) -> Result<Named, Error> {
    let source = Source::memory(nc.bytes);
    let encoding = args.encoding.as_deref();
    match cl {
        Some((path, Text { name, bytes })) => {
            let folders = select::beside_first(path, &[]);
            let options = options(args)?;
            let from = setup::from(&args.chosen, &folders, || select::asked(bytes, name, options))?
                .or_text_of(&args.chosen, &source, nc.name)?;
            setup::confirm(&from, || select::machines(bytes, name, options), name)?;
            setup::machine(&args.chosen, encoding, &from)
        }
        None => {
            let from = From::CommandLine.or_text_of(&args.chosen, &source, nc.name)?;
            setup::machine(&args.chosen, encoding, &from)
        }
    }
}

fn form(output: Option<&Path>) -> Option<Form> {
    let Some(path) = output.filter(|path| path.as_os_str() != "-") else { return Some(Form::Svg) };
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "svg" => Some(Form::Svg),
        "html" | "htm" => Some(Form::Html),
        _ => None,
    }
}

fn views(seen: &[Seen]) -> Vec<View> {
    let view = |seen: &Seen| match seen {
        Seen::Xy => View::Xy,
        Seen::Zx => View::Zx,
        Seen::Zy => View::Zy,
        Seen::Iso => View::Isometric,
    };
    if seen.is_empty() { View::ALL.to_vec() } else { seen.iter().map(view).collect() }
}

/// The name and the bytes of a file that is drawn beside the program.
fn beside(path: Option<&Path>) -> Result<Option<(String, Vec<u8>)>, Error> {
    path.map(|path| Ok((output::input_name(path), read(path)?))).transpose()
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    output::open(path)?.read_to_end(&mut bytes).map_err(|error| files::cant_read(path, &error))?;
    Ok(bytes)
}
