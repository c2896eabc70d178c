//! Programs of `fil-scripts/papers/screw.fil` proved by simulation: the NC text is
//! read back and its passes are swept over the section of the groove, in the plane of
//! the axis and in space.

use std::io::Cursor;

use filpost::{Diag, Error, Program, check, files, includes};
use filpost_simulation::screw::mutate::{self, Mutation};
use filpost_simulation::screw::passes::Pass;
use filpost_simulation::screw::section::{Section, Step};
use filpost_simulation::screw::{Job, drawing, helix, passes, sweep};
use filpost_tests::{examples, root};

/// The NC program of a job and the warnings.
fn post(job: &Job) -> Result<(String, Vec<Diag>), Error> {
    let script = root().join("fil-scripts/papers/screw.fil");
    let machine = root().join("corpus/papers/screw-trapezoid/machine.toml");
    let text = |path: &std::path::Path| files::read_text(path, None).expect("the file is read");
    let post = Program::builder()
        .machine("machine.toml", &text(&machine))
        .fil(&script.to_string_lossy(), &text(&script))
        .includes(includes::beside(&[script], None))
        .build()?;
    let mut nc = Vec::new();
    let report = post.start().cl_name("screw.ncl").run(Cursor::new(job.cl()), &mut nc)?;
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
    let shelf = [[0.0, 25.0], [1.0, 22.1], [5.0, 22.1], [7.0, 17.0], [16.0, 17.0], [20.0, 25.0]];
    vec![
        ("trapezoid", Section::rounded(&trapezoid, &[0.0, 0.0])),
        ("trapezoid with fillets", Section::rounded(&trapezoid, &[4.0, 4.0])),
        ("uneven", Section::rounded(&uneven, &[5.0, 0.0, 3.0])),
        ("upright walls", Section::rounded(&upright, &[4.0, 6.0])),
        ("rounded lips", Section::rounded(&lips, &[1.0, 3.0, 5.0, 1.5])),
        ("shelf", Section::rounded(&shelf, &[3.0, 1.0, 3.0, 5.0])),
        ("round bottom", round_bottom()),
    ]
}

/// An arc of radius 8 with its lowest point at Z 18.
fn round_bottom() -> Section {
    let center = [8.0, 26.0];
    let half = (64.0_f64 - 1.0).sqrt();
    let to = [center[0] + half, 25.0];
    Section { from: [center[0] - half, 25.0], steps: vec![Step::Arc { to, center, hollow: true }] }
}

/// Proves one job: its passes, what they leave and cut, the choice of the cutters, and
/// the undercut it warns of.
fn prove(name: &str, job: &Job, nc: &str, warnings: &[Diag]) -> Proof {
    let fail = |what: String| -> ! { panic!("{name}: {what}\n{}\n{nc}", job.cl()) };
    let made = passes::read(job, nc).unwrap_or_else(|error| fail(error));
    let report = sweep::check(job, &made).unwrap_or_else(|error| fail(error));
    for found in [sweep::check_levels(job, &made), choice(job, &made)] {
        found.unwrap_or_else(|error| fail(error));
    }
    let undercut = [false, true].map(|ball| helix::undercut(job, &made, ball, 0.002));
    let said = warned(warnings);
    if undercut.iter().zip(said).any(|(found, said)| (found - said).abs() > 0.0021) {
        fail(format!("undercut {undercut:?}, said {said:?}"));
    }
    if !helix::reaches(job, &made, job.finish + 0.001, 0.05) {
        fail("a scallop in space is too high".to_string());
    }
    Proof { passes: made, report, undercut }
}

/// What a proof found.
struct Proof {
    passes: Vec<Pass>,
    report: sweep::Report,
    undercut: [f64; 2],
}

/// The cutters are the largest of the list that the section allows.
fn choice(job: &Job, made: &[Pass]) -> Result<(), String> {
    let used = |ball: bool| {
        let cutters = made.iter().filter_map(|pass| job.cutter(pass.tool));
        cutters.filter(|cutter| cutter.ball == ball).map(|cutter| cutter.diameter).next()
    };
    let larger = |ball: bool, than: f64| {
        let list = job.cutters.iter().filter(move |cutter| cutter.ball == ball);
        list.map(|cutter| cutter.diameter).filter(move |diameter| *diameter > than)
    };
    if let Some(mill) = used(false) {
        let mills = made.iter().filter(|pass| job.cutter(pass.tool).is_some_and(|c| !c.ball));
        let lowest = mills.map(|pass| pass.from[1]).fold(f64::INFINITY, f64::min);
        // A µm higher a level between fillets is up to 0.15 mm wider.
        let width = sweep::width(job, lowest + 0.001) - 0.15;
        if let Some(fits) = larger(false, mill).find(|diameter| *diameter < width) {
            return Err(format!("an end mill of {fits} fits the width {width} too"));
        }
    }
    let ball = used(true).ok_or("no ball")?;
    if let Some(fits) = larger(true, ball).find(|d| reached(job, *d, -0.01)) {
        return Err(format!("a ball of {fits} reaches everything too"));
    }
    if reached(job, ball, 0.01) { Ok(()) } else { Err("the ball leaves a corner".to_string()) }
}

fn reached(job: &Job, diameter: f64, more: f64) -> bool {
    sweep::ball_reaches(&job.section, diameter / 2.0, job.finish + more)
}

#[test]
fn programs_leave_and_cut_what_they_may() {
    for (name, section) in sections() {
        for pitch in [25.0, 40.0, 90.0] {
            let mut job = Job::new(section.clone(), pitch);
            job.finish = if name == "trapezoid" { 0.3 } else { 0.05 };
            job.left = pitch > 50.0;
            job.start = 40.0 - pitch;
            job.depth = if pitch < 30.0 { 1.5 } else { 1000.0 };
            let (nc, warnings) = post(&job).unwrap_or_else(|error| panic!("{name}: {error}"));
            let Proof { passes, report, undercut } = prove(name, &job, &nc, &warnings);
            println!(
                "{name}, pitch {pitch}: {} passes, {report:.4?}, undercut {undercut:.4?}",
                passes.len()
            );
        }
    }
}

/// The cases of the corpus with their programs as they are kept there.
fn cases() -> Vec<(String, Job, String)> {
    let names = ["trapezoid", "fillets", "left-hand", "low-lead"];
    names
        .map(|name| {
            let folder = root().join(format!("corpus/papers/screw-{name}"));
            let text = |file: &str| std::fs::read_to_string(folder.join(file)).expect("is there");
            let job =
                Job::read(&text("screw.ncl")).unwrap_or_else(|error| panic!("{name}: {error}"));
            (name.to_string(), job, text("screw.nc"))
        })
        .to_vec()
}

#[test]
fn the_programs_of_the_corpus_are_right() {
    for (name, job, nc) in cases() {
        let (_, warnings) = post(&job).expect("the job is made");
        let Proof { passes, report, undercut } = prove(&name, &job, &nc, &warnings);
        println!("{name}: {} passes, {report:.4?}, undercut {undercut:.4?}", passes.len());
    }
}

#[test]
fn the_page_shows_the_case() {
    let (_, job, nc) = cases().swap_remove(0);
    let page = std::fs::read_to_string(root().join("docs/papers/screw.md")).expect("the page");
    let shown: Vec<_> =
        examples::blocks(&page).into_iter().filter(|b| b.words == ["text"]).collect();
    let cl = std::fs::read_to_string(root().join("corpus/papers/screw-trapezoid/screw.ncl"));
    assert_eq!(shown[0].text, cl.expect("the case"));
    assert!(nc.contains(&shown[1].text));
    let (_, warnings) = post(&job).expect("the job is made");
    assert!(warnings.iter().any(|diag| diag.to_string().contains(shown[2].text.trim())));
    let made = passes::read(&job, &nc).expect("the passes are right");
    let folder = root().join("docs/papers");
    drawing::section(&job, &made).check(&folder.join("screw-section.svg"));
    drawing::unrolled(&job, &made, 5).check(&folder.join("screw-unrolled.svg"));
}

/// The undercut comes from the lead angle: the cut of a ball of radius r is as wide as
/// r / cos(lead) along the axis.
#[test]
fn the_undercut_grows_with_the_pitch() {
    let page = std::fs::read_to_string(root().join("docs/papers/screw.md")).expect("the page");
    let upright = [[0.0, 25.0], [0.0, 15.0], [16.0, 15.0], [16.0, 25.0]];
    let mut rows = String::new();
    let mut last = 0.0;
    for pitch in [16.0, 20.0, 30.0, 40.0, 60.0, 80.0] {
        let mut job = Job::new(Section::rounded(&upright, &[5.0, 5.0]), pitch);
        job.cutters.retain(|cutter| cutter.number == 3 || cutter.diameter == 8.0 && cutter.ball);
        let (nc, warnings) = post(&job).expect("the job is made");
        let made = passes::read(&job, &nc).expect("the passes are right");
        let undercut = helix::undercut(&job, &made, true, 0.001);
        let lead = (pitch / (std::f64::consts::TAU * 20.0)).atan();
        let rule = 4.0 * (1.0 / lead.cos() - 1.0);
        let said = warned(&warnings)[1];
        rows += &format!(
            "| {pitch} | {:.1} | {said:.3} | {undercut:.3} | {rule:.3} |\n",
            lead.to_degrees()
        );
        assert!((said - undercut).abs() < 0.001 && undercut > last, "{rows}");
        last = undercut;
    }
    assert!(page.contains(&rows), "{rows}");
}

/// Each extension that the script uses is named in its header.
#[test]
fn the_script_names_its_extensions() {
    let path = root().join("fil-scripts/papers/screw.fil");
    let text = files::read_text(&path, None).expect("the script is there");
    let mut loader = includes::beside(std::slice::from_ref(&path), None);
    let options =
        check::Options { strict: true, includes: Some(&mut loader), ..Default::default() };
    let name = path.to_string_lossy();
    let diags = check::check(&[(&name, &text)], options);
    let header: String = text.lines().take_while(|line| line.starts_with("$$")).collect();
    for diag in diags {
        let named = ["COUPLF", "HASF", "COMF", "ERROR", "WARN"]
            .iter()
            .any(|name| diag.to_string().contains(name) && header.contains(name));
        assert!(diag.code.name() == "E0219" && named, "{diag}");
    }
    let options = check::Options { includes: Some(&mut loader), ..Default::default() };
    let diags = check::check(&[(&name, &text)], options);
    assert!(diags.is_empty(), "{diags:?}");
}

/// Numbers from a fixed row.
struct Dice(u64);

impl Dice {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }
}

/// A job with a random section: two walls with fillets, a floor, lips or not.
fn random_job(dice: &mut Dice) -> Job {
    let top = dice.between(15.0, 60.0);
    let depth = dice.between(2.0, 10.0_f64.min(top - 5.0));
    let slope = |dice: &mut Dice| {
        if dice.chance(0.2) { 0.0 } else { depth * dice.between(0.05, 1.2) }
    };
    let [left, right] = [slope(dice), slope(dice)];
    let floor = dice.between(4.0, 18.0);
    let points =
        [[0.0, top], [left, top - depth], [left + floor, top - depth], [left + floor + right, top]];
    let largest = 3.0_f64.min(0.9 * depth).min(0.45 * floor);
    let mut fillet = || if dice.chance(0.1) { 0.0 } else { dice.between(0.5, largest) };
    let radii = [fillet(), fillet()];
    let mut job = Job::new(Section::rounded(&points, &radii), 1.0);
    job.pitch = (left + floor + right) * dice.between(1.05, 3.0);
    job.turns = dice.between(0.5, 6.0);
    job.start = dice.between(-80.0, 80.0);
    job.left = dice.chance(0.5);
    job.stock = if dice.chance(0.2) { 0.0 } else { dice.between(0.1, 1.0) };
    job.rough = dice.between(0.2, 2.0);
    job.depth = dice.between(0.5, 10.0);
    job.finish = dice.between(0.01, 0.2);
    job
}

#[test]
fn random_jobs_are_right_or_refused() {
    let count =
        std::env::var("FILPOST_SCREWS").ok().and_then(|text| text.parse().ok()).unwrap_or(40);
    let mut dice = Dice(1);
    let (mut made, mut no_mill, mut no_ball) = (0, 0, 0);
    for index in 0..count {
        let job = random_job(&mut dice);
        match post(&job) {
            Ok((nc, warnings)) => {
                prove(&format!("job {index}"), &job, &nc, &warnings);
                made += 1;
            }
            Err(error) if error.to_string().contains("no end mill of the list fits") => {
                no_mill += 1
            }
            Err(error) if error.to_string().contains("leaves a corner uncut") => {
                let fits = job.cutters.iter().find(|c| c.ball && reached(&job, c.diameter, -0.01));
                assert!(fits.is_none(), "{fits:?} fits\n{}", job.cl());
                no_ball += 1;
            }
            Err(error) => panic!("{error}\n{}", job.cl()),
        }
    }
    println!("{made} made, {no_mill} without an end mill, {no_ball} without a ball");
    assert!(made * 3 > count, "too many are refused");
}

#[test]
fn each_change_of_a_program_is_found() {
    let (_, section) = sections().swap_remove(1);
    let mut job = Job::new(section, 30.0);
    job.finish = 0.02;
    let (nc, _) = post(&job).expect("the job is made");
    let judge = |nc: &str| {
        let made = passes::read(&job, nc)?;
        sweep::check(&job, &made)?;
        sweep::check_levels(&job, &made)?;
        let radius =
            made.last().and_then(|pass| job.cutter(pass.tool)).map_or(0.0, |c| c.diameter / 2.0);
        let [x, z] = made.last().map_or([0.0; 2], |pass| pass.place(&job));
        let off = (x - job.section.ends()[1]).hypot(z + radius - job.section.top()) - radius;
        if off.abs() < 0.001 { Ok(()) } else { Err("the end is not reached".to_string()) }
    };
    judge(&nc).expect("the program is right");
    let lines: Vec<&str> = nc.lines().collect();
    let idle =
        |line: &str| ["G43", "G94", "Y0.", "A0.", "Z27."].iter().any(|word| line.contains(word));
    let mut count = 0;
    for (index, line) in lines.iter().enumerate() {
        // Positions above the blank may be others too.
        if !line.contains("G0") && !line.contains("G1 ") || idle(line) {
            continue;
        }
        for Mutation { what, nc } in mutate::mutations(&nc, index) {
            assert!(judge(&nc).is_err(), "not found: {what}");
            count += 1;
        }
    }
    let page = std::fs::read_to_string(root().join("docs/papers/screw.md")).expect("the page");
    assert!(page.contains(&format!("{count} changes of")), "{count} changes, all found");
}
