//! Pictures of the documentation, drawn by the tests from computed numbers.
//!
//! Coordinates are millimetres of the drawing with Y up; the frame is found from
//! what is drawn. Line widths and letters keep their size at every scale.

use std::fs;
use std::path::Path;

use svg::Document;
use svg::node::element::{Circle, Path as Stroke, Text, path::Data};

/// Width of a finished picture.
const WIDTH: f64 = 720.0;
/// Free border around the drawing.
const MARGIN: f64 = 30.0;

/// How a line is drawn: CSS colour, width in pixels, dashed or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// CSS colour.
    pub colour: &'static str,
    /// Width, pixels.
    pub width: f64,
    /// Dashes and gaps, pixels; empty for a full line.
    pub dashes: &'static str,
}

impl Pen {
    /// A full line.
    pub const fn full(colour: &'static str, width: f64) -> Self {
        Pen { colour, width, dashes: "" }
    }

    /// A dashed line.
    pub const fn dashed(colour: &'static str, width: f64) -> Self {
        Pen { colour, width, dashes: "6 4" }
    }
}

/// What is drawn, in the order of drawing.
enum Item {
    Line(Vec<[f64; 2]>, Pen, Option<&'static str>),
    Circle([f64; 2], f64, Pen),
    Text([f64; 2], String),
}

/// A drawing that becomes an SVG file.
#[derive(Default)]
pub struct Picture {
    items: Vec<Item>,
}

impl Picture {
    /// An open polyline.
    pub fn line(&mut self, points: &[[f64; 2]], pen: Pen) {
        self.items.push(Item::Line(points.to_vec(), pen, None));
    }

    /// A polyline whose inside is filled with a CSS colour.
    pub fn area(&mut self, points: &[[f64; 2]], pen: Pen, fill: &'static str) {
        self.items.push(Item::Line(points.to_vec(), pen, Some(fill)));
    }

    /// A circle, radius in millimetres of the drawing.
    pub fn circle(&mut self, center: [f64; 2], radius: f64, pen: Pen) {
        self.items.push(Item::Circle(center, radius, pen));
    }

    /// A text whose middle is at a point.
    pub fn text(&mut self, at: [f64; 2], text: &str) {
        self.items.push(Item::Text(at, text.to_string()));
    }

    /// The SVG text.
    pub fn svg(&self) -> String {
        let (low, high) = self.extent();
        let scale = (WIDTH - 2.0 * MARGIN) / (high[0] - low[0]).max(1e-9);
        let height = (high[1] - low[1]) * scale + 2.0 * MARGIN;
        let place = |p: [f64; 2]| {
            let [x, y] = [(p[0] - low[0]) * scale + MARGIN, (high[1] - p[1]) * scale + MARGIN];
            [round(x), round(y)]
        };
        let mut document = Document::new()
            .set("viewBox", (0, 0, WIDTH, round(height)))
            .set("font-family", "sans-serif")
            .set("font-size", 13);
        for item in &self.items {
            document = match item {
                Item::Line(points, pen, fill) => {
                    document.add(stroke(points.iter().map(|p| place(*p)), pen, *fill))
                }
                Item::Circle(center, radius, pen) => {
                    let [x, y] = place(*center);
                    document.add(
                        Circle::new()
                            .set("cx", x)
                            .set("cy", y)
                            .set("r", round(radius * scale))
                            .set("fill", "none")
                            .set("stroke", pen.colour)
                            .set("stroke-width", pen.width)
                            .set("stroke-dasharray", pen.dashes),
                    )
                }
                Item::Text(at, text) => {
                    let [x, y] = place(*at);
                    let text = Text::new(text).set("x", x).set("y", y);
                    document.add(text.set("text-anchor", "middle"))
                }
            };
        }
        format!("{document}\n")
    }

    /// Compares the picture with a file of the documentation, or writes it when
    /// `FILPOST_UPDATE` is set.
    ///
    /// # Panics
    /// When the file differs or cannot be written.
    pub fn check(&self, file: &Path) {
        if std::env::var_os("FILPOST_UPDATE").is_some() {
            fs::create_dir_all(file.parent().expect("a folder")).expect("the folder is made");
            fs::write(file, self.svg()).expect("the picture is written");
        }
        let held = fs::read_to_string(file).unwrap_or_default();
        assert!(held == self.svg(), "{} is not what is drawn now", file.display());
    }

    /// Lowest and highest coordinates.
    fn extent(&self) -> ([f64; 2], [f64; 2]) {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        let mut take = |p: [f64; 2], radius: f64| {
            for axis in 0..2 {
                low[axis] = low[axis].min(p[axis] - radius);
                high[axis] = high[axis].max(p[axis] + radius);
            }
        };
        for item in &self.items {
            match item {
                Item::Line(points, ..) => points.iter().for_each(|p| take(*p, 0.0)),
                Item::Circle(center, radius, _) => take(*center, *radius),
                Item::Text(at, _) => take(*at, 0.0),
            }
        }
        (low, high)
    }
}

/// Hundredths of a pixel: fine enough to see, coarse enough to be the same on
/// every machine.
fn round(pixels: f64) -> f64 {
    (pixels * 100.0).round() / 100.0 + 0.0
}

fn stroke(points: impl Iterator<Item = [f64; 2]>, pen: &Pen, fill: Option<&str>) -> Stroke {
    let mut data = Data::new();
    for (index, [x, y]) in points.enumerate() {
        data = if index == 0 { data.move_to((x, y)) } else { data.line_to((x, y)) };
    }
    Stroke::new()
        .set("d", data)
        .set("fill", fill.unwrap_or("none"))
        .set("stroke", pen.colour)
        .set("stroke-width", pen.width)
        .set("stroke-dasharray", pen.dashes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn y_goes_up_and_the_drawing_fills_the_width() {
        let mut picture = Picture::default();
        picture.line(&[[0.0, 0.0], [10.0, 5.0]], Pen::full("black", 1.0));
        let svg = picture.svg();
        assert!(svg.contains("M30,360 L690,30"), "{svg}");
        assert!(svg.contains("viewBox=\"0 0 720 390\""), "{svg}");
    }
}
