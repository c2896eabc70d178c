//! Many posts in one process: what one run takes it gives back.
//!
//! A few hundred are in the normal run; `FILPOST_SOAK=10000` makes as many as it says.

use std::io::Cursor;
use std::sync::Mutex;

use fil_nc::verify::Allowed;
use filpost::verify::NcProgram;
use filpost::{Limits, Program};
use filpost_tests::root;

/// Posts of the normal run.
const FEW: usize = 300;

/// What memory may grow by from the first tenth of the posts to the last, bytes: what an
/// allocator rounds up.
const GROWTH: usize = 4 << 20;

/// A script with loops, arrays, texts and a macro.
const SCRIPT: &str = "\
RESERV/A,500
CIMFIL/ON,GOTO
DO/L1,I=1,500
A(I)=I*2
L1)CONTIN
T=TEXT/'point '
X=POSTF(13)
CIMFIL/OFF
FINI
";

/// Resident memory of the process; `None` where the system does not say.
fn resident() -> Option<usize> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: usize = text.split(' ').nth(1)?.parse().ok()?;
    Some(pages * 4096)
}

/// Two tests do not measure at once.
static ALONE: Mutex<()> = Mutex::new(());

#[test]
fn memory_stays_flat() {
    let _alone = ALONE.lock();
    let asked = std::env::var("FILPOST_SOAK").ok().and_then(|count| count.parse().ok());
    let posts: usize = asked.unwrap_or(FEW);
    let cl = std::fs::read(root().join("tests/cl/holes.ncl.1")).expect("a CL file");
    let plain = Program::builder().generic("fanuc-mill").build().expect("a post");
    let scripted = Program::builder().generic("fanuc-mill").fil("soak.fil", SCRIPT).build();
    let scripted = scripted.expect("a post with a script");
    let mut early = None;
    for number in 0..posts {
        let mut nc = Vec::new();
        let done = match number % 4 {
            // One in four is refused in its middle.
            3 => plain
                .stream(&[&cl[..cl.len() / 2], b"\nGOTO / 1, 2, nonsense\n"].concat()[..], &mut nc),
            2 => scripted.stream(&cl[..], &mut nc),
            1 => {
                // The machine and the script are built anew.
                let post = Program::builder().generic("fanuc-mill").fil("soak.fil", SCRIPT);
                post.build().expect("a post").stream(&cl[..], &mut nc)
            }
            _ => plain.stream(&cl[..], &mut nc),
        };
        assert_eq!(done.is_err(), number % 4 == 3, "post {number}");
        if number % 4 == 0 {
            let program = NcProgram { text: &nc, name: "soak.nc" };
            let report = plain.start().verify(Cursor::new(&cl), program, Allowed::default());
            assert!(report.expect("a report").0.findings.is_empty());
        }
        if number == posts / 10 {
            early = resident();
        }
    }
    let (Some(early), Some(late)) = (early, resident()) else {
        return println!("skipped: the system does not say how much memory a process has");
    };
    println!("{posts} posts: {early} bytes after a tenth of them, {late} at the end");
    assert!(late <= early + GROWTH, "memory grew from {early} to {late} bytes");
}

/// The most that the process has had in memory, bytes; `None` where the system does not say.
fn peak() -> Option<usize> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM"))?;
    let kilobytes: usize = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}

/// A CIRCLE with turns, each of which is four blocks.
fn turns(count: u32) -> Vec<u8> {
    format!(
        "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nFEDRAT / 90, MMPM\nRAPID\nGOTO / 10, 0, 0\n\
         CIRCLE / 0, 0, 0, 0, 0, 1, 10, TIMES, {count}\nGOTO / 10, 0, -50\nFINI\n"
    )
    .into_bytes()
}

/// One record that writes very much: its blocks leave memory while it goes on, and a limit ends it.
#[test]
fn a_circle_of_many_turns_does_not_stay_in_memory() {
    let _alone = ALONE.lock();
    let post = || Program::builder().generic("fanuc-mill").set("circle.max_degrees=90");
    let plain = post().build().expect("a post");
    let (mut few, mut many) = (Count(0), Count(0));
    plain.stream(&turns(2)[..], &mut few).expect("a program of two turns");
    let early = resident();
    plain.stream(&turns(10_000)[..], &mut many).expect("a program of many turns");
    assert!(many.0 > 1_000 * few.0, "{} and {} bytes", few.0, many.0);
    match (early, peak()) {
        (Some(early), Some(late)) => {
            println!("{} bytes of blocks: from {early} to {late} bytes of memory", many.0);
            assert!(late <= early + GROWTH, "memory grew from {early} to {late} bytes");
        }
        _ => println!("skipped: the system does not say how much memory a process has"),
    }
    let limits = Limits { output_bytes: 1 << 20, ..Limits::default() };
    let short = post().limits(limits).build().expect("a post");
    let refused = short.stream(&turns(10_000)[..], &mut Count(0)).expect_err("too long");
    assert!(refused.to_string().contains("E0717"), "{refused}");
}

/// Counts bytes and keeps none.
struct Count(u64);

impl std::io::Write for Count {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0 += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
