//! Compares what two programs do, event by event.
//!
//! For a post with FIL sections the CL file alone does not say what the program
//! must do. Then the reference is a program that the same post makes again from the
//! same CL file, read by the same interpreter. A fault of the post is in both, so
//! this finds what was changed in a program, not what was wrong with it from the
//! start.

use std::borrow::Cow;

use fil_diag::Diag;

use super::report::{Finding, FindingKind, Report, Unverified};
use super::rules::Rules;
use super::say::{sense, short, way};
use crate::diff;
use crate::motion::{Course, Event, Modes, Move, Rate};

/// How far to look for the place where two programs agree again.
const LOOK_AHEAD: usize = 16;

/// What binary fractions may differ by.
const DUST: f64 = 1e-7;

/// Differences of a program from a reference; `tolerance` in mm and degrees.
pub fn compare_programs(wanted: &[Event], found: &[Event], tolerance: Option<f64>) -> Report {
    let [motions, made] = [wanted, found].map(without_left_to_control);
    let tolerance = tolerance.unwrap_or(0.0) + DUST;
    let report = Report::default();
    let mut pair = Pair { wanted: &motions, found: &made, tolerance, report };
    pair.all();
    Rules::check(found, &mut pair.report);
    pair.report
}

/// The events without those of modes that a program leaves to the control.
fn without_left_to_control(events: &[Event]) -> Cow<'_, [Event]> {
    let is_left = |event: &Event| matches!(event, Event::LeftToControl { .. });
    if !events.iter().any(is_left) {
        return Cow::Borrowed(events);
    }
    events.iter().filter(|event| !is_left(event)).copied().collect()
}

/// Compares two programs word by word, for one that the interpreter refuses, so that
/// its motions are not known; line by line when it is not made of such words.
///
/// # Errors
/// A line of the program that is no block of words.
pub fn compare_words(
    wanted: &[u8],
    (found, name): (&[u8], &str),
    refused: &Diag,
    tolerance: Option<f64>,
) -> Result<Report, Box<Diag>> {
    let ignore = diff::Ignore { numbers: true, comments: true, ..diff::Ignore::default() };
    let tolerance = tolerance.unwrap_or(0.0) + DUST;
    let options = diff::Options { tolerance, ignore, ..diff::Options::default() };
    let mut report = Report::default();
    let compared = match diff::read(wanted, "the second run", &options) {
        Ok(wanted) => {
            let found = diff::read(found, name, &options)?;
            for difference in diff::compare(&wanted, &found, &options)?.differences {
                let message = diff::sentence(&difference, &wanted, &found);
                report.find(block(difference.lines[1], message));
            }
            "its blocks were compared word by word"
        }
        Err(_) => {
            compare_lines(wanted, found, &mut report);
            "its lines were compared as text"
        }
    };
    let line = refused.spans.first().map_or(0, |place| place.line);
    let why = &refused.message;
    let what = format!("the program from line {line} on can't be followed ({why}); {compared}");
    report.unverified.push(Unverified { cl_line: None, what });
    Ok(report)
}

fn compare_lines(wanted: &[u8], found: &[u8], report: &mut Report) {
    let lines = |text: &[u8]| -> Vec<String> {
        let text = String::from_utf8_lossy(text);
        text.lines().map(|line| line.trim_end().to_string()).collect()
    };
    let (wanted, found) = (lines(wanted), lines(found));
    for number in 0..wanted.len().max(found.len()) {
        let message = match (wanted.get(number), found.get(number)) {
            (Some(wanted), Some(found)) if wanted == found => continue,
            (Some(wanted), Some(_)) => format!("it should be `{wanted}`"),
            (Some(wanted), None) => format!("`{wanted}` is missing"),
            (None, _) => "nothing should be here".to_string(),
        };
        report.find(block(Some(number as u32 + 1), message));
    }
}

fn block(nc_line: Option<u32>, message: String) -> Finding {
    Finding { kind: FindingKind::Block, cl_line: None, nc_line, message }
}

struct Pair<'a> {
    wanted: &'a [Event],
    found: &'a [Event],
    tolerance: f64,
    report: Report,
}

impl Pair<'_> {
    fn all(&mut self) {
        let motions = self.wanted.iter().filter(|event| matches!(event, Event::Move(_)));
        self.report.compared = motions.count() as u64;
        let (mut w, mut f) = (0, 0);
        while let (Some(wanted), Some(found)) = (self.wanted.get(w), self.found.get(f)) {
            if self.alike(wanted, found) {
                self.details(wanted, found);
                (w, f) = (w + 1, f + 1);
                continue;
            }
            let later = |events: &[Event], from: usize, is: &dyn Fn(&Event) -> bool| {
                events[from..].iter().take(LOOK_AHEAD).position(is)
            };
            let missing = later(self.wanted, w, &|wanted| self.alike(wanted, found));
            let extra = later(self.found, f, &|found| self.alike(wanted, found));
            match (missing, extra) {
                (Some(missing), None) => {
                    (w..w + missing).for_each(|at| self.missing(at));
                    w += missing;
                }
                (None, Some(extra)) => {
                    (f..f + extra).for_each(|at| self.extra(at));
                    f += extra;
                }
                (Some(missing), Some(extra)) if missing < extra => {
                    (w..w + missing).for_each(|at| self.missing(at));
                    w += missing;
                }
                (Some(_), Some(extra)) => {
                    (f..f + extra).for_each(|at| self.extra(at));
                    f += extra;
                }
                (None, None) => {
                    self.other(wanted, found);
                    (w, f) = (w + 1, f + 1);
                }
            }
        }
        (w..self.wanted.len()).for_each(|at| self.missing(at));
        (f..self.found.len()).for_each(|at| self.extra(at));
    }

    fn near(&self, a: f64, b: f64) -> bool {
        (a - b).abs() <= self.tolerance
    }

    /// Both are of one kind and end at one place.
    fn alike(&self, wanted: &Event, found: &Event) -> bool {
        match (wanted, found) {
            (Event::Move(a), Event::Move(b)) => {
                a.course == b.course && a.arc.is_some() == b.arc.is_some() && self.same_end(a, b)
            }
            (Event::ToolChange { tool: a, .. }, Event::ToolChange { tool: b, .. }) => a == b,
            (Event::Auxiliary { code: a, .. }, Event::Auxiliary { code: b, .. }) => a == b,
            (Event::Dwell { .. }, Event::Dwell { .. }) | (Event::End { .. }, Event::End { .. }) => {
                true
            }
            _ => false,
        }
    }

    fn same_end(&self, a: &Move, b: &Move) -> bool {
        (0..3).all(|n| self.near(a.to.linear[n], b.to.linear[n]))
            && (0..2).all(|n| self.near(a.to.rotary[n], b.to.rotary[n]))
            && a.to.tip_control == b.to.tip_control
            && a.known == b.known
    }

    /// What two events of one kind and end can still differ in.
    fn details(&mut self, wanted: &Event, found: &Event) {
        match (wanted, found) {
            (Event::Move(a), Event::Move(b)) => {
                self.report.matched += 1;
                let off = (0..3).map(|n| (a.to.linear[n] - b.to.linear[n]).powi(2)).sum::<f64>();
                self.report.position.add(off.sqrt(), b.line);
                let turned = (0..2).map(|n| (a.to.rotary[n] - b.to.rotary[n]).abs());
                self.report.axis.add(turned.fold(0.0, f64::max), b.line);
                self.rates(a, b);
                self.arcs(a, b);
                self.modes(b.line, &a.modes, &b.modes);
            }
            (Event::ToolChange { modes: a, .. }, Event::ToolChange { line, modes: b, .. }) => {
                self.modes(*line, a, b);
            }
            (Event::End { code: must, modes: a, .. }, Event::End { line, code, modes: b }) => {
                self.modes(*line, a, b);
                if code != must {
                    let name = |code: &Option<u32>| code.map_or("none".into(), |m| format!("M{m}"));
                    let (code, must): (String, String) = (name(code), name(must));
                    let message = format!("the program ends with {code}, it should be {must}");
                    self.find(FindingKind::End, *line, message);
                }
            }
            (
                Event::Dwell { seconds: a, turns: turns_a, .. },
                Event::Dwell { line, seconds: b, turns: turns_b },
            ) => {
                let (a, b) = (&a.or(*turns_a), &b.or(*turns_b));
                let same = turns_a.is_some() == turns_b.is_some()
                    && match (a, b) {
                        (Some(a), Some(b)) => self.near(*a, *b),
                        (a, b) => a == b,
                    };
                if !same {
                    let message = format!("dwell of {}, it should be {}", dwell(*b), dwell(*a));
                    self.find(FindingKind::Dwell, *line, message);
                }
            }
            _ => {}
        }
    }

    fn rates(&mut self, a: &Move, b: &Move) {
        let same = match (a.rate, b.rate) {
            (Some(Rate::PerMinute(a)), Some(Rate::PerMinute(b)))
            | (Some(Rate::PerTurn(a)), Some(Rate::PerTurn(b)))
            | (Some(Rate::Inverse(a)), Some(Rate::Inverse(b))) => (a - b).abs() <= DUST,
            (a, b) => a.is_none() && b.is_none(),
        };
        if !same {
            let message = format!("feed {}, it should be {}", rate(b.rate), rate(a.rate));
            self.find(FindingKind::Feed, b.line, message);
        }
    }

    fn arcs(&mut self, a: &Move, b: &Move) {
        let (Some(wanted), Some(found)) = (&a.arc, &b.arc) else { return };
        let message = match () {
            () if wanted.normal != found.normal => "the arc lies in another plane".to_string(),
            () if wanted.ccw != found.ccw => {
                format!("{}, it should be {}", sense(found), sense(wanted))
            }
            () if !(0..3).all(|n| self.near(wanted.center[n], found.center[n])) => {
                "the center of the arc is elsewhere".to_string()
            }
            () if !self.near(wanted.angle, found.angle) => {
                format!(
                    "the arc sweeps {} degrees, it should be {}",
                    short(found.angle),
                    short(wanted.angle)
                )
            }
            () => return,
        };
        self.find(FindingKind::Arc, b.line, message);
    }

    fn modes(&mut self, line: u32, a: &Modes, b: &Modes) {
        let checks = [
            (
                a.tool != b.tool,
                FindingKind::Tool,
                format!("tool {} moves, it should be tool {}", b.tool, a.tool),
            ),
            (
                a.length_offset != b.length_offset,
                FindingKind::Tool,
                "another length offset is on".to_string(),
            ),
            (
                a.tip_control != b.tip_control,
                FindingKind::Tool,
                "tool-tip control is not as it should be".to_string(),
            ),
            (
                (a.compensation, a.compensation_offset) != (b.compensation, b.compensation_offset),
                FindingKind::Compensation,
                "cutter compensation is not as it should be".to_string(),
            ),
            (
                a.spindle != b.spindle,
                FindingKind::Spindle,
                format!("the spindle is {:?}, it should be {:?}", b.spindle, a.spindle)
                    .to_lowercase(),
            ),
            (a.speed != b.speed, FindingKind::Speed, "the spindle has another speed".to_string()),
            (
                a.speed_limit != b.speed_limit,
                FindingKind::Speed,
                "the spindle speed has another limit".to_string(),
            ),
            (
                a.coolant != b.coolant,
                FindingKind::Coolant,
                "the coolant is not as it should be".to_string(),
            ),
            (a.fixture != b.fixture, FindingKind::Fixture, "another work offset is on".to_string()),
        ];
        for (differs, kind, message) in checks {
            let said = self.report.findings.iter().any(|f| f.kind == kind && f.message == message);
            if differs && !said {
                self.find(kind, line, message);
            }
        }
    }

    fn other(&mut self, wanted: &Event, found: &Event) {
        let kind = match (wanted, found) {
            (Event::Move(a), Event::Move(b)) => match (a.course, b.course) {
                (Course::Feed, Course::Rapid) => FindingKind::RapidForFeed,
                (Course::Rapid, Course::Feed) => FindingKind::FeedForRapid,
                _ => FindingKind::Position,
            },
            (Event::ToolChange { .. }, _) | (_, Event::ToolChange { .. }) => FindingKind::Tool,
            (_, Event::Auxiliary { .. }) => FindingKind::Auxiliary,
            _ => FindingKind::Missing,
        };
        let message = format!("{}, it should be {}", spell(found), spell(wanted));
        self.find(kind, found.line(), message);
    }

    fn missing(&mut self, at: usize) {
        let message = format!("no {}", spell(&self.wanted[at]));
        self.report.find(Finding {
            kind: FindingKind::Missing,
            cl_line: None,
            nc_line: None,
            message,
        });
    }

    fn extra(&mut self, at: usize) {
        let message = format!("no {} should be here", spell(&self.found[at]));
        self.find(FindingKind::Extra, self.found[at].line(), message);
    }

    fn find(&mut self, kind: FindingKind, line: u32, message: String) {
        self.report.find(Finding { kind, cl_line: None, nc_line: Some(line), message });
    }
}

fn spell(event: &Event) -> String {
    match event {
        Event::Move(found) => {
            let [x, y, z] = found.to.linear.map(short);
            let [primary, secondary] = found.to.rotary.map(short);
            let turned = if found.to.rotary == [0.0; 2] {
                String::new()
            } else {
                format!(", rotary axes at {primary} and {secondary}")
            };
            format!("{} to X{x} Y{y} Z{z}{turned}", way(found))
        }
        Event::ToolChange { tool, .. } => format!("change to tool {tool}"),
        Event::Dwell { seconds, .. } => format!("dwell of {}", dwell(*seconds)),
        Event::Auxiliary { code, .. } => format!("M{code}"),
        Event::LeftToControl { mode, .. } => mode.name().to_string(),
        Event::End { .. } => "end of the program".to_string(),
    }
}

fn dwell(seconds: Option<f64>) -> String {
    seconds.map_or("turns of the spindle".to_string(), |seconds| format!("{} s", short(seconds)))
}

fn rate(rate: Option<Rate>) -> String {
    match rate {
        Some(Rate::PerMinute(rate)) => format!("{} mm/min", short(rate)),
        Some(Rate::PerTurn(rate)) => format!("{} mm a turn", short(rate)),
        Some(Rate::Inverse(rate)) => format!("{} blocks a minute", short(rate)),
        None => "none".to_string(),
    }
}
