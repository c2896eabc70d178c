//! Our interpreter of NC programs against LinuxCNC's: the same ends, arcs, rates,
//! holes and tools, block by block.

use std::fs;
use std::path::{Path, PathBuf};

use fil_nc::dialect::Dialect;
use fil_nc::interpret::events;
use filpost_tests::event_path::{differences, event_path};
use filpost_tests::nc_path::nc_path;
use filpost_tests::rs274;

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
    let data = std::env::var_os("FILPOST_DATA").map_or(here.join("../../shared/data"), PathBuf::from);
    let mut files = files_in(&here.join("cl"), "");
    files.extend(files_in(&here.join("words"), ".ncl"));
    files.extend(files_in(&data.join("cl/creo"), ".ncl"));
    let (mut compared, mut steps) = (0, 0);
    for cl in files {
        let mut post = filpost::Post::builder().ready("linuxcnc-mill").build().unwrap();
        let dialect = Dialect::new(post.commons()).unwrap();
        let mut nc = Vec::new();
        if post.run(fs::File::open(&cl).unwrap(), &mut nc).is_err() {
            continue;
        }
        let nc = String::from_utf8(nc).unwrap();
        let name = cl.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let ours = events(nc.as_bytes(), &name, &dialect);
        let calls = match rs274::run(&program, &nc) {
            Ok(calls) => calls,
            Err(said) => {
                println!("{name}: LinuxCNC refuses: {said}; ours: {:?}", ours.err().map(|d| d.to_string()));
                continue;
            }
        };
        let theirs = match nc_path(&calls, &nc) {
            Ok(path) => path,
            Err(said) => { println!("{name}: {said}"); continue; }
        };
        let ours = ours.unwrap_or_else(|diag| panic!("{name}: {diag}\n{nc}"));
        let ours = event_path(&ours, theirs.unit.unwrap());
        let list = differences(&ours, &theirs, TOLERANCE);
        assert!(list.is_empty(), "{name}: {}\n{}", list[..list.len().min(5)].join("\n"), if nc.len() < 3000 { nc.as_str() } else { "" });
        compared += 1;
        steps += ours.steps.len();
    }
    println!("{compared} programs, {steps} steps");
}
