//! Functions that the embedding program adds to FIL.

use fil_cl::Vocabulary;

use crate::builtins;
use crate::compile::names::letter;
use crate::value::EMPTY;

/// An argument of an added function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Argument<'a> {
    /// A number; 999999 is EMPTY.
    Number(f64),
    /// A text.
    Text(&'a str),
}

impl<'a> Argument<'a> {
    /// The number, where it is one that is not EMPTY; its unit is that of the script.
    pub fn number(self) -> Option<f64> {
        match self {
            Argument::Number(number) if number != EMPTY => Some(number),
            _ => None,
        }
    }

    /// The text, where it is one.
    pub fn text(self) -> Option<&'a str> {
        match self {
            Argument::Text(text) => Some(text),
            Argument::Number(_) => None,
        }
    }
}

/// What an added function returns.
#[derive(Clone, Debug, PartialEq)]
pub enum Returned {
    /// A number, which must be finite; 999999 is EMPTY.
    Number(f64),
    /// A text.
    Text(String),
}

impl From<f64> for Returned {
    fn from(number: f64) -> Self {
        Returned::Number(number)
    }
}

impl From<String> for Returned {
    fn from(text: String) -> Self {
        Returned::Text(text)
    }
}

impl From<&str> for Returned {
    fn from(text: &str) -> Self {
        Returned::Text(text.to_string())
    }
}

type Body = Box<dyn Fn(&[Argument<'_>]) -> Result<Returned, String> + Send + Sync>;

struct Function {
    name: String,
    arity: u16,
    body: Body,
}

/// The functions an embedding program adds, by name. They are shared by all
/// runs of a module, also by runs in other threads.
#[derive(Default)]
pub struct Functions {
    list: Vec<Function>,
}

impl Functions {
    /// No functions.
    pub fn new() -> Self {
        Functions::default()
    }

    /// Adds a function. An `Err` stops the run with that sentence and the FIL
    /// place. A name that can't be taken is refused by [`load`](crate::load).
    pub fn add<T: Into<Returned>>(
        &mut self,
        name: &str,
        arity: u16,
        body: impl Fn(&[Argument<'_>]) -> Result<T, String> + Send + Sync + 'static,
    ) {
        let body: Body = Box::new(move |arguments| body(arguments).map(Into::into));
        self.list.push(Function { name: name.to_ascii_uppercase(), arity, body });
    }

    /// Why names can't be taken, a sentence each: a script that calls such a
    /// function would get another one, or none.
    pub(crate) fn refused_names(&self, vocab: &Vocabulary) -> Vec<String> {
        let refused = self.list.iter().enumerate().filter_map(|(index, function)| {
            let name = function.name.as_str();
            if self.list[..index].iter().any(|other| other.name == name) {
                return Some(format!("the function {name} is added twice"));
            }
            let why = refused_name(name, vocab)?;
            Some(format!("a function can't be named {name}: {why}"))
        });
        refused.collect()
    }

    pub(crate) fn find(&self, name: &str) -> Option<(u16, u16)> {
        let index = self.list.iter().position(|function| function.name == name)?;
        Some((u16::try_from(index).ok()?, self.list[index].arity))
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|function| function.name.as_str())
    }

    pub(crate) fn arities(&self) -> Vec<u16> {
        self.list.iter().map(|function| function.arity).collect()
    }

    pub(crate) fn call(
        &self,
        index: usize,
        arguments: &[Argument<'_>],
    ) -> Result<Returned, String> {
        match self.list.get(index) {
            Some(function) if usize::from(function.arity) == arguments.len() => {
                (function.body)(arguments)
            }
            _ => Err("the function this was compiled for is not there".to_string()),
        }
    }

    pub(crate) fn name(&self, index: usize) -> &str {
        self.list.get(index).map_or("?", |function| &function.name)
    }
}

fn refused_name(name: &str, vocab: &Vocabulary) -> Option<&'static str> {
    let is_name = name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    if !is_name {
        Some("a name begins with a letter and holds letters, digits and _")
    } else if builtins::find(name).is_some() {
        Some("FIL has a function of this name")
    } else if fil_syntax::is_statement_word(name) {
        Some("it is a statement of FIL")
    } else if letter(name).is_some() {
        Some("the letters A to Z are variables")
    } else if vocab.find(name).is_some_and(|word| vocab.is_known(word)) {
        Some("it is a word of the CL vocabulary")
    } else {
        None
    }
}

impl std::fmt::Debug for Functions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.list.iter().map(|function| &function.name)).finish()
    }
}
