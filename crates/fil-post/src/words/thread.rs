//! THREAD/TPI,n: the feed motions that follow are thread passes. THREAD/AUTO,…: a whole
//! thread from point to point. PITCH: the lead of THREAD that names none.

use fil_cl::record::FIRST_DATA;
use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations as loc;
use fil_machine::modes::{INCH, Unit};
use nalgebra::Point3;

use super::csys;
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::thread_shape::MOST_STARTS;
use crate::operation::{Lead, Operation, Target, Thread, ThreadPasses, ThreadSide};
use crate::path::{Passes, Pitch};
use crate::path::{carry_out, thread};
use crate::post::Post;

/// Where TO stands among the items of THREAD/AUTO,x,y,z,TO,x,y,z.
const TO: usize = 4;

/// Remembers the lead, or cuts a whole thread.
///
/// # Errors
/// No lead; of THREAD/AUTO another order of the points, a value that is missing, and what
/// the thread itself refuses.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.any_of(&[w::OFF, w::NOMORE]).is_some() {
        return thread::end(post);
    }
    thread::end(post)?;
    if items.flag(w::AUTO) {
        return automatic(post, items);
    }
    let says_lead = [w::TPI, w::MMPR, w::IPR].into_iter().any(|word| items.has(word));
    let pitch = post.path.thread.pitch.filter(|_| !says_lead);
    let (lead, change) = match pitch {
        Some(Pitch { lead, change }) => (lead, change),
        None => (lead(post, items)?, 0.0),
    };
    items.flag(w::TURN);
    items.flag(w::ON);
    items.deny_rest()?;
    post.path.thread.passes = Some(Passes::new(lead, change));
    Ok(())
}

/// PITCH/n: the lead of THREAD that names none. n counts threads in a unit of the CL file, or
/// with TPI in an inch; MMPR or IPR make it a lead. INCR,v and DECR,v change a lead by v in
/// each turn.
///
/// # Errors
/// No number, or one that is not positive; a change of a number of threads; several starts,
/// as each pass is cut where the CL file says.
pub fn pitch(post: &mut Post, items: &mut Items) -> Result<()> {
    let starts = starts(items, w::MULTRD)?;
    if starts != 1 {
        return Err(items.error("MULTRD: the passes of THREAD are cut at the GOTO points"));
    }
    let grows = items.couplet(w::INCR)?;
    let shrinks = items.couplet(w::DECR)?;
    let unit = items.any_of(&[w::TPI, w::MMPR, w::IPR]);
    let number = items.required("the number of threads, or the lead with MMPR or IPR")?;
    let inch = match post.control.require_unit()? {
        Unit::Mm => INCH,
        Unit::Inch => 1.0,
    };
    let (lead, scale) = match unit {
        None => (1.0 / number, None),
        Some(w::TPI) => (inch / number, None),
        Some(w::MMPR) => (number * inch / INCH, Some(inch / INCH)),
        Some(_) => (number * inch, Some(inch)),
    };
    post.due_to(items);
    items.deny_rest()?;
    if !lead.is_finite() || lead <= 0.0 {
        return PostCode::Thread.err("PITCH: the lead must be above zero");
    }
    let change = match (grows, shrinks) {
        (Some(_), Some(_)) => return Err(items.error("INCR and DECR: a lead grows or shrinks")),
        (Some(by), None) => by,
        (None, Some(by)) => -by,
        (None, None) => 0.0,
    };
    let change = match scale {
        _ if change == 0.0 => 0.0,
        Some(scale) if grows.or(shrinks).is_some_and(|by| by > 0.0) => change * scale,
        Some(_) => return PostCode::Thread.err("PITCH: INCR or DECR is below zero"),
        None => {
            return Err(
                items.error("INCR or DECR of a number of threads: give the lead with MMPR or IPR")
            );
        }
    };
    let lead = Lead { value: lead, cause: post.control.block.cause };
    post.path.thread.pitch = Some(Pitch { lead, change });
    Ok(())
}

/// THREAD/AUTO,x1,y1,z1,TO,x2,y2,z2,TPI,t,DEEP,first,LAST,springs,TYPE,0,depth,angle,
/// FEDTO,clearance,IN|OUT|FACE,TIMES,starts. The points are those of the crest.
///
/// # Errors
/// Another order of the points; a value that is missing; AT and OFSETL, whose meaning is not
/// known; and as the thread itself.
fn automatic(post: &mut Post, items: &mut Items) -> Result<()> {
    csys::settle(post, post.path.axis.given)?;
    let crest = points(post, items)?;
    if items.has(w::AT) {
        return Err(items.error("AT,percent: what it is a part of is not known"));
    }
    let pitch = lead(post, items)?;
    for word in [w::IPM, w::MMPM] {
        if let Some(feed) = items.couplet(word)? {
            let message = format!("THREAD: no motion of the thread is made at the feed {feed}");
            post.warn(PostCode::IgnoredPart, message);
        }
    }
    let offset = items.couplet(w::OFSETL)?;
    let first = items.couplet(w::DEEP)?;
    let springs = items.couplet(w::LAST)?;
    let clearance = items.couplet(w::FEDTO)?;
    let starts = starts(items, w::TIMES)?;
    let Some(kind) = items.couplet(w::TYPE)? else {
        return Err(items.error("TYPE,0,depth,angle is missing"));
    };
    if kind != 0.0 {
        return Err(items.error(format!("a thread of TYPE {kind} is not known")));
    }
    let depth = items.required("the depth of the thread after TYPE,0")?;
    let angle = items.required("the angle of the profile after TYPE,0,depth")?;
    if let Some(cuts) = offset {
        let by = items.number().unwrap_or(0.0);
        if cuts > 1.0 || by != 0.0 {
            return Err(items.error(format!("OFSETL,{cuts},{by}: cuts beside each other")));
        }
    }
    let side = side(post, items, crest)?;
    items.deny_rest()?;
    let Some(first) = first else { return Err(items.error("DEEP, the first pass, is missing")) };
    let lead = Lead { value: pitch.value * f64::from(starts), ..pitch };
    let usual = usual_clearance(post);
    carry_out(
        post,
        Operation::Thread(Box::new(Thread {
            crest,
            side,
            lead,
            starts,
            depth,
            passes: ThreadPasses::First(first),
            springs: springs_of(post, items, springs)?,
            angle,
            clearance: clearance.unwrap_or(usual),
        })),
    )
}

/// The two points at the head of the record.
fn points(post: &Post, items: &mut Items) -> Result<[Target; 2]> {
    let wrong = |items: &Items| items.error("AUTO needs x,y,z,TO,x,y,z after it");
    if !items.word_at(TO, w::TO) {
        return Err(wrong(items));
    }
    let mut values = [0.0; 6];
    for value in &mut values {
        *value = items.number().ok_or_else(|| wrong(items))?;
    }
    if usize::from(items.last_word()) != FIRST_DATA + TO + 3 {
        return Err(wrong(items));
    }
    let [x1, y1, z1, x2, y2, z2] = values;
    let at = |x, y, z| Target { point: Point3::new(x, y, z), axis: post.path.axis.given, word: 0 };
    Ok([at(x1, y1, z1), at(x2, y2, z2)])
}

/// IN, OUT or FACE, which looks to +Z; without one the side that the tool stands on.
fn side(post: &Post, items: &mut Items, crest: [Target; 2]) -> Result<ThreadSide> {
    let from = thread::stands_at(post);
    let word = items.any_of(&[w::IN, w::OUT, w::FACE]);
    let start = crest[0].point;
    match (word, from) {
        (Some(w::IN), _) => Ok(ThreadSide::Inside),
        (Some(w::OUT), _) => Ok(ThreadSide::Outside),
        // That of a part in the second spindle may look to -Z.
        (Some(_), Some(from)) if from.z < start.z && post.control.spindle.is_side => {
            Ok(ThreadSide::Behind)
        }
        (Some(_), _) => Ok(ThreadSide::Before),
        (None, Some(from)) if from.x.abs() > start.x.abs() => Ok(ThreadSide::Outside),
        (None, Some(from)) if from.x.abs() < start.x.abs() => Ok(ThreadSide::Inside),
        _ => PostCode::Thread
            .err("neither a word nor the tool position gives the side of the thread"),
    }
}

/// Number of the threads beside each other.
///
/// # Errors
/// No whole number from 1 on.
pub fn starts(items: &mut Items, word: fil_cl::WordId) -> Result<u32> {
    match items.couplet(word)? {
        None | Some(0.0) => Ok(1),
        Some(starts)
            if starts.fract() == 0.0 && (1.0..=f64::from(MOST_STARTS)).contains(&starts) =>
        {
            Ok(starts as u32)
        }
        Some(starts) => PostCode::Thread.err(format!("a thread of {starts} starts")),
    }
}

/// Passes at full depth after the last one: those of the record, else the machine's.
///
/// # Errors
/// No whole number from 0 on.
pub fn springs_of(post: &Post, items: &Items, said: Option<f64>) -> Result<u32> {
    let usual = || f64::from(post.control.commons.int(loc::THREAD_SPRINGS).max(0));
    let springs = said.unwrap_or_else(usual);
    if springs.fract() == 0.0 && (0.0..=99.0).contains(&springs) {
        return Ok(springs as u32);
    }
    Err(items.error(format!("{springs} passes at full depth")))
}

/// Distance from the crest that the machine goes back at, mm or inch.
pub fn usual_clearance(post: &Post) -> f64 {
    let clearance = post.control.commons.dbl_opt(loc::THREAD_CLEARANCE).unwrap_or(0.0);
    if post.control.is_metric() { clearance } else { clearance / INCH }
}

/// The lead of TPI (threads an inch), MMPR or IPR, in the unit of the program.
///
/// # Errors
/// None of them, more than one, or a value that is not positive.
pub fn lead(post: &mut Post, items: &mut Items) -> Result<Lead> {
    let inch = match post.control.require_unit()? {
        Unit::Mm => INCH,
        Unit::Inch => 1.0,
    };
    let value = if let Some(threads) = items.couplet(w::TPI)? {
        inch / threads
    } else if let Some(millimetres) = items.couplet(w::MMPR)? {
        millimetres * inch / INCH
    } else if let Some(inches) = items.couplet(w::IPR)? {
        inches * inch
    } else {
        return Err(items.error("TPI (threads an inch), MMPR or IPR with a number is needed"));
    };
    post.due_to(items);
    if !value.is_finite() || value <= 0.0 {
        let major = items.name(items.major());
        return PostCode::Thread.err(format!("{major}: the lead must be above zero"));
    }
    Ok(Lead { value, cause: post.control.block.cause })
}
