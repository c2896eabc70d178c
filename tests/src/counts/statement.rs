//! Statements of a CL text, cut into their items, and changes of them.

use std::ops::Range;

/// A statement of a CL text.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Its text, with the ends of continued lines.
    pub text: String,
    /// The major word; empty for a comment.
    pub major: String,
    /// It is written behind an arrow in a comment, as Creo does.
    pub in_comment: bool,
    /// Its items: their ranges in the text.
    pub items: Vec<Range<usize>>,
    /// Line of the CL file, 1-based.
    pub line: usize,
}

/// Words whose rest is text and not a list of items.
const TEXTS: [&str; 9] =
    ["PARTNO", "PPRINT", "INSERT", "LETTER", "REMARK", "TITLES", "TPRINT", "TOOL PATH", "OP_NAME"];

/// What begins a comment, and with an arrow a statement of Creo.
const COMMENT: &str = "$$";
const ARROW: &str = "$$->";

/// The end of a line that the next one continues.
const CONTINUED: &str = "$\n";

/// The statements of a CL text; comments are among them, as the reader may know the
/// dialect by them.
pub fn statements(cl: &str) -> Vec<Statement> {
    let mut all = Vec::new();
    let mut open: Option<(usize, String)> = None;
    for (index, line) in cl.lines().enumerate() {
        let (first, mut text) = open.take().unwrap_or((index + 1, String::new()));
        text.push_str(line.trim_end());
        let begin = text.trim_start();
        let is_comment = begin.starts_with(COMMENT) && !begin.starts_with(ARROW);
        let is_text = TEXTS.iter().any(|word| begin.starts_with(word));
        if text.ends_with('$') && !is_comment && !is_text {
            text.push('\n');
            open = Some((first, text));
        } else if !text.trim().is_empty() {
            all.push(statement(text, first));
        }
    }
    all.extend(open.map(|(line, text)| statement(text, line)));
    all
}

fn statement(text: String, line: usize) -> Statement {
    let begin = text.len() - text.trim_start().len();
    let (in_comment, begin) = match text[begin..].strip_prefix(ARROW) {
        Some(rest) => (true, text.len() - rest.trim_start().len()),
        None if text[begin..].starts_with(COMMENT) => {
            return Statement {
                text,
                major: String::new(),
                in_comment: true,
                items: Vec::new(),
                line,
            };
        }
        None => (false, begin),
    };
    let (major, rest) = match text[begin..].find('/') {
        Some(slash) => (text[begin..begin + slash].trim(), begin + slash + 1),
        None => {
            let end = begin + text[begin..].find(' ').unwrap_or(text.len() - begin);
            (&text[begin..end], end)
        }
    };
    let major = major.to_string();
    let items = match TEXTS.contains(&&major[..]) {
        true if text[rest..].trim().is_empty() => Vec::new(),
        true => std::iter::once(rest..text.len()).collect(),
        false => items(&text, rest),
    };
    Statement { text, major, in_comment, items, line }
}

/// The items between commas that stand outside of brackets, up to a comment.
fn items(text: &str, from: usize) -> Vec<Range<usize>> {
    let end = text[from..].find(COMMENT).map_or(text.len(), |at| from + at);
    let mut items = Vec::new();
    let (mut start, mut depth) = (from, 0);
    for (at, character) in text[from..end].char_indices().map(|(at, c)| (from + at, c)) {
        match character {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth == 0 => {
                items.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
    }
    if !text[start..end].trim().is_empty() || !items.is_empty() {
        items.push(start..end);
    }
    items
}

/// How an item is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Change {
    /// It is left out.
    Drop,
    /// A word is left out with the number behind it.
    DropCouplet,
    /// A number becomes another, a word another word.
    Other,
    /// A word becomes one that nobody knows.
    Banana,
    /// A word that nobody knows is added behind the last item.
    AddBanana,
    /// A number is added behind the last item.
    AddNumber,
}

/// The changes of an item.
pub const OF_AN_ITEM: [Change; 4] =
    [Change::Drop, Change::DropCouplet, Change::Other, Change::Banana];

/// The changes at the end of a statement.
pub const AT_THE_END: [Change; 2] = [Change::AddBanana, Change::AddNumber];

/// Words that are changed into one that means something else.
const OTHERS: [(&str, &str); 14] = [
    ("ON", "OFF"),
    ("OFF", "ON"),
    ("CLW", "CCLW"),
    ("CCLW", "CLW"),
    ("MMPM", "IPM"),
    ("IPM", "MMPM"),
    ("MMPR", "MMPM"),
    ("MM", "INCHES"),
    ("INCHES", "MM"),
    ("LEFT", "RIGHT"),
    ("RIGHT", "LEFT"),
    ("DRILL", "DEEP"),
    ("FLOOD", "MIST"),
    ("CLOCKWISE", "COUNTERCLOCKWISE"),
];

impl Statement {
    /// The text of an item.
    pub fn item(&self, index: usize) -> String {
        self.text[self.items[index].clone()].replace(CONTINUED, "").trim().to_string()
    }

    /// True for a statement whose rest is text.
    pub fn is_text(&self) -> bool {
        TEXTS.contains(&&self.major[..])
    }

    /// True for an item that is a number.
    pub fn is_number(&self, index: usize) -> bool {
        index < self.items.len() && self.item(index).parse::<f64>().is_ok()
    }

    fn is_word(&self, index: usize) -> bool {
        self.item(index).starts_with(|c: char| c.is_ascii_alphabetic())
    }

    /// Kinds of the items, to tell statements of one form: `GOTO 000`.
    pub fn shape(&self) -> String {
        if self.is_text() {
            return self.major.clone();
        }
        let kind = |index| {
            if self.is_number(index) { "0".to_string() } else { format!(" {}", self.item(index)) }
        };
        let kinds: String = (0..self.items.len()).map(kind).collect();
        format!("{} {kinds}", self.major)
    }

    /// The minor word that a number belongs to: the word before it.
    pub fn word_before(&self, index: usize) -> Option<String> {
        let before = index.checked_sub(1)?;
        (self.is_number(index) && self.is_word(before)).then(|| self.item(before))
    }

    /// The text with a change at an item; `None` when there is no such change.
    pub fn changed(&self, index: usize, change: Change) -> Option<String> {
        let number = self.is_number(index);
        match change {
            _ if index < self.items.len() && self.item(index).is_empty() => None,
            Change::Drop => Some(self.without(index..index + 1)),
            Change::DropCouplet if self.is_text() || number => None,
            Change::DropCouplet => {
                self.is_number(index + 1).then(|| self.without(index..index + 2))
            }
            Change::Other if self.is_text() => {
                Some(self.with(index, &format!("{}7", self.item(index))))
            }
            Change::Other => Some(self.with(index, &other(&self.item(index)))),
            Change::Banana if number || self.is_text() => None,
            Change::Banana => Some(self.with(index, "BANANA")),
            Change::AddBanana => self.with_one_more("BANANA"),
            Change::AddNumber => self.with_one_more("7.25"),
        }
    }

    fn with(&self, index: usize, new: &str) -> String {
        let mut text = self.text.clone();
        text.replace_range(self.items[index].clone(), &format!(" {new}"));
        text
    }

    fn with_one_more(&self, new: &str) -> Option<String> {
        if self.is_text() {
            return None;
        }
        let mut text = self.text.clone();
        match self.items.last() {
            Some(last) => text.insert_str(last.end, &format!(", {new}")),
            None if text.contains('/') => text.push_str(&format!(" {new}")),
            None => text.push_str(&format!(" / {new}")),
        }
        Some(text)
    }

    /// The text without some items and as many of the commas.
    fn without(&self, gone: Range<usize>) -> String {
        let (start, end) = (self.items[gone.start].start, self.items[gone.end - 1].end);
        let range = match gone.start {
            0 if self.items.len() > gone.end => start..end + 1,
            0 => start..end,
            _ => start - 1..end,
        };
        let mut text = self.text.clone();
        text.replace_range(range, "");
        text
    }
}

fn other(item: &str) -> String {
    let Ok(number) = item.parse::<f64>() else {
        let known = OTHERS.iter().find(|(word, _)| *word == item);
        return known.map_or("XAXIS", |(_, other)| other).to_string();
    };
    let whole = !item.contains('.');
    if whole { format!("{}", number + 1.0) } else { format!("{:.4}", number + 1.375) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_are_cut_into_items() {
        let cl = "$$ a comment\nPARTNO / A, B $\nCYCLE / DRILL, DEPTH, $\n 5., CLEAR $$ C, D\nRAPID\n\
                  $$-> CUTTER / 5.\n";
        let all = statements(cl);
        assert_eq!(all.len(), 5);
        assert_eq!((all[0].major.as_str(), all[0].items.len()), ("", 0));
        assert_eq!((all[1].major.as_str(), all[1].items.len()), ("PARTNO", 1));
        assert_eq!((all[2].line, all[2].item(2)), (3, "5.".to_string()));
        assert_eq!(all[2].word_before(2).unwrap(), "DEPTH");
        assert_eq!(all[2].shape(), "CYCLE  DRILL DEPTH0 CLEAR");
        assert!(all[3].items.is_empty());
        assert_eq!((all[4].major.as_str(), all[4].item(0)), ("CUTTER", "5.".to_string()));
    }

    #[test]
    fn items_are_changed() {
        let statement = statements("FEDRAT / MMPM, 5.").remove(0);
        let changed = |index, change| statement.changed(index, change);
        assert_eq!(changed(0, Change::Drop).unwrap(), "FEDRAT / 5.");
        assert_eq!(changed(1, Change::Drop).unwrap(), "FEDRAT / MMPM");
        assert_eq!(changed(0, Change::DropCouplet).unwrap(), "FEDRAT /");
        assert_eq!(changed(0, Change::Other).unwrap(), "FEDRAT / IPM, 5.");
        assert_eq!(changed(1, Change::Other).unwrap(), "FEDRAT / MMPM, 6.3750");
        assert_eq!(changed(0, Change::Banana).unwrap(), "FEDRAT / BANANA, 5.");
        assert_eq!(changed(1, Change::Banana), None);
        assert_eq!(changed(0, Change::AddBanana).unwrap(), "FEDRAT / MMPM, 5., BANANA");
        let rapid = statements("RAPID").remove(0);
        assert_eq!(rapid.changed(0, Change::AddNumber).unwrap(), "RAPID / 7.25");
    }
}
