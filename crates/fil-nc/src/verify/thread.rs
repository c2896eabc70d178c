//! Whole threads of the path against passes, or threading cycles, of the program.
//!
//! What must hold: each pass lies in one of the starts, parallel to the crest, with the lead, as deep
//! as the first pass and the number of passes lay down; each start reaches the root; rapid traverse
//! goes along clear of the crest only, and back to where the thread begins.

use super::ahead::Steps;
use super::expected_step::WholeThread;
use super::report::FindingKind;
use super::say::short;
use super::thread_gauge::{Found, Gauge, Pass, ROUNDED};
use super::verifier::Verifier;
use crate::motion::{Course, Event, Move, Rate};
use fil_machine::modes::INCH;

/// Most rapids from one pass to the next.
const BETWEEN_PASSES: usize = 8;

impl<C: Steps> Verifier<'_, C> {
    /// Takes the events that cut a thread.
    pub(super) fn whole_thread(&mut self, cl_line: u32, thread: &WholeThread) {
        self.report.compared += 1;
        self.memory.initial = None;
        self.memory.thread_turns = None;
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
        let axis = thread.axis();
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
            step: if self.limits.metric { 1e-3 } else { 1e-4 * INCH },
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
        self.check_joins(cl_line, found);
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
        self.check_joins(cl_line, &found);
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
        if is_approach && known && gauge.goes_through_the_wall(&self.at, &found.to) {
            return wrong("goes through the wall of the part to the side of the thread", self);
        }
        if along.abs() > gauge.slack && known && (below(from) || below(to)) {
            return wrong("goes along the thread below its crest", self);
        }
        let begins = gauge.along(&found.to) <= to * gauge.slope + gauge.slack * (1.0 + gauge.slope);
        if below(to) && !begins {
            return wrong("enters the thread after its start", self);
        }
        let begins_cycle = found.in_cycle && !self.in_thread_cycle();
        if begins_cycle && !gauge.is_clear(&self.at) {
            return wrong("begins the cycle elsewhere than clear of the thread", self);
        }
        if !found.in_cycle && below(to) && !gauge.is_clear(&self.at) {
            return wrong("enters the thread from a plane other than the return plane", self);
        }
        if !found.in_cycle && !below(to) && !is_approach && !gauge.is_clear(&found.to) {
            return wrong("does not return to the clearance plane of the thread", self);
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
        let speed = last.map(|found| found.modes.spindle.speed);
        let goes_on = |walk: &Self| {
            let next = walk.next_move().filter(|to| Some(to.modes.spindle.speed) == speed);
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
        // Where a pass by the law comes to the root itself, the arithmetic of the control decides
        // whether that is one more pass at the full depth.
        let meets = |pass: usize| {
            let depth = thread.first * (pass as f64).sqrt();
            (depth - thread.depth).abs() <= ROUNDED * gauge.step
        };
        let meets =
            thread.passes.is_none() && [law.len(), count - full + 1].map(meets).contains(&true);
        if full == wanted || in_cycle && meets && full.abs_diff(wanted) == 1 {
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
