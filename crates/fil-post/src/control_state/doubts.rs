//! Which last output values the control does not have, and what is known of where those
//! axes stand all the same.

use fil_machine::commons::EMPTY;
use fil_machine::{FunctionCode, Letter};

use super::Source;
use super::levels::Levels;

/// A set of letters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LetterSet(u32);

impl LetterSet {
    const ALL: LetterSet = LetterSet(u32::MAX);

    /// True when the letter is in it.
    #[inline]
    pub fn has(self, letter: Letter) -> bool {
        self.0 & 1 << letter.number() != 0
    }

    /// Adds a letter.
    #[inline]
    pub fn add(&mut self, letter: Letter) {
        self.0 |= 1 << letter.number();
    }

    /// Takes a letter out.
    #[inline]
    pub fn remove(&mut self, letter: Letter) {
        self.0 &= !(1 << letter.number());
    }

    /// True when no letter is in it.
    #[inline]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// Where an axis stands, values of the tape in mm or inch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// At this value, whoever wrote it last.
    At(f64),
    /// At one of these levels, by the position of the skip switch.
    Between(Levels),
    /// Where it stood at this value, which counts from another zero now.
    Shifted(f64),
    /// At a position of the machine that lies clear of the part.
    Clear,
    /// Nothing in this program has moved it yet.
    Unsaid,
    /// Anywhere: what came last may have moved it.
    Unknown,
    /// Anywhere, and a script has made the last output value EMPTY, which was this one.
    LeftToScript(f64),
}

/// Where an axis stands in the frame of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MachineSpot {
    /// At this value of the tape in machine coordinates (G53, M91), mm or inch.
    At(f64),
    /// At the reference point of this function (G28, G30).
    Reference(FunctionCode),
}

/// The letters in doubt.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Doubts {
    /// Their last output value may not be what the control has; the next motion says it.
    doubtful: LetterSet,
    /// Their axes may have gone anywhere.
    lost: LetterSet,
    /// Of them, those that the post's own blocks have brought there.
    lost_by_post: LetterSet,
    /// Their axes stand where they stood, and count from another zero.
    shifted: LetterSet,
    /// Of them, those whose zero an author's block has changed.
    shifted_by_author: LetterSet,
    /// A position of the machine has brought their axes clear of the part.
    clear: LetterSet,
    /// Of them, those whose position is known.
    spots: [Option<(Letter, MachineSpot)>; 5],
    /// A tool change has: it may leave them where they are, too.
    changed: LetterSet,
    /// They had a last output value before it was made EMPTY.
    had_value: LetterSet,
    /// Where axes may stand that a text, a word of REPEAT or the skip switch has moved.
    levels: [Option<Levels>; 6],
    /// Where axes stand whose last output value a script has made EMPTY.
    emptied: [Option<(Letter, f64)>; 3],
    /// What has lost the axes came back to where it began: a turning cycle of an author.
    pub(super) returned: bool,
}

impl Doubts {
    #[inline]
    pub(super) fn has(&self, letter: Letter) -> bool {
        self.doubtful.has(letter)
    }

    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.doubtful.is_empty()
    }

    /// The next motion says the letter; what is known of its axis stays.
    pub(super) fn add(&mut self, letter: Letter) {
        if !self.doubtful.has(letter) {
            self.settle(letter);
        }
        self.doubtful.add(letter);
    }

    /// All letters are said again.
    pub(super) fn add_all(&mut self) {
        Letter::all().for_each(|letter| self.add(letter));
        self.doubtful = LetterSet::ALL;
    }

    #[inline]
    pub(super) fn remove(&mut self, letter: Letter) {
        self.doubtful.remove(letter);
    }

    /// What was known of an axis beside its last output value counts no longer.
    pub(super) fn settle(&mut self, letter: Letter) {
        for set in [&mut self.lost, &mut self.shifted, &mut self.clear, &mut self.changed] {
            set.remove(letter);
        }
        self.set_levels(letter, None);
        let is_its = |slot: &&mut Option<_>| slot.is_some_and(|(other, _)| other == letter);
        self.spots.iter_mut().filter(is_its).for_each(|slot| *slot = None);
    }

    /// The axis may have gone anywhere.
    pub(super) fn lose(&mut self, letter: Letter) {
        self.add(letter);
        self.settle(letter);
        self.lost.add(letter);
        self.lost_by_post.remove(letter);
    }

    /// The same by a block of the post.
    pub(super) fn lose_by_post(&mut self, letter: Letter) {
        self.lose(letter);
        self.lost_by_post.add(letter);
    }

    /// True where the post itself has made the position of an axis unknown.
    pub(super) fn is_lost_by_post(&self, letter: Letter) -> bool {
        self.lost_by_post.has(letter)
    }

    /// The axis has not moved, and counts from another zero.
    pub(super) fn shift(&mut self, letter: Letter, by: Source) {
        self.add(letter);
        match by {
            Source::Author if !self.shifted.has(letter) => self.shifted_by_author.add(letter),
            Source::Author => {}
            _ => self.shifted_by_author.remove(letter),
        }
        let is_exact = self.levels_of(letter).is_none_or(|levels| levels.exact().is_some());
        if is_exact { self.shifted.add(letter) } else { self.lose(letter) }
    }

    /// True where an author's block alone has given the axis another zero.
    pub(super) fn is_shifted_by_author(&self, letter: Letter) -> bool {
        self.shifted_by_author.has(letter)
    }

    /// The tool has another length. Behind a tool change the values are those of its tip
    /// again.
    pub(super) fn shift_by_length(&mut self, letter: Letter) {
        if self.is_clear(letter) {
            self.add(letter);
        } else {
            self.shift(letter, Source::Author);
        }
    }

    /// A position of the machine, which may be known, has brought the axis clear of the part.
    pub(super) fn clears(&mut self, letter: Letter, spot: Option<MachineSpot>) {
        self.add(letter);
        self.settle(letter);
        self.clear.add(letter);
        if let Some(free) = self.spots.iter_mut().find(|slot| slot.is_none()) {
            *free = spot.map(|spot| (letter, spot));
        }
        self.had_value.add(letter);
        let is_its =
            |slot: &&mut Option<(Letter, f64)>| slot.is_some_and(|(other, _)| other == letter);
        if let Some(slot) = self.emptied.iter_mut().find(is_its) {
            *slot = None;
        }
    }

    /// Where the axis stands in the frame of the machine, if it is known.
    pub(super) fn spot(&self, letter: Letter) -> Option<MachineSpot> {
        let spots = self.spots.iter().flatten().filter(|_| self.has(letter));
        spots.filter(|(other, _)| *other == letter).map(|(_, spot)| *spot).next()
    }

    /// True where a position of the machine or a tool change has brought the axis away from
    /// the part, and nothing has moved it since.
    pub(super) fn is_clear(&self, letter: Letter) -> bool {
        self.has(letter) && (self.clear.has(letter) || self.changed.has(letter))
    }

    /// A tool change may have brought the axis clear of the part.
    pub(super) fn changes(&mut self, letter: Letter) {
        let stood = self.place_of_doubt(letter);
        self.add(letter);
        self.settle(letter);
        let set = if stood { &mut self.clear } else { &mut self.changed };
        set.add(letter);
    }

    /// Before a tool change the axis did not stand where its last output value says.
    fn place_of_doubt(&self, letter: Letter) -> bool {
        let elsewhere = [self.lost, self.shifted, self.clear].iter().any(|set| set.has(letter));
        self.has(letter) && (elsewhere || self.levels_of(letter).is_some())
    }

    /// The axis stands at this value, which is not its last output value.
    pub(super) fn stand(&mut self, letter: Letter, value: f64) {
        self.add(letter);
        self.settle(letter);
        self.set_levels(letter, Some(Levels::of(letter, value)));
    }

    /// An axis that had a last output value, or whose place was known otherwise, has moved.
    pub(super) fn remember(&mut self, letter: Letter, last: f64) {
        if last != EMPTY || self.levels_of(letter).is_some() {
            self.had_value.add(letter);
        }
    }

    /// A script makes the last output value of a letter EMPTY: the axis stays where it is.
    pub(super) fn empty(&mut self, letter: Letter, last: f64) {
        self.had_value.add(letter);
        let free =
            |slot: &&mut Option<(Letter, f64)>| slot.is_none_or(|(other, _)| other == letter);
        if let Some(slot) = self.emptied.iter_mut().find(free) {
            *slot = Some((letter, last));
        }
    }

    /// The axis stands at one of these levels; where the zero has changed too, they can't be
    /// compared with anything.
    pub(super) fn stand_between(&mut self, levels: Levels) {
        let unknown = levels.unknown || self.shifted.has(levels.letter);
        self.settle(levels.letter);
        self.set_levels(levels.letter, Some(Levels { unknown, ..levels }));
    }

    fn set_levels(&mut self, letter: Letter, levels: Option<Levels>) {
        let is_its = |slot: &&mut Option<Levels>| slot.is_some_and(|other| other.letter == letter);
        if let Some(slot) = self.levels.iter_mut().find(is_its) {
            *slot = levels;
        } else if levels.is_some() {
            match self.levels.iter_mut().find(|slot| slot.is_none()) {
                Some(slot) => *slot = levels,
                None => self.lost.add(letter),
            }
        }
    }

    pub(super) fn levels_of(&self, letter: Letter) -> Option<Levels> {
        self.levels.iter().flatten().find(|levels| levels.letter == letter).copied()
    }

    /// Where the axis of a letter stands; `last` is its last output value.
    pub(super) fn place(&self, letter: Letter, last: f64) -> Place {
        if !self.has(letter) {
            let stands = self.before_empty(letter, last);
            return if stands == EMPTY { Place::Unsaid } else { Place::At(stands) };
        }
        let levels = self.levels_of(letter);
        let exact = levels.and_then(Levels::exact);
        let value = exact.unwrap_or_else(|| self.before_empty(letter, last));
        let unsaid = value == EMPTY && levels.is_none();
        if self.lost.has(letter) {
            if last == EMPTY && self.before_empty(letter, last) != EMPTY {
                return Place::LeftToScript(value);
            }
            let never = unsaid && !self.had_value.has(letter);
            return if never { Place::Unsaid } else { Place::Unknown };
        }
        if self.clear.has(letter) || self.changed.has(letter) && self.shifted.has(letter) {
            return Place::Clear;
        }
        match levels {
            _ if unsaid => Place::Unsaid,
            _ if self.shifted.has(letter) => Place::Shifted(value),
            Some(levels) if exact.is_none() => Place::Between(levels),
            _ => Place::At(value),
        }
    }

    /// The value at which an axis stands, where nothing leaves a doubt of it.
    #[inline]
    pub(super) fn known(&self, letter: Letter, last: f64) -> Option<f64> {
        if !self.has(letter) && last != EMPTY {
            return Some(last);
        }
        let may_have_moved = self.has(letter) && self.changed.has(letter);
        match self.place(letter, last) {
            Place::At(value) if !may_have_moved => Some(value),
            _ => None,
        }
    }

    /// A last output value, or that from before a script made it EMPTY.
    pub(super) fn before_empty(&self, letter: Letter, last: f64) -> f64 {
        let emptied = || self.emptied.iter().flatten().find(|(other, _)| *other == letter);
        if last != EMPTY { last } else { emptied().map_or(EMPTY, |(_, value)| *value) }
    }

    /// All doubts of both: either may be in force.
    pub(super) fn or(&mut self, other: &Doubts) {
        self.doubtful.0 |= other.doubtful.0;
        self.lost.0 |= other.lost.0;
        self.lost_by_post.0 |= other.lost_by_post.0;
        self.shifted_by_author.0 &= other.shifted_by_author.0;
        self.shifted.0 |= other.shifted.0;
        self.clear.0 &= other.clear.0;
        self.spots
            .iter_mut()
            .filter(|slot| !other.spots.contains(slot))
            .for_each(|slot| *slot = None);
        self.changed.0 &= other.changed.0;
        self.had_value.0 |= other.had_value.0;
    }
}
