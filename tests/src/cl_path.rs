//! The tool path a CL file asks for, read without any post.
//!
//! Covers what a three-axis mill without cutter compensation by the control
//! does: rapid and feed motions, arcs about a principal axis, drilling cycles
//! along Z, tool changes. A file that asks for more is refused, not read
//! half.

use std::io::Read;

use fil_cl::record::{kind, motion};
use fil_cl::{Circle, Options, Reader, Record, Vocabulary, Word, WordId, words as w};

use crate::path::{Action, Arc, Axis, Hole, Point, Step, ToolPath, Unit};

/// Statements that move the tool or the frame in a way not covered here.
const NOT_COVERED: [WordId; 14] = [
    w::TRANS,
    w::TRACUT,
    w::ORIGIN,
    w::COPY,
    w::INDEX,
    w::ROTABL,
    w::ROTATE,
    w::ROTHED,
    w::GOHOME,
    w::THREAD,
    w::OP,
    w::CALSUB,
    w::INSERT,
    w::NURBS,
];

/// How far an axis may be from a principal one.
const STRAIGHT: f64 = 1e-6;

/// A drilling cycle that is on.
#[derive(Clone, Copy)]
struct Cycle {
    depth: f64,
    clear: f64,
    rate: Option<f64>,
}

/// What statements leave for the later ones.
#[derive(Default)]
struct State {
    unit: Option<Unit>,
    point: Point,
    /// RAPID holds for the next motion only.
    rapid: bool,
    rate: Option<f64>,
    circle: Option<Circle>,
    cycle: Option<Cycle>,
    /// The last cycle, for CYCLE/ON.
    last_cycle: Option<Cycle>,
}

/// The path of a CL text; `name` is what messages show.
///
/// # Errors
/// A CL text that cannot be read, and a statement this module does not cover.
pub fn cl_path(input: impl Read, name: &str) -> Result<ToolPath, String> {
    let mut vocab = Vocabulary::new();
    let mut reader = Reader::new(input, name, Options::default());
    let (mut record, mut state, mut steps) = (Record::default(), State::default(), Vec::new());
    while reader.read(&mut vocab, &mut record).map_err(|diag| diag.to_string())? {
        let action =
            state.take(&record).map_err(|reason| format!("CL line {}: {reason}", record.line))?;
        steps.extend(action.map(|action| Step { line: record.line, action }));
    }
    Ok(ToolPath { unit: state.unit, steps })
}

impl State {
    fn take(&mut self, record: &Record) -> Result<Option<Action>, String> {
        match record.kind {
            kind::MOTION => return self.motion(record),
            kind::SURFACE => self.circle = record.circle(),
            kind::PSEUDO => {}
            _ if NOT_COVERED.contains(&record.major) => {
                return Err("the statement is not covered by this comparison".to_string());
            }
            _ => return self.command(record),
        }
        Ok(None)
    }

    fn command(&mut self, record: &Record) -> Result<Option<Action>, String> {
        match record.major {
            w::UNITS if record.has(w::INCHES) => self.unit = Some(Unit::Inch),
            w::UNITS if record.has(w::MM) => self.unit = Some(Unit::Mm),
            w::RAPID => self.rapid = true,
            w::FEDRAT => self.rate = self.minute_rate(record, first_number(record)),
            w::CYCLE => self.cycle(record)?,
            w::CUTCOM if !record.has(w::OFF) => {
                return Err("cutter compensation is not covered".to_string());
            }
            w::LOADTL | w::TURRET => return Ok(first_number(record).map(tool)),
            w::LOAD => return Ok(record.number_after(w::TOOL).map(tool)),
            _ => {}
        }
        Ok(None)
    }

    /// A rate in path units a minute; `None` for the other kinds of feed.
    fn minute_rate(&self, record: &Record, value: Option<f64>) -> Option<f64> {
        let unit = self.unit?;
        let given = match () {
            () if record.has(w::MMPM) => Unit::Mm,
            () if record.has(w::IPM) => Unit::Inch,
            () => return None,
        };
        value.map(|value| value * given.in_mm() / unit.in_mm())
    }

    fn cycle(&mut self, record: &Record) -> Result<(), String> {
        self.cycle = if record.has(w::OFF) {
            None
        } else if record.has(w::ON) {
            self.last_cycle
        } else {
            let number = |one, other| record.number_after(one).or(record.number_after(other));
            let depth = number(w::DEPTH, w::FEDTO).ok_or("a cycle without DEPTH")?;
            let clear = number(w::RAPTO, w::CLEAR).unwrap_or(0.0);
            let rate = self.minute_rate(record, number(w::MMPM, w::IPM));
            Some(Cycle { depth: depth.abs(), clear, rate })
        };
        self.last_cycle = self.cycle.or(self.last_cycle);
        Ok(())
    }

    fn motion(&mut self, record: &Record) -> Result<Option<Action>, String> {
        let mut to = record.point().ok_or("a motion without a point")?;
        if record.axis().is_some_and(|axis| (axis[2] - 1.0).abs() > STRAIGHT) {
            return Err("the tool axis is not Z".to_string());
        }
        if record.sub == motion::GODLTA {
            to = std::array::from_fn(|i| self.point[i] + to[i]);
        }
        self.point = to;
        if record.sub == motion::FROM {
            return Ok(None);
        }
        let rapid = std::mem::take(&mut self.rapid);
        match (self.circle.take(), self.cycle, rapid) {
            (None, None, true) => Ok(Some(Action::Rapid(to))),
            (None, None, false) => Ok(Some(Action::Feed(to, self.rate))),
            (Some(circle), None, false) => Ok(Some(Action::Arc(arc(&circle, to)?, self.rate))),
            (None, Some(cycle), false) => {
                let hole = Hole {
                    at: [to[0], to[1]],
                    bottom: to[2] - cycle.depth,
                    clearance: to[2] + cycle.clear,
                };
                Ok(Some(Action::Hole(hole, cycle.rate)))
            }
            _ => Err("RAPID, CIRCLE and CYCLE hold for one and the same motion".to_string()),
        }
    }
}

fn tool(number: f64) -> Action {
    Action::Tool(number as u32)
}

fn first_number(record: &Record) -> Option<f64> {
    record.data.iter().find_map(|word| match word {
        Word::Number(value) => Some(*value),
        _ => None,
    })
}

/// The arc of Creo's CIRCLE: right-hand rule about its axis, next point is the end.
fn arc(circle: &Circle, to: Point) -> Result<Arc, String> {
    let along = |axis: usize| {
        let length = circle.axis.iter().map(|part| part * part).sum::<f64>().sqrt();
        circle.axis[axis].abs() > length * (1.0 - STRAIGHT)
    };
    let (index, normal) = match () {
        () if along(0) => (0, Axis::X),
        () if along(1) => (1, Axis::Y),
        () if along(2) => (2, Axis::Z),
        () => return Err("the axis of the circle is not X, Y or Z".to_string()),
    };
    let ccw = circle.axis[index] > 0.0;
    Ok(Arc { to, centre: circle.center, normal, ccw, turns: 1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(text: &str) -> Result<Vec<Action>, String> {
        let path = cl_path(text.as_bytes(), "test")?;
        Ok(path.steps.into_iter().map(|step| step.action).collect())
    }

    #[test]
    fn rapid_holds_once_and_the_feed_stays() {
        let text = "UNITS / MM\nLOADTL / 2\nFEDRAT / 10.,  IPM\nRAPID\nGOTO / 1., 2., 3.\n\
                    GOTO / 1., 2., 0.\nFINI\n";
        let (start, end) = ([1.0, 2.0, 3.0], [1.0, 2.0, 0.0]);
        let expect = [Action::Tool(2), Action::Rapid(start), Action::Feed(end, Some(254.0))];
        assert_eq!(steps(text).unwrap(), expect);
    }

    #[test]
    fn a_circle_turns_about_its_axis() {
        let text = "GOTO / 1., 0., 0.\nCIRCLE / 0., 0., 0., 0., 0., -1., 1.\nGOTO / 0., -1., 0.\n";
        let Action::Arc(arc, None) = steps(text).unwrap()[1] else { panic!("no arc") };
        assert_eq!((arc.to, arc.normal, arc.ccw), ([0.0, -1.0, 0.0], Axis::Z, false));
    }

    #[test]
    fn holes_go_down_from_their_start() {
        let text = "UNITS / MM\nCYCLE / DRILL, DEPTH, 3.5, MMPM, 50., CLEAR, 1.\n\
                    GOTO / 1., 2., 0.5\nCYCLE / OFF\nGOTO / 1., 2., 5.\n";
        let hole = Hole { at: [1.0, 2.0], bottom: -3.0, clearance: 1.5 };
        let expect = [Action::Hole(hole, Some(50.0)), Action::Feed([1.0, 2.0, 5.0], None)];
        assert_eq!(steps(text).unwrap(), expect);
    }

    #[test]
    fn what_is_not_covered_is_refused() {
        for text in [
            "TRANS / 1., 0., 0.\n",
            "CUTCOM / LEFT\n",
            "GOTO / 0., 0., 0., 1., 0., 0.\n",
            "CIRCLE / 0., 0., 0., 0., 1., 1., 1.\nGOTO / 0., 0., 0.\n",
            "CYCLE / DRILL, 3.5, 50.\n",
        ] {
            assert!(steps(text).is_err(), "{text}");
        }
    }
}
