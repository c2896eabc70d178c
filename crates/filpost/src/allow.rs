//! Levels by the names of codes: what a user may set, and to what.

use fil_diag::{Code, CodeKind, Diag, Level, Levels};
use fil_post::levels;

use crate::error::{RunCode, all_codes};

/// What a level is set for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelOf {
    /// All codes that have none of their own.
    All,
    /// One code.
    Code(&'static Code),
}

impl LevelOf {
    /// What is named: `all`, or a code whose level can be set.
    ///
    /// # Errors
    /// E0713 for a name that is no code, and for an error that stands.
    pub fn named(name: &str) -> Result<Self, Box<Diag>> {
        match name {
            "all" => Ok(LevelOf::All),
            _ => allowable(name).map(LevelOf::Code),
        }
    }

    /// Sets the level.
    pub fn set(self, levels: &mut Levels, level: Level) {
        match self {
            LevelOf::All => levels.set_all(level),
            LevelOf::Code(code) => levels.set(code.number, level),
        }
    }
}

/// The code of that name, `W0151` or `E0223`, where its level can be set: a warning, or
/// a doubt, which can be carried out but may not be what is meant.
///
/// # Errors
/// E0713 for a name that is no code, and for an error that stands.
pub fn allowable(name: &str) -> Result<&'static Code, Box<Diag>> {
    let found =
        number(name).and_then(|number| all_codes().into_iter().find(|code| code.number == number));
    match found {
        Some(code) if code.kind != CodeKind::Error => Ok(code),
        Some(code) => {
            let message = format!("{} ({}) can't be allowed", code.name(), code.title);
            let hint = format!("it can't be done: {}", code.reason);
            Err(Box::new(RunCode::CannotAllow.diag(message).hint(hint)))
        }
        None => RunCode::CannotAllow.err(format!("there is no code {name}")),
    }
}

/// The number in the name of a code. The letter may be the other one: it says whether a code is an
/// error or a warning where nobody sets its level, and that may have changed.
fn number(name: &str) -> Option<u16> {
    let digits = name.strip_prefix(['E', 'W', 'e', 'w'])?;
    digits.parse().ok().filter(|_| digits.len() == 4)
}

/// A level by the names of its code, or `all`, and its own.
///
/// # Errors
/// E0713 for a code that has no level, and for what is no level.
pub fn level_named(code: &str, level: &str) -> Result<(LevelOf, Level), Box<Diag>> {
    let Ok(level) = level.parse::<Level>() else {
        let message = format!("`{level}` is not a level of {code}; write allow, warn or deny");
        return RunCode::CannotAllow.err(message);
    };
    Ok((LevelOf::named(code)?, level))
}

/// Levels by the names of codes, of `all`, and of the `profile`, as a case names them.
///
/// # Errors
/// E0713 for a code that has no level, and for what is no level.
pub fn levels_named<'n>(
    said: impl IntoIterator<Item = (&'n str, &'n str)>,
) -> Result<Levels, Box<Diag>> {
    let mut levels = Levels::default();
    for (name, level) in said {
        if name != "profile" {
            let (of, level) = level_named(name, level)?;
            of.set(&mut levels, level);
            continue;
        }
        let Ok(profile) = level.parse() else {
            return RunCode::CannotAllow.err(format!("`{level}` is not a profile of levels"));
        };
        levels.choose(profile);
    }
    Ok(levels)
}

/// The levels of a code in a sentence; `None` for one that is no doubt.
pub fn level_line(code: &Code) -> Option<String> {
    if code.kind != CodeKind::Doubt {
        return None;
    }
    let name = code.name();
    let set =
        format!("`--allow {name}` or `--warn {name}`, or `{name} = \"allow\"` under `[levels]`");
    let Some(defaults) = levels::defaults(code) else {
        return Some(format!("Level: {}; {set}, sets another.", Level::Deny));
    };
    Some(format!(
        "Level: {}; of a block that an author wrote {} in the profile `careful` and {} in `legacy`; {set}, \
         sets another.",
        defaults.own, defaults.careful, defaults.legacy
    ))
}

/// Refuses levels of a machine for codes that there are not, and for errors that stand.
///
/// # Errors
/// E0713
pub(crate) fn refuse_unknown(levels: &Levels) -> Result<(), Vec<Diag>> {
    let codes = all_codes();
    let wrong = levels.of_codes().filter_map(|(number, level)| {
        let code = codes.iter().find(|code| code.number == number);
        let name = code.map_or_else(|| format!("E{number:04}"), |code| code.name());
        let diag = allowable(&name).err()?;
        Some(diag.note(format!("in [levels]: {name} = \"{level}\"")))
    });
    let wrong: Vec<Diag> = wrong.collect();
    if wrong.is_empty() { Ok(()) } else { Err(wrong) }
}
