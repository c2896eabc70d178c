//! The user's blocks at fixed places of a program. Those at the start, at the end and around tool
//! changes are packed into INTCOM: two ASCII characters an integer, low byte first, 33 integers a
//! block, ten blocks. Those around operations, work offsets, cycles and turns are texts of their own.
//!
//! A block may hold `{tool}` and `{offset}`: the numbers of the tool and of the work offset.

use std::borrow::Cow;

use crate::commons::{Commons, Int, Kind, NA};
use crate::locations as loc;
use crate::setting::Flag;

/// Integers that a block takes.
pub const BLOCK_INTEGERS: u16 = 33;

/// Blocks of a list, at most.
pub const MAX_BLOCKS: u16 = 10;

/// Where a list of user blocks lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UserBlocks(Place);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// In INTCOM.
    Packed {
        /// The list is written at all.
        flag: Flag,
        /// How many blocks it has.
        count: Int,
        /// Its first integer.
        text: Int,
    },
    /// Beside the commons, by its number.
    Own(usize),
}

const fn packed(flag: Flag, count: Int, text: Int) -> UserBlocks {
    UserBlocks(Place::Packed { flag, count, text })
}

const fn own(number: usize) -> UserBlocks {
    UserBlocks(Place::Own(number))
}

/// The blocks after the head of the program.
pub const START: UserBlocks =
    packed(loc::BLOCKS_START_FLAG, loc::BLOCKS_START_COUNT, loc::BLOCKS_START_TEXT);

/// The blocks before the end of the program.
pub const END: UserBlocks =
    packed(loc::BLOCKS_END_FLAG, loc::BLOCKS_END_COUNT, loc::BLOCKS_END_TEXT);

/// The blocks on both sides of something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Around {
    /// Before all that it writes itself.
    pub before: UserBlocks,
    /// After it.
    pub after: UserBlocks,
}

/// The blocks around the first tool change of a program.
pub const FIRST_CHANGE: Around = Around {
    before: packed(
        loc::BLOCKS_FIRST_CHANGE_BEFORE_FLAG,
        loc::BLOCKS_FIRST_CHANGE_BEFORE_COUNT,
        loc::BLOCKS_FIRST_CHANGE_BEFORE_TEXT,
    ),
    after: packed(
        loc::BLOCKS_FIRST_CHANGE_AFTER_FLAG,
        loc::BLOCKS_FIRST_CHANGE_AFTER_COUNT,
        loc::BLOCKS_FIRST_CHANGE_AFTER_TEXT,
    ),
};

/// The blocks around the changes between; also around the first and the last one where
/// these have none of their own.
pub const OTHER_CHANGE: Around = Around {
    before: packed(
        loc::BLOCKS_CHANGE_BEFORE_FLAG,
        loc::BLOCKS_CHANGE_BEFORE_COUNT,
        loc::BLOCKS_CHANGE_BEFORE_TEXT,
    ),
    after: packed(
        loc::BLOCKS_CHANGE_AFTER_FLAG,
        loc::BLOCKS_CHANGE_AFTER_COUNT,
        loc::BLOCKS_CHANGE_AFTER_TEXT,
    ),
};

/// The blocks around the last tool change of a program.
pub const LAST_CHANGE: Around = Around {
    before: packed(
        loc::BLOCKS_LAST_CHANGE_BEFORE_FLAG,
        loc::BLOCKS_LAST_CHANGE_BEFORE_COUNT,
        loc::BLOCKS_LAST_CHANGE_BEFORE_TEXT,
    ),
    after: packed(
        loc::BLOCKS_LAST_CHANGE_AFTER_FLAG,
        loc::BLOCKS_LAST_CHANGE_AFTER_COUNT,
        loc::BLOCKS_LAST_CHANGE_AFTER_TEXT,
    ),
};

/// The blocks around an operation: before its first motion, and behind its last one.
pub const OPERATION: Around = Around { before: own(0), after: own(1) };

/// The blocks around the choice of another work offset.
pub const OFFSET: Around = Around { before: own(2), after: own(3) };

/// The blocks around the holes of canned cycles.
pub const CYCLE: Around = Around { before: own(4), after: own(5) };

/// The blocks around turns of the rotary axes.
pub const TURN: Around = Around { before: own(6), after: own(7) };

/// The lists that lie in INTCOM, by their keys in machine.toml.
pub const IN_COMMONS: [(&str, UserBlocks); 8] = [
    ("blocks.start", START),
    ("blocks.end", END),
    ("blocks.first_change_before", FIRST_CHANGE.before),
    ("blocks.first_change_after", FIRST_CHANGE.after),
    ("blocks.change_before", OTHER_CHANGE.before),
    ("blocks.change_after", OTHER_CHANGE.after),
    ("blocks.last_change_before", LAST_CHANGE.before),
    ("blocks.last_change_after", LAST_CHANGE.after),
];

/// The other lists, by their keys in machine.toml, with where their blocks stand.
pub const OWN: [(&str, UserBlocks, &str); 8] = [
    (
        "blocks.operation_before",
        OPERATION.before,
        "Before the first motion of each operation, behind its tool change.",
    ),
    (
        "blocks.operation_after",
        OPERATION.after,
        "Behind the last motion of each operation, before the retract of the tool.",
    ),
    (
        "blocks.offset_before",
        OFFSET.before,
        "Before the function of the first work offset and of each other one, behind the retract.",
    ),
    ("blocks.offset_after", OFFSET.after, "Behind the function of such a work offset."),
    ("blocks.cycle_before", CYCLE.before, "Before the approach of the first hole of CYCLE."),
    (
        "blocks.cycle_after",
        CYCLE.after,
        "Behind the last hole, at CYCLE/OFF, the next tool, operation or the end.",
    ),
    (
        "blocks.turn_before",
        TURN.before,
        "Before the block in which rotary axes turn, unless blocks at feed turn them on.",
    ),
    (
        "blocks.turn_after",
        TURN.after,
        "Behind such a block at rapid and its clamp; behind the next rapid block where the turn was at feed.",
    ),
];

/// All lists, by their keys in machine.toml.
pub const LISTS: [(&str, UserBlocks); IN_COMMONS.len() + OWN.len()] = {
    let mut lists = [IN_COMMONS[0]; IN_COMMONS.len() + OWN.len()];
    let mut at = 0;
    while at < IN_COMMONS.len() {
        lists[at] = IN_COMMONS[at];
        at += 1;
    }
    while at < lists.len() {
        let (key, list, _) = OWN[at - IN_COMMONS.len()];
        lists[at] = (key, list);
        at += 1;
    }
    lists
};

/// What the names in the braces of a block stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Numbers {
    /// `{tool}`: number of the tool.
    pub tool: Option<i64>,
    /// `{offset}`: number of the work offset, as SET/OFSETL counts.
    pub offset: Option<i64>,
}

/// The names that a block may hold in braces.
pub const NAMES: [&str; 2] = ["{tool}", "{offset}"];

/// What stands in braces in a block and is none of its names: a slip of the pen.
pub fn unknown_name(block: &str) -> Option<&str> {
    let mut rest = block;
    while let Some(begin) = rest.find('{') {
        let end = begin + rest[begin..].find('}')? + 1;
        let name = &rest[begin..end];
        let is_word = name[1..name.len() - 1].bytes().all(|byte| byte.is_ascii_alphabetic());
        if is_word && name.len() > 2 && !NAMES.contains(&name) {
            return Some(name);
        }
        rest = &rest[end..];
    }
    None
}

impl Numbers {
    /// A block with these numbers in place of their names.
    ///
    /// # Errors
    /// The name that there is no number for.
    pub fn fill(self, block: &str) -> Result<Cow<'_, str>, &'static str> {
        let mut filled = Cow::Borrowed(block);
        for (name, number) in NAMES.into_iter().zip([self.tool, self.offset]) {
            if filled.contains(name) {
                let number = number.ok_or(name)?;
                filled = Cow::Owned(filled.replace(name, &number.to_string()));
            }
        }
        Ok(filled)
    }
}

/// The list that an INTCOM location belongs to, with its key.
pub fn list_of(number: u16) -> Option<(&'static str, UserBlocks)> {
    LISTS.into_iter().find(|(_, list)| list.holds(number))
}

impl UserBlocks {
    /// The texts, without blanks around them.
    pub fn read(self, commons: &Commons) -> Vec<String> {
        match self.0 {
            Place::Own(number) => commons.own_blocks(number).to_vec(),
            Place::Packed { flag, .. } if !commons.read(flag) => Vec::new(),
            Place::Packed { count, text, .. } => {
                let count = commons.int(count).clamp(0, i32::from(MAX_BLOCKS)) as u16;
                (0..count).map(|block| unpack(commons, text.0 + block * BLOCK_INTEGERS)).collect()
            }
        }
    }

    /// The list is written: there are blocks in it.
    pub fn is_on(self, commons: &Commons) -> bool {
        match self.0 {
            Place::Own(number) => !commons.own_blocks(number).is_empty(),
            Place::Packed { flag, count, .. } => commons.read(flag) && commons.int(count) > 0,
        }
    }

    /// Stores texts, at most [`MAX_BLOCKS`] of at most twice [`BLOCK_INTEGERS`]
    /// characters each.
    pub fn store(self, commons: &mut Commons, blocks: &[String]) {
        let (flag, count, first) = match self.0 {
            Place::Own(number) => {
                let blocks = blocks.iter().map(|block| block.trim().to_string());
                return commons.set_own_blocks(number, blocks.collect());
            }
            Place::Packed { flag, count, text } => (flag, count, text),
        };
        let mut set = |location: u16, value: i32| {
            commons
                .set(Kind::Int, u32::from(location), f64::from(value))
                .expect("user blocks lie within INTCOM");
        };
        set(flag.number, i32::from(!blocks.is_empty()));
        set(count.0, blocks.len().min(usize::from(MAX_BLOCKS)) as i32);
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

    /// True for a location of the list.
    pub fn holds(self, number: u16) -> bool {
        let Place::Packed { flag, count, text } = self.0 else { return false };
        let texts = text.0..text.0 + MAX_BLOCKS * BLOCK_INTEGERS;
        texts.contains(&number) || number == flag.number || number == count.0
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
