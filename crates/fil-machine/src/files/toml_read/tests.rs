use super::*;
use crate::commons::Int;
use crate::effects::Effect;
use crate::letter::Letter;

fn error(text: &str) -> (String, String) {
    let diags = read_toml("machine.toml", text).unwrap_err();
    (diags[0].code.name(), diags[0].spans[0].to_string())
}

#[test]
fn names_numbers_letters_and_texts_reach_the_commons() {
    let text = "name = 'mill'\n[rapid]\nsplit = 0\n[cycle]\nstep_address = 'Q'\n\
                [tape]\nstart_char = 'none'\n[int]\n1924 = 3\n[dbl]\n486 = 2.0\n\
                [blocks]\nstart = ['G90G80', 'G40']\n[address.Y]\nslot = 53\n";
    let (commons, warnings) = read_toml("machine.toml", text).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(commons.read(loc::RAPID_SPLIT), loc::RapidSplit::OneBlock);
    assert_eq!(commons.read(loc::CYCLE_STEP_ADDRESS), Some(Letter::of(b'Q')));
    assert_eq!(commons.read(loc::TAPE_START_CHAR), None);
    assert_eq!(commons.int(Int(1924)), 3);
    assert_eq!(commons.dbl(loc::SCALE_X), 2.0);
    assert_eq!(commons.int(Int(25)), 53);
    assert_eq!(user_blocks::START.read(&commons), ["G90G80", "G40"]);
}

#[test]
fn what_is_not_understood_is_refused_with_its_place() {
    assert_eq!(error("rapid = {\n"), ("E0603".into(), "machine.toml:1:10".into()));
    assert_eq!(error("[rapid]\nspilt = 1"), ("E0604".into(), "machine.toml:2:1".into()));
    assert_eq!(error("[rapid]\nsplit = 9"), ("E0605".into(), "machine.toml:2:9".into()));
    assert_eq!(error("[scale]\nx = 'a'"), ("E0605".into(), "machine.toml:2:5".into()));
    assert_eq!(error("int.20000 = 1"), ("E0601".into(), "machine.toml:1:13".into()));
    assert_eq!(error("[address.x]\nslot = 1"), ("E0604".into(), "machine.toml:1:10".into()));
}

#[test]
fn a_machine_begins_from_another_one() {
    let bases = |name: &str| match name {
        "old" => Some("rapid.split = 0\nseqno.increment = 5"),
        "nested" => Some("base = 'old'"),
        _ => None,
    };
    let read = |text: &str| read_toml_with("machine.toml", text, &bases);
    let (mut commons, _) = read("base = 'old'\nseqno.increment = 7").unwrap();
    assert_eq!(commons.read(loc::RAPID_SPLIT), loc::RapidSplit::OneBlock);
    assert_eq!(commons.dbl(loc::SEQNO_INCREMENT), 7.0);
    for text in ["base = 'new'", "base = 3", "base = 'nested'"] {
        assert_eq!(read(text).unwrap_err()[0].code.name(), "E0605", "{text}");
    }
    assert_eq!(error("base = 'old'"), ("E0605".into(), "machine.toml:1:8".into()));
    lay_over(&mut commons, "m", "seqno.increment = 9").unwrap();
    assert_eq!(commons.dbl(loc::SEQNO_INCREMENT), 9.0);
    assert_eq!(lay_over(&mut commons, "m", "base = 'old'").unwrap_err()[0].code.name(), "E0604");
}

#[test]
fn all_that_is_wrong_is_said_at_once() {
    let text = "rapid.spilt = 1\nrapid.split = 9\nint.1870 = 8\nint.1861 = 0.5\n\
                [address]\nX = { slot = 0, format = 99999, colour = 1 }\n\
                K = { slot = 8 }\nM = { slot = 8 }\n";
    let diags = read_toml("machine.toml", text).unwrap_err();
    let found: Vec<(String, u32)> =
        diags.iter().map(|diag| (diag.code.name(), diag.spans[0].line)).collect();
    let code = |code: &str| code.to_string();
    assert_eq!(
        found,
        [
            (code("E0604"), 1),
            (code("E0605"), 2),
            (code("E0605"), 3),
            (code("E0602"), 4),
            (code("E0605"), 6),
            (code("E0605"), 8),
        ],
        "{diags:?}"
    );
    let broken = read_toml("machine.toml", "a = \nb = 1\nc = ]\n").unwrap_err();
    assert_eq!(broken.len(), 2, "{broken:?}");
}

#[test]
fn a_location_is_not_set_twice() {
    for (twice, place) in [
        ("int.1870 = 0\nrapid.split = 1\n", "machine.toml:2:7"),
        ("int.24 = 7\n[address.X]\nslot = 9\n", "machine.toml:3:8"),
        ("int.5001 = 1\nint.05001 = 2\n", "machine.toml:1:5"),
    ] {
        let (code, at) = error(twice);
        assert_eq!((&code[..], &at[..]), ("E0607", place), "{twice}");
    }
    assert!(read_toml("m", "int.1870 = 0\nrapid.split = 0\n").is_ok());
    let (commons, _) = read_toml("m", "int.24 = 30\n[address.X]\nformat = 2222\n").unwrap();
    assert_eq!(commons.int(Int(135)), 2222);
}

#[test]
fn a_number_is_checked_as_its_name_is() {
    for wrong in ["int.1870 = 9", "int.24 = 0", "int.9003 = 40", "address.X.spec = 7"] {
        assert_eq!(error(wrong).0, "E0605", "{wrong}");
    }
    let mut commons = default_commons();
    for wrong in ["int.1870=9", "rapid.split=9", "int.1870=Q", "rapid.split=none of it"] {
        let diags = apply_setting(&mut commons, wrong).unwrap_err();
        assert_eq!(diags[0].code.name(), "E0605", "{wrong}");
    }
    let warnings = apply_setting(&mut commons, "int.5001=1").unwrap();
    assert_eq!(warnings[0].to_string(), "W0651 --set:1:5: the post does not act on INTCOM 5001");
}

#[test]
fn two_letters_never_stand_at_one_tape_position() {
    let twice = "[address]\nK = { slot = 8 }\nM = { slot = 8 }\n";
    assert_eq!(error(twice), ("E0605".into(), "machine.toml:3:14".into()));
    // K stands at 8 when nothing else is said.
    let (mut commons, _) = read_toml("m", "[address]\nM = { slot = 8 }\n").unwrap();
    assert_eq!((commons.int(Int(13)), commons.int_opt(Int(11))), (8, None));
    apply_setting(&mut commons, "address.Q.slot=8").unwrap();
    assert_eq!((commons.int(Int(17)), commons.int_opt(Int(13))), (8, None));
}

#[test]
fn a_letter_takes_its_digits_along() {
    // X and Y change places.
    let base = "[address]\nX = { slot = 30, format = 4443, spec = 101, char = 'U' }\n\
                Y = { slot = 31, format = 3030, spec = 0 }\nQ = { slot = 53 }\n";
    let with = |text: &str| {
        let (mut commons, _) = read_toml("m", base).unwrap();
        lay_over(&mut commons, "m", text).map(|_| commons)
    };
    let cells = |commons: &Commons, at: u16| [52, 105, 158].map(|base| commons.int(Int(base + at)));
    let u = i32::from(b'U');
    let moved = with("[address]\nX = { slot = 31 }\nY = { slot = 30 }\n").unwrap();
    assert_eq!(cells(&moved, 31), [u, 4443, 101]);
    assert_eq!(cells(&moved, 30), [i32::from(b'Y'), 3030, 0]);
    let moved = with("address.X = { slot = 31, format = 4444 }").unwrap();
    assert_eq!(cells(&moved, 31), [u, 4444, 101]);
    let stays = with("address.X.format = 4444").unwrap();
    assert_eq!(cells(&stays, 30), [u, 4444, 101]);
    for text in ["address.Q.slot = 40", "address.Q = { slot = 40, format = 4443 }"] {
        let diags = with(text).unwrap_err();
        assert_eq!(diags[0].code.name(), "E0607", "{text}");
        assert!(diags[0].hint.as_ref().is_some_and(|hint| hint.contains("address.Q.format")));
    }
    assert!(with("address.Q = { slot = 40, format = 4443, spec = 101 }").is_ok());
    // Single settings say one after the other.
    let (mut commons, _) = read_toml("m", base).unwrap();
    for (setting, complete) in [
        ("address.Q.slot=40", false),
        ("address.Q.format=4443", false),
        ("address.Q.spec=101", true),
    ] {
        apply_setting(&mut commons, setting).unwrap();
        assert_eq!(crate::contradictions::check(&commons).is_ok(), complete, "{setting}");
    }
}

/// The machine of a file with one key.
fn read_key(key: &str, value: &str) -> std::result::Result<Commons, Vec<Diag>> {
    read_toml("machine.toml", &format!("{key} = {value}")).map(|(commons, _)| commons)
}

#[test]
fn allowed_offsets_are_names_of_offsets() {
    let read = |list: &str| read_key("verify.allowed_offsets", list);
    let commons = read("['G54', 'g54.1p3', 'E2', 'G59.1']").unwrap();
    assert_eq!(commons.allowed_offsets(), ["G54", "G54.1P3", "E2", "G59.1"]);
    let text = crate::files::write_toml(&commons);
    assert!(
        text.contains("verify.allowed_offsets = [\"G54\", \"G54.1P3\", \"E2\", \"G59.1\"]"),
        "{text}"
    );
    for wrong in ["G", "G54.", "G54P", "54", "E2P1", "G54 P1 X", "G5.10P1", "É1", "G1234"] {
        assert!(read(&format!("['{wrong}']")).is_err(), "{wrong}");
    }
}

#[test]
fn allowed_functions_are_effects() {
    let read = |list: &str| read_key("verify.allowed_functions", list);
    let commons = read("['M88', 'G187 P*']").unwrap();
    let does = |block: &str| commons.effects().of(block).map(|found| found.rule.effect);
    assert_eq!(does("G187 P2"), Some(Effect::Nothing));
    assert_eq!(does("N10 M88"), Some(Effect::Nothing));
    assert_eq!(does("M89"), None);
    for wrong in ["['*']", "['']", "'M88'", "[88]"] {
        assert!(read(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn a_setting_without_effect_warns() {
    let (_, warnings) = read_toml("m", "[tape]\npartno_punched = true").unwrap();
    assert_eq!(warnings[0].code.name(), "W0651");
}

#[test]
fn what_is_wrong_with_a_single_setting_is_said_in_its_words() {
    let refused = |setting| apply_setting(&mut default_commons(), setting).unwrap_err();
    let cut_off = &refused("rapid.split")[0];
    assert_eq!(cut_off.code.name(), "E0603");
    assert!(cut_off.hint.as_ref().is_some_and(|hint| hint.contains("--set key=value")));
    for (setting, key) in
        [("address.X.slot=0", "`address.X.slot`"), ("address.X.char=7", "`address.X.char`")]
    {
        let wrong = &refused(setting)[0];
        assert_eq!(wrong.code.name(), "E0605");
        assert!(wrong.message.contains(key), "{wrong}");
    }
}

#[test]
fn a_single_setting_takes_numbers_and_letters() {
    let mut commons = default_commons();
    apply_setting(&mut commons, "rapid.split=0").unwrap();
    apply_setting(&mut commons, "cycle.step_address=Q").unwrap();
    assert_eq!(commons.read(loc::CYCLE_STEP_ADDRESS), Some(Letter::of(b'Q')));
    assert!(apply_setting(&mut commons, "rapid.split=Q").is_err());
}

#[test]
fn an_old_key_goes_on_to_work_and_warns() {
    for (old, new) in crate::renamed::KEYS {
        let row = loc::Location::named(new).expect("the new key is one");
        assert_eq!(loc::Location::named(old), Some(row));
        assert!(loc::TABLE.iter().all(|row| row.name != *old), "{old} is another setting");
        assert_eq!(crate::renamed::key(new), None, "{old} must name the last key");
    }
    let (commons, warnings) = read_toml("m.toml", "[dwell]\nupm_min = 0.5").unwrap();
    assert_eq!(commons.dbl_opt(loc::DWELL_SECONDS_MIN), Some(0.5));
    let said: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    assert_eq!(said, ["W0653 m.toml:2:1: `dwell.upm_min` is now `dwell.seconds_min`"]);
    assert!(crate::files::write_toml(&commons).contains("seconds_min"));
    let (_, warnings) = read_toml("m.toml", "[dwell]\nseconds_min = 0.5").unwrap();
    assert!(warnings.is_empty());
    let both = "[dwell]\nupm_min = 0.5\nseconds_min = 0.6";
    assert_eq!(read_toml("m.toml", both).unwrap_err()[0].code.name(), "E0607");
}
