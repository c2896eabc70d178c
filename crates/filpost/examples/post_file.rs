//! Posts a CL file with a ready post in its plain style, and perhaps a FIL file:
//! `cargo run -p filpost --example post_file -- part.ncl part.ngc [post.fil]`. `FILPOST_POST`
//! names another ready post than `linuxcnc-mill`.

use std::path::Path;
use std::process::ExitCode;

use filpost::{Program, files};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (cl, nc, fil) = match arguments.as_slice() {
        [cl, nc] => (cl, nc, None),
        [cl, nc, fil] => (cl, nc, Some(fil)),
        _ => {
            eprintln!("usage: post_file CL NC [FIL]");
            return ExitCode::from(2);
        }
    };
    match post(Path::new(cl), Path::new(nc), fil.map(Path::new)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn post(cl: &Path, nc: &Path, fil: Option<&Path>) -> Result<(), filpost::Error> {
    let name = std::env::var("FILPOST_POST").unwrap_or_else(|_| "linuxcnc-mill".to_string());
    let mut builder = Program::builder().generic(&name);
    if let Some(fil) = fil {
        builder = builder.fil(&fil.display().to_string(), &files::read_text(fil, None)?);
    }
    builder.build()?.post_files(cl, nc)?;
    Ok(())
}
