//! Letters of addresses, A = 1 to Z = 26 as the commons number them.

/// A letter, A to Z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Letter(u8);

impl Letter {
    /// Number of letters.
    pub const COUNT: usize = 26;

    /// The letter of a capital character. For constants: anything but `A` to `Z`
    /// does not compile there.
    pub const fn of(character: u8) -> Self {
        assert!(character.is_ascii_uppercase());
        Letter(character - b'A' + 1)
    }

    /// The letter of a character, in either case.
    pub fn of_character(character: char) -> Option<Self> {
        let upper = character.to_ascii_uppercase();
        upper.is_ascii_uppercase().then(|| Letter::of(upper as u8))
    }

    /// The letter of a number, 1 to 26.
    pub fn numbered(number: i32) -> Option<Self> {
        (1..=26).contains(&number).then_some(Letter(number as u8))
    }

    /// The letter of a whole number from 1 to 26, as FIL gives it.
    pub fn of_value(value: f64) -> Option<Self> {
        (value.fract() == 0.0 && (1.0..=26.0).contains(&value)).then_some(Letter(value as u8))
    }

    /// All letters.
    pub fn all() -> impl Iterator<Item = Letter> {
        (1..=26).map(Letter)
    }

    /// Its number, 1 to 26.
    #[inline]
    pub const fn number(self) -> u8 {
        self.0
    }

    /// Its number as an index.
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// The capital character.
    #[inline]
    pub const fn byte(self) -> u8 {
        self.0 + b'A' - 1
    }

    /// The capital character.
    pub const fn character(self) -> char {
        self.byte() as char
    }
}

impl std::fmt::Display for Letter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.character())
    }
}

/// Letters the post writes by name.
pub mod letters {
    use super::Letter;

    /// Cutter radius or diameter offset.
    pub const D: Letter = Letter::of(b'D');
    /// Feed.
    pub const F: Letter = Letter::of(b'F');
    /// Preparatory function.
    pub const G: Letter = Letter::of(b'G');
    /// Tool length offset.
    pub const H: Letter = Letter::of(b'H');
    /// Arc center in X, Y and Z.
    pub const IJK: [Letter; 3] = [Letter::of(b'I'), Letter::of(b'J'), Letter::of(b'K')];
    /// Auxiliary function.
    pub const M: Letter = Letter::of(b'M');
    /// Sequence number.
    pub const N: Letter = Letter::of(b'N');
    /// A number beside a function: a dwell, a work offset, a spindle.
    pub const P: Letter = Letter::of(b'P');
    /// Radius, and the R level of a canned cycle.
    pub const R: Letter = Letter::of(b'R');
    /// Spindle speed.
    pub const S: Letter = Letter::of(b'S');
    /// Tool.
    pub const T: Letter = Letter::of(b'T');
    /// Increments along X, Y and Z of a lathe.
    pub const UVW: [Letter; 3] = [Letter::of(b'U'), Letter::of(b'V'), Letter::of(b'W')];
    /// The linear axes.
    pub const XYZ: [Letter; 3] = [Letter::of(b'X'), Letter::of(b'Y'), Letter::of(b'Z')];
}
