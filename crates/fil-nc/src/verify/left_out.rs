//! Operations that a program leaves out as a whole, as an operator takes them out to begin again
//! at a later tool.

use super::ahead::Steps;
use super::expected_step::ExpectedStep;
use super::report::FindingKind;
use super::verifier::Verifier;
use crate::forward::Pose;
use crate::motion::{Course, Event};

/// How far a later change to a tool is looked for, in steps of the CL file.
const FAR: usize = 200_000;

/// Motions by which an operation is told, and events of the program among which they are.
const TOLD_BY: usize = 6;
const AMONG: usize = 24;

impl<C: Steps> Verifier<'_, C> {
    /// Passes over the steps from a tool change on that the program leaves out: its next change is
    /// that of a later operation, and so are the motions after it. Says whether it did.
    pub(super) fn leaves_operation_out(&mut self, cl_line: u32, number: u32) -> bool {
        let Some((changed, tool)) = self.change_ahead().filter(|(_, tool)| *tool != number) else {
            return false;
        };
        let own = self.first_motions(0);
        let Some(count) = self.steps_to_change(tool) else { return false };
        let later = self.first_motions(count + 1);
        if self.made_after(changed, &later) <= self.made_after(changed, &own) {
            return false;
        }
        let mut motions = 0;
        for _ in 0..count {
            let Some(step) = self.cl.next() else { break };
            motions += u64::from(step.what.end().is_some());
            if !step.what.is_done_once() {
                self.step(&step);
            }
        }
        self.report.compared += motions;
        self.report.left_out += motions;
        self.memory.begins_again = true;
        let motions = match motions {
            1 => "1 motion".to_string(),
            motions => format!("{motions} motions"),
        };
        let message = format!(
            "the operation of tool {number} is left out, {motions} before the change to tool {tool}"
        );
        self.find(FindingKind::Missing, Some(cl_line), None, message);
        true
    }

    /// The next tool change of the program, before any motion at feed.
    fn change_ahead(&self) -> Option<(usize, u32)> {
        let ahead = self.nc.from(self.next).take(AMONG).enumerate();
        let mut ahead = ahead.take_while(|(_, event)| match event {
            Event::Move(found) => matches!(found.course, Course::Rapid | Course::Machine),
            event => !matches!(event, Event::End { .. }),
        });
        ahead.find_map(|(at, event)| match event {
            Event::ToolChange { tool, .. } => Some((self.next + at, tool)),
            _ => None,
        })
    }

    /// Steps of the CL file before a change to that tool.
    fn steps_to_change(&mut self, tool: u32) -> Option<usize> {
        for ahead in 0..FAR {
            match &self.cl.peek(ahead)?.what {
                ExpectedStep::Tool { number, .. } if *number == tool => return Some(ahead),
                _ => {}
            }
        }
        None
    }

    /// Where the first motions go from a step of the CL file on.
    fn first_motions(&mut self, from: usize) -> Vec<Pose> {
        let mut motions = Vec::new();
        for ahead in from..from + FAR {
            let Some(step) = self.cl.peek(ahead) else { break };
            if motions.len() == TOLD_BY || matches!(step.what, ExpectedStep::Tool { .. }) {
                break;
            }
            motions.extend(step.what.end());
        }
        motions
    }

    /// How many of these the program reaches, in their order, after a tool change.
    fn made_after(&self, changed: usize, poses: &[Pose]) -> usize {
        let mut wanted = poses.iter().peekable();
        for event in self.nc.from(changed + 1).take(AMONG) {
            match event {
                Event::ToolChange { .. } | Event::End { .. } => break,
                Event::Move(found) => {
                    while wanted.next_if(|pose| self.gap(&found.to, pose).closed()).is_some() {}
                }
                _ => {}
            }
        }
        poses.len() - wanted.len()
    }
}
