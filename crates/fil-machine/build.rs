//! Makes the typed settings from `data/locations.tsv`: a constant for each
//! location the post acts on, an enum for each choice, and the table of all rows; and the table of
//! G and M functions from `data/functions.tsv`.

#[path = "build/functions.rs"]
mod functions;

use std::collections::{HashMap, HashSet};
use std::fmt::Write as _;
use std::{env, fs, path::Path};

/// Choices that several settings share, and the enum they become.
const SHARED: &[(&str, &str)] = &[
    ("0=none|1=table|2=head", "RotaryKind"),
    ("1=A|2=B|3=C", "RotaryAxis"),
    ("0=not used|1=reposition|2=warn", "Exceeded"),
    ("0=straight range|1=rotary ranges", "TravelKind"),
    ("1=block of its own|2=next XY block|3=next Z block", "Placement"),
];

/// An integer that is absent.
const ABSENT: &str = "-32767";

/// A real that is absent.
const ABSENT_REAL: &str = "999999";

fn main() {
    for file in ["build.rs", "build/functions.rs", "data/locations.tsv", "data/functions.tsv"] {
        println!("cargo::rerun-if-changed={file}");
    }
    let source = fs::read_to_string("data/locations.tsv").expect("data/locations.tsv");
    let mut constants = String::new();
    let mut enums = String::new();
    let mut seen = HashSet::new();
    let mut cells = HashSet::new();
    let mut integers = HashMap::new();
    let mut table = String::from("/// All named locations, in the order of the table's file.\n");
    table.push_str("pub static TABLE: &[Location] = &[\n");
    for line in source.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let row = Row::read(line);
        assert!(cells.insert((row.kind, row.number)), "two settings in one location: {line}");
        if row.kind == "I" {
            integers.insert(row.name, row.number);
        }
        if row.used {
            row.constant(&mut constants);
            if row.unit == "choice" && seen.insert(row.enum_name()) {
                row.choice_enum(&mut enums);
            }
        }
        row.table_entry(&mut table);
    }
    table.push_str("];\n");
    let folder = env::var("OUT_DIR").expect("OUT_DIR");
    let write = |name: &str, source: String| {
        fs::write(Path::new(&folder).join(name), source).expect("write into OUT_DIR");
    };
    write("locations.rs", enums + &constants + &table);
    write("functions.rs", functions::source(&integers));
}

/// A line of the table.
struct Row<'a> {
    kind: &'a str,
    number: &'a str,
    name: &'a str,
    unit: &'a str,
    default: &'a str,
    choices: &'a str,
    meaning: &'a str,
    evidence: &'a str,
    used: bool,
    /// Why the post does not act on it, where that is known.
    idle: &'a str,
}

impl<'a> Row<'a> {
    fn read(line: &'a str) -> Self {
        let fields: Vec<&str> = line.split('\t').collect();
        let [kind, number, name, unit, default, choices, meaning, evidence, used] = fields[..]
        else {
            panic!("nine columns expected: {line}");
        };
        let (used, idle) = match used {
            "yes" => (true, ""),
            "no" => (false, ""),
            reason => (false, reason),
        };
        Row { kind, number, name, unit, default, choices, meaning, evidence, used, idle }
    }

    /// The commons this row lies in, as the type of its constant.
    fn common(&self) -> &'static str {
        match self.kind {
            "I" => "Int",
            "R" => "Rel",
            "D" => "Dbl",
            other => panic!("kind I, R or D expected, not {other}"),
        }
    }

    /// `circle.center` becomes `CircleCenter`.
    fn enum_name(&self) -> String {
        let shared = SHARED.iter().find(|(choices, _)| *choices == self.choices);
        shared.map_or_else(|| camel_case(self.name), |(_, name)| name.to_string())
    }

    /// The variant of `ValueUnit`.
    fn value_unit(&self) -> String {
        match self.unit {
            "-" => "Plain".into(),
            "deg" => "Degrees".into(),
            "mm/min" => "MmPerMinute".into(),
            "s" => "Seconds".into(),
            other => camel_case(other),
        }
    }

    fn constant(&self, out: &mut String) {
        let Row { kind, number, name, meaning, .. } = self;
        let constant = name.to_uppercase().replace('.', "_");
        let (form, value) = match self.unit {
            "flag" => {
                let default = matches!(self.default, "1" | "71");
                ("Flag".into(), format!("Flag {{ number: {number}, default: {default} }}"))
            }
            "choice" if *kind == "D" && self.default == ABSENT_REAL => (
                format!("OptionalRealChoice<{}>", self.enum_name()),
                self.choice("OptionalRealChoice"),
            ),
            "choice" if *kind == "D" => {
                (format!("RealChoice<{}>", self.enum_name()), self.choice("RealChoice"))
            }
            "choice" if self.default == ABSENT => {
                (format!("OptionalChoice<{}>", self.enum_name()), self.choice("OptionalChoice"))
            }
            "choice" => (format!("Choice<{}>", self.enum_name()), self.choice("Choice")),
            "letter" => ("LetterAt".into(), format!("LetterAt({number})")),
            "code" => ("CodeAt".into(), format!("CodeAt({number})")),
            "char" => ("CharacterAt".into(), format!("CharacterAt({number})")),
            _ => (self.common().into(), format!("{}({number})", self.common())),
        };
        writeln!(out, "/// {kind} {number}, `{name}`: {meaning}").unwrap();
        writeln!(out, "pub const {constant}: {form} = {value};").unwrap();
    }

    fn choice(&self, form: &str) -> String {
        format!("{form}::at({})", self.number)
    }

    fn choice_enum(&self, out: &mut String) {
        let name = self.enum_name();
        let choices: Vec<(&str, String, &str)> = self
            .choices
            .split('|')
            .map(|choice| choice.split_once('=').expect("a choice is number=meaning"))
            .map(|(number, meaning)| (number, camel_case(meaning), meaning))
            .collect();
        writeln!(
            out,
            "/// Choices of `{}` ({} {}): {}",
            self.name, self.kind, self.number, self.meaning
        )
        .unwrap();
        let has_default = choices.iter().any(|(number, ..)| *number == self.default);
        let default = if has_default { ", Default" } else { "" };
        writeln!(out, "#[derive(Clone, Copy, Debug, PartialEq, Eq{default})]\npub enum {name} {{")
            .unwrap();
        for (number, variant, meaning) in &choices {
            let mark = if *number == self.default { "    #[default]\n" } else { "" };
            writeln!(out, "    /// {number}: {meaning}\n{mark}    {variant} = {number},").unwrap();
        }
        writeln!(out, "}}\n\nimpl FromNumber for {name} {{").unwrap();
        writeln!(
            out,
            "    fn from_number(number: i32) -> Option<Self> {{\n        match number {{"
        )
        .unwrap();
        for (number, variant, _) in &choices {
            writeln!(out, "            {number} => Some({name}::{variant}),").unwrap();
        }
        writeln!(out, "            _ => None,\n        }}\n    }}\n}}\n").unwrap();
    }

    fn table_entry(&self, out: &mut String) {
        let Row { number, name, choices, meaning, used, idle, .. } = self;
        let (unit, evidence) = (self.value_unit(), camel_case(self.evidence));
        let default: f64 = self.default.parse().expect("numeric default");
        let common = self.common();
        // What a setting means that does nothing is one of its reasons.
        let meaning =
            if *used { format!("{meaning:?}") } else { format!("fil_diag::reason({meaning:?})") };
        writeln!(
            out,
            "    Location {{ kind: Kind::{common}, number: {number}, name: {name:?}, \
             unit: ValueUnit::{unit}, default: {default:?}, choices: {choices:?}, \
             meaning: {meaning}, evidence: Evidence::{evidence}, used: {used}, \
             idle: fil_diag::reason({idle:?}) }},",
        )
        .unwrap();
    }
}

/// Words of letters and digits joined, each with a capital.
fn camel_case(text: &str) -> String {
    text.split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(|word| word[..1].to_uppercase() + &word[1..].to_lowercase())
        .collect()
}
