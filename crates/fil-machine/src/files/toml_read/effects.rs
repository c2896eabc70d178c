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

/// Most functions of `verify.allowed_functions`.
const MOST_FUNCTIONS: usize = 200;

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
        self.add(commons, block, effect, key)
    }

    /// Functions that a program may have unasked: they change nothing that it counts on.
    ///
    /// # Errors
    /// No list of texts; a text that names no block.
    pub(super) fn allowed_functions(
        &self,
        commons: &mut Commons,
        value: &Spanned<DeValue>,
    ) -> Result<()> {
        let functions = self.texts(value, MOST_FUNCTIONS)?;
        functions
            .iter()
            .try_for_each(|function| self.add(commons, function, Effect::Nothing, value.span()))
    }

    fn add(
        &self,
        commons: &mut Commons,
        block: &str,
        effect: Effect,
        place: Range<usize>,
    ) -> Result<()> {
        if commons.add_effect(block, effect) {
            return Ok(());
        }
        let message = format!("`{block}` is every block; one is M98 P9001 or G65 P98*");
        Err(self.at(place, Diag::new(MachineCode::SettingValue, message)))
    }
}
