//! The run-out script and the library function, proved on a simulated machine: what is
//! left at a displaced and tilted cylinder after one program has gone round it.

mod left;
mod measured;
mod tilt;

use std::fs;
use std::io::Cursor;
use std::sync::{Arc, Mutex};

use filpost::check::{self, Options};
use filpost::{Argument, Error, Event, Program, case::Case, includes};
use filpost_simulation::runout::solve::{Bounds, Placing, Reading, RunOut, Section};
use filpost_simulation::runout::{
    Cylinder, Probe, Probed, Random, SECTIONS, Search, TURNS, cl_file, deviations, drawing,
    positions, residual, tool,
};
use filpost_tests::posting::with_script;
use filpost_tests::root;
use left::{EXACT, worst};
use nalgebra::{Point3, Unit, Vector3};
use rayon::prelude::*;

const PLACINGS: [Placing; 3] = [Placing::Parallel, Placing::Intersecting, Placing::Skew];
/// Poses of each placing.
const POSES: usize = 200;
/// Half the run-out of the paper: 0.2 mm.
const ECCENTRIC: f64 = 0.1;
/// Error of a reading.
const NOISE: f64 = 0.001;

/// For readings without noise.
const ON: &str = "RUNOUT / TOLER, 0.001\nRUNOUT / ON";
/// The default: two centers that are each wrong by 1.5 microns look 3 microns apart.
const ON_NOISY: &str = "RUNOUT / ON";

fn text(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn script() -> String {
    text("fil-scripts/papers/run-out.fil")
}

fn five_axes() -> String {
    text("corpus/papers/run-out-skew/machine.toml")
}

fn three_decimals() -> String {
    let coarse = five_axes().replace("4444", "4343");
    assert_ne!(coarse, five_axes());
    coarse
}

fn four_axes() -> String {
    text("corpus/papers/run-out-parallel/machine.toml")
}

fn post(machine: &str, script: &str) -> Program {
    let post = Program::builder().machine("machine.toml", machine);
    let post = with_script(post, "run-out.fil", script);
    post.build().expect("the post is made")
}

fn run(post: &Program, cl: &str) -> Result<String, Error> {
    let mut nc = Vec::new();
    post.stream(cl.as_bytes(), &mut nc)?;
    Ok(String::from_utf8(nc).expect("NC is text"))
}

/// The place of the part's axis at the three turns, with [`ECCENTRIC`] the largest.
fn pose(placing: Placing, random: &mut Random) -> Cylinder {
    let [bottom, _, top] = TURNS;
    let angle = random.unit() * 180.0_f64.to_radians();
    let (sine, cosine) = angle.sin_cos();
    loop {
        let (low, high) = match placing {
            Placing::Parallel => ([cosine, sine], [cosine, sine]),
            Placing::Intersecting => {
                let meets = 50.0 + 150.0 * random.unit();
                let at = |z: f64| [(z - meets) * cosine, (z - meets) * sine];
                (at(bottom), at(top))
            }
            Placing::Skew => ([random.unit(), random.unit()], [random.unit(), random.unit()]),
        };
        let most = low[0].hypot(low[1]).max(high[0].hypot(high[1]));
        let [low, high] = [low, high].map(|at| at.map(|part| part * ECCENTRIC / most));
        let lean = [high[0] - low[0], high[1] - low[1]];
        let apart = (low[0] * lean[1] - low[1] * lean[0]).abs() / lean[0].hypot(lean[1]);
        if placing != Placing::Skew || apart > 0.01 {
            return Cylinder::through(low, high);
        }
    }
}

fn poses(placing: Placing) -> impl Iterator<Item = (u64, Cylinder)> + Send {
    let mut random = Random(filpost_simulation::seed(placing as u64));
    (0..POSES as u64).map(move |index| (index, pose(placing, &mut random)))
}

/// Both sections; every other pose gives them from top to bottom.
fn probe(cylinder: &Cylinder, noise: f64, search: Search, seed: u64) -> [Probed; 2] {
    let mut probe = Probe { noise, random: Random(1000 + seed), search };
    let mut sections = SECTIONS.map(|height| probe.section(cylinder, height));
    if seed % 2 == 1 {
        sections.reverse();
    }
    sections
}

#[test]
fn without_compensation_the_run_out_is_that_of_the_paper() {
    let post = post(&five_axes(), &script());
    let nc = run(&post, &cl_file(&[], "$$")).expect("the path is posted");
    for placing in PLACINGS {
        for (seed, cylinder) in poses(placing) {
            let left = residual(&nc, &cylinder);
            assert!((left.run_out - 0.2).abs() < 0.001, "{placing:?} {seed}: {left:?}");
        }
    }
}

/// With its own tolerance the script takes noise for no lean, and no part for a skew one.
#[test]
fn noise_is_no_lean() {
    let posts = [five_axes(), four_axes()].map(|machine| post(&machine, &script()));
    poses(Placing::Parallel).par_bridge().for_each(|(seed, cylinder)| {
        let sections = probe(&cylinder, NOISE, Search::FourTouches, seed);
        for post in &posts {
            let nc = run(post, &cl_file(&sections, ON_NOISY)).expect("the path is posted");
            assert!(nc.contains("(RUN-OUT PARALLEL"), "{seed}: {nc}");
        }
    });
    // A part without run-out, whose MIN may come out above its MAX.
    let text = "RUNOUT / PROBE, 1, ZCOORD, 20, MIN, 50.0012, CMIN, 180, MAX, 50.0, CMAX, 0\n\
                RUNOUT / PROBE, 2, ZCOORD, 80, MIN, 50.0, CMIN, 180, MAX, 50.0012, CMAX, 0\n\
                RUNOUT / ON";
    let nc = run(&posts[1], &cl_file(&[], text)).expect("the path is posted");
    assert!(nc.contains("(RUN-OUT PARALLEL 0.0006 DEG 0.0003 MM)"), "{nc}");
}

#[test]
fn four_axes_follow_the_surface_with_points_only() {
    let left = worst(&four_axes(), &script(), "RUNOUT / POINTS", Placing::Skew, EXACT);
    assert!(left.radial < 0.0005, "{left:?}");
    assert!(left.lean > 0.05 && left.lean < 0.2, "the tool leans with the part: {left:?}");
    let parallel = worst(&four_axes(), &script(), ON, Placing::Parallel, EXACT);
    assert!(parallel.radial < 0.0005 && parallel.lean < 1e-9, "{parallel:?}");
}

/// After RUNOUT/OFF the part stands on the table axis, and can be probed anew.
#[test]
fn the_compensation_ends_and_begins_again() {
    let sections = |seed| {
        let cylinder = pose(Placing::Skew, &mut Random(seed));
        probe(&cylinder, 0.0, Search::FourTouches, seed)
    };
    let [first, second] = [1, 2].map(|seed| cl_file(&sections(seed), ON));
    let (_, again) = second.split_once("UNITS / MM\n").expect("the CL file has a head");
    let plain = "RUNOUT / OFF\nGOTO / 49, 0, 10, 1, 0, 0\n";
    let both = first.replace("FINI\n", &format!("{plain}{again}"));
    let post = post(&five_axes(), &script());
    let path = positions(&run(&post, &both).expect("the path is posted"));
    let alone = positions(&run(&post, &second).expect("the path is posted"));
    let [x, y, z, b, _] = path[alone.len()];
    assert_eq!([x, y, z, b], [49.0, 0.0, 10.0, 0.0]);
    for (after, alone) in path[alone.len() + 1..].iter().zip(&alone) {
        assert_eq!(after[..4], alone[..4]);
    }
}

#[test]
fn the_placing_is_named_in_the_program() {
    let post = post(&five_axes(), &script());
    for placing in PLACINGS {
        let name = format!("(RUN-OUT {} ", format!("{placing:?}").to_uppercase());
        poses(placing).par_bridge().for_each(|(seed, cylinder)| {
            let sections = probe(&cylinder, 0.0, Search::FourTouches, seed);
            let nc = run(&post, &cl_file(&sections, ON)).expect("the path is posted");
            assert!(nc.contains(&name), "{seed}: no {name} in\n{nc}");
        });
    }
}

/// The sections as the library takes them, to the decimals of the CL file: the distance
/// of almost parallel axes depends on the last one.
fn sections(probed: &[Probed; 2]) -> [Section; 2] {
    let written = |number: f64| format!("{number:.10}").parse().expect("a number");
    let reading = |pair: [f64; 2]| Reading { value: written(pair[0]), c: written(pair[1]) };
    probed.map(|section| Section {
        height: section.height,
        least: reading(section.least),
        largest: reading(section.largest),
    })
}

/// The script with a line that shows its matrix, angle and distance to the host.
#[test]
fn library_and_script_agree_to_a_billionth() {
    let numbers: Vec<String> = (1..=12).map(|at| format!("ROM({at})")).collect();
    let look = format!("  PPRINT/ROTEXT\n  DMY=LOOKF({},ROANG,RODIST)\n", numbers.join(","));
    let watched = script().replace("  PPRINT/ROTEXT\n", &look);
    let seen = Arc::new(Mutex::new(Vec::new()));
    let into = Arc::clone(&seen);
    let post = Program::builder().machine("machine.toml", &five_axes());
    let post = with_script(post, "run-out.fil", &watched)
        .function("LOOKF", 14, move |arguments| {
            let numbers = arguments.iter().map(|argument| match argument {
                Argument::Number(number) => *number,
                Argument::Text(_) => f64::NAN,
            });
            *into.lock().expect("nobody panics") = numbers.collect();
            Ok(0.0)
        })
        .build()
        .expect("the post is made");
    for placing in PLACINGS {
        for (seed, cylinder) in poses(placing) {
            let probed = probe(&cylinder, NOISE, Search::FourTouches, seed);
            run(&post, &cl_file(&probed, ON)).expect("the path is posted");
            let found = RunOut::find(&sections(&probed), &Bounds::default()).expect("it is found");
            let mut own: Vec<f64> = found.matrix.transpose().iter().copied().collect();
            own.extend([found.angle, found.distance]);
            let script = seen.lock().expect("nobody panics");
            assert_eq!(script.len(), own.len());
            for (script, own) in script.iter().zip(&own) {
                assert!((script - own).abs() < 1e-9, "{placing:?} {seed}: {script} {own}");
            }
        }
    }
}

#[test]
fn the_statement_of_the_library_makes_the_same_program() {
    let post = post(&five_axes(), &script());
    for placing in PLACINGS {
        for (seed, cylinder) in poses(placing).take(20) {
            let probed = probe(&cylinder, 0.0, Search::FourTouches, seed);
            let found = RunOut::find(&sections(&probed), &Bounds::default()).expect("it is found");
            assert_eq!(found.placing, placing);
            let by_script = run(&post, &cl_file(&probed, ON)).expect("posted");
            let by_library = run(&post, &cl_file(&[], &found.statement())).expect("posted");
            assert_eq!(positions(&by_script), positions(&by_library), "{placing:?} {seed}");
        }
    }
}

/// The matrix that the script shows in the listing is that of the page and of the library.
#[test]
fn the_page_shows_the_matrix_of_the_skew_case() {
    let cl = text("corpus/papers/run-out-skew/part.ncl");
    let mut shown = String::new();
    let post = post(&five_axes(), &script());
    post.start()
        .observe(|event| {
            if let Event::Message(line) = event {
                shown += &format!("{line}\n");
            }
        })
        .stream(Cursor::new(cl), &mut Vec::new())
        .expect("it is posted");
    assert!(text("docs/papers/run-out.md").contains(&shown), "{shown}");
    let read = |value: f64, c: f64| Reading { value, c };
    let sections = [
        Section { height: 20.0, least: read(49.94, 180.0), largest: read(50.06, 0.0) },
        Section { height: 100.0, least: read(49.9, 233.1301), largest: read(50.1, 53.1301) },
    ];
    let found = RunOut::find(&sections, &Bounds::default()).expect("it is found");
    let numbers = shown.lines().skip(1).flat_map(str::split_whitespace);
    let numbers: Vec<f64> = numbers.map(|number| number.parse().expect("a number")).collect();
    assert_eq!(numbers.len(), 12);
    for (shown, own) in numbers.iter().zip(found.matrix.transpose().iter()) {
        assert!((shown - own).abs() < 1e-9, "{shown} {own}");
    }
}

/// Each wrong sign, factor or order in the script shows at the part.
#[test]
fn mutations_of_the_script_are_found() {
    let mutations = [
        ("ATAN2F(-ROCY,ROCZ)", "ATAN2F(ROCY,ROCZ)"),
        ("ASINF(ROCX)", "ASINF(-ROCX)"),
        ("ROX(1) - ROZ(1)*ROAX/ROAZ", "ROX(1) + ROZ(1)*ROAX/ROAZ"),
        ("ROY(1) - ROZ(1)*ROAY/ROAZ", "ROY(1) + ROZ(1)*ROAY/ROAZ"),
        ("ROY(1) - ROZ(1)*ROAY/ROAZ", "ROY(1) - ROZ(2)*ROAY/ROAZ"),
        ("ROTIR/2*COSF(ROC(ROI))", "ROTIR*COSF(ROC(ROI))"),
        ("ROTIR/2*COSF(ROC(ROI))", "ROTIR/2*SINF(ROC(ROI))"),
        ("ROTIR/2*SINF(ROC(ROI))", "-ROTIR/2*SINF(ROC(ROI))"),
        ("ROCTOP - ROMISS/2", "ROCLOW - ROMISS/2"),
        ("+ ROQ*SINF(ROBY)", "- ROQ*SINF(ROBY)"),
        ("- ROP*SINF(ROBY)", "+ ROP*SINF(ROBY)"),
        ("ROFROM=3,ROTO=1", "ROFROM=1,ROTO=3"),
        ("ROFROM=2,ROTO=3", "ROFROM=3,ROTO=2"),
        ("ROMX=ROPX,ROMY=ROPY", "ROMX=ROPY,ROMY=ROPX"),
        ("IF (ROAZ.LT.0) ROLEN = -ROLEN", ""),
        ("(ROX(1)+ROX(2))/2", "(ROX(1)-ROX(2))/2"),
        ("(ROY(1)+ROY(2))/2", "(ROY(1)+ROY(2))"),
        ("ROPTS=ROKND.EQ.1", "ROPTS=1"),
        ("ROSIN.LE.ROTOL", "ROSIN.GT.ROTOL"),
        ("TRANS/ROM(1)", "TRANS/-ROM(1)"),
    ];
    for (from, to) in mutations {
        let mutated = script().replace(from, to);
        assert_ne!(mutated, script(), "{from} is not in the script");
        let found = PLACINGS.iter().any(|placing| shows(&mutated, *placing));
        assert!(found, "{from} became {to}, and nothing shows it");
    }
}

/// True when a script leaves too much at one of ten poses, or is refused.
fn shows(script: &str, placing: Placing) -> bool {
    let post = post(&five_axes(), script);
    poses(placing).take(10).any(|(seed, cylinder)| {
        let sections = probe(&cylinder, 0.0, Search::FourTouches, seed);
        match run(&post, &cl_file(&sections, ON)) {
            Ok(nc) => {
                let left = residual(&nc, &cylinder);
                left.radial > 0.002 || left.place > 0.002 || left.lean > 0.01
            }
            Err(_) => true,
        }
    })
}

#[test]
fn wrong_signs_in_the_program_are_found() {
    let post = post(&five_axes(), &script());
    let mut random = Random(7);
    let cylinder = pose(Placing::Skew, &mut random);
    let sections = probe(&cylinder, 0.0, Search::FourTouches, 0);
    let nc = run(&post, &cl_file(&sections, ON)).expect("the path is posted");
    assert!(residual(&nc, &cylinder).radial < 0.0005);
    for letter in ["X", "Y", "B", "C"] {
        let turned = nc
            .replace(&format!(" {letter}-"), " %")
            .replace(&format!(" {letter}"), &format!(" {letter}-"))
            .replace(" %", &format!(" {letter}"));
        let left = residual(&turned, &cylinder);
        assert!(left.place > 0.05, "{letter}: {left:?}");
    }
}

/// The cases of the corpus stand at the part they were probed on, and theirs alone.
#[test]
fn the_programs_of_the_corpus_fit_their_parts() {
    let tilt = 0.001;
    let part = |foot: [f64; 2], lean: [f64; 2]| Cylinder {
        foot: Point3::new(foot[0], foot[1], 0.0),
        axis: Unit::new_normalize(Vector3::new(lean[0], lean[1], 1.0)),
    };
    let cases = [
        ("parallel", part([0.06, 0.08], [0.0, 0.0])),
        ("intersecting", part([0.0, 0.0], [tilt, 0.0])),
        ("skew", part([0.06, -0.02], [0.0, tilt])),
        ("points", part([0.06, -0.02], [0.0, tilt])),
    ];
    for (name, cylinder) in &cases {
        let nc = text(&format!("corpus/papers/run-out-{name}/expected.nc"));
        let off = |cylinder: &Cylinder| -> f64 {
            let path = positions(&nc);
            let turn = &path[1..path.len() - 1];
            assert_eq!(turn.len(), 13);
            turn.iter().map(|axes| cylinder.deviation(&tool(axes).0).abs()).fold(0.0, f64::max)
        };
        assert!(off(cylinder) < 0.0002, "{name}: {}", off(cylinder));
        assert!(off(&part([0.0, 0.0], [0.0, 0.0])) > 0.05, "{name} fits a part without run-out");
    }
}

#[test]
fn bad_inputs_are_refused_in_words() {
    let expected = [
        ("equal-sections", "the sections at ZCOORD 20 and 20 are nearer than 1 mm"),
        ("equal-heights", "the sections at ZCOORD 20 and 20 are nearer than 1 mm"),
        ("section-twice", "section 1 is given twice"),
        ("section-3", "RUNOUT/PROBE needs section 1 or 2"),
        ("one-section", "RUNOUT/ON: section 2 is not there"),
        ("missing-couplet", "section 2 lacks CMIN"),
        ("min-above-max", "section 1: MIN is greater than MAX"),
        ("not-opposite", "section 2: CMIN and CMAX are not half a turn apart, but for 90"),
        ("misread", "section 2: run-out 45.11 mm is more than 2"),
        ("misspelt", "RUNOUT: item 3 after the / is misspelt"),
        ("couplet-twice", "RUNOUT: CMIN,c is there twice"),
        ("too-steep", "tilt 4.16 degrees is more than 1"),
        ("unknown-form", "RUNOUT needs PROBE, MEASUR, READ, TOLER, DIAMTR, ON"),
        ("tolerance", "RUNOUT/TOLER is above 0 and at most 0.1 mm"),
        ("other-table", "the machine has no table about Z through X0 Y0"),
        ("inches", "RUNOUT counts in mm, this CL file in inches"),
        ("four-axes", "tool axis"),
        ("near-sections", "the sections at ZCOORD 20 and 20 are nearer than 1 mm"),
        ("user-trans", "TRANS is on: RUNOUT would take its place"),
        ("points-only", "RUNOUT/ON turns the tool axis"),
        ("trans-while-on", "RUNOUT is on: TRANS would move half of it"),
        ("scale-c", "the machine scales or translates C"),
        ("translate-c", "the machine scales or translates C"),
        ("measure-too-near", "the probe stands at X 54: bring it to X 55 or further out first"),
        ("measure-no-position", "no position before RUNOUT/MEASUR"),
        ("measure-tip-control", "RUNOUT/MEASUR is written for X of the machine"),
        ("measure-little-clearance", "CLEAR is at most the run-out that may come, 1"),
        ("measure-inside", "OVER leads past the table axis"),
        ("readings-missing", "RUNOUT/READ: there is no run-out.txt"),
        ("readings-of-one", "run-out.txt does not hold both sections"),
        ("readings-no-number", "run-out.txt: no number after"),
    ];
    let folder = root().join("corpus/papers/run-out-refused");
    let count = fs::read_dir(&folder).expect("the cases are there").count();
    assert_eq!(count, expected.len(), "each case has its sentence");
    for (name, sentence) in expected {
        let case = Case::load(&folder.join(name)).expect("the case is there");
        let error = case.run().expect_err(name);
        let said: Vec<&str> = error.diags().iter().map(|diag| diag.message.as_str()).collect();
        assert!(said.iter().any(|said| said.starts_with(sentence)), "{name}: {said:?}");
    }
}

/// What `filpost check --strict` refuses is named in the header, with its reason.
#[test]
fn the_header_names_each_extension() {
    let script = script();
    let path = root().join("fil-scripts/papers/run-out.fil");
    let mut loader = includes::beside(std::slice::from_ref(&path), None);
    let options = Options { strict: true, includes: Some(&mut loader), ..Options::default() };
    let name = path.to_string_lossy();
    let mut found = check::check(&[(&name, &script)], options);
    // What it includes has a header of its own.
    found.retain(|diag| diag.spans.iter().any(|span| span.file == name));
    let header: String = script.lines().take_while(|line| line.starts_with("$$")).collect();
    let reason = header.find("Extensions:").expect("the header speaks of extensions");
    let mut names: Vec<&str> = Vec::new();
    for diag in found.iter().filter(|diag| diag.is_error()) {
        assert_eq!(diag.code.name(), "E0219", "{diag:?}");
        let word = diag.message.split([' ', '/', '(']).next().expect("a word");
        assert!(header[reason..].contains(word), "{word} is not in the header: {}", diag.message);
        names.push(word);
    }
    names.sort_unstable();
    names.dedup();
    assert_eq!(names, ["COMF", "COUPLF", "ERROR", "HASF"]);
}

/// The pictures of the page, at the part of the skew case.
#[test]
fn the_pictures_are_up_to_date() {
    let cylinder = Cylinder {
        foot: Point3::new(0.06, -0.02, 0.0),
        axis: Unit::new_normalize(Vector3::new(0.0, 0.001, 1.0)),
    };
    let search = Search::FourTouches;
    let mut exact = Probe { noise: 0.0, random: Random(0), search };
    let probed = [20.0, 100.0].map(|height| exact.section(&cylinder, height));
    let mut rough = Probe { noise: NOISE, random: Random(3), search };
    let noisy = SECTIONS.map(|height| rough.section(&cylinder, height));
    let post = post(&five_axes(), &script());
    let [before, after, noisy] =
        [(&[][..], "$$"), (&probed[..], ON), (&noisy[..], ON)].map(|(sections, on)| {
            let nc = run(&post, &cl_file(sections, on)).expect("the path is posted");
            deviations(&nc, &cylinder)
        });
    let folder = root().join("docs/papers");
    drawing::sections(&cylinder, &probed).check(&folder.join("run-out-sections.svg"));
    drawing::over_c(&before, &after, &noisy).check(&folder.join("run-out-over-c.svg"));
}
