use std::fs;
use std::path::{Path, PathBuf};

use super::tree::Tree;
use super::{code, post, word};

/// What skeletons change.
const CHANGED: &[&str] = &[
    "crates/fil-cl/data/vocabulary.tsv",
    "crates/fil-cl/src/words.rs",
    "crates/fil-nc/src/verify/cl_path/words.rs",
    "crates/fil-post/data/no-effect.tsv",
    "crates/fil-post/src/dispatch.rs",
    "crates/fil-post/src/errors.rs",
    "crates/fil-post/src/words/mod.rs",
    "corpus/posts/fanuc-mill/production/case.toml",
    "docs/SUMMARY.md",
    "docs/compat.md",
    "docs/machine.md",
    "fil-scripts/posts.rs",
    "tests/api/codes.txt",
    "tests/reference/words.txt",
];

fn copy() -> (tempfile::TempDir, Tree) {
    let (folder, root) = (tempfile::tempdir().unwrap(), filpost_tests::root());
    let pages = fs::read_dir(root.join("docs/errors")).unwrap();
    let pages = pages.map(|page| format!("docs/errors/{}", page.unwrap().file_name().display()));
    for file in CHANGED.iter().map(ToString::to_string).chain(pages) {
        let to = folder.path().join(&file);
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(root.join(file), to).unwrap();
    }
    let tree = Tree::new(folder.path().to_path_buf());
    (folder, tree)
}

/// Each file has its lines and one that begins so, with its neighbours in order.
fn has_new_line(folder: &Path, file: &str, line: &str) {
    let (before, after) = (read(filpost_tests::root(), file), read(folder, file));
    let new: Vec<&str> =
        after.lines().filter(|line| !before.lines().any(|old| old == *line)).collect();
    assert!(new.contains(&line), "{file}: {new:?}");
    let lines: Vec<&str> = after.lines().collect();
    let old: Vec<&str> = before.lines().collect();
    let mut kept = lines.iter();
    assert!(old.iter().all(|line| kept.any(|found| found == line)), "{file} has lost a line");
}

fn read(folder: &Path, file: &str) -> String {
    fs::read_to_string(folder.join(file)).unwrap()
}

#[test]
fn a_new_word_is_in_all_its_places() {
    let (folder, mut tree) = copy();
    let args = |name: &str, minors: &[&str]| word::Args {
        name: name.into(),
        minors: minors.iter().map(|minor| minor.to_string()).collect(),
    };
    assert!(word::write(&mut tree, &args("breset", &[])).is_err(), "no word of the vocabulary");
    assert!(word::write(&mut tree, &args("dyndmp", &["drak"])).is_err(), "no word either");
    let told = word::write(&mut tree, &args("dyndmp", &["dark", "ON"])).unwrap();
    for (file, line) in [
        ("crates/fil-post/src/words/mod.rs", "pub mod dyndmp;"),
        ("crates/fil-post/src/dispatch.rs", "    (w::DYNDMP, I(word::dyndmp::handle)),"),
        ("crates/fil-nc/src/verify/cl_path/words.rs", "    (w::DYNDMP, Ignored(NO_PROGRAM)),"),
        ("crates/fil-cl/src/words.rs", "        DARK,"),
        ("docs/compat.md", "| DYNDMP | refused: what it does is not known | our own | - |"),
        ("docs/SUMMARY.md", "  - [DYNDMP](reference/word-DYNDMP.md)"),
        ("tests/reference/words.txt", "# DYNDMP"),
        ("tests/reference/words.txt", "DYNDMP / DARK"),
    ] {
        has_new_line(folder.path(), file, line);
        assert!(told.contains(file), "{told}");
    }
    for file in ["crates/fil-post/src/words/dyndmp.rs", "tests/words/dyndmp-is-refused.ncl"] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
    syn::parse_file(&read(folder.path(), "crates/fil-post/src/words/dyndmp.rs")).unwrap();
    assert!(word::write(&mut tree, &args("DYNDMP", &[])).is_err(), "it is there");
}

#[test]
fn a_new_code_is_in_all_its_places() {
    let (folder, mut tree) = copy();
    let args = code::Args {
        crate_name: "fil-post".into(),
        variant: "OfATestAlone".into(),
        title: "code of a test alone".into(),
        kind: "error".into(),
    };
    let told = code::write(&mut tree, &args).unwrap();
    let number = told.split("docs/errors/").nth(1).and_then(|rest| rest.get(..5)).unwrap();
    assert!(filpost::all_codes().iter().all(|code| code.name()[1..] != number[1..]), "{number}");
    let row = format!("  - [{number}](errors/{number}.md)");
    has_new_line(folder.path(), "docs/SUMMARY.md", &row);
    let row = format!("| [{number}]({number}.md) | code of a test alone |");
    has_new_line(folder.path(), "docs/errors/README.md", &row);
    has_new_line(folder.path(), "tests/api/codes.txt", &number[1..]);
    let table = read(folder.path(), "crates/fil-post/src/errors.rs");
    syn::parse_file(&table).unwrap();
    assert!(table.contains("OfATestAlone = "));
    // Both examples of its page are run, as those of each page.
    let page = read(folder.path(), &format!("docs/errors/{number}.md"));
    let blocks = filpost_tests::examples::blocks(&page);
    let runs = |heading: &str| {
        let mut of = blocks.iter().filter(|block| block.heading == heading);
        of.any(|block| filpost_tests::examples::run(block).is_some())
    };
    assert!(runs("Wrong") && runs("Right"), "{page}");
    assert!(code::write(&mut tree, &args).is_err(), "it is there");
}

#[test]
fn a_new_post_is_in_all_its_places() {
    let (folder, mut tree) = copy();
    let args = |name: &str, base: &str| post::Args { name: name.into(), base: base.into() };
    for (name, base) in [("Fadal", "fanuc-mill"), ("no-such-mill", "no-such-post")] {
        assert!(post::write(&mut tree, &args(name, base)).is_err(), "{name} {base}");
    }
    post::write(&mut tree, &args("no-such-mill", "fanuc-mill")).unwrap();
    has_new_line(folder.path(), "fil-scripts/posts.rs", "    \"no-such-mill\",");
    has_new_line(
        folder.path(),
        "docs/machine.md",
        "| `no-such-mill` | which machines and controls |",
    );
    let machine = read(folder.path(), "fil-scripts/posts/no-such-mill/machine.toml");
    filpost::Program::builder().machine("machine.toml", &machine).build().unwrap();
    let case = read(folder.path(), "corpus/posts/no-such-mill/production/case.toml");
    assert!(case.contains("ready = \"no-such-mill\"") && !case.contains("fanuc"), "{case}");
    // It stands alone, as each ready post does.
    let base = filpost::ready::find("fanuc-mill").expect("the base").machine;
    assert_eq!(machine.lines().count(), base.lines().count());
    assert!(machine.lines().any(|line| line == "name = \"no-such-mill\""));
    assert!(!machine.lines().any(|line| line.starts_with("base = ")));
}

/// A ready post is judged where a case posts with it, as `verify` goes over each case.
#[test]
fn each_ready_post_has_a_judged_program() {
    let root = filpost_tests::root();
    let not_followed: Vec<String> = read(root, "tests/verify/agree.txt")
        .lines()
        .filter_map(|line| line.split_once(": E").map(|(case, _)| case.to_string()))
        .collect();
    let mut judged = Vec::new();
    for case in cases(&root.join("corpus")) {
        let name = case.strip_prefix(root).unwrap().display().to_string();
        let text = fs::read_to_string(case.join("case.toml")).unwrap();
        let post = text.lines().find_map(|line| line.strip_prefix("ready = \"")?.strip_suffix('"'));
        let has_program = text.lines().any(|line| line.starts_with("expect = "));
        judged.extend(
            post.filter(|_| has_program && !not_followed.contains(&name)).map(str::to_string),
        );
    }
    for post in filpost::ready::READY {
        assert!(
            judged.iter().any(|name| name == post.name),
            "no case in corpus/ posts with {} a program that verify follows",
            post.name
        );
    }
}

fn cases(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let folders = entries.filter(|path| path.is_dir());
    let mut found: Vec<PathBuf> = folders.flat_map(|path| cases(&path)).collect();
    if folder.join("case.toml").is_file() {
        found.push(folder.to_path_buf());
    }
    found
}
