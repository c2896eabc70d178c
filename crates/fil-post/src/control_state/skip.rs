//! Blocks that may be skipped: what holds behind them with those blocks and without.

use fil_machine::{Commons, Letter};

use super::ControlState;
use super::doubts::Place;
use super::levels::Levels;
use super::modal::CYCLE;

impl ControlState {
    /// The blocks from here on may be skipped.
    pub fn skip_begins(&mut self, commons: &Commons) {
        let before = (self.clone(), last_values(commons));
        self.before_skip = Some(Box::new(before));
    }

    /// The blocks that may be skipped are over: what they changed is unknown. Of X, Y and Z and
    /// of the rotary axes the positions with those blocks and without are kept. Of
    /// two levels of Z the lower one counts as the last value, so that a rapid motion goes
    /// up before it goes across; on an axis that counts downwards the higher one does.
    pub fn skip_ends(
        &mut self,
        commons: &mut Commons,
        (linear, rotary): ([Letter; 3], &[Letter]),
        z_counts_down: bool,
    ) {
        let Some(before) = self.before_skip.take() else { return };
        let (state, values) = *before;
        let now = last_values(commons);
        let levels = |letter: Letter| {
            let at = |state: &ControlState, values: &[f64]| match state
                .place(letter, values[letter.index() - 1])
            {
                Place::At(value) | Place::Shifted(value) => Levels::of(letter, value),
                Place::Between(levels) => levels,
                _ => Levels::unknown(letter),
            };
            at(self, &now).or(at(&state, &values))
        };
        let of_linear = linear.map(levels);
        let of_rotary: Vec<Levels> = rotary.iter().map(|letter| levels(*letter)).collect();
        for (letter, (now, then)) in Letter::all().zip(now.iter().zip(values)) {
            if *now != then {
                self.doubt(letter);
            }
        }
        if let Some(last) = of_linear[2].lowest(z_counts_down) {
            commons.set_last_output(linear[2], last);
        }
        self.agree_with(&state);
        for levels in of_linear.into_iter().chain(of_rotary).filter_map(Levels::in_doubt) {
            self.doubts.stand_between(levels);
        }
    }

    /// A canned cycle is in force where the blocks that may be skipped are left out.
    pub fn was_in_cycle(&self) -> bool {
        self.before_skip.as_ref().is_some_and(|then| then.0.is(CYCLE, true))
    }

    /// True while blocks may be skipped.
    pub fn may_be_skipped(&self) -> bool {
        self.before_skip.is_some()
    }

    /// Keeps what is the same in another state; the rest depends on block delete.
    pub(super) fn agree_with(&mut self, other: &ControlState) {
        self.groups.join(&other.groups);
        self.doubts.or(&other.doubts);
    }
}

fn last_values(commons: &Commons) -> [f64; Letter::COUNT] {
    let mut values = [0.0; Letter::COUNT];
    for (value, letter) in values.iter_mut().zip(Letter::all()) {
        *value = commons.last_output(letter);
    }
    values
}
