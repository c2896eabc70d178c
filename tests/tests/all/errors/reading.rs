//! Codes of CL texts: reading, going back, units and dialects.

use std::io::{self, Cursor, Read};

use filpost::{CancelToken, Limits, Program, Unit};
use filpost_tests::examples::PART;

use super::{names, posting};

#[test]
fn e0711_cancelled() {
    let token = CancelToken::new();
    token.cancel();
    let post = Program::builder().build().expect("the generic mill");
    let error =
        post.start().cancel(&token).stream(PART.as_bytes(), Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0711"]);
}

#[test]
fn e0712_record_from_memory() {
    let post = Program::builder().build().expect("the generic mill");
    let record = fil_cl::Record::goto([f64::NAN; 3], None);
    let error = post.stream_records(post.vocabulary(), [record], Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0712"]);
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
    let error = post.stream(input, &mut Vec::new()).expect_err("refused");
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
    let error = post.stream(cl.as_bytes(), &mut Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0409"]);
    assert!(post.stream_seekable(Cursor::new(cl), &mut Vec::new()).is_ok());
}

#[test]
fn a_section_that_always_goes_back_is_stopped() {
    let fil = "CIMFIL/ON,COOLNT\nDMY=POSTF(15)\nCIMFIL/OFF\nFINI\n";
    let limits = Limits { fuel: 10_000, ..Limits::default() };
    let post = Program::builder().fil("t.fil", fil).limits(limits).build().expect("a post");
    let cl = Cursor::new("RAPID\nCOOLNT / ON\nFINI\n");
    let error = post.stream_seekable(cl, &mut Vec::new()).expect_err("refused");
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
        program.start().units(unit).stream(cl.as_bytes(), Vec::new()).map_err(|error| names(&error))
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
        let ran = post.start().cl_options(reading).stream(cl.as_bytes(), &mut nc);
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
fn w0757_choice_against_the_signs() {
    let mill = Program::builder().generic("fanuc-mill").build().expect("a ready post");
    let text =
        "TOOL PATH/ROUGH,TOOL,MILL_10\nUNITS/MM\nFEDRAT/100.0,MMPM\nGOTO/1.0,2.0,3.0\nFINI\n";
    let post = |dialect| {
        let options = filpost::cl::Options { dialect, ..Default::default() };
        let mut nc = Vec::new();
        mill.start()
            .cl_options(options)
            .stream(text.as_bytes(), &mut nc)
            .expect("it is posted")
            .warnings
    };
    let chosen = post(Some(filpost::cl::ClDialect::Creo));
    let codes: Vec<String> = chosen.iter().map(|diag| diag.code.name()).collect();
    assert_eq!((codes, chosen[0].spans[0].line), (vec!["W0757".to_string()], 1));
    assert!(post(None).is_empty());
}

#[test]
fn e0724_tool_change_is_no_program() {
    let cl = "LOADTL / 1\nSPINDL / 900, RPM, CLW\nLOADTL / 2\nGOTO / 4, 2, 3\n";
    let options = filpost::cl::reader::Options::default();
    let changes = filpost::tool_files::changes(cl.as_bytes(), "part.ncl", options).unwrap();
    let write = |number| {
        let text = std::io::Cursor::new(cl.as_bytes());
        changes.write_one(number, text, "part.ncl", options, std::io::Cursor::new(Vec::new()))
    };
    assert!(write(0).is_ok());
    assert_eq!(write(1).unwrap_err().code.name(), "E0724");
}
