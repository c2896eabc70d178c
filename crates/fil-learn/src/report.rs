//! The report, as text and as JSON.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::learned::{Learned, LearnedPair};

/// Differences that the text names; the JSON has all.
const NAMED: usize = 20;

impl LearnedPair {
    /// How much of the program comes out, in a line.
    pub(crate) fn summary(&self) -> String {
        let name = &self.nc_name;
        match (self.is_equal, self.is_refused) {
            (true, _) => format!("{name}: every byte"),
            (_, true) => format!("{name}: the CL file is refused"),
            _ => format!("{name}: {} of {} blocks", self.equal, self.blocks),
        }
    }

    /// The first places that differ, proven blocks before ours.
    pub(crate) fn differences(&self, most: usize) -> String {
        let mut text = String::new();
        for (line, proven, ours) in self.left.iter().take(most) {
            let _ = writeln!(text, "  line {line}");
            proven.iter().for_each(|block| text.push_str(&format!("  - {block}\n")));
            ours.iter().for_each(|block| text.push_str(&format!("  + {block}\n")));
        }
        text
    }
}

impl Learned {
    /// The report as text: how much comes out, what was found, what is left.
    pub fn report(&self) -> String {
        let mut text = String::new();
        for pair in self.pairs() {
            let _ = writeln!(text, "{}", pair.summary());
        }
        let _ = writeln!(text, "\nbase {}", self.base());
        for (name, value) in self.options() {
            let _ = writeln!(text, "option {name} = {value}");
        }
        for proof in self.proofs() {
            let _ = write!(text, "{} = {} (base {})", proof.key, proof.value, proof.base);
            if let Some((file, line)) = proof.lines.first() {
                let _ = write!(text, "  {file}:{line}, {} in all", proof.count);
            }
            text.push('\n');
        }
        let undecided = self.undecided();
        if !undecided.is_empty() {
            let _ = writeln!(text, "\nno pair decides {} other values:", undecided.len());
            for setting in undecided {
                let _ = writeln!(text, "  {}", setting.replace('\n', " and "));
            }
        }
        for pair in self.pairs().iter().filter(|pair| !pair.left.is_empty()) {
            let _ = writeln!(text, "\nleft in {}:", pair.nc_name);
            text.push_str(&pair.differences(NAMED));
            if pair.left.len() > NAMED {
                let _ = writeln!(text, "  and {} more places", pair.left.len() - NAMED);
            }
        }
        text
    }

    /// The report as data.
    pub fn report_json(&self) -> Value {
        let settings: Vec<Value> = self
            .proofs()
            .map(|proof| {
                let lines: Vec<Value> = proof
                    .lines
                    .iter()
                    .map(|(file, line)| json!({"file": file, "line": line}))
                    .collect();
                json!({
                    "key": proof.key, "value": proof.value, "base": proof.base,
                    "lines": lines, "count": proof.count, "refused_without": proof.refused,
                })
            })
            .collect();
        let pairs: Vec<Value> = self
            .pairs()
            .iter()
            .map(|pair| {
                let left: Vec<Value> = pair
                    .left
                    .iter()
                    .map(|(line, proven, ours)| json!({"line": line, "proven": proven, "ours": ours}))
                    .collect();
                json!({
                    "cl": pair.cl_name, "nc": pair.nc_name, "blocks": pair.blocks,
                    "equal": pair.equal, "is_equal": pair.is_equal,
                    "is_refused": pair.is_refused, "left": left,
                })
            })
            .collect();
        let options: serde_json::Map<String, Value> =
            self.options().iter().map(|(name, value)| (name.clone(), json!(value))).collect();
        json!({
            "base": self.base(), "options": options, "settings": settings, "pairs": pairs,
            "undecided": self.undecided(), "runs": self.runs(),
        })
    }
}
