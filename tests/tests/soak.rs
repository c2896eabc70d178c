//! Many posts in one process: what one run takes it gives back.
//!
//! A few hundred are in the normal run; `FILPOST_SOAK=10000` makes as many as it says.

use std::io::Cursor;

use fil_nc::verify::Allowed;
use filpost::Program;
use filpost::verify::NcProgram;
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

#[test]
fn memory_stays_flat() {
    let asked = std::env::var("FILPOST_SOAK").ok().and_then(|count| count.parse().ok());
    let posts: usize = asked.unwrap_or(FEW);
    let cl = std::fs::read(root().join("tests/cl/holes.ncl.1")).expect("a CL file");
    let plain = Program::builder().ready("fanuc-mill").build().expect("a post");
    let scripted = Program::builder().ready("fanuc-mill").fil("soak.fil", SCRIPT).build();
    let scripted = scripted.expect("a post with a script");
    let mut early = None;
    for number in 0..posts {
        let mut nc = Vec::new();
        let done = match number % 4 {
            // One in four is refused in its middle.
            3 => plain
                .run(&[&cl[..cl.len() / 2], b"\nGOTO / 1, 2, nonsense\n"].concat()[..], &mut nc),
            2 => scripted.run(&cl[..], &mut nc),
            1 => {
                // The machine and the script are built anew.
                let post = Program::builder().ready("fanuc-mill").fil("soak.fil", SCRIPT);
                post.build().expect("a post").run(&cl[..], &mut nc)
            }
            _ => plain.run(&cl[..], &mut nc),
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
