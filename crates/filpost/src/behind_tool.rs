//! What comes behind a tool change: the next tools, the speed of the spindle, and how the tool lies
//! while it cuts.

use fil_cl::{Record, Word, WordId, record::kind, words};
use fil_post::operation::{NextTools, ToolAhead};

/// Tool axes nearer than this are one.
const SAME_AXIS: f64 = 1e-6;

/// What was seen behind a tool change so far.
pub struct BehindTool {
    /// The tool of the change at hand.
    tool: Option<i64>,
    /// Some change was seen.
    any: bool,
    /// The tool changes behind it, once they are known.
    next: NextTools,
    speed: SpeedSeen,
    axis: AxisSeen,
}

impl BehindTool {
    /// Nothing yet, behind a record that takes a tool.
    pub fn of(record: &Record) -> Self {
        BehindTool {
            tool: tool_of(record),
            any: false,
            next: NextTools::Unknown,
            speed: SpeedSeen::Open,
            axis: AxisSeen::default(),
        }
    }

    /// Looks at a record; true when nothing more needs to be looked at.
    pub fn take(&mut self, record: &Record) -> bool {
        if record.kind == kind::FINI {
            self.end();
            return true;
        }
        self.speed = self.speed.take(record);
        if !self.any {
            self.axis.take(record);
        }
        if record.takes_tool() {
            self.any = true;
            let other = tool_of(record);
            if other != self.tool {
                self.next = NextTools::Some { other, by_hand: record.has(words::MANUAL) };
                return true;
            }
        }
        false
    }

    /// The file ends there.
    pub fn end(&mut self) {
        self.next = match self.any {
            true => NextTools::Some { other: None, by_hand: false },
            false => NextTools::None,
        };
    }

    /// What is known now.
    pub fn found(&self) -> ToolAhead {
        ToolAhead {
            next: self.next,
            speed: self.speed.known(),
            turns_in_cut: self.axis.turns_in_cut,
            needs_a_plane: self.axis.needs_a_plane,
        }
    }
}

/// What was seen of the tool axis.
#[derive(Default)]
struct AxisSeen {
    /// The last one.
    last: Option<[f64; 3]>,
    /// RAPID came, and its motion not yet.
    is_rapid: bool,
    turns_in_cut: bool,
    needs_a_plane: bool,
}

impl AxisSeen {
    fn take(&mut self, record: &Record) {
        match record.major {
            words::RAPID => self.is_rapid = true,
            words::CYCLE if record.has(words::TAP) => self.needs_a_plane = true,
            words::CUTCOM if record.has(words::LEFT) || record.has(words::RIGHT) => {
                self.needs_a_plane = true;
            }
            _ => {}
        }
        if record.kind != kind::MOTION {
            return;
        }
        let is_cut = !std::mem::take(&mut self.is_rapid);
        let Some(axis) = record.axis() else { return };
        let same = |last: [f64; 3]| last.iter().zip(axis).all(|(a, b)| (a - b).abs() < SAME_AXIS);
        self.turns_in_cut |= is_cut && !self.last.is_none_or(same);
        self.last = Some(axis);
    }
}

/// What was seen of the speed of the spindle.
#[derive(Clone, Copy)]
enum SpeedSeen {
    /// Nothing yet.
    Open,
    /// SPINDL with a speed, rev/min.
    Known(f64),
    /// Another SPINDL, or a motion, came first.
    Closed,
}

impl SpeedSeen {
    fn take(self, record: &Record) -> SpeedSeen {
        match self {
            SpeedSeen::Open if record.kind == kind::MOTION => SpeedSeen::Closed,
            SpeedSeen::Open if record.major == words::SPINDL => {
                record.number_after(words::RPM).map_or(SpeedSeen::Closed, SpeedSeen::Known)
            }
            seen => seen,
        }
    }

    fn known(self) -> Option<f64> {
        match self {
            SpeedSeen::Known(speed) => Some(speed),
            SpeedSeen::Open | SpeedSeen::Closed => None,
        }
    }
}

/// The tool that a record takes: its first number that is no length and no offset.
fn tool_of(record: &Record) -> Option<i64> {
    const COUPLETS: [WordId; 3] = [words::LENGTH, words::OSETNO, words::ADJUST];
    let of_couplet = |at: usize| {
        let before = at.checked_sub(1).and_then(|at| record.data.get(at));
        COUPLETS.iter().any(|word| before == Some(&Word::Minor(*word)))
    };
    record.data.iter().enumerate().find_map(|(at, item)| match item {
        Word::Number(number) if number.fract() == 0.0 && !of_couplet(at) => Some(*number as i64),
        _ => None,
    })
}
