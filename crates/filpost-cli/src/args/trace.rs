//! The command line of `filpost trace`.

use std::path::PathBuf;

use clap::{Args as ClapArgs, ValueEnum};

use super::{ClReading, RawRecords};

/// `filpost trace`
#[derive(Debug, ClapArgs)]
pub struct TraceArgs {
    /// FILE:LINE of an NC program, a CL file or a FIL file; FILE:LINE:COLUMN of an NC program
    #[arg(value_name = "FILE:LINE[:COLUMN]")]
    pub place: String,
    /// The line map of the run; FILE.map, or the one beside that knows FILE, when left out
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// The CL file of the run, where it is now; where it lay as seen from the map when left out
    #[arg(long, value_name = "FILE")]
    pub cl: Option<PathBuf>,
    /// A FIL file of the run, where it is now
    #[arg(long, value_name = "FILE")]
    pub fil: Vec<PathBuf>,
    /// How the answer is written
    #[arg(long, value_enum, default_value_t = AnswerFormat::Text)]
    pub format: AnswerFormat,
    #[command(flatten)]
    pub cl_reading: ClReading,
    #[command(flatten)]
    pub raw: RawRecords,
    /// Most lines of the NC program that are shown; all are counted
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub most: usize,
    /// Encoding of CL and FIL texts (utf-8, cp1251, koi8-r, …); guessed when left out
    #[arg(long, value_name = "LABEL")]
    pub encoding: Option<String>,
}

/// How `filpost trace` writes its answer.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum AnswerFormat {
    /// For people
    Text,
    /// One JSON object
    Json,
}
