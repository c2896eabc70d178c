//! States that a post may bring into force with a motion behind the word that asks for them.

use super::settings::Due;

/// A state that may change with a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lag<T> {
    pub(super) now: T,
    pub(super) next: Option<(T, Due)>,
}

impl<T: Copy + PartialEq> Lag<T> {
    pub(super) fn new(now: T) -> Self {
        Lag { now, next: None }
    }

    pub(super) fn set(&mut self, value: T, due: Due) {
        if due == Due::Now {
            *self = Lag::new(value);
        } else {
            self.next = Some((value, due));
        }
    }

    /// What was asked for last.
    pub(super) fn asked(&self) -> T {
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

    /// The state that must be, when `found` is not among those that may be.
    pub(super) fn refuses(&self, found: impl Fn(T) -> bool) -> Option<T> {
        let next = self.next.map(|(value, _)| value);
        let right = found(self.now) || next.is_some_and(&found);
        (!right).then_some(next.unwrap_or(self.now))
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
