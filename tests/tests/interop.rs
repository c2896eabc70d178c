//! Real Creo CL files through the ready LinuxCNC post, judged by LinuxCNC's own
//! interpreter: what it does must be what the CL file asks for.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::{env, io};

use filpost_tests::cl_path::cl_path;
use filpost_tests::compare::compare;
use filpost_tests::nc_path::nc_path;
use filpost_tests::path::{Action, ToolPath};
use filpost_tests::rs274;

/// The Creo CL files; none, with the reason printed, where they are absent.
fn creo_files() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let data = env::var_os("FILPOST_DATA").map_or(root.join("../shared/data"), PathBuf::from);
    let folder = data.join("cl/creo");
    let Ok(entries) = fs::read_dir(&folder) else {
        println!("skipped: no folder {}", folder.display());
        return Vec::new();
    };
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// The NC program a ready post makes of a CL file.
fn post_with(ready: &str, cl: &Path) -> Vec<u8> {
    let mut post = filpost::Post::builder().ready(ready).build().unwrap();
    let mut nc = Vec::new();
    let input = io::BufReader::new(File::open(cl).unwrap());
    post.run(input, &mut nc).unwrap_or_else(|error| panic!("{}: {error}", cl.display()));
    nc
}

fn expected(cl: &Path) -> ToolPath {
    cl_path(File::open(cl).unwrap(), &cl.to_string_lossy()).unwrap()
}

fn count(path: &ToolPath, wanted: fn(&Action) -> bool) -> usize {
    path.steps.iter().filter(|step| wanted(&step.action)).count()
}

#[test]
fn creo_files_become_the_same_path() {
    let Some(program) = rs274::program() else { return };
    for cl in creo_files() {
        let nc = String::from_utf8(post_with("linuxcnc-mill", &cl)).unwrap();
        let name = cl.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let calls = rs274::run(&program, &nc).unwrap_or_else(|said| panic!("{name}: {said}"));
        let (wanted, found) = (expected(&cl), nc_path(&calls, &nc).unwrap());
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
    }
}

/// Each arc turned round in a program of the post must be noticed.
#[test]
fn each_turned_arc_is_noticed() {
    let Some(program) = rs274::program() else { return };
    for cl in creo_files() {
        let nc = String::from_utf8(post_with("linuxcnc-mill", &cl)).unwrap();
        let wanted = expected(&cl);
        for (own, other) in [("G2 ", "G3 "), ("G3 ", "G2 ")] {
            for (at, _) in nc.match_indices(own) {
                let mut changed = nc.clone();
                changed.replace_range(at..at + own.len(), other);
                let found = rs274::run(&program, &changed).and_then(|calls| nc_path(&calls, &nc));
                let noticed = found.map_or(true, |path| !compare(&wanted, &path).is_empty());
                assert!(noticed, "{}: arc at byte {at}", cl.display());
            }
        }
    }
}
