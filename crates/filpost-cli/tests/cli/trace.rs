//! `filpost post --map` and `filpost trace`

use crate::support::{Folder, Ran, SMALL, WRONG};

const CL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\n\
                  REPEAT / 13, 8\nCOOLNT / FLOOD\nRAPID\nGOTO / 1, 2, 3\nGOTO / 4, 5, 6\n\
                  CYCLE / DRILL, DEPTH, 5, MMPM, 100, CLEAR, 2\nGOTO / 5, 5, 6\nCYCLE / OFF\n\
                  GOTO / 5, 5, 8\nCIRCLE / 5, 6, 8, 0, 0, 1, 1\nGOTO / 5, 7, 8\nFINI\n";

const FIL: &str = "EXTRA = MACRO/AA\nPOSTN/OUT,M,AA\nTERMAC\nCIMFIL/ON,SPINDL\nDMY=POSTF(13)\n\
                   CALL/EXTRA,AA=8\nCIMFIL/OFF\nCIMFIL/ON,COOLNT\nBB=1\nCIMFIL/OFF\nFINI\n";

/// A folder with a part, its FIL, its program and the map.
fn posted() -> Folder {
    let place = Folder::new().with("part.ncl", CL).with("m.fil", FIL);
    let ran = place.run(&["post", "part.ncl", "-f", "m.fil", "-o", "part.tap", "--map"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    place
}

fn trace(place: &Folder, question: &str) -> Ran {
    let ran = place.run(&["trace", question]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""), "{question}: {ran:?}");
    ran
}

#[test]
fn answers_go_in_all_directions() {
    let place = posted();
    let questions = [
        "part.tap:3",
        "part.tap:5",
        "part.tap:6",
        "part.tap:7",
        "part.tap:7:5",
        "part.tap:9",
        "part.tap:11",
        "part.tap:13",
        "part.ncl:4",
        "part.ncl:5",
        "part.ncl:7",
        "m.fil:2",
        "m.fil:1",
    ];
    let answers: String = questions
        .iter()
        .map(|question| format!("$ filpost trace {question}\n{}\n", trace(&place, question).out))
        .collect();
    insta::assert_snapshot!("answers", answers);
}

#[test]
fn answers_are_data_too() {
    let place = posted();
    let ran = place.run(&["trace", "--format", "json", "part.tap:6"]);
    let answer: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    let line = &answer["lines"][0];
    assert_eq!((&line["number"], &line["text"]), (&6.into(), &"N40 M8".into()));
    assert_eq!((&line["made"]["record"], &line["made"]["section"]), (&4.into(), &"SPINDL".into()));
    assert_eq!(line["made"]["fil"][0]["line"], 2);
    assert_eq!(line["made"]["fil"][1]["text"], "CALL/EXTRA,AA=8");
    assert_eq!(
        (&line["words"][1]["text"], &line["words"][1]["made_by_fil"]),
        (&"M8".into(), &true.into())
    );
    let ran = place.run(&["trace", "--format", "json", "part.ncl:7"]);
    let answer: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!((&answer["taken"][0]["section"], &answer["in_all"]), (&"COOLNT".into(), &0.into()));
}

#[test]
fn a_map_is_the_same_wherever_the_files_lie() {
    let maps: Vec<_> = (0..2)
        .map(|_| {
            let place =
                Folder::new().folder("cl").folder("nc").with("cl/part.ncl", CL).with("m.fil", FIL);
            let path = |name: &str| place.0.path().join(name).display().to_string();
            let (cl, fil, nc) = (path("cl/part.ncl"), path("m.fil"), path("nc/part.tap"));
            let ran = place.run(&["post", &cl, "-f", &fil, "-o", &nc, "--map"]);
            assert_eq!(ran.status, 0, "{ran:?}");
            let answer = trace(&place, "nc/part.tap:6").out;
            assert!(
                answer.contains("m.fil:2: POSTN/OUT") && answer.contains("cl/part.ncl:4"),
                "{answer}"
            );
            let ran = place.run(&["trace", "m.fil:2", "--map", "nc/part.tap.map"]);
            assert!(ran.out.contains("line 6: N40 M8"), "{ran:?}");
            place.bytes("nc/part.tap.map")
        })
        .collect();
    assert_eq!(maps[0], maps[1]);
}

#[test]
fn the_program_is_the_same_with_a_map() {
    let place = posted();
    let plain = place.run(&["post", "part.ncl", "-f", "m.fil"]);
    assert_eq!(place.text("part.tap"), Some(plain.out));
}

#[test]
fn a_map_has_the_name_that_is_given() {
    let place = Folder::new().with("part.ncl", SMALL);
    let ran = place.run(&["post", "part.ncl", "--map", "other.map"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let place = place.with("part 1.tap", &ran.out);
    let ran = place.run(&["trace", "part 1.tap:4", "--map", "other.map"]);
    assert!(ran.out.contains("T1   word 4 (1)"), "{ran:?}");
    let stream = place.run(&["post", "part.ncl", "--map"]);
    assert!(stream.status == 2 && stream.err.contains("--map needs a FILE"), "{stream:?}");
}

#[test]
fn a_map_replaces_no_other_file() {
    let place = Folder::new().with("part.ncl", SMALL).with("other.ncl", SMALL);
    let ran = place.run(&["post", "--map", "other.ncl", "part.ncl", "-o", "part.tap"]);
    assert!(ran.status == 1 && ran.err.contains("E0802"), "{ran:?}");
    assert_eq!(place.text("other.ncl").as_deref(), Some(SMALL));
    assert_eq!(place.files(), ["other.ncl", "part.ncl"]);
    for _ in 0..2 {
        let ran = place.run(&["post", "part.ncl", "-o", "part.tap", "--map"]);
        assert_eq!(ran.status, 0, "a map replaces a map: {ran:?}");
    }
}

#[test]
fn a_refused_part_leaves_no_map() {
    let place = Folder::new().with("part.ncl", WRONG);
    assert_eq!(place.run(&["post", "part.ncl", "-o", "part.tap", "--map"]).status, 1);
    let lint = place.run(&["post", "part.ncl", "-o", "part.tap", "--map", "no-folder/x.map"]);
    assert_eq!(lint.status, 1);
    assert_eq!(place.files(), ["part.ncl"]);
}

#[test]
fn files_that_have_changed_are_refused() {
    for (file, text) in [("part.tap", "%\nN10 M30\n%\n"), ("part.ncl", SMALL), ("m.fil", "FINI\n")]
    {
        let place = posted().with(file, text);
        for question in ["part.tap:2", "part.ncl:2", "m.fil:1"] {
            let ran = place.run(&["trace", question]);
            let refused = ran.status == 1 && ran.err.contains("E0708") && ran.out.is_empty();
            assert!(refused && ran.err.contains(file), "{file}, {question}: {ran:?}");
        }
    }
    let stranger = posted().with("other.tap", "%\n");
    let ran = stranger.run(&["trace", "other.tap:1", "--map", "part.tap.map"]);
    assert!(ran.status == 1 && ran.err.contains("E0708"), "{ran:?}");
}

#[test]
fn files_that_are_gone_are_named() {
    let place = posted();
    std::fs::remove_file(place.0.path().join("m.fil")).expect("a file");
    let answer = trace(&place, "part.tap:6").out;
    assert!(answer.contains("m.fil is not there") && answer.contains("m.fil:2\n"), "{answer}");
    std::fs::remove_file(place.0.path().join("part.tap")).expect("a file");
    let answer = trace(&place, "part.ncl:4").out;
    assert!(answer.contains("line 5: (not at hand)"), "{answer}");
}

#[test]
fn files_are_found_where_they_lay_and_where_the_user_says() {
    let place = Folder::new().with("cl/part.ncl", CL).with("fil/m.fil", FIL).with("out/x", "");
    let run = ["post", "cl/part.ncl", "-f", "fil/m.fil", "-o", "out/part.tap", "--map"];
    assert_eq!(place.run(&run).status, 0);
    let answer = trace(&place, "out/part.tap:6").out;
    assert!(answer.contains("cl/part.ncl:4: SPINDL"), "{answer}");
    assert!(answer.contains("fil/m.fil:2: POSTN"), "{answer}");

    for (old, new) in [("cl/part.ncl", "out/other.ncl"), ("fil/m.fil", "out/other.fil")] {
        let at = |name: &str| place.0.path().join(name);
        std::fs::rename(at(old), at(new)).expect("moved");
    }
    let answer = trace(&place, "out/part.tap:6").out;
    assert!(answer.contains("cl/part.ncl is not there"), "{answer}");
    let named = ["trace", "out/part.tap:6", "--cl", "out/other.ncl", "--fil", "out/other.fil"];
    let answer = place.run(&named).out;
    assert!(answer.contains("out/other.ncl:4: SPINDL"), "{answer}");
    assert!(answer.contains("out/other.fil:2: POSTN"), "{answer}");

    let other = ["trace", "out/part.tap:6", "--cl", "out/part.tap"];
    assert!(place.run(&other).err.contains("E0708"), "a CL file of another run");
    let other = ["trace", "out/part.tap:6", "--fil", "out/part.tap"];
    assert!(place.run(&other).err.contains("E0708"), "a FIL file of another run");
}

/// Records far into a file are read from a record shortly before them; the answers
/// are those of reading all that stands before.
#[test]
fn answers_far_into_a_file_are_those_of_the_whole_file() {
    let points: String = (0..3000)
        .map(|at| match at % 700 {
            0 => format!("$$ a comment\nFEDRAT / {}, MMPM\n", 100 + at / 70),
            1 => format!("GOTO / $\n  {at}, 2, 3\n"),
            _ => format!("GOTO / {at}, {}, 3\n", at % 7),
        })
        .collect();
    let head = "$$* Pro/CLfile  Version Wildfire 5.0 - M110\n";
    let cl = format!("{head}UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n{points}FINI\n");
    let place = Folder::new().with("part.ncl", &cl);
    assert_eq!(place.run(&["post", "part.ncl", "-o", "part.tap", "--map"]).status, 0);
    let program = std::fs::read_to_string(place.0.path().join("part.tap")).expect("a program");
    let lines: Vec<&str> = cl.lines().collect();
    let mut compared = 0;
    for (number, block) in (1..).zip(program.lines()).filter(|(number, _)| number % 97 == 0) {
        let answer = trace(&place, &format!("part.tap:{number}")).out;
        let from = answer.split("part.ncl:").nth(1).expect("a record");
        let (line, statement) = from.split_once(": ").expect("a statement");
        let line: usize = line.parse().expect("a number");
        let x = lines[line - 1..].iter().find_map(|text| text.split([',', '/']).nth(1));
        let x: f64 = x.expect("a value").trim().trim_matches('$').parse().unwrap_or(-1.0);
        assert!(x < 0.0 || statement.contains(&format!(" {x:.1},")), "{block}: {answer}");
        compared += 1;
    }
    assert!(compared > 25, "only {compared} blocks were asked for");
}

#[test]
fn maps_that_are_missing_or_broken_are_refused() {
    let place = Folder::new().with("part.ncl", SMALL).with("part.tap", "%\n");
    for question in ["part.tap:1", "part.ncl:1", "nowhere.tap:1"] {
        let ran = place.run(&["trace", question]);
        assert!(ran.status == 1 && ran.err.contains("E0710"), "{question}: {ran:?}");
    }
    let place = posted();
    let map = place.text("part.tap.map").expect("the map");
    let last = map.trim_end().rfind('\n').expect("lines");
    let version = map.replace("\"filpost-map\":3", "\"filpost-map\":9");
    for broken in [&map[..last], &map[..last + 20], "", "{}", "hello\n", &version] {
        let place = posted().with("part.tap.map", broken);
        let ran = place.run(&["trace", "part.tap:6"]);
        assert!(ran.status == 1 && ran.err.contains("E0707"), "{broken}: {ran:?}");
    }
    let place = place.with("second.map", &map);
    let several = place.run(&["trace", "part.ncl:4"]);
    assert!(several.status == 1 && several.err.contains("E0710"), "{several:?}");
    assert!(several.err.contains("second.map") && several.err.contains("part.tap.map"));
}

#[test]
fn places_that_are_not_there_are_refused() {
    let place = posted();
    for question in
        ["part.tap:0", "part.tap:99", "part.tap:3:99", "part.ncl:99", "part.ncl:4:2", "m.fil:99"]
    {
        let ran = place.run(&["trace", question]);
        assert!(ran.status == 1 && ran.err.contains("E0709"), "{question}: {ran:?}");
    }
    for question in ["part.tap", "part.tap:x", ":3"] {
        let ran = place.run(&["trace", question]);
        assert!(ran.status == 2 && ran.err.contains("E0806"), "{question}: {ran:?}");
    }
}
