//! Settings of the machine, changed one at a time over many pairs of CL file and
//! machine.

use filpost::Commons;
use filpost::commons::EMPTY;
use filpost::locations::{Location, TABLE, ValueUnit};

use crate::five_axes::numbers::Random;
use crate::posting::{Posted, Prepared};

use super::corpus::Part;

/// A setting with a value to try, as `key=value`, and the number of the value where it
/// is known.
#[derive(Clone, Debug)]
pub struct Trial {
    /// What goes to the builder.
    pub text: String,
    number: Option<f64>,
}

/// The values that are tried for a setting: all choices, or some that are unusual.
pub fn trials(row: &Location) -> Vec<Trial> {
    let number = |value: &str| if value == "none" { Some(EMPTY) } else { value.parse().ok() };
    let trial =
        |value: &str| Trial { text: format!("{}={value}", row.name), number: number(value) };
    let choices = row.choice_list();
    if !choices.is_empty() {
        return choices.iter().map(|(value, _)| trial(&value.to_string())).collect();
    }
    let values: &[&str] = match row.unit {
        ValueUnit::Letter => &["W", "none"],
        ValueUnit::Char => &["%", "<"],
        ValueUnit::Code => &["61", "none"],
        ValueUnit::Count => &["3", "7"],
        ValueUnit::Plain => &["16705", "16962"],
        ValueUnit::Degrees => &["12.5", "90"],
        ValueUnit::Format => &["3341", "4313"],
        ValueUnit::Rpm => &["50", "5000"],
        _ => &["0.25", "12.5"],
    };
    values.iter().copied().map(trial).collect()
}

/// Fewer settings than `most`, drawn from the groups but for those left out; every other one of
/// them, about, begins with one of `focus`.
pub fn drawn(
    random: &mut Random,
    most: usize,
    (groups, left_out): (&[&str], &[&str]),
    focus: &[&str],
) -> Vec<String> {
    let rows: Vec<&Location> = TABLE
        .iter()
        .filter(|row| row.used && !left_out.contains(&row.name))
        .filter(|row| groups.iter().any(|group| row.name.starts_with(&format!("{group}."))))
        .collect();
    let of_focus = |row: &&&Location| focus.iter().any(|start| row.name.starts_with(start));
    let focused: Vec<&Location> = rows.iter().filter(of_focus).copied().collect();
    (0..random.below(most))
        .map(|_| {
            let rows = if random.happens(0.5) { &focused } else { &rows };
            let tried = trials(rows[random.below(rows.len())]);
            tried[random.below(tried.len())].text.clone()
        })
        .collect()
}

/// Settings that act on the listing alone.
const OF_THE_LISTING: [&str; 11] = [
    "feed.list_units",
    "list.verification",
    "list.input",
    "list.suppress_warnings",
    "list.pages",
    "list.lines_per_page",
    "list.tape_image",
    "list.skip",
    "tool.list_times",
    "tool.change_time",
    "rapid.rate",
];

/// How a changed setting showed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    /// The machine is refused when it is loaded.
    AtLoad,
    /// The program, or what is said, is another than with this value; or the CL file is
    /// refused.
    InTheRun(f64),
}

/// A pair of CL file and machine with what comes of it.
pub struct Pair {
    part: Part,
    commons: Commons,
    outcome: Posted,
}

impl Pair {
    /// The pair; `None` when the post refuses it.
    pub fn new(part: Part) -> Option<Self> {
        let machine = part.machine(None).ok()?;
        let outcome = machine.post(&part.cl).ok()?;
        Some(Pair { part, commons: machine.commons().clone(), outcome })
    }

    /// How the pair shows a changed setting, if it does; a value that the machine has
    /// already is no change.
    fn shows(&self, row: &Location, trial: &Trial) -> Option<Seen> {
        let value = self.commons.get(row.kind, u32::from(row.number)).ok()?;
        if trial.number == Some(value) {
            return None;
        }
        let Ok(machine) = self.part.machine(Some(&trial.text)) else { return Some(Seen::AtLoad) };
        let outcome = machine.post(&self.part.cl);
        let differs = outcome.ok().as_ref() != Some(&self.outcome)
            || OF_THE_LISTING.contains(&row.name) && self.lists_otherwise(&machine);
        differs.then_some(Seen::InTheRun(value))
    }

    /// The listing of another machine differs.
    fn lists_otherwise(&self, machine: &Prepared) -> bool {
        let Ok(own) = self.part.machine(None) else { return false };
        own.listing(&self.part.cl) != machine.listing(&self.part.cl)
    }
}

/// How some pair shows a changed setting: in a run if one does. The pair that does
/// moves to the front, as it may show the next setting too.
fn seen(pairs: &mut [Pair], row: &Location, trial: &Trial) -> Option<Seen> {
    let mut best = None;
    for at in 0..pairs.len() {
        match pairs[at].shows(row, trial) {
            Some(seen @ Seen::InTheRun(_)) => {
                pairs[..=at].rotate_right(1);
                return Some(seen);
            }
            Some(Seen::AtLoad) => best = Some(Seen::AtLoad),
            None => {}
        }
    }
    best
}

/// The values of a setting that no pair shows, and the setting itself when no run
/// does. A value is shown too by a pair that has it and differs with another.
pub fn unseen(pairs: &mut [Pair], row: &Location) -> Vec<String> {
    let mut shown = Vec::new();
    let mut quiet = Vec::new();
    for trial in trials(row) {
        match seen(pairs, row, &trial) {
            Some(Seen::InTheRun(value)) => shown.extend([Some(value), trial.number]),
            Some(Seen::AtLoad) => {}
            None => quiet.push(trial),
        }
    }
    quiet.retain(|trial| !shown.contains(&trial.number));
    let in_no_run = shown.is_empty().then(|| format!("{} in any run", row.name));
    quiet.into_iter().map(|trial| trial.text).chain(in_no_run).collect()
}
