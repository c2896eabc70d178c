//! Writing a map while a run goes. A thread of its own makes the lines, so that
//! the run hardly waits for them; where the system has no threads, as in WebAssembly, the run
//! makes them itself.

use std::io::{self, Write};
use std::panic;
use std::sync::mpsc::{self, Receiver, Sender, SyncSender};
use std::thread::{self, JoinHandle};

use fil_post::tape::Tape;
use fil_text::CodePage;
use fil_vm::Module;

use super::VERSION;
use super::digest::Digest;
use super::line::{FilFile, Header};
use super::lines::{Batch, Lines, object};
use super::names::Names;
use super::reader::Taken;

/// Batches that wait for the thread at most.
const WAITING: usize = 2;

/// Records without effect that are kept before they go to the thread.
const TAKEN: usize = 4096;

/// Writes the map of one run.
pub(crate) struct Writer<'w> {
    output: Output<'w>,
    /// What has no lines yet.
    batch: Batch,
    /// Stacks of the run that are in a batch.
    stacks: usize,
    maker: Maker,
}

/// Who makes the lines.
enum Maker {
    /// A thread.
    Thread {
        /// Where batches go.
        to: SyncSender<Batch>,
        /// Where they come back from, with their lines.
        from: Receiver<Batch>,
        /// Ends with what it knows of the program and the map.
        thread: JoinHandle<Lines>,
    },
    /// The run itself.
    Run(Box<Lines>),
}

struct Output<'w> {
    output: &'w mut (dyn Write + Send),
    /// The first error; after it nothing more is written.
    failure: Option<io::Error>,
}

impl<'w> Writer<'w> {
    /// Starts a map.
    pub fn new(
        output: &'w mut (dyn Write + Send),
        names: &Names,
        module: &Module,
        page: CodePage,
    ) -> Self {
        Self::with_maker(output, header(names, module, page), |first| {
            Maker::thread(first).unwrap_or_else(|_| Maker::run(first))
        })
    }

    fn with_maker(
        output: &'w mut (dyn Write + Send),
        header: Header,
        maker: impl FnOnce(&[u8]) -> Maker,
    ) -> Self {
        let mut first = Vec::new();
        object(&header, &mut first);
        let mut output = Output { output, failure: None };
        output.write(&first);
        Writer { output, batch: Batch::default(), stacks: 0, maker: maker(&first) }
    }

    /// Takes the finished blocks off a tape.
    pub fn blocks(&mut self, tape: &mut Tape) {
        let stacks = tape.stacks.all();
        self.batch.stacks.extend_from_slice(&stacks[self.stacks..]);
        self.stacks = stacks.len();
        std::mem::swap(&mut self.batch.text, &mut tape.text);
        if let Some(noted) = &mut tape.noted {
            std::mem::swap(&mut self.batch.noted, noted);
        }
        self.give();
    }

    /// Notes a record that a section took without effect.
    pub fn taken(&mut self, taken: Taken) {
        self.batch.taken.push(taken);
        if self.batch.taken.len() >= TAKEN {
            self.give();
        }
    }

    /// Ends the map.
    ///
    /// # Errors
    /// The first error of the output.
    pub fn finish(mut self, cl: Digest) -> io::Result<()> {
        self.give();
        let lines = match self.maker {
            Maker::Run(lines) => *lines,
            Maker::Thread { to, from, thread } => {
                drop(to);
                from.iter().for_each(|done| self.output.write(&done.lines));
                thread.join().unwrap_or_else(|panicked| panic::resume_unwind(panicked))
            }
        };
        let mut last = Vec::new();
        object(&lines.end(cl), &mut last);
        self.output.write(&last);
        self.output.failure.map_or_else(|| self.output.output.flush(), Err)
    }

    /// Gives the batch to who makes its lines, and writes those that are made.
    fn give(&mut self) {
        match &mut self.maker {
            Maker::Run(lines) => {
                lines.write(&mut self.batch);
                self.output.write(&self.batch.lines);
                self.batch.clear();
            }
            Maker::Thread { to, from, .. } => {
                let mut empty = Batch::default();
                for done in from.try_iter() {
                    self.output.write(&done.lines);
                    empty = done;
                }
                empty.clear();
                let full = std::mem::replace(&mut self.batch, empty);
                // Only a thread that has panicked takes nothing; the end will tell.
                let _ = to.send(full);
            }
        }
    }
}

impl Maker {
    /// A thread, for the lines behind the first one.
    fn thread(first: &[u8]) -> io::Result<Maker> {
        let (to, given) = mpsc::sync_channel(WAITING);
        let (back, from) = mpsc::channel();
        let lines = Lines::after(first);
        let thread = thread::Builder::new()
            .name("line map".into())
            .spawn(move || make_lines(lines, &given, &back))?;
        Ok(Maker::Thread { to, from, thread })
    }

    /// The run, for the lines behind the first one.
    fn run(first: &[u8]) -> Maker {
        Maker::Run(Box::new(Lines::after(first)))
    }
}

impl Output<'_> {
    fn write(&mut self, lines: &[u8]) {
        if self.failure.is_none() {
            self.failure = self.output.write_all(lines).err();
        }
    }
}

/// Makes the lines of the batches that come, until no more come.
fn make_lines(mut lines: Lines, given: &Receiver<Batch>, back: &Sender<Batch>) -> Lines {
    for mut batch in given {
        lines.write(&mut batch);
        // A run that failed does not wait for its map.
        let _ = back.send(batch);
    }
    lines
}

fn header(names: &Names, module: &Module, page: CodePage) -> Header {
    let name = |index: usize, own: &str| names.fil.get(index).cloned().unwrap_or(own.into());
    let fil = module.files.iter().enumerate().map(|(index, file)| FilFile {
        name: name(index, &file.name),
        digest: Digest::of(file.text.as_bytes()),
    });
    Header {
        version: VERSION,
        cl: names.cl.clone(),
        nc: names.nc.clone(),
        encoding: (!page.is_utf8()).then(|| page.name().to_string()),
        fil: fil.collect(),
        sections: module.section_keys().map(str::to_string).collect(),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use fil_cl::{Options, Reader};

    use super::*;
    use crate::Program;
    use crate::map::Digested;

    /// The map of a run, and who made its lines.
    fn map(maker: impl FnOnce(&[u8]) -> Maker) -> String {
        let fil = "CIMFIL/ON,COOLNT\nIF(POSTF(7,4).EQ.72) THEN\nENDIF\nCIMFIL/OFF\nFINI\n";
        let program =
            Program::builder().generic("fanuc-mill").fil("cool.fil", fil).build().unwrap();
        let moves: String = (0..20_000).map(|n| format!("GOTO / {}, 2, 3\n", n % 5000)).collect();
        let text = format!("UNITS / MM\nLOADTL / 1\nFEDRAT / 9, MMPM\n{moves}COOLNT / ON\nFINI\n");
        let mut cl = Digested::new(Cursor::new(text)).unwrap();
        let reader = Reader::seekable(&mut cl, "part.ncl", Options::default());
        let names = Names { cl: "part.ncl".into(), nc: "part.nc".into(), fil: Vec::new() };
        let header = header(&names, &program.shared.module, CodePage::UTF_8);
        let mut made = Vec::new();
        let writer = Writer::with_maker(&mut made, header, maker);
        let (done, map) = program.start().post_reader(reader, None, Some(writer), &mut Vec::new());
        done.unwrap();
        map.unwrap().finish(cl.finish().unwrap()).unwrap();
        String::from_utf8(made).unwrap()
    }

    #[test]
    fn a_run_without_a_thread_writes_the_same_map() {
        let by_thread = map(|first| Maker::thread(first).unwrap());
        assert!(by_thread.lines().count() > 20_000);
        assert!(map(Maker::run) == by_thread, "the maps differ");
    }
}
