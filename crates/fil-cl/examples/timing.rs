//! How fast GOTO lines are read: `cargo run --release --example timing [lines]`.

use std::hint::black_box;
use std::io::{self, Read};
use std::time::Instant;

use fil_cl::{Options, Reader, Record, Vocabulary};

/// Gives the same block of text a number of times.
struct Again<'a> {
    block: &'a [u8],
    at: usize,
    times: usize,
}

impl Read for Again<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.at == self.block.len() && self.times > 1 {
            (self.at, self.times) = (0, self.times - 1);
        }
        let count = buffer.len().min(self.block.len() - self.at);
        buffer[..count].copy_from_slice(&self.block[self.at..self.at + count]);
        self.at += count;
        Ok(count)
    }
}

fn main() {
    let start = Instant::now();
    for _ in 0..100 {
        black_box(Vocabulary::new());
    }
    println!("vocabulary: {:?}", start.elapsed() / 100);
    let lines: usize =
        std::env::args().nth(1).and_then(|arg| arg.parse().ok()).unwrap_or(5_000_000);
    let point = |n: usize| {
        let angle = n as f64 * 0.37;
        (angle.sin() * 123.456, angle.cos() * 78.9, -(n as f64) * 0.0123)
    };
    let goto = |n| {
        let (x, y, z) = point(n);
        format!("GOTO / {x:.10}, {y:.10}, {z:.10}\n")
    };
    let mixed = |n| format!("RAPID \nFEDRAT / 400.000000,  MMPM\n{}", goto(n));
    time("GOTO", &(0..10_000).map(goto).collect::<String>(), lines / 10_000);
    time("RAPID, FEDRAT, GOTO", &(0..10_000).map(mixed).collect::<String>(), lines / 30_000);
}

fn time(name: &str, block: &str, times: usize) {
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let input = Again { block: block.as_bytes(), at: 0, times };
    let mut reader = Reader::new(input, "timing", Options::default());
    let start = Instant::now();
    let mut sum = 0.0;
    while reader.read(&mut vocab, &mut record).expect("the text is right") {
        sum += record.point().map_or(0.0, |point| point[0]);
    }
    let seconds = start.elapsed().as_secs_f64();
    let (count, bytes) = (f64::from(reader.record_number()), (block.len() * times) as f64);
    black_box(sum);
    println!("{name}: {:.1} M records/s, {:.0} MB/s", count / seconds / 1e6, bytes / seconds / 1e6);
}
