//! The events of a program as far as the walk looks ahead: what it has passed is forgotten.

use std::cell::RefCell;
use std::collections::VecDeque;

use fil_diag::Diag;

use crate::events::Events;
use crate::motion::{Event, Move};

/// The events to come, each by its index from the start of the program.
pub(super) struct Window<E> {
    inner: RefCell<Inner<E>>,
}

struct Inner<E> {
    events: E,
    seen: VecDeque<Event>,
    /// Index of the first event that is kept.
    first: usize,
    ended: bool,
    /// Why the program can't be followed any more.
    refused: Option<Box<Diag>>,
    /// X of events that are read from here on is multiplied by this.
    x_scale: f64,
}

impl<E: Events> Inner<E> {
    /// Reads on until an event is there, if there is one.
    fn read_to(&mut self, index: usize) {
        while !self.ended && self.first + self.seen.len() <= index {
            let before = self.seen.len();
            match self.events.more(&mut self.seen) {
                Ok(more) => self.ended = !more,
                Err(refused) => {
                    self.refused = Some(refused);
                    self.ended = true;
                }
            }
            if self.x_scale != 1.0 {
                scale(self.seen.range_mut(before..), self.x_scale);
            }
        }
    }
}

impl<E: Events> Window<E> {
    pub(super) fn new(events: E) -> Self {
        let inner = Inner {
            events,
            seen: VecDeque::new(),
            first: 0,
            ended: false,
            refused: None,
            x_scale: 1.0,
        };
        Window { inner: RefCell::new(inner) }
    }

    /// An event that is not forgotten; `None` behind the last.
    pub(super) fn get(&self, index: usize) -> Option<Event> {
        self.look(index, |event| *event)
    }

    /// The motion that an event is, which is a long piece to copy about.
    pub(super) fn motion(&self, index: usize) -> Option<Move> {
        let motion = |event: &Event| match event {
            Event::Move(found) => Some(*found),
            _ => None,
        };
        self.look(index, motion).flatten()
    }

    /// The line of an event that is not forgotten; `None` behind the last.
    pub(super) fn line(&self, index: usize) -> Option<u32> {
        self.look(index, Event::line)
    }

    /// What an event is found to be where it lies; `at` may not ask for other events.
    pub(super) fn look<R>(&self, index: usize, at: impl FnOnce(&Event) -> R) -> Option<R> {
        let mut inner = self.inner.borrow_mut();
        let place = index.checked_sub(inner.first)?;
        if place >= inner.seen.len() {
            inner.read_to(index);
        }
        inner.seen.get(place).map(at)
    }

    /// The events from an index on.
    pub(super) fn from(&self, index: usize) -> impl Iterator<Item = Event> + '_ {
        (index..).map_while(|index| self.get(index))
    }

    /// Forgets the events before an index.
    pub(super) fn forget(&mut self, index: usize) {
        let inner = self.inner.get_mut();
        let passed = index.saturating_sub(inner.first).min(inner.seen.len());
        inner.seen.drain(..passed);
        inner.first += passed;
    }

    /// Puts other events in the place of some that were looked at.
    pub(super) fn replace(&mut self, first: usize, events: &[Event]) {
        let inner = self.inner.get_mut();
        let places = inner.seen.range_mut(first - inner.first..);
        places.zip(events).for_each(|(place, event)| *place = *event);
    }

    /// Multiplies X of the events from an index on.
    pub(super) fn scale_x(&mut self, index: usize, by: f64) {
        let inner = self.inner.get_mut();
        inner.x_scale *= by;
        let kept = index.saturating_sub(inner.first).min(inner.seen.len());
        scale(inner.seen.range_mut(kept..), by);
    }

    /// Reads what is left of the program, which nobody looks at.
    ///
    /// # Errors
    /// What the interpreter refuses, there or before.
    pub(super) fn finish(self) -> Result<E, Box<Diag>> {
        let mut inner = self.inner.into_inner();
        while !inner.ended {
            inner.seen.clear();
            inner.read_to(inner.first);
        }
        match inner.refused {
            Some(refused) => Err(refused),
            None => Ok(inner.events),
        }
    }
}

fn scale<'e>(events: impl Iterator<Item = &'e mut Event>, by: f64) {
    for event in events {
        if let Event::Move(found) = event {
            found.to.linear[0] *= by;
            if let Some(arc) = &mut found.arc {
                arc.center[0] *= by;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Course, Modes, Position};

    fn moves(count: u32) -> Vec<Event> {
        let line = |line: u32| Move {
            line,
            course: Course::Feed,
            to: Position { linear: [f64::from(line), 0.0, 0.0], ..Position::default() },
            arc: None,
            rate: None,
            in_cycle: false,
            known: [true; 5],
            to_machine: [false; 5],
            modes: Modes::default(),
        };
        (0..count).map(|at| Event::Move(line(at))).collect()
    }

    fn x(event: Option<Event>) -> Option<f64> {
        match event {
            Some(Event::Move(found)) => Some(found.to.linear[0]),
            _ => None,
        }
    }

    /// Only what lies between what is passed and what was asked for is in memory.
    #[test]
    fn what_is_passed_is_forgotten() {
        let events = moves(10_000);
        let mut window = Window::new(&events[..]);
        for index in 0..10_000 {
            window.forget(index);
            assert_eq!(x(window.get(index)), Some(index as f64));
            assert_eq!(x(window.get(index + 8)).is_some(), index + 8 < 10_000);
            assert!(window.inner.get_mut().seen.len() <= 100);
        }
        assert!(window.finish().unwrap().is_empty());
    }

    #[test]
    fn a_scale_holds_for_events_to_come() {
        let events = moves(1000);
        let mut window = Window::new(&events[..]);
        window.get(3);
        window.scale_x(2, 2.0);
        window.get(500);
        window.scale_x(500, 0.25);
        let found: Vec<Option<f64>> =
            [1, 2, 499, 500, 999].map(|index| x(window.get(index))).to_vec();
        assert_eq!(found, [1.0, 4.0, 998.0, 250.0, 499.5].map(Some));
    }
}
