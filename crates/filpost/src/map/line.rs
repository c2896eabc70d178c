//! The lines of a map that are JSON objects.

use serde::{Deserialize, Serialize};

use super::digest::Digest;

/// The first line.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Header {
    /// Version of the format.
    #[serde(rename = "filpost-map")]
    pub version: u32,
    /// Name of the CL file, from the folder of the map.
    pub cl: String,
    /// Name of the NC program.
    pub nc: String,
    /// Encoding of the NC program, where it is not UTF-8.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub encoding: Option<String>,
    /// The FIL files; their digests are those of their texts in UTF-8.
    pub fil: Vec<FilFile>,
    /// Keys of the sections.
    pub sections: Vec<String>,
}

/// A FIL file of the header.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct FilFile {
    /// Its name.
    pub name: String,
    /// Its text.
    #[serde(flatten)]
    pub digest: Digest,
}

/// The last line.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct End {
    /// Number of lines of the NC program.
    pub lines: u64,
    /// The CL file.
    pub cl: Digest,
    /// The NC program.
    pub nc: Digest,
    /// The lines of the map before this one.
    pub map: Digest,
}

/// A FIL call stack.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StackLine {
    /// Its number; they count from 1.
    pub stack: u32,
    /// Index of its section.
    pub section: Option<u16>,
    /// File and line, innermost first.
    pub fil: Vec<(u16, u32)>,
}

/// A record that a section took without effect.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TakenLine {
    /// CL line and number of the record.
    pub taken: (u32, u32),
    /// Index of the section.
    pub section: u16,
}

/// A line between the first and the last that is an object.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum ObjectLine {
    /// A call stack.
    Stack(StackLine),
    /// A record without effect.
    Taken(TakenLine),
}
