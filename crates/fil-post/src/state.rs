//! What the post remembers between two records, beyond the commons.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Matrix3x4, Point3, Vector3};

use crate::block::Block;
use crate::cause::Cause;
use crate::words::circle::Arc;
use crate::words::cycle::Cycle;

/// How a feed is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// Units (mm or inch) a minute.
    PerMinute,
    /// Units (mm or inch) a revolution.
    PerRevolution,
}

/// A feed in output units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feed {
    /// mm/min, inch/min, mm/rev or inch/rev.
    pub value: f64,
    /// How it is meant.
    pub mode: FeedMode,
    /// The record that gave it.
    pub cause: Cause,
}

/// A transformation of the input (TRANS).
#[derive(Clone, Debug, PartialEq)]
pub struct Transformation {
    /// 3x4, by rows: rotation and translation of points.
    pub matrix: Matrix3x4<f64>,
    /// The tool axis is turned as well.
    pub turns_axis: bool,
}

impl Transformation {
    /// The transformed point.
    pub fn point(&self, point: Point3<f64>) -> Point3<f64> {
        Point3::from(self.matrix * point.to_homogeneous())
    }

    /// The linear part, 3x3.
    pub fn linear(&self) -> Matrix3<f64> {
        self.matrix.fixed_columns::<3>(0).into_owned()
    }

    /// The tool axis as the machine gets it.
    pub fn axis(&self, axis: Vector3<f64>) -> Vector3<f64> {
        if self.turns_axis { self.linear() * axis } else { axis }
    }

    /// True when lengths and angles are kept (a mirror image counts).
    pub fn is_rigid(&self) -> bool {
        let linear = self.linear();
        (linear.transpose() * linear - Matrix3::identity()).amax() < 1e-6
    }
}

/// When words that wait are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
    /// In a block of their own, at once.
    OwnBlock,
    /// In the next block that moves X or Y.
    NextXY,
    /// In the next block that moves Z.
    NextZ,
}

impl Placement {
    /// Reads a placement setting: 2 is the next XY block, 3 the next Z block,
    /// all else a block by itself.
    pub fn from_setting(value: i32) -> Self {
        match value {
            2 => Placement::NextXY,
            3 => Placement::NextZ,
            _ => Placement::OwnBlock,
        }
    }
}

/// Modal state of the post.
#[derive(Clone, Debug)]
pub struct State {
    /// The CL file is in mm (else inch).
    pub metric: bool,
    /// The start of the program has been written.
    pub started: bool,
    /// An END or REWIND has been written.
    pub ended: bool,
    /// Digits of the PARTNO text, for the program number.
    pub part_number: Option<i64>,
    /// Text of PARTNO.
    pub part_name: String,
    /// The PARTNO record.
    pub part_cause: Cause,
    /// Last CL point, mm or inch, in the part frame.
    pub point: Option<Point3<f64>>,
    /// Last CL tool axis.
    pub axis: Vector3<f64>,
    /// Last rotary positions in degrees; `None` before the first motion.
    pub rotary: Option<[f64; 2]>,
    /// The word of the current record that holds its x, followed by y and z;
    /// 0 when the motion does not go to a point of the record.
    pub point_word: u16,
    /// RAPID was given, by this record: the next motion is rapid.
    pub rapid: Option<Cause>,
    /// The motion G code the control stands at.
    pub motion: Option<i32>,
    /// What the next motion code is due to, when not to the record of the motion.
    pub motion_cause: Option<Cause>,
    /// The plane G code the control stands at.
    pub plane: Option<i32>,
    /// Feed of the next feed motion.
    pub feed: Option<Feed>,
    /// The feed mode the control stands at.
    pub feed_mode: Option<FeedMode>,
    /// The next feed motion repeats its F.
    pub force_feed: bool,
    /// CIRCLE waits for its end point.
    pub arc: Option<Arc>,
    /// The canned cycle that each GOTO carries out.
    pub cycle: Option<Cycle>,
    /// Words that wait for a motion.
    pub pending: Vec<(Placement, Block)>,
    /// Tool number of the last LOADTL.
    pub tool: Option<i64>,
    /// Tool length offset to be called with the next Z motion, and the record
    /// that asked for it.
    pub length_offset: Option<(i64, Cause)>,
    /// Diameter of the cutter, mm or inch.
    pub cutter: Option<f64>,
    /// Last spindle speed, revolutions a minute or surface speed.
    pub spindle: Option<f64>,
    /// Words REPEAT adds to each motion block, by letter, with their records.
    pub repeat: BTreeMap<u8, (f64, Cause)>,
    /// TRANS.
    pub transformation: Option<Transformation>,
    /// A thread is cut by each feed motion: pitch in mm or inch, and the record
    /// that gave it.
    pub thread: Option<(f64, Cause)>,
}

impl Default for State {
    fn default() -> Self {
        State {
            metric: true,
            started: false,
            ended: false,
            part_number: None,
            part_name: String::new(),
            part_cause: Cause::default(),
            point: None,
            axis: Vector3::z(),
            rotary: None,
            point_word: 0,
            rapid: None,
            motion: None,
            motion_cause: None,
            plane: None,
            feed: None,
            feed_mode: None,
            force_feed: false,
            arc: None,
            cycle: None,
            pending: Vec::new(),
            tool: None,
            length_offset: None,
            cutter: None,
            spindle: None,
            repeat: BTreeMap::new(),
            transformation: None,
            thread: None,
        }
    }
}
