//! Turning by `fil-stock` on random jobs, judged by samples of their paths, and on cuts whose volume is known.

use std::f64::consts::PI;

use filpost::plot::Text;
use filpost::stock::{Job, Left, Offsets, Simulated, Stock, Tool, Tools};
use filpost::{Levels, Program};
use filpost_simulation::turning::{Sample, Turned};
use filpost_simulation::{jobs, seed};

const BORE: f64 = 6.0;
const OUTSIDE: f64 = 20.0;
const LENGTH: f64 = 50.0;

/// What a finding may be off by, mm.
const MARGIN: f64 = 0.08;

fn simulated(program: &str, tools: &Tools, stock: &str) -> Simulated {
    let commons = Program::builder().generic("fanuc-lathe").build_machine().expect("a lathe");
    let levels = Levels::default();
    let job = Job {
        stock: &Stock::read(stock).expect("stock").expect("stock"),
        tools,
        part: None,
        part_tolerance: 0.05,
        grid: Some(0.25),
        levels: &levels,
        offsets: &Offsets::new(),
    };
    let nc = Text { name: "job.nc", bytes: program.as_bytes() };
    filpost::simulate::program(nc, &commons, &job)
        .unwrap_or_else(|error| panic!("{error}\n{program}"))
}

#[test]
fn random_jobs_turn_and_find_what_samples_do() {
    let mut counts = [0; 2];
    for number in 0..jobs("FILPOST_STOCK_JOBS", 12) {
        let sample = Sample::new(seed(number as u64 + 7), [BORE, OUTSIDE, LENGTH]);
        let tools: Tools = (1..)
            .zip(&sample.tools)
            .map(|(number, edge)| (number, Tool::read(&edge.description()).expect("a tool")))
            .collect();
        let done = simulated(&sample.program, &tools, "tube 40x12x50");
        let Left::Profile(profile) = &done.left else { panic!("a lathe") };
        let middles = (0..profile.disks().len()).map(|disk| profile.middle(disk)).collect();
        let mut judge = Turned::new(middles, [BORE, OUTSIDE]);
        for motion in &sample.motions {
            let [must, may] = judge.cut(motion, &sample.tools[motion.tool], MARGIN);
            let code = match (motion.rapid, motion.turning) {
                (true, _) => "E0971",
                (false, false) => "E0973",
                (false, true) => continue,
            };
            let mut found = done.report.findings.iter().filter(|found| found.code.name() == code);
            let is_found =
                found.any(|found| found.line <= motion.line && motion.line <= found.last);
            assert!(
                (!must || is_found || done.report.more > 0) && (may || !is_found),
                "job {number}: {code} at line {} is {is_found}, must {must}, may {may}\n{}\n{:#?}",
                motion.line,
                sample.program,
                done.report.findings
            );
            counts[0] += usize::from(must);
            counts[1] += usize::from(!may);
        }
        for (disk, (found, judged)) in profile.disks().iter().zip(&judge.disks).enumerate() {
            // Where nothing is left, both radii are one, wherever it is.
            if found[0] >= found[1] || judged[0][1] >= judged[1][0] {
                continue;
            }
            for (radius, [least, most]) in found.iter().zip(judged) {
                assert!(
                    least - 1e-3 <= *radius && *radius <= most + 1e-3,
                    "job {number}, Z{}: {radius} is not between {least} and {most}\n{}",
                    profile.middle(disk),
                    sample.program
                );
            }
        }
    }
    println!("must and must not: {counts:?}");
    assert!(counts.iter().all(|count| *count >= 5), "too few cases: {counts:?}");
}

/// The volume that blocks remove with one tool.
fn removed(blocks: &str, tool: &str, stock: &str) -> f64 {
    let program =
        format!("G21 G99 G18 G40\nT0101\nG97 S900 M3\nG0 X100. Z20.\n{blocks}\nG0 Z20.\nM30\n");
    let tools = Tools::from([(1, Tool::read(tool).expect("a tool"))]);
    let done = simulated(&program, &tools, stock);
    assert!(done.report.findings.is_empty(), "{:?}", done.report.findings);
    assert!((done.report.stock - done.left.volume() - done.report.total()).abs() < 0.05);
    done.report.total()
}

#[test]
fn simple_cuts_have_their_volume() {
    let ring = |outer: f64, inner: f64| PI * (outer * outer - inner * inner);
    let cone = |height: f64, radius: f64| PI * radius * radius * height / 3.0;
    let point = 5.0 / (59f64).to_radians().tan();
    let cuts = [
        // Turned down, faced, grooved, bored, drilled.
        ("G0 X36. Z2.\nG1 Z-20. F0.2\nX46.", "Q3A0.01", "cylinder 40x50", ring(20.0, 18.0) * 20.0),
        ("G0 X46. Z-1.\nG1 X0. F0.2", "Q3A0.01", "cylinder 40x50", ring(20.0, 0.0) * 1.0),
        ("G0 X46. Z-10.\nG1 X30. F0.1\nG1 X46.", "Q3W3", "cylinder 40x50", ring(20.0, 15.0) * 3.0),
        ("G0 X16. Z2.\nG1 Z-10. F0.1\nX10.", "Q2A0.01", "tube 40x12x50", ring(8.0, 6.0) * 10.0),
        (
            "G0 X0. Z2.\nG1 Z-20. F0.1",
            "D10A118",
            "cylinder 40x50",
            PI * 25.0 * (20.0 - point) + cone(point, 5.0),
        ),
    ];
    for (blocks, tool, stock, volume) in cuts {
        let found = removed(blocks, tool, stock);
        assert!((found - volume).abs() < volume * 0.005 + 1.0, "{blocks}: {found}, not {volume}");
    }
}
