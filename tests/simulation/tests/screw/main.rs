//! Programs of `fil-scripts/papers/screw.fil` proved by simulation: the NC text is
//! read back and its passes are swept over the section of the groove, in the plane of
//! the axis and in space.

mod plane;
mod random;

use std::io::Cursor;

use filpost::{Diag, Error, Program, check, files, includes};
use filpost_simulation::screw::mutate::{self, Mutation};
use filpost_simulation::screw::passes::Pass;
use filpost_simulation::screw::section::{Section, Step};
use filpost_simulation::screw::{Job, drawing, helix, passes, sweep};
use filpost_tests::{examples, root};

/// The NC program of a job and the warnings.
fn post(job: &Job) -> Result<(String, Vec<Diag>), Error> {
    post_changed(job, None)
}

/// The same with a text of a file of the script replaced.
fn post_changed(
    job: &Job,
    change: Option<(&'static str, &'static str, &'static str)>,
) -> Result<(String, Vec<Diag>), Error> {
    let script = root().join("fil-scripts/papers/screw.fil");
    let machine = root().join("corpus/papers/screw-trapezoid/machine.toml");
    let text = |path: &std::path::Path| files::read_text(path, None).expect("the file is read");
    let mut beside = includes::beside(std::slice::from_ref(&script), None);
    let post = Program::builder()
        .machine("machine.toml", &text(&machine))
        .fil(&script.to_string_lossy(), &text(&script))
        .includes(move |from: &str, name: &str| {
            let mut included = beside(from, name)?;
            if let Some((_, from, to)) = change.filter(|(file, ..)| name.ends_with(file)) {
                assert!(included.text.contains(from), "{from}");
                included.text = included.text.replace(from, to);
            }
            Ok(included)
        })
        .build()?;
    let mut nc = Vec::new();
    let report = post.start().cl_name("screw.ncl").stream(Cursor::new(job.cl()), &mut nc)?;
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
/// the undercut it warns of, looked for every `spacing` along the section.
fn prove(job: &Job, nc: &str, warnings: &[Diag], spacing: f64) -> Result<Proof, String> {
    let made = passes::read(job, nc)?;
    let report = sweep::check(job, &made)?;
    sweep::check_levels(job, &made)?;
    choice(job, &made)?;
    let undercut = [false, true].map(|ball| helix::undercut(job, &made, ball, spacing));
    let said = warned(warnings);
    // Samples along the section find less of a narrow undercut than there is.
    let [less, more] = [job.tolerance + 0.0011, job.tolerance + 0.0011 + spacing / 3.0];
    if undercut.iter().zip(said).any(|(found, said)| said < found - less || said > found + more) {
        return Err(format!("undercut {undercut:?}, said {said:?}"));
    }
    if !helix::reaches(job, &made, job.finish + job.tolerance, 0.05) {
        return Err("a scallop in space is too high".to_string());
    }
    Ok(Proof { passes: made, report, undercut })
}

/// The same for a job that must be right.
fn proved(name: &str, job: &Job, nc: &str, warnings: &[Diag]) -> Proof {
    prove(job, nc, warnings, 0.002)
        .unwrap_or_else(|fault| panic!("{name}: {fault}\n{}\n{nc}", job.cl()))
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
            let Proof { passes, report, undercut } = proved(name, &job, &nc, &warnings);
            println!(
                "{name}, pitch {pitch}: {} passes, {report:.4?}, undercut {undercut:.4?}",
                passes.len()
            );
        }
    }
}

/// The cases of the corpus with their programs as they are kept there.
fn cases() -> Vec<(String, Job, String)> {
    let names = ["trapezoid", "fillets", "left-hand", "low-lead", "tangent", "u-groove"];
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
        let Proof { passes, report, undercut } = proved(&name, &job, &nc, &warnings);
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
    drawing::unrolled(&job, &made).check(&folder.join("screw-unrolled.svg"));
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

/// The passes of a program: place along the screw, distance from its axis and turn, for each
/// block that moves one of them after the first feed in inverse time.
fn passes_of(nc: &str, [along, out, table]: [char; 3], axis_at: f64, sense: f64) -> Vec<[f64; 3]> {
    let mut at = [0.0; 3];
    let mut found = Vec::new();
    for line in nc.lines().skip_while(|line| !line.ends_with("G93")) {
        let mut moves = false;
        for word in line.split(' ').filter(|word| word.len() > 1) {
            let (letter, number) = word.split_at(1);
            let Ok(value) = number.parse::<f64>() else { continue };
            let value = match letter.chars().next() {
                Some(letter) if letter == along => (0, value),
                Some(letter) if letter == out => (1, value - axis_at),
                Some(letter) if letter == table => (2, sense * value),
                _ => continue,
            };
            at[value.0] = value.1;
            moves = true;
        }
        if moves {
            found.push(at);
        }
    }
    found
}

/// The linear transformation to other machines of four axes: a table B about Y, and a table C that
/// turns about -Z through X100 Y50 with the tool along X.
#[test]
fn other_machines_make_the_same_passes() {
    let program = |case: &str| {
        let path = root().join("corpus/papers").join(case).join("screw.nc");
        files::read_text(&path, None).expect("a case of the corpus")
    };
    let passes = passes_of(&program("screw-trapezoid"), ['X', 'Z', 'A'], 0.0, 1.0);
    assert!(passes.len() >= 80, "{}", passes.len());
    for (case, letters, axis_at, sense) in [
        ("screw-table-b", ['Y', 'Z', 'B'], 0.0, 1.0),
        ("screw-table-c", ['Z', 'X', 'C'], 100.0, -1.0),
    ] {
        let found = passes_of(&program(case), letters, axis_at, sense);
        assert_eq!(found.len(), passes.len(), "{case}");
        for (found, wanted) in found.iter().zip(&passes) {
            let apart = (0..3).map(|axis| (found[axis] - wanted[axis]).abs()).fold(0.0, f64::max);
            assert!(apart < 0.0011, "{case}: {found:?}, not {wanted:?}");
        }
    }
}
