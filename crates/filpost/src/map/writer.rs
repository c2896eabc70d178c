//! Writing a map while a run goes. A thread of its own makes the lines, so that
//! the run hardly waits for them.

use std::io::{self, Write};
use std::panic;
use std::sync::mpsc::{self, Receiver, Sender, SyncSender};
use std::thread::{self, JoinHandle};

use fil_post::tape::Tape;
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
    /// What the thread does not have yet.
    batch: Batch,
    /// Stacks of the run that are in a batch.
    stacks: usize,
    /// Where batches go.
    to: SyncSender<Batch>,
    /// Where they come back from, with their lines.
    from: Receiver<Batch>,
    /// Ends with what it knows of the program and the map.
    thread: JoinHandle<Lines>,
}

struct Output<'w> {
    output: &'w mut (dyn Write + Send),
    /// The first error; after it nothing more is written.
    failure: Option<io::Error>,
}

impl<'w> Writer<'w> {
    /// Starts a map.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn new(
        output: &'w mut (dyn Write + Send),
        names: &Names,
        module: &Module,
    ) -> io::Result<Self> {
        let (to, given) = mpsc::sync_channel(WAITING);
        let (back, from) = mpsc::channel();
        let named = thread::Builder::new().name("line map".into());
        let mut first = Vec::new();
        object(&header(names, module), &mut first);
        let mut output = Output { output, failure: None };
        output.write(&first);
        let lines = Lines::after(&first);
        let thread = named.spawn(move || make_lines(lines, &given, &back))?;
        Ok(Writer { output, batch: Batch::default(), stacks: 0, to, from, thread })
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
        drop(self.to);
        self.from.iter().for_each(|done| self.output.write(&done.lines));
        let ended = self.thread.join();
        let lines = ended.unwrap_or_else(|panicked| panic::resume_unwind(panicked));
        let mut last = Vec::new();
        object(&lines.end(cl), &mut last);
        self.output.write(&last);
        self.output.failure.map_or_else(|| self.output.output.flush(), Err)
    }

    /// Gives the batch to the thread, and writes what came back from it.
    fn give(&mut self) {
        let mut empty = Batch::default();
        for done in self.from.try_iter() {
            self.output.write(&done.lines);
            empty = done;
        }
        empty.clear();
        let full = std::mem::replace(&mut self.batch, empty);
        // Only a thread that has panicked takes nothing; the end will tell.
        let _ = self.to.send(full);
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

fn header(names: &Names, module: &Module) -> Header {
    let name = |index: usize, own: &str| names.fil.get(index).cloned().unwrap_or(own.into());
    let fil = module.files.iter().enumerate().map(|(index, file)| FilFile {
        name: name(index, &file.name),
        digest: Digest::of(file.text.as_bytes()),
    });
    Header {
        version: VERSION,
        cl: names.cl.clone(),
        nc: names.nc.clone(),
        fil: fil.collect(),
        sections: module.section_keys().map(str::to_string).collect(),
    }
}
