//! Numbers of preparatory (G) and auxiliary (M) functions: whole numbers, or with
//! one decimal as in G54.1.

use fil_diag::Result;

use crate::digits::{push_number, push_padded};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::number::NumberFormat;

/// Largest whole part of a code.
const MOST: f64 = 9999.0;

/// The number of a preparatory or auxiliary function, exact to a tenth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FunctionCode {
    tenths: u32,
}

impl FunctionCode {
    /// A whole number.
    pub const fn whole(number: u16) -> Self {
        FunctionCode { tenths: number as u32 * 10 }
    }

    /// A number of tenths: 541 is 54.1.
    pub const fn tenths(tenths: u32) -> Self {
        FunctionCode { tenths }
    }

    /// Its number in tenths.
    #[inline]
    pub const fn in_tenths(self) -> u32 {
        self.tenths
    }

    /// True for a number without a tenth.
    pub const fn is_whole(self) -> bool {
        self.tenths.is_multiple_of(10)
    }

    /// The code a setting holds; `None` for a negative number.
    #[inline]
    pub fn of_setting(number: i32) -> Option<Self> {
        u16::try_from(number).ok().map(FunctionCode::whole)
    }

    /// The code of a number; `None` for one that is negative or not exact to a tenth.
    pub fn of_value(value: f64) -> Option<Self> {
        let tenths = value * 10.0;
        let exact = (tenths - tenths.round()).abs() < 1e-6;
        (exact && (0.0..=MOST).contains(&value))
            .then(|| FunctionCode { tenths: tenths.round() as u32 })
    }

    /// The number.
    #[inline]
    pub fn value(self) -> f64 {
        f64::from(self.tenths) / 10.0
    }

    /// Refuses a code that the address can't write as it is.
    ///
    /// # Errors
    /// More digits than the format has before the point, or a tenth where the
    /// format has no digit after it.
    #[inline]
    pub fn check(self, letter: Letter, format: &NumberFormat) -> Result<()> {
        let fits = format.holds_whole(self.tenths / 10);
        if fits && (format.decimals > 0 || self.tenths.is_multiple_of(10)) {
            return Ok(());
        }
        self.refused(letter, format)
    }

    #[cold]
    fn refused(self, letter: Letter, format: &NumberFormat) -> Result<()> {
        let (value, NumberFormat { whole, decimals, .. }) = (self.value(), format);
        if !self.tenths.is_multiple_of(10) && *decimals == 0 {
            return MachineCode::Inexact
                .err(format!("{letter}{value}: the address writes whole numbers only"));
        }
        MachineCode::Overflow.err(format!("{letter}{value} does not fit {whole}.{decimals} digits"))
    }

    /// Appends the code: whole numbers without a point, as many digits as the format has
    /// where it asks for leading zeros.
    #[inline]
    pub fn write(self, format: &NumberFormat, out: &mut Vec<u8>) {
        let whole = u64::from(self.tenths / 10);
        if format.leading {
            push_padded(out, whole, usize::from(format.whole));
        } else {
            push_number(out, whole);
        }
        let tenth = self.tenths % 10;
        if tenth != 0 {
            out.extend_from_slice(&[b'.', b'0' + tenth as u8]);
        }
    }
}

impl std::fmt::Display for FunctionCode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.value())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::locations::TapeDecimalRule;

    fn text(format: i32, spec: i32, value: f64) -> Result<String> {
        let format = NumberFormat::from_commons(format, spec, true, TapeDecimalRule::default());
        let code =
            FunctionCode::of_value(value).ok_or_else(|| MachineCode::Inexact.diag("not a code"))?;
        code.check(Letter::of(b'G'), &format)?;
        let mut out = Vec::new();
        code.write(&format, &mut out);
        Ok(String::from_utf8(out).unwrap())
    }

    #[test]
    fn a_code_is_written_as_it_is_or_refused() {
        assert_eq!(text(2020, 100, 1.0).unwrap(), "01");
        assert_eq!(text(2020, 0, 54.0).unwrap(), "54");
        assert_eq!(text(3131, 0, 54.1).unwrap(), "54.1");
        // A digit after the point does not turn G54 into G540.
        assert_eq!(text(3131, 0, 54.0).unwrap(), "54");
        assert_eq!(text(2020, 0, 54.1).unwrap_err().code.name(), "E0512");
        assert_eq!(text(2020, 0, 154.0).unwrap_err().code.name(), "E0501");
        for wrong in [-4.0, 6.25, f64::NAN, 1e9] {
            assert_eq!(FunctionCode::of_value(wrong), None, "{wrong}");
        }
    }
}
