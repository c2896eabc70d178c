//! `filpost plot` as its users meet it.

use std::process::{Command, Output};

use tempfile::TempDir;

const CL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nRAPID\nGOTO / 0, 0, 5\n\
                  FEDRAT / 200, MMPM\nGOTO / 0, 0, 0\nGOTO / 30, 10, 0\nFINI\n";

struct Folder(TempDir);

impl Folder {
    fn new() -> Folder {
        let place = Folder(TempDir::new().expect("a folder for the test"));
        place.write("a part.ncl", CL);
        place
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.0.path().join(name), text).expect("a file");
    }

    fn read(&self, name: &str) -> Option<String> {
        std::fs::read_to_string(self.0.path().join(name)).ok()
    }

    fn run(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_filpost"))
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .expect("the command runs")
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_cl_file_becomes_an_svg_on_standard_output() {
    let place = Folder::new();
    let output = place.run(&["plot", "a part.ncl", "--view", "xy"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let picture = text(&output.stdout);
    assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"), "{picture}");
    assert_eq!(picture.matches("<g>").count(), 1);
    assert_eq!(text(&output.stderr), "a part.ncl: 2 motions drawn\n");
}

#[test]
fn a_program_becomes_a_page_with_its_cl_file_and_its_map() {
    let place = Folder::new();
    let posted = place.run(&["post", "a part.ncl", "-o", "out.nc", "--map=out.nc.map"]);
    assert_eq!(posted.status.code(), Some(0), "{}", text(&posted.stderr));
    let output = place.run(&["plot", "out.nc", "--cl", "a part.ncl", "-o", "path.html"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let page = place.read("path.html").expect("the page");
    assert!(page.contains("\"sourceName\":\"a part.ncl\""), "the map's notes are in the page");
    assert!(page.contains("\"under\":{"), "the CL path is in the page");
}

#[test]
fn a_map_of_another_run_is_refused_when_named_and_left_out_when_found() {
    let place = Folder::new();
    place.run(&["post", "a part.ncl", "-o", "out.nc", "--map=out.nc.map"]);
    let other = place.read("out.nc").expect("the program").replace("X30.", "X31.");
    place.write("out.nc", &other);
    let named = place.run(&["plot", "out.nc", "--map", "out.nc.map", "-o", "path.svg"]);
    assert_eq!(named.status.code(), Some(1));
    assert!(text(&named.stderr).contains("E0708"), "{}", text(&named.stderr));
    assert_eq!(place.read("path.svg"), None);
    let found = place.run(&["plot", "out.nc", "-o", "path.svg"]);
    assert_eq!(found.status.code(), Some(0));
    assert!(text(&found.stderr).contains("is not used"), "{}", text(&found.stderr));
}

#[test]
fn a_program_of_another_dialect_is_refused_and_nothing_written() {
    let place = Folder::new();
    place.write("out.nc", "G0 X1. Y1.\nG65 P9810 X5.\nM30\n");
    let output = place.run(&["plot", "out.nc", "-p", "fanuc-mill", "-o", "path.svg"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("E0904"), "{}", text(&output.stderr));
    assert_eq!(place.read("path.svg"), None);
}

#[test]
fn a_program_whose_machine_nobody_names_is_read_by_the_family_of_its_text() {
    let place = Folder::new();
    for post in ["heidenhain-tnc640", "sinumerik-840d"] {
        let plain = "--option=style=plain";
        let posted = place.run(&["post", "a part.ncl", "-p", post, plain, "-o", "out.nc"]);
        assert_eq!(posted.status.code(), Some(0), "{}", text(&posted.stderr));
        let verified = place.run(&["verify", "a part.ncl", "out.nc"]);
        assert!(text(&verified.stderr).contains(post), "{}", text(&verified.stderr));
        assert_eq!(verified.status.code(), Some(0), "{}", text(&verified.stdout));
        let drawn = place.run(&["plot", "out.nc", "-o", "path.svg"]);
        assert_eq!(drawn.status.code(), Some(0), "{}", text(&drawn.stderr));
        assert!(text(&drawn.stderr).contains(post), "{}", text(&drawn.stderr));
        let other = place.run(&["plot", "out.nc", "-p", "linuxcnc-lathe", "-o", "path.svg"]);
        if post.starts_with("heidenhain") {
            assert_eq!(other.status.code(), Some(1));
            assert!(text(&other.stderr).contains("is Klartext"), "{}", text(&other.stderr));
        }
    }
}

#[test]
fn options_of_a_program_do_not_go_with_a_cl_file() {
    let place = Folder::new();
    let output = place.run(&["plot", "a part.ncl", "--cl", "a part.ncl"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("is a CL file"), "{}", text(&output.stderr));
}

#[test]
fn a_picture_of_no_known_kind_is_wrong_usage() {
    let place = Folder::new();
    let output = place.run(&["plot", "a part.ncl", "-o", "path.png"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains(".svg or .html"), "{}", text(&output.stderr));
}
