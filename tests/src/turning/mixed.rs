//! What may stand between the statements of a program for a lathe or a mill-turn machine, in any
//! mixture: texts and functions that change modes or move the machine, frames, skipped blocks,
//! threads, modes and spindles.

use crate::five_axes::maker::Line;
use crate::five_axes::numbers::Random;
use crate::random::lathe_make;
use crate::random::verdict::cl_text;

use super::part::Part;

/// Texts that an operator would write by hand on a lathe of words of a letter and a number.
const TEXTS: [&str; 38] = [
    "G4 P500",
    "M8",
    "M9",
    "M5",
    "M1",
    "M3",
    "M4",
    "S900",
    "G96 S150",
    "G97 S800",
    "G50 S2000",
    "G90",
    "G94",
    "G95",
    "G98",
    "G99",
    "G17",
    "G18",
    "G54",
    "G55",
    "G40",
    "G80",
    "F0.2",
    "(HELLO)",
    "G0 X200.",
    "G0 Z200.",
    "G0 X5.",
    "G1 Z150. F0.5",
    "G28 U0 W0",
    "T0505",
    "G91",
    "G20",
    "M30",
    "G32 Z-5. F1.",
    "C90.",
    "M13",
    "G12.1",
    "G13.1",
];

/// The same of a SINUMERIK.
const SINUMERIK: [&str; 30] = [
    "G4 F1",
    "M8",
    "M9",
    "M5",
    "M1",
    "M3",
    "M4",
    "S900",
    "G96 S150",
    "G97 S800",
    "LIMS=2000",
    "G90",
    "G94",
    "G95",
    "G17",
    "G18",
    "G54",
    "G55",
    "G40",
    "; HELLO",
    "G0 X200",
    "G0 Z200",
    "G0 X5",
    "G1 Z150 F0.5",
    "D2",
    "G91",
    "G700",
    "DIAMOF",
    "TRAFOOF",
    "SPOS=0",
];

/// Statements, some of them several in a row; lengths are of no unit.
const PLAIN: [&str; 62] = [
    "TRANS / 0, 0, 5",
    "TRANS / 2, 0, 0",
    "TRANS / NOMORE",
    "OPSKIP / ON",
    "OPSKIP / OFF",
    "STOP",
    "OPSTOP",
    "SPINDL / OFF",
    "SPINDL / ON",
    "SPINDL / RPM, 700, CLW",
    "SPINDL / RPM, 700, CCLW",
    "SPINDL / RPM, 700, CLW, SIDE",
    "SPINDL / SMM, 150, CLW, MAXRPM, 2000",
    "SPINDL / SFM, 500, CCLW, MAXRPM, 1800",
    "SPINDL / MAXRPM, 1500",
    "COOLNT / OFF",
    "COOLNT / FLOOD",
    "AUXFUN / 8",
    "AUXFUN / 5",
    "PREFUN / 55",
    "PREFUN / 18",
    "PREFUN / 97",
    "GOHOME",
    "RETRCT",
    "FROM / 100, 0, 100",
    "SET / OFSETL, 2",
    "CLAMP / ON",
    "CLAMP / OFF",
    "ROTABL / 90",
    "DELAY / 0.5",
    "DELAY / REV, 5",
    "FEDRAT / 0.2, MMPR",
    "FEDRAT / 120, MMPM",
    "FEDRAT / 0.01, IPR",
    "REPEAT / ALL, NEXT",
    "PPRINT / HELLO",
    "LOADTL / 1",
    "LOADTL / 4",
    "LOADTL / 4, OSETNO, 5",
    "TURRET / 6",
    "CYCLE / OFF",
    "CUTCOM / OFF",
    "CUTCOM / LEFT",
    "CUTCOM / RIGHT",
    "MODE / MILL",
    "MODE / TURN",
    "MULTAX / ON",
    "MULTAX / OFF",
    "THREAD / OFF",
    "THREAD / MMPR, 1.5",
    "THREAD / TPI, 12",
    "RAPID",
    "RAPID; GOTO / 40, 0, 5",
    "RAPID; GOTO / 60, 0, 60",
    "GOTO / 25, 0, 4; CIRCLE / 22, 0, 4, 0, 1, 0, 3; GOTO / 22, 0, 7",
    "GODLTA / 0.5, 0, 0",
    "GODLTA / 0, 0, 2",
    "RAPID; GOTO / 0, 0, 5; CYCLE / DRILL, DEPTH, 6, MMPR, 0.1, CLEAR, 2; GOTO / 0, 0, 0; CYCLE / OFF",
    "RAPID; GOTO / 0, 0, 5; CYCLE / TAP, DEPTH, 6, MMPR, 1, CLEAR, 3; GOTO / 0, 0, 0; CYCLE / OFF",
    "SPINDL / RPM, 400, CLW; RAPID; GOTO / 20, 0, 5; THREAD / AUTO, 15, 0, 5, TO, 15, 0, -20, MMPR, \
     1.5, DEEP, 0.2, LAST, 1, TYPE, 0, 0.9, 60, FEDTO, 1, OUT; RAPID; GOTO / 20, 0, 5",
    "SPINDL / RPM, 300, CCLW; RAPID; GOTO / 20, 0, 5; OP / THREAD, TURN, DEPTH, 1, MMPR, 2, CUTS, 5, \
     FINCUT, 1; GOTO / 18, 0, 5; GOTO / 18, 0, -15; RAPID; GOTO / 20, 0, 5",
    "SPINDL / RPM, 300, CLW; RAPID; GOTO / 30, 0, 5; THREAD / MMPR, 2; GOTO / 14, 0, 5; \
     GOTO / 14, 0, -9; GOTO / 30, 0, -9; THREAD / OFF; RAPID; GOTO / 30, 0, 5",
];

/// A program of a seed for a ready post, mixed up.
pub fn program(ready: &str, seed: u64, random: &mut Random) -> Vec<Line> {
    let by_statements = ready.starts_with("sinumerik");
    let base = match ready.ends_with("mill-turn") && random.happens(0.7) {
        true => Part::of_machine(seed, !by_statements),
        false => cl_text(&lathe_make::program(seed)),
    };
    let texts: &[&str] = if by_statements { &SINUMERIK } else { &TEXTS };
    let often = random.between(0.0, 0.15);
    let (mut lines, mut has_unit) = (Vec::new(), false);
    for line in base.lines() {
        lines.push(line.to_string());
        has_unit |= line.starts_with("UNITS");
        while has_unit && line != "FINI" && random.happens(often) {
            match random.happens(0.3) {
                true => lines.push(format!("INSERT / {}", texts[random.below(texts.len())])),
                false => {
                    let said = PLAIN[random.below(PLAIN.len())];
                    lines.extend(said.split("; ").map(str::to_string));
                }
            }
        }
    }
    lines.into_iter().map(|text| Line { text, target: None }).collect()
}
