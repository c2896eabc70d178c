//! Linear motion: from CL points to blocks with axis words.

use nalgebra::{Point3, Vector3};

use crate::axes::AXES;
use crate::commons::Int;
use crate::errors::PostCode;
use crate::letters::{F, G, H};
use crate::locations as loc;
use crate::post::Post;
use crate::state::{FeedMode, Placement};
use fil_diag::Diag;

/// Positions of the five axes: X Y Z in mm or inch, two rotaries in degrees.
pub type Position = [f64; AXES];

/// A set of axes: bit n is axis number n.
pub type AxisSet = u8;

/// X and Y.
pub const XY: AxisSet = 0b00011;
/// Z.
pub const Z: AxisSet = 0b00100;
/// Both rotary axes.
pub const ROTARY: AxisSet = 0b11000;
/// All axes.
pub const ALL: AxisSet = XY | Z | ROTARY;

/// The numbers of the axes in a set.
fn members(mut set: AxisSet) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let number = set.trailing_zeros() as usize;
        set &= set.wrapping_sub(1);
        (number < AXES).then_some(number)
    })
}

/// A CL point with its tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Tool tip in the part frame, mm or inch.
    pub point: Point3<f64>,
    /// Tool axis in the part frame.
    pub axis: Vector3<f64>,
}

impl Post {
    /// Positions of the axes for a target.
    ///
    /// # Errors
    /// The machine can't reach the tool axis.
    pub(crate) fn position_of(&mut self, target: Target) -> Result<Position, Box<Diag>> {
        let (point, axis) = self.transformed(target);
        let Some(kinematics) = self.machine.kinematics() else {
            return Ok([point.x, point.y, point.z, 0.0, 0.0]);
        };
        if !kinematics.has_rotary() && axis == kinematics.tool.into_inner() {
            return Ok([point.x, point.y, point.z, 0.0, 0.0]);
        }
        let last = self.state.rotary.unwrap_or_else(|| self.rotary_on_tape());
        let angles = kinematics.solve(axis, last)?;
        let linear = kinematics.linear(point, angles);
        self.state.rotary = Some(angles);
        Ok([linear.x, linear.y, linear.z, angles[0], angles[1]])
    }

    /// The target after TRANS and the input translation (DBLCOM 286–288).
    pub(crate) fn transformed(&self, target: Target) -> (Point3<f64>, Vector3<f64>) {
        let shift = [loc::INPUT_TRANSLATE_X, loc::INPUT_TRANSLATE_Y, loc::INPUT_TRANSLATE_Z]
            .map(|location| self.commons.dbl_opt(location).unwrap_or(0.0));
        let (point, axis) = match &self.state.transformation {
            Some(trans) => (trans.point(target.point), trans.axis(target.axis)),
            None => (target.point, target.axis),
        };
        (point + Vector3::from(shift), axis)
    }

    /// Rotary positions the last output values stand for; 0 where unknown.
    fn rotary_on_tape(&self) -> [f64; 2] {
        [3, 4].map(|number| {
            let axis = self.machine.axis(number);
            let value = self.commons.last_output(axis.letter);
            let known = self.machine.has_rotary(number) && value != crate::commons::EMPTY;
            if known { axis.position(value) } else { 0.0 }
        })
    }

    /// Moves in a straight line, rapid or at feed as RAPID and FEDRAT left it.
    ///
    /// # Errors
    /// An unreachable tool axis, no feed, a value that does not fit, a missing code.
    pub(crate) fn move_to(&mut self, target: Target) -> Result<(), Box<Diag>> {
        if self.state.cycle.is_some() {
            crate::words::cycle::cancel(self)?;
        }
        let position = self.position_of(target)?;
        self.state.point = Some(target.point);
        self.state.axis = target.axis;
        if let Some(cause) = self.state.rapid.take() {
            self.state.motion_cause = Some(cause);
            let result = self.rapid(&position);
            self.state.motion_cause = None;
            result
        } else if self.state.thread.is_some() {
            crate::words::thread::cut(self, &position)
        } else {
            self.feed(&position)
        }
    }

    /// A rapid motion, split into XY, rotary and Z when the machine asks for
    /// it; when Z retracts, the other way round.
    ///
    /// # Errors
    /// As [`Post::move_to`].
    pub(crate) fn rapid(&mut self, position: &Position) -> Result<(), Box<Diag>> {
        self.rapid_to(position, ALL)
    }

    /// As [`Post::rapid`], for some of the axes.
    ///
    /// # Errors
    /// As [`Post::move_to`].
    pub(crate) fn rapid_to(&mut self, position: &Position, axes: AxisSet) -> Result<(), Box<Diag>> {
        let modal = self.commons.int(loc::RAPID_MODAL) != 72;
        if self.commons.int(loc::RAPID_SPLIT) == 0 {
            let code = self.code(loc::RAPID_CODE_XY, "rapid motion")?;
            return self.rapid_block(position, axes, code, modal);
        }
        let across = (XY, loc::RAPID_CODE_XY);
        let turning = (ROTARY, loc::ROTARY_RAPID_CODE);
        let along = (Z, loc::RAPID_CODE_Z);
        let order = if axes & Z != 0 && self.retracts(position[2])? {
            [along, across, turning]
        } else {
            [across, turning, along]
        };
        let present = self.machine.present();
        for (group, code) in order.into_iter().filter(|(group, _)| group & present != 0) {
            let code = self.code(code, "rapid motion")?;
            self.rapid_block(position, axes & group, code, modal)?;
        }
        Ok(())
    }

    fn rapid_block(
        &mut self,
        position: &Position,
        axes: AxisSet,
        code: i32,
        modal: bool,
    ) -> Result<(), Box<Diag>> {
        if self.axis_words(position, axes)? {
            self.motion_code(code, modal);
            self.state.force_feed |= self.commons.flag(loc::RAPID_REPEAT_FEED);
            self.write_motion()?;
        }
        Ok(())
    }

    fn retracts(&self, z: f64) -> Result<bool, Box<Diag>> {
        let axis = self.machine.axis(2);
        let last = self.commons.last_output(axis.letter);
        Ok(last != crate::commons::EMPTY && axis.value(z)? > last)
    }

    /// A feed motion in one block.
    ///
    /// # Errors
    /// As [`Post::move_to`].
    pub(crate) fn feed(&mut self, position: &Position) -> Result<(), Box<Diag>> {
        self.feed_to(position, ALL)
    }

    /// As [`Post::feed`], for some of the axes.
    ///
    /// # Errors
    /// As [`Post::move_to`].
    pub(crate) fn feed_to(&mut self, position: &Position, axes: AxisSet) -> Result<(), Box<Diag>> {
        if !self.axis_words(position, axes)? {
            return Ok(());
        }
        let code = self.code(loc::LINEAR_CODE, "linear motion")?;
        let modal = self.commons.int(loc::LINEAR_MODAL) != 1;
        self.motion_code(code, modal);
        self.feed_words()?;
        self.write_motion()
    }

    /// Adds the words of the axes that move; says whether any does.
    ///
    /// # Errors
    /// A value that does not fit its address.
    pub(crate) fn axis_words(
        &mut self,
        position: &Position,
        axes: AxisSet,
    ) -> Result<bool, Box<Diag>> {
        let mut scaled = [0; AXES];
        let mut changed: AxisSet = 0;
        let present = axes & self.machine.present();
        for number in members(present) {
            let axis = self.machine.axis(number);
            axis.check(position[number])?;
            if !axis.is_off() {
                scaled[number] = axis.scaled(position[number])?;
                changed |= AxisSet::from(axis.changes(scaled[number], &self.commons)) << number;
            }
        }
        if changed == 0 {
            return Ok(false);
        }
        let written = if self.commons.flag(loc::MOTION_MODAL) { changed } else { present };
        for number in members(written) {
            if let Some(place) = self.machine.axis(number).place()? {
                self.block.put(place, scaled[number]);
            }
        }
        if self.block.noting {
            self.note_axis_words(written);
        }
        Ok(true)
    }

    /// Notes which words of the record the words of axes repeat. It is the record
    /// as a whole where a rotary axis or TRANS mixes its coordinates, and where the
    /// motion does not go to its point.
    fn note_axis_words(&mut self, written: AxisSet) {
        let mixed = self.state.transformation.is_some()
            || self.machine.kinematics().is_some_and(|kinematics| {
                kinematics.has_rotary() || self.state.axis != kinematics.tool.into_inner()
            });
        let first = self.state.point_word;
        if mixed || first == 0 {
            return;
        }
        for number in members(written & (XY | Z)) {
            if let Ok(Some(place)) = self.machine.axis(number).place() {
                self.block.note_word(place, first + number as u16);
            }
        }
    }

    /// Adds one axis word if it has changed or `always`.
    ///
    /// # Errors
    /// A value that does not fit its address.
    pub(crate) fn axis_word(
        &mut self,
        number: usize,
        position: f64,
        always: bool,
    ) -> Result<bool, Box<Diag>> {
        let axis = self.machine.axis(number);
        let written = axis.write(position, always, &mut self.block, &self.commons)?;
        if written && self.block.noting {
            self.note_axis_words(1 << number);
        }
        Ok(written)
    }

    /// Adds a motion G code unless the control stands at it.
    pub(crate) fn motion_code(&mut self, code: i32, modal: bool) {
        self.check_forgotten();
        if !modal || self.state.motion != Some(code) {
            self.put_motion_code(code);
        }
    }

    #[cold]
    fn put_motion_code(&mut self, code: i32) {
        let cause = self.state.motion_cause.unwrap_or(self.block.cause);
        self.block.g_due_to(code, cause);
        self.state.motion = Some(code);
    }

    /// Adds the feed mode code and the F word where they have changed.
    ///
    /// # Errors
    /// No feed was given, or it does not fit its address.
    pub(crate) fn feed_words(&mut self) -> Result<(), Box<Diag>> {
        let feed = self.state.feed.ok_or_else(|| {
            Box::new(Diag::new(PostCode::NoFeed, "no FEDRAT came before this motion"))
        })?;
        if self.state.feed_mode != Some(feed.mode) {
            let code = self.code(feed_mode_code(feed.mode), "this feed mode")?;
            self.block.g_due_to(code, feed.cause.whole());
            self.state.feed_mode = Some(feed.mode);
            self.state.force_feed = true;
        }
        if std::mem::take(&mut self.state.force_feed) {
            return self.because(feed.cause, |post| post.word(F, feed.value));
        }
        let put = self.block.modal(F, feed.value, &self.machine.addresses, &self.commons)?;
        if let Some(position) = put {
            self.block.note_cause(position, feed.cause);
        }
        Ok(())
    }

    /// Writes a motion block: adds the words that wait for it and those of
    /// REPEAT.
    ///
    /// # Errors
    /// As [`Post::write_block`].
    pub(crate) fn write_motion(&mut self) -> Result<(), Box<Diag>> {
        if !self.state.pending.is_empty() {
            self.take_pending();
        }
        if self.state.length_offset.is_some() {
            self.length_offset_words()?;
        }
        if self.state.repeat.is_empty() {
            return self.write_block();
        }
        let mut kept = Vec::new();
        for (letter, (value, cause)) in self.state.repeat.clone() {
            if !self.block.has(letter, &self.machine.addresses) {
                kept.push((letter, self.commons.last_output(letter)));
                self.because(cause, |post| post.word(letter, value))?;
            }
        }
        self.write_block()?;
        for (letter, value) in kept {
            self.commons.set_last_output(letter, value);
        }
        Ok(())
    }

    /// True when the block under construction has a word of axis `number`.
    fn moves_axis(&self, number: usize) -> bool {
        self.block.has(self.machine.axis(number).letter, &self.machine.addresses)
    }

    fn take_pending(&mut self) {
        let moves_xy = self.moves_axis(0) || self.moves_axis(1);
        let moves_z = self.moves_axis(2);
        let mut waiting = std::mem::take(&mut self.state.pending);
        waiting.retain(|(placement, words)| {
            let due = match placement {
                Placement::OwnBlock => true,
                Placement::NextXY => moves_xy,
                Placement::NextZ => moves_z,
            };
            if due {
                self.block.merge(words);
            }
            !due
        });
        self.state.pending = waiting;
    }

    /// G43 H with the first Z motion after a tool change.
    fn length_offset_words(&mut self) -> Result<(), Box<Diag>> {
        if !self.moves_axis(2) {
            return Ok(());
        }
        if let Some((offset, cause)) = self.state.length_offset.take() {
            let code = self.code(loc::TOOL_LENGTH_CODE, "tool length offset")?;
            self.because(cause, |post| {
                post.block.g_of_record(code);
                post.word(H, offset as f64)
            })?;
        }
        Ok(())
    }

    /// Remembers a motion G code that was written outside of motions.
    pub(crate) fn note_g(&mut self, code: i32) {
        let motion =
            [loc::RAPID_CODE_XY, loc::LINEAR_CODE, loc::CIRCLE_CW_CODE, loc::CIRCLE_CCW_CODE]
                .map(|location| self.commons.int(location));
        self.state.motion = motion.contains(&code).then_some(code);
        self.commons.set_last_output(G, f64::from(code));
    }
}

/// Location of a feed mode's preparatory function.
pub(crate) fn feed_mode_code(mode: FeedMode) -> Int {
    match mode {
        FeedMode::PerMinute => loc::FEED_UPM_CODE,
        FeedMode::PerRevolution => loc::FEED_UPR_CODE,
    }
}
