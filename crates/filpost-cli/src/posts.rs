//! The posts of several jobs: each is read and compiled once, and all threads share
//! it.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use filpost::{Error, Program};

use crate::args::PostArgs;
use crate::setup::{self, From};

/// A post that is ready to run.
#[derive(Clone)]
pub struct Built {
    /// Machine and FIL.
    pub program: Program,
    /// What the summary calls it.
    pub title: String,
    /// Something the user should know about the choice.
    pub note: Option<String>,
    /// All files it was read from.
    pub inputs: Vec<PathBuf>,
}

/// A post that one job builds while others may wait for it.
type Cell = Arc<OnceLock<Result<Built, Error>>>;

/// The posts of a command.
pub struct Posts<'a> {
    args: &'a PostArgs,
    /// What the jobs read and write, so that no script of one writes over a file of another.
    taken: Vec<PathBuf>,
    built: Mutex<HashMap<From, Cell>>,
}

impl<'a> Posts<'a> {
    /// No post is built yet.
    pub fn new(args: &'a PostArgs) -> Self {
        Posts { args, taken: Vec::new(), built: Mutex::default() }
    }

    /// The same with CL files and results of several jobs, which no script writes over.
    pub fn with_taken(args: &'a PostArgs, taken: Vec<PathBuf>) -> Self {
        Posts { taken, ..Posts::new(args) }
    }

    /// CL files and results of all jobs, where there are several.
    pub fn taken(&self) -> &[PathBuf] {
        &self.taken
    }

    /// The options of the command.
    pub fn args(&self) -> &'a PostArgs {
        self.args
    }

    /// The post of a job.
    ///
    /// # Errors
    /// Files that can't be read, and what is wrong with them; the same error for
    /// each job that asks for the post.
    pub fn get(&self, from: From) -> Result<Built, Error> {
        // Nothing is left half done in the table, whoever panicked.
        let mut built = self.built.lock().unwrap_or_else(PoisonError::into_inner);
        let cell = Arc::clone(built.entry(from.clone()).or_default());
        drop(built);
        cell.get_or_init(|| build(self.args, &from)).clone()
    }
}

fn build(args: &PostArgs, from: &From) -> Result<Built, Error> {
    let named = setup::for_run(&args.chosen, &args.fil, &args.reading, from)?;
    let builder = named.builder.debug(args.profile.is_some());
    let program = setup::granted(builder, &args.grants).build()?;
    let title = named.title + &style(&program);
    Ok(Built { program, title, note: named.note, inputs: named.inputs })
}

/// The style of a post, where it has another one than its ready post and nobody has chosen it.
fn style(program: &Program) -> String {
    let style = program.options().iter().find(|option| option.name == "style");
    match style.filter(|style| !style.is_given && style.value != style.default) {
        Some(style) => format!(", style {}", style.value),
        None => String::new(),
    }
}
