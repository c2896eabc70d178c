//! The error catalogue: every code has its page in `docs/errors/`, and a case
//! in `corpus/errors/`, a file of the lint suite or of `tests/motions/`, or a test
//! in this file. The examples of the pages are run: what stands under "Wrong"
//! raises the code with the words printed there, what stands under "Right" does
//! not. `FILPOST_UPDATE=1` writes the words anew.

use std::collections::BTreeMap;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};

use filpost::case::Case;
use filpost::nc::diff;
use filpost::nc::verify::Allowed;
use filpost::{
    CancelToken, Code, Diag, Error, Limits, Program, Severity, Unit, all_codes, files, trace,
};
use filpost_tests::examples::{self, PART};
use filpost_tests::{lints, motions, root};

/// Codes that no small case folder can raise, with the test of this file that does.
const TESTED_HERE: &[(&str, &str)] = &[
    ("E0107", "e0107_line_too_long"),
    ("E0108", "e0108_file_too_large"),
    ("E0109", "e0109_too_many_errors"),
    ("E0120", "e0120_and_e0121_encodings"),
    ("E0121", "e0120_and_e0121_encodings"),
    ("E0215", "e0215_program_too_large"),
    ("W0220", "w0220_and_w0221_findings_of_check"),
    ("W0221", "w0220_and_w0221_findings_of_check"),
    ("E0229", "e0229_name_of_an_added_function"),
    ("E0305", "e0305_call_depth"),
    ("E0317", "e0317_host_function"),
    ("E0401", "e0401_reading_fails"),
    ("E0403", "e0403_statement_too_long"),
    ("E0409", "e0409_stream_goes_back"),
    ("E0410", "e0410_no_such_record"),
    ("E0411", "e0411_too_many_words"),
    ("E0412", "e0412_and_e0413_writing_cl"),
    ("E0413", "e0412_and_e0413_writing_cl"),
    ("E0414", "e0414_last_line_without_an_end"),
    ("E0701", "e0701_missing_file"),
    ("E0702", "e0702_absent_folder"),
    ("E0705", "e0705_case_file"),
    ("E0707", "e0707_to_e0710_line_maps"),
    ("E0708", "e0707_to_e0710_line_maps"),
    ("E0709", "e0707_to_e0710_line_maps"),
    ("E0710", "e0707_to_e0710_line_maps"),
    ("E0711", "e0711_cancelled"),
    ("E0712", "e0712_record_from_memory"),
    ("E0713", "e0713_codes_that_stand"),
    ("E0714", "e0714_machin_names_no_post"),
    ("E0715", "e0715_units_contradict"),
    ("E0716", "e0716_changed_as_written"),
    ("W0757", "w0757_choice_against_the_signs"),
    ("E0717", "e0717_program_too_long"),
    ("E0915", "e0915_program_changes_while_compared"),
    ("E0940", "e0940_unit_not_known"),
    ("E0941", "e0941_another_part"),
];

fn pages() -> BTreeMap<String, (PathBuf, String)> {
    let folder = root().join("docs/errors");
    let entries = std::fs::read_dir(&folder).expect("docs/errors is there");
    entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.file_name().is_some_and(|name| name != "README.md"))
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            let text = std::fs::read_to_string(&path).expect("a page");
            (name, (path, text))
        })
        .collect()
}

#[test]
fn every_code_has_its_page_and_every_page_its_code() {
    let pages = pages();
    for code in all_codes() {
        let (_, page) =
            pages.get(&code.name()).unwrap_or_else(|| panic!("no page {}", code.name()));
        let first = page.lines().next().unwrap_or_default();
        assert_eq!(first, format!("# {}: {}", code.name(), code.title));
        let flat = page.split_whitespace().collect::<Vec<_>>().join(" ");
        for text in [code.reason, code.hint] {
            assert!(flat.contains(text), "{} does not say: {text}", code.name());
        }
        for heading in ["## Wrong", "## Right"] {
            assert!(page.lines().any(|line| line == heading), "{}: no {heading}", code.name());
        }
    }
    let known: Vec<String> = all_codes().iter().map(|code| code.name()).collect();
    for name in pages.keys().filter(|name| !name[1..].starts_with("08")) {
        assert!(known.contains(name), "page {name} has no code");
    }
}

#[test]
fn the_index_lists_every_page() {
    let index = std::fs::read_to_string(root().join("docs/errors/README.md")).expect("the index");
    for code in all_codes() {
        let row = format!("| [{0}]({0}.md) | {1} |", code.name(), code.title);
        assert!(index.contains(&row), "the index lacks {row}");
    }
}

#[test]
fn every_code_has_a_case_or_a_test() {
    let cases = filpost::case::find(&root().join("corpus/errors")).expect("cases");
    let expected = |case: &Case| -> Vec<String> {
        let warnings = case.file.expect_warnings.iter();
        case.file.expect_error.iter().chain(warnings).cloned().collect()
    };
    for case in &cases {
        let folder = case.folder.file_name().expect("a name").to_string_lossy().into_owned();
        let codes = expected(case);
        assert!(codes.contains(&folder[..5].to_string()), "{folder} expects {codes:?}");
        assert!(
            case.file.expect_at.is_some() || PLACELESS.contains(&&folder[..5]),
            "{folder}: where?"
        );
    }
    let bad = lints::fil_files(&root().join("tests/lints/bad"));
    let read = |path: &PathBuf| std::fs::read_to_string(path).expect("a file of the lint suite");
    let lints: Vec<String> = bad.iter().flat_map(|path| lints::listed(&read(path))).collect();
    let programs: Vec<String> =
        motions::files().iter().filter_map(|path| motions::listed(path)).collect();
    let source = include_str!("errors.rs");
    for code in all_codes() {
        let name = code.name();
        let in_corpus = cases.iter().any(|case| expected(case).contains(&name));
        let here = TESTED_HERE.iter().find(|(code, _)| *code == name);
        let in_lints = lints.iter().any(|listed| listed.starts_with(&name));
        let in_nc = programs.iter().any(|listed| listed.starts_with(&name));
        let once = in_corpus != here.is_some() || ((in_lints || in_nc) && here.is_none());
        assert!(once, "{name}: a case or a test, and not both");
        if let Some((_, test)) = here {
            assert!(source.contains(&format!("fn {test}()")), "there is no test {test}");
        }
    }
}

/// Codes that name no line of a file.
const PLACELESS: &[&str] = &["E0607", "E0703", "W0752", "W0753"];

#[test]
fn examples_do_what_the_pages_say() {
    let update = std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1");
    let mut failures = Vec::new();
    for code in all_codes() {
        let name = code.name();
        let (path, page) = &pages()[&name];
        let mut fresh = page.clone();
        let blocks = examples::blocks(page);
        for (index, block) in blocks.iter().enumerate() {
            let Some(diags) = examples::run(block) else { continue };
            match block.heading {
                "Wrong" => match diags.iter().find(|diag| diag.code == code) {
                    Some(diag) => {
                        let said = blocks.get(index + 1).map_or("", |next| &next.text);
                        if said != format!("{diag}\n") {
                            failures.push(format!("{name}: it says\n{diag}\nnot\n{said}"));
                            fresh = fresh.replacen(
                                &format!("```text\n{said}```"),
                                &format!("```text\n{diag}\n```"),
                                1,
                            );
                        }
                    }
                    None => {
                        failures.push(format!("{name} line {}: not raised {diags:?}", block.line))
                    }
                },
                "Right" => {
                    let bad = |diag: &&Diag| diag.code == code || diag.is_error();
                    if let Some(diag) = diags.iter().find(bad) {
                        failures.push(format!("{name} line {}: {diag}", block.line));
                    }
                }
                heading => failures.push(format!("{name}: an example under {heading}")),
            }
        }
        if update && fresh != *page {
            std::fs::write(path, fresh).expect("the page is written");
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn most_pages_have_examples_that_run() {
    let runs =
        |page: &str| examples::blocks(page).iter().any(|block| examples::run(block).is_some());
    let without: Vec<String> = pages()
        .into_iter()
        .filter(|(name, (_, page))| !name[1..].starts_with("08") && !runs(page))
        .map(|(name, _)| name)
        .filter(|name| !TESTED_HERE.iter().any(|(code, _)| code == name))
        .collect();
    assert!(without.is_empty(), "{without:?}");
}

/// The codes of building a post with this FIL file.
fn building(fil: &str) -> Vec<String> {
    names(&Program::builder().fil("t.fil", fil).build().expect_err("refused"))
}

fn names(error: &Error) -> Vec<String> {
    error.diags().iter().map(|diag| diag.code.name()).collect()
}

/// The code of posting this CL text.
fn posting(cl: &str) -> String {
    let post = Program::builder().build().expect("the generic mill");
    let error = post.run(cl.as_bytes(), &mut Vec::new()).expect_err("refused");
    names(&error).remove(0)
}

#[test]
fn e0107_line_too_long() {
    assert_eq!(building(&format!("$$ {}\nFINI\n", "x".repeat(16_384))), ["E0107"]);
}

#[test]
fn e0108_file_too_large() {
    assert_eq!(building(&" \n".repeat((32 << 20) + 1)), ["E0108"]);
}

#[test]
fn e0109_too_many_errors() {
    let codes = building(&"A=(\n".repeat(200));
    assert_eq!((codes.len(), codes.last().map(String::as_str)), (101, Some("E0109")));
}

#[test]
fn e0120_and_e0121_encodings() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.fil");
    std::fs::write(&path, b"$$ \xff\nFINI\n").expect("a file");
    let refused = |encoding| names(&files::read_text(&path, Some(encoding)).expect_err("refused"));
    assert_eq!(refused("klingon"), ["E0120"]);
    assert_eq!(refused("utf-8"), ["E0121"]);
    assert!(files::read_text(&path, Some("windows-1251")).is_ok());
}

#[test]
fn e0215_program_too_large() {
    assert_eq!(building(&format!("{}FINI\n", "XX=1\n".repeat(66_000))), ["E0215"]);
}

#[test]
fn w0220_and_w0221_findings_of_check() {
    let fil = "CIMFIL/ON,CYCLE\nIF(POSTF(7,4).EQ.MISSNG)DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let diags = filpost_tests::examples::check(fil);
    let found: Vec<_> = diags.iter().map(|diag| (diag.code.number, diag.spans[0].line)).collect();
    assert_eq!(found, [(220, 1), (221, 2)]);
    let build = Program::builder().fil("t.fil", fil).build().expect("a run does not look for them");
    assert!(build.warnings().is_empty());
}

#[test]
fn e0229_name_of_an_added_function() {
    let built = Program::builder().function("SQRTF", 1, |_| Ok(0.0)).build();
    assert_eq!(names(&built.expect_err("refused")), ["E0229"]);
}

#[test]
fn e0711_cancelled() {
    let token = CancelToken::new();
    token.cancel();
    let post = Program::builder().build().expect("the generic mill");
    let error = post.start().cancel(&token).run(PART.as_bytes(), Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0711"]);
}

#[test]
fn e0712_record_from_memory() {
    let post = Program::builder().build().expect("the generic mill");
    let record = fil_cl::Record::goto([f64::NAN; 3], None);
    let error = post.run_records(post.vocabulary(), [record], Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0712"]);
}

#[test]
fn e0305_call_depth() {
    let fil = "MA=MACRO\nXX=1\nTERMAC\nMB=MACRO\nCALL/MA\nTERMAC\nCALL/MB\nFINI\n";
    let limits = Limits { call_depth: 1, ..Limits::default() };
    let post = Program::builder().fil("t.fil", fil).limits(limits).build().expect("a post");
    let error = post.run(PART.as_bytes(), &mut Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0305"]);
    assert_eq!(error.diags()[0].spans[0].line, 5);
}

#[test]
fn e0317_host_function() {
    let fil = "XX=LIFEF(3)\nFINI\n";
    let post = Program::builder()
        .fil("t.fil", fil)
        .function("LIFEF", 1, |_| Err::<f64, _>("the tool table is not there".into()))
        .build()
        .expect("a post");
    let error = post.run(PART.as_bytes(), &mut Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0317"]);
    assert!(error.to_string().contains("the tool table is not there"), "{error}");
}

#[test]
fn e0401_reading_fails() {
    struct Failing;
    impl Read for Failing {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("the stick was pulled out"))
        }
    }
    let post = Program::builder().build().expect("the generic mill");
    let input = Cursor::new("RAPID\n").chain(Failing);
    let error = post.run(input, &mut Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0401"]);
}

#[test]
fn e0403_statement_too_long() {
    assert_eq!(posting(&format!("PPRINT / {}\n", "x".repeat(2 << 20))), "E0403");
}

#[test]
fn e0409_stream_goes_back() {
    let fil = "NN=0\nCIMFIL/ON,COOLNT\nNN=NN+1\nIF(NN.EQ.1)DMY=POSTF(15)\nCIMFIL/OFF\nFINI\n";
    let cl = "RAPID\nCOOLNT / ON\nFINI\n";
    let post = Program::builder().fil("t.fil", fil).build().expect("a post");
    let error = post.run(cl.as_bytes(), &mut Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0409"]);
    assert!(post.run_seekable(Cursor::new(cl), &mut Vec::new()).is_ok());
}

#[test]
fn a_section_that_always_goes_back_is_stopped() {
    let fil = "CIMFIL/ON,COOLNT\nDMY=POSTF(15)\nCIMFIL/OFF\nFINI\n";
    let limits = Limits { fuel: 10_000, ..Limits::default() };
    let post = Program::builder().fil("t.fil", fil).limits(limits).build().expect("a post");
    let cl = Cursor::new("RAPID\nCOOLNT / ON\nFINI\n");
    let error = post.run_seekable(cl, &mut Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0304"]);
}

#[test]
fn e0410_no_such_record() {
    let mut reader =
        fil_cl::Reader::seekable(Cursor::new("RAPID\n"), "a.ncl", fil_cl::Options::default());
    let diag = reader.seek_record(0).expect_err("refused");
    assert_eq!(diag.code.name(), "E0410");
}

#[test]
fn e0411_too_many_words() {
    let cl: String = (0..60_000).map(|number| format!("W{number}/1\n")).collect();
    let mut reader = fil_cl::Reader::new(cl.as_bytes(), "a.ncl", fil_cl::Options::default());
    let (mut vocabulary, mut record) = (fil_cl::Vocabulary::new(), fil_cl::Record::default());
    let refused = std::iter::from_fn(|| Some(reader.read(&mut vocabulary, &mut record)));
    let diag = refused.take(60_001).find_map(Result::err).expect("refused");
    assert_eq!(diag.code.name(), "E0411");
}

#[test]
fn e0412_and_e0413_writing_cl() {
    let vocabulary = fil_cl::Vocabulary::new();
    let mut record = fil_cl::Record::command(fil_cl::words::CYCLE);
    let mut none = [0u8; 2];
    let diag = fil_cl::Writer::new(&mut none[..]).write(&record, &vocabulary).expect_err("no room");
    assert_eq!(diag.code.name(), "E0413");
    record.data = vec![fil_cl::Word::Number(f64::NAN)];
    let diag = fil_cl::Writer::new(Vec::new()).write(&record, &vocabulary).expect_err("refused");
    assert_eq!(diag.code.name(), "E0412");
}

#[test]
fn e0414_last_line_without_an_end() {
    assert_eq!(posting("UNITS / MM\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3."), "E0414");
    assert_eq!(posting("INSERT G0 X1"), "E0414");
}

/// A folder with the part, and what the output is when an older program lies there.
struct Shop {
    folder: tempfile::TempDir,
}

const OLDER: &str = "an older program\n";

impl Shop {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("part.ncl"), PART).expect("a part");
        Shop { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).expect("the folder");
        let name = |entry: io::Result<std::fs::DirEntry>| {
            entry.expect("an entry").file_name().to_string_lossy().into_owned()
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        names
    }
}

fn post_file(cl: &Path, nc: &Path) -> Result<filpost::Report, Error> {
    Program::builder().build().expect("the generic mill").run_files(cl, nc)
}

#[test]
fn e0701_missing_file() {
    let shop = Shop::new();
    std::fs::write(shop.path("out.nc"), OLDER).expect("an older program");
    let error = post_file(&shop.path("nothing.ncl"), &shop.path("out.nc")).expect_err("refused");
    assert_eq!(names(&error), ["E0701"]);
    assert_eq!(std::fs::read_to_string(shop.path("out.nc")).expect("untouched"), OLDER);
    let error = post_file(shop.folder.path(), &shop.path("new.nc")).expect_err("a folder");
    assert_eq!(names(&error), ["E0701"]);
    assert_eq!(shop.names(), ["out.nc", "part.ncl"]);
}

#[test]
fn e0707_to_e0710_line_maps() {
    let folder = root().join("docs/trace");
    let (nc, map) = (folder.join("cover.nc"), folder.join("cover.nc.map"));
    let options = trace::Options { most: 1, ..trace::Options::default() };
    let ask = |file: &Path, line, map: &Path| {
        let place = trace::FilePosition { file: file.to_path_buf(), line, column: None };
        trace::trace(&place, map, &options)
    };
    assert!(ask(&nc, 1, &map).is_ok());
    assert_eq!(names(&ask(&nc, 1, &nc).expect_err("no map")), ["E0707"]);
    let other = root().join("corpus/papers/embos-grooves/grooves.ncl");
    assert_eq!(names(&ask(&other, 1, &map).expect_err("of another run")), ["E0708"]);
    assert_eq!(names(&ask(&nc, 20, &map).expect_err("19 lines")), ["E0709"]);
    assert_eq!(names(&trace::map_of(&other).expect_err("no map of it")), ["E0710"]);
}

#[test]
fn e0702_absent_folder() {
    let shop = Shop::new();
    let error =
        post_file(&shop.path("part.ncl"), &shop.path("absent/out.nc")).expect_err("refused");
    assert_eq!(names(&error), ["E0702"]);
    assert_eq!(shop.names(), ["part.ncl"]);
}

#[test]
fn e0717_program_too_long() {
    let fil = "CIMFIL/ON,GOTO\nDO/LAB2,JJ=1,40\nDO/LAB1,II=1,5000\nPOSTN/OUT,G,4,P,II\nLAB1)CONTIN\n\
               LAB2)CONTIN\nCIMFIL/OFF\nFINI\n";
    let shop = Shop::new();
    let post = |output_bytes| {
        let limits = Limits { output_bytes, ..Limits::default() };
        let builder = Program::builder().fil("t.fil", fil).limits(limits);
        builder.build()?.run_files(&shop.path("part.ncl"), &shop.path("out.nc"))
    };
    assert_eq!(names(&post(2_000_000).expect_err("refused")), ["E0717"]);
    assert_eq!(shop.names(), ["part.ncl"]);
    let report = post(u64::MAX).expect("no limit");
    let text = std::fs::read_to_string(shop.path("out.nc")).expect("a program");
    assert_eq!(report.bytes, text.len() as u64);
    assert!(text.len() > 3_000_000, "{} bytes", text.len());
    let waits = text.lines().filter_map(|line| line.split_once("G4 P")).map(|(_, wait)| wait);
    let mut last = 0.0;
    for wait in waits {
        let wait: f64 = wait.parse().expect("a number");
        assert!(wait == last + 1.0 || wait == 1.0, "{wait} after {last}");
        last = wait;
    }
}

#[test]
fn e0915_program_changes_while_compared() {
    let shop = Shop::new();
    let blocks = |count: usize| -> String { (0..count).map(|n| format!("G1 X{n}.\n")).collect() };
    let [first, second] = ["first.nc", "second.nc"].map(|name| shop.path(name));
    std::fs::write(&first, blocks(2000)).expect("a program");
    std::fs::write(&second, blocks(2001)).expect("a program");
    let options = diff::Options::default();
    let files = [&first, &second].map(|path| std::fs::File::open(path).expect("the program"));
    let [one, two] = diff::open(files.map(|file| (file, "a program")), &options).expect("read");
    std::fs::write(&first, blocks(1000)).expect("a shorter program");
    let error = diff::compare(&one, &two, &options).expect_err("refused");
    assert_eq!(error.code.name(), "E0915");
}

#[test]
fn e0702_output_is_a_folder() {
    let shop = Shop::new();
    let error = post_file(&shop.path("part.ncl"), shop.folder.path()).expect_err("refused");
    assert_eq!(names(&error), ["E0702"]);
    assert_eq!(shop.names(), ["part.ncl"]);
}

#[test]
fn e0702_read_only_file() {
    let shop = Shop::new();
    let nc = shop.path("out.nc");
    std::fs::write(&nc, OLDER).expect("an older program");
    let mut rights = std::fs::metadata(&nc).expect("the file").permissions();
    rights.set_readonly(true);
    std::fs::set_permissions(&nc, rights).expect("read-only");
    let error = post_file(&shop.path("part.ncl"), &nc).expect_err("refused");
    assert_eq!(names(&error), ["E0702"]);
    assert_eq!(std::fs::read_to_string(&nc).expect("untouched"), OLDER);
    assert_eq!(shop.names(), ["out.nc", "part.ncl"]);
}

#[cfg(target_os = "linux")]
#[test]
fn e0702_full_disk() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("/dev/full");
    let post = Program::builder().build().expect("the generic mill");
    let error = post.run(PART.as_bytes(), full).expect_err("refused");
    assert_eq!(names(&error), ["E0702"]);
}

#[test]
fn e0702_disk_full_under_way() {
    let shop = Shop::new();
    let nc = shop.path("out.nc");
    std::fs::write(&nc, OLDER).expect("an older program");
    let result = files::write_whole(&nc, |_| {
        let post = Program::builder().build()?;
        let mut room = [0u8; 100];
        post.run(PART.as_bytes(), &mut room[..])
    });
    assert_eq!(names(&result.expect_err("refused")), ["E0702"]);
    assert_eq!(std::fs::read_to_string(&nc).expect("untouched"), OLDER);
    assert_eq!(shop.names(), ["out.nc", "part.ncl"]);
}

#[test]
fn a_refused_record_leaves_no_file_and_an_older_one_as_it_was() {
    let shop = Shop::new();
    let wrong = PART.replace("GOTO / 10, 0, 0", "GOTO / 100000, 0, 0");
    std::fs::write(shop.path("part.ncl"), wrong).expect("a part");
    let error = post_file(&shop.path("part.ncl"), &shop.path("out.nc")).expect_err("refused");
    assert_eq!(names(&error), ["E0501"]);
    assert_eq!(shop.names(), ["part.ncl"]);
    std::fs::write(shop.path("out.nc"), OLDER).expect("an older program");
    post_file(&shop.path("part.ncl"), &shop.path("out.nc")).expect_err("refused");
    assert_eq!(std::fs::read_to_string(shop.path("out.nc")).expect("untouched"), OLDER);
    assert_eq!(shop.names(), ["out.nc", "part.ncl"]);
}

#[test]
fn e0705_case_file() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("case.toml"), "cl = 'a'\norigin = 'x'\nposts = 'y'\n")
        .expect("a case");
    let error = Case::load(folder.path()).expect_err("refused");
    assert_eq!(names(&error), ["E0705"]);
    assert_eq!(error.diags()[0].spans[0].line, 3);
}

#[test]
fn e0713_codes_that_stand() {
    for name in ["E0501", "E0201", "E9999", "W151", ""] {
        let diag = filpost::allowable(name).expect_err("it can't be allowed");
        assert_eq!(diag.code.name(), "E0713", "{name}");
    }
    for name in ["E0223", "e0122", "W0151", "w0552"] {
        let code = filpost::allowable(name).expect("it can be allowed");
        assert!(code.name().eq_ignore_ascii_case(name));
    }
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("case.toml"), "cl = 'a'\norigin = 'x'\nallow = ['E0501']\n")
        .expect("a case");
    let case = Case::load(folder.path()).expect("a case");
    assert_eq!(names(&case.program().expect_err("refused")), ["E0713"]);
}

#[test]
fn a_case_allows_codes() {
    let folder = root().join("corpus/errors/E0223-if-around-13");
    let mut case = Case::load(&folder).expect("a case");
    case.file.allow = vec!["E0223".into()];
    let post = case.program().expect("the block is closed");
    let warnings: Vec<String> = post.warnings().iter().map(|diag| diag.code.name()).collect();
    assert_eq!(warnings, ["W0150"]);
    case.file.allow.push("W0150".into());
    assert!(case.program().expect("the block is closed").warnings().is_empty());
}

#[test]
fn e0714_machin_names_no_post() {
    let asked = filpost::select::asked(
        "MACHIN / UNCX01, 7\n".as_bytes(),
        "part.ncl",
        fil_cl::reader::Options::default(),
    );
    let refused = filpost::select::choose(&asked.expect("MACHIN"), &[]).expect_err("refused");
    assert_eq!(names(&refused), ["E0714"]);
}

#[test]
fn e0715_units_contradict() {
    let given = |program: &Program, unit, cl: &str| {
        program.start().units(unit).run(cl.as_bytes(), Vec::new()).map_err(|error| names(&error))
    };
    let mill = Program::builder().build().expect("the generic mill");
    let part = PART.replace("UNITS / MM\n", "");
    assert!(given(&mill, Unit::Inch, &part).is_ok() && given(&mill, Unit::Mm, PART).is_ok());
    assert_eq!(given(&mill, Unit::Inch, PART).expect_err("refused"), ["E0715"]);
    let metric = Program::builder().set("units.mode=2").build().expect("a metric mill");
    assert!(given(&metric, Unit::Mm, &part).is_ok());
    assert_eq!(given(&metric, Unit::Inch, &part).expect_err("refused"), ["E0715"]);
}

#[test]
fn e0716_changed_as_written() {
    let posted = |fil: &str, raw: bool| {
        let fil =
            format!("$$ filpost: allow-file W0218\nCIMFIL/ON,FEDRAT\n{fil}CIMFIL/OFF\nFINI\n");
        let post = Program::builder().fil("macros.fil", &fil).build().expect("a post");
        let reading = filpost::cl::Options { raw, ..Default::default() };
        let cl =
            "PAINT/PATH\nUNITS/MM\nLOAD/TOOL,1\nSPINDL/RPM,900,CLW\nFEDRAT/MMPM,250.\nGOTO/1,2,3\n";
        let mut nc = Vec::new();
        let ran = post.start().reading(reading).run(cl.as_bytes(), &mut nc);
        ran.map(|_| String::from_utf8(nc).expect("ASCII")).map_err(|error| names(&error))
    };
    let changed = "DMY=POSTF(8,5,POSTF(7,5)*0.8)\nDMY=POSTF(13)\n";
    assert_eq!(posted(changed, true).expect_err("refused"), ["E0716"]);
    let anew = "FEDRAT/(POSTF(7,5)*0.8),MMPM\n";
    assert!(posted(anew, true).expect("a program").contains("F200."));
    assert!(posted("DMY=POSTF(13)\n", true).expect("a program").contains("F250."));
    let other = changed.replace("8,5,POSTF(7,5)", "8,4,POSTF(7,4)");
    assert!(posted(&other, false).expect("a program").contains("F200."));
}

#[test]
fn e0940_unit_not_known() {
    let post = Program::builder().build().expect("the generic mill");
    let mut nc = Vec::new();
    post.run(PART.as_bytes(), &mut nc).expect("a program");
    let cl = PART.replace("UNITS / MM\n", "");
    let checked = |unit: Option<Unit>| {
        let run = unit.map_or(post.start(), |unit| post.start().units(unit));
        let nc = filpost::verify::NcProgram { text: &nc, name: "part.nc" };
        run.verify(cl.as_bytes(), nc, Allowed::default())
    };
    assert_eq!(names(&checked(None).expect_err("refused")), ["E0940"]);
    let nc = filpost::verify::NcProgram { text: &nc, name: "part.nc" };
    let other = post.start().units(Unit::Inch).verify(PART.as_bytes(), nc, Allowed::default());
    assert_eq!(names(&other.expect_err("UNITS says mm")), ["E0940"]);
    let verdict = |unit| checked(Some(unit)).expect("a report").0.verdict();
    assert_eq!(verdict(Unit::Mm), filpost::nc::verify::Verdict::Agrees);
    assert_eq!(verdict(Unit::Inch), filpost::nc::verify::Verdict::Differs);
}

#[test]
fn e0941_another_part() {
    let cl = |name: &str| std::fs::read(root().join("tests/cl").join(name)).expect("a CL file");
    let post = Program::builder().build().expect("the generic mill");
    let mut nc = Vec::new();
    post.run(cl("holes.ncl.1").as_slice(), &mut nc).expect("a program");
    let program = filpost::verify::NcProgram { text: &nc, name: "holes.nc" };
    let error = post
        .start()
        .verify(cl("planes.ncl.1").as_slice(), program, Allowed::default())
        .expect_err("refused");
    assert_eq!(names(&error), ["E0941"]);
    assert!(error.diags()[0].notes[0].contains("tool 1"), "{error}");
}

#[test]
fn severities_and_letters_agree() {
    let letter = |code: &Code| if code.severity == Severity::Error { 'E' } else { 'W' };
    assert!(all_codes().iter().all(|code| code.name().starts_with(letter(code))));
}

#[test]
fn w0757_choice_against_the_signs() {
    let mill = Program::builder().ready("fanuc-mill").build().expect("a ready post");
    let text =
        "TOOL PATH/ROUGH,TOOL,MILL_10\nUNITS/MM\nFEDRAT/100.0,MMPM\nGOTO/1.0,2.0,3.0\nFINI\n";
    let post = |dialect| {
        let options = filpost::cl::Options { dialect, ..Default::default() };
        let mut nc = Vec::new();
        mill.start().reading(options).run(text.as_bytes(), &mut nc).expect("it is posted").warnings
    };
    let chosen = post(Some(filpost::cl::ClDialect::Creo));
    let codes: Vec<String> = chosen.iter().map(|diag| diag.code.name()).collect();
    assert_eq!((codes, chosen[0].spans[0].line), (vec!["W0757".to_string()], 1));
    assert!(post(None).is_empty());
}
