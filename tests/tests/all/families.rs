//! Random CL programs posted for controls of other families, read back and verified:
//! nothing may be found, or the post must have refused them.
//!
//! `FILPOST_FAMILIES=FIRST..LAST` runs more seeds than the sample of each test run, and
//! `FILPOST_FAMILIES_KEEP=FOLDER` keeps the programs in which something is found;
//! `FILPOST_FAMILIES_SET="KEY=VALUE KEY=VALUE"` gives every odd machine these settings.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;

use fil_nc::diff;
use filpost::case::{self, Case};
use filpost::cl::reader::Options;
use filpost::files;
use filpost::plot::{self, ClText, Text};
use filpost_tests::posting::{self, Job, Machine};
use filpost_tests::random::make::program;
use filpost_tests::random::verdict::cl_text;
use filpost_tests::root;

/// Posts whose language the judge has read longest, with three and with four decimals.
const PLAIN: [&str; 2] = ["linuxcnc-mill", "fanuc-mill"];

/// Preparatory functions of the generator that these controls don't have, and comments.
const FOREIGN: [&str; 3] = ["INSERT / (", "PREFUN / 98", "PREFUN / 99"];

/// Seeds of a usual run.
const SAMPLE: Range<u64> = 0..40;

fn seeds() -> Range<u64> {
    let asked = std::env::var("FILPOST_FAMILIES").ok();
    let range = asked.as_deref().and_then(|text| {
        let (first, last) = text.split_once("..")?;
        Some(first.parse().ok()?..last.parse().ok()?)
    });
    range.unwrap_or(SAMPLE)
}

/// Settings that another machine of the family may have, divided by blanks; a seed takes one
/// of these lists.
fn odd_settings(ready: &str) -> &'static [&'static str] {
    match ready {
        "sinumerik-840d" => &[
            "circle.center=4",
            "circle.center=3 circle.full_circle=0",
            "control.cycle_call=1",
            "control.tool_call=1",
            "control.spindle_index=1",
            "control.axis_index=1",
            "control.messages=1",
            "control.translation=1",
            "control.machine_frame=1 home.frame=1",
            "cycle.bore_code=86",
            "cycle.ream_code=89",
            "output.translate_x=5",
            "tool.change_code=none",
            "rapid.split=0",
            "motion.modal=0",
            "cutcom.with_motion=0",
            "cycle.deep_code=none",
        ],
        _ => &[
            "circle.max_degrees=90",
            "circle.full_circle=0",
            "circle.chord_tolerance=0.05",
            "output.translate_x=5",
            "output.translate_z=-3",
            "rapid.split=0",
            "motion.modal=0",
            "cycle.deep_code=none",
            "cycle.deep_code=203",
            "cycle.bore_code=200",
            "tool.preselect=1",
            "cycle.tap_code=206",
        ],
    }
}

/// Keeps a program in the folder that `FILPOST_FAMILIES_KEEP` names.
fn keep(name: &str, job: &Job) {
    let Some(folder) = std::env::var_os("FILPOST_FAMILIES_KEEP").map(PathBuf::from) else { return };
    let nc = posting::post(job).map(|posted| posted.nc).unwrap_or_default();
    for (end, text) in [("ncl", &job.cl), ("nc", &nc)] {
        std::fs::write(folder.join(format!("{name}.{end}")), text).expect("a folder");
    }
}

/// Why a program is refused: the first message, without its numbers.
fn cause(job: &Job) -> String {
    let Err(refused) = posting::post(job) else { return "the machine".to_string() };
    let first = refused.message.lines().next().unwrap_or_default();
    first.chars().map(|c| if c.is_ascii_digit() { 'n' } else { c }).take(90).collect()
}

/// Posts and verifies the programs of the seeds; gives how many agree, and the refusals.
fn verified(ready: &str, odd: &[&str]) -> (u64, BTreeMap<String, u64>) {
    let (mut agree, mut refused) = (0, BTreeMap::new());
    let mut found = Vec::new();
    let given = std::env::var("FILPOST_FAMILIES_SET").ok();
    for seed in seeds() {
        let cl = cl_text(&program(seed));
        let of = |name: &str| Job {
            machine: Machine::Ready(name.to_string()),
            cl: cl.clone(),
            ..Job::default()
        };
        // What the judge finds in any language says nothing about this one, and a comment
        // in brackets is none in these.
        let finds = |name: &&str| posting::verify(&of(name)).is_ok_and(|found| !found.is_empty());
        let is_foreign = FOREIGN.iter().any(|text| cl.contains(text));
        if is_foreign || PLAIN.iter().any(finds) {
            *refused.entry("not compared".to_string()).or_default() += 1;
            continue;
        }
        let settings = odd.get(seed as usize % odd.len().max(1)).copied();
        let settings = settings.map(|usual| given.as_deref().unwrap_or(usual)).into_iter();
        let settings = settings.flat_map(|list| list.split(' '));
        let settings = settings.map(str::to_string).collect();
        let job = Job { settings, ..of(ready) };
        match posting::verify(&job) {
            // A function that the generator takes from other controls.
            Ok(findings) if findings.iter().any(|finding| finding.starts_with("E0904")) => {
                *refused.entry("foreign function".to_string()).or_default() += 1;
            }
            Ok(findings) if findings.is_empty() => agree += 1,
            Ok(findings) => {
                keep(&format!("{ready}-{seed}"), &job);
                let settings = &job.settings;
                found.push(format!("seed {seed} {settings:?}: {}", findings.join("\n  ")));
            }
            Err(_) => *refused.entry(cause(&job)).or_default() += 1,
        }
    }
    assert!(found.is_empty(), "{} of {ready}\n{}", found.len(), found.join("\n"));
    (agree, refused)
}

fn check(ready: &str, odd: &[&str]) {
    let (agree, refused) = verified(ready, odd);
    eprintln!("{ready}: {agree} agree, refused: {refused:#?}");
    let all = seeds().count() as u64;
    assert!(agree * 10 >= all, "only {agree} of {all} agree: {refused:?}");
}

#[test]
fn random_programs_agree_on_a_sinumerik() {
    check("sinumerik-840d", &["control.tool_offsets=1"]);
}

#[test]
fn random_programs_agree_in_klartext() {
    check("heidenhain-tnc640", &["control.tool_offsets=1"]);
}

#[test]
fn random_programs_agree_on_an_odd_sinumerik() {
    check("sinumerik-840d", odd_settings("sinumerik-840d"));
}

#[test]
fn random_programs_agree_in_odd_klartext() {
    check("heidenhain-tnc640", odd_settings("heidenhain-tnc640"));
}

/// The programs of the cases of both families, with the settings of their machines.
fn cases() -> Vec<(Case, String)> {
    let families = ["corpus/klartext", "corpus/sinumerik"];
    let found = families.iter().flat_map(|folder| case::find(&root().join(folder)).expect("cases"));
    let posted = found.filter_map(|case| {
        let nc = case.run().ok()?.0;
        Some((case, String::from_utf8(nc).expect("a text")))
    });
    posted.collect()
}

#[test]
fn programs_are_drawn_over_their_cl_file() {
    let mut count = 0;
    for (case, nc) in cases() {
        let name = case.folder.display().to_string();
        let post = case.program().expect("a post");
        let text = Text { name: "part", bytes: nc.as_bytes() };
        // A text of a case may hold what no reader follows.
        let Ok(mut drawing) = plot::program(text, post.commons()) else { continue };
        let motions = drawing.path.pieces.len();
        let cl = files::read(&case.folder.join(&case.file.cl)).expect("a CL file");
        // The first motion of an axis begins where nobody knows.
        let points = String::from_utf8_lossy(&cl).matches("GOTO").count();
        assert!(motions > 0 || points < 2, "{name}: {motions} motions");
        let text = Text { name: "part.ncl", bytes: &cl };
        let cl = ClText { text, options: Options::default(), unit: None };
        plot::lay_under(&mut drawing, cl, post.commons()).expect(&name);
        count += 1;
    }
    assert!(count > 30, "{count} programs");
}

/// Differences that `diff` finds between two texts.
fn differences(first: &str, second: &str, name: &str) -> usize {
    let options = diff::Options { tolerance: 1e-6, ..diff::Options::default() };
    let read = |text: &str| diff::read(text.as_bytes(), name, &options).expect(name);
    let found = diff::compare(&read(first), &read(second), &options).expect(name);
    found.differences.len()
}

/// A line with its last digit changed; `None` where it says nothing of a motion.
fn with_another_digit(line: &str) -> Option<String> {
    let code = line.split(';').next()?;
    let moves = code.contains(['X', 'Y', 'Z', 'Q', '(']) && !code.contains("PGM");
    let last = code.bytes().rposition(|byte| byte.is_ascii_digit())?;
    let other = if code.as_bytes()[last] == b'9' { "8" } else { "9" };
    let changed = format!("{}{other}{}", &line[..last], &line[last + 1..]);
    (moves && !code.starts_with('%')).then_some(changed)
}

#[test]
fn diff_tells_each_number_that_changes() {
    for (case, nc) in cases() {
        let name = case.folder.display().to_string();
        assert_eq!(differences(&nc, &nc, &name), 0, "{name}");
        let lines: Vec<&str> = nc.lines().collect();
        for (at, line) in lines.iter().enumerate() {
            let Some(changed) = with_another_digit(line) else { continue };
            let mut other = lines.clone();
            other[at] = &changed;
            let other = other.join("\n") + "\n";
            assert!(differences(&nc, &other, &name) > 0, "{name}: {line} became {changed}");
        }
    }
}

/// Three turns whose end lies a last digit beside their start end there, and not at the start.
#[test]
fn full_turns_of_a_helix_end_where_the_cl_file_says() {
    let cl = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 1500, CLW\nFEDRAT / 250, MMPM\nRAPID\n\
              GOTO / 72.7551054384, -30.5663243341, 10\n\
              CIRCLE / 72.7551054385, -31.3710911868, 10, 0, 0, 1, 0.8047668527, TIMES, 3\n\
              GOTO / 72.7540790288, -30.5663249887, 8.7699289267\nRAPID\n\
              GOTO / 72.7540790288, -30.5663249887, 50\nFINI\n";
    for ready in ["heidenhain-tnc640", "sinumerik-840d", "fanuc-mill"] {
        let machine = Machine::Ready(ready.to_string());
        let job = Job { machine, cl: cl.to_string(), ..Job::default() };
        let found = posting::verify(&job).expect("a program");
        assert!(found.is_empty(), "{ready}: {found:?}");
    }
}

#[test]
fn a_changed_program_is_noticed() {
    let cl = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 500, CLW\nFEDRAT / 100, MMPM\nRAPID\n\
              GOTO / 0, 0, 50\nGOTO / 0, 0, 0\nCYCLE / DRILL, DEPTH, 5, MMPM, 50, CLEAR, 1\n\
              GOTO / 10, 0, 0\nCYCLE / OFF\nFINI\n";
    let changes = [
        ("sinumerik-840d", "CYCLE81(1,0,1,-5)", "CYCLE81(1,0,1,-6)"),
        ("sinumerik-840d", "D1", "D2"),
        ("heidenhain-tnc640", "Q201=-5", "Q201=-6"),
    ];
    for (ready, from, to) in changes {
        let job = Job {
            machine: Machine::Ready(ready.to_string()),
            cl: cl.to_string(),
            ..Job::default()
        };
        let nc = posting::post(&job).map_err(|refused| refused.message).expect("a program").nc;
        assert!(nc.contains(from), "{nc}");
        let found = posting::verify_nc(&job, &nc.replace(from, to)).expect("a program");
        assert!(!found.is_empty(), "{ready}: {to}");
    }
}
