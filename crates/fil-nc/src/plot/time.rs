//! How long the motions of a path take.

use super::{InForce, Stroke, Trace};
use crate::motion::{Rate, Speed};

/// mm/min that rapids are taken to have.
pub(super) const RAPID: f64 = 10_000.0;

/// Least radius at which a surface speed turns the spindle, mm.
const LEAST_RADIUS: f64 = 0.01;

/// Seconds from the start of a path to the end of each piece. Dwells and tool changes are left
/// out, and a piece without a known feed takes no time.
pub(super) fn ends(trace: &Trace) -> Vec<f64> {
    let mut rows = trace.in_force.iter().peekable();
    let (mut now, mut seconds) = (None, 0.0);
    (0..trace.pieces.len())
        .map(|piece| {
            while let Some(next) = rows.next_if(|row| row.from <= piece) {
                now = Some(next);
            }
            let feed = feed(trace, piece, now);
            if feed > 0.0 {
                seconds += trace.length(piece) / feed * 60.0;
            }
            seconds
        })
        .collect()
}

/// mm/min of a piece; 0 where nothing says it.
fn feed(trace: &Trace, piece: usize, now: Option<&InForce>) -> f64 {
    if trace.pieces[piece].stroke == Stroke::Rapid {
        return RAPID;
    }
    match now.and_then(|now| Some((now, now.feed?))) {
        Some((_, Rate::PerMinute(feed))) => feed,
        Some((now, Rate::PerTurn(feed) | Rate::Varying(feed, _))) => {
            feed * turns(trace, piece, now)
        }
        Some((_, Rate::Inverse(_))) | None => 0.0,
    }
}

/// Turns/min at a piece; 0 where nothing says them. Surface speed is that of the middle between
/// the ends of the piece, up to the limit in force.
fn turns(trace: &Trace, piece: usize, now: &InForce) -> f64 {
    match now.speed {
        Some(Speed::Turns(turns)) => turns,
        Some(Speed::Surface(speed)) => {
            let points = trace.pieces[piece].range();
            let ends = [points.start, points.end - 1].map(|point| trace.points[point][0]);
            let radius = ((ends[0] + ends[1]) / 2.0).abs().max(LEAST_RADIUS);
            let turns = speed * 1000.0 / (2.0 * std::f64::consts::PI * radius);
            now.speed_limit.map_or(turns, |limit| turns.min(limit))
        }
        None => 0.0,
    }
}
