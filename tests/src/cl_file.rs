//! A CL file of any size in Creo's layout: a path of straight moves as milling
//! of a free surface makes them, the same in every run.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

const HEAD: &str = "$$*          Pro/CLfile  Version 8.0 - 8.0.3.0\n\
    $$-> MFGNO / BENCH\n\
    PARTNO / BENCH\n\
    MACHIN / UNCX01, 1\n\
    UNITS / MM\n\
    LOADTL / 1\n\
    SPINDL / RPM, 8000.000000,  CLW\n\
    FEDRAT / 1200.000000,  MMPM\n";

/// Points of one row of the zig-zag.
const ROW: u32 = 60;

/// Rows on one height before the path goes on to the next kind of cut.
const ROWS: u32 = 40;

/// A simple generator of numbers (xorshift), started the same way each time.
struct Numbers(u64);

impl Numbers {
    /// The next number, from 0 to 1.
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Writes about `bytes` bytes; gives the number of GOTO statements.
pub fn write(path: &Path, bytes: u64) -> io::Result<u64> {
    let mut out = BufWriter::with_capacity(1 << 20, File::create(path)?);
    out.write_all(HEAD.as_bytes())?;
    let mut numbers = Numbers(0x9E37_79B9_7F4A_7C15);
    let mut written = HEAD.len() as u64;
    let mut points = 0;
    let mut area = 0;
    let mut line = Vec::new();
    while written < bytes {
        let start = [numbers.next() * 200.0 - 100.0, numbers.next() * 200.0 - 100.0];
        for point in 0..ROW * ROWS {
            let [x, y, z] = match area % 3 {
                0 => plane_point(start, point),
                1 => surface_point(start, point),
                _ => free_point(start, point, &mut numbers),
            };
            line.clear();
            writeln!(line, "GOTO / {x:.10}, {y:.10}, {z:.10}")?;
            out.write_all(&line)?;
            written += line.len() as u64;
            points += 1;
        }
        area += 1;
    }
    out.write_all(b"FINI\n")?;
    out.flush()?;
    Ok(points)
}

/// Where point number `point` of a zig-zag lies: along the row, across the rows.
fn zig_zag(point: u32) -> (f64, f64) {
    let (row, along) = (point / ROW, point % ROW);
    let along = if row % 2 == 0 { along } else { ROW - 1 - along };
    (f64::from(along), f64::from(row))
}

/// A plane is cleared: Z stays, and only X moves within a row.
fn plane_point(start: [f64; 2], point: u32) -> [f64; 3] {
    let (along, across) = zig_zag(point);
    [start[0] + along * 0.731, start[1] + across * 1.5, -2.5]
}

/// A surface is followed in rows: X and Z move, Y stays within a row.
fn surface_point(start: [f64; 2], point: u32) -> [f64; 3] {
    let (along, across) = zig_zag(point);
    let (x, y) = (start[0] + along * 0.377, start[1] + across * 0.25);
    [x, y, 8.0 * (x * 0.05).sin() * (y * 0.07).cos() - 10.0]
}

/// Rows askew over a rough surface: all three axes move.
fn free_point(start: [f64; 2], point: u32, numbers: &mut Numbers) -> [f64; 3] {
    let (along, across) = zig_zag(point);
    let x = start[0] + along * 0.5 + across * 0.01;
    let y = start[1] + across * 0.3 + along * 0.02;
    [x, y, numbers.next() * 0.2 - 12.0]
}
