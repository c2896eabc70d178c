//! Machine settings as files: `machine.toml` (names) and option files (numbers).
//! Both fill the commons; nothing else holds a setting.

mod option_file;
mod toml_read;
mod toml_write;

pub use option_file::{OptionFile, read_option_file};
pub use toml_read::{apply_setting, read_toml};
pub use toml_write::write_toml;

use crate::commons::{Commons, Int, Kind, NA};
use crate::program::{BLOCK_INTEGERS, MAX_BLOCKS};

/// Packs the user's start or end blocks into INTCOM: two ASCII characters an
/// integer, low byte first, 33 integers a block.
fn pack_blocks(commons: &mut Commons, (flag, count, first): (Int, Int, Int), blocks: &[String]) {
    let mut set = |location: u16, value: i32| {
        commons
            .set(Kind::Int, u32::from(location), f64::from(value))
            .expect("user blocks lie within INTCOM");
    };
    set(flag.0, i32::from(!blocks.is_empty()));
    set(count.0, blocks.len().min(MAX_BLOCKS as usize) as i32);
    for (block, text) in (0..MAX_BLOCKS).zip(blocks) {
        let mut bytes = text.bytes().chain(std::iter::repeat(b' '));
        for offset in 0..BLOCK_INTEGERS {
            let (low, high) = (bytes.next().unwrap_or(b' '), bytes.next().unwrap_or(b' '));
            let value = i32::from(low) | i32::from(high) << 8;
            debug_assert_ne!(value, NA);
            set(first.0 + block * BLOCK_INTEGERS + offset, value);
        }
    }
}
