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
mod turning;
mod turns;

use fil_diag::Diag;
use fil_machine::Letter;
use fil_machine::axis_chain::{AxisChain, Carries};
use fil_machine::commons::{Commons, EMPTY, Kind};
use fil_machine::locations::Location;
use fil_machine::tape_style;
use fil_text::CodePage;

use crate::forward::Forward;
pub use codes::{Auxiliary, CycleKind, FeedMode, Function, Group};
pub use family::Family;
use g_codes::Functions;
use m_codes::Auxiliaries;
pub(crate) use marks::{Marks, SKIP};
pub use numbers::{Address, Unreadable};
pub(crate) use start::Certain;
pub(crate) use turning::{Counted, LivePecks, WayOut};
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

/// The language of a machine's NC programs.
#[derive(Clone, Debug)]
pub struct Dialect {
    /// The family of the control.
    pub family: Family,
    /// The encoding of its programs.
    pub page: CodePage,
    functions: Functions,
    auxiliaries: Auxiliaries,
    pub(crate) marks: Marks,
    /// By printed letter.
    addresses: [Option<Address>; 26],
    /// X Y Z and the two rotary axes; `None` without one.
    pub(crate) scales: [Option<Scale>; 5],
    /// Letters (1 to 26) of these axes.
    pub(crate) axis_letters: [u8; 5],
    /// How words of rotary axes count within a turn; `None` for axes that count on.
    pub(crate) ways_round: [Option<WayRound>; 5],
    /// Which of the two rotary axes turn the part.
    pub(crate) tables: [bool; 2],
    /// The steps of X, Y and Z that a setting names, in the unit of the program; 0 where the last
    /// digits are theirs.
    pub(crate) steps: f64,
    /// How the axes lead the tool.
    pub(crate) forward: Forward,
    /// The main spindle can become the axis C: whether it is one when the program begins.
    pub(crate) live_at_start: Option<bool>,
    /// One code turns the main spindle and the live tool, whichever is in use: by clockwise,
    /// counterclockwise and stop.
    pub(crate) one_code: [bool; 3],
    /// The feed that stands for rapid motions in polar interpolation, mm a minute.
    pub(crate) polar_rapid: Option<f64>,
    /// What the cycles of live tools do with pecks.
    pub(crate) live_pecks: LivePecks,
    /// M codes by which threading cycles leave a thread; `None` for a machine without.
    pub(crate) way_out: Option<WayOut>,
    /// A SINUMERIK has TRANSMIT and TRACYL in place of an axis Y.
    pub(crate) transforms: bool,
    /// The spindle of the live tool by its number, which SETMS makes the master spindle.
    pub(crate) live_spindle: Option<i32>,
    /// How the control is told which spindle of a lathe it counts.
    pub(crate) counted: Counted,
    /// The codes that make the main spindle an axis and a spindle again.
    pub(crate) spindle_modes: [Option<i32>; 2],
    /// Tool-tip control may begin wherever the tables stand.
    pub(crate) tip_control_anywhere: bool,
    /// The machine turns parts: X may be a diameter, threads have cycles.
    pub lathe: bool,
    /// Programs begin in mm and not in inch, where they don't say.
    pub metric: bool,
    /// Where the axes stand when the program begins, as far as the settings say.
    pub(crate) start: [Option<f64>; 5],
    pub(crate) plane: usize,
    pub(crate) feed_mode: FeedMode,
    /// Axis words are positions when the program begins, else increments.
    pub(crate) absolute: bool,
    /// The modes that are certain when the program begins.
    pub(crate) certain: Certain,
    /// The switch of the control is on by which blocks with a skip mark are left out.
    pub(crate) skips_blocks: bool,
    pub(crate) center: CenterForm,
    pub(crate) depth: DepthForm,
    pub(crate) tool_call: ToolCall,
    /// Letters of special words, 1 to 26.
    pub(crate) radius: u8,
    /// An arc right behind another keeps its radius.
    pub(crate) radius_modal: bool,
    /// By the normal of the plane: the code for counterclockwise arcs turns by the
    /// right-hand rule.
    pub(crate) right_handed: [bool; 3],
    /// What the word across the plane says of a helix; `None` where it has no meaning.
    pub(crate) helix: Option<HelixForm>,
    pub(crate) step: u8,
    pub(crate) cycle_dwell: u8,
    pub(crate) dwell: u8,
    pub(crate) tool_offset: u8,
    /// That of the number of a numbered work offset.
    pub(crate) fixture_number: u8,
    /// That of a word that chooses the work offset; 0 for none.
    pub(crate) fixture_word: u8,
    /// That of the lead of a threading move.
    pub(crate) lead: u8,
    /// That of what a varying lead gains in each turn.
    pub(crate) lead_change: u8,
    /// The lead is measured along the path, else along the longer axis.
    pub(crate) lead_along_path: bool,
    /// A tool change leaves it to a function to call the length of the tool.
    pub(crate) calls_lengths: bool,
    /// A position of the machine along Z ends that length.
    pub(crate) positions_end_lengths: bool,
    /// T names the nose by two digits before those of the tool.
    pub(crate) names_noses: bool,
    /// Threads need feeds a turn: lathes with a cycle of all passes in one block.
    pub(crate) threads_need_turns: bool,
    /// That of the taper in the threading cycle of one pass.
    pub(crate) thread_taper: u8,
    /// That of the number of threads in F of that cycle; 0 for none.
    pub(crate) thread_count: u8,
    /// That of the highest speed beside a surface speed; 0 for none.
    pub(crate) speed_limit: u8,
    /// That of the angle of an oriented spindle; 0 for none.
    pub(crate) orientation: u8,
    /// A SINUMERIK counts the lengths of a tool along the same axes in every plane.
    pub(crate) lengths_are_fast: bool,
    /// Control's dwell unit in a second.
    pub(crate) dwell_factor: f64,
    /// Control's dwell unit in a turn of the spindle, where it waits turns.
    pub(crate) turns_factor: Option<f64>,
    /// Control's feed unit in a unit of length a minute.
    pub(crate) feed_factor: f64,
    /// Control's inverse time in motions a minute.
    pub(crate) inverse_factor: f64,
    /// A word that makes a straight motion a rapid one: its letter and number.
    pub(crate) rapid_word: Option<(u8, f64)>,
    /// Holes return to the level before the cycle, where the program does not say.
    pub(crate) return_initial: bool,
    /// Numbers in the names of a SINUMERIK's linear and rotary axes and its spindle.
    pub(crate) axis_index: Option<i32>,
    pub(crate) rotary_index: Option<i32>,
    pub(crate) spindle_index: Option<i32>,
    /// TRANS of a SINUMERIK is the translation of the CL file, so that positions count from
    /// where the zero was before.
    pub(crate) translates: bool,
    /// A SINUMERIK calls tools by the names that the CL file has for them.
    pub(crate) names_tools: bool,
    /// Programs end with a code; without one the last block is the end.
    pub(crate) has_end: bool,
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
        matches!(self.code(key), Some(1 | 71))
    }

    /// A letter, 1 to 26.
    fn letter(&self, key: &str) -> u8 {
        self.code(key).and_then(|code| u8::try_from(code).ok()).filter(|n| *n <= 26).unwrap_or(0)
    }
}

impl Dialect {
    /// X of a program is a diameter, unless it says otherwise.
    pub fn counts_diameters(&self) -> bool {
        self.scales[0].is_some_and(Scale::is_diameter)
    }

    /// The language of the machine that these commons describe.
    ///
    /// # Errors
    /// Settings that make no machine (a direction of length zero).
    pub fn new(commons: &Commons) -> Result<Self, Box<Diag>> {
        let settings = Settings(commons);
        let tool_call = match (settings.code("tool.format"), settings.code("tool.change_code")) {
            (Some(2 | 3), _) => ToolCall::WithOffset,
            (_, Some(_)) => ToolCall::WithCode,
            (_, None) => ToolCall::Word,
        };
        let diameter = settings.flag("lathe.diameter");
        // A lathe may write radii and call tools as a mill does, but cuts threads by a cycle.
        let cuts_threads = settings.code("thread.cycle_code").is_some();
        let lathe = diameter || tool_call == ToolCall::WithOffset || cuts_threads;
        let kinematics = AxisChain::from_commons(commons)?;
        let mut axis_letters = [24, 25, 26, 0, 0];
        let mut scales = [0, 1, 2].map(|axis| Some(scale(&settings, axis))).to_vec();
        for (index, rotary) in kinematics.rotaries.iter().enumerate() {
            axis_letters[index + 3] = rotary.as_ref().map_or(0, |rotary| rotary.letter.number());
            scales.push(rotary.as_ref().map(|rotary| scale(&settings, rotary.axis + 3)));
        }
        if let (true, Some(x)) = (diameter, &mut scales[0]) {
            x.factor = 2.0;
        }
        let scales = [scales[0], scales[1], scales[2], scales[3], scales[4]];
        let functions = Functions::new(&settings, lathe, kinematics.has_rotary());
        let tables = kinematics
            .rotaries
            .each_ref()
            .map(|rotary| rotary.as_ref().is_some_and(|rotary| rotary.carries == Carries::Table));
        Ok(Dialect {
            family: match settings.code("control.family") {
                Some(1) => Family::Klartext,
                Some(2) => Family::Sinumerik,
                _ => Family::WordAddress,
            },
            page: tape_style::page(commons),
            addresses: numbers::addresses(commons, lathe),
            start: start(commons, axis_letters, scales),
            scales,
            axis_letters,
            ways_round: turns::ways(&settings, &kinematics),
            tables,
            forward: Forward::new(kinematics),
            steps: match settings.flag("motion.resolution_manual") {
                true => settings.number("motion.resolution").unwrap_or(0.0),
                false => 0.0,
            },
            live_at_start: settings
                .code("mill_turn.milling_code")
                .map(|_| settings.code("mill_turn.mode").is_some_and(|mode| mode != 0)),
            one_code: ["cw", "ccw", "stop"].map(|turn| {
                let code = |of: &str| settings.code(&format!("{of}{turn}_code"));
                code("mill_turn.live_") == code("spindle.")
            }),
            transforms: settings.flag("mill_turn.transformations"),
            live_spindle: settings.code("mill_turn.live_spindle"),
            counted: Counted::new(&settings),
            spindle_modes: ["milling", "turning"]
                .map(|mode| settings.code(&format!("mill_turn.{mode}_code"))),
            polar_rapid: settings.number("mill_turn.polar_rapid"),
            live_pecks: LivePecks::new(&settings),
            way_out: WayOut::new(&settings),
            tip_control_anywhere: settings.code("rotary.tip_control") == Some(1),
            lathe,
            metric: start::metric(&settings),
            plane: functions.plane(start::in_force(&settings, "circle.plane")),
            feed_mode: functions.feed_mode(start::in_force(&settings, "feed.mode")),
            absolute: start::absolute(&settings),
            certain: Certain::new(&settings, &functions),
            skips_blocks: false,
            functions,
            auxiliaries: Auxiliaries::new(&settings),
            marks: Marks::new(&settings),
            center: match settings.code("circle.center") {
                Some(2) => CenterForm::FromCenter,
                Some(4) => CenterForm::Absolute,
                Some(5) => CenterForm::Unsigned,
                _ => CenterForm::FromStart,
            },
            depth: match settings.code("cycle.depth_output") {
                Some(2) => DepthForm::Increments,
                Some(3) => DepthForm::Unsigned,
                _ => DepthForm::Absolute,
            },
            tool_call,
            radius: settings.letter("circle.radius_address"),
            radius_modal: settings.flag("circle.radius_modal"),
            right_handed: [
                settings.is_not_off("circle.ccw_yz"),
                !settings.flag("circle.ccw_xz"),
                settings.is_not_off("circle.ccw_xy"),
            ],
            helix: match (settings.code("circle.helix_word"), settings.code("circle.helix_output"))
            {
                (Some(0), _) => None,
                (_, Some(2)) => Some(HelixForm::SignedRadian),
                (_, Some(3)) => Some(HelixForm::Turn),
                _ => Some(HelixForm::Radian),
            },
            step: settings.letter("cycle.step_address"),
            cycle_dwell: settings.letter("cycle.dwell_address"),
            dwell: settings.letter("dwell.address"),
            tool_offset: settings.letter("cutcom.address"),
            fixture_number: settings.letter("fixture.extended_address"),
            fixture_word: match settings.code("fixture.form") {
                Some(2) => settings.letter("fixture.address"),
                _ => 0,
            },
            lead: settings.letter("thread.lead_address"),
            lead_change: settings.letter("thread.change_address"),
            lead_along_path: settings.code("thread.lead_along") == Some(1),
            calls_lengths: lengths::are_called(&settings),
            positions_end_lengths: lengths::are_called(&settings)
                && settings.is_not_off("home.ends_length"),
            names_noses: settings.code("tool.format") == Some(3),
            threads_need_turns: settings.code("thread.cycle") == Some(3),
            thread_taper: settings.letter("thread.taper_address"),
            thread_count: settings.letter("thread.count_address"),
            speed_limit: settings.letter("spindle.max_address"),
            orientation: settings.letter("spindle.orient_address"),
            lengths_are_fast: settings.flag("tool.length_const"),
            dwell_factor: factor(&settings, "dwell.upm_factor"),
            turns_factor: settings.number("dwell.upr_factor").filter(|factor| *factor > 0.0),
            feed_factor: factor(&settings, "feed.upm_factor"),
            inverse_factor: factor(&settings, "feed.inverse_factor"),
            rapid_word: Some(settings.letter("rapid.address"))
                .filter(|letter| *letter > 0)
                .zip(settings.number("rapid.value")),
            return_initial: settings.code("cycle.return_codes") == Some(2),
            axis_index: settings.code("control.axis_index"),
            rotary_index: settings.code("control.rotary_index"),
            spindle_index: settings.code("control.spindle_index"),
            names_tools: settings.code("control.tool_call") == Some(2),
            translates: settings.code("control.translation") == Some(1),
            has_end: ["program.end_code", "program.rewind_code"]
                .iter()
                .any(|key| settings.code(key).is_some()),
        })
    }

    /// The same control with its switch on by which blocks are left out.
    #[must_use]
    pub fn skipping_blocks(&self) -> Dialect {
        Dialect { skips_blocks: true, ..self.clone() }
    }

    /// Its switch is on by which blocks are left out.
    pub fn leaves_blocks_out(&self) -> bool {
        self.skips_blocks
    }

    /// What a G word means, its number in tenths (`G68.2` is 682).
    pub fn function(&self, tenths: i64) -> Option<Function> {
        self.functions.get(tenths)
    }

    /// S can be a surface speed.
    pub(crate) fn has_surface_speed(&self) -> bool {
        self.functions.holds(Function::Surface(true))
    }

    /// What an M word means; an M word that the machine does not name
    /// and that steers no program is [`Auxiliary::Other`].
    pub fn auxiliary(&self, code: i64) -> Auxiliary {
        self.auxiliaries.get(code)
    }

    /// The address of a printed letter; `None` when the machine has none.
    pub fn address(&self, printed: u8) -> Option<&Address> {
        self.addresses.get(usize::from(printed.wrapping_sub(b'A')))?.as_ref()
    }

    /// Number of the axis (0 to 2 are X Y Z, 3 and 4 the rotaries) that a letter
    /// (1 to 26) moves.
    pub fn axis(&self, letter: u8) -> Option<usize> {
        let named = |axis: &usize| self.axis_letters[*axis] == letter;
        (0..5).filter(|axis| self.scales[*axis].is_some()).find(named)
    }
}

fn scale(settings: &Settings, axis: usize) -> Scale {
    let name = AXIS_NAMES[axis];
    let factor = settings.number(&format!("scale.{name}")).filter(|factor| *factor != 0.0);
    let shift = settings.number(&format!("output.translate_{name}"));
    Scale { factor: factor.unwrap_or(1.0), shift: shift.unwrap_or(0.0) }
}

/// A factor where 0 and absent leave values as they are.
fn factor(settings: &Settings, key: &str) -> f64 {
    settings.number(key).filter(|factor| *factor > 0.0).unwrap_or(1.0)
}

/// Positions of the axes before the program, where the settings name them as last
/// output values.
fn start(commons: &Commons, letters: [u8; 5], scales: [Option<Scale>; 5]) -> [Option<f64>; 5] {
    std::array::from_fn(|axis| {
        let value = commons.last_output(Letter::numbered(letters[axis].into())?);
        let scale = scales[axis].filter(|_| value != EMPTY)?;
        Some(scale.position(value))
    })
}

/// A location of INTCOM by its number; `None` when absent.
pub(crate) fn int(commons: &Commons, location: u32) -> Option<i32> {
    let value = commons.get(Kind::Int, location).ok()?;
    (value != EMPTY).then_some(value as i32)
}
