//! The headers of the files in `tests/words`.

use filpost::{Error, Program};

/// Settings that leave nothing of the program but the blocks of its records, and state the
/// modes that nothing says then.
const BARE: &[&str] = &[
    "seqno.off_at_start=72",
    "tape.start_char=none",
    "tape.end_char=none",
    "program.number_address=none",
    "units.metric_code=none",
    "units.inch_code=none",
    "mode.position=none",
    "feed.mode=none",
    "circle.plane=none",
    "mode.position_in_force=90",
    "feed.mode_in_force=94",
    "circle.plane_in_force=17",
    "program.rewind_code=none",
    "program.end_code=none",
];

/// What the header of a file in `tests/words` says.
#[derive(Clone, Default)]
pub struct Header {
    /// A ready post.
    pub post: Option<String>,
    /// Settings on top.
    pub settings: Vec<String>,
    /// Lines of FIL.
    pub fil: Vec<String>,
    /// Blocks that must come.
    pub expected: Vec<String>,
    /// Warnings that must come.
    pub warnings: Vec<String>,
    /// Levels of codes: the code, `all` or `profile`, and the level.
    pub levels: Vec<(String, String)>,
    /// The refusal that must come.
    pub error: Option<String>,
    /// Start and end of the program are written.
    pub whole: bool,
}

impl Header {
    /// Reads the header comments.
    ///
    /// # Errors
    /// A line of the header that is not known.
    pub fn read(text: &str) -> Result<Header, String> {
        let mut header = Header::default();
        for line in text.lines().filter_map(|line| line.strip_prefix("$$ ")) {
            let (key, value) = line.split_once(':').unwrap_or((line, ""));
            let indented = value.strip_prefix(' ').unwrap_or(value).trim_end().to_string();
            let value = value.trim().to_string();
            match key.trim() {
                "post" => header.post = Some(value),
                "set" => header.settings.push(value),
                "fil" => header.fil.push(value),
                // Lines of a Klartext cycle are indented.
                "expect" => header.expected.push(indented),
                "warn" => header.warnings.push(value),
                "error" => header.error = Some(value),
                "level" => {
                    let Some((code, level)) = value.split_once(' ') else {
                        return Err(format!("`{value}` is no level of a code"));
                    };
                    header.levels.push((code.to_string(), level.to_string()));
                }
                "whole" => header.whole = true,
                "note" => {}
                other => return Err(format!("unknown header line `{other}`")),
            }
        }
        if !text.contains("UNITS") {
            header.settings.insert(0, "units.mode=2".to_string());
        }
        Ok(header)
    }

    /// The post the header asks for.
    ///
    /// # Errors
    /// Settings or FIL that make no post.
    pub fn post(&self) -> Result<Program, Error> {
        let mut builder = Program::builder().generic(self.post.as_deref().unwrap_or("fanuc-mill"));
        let bare = if self.whole { &[] } else { BARE };
        // The plane of a SINUMERIK lathe says along which axes the lengths of its tools count.
        let turns = ["sinumerik-lathe", "sinumerik-mill-turn"];
        let turns = self.post.as_deref().is_some_and(|post| turns.contains(&post));
        let plane = (turns && !self.whole).then_some("circle.plane_in_force=18");
        let bare = bare.iter().copied().chain(plane);
        for setting in bare.chain(self.settings.iter().map(String::as_str)) {
            builder = builder.set(setting);
        }
        for (code, level) in &self.levels {
            builder = builder.set(&format!("levels.{code}={level}"));
        }
        if !self.fil.is_empty() {
            builder = builder.fil("header", &format!("{}\nFINI\n", self.fil.join("\n")));
        }
        builder.build()
    }
}
