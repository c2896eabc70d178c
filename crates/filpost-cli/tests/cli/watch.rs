//! `filpost watch`: a case is changed while it is watched.

use std::io::{BufRead, BufReader};
use std::process::Stdio;

use crate::support::{Folder, SMALL};

const CASE: &str = "cl = \"part.ncl\"\nready = \"fanuc-mill\"\nfil = [\"post.fil\"]\n\
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
