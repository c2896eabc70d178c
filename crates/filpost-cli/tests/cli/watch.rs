//! `filpost watch`: a case is changed while it is watched.

use std::io::{BufRead, BufReader};
use std::process::Stdio;

use crate::support::{Folder, SMALL};

const CASE: &str = "cl = \"part.ncl\"\nready = \"fanuc-mill\"\noptions.style = \"plain\"\nfil = [\"post.fil\"]\n\
                    expect = \"x.nc\"\norigin = \"a test\"\n";

#[test]
fn each_save_is_posted_and_told() {
    let place = Folder::new()
        .with("case/case.toml", CASE)
        .with("case/part.ncl", SMALL)
        .with("case/post.fil", "FINI\n");
    let mut child = place
        .command(&["watch", "case", "--runs", "5"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts");
    let mut lines = BufReader::new(child.stdout.take().expect("a pipe")).lines();
    // Each run ends with a line of its time.
    let mut run = || -> Vec<String> {
        let mut said = Vec::new();
        for line in lines.by_ref() {
            let line = line.expect("a line");
            said.push(line.clone());
            if line.ends_with(" ms") {
                break;
            }
        }
        said
    };
    let first = run();
    assert!(first.last().is_some_and(|line| line.starts_with("8 lines, 0 warnings")), "{first:?}");
    let place = place.with("case/part.ncl", SMALL.replace("GOTO / 1", "GOTO / 11"));
    let moved = run();
    assert!(moved.iter().any(|line| line.contains("X more by 10")), "{moved:?}");
    let place = place.with("case/post.fil", "CIMFIL/ON,LOADTL\nNN=\nCIMFIL/OFF\nFINI\n");
    assert!(run()[0].starts_with("refused, no program"));
    let place = place.with("case/post.fil", "$$ nothing\nFINI\n");
    let same = run();
    assert_eq!(same[0], "the program is the same");
    let _place = place.with("case/post.fil", "$$ without an end\n");
    let warned = run();
    assert!(warned.iter().any(|line| line.starts_with("new warning W0152")), "{warned:?}");
    assert!(child.wait().expect("it ends").success());
}

/// From the save of a case of the corpus to the last line that is told of it.
#[test]
fn a_save_is_told_within_a_tenth_of_a_second() {
    let mut place = Folder::new();
    let corpus = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/tutorial");
    for entry in std::fs::read_dir(corpus).expect("the case").flatten() {
        let name = format!("case/{}", entry.file_name().to_string_lossy());
        place = place.with(&name, std::fs::read(entry.path()).expect("a file"));
    }
    const SAVES: usize = 9;
    let runs = (SAVES + 1).to_string();
    let mut child = place
        .command(&["watch", "case", "--runs", &runs])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts");
    let mut lines = BufReader::new(child.stdout.take().expect("a pipe")).lines();
    let mut told = || -> String {
        let mut lines = lines.by_ref().map(|line| line.expect("a line"));
        lines.find(|line| line.ends_with(" ms")).expect("a line of its time")
    };
    told();
    let mut times = Vec::new();
    for save in 0..SAVES {
        let script = place.text("case/mill.fil").expect("the script");
        let start = std::time::Instant::now();
        place = place.with("case/mill.fil", format!("{script}$$ {save}\n"));
        told();
        times.push(start.elapsed().as_secs_f64() * 1000.0);
    }
    times.sort_by(f64::total_cmp);
    println!("after a save: {:.0} ms in the middle of {times:.0?}", times[SAVES / 2]);
    // The fastest: other work of this machine is none of the command's.
    assert!(times[0] < 100.0, "{times:?}");
    assert!(child.wait().expect("it ends").success());
}
