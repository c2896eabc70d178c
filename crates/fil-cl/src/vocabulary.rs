//! The vocabulary: words, their identities and their integer codes.

use std::borrow::Cow;
use std::collections::HashMap;
use std::mem;
use std::sync::{Arc, LazyLock};

use fil_diag::letter_case;
use fil_diag::suggest::{did_you_mean, nearest};

pub use crate::words;

/// Identity of a vocabulary word within a run. Two words are the same word
/// exactly when their ids are equal; codes may be shared by two words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct WordId(pub(crate) u32);

impl WordId {
    /// The id as an index, for tables kept beside the vocabulary.
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The id of an index that [`WordId::index`] gave.
    #[doc(hidden)]
    pub fn from_index(index: u32) -> Self {
        WordId(index)
    }
}

/// Class bit: the word opens a statement.
pub(crate) const MAJOR: u8 = 1;
/// Class bit: the word stands inside a statement.
pub(crate) const MINOR: u8 = 2;

/// Codes of our own start here, above every published code.
const OWN_CODES: u64 = 1_000_000;

/// The published codes; its header names the columns.
const PUBLISHED: &str = include_str!("../data/vocabulary.tsv");

/// Fewest slots of a table of names.
const FEWEST_SLOTS: usize = 16;

/// A slot that holds no word.
const FREE: u32 = u32::MAX;

#[derive(Clone, Debug)]
struct Entry {
    /// Upper case.
    name: Cow<'static, str>,
    hash: u32,
    class: u8,
    public: bool,
    /// A word of [`words`] or of a post family, and not of an APT processor alone.
    of_posts: bool,
    /// The CL file has named its code.
    of_file: bool,
    code: f64,
}

/// Words that are found by their names.
#[derive(Clone, Debug, Default)]
struct Words {
    entries: Vec<Entry>,
    /// Open addressing over the hash of the name; never more than half full.
    slots: Vec<u32>,
    /// Codes of our own, to find a free one and to get back to the word.
    own_codes: HashMap<u64, WordId>,
}

impl Words {
    fn lookup(&self, name: &[u8], hash: u32) -> Option<usize> {
        let mask = self.slots.len().checked_sub(1)?;
        let mut slot = hash as usize & mask;
        loop {
            let index = self.slots[slot] as usize;
            let entry = self.entries.get(index)?;
            let known = entry.name.as_bytes();
            if entry.hash == hash && (known == name || known.eq_ignore_ascii_case(name)) {
                return Some(index);
            }
            slot = (slot + 1) & mask;
        }
    }

    fn insert(&mut self, entry: Entry) {
        self.entries.push(entry);
        let last = self.entries.len() - 1;
        if self.entries.len() * 2 > self.slots.len() {
            self.slots = vec![FREE; (self.slots.len() * 2).max(FEWEST_SLOTS)];
            (0..=last).for_each(|index| self.occupy(index));
        } else {
            self.occupy(last);
        }
    }

    fn occupy(&mut self, index: usize) {
        let mask = self.slots.len() - 1;
        let mut slot = self.entries[index].hash as usize & mask;
        while self.slots[slot] != FREE {
            slot = (slot + 1) & mask;
        }
        self.slots[slot] = index as u32;
    }
}

/// The words known to a run: those of the published tables and those the CL
/// file or the FIL script brought along.
#[derive(Clone, Debug)]
pub struct Vocabulary {
    // Each run starts with a copy, and a CL file brings few words along.
    /// Those of the tables.
    tables: Arc<Words>,
    /// Those that came after them.
    added: Arc<Words>,
    /// The word of each published code, as [`Vocabulary::minor_with_code`] gives it.
    public_codes: Arc<HashMap<u64, WordId>>,
}

impl Default for Vocabulary {
    fn default() -> Self {
        Self::new()
    }
}

impl Vocabulary {
    /// The words of [`words`], with the ids given there, and the published table.
    pub fn new() -> Self {
        // A program is built for each of many cases, and the table is always the same.
        static FIRST: LazyLock<Vocabulary> = LazyLock::new(Vocabulary::of_tables);
        FIRST.clone()
    }

    fn of_tables() -> Self {
        let mut vocabulary = Vocabulary {
            tables: Arc::default(),
            added: Arc::default(),
            public_codes: Arc::default(),
        };
        for (name, class) in words::NAMES_AND_CLASSES {
            let id = vocabulary.insert(Cow::Borrowed(name), hash(name.as_bytes()), *class);
            vocabulary.entry_mut(id).of_posts = true;
        }
        for line in PUBLISHED.lines().filter(|line| !line.starts_with('#')) {
            vocabulary.publish(line);
        }
        for id in (0..words::NAMES_AND_CLASSES.len() as u32).map(WordId) {
            if !vocabulary.entry(id).public {
                vocabulary.give_own_code(id);
            }
        }
        vocabulary.tables = mem::take(&mut vocabulary.added);
        // The first word stays, and a minor one.
        for class in [MAJOR, MINOR] {
            let entries = vocabulary.tables.entries.iter().enumerate().rev();
            let codes = Arc::make_mut(&mut vocabulary.public_codes);
            for (index, entry) in entries.filter(|(_, e)| e.public && e.class & class != 0) {
                codes.insert(entry.code as u64, WordId(index as u32));
            }
        }
        vocabulary
    }

    /// The id of a word, case-insensitive; a new word gets a code of our own.
    pub fn intern(&mut self, name: &str) -> WordId {
        if name.is_ascii() {
            return self.intern_bytes(name.as_bytes());
        }
        let upper = letter_case::upper(name);
        self.intern_upper(upper.as_bytes())
    }

    /// The same for the bytes of a name; those of a name that is not ASCII are
    /// read as UTF-8, with U+FFFD for what is none.
    #[doc(hidden)]
    pub fn intern_bytes(&mut self, name: &[u8]) -> WordId {
        if name.is_ascii() {
            return self.intern_upper(name);
        }
        let upper = letter_case::upper(&String::from_utf8_lossy(name));
        self.intern_upper(upper.as_bytes())
    }

    /// The id of a word that is already known.
    pub fn find(&self, name: &str) -> Option<WordId> {
        if name.is_ascii() {
            return self.lookup(name.as_bytes(), hash(name.as_bytes()));
        }
        let upper = letter_case::upper(name);
        self.lookup(upper.as_bytes(), hash(upper.as_bytes()))
    }

    /// The name, in upper case.
    ///
    /// # Panics
    /// When the id comes from another vocabulary that holds more words.
    pub fn name(&self, id: WordId) -> &str {
        &self.entry(id).name
    }

    /// The words this crate or a published table knows.
    fn known_names(&self) -> impl Iterator<Item = &str> {
        self.entries().filter(|entry| entry.class != 0).map(|entry| entry.name.as_ref())
    }

    /// A hint with the known word that an unknown one was perhaps meant to be.
    pub fn perhaps_meant(&self, id: WordId) -> Option<String> {
        if self.is_known(id) { None } else { did_you_mean(self.name(id), self.known_names()) }
    }

    /// The known word that opens statements and that an unknown one differs least from;
    /// `None` where it is near to none.
    pub fn nearest_major(&self, id: WordId) -> Option<&str> {
        let majors = self.entries().filter(|entry| entry.class & MAJOR != 0);
        let names = majors.map(|entry| entry.name.as_ref());
        if self.is_known(id) { None } else { nearest(self.name(id), names) }
    }

    /// The integer code, without a unit. Of the published ones the first of: gpost, PostWorks,
    /// APT-AC, APT360, NCL.
    pub fn code(&self, id: WordId) -> f64 {
        self.entry(id).code
    }

    /// False when the code is our own and means nothing outside filpost.
    pub fn is_public(&self, id: WordId) -> bool {
        self.entry(id).public
    }

    /// True for a word known to open statements (it may be a minor word as well).
    pub fn is_major(&self, id: WordId) -> bool {
        self.entry(id).class & MAJOR != 0
    }

    /// True for a word this crate or a published table knows, whatever its code.
    pub fn is_known(&self, id: WordId) -> bool {
        self.entry(id).class != 0
    }

    /// True for a word that statements for posts use. The tables also have words of the
    /// language of APT processors, which mean nothing in a CL file.
    #[doc(hidden)]
    pub fn is_of_posts(&self, id: WordId) -> bool {
        self.entry(id).of_posts
    }

    /// The word a code stands for where a minor word is due. Of several words
    /// with the code a minor word is taken before a major one, and a word of
    /// [`words`] before another.
    #[doc(hidden)]
    pub fn minor_with_code(&self, code: f64) -> Option<WordId> {
        if code < 0.0 || code.fract() != 0.0 {
            return None;
        }
        let (code, is_own) = (code as u64, code >= OWN_CODES as f64);
        if is_own { self.with_own_code(code) } else { self.public_codes.get(&code).copied() }
    }

    fn with_own_code(&self, code: u64) -> Option<WordId> {
        let of_tables = self.tables.own_codes.get(&code);
        of_tables.or_else(|| self.added.own_codes.get(&code)).copied()
    }

    /// Notes which word a published code stands for, once the words have changed.
    fn find_public(&mut self, code: f64) {
        let with_class = |class: u8| {
            self.entries().position(|e| e.public && e.code == code && e.class & class != 0)
        };
        let found = with_class(MINOR).or_else(|| with_class(MAJOR));
        let codes = Arc::make_mut(&mut self.public_codes);
        match found {
            Some(index) => codes.insert(code as u64, WordId(index as u32)),
            None => codes.remove(&(code as u64)),
        };
    }

    /// Gives a word the code that the CL file names for it. A word of the published tables that
    /// had this code gets one of our own: a code stands for one word in a file.
    pub(crate) fn set_code(&mut self, id: WordId, code: u32) {
        let code = f64::from(code);
        let has_it = |entry: &Entry| entry.public && !entry.of_file && entry.code == code;
        let ids = (0..self.len() as u32).map(WordId);
        let others: Vec<WordId> = ids.filter(|other| has_it(self.entry(*other))).collect();
        for other in others {
            self.entry_mut(other).public = false;
            self.give_own_code(other);
        }
        let entry = self.entry_mut(id);
        let before = entry.code;
        (entry.code, entry.public, entry.of_file) = (code, true, true);
        self.find_public(before);
        self.find_public(code);
    }

    fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.tables.entries.iter().chain(&self.added.entries)
    }

    #[inline]
    fn entry(&self, id: WordId) -> &Entry {
        let index = id.index();
        let of_added = |index| &self.added.entries[index];
        index
            .checked_sub(self.tables.entries.len())
            .map_or_else(|| &self.tables.entries[index], of_added)
    }

    fn entry_mut(&mut self, id: WordId) -> &mut Entry {
        match id.index().checked_sub(self.tables.entries.len()) {
            None => &mut Arc::make_mut(&mut self.tables).entries[id.index()],
            Some(index) => &mut Arc::make_mut(&mut self.added).entries[index],
        }
    }

    /// Number of words.
    pub fn len(&self) -> usize {
        self.tables.entries.len() + self.added.entries.len()
    }

    /// Never true: the published words are always there.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Interns a name in which only ASCII letters may be lower case.
    fn intern_upper(&mut self, name: &[u8]) -> WordId {
        let hash = hash(name);
        if let Some(id) = self.lookup(name, hash) {
            return id;
        }
        let upper = String::from_utf8_lossy(name).to_ascii_uppercase();
        let id = self.insert(Cow::Owned(upper), hash, 0);
        self.give_own_code(id);
        id
    }

    fn lookup(&self, name: &[u8], hash: u32) -> Option<WordId> {
        let of_added = || Some(self.tables.entries.len() + self.added.lookup(name, hash)?);
        Some(WordId(self.tables.lookup(name, hash).or_else(of_added)? as u32))
    }

    fn insert(&mut self, name: Cow<'static, str>, hash: u32, class: u8) -> WordId {
        let of_posts = false;
        let entry = Entry { name, hash, class, public: false, of_posts, of_file: false, code: 0.0 };
        Arc::make_mut(&mut self.added).insert(entry);
        WordId(self.len() as u32 - 1)
    }

    /// A code that depends on the name alone, so that it is the same in every
    /// run; two names with one hash value share no code, the later one moves on.
    fn give_own_code(&mut self, id: WordId) {
        let mut code = OWN_CODES + u64::from(self.entry(id).hash);
        while self.with_own_code(code).is_some() {
            code += 1;
        }
        Arc::make_mut(&mut self.added).own_codes.insert(code, id);
        self.entry_mut(id).code = code as f64;
    }

    /// Takes one line of the published table.
    fn publish(&mut self, line: &'static str) {
        let mut columns = line.split('\t');
        let (Some(name), Some(class)) = (columns.next(), columns.next()) else { return };
        let mut next = || columns.next().and_then(|column| column.trim().parse::<u32>().ok());
        let (apt360, aptac, postworks, ncl, gpost) = (next(), next(), next(), next(), next());
        let of_posts = gpost.or(postworks);
        let Some(code) = of_posts.or(aptac).or(apt360).or(ncl) else { return };
        let hash = hash(name.as_bytes());
        let id = match self.lookup(name.as_bytes(), hash) {
            Some(id) => id,
            None => self.insert(Cow::Borrowed(name), hash, 0),
        };
        let entry = self.entry_mut(id);
        entry.class |= match class {
            "major" => MAJOR,
            "minor" => MINOR,
            _ => MAJOR | MINOR,
        };
        entry.public = true;
        entry.of_posts |= of_posts.is_some();
        entry.code = f64::from(code);
    }
}

/// 32-bit FNV-1a of the name in upper case (ASCII letters).
fn hash(name: &[u8]) -> u32 {
    name.iter().fold(0x811c_9dc5, |hash, byte| {
        (hash ^ u32::from(byte.to_ascii_uppercase())).wrapping_mul(0x0100_0193)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_have_their_names() {
        let vocabulary = Vocabulary::new();
        assert_eq!(vocabulary.name(words::GOTO), "GOTO");
        assert_eq!(vocabulary.name(words::FIRST_PECK), "1STPECK");
        assert_eq!(vocabulary.name(words::SPEED), "SPEED");
        for (index, (name, _)) in words::NAMES_AND_CLASSES.iter().enumerate() {
            assert_eq!(vocabulary.find(name), Some(WordId(index as u32)), "{name} is there twice");
        }
    }

    #[test]
    fn published_codes() {
        let vocabulary = Vocabulary::new();
        let code = |name| vocabulary.code(vocabulary.find(name).unwrap());
        assert_eq!(code("spindl"), 1031.0);
        assert_eq!(code("THREAD"), 1036.0);
        assert_eq!(code("MMPM"), 315.0, "PostWorks comes first");
        assert_eq!(code("DEFSUB"), 1140.0, "only in APT-AC");
        assert_eq!(code("RETURN"), 322.0, "only in NCL");
        assert!(vocabulary.is_public(words::DEEP) && !vocabulary.is_public(words::CLEAR));
        assert!(vocabulary.is_major(words::SPINDL) && !vocabulary.is_major(words::CLW));
    }

    #[test]
    fn only_unknown_words_are_perhaps_others() {
        let mut vocabulary = Vocabulary::new();
        let mut hint = |word| {
            let id = vocabulary.intern(word);
            vocabulary.perhaps_meant(id)
        };
        assert_eq!(hint("SPINDEL").as_deref(), Some("did you mean SPINDL?"));
        assert_eq!(hint("EMBOSL"), None);
        assert_eq!(hint("EMBOSM"), None, "a word of the user is no known one");
        assert_eq!(hint("SPINDL"), None);
    }

    #[test]
    fn codes_of_our_own_depend_on_the_name_alone() {
        let (mut one, mut two) = (Vocabulary::new(), Vocabulary::new());
        let first = one.intern("Embosl");
        two.intern("SOMETHING");
        let second = two.intern("EMBOSL");
        assert_eq!(one.code(first), two.code(second));
        assert_eq!(one.name(first), "EMBOSL");
        assert_eq!(one.intern("EMBOSL"), first);
        assert!(one.code(first) >= 1e6);
        assert_eq!(one.minor_with_code(one.code(first)), Some(first));
        assert_eq!(one.minor_with_code(0.5), None);
    }

    #[test]
    fn names_with_one_hash_value_keep_apart() {
        let mut vocabulary = Vocabulary::new();
        let mut seen: HashMap<u32, String> = HashMap::new();
        let pair = (0..400_000u32).find_map(|n| {
            let name = format!("W{n}");
            seen.insert(hash(name.as_bytes()), name.clone()).map(|other| (other, name))
        });
        let (one, other) = pair.expect("two of 400000 names share a 32-bit hash");
        let (one, other) = (vocabulary.intern(&one), vocabulary.intern(&other));
        assert_ne!(one, other);
        assert_eq!(vocabulary.code(other), vocabulary.code(one) + 1.0);
        assert_eq!(vocabulary.minor_with_code(vocabulary.code(other)), Some(other));
    }

    #[test]
    fn many_words_and_letters_beyond_ascii() {
        let mut vocabulary = Vocabulary::new();
        let ids: Vec<_> = (0..10_000).map(|n| vocabulary.intern(&format!("USER{n}"))).collect();
        assert_eq!(vocabulary.find("user9999"), Some(ids[9999]));
        assert_eq!(vocabulary.find("SPINDL"), Some(words::SPINDL));
        let id = vocabulary.intern("станок");
        assert_eq!(vocabulary.name(id), "СТАНОК");
        assert_eq!(vocabulary.intern_bytes("Станок".as_bytes()), id);
    }

    #[test]
    fn a_code_prefers_a_minor_word() {
        let vocabulary = Vocabulary::new();
        assert_eq!(vocabulary.minor_with_code(8.0), Some(words::LEFT));
        assert_eq!(vocabulary.minor_with_code(153.0), Some(words::DEEP));
        assert_eq!(vocabulary.minor_with_code(1031.0), Some(words::SPINDL));
        assert_eq!(vocabulary.minor_with_code(-3.0), None);
    }
}
