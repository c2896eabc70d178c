//! Where results go: files, devices, standard output, and words to the user.

use std::fs::File;
use std::io::{self, BufWriter, Seek, StdoutLock, Write};
use std::path::{Path, PathBuf};

use filpost::{Diag, Error, NewFile, PendingFiles, file_names, files};
use same_file::Handle;

use crate::errors::CommandCode;

/// Name of standard output in messages.
pub const STANDARD_OUTPUT: &str = "standard output";

/// Buffer on the way to a stream.
const BUFFER: usize = 256 * 1024;

/// Where a result goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// Standard output.
    Stdout,
    /// A device or pipe that is written to as it is.
    Device(PathBuf),
    /// A file that appears under its name only when it is complete.
    File(PathBuf),
}

impl Target {
    /// The target of `-o`: a file, or standard output for `-` and nothing.
    pub fn new(path: Option<&Path>) -> Target {
        let Some(path) = path.filter(|path| path.as_os_str() != "-") else {
            return Target::Stdout;
        };
        if cfg!(windows) && names_device(path) {
            return Target::Device(path.into());
        }
        match std::fs::metadata(path) {
            Ok(found) if !found.is_file() && !found.is_dir() => Target::Device(path.into()),
            // A link stays a link: what it points to is written.
            Ok(_) if path.is_symlink() => {
                Target::File(path.canonicalize().unwrap_or_else(|_| path.into()))
            }
            _ => Target::File(path.into()),
        }
    }

    /// Begins the result: nothing of it is seen before [`commit`].
    ///
    /// # Errors
    /// E0702
    pub fn stage(self) -> Result<Staged, Error> {
        match self {
            Target::File(path) => NewFile::create(&path).map(Staged::File),
            stream => {
                let spool = temporary_file();
                let spool = spool.map_err(|error| files::cant_write(stream.path(), &error))?;
                Ok(Staged::Stream(BufWriter::with_capacity(BUFFER, spool), stream))
            }
        }
    }

    /// Writes the result; on an error nothing of it is seen.
    ///
    /// # Errors
    /// What `write` returns; E0702 for the target itself.
    pub fn write<T>(
        &self,
        write: impl FnOnce(&mut (dyn Write + Send)) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let mut staged = self.clone().stage()?;
        let result = write(&mut staged)?;
        commit([staged], PendingFiles::default())?;
        Ok(result)
    }

    /// Its name, for messages.
    fn path(&self) -> &Path {
        match self {
            Target::Stdout => Path::new(STANDARD_OUTPUT),
            Target::Device(path) | Target::File(path) => path,
        }
    }

    /// Hands a whole result out.
    fn copy(&self, spool: &mut File) -> io::Result<()> {
        match self {
            Target::Stdout => {
                let mut output = io::stdout().lock();
                io::copy(spool, &mut output).and_then(|_| output.flush())
            }
            Target::Device(path) | Target::File(path) => {
                let mut output = File::options().write(true).open(path)?;
                io::copy(spool, &mut output).map(|_| ())
            }
        }
    }
}

/// A result in the making.
pub enum Staged {
    /// A file that will take its name.
    File(NewFile),
    /// A nameless file that will be copied to a stream.
    Stream(BufWriter<File>, Target),
}

impl Write for Staged {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Staged::File(file) => file.write(bytes),
            Staged::Stream(spool, _) => spool.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Staged::File(file) => file.flush(),
            Staged::Stream(spool, _) => spool.flush(),
        }
    }
}

/// A file in the making with its content.
///
/// # Errors
/// E0702
pub fn new_file(path: &Path, content: &[u8]) -> Result<NewFile, Error> {
    let mut file = NewFile::create(path)?;
    file.write_all(content).map_err(|error| files::cant_write(path, &error))?;
    Ok(file)
}

/// Lets all results of a run and the files of its scripts appear together, or none: the
/// streams come last, and where one can't be written, the files are as they were.
///
/// # Errors
/// E0702
pub fn commit(
    staged: impl IntoIterator<Item = Staged>,
    mut pending: PendingFiles,
) -> Result<(), Error> {
    let mut streams = Vec::new();
    for result in staged {
        match result {
            Staged::File(file) => pending.add(file),
            Staged::Stream(spool, target) => streams.push((spool, target)),
        }
    }
    pending.commit_then(|| {
        streams.into_iter().try_for_each(|(spool, target)| {
            let whole = spool.into_inner().map_err(io::IntoInnerError::into_error);
            let copied = whole.and_then(|mut spool| {
                spool.rewind()?;
                target.copy(&mut spool)
            });
            copied.map_err(|error| files::cant_write(target.path(), &error))
        })
    })
}

/// The target of `-o` for [`refuse_over`]: `-` for standard output.
pub fn named(target: Option<&Path>) -> &Path {
    target.unwrap_or(Path::new("-"))
}

/// Refuses an output that is one of the inputs, or another output; `-` is a standard
/// stream, and the file that the shell has put in its place.
///
/// # Errors
/// E0802
pub fn refuse_over<'p>(
    outputs: impl IntoIterator<Item = &'p Path>,
    inputs: impl IntoIterator<Item = &'p Path>,
) -> Result<(), Error> {
    let inputs: Vec<&Path> = inputs.into_iter().collect();
    let files = inputs.iter().filter(|path| !is_device(path));
    let mut taken: Vec<PathBuf> = files.map(|path| files::real_path(path)).collect();
    for path in outputs {
        let file = files::real_path(path);
        if taken.contains(&file) || inputs.iter().any(|input| meets_stream(path, input)) {
            let name =
                if is_stream(path) { STANDARD_OUTPUT.into() } else { path.display().to_string() };
            return Err(over_input(format!("{name} is read or written by this run already")));
        }
        if !is_device(path) {
            taken.push(file);
        }
    }
    Ok(())
}

fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// True for an output and an input that are one file, where at least one of them is a
/// standard stream.
fn meets_stream(output: &Path, input: &Path) -> bool {
    if !is_stream(output) && !is_stream(input) {
        return false;
    }
    let plain = |handle: io::Result<Handle>| {
        handle.ok().filter(|handle| handle.as_file().metadata().is_ok_and(|found| found.is_file()))
    };
    let output = if is_stream(output) { Handle::stdout() } else { Handle::from_path(output) };
    let input = if is_stream(input) { Handle::stdin() } else { Handle::from_path(input) };
    plain(output).zip(plain(input)).is_some_and(|(output, input)| output == input)
}

/// E0802
pub fn over_input(message: String) -> Error {
    Error::Run(Box::new(Diag::new(CommandCode::OverInput, message)))
}

/// A device as users of Windows write it: `NUL`, `COM1`, `LPT1:`, `\\.\COM12`.
fn names_device(path: &Path) -> bool {
    let name = path.to_string_lossy();
    let bare = name.strip_prefix(r"\\.\").unwrap_or(&name);
    bare.len() < name.len() || file_names::is_device(bare.strip_suffix(':').unwrap_or(bare))
}

fn is_device(path: &Path) -> bool {
    is_stream(path)
        || cfg!(windows) && names_device(path)
        || path.metadata().is_ok_and(|found| !found.is_file())
}

/// A nameless file: in the folder of temporary files, or in the current folder where that is
/// missing or can't be written.
///
/// # Errors
/// Neither folder takes a file.
pub fn temporary_file() -> io::Result<File> {
    tempfile::tempfile().or_else(|error| {
        let folder = std::env::temp_dir();
        tempfile::tempfile_in(".").map_err(|_| {
            io::Error::new(
                error.kind(),
                format!("no temporary file in {}: {error}", folder.display()),
            )
        })
    })
}

/// Reads standard input into a nameless file, so that it can be read again.
///
/// # Errors
/// E0701
pub fn spool_stdin() -> Result<File, Error> {
    let spool = || {
        let mut file = temporary_file()?;
        io::copy(&mut io::stdin().lock(), &mut file)?;
        file.rewind()?;
        Ok(file)
    };
    spool().map_err(|error| files::cant_read(Path::new("standard input"), &error))
}

/// Opens an input file; standard input for `-`.
///
/// # Errors
/// E0701
pub fn open(path: &Path) -> Result<File, Error> {
    if path.as_os_str() == "-" {
        return spool_stdin();
    }
    let cant = |error| files::cant_read(path, &error);
    let mut file = File::open(path).map_err(cant)?;
    let kind = file.metadata().map_err(cant)?;
    if kind.is_dir() {
        return Err(cant(io::Error::from(io::ErrorKind::IsADirectory)));
    }
    if kind.is_file() {
        return Ok(file);
    }
    let mut spool = temporary_file().map_err(cant)?;
    io::copy(&mut file, &mut spool).map_err(cant)?;
    spool.rewind().map_err(cant)?;
    Ok(spool)
}

/// The name of an input in messages.
pub fn input_name(path: &Path) -> String {
    if path.as_os_str() == "-" { "standard input".into() } else { path.display().to_string() }
}

/// Standard output for what is only to be looked at: where the reader has seen enough and
/// closed the pipe, the rest is let go and the command ends as it would have. A program is a
/// result and not written here: half of one is an error.
pub struct View(StdoutLock<'static>);

impl View {
    /// Buffered.
    pub fn new() -> BufWriter<View> {
        BufWriter::new(View(io::stdout().lock()))
    }
}

impl Write for View {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.0.write(bytes) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(bytes.len()),
            written => written,
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self.0.flush() {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            flushed => flushed,
        }
    }
}

/// Prints to standard output as it comes, for what is only to be looked at.
///
/// # Errors
/// E0702, but not for a pipe that its reader has closed.
pub fn print(bytes: &[u8]) -> Result<(), Error> {
    print_with(|output| output.write_all(bytes))
}

/// The same through a buffered writer.
///
/// # Errors
/// As [`print()`].
pub fn print_with(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Error> {
    let mut output = View::new();
    write(&mut output).and_then(|()| output.flush()).map_err(|error| stdout_error(&error))
}

/// E0702 for standard output.
pub fn stdout_error(error: &io::Error) -> Error {
    files::cant_write(Path::new(STANDARD_OUTPUT), error)
}

/// A line to the user. Standard error may be closed; then nobody listens.
pub fn say(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_of_windows_are_known_by_their_names() {
        for path in ["NUL", "nul", "COM1", "LPT1:", r"\\.\COM12"] {
            assert!(names_device(Path::new(path)), "{path}");
        }
        for path in ["NUL.nc", "out/NUL", "part.nc", "C:", r"C:\part.nc", r"\\server\share\a.nc"] {
            assert!(!names_device(Path::new(path)), "{path}");
        }
    }
}
