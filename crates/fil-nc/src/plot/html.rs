//! A page of one file: the path on a canvas, and a script that zooms, turns and
//! tells of what lies under the pointer.

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
pub fn html(drawing: &Drawing) -> String {
    let extent = drawing.extent();
    let fields = [
        ("{{title}}", escape(&drawing.title)),
        ("{{style}}", STYLE.to_string()),
        ("{{extent}}", extent.map_or(String::new(), |extent| sides(&extent, drawing))),
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
    let grid = Grid::new(&extent, drawing.path.unit());
    let strokes = Stroke::ALL.map(|stroke| {
        format!("{{\"name\":\"{}\",\"colour\":\"{}\"}}", stroke.name(), stroke.colour())
    });
    let notes = &drawing.notes;
    // The CL file of the line map is mostly the one under the program: it is packed once.
    let source = notes.source.as_deref().unwrap_or_default();
    let is_under = drawing.under.is_some() && source == drawing.under_notes.text;
    let source = if is_under { "" } else { source };
    let mut fields = vec![
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
        ("path", pack::trace(&drawing.path, notes, source, &grid)),
    ];
    if let Some(under) = &drawing.under {
        fields.push(("under", pack::trace(under, &drawing.under_notes, "", &grid)));
    }
    let fields: Vec<String> =
        fields.into_iter().map(|(name, value)| format!("\"{name}\":{value}")).collect();
    format!("{{{}}}", fields.join(",\n"))
}

fn list([x, y, z]: Point) -> String {
    format!("[{x},{y},{z}]")
}

/// A unit: its name, and its length in mm.
fn unit(unit: Unit) -> String {
    format!("{{\"name\":\"{unit}\",\"size\":{}}}", unit.in_mm())
}
