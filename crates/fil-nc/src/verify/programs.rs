//! Compares what two programs do, event by event.
//!
//! For a post with FIL sections the CL file alone does not say what the program
//! must do. Then the reference is a program that the same post makes again from the
//! same CL file, read by the same interpreter. A fault of the post is in both, so
//! this finds what was changed in a program, not what was wrong with it from the
//! start.

use std::io;

use fil_diag::Diag;
use fil_machine::Commons;

use super::Allowed;
use super::between::Blocks;
use super::event_filter::{EventFilter, Watcher};
use super::report::{Finding, FindingKind, Report, Unverified};
use super::rules::Rules;
use super::say::{sense, short, spell_rate, way};
use super::settings::Settings;
use super::window::Window;
use crate::diff;
use crate::events::Events;
use crate::motion::{Course, Event, Modes, Move, Rate};
use crate::source::{Lines, Source, unreadable};

/// How far to look for the place where two programs agree again.
const LOOK_AHEAD: usize = 16;

/// What binary fractions may differ by.
const DUST: f64 = 1e-7;

/// Two programs that should do the same on a machine.
pub struct Programs<'a> {
    /// What must be done.
    pub reference: &'a mut dyn Events,
    /// What is done.
    pub found: &'a mut dyn Events,
    /// The machine.
    pub commons: &'a Commons,
    /// What the second may be off by.
    pub allowed: &'a Allowed,
}

/// A program that can't be followed, so that nothing was compared.
#[derive(Debug)]
pub enum Unfollowed {
    /// What must be done.
    Reference(Box<Diag>),
    /// What is done, or its machine.
    Found(Box<Diag>),
}

/// Differences of a program from a reference.
///
/// # Errors
/// One of the two can't be followed; the reference where both can't.
pub fn compare_programs(programs: Programs<'_>) -> Result<Report, Unfollowed> {
    let Programs { reference, found, commons, allowed } = programs;
    let blocks = Blocks::new(commons, allowed.between).map_err(Unfollowed::Found)?;
    let settings = Settings::new(commons, allowed.tolerance).map_err(Unfollowed::Found)?;
    let rules = Rules::new(&settings);
    let free = settings.dialect.allowed_functions();
    let count = Count { motions: 0, free: &free };
    let looks = Looks { rules, blocks, free: &free };
    let mut pair = Pair {
        wanted: Window::new(EventFilter::new(reference, count)),
        found: Window::new(EventFilter::new(found, looks)),
        tolerance: allowed.tolerance.unwrap_or(0.0) + DUST,
        report: Report::default(),
    };
    pair.all();
    let Pair { wanted, found, mut report, .. } = pair;
    report.compared = wanted.finish().map_err(Unfollowed::Reference)?.into_watcher().motions;
    let Looks { rules, blocks, .. } = found.finish().map_err(Unfollowed::Found)?.into_watcher();
    report.append(rules.findings);
    report.between = blocks.report.between;
    report.append(blocks.report);
    Ok(report)
}

/// Counts the motions of a reference.
struct Count<'s> {
    motions: u64,
    /// Functions that may be there or not.
    free: &'s [u32],
}

/// An event that is compared with one of the other program.
fn is_compared(event: &Event, free: &[u32]) -> bool {
    !event.stands_alone() && !matches!(event, Event::Auxiliary { code, .. } if free.contains(code))
}

impl Watcher for Count<'_> {
    fn sees(&mut self, event: &Event) -> bool {
        self.motions += u64::from(matches!(event, Event::Move(_)));
        is_compared(event, self.free)
    }
}

/// What is looked at in a program whatever the reference does.
struct Looks<'s> {
    rules: Rules,
    blocks: Blocks,
    free: &'s [u32],
}

impl Watcher for Looks<'_> {
    fn sees(&mut self, event: &Event) -> bool {
        self.rules.look(event);
        if let Event::Move(found) = event {
            self.blocks.look(found);
        }
        is_compared(event, self.free)
    }
}

/// Compares two programs word by word, for one that the interpreter refuses, so that
/// its motions are not known; line by line when it is not made of such words.
///
/// # Errors
/// A line of the program that is no block of words; E0915 for a file that can't be read.
pub fn compare_words(
    reference: &Source<'_>,
    (found, name): (&Source<'_>, &str),
    refused: &Diag,
    tolerance: Option<f64>,
) -> Result<Report, Box<Diag>> {
    let ignore = diff::Ignore { numbers: true, comments: true, ..diff::Ignore::default() };
    let tolerance = tolerance.unwrap_or(0.0) + DUST;
    let options = diff::Options { tolerance, ignore, ..diff::Options::default() };
    let mut report = Report::default();
    let cant = |error: io::Error| unreadable(name, &error);
    let kept = reference.again().map_err(cant)?;
    let compared = match diff::read_source(kept, "the second run", &options) {
        Ok(reference) => {
            let found = diff::read_source(found.again().map_err(cant)?, name, &options)?;
            for difference in diff::compare(&reference, &found, &options)?.differences {
                let message = diff::sentence(&difference, &reference, &found);
                report.find(block(difference.lines[1], message));
            }
            "its blocks were compared word by word"
        }
        Err(_) => {
            compare_lines(reference, found, &mut report).map_err(cant)?;
            "its lines were compared as text"
        }
    };
    let line = refused.spans.first().map_or(0, |place| place.line);
    let why = &refused.message;
    let what = format!("the program from line {line} on can't be followed ({why}); {compared}");
    report.leave_open(Unverified { cl_line: None, what });
    Ok(report)
}

fn compare_lines(
    reference: &Source<'_>,
    found: &Source<'_>,
    report: &mut Report,
) -> io::Result<()> {
    let [mut reference, mut found] = [reference, found].map(|source| Lines::from(source, 0));
    let text = |line: &[u8]| String::from_utf8_lossy(line.trim_ascii_end()).into_owned();
    for number in 1.. {
        let message = match (reference.next_full_line()?, found.next_full_line()?) {
            (Some(wanted), Some(found)) if wanted.trim_ascii_end() == found.trim_ascii_end() => {
                continue;
            }
            (Some(wanted), Some(_)) => format!("it should be `{}`", text(wanted)),
            (Some(wanted), None) => format!("`{}` is missing", text(wanted)),
            (None, Some(_)) => "nothing should be here".to_string(),
            (None, None) => break,
        };
        report.find(block(Some(number), message));
    }
    Ok(())
}

fn block(nc_line: Option<u32>, message: String) -> Finding {
    Finding { kind: FindingKind::Block, cl_line: None, nc_line, message }
}

struct Pair<'a> {
    wanted: Window<EventFilter<'a, Count<'a>>>,
    found: Window<EventFilter<'a, Looks<'a>>>,
    tolerance: f64,
    report: Report,
}

impl Pair<'_> {
    fn all(&mut self) {
        let (mut w, mut f) = (0, 0);
        loop {
            self.wanted.forget(w);
            self.found.forget(f);
            match (self.wanted.get(w), self.found.get(f)) {
                (Some(wanted), Some(found)) => {
                    let (missing, extra) = self.step((w, &wanted), (f, &found));
                    (w, f) = (w + missing, f + extra);
                }
                (Some(wanted), None) => {
                    self.missing(&wanted);
                    w += 1;
                }
                (None, Some(found)) => {
                    self.extra(&found);
                    f += 1;
                }
                (None, None) => return,
            }
        }
    }

    /// Compares two events, or passes over some of one program up to where both agree
    /// again. Gives how many events of each are done.
    fn step(
        &mut self,
        (w, wanted): (usize, &Event),
        (f, found): (usize, &Event),
    ) -> (usize, usize) {
        if self.alike(wanted, found) {
            self.details(wanted, found);
            return (1, 1);
        }
        let ahead = |is: &dyn Fn(Event) -> bool, events: &mut dyn Iterator<Item = Event>| {
            events.take(LOOK_AHEAD).position(is)
        };
        let missing = ahead(&|event| self.alike(&event, found), &mut self.wanted.from(w));
        let extra = ahead(&|event| self.alike(wanted, &event), &mut self.found.from(f));
        let leaves_out = match (missing, extra) {
            (Some(missing), Some(extra)) => missing < extra,
            (missing, _) => missing.is_some(),
        };
        match (missing, extra) {
            (Some(count), _) if leaves_out => {
                let events: Vec<Event> = self.wanted.from(w).take(count).collect();
                events.iter().for_each(|event| self.missing(event));
                (count, 0)
            }
            (_, Some(count)) => {
                let events: Vec<Event> = self.found.from(f).take(count).collect();
                events.iter().for_each(|event| self.extra(event));
                (0, count)
            }
            _ => {
                self.other(wanted, found);
                (1, 1)
            }
        }
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
            && a.to.tilt == b.to.tilt
            && a.known == b.known
    }

    /// What two events of one kind and end can still differ in.
    fn details(&mut self, wanted: &Event, found: &Event) {
        match (wanted, found) {
            (Event::Move(a), Event::Move(b)) => {
                self.report.matched += 1;
                let ways = (0..3).map(|n| a.to.linear[n] - b.to.linear[n]);
                let off = ways.map(|way| way * way).sum::<f64>().sqrt();
                self.report.position.add(off, b.line);
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
            (Some(Rate::Varying(a, gains)), Some(Rate::Varying(b, others))) => {
                (a - b).abs() <= DUST && (gains - others).abs() <= DUST
            }
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
                a.length.offset != b.length.offset,
                FindingKind::Tool,
                "another length offset is active".to_string(),
            ),
            (
                a.frame.tip_control != b.frame.tip_control,
                FindingKind::Tool,
                "the TCPC state is wrong".to_string(),
            ),
            (
                a.frame.tilted != b.frame.tilted,
                FindingKind::Tool,
                "the tilted work plane is not as it should be".to_string(),
            ),
            (
                (a.compensation.side, a.compensation.offset)
                    != (b.compensation.side, b.compensation.offset),
                FindingKind::Compensation,
                "cutter compensation is not as it should be".to_string(),
            ),
            (
                a.spindle.turn != b.spindle.turn,
                FindingKind::Spindle,
                format!("the spindle is {:?}, it should be {:?}", b.spindle.turn, a.spindle.turn)
                    .to_lowercase(),
            ),
            (
                a.spindle.speed != b.spindle.speed,
                FindingKind::Speed,
                "the spindle has another speed".to_string(),
            ),
            (
                a.spindle.speed_limit != b.spindle.speed_limit,
                FindingKind::Speed,
                "the spindle speed has another limit".to_string(),
            ),
            (
                a.coolant != b.coolant,
                FindingKind::Coolant,
                "the coolant is not as it should be".to_string(),
            ),
            (
                b.unsaid.spindle && !a.unsaid.spindle,
                FindingKind::Spindle,
                "the spindle is not switched on again after the tool change or stop".to_string(),
            ),
            (
                b.unsaid.coolant && !a.unsaid.coolant,
                FindingKind::Coolant,
                "the coolant is not switched on again after the tool change or stop".to_string(),
            ),
            (
                a.planes.unusual.map(|(normal, _)| normal)
                    != b.planes.unusual.map(|(normal, _)| normal),
                FindingKind::Tool,
                "the tool length offset acts along another axis".to_string(),
            ),
            (
                [a.planes.other, a.length.plane].map(|other| other.map(|other| other.normal))
                    != [b.planes.other, b.length.plane]
                        .map(|other| other.map(|other| other.normal)),
                FindingKind::Tool,
                "the lengths of the tool act along other axes".to_string(),
            ),
            (
                a.frame.moved_zero.is_some() != b.frame.moved_zero.is_some(),
                FindingKind::Fixture,
                "the zero is moved, or not, by a statement".to_string(),
            ),
            (
                a.path_control.is_some() != b.path_control.is_some(),
                FindingKind::Extra,
                "the path mode depends on a statement".to_string(),
            ),
            (
                a.frame.fixture != b.frame.fixture,
                FindingKind::Fixture,
                "another work offset is active".to_string(),
            ),
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

    fn missing(&mut self, event: &Event) {
        let message = format!("no {}", spell(event));
        self.report.find(Finding {
            kind: FindingKind::Missing,
            cl_line: None,
            nc_line: None,
            message,
        });
    }

    fn extra(&mut self, event: &Event) {
        let message = format!("no {} should be here", spell(event));
        self.find(FindingKind::Extra, event.line(), message);
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
        Event::ToolMeasured { .. } => "measures of a tool".to_string(),
        Event::End { .. } => "end of the program".to_string(),
    }
}

fn dwell(seconds: Option<f64>) -> String {
    seconds.map_or("turns of the spindle".to_string(), |seconds| format!("{} s", short(seconds)))
}

fn rate(rate: Option<Rate>) -> String {
    match rate {
        Some(rate) => spell_rate(rate),
        None => "none".to_string(),
    }
}
