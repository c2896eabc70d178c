//! Expressions of FIL evaluated while a run stands still. They can't change anything: what
//! reads records, sends words or asks the world outside is refused.

use fil_diag::Diag;
use fil_syntax::tree::{BinaryOp, Expr, ExprKind, Item, StmtKind, UnaryOp};
use fil_vm::builtins::{BUILTINS, FunctionKind};
use fil_vm::errors::RunCode as VmCode;
use fil_vm::{EMPTY, Held, PostfOp, Returned};

use super::DebugState;
use crate::outside::{common_kind, option_value};

type Result<T> = std::result::Result<T, Box<Diag>>;

/// Evaluates an expression of FIL: names, arrays, numbers, texts, conditions, functions of
/// numbers, ICODEF, LASTF, COMF, OPTIONF, COUPLF, HASF, and POSTF 1, 4 to 7, 9 and 17.
///
/// # Errors
/// What is no expression, and what could change the run.
pub fn evaluate(text: &str, state: &DebugState<'_, '_>) -> Result<Held> {
    let text = text.trim();
    if text.is_empty() || text.contains(['\n', '\r']) {
        return refuse("an expression must be on one line");
    }
    let fil_syntax::Parsed { program, diags } =
        fil_syntax::parse("expression", &format!("X={text}\n"));
    if let Some(error) = diags.iter().find(|diag| diag.is_error()) {
        return refuse(&error.message);
    }
    match &program.items[..] {
        [Item::Stmt(stmt), ..] => match &stmt.kind {
            StmtKind::Assign { value, .. } => value_of(value, state),
            _ => refuse("this is no expression"),
        },
        _ => refuse("this is no expression"),
    }
}

/// A value as people read it.
pub fn shown(value: &Held) -> String {
    match value {
        Held::Number(number) if *number == EMPTY => "EMPTY".to_string(),
        Held::Number(number) => number.to_string(),
        Held::Text(text) => format!("'{}'", text.replace('\'', "''")),
        Held::Unset => "never set".to_string(),
    }
}

fn refuse<T>(message: &str) -> Result<T> {
    VmCode::Missing.err(message)
}

fn value_of(expr: &Expr, state: &DebugState<'_, '_>) -> Result<Held> {
    match &expr.kind {
        ExprKind::Number(number) => Ok(Held::Number(*number)),
        ExprKind::Text(text) => Ok(Held::Text(text.clone())),
        ExprKind::Name(name) => named(name, state),
        ExprKind::Unary { op, operand } => {
            let value = number(operand, state)?;
            match op {
                UnaryOp::Minus => Ok(Held::Number(-value)),
                UnaryOp::Plus => Ok(Held::Number(value)),
                UnaryOp::Not => logical(!truth(value)?),
            }
        }
        ExprKind::Binary { op, left, right } => binary(*op, left, right, state),
        ExprKind::Call { name, args } => call(&name.text, args, state),
    }
}

fn named(name: &str, state: &DebugState<'_, '_>) -> Result<Held> {
    match (state.fil.value(name), name.as_bytes()) {
        (Some(Held::Unset) | None, [letter @ b'A'..=b'Z']) => {
            Ok(Held::Number(f64::from(letter - b'A' + 1)))
        }
        (Some(value), _) => Ok(value),
        (None, _) => refuse(&format!("no script uses a name {name}")),
    }
}

/// A number; a name that was never set is EMPTY.
fn number(expr: &Expr, state: &DebugState<'_, '_>) -> Result<f64> {
    match value_of(expr, state)? {
        Held::Number(number) => Ok(number),
        Held::Unset => Ok(EMPTY),
        Held::Text(text) => refuse(&format!("'{text}' is a text; a number is needed here")),
    }
}

fn truth(value: f64) -> Result<bool> {
    match value {
        0.0 => Ok(false),
        1.0 => Ok(true),
        _ => refuse(&format!("the condition is {value}")),
    }
}

fn logical(value: bool) -> Result<Held> {
    Ok(Held::Number(f64::from(u8::from(value))))
}

fn binary(op: BinaryOp, left: &Expr, right: &Expr, state: &DebugState<'_, '_>) -> Result<Held> {
    use BinaryOp::{Add, And, Div, Eq, Ge, Gt, Le, Lt, Mul, Ne, Or, Pow, Sub};
    if matches!(op, And | Or) {
        let first = truth(number(left, state)?)?;
        if first == (op == Or) {
            return logical(first);
        }
        return logical(truth(number(right, state)?)?);
    }
    if let (Held::Text(one), Held::Text(other)) = (value_of(left, state)?, value_of(right, state)?)
    {
        return compared(op, one.cmp(&other));
    }
    let (x, y) = (number(left, state)?, number(right, state)?);
    match op {
        Add => finite(x + y),
        Sub => finite(x - y),
        Mul => finite(x * y),
        Div => finite(x / y),
        Pow => finite(libm::pow(x, y)),
        Eq | Ne | Lt | Le | Gt | Ge | And | Or => compared(op, (x + 0.0).total_cmp(&(y + 0.0))),
    }
}

fn compared(op: BinaryOp, order: std::cmp::Ordering) -> Result<Held> {
    match op {
        BinaryOp::Eq => logical(order.is_eq()),
        BinaryOp::Ne => logical(order.is_ne()),
        BinaryOp::Lt => logical(order.is_lt()),
        BinaryOp::Le => logical(order.is_le()),
        BinaryOp::Gt => logical(order.is_gt()),
        BinaryOp::Ge => logical(order.is_ge()),
        _ => refuse("texts are compared, not calculated with"),
    }
}

fn finite(result: f64) -> Result<Held> {
    if result.is_finite() { Ok(Held::Number(result)) } else { refuse("there is no finite result") }
}

fn call(name: &str, args: &[Expr], state: &DebugState<'_, '_>) -> Result<Held> {
    if let [index] = args
        && state.fil.arrays().iter().any(|(array, _)| array == name)
    {
        let index = number(index, state)?;
        let element = state.fil.element(name, index as usize).filter(|_| index.fract() == 0.0);
        return element.map_or_else(|| refuse(&format!("there is no {name}({index})")), Ok);
    }
    let Some(builtin) = BUILTINS.iter().find(|known| known.name == name) else {
        return refuse(&format!("there is no function or array {name} to evaluate here"));
    };
    match (builtin.kind, args) {
        (FunctionKind::Numbers(arity, body), _) if args.len() == usize::from(arity) => {
            let values: Vec<f64> =
                args.iter().map(|arg| number(arg, state)).collect::<Result<_>>()?;
            body(&values).map_or_else(|| refuse("there is no result"), finite)
        }
        (FunctionKind::Fold(body), [first, rest @ ..]) if !rest.is_empty() => {
            let mut value = number(first, state)?;
            for arg in rest {
                let Some(next) = body(&[value, number(arg, state)?]) else {
                    return refuse("there is no result");
                };
                value = next;
            }
            finite(value)
        }
        (FunctionKind::WordCode, [word]) => match state.fil.vocabulary.find(word_of(word)?) {
            Some(id) => Ok(Held::Number(state.fil.vocabulary.code(id))),
            None => refuse("no such word was named so far"),
        },
        (FunctionKind::HasWord, [word]) => {
            let id = state.fil.vocabulary.find(word_of(word)?);
            logical(id.is_some_and(|id| record(state).is_ok_and(|record| record.has(id))))
        }
        (FunctionKind::Couplet, [word, default @ ..]) => {
            let id = state.fil.vocabulary.find(word_of(word)?);
            match (id.and_then(|id| record(state).ok()?.number_after(id)), default) {
                (Some(value), _) => Ok(Held::Number(value)),
                (None, [default]) => value_of(default, state),
                (None, _) => refuse("no number follows that word in this record"),
            }
        }
        (FunctionKind::LastWritten, [letter]) => {
            let number = number(letter, state)?;
            if !(1.0..=26.0).contains(&number) || number.fract() != 0.0 {
                return refuse("letters are 1 to 26");
            }
            common(state, 3.0, 355.0 + number)
        }
        (FunctionKind::NamedCommon, [name]) => match value_of(name, state)? {
            Held::Text(name) => common_named(state, &name),
            _ => refuse("COMF needs the name as a text"),
        },
        (FunctionKind::PostOption, [name]) => match value_of(name, state)? {
            Held::Text(name) => match state.commons().options().find(&name) {
                Some(option) => Ok(match option_value(&option.value, state.unit())? {
                    Returned::Number(number) => Held::Number(number),
                    Returned::Text(text) => Held::Text(text),
                }),
                None => refuse(&format!("the post has no option '{name}'")),
            },
            _ => refuse("OPTIONF needs the name as a text"),
        },
        (FunctionKind::Postf, [which, rest @ ..]) => postf(which, rest, state),
        _ => refuse(&format!("{} is not evaluated here: it could change the run", builtin.call())),
    }
}

fn word_of(expr: &Expr) -> Result<&str> {
    match &expr.kind {
        ExprKind::Name(name) => Ok(name),
        _ => refuse("a word is needed here"),
    }
}

fn record<'a>(state: &'a DebugState<'_, '_>) -> Result<&'a fil_cl::Record> {
    state.fil.record.as_deref().map_or_else(|| refuse("there is no current record"), Ok)
}

fn common(state: &DebugState<'_, '_>, kind: f64, location: f64) -> Result<Held> {
    let whole = location as u32;
    match fil_vm::CommonKind::from_type(kind) {
        Some(kind) if f64::from(whole) == location => {
            fil_machine::in_force_at(state.commons(), common_kind(kind), whole).map(Held::Number)
        }
        _ => refuse("there is no such location"),
    }
}

fn common_named(state: &DebugState<'_, '_>, name: &str) -> Result<Held> {
    match fil_machine::in_force(state.commons(), name) {
        Some(value) => value.map(Held::Number),
        None => refuse(&format!("no common is named '{name}'")),
    }
}

fn postf(which: &Expr, args: &[Expr], state: &DebugState<'_, '_>) -> Result<Held> {
    let which = number(which, state)?;
    let args: Vec<f64> = args.iter().map(|arg| number(arg, state)).collect::<Result<_>>()?;
    match (state.fil.module().compat.operation(which), &args[..]) {
        (Some(PostfOp::GetCommon), [kind, location]) => common(state, *kind, *location),
        (Some(PostfOp::Empty), []) => Ok(Held::Number(EMPTY)),
        (Some(PostfOp::Length), []) => Ok(Held::Number(record(state)?.len() as f64)),
        (Some(PostfOp::Number), []) => Ok(Held::Number(f64::from(record(state)?.number))),
        (Some(PostfOp::Class), [n]) => {
            Ok(Held::Number(f64::from(record(state)?.class(*n as usize))))
        }
        (Some(PostfOp::Word), [n]) => word(state, *n as usize),
        (Some(PostfOp::Find), [from, code]) => {
            let record = record(state)?;
            let vocabulary = &state.fil.vocabulary;
            let is_it = |n: &usize| matches!(record.data_word(*n), Some(fil_cl::Word::Minor(id)) if vocabulary.code(id) == *code);
            let found = ((*from as usize).max(4)..=record.len()).find(is_it);
            Ok(Held::Number(found.unwrap_or(0) as f64))
        }
        _ => refuse("this POSTF is not evaluated here: it could change the run"),
    }
}

/// A word of the current record, as POSTF(7,n) gives it.
fn word(state: &DebugState<'_, '_>, n: usize) -> Result<Held> {
    let record = record(state)?;
    if let Some(value) = record.value(n, state.fil.vocabulary) {
        return Ok(Held::Number(value));
    }
    Ok(match record.data_word(n) {
        Some(word @ fil_cl::Word::Text { .. }) => Held::Text(record.text_of(word).to_string()),
        _ => Held::Number(EMPTY),
    })
}
