//! The measuring program of the script, run by a control that knows neither the script nor the
//! post: what it prints is taken in again, and what is left of the run-out is measured.

use std::fs;

use filpost::Program;
use filpost_simulation::runout::macro_b::Control;
use filpost_simulation::runout::{Random, Residual, cl_file, residual};
use filpost_tests::posting::with_script;

use super::{NOISE, PLACINGS, five_axes, poses, post, run, script};

/// Poses of each placing that are measured so.
const MEASURED: usize = 40;

/// The CL file of the measuring program; `step` is what the search adds to its record.
fn measuring(step: &str) -> String {
    let section = |number: usize, height: f64| {
        format!(
            "RUNOUT / MEASUR, {number}, ZCOORD, {height}, DIAMTR, 100, CLEAR, 5, OVER, 3, $\n\
             FEDRAT, 50{step}\n"
        )
    };
    let sections = section(1, 20.0) + &section(2, 80.0);
    format!(
        "PARTNO / MEASURE\nUNITS / MM\nMULTAX / ON\nRAPID\nGOTO / 60, 0, 150, 1, 0, 0\n\
         {sections}FINI\n"
    )
}

/// The worst that is left of all poses, after readings wrong by at most `noise`.
fn left(step: &str, noise: f64, on: &str) -> Residual {
    let program = run(&post(&five_axes(), &script()), &measuring(step)).expect("it is posted");
    let mut worst = Residual::default();
    for placing in PLACINGS {
        for (seed, cylinder) in poses(placing).take(MEASURED) {
            let mut control = Control::new(&cylinder, noise, Random(7000 + seed));
            control.run(&program);
            assert_eq!(control.touches, if step.is_empty() { 12 } else { 724 });
            let folder = tempfile::tempdir().expect("a folder");
            fs::write(folder.path().join("run-out.txt"), format!("%\n{}%\n", control.printed))
                .expect("the readings are written");
            let machine = five_axes();
            let builder = Program::builder().machine("machine.toml", &machine);
            let builder = with_script(builder, "run-out.fil", &script()).grant_read(folder.path());
            let post = builder.build().expect("the post is made");
            let cl = cl_file(&[], &format!("RUNOUT / READ\n{on}"));
            let nc = run(&post, &cl).unwrap_or_else(|it| panic!("{it}: {}", control.printed));
            worst = worst.worse(residual(&nc, &cylinder));
        }
    }
    worst
}

#[test]
fn four_touches_leave_what_the_page_says() {
    let exact = left("", 0.0, super::ON);
    assert!(exact.run_out < 0.0006, "{exact:?}");
    let noisy = left("", NOISE, super::ON_NOISY);
    assert!(noisy.run_out < 0.0045, "{noisy:?}");
    println!(
        "measured: left {:.4} of exact readings, {:.4} with noise",
        exact.run_out, noisy.run_out
    );
}

/// The search of the paper brings 0.2 mm within what the paper reports only without noise.
#[test]
fn the_search_of_the_paper_is_worse() {
    let rough = left(", STEP, 1", NOISE, super::ON_NOISY);
    assert!((0.008..0.04).contains(&rough.run_out), "{rough:?}");
    println!("measured by search: left {:.4}", rough.run_out);
}
