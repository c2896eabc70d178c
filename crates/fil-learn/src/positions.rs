//! Positions of tool changes: the axis words of blocks that only the proven programs have.

use std::collections::BTreeSet;

use crate::align;
use crate::change::{self, Changes, Key, Value};
use crate::trial::{Bench, State};
use crate::words::{Block, lines};

/// Most positions that are tried.
const MOST_POSITIONS: usize = 24;

/// `tool.change_block` with the positions of blocks that have axis words alone, together as one
/// move and as several.
pub(crate) fn proposals(bench: &Bench<'_>, state: &State) -> Vec<Changes> {
    let mut positions: BTreeSet<[Option<i64>; 3]> = BTreeSet::new();
    for (own, pair) in state.programs.iter().zip(&bench.pairs) {
        let Some(own) = own else { continue };
        let proven = &pair.proven.blocks;
        for (_, gap) in align::gaps(&lines(&own.blocks), &lines(proven)) {
            let mut whole = [None; 3];
            for block in &proven[gap] {
                let Some(position) = position(block) else { continue };
                positions.insert(position);
                for (axis, value) in position.into_iter().enumerate() {
                    whole[axis] = value.or(whole[axis]);
                }
                positions.insert(whole);
            }
        }
    }
    let axes = ["tool.change_x", "tool.change_y", "tool.change_z"].map(change::key);
    let Some(block) = change::key("tool.change_block") else { return Vec::new() };
    let mut found = Vec::new();
    for position in positions.into_iter().take(MOST_POSITIONS) {
        for kind in [1.0, 2.0] {
            let mut changes: Changes = vec![(block, Value::Number(kind))];
            changes.extend(axes.iter().zip(position).filter_map(
                |(key, value): (&Option<Key>, _)| {
                    Some(((*key)?, Value::Number(value? as f64 / SCALE)))
                },
            ));
            found.push(changes);
        }
    }
    found
}

/// Positions are kept to four decimals.
const SCALE: f64 = 1e4;

/// X, Y and Z of a block with nothing else but G0.
fn position(block: &Block) -> Option<[Option<i64>; 3]> {
    let mut position = [None; 3];
    for word in &block.words {
        let value = word.value()?;
        match word.letter {
            b'X'..=b'Z' => {
                position[usize::from(word.letter - b'X')] = Some((value * SCALE).round() as i64);
            }
            b'G' if value == 0.0 => {}
            _ => return None,
        }
    }
    position.iter().any(Option::is_some).then_some(position)
}
