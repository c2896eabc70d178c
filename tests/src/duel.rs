//! The machine against the oracle on one program.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use fil_cl::{Options, Reader, Record, Vocabulary};
use fil_diag::{CodeKind, Diag, Level, Levels};
use fil_syntax::SyntaxCode;
use fil_vm::errors::CompileCode;
use fil_vm::{CommonKind, EMPTY, FilFile, Host, Interpreter, Limits, LoadOptions, Site, load};

use crate::oracle::{Class, Fault, Oracle, Rec, Value, exact};
use crate::programs::Case;

/// Loop passes, jumps, calls and reads of one section: small, so that endless
/// loops cost little.
const FUEL: u64 = 2_000;

/// What a duel came to when both agreed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Agreed {
    /// Both ran to the end.
    Done,
    /// Both stopped with an error of this number.
    Stopped(u16),
    /// Both ran too long; what they did is the same as far as both went.
    TooLong,
    /// The compiler refused the program with this error.
    Refused(u16),
}

/// A host that writes down what it is asked, in the oracle's words.
#[derive(Default)]
struct World {
    records: Vec<Record>,
    next: usize,
    commons: BTreeMap<(u8, u32), f64>,
    events: Vec<String>,
    warnings: BTreeSet<(u16, u32)>,
}

fn place(kind: CommonKind, location: u32) -> (u8, u32) {
    let kind = match kind {
        CommonKind::Int => 1,
        CommonKind::Rel => 2,
        CommonKind::Dbl => 3,
    };
    (kind, location)
}

impl Host for World {
    fn common(&mut self, kind: CommonKind, location: u32) -> Result<f64, Box<Diag>> {
        let at_start = f64::from(location % 7);
        Ok(self.commons.get(&place(kind, location)).copied().unwrap_or(at_start))
    }

    fn set_common(
        &mut self,
        kind: CommonKind,
        at: u32,
        value: f64,
    ) -> Result<Option<Box<Diag>>, Box<Diag>> {
        let place = place(kind, at);
        self.commons.insert(place, value);
        self.events.push(format!("set {place:?} {}", exact(value)));
        Ok(None)
    }

    fn clear_common(&mut self, kind: CommonKind, at: u32) -> Result<Option<Box<Diag>>, Box<Diag>> {
        let place = place(kind, at);
        self.commons.insert(place, EMPTY);
        self.events.push(format!("clear {place:?}"));
        Ok(None)
    }

    fn command(
        &mut self,
        record: &Record,
        vocab: &mut Vocabulary,
        site: &Site,
    ) -> Result<(), Box<Diag>> {
        let lines: Vec<u32> = site.stack().map(|(_, line)| line).collect();
        self.events.push(format!("> {} from {lines:?}", Rec::read(record, vocab)));
        Ok(())
    }

    fn next_record(&mut self, to: &mut Record, _: &mut Vocabulary) -> Result<bool, Box<Diag>> {
        let Some(record) = self.records.get(self.next) else { return Ok(false) };
        to.clone_from(record);
        self.next += 1;
        Ok(true)
    }

    fn seek_record(
        &mut self,
        _: u32,
        _: &mut Record,
        _: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        Ok(false)
    }

    fn warn(&mut self, diag: Diag) {
        self.warnings.insert((diag.code.number, line(&diag)));
    }

    fn trace(&mut self, on: bool) {
        self.events.push(format!("trace {on}"));
    }
}

fn line(diag: &Diag) -> u32 {
    diag.spans.first().map_or(0, |place| place.line)
}

/// Runs a case on both.
///
/// # Errors
/// What they disagree about.
pub fn fight(case: &Case) -> Result<Agreed, String> {
    fight_over(case, &case.fil)
}

/// Runs a case on the machine and another FIL text on the oracle: to see that
/// a difference is found.
///
/// # Errors
/// What they disagree about.
pub fn fight_over(case: &Case, oracle_fil: &str) -> Result<Agreed, String> {
    let mut vocab = Vocabulary::new();
    let limits = Limits { fuel: FUEL, ..Limits::default() };
    // Both read alike what a user would have to allow.
    let codes = SyntaxCode::ALL.iter().chain(CompileCode::ALL);
    let mut levels = Levels::default();
    codes
        .filter(|code| code.kind == CodeKind::Doubt)
        .for_each(|code| levels.set(code.number, Level::Allow));
    let options = LoadOptions { limits, levels, ..LoadOptions::default() };
    let module = match load(&[FilFile { name: "case.fil", text: &case.fil }], &mut vocab, options) {
        Ok(loaded) => loaded.module,
        Err(diags) => {
            let first = diags.iter().find(|diag| diag.is_error());
            return Ok(Agreed::Refused(first.map_or(0, |diag| diag.code.number)));
        }
    };
    let records = read(&case.cl, &mut vocab)?;
    let own = records.iter().map(|record| Rec::read(record, &vocab)).collect();
    let mut world = World { records, ..World::default() };
    let mut machine = Interpreter::new(Arc::new(module), limits, Arc::default());
    let ran = drive(&mut machine, &mut vocab, &mut world);

    let program = fil_syntax::parse("case.fil", oracle_fil).program;
    let mut oracle = Oracle::new(&program, oracle_fil, own, FUEL);
    let wanted = oracle.run();
    compare(ran, wanted, &world, &oracle, &machine, &vocab)
}

fn read(cl: &str, vocab: &mut Vocabulary) -> Result<Vec<Record>, String> {
    let mut reader = Reader::new(cl.as_bytes(), "case.ncl", Options::default());
    let mut records = Vec::new();
    let mut record = Record::default();
    while reader.read(vocab, &mut record).map_err(|diag| diag.to_string())? {
        records.push(record.clone());
    }
    Ok(records)
}

fn drive(
    machine: &mut Interpreter,
    vocab: &mut Vocabulary,
    world: &mut World,
) -> Result<(), Box<Diag>> {
    machine.run_globals(vocab, world)?;
    let mut record = Record::default();
    while world.next_record(&mut record, vocab)? {
        let Some(section) = machine.module().find(&record, vocab) else {
            world.events.push(format!("= {}", Rec::read(&record, vocab)));
            continue;
        };
        let done = machine.run_section(section, &mut record, vocab, world)?;
        world.events.push(format!(
            "end processed={} replaced={} edited={} commands={}",
            done.processed, done.replaced, done.edited, done.commands
        ));
    }
    Ok(())
}

fn compare(
    ran: Result<(), Box<Diag>>,
    wanted: Result<(), Fault>,
    world: &World,
    oracle: &Oracle<'_>,
    machine: &Interpreter,
    vocab: &Vocabulary,
) -> Result<Agreed, String> {
    let events = &world.events;
    let ran = ran.map_err(|diag| (diag.code.number, line(&diag), diag.to_string()));
    let long = Class::OutOfFuel as u16;
    let too_long = ran.as_ref().is_err_and(|(number, ..)| *number == long)
        || wanted.is_err_and(|fault| fault.class == Class::OutOfFuel);
    let both = events.iter().zip(oracle.events());
    for (index, (real, wanted)) in both.enumerate() {
        if real != wanted {
            return Err(format!("event {index}\n machine {real}\n oracle  {wanted}"));
        }
    }
    if too_long {
        // The two count fuel in their own ways, so they may stop at other places.
        return Ok(Agreed::TooLong);
    }
    let stopped = match (ran, wanted) {
        (Ok(()), Ok(())) => None,
        (Err((number, line, _)), Err(fault))
            if (number, line) == (fault.class as u16, fault.line) =>
        {
            Some((number, line))
        }
        (ran, wanted) => {
            let ran = ran.map_err(|(.., message)| message);
            return Err(format!("end\n machine {ran:?}\n oracle  {wanted:?}"));
        }
    };
    if events.len() != oracle.events().len() {
        return Err(format!("{} events, oracle {}", events.len(), oracle.events().len()));
    }
    let Some((number, line)) = stopped else {
        warnings(&world.warnings, oracle.warnings(), 0)?;
        values(oracle, machine, vocab)?;
        return Ok(Agreed::Done);
    };
    // Which names the failing line had read before it failed, and what it left in
    // them, says nothing: the run is refused.
    warnings(&world.warnings, oracle.warnings(), line)?;
    Ok(Agreed::Stopped(number))
}

type Warnings = BTreeSet<(u16, u32)>;

fn warnings(real: &Warnings, wanted: &Warnings, except: u32) -> Result<(), String> {
    let others = |all: &Warnings| -> Warnings {
        all.iter().copied().filter(|(_, line)| *line != except).collect()
    };
    let (real, wanted) = (others(real), others(wanted));
    if real == wanted {
        return Ok(());
    }
    Err(format!("warnings\n machine {real:?}\n oracle  {wanted:?}"))
}

fn values(oracle: &Oracle<'_>, machine: &Interpreter, vocab: &Vocabulary) -> Result<(), String> {
    for (name, wanted) in oracle.values() {
        let text = machine.text(name).map(|text| Value::Text(text.to_string()));
        let word = machine.word(name).map(|id| Value::Minor(vocab.name(id).to_string()));
        let real = machine.number(name).map(Value::Number).or(text).or(word);
        let shown = |value: Option<&Value>| value.map_or("unset".to_string(), Value::to_string);
        // A letter that no statement uses has no place in the machine.
        let unused = name.len() == 1 && real.is_none();
        if !unused && shown(real.as_ref()) != shown(wanted) {
            let (real, wanted) = (shown(real.as_ref()), shown(wanted));
            return Err(format!("{name}\n machine {real}\n oracle  {wanted}"));
        }
    }
    Ok(())
}

/// The case without the lines that the disagreement does not need.
pub fn reduce(case: &Case) -> (Case, String) {
    let mut best = case.clone();
    let mut told = fight(&best).err().unwrap_or_default();
    let mut size = best.fil.lines().count().max(1);
    while size > 0 {
        let mut start = 0;
        let mut shorter = false;
        while start < best.fil.lines().count() + best.cl.lines().count() {
            let smaller = without(&best, start, size);
            match fight(&smaller) {
                Err(message) => {
                    (best, told, shorter) = (smaller, message, true);
                }
                Ok(_) => start += size,
            }
        }
        if !shorter || size > 1 {
            size /= 2;
        }
    }
    (best, told)
}

/// The case without `size` lines from `start` on; lines of the CL file come after those of FIL.
fn without(case: &Case, start: usize, size: usize) -> Case {
    let gone = start..start + size;
    let keep = |text: &str, first: usize| -> String {
        let lines = text.lines().enumerate().filter(|(index, _)| !gone.contains(&(index + first)));
        lines.map(|(_, line)| format!("{line}\n")).collect()
    };
    Case { fil: keep(&case.fil, 0), cl: keep(&case.cl, case.fil.lines().count()) }
}
