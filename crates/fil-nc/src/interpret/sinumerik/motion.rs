//! Straight lines and arcs.

use super::super::Fault;
use super::super::arc::{plane_axes, sweep};
use super::Sinumerik;
use super::block::Said;
use crate::dialect::{Amount, FeedMode, Function};
use crate::errors::NcCode;
use crate::motion::{Arc, Course, Rate, unit};

/// Ways along X and Z that differ less are equal, mm: less than a last digit of a program.
const EQUAL: f64 = 1e-6;

impl Sinumerik<'_> {
    /// The motion of a block, and the cycle that it calls.
    pub(super) fn motion(&mut self, said: &Said) -> Result<(), Fault> {
        let centered = said.center != [None; 3] || said.radius.is_some();
        let arc = matches!(self.state.motion, Some(Function::Arc { .. }));
        if !(said.moves() || arc && centered) {
            return if centered { Err(no_arc()) } else { Ok(()) };
        }
        self.state.check_tilted_motion(said.axes[3..].iter().any(Option::is_some))?;
        match self.state.motion {
            Some(Function::Rapid) if !centered => {
                let target = self.leaning(said)?;
                let course = self.state.live_course(&target.0, Course::Rapid)?;
                self.state.go(target, course, None);
            }
            Some(Function::Linear) if !centered => {
                let rate = Some(self.rate()?);
                let target = self.leaning(said)?;
                let course = self.state.live_course(&target.0, Course::Feed)?;
                self.state.go(target, course, rate);
            }
            Some(_) if said.direction != [None; 3] => {
                let message = "a tool direction vector in a move that is not a straight line";
                return Err(Fault::new(NcCode::NoMeaning, message));
            }
            Some(Function::Thread) => self.thread(said, None)?,
            Some(Function::VaryingThread) => {
                // G34 and G35 take F as what the lead changes by, without a sign.
                let Some(change) = said.feed.filter(|change| *change >= 0.0) else {
                    let message = "G34 and G35 need F, what the lead changes by in each turn";
                    return Err(Fault::new(NcCode::MissingWord, message));
                };
                let change = if self.lead_shrinks { -change } else { change };
                self.state.feed.word = None;
                self.thread(said, Some(change * self.state.unit()))?;
            }
            Some(Function::Arc { ccw }) => {
                self.state.refuse_under_tip_control("an arc")?;
                self.arc(said, ccw)?;
            }
            Some(_) => return Err(no_arc()),
            None => {
                let message = "no G code for this axis move";
                return Err(Fault::new(NcCode::NoMotion, message));
            }
        }
        match self.called.clone() {
            Some(call) => self.drill(&call),
            None => Ok(()),
        }
    }

    /// A pass of a thread: its lead is I where X goes the longer way, K where Z does, and one of
    /// them where the ways are equal.
    fn thread(&mut self, said: &Said, change: Option<f64>) -> Result<(), Fault> {
        let target = self.target(said);
        if !(self.state.known[0] && self.state.known[2]) {
            return Err(Fault::new(NcCode::NoCenter, "it is not known where the thread begins"));
        }
        let way = |axis: usize| (target.0[axis] - self.state.at[axis]).abs();
        let leans = way(0) - way(2);
        let across = match said.center[2] {
            None => leans > -EQUAL,
            Some(_) => leans > EQUAL,
        };
        let (given, other) = match across {
            true => (said.center[0], said.center[2]),
            false => (said.center[2], said.center[0]),
        };
        let lead = given.map(|(lead, _)| lead).filter(|lead| *lead > 0.0);
        let (Some(lead), None, None) = (lead, other, said.center[1]) else {
            let letter = if across { "I" } else { "K" };
            let message = format!("the thread needs its lead, {letter}, and no other");
            return Err(Fault::new(NcCode::MissingWord, message));
        };
        let lead = lead * self.state.unit();
        let Some(change) = change else {
            self.state.go(target, Course::Thread, Some(Rate::PerTurn(lead)));
            return Ok(());
        };
        // The square of the lead changes by twice the change times the way.
        if lead * lead + 2.0 * change * way(0).max(way(2)) <= 0.0 {
            let message = "the lead reaches zero before the end of the thread";
            return Err(Fault::new(NcCode::BadNumber, message));
        }
        self.state.go(target, Course::Thread, Some(Rate::Varying(lead, change)));
        Ok(())
    }

    /// The feed in force. G70 and G71 change lengths and not feeds.
    pub(super) fn rate(&self) -> Result<Rate, Fault> {
        let feed = self.state.feed.word.filter(|feed| *feed > 0.0);
        let feed = feed.ok_or_else(|| Fault::new(NcCode::NoFeed, "no F word is in force"))?;
        Ok(self.rate_of(feed))
    }

    /// What a feed stands for.
    pub(super) fn rate_of(&self, feed: f64) -> Rate {
        let (dialect, unit) = (self.state.dialect, unit(self.metric_feed));
        match self.state.feed.mode {
            FeedMode::PerMinute => Rate::PerMinute(feed / dialect.factor(Amount::Feed) * unit),
            FeedMode::PerTurn => Rate::PerTurn(feed * unit),
            FeedMode::Inverse => Rate::Inverse(feed / dialect.factor(Amount::Inverse)),
        }
    }

    /// The target of a straight line, with the direction of the tool where the block says it.
    fn leaning(&self, said: &Said) -> Result<([f64; 5], [bool; 5]), Fault> {
        let (mut to, known) = self.target(said);
        if let Some(angles) = self.state.toward(said.direction)? {
            if said.axes[3..].iter().any(Option::is_some) {
                let message = "a direction of the tool and words of the rotary axes";
                return Err(Fault::new(NcCode::Twice, message));
            }
            to[3..].copy_from_slice(&angles);
        }
        Ok((to, known))
    }

    pub(super) fn target(&self, said: &Said) -> ([f64; 5], [bool; 5]) {
        let (mut to, mut known) = (self.state.at, self.state.known);
        for (axis, word) in said.axes.iter().enumerate() {
            let Some((value, absolute)) = *word else { continue };
            let (axis, value) = self.in_transformation(axis, value);
            if absolute.unwrap_or(self.state.absolute) {
                to[axis] = match said.ways[axis] {
                    None => self.state.position(axis, value),
                    Some(way) => self.state.turned(axis, value, way),
                };
                known[axis] = true;
            } else {
                to[axis] += self.state.way(axis, value);
            }
        }
        (to, known)
    }

    fn arc(&mut self, said: &Said, ccw: bool) -> Result<(), Fault> {
        let rate = self.rate()?;
        let normal = self.state.plane;
        let ccw = ccw == self.state.dialect.forms.right_handed[normal];
        let plane = plane_axes(normal);
        let (to, known) = self.target(said);
        self.check_live_arc(normal, to[2] != self.state.at[2])?;
        if plane.iter().any(|axis| !self.state.known[*axis]) {
            return Err(Fault::new(NcCode::NoCenter, "it is not known where the arc begins"));
        }
        let (center, angle) = match said.radius {
            Some(_) if said.center != [None; 3] => {
                return Err(Fault::new(NcCode::Twice, "a center and a radius"));
            }
            Some(radius) => self.state.about_radius(plane, &to, radius * self.state.unit(), ccw)?,
            None => {
                let center = self.center(said, plane, normal)?;
                self.state.check_radii(plane, center, &to)?;
                (center, sweep(plane, center, &self.state.at, &to, ccw))
            }
        };
        let mut point = [0.0; 3];
        point[normal] = self.state.at[normal];
        (point[plane[0]], point[plane[1]]) = (center[0], center[1]);
        let arc = Arc { center: point, normal, ccw, angle };
        self.state.travel((to, known), Course::Feed, Some(rate), Some(arc));
        Ok(())
    }

    /// I, J, K count from the start whether or not positions do; AC and IC say it.
    fn center(&self, said: &Said, plane: [usize; 2], normal: usize) -> Result<[f64; 2], Fault> {
        if said.center[normal].is_some() || said.center == [None; 3] {
            return Err(Fault::new(NcCode::NoCenter, "a center needs the axes of its plane"));
        }
        let unit = self.state.unit();
        let of = |axis: usize| match said.center[axis] {
            Some((value, Some(true))) => self.state.moved(axis, value * unit),
            Some((value, _)) => self.state.at[axis] + value * unit,
            None => self.state.at[axis],
        };
        Ok(plane.map(of))
    }

    /// `SUPA` and `G53`: for this block positions are those of the machine.
    pub(super) fn in_machine_frame(&mut self, said: &Said) -> Result<(), Fault> {
        let straight = matches!(self.state.motion, Some(Function::Rapid | Function::Linear));
        if said.moves() && !straight {
            return Err(Fault::new(NcCode::NoMotion, "an arc in the frame of the machine"));
        }
        if self.called.is_some() {
            return Err(Fault::new(NcCode::Twice, "a cycle of MCALL in the frame of the machine"));
        }
        self.go_to_fixed_point(said)
    }

    /// `G74` and `G75`: the axes go where the machine says; their words have no meaning.
    pub(super) fn go_to_fixed_point(&mut self, said: &Said) -> Result<(), Fault> {
        if !said.moves() {
            return Err(Fault::new(NcCode::MissingWord, "the axes that go there are needed"));
        }
        self.machine_motion(said)
    }

    fn machine_motion(&mut self, said: &Said) -> Result<(), Fault> {
        if said.direction != [None; 3] {
            let message = "a direction of the tool beside a point of the machine";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        if !said.moves() {
            return Ok(());
        }
        self.state.refuse_under_tip_control("a point of the machine")?;
        if self.state.head.tilt.is_some() {
            let message = "a point of the machine in a tilted plane";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        let (mut to, _) = self.target(said);
        for axis in (0..3).filter(|axis| said.axes[*axis].is_some()) {
            to[axis] -= self.state.zero[axis];
        }
        self.state.go_to_machine(to, said.axes.map(|axis| axis.is_some()));
        Ok(())
    }
}

fn no_arc() -> Fault {
    Fault::new(NcCode::NoMeaning, "a center or a radius without an arc")
}
