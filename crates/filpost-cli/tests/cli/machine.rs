//! `filpost machine`, and the manual page

use crate::support::{Place, SMALL};

#[test]
fn an_option_file_becomes_a_machine() {
    let option_file =
        "OPTION FILE\nMY \"MILL\"\n INTCOM:(LOCATION,VALUE)\n 1870      0\n   0      0\n";
    let place = Place::new().with("uncx01.p07", option_file).with("part.ncl", SMALL);
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
fn the_schema_knows_every_setting() {
    let ran = Place::new().run(&["machine", "schema"]);
    let schema: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    for row in filpost::locations::TABLE {
        let path: String = row.name.split('.').map(|part| format!("/properties/{part}")).collect();
        assert!(schema.pointer(&path).is_some(), "{}", row.name);
    }
}

#[test]
fn two_machines_differ_by_name_letter_and_number() {
    let toml = "linear.code = 11\n[address]\nQ = { slot = 53 }\n[int]\n2999 = 7\n";
    let place = Place::new().with("machine.toml", toml);
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
    let ran = Place::new().run(&["machine", "diff", "grbl", "grbl"]);
    assert_eq!(ran.out, "the machines have the same settings\n");
    assert_eq!(ran.status, 0);
    let absent = Place::new().run(&["machine", "diff", "grbl", "nowhere.toml"]);
    assert_eq!(absent.status, 1);
    assert!(absent.err.contains("E0703"));
}

#[test]
fn the_manual_page_names_the_commands() {
    let page = Place::new().run(&["man"]).out;
    assert!(page.contains(".TH filpost 1"), "{page}");
    assert!(page.contains("filpost\\-post"), "{page}");
}
