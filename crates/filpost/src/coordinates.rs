//! Where a motion of the CL file leads, for scripts that look at the one before or behind.

use fil_cl::record::motion::GODLTA;
use fil_cl::{Record, Word};

/// X Y Z I J K of a motion record, and 1 for a rapid move, else 0; without a tool
/// axis of its own I J K are absent, and X Y Z where they are not known.
pub(crate) type Coordinates = [Option<f64>; 7];

/// The coordinates of a motion; those of GODLTA count from the motion `before` it.
pub(crate) fn coordinates(
    record: &Record,
    rapid: bool,
    before: Option<Coordinates>,
) -> Coordinates {
    let mut found = match record.sub {
        GODLTA => beside(record, before.unwrap_or_default()),
        _ => of_record(record),
    };
    found[6] = Some(f64::from(u8::from(rapid)));
    found
}

fn of_record(record: &Record) -> Coordinates {
    let mut found = [None; 7];
    let parts = record.point().into_iter().chain(record.axis());
    for (place, part) in parts.enumerate() {
        for (slot, value) in found[place * 3..].iter_mut().zip(part) {
            *slot = Some(value);
        }
    }
    found
}

/// By increments, or by one number along the tool axis that the motion before has named.
fn beside(record: &Record, before: Coordinates) -> Coordinates {
    let step = match (record.point(), record.data.last()) {
        (Some(step), _) => step.map(Some),
        (None, Some(Word::Number(along))) => {
            std::array::from_fn(|axis| Some(along * before[axis + 3]?))
        }
        (None, _) => [None; 3],
    };
    let mut found = before;
    for axis in 0..3 {
        found[axis] = before[axis].zip(step[axis]).map(|(at, by)| at + by);
    }
    found
}
