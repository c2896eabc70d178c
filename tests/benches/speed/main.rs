//! How fast filpost is beside other programs that do the same job, in one table:
//! `cargo bench -p filpost-tests --bench speed`; `.ci/speed` runs it with all
//! programs it knows how to build.
//!
//! `FILPOST_BENCH_MB` sets the size of the CL files (50).

mod agree;
mod handwritten;
mod inputs;
mod loops;
mod posting;
mod race;

use race::Results;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

fn main() -> Outcome<()> {
    let folder = tempfile::tempdir()?;
    let megabytes = match std::env::var("FILPOST_BENCH_MB") {
        Ok(text) => text.parse()?,
        Err(_) => 50,
    };
    let mut inputs = vec![inputs::generated(folder.path(), megabytes)?];
    inputs.extend(inputs::real(folder.path(), megabytes)?);

    println!();
    race::print_head();
    let mut posted = Vec::new();
    for input in &inputs {
        let results = posting::post_all(input, folder.path())?;
        results.print(&input.name, input.megabytes, "MB");
        posted.push((input.name.as_str(), results));
    }
    let loops = loops::run_all()?;
    loops.print("loop of 10 million", loops::PASSES / 1e6, "M");

    println!();
    for (name, results) in &posted {
        posting_verdicts(name, results);
    }
    verdict("loop, FIL against Lua 5.4", &loops, loops::FIL, loops::LUA, 1.0);
    verdict("loop, FIL against LuaJIT's interpreter", &loops, loops::FIL, loops::LUAJIT, 1.3);
    Ok(())
}

/// What is promised of posting one file.
fn posting_verdicts(input: &str, results: &Results) {
    let what = |way: &str, other: &str| format!("{input}: {way} against {other}");
    let (way, by_hand) = (posting::FILPOST, posting::BY_HAND);
    verdict(&what(way, by_hand), results, way, by_hand, 1.5);
    let mapped = posting::MAPPED;
    verdict(&what(mapped, way), results, mapped, way, 4.0 / 3.0);
    for way in results.ran(posting::FILPOST) {
        verdict(&what(way, posting::LUAJIT), results, way, posting::LUAJIT, 1.0);
    }
}

/// Says whether a program takes at most `most` times the time of another.
fn verdict(what: &str, results: &Results, program: &str, other: &str, most: f64) {
    match (results.seconds(program), results.seconds(other)) {
        (Some(time), Some(measure)) => {
            let ratio = time / measure;
            let holds = if ratio <= most { "holds" } else { "DOES NOT HOLD" };
            println!("{what}: {ratio:.2}, at most {most:.2}: {holds}");
        }
        _ => println!("{what}: not measured"),
    }
}
