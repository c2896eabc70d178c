//! A date with a time of day, as DATEF and TIMEF give it.

use std::fmt;

/// Seconds of a day.
const DAY: i64 = 86_400;

/// A date of the Gregorian calendar with a time of day; it has no time zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    year: u16,
    month: u8,
    day: u8,
    hour: u8,
    minute: u8,
    second: u8,
}

impl Moment {
    /// Reads `2026-01-31T12:00:00`; `None` for any other form or no such date.
    pub fn parse(text: &str) -> Option<Moment> {
        let (date, time) = text.split_once('T')?;
        let [year, month, day] = numbers(date, '-', [4, 2, 2])?;
        let [hour, minute, second] = numbers(time, ':', [2, 2, 2])?;
        let exists = year >= 1
            && (1..=12).contains(&month)
            && (1..=days_in(year, month)).contains(&day)
            && hour < 24
            && minute < 60
            && second < 60;
        exists.then_some(Moment {
            year,
            month: month as u8,
            day: day as u8,
            hour: hour as u8,
            minute: minute as u8,
            second: second as u8,
        })
    }

    /// From seconds since 1970-01-01T00:00:00; `None` beyond the year 9999.
    pub fn from_unix(seconds: u64) -> Option<Moment> {
        let seconds = i64::try_from(seconds).ok()?;
        let (mut days, rest) = (seconds / DAY, seconds % DAY);
        let mut year: u16 = 1970;
        while days >= days_in_year(year) {
            days -= days_in_year(year);
            year += 1;
            if year > 9999 {
                return None;
            }
        }
        let mut month = 1;
        while days >= i64::from(days_in(year, month)) {
            days -= i64::from(days_in(year, month));
            month += 1;
        }
        Some(Moment {
            year,
            month: month as u8,
            day: days as u8 + 1,
            hour: (rest / 3600) as u8,
            minute: (rest / 60 % 60) as u8,
            second: (rest % 60) as u8,
        })
    }

    /// Year, month and day, month and day from 1.
    pub fn date(self) -> [f64; 3] {
        [f64::from(self.year), f64::from(self.month), f64::from(self.day)]
    }

    /// Hours, minutes and seconds of the day.
    pub fn time(self) -> [f64; 3] {
        [f64::from(self.hour), f64::from(self.minute), f64::from(self.second)]
    }
}

impl fmt::Display for Moment {
    /// `2026-01-31T12:00:00`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Moment { year, month, day, hour, minute, second } = self;
        write!(f, "{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}")
    }
}

fn numbers(text: &str, separator: char, widths: [usize; 3]) -> Option<[u16; 3]> {
    let mut found = [0; 3];
    let mut parts = text.split(separator);
    for (number, width) in found.iter_mut().zip(widths) {
        let part = parts.next()?;
        let right = part.len() == width && part.bytes().all(|byte| byte.is_ascii_digit());
        *number = part.parse().ok().filter(|_| right)?;
    }
    parts.next().is_none().then_some(found)
}

fn is_leap(year: u16) -> bool {
    year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
}

fn days_in_year(year: u16) -> i64 {
    if is_leap(year) { 366 } else { 365 }
}

fn days_in(year: u16, month: u16) -> u16 {
    match month {
        2 => 28 + u16::from(is_leap(year)),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

#[cfg(test)]
mod tests {
    use super::Moment;

    #[test]
    fn only_dates_that_exist_are_read() {
        for text in ["2026-01-31T12:00:00", "2024-02-29T23:59:59", "2000-02-29T00:00:00"] {
            assert_eq!(Moment::parse(text).unwrap().to_string(), text);
        }
        for text in [
            "2026-02-29T12:00:00",
            "1900-02-29T12:00:00",
            "2026-13-01T12:00:00",
            "2026-01-31",
            "2026-01-31T24:00:00",
            "2026-1-31T12:00:00",
            "2026-01-31T12:00",
            "2026-01-31T12:00:00Z",
            "+026-01-31T12:00:00",
        ] {
            assert_eq!(Moment::parse(text), None, "{text}");
        }
    }

    #[test]
    fn seconds_are_counted_from_1970() {
        for (seconds, text) in [
            (0, "1970-01-01T00:00:00"),
            (951_782_400, "2000-02-29T00:00:00"),
            (1_767_225_599, "2025-12-31T23:59:59"),
            (4_102_444_800, "2100-01-01T00:00:00"),
        ] {
            assert_eq!(Moment::from_unix(seconds).unwrap().to_string(), text);
        }
        assert_eq!(Moment::from_unix(u64::MAX), None);
    }
}
