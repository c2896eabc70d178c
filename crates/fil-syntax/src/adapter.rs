//! From raw tokens to the tokens of the grammar: finds the statements, and tells
//! words that open one from names that look the same.
//!
//! No word is reserved: `DO` is a statement word only at the start of a
//! statement and only where no `=` or subscript follows, `THEN` only after the
//! condition of an IF, `TEXT` and `MACRO` only after the `=` of an assignment.

use std::cell::Cell;
use std::collections::VecDeque;

use logos::{Lexer, Logos};

use crate::free_text;
use crate::lexer::Raw;
use crate::token::{Bad, Token, integer, operator, real, statement_word};
use crate::tree::Span;

/// The most tokens a statement may have.
pub(crate) const MAX_TOKENS: usize = 10_000;
/// How deep brackets, signs and powers may stand inside each other.
pub(crate) const MAX_NESTING: usize = 100;

/// A token with its byte range.
pub(crate) type Placed<'s> = (usize, Token<'s>, usize);

/// What the adapter has to say to the one who runs the parser.
#[derive(Debug, Default)]
pub(crate) struct Shared {
    /// Set from outside to end the text early.
    pub(crate) stop: Cell<bool>,
    /// The first thing after FINI.
    pub(crate) after_fini: Cell<Option<Span>>,
    /// The first CIMFIL/ after FINI.
    pub(crate) section_after_fini: Cell<Option<Span>>,
    /// The first free text with a `;` inside is at this span; one a statement.
    pub(crate) semicolons: Cell<Option<Span>>,
}

/// The tokens of a FIL text, statement by statement.
pub(crate) struct Adapter<'s, 'c> {
    lexer: Lexer<'s, Raw>,
    shared: &'c Shared,
    statement: Vec<Placed<'s>>,
    /// Where in `statement` a statement word may stand: at its start, after the
    /// label and after the condition of an IF.
    starts: Vec<usize>,
    nesting: Nesting,
    ready: VecDeque<Placed<'s>>,
    ended: bool,
}

impl<'s, 'c> Adapter<'s, 'c> {
    /// Reads `source` from its start.
    pub(crate) fn new(source: &'s str, shared: &'c Shared) -> Self {
        Adapter {
            lexer: Raw::lexer(source),
            shared,
            statement: Vec::new(),
            starts: Vec::new(),
            nesting: Nesting::default(),
            ready: VecDeque::new(),
            ended: false,
        }
    }

    /// Reads one statement, which may be empty.
    fn read_statement(&mut self) {
        self.statement.clear();
        self.starts.clear();
        self.starts.push(0);
        self.nesting = Nesting::default();
        let mut condition = None;
        let stop = loop {
            let Some(raw) = self.lexer.next() else {
                self.ended = true;
                break self.lexer.span().end;
            };
            let range = self.lexer.span();
            if matches!(raw, Ok(Raw::Newline | Raw::Semicolon)) {
                break range.start;
            }
            self.push_raw(raw);
            if let Some(bad) = self.too_much() {
                self.statement.push((range.start, Token::Bad(bad), range.end));
            }
            if matches!(self.statement.last(), Some((_, Token::Bad(_), _))) {
                break self.skip_statement();
            }
            self.find_start(&mut condition);
        };
        if !self.statement.is_empty() {
            self.choose_words();
            let fini = matches!(self.statement.last(), Some((_, Token::Fini, _)));
            self.ready.extend(self.statement.drain(..));
            self.ready.push_back((stop, Token::End, stop));
            if fini {
                self.note_rest();
            }
        }
    }

    /// Skips what is left of a statement that cannot be read anyway.
    fn skip_statement(&mut self) -> usize {
        for raw in self.lexer.by_ref() {
            if matches!(raw, Ok(Raw::Newline | Raw::Semicolon)) {
                return self.lexer.span().start;
            }
        }
        self.ended = true;
        self.lexer.span().end
    }

    /// FINI ends the text; what follows is not read, but looked through for a section.
    fn note_rest(&mut self) {
        self.ended = true;
        let mut at_start = true;
        while let Some(raw) = self.lexer.next() {
            let is_end = matches!(raw, Ok(Raw::Newline | Raw::Semicolon));
            let range = self.lexer.span();
            let span = Span::new(range.start, range.end);
            if !is_end && self.shared.after_fini.get().is_none() {
                self.shared.after_fini.set(Some(span));
            }
            if at_start
                && raw == Ok(Raw::Name)
                && statement_word(self.lexer.slice()) == Some(Token::Cimfil)
            {
                self.shared.section_after_fini.set(Some(span));
                return;
            }
            at_start = is_end;
        }
    }

    /// Turns one raw token into its tokens, reading on where a word asks for it.
    fn push_raw(&mut self, raw: Result<Raw, ()>) {
        let (range, slice) = (self.lexer.span(), self.lexer.slice());
        let token = match raw {
            Ok(Raw::Name) => return self.push_name(slice),
            Ok(Raw::IntegerAndOperator) => {
                let point = slice.find('.').unwrap_or(0);
                let middle = range.start + point;
                self.statement.push((range.start, integer(&slice[..point]), middle));
                return self.statement.push((middle, operator(&slice[point..]), range.end));
            }
            Ok(Raw::Integer) => integer(slice),
            Ok(Raw::Real) => real(slice),
            Ok(Raw::Operator) => operator(slice),
            Ok(Raw::Text) => Token::Text(slice),
            Ok(Raw::UnclosedText) => Token::Bad(Bad::UnclosedText),
            Ok(Raw::Open) => Token::Open,
            Ok(Raw::Close) => Token::Close,
            Ok(Raw::Comma) => Token::Comma,
            Ok(Raw::Equals) => Token::Equals,
            Ok(Raw::Plus) => Token::Plus,
            Ok(Raw::Minus) => Token::Minus,
            Ok(Raw::Star) => Token::Star,
            Ok(Raw::Slash) => Token::Slash,
            Ok(Raw::Power) => Token::Power,
            Ok(Raw::Newline | Raw::Semicolon) => Token::End,
            Err(()) => Token::Bad(Bad::Character),
        };
        let before = self.statement.last().map(|placed| placed.1);
        self.nesting.see(before, token);
        self.statement.push((range.start, token, range.end));
    }

    /// Pushes a name; at the start of a statement some words take raw text.
    fn push_name(&mut self, word: &'s str) {
        let range = self.lexer.span();
        self.statement.push((range.start, Token::Name(word), range.end));
        if self.starts.last() != Some(&(self.statement.len() - 1)) {
            return;
        }
        let Some(found) = free_text::after(word, self.lexer.remainder()) else { return };
        for (token, place) in found.tokens() {
            let (start, stop) = (range.end + place.start, range.end + place.end);
            self.statement.push((start, token, stop));
        }
        if found.holds_semicolon() {
            let whole = Span::new(range.end + found.text.start, range.end + found.text.end);
            self.shared.semicolons.set(Some(whole));
        }
        self.lexer.bump(found.length());
    }

    /// A statement with no end in sight, in length or in depth.
    fn too_much(&self) -> Option<Bad> {
        if self.nesting.total > MAX_NESTING {
            Some(Bad::Depth)
        } else if self.statement.len() > MAX_TOKENS {
            Some(Bad::Length)
        } else {
            None
        }
    }

    /// Looks whether a label or the condition of an IF has just ended. Inside a
    /// condition, `condition` counts the open brackets.
    fn find_start(&mut self, condition: &mut Option<usize>) {
        let last = self.statement.len() - 1;
        match (self.statement[last].1, *condition) {
            (Token::Open, Some(depth)) => *condition = Some(depth + 1),
            (Token::Close, Some(1)) => {
                *condition = None;
                self.starts.push(last + 1);
            }
            (Token::Close, Some(depth)) => *condition = Some(depth - 1),
            (Token::Open, None) if last > 0 && self.starts.last() == Some(&(last - 1)) => {
                if let Token::Name(word) = self.statement[last - 1].1
                    && matches!(statement_word(word), Some(Token::If | Token::ElseIf))
                {
                    *condition = Some(1);
                }
            }
            (Token::Close, None) if last == 1 => {
                if let (start, Token::Name(text) | Token::Integer(text), _) = self.statement[0] {
                    let stop = self.statement[1].2;
                    self.statement.clear();
                    self.statement.push((start, Token::Label(text), stop));
                    self.starts.push(1);
                    self.nesting = Nesting::default();
                }
            }
            _ => {}
        }
    }

    /// Turns names into statement words where they stand as such.
    fn choose_words(&mut self) {
        for (order, &start) in self.starts.iter().enumerate() {
            let Some(&(_, Token::Name(word), _)) = self.statement.get(start) else { continue };
            let next = self.statement.get(start + 1).map(|placed| placed.1);
            let inner = order > 0 && start > 1;
            match (statement_word(word), next) {
                (Some(_), Some(Token::Equals)) => {}
                (Some(Token::Then), following) => {
                    if inner && following.is_none() {
                        self.statement[start].1 = Token::Then;
                    }
                }
                (Some(token @ (Token::If | Token::ElseIf)), _) => self.statement[start].1 = token,
                (Some(_), Some(Token::Open)) => {}
                (Some(token), _) => self.statement[start].1 = token,
                (None, _) => {}
            }
            if let Some(equals) = assigned_at(&self.statement, start) {
                choose_assigned(&mut self.statement, equals);
            }
        }
        call_nested_texts(&mut self.statement);
    }
}

impl<'s> Iterator for Adapter<'s, '_> {
    type Item = Result<Placed<'s>, std::convert::Infallible>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.ready.is_empty() && !self.ended && !self.shared.stop.get() {
            self.read_statement();
        }
        self.ready.pop_front().map(Ok)
    }
}

/// The index of the `=` when an assignment to a name or element starts here.
pub(crate) fn assigned_at(statement: &[Placed<'_>], start: usize) -> Option<usize> {
    if !matches!(statement.get(start)?.1, Token::Name(_)) {
        return None;
    }
    let mut equals = start + 1;
    if statement.get(equals)?.1 == Token::Open {
        let mut depth = 0usize;
        loop {
            match statement.get(equals)?.1 {
                Token::Open => depth += 1,
                Token::Close => depth -= 1,
                _ => {}
            }
            equals += 1;
            if depth == 0 {
                break;
            }
        }
    }
    (statement.get(equals)?.1 == Token::Equals).then_some(equals)
}

/// Turns TEXT and MACRO after the `=` of an assignment into their tokens.
fn choose_assigned(statement: &mut [Placed<'_>], equals: usize) {
    let next = statement.get(equals + 2).map(|placed| placed.1);
    let Some((_, token, _)) = statement.get_mut(equals + 1) else { return };
    let Token::Name(word) = *token else { return };
    let slash = next == Some(Token::Slash);
    if slash && word.eq_ignore_ascii_case("TEXT") {
        *token = Token::TextWord;
    } else if (slash || next.is_none()) && word.eq_ignore_ascii_case("MACRO") {
        *token = Token::Macro;
    }
}

/// Makes a definition in brackets, `(TEXT/CONVI,N,2)`, the call `TEXT(CONVI,N,2)`. A comma between
/// its brackets tells it from a name TEXT that is divided.
fn call_nested_texts(statement: &mut Vec<Placed<'_>>) {
    let mut at = 0;
    while at + 2 < statement.len() {
        if let [(_, Token::Open, _), (_, Token::Name(word), _), (start, Token::Slash, end)] =
            statement[at..at + 3]
            && word.eq_ignore_ascii_case("TEXT")
            && has_comma(&statement[at..])
        {
            statement[at] = statement[at + 1];
            statement[at + 1] = (start, Token::Open, end);
            statement.remove(at + 2);
        }
        at += 1;
    }
}

/// True where a comma stands between the first bracket and the one that closes it, in no other.
fn has_comma(from: &[Placed<'_>]) -> bool {
    let mut depth = 0usize;
    for (_, token, _) in from {
        match token {
            Token::Open => depth += 1,
            Token::Close if depth <= 1 => return false,
            Token::Close => depth -= 1,
            Token::Comma if depth == 1 => return true,
            _ => {}
        }
    }
    false
}

/// Counts what a parser has to keep in mind at once: open brackets, and signs
/// and powers that still wait for their operand.
#[derive(Debug, Default)]
struct Nesting {
    /// Waiting signs and powers within each open bracket.
    waiting: Vec<usize>,
    /// The same outside of all brackets.
    outside: usize,
    total: usize,
}

impl Nesting {
    fn see(&mut self, before: Option<Token<'_>>, token: Token<'_>) {
        let top = self.waiting.last_mut().unwrap_or(&mut self.outside);
        match token {
            Token::Open => {
                self.waiting.push(0);
                self.total += 1;
            }
            Token::Close => {
                if let Some(count) = self.waiting.pop() {
                    self.total -= count + 1;
                }
            }
            Token::Comma => self.total -= std::mem::take(top),
            Token::Power | Token::Not => {
                *top += 1;
                self.total += 1;
            }
            Token::Plus | Token::Minus if !before.is_some_and(ends_value) => {
                *top += 1;
                self.total += 1;
            }
            _ => {}
        }
    }
}

/// True after a token that can be the last of a value.
pub(crate) fn ends_value(token: Token<'_>) -> bool {
    use Token::{Close, Integer, Name, Real, Text};
    matches!(token, Close | Integer(_) | Name(_) | Real(_) | Text(_))
}
