//! Texts of all dialects as texts of Creo.

use std::io::Cursor;

use fil_cl::{ClCode, Converted, Options, to_ncl, words};
use fil_diag::{Code, Diag};

fn converted(text: &str) -> Result<(String, Converted), Box<Diag>> {
    converted_with(text, None)
}

fn converted_with(
    text: &str,
    unit: Option<fil_cl::WordId>,
) -> Result<(String, Converted), Box<Diag>> {
    let mut output = Cursor::new(Vec::new());
    let done = to_ncl(Cursor::new(text), "t", Options::default(), unit, &mut output)?;
    Ok((String::from_utf8(output.into_inner()).unwrap(), done))
}

/// The statements behind the header.
fn statements(text: &str) -> Vec<String> {
    let (ncl, done) = converted(text).unwrap_or_else(|diag| panic!("{diag}\n{text}"));
    let lines: Vec<String> = ncl.lines().map(|line| line.trim_end().to_string()).collect();
    assert_eq!(lines[0], "$$*          Pro/CLfile");
    assert_eq!(lines.len() as u64 - 1, done.statements, "{ncl}");
    lines[1..].to_vec()
}

fn refused(text: &str, line: u32) -> Box<Diag> {
    let diag = converted(text).expect_err("refused");
    assert_eq!(*diag.code, *<&Code>::from(ClCode::Unwritable), "{diag}");
    assert_eq!(diag.spans[0].line, line, "{diag}");
    diag
}

#[test]
fn words_without_effect_become_notes() {
    let nx = "TOOL PATH/A,TOOL,MILL 5\nTLDATA/MILL,5.,0.,50.,0.,0.\nPAINT/COLOR,31\n\
        LOAD/TOOL,3,ADJUST,4\nFEDRAT/MMPM,250.\nRAPID\nGOTO/1.,2.,3.,0.,0.,1.\nGOTO/4,5,6\n\
        CIRCLE/4.,6.,6.,0.,0.,1.,1.,.06,.5,40.,1.\nGOTO/4.,7.,6.\nEND-OF-PATH\n";
    assert_eq!(
        statements(nx),
        [
            "TPRINT / MILL 5",
            "$$ TOOL PATH / A,TOOL,MILL 5",
            "$$-> TLDATA / MILL, 5.0, 0.0, 50.0, 0.0, 0.0",
            "UNITS / MM",
            "CUTTER / 5.0",
            "$$-> PAINT / COLOR, 31.0",
            "LOADTL / 3.0, OSETNO, 4.0",
            "FEDRAT / 250.0, MMPM",
            "RAPID",
            "GOTO / 1.0, 2.0, 3.0, 0.0, 0.0, 1.0",
            "GOTO / 4.0, 5.0, 6.0, 0.0, 0.0, 1.0",
            "CIRCLE / 4.0, 6.0, 6.0, 0.0, 0.0, -1.0, 1.0",
            "GOTO / 4.0, 7.0, 6.0, 0.0, 0.0, 1.0",
            "$$-> END-OF-PATH /",
            "FINI",
        ]
    );
}

#[test]
fn circles_get_their_radius() {
    let solidworks = "CSI_SET_FLUTE_LENGTH/22.\nGOTO/3.,0.,0.\nCIRCLE/0.,0.,5.,0,0,1\nGOTO/0,3,0\n\
        CIRCLE/0.,0.,5.,0,0,1\nGOTO/-3,0,0\nFINI\n";
    let circle = "CIRCLE / 0.0, 0.0, 5.0, 0.0, 0.0, 1.0, 3.0";
    let found = statements(solidworks);
    assert_eq!([&found[2], &found[4]], [circle, circle]);
    let unknown = "CSI_SET_FLUTE_LENGTH/22.\nCIRCLE/0.,0.,5.,0,0,1\nGOTO/0,3,0\nFINI\n";
    refused(unknown, 2);
    // GODLTA and GOHOME end where only the post knows.
    for leaves in ["GODLTA/1.,0,0", "GOHOME\nGOTO/3,0,0\nGOHOME"] {
        let text = solidworks.replacen("GOTO/0,3,0", leaves, 1);
        assert!(converted(&text).is_err(), "{leaves}");
    }
}

#[test]
fn texts_and_long_lists() {
    let solidworks = "CSI_SET_FLUTE_LENGTH/22.\nINSERT/6MM DRILL, $5\nINSERT/G53 Z0\nFINI\n";
    assert_eq!(statements(solidworks)[1..], ["PPRINT / 6MM DRILL, $5", "INSERT / G53 Z0", "FINI"]);
    let ncl = "REMARK part.as  NCLCAM 2020\nCUTTER/ .75,.125,.25,.125,0,0,2.25\nFINI\n";
    assert_eq!(
        statements(ncl),
        [
            "$$ REMARK / part.as  NCLCAM 2020",
            "CUTTER / 0.75, 0.125, 0.25, 0.125, 0.0, 0.0, 2.25",
            "FINI"
        ]
    );
    let long = format!("BOX/0,0,0,1,1,1\nCSYS/{}0\nFINI\n", "1.23456789,".repeat(20));
    let (text, _) = converted(&long).unwrap();
    assert!(text.lines().all(|line| line.len() <= 72), "{text}");
    assert!(text.contains(",  $\n"));
}

/// The digits are the shortest that read back as the same number, in fixed point.
#[test]
fn numbers_are_exact() {
    let numbers = "GOTO/0.1000000000000000055,1e-7,-0.000001234567890123\nFINI\n";
    let expected = "GOTO / 0.1, 0.0000001, -0.000001234567890123";
    assert_eq!(statements(numbers)[0], expected);
}

#[test]
fn catia_lists_and_arcs() {
    let catia = "$$*CATIA0\nCHANNEL,1\nCATMAT/1.,0.,MY PART\nCUTTER/ 1.,0.,\nTPRINT/CUTTER 1,,\n\
        TOOLNO/1,   16.000000\nLOADTL/3,ADJUST,,TURN\nMULTAX/ON\nFEDRAT/ 0.1,MMPR\n\
        GOTO/20.4,0,-30\nAUTOPS\nINDIRV/0,0,1\n\
        TLON,GOFWD/ (CIRCLE/ 25.,0.,-30.,$\n 4.6),ON,(LINE/ 25.,0.,-30.,$\n 25.,0.,-25.4)\n\
        SYNC/,,,\nREWIND/0\nEND\n";
    assert_eq!(
        statements(catia),
        [
            "$$-> CHANNEL / 1.0",
            "$$-> CATMAT / 1.0, 0.0, MY PART",
            "CUTTER / 1.0, 0.0",
            "$$ TPRINT / CUTTER 1,,",
            "$$-> TOOLNO / 1.0, 16.0",
            "LOADTL / 3.0",
            "MULTAX / ON",
            "FEDRAT / 0.1, MMPR",
            "GOTO / 20.4, 0.0, -30.0, 0.0, 0.0, 1.0",
            "$$-> AUTOPS /",
            "CIRCLE / 25.0, 0.0, -30.0, 0.0, 1.0, 0.0, 4.6",
            "GOTO / 25.0, 0.0, -25.4, 0.0, 0.0, 1.0",
            "$$-> SYNC /",
            "REWIND / 0.0",
            "FINI",
        ]
    );
}

/// A statement that another system's files have, and not Creo's, is not written into one.
#[test]
fn what_is_a_sign_of_another_system_is_refused() {
    let diag = refused("CSI_SET_A/1\nTRNTYP/LOCAL,1,2,3\nFINI\n", 1);
    assert!(diag.message.contains("read back"), "{diag}");
    refused("TRNTYP/WORLD,0,0,0\nTRNTYP/LOCAL,1,2,3\nFINI\n", 2);
}

#[test]
fn a_unit_is_added_where_it_is_missing() {
    let text = "PARTNO/7\nPAINT/A\nFEDRAT/MMPM,5.\nGOTO/1.,2.,3.\n";
    let unit = Some(words::INCHES);
    let (with, _) = converted_with(text, unit).unwrap();
    assert!(with.contains("$$-> PAINT / A\nUNITS / INCHES\nFEDRAT / 5.0, MMPM\n"), "{with}");
    let said = text.replace("PAINT/A\n", "PAINT/A\nUNITS/MM\n");
    let (with, _) = converted_with(&said, unit).unwrap();
    assert_eq!(with.matches("UNITS").count(), 1, "{with}");
}

/// A text of Creo stays what it is, without its comments.
#[test]
fn creo_again() {
    let text = "$$*          Pro/CLfile\n$$-> MFGNO / PART\nPARTNO / PART\nUNITS / MM\n\
        $$-> CUTTER / 10.0\nGOTO / 1.0, 2.0, 3.0\nFINI \n";
    assert_eq!(converted(text).unwrap().0, text);
    let (again, _) = converted(&text.replace("UNITS", "$$ a comment\nUNITS")).unwrap();
    assert_eq!(again, text);
    // What is cut off stays so: the end is not made up.
    let open = text.replace("FINI \n", "");
    assert_eq!(converted(&open).unwrap().0, open);
}
