//! Where results go: files, devices, standard output, and words to the user.

use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use filpost::{Error, files};

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
        match std::fs::metadata(path) {
            Ok(found) if !found.is_file() && !found.is_dir() => Target::Device(path.into()),
            // A link stays a link: what it points to is written.
            Ok(_) if path.is_symlink() => {
                Target::File(path.canonicalize().unwrap_or_else(|_| path.into()))
            }
            _ => Target::File(path.into()),
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
        match self {
            Target::File(path) => files::write_whole(path, |output| write(output)),
            Target::Stdout => through_spool(write, |spool| {
                let mut output = io::stdout().lock();
                io::copy(spool, &mut output).and_then(|_| output.flush())
            })
            .map_err(|error| error.named(Path::new(STANDARD_OUTPUT))),
            Target::Device(path) => through_spool(write, |spool| {
                let mut output = File::options().write(true).open(path)?;
                io::copy(spool, &mut output).map(|_| ())
            })
            .map_err(|error| error.named(path)),
        }
    }
}

/// What went wrong on the way through the spool file.
enum SpoolError {
    Run(Error),
    Io(io::Error),
}

impl SpoolError {
    fn named(self, path: &Path) -> Error {
        match self {
            SpoolError::Run(error) => error,
            SpoolError::Io(error) => files::cant_write(path, &error),
        }
    }
}

/// Keeps the result in a nameless file until it is complete, then hands it out.
fn through_spool<T>(
    write: impl FnOnce(&mut (dyn Write + Send)) -> Result<T, Error>,
    hand_out: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<T, SpoolError> {
    let spool = tempfile::tempfile().map_err(SpoolError::Io)?;
    let mut output = BufWriter::with_capacity(BUFFER, spool);
    let result = write(&mut output).map_err(SpoolError::Run)?;
    let finished = output.into_inner().map_err(|error| error.into_error());
    finished
        .and_then(|mut spool| {
            spool.rewind()?;
            hand_out(&mut spool)
        })
        .map_err(SpoolError::Io)?;
    Ok(result)
}

/// Reads standard input into a nameless file, so that it can be read again.
///
/// # Errors
/// E0701
pub fn spool_stdin() -> Result<File, Error> {
    let spool = || {
        let mut file = tempfile::tempfile()?;
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
    let mut spool = tempfile::tempfile().map_err(cant)?;
    io::copy(&mut file, &mut spool).map_err(cant)?;
    spool.rewind().map_err(cant)?;
    Ok(spool)
}

/// The name of an input in messages.
pub fn input_name(path: &Path) -> String {
    if path.as_os_str() == "-" { "standard input".into() } else { path.display().to_string() }
}

/// Prints to standard output as it comes, for what is only to be looked at.
///
/// # Errors
/// E0702, a closed pipe among them.
pub fn print(bytes: &[u8]) -> Result<(), Error> {
    print_with(|output| output.write_all(bytes))
}

/// The same through a buffered writer.
///
/// # Errors
/// As [`print()`].
pub fn print_with(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Error> {
    let mut output = BufWriter::new(io::stdout().lock());
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
