//! A hole of the control's cycle and the same hole as single moves: the same motions,
//! dwells and turns of the spindle, for each kind of cycle that single moves can make.

use fil_nc::motion::{Course, Event, Spindle};
use filpost::Program;
use filpost_tests::back_check;
use proptest::prelude::*;

/// Codes of the kinds of cycles. Bore and ream come out at feed, as single moves do.
const CODES: [(&str, &str); 8] = [
    ("cycle.drill_code", "81"),
    ("cycle.csink_code", "82"),
    ("cycle.deep_code", "83"),
    ("cycle.brkchp_code", "73"),
    ("cycle.bore_code", "89"),
    ("cycle.ream_code", "89"),
    ("cycle.face_code", "82"),
    ("cycle.thru_code", "81"),
];

const KINDS: [&str; 8] = ["DRILL", "CSINK", "DEEP", "BRKCHP", "BORE", "REAM", "FACE", "THRU"];

/// How far the pecks of the interpreter's cycles come back, mm; that of single moves is
/// set to the same.
const PECK_GAP: &str = "cycle.peck_gap=0.254";

/// Largest deviation treated as equal, mm, mm/min and seconds.
const SAME: f64 = 1e-6;

/// What a machine does.
#[derive(Clone, Copy, Debug)]
enum Act {
    Moves { course: Course, to: [f64; 3], rate: f64, spindle: Spindle },
    Dwells(f64),
}

impl Act {
    fn is_as(&self, other: &Act) -> bool {
        match (self, other) {
            (
                Act::Moves { course, to, rate, spindle },
                Act::Moves { course: course2, to: to2, rate: rate2, spindle: spindle2 },
            ) => {
                let near = to.iter().zip(to2).all(|(one, two)| (one - two).abs() < SAME);
                near && course == course2 && spindle == spindle2 && (rate - rate2).abs() < SAME
            }
            (Act::Dwells(one), Act::Dwells(two)) => (one - two).abs() < SAME,
            _ => false,
        }
    }
}

/// What the program of a machine with or without cycles does.
fn acts(cl: &str, cycles: bool, more: &[String]) -> (String, Vec<Act>) {
    let mut builder = Program::builder().generic("fanuc-mill").set("units.mode=2").set(PECK_GAP);
    for (key, code) in CODES {
        builder = builder.set(&format!("{key}={}", if cycles { code } else { "none" }));
    }
    for setting in more {
        builder = builder.set(setting);
    }
    let post = builder.build().expect("a machine");
    let mut nc = Vec::new();
    post.stream(cl.as_bytes(), &mut nc).unwrap_or_else(|error| panic!("{cl}\n{error}"));
    let nc = String::from_utf8(nc).expect("a program in ASCII");
    let events = back_check::events(post.commons(), &nc).unwrap_or_else(|diag| {
        panic!("{nc}\n{}", diag.message);
    });
    let acts = events.iter().filter_map(|event| match event {
        Event::Move(found) => {
            let rate = found.rate.map_or(0.0, |rate| match rate {
                fil_nc::motion::Rate::PerMinute(rate) => rate,
                other => panic!("{other:?}"),
            });
            let (course, to) = (found.course, found.to.linear);
            Some(Act::Moves {
                course,
                to: [to[0], to[1], to[2]],
                rate,
                spindle: found.modes.spindle.turn,
            })
        }
        Event::Dwell { seconds, .. } => Some(Act::Dwells(seconds.unwrap_or(0.0))),
        _ => None,
    });
    let acts = acts.collect();
    (nc, acts)
}

#[derive(Clone, Debug)]
struct Cycle {
    kind: usize,
    depth: u32,
    clear: u32,
    step: u32,
    dwell: u32,
    /// 0: none; 1: to the level before; above: that many mm.
    back: u32,
    holes: Vec<(i32, i32, i32)>,
}

impl Cycle {
    fn statements(&self) -> String {
        let milli = |value: u32| f64::from(value) / 1000.0;
        let kind = KINDS[self.kind];
        let mut text = format!(
            "CYCLE / {kind}, DEPTH, {}, MMPM, 80, CLEAR, {}",
            milli(self.depth),
            milli(self.clear)
        );
        if matches!(kind, "DEEP" | "BRKCHP") {
            text.push_str(&format!(", STEP, {}", milli(self.step)));
        }
        if self.dwell > 0 {
            text.push_str(&format!(", DWELL, {}", f64::from(self.dwell) / 10.0));
        }
        match self.back {
            0 => {}
            1 => text.push_str(", RETURN, 0"),
            level => text.push_str(&format!(", RETURN, {level}")),
        }
        text.push('\n');
        for (x, y, z) in &self.holes {
            text.push_str(&format!("GOTO / {x}, {y}, {z}\n"));
        }
        text.push_str("CYCLE / OFF\n");
        text
    }
}

fn cycle() -> impl Strategy<Value = Cycle> {
    let holes = prop::collection::vec((-50..50i32, -50..50i32, -5..6i32), 1..4);
    (0..KINDS.len(), 1..40_000u32, 0..6000u32, 100..9000u32, 0..8u32, 0..20u32, holes).prop_map(
        |(kind, depth, clear, step, dwell, back, holes)| Cycle {
            kind,
            depth,
            clear,
            step: step.max(depth / 60),
            dwell,
            back,
            holes,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn cycles_and_single_moves_are_the_same_motions(
        cycles in prop::collection::vec(cycle(), 1..4),
        start in 1..60i32,
        form in 1..4u32,
        split in 0..2u32,
    ) {
        let mut cl = format!("SPINDL / RPM, 900, CLW\nRAPID\nGOTO / 0, 0, {start}\n");
        for cycle in &cycles {
            cl.push_str(&cycle.statements());
        }
        cl.push_str("FINI\n");
        let more = [format!("cycle.depth_output={form}"), format!("rapid.split={split}")];
        let (with, cycles) = acts(&cl, true, &more);
        let (without, single) = acts(&cl, false, &more);
        let same = cycles.len() == single.len()
            && cycles.iter().zip(&single).all(|(one, two)| one.is_as(two));
        let first = cycles.iter().zip(&single).position(|(one, two)| !one.is_as(two));
        let differ = first.map(|at| (cycles[at], single[at]));
        prop_assert!(same, "{cl}\n{with}\n{without}\n{first:?} {differ:?}");
    }
}

/// Single moves can't keep a tap in step with the spindle.
#[test]
fn a_tap_is_never_single_moves() {
    let builder = Program::builder().generic("fanuc-mill").set("units.mode=2");
    let post = builder.set("cycle.tap_code=none").build().expect("a machine");
    let cl = "SPINDL/RPM,500,CLW\nRAPID\nGOTO/0,0,10\nCYCLE/TAP,DEPTH,8,MMPR,1,CLEAR,2\nGOTO/0,0,0\nFINI\n";
    let refused = post.stream(cl.as_bytes(), Vec::new()).expect_err("refused");
    assert_eq!(refused.diags()[0].code.name(), "E0507");
}
