//! CL to NC by filpost and by translators written for this one job.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use filpost::files::write_whole;
use filpost::map::Names;

use crate::inputs::Input;
use crate::race::{self, Lap, Racer, Results};
use crate::{Outcome, agree, handwritten};

/// The measure of all.
pub const BY_HAND: &str = "by hand, Rust";
/// The post without a section; the names of its other ways begin so too.
pub const FILPOST: &str = "filpost";
/// The same with a line map.
pub const MAPPED: &str = "filpost, line map";
/// The script that filpost is to be faster than.
pub const LUAJIT: &str = "by hand, LuaJIT";

const SECTION: &str = include_str!("../section.fil");

/// NC programs that are made from one CL file.
struct Programs<'a> {
    cl: &'a Path,
    by_hand: PathBuf,
    plain: PathBuf,
    section: PathBuf,
    mapped: PathBuf,
    luajit: PathBuf,
    python: PathBuf,
}

/// Lets all post a file, and compares what they wrote.
///
/// # Errors
/// A program fails, or two of them do not say the same.
pub fn post_all(input: &Input, folder: &Path) -> Outcome<Results> {
    let nc = |name: &str| folder.join(name);
    let programs = Programs {
        cl: &input.path,
        by_hand: nc("by_hand.ngc"),
        plain: nc("plain.ngc"),
        section: nc("section.ngc"),
        mapped: nc("mapped.ngc"),
        luajit: nc("luajit.ngc"),
        python: nc("python.ngc"),
    };
    let cl = programs.cl;
    let results = race::race(vec![
        Racer::new(BY_HAND, || race::timed(|| Ok(handwritten::translate(cl, &programs.by_hand)?))),
        Racer::new(FILPOST, || race::timed(|| post(None, cl, &programs.plain))),
        Racer::new("filpost, 20 operations a GOTO", || {
            race::timed(|| post(Some(SECTION), cl, &programs.section))
        }),
        Racer::new(MAPPED, || race::timed(|| post_mapped(cl, &programs.mapped))),
        Racer::new(LUAJIT, || script("luajit", "translate.lua", cl, &programs.luajit)),
        Racer::new("by hand, Python", || script("python3", "translate.py", cl, &programs.python)),
        Racer::new("rs274 reads the result", || rs274(&programs.plain, folder)),
    ])?;
    compare(&programs)?;
    Ok(results)
}

/// Posts a file with a FIL text or none.
pub fn post(fil: Option<&str>, cl: &Path, nc: &Path) -> Outcome<()> {
    let mut builder = builder();
    if let Some(fil) = fil {
        builder = builder.fil("bench.fil", fil);
    }
    let post = builder.build().map_err(|error| format!("{error:?}"))?;
    post.post_files(cl, nc).map_err(|error| format!("{error:?}"))?;
    Ok(())
}

/// Posts a file and writes the line map beside the program.
fn post_mapped(cl: &Path, nc: &Path) -> Outcome<()> {
    let post = builder().build().map_err(|error| format!("{error:?}"))?;
    let input = File::open(cl)?;
    let map = nc.with_extension("map");
    let written = write_whole(nc, |nc| {
        write_whole(&map, |map| post.start().run_mapped(input, nc, &Names::default(), map))
    });
    written.map_err(|error| format!("{error:?}"))?;
    Ok(())
}

fn builder() -> filpost::Builder {
    filpost::Program::builder().generic("linuxcnc-mill")
}

/// Runs one of the scripts beside this file.
fn script(program: &str, name: &str, cl: &Path, nc: &Path) -> Outcome<Lap> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/speed");
    race::command(Command::new(program).arg(folder.join(name)).arg(cl).arg(nc))
}

/// LinuxCNC's interpreter reads a program and lists its moves.
fn rs274(nc: &Path, folder: &Path) -> Outcome<Lap> {
    let Some(program) = filpost_tests::rs274::installed() else {
        return Ok(Lap::Skipped("no rs274 (.ci/install-rs274 unpacks it)".to_string()));
    };
    let tools = folder.join("tools.tbl");
    fs::write(&tools, "T1 P1 D0 Z0\nT2 P2 D0 Z0\n")?;
    let mut command = Command::new(program);
    command.current_dir(folder).env("HOME", folder).arg("-t").arg(tools);
    command.args(["-v", "fresh.var", "-n", "2", "-g"]).arg(nc).arg("/dev/null");
    race::command(&mut command)
}

/// The translators write the same bytes; filpost's programs cut the same.
fn compare(programs: &Programs<'_>) -> Outcome<()> {
    let expected = fs::read(&programs.by_hand)?;
    for other in [&programs.luajit, &programs.python] {
        if other.exists() && fs::read(other)? != expected {
            return Err(format!("{} differs from {}", other.display(), "by_hand.ngc").into());
        }
    }
    for way in [&programs.plain, &programs.section] {
        agree::same_cuts(&programs.by_hand, way)?;
    }
    if fs::read(&programs.mapped)? != fs::read(&programs.plain)? {
        return Err("the line map changes the program".into());
    }
    Ok(())
}
