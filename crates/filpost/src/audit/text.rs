//! A change in print.

use std::fmt;

use fil_nc::decimals;

use super::{Author, Change, What};

/// Decimals of a difference.
const DECIMALS: u8 = 4;

impl fmt::Display for Author {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Author::Script { place, section } => {
                let place = place.as_ref().map(|(file, line)| format!("{file}:{line}"));
                let section = section.as_ref().map(|section| format!("section {section}"));
                let parts: Vec<String> = place.into_iter().chain(section).collect();
                f.write_str(&parts.join(" "))
            }
            Author::Insert => f.write_str("INSERT"),
            Author::Post { after: None } => f.write_str("the post, by what a script has set"),
            Author::Post { after: Some(author) } => write!(f, "the post, after {author}"),
        }
    }
}

impl fmt::Display for What {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |texts: &[String]| {
            texts.iter().map(|text| format!("`{text}`")).collect::<Vec<_>>().join(", ")
        };
        match self {
            What::Number { letter, from, to, .. } => write!(f, "{letter} {from} -> {to}"),
            What::Turned { letter, from, to, stays, blocks } => {
                let from = from.as_ref().map_or(String::new(), |from| format!("{from} "));
                write!(f, "{letter} {from}-> {to}")?;
                if *stays {
                    f.write_str(" and stays")?;
                }
                let motions = if *blocks == 1 { "motion" } else { "motions" };
                write!(f, "; {blocks} {motions} while it is turned")
            }
            What::Blocks { from, to } if from.is_empty() => write!(f, "{} put in", shown(to)),
            What::Blocks { from, to } if to.is_empty() => write!(f, "{} left out", shown(from)),
            What::Blocks { from, to } if from == to => write!(f, "{} moved", shown(to)),
            What::Blocks { from, to } => write!(f, "{} -> {}", shown(from), shown(to)),
        }
    }
}

impl Change {
    /// What was changed, in a sentence without the author.
    pub fn sentence(&self) -> String {
        let times = |text: String| match self.count {
            1 => text,
            count => format!("{text}, {count} times"),
        };
        match &self.what {
            What::Number { letter, by: Some(by), .. } if self.count > 1 => {
                let how = match (letter, *by < 0.0) {
                    ('Z', false) => "raised",
                    ('Z', true) => "lowered",
                    (_, false) => "more",
                    (_, true) => "less",
                };
                let by = decimals::short(by.abs(), DECIMALS);
                format!("{letter} {how} by {by} in {} blocks", self.count)
            }
            What::Number { letter, from, to, by: None } => {
                format!("{letter} changed in {} blocks, first {from} -> {to}", self.count)
            }
            what => times(what.to_string()),
        }
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.author)?;
        if self.cl_lines.iter().any(|line| *line > 0) {
            let word = if self.cl_lines.len() == 1 { "line" } else { "lines" };
            let lines: Vec<String> = self.cl_lines.iter().map(u32::to_string).collect();
            let more = if self.count > self.cl_lines.len() as u64 { " …" } else { "" };
            write!(f, ", CL {word} {}{more}", lines.join(", "))?;
        }
        write!(f, ": {}", self.sentence())?;
        match self.nc_lines.first() {
            Some(line) => write!(f, " (NC line {line})"),
            None => Ok(()),
        }
    }
}
