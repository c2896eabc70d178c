//! NC text cut into blocks and words, as text: `X5.` and `X5.0` are two words.

/// A block without its line end.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Block {
    /// The sequence number as it is written, `N10`; empty without one.
    pub number: String,
    /// What follows the sequence number.
    pub text: String,
    /// The words of `text`.
    pub words: Vec<Word>,
    /// A blank is between two words.
    pub has_blank: bool,
}

impl Block {
    /// The block with its sequence number.
    pub fn whole(&self) -> String {
        format!("{} {}", self.number, self.text).trim().to_string()
    }
}

/// The text of each block without its sequence number, as a hash.
pub(crate) fn lines(blocks: &[Block]) -> Vec<u64> {
    blocks.iter().map(|block| hash(block.text.as_bytes())).collect()
}

/// Each block with its sequence number, as a hash.
pub(crate) fn numbered_lines(blocks: &[Block]) -> Vec<u64> {
    blocks.iter().map(|block| hash(block.whole().as_bytes())).collect()
}

/// A word of a block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Word {
    /// As it is written.
    pub text: String,
    /// Its letter in capitals; 0 for a comment, a mark or a word of several letters.
    pub letter: u8,
    /// Hash of the text.
    pub id: u64,
}

impl Word {
    fn new(text: &str) -> Word {
        let mut bytes = text.bytes();
        let first = bytes.next().unwrap_or(0).to_ascii_uppercase();
        let is_address = first.is_ascii_uppercase()
            && text.len() > 1
            && bytes.all(|byte| byte.is_ascii_digit() || b"+-.".contains(&byte));
        let letter = if is_address { first } else { 0 };
        Word { text: text.into(), letter, id: hash(text.as_bytes()) }
    }

    /// The number of an address as it is written.
    pub fn digits(&self) -> &str {
        if self.letter == 0 { "" } else { &self.text[1..] }
    }

    /// How the number of an address is written, whatever the number is: its letter, its sign,
    /// zeros in front and behind, and how many digits are after the point.
    pub fn form(&self) -> u64 {
        let digits = self.digits();
        let unsigned = digits.trim_start_matches(['+', '-']).as_bytes();
        let decimals = unsigned.iter().rev().position(|byte| *byte == b'.');
        let is = |at: Option<&u8>, byte: u8| u8::from(at == Some(&byte));
        hash(&[
            self.letter,
            u8::from(digits.starts_with('+')),
            is(unsigned.first(), b'0'),
            is(unsigned.first(), b'.'),
            is(unsigned.last(), b'0'),
            decimals.map_or(u8::MAX, |count| count.min(9) as u8),
        ])
    }

    /// The number of an address.
    pub fn value(&self) -> Option<f64> {
        self.digits().parse().ok().filter(|_| self.letter != 0)
    }
}

/// A hash that is the same on every machine (FNV-1a).
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// The blocks of a program; empty lines are left out.
pub(crate) fn blocks(text: &[u8]) -> Vec<Block> {
    let text = String::from_utf8_lossy(text);
    text.lines().map(|line| block(line.trim_end())).filter(|b| !b.text.is_empty()).collect()
}

fn block(line: &str) -> Block {
    let line = line.trim_start();
    let (number, rest) = sequence_number(line);
    let text = rest.trim_start();
    let mut block = Block { number: number.into(), text: text.into(), ..Block::default() };
    let mut rest = text;
    while !rest.is_empty() {
        let length = word_length(rest);
        block.words.push(Word::new(&rest[..length]));
        let after = rest[length..].trim_start();
        block.has_blank |= !after.is_empty() && after.len() < rest.len() - length;
        rest = after;
    }
    block
}

/// `N10` or, in Klartext, `10`.
fn sequence_number(line: &str) -> (&str, &str) {
    let letters = usize::from(line.starts_with(['N', 'n']));
    let digits = line[letters..].bytes().take_while(u8::is_ascii_digit).count();
    if digits == 0 { ("", line) } else { line.split_at(letters + digits) }
}

/// The length of the first word of a text that begins with one.
fn word_length(text: &str) -> usize {
    let first = text.as_bytes()[0];
    let up_to = |end: char| text.find(end).map_or(text.len(), |at| at + end.len_utf8());
    if first == b'(' {
        return up_to(')');
    }
    if first == b';' {
        return text.len();
    }
    if first == b'"' {
        return 1 + text[1..].find('"').map_or(text.len() - 1, |at| at + 1);
    }
    let letters = text.bytes().take_while(u8::is_ascii_alphabetic).count();
    if letters > 0 {
        let number = |byte: &u8| byte.is_ascii_digit() || b"+-.".contains(byte);
        return letters + text.as_bytes()[letters..].iter().take_while(|byte| number(byte)).count();
    }
    let digits = text.bytes().take_while(|byte| byte.is_ascii_digit() || *byte == b'.').count();
    if digits > 0 { digits } else { text.chars().next().map_or(1, char::len_utf8) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(line: &str) -> (String, Vec<String>) {
        let block = block(line);
        (block.number.clone(), block.words.into_iter().map(|word| word.text).collect())
    }

    #[test]
    fn a_block_is_cut_with_and_without_blanks() {
        let words = ["G1", "X-5.", "F200", "(A B)"].map(String::from).to_vec();
        assert_eq!(texts("N10 G1 X-5. F200 (A B)"), ("N10".into(), words.clone()));
        assert_eq!(texts("N10G1X-5.F200(A B)"), ("N10".into(), words));
        assert_eq!(texts("%"), (String::new(), vec!["%".into()]));
        let klartext = ["L", "X+10", "R0", "FMAX"].map(String::from).to_vec();
        assert_eq!(texts("12 L X+10 R0 FMAX"), ("12".into(), klartext));
    }
}
