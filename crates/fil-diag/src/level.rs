//! Levels: what happens to a finding that may not be what the user means.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use crate::{Code, Severity};

/// What kind of finding a code is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CodeKind {
    /// It can't be done: always an error, whatever level is set.
    Error,
    /// It may not be what is meant: an error where its level is deny.
    Doubt,
    /// It is worth a look: a warning unless a level says otherwise.
    Warning,
}

impl CodeKind {
    /// The severity of a finding whose level nobody has set.
    pub const fn severity(self) -> Severity {
        match self {
            CodeKind::Error | CodeKind::Doubt => Severity::Error,
            CodeKind::Warning => Severity::Warning,
        }
    }
}

/// What happens to a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// It is not reported.
    Allow,
    /// It is reported, and the program is written.
    Warn,
    /// It is an error: no program is written.
    Deny,
}

impl Level {
    /// All of them.
    pub const ALL: [Level; 3] = [Level::Allow, Level::Warn, Level::Deny];

    /// Its name in `[levels]` and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Level::Allow => "allow",
            Level::Warn => "warn",
            Level::Deny => "deny",
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Level {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Level::ALL.into_iter().find(|level| level.name() == name).ok_or(())
    }
}

/// Which default levels doubts have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LevelProfile {
    /// What an author wrote is denied where it could lead the tool through the part.
    #[default]
    Careful,
    /// What an author wrote (INSERT, POSTN, macros, machine texts) is taken at his word and
    /// warned of: the default where an option file is the machine.
    Legacy,
}

impl LevelProfile {
    /// Both of them.
    pub const ALL: [LevelProfile; 2] = [LevelProfile::Careful, LevelProfile::Legacy];

    /// Its name in `[levels]`.
    pub const fn name(self) -> &'static str {
        match self {
            LevelProfile::Careful => "careful",
            LevelProfile::Legacy => "legacy",
        }
    }
}

impl FromStr for LevelProfile {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        LevelProfile::ALL.into_iter().find(|profile| profile.name() == name).ok_or(())
    }
}

/// Levels that a user has set: a profile, one for all codes, and those of single codes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Levels {
    profile: Option<LevelProfile>,
    all: Option<Level>,
    /// By the number of the code.
    of_codes: BTreeMap<u16, Level>,
}

impl Levels {
    /// The profile; `careful` where nobody has chosen one.
    pub fn profile(&self) -> LevelProfile {
        self.profile.unwrap_or_default()
    }

    /// The profile that was chosen, if any.
    pub fn chosen_profile(&self) -> Option<LevelProfile> {
        self.profile
    }

    /// Chooses the profile.
    pub fn choose(&mut self, profile: LevelProfile) {
        self.profile = Some(profile);
    }

    /// Sets the level of a code by its number.
    pub fn set(&mut self, number: u16, level: Level) {
        self.of_codes.insert(number, level);
    }

    /// Sets the level of all codes that have none of their own.
    pub fn set_all(&mut self, level: Level) {
        self.all = Some(level);
    }

    /// Lays other levels over these: they win, a single code over `all`.
    pub fn lay_over(&mut self, other: &Levels) {
        self.profile = other.profile.or(self.profile);
        self.all = other.all.or(self.all);
        self.of_codes.extend(&other.of_codes);
    }

    /// The level that was set for a code, if any. One that always stays an error has none.
    pub fn set_for(&self, code: &Code) -> Option<Level> {
        if code.kind == CodeKind::Error {
            return None;
        }
        self.of_codes.get(&code.number).copied().or(self.all)
    }

    /// The level of a code whose default is this one.
    pub fn of(&self, code: &Code, default: Level) -> Level {
        self.set_for(code).unwrap_or(default)
    }

    /// The level of a finding of a code that has no other default than its severity.
    pub fn of_code(&self, code: &Code) -> Level {
        let default = match code.severity() {
            Severity::Error => Level::Deny,
            Severity::Warning => Level::Warn,
        };
        self.of(code, default)
    }

    /// The numbers of the codes that have a level of their own, with it.
    pub fn of_codes(&self) -> impl Iterator<Item = (u16, Level)> + '_ {
        self.of_codes.iter().map(|(number, level)| (*number, *level))
    }

    /// The level of all codes that have none of their own.
    pub fn all(&self) -> Option<Level> {
        self.all
    }

    /// True where nobody has set anything.
    pub fn is_empty(&self) -> bool {
        *self == Levels::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    crate::codes! {
        /// Codes of this test.
        pub enum TestCode {
            /// Can't be done.
            Impossible = 9801, Error, "a", "b", "c";
            /// May not be meant.
            Doubtful = 9802, Doubt, "a", "b", "c";
            /// Worth a look.
            Strange = 9803, Warning, "a", "b", "c";
        }
    }

    fn level(levels: &Levels, code: TestCode) -> Level {
        levels.of_code(code.into())
    }

    #[test]
    fn one_code_wins_over_all_and_an_error_stays() {
        let mut levels = Levels::default();
        assert_eq!(level(&levels, TestCode::Doubtful), Level::Deny);
        assert_eq!(level(&levels, TestCode::Strange), Level::Warn);
        levels.set(9802, Level::Warn);
        levels.set_all(Level::Allow);
        assert_eq!(level(&levels, TestCode::Doubtful), Level::Warn);
        assert_eq!(level(&levels, TestCode::Strange), Level::Allow);
        levels.set(9801, Level::Allow);
        assert_eq!(level(&levels, TestCode::Impossible), Level::Deny);
    }

    #[test]
    fn what_is_laid_over_wins() {
        let (mut below, mut above) = (Levels::default(), Levels::default());
        below.choose(LevelProfile::Legacy);
        below.set(9802, Level::Warn);
        below.set(9803, Level::Deny);
        above.set(9803, Level::Allow);
        below.lay_over(&above);
        assert_eq!(below.profile(), LevelProfile::Legacy);
        assert_eq!(level(&below, TestCode::Doubtful), Level::Warn);
        assert_eq!(level(&below, TestCode::Strange), Level::Allow);
    }
}
