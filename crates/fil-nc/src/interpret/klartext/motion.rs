//! Straight lines and arcs.

use super::super::Fault;
use super::super::arc::sweep;
use super::line::Word;
use super::{After, Klartext};
use crate::dialect::{Amount, FeedMode, WayRound};
use crate::errors::NcCode;
use crate::motion::{Arc, Compensation, Course, Rate};

const FULL: f64 = 360.0;

/// In a program in inches F counts tenths of an inch a minute.
const TENTHS: f64 = 0.1;

/// The largest polar angle of a helix, degrees: fifteen turns.
const MOST_TURNED: f64 = 5400.0;

/// What a line of a motion says.
#[derive(Default)]
struct Said {
    /// By axis: the value, and whether it is an increment.
    axes: [Option<(f64, bool)>; 5],
    rapid: bool,
    /// DR: counterclockwise.
    ccw: Option<bool>,
    radius: Option<f64>,
    /// PA, or IPA where it is an increment, degrees.
    angle: Option<(f64, bool)>,
    /// TX, TY, TZ: the direction of the tool.
    direction: [Option<f64>; 3],
    machine: bool,
    calls: bool,
    ends: bool,
}

impl Klartext<'_> {
    /// `L X+10 Y+5 R0 FMAX M3`.
    pub(super) fn straight(&mut self, words: &[Word]) -> Result<(), Fault> {
        let said = self.said(words)?;
        if said.ccw.is_some() || said.radius.is_some() || said.angle.is_some() {
            return Err(Fault::new(NcCode::NoMeaning, "a line has no direction and no radius"));
        }
        if said.axes != [None; 5] {
            if said.machine {
                self.state.refuse_under_tip_control("a point of the machine")?;
            }
            if said.machine && self.state.head.tilt.is_some() {
                let message = "a point of the machine in a tilted plane";
                return Err(Fault::new(NcCode::NoMeaning, message));
            }
            let turns = said.axes[3..].iter().any(Option::is_some);
            self.state.check_tilted_motion(turns)?;
            let (to, known) = self.target(&said);
            self.check_ways_round(&said, &to)?;
            if said.machine {
                self.state.go_to_machine(to, said.axes.map(|axis| axis.is_some()));
            } else if said.rapid {
                self.state.go((to, known), Course::Rapid, None);
            } else {
                let rate = Some(self.rate()?);
                self.state.go((to, known), Course::Feed, rate);
            }
        }
        self.after(&said)
    }

    /// `LN X+10 Y+5 Z+2 TX+0 TY+0.5 TZ+0.866025 F500`, without the normal of the surface.
    pub(super) fn leaning_line(&mut self, words: &[Word]) -> Result<(), Fault> {
        let said = self.said_with_direction(words)?;
        let plain = said.ccw.is_none() && said.radius.is_none() && said.angle.is_none();
        if !plain || said.machine || said.calls {
            return Err(Fault::new(NcCode::NoMeaning, "LN is a straight line with a direction"));
        }
        if said.axes[3..].iter().any(Option::is_some) {
            let message = "a direction of the tool and words of the rotary axes";
            return Err(Fault::new(NcCode::Twice, message));
        }
        let missing = || Fault::new(NcCode::MissingWord, "LN needs TX, TY and TZ");
        let angles = self.state.toward(said.direction)?.ok_or_else(missing)?;
        let (mut to, known) = self.target(&said);
        to[3..].copy_from_slice(&angles);
        if said.rapid {
            self.state.go((to, known), Course::Rapid, None);
        } else {
            let rate = Some(self.rate()?);
            self.state.go((to, known), Course::Feed, rate);
        }
        self.after(&said)
    }

    /// What follows when the tool has arrived.
    fn after(&mut self, said: &Said) -> Result<(), Fault> {
        if said.calls {
            self.call_cycle()?;
        }
        if said.ends {
            self.end();
        }
        Ok(())
    }

    /// `CC X+1 Y+2`; without coordinates the tool stands at the pole.
    pub(super) fn pole(&mut self, words: &[Word]) -> Result<(), Fault> {
        let said = self.said(words)?;
        if said.axes[2..].iter().any(Option::is_some) || said.angle.is_some() {
            return Err(Fault::new(NcCode::ForeignCode, "a pole outside of the XY plane"));
        }
        let none = said.axes[0].is_none() && said.axes[1].is_none();
        for axis in 0..2 {
            match said.axes[axis] {
                Some((value, false)) => self.pole[axis] = Some(self.state.position(axis, value)),
                Some((value, true)) => {
                    let here = Some(self.state.at[axis]).filter(|_| self.state.known[axis]);
                    self.pole[axis] = here.map(|here| here + self.state.way(axis, value));
                }
                None if none => self.pole[axis] = Some(self.state.at[axis]),
                None => {}
            }
        }
        Ok(())
    }

    /// `C X+1 Y+2 DR+` about the pole.
    pub(super) fn arc(&mut self, words: &[Word]) -> Result<(), Fault> {
        let said = self.said(words)?;
        let [Some(first), Some(second)] = self.pole else {
            return Err(Fault::new(NcCode::NoCenter, "no CC came before"));
        };
        if said.radius.is_some() {
            return Err(Fault::new(NcCode::Twice, "a radius beside the pole"));
        }
        let (ccw, rate) = self.of_arc(&said)?;
        let (to, known) = self.target(&said);
        let center = [first, second];
        self.state.check_radii([0, 1], center, &to)?;
        let angle = sweep([0, 1], center, &self.state.at, &to, ccw);
        let arc = Arc { center: [first, second, self.state.at[2]], normal: 2, ccw, angle };
        self.state.travel((to, known), Course::Feed, Some(rate), Some(arc));
        self.after(&said)
    }

    /// `CR X+1 Y+2 R+5 DR+`: a negative radius goes the long way.
    pub(super) fn arc_of_radius(&mut self, words: &[Word]) -> Result<(), Fault> {
        let said = self.said(words)?;
        let missing = || Fault::new(NcCode::NoCenter, "CR needs its radius");
        let radius = said.radius.ok_or_else(missing)? * self.state.unit();
        let (ccw, rate) = self.of_arc(&said)?;
        let (to, known) = self.target(&said);
        let ([first, second], angle) = self.state.about_radius([0, 1], &to, radius, ccw)?;
        let arc = Arc { center: [first, second, self.state.at[2]], normal: 2, ccw, angle };
        self.state.travel((to, known), Course::Feed, Some(rate), Some(arc));
        self.after(&said)
    }

    /// `CP PA+90 DR+` and `CP IPA+720 IZ-2 DR+`: about the pole, at the radius where the tool
    /// stands; Z goes along with the angle.
    pub(super) fn polar_arc(&mut self, words: &[Word]) -> Result<(), Fault> {
        let mut said = self.said(words)?;
        let [Some(first), Some(second)] = self.pole else {
            return Err(Fault::new(NcCode::NoCenter, "no CC came before"));
        };
        if said.radius.is_some() || said.axes[..2] != [None; 2] {
            let message = "X, Y and a radius have no place beside a polar angle";
            return Err(Fault::new(NcCode::Twice, message));
        }
        let missing = || Fault::new(NcCode::MissingWord, "CP needs PA or IPA");
        let (angle, increment) = said.angle.take().ok_or_else(missing)?;
        let (mut to, known) = self.target(&said);
        said.axes[2] = None;
        let (ccw, rate) = self.of_arc(&said)?;
        let [x, y] = [self.state.at[0] - first, self.state.at[1] - second];
        let sense = if ccw { 1.0 } else { -1.0 };
        let turned = match increment {
            true => angle * sense,
            false => ((angle - libm::atan2(y, x).to_degrees()) * sense).rem_euclid(FULL),
        };
        if turned <= 0.0 || turned > MOST_TURNED {
            let message = "IPA has the sign of DR, and is no more than fifteen turns";
            return Err(Fault::new(NcCode::BadNumber, message));
        }
        let (sine, cosine) = libm::sincos((turned * sense).to_radians());
        to[0] = first + x * cosine - y * sine;
        to[1] = second + x * sine + y * cosine;
        let center = [first, second, self.state.at[2]];
        let arc = Arc { center, normal: 2, ccw, angle: turned };
        self.state.travel((to, known), Course::Feed, Some(rate), Some(arc));
        self.after(&said)
    }

    /// Sense and feed of an arc.
    fn of_arc(&self, said: &Said) -> Result<(bool, Rate), Fault> {
        if said.angle.is_some() {
            return Err(Fault::new(NcCode::NoMeaning, "a polar angle without CP"));
        }
        if said.axes[2..].iter().any(Option::is_some) || said.machine || said.rapid {
            let message = "an arc outside of the XY plane, at FMAX or in the machine frame";
            return Err(Fault::new(NcCode::ForeignCode, message));
        }
        if !self.state.known[0] || !self.state.known[1] {
            return Err(Fault::new(NcCode::NoCenter, "it is not known where the arc begins"));
        }
        let ccw = said.ccw.ok_or_else(|| Fault::new(NcCode::MissingWord, "an arc needs its DR"))?;
        Ok((ccw, self.rate()?))
    }

    /// The feed in force.
    pub(super) fn rate(&self) -> Result<Rate, Fault> {
        let rate = self.state.rate()?;
        Ok(match rate {
            Rate::PerMinute(rate) if !self.state.metric => Rate::PerMinute(rate * TENTHS),
            Rate::PerTurn(_) if !self.state.metric => {
                let message = "feed per revolution in inches: this meaning of F is not supported";
                return Err(Fault::new(NcCode::ForeignCode, message));
            }
            rate => rate,
        })
    }

    /// What a feed a minute of a cycle stands for: it counts as F does.
    pub(super) fn rate_of(&self, feed: f64) -> Rate {
        let tenths = if self.state.metric { 1.0 } else { TENTHS };
        Rate::PerMinute(feed / self.state.dialect.factor(Amount::Feed) * tenths * self.state.unit())
    }

    fn target(&self, said: &Said) -> ([f64; 5], [bool; 5]) {
        let (mut to, mut known) = (self.state.at, self.state.known);
        for (axis, word) in said.axes.iter().enumerate() {
            match *word {
                Some((value, false)) => {
                    to[axis] = match self.way_round(axis) {
                        None => self.state.position(axis, value),
                        Some(way) => self.state.turned(axis, value, way),
                    };
                    known[axis] = true;
                }
                Some((value, true)) => to[axis] += self.state.way(axis, value),
                None => {}
            }
        }
        (to, known)
    }

    /// How the words of an axis count within a turn; `None` for one that counts on.
    fn way_round(&self, axis: usize) -> Option<WayRound> {
        let is_endless = self.state.dialect.axes[axis].is_endless;
        (self.shortest && is_endless).then_some(WayRound::Shortest)
    }

    /// Refuses half a turn the shortest way in a line that moves more than that axis.
    fn check_ways_round(&self, said: &Said, to: &[f64; 5]) -> Result<(), Fault> {
        let turns_alone = said.rapid && said.axes[..3] == [None; 3];
        let is_said = |axis: &usize| said.axes[*axis].is_some() && self.state.known[*axis];
        for axis in (3..5).filter(is_said).filter(|_| !turns_alone) {
            self.state.check_way_round(
                axis,
                self.way_round(axis),
                self.state.at[axis],
                to[axis],
            )?;
        }
        Ok(())
    }

    /// Takes up the words of a line that moves, and says no direction of the tool.
    fn said(&mut self, words: &[Word]) -> Result<Said, Fault> {
        let said = self.said_with_direction(words)?;
        if said.direction != [None; 3] {
            let message = "the direction of the tool has its place in LN alone";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        Ok(said)
    }

    /// Takes up the words of a line that moves.
    fn said_with_direction(&mut self, words: &[Word]) -> Result<Said, Fault> {
        let mut said = Said::default();
        // They act from the start of the line, so on its F.
        for word in words {
            match word.text.as_str() {
                "M136" => self.feed_mode(FeedMode::PerTurn),
                "M137" => self.feed_mode(FeedMode::PerMinute),
                "M126" => self.shortest = true,
                "M127" => self.shortest = false,
                _ => {}
            }
        }
        for word in words {
            match word.text.as_str() {
                "FMAX" => said.rapid = true,
                "R0" => self.compensate(Compensation::Off)?,
                "RL" | "RR" => {
                    self.state.refuse_under_tip_control("cutter compensation")?;
                    let left = word.text == "RL";
                    self.compensate(if left { Compensation::Left } else { Compensation::Right })?;
                }
                "DR+" => said.ccw = Some(true),
                "DR-" => said.ccw = Some(false),
                _ => self.word(word, &mut said)?,
            }
        }
        Ok(said)
    }

    fn compensate(&mut self, side: Compensation) -> Result<(), Fault> {
        let tool = Some(self.state.modes.tool);
        self.state.compensate(side, tool.filter(|_| side != Compensation::Off))
    }

    fn word(&mut self, word: &Word, said: &mut Said) -> Result<(), Fault> {
        if let Some(code) = word.function()? {
            match self.function(code, word)? {
                After::Nothing => {}
                After::InMachineFrame => said.machine = true,
                After::CallsCycle => said.calls = true,
                After::Ends => said.ends = true,
            }
            return Ok(());
        }
        if let Some(feed) = word.value("F") {
            self.state.feed.word = Some(feed?);
            return Ok(());
        }
        if let Some(radius) = word.value("R") {
            said.radius = Some(radius?);
            return Ok(());
        }
        for (name, increment) in [("PA", false), ("IPA", true)] {
            if let Some(angle) = word.value(name) {
                let before = said.angle.replace((angle?, increment));
                let twice = || Fault::new(NcCode::Twice, "two angles").at(&word.range);
                return if before.is_some() { Err(twice()) } else { Ok(()) };
            }
        }
        for (part, name) in ["TX", "TY", "TZ"].into_iter().enumerate() {
            if let Some(value) = word.value(name) {
                let twice = || Fault::new(NcCode::Twice, "two words of one part").at(&word.range);
                let before = said.direction[part].replace(value?);
                return if before.is_some() { Err(twice()) } else { Ok(()) };
            }
        }
        let increment = word.text.starts_with('I');
        let text = word.text.strip_prefix('I').unwrap_or(&word.text);
        let letter = text.bytes().next().filter(u8::is_ascii_uppercase);
        let axis = letter.and_then(|letter| self.state.dialect.axis(letter - b'A' + 1));
        let named = if increment { 2 } else { 1 };
        let value = word.text.get(..named).and_then(|name| word.value(name));
        let (Some(axis), Some(value)) = (axis, value) else { return Err(word.no_meaning()) };
        let value = (value?, increment);
        if said.axes[axis].replace(value).is_some() {
            return Err(Fault::new(NcCode::Twice, "two words of one axis").at(&word.range));
        }
        Ok(())
    }
}
