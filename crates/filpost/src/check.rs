//! Checking FIL files without a CL file.

use fil_cl::Vocabulary;
use fil_diag::Diag;
use fil_vm::{Compat, FilFile, LoadOptions};

/// Gives a file by the name INCLUD has, or why it cannot.
pub type Includes<'a> = fil_vm::Loader<'a>;

/// How FIL files are checked.
#[derive(Default)]
pub struct Options<'a> {
    /// Corrected readings of POSTF numbers and sections.
    pub compat: Compat,
    /// Refuse extensions of filpost.
    pub strict: bool,
    /// Gives the files that INCLUD names; without it INCLUD is refused.
    pub includes: Option<Includes<'a>>,
}

/// Everything a run would refuse or warn of when it loads these files, and
/// sections that can swallow their record. The files share one name space;
/// each is a name for messages and a text.
pub fn check(files: &[(&str, &str)], options: Options<'_>) -> Vec<Diag> {
    let files: Vec<FilFile<'_>> = files.iter().map(|(name, text)| FilFile { name, text }).collect();
    let options = LoadOptions {
        compat: options.compat,
        strict: options.strict,
        lint: true,
        loader: options.includes,
        ..LoadOptions::default()
    };
    match fil_vm::load(&files, &mut Vocabulary::new(), options) {
        Ok(loaded) => loaded.warnings,
        Err(diags) => diags,
    }
}
