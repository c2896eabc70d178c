//! `filpost check`

use crate::support::Folder;

#[test]
fn fil_is_checked_without_cl() {
    let place = Folder::new()
        .with("good.fil", "CIMFIL/ON,COOLNT\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n")
        .with("swallow.fil", "CIMFIL/ON,COOLNT\nAA=1\nCIMFIL/OFF\nFINI\n")
        .with("bad.fil", "AA=(1\nJUMPTO/ZZ\nFINI\n");
    assert_eq!(place.run(&["check", "good.fil"]).status, 0);
    let swallow = place.run(&["check", "swallow.fil"]);
    assert!(swallow.status == 0 && swallow.err.contains("W0220"), "{swallow:?}");
    assert_eq!(place.run(&["check", "swallow.fil", "--deny-warnings"]).status, 1);
    assert_eq!(place.run(&["check", "good.fil", "bad.fil"]).status, 1);
    let json = place.run(&["check", "--format", "json", "good.fil", "bad.fil"]);
    assert_eq!(json.status, 1);
    let found: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    let first = &found[0];
    assert_eq!((&first["code"], &first["line"]), (&"E0101".into(), &1.into()), "{first}");
    assert_eq!(first["file"], "bad.fil");
    assert_eq!(first["severity"], "error");
}

/// What a run would say of settings, the machine's own among them.
#[test]
fn settings_are_checked_with_the_machine() {
    let fil = "DMY=POSTF(2,1,1870,9)\nDMY=POSTF(2,1,1868,1)\nDMY=POSTF(2,1,1868,71)\nFINI\n";
    let place =
        Folder::new().with("post.fil", fil).with("machine.toml", "tape.partno_punched = true\n");
    let alone = place.run(&["check", "post.fil"]);
    assert!(alone.status == 0 && !alone.err.contains("W0651"), "{}", alone.err);
    let with = place.run(&["check", "post.fil", "-m", "machine.toml"]);
    assert_eq!(with.status, 1, "{}", with.err);
    for said in ["E0605", "post.fil:1:5", "post.fil:2:5", "tape.partno_punched", "machine.toml:1"] {
        assert!(with.err.contains(said), "{said}: {}", with.err);
    }
    assert_eq!(with.err.matches("program.merging").count(), 1, "{}", with.err);
}
