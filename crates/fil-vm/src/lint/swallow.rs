//! Finds sections that can end without sending anything to the post: such a
//! section swallows its record.

use fil_diag::Diag;

use crate::errors::LintCode;
use crate::library::Library;
use crate::module::{ChunkId, Module};
use crate::ops::Op;
use crate::postf::PostfOp;

/// Calls followed from a section; beyond this a macro is taken to send.
const MOST_CALLS_FOLLOWED: u32 = 50;

/// A warning for each section with a way from its start to its end on which
/// no post word and no POSTF(13) stands.
pub(crate) fn warnings(module: &Module) -> Vec<Diag> {
    let swallowing = module.sections.iter().filter(|section| is_silent(module, section.chunk, 0));
    let warn = |section: &crate::module::Section| {
        let place = module.files[usize::from(section.file)].place(section.span);
        let message = format!("the section for {} can end without sending anything", section.key);
        Diag::new(LintCode::Swallows, message).at(place)
    };
    swallowing.map(warn).collect()
}

/// True when a way through the chunk sends nothing.
fn is_silent(module: &Module, chunk: ChunkId, depth: u32) -> bool {
    let code = &module.chunks[usize::from(chunk)].code;
    let mut seen = vec![false; code.len()];
    let mut open = vec![0];
    while let Some(pc) = open.pop() {
        if std::mem::replace(&mut seen[pc], true) {
            continue;
        }
        match code[pc] {
            Op::Return => return true,
            Op::Jump { to } | Op::JumpBack { to } => open.push(usize::from(to)),
            op => {
                if !sends(module, op, depth) {
                    open.push(pc + 1);
                    open.extend(side_way(op));
                }
            }
        }
    }
    false
}

fn sends(module: &Module, op: Op, depth: u32) -> bool {
    match op {
        Op::Post { .. } | Op::PostfDynamic { .. } => true,
        Op::Postf { op, .. } => op == PostfOp::Process as u16,
        // A refused record is not lost.
        Op::Library { call, .. } => module.calls[usize::from(call)].library == Library::Refuse,
        Op::Call { macro_id } => {
            let called = module.macros[usize::from(macro_id)];
            depth >= MOST_CALLS_FOLLOWED || !is_silent(module, called, depth + 1)
        }
        _ => false,
    }
}

/// The second way on from an operation that decides.
fn side_way(op: Op) -> Option<usize> {
    match op {
        Op::JumpEq { to, .. }
        | Op::JumpNe { to, .. }
        | Op::JumpLt { to, .. }
        | Op::JumpLe { to, .. }
        | Op::JumpTrue { to, .. }
        | Op::JumpFalse { to, .. }
        | Op::DoEnter { exit: to, .. }
        | Op::DoNext { body: to, .. } => Some(usize::from(to)),
        _ => None,
    }
}
