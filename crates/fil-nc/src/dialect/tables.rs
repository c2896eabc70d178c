//! What single settings say about a control, as rows of tables: the letters of words, the control's
//! habits, its amounts, and the numbers in the names of its axes and spindles.

use super::{Settings, lengths, start};

/// What a letter of the machine stands for, besides an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// Radius of an arc.
    Radius,
    /// Peck of a drilling cycle.
    Step,
    /// Dwell of a drilling cycle.
    CycleDwell,
    /// Dwell of a block of its own.
    Dwell,
    /// Number of the offset of cutter compensation.
    ToolOffset,
    /// Number of a numbered work offset.
    FixtureNumber,
    /// The word that chooses the work offset.
    FixtureWord,
    /// Lead of a threading move.
    Lead,
    /// What a varying lead gains in each turn.
    LeadChange,
    /// Taper in the threading cycle of one pass.
    ThreadTaper,
    /// Number of threads in F of that cycle.
    ThreadCount,
    /// Highest speed beside a constant surface speed.
    SpeedLimit,
    /// Angle of an oriented spindle.
    Orientation,
    /// Speed of the live tool.
    LiveSpeed,
}

/// The setting of each letter.
const LETTERS: [(Role, &str); 14] = [
    (Role::Radius, "circle.radius_address"),
    (Role::Step, "cycle.step_address"),
    (Role::CycleDwell, "cycle.dwell_address"),
    (Role::Dwell, "dwell.address"),
    (Role::ToolOffset, "cutcom.address"),
    (Role::FixtureNumber, "fixture.extended_address"),
    (Role::FixtureWord, "fixture.address"),
    (Role::Lead, "thread.lead_address"),
    (Role::LeadChange, "thread.change_address"),
    (Role::ThreadTaper, "thread.taper_address"),
    (Role::ThreadCount, "thread.count_address"),
    (Role::SpeedLimit, "spindle.max_address"),
    (Role::Orientation, "spindle.orient_address"),
    (Role::LiveSpeed, "mill_turn.live_speed_address"),
];

/// Letters (1 to 26) by their roles; 0 for a word that the machine lacks.
#[derive(Clone, Debug)]
pub(super) struct Letters([u8; LETTERS.len()]);

impl Letters {
    pub(super) fn new(settings: &Settings<'_>) -> Self {
        let mut letters = [0; LETTERS.len()];
        for (role, key) in LETTERS {
            letters[role as usize] = settings.letter(key);
        }
        if settings.code("fixture.form") != Some(2) {
            letters[Role::FixtureWord as usize] = 0;
        }
        Letters(letters)
    }

    pub(super) fn get(&self, role: Role) -> u8 {
        self.0[role as usize]
    }
}

/// What a control does, or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Habit {
    /// The machine turns parts: X may be a diameter, threads have cycles.
    Lathe,
    /// Programs begin in mm and not in inch, where they don't name the unit.
    Metric,
    /// Axis words are positions when the program begins, else increments.
    Absolute,
    /// The switch of the control is on by which blocks with a skip mark are left out.
    SkipsBlocks,
    /// A SINUMERIK has TRANSMIT and TRACYL in place of an axis Y.
    Transforms,
    /// Tool center point control may begin wherever the tables are.
    TipControlAnywhere,
    /// An arc right after another keeps its radius.
    RadiusModal,
    /// The lead is measured along the path, else along the longer axis.
    LeadAlongPath,
    /// A tool change leaves it to a function to call the length of the tool.
    CallsLengths,
    /// A position of the machine along Z ends that length.
    PositionsEndLengths,
    /// T names the nose by two digits before those of the tool.
    NamesNoses,
    /// Threads need feeds per revolution: lathes with a cycle of all passes in one block.
    ThreadsNeedTurns,
    /// A SINUMERIK counts the lengths of a tool along the same axes in every plane.
    LengthsAreFast,
    /// Holes return to the level before the cycle, where the program does not name one.
    ReturnsInitial,
    /// An OSP: holes return to the level of G71 by M53, or to R by M54.
    ReturnsByLevel,
    /// TRANS of a SINUMERIK is the translation of the CL file, so that positions count from
    /// where the zero was before.
    Translates,
    /// A SINUMERIK calls tools by the names that the CL file has for them.
    NamesTools,
    /// Programs end with a code; without one the last block is the end.
    HasEnd,
}

/// Habits that one setting says: by which of its values.
const HABITS: [(Habit, &str, &[i32]); 11] = [
    (Habit::Transforms, "mill_turn.transformations", ON),
    (Habit::TipControlAnywhere, "rotary.tip_control", &[1]),
    (Habit::RadiusModal, "circle.radius_modal", ON),
    (Habit::LeadAlongPath, "thread.lead_along", &[1]),
    (Habit::NamesNoses, "tool.format", &[3]),
    (Habit::ThreadsNeedTurns, "thread.cycle", &[3]),
    (Habit::LengthsAreFast, "tool.length_const", ON),
    (Habit::ReturnsInitial, "cycle.return_codes", &[2]),
    (Habit::ReturnsByLevel, "cycle.return_codes", &[RETURNS_BY_LEVEL]),
    (Habit::Translates, "control.translation", &[1]),
    (Habit::NamesTools, "control.tool_call", &[2]),
];

/// `cycle.return_codes` of a control whose cycles return by G71, M53 and M54.
pub(super) const RETURNS_BY_LEVEL: i32 = 3;

/// The values of a flag that is on.
pub(super) const ON: &[i32] = &[1, 71];

/// The habits of a control, a bit for each.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Habits(u32);

impl Habits {
    pub(super) fn new(settings: &Settings<'_>, lathe: bool) -> Self {
        let mut habits = Habits::default();
        for (habit, key, values) in HABITS {
            let is = settings.code(key).is_some_and(|code| values.contains(&code));
            habits.set(habit, is);
        }
        let calls_lengths = lengths::are_called(settings);
        let ends = ["program.end_code", "program.rewind_code"];
        habits.set(Habit::Lathe, lathe);
        habits.set(Habit::Metric, start::metric(settings));
        habits.set(Habit::Absolute, start::absolute(settings));
        habits.set(Habit::CallsLengths, calls_lengths);
        habits.set(
            Habit::PositionsEndLengths,
            calls_lengths && settings.is_not_off("home.ends_length"),
        );
        habits.set(Habit::HasEnd, ends.iter().any(|key| settings.code(key).is_some()));
        habits
    }

    pub(super) fn set(&mut self, habit: Habit, is: bool) {
        let bit = 1 << habit as u32;
        self.0 = if is { self.0 | bit } else { self.0 & !bit };
    }

    pub(super) fn has(self, habit: Habit) -> bool {
        self.0 & (1 << habit as u32) != 0
    }
}

/// An amount that the machine names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Amount {
    /// Control's dwell unit in a second.
    Dwell,
    /// Control's dwell unit in a turn of the spindle, where it waits turns.
    DwellTurns,
    /// Control's feed unit in a unit of length a minute.
    Feed,
    /// Control's inverse time in motions a minute.
    Inverse,
    /// The feed that stands for rapid motions in polar interpolation, mm a minute.
    PolarRapid,
    /// The steps of X, Y and Z that a setting names, in the unit of the program; absent where the
    /// last digits are theirs.
    Steps,
}

/// The setting of each amount, and whether an amount of 0 or less is none.
const AMOUNTS: [(Amount, &str, bool); 6] = [
    (Amount::Dwell, "dwell.upm_factor", true),
    (Amount::DwellTurns, "dwell.upr_factor", true),
    (Amount::Feed, "feed.upm_factor", true),
    (Amount::Inverse, "feed.inverse_factor", true),
    (Amount::PolarRapid, "mill_turn.polar_rapid", false),
    (Amount::Steps, "motion.resolution", false),
];

/// The amounts of a machine; `None` for one that it does not name.
#[derive(Clone, Debug)]
pub(super) struct Amounts([Option<f64>; AMOUNTS.len()]);

impl Amounts {
    pub(super) fn new(settings: &Settings<'_>) -> Self {
        let mut amounts = [None; AMOUNTS.len()];
        for (amount, key, is_positive) in AMOUNTS {
            let value = settings.number(key);
            amounts[amount as usize] = value.filter(|value| !is_positive || *value > 0.0);
        }
        if !settings.flag("motion.resolution_manual") {
            amounts[Amount::Steps as usize] = None;
        }
        Amounts(amounts)
    }

    pub(super) fn get(&self, amount: Amount) -> Option<f64> {
        self.0[amount as usize]
    }
}

/// What a SINUMERIK names with a number at the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Numbered {
    /// A linear axis.
    Linear,
    /// A rotary axis.
    Rotary,
    /// The spindle.
    Spindle,
    /// The spindle of the live tool, which SETMS makes the master spindle.
    LiveSpindle,
}

/// The settings of these numbers.
const NUMBERS: [(Numbered, &str); 4] = [
    (Numbered::Linear, "control.axis_index"),
    (Numbered::Rotary, "control.rotary_index"),
    (Numbered::Spindle, "control.spindle_index"),
    (Numbered::LiveSpindle, "mill_turn.live_spindle"),
];

/// The numbers; `None` for a name without one.
#[derive(Clone, Debug)]
pub(super) struct Numbers([Option<i32>; NUMBERS.len()]);

impl Numbers {
    pub(super) fn new(settings: &Settings<'_>) -> Self {
        let mut numbers = [None; NUMBERS.len()];
        for (numbered, key) in NUMBERS {
            numbers[numbered as usize] = settings.code(key);
        }
        Numbers(numbers)
    }

    pub(super) fn get(&self, numbered: Numbered) -> Option<i32> {
        self.0[numbered as usize]
    }
}
