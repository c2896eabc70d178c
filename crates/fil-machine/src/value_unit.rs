//! What the value of a setting counts, and where we know a setting from.

use std::fmt;

/// What the value of a setting counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueUnit {
    /// Something without a unit.
    Plain,
    /// The code of a character.
    Char,
    /// One of some numbers, each with a meaning.
    Choice,
    /// The number of a preparatory (G) or auxiliary (M) function.
    Code,
    /// A number of things.
    Count,
    /// Degrees.
    Degrees,
    /// Yes or no.
    Flag,
    /// Digits before and after the point.
    Format,
    /// The number of a letter, A is 1.
    Letter,
    /// mm.
    Mm,
    /// mm/min.
    MmPerMinute,
    /// Percent.
    Percent,
    /// A factor.
    Ratio,
    /// Revolutions a minute.
    Rpm,
    /// Seconds.
    Seconds,
}

impl fmt::Display for ValueUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ValueUnit::Plain => "-",
            ValueUnit::Char => "char",
            ValueUnit::Choice => "choice",
            ValueUnit::Code => "code",
            ValueUnit::Count => "count",
            ValueUnit::Degrees => "deg",
            ValueUnit::Flag => "flag",
            ValueUnit::Format => "format",
            ValueUnit::Letter => "letter",
            ValueUnit::Mm => "mm",
            ValueUnit::MmPerMinute => "mm/min",
            ValueUnit::Percent => "percent",
            ValueUnit::Ratio => "ratio",
            ValueUnit::Rpm => "rpm",
            ValueUnit::Seconds => "s",
        })
    }
}

/// Where we know a setting from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// Its meaning is printed in a report of a real option file.
    Report,
    /// Read from the pattern of such files.
    Inferred,
    /// Our own location, or our own numbers for its choices.
    Own,
}

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Evidence::Report => "report",
            Evidence::Inferred => "inferred",
            Evidence::Own => "own",
        })
    }
}
