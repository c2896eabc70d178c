//! A program that embeds filpost: threads, cancel, functions, observers, records
//! from memory, and what goes wrong in them.

use std::io::{self, Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Barrier};
use std::thread;
use std::time::{Duration, Instant};

use filpost::cl::{Record, Vocabulary, Word, words};
use filpost::{Builder, CancelToken, Error, Event, Program, Returned};

const PART: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\n\
                    GOTO / 0, 0, 5\nGOTO / 10, 0, 5\nGOTO / 10, 20, 5\nFINI\n";

/// A section that counts its tools, so that a run that starts from the state of
/// another one would differ.
const COUNTING: &str = "NN=0\nCIMFIL/ON,LOADTL\nNN=NN+1\nT1=TEXT/'TOOL NO ',NN,' ',TNAMEF(POSTF(7,4))\n\
                        PPRINT/T1\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";

fn mill() -> Builder {
    Program::builder().generic("fanuc-mill")
}

fn counting() -> Program {
    let name = |arguments: &[filpost::Argument<'_>]| match arguments[0].number() {
        Some(number) => Ok(format!("T{number}")),
        None => Err("no number".to_string()),
    };
    mill().fil("count.fil", COUNTING).function("TNAMEF", 1, name).build().expect("a program")
}

fn nc(program: &Program, cl: &str) -> Result<String, Error> {
    let mut nc = Vec::new();
    program.stream(cl.as_bytes(), &mut nc)?;
    Ok(String::from_utf8(nc).expect("a program is text"))
}

fn codes(error: &Error) -> Vec<String> {
    error.diags().iter().map(|diag| diag.code.name()).collect()
}

#[test]
fn a_hundred_runs_of_one_program_give_the_same_bytes() {
    let program = counting();
    let alone = nc(&program, PART).expect("a program");
    assert!(alone.contains("(TOOL NO 1 T1)"), "{alone}");
    let gate = Arc::new(Barrier::new(100));
    let runs: Vec<_> = (0..100)
        .map(|_| {
            let (program, gate) = (program.clone(), Arc::clone(&gate));
            thread::spawn(move || {
                gate.wait();
                nc(&program, PART)
            })
        })
        .collect();
    for run in runs {
        assert_eq!(run.join().expect("no panic").expect("a program"), alone);
    }
}

/// What the stream repeats.
const TWO_POINTS: &[u8] = b"GOTO / 1, 2, 3\nGOTO / 2, 3, 4\n";

/// A CL stream that never ends.
struct Endless {
    reads: usize,
    /// Where the next read begins in [`TWO_POINTS`].
    at: usize,
    cancel_at: usize,
    token: CancelToken,
}

impl Read for Endless {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.reads += 1;
        if self.reads == self.cancel_at {
            self.token.cancel();
        }
        if self.reads == 1 {
            let head = b"UNITS / MM\nFEDRAT / 200, MMPM\n";
            buffer[..head.len()].copy_from_slice(head);
            return Ok(head.len());
        }
        let count = buffer.len().min(3000);
        let text = TWO_POINTS.iter().cycle().skip(self.at);
        buffer[..count].iter_mut().zip(text).for_each(|(to, from)| *to = *from);
        self.at = (self.at + count) % TWO_POINTS.len();
        Ok(count)
    }
}

#[test]
fn a_stream_without_end_is_cancelled() {
    let token = CancelToken::new();
    let endless = Endless { reads: 0, at: 0, cancel_at: 50, token: token.clone() };
    let program = mill().build().expect("a program");
    let error = program.start().cancel(&token).stream(endless, io::sink()).expect_err("cancelled");
    assert!(error.is_cancelled() && codes(&error) == ["E0711"], "{error}");
    // A token that is set stops a run before its first record.
    let mut blocks = program.start().cancel(&token).blocks(PART.as_bytes());
    assert!(blocks.next().expect("an error").expect_err("cancelled").is_cancelled());
    assert!(blocks.next().is_none());
    assert_eq!(blocks.report().records, 0);
    assert!(nc(&program, PART).is_ok(), "other runs go on");
}

/// The error of running this FIL text, cancelled after a moment, and how long it
/// took after that.
fn cancelled(fil: &str) -> (Error, Duration) {
    let program = mill().fil("loop.fil", fil).function("WAITF", 0, |_| {
        thread::sleep(Duration::from_millis(1));
        Ok(1.0)
    });
    let program = program.build().expect("a program");
    let token = CancelToken::new();
    let stop = token.clone();
    let run =
        thread::spawn(move || program.start().cancel(&token).stream(PART.as_bytes(), io::sink()));
    thread::sleep(Duration::from_millis(100));
    let start = Instant::now();
    stop.cancel();
    let error = run.join().expect("no panic").expect_err("cancelled");
    (error, start.elapsed())
}

#[test]
fn a_loop_of_fil_is_cancelled_with_its_line() {
    let long = "TT=TEXT/REPEAT,'ABCDEFGH',100000\nLA) T1=TEXT/MODIFY,TT,'A','B'\nJUMPTO/LA\nFINI\n";
    for fil in [
        "LA) XX=1\nJUMPTO/LA\nFINI\n",
        "DO/LA,II=1,999999999\nLA) CONTIN\nFINI\n",
        "LA) XX=WAITF()\nJUMPTO/LA\nFINI\n",
        "MM=MACRO\nXX=1\nTERMAC\nLA) CALL/MM\nJUMPTO/LA\nFINI\n",
        long,
    ] {
        let (error, time) = cancelled(fil);
        assert!(error.is_cancelled(), "{fil}: {error}");
        assert_eq!(error.diags()[0].spans[0].file, "loop.fil", "{fil}");
        assert!(time < Duration::from_secs(5), "{fil}: {time:?}");
    }
}

#[test]
fn a_function_that_panics_hurts_only_its_run() {
    let fil = "CIMFIL/ON,LOADTL\nXX=SHAKYF(POSTF(7,4))\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let shaky = |arguments: &[filpost::Argument<'_>]| {
        assert_ne!(arguments[0].number(), Some(13.0), "no tool 13");
        Ok(1.0)
    };
    let program =
        mill().fil("shaky.fil", fil).function("SHAKYF", 1, shaky).build().expect("a program");
    let unlucky = PART.replace("LOADTL / 1", "LOADTL / 13");
    let panicked = catch_unwind(AssertUnwindSafe(|| nc(&program, &unlucky)));
    assert!(panicked.is_err());
    assert!(nc(&program, PART).is_ok(), "the program is as it was");
}

#[test]
fn a_name_that_fil_has_is_refused_when_the_program_is_built() {
    let build = |name| mill().function(name, 1, |_| Ok(0.0)).build();
    for name in ["SQRTF", "sqrtf", "IF", "GOTO", "X", "9"] {
        assert_eq!(codes(&build(name).expect_err("refused")), ["E0229"], "{name}");
    }
    assert!(build("MYSQRTF").is_ok());
}

#[test]
fn a_function_returns_numbers_and_texts_and_refuses() {
    let fil = "XX=PICKF(1)\nT1=PICKF(2)\nPPRINT/T1\nIF(XX.GT.5)PPRINT/'MORE'\nFINI\n";
    let pick = |arguments: &[filpost::Argument<'_>]| match arguments[0].number() {
        Some(1.0) => Ok(Returned::Number(6.0)),
        Some(2.0) => Ok("SIX".into()),
        _ => Err("1 or 2".to_string()),
    };
    let built = |fil: &str| mill().fil("pick.fil", fil).function("PICKF", 1, pick).build();
    let text = nc(&built(fil).expect("a program"), PART).expect("a program");
    assert!(text.contains("(SIX)") && text.contains("(MORE)"), "{text}");
    let error = nc(&built("XX=PICKF(3)\nFINI\n").expect("a program"), PART).expect_err("refused");
    assert_eq!(codes(&error), ["E0317"]);
    assert_eq!((error.diags()[0].spans[0].line, error.is_cancelled()), (1, false));
}

/// A writer with room for some bytes.
struct Small(usize);

impl Write for Small {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Err(io::Error::other("the line was cut"))
    }
}

#[test]
fn a_writer_that_fails_stops_the_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let fil = "DMY=FILEF(1,WRITE,'log.txt')\nWRITE/1,'DONE'\nFINI\n";
    let program = mill().fil("log.fil", fil).grant_write(folder.path()).build().expect("a program");
    for room in [10, 1000] {
        let error = program.stream(PART.as_bytes(), Small(room)).expect_err("no room");
        assert_eq!(codes(&error), ["E0702"], "{room}");
        let files = std::fs::read_dir(folder.path()).expect("the folder").count();
        assert_eq!(files, 0, "files of scripts are not committed");
    }
}

#[test]
fn observers_hear_everything_in_order() {
    let program = counting();
    let cl = PART.replace("FINI\n", "PPRINT / ON TAPE\n");
    let mut events = Vec::new();
    let report = program
        .start()
        .cl_name("part.ncl")
        .observe(|event| {
            events.push(match event {
                Event::Record { record, vocabulary, .. } => {
                    format!("record {} {}", record.number, vocabulary.name(record.major))
                }
                Event::Section { key, record, swallowed, .. } => {
                    format!("section {key} {record} {swallowed}")
                }
                Event::Block { text, origin, .. } => format!("block {text} {}", origin.record),
                Event::Message(text) => format!("message {text}"),
                Event::Warning(diag) => format!("warning {}", diag.code.name()),
                other => format!("{other:?}"),
            });
        })
        .stream(cl.as_bytes(), io::sink())
        .expect("a program");
    let at = |what: &str| {
        let found = events.iter().position(|event| event.starts_with(what));
        found.unwrap_or_else(|| panic!("{what} in {events:?}"))
    };
    assert!(at("record 3 LOADTL") < at("section LOADTL 3 false"));
    assert!(at("section LOADTL") < at("block N20 (TOOL NO 1 T1) 3"), "{events:?}");
    assert!(at("warning W0752") > at("record 9 PPRINT"));
    let blocks = events.iter().filter(|event| event.starts_with("block ")).count();
    assert_eq!(report.blocks, blocks as u64);
    let warned = events.iter().filter(|event| event.starts_with("warning ")).count();
    assert_eq!(report.warnings.len(), warned);
}

#[test]
fn a_slow_observer_changes_nothing() {
    let program = counting();
    let heard = AtomicUsize::new(0);
    let mut text = Vec::new();
    let slow = |_: Event<'_>| {
        thread::sleep(Duration::from_millis(2));
        heard.fetch_add(1, Ordering::Relaxed);
    };
    program.start().observe(slow).stream(PART.as_bytes(), &mut text).expect("a program");
    assert_eq!(String::from_utf8_lossy(&text), nc(&program, PART).expect("a program"));
    assert!(heard.into_inner() > 9);
}

#[test]
fn blocks_are_the_program_and_end_with_the_report() {
    let program = counting();
    let mut blocks = program.start().cl_name("part.ncl").blocks(PART.as_bytes());
    let texts: Vec<String> =
        blocks.by_ref().map(|block| block.expect("a block").text + "\n").collect();
    assert_eq!(texts.concat(), nc(&program, PART).expect("a program"));
    let report = blocks.report();
    assert_eq!((report.records, report.blocks), (9, texts.len() as u64));
    assert_eq!(report.bytes, texts.concat().len() as u64);
    let cut = PART.replace("FINI\n", "");
    let mut blocks = program.blocks(cut.as_bytes());
    assert!(blocks.by_ref().all(|block| block.is_ok()));
    assert_eq!(blocks.report().warnings[0].code.name(), "W0752");
    assert!(blocks.next().is_none());
}

/// The records of [`PART`], made by hand.
fn records(vocabulary: &mut Vocabulary) -> Vec<Record> {
    let mut command = |major, items: &[&str]| {
        let mut record = Record::command(major);
        for item in items {
            let number = item.parse().map(Word::Number);
            record.data.push(number.unwrap_or_else(|_| Word::Minor(vocabulary.intern(item))));
        }
        record
    };
    let mut list = vec![
        Record::text_command(words::PARTNO, "7"),
        command(words::UNITS, &["MM"]),
        command(words::LOADTL, &["1"]),
        command(words::SPINDL, &["RPM", "900", "CLW"]),
        command(words::FEDRAT, &["200", "MMPM"]),
    ];
    let points = [[0.0, 0.0, 5.0], [10.0, 0.0, 5.0], [10.0, 20.0, 5.0]];
    list.extend(points.map(|point| Record::goto(point, None)));
    list.push(Record::statement(words::FINI, Vec::new(), String::new()).expect("FINI"));
    list
}

#[test]
fn records_from_memory_give_the_program_of_their_text() {
    let program = counting();
    let mut vocabulary = program.vocabulary();
    let list = records(&mut vocabulary);
    let mut out = Vec::new();
    let report = program.stream_records(vocabulary, list, &mut out).expect("a program");
    assert_eq!(String::from_utf8_lossy(&out), nc(&program, PART).expect("a program"));
    assert_eq!(report.records, 9);
}

#[test]
fn records_from_memory_are_named_by_their_numbers() {
    let program = mill().build().expect("a program");
    let mut vocabulary = program.vocabulary();
    let mut list = records(&mut vocabulary);
    list[6] = Record::goto([1e6, 0.0, 5.0], None);
    let run = program.start().cl_name("path of the robot");
    let error = run.stream_records(vocabulary, list, io::sink()).expect_err("beyond the limits");
    assert_eq!(codes(&error), ["E0501"]);
    let place = &error.diags()[0].spans[0];
    assert_eq!((place.file.as_str(), place.line), ("path of the robot", 7));
    // Going back is for CL files.
    let fil = "CIMFIL/ON,SPINDL\nDMY=POSTF(15)\nCIMFIL/OFF\nFINI\n";
    let program = mill().fil("back.fil", fil).build().expect("a program");
    let mut vocabulary = program.vocabulary();
    let list = records(&mut vocabulary);
    let error = program.stream_records(vocabulary, list, io::sink()).expect_err("no way back");
    assert_eq!(codes(&error), ["E0409"]);
}

#[test]
fn records_that_no_statement_makes_are_refused() {
    let program = counting();
    let refused = |change: &dyn Fn(&mut Vec<Record>)| {
        let mut vocabulary = program.vocabulary();
        let mut list = records(&mut vocabulary);
        change(&mut list);
        let run = program.stream_records(vocabulary, list, io::sink());
        let error = run.expect_err("refused");
        assert_eq!(codes(&error), ["E0712"]);
        error.to_string().lines().next().map(str::to_string).expect("a line")
    };
    let said = refused(&|list| list[6] = Record::goto([0.0, f64::INFINITY, 0.0], None));
    assert_eq!(said, "E0712 CL:7:1: record 7: word 7 is not finite");
    let said = refused(&|list| list[0] = Record::text_command(words::PPRINT, "A\nG0 Z-100"));
    assert!(said.ends_with("its text holds a control character"), "{said}");
    refused(&|list| list[5] = Record::command(words::GOTO));
    refused(&|list| {
        let mut other = Vocabulary::new();
        for number in 0..100 {
            other.intern(&format!("OWN{number}"));
        }
        list[1] = Record::command(other.intern("OWNLAST"));
    });
}

#[test]
fn a_vocabulary_of_another_program_is_refused() {
    let fil = "CIMFIL/ON,LOADTL\nIF(HASF(EMBOSL).EQ.1)STOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let program = mill().fil("word.fil", fil).build().expect("a program");
    let mut other = Vocabulary::new();
    other.intern("EMBOSR");
    let list = records(&mut other);
    let error = program.stream_records(other, list, io::sink()).expect_err("refused");
    assert_eq!(codes(&error), ["E0712"]);
}

#[test]
fn an_iterator_of_records_is_not_gathered() {
    let program = mill().build().expect("a program");
    let vocabulary = program.vocabulary();
    let mut before = records(&mut program.vocabulary());
    before.truncate(5);
    let given = AtomicUsize::new(0);
    let token = CancelToken::new();
    let path = std::iter::repeat_with(|| {
        // An endless path, stopped after a while.
        if given.fetch_add(1, Ordering::Relaxed) == 100_000 {
            token.cancel();
        }
        let x = given.load(Ordering::Relaxed) % 100;
        Record::goto([x as f64, 0.0, 5.0], None)
    });
    let run = program.start().cancel(&token);
    let all = before.into_iter().chain(path);
    let error = run.stream_records(vocabulary, all, io::sink()).expect_err("cancelled");
    assert!(error.is_cancelled());
    assert!((100_001..100_010).contains(&given.into_inner()));
}
