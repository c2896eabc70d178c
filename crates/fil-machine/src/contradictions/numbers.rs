//! Numbers of settings that make no sense, alone or beside each other.

use fil_diag::Diag;

use super::contradiction;
use crate::commons::{Commons, Dbl, Rel};
use crate::letter::letters;
use crate::locations as loc;

/// Numbers that must be above zero where they are given.
const POSITIVE: &[(Dbl, &str)] = &[
    (loc::FEED_UPM_FACTOR, "the factor of feeds"),
    (loc::FEED_UPM_MAX_Y, "the largest feed of Y"),
    (loc::FEED_UPM_MAX_Z, "the largest feed of Z"),
    (loc::FEED_INVERSE_FACTOR, "the factor of inverse time"),
    (loc::FEED_INVERSE_MAX, "the largest inverse time"),
    (loc::CIRCLE_CHORD_TOLERANCE, "the chord tolerance"),
    (loc::SEQNO_INCREMENT, "the step of sequence numbers"),
    (loc::SEQNO_MAX, "the largest sequence number"),
    (loc::CIRCLE_MAX_RADIUS, "the largest radius"),
    (loc::MOTION_RESOLUTION, "the resolution of the linear axes"),
    (loc::ROTARY_RESOLUTION, "the resolution of the rotary axes"),
    (loc::LIMITS_MAX_DEPARTURE, "the longest move of a block"),
    (loc::ROTARY_VELOCITY_PERCENT, "the part of the rotary speed"),
];

/// Numbers that must not be below zero where they are given.
const NOT_NEGATIVE: &[(Dbl, &str)] = &[
    (loc::FEED_UPM_MIN, "the least feed"),
    (loc::FEED_UPM_MAX, "the largest feed"),
    (loc::FEED_INVERSE_MIN, "the least inverse time"),
    (loc::FEED_INVERSE_MIN_TIME, "the shortest time of a motion"),
    (loc::RAPID_SHORT_DISTANCE, "the length of short rapids"),
    (loc::CIRCLE_Z_TOLERANCE, "the deviation of flat arcs"),
    (loc::CIRCLE_CORRECTION_MAX, "the largest correction of an arc"),
    (loc::DWELL_UPM_FACTOR, "the factor of dwells in seconds"),
    (loc::DWELL_UPR_FACTOR, "the factor of dwells in turns"),
    (loc::CYCLE_AUTO_CLEARANCE, "the clearance of cycles"),
    (loc::CIRCLE_MIN_RADIUS, "the least radius"),
    (loc::TAPE_LEADER, "the length of the leader"),
    (loc::ROTARY_FEED_MIN, "the lowest feed of the rotary axes"),
    (loc::ROTARY_RAPID_RATE, "the rapid speed of the rotary axes"),
    (loc::TAPE_TRAILER, "the length of the trailer"),
    (loc::MOTION_SAME_TOLERANCE, "the tolerance of unchanged coordinates"),
    (loc::DWELL_CYCLE_DRILL, "the dwell of DRILL"),
    (loc::DWELL_CYCLE_CSINK, "the dwell of CSINK"),
    (loc::DWELL_CYCLE_DEEP, "the dwell of DEEP"),
    (loc::DWELL_CYCLE_TAP, "the dwell of TAP"),
    (loc::DWELL_CYCLE_BORE, "the dwell of BORE"),
    (loc::DWELL_CYCLE_REAM, "the dwell of REAM"),
    (loc::DWELL_CYCLE_THRU, "the dwell of THRU"),
    (loc::DWELL_CYCLE_FACE, "the dwell of FACE"),
    (loc::DWELL_CYCLE_BRKCHP, "the dwell of BRKCHP"),
];

/// Output scales, whose size must leave the axis words digits that mean something.
const SCALES: &[(Dbl, &str)] = &[
    (loc::SCALE_X, "the scale of X"),
    (loc::SCALE_Y, "the scale of Y"),
    (loc::SCALE_Z, "the scale of Z"),
];

/// The least and the largest of them.
const SCALE_SIZES: std::ops::RangeInclusive<f64> = 0.01..=10_000.0;

/// Numbers without sense, of their own.
pub(super) fn numbers(commons: &Commons, found: &mut Vec<Diag>) {
    for (at, what) in POSITIVE {
        if let Some(value) = commons.read(*at).filter(|value| *value <= 0.0) {
            found.push(contradiction(format!("{what} is {value}, it must be above zero")));
        }
    }
    for (at, what) in SCALES {
        let size = commons.read(*at).filter(|scale| !SCALE_SIZES.contains(&scale.abs()));
        if let Some(scale) = size {
            found.push(contradiction(format!("{what} is {scale}, its size must be 0.01 to 10000")));
        }
    }
    for (at, what) in NOT_NEGATIVE {
        if let Some(value) = commons.read(*at).filter(|value| *value < 0.0) {
            found.push(contradiction(format!("{what} is {value}, it must not be below zero")));
        }
    }
}

/// Lowest and highest values that are the wrong way round.
pub(super) fn ranges(commons: &Commons, found: &mut Vec<Diag>) {
    let mut range = |low: Option<f64>, high: Option<f64>, what: &str| {
        if let (Some(low), Some(high)) = (low, high)
            && low > high
        {
            found.push(contradiction(format!(
                "{what}: the least, {low}, is above the most, {high}"
            )));
        }
    };
    let dbl = |at: Dbl| commons.read(at);
    let rel = |at: Rel| commons.read(at);
    for ((low, high), name) in loc::LINEAR_LIMITS.into_iter().zip(letters::XYZ) {
        range(dbl(low), dbl(high), &format!("travel of {name}"));
    }
    let rotary = loc::ROTARY_LIMITS.into_iter().zip(['A', 'B', 'C']);
    for ((low, high), name) in rotary {
        range(dbl(low), dbl(high), &format!("travel of {name}"));
    }
    range(dbl(loc::FEED_UPM_MIN), dbl(loc::FEED_UPM_MAX), "feed");
    for at in [loc::ROTARY_FEED_MAX, loc::ROTARY_SECONDARY_FEED_MAX] {
        // Zero is no limit.
        let most = dbl(at).filter(|most| *most > 0.0);
        range(dbl(loc::ROTARY_FEED_MIN), most, "feed of the rotary axes");
    }
    range(dbl(loc::FEED_INVERSE_MIN), dbl(loc::FEED_INVERSE_MAX), "inverse time");
    range(dbl(loc::ROTARY_PRIMARY_MIN), dbl(loc::ROTARY_PRIMARY_MAX), "first rotary axis");
    range(dbl(loc::ROTARY_SECONDARY_MIN), dbl(loc::ROTARY_SECONDARY_MAX), "second rotary axis");
    for (index, (low, high)) in loc::RANGE_SPEEDS.into_iter().enumerate() {
        range(rel(low), rel(high), &format!("spindle range {}", index + 1));
    }
}
