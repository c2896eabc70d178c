//! What the back-check says of programs with rotary axes: what no such program may do is found,
//! whoever wrote it, and what is right is not.

use filpost_tests::back_check;

/// A CL file and a program for it on a ready post with settings.
struct Case<'a> {
    ready: &'a str,
    settings: &'a [&'a str],
    cl: &'a str,
    nc: &'a str,
}

impl Case<'_> {
    /// What is found, one line each.
    fn found(&self) -> String {
        let cl = format!("LOADTL / 1; SPINDL / RPM, 3000, CLW; {}", self.cl);
        back_check::found(self.ready, self.settings, &cl, self.nc)
    }

    fn asks_for(&self, message: &str) {
        let found = self.found();
        assert!(found.contains(message), "no `{message}` in\n{found}\n{}", self.nc);
    }

    /// The program is right, and one with a piece of text exchanged is found.
    fn agrees_but_not_with(&self, (old, new): (&str, &str), message: &str) {
        self.agrees();
        assert!(self.nc.contains(old), "no {old} in\n{}", self.nc);
        Case { nc: &self.nc.replacen(old, new, 1), ..*self }.asks_for(message);
    }

    fn agrees(&self) {
        let found = self.found();
        assert!(found.is_empty(), "{found}\n{}", self.nc);
    }
}

/// A program of a machine that says its modes at the start, with these blocks.
fn milled(blocks: &str) -> String {
    let start = "%\nO0001 (T)\nG21 G90 G94 G17\nT1 M6\nS3000 M3\n";
    format!("{start}{}\nM30\n%\n", blocks.replace("; ", "\n"))
}

const OVER: &str = "RAPID; GOTO / 10, 0, 50; FEDRAT / 300, MMPM; GOTO / 10, 0, 30";

#[test]
fn a_turn_under_cutter_compensation_is_found() {
    let ready = "fanuc-mill-a";
    let message = "a rotary axis turns under cutter compensation";
    let cl = format!(
        "{OVER}; CUTCOM / LEFT; GOTO / 20, 0, 30; GOTO / 20, 5, 30, 0, 0.0871557427, 0.9961946981; \
         CUTCOM / OFF; GOTO / 20, 15, 30, 0, 0.0871557427, 0.9961946981"
    );
    let start = "G0 X10. Y0.; A0.; G43 Z50. H1; G1 Z30. F300.; G1 G41 X20. D1";
    let nc = milled(&format!(
        "{start}; G93 Y0.793 Z30.036 A-1.667 F180.026; Y1.583 Z30.143 A-3.333 F180.031; \
         Y2.366 Z30.322 A-5. F179.972; G94; G40 Y12.328 Z31.193 F300."
    ));
    Case { ready, settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    // At rapid, too: the side of what follows is that of another face.
    let cl = format!(
        "{OVER}; CUTCOM / LEFT; GOTO / 20, 0, 30; RAPID; \
         GOTO / 20, 5, 80, 0, 0.0871557427, 0.9961946981; \
         GOTO / 20, 6, 80, 0, 0.0871557427, 0.9961946981; CUTCOM / OFF; \
         GOTO / 20, 15, 80, 0, 0.0871557427, 0.9961946981"
    );
    let turned = "G0 Z80.131; Y-1.991; A-5.; G1 Y-0.995 Z80.219; G40 Y7.97 Z81.003";
    let nc = milled(&format!("{start}; {turned}"));
    Case { ready, settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    let cl =
        cl.replace("RAPID; GOTO / 20, 5", "CUTCOM / OFF; GOTO / 20, 0, 80; RAPID; GOTO / 20, 5");
    let cl = cl.replace("CUTCOM / OFF; GOTO / 20, 15", "GOTO / 20, 15");
    let nc = milled(&format!("{start}; G40 Z80.; {}", turned.replace("G40 ", "")));
    let nc = nc.replace("G40 Z80.", "G1 G40 X20. Z80.");
    Case { ready, settings: &[], cl: &cl, nc: &nc }.agrees();
}

#[test]
fn a_turn_at_feed_from_a_point_of_the_machine_is_found() {
    let ready = "fanuc-mill-a";
    let cl = format!(
        "{OVER}; INSERT / G91 G28 A0.; INSERT / G90; GOTO / 20, 0, 5, 0, 0.5, 0.8660254038"
    );
    let start = "G0 X10. Y0.; A0.; G43 Z50. H1; G1 Z30. F300.; G91 G28 A0.; G90";
    let nc = milled(&format!("{start}; X20. Y-2.5 Z4.33 A-30."));
    let message = "a rotary axis turns at feed from a point of the machine";
    Case { ready, settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    let cl = cl.replace("GOTO / 20", "RAPID; GOTO / 20, 0, 50, 0, 0.5, 0.8660254038; GOTO / 20");
    let nc = milled(&format!("{start}; G0 Z43.301; X20. Y-25.; A-30.; G1 Y-2.5 Z4.33"));
    Case { ready, settings: &[], cl: &cl, nc: &nc }.agrees();
}

#[test]
fn a_time_for_a_way_from_an_unknown_place_is_found() {
    let lean = "0.3418118035, 0.0119363453, 0.9396926208";
    let cl = format!("{OVER}; SET / OFSETL, 2; GOTO / 10, 0, 5, {lean}");
    let start = "G0 X10. Y0.; A0. C0.; G43 Z50. H1; G1 Z30. F300.";
    let nc = milled(&format!("{start}; G55; G93 X-0.65 Y-9.387 Z5.113 A-20. C-88. F300.118"));
    let message = "inverse-time feed on a move from an unknown start point";
    Case { ready: "haas-trunnion", settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    let nc = milled(&format!(
        "{start}; T2 M6; S3000 M3; G93 X-0.65 Y-9.387 Z5.113 A-20. C-88. F300.118"
    ));
    Case { ready: "haas-trunnion", settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    let nc = milled(&format!("{start}; G55; G94 X-0.65 Y-9.387 Z5.113 A-20. C-88. F300."));
    let found = Case { ready: "haas-trunnion", settings: &[], cl: &cl, nc: &nc }.found();
    assert!(!found.contains(message), "{found}");
}

#[test]
fn a_turn_that_may_be_skipped_must_not_come_at_feed_in_its_place() {
    let ready = "haas-trunnion";
    let settings = &["rotary.table_words=1"];
    let cl = format!("{OVER}; OPSKIP / ON; ROTABL / 90, CAXIS; OPSKIP / OFF; GOTO / 20, 0, 30");
    let start = "G0 X10. Y0.; A0. C0.; G43 Z50. H1; G1 Z30. F300.; /G0 C90.";
    let nc = milled(&format!("{start}; G1 X20. C90."));
    Case { ready, settings, cl: &cl, nc: &nc }.asks_for(
        "the tip leaves its line by 5.3312 during the move, 0.01 is allowed, with block delete on",
    );
    // At rapid it may.
    let cl = cl.replace("GOTO / 20, 0, 30", "RAPID; GOTO / 20, 0, 80");
    let nc = milled(&format!("{start}; G0 Z80.; X20.; C90."));
    Case { ready, settings, cl: &cl, nc: &nc }.agrees();
}

const UP: &str = "0, 0, 1";
const LEANS: &str = "0, -0.3420201433, 0.9396926208";
const LEANS_X: &str = "0.3420201433, 0, 0.9396926208";

#[test]
fn where_an_axis_stands_before_a_word_says_it_breaks_no_travel() {
    let cl = format!("RAPID; GOTO / 0, 0, 50, {LEANS_X}");
    let nc = milled("G0 X-17.101 Y0.; B20.; G43 Z46.985 H1");
    Case { ready: "fanuc-mill-b", settings: &["rotary.primary_min=12.5"], cl: &cl, nc: &nc }
        .agrees();
    let settings = &["rotary.primary_min=20.5"];
    Case { ready: "fanuc-mill-b", settings, cl: &cl, nc: &nc }.asks_for("B20 lies outside");
    let nc = milled("G0 X-17.101 Y0.; B20.; G43 Z46.985 H1");
    let settings = &["limits.z_min=12.5"];
    Case { ready: "fanuc-mill-b", settings, cl: &cl, nc: &nc }.agrees();
}

#[test]
fn tip_control_ends_and_begins_again_beside_other_records() {
    let lean = format!("10, 0, 5, {LEANS_X}");
    let start = format!("MULTAX / ON; RAPID; GOTO / 10, 0, 50, {LEANS_X}; FEDRAT / 300, MMPM");
    let ready = "fanuc-5x-tables";
    // The machine turns at its point of the machine, where no length acts.
    let cl = format!("{start}; GOTO / {lean}; RETRCT; RAPID; GOTO / {lean}");
    let nc = milled(
        "G0 A0. C0.; G43.4 H1; X10. Y0. Z50. A-20. C-90.; G1 Z5. F300.; G0 X112.606 Z286.908; \
         G49; G53 G0 Z0.; A0. C0.; G43.4 H1; X10. Y0. Z5. A-20. C-90.; X112.606 Z286.908; G49",
    );
    let settings = &["home.frame=1", "home.retract_z=0"];
    Case { ready, settings, cl: &cl, nc: &nc }.agrees_but_not_with(
        ("G43.4 H1; X10. Y0. Z5.".replace("; ", "\n").as_str(), "G43.4 H2\nX10. Y0. Z5."),
        "length offset 2 is active, it should be 1",
    );
    // Another work offset ends it and begins it again, with a dwell between, and where it stays.
    let settings = &["rotary.tip_control=1"];
    let cl = format!("{start}; GOTO / {lean}; SET / OFSETL, 2; DELAY / 0.5; RAPID; GOTO / {lean}");
    let nc = milled(
        "G43.4 H1; G0 X10. Y0. Z50. A-20. C-90.; G1 Z5. F300.; G0 X112.606 Z286.908; G49; G55; \
         G4 P500; G43.4 H1; X10. Y0. Z5. A-20. C-90.; X112.606 Z286.908; G49",
    );
    let case = Case { ready, settings, cl: &cl, nc: &nc };
    case.agrees_but_not_with(("G55", "G56"), "work offset G56, it should be G55");
    case.agrees_but_not_with(("G55\n", ""), "it should be G55");
    case.agrees_but_not_with(("Z286.908", "Z186.908"), "Z186.908");
    let moved = ("G0 X112.606 Z286.908\nG49\nG55", "G49\nG55");
    case.agrees_but_not_with(moved, "the control may move down by the tool length");
    // The CL file goes on upright, without it, by the level of the machine.
    let cl = format!("{start}; GOTO / {lean}; MULTAX / OFF; RAPID; GOTO / 0, -1, 50, {UP}");
    let nc = milled(
        "M11; G0 A0. C0.; G43.4 H1; X10. Y0. Z50. A-20. C-90.; G1 Z5. F300.; \
         G0 X112.606 Z286.908; G49; G43 Z150. H1; A0. C0.; M10; X0. Y-1.; Z50.",
    );
    let settings = &[
        "rotary.frame_output=1",
        "rotary.frame_clamp=1",
        "rotary.clamp_code=10",
        "rotary.unclamp_code=11",
        "home.retract_z=150",
    ];
    Case { ready, settings, cl: &cl, nc: &nc }
        .agrees_but_not_with(("Z150.", "Z140."), "Z140, which is not on a path to its end");
}

#[test]
fn another_work_offset_is_gone_to_again() {
    // In a tilted frame.
    let cl = format!(
        "RAPID; GOTO / 0, 0, 60, {LEANS}; FEDRAT / 300, MMPM; SET / OFSETL, 2; RAPID; \
         GOTO / 0, 0, 60, {LEANS}; GOTO / 0, 0, 10, {LEANS}"
    );
    let frame = "G68.2 X0. Y0. Z0. I0. J20. K0.; G53.1; X0. Y20.521";
    let nc = milled(&format!(
        "G0 A20.; {frame}; G43 Z56.382 H1; G69; G55; Z150.; A20.; {frame}; Z56.382; \
         G1 Y3.42 Z9.397 F300.; G69"
    ));
    let settings = &["rotary.frame_output=1", "home.retract_z=150"];
    let case = Case { ready: "fanuc-mill-a", settings, cl: &cl, nc: &nc };
    case.agrees_but_not_with(("Z150.", "Z57."), "and not a retract");
    case.agrees_but_not_with(("G55\n", ""), "work offset none, it should be G55");
    // Behind a point that comes twice.
    let cl = "RAPID; GOTO / 0, 0, 60; RAPID; GOTO / 0, 0, 60; SET / OFSETL, 2; RAPID; \
              GOTO / 0, 0, 60; RAPID; GOTO / 5, 0, 60";
    let nc = milled("G0 X0. Y0.; A0. C0.; G43 Z60. H1; G55; X0. Y0.; A0. C0.; Z60.; X5.");
    let case = Case { ready: "haas-trunnion", settings: &[], cl, nc: &nc };
    case.agrees_but_not_with(("G55\n", ""), "work offset none, it should be G55");
    case.agrees_but_not_with(("G55", "G56"), "work offset G56, it should be G55");
    let only = cl.replace("; RAPID; GOTO / 5, 0, 60", "");
    let nc = milled("G0 X0. Y0.; A0. C0.; G43 Z60. H1; G55");
    Case { ready: "haas-trunnion", settings: &[], cl: &only, nc: &nc }
        .asks_for("1 motion is missing");
}

#[test]
fn a_point_that_comes_twice_before_a_point_of_the_machine_is_no_fault() {
    let cl = "RAPID; GOTO / 0, 0, 60; RAPID; GOTO / 0, 0, 60; RETRCT; RAPID; GOTO / 5, 0, 60";
    let nc = milled("G0 X0. Y0.; G43 Z60. H1; G53 G0 Z0.; X5. Y0.; G43 Z60. H1");
    let settings = &["home.frame=1", "home.retract_z=0"];
    let case = Case { ready: "fanuc-mill", settings, cl, nc: &nc };
    case.agrees_but_not_with(("G53 G0 Z0.\n", ""), "no motion to the position of the machine");
    let message = "goes to a point of the machine that neither the CL file nor";
    case.agrees_but_not_with(("X5.", "G53 G0 Z0.\nX5."), message);
    let cl = cl.replace("RETRCT; ", "");
    Case { ready: "fanuc-mill", settings, cl: &cl, nc: &nc }.asks_for(message);
}

#[test]
fn holes_of_two_faces_in_one_cycle_are_followed() {
    let cl = format!(
        "RAPID; GOTO / 0, 0, 60, {LEANS}; CYCLE / DRILL, DEPTH, 5, MMPM, 100, CLEAR, 2; \
         GOTO / 0, 0, 10, {LEANS}; GOTO / 0, 10, 0, {UP}; CYCLE / OFF"
    );
    let nc = milled(
        "G0 A20.; G68.2 X0. Y0. Z0. I0. J20. K0.; G53.1; X0. Y20.521; G43 Z56.382 H1; \
         G99 G81 X0. Y3.42 Z4.397 R11.397 F100.; G80; G69; G0 Z150.; A0.; \
         G99 G81 X0. Y10. Z-5. R2. F100.; G80",
    );
    let settings = &["rotary.frame_output=1", "home.retract_z=150"];
    let case = Case { ready: "fanuc-mill-a", settings, cl: &cl, nc: &nc };
    let low = "the tool must have gone up to Z150 before";
    case.agrees_but_not_with(("G0 Z150.\n", "G0\n"), low);
    case.agrees_but_not_with(("Z-5.", "Z-6."), "the hole is deeper by 1");
    case.agrees_but_not_with(("G0 Z150.", "G0 X1. Z150."), "X1");
    // Positions of a table under a tool along X: it turns, and X stays.
    let cl = "FEDRAT / 465, MMPM; \
              GOTO / 0.218168190, -7.623881561, 21.313642574, 0.8481161017, -0.5298104170, 0; \
              CYCLE / REAM, DEPTH, 7.83897, MMPM, 100, CLEAR, 3; \
              GOTO / -16.744153845, 2.972326779, 21.313642574, 0.9404427050, -0.3399522299, 0; \
              CYCLE / OFF";
    let nc = milled(
        "G1 G43 X46.334 Y-35.455 Z21.314 C-31.993 F465. H1; G19; \
         G99 G85 X-0.298 Y-23.804 Z21.314 R10.541 C-19.874 F100.; G80; G17",
    );
    let settings = &[
        "chain=\"table-c\"",
        "rotary.secondary_kind=0",
        "rotary.primary_x=71.818",
        "rotary.primary_y=58.893",
        "rotary.primary_z=-1.123",
    ];
    let case = Case { ready: "fanuc-mill-b", settings, cl, nc: &nc };
    case.agrees_but_not_with(("R10.541", "R11.541"), "R plane is higher by 1");
    case.agrees_but_not_with(("X-0.298", "X-1.298"), "the hole is deeper by 0.9998");
}

#[test]
fn a_hole_across_a_turned_table_returns_to_the_level_that_it_went_up_to() {
    let cl = "RAPID; GOTO / 76.267617354, -72.205184971, -44.326696559, 0.9209168973, \
              -0.3897589874, 0; \
              CYCLE / DRILL, DEPTH, 2.59469, MMPM, 100, CLEAR, 3, RETURN, 10; \
              GOTO / 57.849279408, -64.410005224, -44.326696559, 0.7551909844, -0.6555048261, 0; \
              GOTO / 46.621445499, -77.345316458, -9.608329327, 0.5875292765, -0.8092029098, 0; \
              CYCLE / OFF";
    let nc = milled(
        "G0 G43 Y-31.491 Z-44.327 H1; C-22.94; X107.118; X109.64; G19; \
         G98 G81 X97.045 Y0.858 Z-44.327 R102.64 C-40.958 F100.; G80; G0 X115.979; \
         G98 G81 X103.384 Y9.244 Z-9.608 R108.979 C-54.018 F100.; G80; G17",
    );
    let settings = &[
        "chain=\"table-c\"",
        "rotary.secondary_kind=0",
        "rotary.primary_x=-8.637",
        "rotary.primary_y=24.174",
        "rotary.primary_z=-59.613",
    ];
    let case = Case { ready: "fanuc-mill-b", settings, cl, nc: &nc };
    case.agrees_but_not_with(("G98 G81 X103", "G99 G81 X103"), "the hole is not finished");
    case.agrees_but_not_with(("X115.979", "X116.979"), "the plane over the hole is higher by 1");
    case.agrees_but_not_with(("R102.64", "R101.64"), "the R plane is deeper by 1");
}

#[test]
fn the_feed_of_a_hole_is_within_that_of_z_and_y() {
    let cl = "MULTAX / ON; FEDRAT / 500, MMPM; RAPID; \
              GOTO / 22.191186892, -22.112770309, -3.314429299, 0.2185123356, -0.3093377602, \
              0.9255066230; CYCLE / DRILL, DEPTH, 13.85092, MMPM, 100, CLEAR, 3; \
              GOTO / 20.604795743, -18.340572884, -15.441786249, 0.3777180687, -0.3276111423, \
              0.8660254038; CYCLE / OFF";
    let nc = "%_N_MPF1_MPF\nG710 G90 G94 G17\nT1 M6\nD1\nS3000 M3\nG0 A0 C0\nTRAORI\n\
              X22.191 Y-22.113 Z-3.314 A22.255 C35.237\nX25.265 Y-22.383 Z-4.757 A30 C49.063\n\
              X21.738 Y-19.323 Z-12.844\nG1 X15.373 Y-13.803 Z-27.437 F50\n\
              G0 X21.738 Y-19.323 Z-12.844\nTRAFOOF\nM30\n";
    // CYCLE brings its feed within that of Z, however the tool leans.
    let case = Case { ready: "sinumerik-5x", settings: &["feed.upm_max_z=50"], cl, nc };
    case.agrees_but_not_with(("F50", "F57.7"), "feed 57.7 mm/min, it should be 50");
    // The way of Y is so short that its last digit makes a part of the feed.
    let cl = "MULTAX / ON; FEDRAT / 649.1, MMPM; RAPID; \
              GOTO / -19.385740164, -37.843489610, 52.269159123, 0.0174968560, -0.0112718361, \
              0.9997833794; CYCLE / CSINK, DEPTH, 13.57529, MMPM, 100, CLEAR, 3; \
              GOTO / -19.735677284, -37.618052888, 32.273491534, 0.0174968560, -0.0112718361, \
              0.9997833794; CYCLE / OFF";
    let nc = "0 BEGIN PGM 1 MM\n1 TOOL CALL 1 Z\n2 TOOL CALL 1 Z S3000\n3 M3\n\
              4 L B+0 C+0 R0 FMAX\n5 FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n\
              6 L X-19.386 Y-37.843 Z+52.269 B+1.193 C-32.79 FMAX\n\
              7 L X-19.683 Y-37.652 Z+35.273 FMAX\n8 L X-19.973 Y-37.465 Z+18.701 F88.65\n\
              9 L X-19.683 Y-37.652 Z+35.273 FMAX\n10 FUNCTION RESET TCPM\n11 M30\n\
              12 END PGM 1 MM\n";
    let settings = &["feed.upm_max_y=1", "chain=\"tables-cb\""];
    let case = Case { ready: "heidenhain-5x", settings, cl, nc };
    case.agrees_but_not_with(("F88.65", "F98.65"), "feed 98.65 mm/min, it should be 88.7");
}

#[test]
fn the_angles_of_a_frame_turn_no_clamped_axis() {
    let cl = "RAPID; GOTO / 4.175, -7.231, 64.461, 0.25, -0.4330127019, 0.8660254038";
    let nc = "%_N_N_T_MPF\nG710 G90 G94 G17\nT1 M6\nD1\nS3000 M3\nM11\nG0 A30 C30\n\
              CYCLE800(0,\"TC1\",0,57,0,0,0,26.56505,14.47751,26.56505,0,0,0,1,0)\nM10\n\
              X0 Y24.999\nZ60\nCYCLE800()\nM30\n";
    let settings = &["rotary.frame_clamp=1", "rotary.clamp_code=10", "rotary.unclamp_code=11"];
    Case { ready: "sinumerik-5x", settings, cl, nc }
        .agrees_but_not_with(("M11\n", ""), "a rotary axis turns without M11");
}

#[test]
fn a_line_may_be_divided_from_where_the_tape_has_the_tool() {
    // Behind FROM the post has no other point that it could begin at.
    let cl = "RAPID; \
              GOTO / 34.217209869, 47.158646356, -55.395005959, -0.9613380244, 0, 0.2753710276; \
              FROM / 34.217209869, 47.158646356, -32.493529696; FEDRAT / 1346.6, MMPM; \
              GOTO / 44.214530568, 50.611709757, -59.930471289, -0.9624364844, 0, -0.2715069307";
    let nc = milled(
        "G0 X-45.757 Y47.159; B-74.016; G43 Z-97.38 H1; \
         G1 G93 X-49.664 Y47.473 Z-97.654 B-76.901 F1247.834; \
         X-53.629 Y47.787 Z-97.72 B-79.787 F1247.401; X-57.641 Y48.101 Z-97.572 B-82.672 F1247.834; \
         X-61.688 Y48.415 Z-97.207 B-85.557 F1247.834; X-65.758 Y48.728 Z-96.62 B-88.442 F1247.834; \
         X-69.84 Y49.042 Z-95.809 B-91.328 F1247.401; X-73.92 Y49.356 Z-94.77 B-94.213 F1247.834; \
         X-77.986 Y49.67 Z-93.502 B-97.098 F1247.834; X-82.025 Y49.984 Z-92.003 B-99.983 F1247.834; \
         X-86.024 Y50.298 Z-90.274 B-102.869 F1247.401; \
         X-89.971 Y50.612 Z-88.314 B-105.754 F1247.834; G94",
    );
    let settings = &[
        "chain=\"table-b\"",
        "rotary.secondary_kind=0",
        "rotary.primary_x=-33.620",
        "rotary.primary_y=75.357",
        "rotary.primary_z=-23.338",
    ];
    let case = Case { ready: "fanuc-mill-b", settings, cl, nc: &nc };
    case.agrees_but_not_with(("Y48.415", "Y48.418"), "during the move the tip is 0.0");
    case.agrees_but_not_with(("Z-95.809", "Z-95.805"), "during the move the tip is 0.0");
}

#[test]
fn a_table_that_turns_under_a_tool_along_x_is_followed_from_hole_to_hole() {
    // Up to the level of the next hole, then across while the table turns.
    let cl = "RAPID; GOTO / -1.452284644, 34.727510805, 36.574747531, 0.9624860946, 0.2713310114, 0; \
              CYCLE / DRILL, DEPTH, 8.49735, MMPM, 100, CLEAR, 3; \
              GOTO / -1.452284644, 34.727510805, 36.574747531, 0.9624860946, 0.2713310114, 0; \
              GOTO / -0.983627606, 33.065054752, 40.080945129, 0.9894990248, -0.1445395447, 0; \
              CYCLE / OFF";
    let nc = milled(
        "G0 G43 Y29.992 Z36.575 H1; C15.743; X-4.786; X-1.786; G19; \
         G99 G81 X-13.283 Y29.992 Z36.575 R-1.786 F100.; G80; G0 X3.455; \
         G99 G81 X-8.043 Y35.968 Z40.081 R3.455 C-8.311 F100.; G80; G17",
    );
    let settings = &[
        "chain=\"table-c\"",
        "rotary.secondary_kind=0",
        "rotary.primary_x=-20.244",
        "rotary.primary_y=44.415",
        "rotary.primary_z=61.408",
    ];
    let case = Case { ready: "fanuc-mill-a", settings, cl, nc: &nc };
    case.agrees_but_not_with(("G0 X3.455", "G0 X2.455"), "the plane over the hole is deeper by");
    case.agrees_but_not_with(("Y35.968", "Y35.978"), "Y off by");
    // Along Z, then along Y, both over the R level.
    let cl = "FEDRAT / 465, MMPM; GOTO / 52.3397, 0, 40, 1, 0, 0; \
              CYCLE / DRILL, DEPTH, 10, MMPM, 100, CLEAR, 3; GOTO / 30, 10, 60, 1, 0, 0; CYCLE / OFF";
    let nc = milled(
        "G1 G43 X52.34 Y0. Z40. C0. F465. H1; G0 Z60.; Y10.; G19; \
         G99 G81 X20. Y10. Z60. R33. F100.; G80; G17",
    );
    let settings = &["chain=\"table-c\"", "rotary.secondary_kind=0"];
    let case = Case { ready: "fanuc-mill-a", settings, cl, nc: &nc };
    case.agrees_but_not_with(("G0 Z60.", "G0 Z61."), "which is not over the hole");
}

#[test]
fn an_axis_that_a_hole_leaves_alone_stays_where_it_exactly_is() {
    let cl = "FEDRAT / 663.7, MMPM; GOTO / -41.135071314, 51.783439799, 19.333676251, 0, 0, 1; \
              CYCLE / BORE, DEPTH, 6.90978, MMPM, 100, CLEAR, 3, RETURN, 10; \
              GOTO / -69.824151966, 58.063786041, 0.185737845, 0.1096289557, -0.0108017545, \
              0.9939138867; \
              GOTO / -73.465240050, 58.691390642, 0.594171534, 0, 0, 1; CYCLE / OFF";
    let nc = milled(
        "G1 G43 X-41.135 Y51.783 Z19.334 B0. C0. F663.7 H1; \
         G98 G86 X-67.05 Y60.227 Z-19.515 R-9.605 B8.949 C-8.794 F100.; \
         X-73.29 Y47.5 Z-6.316 R3.594 B0.; G80",
    );
    let settings = &[
        "chain=\"tables-cb-nutating\"",
        "rotary.primary_x=-0.610",
        "rotary.primary_y=54.238",
        "rotary.primary_z=0.25",
        "rotary.secondary_x=47.257",
        "rotary.secondary_y=15.367",
        "rotary.secondary_z=-21.676",
    ];
    let case = Case { ready: "haas-trunnion", settings, cl, nc: &nc };
    case.agrees_but_not_with(("Y47.5 ", "Y47.502 "), "Y off by 0.0012");
}

/// Angles of 180 degrees in a frame leave C at zero, where tool-tip control may begin.
#[test]
fn a_frame_of_half_turns_leaves_its_axis_at_zero() {
    let settings = ["rotary.frame_output=1", "rotary.tip_output=1", "home.retract_z=200"];
    let cl = "FEDRAT / 200, MMPM; RAPID; GOTO / 0, 0, 60, 0, 0.5, 0.866025404; \
              GOTO / 0, 0, 10, 0, 0.5, 0.866025404; RETRCT; MULTAX / ON; RAPID; \
              GOTO / 10, 0, 10, 0, 0.6, 0.8; GOTO / 10, 0, 5, 0, 0.5, 0.866025404";
    let nc = milled(
        "G0 A-30. C0.; G68.2 X0. Y0. Z0. I180. J30. K180.; G53.1; X0. Y-30.; G43 Z51.962 H1; \
         G1 Y-5. Z8.66 F200.; G69; G0 Z200.; Z500.; A0.; G49; G43.4 H1; X10. Y0. Z10. A-36.87 \
         C0.; G1 Z5. A-30. F200.; G0 Y150. Z264.808; G49",
    );
    let case = Case { ready: "fanuc-5x-tables", settings: &settings, cl, nc: &nc };
    case.agrees();
    // Away from zero by its last digit it is not.
    let nc = nc.replacen("G0 A-30. C0.", "G0 A-30. C0.001", 1);
    Case { nc: &nc, ..case }.asks_for("with C away from 0");
}

/// From a place that nobody knows Y and Z may go alone at their limits, also while the machine
/// turns.
#[test]
fn limits_of_y_and_z_hold_from_unknown_places() {
    let cl = "FEDRAT / 1051.2, MMPM; RAPID; \
              GOTO / -8.790993302, 83.438790834, 15.796583889, -0.468588679, 0.099426466, \
              0.8778035246; SET / OFSETL, 54; \
              GOTO / 37.41063798, 85.879453541, -51.523429988, -0.3080051111, -0.0371555345, \
              0.9506588862";
    let settings = ["feed.upm_max_z=12.5", "fixture.base=3", "home.retract_z=400"];
    let nc = milled(
        "G0 X79.797 Y-8.767; A-28.621 C78.02; G43 Z20.172 H1; G57; \
         G1 X80.781 Y-44.614 Z-66.162 A-18.074 C96.879 F12.5",
    );
    let case = Case { ready: "haas-trunnion", settings: &settings, cl, nc: &nc };
    case.agrees();
    let nc = nc.replace("F12.5", "F25.");
    Case { nc: &nc, ..case }.asks_for("feed 25 mm/min, it should be 12.5 mm/min");
}

/// In a hole along a tilted tool the ways of Y and Z that limit the feed are those that the
/// program says under tool-tip control.
#[test]
fn limits_of_y_hold_in_holes_under_tip_control() {
    let lean = "0.0236225128, 0.2917619608, 0.9561992131";
    let cl = format!(
        "FEDRAT / 821.4, MMPM; MULTAX / ON; GOTO / 5.215995519, 50.059790581, 61.160199839; \
         GOTO / 6.424064665, 46.215379738, 73.372835765, {lean}; \
         CYCLE / DRILL, DEPTH, 10.9298, MMPM, 100, CLEAR, 3; \
         GOTO / 5.95161441, 40.380140522, 54.248851503, {lean}; CYCLE / OFF; RAPID; \
         GOTO / 6.424064665, 46.215379738, 73.372835765, {lean}"
    );
    let nc = milled(
        "G234 H1; G1 X5.216 Y50.06 Z61.16 A0. C0. F0.25; \
         X6.424 Y46.215 Z73.373 A-17.021 C-4.629 F0.836; G0 X6.022 Y41.255 Z57.117; \
         G1 X5.693 Y37.191 Z43.798 F0.857; G0 X6.022 Y41.255 Z57.117; \
         X6.424 Y46.215 Z73.373; G49",
    );
    let settings = ["feed.upm_max_y=0.25", "rotary.feed=0", "home.retract_z=400"];
    let case = Case { ready: "haas-trunnion-tcpc", settings: &settings, cl: &cl, nc: &nc };
    assert!(!case.found().contains("feed"), "{}", case.found());
    let nc = nc.replace("F0.857", "F1.2");
    Case { nc: &nc, ..case }.asks_for("feed 1.2 mm/min, it should be 0.8569");
}

/// Tool-tip control may end and begin again in the same work offset, and the tool goes up for it.
#[test]
fn tip_control_that_begins_again_in_the_same_offset_agrees() {
    let settings = ["chain=\"head-b\"", "rotary.secondary_kind=0", "home.retract_z=400"];
    let cl = "SET / OFSETL, 2; FEDRAT / 434.7, MMPM; \
              GOTO / -16.279941311, 9.722849457, -26.793751755, -0.1872556736, 0, 0.9823112097; \
              RAPID; SET / OFSETL, 2; \
              GOTO / -18.913309701, 3.72173173, -30.192027687, -0.1909738802, 0, 0.9815951187";
    let nc = milled(
        "G55; G43.4 H1; G1 X-16.28 Y9.723 Z-26.794 B-10.793 F434.7; G0 X-72.458 Z267.899; G49; \
         G55; G43.4 H1; X-18.913 Y3.722 Z-30.192 B-11.01; X-76.207 Z264.286; G49",
    );
    let case = Case { ready: "fanuc-5x-tables", settings: &settings, cl, nc: &nc };
    case.agrees_but_not_with(("G0 X-72.458 Z267.899\n", "G0\n"), "TCPC ended");
}

/// A clamped axis turns in no block, whoever wrote the code of the clamp.
#[test]
fn a_turn_of_a_clamped_axis_is_found() {
    let settings = &["rotary.clamp_code=10", "rotary.unclamp_code=11"];
    let lean = "0, 0.5, 0.8660254038";
    let start = "G0 X10. Y0.; A0.; G43 Z50. H1; G1 Z30. F300.; M10; Z20.";
    let turn = "G0 Z43.301; X20. Y-25.; A-30.; G1 Y-2.5 Z4.33";
    let nc = milled(&format!("{start}; M11; {turn}"));
    for (on, off) in [
        ("CLAMP / ON", "CLAMP / OFF"),
        ("AUXFUN / 10", "AUXFUN / 11"),
        ("INSERT / M10", "INSERT / M11"),
    ] {
        let cl = format!(
            "{OVER}; {on}; GOTO / 10, 0, 20; {off}; RAPID; GOTO / 20, 0, 50, {lean}; GOTO / 20, 0, 5, {lean}"
        );
        let case = Case { ready: "fanuc-mill-a", settings, cl: &cl, nc: &nc };
        case.agrees();
        let held = cl.replace(&format!("{off}; "), "");
        let nc = nc.replace("M11\n", "");
        Case { cl: &held, nc: &nc, ..case }.asks_for("a rotary axis turns without M11");
    }
}

/// Behind a tool change, too, Z comes down where the tables have turned.
#[test]
fn a_height_before_its_turn_is_found() {
    let lean = "0, -0.5, 0.86602540378";
    let cl = format!(
        "MULTAX / ON; FEDRAT / 300, MMPM; RAPID; GOTO / 0, 90, 30, {lean}; GOTO / 0, 90, 10, {lean}; \
         RAPID; GOTO / 0, 90, 30, {lean}; LOADTL / 2; SPINDL / RPM, 500, CLW; RAPID; \
         GOTO / 0, -90, 30, 0, 0, 1; GOTO / 0, -90, 10, 0, 0, 1"
    );
    let nc = milled(
        "G0 X0. Y117.942; A30. C0.; G43 Z-25.718 H1; G1 Y107.942 Z-43.038 F300.; G0 Z-25.718; \
         Y117.942; T2 M6; S500 M3; G0 X0. Y-90.; A0. C0.; G43 Z30. H2; G1 Z10. F300.",
    );
    let case = Case { ready: "haas-trunnion", settings: &[], cl: &cl, nc: &nc };
    let said = "rapid goes to its height before the rotary axes have arrived";
    case.agrees_but_not_with(("A30. C0.\nG43 Z-25.718 H1", "G43 Z-25.718 H1\nA30. C0."), said);
    case.agrees_but_not_with(("A0. C0.\nG43 Z30. H2", "G43 Z30. H2\nA0. C0."), said);
    let first = ("G0 X0. Y-90.\nA0. C0.\nG43 Z30. H2", "G0 G43 Z30. H2\nX0. Y-90.\nA0. C0.");
    case.agrees_but_not_with(first, said);
    // A text has turned the table away, and the motion turns it back.
    let cl = format!(
        "MULTAX / ON; RAPID; GOTO / 0, 90, 30, {lean}; LOADTL / 2; SPINDL / RPM, 500, CLW; \
         INSERT / G0 A0.; RAPID; GOTO / 0, -90, 30, {lean}"
    );
    let nc = milled(
        "G0 X0. Y117.942; A30. C0.; G43 Z-25.718 H1; T2 M6; S500 M3; G0 A0.; X0. Y-37.942; \
         A30. C0.; G43 Z64.282 H2",
    );
    let case = Case { cl: &cl, nc: &nc, ..case };
    case.agrees_but_not_with(("A30. C0.\nG43 Z64.282 H2", "G43 Z64.282 H2\nA30. C0."), said);
}

#[test]
fn a_way_up_behind_a_tool_change_need_not_go_along_a_head_that_leans() {
    let cl = "MULTAX / ON; RAPID; GOTO / 40, 0, 90, 0.5, 0, 0.8660254038; RETRCT";
    let changed = "MULTAX / ON; RAPID; GOTO / 40, 0, 90, 0.5, 0, 0.8660254038; LOADTL / 1; RETRCT";
    let settings = &["chain=\"table-c-head-b\"", "home.retract_z=400"];
    let ready = "haas-trunnion-tcpc";
    let start = "G234 H1; G0 X40. Y0. Z90. B30. C0.; G49";
    let straight = milled(&format!("{start}; G0 G43 Z400. H1"));
    Case { ready, settings, cl, nc: &straight }.asks_for("the tool is tilted");
    let nc = milled(&format!("{start}; T1 M6; G0 G43 Z400. H1"));
    Case { ready, settings, cl: changed, nc: &nc }.agrees();
}

/// Along a leaning tool a rapid goes by X and Z at once, which a control need not drive in step.
#[test]
fn a_rapid_that_bends_along_a_leaning_head_is_found() {
    let cl = "MULTAX / ON; RAPID; GOTO / 50, 0, 86.602540, 0.5, 0, 0.8660254038; RAPID; \
              GOTO / -9, 0, -15.588457, 0.5, 0, 0.8660254038";
    let nc = milled("G0 X125. Y0.; B30. C0.; G43 Z66.506 H1; X66. Z-35.685");
    let straight = &["rotary.tip_output=0", "rapid.straight=1"];
    Case { ready: "fanuc-5x-head", settings: straight, cl, nc: &nc }
        .agrees_but_not_with(("X66. Z-35.685", "X66. Z-36.685"), "Z");
    let bent = &["rotary.tip_output=0", "rapid.straight=2"];
    Case { ready: "fanuc-5x-head", settings: bent, cl, nc: &nc }
        .asks_for("rapid of several axes with a tilted head");
}

#[test]
fn a_first_turn_by_an_angle_counts_from_zero_under_an_upright_tool() {
    let cl = "RAPID; GOTO / 0, 0, 50; ROTATE / AAXIS, INCR, -90; RAPID; GOTO / 0, 0, 50";
    let nc = milled("G0 X0. Y0.; A0.; G43 Z50. H1; A-90.; Y-50.; Z0.");
    Case { ready: "fanuc-mill-a", settings: &["rotary.table_words=2"], cl, nc: &nc }
        .agrees_but_not_with(("A-90.", "A-80."), "no rapid turn to -90 degrees");
}
