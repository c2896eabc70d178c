//! Parts that lean so far that their sections are ellipses: what a search for the least
//! reading leaves, alone and with the diameter, and what four touches leave.

use std::fs;

use filpost_simulation::runout::{
    Cylinder, Probe, Random, Residual, SECTIONS, Search, TURNS, cl_file, positions, residual, tool,
};
use filpost_tests::root;

use super::{ON, five_axes, post, run, script, text};

/// Degrees of lean: the run-out of the paper, half the bound of the script, and its bound.
const TILTS: [f64; 3] = [0.1, 0.5, 0.99];
/// Parts of each lean.
const POSES: usize = 50;
const DIAMETER: &str = "RUNOUT / DIAMTR, 100\nRUNOUT / TOLER, 0.001\nRUNOUT / ON";

/// A part that leans by a number of degrees to any side, with its axis up to 0.2 mm
/// from the table axis in the middle.
fn leaning(tilt: f64, random: &mut Random) -> Cylinder {
    let (sine, cosine) = (random.unit() * 180.0_f64.to_radians()).sin_cos();
    let [x, y] = [0.2 * random.unit(), 0.2 * random.unit()];
    let [bottom, middle, top] = TURNS;
    let at = |z: f64| {
        let by = (z - middle) * tilt.to_radians().tan();
        [x + by * cosine, y + by * sine]
    };
    Cylinder::through(at(bottom), at(top))
}

/// The worst of all poses, and the worst at the ends of blocks alone; readings are exact.
fn worst(tilt: f64, search: Search, on: &str) -> (Residual, f64) {
    let mut at_ends: f64 = 0.0;
    let post = post(&five_axes(), &script());
    let mut random = Random(tilt.to_bits());
    let mut worst = Residual::default();
    for _ in 0..POSES {
        let cylinder = leaning(tilt, &mut random);
        let mut probe = Probe { noise: 0.0, random: Random(0), search };
        let sections = SECTIONS.map(|height| probe.section(&cylinder, height));
        let nc = run(&post, &cl_file(&sections, on)).expect("the path is posted");
        worst = worst.worse(residual(&nc, &cylinder));
        for axes in positions(&nc) {
            at_ends = at_ends.max(cylinder.deviation(&tool(&axes).0).abs());
        }
    }
    (worst, at_ends)
}

/// The table of the page; the ellipse is taken out to a micron.
#[test]
fn the_page_shows_what_the_ellipse_leaves() {
    let page = fs::read_to_string(root().join("docs/papers/run-out.md")).expect("the page");
    let mut lacking = Vec::new();
    for tilt in TILTS {
        let all = [
            worst(tilt, Search::Least, ON),
            worst(tilt, Search::Least, DIAMETER),
            worst(tilt, Search::BothEnds, ON),
            worst(tilt, Search::FourTouches, ON),
        ];
        for (left, at_ends) in &all[1..] {
            assert!(left.radial < 0.001 && *at_ends < 0.0005, "{tilt}: {left:?} {at_ends}");
        }
        let cells = all.map(|(left, _)| format!("{:.1}", left.run_out * 1000.0)).join(" | ");
        let row = format!("| {tilt} | {cells} |");
        if !page.contains(&row) {
            lacking.push(row);
        }
    }
    assert!(lacking.is_empty(), "the page lacks\n{}", lacking.join("\n"));
}

/// The diameter is right for a large part as well, and refused where it tells nothing.
#[test]
fn a_correction_that_does_not_settle_is_refused() {
    let cl = |diameter: &str, sections: &str| {
        let on = format!("{sections}RUNOUT / DIAMTR, {diameter}\nRUNOUT / ON");
        cl_file(&[], &on)
    };
    let near = "RUNOUT / PROBE, 1, ZCOORD, 20, MIN, 49.9, CMIN, 200, MAX, 50.1, CMAX, 20\n\
                RUNOUT / PROBE, 2, ZCOORD, 30, MIN, 49.9, CMIN, 250, MAX, 50.1, CMAX, 70\n";
    let post = post(&five_axes(), &script());
    for (diameter, sections, sentence) in [
        ("4000", near, "the sections are too near to each other for RUNOUT/DIAMTR"),
        ("0.2", near, "section 1: the run-out is larger than RUNOUT/DIAMTR"),
        ("0", near, "RUNOUT/DIAMTR needs a diameter above 0"),
        ("-5", near, "RUNOUT/DIAMTR needs a diameter above 0"),
        (
            "100",
            &near.replace("CMAX, 70", "CMAX, 71"),
            "section 2: with RUNOUT/DIAMTR CMAX is half a turn from CMIN",
        ),
    ] {
        let error = run(&post, &cl(diameter, sections)).expect_err(sentence);
        let said = error.diags()[0].message.clone();
        assert!(said.starts_with(sentence), "{diameter}: {said}");
    }
    run(&post, &cl("100", near)).expect("it settles");
}

/// A sign, a factor or a place that is wrong in the correction leaves more than it.
#[test]
fn mutations_of_the_correction_are_found() {
    for (from, to) in [
        ("ROASID = -2*", "ROASID = 2*"),
        ("ROASID = -2*", "ROASID = -1*"),
        ("ROCY*ROAX-ROCX*ROAY", "ROCY*ROAX+ROCX*ROAY"),
        ("ROCX*ROAX+ROCY*ROAY", "ROCX*ROAX-ROCY*ROAY"),
        ("ROHALF(ROI)*ROCX - ROASID*ROCY", "ROHALF(ROI)*ROCX + ROASID*ROCY"),
        ("ROHALF(ROI)*ROCY + ROASID*ROCX", "ROHALF(ROI)*ROCY"),
        ("ROQ = RODIA/2/", "ROQ = RODIA/"),
    ] {
        let mutated = text("fil-scripts/papers/run-out.fil").replace(from, to);
        assert_ne!(mutated, script(), "{from} is not in the script");
        let post = post(&five_axes(), &mutated);
        let mut random = Random(7);
        let shows = (0..20).any(|_| {
            let cylinder = leaning(0.99, &mut random);
            let mut probe = Probe { noise: 0.0, random: Random(0), search: Search::Least };
            let sections = SECTIONS.map(|height| probe.section(&cylinder, height));
            run(&post, &cl_file(&sections, DIAMETER))
                .map_or(true, |nc| residual(&nc, &cylinder).radial > 0.001)
        });
        assert!(shows, "{from} became {to}, and nothing shows it");
    }
}
