//! The line map: every case of the corpus is posted with one, and what the map
//! says of each line and word is held against the CL file and the program.
//! `FILPOST_UPDATE=1` writes the program and the map of docs/trace anew.

use std::collections::HashMap;
use std::io::Cursor;
use std::path::Path;

use fil_machine::locations::{self, ControlFamily};
use filpost::case::{self, Case};
use filpost::cl::record::motion;
use filpost::cl::{ClDialect, Record, Vocabulary, Word, reader};
use filpost::map::{Digest, Entry, MapReader, Names, NcLine};
use filpost::{Error, Program, files};
use filpost_tests::root;
use proptest::prelude::*;

fn names(post: &Program) -> Names {
    Names { cl: "part.ncl".into(), nc: "part.nc".into(), fil: post.fil_files() }
}

/// The program and its map; `None` for a case that is refused.
fn mapped(case: &Case) -> Option<(Vec<u8>, Vec<u8>)> {
    let post = case.program().ok()?;
    let cl = files::read(&case.folder.join(&case.file.cl)).ok()?;
    let (mut nc, mut map) = (Vec::new(), Vec::new());
    let names = names(&post);
    post.start().run_mapped(Cursor::new(cl), &mut nc, &names, &mut map).ok()?;
    Some((nc, map))
}

/// The lines of a map, which must be whole.
fn lines(map: &[u8]) -> Vec<NcLine> {
    let reader = MapReader::new("part.map", Cursor::new(map)).expect("a map");
    let entries: Result<Vec<Entry>, Error> = reader.collect();
    let entries = entries.expect("a whole map").into_iter();
    entries
        .filter_map(|entry| match entry {
            Entry::Line(line) => Some(line),
            Entry::Taken(_) => None,
        })
        .collect()
}

fn cases() -> Vec<Case> {
    case::find(&root().join("corpus")).expect("the corpus")
}

/// The records of a CL file by number.
fn records(path: &Path, dialect: Option<ClDialect>) -> HashMap<u32, Record> {
    let text = files::read(path).expect("a CL file");
    let options = reader::Options { dialect, ..reader::Options::default() };
    let mut reader = reader::Reader::new(&text[..], "part.ncl", options);
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    let mut found = HashMap::new();
    while let Ok(true) = reader.read(&mut vocabulary, &mut record) {
        found.insert(record.number, record.clone());
    }
    found
}

#[test]
fn a_map_changes_nothing_and_is_the_same_each_time() {
    let mut count = 0;
    for case in cases() {
        let Some((nc, map)) = mapped(&case) else { continue };
        let (plain, _) = case.run().expect("it was posted with a map");
        assert_eq!(nc, plain, "{}", case.folder.display());
        assert_eq!(mapped(&case).expect("as before").1, map, "{}", case.folder.display());
        count += 1;
    }
    assert!(count > 20, "only {count} cases were posted");
}

#[test]
fn each_line_is_cut_into_its_words() {
    for case in cases() {
        // A line of Klartext is a phrase and not a row of letters with numbers; a SINUMERIK
        // has named addresses and calls.
        let Ok(program) = case.program() else { continue };
        if program.commons().read(locations::CONTROL_FAMILY) != ControlFamily::WordAddress {
            continue;
        }
        let Some((nc, map)) = mapped(&case) else { continue };
        let at = case.folder.display();
        let text = program.nc_page().decode_all(&nc);
        let lines = lines(&map);
        assert_eq!(lines.len(), text.lines().count(), "{at}");
        for (line, text) in lines.iter().zip(text.lines()) {
            let mut end = 0;
            for word in &line.words {
                assert_eq!(word.range.start, end, "{at}: {text}");
                end = word.range.end;
                let shown = word.text(text);
                assert!(!shown.is_empty(), "{at}: {text}: {word:?}");
                if word.letter.is_ascii_uppercase() || word.letter == '#' {
                    let number = shown.get(1..).unwrap_or("").parse::<f64>();
                    assert!(number.is_ok(), "{at}: {text}: {shown} is no word");
                }
            }
            assert_eq!(end, text.len(), "{at}: {text}");
        }
    }
}

#[test]
fn each_cause_is_a_record_of_the_cl_file() {
    for case in cases() {
        let Some((_, map)) = mapped(&case) else { continue };
        let records = records(&case.folder.join(&case.file.cl), case.file.dialect);
        for line in lines(&map) {
            let causes = line.words.iter().map(|word| word.cause).chain([line.cause]);
            for cause in causes.filter(|cause| cause.record != 0) {
                let record = records.get(&cause.record).unwrap_or_else(|| panic!("{cause:?}"));
                assert_eq!(record.line, cause.line, "{}", case.folder.display());
                let there = cause.made_by_fil || usize::from(cause.word) <= record.len();
                assert!(there, "{}: {cause:?}", case.folder.display());
            }
        }
    }
}

/// On a mill that writes coordinates as they are, an axis word that repeats a
/// word of its record has its value.
/// A message that waits for a tool change is made by the statement that gave it, and not by the one
/// that changes the tool.
#[test]
fn a_message_that_has_waited_is_of_its_own_line() {
    let fil = "CIMFIL/ON,LOADTL\n  PPRINT FROM THE MACRO\n  DMY = POSTF(13)\nCIMFIL/OFF\n";
    let post = Program::builder().ready("fanuc-mill").fil("post.fil", fil).build().unwrap();
    let cl = "UNITS/MM\nPPRINT FROM THE FILE\nLOADTL/1\nSPINDL/RPM,900,CLW\nGOHOME\nFINI\n";
    let (mut nc, mut map) = (Vec::new(), Vec::new());
    post.start().run_mapped(Cursor::new(cl), &mut nc, &names(&post), &mut map).unwrap();
    let nc = String::from_utf8(nc).unwrap();
    let mut reader = MapReader::new("part.map", Cursor::new(&map)).unwrap();
    let entries: Vec<Entry> = reader.by_ref().collect::<Result<_, _>>().unwrap();
    let made = |block: &str| {
        let number = 1 + nc.lines().position(|line| line.contains(block)).expect(block) as u64;
        let cause = entries.iter().find_map(|entry| match entry {
            Entry::Line(line) if line.number == number => Some(line.cause),
            _ => None,
        });
        let cause = cause.expect("a line of the map");
        let stack = reader.stack(cause);
        (cause.line, stack.map(|stack| stack.lines[0].line))
    };
    assert_eq!(made("(FROM THE FILE)"), (2, None), "{nc}");
    assert_eq!(made("(FROM THE MACRO)"), (3, Some(2)), "{nc}");
    assert_eq!(made("T1 M6"), (3, Some(3)), "{nc}");
}

#[test]
fn an_axis_word_repeats_the_word_it_names() {
    let mut count = 0;
    let entries = std::fs::read_dir(root().join("tests/cl")).expect("CL files");
    for path in entries.map(|entry| entry.expect("an entry").path()) {
        let post = Program::builder().generic("linuxcnc-mill").build().expect("a post");
        let (mut nc, mut map) = (Vec::new(), Vec::new());
        let cl = Cursor::new(files::read(&path).expect("a CL file"));
        let names = names(&post);
        if post.start().run_mapped(cl, &mut nc, &names, &mut map).is_err() {
            continue;
        }
        let records = records(&path, None);
        let text = String::from_utf8(nc).expect("UTF-8");
        for (line, text) in lines(&map).iter().zip(text.lines()) {
            for word in line.words.iter().filter(|word| ['X', 'Y', 'Z'].contains(&word.letter)) {
                let Some(record) = records.get(&word.cause.record) else { continue };
                let goto = record.point().is_some() && record.sub == motion::GOTO;
                let Some(Word::Number(value)) =
                    record.data_word(word.cause.word.into()).filter(|_| goto)
                else {
                    continue;
                };
                let shown: f64 = word.text(text)[1..].parse().expect("a number");
                assert!((shown - value).abs() < 0.000_6, "{}: {text}: {value}", path.display());
                count += 1;
            }
        }
    }
    assert!(count > 50, "only {count} words");
}

#[test]
fn the_example_of_the_page_is_what_is_written() {
    let folder = root().join("docs/trace");
    let update = std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1");
    let fil = files::read_text(&folder.join("cover.fil"), None).expect("the FIL file");
    let cl = files::read(&folder.join("cover.ncl")).expect("the CL file");
    let post =
        Program::builder().generic("fanuc-mill").fil("cover.fil", &fil).build().expect("a post");
    let (mut nc, mut map) = (Vec::new(), Vec::new());
    let names =
        Names { cl: "cover.ncl".into(), nc: "cover.nc".into(), fil: vec!["cover.fil".into()] };
    post.start().run_mapped(Cursor::new(&cl), &mut nc, &names, &mut map).expect("it is posted");
    for (name, fresh) in [("cover.nc", &nc), ("cover.nc.map", &map)] {
        let path = folder.join(name);
        if update {
            std::fs::write(&path, fresh).expect("the file is written");
        }
        assert_eq!(&files::read(&path).expect("the file"), fresh, "{name}");
    }
    let reader = MapReader::new("cover.nc.map", Cursor::new(&map)).expect("a map");
    assert_eq!(reader.cl().digest, Digest::of(&cl));
    assert_eq!(reader.nc().digest, Digest::of(&nc));
    assert_eq!(reader.fil()[0].digest, Digest::of(fil.as_bytes()));
}

/// Reads all that a map gives; what is wrong is an error, never a panic.
fn read_all(map: &[u8]) -> Result<usize, Error> {
    let reader = MapReader::new("part.map", Cursor::new(map))?;
    reader.collect::<Result<Vec<_>, _>>().map(|entries| entries.len())
}

fn example() -> Vec<u8> {
    files::read(&root().join("docs/trace/cover.nc.map")).expect("the map")
}

#[test]
fn a_map_that_was_cut_off_is_refused_wherever_it_was_cut() {
    let map = example();
    for end in 0..map.len() - 1 {
        let error = read_all(&map[..end]).expect_err("it is not whole");
        assert_eq!(error.diags()[0].code.name(), "E0707", "{end}");
    }
    let lines: Vec<&[u8]> = map.split_inclusive(|byte| *byte == b'\n').collect();
    for left_out in 0..lines.len() {
        let rest: Vec<u8> = [&lines[..left_out], &lines[left_out + 1..]].concat().concat();
        assert!(read_all(&rest).is_err(), "without line {}", left_out + 1);
    }
}

/// A map whose lines say something else, with a last line that agrees with them.
fn sealed(map: &[u8]) -> Vec<u8> {
    let text = map.strip_suffix(b"\n").unwrap_or(map);
    let start = text.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    let lines = &map[..start];
    let Ok(mut last) = serde_json::from_slice::<serde_json::Value>(&map[start..]) else {
        return map.to_vec();
    };
    last["map"] = serde_json::to_value(Digest::of(lines)).expect("numbers and texts");
    [lines, last.to_string().as_bytes(), b"\n"].concat()
}

#[test]
fn a_map_that_was_edited_is_refused_wherever_it_was_edited() {
    let map = example();
    let last = map[..map.len() - 1].iter().rposition(|byte| *byte == b'\n').expect("lines") + 1;
    for at in 0..last {
        let mut edited = map.clone();
        edited[at] = if edited[at] == b'1' { b'2' } else { b'1' };
        let error = read_all(&edited).expect_err("it was edited");
        assert_eq!(error.diags()[0].code.name(), "E0707", "{at}");
    }
    let map = String::from_utf8(map).expect("text");
    let moved = map.replacen("[1,1,", "[2,1,", 1);
    let error = read_all(moved.as_bytes()).expect_err("it was edited");
    assert!(error.diags()[0].message.starts_with("the map was edited"), "{error}");
    assert!(read_all(&sealed(moved.as_bytes())).is_ok(), "the same with a hash that agrees");
}

/// A form that was not written out, a place before the first line of the CL file, and
/// what is no line of a map are refused where they stand.
#[test]
fn lines_that_tell_nothing_are_refused() {
    let map = String::from_utf8(example()).expect("text");
    let at = map.lines().position(|line| line == "12").expect("a form is repeated");
    for (line, said) in [
        ("99", "this line does not fit the lines before it"),
        ("0", "this line does not fit the lines before it"),
        ("[-99,0,\"#5 X4:6\"]", "this is no line of a line map"),
        ("12.5", "this is no line of a line map"),
    ] {
        let broken = map.replacen("\n12\n", &format!("\n{line}\n"), 1);
        let error = read_all(&sealed(broken.as_bytes())).expect_err(line);
        let diag = &error.diags()[0];
        assert_eq!((diag.code.name().as_str(), diag.message.as_str()), ("E0707", said), "{line}");
        assert_eq!(diag.spans[0].line as usize, at + 1, "{line}");
    }
}

proptest! {
    #[test]
    fn no_bytes_are_too_strange(bytes: Vec<u8>) {
        prop_assert!(read_all(&bytes).is_err());
    }

    #[test]
    fn no_change_to_a_map_is_too_strange(at in 0usize..2000, byte: u8, more: bool) {
        let mut map = example();
        let at = at % map.len();
        if more { map.insert(at, byte) } else { map[at] = byte }
        let _ = read_all(&map);
        let _ = read_all(&sealed(&map));
    }
}
