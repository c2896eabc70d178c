//! Statements of the dialects in the form of Creo.

use fil_cl::{ClCode, ClDialect, Options, Reader, Record, Vocabulary, Writer};
use fil_diag::{Code, Diag};

/// The records of a text as statements of Creo, line by line.
fn written(text: &str, options: Options) -> Result<Vec<String>, Box<Diag>> {
    let mut reader = Reader::new(text.as_bytes(), "t", options);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut writer = Writer::new(Vec::new());
    while reader.read(&mut vocab, &mut record)? {
        writer.write(&record, &vocab)?;
    }
    let bytes = writer.into_inner();
    let text = String::from_utf8_lossy(&bytes).replace("  $\n", " ");
    Ok(text.lines().map(str::to_string).collect())
}

/// The last record of a text.
fn last(text: &str) -> Record {
    let mut reader = Reader::new(text.as_bytes(), "t", Options::default());
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    while reader.read(&mut vocab, &mut record).unwrap() {}
    record
}

/// The statements behind the first line of a text, which shows its dialect.
fn forms(text: &str) -> Vec<String> {
    let lines = written(text, Options::default()).unwrap_or_else(|diag| panic!("{diag}\n{text}"));
    lines[1..].to_vec()
}

fn refused(text: &str, code: ClCode) -> Box<Diag> {
    let diag = written(text, Options::default()).expect_err("refused");
    let code: &Code = code.into();
    assert_eq!(diag.code, code, "{text}: {diag}");
    diag
}

const SOLIDWORKS: &str = "CSI_SET_FLUTE_LENGTH/22.\n";
const CAMWORKS: &str = "BOX/0,0,0,1,1,1\n";

#[test]
fn notes_of_solidworks_are_messages() {
    for sign in [SOLIDWORKS, CAMWORKS] {
        let text = format!("{sign}INSERT/6MM X 60DEG HSS CENTERDRILL\nINSERT/G53 Z0\n");
        assert_eq!(forms(&text), ["PPRINT / 6MM X 60DEG HSS CENTERDRILL", "INSERT / G53 Z0"]);
        refused(&format!("{sign}INSERT/M10X1.5\n"), ClCode::UnclearText);
    }
    assert_eq!(forms("RAPID\nINSERT/6MM DRILL\n"), ["INSERT / 6MM DRILL"]);
}

/// The note comes before the sign that tells the system.
#[test]
fn a_note_before_the_sign() {
    let text = format!("UNIT/MM\nINSERT/6MM DRILL\n{SOLIDWORKS}");
    assert_eq!(written(&text, Options::default()).unwrap()[1], "PPRINT / 6MM DRILL");
    let raw = Options { raw: true, ..Options::default() };
    assert_eq!(written(&text, raw).unwrap()[1], "INSERT / 6MM DRILL");
}

/// A GOTO that is refused leaves no points behind, also where it is given as written.
#[test]
fn values_that_are_no_points_come_once() {
    let raw = Options { raw: true, ..Options::default() };
    let text = "GOTO / 1, 2, 3\nGOTO / 5, 0, 0, 0, 0.5, 0\nRAPID\n";
    let said = ["GOTO / 1.0, 2.0, 3.0", "GOTO / 5.0, 0.0, 0.0, 0.0, 0.5, 0.0", "RAPID "];
    assert_eq!(written(text, raw).unwrap(), said);
    assert!(written(text, Options::default()).is_err());
}

/// What has no effect still comes to sections, and is marked.
#[test]
fn frames_and_tables_that_change_nothing() {
    for (text, inert) in
        [("TRNTYP/WORLD,0,0,0", true), ("TRNTYP/WORLD,0,0,1", false), ("TRNTYP/LOCAL,0,0,0", false)]
    {
        assert_eq!(last(&format!("{SOLIDWORKS}{text}\n")).inert, inert, "{text}");
    }
    for (text, inert) in [
        ("ROTABL/ -0.0,BAXIS,TABLE,CCLW", true),
        ("ROTABL/ 0.001,BAXIS,TABLE,CCLW", true),
        ("ROTABL/ 0.001,BAXIS,CCLW", false),
        ("OPFEATEND/Drill1", true),
        ("CUTCOM/ OFF", false),
    ] {
        assert_eq!(last(&format!("{CAMWORKS}{text}\n")).inert, inert, "{text}");
    }
    // Known statements are kept with their mark.
    assert!(last(&format!("{CAMWORKS}OPFEATEND/A\nOPFEATEND/A\n")).inert);
    assert!(!last("OPFEATENDS/A\n").inert);
}

#[test]
fn cycles_of_camworks() {
    let cycle = |values: &str| format!("{CAMWORKS}CYCLE/ ON\nCYCLE/ {values}\n");
    let deep = cycle("DRILL,G98,6.,PECKING,5.,2.,MMPM,100.,3.,25.,25.,DWELL,0.5");
    assert_eq!(
        forms(&deep),
        [
            "CYCLE / DEEP, DEPTH, 6.0, STEP, 2.0, 1STPECK, 5.0, MMPM, 100.0, CLEAR, 3.0, RETURN, 25.0, DWELL, 0.5"
        ]
    );
    let drill = cycle("DRILL,G99,6.,IPM,4.,0.1,1.,1.");
    assert_eq!(forms(&drill), ["CYCLE / DRILL, DEPTH, 6.0, IPM, 4.0, CLEAR, 0.1"]);
    for values in [
        "DRILL,G98,6.,PECKING,5.,2.,MMPM,100.,3.,25.,26.,DWELL,0.",
        "DRILL,G98,6.,PECKING,5.,MMPM,100.,3.,25.,25.",
        "DRILL,G98,6.,MMPM,100.,3.,25.",
        "DRILL,G98,6.,MMPM,100.,3.,25.,25.,REV,0.",
        "TAP,G98,6.,MMPM,100.,3.,25.,25.",
    ] {
        refused(&cycle(values), ClCode::MissingItem);
    }
    // One version of the system forgets a comma, and a blank parts the items.
    let lost = cycle("DRILL,G98,6.,PECKING,5.,2.,MMPM,100.,3.,25. 25. DWELL,0.5");
    assert_eq!(forms(&lost), forms(&deep));
}

#[test]
fn what_camworks_announces_must_come() {
    for word in ["CUTCOM", "CYCLE"] {
        let text = format!("{CAMWORKS}{word}/ ON\nGOTO/1,2,3\n");
        refused(&text, ClCode::MissingItem);
    }
    let text = format!("{CAMWORKS}CUTCOM/ ON\nCUTCOM/ LEFT\nGOTO/1,2,3\n");
    assert_eq!(forms(&text), ["CUTCOM / LEFT", "GOTO / 1.0, 2.0, 3.0"]);
}

/// An arc has the seven numbers of Creo, whatever system wrote it.
#[test]
fn arcs_have_one_form() {
    for (text, axis) in [
        ("BOX/0,0,0,1,1,1\nCIRCLE/1,2,3,0,0,1,5,CLOCKWISE\n", -1.0),
        ("PAINT/PATH\nCIRCLE/1,2,3,0,0,1,5,.06,.5,40,1\n", -1.0),
        ("CSI_SET_A/1\nCIRCLE/1,2,3,0,0,-1,5,CLOCKWISE\n", -1.0),
        ("$$-> END /\nCIRCLE/1,2,3,0,0,1,5\n", 1.0),
    ] {
        let expected = format!("CIRCLE / 1.0, 2.0, 3.0, 0.0, 0.0, {axis:.1}, 5.0");
        assert_eq!(forms(text), [expected], "{text}");
    }
    let turns = "PAINT/PATH\nCIRCLE/1,2,3,0,0,1,5,.06,.5,40,1,TIMES,2\n";
    assert_eq!(forms(turns), ["CIRCLE / 1.0, 2.0, 3.0, 0.0, 0.0, -1.0, 5.0, TIMES, 2.0"]);
    let raw = Options { raw: true, dialect: Some(ClDialect::Nx), ..Options::default() };
    assert!(written(turns, raw).unwrap()[1].contains("0.06"), "as written");
}

const CATIA: &str = "$$*CATIA0\nCATMAT/1.\n";
const NX: &str = "PAINT/PATH\n";

/// A quarter about 25,0,-30 in the XZ plane, as CATIA writes it.
const QUARTER: &str = "GOTO/20.4,0,-30\nAUTOPS\nINDIRV/0,0,1\n\
    TLON,GOFWD/ (CIRCLE/ 25.,0.,-30.,$\n 4.6),ON,(LINE/ 25.,0.,-30.,$\n 25.,0.,-25.4)\n";

#[test]
fn arcs_by_geometry() {
    let expected = [
        "GOTO / 20.4, 0.0, -30.0",
        "AUTOPS / ",
        "CIRCLE / 25.0, 0.0, -30.0, 0.0, 1.0, 0.0, 4.6",
        "GOTO / 25.0, 0.0, -25.4",
    ];
    assert_eq!(forms(&format!("{CATIA}{QUARTER}")), expected);
    assert_eq!(forms(&format!("$$-> END /\n{QUARTER}")), expected, "Creo writes them, too");
    let half = "GOTO/3.,.75,3.\nPSIS/(PLANE/(POINT/3.,0.,3.),PERPTO,(VECTOR/1.,0.,0.))\n\
        INDIRV/0,0,1\nFEDRAT/150.,MMPM\nTLON,GOFWD/(CYLNDR/3.,0.,3.,1.,0.,0.,.75),ON,2,INTOF,\
        (PLANE/PERPTO,(PLANE/(POINT/3.,0.,3.),PERPTO,(VECTOR/1.,0.,0.)),(POINT/3.,0.,3.),\
        (POINT/3.,-.75,3.))\n";
    assert_eq!(
        forms(&format!("{CATIA}{half}"))[1..],
        [
            "FEDRAT / 150.0, MMPM",
            "CIRCLE / 3.0, 0.0, 3.0, 1.0, 0.0, 0.0, 0.75",
            "GOTO / 3.0, -0.75, 3.0"
        ]
    );
    let helix = "GOTO/3.92323,.75,3.\nHELICAL/CENTER,3.92323,0.,3.,INDIRV,0.,0.,1.,AXIS,1.,0.,0.,\
        PITCH,0.01474,RADIUS,.75,ANGLE,180.,HEIGHT,.00737,ROUND,.5,END,3.91586,-.75,3.\n";
    assert_eq!(
        forms(&format!("{CATIA}{helix}"))[1..],
        ["CIRCLE / 3.92323, 0.0, 3.0, 1.0, 0.0, 0.0, 0.75", "GOTO / 3.91586, -0.75, 3.0"]
    );
}

#[test]
fn geometry_that_is_not_certain_is_refused() {
    for (from, to) in [
        ("INDIRV/0,0,1", "INDIRV/1,0,0"),
        ("INDIRV/0,0,1", "INDIRV/0,1,1"),
        ("4.6)", "4.7)"),
        ("GOTO/20.4", "GOTO/20.5"),
        ("ON,(", "ON,2,INTOF,("),
        ("ON,(", "TO,("),
        ("25.4)", "25.4"),
        ("GOFWD", "GOLFT"),
        ("(LINE/ 25.,0.", "(LINE/ 25.,1."),
        ("INDIRV/0,0,1\n", ""),
    ] {
        let text = format!("{CATIA}{}", QUARTER.replace(from, to));
        assert!(written(&text, Options::default()).is_err(), "{from} to {to}");
    }
    for rest in ["GOTO/1,2,3\n", "FINI\n", "", "END\n"] {
        refused(&format!("{CATIA}INDIRV/0,0,1\n{rest}"), ClCode::MissingItem);
    }
    // Where arcs are always CIRCLE, the geometry is not believed.
    refused(&format!("{NX}INDIRV/0,0,1\n"), ClCode::UncomputedMotion);
}

#[test]
fn tools_of_catia() {
    let text = format!(
        "{CATIA}LOADTL/1\nLOADTL/1,1\nLOADTL/1,2\nLOADTL/3,ADJUST,,TURN\n\
        LOADTL/5,ADJUST,1,SPINDL,15000.,MILL\nLOADTL/5,ADJUST,1,OTHER\n"
    );
    assert_eq!(
        forms(&text),
        [
            "LOADTL / 1.0",
            "LOADTL / 1.0, ADJUST, 2.0, TOOL",
            "LOADTL / 3.0",
            "LOADTL / 5.0, ADJUST, 1.0, TOOL",
            "LOADTL / 5.0, ADJUST, 1.0, OTHER",
        ]
    );
    for (text, inert) in [
        ("SWITCH/9,9", true),
        ("SWITCH/9,8", false),
        ("TOOLNO/1,TURN,1,0,3\nSWITCH/3", true),
        ("TOOLNO/1,TURN,1,0,3\nSWITCH/9", false),
        ("SWITCH/9\nSWITCH/3", false),
        ("SYNC/,,,", true),
        ("SYNC/1,2,1", false),
        ("CHANNEL,1", true),
        ("CHANNEL,1\nCHANNEL,2", false),
    ] {
        assert_eq!(last(&format!("{CATIA}{text}\n")).inert, inert, "{text}");
    }
}

#[test]
fn speeds_and_ends_of_catia() {
    let text =
        format!("{CATIA}MAXRPM/5000.\nFEDRAT/ 0.1,MMPR\nSPINDL/500.,SFM,CCLW\nREWIND/0\nEND\n");
    assert_eq!(
        forms(&text)[1..],
        ["FEDRAT / 0.1, MMPR", "SPINDL / SMM, 500.0, CCLW, MAXRPM, 5000.0", "REWIND / 0.0"]
    );
    refused(&format!("{CATIA}SPINDL/500.,SFM,CCLW\n"), ClCode::UnclearUnit);
    assert_eq!(
        forms(&format!("{CATIA}CYCLE/DRILL,60.2,1.,0.4,MMPR\nCYCLE/TAP,50.,1.\n")),
        [
            "CYCLE / DRILL, DEPTH, 60.2, MMPR, 0.4, CLEAR, 1.0",
            "CYCLE / TAP, DEPTH, 50.0, CLEAR, 1.0"
        ]
    );
}

#[test]
fn cycles_and_order_of_nx() {
    let text = format!(
        "{NX}LOAD/TOOL,62,ADJUST,1\nSELECT/TOOL,62\nFEDRAT/MMPM,250.\n\
        CYCLE/DRILL,DEEP,STEP,20.,CLEAR,3.,FEDTO,-72.,RTRCTO,AUTO,MMPM,250.\nGOTO/1,2,3\n\
        CYCLE/ON,FEDTO,-74.5,IPM,2.\nCYCLE/OFF\n"
    );
    assert_eq!(
        forms(&text),
        [
            "LOADTL / 62.0, OSETNO, 1.0",
            "SELCTL / 62.0",
            "FEDRAT / 250.0, MMPM",
            "CYCLE / DEEP, DEPTH, 72.0, STEP, 20.0, MMPM, 250.0, CLEAR, 3.0, RETURN, 0.0",
            "GOTO / 1.0, 2.0, 3.0",
            "CYCLE / DEEP, DEPTH, 74.5, STEP, 20.0, IPM, 2.0, CLEAR, 3.0, RETURN, 0.0",
            "CYCLE / OFF",
        ]
    );
    refused(&format!("{NX}CYCLE/DRILL,FEDTO,5.,MMPM,9.\n"), ClCode::BadPoint);
    refused(&format!("{NX}CYCLE/ON,FEDTO,-5.\n"), ClCode::MissingItem);
    refused(
        &format!("{NX}CYCLE/DRILL,FEDTO,-5.\nCYCLE/OFF\nCYCLE/ON,FEDTO,-5.\n"),
        ClCode::MissingItem,
    );
    let ffcam = "PPRINT/APTCL-SPEC,MAKINO-FF,1\nUNITS/MM\nSET/MODE,ABSOL\nFEDRAT/PERMIN,141\n";
    assert_eq!(forms(ffcam)[2], "FEDRAT / 141.0, MMPM");
    let inches = ffcam.replace("MM\n", "INCHES\n");
    assert_eq!(forms(&inches)[2], "FEDRAT / 141.0, IPM");
    for (text, inert) in [
        ("SET/MODE,ABSOL", true),
        ("SET/MODE,INCR", false),
        ("PPRINT/MOTION,CUT,TYPE,X", true),
        ("PPRINT/TOOL-POSITION,TOOL-NOSE", true),
        ("PPRINT/CALL THE FOREMAN", false),
    ] {
        assert_eq!(last(&format!("PPRINT/APTCL-SPEC,1\n{text}\n")).inert, inert, "{text}");
    }
    refused("PPRINT/APTCL-SPEC,1\nPPRINT/TOOL-POSITION,TOOL-CENTER\n", ClCode::UnclearPoints);
}

/// MANUAL says who typed the number of RTRCTO, and steps of one size are one step.
#[test]
fn cycles_of_nx_with_more_values() {
    const NX: &str = "TOOL PATH/A,TOOL,B\n";
    let one = |cycle: &str| forms(&format!("{NX}{cycle}\n"));
    let expected = one("CYCLE/DRILL,DEEP,STEP,2.,RAPTO,3.,FEDTO,-30.,RTRCTO,20.,MMPM,250.");
    for same in [
        "CYCLE/DRILL,DEEP,STEP,2.,RAPTO,3.,FEDTO,-30.,RTRCTO,20.,MANUAL,MMPM,250.",
        "CYCLE/DRILL,DEEP,STEP,2.,2.0,2.,RAPTO,3.,FEDTO,-30.,RTRCTO,20.,MMPM,250.",
        "cycle/drill,deep,rtrcto,20.,manual,step,2.,2.,rapto,3.,fedto,-30.,mmpm,250.",
    ] {
        assert_eq!(one(same), expected, "{same}");
    }
    // Steps of several sizes, and MANUAL without a number, are left for a section.
    for other in [
        "CYCLE/DRILL,DEEP,STEP,3.,2.,RAPTO,3.,FEDTO,-30.,MMPM,250.",
        "CYCLE/DRILL,RAPTO,3.,FEDTO,-30.,RTRCTO,MANUAL,MMPM,250.",
        "CYCLE/DRILL,RAPTO,3.,FEDTO,-30.,RTRCTO,20.,AUTO,MMPM,250.",
    ] {
        assert!(!one(other)[0].contains("DEPTH"), "{other}");
    }
}
