//! The commons: the one settings store of the post (INTCOM, RELCOM, DBLCOM).
//!
//! Option files load into them, `machine.toml` names them, POSTF(1/2/3) reads
//! and writes them, and the post reads its behaviour from them at the moment it
//! acts. Locations are 1-based, as in option files.

use std::sync::Arc;

use fil_diag::{Levels, Result};

use crate::effects::{Effect, Effects};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::INPUT_TRANSLATE;
use crate::post_options::PostOptions;
use crate::reads::Reads;
use crate::setting::Setting;
use crate::simulate_settings::{SimulateSetting, SimulateSettings};
use crate::stored;

/// An absent integer (shown as NA in reports).
pub const NA: i32 = -32767;

/// An absent real; FIL's EMPTY value.
pub const EMPTY: f64 = 999_999.0;

/// Number of the INTCOM that holds the last location, own locations included.
pub const INT_LOCATIONS: usize = 12_199;
/// Size of RELCOM.
pub const REL_LOCATIONS: usize = 999;
/// Size of DBLCOM.
pub const DBL_LOCATIONS: usize = 9_999;

/// DBLCOM 355 + letter number is the last output value of that letter.
pub const LAST_OUTPUT: usize = 355;
/// Letters of the alphabet.
const LETTERS: usize = 26;

/// Which of the three commons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// INTCOM: integers.
    Int,
    /// RELCOM: reals.
    Rel,
    /// DBLCOM: doubles.
    Dbl,
}

impl Kind {
    /// The name used in option files and messages.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Int => "INTCOM",
            Kind::Rel => "RELCOM",
            Kind::Dbl => "DBLCOM",
        }
    }

    /// Number of locations.
    pub fn size(self) -> usize {
        match self {
            Kind::Int => INT_LOCATIONS,
            Kind::Rel => REL_LOCATIONS,
            Kind::Dbl => DBL_LOCATIONS,
        }
    }
}

/// A location of INTCOM, made from the table of locations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Int(pub u16);

/// A location of RELCOM.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rel(pub u16);

/// A location of DBLCOM.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dbl(pub u16);

/// What a change of a setting adds to the generation; a shift of the points adds one.
const OF_SETTINGS: u64 = 1 << 32;

/// The three commons and a generation number that grows with each change of
/// a setting, so that tables derived from them know when they are stale.
#[derive(Clone, Debug)]
pub struct Commons {
    // Each run starts with a copy, and few of them change a setting.
    int: Arc<[i32]>,
    rel: Arc<[f64]>,
    dbl: Arc<[f64]>,
    /// Last output values by the number of the letter; DBLCOM 356 to 381.
    last_output: [f64; LETTERS + 1],
    generation: u64,
    /// Major words whose records the machine passes over.
    without_effect: Vec<String>,
    /// The lists of blocks that do not lie in INTCOM, by their number; those behind the last are
    /// empty.
    own_blocks: Vec<Vec<String>>,
    /// Work offsets that a program may choose where no CL file asks for one.
    allowed_offsets: Vec<String>,
    /// Settings with other values that no proven program tells apart from its own.
    undecided: Vec<String>,
    /// Proven programs that a learned machine writes differently.
    unequal: Vec<String>,
    /// Levels of findings that the machine sets.
    levels: Levels,
    /// Options of the post, with their values.
    options: PostOptions,
    /// What calls and codes of the shop do.
    effects: Effects,
    /// What `filpost simulate` cuts.
    simulate: SimulateSettings,
    /// Letters that were given a tape position and no digits: bit n is letter n of the alphabet.
    wants_digits: u32,
    /// Where reads are noted, while somebody asks for them.
    reads: Option<Reads>,
}

impl Commons {
    /// Commons with everything absent.
    pub fn absent() -> Self {
        Commons {
            int: vec![NA; INT_LOCATIONS + 1].into(),
            rel: vec![EMPTY; REL_LOCATIONS + 1].into(),
            dbl: vec![EMPTY; DBL_LOCATIONS + 1].into(),
            last_output: [EMPTY; LETTERS + 1],
            generation: 0,
            without_effect: Vec::new(),
            own_blocks: Vec::new(),
            allowed_offsets: Vec::new(),
            undecided: Vec::new(),
            unequal: Vec::new(),
            levels: Levels::default(),
            options: PostOptions::default(),
            effects: Effects::default(),
            simulate: SimulateSettings::default(),
            wants_digits: 0,
            reads: None,
        }
    }

    /// An integer setting; [`NA`] when absent.
    #[inline]
    pub fn int(&self, location: Int) -> i32 {
        self.note(Kind::Int, location.0 as usize);
        self.int[location.0 as usize]
    }

    /// An integer setting, `None` when absent.
    pub fn int_opt(&self, location: Int) -> Option<i32> {
        let value = self.int(location);
        (value != NA).then_some(value)
    }

    /// What a setting says, in the type that fits it.
    #[inline]
    pub fn read<S: Setting>(&self, setting: S) -> S::Value {
        setting.read(self)
    }

    /// Notes reads from now on, in copies too; gives the notes.
    pub fn note_reads(&mut self) -> Reads {
        self.reads.get_or_insert_default().clone()
    }

    /// Notes a read where somebody asks for it.
    #[inline]
    fn note(&self, kind: Kind, at: usize) {
        if let Some(reads) = &self.reads {
            reads.note(kind, at);
        }
    }

    /// A real setting; [`EMPTY`] when absent. The last output values are not among them.
    #[inline]
    pub fn dbl(&self, location: Dbl) -> f64 {
        self.note(Kind::Dbl, location.0 as usize);
        self.dbl[location.0 as usize]
    }

    /// A real setting, `None` when absent.
    pub fn dbl_opt(&self, location: Dbl) -> Option<f64> {
        let value = self.dbl(location);
        (value != EMPTY).then_some(value)
    }

    /// A RELCOM setting, `None` when absent.
    pub fn rel_opt(&self, location: Rel) -> Option<f64> {
        self.note(Kind::Rel, location.0 as usize);
        let value = self.rel[location.0 as usize];
        (value != EMPTY).then_some(value)
    }

    /// Major words that this machine lists as without effect, in capitals.
    pub fn words_without_effect(&self) -> &[String] {
        &self.without_effect
    }

    /// Lists a major word as without effect, in any case of letters.
    pub fn list_without_effect(&mut self, word: &str) {
        let word = word.trim().to_ascii_uppercase();
        if !self.without_effect.contains(&word) {
            self.without_effect.push(word);
        }
    }

    /// A list of blocks that does not lie in INTCOM.
    pub(crate) fn own_blocks(&self, number: usize) -> &[String] {
        self.own_blocks.get(number).map_or(&[], Vec::as_slice)
    }

    /// Stores such a list.
    pub(crate) fn set_own_blocks(&mut self, number: usize, blocks: Vec<String>) {
        if self.own_blocks.len() <= number {
            self.own_blocks.resize(number + 1, Vec::new());
        }
        self.own_blocks[number] = blocks;
        self.generation = self.generation.wrapping_add(OF_SETTINGS);
    }

    /// Levels of findings that the machine sets: `[levels]`.
    pub fn levels(&self) -> &Levels {
        &self.levels
    }

    /// The same, to be changed.
    pub fn levels_mut(&mut self) -> &mut Levels {
        &mut self.levels
    }

    /// Options of the post, with their values.
    pub fn options(&self) -> &PostOptions {
        &self.options
    }

    /// The same, to be changed.
    pub fn options_mut(&mut self) -> &mut PostOptions {
        &mut self.options
    }

    /// What calls and codes of the shop do: `[effects]`.
    pub fn effects(&self) -> &Effects {
        &self.effects
    }

    /// What `filpost simulate` cuts: `[simulate]`.
    pub fn simulate(&self) -> &SimulateSettings {
        &self.simulate
    }

    /// Sets a key of `[simulate]`.
    pub(crate) fn set_simulate(&mut self, setting: SimulateSetting) {
        self.simulate.set(setting);
    }

    /// Adds a rule of `[effects]`; false for a text that names no block.
    pub fn add_effect(&mut self, said: &str, effect: Effect) -> bool {
        self.generation = self.generation.wrapping_add(OF_SETTINGS);
        self.effects.add(said, effect)
    }

    /// Work offsets by their names in a program (`G54`, `G54.1P3`), in capitals, that a
    /// program may choose where its CL file asks for none.
    pub fn allowed_offsets(&self) -> &[String] {
        &self.allowed_offsets
    }

    /// Settings as `KEY=VALUE`: with these values the programs that the machine was learned from
    /// come out the same (`learned.undecided`).
    pub fn undecided(&self) -> &[String] {
        &self.undecided
    }

    /// Proven programs that the machine was learned from and writes differently, each with how
    /// much of it comes out (`learned.unequal`).
    pub fn unequal(&self) -> &[String] {
        &self.unequal
    }

    /// Sets which proven programs come out differently.
    pub fn set_unequal(&mut self, programs: Vec<String>) {
        self.unequal = programs;
    }

    /// Nothing of a learned machine is open: each proven program comes out, and decides.
    pub fn is_proven(&self) -> bool {
        self.undecided.is_empty() && self.unequal.is_empty()
    }

    /// Sets what no proven program decides.
    pub fn set_undecided(&mut self, settings: Vec<String>) {
        self.undecided = settings;
    }

    /// Allows a work offset, in any case of letters; false for what is no name of one.
    pub fn allow_offset(&mut self, name: &str) -> bool {
        let name = name.trim().to_ascii_uppercase();
        let is_name = is_offset(&name);
        if is_name && !self.allowed_offsets.contains(&name) {
            self.allowed_offsets.push(name);
        }
        is_name
    }

    /// A capital letter was given a tape position and no digits of its own.
    pub fn want_digits(&mut self, letter: u8) {
        self.wants_digits |= 1 << (letter - b'A');
    }

    /// True for a capital letter that was once given a tape position and no digits.
    pub fn wants_digits(&self, letter: u8) -> bool {
        self.wants_digits & (1 << (letter - b'A')) != 0
    }

    /// Generation of the settings; the last output values do not count.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// True if nothing but the shift of the points (TRANS) has changed since a generation.
    pub fn is_only_shifted_since(&self, generation: u64) -> bool {
        self.generation / OF_SETTINGS == generation / OF_SETTINGS
    }

    /// Last output value of a letter; [`EMPTY`] when unknown.
    #[inline]
    pub fn last_output(&self, letter: Letter) -> f64 {
        self.last_output[letter.index()]
    }

    /// Remembers the last output value of a letter.
    #[inline]
    pub fn set_last_output(&mut self, letter: Letter, value: f64) {
        self.last_output[letter.index()] = value;
    }

    /// Value of any location as FIL sees it: absent is [`EMPTY`].
    ///
    /// # Errors
    /// A location out of range.
    pub fn get(&self, kind: Kind, location: u32) -> Result<f64> {
        let at = check(kind, location)?;
        self.note(kind, at);
        Ok(match kind {
            Kind::Int if self.int[at] == NA => EMPTY,
            Kind::Int => f64::from(self.int[at]),
            Kind::Rel => self.rel[at],
            Kind::Dbl => last_output_letter(at)
                .map_or_else(|| self.dbl[at], |letter| self.last_output[letter]),
        })
    }

    /// Stores a value; [`EMPTY`] makes the location absent.
    ///
    /// # Errors
    /// A location out of range, a fraction or a value that is too large for
    /// INTCOM, a value that is not finite.
    pub fn set(&mut self, kind: Kind, location: u32, value: f64) -> Result<()> {
        let at = check(kind, location)?;
        if !value.is_finite() {
            return MachineCode::CommonValue
                .err(format!("{} {location} can't hold a value that is not finite", kind.name()));
        }
        let is_other = match kind {
            Kind::Int => {
                let value = integer(location, value)?;
                value != std::mem::replace(&mut Arc::make_mut(&mut self.int)[at], value)
            }
            Kind::Rel => value != std::mem::replace(&mut Arc::make_mut(&mut self.rel)[at], value),
            Kind::Dbl => match last_output_letter(at) {
                Some(letter) => value != std::mem::replace(&mut self.last_output[letter], value),
                None => value != std::mem::replace(&mut Arc::make_mut(&mut self.dbl)[at], value),
            },
        };
        if is_other {
            self.generation = self.generation.wrapping_add(weight(kind, location));
        }
        Ok(())
    }
}

/// The number of the letter whose last output value a location of DBLCOM is.
fn last_output_letter(at: usize) -> Option<usize> {
    at.checked_sub(LAST_OUTPUT).filter(|letter| (1..=LETTERS).contains(letter))
}

/// What a change of a location adds to the generation.
fn weight(kind: Kind, location: u32) -> u64 {
    let last_outputs = LAST_OUTPUT as u32 + 1..=LAST_OUTPUT as u32 + 26;
    let shifts = INPUT_TRANSLATE.map(|shift| u32::from(shift.0));
    match kind {
        Kind::Dbl if last_outputs.contains(&location) => 0,
        Kind::Dbl if shifts.contains(&location) => 1,
        _ if stored::acts(kind, location) => OF_SETTINGS,
        _ => 0,
    }
}

fn check(kind: Kind, location: u32) -> Result<usize> {
    let at = location as usize;
    if (1..=kind.size()).contains(&at) {
        return Ok(at);
    }
    MachineCode::CommonLocation.err(format!(
        "{} has the locations 1 to {}, not {location}",
        kind.name(),
        kind.size()
    ))
}

fn integer(location: u32, value: f64) -> Result<i32> {
    if value == EMPTY {
        return Ok(NA);
    }
    if value.fract() != 0.0 || value.abs() > 1e9 {
        return MachineCode::CommonValue
            .err(format!("INTCOM {location} holds whole numbers, not {value}"));
    }
    Ok(value as i32)
}

/// `G54`, `G54.1P3`, `G59.1`, or another letter with a number.
fn is_offset(name: &str) -> bool {
    let is_number =
        |text: &str| (1..=3).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
    let Some((letter, rest)) = name.split_at_checked(1) else { return false };
    let (code, extended) = match rest.split_once('P') {
        Some((code, number)) => (code, Some(number)),
        None => (rest, None),
    };
    let (whole, tenth) = match code.split_once('.') {
        Some((whole, tenth)) => (whole, Some(tenth)),
        None => (code, None),
    };
    let is_plain = tenth.is_none() && extended.is_none();
    letter.as_bytes()[0].is_ascii_uppercase()
        && is_number(whole)
        && tenth.is_none_or(|tenth| tenth.len() == 1 && is_number(tenth))
        && extended.is_none_or(is_number)
        && (letter == "G" || is_plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absent_reads_as_empty_in_every_common() {
        let mut commons = Commons::absent();
        for kind in [Kind::Int, Kind::Rel, Kind::Dbl] {
            assert_eq!(commons.get(kind, 25).unwrap(), EMPTY);
            commons.set(kind, 25, 4.0).unwrap();
            assert_eq!(commons.get(kind, 25).unwrap(), 4.0);
            commons.set(kind, 25, EMPTY).unwrap();
            assert_eq!(commons.get(kind, 25).unwrap(), EMPTY);
        }
    }

    #[test]
    fn bad_locations_and_values_are_refused() {
        let mut commons = Commons::absent();
        assert_eq!(commons.get(Kind::Int, 0).unwrap_err().code.name(), "E0601");
        assert_eq!(commons.get(Kind::Dbl, 10_000).unwrap_err().code.name(), "E0601");
        assert_eq!(commons.set(Kind::Int, 1, 0.5).unwrap_err().code.name(), "E0602");
        assert_eq!(commons.set(Kind::Dbl, 1, f64::NAN).unwrap_err().code.name(), "E0602");
    }

    #[test]
    fn last_output_values_do_not_stale_the_tables() {
        let mut commons = Commons::absent();
        commons.set(Kind::Dbl, 379, 5.0).unwrap();
        assert_eq!((commons.generation(), commons.last_output(Letter::of(b'X'))), (0, 5.0));
        let [shift, ..] = INPUT_TRANSLATE.map(|shift| u32::from(shift.0));
        commons.set(Kind::Dbl, shift, 5.0).unwrap();
        assert!(commons.generation() > 0 && commons.is_only_shifted_since(0));
        let shifted = commons.generation();
        commons.set(Kind::Dbl, shift, 5.0).unwrap();
        assert_eq!(commons.generation(), shifted);
        commons.set(Kind::Dbl, 486, 2.0).unwrap();
        assert!(!commons.is_only_shifted_since(shifted));
    }
}
