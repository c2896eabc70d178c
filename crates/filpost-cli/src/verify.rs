//! `filpost verify`

use std::io::{Seek, Write};
use std::path::{Path, PathBuf};

use filpost::cl::reader::Options;
use filpost::map::{Digest, MapReader};
use filpost::nc::decimals;
use filpost::nc::source::Source;
use filpost::nc::verify::{Allowed, Between, Finding, Report, Verdict};
use filpost::plot::{ClText, Text};
use filpost::verify::{Reference, as_json};
use filpost::{Error, Program, files, select, stock};

use crate::args::{self, VerifyArgs};
use crate::simulate::{self, Material, Places};
use crate::summary::counted;
use crate::{Status, audit, output, setup};

/// Checks an NC program against its CL file.
///
/// # Errors
/// Files that can't be read, a program or a CL file that makes no sense.
pub fn run(args: &VerifyArgs) -> Result<Status, Error> {
    let is_cut = args.material.is_asked();
    if is_cut && [&args.cl, &args.nc].iter().any(|path| path.as_os_str() == "-") {
        output::say("error: with --stock the CL file and the program are files");
        return Ok(Status::Usage);
    }
    let mut cl = output::open(&args.cl)?;
    let nc = Source::file(output::open(&args.nc)?);
    let name = output::input_name(&args.nc);
    let (mut program, title, post) = program(args, &mut cl, (&nc, &name), None)?;
    let places = Places { files: vec![&args.cl, &args.nc], post: &post, root: Path::new("") };
    let material = match is_cut {
        true => Material::read(&args.material, program.commons(), &places)?,
        false => None,
    };
    if is_cut && material.is_none() {
        return Ok(simulate::without_stock());
    }
    if let Some(map) = &args.map {
        return audited(args, &program, cl, (nc, &name), map);
    }
    let (mut report, reference) = compare(args, &program, cl, &nc)?;
    if let Some((plain, found)) = as_plain(args, &program, &report)? {
        output::say(
            "note: without the retracts of style=production; compared with --option style=plain",
        );
        (program, report) = (plain, found);
    }
    let page = program.nc_page();
    let cut = material.map(|material| stock(args, &program, &material)).transpose()?;
    output::say(&format!("machine: {title}"));
    match args.format {
        args::Report::Json => {
            let mut found = as_json(&report, reference);
            if let Some((_, cut)) = &cut {
                found["stock"] = filpost::simulate::as_json(cut);
            }
            output::print(format!("{found:#}\n").as_bytes())?;
        }
        args::Report::Text => {
            let mut wanted: Vec<u32> =
                report.findings.iter().filter_map(|finding| finding.nc_line).collect();
            wanted.sort_unstable();
            let lines = nc.in_page(page).lines(&name, &wanted).map_err(Error::Run)?;
            output::print_with(|out| {
                for finding in &report.findings {
                    write_finding(out, finding, &lines)?;
                }
                if report.more > 0 {
                    writeln!(out, "and {} more", counted(report.more, "finding"))?;
                }
                for open in &report.unverified {
                    let place =
                        open.cl_line.map_or(String::new(), |line| format!("CL line {line}: "));
                    writeln!(out, "not compared: {place}{}", open.what)?;
                }
                if report.more_unverified > 0 {
                    let more = counted(report.more_unverified, "statement");
                    writeln!(out, "and {more} more not compared")?;
                }
                writeln!(out, "{}", conclusion(args, &report, reference))
            })?;
            if let Some((bytes, cut)) = &cut {
                simulate::write_report(Text { name: &name, bytes }, page, cut)?;
            }
        }
    }
    let is_right = report.verdict() == Verdict::Agrees;
    let cuts_right = cut.is_none_or(|(_, cut)| !cut.fails);
    Ok(if is_right && cuts_right { Status::Done } else { Status::Failed })
}

/// What is different between the program and the CL file.
fn compare(
    args: &VerifyArgs,
    program: &Program,
    cl: std::fs::File,
    nc: &Source<'_>,
) -> Result<(Report, Reference), Error> {
    let offsets = args.allow_offset.clone();
    let allowed =
        Allowed { tolerance: args.tol, between: args.between, offsets, ..Allowed::default() };
    let mut run = program.start().cl_name(&output::input_name(&args.cl)).cl_options(options(args)?);
    if let Some(unit) = args.units.units {
        run = run.units(unit);
    }
    run.verify_source(cl, (nc, &output::input_name(&args.nc)), allowed)
}

/// The same of a program without the retracts and restated modes of the post's production style: it
/// was made by another post, or by this one with `style=plain`, which then differs less. A style that
/// somebody gives, with the command or in the machine.toml, is the one that is compared.
fn as_plain(
    args: &VerifyArgs,
    program: &Program,
    report: &Report,
) -> Result<Option<(Program, Report)>, Error> {
    let is_given =
        program.options().iter().any(|option| option.name == STYLE[0] && option.is_given);
    let is_stream = [&args.cl, &args.nc].iter().any(|path| path.as_os_str() == "-");
    if report.verdict() != Verdict::Differs || is_given || is_stream {
        return Ok(None);
    }
    let mut cl = output::open(&args.cl)?;
    let nc = Source::file(output::open(&args.nc)?);
    // A post without this option has one style.
    let named = (&nc, &*output::input_name(&args.nc));
    let Ok((plain, ..)) = self::program(args, &mut cl, named, Some(STYLE)) else { return Ok(None) };
    let found = compare(args, &plain, cl, &nc)?.0;
    let count = |report: &Report| report.findings.len() as u64 + report.more;
    Ok((count(&found) < count(report)).then_some((plain, found)))
}

/// The option with which a ready post writes only the blocks of the CL file.
const STYLE: [&str; 2] = ["style", "plain"];

/// The program cut into stock: its text, and what was found.
fn stock(
    args: &VerifyArgs,
    program: &Program,
    material: &Material,
) -> Result<(Vec<u8>, stock::Report), Error> {
    let (cl, bytes) = (simulate::read(&args.cl)?, simulate::read(&args.nc)?);
    let (cl_name, name) = (output::input_name(&args.cl), output::input_name(&args.nc));
    let text = Text { name: &cl_name, bytes: &cl };
    let cl = ClText { text, options: options(args)?, unit: args.units.units };
    let tools = filpost::simulate::cl_tools(&cl, program.commons())?;
    let nc = Text { name: &name, bytes: &bytes };
    let levels = &args.reading.levels.levels;
    let mut report = simulate::cut(material, &tools, nc, program.commons(), levels)?.report;
    simulate::name_sources(&mut report, nc, &args.nc, None)?;
    Ok((bytes, report))
}

/// Audits the program with the line map of its run.
fn audited(
    args: &VerifyArgs,
    program: &Program,
    cl: std::fs::File,
    (nc, nc_name): (Source<'_>, &str),
    map: &std::path::Path,
) -> Result<Status, Error> {
    let cant = |error: std::io::Error| files::cant_read(&args.nc, &error);
    let digest = Digest::of_reader(output::open(&args.nc)?).map_err(cant)?;
    MapReader::open(map)?.nc().check(nc_name, &digest)?;
    let name = output::input_name(&args.cl);
    let run = audit::run_of(program, &name, options(args)?, args.units.units);
    let found = run.audit(cl, (&nc, nc_name), &mut output::open(map)?)?;
    match args.format {
        args::Report::Json => {
            let json = filpost::audit::as_json(&found);
            output::print(format!("{json:#}\n").as_bytes())?;
        }
        args::Report::Text => {
            let text = nc.in_page(program.nc_page());
            let lines = audit::lines(&found, (&name, nc_name), &text)?;
            output::print(format!("{}\n", lines.join("\n")).as_bytes())?;
        }
    }
    let denies = args.reading.levels.denies_audit;
    Ok(if audit::deny(&found, denies).is_ok() { Status::Done } else { Status::Failed })
}

fn options(args: &VerifyArgs) -> Result<Options, Error> {
    setup::cl_options(args.reading.encoding.as_deref(), &args.cl_reading, args.raw)
}

/// The post that the program should come from, and what it is called.
fn program(
    args: &VerifyArgs,
    cl: &mut std::fs::File,
    (nc, nc_name): (&Source<'_>, &str),
    option: Option<[&str; 2]>,
) -> Result<(Program, String, Vec<PathBuf>), Error> {
    let folders = select::beside_first(&args.cl, &args.post_path);
    let name = output::input_name(&args.cl);
    let options = options(args)?;
    let from = setup::from(&args.chosen, &folders, || select::asked(&mut *cl, &name, options))?
        .or_text_of(&args.chosen, nc, nc_name)?;
    let named = setup::for_run(&args.chosen, &args.fil, &args.reading, &from)?;
    let cant_rewind = |error| files::cant_read(&args.cl, &error);
    cl.rewind().map_err(cant_rewind)?;
    setup::confirm(&from, || select::machines(&mut *cl, &name, options), &name)?;
    cl.rewind().map_err(cant_rewind)?;
    if let Some(note) = &named.note {
        output::say(&format!("note: {note}"));
    }
    let builder = setup::granted(named.builder, &args.grants);
    let builder =
        option.into_iter().fold(builder, |builder, [name, value]| builder.option(name, value));
    Ok((builder.build()?, named.title, named.inputs))
}

/// The finding, and the block it is about.
fn write_finding(
    out: &mut dyn Write,
    finding: &Finding,
    lines: &[(u32, String)],
) -> std::io::Result<()> {
    writeln!(out, "{finding}")?;
    let block = lines.iter().find(|(line, _)| Some(*line) == finding.nc_line);
    match block {
        Some((_, block)) => writeln!(out, "    {block}"),
        None => Ok(()),
    }
}

/// The last line: how it ends, and how far the paths are apart.
fn conclusion(args: &VerifyArgs, report: &Report, reference: Reference) -> String {
    let (nc, cl) = (output::input_name(&args.nc), output::input_name(&args.cl));
    let what = match (report.verdict(), reference) {
        (Verdict::Agrees, Reference::ClFile) => format!("{nc} agrees with {cl}"),
        (Verdict::Agrees, Reference::SecondRun) => {
            format!("{nc} does what a second run of the post makes of {cl}")
        }
        (Verdict::Partly, Reference::SecondRun) if report.compared == 0 => {
            return format!(
                "{nc} reads as a second run of the post does, and its path is not known"
            );
        }
        (Verdict::Partly, Reference::ClFile) if report.compared == 0 => {
            return format!("nothing of {nc} could be compared with {cl}");
        }
        (Verdict::Partly, _) => format!("{nc} agrees with {cl} as far as it was compared"),
        (Verdict::Differs, Reference::ClFile) => {
            let findings = report.findings.len() as u64 + report.more;
            format!("{nc} does not agree with {cl}: {}", counted(findings, "finding"))
        }
        (Verdict::Differs, Reference::SecondRun) => {
            let findings = report.findings.len() as u64 + report.more;
            let findings = counted(findings, "finding");
            format!("{nc} does not do what a second run of the post makes of {cl}: {findings}")
        }
    };
    let between = report.between.as_ref().map_or(String::new(), spell_between);
    format!(
        "{what}; {} of {} made, tool tip off by at most {} mm ({} RMS), tool axis by at most {} degrees{between}",
        report.matched,
        counted(report.compared, "motion"),
        length(report.position.max),
        length(report.position.rms()),
        length(report.axis.max),
    )
}

/// How far the path is off on the way of motions that turn the machine.
fn spell_between(between: &Between) -> String {
    let Between { position, axis } = between;
    format!(
        "; while the machine turns, the tip leaves its line by at most {} mm (NC line {}), the tool its plane by at most {} degrees (NC line {})",
        length(position.max),
        position.nc_line,
        decimals::short(axis.max, 3),
        axis.nc_line,
    )
}

/// Four decimals: the last digits of most addresses are three.
fn length(value: f64) -> String {
    decimals::short(value, 4)
}
