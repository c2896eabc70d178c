//! Bad inputs are refused with a sentence that says what is wrong.

use super::{SCRIPTS, pass_cl, post};

/// What a script says, with the line of the CL file; the text of the NC program
/// where it refuses nothing.
fn refusal(script: &str, cl: &str) -> (String, String) {
    let error = match post(Some(script), cl) {
        Ok((nc, _)) => panic!("{script} takes\n{cl}\nand writes\n{nc}"),
        Err(error) => error,
    };
    let diag = &error.diags()[0];
    let record = diag.notes.iter().find(|note| note.starts_with("record ")).cloned();
    (format!("{} {}", diag.code.name(), diag.message), record.unwrap_or_default())
}

/// The CL file of the case with one line changed.
fn changed(from: &str, to: &str) -> String {
    let cl = pass_cl();
    assert_eq!(cl.matches(from).count(), 1, "{from}");
    cl.replace(from, to)
}

/// Both scripts refuse a change of the case's CL file, at this record.
fn both_refuse(from: &str, to: &str, message: &str, record: &str) {
    for script in SCRIPTS {
        let (found, at) = refusal(script, &changed(from, to));
        assert_eq!(found, format!("E0325 {message}"), "{script}");
        assert!(at.contains(record), "{script} stops at {at}, not at {record}");
    }
}

const ON: &str = "FEDCTL / ON, RADIUS, 5.000000, STOCK, 0.250000";

#[test]
fn couplets_that_are_missing_or_wrong() {
    let radius = "FEDCTL/ON NEEDS THE RADIUS OF THE BALL: RADIUS,R WITH R ABOVE 0";
    let stock = "FEDCTL/ON NEEDS THE STOCK OF THE OPERATION BEFORE: STOCK,T WITH T FROM 0";
    both_refuse(ON, "FEDCTL / ON, STOCK, 0.25", radius, "CL line 7:");
    both_refuse(ON, "FEDCTL / ON, RADIUS, 0, STOCK, 0.25", radius, "CL line 7:");
    both_refuse(ON, "FEDCTL / ON, RADIUS, -5, STOCK, 0.25", radius, "CL line 7:");
    both_refuse(ON, "FEDCTL / ON, RADIUS, 5", stock, "CL line 7:");
    both_refuse(ON, "FEDCTL / ON, RADIUS, 5, STOCK, -0.1", stock, "CL line 7:");
    both_refuse(ON, "FEDCTL / RADIUS, 5", "FEDCTL TAKES ON OR OFF", "CL line 7:");
}

#[test]
fn records_the_pass_needs() {
    let speed = "NO SPINDL/RPM BEFORE FEDCTL/ON: THE FEED FOLLOWS THE SPEED";
    both_refuse("SPINDL / RPM, 1000.000000, CLW\n", "", speed, "FEDCTL");
    both_refuse("FEDCTL / OFF\n", "", "FEDCTL/ON HAS NO FEDCTL/OFF", "FINI");
    let inches = "FEDCTL counts in mm, this CL file in inches";
    both_refuse("UNITS / MM", "UNITS / INCHES", inches, "FEDCTL");
    let item = "FEDCTL: item 4 after the / is misspelt, or one too many";
    both_refuse(ON, "FEDCTL / ON, RADIUS, 5, STOK, 0.25", item, "FEDCTL");
    let twice = "FEDCTL: RADIUS,R is there twice";
    both_refuse(ON, "FEDCTL / ON, RADIUS, 5, STOCK, 0.25, RADIUS, 6", twice, "FEDCTL");
    let turned = "FEDCTL: the TRANS that is on turns or scales the points";
    both_refuse(
        "FEDCTL / ON",
        "TRANS / -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0\nFEDCTL / ON",
        turned,
        "FEDCTL",
    );
    let held = "FEDCTL is on: TRANS would move half of it";
    both_refuse("GOTO / 9.0000", "TRANS / 0, 0, 5\nGOTO / 9.0000", held, "TRANS");
    let rapid = "A PASS BEGINS WITH A RAPID MOVE TO ITS FIRST POINT";
    both_refuse("STOCK, 0.250000\nRAPID\n", "STOCK, 0.25\n", rapid, "CL line 8:");
    let (found, _) = refusal("feed-ahead.fil", &changed("FEDRAT / 5.000000, MMPM\n", ""));
    assert_eq!(found, "E0325 NO FEDRAT IN MMPM BEFORE FEDCTL/ON: IT IS THE FEED FOR THE FLOOR");
    let (found, _) =
        refusal("feed-ahead.fil", &changed("GOTO / 9.0000", "FEDRAT / 0.1, MMPR\nGOTO / 9.0000"));
    assert_eq!(found, "E0325 FEED CONTROL NEEDS FEDRAT IN MMPM");
}

#[test]
fn moves_that_have_no_angle_or_no_radius() {
    let ninth = "GOTO / 9.0000, 0.0000, -22.7560\n";
    both_refuse(
        ninth,
        "CIRCLE / 9, 0, -22, 0, 1, 0, 4\n",
        "BETWEEN FEDCTL/ON AND OFF A MOVE IS A GOTO",
        "CIRCLE",
    );
    both_refuse(
        ninth,
        "GODLTA / 0, 0, -1\n",
        "BETWEEN FEDCTL/ON AND OFF A MOVE IS A GOTO",
        "GODLTA",
    );
    both_refuse(
        ninth,
        "MULTAX / ON\nGOTO / 9, 0, -22.756, 0.6, 0, 0.8\n",
        "THE FORMULAS ARE FOR A TOOL ALONG Z",
        "GOTO",
    );
    let twice = ninth.repeat(2);
    let (found, _) = refusal("feed-l400.fil", &changed(ninth, &twice));
    assert_eq!(found, "E0325 A MOVE OF LENGTH 0 HAS NO ANGLE");
    let (found, _) = refusal("feed-ahead.fil", &changed(ninth, &twice));
    assert_eq!(found, "E0325 THE NEXT POINT IS THIS ONE AGAIN");
    let start = "RAPID\nGOTO / 15.0000, 0.0000, -4.3650\n";
    let (found, _) = refusal("feed-ahead.fil", &changed(start, &format!("{start}{}", &start[6..])));
    assert_eq!(found, "E0325 A MOVE OF LENGTH 0 HAS NO ANGLE");
    let there_and_back = format!("{ninth}GOTO / 10.5000, 0.0000, -18.8290\n");
    let (found, _) = refusal("feed-ahead.fil", &changed(ninth, &there_and_back));
    assert_eq!(found, "E0325 THE PATH TURNS BACK ON ITSELF");
    let one = "UNITS/MM\nSPINDL/RPM,500\nFEDRAT/5,MMPM\nFEDCTL/ON,RADIUS,5,STOCK,0.2\nRAPID\n\
               GOTO/0,0,0\nGOTO/1,0,0\nRAPID\nGOTO/1,0,9\nFINI\n";
    let (found, _) = refusal("feed-ahead.fil", one);
    assert_eq!(found, "E0325 A PASS OF ONE CUT HAS NO RADIUS: THREE POINTS ARE NEEDED");
    let small = "UNITS/MM\nSPINDL/RPM,500\nFEDRAT/5,MMPM\nFEDCTL/ON,RADIUS,0.4,STOCK,0.2\nRAPID\n\
                 GOTO/0.5,0,0\nGOTO/0,0,-0.5\nGOTO/-0.5,0,0\nRAPID\nGOTO/0,0,9\nFINI\n";
    let (found, _) = refusal("feed-ahead.fil", small);
    assert_eq!(
        found,
        "E0325 NO FEED FOR A PATH OF RADIUS 0.500 AND A BALL OF 0.4: \
         THE FORMULAS NEED MORE THAN 1 TOGETHER"
    );
}

#[test]
fn the_last_point_needs_a_way_out() {
    let cl = changed("RAPID\nGOTO / 0.0000, 0.0000, 200.0000\n", "");
    let (found, _) = refusal("feed-ahead.fil", &cl);
    assert_eq!(found, "E0316 there is no next motion");
    let cl = changed("SEQNO / 1060\nRAPID\n", "SEQNO / 1060\n");
    let (found, _) = refusal("feed-ahead.fil", &cl);
    assert_eq!(found, "E0325 A PASS ENDS WITH A RAPID MOVE: AFTER FEDCTL/OFF COMES A CUT");
}
