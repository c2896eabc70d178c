//! NC programs in code pages of controls.

use crate::support::{Folder, SMALL};

const MACHINE: &str = "base = \"fanuc-mill\"\ntape.encoding = \"windows-1252\"\n";

/// A folder with a machine in windows-1252, a CL file, and its program with a map.
fn posted() -> Folder {
    let cl = SMALL.replace("FINI", "PPRINT / FRÄSER Ø10\nFINI");
    let place = Folder::new().with("part.ncl", cl).with("mill.toml", MACHINE);
    let ran = place.run(&["post", "-m", "mill.toml", "part.ncl", "-o", "part.nc", "--map"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(!ran.err.contains("W0555"), "{}", ran.err);
    place
}

#[test]
fn a_program_in_a_code_page_is_read_by_all_commands() {
    let place = posted();
    let nc = place.bytes("part.nc");
    let text = b"(FR\xC4SER \xD810)";
    let line = nc.split(|byte| *byte == b'\n').position(|line| line.ends_with(text));
    let line = line.expect("the text in windows-1252") + 1;

    let traced = place.run(&["trace", &format!("part.nc:{line}:12")]);
    assert!(traced.out.contains("(FRÄSER Ø10)"), "{traced:?}");
    let verified = place.run(&["verify", "-m", "mill.toml", "part.ncl", "part.nc"]);
    assert!(verified.out.contains("part.nc agrees with part.ncl"), "{verified:?}");
    let plotted = place.run(&["plot", "-m", "mill.toml", "part.nc", "-o", "part.html"]);
    assert_eq!(plotted.status, 0, "{plotted:?}");

    let other: Vec<u8> = nc.iter().map(|byte| if *byte == 0xC4 { 0xD6 } else { *byte }).collect();
    let place = place.with("other.nc", other);
    let apart = place.run(&["diff", "part.nc", "other.nc"]);
    assert!(apart.status == 1 && apart.out.contains(r"(FR\xC4SER \xD810)"), "{apart:?}");
    let read = place.run(&["diff", "--nc-encoding", "cp1252", "part.nc", "other.nc"]);
    let said = "comment (FRÖSER Ø10) instead of (FRÄSER Ø10)";
    assert!(read.status == 1 && read.out.contains(said), "{read:?}");
    let unknown = place.run(&["diff", "--nc-encoding", "klingon", "part.nc", "other.nc"]);
    assert!(unknown.err.contains("shift_jis"), "{unknown:?}");
}

#[test]
fn a_letter_that_the_page_lacks_leaves_no_program() {
    let cl = SMALL.replace("FINI", "PPRINT / 刀\nFINI");
    let place = Folder::new().with("part.ncl", cl).with("mill.toml", MACHINE);
    let ran = place.run(&["post", "-m", "mill.toml", "part.ncl", "-o", "part.nc"]);
    assert!(ran.status == 1 && ran.err.contains("E0543"), "{ran:?}");
    assert!(place.files() == ["mill.toml", "part.ncl"]);
}

#[test]
fn the_encoding_is_one_for_the_whole_program() {
    let place =
        Folder::new().with("part.ncl", SMALL).with("set.fil", "DMY=POSTF(2,1,9044,1252)\nFINI\n");
    let ran = place.run(&["post", "-p", "fanuc-mill", "-f", "set.fil", "part.ncl"]);
    assert!(ran.status == 1 && ran.err.contains("E0605"), "{ran:?}");
    for wrong in ["klingon", "1", "utf-16le"] {
        let setting = format!("tape.encoding={wrong}");
        let ran = place.run(&["post", "-p", "fanuc-mill", "--set", &setting, "part.ncl"]);
        assert!(ran.err.contains("E0605") && ran.err.contains("932=shift_jis"), "{ran:?}");
    }
}
