//! What a G or M code means, by the table of functions and the settings of the ready posts.

use fil_machine::functions::{self, Dialect, FUNCTIONS, Function, Space};
use fil_machine::locations::{CONTROL_FAMILY, ControlFamily, Location};
use fil_machine::{Commons, FunctionCode, Kind};

use crate::Program;
use crate::ready::READY;

/// The controls whose standard numbers differ.
const DIALECTS: [(Dialect, &str); 3] = [
    (Dialect::Mill, "mills (Fanuc style; Heidenhain: M codes only)"),
    (Dialect::LatheA, "lathes (G code system A)"),
    (Dialect::Sinumerik, "SINUMERIK"),
];

/// Canned cycles of mills, which are one row of the table of functions.
const MILL_CYCLES: [(&str, &str); 11] = [
    ("73", "high-speed peck drilling (chip breaking)"),
    ("74", "left-hand tapping"),
    ("76", "fine boring"),
    ("81", "drilling"),
    ("82", "drilling with dwell (counterboring)"),
    ("83", "deep-hole peck drilling"),
    ("84", "tapping"),
    ("85", "boring, feed out"),
    ("86", "boring, spindle stop and rapid out"),
    ("87", "back boring"),
    ("89", "boring with dwell, feed out"),
];

/// Canned cycles of lathes with G code system A.
const LATHE_CYCLES: [(&str, &str); 6] = [
    ("83", "deep-hole drilling on the face"),
    ("84", "tapping on the face"),
    ("85", "boring on the face"),
    ("87", "deep-hole drilling on the side"),
    ("88", "tapping on the side"),
    ("89", "boring on the side"),
];

/// Explains `G83`, `g54.1` or `M08`; `None` for a text that is no code or an unknown code.
pub fn explain(word: &str) -> Option<String> {
    let (letter, number) = word.split_at_checked(1)?;
    let space = match letter {
        "G" | "g" => Space::G,
        "M" | "m" => Space::M,
        _ => return None,
    };
    let code = FunctionCode::of_value(number.parse().ok()?)?;
    let mut parts = standard(space, code);
    let settings = settings(space, code);
    if !settings.is_empty() {
        parts.push("Settings of ready posts that have this code:".to_string());
        parts.extend(settings);
    }
    let name = format!("{}{code}", letter.to_ascii_uppercase());
    (!parts.is_empty()).then(|| format!("{name}\n\n{}", parts.join("\n")))
}

/// What the code means on each control: `Standard code for tapping, on mills (Fanuc style).`
fn standard(space: Space, code: FunctionCode) -> Vec<String> {
    let mut meanings: Vec<(&str, Vec<&str>)> = Vec::new();
    for (dialect, controls) in DIALECTS {
        let Some(row) = functions::standard(dialect, space, code) else { continue };
        let title = cycle(dialect, code).filter(|_| row.space == Space::Cycle).unwrap_or(row.title);
        match meanings.iter_mut().find(|(other, _)| *other == title) {
            Some((_, all)) => all.push(controls),
            None => meanings.push((title, vec![controls])),
        }
    }
    let line = |(title, controls): (&str, Vec<&str>)| {
        format!("Standard code for {title}, on {}.", controls.join(", "))
    };
    meanings.into_iter().map(line).collect()
}

/// The canned cycle of a code.
fn cycle(dialect: Dialect, code: FunctionCode) -> Option<&'static str> {
    let names: &[(&str, &str)] = match dialect {
        Dialect::Mill => &MILL_CYCLES,
        Dialect::LatheA => &LATHE_CYCLES,
        _ => &[],
    };
    let number = code.to_string();
    names.iter().find(|(code, _)| *code == number).map(|(_, name)| *name)
}

/// The settings that hold the code in a ready post, each with its meaning and the posts.
fn settings(space: Space, code: FunctionCode) -> Vec<String> {
    let build = |name: &'static str| Program::builder().ready(name).build().ok();
    let posts: Vec<(&str, Program)> =
        READY.iter().filter_map(|post| Some((post.name, build(post.name)?))).collect();
    let in_space =
        |row: &&Function| row.space == space || (row.space, space) == (Space::Cycle, Space::G);
    let mut lines = Vec::new();
    for row in FUNCTIONS.iter().filter(in_space) {
        for setting in row.settings {
            let writes = |commons: &Commons| {
                setting.code(commons) == Some(code)
                    && (row.space != Space::Cycle
                        || commons.read(CONTROL_FAMILY) == ControlFamily::WordAddress)
            };
            let with = posts.iter().filter(|(_, program)| writes(program.commons()));
            let names: Vec<&str> = with.map(|(name, _)| *name).collect();
            let location = Location::numbered(Kind::Int, u32::from(setting.at.0));
            if let (Some(location), false) = (location, names.is_empty()) {
                lines.push(format!("  {:<28} {}", location.name, location.meaning));
                lines.push(format!("{:>30} {}", "", super::counted(&names)));
            }
        }
    }
    lines
}
