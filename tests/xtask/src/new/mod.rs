//! `cargo xtask new-word`, `new-code`, `new-post`: skeletons of what the project takes most often,
//! each in all the places that have to know of it. A skeleton refuses, so nothing that is forgotten
//! writes a program; what is left to do is printed.

mod code;
mod post;
mod tree;
mod word;

use std::process::ExitCode;

pub use code::Args as CodeArgs;
pub use post::Args as PostArgs;
pub use word::Args as WordArgs;

use tree::Tree;

/// Writes the skeleton of a post word.
///
/// # Errors
/// A name that is none, or is there already.
pub fn word(args: &WordArgs) -> Result<ExitCode, String> {
    finish(word::write(&mut Tree::new(filpost_tests::root().to_path_buf()), args)?)
}

/// Writes the skeleton of a code.
///
/// # Errors
/// As [`word()`].
pub fn code(args: &CodeArgs) -> Result<ExitCode, String> {
    finish(code::write(&mut Tree::new(filpost_tests::root().to_path_buf()), args)?)
}

/// Writes the skeleton of a ready post.
///
/// # Errors
/// As [`word()`].
pub fn post(args: &PostArgs) -> Result<ExitCode, String> {
    finish(post::write(&mut Tree::new(filpost_tests::root().to_path_buf()), args)?)
}

fn finish(told: String) -> Result<ExitCode, String> {
    println!("{told}");
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests;
