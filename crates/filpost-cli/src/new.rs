//! `filpost new`: a folder to start an own post from.

use std::fs;
use std::io;
use std::path::Path;

use filpost::{Diag, Error, PendingFiles, files, new_post};

use crate::args::NewArgs;
use crate::errors::CommandCode;
use crate::{Status, output};

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
    let shown = args.folder.display().to_string();
    let files = new_post::files(name, &args.base, &shown)?;
    make_folder(&args.folder)?;
    let content: Vec<(&str, &[u8])> =
        files.iter().map(|(name, bytes)| (*name, bytes.as_slice())).collect();
    write_files(&args.folder, &content).inspect_err(|_| remove_empty(&args.folder))?;
    output::print(
        format!("Created {shown} from {}. Next: {shown}/README.md\n", args.base).as_bytes(),
    )?;
    Ok(Status::Done)
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
    for made in [&folder.join(new_post::FIRST_CASE), &folder.join("cases"), folder] {
        // What is not empty, or not there, stays as it is.
        let _ = fs::remove_dir(made);
    }
}

fn refused(code: CommandCode, message: String) -> Error {
    Error::Run(Box::new(Diag::new(code, message)))
}
