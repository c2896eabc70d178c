//! Writes a tree back as FIL text, one statement a line, without layout.

use std::fmt::{self, Write};

use crate::tree::{
    BinaryOp, Expr, ExprKind, Item, Name, Program, SectionKey, Stmt, StmtKind, Target, UnaryOp,
};

/// The tree as FIL text; reading it again gives the same tree but for its spans.
pub fn print(program: &Program) -> String {
    let mut out = String::new();
    for item in &program.items {
        // Writing to a string cannot fail.
        let _ = write_item(&mut out, item);
    }
    out
}

fn write_item(out: &mut String, item: &Item) -> fmt::Result {
    match item {
        Item::Stmt(stmt) => write_stmt(out, stmt),
        Item::Section(section) => {
            out.push_str("CIMFIL/ON,");
            match &section.key {
                SectionKey::Words { major, minors } => {
                    out.push_str(&major.text);
                    minors.iter().try_for_each(|minor| write!(out, ",{}", minor.text))?;
                }
                SectionKey::Types { kind, sub, .. } => {
                    write!(out, "{kind}")?;
                    sub.iter().try_for_each(|sub| write!(out, ",{sub}"))?;
                }
            }
            out.push('\n');
            write_body(out, &section.body)?;
            writeln!(out, "CIMFIL/OFF")
        }
        Item::Macro(makro) => {
            write!(out, "{}=MACRO", makro.name.text)?;
            for (index, (name, default)) in makro.params.iter().enumerate() {
                write!(out, "{}{}", if index == 0 { "/" } else { "," }, name.text)?;
                if let Some(value) = default {
                    write!(out, "={}", expr(value))?;
                }
            }
            out.push('\n');
            write_body(out, &makro.body)?;
            writeln!(out, "TERMAC")
        }
    }
}

fn write_body(out: &mut String, body: &[Stmt]) -> fmt::Result {
    body.iter().try_for_each(|stmt| write_stmt(out, stmt))
}

fn write_stmt(out: &mut String, stmt: &Stmt) -> fmt::Result {
    if let Some(label) = &stmt.label {
        write!(out, "{}) ", label.text)?;
    }
    write_kind(out, &stmt.kind)
}

fn write_kind(out: &mut String, kind: &StmtKind) -> fmt::Result {
    match kind {
        StmtKind::If { .. } | StmtKind::Do { .. } | StmtKind::Case { .. } => write_block(out, kind),
        StmtKind::IfOne { condition, then } => {
            write!(out, "IF({}) ", expr(condition))?;
            write_kind(out, &then.kind)
        }
        _ => writeln!(out, "{}", simple(kind)),
    }
}

/// IF, DO and CASE with all that is in them.
fn write_block(out: &mut String, kind: &StmtKind) -> fmt::Result {
    match kind {
        StmtKind::If { arms, otherwise } => {
            for (index, (condition, body)) in arms.iter().enumerate() {
                let word = if index == 0 { "IF" } else { "ELSEIF" };
                writeln!(out, "{word}({})THEN", expr(condition))?;
                write_body(out, body)?;
            }
            if let Some(body) = otherwise {
                out.push_str("ELSE\n");
                write_body(out, body)?;
            }
            writeln!(out, "ENDIF")
        }
        StmtKind::Do { label, variable, range, body } => {
            let (variable, from, to) = (target(variable), expr(&range.from), expr(&range.to));
            write!(out, "DO/{},{variable}={from},{to}", label.text)?;
            range.step.iter().try_for_each(|step| write!(out, ",{}", expr(step)))?;
            out.push('\n');
            write_body(out, body)
        }
        StmtKind::Case { subject, whens, other } => {
            writeln!(out, "CASE/{}", expr(subject))?;
            for when in whens {
                writeln!(out, "WHEN/{}", list(&when.values))?;
                write_body(out, &when.body)?;
            }
            if let Some(body) = other {
                out.push_str("WHEN/OTHER\n");
                write_body(out, body)?;
            }
            writeln!(out, "ENDCAS")
        }
        _ => Ok(()),
    }
}

/// A statement that is one line.
fn simple(kind: &StmtKind) -> String {
    match kind {
        StmtKind::Assign { target: to, value } => format!("{}={}", target(to), assigned(value)),
        StmtKind::Text { target: to, args } => format!("{}=TEXT/{}", target(to), list(args)),
        StmtKind::Post { word, args } if args.is_empty() => word.text.clone(),
        StmtKind::Post { word, args } => format!("{}/{}", word.text, list(args)),
        StmtKind::PostText { word, text } => format!("{}/{text}", word.text),
        StmtKind::IfSign { value, labels } => {
            let [a, b, c] = &**labels;
            format!("IF({}) {},{},{}", expr(value), a.text, b.text, c.text)
        }
        StmtKind::Jump { label } => format!("JUMPTO/{}", label.text),
        StmtKind::Call { name, args } => call(name, args),
        StmtKind::Reserv { arrays } => {
            let arrays: Vec<_> =
                arrays.iter().map(|(name, size)| format!("{},{}", name.text, expr(size))).collect();
            format!("RESERV/{}", arrays.join(","))
        }
        StmtKind::Print { on, input } => {
            format!("PRINT/{}{}", on_off(*on), if *input { ",IN" } else { "" })
        }
        StmtKind::Redef { on } => format!("REDEF/{}", on_off(*on)),
        StmtKind::Includ { file } => format!("INCLUD/{}", quoted(file)),
        StmtKind::Contin => "CONTIN".to_string(),
        StmtKind::Fini => "FINI".to_string(),
        StmtKind::If { .. }
        | StmtKind::IfOne { .. }
        | StmtKind::Do { .. }
        | StmtKind::Case { .. } => String::new(),
    }
}

fn call(name: &Name, args: &[(Option<Name>, Expr)]) -> String {
    let mut out = format!("CALL/{}", name.text);
    for (name, value) in args {
        out.push(',');
        if let Some(name) = name {
            out.push_str(&name.text);
            out.push('=');
        }
        out.push_str(&expr(value));
    }
    out
}

fn on_off(on: bool) -> &'static str {
    if on { "ON" } else { "OFF" }
}

fn target(target: &Target) -> String {
    match &target.index {
        Some(index) => format!("{}({})", target.name.text, expr(index)),
        None => target.name.text.clone(),
    }
}

/// The value of an assignment; one that would read as TEXT/ or MACRO gets brackets.
fn assigned(value: &Expr) -> String {
    let text = expr(value);
    let word = text.split('/').next().unwrap_or_default();
    if word == "MACRO" || (word == "TEXT" && text != "TEXT") { format!("({text})") } else { text }
}

fn list(values: &[Expr]) -> String {
    values.iter().map(expr).collect::<Vec<_>>().join(",")
}

fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}

/// An expression as FIL text, with the brackets it needs.
pub fn expr(value: &Expr) -> String {
    let mut out = String::new();
    write_expr(&mut out, value, OR);
    out
}

const OR: u8 = 1;
const AND: u8 = 2;
const NOT: u8 = 3;
const RELATION: u8 = 4;
const SUM: u8 = 5;
const PRODUCT: u8 = 6;
const POWER: u8 = 7;
const SIGN: u8 = 8;
const ATOM: u8 = 9;

/// Writes an expression that must bind at least as close as `level`.
fn write_expr(out: &mut String, value: &Expr, level: u8) {
    let own = level_of(&value.kind);
    if own < level {
        out.push('(');
        write_kind_of(out, &value.kind);
        out.push(')');
    } else {
        write_kind_of(out, &value.kind);
    }
}

fn write_kind_of(out: &mut String, kind: &ExprKind) {
    match kind {
        ExprKind::Number(number) => out.push_str(&number.to_string()),
        ExprKind::Text(text) => out.push_str(&quoted(text)),
        ExprKind::Name(name) => out.push_str(name),
        ExprKind::Call { name, args } => {
            out.push_str(&name.text);
            out.push('(');
            out.push_str(&list(args));
            out.push(')');
        }
        ExprKind::Unary { op, operand } => {
            let (sign, level) = match op {
                UnaryOp::Minus => ("-", SIGN),
                UnaryOp::Plus => ("+", SIGN),
                UnaryOp::Not => (".NOT.", NOT),
            };
            out.push_str(sign);
            write_expr(out, operand, level);
        }
        ExprKind::Binary { op, left, right } => {
            let (sign, left_level, right_level) = operator(*op);
            write_expr(out, left, left_level);
            out.push_str(sign);
            write_expr(out, right, right_level);
        }
    }
}

fn level_of(kind: &ExprKind) -> u8 {
    match kind {
        ExprKind::Number(number) if number.is_sign_negative() => SIGN,
        ExprKind::Unary { op: UnaryOp::Not, .. } => NOT,
        ExprKind::Unary { .. } => SIGN,
        ExprKind::Binary { op, .. } => match op {
            BinaryOp::Or => OR,
            BinaryOp::And => AND,
            BinaryOp::Add | BinaryOp::Sub => SUM,
            BinaryOp::Mul | BinaryOp::Div => PRODUCT,
            BinaryOp::Pow => POWER,
            _ => RELATION,
        },
        _ => ATOM,
    }
}

/// The sign of an operator and how close its operands must bind.
fn operator(op: BinaryOp) -> (&'static str, u8, u8) {
    match op {
        BinaryOp::Or => (".OR.", OR, AND),
        BinaryOp::And => (".AND.", AND, NOT),
        BinaryOp::Eq => (".EQ.", SUM, SUM),
        BinaryOp::Ne => (".NE.", SUM, SUM),
        BinaryOp::Lt => (".LT.", SUM, SUM),
        BinaryOp::Le => (".LE.", SUM, SUM),
        BinaryOp::Gt => (".GT.", SUM, SUM),
        BinaryOp::Ge => (".GE.", SUM, SUM),
        BinaryOp::Add => ("+", SUM, PRODUCT),
        BinaryOp::Sub => ("-", SUM, PRODUCT),
        BinaryOp::Mul => ("*", PRODUCT, POWER),
        BinaryOp::Div => ("/", PRODUCT, POWER),
        BinaryOp::Pow => ("**", ATOM, POWER),
    }
}
