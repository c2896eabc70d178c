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
fn a_program_is_drawn_as_far_as_its_machine_has_its_words() {
    let place = Folder::new();
    place.write(
        "out.nc",
        "T1 M6\nG0 G54 X0. Y0.\nG43 H1 Z5.\n#1=#5001\nG0 X0. Y0. Z4.\nG1 Z-1. F100.\n#2=[2+3]\nX#2\n\
         G187 P1\nX9.\nG0 X8. Y8. Z9.\nG1 Z1. F90.\nM30\n",
    );
    let output = place.run(&["plot", "out.nc", "-p", "fanuc-mill", "-o", "path.html"]);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let unknown = "out.nc:4: not drawn: `#` is not a word of an NC program";
    assert!(said.contains(unknown), "{said}");
    assert!(said.contains("out.nc:9: not drawn: the machine has no G187"), "{said}");
    // What follows the block is not joined to what came before it.
    assert!(said.contains("out.nc:10: not drawn: no G code"), "{said}");
    assert!(said.contains("out.nc: 3 motions drawn"), "{said}");
    let page = place.read("path.html").expect("the page");
    assert!(page.contains("\"line 9: not drawn: the machine has no G187\""), "the gaps");
}

/// What a refused block says of the unit and of axis words holds, and the block after a head that
/// is refused is read.
#[test]
fn gaps_do_not_change_what_numbers_mean() {
    let place = Folder::new();
    place.write(
        "out.nc",
        "#1=#5001\nG20 G90\nG0 X0. Y0. Z1.\nG91 G187 P1\nG90 G0 X0. Y0. Z1.\nG91 G187\nG0 X1. Y1. Z1.\n\
         G90 G0 X0. Y0. Z0.\nX1.\nM30\n",
    );
    let output = place.run(&["plot", "out.nc", "-p", "fanuc-mill", "-o", "path.html"]);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("note: out.nc:1: not drawn: `#`"), "{said}");
    assert!(!said.contains("out.nc:2"), "{said}");
    assert!(said.contains("out.nc: 1 motion drawn"), "{said}");
    let page = place.read("path.html").expect("the page");
    assert!(page.contains("X 0 to 1 · Y 0 to 0 · Z 0 to 0 inch"), "the path is in inch");
}

#[test]
fn contour_of_a_roughing_cycle_that_the_machine_lacks_is_drawn() {
    let place = Folder::new();
    place.write(
        "out.nc",
        "T0101\nG97 S500 M3\nG0 X60. Z5.\nG71 U2. R1.\nG71 P10 Q20 U.5 W.1 F.3\nN10 G0 X20. Z5.\n\
         G1 Z-10. F.2\nX40. Z-20.\nN20 X60.\nG70 P10 Q20\nG0 X100. Z50.\nM30\n",
    );
    let output = place.run(&["plot", "out.nc", "-p", "haas-lathe", "-o", "path.svg"]);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("out.nc:4: 2 lines not drawn: the machine has no G71"), "{said}");
    assert!(said.contains("out.nc:10: not drawn: the machine has no G70"), "{said}");
    assert!(said.contains("out.nc: 3 motions drawn"), "{said}");
}

#[test]
fn a_second_program_lies_under_the_first() {
    let place = Folder::new();
    place.run(&["post", "a part.ncl", "-o", "out.nc"]);
    let proven = place.read("out.nc").expect("the program").replace("X30.", "X31.");
    place.write("proven.nc", &proven);
    let output = place.run(&["plot", "out.nc", "--second", "proven.nc", "-o", "path.html"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let page = place.read("path.html").expect("the page");
    assert!(page.contains("\"underName\":\"second program\""), "its name is in the page");
    assert!(page.contains("\"under\":{"), "its path is in the page");
    let both = place.run(&["plot", "out.nc", "--second", "proven.nc", "--cl", "a part.ncl"]);
    assert_eq!(both.status.code(), Some(2));
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
