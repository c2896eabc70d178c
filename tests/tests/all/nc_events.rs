//! Our interpreter of NC programs against LinuxCNC's: the same ends, arcs, rates,
//! holes and tools, block by block.

use std::fs;
use std::path::{Path, PathBuf};

use fil_nc::dialect::Dialect;
use fil_nc::interpret::events;
use fil_nc::motion::Event;
use filpost_tests::event_path::{differences, event_path};
use filpost_tests::motions::Head;
use filpost_tests::nc_path::nc_path;
use filpost_tests::rs274;
use rayon::prelude::*;

/// LinuxCNC prints four decimals of the active unit.
const TOLERANCE: f64 = 0.002;

fn files_in(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else {
        println!("skipped: {} is not there", folder.display());
        return Vec::new();
    };
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|file| file.to_string_lossy().contains(ending));
    files.sort();
    files
}

/// NC programs for LinuxCNC: those of its ready post from all CL files that it takes.
#[test]
fn ready_programs_are_read_as_linuxcnc_reads_them() {
    let Some(program) = rs274::program() else { return };
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let data =
        std::env::var_os("FILPOST_DATA").map_or(here.join("../../shared/data"), PathBuf::from);
    let mut files = files_in(&here.join("cl"), "");
    files.extend(files_in(&here.join("words"), ".ncl"));
    files.extend(files_in(&data.join("cl/creo"), ".ncl"));
    let steps_compared = |cl: &Path| {
        let post = filpost::Program::builder().generic("linuxcnc-mill").build().unwrap();
        let dialect = Dialect::new(post.commons()).unwrap();
        let mut nc = Vec::new();
        if post.stream(fs::File::open(cl).unwrap(), &mut nc).is_err() {
            return None;
        }
        let nc = String::from_utf8(nc).unwrap();
        // Where G28 leads is set on the machine, and a cycle behind it begins there.
        if nc.contains("G28") {
            return None;
        }
        let name = cl.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let ours = events(nc.as_bytes(), &name, &dialect);
        let calls = match rs274::run(&program, &nc) {
            Ok(calls) => calls,
            Err(said) => {
                println!(
                    "{name}: LinuxCNC refuses: {said}; ours: {:?}",
                    ours.err().map(|d| d.to_string())
                );
                return None;
            }
        };
        let theirs = match nc_path(&calls, &nc) {
            Ok(path) => path,
            Err(said) => {
                println!("{name}: {said}");
                return None;
            }
        };
        let ours = ours.unwrap_or_else(|diag| panic!("{name}: {diag}\n{nc}"));
        let ours = event_path(&ours, theirs.unit.unwrap());
        let list = differences(&ours, &theirs, TOLERANCE);
        assert!(
            list.is_empty(),
            "{name}: {}\n{}",
            list[..list.len().min(5)].join("\n"),
            if nc.len() < 3000 { nc.as_str() } else { "" }
        );
        Some(ours.steps.len())
    };
    let steps: Vec<usize> = files.par_iter().filter_map(|cl| steps_compared(cl)).collect();
    println!("{} programs, {} steps", steps.len(), steps.iter().sum::<usize>());
}

/// A program that goes from G99 to G98 within a cycle: LinuxCNC raises the tool before
/// the hole, Fanuc's controls after it.
const RAISED_BEFORE: &str = "drilling.nc";

/// Programs of `tests/motions/` that LinuxCNC takes too. G28 and G53 lead to places of
/// its own, and text before a tape mark hides the unit from it.
#[test]
fn programs_by_hand_are_read_as_linuxcnc_reads_them() {
    let Some(program) = rs274::program() else { return };
    let mut compared = 0;
    for file in files_in(&Path::new(env!("CARGO_MANIFEST_DIR")).join("motions"), ".nc") {
        let text = fs::read_to_string(&file).unwrap();
        let head = Head::read(&text).unwrap();
        let dialect = head.dialect().unwrap();
        let (_, rest) = text.split_once('\n').unwrap();
        let nc = format!("G21\n{rest}");
        let own_places = ["G28", "G53", "%"].iter().any(|word| nc.contains(word));
        let (Ok(ours), false) = (events(nc.as_bytes(), "out.nc", &dialect), own_places) else {
            continue;
        };
        let Ok(calls) = rs274::run(&program, &nc) else { continue };
        let Ok(theirs) = nc_path(&calls, &nc) else { continue };
        let unit = theirs.unit.unwrap();
        let list = differences(&event_path(&ours, unit), &theirs, TOLERANCE);
        if head.is_plain_mill() && !file.ends_with(RAISED_BEFORE) {
            assert!(list.is_empty(), "{}: {}", file.display(), list.join("\n"));
            compared += 1;
        }
    }
    println!("{compared} programs");
    assert!(compared >= 10);
}

/// A real program of a mill whose units are G70 and G71, packed and without a tape
/// mark.
#[test]
fn a_real_program_is_read() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let data =
        std::env::var_os("FILPOST_DATA").map_or(here.join("../../shared/data"), PathBuf::from);
    let file = data.join("nc/gpost-style-mill.tap");
    let Ok(nc) = fs::read(&file) else {
        println!("skipped: {} is not there", file.display());
        return;
    };
    let builder = filpost::Program::builder().generic("fanuc-mill");
    let post = builder.set("units.inch_code=70").set("units.metric_code=71").build().unwrap();
    let events = events(&nc, "real.nc", &Dialect::new(post.commons()).unwrap()).unwrap();
    let count = |wanted: fn(&Event) -> bool| events.iter().filter(|event| wanted(event)).count();
    let blocks = nc.split(|byte| *byte == b'\n');
    let moving = blocks.filter(|block| block.iter().any(|byte| b"XYZ".contains(byte))).count();
    assert_eq!(count(|event| matches!(event, Event::Move(_))), moving);
    let changes = nc.windows(2).filter(|pair| pair == b"M6").count();
    assert_eq!(count(|event| matches!(event, Event::ToolChange { .. })), changes);
    assert!(moving > 100 && changes > 1);
}

/// Programs of the corpus with functions whose motion is not followed, and what is
/// said of them.
const NOT_FOLLOWED: &[(&str, &str)] = &[
    ("feed-control-l400", "E0905 out.nc:2:5: R: an address with an index"),
    ("run-out-measure", "E0902 out.nc:9:5: `PO`"),
    ("run-out-search", "E0902 out.nc:9:5: `PO`"),
    ("one-surface", "E0904 out.nc:7:5: the machine has no G65"),
    ("klartext/texts", "E0904 out.nc:12:1: `CALL` is not followed"),
    ("side", "E0904 out.nc:8:5: the machine has no G68.2"),
    ("three-angles", "E0904 out.nc:8:5: the machine has no G68.2"),
    ("turned-only", "E0904 out.nc:8:5: the machine has no G68.2"),
];

/// The expected program of each case is read by the language of its machine.
#[test]
fn programs_of_the_corpus_have_a_meaning() {
    let cases = filpost::case::find(&filpost_tests::root().join("corpus")).unwrap();
    let mut failures = Vec::new();
    let mut count = 0;
    for case in cases {
        let Some(expect) = &case.file.expect else { continue };
        let nc = fs::read(case.folder.join(expect)).unwrap();
        let dialect = Dialect::new(case.program().unwrap().commons()).unwrap();
        let known = NOT_FOLLOWED.iter().find(|(name, _)| case.folder.ends_with(name));
        let known = known.map(|(_, said)| *said);
        let said = events(&nc, "out.nc", &dialect).err().map(|diag| diag.to_string());
        if said.as_deref() != known {
            failures.push(format!("{}: {said:?}", case.folder.display()));
        }
        count += 1;
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    println!("{count} programs");
}
