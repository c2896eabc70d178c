//! `cargo xtask shadow` as it is called.

use std::fs;
use std::process::Command;

/// Exit status and output of the command on the language suite.
fn shadow(arguments: &[&str]) -> (i32, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_filpost-xtask"));
    let output = command.args(["shadow", "--suite", "language"]).args(arguments).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    (output.status.code().unwrap_or(-1), said + &String::from_utf8_lossy(&output.stderr))
}

#[test]
fn a_run_differs_from_another_record_alone() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("record.txt");
    let name = file.to_str().unwrap();
    assert_eq!(shadow(&["--record", name]), (0, String::new()));
    let record = fs::read_to_string(&file).unwrap();
    assert_eq!(shadow(&["--jobs", "1", "--record", name]).0, 0);
    assert_eq!(fs::read_to_string(&file).unwrap(), record, "with one thread");
    let count = record.lines().count();
    let (status, said) = shadow(&["--against", name]);
    assert_eq!((status, said), (0, format!("0 of {count} programs differ\n")));

    let changed = record.lines().find(|line| line.contains(" posted ")).unwrap();
    let words: Vec<&str> = changed.split(' ').collect();
    let other = changed.replace(&format!("posted {}", words[4]), "refused - E0503:1");
    fs::write(&file, record.replace(changed, &other)).unwrap();
    let (status, said) = shadow(&["--against", name]);
    assert_eq!(status, 1);
    assert!(said.contains(&format!("{} own: refused -> posted; -E0503:1", words[1])), "{said}");
    assert!(said.ends_with(&format!("\n1 of {count} programs differ\n")), "{said}");
}

#[test]
fn what_can_not_be_compared_is_said() {
    let (status, said) = shadow(&["--base", "no-such-revision"]);
    assert_eq!((status, &*said), (2, "error: there is no revision no-such-revision\n"));
    assert_eq!(shadow(&["--post", "no-such-post"]).0, 2);
}
