//! Codes of files: input, output, cases, line maps, programs that are compared.

use std::io;
use std::path::{Path, PathBuf};

use filpost::case::Case;
use filpost::nc::diff;
use filpost::nc::verify::Allowed;
use filpost::{Error, Limits, Program, Unit, files, trace};
use filpost_tests::examples::PART;
use filpost_tests::root;

use super::names;

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
    Program::builder().build().expect("the generic mill").post_files(cl, nc)
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
        builder.build()?.post_files(&shop.path("part.ncl"), &shop.path("out.nc"))
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
fn e0916_line_without_an_end() {
    let long = "X1. ".repeat(1 << 19);
    let nc = format!("%\nO1\nG21 {long}\nM30\n");
    let source = filpost::nc::source::Source::memory(nc.as_bytes());
    let error = source.lines("long.nc", &[4]).expect_err("refused");
    assert_eq!(error.code.name(), "E0916");
    let program = Program::builder().ready("fanuc-mill").build().expect("a post");
    let nc = filpost::verify::NcProgram { text: nc.as_bytes(), name: "long.nc" };
    let cl = "UNITS / MM\nFINI\n".as_bytes();
    let refused = program.start().verify(cl, nc, Default::default()).expect_err("refused");
    assert_eq!(names(&refused), ["E0916"]);
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
    let error = post.stream(PART.as_bytes(), full).expect_err("refused");
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
        post.stream(PART.as_bytes(), &mut room[..])
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
fn e0940_unit_not_known() {
    let post = Program::builder().build().expect("the generic mill");
    let mut nc = Vec::new();
    post.stream(PART.as_bytes(), &mut nc).expect("a program");
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
    post.stream(cl("holes.ncl.1").as_slice(), &mut nc).expect("a program");
    let program = filpost::verify::NcProgram { text: &nc, name: "holes.nc" };
    let error = post
        .start()
        .verify(cl("planes.ncl.1").as_slice(), program, Allowed::default())
        .expect_err("refused");
    assert_eq!(names(&error), ["E0941"]);
    assert!(error.diags()[0].notes[0].contains("tool 1"), "{error}");
}
