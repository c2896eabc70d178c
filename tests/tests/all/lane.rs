//! Runs of points at one feed take a shorter way through the post. Where a FIL file has a section
//! the post goes the long way each time: the blocks, and what made each of their words, are the same.

use filpost::{Block, Program};
use filpost_tests::plausible::{self, LATHES, MILLS};
use filpost_tests::programs::Dice;

/// A section that takes no record of these files.
const BARS: &str = "$$ filpost: allow-file W0218, W0244, W0313\nCIMFIL/ON,MCHTOL\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";

/// CL files that are posted by each machine.
const FILES: u64 = 12;

/// What may come between two points, and changes what the next one needs.
const BETWEEN: &[&str] = &[
    "RAPID",
    "FEDRAT / 350.5, MMPM",
    "FEDRAT / 0.2, MMPR",
    "FEDRAT / INVERS, AUTO",
    "SPINDL / OFF",
    "SPINDL / RPM, 900, CLW",
    "SPINDL / RPM, 900, CCLW",
    "COOLNT / ON",
    "COOLNT / OFF",
    "LOADTL / 9",
    "CUTCOM / LEFT",
    "CUTCOM / OFF",
    "CYCLE / DRILL, 5, 100, MMPM, 2",
    "CYCLE / OFF",
    "CIRCLE / 0, 0, 0, 0, 0, 1, 10\nGOTO / 10, 0, 0",
    "TRANS / 1, 2, 3",
    "ROTABL / ATANGL, 30",
    "DELAY / 1.5",
    "STOP",
    "OPSTOP",
    "PPRINT / A TEXT",
    "INSERT / G91",
    "INSERT / G0 X1.",
    "INSERT / M3 S100",
    "PREFUN / 61",
    "AUXFUN / 8",
    "OPSKIP / ON",
    "OPSKIP / OFF",
    "SEQNO / OFF",
    "SEQNO / 100, INCR, 5",
    "MULTAX / ON",
    "REPEAT / P, 3",
    "GODLTA / 0.5, 0, 0",
    "GOHOME",
    "FROM / 0, 0, 50",
    "SET / OFSETL, 2",
    "LINTOL / 0.1",
    "END",
    "$$-> CSYS / 1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0",
    "GOTO / 1, 2, 3, 0, 0, 1",
    "GOTO / 1, 2, 3, 0, 0.6, 0.8",
    "GOTO / 123456789, 0, 0",
    "GOTO / 4, 4, 4\nGOTO / 4, 4, 4",
];

/// A CL file with more points in a row and with other statements between them.
fn varied(cl: &str, dice: &mut Dice<'_>) -> String {
    let mut text = String::new();
    for line in cl.lines() {
        text.push_str(line);
        text.push('\n');
        if !line.starts_with("GOTO") {
            continue;
        }
        for _ in 0..dice.below(4) {
            let [x, y, z] = [0; 3].map(|_| dice.between(-20.0, 20.0));
            text.push_str(&format!("GOTO / {x:.3}, {y:.3}, {z:.4}\n"));
            if dice.once_in(80) {
                text.push_str(&format!("{}\n", dice.pick(BETWEEN)));
            }
        }
    }
    text
}

/// The blocks up to an error, and the error.
fn blocks(program: &Program, cl: &str) -> (Vec<Block>, Option<String>) {
    let mut done = Vec::new();
    for block in program.blocks(cl.as_bytes()) {
        match block {
            Ok(block) => done.push(block),
            Err(error) => return (done, Some(error.to_string())),
        }
    }
    (done, None)
}

#[test]
fn points_in_a_row_are_posted_as_each_alone() {
    let (mut posted, mut refused) = (0, 0);
    for (number, name) in MILLS.iter().chain(LATHES).enumerate() {
        let machine = || Program::builder().generic(name);
        let program = machine().build().expect("a machine");
        let barred = machine().fil("bars.fil", BARS).build().expect("a script");
        for seed in 0..FILES {
            let mut dice = Dice::from_seed(1000 * number as u64 + seed);
            let cl = if LATHES.contains(name) {
                plausible::turned(seed)
            } else {
                plausible::milled(seed)
            };
            let cl = varied(&cl, &mut dice);
            let found = blocks(&program, &cl);
            assert_eq!(found, blocks(&barred, &cl), "{name}, seed {seed}:\n{cl}");
            *(if found.1.is_none() { &mut posted } else { &mut refused }) += 1;
        }
    }
    assert!(posted > 10 && refused > 10, "{posted} posted, {refused} refused");
}

#[test]
fn each_statement_between_points_is_taken_up_by_the_next() {
    let points = |first: u32| -> String {
        (first..first + 4).map(|x| format!("GOTO / {x}, 1, 0\n")).collect()
    };
    for name in ["linuxcnc-mill", "fanuc-mill", "okuma-mill", "fanuc-lathe", "sinumerik-840d"] {
        let machine = || Program::builder().generic(name);
        let program = machine().build().expect("a machine");
        let barred = machine().fil("bars.fil", BARS).build().expect("a script");
        for (number, first) in BETWEEN.iter().enumerate() {
            for second in [BETWEEN[(number * 7 + 3) % BETWEEN.len()], first, "RAPID"] {
                let cl = format!(
                    "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 800, CLW\nFEDRAT / 200, MMPM\n{}{first}\n{}{second}\n{}FINI\n",
                    points(1),
                    points(11),
                    points(21)
                );
                assert_eq!(blocks(&program, &cl), blocks(&barred, &cl), "{name}:\n{cl}");
            }
        }
    }
}
