//! The C side of filpost: opaque handles, owned errors, callbacks with user data.
//! `include/filpost.h` is made from these files.
//!
//! Two rules keep the border sound. Each function that C calls runs inside
//! [`guard::guarded`], so that no panic unwinds into C. Pointers are followed in
//! [`pointer`] alone, which says for each what the caller must promise.

mod block;
mod builder;
mod diagnostic;
mod error;
mod function;
mod guard;
mod output;
mod pointer;
mod program;
mod text;
