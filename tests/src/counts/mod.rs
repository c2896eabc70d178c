//! Everything counts: a record with an item left out or changed, and a machine with
//! another value of a setting, must not give the same program with the same messages;
//! or the table of things without effect says why.

pub mod corpus;
pub mod excuse;
pub mod letter;
pub mod settings;
pub mod statement;
pub mod trial;
pub mod walk;
