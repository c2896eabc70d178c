//! FIL texts as they are read, shown and formatted: one file a concern.

mod codes;
mod format;
mod generate;
mod long_texts;
mod properties;
mod published;
mod trees;
