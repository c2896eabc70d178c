//! CL records from memory, for a program that has its tool path as data and not as text, and how
//! CL text is read.
//!
//! ```
//! use filpost::records::{Item, Record};
//!
//! let program = filpost::Program::builder().ready("fanuc-mill").build()?;
//! let mut vocabulary = program.vocabulary();
//! let mut word = |name| vocabulary.intern(name);
//! let units = Record::post(word("UNITS"), [Item::Word(word("MM"))])?;
//! let feed = Record::post(word("FEDRAT"), [200.0.into(), word("MMPM").into()])?;
//! let path = (0..3).map(|x| Record::goto([f64::from(x), 0.0, 5.0], None));
//! let records: Vec<Record> = [units, feed].into_iter().chain(path).collect();
//! let posted = program.post_records(vocabulary, records)?;
//! assert!(posted.text().contains("X2."));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use fil_cl::{
    Circle, ClDialect, Evidence, Item, Options, Recognized, Record, RecordBuilder, ShapeError,
    SplineCounts, Vocabulary, Word, WordId, WordView,
};
