//! `filpost learn`: settings from proven programs, an edit, a check.

use crate::support::Folder;

const PART: &str = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nCOOLNT / FLOOD\nRAPID\n\
    GOTO / 1, 2, 30\nFEDRAT / 200, MMPM\nGOTO / 1, 2, -0.5\nGOTO / 20.5, 2, -0.5\nRAPID\n\
    GOTO / 20.5, 2, 30\nCOOLNT / OFF\nFINI\n";

const DWELL: &str = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nRAPID\nGOTO / 1, 2, 30\n\
    FEDRAT / 200, MMPM\nGOTO / 1, 2, -0.5\nDELAY / 2\nRAPID\nGOTO / 1, 2, 30\nFINI\n";

/// A folder with a part, and its program by a post with some settings.
fn with_program(part: &str, settings: &[&str]) -> Folder {
    let place = Folder::new();
    std::fs::write(place.0.path().join("part.ncl"), part).expect("written");
    let mut words =
        vec!["post", "part.ncl", "-p", "fanuc-mill", "--option=style=plain", "-o", "part.nc"];
    words.extend(settings.iter().flat_map(|setting| ["--set", setting]));
    let posted = place.run(&words);
    assert_eq!(posted.status, 0, "{posted:?}");
    place
}

#[test]
fn settings_are_learned_with_their_proofs_and_the_cases_pass() {
    let hidden = ["seqno.increment=5", "tape.blank=1", "coolant.flood_code=88", "dwell.code=104"];
    let place = with_program(PART, &hidden);
    let words =
        ["learn", "part.ncl", "part.nc", "--base", "fanuc-mill", "-o", "mine", "--threads", "2"];
    let made = place.run(&words);
    assert_eq!(made.status, 0, "{made:?}");
    assert!(made.out.starts_with("part.nc: every byte\n"), "{}", made.out);
    let machine = place.text("mine/machine.toml").expect("settings");
    for setting in ["seqno.increment = 5", "tape.blank = 1", "coolant.flood_code = 88"] {
        let lines: Vec<&str> = machine.lines().collect();
        let at = lines.iter().position(|line| *line == setting);
        let at = at.unwrap_or_else(|| panic!("{setting} in\n{machine}"));
        assert!(lines[at - 2].starts_with("# part.nc:"), "{setting}: {}", lines[at - 2]);
    }
    assert!(machine.contains("\"dwell.code=77\""), "{machine}");
    assert_eq!(place.run(&["test", "mine"]).out, "1 passed, 0 failed\n");

    // What no pair has shown is not written quietly.
    std::fs::write(place.0.path().join("dwell.ncl"), DWELL).expect("written");
    let posted = place.run(&["post", "dwell.ncl", "-p", "mine", "-o", "dwell.nc"]);
    assert!(posted.err.contains("W0758"), "{}", posted.err);
    assert!(posted.err.contains("dwell.code=77"), "{}", posted.err);

    // A further pair decides it.
    let words =
        ["post", "dwell.ncl", "-p", "fanuc-mill", "--option=style=plain", "-o", "proven.nc"];
    let words: Vec<&str> =
        words.into_iter().chain(hidden.iter().flat_map(|set| ["--set", *set])).collect();
    assert_eq!(place.run(&words).status, 0);
    let checked = place.run(&["learn", "--check", "mine", "dwell.ncl", "proven.nc"]);
    assert_eq!(checked.status, 1, "{checked:?}");
    assert!(checked.out.contains("  - N35 G104P2000\n"), "{}", checked.out);
    assert!(checked.out.contains("dwell.code=77"), "{}", checked.out);

    // The same machine with another number of threads.
    let words =
        ["learn", "part.ncl", "part.nc", "--base", "fanuc-mill", "-o", "again", "--threads", "1"];
    assert_eq!(place.run(&words).status, 0);
    assert_eq!(place.text("again/machine.toml").as_deref(), Some(machine.as_str()));
}

#[test]
fn an_edit_is_explained() {
    let place = with_program(PART, &[]);
    let program = place.text("part.nc").expect("a program");
    assert!(program.contains("M8\n"), "{program}");
    std::fs::write(place.0.path().join("wanted.nc"), program.replace("M8\n", "M50\n"))
        .expect("written");
    let words = ["learn", "--edit", "part.ncl", "wanted.nc", "-p", "fanuc-mill"];
    let told = place.run(&words);
    assert_eq!(told.status, 0, "{told:?}");
    assert!(told.out.contains("coolant.flood_code = 50 (base 8)"), "{}", told.out);
}

#[test]
fn a_far_program_gives_no_settings() {
    let place = with_program(PART, &[]);
    let other = "%\nO1\nG71\nG0 X100. Y7.\nG1 Z-3. F50.\nM30\n%\n";
    let lines: String = (0..40).map(|at| format!("X{at}.5 Y7.\n")).collect();
    let other = other.replace("M30", &format!("{lines}M30"));
    std::fs::write(place.0.path().join("other.nc"), other).expect("written");
    let words = ["learn", "part.ncl", "other.nc", "--base", "fanuc-mill", "-o", "mine"];
    let told = place.run(&words);
    assert_eq!(told.status, 1, "{told:?}");
    assert!(told.err.contains("less than half of the blocks"), "{}", told.err);
    assert_eq!(place.text("mine/machine.toml"), None);
    let odd = place.run(&["learn", "part.ncl", "part.nc", "part.ncl"]);
    assert_eq!(odd.status, 2, "{odd:?}");
}
