//! FIL alone, without a machine and without a post: a script runs over a CL file, and what
//! reaches the post is printed as CL.
//!
//! `cargo run -p fil-vm --example interpret -- script.fil part.ncl`

use std::collections::VecDeque;
use std::fs;
use std::process::ExitCode;
use std::sync::Arc;

use fil_vm::cl::{Options, Reader, Record, Vocabulary, Writer};
use fil_vm::diag::Diag;
use fil_vm::errors::RunCode;
use fil_vm::{CommonKind, FilFile, Functions, Host, Interpreter, Limits, LoadOptions, Site, load};

/// The world of the script: records that wait, and the CL text that is made. It has no
/// commons, so POSTF(1), (2) and (3) are refused.
struct World {
    waiting: VecDeque<Record>,
    made: Writer<Vec<u8>>,
}

fn no_commons<T>() -> Result<T, Box<Diag>> {
    RunCode::Refused.err("there are no commons without a machine")
}

impl Host for World {
    fn common(&mut self, _: CommonKind, _: u32) -> Result<f64, Box<Diag>> {
        no_commons()
    }

    fn set_common(
        &mut self,
        _: CommonKind,
        _: u32,
        _: f64,
    ) -> Result<Option<Box<Diag>>, Box<Diag>> {
        no_commons()
    }

    fn clear_common(&mut self, _: CommonKind, _: u32) -> Result<Option<Box<Diag>>, Box<Diag>> {
        no_commons()
    }

    fn command(
        &mut self,
        record: &Record,
        vocab: &mut Vocabulary,
        _: &Site,
    ) -> Result<(), Box<Diag>> {
        self.made.write(record, vocab)
    }

    fn next_record(&mut self, to: &mut Record, _: &mut Vocabulary) -> Result<bool, Box<Diag>> {
        match self.waiting.pop_front() {
            Some(record) => {
                *to = record;
                Ok(true)
            }
            None => Ok(false),
        }
    }

    fn seek_record(
        &mut self,
        _: u32,
        _: &mut Record,
        _: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        RunCode::Refused.err("this program only goes forwards")
    }

    fn warn(&mut self, diag: Diag) {
        eprintln!("{diag}");
    }

    fn trace(&mut self, _: bool) {}
}

/// The CL text that a script makes of another.
///
/// # Errors
/// What is wrong in the script or the CL text, or was refused while the script ran.
fn interpret(fil: FilFile<'_>, cl: &[u8], cl_name: &str) -> Result<Vec<u8>, Vec<Diag>> {
    let mut vocab = Vocabulary::new();
    let loaded = load(&[fil], &mut vocab, LoadOptions::default())?;
    loaded.warnings.iter().for_each(|diag| eprintln!("{diag}"));
    let functions = Arc::new(Functions::new());
    let mut script = Interpreter::new(Arc::new(loaded.module), Limits::default(), functions);
    run(&mut script, &mut vocab, cl, cl_name).map_err(|diag| vec![*diag])
}

fn run(
    script: &mut Interpreter,
    vocab: &mut Vocabulary,
    cl: &[u8],
    cl_name: &str,
) -> Result<Vec<u8>, Box<Diag>> {
    let mut world = World { waiting: VecDeque::new(), made: Writer::new(Vec::new()) };
    let mut reader = Reader::new(cl, cl_name, Options::default());
    let mut record = Record::default();
    while reader.read(vocab, &mut record)? {
        world.waiting.push_back(record.clone());
    }
    script.run_globals(vocab, &mut world)?;
    while world.next_record(&mut record, vocab)? {
        match script.module().find(&record, vocab) {
            Some(section) => {
                script.run_section(section, &mut record, vocab, &mut world)?;
            }
            None => world.made.write(&record, vocab)?,
        }
    }
    Ok(world.made.into_inner())
}

fn main() -> ExitCode {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let [fil, cl] = &names[..] else {
        eprintln!("usage: interpret SCRIPT.fil PART.ncl");
        return ExitCode::from(2);
    };
    let (Ok(script), Ok(text)) = (fs::read(fil), fs::read(cl)) else {
        eprintln!("{fil} or {cl} can't be read");
        return ExitCode::FAILURE;
    };
    let script = String::from_utf8_lossy(&script);
    match interpret(FilFile { name: fil, text: &script }, &text, cl) {
        Ok(made) => {
            print!("{}", String::from_utf8_lossy(&made));
            ExitCode::SUCCESS
        }
        Err(diags) => {
            diags.iter().for_each(|diag| eprintln!("{diag}"));
            ExitCode::FAILURE
        }
    }
}

#[test]
fn a_section_changes_records() {
    let fil = "CIMFIL/ON,FEDRAT\nDMY=POSTF(8,4,POSTF(7,4)*2)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let cl = b"FEDRAT / 100, MMPM\nGOTO / 1, 2, 3\nFINI\n";
    let made = interpret(FilFile { name: "double.fil", text: fil }, cl, "part.ncl").unwrap();
    let made = String::from_utf8(made).unwrap();
    assert_eq!(made.lines().next(), Some("FEDRAT / 200.0, MMPM"), "{made}");
    assert!(made.contains("GOTO / 1.0, 2.0, 3.0"), "{made}");
}

#[test]
fn without_a_machine_commons_are_refused() {
    let fil = "X1=POSTF(1,1,5)\nFINI\n";
    let refused = interpret(FilFile { name: "x.fil", text: fil }, b"FINI\n", "part.ncl");
    assert!(refused.unwrap_err()[0].message.contains("no commons"));
}
