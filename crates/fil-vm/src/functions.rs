//! Functions that the embedding program adds to FIL.

use crate::value::EMPTY;

/// An argument of an added function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Argument<'a> {
    /// A number; 999999 is EMPTY.
    Number(f64),
    /// A text.
    Text(&'a str),
}

impl Argument<'_> {
    /// The number, where it is one that is not EMPTY.
    pub fn number(self) -> Option<f64> {
        match self {
            Argument::Number(number) if number != EMPTY => Some(number),
            _ => None,
        }
    }
}

type Body = Box<dyn FnMut(&[Argument<'_>]) -> Result<f64, String> + Send>;

struct Function {
    name: String,
    arity: u16,
    body: Body,
}

/// The functions an embedding program adds, by name.
#[derive(Default)]
pub struct Functions {
    list: Vec<Function>,
}

impl Functions {
    /// No functions.
    pub fn new() -> Self {
        Functions::default()
    }

    /// Adds a function; a later one of the same name takes its place. An `Err`
    /// stops the run with that sentence and the FIL place.
    pub fn add(
        &mut self,
        name: &str,
        arity: u16,
        body: impl FnMut(&[Argument<'_>]) -> Result<f64, String> + Send + 'static,
    ) {
        let name = name.to_ascii_uppercase();
        let function = Function { name, arity, body: Box::new(body) };
        match self.list.iter_mut().find(|known| known.name == function.name) {
            Some(known) => *known = function,
            None => self.list.push(function),
        }
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

    pub(crate) fn call(&mut self, index: usize, arguments: &[Argument<'_>]) -> Result<f64, String> {
        match self.list.get_mut(index) {
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

impl std::fmt::Debug for Functions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.list.iter().map(|function| &function.name)).finish()
    }
}
