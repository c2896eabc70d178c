//! Positions of rotary axes within one turn: where the axis goes on from where it stands.

use super::Fault;
use super::state::State;
use crate::dialect::WayRound;
use crate::errors::NcCode;

/// Degrees of a full turn.
const FULL: f64 = 360.0;

/// Positions nearer than this are one, degrees.
const SAME: f64 = 1e-6;

impl State<'_> {
    /// Where a word within a turn brings an axis, degrees over any number of turns.
    pub(super) fn turned(&self, axis: usize, value: f64, way: WayRound) -> f64 {
        let (value, way) = match way {
            WayRound::BySign { minus_at_zero } => {
                let zero = value == 0.0 && minus_at_zero;
                let in_minus = value.is_sign_negative() || zero;
                (value.abs(), if in_minus { WayRound::Minus } else { WayRound::Plus })
            }
            way => (value, way),
        };
        let position = self.position(axis, value);
        if !self.known[axis] {
            return position;
        }
        let counts_back = self.dialect.axes[axis].scale.is_some_and(|scale| scale.way(1.0) < 0.0);
        let plus = match way {
            WayRound::Plus => Some(!counts_back),
            WayRound::Minus => Some(counts_back),
            _ => None,
        };
        let ahead = (position - self.at[axis]).rem_euclid(FULL);
        let ahead = if FULL - ahead < SAME { ahead - FULL } else { ahead };
        let turn = match plus {
            Some(true) => ahead,
            Some(false) if ahead > SAME => ahead - FULL,
            None if 2.0 * ahead > FULL => ahead - FULL,
            _ => ahead,
        };
        // The position itself, with whole turns: sums would leave their rounding in it.
        position + FULL * ((self.at[axis] + turn - position) / FULL).round()
    }

    /// Refuses half a turn the shortest way: which of the two that is, is left open.
    pub(super) fn check_way_round(
        &self,
        axis: usize,
        way: Option<WayRound>,
        from: f64,
        to: f64,
    ) -> Result<(), Fault> {
        if way != Some(WayRound::Shortest) || ((to - from).abs() - 180.0).abs() > SAME {
            return Ok(());
        }
        let letter = char::from(b'A' - 1 + self.dialect.axes[axis].letter);
        let message =
            format!("{letter} moves by 180 degrees, and both directions are equally short");
        Err(Fault::new(NcCode::NoMeaning, message))
    }

    /// The same for all rotary axes after a block that began with them there.
    pub(super) fn check_ways_round(
        &self,
        stood: &[f64; 5],
        known: &[bool; 5],
    ) -> Result<(), Fault> {
        for axis in (3..5).filter(|axis| known[*axis] && self.known[*axis]) {
            let way = self.dialect.axes[axis].way_round;
            self.check_way_round(axis, way, stood[axis], self.at[axis])?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use fil_machine::files::apply_setting;
    use fil_machine::locations::default_commons;

    use super::super::events;
    use crate::dialect::Dialect;
    use crate::motion::Event;

    /// Where the words of A lead on a machine with these settings.
    fn angles(settings: &[&str], words: &str) -> Result<Vec<f64>, String> {
        let mut commons = default_commons();
        let table = ["rotary.primary_kind=1", "rotary.primary_axis=1"];
        for setting in table.iter().chain(settings) {
            apply_setting(&mut commons, setting).unwrap();
        }
        let blocks: String = words.split(' ').map(|word| format!("G0 {word}\n")).collect();
        let program = format!("%\nG21 G90\n{blocks}M30\n%\n");
        let dialect = Dialect::new(&commons).unwrap();
        let events = events(program.as_bytes(), "test", &dialect).map_err(|d| d.message)?;
        let angle = |event: &Event| match event {
            Event::Move(found) => Some(found.to.rotary[0]),
            _ => None,
        };
        Ok(events.iter().filter_map(angle).collect())
    }

    #[test]
    fn the_sign_is_the_way_round() {
        let signed = ["rotary.output=1"];
        assert_eq!(
            angles(&signed, "A350. A10. A-350. A-360. A360. A-90. A90.").unwrap(),
            [350.0, 370.0, 350.0, 0.0, 0.0, -270.0, -270.0]
        );
        assert_eq!(angles(&signed, "A10. A0. A-10.").unwrap(), [10.0, 360.0, 10.0]);
        let minus = ["rotary.output=1", "rotary.zero_sign=2"];
        assert_eq!(angles(&minus, "A10. A0.").unwrap(), [10.0, 0.0]);
    }

    #[test]
    fn other_ways_round() {
        assert_eq!(
            angles(&["rotary.output=2"], "A350. A10. A350.").unwrap(),
            [350.0, 370.0, 350.0]
        );
        let half = angles(&["rotary.output=2"], "X0.A10. X1.A190.").unwrap_err();
        assert!(half.contains("equally short"), "{half}");
        // Alone, away from the part, either way leads there.
        assert_eq!(angles(&["rotary.output=2"], "A10. A190.").unwrap(), [10.0, 190.0]);
        assert_eq!(
            angles(&["rotary.output=4"], "A350. A10. A350.").unwrap(),
            [350.0, 370.0, 710.0]
        );
        assert_eq!(angles(&[], "A350. A10. A370.").unwrap(), [350.0, 10.0, 370.0]);
        // An axis with travel counts on.
        let travel = ["rotary.output=1", "rotary.primary_min=-400", "rotary.primary_max=400"];
        assert_eq!(angles(&travel, "A350. A-10.").unwrap(), [350.0, -10.0]);
    }
}
