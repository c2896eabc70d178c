//! The family of a control: of a machine by its settings, of a program by its text.

use std::io;

use crate::source::{Lines, Source};

/// The family of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// Words of a letter and a number (ISO 6983).
    WordAddress,
    /// Heidenhain Klartext.
    Klartext,
    /// SINUMERIK 840D.
    Sinumerik,
}

/// What no program of words has, and each of a SINUMERIK that needs another reading.
const SIGNS: [&str; 8] = ["%_N_", ";$PATH=", "MCALL", "CYCLE8", "MSG(", "CR=", "T=\"", "=AC("];

impl Family {
    /// The family of the control that a program is for, by the signs in its text: Klartext
    /// begins with `BEGIN PGM`. A program without signs is one of words.
    ///
    /// # Errors
    /// What the system says when a file can't be read.
    pub fn of(source: &Source<'_>) -> io::Result<Family> {
        let mut lines = Lines::from(source, 0);
        let mut first = true;
        while let Some(line) = lines.next_line()? {
            // Most lines have nothing that a sign has.
            if !first && !line.iter().any(|byte| b"%;=(Ll".contains(byte)) {
                continue;
            }
            let line = String::from_utf8_lossy(line).to_ascii_uppercase();
            let bare = bare(&line);
            if first && bare.starts_with("BEGIN PGM") {
                return Ok(Family::Klartext);
            }
            first &= bare.is_empty();
            if has_sign(&line) {
                return Ok(Family::Sinumerik);
            }
        }
        Ok(Family::WordAddress)
    }

    /// What people call it.
    pub fn title(self) -> &'static str {
        match self {
            Family::WordAddress => "word address",
            Family::Klartext => "Klartext",
            Family::Sinumerik => "SINUMERIK",
        }
    }
}

/// Words that most CL files have near their beginning, each before a slash.
const OF_CL: [&str; 6] = ["UNITS", "LOADTL", "SPINDL", "FEDRAT", "MACHIN", "GOTO"];

/// Lines of a text by which a CL file is told.
const TOLD_BY: usize = 50;

/// The text is that of a CL file.
///
/// # Errors
/// What the system says when a file can't be read.
pub(crate) fn is_cl_file(source: &Source<'_>) -> io::Result<bool> {
    let mut lines = Lines::from(source, 0);
    for _ in 0..TOLD_BY {
        let Some(line) = lines.next_line()? else { break };
        let line = String::from_utf8_lossy(line).to_ascii_uppercase();
        let word = line.split_once('/').map_or("", |(word, _)| word.trim());
        if line.starts_with("$$") || OF_CL.contains(&word) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// A line in upper case has what no program of words has.
fn has_sign(line: &str) -> bool {
    let code = line.split(';').next().unwrap_or("").split('(').next().map_or(0, str::len);
    SIGNS.iter().any(|sign| match line.find(sign) {
        // Within a comment of a program of words it says nothing.
        Some(at) => sign.contains(['%', ';', '(']) || at < code,
        None => false,
    })
}

/// A line without a byte order mark and the number of Klartext.
fn bare(line: &str) -> &str {
    let line = line.trim_start_matches('\u{feff}').trim();
    line.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_tells_its_family() {
        for (text, family) in [
            ("\u{feff}\r\n0  begin pgm 7 mm\r\n1 L X+5 FMAX\r\n", Family::Klartext),
            ("BEGIN PGM A INCH\n", Family::Klartext),
            ("%\nO1 (BEGIN PGM)\nG0 X1\nM30\n", Family::WordAddress),
            ("G0 X1\n(T=\"A\" AND CR=5)\n", Family::WordAddress),
            ("", Family::WordAddress),
            ("N1 G0 X1\nN2 T=\"MILL\"\n", Family::Sinumerik),
            ("%_N_PART_MPF\nG0 X1\n", Family::Sinumerik),
            ("%\nO100 (CYCLE81)\nG1 X1. (CR=5)\n", Family::WordAddress),
            ("N10 G1 X1\nN20 MCALL CYCLE81(5,0,1,-3)\n", Family::Sinumerik),
            ("N10 G3 X1 CR=5\n", Family::Sinumerik),
        ] {
            let told = Family::of(&Source::memory(text.as_bytes())).unwrap();
            assert_eq!(told, family, "{text}");
        }
    }
}
