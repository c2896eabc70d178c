//! Goes through two aligned programs and compares what stands for each other.

use fil_diag::Diag;

use super::align::Run;
use super::pair::{self, Found};
use super::program::{Cursor, Program};
use super::{Comparison, Options};
use crate::source::unreadable;

/// Compares along the runs of an alignment.
///
/// # Errors
/// E0915
pub(super) fn compare(
    first: &Program,
    second: &Program,
    options: &Options,
    mut runs: Vec<Run>,
) -> Result<Comparison, Box<Diag>> {
    let skipped = skip_common(first, second, &mut runs)?;
    let mut walk = Walk {
        cursors: [first.cursor(skipped), second.cursor(skipped)],
        options,
        same_state: false,
        found: Found::default(),
        comparison: Comparison::default(),
    };
    for run in runs {
        walk.run(run)?;
    }
    walk.comparison.differences = walk.found.finish();
    Ok(walk.comparison)
}

/// Takes blocks whose bytes are the same from the start of both programs out of the
/// first run, as many as end at a checkpoint; their number.
fn skip_common(first: &Program, second: &Program, runs: &mut [Run]) -> Result<usize, Box<Diag>> {
    let common = first.source.common(&second.source);
    let (bytes, _) = common.map_err(|error| unreadable(second.name(), &error))?;
    let Some(run) = runs.first_mut().filter(|run| run.at == [Some(0), Some(0)]) else {
        return Ok(0);
    };
    let blocks = first.checkpoint_before(bytes).blocks.min(run.count);
    *run = Run { at: [Some(blocks); 2], count: run.count - blocks };
    Ok(blocks)
}

struct Walk<'p> {
    cursors: [Cursor<'p>; 2],
    options: &'p Options,
    /// The same is in force in both programs before the next pair.
    same_state: bool,
    found: Found,
    comparison: Comparison,
}

impl Walk<'_> {
    fn run(&mut self, run: Run) -> Result<(), Box<Diag>> {
        for step in 0..run.count {
            match run.at.map(|at| at.map(|at| at + step)) {
                [Some(one), Some(two)] => self.pair(one, two)?,
                [Some(one), None] => self.alone(0, one)?,
                [None, Some(two)] => self.alone(1, two)?,
                [None, None] => {}
            }
        }
        Ok(())
    }

    fn pair(&mut self, one: usize, two: usize) -> Result<(), Box<Diag>> {
        let [first, second] = &mut self.cursors;
        let (one, two) = (first.block(one)?, second.block(two)?);
        let alike = pair::written_alike(one, two);
        if alike && (self.same_state || one.before == two.before) {
            pair::compare_numbers(one, two, &mut self.found);
            self.same_state = true;
        } else {
            pair::compare(one, two, self.options, &mut self.found);
            self.same_state = false;
        }
        self.comparison.note([Some(one.block.line), Some(two.block.line)]);
        Ok(())
    }

    fn alone(&mut self, side: usize, index: usize) -> Result<(), Box<Diag>> {
        let line = self.cursors[side].block(index)?;
        let mut lines = [None; 2];
        lines[side] = Some(line.block.line);
        if !line.silent {
            self.found.only(lines);
        }
        self.comparison.note(lines);
        self.same_state = false;
        Ok(())
    }
}
