//! Right work through the ready posts: what is refused, warned of and found wrong, by cause.

use std::collections::BTreeMap;
use std::process::ExitCode;

use filpost::verify::{Allowed, NcProgram};
use filpost::{Diag, OptionKind, OptionValue, PostOption, Program};
use filpost_tests::plausible::{LATHES, MILLS, MORE_LATHES, MORE_MILLS, busy, milled, turned};
use filpost_tests::programs::Dice;
use rayon::prelude::*;

/// Causes of one kind that are shown.
const SHOWN: usize = 20;

/// Of so many parts one is posted with an option at random.
const WITH_OPTION: usize = 3;

/// The codes of what a machine lacks, a letter, a code or a unit: a part that asks for it is no work
/// for this machine.
const LACKING: [&str; 3] = ["E0502", "E0507", "E0715"];

/// Posts parts as shops have them, and counts what is refused, warned of, and found by verify.
#[derive(clap::Args)]
pub struct Args {
    /// Parts of each kind for each post
    #[arg(long, default_value_t = 20)]
    parts: u64,
    /// Number of the first part
    #[arg(long, default_value_t = 0)]
    from: u64,
    /// Only the post of this name
    #[arg(long)]
    post: Option<String>,
    /// Print the CL text of the first part, and the option that goes with it
    #[arg(long, requires = "post")]
    show: bool,
}

/// What came of one part.
#[derive(Default)]
struct Outcome {
    lacking: Vec<String>,
    refused: Vec<String>,
    warned: Vec<String>,
    found: Vec<String>,
}

/// The causes of one kind.
type Causes = fn(&Outcome) -> &Vec<String>;

/// A kind of parts.
type Kind = (&'static str, fn(u64) -> String);

/// Kinds of milled and of turned parts.
const MILLED: [Kind; 2] = [("milled", milled), ("busy", busy::milled)];
const TURNED: [Kind; 2] = [("turned", turned), ("busy", busy::turned)];

/// A ready post with a kind of its parts.
struct Job {
    post: &'static str,
    options: Vec<PostOption>,
    kind: Kind,
}

/// Runs `cargo xtask plausible`.
///
/// # Errors
/// A ready post that makes no program.
pub fn command(args: &Args) -> Result<ExitCode, String> {
    let mut jobs = Vec::new();
    let groups = [(MILLS, MILLED), (MORE_MILLS, MILLED), (LATHES, TURNED), (MORE_LATHES, TURNED)];
    for (posts, kinds) in groups {
        let is_asked = |post: &&&str| args.post.as_ref().is_none_or(|asked| asked == **post);
        for post in posts.iter().filter(is_asked) {
            let options = program(post, None)?.options().to_vec();
            jobs.extend(kinds.map(|kind| Job { post, options: options.clone(), kind }));
        }
    }
    if args.show {
        for job in &jobs {
            let option = job.option(args.from);
            println!("{} {}: {option:?}\n{}", job.kind.0, args.from, (job.kind.1)(args.from));
        }
        return Ok(ExitCode::SUCCESS);
    }
    let parts: Vec<(&Job, u64)> = jobs
        .iter()
        .flat_map(|job| (args.from..args.from + args.parts).map(move |seed| (job, seed)))
        .collect();
    let outcomes: Vec<(String, Outcome)> = parts
        .par_iter()
        .map(|(job, seed)| {
            let option = job.option(*seed);
            let outcome = outcome(job.post, option.as_ref(), &(job.kind.1)(*seed))?;
            let option = option.map_or(String::new(), |(name, value)| format!(" {name}={value}"));
            Ok((format!("{} {} {seed}{option}", job.post, job.kind.0), outcome))
        })
        .collect::<Result<_, String>>()?;
    println!("{} parts", outcomes.len());
    let kinds: [(&str, Causes); 4] = [
        ("no work for the machine", |outcome| &outcome.lacking),
        ("refused", |outcome| &outcome.refused),
        ("warned of", |outcome| &outcome.warned),
        ("found by verify", |outcome| &outcome.found),
    ];
    for (title, causes) in kinds {
        print(title, &outcomes, causes);
    }
    Ok(ExitCode::SUCCESS)
}

impl Job {
    /// The option that a part is posted with, and its value; none for most.
    fn option(&self, seed: u64) -> Option<(String, String)> {
        let mut dice = Dice::from_seed(seed ^ 0x6f70_7469_6f6e);
        if !dice.once_in(WITH_OPTION) || self.options.is_empty() {
            return None;
        }
        let option = &self.options[dice.below(self.options.len())];
        let value = match (&option.kind, &option.value) {
            (OptionKind::Bool, OptionValue::Bool(value)) => {
                if *value { "no" } else { "yes" }.into()
            }
            (OptionKind::Choice(choices), _) => choices[dice.below(choices.len())].clone(),
            // A number or text means something on one machine alone.
            _ => return None,
        };
        Some((option.name.clone(), value))
    }
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

fn program(post: &str, option: Option<&(String, String)>) -> Result<Program, String> {
    let builder = Program::builder().ready(post);
    let builder = match option {
        Some((name, value)) => builder.option(name, value),
        None => builder,
    };
    builder.build().map_err(|error| error.to_string())
}

/// Posts a part; its program is verified against it.
fn outcome(post: &str, option: Option<&(String, String)>, cl: &str) -> Result<Outcome, String> {
    let program = program(post, option)?;
    let posted = match program.post(cl) {
        Ok(posted) => posted,
        Err(error) => {
            let causes: Vec<String> = error.diags().iter().map(cause).collect();
            let is_of_machine = |cause: &String| LACKING.iter().any(|code| cause.starts_with(code));
            let is_lacking = causes.iter().all(is_of_machine);
            let (lacking, refused) = match is_lacking {
                true => (causes, Vec::new()),
                false => (Vec::new(), causes),
            };
            return Ok(Outcome { lacking, refused, ..Outcome::default() });
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
