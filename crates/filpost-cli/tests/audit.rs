//! `filpost post --audit` and what refuses a program.

use std::path::Path;
use std::process::{Command, Output};

const CL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nCOOLNT / FLOOD\nRAPID\n\
                  GOTO / 0, 0, 50\nFEDRAT / 200, MMPM\nGOTO / 0, 0, 5\nCOOLNT / OFF\nFINI\n";

const FIL: &str = "CIMFIL/ON,COOLNT,FLOOD\nPOSTN/OUT,M,88\nCIMFIL/OFF\nFINI\n";

fn post(folder: &Path, more: &[&str]) -> Output {
    std::fs::write(folder.join("part.ncl"), CL).expect("a file");
    std::fs::write(folder.join("mill.fil"), FIL).expect("a file");
    let arguments = ["post", "part.ncl", "-p", "fanuc-mill", "-f", "mill.fil", "-o", "part.nc"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_filpost"));
    command.args(arguments).args(more).current_dir(folder).output().expect("the command runs")
}

#[test]
fn changes_are_listed_and_written_as_json() {
    let folder = tempfile::tempdir().expect("a folder");
    let done = post(folder.path(), &["--audit=audit.json", "--map"]);
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{said}");
    let change = "mill.fil:2 section COOLNT,FLOOD, CL line 5: `M8` -> `M88`";
    assert!(said.contains(change), "{said}");
    let json = std::fs::read_to_string(folder.path().join("audit.json")).expect("the audit");
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["verdict"], "changed");
    assert_eq!(json["changes"][0]["author"]["line"], 2);
    assert_eq!(json["changes"][0]["what"]["to"][0], "M88");
    assert!(folder.path().join("part.nc").exists() && folder.path().join("part.nc.map").exists());
}

#[test]
fn a_change_is_refused_where_it_is_denied() {
    let folder = tempfile::tempdir().expect("a folder");
    let done = post(folder.path(), &["--audit", "--deny", "audit"]);
    let said = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{said}");
    assert!(said.contains("E0813") && said.contains("section COOLNT"), "{said}");
    assert!(!folder.path().join("part.nc").exists());
}

#[test]
fn a_map_of_another_program_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(post(folder.path(), &["--map"]).status.success());
    let nc = folder.path().join("part.nc");
    let text = std::fs::read_to_string(&nc).expect("the program");
    std::fs::write(&nc, text.replace("Z5.", "Z4.")).expect("another program");
    let verify = ["verify", "part.ncl", "part.nc", "-p", "fanuc-mill", "--map", "part.nc.map"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_filpost"));
    let done = command.args(verify).current_dir(folder.path()).output().expect("the command runs");
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(said.contains("E0708"), "{said}");
}
