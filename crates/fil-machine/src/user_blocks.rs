//! The user's start and end blocks, packed into INTCOM: two ASCII characters an
//! integer, low byte first, 33 integers a block, ten blocks.

use crate::commons::{Commons, Int, Kind, NA};
use crate::locations as loc;
use crate::setting::Flag;

/// Integers that a block takes.
pub const BLOCK_INTEGERS: u16 = 33;

/// Blocks that fit at the start and at the end.
pub const MAX_BLOCKS: u16 = 10;

/// Where a list of user blocks lies.
#[derive(Clone, Copy, Debug)]
pub struct UserBlocks {
    /// The list is written at all.
    pub flag: Flag,
    /// How many blocks it has.
    pub count: Int,
    /// Its first integer.
    pub text: Int,
}

/// The blocks after the head of the program.
pub const START: UserBlocks = UserBlocks {
    flag: loc::BLOCKS_START_FLAG,
    count: loc::BLOCKS_START_COUNT,
    text: loc::BLOCKS_START_TEXT,
};

/// The blocks before the end of the program.
pub const END: UserBlocks = UserBlocks {
    flag: loc::BLOCKS_END_FLAG,
    count: loc::BLOCKS_END_COUNT,
    text: loc::BLOCKS_END_TEXT,
};

/// All lists, by their keys in machine.toml.
pub const LISTS: [(&str, UserBlocks); 2] = [("blocks.start", START), ("blocks.end", END)];

/// The list that an INTCOM location belongs to, with its key.
pub fn list_of(number: u16) -> Option<(&'static str, UserBlocks)> {
    LISTS.into_iter().find(|(_, list)| list.holds(number))
}

impl UserBlocks {
    /// The texts, without blanks around them.
    pub fn read(self, commons: &Commons) -> Vec<String> {
        if !commons.read(self.flag) {
            return Vec::new();
        }
        let count = commons.int(self.count).clamp(0, i32::from(MAX_BLOCKS)) as u16;
        (0..count).map(|block| unpack(commons, self.text.0 + block * BLOCK_INTEGERS)).collect()
    }

    /// Stores texts, at most [`MAX_BLOCKS`] of at most twice [`BLOCK_INTEGERS`]
    /// characters each.
    pub fn store(self, commons: &mut Commons, blocks: &[String]) {
        let mut set = |location: u16, value: i32| {
            commons
                .set(Kind::Int, u32::from(location), f64::from(value))
                .expect("user blocks lie within INTCOM");
        };
        set(self.flag.number, i32::from(!blocks.is_empty()));
        set(self.count.0, blocks.len().min(usize::from(MAX_BLOCKS)) as i32);
        for (block, text) in (0..MAX_BLOCKS).zip(blocks) {
            let mut bytes = text.bytes().chain(std::iter::repeat(b' '));
            for offset in 0..BLOCK_INTEGERS {
                let (low, high) = (bytes.next().unwrap_or(b' '), bytes.next().unwrap_or(b' '));
                let value = i32::from(low) | i32::from(high) << 8;
                debug_assert_ne!(value, NA);
                set(self.text.0 + block * BLOCK_INTEGERS + offset, value);
            }
        }
    }

    /// True for a location of the list.
    pub fn holds(self, number: u16) -> bool {
        let text = self.text.0..self.text.0 + MAX_BLOCKS * BLOCK_INTEGERS;
        text.contains(&number) || number == self.flag.number || number == self.count.0
    }
}

fn unpack(commons: &Commons, first: u16) -> String {
    let mut text = String::new();
    for location in first..first + BLOCK_INTEGERS {
        let pair = commons.int_opt(Int(location)).unwrap_or(0x2020);
        text.extend(characters(pair).map(|c| c.unwrap_or(' ')));
    }
    text.trim().to_string()
}

/// The two characters of a packed integer; `None` for one that does not print.
pub fn characters(pair: i32) -> [Option<char>; 2] {
    [pair & 0xff, (pair >> 8) & 0xff].map(|byte| {
        let byte = byte as u8;
        (0x20..0x7f).contains(&byte).then_some(char::from(byte))
    })
}
