//! What letters, numbers and codes of an NC program mean on a machine.
//!
//! All of it is read from the machine's commons, as whoever wrote them
//! understands them; the post's own output code has no part in it.

mod codes;
mod family;
mod g_codes;
mod lengths;
mod m_codes;
mod marks;
mod numbers;
mod start;
mod tables;
mod turning;
mod turns;

use fil_diag::Diag;
use fil_machine::Letter;
use fil_machine::axis_chain::{AxisChain, Carries};
use fil_machine::commons::{Commons, EMPTY, Kind};
use fil_machine::effects::{Effect, Effects, Rule};
use fil_machine::letter::letters;
use fil_machine::locations::Location;
use fil_machine::tape_style;
use fil_text::CodePage;

use crate::forward::Forward;
pub use codes::{Auxiliary, CycleKind, FeedMode, Function, Group};
pub use family::Family;
pub(crate) use family::is_cl_file;
use g_codes::Functions;
use m_codes::Auxiliaries;
pub(crate) use marks::{Marks, SKIP};
pub use numbers::{Address, Unreadable};
pub(crate) use start::Certain;
pub(crate) use tables::{Amount, Habit, Numbered, Role};
use tables::{Amounts, Habits, Letters, Numbers, ON};
pub(crate) use turning::Turning;
pub(crate) use turns::WayRound;

/// Names of the six axes that settings know, as their keys end.
const AXIS_NAMES: [&str; 6] = ["x", "y", "z", "a", "b", "c"];

/// What the tape holds of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    factor: f64,
    pub(crate) shift: f64,
}

impl Scale {
    /// Position that a value of the tape stands for.
    pub fn position(self, value: f64) -> f64 {
        (value - self.shift) / self.factor
    }

    /// True for an axis whose positions are diameters.
    pub fn is_diameter(self) -> bool {
        self.factor == 2.0
    }

    /// Way that an increment on the tape stands for.
    pub fn way(self, value: f64) -> f64 {
        value / self.factor
    }
}

/// How an arc names its center.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CenterForm {
    /// From the start to the center.
    FromStart,
    /// From the center to the start.
    FromCenter,
    /// The center's own coordinates.
    Absolute,
    /// From the start to the center without signs; arcs stay within a quadrant.
    Unsigned,
}

/// What the word of a helix beside its end says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HelixForm {
    /// The rise of a radian, without sign.
    Radian,
    /// The rise of a radian.
    SignedRadian,
    /// The rise of a turn, without sign.
    Turn,
}

/// How a cycle names its bottom and its R level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthForm {
    /// As positions.
    Absolute,
    /// R from the level before the cycle, the bottom from R.
    Increments,
    /// The same without signs: both go down.
    Unsigned,
}

/// How a tool is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolCall {
    /// `T` names it, the change code changes it.
    WithCode,
    /// `T` changes it at once.
    Word,
    /// `T0102` changes to tool 1 with offset 2.
    WithOffset,
}

/// An axis of the machine: X Y Z, and the two rotary axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    /// Its letter, 1 to 26; 0 for an axis that the machine lacks.
    pub(crate) letter: u8,
    /// What the tape holds of it; `None` for an axis that the machine lacks.
    pub(crate) scale: Option<Scale>,
    /// How its words count within a turn; `None` for an axis that counts on.
    pub(crate) way_round: Option<WayRound>,
    /// Where it is when the program begins, as far as the settings name it as last output value.
    pub(crate) start: Option<f64>,
    /// It turns the part, and not the tool.
    pub(crate) turns_part: bool,
    /// It turns without an end.
    pub(crate) is_endless: bool,
}

/// What the characters of a program are.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    /// Their encoding.
    pub(crate) page: CodePage,
    pub(crate) marks: Marks,
    /// By printed letter.
    addresses: [Option<Address>; 26],
}

/// What G and M words mean, by their numbers.
#[derive(Clone, Debug)]
struct Codes {
    functions: Functions,
    auxiliaries: Auxiliaries,
}

/// What is in force when a program begins, besides what [`Habit`]s say.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StartModes {
    pub(crate) plane: usize,
    pub(crate) feed_mode: FeedMode,
    /// The modes that are certain.
    pub(crate) certain: Certain,
    /// Those that stay certain behind a block of others that may change modes.
    pub(crate) behind_others: Certain,
}

/// In which form values are written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forms {
    pub(crate) center: CenterForm,
    /// What the word across the plane says of a helix; `None` where it has no meaning.
    pub(crate) helix: Option<HelixForm>,
    /// By the normal of the plane: the code for counterclockwise arcs turns by the
    /// right-hand rule.
    pub(crate) right_handed: [bool; 3],
    pub(crate) depth: DepthForm,
    pub(crate) tool_call: ToolCall,
    /// A word that makes a straight motion a rapid one: its letter and number.
    pub(crate) rapid_word: Option<(u8, f64)>,
}

/// The language of a machine's NC programs.
#[derive(Clone, Debug)]
pub struct Dialect {
    /// The family of the control.
    pub family: Family,
    pub(crate) text: Text,
    codes: Codes,
    pub(crate) axes: [Axis; 5],
    /// How the axes lead the tool.
    pub(crate) forward: Forward,
    letters: Letters,
    habits: Habits,
    amounts: Amounts,
    numbers: Numbers,
    pub(crate) start: StartModes,
    pub(crate) forms: Forms,
    /// Spindles and cycles of a lathe.
    pub(crate) turning: Turning,
    /// What functions of the shop do.
    effects: Effects,
}

/// The settings of a machine, by their names.
pub(crate) struct Settings<'c>(&'c Commons);

impl Settings<'_> {
    /// A setting; `None` when absent.
    pub(crate) fn number(&self, key: &str) -> Option<f64> {
        let row = Location::named(key)?;
        let value = self.0.get(row.kind, row.number.into()).ok()?;
        (value != EMPTY).then_some(value)
    }

    /// A code; `None` when absent.
    pub(crate) fn code(&self, key: &str) -> Option<i32> {
        self.number(key).map(|value| value as i32)
    }

    /// A flag that is on where nothing is said.
    fn is_not_off(&self, key: &str) -> bool {
        !matches!(self.code(key), Some(0 | 72))
    }

    fn flag(&self, key: &str) -> bool {
        self.code(key).is_some_and(|code| ON.contains(&code))
    }

    /// A letter, 1 to 26.
    fn letter(&self, key: &str) -> u8 {
        self.code(key).and_then(|code| u8::try_from(code).ok()).filter(|n| *n <= 26).unwrap_or(0)
    }
}

impl Dialect {
    /// X of a program is a diameter, unless it says otherwise.
    pub fn counts_diameters(&self) -> bool {
        self.axes[0].scale.is_some_and(Scale::is_diameter)
    }

    /// The machine turns parts: X may be a diameter, threads have cycles.
    pub fn is_lathe(&self) -> bool {
        self.has(Habit::Lathe)
    }

    /// The encoding of its programs.
    pub fn page(&self) -> CodePage {
        self.text.page
    }

    /// The language of the machine that these commons describe.
    ///
    /// # Errors
    /// Settings that make no machine (a direction of length zero).
    pub fn new(commons: &Commons) -> Result<Self, Box<Diag>> {
        let settings = Settings(commons);
        let forms = Forms::new(&settings);
        let diameter = settings.flag("lathe.diameter");
        // A lathe may write radii and call tools as a mill does, but cuts threads by a cycle.
        let cuts_threads = settings.code("thread.cycle_code").is_some();
        let lathe = diameter || forms.tool_call == ToolCall::WithOffset || cuts_threads;
        let kinematics = AxisChain::from_commons(commons)?;
        let functions = Functions::new(&settings, lathe, kinematics.has_rotary());
        Ok(Dialect {
            family: match settings.code("control.family") {
                Some(1) => Family::Klartext,
                Some(2) => Family::Sinumerik,
                _ => Family::WordAddress,
            },
            text: Text {
                page: tape_style::page(commons),
                marks: Marks::new(&settings),
                addresses: numbers::addresses(commons, lathe),
            },
            axes: axes(&settings, &kinematics, diameter),
            forward: Forward::new(kinematics),
            letters: Letters::new(&settings),
            habits: Habits::new(&settings, lathe),
            amounts: Amounts::new(&settings),
            numbers: Numbers::new(&settings),
            start: StartModes {
                plane: functions.plane(start::in_force(&settings, "circle.plane")),
                feed_mode: functions.feed_mode(start::in_force(&settings, "feed.mode")),
                certain: Certain::new(&settings, &functions),
                behind_others: Certain::behind_others(&settings, &functions),
            },
            codes: Codes { functions, auxiliaries: Auxiliaries::new(&settings) },
            forms,
            turning: Turning::new(&settings),
            effects: commons.effects().clone(),
        })
    }

    /// The same control with its switch on by which blocks are left out.
    #[must_use]
    pub fn skipping_blocks(&self) -> Dialect {
        let mut dialect = self.clone();
        dialect.habits.set(Habit::SkipsBlocks, true);
        dialect
    }

    /// Its switch is on by which blocks are left out.
    pub fn leaves_blocks_out(&self) -> bool {
        self.has(Habit::SkipsBlocks)
    }

    /// What a G word means, its number in tenths (`G68.2` is 682).
    pub fn function(&self, tenths: i64) -> Option<Function> {
        self.codes.functions.get(tenths)
    }

    /// S can be a surface speed.
    pub(crate) fn has_surface_speed(&self) -> bool {
        self.codes.functions.holds(Function::Surface(true))
    }

    /// A face can be milled in polar interpolation.
    pub(crate) fn has_polar(&self) -> bool {
        self.codes.functions.holds(Function::Polar(true)) || self.has(Habit::Transforms)
    }

    /// What an M word means; an M word that the machine does not name
    /// and that steers no program is [`Auxiliary::Other`].
    pub fn auxiliary(&self, code: i64) -> Auxiliary {
        self.codes.auxiliaries.get(code)
    }

    /// What a block does by the machine's own word, as one that smooths the path changes nothing. A
    /// function of its own number is told all the same, as the CL file may ask for it.
    pub(crate) fn effect(&self, block: impl FnOnce() -> String) -> Option<Effect> {
        if self.effects.is_empty() {
            return None;
        }
        let found = self.effects.of(&block()).map(|found| found.rule);
        found.filter(|rule| self.told(rule).is_none()).map(|rule| rule.effect)
    }

    /// The number of the M function that a rule names, where it is none of those that the control
    /// itself carries out.
    fn told(&self, rule: &Rule) -> Option<u32> {
        let function = rule.function().filter(|function| function.is_whole())?;
        match self.auxiliary(i64::from(function.in_tenths() / 10)) {
            Auxiliary::Other(code) => Some(code),
            _ => None,
        }
    }

    /// An M function changes nothing, by the machine's own word.
    pub(crate) fn is_allowed(&self, code: i64) -> bool {
        self.allowed_functions().iter().any(|allowed| i64::from(*allowed) == code)
    }

    /// The M functions that change nothing, by the machine's own word.
    pub(crate) fn allowed_functions(&self) -> Vec<u32> {
        let rules = self.effects.rules().iter().filter(|rule| rule.effect == Effect::Nothing);
        rules.filter_map(|rule| self.told(rule)).collect()
    }

    /// The control does this.
    pub(crate) fn has(&self, habit: Habit) -> bool {
        self.habits.has(habit)
    }

    /// The letter (1 to 26) of a word; 0 where the machine has none for it.
    pub(crate) fn letter(&self, role: Role) -> u8 {
        self.letters.get(role)
    }

    /// An amount of the machine; `None` where it names none.
    pub(crate) fn amount(&self, amount: Amount) -> Option<f64> {
        self.amounts.get(amount)
    }

    /// The same of a factor, which leaves values as they are where it is not named.
    pub(crate) fn factor(&self, amount: Amount) -> f64 {
        self.amount(amount).unwrap_or(1.0)
    }

    /// The number in a name of a SINUMERIK.
    pub(crate) fn number(&self, numbered: Numbered) -> Option<i32> {
        self.numbers.get(numbered)
    }

    /// The address of a printed letter; `None` when the machine has none.
    pub fn address(&self, printed: u8) -> Option<&Address> {
        self.text.addresses.get(usize::from(printed.wrapping_sub(b'A')))?.as_ref()
    }

    /// Number of the axis (0 to 2 are X Y Z, 3 and 4 the rotaries) that a letter
    /// (1 to 26) moves.
    pub fn axis(&self, letter: u8) -> Option<usize> {
        self.axes.iter().position(|axis| axis.scale.is_some() && axis.letter == letter)
    }

    /// The axes of the tables, 3 and 4.
    pub(crate) fn tables(&self) -> impl Iterator<Item = usize> {
        (3..5).filter(|axis| self.axes[*axis].turns_part)
    }
}

impl Forms {
    fn new(settings: &Settings) -> Self {
        Forms {
            center: match settings.code("circle.center") {
                Some(2) => CenterForm::FromCenter,
                Some(4) => CenterForm::Absolute,
                Some(5) => CenterForm::Unsigned,
                _ => CenterForm::FromStart,
            },
            helix: match (settings.code("circle.helix_word"), settings.code("circle.helix_output"))
            {
                (Some(0), _) => None,
                (_, Some(2)) => Some(HelixForm::SignedRadian),
                (_, Some(3)) => Some(HelixForm::Turn),
                _ => Some(HelixForm::Radian),
            },
            right_handed: [
                settings.is_not_off("circle.ccw_yz"),
                !settings.flag("circle.ccw_xz"),
                settings.is_not_off("circle.ccw_xy"),
            ],
            depth: match settings.code("cycle.depth_output") {
                Some(2) => DepthForm::Increments,
                Some(3) => DepthForm::Unsigned,
                _ => DepthForm::Absolute,
            },
            tool_call: match (settings.code("tool.format"), settings.code("tool.change_code")) {
                (Some(2 | 3), _) => ToolCall::WithOffset,
                (_, Some(_)) => ToolCall::WithCode,
                (_, None) => ToolCall::Word,
            },
            rapid_word: Some(settings.letter("rapid.address"))
                .filter(|letter| *letter > 0)
                .zip(settings.number("rapid.value")),
        }
    }
}

/// The axes of a machine.
fn axes(settings: &Settings, kinematics: &AxisChain, diameter: bool) -> [Axis; 5] {
    let ways_round = turns::ways(settings, kinematics);
    std::array::from_fn(|axis| {
        let rotary = axis.checked_sub(3).map(|index| kinematics.rotaries[index].as_ref());
        let (letter, scale) = match rotary {
            None => (letters::XYZ[axis].number(), Some(scale(settings, axis))),
            Some(None) => (0, None),
            Some(Some(rotary)) => (rotary.letter.number(), Some(scale(settings, rotary.axis + 3))),
        };
        let scale = scale.map(|scale| match diameter && axis == 0 {
            true => Scale { factor: 2.0, ..scale },
            false => scale,
        });
        let last = Letter::numbered(letter.into()).map_or(EMPTY, |at| settings.0.last_output(at));
        Axis {
            letter,
            scale,
            way_round: ways_round[axis],
            start: scale.filter(|_| last != EMPTY).map(|scale| scale.position(last)),
            turns_part: rotary.flatten().is_some_and(|rotary| rotary.carries == Carries::Table),
            is_endless: rotary.flatten().is_some_and(|rotary| !rotary.is_limited()),
        }
    })
}

fn scale(settings: &Settings, axis: usize) -> Scale {
    let name = AXIS_NAMES[axis];
    let factor = settings.number(&format!("scale.{name}")).filter(|factor| *factor != 0.0);
    let shift = settings.number(&format!("output.translate_{name}"));
    Scale { factor: factor.unwrap_or(1.0), shift: shift.unwrap_or(0.0) }
}

/// A location of INTCOM by its number; `None` when absent.
pub(crate) fn int(commons: &Commons, location: u32) -> Option<i32> {
    let value = commons.get(Kind::Int, location).ok()?;
    (value != EMPTY).then_some(value as i32)
}
