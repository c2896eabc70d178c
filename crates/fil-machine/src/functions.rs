//! The table of G and M functions: what each means, which settings name its number, and the
//! standard numbers of the control families.
//!
//! `data/functions.tsv` is the one source, and describes its columns. The contradictions of
//! settings and what the post reads from foreign blocks come from it.

use crate::commons::{Commons, Int};
use crate::function_code::FunctionCode;
use crate::locations::{self as loc, ControlFamily, CycleReturnCodes, MillTurnMode, ThreadCycle};
use crate::mill_turn;
use crate::modes::{Compensation, Distance, FeedMode, Plane, Unit};
use crate::osp_lengths;

include!(concat!(env!("OUT_DIR"), "/functions.rs"));

/// Makes `Group`, and `Meaning` with the value of each group.
macro_rules! groups {
    ($($(#[$doc:meta])* $name:ident $(($value:ty))?,)*) => {
        /// A modal group, or a kind of functions that act in their block alone.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Group {
            $($(#[$doc])* $name,)*
        }

        /// What a function does: its [`Group`], with the value that it gives the group.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Meaning {
            $($(#[$doc])* $name $(($value))?,)*
        }

        impl Meaning {
            /// Its group.
            pub const fn group(self) -> Group {
                match self {
                    $(Meaning::$name { .. } => Group::$name,)*
                }
            }
        }
    };
}

groups! {
    /// Rapid, line, arc, threading move (G0 to G3, G33).
    Motion(Motion),
    /// A turning cycle of a lathe (G71, G90, G92).
    TurningCycle,
    /// A dwell (G4).
    Dwell,
    /// The plane of arcs and cycles (G17 to G19).
    Plane(Plane),
    /// Inch or millimetres (G20, G21).
    Unit(Unit),
    /// What moves the origin, or goes to positions of the machine (G54, G53, G28, G92).
    Origin(Origin),
    /// Cutter compensation (G40 to G42).
    Compensation(Compensation),
    /// The tool length offset (G43, G49).
    LengthOffset(LengthOffset),
    /// A canned cycle (G81).
    Cycle,
    /// The end of a canned cycle (G80).
    CycleEnd,
    /// The plane that a cycle returns to (G98, G99).
    ReturnPlane,
    /// The level that a cycle returns to, by a word of its block (G71 Z of an OSP).
    ReturnLevel,
    /// Absolute or incremental positions (G90, G91).
    Distance(Distance),
    /// What F counts (G93 to G95).
    FeedMode(FeedMode),
    /// What S counts (G96, G97).
    SpeedMode(SpeedMode),
    /// The limit of the spindle speed (G50 S, G92 S).
    SpeedLimit,
    /// X is a diameter.
    DiameterMode,
    /// Tool center point control (G43.4).
    Tcpc,
    /// Coordinates that are turned against the axes (G68, G68.2, G69).
    WorkPlane(WorkPlane),
    /// Acts in its block alone, or on what the post does not depend on.
    OneBlock,
    /// A program stop (M0, M1).
    Stop,
    /// The end of a program or subprogram (M2, M30).
    ProgramEnd(ProgramEnd),
    /// A call of a subprogram, and the return from one (M98, M99).
    Call(Call),
    /// The spindle in use (M3 to M5, M19).
    Spindle(Spindle),
    /// The sub-spindle.
    SideSpindle(Spindle),
    /// The choice of the master spindle, whose revolutions feeds and threads count.
    MasterSpindle,
    /// Milling or turning on a mill-turn machine.
    MillTurnMode,
    /// The gear range of the spindle.
    Gear,
    /// A tool change (M6).
    ToolChange,
    /// Coolant (M7 to M9).
    Coolant(Coolant),
    /// The operator's feed override (M48, M49).
    FeedOverride,
    /// The clamp of the rotary axes.
    AxisClamp(AxisClamp),
    /// A rigid tap (M29).
    RigidTap,
    /// How the cycles of threads leave the thread (M23, M24).
    ThreadRunOut,
    /// Not known.
    Unknown,
}

/// Kinds of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// At rapid (G0).
    Rapid,
    /// A line at feed (G1).
    Linear,
    /// An arc (G2, G3).
    Arc,
    /// A threading move, whose F is its lead (G32, G33).
    Thread,
}

/// What moves the origin, or goes to positions that do not count from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A work offset by its own code (G54).
    WorkOffset,
    /// A work offset by a word beside the code (G54.1 P1), or that of the settings (G500).
    NumberedOffset,
    /// Positions of the machine in this block (G53).
    Machine,
    /// A reference point of the machine (G28, G30).
    Home,
    /// A check of the reference point (G27).
    ReferenceCheck,
    /// A local coordinate system on the work offset (G52).
    Local,
    /// A preset of the axes (G92).
    Preset,
    /// Mirrored axes, and the end of it (G51.1, G50.1).
    Mirror,
    /// Polar or cylindrical interpolation (G12.1, G7.1).
    Interpolation,
    /// Anything else that moves it (G10, G29, G50).
    Other,
}

impl Origin {
    /// True for a code that chooses a work offset, by itself or by a word beside it.
    pub const fn is_offset(self) -> bool {
        matches!(self, Origin::WorkOffset | Origin::NumberedOffset)
    }

    /// True for a code whose block goes to positions of the machine.
    pub const fn is_of_machine(self) -> bool {
        matches!(self, Origin::Machine | Origin::Home)
    }

    /// True for a code that leaves the work offset in force.
    pub const fn keeps_offset(self) -> bool {
        self.is_of_machine() || matches!(self, Origin::ReferenceCheck) || self.is_of_its_words()
    }

    /// True for a code that gives another zero to the axes of its block alone, to all where it
    /// names none.
    pub const fn is_of_its_words(self) -> bool {
        matches!(self, Origin::Local | Origin::Preset | Origin::Mirror)
    }
}

/// How coordinates are turned against the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WorkPlane {
    /// They are not (G69).
    #[default]
    Off,
    /// In the plane in force, about its normal (G68).
    Rotated,
    /// In space, as a tilted work plane (G68.2).
    Tilted,
}

/// The tool length offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthOffset {
    /// It is activated (G43).
    Activate,
    /// It is cancelled (G49).
    Cancel,
}

/// What S counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedMode {
    /// Constant surface speed (G96).
    SurfaceSpeed,
    /// Revolutions a minute (G97).
    RevolutionsPerMinute,
}

/// What ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgramEnd {
    /// The program (M2, M30).
    Program,
    /// A subprogram (M17).
    Subprogram,
}

/// A call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Call {
    /// Of a subprogram (M98).
    Subprogram,
    /// The return from one (M99).
    Return,
}

/// What a spindle does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spindle {
    /// It turns clockwise (M3).
    Clockwise,
    /// It turns counterclockwise (M4).
    Counterclockwise,
    /// It turns the way of a SPINDL record that names none.
    Default,
    /// It stops (M5).
    Stop,
    /// It stops at an angle (M19).
    Orient,
    /// It stops and is an axis (M70 of a SINUMERIK).
    Axis,
}

type SideSpindle = Spindle;

/// Coolant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coolant {
    /// Of any kind (M7, M8).
    On,
    /// None (M9).
    Off,
}

/// The clamp of the rotary axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisClamp {
    /// Closed.
    Clamp,
    /// Open.
    Release,
}

/// Whose numbers a function's are: two functions of one space share them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Space {
    /// Preparatory functions.
    G,
    /// Auxiliary functions.
    M,
    /// Cycles: preparatory functions in word address, numbers of calls elsewhere.
    Cycle,
}

/// Where a function acts in its block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acts {
    /// With the words of the block.
    With,
    /// It may stand in a block before them.
    Before,
    /// At the end of the block.
    After,
}

/// On which machines a row counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// All.
    Always,
    /// Tool lengths are called by G54 to G59 ([`osp_lengths`]).
    OspLengths,
    /// They choose a work offset.
    NoOspLengths,
    /// Whole threads are written by G71 of an OSP.
    OspThread,
    /// Cycles return to a level of G71 by M53, or to the R plane by M54.
    OspCycles,
    /// The settings name a tapping cycle: without one there is none for left-hand threads either.
    TapCycle,
    /// Cycles return to a plane by a code, which means nothing else then. Not read in G code system
    /// A of lathes.
    ReturnCodes,
    /// Not read in G code system A of lathes.
    NotLatheA,
    /// Mill-turn machines.
    MillTurn,
    /// The spindle in use is the main one.
    MainSpindle,
    /// The spindle in use is that of the live tools.
    LiveSpindle,
}

impl When {
    /// No setting may take the numbers of the row for something else.
    pub fn is_reserved(self, commons: &Commons) -> bool {
        match self {
            When::OspLengths => osp_lengths::are_meant(commons),
            When::NoOspLengths => !osp_lengths::are_meant(commons),
            When::TapCycle => commons.read(loc::CYCLE_TAP_CODE).is_some(),
            When::ReturnCodes => returns_by(commons, CycleReturnCodes::Yes),
            When::OspCycles => returns_by(commons, CycleReturnCodes::G71OfAnOsp),
            _ => true,
        }
    }

    /// The row is read in blocks.
    pub fn is_read(self, commons: &Commons) -> bool {
        let mills = |commons| mill_turn::mode(commons).is_some_and(|m| m != MillTurnMode::Turning);
        match self {
            When::OspLengths => osp_lengths::are_meant(commons),
            When::OspThread => commons.read(loc::THREAD_CYCLE) == ThreadCycle::G71OfAnOsp,
            When::OspCycles => returns_by(commons, CycleReturnCodes::G71OfAnOsp),
            When::ReturnCodes | When::NotLatheA => Dialect::of(commons) != Dialect::LatheA,
            When::MillTurn => mill_turn::mode(commons).is_some(),
            When::MainSpindle => !mills(commons),
            When::LiveSpindle => mills(commons),
            _ => true,
        }
    }
}

fn returns_by(commons: &Commons, codes: CycleReturnCodes) -> bool {
    let mut cycles = loc::CYCLE_CODES.iter().filter(|at| **at != loc::CYCLE_TAP_LEFT_CODE);
    cycles.any(|at| commons.read(*at).is_some())
        && commons.read(loc::CYCLE_RETURN_CODES) == codes
        && commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress
}

/// Which standard numbers a control has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// Word address, and the M functions of Klartext.
    Mill,
    /// Word address, feeds by G98 and G99: G code system A of lathes.
    LatheA,
    /// SINUMERIK.
    Sinumerik,
}

impl Dialect {
    /// That of a machine.
    pub fn of(commons: &Commons) -> Self {
        match commons.read(loc::CONTROL_FAMILY) {
            ControlFamily::Sinumerik => Dialect::Sinumerik,
            _ if commons.read(loc::FEED_UPM_CODE) == Some(98) => Dialect::LatheA,
            _ => Dialect::Mill,
        }
    }
}

/// Standard numbers of a function, in tenths. Between whole numbers only whole ones are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Standard {
    /// The first.
    pub first: u32,
    /// The last.
    pub last: u32,
    /// No setting of another kind may take it; else it is only read in foreign blocks.
    pub reserved: bool,
}

impl Standard {
    /// Its numbers.
    pub fn codes(self) -> impl Iterator<Item = FunctionCode> {
        let step = if self.first.is_multiple_of(10) { 10 } else { 1 };
        (self.first..=self.last).step_by(step).map(FunctionCode::tenths)
    }
}

/// A setting that holds a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeSetting {
    /// INTCOM location.
    pub at: Int,
    /// Tenths of one: 10, or 1 where the setting holds tenths.
    pub scale: u32,
}

impl CodeSetting {
    /// The code; `None` where the setting is absent or negative.
    pub fn code(self, commons: &Commons) -> Option<FunctionCode> {
        let number = u32::try_from(commons.int_opt(self.at)?).ok()?;
        number.checked_mul(self.scale).map(FunctionCode::tenths)
    }
}

/// A row of the table.
#[derive(Debug, PartialEq)]
pub struct Function {
    /// Whose number it has.
    pub space: Space,
    /// What it does.
    pub meaning: Meaning,
    /// The settings that name its number.
    pub settings: &'static [CodeSetting],
    /// Its standard numbers by [`Dialect`]; `None` where that has no such function.
    standard: [Option<&'static [Standard]>; 3],
    /// On which machines it counts.
    pub when: When,
    /// Where it acts in its block.
    pub acts: Acts,
    /// An output macro may take it out: the post outputs it again, or nothing depends on it.
    pub restorable: bool,
    /// What the standard numbers of rows of this kind are together.
    pub kind: &'static str,
    /// What a setting of the row is.
    pub title: &'static str,
}

impl Function {
    /// Its standard numbers; `None` where the dialect has no such function.
    pub fn standard(&self, dialect: Dialect) -> Option<&'static [Standard]> {
        self.standard[dialect as usize]
    }
}

/// The functions of a machine whose numbers go before the standard ones: those that settings name,
/// and those of an OSP. In the order of the table, the first of one number counts.
pub fn named(commons: &Commons, dialect: Dialect) -> Vec<(FunctionCode, &'static Function)> {
    let mut named = Vec::with_capacity(96);
    let is_there = |row: &&Function| {
        (row.space != Space::Cycle || dialect != Dialect::Sinumerik) && row.when.is_read(commons)
    };
    for row in FUNCTIONS.iter().filter(is_there) {
        let Some(standard) = row.standard(dialect) else { continue };
        let codes = row.settings.iter().filter_map(|setting| setting.code(commons));
        named.extend(codes.map(|code| (code, row)));
        if matches!(row.when, When::OspLengths | When::OspThread | When::OspCycles) {
            named.extend(standard.iter().flat_map(|n| n.codes()).map(|code| (code, row)));
        }
    }
    named
}

/// The function of a standard number, among those of `space` that are read in foreign blocks.
pub fn standard(dialect: Dialect, space: Space, code: FunctionCode) -> Option<&'static Function> {
    let numbers = STANDARD[usize::from(space == Space::M)][dialect as usize];
    let tenths = code.in_tenths();
    let at = numbers.binary_search_by_key(&tenths, |(number, _)| *number).ok()?;
    Some(&FUNCTIONS[usize::from(numbers[at].1)])
}

/// The functions of all standard numbers of `space` that are read in foreign blocks, by number.
pub fn standards(
    dialect: Dialect,
    space: Space,
) -> impl Iterator<Item = (FunctionCode, &'static Function)> {
    let numbers = STANDARD[usize::from(space == Space::M)][dialect as usize];
    let row = |at: u8| &FUNCTIONS[usize::from(at)];
    numbers.iter().map(move |(tenths, at)| (FunctionCode::tenths(*tenths), row(*at)))
}

#[cfg(test)]
mod tests;
