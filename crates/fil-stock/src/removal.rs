//! One motion through a height field: what it removes, and what it touches.

use crate::field::HeightField;
use crate::tool::{Cylinder, Shape};
use crate::way::Way;

/// A tool may touch by so much, mm: the same surface by two ways differs by rounding, and by the
/// chords of arcs.
pub(crate) const SKIN: f64 = 0.01;

/// Where and how deep something is touched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    /// Most that is touched, mm; 0 where nothing is.
    pub depth: f64,
    /// Where that is: center of the cell, Z of the surface that touches.
    pub at: [f64; 3],
    /// The part of the way on which something is touched, mm.
    along: [f64; 2],
}

impl Contact {
    const NONE: Contact =
        Contact { depth: 0.0, at: [0.0; 3], along: [f64::INFINITY, f64::NEG_INFINITY] };

    /// True when something is touched.
    pub fn is_some(&self) -> bool {
        self.depth > 0.0
    }

    /// Length of the way from the first to the last place that is touched, mm.
    pub fn length(&self, way: &Way) -> f64 {
        if way.is_vertical() { self.depth } else { (self.along[1] - self.along[0]).max(0.0) }
    }

    fn add(&mut self, depth: f64, at: [f64; 3], way: &Way) {
        let along = way.along([at[0], at[1]]);
        self.along = [self.along[0].min(along), self.along[1].max(along)];
        if depth > self.depth {
            (self.depth, self.at) = (depth, at);
        }
    }
}

/// What is looked for while a tool cuts.
#[derive(Clone, Copy)]
pub(crate) struct Wanted<'p> {
    /// All that is touched by more than [`SKIN`].
    pub touch: bool,
    /// What is touched within this radius, mm; 0 for nothing.
    pub center: f64,
    /// Heights of the part, and by how much a cut may be below it, mm.
    pub part: Option<(&'p [f32], f64)>,
}

/// What a motion has removed.
pub(crate) struct Removed {
    /// mm³
    pub volume: f64,
    pub touch: Contact,
    pub center: Contact,
    pub part: Contact,
}

impl HeightField {
    /// Removes what a tool cuts on its way.
    pub(crate) fn cut(&mut self, way: &Way, shape: &Shape, wanted: Wanted<'_>) -> Removed {
        let mut removed = Removed {
            volume: 0.0,
            touch: Contact::NONE,
            center: Contact::NONE,
            part: Contact::NONE,
        };
        let inner = shape.inset(SKIN);
        let within_part = wanted.part.and_then(|(_, tolerance)| shape.inset(tolerance));
        let middle = Shape::Round { radius: wanted.center, corner: 0.0 };
        let area = self.grid().area();
        let lowest_tip = way.lowest_tip();
        self.near(way, shape.radius(), |field, cell, at| {
            let top = field.top(cell);
            let floor = field.floor(cell);
            if top <= lowest_tip || top <= floor {
                return;
            }
            let Some(surface) = way.lowest_below(shape, at, top) else { return };
            let left = surface.max(floor);
            if left >= top {
                return;
            }
            let depth = top - left;
            removed.volume += depth * area;
            let place = [at[0], at[1], surface];
            let reaches = |inner: &Option<(Shape, f64)>, height: f64| {
                inner.as_ref().is_some_and(|(inner, raised)| {
                    way.lowest(inner, at).is_some_and(|surface| surface + raised < height)
                })
            };
            if wanted.touch && reaches(&inner, top) {
                removed.touch.add(depth, place, way);
            }
            if wanted.center > 0.0 && depth > SKIN && way.lowest(&middle, at).is_some() {
                removed.center.add(depth, place, way);
            }
            if let Some((part, _)) = wanted.part {
                let part = f64::from(part[cell]);
                if surface < part && reaches(&within_part, part.min(top)) {
                    removed.part.add(part.min(top) - left, place, way);
                }
            }
            field.tops[cell] = left as f32;
        });
        removed
    }

    /// What a holder above a tool touches on its way; nothing of the stock changes.
    pub(crate) fn touched_by_holder(
        &mut self,
        way: &Way,
        holder: &[Cylinder],
        length: f64,
    ) -> Contact {
        let mut contact = Contact::NONE;
        let mut raised = length;
        for piece in holder {
            let shape = Shape::Round { radius: (piece.radius - SKIN).max(0.0), corner: 0.0 };
            let way = way.raised(raised + SKIN);
            let lowest = way.lowest_tip();
            self.near(&way, shape.radius(), |field, cell, at| {
                let top = field.top(cell);
                if top <= lowest || top <= field.floor(cell) {
                    return;
                }
                if let Some(surface) = way.lowest(&shape, at).filter(|surface| *surface < top) {
                    contact.add(top - surface + SKIN, [at[0], at[1], surface - SKIN], &way);
                }
            });
            raised += piece.length;
        }
        contact
    }

    /// Goes through the cells that a tool of a radius may touch on its way.
    fn near(&mut self, way: &Way, radius: f64, mut cell: impl FnMut(&mut Self, usize, [f64; 2])) {
        let grid = *self.grid();
        let [_, y] = way.bounds();
        for row in grid.range(1, [y[0] - radius, y[1] + radius]) {
            let [_, at] = grid.center(0, row);
            for column in grid.range(0, way.reach(at, radius)) {
                cell(self, row * grid.columns + column, grid.center(column, row));
            }
        }
    }
}
