//! Random CL programs through the post and LinuxCNC's interpreter: what the
//! machine does must be what the CL asks for, or the post must have refused it
//! where it may.

use std::collections::BTreeMap;
use std::path::Path;
use std::{env, ops::Range};

use fil_nc::verify::Allowed;
use filpost_tests::back_check;
use filpost_tests::programs::Dice;
use filpost_tests::random::lathe_make;
use filpost_tests::random::make::{Program, program};
use filpost_tests::random::shrink::shrink;
use filpost_tests::random::statement::Statement;
use filpost_tests::random::verdict::{Verdict, cl_text, judge, judge_changed, nc_text};
use filpost_tests::rs274;

/// Programs that one process of the interpreter runs.
const BATCH: u64 = 100;

/// Differences that are made small and told, one of each class.
const STORIES: usize = 12;

/// How programs came out.
#[derive(Default)]
struct Tally {
    agree: u64,
    unpredictable: u64,
    refused: BTreeMap<String, u64>,
    /// Seeds of the programs that differ, by class.
    differ: BTreeMap<String, Vec<u64>>,
}

/// Makes the program of a seed.
type Make = fn(u64) -> Program;

fn tally(rs274: &Path, make: Make, seeds: Range<u64>) -> Tally {
    let mut tally = Tally::default();
    let mut first = seeds.start;
    while first < seeds.end {
        let last = (first + BATCH).min(seeds.end);
        let programs: Vec<Program> = (first..last).map(make).collect();
        for (seed, verdict) in (first..).zip(judge(rs274, &programs)) {
            match verdict {
                Verdict::Agrees => tally.agree += 1,
                Verdict::Unpredictable => tally.unpredictable += 1,
                Verdict::Refused(code) => *tally.refused.entry(code).or_default() += 1,
                Verdict::Differs(difference) => {
                    tally.differ.entry(difference.class()).or_default().push(seed);
                }
            }
        }
        first = last;
    }
    tally
}

/// A program made small, with all that explains it.
fn story(rs274: &Path, make: Make, seed: u64) -> String {
    let drawn = make(seed);
    let whole = judge(rs274, std::slice::from_ref(&drawn)).pop();
    let small = shrink(rs274, &drawn);
    let verdict = judge(rs274, std::slice::from_ref(&small)).pop();
    let setup = &small.setup;
    format!(
        "seed {seed}: {whole:?}; made small: {verdict:?}\n--- {} {}{}\n{}--- NC\n{}",
        setup.ready,
        setup.settings.join(" "),
        if setup.hostile { " (hostile start)" } else { "" },
        cl_text(&small),
        nc_text(&small),
    )
}

fn agree(rs274: &Path, make: Make, seeds: Range<u64>) {
    let count = seeds.end - seeds.start;
    let tally = tally(rs274, make, seeds);
    let refused: u64 = tally.refused.values().sum();
    println!(
        "{count} programs: {} agree, {refused} refused {:?}, {} unpredictable",
        tally.agree, tally.refused, tally.unpredictable,
    );
    for (class, seeds) in &tally.differ {
        let first = &seeds[..seeds.len().min(10)];
        println!("{} differ: {class}, seeds {first:?}", seeds.len());
    }
    let stories: Vec<String> = tally
        .differ
        .values()
        .filter_map(|seeds| seeds.first())
        .take(STORIES)
        .map(|seed| story(rs274, make, *seed))
        .collect();
    assert!(stories.is_empty(), "{}", stories.join("\n"));
    assert!(tally.agree * 10 > count * 6, "too few programs are posted to prove anything");
}

/// Changes one word of a program so that the machine does something else: an axis
/// goes elsewhere, an arc turns round, a rapid becomes a cut, a speed or an offset is another.
fn with_a_fault(nc: &str, dice: &mut Dice<'static>) -> Option<String> {
    let lines: Vec<&str> = nc.lines().collect();
    let at = dice.below(lines.len());
    let words: Vec<&str> = lines[at].split(' ').collect();
    let word = dice.below(words.len());
    let faulty = fault(words[word])?;
    let rest = |(index, old)| if index == word { faulty.clone() } else { String::from(old) };
    let block: Vec<String> = words.iter().copied().enumerate().map(rest).collect();
    let block = block.join(" ");
    let program = lines.iter().enumerate();
    let program = program.map(|(index, line)| if index == at { &block[..] } else { line });
    Some(program.map(|line| format!("{line}\n")).collect())
}

fn fault(word: &str) -> Option<String> {
    let turned = match word {
        "G0" => "G1",
        "G1" => "G0",
        "G2" => "G3",
        "G3" => "G2",
        "G20" => "G21",
        "G21" => "G20",
        "G40" => "G41",
        "G41" => "G42",
        "G42" => "G41",
        "G94" => "G95",
        "G95" => "G94",
        "G98" => "G99",
        "M3" => "M4",
        "M4" => "M3",
        "M8" => "M9",
        _ => "",
    };
    if !turned.is_empty() {
        return Some(turned.to_string());
    }
    let (letter, number) = word.split_at_checked(1)?;
    let value: f64 = number.parse().ok()?;
    match letter {
        "X" | "Y" | "Z" | "I" | "J" | "K" => Some(format!("{letter}{:.4}", value + 0.03)),
        // A short arc hardly depends on its radius.
        "R" => Some(format!("R{:.4}", value * 1.2)),
        "F" => Some(format!("F{:.3}", value * 1.1)),
        "S" | "T" | "H" => Some(format!("{letter}{}", value + 1.0)),
        _ => None,
    }
}

/// A comparison that finds nothing would agree with everything.
#[test]
fn changed_programs_are_noticed() {
    let Some(rs274) = rs274::program() else { return };
    changes_are_noticed(&rs274, program);
}

#[test]
fn changed_lathe_programs_are_noticed() {
    changes_are_noticed(Path::new("none"), lathe_make::program);
}

fn changes_are_noticed(rs274: &Path, make: Make) {
    let blanks = |program: &Program| !program.setup.settings.contains(&"tape.blank=1".to_string());
    let posted = |program: &Program| !nc_text(program).starts_with("refused");
    let programs = (0..150).map(make).filter(blanks).filter(posted);
    let programs: Vec<Program> = programs.collect();
    let mut dice = Dice::from_seed(1);
    let mut changed = Vec::new();
    let verdicts = judge_changed(rs274, &programs, |nc| {
        let faulty = (0..100).find_map(|_| with_a_fault(&nc, &mut dice)).unwrap_or(nc.clone());
        changed.push((nc, faulty.clone()));
        faulty
    });
    let quiet: Vec<_> = verdicts
        .iter()
        .zip(&changed)
        .filter(|(verdict, _)| **verdict == Verdict::Agrees)
        .map(|(_, (nc, faulty))| difference(nc, faulty))
        .collect();
    println!("{} of {} changes are not noticed", quiet.len(), changed.len());
    // Some changes are less than what rounding may make of them.
    assert!(quiet.len() * 10 < changed.len(), "{quiet:#?}");
}

/// The line that two programs differ in.
fn difference(nc: &str, faulty: &str) -> String {
    let mut lines = nc.lines().zip(faulty.lines());
    let (old, new) = lines.find(|(old, new)| old != new).unwrap_or(("", ""));
    format!("{old} became {new}")
}

/// FILPOST_RANDOM=first,count chooses other seeds than the first 200.
fn seeds() -> Range<u64> {
    let Ok(chosen) = env::var("FILPOST_RANDOM") else { return 0..200 };
    let numbers = chosen.split_once(',').and_then(|(first, count)| {
        Some((first.trim().parse::<u64>().ok()?, count.trim().parse::<u64>().ok()?))
    });
    let (first, count) = numbers.expect("FILPOST_RANDOM=first,count");
    first..first + count
}

#[test]
fn random_programs_do_what_their_cl_says() {
    let Some(rs274) = rs274::program() else { return };
    agree(&rs274, program, seeds());
}

/// The programs of lathes are run by an interpreter of the tests' own.
#[test]
fn random_lathe_programs_do_what_their_cl_says() {
    agree(Path::new("none"), lathe_make::program, seeds());
}

/// Those of a lathe of LinuxCNC by LinuxCNC's interpreter.
#[test]
fn random_programs_of_a_linuxcnc_lathe_do_what_their_cl_says() {
    let Some(rs274) = rs274::program() else { return };
    agree(&rs274, lathe_make::linuxcnc_program, seeds());
}

/// A text may bend the path.
fn is_left_out(program: &Program) -> bool {
    program.statements.iter().any(|statement| matches!(statement, Statement::Insert(_)))
}

/// The back-check finds nothing in programs of lathes.
#[test]
fn verify_finds_nothing_in_programs_of_lathes() {
    for make in [lathe_make::linuxcnc_program as Make, lathe_make::program] {
        let (mut checked, mut wrong) = (0, Vec::new());
        for seed in seeds() {
            let program = make(seed);
            let (cl, nc) = (cl_text(&program), nc_text(&program));
            if nc.starts_with("refused") || is_left_out(&program) {
                continue;
            }
            let mut post = filpost::Program::builder().generic(program.setup.ready);
            for setting in &program.setup.settings {
                post = post.set(setting);
            }
            let post = post.build().unwrap();
            let said = match back_check::check(post.commons(), &cl, &nc, Allowed::default()) {
                Ok(report) => report.findings.iter().map(|one| format!("{one}\n")).collect(),
                Err(diag) => format!("{diag:?}"),
            };
            checked += 1;
            if !said.is_empty() {
                wrong.push(format!("seed {seed}: {said}--- CL\n{cl}--- NC\n{nc}"));
            }
        }
        println!("{checked} programs checked, {} with findings", wrong.len());
        assert!(wrong.is_empty(), "{}", wrong[..wrong.len().min(4)].join("\n"));
        assert!(checked > 0);
    }
}
