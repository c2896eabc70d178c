//! `filpost simulate`, and `filpost verify --stock`.

use serde_json::Value;

use crate::support::{Folder, Ran};

/// A slot; the way back goes at rapid through what is left beside it.
const PART: &str = "UNITS / MM\nLOADTL / 1\nCUTTER / 10\nSPINDL / RPM, 900, CLW\nRAPID\n\
                    GOTO / -10, 10, 20\nRAPID\nGOTO / -10, 10, -2\nFEDRAT / 200, MMPM\n\
                    GOTO / 70, 10, -2\nRAPID\nGOTO / 70, 20, -2\nRAPID\nGOTO / -10, 20, -2\nFINI\n";

const STOCK: [&str; 3] = ["--stock", "box:60x40x20", "--grid=0.5mm"];

fn posted() -> Folder {
    let place = Folder::new().with("part.ncl", PART);
    let ran = place.run(&["post", "part.ncl", "-p", "fanuc-mill", "-o", "part.nc", "--map"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    place
}

fn simulate(place: &Folder, more: &[&str]) -> Ran {
    place.run(&[&["simulate", "part.nc", "-p", "fanuc-mill"], &STOCK[..], more].concat())
}

#[test]
fn a_finding_names_its_nc_and_cl_lines() {
    let place = posted();
    let ran = simulate(&place, &["--cl", "part.ncl"]);
    assert_eq!(ran.status, 1, "{ran:?}");
    for part in [
        "error E0971: NC line",
        "(CL line 14): rapid through stock: tool 1, 2 mm deep",
        "59.5 mm long",
        "made by part.ncl:14  GOTO / -10, 20, -2",
        "holder not checked: that of tool 1 is not known",
        "; 1 finding\n",
    ] {
        assert!(ran.out.contains(part), "{part}: {ran:?}");
    }
    let found: Value =
        serde_json::from_str(&simulate(&place, &["--tool", "1=D10", "--format", "json"]).out)
            .expect("JSON");
    let first = &found["findings"][0];
    assert_eq!(
        (&first["code"], &first["cl_line"], &first["tool"]),
        (&"E0971".into(), &14.into(), &1.into())
    );
    let removed = found["removed"].as_f64().expect("a number");
    assert!((removed - 60.0 * 20.0 * 2.0).abs() < 61.0, "{removed}");
}

#[test]
fn levels_decide_of_the_status() {
    let place = posted();
    let ran = simulate(&place, &["--tool", "1=D10", "--warn", "E0971"]);
    assert!(ran.status == 0 && ran.out.contains("warning E0971"), "{ran:?}");
    let ran = simulate(&place, &["--tool", "1=D10", "--allow", "E0971"]);
    assert!(ran.status == 0 && ran.out.contains("; 0 findings"), "{ran:?}");
}

#[test]
fn a_tool_without_a_size_is_asked_for() {
    let ran = simulate(&posted(), &[]);
    assert!(
        ran.status == 1 && ran.err.contains("E0961") && ran.err.contains("--tool 1="),
        "{ran:?}"
    );
    let without_stock = posted().run(&["simulate", "part.nc", "-p", "fanuc-mill"]);
    assert!(
        without_stock.status == 2 && without_stock.err.contains("--stock"),
        "{without_stock:?}"
    );
}

#[test]
fn a_setup_file_holds_stock_and_tools() {
    let place =
        posted().with("job/setup.toml", "stock = \"left.stl\"\ngrid = 0.5\n[tools]\n1 = \"D10\"\n");
    let ran = simulate(&place, &["--tool", "1=D10", "--write-stock", "job/left.stl"]);
    assert_eq!(ran.status, 1, "{ran:?}");
    // What is left is cut once more: nothing is in the way any more.
    let ran = place.run(&["simulate", "part.nc", "-p", "fanuc-mill", "--setup", "job/setup.toml"]);
    assert!(ran.status == 0 && ran.out.contains("removed 0 of 45,6"), "{ran:?}");
    let wrong = place.with("wrong.toml", "stock = \"auto\"\nmaterial = \"steel\"\n");
    let ran = wrong.run(&["simulate", "part.nc", "--setup", "wrong.toml"]);
    assert!(ran.status == 1 && ran.err.contains("E0965"), "{ran:?}");
}

#[test]
fn verify_cuts_stock_too() {
    let place = posted();
    let verify = ["verify", "part.ncl", "part.nc", "-p", "fanuc-mill"];
    let ran = place.run(&[&verify, &STOCK[..]].concat());
    assert!(ran.status == 1 && ran.out.contains("agrees") && ran.out.contains("E0971"), "{ran:?}");
    let ran = place.run(&[&verify, &STOCK[..], &["--allow", "E0971", "--format", "json"]].concat());
    let found: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!((ran.status, &found["stock"]["findings"]), (0, &Value::Array(Vec::new())));
    assert_eq!(place.run(&verify).status, 0);
}
