//! The command line of `filpost plot`.

use std::path::PathBuf;

use clap::{Args as ClapArgs, ValueEnum};

use super::{Chosen, ClReading, Units};

/// `filpost plot`
#[derive(Debug, ClapArgs)]
pub struct PlotArgs {
    /// The CL file or the NC program; - reads standard input
    pub file: PathBuf,
    /// The machine that the program is for
    #[command(flatten)]
    pub chosen: Chosen,
    #[command(flatten)]
    pub units: Units,
    /// A CL file whose path is drawn under that of the program
    #[arg(long, value_name = "PART")]
    pub cl: Option<PathBuf>,
    /// A second NC program for the same machine whose path is drawn under that of the program
    #[arg(long, value_name = "NC", conflicts_with = "cl")]
    pub second: Option<PathBuf>,
    /// The line map of the program; FILE.map when it is there
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// The picture, .svg or .html; without it FILE.html if standard output is a terminal, or else
    /// SVG to standard output
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Views of an SVG; all of them when left out
    #[arg(long, value_enum, value_name = "VIEWS", value_delimiter = ',')]
    pub view: Vec<Seen>,
    #[command(flatten)]
    pub cl_reading: ClReading,
    /// Encoding of the CL file's texts (utf-8, cp1251, koi8-r, …); guessed when left out
    #[arg(long, value_name = "LABEL")]
    pub encoding: Option<String>,
}

/// A view of `filpost plot`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Seen {
    /// From above
    Xy,
    /// As at a lathe: Z to the right, X up
    Zx,
    /// Z to the right, Y up
    Zy,
    /// Isometric
    Iso,
}
