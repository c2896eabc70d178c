//! The search: base, readings, rounds over all candidates, texts, exchange, rebase.

#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::sync::Arc;

use filpost::{Diag, Error};

use crate::bases::{Base, Bases, Built};
use crate::candidates::{self, Alternatives};
use crate::change::{self, Changes, Key, Machine};
use crate::facts::Facts;
use crate::learned::Learned;
use crate::noted::{Noted, Reach};
use crate::task::Task;
use crate::texts;
use crate::trial::{Bench, LEAST_GAIN, State, Trial};
use crate::undecided;
use crate::{positions, readings};

/// Most rounds over all candidates.
const ROUNDS: usize = 8;

/// Most rounds over settings before texts are tried.
const SETTING_ROUNDS: usize = 2;

/// Bases of which a first round is made.
const FIRST_ROUND: usize = 4;

/// A base is near enough where its distance is below twice that of the best and this.
const NEAR: f64 = 20.0;

/// Bases whose programs are read in detail.
const READ_OFF: usize = 6;

/// Bases that go on after it.
const WHOLE_SEARCH: usize = 2;

/// Most pairs of changes that are tried where single ones do not help.
const MOST_PAIRS: usize = 1500;

/// See [`crate::learn`].
pub(crate) fn learn(task: &Task<'_>) -> Result<Learned, Error> {
    let bench = Bench::new(task);
    let alternatives = Alternatives::new(&task.keep, candidates::ready_posts(&bench));
    let built = Built::new(&task.fil);
    let search = Search { bench: &bench, task, alternatives, built };
    let bases = search.bases()?;
    let mut states = search.starts(&bases);
    if states.is_empty() {
        return Err(no_base(&bases));
    }
    let near = 2.0 * states[0].distance() + NEAR;
    states.retain(|state| state.distance() <= near);
    states.truncate(FIRST_ROUND);
    let mut begun: Vec<State> = Vec::new();
    for state in states {
        begun.push(search.round(state));
        if begun.last().is_some_and(State::is_equal) {
            break;
        }
    }
    begun.sort_by(|a, b| a.score.total_cmp(&b.score));
    begun.sort_by_key(|state| !state.is_equal());
    begun.truncate(WHOLE_SEARCH);
    let mut best: Option<State> = None;
    for state in begun {
        let state = if state.is_equal() { state } else { search.rounds(state) };
        if best.as_ref().is_none_or(|best| state.score < best.score - LEAST_GAIN) {
            best = Some(state);
        }
        if best.as_ref().is_some_and(State::is_equal) {
            break;
        }
    }
    let Some(best) = best else { return Err(no_base(&bases)) };
    let best = search.rebase(search.take_back(best), &bases);
    let (best, others) = search.explain(best);
    // A better explanation may do without what was put before it.
    let best = search.take_back(best);
    let undecided = undecided::find(&bench, &search.alternatives, &best, &others);
    Ok(Learned::new(&bench, best, undecided))
}

fn no_base(bases: &[Arc<Base>]) -> Error {
    let names: Vec<&str> = bases.iter().map(|base| base.title.as_str()).collect();
    let message = format!("no base posts these CL files: {}", names.join(", "));
    let hint = "Post one of them with `filpost post -p POST`: it says what is refused.";
    Error::Setup(vec![Diag::new(filpost::RunCode::NoPost, message).hint(hint)])
}

struct Search<'s, 't> {
    bench: &'s Bench<'t>,
    task: &'s Task<'t>,
    alternatives: Alternatives,
    built: Built<'s>,
}

impl Search<'_, '_> {
    fn bases(&self) -> Result<Vec<Arc<Base>>, Error> {
        match &self.task.bases {
            Bases::Given { title, program } => {
                let (title, program) = (title.clone(), program.clone());
                Ok(vec![Arc::new(Base { title, post: None, options: Vec::new(), program })])
            }
            Bases::Ready(names) => {
                let build = |at: usize| {
                    Some(Base::ready(&names[at], Vec::new(), &self.task.fil).map(Arc::new))
                };
                let built = self.bench.in_threads(names.len(), None, build).into_iter().flatten();
                match names.len() {
                    1 => built.collect(),
                    _ => Ok(built.filter_map(Result::ok).collect()),
                }
            }
        }
    }

    /// Each base, and each with one option changed, with what is read off; the best first, of
    /// those that make the same programs one.
    fn starts(&self, bases: &[Arc<Base>]) -> Vec<State> {
        let machines: Vec<Machine> =
            bases.iter().map(|base| Machine::new(Arc::clone(base))).collect();
        let mut states: Vec<State> = self.bench.states(&machines).into_iter().flatten().collect();
        let readings: Vec<Machine> =
            states.iter().map(|state| self.read_at_once(&state.machine)).collect();
        states.extend(self.bench.states(&readings).into_iter().flatten());
        states.sort_by(|a, b| a.score.total_cmp(&b.score));
        let mut posts: Vec<String> = Vec::new();
        states.retain(|state| {
            let title = &state.machine.base.title;
            let is_new = !posts.contains(title);
            posts.push(title.clone());
            is_new
        });
        states.truncate(READ_OFF);
        // An option that helps now may hide what helps more: without it, too.
        let mut states: Vec<State> = states.into_iter().map(|state| self.read_off(state)).collect();
        let with_options: Vec<State> =
            states.iter().map(|state| self.options(state.clone())).collect();
        states.extend(with_options);
        states.sort_by(|a, b| a.score.total_cmp(&b.score));
        let mut kept: Vec<State> = Vec::new();
        for state in states {
            let bytes = |state: &State| -> Vec<Option<Vec<u8>>> {
                state.programs.iter().map(|cut| cut.as_ref().map(|cut| cut.bytes.clone())).collect()
            };
            if !kept.iter().any(|other| bytes(other) == bytes(&state)) {
                kept.push(state);
            }
        }
        self.bench.tell("bases", kept.first().map_or(0.0, State::distance));
        kept
    }

    /// Options of the post, one after the other, as long as that helps.
    fn options(&self, mut state: State) -> State {
        loop {
            let others = state.machine.base.with_other_options(&self.built);
            let machines: Vec<Machine> =
                others.iter().map(|base| state.machine.over(base)).collect();
            let trials = self.bench.attempt_all(&machines, &state);
            match self.best_of(&machines, &trials) {
                Some(better) => state = self.read_off(better),
                None => return state,
            }
        }
    }

    /// The best of some machines, if one is better than the state that they were tried against.
    fn best_of(&self, machines: &[Machine], trials: &[Trial]) -> Option<State> {
        let (_, at) = better(trials).min_by(|a, b| a.0.total_cmp(&b.0))?;
        self.bench.state(machines[at].clone())
    }

    /// A machine with what can be read off the text, the first of each kind.
    fn read_at_once(&self, machine: &Machine) -> Machine {
        let mut read = machine.clone();
        let Some(commons) = machine.commons() else { return read };
        let mut taken: BTreeSet<Key> = BTreeSet::new();
        for changes in readings::readings(self.bench, &commons) {
            if changes.iter().all(|(key, _)| taken.insert(*key)) {
                read = read.with(&changes);
            }
        }
        read
    }

    /// Candidates over a state, without those of settings that do not act. `least` says what they
    /// may do at least.
    fn candidates(&self, state: &State, least: Reach) -> Vec<Changes> {
        let Some(commons) = state.machine.commons() else { return Vec::new() };
        let Some(noted) = Noted::new(self.bench, state) else { return Vec::new() };
        let reaches = |index: usize| noted.reach(index) >= least;
        let probes = self.alternatives.probes(&commons, reaches);
        let machines: Vec<Machine> = probes.iter().map(|probe| state.machine.with(probe)).collect();
        let trials = self.bench.attempt_all(&machines, state);
        let acting = probes.iter().zip(trials).filter(|(_, trial)| *trial != Trial::Inert);
        let acting: BTreeSet<usize> = acting
            .filter_map(|(probe, _)| match probe.first() {
                Some((Key::Setting(index), _)) => Some(*index),
                _ => None,
            })
            .collect();
        let facts = Facts::new(self.bench, state);
        let mut candidates = self.alternatives.all(&commons, &facts, &acting, reaches);
        candidates.extend(positions::proposals(self.bench, state));
        candidates
    }

    /// Takes what can be read off the text, each part as long as it helps.
    fn read_off(&self, mut state: State) -> State {
        for _ in 0..2 {
            let Some(commons) = state.machine.commons() else { return state };
            let before = state.score;
            let readings = readings::readings(self.bench, &commons);
            self.put_in_order(&mut state, &readings);
            if state.score > before - LEAST_GAIN {
                break;
            }
        }
        state
    }

    /// Makes changes if they help.
    fn put(&self, state: &mut State, changes: &Changes) -> bool {
        let machine = state.machine.with(changes);
        if machine.changes == state.machine.changes {
            return false;
        }
        if let Trial::Better(_) = self.bench.attempt(&machine, state)
            && let Some(better) = self.bench.state(machine)
        {
            *state = better;
            return true;
        }
        false
    }

    /// All candidates, each alone; then the better ones, best first, each over those before.
    fn round(&self, mut state: State) -> State {
        // Settings before texts: a text explains what a setting does as well, on these parts.
        for _ in 0..SETTING_ROUNDS {
            let before = state.score;
            let candidates = self.candidates(&state, Reach::Right);
            self.put_best(&mut state, &candidates);
            if state.score > before - LEAST_GAIN {
                break;
            }
        }
        let texts = texts::proposals(self.bench, &state);
        self.put_best(&mut state, &texts);
        let state = self.read_off(state);
        let state = self.options(state);
        let state = self.take_back(state);
        self.bench.tell("search", state.distance());
        state
    }

    /// Puts the candidates that help, in their order.
    fn put_in_order(&self, state: &mut State, candidates: &[Changes]) {
        for (_, at) in self.helping(state, candidates) {
            self.put(state, &candidates[at]);
        }
    }

    /// The candidates that help, each alone: the score and the place.
    fn helping(&self, state: &State, candidates: &[Changes]) -> Vec<(f64, usize)> {
        let machines: Vec<Machine> =
            candidates.iter().map(|changes| state.machine.with(changes)).collect();
        let trials = self.bench.attempt_all(&machines, state);
        better(&trials).collect()
    }

    /// Puts the candidates that help, best first.
    fn put_best(&self, state: &mut State, candidates: &[Changes]) {
        let mut better = self.helping(state, candidates);
        better.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (_, at) in better {
            if self.bench.is_stopped() {
                break;
            }
            self.put(state, &candidates[at]);
        }
    }

    /// Rounds until nothing helps any more.
    fn rounds(&self, mut state: State) -> State {
        for _ in 0..ROUNDS {
            if self.bench.is_stopped() {
                return state;
            }
            let before = state.score;
            state = self.round(state);
            if state.is_equal() {
                break;
            }
            if state.score > before - LEAST_GAIN {
                state = self.in_twos(state);
                state = self.exchange(state);
            }
            if state.score > before - LEAST_GAIN {
                break;
            }
        }
        state
    }

    /// Settings that need each other, in twos of one group.
    fn in_twos(&self, mut state: State) -> State {
        let candidates = self.candidates(&state, Reach::Right);
        let single: Vec<&Changes> = candidates.iter().filter(|c| c.len() == 1).collect();
        let instead = instead(&state, &single);
        self.put_best(&mut state, &instead);
        let machines: Vec<Machine> =
            single.iter().map(|changes| state.machine.with(changes)).collect();
        let trials = self.bench.attempt_all(&machines, &state);
        let waking: Vec<&Changes> = single
            .into_iter()
            .zip(&trials)
            .filter(|(_, trial)| matches!(trial, Trial::Inert | Trial::Impossible))
            .map(|(changes, _)| changes)
            .collect();
        let mut pairs: Vec<Changes> = Vec::new();
        for (at, first) in waking.iter().enumerate() {
            for second in &waking[at + 1..] {
                if first[0].0 != second[0].0 && may_belong_together(first[0].0, second[0].0) {
                    pairs.push([first.as_slice(), second.as_slice()].concat());
                }
            }
        }
        // Too many: every nth of them.
        let step = pairs.len().div_ceil(MOST_PAIRS).max(1);
        let pairs: Vec<Changes> = pairs.into_iter().step_by(step).collect();
        self.put_best(&mut state, &pairs);
        self.take_back(state)
    }

    /// Drops a change and puts another one.
    fn exchange(&self, mut state: State) -> State {
        let keys: Vec<Key> = state.machine.changes.keys().copied().collect();
        for key in keys {
            if self.bench.is_stopped() || state.is_equal() {
                break;
            }
            let Some((machines, trials)) = self.exchanged(&state, key) else { continue };
            if let Some(better) = self.best_of(&machines, &trials) {
                state = better;
            }
        }
        state
    }

    /// The machines of a state with another change in place of one, tried.
    fn exchanged(&self, state: &State, key: Key) -> Option<(Vec<Machine>, Vec<Trial>)> {
        let without = self.bench.state(state.machine.without(key))?;
        let mut candidates = self.candidates(&without, Reach::Wrong);
        candidates.extend(texts::proposals(self.bench, &without));
        let machines: Vec<Machine> =
            candidates.iter().map(|changes| without.machine.with(changes)).collect();
        let trials = self.bench.attempt_without(&machines, state, &without);
        Some((machines, trials))
    }

    /// The likeliest of the explanations that make the same programs, and the others: each has
    /// another change in place of one.
    fn explain(&self, mut state: State) -> (State, Vec<Machine>) {
        let mut others: Vec<Machine> = Vec::new();
        let mut keys: Vec<Key> = state.machine.changes.keys().copied().collect();
        while let Some(key) = keys.pop() {
            if self.bench.is_stopped() || !state.machine.changes.contains_key(&key) {
                continue;
            }
            let Some((machines, trials)) = self.exchanged(&state, key) else { continue };
            if let Some(better) = self.best_of(&machines, &trials) {
                if better.distance() < state.distance() {
                    others.clear();
                }
                others.push(std::mem::replace(&mut state, better).machine);
            }
            let same = machines.into_iter().zip(trials).filter(|(_, trial)| *trial == Trial::Inert);
            others.extend(same.map(|(machine, _)| machine));
        }
        (state, others)
    }

    /// Drops each change that does not help.
    fn take_back(&self, mut state: State) -> State {
        let keys: Vec<Key> = state.machine.changes.keys().copied().collect();
        for key in keys {
            let machine = state.machine.without(key);
            if let Trial::Better(_) = self.bench.attempt(&machine, &state)
                && let Some(better) = self.bench.state(machine)
            {
                state = better;
            }
        }
        state
    }

    /// The same programs over the base that needs fewest settings and can most.
    fn rebase(&self, state: State, bases: &[Arc<Base>]) -> State {
        let machines: Vec<Machine> = bases.iter().map(|base| state.machine.over(base)).collect();
        let same = |other: &State| other.scores.iter().zip(&state.scores).all(|(a, b)| a <= b);
        let states = self.bench.states(&machines);
        let mut others: Vec<State> = Vec::new();
        for other in states.into_iter().flatten().filter(same) {
            others.push(self.take_back(other));
        }
        let fewest = others.iter().map(|other| other.machine.changes.len()).min();
        let fewest = fewest.unwrap_or(usize::MAX).min(state.machine.changes.len());
        others.retain(|other| other.machine.changes.len() <= fewest && same(other));
        if state.machine.changes.len() <= fewest {
            others.insert(0, state.clone());
        }
        let can = |state: &State| capability(&state.machine);
        let most = others.iter().map(can).max().unwrap_or(0);
        others.into_iter().find(|other| can(other) == most).unwrap_or(state)
    }
}

/// The trials that are better than the state before, with their scores and places.
fn better(trials: &[Trial]) -> impl Iterator<Item = (f64, usize)> + '_ {
    trials.iter().enumerate().filter_map(|(at, trial)| match trial {
        Trial::Better(score) => Some((*score, at)),
        Trial::Impossible | Trial::Inert | Trial::Worse => None,
    })
}

/// How many codes a machine has: what no pair decides then comes from one with all cycles.
fn capability(machine: &Machine) -> usize {
    let commons = machine.base.commons();
    let has = |index: &usize| {
        let row = change::row(*index);
        row.name.ends_with("_code") && change::number(commons, *index) != filpost::commons::EMPTY
    };
    (0..filpost::locations::TABLE.len()).filter(has).count()
}

/// Other values of the settings that are put, each with a second setting: one value may stand for
/// what two settings do (arcs without signs are cut at quadrants).
fn instead(state: &State, single: &[&Changes]) -> Vec<Changes> {
    let is_put =
        |key: Key| candidates::has_few_values(key) && state.machine.changes.contains_key(&key);
    let mut found = Vec::new();
    for first in single.iter().filter(|change| is_put(change[0].0)) {
        let second = single.iter().filter(|second| second[0].0 != first[0].0);
        let second = second.filter(|second| may_belong_together(first[0].0, second[0].0));
        found.extend(second.map(|second| [first.as_slice(), second.as_slice()].concat()));
    }
    found
}

/// Two settings may need each other: they are of one group, and their names begin alike.
fn may_belong_together(a: Key, b: Key) -> bool {
    let (Key::Setting(a), Key::Setting(b)) = (a, b) else { return false };
    candidates::group(a) == candidates::group(b)
}
