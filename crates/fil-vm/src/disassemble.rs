//! Bytecode as text, for tests and for people.

use std::fmt::Write;

use crate::builtins::BUILTINS;
use crate::machine::FIRST_TEMPORARY;
use crate::module::{Constant, Item, Module};
use crate::ops::{Op, Reg};
use crate::postf::POSTF;

/// All chunks of a module: position, line, operation with names and constants.
pub fn disassemble(module: &Module) -> String {
    let mut text = String::new();
    for chunk in &module.chunks {
        let _ = writeln!(text, "{}:", chunk.title);
        for (pc, op) in chunk.code.iter().enumerate() {
            let line = module.statements[chunk.statements[pc] as usize].line;
            let _ = writeln!(text, "{pc:4}  {line:3}  {}", show(module, *op));
        }
    }
    text
}

/// A register: name, constant, or number of a temporary or hidden one.
fn name(module: &Module, reg: Reg) -> String {
    if let Some(name) = module.names.get(&reg) {
        return name.clone();
    }
    match module.constants.iter().find(|(constant, _)| *constant == reg) {
        Some((_, Constant::Number(number))) => format!("{number}"),
        Some((_, Constant::Word(id))) => format!("#{}", id.index()),
        Some((_, Constant::Text(text))) => format!("'{text}'"),
        None if reg >= FIRST_TEMPORARY => format!("t{}", reg - FIRST_TEMPORARY),
        None => format!("r{reg}"),
    }
}

fn show(module: &Module, op: Op) -> String {
    let n = |reg| name(module, reg);
    let array = |index: u16| &module.arrays[usize::from(index)].name;
    match op {
        Op::Move { dst, src } => format!("{} = {}", n(dst), n(src)),
        Op::Neg { dst, src } => format!("{} = -{}", n(dst), n(src)),
        Op::Add { dst, a, b } => format!("{} = {} + {}", n(dst), n(a), n(b)),
        Op::Sub { dst, a, b } => format!("{} = {} - {}", n(dst), n(a), n(b)),
        Op::Mul { dst, a, b } => format!("{} = {} * {}", n(dst), n(a), n(b)),
        Op::AddProduct { dst, a, b } => {
            format!("{} = {} + {} * {}", n(dst), n(dst), n(a), n(b))
        }
        Op::Div { dst, a, b } => format!("{} = {} / {}", n(dst), n(a), n(b)),
        Op::Pow { dst, a, b } => format!("{} = {} ** {}", n(dst), n(a), n(b)),
        Op::Jump { to } => format!("jump {to}"),
        Op::JumpBack { to } => format!("jump back {to}"),
        Op::JumpEq { a, b, to } => format!("if {} = {} jump {to}", n(a), n(b)),
        Op::JumpNe { a, b, to } => format!("if {} <> {} jump {to}", n(a), n(b)),
        Op::JumpLt { a, b, to } => format!("if {} < {} jump {to}", n(a), n(b)),
        Op::JumpLe { a, b, to } => format!("if {} <= {} jump {to}", n(a), n(b)),
        Op::JumpTrue { a, to } => format!("if {} jump {to}", n(a)),
        Op::JumpFalse { a, to } => format!("if not {} jump {to}", n(a)),
        Op::DoEnter { var, base, exit } => {
            format!("do {} to {} step {} exit {exit}", n(var), n(base), n(base.wrapping_add(1)))
        }
        Op::DoNext { var, body, .. } => format!("next {} body {body}", n(var)),
        Op::Load { dst, array: id, index } => format!("{} = {}({})", n(dst), array(id), n(index)),
        Op::Store { array: id, index, src } => format!("{}({}) = {}", array(id), n(index), n(src)),
        Op::Function { dst, function, base } => {
            format!("{} = {}({}…)", n(dst), BUILTINS[usize::from(function)].name, n(base))
        }
        Op::HostFunction { dst, function, base } => {
            format!("{} = host function {function}({}…)", n(dst), n(base))
        }
        Op::Library { dst, call } => library(module, n(dst), call),
        Op::TextJoin { dst, base, count } => format!("{} = join {}…{count}", n(dst), n(base)),
        Op::RecordWord { dst, n: word } => format!("{} = word {word}", n(dst)),
        Op::Postf { dst, op, base } => {
            format!("{} = POSTF({}, {}…)", n(dst), POSTF[usize::from(op)].number, n(base))
        }
        Op::PostfDynamic { dst, base, count } => {
            format!("{} = POSTF({}…{count})", n(dst), n(base))
        }
        Op::Couplet { dst, word, default } => {
            format!("{} = couplet #{word} else {}", n(dst), n(default))
        }
        Op::CoupletOrFail { dst, word } => format!("{} = couplet #{word}", n(dst)),
        Op::HasWord { dst, word } => format!("{} = has #{word}", n(dst)),
        Op::LastWritten { dst, letter } => format!("{} = last {}", n(dst), n(letter)),
        Op::NamedCommon { dst, name } => format!("{} = common {}", n(dst), n(name)),
        Op::PostOption { dst, name } => format!("{} = option {}", n(dst), n(name)),
        Op::NextMotion { dst, word } => format!("{} = next coordinate {word}", n(dst)),
        Op::ToolDiameter { dst } => format!("{} = diameter of the tool", n(dst)),
        Op::NextTool { dst } => format!("{} = next tool", n(dst)),
        Op::Totals { dst, what, index } => format!("{} = totals {what} of {}", n(dst), n(index)),
        Op::PreviousMotion { dst, word } => format!("{} = previous coordinate {word}", n(dst)),
        Op::Post { template } => post(module, template),
        Op::Call { macro_id } => {
            let chunk = module.macros[usize::from(macro_id)];
            format!("call {}", module.chunks[usize::from(chunk)].title)
        }
        Op::Return => "return".to_string(),
        Op::Statement => "statement".to_string(),
        Op::Enter => "enter".to_string(),
        Op::Leave => "leave".to_string(),
        Op::Branch { number } => {
            format!("outcome {:?}", module.branches[usize::from(number)].outcome)
        }
    }
}

fn library(module: &Module, dst: String, call: u16) -> String {
    let call = module.calls[usize::from(call)];
    let base = name(module, call.base);
    format!("{dst} = {:?}({base}…{})", call.library, call.count)
}

fn post(module: &Module, template: u16) -> String {
    let template = &module.templates[usize::from(template)];
    let items = template.items.iter().map(|item| match item {
        Item::Value(reg) => name(module, *reg),
        Item::Minor(id) => format!("#{}", id.index()),
    });
    let items: Vec<String> = items.collect();
    format!("post {} {}", template.name, items.join(" "))
}
