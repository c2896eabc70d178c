//! A page of one file: the path on a canvas, and a script that zooms, turns and
//! tells of what lies under the pointer.

use std::collections::HashMap;
use std::fmt::Write as _;

use super::encode::{Numbers, json};
use super::svg::{escape, short};
use super::{CL_COLOUR, Drawing, Extent, Note, Stroke, Trace};
use crate::motion::{Rate, Speed, Spindle};

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = concat!(include_str!("page.js"), include_str!("pane.js"));

/// Steps of a unit in which feeds, speeds and directions are kept.
const FINE: f64 = 1e4;

/// Steps over the longest side of the path in which its points are kept.
const STEPS: f64 = 1_048_576.0;

/// The page. It needs no other file and no server.
pub fn html(drawing: &Drawing) -> String {
    let extent = drawing.extent();
    let sides = extent.map_or(String::new(), |extent| {
        let side =
            |axis: usize| format!("{} to {}", short(extent.min[axis]), short(extent.max[axis]));
        format!("X {} · Y {} · Z {}", side(0), side(1), side(2))
    });
    let fields = [
        ("{{title}}", escape(&drawing.title)),
        ("{{style}}", STYLE.to_string()),
        ("{{extent}}", sides),
        ("{{data}}", data(drawing, extent)),
        ("{{script}}", SCRIPT.to_string()),
    ];
    let mut page = String::new();
    let mut rest = PAGE;
    while let Some(at) = rest.find("{{") {
        page.push_str(&rest[..at]);
        rest = &rest[at..];
        match fields.iter().find(|(name, _)| rest.starts_with(name)) {
            Some((name, text)) => {
                page.push_str(text);
                rest = &rest[name.len()..];
            }
            None => {
                page.push_str("{{");
                rest = &rest[2..];
            }
        }
    }
    page.push_str(rest);
    page
}

/// What the script reads.
fn data(drawing: &Drawing, extent: Option<Extent>) -> String {
    let extent = extent.unwrap_or(Extent { min: [0.0; 3], max: [0.0; 3] });
    let step = (extent.size() / STEPS).max(1e-6);
    let mut out = String::from("{");
    let list = |values: [f64; 3]| format!("[{},{},{}]", values[0], values[1], values[2]);
    let _ =
        write!(out, "\"step\":{step},\"min\":{},\"max\":{},", list(extent.min), list(extent.max));
    let strokes: Vec<String> = Stroke::ALL
        .iter()
        .map(|stroke| {
            format!("{{\"name\":\"{}\",\"colour\":\"{}\"}}", stroke.name(), stroke.colour())
        })
        .collect();
    let _ = write!(out, "\"strokes\":[{}],\"underColour\":\"{CL_COLOUR}\",", strokes.join(","));
    let _ = write!(out, "\"lathe\":{},", drawing.lathe);
    let _ = write!(out, "\"underName\":\"{}\",", drawing.under_name);
    let _ = write!(out, "\"path\":{}", trace(&drawing.path, &drawing.notes, &extent, step));
    if let Some(under) = &drawing.under {
        let _ = write!(out, ",\"under\":{}", trace(under, &drawing.under_notes, &extent, step));
    }
    out.push('}');
    out
}

fn trace(trace: &Trace, notes: &[Note], extent: &Extent, step: f64) -> String {
    let changes: Vec<String> = trace
        .changes
        .iter()
        .map(|change| {
            let [x, y, z] = change.at;
            format!("[{x},{y},{z},{},{}]", change.tool, change.line)
        })
        .collect();
    let (origins, of_lines) = origins(notes);
    let texts: Vec<&str> = notes.iter().map(|note| note.text.as_str()).collect();
    format!(
        "{{\"points\":\"{}\",\"pieces\":\"{}\",\"inForce\":\"{}\",\"axes\":\"{}\",\"changes\":[{}],\
         \"texts\":{},\"origins\":[{}],\"originOf\":\"{}\"}}",
        points(trace, extent, step),
        pieces(trace),
        in_force(trace),
        axes(trace),
        changes.join(","),
        json(&texts.join("\n")),
        origins.join(","),
        of_lines
    )
}

/// Points as steps from the one before.
fn points(trace: &Trace, extent: &Extent, step: f64) -> String {
    let mut numbers = Numbers::default();
    let mut at = [0i64; 3];
    for point in &trace.points {
        for axis in 0..3 {
            let to = ((point[axis] - extent.min[axis]) / step).round() as i64;
            numbers.push_signed(to - at[axis]);
            at[axis] = to;
        }
    }
    numbers.base64()
}

/// Pieces: number of points, whether it goes on from the one before, stroke; line as
/// a difference.
fn pieces(trace: &Trace) -> String {
    let mut numbers = Numbers::default();
    let (mut end, mut line) = (0, 0i64);
    for piece in &trace.pieces {
        let goes_on = piece.start + 1 == end;
        let stroke = Stroke::ALL.iter().position(|stroke| *stroke == piece.stroke).unwrap_or(0);
        let count = (piece.end - piece.start) as u64;
        numbers.push(count << 3 | u64::from(goes_on) << 2 | stroke as u64);
        numbers.push_signed(i64::from(piece.line) - line);
        (end, line) = (piece.end, i64::from(piece.line));
    }
    numbers.base64()
}

/// What is in force: the pieces since the one before; tool; feed a minute (1), a turn (2) or
/// none (0), and the feed; speed in turns (1), at the surface (2) or none (0), and the speed;
/// spindle off (0), clockwise (1), counterclockwise (2); work offset and 1, or 0 without one.
fn in_force(trace: &Trace) -> String {
    let mut numbers = Numbers::default();
    let mut before = 0;
    let fine = |value: f64| (value.max(0.0) * FINE).round() as u64;
    for now in &trace.in_force {
        numbers.push((now.from - before) as u64);
        before = now.from;
        numbers.push(now.tool.into());
        let (kind, feed) = match now.feed {
            Some(Rate::PerMinute(feed)) => (1, feed),
            Some(Rate::PerTurn(feed)) => (2, feed),
            Some(Rate::Inverse(_)) | None => (0, 0.0),
        };
        numbers.push(kind);
        numbers.push(fine(feed));
        let (kind, speed) = match now.speed {
            Some(Speed::Turns(speed)) => (1, speed),
            Some(Speed::Surface(speed)) => (2, speed),
            None => (0, 0.0),
        };
        numbers.push(kind);
        numbers.push(fine(speed));
        numbers.push(match now.spindle {
            Spindle::Off => 0,
            Spindle::Clockwise => 1,
            Spindle::Counterclockwise => 2,
        });
        numbers.push(now.fixture.map_or(0, |fixture| u64::from(fixture) + 1));
    }
    numbers.base64()
}

/// Directions of the tool: the pieces since the one before, and the three parts.
fn axes(trace: &Trace) -> String {
    let mut numbers = Numbers::default();
    let mut before = 0;
    for (from, axis) in &trace.axes {
        numbers.push((from - before) as u64);
        before = *from;
        axis.iter().for_each(|part| numbers.push_signed((part * FINE).round() as i64));
    }
    numbers.base64()
}

/// The different origins, and which of them each line has.
fn origins(notes: &[Note]) -> (Vec<String>, String) {
    let mut list = vec![json("")];
    let mut known: HashMap<&str, u64> = HashMap::from([("", 0)]);
    let mut numbers = Numbers::default();
    if notes.iter().any(|note| !note.origin.is_empty()) {
        for note in notes {
            let index = *known.entry(&note.origin).or_insert_with(|| {
                list.push(json(&note.origin));
                list.len() as u64 - 1
            });
            numbers.push(index);
        }
    }
    (list, numbers.base64())
}
