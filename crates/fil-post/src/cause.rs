//! What blocks and words are caused by: a CL record and, where FIL wrote it, the
//! FIL lines.

use std::collections::HashMap;

/// A line of FIL that had a part in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FilLine {
    /// Number of the FIL file, from 0, in the order they were loaded: that of its name in
    /// `Program::fil_files`.
    pub file: u16,
    /// Line, 1-based.
    pub line: u32,
}

/// What made a block: a CL record and, where FIL wrote it, the FIL lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Number of the CL record, 1-based; 0 before the first record.
    pub record: u32,
    /// Line of the CL file, 1-based; 0 before the first record.
    pub line: u32,
    /// FIL call stack, innermost first; empty when no section was running.
    pub fil: Vec<FilLine>,
}

/// The cause of a word or a block, without memory of its own. The default is
/// the machine: its settings ask for the word, no record does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cause {
    /// Number of the CL record, 1-based; 0 for none.
    pub record: u32,
    /// Line of the CL file, 1-based; 0 for none.
    pub line: u32,
    /// The FIL call stack in [`Stacks`]; 0 when no section was running.
    pub stack: u32,
    /// The word of the record, as POSTF(7,n) counts; 0 for the record as a whole.
    pub word: u16,
    /// The record was made by a FIL statement: `word` counts its words.
    pub made_by_fil: bool,
}

impl Cause {
    /// The same record, as a whole.
    pub fn whole(self) -> Cause {
        Cause { word: 0, ..self }
    }

    /// True when the same record is behind both, and the same FIL lines.
    pub fn is_of_the_record(self, other: Cause) -> bool {
        (self.record, self.line, self.stack) == (other.record, other.line, other.stack)
    }
}

/// A FIL call stack, with the section it began in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stack {
    /// Number of the section; `None` for statements outside of sections.
    pub section: Option<u16>,
    /// The lines, innermost first.
    pub lines: Vec<FilLine>,
}

/// Most different stacks that are kept whole. Only recursion makes more; of
/// those the innermost line alone is kept, so that memory stays bounded.
const MOST: usize = 1 << 16;

/// Stacks that are looked at first.
const LATEST: usize = 8;

/// The FIL call stacks of a run, each once. Stack 0 is the empty one.
#[derive(Clone, Debug, Default)]
pub struct Stacks {
    stacks: Vec<Stack>,
    numbers: HashMap<Vec<FilLine>, u32>,
    /// The numbers that were asked for last: a section comes back to its few stacks.
    latest: [u32; LATEST],
}

impl Stacks {
    /// The number of a stack; the same stack gives the same number. Its last
    /// line lies in the section it began in, so that the lines alone tell
    /// stacks apart.
    pub fn number(
        &mut self,
        section: Option<u16>,
        lines: impl Iterator<Item = FilLine> + Clone,
    ) -> u32 {
        let is_it = |number: &u32| lines.clone().eq(self.lines(*number).iter().copied());
        if let Some(number) = self.latest.iter().copied().find(is_it) {
            return number;
        }
        let mut lines: Vec<FilLine> = lines.collect();
        if self.stacks.len() >= MOST {
            lines.truncate(1);
        }
        let number = match self.numbers.get(&lines) {
            _ if lines.is_empty() => 0,
            Some(number) => *number,
            None => self.add(Stack { section, lines }),
        };
        self.latest.rotate_right(1);
        self.latest[0] = number;
        number
    }

    /// The lines of a stack, innermost first.
    pub fn lines(&self, number: u32) -> &[FilLine] {
        let stack = (number as usize).checked_sub(1).and_then(|index| self.stacks.get(index));
        stack.map_or(&[], |stack| &stack.lines)
    }

    /// The stacks from 1 on, in the order they came.
    pub fn all(&self) -> &[Stack] {
        &self.stacks
    }

    /// A cause with its lines.
    pub fn origin(&self, cause: Cause) -> Origin {
        let fil = self.lines(cause.stack).to_vec();
        Origin { record: cause.record, line: cause.line, fil }
    }

    fn add(&mut self, stack: Stack) -> u32 {
        let number = self.stacks.len() as u32 + 1;
        self.numbers.insert(stack.lines.clone(), number);
        self.stacks.push(stack);
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(line: u32) -> FilLine {
        FilLine { file: 0, line }
    }

    #[test]
    fn a_stack_keeps_its_number() {
        let mut stacks = Stacks::default();
        let deep = [line(9), line(2)];
        assert_eq!(stacks.number(Some(0), deep.into_iter()), 1);
        assert_eq!(stacks.number(Some(0), [line(2)].into_iter()), 2);
        assert_eq!(stacks.number(Some(0), deep.into_iter()), 1);
        assert_eq!(stacks.number(None, std::iter::empty()), 0);
        assert_eq!((stacks.lines(1), stacks.lines(0)), (&deep[..], &[][..]));
    }

    #[test]
    fn recursion_does_not_fill_the_memory() {
        let mut stacks = Stacks::default();
        for depth in 0..MOST as u32 + 1000 {
            stacks.number(Some(0), [line(7), line(depth)].into_iter());
        }
        assert!(stacks.all().len() <= MOST + 1);
        let cut = stacks.number(Some(0), [line(7), line(u32::MAX)].into_iter());
        assert_eq!(stacks.lines(cut), [line(7)]);
    }
}
