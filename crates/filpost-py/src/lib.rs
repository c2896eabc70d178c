//! The native half of the Python package `filpost`: values in, values out. What a user
//! sees (names of arguments, data classes, documentation) is Python, in `python/filpost`.
//!
//! pyo3's macros live with `forbid(unsafe_code)`: the unsafe code of the border is all
//! in pyo3 and numpy.
#![warn(missing_docs)]

mod block;
mod build;
mod diag;
mod function;
mod input;
mod path;
mod post;
mod texts;

use pyo3::prelude::*;

/// Native half of the package `filpost`.
#[pymodule]
fn _filpost(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<post::Post>()?;
    module.add_class::<post::Cancel>()?;
    module.add_class::<block::Blocks>()?;
    module.add_class::<block::Block>()?;
    module.add_class::<block::Word>()?;
    module.add_function(wrap_pyfunction!(texts::ready_posts, module)?)?;
    module.add_function(wrap_pyfunction!(texts::decode, module)?)?;
    module.add_function(wrap_pyfunction!(texts::encode, module)?)?;
    module.add_function(wrap_pyfunction!(texts::explain, module)?)?;
    module.add_function(wrap_pyfunction!(texts::check, module)?)?;
    module.add_function(wrap_pyfunction!(texts::diff, module)?)?;
    module.add_function(wrap_pyfunction!(texts::plot_cl, module)?)?;
    module.add_function(wrap_pyfunction!(texts::cl_path, module)?)?;
    Ok(())
}
