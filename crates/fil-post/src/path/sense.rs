//! Which way an arc turns, judged by its neighbors.
//!
//! CAM systems disagree about the axis of a CIRCLE: by the right-hand rule, or
//! against it. An arc whose sense fights both neighbors, while the other sense
//! would run on smoothly, comes from a file that was read in the wrong dialect. But a
//! path that clears the corner beside a round boss has such arcs, too, as cusps: short
//! ones are taken where the file has more arcs that run on smoothly on both sides.

use fil_diag::Result;
use nalgebra::Vector3;

use crate::errors::PostCode;

/// Cosine below which one direction runs back against another (about 155 degrees).
const BACK: f64 = -0.9;

/// Degrees from which on the other way round is the shorter one.
const HALF: f64 = 180.0;

/// How the last feed motion ended.
#[derive(Clone, Copy, Debug, Default)]
pub struct Course {
    /// Direction of the last line.
    last: Option<Vector3<f64>>,
    /// An arc after a line, until the motion after it comes.
    arc: Option<Waiting>,
    /// Arcs that ran on smoothly on both sides.
    smooth: u32,
    /// Arcs that fought both neighbors.
    cusps: u32,
}

/// An arc after a line.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    /// How it began.
    begin: Meeting,
    /// Direction in which it ends.
    end: Vector3<f64>,
    /// Line of its CIRCLE in the CL file.
    line: u32,
    /// The other way round is longer.
    is_short: bool,
}

/// How two motions meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meeting {
    /// The second runs on as the first.
    Smooth,
    /// The second runs back.
    Back,
    /// In a corner.
    Corner,
}

impl Meeting {
    fn of(one: Vector3<f64>, other: Vector3<f64>) -> Self {
        let (along, length) = (one.dot(&other), one.norm() * other.norm());
        match () {
            () if length > 0.0 && along < BACK * length => Meeting::Back,
            () if length > 0.0 && along > -BACK * length => Meeting::Smooth,
            () => Meeting::Corner,
        }
    }
}

impl Course {
    /// A line follows.
    ///
    /// # Errors
    /// It fights the end of an arc that fought the line before it.
    #[inline]
    pub fn line(&mut self, way: Vector3<f64>) -> Result<()> {
        if self.arc.is_some() {
            self.judge(way)?;
        }
        if way != Vector3::zeros() {
            self.last = Some(way);
        }
        Ok(())
    }

    /// An arc of so many degrees follows that begins and ends in these directions.
    ///
    /// # Errors
    /// It fights the end of an arc that fought the line before it.
    pub fn arc(&mut self, [begin, end]: [Vector3<f64>; 2], sweep: f64, line: u32) -> Result<()> {
        if self.arc.is_some() {
            self.judge(begin)?;
        }
        self.arc = self.last.map(|last| Waiting {
            begin: Meeting::of(last, begin),
            end,
            line,
            is_short: sweep < HALF,
        });
        self.last = None;
        Ok(())
    }

    /// A motion follows that tells nothing (a rapid).
    #[inline]
    pub fn interrupt(&mut self) {
        (self.last, self.arc) = (None, None);
    }

    fn judge(&mut self, way: Vector3<f64>) -> Result<()> {
        let Some(arc) = self.arc.take() else { return Ok(()) };
        match (arc.begin, Meeting::of(arc.end, way)) {
            (Meeting::Smooth, Meeting::Smooth) => self.smooth += 1,
            (Meeting::Back, Meeting::Back) if arc.is_short && self.cusps < self.smooth => {
                self.cusps += 1;
            }
            (Meeting::Back, Meeting::Back) => {
                return PostCode::ArcSense.err(format!(
                    "the CIRCLE of line {} runs back from the motion before it and into the one \
                     after it; the other sense would be smooth",
                    arc.line
                ));
            }
            _ => {}
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_an_arc_that_fights_both_neighbors_is_refused() {
        let (x, y) = (Vector3::x(), Vector3::y());
        for (begin, end, next, refused) in
            [(-x, y, -y, true), (-x, y, y, false), (x, y, -y, false), (x, y, y, false)]
        {
            let mut course = Course::default();
            course.line(x).unwrap();
            course.arc([begin, end], 90.0, 7).unwrap();
            assert_eq!(course.line(next).is_err(), refused, "{begin} {end} {next}");
        }
    }

    #[test]
    fn a_rapid_tells_nothing() {
        let mut course = Course::default();
        course.line(Vector3::x()).unwrap();
        course.arc([-Vector3::x(), Vector3::y()], 90.0, 7).unwrap();
        course.interrupt();
        course.line(-Vector3::y()).unwrap();
    }

    /// A cusp beside a round boss is as real as the smooth arcs of the same file.
    #[test]
    fn short_arcs_may_fight_where_others_have_proved_the_sense() {
        let (x, y) = (Vector3::x(), Vector3::y());
        let cusp = |course: &mut Course, sweep: f64| {
            course.interrupt();
            course.line(x).unwrap();
            course.arc([-x, y], sweep, 7).unwrap();
            course.line(-y)
        };
        let mut course = Course::default();
        assert!(cusp(&mut course, 60.0).is_err(), "nothing has proved the sense");
        for _ in 0..2 {
            course.interrupt();
            course.line(x).unwrap();
            course.arc([x, y], 90.0, 3).unwrap();
            course.line(y).unwrap();
        }
        assert!(cusp(&mut course, 300.0).is_err(), "the other way round is shorter");
        assert!(cusp(&mut course, 60.0).is_ok());
        assert!(cusp(&mut course, 60.0).is_ok());
        assert!(cusp(&mut course, 60.0).is_err(), "as many cusps as smooth arcs");
    }
}
