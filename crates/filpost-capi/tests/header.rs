//! `include/filpost.h` is what the sources say; `FILPOST_UPDATE=1` writes it anew.

use std::path::Path;

#[test]
fn the_header_is_that_of_the_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("the settings");
    let mut made = Vec::new();
    let builder = cbindgen::Builder::new().with_config(config).with_crate(root);
    builder.generate().expect("a header").write(&mut made);
    let made = String::from_utf8(made).expect("UTF-8");
    // What Rust asks of a caller stands in the sentences above it, and at the top.
    let mut kept = String::new();
    let mut in_safety = false;
    for line in made.lines() {
        in_safety |= line.trim() == "* # Safety";
        in_safety &= !line.trim().starts_with("*/");
        if !in_safety {
            kept.push_str(line);
            kept.push('\n');
        }
    }
    let kept = kept.replace(" *\n */", " */");
    let name = root.join("include/filpost.h");
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        std::fs::write(&name, &kept).expect("written");
    }
    assert_eq!(std::fs::read_to_string(&name).expect("the header"), kept);
}
