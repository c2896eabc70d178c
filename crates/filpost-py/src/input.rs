//! CL files as Python gives them: bytes and files by their name.

use std::cell::Cell;
use std::fs::File;
use std::io::{self, Cursor, Read, Seek, SeekFrom};
use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;

use crate::diag;

/// Bytes between two looks at the signals, so that Ctrl-C stops a run.
const BETWEEN_SIGNALS: u64 = 256 << 10;

thread_local! {
    /// What a signal has raised while this thread read a CL file.
    static SIGNALLED: Cell<Option<PyErr>> = const { Cell::new(None) };
}

/// Takes what a signal, such as Ctrl-C, has raised: it comes out as it is, and not as an error
/// of the file.
pub fn take_signalled() -> Option<PyErr> {
    SIGNALLED.take()
}

/// A CL file.
#[derive(FromPyObject)]
pub enum Given {
    /// Its text; it is not copied.
    Bytes(PyBackedBytes),
    /// Its name.
    Path(PathBuf),
}

impl Given {
    /// Opens it, and gives the name that messages show.
    ///
    /// # Errors
    /// `filpost.Error` E0701 for a file that can't be read.
    pub fn open(self, py: Python<'_>, name: Option<String>) -> PyResult<(Input, String)> {
        match self {
            Given::Bytes(bytes) => {
                Ok((Input::new(Source::Bytes(Cursor::new(bytes))), name.unwrap_or("CL".into())))
            }
            Given::Path(path) => {
                let cant = |error| diag::error(py, &filpost::files::cant_read(&path, &error));
                let file = File::open(&path).map_err(cant)?;
                if file.metadata().is_ok_and(|found| found.is_dir()) {
                    return Err(cant(io::ErrorKind::IsADirectory.into()));
                }
                let name = name.unwrap_or_else(|| path.display().to_string());
                Ok((Input::new(Source::File(file)), name))
            }
        }
    }

    /// All of it, and the name that messages show.
    ///
    /// # Errors
    /// As [`Given::open`].
    pub fn read(self, py: Python<'_>, name: Option<String>) -> PyResult<(Vec<u8>, String)> {
        match self {
            Given::Bytes(bytes) => Ok((bytes.to_vec(), name.unwrap_or("CL".into()))),
            Given::Path(path) => {
                let bytes = filpost::files::read(&path).map_err(|error| diag::error(py, &error))?;
                Ok((bytes, name.unwrap_or_else(|| path.display().to_string())))
            }
        }
    }
}

enum Source {
    Bytes(Cursor<PyBackedBytes>),
    File(File),
}

/// A stream over a CL file that looks at the signals now and then.
pub struct Input {
    source: Source,
    since_signals: u64,
}

impl Input {
    fn new(source: Source) -> Self {
        Input { source, since_signals: 0 }
    }
}

impl Read for Input {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.since_signals >= BETWEEN_SIGNALS {
            self.since_signals = 0;
            Python::attach(|py| py.check_signals()).map_err(|raised| {
                SIGNALLED.set(Some(raised));
                io::Error::other("stopped by a signal")
            })?;
        }
        let read = match &mut self.source {
            Source::Bytes(bytes) => bytes.read(buffer),
            Source::File(file) => file.read(buffer),
        }?;
        self.since_signals += read as u64;
        Ok(read)
    }
}

impl Seek for Input {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match &mut self.source {
            Source::Bytes(bytes) => bytes.seek(to),
            Source::File(file) => file.seek(to),
        }
    }
}
