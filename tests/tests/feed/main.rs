//! Feed control for ball-end milling: the two scripts of `fil-scripts/papers/`
//! against what the paper prints and against its formulas, evaluated on their own
//! in `filpost_tests::feed`.

mod look_ahead;
mod page;
mod published;
mod refused;

use filpost::{Diag, Error, Program};
use filpost_tests::feed::Point;
use filpost_tests::posting::with_script;
use filpost_tests::root;

const CASE: &str = "corpus/papers/feed-control-l400";
const SCRIPTS: [&str; 2] = ["feed-l400.fil", "feed-ahead.fil"];

fn read(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The CL file of both cases.
fn pass_cl() -> String {
    read(&format!("{CASE}/pass.ncl"))
}

/// NC program and warnings of a CL file, with a script of `fil-scripts/papers/`.
fn post(script: Option<&str>, cl: &str) -> Result<(String, Vec<Diag>), Error> {
    let machine = read(&format!("{CASE}/machine.toml"));
    let mut builder = Program::builder().machine("machine.toml", &machine);
    if let Some(script) = script {
        let text = read(&format!("fil-scripts/papers/{script}"));
        builder = with_script(builder, script, &text);
    }
    let post = builder.build()?;
    let mut nc = Vec::new();
    let report = post.start().cl_name("pass.ncl").stream(cl.as_bytes(), &mut nc)?;
    let mut warnings: Vec<Diag> = post.warnings().iter().cloned().chain(report.warnings).collect();
    // How POSTF is read is said of each script that asks for the items of a record.
    warnings.retain(|warning| warning.code.name() != "W0218");
    Ok((String::from_utf8(nc).expect("an NC program is text"), warnings))
}

/// Points of the pass: all GOTO of the CL file but the last, which leads away.
fn points(cl: &str) -> Vec<Point> {
    let goto = cl.lines().filter_map(|line| line.strip_prefix("GOTO / "));
    let point = |line: &str| {
        let numbers: Vec<f64> =
            line.split(',').map(|n| n.trim().parse().expect("a number")).collect();
        <Point>::try_from(numbers).expect("three coordinates")
    };
    let mut points: Vec<Point> = goto.map(point).collect();
    points.pop();
    points
}

/// End points and feeds of the G1 moves of a program of plain words.
fn cuts(nc: &str) -> Vec<(Point, f64)> {
    let (mut at, mut feed, mut cutting) = ([0.0; 3], 0.0, false);
    let mut cuts = Vec::new();
    for line in nc.lines() {
        let mut moved = false;
        for word in line.split_whitespace() {
            let (letter, number) = word.split_at(1);
            let number: f64 = number.parse().unwrap_or_else(|_| panic!("{word} in {line}"));
            match letter {
                "G" => cutting = number == 1.0,
                "X" | "Y" | "Z" => {
                    at["XYZ".find(letter).expect("one of the three")] = number;
                    moved = true;
                }
                "F" => feed = number,
                "N" | "S" | "M" => {}
                _ => panic!("{word} in {line}"),
            }
        }
        if moved && cutting {
            cuts.push((at, feed));
        }
    }
    cuts
}

/// What a script says under `--strict`: extensions alone, and only those that its
/// head names.
#[test]
fn the_head_of_a_script_names_its_extensions() {
    for script in SCRIPTS {
        let text = read(&format!("fil-scripts/papers/{script}"));
        let head: String = text.lines().take_while(|line| line.starts_with("$$")).collect();
        let path = root().join("fil-scripts/papers").join(script);
        let mut loader = filpost::includes::beside(std::slice::from_ref(&path), None);
        let options = filpost::check::Options {
            strict: true,
            includes: Some(&mut loader),
            ..Default::default()
        };
        let name = path.to_string_lossy();
        let mut found = filpost::check::check(&[(&name, &text)], options);
        // What it includes has a head of its own.
        found.retain(|diag| diag.spans.iter().any(|span| span.file == name));
        assert!(!found.is_empty(), "{script} needs no extension and its head says it does");
        for diag in found {
            let word = diag.message.strip_suffix(" is an extension");
            let word = word.unwrap_or_else(|| panic!("{script}: {diag}")).trim_end_matches('/');
            assert!(head.contains(word), "the head of {script} does not name {word}");
        }
    }
}
