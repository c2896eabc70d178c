//! Coolant.

use fil_diag::Result;
use fil_machine::locations::{self as loc, Placement};
use fil_machine::setting::CodeAt;

use crate::control::{Control, Function};
use crate::errors::PostCode;
use crate::operation::{Coolant, CoolantKind, Pressure};

/// Writes the coolant code, in a block of its own or with a motion; OFF at once.
///
/// # Errors
/// As [`Control::write_block`].
pub fn write(control: &mut Control, coolant: Coolant) -> Result<()> {
    let at = match coolant {
        Coolant::Off => return off(control),
        Coolant::On(kind, pressure) => of_the_machine(control, kind, pressure),
    };
    if control.code_if_any(at).is_none() {
        // What flows goes on: the tool must not run dry.
        control.warn_no_code("this coolant");
        return Ok(());
    }
    let before = control.coolant.filter(|before| *before != at);
    let ends = before.is_some_and(|before| {
        let [before, now] = [before, at].map(|at| off_code(control, Some(at)));
        before != now || control.commons.read(loc::COOLANT_PRINT_OFF)
    });
    if !ends {
        return switch_on(control, at);
    }
    // The tool must not run dry: the other coolant does not wait for a motion.
    write_off(control)?;
    place(control, at, Placement::BlockOfItsOwn)
}

/// Codes of coolants, and the code that ends each where it is not that of all.
const OWN_OFF_CODES: [(CodeAt, CodeAt); 6] = [
    (loc::COOLANT_MIST_CODE, loc::COOLANT_MIST_OFF_CODE),
    (loc::COOLANT_THRU_LOW_CODE, loc::COOLANT_THRU_OFF_CODE),
    (loc::COOLANT_THRU_MEDIUM_CODE, loc::COOLANT_THRU_OFF_CODE),
    (loc::COOLANT_THRU_HIGH_CODE, loc::COOLANT_THRU_OFF_CODE),
    (loc::COOLANT_AIR_CODE, loc::COOLANT_AIR_OFF_CODE),
    (loc::COOLANT_TAP_CODE, loc::COOLANT_TAP_OFF_CODE),
];

/// The code that ends a coolant: its own, where the machine has one.
fn off_code(control: &Control, of: Option<CodeAt>) -> CodeAt {
    let own = OWN_OFF_CODES.iter().find(|(on, _)| Some(*on) == of).map(|(_, off)| *off);
    own.filter(|at| control.code_if_any(*at).is_some()).unwrap_or(loc::COOLANT_OFF_CODE)
}

/// Switches a coolant on by its code.
///
/// # Errors
/// As [`Control::write_block`].
pub(crate) fn switch_on(control: &mut Control, at: CodeAt) -> Result<()> {
    place(control, at, control.commons.read(loc::COOLANT_PLACEMENT))
}

fn place(control: &mut Control, at: CodeAt, placement: Placement) -> Result<()> {
    control.coolant = Some(at);
    control.tools.coolant = None;
    add(control, at);
    control.place_block(Function::Coolant, placement)
}

fn off(control: &mut Control) -> Result<()> {
    control.tools.coolant = None;
    write_off(control)
}

/// Ends the coolant at once, after all that still waits for a motion.
fn write_off(control: &mut Control) -> Result<()> {
    control.flush_waiting()?;
    let flows = control.coolant.take();
    add(control, off_code(control, flows));
    control.write_block()
}

fn add(control: &mut Control, at: CodeAt) {
    match control.code_if_any(at) {
        Some(code) => control.m(code),
        None => control.warn_no_code("this coolant"),
    }
}

/// The location of the code of a coolant; of its usual pressure where the machine has none for
/// the one asked for, which is said: the tool must not run dry.
fn of_the_machine(control: &mut Control, kind: CoolantKind, pressure: Pressure) -> CodeAt {
    let at = location(control, kind, pressure);
    let usual = location(control, kind, Pressure::Usual);
    let has_none = pressure != Pressure::Usual && ONE_PRESSURE.contains(&at)
        || usual != at && control.code_if_any(at).is_none();
    if !has_none || control.code_if_any(usual).is_none() {
        return at;
    }
    let message = "the machine has no code for this pressure of the coolant; \
                   the code of its usual pressure is written";
    control.warnings.add(PostCode::IgnoredPart, message.into());
    usual
}

/// Codes of coolants of one pressure.
const ONE_PRESSURE: [CodeAt; 4] = [
    loc::COOLANT_DEFAULT_CODE,
    loc::COOLANT_MIST_CODE,
    loc::COOLANT_TAP_CODE,
    loc::COOLANT_AIR_CODE,
];

/// The location of the code of a coolant.
fn location(control: &Control, kind: CoolantKind, pressure: Pressure) -> CodeAt {
    use Pressure as P;
    match (kind, pressure) {
        (CoolantKind::Default, P::Usual) => loc::COOLANT_DEFAULT_CODE,
        (CoolantKind::Default, _) => match usual_kind(control) {
            Some(kind) => location(control, kind, pressure),
            None => loc::COOLANT_DEFAULT_CODE,
        },
        (CoolantKind::Mist, _) => loc::COOLANT_MIST_CODE,
        (CoolantKind::Tap, _) => loc::COOLANT_TAP_CODE,
        (CoolantKind::Air, _) => loc::COOLANT_AIR_CODE,
        (CoolantKind::Flood, P::Usual) => loc::COOLANT_FLOOD_CODE,
        (CoolantKind::Flood, P::Low) => loc::COOLANT_FLOOD_LOW_CODE,
        (CoolantKind::Flood, P::Medium) => loc::COOLANT_FLOOD_MEDIUM_CODE,
        (CoolantKind::Flood, P::High) => loc::COOLANT_FLOOD_HIGH_CODE,
        (CoolantKind::Through, P::Low) => loc::COOLANT_THRU_LOW_CODE,
        (CoolantKind::Through, P::Medium) => loc::COOLANT_THRU_MEDIUM_CODE,
        (CoolantKind::Through, P::Usual | P::High) => loc::COOLANT_THRU_HIGH_CODE,
    }
}

/// The kind with pressures whose usual code is that of COOLNT/ON.
fn usual_kind(control: &Control) -> Option<CoolantKind> {
    let usual = control.code_if_any(loc::COOLANT_DEFAULT_CODE);
    let kinds = [
        (CoolantKind::Flood, loc::COOLANT_FLOOD_CODE),
        (CoolantKind::Through, loc::COOLANT_THRU_HIGH_CODE),
    ];
    let found = kinds.iter().find(|(_, at)| usual.is_some() && control.code_if_any(*at) == usual);
    found.map(|(kind, _)| *kind)
}
