//! FIL sees the records of all dialects in one form, or as they are written, and the program
//! is the same.

use std::collections::BTreeMap;
use std::io::Cursor;

use filpost::cl::{ClDialect, Options};
use filpost::{Program, Unit};
use filpost_tests::{root, tip_program};

/// The small files of `tests/dialects`.
fn files() -> Vec<(ClDialect, String)> {
    let folder = root().join("tests/dialects");
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let read = |path: &std::path::PathBuf| {
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        let dialect = stem.split('_').next().unwrap().parse().unwrap();
        (dialect, std::fs::read_to_string(path).unwrap())
    };
    paths.iter().map(read).collect()
}

/// A section for each word that warns of what it sees and lets the post go on.
fn fil(words: &[(&str, &str)]) -> String {
    let mut text = String::from("$$ filpost: allow-file W0218, W0244, W0313\n");
    for (word, sees) in words {
        text.push_str(&format!("CIMFIL/ON,{word}\nWARN/{sees}\nDMY=POSTF(13)\nCIMFIL/OFF\n"));
    }
    text + "FINI\n"
}

/// What the sections say, in their order, and the program.
fn run(
    cl: &str,
    fil: &str,
    settings: &[&str],
    raw: bool,
) -> Result<(Vec<String>, Vec<u8>), String> {
    let mut failure = String::new();
    for base in [
        Program::builder().generic("fanuc-mill"),
        Program::builder().generic("fanuc-lathe"),
        tip_program::MACHINES[0].builder(),
    ] {
        let mut builder = if fil.is_empty() { base } else { base.fil("form.fil", fil) };
        for setting in settings {
            builder = builder.set(setting);
        }
        let program = builder.build().map_err(|error| error.to_string())?;
        let reading = Options { raw, ..Options::default() };
        let mut nc = Vec::new();
        let run = program.start().cl_options(reading).units(Unit::Mm);
        match run.stream_seekable(Cursor::new(cl), &mut nc) {
            Ok(report) => {
                let said = report.warnings.iter().filter(|diag| diag.code.number == 326);
                return Ok((said.map(|diag| diag.message.clone()).collect(), nc));
            }
            Err(error) => failure.push_str(&error.to_string()),
        }
    }
    Err(failure)
}

/// Classes of words 4 to 6, and of the radius.
const FORM: &[(&str, &str)] = &[
    ("FEDRAT", "'FEDRAT ',POSTF(6,4),POSTF(6,5)"),
    ("SPINDL", "'SPINDL ',POSTF(6,4),POSTF(6,5)"),
    ("LOADTL", "'LOADTL ',POSTF(6,4)"),
    ("LOAD", "'LOAD'"),
    ("UNIT", "'UNIT'"),
    ("CYCLE", "'CYCLE ',POSTF(6,4),POSTF(6,5),POSTF(6,6)"),
    ("CIRCLE", "'CIRCLE ',POSTF(5),POSTF(6,15)"),
    ("GOTO", "'GOTO ',POSTF(6,6)"),
];

#[test]
fn words_stand_where_creo_puts_them() {
    for (dialect, cl) in files() {
        let (said, _) =
            run(&cl, &fil(FORM), &[], false).unwrap_or_else(|e| panic!("{dialect}: {e}"));
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for line in said {
            *counts.entry(line).or_default() += 1;
        }
        for form in counts.keys() {
            let fits = match form.split(' ').next().unwrap() {
                "FEDRAT" => form == "FEDRAT 12",
                // OFF, or a unit and a value.
                "SPINDL" => matches!(form.as_str(), "SPINDL 20" | "SPINDL 21"),
                "LOADTL" => form == "LOADTL 1",
                // OFF, or the kind, a word and a value.
                "CYCLE" => matches!(form.as_str(), "CYCLE 200" | "CYCLE 221"),
                // Seven numbers, and TIMES with its own.
                "CIRCLE" => matches!(form.as_str(), "CIRCLE 151" | "CIRCLE 171"),
                "GOTO" => true,
                _ => false,
            };
            assert!(fits, "{dialect}: {form}");
        }
        assert!(counts.len() > 3, "{dialect}: {counts:?}");
    }
}

#[test]
fn each_goto_has_an_axis_while_multax_is_on() {
    let sees = fil(&[("GOTO", "POSTF(5)"), ("MULTAX", "POSTF(7,4)")]);
    let mut seen = 0;
    for (dialect, cl) in files() {
        if dialect == ClDialect::Creo || !cl.contains("MULTAX/ON") && !cl.contains("MULTAX / ON") {
            continue;
        }
        let (said, _) = run(&cl, &sees, &[], false).unwrap_or_else(|error| panic!("{error}"));
        let mut is_on = false;
        for line in said {
            match line.as_str() {
                "71" | "72" => is_on = line == "71",
                words => assert!(!is_on || words == "11", "{dialect}: {words} words"),
            }
        }
        seen += 1;
    }
    assert!(seen > 2, "{seen}");
}

/// Sections that only let the post go on change nothing, whatever form they see.
#[test]
fn as_written_the_program_is_the_same() {
    const WORDS: &[&str] = &[
        "FEDRAT", "SPINDL", "LOAD", "LOADTL", "UNIT", "UNITS", "CYCLE", "CIRCLE", "GOTO", "INSERT",
        "PPRINT", "SELECT", "CUTCOM", "ROTABL", "TOOLNO", "TLDATA", "HELICAL", "MAXRPM", "SYNC",
        "INDIRV", "TLON", "PSIS", "NURBS", "KNOT", "CNTRL",
    ];
    let all: Vec<(&str, &str)> = WORDS.iter().map(|word| (*word, "'seen'")).collect();
    for (dialect, cl) in files() {
        let show = |(said, nc): (Vec<String>, Vec<u8>)| {
            (said.len(), String::from_utf8_lossy(&nc).into_owned())
        };
        let formed = show(run(&cl, "", &[], false).unwrap_or_else(|error| panic!("{error}")));
        let bare = show(run(&cl, "", &[], true).unwrap_or_else(|error| panic!("{error}")));
        assert_eq!(formed, bare, "{dialect}");
        let taken = show(run(&cl, &fil(&all), &[], true).unwrap_or_else(|error| panic!("{error}")));
        assert_eq!(formed.1, taken.1, "{dialect}");
        assert!(taken.0 > 5, "{dialect}");
    }
}

#[test]
fn sections_see_the_words_of_the_system() {
    let nx = "PAINT/A\nUNITS/MM\nLOAD/TOOL,4\nSPINDL/RPM,900,CLW\nFEDRAT/MMPM,250.\n\
        GOTO/12.5,0.,0.,0.,0.,1.\n\
        CIRCLE/0.,0.,0.,0.,0.,-1.,12.5,.06,.5,40.,1.\nGOTO/0.,12.5,0.\n";
    let sees = fil(&[
        ("FEDRAT", "POSTF(6,4),POSTF(7,5)"),
        ("CIRCLE", "POSTF(5),' ',POSTF(7,14)"),
        ("GOTO", "POSTF(5)"),
    ]);
    let (formed, _) = run(nx, &sees, &[], false).unwrap();
    assert_eq!(formed[0].split_at(1).0, "1");
    assert_eq!(formed[1..], ["11", "15 1", "11"]);
    let (written, _) = run(nx, &sees, &[], true).unwrap();
    assert_eq!(written, ["2250", "11", "19 -1", "8"]);
}

/// Motions by geometry are seen as they are written, too; each is carried out with the
/// statement that ends it, and NEXTF and PREVF find where it leads.
#[test]
fn sections_see_geometry_as_it_is_written() {
    let spline = "TOOL PATH/A,TOOL,B\nUNITS/MM\nLOAD/TOOL,1\nFEDRAT/MMPM,250.\nGOTO/10.,0.,5.\nNURBS/\n\
        KNOT/0.,0.,0.,1.,1.,1.\nCNTRL/10.,0.,5.\nCNTRL/10.,10.,5.\nCNTRL/0.,10.,5.\nGOTO/0.,20.,5.\n\
        END-OF-PATH\n";
    let arc = "$$*CATIA0\nLOADTL/1\nFEDRAT/250.,MMPM\nGOTO/10.,0.,5.\nINDIRV/0.,1.,0.\n\
        TLON,GOFWD/(CIRCLE/0.,0.,5.,10.),ON,(LINE/0.,0.,5.,0.,10.,5.)\nGOTO/0.,20.,5.\nFINI\n";
    let words = ["GOTO", "CIRCLE", "INDIRV", "TLON", "NURBS", "KNOT", "CNTRL"];
    let sees: Vec<(&str, String)> = words
        .iter()
        .map(|word| match *word {
            "GOTO" | "CIRCLE" => (*word, format!("'{word} ',POSTF(5)")),
            _ => (*word, format!("'{word} ',POSTF(5),' ',PREVF(X),' ',NEXTF(Y)")),
        })
        .collect();
    let sees: Vec<(&str, &str)> = sees.iter().map(|(word, text)| (*word, &text[..])).collect();
    let sees = fil(&sees);
    for (cl, expected) in [
        (
            spline,
            &[
                "GOTO 8",
                "NURBS 3 10 0",
                "KNOT 9 10 0",
                "CNTRL 6 10 0",
                "CNTRL 6 10 0",
                "CNTRL 6 10 20",
                "GOTO 8",
            ][..],
        ),
        (arc, &["GOTO 8", "INDIRV 6 10 10", "TLON 17 10 20", "GOTO 8"][..]),
    ] {
        let formed = run(cl, &sees, &[], false).unwrap();
        let (written, nc) = run(cl, &sees, &[], true).unwrap();
        assert_eq!(written, expected);
        assert_eq!(nc, formed.1);
        assert!(formed.0.iter().all(|line| line.starts_with("GOTO") || line.starts_with("CIRCLE")));
    }
    // A section that takes the statement that ends the motion takes the motion.
    let takes = "CIMFIL/ON,TLON\nPPRINT/TAKEN\nCIMFIL/OFF\nFINI\n";
    let nc = String::from_utf8(run(arc, takes, &[], true).unwrap().1).unwrap();
    assert!(nc.contains("TAKEN") && !nc.contains("G3") && !nc.contains("G03"), "{nc}");
    let changes = "CIMFIL/ON,TLON\nDMY=POSTF(8,6,99)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    assert!(run(arc, changes, &[], true).unwrap_err().contains("E0716"));
}

/// The tool in use is known after going back, too.
#[test]
fn the_diameter_after_going_back() {
    let cl = "UNITS/MM\nCUTTER/10.\nLOADTL/1\nFEDRAT/9.,MMPM\nGOTO/1,2,3\nCUTTER/6.\nLOADTL/2\nGOTO/1,2,9\n\
        COOLNT/ON\nLOADTL/3\nGOTO/1,2,4\nFINI\n";
    let tool_at = |number: u32| {
        let text = format!(
            "$$ filpost: allow-file W0218, W0244\nDONE=0\nCIMFIL/ON,FINI\nIF(DONE.EQ.0)THEN\nDONE=1\n\
             DMY=POSTF(16,{number})\nWARN/TOOLF(DIAMTR)\nELSE\nDMY=POSTF(13)\nENDIF\nCIMFIL/OFF\n\
             CIMFIL/ON,GOTO\nIF(DONE.EQ.1)THEN\nWARN/TOOLF(DIAMTR)\nENDIF\nCIMFIL/OFF\nFINI\n"
        );
        run(cl, &text, &[], false).unwrap().0
    };
    assert_eq!(tool_at(5), ["10", "6", "EMPTY"]);
    assert_eq!(tool_at(8), ["6", "EMPTY"]);
    assert_eq!(tool_at(7), ["6", "6", "EMPTY"]);
    assert_eq!(tool_at(2), ["10", "10", "6", "EMPTY"]);
    assert_eq!(tool_at(11), ["EMPTY"]);
}

/// What a system can't say for certain is refused only where the post has to act on it.
#[test]
fn a_section_may_take_what_is_not_clear() {
    let cl = "UNIT/MM\nLOAD/TOOL,1\nSPINDL/900,RPM,CLW\nCSI_SET_FLUTE_LENGTH/1\nINSERT/M10X1.5\n\
        FEDRAT/9.,MMPM\nGOTO/1,2,3\nFINI\n";
    assert!(run(cl, "", &[], true).unwrap_err().contains("E0419"));
    let takes = "CIMFIL/ON,INSERT\nPPRINT/TAP\nCIMFIL/OFF\nFINI\n";
    let (_, nc) = run(cl, takes, &[], true).unwrap();
    assert!(String::from_utf8_lossy(&nc).contains("(TAP)"));
}

#[test]
fn the_diameter_of_the_tool_in_use() {
    let asks =
        fil(&[("LOADTL", "TOOLF(DIAMTR)"), ("RAPID", "TOOLF(DIAMTR)"), ("FINI", "TOOLF(DIAMTR)")]);
    let tools = |cl: &str| run(cl, &asks, &[], false).unwrap_or_else(|error| panic!("{error}")).0;
    let creo = "$$*          Pro/CLfile\nUNITS / MM\nLOADTL / 1\n$$-> CUTTER / 10.0\nFEDRAT / 9., MMPM\n\
        RAPID\nGOTO / 1,2,3\nLOADTL / 2\nRAPID\nGOTO / 1,2,9\nLOADTL / 3\n$$-> CUTTER / 6.5\nRAPID\n\
        GOTO / 1,2,3\nFINI\n";
    assert_eq!(tools(creo), ["10", "10", "EMPTY", "EMPTY", "6.5", "6.5", "6.5"]);
    let solidworks = "UNIT/MM\nCUTTER/17.5,0.,8.75\nLOAD/TOOL,1\nCSI_SET_FLUTE_LENGTH/2.\nRAPID/\nGOTO/1,2,3\n\
        CUTTER/4.,0.,2.\nLOAD/TOOL,2\nRAPID/\nGOTO/1,2,9\nFINI\n";
    assert_eq!(tools(solidworks), ["17.5", "17.5", "4", "4", "4"]);
    let nx = "TOOL PATH/A,TOOL,B\nTLDATA/DRILL,MILL,8.,0.,120.,118.,35.\nLOAD/TOOL,2\nRAPID\nGOTO/1,2,3\n\
        END-OF-PATH\nTOOL PATH/A,TOOL,C\nTLDATA/MILL,16.,0.,75.,0.,0.\nLOAD/TOOL,3\nRAPID\nGOTO/1,2,3\n";
    assert_eq!(tools(nx), ["8", "8", "16", "16"]);
    let camworks =
        "UNITS/MM\nBOX/0,0,0,1,1,1\nCUTTER/ 10.,0.,5.,\nLOAD/TOOL,3\nRAPID/\nGOTO/1,2,3\nFINI\n";
    assert_eq!(tools(camworks), ["10", "10", "10"]);
    let catia =
        "$$*CATIA0\nCUTTER/ 16.,0.,8.,\nTOOLNO/1,   16.\nLOADTL/1\nRAPID\nGOTO/1,2,3\nFINI\n";
    assert_eq!(tools(catia), ["16", "16", "16"]);
}

#[test]
fn records_of_creo_behind_comments() {
    let cl = "$$*          Pro/CLfile\n$$-> MFGNO / PART\nUNITS / MM\n$$-> FEATNO / 32\nLOADTL / 1\n\
        $$-> CUTTER / 10.0\n$$-> CSYS / 1,0,0,5, 0,1,0,6, 0,0,1,7\nFEDRAT / 9., MMPM\nGOTO / 1,2,3\n\
        $$-> END /\nFINI\n";
    let sees = fil(&[
        ("FEATNO", "'feature ',POSTF(7,4)"),
        ("CUTTER", "'cutter ',POSTF(7,4),' ',POSTF(7,2)"),
        ("CSYS", "'shift ',POSTF(7,7)"),
        ("END", "'end'"),
    ]);
    let (none, plain) = run(cl, &sees, &[], false).unwrap();
    assert!(none.is_empty(), "{none:?}");
    let (said, nc) = run(cl, &sees, &["input.creo_records=1"], false).unwrap();
    assert_eq!(said, ["feature 32", "cutter 10 1", "shift 5"]);
    assert_eq!(nc, plain, "the frame is not applied");
    // POSTF(14) passes over those that no section takes.
    let reads = format!(
        "$$ filpost: allow-file W0218\nCIMFIL/ON,LOADTL\nDMY=POSTF(13);DMY=POSTF(14);WARN/POSTF(7,2)\n\
         DMY=POSTF(13)\nCIMFIL/OFF\n{}",
        fil(&[("CSYS", "'shift'")])
    );
    assert_eq!(run(cl, &reads, &["input.creo_records=1"], false).unwrap().0, ["1"]);
    assert_eq!(run(cl, &reads, &[], false).unwrap().0, ["2000"]);
}
