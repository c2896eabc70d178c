//! Writing the commons as `machine.toml`: what differs from the defaults, by
//! name where there is one.

use std::fmt::Write as _;

use fil_diag::Levels;

use crate::commons::{Commons, EMPTY, Kind};
use crate::effects::Effects;
use crate::locations::{self as loc, Location, default_commons};
use crate::stored;
use crate::stored::BLANKS;
use crate::user_blocks::{self, UserBlocks};

/// The settings that differ from the default machine.
pub fn write_toml(commons: &Commons) -> String {
    let defaults = default_commons();
    let mut out = String::new();
    for row in loc::TABLE.iter().filter(|row| !is_text(row.kind, row.number)) {
        let value = value_of(commons, row.kind, row.number);
        if value != value_of(&defaults, row.kind, row.number) {
            let _ = writeln!(out, "{} = {}  # {}", key(row, value), show(row, value), row.meaning);
        }
    }
    for (name, at) in user_blocks::LISTS {
        blocks(commons, name, at, &mut out);
    }
    if !commons.words_without_effect().is_empty() {
        let _ = writeln!(out, "words.without_effect = {:?}", commons.words_without_effect());
    }
    if !commons.allowed_offsets().is_empty() {
        let _ = writeln!(out, "verify.allowed_offsets = {:?}", commons.allowed_offsets());
    }
    if !commons.undecided().is_empty() {
        let _ = writeln!(out, "learned.undecided = {:?}", commons.undecided());
    }
    if !commons.unequal().is_empty() {
        let _ = writeln!(out, "learned.unequal = {:?}", commons.unequal());
    }
    unnamed(commons, &defaults, &mut out);
    levels(commons.levels(), &mut out);
    effects(commons.effects(), &mut out);
    simulate(commons, &mut out);
    out
}

/// The levels of findings. A table, so it comes last.
fn levels(levels: &Levels, out: &mut String) {
    if levels.is_empty() {
        return;
    }
    out.push_str("[levels]\n");
    if let Some(profile) = levels.chosen_profile() {
        let _ = writeln!(out, "profile = \"{}\"", profile.name());
    }
    if let Some(level) = levels.all() {
        let _ = writeln!(out, "all = \"{level}\"");
    }
    for (number, level) in levels.of_codes() {
        let _ = writeln!(out, "E{number:04} = \"{level}\"");
    }
}

/// What blocks of the shop do. A table too.
fn effects(effects: &Effects, out: &mut String) {
    if effects.is_empty() {
        return;
    }
    out.push_str("[effects]\n");
    for rule in effects.rules() {
        let _ = writeln!(out, "{:?} = \"{}\"", rule.said, rule.effect.name());
    }
}

/// What `filpost simulate` cuts. Tables too.
fn simulate(commons: &Commons, out: &mut String) {
    let mut table = None;
    let mut settings: Vec<_> = commons.simulate().all().iter().collect();
    // Keys of their own first: what follows the head of a table belongs to it.
    settings.sort_by_key(|setting| setting.key.split_once('.').map(|(table, _)| table));
    for setting in settings {
        let (group, key) = match setting.key.split_once('.') {
            Some((group, key)) => (format!("simulate.{group}"), key),
            None => ("simulate".to_string(), setting.key.as_str()),
        };
        if table.as_ref() != Some(&group) {
            let _ = writeln!(out, "[{group}]");
            table = Some(group);
        }
        // The number of an offset may hold a point.
        let is_bare = key.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        let key = if is_bare { key.to_string() } else { format!("{key:?}") };
        let _ = writeln!(out, "{key} = {:?}", setting.value);
    }
}

/// A list of user blocks as texts; what they leave of its locations by number. Blanks
/// are what a location of texts has anyway.
fn blocks(commons: &Commons, name: &str, at: UserBlocks, out: &mut String) {
    let mut again = default_commons();
    let blocks = at.read(commons);
    if !blocks.is_empty() {
        let _ = writeln!(out, "{name} = {blocks:?}");
        at.store(&mut again, &blocks);
    }
    let said = |value: f64| if value == EMPTY { BLANKS } else { value };
    for number in (1..=Kind::Int.size() as u16).filter(|number| at.holds(*number)) {
        let value = value_of(commons, Kind::Int, number);
        if said(value) != said(value_of(&again, Kind::Int, number)) {
            let strange = stored::check(Kind::Int, number.into(), value).is_err();
            let key = if strange { strange_key } else { numbered_key };
            let _ = writeln!(out, "{} = {value}", key(Kind::Int, number));
        }
    }
}

/// Locations without a name, the address table among them.
fn unnamed(commons: &Commons, defaults: &Commons, out: &mut String) {
    for kind in [Kind::Int, Kind::Rel, Kind::Dbl] {
        for number in 1..=kind.size() as u16 {
            let value = value_of(commons, kind, number);
            let named = Location::numbered(kind, u32::from(number)).is_some();
            if value != value_of(defaults, kind, number) && !named && !is_text(kind, number) {
                let strange = stored::check(kind, number.into(), value).is_err();
                let key = if strange { strange_key } else { numbered_key };
                let value = if value == EMPTY { "\"none\"".into() } else { value.to_string() };
                let _ = writeln!(out, "{} = {value}", key(kind, number));
            }
        }
    }
}

fn value_of(commons: &Commons, kind: Kind, number: u16) -> f64 {
    commons.get(kind, u32::from(number)).unwrap_or(EMPTY)
}

/// The name; the number where the setting has no choice of this value.
fn key(row: &Location, value: f64) -> String {
    if stored::check(row.kind, row.number.into(), value).is_err() {
        return strange_key(row.kind, row.number);
    }
    let choices = row.choice_list();
    let strange = value != EMPTY && choices.iter().all(|(choice, _)| *choice != value);
    if strange && !choices.is_empty() {
        numbered_key(row.kind, row.number)
    } else {
        row.name.to_string()
    }
}

/// The key of a value that only an option file may hold.
fn strange_key(kind: Kind, number: u16) -> String {
    format!("imported.{}", numbered_key(kind, number))
}

fn numbered_key(kind: Kind, number: u16) -> String {
    let prefix = match kind {
        Kind::Int => "int",
        Kind::Rel => "rel",
        Kind::Dbl => "dbl",
    };
    format!("{prefix}.{number}")
}

fn show(row: &Location, value: f64) -> String {
    match row.choice_list().iter().find(|(choice, _)| *choice == value) {
        _ if value == EMPTY => "\"none\"".into(),
        Some((_, "yes")) => "true".into(),
        Some((_, "no")) => "false".into(),
        _ => value.to_string(),
    }
}

/// True for the packed texts of user blocks.
fn is_text(kind: Kind, number: u16) -> bool {
    kind == Kind::Int && user_blocks::list_of(number).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::read_toml;

    #[test]
    fn effects_read_back() {
        let text =
            "[effects]\n\"G65.1 P98*\" = \"returns clear\"\n\"M98 P9001\" = \"tool change\"\n";
        let (commons, _) = read_toml("m", text).unwrap();
        let written = write_toml(&commons);
        assert!(written.ends_with(text), "{written}");
        let wrong = read_toml("m", "[effects]\nM66 = \"tool chnage\"\n").unwrap_err();
        assert_eq!(wrong[0].hint.as_deref(), Some("did you mean tool change?"));
        assert!(read_toml("m", "[effects]\n\"*\" = \"nothing\"\n").is_err());
    }

    #[test]
    fn what_is_simulated_reads_back() {
        let text = "[simulate]\ngrid = \"0.5\"\nstock = \"box 60x40x20\"\n\
                    [simulate.offsets]\n\"G54.1P3\" = \"0,60,0\"\nG55 = \"60,0,0\"\n\
                    [simulate.tools]\n1 = \"D10\"\n2 = \"D5 A118\"\n";
        let (commons, _) = read_toml("m", text).unwrap();
        assert!(write_toml(&commons).ends_with(text), "{}", write_toml(&commons));
        let wrong = read_toml("m", "[simulate]\nstok = \"auto\"\n").unwrap_err();
        assert_eq!(wrong[0].hint.as_deref(), Some("did you mean stock?"));
        for text in ["stock = 5", "grid = true", "tools.A = \"D5\"", "tools = \"D5\"", "x.y = 1"] {
            let wrong = read_toml("m", &format!("[simulate]\n{text}\n")).unwrap_err();
            assert!(wrong[0].hint.is_some(), "{wrong:?}");
        }
    }

    #[test]
    fn what_is_written_reads_back() {
        let text = "rapid.split = 0\nscale.x = 2.0\nint.5001 = 7\ncycle.off_code = 'none'\n\
                    [address.Y]\nslot = 53\n[blocks]\nend = ['M5', 'G1 Z1.0']\n";
        let (commons, _) = read_toml("m", text).unwrap();
        let written = write_toml(&commons);
        let (again, _) = read_toml("m", &written).unwrap();
        for kind in [Kind::Int, Kind::Rel, Kind::Dbl] {
            for number in 1..=kind.size() as u16 {
                let (a, b) = (value_of(&commons, kind, number), value_of(&again, kind, number));
                assert_eq!(a, b, "{kind:?} {number}\n{written}");
            }
        }
    }
}
