//! What no author decides: rules for all programs, and what the post's own blocks do.

use std::collections::VecDeque;

use fil_diag::Diag;
use fil_nc::decimals;
use fil_nc::dialect::{Dialect, Group};
use fil_nc::events::Events;
use fil_nc::interpret::{Running, has_skipped_blocks};
use fil_nc::motion::{Course, Event, Move, Rate};
use fil_nc::source::Source;
use fil_nc::verify::{
    Allowed, Finding, FindingKind, Programs, Report, Unfollowed, compare_programs,
};

use super::lines::SameLines;
use super::stated::Stated;
use crate::program::Program;

/// What binary fractions may differ by, mm.
const DUST: f64 = 1e-6;

/// Decimals of a position.
const DECIMALS: u8 = 4;

/// Rules that no program may break, whoever made its blocks: the program beside itself.
pub(super) fn rules(program: &Program, nc: (&Source<'_>, &str)) -> Result<Report, String> {
    let commons = program.commons();
    let allowed = Allowed::default();
    let judged = |dialect: &Dialect| {
        let mut reference = Running::new(nc.0, nc.1, dialect);
        let found = &mut Running::new(nc.0, nc.1, dialect);
        let programs = Programs { reference: &mut reference, found, commons, allowed: &allowed };
        compare_programs(programs).map_err(|refused| match refused {
            Unfollowed::Reference(why) | Unfollowed::Found(why) => unfollowed(&why),
        })
    };
    let said = |why: Box<Diag>| unfollowed(&why);
    let dialect = Dialect::new(commons).map_err(said)?;
    let report = judged(&dialect)?;
    if has_skipped_blocks(nc.0, nc.1, &dialect).map_err(said)? {
        return Ok(report.with_blocks_left_out(judged(&dialect.skipping_blocks())?));
    }
    Ok(report)
}

fn unfollowed(why: &Diag) -> String {
    let line = why.spans.first().map_or(0, |place| place.line);
    format!("motions from NC line {line} on, which can't be followed: {}", why.message)
}

/// Blocks of the post that do something else than in the program without scripts, though they
/// have the same words: an author has left a mode that the post should have said again. Where the
/// post has said the mode itself, it follows what an author has set, and means it.
pub(super) fn effects(
    dialect: &Dialect,
    reference: (&Source<'_>, &str),
    nc: (&Source<'_>, &str),
    (same, stated): (&SameLines, &Stated<'_>),
) -> Result<Report, String> {
    let mut wanted = Moves::new(Running::new(reference.0, reference.1, dialect));
    let mut found = Moves::new(Running::new(nc.0, nc.1, dialect));
    let mut report = Report::default();
    // What can't be followed is told with the rules.
    while let Some(made) = found.next() {
        let Some(line) = same.of_program(made.to.line) else { continue };
        let Some(asked) = wanted.at(line) else { continue };
        let Some((kind, message)) = differs(&asked, &made) else { continue };
        if stated.is_meant(group_of(kind), made.to.line) {
            continue;
        }
        report.findings.push(Finding {
            kind,
            cl_line: None,
            nc_line: Some(made.to.line),
            message: format!("the post's block differs from the one without scripts: {message}"),
        });
        if report.findings.len() == Report::LISTED {
            break;
        }
    }
    Ok(report)
}

/// The functions that say what a block is found to do otherwise.
fn group_of(kind: FindingKind) -> Group {
    match kind {
        FindingKind::Units => Group::Units,
        FindingKind::Feed => Group::Feed,
        FindingKind::Position => Group::Positions,
        _ => Group::Motion,
    }
}

/// What a block does otherwise with the same words, of what the post must not leave to others.
fn differs(asked: &Step, made: &Step) -> Option<(FindingKind, String)> {
    let (one, two) = (&asked.to, &made.to);
    let course = |course: Course| match course {
        Course::Rapid => "rapid traverse",
        Course::Feed => "feed",
        Course::Thread => "feed in step with the spindle",
        Course::Machine => "rapid traverse to a point of the machine",
    };
    let feed = |rate: Option<Rate>| match rate {
        Some(Rate::PerMinute(_)) => "feed per minute",
        Some(Rate::PerTurn(_) | Rate::Varying(..)) => "feed per revolution",
        Some(Rate::Inverse(_)) => "a feed in inverse time",
        None => "no feed",
    };
    let unit = |inch: bool| if inch { "inch" } else { "mm" };
    let way = |is_arc: bool| if is_arc { "an arc" } else { "a line" };
    let sides = [
        (FindingKind::FeedForRapid, course(one.course), course(two.course)),
        (FindingKind::Units, unit(one.modes.inch), unit(two.modes.inch)),
        (FindingKind::Arc, way(one.arc.is_some()), way(two.arc.is_some())),
        (FindingKind::Feed, feed(one.rate), feed(two.rate)),
    ];
    if let Some((kind, asked, made)) = sides.into_iter().find(|(_, one, two)| one != two) {
        return Some((kind, format!("{made} in place of {asked}")));
    }
    let frame =
        |of: &Move| (of.modes.frame.fixture, of.modes.frame.moved_zero, of.to.tilt.is_some());
    if frame(one) != frame(two) || two.in_cycle {
        return None;
    }
    let axis = (0..3).find(|axis| {
        let ends = [one, two].map(|of| of.to.linear[*axis]);
        let moves = [asked, made].iter().all(|step| step.moves(*axis));
        moves && (ends[0] - ends[1]).abs() > DUST
    })?;
    let [asked, made] = [one, two].map(|of| decimals::short(of.to.linear[axis], DECIMALS));
    let name = ["X", "Y", "Z"][axis];
    Some((FindingKind::Position, format!("{name} goes to {made} in place of {asked} mm")))
}

/// A motion and where it begins.
#[derive(Clone, Copy)]
struct Step {
    from: Option<[f64; 3]>,
    to: Move,
}

impl Step {
    /// An axis moves, from and to where is known.
    fn moves(&self, axis: usize) -> bool {
        let to = self.to.to.linear[axis];
        self.to.known[axis] && self.from.is_some_and(|from| (from[axis] - to).abs() > DUST)
    }
}

/// The first motion of each line of a program, as long as it goes on line by line.
struct Moves<'e> {
    events: Running<'e>,
    waiting: VecDeque<Event>,
    last: Option<Step>,
    over: bool,
    from: Option<[f64; 3]>,
    line: u32,
}

impl<'e> Moves<'e> {
    fn new(events: Running<'e>) -> Self {
        let waiting = VecDeque::new();
        Moves { events, waiting, last: None, over: false, from: None, line: 0 }
    }

    fn next(&mut self) -> Option<Step> {
        while !self.over {
            match self.waiting.pop_front() {
                Some(Event::Move(found)) => {
                    let from = self.from.replace(found.to.linear);
                    let line = std::mem::replace(&mut self.line, found.line);
                    self.over = found.line < line;
                    if found.line > line {
                        return Some(Step { from, to: found });
                    }
                }
                Some(_) => {}
                None => self.over = !matches!(self.events.more(&mut self.waiting), Ok(true)),
            }
        }
        None
    }

    /// The motion of a line, which may not lie before the last one asked for.
    fn at(&mut self, line: u32) -> Option<Step> {
        while self.last.is_none_or(|last| last.to.line < line) {
            self.last = Some(self.next()?);
        }
        self.last.filter(|last| last.to.line == line)
    }
}

#[cfg(test)]
mod tests {
    use super::super::align::Pair;
    use super::super::made::{Made, Word};
    use super::*;

    /// What the post's own blocks do otherwise in the second program; `same` are lines of both.
    fn findings(reference: &str, nc: &str, same: &[(u32, u32)]) -> Vec<String> {
        findings_with(reference, nc, same, None)
    }

    /// The same where a line of the second program has a function, which an author has spelt or
    /// the post has written.
    fn findings_with(
        reference: &str,
        nc: &str,
        same: &[(u32, u32)],
        function: Option<(u32, &str, bool)>,
    ) -> Vec<String> {
        let cause = fil_post::Cause::default();
        let made = |nc_line| Made { nc_line, cause, place: 0, words: Vec::new() };
        let mut lines = SameLines::default();
        for (one, two) in same {
            lines.record(&[Pair::Same(&made(*one), &made(*two))]);
        }
        let program = Program::builder().generic("fanuc-mill").build().expect("a post");
        let texts = [reference, nc].map(|text| Source::owned(text.as_bytes().to_vec()));
        let [reference, nc] = &texts;
        let dialect = Dialect::new(program.commons()).expect("its control");
        let mut stated = Stated::new(&dialect);
        if let Some((nc_line, text, is_spelt)) = function {
            let word = Word { text: text.to_string(), letter: 'G', stack: 1, is_spelt };
            stated.record(&[Pair::Added(&Made { words: vec![word], ..made(nc_line) })]);
        }
        let both = ((reference, "reference"), (nc, "part.nc"));
        let report = effects(&dialect, both.0, both.1, (&lines, &stated));
        report.expect("both are followed").findings.iter().map(ToString::to_string).collect()
    }

    const PART: &str = "G90 G94 G17 G21\nG0 X0. Y0. Z50.\nG1 X10. F100.\nX20.\nM30\n";

    #[test]
    fn increments_that_are_left_in_force_are_a_fault_of_the_post() {
        let nc = PART.replace("G1 X10.", "G91\nG1 X10.");
        let same = [(1, 1), (2, 2), (3, 4), (4, 5), (5, 6)];
        let found = findings(PART, &nc, &same);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(
            found[0].starts_with("NC line 5: ")
                && found[0].ends_with("X goes to 30 in place of 20 mm"),
            "{found:?}"
        );
    }

    #[test]
    fn a_feed_a_turn_that_is_left_in_force_is_a_fault_of_the_post() {
        let nc = PART.replace("G1 X10.", "G95\nG1 X10.");
        let same = [(1, 1), (2, 2), (3, 4), (4, 5), (5, 6)];
        let found = findings(PART, &nc, &same);
        assert!(found[0].contains("feed per revolution in place of feed per minute"), "{found:?}");
    }

    #[test]
    fn a_mode_that_the_post_has_written_itself_is_meant() {
        let nc = PART.replace("G1 X10.", "G95\nG1 X10.");
        let same = [(1, 1), (2, 2), (3, 4), (4, 5), (5, 6)];
        let found = |is_spelt| findings_with(PART, &nc, &same, Some((3, "G95", is_spelt)));
        assert_eq!(found(false), [] as [String; 0]);
        assert_eq!(found(true).len(), 2);
        // What the post has written before holds no longer.
        let before = findings_with(PART, &nc, &same, Some((1, "G1", false)));
        assert_eq!(before.len(), 2, "{before:?}");
    }

    #[test]
    fn another_height_of_an_author_is_none() {
        let nc = PART.replace("Z50.", "Z52.");
        assert_eq!(findings(PART, &nc, &[(1, 1), (3, 3), (4, 4), (5, 5)]), [] as [String; 0]);
    }
}
