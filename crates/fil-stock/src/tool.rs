//! Tools: cutting edges as solids of revolution, the length below the holder, the holder.

use std::collections::BTreeMap;

use fil_diag::Diag;

use crate::errors::StockCode;
use crate::turning::Insert;
use crate::units::split_unit;

/// Tools by their numbers in the program.
pub type Tools = BTreeMap<u32, Tool>;

/// The cutting part of a tool, as the height of its surface over its tip at each radius. Its body
/// goes up from there without end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Flat, bull-nose or ball: a corner radius of 0, between, or equal to the radius.
    Round {
        /// Radius, mm.
        radius: f64,
        /// Corner radius, mm, at most the radius.
        corner: f64,
    },
    /// A drill, a countersink, a chamfer mill.
    Cone {
        /// Radius, mm.
        radius: f64,
        /// Radius of the flat tip, mm.
        tip: f64,
        /// How much the cone rises in a mm of radius.
        rise: f64,
    },
}

impl Shape {
    /// The largest radius, mm.
    pub fn radius(&self) -> f64 {
        match *self {
            Shape::Round { radius, .. } | Shape::Cone { radius, .. } => radius,
        }
    }

    /// The radius up to which the tip is flat, mm.
    pub(crate) fn flat(&self) -> f64 {
        match *self {
            Shape::Round { radius, corner } => radius - corner,
            Shape::Cone { tip, .. } => tip,
        }
    }

    /// Height of the surface over the tip at a radius within that of the tool, mm.
    pub fn height(&self, at: f64) -> f64 {
        match *self {
            Shape::Round { radius, corner } => {
                let beyond = (at - (radius - corner)).max(0.0);
                corner - (corner * corner - beyond * beyond).max(0.0).sqrt()
            }
            Shape::Cone { tip, rise, .. } => (at - tip).max(0.0) * rise,
        }
    }

    /// The radius at a height over the tip, mm.
    pub(crate) fn radius_at(&self, height: f64) -> f64 {
        match *self {
            Shape::Round { radius, corner } => {
                let below = (corner - height).max(0.0);
                radius - corner + (corner * corner - below * below).max(0.0).sqrt()
            }
            Shape::Cone { radius, tip, rise } => (tip + height / rise).min(radius),
        }
    }

    /// How steeply the surface rises at a radius.
    pub(crate) fn slope(&self, at: f64) -> f64 {
        match *self {
            Shape::Round { radius, corner } => {
                let beyond = at - (radius - corner);
                if beyond <= 0.0 {
                    return 0.0;
                }
                beyond / (corner * corner - beyond * beyond).max(0.0).sqrt()
            }
            Shape::Cone { tip, rise, .. } => {
                if at > tip {
                    rise
                } else {
                    0.0
                }
            }
        }
    }

    /// The shape that lies within this one by a distance, and by how much its tip is higher; `None`
    /// where nothing is left.
    pub(crate) fn inset(&self, by: f64) -> Option<(Shape, f64)> {
        let left = self.radius() - by;
        if left <= 0.0 {
            return None;
        }
        Some(match *self {
            Shape::Round { corner, .. } => {
                (Shape::Round { radius: left, corner: (corner - by).max(0.0).min(left) }, by)
            }
            Shape::Cone { tip, rise, .. } => {
                let raised = by * libm::hypot(1.0, rise);
                (Shape::Cone { radius: left, tip: tip.min(left), rise }, raised)
            }
        })
    }
}

/// A piece of a holder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Radius, mm.
    pub radius: f64,
    /// Length along the tool, mm.
    pub length: f64,
}

/// What a tool cuts with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A tool that turns.
    Shape(Shape),
    /// A turning insert.
    Insert(Insert),
}

/// A tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// The part that cuts.
    pub body: Body,
    /// From the tip to the holder, mm, of an insert along X; `None` when not known.
    pub length: Option<f64>,
    /// The holder from below; empty when not known.
    pub holder: Vec<Cylinder>,
    /// Radius around the tip without teeth, mm; 0 for a tool that cuts at its center.
    pub toothless: f64,
}

impl Tool {
    /// A tool whose holder is not known.
    pub fn new(body: Body) -> Tool {
        Tool { body, length: None, holder: Vec::new(), toothless: 0.0 }
    }

    /// A tool from letters with numbers: `D` diameter, `R` corner radius, `A` point angle in
    /// degrees, `F` diameter of a flat tip under `A`, `L` length below the holder, `H` diameter and
    /// length of a piece of the holder (`H40x60`, from below, may be there again), `C` diameter
    /// without teeth around the center. A turning insert has `Q` instead, the direction of its tip
    /// (1 to 4), `R` nose radius, `W` width of a grooving insert, `A` angle between the trailing
    /// edge and Z (5 degrees), `S` length of that edge along Z (10 mm), `L` distance from the tip to
    /// the holder along X, `H` width along Z and length of the shank, of a boring bar (Q1, Q2) its
    /// thickness along X and its length. Lengths are mm, or inch with
    /// `in` at the end.
    ///
    /// # Errors
    /// E0965
    pub fn read(text: &str) -> Result<Tool, Box<Diag>> {
        let wrong = |what: String| StockCode::BadDescription.diag(format!("tool `{text}`: {what}"));
        let (body, unit) = split_unit(text);
        let mut given = Letters::default();
        for (letter, value) in letters(body).map_err(&wrong)? {
            given.take(letter, value, unit).map_err(&wrong)?;
        }
        given.tool().map_err(wrong)
    }
}

/// What the letters of a description give, mm and degrees.
#[derive(Default)]
struct Letters {
    /// By the letters D, R, A, F, L, C, Q, W, S.
    values: BTreeMap<char, f64>,
    holder: Vec<Cylinder>,
}

impl Letters {
    fn take(&mut self, letter: char, text: &str, unit: f64) -> Result<(), String> {
        let number = |text: &str| {
            let value: Option<f64> = text.parse().ok().filter(|value: &f64| value.is_finite());
            value
                .filter(|value| *value >= 0.0)
                .ok_or_else(|| format!("`{letter}{text}` has no number of 0 or more"))
        };
        match letter {
            'H' => {
                let (diameter, length) =
                    text.split_once(['x', 'X']).ok_or("a holder is diameter x length: H40x60")?;
                let (diameter, length) = (number(diameter)? * unit, number(length)? * unit);
                self.holder.push(Cylinder { radius: diameter / 2.0, length });
                Ok(())
            }
            'D' | 'R' | 'A' | 'F' | 'L' | 'C' | 'Q' | 'W' | 'S' => {
                let unit = if matches!(letter, 'A' | 'Q') { 1.0 } else { unit };
                match self.values.insert(letter, number(text)? * unit) {
                    None => Ok(()),
                    Some(_) => Err(format!("{letter} is given twice")),
                }
            }
            _ => Err(format!("{letter} is none of D, R, A, F, L, H, C, Q, W and S")),
        }
    }

    fn tool(self) -> Result<Tool, String> {
        let value = |letter: char| self.values.get(&letter).copied();
        if let Some(direction) = value('Q') {
            return self.insert(direction);
        }
        let diameter = value('D').filter(|diameter| *diameter > 0.0);
        let radius = diameter.ok_or("D, the diameter, is needed")? / 2.0;
        let shape = match (value('A'), value('R')) {
            (Some(_), Some(corner)) if corner > 0.0 => {
                return Err("a tool has a point angle (A) or a corner radius (R)".into());
            }
            (Some(angle), _) => cone(radius, value('F').unwrap_or(0.0) / 2.0, angle)?,
            (None, corner) => round(radius, corner.unwrap_or(0.0))?,
        };
        if !self.holder.is_empty() && value('L').is_none() {
            return Err("a holder (H) needs the tool length below it (L)".into());
        }
        let toothless = value('C').unwrap_or(0.0) / 2.0;
        let body = Body::Shape(shape);
        Ok(Tool { body, length: value('L'), holder: self.holder, toothless })
    }

    fn insert(self, direction: f64) -> Result<Tool, String> {
        let value = |letter: char| self.values.get(&letter).copied();
        let is_other = |letter: &&char| !"QRWASL".contains(**letter);
        if self.values.keys().find(is_other).is_some() {
            return Err("an insert (Q) has R, W, A, S, L and H".into());
        }
        if !self.holder.is_empty() && value('L').is_none() {
            return Err("a holder (H) needs the distance from the tip to it (L)".into());
        }
        let nose = value('R').unwrap_or(0.0);
        let number = if direction.fract() == 0.0 { direction as u32 } else { 0 };
        let insert = Insert::pointing(nose, number).ok_or("Q is 1, 2, 3 or 4")?;
        let insert = Insert {
            width: value('W'),
            trailing: value('A').unwrap_or(insert.trailing),
            edge: value('S').unwrap_or(insert.edge),
            ..insert
        };
        let is_narrow = insert.width.unwrap_or(insert.edge) < 2.0 * nose;
        if is_narrow || insert.trailing >= 90.0 {
            return Err("an insert is at least as wide as its nose, and A is below 90".into());
        }
        let length = value('L');
        Ok(Tool { length, holder: self.holder, ..Tool::new(Body::Insert(insert)) })
    }
}

fn round(radius: f64, corner: f64) -> Result<Shape, String> {
    // Half of a rounded diameter may be less than the corner radius of a ball.
    if corner > radius * 1.001 {
        return Err("the corner radius is larger than the radius".into());
    }
    Ok(Shape::Round { radius, corner: corner.min(radius) })
}

fn cone(radius: f64, tip: f64, angle: f64) -> Result<Shape, String> {
    if angle <= 0.0 || angle > 180.0 {
        return Err("a point angle is above 0 and at most 180 degrees".into());
    }
    if tip >= radius {
        return Err("the flat tip (F) is as wide as the tool".into());
    }
    if angle == 180.0 {
        return Ok(Shape::Round { radius, corner: 0.0 });
    }
    Ok(Shape::Cone { radius, tip, rise: 1.0 / libm::tan((angle / 2.0).to_radians()) })
}

/// Letters and the texts after them.
fn letters(text: &str) -> Result<Vec<(char, &str)>, String> {
    let mut rest = text.trim();
    let mut found = Vec::new();
    while let Some(letter) = rest.chars().next() {
        if !letter.is_ascii_alphabetic() {
            return Err(format!("a letter is missing before `{rest}`"));
        }
        let after = &rest[1..];
        let is_end = |next: char| {
            next.is_ascii_alphabetic() && !next.eq_ignore_ascii_case(&'x') || next == ' '
        };
        let end = after.find(is_end).unwrap_or(after.len());
        found.push((letter.to_ascii_uppercase(), after[..end].trim()));
        rest = after[end..].trim_start();
    }
    Ok(found)
}

/// A tool from the values of an APT CUTTER statement: d, r, e, f, α, β, h, of which the first alone
/// is needed. `unit` is the mm of a length; α is degrees.
///
/// # Errors
/// Why a tool of this shape can't be simulated.
pub fn from_cutter(values: &[f64], unit: f64) -> Result<Tool, String> {
    let value = |at: usize| values.get(at).copied().unwrap_or(0.0);
    let (tip_angle, side_angle) = (value(4), value(5));
    let point = (tip_angle != 0.0).then_some(180.0 - 2.0 * tip_angle);
    described([value(0) * unit, value(1) * unit, value(6) * unit], side_angle, point)
}

/// A tool from the values of TLDATA of a mill or drill (NX): diameter, corner radius, length, then
/// of a mill the angles of its side and its tip, of a drill its point angle. `unit` is the mm of a
/// length; angles are degrees.
///
/// # Errors
/// Why a tool of this shape can't be simulated.
pub fn from_tool_data(values: &[f64], unit: f64, drills: bool) -> Result<Tool, String> {
    let value = |at: usize| values.get(at).copied().unwrap_or(0.0);
    let sizes = [value(0) * unit, value(1) * unit, value(2) * unit];
    if drills {
        return described(sizes, 0.0, Some(value(3)));
    }
    let point = (value(4) != 0.0).then(|| 180.0 - 2.0 * value(4));
    described(sizes, value(3), point)
}

/// A tool of a diameter, a corner radius and a length, mm, with the angle of its side from its axis
/// and its point angle, degrees.
fn described(
    [diameter, corner, length]: [f64; 3],
    side: f64,
    point: Option<f64>,
) -> Result<Tool, String> {
    if diameter <= 0.0 {
        return Err("it has no diameter".into());
    }
    if side != 0.0 {
        return Err("its side is tapered".into());
    }
    let radius = diameter / 2.0;
    let shape = match point {
        None => round(radius, corner)?,
        Some(angle) if corner == 0.0 => cone(radius, 0.0, angle)?,
        Some(_) => return Err("it has both a corner radius and a point angle".into()),
    };
    let length = Some(length).filter(|length| *length > 0.0);
    Ok(Tool { length, ..Tool::new(Body::Shape(shape)) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shape(tool: &Tool) -> Shape {
        match tool.body {
            Body::Shape(shape) => shape,
            Body::Insert(insert) => panic!("{insert:?}"),
        }
    }

    #[test]
    fn inserts_are_read() {
        let tool = Tool::read("Q3R0.8A8").expect("an insert");
        let Body::Insert(insert) = tool.body else { panic!("{tool:?}") };
        assert_eq!((insert.nose, insert.along_x, insert.along_z), (0.8, -1.0, -1.0));
        assert_eq!((insert.width, insert.trailing), (None, 8.0));
        for text in ["Q5", "Q3D10", "Q3R2W3", "Q3A90", "Q3H10x10", "Q3C1"] {
            assert_eq!(Tool::read(text).expect_err(text).code.name(), "E0965", "{text}");
        }
    }

    #[test]
    fn descriptions_are_read() {
        let tool = Tool::read("D10R0.5L50H40x60H63x20").expect("a tool");
        assert_eq!(shape(&tool), Shape::Round { radius: 5.0, corner: 0.5 });
        assert_eq!(tool.length, Some(50.0));
        assert_eq!(tool.holder.len(), 2);
        let drill = Tool::read("d5 a118").expect("a tool");
        assert!((shape(&drill).height(2.5) - 1.502).abs() < 1e-3, "{drill:?}");
        let inch = Tool::read("D0.5in").expect("a tool");
        assert!((shape(&inch).radius() - 6.35).abs() < 1e-12);
    }

    #[test]
    fn wrong_descriptions_are_refused() {
        for text in [
            "",
            "R1",
            "D",
            "D0",
            "D10 D8",
            "D10 R6",
            "D10 A118 R1",
            "D10 H40x60",
            "D10 Q1",
            "10",
            "D10 H40 L5",
            "D10 A200",
        ] {
            let error = Tool::read(text).expect_err(text);
            assert_eq!(error.code.name(), "E0965", "{text}");
        }
    }

    #[test]
    fn cutter_statements_of_apt() {
        let drill = from_cutter(&[10.0, 0.0, 5.0, 3.0043, 31.0, 0.0, 130.0], 1.0).expect("a drill");
        assert!((shape(&drill).height(5.0) - 3.0043).abs() < 1e-3, "{drill:?}");
        let bull =
            from_cutter(&[10.0, 1.0, 4.0, 1.0, 0.0, 0.0, 73.0], 1.0).expect("a bull-nose mill");
        assert_eq!(shape(&bull), Shape::Round { radius: 5.0, corner: 1.0 });
        assert!(from_cutter(&[10.0, 0.0, 5.0, 0.0, 0.0, 8.0], 1.0).is_err());
        let drill = from_tool_data(&[8.0, 0.0, 120.0, 118.0, 35.0], 1.0, true).expect("a drill");
        assert!((shape(&drill).height(4.0) - 2.403).abs() < 1e-3, "{drill:?}");
    }

    pub(crate) fn shapes() -> impl Strategy<Value = Shape> {
        let round = (0.5..20.0f64, 0.0..=1.0f64)
            .prop_map(|(radius, share)| Shape::Round { radius, corner: radius * share });
        let cone = (0.5..20.0f64, 0.0..0.9f64, 0.1..3.0f64)
            .prop_map(|(radius, share, rise)| Shape::Cone { radius, tip: radius * share, rise });
        prop_oneof![round, cone]
    }

    proptest! {
        /// A surface rises outwards, ever more steeply: what the sweep relies on.
        #[test]
        fn shapes_are_convex(shape in shapes(), a in 0.0..1.0f64, b in 0.0..1.0f64) {
            let at = |share: f64| shape.height(share * shape.radius());
            let middle = at((a + b) / 2.0);
            prop_assert!(middle <= (at(a) + at(b)) / 2.0 + 1e-9);
            prop_assert!(at(a.max(b)) >= at(a.min(b)) - 1e-12);
        }

        /// What lies within a shape is above its surface everywhere.
        #[test]
        fn an_inset_lies_within(shape in shapes(), by in 0.0..0.4f64, at in 0.0..1.0f64) {
            let (inner, raised) = shape.inset(by).expect("the radius is larger");
            let at = at * inner.radius();
            prop_assert!(inner.height(at) + raised >= shape.height(at) + by * 0.999 - 1e-9);
        }
    }
}
