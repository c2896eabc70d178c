//! What the back-check says of holes and arcs that a post could leave out or change without a word.

use filpost_tests::back_check::found;

const TOOL: &str = "LOADTL / 1; SPINDL / RPM, 3000, CLW; RAPID; GOTO / 0, 0, 50; \
                    FEDRAT / 200, MMPM; GOTO / 0, 0, 5";
const FANUC: &str = "%; O0001 (1); G21 G90 G94 G17; T1 M6; S3000 M3; G0 X0. Y0.; G43 Z50. H1; \
                     G1 Z5. F200.";

/// RAPID right before CYCLE is of the way to its first hole, which must be drilled.
#[test]
fn a_hole_that_a_rapid_swallows_is_found() {
    let cl = format!(
        "{TOOL}; RAPID; CYCLE / DRILL, DEPTH, 12, MMPM, 150, CLEAR, 2; GOTO / 10, 10, 0; \
         GOTO / 20, 10, 0; CYCLE / OFF"
    );
    let first = "G99 G81 X10. Y10. Z-12. R2. F150.";
    let nc = format!("{FANUC}; {first}; X20.; G80; M30; %");
    let check = |nc: &str| found("fanuc-mill", &[], &cl, nc);
    assert_eq!(check(&nc), "");
    let swallowed = nc.replace(first, "G0 X10. Y10.; Z0.; G99 G81 X20. Z-12. R2. F150.");
    assert_ne!(check(&swallowed.replace("; X20.; G80", "; G80")), "");
}

/// No reading of an arc is certain whose end is its start but for a rounding.
#[test]
fn an_arc_that_is_a_full_turn_or_none_is_not_followed() {
    let around = |by: f64, times: &str| {
        format!("{TOOL}; CIRCLE / 0, 10, 5, 0, 0, 1, 10{times}; GOTO / {by}, 0, 4; GOTO / 5, 0, 4")
    };
    let full = format!("{FANUC}; G3 Z4. I0. J10.; G1 X5.; M30; %");
    let none = format!("{FANUC}; Z4.; X5.; M30; %");
    for by in [0.0004, -0.0004] {
        for nc in [&full, &none] {
            let said = found("fanuc-mill", &[], &around(by, ""), nc);
            assert!(said.contains("a full turn or none"), "{by}: {said}");
        }
    }
    assert_eq!(found("fanuc-mill", &[], &around(0.0, ""), &full), "");
    assert_eq!(found("fanuc-mill", &[], &around(0.0004, ", TIMES, 1"), &full), "");
    assert_ne!(found("fanuc-mill", &[], &around(0.0, ""), &none), "");
}

/// A drill whose feed a turn is told by the minute keeps it no longer where somebody turns the
/// spindle down.
#[test]
fn a_feed_a_turn_that_is_told_by_the_minute_is_found() {
    let cl = format!(
        "{TOOL}; CYCLE / DRILL, DEPTH, 12, MMPR, 0.05, CLEAR, 2; GOTO / 10, 10, 0; CYCLE / OFF"
    );
    let nc = |mode: &str, feed: &str| {
        format!("{FANUC}; {mode}G99 G81 X10. Y10. Z-12. R2. F{feed}; G80; M30; %")
    };
    assert_eq!(found("fanuc-mill", &[], &cl, &nc("G95 ", ".05")), "");
    let said = found("fanuc-mill", &[], &cl, &nc("", "150."));
    assert!(said.contains("feed 150 mm/min, it should be 0.05 mm/rev"), "{said}");
}

/// G81, G83, G85 and G86 pass over P.
#[test]
fn a_dwell_in_a_cycle_that_takes_none_is_found() {
    let cl = |kind: &str| {
        format!(
            "{TOOL}; CYCLE / {kind}, DEPTH, 12, MMPM, 100, CLEAR, 5, DWELL, 1; GOTO / 10, 10, 0; \
             CYCLE / OFF"
        )
    };
    let nc =
        |code: &str| format!("{FANUC}; G99 {code} X10. Y10. Z-12. R5. P1000 F100.; G80; M30; %");
    let said = "no dwell at the bottom of the hole";
    for (kind, code, settings, is_found) in [
        ("BORE", "G86", "cycle.bore_code=86", true),
        ("DRILL", "G81", "cycle.drill_code=81", true),
        ("REAM", "G85", "cycle.ream_code=85", true),
        ("BORE", "G89", "cycle.bore_code=89", false),
        ("CSINK", "G82", "cycle.csink_code=82", false),
    ] {
        let wrong = found("fanuc-mill", &[settings], &cl(kind), &nc(code));
        assert_eq!(wrong.contains(said), is_found, "{kind}: {wrong}");
        assert_eq!(wrong.is_empty(), !is_found, "{kind}: {wrong}");
    }
}

/// At a feed a minute another speed is another lead.
#[test]
fn a_tap_at_another_speed_than_the_hole_before_is_found() {
    let cl = |lead: &str| {
        format!(
            "{TOOL}; CYCLE / TAP, DEPTH, 12, {lead}, CLEAR, 4; GOTO / 10, 10, 0; \
             SPINDL / RPM, 600, CLW; GOTO / 20, 10, 0; CYCLE / OFF"
        )
    };
    let nc = |feed: &str| {
        format!("{FANUC}; G99 G84 X10. Y10. Z-12. R4. {feed}; S600 M3; X20.; G80; M30; %")
    };
    let said = found("fanuc-mill", &[], &cl("MMPM, 3000"), &nc("F3000."));
    assert!(said.contains("CYCLE/TAP at another speed"), "{said}");
    assert_eq!(found("fanuc-mill", &[], &cl("MMPR, 1"), &nc("G95 F1.")), "");
}

/// A depth below the last digit is no hole.
#[test]
fn a_hole_of_no_depth_is_found() {
    let cl = |depth: &str| {
        format!(
            "{TOOL}; CYCLE / DRILL, DEPTH, {depth}, MMPM, 150, CLEAR, 2; GOTO / 10, 10, 0; \
             CYCLE / OFF"
        )
    };
    let fanuc = format!("{FANUC}; G99 G81 X10. Y10. Z0. R2. F150.; G80; M30; %");
    let said = found("fanuc-mill", &[], &cl("0.0003"), &fanuc);
    assert!(said.contains("less than the last digit"), "{said}");
    let deep = fanuc.replace("Z0. R2.", "Z-0.01 R2.");
    assert_eq!(found("fanuc-mill", &[], &cl("0.01"), &deep), "");
}

/// A TRANS that makes all lengths longer alike keeps circles, and which lengths of a hole it scales
/// nobody knows.
#[test]
fn a_frame_that_scales_is_followed_in_arcs_alone() {
    let scale = "TRANS / 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0";
    let arc =
        format!("{TOOL}; {scale}; GOTO / 10, 0, 5; CIRCLE / 0, 0, 5, 0, 0, 1, 10; GOTO / 0, 10, 5");
    let nc = format!("{FANUC}; X20. Z10.; G3 X0. Y20. I-20. J0.; M30; %");
    let check = |nc: &str| found("fanuc-mill", &[], &arc, nc);
    assert_eq!(check(&nc), "");
    assert_ne!(check(&nc.replace("G3 X0. Y20. I-20. J0.", "X0. Y20.")), "");
    let hole = format!(
        "{TOOL}; {scale}; CYCLE / DRILL, DEPTH, 12, MMPM, 150, CLEAR, 2; GOTO / 10, 10, 0; \
         CYCLE / OFF"
    );
    let nc = format!("{FANUC}; G99 G81 X20. Y20. Z-24. R4. F150.; G80; M30; %");
    let said = found("fanuc-mill", &[], &hole, &nc);
    assert!(said.contains("a hole in a frame that scales its lengths"), "{said}");
}

/// `tool.modal` leaves out a tool that is in the spindle with the cutting edge that is asked for.
#[test]
fn a_tool_of_a_sinumerik_that_is_in_the_spindle_may_be_left_out() {
    let cl = format!("{TOOL}; LOADTL / 1; GOTO / 10, 0, 5");
    let nc =
        "%_N_N_1_MPF; G710 G90 G94 G17; T1 M6; D1; S3000 M3; G0 X0 Y0; Z50; G1 Z5 F200; X10; M30";
    assert_eq!(found("sinumerik-840d", &["tool.modal=1"], &cl, nc), "");
    assert_eq!(found("sinumerik-840d", &[], &cl, nc), "");
    let other = format!("{TOOL}; LOADTL / 2; GOTO / 10, 0, 5");
    assert_ne!(found("sinumerik-840d", &[], &other, nc), "");
}
