//! What was found.

use std::fmt::Write as _;

use filpost::Program;

use crate::align;
use crate::bases;
use crate::change::{self, Changes, Key, Machine};
use crate::proof::{self, Proof};
use crate::trial::{Bench, State};
use crate::undecided;
use crate::words::{self, Block};

/// A machine that was learned, with its proofs.
#[derive(Debug)]
pub struct Learned {
    machine: Machine,
    proofs: Vec<(Key, Proof)>,
    undecided: Vec<Changes>,
    pairs: Vec<LearnedPair>,
    runs: u64,
}

/// How much of a proven program comes out.
#[derive(Clone, Debug, PartialEq)]
pub struct LearnedPair {
    /// Name of the CL file.
    pub cl_name: String,
    /// Name of the proven program.
    pub nc_name: String,
    /// Blocks of the proven program.
    pub blocks: usize,
    /// Blocks that come out as they are.
    pub equal: usize,
    /// Every byte is equal; a missing last line end does not count.
    pub is_equal: bool,
    /// The post refuses the CL file.
    pub is_refused: bool,
    /// What is left: line in the proven program, its blocks, ours.
    pub left: Vec<(usize, Vec<String>, Vec<String>)>,
}

impl Learned {
    pub(crate) fn new(bench: &Bench<'_>, state: State, undecided: Vec<Changes>) -> Learned {
        let pairs = (0..bench.pairs.len()).map(|at| compare(bench, &state, at)).collect();
        let proofs = proof::proofs(bench, &state);
        Learned { proofs, undecided, pairs, runs: bench.runs(), machine: state.machine }
    }

    /// What reports call the base: a ready post, or the given one.
    pub fn base(&self) -> &str {
        &self.machine.base.title
    }

    /// Options that the base is given.
    pub fn options(&self) -> &[(String, String)] {
        &self.machine.base.options
    }

    /// The settings over the base, each with what proves it.
    pub fn proofs(&self) -> impl Iterator<Item = &Proof> {
        self.proofs.iter().map(|(_, proof)| proof)
    }

    /// The pairs, in the order of the task.
    pub fn pairs(&self) -> &[LearnedPair] {
        &self.pairs
    }

    /// Settings with another value that makes the same programs, as `KEY=VALUE`; several that
    /// belong together have a line each.
    pub fn undecided(&self) -> Vec<String> {
        let commons = self.machine.commons();
        let commons = commons.as_ref().unwrap_or_else(|| self.machine.base.commons());
        self.undecided.iter().map(|other| undecided::text_of(other, commons)).collect()
    }

    /// Programs that were posted to find it.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    /// Every program comes out byte for byte.
    pub fn is_equal(&self) -> bool {
        self.pairs.iter().all(|pair| pair.is_equal)
    }

    /// Less than half of the blocks come out: no settings can be taken from that.
    pub fn is_too_far(&self) -> bool {
        let blocks: usize = self.pairs.iter().map(|pair| pair.blocks).sum();
        let equal: usize = self.pairs.iter().map(|pair| pair.equal).sum();
        2 * equal < blocks
    }

    /// The post, ready to run.
    ///
    /// # Errors
    /// None for a machine that was tried.
    pub fn program(&self) -> Result<Program, filpost::Error> {
        let base = &self.machine.base.program;
        base.with_machine(self.machine.commons().unwrap_or_else(|| base.commons().clone()))
    }

    /// The text of its `machine.toml`: base, settings with their proofs, what is undecided.
    pub fn machine_toml(&self) -> String {
        let mut text = String::new();
        match &self.machine.base.post {
            Some(post) => text.push_str(&bases::head(post, self.options())),
            None => {
                let _ = writeln!(text, "# The settings of {}.", self.base());
                text.push_str(&self.settings_of_base());
            }
        }
        if !self.proofs.is_empty() {
            text.push_str("\n# What the proven programs show.\n");
        }
        for (key, proof) in &self.proofs {
            let _ = writeln!(text, "\n# {}", said(proof));
            let meaning = change::meaning(*key);
            if !meaning.is_empty() {
                let _ = writeln!(text, "# {meaning}");
            }
            let _ = writeln!(text, "{} = {}", proof.key, proof.value);
        }
        let undecided = self.undecided();
        if !undecided.is_empty() {
            text.push_str(
                "\n# With these values the proven programs come out the same. `filpost post` warns \
                 where one\n# of them would change a program.\nlearned.undecided = [\n",
            );
            undecided.iter().for_each(|setting| text.push_str(&format!("    {setting:?},\n")));
            text.push_str("]\n");
        }
        let unequal: Vec<String> =
            self.pairs.iter().filter(|pair| !pair.is_equal).map(LearnedPair::summary).collect();
        if !unequal.is_empty() {
            text.push_str(
                "\n# Programs that come out differently; `filpost post` warns of that.\n",
            );
            let _ = writeln!(text, "learned.unequal = {unequal:?}");
        }
        text
    }

    /// What a given base sets itself, without what was learned: a key may stand once.
    fn settings_of_base(&self) -> String {
        let learned: Vec<String> =
            self.proofs.iter().map(|(_, proof)| format!("{} = ", proof.key)).collect();
        let base = filpost::settings::write_toml(self.machine.base.commons());
        let kept = base.lines().filter(|line| !learned.iter().any(|key| line.starts_with(key)));
        kept.map(|line| format!("{line}\n")).collect()
    }
}

/// A proof in a line.
fn said(proof: &Proof) -> String {
    let named: Vec<String> =
        proof.lines.iter().map(|(file, line)| format!("{file}:{line}")).collect();
    let more = proof.count.saturating_sub(named.len());
    let named = named.join(", ");
    match (proof.count, proof.refused, more) {
        (0, true, _) => "Without it a CL file is refused.".into(),
        (0, false, _) => "The programs as a whole.".into(),
        (_, _, 0) => named,
        (_, _, 1) => format!("{named} and 1 more line"),
        _ => format!("{named} and {more} more lines"),
    }
}

/// How much of the proven program of a pair comes out.
pub(crate) fn compare(bench: &Bench<'_>, state: &State, at: usize) -> LearnedPair {
    let pair = &bench.pairs[at];
    let mut result = LearnedPair {
        cl_name: pair.cl_name.clone(),
        nc_name: pair.nc_name.clone(),
        blocks: pair.proven.blocks.len(),
        equal: 0,
        is_equal: state.scores[at] == 0.0,
        is_refused: state.programs[at].is_none(),
        left: Vec::new(),
    };
    let Some(own) = &state.programs[at] else { return result };
    let lines = words::numbered_lines;
    let gaps = align::gaps(&lines(&own.blocks), &lines(&pair.proven.blocks));
    result.equal = own.blocks.len() - gaps.iter().map(|(ours, _)| ours.len()).sum::<usize>();
    for (ours, proven) in gaps {
        let texts = |blocks: &[Block]| blocks.iter().map(Block::whole).collect();
        let at = proven.start + 1;
        result.left.push((at, texts(&pair.proven.blocks[proven]), texts(&own.blocks[ours])));
    }
    result
}
