//! Import of a G-POST option file (UNCX01.Pnn, UNCL01.Pnn).
//!
//! The text has a header line, a title, then `INTCOM:(LOCATION,VALUE)` pairs,
//! `RELCOM:` and `DBLCOM:` likewise, each list ending with location 0. Only what
//! differs from the vendor's own defaults is stored; the defaults that a report
//! shows and the file leaves out are set here first.

use fil_diag::{Diag, Place, Result};

use crate::commons::{Commons, EMPTY, Kind};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{Location, default_commons};

/// An imported option file.
#[derive(Clone, Debug)]
pub struct OptionFile {
    /// Second line of the file.
    pub title: String,
    /// The settings.
    pub commons: Commons,
    /// Locations whose meaning is not known for sure.
    pub warnings: Vec<Diag>,
}

/// Values the vendor's post has where the file says nothing, as far as the
/// report of a real option file shows them; and no program number (own
/// location 9003), because no location for it is known.
const VENDOR_DEFAULTS: &[(Kind, u32, f64)] = &[
    (Kind::Int, 9003, EMPTY),
    (Kind::Int, 471, EMPTY),
    (Kind::Int, 480, EMPTY),
    (Kind::Int, 509, EMPTY),
    (Kind::Int, 516, EMPTY),
    (Kind::Int, 487, 6.0),
    (Kind::Int, 4313, 0.0),
    (Kind::Int, 4314, 0.0),
    (Kind::Int, 484, 0.0),
    (Kind::Int, 1869, 0.0),
    (Kind::Rel, 17, 3000.0),
    (Kind::Dbl, 130, 10.0),
    (Kind::Dbl, 131, 10.0),
    (Kind::Dbl, 132, 30.0),
    (Kind::Dbl, 423, 999.9999),
    (Kind::Dbl, 606, 30.0),
    (Kind::Dbl, 56, 2.0),
    (Kind::Dbl, 58, 2.0),
    (Kind::Dbl, 59, 2.0),
    (Kind::Dbl, 62, 2.0),
    (Kind::Dbl, 84, 0.1),
    (Kind::Dbl, 86, 99.99),
    (Kind::Dbl, 87, 0.0),
    (Kind::Dbl, 980, 0.0),
    (Kind::Dbl, 106, 200.0),
    (Kind::Dbl, 107, 200.0),
];

/// Letters a mill has where the file does not say otherwise.
const VENDOR_LETTERS: &[u8] = b"NGXYZIJKRFSTDHM";

/// Reads an option file.
///
/// # Errors
/// A line that is not a pair, a location out of range, a list without end, or
/// a file without the three lists.
pub fn read_option_file(file: &str, text: &str) -> Result<OptionFile> {
    let mut commons = vendor_commons();
    let mut warnings = Vec::new();
    let mut list = None;
    let mut lists = 0;
    let mut title = String::new();
    for (number, line) in (1u32..).zip(text.lines()) {
        let line = line.trim_end_matches('\r');
        let refuse = |message: &str| {
            Box::new(
                Diag::new(MachineCode::OptionFile, message).at(Place::line(file, number, line)),
            )
        };
        if number == 2 {
            title = line.trim().to_string();
        }
        if let Some(kind) = list_start(line) {
            if list.is_some() {
                return Err(refuse("the list before this one has no end (location 0)"));
            }
            list = Some(kind);
            lists += 1;
            continue;
        }
        let Some(kind) = list else { continue };
        if line.trim().is_empty() {
            continue;
        }
        let (location, value) =
            pair(line).ok_or_else(|| refuse("a location and a value are needed"))?;
        if location == 0 {
            list = None;
            continue;
        }
        commons
            .set(kind, location, value)
            .map_err(|diag| Box::new(diag.as_ref().clone().at(Place::line(file, number, line))))?;
        warnings.extend(doubt(kind, location, value, Place::line(file, number, line)));
    }
    if list.is_some() || lists == 0 {
        return Err(Box::new(
            Diag::new(MachineCode::OptionFile, "the file ends before its lists do")
                .at(Place::line(file, text.lines().count().max(1) as u32, "")),
        ));
    }
    Ok(OptionFile { title, commons, warnings })
}

fn vendor_commons() -> Commons {
    let mut commons = default_commons();
    for name in b'A'..=b'Z' {
        if !VENDOR_LETTERS.contains(&name) {
            commons
                .set(Kind::Int, u32::from(Letter::of(name).number()), 53.0)
                .expect("letters lie within INTCOM");
        }
    }
    for (kind, location, value) in VENDOR_DEFAULTS {
        commons.set(*kind, *location, *value).expect("the defaults lie within the commons");
    }
    commons
}

fn list_start(line: &str) -> Option<Kind> {
    let head = line.trim_start();
    [Kind::Int, Kind::Rel, Kind::Dbl]
        .into_iter()
        .find(|kind| head.strip_prefix(kind.name()).is_some_and(|rest| rest.starts_with(':')))
}

fn pair(line: &str) -> Option<(u32, f64)> {
    let mut fields = line.split_whitespace();
    let location = fields.next()?.parse().ok()?;
    let value = match fields.next() {
        None if location == 0 => 0.0,
        None => return None,
        Some(value) => value.replace(['D', 'd'], "E").parse::<f64>().ok()?,
    };
    (fields.next().is_none() && value.is_finite()).then_some((location, value))
}

/// A warning where a stored value has a meaning we gave its number ourselves.
fn doubt(kind: Kind, location: u32, value: f64, place: Place) -> Option<Diag> {
    let row = Location::numbered(kind, location)?;
    let ours = row.evidence == "own" && location < 9001;
    let strange = !row.choices.is_empty()
        && value != EMPTY
        && value != f64::from(crate::commons::NA)
        && row.choice_list().iter().all(|(choice, _)| *choice != value);
    (row.used && (ours || strange)).then(|| {
        Diag::new(
            MachineCode::DoubtfulImport,
            format!("{} {location} (`{}`) = {value}: meaning not published", kind.name(), row.name),
        )
        .at(place)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::locations as loc;

    const SMALL: &str = "POSTPROCESSOR OPTION FILE: UNCX01.P09\r\nTEST\r\n INTCOM:(LOCATION,VALUE)\r\n  \
        13     53\r\n 470 -32767\r\n1831      2\r\n   0      0\r\n RELCOM:(LOCATION,VALUE)\r\n   0\r\n \
        DBLCOM:(LOCATION,VALUE)\r\n 486  2.0000000\r\n   0      0\r\n";

    #[test]
    fn pairs_reach_the_commons() {
        let file = read_option_file("uncx01.p09", SMALL).unwrap();
        assert_eq!(file.title, "TEST");
        assert_eq!(file.commons.read(loc::CYCLE_DRILL_CODE), None);
        assert_eq!(file.commons.dbl(loc::SCALE_X), 2.0);
        assert_eq!(file.commons.int(crate::commons::Int(13)), 53);
    }

    #[test]
    fn a_broken_file_is_refused_with_its_line() {
        let error = |text: &str| {
            let diag = read_option_file("f", text).unwrap_err();
            (diag.code.name(), diag.places[0].line)
        };
        assert_eq!(error(&SMALL.replace("13     53", "13     x")), ("E0606".into(), 4));
        assert_eq!(error(&SMALL.replace("13     53", "13000 1")), ("E0601".into(), 4));
        assert_eq!(error("nothing\nhere\n"), ("E0606".into(), 2));
        assert_eq!(error(&SMALL[..SMALL.len() - 15]).0, "E0606");
    }
}
