//! The user's blocks at the start, at the end and around tool changes, packed into INTCOM: two ASCII characters an
//! integer, low byte first, 33 integers a block, ten blocks.

use crate::commons::{Commons, Int, Kind, NA};
use crate::locations as loc;
use crate::setting::Flag;

/// Integers that a block takes.
pub const BLOCK_INTEGERS: u16 = 33;

/// Blocks of a list, at most.
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

/// The blocks around one kind of tool change.
#[derive(Clone, Copy, Debug)]
pub struct AroundChange {
    /// Before all that the change itself writes.
    pub before: UserBlocks,
    /// After it.
    pub after: UserBlocks,
}

/// The blocks around the first tool change of a program.
pub const FIRST_CHANGE: AroundChange = AroundChange {
    before: UserBlocks {
        flag: loc::BLOCKS_FIRST_CHANGE_BEFORE_FLAG,
        count: loc::BLOCKS_FIRST_CHANGE_BEFORE_COUNT,
        text: loc::BLOCKS_FIRST_CHANGE_BEFORE_TEXT,
    },
    after: UserBlocks {
        flag: loc::BLOCKS_FIRST_CHANGE_AFTER_FLAG,
        count: loc::BLOCKS_FIRST_CHANGE_AFTER_COUNT,
        text: loc::BLOCKS_FIRST_CHANGE_AFTER_TEXT,
    },
};

/// The blocks around the changes between; also around the first and the last one where
/// these have none of their own.
pub const OTHER_CHANGE: AroundChange = AroundChange {
    before: UserBlocks {
        flag: loc::BLOCKS_CHANGE_BEFORE_FLAG,
        count: loc::BLOCKS_CHANGE_BEFORE_COUNT,
        text: loc::BLOCKS_CHANGE_BEFORE_TEXT,
    },
    after: UserBlocks {
        flag: loc::BLOCKS_CHANGE_AFTER_FLAG,
        count: loc::BLOCKS_CHANGE_AFTER_COUNT,
        text: loc::BLOCKS_CHANGE_AFTER_TEXT,
    },
};

/// The blocks around the last tool change of a program.
pub const LAST_CHANGE: AroundChange = AroundChange {
    before: UserBlocks {
        flag: loc::BLOCKS_LAST_CHANGE_BEFORE_FLAG,
        count: loc::BLOCKS_LAST_CHANGE_BEFORE_COUNT,
        text: loc::BLOCKS_LAST_CHANGE_BEFORE_TEXT,
    },
    after: UserBlocks {
        flag: loc::BLOCKS_LAST_CHANGE_AFTER_FLAG,
        count: loc::BLOCKS_LAST_CHANGE_AFTER_COUNT,
        text: loc::BLOCKS_LAST_CHANGE_AFTER_TEXT,
    },
};

/// All lists, by their keys in machine.toml.
pub const LISTS: [(&str, UserBlocks); 8] = [
    ("blocks.start", START),
    ("blocks.end", END),
    ("blocks.first_change_before", FIRST_CHANGE.before),
    ("blocks.first_change_after", FIRST_CHANGE.after),
    ("blocks.change_before", OTHER_CHANGE.before),
    ("blocks.change_after", OTHER_CHANGE.after),
    ("blocks.last_change_before", LAST_CHANGE.before),
    ("blocks.last_change_after", LAST_CHANGE.after),
];

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

    /// The list is written: there are blocks in it.
    pub fn is_on(self, commons: &Commons) -> bool {
        commons.read(self.flag) && commons.int(self.count) > 0
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
