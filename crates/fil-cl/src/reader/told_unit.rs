//! The unit of a file before its UNITS is read, and that of a file without UNITS, where its system
//! names it with each feed.
//!
//! A system that writes MMPM for parts in mm and IPM for parts in inches says the unit of the
//! points, too. It is taken only where the size of the tools and of the path goes with it.

use super::{Reader, number};
use crate::vocabulary::WordId;
use crate::words;

/// Sizes that go with a unit: those of a part and a tool as they are made.
struct Usual {
    unit: WordId,
    /// Diameters of the largest tool.
    tool: std::ops::Range<f64>,
    /// Longest way along X, Y or Z.
    path: std::ops::Range<f64>,
}

/// Beyond these the other unit is as likely.
const MM: Usual = Usual { unit: words::MM, tool: 1.0..f64::MAX, path: 10.0..f64::MAX };
const INCH: Usual = Usual { unit: words::INCHES, tool: 0.0..6.0, path: 0.0..200.0 };

/// What the beginning of a text tells about its unit.
#[derive(Default)]
struct Told {
    metric: bool,
    inch: bool,
    /// UNITS stands in it.
    is_said: bool,
    largest_tool: Option<f64>,
    /// Least and largest of each coordinate.
    extents: Option<[[f64; 2]; 3]>,
}

impl Reader<'_> {
    /// The unit of the points, MM or INCHES, by the unit of the feeds at the beginning of the
    /// text; to be asked before the first record. `None` where the dialect does not name it
    /// so, where UNITS says it, and where the size of tools or path speaks against it.
    pub fn told_unit(&mut self) -> Option<WordId> {
        self.begin().ok()?;
        if !self.rules().feeds_tell_unit {
            return None;
        }
        let mut told = Told::default();
        self.ahead().split(|byte| *byte == b'\n').for_each(|line| told.look(line));
        told.unit()
    }
}

impl Reader<'_> {
    /// The unit that UNITS gives behind nothing but names and texts, MM or INCHES; to be asked before
    /// the first record. What those statements make of themselves may need it.
    pub fn unit_ahead(&mut self) -> Option<WordId> {
        self.begin().ok()?;
        for line in self.ahead().split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii) {
            let end = line.iter().position(|byte| !byte.is_ascii_alphanumeric());
            let (major, rest) = line.split_at(end.unwrap_or(line.len()));
            match &major.to_ascii_uppercase()[..] {
                b"UNITS" | b"UNIT" => return unit(rest),
                b"" | b"MACHIN" | b"PARTNO" | b"PPRINT" | b"REMARK" | b"INSERT" | b"LETTER"
                | b"TITLES" | b"TPRINT" | b"LEADER" | b"PPWORD" => {}
                _ => return None,
            }
        }
        None
    }
}

/// The unit behind UNITS.
fn unit(rest: &[u8]) -> Option<WordId> {
    let name = rest.trim_ascii().strip_prefix(b"/")?.trim_ascii();
    let is = |unit: &[u8]| name.eq_ignore_ascii_case(unit);
    match () {
        () if is(b"MM") => Some(words::MM),
        () if is(b"INCHES") => Some(words::INCHES),
        () => None,
    }
}

impl Told {
    fn look(&mut self, line: &[u8]) {
        let mut parts = line.splitn(2, |byte| *byte == b'/');
        let major = parts.next().unwrap_or_default().trim_ascii().to_ascii_uppercase();
        let rest = parts.next().unwrap_or_default();
        let mut items = rest.split(|byte| *byte == b',').map(<[u8]>::trim_ascii);
        match &major[..] {
            b"UNITS" | b"UNIT" => self.is_said = true,
            b"FEDRAT" | b"CYCLE" => {
                for item in items {
                    self.metric |= is_any(item, [b"MMPM", b"MMPR"]);
                    self.inch |= is_any(item, [b"IPM", b"IPR"]);
                }
            }
            b"CUTTER" => self.note_tool(items.next()),
            b"TLDATA" => {
                let is_kind = |item: &&[u8]| is_any(item, [&b"MILL"[..], b"DRILL"]);
                let behind = items.find(|item| !is_kind(item));
                self.note_tool(behind);
            }
            b"GOTO" | b"FROM" => self.note_point(items),
            _ => {}
        }
    }

    fn note_tool(&mut self, diameter: Option<&[u8]>) {
        let diameter = diameter.and_then(number::number).filter(|diameter| *diameter > 0.0);
        self.largest_tool = diameter.into_iter().chain(self.largest_tool).reduce(f64::max);
    }

    fn note_point<'a>(&mut self, items: impl Iterator<Item = &'a [u8]>) {
        let point: Vec<f64> = items.take(3).map_while(number::number).collect();
        let [x, y, z] = point[..] else { return };
        let point = [x, y, z];
        let extents = self.extents.get_or_insert(point.map(|value| [value, value]));
        for ([least, most], value) in extents.iter_mut().zip(point) {
            (*least, *most) = (least.min(value), most.max(value));
        }
    }

    fn unit(&self) -> Option<WordId> {
        let usual = match (self.metric, self.inch) {
            (true, false) => MM,
            (false, true) => INCH,
            _ => return None,
        };
        let way = |extents: [[f64; 2]; 3]| extents.map(|[least, most]| most - least);
        let longest = self.extents.map(way)?.into_iter().fold(0.0, f64::max);
        let goes_with_it = match self.largest_tool {
            Some(diameter) => usual.tool.contains(&diameter),
            None => usual.path.contains(&longest),
        };
        (goes_with_it && !self.is_said && longest > 0.0).then_some(usual.unit)
    }
}

fn is_any(item: &[u8], words: [&[u8]; 2]) -> bool {
    words.iter().any(|word| item.eq_ignore_ascii_case(word))
}
