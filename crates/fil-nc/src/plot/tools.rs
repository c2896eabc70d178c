//! The shape of tools, as CL files give it.

use fil_cl::words as w;
use fil_cl::{Reader, Record, Vocabulary};
use fil_diag::Diag;
use fil_machine::Unit;

/// The shape of a tool, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolShape {
    /// Its number.
    pub number: u32,
    /// Diameter.
    pub diameter: f64,
    /// Corner radius: 0 of a flat end mill, half the diameter of a ball.
    pub corner: f64,
    /// Angle of the bottom to a plane square to the axis, degrees: 31 of a drill with a point of
    /// 118, 0 of a mill.
    pub bottom: f64,
    /// Length of the cutting part, where the file gives it.
    pub length: Option<f64>,
}

/// The tools whose shape a CL file gives, by CUTTER, `$$-> CUTTER` or TLDATA before or after
/// the tool change; the last shape of a tool counts. `unit` is that of a file that does not give
/// one itself.
///
/// # Errors
/// What the CL reader refuses.
pub fn cl_tools(mut cl: Reader<'_>, unit: Option<Unit>) -> Result<Vec<ToolShape>, Box<Diag>> {
    let mut tools = Tools { unit: unit.map_or(1.0, Unit::in_mm), ..Tools::default() };
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    while cl.read(&mut vocabulary, &mut record)? {
        tools.take(&record);
    }
    Ok(tools.known)
}

#[derive(Default)]
struct Tools {
    known: Vec<ToolShape>,
    /// Length of a unit, mm.
    unit: f64,
    /// The tool in use.
    number: Option<u32>,
    /// A shape that no motion has used yet: it may be that of the next tool.
    fresh: Option<ToolShape>,
}

impl Tools {
    fn take(&mut self, record: &Record) {
        if record.major == w::UNITS {
            self.unit = if record.has(w::INCHES) { Unit::Inch } else { Unit::Mm }.in_mm();
        } else if let Some(diameter) = record.tool_diameter().filter(|diameter| *diameter > 0.0) {
            self.describe(record, diameter);
        } else if matches!(record.major, w::LOADTL | w::TURRET) {
            self.change(record);
        } else if record.point().is_some() {
            self.fresh = None;
        }
    }

    fn describe(&mut self, record: &Record, diameter: f64) {
        let diameter = diameter * self.unit;
        // NX gives a diameter alone after the record that has all measures.
        let before = self.fresh.filter(|before| before.diameter == diameter);
        let corner = record.tool_corner().map(|corner| corner * self.unit);
        let corner = corner.or(before.map(|before| before.corner)).unwrap_or(0.0);
        let bottom = record.tool_bottom_angle().or(before.map(|before| before.bottom));
        let length = record.tool_length().filter(|length| *length > 0.0);
        let shape = ToolShape {
            number: 0,
            diameter,
            corner: corner.clamp(0.0, diameter / 2.0),
            bottom: bottom.unwrap_or(0.0).clamp(0.0, 80.0),
            length: length
                .map(|length| length * self.unit)
                .or(before.and_then(|before| before.length)),
        };
        self.fresh = Some(shape);
        if let Some(number) = self.number {
            self.know(ToolShape { number, ..shape });
        }
    }

    fn change(&mut self, record: &Record) {
        let number = record.first_number();
        let whole = number.filter(|number| (0.0..=u32::MAX.into()).contains(number));
        self.number = whole.map(|number| number as u32);
        if let (Some(number), Some(shape)) = (self.number, self.fresh.take()) {
            self.know(ToolShape { number, ..shape });
        }
    }

    fn know(&mut self, shape: ToolShape) {
        match self.known.iter_mut().find(|known| known.number == shape.number) {
            Some(known) => *known = shape,
            None => self.known.push(shape),
        }
    }
}
