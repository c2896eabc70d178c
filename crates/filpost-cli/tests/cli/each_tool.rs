//! `filpost post --each-tool`: a CL file and a program for each tool change.

use crate::support::Folder;

const TWO_TOOLS: &str = "PARTNO / PLATE\nUNITS / MM\nPPRINT / ONE\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
    FEDRAT / 200, MMPM\nRAPID\nGOTO / 1, 2, 30\nGOTO / 1, 2, -3\nRAPID\nGOTO / 1, 2, 30\n\
    PPRINT / TWO\nLOADTL / 2\nSPINDL / RPM, 800, CLW\nRAPID\nGOTO / 5, 2, 30\nGOTO / 5, 2, -4\n\
    RAPID\nGOTO / 5, 2, 30\nFINI\n";

#[test]
fn each_tool_has_a_program_that_is_verified_and_traced() {
    let place = Folder::new().with("part.ncl", TWO_TOOLS);
    let post = ["post", "part.ncl", "-p", "grbl", "-o", "out.nc", "--each-tool", "--map"];
    let ran = place.run(&post);
    assert_eq!(ran.status, 0, "{ran:?}");
    let written = ["t1.nc", "t1.nc.map", "t1.ncl", "t2.nc", "t2.nc.map", "t2.ncl"];
    let written = written.map(|name| format!("out_{name}"));
    assert_eq!(place.files(), [&written[..], &["part.ncl".to_string()]].concat());
    let [first, second] = ["out_t1.nc", "out_t2.nc"].map(|name| place.text(name).unwrap());
    assert!(first.contains("(ONE)") && first.contains("G1 Z-3. F200."), "{first}");
    assert!(!first.contains("TWO") && !first.contains("Z-4."), "{first}");
    assert!(second.contains("(TWO)") && second.contains("G1 Z-4. F200."), "{second}");
    assert!(!second.contains("ONE") && !second.contains("S900"), "{second}");
    for number in ["1", "2"] {
        let [cl, nc] = ["ncl", "nc"].map(|end| format!("out_t{number}.{end}"));
        let verified = place.run(&["verify", &cl, &nc, "-p", "grbl"]);
        assert_eq!(verified.status, 0, "{verified:?}");
    }
    let crossed = place.run(&["verify", "out_t1.ncl", "out_t2.nc", "-p", "grbl"]);
    assert_eq!(crossed.status, 1, "{crossed:?}");
    // Lines of the CL file keep their numbers.
    let line = second.lines().position(|line| line.contains("Z-4.")).unwrap() + 1;
    let traced = place.run(&["trace", &format!("out_t2.nc:{line}")]);
    assert!(traced.out.contains("out_t2.ncl:17: GOTO / 5.0, 2.0, -4.0"), "{traced:?}");
}

#[test]
fn a_tool_that_comes_again_has_another_program() {
    let again = TWO_TOOLS.replace("FINI\n", "")
        + "LOADTL / 1\nSPINDL / RPM, 700, CLW\nRAPID\nGOTO / 9, 2, 30\nFINI\n";
    let place = Folder::new().with("part.ncl", again);
    let ran = place.run(&["post", "part.ncl", "-p", "fluidnc", "-o", "out.nc", "--each-tool"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let third = place.text("out_t1_2.nc").unwrap();
    assert!(third.contains("S700 M3") && third.contains("X9."), "{third}");
}

#[test]
fn what_goes_on_over_a_tool_change_is_refused() {
    let cl = TWO_TOOLS.replace("SPINDL / RPM, 800, CLW\n", "");
    let place = Folder::new().with("part.ncl", cl).with("none.ncl", "UNITS / MM\nFINI\n");
    let post = |cl| place.run(&["post", cl, "-p", "grbl", "-o", "out.nc", "--each-tool"]);
    let ran = post("part.ncl");
    assert!(
        ran.status == 1 && ran.err.starts_with("E0724 ") && ran.err.contains("[part.ncl:15:1]"),
        "{ran:?}"
    );
    assert_eq!(place.text("out_t2.nc"), None);
    let none = post("none.ncl");
    assert!(none.status == 1 && none.err.contains("no tool change"), "{none:?}");
    let without = place.run(&["post", "part.ncl", "-p", "grbl", "--each-tool"]);
    assert_eq!(without.status, 2, "{without:?}");
}
