//! Sentences about a statement that does not follow the grammar.

use crate::adapter::{MAX_NESTING, MAX_TOKENS};
use crate::errors::SyntaxCode;
use crate::token::{Bad, Token};

/// The longest piece of source quoted in a message, in characters.
const MAX_QUOTE: usize = 40;

/// Code and sentence for a token the grammar could not take.
pub(crate) fn refusal(token: Token<'_>, text: &str, expected: &[String]) -> (SyntaxCode, String) {
    let bad = match token {
        Token::Bad(bad) => bad,
        _ => return (SyntaxCode::Unexpected, unexpected(token, text, expected)),
    };
    let text = quote(text);
    match bad {
        Bad::Character => {
            (SyntaxCode::BadCharacter, format!("{text} has no meaning outside of texts"))
        }
        Bad::UnclosedText => {
            (SyntaxCode::UnclosedText, "this text has no closing apostrophe".to_string())
        }
        Bad::Operator => (SyntaxCode::UnknownOperator, format!("{text} is not an operator")),
        Bad::Number => (SyntaxCode::NumberTooLarge, format!("the number {text} is too large")),
        Bad::Depth => (
            SyntaxCode::TooDeep,
            format!("more than {MAX_NESTING} brackets, signs and powers inside each other"),
        ),
        Bad::Length => (
            SyntaxCode::TooLong,
            format!("the statement has more than {MAX_TOKENS} words and signs"),
        ),
    }
}

/// A piece of source, cut when it is long.
pub(crate) fn quote(text: &str) -> String {
    match text.char_indices().nth(MAX_QUOTE) {
        Some((cut, _)) => format!("\"{}…\"", &text[..cut]),
        None => format!("\"{text}\""),
    }
}

fn unexpected(token: Token<'_>, text: &str, expected: &[String]) -> String {
    let found = match token {
        Token::End => "the statement ends here".to_string(),
        Token::Label(_) => format!("found the label {}", quote(text)),
        Token::Text(_) => format!("found the text {}", quote(text)),
        Token::FreeText(_) => format!("found the text {}", quote(text)),
        Token::Integer(_) | Token::Real(_) => format!("found the number {text}"),
        _ => format!("found {}", quote(text)),
    };
    match wanted(expected) {
        Some(wanted) => format!("{found}, expected {wanted}"),
        None => found,
    }
}

/// What the grammar would have taken, in words of the language.
fn wanted(expected: &[String]) -> Option<String> {
    let has = |name: &str| expected.iter().any(|item| item.trim_matches('"') == name);
    if has("CIMFIL") || has("CONTIN") {
        return Some("a statement".to_string());
    }
    let mut words: Vec<&str> = Vec::new();
    if has("(") && has("real") {
        words.push("a value");
    } else if has("name") && has("integer") {
        words.push("a label");
    } else if has("name") {
        words.push("a name");
    } else if has("(") {
        words.push("\"(\"");
    }
    if has("file name") {
        words.push("a file name");
    }
    if has("**") || has(".AND.") || has("*") {
        words.push("an operator");
    } else if has("/") {
        words.push("\"/\"");
    }
    let signs = [("=", "\"=\""), (",", "\",\""), (")", "\")\""), ("THEN", "THEN")];
    words.extend(signs.iter().filter(|(name, _)| has(name)).map(|(_, word)| *word));
    if has("end") {
        words.push("the end of the statement");
    }
    let last = words.pop()?;
    Some(if words.is_empty() {
        last.to_string()
    } else {
        format!("{} or {last}", words.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_quotes_are_cut_between_characters() {
        assert_eq!(quote("ТЕКСТ"), "\"ТЕКСТ\"");
        assert_eq!(quote(&"ж".repeat(99)), format!("\"{}…\"", "ж".repeat(MAX_QUOTE)));
    }

    #[test]
    fn expected_tokens_become_words_of_the_language() {
        let expected = |names: &[&str]| names.iter().map(|n| n.to_string()).collect::<Vec<_>>();
        let value = expected(&["name", "real", "integer", "\"(\"", "\"-\""]);
        assert_eq!(wanted(&value).as_deref(), Some("a value"));
        let after = expected(&["\"**\"", "\")\"", "\",\""]);
        assert_eq!(wanted(&after).as_deref(), Some("an operator, \",\" or \")\""));
    }
}
