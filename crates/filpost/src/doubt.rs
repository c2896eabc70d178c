//! What is no longer certain after a record was refused, and which errors rest on it.
//!
//! After the first error the records are only looked at for further ones. An error that may
//! follow from a record refused before it is not told: a question with a false reason costs
//! more than one that comes in the next run.

use fil_cl::record::kind;
use fil_cl::{Record, WordId, words as w};
use fil_diag::Code;
use fil_machine::errors::MachineCode;
use fil_post::errors::PostCode;

/// Things that a refused record leaves in doubt.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Doubt(u8);

impl Doubt {
    /// Where the tool and the axes stand.
    pub const POSITION: Doubt = Doubt(1);
    /// The feed.
    pub const FEED: Doubt = Doubt(2);
    /// The unit.
    pub const UNIT: Doubt = Doubt(4);
    /// The cycle.
    pub const CYCLE: Doubt = Doubt(8);
    /// Cutter compensation.
    pub const COMPENSATION: Doubt = Doubt(16);
    /// The tool axis.
    pub const AXIS: Doubt = Doubt(32);
    /// The frame that the points are given in.
    pub const FRAME: Doubt = Doubt(64);
    /// All about the path but feed and unit.
    pub const PATH: Doubt =
        Self::POSITION.and(Self::CYCLE).and(Self::COMPENSATION).and(Self::AXIS).and(Self::FRAME);
    /// Everything.
    pub const ALL: Doubt = Doubt(u8::MAX);

    /// Both.
    pub const fn and(self, other: Doubt) -> Doubt {
        Doubt(self.0 | other.0)
    }

    /// Without what is certain again.
    pub fn without(self, certain: Doubt) -> Doubt {
        Doubt(self.0 & !certain.0)
    }

    /// True when something of the one is in the other.
    pub fn overlaps(self, other: Doubt) -> bool {
        self.0 & other.0 != 0
    }

    /// True when nothing is in doubt.
    pub fn is_none(self) -> bool {
        self.0 == 0
    }

    /// What a refused statement of a word may have said.
    pub fn left_by(word: WordId) -> Doubt {
        match word {
            w::GOTO | w::FROM | w::GODLTA | w::GOHOME | w::CIRCLE | w::RAPID | w::TLON => {
                Doubt::POSITION
            }
            w::FEDRAT => Doubt::FEED,
            w::UNITS | w::UNIT => Doubt::UNIT,
            w::CYCLE => Doubt::CYCLE.and(Doubt::FEED).and(Doubt::POSITION),
            w::ROTABL
            | w::ROTATE
            | w::ROTHED
            | w::HEAD
            | w::INDEX
            | w::ORIGIN
            | w::SET
            | w::TRANS
            | w::TRACUT
            | w::RETRCT
            | w::SWITCH
            | w::SYNC => Doubt::PATH,
            w::CUTCOM | w::LOADTL | w::LOAD | w::TURRET => Doubt::COMPENSATION,
            w::MULTAX | w::TLAXIS => Doubt::AXIS,
            w::SPINDL | w::COOLNT | w::PPRINT | w::SELCTL | w::SELECT | w::DELAY | w::SEQNO => {
                Doubt::default()
            }
            _ => Doubt::ALL,
        }
    }
}

/// What an error about a record rests on besides the record itself.
pub(crate) fn rests_on(code: &Code, record: &Record) -> Doubt {
    use PostCode as P;
    let any = |posts: &[P]| posts.iter().any(|post| code == <&Code>::from(*post));
    let is = |machine: MachineCode| code == <&Code>::from(machine);
    if record.kind == kind::FINI {
        return Doubt::ALL;
    }
    if any(&[P::ArcStart, P::ArcRadius, P::ArcSense, P::ArcEnd]) {
        return Doubt::POSITION;
    }
    if any(&[P::UnknownWord, P::ProgramNumber, P::TextCharacter]) {
        return Doubt::default();
    }
    let stays = left_without(code);
    if stays != Doubt::default() {
        return stays;
    }
    if record.kind == kind::MOTION {
        return match () {
            () if is(MachineCode::ToolAxis) && record.axis().is_some() => Doubt::FRAME,
            () if is(MachineCode::Overflow) || is(MachineCode::AxisLimit) => {
                Doubt::UNIT.and(Doubt::FRAME)
            }
            () => Doubt::ALL,
        };
    }
    match record.major {
        _ if !any(&[P::WordForm, P::NoCode, P::CycleForm]) => Doubt::ALL,
        // The cycle may take the feed of FEDRAT, an offset may be that of the tool.
        w::CYCLE => Doubt::FEED,
        w::CUTCOM => Doubt::COMPENSATION,
        _ => Doubt::default(),
    }
}

/// What is missing or wrong for the records that follow, too, so that the error would come
/// again with each of them.
pub(crate) fn left_without(code: &Code) -> Doubt {
    use PostCode as P;
    let any = |posts: &[P]| posts.iter().any(|post| code == <&Code>::from(*post));
    match () {
        () if any(&[P::NoFeed]) => Doubt::FEED,
        () if any(&[P::NoUnit, P::UnitChange, P::Units]) => Doubt::UNIT,
        () if any(&[P::AxisLength]) => Doubt::AXIS,
        () if any(&[P::InCycle]) => Doubt::CYCLE,
        () if any(&[P::AfterEnd, P::SkippedPart, P::Unwinding]) => Doubt::ALL,
        () if any(&[P::CompensationOn, P::CompensationOnArc, P::CompensationLost]) => Doubt::ALL,
        () => Doubt::default(),
    }
}
