//! Habits of other languages: what to write in FIL where a statement was written as
//! in another one.

use crate::token::Token;

/// A statement that was not understood.
pub(crate) struct Refused<'s> {
    /// The line it stands on, without comment.
    pub line: &'s str,
    /// Byte of the line where understanding ended.
    pub at: usize,
    /// What was found there.
    pub token: Token<'s>,
}

/// Signs of other languages, the longest first, with what FIL has for them.
const SIGNS: [(&str, &str); 22] = [
    ("//", "a comment begins with $$"),
    ("/*", "a comment begins with $$ and runs to the end of the line"),
    ("==", "equality is .EQ."),
    ("!=", "inequality is .NE."),
    ("<>", "inequality is .NE."),
    ("/=", "inequality is .NE."),
    ("<=", "less or equal is .LE."),
    (">=", "greater or equal is .GE."),
    (":=", "a value is set with =, as in NN=1"),
    ("+=", "write the name again: NN=NN+1"),
    ("-=", "write the name again: NN=NN-1"),
    ("++", "write the name again: NN=NN+1"),
    ("&&", "both conditions are joined by .AND."),
    ("||", "one of two conditions is .OR."),
    ("<", "less than is .LT."),
    (">", "greater than is .GT."),
    ("&", "both conditions are joined by .AND.; texts are joined by TEXT/a,b"),
    ("|", "one of two conditions is .OR."),
    ("^", "a power is **, as in 2**3"),
    ("\"", "a text needs apostrophes: 'TEXT'"),
    ("[", "a subscript needs round brackets: TAB(1)"),
    ("{", "a block is IF(condition)THEN … ENDIF"),
];

/// Words that FIL writes between points.
const POINTED: [&str; 9] = ["AND", "OR", "NOT", "EQ", "NE", "LT", "LE", "GT", "GE"];

/// Words that begin a statement of other languages, with what FIL has for it.
const STATEMENTS: [(&str, &str); 12] = [
    ("FOR", "loops are DO/label,variable=from,to and, after their statements, label) CONTIN"),
    ("WHILE", "loops are DO/label,… or a label and JUMPTO/label"),
    ("REPEAT", "REPEAT/letter,value adds a word to each motion; loops are DO/label,…"),
    ("NEXT", "a DO ends with the statement that bears its label: label) CONTIN"),
    ("SWITCH", "write CASE/value, WHEN/value, WHEN/OTHER and ENDCAS"),
    ("SELECT", "write CASE/value, WHEN/value, WHEN/OTHER and ENDCAS"),
    ("DIM", "an array is declared by RESERV/name,size"),
    ("LET", "a value is set with = alone, as in NN=1"),
    ("GOTO", "a jump is JUMPTO/label"),
    ("GO", "a jump is JUMPTO/label"),
    ("SUB", "a macro is name=MACRO/parameters … TERMAC"),
    ("FUNCTION", "a macro is name=MACRO/parameters … TERMAC"),
];

/// What FIL has for the habit that the statement shows; `None` where it shows none.
pub(crate) fn hint(refused: &Refused<'_>) -> Option<String> {
    let line = refused.line;
    let at = refused.at.min(line.len());
    if !line.is_char_boundary(at) {
        return None;
    }
    let first = first_word(line);
    sign(line, at)
        .or_else(|| comment(line, at))
        .or_else(|| equals(line, at, refused.token))
        .or_else(|| label(line, at))
        .or_else(|| two_words(line, at))
        .or_else(|| pointed(line, at))
        .or_else(|| call(line, &first))
        .or_else(|| condition(line, at, &first, refused.token))
        .or_else(|| other_statement(&first))
        .or_else(|| bare_call(line, at, refused.token))
}

fn sign(line: &str, at: usize) -> Option<String> {
    // Understanding may end at the second character of a sign, as in NN=1 //.
    let starts = [at.checked_sub(1), Some(at)];
    let here = |length: usize| {
        starts.into_iter().flatten().find_map(|start| {
            let rest = line.get(start..)?;
            let fits = |(sign, _): &&(&str, &str)| {
                sign.len() == length && rest.starts_with(*sign) && start + sign.len() > at
            };
            SIGNS.iter().find(fits).map(|(_, hint)| (*hint).to_string())
        })
    };
    here(2).or_else(|| here(1))
}

/// `!`, `#` or `%` before a remark.
fn comment(line: &str, at: usize) -> Option<String> {
    let found = line[at..].chars().next()?;
    match found {
        '!' if line[..at].trim_end().ends_with(['(', '.']) => {
            Some("the opposite of a condition is .NOT.".into())
        }
        '~' => Some("the opposite of a condition is .NOT.".into()),
        '!' | '#' => Some("a comment begins with $$".into()),
        '%' if line[..at].trim().is_empty() => Some("a comment begins with $$".into()),
        '%' => Some("the rest of a division is MODF(a,b)".into()),
        _ => None,
    }
}

/// `=` in a condition.
fn equals(line: &str, at: usize, token: Token<'_>) -> Option<String> {
    let opens = line[..at].matches('(').count();
    let closes = line[..at].matches(')').count();
    (token == Token::Equals && opens > closes).then(|| "equality is .EQ., as in IF(NN.EQ.1)".into())
}

/// `NAME:`
fn label(line: &str, at: usize) -> Option<String> {
    let name = line[..at].trim();
    let is_name = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric());
    (line[at..].starts_with(':') && is_name).then(|| format!("a label is written {name})"))
}

/// `ELSE IF`, `END IF` and their like.
fn two_words(line: &str, at: usize) -> Option<String> {
    let found = word_at(line, at);
    let before = line[..at].trim_end().rsplit([' ', '\t', ')']).next()?.to_ascii_uppercase();
    let one = match (before.as_str(), found.as_str()) {
        ("ELSE", "IF") => "ELSEIF(condition)THEN",
        ("END", "IF") => "ENDIF",
        ("END", "CASE" | "SELECT" | "SWITCH") => "ENDCAS",
        ("END", "MACRO" | "SUB" | "FUNCTION") => "TERMAC",
        ("END", "DO" | "FOR" | "WHILE") => "label) CONTIN, with the label of the DO",
        _ => return None,
    };
    Some(format!("write {one}"))
}

/// `AND`, `EQ` and `NOT` without their points.
fn pointed(line: &str, at: usize) -> Option<String> {
    let before = line[..at].trim_end();
    let last = before.rsplit(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default();
    let words = [word_at(line, at), last.to_ascii_uppercase()];
    let word = words.into_iter().find(|word| POINTED.contains(&word.as_str()))?;
    Some(format!("operators are written between points: .{word}."))
}

/// `CALL NAME(…)`
fn call(line: &str, first: &str) -> Option<String> {
    let rest = line.trim_start().get(first.len()..)?;
    let name = first_word(rest);
    (first == "CALL" && rest.starts_with([' ', '\t']) && !name.is_empty())
        .then(|| format!("write CALL/{name},value,…"))
}

/// An IF without brackets, or without THEN on its line.
fn condition(line: &str, at: usize, first: &str, token: Token<'_>) -> Option<String> {
    if !matches!(first, "IF" | "ELSEIF") {
        return None;
    }
    let rest = line.trim_start()[first.len()..].trim_start();
    if !rest.starts_with('(') {
        return Some(format!("the condition needs brackets: {first}(NN.EQ.1)THEN"));
    }
    let ends = token == Token::End && line[..at].trim_end().ends_with(')');
    ends.then(|| {
        format!("put THEN on the same line: {first}(condition)THEN; or one statement after it")
    })
}

fn other_statement(first: &str) -> Option<String> {
    let found = STATEMENTS.iter().find(|(word, _)| *word == first);
    found.map(|(_, hint)| (*hint).to_string())
}

/// `POSTF(13)` without anything that takes its value.
fn bare_call(line: &str, at: usize, token: Token<'_>) -> Option<String> {
    let text = line[..at].trim();
    if token != Token::End || !text.ends_with(')') {
        return None;
    }
    let mut depth = 0usize;
    let open = text.char_indices().rev().find(|(_, c)| {
        match c {
            ')' => depth += 1,
            '(' => depth -= 1,
            _ => {}
        }
        depth == 0
    })?;
    let name = text[..open.0].rsplit(|c: char| !c.is_ascii_alphanumeric()).next()?;
    let is_function = name.len() > 1 && name.ends_with(['F', 'f']);
    let call = &text[open.0 - name.len()..];
    is_function.then(|| format!("a function gives a value: write DMY={call}"))
}

/// The word that begins at a byte, in upper case.
fn word_at(line: &str, at: usize) -> String {
    first_word(&line[at..])
}

/// The first word of a text, in upper case.
fn first_word(text: &str) -> String {
    let text = text.trim_start();
    let end = text.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(text.len());
    text[..end].to_ascii_uppercase()
}
