//! Makes `functions::FUNCTIONS` and the look-up of standard numbers from `data/functions.tsv`.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::fs;

/// Columns of the table.
const COLUMNS: usize = 12;

/// The dialects, in the order of `functions::Dialect`.
const DIALECTS: usize = 3;

/// Conditions under which the standard numbers of a row go before all settings: they are no part of
/// the look-up of a dialect.
const OVERLAYS: [&str; 3] = ["OspLengths", "OspThread", "OspCycles"];

/// A number that is read, in tenths, and its row.
type Reading = (u32, usize);

/// The source of the table. `settings` are the INTCOM locations by name.
pub fn source(settings: &HashMap<&str, &str>) -> String {
    let table = fs::read_to_string("data/functions.tsv").expect("data/functions.tsv");
    let lines = table.lines().filter(|line| !line.starts_with('#')).skip(1);
    let mut rows = String::new();
    let mut readings: [[Vec<Reading>; DIALECTS]; 2] = Default::default();
    for (index, line) in lines.enumerate() {
        let fields: Vec<&str> = line.split('\t').collect();
        assert_eq!(fields.len(), COLUMNS, "columns of {line}");
        let when = if fields[7] == "-" { "Always" } else { fields[7] };
        if !OVERLAYS.contains(&when) {
            for dialect in 0..DIALECTS {
                let of_letter = &mut readings[usize::from(fields[0] == "M")][dialect];
                let read = numbers(fields[4 + dialect]).into_iter().flatten().filter(|n| n.read);
                of_letter.extend(read.flat_map(Standard::all).map(|tenths| (tenths, index)));
            }
        }
        writeln!(rows, "    {},", row(&fields, when, settings)).unwrap();
    }
    let mut out = format!(
        "/// All functions, in the order of the file.\npub static FUNCTIONS: &[Function] = &[\n{rows}];\n"
    );
    out.push_str(
        "/// Standard numbers that are read, by letter (G, M) and dialect: tenths, row.\n",
    );
    out.push_str("static STANDARD: [[&[(u32, u8)]; 3]; 2] = [\n");
    for of_letter in &mut readings {
        for numbers in of_letter.iter_mut() {
            numbers.sort_unstable();
            let twice = numbers.windows(2).find(|pair| pair[0].0 == pair[1].0);
            assert_eq!(twice, None, "two functions of one number (tenths, row)");
        }
        let [mill, lathe_a, sinumerik] = of_letter;
        writeln!(out, "    [&{mill:?}, &{lathe_a:?}, &{sinumerik:?}],").unwrap();
    }
    out + "];\n"
}

/// The value of a row as Rust.
fn row(fields: &[&str], when: &str, settings: &HashMap<&str, &str>) -> String {
    let [space, group, value, names, .., acts, restorable, kind, title] = fields else {
        panic!("columns of {fields:?}")
    };
    let space = match *space {
        "cycle" => "Cycle",
        letter => letter,
    };
    let meaning = match *value {
        "-" => format!("Meaning::{group}"),
        value => format!("Meaning::{group}({group}::{value})"),
    };
    let names = names.split(' ').filter(|name| *name != "-").map(|name| {
        let (name, scale) = name.strip_suffix("/10").map_or((name, 10), |name| (name, 1));
        let number = settings.get(name).unwrap_or_else(|| panic!("no setting {name}"));
        format!("CodeSetting {{ at: Int({number}), scale: {scale} }}, ")
    });
    let standard = (0..DIALECTS).map(|dialect| match numbers(fields[4 + dialect]) {
        None => "None, ".to_string(),
        Some(numbers) => {
            let numbers: String = numbers.iter().map(|n| n.source() + ", ").collect();
            format!("Some(&[{numbers}]), ")
        }
    });
    let acts = acts[..1].to_uppercase() + &acts[1..];
    let restorable = match *restorable {
        "yes" => true,
        "no" => false,
        other => panic!("restorable is yes or no, not {other}"),
    };
    format!(
        "Function {{ space: Space::{space}, meaning: {meaning}, settings: &[{}], standard: [{}], \
         when: When::{when}, acts: Acts::{acts}, restorable: {restorable}, kind: {kind:?}, \
         title: {title:?} }}",
        names.collect::<String>(),
        standard.collect::<String>(),
    )
}

/// As `functions::Standard`.
struct Standard {
    first: u32,
    last: u32,
    reserved: bool,
    read: bool,
}

impl Standard {
    /// Its numbers: between whole ones only whole ones.
    fn all(self) -> impl Iterator<Item = u32> {
        let step = if self.first.is_multiple_of(10) { 10 } else { 1 };
        (self.first..=self.last).step_by(step)
    }

    fn source(&self) -> String {
        let Standard { first, last, reserved, .. } = self;
        format!("Standard {{ first: {first}, last: {last}, reserved: {reserved} }}")
    }
}

/// The numbers of a cell; `None` where the dialect has no such function.
fn numbers(cell: &str) -> Option<Vec<Standard>> {
    let number = |text: &str| {
        let part = match text.strip_prefix(['~', '!']) {
            Some(part) => part,
            None => text,
        };
        let (first, last) = part.split_once('-').unwrap_or((part, part));
        let tenths = |text: &str| (text.parse::<f64>().expect("a number") * 10.0).round() as u32;
        let (first, last) = (tenths(first), tenths(last));
        Standard { first, last, reserved: !text.starts_with('~'), read: !text.starts_with('!') }
    };
    match cell {
        "no" => None,
        "-" => Some(Vec::new()),
        cell => Some(cell.split(' ').map(number).collect()),
    }
}
