//! Which way an arc turns, judged by its neighbors.
//!
//! CAM systems disagree about the axis of a CIRCLE: by the right-hand rule, or
//! against it. An arc whose sense fights both neighbors, while the other sense
//! would run on smoothly, comes from a file that was read in the wrong dialect.

use fil_diag::Result;
use nalgebra::Vector3;

use crate::errors::PostCode;

/// Cosine below which one direction runs back against another (about 155 degrees).
const BACK: f64 = -0.9;

/// How the last feed motion ended.
#[derive(Clone, Copy, Debug, Default)]
pub struct Course {
    /// Direction of the last line.
    last: Option<Vector3<f64>>,
    /// The end of an arc that began against the line before it.
    suspect: Option<Suspect>,
}

/// An arc that may turn the wrong way.
#[derive(Clone, Copy, Debug)]
struct Suspect {
    /// Direction in which it ends.
    end: Vector3<f64>,
    /// Line of its CIRCLE in the CL file.
    line: u32,
}

impl Course {
    /// A line follows.
    ///
    /// # Errors
    /// It fights the end of an arc that fought the line before it.
    #[inline]
    pub fn line(&mut self, way: Vector3<f64>) -> Result<()> {
        if self.suspect.is_some() {
            self.judge(way)?;
        }
        if way != Vector3::zeros() {
            self.last = Some(way);
        }
        Ok(())
    }

    /// An arc follows that begins and ends in these directions.
    ///
    /// # Errors
    /// It fights the end of an arc that fought the line before it.
    pub fn arc(&mut self, begin: Vector3<f64>, end: Vector3<f64>, line: u32) -> Result<()> {
        if self.suspect.is_some() {
            self.judge(begin)?;
        }
        let fights = self.last.is_some_and(|last| runs_back(last, begin));
        self.suspect = fights.then_some(Suspect { end, line });
        self.last = None;
        Ok(())
    }

    /// A motion follows that tells nothing (a rapid).
    #[inline]
    pub fn interrupt(&mut self) {
        *self = Course::default();
    }

    fn judge(&mut self, way: Vector3<f64>) -> Result<()> {
        let Some(suspect) = self.suspect.take() else { return Ok(()) };
        if runs_back(suspect.end, way) {
            return PostCode::ArcSense.err(format!(
                "the CIRCLE of line {} runs back from the motion before it and into the one after it; \
                 the other sense would be smooth",
                suspect.line
            ));
        }
        Ok(())
    }
}

fn runs_back(one: Vector3<f64>, other: Vector3<f64>) -> bool {
    let length = one.norm() * other.norm();
    length > 0.0 && one.dot(&other) < BACK * length
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
            course.arc(begin, end, 7).unwrap();
            assert_eq!(course.line(next).is_err(), refused, "{begin} {end} {next}");
        }
    }

    #[test]
    fn a_rapid_tells_nothing() {
        let mut course = Course::default();
        course.line(Vector3::x()).unwrap();
        course.arc(-Vector3::x(), Vector3::y(), 7).unwrap();
        course.interrupt();
        course.line(-Vector3::y()).unwrap();
    }
}
