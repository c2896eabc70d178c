//! What no program may do, whatever it is compared with: begin in modes that nobody has said,
//! change tools, drill or end with cutter compensation on, begin or end it on an arc.

use super::report::{Finding, FindingKind, Report};
use super::rotary_rules::RotaryRules;
use super::settings::Settings;
use crate::motion::{Compensation, Course, Event, Modes, Move, OtherPlane};

/// Looks at the events of a program in their order.
#[derive(Debug)]
pub(super) struct Rules {
    /// What is wrong.
    pub(super) findings: Report,
    /// Compensation at the last motion.
    compensation: Compensation,
    /// The stray offset that has been said.
    stray: Option<u32>,
    /// A tool whose length nobody has called was said to cut.
    said_of_length: bool,
    /// The hole drilled under compensation has been said.
    said_of_cycle: bool,
    /// The planes of which was said that they are other ones: of motions, and where a length was
    /// taken up.
    other_planes: [Option<OtherPlane>; 2],
    rotary: RotaryRules,
}

impl Rules {
    /// The rules of a machine.
    pub(super) fn new(settings: &Settings<'_>) -> Self {
        Rules {
            findings: Report::default(),
            compensation: Compensation::default(),
            stray: None,
            said_of_length: false,
            said_of_cycle: false,
            other_planes: [None; 2],
            rotary: settings.rotary_rules(),
        }
    }

    /// Takes in the next event.
    pub(super) fn look(&mut self, event: &Event) {
        for (kind, message) in self.rotary.look(event) {
            self.find(kind, event.line(), message);
        }
        match event {
            Event::Move(found) => self.motion(found),
            Event::LeftToControl { line, mode } => {
                let said = "is left to the control: no block sets it, and the machine settings don't either";
                self.find(FindingKind::StartMode, *line, format!("{} {said}", mode.name()));
            }
            Event::ToolMeasured { line } => {
                let said = "takes the place of that of the tool table";
                let message = format!("a length or radius that the program gives a tool {said}");
                self.find(FindingKind::Tool, *line, message);
            }
            Event::ToolChange { line, modes, .. } => {
                self.stray_offset(*line, modes);
                self.standing(*line, modes, "while the tool is changed");
            }
            Event::End { line, modes, .. } => {
                self.stray_offset(*line, modes);
                self.standing(*line, modes, "at the end");
            }
            Event::Dwell { .. } | Event::Auxiliary { .. } => {}
        }
    }

    fn stray_offset(&mut self, line: u32, modes: &Modes) {
        if let Some(offset) = modes.length.stray.filter(|_| self.stray != modes.length.stray) {
            let said = "follows a tool change without the tool length offset";
            self.find(FindingKind::Tool, line, format!("H{offset} {said}"));
        }
        self.stray = modes.length.stray;
    }

    fn motion(&mut self, found: &Move) {
        self.stray_offset(found.line, &found.modes);
        self.plane(found);
        self.length(found);
        let now = found.modes.compensation.side;
        let before = std::mem::replace(&mut self.compensation, now);
        let is_on = now != Compensation::Off;
        if now != before && found.arc.is_some() {
            let does = if is_on { "begins" } else { "ends" };
            let message = format!("cutter compensation {does} on an arc, it must on a line");
            self.find(FindingKind::Compensation, found.line, message);
        }
        let drills = found.in_cycle && found.course != Course::Machine;
        if drills && is_on && !self.said_of_cycle {
            let message = "cutter compensation is on in a cycle".to_string();
            self.find(FindingKind::Compensation, found.line, message);
        }
        self.said_of_cycle = drills && is_on;
    }

    /// A tool cuts with its own length, and not with that of the tool before.
    fn length(&mut self, found: &Move) {
        let cuts = found.course == Course::Feed && found.modes.length.uncalled;
        if cuts && !std::mem::replace(&mut self.said_of_length, cuts) {
            let tool = found.modes.tool;
            let message = match found.modes.length.offset {
                Some(offset) => format!(
                    "tool {tool} cuts with length offset {offset}, which was called before the tool \
                     was changed"
                ),
                None => format!("tool {tool} cuts, and nothing has called its length"),
            };
            self.find(FindingKind::Tool, found.line, message);
        }
        self.said_of_length = cuts;
    }

    /// The lengths of a tool act in one plane alone on a SINUMERIK, and on other mills some controls
    /// count them square to that in which they were taken up.
    fn plane(&mut self, found: &Move) {
        let now = [found.modes.planes.other, found.modes.length.plane];
        let before = std::mem::replace(&mut self.other_planes, now);
        let [motion, length] = [0, 1].map(|n| now[n].filter(|_| now[n] != before[n]));
        if let Some(other) = motion {
            self.find(FindingKind::Tool, found.line, other.to_string());
        }
        if let Some(other) = length {
            let message = format!("{other} where the length offset was taken up");
            self.find(FindingKind::Tool, found.line, message);
        }
    }

    /// What must be off where the axes stand.
    fn standing(&mut self, line: u32, modes: &Modes, place: &str) {
        if modes.compensation.side != Compensation::Off {
            let message = format!("cutter compensation is on {place}");
            self.find(FindingKind::Compensation, line, message);
        }
        if modes.cycle {
            self.find(FindingKind::Cycle, line, format!("a cycle is on {place}"));
        }
    }

    fn find(&mut self, kind: FindingKind, line: u32, message: String) {
        self.findings.find(Finding { kind, cl_line: None, nc_line: Some(line), message });
    }
}
