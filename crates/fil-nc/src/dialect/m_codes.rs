//! M words: which number stands for which auxiliary function.

use std::collections::HashMap;

use super::Settings;
use super::codes::Auxiliary;
use super::tables::RETURNS_BY_LEVEL;
use crate::motion::Spindle;

/// Settings that name the code of a coolant, and the one that ends it where that is not
/// `coolant.off_code`.
const COOLANTS: [(&str, Option<&str>); 11] = [
    ("coolant.flood_medium_code", None),
    ("coolant.thru_medium_code", Some("coolant.thru_off_code")),
    ("coolant.tap_code", Some("coolant.tap_off_code")),
    ("coolant.air_code", Some("coolant.air_off_code")),
    ("coolant.flood_code", None),
    ("coolant.mist_code", Some("coolant.mist_off_code")),
    ("coolant.default_code", None),
    ("coolant.flood_high_code", None),
    ("coolant.flood_low_code", None),
    ("coolant.thru_high_code", Some("coolant.thru_off_code")),
    ("coolant.thru_low_code", Some("coolant.thru_off_code")),
];

/// M words by their numbers.
#[derive(Clone, Debug)]
pub(super) struct Auxiliaries(HashMap<i64, Auxiliary>);

impl Auxiliaries {
    pub(super) fn new(settings: &Settings) -> Self {
        use Auxiliary as A;
        let named = [
            ("spindle.cw_code", A::Clockwise),
            ("spindle.ccw_code", A::Counterclockwise),
            ("spindle.stop_code", A::SpindleOff),
            ("spindle.orient_code", A::Orient),
            ("spindle.range1_code", A::SpindleRange(1)),
            ("spindle.range2_code", A::SpindleRange(2)),
            ("spindle.range3_code", A::SpindleRange(3)),
            ("spindle.range4_code", A::SpindleRange(4)),
            ("spindle.range5_code", A::SpindleRange(5)),
            ("spindle.range6_code", A::SpindleRange(6)),
            ("mill_turn.live_cw_code", A::Live(Spindle::Clockwise)),
            ("mill_turn.live_ccw_code", A::Live(Spindle::Counterclockwise)),
            ("mill_turn.live_stop_code", A::Live(Spindle::Off)),
            ("tool.change_code", A::ToolChange),
        ];
        // A turret turns by its T word: what else that function does nobody knows.
        let by_word = matches!(settings.code("tool.format"), Some(2 | 3));
        let mut table = HashMap::new();
        for (key, auxiliary) in named {
            if by_word && auxiliary == A::ToolChange {
                continue;
            }
            if let Some(code) = settings.code(key) {
                table.entry(i64::from(code)).or_insert(auxiliary);
            }
        }
        let modes = [("mill_turn.milling_code", true), ("mill_turn.turning_code", false)];
        for (key, on) in modes {
            if let Some(code) = settings.code(key) {
                table.entry(i64::from(code)).or_insert(A::CAxis(on, code.unsigned_abs()));
            }
        }
        let choices = [("spindle.side_master_code", true), ("spindle.main_master_code", false)];
        for (code, side) in choices.map(|(key, side)| (settings.code(key), side)) {
            if let Some(code) = code {
                table.entry(i64::from(code)).or_insert(A::Counts(side));
            }
        }
        let of_side = [
            ("spindle.side_cw_code", Spindle::Clockwise),
            ("spindle.side_ccw_code", Spindle::Counterclockwise),
            ("spindle.side_stop_code", Spindle::Off),
        ];
        let is_counted = settings.code("spindle.side_master_code").is_some();
        for (key, turn) in of_side.into_iter().filter(|_| is_counted) {
            if let Some(code) = settings.code(key) {
                table.entry(i64::from(code)).or_insert(A::Side(turn));
            }
        }
        let number = |key| settings.code(key).map(i32::unsigned_abs);
        let usual = number("coolant.off_code");
        for (key, own) in COOLANTS {
            let off = own.and_then(number).or(usual);
            if let Some(code) = number(key) {
                table.entry(i64::from(code)).or_insert(A::Coolant { code, off });
            }
            if let Some(off) = off {
                table.entry(i64::from(off)).or_insert(A::CoolantOff(off));
            }
        }
        let ends = ["program.end_code", "program.rewind_code"].map(|key| settings.code(key));
        for code in ends.into_iter().flatten().chain([2, 30]) {
            table.entry(i64::from(code)).or_insert(A::End(code.unsigned_abs()));
        }
        for (code, auxiliary) in [(98, A::Call), (99, A::Back)] {
            table.entry(code).or_insert(auxiliary);
        }
        for code in [96, 97, 198] {
            table.entry(code).or_insert(A::Flow);
        }
        if settings.code("cycle.return_codes") == Some(RETURNS_BY_LEVEL) {
            table.entry(53).or_insert(A::Returns { to_level: true });
            table.entry(54).or_insert(A::Returns { to_level: false });
        }
        Auxiliaries(table)
    }

    pub(super) fn get(&self, code: i64) -> Auxiliary {
        self.0.get(&code).copied().unwrap_or(Auxiliary::Other(code as u32))
    }
}
