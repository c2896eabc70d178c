//! What a debugger sees of a machine that stands still, and may set.

use fil_cl::{Record, Vocabulary};
use fil_diag::{Diag, TextSpan};

use super::{Interpreter, Registers, Spot, State, Vm};
use crate::debug::Probe;
use crate::errors::RunCode;
use crate::host::Host;
use crate::module::{Module, Statement};
use crate::ops::{Reg, Target};
use crate::value::{EMPTY, Slot, Value};

/// What a name holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Held {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// It was never set.
    Unset,
}

/// A call that is open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StackFrame {
    /// `section CYCLE`, `macro DEEPHL`, `global area of a.fil`.
    pub title: String,
    /// The statement that runs next, or that has called.
    pub place: TextSpan,
}

/// A machine that stands still: before a statement, or between two records.
pub struct View<'a> {
    module: &'a Module,
    registers: &'a mut Registers,
    state: &'a mut State,
    text_bytes: usize,
    /// `None` between two records.
    spot: Option<Spot>,
    /// The current record.
    pub record: Option<&'a mut Record>,
    /// The words it names.
    pub vocabulary: &'a mut Vocabulary,
}

impl View<'_> {
    /// The compiled FIL.
    pub fn module(&self) -> &Module {
        self.module
    }

    /// Number of the statement that runs next; `None` between two records.
    pub fn statement(&self) -> Option<u32> {
        let spot = self.spot?;
        Some(self.module.chunks[usize::from(spot.chunk)].statements[spot.pc])
    }

    /// Where that statement stands: file by its index, and line.
    pub fn line(&self) -> Option<(u16, u32)> {
        let Statement { file, line, .. } = self.module.statements[self.statement()? as usize];
        Some((file, line))
    }

    /// Number of the global area, section or macro that runs.
    pub fn part(&self) -> Option<usize> {
        self.spot.map(|spot| usize::from(spot.chunk))
    }

    /// Macro calls that are open.
    pub fn depth(&self) -> usize {
        self.state.frames.len()
    }

    /// The open calls, innermost first; none between two records.
    pub fn stack(&self) -> Vec<StackFrame> {
        let Some(spot) = self.spot else { return Vec::new() };
        let spots = std::iter::once(&spot).chain(self.state.frames.iter().rev());
        let frame = |spot: &Spot| StackFrame {
            title: self.module.chunks[usize::from(spot.chunk)].title.clone(),
            place: self.module.place(self.module.statement(spot.chunk, spot.pc)),
        };
        spots.map(frame).collect()
    }

    /// The names that all files share and their values, sorted.
    pub fn names(&self) -> Vec<(String, Held)> {
        let shared = self.module.variables.iter();
        let mut names: Vec<(String, Held)> =
            shared.map(|(name, reg)| (name.clone(), self.held(*reg))).collect();
        names.sort_by(|one, other| one.0.cmp(&other.0));
        names
    }

    /// The names of the statement that runs next, with their values.
    pub fn used(&self) -> Vec<(String, Held)> {
        let Some(statement) = self.statement() else { return Vec::new() };
        let names = self.module.statements[statement as usize].names.iter();
        let named = names.filter_map(|reg| Some((self.module.names.get(reg)?.clone(), *reg)));
        named.map(|(name, reg)| (name, self.held(reg))).collect()
    }

    /// The parameters of the macro that runs.
    pub fn parameters(&self) -> Vec<(String, Held)> {
        let Some(part) = self.part() else { return Vec::new() };
        let parameters = self.module.chunks[part].parameters.iter();
        parameters.map(|(name, reg)| (name.clone(), self.held(*reg))).collect()
    }

    /// What a name holds here, a parameter before a shared one; `None` for a name that no
    /// script uses.
    pub fn value(&self, name: &str) -> Option<Held> {
        self.register(name).map(|reg| self.held(reg))
    }

    /// Sets a name that some script uses.
    ///
    /// # Errors
    /// A name that no script uses; a number that is not finite; a text beyond the limit.
    pub fn set(&mut self, name: &str, value: &Held) -> Result<(), Box<Diag>> {
        let slot = self.slot(value)?;
        let Some(reg) = self.register(name) else {
            return RunCode::Missing.err(format!("no script uses a name {name}"));
        };
        self.registers[usize::from(reg)] = slot;
        Ok(())
    }

    /// The arrays and their lengths.
    pub fn arrays(&self) -> Vec<(String, usize)> {
        self.module.arrays.iter().map(|array| (array.name.clone(), array.len)).collect()
    }

    /// An element of an array, from 1; `None` where there is none.
    pub fn element(&self, array: &str, index: usize) -> Option<Held> {
        let at = self.element_at(array, index)?;
        Some(self.told(self.state.arrays[at].value()))
    }

    /// Sets an element of an array, from 1.
    ///
    /// # Errors
    /// No such element; as [`View::set`].
    pub fn set_element(
        &mut self,
        array: &str,
        index: usize,
        value: &Held,
    ) -> Result<(), Box<Diag>> {
        let slot = self.slot(value)?;
        let Some(at) = self.element_at(array, index) else {
            return RunCode::Missing.err(format!("there is no {array}({index})"));
        };
        self.state.arrays[at] = slot;
        Ok(())
    }

    fn register(&self, name: &str) -> Option<Reg> {
        let own = self.part().map(|part| &self.module.chunks[part].parameters);
        let own = own.and_then(|list| list.iter().find(|(known, _)| known == name));
        own.map(|(_, reg)| *reg).or_else(|| self.module.variables.get(name).copied())
    }

    fn element_at(&self, array: &str, index: usize) -> Option<usize> {
        let shape = self.module.arrays.iter().find(|shape| shape.name == array)?;
        (1..=shape.len).contains(&index).then(|| shape.start + index - 1)
    }

    fn held(&self, reg: Reg) -> Held {
        self.told(self.registers[usize::from(reg)].value())
    }

    fn told(&self, value: Value) -> Held {
        match value {
            Value::Number(number) => Held::Number(number),
            Value::Word(id) => Held::Number(self.vocabulary.code(id)),
            Value::Empty => Held::Number(EMPTY),
            Value::Text(id) => Held::Text(self.state.texts.get(id).to_string()),
            Value::Unset => Held::Unset,
        }
    }

    fn slot(&mut self, value: &Held) -> Result<Slot, Box<Diag>> {
        Ok(match value {
            Held::Number(number) if number.is_finite() => Value::of(*number).into(),
            Held::Number(number) => return RunCode::Domain.err(format!("{number} is not finite")),
            Held::Text(text) => match self.state.texts.add(text, self.text_bytes) {
                Ok(id) => Value::Text(id).into(),
                Err(_) => return RunCode::TextLimit.err("no room is left for the text"),
            },
            Held::Unset => Slot::UNSET,
        })
    }
}

impl Interpreter {
    /// A view of the machine between two records.
    pub fn view<'a>(
        &'a mut self,
        record: Option<&'a mut Record>,
        vocabulary: &'a mut Vocabulary,
    ) -> View<'a> {
        View {
            module: &self.module,
            registers: self.registers.get(),
            state: &mut self.state,
            text_bytes: self.limits.text_bytes,
            spot: None,
            record,
            vocabulary,
        }
    }
}

impl<H: Host + ?Sized> Vm<'_, H> {
    /// Tells the host of a step.
    #[cold]
    pub(super) fn probe(
        &mut self,
        registers: &mut Registers,
        probe: Probe<'_>,
    ) -> Result<Option<Target>, Box<Diag>> {
        let mut view = View {
            module: self.module,
            registers,
            state: self.state,
            text_bytes: self.limits.text_bytes,
            spot: Some(self.spot),
            record: self.record.as_deref_mut(),
            vocabulary: self.vocab,
        };
        self.host.probe(probe, &mut view).map(|()| None)
    }

    /// An error with its place; a debug build tells of it while the machine stands there.
    #[cold]
    pub(super) fn failed(&mut self, registers: &mut Registers, diag: Box<Diag>) -> Box<Diag> {
        let diag = self.locate(registers, diag);
        if !self.module.debug {
            return diag;
        }
        match self.probe(registers, Probe::Failed(&diag)) {
            Ok(_) => diag,
            Err(other) => other,
        }
    }
}
