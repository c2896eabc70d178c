//! A program and its runs.

use std::path::PathBuf;
use std::sync::Arc;

use filpost::cl::reader::Options;
use filpost::nc::plot::{View, html, svg};
use filpost::nc::verify::{Allowed, Deviation, Verdict};
use filpost::plot::{self, ClText, Text};
use filpost::verify::{NcProgram, Reference};
use filpost::{CancelToken, Program, Report, Unit};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyDict};

use crate::block::Blocks;
use crate::build::{self, Parts};
use crate::input::{Given, Input};
use crate::{diag, path};

/// A switch that stops runs from another thread.
#[pyclass(frozen, module = "filpost")]
pub struct Cancel(CancelToken);

#[pymethods]
impl Cancel {
    #[new]
    fn new() -> Self {
        Cancel(CancelToken::new())
    }

    /// Stops the runs that have this switch.
    fn cancel(&self) {
        self.0.cancel();
    }

    /// True once `cancel` was called.
    #[getter]
    fn cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

/// The options of a run.
#[derive(FromPyObject)]
pub struct RunOptions {
    name: Option<String>,
    cancel: Option<Py<Cancel>>,
}

/// A program with how it reads CL files.
#[pyclass(frozen, module = "filpost")]
pub struct Post {
    program: Program,
    reading: Options,
    unit: Option<Unit>,
    fil: Arc<[String]>,
}

impl Post {
    fn start(&self, run: &RunOptions, name: &str) -> filpost::Run<'static> {
        let mut started = self.program.start().cl_name(name).cl_options(self.reading);
        if let Some(unit) = self.unit {
            started = started.units(unit);
        }
        match &run.cancel {
            Some(cancel) => started.cancel(&cancel.get().0),
            None => started,
        }
    }

    fn open(&self, py: Python<'_>, cl: Given, run: &mut RunOptions) -> PyResult<(Input, String)> {
        cl.open(py, run.name.take())
    }
}

#[pymethods]
impl Post {
    #[new]
    fn new(
        py: Python<'_>,
        parts: Parts,
        dialect: Option<&str>,
        raw: bool,
        unit: Option<&str>,
    ) -> PyResult<Self> {
        let (reading, unit) = (build::reading(dialect, raw)?, build::unit(unit)?);
        let program = build::program(py, parts)?;
        let fil = program.fil_files().into();
        Ok(Post { program, reading, unit, fil })
    }

    #[getter]
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(diag::diagnostics(py, self.program.warnings())?.into_any())
    }

    #[getter]
    fn encoding(&self) -> &'static str {
        self.program.nc_page().name()
    }

    /// NC program and report.
    fn run<'py>(
        &self,
        py: Python<'py>,
        cl: Given,
        mut run: RunOptions,
    ) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyAny>)> {
        let (input, name) = self.open(py, cl, &mut run)?;
        let started = self.start(&run, &name);
        let mut nc = Vec::new();
        let done = py.detach(|| started.stream_seekable(input, &mut nc));
        py.check_signals()?;
        let told = done.map_err(|error| diag::error(py, &error))?;
        Ok((PyBytes::new(py, &nc), report(py, &told)?))
    }

    /// From file to file.
    fn run_files<'py>(
        &self,
        py: Python<'py>,
        cl: PathBuf,
        nc: PathBuf,
        mut run: RunOptions,
    ) -> PyResult<Bound<'py, PyAny>> {
        let name = run.name.take().unwrap_or_else(|| cl.display().to_string());
        let started = self.start(&run, &name);
        let done = py.detach(|| started.post_files(&cl, &nc));
        report(py, &done.map_err(|error| diag::error(py, &error))?)
    }

    fn blocks(&self, py: Python<'_>, cl: Given, mut run: RunOptions) -> PyResult<Blocks> {
        let (input, name) = self.open(py, cl, &mut run)?;
        let started = self.start(&run, &name);
        let fil = self.fil.clone();
        Ok(Blocks::new(py.detach(|| started.blocks(input)), fil))
    }

    /// Fields of a `filpost.Verification`.
    #[expect(clippy::too_many_arguments, reason = "names and order are those of Python's side")]
    fn verify<'py>(
        &self,
        py: Python<'py>,
        cl: Given,
        nc: PyBackedBytes,
        nc_name: &str,
        tolerance: Option<f64>,
        between: Option<f64>,
        offsets: Vec<String>,
        mut run: RunOptions,
    ) -> PyResult<Bound<'py, PyDict>> {
        let offsets: PyResult<Vec<u32>> = offsets
            .iter()
            .map(|name| {
                let known = filpost::nc::motion::work_offset(name);
                known.ok_or_else(|| PyValueError::new_err(format!("no work offset `{name}`")))
            })
            .collect();
        for (what, value) in [("tolerance", tolerance), ("between", between)] {
            if value.is_some_and(|value| !value.is_finite() || value < 0.0) {
                return Err(PyValueError::new_err(format!("{what} must be 0 or more")));
            }
        }
        let allowed = Allowed { tolerance, between, offsets: offsets?, ..Allowed::default() };
        let (input, name) = self.open(py, cl, &mut run)?;
        let started = self.start(&run, &name);
        let nc = NcProgram { text: &nc, name: nc_name };
        let done = py.detach(|| started.verify(input, nc, allowed));
        let (found, reference) = done.map_err(|error| diag::error(py, &error))?;
        verification(py, &found, reference)
    }

    /// A picture of an NC program, with the CL file under it.
    fn plot(
        &self,
        py: Python<'_>,
        nc: PyBackedBytes,
        nc_name: &str,
        cl: Option<Given>,
        page: bool,
        views: Vec<String>,
    ) -> PyResult<String> {
        let views = views_named(&views)?;
        let cl = cl.map(|cl| cl.read(py, None)).transpose()?;
        let drawn = py.detach(|| -> Result<String, filpost::Error> {
            let mut drawing =
                plot::program(Text { name: nc_name, bytes: &nc }, self.program.commons())?;
            if let Some((bytes, name)) = &cl {
                let cl =
                    ClText { text: Text { name, bytes }, options: self.reading, unit: self.unit };
                plot::lay_under(&mut drawing, cl, self.program.commons())?;
            }
            Ok(if page { html(&drawing) } else { svg(&drawing, &views) })
        });
        drawn.map_err(|error| diag::error(py, &error))
    }

    /// Fields of a `filpost.Path`.
    fn path<'py>(
        &self,
        py: Python<'py>,
        nc: PyBackedBytes,
        nc_name: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let commons = self.program.commons();
        let drawn = py.detach(|| plot::program(Text { name: nc_name, bytes: &nc }, commons));
        path::arrays(py, drawn.map_err(|error| diag::error(py, &error))?.path)
    }
}

/// Views by their names.
///
/// # Errors
/// ValueError for an unknown one.
pub fn views_named(names: &[String]) -> PyResult<Vec<View>> {
    let known = View::ALL.map(|view| (view.name(), view));
    names.iter().map(|name| diag::named("view", name, &known)).collect()
}

/// A `filpost.Report`.
pub fn report<'py>(py: Python<'py>, report: &Report) -> PyResult<Bound<'py, PyAny>> {
    let fields = PyDict::new(py);
    fields.set_item("records", report.records)?;
    fields.set_item("blocks", report.blocks)?;
    fields.set_item("bytes", report.bytes)?;
    fields.set_item("warnings", diag::diagnostics(py, &report.warnings)?)?;
    fields.set_item("dialect", report.dialect.map(|found| found.dialect.name()))?;
    fields.set_item("unit", report.unit.map(|(unit, _)| unit.to_string()))?;
    let corner = |corner: [f64; 3]| (corner[0], corner[1], corner[2]);
    let extents = report.extents.map(|extents| (corner(extents.min), corner(extents.max)));
    fields.set_item("extents", extents)?;
    let class = py.import("filpost._data")?.getattr("Report")?;
    class.call((), Some(&fields))
}

fn verification<'py>(
    py: Python<'py>,
    found: &filpost::nc::verify::Report,
    reference: Reference,
) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    let verdict = match found.verdict() {
        Verdict::Agrees => "agrees",
        Verdict::Partly => "partly",
        Verdict::Differs => "differs",
    };
    fields.set_item("verdict", verdict)?;
    let reference = match reference {
        Reference::ClFile => "cl-file",
        Reference::SecondRun => "second-run",
    };
    fields.set_item("reference", reference)?;
    let finding = |finding: &filpost::nc::verify::Finding| {
        (finding.kind.name(), finding.nc_line, finding.cl_line, finding.message.clone())
    };
    fields.set_item("findings", found.findings.iter().map(finding).collect::<Vec<_>>())?;
    fields.set_item("more", found.more)?;
    let open: Vec<_> =
        found.unverified.iter().map(|open| (open.cl_line, open.what.clone())).collect();
    fields.set_item("not_compared", open)?;
    fields.set_item("more_not_compared", found.more_unverified)?;
    fields.set_item("compared", found.compared)?;
    fields.set_item("matched", found.matched)?;
    let deviation = |of: &Deviation| (of.max, of.rms(), (of.nc_line > 0).then_some(of.nc_line));
    fields.set_item("position", deviation(&found.position))?;
    fields.set_item("axis", deviation(&found.axis))?;
    Ok(fields)
}
