//! What each fuzz target does with its bytes: nothing may panic, and what can
//! be refused is refused with an error.

#![forbid(unsafe_code)]

use std::sync::LazyLock;

use fil_cl::{ClDialect, Options, Reader, Record, Vocabulary};
use fil_nc::dialect::Dialect;
use fil_nc::diff;
use fil_nc::forward::Forward;
use fil_nc::interpret::interpret;
use fil_nc::motion::Event;
use fil_nc::plot::{Drawing, View, html, nc_trace, svg};
use fil_nc::text::read_block;
use fil_nc::verify::Allowed;
use filpost::map::{Digest, Entry, MapReader};
use filpost::{Builder, Commons, Limits, Program};
use filpost_tests::back_check::{self, Both};
use filpost_tests::duel::{fight, reduce};
use filpost_tests::programs::{Dice, case};
use filpost_tests::tip_program;

/// Small, so that an input takes milliseconds at most.
const LIMITS: Limits = Limits {
    fuel: 2_000,
    call_depth: 16,
    array_elements: 10_000,
    text_bytes: 1 << 20,
    output_bytes: 1 << 24,
};

/// Records for any FIL text.
const RECORDS: &str = "\
UNITS / MM
LOADTL / 1
SPINDL / RPM, 500, CLW
RAPID
GOTO / 1, 2, 3
FEDRAT / 100, MMPM
GOTO / 4, -5, 6.5, 0, 0, 1
CYCLE / DEEP, DEPTH, 9, STEP, 2, MMPM, 90, CLEAR, 1
GOTO / 7, 8, 9
CYCLE / OFF
COOLNT / ON
OP / THREAD, TURN, DEPTH, 1, TPI, 2, MULTRD, 3
FINI
";

/// The ready posts, read once.
static READY: LazyLock<Vec<Commons>> = LazyLock::new(|| {
    let built = |name: &str| Program::builder().generic(name).build().expect("a ready post is right");
    filpost::ready::READY.iter().map(|post| built(post.name).commons().clone()).collect()
});

fn ready(number: u8) -> Builder {
    let commons = &READY[usize::from(number) % READY.len()];
    Program::builder().commons(commons.clone()).limits(LIMITS)
}

/// Posts a CL file; an error is as good as a result.
fn post(post: &Program, cl: &[u8]) {
    let mut nc = Vec::new();
    if post.stream_seekable(std::io::Cursor::new(cl), &mut nc).is_ok() {
        let mut again = Vec::new();
        let _ = post.stream_seekable(std::io::Cursor::new(cl), &mut again);
        assert!(nc == again, "the second run differs");
    }
}

/// Any bytes as a FIL file: read, compiled, run on a few records.
pub fn fil_bytes(data: &[u8]) {
    let Ok((text, _)) = fil_syntax::decode(data, None) else { return };
    if let Ok(built) = ready(1).fil("fuzz.fil", &text).build() {
        post(&built, RECORDS.as_bytes());
    }
}

/// Any bytes as a CL file; the first one chooses the post.
pub fn cl_bytes(data: &[u8]) {
    let Some((first, cl)) = data.split_first() else { return };
    if let Ok(built) = ready(*first).build() {
        post(&built, cl);
    }
}

/// Any bytes as a CL file of a CAM system; the first two choose the system and whether
/// sections see records as they are written. What is read is read the same again.
pub fn dialect_bytes(data: &[u8]) {
    let [system, raw, cl @ ..] = data else { return };
    let dialect = ClDialect::ALL[usize::from(*system) % ClDialect::ALL.len()];
    let options = Options { dialect: Some(dialect), raw: raw % 2 == 1, ..Options::default() };
    let read = || {
        let mut vocabulary = Vocabulary::new();
        let mut record = Record::default();
        let mut reader = Reader::new(cl, "fuzz.ncl", options);
        let mut said = Vec::new();
        while let Ok(true) = reader.read(&mut vocabulary, &mut record) {
            said.push(format!("{record:?}"));
        }
        said
    };
    assert_eq!(read(), read());
    let Ok(built) = ready(*raw).build() else { return };
    let mut nc = Vec::new();
    let _ = built.start().cl_options(options).stream(cl, &mut nc);
}

/// Bytes as an arrangement of two rotary axes anywhere, and as points with tool axes for it:
/// what the post writes must agree with the CL file, by the check that shares nothing
/// with it.
pub fn chains(data: &[u8]) {
    let Some((settings, points)) = data.split_first_chunk::<16>() else { return };
    let Ok(post) = chain(settings).build() else { return };
    let part = turning_part(points);
    let mut nc = Vec::new();
    if post.stream(part.as_bytes(), &mut nc).is_err() {
        return;
    }
    let nc = String::from_utf8(nc).expect("a text");
    let allowed = Allowed::default();
    match back_check::check(post.commons(), &part, &nc, allowed) {
        Ok(report) => assert!(report.findings.is_empty(), "{report:#?}\n{part}\n{nc}"),
        Err(refused) => panic!("{refused}\n{part}\n{nc}"),
    }
}

/// The ready mill with two rotary axes.
fn chain(bytes: &[u8; 16]) -> Builder {
    let number = |at: usize| f64::from(bytes[at]) - 128.0;
    let mut builder = ready(1).set("address.A.format=4443").set("address.B.format=4443");
    builder = builder.set("address.C.format=4443");
    for (name, at) in [("primary", 0), ("secondary", 7)] {
        let mut set = |key: &str, value: f64| {
            builder = std::mem::replace(&mut builder, Program::builder())
                .set(&format!("rotary.{name}_{key}={value}"));
        };
        let axis = bytes[at] % 3;
        set("kind", f64::from(1 + bytes[at] / 3 % 2));
        set("axis", f64::from(1 + axis));
        // Along X, Y or Z, or aslant.
        let aslant = bytes[at] > 200;
        for (n, key) in ["i", "j", "k"].into_iter().enumerate() {
            let along = f64::from(u8::from(n == usize::from(axis)));
            set(key, if aslant { along + number(at + 1 + n) / 256.0 } else { along });
        }
        for (n, key) in ["x", "y", "z"].into_iter().enumerate() {
            set(key, number(at + 4 + n));
        }
    }
    builder.set(&format!("rotary.pivot_distance={}", number(14).abs()))
}

/// A CL file with a point for each six bytes.
fn turning_part(bytes: &[u8]) -> String {
    let mut part = "UNITS / MM\nMULTAX / ON\nLOADTL / 1\nSPINDL / RPM, 500, CLW\n".to_string();
    part.push_str("RAPID\nGOTO / 0, 0, 300, 0, 0, 1\nFEDRAT / 100, MMPM\n");
    for (count, point) in bytes.chunks_exact(6).take(20).enumerate() {
        let value = |n: usize| f64::from(point[n]) - 128.0;
        let axis = [value(3), value(4), 200.0 - value(5).abs()];
        let length = axis.iter().map(|it| it * it).sum::<f64>().sqrt();
        let [i, j, k] = axis.map(|it| it / length);
        if count % 5 == 4 {
            part.push_str("RAPID\n");
        }
        let [x, y, z] = [value(0), value(1), value(2)];
        part.push_str(&format!("GOTO / {x}, {y}, {z}, {i:.9}, {j:.9}, {k:.9}\n"));
    }
    part.push_str("FINI\n");
    part
}

/// Bytes as statements for a control of each family: what the post writes, its own check can
/// follow, and finds nothing.
pub fn controls(data: &[u8]) {
    let Some((first, choices)) = data.split_first() else { return };
    let Ok(post) = ready(*first).build() else { return };
    let cl = statements(choices);
    let mut nc = Vec::new();
    if post.stream(cl.as_bytes(), &mut nc).is_err() {
        return;
    }
    let nc = String::from_utf8(nc).expect("a text");
    match back_check::check(post.commons(), &cl, &nc, Allowed::default()) {
        Ok(report) => assert!(report.findings.is_empty(), "{report:#?}\n{cl}\n{nc}"),
        Err(refused) => panic!("{refused}\n{cl}\n{nc}"),
    }
}

/// A CL file with a statement for each three bytes.
fn statements(choices: &[u8]) -> String {
    let mut cl = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 500, CLW\nFEDRAT / 100, MMPM\n".to_string();
    let mut in_cycle = false;
    for choice in choices.chunks_exact(3).take(60) {
        let [what, one, other] = [choice[0], choice[1], choice[2]];
        let [x, y] = [one, other].map(|it| f64::from(it) / 4.0);
        let text = match what % 12 {
            0..=3 => format!("GOTO / {x}, {y}, {}", f64::from(what) / 8.0),
            4 if !in_cycle => format!("RAPID\nGOTO / {x}, {y}, 50"),
            5 => format!("FEDRAT / {}, MMPM", x + 1.0),
            6 => format!("SPINDL / RPM, {}, {}", y + 50.0, ["CLW", "CCLW"][usize::from(one % 2)]),
            7 => format!("COOLNT / {}", ["ON", "OFF"][usize::from(one % 2)]),
            8 if !in_cycle => format!("DELAY / {}", x / 8.0 + 0.25),
            9 if !in_cycle => {
                in_cycle = true;
                let kind = ["DRILL", "DEEP", "BRKCHP", "BORE", "FACE"][usize::from(one % 5)];
                let step = if matches!(kind, "DEEP" | "BRKCHP") { ", STEP, 2" } else { "" };
                format!("CYCLE / {kind}, DEPTH, {}{step}, MMPM, 90, CLEAR, 1", y / 8.0 + 1.0)
            }
            10 if in_cycle => {
                in_cycle = false;
                format!("CYCLE / OFF\nRAPID\nGOTO / {x}, {y}, 60")
            }
            11 if !in_cycle => format!("RAPID\nGOTO / {x}, {y}, 60\nLOADTL / {}", one % 8 + 1),
            _ => continue,
        };
        cl.push_str(&text);
        cl.push('\n');
    }
    cl.push_str(if in_cycle { "CYCLE / OFF\nFINI\n" } else { "FINI\n" });
    cl
}

/// Any bytes as machine.toml and as an option file.
pub fn machine_bytes(data: &[u8]) {
    let Ok((text, _)) = fil_syntax::decode(data, None) else { return };
    for builder in [
        Program::builder().machine("machine.toml", &text),
        Program::builder().option_file("uncx01.p01", &text),
    ] {
        if let Ok(built) = builder.limits(LIMITS).build() {
            let written = fil_machine::files::write_toml(built.commons());
            let again = fil_machine::files::read_toml("machine.toml", &written);
            // A value without a meaning in an option file warns; by name it is refused.
            let wrong = again.err().unwrap_or_default();
            let readable = wrong.iter().all(|diag| diag.code.name() == "E0605");
            assert!(readable, "what was written can't be read: {wrong:?}\n{written}");
            post(&built, RECORDS.as_bytes());
        }
    }
}

/// Bytes as the choices of the generator of programs: machine against oracle.
pub fn programs(data: &[u8]) {
    let made = case(&mut Dice::from_bytes(data));
    if fight(&made).is_err() {
        let (small, told) = reduce(&made);
        panic!("{told}\n--- FIL\n{}--- CL\n{}", small.fil, small.cl);
    }
}

/// What a reader of NC programs needs of a machine, made once.
struct Machine {
    commons: Commons,
    dialect: Dialect,
    forward: Forward,
}

/// The ready posts, and machines with two rotary axes.
static MACHINES: LazyLock<Vec<Machine>> = LazyLock::new(|| {
    let with_rotary_axes = tip_program::MACHINES.iter().map(|it| it.post().commons().clone());
    let machine = |commons: Commons| Machine {
        dialect: Dialect::new(&commons).expect("a dialect"),
        forward: Forward::from_commons(&commons).expect("axes"),
        commons,
    };
    READY.iter().cloned().chain(with_rotary_axes).map(machine).collect()
});

/// What programs are compared with: motions that turn the tool.
static PART: LazyLock<String> = LazyLock::new(tip_program::part);

/// Events that are drawn and compared; the ones after them are looked at and dropped.
const DRAWN: usize = 5_000;

/// Any bytes as an NC program; the first one chooses the machine, and the two
/// halves of the rest are compared.
pub fn nc_bytes(data: &[u8]) {
    let Some((first, nc)) = data.split_first() else { return };
    let Machine { commons, dialect, forward } = &MACHINES[usize::from(*first) % MACHINES.len()];
    for line in nc.split(|byte| *byte == b'\n') {
        if let Ok(block) = read_block(line, "fuzz.nc", 1) {
            assert!(block.words.iter().all(|word| word.range.end <= line.len()));
        }
    }
    let mut events = Vec::new();
    let _ = interpret(nc, "fuzz.nc", &dialect.skipping_blocks(), &mut |event| finite(&event));
    let _ = interpret(nc, "fuzz.nc", dialect, &mut |event| {
        finite(&event);
        if events.len() < DRAWN {
            events.push(event);
        }
    });
    let drawn = (events.len() < DRAWN).then(|| nc_trace(nc, "fuzz.nc", dialect, forward));
    if let Some(Ok(path)) = drawn {
        let drawing = Drawing { path, ..Drawing::default() };
        for picture in [svg(&drawing, &View::ALL), html(&drawing)] {
            let data = picture.split("<script type=\"module\">").next().unwrap_or_default();
            assert!(!data.contains("NaN,") && !data.contains("inf,"), "{data}");
        }
    }
    compare(nc);
    let allowed = Allowed { between: Some(0.01), ..Allowed::default() };
    let both = Both { all: events, left_out: None };
    if let Ok(report) = back_check::compare(commons, PART.as_bytes(), (nc, &both), allowed) {
        let deviations = [report.position.max, report.axis.max];
        assert!(deviations.iter().all(|max| max.is_finite()), "{report:?}");
    }
}

/// An event has no number that is none.
fn finite(event: &Event) {
    if let Event::Move(motion) = event {
        let mut axes = motion.to.linear.iter().chain(&motion.to.rotary);
        assert!(axes.all(|at| at.is_finite()), "{motion:?}");
    }
}

/// Compares the halves of a program with each other, and each with itself.
fn compare(nc: &[u8]) {
    let (head, tail) = nc.split_at(nc.len() / 2);
    let options = diff::Options::default();
    let read = |text| diff::read(text, "fuzz.nc", &options).ok();
    let halves = [read(head), read(tail)];
    for half in halves.iter().flatten() {
        let same = diff::compare(half, half, &options).expect("a text in memory does not change");
        assert!(same.differences.is_empty(), "a program differs from itself: {same:?}");
    }
    if let [Some(head), Some(tail)] = &halves {
        let found = diff::compare(head, tail, &options);
        for difference in &found.expect("a text in memory does not change").differences {
            assert!(!diff::sentence(difference, head, tail).is_empty());
        }
    }
}

/// Any bytes as a line map.
pub fn map_bytes(data: &[u8]) {
    read_map(data);
    // The same with a last line whose hash agrees, so that what it says is read.
    let [file, lines] = [&b""[..], data].map(|bytes| {
        let Digest { bytes, hash } = Digest::of(bytes);
        format!("{{\"bytes\":{bytes},\"hash\":\"{hash}\"}}")
    });
    let last = format!("{{\"lines\":0,\"cl\":{file},\"nc\":{file},\"map\":{lines}}}\n");
    read_map(&[data, last.as_bytes()].concat());
}

fn read_map(data: &[u8]) {
    let Ok(mut map) = MapReader::new("fuzz.map", std::io::Cursor::new(data)) else { return };
    while let Some(Ok(entry)) = map.next() {
        let Entry::Line(line) = entry else { continue };
        let causes = line.words.iter().map(|word| word.cause).chain([line.cause]);
        causes.filter_map(|cause| map.stack(cause)).for_each(|stack| {
            let _ = map.section(stack);
        });
        line.words.iter().for_each(|word| {
            let _ = word.text("N10 G1 X1.");
        });
    }
}
