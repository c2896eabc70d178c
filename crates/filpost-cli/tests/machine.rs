//! `filpost machine diff` and the manual page.

use std::process::{Command, Output};

fn filpost(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_filpost")).args(arguments).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn two_machines_differ_by_name_letter_and_number() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let file = folder.path().join("machine.toml");
    let toml = "linear.code = 11\n[address]\nQ = { slot = 53 }\n[int]\n2999 = 7\n";
    std::fs::write(&file, toml).expect("a file");
    let file = file.to_string_lossy();
    let ran = filpost(&["machine", "diff", "fanuc-mill", &file]);
    let out = text(&ran.stdout);
    assert_eq!(ran.status.code(), Some(1), "{out}{}", text(&ran.stderr));
    for line in [
        "linear.code                  1 | 11\n",
        "address.Q                    slot 20, format 4443, spec 101 | none\n",
        "INTCOM 2999                  none | 7\n",
    ] {
        assert!(out.contains(line), "{line}{out}");
    }
}

#[test]
fn a_machine_is_like_itself() {
    let ran = filpost(&["machine", "diff", "grbl", "grbl"]);
    assert_eq!(text(&ran.stdout), "the machines have the same settings\n");
    assert_eq!(ran.status.code(), Some(0));
    let absent = filpost(&["machine", "diff", "grbl", "nowhere.toml"]);
    assert_eq!(absent.status.code(), Some(1));
    assert!(text(&absent.stderr).contains("E0703"));
}

#[test]
fn the_manual_page_names_the_commands() {
    let page = text(&filpost(&["man"]).stdout);
    assert!(page.contains(".TH filpost 1"), "{page}");
    assert!(page.contains("filpost\\-post"), "{page}");
}
