//! `filpost verify` on the way between the ends of motions.

use serde_json::{Value, json};

use crate::support::{Folder, Ran};

/// A table about X turns by 90 degrees while the tool goes along a line, so that its
/// tip makes a quarter circle of radius 100: off by 100 (1 - cos 45) = 29.2893.
const PART: &str = "UNITS / MM\nMULTAX / ON\nRAPID\nGOTO / 0, 0, 100, 0, 0, 1\n\
                    FEDRAT / 200, MMPM\nGOTO / 0, -100, 0, 0, -1, 0\n\
                    GOTO / 5, -100, 0, 0, -1, 0\nFINI\n";

const PROGRAM: &str = "%\nO0001\nN10 G21 G90 G94 G17\nN20 G0 X0. Y0. A0.\nN30 Z100.\n\
                       N40 G1 A90. F200.\nN50 X5.\nN60 M30\n%\n";

/// The middle of the line, (0, -50, 50), is 70.711 from the axis, at 45 degrees.
const HALF_WAY: &str = "N35 G1 Z70.711 A45. F200.\nN40 G1 Y0. Z100. A90. F200.\n";

const TABLE: [&str; 14] = [
    "-p",
    "fanuc-mill",
    "--option",
    "style=plain",
    "--set",
    "rotary.primary_kind=1",
    "--set",
    "rotary.primary_letter=A",
    "--set",
    "rotary.primary_axis=1",
    "--set",
    "rotary.tolerance=0",
    "--set",
    "rotary.feed=1",
];

fn verify(cl: &str, nc: &str, machine: &[&str], more: &[&str]) -> Ran {
    let place = Folder::new().with("part.ncl", cl).with("part.nc", nc);
    place.run(&[&["verify", "part.ncl", "part.nc"], machine, more].concat())
}

fn with_point_between() -> String {
    PROGRAM.replace("N40 G1 A90. F200.\n", HALF_WAY)
}

fn as_json(ran: &Ran) -> Value {
    serde_json::from_str(&ran.out).expect("JSON")
}

#[test]
fn how_far_the_tip_leaves_its_line_is_said() {
    let ran = verify(PART, PROGRAM, &TABLE, &[]);
    let said = "while the machine turns, the tip leaves its line by at most 29.2893 mm \
                (NC line 6), the tool its plane by at most 0 degrees (NC line 6)\n";
    assert!(ran.out.starts_with("part.nc agrees with part.ncl; 3 of 3 motions"), "{ran:?}");
    assert!(ran.out.ends_with(said) && ran.status == 0, "{ran:?}");
    let value = as_json(&verify(PART, PROGRAM, &TABLE, &["--format", "json"]));
    let max = value["between"]["position"]["max"].as_f64().expect("a number");
    assert!((max - 29.289_322).abs() < 2e-5, "{max}");
    assert_eq!(value["between"]["position"]["nc_line"], 6);
    assert_eq!(value["between"]["axis"]["nc_line"], 6);
    assert_eq!(value["findings"], json!([]));
}

#[test]
fn more_than_the_option_allows_is_a_finding() {
    let ran = verify(PART, PROGRAM, &TABLE, &["--between", "29"]);
    let said = "NC line 6 (CL line 6): the tip leaves its line by 29.2893 during the move, 29 is \
                allowed\n    N40 G1 A90. F200.\n";
    assert!(ran.out.starts_with(said) && ran.status == 1, "{ran:?}");
    assert_eq!(verify(PART, PROGRAM, &TABLE, &["--between", "29.2894"]).status, 0);
    let ran = verify(PART, PROGRAM, &TABLE, &["--between", "0.05", "--format", "json"]);
    assert_eq!(as_json(&ran)["findings"][0]["kind"], "between");
    assert_eq!(as_json(&ran)["verdict"], "differs");
}

#[test]
fn lintol_of_the_cl_file_is_the_limit_where_the_option_gives_none() {
    let lintol = |value: &str| PART.replace("MULTAX", &format!("LINTOL / {value}\nMULTAX"));
    let ran = verify(&lintol("0.02"), PROGRAM, &TABLE, &[]);
    assert!(
        ran.out.contains("29.2893 during the move, 0.02 is allowed") && ran.status == 1,
        "{ran:?}"
    );
    assert_eq!(verify(&lintol("0.02"), PROGRAM, &TABLE, &["--between", "30"]).status, 0);
    assert_eq!(verify(&lintol("0.02\nLINTOL / OFF"), PROGRAM, &TABLE, &[]).status, 0);
    assert_eq!(verify(&lintol("30"), PROGRAM, &TABLE, &[]).status, 0);
}

#[test]
fn what_is_no_length_is_wrong_usage() {
    for value in ["-1", "nan", "inf", "wide", ""] {
        let ran = verify(PART, PROGRAM, &TABLE, &[&format!("--between={value}")]);
        assert!(ran.status == 2 && ran.err.contains("--between"), "{value}: {ran:?}");
    }
}

#[test]
fn points_on_the_way_make_the_same_motion() {
    let program = with_point_between();
    let ran = verify(PART, &program, &TABLE, &[]);
    // From (100, 0 degrees) to (70.711, 45 degrees): r cos(45 - angle) - 70.711 is
    // 8.162 at r = 85.94, 21.6 degrees.
    assert!(ran.out.contains("agrees with part.ncl; 3 of 3") && ran.status == 0, "{ran:?}");
    assert!(ran.out.contains("leaves its line by at most 8.16"), "{ran:?}");
    assert_eq!(verify(PART, &program, &TABLE, &["--between", "8.2"]).status, 0);
    // Without the point the tip is off by more.
    assert_eq!(verify(PART, PROGRAM, &TABLE, &["--between", "8.2"]).status, 1);
}

#[test]
fn points_beside_the_way_are_found() {
    for (old, new, said) in [
        ("Z70.711", "Z70.721", "during the move the tip is 0.0103 off its line"),
        ("Z70.711", "Z30.", "line at feed"),
        ("A45.", "A-45.", "line at feed"),
        // The tip is on its line, the tool turned the other way.
        (
            "Z70.711 A45.",
            "Y-70.711 Z0. A-45.",
            "during the move the tool axis is not between its end positions",
        ),
    ] {
        let ran = verify(PART, &with_point_between().replace(old, new), &TABLE, &[]);
        assert!(ran.out.contains(said) && ran.status == 1, "{new}: {ran:?}");
    }
}

#[test]
fn a_line_of_three_axes_may_stand_in_parts() {
    let cl = "UNITS / MM\nRAPID\nGOTO / 0, 0, 5\nFEDRAT / 200, MMPM\nGOTO / 10, 20, -2\nFINI\n";
    let program = |on_the_way: &str| {
        format!(
            "%\nO0001\nN10 G21 G90 G94 G17\nN20 G0 X0. Y0.\nN30 Z5.\n{on_the_way}\
             N60 G1 X10. Y20. Z-2. F200.\nN70 M30\n%\n"
        )
    };
    let mill = ["-p", "fanuc-mill", "--option", "style=plain"];
    let whole = verify(cl, &program(""), &mill, &["--format", "json"]);
    assert_eq!(as_json(&whole)["between"], Value::Null);
    // A third of the way is 3.3333, 6.6667, 2.6667, as it is rounded.
    let parts = "N40 G1 X3.333 Y6.667 Z2.667 F200.\nN50 X6. Y12. Z0.8\n";
    let ran = verify(cl, &program(parts), &mill, &["--between", "0"]);
    assert!(ran.out.contains("agrees with part.ncl; 2 of 2") && ran.status == 0, "{ran:?}");
    for (old, new, said) in [
        ("Y6.667", "Y6.669", "during the move the tip is 0.00"),
        ("X6. Y12. Z0.8", "X3. Y6. Z2.9", "asks for no line at feed"),
        ("N50 X6", "N50 G0 X6", "asks for no"),
        ("F200.\nN50", "F100.\nN50", "feed 100 mm/min, it should be 200 mm/min"),
        ("Z0.8", "Z-60.", "asks for no line at feed"),
    ] {
        let ran = verify(cl, &program(&parts.replace(old, new)), &mill, &[]);
        assert!(ran.out.contains(said) && ran.status == 1, "{new}: {ran:?}");
    }
}

#[test]
fn a_program_with_fil_is_looked_at_block_by_block() {
    let place = Folder::new()
        .with("part.ncl", PART)
        .with("post.fil", "CIMFIL/ON,STOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n");
    let run = |command: &[&str]| place.run(&[command, &TABLE, &["-f", "post.fil"]].concat());
    assert_eq!(run(&["post", "part.ncl", "-o", "part.nc"]).status, 0);
    let ran = run(&["verify", "part.ncl", "part.nc"]);
    assert!(ran.out.contains("does what a second run of the post makes"), "{ran:?}");
    assert!(ran.out.contains("leaves its line by at most 29.2893 mm"), "{ran:?}");
    let ran = run(&["verify", "part.ncl", "part.nc", "--between", "1"]);
    assert!(
        ran.out.contains("29.2893 during the move, 1 is allowed") && ran.status == 1,
        "{ran:?}"
    );
}

const ONE_TOOL: &str = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nRAPID\nGOTO / 0, 0, 50\n\
                        FEDRAT / 200, MMPM\nGOTO / 0, 0, -1\nRAPID\nGOTO / 0, 0, 50\nFINI\n";

/// As another post may have written it: no safe start, and no retract at the end.
const OF_OTHERS: &str = "%\nO0001\nN10 G21 G90 G94 G17\nN20 T1 M6\nN30 S900 M3\nN40 G0 X0. Y0.\n\
                         N50 G43 Z50. H1\nN60 G1 Z-1. F200.\nN70 G0 Z50.\nN80 M30\n%\n";

const NOTE: &str = "compared with --option style=plain";

#[test]
fn a_program_without_retracts_is_compared_with_the_plain_style() {
    let ran = verify(ONE_TOOL, OF_OTHERS, &["-p", "fanuc-mill"], &[]);
    assert!(ran.status == 0 && ran.err.contains(NOTE), "{}{}", ran.out, ran.err);
    let deeper = OF_OTHERS.replace("Z-1.", "Z-2.");
    let ran = verify(ONE_TOOL, &deeper, &["-p", "fanuc-mill"], &[]);
    assert!(ran.status == 1 && ran.err.contains(NOTE), "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("1 finding"), "{}", ran.out);
    let style = ["--option", "style=production"];
    let ran = verify(ONE_TOOL, OF_OTHERS, &["-p", "fanuc-mill"], &style);
    assert!(ran.status == 1 && !ran.err.contains(NOTE), "{}{}", ran.out, ran.err);
}

#[test]
fn a_production_program_that_lacks_one_retract_is_found() {
    let place = Folder::new().with("part.ncl", ONE_TOOL);
    place.run(&["post", "part.ncl", "-p", "haas-mill", "-o", "part.nc"]);
    let nc = place.text("part.nc").unwrap_or_default();
    let retracts: Vec<&str> = nc.lines().filter(|line| line.contains("G53 G0 Z0.")).collect();
    assert_eq!(retracts.len(), 2, "{nc}");
    for retract in retracts {
        let ran =
            verify(ONE_TOOL, &nc.replace(&format!("{retract}\n"), ""), &["-p", "haas-mill"], &[]);
        assert!(ran.status == 1 && !ran.err.contains(NOTE), "{}{}", ran.out, ran.err);
    }
}

#[test]
fn a_cl_file_in_place_of_the_program_is_named() {
    let ran = verify(PROGRAM, PART, &["-p", "fanuc-mill"], &[]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert!(ran.err.contains("takes the CL file first, then the program"), "{}", ran.err);
}
