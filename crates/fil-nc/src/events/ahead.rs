//! Events made in a thread of their own, ahead of what looks at them: to interpret a program
//! takes about as long as to compare it. Where the system has no threads, as in WebAssembly, and
//! for a short program they are made when they are asked for.

use std::collections::VecDeque;
use std::sync::mpsc::{self, Receiver, SendError, Sender, SyncSender};
use std::thread;

use fil_diag::Diag;

use super::Events;
use crate::motion::Event;

/// Events that are made before a thread is begun: a short program is over by then.
const FIRST: usize = 256;

/// Events that go from one thread to the other at once.
const BATCH: usize = 128;

/// Batches that wait at most.
const WAITING: usize = 8;

/// What comes behind the events of a batch: more, the end, or a refusal.
type More = Result<bool, Box<Diag>>;

type Batch = (VecDeque<Event>, More);

/// Calls `compare` with the same events, made in a thread of their own where that is worth it.
pub fn ahead<E: Events + Send, R>(mut events: E, compare: impl FnOnce(&mut dyn Events) -> R) -> R {
    let first = batch(&mut events, VecDeque::new(), FIRST);
    if !matches!(first.1, Ok(true)) {
        return compare(&mut Ready::<E> { batch: Some(first), rest: Rest::Over });
    }
    thread::scope(|scope| {
        let (to, from) = mpsc::sync_channel(WAITING);
        let (give_back, given_back) = mpsc::channel();
        let (give, given) = mpsc::channel();
        let begun = thread::Builder::new().spawn_scoped(scope, move || {
            if let Ok(events) = given.recv() {
                make(events, &to, &given_back);
            }
        });
        // Where no thread has begun, what was to be given to it comes back.
        let rest = match give.send(events) {
            Ok(()) if begun.is_ok() => Rest::Made { from, give_back },
            Ok(()) => Rest::Over,
            Err(SendError(events)) => Rest::Unmade(events),
        };
        compare(&mut Ready { batch: Some(first), rest })
    })
}

/// Makes events until nobody wants more of them.
fn make<E: Events>(mut events: E, to: &SyncSender<Batch>, given_back: &Receiver<VecDeque<Event>>) {
    loop {
        let memory = given_back.try_recv().unwrap_or_default();
        let made = batch(&mut events, memory, BATCH);
        let over = !matches!(made.1, Ok(true));
        if to.send(made).is_err() || over {
            return;
        }
    }
}

/// The next events, in memory that is used again.
fn batch<E: Events>(events: &mut E, mut made: VecDeque<Event>, count: usize) -> Batch {
    loop {
        let more = events.more(&mut made);
        if !matches!(more, Ok(true)) || made.len() >= count {
            return (made, more);
        }
    }
}

/// Events of which the first are there.
struct Ready<E> {
    batch: Option<Batch>,
    rest: Rest<E>,
}

/// Where the events behind the first come from.
enum Rest<E> {
    /// From a thread, which gets the memory back.
    Made { from: Receiver<Batch>, give_back: Sender<VecDeque<Event>> },
    /// From here.
    Unmade(E),
    /// All have been handed out.
    Over,
}

impl<E: Events> Events for Ready<E> {
    fn more(&mut self, into: &mut VecDeque<Event>) -> More {
        if let Some((mut events, more)) = self.batch.take() {
            into.append(&mut events);
            return more;
        }
        match &mut self.rest {
            Rest::Made { from, give_back } => {
                // A thread that ends without saying so has panicked, which goes on in this one.
                let Ok((mut events, more)) = from.recv() else { return Ok(false) };
                into.append(&mut events);
                // It may have ended, and needs no memory then.
                let _ = give_back.send(events);
                more
            }
            Rest::Unmade(events) => events.more(into),
            Rest::Over => Ok(false),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::errors::NcCode;

    /// Dwells, then the end or a refusal.
    struct Dwells {
        made: u32,
        count: u32,
        refused: bool,
    }

    impl Events for Dwells {
        fn more(&mut self, into: &mut VecDeque<Event>) -> More {
            if self.made == self.count {
                return match self.refused {
                    true => Err(Box::new(Diag::new(NcCode::NoFeed, "no feed"))),
                    false => Ok(false),
                };
            }
            self.made += 1;
            into.push_back(Event::Dwell { line: self.made, seconds: None, turns: None });
            Ok(true)
        }
    }

    fn lines(count: u32, refused: bool) -> (Vec<u32>, bool) {
        let (mut seen, mut all) = (VecDeque::new(), Vec::new());
        let end = ahead(Dwells { made: 0, count, refused }, |events| {
            loop {
                let more = events.more(&mut seen);
                all.extend(seen.drain(..).map(|event| event.line()));
                if !matches!(more, Ok(true)) {
                    return more.is_err();
                }
            }
        });
        (all, end)
    }

    #[test]
    fn the_same_events_come_in_their_order_up_to_the_end_or_the_refusal() {
        for count in [0, 1, 255, 256, 257, 383, 384, 385, 100_000] {
            for refused in [false, true] {
                assert_eq!(lines(count, refused), ((1..=count).collect(), refused), "{count}");
            }
        }
    }

    #[test]
    fn who_wants_no_more_events_waits_for_none() {
        let endless = Dwells { made: 0, count: u32::MAX, refused: false };
        let mut seen = VecDeque::new();
        ahead(endless, |events| {
            for _ in 0..5 {
                assert!(events.more(&mut seen).unwrap());
            }
        });
        assert!(seen.len() >= FIRST + 4 * BATCH);
    }

    #[test]
    #[should_panic(expected = "panicked")]
    fn what_panics_in_the_thread_is_no_end() {
        struct Panics(u32);
        impl Events for Panics {
            fn more(&mut self, into: &mut VecDeque<Event>) -> More {
                self.0 += 1;
                assert!(self.0 < 1_000, "it panicked");
                into.push_back(Event::Dwell { line: self.0, seconds: None, turns: None });
                Ok(true)
            }
        }
        let mut seen = VecDeque::new();
        ahead(Panics(0), |events| while matches!(events.more(&mut seen), Ok(true)) {});
    }
}
