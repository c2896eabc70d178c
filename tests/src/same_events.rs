//! Whether two programs make a machine do the same.

use fil_nc::forward::Forward;
use fil_nc::motion::{Arc, Event, Modes, Move, Position, Rate, Unsaid};

/// How far two ways may lie apart that are one: twice the last digit of a program in mm,
/// once for the rounded end of a part of an arc and once for the center it gives.
const APART: f64 = 0.002;

/// True when a program does what another one does: in the same modes the same motions, whatever
/// their lines, and the same arcs, however they are divided.
pub fn same(one: &[Event], other: &[Event]) -> bool {
    let [one, other] = [one, other].map(|events| joined(bare(events)));
    one.len() == other.len()
        && one.iter().zip(&other).all(|(one, other)| alike(&said_again(one, other), other))
}

/// Least turn of the tool that counts, degrees: the last digits of two axes, where they stand at
/// an angle to each other.
const TURNED: f64 = 0.01;

/// True when two programs differ only in motions that end, on the part, within a rounding: the tip
/// as `APART` says, the tool as `TURNED`. A table that turns about the tool moves neither:
/// `R(c) p = p` for a point p of its axis, and `R(c) a = a` for a tool along it.
pub fn near_poses(one: &[Event], other: &[Event], forward: &Forward) -> bool {
    let near = |(one, other): (&Event, &Event)| match (one, other) {
        (Event::Move(found), Event::Move(wanted)) => {
            let [a, b] = [found, wanted].map(|motion| forward.pose(&motion.to));
            let turned = (a.axis - b.axis).norm().to_degrees();
            (a.tip - b.tip).norm() < APART && turned < TURNED && found.course == wanted.course
        }
        (one, other) => one == other,
    };
    one.len() == other.len() && one.iter().zip(other).all(near)
}

/// The event, in which what is on may have been switched on once more behind a stop.
fn said_again(event: &Event, other: &Event) -> Event {
    let both = |modes: Modes, other: &Modes| Modes {
        unsaid: Unsaid {
            spindle: modes.unsaid.spindle || other.unsaid.spindle,
            coolant: modes.unsaid.coolant || other.unsaid.coolant,
        },
        ..modes
    };
    match (*event, other) {
        (Event::Move(found), Event::Move(other)) => {
            Event::Move(Move { modes: both(found.modes, &other.modes), ..found })
        }
        (Event::ToolChange { line, tool, modes }, Event::ToolChange { modes: other, .. }) => {
            Event::ToolChange { line, tool, modes: both(modes, other) }
        }
        (Event::End { line, code, modes }, Event::End { modes: other, .. }) => {
            Event::End { line, code, modes: both(modes, other) }
        }
        (event, _) => event,
    }
}

/// What the machine does, without the lines that make it and without motions that go
/// nowhere: what is in force there is in force at the next event too, or of no account.
fn bare(events: &[Event]) -> Vec<Event> {
    // The unit is how lengths are written, and no mode of the machine.
    let plain = |modes: Modes| Modes { inch: false, ..modes };
    let mut before: Option<Move> = None;
    let mut bare = Vec::new();
    for event in events {
        bare.push(match *event {
            Event::Move(found) => {
                let still = before.is_some_and(|old| goes_nowhere(&old, &found));
                let rate = before.and_then(|old| per_minute(&old, &found)).or(found.rate);
                before = Some(found);
                if still {
                    continue;
                }
                let modes = plain(found.modes);
                Event::Move(Move { line: 0, in_cycle: false, rate, modes, ..found })
            }
            Event::ToolChange { tool, modes, .. } => {
                Event::ToolChange { line: 0, tool, modes: plain(modes) }
            }
            Event::Dwell { seconds, turns, .. } => Event::Dwell { line: 0, seconds, turns },
            Event::Auxiliary { code, .. } => Event::Auxiliary { line: 0, code },
            Event::LeftToControl { mode, .. } => Event::LeftToControl { line: 0, mode },
            Event::ToolMeasured { .. } => Event::ToolMeasured { line: 0 },
            Event::End { code, modes, .. } => Event::End { line: 0, code, modes: plain(modes) },
        });
    }
    bare
}

fn goes_nowhere(before: &Move, found: &Move) -> bool {
    let to = Position { transformed: before.to.transformed, ..found.to };
    found.arc.is_none() && to == before.to && found.known == before.known
}

/// The feed of a straight line of three axes in inverse time, mm/min.
fn per_minute(before: &Move, found: &Move) -> Option<Rate> {
    let Some(Rate::Inverse(inverse)) = found.rate else { return None };
    let straight = found.arc.is_none()
        && found.to.rotary == before.to.rotary
        && found.to.tip_control == before.to.tip_control;
    let squares = (0..3).map(|n| (found.to.linear[n] - before.to.linear[n]).powi(2));
    straight.then(|| Rate::PerMinute(inverse * squares.sum::<f64>().sqrt()))
}

/// The events with the parts of one arc in one.
fn joined(events: Vec<Event>) -> Vec<Event> {
    let mut joined: Vec<Event> = Vec::new();
    for event in events {
        if let (Some(Event::Move(before)), Event::Move(found)) = (joined.last_mut(), &event)
            && let (Some(arc), Some(part)) = (&mut before.arc, &found.arc)
            && arc.normal == part.normal
            && arc.ccw == part.ccw
            && near(arc.center, part.center)
            && before.to.linear[arc.normal] == found.to.linear[arc.normal]
            && (Move { to: found.to, arc: found.arc, ..*before }) == *found
        {
            arc.angle += part.angle;
            before.to = found.to;
            continue;
        }
        joined.push(event);
    }
    joined
}

fn near(one: [f64; 3], other: [f64; 3]) -> bool {
    (0..3).all(|n| (one[n] - other[n]).abs() <= APART)
}

/// The same event, where an arc may have been divided elsewhere.
fn alike(one: &Event, other: &Event) -> bool {
    let (Event::Move(one), Event::Move(other)) = (one, other) else { return one == other };
    let (Some(arc), Some(found)) = (&one.arc, &other.arc) else { return one == other };
    Move { arc: None, ..*one } == Move { arc: None, ..*other } && same_arc(arc, found, one)
}

/// Two arcs to one end, whose centers and lengths are the same: a center that is moved
/// turns both spokes, so the length changes by twice that.
fn same_arc(one: &Arc, other: &Arc, made: &Move) -> bool {
    let [first, second] = one.plane().map(|n| made.to.linear[n] - one.center[n]);
    let length = (one.angle - other.angle).abs().to_radians() * first.hypot(second);
    one.normal == other.normal
        && one.ccw == other.ccw
        && near(one.center, other.center)
        && length <= 2.0 * APART
}

#[cfg(test)]
mod tests {
    use fil_machine::Commons;

    use super::*;
    use crate::back_check;

    fn are_same(one: &str, other: &str) -> bool {
        let post = filpost::Program::builder().generic("fanuc-mill").build().expect("a post");
        let commons: &Commons = post.commons();
        let events = |nc: &str| {
            back_check::events(
                commons,
                &format!("%\nO1\nG21 G90 G94 G17 G0 X10. Y0. Z0.\n{nc}M30\n%\n"),
            )
            .expect("a program")
        };
        same(&events(one), &events(other))
    }

    #[test]
    fn an_arc_may_be_divided_elsewhere() {
        let whole = "G3 X-10. Y0. I-10. J0. F100.\n";
        assert!(are_same(whole, "G3 X0. Y10. I-10. J0. F100.\nG3 X-10. Y0. I0. J-10.\n"));
        assert!(are_same(whole, "G3 X6. Y8. I-10. J0. F100.\nG3 X-10. Y0. I-6. J-8.\n"));
        assert!(!are_same(whole, "G3 X0. Y10. I-10. J0. F100.\nG3 X-10. Y0. I0. J-10. F90.\n"));
        assert!(!are_same(whole, "G3 X-10. Y0. I-10. J0.01 F100.\n"));
        assert!(!are_same(whole, "G2 X-10. Y0. I-10. J0. F100.\n"));
    }

    #[test]
    fn a_motion_to_where_the_machine_stands_is_none() {
        assert!(are_same("G1 X20. F100.\nX20.\nX30.\n", "G1 X20. F100.\nX30.\n"));
        assert!(!are_same("G1 X20. F100.\nX20.001\nX30.\n", "G1 X20. F100.\nX30.\n"));
    }

    #[test]
    fn inverse_time_is_a_feed() {
        assert!(are_same("G1 X12. F100.\n", "G93 G1 X12. F50.\nG94\n"));
        assert!(!are_same("G1 X12. F100.\n", "G93 G1 X12. F51.\nG94\n"));
    }
}
