//! G words: which number stands for which function.

use std::collections::HashMap;

use fil_machine::osp_lengths;

use super::Settings;
use super::codes::{CycleKind, FeedMode, Function};
use super::tables::RETURNS_BY_LEVEL;
use crate::motion::Compensation;
use crate::work_offsets::offset_in_tenths;

/// G words by their numbers in tenths.
#[derive(Clone, Debug)]
pub(super) struct Functions(HashMap<i64, Function>);

/// Kinds of cycles in the settings, and what they do where the number of their code
/// is not one of [`STANDARD_CYCLES`].
const CYCLES: &[(&str, CycleKind)] = &[
    ("cycle.drill_code", CycleKind::Drill),
    ("cycle.csink_code", CycleKind::Drill),
    ("cycle.thru_code", CycleKind::Drill),
    ("cycle.face_code", CycleKind::Drill),
    ("cycle.deep_code", CycleKind::Peck),
    ("cycle.brkchp_code", CycleKind::BreakChips),
    ("cycle.tap_code", CycleKind::Tap),
    ("cycle.tap_left_code", CycleKind::TapLeft),
    ("cycle.ream_code", CycleKind::FeedOut),
    ("cycle.bore_code", CycleKind::StopOut),
    ("cycle.mill_code", CycleKind::FeedOut),
];

/// Settings of the cycles of rigid taps, in tenths.
const RIGID_TAPS: [(&str, CycleKind); 2] =
    [("cycle.rigid_tap_code", CycleKind::Tap), ("cycle.rigid_tap_left_code", CycleKind::TapLeft)];

/// What the numbers of ISO 6983 and of Fanuc's mills do. A control that has cycles
/// has these, whatever its post writes.
const STANDARD_CYCLES: &[(i32, CycleKind)] = &[
    (73, CycleKind::BreakChips),
    (74, CycleKind::TapLeft),
    (76, CycleKind::StopOut),
    (81, CycleKind::Drill),
    (82, CycleKind::Drill),
    (83, CycleKind::Peck),
    (84, CycleKind::Tap),
    (85, CycleKind::FeedOut),
    (86, CycleKind::StopOut),
    (89, CycleKind::FeedOut),
];

/// Cycles that pass over a dwell: those of Fanuc's mills.
const WITHOUT_DWELL: [i32; 5] = [73, 81, 83, 85, 86];

fn dwells(code: i32) -> bool {
    !WITHOUT_DWELL.contains(&code)
}

/// Cycles of live tools: their settings, Fanuc's numbers on a lathe, along X or not, and what
/// they do. A drilling cycle with pecks is a matter of a parameter.
const LIVE_CYCLES: &[(&str, Option<i32>, bool, CycleKind)] = &[
    ("mill_turn.face_drill_code", Some(83), false, CycleKind::Drill),
    ("mill_turn.side_drill_code", Some(87), true, CycleKind::Drill),
    ("mill_turn.face_tap_code", Some(84), false, CycleKind::Tap),
    ("mill_turn.side_tap_code", Some(88), true, CycleKind::Tap),
    ("mill_turn.face_tap_left_code", None, false, CycleKind::TapLeft),
    ("mill_turn.side_tap_left_code", None, true, CycleKind::TapLeft),
];

/// Functions that each control of this family has and no setting names.
const STANDARD: &[(i32, Function)] = &[
    (28, Function::Reference),
    (30, Function::NumberedReference),
    (53, Function::MachineFrame),
    (9, Function::PathControl),
    (61, Function::PathControl),
    (64, Function::PathControl),
];

/// G61.1: an exact stop, or smoothing.
const PATH_CONTROL_IN_TENTHS: i64 = 611;

/// Settings that name codes of tool-tip control, in tenths.
const TIP_CODES: [(&str, Function); 2] = [
    ("rotary.tip_code", Function::TipControl),
    ("rotary.vector_code", Function::TipControlByDirection),
];

/// Tool-tip control of the controls that take up the tool length by `G43`, in tenths.
const TIP_CONTROL: [(i64, Function); 2] =
    [(434, Function::TipControl), (435, Function::TipControlByDirection)];

impl Functions {
    pub(super) fn new(settings: &Settings, lathe: bool, has_rotary: bool) -> Self {
        let mut table = Functions(HashMap::new());
        for (key, function) in named() {
            table.add(settings.code(key), function);
        }
        if !lathe || settings.code("mode.position").is_some() {
            for (key, absolute) in [("mode.absolute_code", true), ("mode.incremental_code", false)]
            {
                table.add(settings.code(key), Function::Positions { absolute });
            }
        }
        if lathe {
            table.add_threads(settings);
        }
        table.add_cycles(settings);
        table.add_fixtures(settings);
        if settings.code("tool.length_code").is_some() {
            table.add(Some(49), Function::Length(false));
        }
        if osp_lengths::are_meant(settings.0) {
            table.add(Some(16), Function::EndOfTravel);
        }
        if has_rotary && !lathe && settings.code("tool.length_code") == Some(43) {
            table.0.extend(TIP_CONTROL);
            for (name, function) in TIP_CODES {
                if let Some(tenths) = settings.code(name).filter(|code| *code > 0) {
                    table.0.insert(i64::from(tenths), function);
                }
            }
        }
        for (code, function) in STANDARD {
            table.add(Some(*code), *function);
        }
        table.0.entry(PATH_CONTROL_IN_TENTHS).or_insert(Function::PathControl);
        if has_rotary && !lathe {
            table.add_tilts(settings);
        }
        if settings.code("mill_turn.milling_code").is_some() {
            table.add_interpolations(settings);
        }
        table
    }

    /// Tilted frames: those that the settings name, and the usual ones.
    fn add_tilts(&mut self, settings: &Settings) {
        let code = |key, usual: i64| settings.code(key).map_or(usual, i64::from);
        let frame = match settings.code("rotary.frame_form") {
            Some(1) => Function::TiltByAxes,
            _ => Function::Tilt,
        };
        let tilts = [
            (code("rotary.frame_code", 682), frame),
            (code("rotary.frame_align_code", 531), Function::AlignTool),
            (code("rotary.frame_cancel_code", 69) * 10, Function::TiltOff),
        ];
        for (tenths, function) in tilts {
            self.0.entry(tenths).or_insert(function);
        }
    }

    /// What a live tool mills by where the spindle is the axis C.
    fn add_interpolations(&mut self, settings: &Settings) {
        let named = [
            ("mill_turn.polar_code", Function::Polar(true)),
            ("mill_turn.polar_end_code", Function::Polar(false)),
            ("mill_turn.cylinder_code", Function::Cylinder),
        ];
        for (key, function) in named {
            if let Some(tenths) = settings.code(key).filter(|code| *code > 0) {
                self.0.entry(i64::from(tenths)).or_insert(function);
            }
        }
        for (key, usual, side, kind) in LIVE_CYCLES {
            let code = settings.code(key).or(*usual);
            self.add(code, Function::LiveCycle { side: *side, kind: *kind });
        }
        self.add(Some(80), Function::CycleOff);
    }

    /// A code that two settings name stays with the first of them.
    fn add(&mut self, code: Option<i32>, function: Function) {
        if let Some(code) = code {
            self.0.entry(i64::from(code) * 10).or_insert(function);
        }
    }

    /// The threading cycles: Fanuc's, unless the settings name those of another control.
    fn add_threads(&mut self, settings: &Settings) {
        let code = settings.code("thread.cycle_code");
        match settings.code("thread.cycle") {
            Some(4) => self.add(code, Function::ThreadPassesByPitch),
            Some(6) => {
                self.add(code, Function::ThreadPass);
                self.add(Some(71), Function::ThreadPassesByHeight);
            }
            Some(1) if code.is_some_and(|code| code != 92) => {
                self.add(code, Function::ThreadPass);
            }
            _ => {
                self.add(Some(92), Function::ThreadPass);
                self.add(Some(76), Function::ThreadPasses);
            }
        }
    }

    fn add_cycles(&mut self, settings: &Settings) {
        let standard = |code: i32| STANDARD_CYCLES.iter().find(|row| row.0 == code);
        let mut any = false;
        for (key, kind) in CYCLES {
            let Some(code) = settings.code(key) else { continue };
            // A machine without a tapping cycle has none for left-hand threads either.
            if *kind == CycleKind::TapLeft && settings.code("cycle.tap_code").is_none() {
                continue;
            }
            any = true;
            let kind = standard(code).map_or(*kind, |row| row.1);
            self.add(Some(code), Function::Cycle(kind, dwells(code)));
        }
        if !any {
            return;
        }
        self.add(settings.code("cycle.off_code"), Function::CycleOff);
        for (key, kind) in RIGID_TAPS {
            if let Some(tenths) = settings.code(key).filter(|code| *code >= 0) {
                self.0.entry(i64::from(tenths)).or_insert(Function::Cycle(kind, true));
            }
        }
        for (code, kind) in STANDARD_CYCLES {
            self.add(Some(*code), Function::Cycle(*kind, dwells(*code)));
        }
        if settings.code("cycle.return_codes") == Some(RETURNS_BY_LEVEL) {
            return self.add(Some(71), Function::ReturnTo);
        }
        for (key, initial) in
            [("cycle.return_initial_code", true), ("cycle.return_clear_code", false)]
        {
            self.add(settings.code(key), Function::Return { initial });
        }
    }

    fn add_fixtures(&mut self, settings: &Settings) {
        let ends = [settings.code("fixture.min_code"), settings.code("fixture.max_code")];
        if let [Some(first), Some(last)] = ends {
            // Settings that begin below G54 make no offsets of what moves the zero by its words and
            // of the frame of the machine.
            for code in (first..=last).take(100).filter(|code| !matches!(code, 52 | 53)) {
                self.add(Some(code), Function::Fixture(code.unsigned_abs()));
            }
        }
        let tenths =
            settings.code("fixture.extended_code").and_then(|code| u32::try_from(code).ok());
        let count = settings.code("fixture.extended_count").unwrap_or(0).unsigned_abs();
        let has_letter = settings.code("fixture.extended_address").is_some();
        let is_new = |functions: &mut Self, tenths: u32, function| {
            functions.0.entry(i64::from(tenths)).or_insert(function);
        };
        match tenths {
            Some(tenths) if has_letter => is_new(self, tenths, Function::NumberedFixture(tenths)),
            // G59.1, G59.2 and so on, codes of their own.
            Some(first) => (first..first.saturating_add(count)).for_each(|tenths| {
                is_new(self, tenths, Function::Fixture(offset_in_tenths(tenths)));
            }),
            None => {}
        }
    }

    /// A code stands for this function.
    pub(super) fn holds(&self, function: Function) -> bool {
        self.0.values().any(|found| *found == function)
    }

    pub(super) fn get(&self, tenths: i64) -> Option<Function> {
        self.0.get(&tenths).copied()
    }

    /// The plane that a setting names by its code; XY when it names none.
    pub(super) fn plane(&self, code: Option<i32>) -> usize {
        match code.and_then(|code| self.get(i64::from(code) * 10)) {
            Some(Function::Plane(normal)) => normal,
            _ => 2,
        }
    }

    /// The feed mode that a setting names by its code; a minute when it names none.
    pub(super) fn feed_mode(&self, code: Option<i32>) -> FeedMode {
        match code.and_then(|code| self.get(i64::from(code) * 10)) {
            Some(Function::Feed(mode)) => mode,
            _ => FeedMode::PerMinute,
        }
    }
}

/// Settings that name the code of a function.
fn named() -> [(&'static str, Function); 26] {
    use Function as F;
    [
        ("rapid.code_xy", F::Rapid),
        ("rapid.code_z", F::Rapid),
        ("rotary.rapid_code", F::Rapid),
        ("linear.code", F::Linear),
        ("circle.cw_code", F::Arc { ccw: false }),
        ("circle.ccw_code", F::Arc { ccw: true }),
        ("thread.code", F::Thread),
        ("thread.varying_code", F::VaryingThread),
        ("dwell.code", F::Dwell),
        ("circle.plane_xy", F::Plane(2)),
        ("circle.plane_zx", F::Plane(1)),
        ("circle.plane_yz", F::Plane(0)),
        ("units.inch_code", F::Units { metric: false }),
        ("units.metric_code", F::Units { metric: true }),
        ("feed.upm_code", F::Feed(FeedMode::PerMinute)),
        ("feed.upr_code", F::Feed(FeedMode::PerTurn)),
        ("feed.inverse_code", F::Feed(FeedMode::Inverse)),
        ("cutcom.left_code", F::Compensation(Compensation::Left)),
        ("cutcom.right_code", F::Compensation(Compensation::Right)),
        ("cutcom.off_code", F::Compensation(Compensation::Off)),
        ("tool.length_code", F::Length(true)),
        ("tool.length_cancel_code", F::Length(false)),
        ("spindle.css_code", F::Surface(true)),
        ("spindle.rpm_code", F::Surface(false)),
        ("spindle.max_code", F::SpeedLimit),
        ("lathe.diameter_code", F::Diameter),
    ]
}
