//! The tool path of an NC program, from the interpreter's canonical calls.

use crate::path::{Action, Arc, Axis, Point, Step, ToolPath, Unit};
use crate::rs274::{Call, Canon, words};

/// G words that send an axis to a fixed point of the machine.
const TO_REFERENCE: [u32; 3] = [28, 30, 53];

/// State of the interpreter that a motion needs.
struct State {
    point: Point,
    plane: Axis,
    rate: f64,
    per_minute: bool,
    synchronised: bool,
    tool: u32,
}

/// The path of an NC program; motions without length are left out, arcs kept.
///
/// # Errors
/// What this comparison has no means for: rotary motion, a unit changed on the
/// way, curves and probing.
pub fn nc_path(calls: &[Call], nc: &str) -> Result<ToolPath, String> {
    let lines: Vec<&str> = nc.lines().collect();
    let mut path = ToolPath { unit: Some(Unit::Mm), steps: Vec::new() };
    let mut state = State {
        point: [0.0; 3],
        plane: Axis::Z,
        rate: 0.0,
        per_minute: true,
        synchronised: false,
        tool: 0,
    };
    for call in calls {
        let line = call.line.unwrap_or(0);
        let block = lines.get(line.wrapping_sub(1) as usize).copied().unwrap_or("");
        let steps = state
            .take(&call.canon, block, &mut path)
            .map_err(|reason| format!("NC line {line}: {reason}"))?;
        path.steps.extend(steps.into_iter().map(|action| Step { line, action }));
    }
    Ok(path)
}

impl State {
    fn take(
        &mut self,
        canon: &Canon,
        block: &str,
        path: &mut ToolPath,
    ) -> Result<Vec<Action>, String> {
        let actions = match canon {
            Canon::Traverse(to) => {
                let to = linear(to)?;
                let in_machine = words(block, 'G').iter().any(|g| TO_REFERENCE.contains(g));
                vec![if in_machine { Action::Reference(to) } else { Action::Rapid(to) }]
            }
            Canon::Feed(to) => vec![Action::Feed(linear(to)?, self.rate())],
            Canon::Arc { .. } => vec![Action::Arc(self.arc(canon)?, self.rate())],
            Canon::Tap(to) => vec![Action::Feed(*to, None), Action::Feed(self.point, None)],
            Canon::ChangeTool => vec![Action::Tool(self.tool)],
            _ => {
                self.note(canon, path)?;
                vec![]
            }
        };
        Ok(actions.into_iter().filter(|action| self.goes(action)).collect())
    }

    /// Takes up what a call sets.
    fn note(&mut self, canon: &Canon, path: &mut ToolPath) -> Result<(), String> {
        match canon {
            Canon::Units(unit) if path.unit != Some(*unit) && !path.steps.is_empty() => {
                return Err("the unit of length changes on the way".to_string());
            }
            Canon::Units(unit) => path.unit = Some(*unit),
            Canon::Plane(normal) => self.plane = *normal,
            Canon::FeedRate(rate) => self.rate = *rate,
            Canon::PerMinute(on) => self.per_minute = *on,
            Canon::Synchronised(on) => self.synchronised = *on,
            Canon::SelectTool(tool) => self.tool = *tool,
            Canon::Other(name) if name.starts_with("NURBS") || name.contains("PROBE") => {
                return Err(format!("{name} is not compared"));
            }
            _ => {}
        }
        Ok(())
    }

    fn rate(&self) -> Option<f64> {
        (self.per_minute && !self.synchronised).then_some(self.rate)
    }

    fn arc(&self, canon: &Canon) -> Result<Arc, String> {
        let Canon::Arc { end, center, turns, height, rotary } = canon else {
            return Err("not an arc".to_string());
        };
        stands(rotary)?;
        let on_plane = |pair: &[f64; 2]| {
            let mut point = [*height; 3];
            for (axis, value) in self.plane.plane().into_iter().zip(pair) {
                point[axis] = *value;
            }
            point
        };
        Ok(Arc {
            to: on_plane(end),
            center: on_plane(center),
            normal: self.plane,
            ccw: *turns > 0,
            turns: turns.unsigned_abs(),
        })
    }

    /// Moves to the end of an action; false when it does not move at all.
    fn goes(&mut self, action: &Action) -> bool {
        let Some(end) = action.end() else { return true };
        let moves = end != self.point || matches!(action, Action::Arc(..));
        self.point = end;
        moves
    }
}

fn linear(to: &[f64; 6]) -> Result<Point, String> {
    let [x, y, z, a, b, c] = *to;
    stands(&[a, b, c])?;
    Ok([x, y, z])
}

fn stands(rotary: &[f64; 3]) -> Result<(), String> {
    if rotary.iter().all(|angle| *angle == 0.0) {
        Ok(())
    } else {
        Err("rotary axes are not compared".to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(line: u32, canon: Canon) -> Call {
        Call { line: Some(line), canon }
    }

    #[test]
    fn arcs_of_each_plane_have_their_axes() {
        let arc = Canon::Arc {
            end: [1.0, 2.0],
            center: [3.0, 4.0],
            turns: -1,
            height: 5.0,
            rotary: [0.0; 3],
        };
        for (normal, to) in
            [(Axis::Z, [1.0, 2.0, 5.0]), (Axis::Y, [2.0, 5.0, 1.0]), (Axis::X, [5.0, 1.0, 2.0])]
        {
            let calls = [call(1, Canon::Plane(normal)), call(2, arc.clone())];
            let path = nc_path(&calls, "").unwrap();
            assert!(
                matches!(path.steps[0].action, Action::Arc(arc, _) if arc.to == to && !arc.ccw)
            );
        }
    }

    #[test]
    fn the_way_to_a_machine_point_is_told_apart() {
        let up = Canon::Traverse([0.0, 0.0, 9.0, 0.0, 0.0, 0.0]);
        let down = Canon::Traverse([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        let path = nc_path(&[call(1, up), call(2, down.clone()), call(2, down)], "G53 G0 Z9\nG0Z1");
        let expect = [
            Step { line: 1, action: Action::Reference([0.0, 0.0, 9.0]) },
            Step { line: 2, action: Action::Rapid([0.0, 0.0, 1.0]) },
        ];
        assert_eq!(path.unwrap().steps, expect);
    }

    #[test]
    fn rotary_motion_is_refused() {
        let turned = Canon::Feed([0.0, 0.0, 0.0, 5.0, 0.0, 0.0]);
        assert!(nc_path(&[call(1, turned)], "").is_err());
    }
}
