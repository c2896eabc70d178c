//! A CL record as the text of its statement, for messages and the listing.

use fil_cl::{Record, Vocabulary, writer::Writer};

/// The statement in Creo's layout, on one line.
pub fn statement_text(record: &Record, vocabulary: &Vocabulary) -> String {
    let mut writer = Writer::new(Vec::new());
    if writer.write(record, vocabulary).is_err() {
        return vocabulary.name(record.major).to_string();
    }
    let text = String::from_utf8_lossy(&writer.into_inner()).into_owned();
    let lines: Vec<&str> =
        text.lines().map(|line| line.trim().trim_end_matches('$').trim_end()).collect();
    lines.join(" ")
}
