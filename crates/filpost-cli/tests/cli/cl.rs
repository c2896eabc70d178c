//! `filpost cl`

use crate::support::{Place, SMALL};

#[test]
fn code_pages_are_told_apart_or_named() {
    // ДЕТАЛЬ in windows-1251 and in KOI8-R.
    let cp1251: &[u8] = b"\xC4\xC5\xD2\xC0\xCB\xDC";
    let koi8: &[u8] = b"\xE4\xE5\xF4\xE1\xEC\xF8";
    let cl =
        |name: &[u8]| [b"PARTNO / ".as_slice(), name, b"\nPPRINT / ", name, b"\nFINI\n"].concat();
    for (bytes, label) in
        [(cp1251, None), (koi8, None), (cp1251, Some("cp1251")), (koi8, Some("koi8-r"))]
    {
        let place = Place::new().with("part.ncl", cl(bytes));
        let mut arguments = vec!["cl", "part.ncl"];
        arguments.extend(label.iter().flat_map(|label| ["--encoding", label]));
        let ran = place.run(&arguments);
        assert!(ran.out.contains("PARTNO / ДЕТАЛЬ"), "{label:?} {ran:?}");
    }
    let ran =
        Place::new().with("part.ncl", SMALL).run(&["post", "part.ncl", "--encoding", "klingon"]);
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("E0120"), "{}", ran.err);
}

#[test]
fn records_are_shown_with_numbered_words() {
    let place = Place::new().with("part.ncl", SMALL);
    let text = place.run(&["cl", "part.ncl", "--words"]);
    assert!(text.out.contains("GOTO / 1.0, 2.0, 3.0\n"), "{}", text.out);
    assert!(text.out.contains(&format!("{:>20}  2\n", 7)), "word 7 of the GOTO is y: {}", text.out);
    let json = place.run(&["cl", "part.ncl", "--words", "--json"]);
    let found: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    assert_eq!(found["records"].as_array().map(Vec::len), Some(7));
    assert_eq!(found["records"][5]["words"][5], 1.0);
    assert_eq!(found["extents"]["max"], serde_json::json!([1.0, 2.0, 3.0]));
}
