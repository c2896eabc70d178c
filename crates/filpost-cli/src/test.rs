//! `filpost test`

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use filpost::case::{self, Verdict};
use filpost::{Diag, Error};

use crate::args::TestArgs;
use crate::errors::CommandCode;
use crate::{Status, output};

/// Runs the regression cases below a folder.
///
/// # Errors
/// Cases that can't be read; a folder without any.
pub fn run(args: &TestArgs) -> Result<Status, Error> {
    let folder = args.dir.clone().unwrap_or_else(default_folder);
    let cases = case::find(&folder)?;
    if cases.is_empty() {
        let message = format!("{} holds no folder with a case.toml", folder.display());
        return Err(Error::Run(Box::new(Diag::new(CommandCode::NoCases, message))));
    }
    let (mut passed, mut failed) = (0, 0);
    for case in &cases {
        let name = case.folder.display();
        let mut text = String::new();
        match case.check(args.update) {
            Verdict::Passed => passed += 1,
            Verdict::Failed(why) => {
                failed += 1;
                let _ = writeln!(text, "FAILED {name}\n{}", why.trim_end());
            }
            Verdict::Updated(changes) => {
                passed += 1;
                let _ = writeln!(text, "UPDATED {name}\n{}", changes.trim_end());
            }
        }
        output::print(text.as_bytes())?;
    }
    output::print(format!("{passed} passed, {failed} failed\n").as_bytes())?;
    Ok(if failed == 0 { Status::Done } else { Status::Failed })
}

fn default_folder() -> PathBuf {
    let corpus = Path::new("corpus");
    if corpus.is_dir() { corpus.into() } else { ".".into() }
}
