//! Every CL file of other systems that is at hand: it posts on a machine that fits it, and
//! the back-check agrees, or it is refused for the reason that the table gives.
//!
//! A file that no row names fails, so that a new one gets its row. Without `FILPOST_DATA`
//! the reason is printed.

use std::path::{Path, PathBuf};
use std::{env, fs};

use fil_nc::forward::Pose;
use fil_nc::verify::{Allowed, ClPath, ExpectedStep, Verdict};
use filpost::Unit;
use filpost::cl::reader::{Options, Reader};
use filpost::cl::{Record, Vocabulary};
use filpost::verify::NcProgram;
use filpost_tests::cl_path::cl_path_in;
use filpost_tests::compare::compare;
use filpost_tests::klartext::{self, Step};
use filpost_tests::nc_path::nc_path;
use filpost_tests::path::{Action, ToolPath};
use filpost_tests::rs274;

/// A machine that fits a file.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Machine {
    /// Three axes; its programs run in LinuxCNC's interpreter, too.
    Mill,
    /// Two tables, C and A.
    Tables,
    Lathe,
}

impl Machine {
    fn post(self) -> filpost::Program {
        let tables = [
            "rotary.primary_kind=1",
            "rotary.primary_axis=3",
            "rotary.secondary_kind=1",
            "rotary.secondary_axis=1",
        ];
        let (ready, settings): (&str, &[&str]) = match self {
            Machine::Mill => ("linuxcnc-mill", &[]),
            Machine::Tables => ("fanuc-mill", &tables),
            Machine::Lathe => ("fanuc-lathe", &["spindle.css_limit=3000"]),
        };
        let builder = filpost::Program::builder().generic(ready);
        settings.iter().fold(builder, |builder, setting| builder.set(setting)).build().unwrap()
    }
}

/// What comes of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outcome {
    Agrees,
    /// Refused with this code at this line, and why that is right.
    Refused(&'static str, usize, &'static str),
}

use Machine::{Lathe, Mill, Tables};
use Outcome::{Agrees, Refused};

/// The files, each with its dialect, the machine and what comes of it.
const FILES: &[(&str, &str, Machine, Outcome)] = &[
    ("cl/creo/bohren_1.ncl.8", "creo", Mill, Agrees),
    ("cl/creo/op010.ncl.1", "creo", Mill, Agrees),
    ("cl/creo/profilfraesen_2.ncl.1", "creo", Mill, Agrees),
    ("cl/nx/TORETC_250_BOK.cls", "nx", Tables, Agrees),
    ("cl/nx/_2_KONTUR_VNUT_40_N2.cls", "nx", Mill, Agrees),
    ("cl/nx/_4_SVERL_63_N2.cls", "nx", Mill, Agrees),
    ("cl/nx/ust_a.cls", "nx", Tables, Agrees),
    ("cl/other/upside_down.as", "ncl", Tables, Refused("E0509", 18, "it has no FEDRAT")),
    ("cl/other/upside_down.cl", "generic", Mill, Refused("E0402", 1, "a binary file")),
    ("cl/other/upside_down.pp", "generic", Mill, Refused("E0513", 3, "a part program, not points")),
    ("cl/solidworks-cam/Teflon-gasket.apt", "solidworks-cam", Mill, Agrees),
    ("cl/solidworks-cam/Teste-Metrologia.apt", "solidworks-cam", Tables, Agrees),
    ("cl/solidworks-cam/shimemcunha.apt", "solidworks-cam", Tables, Agrees),
    (
        "cl-more/camworks/UniSource.clt",
        "camworks",
        Tables,
        Refused("E0506", 90, "CUTCOM, and no tool has a number"),
    ),
    ("cl-more/catia/1_linear_3x_linear_3x_PATH1.aptsource", "catia", Tables, Agrees),
    ("cl-more/catia/1_linear_5x_linear_5x_PATH1.aptsource", "catia", Tables, Agrees),
    (
        "cl-more/catia/2_circle-cylndr_circle-cylndr_5x_circle-cylndr_5x_PATH1.aptsource",
        "catia",
        Tables,
        Agrees,
    ),
    ("cl-more/catia/4_toolchange_empty-to-mill.aptsource", "catia", Mill, Agrees),
    ("cl-more/catia/4_toolchange_mill-to-turn.aptsource", "catia", Mill, Agrees),
    (
        "cl-more/catia/5_rotabl_rotabl.aptsource",
        "catia",
        Tables,
        Refused("E0506", 8, "ROTABL, and the points after it are not in the file"),
    ),
    ("cl-more/catia/DEMO1.txt", "catia", Lathe, Agrees),
    ("cl-more/catia/DEMO2.txt", "catia", Mill, Refused("E0511", 32, "a tap without a feed")),
    ("cl-more/catia/DEMO5.txt", "catia", Lathe, Agrees),
    ("cl-more/catia/circle-cylndr-helical_3x_PATH1.aptsource", "catia", Tables, Agrees),
    ("cl-more/catia/circle-cylndr_3x_PATH1.aptsource", "catia", Tables, Agrees),
    (
        "cl-more/catia/izlaz.txt",
        "catia",
        Mill,
        Refused("E0513", 84, "its last line is no statement"),
    ),
    ("cl-more/catia/milling_MILLING_PATH1_FRONT.aptsource", "catia", Tables, Agrees),
    ("cl-more/catia/milling_MILLING_PATH2_TRANSV.aptsource", "catia", Tables, Agrees),
    ("cl-more/catia/turning_TURNING_PATH1_TRANSV.aptsource", "catia", Lathe, Agrees),
    ("cl-more/nx/PathPointsFile.cls", "generic", Tables, Refused("E0509", 1, "it has no FEDRAT")),
    ("cl-more/nx/Plane_1.cldata", "ffcam", Mill, Agrees),
    ("cl-more/nx/cutcom2.clsf", "nx", Mill, Agrees),
    (
        "cl-more/other/catia_help_lathe_LT.aptsource",
        "catia",
        Lathe,
        Refused("E0506", 39, "SYNC waits for another turret"),
    ),
    ("cl-more/other/nx_matkap_CLS.cls", "nx", Mill, Agrees),
    ("cl-more/solidworks-cam/Suporte-parede-top.apt", "solidworks-cam", Mill, Agrees),
    ("cl-more/solidworks-cam/wall-holes.apt", "solidworks-cam", Tables, Agrees),
];

/// The folder of files of others; `None`, with the reason printed, where it is absent.
fn data() -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let data = env::var_os("FILPOST_DATA").map_or(here.join("../../shared/data"), PathBuf::from);
    if data.join("cl").is_dir() {
        return Some(data);
    }
    println!("skipped: no folder {}", data.join("cl").display());
    None
}

/// A file as text, and the unit that it says neither itself nor by its feeds.
fn read(path: &Path) -> (Vec<u8>, Option<Unit>) {
    let text = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let says = text.windows(5).any(|word| word == b"UNIT/" || word == b"UNITS");
    let told = Reader::new(&text[..], "part", Options::default()).told_unit();
    let is_known = says || told.is_some();
    (text, if is_known { None } else { Some(Unit::Mm) })
}

/// The dialect of a text, by its signs.
fn dialect(text: &[u8]) -> &'static str {
    let mut reader = Reader::new(text, "part", Options::default());
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    while matches!(reader.read(&mut vocabulary, &mut record), Ok(true)) {}
    reader.recognized().dialect.name()
}

fn post(
    post: &filpost::Program,
    cl: &[u8],
    unit: Option<Unit>,
) -> Result<Vec<u8>, Box<filpost::Diag>> {
    let mut nc = Vec::new();
    let run = post.start();
    let run = if let Some(unit) = unit { run.units(unit) } else { run };
    match run.stream(cl, &mut nc) {
        Ok(_) => Ok(nc),
        Err(error) => Err(Box::new(error.diags()[0].clone())),
    }
}

/// The differences that the back-check finds, one a line.
fn back_check(post: &filpost::Program, cl: &[u8], unit: Option<Unit>, nc: &[u8]) -> String {
    let run = post.start();
    let run = if let Some(unit) = unit { run.units(unit) } else { run };
    let program = NcProgram { text: nc, name: "out.nc" };
    let (report, _) = run.verify(cl, program, Allowed::default()).unwrap();
    if report.verdict() == Verdict::Agrees {
        return String::new();
    }
    report.findings.iter().map(|finding| format!("\n  {finding}")).collect::<String>() + "\n"
}

#[test]
fn each_file_agrees_or_is_refused_for_its_reason() {
    let Some(data) = data() else { return };
    for (name, system, machine, expected) in FILES {
        let (cl, unit) = read(&data.join(name));
        assert_eq!(dialect(&cl), *system, "{name}");
        let program = machine.post();
        let found = post(&program, &cl, unit);
        match (found, expected) {
            (Ok(nc), Agrees) => assert_eq!(back_check(&program, &cl, unit, &nc), "", "{name}"),
            (Err(diag), Refused(code, line, _)) => {
                let at = diag.spans.first().map_or(0, |span| span.line as usize);
                assert_eq!((diag.code.name().as_str(), at), (*code, *line), "{name}: {diag}");
            }
            (Ok(_), Refused(code, ..)) => panic!("{name} posts; {code} was expected"),
            (Err(diag), Agrees) => panic!("{name}: {diag}"),
        }
    }
    for (name, system, machine, outcome) in FILES {
        println!("{name}: {system}, {machine:?}, {outcome:?}");
    }
    let agree = FILES.iter().filter(|(.., outcome)| *outcome == Agrees).count();
    println!("{agree} files agree, {} are refused", FILES.len() - agree);
}

#[test]
fn each_file_has_its_row() {
    let Some(data) = data() else { return };
    for folder in ["cl", "cl-more"] {
        for system in fs::read_dir(data.join(folder)).unwrap().flatten() {
            let Ok(files) = fs::read_dir(system.path()) else { continue };
            for file in files.flatten() {
                let name = file.path().strip_prefix(&data).unwrap().to_string_lossy().into_owned();
                assert!(FILES.iter().any(|(row, ..)| *row == name), "{name} has no row");
            }
        }
    }
}

/// The compensation of the control moves the path by a radius that the CL file does not
/// name; without it the programmed points must come.
fn without_compensation(cl: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(cl);
    let lines = text.lines().filter(|line| !line.starts_with("CUTCOM"));
    lines.fold(String::new(), |text, line| text + line + "\n").into_bytes()
}

fn count(path: &ToolPath, wanted: fn(&Action) -> bool) -> usize {
    path.steps.iter().filter(|step| wanted(&step.action)).count()
}

/// LinuxCNC's interpreter makes of the programs what the files ask for.
#[test]
fn programs_of_three_axes_run() {
    let (Some(data), Some(program)) = (data(), rs274::program()) else { return };
    let mut done = 0;
    for (name, ..) in
        FILES.iter().filter(|(_, _, machine, outcome)| *machine == Mill && *outcome == Agrees)
    {
        let (cl, unit) = read(&data.join(name));
        let cl = without_compensation(&cl);
        let nc = post(&Mill.post(), &cl, unit).unwrap_or_else(|diag| panic!("{name}: {diag}"));
        let nc = String::from_utf8(nc).unwrap();
        let wanted =
            cl_path_in(&cl[..], name, unit).unwrap_or_else(|said| panic!("{name}: {said}"));
        let calls = rs274::run(&program, &nc).unwrap_or_else(|said| panic!("{name}: {said}"));
        let found = nc_path(&calls, &nc).unwrap_or_else(|said| panic!("{name}: {said}"));
        let differences = compare(&wanted, &found);
        let list: String = differences.iter().map(|one| format!("\n  {one}")).collect();
        assert!(differences.is_empty(), "{name}:{list}");
        println!(
            "{name}: {} motions, {} arcs, {} holes agree",
            count(&wanted, |action| matches!(action, Action::Rapid(_) | Action::Feed(..))),
            count(&wanted, |action| matches!(action, Action::Arc(..))),
            count(&wanted, |action| matches!(action, Action::Hole(..))),
        );
        done += 1;
    }
    assert!(done > 8, "{done} files");
}

/// A tip in the frame of its tool axis, which lies across Y.
fn in_frame(pose: &Pose) -> [f64; 3] {
    let ([x, y, z], [i, j, k]): ([f64; 3], [f64; 3]) = (pose.tip.coords.into(), pose.axis.into());
    assert!(j.abs() < 1e-9, "a tool axis out of X and Z");
    [k * x - i * z, y, i * x + k * z]
}

/// The path of a CL file in the frames of its tool axes.
fn steps_of(cl: &[u8]) -> Vec<Step> {
    let mut found = Vec::new();
    let mut at = [f64::NAN; 3];
    let reader = Reader::new(cl, "part", Options::default());
    for step in ClPath::new(reader, "part", [0.0; 3]) {
        match step.unwrap().what {
            ExpectedStep::Rapid(pose) | ExpectedStep::Feed(pose, _) => {
                let to = in_frame(&pose);
                if std::mem::replace(&mut at, to) != to {
                    found.push(Step::Line(to));
                }
            }
            ExpectedStep::Arc(arc, _) => {
                assert!(arc.normal.z.abs() > 0.999_999, "an arc out of X and Y");
                at = in_frame(&arc.end);
                found.push(Step::Arc(at, [arc.center.x, arc.center.y], arc.normal.z > 0.0));
            }
            ExpectedStep::Hole(hole) => {
                let [x, y, _] = in_frame(&hole.start);
                found.push(Step::Hole([x, y], hole.depth));
            }
            _ => {}
        }
    }
    found
}

/// Same kind, and the same numbers to the last digit of the programs.
fn agree(a: &Step, b: &Step) -> bool {
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.0011);
    match (a, b) {
        (Step::Line(a), Step::Line(b)) => near(a, b),
        (Step::Arc(a, center, ccw), Step::Arc(b, other, sense)) => {
            near(a, b) && near(center, other) && ccw == sense
        }
        (Step::Hole(a, depth), Step::Hole(b, other)) => near(a, b) && near(&[*depth], &[*other]),
        _ => false,
    }
}

/// CL files of a CAM system with the Heidenhain programs that it wrote beside them.
const PAIRS: [(&str, &[&str]); 2] =
    [("Teflon-gasket", &["11.h"]), ("shimemcunha", &["11.h", "12.h"])];

/// The CL text of a pair and the steps of its programs.
fn pair(data: &Path, part: &str, programs: &[&str]) -> (Vec<u8>, Vec<Step>) {
    let (cl, _) = read(&data.join(format!("cl/solidworks-cam/{part}.apt")));
    let mut found = Vec::new();
    for program in programs {
        let path = data.join(format!("nc/heidenhain/{part}/{program}"));
        found.extend(klartext::steps(&fs::read_to_string(path).unwrap()).unwrap());
    }
    (cl, found)
}

fn assert_same(part: &str, wanted: &[Step], found: &[Step]) {
    let differs = wanted.iter().zip(found).position(|(a, b)| !agree(a, b));
    if let Some(at) = differs {
        panic!("{part}, step {at}: {:?} and {:?}", wanted[at], found[at]);
    }
    assert_eq!(wanted.len(), found.len(), "{part}");
    println!("{part}: {} steps agree", found.len());
}

/// The programs that the CAM system wrote beside two of its CL files go to the same points,
/// by the same arcs, and drill the same holes.
#[test]
fn heidenhain_programs_have_the_same_points() {
    let Some(data) = data() else { return };
    for (part, programs) in PAIRS {
        let (cl, found) = pair(&data, part, programs);
        assert_same(part, &steps_of(&cl), &found);
    }
}

/// A CL text whose tool axes lie across Y, each turned into Z by a TRANS before its points.
fn turned_upright(cl: &[u8]) -> String {
    let mut text = String::new();
    let mut axis = [0.0, 1.0];
    for line in String::from_utf8_lossy(cl).lines() {
        let point = line.strip_prefix("GOTO/").map(|numbers| {
            let numbers = numbers.split(',').map(|number| number.trim().parse().unwrap());
            numbers.collect::<Vec<f64>>()
        });
        if let Some(point) = point {
            let now = if let [_, _, _, i, _, k] = point[..] { [i, k] } else { [0.0, 1.0] };
            if std::mem::replace(&mut axis, now) != now {
                let [i, k] = now;
                text += &format!("TRANS/{k},0,{},0,0,1,0,0,{i},0,{k},0\n", -i);
            }
        }
        text += line;
        text.push('\n');
    }
    text
}

/// Ours for the same files go to the points of those programs, by arcs of the same sense and
/// the same holes.
#[test]
fn our_klartext_has_the_points_of_the_pairs() {
    let Some(data) = data() else { return };
    let post = filpost::Program::builder().generic("heidenhain-tnc640").set("rapid.split=0");
    let post = post.build().unwrap();
    for (part, programs) in PAIRS {
        let (cl, wanted) = pair(&data, part, programs);
        let mut nc = Vec::new();
        let upright = turned_upright(&cl);
        post.start().stream(upright.as_bytes(), &mut nc).unwrap();
        let nc = String::from_utf8(nc).unwrap();
        let found = klartext::steps(&nc).unwrap();
        assert_same(part, &wanted, &found);
        let turned = nc.replacen(" DR-", " DR+", 1);
        let other = klartext::steps(&turned).unwrap();
        assert!(turned == nc || wanted.iter().zip(&other).any(|(a, b)| !agree(a, b)), "{part}");
    }
}
