//! The blocks of a run, one by one.

use std::sync::{Arc, Mutex, PoisonError};

use filpost::{Origin, WordOrigin};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::diag;
use crate::post;

/// Lazy iterator over the blocks of a run. Threads may share it: each block goes to one
/// of them.
#[pyclass(frozen, module = "filpost")]
pub struct Blocks {
    blocks: Mutex<filpost::Blocks<'static>>,
    /// Names of the FIL files, by the numbers in the stacks.
    fil: Arc<[String]>,
}

impl Blocks {
    pub fn new(blocks: filpost::Blocks<'static>, fil: Arc<[String]>) -> Self {
        Blocks { blocks: Mutex::new(blocks), fil }
    }
}

#[pymethods]
impl Blocks {
    fn __iter__(this: Py<Self>) -> Py<Self> {
        this
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Block>> {
        // The lock is waited for without the GIL: its holder may need that for a callable.
        let next = py.detach(|| match self.blocks.try_lock() {
            Ok(mut blocks) => Ok(blocks.next()),
            Err(std::sync::TryLockError::Poisoned(lock)) => Ok(lock.into_inner().next()),
            Err(std::sync::TryLockError::WouldBlock) => Err(()),
        });
        let Ok(next) = next else {
            return Err(PyRuntimeError::new_err("another thread takes a block of this run"));
        };
        match next {
            None => Ok(None),
            Some(Ok(block)) => Ok(Some(Block { block: Arc::new(block), fil: self.fil.clone() })),
            Some(Err(error)) => Err(diag::error(py, &error)),
        }
    }

    /// What the run has to tell so far; all of it after the last block.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let report = py
            .detach(|| self.blocks.lock().unwrap_or_else(PoisonError::into_inner).report().clone());
        post::report(py, &report)
    }
}

/// A block of an NC program and what made it.
#[pyclass(frozen, module = "filpost")]
pub struct Block {
    block: Arc<filpost::Block>,
    fil: Arc<[String]>,
}

#[pymethods]
impl Block {
    /// Number of the block in the program, from 1.
    #[getter]
    fn number(&self) -> u64 {
        self.block.number
    }

    /// The block, without line end.
    #[getter]
    fn text(&self) -> &str {
        &self.block.text
    }

    /// Number of the CL record that made it, from 1; 0 before the first record.
    #[getter]
    fn record(&self) -> u32 {
        self.block.origin.record
    }

    /// Line of the CL file, from 1; 0 before the first record.
    #[getter]
    fn line(&self) -> u32 {
        self.block.origin.line
    }

    /// Pairs of FIL file and line that called one another, innermost first; empty where no
    /// section was running.
    #[getter]
    fn fil<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        stack(py, &self.block.origin, &self.fil)
    }

    /// The words of the block, each with what made it.
    #[getter]
    fn words(&self) -> Vec<Word> {
        let word = |index| Word { block: self.block.clone(), index, fil: self.fil.clone() };
        (0..self.block.words.len()).map(word).collect()
    }

    fn __str__(&self) -> &str {
        &self.block.text
    }

    fn __repr__(&self) -> String {
        let Block { block, .. } = self;
        format!("Block({}, {:?}, line={})", block.number, block.text, block.origin.line)
    }
}

/// A word of a block and what made it.
#[pyclass(frozen, module = "filpost")]
pub struct Word {
    block: Arc<filpost::Block>,
    index: usize,
    fil: Arc<[String]>,
}

impl Word {
    fn word(&self) -> &WordOrigin {
        &self.block.words[self.index]
    }
}

#[pymethods]
impl Word {
    /// Its letter, `A` to `Z`; `_` for a text, `/` for the block-delete character, `#` for a
    /// sequence number.
    #[getter]
    fn letter(&self) -> char {
        self.word().letter
    }

    /// The word as it stands in the block.
    #[getter]
    fn text(&self) -> &str {
        self.word().text(&self.block.text)
    }

    /// Number of the CL record that asks for it; 0 where the settings of the machine do.
    #[getter]
    fn record(&self) -> u32 {
        self.word().origin.record
    }

    /// Line of that record in the CL file; 0 where the settings of the machine ask for it.
    #[getter]
    fn line(&self) -> u32 {
        self.word().origin.line
    }

    /// The word of that record, as POSTF(7,n) counts; 0 for the record as a whole.
    #[getter]
    fn record_word(&self) -> u16 {
        self.word().record_word
    }

    /// True where a FIL statement made the record whose words `record_word` counts.
    #[getter]
    fn made_by_fil(&self) -> bool {
        self.word().made_by_fil
    }

    /// Pairs of FIL file and line, innermost first.
    #[getter]
    fn fil<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        stack(py, &self.word().origin, &self.fil)
    }

    fn __str__(&self) -> &str {
        self.text()
    }

    fn __repr__(&self) -> String {
        format!("Word({:?}, line={})", self.text(), self.line())
    }
}

fn stack<'py>(py: Python<'py>, origin: &Origin, fil: &[String]) -> PyResult<Bound<'py, PyTuple>> {
    let name = |file: u16| fil.get(usize::from(file)).map_or("?", String::as_str);
    PyTuple::new(py, origin.fil.iter().map(|line| (name(line.file), line.line)))
}
