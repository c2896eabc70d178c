//! No dialect reads the file of another as another path in silence, and arcs that turn the
//! wrong way are noticed.

use std::fs;
use std::path::{Path, PathBuf};

use fil_cl::record::kind;
use fil_cl::{ClCode, ClDialect, Options, Reader, Recognized, Record, Vocabulary, Writer, words};
use fil_diag::Diag;
use filpost::{Error, Program, Report};

/// CL files of many systems; none, with the reason printed, where they are absent.
fn real_files() -> Vec<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let data =
        std::env::var_os("FILPOST_DATA").map_or(here.join("../../shared/data"), PathBuf::from);
    let mut files = Vec::new();
    for folder in ["cl", "cl-more"] {
        let Ok(systems) = fs::read_dir(data.join(folder)) else {
            println!("skipped: no folder {}", data.join(folder).display());
            continue;
        };
        for system in systems.map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()) {
            files.extend(fs::read_dir(system).unwrap().map(|entry| entry.unwrap().path()));
        }
    }
    files.sort();
    files
}

struct Reading {
    records: Vec<Record>,
    vocabulary: Vocabulary,
    found: Recognized,
}

fn read(text: &[u8], dialect: Option<ClDialect>) -> Result<Reading, Box<Diag>> {
    let options = Options { dialect, ..Options::default() };
    let mut reader = Reader::new(text, "part.cl", options);
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    let mut records = Vec::new();
    while reader.read(&mut vocabulary, &mut record)? {
        records.push(record.clone());
    }
    Ok(Reading { records, vocabulary, found: reader.recognized() })
}

/// What the machine would do: all records but those without effect, as statements.
fn acts(reading: &Reading) -> Vec<String> {
    let statements = reading.records.iter().filter(|record| !record.inert).map(|record| {
        let mut writer = Writer::new(Vec::new());
        // What has no text form is compared as it is.
        match writer.write(&Record { number: 0, line: 0, ..record.clone() }, &reading.vocabulary) {
            Ok(()) => String::from_utf8_lossy(&writer.into_inner()).into_owned(),
            Err(_) => format!("{:?}", record.data),
        }
    });
    statements.collect()
}

/// Each real file with the rules of each dialect: refused, the same, or with a warning that
/// the file is another system's.
#[test]
fn each_file_with_the_rules_of_each_dialect() {
    let (mut refused, mut same, mut warned) = (0, 0, 0);
    for path in real_files() {
        let text = fs::read(&path).unwrap();
        let Ok(own) = read(&text, None) else { continue };
        let expected = acts(&own);
        for dialect in ClDialect::ALL.iter().filter(|dialect| **dialect != own.found.dialect) {
            let Ok(other) = read(&text, Some(*dialect)) else {
                refused += 1;
                continue;
            };
            if other.found.against.is_some() {
                warned += 1;
            } else {
                assert!(
                    acts(&other) == expected,
                    "{} as {dialect} is another path in silence",
                    path.display()
                );
                same += 1;
            }
        }
    }
    println!("{refused} refused, {same} the same, {warned} with a warning");
}

/// Reads arcs by the opposite rule.
fn turned(records: &[Record]) -> Vec<Record> {
    let turn = |record: &Record| {
        let mut record = record.clone();
        if let Some(mut circle) = record.circle() {
            circle.axis = circle.axis.map(|part| 0.0 - part);
            let mut data = Record::arc(circle).data;
            data.extend_from_slice(&record.data[data.len().min(record.data.len())..]);
            record.data = data;
        }
        record
    };
    records.iter().map(turn).collect()
}

/// The motions, arcs, rapids and feeds of a file, as a generic CL file for a mill.
fn motions(records: &[Record], vocabulary: &Vocabulary) -> String {
    let mut writer = Writer::new(Vec::new());
    let mut text = String::from("UNITS / MM\nFEDRAT / 100, MMPM\n");
    for record in records {
        let is_motion = matches!(record.kind, kind::MOTION | kind::SURFACE);
        if is_motion || record.major == words::RAPID {
            let flat = match record.point() {
                // Tool axes are not what is judged here.
                Some(point) => Record::goto(point, None),
                None => record.clone(),
            };
            writer.write(&flat, vocabulary).unwrap();
        }
    }
    text.push_str(&String::from_utf8(writer.into_inner()).unwrap());
    text + "FINI\n"
}

/// The program, and what was said of it.
fn post(text: &str, dialect: Option<ClDialect>) -> Result<(String, Report), Error> {
    let program = Program::builder().generic("linuxcnc-mill").build()?;
    let mut nc = Vec::new();
    let reading = Options { dialect, ..Options::default() };
    let report = program.start().cl_options(reading).stream(text.as_bytes(), &mut nc)?;
    Ok((String::from_utf8(nc).unwrap(), report))
}

fn codes(result: &Result<(String, Report), Error>) -> Vec<u16> {
    let diags = match result {
        Ok((_, report)) => &report.warnings,
        Err(error) => error.diags(),
    };
    diags.iter().map(|diag| diag.code.number).collect()
}

const SENSE: u16 = 523;
const UNPROVED: u16 = 556;
const OTHER_SIGNS: u16 = 757;

/// The arcs of real files are taken as they are, without a word; turned round, all of those
/// files are refused or warned of.
#[test]
fn real_arcs_turned_round_are_noticed() {
    let (mut refused, mut warned) = (0, 0);
    for path in real_files() {
        let name = path.display();
        let Ok(own) = read(&fs::read(&path).unwrap(), None) else { continue };
        if !own.records.iter().any(|record| record.circle().is_some()) {
            continue;
        }
        let right = codes(&post(&motions(&own.records, &own.vocabulary), None));
        assert!(!right.contains(&SENSE) && !right.contains(&UNPROVED), "{name}: {right:?}");
        let wrong = post(&motions(&turned(&own.records), &own.vocabulary), None);
        let found = codes(&wrong);
        let is_refused = found.contains(&SENSE);
        assert!(is_refused || found.contains(&UNPROVED), "{name} turned round: {found:?}");
        if is_refused {
            refused += 1;
        } else {
            warned += 1;
            println!("{name} is only warned of");
        }
    }
    println!("{refused} refused, {warned} with a warning");
}

/// A pocket whose corners are arcs, run from the middle of a side: all arcs are quarters.
fn pocket(axis: f64) -> String {
    let mut text = String::from("UNITS / MM\nFEDRAT / 100, MMPM\nGOTO / 0, -20, 0\n");
    let corners: [[f64; 2]; 4] = [[15.0, -15.0], [15.0, 15.0], [-15.0, 15.0], [-15.0, -15.0]];
    for (at, [x, y]) in corners.into_iter().enumerate() {
        let (start, end) = match at % 2 {
            0 => ([x, y + y.signum() * 5.0], [x + x.signum() * 5.0, y]),
            _ => ([x + x.signum() * 5.0, y], [x, y + y.signum() * 5.0]),
        };
        text.push_str(&format!(
            "GOTO / {}, {}, 0\nCIRCLE / {x}, {y}, 0, 0, 0, {axis}, 5\nGOTO / {}, {}, 0\n",
            start[0], start[1], end[0], end[1]
        ));
    }
    text + "GOTO / 0, -20, 0\nFINI\n"
}

/// The message names the dialect that fits, and that dialect makes the right program.
#[test]
fn the_dialect_that_fits_is_named() {
    let right = post(&pocket(1.0), None).unwrap();
    assert!(codes(&Ok(right.clone())).is_empty());
    let Err(error) = post(&pocket(-1.0), None) else { panic!("refused") };
    let diag = &error.diags()[0];
    assert_eq!(diag.code.number, SENSE);
    let hint = diag.hint.clone().unwrap();
    assert!(hint.contains("--dialect generic-left"), "{hint}");
    let chosen = post(&pocket(-1.0), Some(ClDialect::GenericLeft)).unwrap();
    assert_eq!(chosen.0, right.0);
    // And the other way round.
    let Err(error) = post(&pocket(1.0), Some(ClDialect::GenericLeft)) else { panic!("refused") };
    let hint = error.diags()[0].hint.clone().unwrap();
    assert!(hint.contains("--dialect generic or --dialect creo"), "{hint}");
    // A choice does not settle what the arcs contradict, and the hint does not say so.
    for (axis, dialect) in [(-1.0, ClDialect::Generic), (1.0, ClDialect::GenericLeft)] {
        let Err(error) = post(&pocket(axis), Some(dialect)) else { panic!("refused") };
        let hint = error.diags()[0].hint.clone().unwrap();
        assert!(!hint.contains(&format!("--dialect {dialect} says")), "{hint}");
        assert!(hint.contains("as lines"), "{hint}");
    }
}

/// Sectors of a circle, out from the center and back: nothing proves their sense.
fn sectors(count: usize) -> String {
    let mut text = String::from("UNITS / MM\nFEDRAT / 100, MMPM\n");
    for at in 0..count {
        let x = 100.0 * at as f64;
        text.push_str(&format!(
            "RAPID\nGOTO / {x}, 0, 0\nGOTO / {}, 0, 0\nCIRCLE / {x}, 0, 0, 0, 0, 1, 10\n\
             GOTO / {x}, -10, 0\nGOTO / {x}, 0, 0\n",
            x + 10.0
        ));
    }
    text + "FINI\n"
}

/// What nothing proves is warned of; many such arcs and no other need the dialect chosen.
#[test]
fn long_arcs_at_corners() {
    assert_eq!(codes(&post(&sectors(1), None)), [UNPROVED]);
    let Err(error) = post(&sectors(4), None) else { panic!("refused") };
    let diag = &error.diags()[0];
    assert_eq!(diag.code.number, SENSE);
    let hint = diag.hint.clone().unwrap();
    assert!(hint.contains("--dialect generic says"), "{hint}");
    assert_eq!(codes(&post(&sectors(4), Some(ClDialect::Generic))), [UNPROVED]);
}

/// A half circle over a dome beside which the tool comes down could as well be one through a bowl: a
/// dialect that was chosen settles that.
#[test]
fn an_arc_against_a_plunge() {
    let dome = "UNITS / MM\nFEDRAT / 100, MMPM\nGOTO / 0, 0, 100\nGOTO / 0, 0, 10\n\
                CIRCLE / 10, 0, 10, 0, 1, 0, 10\nGOTO / 20, 0, 10\nFINI\n";
    assert_eq!(codes(&post(dome, None)), [UNPROVED]);
    assert!(codes(&post(dome, Some(ClDialect::Generic))).is_empty());
}

#[test]
fn a_choice_against_the_signs_is_warned_of() {
    let text = "TOOL PATH/A,TOOL,B\nUNITS/MM\nFEDRAT/100,MMPM\nGOTO/1,2,3\nFINI\n";
    assert!(codes(&post(text, None)).is_empty());
    assert!(codes(&post(text, Some(ClDialect::Nx))).is_empty());
    assert_eq!(codes(&post(text, Some(ClDialect::Creo))), [OTHER_SIGNS]);
    let code: &fil_diag::Code = ClCode::TwoDialects.into();
    let two = format!("$$-> END /\n{text}");
    assert_eq!(codes(&post(&two, None)), [code.number]);
    assert_eq!(codes(&post(&two, Some(ClDialect::Nx))), [OTHER_SIGNS]);
}
