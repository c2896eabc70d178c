//! PROGF, TLISTF, OPERF, TOOLF(NEXT) and the texts beside them: what they ask the host for.
//! A header comes before the motions it tells of, so the host answers from a first pass over
//! the CL file.

/// What a number is asked of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TotalsOf {
    /// The whole program: PROGF.
    Program,
    /// An entry of the tool list, from 0: TLISTF.
    Tool(usize),
    /// An operation, from 0: OPERF.
    Operation(usize),
}

/// A text that the host knows from the first pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TotalsText {
    /// TEXT/PROG: the text of PARTNO.
    Part,
    /// TEXT/TLIST: what the CL file calls an entry of the tool list.
    Tool(usize),
    /// TEXT/OPER: the name of an operation.
    Operation(usize),
}

/// A number that is asked for. Lengths are in the unit of the CL file, times in minutes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TotalsWord {
    /// Entries of the tool list.
    Tools,
    /// Operations.
    Operations,
    /// Millimeters in one unit of the CL file: 1 or 25.4.
    Units,
    /// Number of the tool, or of the tool of an operation.
    Tool,
    /// Number of the feature of an operation in the CAM system.
    Feature,
    /// Diameter of the tool.
    Diameter,
    /// Length of the tool, as LENGTH of LOADTL gives it.
    Length,
    /// All of the time.
    Time,
    /// Time at feed.
    CuttingTime,
    /// Time at rapid traverse.
    RapidTime,
    /// Length of the path at feed.
    CuttingLength,
    /// Length of the path at rapid traverse.
    RapidLength,
    /// Least (false) or largest (true) coordinate of an axis.
    Extent(usize, bool),
}

use TotalsWord::{
    CuttingLength, CuttingTime, Diameter, Extent, Feature, Length, Operations, RapidLength,
    RapidTime, Time, Tool, Tools, Units,
};

/// Words that all three functions take.
const COMMON: [(&str, TotalsWord); 11] = [
    ("TIME", Time),
    ("CUTTIM", CuttingTime),
    ("RAPTIM", RapidTime),
    ("CUTLEN", CuttingLength),
    ("RAPLEN", RapidLength),
    ("XMIN", Extent(0, false)),
    ("XMAX", Extent(0, true)),
    ("YMIN", Extent(1, false)),
    ("YMAX", Extent(1, true)),
    ("ZMIN", Extent(2, false)),
    ("ZMAX", Extent(2, true)),
];

const OF_PROGRAM: [(&str, TotalsWord); 3] =
    [("TOOLS", Tools), ("OPERS", Operations), ("UNITS", Units)];
const OF_TOOL: [(&str, TotalsWord); 3] =
    [("NUMBER", Tool), ("DIAMTR", Diameter), ("LENGTH", Length)];
const OF_OPERATION: [(&str, TotalsWord); 2] = [("TOOL", Tool), ("FEATNO", Feature)];

/// Which of the three functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TotalsList {
    /// PROGF
    Program,
    /// TLISTF
    Tools,
    /// OPERF
    Operations,
}

impl TotalsList {
    /// The words it takes, its own first.
    pub(crate) fn words(self) -> impl Iterator<Item = (&'static str, TotalsWord)> {
        let own: &'static [(&'static str, TotalsWord)] = match self {
            TotalsList::Program => &OF_PROGRAM,
            TotalsList::Tools => &OF_TOOL,
            TotalsList::Operations => &OF_OPERATION,
        };
        own.iter().chain(COMMON.iter()).copied()
    }

    /// Number of a word among [`words`](TotalsList::words).
    pub(crate) fn find(self, word: &str) -> Option<usize> {
        self.words().position(|(name, _)| name == word)
    }

    /// The word of that number.
    pub(crate) fn word(self, number: usize) -> TotalsWord {
        self.words().nth(number).expect("the compiler writes numbers of `find`").1
    }
}

/// Room for the words of one function in the number that an operation carries.
const WORDS: u16 = 32;

/// The number for a function and one of its words.
pub(crate) fn what(list: TotalsList, word: usize) -> u16 {
    list as u16 * WORDS + word as u16
}

/// The function and the word of a number.
pub(crate) fn meant_by(what: u16) -> (TotalsList, TotalsWord) {
    let list = match what / WORDS {
        0 => TotalsList::Program,
        1 => TotalsList::Tools,
        _ => TotalsList::Operations,
    };
    (list, list.word(usize::from(what % WORDS)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_word_comes_back() {
        for list in [TotalsList::Program, TotalsList::Tools, TotalsList::Operations] {
            for (number, (name, word)) in list.words().enumerate() {
                assert_eq!(list.find(name), Some(number), "{name} stands twice");
                assert_eq!(meant_by(what(list, number)), (list, word));
            }
        }
    }
}
