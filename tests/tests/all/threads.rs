//! Whole threads: random ones in every form that the posts write. An expander of this file,
//! which knows the controls' cycles from their manuals, turns each program into passes, and
//! these must be those that the thread asks for; the back-check must find nothing in
//! the program, and something in one with a changed word. LinuxCNC's own interpreter says what
//! its G76 and G33 do.

use std::collections::BTreeMap;
use std::env;
use std::io::Cursor;
use std::path::Path;

use filpost::Program;
use filpost::nc::verify::Allowed;
use filpost::verify::NcProgram;
use filpost_tests::programs::Dice;
use filpost_tests::rs274::{self, Canon};
use rayon::prelude::*;

/// A thread, mm; X as a radius.
#[derive(Debug)]
struct Spec {
    outside: bool,
    x: [f64; 2],
    z: [f64; 2],
    pitch: f64,
    starts: u32,
    first: f64,
    depth: f64,
    springs: u32,
    angle: f64,
    clearance: f64,
}

/// One pass: where it begins and ends (X as a radius, Z), and its lead along the longer axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cut {
    from: [f64; 2],
    to: [f64; 2],
    lead: f64,
}

/// A form: the ready post and settings on top of it.
const FORMS: [(&str, &[&str]); 11] = [
    ("fanuc-lathe", &["thread.cycle=0"]),
    ("fanuc-lathe", &["thread.cycle=1", "thread.cycle_code=92"]),
    ("fanuc-lathe", &[]),
    ("haas-lathe", &[]),
    ("linuxcnc-lathe", &[]),
    ("sinumerik-lathe", &[]),
    ("fanuc-lathe", &["thread.cycle=0", "thread.chamfer=0.2"]),
    ("fanuc-lathe", &["thread.chamfer=0.2"]),
    ("haas-lathe", &[M23, M24, "thread.chamfer_tenths=2", "thread.chamfer=0.2"]),
    (
        "fanuc-lathe",
        &[
            "thread.cycle=1",
            "thread.cycle_code=92",
            M23,
            M24,
            "thread.chamfer_tenths=2",
            "thread.chamfer=0.2",
        ],
    ),
    ("linuxcnc-lathe", &["thread.chamfer=0.5"]),
];

/// Codes that switch the way out of a thread.
const M23: &str = "thread.chamfer_on_code=23";
const M24: &str = "thread.chamfer_off_code=24";

/// The forms from this one on leave each pass at 45 degrees, on two tenths of the lead.
const LEAVING: usize = 6;

/// This one on half the lead, which is as long as its threads are deep.
const AS_DEEP: usize = 10;

/// One block of G76: the control counts the passes at full depth.
const ONE_BLOCK: [usize; 2] = [3, 8];

/// G76 of LinuxCNC.
const LINUXCNC: [usize; 2] = [4, AS_DEEP];

/// Whole threads that their cycle can say are one G76.
const BY_G76: [usize; 6] = [2, 3, 4, 7, 8, AS_DEEP];

impl Spec {
    fn random(seed: u64) -> Spec {
        let mut dice = Dice::from_seed(seed);
        let micron = |value: f64| (value * 1000.0).round() / 1000.0;
        let x = micron(dice.between(10.0, 40.0));
        let z = [micron(dice.between(2.0, 8.0)), micron(dice.between(-40.0, -8.0))];
        let backwards = dice.once_in(6);
        let depth = micron(dice.between(0.3, 3.0));
        let lean = if dice.once_in(3) { micron(dice.between(-2.0, 2.0)) } else { 0.0 };
        Spec {
            outside: dice.once_in(2),
            x: [x, x + lean],
            z: if backwards { [z[1], z[0]] } else { z },
            pitch: micron(dice.between(0.5, 4.0)),
            starts: if dice.once_in(3) { 1 + dice.below(4) as u32 } else { 1 },
            first: micron(dice.between(0.1, 0.9) * depth),
            depth,
            springs: 1 + dice.below(3) as u32,
            angle: [0.0, 29.0, 30.0, 55.0, 60.0, 80.0][dice.below(6)],
            clearance: micron(dice.between(0.5, 4.0)),
        }
    }

    /// The same as a form can say it.
    fn of_form(seed: u64, form: usize) -> Spec {
        let spec = Spec::random(seed);
        if form != AS_DEEP {
            return spec;
        }
        let depth = 0.5 * spec.pitch * f64::from(spec.starts);
        let first = (spec.first / spec.depth * depth * 1000.0).ceil() / 1000.0;
        Spec { first, depth, ..spec }
    }

    fn cl(&self) -> String {
        let [x1, x2] = self.x;
        let [z1, z2] = self.z;
        let side = if self.outside { "OUT" } else { "IN" };
        let at = if self.outside { x1.max(x2) + 6.0 } else { 1.0 };
        format!(
            "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 400, CLW\nRAPID\nGOTO / {at}, 0, {z1}\n\
             THREAD / AUTO, {x1}, 0, {z1}, TO, {x2}, 0, {z2}, MMPR, {}, DEEP, {}, LAST, {}, TYPE, 0, \
             {}, {}, FEDTO, {}, {side}, TIMES, {}\nRAPID\nGOTO / {at}, 0, {z1}\nFINI\n",
            self.pitch,
            self.first,
            self.springs,
            self.depth,
            self.angle,
            self.clearance,
            self.starts
        )
    }

    /// The way on which a pass of a form leaves the thread.
    fn leaves(&self, form: usize) -> f64 {
        let lead = self.pitch * f64::from(self.starts);
        match form {
            ..LEAVING => 0.0,
            AS_DEEP => 0.5 * lead,
            _ => 0.2 * lead,
        }
    }

    /// A pass of the law lies at the root but for the last digits of arithmetic.
    fn meets_the_root(&self) -> bool {
        let passes = (self.depth / self.first).powi(2);
        (passes - passes.round()).abs() < 1e-6
    }

    /// The way out stays below the level that the tool goes back at.
    fn fits(&self, form: usize) -> bool {
        self.leaves(form) < self.clearance
    }

    /// Passes that leave the thread before its end.
    fn leaving(&self, cuts: &[Cut], leaves: f64) -> Vec<Cut> {
        let towards = (self.z[1] - self.z[0]).signum();
        let slant = (self.x[1] - self.x[0]) / (self.z[1] - self.z[0]);
        let out = if self.outside { leaves } else { -leaves };
        let both = |cut: &Cut| {
            let z = cut.to[1] - towards * leaves;
            let corner = [cut.to[0] - slant * towards * leaves, z];
            let last = [corner[0] + out, cut.to[1]];
            [Cut { to: corner, ..*cut }, Cut { from: corner, to: last, ..*cut }]
        };
        cuts.iter().flat_map(both).collect()
    }

    /// The passes it asks for; `lags`: LinuxCNC's end in step with the infeed.
    fn cuts(&self, lags: bool) -> Vec<Cut> {
        let mut depths = Vec::new();
        let mut pass = 0.0;
        while depths.last().is_none_or(|depth| *depth < self.depth - 1e-9) {
            pass += 1.0;
            depths.push((self.first * f64::sqrt(pass)).min(self.depth));
        }
        depths.extend((0..self.springs).map(|_| self.depth));
        let towards = (self.z[1] - self.z[0]).signum();
        let slant = (self.x[1] - self.x[0]) / (self.z[1] - self.z[0]);
        let into = if self.outside { -1.0 } else { 1.0 };
        let slope = (self.angle / 2.0).to_radians().tan();
        let mut cuts = Vec::new();
        for start in 0..self.starts {
            for depth in &depths {
                let along = depth * slope - f64::from(start) * self.pitch;
                let z = self.z[0] + towards * along;
                let end = if lags { towards * (self.depth - depth) * slope } else { 0.0 };
                cuts.push(Cut {
                    from: [self.x[0] + slant * (z - self.z[0]) + into * depth, z],
                    to: [self.x[1] + into * depth, self.z[1] - end],
                    lead: self.pitch * f64::from(self.starts),
                });
            }
        }
        cuts
    }
}

/// The control of the expander.
#[derive(Default)]
struct Control {
    at: [f64; 2],
    /// The lead of G33 counts along the longer axis, else along the path.
    counts_on_axis: bool,
    cuts: Vec<Cut>,
    /// Of the first block of G76: passes at full depth, angle, least depth.
    setup: Option<(u32, f64, f64)>,
    /// Tenths of the lead of its chamfer, or of that which M23 switches on.
    chamfer: u32,
    /// Length and rise of the way out of LinuxCNC's G76.
    leans: Option<[f64; 2]>,
}

impl Control {
    fn cut(&mut self, from: [f64; 2], to: [f64; 2], lead: f64) {
        self.cuts.push(Cut { from, to, lead });
    }

    /// A cycle of all passes, from where the tool stands.
    fn passes(&mut self, end: [f64; 2], taper: f64, law: Law, lead: f64) {
        let begin = self.at;
        let (into, towards) = ((end[0] - begin[0]).signum(), (end[1] - begin[1]).signum());
        for depth in law.depths() {
            let root = [end[0] - into * (law.height - depth), end[1]];
            let z = begin[1] + towards * depth * law.slope;
            let lag = if law.lags { towards * (law.height - depth) * law.slope } else { 0.0 };
            self.pass([root[0] + taper, z], [root[0], end[1] - lag], into, lead);
        }
    }

    /// A pass, with the way out where there is one.
    fn pass(&mut self, from: [f64; 2], to: [f64; 2], into: f64, lead: f64) {
        let way = f64::from(self.chamfer) / 10.0 * lead;
        let [leaves, rise] = self.leans.unwrap_or([way, way]);
        if leaves == 0.0 {
            return self.cut(from, to, lead);
        }
        let towards = (to[1] - from[1]).signum();
        let share = leaves / (to[1] - from[1]).abs();
        let corner = [to[0] + (from[0] - to[0]) * share, to[1] - towards * leaves];
        self.cut(from, corner, lead);
        self.cut(corner, [corner[0] - into * rise, to[1]], lead);
    }

    fn block(&mut self, words: &BTreeMap<char, f64>, code: Option<u32>, raw: &str) -> Option<()> {
        let get = |letter: char| words.get(&letter).copied();
        let to = [get('X').map_or(self.at[0], |x| x / 2.0), get('Z').unwrap_or(self.at[1])];
        match code {
            Some(0) => self.at = to,
            Some(32) => {
                self.cut(self.at, to, get('F')?);
                self.at = to;
            }
            Some(33) => {
                let ways = [(to[0] - self.at[0]).abs(), (to[1] - self.at[1]).abs()];
                let share = match self.counts_on_axis {
                    true => 1.0,
                    false => ways[0].max(ways[1]) / ways[0].hypot(ways[1]),
                };
                self.cut(self.at, to, get('K')? * share);
                self.at = to;
            }
            Some(92) => {
                let taper = get('R').unwrap_or(0.0);
                let into = (to[0] - self.at[0]).signum();
                self.pass([to[0] + taper, self.at[1]], to, into, get('F')?);
            }
            Some(76) if words.contains_key(&'J') => {
                let law = Law {
                    height: get('K')? / 2.0,
                    first: get('J')? / 2.0,
                    least: 0.0,
                    springs: get('H')? as u32,
                    slope: get('Q')?.to_radians().tan(),
                    lags: true,
                };
                let crest = self.at[0] + get('I')? / 2.0;
                let end = [crest + get('I')?.signum() * law.height, to[1]];
                self.leans = get('E').filter(|_| get('L') == Some(2.0)).map(|e| [e, law.height]);
                self.passes(end, 0.0, law, get('P')?);
                self.at[1] = to[1];
            }
            Some(76) if words.contains_key(&'K') => {
                let slope = (get('A')? / 2.0).to_radians().tan();
                let (height, first) = (get('K')?, get('D')?);
                let law = Law { height, first, least: 0.0, springs: 1, slope, lags: false };
                self.passes(to, get('I').unwrap_or(0.0), law, get('F')?);
            }
            Some(76) if words.contains_key(&'X') => {
                let (springs, angle, least) = self.setup.take()?;
                let law = Law {
                    height: get('P')? / 1000.0,
                    first: get('Q')? / 1000.0,
                    least,
                    springs,
                    slope: (angle / 2.0).to_radians().tan(),
                    lags: false,
                };
                self.passes(to, get('R').unwrap_or(0.0), law, get('F')?);
            }
            Some(76) => {
                let pairs = raw.split(' ').find_map(|word| word.strip_prefix('P'))?;
                let pair = |at: usize| pairs.get(at..at + 2)?.parse::<u32>().ok();
                self.chamfer = pair(2)?;
                self.setup = Some((pair(0)?, f64::from(pair(4)?), get('Q')? / 1000.0));
            }
            _ => {}
        }
        Some(())
    }
}

/// How deep the passes of a cycle go.
struct Law {
    height: f64,
    first: f64,
    least: f64,
    springs: u32,
    slope: f64,
    lags: bool,
}

impl Law {
    fn depths(&self) -> Vec<f64> {
        let mut depths: Vec<f64> = Vec::new();
        let mut depth = 0.0;
        while depth < self.height - 1e-9 {
            let next = self.first * ((depths.len() + 1) as f64).sqrt();
            depth = next.max(depth + self.least).min(self.height);
            depths.push(depth);
        }
        depths.extend((0..self.springs).map(|_| self.height));
        depths
    }
}

/// The passes of a program.
fn expand(nc: &str) -> Option<Vec<Cut>> {
    let mut control = Control { counts_on_axis: nc.contains("DIAMON"), ..Control::default() };
    let mut motion = None;
    let bare = |line: &&str| !(line.starts_with(['%', 'O', '(']) || line.ends_with("DIAMON"));
    for line in nc.lines().filter(bare) {
        let mut words = BTreeMap::new();
        for word in line.split(' ').filter(|word| !word.is_empty()) {
            let value: f64 = word.get(1..)?.parse().ok()?;
            match word.chars().next()? {
                'G' if [0, 1, 32, 33, 76, 92].contains(&(value as u32)) => {
                    motion = Some(value as u32)
                }
                'G' | 'N' => {}
                // The parameter of the control is two tenths.
                'M' if value == 23.0 => control.chamfer = 2,
                'M' if value == 24.0 => control.chamfer = 0,
                letter => {
                    words.insert(letter, value);
                }
            }
        }
        let moves = ['X', 'Z', 'P'].into_iter().any(|letter| words.contains_key(&letter));
        if moves {
            control.block(&words, motion, line)?;
        }
    }
    Some(control.cuts)
}

/// Differences of less than this are rounding, mm.
const ROUNDING: f64 = 0.0035;

fn differ(wanted: &[Cut], found: &[Cut], with_lead: bool) -> Option<String> {
    if wanted.len() != found.len() {
        return Some(format!("{} passes, {} wanted", found.len(), wanted.len()));
    }
    for (number, (wanted, found)) in wanted.iter().zip(found).enumerate() {
        let near = |a: [f64; 2], b: [f64; 2]| (0..2).all(|n| (a[n] - b[n]).abs() < ROUNDING);
        let lead = !with_lead || (wanted.lead - found.lead).abs() <= 0.0005 * wanted.lead;
        if !near(wanted.from, found.from) || !near(wanted.to, found.to) || !lead {
            return Some(format!("pass {}: {found:?}, wanted {wanted:?}", number + 1));
        }
    }
    None
}

fn post_of(ready: &str, settings: &[&str]) -> Program {
    let mut builder = Program::builder().generic(ready).set("thread.least_depth=0");
    for setting in settings {
        builder = builder.set(setting);
    }
    builder.build().unwrap()
}

pub(crate) fn nc_of(post: &Program, cl: &str) -> Result<String, String> {
    let mut nc = Vec::new();
    match post.stream(cl.as_bytes(), &mut nc) {
        Ok(_) => Ok(String::from_utf8(nc).unwrap()),
        Err(error) => Err(error.to_string()),
    }
}

/// What the back-check says against a program; empty when it agrees.
pub(crate) fn said_against(post: &Program, cl: &str, nc: &str) -> String {
    let program = NcProgram { text: nc.as_bytes(), name: "out.nc" };
    match post.start().verify(Cursor::new(cl.to_string()), program, Allowed::default()) {
        Ok((report, _)) if report.compared == 0 => "nothing was compared".to_string(),
        Ok((report, _)) => {
            let mut said: String = report.findings.iter().map(|one| format!("{one}\n")).collect();
            said.extend(report.unverified.iter().map(|one| format!("{one:?}\n")));
            said
        }
        Err(error) => error.to_string(),
    }
}

/// The seeds: a sample, or what `FILPOST_THREADS=first,count` says.
pub(crate) fn seeds() -> std::ops::Range<u64> {
    let said = env::var("FILPOST_THREADS").ok();
    let range = said.as_deref().and_then(|said| said.split_once(','));
    match range.map(|(first, count)| (first.parse::<u64>(), count.parse::<u64>())) {
        Some((Ok(first), Ok(count))) => first..first + count,
        _ => 0..60,
    }
}

/// What is wrong with a thread in a form.
fn wrong(post: &Program, form: usize, spec: &Spec, judge: Option<&Path>) -> Option<String> {
    let cl = spec.cl();
    let nc = match nc_of(post, &cl) {
        Ok(nc) => nc,
        Err(said) => return Some(format!("refused: {said}\n{cl}")),
    };
    let by_cycle = nc.contains("G76");
    let wanted = spec.cuts(by_cycle && LINUXCNC.contains(&form));
    // Haas and one-block controls make one pass at full depth; the others count them.
    let wanted = match form {
        _ if ONE_BLOCK.contains(&form) && by_cycle => Spec { springs: 1, ..*spec }.cuts(false),
        _ => wanted,
    };
    let mut wanted = match spec.leaves(form) {
        0.0 => wanted,
        leaves => spec.leaving(&wanted, leaves),
    };
    let tell = |said: String| Some(format!("{said}\n{cl}{nc}"));
    let Some(found) = expand(&nc) else { return tell("not understood".to_string()) };
    if let Some(said) = differ(&wanted, &found, true) {
        return tell(said);
    }
    let said = said_against(post, &cl, &nc);
    // The number of passes at the root is the control's own in one block.
    let counts_itself = ONE_BLOCK.contains(&form) && by_cycle;
    if !(said.is_empty() || counts_itself && said.contains("passes at the root")) {
        return tell(said);
    }
    let judge = judge.filter(|_| LINUXCNC.contains(&form))?;
    let calls = match rs274::run(judge, &nc) {
        Ok(calls) => calls,
        Err(said) => return tell(said),
    };
    let (mut at, mut in_step, mut ran) = ([0.0; 2], false, Vec::new());
    for call in &calls {
        match &call.canon {
            Canon::Synchronised(on) => in_step = *on,
            Canon::Traverse(to) => at = [to[0], to[2]],
            Canon::Feed(to) => {
                let to = [to[0], to[2]];
                if in_step {
                    ran.push(Cut { from: at, to, lead: 0.0 });
                }
                at = to;
            }
            _ => {}
        }
    }
    // Where a pass by the law meets the root, the last digit of the interpreter's arithmetic
    // decides whether it makes one more there.
    if spec.meets_the_root() {
        let same = |a: &mut Cut, b: &mut Cut| {
            let near = |a: f64, b: f64| (a - b).abs() < 2e-4;
            near(a.from[0], b.from[0]) && near(a.from[1], b.from[1]) && near(a.to[0], b.to[0])
        };
        ran.dedup_by(same);
        wanted.dedup_by(same);
    }
    differ(&wanted, &ran, false).and_then(|said| tell(format!("rs274: {said}")))
}

#[test]
fn every_form_cuts_the_same_thread() {
    let judge = rs274::program();
    for (form, (ready, settings)) in FORMS.iter().enumerate() {
        let post = post_of(ready, settings);
        let by_g76 = |seed: u64| {
            let spec = Spec::of_form(seed, form);
            if !spec.fits(form) {
                return false;
            }
            if let Some(said) = wrong(&post, form, &spec, judge.as_deref()) {
                panic!("seed {seed}, {ready} {settings:?}: {said}");
            }
            nc_of(&post, &spec.cl()).unwrap().contains("G76")
        };
        let cycles = seeds().into_par_iter().filter(|seed| by_g76(*seed)).count();
        println!("{ready} {settings:?}: {} threads, {cycles} by G76", seeds().count());
        assert_eq!(cycles > 0, BY_G76.contains(&form), "{ready} {settings:?}");
    }
}

/// A word of a thread that is another, in each form, is found.
#[test]
fn a_changed_word_of_a_thread_is_found() {
    for (form, (ready, settings)) in FORMS.iter().enumerate() {
        let post = post_of(ready, settings);
        for seed in seeds().take(30) {
            let spec = Spec::of_form(seed, form);
            if !spec.fits(form) {
                continue;
            }
            let (cl, nc) = (spec.cl(), nc_of(&post, &spec.cl()).unwrap());
            let lines: Vec<&str> = nc.lines().collect();
            let cut = |line: &&str| {
                ["G32", "G33", "G92", "G76"].into_iter().any(|code| line.contains(code))
            };
            let count = lines.iter().filter(|line| cut(line)).count();
            let mut dice = Dice::from_seed(seed);
            let chosen = dice.below(count);
            for letter in ['X', 'Z', 'F', 'K'] {
                let mut seen = 0;
                let changed: Vec<String> = lines
                    .iter()
                    .map(|line| {
                        let is = cut(line) && {
                            seen += 1;
                            seen - 1 == chosen
                        };
                        let words = line.split(' ').map(|word| match word.strip_prefix(letter) {
                            Some(number) if is => {
                                let value: f64 = number.parse().unwrap();
                                format!("{letter}{:.4}", value * 1.02 + 0.1)
                            }
                            _ => word.to_string(),
                        });
                        words.collect::<Vec<_>>().join(" ")
                    })
                    .collect();
                let changed = changed.join("\n") + "\n";
                if changed == nc || (form == 3 && letter == 'K') {
                    continue;
                }
                let said = said_against(&post, &cl, &changed);
                assert!(!said.is_empty(), "seed {seed}, {letter} of {ready}:\n{cl}{changed}");
            }
        }
    }
}

/// LinuxCNC's interpreter takes the programs of the cases for its lathe.
#[test]
fn linuxcnc_takes_the_programs_of_its_lathe() {
    let Some(judge) = rs274::program() else { return };
    let folder = filpost_tests::root().join("corpus/lathe/linuxcnc-lathe");
    let mut count = 0;
    for case in std::fs::read_dir(folder).expect("the cases") {
        let program = case.expect("a case").path().join("expected.nc");
        let nc = std::fs::read_to_string(&program).expect("a program");
        rs274::interpret(&judge, &nc)
            .unwrap_or_else(|said| panic!("{}: {said}", program.display()));
        count += 1;
    }
    assert_eq!(count, 10);
}

/// Passes of CYCLE97 by its manual: pass i of NRC at the root of i/NRC of TDEP, NID more at full
/// depth, from SPL to FPL, DM1 less twice the depth outside (VARI 3), more inside (VARI 4).
fn passes_of_cycle97(nc: &str) -> Vec<Cut> {
    let mut cuts = Vec::new();
    for line in nc.lines() {
        let Some((_, list)) = line.split_once("CYCLE97(") else { continue };
        let list: Vec<f64> = list
            .trim_end_matches(')')
            .split(',')
            .map(|value| value.parse().unwrap_or(f64::NAN))
            .collect();
        let [lead, from, to, diameter] = [list[0], list[2], list[3], list[4]];
        assert_eq!(list[4], list[5]);
        let [depth, count, springs] = [list[8], list[12], list[13]];
        let into = if list[14] == 3.0 { -1.0 } else { 1.0 };
        let last = (count + springs) as u32;
        for pass in 1..=last {
            let deep = depth * (f64::from(pass).min(count) / count).sqrt();
            let x = diameter / 2.0 + into * deep;
            cuts.push(Cut { from: [x, from], to: [x, to], lead });
        }
    }
    cuts
}

#[test]
fn cycle97_cuts_what_single_passes_cut() {
    let [by_passes, by_cycle] = [0, 5].map(|cycle| {
        let cycle = format!("thread.cycle={cycle}");
        post_of("sinumerik-lathe", &[&cycle, "thread.cycle_code=97"])
    });
    for seed in seeds() {
        let mut dice = Dice::from_seed(seed ^ 0x97);
        let outside = dice.once_in(2);
        let (x, depth) = (10 + dice.below(30), 0.3 + 0.1 * dice.below(25) as f64);
        let clear = if outside { x + 4 } else { x - 4 };
        let (begin, end) = (4 + dice.below(4), 10 + dice.below(30));
        let (cuts, last, starts) = (1 + dice.below(12), dice.below(3), 1 + dice.below(3));
        let lead = 0.5 + 0.25 * dice.below(10) as f64;
        let cl = format!(
            "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 400, CLW\nRAPID\nGOTO / {clear}, 0, {begin}\n\
             OP / THREAD, TURN, DEPTH, {depth:.3}, MMPR, {lead}, MULTRD, {starts}, CUTS, {cuts}, \
             FINCUT, {last}\nGOTO / {x}, 0, {begin}\nGOTO / {x}, 0, -{end}\nRAPID\n\
             GOTO / {clear}, 0, 20\nFINI\n"
        );
        let [passes, cycle] = [&by_passes, &by_cycle].map(|post| nc_of(post, &cl).unwrap());
        let found = passes_of_cycle97(&cycle);
        assert_eq!(found.len() as u64, ((cuts + last) * starts) as u64, "{cl}{cycle}");
        let wanted = expand(&passes).unwrap();
        if let Some(said) = differ(&wanted, &found, true) {
            panic!("seed {seed}: {said}\n{cl}{cycle}{passes}");
        }
        assert_eq!(said_against(&by_cycle, &cl, &cycle), "", "{cl}{cycle}");
        let (number, other) = ("CYCLE97(", "CYCLE97(1");
        let changed = cycle.replacen(number, other, 1);
        assert!(!said_against(&by_cycle, &cl, &changed).is_empty(), "{changed}");
    }
}
