//! Whole threads of the path against passes, or threading cycles, of the program.
//!
//! What must hold: each pass lies in one of the starts, parallel to the crest, with the lead, as deep
//! as the first pass and the number of passes lay down; each start reaches the root; rapid traverse
//! goes along clear of the crest only, and back to where the thread begins.

use fil_machine::modes::INCH;
use nalgebra::Point3;

use super::ahead::Steps;
use super::report::FindingKind;
use super::say::short;
use super::walk::Walk;
use super::wanted::WholeThread;
use crate::motion::{Course, Event, Move, Position, Rate};

/// Most passes of one thread.
const MOST_PASSES: usize = 10_000;

/// Most rapids from one pass to the next.
const BETWEEN_PASSES: usize = 8;

/// What rounding may change of a first depth or a taper, last digits: a half, and a little.
const ROUNDED: f64 = 0.6;

type Found<T> = Result<T, (u32, String)>;

/// A pass: the start it belongs to and its depth.
struct Pass {
    start: u32,
    /// X and Z where it begins and ends.
    from: [f64; 2],
    to: [f64; 2],
    depth: f64,
    line: u32,
    in_cycle: bool,
}

/// A thread with what is measured along and across it.
struct Gauge<'t> {
    thread: &'t WholeThread,
    /// 0 or 2: the axis it runs along.
    axis: usize,
    /// Its direction along that axis.
    towards: f64,
    length: f64,
    slope: f64,
    /// Way before the end on which a pass leaves the thread at 45 degrees, mm.
    leaves: f64,
    /// Height above the begin of the crest at which the tool goes back, mm.
    clear: f64,
    /// What the last digits of both axes may do, generously, mm.
    slack: f64,
    /// What the last digit may do across and along the thread, mm.
    digits: [f64; 2],
    /// The smallest step of the control, mm.
    step: f64,
}

impl Gauge<'_> {
    /// Way along the thread from the begin of the crest, mm.
    fn along(&self, at: &Position) -> f64 {
        (at.linear[self.axis] - self.thread.crest[0][self.axis]) * self.towards
    }

    /// Depth below the crest, or its prolongation, mm.
    fn depth(&self, at: &Position) -> f64 {
        let [begin, end] = self.thread.crest;
        let share = self.along(at) / self.length;
        let crest = begin + (end - begin) * share;
        -(Point3::from(at.linear) - crest).dot(&self.thread.out)
    }

    /// The tool stands at the level at which it goes back.
    fn is_clear(&self, at: &Position) -> bool {
        let height = (Point3::from(at.linear) - self.thread.crest[0]).dot(&self.thread.out);
        (height - self.clear).abs() <= self.digits[0]
    }

    /// The tool stands where a start begins, clear of it.
    fn is_at_a_start(&self, at: &Position) -> bool {
        let pitch = self.thread.lead / f64::from(self.thread.starts);
        let early = -self.along(at) / pitch;
        let is_start = (0.0..f64::from(self.thread.starts)).contains(&(early.round() + 0.0));
        self.is_clear(at) && is_start && (early - early.round()).abs() * pitch <= self.digits[1]
    }

    /// Refuses a pass that does not lie where its depth wants it.
    fn lies_at(&self, pass: &Pass, depth: f64, divided: bool) -> Found<()> {
        let WholeThread { crest: [begin, end], out, lead, starts, first, .. } = *self.thread;
        let along = depth * self.slope - lead / f64::from(starts) * f64::from(pass.start);
        let from = begin + (end - begin) * (along / self.length) - out * depth;
        let to = end - out * depth - (end - begin) * (self.leaves / self.length);
        let at_root = depth >= self.thread.depth - 1e-9;
        // A cycle says its taper, and one of all passes their depths, by words of their own,
        // and each is rounded.
        let rounded = ROUNDED * self.step;
        let of_words = if divided { rounded * (1.0 + depth / first) } else { 0.0 };
        let of_taper = if pass.in_cycle { rounded } else { 0.0 };
        let [across, lengthwise] = self.digits;
        let near = |found: [f64; 2], wanted: Point3<f64>, more: [f64; 2]| {
            let off = [found[0] - wanted.x, found[1] - wanted.z];
            let [of_axis, of_depth] = if self.axis == 2 { [off[1], off[0]] } else { off };
            of_depth.abs() <= across + more[0] && of_axis.abs() <= lengthwise + more[1]
        };
        let lag = if divided && !at_root { self.thread.depth * self.slope } else { 0.0 };
        let begins = near(pass.from, from, [of_words + of_taper, of_words * self.slope]);
        // Where it begins to leave the thread it lies on the taper.
        let of_corner = if self.leaves > 0.0 { of_taper } else { 0.0 };
        let ends = near(pass.to, to, [if at_root { 0.0 } else { of_words } + of_corner, lag]);
        if begins && ends {
            return Ok(());
        }
        let ([x, z], wanted) = if begins { (pass.to, to) } else { (pass.from, from) };
        let what = if begins { "ends" } else { "begins" };
        let [x, z, wx, wz] = [x, z, wanted.x, wanted.z].map(short);
        Err((pass.line, format!("a pass {what} at X{x} Z{z}, it should be at X{wx} Z{wz}")))
    }

    /// Depth of each pass to the root, by the law that is laid down.
    fn rough(&self, least: f64) -> Vec<f64> {
        let WholeThread { depth, first, passes, .. } = *self.thread;
        if let Some(passes) = passes {
            let share = |pass: u32| (f64::from(pass) / f64::from(passes)).sqrt();
            return (1..=passes).map(|pass| depth * share(pass)).collect();
        }
        let mut depths: Vec<f64> = Vec::new();
        let mut reached = 0.0;
        // A pass so near the root, in the unit of the program, is the one at the root.
        let nothing = if self.step > 1e-3 { 1e-6 * INCH } else { 1e-6 };
        while reached < depth - nothing && depths.len() < MOST_PASSES {
            let next = first * ((depths.len() + 1) as f64).sqrt();
            reached = next.max(reached + least).min(depth);
            depths.push(reached);
        }
        depths
    }
}

impl<C: Steps> Walk<'_, C> {
    /// Takes the events that cut a thread.
    pub(super) fn whole_thread(&mut self, cl_line: u32, thread: &WholeThread) {
        self.report.compared += 1;
        self.initial = None;
        self.thread_turns = None;
        self.pass(cl_line);
        match self.cut(cl_line, thread) {
            Ok(()) => self.report.matched += 1,
            Err((line, message)) => {
                let at = Some(line).filter(|line| *line > 0);
                self.find(FindingKind::Thread, Some(cl_line), at, message);
                self.leave_thread();
            }
        }
        self.said = None;
        self.watch.stand(None);
    }

    fn cut(&mut self, cl_line: u32, thread: &WholeThread) -> Found<()> {
        let way = thread.crest[1] - thread.crest[0];
        let axis = if thread.out.z.abs() > 0.5 { 0 } else { 2 };
        let clearance = thread.clearance.unwrap_or_else(|| self.settings.thread_clearance());
        // The crest goes on to where the last start begins, and may be highest there.
        let before = thread.lead * (1.0 - 1.0 / f64::from(thread.starts)) / way[axis].abs();
        let rise = way.dot(&thread.out);
        let rises = rise.max(-rise * before).max(0.0);
        let gauge = Gauge {
            thread,
            axis,
            towards: way[axis].signum(),
            length: way[axis].abs(),
            slope: libm::tan((thread.angle / 2.0).to_radians()),
            leaves: self.settings.thread_chamfer() * thread.lead,
            clear: clearance + rises,
            slack: 2.0 * self.slack.outside_transformations.max(self.slack.linear[2]) + 1e-9,
            digits: if axis == 2 {
                [self.slack.outside_transformations, self.slack.linear[2]]
            } else {
                [self.slack.linear[2], self.slack.outside_transformations]
            },
            step: if self.metric { 1e-3 } else { 1e-4 * INCH },
        };
        if gauge.length < 1e-6 {
            return Err((0, "the crest of the thread has no length".to_string()));
        }
        let mut passes = Vec::new();
        while self.thread_comes() && !self.is_whole(&gauge, &passes) {
            let Some(found) = self.next_move() else { break };
            match found.course {
                Course::Thread => {
                    passes.push(self.pass_of(cl_line, &gauge, &found)?);
                    self.leave_at_45_degrees(cl_line, &gauge)?;
                }
                _ => self.rapid_beside(cl_line, &gauge, &found, passes.is_empty())?,
            }
        }
        self.back(cl_line, &gauge)?;
        self.judge(&gauge, &passes)
    }

    /// All passes are made, and the thread that comes is another one.
    fn is_whole(&self, gauge: &Gauge, passes: &[Pass]) -> bool {
        let Some(last) = passes.last() else { return false };
        let goes_on = |found: Move| found.in_cycle && found.line == last.line;
        if self.next_move().is_some_and(goes_on) || self.judge(gauge, passes).is_err() {
            return false;
        }
        let next = self.nc.from(self.next).take(BETWEEN_PASSES).find_map(|event| match event {
            Event::Move(found) if found.course == Course::Thread => Some(found),
            _ => None,
        });
        let thread = gauge.thread;
        // Laws near each other may ask for another pass at the root.
        !next.is_some_and(|pass| {
            let at_root = (gauge.depth(&pass.to) - thread.depth).abs() <= gauge.slack;
            let ends = (gauge.length - gauge.along(&pass.to)).abs() <= thread.lead;
            at_root && ends && self.has_lead(&pass, gauge)
        })
    }

    /// A pass has the lead of the thread.
    fn has_lead(&self, pass: &Move, gauge: &Gauge) -> bool {
        let Some(Rate::PerTurn(lead)) = pass.rate else { return false };
        (lead - gauge.thread.lead).abs() <= self.slack_of_pass(pass, gauge.thread.lead)
    }

    /// A pass comes after rapids only.
    fn thread_comes(&self) -> bool {
        let ahead = self.nc.from(self.next).take(BETWEEN_PASSES);
        let mut courses = ahead.map_while(|event| match event {
            Event::Move(found) => Some(found.course),
            _ => None,
        });
        courses.find(|course| *course != Course::Rapid) == Some(Course::Thread)
    }

    fn pass_of(&mut self, cl_line: u32, gauge: &Gauge, found: &Move) -> Found<Pass> {
        let thread = gauge.thread;
        let wrong = |message: String| Err((found.line, message));
        let lead = match found.rate {
            Some(Rate::PerTurn(lead)) => lead,
            _ => return wrong("a pass of the thread without its lead".to_string()),
        };
        if (lead - thread.lead).abs() > self.slack_of_pass(found, thread.lead) {
            return wrong(format!(
                "the lead is {}, it should be {}",
                short(lead),
                short(thread.lead)
            ));
        }
        let stood = self.at;
        let (from, to) = (gauge.depth(&stood), gauge.depth(&found.to));
        if (from - to).abs() > 2.0 * gauge.slack {
            return wrong("the pass does not run beside the crest".to_string());
        }
        if to <= -gauge.slack || to > thread.depth + gauge.slack {
            return wrong(format!(
                "a pass at depth {}, the root is at {}",
                short(to),
                short(thread.depth)
            ));
        }
        let early = to * gauge.slope - gauge.along(&self.at);
        let pitch = thread.lead / f64::from(thread.starts);
        let start = (early / pitch).round();
        let slack = gauge.slack * (1.0 + gauge.slope);
        let is_start = (0.0..f64::from(thread.starts)).contains(&start);
        if !is_start || (early - start * pitch).abs() > slack {
            return wrong(format!("the pass begins {} away from its start", short(early)));
        }
        let lacks = gauge.length - gauge.leaves - gauge.along(&found.to);
        let may_lack = (thread.depth - to).max(0.0) * gauge.slope;
        if lacks < -slack || lacks > may_lack + slack {
            return wrong(format!("the pass ends {} before the end of the thread", short(lacks)));
        }
        self.report.position.add(lacks.min(0.0).abs(), found.line);
        self.check_turns_of_pass(cl_line, found);
        self.take(cl_line, found);
        self.next += 1;
        Ok(Pass {
            start: start as u32,
            from: [stood.linear[0], stood.linear[2]],
            to: [found.to.linear[0], found.to.linear[2]],
            depth: to,
            line: found.line,
            in_cycle: found.in_cycle,
        })
    }

    /// The second motion of a pass that leaves the thread before its end.
    fn leave_at_45_degrees(&mut self, cl_line: u32, gauge: &Gauge) -> Found<()> {
        if gauge.leaves <= 0.0 {
            return Ok(());
        }
        let line = self.next_line();
        let leaves = self.next_move().filter(|found| {
            let mut way = gauge.thread.out * gauge.leaves;
            way[gauge.axis] += gauge.towards * gauge.leaves;
            let near = |n: usize| {
                let found = found.to.linear[n] - self.at.linear[n];
                (found - way[n]).abs() <= 2.0 * gauge.slack
            };
            found.course == Course::Thread && (0..3).all(near) && self.has_lead(found, gauge)
        });
        let Some(found) = leaves else {
            return Err((line, "the pass does not leave the thread at 45 degrees".to_string()));
        };
        self.take(cl_line, &found);
        self.next += 1;
        Ok(())
    }

    /// A rapid beside a thread: along it clear of the crest, in and out across it. In a cycle the
    /// control chooses the level.
    fn rapid_beside(
        &mut self,
        cl_line: u32,
        gauge: &Gauge,
        found: &Move,
        is_approach: bool,
    ) -> Found<()> {
        let [from, to] = [gauge.depth(&self.at), gauge.depth(&found.to)];
        let along = gauge.along(&found.to) - gauge.along(&self.at);
        let below = |depth: f64| depth > gauge.slack;
        let known = (0..3).all(|n| self.known[n] || !found.known[n]);
        let wrong = |said: &str, walk: &Self| {
            Err((found.line, format!("{} {said}", walk.spell_move(found))))
        };
        if along.abs() > gauge.slack && known && (below(from) || below(to)) {
            return wrong("goes along the thread below its crest", self);
        }
        let begins = gauge.along(&found.to) <= to * gauge.slope + gauge.slack * (1.0 + gauge.slope);
        if below(to) && !begins {
            return wrong("goes into the thread behind its start", self);
        }
        let begins_cycle = found.in_cycle && !self.in_thread_cycle();
        if begins_cycle && !gauge.is_clear(&self.at) {
            return wrong("begins the cycle elsewhere than clear of the thread", self);
        }
        if !found.in_cycle && below(to) && !gauge.is_clear(&self.at) {
            return wrong(
                "goes into the thread from another level than that it goes back to",
                self,
            );
        }
        if !found.in_cycle && !below(to) && !is_approach && !gauge.is_clear(&found.to) {
            return wrong("does not go back to the level clear of the thread", self);
        }
        self.take(cl_line, found);
        self.next += 1;
        Ok(())
    }

    /// The motion before the next one is of a cycle.
    fn in_thread_cycle(&self) -> bool {
        let before = self.next.checked_sub(1).and_then(|at| self.nc.get(at));
        let next = self.next_move().map(|found| found.line);
        matches!(before, Some(Event::Move(found)) if found.in_cycle && Some(found.line) == next)
    }

    /// The rapids after the last pass: out, and back to where its start begins.
    fn back(&mut self, cl_line: u32, gauge: &Gauge) -> Found<()> {
        let still_in_cycle = |walk: &Self| {
            walk.in_thread_cycle() && walk.next_move().is_some_and(|found| found.in_cycle)
        };
        // With an infeed of a pitch a pass of one start begins where another start does.
        let last = self.next.checked_sub(1).and_then(|last| self.nc.motion(last));
        let speed = last.map(|found| found.modes.speed);
        let goes_on = |walk: &Self| {
            let next = walk.next_move().filter(|to| Some(to.modes.speed) == speed);
            next.is_some_and(|to| to.course == Course::Rapid && gauge.is_at_a_start(&to.to))
        };
        for _ in 0..BETWEEN_PASSES {
            if gauge.is_at_a_start(&self.at) && !still_in_cycle(self) && !goes_on(self) {
                return Ok(());
            }
            let line = self.next_line();
            let Some(found) = self.next_move().filter(|found| found.course == Course::Rapid) else {
                let message = "the tool does not go back to where the thread begins";
                return Err((line, message.to_string()));
            };
            self.rapid_beside(cl_line, gauge, &found, false)?;
        }
        let line = self.next_line();
        Err((line, "the tool does not go back to where the thread begins".to_string()))
    }

    /// What the passes together must have done.
    fn judge(&self, gauge: &Gauge, passes: &[Pass]) -> Found<()> {
        let thread = gauge.thread;
        let Some(last) = passes.last() else {
            let line = self.next_line();
            return Err((line, "the thread is not cut".to_string()));
        };
        let least = self.settings.thread_least_depth();
        // A cycle says it in smallest steps of the control, which each pass adds up.
        let in_steps = (least / gauge.step).round() * gauge.step;
        let laws = [least, in_steps].map(|least| gauge.rough(least));
        for start in 0..thread.starts {
            let depths: Vec<f64> =
                passes.iter().filter(|pass| pass.start == start).map(|pass| pass.depth).collect();
            let wrong =
                |message: String| Err((last.line, format!("start {}: {message}", start + 1)));
            let at_root = |depth: &f64| (depth - thread.depth).abs() <= gauge.slack;
            let full = depths.iter().rev().take_while(|depth| at_root(depth)).count();
            if full == 0 {
                return wrong("the root is not reached".to_string());
            }
            let follows = |law: &Vec<f64>| {
                let count = depths.len() - full;
                // A cycle multiplies the rounding of the first pass.
                let in_cycle = passes.iter().all(|pass| pass.in_cycle);
                let rounded = if in_cycle { ROUNDED * gauge.step / thread.first } else { 0.0 };
                let same = |(found, wanted): (&f64, &f64)| {
                    (found - wanted).abs() <= gauge.slack + rounded * wanted
                };
                // A pass that rounds to the root may lie a digit above it by the law.
                let near_root = |depth: &f64| (depth - thread.depth).abs() <= 2.0 * gauge.slack;
                let rest_at_root = law[count.min(law.len())..].iter().all(near_root);
                count <= law.len() && rest_at_root && depths[..count].iter().zip(law).all(same)
            };
            let fitting: Vec<&Vec<f64>> = laws.iter().filter(|law| follows(law)).collect();
            let Some(law) = fitting.first() else {
                let depths: Vec<String> = depths.iter().map(|depth| short(*depth)).collect();
                let message = "the passes lie at other depths than the first one asks for";
                return wrong(format!("{message} ({})", depths.join(", ")));
            };
            // Of laws near each other the one that the passes were made by.
            let by_law = |law: &[f64]| {
                self.lie_on(gauge, passes, start, law)?;
                self.are_counted(gauge, passes, [depths.len(), full], law).or_else(wrong)
            };
            if !fitting.iter().any(|law| by_law(law).is_ok()) {
                by_law(law)?;
            }
        }
        Ok(())
    }

    /// The passes of a start lie where a law has them.
    fn lie_on(&self, gauge: &Gauge, passes: &[Pass], start: u32, law: &[f64]) -> Found<()> {
        let of_start = passes.iter().filter(|pass| pass.start == start);
        of_start.enumerate().try_for_each(|(index, pass)| {
            let wanted = law.get(index).copied().unwrap_or(gauge.thread.depth);
            let of_line = |other: &&Pass| other.line == pass.line;
            let divided = pass.in_cycle && passes.iter().filter(of_line).count() > 1;
            gauge.lies_at(pass, wanted, divided)
        })
    }

    /// As many of the passes of a start lie at the root as there should, behind those of a law.
    fn are_counted(
        &self,
        gauge: &Gauge,
        passes: &[Pass],
        [count, full]: [usize; 2],
        law: &[f64],
    ) -> Result<(), String> {
        if !self.counts_springs(passes) {
            return Ok(());
        }
        let thread = gauge.thread;
        let springs = thread.springs.unwrap_or_else(|| self.settings.thread_springs());
        let in_cycle = passes.iter().all(|pass| pass.in_cycle);
        let least = if in_cycle { self.settings.least_springs() } else { 0 };
        let rough = law.len() - (count - full).min(law.len());
        let wanted = rough + springs.max(least) as usize;
        // Where the last pass by the law comes to the root itself, the arithmetic of the
        // control decides whether it still makes one at the full depth then.
        let last = thread.first * (law.len() as f64).sqrt();
        let meets = thread.passes.is_none() && (last - thread.depth).abs() <= ROUNDED * gauge.step;
        if full == wanted || in_cycle && meets && full == wanted + 1 {
            return Ok(());
        }
        Err(format!("{full} passes at the root, there should be {wanted}"))
    }

    /// The program says how many passes lie at the root: one block of G76 does not.
    fn counts_springs(&self, passes: &[Pass]) -> bool {
        !(passes.iter().all(|pass| pass.in_cycle) && self.settings.leaves_springs_open())
    }

    /// Passes over what is left of a thread that went wrong.
    fn leave_thread(&mut self) {
        while self.thread_comes() || self.next_move().is_some_and(|found| found.in_cycle) {
            let Some(found) = self.next_move() else { return };
            self.stand(&found);
        }
    }
}
