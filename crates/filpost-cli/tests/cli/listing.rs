//! The listing: its rows, its totals, what settings leave out, lines that a script edits.

use super::support::Folder;

/// Two tools, 60 mm at feed and 12 mm of two holes, with known times.
const PART: &str = "PARTNO/TWO TOOLS\nUNITS/MM\nPPRINT/FACE\nLOADTL/1\nSPINDL/RPM,1000,CLW\n\
                    FEDRAT/600,MMPM\nRAPID\nGOTO/0,0,10\nGOTO/60,0,10\nLOADTL/2\nRAPID\n\
                    GOTO/60,0,10\nCYCLE/DRILL,DEPTH,5,MMPM,60,CLEAR,1\nGOTO/60,0,0\nCYCLE/OFF\n\
                    INSERT/M25\nFINI\n";

const SETTINGS: [&str; 4] =
    ["rapid.rate=6000", "tool.change_time=3", "seqno.off_at_start=72", "units.mode=2"];

/// The listing of the part with settings on top and a script.
fn listing(settings: &[&str], fil: &str) -> String {
    let place = Folder::new().with("part.ncl", PART).with("post.fil", format!("{fil}FINI\n"));
    let mut arguments =
        vec!["post", "part.ncl", "-p", "fanuc-mill", "-f", "post.fil", "--listing", "part.lst"];
    for setting in SETTINGS.iter().chain(settings) {
        arguments.extend(["--set", setting]);
    }
    let ran = place.run(&arguments);
    assert_eq!(ran.status, 0, "{ran:?}");
    place.text("part.lst").expect("a listing")
}

/// The line that holds a text.
fn line<'t>(text: &'t str, part: &str) -> &'t str {
    let found = text.lines().find(|line| line.contains(part));
    found.unwrap_or_else(|| panic!("no line with {part} in\n{text}"))
}

#[test]
fn each_statement_stands_before_its_motion_and_its_blocks() {
    let text = listing(&[], "");
    let at = |part: &str| text.find(part).unwrap_or_else(|| panic!("no {part} in\n{text}"));
    assert!(
        at("GOTO / 60.0, 0.0, 10.0") < at("at X 60  Y 0  Z 10  feed 600  way 60  6 s"),
        "{text}"
    );
    assert!(at("at X 60  Y 0  Z 10  feed 600") < at("G1 X60."), "{text}");
    assert!(at("INSERT") < at("M25"), "{text}");
}

#[test]
fn totals_are_those_of_the_feeds_and_the_settings() {
    let text = listing(&[], "");
    // 60 mm at 600 mm/min are 6 s, 6 mm of the hole at 60 mm/min are 6 s and 0.06 s back;
    // two tool changes of 3 s.
    assert_eq!(line(&text, "Time:").trim(), "Time:    0:00:18 in all");
    assert!(line(&text, "CL points:").contains("X 0 to 60, Y 0 to 0, Z 0 to 10"), "{text}");
    let tools: Vec<&str> = text.lines().filter(|line| line.starts_with("Tool:")).collect();
    assert_eq!(tools, ["Tool:    T1, 0:00:09", "Tool:    T2, 0:00:09"], "{text}");
    let characters = line(&text, "Program:");
    let number = |before: &str| -> f64 {
        let words: Vec<&str> = characters.split([' ', ',']).collect();
        let at = words.iter().position(|word| *word == before).expect("the word");
        words[at - 1].parse().expect("a number")
    };
    assert!((number("m") - number("characters") * 0.00254).abs() < 0.006, "{characters}");
}

#[test]
fn settings_say_which_lines_there_are() {
    let all = listing(&[], "");
    for (setting, part) in [
        ("list.input=0", "GOTO / 60.0, 0.0, 10.0"),
        ("list.verification=0", "feed 600  way 60"),
        ("list.tape_image=0", "G1 X60."),
        ("tool.list_times=0", "Tool:    T1"),
        ("list.skip=2", "FACE"),
        ("list.skip=4", "INSERT"),
        ("list.skip=8", "PARTNO"),
    ] {
        assert!(all.contains(part), "{part} in\n{all}");
        let text = listing(&[setting], "");
        let gone = match part {
            "FACE" => !text.lines().any(|line| line.contains("PPRINT")),
            _ => !text.contains(part),
        };
        assert!(gone, "{setting}: {part} in\n{text}");
        assert!(text.contains("Program:"), "{setting}\n{text}");
    }
}

#[test]
fn blocks_as_written_are_those_of_the_tape() {
    let fil = "CIMFIL/ON,INSERT\nDMY=POSTF(13)\nCIMFIL/OFF\n";
    let formatted = listing(&[], fil);
    assert!(line(&formatted, "M25 <").starts_with("      "), "{formatted}");
    let bare = listing(&["list.tape_image=2"], fil);
    assert!(bare.lines().any(|line| line == "M25"), "{bare}");
}

#[test]
fn pages_have_headings() {
    let text = listing(&["list.pages=1", "list.lines_per_page=10"], "");
    let headings: Vec<usize> =
        (0..).zip(text.lines()).filter(|(_, l)| l.starts_with("Page ")).map(|(at, _)| at).collect();
    assert!(headings.len() > 2, "{text}");
    assert!(headings.iter().all(|at| at % 10 == 0), "{headings:?}\n{text}");
    assert_eq!(line(&text, "Page 2"), "Page 2");
}

#[test]
fn warnings_can_stay_out() {
    let fil = "CIMFIL/ON,INSERT\nAA=ZZ\nDMY=POSTF(13)\nCIMFIL/OFF\n";
    assert!(listing(&[], fil).contains("ZZ was never set"));
    assert!(!listing(&["list.suppress_warnings=1"], fil).contains("ZZ was never set"));
}

#[test]
fn a_setting_acts_on_the_lines_after_it() {
    let fil = "CIMFIL/ON,SPINDL\nDMY=POSTF(13)\nDMY=POSTF(2,1,1917,0)\nCIMFIL/OFF\n";
    let text = listing(&[], fil);
    assert!(text.contains("LOADTL / 1.0") && !text.contains("LOADTL / 2.0"), "{text}");
}

#[test]
fn a_script_edits_lines_and_leaves_some_out() {
    let fil = "$$ filpost: allow-file E0227\n_LSTWT=MACRO/LINE\nIF(INDXF(LINE,'M25').GT.0)THEN\nLINE='>> EDITED'\nENDIF\n\
               IF(INDXF(LINE,'FEDRAT').GT.0)THEN\nLINE=''\nENDIF\nTERMAC\n";
    let text = listing(&["tape.block_macro=2"], fil);
    assert!(text.lines().any(|line| line == ">> EDITED"), "{text}");
    assert!(!text.contains("M25") && !text.contains("FEDRAT"), "{text}");
    assert!(text.contains("GOTO / 60.0, 0.0, 10.0"), "{text}");
}
