//! Which settings the programs of a machine depend on, by the reads of its runs.

use std::io::Cursor;

use filpost::reads::ReadSet;

use crate::align;
use crate::change::{self, Changes, Key};
use crate::trial::{Bench, State};
use crate::words::{Block, lines};

/// Settings that were read while the pairs were posted.
#[derive(Debug, Default)]
pub(crate) struct Noted {
    /// Before the first record: what tables are made of.
    tables: ReadSet,
    /// For a block, any.
    blocks: ReadSet,
    /// For a block that differs from the proven program, or stands beside one that does.
    wrong: ReadSet,
    /// For all blocks of the pair, one set each.
    pub of_pairs: Vec<ReadSet>,
}

/// What a change may do to the programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reach {
    /// Nothing reads it.
    None,
    /// It is read for blocks that are right.
    Right,
    /// It is read for a block that is wrong, or once for all blocks.
    Wrong,
}

impl Noted {
    /// Posts the pairs once more and notes the settings that are read.
    pub fn new(bench: &Bench<'_>, state: &State) -> Option<Noted> {
        let program = state.machine.base.program.with_machine(state.machine.commons()?).ok()?;
        let mut noted = Noted::default();
        for (at, pair) in bench.pairs.iter().enumerate() {
            let (program, reads) = program.with_reads().ok()?;
            noted.tables.add(&reads.take());
            let own = state.programs[at].as_ref();
            let wrong = own.map(|own| wrong_blocks(&own.blocks, &pair.proven.blocks));
            let mut of_pair = ReadSet::default();
            let mut number = 0;
            let mut is_whole = false;
            let mut blocks = bench.start(&program).blocks(Cursor::new(&pair.cl));
            for block in &mut blocks {
                let Ok(block) = block else { break };
                is_whole = true;
                let read = reads.take();
                of_pair.add(&read);
                let is_wrong = |wrong: &Vec<bool>| wrong.get(number).copied().unwrap_or(true);
                if wrong.as_ref().is_none_or(is_wrong) {
                    noted.wrong.add(&read);
                }
                number += usize::from(!block.text.trim().is_empty());
            }
            // After the last block, or all of a run that reads its CL file twice.
            drop(blocks);
            if !is_whole {
                bench.post(&program, at);
            }
            let rest = reads.take();
            of_pair.add(&rest);
            noted.wrong.add(&rest);
            noted.blocks.add(&of_pair);
            noted.of_pairs.push(of_pair);
        }
        Some(noted)
    }

    /// What a row of the table of settings may do.
    pub fn reach(&self, index: usize) -> Reach {
        let row = change::row(index);
        let has = |set: &ReadSet| set.has(row.kind, row.number.into());
        match (has(&self.wrong) || has(&self.tables), has(&self.blocks)) {
            (true, _) => Reach::Wrong,
            (_, true) => Reach::Right,
            (_, false) => Reach::None,
        }
    }

    /// The farthest reach of some changes; letters and texts reach all blocks.
    pub fn reach_of(&self, changes: &Changes) -> Reach {
        let reach = |key: &Key| match key {
            Key::Setting(index) => self.reach(*index),
            Key::Letter(_) | Key::Texts(_) => Reach::Wrong,
        };
        changes.iter().map(|(key, _)| reach(key)).max().unwrap_or(Reach::None)
    }
}

/// The own blocks that the proven program lacks, those beside what it has more, and their
/// neighbors.
fn wrong_blocks(own: &[Block], proven: &[Block]) -> Vec<bool> {
    let mut wrong = vec![false; own.len()];
    for (ours, _) in align::gaps(&lines(own), &lines(proven)) {
        let last = (ours.end + 1).min(own.len());
        wrong[ours.start.saturating_sub(1)..last].fill(true);
    }
    wrong
}
