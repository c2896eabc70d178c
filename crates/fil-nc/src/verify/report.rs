//! What a back-check found.

use std::fmt;

use super::between::Between;

/// What a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FindingKind {
    /// The end of a motion, a depth, an arc's center.
    Position,
    /// The direction of the tool.
    Axis,
    /// The sense, plane or length of an arc.
    Arc,
    /// Rapid traverse where the CL file asks for feed.
    RapidForFeed,
    /// Feed where the CL file asks for rapid traverse.
    FeedForRapid,
    /// A thread pass or tap without its lead, or a motion with one it should not have.
    Thread,
    /// A motion, hole or dwell the CL file asks for is not there.
    Missing,
    /// A motion, hole or dwell the CL file does not ask for.
    Extra,
    /// The order of the axes in a rapid.
    Order,
    /// The feed.
    Feed,
    /// The spindle's direction, or that it stands.
    Spindle,
    /// The spindle's speed.
    Speed,
    /// The coolant.
    Coolant,
    /// The tool or its length offset.
    Tool,
    /// Any other auxiliary function.
    Auxiliary,
    /// Cutter compensation.
    Compensation,
    /// The work offset.
    Fixture,
    /// The way a hole is made: pecks, return level, dwell.
    Cycle,
    /// A dwell of another length.
    Dwell,
    /// The path between the ends of a motion that turns the machine.
    Between,
    /// The travel of an axis.
    Limit,
    /// mm in place of inch, or the reverse.
    Units,
    /// A line of the tape that the settings or INSERT ask for.
    Block,
    /// A mode that the program depends on and leaves to the control.
    StartMode,
    /// The end of the program.
    End,
}

impl FindingKind {
    /// The word for it in JSON.
    pub fn name(self) -> &'static str {
        match self {
            FindingKind::Position => "position",
            FindingKind::Axis => "tool-axis",
            FindingKind::Arc => "arc",
            FindingKind::RapidForFeed => "rapid-for-feed",
            FindingKind::FeedForRapid => "feed-for-rapid",
            FindingKind::Thread => "thread",
            FindingKind::Missing => "missing",
            FindingKind::Extra => "extra",
            FindingKind::Order => "order-of-axes",
            FindingKind::Feed => "feed",
            FindingKind::Spindle => "spindle",
            FindingKind::Speed => "speed",
            FindingKind::Coolant => "coolant",
            FindingKind::Tool => "tool",
            FindingKind::Auxiliary => "auxiliary-function",
            FindingKind::Compensation => "compensation",
            FindingKind::Fixture => "work-offset",
            FindingKind::Cycle => "cycle",
            FindingKind::Dwell => "dwell",
            FindingKind::Between => "between",
            FindingKind::Limit => "limit",
            FindingKind::Units => "units",
            FindingKind::Block => "block",
            FindingKind::StartMode => "start-mode",
            FindingKind::End => "end",
        }
    }
}

/// Something that is not as the reference says.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is about.
    pub kind: FindingKind,
    /// Line of the CL file, where one asks for it.
    pub cl_line: Option<u32>,
    /// Line of the NC program, where one does it.
    pub nc_line: Option<u32>,
    /// What is wrong, in a machinist's words.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.nc_line, self.cl_line) {
            (Some(nc), Some(cl)) => write!(f, "NC line {nc} (CL line {cl}): ")?,
            (Some(nc), None) => write!(f, "NC line {nc}: ")?,
            (None, Some(cl)) => write!(f, "CL line {cl}: ")?,
            (None, None) => {}
        }
        f.write_str(&self.message)
    }
}

/// Something the reference does not determine, so that it was not compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unverified {
    /// Line of the CL file, where it stands there.
    pub cl_line: Option<u32>,
    /// What was not compared.
    pub what: String,
}

/// How far the program is from the path, over all motions compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The largest, mm or degrees.
    pub max: f64,
    /// Line of the NC program where it is the largest; 0 before any motion.
    pub nc_line: u32,
    squares: f64,
    count: u64,
}

impl Deviation {
    pub(super) fn add(&mut self, value: f64, nc_line: u32) {
        if self.count == 0 || value > self.max {
            self.max = value;
            self.nc_line = nc_line;
        }
        self.squares += value * value;
        self.count += 1;
    }

    /// Root of the mean square, in the unit of the largest one; 0 before any motion.
    pub fn rms(&self) -> f64 {
        if self.count == 0 { 0.0 } else { (self.squares / self.count as f64).sqrt() }
    }
}

/// How a back-check ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All was compared, and it agrees.
    Agrees,
    /// What was compared agrees, but something could not be compared.
    Partly,
    /// Something differs.
    Differs,
}

/// What a back-check found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Differences in the order of the program.
    pub findings: Vec<Finding>,
    /// Further findings that are not listed.
    pub more: u64,
    /// What was not compared.
    pub unverified: Vec<Unverified>,
    /// What further was not compared and is not listed.
    pub more_unverified: u64,
    /// Motions and holes of the reference that were compared.
    pub compared: u64,
    /// Those of them that the program makes.
    pub matched: u64,
    /// Those of them in operations that the program leaves out as a whole.
    pub left_out: u64,
    /// Deviation of the tool tip, mm.
    pub position: Deviation,
    /// Deviation of the tool axis, degrees.
    pub axis: Deviation,
    /// Between the ends of motions that turn the machine; `None` without any.
    pub between: Option<Between>,
}

impl Report {
    /// Findings that are listed, and of what was not compared; the rest is counted.
    pub const LISTED: usize = 50;

    /// How it ends.
    pub fn verdict(&self) -> Verdict {
        match () {
            () if !self.findings.is_empty() => Verdict::Differs,
            () if !self.unverified.is_empty() => Verdict::Partly,
            () => Verdict::Agrees,
        }
    }

    /// Takes up what was found when the control left out the blocks that may be skipped.
    #[must_use]
    #[doc(hidden)]
    pub fn with_blocks_left_out(mut self, other: Report) -> Report {
        for finding in other.findings {
            if !self.findings.contains(&finding) {
                let message = format!("{}, with block delete on", finding.message);
                self.find(Finding { message, ..finding });
            }
        }
        self.more += other.more;
        for open in other.unverified {
            if !self.unverified.contains(&open) {
                self.leave_open(open);
            }
        }
        self.more_unverified = self.more_unverified.max(other.more_unverified);
        self
    }

    /// Takes up the findings of another report behind its own.
    pub(super) fn append(&mut self, other: Report) {
        other.findings.into_iter().for_each(|finding| self.find(finding));
        self.more += other.more;
    }

    /// Takes up what was not compared.
    pub(super) fn leave_open(&mut self, open: Unverified) {
        if self.unverified.len() < Self::LISTED {
            self.unverified.push(open);
        } else {
            self.more_unverified += 1;
        }
    }

    pub(super) fn find(&mut self, finding: Finding) {
        if self.findings.len() < Self::LISTED {
            self.findings.push(finding);
        } else {
            self.more += 1;
        }
    }
}
