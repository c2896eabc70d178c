//! What the back-check finds in programs of lathes and mill-turn machines by hand.

use filpost::Program;
use filpost_tests::back_check::{each_is_found, found};

/// What a ready post with settings makes of a CL file in mm, without block numbers and with `; `
/// between blocks, as it stands in the file.
fn nc_of(ready: &str, settings: &[&str], cl: &str) -> String {
    let start = Program::builder().generic(ready);
    let post = settings.iter().fold(start, |builder, setting| builder.set(setting));
    let cl = format!("UNITS / MM\n{}\nFINI\n", cl.replace("; ", "\n"));
    let mut nc = Vec::new();
    post.build().expect("a machine").stream(cl.as_bytes(), &mut nc).expect("a program");
    let nc = String::from_utf8(nc).expect("text");
    let bare = |line: &str| match line.split_once(' ') {
        Some((number, rest)) if number.starts_with('N') => rest.to_string(),
        _ => line.to_string(),
    };
    nc.lines().map(bare).collect::<Vec<_>>().join("; ")
}

/// A live tool that the record compensates must be, in the plane of the record.
#[test]
fn a_radial_live_tool_without_its_compensation_is_found() {
    let cl = "MODE / MILL; LOADTL / 3; SPINDL / RPM, 1000, CLW; FEDRAT / 100, MMPM; \
              TLAXIS / 1, 0, 0; RAPID; GOTO / 30, 0, 5; GOTO / 19, 0, 5; CUTCOM / LEFT, YZPLAN; \
              GOTO / 19, 0, -2; GOTO / 19, 0, -20; CUTCOM / OFF; GOTO / 19, 0, -25; RAPID; \
              GOTO / 30, 0, -25";
    let nc = "%; O0001; G21 G99 G18; M51; T0303; G97 S1000 M13; G0 X60. Z5. C0.; G1 G98 X38. F100.; \
              G19; G41 Z-2.; Z-20.; G40 Z-25.; G0 X60.; M15; M50; M30; %";
    let check = |nc: &str| found("fanuc-mill-turn", &["address.Y.format=1"], cl, nc);
    assert_eq!(check(nc), "");
    let off = "cutter compensation is off, it should be left";
    for (old, new, said) in [
        ("G41 Z-2.", "Z-2.", off),
        ("G19; G41 Z-2.", "Z-2.", off),
        ("G19; ", "", "cutter compensation acts in the plane ZX, it should be YZ"),
        ("Z-20.", "G18 Z-20.", "cutter compensation acts in the plane ZX, it should be YZ"),
        ("G41 Z-2.", "G42 Z-2.", "cutter compensation is right, it should be left"),
    ] {
        let wrong = check(&nc.replacen(old, new, 1));
        assert!(wrong.contains(said), "{new}: {wrong}");
    }
}

/// The nose of a turning tool is compensated in X and Z.
#[test]
fn a_nose_compensated_in_another_plane_is_found() {
    let cl = "LOADTL / 3; SPINDL / RPM, 500, CLW; FEDRAT / 0.2, MMPR; RAPID; GOTO / 25, 0, 5; \
              CUTCOM / RIGHT, 3; GOTO / 20, 0, 5; GOTO / 20, 0, -10; CUTCOM / OFF; GOTO / 30, 0, -10";
    let nc = "%; O0001; G21 G99 G18; T0303; G97 S500 M3; G0 X50. Z5.; G18; G1 G42 X40. F0.2; Z-10.; \
              G40 X60.; M30; %";
    assert_eq!(found("fanuc-lathe", &[], cl, nc), "");
    assert_eq!(found("fanuc-lathe", &[], cl, &nc.replacen("G18; G1", "G1", 1)), "");
    for (old, new) in [("G18; G1", "G17; G1"), ("; Z-10.", "; G17 Z-10.")] {
        let said = found("fanuc-lathe", &[], cl, &nc.replacen(old, new, 1));
        assert!(said.contains("it should be ZX"), "{new}: {said}");
    }
}

/// A tap of a live tool in step with its spindle.
#[test]
fn a_changed_rigid_tap_of_a_live_tool_is_found() {
    let cl = "MODE / MILL; LOADTL / 3; SPINDL / RPM, 600, CLW; MULTAX / ON; FEDRAT / 100, MMPM; RAPID; \
              GOTO / 30, 0, -10, 1, 0, 0; RAPID; GOTO / 30, 0, 10, 1, 0, 0; \
              CYCLE / TAP, DEPTH, 12, MMPR, 1.25, CLEAR, 3; GOTO / 10, 0, 0, 0, 0, 1; CYCLE / OFF";
    let settings = ["mill_turn.rigid_tap=1", "mill_turn.live_spindle=2"];
    let nc = "%_N_MPF1_MPF; G710 G90 G95 G18; DIAMON; M70; SETMS(2); T3; D1; G97 S600 M3; \
              G0 X60 Z-10 C0; Z10; X20; Z3; G94; SPOS=0; G331 Z-12 K1.25 S600; G332 Z3 K1.25; M3; M5; \
              SETMS; M5; M30";
    let check = |nc: &str| found("sinumerik-mill-turn", &settings, cl, nc);
    assert_eq!(check(nc), "");
    for (old, new) in [
        ("SPOS=0; ", ""),
        ("G94; ", ""),
        ("K1.25 S600", "K1.5 S600"),
        ("K1.25 S600", "K-1.25 S600"),
        ("K1.25; M3", "K-1.25; M3"),
        ("K1.25 S600; G332 Z3 K1.25", "K-1.25 S600; G332 Z3 K-1.25"),
        ("S600; G332", "S700; G332"),
        ("Z-12", "Z-13"),
        ("G332 Z3", "G332 Z4"),
        ("G332 Z3 K1.25; ", ""),
        ("G331 Z-12 K1.25 S600; ", ""),
        ("G332", "G331"),
        ("Z-12 K1.25", "X30 I1.25"),
    ] {
        let changed = nc.replacen(old, new, 1);
        assert_ne!(changed, nc, "{old}");
        assert_ne!(check(&changed), "", "{new}");
    }
}

/// A tap of a live tool along X: it and its lead are lengths of radius.
#[test]
fn a_changed_rigid_tap_along_x_is_found() {
    let cl = "MODE / MILL; LOADTL / 3; SPINDL / RPM, 600, CLW; MULTAX / ON; RAPID; \
              GOTO / 40, 0, -10, 1, 0, 0; CYCLE / TAP, DEPTH, 12, MMPR, 1.25, CLEAR, 3; \
              GOTO / 30, 0, -10, 1, 0, 0; CYCLE / OFF";
    let settings = ["mill_turn.rigid_tap=1", "mill_turn.live_spindle=2"];
    let nc = "%_N_MPF1_MPF; G710 G90 G95 G18; DIAMON; M70; SETMS(2); T3; D1; G97 S600 M3; \
              G0 X80 Z-10 C0; X66; G94; SPOS=0; DIAMOF; G331 X18 I1.25 S600; G332 X33 I1.25; DIAMON; \
              M3; M5; SETMS; M5; M30";
    let check = |nc: &str| found("sinumerik-mill-turn", &settings, cl, nc);
    assert_eq!(check(nc), "");
    for (old, new) in [
        ("SPOS=0; ", ""),
        ("DIAMOF; ", ""),
        ("DIAMOF; G331 X18 I1.25 S600; G332 X33", "G331 X36 I1.25 S600; G332 X66"),
        ("I1.25 S600", "I1.5 S600"),
        ("I1.25 S600; G332 X33 I1.25", "I2.5 S600; G332 X33 I2.5"),
        ("I1.25 S600; G332 X33 I1.25", "I-1.25 S600; G332 X33 I-1.25"),
        ("X18 I", "X18 K"),
        ("X18", "X36"),
        ("X33", "X66"),
        ("G332 X33 I1.25; ", ""),
    ] {
        let changed = nc.replacen(old, new, 1);
        assert_ne!(changed, nc, "{old}");
        assert_ne!(check(&changed), "", "{new}");
    }
}

/// Threads, feeds a turn and surface speeds of the second spindle: which one the control counts.
#[test]
fn another_spindle_than_the_one_that_turns_the_part_is_found() {
    let thread = "RAPID; GOTO / 30, 0, 5; THREAD / MMPR, 2; GOTO / 30, 0, -20; RAPID; \
                  GOTO / 35, 0, 5; THREAD / OFF";
    let cl = format!(
        "LOADTL / 1; SPINDL / RPM, 800, CLW; {thread}; SPINDL / RPM, 500, CCLW, SIDE; {thread}; \
         FEDRAT / 0.2, MMPR; GOTO / 30, 0, 0"
    );
    let by_number = "%_N_MPF1_MPF; G710 G90 G95 G18; DIAMON; T1; D1; SETMS; G97 S800 M3; G0 X60 Z5; \
                     G33 Z-20 K2; G0 X70 Z5; SETMS(2); G97 S500 M4; X60; G33 Z-20 K2; G0 X70 Z5; \
                     G1 X60 Z0 F0.2; M5; SETMS; M30";
    let by_code = "%; O0001; G21 G99 G18; T0101; M200; G97 S800 M3; G0 X60. Z5.; G32 Z-20. F2.; \
                   G0 X70. Z5.; M201; G97 S500 M104; X60.; G32 Z-20. F2.; G0 X70. Z5.; \
                   G1 X60. Z0. F0.2; M105; M200; M30; %";
    let codes = [
        "spindle.side_master_code=201",
        "spindle.main_master_code=200",
        "spindle.side_cw_code=103",
        "spindle.side_ccw_code=104",
        "spindle.side_stop_code=105",
    ];
    let number = ["spindle.side_number=2"];
    let check = |nc: &str| match nc.starts_with("%_N") {
        true => found("sinumerik-lathe", &number, &cl, nc),
        false => found("fanuc-lathe", &codes, &cl, nc),
    };
    let faults: [(&str, &[(&str, &str)]); 2] = [
        (
            by_number,
            &[
                ("SETMS(2); ", ""),
                ("SETMS(2)", "SETMS(3)"),
                ("SETMS(2)", "SETMS"),
                ("SETMS; G97 S800", "SETMS(2); G97 S800"),
                ("S500", "S550"),
                ("M4", "M3"),
                ("X60; G33 Z-20 K2", "X60; G33 Z-20 K1.9"),
                ("X60; G33 Z-20 K2", "SETMS; X60; G33 Z-20 K2"),
                ("G1 X60", "SETMS; G1 X60"),
                ("; SETMS; M30", "; M30"),
                ("G97 S500", "G96 S500"),
            ],
        ),
        (
            by_code,
            &[
                ("M201; ", ""),
                ("M201", "M200"),
                ("M200; G97 S800", "M201; G97 S800"),
                ("S500", "S550"),
                ("M104", "M103"),
                ("M104", "M4"),
                ("X60.; G32 Z-20. F2.", "X60.; G32 Z-20. F1.9"),
                ("X60.; G32 Z-20. F2.", "M200; X60.; G32 Z-20. F2."),
                ("M201; G97", "M201 G97"),
                ("M105; M200; ", "M105; "),
            ],
        ),
    ];
    for (nc, changes) in faults {
        assert_eq!(check(nc), "");
        for (old, new) in changes {
            let changed = nc.replacen(old, new, 1);
            assert_ne!(changed, nc, "{old}");
            assert_ne!(check(&changed), "", "{new}");
        }
    }
}

/// G961 and G971 of a SINUMERIK leave the feed a minute, G96 and G97 make it one a turn.
#[test]
fn speed_modes_of_a_feed_a_minute_are_followed() {
    let cl = "LOADTL / 1; SPINDL / RPM, 500, CLW; FEDRAT / 100, MMPM; RAPID; GOTO / 25, 0, 4; \
              INSERT G971 S300; GOTO / 20, 0, 4";
    let nc = "%_N_MPF1_MPF; G710 G90 G95 G18; DIAMON; T1; D1; G97 S500 M3; G0 X50 Z4; G971 S300; \
              G1 X40 F100; M30";
    assert_eq!(found("sinumerik-lathe", &[], cl, nc), "");
    let a_turn = |text: &str| text.replace("G971", "G97");
    assert_ne!(found("sinumerik-lathe", &[], &a_turn(cl), &a_turn(nc)), "");
}

/// The plane says along which axes a SINUMERIK lathe counts the lengths of a tool.
#[test]
fn a_lathe_that_turns_in_another_plane_is_found() {
    let cl = "LOADTL / 3; SPINDL / RPM, 500, CLW; FEDRAT / 0.2, MMPR; RAPID; GOTO / 20, 0, 2; \
              GOTO / 20, 0, -10; RAPID; GOTO / 22, 0, 2";
    let nc = "%_N_MPF1_MPF; G710 G90 G95 G18; DIAMON; T3; D1; G97 S500 M3; G0 X40 Z2; G1 Z-10 F0.2; \
              G0 X44 Z2; M30";
    let check = |nc: &str| found("sinumerik-lathe", &[], cl, nc);
    each_is_found(
        &check,
        nc,
        &[
            (" G18", "", "the plane is left to the control"),
            ("G18", "G17", "G17 of line 2 is in force, it should be G18"),
            ("G18", "G19", "G19 of line 2 is in force, it should be G18"),
            ("G1 Z-10", "G17 G1 Z-10", "G17 of line 8 is in force, it should be G18"),
            ("T3;", "T3; G19;", "G19 of line 5 is in force, it should be G18"),
        ],
    );
    let states = |code| format!("circle.plane_in_force={code}");
    let bare = nc.replace(" G18", "");
    assert_eq!(found("sinumerik-lathe", &[&states(18)], cl, &bare), "");
    let said = found("sinumerik-lathe", &[&states(17)], cl, &bare);
    assert!(said.contains("G17 is in force when the program begins"), "{said}");
}

/// TRANSMIT counts in G17, and what stands behind it in G18 again.
#[test]
fn the_plane_of_transmit_left_out_or_left_on_is_found() {
    let cl = "MODE / MILL; LOADTL / 1; SPINDL / RPM, 1000, CLW; FEDRAT / 300, MMPM; RAPID; \
              GOTO / 40, 5, 5; GOTO / 40, 5, -2; GOTO / 40, -5, -2; RAPID; GOTO / 40, -5, 5; \
              MODE / TURN; LOADTL / 3; SPINDL / RPM, 500, CLW; FEDRAT / 0.2, MMPR; RAPID; \
              GOTO / 20, 0, 2; GOTO / 20, 0, -10";
    let nc = nc_of("sinumerik-mill-turn", &[], cl);
    let check = |nc: &str| found("sinumerik-mill-turn", &[], cl, nc);
    each_is_found(
        &check,
        &nc,
        &[
            ("; G17;", "; ", "it should be G17"),
            ("; G17;", "; G19; ", "it should be G17"),
            ("TRAFOOF; DIAMON; G18", "TRAFOOF; DIAMON", "it should be G18"),
        ],
    );
}

/// TRACYL counts in G18, as turning does.
#[test]
fn another_plane_of_tracyl_is_found() {
    let cl = "MODE / MILL; LOADTL / 8; SPINDL / RPM, 2500, CLW; MULTAX / ON; RAPID; \
              GOTO / 30, 0, -20, 1, 0, 0; FEDRAT / 60, MMPM; GOTO / 25, 0, -20, 1, 0, 0; \
              GOTO / 24.904867, 2.178894, -20.2778, 0.996194698, 0.087155743, 0";
    let nc = nc_of("sinumerik-mill-turn", &[], cl);
    let check = |nc: &str| found("sinumerik-mill-turn", &[], cl, nc);
    each_is_found(
        &check,
        &nc,
        &[
            ("TRACYL(50);", "TRACYL(50); G17;", "it should be G18"),
            ("M70;", "M70; G19;", "it should be G18"),
        ],
    );
}

/// In polar interpolation C turns where Y goes, and where X goes beside the axis of the spindle.
#[test]
fn a_clamp_in_polar_interpolation_is_found() {
    let settings = &["rotary.clamp_code=68", "rotary.unclamp_code=69"];
    let cl = "MODE / MILL; LOADTL / 1; SPINDL / RPM, 1000, CLW; FEDRAT / 300, MMPM; RAPID; \
              GOTO / 40, 0, 5; GOTO / 40, 0, -2; GOTO / 40, 5, -2; GOTO / 20, 5, -2; \
              GOTO / 20, 5, 5";
    for (ready, [y, x]) in [
        ("fanuc-mill-turn", ["; C5.; ", "; X40.; "]),
        ("sinumerik-mill-turn", ["; Y5; ", "; X20; "]),
    ] {
        let nc = nc_of(ready, settings, cl);
        let check = |nc: &str| found(ready, settings, cl, nc);
        let said = "a rotary axis turns without M69";
        let held = |at: &str| format!("; M68{at}M69; ");
        each_is_found(&check, &nc, &[(y, &held(y), said), (x, &held(x), said)]);
        let up = if ready == "fanuc-mill-turn" { "; Z5.; G13.1; " } else { "; Z5; TRAFOOF; " };
        let still = check(&nc.replacen(up, &held(up), 1));
        assert!(still.contains("M68") && !still.contains(said), "{still}");
    }
}

/// A rapid of a lathe that is one line in the CL file has no corner, which may lie in the wall of a
/// bore.
#[test]
fn a_corner_on_the_way_out_of_a_bore_is_found() {
    let cl = "LOADTL / 1; SPINDL / RPM, 500, CLW; FEDRAT / 0.1, MMPR; RAPID; GOTO / 10, 0, 2; \
              GOTO / 10, 0, -35; RAPID; GOTO / 60, 0, 50";
    let nc = nc_of("fanuc-lathe", &[], cl);
    let check = |nc: &str| found("fanuc-lathe", &[], cl, nc);
    let said = "rapid goes along X and Z in two blocks";
    each_is_found(
        &check,
        &nc,
        &[("X120. Z50.", "X120.; Z50.", said), ("X120. Z50.", "Z50.; X120.", said)],
    );
}

/// A live tool along X goes down at its hole, one along Z goes across above the part.
#[test]
fn rapids_of_a_live_tool_in_a_dangerous_order_are_found() {
    let cl = "LOADTL / 1; MODE / MILL; SPINDL / RPM, 2000, CLW; FEDRAT / 200, MMPM; MULTAX / ON; \
              RAPID; GOTO / 60, 0, -20, 1, 0, 0; CYCLE / DRILL, DEPTH, 10, MMPM, 100, CLEAR, 2; \
              GOTO / 40, 0, -20, 1, 0, 0; GOTO / 0, 40, -30, 0, 1, 0; GOTO / -25, 0, -40, -1, 0, 0; \
              CYCLE / OFF; RAPID; GOTO / -60, 0, -60, -1, 0, 0; RAPID; GOTO / 0, 0, 20, 0, 0, 1; \
              CYCLE / DRILL, DEPTH, 10, MMPM, 100, CLEAR, 2; GOTO / 0, 0, 0, 0, 0, 1; \
              GOTO / 15, 0, 0, 0, 0, 1; CYCLE / OFF";
    let nc = nc_of("fanuc-mill-turn", &[], cl);
    let check = |nc: &str| found("fanuc-mill-turn", &[], cl, nc);
    each_is_found(
        &check,
        &nc,
        &[
            ("Z20.; X0. C0.", "X0. C0.; Z20.", "rapid goes across before Z has gone up"),
            ("Z-40. C180.; X54.", "X54.; Z-40. C180.", "rapid goes down before X and Y are over"),
            ("G0 X84.; Z-30. C90.", "G0 Z-30. C90.; X84.", "rapid in XY below the R plane"),
        ],
    );
}

/// Before polar interpolation Z goes up, and then X across.
#[test]
fn a_way_up_left_out_before_polar_interpolation_is_found() {
    let cl = "LOADTL / 1; MODE / MILL; SPINDL / RPM, 1000, CLW; FEDRAT / 300, MMPM; MULTAX / ON; \
              RAPID; GOTO / 0, 40, -25, 0, 1, 0; GOTO / 0, 30, -25, 0, 1, 0; \
              GOTO / 0, 40, -25, 0, 1, 0; MULTAX / OFF; RAPID; GOTO / -5, 40, 0; \
              GOTO / -5, 40, -7; GOTO / 5, 40, -7";
    for ready in ["fanuc-mill-turn", "sinumerik-mill-turn"] {
        let nc = nc_of(ready, &[], cl);
        let check = |nc: &str| found(ready, &[], cl, nc);
        let up = if ready == "fanuc-mill-turn" { "G0 Z0.; X" } else { "G0 Z0; X" };
        each_is_found(&check, &nc, &[(up, "G0 X", "rapid goes across before Z has gone up")]);
    }
}

/// A live tool on a machine with Y that goes in one block from the other side of the axis to where
/// C turns comes through the bar.
#[test]
fn a_rapid_past_the_axis_of_the_spindle_is_found() {
    let cl = "MODE / MILL; LOADTL / 9; SPINDL / RPM, 1500, CLW; FEDRAT / 200, MMPM; RAPID; \
              GOTO / -30, 20, 5; GOTO / -20, 20, -2; RAPID; GOTO / -20, 20, 20; RAPID; \
              GOTO / -60, 0, -20, -1, 0, 0; GOTO / -42, 0, -20, -1, 0, 0; RAPID; \
              GOTO / -60, 0, -20, -1, 0, 0";
    let settings = [
        "address.Y.slot=18",
        "address.Y.format=4443",
        "address.Y.spec=101",
        "limits.y_min=-40",
        "limits.y_max=40",
    ];
    let nc = nc_of("fanuc-mill-turn", &settings, cl);
    let check = |nc: &str| found("fanuc-mill-turn", &settings, cl, nc);
    assert_eq!(check(&nc), "");
    let parts = "X120. C-180. Y0.; Z-20.";
    assert!(nc.contains(parts), "{nc}");
    let wrong = check(&nc.replacen(parts, "X120. Z-20. C-180. Y0.", 1));
    assert!(wrong.contains("nearer than both its ends"), "{wrong}");
}

/// Behind polar interpolation X stands at the distance from the axis, and C at the angle.
#[test]
fn a_point_of_the_machine_behind_polar_interpolation_is_followed() {
    let cl = "MODE / MILL; LOADTL / 9; SPINDL / RPM, 1500, CLW; FEDRAT / 200, MMPM; RAPID; \
              GOTO / 20, 0, 5; RAPID; GOTO / 20, 0, 2; GOTO / 20, 15, 2; GOHOME";
    let settings = ["home.x=100", "home.z=100", "home.frame=1"];
    let nc = nc_of("fanuc-mill-turn", &settings, cl);
    let check = |nc: &str| found("fanuc-mill-turn", &settings, cl, nc);
    assert_eq!(check(&nc), "");
    assert!(nc.contains("G53 G0 X200. Z100."), "{nc}");
    let wrong = check(&nc.replacen("G53 G0 X200. Z100.", "G53 G0 X200. Z100. C0.", 1));
    assert!(wrong.contains("another position of the machine"), "{wrong}");
}
