//! NURBS, KNOT and CNTRL of NX.

use fil_cl::{ClCode, ClDialect, Options, Reader, Record, SplineCounts, Vocabulary, words};
use fil_diag::{Code, Diag};

fn read(text: &str) -> Result<(Vec<Record>, SplineCounts), Box<Diag>> {
    let options = Options { dialect: Some(ClDialect::Nx), ..Options::default() };
    let mut reader = Reader::new(text.as_bytes(), "t", options);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut records = Vec::new();
    while reader.read(&mut vocab, &mut record)? {
        records.push(record.clone());
    }
    Ok((records, reader.splines()))
}

fn refused(text: &str, code: ClCode, line: u32) -> String {
    let diag = read(text).expect_err("refused");
    let code: &Code = code.into();
    assert_eq!((diag.code, diag.spans[0].line), (code, line), "{text}: {diag}");
    diag.message.clone()
}

/// A quarter of a turn as a cubic, from 10,0 to 0,10.
const QUARTER: &str = "\
GOTO/10.0000,0.0000,5.0000
NURBS/
KNOT/0.0,0.0,0.0,0.0
KNOT/1.0,1.0,1.0,1.0
CNTRL/10.0000,0.0000,5.0000
CNTRL/10.0000,5.5228,5.0000
CNTRL/5.5228,10.0000,5.0000
CNTRL/0.0000,10.0000,5.0000
GOTO/0.0000,20.0000,5.0000
";

#[test]
fn a_spline_becomes_lines() {
    let (records, counts) = read(QUARTER).unwrap();
    let points: Vec<[f64; 3]> = records.iter().map(|record| record.point().unwrap()).collect();
    assert_eq!((counts.splines, counts.tolerance), (1, 1e-4));
    assert_eq!(counts.lines as usize, points.len() - 3);
    assert_eq!(points[1], [10.0, 0.0, 5.0]);
    assert_eq!(points[points.len() - 2], [0.0, 10.0, 5.0]);
    // The cubic leaves the circle by 0.003 at most, and the points lie on the cubic.
    for [x, y, z] in &points[1..points.len() - 1] {
        assert!((libm::hypot(*x, *y) - 10.0).abs() < 0.004 && *z == 5.0, "{x} {y} {z}");
    }
    assert!(records[1..records.len() - 1].iter().all(|record| record.line == 2));
    let numbers: Vec<u32> = records.iter().map(|record| record.number).collect();
    assert!(numbers.iter().zip(1..).all(|(found, expected)| *found == expected));
}

#[test]
fn the_file_names_the_tolerance() {
    let lines = |head: &str| {
        let (records, counts) = read(&format!("{head}{QUARTER}")).unwrap();
        assert_eq!(
            records.iter().filter(|record| record.major == words::GOTO).count(),
            counts.lines as usize + 3
        );
        (counts.tolerance, counts.lines)
    };
    let fine = lines("");
    let usual = lines("UNITS/MM\n");
    let coarse = lines("INTOL/0.05\nOUTTOL/0.02\n");
    assert_eq!((fine.0, usual.0, coarse.0), (1e-4, 1e-3, 0.02));
    assert!(fine.1 > usual.1 && usual.1 > coarse.1, "{fine:?} {usual:?} {coarse:?}");
    assert_eq!(lines("INTOL/0.0\nOUTTOL/0.02\n"), coarse);
    // The last one counts, as often as it comes.
    assert_eq!(lines("INTOL/0.02\nINTOL/0.5\nINTOL/0.02\n"), coarse);
}

/// A rapid before the spline is rapid to its begin and no farther.
#[test]
fn the_begin_is_a_motion_of_its_own() {
    let text = QUARTER.replace("NURBS", "RAPID\nNURBS");
    let (records, _) = read(&text).unwrap();
    assert_eq!(records[1].major, words::RAPID);
    assert_eq!(records[2].point(), records[0].point());
}

#[test]
fn the_tool_axis_is_the_last_one() {
    let text = QUARTER.replacen("5.0000\n", "5.0000,0.0,1.0,0.0\n", 1);
    let (records, _) = read(&text).unwrap();
    assert!(records.iter().all(|record| record.axis() == Some([0.0, 1.0, 0.0])));
}

#[test]
fn numbers_of_nurbs_must_agree() {
    for numbers in ["3", "4", "4,8", "3,4,8"] {
        assert!(read(&QUARTER.replace("NURBS/", &format!("NURBS/{numbers}"))).is_ok(), "{numbers}");
    }
    for numbers in ["2", "4,9", "3.5", "-3"] {
        let text = QUARTER.replace("NURBS/", &format!("NURBS/{numbers}"));
        let message = refused(&text, ClCode::BadSpline, 5);
        assert!(message.contains("4 control points and degree 3"), "{message}");
    }
    refused(&QUARTER.replace("NURBS/", "NURBS/CLOSED"), ClCode::BadSpline, 2);
}

#[test]
fn splines_that_are_not_whole() {
    let without = |line: &str| QUARTER.replacen(&format!("{line}\n"), "", 1);
    // A knot list or control point that is missing.
    refused(&without("KNOT/1.0,1.0,1.0,1.0"), ClCode::BadSpline, 4);
    refused(&without("CNTRL/5.5228,10.0000,5.0000"), ClCode::MissingItem, 8);
    refused(&without("CNTRL/10.0000,0.0000,5.0000"), ClCode::BadSpline, 5);
    refused(&without("NURBS/"), ClCode::BadSpline, 2);
    let cut: String = QUARTER.split_inclusive('\n').take(6).collect();
    assert!(read(&cut).is_err(), "the end of the file");
    // One too many.
    let twice = QUARTER.replace("GOTO/0.0000,20", "CNTRL/0.0,30.0,5.0\nGOTO/0.0000,20");
    refused(&twice, ClCode::BadSpline, 9);
    let late = QUARTER.replace("CNTRL/5.5228", "KNOT/2.0\nCNTRL/5.5228");
    refused(&late, ClCode::BadSpline, 7);
    for (from, to) in [
        ("KNOT/0.0,0.0,0.0,0.0", "KNOT/0.0,0.0,0.5,0.0"),
        ("KNOT/0.0,0.0,0.0,0.0", "KNOT/0.0,0.0,0.0"),
        ("KNOT/1.0,1.0,1.0,1.0", "KNOT/1.0,2.0,3.0,4.0"),
        ("KNOT/1.0,1.0,1.0,1.0", "KNOT/0.0,0.0,0.0,0.0"),
        ("CNTRL/10.0000,0.0000,5.0000", "CNTRL/10.0000,0.0100,5.0000"),
        ("CNTRL/10.0000,0.0000,5.0000", "CNTRL/10.0000,0.0000"),
        ("CNTRL/10.0000,0.0000,5.0000", "CNTRL/10.0000,0.0000,5.0000,0.0,1.0,0.0"),
        ("CNTRL/10.0000,0.0000,5.0000", "CNTRL/10.0000,0.0000,5.0000,0.0,0.0,1.1"),
        ("CNTRL/10.0000,0.0000,5.0000", "CNTRL/10.0000,0.0000,5.0000,0.0"),
        ("CNTRL/10.0000,0.0000,5.0000", "CNTRL/10.0000,0.0000,5.0000,0.0,1.0"),
    ] {
        refused(&QUARTER.replacen(from, to, 1), ClCode::BadSpline, 5);
    }
    let weights = QUARTER.replace("CNTRL/5.5228,10.0000,5.0000", "CNTRL/5.5228,10.0000,5.0000,1.0");
    assert!(read(&weights).is_ok(), "weights of 1 change nothing");
    refused(
        &QUARTER.replace("NURBS/", "CIRCLE/0,0,5,0,0,-1,10,.1,.1,1,0\nNURBS/"),
        ClCode::BadSpline,
        3,
    );
    refused(&QUARTER.replace("GOTO/10.0000,0.0000,5.0000\n", ""), ClCode::BadSpline, 4);
}

/// The quarter with something behind the coordinates of each control point.
fn with_behind(behind: [&str; 4]) -> String {
    let mut behind = behind.iter();
    let lines = QUARTER.lines().map(|line| match line.starts_with("CNTRL/") {
        true => format!("{line}{}\n", behind.next().unwrap()),
        false => format!("{line}\n"),
    });
    lines.collect()
}

fn points(text: &str) -> Vec<[f64; 3]> {
    read(text).unwrap().0.iter().map(|record| record.point().unwrap()).collect()
}

/// Weights that are all the same cancel out, where the first point shows that they do not
/// multiply the coordinates.
#[test]
fn weights_that_change_nothing() {
    for weights in [[",1.0"; 4], [",0.7071"; 4], [",1.0", "", ",1.", ""]] {
        assert_eq!(points(&with_behind(weights)), points(QUARTER), "{weights:?}");
    }
    let message = refused(&with_behind([",1.0", ",0.7071", ",1.0", ",1.0"]), ClCode::BadSpline, 6);
    assert!(message.contains("another weight"), "{message}");
    refused(&with_behind([",0.5", "", "", ""]), ClCode::BadSpline, 6);
    // The coordinates are multiplied: the tool stands elsewhere.
    let scaled = with_behind([",2.0"; 4]).replace("GOTO/10.0000,0.0000", "GOTO/5.0000,0.0000");
    refused(&scaled, ClCode::BadSpline, 5);
    // A spline that begins at the origin does not tell.
    let moved = "GOTO/0.,0.,0.\nNURBS/\nKNOT/0.,0.,1.,1.\nCNTRL/0.,0.,0.,2.\nCNTRL/3.,0.,0.,2.\n";
    let message = refused(moved, ClCode::BadSpline, 4);
    assert!(message.contains("multiplies"), "{message}");
}

/// One tool axis for the whole spline is that of its lines, where the tool has it already.
#[test]
fn a_tool_axis_of_the_whole_spline() {
    let upright = [",0.0000000,0.0000000,1.0000000"; 4];
    assert_eq!(points(&with_behind(upright)), points(QUARTER));
    let (records, _) = read(&with_behind(upright)).unwrap();
    assert!(records[1..].iter().all(|record| record.axis() == Some([0.0, 0.0, 1.0])));
    let tilted = with_behind([",0.0,0.6,0.8"; 4]);
    let message = refused(&tilted, ClCode::BadSpline, 5);
    assert!(message.contains("another tool axis than the tool has"), "{message}");
    let tilted = tilted.replacen("5.0000\n", "5.0000,0.0,0.6,0.8\n", 1);
    let (records, _) = read(&tilted).unwrap();
    assert!(records.iter().all(|record| record.axis() == Some([0.0, 0.6, 0.8])));
    let mut changing = upright;
    changing[2] = ",0.0,0.6,0.8";
    let message = refused(&with_behind(changing), ClCode::BadSpline, 7);
    assert!(message.contains("between control points"), "{message}");
    changing[2] = "";
    refused(&with_behind(changing), ClCode::BadSpline, 7);
}

#[test]
fn nothing_comes_between() {
    for between in ["FEDRAT/MMPM,100.0\n", "RAPID\n", "PAINT/COLOR,2\n", "PPRINT/X\n"] {
        let text = QUARTER.replace("CNTRL/5.5228", &format!("{between}CNTRL/5.5228"));
        let message = refused(&text, ClCode::BadSpline, 8);
        assert!(message.contains("line 2"), "{message}");
    }
    let motion = QUARTER.replace("CNTRL/5.5228", "GOTO/1.0,1.0,1.0\nCNTRL/5.5228");
    refused(&motion, ClCode::MissingItem, 7);
}

/// Going back gives the same records, and counts no spline twice.
#[test]
fn going_back() {
    let text = format!("UNITS/MM\n{QUARTER}").repeat(3);
    let options = Options { dialect: Some(ClDialect::Nx), ..Options::default() };
    let mut reader = Reader::seekable(std::io::Cursor::new(&text), "t", options);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut records = Vec::new();
    while reader.read(&mut vocab, &mut record).unwrap() {
        records.push(record.clone());
    }
    let counts = reader.splines();
    assert_eq!(counts.splines, 3);
    for number in [6, 3, records.len()] {
        reader.seek_record(number as u32).unwrap();
        assert!(reader.read(&mut vocab, &mut record).unwrap());
        assert_eq!(record, records[number - 1]);
    }
    assert_eq!(reader.splines(), counts);
}

/// Other dialects do not know the form.
#[test]
fn splines_of_nx_alone() {
    for dialect in ClDialect::ALL.iter().filter(|dialect| **dialect != ClDialect::Nx) {
        let options = Options { dialect: Some(*dialect), ..Options::default() };
        let mut reader = Reader::new(QUARTER.as_bytes(), "t", options);
        let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
        assert!(reader.read(&mut vocab, &mut record).unwrap());
        let diag = reader.read(&mut vocab, &mut record).unwrap_err();
        assert_eq!(diag.code.number, 408, "{dialect}");
    }
}
