//! `filpost studio`: the program that it starts.

use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

#[test]
fn without_its_program_it_says_how_to_get_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = folder.path().join(format!("filpost{}", std::env::consts::EXE_SUFFIX));
    std::fs::copy(env!("CARGO_BIN_EXE_filpost"), &own).expect("a copy of the command");
    let run = || {
        Command::new(&own)
            .args(["studio", "my-post"])
            .current_dir(folder.path())
            .env("PATH", folder.path())
            .output()
    };
    // Another test that starts a program may hold the copy open for a moment.
    let mut tries = (0..50).map(|_| run().inspect_err(|_| sleep(Duration::from_millis(20))));
    let ran = tries.find_map(Result::ok).expect("the command");
    let said = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(1), "{said}");
    assert!(said.contains("E0812") && said.contains("cargo install"), "{said}");
    assert!(!folder.path().join("my-post").exists());
}
