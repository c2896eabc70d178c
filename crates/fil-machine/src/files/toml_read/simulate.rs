//! `[simulate]`: what `filpost simulate` cuts.

use std::ops::Range;

use fil_diag::{Diag, Result};
use toml::Spanned;
use toml::de::DeValue;

use super::TomlReader;
use crate::commons::Commons;
use crate::errors::MachineCode;
use crate::simulate_settings::{SimulateSetting, check_key};

impl TomlReader<'_> {
    /// Sets a key of `[simulate]`.
    ///
    /// # Errors
    /// An unknown key, a value that is neither a text nor, for a length, a number.
    pub(super) fn simulate(
        &self,
        commons: &mut Commons,
        name: &str,
        key: Range<usize>,
        value: &Spanned<DeValue>,
    ) -> Result<()> {
        if let Err(hint) = check_key(name) {
            let message = format!("no setting `simulate.{name}`");
            let mut diag = Diag::new(MachineCode::UnknownSetting, message);
            diag.hint = hint;
            return Err(self.at(key, diag));
        }
        let takes_number = matches!(name, "part_tol" | "grid");
        let text = match value.get_ref() {
            DeValue::String(text) => text.to_string(),
            DeValue::Integer(_) | DeValue::Float(_) if takes_number => {
                self.plain_number(value)?.to_string()
            }
            _ => {
                let needed = if takes_number { "a length" } else { "a text" };
                let mut diag =
                    Diag::new(MachineCode::SettingValue, format!("simulate.{name} needs {needed}"));
                let example = match name {
                    "stock" => "stock = \"box 100x80x30\"",
                    "part" => "part = \"part.stl\"",
                    "part_tol" | "grid" => "0.5",
                    _ if name.starts_with("tools") => "1 = \"D10R0.5\"",
                    _ => "G55 = \"60,0,0\"",
                };
                diag.hint = Some(format!("Write it as in {example}"));
                return Err(self.at(value.span(), diag));
            }
        };
        let place = self.index.place(self.file, self.text, value.span());
        commons.set_simulate(SimulateSetting { key: name.to_string(), value: text, place });
        Ok(())
    }
}
