//! Marks of the tape that are not those of every control: what begins a block that may
//! be skipped, what ends each block, what stands in place of N, what a leader is made of.

use std::borrow::Cow;

use super::Settings;

/// What the reader of blocks knows.
pub(crate) const SKIP: u8 = b'/';
const NUMBER: u8 = b'N';

/// The marks of a machine; `None` where it has those that the reader knows, or none.
#[derive(Clone, Debug, Default)]
pub(crate) struct Marks {
    skip: Option<u8>,
    end: Option<u8>,
    /// A letter that stands alone in the last line, in place of `%`.
    last: Option<u8>,
    align: Option<u8>,
    leader: Option<u8>,
    /// What opens and closes a message in place of parentheses.
    message: Option<[u8; 2]>,
}

impl Marks {
    pub(super) fn new(settings: &Settings<'_>) -> Self {
        let mark = |key: &str| {
            let code = settings.code(key).and_then(|code| u8::try_from(code).ok());
            code.filter(u8::is_ascii_graphic)
        };
        let has = |key: &str, value: i32| settings.code(key) == Some(value);
        let leads = settings.number("tape.leader").is_some_and(|length| length > 0.0);
        Marks {
            skip: mark("tape.opskip_char").filter(|mark| *mark != SKIP),
            end: mark("tape.end_of_block_char").filter(|_| has("tape.end_of_block", 2)),
            last: mark("tape.end_char").filter(u8::is_ascii_uppercase),
            align: mark("tape.align_char").filter(|_| has("seqno.align", 1)),
            leader: mark("tape.leader_char").filter(|_| leads),
            message: match (mark("message.out_char"), mark("message.in_char")) {
                (Some(open @ b'['), Some(close @ b']')) => Some([open, close]),
                _ => None,
            },
        }
    }

    /// A line with the marks that the reader of blocks knows; bytes keep their places.
    pub(crate) fn read<'t>(&self, line: &'t [u8]) -> Cow<'t, [u8]> {
        let Marks { skip, end, last, align, leader, message } = self;
        if [skip, end, last, align, leader].iter().all(|mark| mark.is_none()) && message.is_none() {
            return Cow::Borrowed(line);
        }
        if last.is_some_and(|last| *line == [last]) {
            return Cow::Borrowed(b"%");
        }
        let is_leader = |leader: u8| !line.is_empty() && line.iter().all(|byte| *byte == leader);
        if self.leader.is_some_and(is_leader) {
            return Cow::Borrowed(b"");
        }
        let mut read = line.to_vec();
        if self.end.is_some() && read.last().copied() == self.end {
            read.pop();
        }
        let mut first = 0;
        if self.skip.is_some() && read.first().copied() == self.skip {
            read[0] = SKIP;
        }
        if read.first() == Some(&SKIP) {
            first = 1;
        }
        let numbered = read.get(first + 1).is_some_and(u8::is_ascii_digit);
        if numbered && self.align.is_some() && read.get(first).copied() == self.align {
            read[first] = NUMBER;
        }
        if let Some(marks) = self.message {
            enclose_message(&mut read, marks);
        }
        Cow::Owned(read)
    }
}

/// Gives the message of a line its parentheses; those that it holds become blanks.
fn enclose_message(line: &mut [u8], [open, close]: [u8; 2]) {
    let Some(first) = line.iter().position(|byte| *byte == open) else { return };
    let Some(length) = line[first..].iter().position(|byte| *byte == close) else { return };
    for byte in &mut line[first..first + length] {
        if matches!(*byte, b'(' | b')') {
            *byte = b' ';
        }
    }
    (line[first], line[first + length]) = (b'(', b')');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_become_those_of_every_control() {
        let marks = Marks {
            skip: Some(b'*'),
            end: Some(b'$'),
            last: Some(b'E'),
            align: Some(b':'),
            leader: Some(b'.'),
            message: Some(*b"[]"),
        };
        for (line, read) in [
            ("*:20 T1 M6$", "/N20 T1 M6"),
            (":20 T1 M6$", "N20 T1 M6"),
            ("N20 X1.", "N20 X1."),
            ("G1 X1. (COST 5$)$", "G1 X1. (COST 5$)"),
            ("....", ""),
            ("E", "%"),
            ("N5 [TURN (ALL) PARTS] M0", "N5 (TURN  ALL  PARTS) M0"),
        ] {
            assert_eq!(marks.read(line.as_bytes()), read.as_bytes(), "{line}");
        }
        assert!(matches!(Marks::default().read(b"*N1$"), Cow::Borrowed(b"*N1$")));
    }
}
