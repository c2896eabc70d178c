//! The local server of the studio: one page, the files of one folder, and the answers of
//! [`filpost_wasm`].
//!
//! The server listens on the loopback address only. It answers requests that have the token of its
//! address and come from its own page, by `Host` and `Origin`. It opens no file outside its folder
//! and never runs what a text names.
#![deny(missing_docs)]

pub mod browser;
mod folder;
mod http;
mod page;
mod presence;
mod server;

pub use server::Studio;
