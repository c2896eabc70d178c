//! Right work through the ready posts: what is refused, warned of and found wrong, by cause.

use std::collections::BTreeMap;
use std::process::ExitCode;

use filpost::verify::{Allowed, NcProgram};
use filpost::{Diag, Program};
use filpost_tests::plausible::{LATHES, MILLS, milled, turned};
use rayon::prelude::*;

/// Causes of one kind that are shown.
const SHOWN: usize = 20;

/// Posts parts as shops have them, and counts what is refused, warned of, and found by verify.
#[derive(clap::Args)]
pub struct Args {
    /// Parts for each post
    #[arg(long, default_value_t = 40)]
    parts: u64,
    /// Number of the first part
    #[arg(long, default_value_t = 0)]
    from: u64,
}

/// What came of one part.
#[derive(Default)]
struct Outcome {
    refused: Vec<String>,
    warned: Vec<String>,
    found: Vec<String>,
}

/// The causes of one kind.
type Causes = fn(&Outcome) -> &Vec<String>;

/// Runs `cargo xtask plausible`.
///
/// # Errors
/// A ready post that makes no program.
pub fn command(args: &Args) -> Result<ExitCode, String> {
    let seeds = args.from..args.from + args.parts;
    let of = |posts: &'static [&'static str], make: fn(u64) -> String| {
        let seeds = seeds.clone();
        posts.iter().flat_map(move |post| seeds.clone().map(move |seed| (*post, seed, make)))
    };
    let parts: Vec<_> = of(MILLS, milled).chain(of(LATHES, turned)).collect();
    let outcomes: Vec<(String, Outcome)> = parts
        .par_iter()
        .map(|(post, seed, make)| {
            let outcome = outcome(post, &make(*seed))?;
            Ok((format!("{post} {seed}"), outcome))
        })
        .collect::<Result<_, String>>()?;
    println!("{} parts", outcomes.len());
    let kinds: [(&str, Causes); 3] = [
        ("refused", |outcome| &outcome.refused),
        ("warned of", |outcome| &outcome.warned),
        ("found by verify", |outcome| &outcome.found),
    ];
    for (title, causes) in kinds {
        print(title, &outcomes, causes);
    }
    Ok(ExitCode::SUCCESS)
}

fn print(title: &str, outcomes: &[(String, Outcome)], causes: Causes) {
    let mut by_cause: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (part, outcome) in outcomes {
        for cause in causes(outcome) {
            let parts = by_cause.entry(cause).or_default();
            if parts.last() != Some(&&part[..]) {
                parts.push(part);
            }
        }
    }
    let count = outcomes.iter().filter(|(_, outcome)| !causes(outcome).is_empty()).count();
    println!("{title}: {count} ({:.1} %)", 100.0 * count as f64 / outcomes.len().max(1) as f64);
    let mut rows: Vec<_> = by_cause.into_iter().collect();
    rows.sort_by_key(|(_, parts)| std::cmp::Reverse(parts.len()));
    for (cause, parts) in rows.into_iter().take(SHOWN) {
        println!("{:6}  {cause}; first {}", parts.len(), parts[0]);
    }
}

/// Posts a part; its program is verified against it.
fn outcome(post: &str, cl: &str) -> Result<Outcome, String> {
    let program = Program::builder().ready(post).build().map_err(|error| error.to_string())?;
    let posted = match program.post(cl) {
        Ok(posted) => posted,
        Err(error) => {
            let refused = error.diags().iter().map(cause).collect();
            return Ok(Outcome { refused, ..Outcome::default() });
        }
    };
    let nc = NcProgram { text: posted.bytes(), name: "part.nc" };
    let found = match program.start().verify(cl.as_bytes(), nc, Allowed::default()) {
        Ok((report, _)) => report.findings.iter().map(|one| plain(&one.to_string())).collect(),
        Err(error) => error.diags().iter().map(cause).collect(),
    };
    let warned = posted.report().warnings.iter().map(cause).collect();
    Ok(Outcome { warned, found, ..Outcome::default() })
}

/// Code and message of a refusal or warning, without its numbers.
fn cause(diag: &Diag) -> String {
    format!("{} {}", diag.code.name(), plain(&diag.message))
}

/// A text with `#` for each number.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    for letter in text.chars() {
        let is_number = letter.is_ascii_digit() || letter == '.' && plain.ends_with('#');
        match is_number {
            true if plain.ends_with('#') => {}
            true => plain.push('#'),
            false => plain.push(letter),
        }
    }
    plain
}
