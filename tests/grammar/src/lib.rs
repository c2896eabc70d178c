//! Makes the parser of FIL from its grammar.
//!
//! The parser lies in the repository, so that who builds filpost need not build lalrpop first.

use std::error::Error;
use std::fs;
use std::path::Path;

/// The parser that lalrpop makes from the grammar at `path`, as Rust text.
///
/// # Errors
/// The grammar is ambiguous or not understood (lalrpop prints where), or a file can't be read.
pub fn parser(path: &Path) -> Result<String, Box<dyn Error>> {
    let out = tempfile::tempdir()?;
    lalrpop::Configuration::new()
        .set_out_dir(out.path())
        .set_features([])
        .emit_whitespace(false)
        .emit_rerun_directives(false)
        .force_build(true)
        .process_file(path)?;
    let made = path.with_extension("rs");
    let name = made.file_name().ok_or("the grammar has no name")?;
    Ok(fs::read_to_string(out.path().join(name))?)
}
