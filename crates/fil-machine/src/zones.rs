//! Zones of a rotary axis, in each of which it may stand and from none of which it may go to
//! another through what lies between.

use crate::commons::{Commons, Dbl};
use crate::locations::{self as loc, TravelKind};

/// A turn, degrees.
const TURN: f64 = 360.0;

/// So far outside of a zone is within, degrees: a direction at its end may be rounded.
const SLACK: f64 = 1e-6;

/// A zone, from its lower to its upper end, degrees; it comes again with each whole turn.
type Zone = [f64; 2];

/// Where a rotary axis may stand; no zone of a kind leaves it free.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Zones {
    /// It must stand in one of these.
    pub ranges: [Option<Zone>; 2],
    /// And in this one.
    pub zone: Option<Zone>,
}

/// The settings of A, B or C.
struct Ends {
    first: [Dbl; 2],
    second: [Dbl; 2],
    zone: [Dbl; 2],
}

const ENDS: [Ends; 3] = [
    Ends {
        first: [loc::LIMITS_A_RANGE1_MIN, loc::LIMITS_A_RANGE1_MAX],
        second: [loc::LIMITS_A_RANGE2_MIN, loc::LIMITS_A_RANGE2_MAX],
        zone: [loc::LIMITS_A_ZONE_MIN, loc::LIMITS_A_ZONE_MAX],
    },
    Ends {
        first: [loc::LIMITS_B_RANGE1_MIN, loc::LIMITS_B_RANGE1_MAX],
        second: [loc::LIMITS_B_RANGE2_MIN, loc::LIMITS_B_RANGE2_MAX],
        zone: [loc::LIMITS_B_ZONE_MIN, loc::LIMITS_B_ZONE_MAX],
    },
    Ends {
        first: [loc::LIMITS_C_RANGE1_MIN, loc::LIMITS_C_RANGE1_MAX],
        second: [loc::LIMITS_C_RANGE2_MIN, loc::LIMITS_C_RANGE2_MAX],
        zone: [loc::LIMITS_C_ZONE_MIN, loc::LIMITS_C_ZONE_MAX],
    },
];

impl Zones {
    /// Those of A, B or C (0 to 2).
    pub fn from_commons(commons: &Commons, axis: usize) -> Zones {
        if !commons.read(loc::LIMITS_CHECK) {
            return Zones::default();
        }
        let ends = &ENDS[axis];
        let zone = |[min, max]: [Dbl; 2]| Some([commons.dbl_opt(min)?, commons.dbl_opt(max)?]);
        let in_ranges = commons.read(loc::TRAVEL_KINDS[axis]) == TravelKind::RotaryRanges;
        let ranges = if in_ranges { [zone(ends.first), zone(ends.second)] } else { [None; 2] };
        let in_zone = commons.read(loc::IN_ZONES[axis]);
        Zones { ranges, zone: if in_zone { zone(ends.zone) } else { None } }
    }

    /// True when an axis in these zones stands anywhere.
    pub fn is_empty(&self) -> bool {
        *self == Zones::default()
    }

    /// True when the axis may stand at an angle, degrees.
    pub fn holds(&self, angle: f64) -> bool {
        self.leads(angle, angle)
    }

    /// True when each position on the way between two is one at which the axis may stand.
    pub fn leads(&self, from: f64, to: f64) -> bool {
        let (low, high) = (from.min(to), from.max(to));
        self.sets().all(|set| set.clone().next().is_none() || is_covered(set, low, high))
    }

    /// Where an axis that stands at an angle comes to the end of its zone, up or down; `None`
    /// where no zone ends within a turn.
    pub fn end(&self, from: f64, up: bool) -> Option<f64> {
        let ends = self.sets().filter_map(|set| {
            set.clone().next()?;
            let end = if up { reach(set, from) } else { -reach(set.map(|[a, b]| [-b, -a]), -from) };
            ((end - from).abs() < TURN).then_some(end)
        });
        ends.min_by(|a, b| (a - from).abs().total_cmp(&(b - from).abs()))
    }

    fn sets(
        &self,
    ) -> impl Iterator<Item = std::iter::Flatten<std::array::IntoIter<Option<Zone>, 2>>> {
        [self.ranges, [self.zone, None]].into_iter().map(|set| set.into_iter().flatten())
    }
}

/// True when zones that come again with each turn cover all from one angle to another.
fn is_covered(zones: impl Iterator<Item = Zone> + Clone, low: f64, high: f64) -> bool {
    let mut at = low;
    loop {
        let Some(end) = furthest(zones.clone(), at) else { return false };
        if end + SLACK >= high {
            return true;
        }
        if end <= at + SLACK {
            return false;
        }
        at = end;
    }
}

/// Where the zones end that hold an angle, upwards; no farther than a turn.
fn reach(zones: impl Iterator<Item = Zone> + Clone, from: f64) -> f64 {
    let mut at = from;
    while let Some(end) = furthest(zones.clone(), at).filter(|end| *end > at + SLACK) {
        at = end;
        if at - from >= TURN {
            break;
        }
    }
    at
}

/// The highest end of the zones that hold an angle; `None` where none does.
fn furthest(zones: impl Iterator<Item = Zone>, at: f64) -> Option<f64> {
    let ends = zones.filter_map(|[low, high]| {
        let turns = ((at - low + SLACK) / TURN).floor();
        let end = high + turns * TURN;
        (end + SLACK >= at).then_some(end)
    });
    ends.max_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    const AROUND_ZERO: Zones = Zones { ranges: [None; 2], zone: Some([-60.0, 60.0]) };

    #[test]
    fn a_zone_comes_again_with_each_turn() {
        for angle in [-60.0, 0.0, 60.0, 300.0, 420.0, -420.0] {
            assert!(AROUND_ZERO.holds(angle), "{angle}");
        }
        for angle in [-61.0, 61.0, 180.0, 299.0] {
            assert!(!AROUND_ZERO.holds(angle), "{angle}");
        }
    }

    #[test]
    fn no_way_leads_between_zones() {
        assert!(AROUND_ZERO.leads(310.0, 410.0) && !AROUND_ZERO.leads(50.0, 310.0));
        assert_eq!(AROUND_ZERO.end(10.0, true), Some(60.0));
        assert_eq!(AROUND_ZERO.end(370.0, false), Some(300.0));
    }

    #[test]
    fn ranges_that_meet_are_one() {
        let ranges = [Some([0.0, 90.0]), Some([90.0, 200.0])];
        let zones = Zones { ranges, zone: None };
        assert!(zones.leads(10.0, 190.0) && !zones.leads(10.0, 201.0));
        assert_eq!(zones.end(10.0, true), Some(200.0));
        assert!(Zones::default().leads(0.0, 1000.0) && Zones::default().end(0.0, true).is_none());
        let whole = Zones { ranges: [None; 2], zone: Some([0.0, 360.0]) };
        assert!(whole.leads(-100.0, 900.0) && whole.end(0.0, true).is_none());
    }
}
