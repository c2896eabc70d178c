//! The motions behind a RAPID, for a post that chooses its rotary positions by them.

use fil_cl::record::Word;
use fil_cl::record::{kind, motion};
use fil_cl::{Record, Vocabulary, words};
use fil_machine::Commons;
use fil_machine::locations::{self as loc, ReposOptimiseSpan};
use fil_machine::setting::CodeAt;
use fil_post::path::Coming;

use crate::source::Source;

/// Most records that are looked through.
const MOST: usize = 2000;

/// A word of the CL file that opens or closes the stretch of a look-ahead.
#[derive(Clone, Copy, Debug)]
struct Mark {
    /// Code of its major word.
    major: f64,
    /// Code of a minor word that stands behind it; `None` for any or none.
    minor: Option<f64>,
}

impl Mark {
    /// The one that settings name; `None` where they name no major word.
    fn of(commons: &Commons, [major, minor]: [CodeAt; 2]) -> Option<Mark> {
        let code = |at: CodeAt| commons.read(at).map(f64::from);
        Some(Mark { major: code(major)?, minor: code(minor) })
    }

    /// True for its record.
    fn is(self, record: &Record, vocabulary: &Vocabulary) -> bool {
        let is_minor = |word: &Word, code| match word {
            Word::Minor(id) => vocabulary.code(*id) == code,
            _ => false,
        };
        matches!(record.kind, kind::POST | kind::MODE)
            && vocabulary.code(record.major) == self.major
            && self.minor.is_none_or(|code| record.data.iter().any(|word| is_minor(word, code)))
    }
}

/// Between which words of the CL file a RAPID looks ahead.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    start: Option<Mark>,
    stop: Option<Mark>,
}

impl Stretch {
    /// The stretch of the settings; `None` where each RAPID looks up to the next one or tool.
    pub fn of(commons: &Commons) -> Option<Stretch> {
        if commons.read(loc::REPOS_OPTIMISE_SPAN) == ReposOptimiseSpan::NotUsed {
            return None;
        }
        let start = [loc::REPOS_OPTIMISE_START_MAJOR, loc::REPOS_OPTIMISE_START_MINOR];
        let stop = [loc::REPOS_OPTIMISE_STOP_MAJOR, loc::REPOS_OPTIMISE_STOP_MINOR];
        Some(Stretch { start: Mark::of(commons, start), stop: Mark::of(commons, stop) })
    }

    /// Whether the stretch is open behind a record.
    pub fn is_open(self, before: bool, record: &Record, vocabulary: &Vocabulary) -> bool {
        let is = |mark: Option<Mark>| mark.is_some_and(|mark| mark.is(record, vocabulary));
        is(self.start) || before && !is(self.stop)
    }

    /// Whether it is open from the beginning of the program.
    pub fn begins_open(self) -> bool {
        self.start.is_none()
    }
}

impl Source<'_> {
    /// The motions behind the current record up to the word that closes the stretch; without
    /// one up to the next RAPID or tool. Nothing is consumed, and what is wrong with a record is
    /// said when it is read.
    pub fn motions_ahead(
        &mut self,
        stretch: Option<Stretch>,
        vocabulary: &mut Vocabulary,
    ) -> Vec<Coming> {
        let stop = stretch.and_then(|stretch| stretch.stop);
        let mut coming = Vec::new();
        for index in 0..MOST {
            let Ok(Some(record)) = self.ahead(index, vocabulary) else { break };
            if stop.is_some_and(|stop| stop.is(record, vocabulary)) {
                break;
            }
            match record.kind {
                kind::MOTION => {
                    let point = record.point().filter(|_| record.sub != motion::GODLTA);
                    coming.push(Coming { point, axis: record.axis() });
                }
                kind::FINI => break,
                _ if moves_frame(record, vocabulary) => break,
                _ if stop.is_some() => {}
                _ if record.major == words::RAPID || record.takes_tool() => break,
                _ => {}
            }
        }
        coming
    }
}

/// True for words behind which points and tool axes may be of another frame.
fn moves_frame(record: &Record, vocabulary: &Vocabulary) -> bool {
    const WORDS: [&str; 9] =
        ["TRANS", "TRACUT", "ORIGIN", "ROTABL", "ROTATE", "CSYS", "MSYS", "CATMAT", "CATIA0"];
    WORDS.contains(&vocabulary.name(record.major))
}
