//! Names that a file can't have on Windows, and names that mean a device there.
//!
//! Windows opens some of them without an error: what is written to `NUL.txt` is gone, and
//! `part.` becomes `part`. So they are refused before anything is opened.

use std::fmt;

/// What Windows refuses in a name besides control characters. A colon names a stream of
/// a file there, which no folder shows.
const RESERVED: [char; 7] = ['<', '>', ':', '"', '|', '?', '*'];

/// Names of devices, whatever ending follows them.
const DEVICES: [&str; 6] = ["CON", "PRN", "AUX", "NUL", "CONIN$", "CONOUT$"];

/// Devices with a digit from 1 to 9 after the name. Superscript digits count too.
const PORTS: [&str; 2] = ["COM", "LPT"];
const DIGITS: &str = "123456789¹²³";

/// Why a file can't have a name on Windows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NameFault {
    /// The name of a device, with or without an ending.
    Device(String),
    /// A character that no name has.
    Character(char),
    /// Windows leaves a blank or a point at the end of a name out.
    End(char),
}

impl fmt::Display for NameFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NameFault::Device(name) => write!(f, "{name} is a device of Windows"),
            NameFault::Character(found) => {
                write!(f, "no file of Windows has {found:?} in its name")
            }
            NameFault::End(' ') => f.write_str("Windows leaves out a blank at the end"),
            NameFault::End(_) => f.write_str("Windows leaves out a point at the end"),
        }
    }
}

/// Why a name without folders can't be that of a file on Windows; `None` when it can.
/// `.` and `..` are no names of files and have no fault here.
pub fn fault(name: &str) -> Option<NameFault> {
    if name == "." || name == ".." {
        return None;
    }
    let reserved = |found: &char| RESERVED.contains(found) || *found < ' ';
    if let Some(found) = name.chars().find(reserved) {
        return Some(NameFault::Character(found));
    }
    // `NUL .txt` is the device too.
    let stem = name.split('.').next().unwrap_or(name).trim_end_matches(' ');
    if is_device(stem) {
        return Some(NameFault::Device(stem.to_ascii_uppercase()));
    }
    name.chars().last().filter(|last| matches!(last, ' ' | '.')).map(NameFault::End)
}

/// True for a name that Windows takes for a device, without an ending: `NUL`, `com1`.
pub fn is_device(name: &str) -> bool {
    let name = name.to_ascii_uppercase();
    let port = |port: &&str| {
        let mut rest = name.strip_prefix(*port).unwrap_or_default().chars();
        rest.next().is_some_and(|digit| DIGITS.contains(digit)) && rest.next().is_none()
    };
    DEVICES.contains(&name.as_str()) || PORTS.iter().any(port)
}

/// Two names are one file on disks that don't tell capital letters from small ones.
#[cfg(any(feature = "files", test))]
pub(crate) fn alike(one: &str, other: &str) -> bool {
    one == other || one.to_lowercase() == other.to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinary_names_have_no_fault() {
        let names = [
            "part.nc",
            "O1001",
            "part 1.nc",
            ".hidden",
            "a.b.c",
            "TÜR.TXT",
            "a'b&c(1)[2]{3}#$%.nc",
            "CONTOUR.NC",
            "AUXFUN.TXT",
            "NULL",
            "COM",
            "COM0",
            "COM10",
            "LPT.TXT",
            "COMA.NC",
            "part.con",
            "..nc",
            "CONIN",
            "..",
            ".",
        ];
        for name in names {
            assert_eq!(fault(name), None, "{name}");
        }
    }

    #[test]
    fn devices_are_refused_with_any_ending_and_in_any_letters() {
        let names = [
            ("NUL", "NUL"),
            ("nul.txt", "NUL"),
            ("Con.tar.gz", "CON"),
            ("AUX .nc", "AUX"),
            ("prn.", "PRN"),
            ("COM1.NC", "COM1"),
            ("com9", "COM9"),
            ("LPT3.lst", "LPT3"),
            ("COM¹.nc", "COM¹"),
            ("conout$", "CONOUT$"),
            ("CONIN$.x", "CONIN$"),
        ];
        for (name, device) in names {
            assert_eq!(fault(name), Some(NameFault::Device(device.into())), "{name}");
        }
    }

    #[test]
    fn characters_that_windows_reserves_are_refused() {
        for found in ['<', '>', ':', '"', '|', '?', '*', '\t', '\u{1}', '\u{1f}'] {
            let name = format!("part{found}1.nc");
            assert_eq!(fault(&name), Some(NameFault::Character(found)), "{name:?}");
        }
    }

    #[test]
    fn ends_that_windows_leaves_out_are_refused() {
        for (name, end) in [("part.", '.'), ("part.nc ", ' '), ("part...", '.'), ("part. ", ' ')] {
            assert_eq!(fault(name), Some(NameFault::End(end)), "{name:?}");
        }
    }

    #[test]
    fn only_a_bare_name_is_a_device_to_write_to() {
        assert!(is_device("nul") && is_device("COM3") && is_device("LPT²"));
        assert!(!is_device("nul.txt") && !is_device("COM") && !is_device("COM12"));
    }

    #[test]
    fn names_that_differ_by_case_are_alike() {
        assert!(alike("Tools.TXT", "tools.txt") && alike("TÜR", "tür"));
        assert!(!alike("tools.txt", "tools.tx"));
    }
}
