//! ROTABL of CAMWorks and SolidWorks CAM: a table that is turned about an operation, whose
//! points count in the frame that turns with it.
//!
//! The statement alone does not tell its unit nor its sense. TLAXIS does: it gives the tool
//! axis in the part that is not turned, and the turn must bring Z there. So a turn about
//! X or Y is proved by the file itself; one about Z leaves Z where it is, and several turns
//! leave open how the part lies about the tool. The points are then given as those of the
//! part that is not turned, with their tool axis, as all systems give them.

use super::vector::{Vector, unit};
use super::{FormError, Outcome, Written};
use crate::errors::ClCode;
use crate::record::{Record, Word};
use crate::words as w;

/// Angles below this are no turn: CAM systems round to six decimals, in radians or degrees.
const STILL: f64 = 1e-5;

/// Largest difference between the tool axis of a turn and that of TLAXIS.
const NEAR: f64 = 1e-4;

/// The direction of a tool that stands upright.
const UPRIGHT: Vector = [0.0, 0.0, 1.0];

/// How the table stands, and what the points of the file count from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Table {
    /// Sums of the turns about X, Y and Z as written, counterclockwise.
    angles: Vector,
    /// TLAXIS.
    tool_axis: Option<Vector>,
    /// The position for the motions that came.
    in_force: Option<Position>,
    /// Something is turned, or was.
    in_play: bool,
}

/// A position of the table that TLAXIS proves.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Position {
    /// Turned about this axis of the part, 0 for X and 1 for Y; `None`: not turned.
    about: Option<usize>,
    /// The tool axis in the part.
    axis: Vector,
}

impl Position {
    fn differs(self, other: Position) -> bool {
        self.about != other.about || differs(self.axis, other.axis)
    }
}

impl Table {
    /// True while points need a look: something is turned, or was.
    #[inline]
    pub(crate) fn is_in_play(&self) -> bool {
        self.in_play
    }

    fn look(&mut self) {
        self.in_play = self.in_force.is_some()
            || self.is_turned()
            || self.tool_axis.is_some_and(|axis| differs(axis, UPRIGHT));
    }

    fn is_turned(&self) -> bool {
        self.angles.iter().any(|angle| angle.abs() > STILL)
    }
}

/// `ROTABL/angle,AAXIS,TABLE,CCLW`, its items in any order: turns are added up.
pub(crate) fn turn(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    let items = &written.record.data;
    let has = |word| usize::from(items.contains(&Word::Minor(word)));
    let numbers: Vec<f64> = items.iter().filter_map(number).collect();
    let axes = [w::AAXIS, w::BAXIS, w::CAXIS].map(has);
    let senses = [has(w::CCLW), has(w::CLW)];
    let is_whole = items.len() == 4
        && has(w::TABLE) == 1
        && axes.iter().sum::<usize>() == 1
        && senses.iter().sum::<usize>() == 1;
    let [angle] = numbers[..] else { return Ok(Outcome::Bound) };
    if !is_whole {
        return Ok(Outcome::Bound);
    }
    let sense = if senses[0] == 1 { 1.0 } else { -1.0 };
    for (sum, count) in written.state.table.angles.iter_mut().zip(axes) {
        *sum += sense * angle * count as f64;
    }
    written.state.table.look();
    written.record.inert = true;
    Ok(Outcome::Bound)
}

fn number(word: &Word) -> Option<f64> {
    match word {
        Word::Number(value) => Some(*value),
        _ => None,
    }
}

/// TLAXIS/i,j,k: the tool axis in the part that is not turned.
pub(crate) fn tool_axis(written: &mut Written<'_>) -> Outcome {
    if let [Some(i), Some(j), Some(k)] = [0, 1, 2].map(|item| written.number(item)) {
        written.state.table.tool_axis = Some([i, j, k]);
        written.state.table.look();
    }
    Outcome::Bound
}

/// Brings a motion or a CIRCLE to the part that is not turned. `has_moved`: motions came
/// before, whatever the table did then.
///
/// # Errors
/// A turn that the file does not prove; a second position of the table; a motion whose
/// points can't be brought there.
pub(crate) fn bring_back(
    table: &mut Table,
    record: &mut Record,
    has_moved: bool,
) -> Result<(), FormError> {
    let count = record.data.iter().take_while(|word| number(word).is_some()).count();
    let has_own_axis = matches!(record.major, w::GOTO | w::FROM) && count == 6;
    let position = if has_own_axis && !table.is_turned() {
        Position { about: None, axis: UPRIGHT }
    } else {
        proved_position(table)?
    };
    if has_moved && table.in_force.is_none_or(|before| position.differs(before)) {
        return Err(unclear("the table position differs from the one of the moves before"));
    }
    table.in_force = Some(position);
    let Some(about) = position.about else { return Ok(()) };
    match (record.major, count) {
        (w::GOTO | w::FROM, 3) => {
            rotate(record, 0, about, position.axis);
            record.data.extend(position.axis.map(Word::Number));
        }
        (w::CIRCLE, 6..) => {
            rotate(record, 0, about, position.axis);
            rotate(record, 3, about, position.axis);
        }
        _ => return Err(unclear("this motion while the table is turned")),
    }
    Ok(())
}

/// The position in which Z of the table's frame is the tool axis that TLAXIS names.
fn proved_position(table: &Table) -> Result<Position, FormError> {
    const DEGREE: f64 = std::f64::consts::PI / 180.0;
    let turned: Vec<usize> = (0..3).filter(|n| table.angles[*n].abs() > STILL).collect();
    let named = table.tool_axis.unwrap_or(UPRIGHT);
    let (about, along) = match turned[..] {
        [] => (None, vec![UPRIGHT]),
        [about @ 0..=1] => {
            let along = |unit: f64| {
                let (sine, cosine) = libm::sincos(table.angles[about] * unit);
                if about == 0 { [0.0, -sine, cosine] } else { [sine, 0.0, cosine] }
            };
            (Some(about), vec![along(1.0), along(DEGREE)])
        }
        _ => return Err(unclear("turns that the tool axis does not prove")),
    };
    if along.iter().all(|axis| differs(*axis, named)) {
        return Err(unclear("the turn of the table does not bring the tool along TLAXIS"));
    }
    let across = match about {
        Some(0) => [0.0, named[1], named[2]],
        Some(_) => [named[0], 0.0, named[2]],
        None => UPRIGHT,
    };
    Ok(Position { about, axis: unit(across).unwrap_or(UPRIGHT) })
}

/// Turns three numbers from the frame of the table to the part that is not turned: about X
/// or Y, so that Z comes to lie along an axis.
fn rotate(record: &mut Record, first: usize, about: usize, axis: Vector) {
    let [x, y, z] = [0, 1, 2].map(|n| record.data.get(first + n).and_then(number).unwrap_or(0.0));
    let [i, j, k] = axis;
    let turned = if about == 0 {
        [x, k * y + j * z, -j * y + k * z]
    } else {
        [k * x + i * z, y, -i * x + k * z]
    };
    for (word, value) in record.data[first..].iter_mut().zip(turned) {
        *word = Word::Number(value + 0.0);
    }
}

fn differs(a: Vector, b: Vector) -> bool {
    a.iter().zip(b).any(|(a, b)| (a - b).abs() > NEAR)
}

fn unclear(message: &str) -> FormError {
    FormError::new(ClCode::UnclearFrame, 0, message)
}
