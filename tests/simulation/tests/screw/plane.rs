//! Balls beside the plane of the axis, where no wall is undercut.

use filpost_simulation::screw::section::Section;
use filpost_simulation::screw::{Job, helix, passes, random};

use filpost_tests::root;

use super::{post, sections};

/// Deepest that a ball may cut below the section: what the script leaves, and the rounding of
/// three words.
const DEEPEST: f64 = 0.0015;

/// The undercut of finishing, or what is wrong.
fn prove(job: &Job, nc: &str) -> Result<f64, String> {
    let made = passes::read(job, nc)?;
    let undercut = helix::undercut(job, &made, true, 0.005);
    if undercut > DEEPEST {
        return Err(format!("undercut {undercut:.4}"));
    }
    if !helix::reaches(job, &made, job.finish + 0.001, 0.05) {
        return Err("a scallop in space is too high".to_string());
    }
    Ok(undercut)
}

/// The groove of the page, whose ball of 8 undercuts up to 0.76 mm in the plane of the axis.
fn upright(pitch: f64) -> Job {
    let walls = [[0.0, 25.0], [0.0, 15.0], [16.0, 15.0], [16.0, 25.0]];
    let mut job = Job::new(Section::rounded(&walls, &[5.0, 5.0]), pitch);
    job.cutters.retain(|cutter| cutter.number == 3 || cutter.diameter == 8.0 && cutter.ball);
    job.plane = true;
    job
}

#[test]
fn the_ball_of_the_page_undercuts_nothing() {
    for pitch in [16.0, 20.0, 30.0, 40.0] {
        let job = upright(pitch);
        let (nc, warnings) = post(&job).expect("the job is made");
        prove(&job, &nc).unwrap_or_else(|fault| panic!("{pitch}: {fault}\n{nc}"));
        let said = warnings.iter().any(|it| it.to_string().contains("finishing undercuts"));
        assert!(!said, "{pitch}: {warnings:?}");
    }
}

/// Beside the plane on the wrong side the ball cuts deeper than in it.
#[test]
fn the_side_is_the_right_one() {
    let job = upright(30.0);
    let (nc, _) = post(&job).expect("the job is made");
    let other = nc.replace(" Y-", " Y+").replace(" Y", " Y-").replace(" Y-+", " Y");
    assert_ne!(nc, other);
    let made = passes::read(&job, &other).expect("the passes are read");
    assert!(helix::undercut(&job, &made, true, 0.005) > 0.2);
}

/// Each start has the passes of the first, a share of the pitch aside.
#[test]
fn starts_repeat_the_groove() {
    for (name, section) in sections() {
        for left in [false, true] {
            // Sharp corners are left to balls.
            let finish = if name == "trapezoid" { 0.3 } else { 0.05 };
            let one = Job { left, finish, ..Job::new(section.clone(), 90.0) };
            let three = Job { starts: 3, ..one.clone() };
            let [one, three] = [one, three].map(|job| {
                let (nc, _) = post(&job).unwrap_or_else(|error| panic!("{name}: {error}"));
                let made =
                    passes::read(&job, &nc).unwrap_or_else(|it| panic!("{name}: {it}\n{nc}"));
                (job, made)
            });
            assert_eq!(three.1.len(), 3 * one.1.len(), "{name}");
            for ball in [false, true] {
                let of = |(job, made): &(Job, Vec<passes::Pass>)| {
                    let is = |pass: &&passes::Pass| {
                        job.cutter(pass.tool).is_some_and(|cutter| cutter.ball == ball)
                    };
                    let place = |pass: &passes::Pass| pass.place(job);
                    made.iter().filter(is).map(place).collect::<Vec<[f64; 2]>>()
                };
                let (one, three) = (of(&one), of(&three));
                for (index, [x, z]) in three.into_iter().enumerate() {
                    let start = index / one.len();
                    let wanted = one[index % one.len()];
                    let aside = x + 30.0 * start as f64 - wanted[0];
                    assert!(aside.abs() < 0.0016 && z == wanted[1], "{name} {index}: {aside}");
                }
            }
        }
    }
}

#[test]
fn random_jobs_undercut_nothing_or_are_refused() {
    let count = filpost_simulation::jobs("FILPOST_SCREWS", 50);
    let mut dice = random::Dice::new(filpost_simulation::seed(3));
    let [mut made, mut refused] = [0; 2];
    let mut deepest: f64 = 0.0;
    let mut jobs: Vec<Job> =
        sections().into_iter().map(|(_, section)| Job::new(section, 24.0)).collect();
    jobs.extend((0..count).map(|_| random::job(&mut dice)));
    let mut faults = Vec::new();
    for (index, job) in jobs.iter().enumerate() {
        let job = Job { plane: true, ..job.clone() };
        match post(&job) {
            Ok((nc, _)) => match prove(&job, &nc) {
                Ok(undercut) => {
                    made += 1;
                    deepest = deepest.max(undercut);
                }
                Err(fault) => faults.push(format!("job {index}: {fault}\n{}{nc}", job.cl())),
            },
            Err(error) => {
                let error = error.to_string();
                let known = [
                    "no ball of the list does",
                    "leaves a corner uncut",
                    "no end mill of the",
                    "the allowance fills the groove",
                ];
                if known.iter().any(|text| error.contains(text)) {
                    refused += 1;
                } else {
                    faults.push(format!("job {index}: {error}\n{}", job.cl()));
                }
            }
        }
    }
    let first = faults.first().map_or("", String::as_str);
    assert!(faults.is_empty(), "{} of {} are wrong: {first}", faults.len(), jobs.len());
    let row = format!("| {} | {made} | {refused} | {:.1} |\n", jobs.len(), 1000.0 * deepest);
    println!("{row}");
    if [50, 500].contains(&count) && !filpost_simulation::is_seeded() {
        let page = std::fs::read_to_string(root().join("docs/papers/screw.md")).expect("the page");
        assert!(page.contains(&row), "{row}");
    }
}
