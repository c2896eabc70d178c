//! Which dialect a text has: by what only one system writes, never by a guess.
//!
//! The text is watched as it is read, without a limit of bytes or lines: comments, blanks and
//! case turn nothing. Until a sign comes it is read as generic. A sign of a second system is
//! refused, and so is a sign that comes after a statement that its dialect reads otherwise.

use std::fmt;

use fil_diag::{Diag, TextSpan};

use super::{ArcSense, AxisRule, ClDialect, DialectRules, Sign};
use crate::errors::ClCode;
use crate::vocabulary::{Vocabulary, WordId};

/// A dialect, and why it is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recognized {
    /// The dialect.
    pub dialect: ClDialect,
    /// What it is taken for.
    pub evidence: Evidence,
    /// A sign of another system, where the dialect was chosen: the system, and the line.
    pub against: Option<(ClDialect, u32)>,
}

/// Why a text is taken for one of a dialect.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// The caller chose it.
    Chosen,
    /// This line has something that only its system writes.
    Sign {
        /// Number of the line, 1-based.
        line: u32,
    },
    /// There is no sign of any system.
    NoSign,
}

impl fmt::Display for Recognized {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.evidence {
            Evidence::Chosen => write!(f, "{} (chosen)", self.dialect),
            Evidence::Sign { line } => write!(f, "{} (told by line {line})", self.dialect),
            Evidence::NoSign => write!(f, "{} (no CAM system recognized)", self.dialect),
        }
    }
}

/// What a dialect decided while the text was read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Used {
    /// Line of the first CIRCLE; 0 before it.
    pub(crate) circle: u32,
    /// Line of the first tool axis; 0 before it.
    pub(crate) axis: u32,
}

/// Watches the statements of a text for signs.
pub(crate) struct Recognition {
    found: Recognized,
    rules: &'static DialectRules,
    /// The line of the sign, for messages.
    sign: Option<TextSpan>,
    /// A contradiction not yet raised.
    refused: Option<Box<Diag>>,
    pub(crate) used: Used,
    /// The rules are others than before.
    changed: bool,
    /// What shows a dialect.
    signs: Vec<(&'static Sign, ClDialect)>,
    /// Major words that were looked at, by the index of their ids.
    looked_at: Vec<bool>,
}

impl Recognition {
    /// Starts with the dialect that was chosen, if one was.
    pub(crate) fn new(chosen: Option<ClDialect>) -> Self {
        let found = match chosen {
            Some(dialect) => Recognized { dialect, evidence: Evidence::Chosen, against: None },
            None => Recognized {
                dialect: ClDialect::Generic,
                evidence: Evidence::NoSign,
                against: None,
            },
        };
        let rules = found.dialect.rules();
        let signs_of = |dialect: &ClDialect| {
            let dialect = *dialect;
            dialect.rules().signs.iter().map(move |sign| (sign, dialect))
        };
        Recognition {
            found,
            rules,
            sign: None,
            refused: None,
            used: Used::default(),
            changed: false,
            signs: ClDialect::ALL.iter().flat_map(signs_of).collect(),
            looked_at: Vec::new(),
        }
    }

    /// The same dialect and sign at the beginning of the text.
    pub(crate) fn begun_again(self) -> Self {
        Recognition { used: Used::default(), changed: false, looked_at: Vec::new(), ..self }
    }

    /// What the text is taken for by now.
    pub(crate) fn found(&self) -> Recognized {
        self.found
    }

    /// The rules to read by.
    #[inline]
    pub(crate) fn rules(&self) -> &'static DialectRules {
        self.rules
    }

    /// A contradiction between the signs seen so far.
    pub(crate) fn refusal(&mut self) -> Option<Box<Diag>> {
        self.refused.take()
    }

    /// True once after the rules have become others.
    pub(crate) fn take_changed(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// Looks at a comment line, which begins with `$$`.
    pub(crate) fn comment(&mut self, line: &[u8], place: impl FnOnce() -> TextSpan) {
        let text = compact(line.strip_prefix(b"$$").unwrap_or(line));
        self.watch(place, |sign| match sign {
            Sign::Comment(begin) => text.starts_with(begin.as_bytes()),
            _ => false,
        });
    }

    /// Looks at a pseudo-comment.
    pub(crate) fn pseudo(&mut self, place: impl FnOnce() -> TextSpan) {
        self.watch(place, |sign| matches!(sign, Sign::Pseudo));
    }

    /// Looks at the major word of a statement: once, because nothing else of it is a sign.
    pub(crate) fn statement(
        &mut self,
        major: WordId,
        vocabulary: &Vocabulary,
        place: impl FnOnce() -> TextSpan,
    ) {
        if self.looked_at.len() <= major.index() {
            self.looked_at.resize(major.index() + 1, false);
        }
        if std::mem::replace(&mut self.looked_at[major.index()], true) {
            return;
        }
        let name = vocabulary.name(major);
        self.watch(place, |sign| match sign {
            Sign::Word(word) => *word == major,
            Sign::Name(known) => name == *known,
            Sign::Prefix(begin) => name.starts_with(begin),
            _ => false,
        });
    }

    /// Looks at a text statement.
    pub(crate) fn text(&mut self, major: WordId, text: &str, place: impl FnOnce() -> TextSpan) {
        let holds =
            |word: &str| text.split([' ', '\t', ',']).any(|part| part.eq_ignore_ascii_case(word));
        self.watch(place, |sign| match sign {
            Sign::Word(word) => *word == major,
            Sign::Text(word, part) => *word == major && holds(part),
            Sign::TextBegin(word, begin) => *word == major && text.trim().starts_with(begin),
            _ => false,
        });
    }

    /// Takes the dialect that has a sign which is there.
    fn watch(&mut self, place: impl FnOnce() -> TextSpan, is_there: impl Fn(&Sign) -> bool) {
        let mut found = self.signs.iter().filter(|(sign, _)| is_there(sign));
        let Some(dialect) = found.next().map(|(_, dialect)| *dialect) else { return };
        // What the system found by now writes, too, says nothing against it.
        if found.any(|(_, other)| *other == self.found.dialect) {
            return;
        }
        if self.found.evidence == Evidence::Chosen {
            if dialect != self.found.dialect && self.found.against.is_none() {
                self.found.against = Some((dialect, place().line));
            }
        } else if dialect != self.found.dialect && self.refused.is_none() {
            self.take(dialect, place());
        }
    }

    fn take(&mut self, dialect: ClDialect, place: TextSpan) {
        if let Some(sign) = &self.sign {
            let message = format!(
                "line {} shows that the text is from {}, this line that it is from {dialect}",
                sign.line, self.found.dialect
            );
            let hint = format!(
                "give the files one by one, or choose with --dialect {} or --dialect {dialect}",
                self.found.dialect
            );
            let diag = Diag::new(ClCode::TwoDialects, message).at(place).hint(hint);
            self.refused = Some(Box::new(diag.at(sign.clone())));
        } else if let Some(line) = self.read_otherwise(dialect.rules()) {
            let message = format!(
                "this line shows that the text is from {dialect}, after line {line} was read as {}",
                self.found.dialect
            );
            let hint =
                format!("choose with --dialect {dialect} or --dialect {}", self.found.dialect);
            self.refused =
                Some(Box::new(Diag::new(ClCode::TwoDialects, message).at(place).hint(hint)));
        } else {
            let evidence = Evidence::Sign { line: place.line };
            self.found = Recognized { dialect, evidence, against: None };
            self.rules = dialect.rules();
            self.changed = true;
            self.sign = Some(place);
        }
    }

    /// Line of a statement read by now that other rules read otherwise.
    fn read_otherwise(&self, rules: &DialectRules) -> Option<u32> {
        let sense = |rules: &DialectRules| rules.circle.map(|form| form.sense);
        let turns = self.used.circle > 0 && sense(rules) != Some(ArcSense::RightHand);
        // While MULTAX is on, the post too keeps the last tool axis of a file as written.
        let is_plain = |rule| matches!(rule, AxisRule::AsWritten | AxisRule::ModalInMultax);
        let tilts = self.used.axis > 0 && !is_plain(rules.axis);
        match () {
            () if turns => Some(self.used.circle),
            () if tilts => Some(self.used.axis),
            () => None,
        }
    }
}

/// Longest beginning of a comment that is looked at, in bytes.
const BEGINNING: usize = 32;

/// The beginning of a comment without blanks, in upper case.
fn compact(text: &[u8]) -> Vec<u8> {
    let letters = text.iter().filter(|byte| !byte.is_ascii_whitespace());
    letters.take(BEGINNING).map(u8::to_ascii_uppercase).collect()
}
