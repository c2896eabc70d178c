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

/// Stock, part and tools of a job, found in the order: option, stock.toml or case next to the part,
/// machine.
#[test]
fn the_setup_is_found_next_to_the_part_in_its_case_and_in_the_machine() {
    let place = posted().with(
        "post/machine.toml",
        "base = \"fanuc-mill\"\n[simulate]\nstock = \"box 60x40x20\"\ngrid = 1\ntools.1 = \"D8\"\n",
    );
    let on_machine = ["simulate", "part.nc", "-p", "post"];
    // A slot of 8 mm, and the way back beside it: 16 wide.
    let removed = |ran: &Ran| {
        let at = ran.out.find("removed ").expect("a report");
        ran.out[at..].split(' ').nth(1).unwrap_or_default().replace(',', "")
    };
    let ran = place.run(&on_machine);
    assert!(ran.status == 1 && removed(&ran) == (60 * 16 * 2).to_string(), "{ran:?}");
    let ran = place.run(&["machine", "show", "post"]);
    assert!(ran.out.contains("simulate.stock               box 60x40x20"), "{ran:?}");
    // The file next to the part wins key by key: a lower stock with the tool of the machine.
    let place = place.with("stock.toml", "stock = \"box 60x40x20@0,0,-21\"\n");
    let ran = place.run(&on_machine);
    assert!(ran.err.contains("setup: stock.toml"), "{ran:?}");
    assert!(removed(&ran) == (60 * 16).to_string(), "{ran:?}");
    let ran = place.run(&[&on_machine[..], &["--tool", "1=D4", "--stock", "auto"]].concat());
    assert!(ran.status == 1 && ran.err.contains("the box around the cuts has no width"), "{ran:?}");
}

#[test]
fn a_case_is_posted_and_cut() {
    let case = "cl = \"part.ncl\"\nready = \"fanuc-mill\"\nexpect = \"part.nc\"\norigin = \"a test\"\n\
                [simulate]\nstock = \"box 60x40x20\"\ngrid = 0.5\n";
    let place = Folder::new().with("job/part.ncl", PART).with("job/case.toml", case);
    let ran = place.run(&["simulate", "job"]);
    for part in ["error E0971: NC line", "(CL line 14)", "made by part.ncl:14  GOTO / -10, 20, -2"]
    {
        assert!(ran.status == 1 && ran.out.contains(part), "{part}: {ran:?}");
    }
    let ran = place.run(&["simulate", "job", "-p", "haas-mill"]);
    assert!(ran.status == 2 && ran.err.contains("a case has its own CL file and post"), "{ran:?}");
    let wrong = place.with("job/case.toml", case.replace("stock =", "stok ="));
    let ran = wrong.run(&["simulate", "job"]);
    assert!(ran.status == 1 && ran.err.contains("did you mean stock?"), "{ran:?}");
}

/// A slot into a shaft, too deep for its holder, and below the part.
#[test]
fn verify_cuts_stock_on_a_lathe() {
    let part = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 900, CLW\nRAPID\nGOTO / 31, 0, -30\n\
                FEDRAT / 0.1, MMPR\nGOTO / 19, 0, -30\nRAPID\nGOTO / 31, 0, -30\nRAPID\n\
                GOTO / 25, 0, -50\nFINI\n";
    let place = Folder::new().with("part.ncl", part);
    let ran = place.run(&["post", "part.ncl", "-p", "fanuc-lathe", "-o", "part.nc"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let verify =
        ["verify", "part.ncl", "part.nc", "-p", "fanuc-lathe", "--stock", "cylinder:60x80"];
    let ran = place.run(&[&verify[..], &["--tool", "3=Q3R0.2W3L8H20x100"]].concat());
    for part in ["agrees", "E0972", "E0971"] {
        assert!(ran.status == 1 && ran.out.contains(part), "{part}: {ran:?}");
    }
    let ran = place.run(&verify);
    assert!(ran.status == 1 && ran.err.contains("--tool 3="), "{ran:?}");
}
