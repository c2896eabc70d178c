//! A learned post against further pairs.

use std::fmt::Write as _;
use std::sync::Arc;

use filpost::{Diag, Error, RunCode, settings};

use crate::bases::{Base, Bases};
use crate::change::Machine;
use crate::learned::{LearnedPair, compare};
use crate::task::Task;
use crate::trial::Bench;

/// What further pairs say of a learned post.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The pairs, in their order.
    pub pairs: Vec<LearnedPair>,
    /// Undecided settings with which another program comes out: these pairs decide them.
    pub decided: Vec<String>,
    /// Those with which a program comes nearer to the proven one than it is.
    pub better: Vec<String>,
    /// How many stay undecided.
    pub undecided: usize,
}

impl Checked {
    /// Every program comes out byte for byte.
    pub fn is_equal(&self) -> bool {
        self.pairs.iter().all(|pair| pair.is_equal)
    }

    /// As text.
    pub fn report(&self) -> String {
        let mut text = String::new();
        for pair in &self.pairs {
            let _ = writeln!(text, "{}", pair.summary());
            text.push_str(&pair.differences(usize::MAX));
        }
        let mut list = |title: &str, settings: &[String]| {
            if !settings.is_empty() {
                let _ = writeln!(text, "{title}");
                settings.iter().for_each(|setting| {
                    text.push_str(&format!("  {}\n", setting.replace('\n', " and ")))
                });
            }
        };
        list("nearer to the proven program with:", &self.better);
        list("decided by these pairs; remove from learned.undecided:", &self.decided);
        let _ = writeln!(text, "undecided: {}", self.undecided);
        text
    }
}

/// See [`crate::check`].
pub(crate) fn check(task: &Task<'_>) -> Result<Checked, Error> {
    let Bases::Given { title, program } = &task.bases else {
        let diag = Diag::new(RunCode::NoPost, "a check needs the post that was learned");
        return Err(Error::Setup(vec![diag]));
    };
    let base =
        Base { title: title.clone(), post: None, options: Vec::new(), program: program.clone() };
    let bench = Bench::new(task);
    let refused = || {
        let diag = Diag::new(RunCode::NoPost, format!("{title} can't be run"));
        Error::Setup(vec![diag])
    };
    let state = bench.state(Machine::new(Arc::new(base))).ok_or_else(refused)?;
    let mut checked = Checked {
        pairs: (0..bench.pairs.len()).map(|at| compare(&bench, &state, at)).collect(),
        decided: Vec::new(),
        better: Vec::new(),
        undecided: 0,
    };
    for setting in program.commons().undecided() {
        let mut commons = program.commons().clone();
        let applied = settings::apply_setting(&mut commons, setting);
        let other = applied.ok().and_then(|_| program.with_machine(commons).ok());
        let Some(other) = other else { continue };
        let (mut differs, mut distance) = (false, 0.0);
        for at in 0..bench.pairs.len() {
            let (own, score) = bench.compare(&other, at);
            differs |= own.as_ref().map(|cut| &cut.bytes)
                != state.programs[at].as_ref().map(|cut| &cut.bytes);
            distance += score;
        }
        match differs {
            false => checked.undecided += 1,
            true if distance < state.distance() => checked.better.push(setting.clone()),
            true => checked.decided.push(setting.clone()),
        }
    }
    Ok(checked)
}
