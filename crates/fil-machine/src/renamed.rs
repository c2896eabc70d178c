//! Keys of `machine.toml` that others have taken the place of.
//!
//! A key that was once released is never dropped and never used for something else: the old one
//! goes on to work, and a warning (W0653) names the new one. A row is added here when a row of
//! `locations.tsv` gets another key; a test compares the keys with the list `tests/api/keys.txt`.

use fil_diag::Diag;

use crate::errors::MachineCode;

/// Old keys of `machine.toml`, each with the key that takes its place.
pub const KEYS: &[(&str, &str)] =
    &[("dwell.upm_min", "dwell.seconds_min"), ("dwell.upm_max", "dwell.seconds_max")];

/// The key that takes the place of an old one.
pub fn key(old: &str) -> Option<&'static str> {
    KEYS.iter().find(|(name, _)| *name == old).map(|(_, new)| *new)
}

/// W0653 for an old name.
pub fn warning(old: &str, new: &str) -> Diag {
    let hint = format!("write `{new}`; `{old}` means the same");
    Diag::new(MachineCode::RenamedSetting, format!("`{old}` is now `{new}`")).hint(hint)
}
