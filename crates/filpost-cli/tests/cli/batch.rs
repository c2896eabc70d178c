//! `filpost post` with many CL files

use crate::support::{Folder, NC, SMALL, WRONG};

/// A part of its own for a number.
fn part(number: usize) -> String {
    let goto = (0..number * 40)
        .fold(String::new(), |text, x| text + &format!("GOTO / {x}, {number}, 3\n"));
    SMALL.replace("GOTO / 1, 2, 3\n", &goto)
}

fn many(count: usize) -> Folder {
    let place = Folder::new().folder("cl");
    (1..=count)
        .fold(place, |place, number| place.with(&format!("cl/op{number:02}.ncl"), part(number)))
}

#[test]
fn a_folder_is_posted_as_its_files_one_by_one() {
    let place = many(12).with("cl/notes.txt", "not a CL file").folder("cl/sub.ncl");
    let ran = place.run(&["post", "cl", "-o", "nc", "--map"]);
    assert_eq!((ran.status, ran.out.as_str()), (0, ""), "{ran:?}");
    for number in 1..=12 {
        let name = format!("op{number:02}");
        let (cl, one) = (format!("cl/{name}.ncl"), format!("{name}.tap"));
        assert_eq!(place.run(&["post", &cl, "-o", &one]).status, 0);
        assert_eq!(place.text(&format!("nc/{name}.nc")), place.text(&one), "{name}");
        let question = format!("nc/{name}.nc:6");
        assert_eq!(place.run(&["trace", &question]).status, 0, "{question}");
    }
    let rows: Vec<&str> = ran.err.lines().collect();
    assert_eq!(rows.len(), 13, "{}", ran.err);
    for (number, row) in (1..).zip(&rows[..12]) {
        assert!(row.starts_with(&format!("cl/op{number:02}.ncl  ")), "{row}");
    }
    assert!(rows[12].starts_with("12 files posted, 0 refused, "), "{}", rows[12]);
}

#[test]
fn programs_lie_beside_their_cl_files_without_a_folder() {
    let place =
        many(2).with("cl/a.ncl.1", WRONG).with("cl/a.ncl.2", WRONG).with("cl/a.ncl.10", SMALL);
    let ran = place.run(&["post", "cl"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    assert_eq!(place.text("cl/a.nc").as_deref(), Some(NC));
    assert!(ran.err.contains("note: 2 older versions in cl left out"), "{}", ran.err);
    assert!(ran.err.contains("3 files posted"), "{}", ran.err);
}

#[test]
fn a_part_that_is_refused_does_not_stop_the_others() {
    let place = many(3).with("cl/op02.ncl", WRONG).with("cl/op04.ncl", SMALL.replace("FINI\n", ""));
    let files = ["cl/op01.ncl", "cl/op02.ncl", "cl/none.ncl", "cl/op03.ncl", "cl/op04.ncl"];
    let ran = place.run(&[&["post", "-o", "nc"], &files[..]].concat());
    assert_eq!((ran.status, ran.out.as_str()), (1, ""), "{ran:?}");
    let there = ["op01", "op02", "none", "op03", "op04"]
        .map(|name| place.text(&format!("nc/{name}.nc")).is_some());
    assert_eq!(there, [true, false, false, true, true]);
    let at = |text: &str| ran.err.find(text).unwrap_or_else(|| panic!("{text}: {}", ran.err));
    let order = ["cl/op02.ncl:\n", "cl/none.ncl:\n", "E0701", "cl/op04.ncl:\n", "W0752"];
    let places: Vec<usize> = order.iter().map(|text| at(text)).collect();
    assert!(places.is_sorted(), "{}", ran.err);
    assert!(ran.err.contains("refused, E0701") && ran.err.contains("3 files posted, 2 refused"));
}

#[test]
fn names_that_would_meet_are_refused_before_anything_is_written() {
    let place =
        Folder::new().folder("a").folder("b").with("a/op.ncl", SMALL).with("b/op.ncl", SMALL);
    let ran = place.run(&["post", "a/op.ncl", "b/op.ncl", "-o", "nc"]);
    assert!(ran.status == 1 && ran.err.contains("E0802"), "{ran:?}");
    assert_eq!(place.files(), ["a", "b"], "nothing is written");
    let twice = place.run(&["post", "a/op.ncl", "./a/op.ncl"]);
    assert!(twice.status == 1 && twice.err.contains("E0802"), "{twice:?}");
    let place = place.with("a/x.nc", SMALL).with("a/x.ncl", SMALL);
    let over = place.run(&["post", "a/x.ncl", "a/x.nc"]);
    assert!(over.status == 1 && over.err.contains("E0802"), "{over:?}");
    assert_eq!(place.text("a/x.nc").as_deref(), Some(SMALL));
}

#[test]
fn what_makes_no_sense_for_several_files_is_wrong_usage() {
    let place = many(2);
    for more in [&["-o", "-"][..], &["--listing", "x.lst"], &["--map", "x.map"], &["-"]] {
        let ran = place.run(&[&["post", "cl"], more].concat());
        assert_eq!(ran.status, 2, "{more:?}: {ran:?}");
    }
    let empty = place.folder("empty").run(&["post", "empty"]);
    assert!(empty.status == 1 && empty.err.contains("E0807"), "{empty:?}");
}

#[test]
fn scripts_that_write_run_one_after_the_other() {
    let fil =
        "DMY=FILEF(1,APPEND,'log.txt')\nT1=TEXT/'DONE'\nWRITE/1,T1\nDMY=FILEF(1,CLOSE)\nFINI\n";
    let place = many(6).folder("log").with("log.fil", fil);
    let ran = place.run(&["post", "cl", "-o", "nc", "-f", "log.fil", "--grant", "write=log"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    assert_eq!(place.text("log/log.txt").map(|log| log.lines().count()), Some(6));
}

#[test]
fn the_same_refusal_of_many_files_is_shown_three_times_and_counted() {
    let wrong = SMALL.replace("UNITS", "MACHIN / UNCX01, 1\nUNITS");
    let place = (1..=30)
        .fold(Folder::new(), |place, n| place.with(&format!("cl/op{n:02}.ncl"), wrong.as_str()));
    let ran = place.with("cl/good.ncl", SMALL).run(&["post", "cl", "-o", "nc"]);
    assert_eq!(ran.status, 1);
    assert_eq!(ran.err.matches("E0714 MACHIN names no post").count(), 3, "{}", ran.err);
    let rest = "E0714 there is no post for MACHIN/UNCX01,1: the same in 27 more files\n";
    assert!(ran.err.contains(rest), "{}", ran.err);
    // So are the rows of the table.
    assert_eq!(ran.err.matches("refused, E0714").count(), 4, "{}", ran.err);
    assert!(ran.err.contains("\n27 more files: refused, E0714\n"), "{}", ran.err);
    assert!(ran.err.contains("1 file posted, 30 refused"), "{}", ran.err);
}
