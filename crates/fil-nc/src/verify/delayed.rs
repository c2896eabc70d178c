//! Modes that a post may bring into force with a motion after the word that asks for them.

use super::settings::Due;

/// What must be in force of a modal group: one value, either of two while a word waits for its
/// motion, or any (`None`).
#[derive(Clone, Copy, Debug)]
pub(super) struct DelayedMode<T> {
    now: Option<T>,
    next: Option<(Option<T>, Due)>,
}

impl<T: Copy> DelayedMode<T> {
    pub(super) fn new(now: Option<T>) -> Self {
        DelayedMode { now, next: None }
    }

    pub(super) fn set(&mut self, value: Option<T>, due: Due) {
        if due == Due::Now {
            *self = DelayedMode::new(value);
        } else {
            self.next = Some((value, due));
        }
    }

    /// Asks for a value that is known.
    pub(super) fn require(&mut self, value: T, due: Due) {
        self.set(Some(value), due);
    }

    /// What must be in force without the word that waits.
    pub(super) fn now(&self) -> Option<T> {
        self.now
    }

    /// A word waits for its motion.
    pub(super) fn waits(&self) -> bool {
        self.next.is_some()
    }

    /// What was asked for last.
    pub(super) fn asked(&self) -> Option<T> {
        self.next.map_or(self.now, |(value, _)| value)
    }

    pub(super) fn flush(&mut self) {
        if let Some((value, _)) = self.next.take() {
            self.now = value;
        }
    }

    pub(super) fn moved(&mut self, moved: Moved) {
        let due = self.next.is_some_and(|(_, due)| match due {
            Due::Now => true,
            Due::WithXY => moved.xy,
            Due::InPlane => moved.in_plane,
            Due::WithAny => moved.xy || moved.z,
            Due::WithZ => moved.z,
        });
        if due {
            self.flush();
        }
    }

    /// The value that must be, when `found` holds of none that may be.
    pub(super) fn refuses(&self, found: impl Fn(T) -> bool) -> Option<T> {
        let is_right = |may: Option<T>| may.is_none_or(&found);
        let right = is_right(self.now) || self.next.is_some_and(|(next, _)| is_right(next));
        if right { None } else { self.asked() }
    }
}

/// Which axes a motion moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Moved {
    pub(super) xy: bool,
    pub(super) z: bool,
    /// One of the axes of the plane in force.
    pub(super) in_plane: bool,
}
