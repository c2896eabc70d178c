//! `cargo xtask learn-judge`: hidden posts, which `filpost learn` has to find from their programs.
//!
//! A hidden post is a ready post with some groups of settings changed at random. It posts parts to
//! learn from, and others that are held out. What is learned must write all of them.

use std::collections::BTreeSet;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use fil_learn::{Bases, Pair, Task};
use filpost::Program;

mod groups;
mod shown;

/// Judge `filpost learn` with hidden posts
#[derive(clap::Args)]
pub struct Args {
    /// Seed of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Hidden posts
    #[arg(long, default_value_t = 12)]
    posts: usize,
    /// Only this hidden post, from 1
    #[arg(long)]
    only: Option<usize>,
    /// Options that every hidden post has, such as style=plain; left out where a post lacks them
    #[arg(long, value_name = "NAME=VALUE")]
    option: Vec<String>,
    /// Threads
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// Show what was hidden, what was found and what differs
    #[arg(long)]
    verbose: bool,
}

/// Parts to learn from, and parts held out.
const LEARNED: usize = 3;
const HELD_OUT: usize = 4;

/// Ready posts that are hidden.
const HIDDEN: [&str; 10] = [
    "brother-mill",
    "fanuc-mill",
    "grbl",
    "haas-mill",
    "linuxcnc-mill",
    "mach3-mill",
    "mach4-mill",
    "mazak-mill",
    "mitsubishi-mill",
    "okuma-mill",
];

/// Random numbers, the same everywhere.
pub struct Random(u64);

impl Random {
    /// A number below a bound.
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound.max(1)
    }

    /// One of some things.
    pub fn one<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }
}

/// A part: its name and its CL file.
struct Part {
    name: String,
    cl: String,
}

/// A hidden post with the programs that it makes.
struct Hidden {
    base: &'static str,
    settings: Vec<String>,
    learned: Vec<(usize, Vec<u8>)>,
    held_out: Vec<(usize, Vec<u8>)>,
    /// Each group changes a program that is learned from.
    is_shown: bool,
    /// For each program that is held out: the groups that are shown make it.
    can_be_known: Vec<bool>,
    /// The parts that are learned from at another place: their CL files and programs.
    moved: Vec<(String, Vec<u8>)>,
    /// The tools of these parts in other orders: their CL files and programs.
    recombined: Vec<(String, Vec<u8>)>,
    /// Other posts of this kind that make the same learned programs.
    open: Vec<Program>,
}

/// What became of all hidden posts.
#[derive(Default)]
struct Totals {
    posts: usize,
    learned: usize,
    held_out: (usize, usize),
    as_control: usize,
    refused: usize,
    warned: usize,
    quietly_wrong: usize,
    warned_equal: usize,
    /// Of them those that nothing open would change.
    needless: usize,
    /// Learned parts at another place: equal and without a warning, equal and warned of, wrong
    /// and quiet, all.
    moved: [usize; 4],
    /// Their tools in other orders, where nothing is open.
    recombined: [usize; 4],
    /// Programs that the shown groups make: right ones, and all.
    known: (usize, usize),
    shown: (usize, usize),
    unproven: usize,
    times: Vec<Duration>,
    runs: Vec<u64>,
    /// Seconds of a processor: what a busy machine does not lengthen.
    processor: Vec<f64>,
}

/// Runs the judge.
pub fn command(args: &Args) -> Result<ExitCode, String> {
    let parts = parts()?;
    let mut random = Random(args.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5eed);
    let mut totals = Totals::default();
    for number in 1..=args.posts {
        let hidden = hide(&mut random, &parts, &args.option);
        if args.only.is_some_and(|only| only != number) {
            continue;
        }
        judge(args, number, &hidden, &parts, &mut totals);
    }
    totals.tell(args);
    Ok(ExitCode::SUCCESS)
}

/// The parts of the corpus: milled ones in three axes.
fn parts() -> Result<Vec<Part>, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files: Vec<PathBuf> = Vec::new();
    let cl = root.join("corpus/mills/cl");
    for entry in std::fs::read_dir(&cl).map_err(|error| format!("{}: {error}", cl.display()))? {
        files.push(entry.map_err(|error| error.to_string())?.path());
    }
    files.push(root.join("corpus/tutorial/plate.ncl"));
    files.sort();
    let read = |path: PathBuf| {
        let cl = std::fs::read_to_string(&path).map_err(|error| error.to_string())?;
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        Ok(Part { name: name.unwrap_or_default(), cl })
    };
    files.into_iter().map(read).collect()
}

fn program(base: &str, options: &[String], settings: &[String]) -> Option<Program> {
    let mut builder = Program::builder().machine("hidden.toml", &format!("base = {base:?}\n"));
    for (name, value) in options.iter().filter_map(|option| option.split_once('=')) {
        builder = builder.option(name, value);
    }
    let built = settings.iter().fold(builder, |builder, setting| builder.set(setting)).build();
    match built {
        Ok(program) => Some(program),
        // A post without the option.
        Err(_) if !options.is_empty() => program_without(base, settings),
        Err(_) => None,
    }
}

fn program_without(base: &str, settings: &[String]) -> Option<Program> {
    program(base, &[], settings)
}

fn post(program: &Program, cl: &str) -> Option<(Vec<u8>, Vec<String>)> {
    let mut nc = Vec::new();
    let report = program.start().stream_seekable(Cursor::new(cl.as_bytes()), &mut nc).ok()?;
    let said = |diag: &filpost::Diag| format!("{} {}", diag.code.name(), diag.message);
    Some((nc, report.warnings.iter().map(said).collect()))
}

/// Makes a hidden post that posts enough parts.
fn hide(random: &mut Random, parts: &[Part], options: &[String]) -> Hidden {
    loop {
        let base = *random.one(&HIDDEN);
        let wanted = 3 + random.below(13);
        let mut groups: Vec<Vec<String>> = Vec::new();
        let mut taken = BTreeSet::new();
        for _ in 0..200 {
            if groups.len() == wanted {
                break;
            }
            let (kind, group) = groups::group(random);
            if !taken.insert(kind) {
                continue;
            }
            let with: Vec<String> = groups.iter().flatten().chain(&group).cloned().collect();
            if program(base, options, &with).is_some() {
                groups.push(group);
            }
        }
        let settings: Vec<String> = groups.iter().flatten().cloned().collect();
        let Some(post_of_all) = program(base, options, &settings) else { continue };
        let mut made: Vec<(usize, Vec<u8>)> = (0..parts.len())
            .filter_map(|part| post(&post_of_all, &parts[part].cl).map(|(nc, _)| (part, nc)))
            .collect();
        if made.len() < LEARNED + HELD_OUT {
            continue;
        }
        let mut draw = |count: usize| -> Vec<(usize, Vec<u8>)> {
            (0..count).map(|_| made.swap_remove(random.below(made.len()))).collect()
        };
        let (learned, held_out) = (draw(LEARNED), draw(HELD_OUT));
        let (shown, is_shown) = shown::shown(base, options, &groups, &learned, parts);
        let of_shown = program(base, options, &shown);
        let can_be_known = held_out.iter().map(|(part, nc)| {
            of_shown.as_ref().is_some_and(|program| !shown::changes(program, &parts[*part].cl, nc))
        });
        let can_be_known = can_be_known.collect();
        let cls: Vec<&str> = learned.iter().map(|(part, _)| parts[*part].cl.as_str()).collect();
        let with_program = |cl: String| post(&post_of_all, &cl).map(|(nc, _)| (cl, nc));
        let moved = cls.iter().map(|cl| shown::moved(cl)).filter_map(with_program).collect();
        let open = shown::open_variants(base, options, &settings, &learned, parts);
        let recombined = shown::recombined(&cls).into_iter().filter_map(with_program);
        let recombined = recombined
            .filter(|(cl, nc)| !open.iter().any(|open| shown::changes(open, cl, nc)))
            .collect();
        return Hidden {
            base,
            settings,
            learned,
            held_out,
            is_shown,
            can_be_known,
            moved,
            recombined,
            open,
        };
    }
}

fn judge(args: &Args, number: usize, hidden: &Hidden, parts: &[Part], totals: &mut Totals) {
    let pairs = hidden.learned.iter().map(|(part, nc)| {
        let name = &parts[*part].name;
        Pair::new(name, parts[*part].cl.as_bytes(), &format!("{name}.nc"), nc)
    });
    let task = Task::new(pairs.collect(), Bases::all()).threads(args.threads);
    let (start, processor) = (Instant::now(), processor_seconds());
    let learned = match fil_learn::learn(&task) {
        Ok(learned) => learned,
        Err(error) => {
            println!("{number} {}: {error}", hidden.base);
            totals.posts += 1;
            totals.shown.1 += usize::from(hidden.is_shown);
            totals.held_out.1 += hidden.held_out.len();
            return;
        }
    };
    let time = start.elapsed();
    let processor = processor_seconds() - processor;
    totals.processor.push(processor);
    totals.posts += 1;
    totals.learned += usize::from(learned.is_equal());
    totals.times.push(time);
    totals.runs.push(learned.runs());
    totals.unproven += learned.proofs().filter(|proof| proof.count == 0 && !proof.refused).count();
    let toml = learned.machine_toml();
    let built = Program::builder().machine("machine.toml", &toml).build();
    let mut equal = 0;
    for ((part, nc), is_known) in hidden.held_out.iter().zip(&hidden.can_be_known) {
        totals.held_out.1 += 1;
        totals.known.1 += usize::from(*is_known);
        let made = built.as_ref().ok().and_then(|program| post(program, &parts[*part].cl));
        let Some((ours, warnings)) = made else {
            totals.refused += 1;
            continue;
        };
        let is_equal = ours == *nc;
        let undecided: Vec<&String> =
            warnings.iter().filter(|said| said.starts_with("W0758")).collect();
        let is_warned = !undecided.is_empty();
        equal += usize::from(is_equal);
        let alike = is_equal || read_alike(&ours, nc);
        totals.as_control += usize::from(alike);
        totals.warned += usize::from(!alike && is_warned);
        totals.quietly_wrong += usize::from(!alike && !is_warned);
        totals.warned_equal += usize::from(is_equal && is_warned);
        totals.known.0 += usize::from(is_equal && *is_known);
        let is_open = || hidden.open.iter().any(|open| shown::changes(open, &parts[*part].cl, nc));
        let is_needless = is_equal && is_warned && !is_open();
        totals.needless += usize::from(is_needless);
        if args.verbose && is_equal {
            undecided.iter().for_each(|said| {
                println!("  equal {} (needless: {is_needless}) {said}", parts[*part].name)
            });
        }
        if args.verbose && !is_equal {
            println!(
                "  held out {} (warned: {is_warned}, can be known: {is_known})",
                parts[*part].name
            );
            tell_difference(nc, &ours);
        }
    }
    totals.held_out.0 += equal;
    let known_work = [
        ("moved", &hidden.moved, &mut totals.moved),
        ("recombined", &hidden.recombined, &mut totals.recombined),
    ];
    for (kind, programs, counts) in known_work {
        for (cl, nc) in programs {
            let made = built.as_ref().ok().and_then(|program| post(program, cl));
            let (ours, mut warnings) = made.unwrap_or_default();
            let is_refused = ours.is_empty();
            warnings.retain(|said| said.starts_with("W0758"));
            let is_warned = is_refused || !warnings.is_empty();
            let at = [(true, false), (true, true), (false, false)];
            let at = at.iter().position(|kind| *kind == (ours == *nc, is_warned));
            at.into_iter().chain([3]).for_each(|at| counts[at] += 1);
            if args.verbose && at != Some(0) {
                println!("  {kind} (equal: {}, refused: {is_refused}) {warnings:?}", ours == *nc);
                tell_difference(nc, &ours);
            }
        }
    }
    let all = equal == hidden.held_out.len();
    totals.shown.0 += usize::from(hidden.is_shown && all);
    totals.shown.1 += usize::from(hidden.is_shown);
    println!(
        "{number} {}: {} settings hidden, {} found over {}, learned {}, held out {equal}/{}, shown {}, {} runs, {:.1} s, {processor:.1} s of a processor",
        hidden.base,
        hidden.settings.len(),
        learned.proofs().count(),
        learned.base(),
        learned.is_equal(),
        hidden.held_out.len(),
        hidden.is_shown,
        learned.runs(),
        time.as_secs_f64(),
    );
    if let Err(error) = &built {
        println!("  machine.toml can't be read: {error}\n{toml}");
    }
    if args.verbose {
        println!("  hidden {}", hidden.settings.join("; "));
        for proof in learned.proofs() {
            println!("  found {} = {} ({})", proof.key, proof.value, proof.count);
        }
        for pair in learned.pairs().iter().filter(|pair| !pair.is_equal) {
            println!("  not learned {} {} of {}", pair.nc_name, pair.equal, pair.blocks);
            for (line, proven, ours) in pair.left.iter().take(6) {
                println!("    {line} - {proven:?}\n    {line} + {ours:?}");
            }
        }
    }
}

/// Seconds of a processor that this process has used, where the system tells (Linux); else 0.
fn processor_seconds() -> f64 {
    const TICKS_A_SECOND: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = stat.rsplit_once(')').map_or("", |(_, rest)| rest);
    let ticks =
        |at: usize| after_name.split_whitespace().nth(at).and_then(|t| t.parse::<f64>().ok());
    (ticks(11).unwrap_or(0.0) + ticks(12).unwrap_or(0.0)) / TICKS_A_SECOND
}

/// As a control reads both programs.
fn read_alike(ours: &[u8], proven: &[u8]) -> bool {
    let words = |text: &[u8]| -> Vec<String> {
        let text = String::from_utf8_lossy(text).to_ascii_uppercase();
        let lines = text.lines().map(|line| {
            let mut line = line.trim();
            if let Some(rest) = line.strip_prefix('N') {
                line = rest.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
            }
            let mut out = String::new();
            let mut number = String::new();
            let flush = |number: &mut String, out: &mut String| {
                if let Ok(value) = number.parse::<f64>() {
                    out.push_str(&value.to_string());
                } else {
                    out.push_str(number);
                }
                number.clear();
            };
            for c in line.chars().filter(|c| !c.is_whitespace()) {
                if c.is_ascii_digit() || "+-.".contains(c) {
                    number.push(c);
                } else {
                    flush(&mut number, &mut out);
                    out.push(c);
                }
            }
            flush(&mut number, &mut out);
            out
        });
        lines.filter(|line| !line.is_empty()).collect()
    };
    words(ours) == words(proven)
}

fn tell_difference(proven: &[u8], ours: &[u8]) {
    let [proven, ours] = [proven, ours].map(|text| String::from_utf8_lossy(text).into_owned());
    let (proven, ours): (Vec<&str>, Vec<&str>) = (proven.lines().collect(), ours.lines().collect());
    for line in 0..proven.len().max(ours.len()) {
        let (a, b) = (proven.get(line), ours.get(line));
        if a != b {
            println!("    {} - {:?}\n    {} + {:?}", line + 1, a, line + 1, b);
            if line > 30 {
                break;
            }
        }
    }
}

impl Totals {
    fn tell(&mut self, args: &Args) {
        let percent = |part: usize, of: usize| 100.0 * part as f64 / of.max(1) as f64;
        self.times.sort();
        self.runs.sort_unstable();
        let (posts, (held, of)) = (self.posts, self.held_out);
        println!("posts whose programs all come out: {} of {posts}", self.learned);
        println!("held out, byte for byte: {held} of {of} ({:.0} %)", percent(held, of));
        println!("held out, as a control reads them: {} of {of}", self.as_control);
        println!(
            "posts whose groups are all shown, all held out right: {} of {}",
            self.shown.0, self.shown.1
        );
        println!(
            "held out, of those that the shown groups make: {} of {}",
            self.known.0, self.known.1
        );
        println!(
            "held out and refused: {}, wrong and warned of: {}, quietly wrong: {}",
            self.refused, self.warned, self.quietly_wrong
        );
        println!(
            "warned of and equal: {} ({:.0} %), of them needless: {} ({:.0} %)",
            self.warned_equal,
            percent(self.warned_equal, held),
            self.needless,
            percent(self.needless, held)
        );
        let known_work = [
            ("learned parts at another place", self.moved),
            ("their tools in other orders, nothing open", self.recombined),
        ];
        for (title, [quiet, warned, wrong, all]) in known_work {
            println!(
                "{title}: {quiet} of {all} equal without a warning, {warned} equal and warned of ({:.0} %), {wrong} quietly wrong",
                percent(warned, quiet + warned),
            );
        }
        println!("settings without a proof: {}", self.unproven);
        let median = self.times.get(self.times.len() / 2).copied().unwrap_or_default();
        let worst = self.times.last().copied().unwrap_or_default();
        let runs = self.runs.get(self.runs.len() / 2).copied().unwrap_or_default();
        self.processor.sort_by(f64::total_cmp);
        println!(
            "seconds of a processor: {:.1} median, {:.1} most",
            self.processor.get(self.processor.len() / 2).copied().unwrap_or_default(),
            self.processor.last().copied().unwrap_or_default(),
        );
        println!(
            "seed {}: {:.0} % learned, {:.0} % held out, {:.1} s median, {:.1} s worst, {runs} runs median",
            args.seed,
            percent(self.learned, posts),
            percent(held, of),
            median.as_secs_f64(),
            worst.as_secs_f64(),
        );
    }
}
