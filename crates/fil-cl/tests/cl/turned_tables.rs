//! Points that turn with the table, cycles by position, and what else statements of the
//! dialects become.

use fil_cl::{ClCode, Options, Reader, Record, Vocabulary, Writer};
use fil_diag::{Code, Diag};

/// The records of a text as statements of Creo.
fn written(text: &str) -> Result<Vec<String>, Box<Diag>> {
    let mut reader = Reader::new(text.as_bytes(), "t", Options::default());
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut writer = Writer::new(Vec::new());
    while reader.read(&mut vocab, &mut record)? {
        if !record.inert {
            writer.write(&record, &vocab)?;
        }
    }
    let text = String::from_utf8_lossy(&writer.into_inner()).replace("  $\n", " ");
    Ok(text.lines().map(str::to_string).collect())
}

fn refused(text: &str, code: ClCode) {
    let diag = written(text).expect_err(text);
    let code: &Code = code.into();
    assert_eq!(diag.code, code, "{text}: {diag}");
}

/// The numbers of the statements behind TLAXIS.
fn numbers(text: &str) -> Vec<Vec<f64>> {
    let lines = written(text).unwrap_or_else(|diag| panic!("{diag}\n{text}"));
    let behind = lines.into_iter().skip_while(|line| !line.starts_with("TLAXIS")).skip(1);
    let of = |line: String| line.split([',', '/']).filter_map(|n| n.trim().parse().ok()).collect();
    behind.map(of).collect()
}

fn near(found: &[f64], expected: &[f64]) -> bool {
    found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5)
}

const CAMWORKS: &str = "BOX/0,0,0,1,1,1\n";

/// A turn about X brings Z along -Y and Y along Z; about Y, Z along X and X along -Z.
#[test]
fn points_of_a_turned_table() {
    let about_x = format!(
        "{CAMWORKS}TLAXIS/0,-1,0\nROTABL/ 1.570796,AAXIS,TABLE,CCLW\nROTABL/-0.0,BAXIS,TABLE,CCLW\n\
         GOTO/1,2,3\nCIRCLE/0,2,3,0,0,1,1,COUNTERCLOCKWISE\nGOTO/0,3,3\n"
    );
    let found = numbers(&about_x);
    assert!(near(&found[0], &[1.0, -3.0, 2.0, 0.0, -1.0, 0.0]), "{found:?}");
    assert!(near(&found[1], &[0.0, -3.0, 2.0, 0.0, -1.0, 0.0, 1.0]), "{found:?}");
    assert!(near(&found[2], &[0.0, -3.0, 3.0, 0.0, -1.0, 0.0]), "{found:?}");
    let (sine, cosine) = libm::sincos(0.5);
    for turn in ["ROTABL/ 0.5,BAXIS,TABLE,CCLW", "ROTABL/TABLE,BAXIS,CLW,-28.64789"] {
        let text =
            format!("{CAMWORKS}TLAXIS/{sine:.6},0,{cosine:.6}\n{turn}\nGOTO/1,2,3\nGOTO/4,5,6\n");
        let found = numbers(&text);
        let expected = |x: f64, y: f64, z: f64| {
            [cosine * x + sine * z, y, cosine * z - sine * x, sine, 0.0, cosine]
        };
        assert!(near(&found[0], &expected(1.0, 2.0, 3.0)), "{turn}: {found:?}");
        assert!(near(&found[1], &expected(4.0, 5.0, 6.0)), "{turn}: {found:?}");
    }
}

/// Turned, turned back and turned again for the next operation.
#[test]
fn turns_are_added_up() {
    let turn = "ROTABL/ 1.570796,AAXIS,TABLE,CCLW\n";
    let back = "ROTABL/ -1.570796,AAXIS,TABLE,CCLW\n";
    let text = format!("{CAMWORKS}TLAXIS/0,-1,0\n{turn}GOTO/1,2,3\n{back}{turn}GOTO/1,2,4\n");
    let found = numbers(&text);
    assert!(near(&found[1], &[1.0, -4.0, 2.0, 0.0, -1.0, 0.0]), "{found:?}");
}

#[test]
fn a_turn_that_the_file_does_not_prove_is_refused() {
    let x = "ROTABL/ 1.570796,AAXIS,TABLE,CCLW\n";
    let (y, z) = (x.replace("AAXIS", "BAXIS"), x.replace("AAXIS", "CAXIS"));
    for statements in [
        // No TLAXIS, another one, the opposite one, none of the turns.
        format!("{x}GOTO/1,2,3\n"),
        format!("TLAXIS/1,0,0\n{x}GOTO/1,2,3\n"),
        format!("TLAXIS/0,1,0\n{x}GOTO/1,2,3\n"),
        "TLAXIS/0,-1,0\nGOTO/1,2,3\n".to_string(),
        // How the part lies about the tool is not proved.
        format!("TLAXIS/0,0,1\n{z}GOTO/1,2,3\n"),
        format!("TLAXIS/0,-1,0\n{x}{z}GOTO/1,2,3\n"),
        format!("TLAXIS/0,-1,0\n{x}{y}GOTO/1,2,3\n"),
        // Where the origin of a second position lies is not in the file.
        format!("GOTO/1,2,3\nTLAXIS/0,-1,0\n{x}GOTO/1,2,3\n"),
        format!("TLAXIS/0,-1,0\n{x}GOTO/1,2,3\n{x}TLAXIS/0,0,-1\nGOTO/1,2,3\n"),
        format!("TLAXIS/0,0,-1\n{x}{x}GOTO/1,2,3\n{x}{x}{y}{y}GOTO/1,2,3\n"),
        format!("TLAXIS/0,-1,0\n{x}GOTO/1,2,3\nROTABL/-1.570796,AAXIS,TABLE,CCLW\nGOTO/1,2,3\n"),
        // Motions of other kinds.
        format!("TLAXIS/0,-1,0\n{x}GOTO/1,2,3,0,0,1\n"),
        format!("TLAXIS/0,-1,0\n{x}GODLTA/1,2,3\n"),
        format!("TLAXIS/0,-1,0\n{x}GOHOME/1,2,3\n"),
    ] {
        refused(&format!("{CAMWORKS}{statements}"), ClCode::UnclearFrame);
    }
    let upright = format!("{CAMWORKS}TLAXIS/0,0,1\nROTABL/0,AAXIS,TABLE,CCLW\nGOTO/1,2,3\n");
    assert_eq!(numbers(&upright), [[1.0, 2.0, 3.0]]);
    let five_axes = "CSI_SET_A/1\nTLAXIS/0,-1,0\nGOTO/1,2,3,1,0,0\n";
    assert_eq!(numbers(five_axes), [[1.0, 2.0, 3.0, 1.0, 0.0, 0.0]]);
}

#[test]
fn cycles_of_creo_by_position() {
    for sign in ["", "$$-> END /\n"] {
        for (values, expected) in [
            ("DRILL,5,100,MMPM", "DRILL, DEPTH, 5.0, MMPM, 100.0"),
            ("DRILL,5,100,MMPM,2", "DRILL, DEPTH, 5.0, MMPM, 100.0, CLEAR, 2.0"),
            ("BORE,5,.1,IPR,0,2,0", "BORE, DEPTH, 5.0, IPR, 0.1, CLEAR, 2.0"),
            ("FACE,5,100,MMPM,,2", "FACE, DEPTH, 5.0, MMPM, 100.0, CLEAR, 2.0"),
            ("DEEP,9,4,IPM,.1,3", "DEEP, DEPTH, 9.0, STEP, 3.0, IPM, 4.0, CLEAR, 0.1"),
            ("BRKCHP,9,4,IPM,,.1,3", "BRKCHP, DEPTH, 9.0, STEP, 3.0, IPM, 4.0, CLEAR, 0.1"),
            ("TAP,9,.05,IPR,20,2", "TAP, DEPTH, 9.0, TPI, 20.0, CLEAR, 2.0"),
            ("TAP,9,1.5,MMPR,0,2,0", "TAP, DEPTH, 9.0, MMPR, 1.5, CLEAR, 2.0"),
            ("DRILL,DEPTH,5,MMPM,100", "DRILL, DEPTH, 5.0, MMPM, 100.0"),
        ] {
            let lines = written(&format!("{sign}CYCLE/{values}\n")).unwrap();
            assert_eq!(lines.last().unwrap(), &format!("CYCLE / {expected}"), "{values}");
        }
    }
    for (values, code) in [
        ("DRILL,-5,100,MMPM,2", ClCode::BadPoint),
        ("DRILL,5,100,MMPM,-2", ClCode::BadPoint),
        ("DEEP,5,100,MMPM,2,-1", ClCode::BadPoint),
        ("TAP,5,.1,IPR,20,2", ClCode::BadPoint),
        ("DRILL,5,100,MMPM,2,1", ClCode::MissingItem),
        ("DRILL,5,100,MMPM,20,2,0", ClCode::MissingItem),
        ("DRILL,5,100,MMPM,0,2,1", ClCode::MissingItem),
        ("DEEP,5,100,MMPM,2", ClCode::MissingItem),
        ("TAP,5,.1,IPR,20", ClCode::MissingItem),
        ("TAP,5,100,IPM,20,2", ClCode::MissingItem),
        ("DRILL,5,100,MMPM,2,DWELL", ClCode::MissingItem),
    ] {
        refused(&format!("CYCLE/{values}\n"), code);
    }
}

/// The diameter of a tool comes as CUTTER, where Creo has it in a comment.
#[test]
fn diameters_of_nx() {
    for (tool, diameter) in [
        ("MILL,25.0,0.0,75.0,0.0,0.0", Some("25.0")),
        ("DRILL,MILL,63.0,0.0,239.0,178.0,35.0", Some("63.0")),
        ("TURN,0.8,0.0,0.0", None),
        ("MILL,0.0,0.0,75.0", None),
    ] {
        let found = written(&format!("TLDATA/{tool}\n")).unwrap();
        let expected: Vec<String> = diameter.map(|d| format!("CUTTER / {d}")).into_iter().collect();
        assert_eq!(found, expected, "{tool}");
    }
}

#[test]
fn cycles_of_nx_that_end_at_their_start() {
    for (values, expected) in [
        ("DRILL,RAPTO,3.,FEDTO,0.,MMPM,9.", "DRILL, FEDTO, 0.0, MMPM, 9.0, CLEAR, 3.0"),
        ("CSINK,RAPTO,3.,FEDTO,-2.,MMPM,9.", "CSINK, DEPTH, 2.0, MMPM, 9.0, CLEAR, 3.0"),
    ] {
        let lines = written(&format!("PAINT/PATH\nCYCLE/{values}\n")).unwrap();
        assert_eq!(lines, [format!("CYCLE / {expected}")]);
    }
    refused("PAINT/PATH\nCYCLE/FACE,RAPTO,3.,FEDTO,2.,MMPM,9.\n", ClCode::BadPoint);
}

/// Words of a shop's table may have a comma in place of the slash; known words may not.
#[test]
fn words_of_a_shop_in_catia() {
    let sign = "$$*CATIA0\n";
    let lines = written(&format!("{sign}TEMPO,,LF\n")).unwrap();
    assert_eq!(lines, ["TEMPO / , LF"]);
    refused(&format!("{sign}GOTO,1,2,3\n"), ClCode::BadWord);
    refused("TEMPO,,LF\n", ClCode::BadWord);
    for values in ["-10.,2.", "0.,2.", "10.,-1.", "-10.,2.,100.,MMPM"] {
        refused(&format!("{sign}CYCLE/DRILL,{values}\n"), ClCode::BadPoint);
    }
}

#[test]
fn modes_of_nx() {
    assert_eq!(written("PAINT/PATH\nSET/MODE,ABSOL\n").unwrap(), [""; 0]);
    assert_eq!(written("PAINT/PATH\nSET/MODE,INCR\n").unwrap(), ["SET / MODE, INCR"]);
}

/// A tool axis that GOHOME writes is that of the motions after it.
#[test]
fn gohome_keeps_its_tool_axis() {
    let text = "PAINT/PATH\nGOTO/1,2,3,0,0,1\nGOHOME/1,2,3,1,0,0\nGOTO/4,5,6\n";
    assert_eq!(written(text).unwrap()[2], "GOTO / 4.0, 5.0, 6.0, 1.0, 0.0, 0.0");
}

/// MODE/XYPLAN names the plane of an arc by geometry, PERMIN is a minute.
#[test]
fn words_of_other_writers_of_apt() {
    let text = "UNITS/MM\nFEDRAT/PERMIN,100\nFEDRAT/PERREV,.1\nMODE/XYPLAN\nAUTOPS\n";
    assert_eq!(written(text).unwrap()[1..], ["FEDRAT / 100.0, MMPM", "FEDRAT / 0.1, MMPR"]);
    assert_eq!(written("MODE/MILL\n").unwrap(), ["MODE / MILL"]);
}
