//! What is to be learned from.

use filpost::Unit;

use crate::bases::Bases;

/// A CL file and the NC program that a proven post made of it.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Name of the CL file.
    pub cl_name: String,
    /// The CL file.
    pub cl: Vec<u8>,
    /// Name of the program.
    pub nc_name: String,
    /// The program.
    pub nc: Vec<u8>,
}

impl Pair {
    /// A pair with the names that reports show.
    pub fn new(cl_name: &str, cl: &[u8], nc_name: &str, nc: &[u8]) -> Pair {
        Pair { cl_name: cl_name.into(), cl: cl.into(), nc_name: nc_name.into(), nc: nc.into() }
    }
}

/// How far the search is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// What it does, in a word or two.
    pub step: &'static str,
    /// Programs that were posted so far.
    pub runs: u64,
    /// Distance from the proven programs; 0 where all bytes are equal.
    pub distance: f64,
}

/// What is told of progress, and answers whether to go on.
pub(crate) type Watch<'t> = Box<dyn Fn(Progress) -> bool + Sync + 't>;

/// Pairs, bases and limits.
pub struct Task<'t> {
    pub(crate) pairs: Vec<Pair>,
    pub(crate) bases: Bases,
    pub(crate) fil: Vec<(String, String)>,
    pub(crate) keep: Vec<String>,
    pub(crate) units: Option<Unit>,
    pub(crate) threads: usize,
    pub(crate) watch: Watch<'t>,
}

impl<'t> Task<'t> {
    /// A task with as many threads as the machine has cores.
    pub fn new(pairs: Vec<Pair>, bases: Bases) -> Task<'t> {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        Task {
            pairs,
            bases,
            fil: Vec::new(),
            keep: Vec::new(),
            units: None,
            threads,
            watch: Box::new(|_| true),
        }
    }

    /// Adds a FIL file, which every trial runs.
    #[must_use]
    pub fn fil(mut self, name: &str, text: &str) -> Self {
        self.fil.push((name.into(), text.into()));
        self
    }

    /// Keeps a setting, or all settings that begin so (`cycle.`), as the base has them.
    #[must_use]
    pub fn keep(mut self, key: &str) -> Self {
        self.keep.push(key.into());
        self
    }

    /// The unit of CL files without a UNITS statement.
    #[must_use]
    pub fn units(mut self, unit: Unit) -> Self {
        self.units = Some(unit);
        self
    }

    /// The number of threads; the result does not depend on it.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// Is told of progress; where it answers false, the best machine so far is the result.
    #[must_use]
    pub fn watch(mut self, watch: impl Fn(Progress) -> bool + Sync + 't) -> Self {
        self.watch = Box::new(watch);
        self
    }
}
