//! Programs as traces.

use std::borrow::Cow;
use std::collections::VecDeque;

use fil_diag::{Code, Diag};

use super::sample::{tip, tips};
use super::trace::{Builder, is_place, tolerance};
use super::{Extent, LeftOut, Stroke, Trace, variables};
use crate::dialect::{Dialect, Family, Habit};
use crate::errors::NcCode;
use crate::events::Events;
use crate::forward::Forward;
use crate::interpret::Running;
use crate::motion::{Course, Event, Move, Position};
use crate::source::Source;

/// Most lines that are passed over; a program with more is drawn up to there.
const MOST_LEFT_OUT: u32 = 10_000;

/// The trace of a program; `name` is for messages.
///
/// Motions from or to a place that is not known are left out, and so are those to
/// points of the machine. A line without a certain meaning is noted in
/// [`Trace::left_out`], and the path goes on where the program has given all positions again.
/// A program with arcs, or one that names other axes than most, is run twice, so that no more than
/// its trace is kept.
///
/// # Errors
/// The first line without a certain meaning, where nothing can be drawn or the text is a
/// program of another family of controls.
pub fn nc_trace(
    text: &[u8],
    name: &str,
    dialect: &Dialect,
    forward: &Forward,
) -> Result<Trace, Box<Diag>> {
    let text = match dialect.family {
        Family::WordAddress => variables::resolved(text),
        Family::Klartext | Family::Sinumerik => Cow::Borrowed(text),
    };
    let source = Source::memory(&text).into_page(dialect.text.page);
    let mut survey = Survey::default();
    // How fine arcs are drawn is known when all has been read.
    let mut sketch = Some(Sketch::new(forward, usual_axes(dialect, forward), 0.0));
    let refused = run(&source, name, dialect, &mut |event| {
        if let Some(Event::Move(motion)) = &event {
            survey.take(motion, forward);
            sketch = sketch.take().filter(|_| motion.arc.is_none());
        }
        if let Some(sketch) = &mut sketch {
            sketch.take(event);
        }
    });
    if let Some(foreign) = refused.iter().find(|refused| !refused.notes.is_empty()) {
        return Err(Box::new(foreign.clone()));
    }
    let sketch = sketch.filter(|sketch| (sketch.named ^ survey.named) & survey.unknown == 0);
    let sketch = sketch.unwrap_or_else(|| {
        let mut sketch = Sketch::new(forward, survey.named, tolerance(survey.extent()));
        run(&source, name, dialect, &mut |event| sketch.take(event));
        sketch
    });
    let mut trace = sketch.builder.trace;
    trace.inch = survey.inch.unwrap_or(!dialect.has(Habit::Metric));
    trace.left_out = left_out(&refused);
    match refused.into_iter().next() {
        Some(first) if trace.pieces.is_empty() => Err(Box::new(first)),
        _ => Ok(trace),
    }
}

/// Runs a program and hands its events over, and `None` for each line that is refused and passed
/// over.
fn run(
    source: &Source<'_>,
    name: &str,
    dialect: &Dialect,
    take: &mut dyn FnMut(Option<Event>),
) -> Vec<Diag> {
    let mut running = Running::new(source, name, dialect);
    let (mut events, mut refused) = (VecDeque::new(), Vec::<Diag>::new());
    while refused.len() < MOST_LEFT_OUT as usize {
        match running.more(&mut events) {
            Ok(true) => events.drain(..).map(Some).for_each(&mut *take),
            Ok(false) => break,
            // The end of the text is refused again and again.
            Err(same) if refused.last().is_some_and(|last| last.spans == same.spans) => break,
            Err(fault) => {
                events.clear();
                running.go_on();
                take(None);
                refused.push(*fault);
            }
        }
    }
    refused
}

/// Lines that were refused, those with one reason together.
fn left_out(refused: &[Diag]) -> Vec<LeftOut> {
    let not_a_word: &Code = NcCode::NotAWord.into();
    let mut left_out: Vec<LeftOut> = Vec::new();
    for diag in refused {
        let line = diag.spans.first().map_or(0, |span| span.line);
        let why = if diag.code == not_a_word {
            format!("{} is {}", diag.message, diag.code.title)
        } else {
            diag.message.clone()
        };
        match left_out.last_mut() {
            Some(last) if last.why == why && last.line + last.count == line => last.count += 1,
            _ => left_out.push(LeftOut { line, count: 1, why }),
        }
    }
    if refused.len() == MOST_LEFT_OUT as usize {
        let line = left_out.last().map_or(0, |last| last.line + last.count);
        left_out.push(LeftOut { line, count: 1, why: "the rest of the program".to_string() });
    }
    left_out
}

/// A program that is being drawn.
struct Sketch<'f> {
    forward: &'f Forward,
    /// Axes that a block names, a bit each. One that none names does not move: it is known
    /// well enough.
    named: usize,
    tolerance: f64,
    builder: Builder,
    /// Where the axes stand.
    at: Position,
}

impl<'f> Sketch<'f> {
    fn new(forward: &'f Forward, named: usize, tolerance: f64) -> Self {
        let (builder, at) = (Builder::default(), Position::default());
        Sketch { forward, named, tolerance, builder, at }
    }

    fn take(&mut self, event: Option<Event>) {
        match event {
            Some(Event::Move(motion)) => {
                self.add(&motion);
                self.at = motion.to;
            }
            Some(Event::ToolChange { line, tool, .. }) => self.builder.change(line, tool),
            Some(_) => {}
            None => self.builder.pen = None,
        }
    }

    /// Adds a motion from where the axes stand.
    fn add(&mut self, motion: &Move) {
        let Sketch { forward, builder, at, .. } = self;
        if motion.course == Course::Machine || unknown(motion) & self.named != 0 {
            builder.pen = None;
        } else if builder.pen.is_none() {
            builder.put(tip(forward, &motion.to));
        } else {
            let points = tips(forward, (at, &motion.to), motion.arc.as_ref(), self.tolerance);
            if builder.draw(stroke(motion), motion.line, points) {
                builder.note(motion, forward.axis(motion.to.rotary).into());
                if forward.has_rotary() {
                    builder.note_rotary(motion.to.rotary);
                }
            }
        }
    }
}

/// The axes that programs of a machine mostly name, a bit each.
fn usual_axes(dialect: &Dialect, forward: &Forward) -> usize {
    let [primary, secondary] = forward.rotaries().each_ref().map(|rotary| rotary.is_some());
    let axes = [true, !dialect.is_lathe(), true, primary, secondary];
    axes.iter().enumerate().map(|(bit, named)| usize::from(*named) << bit).sum()
}

fn stroke(motion: &Move) -> Stroke {
    match (motion.course, motion.arc) {
        (Course::Thread, _) => Stroke::Thread,
        (Course::Rapid | Course::Machine, _) => Stroke::Rapid,
        (Course::Feed, Some(_)) => Stroke::Arc,
        (Course::Feed, None) => Stroke::Feed,
    }
}

/// What must be known of a whole program before it is drawn.
#[derive(Default)]
struct Survey {
    /// Axes that a block names, a bit each.
    named: usize,
    /// Axes that are not known at the end of a motion.
    unknown: usize,
    /// The ends of motions, by the axes that are not known there.
    extents: [Option<Extent>; 32],
    /// The first motion is in inch.
    inch: Option<bool>,
}

impl Survey {
    fn take(&mut self, motion: &Move, forward: &Forward) {
        let unknown = unknown(motion);
        self.named |= !unknown & 31;
        self.unknown |= unknown;
        self.inch.get_or_insert(motion.modes.inch);
        let end = tip(forward, &motion.to);
        if is_place(&end) {
            self.extents[unknown] = Extent::joined(self.extents[unknown], Extent::of([&end]));
        }
    }

    /// The box around the ends that are known.
    fn extent(&self) -> Option<Extent> {
        let known = (0..32).filter(|unknown| unknown & self.named == 0);
        known.map(|unknown| self.extents[unknown]).fold(None, Extent::joined)
    }
}

/// The axes that are not known where a motion ends, a bit each.
fn unknown(motion: &Move) -> usize {
    (0..5).map(|axis| usize::from(!motion.known[axis]) << axis).sum()
}
