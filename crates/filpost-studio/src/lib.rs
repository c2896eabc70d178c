//! The local server of the studio: one page, the files of one folder, and the answers of
//! [`filpost_wasm`].
//!
//! The server listens on the loopback address alone. Whoever asks it must know the token in its
//! address, and must be the page itself: `Host` and `Origin` are compared. It opens no file outside
//! of its folder and runs nothing that a text names.
#![deny(missing_docs)]

pub mod browser;
mod folder;
mod http;
mod page;
mod presence;
mod server;

pub use server::Studio;
