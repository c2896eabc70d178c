//! `filpost new`: a folder to start an own post from.

use std::fs;
use std::io;
use std::path::Path;

use filpost::ready::{self, ReadyPost};
use filpost::{Diag, Error, PendingFiles, Program, files};

use crate::args::NewArgs;
use crate::errors::CommandCode;
use crate::{Status, output};

const MACHINE: &str = include_str!("../data/new/machine.toml");
const SCRIPT: &str = include_str!("../data/new/post.fil");
const README: &str = include_str!("../data/new/README.md");
const CASE: &str = include_str!("../data/new/case.toml");
const MILLED: &str = include_str!("../data/new/milled.ncl");
const TURNED: &str = include_str!("../data/new/turned.ncl");

/// Makes the folder: settings over a ready post, a script with a header, a first case, and a
/// page that says how to go on.
///
/// # Errors
/// E0703 for a base that is no ready post, E0808 where something of that name is there, E0809
/// for a folder without a name, E0702 for files that can't be written.
pub fn run(args: &NewArgs) -> Result<Status, Error> {
    let Some(name) = args.folder.file_name().and_then(|name| name.to_str()) else {
        let message = format!("{} has no name of its own", args.folder.display());
        return Err(refused(CommandCode::NoName, message));
    };
    let base = find(&args.base)?;
    let fill = |text: &str| {
        let shown = args.folder.display().to_string();
        text.replace("{NAME}", name).replace("{BASE}", base.name).replace("{FOLDER}", &shown)
    };
    let machine = fill(MACHINE).replace("\"{TITLE}\"", &toml::Value::from(name).to_string());
    let script = fill(SCRIPT);
    let program =
        Program::builder().machine("machine.toml", &machine).fil("post.fil", &script).build()?;
    let (part, nc) = first_program(base, &program)?;
    make_folder(&args.folder)?;
    let readme = fill(README);
    let content = [
        ("machine.toml", machine.as_bytes()),
        ("post.fil", script.as_bytes()),
        ("README.md", readme.as_bytes()),
        ("cases/first/case.toml", CASE.as_bytes()),
        ("cases/first/part.ncl", part.as_bytes()),
        ("cases/first/expected.nc", nc.as_slice()),
    ];
    write_files(&args.folder, &content).inspect_err(|_| remove_empty(&args.folder))?;
    let folder = args.folder.display();
    output::print(
        format!("Created {folder} from {}. Next: {folder}/README.md\n", base.name).as_bytes(),
    )?;
    Ok(Status::Done)
}

/// The ready post of a name.
fn find(name: &str) -> Result<&'static ReadyPost, Error> {
    // The library knows how to refuse one that is not there.
    Program::builder().ready(name).build()?;
    ready::find(name).ok_or_else(|| refused(CommandCode::NoName, format!("no post {name}")))
}

/// A part that the post takes, with its program: a lathe's is a turned one.
fn first_program(base: &ReadyPost, program: &Program) -> Result<(&'static str, Vec<u8>), Error> {
    let parts = if base.name.ends_with("lathe") { [TURNED, MILLED] } else { [MILLED, TURNED] };
    let posted = parts.map(|part| {
        let mut nc = Vec::new();
        let run = program.start().cl_name("part.ncl");
        run.run_seekable(io::Cursor::new(part), &mut nc).map(|_| (part, nc))
    });
    let [first, second] = posted;
    first.or_else(|refused| second.map_err(|_| refused))
}

/// A folder that was not there.
pub fn make_folder(folder: &Path) -> Result<(), Error> {
    files::refuse_name(folder, cfg!(windows))?;
    let parent = folder.parent().filter(|parent| !parent.as_os_str().is_empty());
    if let Some(parent) = parent {
        fs::create_dir_all(parent).map_err(|error| files::cant_write(parent, &error))?;
    }
    match fs::create_dir(folder) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
            let message = format!("{} is there already", folder.display());
            Err(refused(CommandCode::FolderExists, message))
        }
        Err(error) => Err(files::cant_write(folder, &error)),
    }
}

/// The folder that holds the first case.
const FIRST: &str = "cases/first";

/// Writes files below a folder, all or none, and makes the folders that they need.
///
/// # Errors
/// E0702
pub fn write_files(folder: &Path, content: &[(&str, &[u8])]) -> Result<(), Error> {
    for (name, _) in content {
        let parent = folder.join(name);
        let parent = parent.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(|error| files::cant_write(parent, &error))?;
    }
    let mut pending = PendingFiles::default();
    for (name, content) in content {
        pending.add(output::new_file(&folder.join(name), content)?);
    }
    pending.commit()
}

/// Takes the folders away that were made for files which could not be written.
fn remove_empty(folder: &Path) {
    for made in [&folder.join(FIRST), &folder.join("cases"), folder] {
        // What is not empty, or not there, stays as it is.
        let _ = fs::remove_dir(made);
    }
}

fn refused(code: CommandCode, message: String) -> Error {
    Error::Run(Box::new(Diag::new(code, message)))
}
