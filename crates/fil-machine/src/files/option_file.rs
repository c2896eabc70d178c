//! Import of a G-POST option file (UNCX01.Pnn, UNCL01.Pnn).
//!
//! The text has a header line, a title, then `INTCOM:(LOCATION,VALUE)` pairs,
//! `RELCOM:` and `DBLCOM:` likewise, each list ending with location 0. Only what
//! differs from the vendor's own defaults is stored; the defaults that a report
//! shows and the file leaves out are set here first.

use std::collections::HashMap;

use fil_diag::{Diag, LevelProfile, Result, TextSpan};

use crate::commons::{Commons, EMPTY, Kind};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{Evidence, Location, default_commons};
use crate::stored;

/// How the machines of lathes are called, before their number.
const LATHE: &str = "UNCL";

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
/// location 9003) and no code for taps of left-hand threads (9400), because no location
/// for them is known.
const VENDOR_DEFAULTS: &[(Kind, u32, f64)] = &[
    (Kind::Int, 9003, EMPTY),
    (Kind::Int, 9400, EMPTY),
    (Kind::Int, 471, EMPTY),
    (Kind::Int, 480, EMPTY),
    (Kind::Int, 509, EMPTY),
    (Kind::Int, 516, EMPTY),
    (Kind::Int, 487, 6.0),
    (Kind::Int, 4313, 0.0),
    (Kind::Int, 4314, 0.0),
    (Kind::Int, 4674, 1.0),
    (Kind::Int, 1832, 0.0),
    (Kind::Int, 1866, 0.0),
    (Kind::Int, 1917, 0.0),
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

/// Errors after which the rest of a file is not read: it is no option file.
const MOST_ERRORS: usize = 50;

/// Lines before the first list: the header and the title.
const HEAD: u32 = 2;

/// Reads the option file of a mill.
///
/// # Errors
/// All that is wrong: the file of a lathe, whose defaults nobody has published; lines
/// that are no pairs, locations out of range, lists that are missing, come twice or
/// have no end.
pub fn read_option_file(file: &str, text: &str) -> Result<OptionFile, Vec<Diag>> {
    if let Err(diag) = refuse_a_lathe(file, text) {
        return Err(vec![*diag]);
    }
    let mut read = read(vendor_commons(), file, text)?;
    // The posts that option files come from took their authors at their word.
    read.commons.levels_mut().choose(LevelProfile::Legacy);
    Ok(read)
}

/// Lays an option file over the settings of a machine, of a lathe too: what the file
/// leaves out stays as it is there.
///
/// # Errors
/// As [`read_option_file`], but the file of a lathe is taken.
pub fn lay_option_file_over(
    commons: &mut Commons,
    file: &str,
    text: &str,
) -> Result<Vec<Diag>, Vec<Diag>> {
    let laid = read(commons.clone(), file, text)?;
    *commons = laid.commons;
    Ok(laid.warnings)
}

/// True for a text with the lists of an option file; a `machine.toml` has none.
pub fn is_option_text(text: &str) -> bool {
    text.lines().take(10).any(|line| list_start(line) == Some(Kind::Int))
}

fn read(commons: Commons, file: &str, text: &str) -> Result<OptionFile, Vec<Diag>> {
    let mut reader = Reader {
        file,
        commons,
        title: String::new(),
        open: None,
        lists: Vec::new(),
        given: HashMap::new(),
        idle: Vec::new(),
        first_idle: None,
        warnings: Vec::new(),
        errors: Vec::new(),
    };
    for (number, line) in (1u32..).zip(text.lines()) {
        let line = line.trim_end();
        if let Err(diag) = reader.line(number, line) {
            reader.errors.push(diag.at(TextSpan::line(file, number, line)));
        }
        if reader.errors.len() == MOST_ERRORS {
            return Err(reader.errors);
        }
    }
    reader.end(text)
}

/// Refuses the file of a lathe: what it leaves out has the values of the vendor's
/// lathe, and those are not published. The name of the file and its first line say it.
///
/// # Errors
/// E0608
fn refuse_a_lathe(file: &str, text: &str) -> Result<()> {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file).to_ascii_uppercase();
    let head = text.lines().next().unwrap_or_default();
    let says = |text: &str, family: &str| {
        let mut rest = text.split(family).skip(1);
        rest.any(|rest| rest.starts_with(|next: char| next.is_ascii_digit()))
    };
    if says(&name, LATHE) {
        let diag = MachineCode::LatheOptionFile
            .diag(format!("its name is that of a lathe's option file ({LATHE})"));
        return Err(Box::new(diag.at(TextSpan::line(file, 1, head))));
    }
    if says(&head.to_ascii_uppercase(), LATHE) {
        let diag = MachineCode::LatheOptionFile
            .diag(format!("the first line names the option file of a lathe ({LATHE})"));
        return Err(Box::new(diag.at(TextSpan::line(file, 1, head))));
    }
    Ok(())
}

/// A list of pairs that is being read.
#[derive(Clone, Copy)]
struct OpenList {
    kind: Kind,
    /// The line of its head.
    line: u32,
}

/// What has been read so far.
struct Reader<'a> {
    file: &'a str,
    commons: Commons,
    title: String,
    open: Option<OpenList>,
    /// The lists that were begun.
    lists: Vec<Kind>,
    /// The values of the locations so far.
    given: HashMap<(Kind, u32), f64>,
    /// Locations that the post does not act on.
    idle: Vec<(Kind, u32)>,
    first_idle: Option<TextSpan>,
    warnings: Vec<Diag>,
    errors: Vec<Diag>,
}

impl Reader<'_> {
    fn line(&mut self, number: u32, line: &str) -> Result<(), Diag> {
        let refuse = |message: String| Err(*MachineCode::OptionFile.diag(message));
        if number == HEAD {
            self.title = line.trim().to_string();
        }
        if let Some(kind) = list_start(line) {
            let name = kind.name();
            let before = self.open.replace(OpenList { kind, line: number });
            let is_again = self.lists.contains(&kind);
            self.lists.push(kind);
            return match before {
                Some(before) => {
                    refuse(format!("the list {} has no end (location 0)", before.kind.name()))
                }
                None if is_again => refuse(format!("a second list {name}")),
                None => Ok(()),
            };
        }
        if line.trim().is_empty() {
            return Ok(());
        }
        let Some(OpenList { kind, .. }) = self.open else {
            return match number > HEAD {
                true => refuse("this line is in no list".into()),
                false => Ok(()),
            };
        };
        match pair(line) {
            None => refuse("a location and a value are needed".into()),
            Some((0, value)) if value != 0.0 => {
                refuse(format!("location 0 ends the list, and has no value {value}"))
            }
            Some((0, _)) => {
                self.open = None;
                Ok(())
            }
            Some((location, value)) => self.pair(kind, location, value, number, line),
        }
    }

    fn pair(
        &mut self,
        kind: Kind,
        location: u32,
        value: f64,
        number: u32,
        line: &str,
    ) -> Result<(), Diag> {
        self.commons.set(kind, location, value).map_err(|diag| *diag)?;
        if let Some(before) = self.given.insert((kind, location), value)
            && before != value
        {
            return Err(*MachineCode::OptionFile.diag(format!(
                "{} {location} is given twice, as {before} and as {value}",
                kind.name()
            )));
        }
        let place = || TextSpan::line(self.file, number, line);
        self.warnings.extend(doubt(kind, location, value).map(|diag| diag.at(place())));
        let value = self.commons.get(kind, location).unwrap_or(value);
        if stored::is_idle(kind, location, value) {
            self.first_idle.get_or_insert_with(place);
            self.idle.push((kind, location));
        }
        Ok(())
    }

    /// What the whole file makes.
    fn end(mut self, text: &str) -> Result<OptionFile, Vec<Diag>> {
        let last = text.lines().count().max(1) as u32;
        if let Some(OpenList { kind, line }) = self.open {
            let message = format!("the file ends before its list {} does", kind.name());
            let head = TextSpan::line(self.file, line, "").label("the list begins here");
            let diag = *MachineCode::OptionFile.diag(message);
            self.errors.push(diag.at(TextSpan::line(self.file, last, "")).at(head));
        }
        for kind in [Kind::Int, Kind::Rel, Kind::Dbl] {
            if !self.lists.contains(&kind) {
                let message = format!("the file has no list {}", kind.name());
                let diag = *MachineCode::OptionFile.diag(message);
                self.errors.push(diag.at(TextSpan::line(self.file, last, "")));
            }
        }
        if !self.errors.is_empty() {
            return Err(self.errors);
        }
        if let Some(place) = self.first_idle {
            self.warnings.push(stored::without_effect(&self.idle).at(place));
        }
        Ok(OptionFile { title: self.title, commons: self.commons, warnings: self.warnings })
    }
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

/// Numbers of choices that a report puts into words beside a file that holds them: units as
/// the CL file has them, arcs by their radius, cycle words at the first hole only, and axis
/// words at each. Other numbers of these locations are ours.
const REPORTED: &[(Kind, u32, f64)] = &[
    (Kind::Int, 1833, 13.0),
    (Kind::Int, 1924, 3.0),
    (Kind::Int, 4337, 3.0),
    (Kind::Int, 4635, -1.0),
];

/// A warning where a stored value has a meaning we gave its number ourselves.
fn doubt(kind: Kind, location: u32, value: f64) -> Option<Diag> {
    if REPORTED.contains(&(kind, location, value)) {
        return None;
    }
    let row = Location::numbered(kind, location)?;
    let ours = row.evidence == Evidence::Own && location < 9001;
    let strange = stored::check(kind, location, value).is_err();
    (row.used && (ours || strange)).then(|| {
        Diag::new(
            MachineCode::DoubtfulImport,
            format!("{} {location} (`{}`) = {value}: meaning not published", kind.name(), row.name),
        )
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

    /// Codes and lines of all that is wrong.
    fn errors(file: &str, text: &str) -> Vec<(String, u32)> {
        let diags = read_option_file(file, text).unwrap_err();
        diags.iter().map(|diag| (diag.code.name(), diag.spans[0].line)).collect()
    }

    #[test]
    fn a_broken_file_is_refused_with_its_lines() {
        let one = |text: &str| errors("uncx01.p09", text).remove(0);
        assert_eq!(one(&SMALL.replace("13     53", "13     x")), ("E0606".into(), 4));
        assert_eq!(one(&SMALL.replace("13     53", "13000 1")), ("E0601".into(), 4));
        assert_eq!(one(&SMALL.replace("13     53", "0 7")), ("E0606".into(), 4));
        assert_eq!(one(&SMALL.replace("13     53", "0 0")), ("E0606".into(), 5));
        assert_eq!(one(&SMALL.replace("RELCOM", "DBLCOM")), ("E0606".into(), 10));
        let broken = SMALL.replace("13     53", "13     x").replace("1831      2", "1831 2 3");
        let found = errors("uncx01.p09", &broken);
        assert_eq!(found, [("E0606".into(), 4), ("E0606".into(), 6)]);
        assert_eq!(errors("f", "nothing\nhere\n").len(), 3);
        let junk = format!("UNCX01\nTEST\nINTCOM:\n{}", "x\n".repeat(10_000));
        assert_eq!(errors("f", &junk).len(), MOST_ERRORS);
    }

    /// Wherever the text is cut, the file is refused: a setting would be missing.
    #[test]
    fn a_file_that_is_cut_is_refused() {
        let whole = SMALL.trim_end_matches(['0', ' ', '\r', '\n']).len();
        for end in 0..whole {
            assert!(read_option_file("uncx01.p09", &SMALL[..end]).is_err(), "{:?}", &SMALL[..end]);
        }
    }

    #[test]
    fn a_location_with_two_values_is_refused() {
        let two = SMALL.replace("13     53", "471 81\r\n471 82");
        assert_eq!(errors("uncx01.p09", &two), [("E0606".into(), 5)]);
        assert!(read_option_file("uncx01.p09", &two.replace("82", "81")).is_ok());
    }

    #[test]
    fn a_lathes_file_is_refused() {
        let lathe = SMALL.replace("UNCX01.P09", "UNCL01.P09");
        assert_eq!(errors("uncx01.p09", &lathe), [("E0608".into(), 1)]);
        for file in ["posts/uncl01.p09", "C:\\posts\\UNCL01.P09"] {
            let refused = read_option_file(file, SMALL).unwrap_err();
            assert_eq!(refused[0].code.name(), "E0608", "{file}");
        }
        assert!(read_option_file("uncl/uncx01.p09", SMALL).is_ok());
        assert!(read_option_file("uncle.p09", SMALL).is_ok());
    }

    #[test]
    fn a_lathes_file_is_laid_over_a_machine() {
        let lathe = SMALL.replace("UNCX01.P09", "UNCL01.P09");
        let mut commons = default_commons();
        crate::files::apply_setting(&mut commons, "feed.mode=99").unwrap();
        lay_option_file_over(&mut commons, "uncl01.p09", &lathe).unwrap();
        assert_eq!(commons.dbl(loc::SCALE_X), 2.0);
        assert_eq!(commons.read(loc::FEED_MODE), Some(99));
        let before = commons.clone();
        assert!(lay_option_file_over(&mut commons, "uncl01.p09", &lathe[..90]).is_err());
        assert_eq!(commons.dbl(loc::SCALE_X), before.dbl(loc::SCALE_X));
        assert!(is_option_text(&lathe) && !is_option_text("name = \"INTCOM:\"\n"));
    }

    #[test]
    fn what_does_not_act_is_named_once() {
        let text = SMALL.replace("13     53", "2082 1\r\n2083 2\r\n1868 1\r\n3000 -32767");
        let file = read_option_file("uncx01.p09", &text).unwrap();
        let said: Vec<String> = file.warnings.iter().map(ToString::to_string).collect();
        assert_eq!(
            said,
            [concat!(
                "W0651 uncx01.p09:4:1: the post does not act on program.merging; ",
                "what INTCOM 2082 to 2083 mean is not published"
            )]
        );
    }
}
