//! What drives the post: records go in one after the other, and blocks come out.
//!
//! It is the one door for records: it hands each handler what the record holds, and
//! refuses what the handler did not take. No handler can bypass it.

use crate::cause::Cause;
use crate::control::sinumerik::tool_names;
use crate::control::{Control, Held};
use crate::dispatch::{self, Handler};
use crate::errors::PostCode;
use crate::items::Items;
use crate::no_effect;
use crate::operation::End;
use crate::operation::{MOTION, POINT, Target};
use crate::path::places::{self, Places};
use crate::path::{Path, Statement, index, long_arc, tool_change, way_home};
use crate::post::{Lane, Post};
use crate::site_word;
use crate::words as word;
use crate::words::end;
use fil_cl::layout::is_alias;
use fil_cl::record::kind;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_cl::{Record, Word, operation_sign};
use fil_diag::{Diag, Result};
use fil_machine::Commons;
use nalgebra::{Point3, Vector3};

impl Post {
    /// A post for a machine.
    ///
    /// # Errors
    /// Settings that make no machine.
    pub fn new(commons: Commons) -> Result<Self> {
        let places = Places::of(&commons);
        let control = Control::new(commons)?;
        Ok(Post { control, path: Path::default(), lane: Lane::default(), places })
    }

    /// Carries out one record.
    ///
    /// # Errors
    /// Whatever the record's post word refuses; nothing of the run may be
    /// used after an error.
    pub fn process(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<()> {
        self.begin(record, vocabulary)?;
        while self.has_more() {
            self.go_on()?;
        }
        Ok(())
    }

    /// Carries out one record, of a CIRCLE with very many blocks the first of them: while
    /// [`Post::has_more`] the caller takes the finished ones away and calls [`Post::go_on`].
    ///
    /// # Errors
    /// As [`Post::process`].
    #[inline]
    pub fn begin(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<()> {
        if self.goes_straight_on(record)? {
            return Ok(());
        }
        self.control.refresh()?;
        if word::trans::machine_has_changed(self) {
            word::trans::follow_machine(self)?;
        }
        self.blocks_come_of(record);
        carry_out(self, record, vocabulary)?;
        self.came_the_long_way(record);
        Ok(())
    }

    /// Blocks are caused by a record from now on.
    #[inline]
    pub(crate) fn blocks_come_of(&mut self, record: &Record) {
        if self.control.tape.noted.is_some() {
            let cause = self.control.tape.cause;
            self.control.block.cause = Cause { made_by_fil: record.line == 0, ..cause };
        }
    }

    /// Writes some more blocks of the last record.
    ///
    /// # Errors
    /// As [`Post::process`].
    pub fn go_on(&mut self) -> Result<()> {
        long_arc::go_on(self)
    }

    /// Ends the program if no FINI did.
    ///
    /// # Errors
    /// A record that waits for its continuation (a CIRCLE without end point).
    pub fn finish(&mut self) -> Result<()> {
        end::finish(self, End::OfFile)
    }

    /// True when a tool change depends on those behind it: whoever drives the post tells
    /// them by `path.ahead.tool` before a record that changes the tool.
    pub fn looks_ahead_for_tools(&self) -> bool {
        let tables = &self.control.tables;
        tool_change::looks_ahead(&self.control.commons) || tables.tip_output && tables.frame_output
    }
}

/// Carries out a record.
///
/// # Errors
/// Whatever its post word refuses; items that no handler took; a word that neither
/// the post knows nor a table lists as without effect.
#[inline]
fn carry_out(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<()> {
    if post.places.are_on
        && let Some(sign) = operation_sign::of(record)
    {
        places::note_sign(post, sign)?;
    }
    if record.kind == kind::PSEUDO {
        word::csys::note(post, vocabulary.name(record.major), record)?;
        return word::pseudo::handle(post, &mut Items::new(record, vocabulary)?);
    }
    if record.inert {
        return note(post, record, vocabulary);
    }
    if !post.control.tools.held.is_empty() && !stays_before_change(&post.control, record) {
        way_home::write_held(&mut post.control)?;
    }
    match dispatch::of(record.major) {
        Some(Handler::Point(handle)) => {
            if record.number < post.path.named_frames.since {
                word::csys::refuse_read_again(post)?;
            }
            let target = target(post, record, vocabulary)?;
            if let Some(coolant) = post.control.tools.coolant {
                way_home::resume_coolant(&mut post.control, coolant)?;
            }
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
            Err(refused(post, record, vocabulary))
        }
        Some(Handler::Refused) => Err(refused(post, record, vocabulary)),
        None => Err(unknown(record, vocabulary)),
    }
}

/// A record between a message or stop and the tool change that it waits for.
fn stays_before_change(control: &Control, record: &Record) -> bool {
    let has_stop = control.tools.held.iter().any(|(held, _)| matches!(held, Held::Stop(_)));
    record.takes_tool() || stands_before_change(record, has_stop)
}

/// A record that may stand between a message, or a stop, and the tool change that it waits for. What
/// switches off may stand behind a stop: the machine stops with spindle and coolant off.
pub fn stands_before_change(record: &Record, has_stop: bool) -> bool {
    match record.major {
        w::PPRINT | w::TPRINT | w::CUTTER | w::OPSTOP | w::STOP => true,
        w::SPINDL | w::COOLNT => has_stop && record.data[..] == [Word::Minor(w::OFF)],
        _ => false,
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
            let axis = word::goto::checked_axis(post, Vector3::from(axis))?;
            post.path.axis.in_doubt = false;
            post.path.axis.is_said = true;
            if post.path.is_moved_by(Statement::AuthorBlock) {
                index::turns_by_points(post);
            }
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

#[cold]
fn no_point(record: &Record, vocabulary: &Vocabulary) -> Box<Diag> {
    let major = vocabulary.name(record.major);
    PostCode::WordForm
        .diag(format!("{major}: a point x, y, z, and no more than its axis, is needed"))
}

/// What a turn of a table leaves open. ABSOL and INCR say what its angle counts from.
fn turn(record: &Record) -> String {
    let what = if record.major == w::ROTATE { "a table or a head" } else { "the part" };
    let says_zero = record.has(w::ABSOL) || record.has(w::INCR);
    let zero = if says_zero { "" } else { "the angle counts from zero and " };
    format!("it turns {what}, and whether {zero}the points turn with it is not in the file")
}

/// What to do with a word that turns a table.
fn hint_of_turn(post: &Post, major: &str) -> String {
    if !post.control.tables.chain().has_rotary() {
        return format!(
            "This machine has no rotary axis: choose a post with the one that turns (`filpost posts` lists them). If the operator turns the part, list {major} under words.without_effect in machine.toml."
        );
    }
    format!(
        "Set rotary.table_words: 1 if the points stay, 2 if they turn with the table. Or give the tool axis with each point (MULTAX/ON, GOTO/x,y,z,i,j,k): the axes then turn by the points, and {major} can be listed under words.without_effect in machine.toml."
    )
}

fn refused(post: &Post, record: &Record, vocabulary: &Vocabulary) -> Box<Diag> {
    let major = vocabulary.name(record.major);
    let turn = turn(record);
    let hint_of_turn = hint_of_turn(post, major);
    let (reason, hint) = match record.major {
        w::SYNC => (
            "programs of other channels wait here for each other, and the post writes one program",
            "Let a FIL section write the waiting code of the control with POSTN or INSERT; for a \
             machine with one channel list SYNC under words.without_effect in machine.toml.",
        ),
        w::SWITCH => (
            "it selects the tool point that the path is for, and the post does not know its position",
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
        w::ROTATE | w::ROTABL => (turn.as_str(), hint_of_turn.as_str()),
        w::HEAD => (
            "it chooses a spindle or channel, and the machine of the post has one",
            "For a machine with one head list HEAD under words.without_effect in machine.toml; \
             else post each head from a CL file and with a machine of its own.",
        ),
        w::ORIGIN => (
            "it moves the zero of the machine against that of the part, and which of the two it \
             names is not in the file",
            "Set input.origin: 1 subtracts x, y, z from each point, 2 adds them. Or select the work offset by SET/OFSETL,n; if the points need no shift, list ORIGIN under words.without_effect in machine.toml.",
        ),
        w::TRACUT => (
            "the CAM system or APT processor transforms the path by it; in a CL file it is not \
             known whether the points are transformed already",
            "If they are, list TRACUT under words.without_effect in machine.toml; if not, set input.tracut = 1 to transform them.",
        ),
        w::COPY | w::INDEX => (
            "an APT processor writes the repeated path out; in a CL file the copies would be \
             missing",
            "Expand the copies in the CAM system or APT processor. If the path is in the file already, list INDEX and COPY under words.without_effect in machine.toml.",
        ),
        _ => (
            "it changes the path or the frame, and the post does not know how",
            "Take it with a FIL section, or list it under words.without_effect in machine.toml if it changes nothing on the machine.",
        ),
    };
    let mut diag =
        PostCode::WordForm.diag(format!("{major}: {reason}; a FIL section must take it"));
    diag.hint = Some(hint.to_string());
    diag
}

fn unknown(record: &Record, vocabulary: &Vocabulary) -> Box<Diag> {
    let name = vocabulary.name(record.major);
    let no_handler = format!("no handler for {name}");
    let (message, hint) = if is_alias(record, vocabulary) {
        let hint = format!(
            "An NC alias stands for LOADTL, TURRET, PARTNO or MFGNO: write a section CIMFIL/ON,{name} that gives the statement, or list {name} under words.without_effect."
        );
        (no_handler, Some(hint))
    } else if site_word::is_of_fil(name) {
        let hint = "A macro file goes behind -f (--fil), and the CL file before it.".to_string();
        (format!("{no_handler}, which is a statement of FIL"), Some(hint))
    } else if let Some(does) = site_word::on_other_machines(name) {
        let hint =
            format!("Write a section CIMFIL/ON,{name} that writes the code of your machine.");
        (format!("{no_handler}, which {does}"), Some(hint))
    } else {
        let meant = site_word::perhaps_meant(record.major, vocabulary);
        (no_handler, meant.map(|meant| format!("did you mean {meant}?")))
    };
    let mut diag = PostCode::UnknownWord.diag(message);
    diag.hint = hint;
    diag
}
