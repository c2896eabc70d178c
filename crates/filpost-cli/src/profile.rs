//! What `filpost post --profile` tells.

use filpost::Program;
use filpost::profile::{Profile, Row, time};

use crate::output;

/// Rows of a table that are shown.
const MOST: usize = 20;

/// Shows the tables on standard error.
pub fn tell(profile: &Profile, program: &Program) {
    output::say(&format!("profile: {} in all", time(profile.whole())));
    table("CL word", &profile.words(program));
    table("section or macro", &profile.sections(program));
    table("line", &profile.lines(program));
}

fn table(what: &str, rows: &[Row]) {
    if rows.is_empty() {
        return;
    }
    output::say(&format!("{:>11} {:>11} {:>9}  {what}", "time", "own time", "times"));
    for row in rows.iter().take(MOST) {
        let (total, own) = (time(row.total), time(row.own));
        output::say(&format!("{total:>11} {own:>11} {:>9}  {}", row.count, row.name));
    }
    if let Some(more) = rows.len().checked_sub(MOST).filter(|more| *more > 0) {
        output::say(&format!("and {more} more"));
    }
}
