//! Makes the lexer and the parser of FIL from their grammars.
//!
//! Both lie in the repository, so that who builds filpost need not build logos's and lalrpop's
//! generators first.

use std::error::Error;
use std::fs;
use std::path::Path;

use proc_macro2::TokenStream;

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
    let parser = fs::read_to_string(out.path().join(name))?;
    Ok(format!("{}{parser}", header("grammar.lalrpop")))
}

/// The lexer that logos makes from the enum at `path`, as Rust text: the enum itself, and its
/// `Logos`.
///
/// # Errors
/// The file can't be read, or is no Rust text. What logos says of a pattern stands in the
/// text as a `compile_error!`.
pub fn lexer(path: &Path) -> Result<String, Box<dyn Error>> {
    let tokens: TokenStream = fs::read_to_string(path)?.parse()?;
    let mut made = logos_codegen::strip_attributes(tokens.clone());
    made.extend(logos_codegen::generate(tokens));
    let text = prettyplease::unparse(&syn::parse2(made)?);
    Ok(format!("{}use logos::Logos;\n\n{text}", header("lexer.logos")))
}

/// The first line of what is made of a grammar.
fn header(grammar: &str) -> String {
    format!("// @generated from {grammar} by `FILPOST_UPDATE=1 cargo test -p filpost-grammar`.\n")
}
