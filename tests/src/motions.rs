//! NC programs of `tests/motions/`: comments at their head say what they do.
//!
//! ```text
//! ; post: fanuc-lathe          the ready post whose language it is (fanuc-mill)
//! ; set: rotary.primary_kind=1 a setting on top
//! ; note: TEXT                 why
//! ; expect: rapid X10 Y? Z5    an event, in order; `?` marks an axis that is not known
//! ; error: E0910 at 12         the refusal and its line, or `12:5` with its column;
//!                              events before it are compared
//! ```

use std::path::{Path, PathBuf};

use fil_nc::dialect::Dialect;
use fil_nc::interpret::interpret;
use fil_nc::motion::{Compensation, Course, Event, Modes, Move, Rate, Speed, Spindle};
use filpost::{Diag, Program};

/// What the head of a program says.
#[derive(Debug, Default)]
pub struct Head {
    post: Option<String>,
    settings: Vec<String>,
    /// Events in order.
    pub expected: Vec<String>,
    /// The refusal, `E0910 at 12`.
    pub error: Option<String>,
}

impl Head {
    /// Reads the comments at the head of a program.
    ///
    /// # Errors
    /// A comment of another form.
    pub fn read(text: &str) -> Result<Head, String> {
        let mut head = Head::default();
        for line in text.lines().map_while(|line| line.strip_prefix("; ")) {
            let (key, value) = line.split_once(": ").ok_or_else(|| format!("`{line}`"))?;
            match key {
                "post" => head.post = Some(value.into()),
                "set" => head.settings.push(value.into()),
                "expect" => head.expected.push(value.into()),
                "error" => head.error = Some(value.into()),
                "note" => {}
                _ => return Err(format!("unknown key `{key}`")),
            }
        }
        Ok(head)
    }

    /// The generic mill without a change.
    pub fn is_plain_mill(&self) -> bool {
        self.post.is_none() && self.settings.is_empty()
    }

    /// The language of its machine.
    ///
    /// # Errors
    /// Settings that are none.
    pub fn dialect(&self) -> Result<Dialect, String> {
        let name = self.post.as_deref().unwrap_or("fanuc-mill");
        let mut builder = Program::builder().generic(name);
        for setting in &self.settings {
            builder = builder.set(setting);
        }
        let post = builder.build().map_err(|error| error.to_string())?;
        Dialect::new(post.commons()).map_err(|diag| diag.to_string())
    }
}

/// The events of a program as lines, and why it was refused.
pub fn lines(text: &str, dialect: &Dialect) -> (Vec<String>, Option<Box<Diag>>) {
    let mut lines = Vec::new();
    let mut modes = Modes::default();
    let refused = interpret(text.as_bytes(), "out.nc", dialect, &mut |event| match event {
        Event::Move(motion) => {
            let now = Modes { inch: modes.inch, ..motion.modes };
            if now != modes {
                modes = now;
                lines.push(modes_line(&modes));
            }
            lines.push(motion_line(&motion));
        }
        Event::ToolChange { tool, .. } => lines.push(format!("tool {tool}")),
        Event::Dwell { seconds: Some(seconds), .. } => lines.push(format!("dwell {seconds}")),
        Event::Dwell { seconds: None, .. } => lines.push("dwell".into()),
        Event::Auxiliary { code, .. } => lines.push(format!("M{code}")),
        Event::ToolMeasured { .. } => lines.push("tool measured".into()),
        Event::LeftToControl { .. } => {}
        Event::End { .. } => lines.push("end".into()),
    });
    (lines, refused.err())
}

/// What is said of a program for the generic mill.
///
/// # Panics
/// When the mill can't be built.
pub fn refusal(text: &str) -> Option<Diag> {
    let dialect = Head::default().dialect().expect("the generic mill");
    lines(text, &dialect).1.map(|diag| *diag)
}

/// The programs, by name.
///
/// # Panics
/// When the folder is not there.
pub fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(crate::root().join("tests/motions")).expect("tests/motions");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

/// What the head of a program says it is refused with.
///
/// # Panics
/// When the file can't be read.
pub fn listed(path: &Path) -> Option<String> {
    let text = std::fs::read_to_string(path).expect("a program");
    Head::read(&text).ok()?.error
}

/// Checks a program against its head.
///
/// # Errors
/// What it does instead.
pub fn check(path: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let head = Head::read(&text)?;
    let (found, refused) = lines(&text, &head.dialect()?);
    let said = refused.map(|diag| {
        let place = diag.spans.first();
        let mut said = format!("{} at {}", diag.code.name(), place.map_or(0, |place| place.line));
        if head.error.as_ref().is_some_and(|error| error.contains(':')) {
            said += &format!(":{}", place.map_or(0, fil_diag::TextSpan::column));
        }
        (said, diag)
    });
    if said.as_ref().map(|(said, _)| said) != head.error.as_ref() {
        return Err(format!("refused: {said:?}\nafter {found:#?}"));
    }
    if found == head.expected {
        return Ok(());
    }
    Err(format!("expected:\n{}\nfound:\n{}", head.expected.join("\n"), found.join("\n")))
}

/// A number with at most four digits after the point.
fn number(value: f64) -> String {
    let rounded = (value * 1e4).round() / 1e4;
    (rounded + 0.0).to_string()
}

fn motion_line(motion: &Move) -> String {
    let course = match (motion.course, motion.arc) {
        (_, Some(arc)) if arc.ccw => "arc ccw",
        (_, Some(_)) => "arc cw",
        (Course::Rapid, _) => "rapid",
        (Course::Feed, _) => "feed",
        (Course::Thread, _) => "thread",
        (Course::Machine, _) => "machine",
    };
    let mut line = course.to_string();
    if motion.to.tip_control {
        line += " tip";
    }
    let values = motion.to.linear.into_iter().chain(motion.to.rotary);
    for ((name, value), known) in ["X", "Y", "Z", "p", "s"].iter().zip(values).zip(motion.known) {
        let rotary = name.chars().all(char::is_lowercase);
        match known {
            true if rotary && value == 0.0 => {}
            true => line += &format!(" {name}{}", number(value)),
            false => line += &format!(" {name}?"),
        }
    }
    if let Some(arc) = motion.arc {
        for axis in [(arc.normal + 1) % 3, (arc.normal + 2) % 3] {
            line += &format!(" {}{}", ["I", "J", "K"][axis], number(arc.center[axis]));
        }
        line += &format!(" {}deg", number(arc.angle));
    }
    line += &match motion.rate {
        None => String::new(),
        Some(Rate::PerMinute(rate)) => format!(" F{}", number(rate)),
        Some(Rate::PerTurn(rate)) => format!(" F{}/rev", number(rate)),
        Some(Rate::Varying(rate, change)) => {
            format!(" F{}/rev {} more in each", number(rate), number(change))
        }
        Some(Rate::Inverse(rate)) => format!(" F{}/inverse", number(rate)),
    };
    if motion.in_cycle { line + " cycle" } else { line }
}

fn modes_line(modes: &Modes) -> String {
    let mut line = format!("modes T{}", modes.tool);
    if let Some(offset) = modes.length.offset {
        line += &format!(" H{offset}");
    }
    if modes.frame.tip_control {
        line += " tip-control";
    }
    if let Some((normal, _)) = modes.planes.unusual {
        line += [" YZ", " ZX", " XY"][normal];
    }
    match modes.spindle.speed {
        Some(Speed::Turns(speed)) => line += &format!(" S{}", number(speed)),
        Some(Speed::Surface(speed)) => line += &format!(" surface S{}", number(speed)),
        None => {}
    }
    if let Some(limit) = modes.spindle.speed_limit {
        line += &format!(" up to S{}", number(limit));
    }
    line += match modes.spindle.turn {
        Spindle::Off => "",
        Spindle::Clockwise => " cw",
        Spindle::Counterclockwise => " ccw",
    };
    line += match modes.compensation.side {
        Compensation::Off => "",
        Compensation::Left => " left",
        Compensation::Right => " right",
    };
    if let Some(fixture) = modes.frame.fixture {
        line += &format!(" G{fixture}");
    }
    if let Some(code) = modes.coolant {
        line += &format!(" coolant M{code}");
    }
    line
}
