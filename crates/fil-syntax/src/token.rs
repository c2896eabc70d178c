//! The signs and words a FIL text is made of.

/// A token as the grammar takes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Token<'s> {
    /// The end of a statement.
    End,
    /// `NAME)` at the start of a statement, without the bracket.
    Label(&'s str),
    Name(&'s str),
    Integer(&'s str),
    Real(f64),
    /// With its apostrophes.
    Text(&'s str),
    /// What follows PPRINT and its like, unquoted.
    FreeText(&'s str),
    /// What follows INCLUD/, unquoted.
    FileName(&'s str),
    Open,
    Close,
    Comma,
    Equals,
    Plus,
    Minus,
    Star,
    Slash,
    Power,
    Eq,
    Ne,
    Lt,
    Le,
    Gt,
    Ge,
    And,
    Or,
    Not,
    If,
    Then,
    ElseIf,
    Else,
    EndIf,
    Do,
    Case,
    When,
    EndCas,
    JumpTo,
    Call,
    Reserv,
    Print,
    Redef,
    Includ,
    Contin,
    Fini,
    Macro,
    Termac,
    TextWord,
    Cimfil,
    /// Something no statement can hold.
    Bad(Bad),
}

/// Why a token cannot stand in any statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bad {
    /// A character FIL has no use for outside of texts and comments.
    Character,
    /// A text without its closing apostrophe.
    UnclosedText,
    /// `.XX.` that is no operator.
    Operator,
    /// A number beyond what a real can hold.
    Number,
    /// Brackets, signs or powers inside each other without end.
    Depth,
    /// A statement without end.
    Length,
}

/// Words that take the rest of their line as it is.
pub(crate) const FREE_TEXT_WORDS: [&str; 7] =
    ["PARTNO", "PPRINT", "INSERT", "LETTER", "REMARK", "TITLES", "TPRINT"];

/// Words that open a statement of their own kind, and their tokens.
const STATEMENT_WORDS: [(&str, Token<'static>); 20] = [
    ("IF", Token::If),
    ("ELSEIF", Token::ElseIf),
    ("ELSE", Token::Else),
    ("ENDIF", Token::EndIf),
    ("DO", Token::Do),
    ("CASE", Token::Case),
    ("WHEN", Token::When),
    ("ENDCAS", Token::EndCas),
    ("JUMPTO", Token::JumpTo),
    ("CALL", Token::Call),
    ("RESERV", Token::Reserv),
    ("PRINT", Token::Print),
    ("REDEF", Token::Redef),
    ("INCLUD", Token::Includ),
    ("CONTIN", Token::Contin),
    ("FINI", Token::Fini),
    ("TERMAC", Token::Termac),
    ("CIMFIL", Token::Cimfil),
    ("SIMFIL", Token::Cimfil),
    ("THEN", Token::Then),
];

/// The token of a word that opens a statement. `THEN` counts as one: it stands
/// where the statement of a one-line IF would.
pub(crate) fn statement_word(word: &str) -> Option<Token<'static>> {
    let found = STATEMENT_WORDS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word));
    found.map(|(_, token)| *token)
}

/// True for a word that opens a statement of its own kind, letters in any case.
pub fn is_statement_word(word: &str) -> bool {
    statement_word(word).is_some()
        || ["MACRO", "TEXT"].iter().any(|own| own.eq_ignore_ascii_case(word))
}

/// The token of an operator between points.
pub(crate) fn operator(text: &str) -> Token<'static> {
    const OPERATORS: [(&str, Token<'static>); 9] = [
        (".EQ.", Token::Eq),
        (".NE.", Token::Ne),
        (".LT.", Token::Lt),
        (".LE.", Token::Le),
        (".GT.", Token::Gt),
        (".GE.", Token::Ge),
        (".AND.", Token::And),
        (".OR.", Token::Or),
        (".NOT.", Token::Not),
    ];
    let found = OPERATORS.iter().find(|(name, _)| name.eq_ignore_ascii_case(text));
    found.map_or(Token::Bad(Bad::Operator), |(_, token)| *token)
}

/// The token of a number with a point or an exponent, `D` being an exponent too.
pub(crate) fn real(text: &str) -> Token<'static> {
    let value = text.replace(['D', 'd'], "E").parse().unwrap_or(f64::INFINITY);
    if value.is_finite() { Token::Real(value) } else { Token::Bad(Bad::Number) }
}

/// The token of a whole number; it keeps its text because it may be a label.
pub(crate) fn integer(text: &str) -> Token<'_> {
    let finite = text.parse().is_ok_and(f64::is_finite);
    if finite { Token::Integer(text) } else { Token::Bad(Bad::Number) }
}

#[cfg(test)]
mod tests {
    use logos::Logos;

    use super::*;
    use crate::lexer::Raw;

    fn raws(text: &str) -> Vec<(Raw, &str)> {
        let lexer = Raw::lexer(text).spanned();
        lexer.map(|(raw, range)| (raw.expect("a token"), &text[range])).collect()
    }

    #[test]
    fn a_point_before_an_operator_is_not_part_of_the_number() {
        use Raw::*;
        assert_eq!(raws("5.EQ.6"), [(IntegerAndOperator, "5.EQ."), (Integer, "6")]);
        assert_eq!(raws("5..EQ..6"), [(Real, "5."), (Operator, ".EQ."), (Real, ".6")]);
        assert_eq!(raws("5.E2.EQ.X"), [(Real, "5.E2"), (Operator, ".EQ."), (Name, "X")]);
        assert_eq!(raws("00 90. 1d-5"), [(Integer, "00"), (Real, "90."), (Real, "1d-5")]);
    }

    #[test]
    fn only_a_lone_dollar_continues_a_line() {
        use Raw::*;
        assert_eq!(raws("A $\r\nB $ $$ note\nC"), [(Name, "A"), (Name, "B"), (Name, "C")]);
        assert_eq!(raws("A $$$ B\nC"), [(Name, "A"), (Newline, "\n"), (Name, "C")]);
    }

    #[test]
    fn apostrophes_are_doubled_inside_texts() {
        use Raw::*;
        assert_eq!(raws("'a''b' 'c'"), [(Text, "'a''b'"), (Text, "'c'")]);
        assert_eq!(raws("'a'''"), [(Text, "'a'''")]);
        assert_eq!(raws("'a''"), [(UnclosedText, "'a''")]);
    }

    #[test]
    fn numbers_out_of_range_are_bad() {
        assert_eq!(real("1D2"), Token::Real(100.0));
        assert_eq!(real("1E999"), Token::Bad(Bad::Number));
        assert_eq!(integer(&"9".repeat(400)), Token::Bad(Bad::Number));
    }
}
