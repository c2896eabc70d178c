//! Which way an arc turns, judged by its neighbors and by how far it turns.
//!
//! CAM systems disagree about the axis of a CIRCLE: by the right-hand rule, or
//! against it. Read by the wrong rule an arc takes the other way round, and begins and ends
//! in the opposite directions. So each arc tells something: one that is the shorter way
//! round and runs on from its neighbors proves the rule; one that is the longer way round and
//! runs back contradicts it. A short arc that runs back tells little, as a path that clears
//! the corner beside a round boss has such cusps, and so does a long one that runs on. An arc that
//! runs back from a plunge along the tool axis, or into a way out along it, tells nothing: a tool
//! that comes down beside a dome rises over it. The program is judged at its end, by all of them; an arc that is wrong for itself at once.

use fil_diag::Result;
use nalgebra::Vector3;

use crate::errors::PostCode;

/// Cosine below which one direction runs back against another (about 155 degrees).
const BACK: f64 = -0.9;

/// Sine of the angle within which a line goes along the tool axis.
const ALONG: f64 = 1e-3;

/// Degrees by which an arc differs from half a turn so that one way round is the longer one.
const UNEVEN: f64 = 0.5;

/// Long arcs, without a short one, that are taken for those of another rule.
const MANY: u32 = 4;

/// A motion whose squared length is below this, mm² or inch², has no direction: a
/// difference of two equal points leaves as much.
const SHORTEST: f64 = 1e-14;

/// How the last feed motion ended.
#[derive(Clone, Copy, Debug, Default)]
pub struct Course {
    /// Direction of the last line.
    last: Option<Vector3<f64>>,
    /// An arc until the motion after it comes.
    arc: Option<Waiting>,
    /// What the arcs so far tell.
    tally: Tally,
    /// The sense of the file's arcs is proved: what runs back is a cusp, and no other sense.
    pub is_proved: bool,
    /// A full turn ends exactly where it begins.
    pub exact_turns: bool,
}

/// An arc whose end is not judged.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    /// How it began; `None` after another arc or a rapid.
    begin: Option<Meeting>,
    /// Direction in which it ends.
    end: Vector3<f64>,
    /// The tool axis; `None` where lines along it are cuts as any others.
    tool: Option<Vector3<f64>>,
    /// Line of its CIRCLE in the CL file.
    line: u32,
    extent: Extent,
}

/// How two motions meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meeting {
    /// The second runs on as the first.
    Smooth,
    /// The second runs back.
    Back,
    /// The second runs back, and the line of both goes along the tool axis.
    BackAlongTool,
    /// In a corner.
    Corner,
}

/// How far an arc turns, compared with the other way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Extent {
    /// Less than half a turn.
    Short,
    /// Half a turn, or whole turns: both ways are alike.
    Even,
    /// More than half a turn.
    Long,
}

/// What the arcs of a program tell.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    /// Arcs that run on and are not the longer way round.
    proved: u32,
    /// Arcs that run back and are not the shorter way round, and the line of the first.
    contradicted: u32,
    first_contradicted: u32,
    /// Arcs that run on at both ends.
    smooth: u32,
    /// Short arcs that run back at both ends, and the line of the first.
    cusps: u32,
    first_cusp: u32,
    short: u32,
    /// Arcs above half a turn, and the line of the first.
    long: u32,
    first_long: u32,
    /// Arcs that run back along the tool axis alone and are not the shorter way round, and the line
    /// of the first.
    plunges: u32,
    first_plunge: u32,
}

/// What is to be said of the arcs of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing speaks against their sense.
    Fits,
    /// The other sense would fit; why.
    Contradicted(String),
    /// All arcs are long, and nothing proves their sense; why.
    Doubtful(String),
    /// Something speaks against the sense, but not enough to tell; what.
    Unproved(String),
    /// Nothing proves the sense of an arc that could as well have the other one; which.
    Open(String),
}

impl Meeting {
    /// How an arc in this direction meets the way of a line.
    fn of(arc: Vector3<f64>, line: Vector3<f64>, tool: Option<Vector3<f64>>) -> Self {
        let (along, length) = (arc.dot(&line), arc.norm() * line.norm());
        let is_along = |tool: Vector3<f64>| line.cross(&tool).norm() < ALONG * line.norm();
        match () {
            () if length > 0.0 && along < BACK * length => {
                let plunges = tool.and_then(|tool| tool.try_normalize(0.0)).is_some_and(is_along);
                if plunges { Meeting::BackAlongTool } else { Meeting::Back }
            }
            () if length > 0.0 && along > -BACK * length => Meeting::Smooth,
            () => Meeting::Corner,
        }
    }
}

impl Extent {
    fn of(sweep: f64) -> Self {
        match sweep {
            sweep if sweep < 180.0 - UNEVEN => Extent::Short,
            sweep if sweep > 180.0 + UNEVEN && sweep < 360.0 - UNEVEN => Extent::Long,
            _ => Extent::Even,
        }
    }
}

impl Course {
    /// A line follows.
    ///
    /// # Errors
    /// It fights the end of an arc that fought the line before it, and is the longer way round.
    #[inline]
    pub fn line(&mut self, way: Vector3<f64>) -> Result<()> {
        if self.arc.is_some() {
            self.judge(way)?;
        }
        if way.norm_squared() > SHORTEST {
            self.last = Some(way);
        }
        Ok(())
    }

    /// No arc waits for the line behind it.
    pub fn is_judged(&self) -> bool {
        self.arc.is_none()
    }

    /// An arc of so many degrees follows that begins and ends in these directions; the tool axis
    /// is `None` where lines along it are cuts as any others.
    pub fn arc(
        &mut self,
        [begin, end]: [Vector3<f64>; 2],
        sweep: f64,
        tool: Option<Vector3<f64>>,
        line: u32,
    ) {
        // Read by the other rule both arcs would turn round: how they meet tells nothing.
        self.settle(None);
        let begin = self.last.take().map(|last| Meeting::of(begin, last, tool));
        self.arc = Some(Waiting { begin, end, tool, line, extent: Extent::of(sweep) });
    }

    /// A motion follows that tells nothing (a rapid).
    #[inline]
    pub fn interrupt(&mut self) {
        if self.arc.is_some() {
            self.settle(None);
        }
        self.last = None;
    }

    /// A line follows the arc that waits. One without length tells nothing.
    fn judge(&mut self, way: Vector3<f64>) -> Result<()> {
        let Some(arc) = self.arc.filter(|_| way.norm_squared() > SHORTEST) else { return Ok(()) };
        let end = Meeting::of(arc.end, way, arc.tool);
        self.settle(Some(end));
        if self.is_proved {
            return Ok(());
        }
        if (arc.begin, end) == (Some(Meeting::Back), Meeting::Back) && arc.extent != Extent::Short {
            return PostCode::ArcSense.err(format!(
                "the CIRCLE of line {} reverses against the moves before and after it; the other direction would be smooth",
                arc.line
            ));
        }
        Ok(())
    }

    /// Counts what the arc that waits tells.
    fn settle(&mut self, end: Option<Meeting>) {
        let Some(arc) = self.arc.take() else { return };
        let ends = [arc.begin, end];
        let count = |meeting| ends.iter().filter(|end| **end == Some(meeting)).count();
        let (smooth, back) = (count(Meeting::Smooth), count(Meeting::Back));
        let tally = &mut self.tally;
        let note = |count: &mut u32, first: &mut u32| {
            if *count == 0 {
                *first = arc.line;
            }
            *count = count.saturating_add(1);
        };
        if smooth > back && arc.extent != Extent::Long {
            tally.proved = tally.proved.saturating_add(1);
        }
        if back > smooth && arc.extent != Extent::Short {
            note(&mut tally.contradicted, &mut tally.first_contradicted);
        }
        if back == smooth && count(Meeting::BackAlongTool) > 0 && arc.extent != Extent::Short {
            note(&mut tally.plunges, &mut tally.first_plunge);
        }
        if smooth == 2 {
            tally.smooth = tally.smooth.saturating_add(1);
        }
        match arc.extent {
            Extent::Short => {
                tally.short = tally.short.saturating_add(1);
                if back == 2 {
                    note(&mut tally.cusps, &mut tally.first_cusp);
                }
            }
            Extent::Long => note(&mut tally.long, &mut tally.first_long),
            Extent::Even => {}
        }
    }

    /// The program ends: what its arcs tell. They are forgotten.
    pub fn conclude(&mut self) -> Verdict {
        self.interrupt();
        let Tally { proved, contradicted, smooth, cusps, short, long, plunges, .. } = self.tally;
        let lines = std::mem::take(&mut self.tally);
        match () {
            () if self.is_proved && contradicted <= proved => Verdict::Fits,
            () if self.is_proved => Verdict::Unproved(format!(
                "the CIRCLE of line {} runs back, as its system means it",
                lines.first_contradicted
            )),
            () if contradicted > proved => Verdict::Contradicted(format!(
                "{contradicted} of the arcs, first the CIRCLE of line {}, reverse and would be smooth in the other direction, and {proved} are smooth",
                lines.first_contradicted
            )),
            () if cusps > smooth.max(proved) => Verdict::Contradicted(format!(
                "{cusps} of the arcs, the first one the CIRCLE of line {}, run back from the motion \
                 before them and into the one after them, and {} run on",
                lines.first_cusp,
                smooth.max(proved)
            )),
            () if proved == 0 && short == 0 && long >= MANY => Verdict::Doubtful(format!(
                "all {long} arcs, the first one the CIRCLE of line {}, take the longer way round, and \
                 nothing in the motions beside them shows that they should",
                lines.first_long
            )),
            () if contradicted > 0 => Verdict::Unproved(format!(
                "the CIRCLE of line {} reverses, and would be smooth in the other direction",
                lines.first_contradicted
            )),
            () if proved == 0 && long > short => Verdict::Unproved(format!(
                "the CIRCLE of line {} is the longer arc, and no arc of the file proves the direction",
                lines.first_long
            )),
            () if proved == 0 && plunges > 0 => Verdict::Open(format!(
                "the CIRCLE of line {} reverses a move along the tool axis, and no arc of the file proves the direction",
                lines.first_plunge
            )),
            () => Verdict::Fits,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs a line along X, an arc that begins and ends so, and a line.
    fn arc(course: &mut Course, [begin, end, next]: [Vector3<f64>; 3], sweep: f64) -> Result<()> {
        course.interrupt();
        course.line(Vector3::x()).unwrap();
        course.arc([begin, end], sweep, None, 7);
        course.line(next)
    }

    fn verdict_of(arcs: &[([Vector3<f64>; 3], f64, usize)]) -> Verdict {
        let mut course = Course::default();
        for (ways, sweep, times) in arcs {
            for _ in 0..*times {
                arc(&mut course, *ways, *sweep).unwrap();
            }
        }
        course.conclude()
    }

    fn ways() -> [[Vector3<f64>; 3]; 4] {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let (smooth, back) = ([x, y, y], [-x, y, -y]);
        let (back_once, corners) = ([-x, y, z], [y, x, z]);
        [smooth, back, back_once, corners]
    }

    #[test]
    fn only_a_long_arc_that_fights_both_neighbors_is_refused_at_once() {
        let (x, y) = (Vector3::x(), Vector3::y());
        for (begin, end, next, refused) in
            [(-x, y, -y, true), (-x, y, y, false), (x, y, -y, false), (x, y, y, false)]
        {
            for sweep in [90.0, 179.0, 180.0, 270.0, 360.0, 1000.0] {
                let result = arc(&mut Course::default(), [begin, end, next], sweep);
                assert_eq!(result.is_err(), refused && sweep >= 180.0, "{begin} {end} {sweep}");
            }
        }
    }

    #[test]
    fn a_rapid_tells_nothing() {
        let mut course = Course::default();
        course.line(Vector3::x()).unwrap();
        course.interrupt();
        course.arc([-Vector3::x(), Vector3::y()], 270.0, None, 7);
        course.interrupt();
        course.line(-Vector3::y()).unwrap();
        assert_eq!(course.tally.contradicted, 0);
    }

    /// A line without length between an arc and the line after it changes nothing.
    #[test]
    fn a_point_twice_tells_nothing() {
        let mut course = Course::default();
        course.line(Vector3::x()).unwrap();
        course.line(Vector3::zeros()).unwrap();
        course.arc([-Vector3::x(), Vector3::y()], 270.0, None, 7);
        course.line(Vector3::zeros()).unwrap();
        assert!(course.line(-Vector3::y()).is_err());
    }

    #[test]
    fn short_cusps_are_judged_by_the_whole_program() {
        let [smooth, back, _, _] = ways();
        for order in [[(smooth, 90.0, 2), (back, 60.0, 2)], [(back, 60.0, 2), (smooth, 90.0, 2)]] {
            assert_eq!(verdict_of(&order), Verdict::Fits);
        }
        let found = verdict_of(&[(smooth, 90.0, 1), (back, 60.0, 2)]);
        assert!(matches!(found, Verdict::Contradicted(_)), "{found:?}");
    }

    #[test]
    fn what_the_arcs_tell() {
        let [smooth, _, back_once, corners] = ways();
        let refused = |arcs: &[_]| matches!(verdict_of(arcs), Verdict::Contradicted(_));
        assert!(refused(&[(back_once, 270.0, 1)]));
        assert!(refused(&[(back_once, 360.0, 1)]), "a whole circle");
        assert!(refused(&[(smooth, 90.0, 1), (back_once, 270.0, 2)]));
        let warned = |arcs: &[_]| matches!(verdict_of(arcs), Verdict::Unproved(_));
        assert!(warned(&[(smooth, 90.0, 2), (back_once, 270.0, 2)]));
        assert!(warned(&[(corners, 270.0, 1)]));
        assert!(warned(&[(corners, 270.0, 5), (corners, 90.0, 1)]));
        let doubtful = verdict_of(&[(corners, 270.0, 4)]);
        assert!(matches!(doubtful, Verdict::Doubtful(_)), "{doubtful:?}");
        for fits in [
            &[(corners, 90.0, 9)][..],
            &[(corners, 360.0, 9)],
            &[(back_once, 90.0, 9)],
            &[(smooth, 270.0, 1), (smooth, 90.0, 1)],
            &[(corners, 270.0, 9), (smooth, 180.0, 1)],
            &[],
        ] {
            assert_eq!(verdict_of(fits), Verdict::Fits, "{fits:?}");
        }
    }

    /// A half circle over a dome begins and ends against the ways down and up beside it; the same
    /// against other lines is refused, and a shorter arc needs no word.
    #[test]
    fn an_arc_against_a_plunge_is_no_contradiction() {
        let z = Vector3::z();
        let over = |tool: Vector3<f64>, sweep: f64| {
            let mut course = Course::default();
            course.line(-z)?;
            course.arc([z, -z], sweep, Some(tool), 7);
            course.line(z).map(|()| course.conclude())
        };
        assert!(matches!(over(z * 2.0, 180.0), Ok(Verdict::Open(_))));
        assert!(matches!(over(-z, 200.0), Ok(Verdict::Unproved(_))));
        assert_eq!(over(z, 170.0).ok(), Some(Verdict::Fits));
        for tool in [Vector3::x(), Vector3::new(0.01, 0.0, 1.0), Vector3::zeros()] {
            assert!(over(tool, 180.0).is_err(), "{tool}");
        }
    }

    /// In a chain of arcs only its two ends tell something.
    #[test]
    fn arcs_after_arcs() {
        let (x, y) = (Vector3::x(), Vector3::y());
        let mut course = Course::default();
        course.line(x).unwrap();
        course.arc([x, y], 90.0, None, 1);
        course.arc([-y, -x], 300.0, None, 2);
        course.arc([-x, y], 90.0, None, 3);
        course.line(y).unwrap();
        let Tally { proved, contradicted, smooth, .. } = course.tally;
        assert_eq!((proved, contradicted, smooth), (2, 0, 0));
    }
}
