//! Which function carries out which major word.

use std::sync::LazyLock;

use fil_cl::WordId;
use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use crate::items::Items;
use crate::operation::Target;
use crate::post::Post;
use crate::words as word;

/// Carries out a record of one major word.
#[derive(Clone, Copy)]
pub enum Handler {
    /// A motion record: its point and tool axis.
    Point(fn(&mut Post, Target) -> Result<()>),
    /// A post command: its items.
    Items(fn(&mut Post, &mut Items) -> Result<()>),
    /// A word that changes the path or the frame in a way the post does not know.
    Refused,
    /// One that it knows where the machine says what it means; else false, and refused.
    Chosen(fn(&mut Post, &mut Items) -> Result<bool>),
}

use Handler::{Chosen, Items as I, Point as P, Refused};

/// Major words and their handlers.
pub const HANDLERS: &[(WordId, Handler)] = &[
    (w::ARCSLP, I(word::arcslp::handle)),
    (w::AUXFUN, I(word::prefun::auxfun)),
    (w::CALSUB, Refused),
    (w::CIRCLE, I(word::circle::handle)),
    (w::CLAMP, I(word::clamp::handle)),
    (w::COOLNT, I(word::coolnt::handle)),
    (w::COPY, Refused),
    (w::CUTCOM, I(word::cutcom::handle)),
    (w::CUTTER, I(word::cutter::handle)),
    (w::CYCLE, I(word::cycle::handle)),
    (w::DEFSUB, Refused),
    (w::DELAY, I(word::delay::handle)),
    (w::END, I(word::end::end)),
    (w::ENDSUB, Refused),
    (w::FEDRAT, I(word::fedrat::handle)),
    (w::FINI, I(word::end::fini)),
    (w::FROM, P(word::from::handle)),
    (w::GODLTA, I(word::godlta::handle)),
    (w::GOHOME, I(word::goto::gohome)),
    (w::GOTO, P(word::goto::handle)),
    (w::HEAD, Refused),
    (w::INDEX, Refused),
    (w::INSERT, I(word::insert::handle)),
    (w::LINTOL, I(word::lintol::handle)),
    (w::LOAD, I(word::loadtl::handle)),
    (w::LOADTL, I(word::loadtl::handle)),
    (w::MODE, I(word::mode::handle)),
    (w::MULTAX, I(word::multax::handle)),
    (w::OP, I(word::op::handle)),
    (w::OPSKIP, I(word::opskip::handle)),
    (w::OPSTOP, I(word::stop::opstop)),
    (w::ORIGIN, Chosen(word::trans::origin)),
    (w::PARTNO, I(word::partno::handle)),
    (w::PITCH, I(word::thread::pitch)),
    (w::PLABEL, Chosen(word::plabel::handle)),
    (w::POSTN, I(word::postn::handle)),
    (w::PPRINT, I(word::pprint::handle)),
    (w::PREFUN, I(word::prefun::prefun)),
    (w::RAPID, I(word::rapid::handle)),
    (w::REPEAT, I(word::repeat::handle)),
    (w::REPLAC, I(word::replac::handle)),
    (w::RETRCT, I(word::home::retrct)),
    (w::REWIND, I(word::end::rewind)),
    (w::ROTABL, Chosen(word::rotabl::handle)),
    (w::ROTATE, Chosen(word::rotabl::handle)),
    (w::ROTHED, Refused),
    (w::SELCTL, I(word::loadtl::select)),
    (w::SELECT, I(word::loadtl::select)),
    (w::SEQNO, I(word::seqno::handle)),
    (w::SET, I(word::set::handle)),
    (w::SPINDL, I(word::spindl::handle)),
    (w::STOP, I(word::stop::stop)),
    (w::SWITCH, Refused),
    (w::SYNC, Refused),
    (w::THREAD, I(word::thread::handle)),
    (w::TLAXIS, I(word::multax::tlaxis)),
    (w::TRACUT, Chosen(word::trans::tracut)),
    (w::TRANS, I(word::trans::handle)),
    (w::TURRET, I(word::loadtl::handle)),
    (w::UNIT, I(word::units::handle)),
    (w::UNITS, I(word::units::handle)),
];

/// The handlers by the index of their major word.
static BY_INDEX: LazyLock<Vec<Option<Handler>>> = LazyLock::new(|| {
    let most = HANDLERS.iter().map(|(word, _)| word.index()).max().unwrap_or(0);
    let mut handlers = vec![None; most + 1];
    for (word, handler) in HANDLERS {
        handlers[word.index()] = Some(*handler);
    }
    handlers
});

/// The handler of a major word; `None` for one that the post does not know.
#[inline]
pub fn of(word: WordId) -> Option<Handler> {
    BY_INDEX.get(word.index()).copied().flatten()
}
