//! A look at the beginning of a text, so that its first statements are read by the rules of a
//! dialect whose sign comes after them.

use fil_diag::{Diag, Result, TextSpan};

use super::{Options, Reader, number::number};
use crate::dialect::{Evidence, Recognition};
use crate::errors::ClCode;
use crate::record::Record;
use crate::vocabulary::Vocabulary;

/// Bytes that are looked at. A sign that comes later is found, too, as long as nothing was
/// read that its dialect reads otherwise.
const AHEAD: usize = 64 * 1024;

/// True for the beginning of an NCI file of Mastercam: a code in one line, its values in the next.
fn is_nci(text: &[u8]) -> bool {
    let is_value = |item: &[u8]| number(item).is_some();
    let mut lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let (Some(code), Some(values)) = (lines.next(), lines.next()) else { return false };
    let is_code = !code.is_empty() && code.iter().all(u8::is_ascii_digit);
    let mut items = values.split(u8::is_ascii_whitespace).filter(|item| !item.is_empty());
    is_code && items.next().is_some_and(is_value)
}

/// True for the beginning of an NC program: a tape mark, a program number, or Klartext's frame.
fn is_nc_program(text: &[u8]) -> bool {
    let mut lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let Some(first) = lines.find(|line| !line.is_empty()) else { return false };
    let is_number = |rest: &[u8]| {
        let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        digits > 0 && rest.get(digits).is_none_or(|byte| matches!(byte, b' ' | b'('))
    };
    first == b"%"
        || first.strip_prefix(b"O").is_some_and(is_number)
        || first.starts_with(b"0 BEGIN PGM ")
}

/// What a text is that holds no statements of a CL file, and what to do.
fn other_file(text: &[u8]) -> Option<(&'static str, &'static str)> {
    match () {
        () if text.is_empty() => Some(("an empty file", "Export the CL file again.")),
        () if is_nc_program(text) => Some((
            "an NC program, and no CL file",
            "Give the CL file first: filpost post PART.ncl; filpost verify PART.ncl PROGRAM.nc",
        )),
        () if is_nci(text) => Some((
            "an NCI file of Mastercam: codes and values in turn, and no statements",
            "Write APT with a post of Mastercam for it (NCI2APT), and post that file.",
        )),
        () => None,
    }
}

/// What the signs in a text show, from the statement of its first line on.
fn scouted(text: &[u8], file: &str, line: u32, options: Options) -> Recognition {
    let mut scout = Reader::new(text, file, options);
    scout.is_scout = true;
    scout.lines.count_from(line);
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    while scout.recognized().evidence == Evidence::NoSign {
        match scout.read(&mut vocabulary, &mut record) {
            Ok(true) => {}
            Ok(false) => break,
            // Another dialect may read what this one refuses.
            Err(_) if scout.resume() => {}
            Err(_) => break,
        }
    }
    scout.recognition.begun_again()
}

impl Reader<'_> {
    /// Refuses a file of another kind.
    ///
    /// # Errors
    /// It is one.
    pub(super) fn refuse_other_files(&mut self) -> Result<()> {
        // An input that fails is told of when its first record is read.
        if self.is_scout || self.lines.fill_to(AHEAD).is_err() {
            return Ok(());
        }
        let Some((message, hint)) = other_file(self.ahead()) else { return Ok(()) };
        let place = TextSpan::line(&self.file, self.lines.line(), "");
        Err(Box::new(Diag::new(ClCode::BinaryData, message).at(place).hint(hint)))
    }

    /// Takes the dialect whose sign stands in the first bytes. What is wrong with their
    /// statements, and an input that fails, is said when they are read.
    pub(super) fn recognize_ahead(&mut self) {
        if self.options.dialect.is_some() || self.is_scout {
            return;
        }
        let (line, file) = (self.lines.line(), self.file.clone());
        let options = Options { raw: true, ..self.options };
        self.recognition = scouted(self.ahead(), &file, line, options);
    }

    /// The whole lines of the first bytes; nothing of an input that fails.
    pub(super) fn ahead(&mut self) -> &[u8] {
        if self.lines.fill_to(AHEAD).is_err() && self.lines.unread().is_empty() {
            return &[];
        }
        let unread = self.lines.unread();
        let most = &unread[..unread.len().min(AHEAD)];
        let end = memchr::memrchr(b'\n', most).map_or(most.len(), |end| end + 1);
        &most[..end]
    }
}
