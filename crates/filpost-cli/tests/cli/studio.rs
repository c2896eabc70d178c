//! `filpost studio`: the program that it starts.

use std::process::Command;

#[test]
fn without_its_program_it_says_how_to_get_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = folder.path().join(format!("filpost{}", std::env::consts::EXE_SUFFIX));
    std::fs::copy(env!("CARGO_BIN_EXE_filpost"), &own).expect("a copy of the command");
    let ran = Command::new(&own)
        .args(["studio", "my-post"])
        .current_dir(folder.path())
        .env("PATH", folder.path())
        .output()
        .expect("the command");
    let said = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(1), "{said}");
    assert!(said.contains("E0812") && said.contains("cargo install"), "{said}");
    assert!(!folder.path().join("my-post").exists());
}
