//! The machine: runs the global area once, then sections for records.

mod bank;
mod careful;
mod files;
mod library;
mod output;
mod post;
mod postf;
mod report;
mod run;
mod slow;
mod texts;
mod totals;
mod view;

use std::collections::HashSet;
use std::sync::Arc;

use fil_cl::Vocabulary;
use fil_cl::{Record, Word, WordId};
use fil_diag::Diag;

use crate::functions::Functions;
use crate::host::{FileMode, Host, Site};
use crate::module::{ChunkId, Constant, Module, SectionId};
use crate::value::{EMPTY, Slot, Texts, Value};

use bank::Bank;
pub use output::Values;
pub use view::{Held, StackFrame, View};

/// The register file: indexed by `u16`, so no access is out of bounds.
pub(crate) type Registers = [Slot; 1 << 16];

/// First register of the temporaries of expressions.
pub(crate) const FIRST_TEMPORARY: u16 = 0xF000;

/// Fuel that is used before the host is asked whether the run is cancelled: about a
/// millisecond of a plain loop. The loop counts this fuel anyway, so asking costs nothing.
const FUEL_BETWEEN_CHECKS: u64 = 1 << 16;

/// What a script may use up before it is stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Loop passes, backward jumps, macro calls and record reads of one run of
    /// a section or global area; 100 000 000 unless set.
    pub fuel: u64,
    /// Macro calls within macro calls; 64 unless set.
    pub call_depth: usize,
    /// Elements of all arrays together (RESERV); 1 000 000 unless set.
    pub array_elements: usize,
    /// Bytes of text held at a time; 16 MiB unless set.
    pub text_bytes: usize,
    /// Bytes of the program that a run writes, 4 GiB unless set; the run looks at it, and the
    /// interpreter alone does not.
    pub output_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            fuel: 100_000_000,
            call_depth: 64,
            array_elements: 1_000_000,
            text_bytes: 16 << 20,
            output_bytes: 4 << 30,
        }
    }
}

/// What a section did with its record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// POSTF(13) was called for the record that is current at the end.
    pub processed: bool,
    /// Another record was read or restored in place of the section's own.
    pub replaced: bool,
    /// Words of the record were changed.
    pub edited: bool,
    /// Records sent to the post, those of POSTF(13) with them.
    pub commands: u32,
}

impl Outcome {
    /// True when the section had no effect on the post: its record is swallowed.
    pub fn swallowed(&self) -> bool {
        self.commands == 0
    }
}

/// Where the machine is: a chunk and an operation in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
struct Spot {
    chunk: ChunkId,
    pc: usize,
}

/// What a machine keeps from run to run, apart from the registers.
#[derive(Debug, Default)]
struct State {
    texts: Texts,
    arrays: Vec<Slot>,
    saved: Option<Record>,
    warned: HashSet<(Spot, u16)>,
    frames: Vec<Spot>,
    site: Site,
    scratch: (Vec<Word>, String),
    /// What the units 1 and 2 of FILEF are open for.
    units: [Option<FileMode>; 2],
    /// A section that is in the middle of its statements has more registers than those
    /// that are here, so no text may be dropped.
    lent: bool,
}

/// Runs a [`Module`]. The values of its names last from run to run.
#[derive(Debug)]
pub struct Interpreter {
    module: Arc<Module>,
    registers: Bank,
    state: State,
    limits: Limits,
    functions: Arc<Functions>,
}

/// One run: everything but the registers, which the loop holds on its own.
struct Vm<'a, H: Host + ?Sized> {
    module: &'a Module,
    state: &'a mut State,
    limits: &'a Limits,
    functions: &'a Functions,
    record: Option<&'a mut Record>,
    vocab: &'a mut Vocabulary,
    host: &'a mut H,
    /// Fuel until the host is asked again.
    fuel: u64,
    /// Fuel of the run beyond that.
    reserve: u64,
    spot: Spot,
    outcome: Outcome,
    /// POSTF(14) has given 1 in this run.
    at_end: bool,
}

impl Interpreter {
    /// A machine for a module compiled with the same functions.
    pub fn new(module: Arc<Module>, limits: Limits, functions: Arc<Functions>) -> Self {
        let mut registers = Bank::default();
        let mut state = State::default();
        let elements = module.arrays.last().map_or(0, |array| array.start + array.len);
        state.arrays.resize(elements, Slot::UNSET);
        for (register, constant) in &module.constants {
            registers[usize::from(*register)] = loaded(&mut state.texts, constant);
        }
        for (element, constant) in &module.data {
            state.arrays[*element] = loaded(&mut state.texts, constant);
        }
        Interpreter { module, registers, state, limits, functions }
    }

    /// The module it runs.
    pub fn module(&self) -> &Arc<Module> {
        &self.module
    }

    /// Runs the global areas of all files; once, before the first record.
    pub fn run_globals<H: Host + ?Sized>(
        &mut self,
        vocab: &mut Vocabulary,
        host: &mut H,
    ) -> Result<(), Box<Diag>> {
        let module = Arc::clone(&self.module);
        for chunk in &module.globals {
            self.run(*chunk, None, vocab, host)?;
        }
        Ok(())
    }

    /// Runs a section for a record. Afterwards `record` is what the section made of it.
    pub fn run_section<H: Host + ?Sized>(
        &mut self,
        section: SectionId,
        record: &mut Record,
        vocab: &mut Vocabulary,
        host: &mut H,
    ) -> Result<Outcome, Box<Diag>> {
        let chunk = self.module.sections[usize::from(section.0)].chunk;
        self.run(chunk, Some(record), vocab, host)
    }

    /// The number of a name, 999999 for EMPTY; `None` where it holds none or was never set.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.value(name)? {
            Value::Number(number) => Some(number),
            Value::Empty => Some(EMPTY),
            _ => None,
        }
    }

    /// The word of a record that a name holds.
    pub fn word(&self, name: &str) -> Option<WordId> {
        match self.value(name)? {
            Value::Word(id) => Some(id),
            _ => None,
        }
    }

    /// The text of a name; `None` where it holds none.
    pub fn text(&self, name: &str) -> Option<&str> {
        match self.value(name)? {
            Value::Text(id) => Some(self.state.texts.get(id)),
            _ => None,
        }
    }

    fn value(&self, name: &str) -> Option<Value> {
        let register = self.module.variables.get(name)?;
        Some(self.registers[usize::from(*register)].value())
    }

    fn run<H: Host + ?Sized>(
        &mut self,
        chunk: ChunkId,
        record: Option<&mut Record>,
        vocab: &mut Vocabulary,
        host: &mut H,
    ) -> Result<Outcome, Box<Diag>> {
        self.state.frames.clear();
        let mut vm = Vm {
            module: &self.module,
            state: &mut self.state,
            limits: &self.limits,
            functions: &self.functions,
            record,
            vocab,
            host,
            fuel: 0,
            reserve: self.limits.fuel,
            spot: Spot { chunk, pc: 0 },
            outcome: Outcome::default(),
            at_end: false,
        };
        let registers = self.registers.get();
        match vm.execute(registers, chunk) {
            Ok(()) => Ok(vm.outcome),
            Err(diag) => Err(vm.failed(registers, diag)),
        }
    }
}

/// The value of a constant.
fn loaded(texts: &mut Texts, constant: &Constant) -> Slot {
    let value = match constant {
        Constant::Number(number) => Value::of(*number),
        Constant::Word(id) => Value::Word(*id),
        // Texts of the program itself are not counted against the limit.
        Constant::Text(text) => texts.add(text, usize::MAX).map_or(Value::Unset, Value::Text),
    };
    value.into()
}
