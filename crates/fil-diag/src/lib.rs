//! Errors and warnings of filpost.
//!
//! **Goal.** Errors and warnings as plain data, shared by every crate of filpost: what `filpost
//! explain` prints, what `docs/errors/` is checked against, what an editor underlines.
//!
//! **Model.** A crate declares its codes once with [`codes!`]: number, title, reason, hint. A
//! [`Diag`] is one fault: a [`Code`], a sentence, [`TextSpan`]s in files. A [`Level`] says whether
//! a doubt is an error, a warning or nothing; [`Levels`] are those that an author has chosen.
//!
//! **Quick start.**
//!
//! ```
//! fil_diag::codes! {
//!     /// What the example can refuse.
//!     pub enum ExampleCode {
//!         /// A number that can't be halved.
//!         Odd = 9901, Error, "an odd number", "The example counts in pairs.", "Give an even number.";
//!     }
//! }
//! let refused: fil_diag::Result<()> = ExampleCode::Odd.err("3 tools");
//! assert_eq!(refused.unwrap_err().to_string(), "E9901: 3 tools");
//! ```
//!
//! **Limits.** Lines count from 1, spans are bytes of a file. Nothing here prints; a number has
//! one meaning in all crates, and the crate `filpost` checks that when it is compiled.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.

pub mod letter_case;
mod level;
pub mod suggest;
mod text_span;

pub use level::{CodeKind, Level, LevelProfile, Levels};
pub use text_span::{LineIndex, TextSpan};

/// What a fallible function of any room gives: a value, or the diagnostic that
/// stops the run.
pub type Result<T, E = Box<Diag>> = std::result::Result<T, E>;

/// How bad a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The run goes on; the NC program is written.
    Warning,
    /// Nothing is written under the output name.
    Error,
}

impl Severity {
    /// `warning` or `error`.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// One row of a code table: everything about a code that does not depend on
/// the place where it was raised.
#[derive(Debug, PartialEq, Eq)]
pub struct Code {
    /// The number after the letter, unique over all crates.
    pub number: u16,
    /// Whether it can be set to another level.
    pub kind: CodeKind,
    /// What happened, in a few words.
    pub title: &'static str,
    /// Why it is refused or warned about; empty in WebAssembly, see [`reason`].
    pub reason: &'static str,
    /// What the user can do.
    pub hint: &'static str,
}

impl Code {
    /// The printed name, `E0123` or `W0123`.
    pub fn name(&self) -> String {
        let letter = match self.severity() {
            Severity::Error => 'E',
            Severity::Warning => 'W',
        };
        format!("{letter}{:04}", self.number)
    }

    /// Error or warning, where no level says otherwise.
    pub const fn severity(&self) -> Severity {
        self.kind.severity()
    }
}

impl std::fmt::Display for Code {
    /// Its [name](Code::name).
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(&self.name())
    }
}

/// A diagnostic: a code, a sentence about this very case, and where it is.
#[derive(Clone, Debug)]
pub struct Diag {
    /// The row of the code table.
    pub code: &'static Code,
    /// That of the code, where no level says otherwise.
    pub severity: Severity,
    /// What is wrong here, with the names and numbers of this case.
    pub message: String,
    /// Where; the first place is the primary one.
    pub spans: Vec<TextSpan>,
    /// A hint made for this case; the code's own hint stands in when `None`.
    pub hint: Option<String>,
    /// Further lines: the FIL stack, the CL record with its numbered words.
    pub notes: Vec<String>,
}

impl Diag {
    /// A diagnostic without a place yet.
    pub fn new(code: impl Into<&'static Code>, message: impl Into<String>) -> Self {
        let code = code.into();
        Diag {
            code,
            severity: code.severity(),
            message: shortened(message.into()),
            spans: Vec::new(),
            hint: None,
            notes: Vec::new(),
        }
    }

    /// Makes it an error or a warning by a level that was set; `None` where it is allowed.
    pub fn at_level(mut self, level: Level) -> Option<Self> {
        self.severity = match level {
            Level::Allow => return None,
            Level::Warn => Severity::Warning,
            Level::Deny => Severity::Error,
        };
        Some(self)
    }

    /// Adds a place; the first one added is the primary one.
    pub fn at(mut self, place: TextSpan) -> Self {
        self.spans.push(place);
        self
    }

    /// Sets a hint made for this case.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// Adds a further line.
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(shortened(note.into()));
        self
    }

    /// Error or warning.
    pub fn severity(&self) -> Severity {
        self.severity
    }

    /// What can be done: the hint made for this case, or that of the code.
    pub fn advice(&self) -> &str {
        self.hint.as_deref().unwrap_or(self.code.hint)
    }

    /// True when the run must not write its output.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

impl std::fmt::Display for Diag {
    /// One line: `E0123 file:line:column: message`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.code.name())?;
        if let Some(place) = self.spans.first() {
            write!(f, " {place}")?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for Diag {}

/// Characters of a message or a note that are kept: it may quote a text of any length.
const LONGEST: usize = 2000;

/// A text without what nobody reads of it.
fn shortened(mut text: String) -> String {
    if let Some((cut, _)) = text.char_indices().nth(LONGEST) {
        let more = text[cut..].chars().count();
        text.truncate(cut);
        text.push_str(&format!(" … ({more} characters more)"));
    }
    text
}

/// The reason of a code or a setting as a table holds it: none in WebAssembly, where a module is
/// loaded for each page, and all reasons stand in the book.
pub const fn reason(text: &'static str) -> &'static str {
    if cfg!(target_family = "wasm") { "" } else { text }
}

/// Declares a crate's codes: an enum whose variants turn into `&'static Code`
/// and a table `ALL` of them.
///
/// ```
/// fil_diag::codes! {
///     /// Codes of this example.
///     pub enum ExampleCode {
///         /// A word nobody knows.
///         UnknownWord = 9901, Warning, "unknown word",
///             "The word is in no vocabulary.", "Check its spelling.";
///     }
/// }
/// let code: &fil_diag::Code = ExampleCode::UnknownWord.into();
/// assert_eq!(code.to_string(), "W9901");
/// assert_eq!(ExampleCode::ALL.len(), 1);
///
/// let refused: fil_diag::Result<()> = ExampleCode::UnknownWord.err("BANANA");
/// assert_eq!(refused.unwrap_err().to_string(), "W9901: BANANA");
/// let hinted: fil_diag::Result<()> = ExampleCode::UnknownWord.err_with("PEAR", "Write APPLE.");
/// assert_eq!(hinted.unwrap_err().hint.as_deref(), Some("Write APPLE."));
/// let missing: Option<f64> = None;
/// let diag = missing.ok_or_else(|| ExampleCode::UnknownWord.diag("no number")).unwrap_err();
/// assert_eq!(diag.message, "no number");
/// ```
#[macro_export]
macro_rules! codes {
    ($(#[$meta:meta])* pub enum $name:ident {
        $($(#[$vmeta:meta])* $variant:ident = $number:literal, $kind:ident,
            $title:literal, $reason:literal, $hint:literal;)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$vmeta])* $variant,)* }

        impl $name {
            /// The whole table, in the order of declaration.
            pub const ALL: &'static [$crate::Code] = &[$($crate::Code {
                number: $number,
                kind: $crate::CodeKind::$kind,
                title: $title,
                reason: $crate::reason($reason),
                hint: $hint,
            },)*];

            /// A diagnostic of this code, to be returned or extended.
            #[cold]
            pub fn diag(self, message: impl Into<String>) -> Box<$crate::Diag> {
                Box::new($crate::Diag::new(self, message))
            }

            /// `Err` with a diagnostic of this code.
            ///
            /// # Errors
            /// Always.
            #[cold]
            pub fn err<T>(self, message: impl Into<String>) -> $crate::Result<T> {
                Err(self.diag(message))
            }

            /// The same with a hint made for this case.
            ///
            /// # Errors
            /// Always.
            #[cold]
            pub fn err_with<T>(
                self,
                message: impl Into<String>,
                hint: &'static str,
            ) -> $crate::Result<T> {
                Err(Box::new(self.diag(message).hint(hint)))
            }
        }

        impl From<$name> for &'static $crate::Code {
            fn from(code: $name) -> Self {
                &$name::ALL[code as usize]
            }
        }
    };
}

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
