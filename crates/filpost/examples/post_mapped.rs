//! Posts a CL file with a ready post and writes the line map beside the program:
//! `cargo run -p filpost --example post_mapped -- part.ncl part.ngc`.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use filpost::map::Names;
use filpost::{Error, Program, files};

fn main() -> ExitCode {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [cl, nc] = arguments.as_slice() else {
        eprintln!("usage: post_mapped CL NC");
        return ExitCode::from(2);
    };
    match post(cl, nc) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn post(cl: &Path, nc: &Path) -> Result<(), Error> {
    let program = Program::builder().generic("linuxcnc-mill").build()?;
    let input = File::open(cl).map_err(|error| files::cant_read(cl, &error))?;
    let mut map = nc.as_os_str().to_owned();
    map.push(".map");
    let map = Path::new(&map);
    let folder = nc.parent().unwrap_or(Path::new(""));
    let seen = |path: &Path| Names::from_folder(folder, path);
    let names = Names { cl: seen(cl), nc: seen(nc), fil: Vec::new() };
    let (_, pending) = files::write_whole(nc, |nc| {
        files::write_whole(map, |map| program.start().run_mapped(input, nc, &names, map))
    })?;
    pending.commit()
}
