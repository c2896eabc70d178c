//! Length and hash of a file, to tell it from another one.

use std::hash::Hasher;
use std::io::{self, Read, Seek, SeekFrom, Write};

use serde::{Deserialize, Serialize};
use twox_hash::XxHash3_64;

/// Bytes read at once.
const CHUNK: usize = 256 * 1024;

/// Length and hash (XXH3, 64 bits, seed 0) of a file. It tells files apart that
/// were mixed up; it is no proof against forgery.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Digest {
    /// Length in bytes.
    pub bytes: u64,
    /// The hash, 16 hexadecimal digits.
    pub hash: String,
}

impl Digest {
    /// The digest of bytes.
    pub fn of(bytes: &[u8]) -> Digest {
        let mut digesting = Digesting::default();
        digesting.add(bytes);
        digesting.digest()
    }

    /// The digest of all that a reader gives.
    ///
    /// # Errors
    /// The reader's own.
    pub fn of_reader(mut input: impl Read) -> io::Result<Digest> {
        let mut digesting = Digesting::default();
        let mut buffer = vec![0; CHUNK];
        loop {
            match input.read(&mut buffer) {
                Ok(0) => return Ok(digesting.digest()),
                Ok(count) => digesting.add(&buffer[..count]),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
}

/// A digest in the making.
#[derive(Default)]
pub(crate) struct Digesting {
    bytes: u64,
    hash: XxHash3_64,
}

impl Digesting {
    /// Adds the bytes that follow.
    pub fn add(&mut self, bytes: &[u8]) {
        self.bytes += bytes.len() as u64;
        self.hash.write(bytes);
    }

    /// The digest of what was added.
    pub fn digest(&self) -> Digest {
        Digest { bytes: self.bytes, hash: format!("{:016x}", self.hash.finish()) }
    }
}

/// A reader that keeps the digest of its input while it is read.
pub(crate) struct Digested<R> {
    input: R,
    /// Where the next read begins.
    at: u64,
    digesting: Digesting,
}

impl<R: Read + Seek> Digested<R> {
    /// An input from where it stands, which is taken for its start.
    pub fn new(mut input: R) -> io::Result<Self> {
        input.rewind()?;
        Ok(Digested { input, at: 0, digesting: Digesting::default() })
    }

    /// The digest of the whole input; what was not read yet is read now.
    pub fn finish(mut self) -> io::Result<Digest> {
        self.input.seek(SeekFrom::Start(self.digesting.bytes))?;
        let mut rest = Rest(self.digesting);
        io::copy(&mut self.input, &mut rest)?;
        Ok(rest.0.digest())
    }
}

impl<R: Read> Read for Digested<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.input.read(buffer)?;
        // A reader that goes back gives again what is known already.
        let known = self.digesting.bytes.saturating_sub(self.at) as usize;
        if self.at <= self.digesting.bytes && known < count {
            self.digesting.add(&buffer[known..count]);
        }
        self.at += count as u64;
        Ok(count)
    }
}

impl<R: Seek> Seek for Digested<R> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.at = self.input.seek(to)?;
        Ok(self.at)
    }
}

/// Takes bytes into a digest.
struct Rest(Digesting);

impl Write for Rest {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.add(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_hash_is_the_published_one() {
        // XXH3_64 of nothing, from the algorithm's reference implementation.
        assert_eq!(Digest::of(b""), Digest { bytes: 0, hash: "2d06800538d394c2".into() });
    }

    proptest! {
        #[test]
        fn the_way_of_reading_does_not_matter(
            bytes: Vec<u8>, steps in prop::collection::vec((0u64..2000, 0usize..700), 0..20)
        ) {
            let mut input = Digested::new(Cursor::new(&bytes)).unwrap();
            for (to, count) in steps {
                input.seek(SeekFrom::Start(to.min(bytes.len() as u64))).unwrap();
                let mut buffer = vec![0; count];
                let _ = input.read(&mut buffer).unwrap();
            }
            prop_assert_eq!(input.finish().unwrap(), Digest::of(&bytes));
            prop_assert_eq!(Digest::of_reader(&bytes[..]).unwrap(), Digest::of(&bytes));
        }
    }
}
