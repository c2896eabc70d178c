//! Trials: a machine posts the CL files, and its programs are compared with the proven ones.

use std::io::Cursor;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

use filpost::{Program, Run, Unit};

use crate::change::Machine;
use crate::score::{self, Cut};
use crate::task::{Progress, Task};

/// Cost of a program that is refused, beyond that of any wrong one.
const REFUSED: f64 = 1000.0;
const REFUSED_A_WORD: f64 = 10.0;

/// A gain below this is none.
pub(crate) const LEAST_GAIN: f64 = 1e-6;

/// The pairs of a task, ready for trials.
pub(crate) struct Bench<'t> {
    pub pairs: Vec<Prepared>,
    units: Option<Unit>,
    threads: usize,
    watch: &'t crate::task::Watch<'t>,
    runs: AtomicU64,
    stopped: AtomicBool,
}

/// A pair whose proven program is cut up.
pub(crate) struct Prepared {
    pub cl_name: String,
    pub cl: Vec<u8>,
    pub nc_name: String,
    pub proven: Cut,
}

/// A machine with the programs that it makes.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub machine: Machine,
    /// The program of each pair; `None` where it is refused.
    pub programs: Vec<Option<Cut>>,
    /// The distance of each from its proven program.
    pub scores: Vec<f64>,
    /// Their sum and the price of the machine.
    pub score: f64,
}

impl State {
    /// Every program is that of the proven post, byte for byte.
    pub fn is_equal(&self) -> bool {
        self.scores.iter().all(|score| *score == 0.0)
    }

    /// The distance of all programs.
    pub fn distance(&self) -> f64 {
        self.scores.iter().sum()
    }
}

/// What became of a trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Trial {
    /// The settings contradict each other, or can't be stored.
    Impossible,
    /// Every program is the same as before.
    Inert,
    /// No better than before; some program differs.
    Worse,
    /// Better: the new score.
    Better(f64),
}

impl<'t> Bench<'t> {
    pub fn new(task: &'t Task<'t>) -> Bench<'t> {
        let prepared = task.pairs.iter().map(|pair| Prepared {
            cl_name: pair.cl_name.clone(),
            cl: pair.cl.clone(),
            nc_name: pair.nc_name.clone(),
            proven: Cut::new(&pair.nc),
        });
        Bench {
            pairs: prepared.collect(),
            units: task.units,
            threads: task.threads,
            watch: &task.watch,
            runs: AtomicU64::new(0),
            stopped: AtomicBool::new(false),
        }
    }

    /// Programs that were posted so far.
    pub fn runs(&self) -> u64 {
        self.runs.load(Ordering::Relaxed)
    }

    /// Tells of progress; true when the search shall end.
    pub fn tell(&self, step: &'static str, distance: f64) -> bool {
        let progress = Progress { step, runs: self.runs(), distance };
        if !(self.watch)(progress) {
            self.stopped.store(true, Ordering::Relaxed);
        }
        self.is_stopped()
    }

    /// The search shall end.
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// The program of a pair; `None` where it is refused.
    pub fn post(&self, program: &Program, pair: usize) -> Option<Vec<u8>> {
        let mut nc = Vec::new();
        let run = self.start(program);
        run.stream_seekable(Cursor::new(&self.pairs[pair].cl), &mut nc).ok().map(|_| nc)
    }

    /// A run with the options of the task, which is counted.
    pub fn start<'o>(&self, program: &Program) -> Run<'o> {
        self.runs.fetch_add(1, Ordering::Relaxed);
        let run = program.start();
        match self.units {
            Some(units) => run.units(units),
            None => run,
        }
    }

    /// The program of a pair, and how far it is from the proven one.
    pub fn compare(&self, program: &Program, pair: usize) -> (Option<Cut>, f64) {
        let own = self.post(program, pair).map(|nc| Cut::new(&nc));
        let proven = &self.pairs[pair].proven;
        let score = match &own {
            Some(own) => score::score(own, proven, f64::INFINITY).unwrap_or_default(),
            None => refused(proven),
        };
        (own, score)
    }

    /// A machine with its programs; `None` for settings that contradict each other.
    pub fn state(&self, machine: Machine) -> Option<State> {
        let program = machine.base.program.with_machine(machine.commons()?).ok()?;
        let compared = (0..self.pairs.len()).map(|pair| self.compare(&program, pair));
        let (programs, scores): (Vec<Option<Cut>>, Vec<f64>) = compared.unzip();
        let score = scores.iter().sum::<f64>() + machine.price();
        Some(State { machine, programs, scores, score })
    }

    /// Tries a machine against a state that it shall be better than.
    pub fn attempt(&self, machine: &Machine, against: &State) -> Trial {
        self.attempt_in_order(machine, against, 0..self.pairs.len())
    }

    /// The same, with the pairs in an order: those that are likely to be worse first.
    fn attempt_in_order(
        &self,
        machine: &Machine,
        against: &State,
        order: impl Iterator<Item = usize>,
    ) -> Trial {
        let program = machine.commons().map(|commons| machine.base.program.with_machine(commons));
        let Some(Ok(program)) = program else { return Trial::Impossible };
        let price = machine.price();
        let mut distances = against.scores.clone();
        let (mut known, mut inert) = (price, true);
        for pair in order {
            let before = against.programs[pair].as_ref();
            let nc = self.post(&program, pair);
            let bytes = nc.as_deref().map(score::without_last_end);
            if bytes != before.map(|cut| cut.bytes.as_slice()) {
                inert = false;
                let proven = &self.pairs[pair].proven;
                let limit = against.score - known - LEAST_GAIN;
                distances[pair] = match nc {
                    Some(nc) => match score::score_of_text(&nc, proven, limit) {
                        Some(distance) => distance,
                        None => return Trial::Worse,
                    },
                    None => refused(proven),
                };
            }
            known += distances[pair];
            if !inert && known >= against.score {
                return Trial::Worse;
            }
        }
        let score = price + distances.iter().sum::<f64>();
        match () {
            () if score < against.score - LEAST_GAIN => Trial::Better(score),
            () if inert => Trial::Inert,
            () => Trial::Worse,
        }
    }

    /// Tries many machines at once; the results are in their order.
    pub fn attempt_all(&self, machines: &[Machine], against: &State) -> Vec<Trial> {
        self.attempt_without(machines, against, against)
    }

    /// The same with machines that are made of a state without a change: the pairs that need the
    /// change come first.
    pub fn attempt_without(
        &self,
        machines: &[Machine],
        against: &State,
        without: &State,
    ) -> Vec<Trial> {
        let mut order: Vec<usize> = (0..self.pairs.len()).collect();
        let bytes =
            |state: &State, pair: usize| state.programs[pair].as_ref().map(|cut| cut.bytes.clone());
        order.sort_by_cached_key(|pair| bytes(without, *pair) == bytes(against, *pair));
        self.in_threads(machines.len(), Trial::Worse, |index| {
            self.attempt_in_order(&machines[index], against, order.iter().copied())
        })
    }

    /// The states of many machines, in their order.
    pub fn states(&self, machines: &[Machine]) -> Vec<Option<State>> {
        self.in_threads(machines.len(), None, |index| self.state(machines[index].clone()))
    }

    /// Does a job for each number below `count`, in threads; `skipped` where the search was
    /// stopped before.
    pub fn in_threads<R: Clone + Send>(
        &self,
        count: usize,
        skipped: R,
        job: impl Fn(usize) -> R + Sync,
    ) -> Vec<R> {
        let next = AtomicUsize::new(0);
        let results = Mutex::new(vec![skipped; count]);
        let work = || {
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                if index >= count || self.is_stopped() {
                    break;
                }
                let result = job(index);
                if let Ok(mut results) = results.lock() {
                    results[index] = result;
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..self.threads.min(count.max(1)) {
                scope.spawn(work);
            }
            work();
        });
        results.into_inner().unwrap_or_default()
    }
}

/// Cost of a refused program.
fn refused(proven: &Cut) -> f64 {
    REFUSED + REFUSED_A_WORD * proven.len() as f64
}
