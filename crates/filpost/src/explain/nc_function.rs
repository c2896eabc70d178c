//! What a G or M code means, by the table of functions and the settings of the ready posts.

use fil_machine::functions::{self, Dialect, FUNCTIONS, Function, Space};
use fil_machine::locations::{CONTROL_FAMILY, ControlFamily, Location};
use fil_machine::{Commons, FunctionCode, Kind};

use crate::Program;
use crate::ready::READY;

/// The controls whose standard numbers differ.
const DIALECTS: [(Dialect, &str); 3] = [
    (Dialect::Mill, "mills (Fanuc and its like; of Heidenhain the M codes)"),
    (Dialect::LatheA, "lathes (G code system A)"),
    (Dialect::Sinumerik, "SINUMERIK"),
];

/// Most ready posts that are named; of more their number is given.
const MOST_NAMED: usize = 6;

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

/// What controls take the code for: `A hole on mills with G codes and on lathes.`
fn standard(space: Space, code: FunctionCode) -> Vec<String> {
    let mut meanings: Vec<(&str, Vec<&str>)> = Vec::new();
    for (dialect, controls) in DIALECTS {
        let Some(row) = functions::standard(dialect, space, code) else { continue };
        match meanings.iter_mut().find(|(title, _)| *title == row.title) {
            Some((_, all)) => all.push(controls),
            None => meanings.push((row.title, vec![controls])),
        }
    }
    let line = |(title, controls): (&str, Vec<&str>)| {
        format!("Standard code for {title}, on {}.", controls.join(", "))
    };
    meanings.into_iter().map(line).collect()
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
                lines.push(format!("{:>30} {}", "", counted(&names)));
            }
        }
    }
    lines
}

fn counted(names: &[&str]) -> String {
    if names.len() <= MOST_NAMED {
        names.join(", ")
    } else {
        format!("{} of {} ready posts", names.len(), READY.len())
    }
}
