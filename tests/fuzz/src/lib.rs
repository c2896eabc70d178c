//! What each fuzz target does with its bytes: nothing may panic, and what can
//! be refused is refused with an error.

#![forbid(unsafe_code)]

use std::sync::LazyLock;

use fil_nc::dialect::Dialect;
use fil_nc::diff;
use fil_nc::forward::Forward;
use fil_nc::interpret::interpret;
use fil_nc::motion::Event;
use fil_nc::plot::{Drawing, View, nc_trace, svg};
use fil_nc::text::read_block;
use fil_nc::verify::Allowed;
use filpost::map::{Digest, Entry, MapReader};
use filpost::{Builder, Commons, Limits, Program};
use filpost_tests::duel::{fight, reduce};
use filpost_tests::programs::{Dice, case};
use filpost_tests::back_check::{self, Both};
use filpost_tests::tip_program;

/// Small, so that an input takes milliseconds at most.
const LIMITS: Limits =
    Limits { fuel: 2_000, call_depth: 16, array_elements: 10_000, text_bytes: 1 << 20 };

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
    let built = |name: &str| Program::builder().ready(name).build().expect("a ready post is right");
    filpost::ready::READY.iter().map(|post| built(post.name).commons().clone()).collect()
});

fn ready(number: u8) -> Builder {
    let commons = &READY[usize::from(number) % READY.len()];
    Program::builder().commons(commons.clone()).limits(LIMITS)
}

/// Posts a CL file; an error is as good as a result.
fn post(post: &Program, cl: &[u8]) {
    let mut nc = Vec::new();
    if post.run_seekable(std::io::Cursor::new(cl), &mut nc).is_ok() {
        let mut again = Vec::new();
        let _ = post.run_seekable(std::io::Cursor::new(cl), &mut again);
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
    let drawing = Drawing { path: nc_trace(&events, forward), ..Drawing::default() };
    let picture = svg(&drawing, &View::ALL);
    assert!(!picture.contains("NaN") && !picture.contains("inf"), "{picture}");
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
        let same = diff::compare(half, half, &options);
        assert!(same.differences.is_empty(), "a program differs from itself: {same:?}");
    }
    if let [Some(head), Some(tail)] = &halves {
        for difference in &diff::compare(head, tail, &options).differences {
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
