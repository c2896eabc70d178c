//! Blocks with what made them, for callbacks.

use std::ffi::{CString, c_char, c_void};

use filpost::Origin;

use crate::pointer::c_text;

/// A line of FIL that had a part in a block.
#[repr(C)]
pub struct FilLine {
    /// The FIL file, as it was named.
    pub file: *const c_char,
    /// Line, from 1.
    pub line: u32,
}

/// A word of a block and what made it.
#[repr(C)]
pub struct BlockWord {
    /// Its letter; `_` for a text, `/` for block delete, `#` for a sequence number.
    pub letter: c_char,
    /// A FIL statement made the record that `record_word` counts.
    pub made_by_fil: bool,
    /// The word of the record, as POSTF(7,n) counts; 0 for the record as a whole.
    pub record_word: u16,
    /// Byte in the text of the block where it starts.
    pub start: usize,
    /// Byte behind it and the blank that follows.
    pub end: usize,
    /// Number of the CL record; 0 where the settings of the machine ask for it.
    pub record: u32,
    /// Line of the CL file; 0 where the settings of the machine ask for it.
    pub line: u32,
}

/// A block of an NC program. It lives during the call that it is handed to.
#[repr(C)]
pub struct Block {
    /// Number of the block in the program, from 1.
    pub number: u64,
    /// The block, without line end.
    pub text: *const c_char,
    /// Number of the CL record that made it; 0 before the first one.
    pub record: u32,
    /// Line of the CL file; 0 before the first record.
    pub line: u32,
    /// FIL lines that called one another, innermost first.
    pub fil: *const FilLine,
    /// Their number.
    pub fil_count: usize,
    /// The words in order.
    pub words: *const BlockWord,
    /// Their number.
    pub word_count: usize,
}

/// Takes a block; 0 goes on, anything else stops the run.
pub type TakeBlock =
    Option<unsafe extern "C" fn(block: *const Block, user_data: *mut c_void) -> i32>;

/// Hands a block to C.
///
/// # Safety
/// `take` is a function of this kind that may be called with `user_data`.
pub unsafe fn hand_out(
    block: &filpost::Block,
    fil: &[String],
    take: unsafe extern "C" fn(*const Block, *mut c_void) -> i32,
    user_data: *mut c_void,
) -> i32 {
    let text = c_text(&block.text);
    let names = file_names(&block.origin, fil);
    let lines: Vec<FilLine> = names
        .iter()
        .zip(&block.origin.fil)
        .map(|(name, line)| FilLine { file: name.as_ptr(), line: line.line })
        .collect();
    let words: Vec<BlockWord> = block
        .words
        .iter()
        .map(|word| BlockWord {
            letter: word.letter as u8 as c_char,
            made_by_fil: word.made_by_fil,
            record_word: word.record_word,
            start: word.range.start,
            end: word.range.end,
            record: word.origin.record,
            line: word.origin.line,
        })
        .collect();
    let handed = Block {
        number: block.number,
        text: text.as_ptr(),
        record: block.origin.record,
        line: block.origin.line,
        fil: lines.as_ptr(),
        fil_count: lines.len(),
        words: words.as_ptr(),
        word_count: words.len(),
    };
    // SAFETY: by the caller's promise; what the block points to lives during the call.
    unsafe { take(&raw const handed, user_data) }
}

fn file_names(origin: &Origin, fil: &[String]) -> Vec<CString> {
    let name = |file: u16| fil.get(usize::from(file)).map_or("?", String::as_str);
    origin.fil.iter().map(|line| c_text(name(line.file))).collect()
}
