//! The frame of the part as CATIA writes it: three comments in a row with four numbers each.
//!
//! They are the rows of a 3x4 matrix, the origin in the fourth column. They become a note
//! CATIA0 with twelve numbers, after the line `$$*CATIA0` that stands before most of them.

/// Name of the note.
const NAME: &str = "CATIA0";

/// The rows that have come so far.
#[derive(Default)]
pub(super) struct FrameRows {
    rows: Vec<String>,
}

impl FrameRows {
    /// Looks at a comment; gives the note when it holds the third row.
    pub(super) fn take(&mut self, comment: &[u8]) -> Option<String> {
        match row(comment) {
            Some(row) => self.rows.push(row),
            None => self.rows.clear(),
        }
        (self.rows.len() == 3)
            .then(|| format!("{NAME}/{}", std::mem::take(&mut self.rows).join(",")))
    }

    /// Something else than a comment came.
    pub(super) fn clear(&mut self) {
        self.rows.clear();
    }
}

/// The four numbers of a row, between commas.
fn row(comment: &[u8]) -> Option<String> {
    let text = std::str::from_utf8(comment.trim_ascii().strip_prefix(b"$$")?).ok()?;
    let items: Vec<&str> = text.split_ascii_whitespace().collect();
    let is_number = |item: &&str| item.contains('.') && item.parse::<f64>().is_ok();
    (items.len() == 4 && items.iter().all(is_number)).then(|| items.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_rows_in_a_row_make_a_frame() {
        let mut rows = FrameRows::default();
        let mut all = |lines: &[&str]| {
            lines.iter().filter_map(|line| rows.take(line.as_bytes())).collect::<Vec<_>>()
        };
        let one = "$$  1.0 0.0  0.0 5.0";
        assert_eq!(
            all(&[one, one, one]),
            ["CATIA0/1.0,0.0,0.0,5.0,1.0,0.0,0.0,5.0,1.0,0.0,0.0,5.0"]
        );
        assert!(all(&[one, one, "$$ a name", one]).is_empty());
        assert!(all(&["$$ 1.0 0.0 0.0", "$$ 1 2 3 4", "$$ 1.0 0.0 0.0 x"]).is_empty());
    }
}
