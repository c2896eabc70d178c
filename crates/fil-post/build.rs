//! Makes Rust constants and a table from `data/locations.tsv`.

use std::fmt::Write as _;
use std::{env, fs, path::Path};

fn main() {
    println!("cargo::rerun-if-changed=data/locations.tsv");
    let source = fs::read_to_string("data/locations.tsv").expect("data/locations.tsv");
    let mut constants = String::new();
    let mut table = String::from("/// All named locations, in the order of the table's file.\n");
    table.push_str("pub static TABLE: &[Location] = &[\n");
    let rows = source.lines().filter(|line| !line.starts_with('#')).skip(1);
    for line in rows {
        let fields: Vec<&str> = line.split('\t').collect();
        let [kind, number, name, unit, default, choices, meaning, evidence, used] = fields[..]
        else {
            panic!("nine columns expected: {line}");
        };
        let (variant, form) = match kind {
            "I" => ("Int", "Int"),
            "R" => ("Rel", "Rel"),
            "D" => ("Dbl", "Dbl"),
            _ => panic!("kind I, R or D expected: {line}"),
        };
        if used == "yes" {
            let constant = name.to_uppercase().replace('.', "_");
            writeln!(constants, "/// {kind} {number}, `{name}`: {meaning}").unwrap();
            writeln!(constants, "pub const {constant}: {form} = {form}({number});").unwrap();
        }
        let default: f64 = default.parse().expect("numeric default");
        writeln!(
            table,
            "    Location {{ kind: Kind::{variant}, number: {number}, name: {name:?}, \
             unit: {unit:?}, default: {default:?}, choices: {choices:?}, \
             meaning: {meaning:?}, evidence: {evidence:?}, used: {} }},",
            used == "yes"
        )
        .unwrap();
    }
    table.push_str("];\n");
    let out = Path::new(&env::var("OUT_DIR").expect("OUT_DIR")).join("locations.rs");
    fs::write(out, constants + &table).expect("write locations.rs");
}
