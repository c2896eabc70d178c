//! The user's blocks at fixed places of a program, with the numbers of tool and work offset in them.

use fil_diag::Result;
use fil_machine::locations as loc;
use fil_machine::user_blocks::{Numbers, UserBlocks};

use super::Control;
use crate::cause::Cause;
use crate::control_state::ForeignBlock;
use crate::errors::PostCode;

/// The blocks of a list as texts, with the numbers in place of their names.
///
/// # Errors
/// A block names a tool or a work offset before there is one.
pub(crate) fn texts(control: &Control, list: UserBlocks) -> Result<Vec<String>> {
    if !list.is_on(&control.commons) {
        return Ok(Vec::new());
    }
    let first = control.commons.int_opt(loc::FIXTURE_FIRST).map(i64::from);
    let offset = control.tools.work_offset.map_or(first, |named| named);
    let numbers = Numbers { tool: control.tools.loaded, offset };
    let fill = |block: String| match numbers.fill(&block) {
        Ok(text) => Ok(text.into_owned()),
        Err(name) => {
            PostCode::TextPlace.err(format!("`{block}`: nothing has said {name} before it"))
        }
    };
    list.read(&control.commons).into_iter().map(fill).collect()
}

/// The blocks of a list; an empty text stands for none.
///
/// # Errors
/// As [`texts`].
pub(crate) fn blocks(control: &Control, list: UserBlocks) -> Result<Vec<ForeignBlock>> {
    let mut texts = texts(control, list)?;
    texts.retain(|block| !block.is_empty());
    Ok(texts.into_iter().map(|text| control.read(text)).collect())
}

/// Writes the blocks of a list.
///
/// # Errors
/// As [`blocks`]; a block that the tape refuses.
pub(crate) fn write(control: &mut Control, list: UserBlocks) -> Result<()> {
    blocks(control, list)?.iter().try_for_each(|block| {
        control.because(Cause::default(), |control| control.write_foreign(block, true))
    })
}

/// Writes blocks between the words of another block, which counts on where the axes stand.
///
/// # Errors
/// As [`write`]; a block that moves an axis.
pub(crate) fn write_at_rest(control: &mut Control, list: UserBlocks) -> Result<()> {
    let stand = |control: &Control| [0, 1, 2, 3, 4].map(|number| control.stands(number));
    for block in &blocks(control, list)? {
        let stood = stand(control);
        control.because(Cause::default(), |control| control.write_foreign(block, true))?;
        if stand(control) != stood {
            return PostCode::TextPlace
                .err(format!("`{}` moves an axis before the turn at hand", block.text));
        }
    }
    Ok(())
}
