//! The texts of a listing: positions, and the totals at its end.

use fil_machine::locations::FeedListUnits;
use fil_nc::decimals;

use super::Row;
use crate::event::RunEnd;
use crate::report::Extents;
use crate::tally::{Motion, Totals};

/// Letters of a number in its column.
const COLUMN: usize = 7;

/// Decimals of lengths and feeds.
const LENGTH: u8 = 3;

/// Characters of a paper tape on an inch of it.
const CHARACTERS_AN_INCH: f64 = 10.0;
const METERS_IN_AN_INCH: f64 = 0.0254;

/// A number at the right of its column, and a blank.
pub(super) fn right(out: &mut Vec<u8>, number: u32) {
    let mut digits = itoa::Buffer::new();
    let digits = digits.format(number);
    out.resize(out.len() + COLUMN.saturating_sub(digits.len()), b' ');
    out.extend_from_slice(digits.as_bytes());
    out.push(b' ');
}

/// Tells where a motion ends, its feed and its time; of a hole the way to it, which is rapid, and
/// the way down at feed.
pub(super) fn position(out: &mut Vec<u8>, motion: &Motion, feeds: FeedListUnits) {
    for (name, value) in ["                   at X ", "  Y ", "  Z "].into_iter().zip(motion.point)
    {
        tell(out, name, value, LENGTH);
    }
    match (motion.rapid, motion.feed) {
        (true, _) => out.extend_from_slice(b"  rapid"),
        (false, Some(feed)) => {
            let (feed, is_of_turn) = listed_feed(feed, motion, feeds);
            tell(out, "  feed ", feed, if is_of_turn { LENGTH + 1 } else { LENGTH });
            out.extend_from_slice(if is_of_turn { b" a revolution" } else { b"" });
        }
        (false, None) => out.extend_from_slice(b"  no feed"),
    }
    tell(out, "  way ", motion.length, LENGTH);
    if let Some(hole) = motion.hole {
        tell(out, "  down ", hole.down, LENGTH);
    }
    match motion.seconds {
        Some(seconds) => {
            tell(out, "  ", seconds, 2);
            out.extend_from_slice(b" s");
        }
        None => out.extend_from_slice(b"  time unknown"),
    }
}

fn tell(out: &mut Vec<u8>, before: &str, value: f64, decimals: u8) {
    out.extend_from_slice(before.as_bytes());
    decimals::push_short(out, value, decimals);
}

/// A feed as it was asked for, or as the machine lists feeds where the turns of the spindle
/// are known; true for one a revolution.
fn listed_feed(feed: f64, motion: &Motion, feeds: FeedListUnits) -> (f64, bool) {
    let turns = motion.turns.filter(|turns| *turns > 0.0);
    match (motion.per_revolution, feeds, turns) {
        (true, FeedListUnits::PerMinute, Some(turns)) => (feed * turns, false),
        (false, FeedListUnits::PerRevolution, Some(turns)) => (feed / turns, true),
        (is_of_turn, ..) => (feed, is_of_turn),
    }
}

/// In the place of the extents.
const BESIDE: &str = "Extents left out, and times and lengths are those of the CL points alone: \
                      POSTN or REPEAT wrote words of their own";

/// The totals of a run, those of a tool as rows of their own kind.
pub(super) fn totals(end: &RunEnd<'_>) -> Vec<(Row, String)> {
    let total = &end.tally.total;
    let beside = end.report.may_leave_extents;
    let unit = end.report.unit.map_or_else(String::new, |(unit, _)| format!(" {unit}"));
    let meters = end.bytes as f64 / CHARACTERS_AN_INCH * METERS_IN_AN_INCH;
    let mut lines = vec![
        String::new(),
        format!(
            "Program: {} blocks, {} characters, tape length {} m",
            end.blocks,
            end.bytes,
            decimals::short(meters, 2)
        ),
        format!("Time:    {} in all", clock(total.seconds())),
    ];
    lines.extend(times(total, &unit, "         "));
    match &total.extents {
        Some(_) if beside => lines.push(BESIDE.to_string()),
        Some(extents) => lines.push(format!("CL points: {}{unit}", span(extents))),
        None => {}
    }
    let mut rows: Vec<(Row, String)> = lines.into_iter().map(|line| (Row::Total, line)).collect();
    for tool in &end.tally.tools {
        let mut lines = Vec::new();
        let name = tool.tool.map_or_else(|| "no tool".to_string(), |tool| format!("T{tool}"));
        let diameter =
            tool.diameter.map_or_else(String::new, |d| format!(", diameter {}{unit}", length(d)));
        lines.push(format!("Tool:    {name}{diameter}, {}", clock(tool.totals.seconds())));
        lines.extend(times(&tool.totals, &unit, "         "));
        if let Some(extents) = tool.totals.extents.as_ref().filter(|_| !beside) {
            lines.push(format!("         {}{unit}", span(extents)));
        }
        rows.extend(lines.into_iter().map(|line| (Row::Tool, line)));
    }
    rows.push((Row::Total, format!("Warnings: {}", end.report.warnings.len())));
    rows
}

fn times(totals: &Totals, unit: &str, before: &str) -> Vec<String> {
    let mut lines = vec![format!(
        "{before}feed {} over {}{unit}, rapid {} over {}{unit}, tool changes and dwells {}",
        clock(totals.cutting_seconds),
        length(totals.cutting_length),
        clock(totals.rapid_seconds),
        length(totals.rapid_length),
        clock(totals.other_seconds),
    )];
    if totals.untimed > 0 {
        lines.push(format!("{before}the time of {} motions is not known", totals.untimed));
    }
    lines
}

fn span(extents: &Extents) -> String {
    let axes = ["X", "Y", "Z"].iter().enumerate().map(|(axis, name)| {
        format!("{name} {} to {}", length(extents.min[axis]), length(extents.max[axis]))
    });
    axes.collect::<Vec<_>>().join(", ")
}

fn length(value: f64) -> String {
    decimals::short(value, LENGTH)
}

/// Hours, minutes and seconds.
fn clock(seconds: f64) -> String {
    let whole = seconds.round().min(1e9) as u64;
    format!("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
}

#[cfg(test)]
mod tests {
    use super::clock;

    #[test]
    fn times_are_hours_minutes_and_seconds() {
        let shown: Vec<String> = [0.0, 59.6, 3661.0].map(clock).to_vec();
        assert_eq!(shown, ["0:00:00", "0:01:00", "1:01:01"]);
    }
}
