//! Post words: which of their items are values and which are words.

use fil_cl::WordId;
use fil_cl::layout::takes_text;
use fil_cl::vocabulary::words as w;
use fil_diag::suggest::did_you_mean;
use fil_syntax::tree::{Expr, ExprKind, Name, Span};

use super::{Resolver, Role};
use crate::builtins;
use crate::compile::names::letter;
use crate::errors::CompileCode;
use crate::statements::{ELSEWHERE, WORDS};

/// Words that stand before a number. Without a number behind it such a name is the
/// number itself: SPEED in `SPINDL/RPM,SPEED,CLW`.
const QUANTITIES: [&str; 38] = [
    "ADJUST", "ANGLE", "ATANGL", "CLEAR", "CUTANG", "CUTS", "DECR", "DEPTH", "DIAMTR", "DISTANCE",
    "DWELL", "FEDTO", "FEED", "FEDRAT", "FINCUT", "INCR", "LENGTH", "MAXIPM", "MAXRPM", "MULTRD",
    "OFFSET", "OFSETL", "OSETNO", "PITCH", "RADIUS", "RANGE", "RAPTO", "RTRCTO", "SCALE", "SIZE",
    "SLOPE", "SPEED", "STEP", "TAPER", "TIMES", "TOOL", "TOOLNO", "TPI",
];

impl<'t> Resolver<'t, '_> {
    /// `WORD/args`
    pub(super) fn post(&mut self, word: &'t Name, args: &'t [Expr]) {
        if builtins::is_statement(&word.text) {
            self.statement_word(word);
            match word.text.as_str() {
                "DATA" => args.iter().skip(1).for_each(|arg| self.expression(arg, Role::Read)),
                _ => self.message(args),
            }
            return;
        }
        self.word_of(word, Role::Major);
        let major = self.input.vocabulary.find(&word.text);
        self.refuse_other_statement(word, args, major);
        let is_text = major.is_some_and(takes_text);
        for (index, arg) in args.iter().enumerate() {
            match is_address(major, args, index) {
                true => self.refuse_other_address(word, arg),
                false => self.refuse_letters(arg),
            }
            match &arg.kind {
                ExprKind::Name(name) if !self.is_variable(name) => {
                    self.word(name, arg.span, Role::Minor);
                    self.refuse_plain_name(name, arg.span, is_text);
                }
                ExprKind::Name(name) => {
                    self.expression(arg, if is_text { Role::Text } else { Role::Read });
                    if !is_text && self.is_word_too(major, args, index, name) {
                        let message =
                            format!("{name} is a variable here and a word of {}", word.text);
                        self.report(CompileCode::NameOrWord, arg.span, message);
                    }
                }
                _ => self.expression(arg, Role::Read),
            }
        }
    }

    /// Values of a statement of our own, which joins them to a text.
    fn message(&mut self, values: &'t [Expr]) {
        self.joined(values);
        for value in values {
            if let ExprKind::Name(name) = &value.kind
                && !self.is_variable(name)
            {
                self.refuse_plain_name(name, value.span, true);
            }
        }
    }

    /// Values that are joined to a text.
    pub(super) fn joined(&mut self, values: &'t [Expr]) {
        for value in values {
            self.expression(value, Role::Text);
            self.refuse_letters(value);
        }
    }

    /// `PPRINT text`: one name that is set is its value.
    pub(super) fn post_text(&mut self, word: &'t Name, text: &'t str, statement: Span) {
        self.word_of(word, Role::Major);
        let name = text.trim().to_ascii_uppercase();
        let global = self.names.globals.get(name.as_str()).filter(|global| global.assigned);
        let symbol = self.parameter(&name).or(global.map(|global| global.symbol));
        if let Some(symbol) = symbol {
            // The text is the last of the statement.
            let start = statement.end - text.len() as u32;
            self.used(symbol, Span { start, end: statement.end }, Role::Read);
        }
    }

    /// True for a name that holds a value: it is set somewhere, a parameter or a letter.
    fn is_variable(&self, name: &str) -> bool {
        self.is_assigned(name) || letter(name).is_some()
    }

    /// A statement of FIL that is misspelt, of another language, or not carried out: as
    /// a record it would reach the post, and what it was meant to do would not be done.
    fn refuse_other_statement(&mut self, word: &Name, args: &[Expr], major: Option<WordId>) {
        let vocabulary = self.input.vocabulary;
        if major == Some(w::GOTO)
            && let [Expr { kind: ExprKind::Name(label), .. }] = args
            && !self.is_assigned(label)
        {
            let message = format!("GOTO/{label} is a motion without a point");
            let hint = Some(format!("a jump is JUMPTO/{label}"));
            self.report_with(CompileCode::OtherStatement, word.span, message, hint);
            return;
        }
        let (message, hint) = match ELSEWHERE.iter().find(|(other, _)| *other == word.text) {
            Some((_, hint)) => {
                (format!("{} is no statement of FIL", word.text), (*hint).to_string())
            }
            None if major.is_some_and(|word| vocabulary.is_known(word)) => return,
            None => match did_you_mean(&word.text, WORDS.iter().copied()) {
                Some(hint) => (format!("{} would be sent to the post", word.text), hint),
                None => return,
            },
        };
        self.report_with(CompileCode::OtherStatement, word.span, message, Some(hint));
    }

    /// A bare name that is no variable is a word, but not where it can't be one.
    fn refuse_plain_name(&mut self, name: &str, span: Span, is_text: bool) {
        let global = self.names.globals.get(name);
        let is_other = global.is_some_and(|g| g.array.is_some() || g.macro_id.is_some());
        if is_other && self.input.vocabulary.find(name).is_none() {
            let message = format!("{name} is an array or macro");
            self.report(CompileCode::ArrayMisuse, span, message);
        } else if is_text {
            let message = format!("{name} is never set, so it would be written literally");
            self.report(CompileCode::NameInText, span, message);
        }
    }

    /// A letter that nothing sets is the number of an address, which is hardly meant in a
    /// value that goes to the post. Functions may be asked for an address.
    fn refuse_letters(&mut self, value: &Expr) {
        match &value.kind {
            ExprKind::Name(name) => {
                if let Some(number) = letter(name).filter(|_| !self.is_assigned(name)) {
                    let message = format!("{name} is the number {number} here");
                    self.report(CompileCode::LetterAsValue, value.span, message);
                }
            }
            ExprKind::Unary { operand, .. } => self.refuse_letters(operand),
            ExprKind::Binary { left, right, .. } => {
                self.refuse_letters(left);
                self.refuse_letters(right);
            }
            ExprKind::Number(_) | ExprKind::Text(_) | ExprKind::Call { .. } => {}
        }
    }

    /// A letter that a statement has set to a computed value no longer names its address: T of
    /// POSTN/OUT,T,1 would be the 24th letter, X, after tool 24.
    fn refuse_other_address(&mut self, word: &Name, address: &Expr) {
        let ExprKind::Name(name) = &address.kind else { return };
        let is_computed = self.names.globals.get(name.as_str()).is_some_and(|set| set.computed);
        if letter(name).is_some() && self.parameter(name).is_none() && is_computed {
            let message =
                format!("{name} is an address of {} here and is set elsewhere", word.text);
            let hint = format!("rename the variable {name}, and leave {name} to the address");
            self.report_with(CompileCode::NameOrWord, address.span, message, Some(hint));
        }
    }

    /// True for a name that is set, where the word of that name can be meant as well.
    fn is_word_too(&self, major: Option<WordId>, args: &[Expr], index: usize, name: &str) -> bool {
        let vocabulary = self.input.vocabulary;
        if letter(name).is_some()
            || !vocabulary.find(name).is_some_and(|word| vocabulary.is_of_posts(word))
        {
            return false;
        }
        let is_value = |arg: &Expr| match &arg.kind {
            ExprKind::Name(name) => self.is_variable(name),
            _ => true,
        };
        let is_quantity = QUANTITIES.contains(&name);
        match major {
            // Points, which hold no words.
            Some(w::GOTO | w::FROM | w::GODLTA) => false,
            // Pairs of an address and its value.
            Some(w::POSTN | w::REPEAT) => index == 0,
            // A number, perhaps with a word behind it.
            Some(w::PREFUN | w::AUXFUN) => index > 0,
            // Lists of numbers, and words beside them.
            Some(w::CIRCLE | w::TRANS | w::TRACUT) => !is_quantity,
            _ => !is_quantity || args.get(index + 1).is_some_and(is_value),
        }
    }
}

/// True for an item that is the number of an address: POSTN/OUT,G,1 and REPEAT/Z,5,
/// REPEAT/X,Y,NEXT.
fn is_address(major: Option<WordId>, args: &[Expr], index: usize) -> bool {
    match major {
        Some(w::POSTN) => !index.is_multiple_of(2),
        Some(w::REPEAT) if is_name(args.last(), "NEXT") => true,
        Some(w::REPEAT) => index.is_multiple_of(2),
        _ => false,
    }
}

fn is_name(arg: Option<&Expr>, word: &str) -> bool {
    matches!(arg, Some(Expr { kind: ExprKind::Name(name), .. }) if name == word)
}
