//! FIL text to tree: lexer (logos), grammar (lalrpop), diagnostics as plain data.
//!
//! [`parse`] never fails: it returns a tree of what could be read and a list of
//! diagnostics.

pub mod tree;
