//! The FIL machine beside other languages, on one loop of ten million passes:
//! `cargo bench -p filpost-tests --bench language`.
//!
//! The others are started as commands, which say when the loop starts and ends,
//! so that their start-up does not count and one clock times all; a language
//! that is not installed is left out.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Each language runs this often, in turn; the best time counts.
const REPEATS: usize = 10;

const FIL: &str = "
XX=0
NN=0
DO/LA,II=1,10000000
XX=XX+II*2
IF(XX.GT.1000000)THEN
XX=XX-1000000
NN=NN+1
ENDIF
LA) CONTIN
CIMFIL/ON,5000
PPRINT/XX
PPRINT/NN
DMY=POSTF(13)
CIMFIL/OFF
FINI
";

/// The loop in a function with local variables, the fast way in Lua.
const LUA: &str = "
print('start')
io.flush()
local xx, nn = 0.0, 0.0
for ii = 1.0, 10000000.0 do
  xx = xx + ii * 2.0
  if xx > 1000000.0 then
    xx = xx - 1000000.0
    nn = nn + 1.0
  end
end
print(string.format('%.17g %.17g', xx, nn))
";

const PYTHON: &str = "
def loop():
    xx = nn = 0.0
    for ii in range(1, 10000001):
        xx = xx + ii * 2
        if xx > 1000000:
            xx = xx - 1000000
            nn = nn + 1
    return xx, nn
print('start', flush=True)
print(*loop())
";

/// What one run tells: seconds, and the two results.
type Run = [f64; 3];

/// A language that another program runs.
struct Other {
    name: &'static str,
    program: &'static str,
    arguments: &'static [&'static str],
    script: &'static str,
}

const OTHERS: [Other; 3] = [
    Other { name: "Lua 5.4", program: "lua5.4", arguments: &["-e"], script: LUA },
    Other {
        name: "LuaJIT's interpreter",
        program: "luajit",
        arguments: &["-joff", "-e"],
        script: LUA,
    },
    Other { name: "Python 3", program: "python3", arguments: &["-c"], script: PYTHON },
];

fn main() -> Outcome<()> {
    println!("a loop of 10 million passes, best of {REPEATS}\n");
    let mut best = [None; OTHERS.len()];
    let mut own: Option<Run> = None;
    for _ in 0..REPEATS {
        own = faster(own, fil()?);
        for (other, best) in OTHERS.iter().zip(&mut best) {
            if let Some(run) = run_other(other)? {
                *best = faster(*best, run);
            }
        }
    }
    let Some(own) = own else { return Ok(()) };
    println!("{:<24} {:>8}", "language", "seconds");
    println!("{:<24} {:>8.3}", "FIL", own[0]);
    for (other, run) in OTHERS.iter().zip(best) {
        match run {
            Some(run) if run[1..] == own[1..] => println!("{:<24} {:>8.3}", other.name, run[0]),
            Some(run) => return Err(format!("{}: {run:?}, FIL: {own:?}", other.name).into()),
            None => println!("{:<24} skipped, no `{}` here", other.name, other.program),
        }
    }
    if let Some(lua) = best[0] {
        let verdict = if own[0] <= lua[0] { "holds" } else { "DOES NOT HOLD" };
        println!("\ntime against Lua 5.4: {:.2}, {verdict}", own[0] / lua[0]);
    }
    Ok(())
}

fn faster(best: Option<Run>, run: Run) -> Option<Run> {
    Some(best.filter(|best| best[0] <= run[0]).unwrap_or(run))
}

/// Runs the loop as the global area of a FIL file, and a record so that the
/// results come out.
fn fil() -> Outcome<Run> {
    let builder = filpost::Post::builder().ready("linuxcnc-mill").fil("loop.fil", FIL);
    let mut post = builder.build().map_err(|error| format!("{error:?}"))?;
    let mut nc = Vec::new();
    let cl = "FROM / 0, 0, 0\nFINI\n";
    let start = Instant::now();
    post.run(cl.as_bytes(), &mut nc).map_err(|error| format!("{error:?}"))?;
    let time = start.elapsed().as_secs_f64();
    let nc = String::from_utf8(nc)?;
    let mut results = nc.lines().filter_map(|line| {
        let comment = line.split_once('(')?.1.split_once(')')?.0;
        comment.trim().parse().ok()
    });
    let (Some(xx), Some(nn)) = (results.next(), results.next()) else {
        return Err(format!("no results in {nc}").into());
    };
    Ok([time, xx, nn])
}

/// Runs the loop in another language; `None` where it is not installed.
fn run_other(other: &Other) -> Outcome<Option<Run>> {
    let mut command = Command::new(other.program);
    command.args(other.arguments).arg(other.script);
    let Ok(mut child) = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn() else {
        return Ok(None);
    };
    let mut lines = BufReader::new(child.stdout.take().ok_or("no output")?).lines();
    let started = lines.next().transpose()?;
    let start = Instant::now();
    let results = lines.next().transpose()?.unwrap_or_default();
    let time = start.elapsed().as_secs_f64();
    if !child.wait()?.success() || started.is_none() {
        return Ok(None);
    }
    let numbers: Result<Vec<f64>, _> = results.split_whitespace().map(str::parse).collect();
    match numbers?.as_slice() {
        [xx, nn] => Ok(Some([time, *xx, *nn])),
        _ => Err(format!("{} printed {results}", other.program).into()),
    }
}
