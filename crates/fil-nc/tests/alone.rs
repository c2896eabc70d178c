//! The judge shares no code with the writer: its crate is built without that of the post.

use std::process::Command;

#[test]
fn it_is_built_without_the_post() {
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--package", "fil-nc", "--edges", "normal,build"])
        .args(["--prefix", "none", "--format", "{p}"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo tree");
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let tree = String::from_utf8_lossy(&tree.stdout);
    let crates: Vec<&str> = tree.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(crates.contains(&"fil-nc") && crates.contains(&"fil-cl"), "{tree}");
    for other in ["fil-post", "fil-vm", "fil-syntax", "filpost"] {
        assert!(!crates.contains(&other), "fil-nc is built with {other}:\n{tree}");
    }
}
