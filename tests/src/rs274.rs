//! LinuxCNC's stand-alone interpreter `rs274` as a judge of NC programs.
//!
//! It is an external program (`.ci/install-rs274` unpacks it). It interprets the
//! whole program, with cycles and modal state, and prints canonical calls; its
//! values have four decimals.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

use crate::path::{Axis, Point, Unit};

/// A canonical call and the NC line that made it.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// Line of the NC program, 1-based; `None` for what the interpreter does by itself.
    pub line: Option<u32>,
    /// The call.
    pub canon: Canon,
}

/// The canonical calls that matter to a tool path, values in the active unit.
#[derive(Clone, Debug, PartialEq)]
pub enum Canon {
    /// STRAIGHT_TRAVERSE: X Y Z A B C.
    Traverse([f64; 6]),
    /// STRAIGHT_FEED: X Y Z A B C.
    Feed([f64; 6]),
    /// ARC_FEED in the active plane.
    Arc {
        /// End point on the plane's two axes.
        end: [f64; 2],
        /// Center on the plane's two axes.
        center: [f64; 2],
        /// Turns begun, positive for counterclockwise.
        turns: i32,
        /// End point along the plane's normal.
        height: f64,
        /// A B C at the end.
        rotary: [f64; 3],
    },
    /// RIGID_TAP: to this point and back.
    Tap(Point),
    /// SELECT_PLANE, by the plane's normal.
    Plane(Axis),
    /// USE_LENGTH_UNITS.
    Units(Unit),
    /// SET_FEED_RATE.
    FeedRate(f64),
    /// SET_FEED_MODE: true for units a minute, false for units a revolution.
    PerMinute(bool),
    /// START_SPEED_FEED_SYNC and its end: the spindle leads the feed.
    Synchronised(bool),
    /// DWELL in seconds.
    Dwell(f64),
    /// SELECT_TOOL: number of the tool that the next change takes.
    SelectTool(u32),
    /// SET_SPINDLE_SPEED.
    SpindleSpeed(f64),
    /// START_SPINDLE_…: true for counterclockwise.
    SpindleOn(bool),
    /// STOP_SPINDLE_TURNING.
    SpindleOff,
    /// FLOOD_ON and FLOOD_OFF.
    Flood(bool),
    /// MIST_ON and MIST_OFF.
    Mist(bool),
    /// PROGRAM_STOP.
    Stop,
    /// OPTIONAL_PROGRAM_STOP.
    OptionalStop,
    /// COMMENT, without its quotes.
    Comment(String),
    /// CHANGE_TOOL; its own argument is a place in the tool table, not the tool.
    ChangeTool,
    /// Any other call, by name.
    Other(String),
}

/// The interpreter as [`installed`]; where it is absent, the reason is printed.
pub fn program() -> Option<PathBuf> {
    let found = installed();
    if found.is_none() {
        println!("skipped: no rs274 (.ci/install-rs274 unpacks it)");
    }
    found
}

/// The interpreter: `FILPOST_RS274`, else on the PATH, else where
/// `.ci/install-rs274` unpacks it.
pub fn installed() -> Option<PathBuf> {
    if let Some(named) = env::var_os("FILPOST_RS274") {
        return Some(PathBuf::from(named));
    }
    let search = env::var_os("PATH").unwrap_or_default();
    let unpacked = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/tools/linuxcnc/rs274");
    let mut places = env::split_paths(&search).map(|folder| folder.join("rs274"));
    places.find(|file| file.is_file()).or(Some(unpacked).filter(|file| file.is_file()))
}

/// Runs an NC program with a fresh variable file and a table of its tools.
///
/// The program is run twice: as it is, which decides whether it is accepted, and
/// with the number of its line as N word of each block, which tells the lines.
///
/// # Errors
/// What the interpreter says against the program, or why it could not be run.
pub fn run(program: &Path, nc: &str) -> Result<Vec<Call>, String> {
    interpret(program, nc)?;
    let tools = tool_table(nc, &['T']);
    parse(&interpret_with(program, &with_line_numbers(nc), &tools)?)
}

/// Runs a program once and gives the text of its canonical calls; every T, D and H is in
/// the tool table.
///
/// # Errors
/// As [`run`].
pub fn interpret(program: &Path, nc: &str) -> Result<String, String> {
    interpret_with(program, nc, &tool_table(nc, &['T', 'D', 'H']))
}

fn interpret_with(program: &Path, nc: &str, tools: &str) -> Result<String, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", program.display());
    let folder = tempfile::tempdir().map_err(failed)?;
    let file = |name: &str| folder.path().join(name);
    fs::write(file("in.ngc"), nc).map_err(failed)?;
    fs::write(file("tools.tbl"), tools).map_err(failed)?;
    let output = Command::new(program)
        .current_dir(folder.path())
        // The interpreter keeps its tools in a file of the home folder: runs side by
        // side would share it.
        .env("HOME", folder.path())
        .args(["-t", "tools.tbl", "-v", "fresh.var", "-n", "2", "-g", "in.ngc", "out.txt"])
        .stdin(Stdio::null())
        .output()
        .map_err(failed)?;
    let said = String::from_utf8_lossy(&output.stderr);
    let own_talk = |line: &&str| !line.starts_with("executing") && !line.starts_with("link (");
    let complaint: Vec<&str> = said.lines().filter(own_talk).collect();
    if output.status.success() && complaint.is_empty() {
        fs::read_to_string(file("out.txt")).map_err(failed)
    } else if complaint.is_empty() {
        Err(format!("rs274 ended with {}", output.status))
    } else {
        Err(complaint.join("; "))
    }
}

/// A tool table with the numbers behind these letters, of no length and diameter.
fn tool_table(nc: &str, letters: &[char]) -> String {
    let called = |line| letters.iter().flat_map(move |letter| words(line, *letter));
    let tools: BTreeSet<u32> = nc.lines().flat_map(called).filter(|tool| *tool > 0).collect();
    tools.iter().map(|tool| format!("T{tool} P{tool} D0 Z0\n")).collect()
}

/// The whole numbers that follow a letter in a block, comments left out.
pub(crate) fn words(line: &str, letter: char) -> Vec<u32> {
    let mut code = String::new();
    let mut in_comment = false;
    for character in line.chars() {
        match character {
            '(' => in_comment = true,
            ')' => in_comment = false,
            ';' if !in_comment => break,
            _ if in_comment || character.is_whitespace() => {}
            _ => code.push(character.to_ascii_uppercase()),
        }
    }
    let number = |rest: &str| {
        let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        rest[..end].parse().ok()
    };
    code.split(letter).skip(1).filter_map(number).collect()
}

/// The program with the number of its line as N word of each block.
fn with_line_numbers(nc: &str) -> String {
    let mut numbered = String::with_capacity(nc.len() * 2);
    for (index, line) in nc.lines().enumerate() {
        let block = line.trim();
        if block.is_empty() || block.starts_with(['%', 'O', 'o']) {
            numbered.push_str(block);
        } else {
            let (skip, rest) = match block.strip_prefix('/') {
                Some(rest) => ("/", rest),
                None => ("", block),
            };
            let plain = match rest.strip_prefix(['N', 'n']) {
                Some(rest) => rest.trim_start().trim_start_matches(|c: char| c.is_ascii_digit()),
                None => rest,
            };
            numbered.push_str(&format!("{skip}N{} {plain}", index + 1));
        }
        numbered.push('\n');
    }
    numbered
}

/// Reads the output of rs274: `count N_word NAME(arguments)` in each line.
///
/// # Errors
/// A line that has not this form.
pub fn parse(output: &str) -> Result<Vec<Call>, String> {
    let lines = output.lines().filter(|line| !line.trim().is_empty());
    lines.map(|line| call(line).ok_or(format!("rs274 wrote: {line}"))).collect()
}

fn call(line: &str) -> Option<Call> {
    let (_, rest) = line.trim_start().split_once(' ')?;
    let rest = rest.trim_start().strip_prefix('N')?;
    let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
    let (name, arguments) = rest[end..].trim_start().split_once('(')?;
    let arguments = arguments.rsplit_once(')')?.0;
    Some(Call { line: rest[..end].parse().ok(), canon: canon(name, arguments)? })
}

fn canon(name: &str, arguments: &str) -> Option<Canon> {
    let numbers = || -> Option<Vec<f64>> {
        arguments.split([',', ' ']).filter(|s| !s.is_empty()).map(|s| s.parse().ok()).collect()
    };
    let number = |index: usize| numbers()?.get(index).copied();
    Some(match name {
        "STRAIGHT_TRAVERSE" => Canon::Traverse(numbers()?.try_into().ok()?),
        "STRAIGHT_FEED" => Canon::Feed(numbers()?.try_into().ok()?),
        "ARC_FEED" => {
            let [e1, e2, c1, c2, turns, height, a, b, c] = numbers()?.try_into().ok()?;
            let (end, center, rotary) = ([e1, e2], [c1, c2], [a, b, c]);
            Canon::Arc { end, center, turns: turns as i32, height, rotary }
        }
        "RIGID_TAP" => Canon::Tap(numbers()?.try_into().ok()?),
        "SELECT_PLANE" => Canon::Plane(match arguments {
            "CANON_PLANE_XY" => Axis::Z,
            "CANON_PLANE_XZ" => Axis::Y,
            "CANON_PLANE_YZ" => Axis::X,
            _ => return None,
        }),
        "USE_LENGTH_UNITS" => Canon::Units(match arguments {
            "CANON_UNITS_MM" => Unit::Mm,
            "CANON_UNITS_INCHES" => Unit::Inch,
            _ => return None,
        }),
        "SET_FEED_RATE" => Canon::FeedRate(number(0)?),
        "SET_FEED_MODE" => Canon::PerMinute(number(1)? == 0.0),
        "START_SPEED_FEED_SYNC" => Canon::Synchronised(true),
        "STOP_SPEED_FEED_SYNCH" => Canon::Synchronised(false),
        "DWELL" => Canon::Dwell(number(0)?),
        "SET_SPINDLE_SPEED" => Canon::SpindleSpeed(number(1)?),
        "START_SPINDLE_CLOCKWISE" => Canon::SpindleOn(false),
        "START_SPINDLE_COUNTERCLOCKWISE" => Canon::SpindleOn(true),
        "STOP_SPINDLE_TURNING" => Canon::SpindleOff,
        "FLOOD_ON" | "FLOOD_OFF" => Canon::Flood(name.ends_with("ON")),
        "MIST_ON" | "MIST_OFF" => Canon::Mist(name.ends_with("ON")),
        "PROGRAM_STOP" => Canon::Stop,
        "OPTIONAL_PROGRAM_STOP" => Canon::OptionalStop,
        "COMMENT" => Canon::Comment(arguments.trim_matches('"').to_string()),
        "SELECT_TOOL" => Canon::SelectTool(number(0)? as u32),
        "CHANGE_TOOL" => Canon::ChangeTool,
        _ => Canon::Other(name.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_are_parsed() {
        let output = "\
    7 N1     COMMENT(\"feed (mode) set\")
   10 N..... SELECT_PLANE(CANON_PLANE_XZ)
   16 N12    SELECT_TOOL(7)
   19 N12    CHANGE_TOOL(2)
   23 N5     STRAIGHT_TRAVERSE(1.0000, -2.5000, 0.0000, 0.0000, 0.0000, 0.0000)
   27 N123456ARC_FEED(3.0000, 2.0000, 2.0000, 2.1000, -1, 0.5000, 0.0000, 0.0000, 0.0000)
   29 N10    DWELL(1.5000)
   30 N10    SET_FEED_MODE(0, 1)
";
        let calls = parse(output).unwrap();
        let expect = [
            (Some(1), Canon::Comment("feed (mode) set".into())),
            (None, Canon::Plane(Axis::Y)),
            (Some(12), Canon::SelectTool(7)),
            (Some(12), Canon::ChangeTool),
            (Some(5), Canon::Traverse([1.0, -2.5, 0.0, 0.0, 0.0, 0.0])),
            (
                Some(123_456),
                Canon::Arc {
                    end: [3.0, 2.0],
                    center: [2.0, 2.1],
                    turns: -1,
                    height: 0.5,
                    rotary: [0.0; 3],
                },
            ),
            (Some(10), Canon::Dwell(1.5)),
            (Some(10), Canon::PerMinute(false)),
        ];
        let expect = expect.map(|(line, canon)| Call { line, canon });
        assert_eq!(calls, expect);
    }

    #[test]
    fn other_text_is_refused() {
        assert!(parse("no call at all").is_err());
        assert!(parse("    1 N1     STRAIGHT_FEED(1.0, 2.0)").is_err());
    }

    #[test]
    fn blocks_get_the_number_of_their_line() {
        let nc = "%\nO100\nN10G0X1\n/N20 G1 Y2\n(T9)\nT3M6\n";
        assert_eq!(with_line_numbers(nc), "%\nO100\nN3 G0X1\n/N4  G1 Y2\nN5 (T9)\nN6 T3M6\n");
        assert_eq!(tool_table(nc, &['T']), "T3 P3 D0 Z0\n");
    }

    #[test]
    fn a_program_is_run() {
        let Some(program) = program() else { return };
        let calls = run(&program, "%\nG21 G0 X1.5\nT4 M6\nM30\n%\n").unwrap();
        let traverse = Canon::Traverse([1.5, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert!(calls.contains(&Call { line: Some(2), canon: traverse }));
        assert!(calls.contains(&Call { line: Some(3), canon: Canon::SelectTool(4) }));
    }

    #[test]
    fn a_wrong_arc_is_refused() {
        let Some(program) = program() else { return };
        let error = run(&program, "G21 G2 X1 Y0 I.6 J0 F10\nM30\n").unwrap_err();
        assert!(error.contains("Radius"), "{error}");
    }
}
