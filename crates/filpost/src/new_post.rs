//! The files of a new post: settings over a ready post, a script with a header, a first case, and a
//! page with the next steps.

use std::io;

use fil_diag::Diag;

use crate::error::{Error, RunCode};
use crate::program::Program;
use crate::ready::{self, ReadyPost};
use crate::{OptionValue, PostOption};

const MACHINE: &str = include_str!("../data/new/machine.toml");
const SCRIPT: &str = include_str!("../data/new/post.fil");
const README: &str = include_str!("../data/new/README.md");
const CASE: &str = include_str!("../data/new/case.toml");
const MILLED: &str = include_str!("../data/new/milled.ncl");
const TURNED: &str = include_str!("../data/new/turned.ncl");

/// The folder that holds the first case.
pub const FIRST_CASE: &str = "cases/first";

/// A file of a new post: its name from the folder on, and its bytes.
pub type NewPostFile = (&'static str, Vec<u8>);

/// The files of a new post: `name` is its own, `base` the ready post that it begins from, `folder` where
/// people find it.
///
/// # Errors
/// E0703 for a base that is no ready post.
pub fn files(name: &str, base: &str, folder: &str) -> Result<Vec<NewPostFile>, Error> {
    let base = find(base)?;
    let fill = |text: &str| {
        text.replace("{NAME}", name).replace("{BASE}", base.name).replace("{FOLDER}", folder)
    };
    let machine = fill(MACHINE).replace("\"{TITLE}\"", &toml::Value::from(name).to_string());
    let plain = machine.replace("{OPTIONS}", "");
    let plain = Program::builder().machine("machine.toml", &plain).build()?;
    let ready = Program::builder().ready(base.name).build()?;
    let options = options(base.name, ready.options(), plain.options());
    let machine = machine.replace("{OPTIONS}\n", &options);
    let script = fill(SCRIPT);
    let program =
        Program::builder().machine("machine.toml", &machine).fil("post.fil", &script).build()?;
    let (part, nc) = first_program(base, &program)?;
    Ok(vec![
        ("machine.toml", machine.into_bytes()),
        ("post.fil", script.into_bytes()),
        ("README.md", fill(README).into_bytes()),
        ("cases/first/case.toml", CASE.into()),
        ("cases/first/part.ncl", part.into()),
        ("cases/first/expected.nc", nc),
    ])
}

/// The ready post of a name.
fn find(name: &str) -> Result<&'static ReadyPost, Error> {
    // The library knows how to refuse one that is not there.
    Program::builder().ready(name).build()?;
    ready::find(name)
        .ok_or_else(|| Error::setup(Diag::new(RunCode::NoReadyPost, format!("no post {name}"))))
}

/// The table of the options of a post: each as a comment, with its value and those that it takes. What
/// another value would have in a machine with a `base` is no comment: the new post writes the programs
/// of the ready one.
fn options(base: &str, options: &[PostOption], of_base: &[PostOption]) -> String {
    if options.is_empty() {
        return String::new();
    }
    let differs =
        |name: &str| of_base.iter().any(|one| one.name == name && one.value != one.default);
    let mut text =
        format!("\n# Options of {base}; `filpost posts {base}` lists them too.\n[options]\n");
    for option in options {
        let value = match &option.value {
            OptionValue::Bool(is_on) => is_on.to_string(),
            OptionValue::Integer(number) => number.to_string(),
            other => toml::Value::from(other.to_string()).to_string(),
        };
        text += &format!("\n# {}: {}\n", option.help, option.kind.values());
        let mark = if differs(&option.name) { "" } else { "# " };
        text += &format!("{mark}{} = {value}\n", option.name);
    }
    text
}

/// A part that the post takes, with its program: a lathe's is a turned one.
fn first_program(base: &ReadyPost, program: &Program) -> Result<(&'static str, Vec<u8>), Error> {
    let parts = if base.name.ends_with("lathe") { [TURNED, MILLED] } else { [MILLED, TURNED] };
    let posted = parts.map(|part| {
        let mut nc = Vec::new();
        let run = program.start().cl_name("part.ncl");
        run.stream_seekable(io::Cursor::new(part), &mut nc).map(|_| (part, nc))
    });
    let [first, second] = posted;
    first.or_else(|refused| second.map_err(|_| refused))
}
