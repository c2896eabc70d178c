//! How far a request has come, and what stops it.

#[cfg(feature = "post")]
use std::io::{Read, Result, Seek, SeekFrom};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use filpost::CancelToken;

/// A request that another thread looks at: clones are of the same request.
#[derive(Clone, Debug, Default)]
pub struct Watch {
    token: CancelToken,
    read: Arc<AtomicU64>,
    whole: Arc<AtomicU64>,
}

impl Watch {
    /// Ends the request at its next CL record, with the error E0711.
    pub fn stop(&self) {
        self.token.cancel();
    }

    /// How much of the CL text the request has read, 0 to 1. It begins again where the text is read
    /// twice; a request that posts nothing stays at 0.
    pub fn share(&self) -> f64 {
        let whole = self.whole.load(Ordering::Relaxed).max(1);
        self.read.load(Ordering::Relaxed) as f64 / whole as f64
    }

    #[cfg(feature = "post")]
    pub(crate) fn token(&self) -> &CancelToken {
        &self.token
    }

    /// A text whose reading is watched.
    #[cfg(feature = "post")]
    pub(crate) fn reading<'w>(&'w self, text: &'w str) -> Reading<'w> {
        self.whole.store(text.len() as u64, Ordering::Relaxed);
        Reading { text: std::io::Cursor::new(text.as_bytes()), watch: self, told: 0 }
    }
}

/// A text that notes how far it was read.
#[cfg(feature = "post")]
pub(crate) struct Reading<'w> {
    text: std::io::Cursor<&'w [u8]>,
    watch: &'w Watch,
    /// The last hundredth that the host was told.
    told: u64,
}

#[cfg(feature = "post")]
impl Reading<'_> {
    fn note(&mut self) {
        self.watch.read.store(self.text.position(), Ordering::Relaxed);
        let hundredth = (self.watch.share() * 100.0) as u64;
        if std::mem::replace(&mut self.told, hundredth) != hundredth {
            tell(self.watch.share());
        }
    }
}

#[cfg(feature = "post")]
impl Read for Reading<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let length = self.text.read(buffer)?;
        self.note();
        Ok(length)
    }
}

#[cfg(feature = "post")]
impl Seek for Reading<'_> {
    fn seek(&mut self, to: SeekFrom) -> Result<u64> {
        let at = self.text.seek(to)?;
        self.note();
        Ok(at)
    }
}

/// Tells the host of the module how far a request has come. Elsewhere another thread looks.
#[cfg(all(feature = "post", target_family = "wasm"))]
fn tell(share: f64) {
    crate::border::progress(share);
}

#[cfg(all(feature = "post", not(target_family = "wasm")))]
fn tell(_share: f64) {}
