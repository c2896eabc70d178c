//! The frame of the part as CATIA writes it: three comments in a row with four numbers each.
//!
//! They are the rows of a 3x4 matrix, the origin in the fourth column, and stand behind a comment
//! with a name, most of them behind `$$*CATIA0` before that. They become a note CATIA0 with twelve
//! numbers. Rows behind `$$*CATIA0` that can't be read become one with the number of their line, so
//! that they are no other frame's.

/// Name of the note.
const NAME: &str = "CATIA0";

/// What stands before the name and the rows.
const HEAD: &[u8] = b"*CATIA0";

/// Comments behind the head: a name, and three rows.
const BEHIND_HEAD: usize = 4;

/// The rows that have come so far.
#[derive(Default)]
pub(super) struct FrameRows {
    rows: Vec<String>,
    /// Comments since the head; `None` without one.
    behind_head: Option<usize>,
}

impl FrameRows {
    /// Looks at the comment of a line; gives the note when it is the last row.
    pub(super) fn take(&mut self, comment: &[u8], line: u32) -> Option<String> {
        let text = comment.trim_ascii().strip_prefix(b"$$").unwrap_or(comment).trim_ascii();
        if text.starts_with(HEAD) {
            let unread = self.end(line);
            (self.rows, self.behind_head) = (Vec::new(), Some(0));
            return unread;
        }
        match row(text) {
            Some(row) => self.rows.push(row),
            None => self.rows.clear(),
        }
        self.behind_head = self.behind_head.map(|count| count + 1);
        if self.rows.len() == 3 {
            self.behind_head = None;
            return Some(format!("{NAME}/{}", std::mem::take(&mut self.rows).join(",")));
        }
        (self.behind_head == Some(BEHIND_HEAD)).then(|| {
            self.behind_head = None;
            unreadable(line)
        })
    }

    /// A statement comes in a line; gives the note of rows that did not all come.
    pub(super) fn end(&mut self, line: u32) -> Option<String> {
        self.rows.clear();
        self.behind_head.take().filter(|count| *count > 0).map(|_| unreadable(line))
    }
}

fn unreadable(line: u32) -> String {
    format!("{NAME}/UNREAD,{line}")
}

/// The four numbers of a row, between commas; one of them has a decimal point.
fn row(text: &[u8]) -> Option<String> {
    let text = std::str::from_utf8(text).ok()?;
    let items: Vec<&str> = text.split_ascii_whitespace().collect();
    let is_number = |item: &&str| item.parse::<f64>().is_ok_and(f64::is_finite);
    let is_row = items.len() == 4 && items.iter().all(is_number) && text.contains('.');
    is_row.then(|| items.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn notes(lines: &[&str]) -> Vec<String> {
        let mut rows = FrameRows::default();
        let all = lines.iter().zip(1..);
        all.filter_map(|(line, number)| rows.take(line.as_bytes(), number)).collect()
    }

    #[test]
    fn three_rows_in_a_row_make_a_frame() {
        let one = "$$  1.0 0.0  0.0 5";
        let frame = "CATIA0/1.0,0.0,0.0,5,1.0,0.0,0.0,5,1.0,0.0,0.0,5";
        assert_eq!(notes(&[one, one, one]), [frame]);
        assert_eq!(notes(&["$$*CATIA0", "$$ a name", one, one, one, "$$ 1 2 3 4"]), [frame]);
        assert!(notes(&[one, one, "$$ a name", one]).is_empty());
        assert!(notes(&["$$ 1.0 0.0 0.0", "$$ 1 2 3 4", "$$ 1.0 0.0 0.0 x"]).is_empty());
    }

    #[test]
    fn rows_that_cannot_be_read_are_a_frame_of_their_own() {
        let one = "$$ 1.0 0.0 0.0 5.0";
        let wrong = ["$$*CATIA0", "$$ a name", one, "$$ 1.0 0.0 0.0-1000.0", one];
        assert_eq!(notes(&wrong), ["CATIA0/UNREAD,5"]);
        let mut rows = FrameRows::default();
        assert_eq!(rows.take(b"$$*CATIA0", 1), None);
        assert_eq!(rows.end(2), None, "a sign of the system, and no frame");
        assert_eq!(rows.take(b"$$*CATIA0", 3), None);
        assert_eq!(rows.take(b"$$ 1.0 0.0 0.0 5.0", 4), None);
        assert_eq!(rows.end(5).as_deref(), Some("CATIA0/UNREAD,5"));
        assert_eq!(rows.end(6), None);
    }
}
