//! The local server of the studio.
//!
//! **Goal.** A post made, run and judged in one page of the browser, with the files of one folder.
//!
//! **Model.** A [`Studio`] serves the page and the files of its folder; what the page asks of a post is
//! answered by [`filpost_wasm`]. `filpost studio` starts the program of this crate.
//!
//! **Quick start.** In a program with a command of its own:
//!
//! ```no_run
//! let studio = filpost_studio::Studio::open("my-post".as_ref(), 0)?;
//! println!("{}", studio.address());
//! studio.serve();
//! # Ok::<(), filpost::Error>(())
//! ```
//!
//! **Limits.** The server listens on the loopback address only. It answers requests that have the
//! token of its address and come from its own page, by `Host` and `Origin`. It opens no file outside
//! its folder and never runs what a text names.
//!
//! A tool of [filpost](https://crates.io/crates/filpost), without an API of its own: its items may
//! change in any version.
#![deny(missing_docs)]

pub mod browser;
mod folder;
mod http;
mod page;
mod presence;
mod server;
mod texts;
mod works;

pub use server::Studio;
