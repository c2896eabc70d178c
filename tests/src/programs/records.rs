//! CL files for the programs.

use super::Dice;

/// A CL file of a few records; the last one is FINI.
pub(super) fn file(dice: &mut Dice<'_>) -> String {
    let mut out = String::new();
    for _ in 0..4 + dice.below(14) {
        let number = format!("{}.{}", dice.below(40), dice.below(1000));
        let word = dice.pick(&["DRILL", "DEEP", "TAP", "OFF"]);
        out += &match dice.below(12) {
            0..=2 => format!("GOTO / {number}, -{number}, {}", dice.below(9)),
            3 => format!("FROM / {number}, 0, 1"),
            4 | 5 => format!("CYCLE / {word}, DEPTH, {number}"),
            6 => format!("SPINDL / RPM, {number}, {}", dice.pick(&["CLW", "CCLW"])),
            7 => format!("COOLNT / {}", dice.pick(&["ON", "OFF", "MIST"])),
            8 => format!("FEDRAT / {number}, MMPM"),
            9 => "RAPID".to_string(),
            10 => format!("MODE / {}", dice.pick(&["MILL", "TURN"])),
            _ => format!("ENGRAV / {}, {number}", dice.pick(&["WAVY", "PLAIN"])),
        };
        out.push('\n');
    }
    out + "FINI\n"
}
