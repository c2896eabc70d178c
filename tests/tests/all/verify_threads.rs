//! What the back-check finds in threads by hand.

use filpost_tests::back_check::found;

/// What the first block of G76 leaves out a parameter of the control says.
#[test]
fn a_word_left_out_of_the_first_block_of_g76_is_found() {
    let cl = "LOADTL / 1; SPINDL / RPM, 500, CLW; RAPID; GOTO / 25, 0, 4; \
              THREAD / AUTO, 20, 0, 4, TO, 20, 0, -16, MMPR, 2, DEEP, 0.4, LAST, 1, TYPE, 0, 1, 60, \
              FEDTO, 2, OUT";
    let nc = "%; O0001; G21 G99 G18; T0101; G97 S500 M3; G0 X50. Z4.; X44.; G76 P010060 Q50 R0; \
              G76 X38. Z-16. P1000 Q400 F2.; M30; %";
    assert_eq!(found("fanuc-lathe", &[], cl, nc), "");
    for word in [" P010060", " Q50", " R0"] {
        let said = found("fanuc-lathe", &[], cl, &nc.replacen(word, "", 1));
        let left = format!("{} of the first block is left to a parameter", &word[1..2]);
        assert!(said.contains(&left), "{word}: {said}");
    }
}

/// The passes of a thread meet at one speed and direction alone, whatever the CL file says.
#[test]
fn passes_at_two_speeds_are_found() {
    let pass =
        "GOTO / 20, 0, 4; GOTO / 20, 0, -16; RAPID; GOTO / 25, 0, -16; RAPID; GOTO / 25, 0, 4";
    let second = pass.replace("20,", "19,");
    let cl = |between: &str| {
        format!(
            "LOADTL / 1; SPINDL / RPM, 500, CLW; RAPID; GOTO / 25, 0, 4; THREAD / MMPR, 2; RAPID; \
             {pass}; {between}RAPID; {second}"
        )
    };
    let nc = |between: &str| {
        format!(
            "%; O0001; G21 G99 G18; T0101; G97 S500 M3; G0 X50. Z4.; X40.; G32 Z-16. F2.; G0 X50.; \
             Z4.; {between}X38.; G32 Z-16. F2.; G0 X50.; Z4.; M30; %"
        )
    };
    let said = "the spindle speed differs from the earlier passes";
    assert_eq!(found("fanuc-lathe", &[], &cl(""), &nc("")), "");
    let other = found("fanuc-lathe", &[], &cl("SPINDL / RPM, 300, CLW; "), &nc("S300; "));
    assert!(other.contains(said), "{other}");
    let other = found("fanuc-lathe", &[], &cl("SPINDL / RPM, 500, CCLW; "), &nc("M4; "));
    assert!(other.contains(said), "{other}");
    // Another THREAD is another thread.
    let fresh = cl("SPINDL / RPM, 300, CLW; THREAD / MMPR, 2; ");
    assert_eq!(found("fanuc-lathe", &[], &fresh, &nc("S300; ")), "");
}

/// Where an M code switches the way out of threads, a cycle depends on the last one.
#[test]
fn a_way_out_that_no_code_says_is_found() {
    let cl = "LOADTL / 1; SPINDL / RPM, 500, CLW; RAPID; GOTO / 25, 0, 4; \
              THREAD / AUTO, 20, 0, 4, TO, 20, 0, -16, MMPR, 2, DEEP, 0.4, LAST, 1, TYPE, 0, 1, 60, \
              FEDTO, 2, OUT";
    let nc = "%; O0001; G21 G99 G18; T101; G97 S500 M3; G0 X50. Z4.; X44.; M23; \
              G76 X38. Z-16. K1. D0.4 A60. F2.; M30; %";
    let codes = ["thread.chamfer_on_code=23", "thread.chamfer_off_code=24"];
    let with = |more: &[&'static str]| [&codes[..], more].concat();
    let leaving = with(&["thread.chamfer_tenths=10", "thread.chamfer=1"]);
    assert_eq!(found("haas-lathe", &leaving, cl, nc), "");
    assert_eq!(found("haas-lathe", &codes, cl, &nc.replace("M23", "M24")), "");
    for (settings, nc) in [
        (&leaving, nc.replace("M23; ", "")),
        (&leaving, nc.replace("M23", "M24")),
        (&with(&[]), nc.to_string()),
        (&with(&["thread.chamfer_tenths=10"]), nc.to_string()),
        (&with(&["thread.chamfer_tenths=5", "thread.chamfer=1"]), nc.to_string()),
    ] {
        assert_ne!(found("haas-lathe", settings, cl, &nc), "", "{settings:?}: {nc}");
    }
    // Nobody but a thread asks for such a code, and it may stand anywhere.
    let twice = nc.replace("M23", "M24; M23");
    assert_eq!(found("haas-lathe", &leaving, cl, &twice), "");
}

/// On a SINUMERIK the lead is the word of the axis that goes the longer way, on a taper of 45 degrees
/// that of either.
#[test]
fn the_letter_of_a_lead_on_a_taper() {
    let cl = |x: &str| {
        format!(
            "LOADTL / 1; SPINDL / RPM, 500, CLW; RAPID; GOTO / 45, 0, 5; THREAD / MMPR, 1.5; RAPID; \
             GOTO / 19.5755, 0, 2; GOTO / {x}, 0, -8; RAPID; GOTO / 45, 0, -8"
        )
    };
    let nc = |end: &str| {
        format!(
            "%_N_MPF1_MPF; G710 G90 G95 G18; DIAMON; T1; D1; G97 S500 M3; G0 X90 Z5; X39.151 Z2; \
             G33 {end}; G0 X90; M30"
        )
    };
    let check = |x: &str, end: &str| found("sinumerik-lathe", &[], &cl(x), &nc(end));
    for letter in ["I", "K"] {
        assert_eq!(check("29.5755", &format!("X59.151 Z-8 {letter}1.5")), "", "{letter}");
    }
    for (x, end, wrong) in [
        ("29.576", "X59.152 Z-8 I1.5", "X59.152 Z-8 K1.5"),
        ("29.575", "X59.15 Z-8 K1.5", "X59.15 Z-8 I1.5"),
    ] {
        assert_eq!(check(x, end), "", "{end}");
        assert!(check(x, wrong).contains("needs its lead"), "{wrong}");
    }
    assert!(check("29.5755", "X59.151 Z-8 I1.5 K1.5").contains("needs its lead"));
}

/// On an OSP the lead is F by the number of threads in it, which acts in its block.
#[test]
fn a_number_of_threads_divides_the_lead() {
    let cl = "LOADTL / 1; SPINDL / RPM, 500, CLW; RAPID; GOTO / 25, 0, 2; \
              THREAD / AUTO, 20, 0, 2, TO, 20, 0, -16, TPI, 36, DEEP, 0.4, LAST, 0, TYPE, 0, 0.5, 0, \
              FEDTO, 2, OUT";
    let nc = "G95 G18; T010101; G97 S500 M3; G0 X50. Z2.; X44.; M22; G33 X39.2 Z-16. F6.35 J9; \
              G33 X39. Z-16. F6.35 J9; M2";
    let check = |nc: &str| found("okuma-lathe", &[], cl, nc);
    assert_eq!(check(nc), "");
    for (old, new, said) in [
        ("J9", "J8", "lead"),
        (" J9", "", "lead"),
        ("F6.35 J9; M2", "F6.35; M2", "lead"),
        ("F6.35 J9; M2", "J9; M2", "lead"),
        ("J9", "J0", "divides no F"),
    ] {
        let wrong = check(&nc.replacen(old, new, 1));
        assert!(wrong.contains(said), "{new}: {wrong}");
    }
}

/// What the post refuses, the back-check finds: the tool waits in its groove while the part turns on.
#[test]
fn blocks_between_two_motions_of_a_pass_are_found() {
    let cl = |between: &str| {
        format!(
            "LOADTL / 1; SPINDL / RPM, 500, CLW; RAPID; GOTO / 20, 0, 4; THREAD / MMPR, 2; \
             GOTO / 20, 0, -10; {between}GOTO / 20, 0, -16; RAPID; GOTO / 25, 0, -16"
        )
    };
    let nc = |between: &str| {
        format!(
            "%; O0001; G21 G99 G18; T0101; G97 S500 M3; G0 X40. Z4.; G32 Z-10. F2.; {between}; \
             G0 X50.; M30; %"
        )
    };
    assert_eq!(found("fanuc-lathe", &[], &cl(""), &nc("G32 Z-16. F2.")), "");
    for (record, blocks) in [
        ("COOLNT / ON; ", "M8; G32 Z-16. F2."),
        ("OPSTOP; ", "M1; G32 Z-16. F2."),
        ("DELAY / 1; ", "G4 P1000; G32 Z-16. F2."),
        ("THREAD / MMPR, 1; COOLNT / ON; ", "M8; G32 Z-16. F1."),
    ] {
        let said = found("fanuc-lathe", &[], &cl(record), &nc(blocks));
        assert!(said.contains("blocks between two moves of one pass"), "{record}: {said}");
    }
}

/// An outside thread is approached from a bore, and a thread of a bore from outside, before the part
/// alone.
#[test]
fn a_way_to_a_thread_through_the_wall_is_found() {
    let cl = |z: f64, x: f64, side: &str| {
        format!(
            "LOADTL / 1; SPINDL / RPM, 500, CLW; RAPID; GOTO / {x}, 0, {z}; \
             THREAD / AUTO, 20, 0, 4, TO, 20, 0, -16, MMPR, 2, DEEP, 1, LAST, 0, TYPE, 0, 1, 0, \
             FEDTO, 2, {side}"
        )
    };
    let nc = |approach: &str, clear: &str, root: &str| {
        format!(
            "%; O0001; G21 G99 G18; T0101; G97 S500 M3; {approach}; X{root}; G32 Z-16. F2.; \
             G0 X{clear}; Z4.; M30; %"
        )
    };
    let check = |cl: &str, nc: &str| found("fanuc-lathe", &["thread.cycle=0"], cl, nc);
    let outside = nc("G0 X50. Z4.; X44.", "44.", "38.");
    assert_eq!(check(&cl(4.0, 25.0, "OUT"), &outside), "");
    let from_before = nc("G0 X30. Z4.; X44.", "44.", "38.");
    assert_eq!(check(&cl(4.0, 15.0, "OUT"), &from_before), "");
    let wall = "goes through the wall of the part";
    let through = nc("G0 X30. Z-10.; X44.; Z4.", "44.", "38.");
    let said = check(&cl(-10.0, 15.0, "OUT"), &through);
    assert!(said.contains(wall), "{said}");
    let slanted = nc("G0 X30. Z-10.; X44. Z4.", "44.", "38.");
    let said = check(&cl(-10.0, 15.0, "OUT"), &slanted);
    assert!(said.contains(wall), "{said}");
    let into_the_bore = nc("G0 X50. Z-10.; X36.; Z4.", "36.", "42.");
    let said = check(&cl(-10.0, 25.0, "IN"), &into_the_bore);
    assert!(said.contains(wall), "{said}");
    let before = nc("G0 X50. Z4.; X36.", "36.", "42.");
    assert_eq!(check(&cl(4.0, 25.0, "IN"), &before), "");
}

/// Behind a whole thread the tool stands clear of it, from where the next one takes its side and the
/// level that it goes back to.
#[test]
fn a_thread_right_behind_another_one_is_compared() {
    let cl = "LOADTL / 1; SPINDL / RPM, 500, CLW; RAPID; GOTO / 25, 0, 4; \
              THREAD / AUTO, 20, 0, 4, TO, 20, 0, -16, MMPR, 2, DEEP, 1, LAST, 0, TYPE, 0, 1, 0, \
              FEDTO, 2, OUT; OP / THREAD, TURN, DEPTH, 1, MMPR, 2, CUTS, 1, FINCUT, 0; \
              GOTO / 18, 0, -20; GOTO / 18, 0, -40";
    let nc = "%; O0001; G21 G99 G18; T0101; G97 S500 M3; G0 X50. Z4.; X44.; X38.; G32 Z-16. F2.; \
              G0 X44.; Z4.; Z-20.; X34.; G32 Z-40. F2.; G0 X44.; Z-20.; M30; %";
    let check = |nc: &str| found("fanuc-lathe", &["thread.cycle=0"], cl, nc);
    assert_eq!(check(nc), "");
    assert!(check(&nc.replace("X34.", "X34.2")).contains("the root is not reached"));
    let low = nc.replace("G0 X44.; Z-20.; M30", "G0 X40.; Z-20.; M30");
    assert!(check(&low).contains("clearance plane of the thread"), "{}", check(&low));
}
