//! Tool changes: the number, the way there, the length offset after it.

use super::ahead::Steps;
use super::lines::RAPID_PARTS;
use super::report::FindingKind;
use super::say::short;
use super::verifier::{Fact, LOOK_AHEAD, Verifier};
use crate::motion::{Course, Event, Position};

impl<C: Steps> Verifier<'_, C> {
    /// A change to a tool. False where it is in the spindle already, and stays.
    pub(super) fn tool(&mut self, cl_line: u32, number: u32, offset: u32, by_hand: bool) -> bool {
        self.memory.initial = None;
        let same = self.keeps_tool(number, offset);
        let is_tip = same && self.expected.loaded_offset() != Some(offset);
        // A text may have changed the tool.
        match self.settings.names_machine_positions() {
            // The moves behind it count with the other offset, where they lead nowhere too.
            _ if is_tip => {}
            // A change by hand is no event: moves before it and after it look the same.
            _ if by_hand => self.pass_own(),
            true => self.pass_still(cl_line),
            false => {
                self.pass(cl_line);
            }
        }
        self.change(cl_line, (number, offset), by_hand, same);
        !same
    }

    fn change(&mut self, cl_line: u32, (number, offset): (u32, u32), by_hand: bool, same: bool) {
        let is_called = match by_hand {
            true => self.settings.calls_lengths_by_tool(),
            false => self.settings.calls_tools(),
        };
        let changes = !same && is_called;
        if !same && by_hand {
            self.stop_for_operator(cl_line);
        }
        if !changes {
            if !same && !by_hand {
                // The operator changes the tool; the machine goes there all the same.
                self.go_to_change_position(cl_line);
            }
            self.expected.change_tool(number, offset, self.settings);
            self.expected.take_first_offset(self.settings);
            if !same && by_hand {
                self.expected.take_tool_by_hand();
                self.expected.resume_coolant(self.settings);
            }
            return;
        }
        if self.leaves_operation_out(cl_line, number) {
            return;
        }
        let is_tip = self.takes_another_tip(number, offset);
        if !is_tip {
            self.go_to_change(cl_line, by_hand);
        }
        let is_of_later = self.is_of_a_later_change(number);
        match self.units_to_tool_change().filter(|units| *units == 0 || !is_of_later) {
            Some(left_out) => self.extra(left_out, cl_line),
            None => {
                let message = format!("no change to tool {number}");
                self.find(FindingKind::Tool, Some(cl_line), None, message);
                self.expected.change_tool(number, offset, self.settings);
                return self.expected.take_first_offset(self.settings);
            }
        }
        if let Some(Event::ToolChange { line, tool, modes }) = self.nc.get(self.next) {
            self.next += 1;
            self.facts.set(Fact::Away, true);
            if !std::mem::take(&mut self.memory.begins_again) {
                self.check_standing(cl_line, line, &modes, true);
            }
            if tool != number {
                let message = format!("changes to tool {tool}, it should be tool {number}");
                self.find(FindingKind::Tool, Some(cl_line), Some(line), message);
            }
            let at_once = self.settings.calls_tools_with_offset();
            let before = self.expected.offset_on();
            let at_change = self.settings.calls_offset_at_change();
            let early = modes
                .length
                .offset
                .filter(|taken| !at_once && !at_change && before != Some(*taken));
            if let Some(taken) = early {
                let message = format!("length offset {taken} is called before the tool changes");
                self.find(FindingKind::Tool, Some(cl_line), Some(line), message);
            }
            let taken = modes.length.offset.unwrap_or(0);
            if at_once && taken != offset {
                let message = format!("length offset {taken} is taken up, it should be {offset}");
                self.find(FindingKind::Tool, Some(cl_line), Some(line), message);
            }
        }
        self.expected.change_tool(number, offset, self.settings);
        self.expected.take_first_offset(self.settings);
        if is_tip {
            return;
        }
        if by_hand || self.settings.switches_off_at_change() {
            self.expected.resume_coolant(self.settings);
        }
        self.allow_spindle_mode_again();
        self.go_to_offset_level(cl_line);
        self.take_blocks_after_change();
    }

    /// The way to the tool change, with what is switched and said before it.
    fn go_to_change(&mut self, cl_line: u32, by_hand: bool) {
        self.await_blocks_before_change();
        let is_first = self.blocks.changes == 0;
        self.blocks.changes += 1;
        if self.settings.switches_off_at_change() {
            self.take_blocks(&self.settings.blocks_of_switching_off());
        }
        self.go_to_change_position(cl_line);
        self.take_awaited_blocks();
        if !is_first && !by_hand {
            self.ask_auxiliary(cl_line, self.settings.stop_at_change());
        }
    }

    /// The tool is in the spindle already, and the program leaves its change out: where another of
    /// its tips comes, the program calls that one's offset alone.
    pub(super) fn keeps_tool(&self, number: u32, offset: u32) -> bool {
        let is_modal = self.settings.tool_is_modal();
        self.expected.tool() == Some(number)
            && match self.expected.loaded_offset() {
                Some(before) if before == offset && is_modal => true,
                // A text may have taken another one.
                _ => self.next_tool() != Some(number),
            }
    }

    /// The word that calls the tool in the spindle again calls another offset of it.
    fn takes_another_tip(&self, number: u32, offset: u32) -> bool {
        self.settings.calls_tools_with_offset()
            && self.expected.tool() == Some(number)
            && self.expected.loaded_offset().is_some_and(|before| before != offset)
    }

    /// Before the operator changes a tool: coolant and spindle off, the way to the change position, and
    /// a stop.
    fn stop_for_operator(&mut self, cl_line: u32) {
        self.take_blocks(&self.settings.blocks_of_switching_off());
        if self.settings.change_position(self.limits.metric) != [None; 5] {
            self.go_to_change_position(cl_line);
        }
        let lines = self.lines_here();
        if let Some(code) = self.settings.stop_code(false) {
            self.auxiliaries.ask(code, cl_line, lines);
        }
    }

    /// The tool of the next change, if it comes soon.
    fn next_tool(&self) -> Option<u32> {
        let mut ahead = self.nc.from(self.next).take(LOOK_AHEAD);
        let change =
            ahead.find(|event| matches!(event, Event::ToolChange { .. } | Event::End { .. }));
        match change {
            Some(Event::ToolChange { tool, .. }) => Some(tool),
            _ => None,
        }
    }

    /// The change that comes next is to a tool that the CL file changes to later.
    fn is_of_a_later_change(&mut self, number: u32) -> bool {
        self.next_tool().is_some_and(|tool| tool != number && self.tool_comes(tool))
    }

    /// Motions and holes before the next tool change, if it comes soon.
    pub(super) fn units_to_tool_change(&self) -> Option<usize> {
        let mut index = self.next;
        for units in 0..LOOK_AHEAD {
            match self.nc.get(index)? {
                Event::ToolChange { .. } => return Some(units),
                Event::End { .. } => return None,
                _ => index = self.unit_end(index),
            }
        }
        None
    }

    /// The rapids to the position where the machine changes tools.
    pub(super) fn go_to_change_position(&mut self, cl_line: u32) {
        let wanted = self.settings.change_position(self.limits.metric);
        if self.settings.names_machine_positions() {
            self.go_in_machine_frame(cl_line, wanted);
            return;
        }
        self.pass(cl_line);
        let forward = &self.settings.forward;
        let value = |at: &Position, n: usize| {
            if n < 3 {
                forward.restated(at, &Position::default()).linear[n]
            } else {
                at.rotary[n - 3]
            }
        };
        let near = |at: &Position, known: &[bool; 5], n: usize| match wanted[n] {
            Some(_) if !known[n] => false,
            Some(wanted) => {
                let slack = if n < 3 { self.slack.linear[n] } else { self.slack.rotary[n - 3] };
                (value(at, n) - wanted).abs() <= slack
            }
            None => true,
        };
        if (0..5).all(|n| near(&self.at, &self.known, n)) {
            return;
        }
        let is_there: Vec<bool> = self
            .nc
            .from(self.next)
            .take(RAPID_PARTS)
            .map_while(|event| match event {
                Event::Move(found) if found.course == Course::Rapid => {
                    Some((0..5).all(|n| near(&found.to, &found.known, n)))
                }
                _ => None,
            })
            .collect();
        let reached = is_there.iter().position(|there| *there);
        // Behind a tilted frame the level is said again.
        let again = |first: usize| is_there[first..].iter().take_while(|there| **there).count();
        match reached.map(|first| first + again(first)) {
            Some(count) => {
                if let Some(raised) =
                    self.raised_from_here(wanted[2]).filter(|_| !self.facts.has(Fact::Up))
                {
                    self.check_way_up_along_head(cl_line, count, &raised);
                }
                for _ in 0..count {
                    if let Some(found) = self.next_move() {
                        self.take_awaited_blocks_before(found.line);
                        self.take(cl_line, &found);
                        self.next += 1;
                    }
                }
            }
            None => {
                let message = "no motion to the tool change position".to_string();
                self.find(FindingKind::Missing, Some(cl_line), None, message);
            }
        }
    }

    /// The Z motion that calls the length offset, where the settings have one.
    pub(super) fn go_to_offset_level(&mut self, cl_line: u32) {
        // A lathe calls the offset with its T word, or where it stands.
        let level =
            self.settings.offset_level(self.limits.metric).filter(|_| !self.settings.is_lathe());
        let Some(level) = level else { return };
        // Tool-tip control takes the length up where it begins.
        if !self.takes_to_level(cl_line, level, false) && !self.settings.has_tip_control() {
            let message = format!("the length offset is not called at Z{}", short(level));
            self.find(FindingKind::Tool, Some(cl_line), None, message);
        }
    }
}
