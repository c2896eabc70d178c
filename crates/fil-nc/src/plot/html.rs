//! A page of one file: the path on a canvas, and a script that zooms, turns and
//! tells of what lies under the pointer.

use std::io::{self, Write};

use fil_machine::Unit;

use super::encode::json;
use super::pack::{self, Grid};
use super::svg::{escape, sides};
use super::{AXIS_COLOUR, CL_COLOUR, Drawing, Extent, Point, Stroke};

const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");

/// One module, in the order in which its parts need each other.
const SCRIPT: &str = concat!(
    include_str!("page/read.js"),
    include_str!("page/view.js"),
    include_str!("page/time.js"),
    include_str!("page/draw.js"),
    include_str!("page/marks.js"),
    include_str!("page/pointer.js"),
    include_str!("page/pane.js"),
    include_str!("page/play.js"),
    include_str!("page/filter.js"),
    include_str!("page/hands.js"),
);

/// The page. It needs no other file and no server.
pub fn html(drawing: &Drawing<'_>) -> String {
    let mut page = Vec::new();
    // What is written is text, and a vector takes all of it.
    let _ = write_html(drawing, &mut page);
    String::from_utf8(page).unwrap_or_default()
}

/// Writes the page. No more of it is in memory than the writer keeps.
///
/// # Errors
/// Those of the writer.
pub fn write_html(drawing: &Drawing<'_>, out: &mut dyn Write) -> io::Result<()> {
    let extent = drawing.extent();
    let mut rest = PAGE;
    while let Some((text, (name, behind))) =
        rest.split_once("{{").and_then(|(text, rest)| Some((text, rest.split_once("}}")?)))
    {
        out.write_all(text.as_bytes())?;
        match name {
            "title" => out.write_all(escape(&drawing.title).as_bytes()),
            "style" => out.write_all(STYLE.as_bytes()),
            "extent" => {
                let sides = extent.map_or(String::new(), |extent| sides(&extent, drawing));
                out.write_all(sides.as_bytes())
            }
            "data" => data(drawing, extent, out),
            _ => out.write_all(SCRIPT.as_bytes()),
        }?;
        rest = behind;
    }
    out.write_all(rest.as_bytes())
}

/// What the script reads.
fn data(drawing: &Drawing<'_>, extent: Option<Extent>, out: &mut dyn Write) -> io::Result<()> {
    let extent = extent.unwrap_or(Extent { min: [0.0; 3], max: [0.0; 3] });
    let grid = Grid::new(&extent, drawing.path.unit());
    let strokes = Stroke::ALL.map(|stroke| {
        format!("{{\"name\":\"{}\",\"colour\":\"{}\"}}", stroke.name(), stroke.colour())
    });
    let notes = &drawing.notes;
    // The CL file of the line map is mostly the one under the program: it is packed once.
    let source = notes.source.as_deref().unwrap_or_default();
    let is_under = drawing.under.is_some() && source == drawing.under_notes.text;
    let source = if is_under { "" } else { source };
    let fields = [
        ("step", grid.step.to_string()),
        ("min", list(extent.min)),
        ("max", list(extent.max)),
        ("unit", unit(drawing.path.unit())),
        ("strokes", format!("[{}]", strokes.join(","))),
        ("underColour", json(CL_COLOUR)),
        ("axisColour", json(AXIS_COLOUR)),
        ("lathe", drawing.lathe.to_string()),
        ("diameter", drawing.diameter.to_string()),
        ("underName", json(drawing.under_name)),
        ("sourceIsUnder", is_under.to_string()),
    ];
    out.write_all(b"{")?;
    for (name, value) in fields {
        writeln!(out, "\"{name}\":{value},")?;
    }
    out.write_all(b"\"path\":")?;
    pack::trace(&drawing.path, notes, source, &grid, out)?;
    if let Some(under) = &drawing.under {
        out.write_all(b",\n\"under\":")?;
        pack::trace(under, &drawing.under_notes, "", &grid, out)?;
    }
    out.write_all(b"}")
}

fn list([x, y, z]: Point) -> String {
    format!("[{x},{y},{z}]")
}

/// A unit: its name, and its length in mm.
fn unit(unit: Unit) -> String {
    format!("{{\"name\":\"{unit}\",\"size\":{}}}", unit.in_mm())
}
