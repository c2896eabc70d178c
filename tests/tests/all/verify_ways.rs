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
            "on no way to its",
        ),
        ("corpus/sinumerik/tools", "\nN60 Z50", "\nN55 Z-30\nN60 Z50", "on no way to its"),
        ("corpus/sinumerik/tapping", "N150 X0 Y0", "N145 X=IC(1)\nN150 X0 Y0", "on no way to its"),
        (
            "corpus/posts/fanuc-5x-tables/faces",
            "N140 X-14.537",
            "N135 A1.\nN140 X-14.537",
            "on no way to its end",
        ),
        ("corpus/posts/fanuc-5x-head/holes", "N60 X7.519", "N55 B1.\nN60 X7.519", "on no way to"),
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
            "D1 is in force on the way to a position of the machine, which its length shifts",
        ),
        ("corpus/sinumerik/machine-positions", "N100 G53 G0 Z0 D0", "N100 G53 G0 Z0", "D1 is in"),
        (
            "corpus/lathe/fanuc-mill-turn/compensated",
            "M30",
            "M30 S77",
            "the spindle has 77 turns/min, none is asked for",
        ),
        (
            "corpus/lathe/fanuc-mill-turn/turn-then-drill",
            "T0505",
            "T0505 S77",
            "the spindle has 77 turns/min, none is asked for",
        ),
        // A plane that nobody has asked for, whose normal the length of the tool acts along.
        ("corpus/sinumerik/tools", "N60 Z50", "N60 G18 Z50", "G18 of line 7 is in force"),
        ("corpus/sinumerik/tools", "\nN70 G1", "\nN65 G19\nN70 G1", "G19 of line 8 is in force"),
        ("corpus/sinumerik/planes", "N60 Z50", "N60 G19 Z50", "G19 of line 7 is in force"),
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
        ("corpus/klartext/tools", "\n16 L", "\n15 CYCL DEF 7.0\n16 L", "nothing says its values"),
        ("corpus/klartext/tools", "\n16 L", "\n15 CYCL DEF 9.0\n16 L", "nothing says its values"),
        ("corpus/klartext/tools", "\n16 L", "\n15 CYCL DEF 32.0\n16 L", "nothing says its values"),
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
        ("corpus/sinumerik/orient", "N120 M5", "N120 M5 S77", "the spindle has 77 turns/min"),
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
            "which is on no way to its end",
        ),
    ] {
        let case = cases.iter().find(|case| case.name == name);
        let case = case.unwrap_or_else(|| panic!("no case {name}"));
        assert!(said(case, old, old).is_empty(), "{name}: {}", said(case, old, old));
        let found = said(case, old, new);
        assert!(found.contains(message), "{name}, `{old}` is `{new}`:\n{found}");
    }
}
