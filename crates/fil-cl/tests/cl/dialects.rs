//! How a dialect is recognized, and what it changes.

use fil_cl::{ClCode, ClDialect, Evidence, Options, Reader, Record, Vocabulary, Word, words};
use fil_diag::{Code, Diag};

/// All records, and the dialect found with its evidence.
fn read(text: &str, dialect: Option<ClDialect>) -> Result<(Vec<Record>, String), Box<Diag>> {
    let options = Options { dialect, ..Options::default() };
    let mut reader = Reader::new(text.as_bytes(), "t", options);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut records = Vec::new();
    while reader.read(&mut vocab, &mut record)? {
        records.push(record.clone());
    }
    Ok((records, reader.recognized().to_string()))
}

fn records(text: &str, dialect: ClDialect) -> Vec<Record> {
    read(text, Some(dialect)).unwrap_or_else(|diag| panic!("{dialect}: {diag}")).0
}

fn recognized(text: &str) -> String {
    read(text, None).unwrap_or_else(|diag| panic!("{diag}")).1
}

fn refused(text: &str, dialect: Option<ClDialect>, code: ClCode) -> Box<Diag> {
    let diag = read(text, dialect).expect_err("refused");
    let code: &Code = code.into();
    assert_eq!(diag.code, code, "{text:?}: {diag}");
    diag
}

const SIGNS: [(&str, &str); 12] = [
    ("$$*          Pro/CLfile  Version 8.0 - 8.0.3.0\n", "creo (told by line 1)"),
    ("$$-> FEATNO / 32\n", "creo (told by line 1)"),
    ("TOOL PATH/A,TOOL,B\n", "nx (told by line 1)"),
    ("PAINT/PATH\n", "nx (told by line 1)"),
    ("$$     CATIA APT VERSION 1.0\n", "catia (told by line 1)"),
    ("$$*CATIA0\n", "catia (told by line 1)"),
    ("CATMAT/1.,0.,part\n", "catia (told by line 1)"),
    ("CSI_SET_FLUTE_LENGTH/2.\n", "solidworks-cam (told by line 1)"),
    ("OPFEATSTART/Drill1-Hole1\n", "camworks (told by line 1)"),
    ("PPRINT/APTCL-SPEC,MAKINO-FF,1\n", "ffcam (told by line 1)"),
    ("REMARK a.as 27-APR-2021 NCLCAM 2020.00\n", "ncl (told by line 1)"),
    ("PARTNO / X\nUNITS / MM\n", "generic (no CAM system recognized)"),
];

#[test]
fn signs() {
    for (sign, expected) in SIGNS {
        assert_eq!(recognized(sign), expected, "{sign}");
    }
}

/// Case, blanks, tabs, byte order marks and line ends are no part of a sign.
#[test]
fn layout_turns_no_sign() {
    for (sign, expected) in SIGNS {
        for changed in [
            sign.to_lowercase(),
            format!("  {sign}"),
            format!("\t{sign}"),
            format!("\u{FEFF}{sign}"),
            sign.replace('\n', "  \r\n"),
            sign.replace('/', " / "),
            sign.replace(' ', "   "),
        ] {
            assert_eq!(recognized(&changed), expected, "{changed:?}");
        }
    }
}

/// However long the header, the first sign counts.
#[test]
fn comments_turn_no_sign() {
    let header = "$$ a shop's header, and PAINT/PATH in it\n".repeat(2000);
    for (sign, expected) in SIGNS {
        let text = format!("{header}{sign}");
        let expected = expected.replace("line 1", "line 2001");
        assert_eq!(recognized(&text), expected, "{sign}");
    }
    let blank = "\n".repeat(20_000);
    assert_eq!(recognized(&format!("{blank}END-OF-PATH\n")), "nx (told by line 20001)");
}

#[test]
fn words_in_texts_and_items_are_no_signs() {
    for text in [
        "PPRINT / TOOL PATH/A\n",
        "PPRINT / $$-> FEATNO / 1\n",
        "PARTNO / PAINT/PATH\n",
        "REMARK not by NCLCAMX\n",
        "$$ written for a CATIA APT VERSION 1.0\n",
        "$$ PAINT/PATH\n",
        "CYCLE / DRILL, PAINT, 1.\n",
    ] {
        assert_eq!(recognized(text), "generic (no CAM system recognized)", "{text}");
    }
}

#[test]
fn a_sign_may_come_late_as_long_as_nothing_hangs_on_it() {
    let late = "UNITS/MM\nGOTO/1,2,3\nPAINT/PATH\nCIRCLE/0,0,3,0,0,-1,1,.06,.5,40,1\nGOTO/0,1,3\n";
    let (records, found) = read(late, None).unwrap();
    assert_eq!(found, "nx (told by line 3)");
    assert_eq!(records[3].circle().unwrap().axis, [0.0, 0.0, 1.0]);
    // The right-hand rule held for the arc before, and holds in Creo's files.
    let creo = "GOTO/1,0,0\nCIRCLE/0,0,0,0,0,1,1\nGOTO/0,1,0\n$$-> END /\n";
    assert_eq!(recognized(creo), "creo (told by line 4)");
}

#[test]
fn two_systems_in_one_text() {
    let diag = refused("$$-> END /\nPAINT/PATH\n", None, ClCode::TwoDialects);
    let lines: Vec<u32> = diag.spans.iter().map(|place| place.line).collect();
    assert_eq!(lines, [2, 1]);
    assert!(diag.hint.as_ref().unwrap().contains("--dialect nx"), "{diag:?}");
    let text = "$$*CATIA0\nRAPID\nTRNTYP/WORLD,0,0,0\n";
    refused(text, None, ClCode::TwoDialects);
    let (_, found) = read(text, Some(ClDialect::Generic)).unwrap();
    assert_eq!(found, "generic (chosen)");
    let arc = "GOTO/1,0,0\nCIRCLE/0,0,0,0,0,1,1\nGOTO/0,1,0\nPAINT/PATH\n";
    let diag = refused(arc, None, ClCode::TwoDialects);
    assert_eq!((diag.spans[0].line, diag.spans.len()), (4, 1));
    let axis = "GOTO/1,0,0,0,1,0\nGOTO/0,1,0\nPAINT/PATH\n";
    refused(axis, None, ClCode::TwoDialects);
}

#[test]
fn evidence_is_data() {
    let mut reader = Reader::new(&b"RAPID\nPAINT/PATH\n"[..], "t", Options::default());
    assert_eq!(reader.recognized().evidence, Evidence::NoSign);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    while reader.read(&mut vocab, &mut record).unwrap() {}
    assert_eq!(reader.recognized().dialect, ClDialect::Nx);
    assert_eq!(reader.recognized().evidence, Evidence::Sign { line: 2 });
}

/// Going back re-reads by the rules that were found, and finds no contradiction.
#[test]
fn going_back_keeps_the_dialect() {
    let text = "PAINT/PATH\nGOTO/1,0,0,0,1,0\nGOTO/2,0,0\nPAINT/PATH\n";
    let input = std::io::Cursor::new(text);
    let mut reader = Reader::seekable(input, "t", Options::default());
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    while reader.read(&mut vocab, &mut record).unwrap() {}
    reader.seek_record(3).unwrap();
    assert!(reader.read(&mut vocab, &mut record).unwrap());
    assert_eq!(record.axis(), Some([0.0, 1.0, 0.0]));
    assert_eq!(reader.recognized().to_string(), "nx (told by line 1)");
}

const TEXT_WORDS: [&str; 7] =
    ["PPRINT", "INSERT", "PARTNO", "LETTER", "REMARK", "TITLES", "TPRINT"];

/// A text never takes the next statement with it, whatever it ends in.
#[test]
fn a_dollar_at_the_end_of_a_text_is_text() {
    for dialect in ClDialect::ALL {
        for word in TEXT_WORDS {
            for ending in ["$", " $", "$$", ",$", ",  $", "$ $"] {
                let text = format!("{word} / A NOTE{ending}\nGOTO / 1, 2, 3\n");
                let found = records(&text, *dialect);
                assert_eq!(found.len(), 2, "{dialect}: {text}");
                assert_eq!(found[0].text, format!("A NOTE{ending}"));
                assert_eq!(found[1].point(), Some([1.0, 2.0, 3.0]));
            }
        }
    }
}

/// A line cut at column 72 by CATIA, and the one after it.
fn cut(begin: &str, letter: &str, rest: &str) -> String {
    let fill = 71 - begin.chars().count();
    format!("{begin}{}$\n{rest}\n", letter.repeat(fill))
}

#[test]
fn catia_cuts_texts_at_its_column() {
    let text = cut("TPRINT/", "x", "yz") + "RAPID\n";
    let found = records(&text, ClDialect::Catia);
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].text, "x".repeat(64) + "yz");
    // Letters count, not bytes.
    let found = records(&cut("TPRINT/", "é", "yz"), ClDialect::Catia);
    assert_eq!(found[0].text, "é".repeat(64) + "yz");
    // A statement is never taken for the rest of a text.
    for next in ["RAPID", "GOTO  /  1., 2., 3.", "$$ a comment", "  FEDRAT/100.,MMPM"] {
        refused(&cut("TPRINT/", "x", next), Some(ClDialect::Catia), ClCode::OpenContinuation);
    }
    // In other dialects the same line ends there.
    let found = records(&(cut("TPRINT/", "x", "RAPID") + "RAPID\n"), ClDialect::Creo);
    assert_eq!((found.len(), found[0].text.ends_with("x$")), (3, true));
}

#[test]
fn catia_cuts_comments_and_numbers_at_its_column() {
    let text = cut("$$ OPERATION NAME : ", "x", "Horizontale") + "RAPID\n";
    assert_eq!(records(&text, ClDialect::Catia).len(), 1);
    let next = cut("$$ ", "x", "GOTO/1.,2.,3.");
    refused(&next, Some(ClDialect::Catia), ClCode::OpenContinuation);
    // A comment that ends in $ elsewhere is over.
    assert_eq!(records("$$ 5$\nRAPID\n", ClDialect::Catia).len(), 1);
    assert_eq!(records("$$ 5$\nRAPID\n", ClDialect::Creo).len(), 1);
    let number = cut("GOTO  /   ", "0", "00.500000,    2.,3.");
    let found = records(&number, ClDialect::Catia);
    assert_eq!(found[0].point(), Some([0.5, 2.0, 3.0]));
    refused(&number, Some(ClDialect::Creo), ClCode::BadNumber);
}

/// Without a comma two items stay two, wherever the line ends.
#[test]
fn a_continuation_joins_no_numbers() {
    for dialect in ClDialect::ALL {
        for text in ["GOTO/1,2,3$\n4,5,6\n", "GOTO/1,2,3 $\n4\n", "FEDRAT/10$\n0,MMPM\n"] {
            refused(text, Some(*dialect), ClCode::BadNumber);
        }
        if !dialect.rules().blanks_in_cycles {
            refused("CYCLE/DEEP,DEPTH,3$\nSTEP,1\n", Some(*dialect), ClCode::BadNumber);
        }
        refused("COOLNT/ON$\nRAPID\n", Some(*dialect), ClCode::BadWord);
        refused("RAPID $\nGOTO/1,2,3\n", Some(*dialect), ClCode::BadWord);
    }
}

#[test]
fn a_name_in_a_pseudo_comment_may_end_in_a_dollar() {
    let found = records("$$-> MFGNO / PART$\nGOTO / 1, 2, 3\n", ClDialect::Creo);
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].text, "PART$");
}

#[test]
fn arcs_of_one_dialect_are_no_arcs_of_another() {
    let creo = "CIRCLE/0,0,0,0,0,1,5\n";
    let nx = "CIRCLE/0,0,0,0,0,1,5,.06,.5,40,1\n";
    let solidworks = "CIRCLE/0,0,0,0,0,1.\n";
    let camworks = "CIRCLE/0,0,0,0,0,1.,5.,CLOCKWISE\n";
    let read_by = |text: &str| -> Vec<&str> {
        let can = |dialect: &&ClDialect| read(text, Some(**dialect)).is_ok();
        ClDialect::ALL.iter().filter(can).map(|dialect| dialect.name()).collect()
    };
    assert_eq!(read_by(creo), ["generic", "generic-left", "creo", "solidworks-cam", "fusion"]);
    assert_eq!(read_by(nx), ["nx", "ffcam"]);
    assert_eq!(read_by(solidworks), ["generic", "generic-left", "solidworks-cam", "fusion"]);
    assert_eq!(read_by(camworks), ["generic-left", "camworks", "camworks-axis"]);
    let diag = refused(nx, None, ClCode::ForeignArc);
    let hint = diag.hint.as_ref().unwrap();
    assert!(hint.contains("--dialect nx") && hint.contains("--dialect ffcam"), "{hint}");
    refused(creo, Some(ClDialect::Catia), ClCode::ForeignArc);
}

#[test]
fn the_word_decides_in_camworks() {
    let axis = |word: &str| {
        let text = format!("CIRCLE/ 0.,0.,0.,0.,0.,1.,5.,{word} \n");
        records(&text, ClDialect::CamWorks)[0].circle().unwrap().axis
    };
    assert_eq!(axis("CLOCKWISE"), [0.0, 0.0, -1.0]);
    assert_eq!(axis("COUNTERCLOCKWISE"), [0.0, 0.0, 1.0]);
    for text in ["CIRCLE/0,0,0,0,0,1,5\n", "CIRCLE/0,0,0,0,0,1,5,CLOCKWISE,COUNTERCLOCKWISE\n"] {
        assert!(read(text, Some(ClDialect::CamWorks)).is_err(), "{text}");
    }
}

/// Elsewhere a word must say what the axis says.
#[test]
fn a_word_against_the_axis() {
    for (axis, word) in [("0,0,1", "COUNTERCLOCKWISE"), ("0,0,-1", "CLOCKWISE")] {
        let nx = |word: &str| format!("CIRCLE/0,0,0,{axis},5,.06,.5,10,1,{word}\n");
        let creo = |word: &str| format!("CIRCLE/0,0,0,{axis},5,{word}\n");
        let other = if word == "CLOCKWISE" { "COUNTERCLOCKWISE" } else { "CLOCKWISE" };
        assert!(read(&creo(word), Some(ClDialect::Creo)).is_ok(), "{axis} {word}");
        refused(&creo(other), Some(ClDialect::Creo), ClCode::ForeignArc);
        assert!(read(&nx(other), Some(ClDialect::Nx)).is_ok(), "{axis} {word}");
        refused(&nx(word), Some(ClDialect::Nx), ClCode::ForeignArc);
    }
    let axis = "CIRCLE/0,0,0,-1,0,0,5,COUNTERCLOCKWISE\n";
    refused(axis, Some(ClDialect::Generic), ClCode::ForeignArc);
}

#[test]
fn the_axis_left_out() {
    let text = "MULTAX/ON\nGOTO/1,2,3,0,1,0\nGOTO/4,5,6\nMULTAX/OFF\nGOTO/7,8,9\n";
    let axes = |dialect: ClDialect| -> Vec<Option<[f64; 3]>> {
        let found = records(text, dialect);
        [2, 4].iter().map(|at| found[*at].axis()).collect()
    };
    let (kept, up) = (Some([0.0, 1.0, 0.0]), Some([0.0, 0.0, 1.0]));
    for dialect in ClDialect::ALL {
        let expected = match dialect {
            ClDialect::Nx | ClDialect::Ffcam => [kept, kept],
            ClDialect::SolidWorksCam => [up, up],
            ClDialect::Creo => [None, None],
            _ => [kept, None],
        };
        assert_eq!(axes(*dialect), expected, "{dialect}");
    }
    let flat = records("GOTO/1,2,3\nGOTO/4,5,6\n", ClDialect::SolidWorksCam);
    assert!(flat.iter().all(|record| record.axis().is_none()), "no axis where the file has none");
}

#[test]
fn several_points_in_one_goto() {
    let nine = "GOTO/1,2,3,4,5,6,7,8,9\n";
    for dialect in ClDialect::ALL {
        let is_read = read(nine, Some(*dialect)).is_ok();
        assert_eq!(is_read, *dialect == ClDialect::Creo, "{dialect}");
        let six = "GOTO/1,2,3,4,5,6\n";
        let diag = refused(six, Some(*dialect), ClCode::UnclearPoints);
        assert_eq!(&diag.spans[0].excerpt[diag.spans[0].span.clone()], "4,5,6");
        refused(&format!("MULTAX/ON\n{six}"), Some(*dialect), ClCode::UnclearPoints);
    }
    for text in [
        "GOTO/1,2,3,0,0,1,4,5,6,0,1,0\n",
        "CIRCLE/0,0,0,0,0,1,5\nGOTO/1,2,3,4,5,6,7,8,9\n",
        "CIRCLE/0,0,0,0,0,1,5\nGOTO/5,0,0\nCIRCLE/0,0,0,0,0,1,5\nGOTO/1,2,3,4,5,6,7,8,9\n",
        "MULTAX/ON\nGOTO/1,2,3,0,0,1,4,5,6,0,1,1\n",
    ] {
        refused(text, Some(ClDialect::Creo), ClCode::UnclearPoints);
    }
    refused("MULTAX/ON\nGOTO/1,2,3,4,5,6,7,8,9\n", Some(ClDialect::Creo), ClCode::BadPoint);
}

#[test]
fn axes_that_are_none() {
    for axis in ["0,0,0", "0,0,0.999", "1,1,1", "0,0,2", "0,1E200,0", "0.1,0.1,0.1"] {
        for dialect in ClDialect::ALL {
            for word in ["GOTO", "FROM"] {
                if (*dialect, word, axis) == (ClDialect::OrnlSlicer, "GOTO", "0,0,0") {
                    continue;
                }
                let text = format!("{word}/1,2,3,{axis}\n");
                refused(&text, Some(*dialect), ClCode::UnclearPoints);
            }
        }
        refused(&format!("CIRCLE/1,2,3,{axis},5\n"), None, ClCode::BadPoint);
    }
}

#[test]
fn empty_items() {
    let found = records("TDATA/3,ADJUST,,TURN\n", ClDialect::Catia);
    assert_eq!(found[0].data[2], Word::Empty);
    assert_eq!(found[0].data[3], Word::Minor(words::TURN));
    let comma = "CUTTER/ 10.,0.,5.,3.,31.,0.,130.,\n";
    for dialect in ClDialect::ALL {
        refused("GOTO/1,,3\n", Some(*dialect), ClCode::BadPoint);
        let trailing = dialect.rules().trailing_comma;
        let writes = [ClDialect::CamWorks, ClDialect::CamWorksAxis, ClDialect::Catia];
        assert_eq!(trailing, writes.contains(dialect));
        assert_eq!(read(comma, Some(*dialect)).is_ok(), trailing, "{dialect}");
    }
    let found = records("CHANNEL,1\nCHANNEL,\n", ClDialect::Catia);
    assert_eq!((found[0].data.len(), found[1].data.len()), (1, 0));
    assert_eq!(found[0].data[0], Word::Number(1.0));
    refused("CHANNEL,1\n", None, ClCode::BadWord);
}

/// The word of CAMWorks is proved: an arc that runs back from the motion behind it is a cusp.
#[test]
fn the_word_of_camworks_decides_at_a_cusp() {
    let text = "BOX/0,0,0,1,1,1\nGOTO/10,-5,0\nGOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10,CLOCKWISE\n\
                GOTO/0,-10,0\nGOTO/5,-10,0\n";
    let axis = |dialect| {
        let found = records(text, dialect);
        found.iter().find_map(Record::circle).unwrap().axis[2]
    };
    assert_eq!(axis(ClDialect::CamWorks), -1.0);
    assert_eq!(axis(ClDialect::CamWorksAxis), 1.0);
    // Its arcs are proved, so its signs speak against the dialect that mirrors them.
    let options = Options { dialect: Some(ClDialect::CamWorksAxis), ..Options::default() };
    let mut reader = Reader::new(text.as_bytes(), "t", options);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    while reader.read(&mut vocab, &mut record).unwrap() {}
    assert_eq!(reader.recognized().against, Some((ClDialect::CamWorks, 1)));
}

/// No help names a dialect that would turn the arcs of a system that is known by its signs.
#[test]
fn arcs_of_a_known_system_have_one_rule() {
    for dialect in ClDialect::ALL {
        let is_told = !dialect.rules().signs.is_empty();
        assert!(!is_told || dialect.turning_otherwise().is_empty(), "{dialect}");
    }
    assert!(ClDialect::SolidWorksCam.proof_of_arcs().is_some());
    assert!(ClDialect::CamWorks.proof_of_arcs().is_some());
    assert_eq!(ClDialect::Generic.proof_of_arcs(), None);
    let wrong = "TRNTYP/WORLD,0,0,0\nCIRCLE/0,0,0,0,0,1,5,CLOCKWISE\n";
    let diag = refused(wrong, None, ClCode::ForeignArc);
    assert!(diag.hint.is_some_and(|hint| !hint.contains("left")));
}

/// The file that Creo hands to its post: notes behind REMARK, CAMERA for the frame, and the
/// codes of its words.
#[test]
fn what_creo_hands_to_its_post() {
    let text = "REMARK *  PRO/CLFILE VERSION CREO PARAMETRIC 9.0\nPPWORD/CALSUB,3150\n\
                PPWORD/DEPTH,281\nREMARK -> CUTTER / 6.0\nCAMERA/1,0,0,0,0,1,0,0,0,0,1,0\n";
    let mut reader = Reader::new(text.as_bytes(), "t", Options::default());
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut majors = Vec::new();
    while reader.read(&mut vocab, &mut record).unwrap() {
        majors.push(record.major);
    }
    assert_eq!(reader.recognized().dialect, ClDialect::Creo);
    let note = words::PPWORD;
    assert_eq!(majors, [words::REMARK, note, note, words::CUTTER, words::CSYS]);
    assert_eq!(vocab.code(words::CALSUB), 3150.0);
    assert_eq!(vocab.minor_with_code(281.0), Some(words::DEPTH), "the file's code wins");
    assert_ne!(vocab.code(words::FEDTO), 281.0);
    refused("PPWORD/DEPTH\n", None, ClCode::BadPoint);
    refused("PPWORD/DEPTH,1.5\n", None, ClCode::BadPoint);
}

/// What a subroutine holds is done where it is called.
#[test]
fn subroutines_of_creo() {
    let creo = "$$* Pro/CLfile  Version 9.0\n";
    let sub = "DEFSUB/1\nFEDRAT/10,IPM\nGOTO/1,0,0,2,0,0,3,0,0\nENDSUB\n";
    let text = format!("{creo}{sub}LOADTL/2\nGOTO/5,0,0\nCALSUB/1\nGOTO/6,0,0\nCALSUB/1\n");
    let found: Vec<(u32, u32)> =
        read(&text, None).unwrap().0.iter().map(|record| (record.number, record.line)).collect();
    let expected =
        [(1, 6), (2, 7), (3, 3), (4, 4), (5, 4), (6, 4), (7, 9), (8, 3), (9, 4), (10, 4), (11, 4)];
    assert_eq!(found, expected);
    for wrong in [
        "CALSUB/1\n",
        "CALSUB/1,2\n",
        "ENDSUB\n",
        "DEFSUB/1\nDEFSUB/2\n",
        "DEFSUB/1\nGOTO/1,2,3\n",
        "DEFSUB/1\nFINI\n",
        "DEFSUB/1\nMODE/INCR\nGOTO/1,2,3\nMODE/ABSOL\nENDSUB\nCALSUB/1\n",
        "DEFSUB/1\nENDSUB\nDEFSUB/1\nGOTO/1,2,3\nENDSUB\n",
    ] {
        refused(&format!("{creo}{wrong}"), None, ClCode::UncomputedMotion);
    }
    let as_written = Options { expand_subroutines: false, ..Options::default() };
    let mut reader = Reader::new(text.as_bytes(), "t", as_written);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut count = 0;
    while reader.read(&mut vocab, &mut record).unwrap() {
        count += 1;
    }
    assert_eq!(count, 11);
}

/// A spline of NX without its ends begins where the tool stands and ends at its last point.
#[test]
fn splines_of_nx_without_their_ends() {
    let spline = |knots: &str, points: usize| {
        let points: String = (1..=points).map(|n| format!("CNTRL/{n}.,{n}.,0.\n")).collect();
        format!("MSYS/0,0,0,1,0,0,0,1,0\nGOTO/0.,0.,0.\nNURBS/\n{knots}{points}")
    };
    let knots = "KNOT/0.5\nKNOT/1.0\n";
    let found = read(&spline(knots, 4), None).unwrap().0;
    let ends: Vec<[f64; 3]> = found.iter().filter_map(Record::point).collect();
    assert_eq!(ends.first(), Some(&[0.0; 3]));
    assert_eq!(ends.last(), Some(&[4.0, 4.0, 0.0]));
    refused(&spline("KNOT/0.5\nKNOT/0.9\n", 4), None, ClCode::BadSpline);
    refused(&spline(knots, 3), None, ClCode::MissingItem);
}

/// The unit that a text tells by its feeds.
fn told(text: &str) -> Option<fil_cl::WordId> {
    Reader::new(text.as_bytes(), "t", Options::default()).told_unit()
}

#[test]
fn feeds_of_nx_tell_the_unit() {
    let file = |tool: &str, feeds: &str| {
        format!(
            "TOOL PATH/A,TOOL,B\nTLDATA/MILL,{tool},0.,50.\n{feeds}GOTO/0.,0.,1.\nGOTO/30.,0.,1.\n"
        )
    };
    assert_eq!(told(&file("10.", "FEDRAT/MMPM,250.\n")), Some(words::MM));
    assert_eq!(told(&file("10.", "FEDRAT/mmpr,0.1\n")), Some(words::MM));
    assert_eq!(told(&file("0.5", "FEDRAT/IPM,20.\n")), Some(words::INCHES));
    assert_eq!(told(&file("1.5", "CYCLE/DRILL,FEDTO,-5.,IPR,.01\n")), Some(words::INCHES));
    for (why, text) in [
        ("no feed", file("10.", "")),
        ("feeds of both", file("10.", "FEDRAT/MMPM,250.\nFEDRAT/IPM,10.\n")),
        ("UNITS says it", file("10.", "UNITS/MM\nFEDRAT/MMPM,250.\n")),
        ("a tool that is too small", file("0.5", "FEDRAT/MMPM,250.\n")),
        ("a tool that is too large", file("10.", "FEDRAT/IPM,250.\n")),
        ("no sign of NX", "FEDRAT/MMPM,250.\nGOTO/0.,0.,1.\nGOTO/30.,0.,1.\n".to_string()),
    ] {
        assert_eq!(told(&text), None, "{why}");
    }
    let without_tool = |way: &str| {
        format!("TOOL PATH/A,TOOL,B\nFEDRAT/MMPM,9.\nGOTO/0.,0.,1.\nGOTO/{way},0.,1.\n")
    };
    assert_eq!(told(&without_tool("30.")), Some(words::MM));
    assert_eq!(told(&without_tool("3.")), None);
}

#[test]
fn told_unit_takes_nothing_away() {
    let text = "TOOL PATH/A,TOOL,B\nTLDATA/MILL,10.,0.,50.\nFEDRAT/MMPM,250.\nGOTO/0.,0.,1.\nGOTO/30.,0.,1.\n";
    let mut reader = Reader::new(text.as_bytes(), "t", Options::default());
    assert_eq!(reader.told_unit(), Some(words::MM));
    let (mut vocab, mut record, mut count) = (Vocabulary::new(), Record::default(), 0);
    while reader.read(&mut vocab, &mut record).unwrap() {
        count += 1;
    }
    assert_eq!(count, read(text, None).unwrap().0.len());
}

#[test]
fn nci_of_mastercam_is_refused_with_its_name() {
    let diag = refused("1050\n0 100 0 0. 0. 0.\n1000\n100 1 3\n", None, ClCode::BinaryData);
    assert!(diag.message.contains("Mastercam"), "{diag}");
    assert!(diag.hint.as_deref().unwrap_or_default().contains("NCI2APT"), "{diag}");
}

#[test]
fn a_sign_behind_what_another_dialect_refuses_is_found() {
    let text = "CUTTER/1.,0.,5.,\nOPFEATSTART/A\nOPFEATEND/A\nFINI\n";
    assert_eq!(recognized(text), "camworks (told by line 2)");
}

#[test]
fn notes_of_creo_are_none_of_its_signs_in_a_file_of_the_slicer() {
    let text = "$$ ORNL SLICER 2\n$$-> CSYS / 1.0\nUNITS / MM\n";
    assert_eq!(recognized(text), "ornl-slicer (told by line 1)");
    let text = "PARTNO/'1001'\nUNITS/MM\n";
    assert_eq!(recognized(text), "fusion (told by line 1)");
}

#[test]
fn movnrb_of_creo_stands_beside_its_points() {
    let text = "MULTAX/ON\nGOTO/0,0,0,0,0,1\nMOVNRB/5AXIS,LENGTH,10\nMOVNRB/ON,2,4,0,2,10.0\n\
        MOVNRB/1,0,0,10,10\nMOVNRB/2,0,0,0,10,0,0\nMOVNRB/3,0,0,10,11,0,9.95\nMOVNRB/NEXT\n\
        GOTO/10,0,0,0,0,1\nMOVNRB/OFF\nFINI\n";
    let found = records(text, ClDialect::Creo);
    let of_curve = found.iter().filter(|record| record.inert).count();
    assert_eq!((found.len(), of_curve), (11, 7));
    for (from, to) in [
        ("MOVNRB/ON,2,4,0,2,10.0", "MOVNRB/ON,2"),
        ("MOVNRB/2,0,0,0,10,0,0", "MOVNRB/2,0,0,0,10,0"),
        ("MOVNRB/2,0,0,0,10,0,0", "MOVNRB/2,0,0,0,10,0,3"),
        ("MOVNRB/NEXT", "MOVNRB/LAST"),
        ("5AXIS,LENGTH", "6AXIS,LENGTH"),
    ] {
        refused(&text.replace(from, to), Some(ClDialect::Creo), ClCode::BadSpline);
    }
}

#[test]
fn tools_of_fusion_have_their_offset() {
    for text in ["LOADTL/3, 0, 40.000000, 7\n", "LOADTL/3, IN, 0, LENGTH, 40, OSETNO, 7\n"] {
        let found = records(text, ClDialect::Fusion);
        let offset = [Word::Number(3.0), Word::Minor(words::OSETNO), Word::Number(7.0)];
        assert_eq!(found[0].data, offset, "{text}");
    }
    let other = records("LOADTL/3, 1, 40.000000, 7\n", ClDialect::Fusion);
    assert_eq!(other[0].data.len(), 4, "a pocket is not passed over");
}
