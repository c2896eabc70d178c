//! A path as plain columns for a viewer: what a script reads without unpacking.
//!
//! Four bytes `FPV1`, the length of the head (u32), the head (JSON, filled up with spaces), the
//! columns. All numbers are little-endian. The head gives each column its kind, its first byte
//! counted from the end of the head, and its count.

use super::encode::json;
use super::{Drawing, Extent, InForce, Point, Stroke, ToolShape, Trace, time};
use crate::forward::Forward;
use crate::motion::{Rate, Speed, Spindle};
use fil_machine::axis_chain::Carries;

/// Where a column begins: a multiple of it, so that a script can look at its numbers in place.
const ALIGNED: usize = 8;

/// The path of a drawing, without what lies under it.
///
/// | column | kind | of |
/// |---|---|---|
/// | `points` | f32, three a point | X, Y, Z from `base`, mm |
/// | `starts`, `ends` | u32 | first point of a piece, one after its last |
/// | `strokes` | u8 | 0 rapid, 1 feed, 2 arc, 3 thread |
/// | `lines` | u32 | line of the program, 1-based |
/// | `seconds` | f64 | time from the start to the end of a piece |
/// | `forceFrom` … | see `in_force` | what is in force from a piece on |
/// | `axesFrom`, `axes` | u32; f32, three a row | direction of the tool from a piece on |
/// | `rotaryFrom`, `rotary` | u32; f32, two a row | rotary axes at the end of a piece and after it, degrees |
/// | `changeFrom`, `changeTool`, `changeLine`, `changeAt` | u32; f32, three a row | tool changes |
pub fn columns(drawing: &Drawing<'_>) -> Vec<u8> {
    let path = &drawing.path;
    let extent = Extent::of(&path.points).unwrap_or(Extent { min: [0.0; 3], max: [0.0; 3] });
    let base = std::array::from_fn(|axis| (extent.min[axis] + extent.max[axis]) / 2.0);
    let mut columns = Columns::default();
    columns.add("points", "f32", path.points.iter().flat_map(|point| beside(point, &base)));
    columns.add("starts", "u32", path.pieces.iter().map(|piece| piece.start.to_le_bytes()));
    columns.add("ends", "u32", path.pieces.iter().map(|piece| piece.end.to_le_bytes()));
    columns.add("strokes", "u8", path.pieces.iter().map(|piece| [stroke(piece.stroke)]));
    columns.add("lines", "u32", path.pieces.iter().map(|piece| piece.line.to_le_bytes()));
    columns.add("seconds", "f64", time::ends(path).into_iter().map(f64::to_le_bytes));
    in_force(&mut columns, path);
    columns.add("axesFrom", "u32", path.axes.iter().map(|(from, _)| (*from as u32).to_le_bytes()));
    columns.add("axes", "f32", path.axes.iter().flat_map(|(_, axis)| floats(axis)));
    let rotary = path.rotary.iter();
    columns.add("rotaryFrom", "u32", rotary.map(|(from, _)| (*from as u32).to_le_bytes()));
    columns.add("rotary", "f32", path.rotary.iter().flat_map(|(_, at)| floats(at)));
    let changes = || path.changes.iter();
    columns.add("changeFrom", "u32", changes().map(|change| (change.from as u32).to_le_bytes()));
    columns.add("changeTool", "u32", changes().map(|change| change.tool.to_le_bytes()));
    columns.add("changeLine", "u32", changes().map(|change| change.line.to_le_bytes()));
    columns.add("changeAt", "f32", changes().flat_map(|change| beside(&change.at, &base)));
    columns.finish(&head(drawing, &extent, &base))
}

/// What is in force: the feed in mm/min (kind 1) or mm a turn (2), none (0); the speed in rpm
/// (1) or m/min at the surface (2), none (0); the spindle off (0), clockwise (1),
/// counterclockwise (2); the work offset and 1, or 0 without one.
fn in_force(columns: &mut Columns, path: &Trace) {
    let rows = || path.in_force.iter();
    columns.add("forceFrom", "u32", rows().map(|now| (now.from as u32).to_le_bytes()));
    columns.add("tool", "u32", rows().map(|now| now.tool.to_le_bytes()));
    columns.add("feedKind", "u8", rows().map(|now| [feed(now).0]));
    columns.add("feed", "f32", rows().map(|now| (feed(now).1 as f32).to_le_bytes()));
    columns.add("speedKind", "u8", rows().map(|now| [speed(now).0]));
    columns.add("speed", "f32", rows().map(|now| (speed(now).1 as f32).to_le_bytes()));
    columns.add("spindle", "u8", rows().map(|now| [spindle(now.spindle)]));
    let fixture = |now: &InForce| now.fixture.map_or(0, |fixture| fixture + 1);
    columns.add("fixture", "u32", rows().map(|now| fixture(now).to_le_bytes()));
}

fn feed(now: &InForce) -> (u8, f64) {
    match now.feed {
        Some(Rate::PerMinute(feed)) => (1, feed),
        Some(Rate::PerTurn(feed) | Rate::Varying(feed, _)) => (2, feed),
        Some(Rate::Inverse(_)) | None => (0, 0.0),
    }
}

fn speed(now: &InForce) -> (u8, f64) {
    match now.speed {
        Some(Speed::Turns(speed)) => (1, speed),
        Some(Speed::Surface(speed)) => (2, speed),
        None => (0, 0.0),
    }
}

fn spindle(spindle: Spindle) -> u8 {
    match spindle {
        Spindle::Off => 0,
        Spindle::Clockwise => 1,
        Spindle::Counterclockwise => 2,
    }
}

fn stroke(stroke: Stroke) -> u8 {
    Stroke::ALL.iter().position(|one| *one == stroke).unwrap_or(0) as u8
}

/// A point counted from another, so that four bytes are enough for it.
fn beside(point: &Point, base: &Point) -> [[u8; 4]; 3] {
    std::array::from_fn(|axis| ((point[axis] - base[axis]) as f32).to_le_bytes())
}

fn floats<const N: usize>(values: &[f64; N]) -> [[u8; 4]; N] {
    values.map(|value| (value as f32).to_le_bytes())
}

/// Columns that are put together.
#[derive(Default)]
struct Columns {
    bytes: Vec<u8>,
    /// Rows of the table of contents.
    contents: Vec<String>,
}

impl Columns {
    fn add<const N: usize>(
        &mut self,
        name: &str,
        kind: &str,
        values: impl Iterator<Item = [u8; N]>,
    ) {
        self.bytes.resize(self.bytes.len().next_multiple_of(ALIGNED), 0);
        let start = self.bytes.len();
        self.bytes.extend(values.flatten());
        let count = (self.bytes.len() - start) / N;
        self.contents.push(format!("\"{name}\":[\"{kind}\",{start},{count}]"));
    }

    fn finish(self, head: &str) -> Vec<u8> {
        let mut head = format!("{{\"columns\":{{{}}},{head}}}", self.contents.join(","));
        while !head.len().is_multiple_of(ALIGNED) {
            head.push(' ');
        }
        let mut bytes = b"FPV1".to_vec();
        bytes.extend((head.len() as u32).to_le_bytes());
        bytes.extend(head.as_bytes());
        bytes.extend(self.bytes);
        bytes
    }
}

/// The fields of the head besides the table of contents.
fn head(drawing: &Drawing<'_>, extent: &Extent, base: &Point) -> String {
    let left_out = drawing.path.left_out.iter().map(|left_out| {
        let why = json(&left_out.why);
        format!("{{\"line\":{},\"count\":{},\"why\":{why}}}", left_out.line, left_out.count)
    });
    let fields = [
        ("title", json(&drawing.title)),
        ("base", list(base)),
        ("min", list(&extent.min)),
        ("max", list(&extent.max)),
        ("inch", drawing.path.inch.to_string()),
        ("lathe", drawing.lathe.to_string()),
        ("diameter", drawing.diameter.to_string()),
        ("rapid", time::RAPID.to_string()),
        ("tools", array(drawing.tools.iter().map(tool))),
        ("leftOut", array(left_out)),
        ("chain", drawing.forward.as_ref().map_or("null".to_string(), chain)),
    ];
    fields.map(|(name, value)| format!("\"{name}\":{value}")).join(",")
}

fn tool(tool: &ToolShape) -> String {
    let ToolShape { number, diameter, corner, bottom, length } = tool;
    let length = length.map_or("null".to_string(), |length| length.to_string());
    format!(
        "{{\"number\":{number},\"diameter\":{diameter},\"corner\":{corner},\
         \"bottom\":{bottom},\"length\":{length}}}"
    )
}

/// The rotary axes, primary first, each with its letter, what it carries, its direction and a
/// point on it; and the direction of the tool at zero.
fn chain(forward: &Forward) -> String {
    let axes = forward.rotaries().iter().map(|rotary| {
        let Some(rotary) = rotary else { return "null".to_string() };
        let carries = match rotary.carries {
            Carries::Head => "head",
            Carries::Table => "table",
        };
        format!(
            "{{\"letter\":{},\"carries\":\"{carries}\",\"direction\":{},\"center\":{}}}",
            json(&rotary.letter.to_string()),
            list(&rotary.direction.into_inner().into()),
            list(&rotary.center.into())
        )
    });
    format!("{{\"axes\":{},\"tool\":{}}}", array(axes), list(&forward.tool().into()))
}

fn list([x, y, z]: &Point) -> String {
    format!("[{x},{y},{z}]")
}

fn array(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(","))
}
