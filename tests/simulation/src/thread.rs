//! Threads of a deep profile: what a CL record asks for, what an NC program
//! cuts, and whether the one is the other.
//!
//! Nothing here knows the post or its scripts. [`cycles`] makes passes of the
//! control's thread cycles, [`section`] moves the tool through the section of the
//! groove, and the formulas are those of the record's description. Lengths are
//! mm, angles degrees.

pub mod cycles;
pub mod drawing;
pub mod random;
pub mod section;

/// A thread and its tool, as one THREAD record names them.
#[derive(Clone, Debug, PartialEq)]
pub struct Thread {
    /// Radius of the crest.
    pub crest: f64,
    /// Z where the tool starts, for the middle of the groove.
    pub start: f64,
    /// Z where the thread ends.
    pub end: f64,
    /// From one groove to the next.
    pub pitch: f64,
    /// Number of grooves side by side.
    pub starts: u32,
    /// Depth of the first pass of G76.
    pub first: f64,
    /// Heights of the layers, from the crest inwards.
    pub layers: Vec<f64>,
    /// Width of the groove at its root.
    pub root: f64,
    /// Angle between the flanks.
    pub angle: f64,
    /// Angle of the flank towards the end of the thread, from the line square to the axis.
    pub end_flank: f64,
    /// Width of the tool's nose.
    pub nose: f64,
    /// Angle between the tool's edges.
    pub tool_angle: f64,
    /// Angle of the tool's edge towards the end of the thread.
    pub end_edge: f64,
    /// Largest shift between two passes of a layer.
    pub shift: f64,
    /// Clearance over the crest.
    pub clearance: f64,
    /// Finishing passes.
    pub finish: u32,
    /// The thread lies in a bore.
    pub internal: bool,
    /// Stock that may stay on the flanks.
    pub tolerance: f64,
}

impl Thread {
    /// Height of the profile.
    pub fn height(&self) -> f64 {
        self.layers.iter().sum()
    }

    /// What the tool travels along the axis in a turn.
    pub fn lead(&self) -> f64 {
        self.pitch * f64::from(self.starts)
    }

    /// Angles of the flanks, degrees: towards the end of the thread, and away from it.
    pub fn flanks(&self) -> [f64; 2] {
        [self.end_flank, self.angle - self.end_flank]
    }

    /// Tangents of the angles of the tool's edges, in the same order.
    pub fn edges(&self) -> [f64; 2] {
        [self.end_edge, self.tool_angle - self.end_edge].map(|angle| angle.to_radians().tan())
    }

    /// How far the groove reaches at a depth, from the middle of its root to either side.
    pub fn reach(&self, depth: f64) -> [f64; 2] {
        let rise = self.height() - depth;
        self.flanks().map(|angle| self.root / 2.0 + rise * angle.to_radians().tan())
    }

    /// The outer positions of the tool at a depth, from the middle of the root.
    pub fn outer(&self, depth: f64) -> [f64; 2] {
        let [end, away] = self.reach(depth);
        [self.nose / 2.0 - end, away - self.nose / 2.0]
    }

    /// Depths of the floors of the layers; the first is 0, the crest.
    pub fn floors(&self) -> Vec<f64> {
        let sum = |depth: &mut f64, height: &f64| {
            *depth += height;
            Some(*depth)
        };
        std::iter::once(0.0).chain(self.layers.iter().scan(0.0, sum)).collect()
    }

    /// Distance between the outer positions of the tool at a depth.
    pub fn span(&self, depth: f64) -> f64 {
        let [first, last] = self.outer(depth);
        last - first
    }

    /// CUT_OFFSET at a depth: the span in as few equal parts as the largest
    /// shift allows.
    pub fn cut_offset(&self, depth: f64) -> f64 {
        let span = self.span(depth);
        span / (span / self.shift - 1e-6).ceil().max(1.0)
    }

    /// +1 when depth goes towards the axis, -1 in a bore.
    pub fn inwards(&self) -> f64 {
        if self.internal { -1.0 } else { 1.0 }
    }

    /// +1 when Z rises from the end to the start.
    pub fn away(&self) -> f64 {
        (self.start - self.end).signum()
    }

    /// The CL file that cuts this thread alone.
    pub fn cl(&self) -> String {
        let Thread { crest, start, end, pitch, starts, first, root, angle, nose, .. } = self;
        let Thread { tool_angle, shift, clearance, finish, tolerance, .. } = self;
        let height = self.height();
        let side = if self.internal { "IN" } else { "OUT" };
        let layers: Vec<String> = self.layers.iter().map(f64::to_string).collect();
        let layers = layers.join(",");
        let Thread { end_flank, end_edge, .. } = self;
        let sides = if (*end_flank, *end_edge) == (angle / 2.0, tool_angle / 2.0) {
            String::new()
        } else {
            format!(", $\n FLANK, {end_flank}, EDGE, {end_edge}")
        };
        format!(
            "PARTNO / 90\nUNITS / MM\nLOADTL / 3\nSPINDL / RPM, 200, CLW\n\
             THREAD / AUTO, {crest}, 0, {start}, TO, {crest}, 0, {end}, MMPR, {pitch}, $\n \
             DEEP, {first}, LAST, {finish}, TYPE, 0, {height}, {angle}, IPM, 100, $\n \
             FEDTO, {clearance}, {side}, TIMES, {starts}, OFSETL, 0, {shift}, $\n \
             LAYER, {layers}, WIDTH, {root}, CUTTER, {nose}, {tool_angle}, TOLER, {tolerance}{sides}\n\
             FINI\n"
        )
    }
}
