//! Posts a CL file with a ready post in its plain style:
//! `cargo run -p filpost --example post_file -- part.ncl part.ngc [WITH]`. `WITH` is a FIL file, or
//! what is made beside the program (`map`, `listing`, `page`), or how often the file is posted.
//! `FILPOST_POST` names another ready post than `linuxcnc-mill`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::ExitCode;

use filpost::listing::Listing;
use filpost::map::Names;
use filpost::nc::plot::write_html;
use filpost::plot::{self, Text};
use filpost::{Error, Program, files};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (cl, nc, with) = match arguments.as_slice() {
        [cl, nc] => (cl, nc, "1"),
        [cl, nc, with] => (cl, nc, with.as_str()),
        _ => {
            eprintln!("usage: post_file CL NC [FIL | map | listing | page | TIMES]");
            return ExitCode::from(2);
        }
    };
    match post(Path::new(cl), Path::new(nc), with) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn post(cl: &Path, nc: &Path, with: &str) -> Result<(), Error> {
    let name = std::env::var("FILPOST_POST").unwrap_or_else(|_| "linuxcnc-mill".to_string());
    let builder = || Program::builder().generic(&name);
    let build = || builder().build();
    match (with, with.parse::<u32>()) {
        ("map", _) => map(&build()?, cl, nc),
        ("listing", _) => listing(&build()?, cl, nc),
        ("page", _) => page(&build()?, cl, nc),
        (_, Ok(times)) => {
            let program = build()?;
            (0..times).try_for_each(|_| program.post_files(cl, nc).map(|_| ()))
        }
        (fil, Err(_)) => {
            let text = files::read_text(Path::new(fil), None)?;
            builder().fil(fil, &text).build()?.post_files(cl, nc).map(|_| ())
        }
    }
}

fn map(program: &Program, cl: &Path, nc: &Path) -> Result<(), Error> {
    let folder = nc.parent().unwrap_or(Path::new(""));
    let seen = |path: &Path| Names::from_folder(folder, path);
    let names = Names { cl: seen(cl), nc: seen(nc), fil: Vec::new() };
    let path = nc.with_extension("map");
    let (_, pending) = files::write_whole(nc, |nc| {
        files::write_whole(&path, |map| program.start().run_mapped(open(cl)?, nc, &names, map))
    })?;
    pending.commit()
}

fn listing(program: &Program, cl: &Path, nc: &Path) -> Result<(), Error> {
    let path = nc.with_extension("lst");
    let mut listing = Listing::new(create(&path)?);
    let run = program.start().observe(listing.observer());
    files::write_whole(nc, |nc| run.stream(open(cl)?, nc))?;
    listing.finish().map(|_| ()).map_err(|error| files::cant_write(&path, &error))
}

fn page(program: &Program, cl: &Path, nc: &Path) -> Result<(), Error> {
    program.post_files(cl, nc)?;
    let bytes = files::read(nc)?;
    let text = Text { name: &nc.display().to_string(), bytes: &bytes };
    let drawing = plot::program(text, program.commons())?;
    let path = nc.with_extension("html");
    let mut page = create(&path)?;
    let written = write_html(&drawing, &mut page).and_then(|()| page.flush());
    written.map_err(|error| files::cant_write(&path, &error))
}

fn open(path: &Path) -> Result<File, Error> {
    File::open(path).map_err(|error| files::cant_read(path, &error))
}

fn create(path: &Path) -> Result<BufWriter<File>, Error> {
    File::create(path).map(BufWriter::new).map_err(|error| files::cant_write(path, &error))
}
