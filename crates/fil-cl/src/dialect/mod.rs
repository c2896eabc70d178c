//! The dialects of CL text, one file for each CAM system.
//!
//! Statements, items and numbers are the same in all of them. What differs stands in a
//! table, [`DialectRules`]: how a text is recognized, which way its circles turn, what the
//! values of a GOTO mean, where its writer breaks lines. A new dialect is a new file with
//! its `RULES`, a variant of [`ClDialect`] and a row in [`ClDialect::ALL`].

mod camworks;
mod camworks_axis;
mod catia;
mod creo;
mod ffcam;
mod fusion;
mod generic;
mod generic_left;
mod ncl;
mod nx;
mod ornl_slicer;
mod recognition;
mod solidworks_cam;

use crate::forms::{Rewrite, RewriteText};
use crate::vocabulary::WordId;

pub(crate) use recognition::Recognition;
pub use recognition::{Evidence, Recognized};

/// Which system wrote a CL text.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ClDialect {
    /// No particular system: APT words and right-hand circles.
    Generic,
    /// As [`ClDialect::Generic`], with circles that turn the other way. Never recognized.
    GenericLeft,
    /// PTC Creo, Pro/ENGINEER (`.ncl`).
    Creo,
    /// Siemens NX CLSF (`.cls`, `.clsf`).
    Nx,
    /// Dassault CATIA V5 APT (`.aptsource`).
    Catia,
    /// SolidWorks CAM APT (`.apt`).
    SolidWorksCam,
    /// CAMWorks CLT (`.clt`).
    CamWorks,
    /// As [`ClDialect::CamWorks`], with circles that turn as their axis says. Never
    /// recognized.
    CamWorksAxis,
    /// Makino FFCAM (`.cldata`).
    Ffcam,
    /// NCCS NCL (`.as`).
    Ncl,
    /// Autodesk Fusion and HSM APT (`.apt`).
    Fusion,
    /// ORNL Slicer 2 APT (`_output.apt`).
    OrnlSlicer,
}

/// How a dialect is recognized and what its statements mean.
#[derive(Debug)]
pub struct DialectRules {
    /// The name by which it is chosen.
    pub name: &'static str,
    /// The system and its file.
    pub title: &'static str,
    /// What only this system writes.
    pub signs: &'static [Sign],
    /// Its CIRCLE statements; `None` where they are not documented.
    pub circle: Option<CircleForm>,
    /// True where arcs are computed that TLON and HELICAL give by geometry.
    pub geometry: bool,
    /// True where NURBS, KNOT and CNTRL are read as lines.
    pub splines: bool,
    /// The tool axis of a GOTO with three values.
    pub axis: AxisRule,
    /// True where a GOTO may hold many points.
    pub packed_points: bool,
    /// Length in characters at which the writer breaks any line, comments and texts too,
    /// with `$` as the last character. Elsewhere `$` stands between items, and one in a
    /// text belongs to the text.
    pub break_column: Option<usize>,
    /// Three comments of four numbers give the frame of the part.
    pub frame_in_comments: bool,
    /// True where a list of items may end in a comma.
    pub trailing_comma: bool,
    /// True where a blank may part two items of a CYCLE.
    pub blanks_in_cycles: bool,
    /// True where words of a shop are followed by a comma in place of the slash.
    pub comma_words: bool,
    /// True where each file says its unit.
    pub writes_units: bool,
    /// True where MMPM and MMPR stand in files in mm only, and IPM and IPR in those in inches.
    pub feeds_tell_unit: bool,
    /// True where each file ends in FINI.
    pub writes_fini: bool,
    /// Brings its statements to the form of Creo, where they differ.
    pub(crate) rewrite: Option<Rewrite>,
    /// The same for text statements.
    pub(crate) rewrite_text: Option<RewriteText>,
    /// Major words that inform and do nothing, with the reason.
    #[doc(hidden)]
    pub without_effect: &'static [(&'static str, &'static str)],
}

/// What shows that a text is of a dialect. Case and blanks mean nothing.
#[derive(Clone, Copy, Debug)]
pub enum Sign {
    /// A `$$` comment that begins with this text, without blanks and in upper case.
    Comment(&'static str),
    /// A pseudo-comment `$$-> KEY / …`.
    Pseudo,
    /// A statement with this major word.
    Word(WordId),
    /// A statement whose major word has this name and no meaning in other dialects.
    Name(&'static str),
    /// A statement whose major word begins so.
    Prefix(&'static str),
    /// A text statement that holds this word.
    Text(WordId, &'static str),
    /// A text statement that begins so.
    TextBegin(WordId, &'static str),
}

/// The CIRCLE statements of a dialect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CircleForm {
    /// How many numbers stand before the first word.
    pub counts: &'static [usize],
    /// Which way round the axis means.
    pub sense: ArcSense,
    /// What proves the sense: programs that came with CL files, arc by arc. Arcs of such a
    /// dialect are right as they are read, whatever the motions beside them look like.
    pub proof: Option<&'static str>,
    /// A full turn ends exactly where it begins: an end a little farther on is that of a tiny arc.
    pub exact_turns: bool,
}

impl CircleForm {
    /// Circles of `counts` numbers whose axis has this sense, which nothing proves.
    const fn new(counts: &'static [usize], sense: ArcSense) -> Self {
        CircleForm { counts, sense, proof: None, exact_turns: false }
    }

    const fn proved_by(mut self, proof: &'static str) -> Self {
        self.proof = Some(proof);
        self
    }

    const fn with_exact_turns(mut self) -> Self {
        self.exact_turns = true;
        self
    }

    /// How many numbers it has, as `4, 6 or 7`.
    pub fn spell_counts(&self) -> String {
        let counts: Vec<String> = self.counts.iter().map(usize::to_string).collect();
        match counts.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            _ => counts.concat(),
        }
    }
}

/// Which way round an arc goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcSense {
    /// Counterclockwise seen against the axis.
    RightHand,
    /// Clockwise seen against the axis.
    LeftHand,
    /// As the word CLOCKWISE or COUNTERCLOCKWISE says, seen against the axis.
    ByWord,
    /// Counterclockwise seen against the axis, whatever word stands behind it.
    ByAxis,
}

impl ArcSense {
    /// The sense that turns each arc the other way.
    fn opposite(self) -> ArcSense {
        match self {
            ArcSense::RightHand => ArcSense::LeftHand,
            ArcSense::LeftHand => ArcSense::RightHand,
            ArcSense::ByWord => ArcSense::ByAxis,
            ArcSense::ByAxis => ArcSense::ByWord,
        }
    }
}

/// The tool axis of a GOTO that gives none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisRule {
    /// None: what TLAXIS, MULTAX and the post hold.
    AsWritten,
    /// The last one.
    Modal,
    /// The last one while MULTAX is on.
    ModalInMultax,
    /// Z: an axis is written whenever it is another one.
    Upright,
}

impl DialectRules {
    /// True where statements are those of Creo already.
    pub(crate) fn is_creo(&self) -> bool {
        self.name == creo::RULES.name
    }

    /// True for a major word that informs and does nothing.
    pub(crate) fn is_without_effect(&self, major: &str) -> bool {
        self.without_effect.iter().any(|(word, _)| word.eq_ignore_ascii_case(major))
    }
}

impl ClDialect {
    /// All dialects.
    pub const ALL: &'static [ClDialect] = &[
        ClDialect::Generic,
        ClDialect::GenericLeft,
        ClDialect::Creo,
        ClDialect::Nx,
        ClDialect::Catia,
        ClDialect::SolidWorksCam,
        ClDialect::CamWorks,
        ClDialect::CamWorksAxis,
        ClDialect::Ffcam,
        ClDialect::Ncl,
        ClDialect::Fusion,
        ClDialect::OrnlSlicer,
    ];

    /// The table of the dialect.
    #[doc(hidden)]
    pub const fn rules(self) -> &'static DialectRules {
        match self {
            ClDialect::Generic => &generic::RULES,
            ClDialect::GenericLeft => &generic_left::RULES,
            ClDialect::Creo => &creo::RULES,
            ClDialect::Nx => &nx::RULES,
            ClDialect::Catia => &catia::RULES,
            ClDialect::SolidWorksCam => &solidworks_cam::RULES,
            ClDialect::CamWorks => &camworks::RULES,
            ClDialect::CamWorksAxis => &camworks_axis::RULES,
            ClDialect::Ffcam => &ffcam::RULES,
            ClDialect::Ncl => &ncl::RULES,
            ClDialect::Fusion => &fusion::RULES,
            ClDialect::OrnlSlicer => &ornl_slicer::RULES,
        }
    }

    /// The name by which it is chosen.
    pub const fn name(self) -> &'static str {
        self.rules().name
    }

    /// The dialect of a name, in any case.
    ///
    /// ```
    /// use fil_cl::ClDialect;
    ///
    /// assert_eq!(ClDialect::named("nx"), Some(ClDialect::Nx));
    /// assert_eq!(ClDialect::named("surfcam"), None);
    /// ```
    pub fn named(name: &str) -> Option<ClDialect> {
        Self::ALL.iter().copied().find(|dialect| dialect.name().eq_ignore_ascii_case(name))
    }

    /// Why a major word does nothing in this dialect; `None` for a word that acts or is
    /// not known.
    pub fn without_effect(self, major: &str) -> Option<&'static str> {
        let rows = self.rules().without_effect.iter();
        rows.clone().find(|(word, _)| word.eq_ignore_ascii_case(major)).map(|(_, reason)| *reason)
    }

    /// What proves which way the arcs of the dialect turn.
    #[doc(hidden)]
    pub fn proof_of_arcs(self) -> Option<&'static str> {
        self.rules().circle.and_then(|form| form.proof)
    }

    /// An arc whose end lies a little beyond its start, in the running direction, is a tiny one and
    /// no full turn.
    #[doc(hidden)]
    pub fn has_exact_turns(self) -> bool {
        self.rules().circle.is_some_and(|form| form.exact_turns)
    }

    /// The system is told by its signs, and has one rule for its arcs.
    pub(crate) fn is_told(self) -> bool {
        !self.rules().signs.is_empty()
    }

    /// Turns arcs of as many numbers the other way than another dialect.
    pub(crate) fn turns_against(self, other: ClDialect) -> bool {
        let (Some(own), Some(other)) = (self.rules().circle, other.rules().circle) else {
            return false;
        };
        own.sense == other.sense.opposite()
            && own.counts.iter().any(|count| other.counts.contains(count))
    }

    /// The dialects that have a CIRCLE of as many numbers as this one and turn it the other
    /// way. There is none for a system that is told by its signs: its arcs have one rule.
    ///
    /// ```
    /// use fil_cl::ClDialect;
    ///
    /// assert_eq!(ClDialect::Generic.turning_otherwise(), [ClDialect::GenericLeft]);
    /// assert_eq!(ClDialect::SolidWorksCam.turning_otherwise(), []);
    /// ```
    #[doc(hidden)]
    pub fn turning_otherwise(self) -> Vec<ClDialect> {
        if self.is_told() {
            return Vec::new();
        }
        Self::ALL.iter().copied().filter(|other| other.turns_against(self)).collect()
    }

    /// The dialects in which a CIRCLE may have so many numbers.
    pub(crate) fn with_circles_of(numbers: usize) -> impl Iterator<Item = ClDialect> {
        let has = move |dialect: &ClDialect| {
            dialect.rules().circle.is_some_and(|form| form.counts.contains(&numbers))
        };
        Self::ALL.iter().copied().filter(has)
    }
}

impl std::fmt::Display for ClDialect {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for ClDialect {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        ClDialect::named(name).ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|dialect| dialect.name()).collect();
            format!("no dialect `{name}`; there are {}", names.join(", "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_lower_case_and_lead_back() {
        for dialect in ClDialect::ALL {
            let name = dialect.name();
            assert!(name.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'-'), "{name}");
            assert_eq!(name.parse(), Ok(*dialect));
            assert_eq!(ClDialect::named(&name.to_uppercase()), Some(*dialect));
        }
        let wrong = "fanuc".parse::<ClDialect>().unwrap_err();
        assert!(wrong.contains("solidworks-cam"), "{wrong}");
    }

    #[test]
    fn each_dialect_but_the_generic_ones_has_signs() {
        for dialect in ClDialect::ALL {
            let signs = dialect.rules().signs.len();
            let by_choice = matches!(
                dialect,
                ClDialect::Generic | ClDialect::GenericLeft | ClDialect::CamWorksAxis
            );
            assert_eq!(signs == 0, by_choice, "{dialect}");
        }
    }

    #[test]
    fn words_without_effect_have_a_reason() {
        assert!(ClDialect::Nx.without_effect("paint").is_some());
        assert_eq!(ClDialect::Creo.without_effect("PAINT"), None);
        for dialect in ClDialect::ALL {
            for (word, reason) in dialect.rules().without_effect {
                assert_eq!(dialect.without_effect(word), Some(*reason));
                assert!(!reason.is_empty() && word.to_uppercase() == *word, "{word}");
            }
        }
    }
}
