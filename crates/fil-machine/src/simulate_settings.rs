//! `[simulate]`: stock, finished part, cells, tools and work offsets for `filpost simulate`, as the
//! machine file has them. What the texts mean is up to the crate that cuts.

use fil_diag::TextSpan;
use fil_diag::suggest::did_you_mean;

/// Keys of `[simulate]` with a value of their own.
const KEYS: [&str; 4] = ["stock", "part", "part_tol", "grid"];

/// Tables of `[simulate]`: tools by number, work offsets by name.
const TABLES: [&str; 2] = ["tools", "offsets"];

/// One setting of `[simulate]`.
#[derive(Clone, Debug)]
pub struct SimulateSetting {
    /// `stock`, `part`, `part_tol`, `grid`, `tools.1` or `offsets.G55`.
    pub key: String,
    /// Its value as text: `box 60x40x20`, `0.5`, `D10R0.5`, `60,0,0`.
    pub value: String,
    /// The value in the machine file, for messages and for files next to it.
    pub place: TextSpan,
}

/// All settings of `[simulate]`, each key once.
#[derive(Clone, Debug, Default)]
pub struct SimulateSettings(Vec<SimulateSetting>);

impl SimulateSettings {
    /// All settings, in the order they were first set.
    pub fn all(&self) -> &[SimulateSetting] {
        &self.0
    }

    /// Sets a key; the last value counts.
    pub(crate) fn set(&mut self, setting: SimulateSetting) {
        match self.0.iter_mut().find(|known| known.key == setting.key) {
            Some(known) => *known = setting,
            None => self.0.push(setting),
        }
    }
}

/// Checks a key of `[simulate]`; `Err` has the hint.
///
/// # Errors
/// The hint for an unknown key.
pub(crate) fn check_key(key: &str) -> Result<(), Option<String>> {
    if KEYS.contains(&key) {
        return Ok(());
    }
    match key.split_once('.') {
        Some(("tools", number)) if number.parse::<u32>().is_ok() => Ok(()),
        Some(("tools", _)) => Err(Some("Use the tool number as the key: 1 = \"D10\"".into())),
        Some(("offsets", _)) => Ok(()),
        _ => {
            let known = KEYS.iter().chain(&TABLES).copied();
            let hint = did_you_mean(key, known);
            Err(Some(hint.unwrap_or_else(|| {
                "[simulate] has stock, part, part_tol, grid, tools and offsets".into()
            })))
        }
    }
}
