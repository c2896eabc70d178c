//! The steps of a CL file, with a look at those to come.

use std::collections::VecDeque;

use fil_diag::Diag;

use super::expected_step::Step;

/// Steps one after the other.
pub(super) trait Steps: Iterator<Item = Result<Step, Box<Diag>>> {}

impl<C: Iterator<Item = Result<Step, Box<Diag>>>> Steps for C {}

/// The steps to come.
pub(super) struct Ahead<C> {
    steps: C,
    seen: VecDeque<Step>,
    /// The CL file can't be read on.
    pub(super) failed: Option<Box<Diag>>,
}

impl<C: Steps> Ahead<C> {
    pub(super) fn new(steps: C) -> Self {
        Ahead { steps, seen: VecDeque::new(), failed: None }
    }

    fn read(&mut self) -> Option<Step> {
        match self.steps.next()? {
            Ok(step) => Some(step),
            Err(diag) => {
                self.failed = Some(diag);
                None
            }
        }
    }

    pub(super) fn next(&mut self) -> Option<Step> {
        self.seen.pop_front().or_else(|| self.read())
    }

    /// The `n`th step to come, from 0.
    pub(super) fn peek(&mut self, n: usize) -> Option<&Step> {
        while self.seen.len() <= n {
            let step = self.read()?;
            self.seen.push_back(step);
        }
        self.seen.get(n)
    }
}
