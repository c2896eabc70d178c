//! What the back-check says of ways that the CL file leaves to the machine: to an unknown place,
//! before the machine turns, while it repositions, to positions of the machine, to polar
//! interpolation.

use fil_nc::verify::Allowed;
use filpost_tests::back_check;
use filpost_tests::nc_cases::{self, NcCase};

/// The findings of a program of a case in which a piece of text is another.
fn said(case: &NcCase, old: &str, new: &str) -> String {
    assert!(case.nc.contains(old), "{}: no {old} in\n{}", case.name, case.nc);
    let nc = case.nc.replacen(old, new, 1);
    let cl = String::from_utf8(case.cl.clone()).expect("a text");
    match back_check::check(case.post.commons(), &cl, &nc, Allowed::default()) {
        Ok(report) => report.findings.iter().map(|finding| format!("{finding}\n")).collect(),
        Err(refused) => refused.to_string(),
    }
}

#[test]
fn a_fault_on_a_way_that_no_record_names_is_found() {
    let cases = nc_cases::all();
    for (name, old, new, message) in [
        (
            "heidenhain-tnc640/holes.ncl.1",
            "5 L X+0 Y+0 R0 FMAX",
            "5 L Y+0 R0 FMAX",
            "rapid goes to its height before X and Y have arrived",
        ),
        // A change is a program of the builder, which may leave X and Y elsewhere.
        ("corpus/klartext/tools", "\n16 L X+30 Y+0 FMAX", "", "it should be a rapid"),
        // What ends or stops the program before its end.
        ("corpus/klartext/tools", "\n7 L", "\n7 M30\n7 L", "the program has ended before this"),
        ("corpus/klartext/tools", "\n7 L", "\n7 STOP\n7 L", "M0: neither the CL file nor"),
        ("corpus/klartext/tools", "\n7 L", "\n7 M91\n7 L", "nothing takes it"),
        ("corpus/sinumerik/tools", "\nN170 G0 X30 Y0", "\nN170 G0", "it should be a rapid"),
        (
            "words/rotary-tilted-frame-after-a-way-up",
            "G0 Z200.\n",
            "G0\n",
            "the machine turns at Z34.66, the tool must have gone up to Z200 before",
        ),
        // A part of a rapid that is on no way to its end, from an unknown place too.
        (
            "corpus/mills/mach4-mill/offsets",
            "N110 Z20.",
            "N105 Z-1.\nN110 Z20.",
            "not on a path to its",
        ),
        ("corpus/sinumerik/tools", "\nN60 Z50", "\nN55 Z-30\nN60 Z50", "not on a path to its"),
        (
            "corpus/sinumerik/tapping",
            "N150 X0 Y0",
            "N145 X=IC(1)\nN150 X0 Y0",
            "not on a path to its",
        ),
        (
            "corpus/posts/fanuc-5x-tables/faces",
            "N140 X-14.537",
            "N135 A1.\nN140 X-14.537",
            "not on a path to its end",
        ),
        (
            "corpus/posts/fanuc-5x-head/holes",
            "N60 X7.519",
            "N55 B1.\nN60 X7.519",
            "not on a path to",
        ),
        (
            "heidenhain-tnc640/holes.ncl.1",
            "26 L X+0 Y+0 FMAX",
            "26 L Y+0 FMAX",
            "before X and Y have",
        ),
        // Down before the machine has turned.
        (
            "corpus/posts/linuxcnc-5x/faces",
            "N110 A-18. C10.\nN120 Z78.5378",
            "N110 Z78.5378\nN120 A-18. C10.",
            "rapid plunges before the rotary axes have arrived",
        ),
        // A hole in a work offset in which no word has said where the tool stands.
        (
            "words/set-ofsetl-in-a-cycle-ends-it",
            "G55\nG99 G81 X1.",
            "G55\nG99 G81",
            "moves before all axes",
        ),
        // An axis that would stand at zero if anybody had said where it stands.
        (
            "words/trans-of-the-control-and-the-frame-of-the-machine",
            "G53 G0 Z0 D0\n",
            "",
            "goes to another position of the machine",
        ),
        // What ends a frame within tool-tip control, and a call of a tool that calls none.
        ("corpus/posts/sinumerik-5x/swarf", "N80 G1", "N75 CYCLE800()\nN80 G1", "the end of a"),
        ("corpus/posts/heidenhain-5x/swarf", "\n7 L", "\n6 PLANE RESET STAY\n7 L", "the end of a"),
        ("corpus/klartext/tools", "\n7 L", "\n7 TOOL CALL Z\n7 L", "a tool, a speed or a feed"),
        // The function of a tool change that a turret does not have.
        ("corpus/lathe/fanuc-mill-turn/turn-then-drill", "M30", "M6\nM30", "M6: neither the CL"),
        (
            "corpus/sinumerik/machine-positions",
            "N20 G53 G0 Z0 D0",
            "N20 G53 G0 Z0 D1",
            "D1 is active in a move to machine coordinates, and its length shifts the move",
        ),
        (
            "corpus/sinumerik/machine-positions",
            "N100 G53 G0 Z0 D0",
            "N100 G53 G0 Z0",
            "D1 is active",
        ),
        (
            "corpus/lathe/fanuc-mill-turn/compensated",
            "M30",
            "M30 S77",
            "the spindle has 77 rpm, none is asked for",
        ),
        (
            "corpus/lathe/fanuc-mill-turn/turn-then-drill",
            "T0505",
            "T0505 S77",
            "the spindle has 77 rpm, none is asked for",
        ),
        // A plane that nobody has asked for, whose normal the length of the tool acts along.
        ("corpus/sinumerik/tools", "N60 Z50", "N60 G18 Z50", "G18 of line 7 is in force"),
        ("corpus/sinumerik/tools", "\nN70 G1", "\nN65 G19\nN70 G1", "G19 of line 8 is in force"),
        ("corpus/sinumerik/planes", "N60 Z50", "N60 G19 Z50", "G19 of line 7 is active"),
        ("corpus/mills/fanuc-mill/tools", "G43", "G18 G43", "G18 of line"),
        ("words/cutcom-after-an-arc-in-another-plane", "G17\n", "", "G18 of line"),
        // A zero that nobody has asked to move, and tolerances that nobody has asked for.
        ("corpus/sinumerik/tools", "\nN170 G0", "\nN165 TRANS X10\nN170 G0", "has moved the zero"),
        ("corpus/sinumerik/tools", "\nN60 Z50", "\nN55 ATRANS Z-10\nN60 Z50", "has moved the zero"),
        (
            "corpus/sinumerik/texts",
            "\nN130",
            "\nN125 ATRANS Y10\nN130 G0 Y0\nN131",
            "has moved the zero",
        ),
        ("corpus/sinumerik/tools", "\nN170 G0", "\nN165 AROT RPL=30\nN170 G0", "is not followed"),
        ("corpus/sinumerik/tools", "\nN170 G0", "\nN165 SCALE X2\nN170 G0", "is not followed"),
        ("corpus/sinumerik/tools", "\nN170 G0", "\nN165 MIRROR X0\nN170 G0", "is not followed"),
        (
            "corpus/klartext/tools",
            "\n16 L",
            "\n15 CYCL DEF 7.0 DATUM SHIFT\n15 CYCL DEF 7.1 X+10\n16 L",
            "has moved the zero",
        ),
        (
            "corpus/klartext/tools",
            "\n16 L",
            "\n15 CYCL DEF 7.0 DATUM SHIFT\n15 CYCL DEF 7.1\n16 L",
            "a datum shift needs an axis",
        ),
        (
            "corpus/klartext/tools",
            "\n16 L",
            "\n15 CYCL DEF 7.1 X+1\n16 L",
            "without its first line",
        ),
        ("corpus/klartext/tools", "\n16 L", "\n15 CYCL DEF 7.0\n16 L", "without its values"),
        ("corpus/klartext/tools", "\n16 L", "\n15 CYCL DEF 9.0\n16 L", "without its values"),
        ("corpus/klartext/tools", "\n16 L", "\n15 CYCL DEF 32.0\n16 L", "without its values"),
        (
            "corpus/klartext/tools",
            "\n16 L",
            "\n15 CYCL DEF 32.0 TOLERANCE\n15 CYCL DEF 32.1 T0.05\n16 L",
            "line 18 changes how the path is followed, which no record asks for",
        ),
        // How closely and how smoothly the path is followed.
        (
            "corpus/sinumerik/tools",
            "\nN170 G0",
            "\nN165 CYCLE832(0.05,0,1)\nN170 G0",
            "is followed",
        ),
        ("corpus/sinumerik/tools", "\nN170 G0", "\nN165 G642 SOFT\nN170 G0", "is followed"),
        ("corpus/sinumerik/tools", "\nN170 G0", "\nN165 CFC\nN170 G0", "is followed"),
        ("corpus/mills/fanuc-mill/tools", "G43", "G64 G43", "changes how the path is followed"),
        ("corpus/klartext/tools", "\n16 L", "\n15 CYCL DEF 10.1 ROT+35\n16 L", "is not followed"),
        ("corpus/sinumerik/orient", "N120 M5", "N120 M5 S77", "the spindle has 77 rpm"),
        (
            "words/rotary-limit-retracts-and-returns",
            "M5\n",
            "",
            "the spindle should stand while the machine turns",
        ),
        (
            "words/rotary-limit-retracts-and-returns",
            "M9\n",
            "",
            "coolant should be off while the machine turns",
        ),
        (
            "words/rotary-limit-retracts-and-returns",
            "Z4.508",
            "Z3.508",
            "from the part, it should stay 5 away",
        ),
        (
            "corpus/posts/fanuc-5x-tables/repos-macro",
            "Z62.809",
            "Z32.809",
            "the CL file asks for no",
        ),
        ("corpus/posts/fanuc-5x-tables/repos-macro", "N190 M3\n", "", "the spindle"),
        (
            "corpus/lathe/fanuc-mill-turn/polar-square",
            "G0 X83.522 C0.",
            "G0 X83.523 C0.",
            "which is not on a path to its end",
        ),
    ] {
        let case = cases.iter().find(|case| case.name == name);
        let case = case.unwrap_or_else(|| panic!("no case {name}"));
        assert!(said(case, old, old).is_empty(), "{name}: {}", said(case, old, old));
        let found = said(case, old, new);
        assert!(found.contains(message), "{name}, `{old}` is `{new}`:\n{found}");
    }
}

/// Behind a tilted frame the axes stand where the tool stood in it: the way to a position of the
/// machine moves the axes that the settings name, and no other.
#[test]
fn a_position_of_the_machine_behind_a_tilted_frame_agrees() {
    let tool = "LOADTL / 1; SPINDL / RPM, 3000, CLW; RAPID; GOTO / 0, 0, 100, 0.6, 0, 0.8; \
                FEDRAT / 500, MMPM; GOTO / 40, 0, 0, 0.6, 0, 0.8";
    let sinumerik = "%_N_N_1_MPF; G710 G90 G94 G17; T1 M6; D1; S3000 M3; G0 A-36.87 C-90; \
                     CYCLE800(0,\"TC1\",0,57,0,0,0,0,36.8699,-90,0,0,0,-1,0); X0 Y-60; Z80; \
                     G1 Y32 Z24 F500; CYCLE800(); G53 G0 Z0 D0; D1; M30";
    let klartext = "0 BEGIN PGM 1 MM; 1 TOOL CALL 1 Z; 2 TOOL CALL 1 Z S3000; 3 M3; \
                    4 L A-36.87 C-90 R0 FMAX; \
                    5 PLANE SPATIAL SPA-36.8699 SPB+0 SPC-90 STAY; 6 L X+0 Y-60 FMAX; \
                    7 L Z+80 FMAX; 8 L Y+32 Z+24 F500; 9 PLANE RESET STAY; 10 L Z+0 FMAX M91; \
                    11 M30; 12 END PGM 1 MM";
    let fanuc = "%; O0001 (1); G21 G90 G94 G17; T1 M6; S3000 M3; G0 B36.87 C0.; \
                 G68.2 X0. Y0. Z0. I90. J36.87 K-90.; G53.1; X-60. Y0.; G43 Z80. H1; \
                 G1 X32. Z24. F500.; G69; G53 G0 Z0.; M30; %";
    let framed = "rotary.frame_output=1";
    for (ready, nc, wrong) in [
        ("sinumerik-5x", sinumerik, [("G0 Z0 D0", "G0 Z1 D0"), ("G0 Z0 D0", "G0 X0 Z0 D0")]),
        ("heidenhain-5x", klartext, [("L Z+0", "L Z+1"), ("L Z+0", "L X+5 Z+0")]),
        ("fanuc-5x-head", fanuc, [("G0 Z0.", "G0 Z-1."), ("G0 Z0.", "G0 Y7. Z0.")]),
    ] {
        for (record, at) in [("GOHOME", "home.z=0"), ("RETRCT", "home.retract_z=0")] {
            let cl = format!("{tool}; {record}");
            let found = |nc: &str| back_check::found(ready, &["home.frame=1", at, framed], &cl, nc);
            assert_eq!(found(nc), "", "{ready} {record}");
            for (old, new) in wrong {
                assert!(nc.contains(old), "{old}");
                let said = found(&nc.replacen(old, new, 1));
                let message = "goes to another position of the machine";
                assert!(said.contains(message), "{ready} {record} {new}: {said}");
            }
        }
    }
    let cl = format!("{tool}; LOADTL / 2");
    let change = ["home.frame=1", framed, "tool.change_block=1", "tool.change_z=400"];
    let nc = fanuc.replace("T1 M6", "G53 G0 Z400.; T1 M6");
    let nc = nc.replace("G53 G0 Z0.; M30", "G53 G0 Z400.; T2 M6; M30");
    assert_eq!(back_check::found("fanuc-5x-head", &change, &cl, &nc), "");
    let wrong = nc.replace("Z400.; T2", "Z399.; T2");
    let said = back_check::found("fanuc-5x-head", &change, &cl, &wrong);
    assert!(said.contains("goes to another position of the machine"), "{said}");
}

/// Before tool-tip control begins out of a tilted frame the tool goes up along itself: in Z of the
/// machine where tables have turned the part, and in Z of the frame under a head that leans.
#[test]
fn a_way_up_out_of_a_tilted_frame_goes_along_the_tool() {
    let settings = &["rotary.frame_output=1", "rotary.tip_control=1"];
    let cl = "LOADTL / 1; SPINDL / RPM, 3000, CLW; RAPID; GOTO / 60, 0, 80, 0.6, 0, 0.8; \
              FEDRAT / 300, MMPM; GOTO / 0, 0, 0, 0.6, 0, 0.8; MULTAX / ON; RAPID; \
              GOTO / 60, 0, 80, 0.6, 0, 0.8";
    let program = |turn: &str, frame: &str, way: &str, up: &str| {
        format!(
            "%; O0001 (1); G21 G90 G94 G17; T1 M6; S3000 M3; G0 {turn}; \
             G68.2 X0. Y0. Z0. {frame}; G53.1; X0. Y0.; G43 Z100. H1; G1 Z0. F300.; {way}; G49; \
             G43.4 H1; X60. Y0. Z80. {turn}; {up}; G49; M30; %"
        )
    };
    let way_out = "X240. Z320.";
    let tables = |way: &str| program("A-36.87 C-90.", "I90. J36.87 K180.", way, way_out);
    let head = |way: &str| program("B36.87 C0.", "I90. J36.87 K-90.", way, way_out);
    let found = |ready: &str, nc: &str| back_check::found(ready, settings, cl, nc);
    assert_eq!(found("fanuc-5x-tables", &tables("G69; G0 Z290.")), "");
    assert_eq!(found("fanuc-5x-tables", &tables("G0 Z300.; G69")), "");
    assert_eq!(found("fanuc-5x-head", &head("G0 Z300.; G69")), "");
    for (ready, nc) in [
        // Not as far as the settings ask for, and aside.
        ("fanuc-5x-tables", tables("G69; G0 Z289.")),
        ("fanuc-5x-tables", tables("G69; G0 X1. Z290.")),
        ("fanuc-5x-head", head("G69; G0 Z300.")),
    ] {
        let said = found(ready, &nc);
        assert!(said.contains("which is not on a path to its end"), "{ready}: {said}\n{nc}");
    }
    // At the level of RETRCT a head that leans may go straight up: it is away from the part.
    let lean = "-0.0293388535, 0.0259948066, 0.9992314555";
    let cl = format!(
        "LOADTL / 1; SPINDL / RPM, 3000, CLW; FEDRAT / 957.8, MMPM; \
         GOTO / -47.891582953, 28.587568188, 49.321709073, {lean}; RETRCT; RAPID; \
         GOTO / 31.062913469, 45.321682452, 28.829604968, 0.4038967137, -0.1179795521, 0.9071649629"
    );
    let nc = "%; O0001 (1); G21 G90 G94 G17; T1 M6; S3000 M3; G0 A-2.246 C48.458; G43.5 H1; \
              G1 X-47.892 Y28.588 Z49.322 I-0.029339 J0.025995 K0.999231 F957.8; \
              G0 X-56.694 Y36.386 Z349.091; G49; G43 Z400. H1; Z700.; A24.884 C73.717; G49; \
              G43.5 H1; X31.063 Y45.322 Z28.83 I0.403897 J-0.11798 K0.907165; \
              X152.232 Y9.928 Z300.979; G49; M30; %";
    let settings =
        &["chain=\"heads-ca\"", "rotary.tip_form=1", "rotary.tip_control=1", "home.retract_z=400"];
    let found = |nc: &str| back_check::found("fanuc-5x-tables", settings, &cl, nc);
    assert_eq!(found(nc), "");
    let said = found(&nc.replacen("Z700.", "Z690.", 1));
    assert!(said.contains("which is not on a path to its end"), "{said}");
}

/// Before the machine turns for a tilted frame it goes up to the level of the settings, in the
/// frame of the machine where that says it.
#[test]
fn a_way_up_in_the_frame_of_the_machine_before_a_tilted_frame_agrees() {
    let settings = &["home.frame=1", "home.retract_z=0"];
    let cl = "LOADTL / 1; SPINDL / RPM, 3000, CLW; FEDRAT / 200, MMPM; RAPID; GOTO / 0, 0, 100; \
              GOTO / 0, 0, 60; RAPID; GOTO / 0, 0, 200; RAPID; \
              GOTO / 0, 20, 80, 0, 0.5, 0.8660254; GOTO / 0, 20, 60, 0, 0.5, 0.8660254";
    let nc = "%_N_1_MPF; G710 G90 G94 G17; T1 M6; D1; S3000 M3; G0 A0 C0; X0 Y0; Z100; \
              G1 Z60 F200; G0 Z200; G53 G0 Z0 D0; D1; A-30 C0; \
              CYCLE800(0,\"TC1\",0,57,0,0,0,-30,0,0,0,0,0,-1,0); X0 Y-22.679; Z79.282; \
              G1 Y-12.679 Z61.962 F200; CYCLE800(); M30";
    let found = |nc: &str| back_check::found("sinumerik-5x", settings, cl, nc);
    assert_eq!(found(nc), "");
    for (old, new) in [("G53 G0 Z0 D0", "G53 G0 Z-50 D0"), ("G53 G0 Z0 D0", "G53 G0 X0 Z0 D0")] {
        let said = found(&nc.replacen(old, new, 1));
        assert!(said.contains("goes to a point of the machine"), "{new}: {said}");
    }
}

/// Centers of a program that another post has made may have no more digits than its points.
#[test]
fn a_center_is_as_exact_as_the_ends_of_its_arc() {
    let cases = nc_cases::all();
    let name = "corpus/klartext/helices";
    let case = cases.iter().find(|case| case.name == name).expect(name);
    let written = "CC X-13.3333 Y+0";
    assert_eq!(said(case, written, "CC X-13.333 Y+0"), "");
    let found = said(case, written, "CC X-13.3345 Y+0");
    assert!(found.contains("the center of the arc is off in X"), "{found}");
}
