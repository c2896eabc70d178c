//! CL files in Creo's form (our own, and real ones where they are at hand) through the ready LinuxCNC post, judged by LinuxCNC's own
//! interpreter: what it does must be what the CL file asks for.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::{env, io};

use filpost_tests::cl_path::cl_path;
use filpost_tests::compare::compare;
use filpost_tests::nc_path::nc_path;
use filpost_tests::path::{Action, ToolPath};
use filpost_tests::rs274::{self, Call, Canon};
use rayon::prelude::*;

/// The files of `tests/cl` and the real ones; where these are absent, the reason is printed.
fn cl_files() -> Vec<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let data = env::var_os("FILPOST_DATA").map_or(here.join("../../shared/data"), PathBuf::from);
    let mut files = files_in(&here.join("cl")).unwrap();
    files.extend(mills_taken_by("linuxcnc-mill"));
    let real = data.join("cl/creo");
    match files_in(&real) {
        Ok(more) => files.extend(more),
        Err(error) => println!("skipped: {}: {error}", real.display()),
    }
    files
}

/// The CL files of `corpus/mills` that a ready mill has a program for.
fn mills_taken_by(ready: &str) -> Vec<PathBuf> {
    let mills = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus/mills");
    let of_post = files_in(&mills.join(ready)).unwrap();
    // The path of a CL file with cutter compensation is not known to the judge.
    let taken = of_post
        .iter()
        .filter(|case| case.join("expected.nc").exists() && !case.ends_with("radius"));
    taken
        .map(|case| mills.join("cl").join(case.file_name().unwrap()).with_extension("ncl"))
        .collect()
}

fn files_in(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?;
    let mut files: Vec<PathBuf> =
        entries.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>()?;
    files.sort();
    Ok(files)
}

/// The NC program a ready post makes of a CL file.
fn post_with(ready: &str, cl: &Path) -> Vec<u8> {
    try_post(ready, cl).unwrap_or_else(|error| panic!("{}: {error}", cl.display()))
}

fn try_post(ready: &str, cl: &Path) -> Result<Vec<u8>, filpost::Error> {
    let post = filpost::Program::builder().generic(ready).build().unwrap();
    let mut nc = Vec::new();
    let input = io::BufReader::new(File::open(cl).unwrap());
    post.stream(input, &mut nc)?;
    Ok(nc)
}

fn expected(cl: &Path) -> ToolPath {
    cl_path(File::open(cl).unwrap(), &cl.to_string_lossy()).unwrap()
}

fn count(path: &ToolPath, wanted: fn(&Action) -> bool) -> usize {
    path.steps.iter().filter(|step| wanted(&step.action)).count()
}

#[test]
fn cl_files_become_the_same_path() {
    let Some(program) = rs274::program() else { return };
    cl_files().par_iter().for_each(|cl| {
        let nc = String::from_utf8(post_with("linuxcnc-mill", cl)).unwrap();
        let name = cl.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let calls = rs274::run(&program, &nc).unwrap_or_else(|said| panic!("{name}: {said}"));
        let (wanted, found) = (expected(cl), nc_path(&calls, &nc).unwrap());
        let differences = compare(&wanted, &found);
        let list: String = differences.iter().map(|one| format!("\n  {one}")).collect();
        assert!(differences.is_empty(), "{name}:{list}\n{nc}");
        println!(
            "{name}: {} motions, {} arcs, {} holes, {} tools agree",
            count(&wanted, |action| matches!(action, Action::Rapid(_) | Action::Feed(..))),
            count(&wanted, |action| matches!(action, Action::Arc(..))),
            count(&wanted, |action| matches!(action, Action::Hole(..))),
            count(&wanted, |action| matches!(action, Action::Tool(_))),
        );
    });
}

/// Words that the interpreter has not, or reads otherwise: work offsets and taps of other
/// controls, dwells in milliseconds, and G86, which needs a dwell there.
const NOT_ITS: [&str; 6] = ["G154", "G54.1", "G84.2", "G4 ", "G82 ", "G86 "];

/// Words of other controls, and what the interpreter has for them.
const SAID_OTHERWISE: [(&str, &str); 2] = [("G70 ", "G20 "), ("G71 ", "G21 ")];

/// The programs of the ready mills, as far as the interpreter can read them.
#[test]
fn programs_of_the_ready_mills_make_the_path_of_their_cl_file() {
    let Some(program) = rs274::program() else { return };
    let posts = ["fanuc-mill", "haas-mill", "mazak-mill", "mitsubishi-mill", "brother-mill"];
    let posts = posts.into_iter().chain(["mach3-mill", "mach4-mill"]).map(|ready| (ready, ready));
    let alike = [
        ("syntec-mill", "fanuc-mill"),
        ("centroid-mill", "fanuc-mill"),
        ("hurco-mill", "fanuc-mill"),
        ("masso-mill", "mach3-mill"),
        ("uccnc-mill", "mach3-mill"),
        ("fluidnc", "mach3-mill"),
        ("tormach-mill", "mach3-mill"),
    ];
    let programs: Vec<_> = posts
        .chain(alike)
        .flat_map(|(ready, like)| mills_taken_by(like).into_iter().map(move |cl| (ready, like, cl)))
        // Offsets beyond the sixth are another matter of each control.
        .filter(|(ready, like, cl)| ready == like || !cl.ends_with("further.ncl"))
        .map(|(ready, _, cl)| (ready, cl))
        .collect();
    // What only the post that it is like can do is refused.
    let is_own = |ready: &str| !alike.iter().any(|(other, _)| *other == ready);
    let is_judged = |ready: &str, cl: &Path| {
        let nc = match try_post(ready, cl) {
            Err(_) if !is_own(ready) => return false,
            made => made.unwrap_or_else(|error| panic!("{ready} {}: {error}", cl.display())),
        };
        let nc = String::from_utf8(nc).unwrap();
        let nc = SAID_OTHERWISE.iter().fold(nc, |nc, (theirs, its)| nc.replace(theirs, its));
        if NOT_ITS.iter().any(|word| nc.contains(word)) {
            return false;
        }
        let calls = rs274::run(&program, &nc);
        let calls = calls.unwrap_or_else(|said| panic!("{ready} {}: {said}", cl.display()));
        let differences = compare(&expected(cl), &nc_path(&calls, &nc).unwrap());
        let list: String = differences.iter().map(|one| format!("\n  {one}")).collect();
        assert!(differences.is_empty(), "{ready} {}:{list}\n{nc}", cl.display());
        true
    };
    let judged: Vec<&str> = programs
        .par_iter()
        .filter(|(ready, cl)| is_judged(ready, cl))
        .map(|(ready, _)| *ready)
        .collect();
    for (ready, _) in &programs {
        let count = judged.iter().filter(|judged| *judged == ready).count();
        assert!(count > 2, "{ready}: only {count} programs");
    }
    println!("{} programs agree", judged.len());
}

/// Each arc turned round in a program of the post must be noticed.
#[test]
fn each_turned_arc_is_noticed() {
    let Some(program) = rs274::program() else { return };
    for cl in cl_files() {
        let nc = String::from_utf8(post_with("linuxcnc-mill", &cl)).unwrap();
        let wanted = expected(&cl);
        for (own, other) in [("G2 ", "G3 "), ("G3 ", "G2 ")] {
            let arcs: Vec<usize> = nc.match_indices(own).map(|(at, _)| at).collect();
            arcs.par_iter().for_each(|at| {
                let mut changed = nc.clone();
                changed.replace_range(*at..at + own.len(), other);
                let found = rs274::run(&program, &changed).and_then(|calls| nc_path(&calls, &nc));
                let noticed = found.map_or(true, |path| !compare(&wanted, &path).is_empty());
                assert!(noticed, "{}: arc at byte {at}", cl.display());
            });
        }
    }
}

const HELIX_AND_LINES: &str = "UNITS / MM
LOADTL / 1
SPINDL / RPM, 1000, CLW
RAPID
GOTO / 0, 0, 5
FEDRAT / 150, MMPM
GOTO / 0, 0, -1
GOTO / 10, 0, -2
CIRCLE / 10, 10, -2, 0, 0, 1, 10
GOTO / 20, 10, -4
GOTO / 20, 20, -4
CIRCLE / 20, 20, 6, 1, 0, 0, 10
GOTO / 20, 30, 6
FINI
";

/// The motions of a program, and the feed of each that has one.
fn motions_and_feeds(calls: &[Call]) -> (Vec<&Canon>, Vec<f64>) {
    let (mut motions, mut feeds, mut feed) = (Vec::new(), Vec::new(), 0.0);
    for call in calls {
        match &call.canon {
            Canon::FeedRate(rate) => feed = *rate,
            Canon::Traverse(_) => motions.push(&call.canon),
            Canon::Feed(_) | Canon::Arc { .. } => {
                motions.push(&call.canon);
                feeds.push(feed);
            }
            _ => {}
        }
    }
    (motions, feeds)
}

/// In inverse time the control makes the same motions at the feed of the CL file.
#[test]
fn inverse_time_is_the_feed_of_the_cl_file() {
    let Some(program) = rs274::program() else { return };
    let post = filpost::Program::builder().generic("linuxcnc-mill").build().unwrap();
    let run = |cl: &str| {
        let mut nc = Vec::new();
        post.stream(cl.as_bytes(), &mut nc).unwrap();
        let nc = String::from_utf8(nc).unwrap();
        (rs274::run(&program, &nc).unwrap_or_else(|said| panic!("{said}\n{nc}")), nc)
    };
    let (a_minute, _) = run(HELIX_AND_LINES);
    let inverse = HELIX_AND_LINES.replace("150, MMPM", "150, MMPM, INVERS, AUTO");
    let (inverse, nc) = run(&inverse);
    let (motions, feeds) = motions_and_feeds(&inverse);
    assert!(nc.contains("G93"), "{nc}");
    assert_eq!(motions, motions_and_feeds(&a_minute).0);
    assert!(feeds.len() > 4 && feeds.iter().all(|feed| (feed - 150.0).abs() < 1.5), "{feeds:?}");
}
