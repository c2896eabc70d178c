//! Programs of `fil-scripts/papers/screw.fil` proved by simulation: the NC text is
//! read back and its passes are swept over the section of the groove, in the plane of
//! the axis and in space.

use std::io::Cursor;

use filpost::{Diag, Error, Post, files, includes};
use filpost_tests::root;
use filpost_tests::screw::section::{Section, Step};
use filpost_tests::screw::{Job, helix, passes, sweep};

/// The NC program of a job and the warnings.
fn post(job: &Job) -> Result<(String, Vec<Diag>), Error> {
    let script = root().join("fil-scripts/papers/screw.fil");
    let machine = root().join("corpus/papers/screw-trapezoid/machine.toml");
    let text = |path: &std::path::Path| files::read_text(path, None).expect("the file is read");
    let mut post = Post::builder()
        .machine("machine.toml", &text(&machine))
        .fil(&script.to_string_lossy(), &text(&script))
        .includes(includes::beside(&[script], None))
        .cl_name("screw.ncl")
        .build()?;
    let mut nc = Vec::new();
    let report = post.run(Cursor::new(job.cl()), &mut nc)?;
    Ok((String::from_utf8(nc).expect("NC is text"), report.warnings))
}

/// The undercuts a run warns of: roughing, finishing, mm.
fn warned(warnings: &[Diag]) -> [f64; 2] {
    ["roughing", "finishing"].map(|name| {
        let found = warnings.iter().map(ToString::to_string).find(|text| text.contains(name));
        let size = found.and_then(|text| {
            let rest = text.split_once("undercuts the wall by ")?.1;
            rest.split_whitespace().next()?.parse().ok()
        });
        size.unwrap_or(0.0)
    })
}

/// Sections of all kinds on a blank of 50 mm.
fn sections() -> Vec<(&'static str, Section)> {
    let trapezoid = [[0.0, 25.0], [6.0, 18.0], [16.0, 18.0], [22.0, 25.0]];
    let uneven = [[1.0, 25.0], [3.0, 17.0], [12.0, 16.0], [15.0, 16.0], [24.0, 25.0]];
    let upright = [[0.0, 25.0], [0.0, 17.0], [18.0, 17.0], [18.0, 25.0]];
    let lips = [[-1.0, 25.0], [1.0, 25.0], [3.0, 18.0], [16.0, 18.0], [20.0, 25.0], [22.0, 25.0]];
    vec![
        ("trapezoid", Section::rounded(&trapezoid, &[0.0, 0.0])),
        ("trapezoid with fillets", Section::rounded(&trapezoid, &[4.0, 4.0])),
        ("uneven", Section::rounded(&uneven, &[5.0, 0.0, 3.0])),
        ("upright walls", Section::rounded(&upright, &[4.0, 6.0])),
        ("rounded lips", Section::rounded(&lips, &[1.0, 3.0, 5.0, 1.5])),
        ("round bottom", round_bottom()),
    ]
}

/// An arc of radius 8 with its lowest point at Z 18.
fn round_bottom() -> Section {
    let centre = [8.0, 26.0];
    let half = (64.0_f64 - 1.0).sqrt();
    let to = [centre[0] + half, 25.0];
    Section { from: [centre[0] - half, 25.0], steps: vec![Step::Arc { to, centre, hollow: true }] }
}

/// Proves one job: its passes, what they leave and cut, the choice of the cutters, and
/// the undercut it warns of.
fn prove(name: &str, job: &Job) {
    let (nc, warnings) = post(job).unwrap_or_else(|error| panic!("{name}: {error}\n{}", job.cl()));
    let made = passes::read(job, &nc).unwrap_or_else(|error| panic!("{name}: {error}"));
    let report = sweep::check(job, &made).unwrap_or_else(|error| panic!("{name}: {error}\n{}\n{nc}", job.cl()));
    let said = warned(&warnings);
    let true_cut = [false, true].map(|ball| helix::undercut(job, &made, ball, 0.02));
    println!("{name}: {} passes, {report:.4?}, undercut {true_cut:.4?} said {said:?}", made.len());
    for (found, said) in true_cut.iter().zip(said) {
        assert!((found - said).abs() < 0.002, "{name}: undercut {true_cut:?}, said {said:?}");
    }
}

#[test]
fn programs_leave_and_cut_what_they_may() {
    for (name, section) in sections() {
        let mut job = Job::new(section, 30.0);
        job.finish = if name == "trapezoid" { 0.3 } else { 0.05 };
        prove(name, &job);
    }
}
