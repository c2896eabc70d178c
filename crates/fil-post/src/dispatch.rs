//! The one door for records: it hands each handler what the record holds, and
//! refuses what the handler did not take. No handler can bypass it.
//!
//! [`HANDLERS`] is the index: the major word and the function that carries it out.

use fil_cl::record::kind;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_cl::{Record, WordId};
use fil_diag::{Diag, Result};
use nalgebra::{Point3, Vector3};

use crate::control::sinumerik::tool_names;
use crate::errors::PostCode;
use crate::items::Items;
use crate::no_effect;
use crate::operation::Target;
use crate::post::Post;
use crate::site_word;
use crate::words as word;

/// The word of a motion record that holds its x.
pub const POINT: u16 = 6;

/// Number of data words of a motion to a point, and of one with a tool axis.
const MOTION: [usize; 2] = [5, 8];

/// A tool axis may be this far from length 1, unless MULTAX is on.
const AXIS_LENGTH: f64 = 0.01;

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
#[derive(Clone)]
pub struct Dispatcher {
    handlers: Vec<Option<Handler>>,
}

impl Default for Dispatcher {
    fn default() -> Self {
        let most = HANDLERS.iter().map(|(word, _)| word.index()).max().unwrap_or(0);
        let mut handlers = vec![None; most + 1];
        for (word, handler) in HANDLERS {
            handlers[word.index()] = Some(*handler);
        }
        Dispatcher { handlers }
    }
}

impl Dispatcher {
    #[inline]
    fn handler(&self, word: WordId) -> Option<Handler> {
        self.handlers.get(word.index()).copied().flatten()
    }
}

/// Carries out a record.
///
/// # Errors
/// Whatever its post word refuses; items that no handler took; a word that neither
/// the post knows nor a table lists as without effect.
#[inline]
pub fn dispatch(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<()> {
    if record.kind == kind::PSEUDO {
        word::csys::note(post, vocabulary.name(record.major), record)?;
        return word::pseudo::handle(post, &mut Items::new(record, vocabulary)?);
    }
    if record.inert {
        return note(post, record, vocabulary);
    }
    match post.dispatcher.handler(record.major) {
        Some(Handler::Point(handle)) => {
            if record.number < post.path.named_frames.since {
                word::csys::refuse_read_again(post)?;
            }
            let target = target(post, record, vocabulary)?;
            handle(post, target)
        }
        Some(Handler::Items(handle)) => {
            let mut items = Items::new(record, vocabulary)?;
            handle(post, &mut items)?;
            items.deny_rest()
        }
        Some(Handler::Refused | Handler::Chosen(_)) | None
            if is_without_effect(post, vocabulary.name(record.major)) =>
        {
            note(post, record, vocabulary)
        }
        Some(Handler::Chosen(handle)) => {
            let mut items = Items::new(record, vocabulary)?;
            if handle(post, &mut items)? {
                return items.deny_rest();
            }
            Err(refused(record, vocabulary))
        }
        Some(Handler::Refused) => Err(refused(record, vocabulary)),
        None => Err(unknown(record.major, vocabulary)),
    }
}

/// What a word without effect says all the same: the name of a tool, the frame of the points.
fn note(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<()> {
    tool_names::note(&mut post.control, record);
    word::csys::note(post, vocabulary.name(record.major), record)
}

/// True for a word that the table of the post, or the machine, lists as without effect.
fn is_without_effect(post: &Post, name: &str) -> bool {
    let listed = post.control.commons.words_without_effect();
    no_effect::is_whole_record(name) || listed.iter().any(|word| word == name)
}

/// The point of a motion record; without an axis of its own it keeps the last one.
///
/// # Errors
/// A record without a point or with more than a point and an axis; an axis whose
/// length is not 1 unless MULTAX is on; any but 0,0,1 after MULTAX/OFF.
#[inline]
fn target(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<Target> {
    let point = record.point().filter(|_| MOTION.contains(&record.data.len()));
    let Some(point) = point else { return Err(no_point(record, vocabulary)) };
    let axis = match record.axis() {
        Some(axis) => {
            let axis = checked_axis(post, Vector3::from(axis))?;
            post.path.axis.in_doubt = false;
            axis
        }
        None if record.data.len() == MOTION[0] => {
            if post.path.named_frames.waits || post.path.axis.in_doubt {
                word::csys::settle_axis(post, record)?;
            }
            post.path.axis.given
        }
        None => return Err(no_point(record, vocabulary)),
    };
    Ok(Target { point: Point3::from(point), axis, word: POINT })
}

/// A tool axis that is one.
///
/// # Errors
/// As [`target`].
pub(crate) fn checked_axis(post: &Post, axis: Vector3<f64>) -> Result<Vector3<f64>> {
    let length = axis.norm();
    let near = (length - 1.0).abs() <= AXIS_LENGTH;
    let on = post.path.multax == Some(true);
    if !(near || (on && length > AXIS_LENGTH)) {
        return PostCode::AxisLength.err(format!("a tool axis of length {length:.4}"));
    }
    if post.path.multax == Some(false) && (axis - Vector3::z()).amax() > AXIS_LENGTH {
        return PostCode::AxisLength.err("a tool axis other than 0,0,1 after MULTAX/OFF");
    }
    Ok(axis)
}

#[cold]
fn no_point(record: &Record, vocabulary: &Vocabulary) -> Box<Diag> {
    let major = vocabulary.name(record.major);
    PostCode::WordForm
        .diag(format!("{major}: a point x, y, z, and no more than its axis, is needed"))
}

fn refused(record: &Record, vocabulary: &Vocabulary) -> Box<Diag> {
    let major = vocabulary.name(record.major);
    let (reason, hint) = match record.major {
        w::SYNC => (
            "programs of other channels wait here for each other, and the post writes one program",
            "Let a FIL section write the waiting code of the control with POSTN or INSERT; for a \
             machine with one channel list SYNC under words.without_effect in machine.toml.",
        ),
        w::SWITCH => (
            "it names the point of the tool that the path is for, and the post does not know where \
             it lies",
            "Where the tool data of the control are for that point, list SWITCH under \
             words.without_effect in machine.toml; else let a FIL section call the offset of the \
             point.",
        ),
        w::ROTHED => (
            "it turns a head, and whether the angle counts from zero and what the points are \
             measured from then is not in the file",
            "Where each point of the file has its tool axis in the part (MULTAX/ON), the axes turn \
             the head already: list ROTHED under words.without_effect in machine.toml; else let a \
             FIL section take it.",
        ),
        w::ROTATE => (
            "it turns a table or a head, and whether the angle counts from zero and the points turn \
             with it is not in the file",
            "Say it with rotary.table_words: 1 where the points stay, 2 where they turn with the \
             table. Or give the tool axis with each point (MULTAX/ON, GOTO/x,y,z,i,j,k): the post \
             turns the axes then, and ROTATE can stand under words.without_effect in machine.toml.",
        ),
        w::HEAD => (
            "it chooses a spindle or channel, and the machine of the post has one",
            "For a machine with one head list HEAD under words.without_effect in machine.toml; \
             else post each head from a CL file and with a machine of its own.",
        ),
        w::ORIGIN => (
            "it moves the zero of the machine against that of the part, and which of the two it \
             names is not in the file",
            "Say it with input.origin: 1 takes x, y, z off each point, 2 adds them. Or choose the \
             work offset by SET/OFSETL,n; where the points need no move, list ORIGIN under \
             words.without_effect in machine.toml.",
        ),
        w::TRACUT => (
            "the CAM system or APT processor transforms the path by it; in a CL file it is not \
             known whether the points are transformed already",
            "Where they are, list TRACUT under words.without_effect in machine.toml; where they \
             are not, input.tracut = 1 moves them.",
        ),
        w::COPY | w::INDEX => (
            "an APT processor writes the repeated path out; in a CL file the copies would be \
             missing",
            "Let the CAM system or APT processor expand the copies. Where the path stands in the \
             file already, list INDEX and COPY under words.without_effect in machine.toml.",
        ),
        w::ROTABL => (
            "it turns the part, and whether the angle counts from zero and the points turn with \
             it is not in the file",
            "Say it with rotary.table_words: 1 where the points stay, 2 where they turn with the \
             table. Where each point of the file has its \
             tool axis in the part (MULTAX/ON), the axes turn the table already: list ROTABL under \
             words.without_effect in machine.toml.",
        ),
        _ => (
            "it changes the path or the frame, and the post does not know how",
            "Let a FIL section take it, or list it under words.without_effect in machine.toml \
             where it changes nothing on the machine.",
        ),
    };
    let mut diag =
        PostCode::WordForm.diag(format!("{major}: {reason}; a FIL section must take it"));
    diag.hint = Some(hint.to_string());
    diag
}

fn unknown(word: WordId, vocabulary: &Vocabulary) -> Box<Diag> {
    let mut diag = PostCode::UnknownWord.diag(format!("no handler for {}", vocabulary.name(word)));
    let meant = site_word::perhaps_meant(word, vocabulary);
    diag.hint = meant.map(|meant| format!("did you mean {meant}?"));
    diag
}
