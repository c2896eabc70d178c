//! Machine settings as files: `machine.toml` (names) and option files (numbers).
//! Both fill the commons; nothing else holds a setting.

use fil_diag::Diag;

use crate::commons::Commons;

mod option_file;
mod toml_read;
mod toml_write;

pub use option_file::{OptionFile, is_option_text, read_option_file};
pub use toml_read::{
    apply_setting, declare_fil_options, given_options, read_toml, read_toml_given, read_toml_with,
};
pub use toml_write::write_toml;

/// Lays a `machine.toml` or an option file over the settings of a machine, told by the text.
///
/// # Errors
/// All that is wrong in the text; what it sets is not sure then.
pub fn lay_over(commons: &mut Commons, file: &str, text: &str) -> Result<Vec<Diag>, Vec<Diag>> {
    match is_option_text(text) {
        true => option_file::lay_option_file_over(commons, file, text),
        false => toml_read::lay_over(commons, file, text),
    }
}
