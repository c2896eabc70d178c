//! The path of a program as arrays for a view: an entry for each straight part of it.

use filpost::Error;
use filpost::nc::motion::{Rate, Speed};
use filpost::nc::plot::{InForce, Point, Stroke, Trace};
use filpost::plot::{self, Text};
use serde_json::{Value, json};

use crate::fields::Fields;
use crate::machine::MachineOf;
use crate::{Fault, Misuse, refused};

/// Answers with the arrays of the path of `nc` on the machine, each as base64 of little-endian
/// numbers; `docs/playground.md` has their meanings.
pub(crate) fn motions(mut fields: Fields) -> Result<Value, Misuse> {
    let machine = MachineOf::read(&mut fields)?;
    let nc = fields.needed("nc")?;
    fields.end()?;
    Ok(match arrays(&machine, &nc) {
        Ok(answer) => answer,
        Err(error) => refused(&Fault::Setup(error), &[]),
    })
}

fn arrays(machine: &MachineOf, nc: &str) -> Result<Value, Error> {
    let commons = machine.builder().build_machine()?;
    let encoded = filpost::tape_style::page(&commons).encode(nc);
    let bytes = encoded.as_deref().unwrap_or(nc.as_bytes());
    let drawing = plot::program(Text { name: "the program", bytes }, &commons)?;
    let mut arrays = Arrays::default();
    arrays.take(&drawing.path);
    Ok(arrays.answer(drawing.lathe))
}

/// The arrays in the making.
#[derive(Default)]
struct Arrays {
    kind: Vec<u8>,
    points: Vec<u8>,
    axis: Vec<u8>,
    tool: Vec<u8>,
    line: Vec<u8>,
    feed: Vec<u8>,
    jump: Vec<u8>,
    start: Vec<u8>,
    last: Option<Point>,
    tilts: bool,
}

impl Arrays {
    fn take(&mut self, path: &Trace) {
        self.tilts = !path.axes.is_empty();
        let (mut force, mut axes) = (path.in_force.iter().peekable(), path.axes.iter().peekable());
        let (mut now, mut axis) = (None, [0.0, 0.0, 1.0]);
        for (index, piece) in path.pieces.iter().enumerate() {
            while let Some(next) = force.next_if(|next| next.from <= index) {
                now = Some(next);
            }
            while let Some((_, next)) = axes.next_if(|(from, _)| *from <= index) {
                axis = *next;
            }
            let Some(points) = path.points.get(piece.range()) else { continue };
            self.begin(points[0], piece.line, now, axis);
            for to in &points[1..] {
                self.add(*to, piece.stroke, false, (piece.line, now, axis));
            }
        }
    }

    /// Begins a piece: where it does not begin at the end of the one before, the way there is not
    /// known.
    fn begin(&mut self, at: Point, line: u32, now: Option<&InForce>, axis: Point) {
        match self.last {
            None => {
                push(&mut self.start, at);
                self.last = Some(at);
            }
            Some(last) if last != at => self.add(at, Stroke::Rapid, true, (line, now, axis)),
            Some(_) => {}
        }
    }

    fn add(
        &mut self,
        to: Point,
        stroke: Stroke,
        jump: bool,
        (line, now, axis): (u32, Option<&InForce>, Point),
    ) {
        self.kind.push(match stroke {
            Stroke::Rapid => 0,
            Stroke::Feed => 1,
            Stroke::Arc => 2,
            Stroke::Thread => 3,
        });
        push(&mut self.points, to);
        if self.tilts {
            push(&mut self.axis, axis);
        }
        let tool = now.map_or(0, |now| now.tool);
        self.tool.extend(u16::try_from(tool).unwrap_or(u16::MAX).to_le_bytes());
        self.line.extend(line.to_le_bytes());
        let feed = if stroke == Stroke::Rapid { 0.0 } else { now.map_or(0.0, feed) };
        self.feed.extend((feed as f32).to_le_bytes());
        self.jump.push(jump.into());
        self.last = Some(to);
    }

    fn answer(&self, lathe: bool) -> Value {
        json!({
            "count": self.kind.len(),
            "kind": base64(&self.kind),
            "points": base64(&self.points),
            "axis": base64(&self.axis),
            "tool": base64(&self.tool),
            "line": base64(&self.line),
            "feed": base64(&self.feed),
            "jump": base64(&self.jump),
            "start": base64(&self.start),
            "lathe": lathe,
        })
    }
}

fn push(array: &mut Vec<u8>, point: Point) {
    for value in point {
        array.extend((value as f32).to_le_bytes());
    }
}

/// Feed in mm/min; 0 where it is not known.
fn feed(now: &InForce) -> f64 {
    match (now.feed, now.speed.and_then(Speed::turns)) {
        (Some(Rate::PerMinute(feed)), _) => feed,
        (Some(Rate::PerTurn(feed) | Rate::Varying(feed, _)), Some(turns)) => feed * turns,
        _ => 0.0,
    }
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |at: usize| u32::from(three.get(at).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for at in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * at) & 63) as usize];
            text.push(if at <= three.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::base64;

    #[test]
    fn base64_is_that_of_others() {
        let known =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg==")];
        for (text, expected) in known {
            assert_eq!(base64(text.as_bytes()), expected);
        }
        assert_eq!(base64(&[0xfb, 0xff, 0xbf]), "+/+/");
    }
}
