//! `[levels]`: the level of each code, of `all`, and the profile.

use std::ops::Range;

use fil_diag::{Diag, Level, LevelProfile, Result};
use toml::Spanned;
use toml::de::DeValue;

use super::TomlReader;
use crate::commons::Commons;
use crate::errors::MachineCode;

impl TomlReader<'_> {
    /// Sets the level of a code, of all codes, or the profile.
    ///
    /// # Errors
    /// A key that is not `profile`, `all` or a code; a value that is not a level.
    pub(super) fn level(
        &self,
        commons: &mut Commons,
        name: &str,
        key: Range<usize>,
        value: &Spanned<DeValue>,
    ) -> Result<()> {
        let said = value.get_ref().as_str().unwrap_or_default();
        let wrong = |message: String| {
            Err(self.at(value.span(), Diag::new(MachineCode::SettingValue, message)))
        };
        let levels = commons.levels_mut();
        if name == "profile" {
            let Ok(profile) = said.parse::<LevelProfile>() else {
                return wrong("a profile is `careful` or `legacy`".to_string());
            };
            levels.choose(profile);
            return Ok(());
        }
        let Ok(level) = said.parse::<Level>() else {
            return wrong("a level is `allow`, `warn` or `deny`".to_string());
        };
        match code_number(name) {
            _ if name == "all" => levels.set_all(level),
            Some(number) => levels.set(number, level),
            None => {
                let message = format!("`{name}` is no code; one is E0532");
                return Err(self.at(key, Diag::new(MachineCode::UnknownSetting, message)));
            }
        }
        Ok(())
    }
}

/// The number of a code by its name, `E0532`.
fn code_number(name: &str) -> Option<u16> {
    let digits = name.strip_prefix(['E', 'W', 'e', 'w'])?;
    let is_number = digits.len() == 4 && digits.bytes().all(|byte| byte.is_ascii_digit());
    digits.parse().ok().filter(|_| is_number)
}
