//! The line map of a run: what made each block of the NC program and each word
//! of it.
//!
//! A map is a text of JSON lines. The first line says what the run read and
//! wrote; the last line holds the digests of the CL file, of the NC program and of the
//! lines before it, so that a map that was cut off or edited, or one of another run, is
//! refused. Between them stand, in any number:
//!
//! - `[lines,records,"words"]`: a line of the NC program: by how much the line and
//!   the number of its CL record come after those of the line before, and its
//!   words; a fourth item is its FIL call stack.
//! - `7`: a line of the NC program of the same form as the 7th that was written out.
//! - `{"stack":n,"section":s,"fil":[[file,line],…]}`: a FIL call stack, innermost
//!   line first, before the first block that names it.
//! - `{"taken":[cl,record],"section":s}`: a record that a section took without
//!   any effect on the post.
//!
//! The words of a block are separated by blanks: `X7:6` is an X of 7 bytes (the
//! blank after it counts) that repeats word 6 of the block's record, `G3` one due
//! to that record as a whole, `M3*5` one caused by word 5 of the record that a FIL
//! statement made, `G4@` one that the machine's settings ask for, `F5:4@-2,-1,0`
//! one caused by word 4 of the record before, two lines before that of the block,
//! without FIL. `_` stands for a text, `/` for the block-delete character, `#` for a
//! sequence number.
//!
//! [`Run::run_mapped`](crate::Run::run_mapped) writes a map, [`MapReader`]
//! reads one, block by block; neither needs memory for the length of the file.

mod digest;
mod forms;
mod line;
mod lines;
mod names;
mod reader;
mod words;
mod writer;

pub use digest::Digest;
pub(crate) use digest::Digested;
pub use names::Names;
pub use reader::{Entry, MapFile, MapReader, NcLine, Taken};
pub use words::Word;
pub(crate) use writer::Writer;

/// The version of the format that is written, and the only one that is read.
pub const VERSION: u32 = 3;

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::Program;

    /// A map of some hundred blocks: forms that come again, FIL, records that a section takes.
    fn map() -> Vec<u8> {
        let fil = "CIMFIL/ON,DELAY\nPOSTN/OUT,24,NN\nNN=NN+1\nCIMFIL/OFF\nCIMFIL/ON,STOP\n\
                   CIMFIL/OFF\nNN=1\nFINI\n";
        let mut cl = String::from("UNITS / MM\nFEDRAT / 200, MMPM\n");
        for number in 0..300 {
            let x = f64::from(number * 7 % 50);
            cl.push_str(&format!("GOTO / {x}, {}, 0\n", number / 2));
            cl.push_str(if number % 40 == 9 { "DELAY / 1\n" } else { "" });
            cl.push_str(if number % 70 == 3 { "STOP\n" } else { "" });
        }
        let post = Program::builder().generic("fanuc-mill").fil("mill.fil", fil).build().unwrap();
        let names =
            Names { cl: "part.ncl".into(), nc: "out.nc".into(), fil: vec!["mill.fil".into()] };
        let (mut nc, mut lines) = (Vec::new(), Vec::new());
        post.start().run_mapped(Cursor::new(cl + "FINI\n"), &mut nc, &names, &mut lines).unwrap();
        lines
    }

    #[test]
    fn blocks_passed_over_leave_the_rest_as_it_is() {
        let map = map();
        let reader = || MapReader::new("out.nc.map", Cursor::new(&map)).unwrap();
        let lines = |reader: MapReader<_>| {
            let entries = reader.map(|entry| entry.unwrap());
            entries.filter(|entry| matches!(entry, Entry::Line(_))).collect::<Vec<_>>()
        };
        let all = lines(reader());
        assert!(all.len() > 300, "{} blocks", all.len());
        for number in 0..all.len() as u64 + 3 {
            let mut passing = reader();
            passing.pass_to(number).unwrap();
            let passed = all.len().min(number.saturating_sub(1) as usize);
            let cause = match passed.checked_sub(1).map(|at| &all[at]) {
                Some(Entry::Line(line)) => line.cause,
                _ => fil_post::Cause::default(),
            };
            assert_eq!(
                (passing.last_cause().record, passing.last_cause().line),
                (cause.record, cause.line)
            );
            assert_eq!(lines(passing), all[passed..], "from block {number}");
        }
    }

    #[test]
    fn blocks_of_a_line_are_those_that_it_has() {
        let map = map();
        let reader = || MapReader::new("out.nc.map", Cursor::new(&map)).unwrap();
        let all: Vec<Entry> = reader().map(|entry| entry.unwrap()).collect();
        let mut words_alone = 0;
        for line in 1..330 {
            let is_of = |entry: &&Entry| match entry {
                Entry::Line(block) => {
                    let of_word = block.words.iter().any(|word| word.cause.line == line);
                    words_alone += u32::from(of_word && block.cause.line != line);
                    of_word || block.cause.line == line
                }
                Entry::Taken(taken) => taken.line == line,
            };
            let wanted: Vec<Entry> = all.iter().filter(is_of).cloned().collect();
            let mut passing = reader();
            let found: Vec<Entry> = std::iter::from_fn(|| passing.next_of_line(line))
                .map(|entry| entry.unwrap())
                .collect();
            assert_eq!(found, wanted, "line {line}");
        }
        assert!(words_alone > 0, "words of other lines than that of their block");
    }
}
