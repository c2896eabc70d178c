//! What functions, forms of TEXT/ and statements of our own ask of the machine beyond
//! numbers: texts, outside files, messages, clock and commands.

use fil_syntax::tree::{Expr, ExprKind};

use crate::ops::Reg;
use crate::totals::TotalsList;

/// What a call of the library does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Library {
    /// LNTHF
    Length,
    /// INDXF
    Position,
    /// CMPF and CMPRF
    Compare,
    /// ICHARF
    CharacterCode,
    /// SCALF
    ToNumber,
    /// TEXT/CONVI and CONVI
    WholeToText,
    /// TEXT/CONVF, CONVF and TEXTF
    ToText,
    /// TEXT/CLW
    RecordText,
    /// TEXT/PART and TEXT/RANGE
    Part,
    /// TEXT/REPEAT
    Repeat,
    /// TEXT/LAST
    Last,
    /// TEXT/OMIT
    Omit,
    /// TEXT/MODIFY
    Modify,
    /// TEXT/UP
    Upper,
    /// TEXT/LOW
    Lower,
    /// TEXT/READ
    ReadLine,
    /// WRITE/
    WriteLine,
    /// ERROR/
    Refuse,
    /// WARN/
    Warn,
    /// FILEF
    File(FileOp),
    /// DATEF
    Date,
    /// TIMEF
    Time,
    /// SPAWNF
    Spawn,
    /// TEXT/PROG, TEXT/TLIST and TEXT/OPER
    TotalsText(TotalsList),
}

/// The second argument of FILEF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileOp {
    /// Open to read.
    Read,
    /// Open to write a new file.
    Write,
    /// Open to write at the end.
    Append,
    /// Close.
    Close,
    /// Back to the first line.
    Rewind,
    /// Delete the file.
    Delete,
    /// Is a line left to read?
    End,
}

impl FileOp {
    /// The words of FILEF.
    pub(crate) const WORDS: [(&'static str, FileOp); 7] = [
        ("READ", FileOp::Read),
        ("WRITE", FileOp::Write),
        ("APPEND", FileOp::Append),
        ("CLOSE", FileOp::Close),
        ("REWIND", FileOp::Rewind),
        ("DELETE", FileOp::Delete),
        ("END", FileOp::End),
    ];

    /// True when the name of a file follows the word.
    pub(crate) fn takes_name(self) -> bool {
        matches!(self, FileOp::Read | FileOp::Write | FileOp::Append | FileOp::Delete)
    }
}

/// How a number is written as text: the minor words after its digits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct NumberRules {
    /// PLUS: a + stands before positive numbers.
    pub plus: bool,
    /// ZEROS: zeros fill the width, not blanks.
    pub zeros: bool,
    /// TRIM: no zeros at the end of the decimals.
    pub trim: bool,
    /// POINT: whole numbers have a point too.
    pub point: bool,
    /// NOLEAD: no zero before the point.
    pub no_lead: bool,
}

impl NumberRules {
    /// Takes a minor word; false when it is none of the rules.
    pub fn take(&mut self, word: &str) -> bool {
        let rule = match word {
            "PLUS" => &mut self.plus,
            "ZEROS" => &mut self.zeros,
            "TRIM" => &mut self.trim,
            "POINT" => &mut self.point,
            "NOLEAD" => &mut self.no_lead,
            _ => return false,
        };
        *rule = true;
        true
    }
}

impl Library {
    /// The values of a call, and the rules that stand behind them as words.
    pub(crate) fn rules(self, mut args: &[Expr]) -> (&[Expr], NumberRules) {
        let mut rules = NumberRules::default();
        if matches!(self, Library::WholeToText | Library::ToText) {
            while let [before @ .., Expr { kind: ExprKind::Name(word), .. }] = args
                && !before.is_empty()
                && rules.take(word)
            {
                args = before;
            }
        }
        (args, rules)
    }
}

/// A call of the library; its arguments are in consecutive registers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LibraryCall {
    /// What it does.
    pub library: Library,
    /// First argument.
    pub base: Reg,
    /// Number of arguments.
    pub count: u16,
    /// How a number is written.
    pub rules: NumberRules,
}
