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
    /// The line map of the run; by default FILE.map, or a map in the same folder that lists FILE
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// The CL file of the run, if it has moved
    #[arg(long, value_name = "FILE")]
    pub cl: Option<PathBuf>,
    /// A FIL file of the run, if it has moved
    #[arg(long, value_name = "FILE")]
    pub fil: Vec<PathBuf>,
    /// Format of the answer
    #[arg(long, value_enum, default_value_t = AnswerFormat::Text)]
    pub format: AnswerFormat,
    #[command(flatten)]
    pub cl_reading: ClReading,
    #[command(flatten)]
    pub raw: RawRecords,
    /// Largest number of program lines to show; all are counted
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
