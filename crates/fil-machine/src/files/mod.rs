//! Machine settings as files: `machine.toml` (names) and option files (numbers).
//! Both fill the commons; nothing else holds a setting.

mod option_file;
mod toml_read;
mod toml_write;

pub use option_file::{OptionFile, read_option_file};
pub use toml_read::{apply_setting, lay_over, read_toml, read_toml_with};
pub use toml_write::write_toml;
