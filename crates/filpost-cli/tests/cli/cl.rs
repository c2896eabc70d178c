//! `filpost cl`

use crate::support::{Folder, SMALL};

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
        let place = Folder::new().with("part.ncl", cl(bytes));
        let mut arguments = vec!["cl", "part.ncl"];
        arguments.extend(label.iter().flat_map(|label| ["--encoding", label]));
        let ran = place.run(&arguments);
        assert!(ran.out.contains("PARTNO / ДЕТАЛЬ"), "{label:?} {ran:?}");
    }
    let ran =
        Folder::new().with("part.ncl", SMALL).run(&["post", "part.ncl", "--encoding", "klingon"]);
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("E0120"), "{}", ran.err);
}

#[test]
fn records_are_shown_with_numbered_words() {
    let place = Folder::new().with("part.ncl", SMALL);
    let text = place.run(&["cl", "part.ncl", "--words"]);
    assert!(text.out.contains("GOTO / 1.0, 2.0, 3.0\n"), "{}", text.out);
    assert!(text.out.contains(&format!("{:>20}  2\n", 7)), "word 7 of the GOTO is y: {}", text.out);
    let json = place.run(&["cl", "part.ncl", "--words", "--json"]);
    let found: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    assert_eq!(found["records"].as_array().map(Vec::len), Some(7));
    assert_eq!(found["records"][5]["words"][5], 1.0);
    assert_eq!(found["extents"]["max"], serde_json::json!([1.0, 2.0, 3.0]));
    assert_eq!(found["splines"], serde_json::Value::Null);
}

#[test]
fn splines_are_counted() {
    let spline = "TOOL PATH/A,TOOL,B\nUNITS/MM\nGOTO/0.,0.,0.\nNURBS/\nKNOT/0.,0.,1.,2.,2.\n\
        CNTRL/0.,0.,0.\nCNTRL/1.,0.,0.\nCNTRL/1.,1.,0.\nEND-OF-PATH\n";
    let place = Folder::new().with("part.cls", spline);
    let json = place.run(&["cl", "part.cls", "--json"]);
    let found: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    assert_eq!(
        found["splines"],
        serde_json::json!({"splines": 1, "lines": 2, "tolerance": 0.001}),
        "{}",
        json.out
    );
}

const ARC: &str = "UNITS/MM\nLOADTL/1\nSPINDL/RPM,900,CLW\nFEDRAT/200,MMPM\nGOTO/5,0,0\n\
    CIRCLE/0,0,0,0,0,1,5,.06,.5,10,1\nGOTO/0,-5,0\nFINI\n";

#[test]
fn the_dialect_is_said_and_chosen() {
    let place = Folder::new().with("part.cls", ARC).with("part.ncl", SMALL);
    let generic = place.run(&["cl", "part.ncl"]);
    assert!(generic.out.contains("7 records, dialect generic (no CAM system"), "{}", generic.out);
    let chosen = place.run(&["cl", "part.cls", "--dialect", "NX", "--json"]);
    let found: serde_json::Value = serde_json::from_str(&chosen.out).expect("JSON");
    assert_eq!(found["dialect"], serde_json::json!({"name": "nx", "chosen": true}));
    for command in [&["cl", "part.cls"][..], &["post", "part.cls"], &["plot", "part.cls"]] {
        let refused = place.run(command);
        assert_eq!(refused.status, 1, "{refused:?}");
        assert!(refused.err.contains("E0417"), "{refused:?}");
        assert!(refused.err.contains("--dialect nx"), "{refused:?}");
        let ran = place.run(&[command, &["--dialect", "nx"]].concat());
        assert_eq!(ran.status, 0, "{ran:?}");
    }
    let wrong = place.run(&["post", "part.ncl", "--dialect", "klingon"]);
    assert_eq!(wrong.status, 2);
    assert!(wrong.err.contains("solidworks-cam"), "{}", wrong.err);
}

#[test]
fn a_program_is_verified_by_the_dialect_that_made_it() {
    let place = Folder::new().with("part.cls", ARC);
    let posted = place.run(&["post", "part.cls", "--dialect", "nx", "-o", "part.nc"]);
    assert_eq!(posted.status, 0, "{posted:?}");
    assert!(posted.err.contains("dialect nx (chosen)"), "{}", posted.err);
    assert!(place.text("part.nc").expect("a program").contains("G2 X0. Y-5."));
    let verify =
        |dialect: &str| place.run(&["verify", "part.cls", "part.nc", "--dialect", dialect]);
    assert_eq!(verify("nx").status, 0, "{:?}", verify("nx"));
    assert_eq!(verify("generic").status, 1);
}

#[test]
fn the_dialects_are_listed() {
    let place = Folder::new();
    let text = place.run(&["cl", "--dialects"]);
    assert_eq!(text.status, 0);
    assert!(text.out.contains("nx: Siemens NX CLSF"), "{}", text.out);
    assert!(text.out.contains("recognized  by TOOL PATH, TLDATA"), "{}", text.out);
    let json = place.run(&["cl", "--dialects", "--json"]);
    let rows: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    let names: Vec<_> = rows.as_array().expect("rows").iter().map(|row| &row["name"]).collect();
    assert_eq!(names.len(), filpost::cl::ClDialect::ALL.len());
    assert_eq!(place.run(&["cl"]).status, 2);
}

#[test]
fn a_file_of_another_system_becomes_one_of_creo() {
    let nx = "TOOL PATH/A,TOOL,B\nLOAD/TOOL,2\nSPINDL/RPM,900,CLW\nFEDRAT/MMPM,250.\nGOTO/1.,2.,3.\n\
        END-OF-PATH\n";
    let place = Folder::new().with("part.cls", nx);
    let ran = place.run(&["cl", "part.cls", "--to", "ncl", "-o", "part.ncl", "--units", "mm"]);
    assert_eq!(
        ran.seen(),
        (0, "", "part.cls: 9 statements written for Creo, dialect nx (told by line 1)\n")
    );
    let ncl = place.text("part.ncl").expect("a CL file");
    let head = "$$*          Pro/CLfile\nTPRINT / B\n$$ TOOL PATH / A,TOOL,B\n";
    assert!(ncl.starts_with(head), "{ncl}");
    let printed = place.run(&["cl", "part.cls", "--to", "ncl", "--units", "mm"]);
    assert_eq!(printed.out, ncl);
    let post = |file: &str| place.run(&["post", file, "-p", "fanuc-mill", "--units", "mm"]);
    assert_eq!((post("part.ncl").status, post("part.ncl").out), (0, post("part.cls").out));
}

#[test]
fn what_creo_can_not_say_leaves_no_file() {
    let open = "CSI_SET_A/1\nGODLTA/1,0,0\nCIRCLE/0,0,0,0,0,1\nGOTO/1,0,0\nFINI\n";
    let place = Folder::new().with("part.apt", open);
    let ran = place.run(&["cl", "part.apt", "--to", "ncl", "-o", "part.ncl"]);
    assert!(
        ran.status == 1 && ran.err.contains("E0412") && ran.err.contains("part.apt:3"),
        "{ran:?}"
    );
    assert_eq!(place.files(), ["part.apt"]);
    let over = place.run(&["cl", "part.apt", "--to", "ncl", "-o", "part.apt"]);
    assert!(over.status == 1 && over.err.contains("E0802"), "{over:?}");
    assert_eq!(place.text("part.apt").as_deref(), Some(open));
    assert_eq!(place.run(&["cl", "part.apt", "-o", "part.ncl"]).status, 2);
}

#[test]
fn records_are_shown_as_they_are_written() {
    let place = Folder::new().with("part.cls", "PAINT/A\nLOAD/TOOL,2\nFEDRAT/MMPM,250.\n");
    let formed = place.run(&["cl", "part.cls"]).out;
    assert!(formed.contains("LOADTL / 2") && formed.contains("FEDRAT / 250.0, MMPM"), "{formed}");
    let written = place.run(&["cl", "part.cls", "--raw-records"]).out;
    assert!(
        written.contains("LOAD / TOOL, 2") && written.contains("FEDRAT / MMPM, 250"),
        "{written}"
    );
}
