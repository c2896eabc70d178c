//! A real option file and the list of commons of its report, where they are at hand.

use std::path::PathBuf;

use filpost::locations::{Location, TABLE};
use filpost::settings::{read_option_file, read_toml, write_toml};
use filpost::user_blocks;

/// Text of a file of the outside data; `None`, saying so, where there is none.
fn outside(name: &str) -> Option<String> {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let data =
        std::env::var_os("FILPOST_DATA").map_or(here.join("../../shared/data"), PathBuf::from);
    match std::fs::read(data.join(name)) {
        Ok(bytes) => Some(String::from_utf8_lossy(&bytes).into_owned()),
        Err(error) => {
            println!("skipped: {name}: {error}");
            None
        }
    }
}

fn kind(name: &str) -> filpost::Kind {
    match name {
        "I" => filpost::Kind::Int,
        "R" => filpost::Kind::Rel,
        _ => filpost::Kind::Dbl,
    }
}

#[test]
fn every_common_of_the_report_has_a_name() {
    let Some(text) = outside("commons.tsv") else { return };
    let mut rows = 0;
    for line in text.lines().skip(1) {
        let common = line.split('\t').next().unwrap_or_default();
        let (letter, number) = common.split_at(1);
        let number: u32 = number.split('-').next().unwrap().parse().unwrap();
        assert!(Location::numbered(kind(letter), number).is_some(), "{common} has no name");
        rows += 1;
    }
    assert_eq!(rows, 353, "rows of the report; {} locations are named", TABLE.len());
}

#[test]
fn the_option_file_reads_as_its_pairs_say() {
    let Some(text) = outside("option-file/uncx01.p02") else { return };
    let file = read_option_file("uncx01.p02", &text).unwrap();
    let mut list = None;
    let mut pairs = 0;
    for line in text.lines() {
        let head = line.trim_start();
        if let Some(common) =
            ["INTCOM:", "RELCOM:", "DBLCOM:"].iter().find(|c| head.starts_with(**c))
        {
            list = Some(kind(&common[..1]));
            continue;
        }
        let fields: Vec<&str> = line.split_whitespace().collect();
        let (Some(list), &[location, value]) = (list, fields.as_slice()) else { continue };
        let (location, value): (u32, f64) = (location.parse().unwrap(), value.parse().unwrap());
        if location != 0 {
            let wanted = if value == -32767.0 { 999_999.0 } else { value };
            assert_eq!(file.commons.get(list, location).unwrap(), wanted, "{list:?} {location}");
            pairs += 1;
        }
    }
    assert_eq!(pairs, 905 + 15, "905 INTCOM and 15 DBLCOM pairs");
}

/// The packed texts of start and end blocks are left out: an unused one may be
/// blank or absent. The posted file of the next test shows the used ones.
#[test]
fn the_imported_machine_toml_is_the_same_machine() {
    let Some(text) = outside("option-file/uncx01.p02") else { return };
    let imported = read_option_file("uncx01.p02", &text).unwrap().commons;
    let (again, _) = read_toml("machine.toml", &write_toml(&imported)).unwrap();
    let is_text = |kind, location: &u32| {
        kind == filpost::Kind::Int && matches!(location, 3485..=3814 | 3982..=4311)
    };
    for kind in [filpost::Kind::Int, filpost::Kind::Rel, filpost::Kind::Dbl] {
        for location in (1..=kind.size() as u32).filter(|location| !is_text(kind, location)) {
            let (a, b) = (imported.get(kind, location), again.get(kind, location));
            assert_eq!(a.unwrap(), b.unwrap(), "{kind:?} {location}");
        }
    }
}

#[test]
fn the_imported_machine_posts_a_real_file() {
    let (Some(machine), Some(fil), Some(cl)) = (
        outside("option-file/uncx01.p02"),
        outside("option-file/uncx01.f02"),
        outside("cl/creo/profilfraesen_2.ncl.1"),
    ) else {
        return;
    };
    let post = filpost::Program::builder()
        .option_file("uncx01.p02", &machine)
        .fil("uncx01.f02", &fil)
        .build()
        .unwrap();
    let mut nc = Vec::new();
    post.stream(cl.as_bytes(), &mut nc).unwrap();
    let nc = String::from_utf8(nc).unwrap();
    let blocks: Vec<&str> = nc.lines().collect();
    // The user's blocks of the file, no numbers, no M words, rapid and straight
    // codes in every block, arcs by radius, decimals with at least one zero.
    assert_eq!(blocks[..2], ["G21", "G90"]);
    assert!(blocks[2].starts_with("M3 S1000"), "{}", blocks[2]);
    assert_eq!(
        blocks[3..8],
        ["G00 X0.0 Y1.5", "G00 Z2.0", "G01 Z-1.5 F400.0", "G02 X1.5 Y0.0 R1.5", "G01 Y-33.0",]
    );
    assert_eq!(blocks[blocks.len() - 2..], ["G1 Z1.0", "M5"]);
    assert!(!nc.contains('%') && !nc.contains('O') && !nc.contains('N'), "{nc}");
}

/// A location of each kind and each unit keeps its value on the way through machine.toml.
#[test]
fn every_location_comes_back_from_machine_toml() {
    use filpost::{Kind, stored};

    let default = filpost::locations::default_commons();
    let mut commons = default.clone();
    let mut changed = 0;
    for kind in [Kind::Int, Kind::Rel, Kind::Dbl] {
        for number in 212..=kind.size() as u32 {
            let before = default.get(kind, number).unwrap();
            let values = [71.0, 1.0, 2.0, 0.0, 14.0, 7.0, 0.5, 999_999.0];
            let fits = |value: &&f64| {
                **value != before
                    && (kind != Kind::Int || value.fract() == 0.0)
                    && stored::check(kind, number, **value).is_ok()
            };
            if let Some(value) = values.iter().find(fits) {
                commons.set(kind, number, *value).unwrap();
                changed += 1;
            }
        }
    }
    assert!(changed > 20_000, "{changed}");
    let (again, _) = read_toml("machine.toml", &write_toml(&commons)).unwrap();
    for kind in [Kind::Int, Kind::Rel, Kind::Dbl] {
        for number in 1..=kind.size() as u32 {
            let (a, b) = (commons.get(kind, number).unwrap(), again.get(kind, number).unwrap());
            assert_eq!(a, b, "{kind:?} {number}");
        }
    }
}

/// An option file with one value at every location of the vendor.
fn option_file_of(value: &str) -> String {
    const LAST: [(&str, u32); 3] = [("INTCOM", 4765), ("RELCOM", 22), ("DBLCOM", 1122)];
    let mut text = "POSTPROCESSOR OPTION FILE: UNCX01.P01\nEVERY LOCATION\n".to_string();
    for (list, last) in LAST {
        text.push_str(&format!(" {list}:(LOCATION,VALUE)\n"));
        for location in 1..=last {
            text.push_str(&format!("{location:>5}   {value}\n"));
        }
        text.push_str("    0   0\n");
    }
    text
}

/// What `machine import` makes of an option file is the same machine, whatever the file
/// holds: values that filpost would not take from anybody else too.
#[test]
fn every_location_of_an_option_file_comes_back() {
    for value in ["77", "-64", "3", "0", "8224", "-32767"] {
        let imported = read_option_file("uncx01.p01", &option_file_of(value)).unwrap().commons;
        let toml = write_toml(&imported);
        let (again, _) = read_toml("machine.toml", &toml).unwrap_or_else(|errors| {
            panic!(
                "{value}: {} of {} lines refused: {}",
                errors.len(),
                toml.lines().count(),
                errors[0]
            )
        });
        for kind in [filpost::Kind::Int, filpost::Kind::Rel, filpost::Kind::Dbl] {
            for number in 1..=kind.size() as u32 {
                // A text that is not there is blank.
                let is_text = kind == filpost::Kind::Int
                    && u16::try_from(number).is_ok_and(|n| user_blocks::list_of(n).is_some());
                let said = |value: f64| if is_text && value == 999_999.0 { 8224.0 } else { value };
                let [a, b] = [&imported, &again].map(|at| said(at.get(kind, number).unwrap()));
                assert_eq!(a, b, "{value}: {kind:?} {number}");
            }
        }
    }
}
