//! `filpost machine`, and the manual page

use crate::support::{Folder, SMALL};

#[test]
fn an_option_file_becomes_a_machine() {
    let option_file = "OPTION FILE\nMY \"MILL\"\n INTCOM:(LOCATION,VALUE)\n 1870      0\n   0      0\n \
         RELCOM:\n 0 0\n DBLCOM:\n 0 0\n";
    let place = Folder::new().with("uncx01.p07", option_file).with("part.ncl", SMALL);
    let ran = place.run(&["machine", "import", "uncx01.p07", "-o", "machine.toml"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let text = place.text("machine.toml").expect("the machine");
    assert!(text.starts_with("name = \"MY \\\"MILL\\\"\"\n"), "{text}");
    assert!(text.contains("rapid.split = 0"), "{text}");
    let direct = place.run(&["post", "part.ncl", "-m", "uncx01.p07"]);
    let imported = place.run(&["post", "part.ncl", "-m", "machine.toml"]);
    assert_eq!((direct.status, &direct.out), (0, &imported.out), "{direct:?}");
    let show = place.run(&["machine", "show", "-m", "machine.toml", "rapid."]);
    assert!(show.out.contains("rapid.split                  0 (one block)"), "{}", show.out);
    assert!(!show.out.contains("cycle."), "{}", show.out);
}

#[test]
fn a_machine_is_shown_by_its_name_alone() {
    let option_file = "OPTION FILE\nMILL\n INTCOM:(LOCATION,VALUE)\n 1870      0\n   0      0\n \
         RELCOM:\n 0 0\n DBLCOM:\n 0 0\n";
    let place = Folder::new().with("uncx01.p07", option_file);
    for (name, said) in [
        ("uncx01.p07", "rapid.split                  0 (one block) (default "),
        ("okuma-mill", "56 (default 43)"),
    ] {
        let shown = place.run(&["machine", "show", name]);
        assert!(shown.status == 0 && shown.out.contains(said), "{shown:?}");
    }
    let wrong = place.run(&["machine", "show", "rapids."]);
    assert!(wrong.status == 1 && wrong.err.contains("E0811"), "{wrong:?}");
}

#[test]
fn settings_are_shown_as_json() {
    let place = Folder::new();
    let shown = place.run(&["machine", "show", "--json", "-p", "okuma-mill"]);
    let settings: serde_json::Value = serde_json::from_str(&shown.out).expect("JSON");
    let code = &settings["tool.length_code"];
    assert_eq!(
        (&code["value"], &code["default"], &code["unit"]),
        (&56.into(), &43.into(), &"code".into())
    );
    let seen = code["in_ready_posts"].as_array().expect("a list");
    assert!([43, 56].iter().all(|code| seen.contains(&(*code).into())), "{seen:?}");
    let all = place.run(&["machine", "show", "--json", "-p", "okuma-mill", "tape."]);
    let settings: serde_json::Value = serde_json::from_str(&all.out).expect("JSON");
    let cases = &settings["tape.letter_case"]["choices"];
    assert!(cases[0]["meaning"].is_string(), "{cases}");
    assert!(settings.get("tool.length_code").is_none());
}

#[test]
fn the_option_file_of_a_lathe_is_laid_over_a_lathe_that_is_named() {
    let option_file = "OPTION FILE: UNCL01.P01\nOLD LATHE\n INTCOM:(LOCATION,VALUE)\n 1982     13\n   0      \
         0\n RELCOM:\n 0 0\n DBLCOM:\n 0 0\n";
    let place = Folder::new().with("uncl01.p01", option_file).with("part.ncl", SMALL);
    let alone = place.run(&["post", "part.ncl", "-m", "uncl01.p01"]);
    assert!(alone.status == 1 && alone.err.contains("E0608"), "{alone:?}");
    let layers = ["-p", "fanuc-lathe", "-m", "uncl01.p01", "machine.toml"];
    let direct = place.run(&["machine", "show", layers[0], layers[1], layers[2], layers[3]]);
    let import =
        place.run(&["machine", "import", "uncl01.p01", "-p", "fanuc-lathe", "-o", layers[4]]);
    assert_eq!((direct.status, import.status), (0, 0), "{direct:?} {import:?}");
    let imported = place.run(&["machine", "show", "-m", layers[4]]);
    for said in ["spindle.cw_code", "lathe.diameter"] {
        assert!(direct.out.contains(said) && imported.out.contains(said), "{said}: {direct:?}");
    }
    assert!(place.text(layers[4]).is_some_and(|text| text.starts_with("name = \"OLD LATHE\"")));
}

#[test]
fn all_that_is_wrong_with_a_machine_is_said_at_once() {
    let toml = "rapid.spilt = 1\nint.1870 = 9\n[address]\nX = { slot = 0 }\n";
    let option_file = "UNCX01.P07\nMILL\nINTCOM:\n470\n20000 1\n0 0\nRELCOM:\n0 0\n";
    let place = Folder::new()
        .with("machine.toml", toml)
        .with("uncx01.p07", option_file)
        .with("bad.fil", "AA=(1\nFINI\n")
        .with("part.ncl", SMALL);
    let set = ["--set", "linear.code=Q"];
    for command in [&["post", "part.ncl"][..], &["machine", "show"], &["check", "bad.fil"]] {
        let ran = place.run(&[command, &["-m", "machine.toml"]].concat());
        for said in ["machine.toml:1:7", "machine.toml:2:12", "machine.toml:4:14", "rapid.split"] {
            assert!(ran.status == 1 && ran.err.contains(said), "{said}: {}", ran.err);
        }
    }
    let ran = place.run(&[&["post", "part.ncl", "-f", "bad.fil"][..], &set].concat());
    assert!(ran.err.contains("--set:1:") && ran.err.contains("bad.fil:1"), "{}", ran.err);
    let ran = place.run(&["machine", "import", "uncx01.p07"]);
    for said in ["uncx01.p07:4", "uncx01.p07:5", "the file has no list DBLCOM"] {
        assert!(ran.status == 1 && ran.err.contains(said), "{said}: {}", ran.err);
    }
    let two = ["--set", "circle.cw_code=3", "--set", "feed.upm_factor=-1"];
    let ran = place.run(&[&["post", "part.ncl", "-p", "fanuc-mill"][..], &two].concat());
    assert_eq!(ran.err.matches("E0607").count(), 2, "{}", ran.err);
    assert!(ran.err.contains("in the settings of fanuc-mill"), "{}", ran.err);
}

#[test]
fn the_schema_knows_every_setting() {
    let ran = Folder::new().run(&["machine", "schema"]);
    let schema: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    for row in filpost::locations::TABLE {
        let path: String = row.name.split('.').map(|part| format!("/properties/{part}")).collect();
        assert!(schema.pointer(&path).is_some(), "{}", row.name);
    }
}

#[test]
fn two_machines_differ_by_name_letter_and_number() {
    let toml = "linear.code = 11\n[address]\nQ = { slot = 53 }\n[int]\n2999 = 7\n";
    let place = Folder::new().with("machine.toml", toml);
    let ran = place.run(&["machine", "diff", "fanuc-mill", "machine.toml"]);
    let out = &ran.out;
    assert_eq!(ran.status, 1, "{out}{}", ran.err);
    for line in [
        "linear.code                  1 | 11\n",
        "address.Q                    slot 20, format 4443, spec 101 | none\n",
        "INTCOM 2999                  none | 7\n",
    ] {
        assert!(out.contains(line), "{line}{out}");
    }
}

#[test]
fn a_machine_is_like_itself() {
    let ran = Folder::new().run(&["machine", "diff", "grbl", "grbl"]);
    assert_eq!(ran.out, "the machines have the same settings\n");
    assert_eq!(ran.status, 0);
    let absent = Folder::new().run(&["machine", "diff", "grbl", "nowhere.toml"]);
    assert_eq!(absent.status, 1);
    assert!(absent.err.contains("E0703"));
}

#[test]
fn the_manual_page_names_the_commands() {
    let page = Folder::new().run(&["man"]).out;
    assert!(page.contains(".TH filpost 1"), "{page}");
    assert!(page.contains("filpost\\-post"), "{page}");
}

#[test]
fn texts_of_two_machines_are_compared_as_texts() {
    let one = "[blocks]\nstart = ['G21', 'G90']\n[int]\n2100 = 16705\n2101 = 16961\n2200 = 8224\n";
    let two = "[blocks]\nstart = ['G21', 'G17 G90']\n";
    let place = Folder::new().with("one.toml", one).with("two.toml", two);
    let ran = place.run(&["machine", "diff", "one.toml", "two.toml"]);
    let expected = "blocks.start                 [\"G21\", \"G90\"] | [\"G21\", \"G17 G90\"]\n\
                    INTCOM 2100 to 2101          \"AAAB\" | \"\"\n";
    assert_eq!((ran.status, ran.out.as_str()), (1, expected), "{}", ran.err);
}

#[test]
fn a_machine_says_what_it_sets() {
    let toml =
        "base = 'grbl'\nseqno.increment = 5\ntape.partno_punched = true\nblocks.end = ['M5']\n";
    let place = Folder::new().with("machine.toml", toml);
    let ran = place.run(&["machine", "show", "-m", "machine.toml"]);
    for line in [
        "seqno.increment              5 (default 1)\n",
        "blocks.end                   [\"M5\"]\n",
        "tape.start_char ",
        "set, and without effect: ",
        "tape.partno_punched",
    ] {
        assert!(ran.out.contains(line), "{line}: {}", ran.out);
    }
    assert!(!ran.out.contains("linear.code"), "{}", ran.out);
    let all = place.run(&["machine", "show", "--all", "-m", "machine.toml"]).out;
    assert!(all.contains("linear.code ") && all.contains("seqno.increment              5\n"));
    assert_eq!(place.run(&["machine", "show", "-m", "nothing.toml"]).status, 1);
}

#[test]
fn a_machine_lies_over_a_post() {
    let place = Folder::new()
        .with("base.toml", "base = 'fanuc-mill'\nlinear.code = 11\n")
        .with("over.toml", "linear.code = 11\n")
        .with("again.toml", "base = 'grbl'\nlinear.code = 11\n")
        .with("uncx01.p07", "UNCX01.P07\nMILL\nINTCOM:\n0 0\nRELCOM:\n0 0\nDBLCOM:\n0 0\n")
        .with("part.ncl", SMALL);
    let base = place.run(&["post", "part.ncl", "-m", "base.toml"]);
    let over = place.run(&[
        "post",
        "part.ncl",
        "-p",
        "fanuc-mill",
        "-m",
        "over.toml",
        "--option=style=plain",
    ]);
    assert_eq!((base.status, &base.out), (0, &over.out), "{}", base.err);
    assert!(base.out.contains("G11"), "{}", base.out);
    assert!(over.err.contains("fanuc-mill with over.toml"), "{}", over.err);
    let set = ["post", "part.ncl", "-p", "fanuc-mill", "-m", "over.toml", "--set", "linear.code=1"];
    assert!(!place.run(&set).out.contains("G11"));
    let again = place.run(&["post", "part.ncl", "-p", "fanuc-mill", "-m", "again.toml"]);
    assert!(again.status == 1 && again.err.contains("E0604"), "{}", again.err);
    let option_file = place.run(&["post", "part.ncl", "-p", "fanuc-mill", "-m", "uncx01.p07"]);
    assert_eq!(option_file.status, 0, "{}", option_file.err);
    assert!(option_file.err.contains("fanuc-mill with uncx01.p07"), "{}", option_file.err);
}
