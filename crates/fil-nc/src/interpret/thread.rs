//! Threads: single passes, and a lathe's threading cycles as single passes.

use super::Fault;
use super::state::State;
use super::words::{AxisWord, Words, letter};
use crate::dialect::{FeedMode, Habit, Role};
use crate::errors::NcCode;
use crate::motion::{Course, Rate};

const A: u8 = letter(b'A');
const D: u8 = letter(b'D');
const E: u8 = letter(b'E');
const F: u8 = letter(b'F');
const H: u8 = letter(b'H');
const I: u8 = letter(b'I');
const J: u8 = letter(b'J');
const K: u8 = letter(b'K');
const L: u8 = letter(b'L');
const P: u8 = letter(b'P');
const Q: u8 = letter(b'Q');
const R: u8 = letter(b'R');

const X: usize = 0;
const Z: usize = 2;

/// Most passes of one thread.
const MAX_PASSES: usize = 10_000;

/// What the threading cycle of one pass keeps from block to block. Radii and
/// lengths in mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    x: f64,
    z: f64,
    taper: f64,
    lead: f64,
    /// Way before the end on which it leaves the thread at 45 degrees.
    leaves: f64,
}

/// The first block of the two that describe a thread in all passes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setup {
    finishing: u32,
    /// Tenths of the lead on which a pass leaves the thread.
    chamfer: f64,
    angle: f64,
    least: f64,
    allowance: f64,
}

/// A thread in all its passes; depths are radii.
struct Thread {
    last: Pass,
    height: f64,
    first: f64,
    setup: Setup,
}

impl State<'_> {
    /// One pass from where the tool stands.
    pub(super) fn thread(&mut self, words: &mut Words) -> Result<(), Fault> {
        let lead = self.lead(words, &[self.dialect.letter(Role::Lead)], None)?;
        let axes = words.take_axes(self.dialect)?;
        let target = self.target(&axes);
        let lead = if self.dialect.has(Habit::LeadAlongPath) {
            lead * self.share(&target.0)
        } else {
            lead
        };
        self.go(target, Course::Thread, Some(Rate::PerTurn(lead)));
        Ok(())
    }

    /// One pass whose lead gains as much in each turn as its word says, or loses.
    pub(super) fn varying_thread(&mut self, words: &mut Words) -> Result<(), Fault> {
        let lead = self.lead(words, &[self.dialect.letter(Role::Lead)], None)?;
        let change =
            words.take(self.dialect.letter(Role::LeadChange))?.unwrap_or(0.0) * self.unit();
        let axes = words.take_axes(self.dialect)?;
        let target = self.target(&axes);
        let share =
            if self.dialect.has(Habit::LeadAlongPath) { self.share(&target.0) } else { 1.0 };
        let (lead, change) = (lead * share, change * share);
        let way = [0, 1, 2].map(|axis| (target.0[axis] - self.at[axis]).abs());
        let longest = way.into_iter().fold(0.0, f64::max);
        if lead * lead + 2.0 * change * longest <= 0.0 {
            let message = "the lead reaches zero before the end of the thread";
            return Err(Fault::new(NcCode::BadNumber, message));
        }
        self.go(target, Course::Thread, Some(Rate::Varying(lead, change)));
        Ok(())
    }

    /// What the longest axis has of the way to a point.
    fn share(&self, to: &[f64; 5]) -> f64 {
        let ways = [0, 1, 2].map(|axis| (to[axis] - self.at[axis]).abs());
        let length = libm::hypot(libm::hypot(ways[0], ways[1]), ways[2]);
        let longest = ways.into_iter().fold(0.0, f64::max);
        if length > 0.0 { longest / length } else { 1.0 }
    }

    /// The lead, from the first of these letters that the block has, else the one in
    /// force. It is no feed for the motions after it.
    fn lead(
        &mut self,
        words: &mut Words,
        letters: &[u8],
        in_force: Option<f64>,
    ) -> Result<f64, Fault> {
        let is_per_minute = self.feed.mode == FeedMode::PerMinute;
        if is_per_minute && self.dialect.has(Habit::ThreadsNeedTurns) && letters.contains(&F) {
            let message =
                "a thread with feed per minute, but this machine needs feed per revolution";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        self.feed.word = None;
        let letter = letters.iter().find(|letter| words.has(**letter));
        let said = letter.map(|letter| words.take(*letter)).transpose()?.flatten();
        said.map(|lead| lead * self.unit())
            .or(in_force)
            .filter(|lead| *lead > 0.0)
            .ok_or_else(|| Fault::new(NcCode::MissingWord, "the thread needs its lead"))
    }

    /// In, along, out and back to where it began.
    pub(super) fn thread_pass(&mut self, words: &mut Words) -> Result<(), Fault> {
        let before = self.threads.pass;
        let (lead, is_share) = self.lead_of_pass(words, before)?;
        let axes = words.take_axes(self.dialect)?;
        let taper = match words.take(self.dialect.letter(Role::ThreadTaper))? {
            Some(taper) => Some(taper),
            None => words.take(if self.dialect.letter(Role::ThreadTaper) == R { I } else { R })?,
        };
        let (x, z) = self.thread_end(&axes, before)?;
        let taper = taper.map(|taper| self.length(X, taper)).or(before.map(|pass| pass.taper));
        let leaves = self.way_out(None)? * lead;
        let pass = Pass { x, z, taper: taper.unwrap_or(0.0), lead, leaves };
        // A number of threads acts in its block, and what F counts behind it no block says.
        self.threads.pass = Some(Pass { lead: if is_share { 0.0 } else { lead }, ..pass });
        self.cut(pass, 0.0);
        Ok(())
    }

    /// The lead of the cycle of one pass: F by the number of threads in it, where the machine has a
    /// word for that, and whether the block has it.
    pub(super) fn lead_of_pass(
        &mut self,
        words: &mut Words,
        before: Option<Pass>,
    ) -> Result<(f64, bool), Fault> {
        let says_lead = words.has(F);
        let lead = self.lead(words, &[F], before.map(|pass| pass.lead))?;
        let letter = self.dialect.letter(Role::ThreadCount);
        if letter == 0 || !words.has(letter) {
            return Ok((lead, false));
        }
        match words.take_whole(letter)? {
            Some(count) if says_lead && count > 0 => Ok((lead / f64::from(count), true)),
            _ => Err(Fault::new(NcCode::BadNumber, "a number of threads that divides no F")),
        }
    }

    /// The way on which a cycle leaves a thread, in leads, where M codes switch it: that of the
    /// cycle's own word, else that of the control's parameter.
    pub(super) fn way_out(&self, said: Option<f64>) -> Result<f64, Fault> {
        let Some(way_out) = self.dialect.turning.way_out else { return Ok(said.unwrap_or(0.0)) };
        let refuse = |why: &str| Err(Fault::new(NcCode::NoMeaning, why));
        match (self.threads.leaves, said.or(way_out.leads)) {
            (Some(false), _) => Ok(0.0),
            (Some(true), Some(leads)) => Ok(leads),
            (Some(true), None) => refuse(
                "the run-out of the thread is at an angle, and its length depends on a parameter (thread.chamfer_tenths)",
            ),
            (None, _) => refuse("no block sets the run-out of the thread"),
        }
    }

    /// Takes up an M code that switches the way out of threads.
    pub(super) fn switch_way_out(&mut self, code: u32) {
        let Some([on, off]) = self.dialect.turning.way_out.map(|way_out| way_out.codes) else {
            return;
        };
        if code == on || code == off {
            self.threads.leaves = Some(code == on);
        }
    }

    /// The end of a thread; what a block does not say is as it was.
    pub(super) fn thread_end(
        &self,
        axes: &[AxisWord],
        before: Option<Pass>,
    ) -> Result<(f64, f64), Fault> {
        let (to, _) = self.target(axes);
        let end = |axis: usize, before: Option<f64>| {
            let said = axes.iter().any(|word| word.axis == axis).then_some(to[axis]);
            said.or(before)
                .ok_or_else(|| Fault::new(NcCode::MissingWord, "a thread needs the end in X and Z"))
        };
        if axes.iter().any(|word| word.axis != X && word.axis != Z) {
            return Err(Fault::new(NcCode::NoMeaning, "a thread has only X and Z"));
        }
        Ok((end(X, before.map(|pass| pass.x))?, end(Z, before.map(|pass| pass.z))?))
    }

    /// One pass that begins `infeed` later in Z.
    fn cut(&mut self, pass: Pass, infeed: f64) {
        let (x, z) = (self.at[X], self.at[Z]);
        let known = self.known;
        let towards = (pass.z - z).signum();
        (self.known[X], self.known[Z]) = (true, known[Z]);
        self.step(&[(Z, z + infeed * towards)], Course::Rapid, None);
        self.step(&[(X, pass.x + pass.taper)], Course::Rapid, None);
        self.known[Z] = true;
        let rate = Some(Rate::PerTurn(pass.lead));
        let length = (pass.z - self.at[Z]).abs();
        if pass.leaves > 0.0 && length > pass.leaves {
            let leans = pass.x + pass.taper * pass.leaves / length;
            let leave = [(X, leans), (Z, pass.z - towards * pass.leaves)];
            self.step(&leave, Course::Thread, rate);
            let out = (x - pass.x).signum() * pass.leaves;
            self.step(&[(X, leans + out), (Z, pass.z)], Course::Thread, rate);
        } else {
            self.step(&[(X, pass.x), (Z, pass.z)], Course::Thread, rate);
        }
        self.known[X] = known[X];
        self.step(&[(X, x)], Course::Rapid, None);
        self.known[Z] = known[Z];
        self.step(&[(Z, z)], Course::Rapid, None);
    }

    /// The threading cycle of all passes, in one block or in two.
    pub(super) fn thread_passes(&mut self, words: &mut Words) -> Result<(), Fault> {
        if !words.has_axes(self.dialect) {
            self.threads.setup = Some(self.first_block(words)?);
            return Ok(());
        }
        let lead = self.lead(words, &[F], None)?;
        let thread = match self.threads.setup.take() {
            Some(setup) => self.second_block(words, setup, lead)?,
            None => self.only_block(words, lead)?,
        };
        self.passes(&thread)
    }

    /// `P` finishing passes, chamfer and angle, two digits each; `Q` least depth; `R`
    /// finishing allowance. What is left out is as a parameter of the control has it.
    fn first_block(&self, words: &mut Words) -> Result<Setup, Fault> {
        let missing = |word: &str| {
            let message = format!("{word} of the first block is left to a parameter");
            Fault::new(NcCode::MissingWord, message)
        };
        let said = words.take_plain(P)?.ok_or_else(|| missing("P"))?;
        let least = words.take_number(Q).ok_or_else(|| missing("Q"))?.steps(self.unit());
        let allowance = words.take(R)?.ok_or_else(|| missing("R"))? * self.unit();
        Ok(Setup {
            finishing: (said / 10_000).clamp(1, 99),
            chamfer: f64::from(said / 100 % 100),
            angle: f64::from(said % 100),
            least,
            allowance,
        })
    }

    /// `P` height and `Q` first depth in smallest steps, `R` taper.
    fn second_block(&self, words: &mut Words, setup: Setup, lead: f64) -> Result<Thread, Fault> {
        let axes = words.take_axes(self.dialect)?;
        let (x, z) = self.thread_end(&axes, None)?;
        let taper = self.length(X, words.take(R)?.unwrap_or(0.0));
        let height = words.take_number(P).map(|height| height.steps(self.unit()));
        let first = words.take_number(Q).map(|first| first.steps(self.unit()));
        thread(
            Pass { x, z, taper, lead, leaves: self.way_out(Some(setup.chamfer / 10.0))? * lead },
            height,
            first,
            setup,
        )
    }

    /// `K` height, `D` first depth, `A` angle, `I` taper.
    fn only_block(&self, words: &mut Words, lead: f64) -> Result<Thread, Fault> {
        let angle = words.take(A)?.unwrap_or(0.0);
        let axes = words.take_axes(self.dialect)?;
        let (x, z) = self.thread_end(&axes, None)?;
        let taper = self.length(X, words.take(I)?.unwrap_or(0.0));
        let height = words.take_number(K).map(|height| height.steps(self.unit()));
        let first = words.take_number(D).map(|first| first.steps(self.unit()));
        let setup = Setup { finishing: 1, chamfer: 0.0, angle, least: 0.0, allowance: 0.0 };
        let leaves = self.way_out(None)? * lead;
        thread(Pass { x, z, taper, lead, leaves }, height, first, setup)
    }

    /// LinuxCNC: `P` pitch, `Z` end, `I` from where the tool stands to the crest, `J` first
    /// depth, `K` height, `R` how fast the passes become shallower, `Q` slant of the
    /// infeed, `H` passes at full depth after the last; `E` the way along Z on which a pass comes
    /// in and goes out by the full height, `L` at the start (1), the end (2) or both (3). `I`, `J`
    /// and `K` count as X does.
    pub(super) fn thread_by_pitch(&mut self, words: &mut Words) -> Result<(), Fault> {
        let missing =
            |what: &str| Fault::new(NcCode::MissingWord, format!("the thread needs {what}"));
        let lead = self.lead(words, &[P], None)?;
        let to_crest = words.take(I)?.ok_or_else(|| missing("its crest (I)"))?;
        let first = words.take(J)?.ok_or_else(|| missing("its first depth (J)"))?;
        let height = words.take(K)?.ok_or_else(|| missing("its height (K)"))?;
        let power = words.take(R)?.unwrap_or(1.0).max(1.0);
        let slope = libm::tan(words.take(Q)?.unwrap_or(0.0).to_radians());
        let springs = words.take_whole(H)?.unwrap_or(0);
        let leans = words.take(E)?.unwrap_or(0.0).max(0.0) * self.unit();
        let ends = words.take_whole(L)?.unwrap_or(0);
        if ends > 3 {
            return Err(Fault::new(NcCode::BadNumber, "L of the thread is none of 0, 1, 2 and 3"));
        }
        let [entry, exit] = [1, 2].map(|end| if ends & end != 0 { leans } else { 0.0 });
        let axes = words.take_axes(self.dialect)?;
        let [end] = axes[..] else { return Err(missing("Z and no other axis")) };
        if end.axis != Z || !(self.known[X] && self.known[Z]) {
            return Err(missing("Z, and to know where X and Z stand"));
        }
        let [to_crest, first, height] = [to_crest, first, height].map(|way| self.way(X, way));
        if to_crest == 0.0 || first <= 0.0 || height <= 0.0 {
            return Err(Fault::new(NcCode::BadNumber, "a depth of the thread is not above zero"));
        }
        let (drive, begin) = (self.at[X], self.at[Z]);
        let z = self.target(&axes).0[Z];
        let (into, towards) = (to_crest.signum(), (z - begin).signum());
        if entry + exit > (z - begin).abs() {
            return Err(Fault::new(NcCode::BadNumber, "E of the thread is longer than the thread"));
        }
        let count = (1..).map(|pass| first * libm::pow(f64::from(pass), 1.0 / power));
        let mut depths: Vec<f64> =
            count.take_while(|depth| *depth < height).take(MAX_PASSES + 1).collect();
        if depths.len() > MAX_PASSES {
            return Err(Fault::new(NcCode::BadNumber, "the passes are too shallow to count"));
        }
        depths.extend((0..=springs).map(|_| height));
        let crest = drive + to_crest;
        self.threads.pass = Some(Pass { x: crest, z, taper: 0.0, lead, leaves: 0.0 });
        for depth in depths {
            let x = crest + into * depth;
            let clear = x - into * (to_crest.abs() + height);
            let begin = begin + towards * depth * slope;
            let end = z - towards * (height - depth) * slope;
            self.step(&[(X, clear), (Z, begin)], Course::Rapid, None);
            let rate = Some(Rate::PerTurn(lead));
            let above = x - into * height;
            if entry > 0.0 {
                self.step(&[(X, above)], Course::Rapid, None);
                self.step(&[(X, x), (Z, begin + towards * entry)], Course::Thread, rate);
            } else {
                self.step(&[(X, x)], Course::Rapid, None);
            }
            self.step(&[(Z, end - towards * exit)], Course::Thread, rate);
            if exit > 0.0 {
                self.step(&[(X, above), (Z, end)], Course::Thread, rate);
            }
            self.step(&[(X, clear)], Course::Rapid, None);
        }
        self.step(&[(X, drive), (Z, z)], Course::Rapid, None);
        self.threads.pass = None;
        Ok(())
    }

    /// Passes straight in to a height, the first one so deep, with none at the root behind them.
    pub(super) fn thread_by_roots(
        &mut self,
        (x, z): (f64, f64),
        [height, first]: [f64; 2],
        lead: f64,
    ) -> Result<(), Fault> {
        let setup = Setup { finishing: 0, chamfer: 0.0, angle: 0.0, least: 0.0, allowance: 0.0 };
        let last = Pass { x, z, taper: 0.0, lead, leaves: 0.0 };
        let thread = thread(last, Some(height), Some(first), setup)?;
        self.passes(&thread)
    }

    /// Passes of falling depth, so that each takes the same chip, then those at the
    /// full height.
    fn passes(&mut self, thread: &Thread) -> Result<(), Fault> {
        let out = (self.at[X] - thread.last.x).signum();
        let slope = libm::tan((thread.setup.angle / 2.0).to_radians());
        self.threads.pass = Some(thread.last);
        for depth in depths(thread)? {
            let x = thread.last.x + out * (thread.height - depth);
            self.cut(Pass { x, ..thread.last }, depth * slope);
        }
        self.threads.pass = None;
        Ok(())
    }
}

fn thread(
    last: Pass,
    height: Option<f64>,
    first: Option<f64>,
    setup: Setup,
) -> Result<Thread, Fault> {
    match (height, first) {
        (Some(height), Some(first)) if height > 0.0 && first > 0.0 => {
            Ok(Thread { last, height, first, setup })
        }
        _ => {
            let message = "the thread needs its height and the depth of its first pass";
            Err(Fault::new(NcCode::MissingWord, message))
        }
    }
}

/// Depth of each pass below the crest.
fn depths(thread: &Thread) -> Result<Vec<f64>, Fault> {
    let rough = (thread.height - thread.setup.allowance).max(0.0);
    let mut depths: Vec<f64> = Vec::new();
    let mut depth = 0.0;
    while depth < rough - 1e-9 {
        if depths.len() == MAX_PASSES {
            return Err(Fault::new(NcCode::BadNumber, "the passes are too shallow to count"));
        }
        let next = thread.first * ((depths.len() + 1) as f64).sqrt();
        depth = next.max(depth + thread.setup.least).min(rough);
        depths.push(depth);
    }
    depths.extend((0..thread.setup.finishing).map(|_| thread.height));
    Ok(depths)
}
