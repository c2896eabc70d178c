//! Doubts: what may not be what the user means, and at which level it is reported.
//!
//! `DOUBTS` is the one table of default levels. Every doubt of the post goes through
//! `Control::doubt`.

use fil_diag::{Code, CodeKind, Diag, Level, LevelProfile, Levels, Result, Severity};

use crate::cause::{Cause, FilLine};
use crate::control::Control;
use crate::control_state::modal::Source;
use crate::errors::PostCode;

/// The default levels of a doubt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Defaults {
    /// An author caused it; profile `careful`.
    pub careful: Level,
    /// An author caused it; profile `legacy`.
    pub legacy: Level,
    /// The post caused it, or what the control does by itself; in both profiles.
    pub own: Level,
}

impl Defaults {
    /// What could lead the tool through the part.
    const DANGER: Defaults =
        Defaults { careful: Level::Deny, legacy: Level::Warn, own: Level::Deny };

    /// What is right on most machines, and can be judged only by the operator.
    const USUAL: Defaults =
        Defaults { careful: Level::Warn, legacy: Level::Warn, own: Level::Warn };

    /// The default for a cause.
    pub fn level(self, by: Source, profile: LevelProfile) -> Level {
        match (by, profile) {
            (Source::Post | Source::NotCommanded, _) => self.own,
            (Source::Author, LevelProfile::Careful) => self.careful,
            (Source::Author, LevelProfile::Legacy) => self.legacy,
        }
    }
}

/// The doubts of the post with their default levels.
const DOUBTS: &[(PostCode, Defaults)] = &[
    // A rapid from an unknown height.
    (PostCode::UnknownLevel, Defaults::DANGER),
    // A feed move from an unknown rotary position.
    (PostCode::UnknownTurn, Defaults::DANGER),
    // A motion without the tool length offset.
    (PostCode::LengthTaken, Defaults::DANGER),
    // Cutter compensation behind an unreadable block.
    (PostCode::CompensationLost, Defaults::DANGER),
    // The tool, plane, axes or frame of an active mode, changed by an author's block.
    (PostCode::AuthorChange, Defaults::DANGER),
    // An output macro or REPLAC took out a word that the post can't restate.
    (PostCode::EditedWord, Defaults::DANGER),
    // A table that is turned on from where it stands in another work offset.
    (PostCode::ShiftedTurn, Defaults::USUAL),
];

/// The default levels of a code; `None` for one that is no doubt of the post.
pub fn defaults(code: &Code) -> Option<Defaults> {
    let row = DOUBTS.iter().find(|(doubt, _)| <&Code>::from(*doubt) == code);
    row.map(|(_, defaults)| *defaults)
}

/// The level of a doubt for a cause.
fn level_of(levels: &Levels, code: &Code, by: Source) -> Level {
    match defaults(code) {
        Some(defaults) => levels.of(code, defaults.level(by, levels.profile())),
        None => levels.of_code(code),
    }
}

impl Control {
    /// Reports a doubt at its level. After `Ok` the caller goes on as `assumed` says, which a
    /// warning tells.
    ///
    /// # Errors
    /// The doubt, where its level is deny, and one of a code that is always an error.
    #[cold]
    pub(crate) fn doubt(&mut self, by: Source, diag: Box<Diag>, assumed: &str) -> Result<()> {
        let level = level_of(&self.warnings.levels, diag.code, by);
        self.report(by, level, diag, assumed)
    }

    /// Reports a doubt about an author's block that leads no tool through the part: the post
    /// outputs again what it needs, or needs nothing. It warns where no level is set.
    ///
    /// # Errors
    /// As [`Control::doubt`].
    #[cold]
    pub(crate) fn mild_doubt(&mut self, diag: Box<Diag>, assumed: &str) -> Result<()> {
        let level = self.warnings.levels.of(diag.code, Level::Warn);
        self.report(Source::Author, level, diag, assumed)
    }

    fn report(
        &mut self,
        by: Source,
        level: Level,
        mut diag: Box<Diag>,
        assumed: &str,
    ) -> Result<()> {
        let author = self.warnings.author.filter(|_| by == Source::Author);
        if author.is_some_and(|author| self.allows_at(author, diag.code)) {
            return Ok(());
        }
        if diag.code.kind == CodeKind::Doubt {
            let block = self.warnings.unread_block.as_deref().filter(|_| by == Source::Author);
            diag.notes.push(how_to_allow(diag.code, block));
        }
        match level {
            Level::Allow => Ok(()),
            Level::Deny => {
                diag.severity = Severity::Error;
                self.warnings.denied = author;
                Err(diag)
            }
            Level::Warn => {
                diag.severity = Severity::Warning;
                diag.message = format!("{}; {assumed}", diag.message);
                match author {
                    Some(author) => self.warnings.add_of_author(*diag, author),
                    None => self.warnings.add_made(*diag),
                }
                Ok(())
            }
        }
    }

    /// A comment at the author's line of FIL, or at the top of its file, allows the code.
    fn allows_at(&self, author: Cause, code: &Code) -> bool {
        let lines = &self.warnings.allowed_lines;
        self.tape.stacks.lines(author.stack).iter().any(|line| {
            let file = FilLine { line: 0, ..*line };
            let codes = [line, &file].map(|line| lines.get(line));
            codes.into_iter().flatten().flatten().any(|number| *number == code.number)
        })
    }
}

/// The line that accepts a doubt, and the one that says what the author's block does, where that
/// ends the doubt.
fn how_to_allow(code: &Code, block: Option<&str>) -> String {
    let name = code.name();
    let level = format!("--allow {name}, or [levels] {name} = \"allow\" in machine.toml");
    match block.zip(effects_that_help(code)) {
        Some((block, effects)) => format!(
            "if this is intended: {level}; or describe the block: [effects] {block:?} = {effects}"
        ),
        None => format!("if this is intended: {level}"),
    }
}

/// The effects that leave nothing of a doubt about a block that can't be read.
fn effects_that_help(code: &Code) -> Option<&'static str> {
    let is = |doubt: PostCode| <&Code>::from(doubt) == code;
    if is(PostCode::UnknownLevel) || is(PostCode::UnknownTurn) {
        return Some("\"keeps position\" or \"returns clear\"");
    }
    is(PostCode::CompensationLost).then_some("\"nothing\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_doubt_has_a_row_and_each_row_is_a_doubt() {
        let doubts = PostCode::ALL.iter().filter(|code| code.kind == CodeKind::Doubt);
        let mut doubts: Vec<String> = doubts.map(Code::name).collect();
        let mut rows: Vec<String> =
            DOUBTS.iter().map(|(code, _)| <&Code>::from(*code).name()).collect();
        doubts.sort();
        rows.sort();
        assert_eq!(rows, doubts);
    }

    #[test]
    fn what_the_post_itself_causes_is_never_milder() {
        let rank = |level| Level::ALL.iter().position(|other| *other == level);
        for (_, row) in DOUBTS {
            assert!(rank(row.legacy) <= rank(row.careful));
            assert!(rank(row.careful) <= rank(row.own));
        }
    }
}
