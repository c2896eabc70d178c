//! Statements and the ways between them.

use std::collections::HashMap;

use fil_syntax::tree::{Expr, ExprKind, Name, Span, Stmt, StmtKind, Target};

use super::Oracle;
use super::value::{Class, Fault, Rec, Value, Word};

/// Where to go after a statement.
enum Flow {
    /// To the one after it.
    Next,
    /// To a label.
    Jump(String),
    /// To the end: FINI.
    End,
}

impl Oracle<'_> {
    /// Runs a global area or section: new fuel, no calls.
    pub(super) fn body(&mut self, body: &[&Stmt]) -> Result<(), Fault> {
        self.fuel = self.limit;
        self.at_end = false;
        self.list(body, None).map(|_| ())
    }

    /// Runs statements from the first, or from a label in one of them.
    fn list(&mut self, list: &[&Stmt], from: Option<String>) -> Result<Flow, Fault> {
        let mut enter = from;
        let mut at = match &enter {
            Some(label) => list.iter().position(|stmt| holds(stmt, label)).unwrap_or(0),
            None => 0,
        };
        while let Some(stmt) = list.get(at) {
            match self.statement(stmt, enter.take())? {
                Flow::Next => at += 1,
                Flow::End => return Ok(Flow::End),
                Flow::Jump(label) => match list.iter().position(|stmt| holds(stmt, &label)) {
                    None => return Ok(Flow::Jump(label)),
                    Some(target) => {
                        if target <= at {
                            self.burn(stmt.span)?;
                        }
                        at = target;
                        enter = Some(label);
                    }
                },
            }
        }
        Ok(Flow::Next)
    }

    fn all(&mut self, body: &[Stmt], from: Option<String>) -> Result<Flow, Fault> {
        self.list(&body.iter().collect::<Vec<_>>(), from)
    }

    /// Runs a statement, or from a label inside of it.
    fn statement(&mut self, stmt: &Stmt, enter: Option<String>) -> Result<Flow, Fault> {
        let inside = enter.filter(|label| !is(&stmt.label, label));
        if let Some(label) = inside {
            let within = parts(stmt).into_iter().find(|part| any_holds(part, &label));
            return match within {
                Some(part) => self.all(part, Some(label)),
                None => Ok(Flow::Next),
            };
        }
        match &stmt.kind {
            StmtKind::Assign { target, value } => {
                // From left to right: the subscript comes before the value.
                let index = self.index(target)?;
                let value = self.eval(value)?;
                self.set(target, index, value)?;
            }
            StmtKind::Text { target, args } => {
                let index = self.index(target)?;
                let text = self.joined(args, stmt.span)?;
                self.set(target, index, Value::Text(text))?;
            }
            StmtKind::Post { word, args } => self.post(word, args, stmt.span)?,
            StmtKind::PostText { word, text } => {
                let text = match self.is_variable(text) {
                    true => {
                        let value = self.read(text, stmt.span);
                        self.written([value], stmt.span)?
                    }
                    false => text.clone(),
                };
                self.post_text(word, &text, stmt.span);
            }
            StmtKind::If { arms, otherwise } => return self.choose(arms, otherwise.as_deref()),
            StmtKind::IfOne { condition, then } => {
                if self.condition(condition)? {
                    return self.statement(then, None);
                }
            }
            StmtKind::IfSign { value, labels } => {
                let [negative, zero, positive] = &**labels;
                let value = self.eval(value)?;
                let Some(value) = self.plain(&value) else {
                    return self.fault(Class::WrongType, stmt.span);
                };
                let label = if value < 0.0 {
                    negative
                } else if value > 0.0 {
                    positive
                } else {
                    zero
                };
                return Ok(Flow::Jump(label.text.clone()));
            }
            StmtKind::Jump { label } => return Ok(Flow::Jump(label.text.clone())),
            StmtKind::Do { .. } => return self.repeat(stmt),
            StmtKind::Case { .. } => return self.case(stmt),
            StmtKind::Call { name, args } => self.call_macro(name, args, stmt.span)?,
            StmtKind::Fini => return Ok(Flow::End),
            StmtKind::Reserv { .. }
            | StmtKind::Print { .. }
            | StmtKind::Redef { .. }
            | StmtKind::Contin => {}
            StmtKind::Includ { .. } => return self.fault(Class::Unknown, stmt.span),
        }
        Ok(Flow::Next)
    }

    fn choose(
        &mut self,
        arms: &[(Expr, Vec<Stmt>)],
        otherwise: Option<&[Stmt]>,
    ) -> Result<Flow, Fault> {
        for (condition, body) in arms {
            if self.condition(condition)? {
                return self.all(body, None);
            }
        }
        self.all(otherwise.unwrap_or_default(), None)
    }

    fn case(&mut self, stmt: &Stmt) -> Result<Flow, Fault> {
        let StmtKind::Case { subject, whens, other } = &stmt.kind else { return Ok(Flow::Next) };
        let subject = self.eval(subject)?;
        for when in whens {
            for value in &when.values {
                let candidate = self.eval(value)?;
                if self.equal(&subject, &candidate, value.span)? {
                    return self.all(&when.body, None);
                }
            }
        }
        self.all(other.as_deref().unwrap_or_default(), None)
    }

    /// DO: the test comes first; start, end and step are settled once.
    fn repeat(&mut self, stmt: &Stmt) -> Result<Flow, Fault> {
        let StmtKind::Do { variable, range, body, .. } = &stmt.kind else {
            return Ok(Flow::Next);
        };
        let from = self.number(&range.from)?;
        let to = self.number(&range.to)?;
        let step = match &range.step {
            Some(step) => self.number(step)?,
            None => 1.0,
        };
        self.set(variable, None, Value::Number(from))?;
        if step == 0.0 {
            return self.fault(Class::ZeroStep, stmt.span);
        }
        loop {
            let Value::Number(now) = self.read(&variable.name.text, stmt.span) else {
                return self.fault(Class::WrongType, stmt.span);
            };
            if (step > 0.0 && now > to) || (step < 0.0 && now < to) {
                return Ok(Flow::Next);
            }
            self.burn(stmt.span)?;
            match self.all(body, None)? {
                Flow::Next => {}
                away => return Ok(away),
            }
            let Value::Number(now) = self.read(&variable.name.text, stmt.span) else {
                return self.fault(Class::WrongType, stmt.span);
            };
            if !(now + step).is_finite() {
                return self.fault(Class::Domain, stmt.span);
            }
            self.set(variable, None, Value::Number(now + step))?;
        }
    }

    /// CALL: parameters are the macro's own, all other names are everybody's.
    fn call_macro(
        &mut self,
        name: &Name,
        args: &[(Option<Name>, Expr)],
        span: Span,
    ) -> Result<(), Fault> {
        let Some(definition) = self.macros.get(name.text.as_str()).copied() else {
            return self.fault(Class::Unknown, span);
        };
        let mut frame = HashMap::new();
        for (index, (parameter, value)) in args.iter().enumerate() {
            let parameter =
                parameter.as_ref().or(definition.params.get(index).map(|(name, _)| name));
            let value = self.eval(value)?;
            if let Some(parameter) = parameter {
                frame.insert(parameter.text.clone(), value);
            }
        }
        for (parameter, default) in &definition.params {
            if let (false, Some(default)) = (frame.contains_key(&parameter.text), default) {
                let value = self.eval(default)?;
                frame.insert(parameter.text.clone(), value);
            }
        }
        self.burn(span)?;
        self.frames.push(frame);
        self.callers.push(self.line(span));
        let flow = self.all(&definition.body, None);
        self.frames.pop();
        // The calls of a fault are not compared, so they may stay behind.
        flow?;
        self.callers.pop();
        Ok(())
    }

    fn index(&mut self, target: &Target) -> Result<Option<Value>, Fault> {
        target.index.as_ref().map(|index| self.eval(index)).transpose()
    }

    fn set(&mut self, target: &Target, index: Option<Value>, value: Value) -> Result<(), Fault> {
        let name = &target.name.text;
        if let Some(index) = index {
            let index = self.element(name, &index, target.name.span)?;
            if let Some(array) = self.arrays.get_mut(name) {
                array[index] = Some(value);
            }
            return Ok(());
        }
        let own = self.frames.last_mut().and_then(|frame| frame.get_mut(name));
        match own {
            Some(place) => *place = value,
            None => {
                self.variables.insert(name.clone(), value);
            }
        }
        Ok(())
    }

    /// Texts and numbers as one text.
    fn joined(&mut self, args: &[Expr], span: Span) -> Result<String, Fault> {
        let values: Vec<Value> = args.iter().map(|arg| self.eval(arg)).collect::<Result<_, _>>()?;
        self.written(values, span)
    }

    /// Values as one text; neither EMPTY nor a word is a number of it.
    fn written(
        &self,
        values: impl IntoIterator<Item = Value>,
        span: Span,
    ) -> Result<String, Fault> {
        let mut text = String::new();
        for value in values {
            if matches!(value, Value::Empty | Value::Minor(_)) {
                return self.fault(Class::WrongType, span);
            }
            text += &written(value);
        }
        Ok(text)
    }

    /// A post word: a bare name that nothing sets is a minor word.
    fn post(&mut self, word: &Name, args: &[Expr], span: Span) -> Result<(), Fault> {
        let takes_text = ["PARTNO", "PPRINT", "INSERT", "LETTER"].contains(&word.text.as_str());
        if takes_text {
            let mut values = Vec::new();
            for arg in args {
                values.push(match &arg.kind {
                    ExprKind::Name(name) if !self.is_variable(name) => Value::Text(name.clone()),
                    _ => self.eval(arg)?,
                });
            }
            let text = self.written(values, span)?;
            self.post_text(word, &text, span);
            return Ok(());
        }
        let mut data = Vec::new();
        for arg in args {
            data.push(match &arg.kind {
                ExprKind::Name(name) if !self.is_variable(name) => Word::Minor(name.clone()),
                _ => match self.eval(arg)? {
                    Value::Empty => Word::Empty,
                    Value::Minor(name) => Word::Minor(name),
                    Value::Number(number) => Word::Number(number),
                    Value::Text(text) => Word::Text(text),
                },
            });
        }
        let is_goto = word.text == "GOTO";
        if is_goto {
            if data.iter().any(|word| !matches!(word, Word::Number(_))) {
                return self.fault(Class::BadRecord, span);
            }
            data.splice(0..0, [Word::Empty, Word::Empty]);
        }
        let (kind, sub) = if is_goto { (5000, 5) } else { (2000, 0) };
        let record = Rec { number: 0, kind, sub, major: word.text.clone(), data };
        self.command(&record, span);
        Ok(())
    }

    fn post_text(&mut self, word: &Name, text: &str, span: Span) {
        let data = vec![Word::Text(text.to_string())];
        let record = Rec { number: 0, kind: 2000, sub: 0, major: word.text.clone(), data };
        self.command(&record, span);
    }

    fn is_variable(&self, name: &str) -> bool {
        let own = self.frames.last().is_some_and(|frame| frame.contains_key(name));
        own || self.assigned.contains(name)
    }

    fn burn(&mut self, span: Span) -> Result<(), Fault> {
        if self.fuel == 0 {
            return self.fault(Class::OutOfFuel, span);
        }
        self.fuel -= 1;
        Ok(())
    }
}

/// A value as texts show it: a number in its shortest form.
fn written(value: Value) -> String {
    match value {
        Value::Text(text) => text,
        // Adding 0 makes a -0 plain.
        Value::Number(number) => (number + 0.0).to_string(),
        Value::Minor(_) | Value::Empty => String::new(),
    }
}

fn is(label: &Option<Name>, wanted: &str) -> bool {
    label.as_ref().is_some_and(|label| label.text == wanted)
}

/// True when a jump to the label leads into this statement. A DO is entered
/// through its head only, so labels in its body do not count.
fn holds(stmt: &Stmt, label: &str) -> bool {
    is(&stmt.label, label) || parts(stmt).into_iter().any(|part| any_holds(part, label))
}

fn any_holds(body: &[Stmt], label: &str) -> bool {
    body.iter().any(|stmt| holds(stmt, label))
}

/// The statement lists of an IF or CASE.
fn parts(stmt: &Stmt) -> Vec<&[Stmt]> {
    match &stmt.kind {
        StmtKind::If { arms, otherwise } => {
            arms.iter().map(|(_, body)| body.as_slice()).chain(otherwise.as_deref()).collect()
        }
        StmtKind::Case { whens, other, .. } => {
            whens.iter().map(|when| when.body.as_slice()).chain(other.as_deref()).collect()
        }
        _ => Vec::new(),
    }
}
