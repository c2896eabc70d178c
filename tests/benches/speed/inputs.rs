//! The CL files that are posted: one made for the bench, and one of Creo.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use filpost_tests::cl_file;

use crate::Outcome;

/// Two tools of a milling job from Creo: rapids, feeds, GOTO.
const CREO: &str = "cl/creo/op010.ncl.1";

/// A CL file to post.
pub struct Input {
    /// Its name in the table.
    pub name: String,
    /// Where it lies.
    pub path: PathBuf,
    /// Its size in megabytes.
    pub megabytes: f64,
}

impl Input {
    fn new(kind: &str, path: PathBuf) -> Outcome<Self> {
        let megabytes = fs::metadata(&path)?.len() as f64 / 1e6;
        Ok(Input { name: format!("{kind}, {megabytes:.0} MB"), path, megabytes })
    }
}

/// The generated file.
///
/// # Errors
/// It can't be written.
pub fn generated(folder: &Path, megabytes: u64) -> Outcome<Input> {
    let path = folder.join("generated.ncl");
    cl_file::write(&path, megabytes * 1_000_000)?;
    Input::new("generated CL", path)
}

/// Creo's file, its tools repeated up to the size, and its inches taken for
/// millimetres, which have the decimals that the translators know; `None`, with
/// the reason printed, without the folder of outside data.
///
/// # Errors
/// It can't be read or written.
pub fn real(folder: &Path, megabytes: u64) -> Outcome<Option<Input>> {
    let data = std::env::var_os("FILPOST_DATA")
        .map_or_else(|| filpost_tests::root().join("../shared/data"), PathBuf::from);
    let Ok(text) = fs::read_to_string(data.join(CREO)) else {
        println!("real CL: skipped, FILPOST_DATA names no folder with {CREO}");
        return Ok(None);
    };
    let text = text.replace("UNITS / INCHES", "UNITS / MM").replace(" IPM", " MMPM");
    let (head, rest) = text.split_at(text.find("LOADTL").ok_or("no tool in Creo's file")?);
    let (body, foot) = rest.split_at(rest.rfind("FINI").ok_or("no end in Creo's file")?);
    let path = folder.join("real.ncl");
    let mut out = BufWriter::new(File::create(&path)?);
    out.write_all(head.as_bytes())?;
    for _ in 0..(megabytes as usize * 1_000_000).div_ceil(body.len()) {
        out.write_all(body.as_bytes())?;
    }
    out.write_all(foot.as_bytes())?;
    out.flush()?;
    drop(out);
    Ok(Some(Input::new("Creo's CL", path)?))
}
