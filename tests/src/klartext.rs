//! The points of Heidenhain programs that a CAM system wrote beside its CL files, and of ours
//! for the same files: enough of the conversational format for them, and nothing that a post
//! of ours has a part in.

/// What a program does at a point; lengths in mm, in the frame of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A straight motion to a point.
    Line([f64; 3]),
    /// An arc in X and Y: its end, its center, counterclockwise.
    Arc([f64; 3], [f64; 2], bool),
    /// A hole at X and Y, and its depth.
    Hole([f64; 2], f64),
}

/// The steps of a program. Motions in the frame of the machine (M91), and those that clear the
/// tool before it is changed (`L Z 25.000`, with a blank), come from no CL statement. A
/// motion to where the tool is adds nothing.
///
/// # Errors
/// A line that this module can't read, by its text.
pub fn steps(text: &str) -> Result<Vec<Step>, String> {
    let mut found = Vec::new();
    let (mut at, mut center, mut depth) = ([f64::NAN; 3], [0.0; 2], 0.0);
    for line in text.lines() {
        let wrong = || format!("can't read `{line}`");
        if let Some(value) = line.trim_start().strip_prefix("Q201=") {
            let value = value.split_whitespace().next().unwrap_or_default();
            depth = -value.parse::<f64>().map_err(|_| wrong())?;
        }
        let words: Vec<&str> = line.split_whitespace().skip(1).collect();
        match words[..] {
            ["CYCL", "DEF", "1.2", word] => {
                let value: f64 = word.trim_start_matches("DEPTH").parse().map_err(|_| wrong())?;
                depth = -value;
            }
            ["CC", ref rest @ ..] => {
                for word in rest {
                    if let Some((axis, value)) = coordinate(word).filter(|(axis, _)| *axis < 2) {
                        center[axis] = value;
                    }
                }
            }
            ["L", ref rest @ ..] if !rest.contains(&"M91") && !rest.contains(&"Z") => {
                if take(rest, &mut at) {
                    found.push(Step::Line(at));
                }
                if rest.contains(&"M99") {
                    found.push(Step::Hole([at[0], at[1]], depth));
                }
            }
            ["C", ref rest @ ..] => {
                take(rest, &mut at);
                let ccw = match (rest.contains(&"DR+"), rest.contains(&"DR-")) {
                    (true, false) => true,
                    (false, true) => false,
                    _ => return Err(wrong()),
                };
                found.push(Step::Arc(at, center, ccw));
            }
            _ => {}
        }
    }
    Ok(found)
}

/// Moves to the coordinates that the words name; true when one of them is another.
fn take(words: &[&str], at: &mut [f64; 3]) -> bool {
    let mut has_moved = false;
    for (axis, value) in words.iter().filter_map(|word| coordinate(word)) {
        has_moved |= std::mem::replace(&mut at[axis], value) != value;
    }
    has_moved
}

/// `X+12.5`: the number of the axis and the value.
fn coordinate(word: &str) -> Option<(usize, f64)> {
    let axis = ["X", "Y", "Z"].iter().position(|letter| word.starts_with(letter))?;
    Some((axis, word[1..].parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_read() {
        let text = "1 BEGIN PGM 11 MM\n2 L Z-10 FMAX M91\n3 L X+1 Y+2 Z+3 FMAX M09\n4 CYCL DEF 1.2 \
                    DEPTH-4.5\n5 L FMAX M99\n6 L Z 25.000 FMAX\n7 CC X+1 Y+3\n8 C X+2 Y+3 DR+\n9 C DR-\n";
        let end = [2.0, 3.0, 3.0];
        assert_eq!(
            steps(text).unwrap(),
            [
                Step::Line([1.0, 2.0, 3.0]),
                Step::Hole([1.0, 2.0], 4.5),
                Step::Arc(end, [1.0, 3.0], true),
                Step::Arc(end, [1.0, 3.0], false),
            ]
        );
        assert!(steps("1 C X+1\n").is_err());
        let cycle = "1 CYCL DEF 200 DRILLING ~\n  Q200=+2 ;SET-UP ~\n  Q201=-4.5 ;DEPTH\n\
                     2 L X+1 Y+2 FMAX M99\n";
        let at = [1.0, 2.0];
        assert_eq!(steps(cycle).unwrap().last(), Some(&Step::Hole(at, 4.5)));
    }
}
