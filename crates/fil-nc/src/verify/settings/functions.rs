//! Codes and placements of spindle, coolant, stops and end.

use fil_machine::commons::Rel;
use fil_machine::cycle_kind::CycleKind;
use fil_machine::locations::{
    self as loc, ControlFamily, FixtureForm, ThreadCycle, ToolChangeStop,
};
use fil_machine::setting::CodeAt;
use fil_machine::user_blocks;

use super::{Due, Settings, due};
use crate::dialect::{self, Function};
use crate::motion::Spindle;
use crate::text::read_block;
use crate::verify::expected_step::{CoolantKind, End, SpindleRange};
use crate::work_offsets::{WORD_OFFSETS, numbered_offset, offset_in_tenths};

impl Settings<'_> {
    /// When a spindle word must be in force.
    pub fn spindle_due(&self) -> Due {
        due(self.commons.read(loc::SPINDLE_PLACEMENT))
    }

    /// When a coolant word must be in force.
    pub fn coolant_due(&self) -> Due {
        due(self.commons.read(loc::COOLANT_PLACEMENT))
    }

    /// What the spindle does for `SPINDL`; `None` where the machine has no code for it.
    pub fn spindle(&self, wanted: Option<Spindle>) -> Option<Spindle> {
        let code = |at: CodeAt| self.commons.read(at);
        match wanted {
            Some(Spindle::Off) => code(loc::SPINDLE_STOP_CODE).map(|_| Spindle::Off),
            Some(Spindle::Clockwise) => code(loc::SPINDLE_CW_CODE).map(|_| Spindle::Clockwise),
            Some(Spindle::Counterclockwise) => {
                code(loc::SPINDLE_CCW_CODE).map(|_| Spindle::Counterclockwise)
            }
            None => {
                let usual = code(loc::SPINDLE_DEFAULT_CODE)?;
                match () {
                    () if code(loc::SPINDLE_CW_CODE) == Some(usual) => Some(Spindle::Clockwise),
                    () if code(loc::SPINDLE_CCW_CODE) == Some(usual) => {
                        Some(Spindle::Counterclockwise)
                    }
                    () => None,
                }
            }
        }
    }

    fn spindle_ranges(&self) -> u8 {
        self.commons.int(loc::SPINDLE_RANGES).clamp(1, 6) as u8
    }

    /// Least and greatest speed of a spindle range, from 1.
    fn speeds_of(&self, range: u8) -> (f64, f64) {
        let (min, max) = loc::RANGE_SPEEDS[usize::from(range) - 1];
        let of = |at: Rel| self.commons.rel_opt(at);
        (of(min).unwrap_or(0.0), of(max).unwrap_or(f64::MAX))
    }

    /// A speed within a spindle range, or within all of them together.
    pub fn speed_within(&self, speed: f64, range: Option<u8>) -> f64 {
        let ranges = range.map_or(1..=self.spindle_ranges(), |range| range..=range);
        let speeds = || ranges.clone().map(|range| self.speeds_of(range));
        let given = |(min, _): &(f64, f64)| *min > 0.0;
        let low = speeds().filter(given).map(|(min, _)| min).reduce(f64::min);
        let high = speeds().map(|(_, max)| max).fold(0.0, f64::max);
        speed.max(low.unwrap_or(0.0)).min(high)
    }

    /// The spindle range that a record names, from 1; `None` for none of the machine.
    pub fn spindle_range(&self, named: SpindleRange) -> Option<u8> {
        let count = self.spindle_ranges();
        match named {
            SpindleRange::Low => Some(1),
            SpindleRange::Medium => Some(2).filter(|_| count == 3),
            SpindleRange::High => Some(count),
            SpindleRange::Number(number) => (1..=6).find(|range| f64::from(*range) == number),
        }
    }

    /// The range that a speed brings along while `now` is in force; `None` where the
    /// machine leaves ranges to SPINDL/RANGE.
    pub fn range_of_speed(&self, speed: f64, now: Option<u8>) -> Option<u8> {
        if !self.commons.read(loc::SPINDLE_AUTO_RANGE) {
            return None;
        }
        let count = self.spindle_ranges();
        let first = u8::try_from(self.commons.int(loc::SPINDLE_DEFAULT_RANGE)).ok();
        let first = now.or(first).filter(|first| (1..=count).contains(first));
        first.into_iter().chain(1..=count).find(|range| {
            let (min, max) = self.speeds_of(*range);
            (min..=max).contains(&speed)
        })
    }

    /// A coolant by its own kind, where the record names the machine's usual one at a
    /// pressure; `None` where the usual one has no pressures.
    fn own_kind(&self, kind: CoolantKind) -> Option<CoolantKind> {
        let code = |at: CodeAt| self.commons.read(at);
        let usual = code(loc::COOLANT_DEFAULT_CODE);
        let is = |at: CodeAt| usual.is_some() && code(at) == usual;
        let [flood, through] = match kind {
            CoolantKind::OnLow => [CoolantKind::FloodLow, CoolantKind::ThroughLow],
            CoolantKind::OnMedium => [CoolantKind::FloodMedium, CoolantKind::ThroughMedium],
            CoolantKind::OnHigh => [CoolantKind::FloodHigh, CoolantKind::Through],
            _ => return Some(kind),
        };
        match () {
            () if is(loc::COOLANT_FLOOD_CODE) => Some(flood),
            () if is(loc::COOLANT_THRU_HIGH_CODE) => Some(through),
            () => None,
        }
    }

    /// The code of a coolant; `None` where the machine has none.
    pub fn coolant_code(&self, kind: CoolantKind) -> Option<u32> {
        let at = match self.own_kind(kind)? {
            CoolantKind::Off => loc::COOLANT_OFF_CODE,
            CoolantKind::On | CoolantKind::OnLow | CoolantKind::OnMedium | CoolantKind::OnHigh => {
                loc::COOLANT_DEFAULT_CODE
            }
            CoolantKind::FloodMedium => loc::COOLANT_FLOOD_MEDIUM_CODE,
            CoolantKind::ThroughMedium => loc::COOLANT_THRU_MEDIUM_CODE,
            CoolantKind::Tap => loc::COOLANT_TAP_CODE,
            CoolantKind::Air => loc::COOLANT_AIR_CODE,
            CoolantKind::Flood => loc::COOLANT_FLOOD_CODE,
            CoolantKind::FloodHigh => loc::COOLANT_FLOOD_HIGH_CODE,
            CoolantKind::FloodLow => loc::COOLANT_FLOOD_LOW_CODE,
            CoolantKind::Mist => loc::COOLANT_MIST_CODE,
            CoolantKind::Through => loc::COOLANT_THRU_HIGH_CODE,
            CoolantKind::ThroughLow => loc::COOLANT_THRU_LOW_CODE,
        };
        // The tool must not run dry: the usual code stands for a pressure that the machine lacks.
        let usual = match at {
            loc::COOLANT_FLOOD_LOW_CODE
            | loc::COOLANT_FLOOD_MEDIUM_CODE
            | loc::COOLANT_FLOOD_HIGH_CODE => loc::COOLANT_FLOOD_CODE,
            loc::COOLANT_THRU_LOW_CODE | loc::COOLANT_THRU_MEDIUM_CODE => {
                loc::COOLANT_THRU_HIGH_CODE
            }
            at => at,
        };
        self.commons.read(at).or_else(|| self.commons.read(usual)).map(number)
    }

    /// Coolant and spindle end before a tool change and before the end of the program.
    pub fn switches_off_at_change(&self) -> bool {
        self.commons.read(loc::HOME_SWITCHES_OFF)
    }

    /// The functions that end coolant and spindle, as blocks.
    pub fn blocks_of_switching_off(&self) -> Vec<String> {
        let codes = [
            loc::COOLANT_OFF_CODE,
            loc::COOLANT_MIST_OFF_CODE,
            loc::COOLANT_THRU_OFF_CODE,
            loc::COOLANT_AIR_OFF_CODE,
            loc::COOLANT_TAP_OFF_CODE,
            loc::SPINDLE_STOP_CODE,
            loc::MILL_TURN_LIVE_STOP_CODE,
        ];
        let codes = codes.into_iter().filter_map(|at| self.commons.read(at));
        codes.map(|code| format!("M{code}")).collect()
    }

    /// The stop before each tool change but the first.
    pub fn stop_at_change(&self) -> Option<u32> {
        match self.commons.read(loc::TOOL_CHANGE_STOP) {
            ToolChangeStop::None => None,
            ToolChangeStop::OptionalStop => self.stop_code(true),
            ToolChangeStop::Stop => self.stop_code(false),
        }
    }

    /// The work offset that the first tool change chooses where no record has named one; `None`
    /// where no change says any.
    pub fn first_work_offset(&self) -> Option<u32> {
        let first = self.commons.int_opt(loc::FIXTURE_FIRST)?;
        self.work_offset(Some(f64::from(first)))
    }

    /// The work offset of SET/OFSETL as programs name it (see
    /// [`FrameModes::fixture`](crate::motion::Modes)); `None` where the machine has none.
    pub fn work_offset(&self, number: Option<f64>) -> Option<u32> {
        let code = |at: CodeAt| u32::try_from(self.commons.read(at)?).ok();
        let by_word = self.chooses_offsets_by_word();
        // A control with further offsets alone has no G54: its first one is meant.
        let is_empty = code(loc::FIXTURE_MAX_CODE) < code(loc::FIXTURE_MIN_CODE);
        let has_further = self.commons.int_opt(loc::FIXTURE_EXTENDED_CODE).is_some();
        let first = (is_empty && has_further && !by_word).then_some(1.0);
        let Some(number) = number.or(first) else {
            return code(loc::FIXTURE_DEFAULT_CODE).filter(|_| !by_word && !self.is_klartext());
        };
        let index = number as i64 + i64::from(self.commons.int_opt(loc::FIXTURE_BASE).unwrap_or(0));
        let index = u32::try_from(index).ok()?;
        if by_word || self.is_klartext() {
            return Some(WORD_OFFSETS + index);
        }
        if self.has_edges() {
            return match index {
                1..=4 => Some(53 + index),
                54..=57 | 505..=599 => Some(index),
                5..=99 => Some(500 + index),
                _ => None,
            };
        }
        let (first, last) = (code(loc::FIXTURE_MIN_CODE)?, code(loc::FIXTURE_MAX_CODE)?);
        let plain = (last + 1).checked_sub(first)?;
        if (1..=plain).contains(&index) {
            return Some(first + index - 1);
        }
        if (first..=last).contains(&index) {
            return Some(index);
        }
        match self.commons.int_opt(loc::FIXTURE_EXTENDED_CODE).filter(|tenths| *tenths > 0) {
            Some(tenths) => {
                let further = index.checked_sub(plain).filter(|further| *further > 0)?;
                Some(match self.commons.read(loc::FIXTURE_EXTENDED_ADDRESS) {
                    Some(_) => numbered_offset(tenths.unsigned_abs(), further),
                    None => offset_in_tenths(tenths.unsigned_abs() + further - 1),
                })
            }
            None => None,
        }
    }

    /// Feeds are written a minute, whatever mode they are asked for in.
    pub fn feeds_by_the_minute(&self) -> bool {
        self.is_klartext()
    }

    /// The control reads Klartext: rows of its table of presets are work offsets.
    pub(super) fn is_klartext(&self) -> bool {
        self.commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext
    }

    /// The first and the last function of work offsets; `None` where other words choose them.
    pub fn offset_functions(&self) -> Option<(u32, u32)> {
        let code = |at: CodeAt| u32::try_from(self.commons.read(at)?).ok();
        if self.chooses_offsets_by_word() || self.is_klartext() || self.has_edges() {
            return None;
        }
        code(loc::FIXTURE_MIN_CODE).zip(code(loc::FIXTURE_MAX_CODE))
    }

    /// A word chooses the work offset, and not a function.
    pub fn chooses_offsets_by_word(&self) -> bool {
        self.commons.read(loc::FIXTURE_FORM) == FixtureForm::Word
    }

    /// How far single moves come back above the last peck, mm.
    pub fn peck_gap(&self) -> f64 {
        self.commons.dbl_opt(loc::CYCLE_PECK_GAP).unwrap_or(0.0).max(0.0)
    }

    /// What a hole of this kind is in a cycle of the control: where `cycle.deep_code` names G73,
    /// DEEP breaks chips.
    pub fn kind_in_cycle(&self, kind: CycleKind) -> CycleKind {
        let tenths = self.commons.read(loc::CYCLE_DEEP_CODE).map(|code| i64::from(code) * 10);
        let function = tenths.and_then(|tenths| self.dialect.function(tenths));
        let breaks = matches!(function, Some(Function::Cycle(dialect::CycleKind::BreakChips, _)));
        if kind == CycleKind::Deep && breaks { CycleKind::Brkchp } else { kind }
    }

    /// The code of STOP or OPSTOP.
    pub fn stop_code(&self, optional: bool) -> Option<u32> {
        let at = if optional { loc::PROGRAM_OPSTOP_CODE } else { loc::PROGRAM_STOP_CODE };
        self.commons.read(at).map(number)
    }

    /// The code that locks the operator's feed override, or lets it act.
    pub fn override_lock(&self, on: bool) -> Option<u32> {
        let at = if on { loc::OVERRIDE_OFF_CODE } else { loc::OVERRIDE_ON_CODE };
        self.commons.read(at).map(number)
    }

    /// The code that brings the control into the mode of rigid taps.
    pub fn rigid_tap_mode(&self) -> Option<u32> {
        self.commons.read(loc::CYCLE_RIGID_TAP_MODE).map(number)
    }

    /// The code of the second spindle.
    pub fn side_spindle_code(&self, turn: Option<bool>) -> Option<u32> {
        let at = match turn {
            None => loc::SPINDLE_SIDE_STOP_CODE,
            Some(true) => loc::SPINDLE_SIDE_CW_CODE,
            Some(false) => loc::SPINDLE_SIDE_CCW_CODE,
        };
        self.commons.read(at).map(number)
    }

    /// The machine waits seconds only; a SINUMERIK counts turns too (`G4 S`).
    pub fn waits_seconds(&self) -> bool {
        if self.commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik {
            return false;
        }
        self.commons.dbl_opt(loc::DWELL_UPR_FACTOR).is_none_or(|factor| factor <= 0.0)
    }

    /// Way before its end on which a pass leaves a thread at 45 degrees, in leads.
    pub fn thread_chamfer(&self) -> f64 {
        self.commons.dbl_opt(loc::THREAD_CHAMFER).unwrap_or(0.0).max(0.0)
    }

    /// The codes that switch the way out of threads on and off.
    pub fn way_out_codes(&self) -> Option<[u32; 2]> {
        let on = self.commons.read(loc::THREAD_CHAMFER_ON_CODE).map(number)?;
        let off = self.commons.read(loc::THREAD_CHAMFER_OFF_CODE).map(number)?;
        Some([on, off])
    }

    /// How far from the crest the tool goes back from a thread, mm.
    pub fn thread_clearance(&self) -> f64 {
        self.commons.dbl_opt(loc::THREAD_CLEARANCE).unwrap_or(0.0)
    }

    /// Least that a pass of a thread goes deeper, mm.
    pub fn thread_least_depth(&self) -> f64 {
        self.commons.dbl_opt(loc::THREAD_LEAST_DEPTH).unwrap_or(0.0).max(0.0)
    }

    /// The cycle of all passes in one block leaves open how many of them lie at the root.
    pub fn leaves_springs_open(&self) -> bool {
        self.commons.read(loc::THREAD_CYCLE) == ThreadCycle::CycleOfAllPassesInOneBlock
    }

    /// The fewest passes at full depth after the last one that the machine's cycle can say.
    pub fn least_springs(&self) -> u32 {
        let cycle = self.commons.read(loc::THREAD_CYCLE);
        u32::from(cycle == ThreadCycle::CycleOfAllPassesInTwoBlocks)
    }

    /// Passes at full depth after the last one of a thread.
    pub fn thread_springs(&self) -> u32 {
        self.commons.int(loc::THREAD_SPRINGS).max(0).unsigned_abs()
    }

    /// The highest speed that the machine gives before a surface speed, rpm.
    pub fn surface_limit(&self) -> Option<f64> {
        self.commons.dbl_opt(loc::SPINDLE_CSS_LIMIT)
    }

    /// A surface speed begins behind the approach, which turns at rev/min.
    pub fn leads_in_by_turns(&self) -> bool {
        self.commons.read(loc::SPINDLE_CSS_LEAD_IN)
    }

    /// The highest speed stands in the block of the surface speed.
    pub fn limit_comes_with_surface(&self) -> bool {
        self.commons.read(loc::SPINDLE_MAX_ADDRESS).is_some()
    }

    /// The code that makes the main spindle the axis C, or a spindle again.
    pub fn spindle_mode_code(&self, mills: bool) -> Option<u32> {
        let at = if mills { loc::MILL_TURN_MILLING_CODE } else { loc::MILL_TURN_TURNING_CODE };
        self.commons.read(at).map(number)
    }

    /// The code of CLAMP.
    pub fn clamp_code(&self, on: bool) -> Option<u32> {
        let at = if on { loc::ROTARY_CLAMP_CODE } else { loc::ROTARY_UNCLAMP_CODE };
        self.commons.read(at).map(number)
    }

    /// The code that ends the program.
    pub fn end_code(&self, end: End) -> Option<u32> {
        let code = |at: CodeAt| self.commons.read(at).map(number);
        match end {
            End::Stay => code(loc::PROGRAM_END_CODE),
            End::Rewind => code(loc::PROGRAM_REWIND_CODE),
            End::By(code) => Some(code),
            End::OfFile => code(loc::PROGRAM_REWIND_CODE).or(code(loc::PROGRAM_END_CODE)),
        }
    }

    /// The codes that end a program on this machine: its own, and those of ISO 6983.
    pub fn end_codes(&self) -> Vec<u32> {
        let own = [loc::PROGRAM_REWIND_CODE, loc::PROGRAM_END_CODE];
        let own = own.into_iter().filter_map(|at| self.commons.read(at).map(number));
        own.chain([2, 30]).collect()
    }

    /// True when the start of the program has an S word.
    pub fn has_speed_at_start(&self) -> bool {
        user_blocks::START.read(self.commons).iter().any(|block| {
            read_block(block.as_bytes(), "settings", 1)
                .is_ok_and(|block| block.word(b'S').is_some())
        })
    }

    /// The limit of surface speed that the start of the program sets, rpm.
    pub fn speed_limit_at_start(&self) -> Option<f64> {
        let code = i64::from(self.commons.read(loc::SPINDLE_MAX_CODE).map(number)?);
        let of_block = |block: String| {
            let block = read_block(block.as_bytes(), "settings", 1).ok()?;
            let limits = block.words.iter().any(|word| {
                word.letter == b'G' && word.number.digits == code && word.number.decimals == 0
            });
            block.word(b'S').filter(|_| limits).map(|word| word.number.value())
        };
        user_blocks::START.read(self.commons).into_iter().filter_map(of_block).next_back()
    }

    /// True when the program must end with a code.
    pub fn has_end_code(&self) -> bool {
        let codes = [loc::PROGRAM_REWIND_CODE, loc::PROGRAM_END_CODE];
        codes.iter().any(|at| self.commons.read(*at).is_some())
    }
}

/// The number of a function.
fn number(code: i32) -> u32 {
    code.unsigned_abs()
}
