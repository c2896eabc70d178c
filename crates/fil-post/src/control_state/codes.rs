//! What the G and M codes of a machine mean: those its settings name, and in foreign blocks the
//! standard ones (ISO 6983, RS-274), as `fil_machine::functions` has them.

use fil_machine::effects::Effect;
use fil_machine::functions::{
    self, AxisClamp, Call, Dialect, FUNCTIONS, Function, Group, LengthOffset, Meaning, Origin,
    Space, Spindle, WorkPlane,
};
use fil_machine::locations::{self as loc, ControlFamily, RotaryTipOutput, ToolFormat};
use fil_machine::modes::FeedMode;
use fil_machine::setting::CodeAt;
use fil_machine::{Commons, FunctionCode, Letter, letters};

use super::{MachineSpot, Rotation, WorkOffset, functions, length};

/// G34 and G35 of a SINUMERIK: threading moves whose lead grows, and shrinks.
pub const VARYING_LEADS_OF_SINUMERIK: [FunctionCode; 2] =
    [FunctionCode::whole(34), FunctionCode::whole(35)];

/// G71 of an OSP: a whole thread.
pub const THREAD_OF_OSP: FunctionCode = FunctionCode::whole(71);

/// A code and its row of the table.
type Named = (FunctionCode, &'static Function);

/// The codes of a machine.
#[derive(Clone, Debug)]
pub struct Codes {
    /// The G codes that settings name, in the order of the table: the first of one number counts.
    preparatory: Vec<Named>,
    /// The M codes that they name, and the standard ones, by code.
    auxiliary: Vec<Named>,
    /// Whose standard codes it has.
    dialect: Dialect,
    /// The lowest and the highest code of the work offsets.
    offsets: Option<(FunctionCode, FunctionCode)>,
    /// The letter of the number beside the code of a further work offset.
    offset_letter: Option<Letter>,
    /// The machine has canned cycles that a code ends.
    has_cycle_end: bool,
    /// The tool length offset is activated by a code.
    pub(crate) calls_lengths: bool,
    /// A position of the machine cancels the tool length offset of the axis that goes there.
    pub(super) positions_end_lengths: bool,
    /// Tool center point control takes the length of the last LOADTL.
    pub(super) tip_control: bool,
    /// The last digits of T are the offset: T0303.
    pub tool_word_has_offset: bool,
    /// T changes the tool by itself, as on a turret.
    pub tool_word_changes: bool,
}

impl Codes {
    /// The codes that the settings name.
    pub fn from_commons(commons: &Commons) -> Self {
        let dialect = Dialect::of(commons);
        let code = |at: CodeAt| commons.read(at).and_then(FunctionCode::of_setting);
        let calls_lengths = length::are_called(commons);
        let by_word = commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode;
        let mut preparatory = functions::named(commons, dialect);
        let of_g = preparatory.partition_point(|(_, row)| row.space != Space::M);
        let mut auxiliary = preparatory.split_off(of_g);
        let rules = commons.effects().rules().iter();
        let said: Vec<(FunctionCode, Effect)> =
            rules.filter_map(|rule| Some((rule.function()?, rule.effect))).collect();
        auxiliary.retain(|(code, _)| said.iter().all(|(said, _)| said != code));
        let change = FUNCTIONS.iter().find(|row| row.meaning == Meaning::ToolChange);
        let changes = said.iter().filter(|(_, effect)| *effect == Effect::ToolChange);
        auxiliary
            .extend(changes.zip(change.into_iter().cycle()).map(|((code, _), row)| (*code, row)));
        // A setting replaces the standard code of what it does, and `[effects]` that of its code.
        let is_left = |(code, row): &Named| {
            let is_named = || auxiliary.iter().any(|(_, own)| own.meaning == row.meaning);
            said.iter().all(|(said, _)| said != code) && (row.settings.is_empty() || !is_named())
        };
        let standards: Vec<Named> =
            functions::standards(dialect, Space::M).filter(is_left).collect();
        auxiliary.extend(standards);
        // By code, and those of one code in the order of the table.
        auxiliary.sort_by_key(|(code, _)| *code);
        Codes {
            auxiliary,
            preparatory,
            dialect,
            offset_letter: commons.read(loc::FIXTURE_EXTENDED_ADDRESS),
            offsets: code(loc::FIXTURE_MIN_CODE).zip(code(loc::FIXTURE_MAX_CODE)),
            has_cycle_end: commons.read(loc::CYCLE_OFF_CODE).is_some(),
            calls_lengths,
            positions_end_lengths: calls_lengths && commons.read(loc::HOME_ENDS_LENGTH),
            tip_control: commons.read(loc::ROTARY_TIP_OUTPUT) == RotaryTipOutput::Tcpc,
            tool_word_has_offset: by_word
                && commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress,
            tool_word_changes: by_word || commons.read(loc::TOOL_CHANGE_CODE).is_none(),
        }
    }

    /// The row of a G code; `None` for one that is not known.
    #[inline]
    pub fn function(&self, code: FunctionCode) -> Option<&'static Function> {
        match self.preparatory.iter().find(|(named, _)| *named == code) {
            Some((_, row)) => Some(row),
            None => functions::standard(self.dialect, Space::G, code)
                .or_else(|| self.offset_in_range(code)),
        }
    }

    /// What a G code does.
    #[inline]
    pub fn meaning(&self, code: FunctionCode) -> Meaning {
        self.function(code).map_or(Meaning::Unknown, |row| row.meaning)
    }

    /// A code between those of the work offsets is one of them, unless it is known as something
    /// else.
    fn offset_in_range(&self, code: FunctionCode) -> Option<&'static Function> {
        let offset = Meaning::Origin(Origin::WorkOffset);
        let (first, last) = self.offsets?;
        let is_between = first <= code && code <= last && code.is_whole();
        FUNCTIONS.iter().find(|row| is_between && row.meaning == offset)
    }

    /// The rows of an M code, which may do several things: M5 of a SINUMERIK stops the spindle and
    /// ends milling.
    #[inline]
    pub fn auxiliaries(
        &self,
        code: FunctionCode,
    ) -> impl Iterator<Item = &'static Function> + Clone + '_ {
        let first = self.auxiliary.partition_point(|(named, _)| *named < code);
        let rows = self.auxiliary[first..].iter().take_while(move |(named, _)| *named == code);
        rows.map(|(_, row)| *row)
    }

    /// True for an M code that does this, among other things.
    pub fn does(&self, code: FunctionCode, meaning: Meaning) -> bool {
        self.auxiliaries(code).any(|row| row.meaning == meaning)
    }

    /// The axis that a letter moves: in G code system A of lathes U, V and W are increments of X, Y
    /// and Z.
    pub fn moved_by(&self, letter: Letter) -> Letter {
        let increments = [b'U', b'V', b'W'];
        let index = increments.iter().position(|byte| *byte == letter.byte());
        let is_lathe_a = self.dialect == Dialect::LatheA;
        index.filter(|_| is_lathe_a).map_or(letter, |index| letters::XYZ[index])
    }

    /// True for a code whose block goes to positions of the machine, or to a reference point.
    pub fn goes_to_machine(&self, code: FunctionCode) -> bool {
        matches!(self.meaning(code), Meaning::Origin(origin) if origin.is_of_machine())
    }

    /// Where a block brings an axis whose word has this value: a reference point, or the value in
    /// machine coordinates. On a SINUMERIK the length of the cutting edge counts in those.
    pub fn machine_spot(
        &self,
        words: &[(Letter, f64)],
        value: f64,
        is_absolute: bool,
    ) -> Option<MachineSpot> {
        let is_second = |(letter, value): &(Letter, f64)| letter.byte() == b'P' && *value != 2.0;
        functions(words).find_map(|code| match self.meaning(code) {
            Meaning::Origin(Origin::Home) if !words.iter().any(is_second) => {
                Some(MachineSpot::Reference(code))
            }
            Meaning::Origin(Origin::Machine) if is_absolute && !self.keeps_cycles() => {
                Some(MachineSpot::At(value))
            }
            _ => None,
        })
    }

    /// True for a code that chooses a work offset, by itself or by a word beside it.
    pub fn chooses_offset(&self, code: FunctionCode) -> bool {
        matches!(self.meaning(code), Meaning::Origin(origin) if origin.is_offset())
    }

    /// The work offset that a code chooses; `word` gives the value of a word beside it. `None` for
    /// a code that chooses none.
    pub fn work_offset(
        &self,
        code: FunctionCode,
        word: impl Fn(Letter) -> Option<f64>,
    ) -> Option<WorkOffset> {
        let number = match self.meaning(code) {
            Meaning::Origin(Origin::WorkOffset) => None,
            Meaning::Origin(Origin::NumberedOffset) => self.offset_letter.and_then(word),
            _ => return None,
        };
        Some(WorkOffset { code, number: number.map(|number| number as i32) })
    }

    /// True for a code that activates the tool length offset.
    pub fn calls_length(&self, code: FunctionCode) -> bool {
        self.meaning(code) == Meaning::LengthOffset(LengthOffset::Activate)
    }

    /// How the spindle turns after an M code, the sub-spindle where that is the master; `None` for
    /// a code that leaves it.
    pub fn rotation(&self, code: FunctionCode, of_side: bool) -> Option<Rotation> {
        // A sub-spindle without codes of its own is turned by those of the main one.
        let is_side = |(_, row): &Named| row.meaning.group() == Group::SideSpindle;
        let by_side = of_side && self.auxiliary.iter().any(is_side);
        self.auxiliaries(code).find_map(|row| match row.meaning {
            Meaning::Spindle(Spindle::Axis) => Some(Rotation::Standing),
            Meaning::Spindle(does) if !by_side => rotation(does),
            Meaning::SideSpindle(does) if by_side => rotation(does),
            _ => None,
        })
    }

    /// True for a code that turns the spindle by the S of its block.
    pub fn turns_spindle(&self, code: FunctionCode) -> bool {
        let turns = [Spindle::Clockwise, Spindle::Counterclockwise, Spindle::Default];
        turns.iter().any(|does| self.does(code, Meaning::Spindle(*does)))
    }

    /// True for a code that calls a program, or returns from one.
    pub fn calls_program(&self, code: FunctionCode) -> bool {
        self.auxiliaries(code).any(|row| matches!(row.meaning, Meaning::Call(_)))
    }

    /// True for a code that ends a program or a subprogram.
    pub fn ends_program(&self, code: FunctionCode) -> bool {
        let is_end =
            |meaning| matches!(meaning, Meaning::ProgramEnd(_) | Meaning::Call(Call::Return));
        self.auxiliaries(code).any(|row| is_end(row.meaning))
    }

    /// True for a code that ends the main program.
    pub fn ends_main_program(&self, code: FunctionCode) -> bool {
        let end = Meaning::ProgramEnd(functions::ProgramEnd::Program);
        self.auxiliaries(code).any(|row| row.meaning == end)
    }

    /// True for a code that switches coolant on or off.
    pub fn is_coolant(&self, code: FunctionCode) -> bool {
        self.auxiliaries(code).any(|row| matches!(row.meaning, Meaning::Coolant(_)))
    }

    /// Whether a code clamps the rotary axes or releases them; `None` for any other.
    pub fn clamps(&self, code: FunctionCode) -> Option<bool> {
        self.auxiliaries(code).find_map(|row| match row.meaning {
            Meaning::AxisClamp(does) => Some(does == AxisClamp::Clamp),
            _ => None,
        })
    }

    /// True where the codes of the speed and those of the feed are one modal group.
    pub fn speeds_are_feeds(&self) -> bool {
        self.dialect == Dialect::Sinumerik
    }

    /// What F counts after a code of the speed: on a SINUMERIK G96, G97 and G973 are feeds a
    /// revolution, G961 and G971 feeds a minute, and G962 and G972 leave it open.
    pub fn feed_behind_speed(
        &self,
        code: FunctionCode,
        before: Option<FeedMode>,
    ) -> Option<FeedMode> {
        const A_MINUTE: [FunctionCode; 2] = [FunctionCode::whole(961), FunctionCode::whole(971)];
        const OPEN: [FunctionCode; 2] = [FunctionCode::whole(962), FunctionCode::whole(972)];
        match code {
            _ if !self.speeds_are_feeds() => before,
            _ if A_MINUTE.contains(&code) => Some(FeedMode::PerMinute),
            _ if OPEN.contains(&code) => None,
            _ => Some(FeedMode::PerRevolution),
        }
    }

    /// True for words that move axes to positions of the part, with the tool length offset as it
    /// was: no code activates or cancels one, moves the origin or goes to a place of the machine.
    pub fn moves_in_part(&self, words: &[(Letter, f64)]) -> bool {
        let moves = |code| match self.meaning(code) {
            Meaning::LengthOffset(_)
            | Meaning::Tcpc
            | Meaning::WorkPlane(_)
            | Meaning::Dwell
            | Meaning::Unknown => false,
            Meaning::Origin(origin) => origin.is_offset(),
            _ => true,
        };
        !self.places_zero(words) && functions(words).all(moves)
    }

    /// True for words that place the origin: those of the code that limits the speed, which on a
    /// lathe does so where X or Z stand beside it (G50 X100. Z50.).
    pub fn places_zero(&self, words: &[(Letter, f64)]) -> bool {
        let has = |letters: &[u8]| words.iter().any(|(letter, _)| letters.contains(&letter.byte()));
        let is_limit = |code| self.meaning(code) == Meaning::SpeedLimit;
        has(b"XZUW") && functions(words).any(is_limit)
    }

    /// How a G code turns the coordinates against those before it, of which `before` is known;
    /// `None` for one that does not turn any. `word` gives the value of a word of its block: with
    /// the parts of an axis (I, J, K) a rotation is one in space.
    pub fn turned(
        &self,
        code: FunctionCode,
        before: Option<WorkPlane>,
        word: impl Fn(Letter) -> Option<f64>,
    ) -> Option<WorkPlane> {
        let Meaning::WorkPlane(to) = self.meaning(code) else { return None };
        let is_in_space = || letters::IJK.into_iter().any(|letter| word(letter).is_some());
        Some(match (to, before) {
            (WorkPlane::Off, Some(before)) => before,
            (WorkPlane::Rotated, Some(WorkPlane::Off | WorkPlane::Rotated)) if !is_in_space() => to,
            _ => WorkPlane::Tilted,
        })
    }

    /// True when a motion code ends a cycle that no code ends.
    pub fn motion_ends_cycle(&self) -> bool {
        !self.has_cycle_end && !self.keeps_cycles()
    }

    /// True when no code of a motion can end a cycle: `MCALL` does.
    pub fn keeps_cycles(&self) -> bool {
        self.dialect == Dialect::Sinumerik
    }
}

fn rotation(does: Spindle) -> Option<Rotation> {
    match does {
        Spindle::Clockwise => Some(Rotation::Clockwise),
        Spindle::Counterclockwise => Some(Rotation::Counterclockwise),
        Spindle::Stop | Spindle::Orient | Spindle::Axis => Some(Rotation::Standing),
        Spindle::Default => None,
    }
}
