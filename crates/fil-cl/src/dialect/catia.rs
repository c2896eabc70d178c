//! Dassault CATIA V5 APT (`.aptsource`).
//!
//! CATIA cuts every line at column 72 with `$` as its last character, within numbers, texts
//! and comments too. Arcs are given by geometry (INDIRV, TLON) and not by CIRCLE. Statements
//! beside those of APT come from the word table of a shop.

use super::{AxisRule, DialectRules, Sign};
use crate::errors::ClCode;
use crate::forms::{FormError, Outcome, Written};
use crate::record::{FIRST_DATA, Word};
use crate::vocabulary::WordId;
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "catia",
    title: "Dassault CATIA V5 APT (.aptsource)",
    signs: &[
        Sign::Comment("CATIAAPTVERSION"),
        Sign::Comment("*CATIA"),
        Sign::Name("CATMAT"),
        Sign::Name("CATPROCESS"),
        Sign::Name("CATPRODUCT"),
        Sign::Name("SPINDL_NAME"),
    ],
    circle: None,
    geometry: true,
    splines: false,
    axis: AxisRule::ModalInMultax,
    packed_points: false,
    break_column: Some(72),
    frame_in_comments: true,
    trailing_comma: true,
    blanks_in_cycles: false,
    comma_words: true,
    writes_units: false,
    feeds_tell_unit: false,
    writes_fini: false,
    rewrite: Some(rewrite),
    rewrite_text: None,
    without_effect: &[
        ("CATMAT", "frame of the points; the post looks for a second one"),
        ("CATPROCESS", "name of the CATIA process"),
        ("CATPRODUCT", "name of the CATIA product"),
        ("MACHINE", "name of the machine"),
        ("PROGRAM", "name of the program in the CAM system"),
        ("PART_OPE", "name of the part operation; the post looks for a second one"),
        ("OP_NAME", "name of the operation"),
        ("START_OP", "kind of the operation that begins"),
        ("END_OP", "kind of the operation that ends"),
        ("OPDATA", "parameters of the operation, for information"),
        ("OP_FEED", "feeds of the operation; FEDRAT gives each of them again"),
        ("OP_MEUL", "parameters of grinding, for information"),
        ("SPINDL_NAME", "name of the spindle"),
        ("TLCOMP", "corrector of the tool; LOADTL gives it"),
        ("TDATA", "measures of the tool, for information"),
        ("TPRINT", "text of the tool list"),
        ("TOOLPATH_TYPE", "number of axes of the operation"),
        ("INTOL", "tolerance the points were computed with"),
        ("OUTTOL", "tolerance the points were computed with"),
    ],
};

/// Data of the shop's word table and of the tool, which the path does not need.
fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    match written.record.major {
        w::TLAXIS => Ok(tool_axis(written)),
        w::AUTOPS => {
            written.state.normal = None;
            written.record.inert = true;
            Ok(Outcome::Bound)
        }
        w::FEDRAT => Ok(note_unit(written)),
        w::SPINDL => spindle(written),
        w::LOADTL => Ok(tool(written)),
        w::TOOLNO => Ok(tool_data(written)),
        w::SWITCH => Ok(output_point(written)),
        w::SYNC => {
            written.record.inert = written.record.data.iter().all(|word| *word == Word::Empty);
            Ok(Outcome::Free)
        }
        w::CYCLE => cycle(written),
        w::REWIND => {
            written.state.has_ended = true;
            Ok(Outcome::Bound)
        }
        // REWIND has ended the program already.
        w::END if written.state.has_ended => Ok(Outcome::Nothing),
        _ => Ok(by_name(written)),
    }
}

/// A unit of a feed tells the unit of the file, where it comes first.
fn note_unit(written: &mut Written<'_>) -> Outcome {
    let has = |units: [WordId; 2]| units.iter().any(|unit| written.record.has(*unit));
    let (metric, inch) = (has([w::MMPM, w::MMPR]), has([w::IPM, w::IPR]));
    let before = (written.state.is_metric, written.state.is_inch);
    written.state.is_metric |= metric;
    written.state.is_inch |= inch;
    if before == (written.state.is_metric, written.state.is_inch) {
        Outcome::Free
    } else {
        Outcome::Bound
    }
}

/// Words that are not in the vocabulary.
fn by_name(written: &mut Written<'_>) -> Outcome {
    match written.vocabulary.name(written.record.major) {
        // Each file is for one channel; another one would be another program.
        "CHANNEL" => {
            let channel = written.record.data.first().copied().unwrap_or(Word::Empty);
            let first = *written.state.channel.get_or_insert(channel);
            written.record.inert = first == channel;
        }
        "TDATA" => {
            let record = &written.record;
            let quadrant = (0..record.data.len()).find(|item| written.name(*item) == "QUADRANT");
            let point = quadrant.and_then(|item| written.number(item + 1));
            (written.state.output_point, written.state.is_described) = (point, true);
        }
        "MAXRPM" => {
            written.state.highest_speed = written.number(0);
            written.record.inert = true;
        }
        _ => return Outcome::Free,
    }
    Outcome::Bound
}

fn tool_axis(written: &mut Written<'_>) -> Outcome {
    if let [Some(i), Some(j), Some(k)] = [0, 1, 2].map(|item| written.number(item)) {
        written.state.tool_axis = Some([i, j, k]);
    }
    Outcome::Bound
}

/// SFM stands for the surface speed in the unit of the file, meters where it is metric.
/// A speed that follows the diameter gets the limit that MAXRPM has named.
fn spindle(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    let surface = written.record.find_minor(FIRST_DATA, w::SFM);
    if let Some(word) = surface {
        if !written.state.is_metric {
            if written.state.is_inch {
                return Ok(Outcome::Bound);
            }
            let message = "feet or meters per minute: no MMPM, IPM or UNITS came before";
            let hint = "write SMM for meters; for feet choose --dialect generic";
            let error = FormError::new(ClCode::UnclearUnit, word - FIRST_DATA, message);
            return Err(error.hint(hint).leaning());
        }
        written.record.set(word, Word::Minor(w::SMM));
    }
    if let Some(limit) = written.state.highest_speed.filter(|_| written.record.has(w::SMM)) {
        written.record.data.extend([Word::Minor(w::MAXRPM), Word::Number(limit)]);
    }
    Ok(Outcome::Bound)
}

/// `LOADTL/n,ADJUST,m,SPINDL,s,MILL` and `LOADTL/n,m` as LOADTL/n,ADJUST,m,TOOL: m counts the
/// compensations of the tool, and not the offsets of the machine. The speed comes again with
/// SPINDL. A tool that is loaded with that compensation already is not changed again.
fn tool(written: &mut Written<'_>) -> Outcome {
    let Some(number) = written.number(0) else { return Outcome::Bound };
    let data = &written.record.data;
    let offset = match &data[1..] {
        [] => None,
        [Word::Number(offset)] => Some(*offset),
        // The third number names the side of the tool post; where it repeats the offset or
        // is the first one it adds nothing.
        [Word::Number(offset), Word::Number(side)] if side == offset || *side == 1.0 => {
            Some(*offset)
        }
        [Word::Minor(w::ADJUST), offset, rest @ ..] if is_data_of_tool(rest) => match offset {
            Word::Number(offset) => Some(*offset),
            Word::Empty => None,
            _ => return Outcome::Bound,
        },
        _ => return Outcome::Bound,
    };
    let tool = [number, offset.unwrap_or(number)];
    if written.state.tool == Some(tool) {
        return Outcome::Nothing;
    }
    written.state.tool = Some(tool);
    if !std::mem::take(&mut written.state.is_described) {
        written.state.output_point = None;
    }
    written.record.data.truncate(1);
    if let Some(offset) = offset {
        let of_tool = [Word::Minor(w::ADJUST), Word::Number(offset), Word::Minor(w::TOOL)];
        written.record.data.extend(of_tool);
    }
    Outcome::Bound
}

/// `SPINDL,s` and MILL or TURN.
fn is_data_of_tool(items: &[Word]) -> bool {
    match items {
        [] | [Word::Minor(w::MILL | w::TURN)] => true,
        [Word::Minor(w::SPINDL), Word::Number(_) | Word::Empty, rest @ ..] => is_data_of_tool(rest),
        _ => false,
    }
}

/// TOOLNO describes the tool; the fifth value of a turning tool is the point of the tool
/// that the path is for.
fn tool_data(written: &mut Written<'_>) -> Outcome {
    written.record.inert = true;
    note_unit(written);
    if written.record.data.get(1) == Some(&Word::Minor(w::TURN)) {
        written.state.output_point = written.number(4);
    }
    written.state.is_described = true;
    Outcome::Bound
}

/// SWITCH names the point of the tool that the path is for. The one that the tool was
/// described with changes nothing, nor does the first one of a tool that was not.
fn output_point(written: &mut Written<'_>) -> Outcome {
    let data = &written.record.data;
    let [Word::Number(named), ref rest @ ..] = data[..] else { return Outcome::Bound };
    let point = *written.state.output_point.get_or_insert(named);
    written.record.inert = named == point && rest.iter().all(|item| *item == data[0]);
    Outcome::Bound
}

/// `CYCLE/kind,depth,clearance[,feed,unit]` as couplets.
///
/// # Errors
/// A depth that is not above zero, a clearance below zero.
fn cycle(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    const BY_POSITION: [WordId; 6] = [w::DRILL, w::TAP, w::BORE, w::REAM, w::CSINK, w::FACE];
    let (kind, couplets) = match written.record.data[..] {
        [Word::Minor(kind), Word::Number(depth), Word::Number(clear)] => {
            (kind, vec![(w::DEPTH, depth), (w::CLEAR, clear)])
        }
        [
            Word::Minor(kind),
            Word::Number(depth),
            Word::Number(clear),
            Word::Number(feed),
            Word::Minor(unit @ (w::MMPM | w::MMPR | w::IPM | w::IPR)),
        ] => (kind, vec![(w::DEPTH, depth), (unit, feed), (w::CLEAR, clear)]),
        _ => return Ok(Outcome::Bound),
    };
    if !BY_POSITION.contains(&kind) {
        return Ok(Outcome::Bound);
    }
    for (item, is_wrong) in
        [(1, written.number(1) <= Some(0.0)), (2, written.number(2) < Some(0.0))]
    {
        if is_wrong {
            let message = "depth and clearance count from the start of the hole, down and up";
            return Err(FormError::new(ClCode::BadPoint, item, message));
        }
    }
    written.set_couplets(kind, &couplets);
    Ok(Outcome::Bound)
}
