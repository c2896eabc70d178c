//! Reads a CL file and says how many records it has, or writes a text of a dialect with
//! about so many lines:
//! `cargo run -p fil-cl --example read_cl -- part.ncl`,
//! `cargo run -p fil-cl --example read_cl -- --make catia 1000 >part.aptsource`.

mod dialect_text;

use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

use fil_cl::{ClDialect, Options, Reader, Record, Vocabulary};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match arguments[..] {
        ["--make", dialect, lines] => match (ClDialect::named(dialect), lines.parse()) {
            (Some(dialect), Ok(lines)) => make(dialect, lines),
            _ => Err(format!("no dialect {dialect}, or {lines} is no number")),
        },
        [file] => read(file),
        _ => Err("usage: read_cl FILE | read_cl --make DIALECT LINES".into()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn make(dialect: ClDialect, lines: u64) -> Result<(), String> {
    let mut output = BufWriter::new(io::stdout().lock());
    let written = dialect_text::write(dialect, lines, &mut output).and_then(|_| output.flush());
    written.map_err(|error| error.to_string())
}

fn read(file: &str) -> Result<(), String> {
    let input = std::fs::File::open(file).map_err(|error| error.to_string())?;
    let mut reader = Reader::new(input, file, Options::default());
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    while reader.read(&mut vocabulary, &mut record).map_err(|diag| diag.to_string())? {}
    println!("{} records, dialect {}", reader.record_number(), reader.recognized());
    Ok(())
}
