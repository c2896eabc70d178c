//! Typed settings: what a location of the commons says, as the type that fits it.
//!
//! The constants in [`locations`](crate::locations) are made of these types, so
//! a setting is read by its name and compared by its meaning, never by a number:
//! `commons.read(loc::CIRCLE_CENTER) == CircleCenter::Radius`.

use std::marker::PhantomData;

use crate::commons::{Commons, Dbl, Int, Rel};
use crate::letter::Letter;

/// A location with the type of what it says.
pub trait Setting: Copy {
    /// What it says.
    type Value;

    /// Reads it.
    fn read(self, commons: &Commons) -> Self::Value;
}

impl Setting for Int {
    type Value = Option<i32>;

    fn read(self, commons: &Commons) -> Option<i32> {
        commons.int_opt(self)
    }
}

impl Setting for Rel {
    type Value = Option<f64>;

    fn read(self, commons: &Commons) -> Option<f64> {
        commons.rel_opt(self)
    }
}

impl Setting for Dbl {
    type Value = Option<f64>;

    fn read(self, commons: &Commons) -> Option<f64> {
        commons.dbl_opt(self)
    }
}

/// Yes or no in INTCOM: 1 and 71 (the code of ON) are yes, 0 and 72 (OFF) are
/// no; any other value leaves the default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flag {
    /// INTCOM number.
    pub number: u16,
    /// What an absent value means.
    pub default: bool,
}

impl Setting for Flag {
    type Value = bool;

    #[inline]
    fn read(self, commons: &Commons) -> bool {
        match commons.int(Int(self.number)) {
            1 | 71 => true,
            0 | 72 => false,
            _ => self.default,
        }
    }
}

/// Number of a preparatory or auxiliary function in INTCOM; absent when the
/// machine has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeAt(pub u16);

impl Setting for CodeAt {
    type Value = Option<i32>;

    #[inline]
    fn read(self, commons: &Commons) -> Option<i32> {
        commons.int_opt(Int(self.0))
    }
}

/// A letter in INTCOM, as its number; absent for none, and for a number that is
/// no letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LetterAt(pub u16);

impl Setting for LetterAt {
    type Value = Option<Letter>;

    fn read(self, commons: &Commons) -> Option<Letter> {
        commons.int_opt(Int(self.0)).and_then(Letter::numbered)
    }
}

/// A character in INTCOM, as its ASCII code; absent for what does not print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CharacterAt(pub u16);

impl Setting for CharacterAt {
    type Value = Option<char>;

    fn read(self, commons: &Commons) -> Option<char> {
        let code = commons.int_opt(Int(self.0)).and_then(|code| u8::try_from(code).ok());
        code.filter(u8::is_ascii_graphic).map(char::from)
    }
}

/// An enum whose variants are the numbers of a choice.
pub trait FromNumber: Copy {
    /// The variant of a number.
    fn from_number(number: i32) -> Option<Self>;
}

/// One of several choices in INTCOM; a number that is not among them leaves the
/// default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice<T> {
    /// INTCOM number.
    pub number: u16,
    choices: PhantomData<T>,
}

impl<T> Choice<T> {
    /// The choice in an INTCOM location.
    pub const fn at(number: u16) -> Self {
        Choice { number, choices: PhantomData }
    }
}

impl<T: FromNumber + Default> Setting for Choice<T> {
    type Value = T;

    #[inline]
    fn read(self, commons: &Commons) -> T {
        T::from_number(commons.int(Int(self.number))).unwrap_or_default()
    }
}

/// One of several choices in DBLCOM; a number that is not among them leaves the default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RealChoice<T> {
    /// DBLCOM number.
    pub number: u16,
    choices: PhantomData<T>,
}

impl<T> RealChoice<T> {
    /// The choice in a DBLCOM location.
    pub const fn at(number: u16) -> Self {
        RealChoice { number, choices: PhantomData }
    }
}

impl<T: FromNumber + Default> Setting for RealChoice<T> {
    type Value = T;

    fn read(self, commons: &Commons) -> T {
        let number = commons.dbl_opt(Dbl(self.number)).filter(|number| number.fract() == 0.0);
        number.and_then(|number| T::from_number(number as i32)).unwrap_or_default()
    }
}

/// One of several choices, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OptionalChoice<T> {
    /// INTCOM number.
    pub number: u16,
    choices: PhantomData<T>,
}

impl<T> OptionalChoice<T> {
    /// The choice in an INTCOM location.
    pub const fn at(number: u16) -> Self {
        OptionalChoice { number, choices: PhantomData }
    }
}

impl<T: FromNumber> Setting for OptionalChoice<T> {
    type Value = Option<T>;

    fn read(self, commons: &Commons) -> Option<T> {
        T::from_number(commons.int(Int(self.number)))
    }
}

/// One of several choices in DBLCOM, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OptionalRealChoice<T> {
    /// DBLCOM number.
    pub number: u16,
    choices: PhantomData<T>,
}

impl<T> OptionalRealChoice<T> {
    /// The choice in a DBLCOM location.
    pub const fn at(number: u16) -> Self {
        OptionalRealChoice { number, choices: PhantomData }
    }
}

impl<T: FromNumber> Setting for OptionalRealChoice<T> {
    type Value = Option<T>;

    fn read(self, commons: &Commons) -> Option<T> {
        let number = commons.dbl_opt(Dbl(self.number)).filter(|number| number.fract() == 0.0)?;
        T::from_number(number as i32)
    }
}
