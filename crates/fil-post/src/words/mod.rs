//! The post words, one file each: what a CL record makes the machine do.
//!
//! [`HANDLERS`] is the index: the major word and the function that carries it out.

pub mod circle;
pub mod coolnt;
pub mod cutcom;
pub mod cutter;
pub mod cycle;
pub mod cycle_expand;
pub mod delay;
pub mod end;
pub mod fedrat;
pub mod fini;
pub mod form;
pub mod from;
pub mod godlta;
pub mod goto;
pub mod insert;
pub mod loadtl;
pub mod machin;
pub mod mode;
pub mod multax;
pub mod op;
pub mod opskip;
pub mod partno;
pub mod postn;
pub mod pprint;
pub mod prefun;
pub mod pseudo;
pub mod rapid;
pub mod repeat;
pub mod rewind;
pub mod seqno;
pub mod spindl;
pub mod stop;
pub mod thread;
pub mod trans;
pub mod units;
pub mod unsupported;

use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_cl::{Record, WordId};
use fil_diag::Diag;

use crate::post::Post;

/// Carries out a record of one major word.
pub type Handler = fn(&mut Post, &Record, &Vocabulary) -> Result<(), Box<Diag>>;

/// Major words and their handlers.
pub const HANDLERS: &[(WordId, Handler)] = &[
    (w::AUXFUN, prefun::auxfun),
    (w::CALSUB, unsupported::handle),
    (w::CIRCLE, circle::handle),
    (w::COOLNT, coolnt::handle),
    (w::COPY, unsupported::handle),
    (w::CUTCOM, cutcom::handle),
    (w::CUTTER, cutter::handle),
    (w::CYCLE, cycle::handle),
    (w::DEFSUB, unsupported::handle),
    (w::DELAY, delay::handle),
    (w::END, end::handle),
    (w::ENDSUB, unsupported::handle),
    (w::FEDRAT, fedrat::handle),
    (w::FINI, fini::handle),
    (w::FROM, from::handle),
    (w::GODLTA, godlta::handle),
    (w::GOHOME, goto::gohome),
    (w::GOTO, goto::handle),
    (w::HEAD, unsupported::handle),
    (w::INDEX, unsupported::handle),
    (w::INSERT, insert::handle),
    (w::LOAD, loadtl::handle),
    (w::LOADTL, loadtl::handle),
    (w::MACHIN, machin::handle),
    (w::MODE, mode::handle),
    (w::MULTAX, multax::handle),
    (w::OP, op::handle),
    (w::OPSKIP, opskip::handle),
    (w::OPSTOP, stop::opstop),
    (w::ORIGIN, unsupported::handle),
    (w::PARTNO, partno::handle),
    (w::POSTN, postn::handle),
    (w::PPRINT, pprint::handle),
    (w::PREFUN, prefun::prefun),
    (w::RAPID, rapid::handle),
    (w::REPEAT, repeat::handle),
    (w::REWIND, rewind::handle),
    (w::ROTABL, unsupported::handle),
    (w::ROTATE, unsupported::handle),
    (w::ROTHED, unsupported::handle),
    (w::SELCTL, loadtl::select),
    (w::SELECT, loadtl::select),
    (w::SEQNO, seqno::handle),
    (w::SPINDL, spindl::handle),
    (w::STOP, stop::stop),
    (w::THREAD, thread::handle),
    (w::TLAXIS, multax::tlaxis),
    (w::TRACUT, unsupported::handle),
    (w::TRANS, trans::handle),
    (w::TURRET, loadtl::handle),
    (w::UNIT, units::handle),
    (w::UNITS, units::handle),
];
