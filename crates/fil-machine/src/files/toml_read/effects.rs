//! `[effects]`: what calls and codes of the shop do.

use std::ops::Range;

use fil_diag::suggest::did_you_mean;
use fil_diag::{Diag, Result};
use toml::Spanned;
use toml::de::DeValue;

use super::TomlReader;
use crate::commons::Commons;
use crate::effects::Effect;
use crate::errors::MachineCode;

impl TomlReader<'_> {
    /// Adds a rule: a block, a word or a pattern, and what it does.
    ///
    /// # Errors
    /// A text that names no block, a value that is no effect.
    pub(super) fn effect(
        &self,
        commons: &mut Commons,
        block: &str,
        key: Range<usize>,
        value: &Spanned<DeValue>,
    ) -> Result<()> {
        let name = value.get_ref().as_str().unwrap_or_default();
        let Ok(effect) = name.parse::<Effect>() else {
            let names = Effect::ALL.map(Effect::name);
            let message = format!("an effect is one of `{}`", names.join("`, `"));
            let mut diag = Diag::new(MachineCode::SettingValue, message);
            diag.hint = did_you_mean(name, names);
            return Err(self.at(value.span(), diag));
        };
        if commons.add_effect(block, effect) {
            return Ok(());
        }
        let message = format!("`{block}` is every block; one is M98 P9001 or G65 P98*");
        Err(self.at(key, Diag::new(MachineCode::SettingValue, message)))
    }
}
