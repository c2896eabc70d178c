//! `filpost check`

use crate::support::Place;

#[test]
fn fil_is_checked_without_cl() {
    let place = Place::new()
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
