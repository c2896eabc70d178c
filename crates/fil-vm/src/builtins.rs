//! The built-in functions, the forms of TEXT/ and the statements of our own: name,
//! arguments, meaning, grade and arithmetic in one table.
//!
//! POSTF has a table of its own, [`postf`](crate::postf).

use crate::arithmetic::{arc_tangent, cos_degrees, distance, sin_degrees};
use crate::library::Library;
use crate::postf::Grade;
use crate::totals::TotalsList;

/// What the compiler does with a built-in function.
#[derive(Clone, Copy)]
pub enum FunctionKind {
    /// A function of that many numbers.
    Numbers(u16, fn(&[f64]) -> Option<f64>),
    /// A function of two numbers, applied in turn to two or more.
    Fold(fn(&[f64]) -> Option<f64>),
    /// Work on texts and the world outside, with the least and most arguments.
    Library(Library, u16, u16),
    /// FILEF
    File,
    /// SIZEF
    Size,
    /// A statement of its own.
    Statement,
    /// ICODEF
    WordCode,
    /// POSTF
    Postf,
    /// COUPLF
    Couplet,
    /// HASF
    HasWord,
    /// NEXTF
    NextMotion,
    /// PREVF
    PreviousMotion,
    /// TOOLF
    ToolData,
    /// PROGF, TLISTF and OPERF
    Totals(TotalsList),
    /// LASTF
    LastWritten,
    /// COMF
    NamedCommon,
    /// OPTIONF
    PostOption,
}

impl FunctionKind {
    /// Which argument of such a function is a word or name as it is written.
    pub(crate) fn word_argument(self) -> Option<usize> {
        match self {
            FunctionKind::WordCode
            | FunctionKind::Couplet
            | FunctionKind::HasWord
            | FunctionKind::NextMotion
            | FunctionKind::PreviousMotion
            | FunctionKind::ToolData
            | FunctionKind::Size
            | FunctionKind::Totals(TotalsList::Program) => Some(0),
            FunctionKind::File | FunctionKind::Totals(_) => Some(1),
            _ => None,
        }
    }
}

/// A built-in function, a form of TEXT/ or a statement.
pub struct Builtin {
    /// Its name; `TEXT/` stands before that of a form.
    pub name: &'static str,
    /// Its arguments as a call shows them.
    pub arguments: &'static str,
    /// What it gives.
    pub doc: &'static str,
    /// How sure that is.
    pub grade: Grade,
    /// True for an extension of filpost, refused under `--strict`.
    pub extension: bool,
    /// What the compiler does with it.
    pub kind: FunctionKind,
}

impl Builtin {
    /// It as a script writes it: `SQRTF(x)`, `TEXT/UP,t`, `DATA/name,v,…`.
    pub fn call(&self) -> String {
        let (name, arguments) = (self.name, self.arguments);
        match self.kind {
            FunctionKind::Statement => format!("{name}/{arguments}"),
            _ if !name.contains('/') => format!("{name}({arguments})"),
            _ if arguments.is_empty() => name.to_string(),
            _ => format!("{name},{arguments}"),
        }
    }
}

const fn function(
    name: &'static str,
    arguments: &'static str,
    grade: Grade,
    kind: FunctionKind,
    doc: &'static str,
) -> Builtin {
    Builtin { name, arguments, doc, grade, extension: false, kind }
}

const fn extension(
    name: &'static str,
    arguments: &'static str,
    kind: FunctionKind,
    doc: &'static str,
) -> Builtin {
    Builtin { name, arguments, doc, grade: Grade::Own, extension: true, kind }
}

use FunctionKind::{Fold, Numbers};
use Grade::{Inferred, Own, Published};

/// All of them. A function of numbers gives `None`, or a result that
/// is not finite, outside of its domain.
pub const BUILTINS: &[Builtin] = &[
    function("ABSF", "x", Published, Numbers(1, |a| Some(a[0].abs())), "absolute value"),
    function(
        "SQRTF",
        "x",
        Published,
        Numbers(1, |a| Some(a[0].sqrt())),
        "square root; x must not be negative",
    ),
    function(
        "SINF",
        "x",
        Inferred,
        Numbers(1, |a| Some(sin_degrees(a[0]))),
        "sine of an angle in degrees",
    ),
    function(
        "COSF",
        "x",
        Inferred,
        Numbers(1, |a| Some(cos_degrees(a[0]))),
        "cosine of an angle in degrees",
    ),
    function(
        "TANF",
        "x",
        Inferred,
        Numbers(1, |a| Some(sin_degrees(a[0]) / cos_degrees(a[0]))),
        "tangent of an angle in degrees",
    ),
    function(
        "ASINF",
        "x",
        Inferred,
        Numbers(1, |a| Some(libm::asin(a[0]).to_degrees())),
        "arc sine in degrees",
    ),
    function(
        "ACOSF",
        "x",
        Inferred,
        Numbers(1, |a| Some(libm::acos(a[0]).to_degrees())),
        "arc cosine in degrees",
    ),
    function(
        "ATANF",
        "x",
        Published,
        Numbers(1, |a| Some(libm::atan(a[0]).to_degrees())),
        "arc tangent of a ratio, in degrees",
    ),
    function(
        "ATAN2F",
        "y,x",
        Own,
        Numbers(2, arc_tangent),
        "angle of the point x,y in degrees, -180 to 180",
    ),
    function(
        "LOGF",
        "x",
        Inferred,
        Numbers(1, |a| Some(libm::log(a[0]))),
        "natural logarithm; x must be positive",
    ),
    function(
        "LOG10F",
        "x",
        Own,
        Numbers(1, |a| Some(libm::log10(a[0]))),
        "decimal logarithm; x must be positive",
    ),
    function("EXPF", "x", Inferred, Numbers(1, |a| Some(libm::exp(a[0]))), "e to the power x"),
    function("INTF", "x", Inferred, Numbers(1, |a| Some(a[0].trunc())), "whole part, towards zero"),
    function(
        "NINTF",
        "x",
        Own,
        Numbers(1, |a| Some(a[0].round())),
        "nearest whole number, halves away from zero",
    ),
    function(
        "ROUNDF",
        "x",
        Own,
        Numbers(1, |a| Some(a[0].round())),
        "nearest whole number, halves away from zero",
    ),
    function(
        "MODF",
        "a,b",
        Own,
        Numbers(2, |a| (a[1] != 0.0).then(|| a[0] % a[1])),
        "rest of a/b with the sign of a",
    ),
    function(
        "SIGNF",
        "a,b",
        Own,
        Numbers(2, |a| Some(if a[1] < 0.0 { -a[0].abs() } else { a[0].abs() })),
        "absolute value of a with the sign of b",
    ),
    function("MAXF", "a,b,…", Own, Fold(|a| Some(a[0].max(a[1]))), "largest value"),
    function("MINF", "a,b,…", Own, Fold(|a| Some(a[0].min(a[1]))), "smallest value"),
    function("MAX1F", "a,b,…", Own, Fold(|a| Some(a[0].max(a[1]))), "largest value"),
    function("MIN1F", "a,b,…", Own, Fold(|a| Some(a[0].min(a[1]))), "smallest value"),
    function("DISTF", "x1,y1,z1,x2,y2,z2", Own, Numbers(6, distance), "distance of two points"),
    function(
        "DOTF",
        "i1,j1,k1,i2,j2,k2",
        Own,
        Numbers(6, |a| Some(a[0] * a[3] + a[1] * a[4] + a[2] * a[5])),
        "scalar product of two vectors",
    ),
    function(
        "LNTHF",
        "t",
        Own,
        FunctionKind::Library(Library::Length, 1, 1),
        "number of characters of a text",
    ),
    function(
        "INDXF",
        "t,x[,from]",
        Own,
        FunctionKind::Library(Library::Position, 2, 3),
        "position of the first x in t, at or after character `from`; 0 when there is none",
    ),
    function(
        "CMPF",
        "t1,t2",
        Own,
        FunctionKind::Library(Library::Compare, 2, 2),
        "order of two texts by their character codes: -1, 0 or 1",
    ),
    function(
        "CMPRF",
        "t1,t2",
        Own,
        FunctionKind::Library(Library::Compare, 2, 2),
        "the same as CMPF",
    ),
    function(
        "ICHARF",
        "t[,n]",
        Own,
        FunctionKind::Library(Library::CharacterCode, 1, 2),
        "code of character n of a text (Unicode, so ASCII for the usual letters); n is 1 when left out",
    ),
    function(
        "SCALF",
        "t",
        Own,
        FunctionKind::Library(Library::ToNumber, 1, 1),
        "the number a text holds, blanks around it allowed; any other text is refused",
    ),
    function(
        "TEXTF",
        "x[,width[,decimals]][,rules]",
        Own,
        FunctionKind::Library(Library::ToText, 1, 3),
        "a number as text; the same as TEXT/CONVF",
    ),
    function(
        "CONVF",
        "x[,width[,decimals]][,rules]",
        Own,
        FunctionKind::Library(Library::ToText, 1, 3),
        "a number as text; the same as TEXT/CONVF",
    ),
    function(
        "CONVI",
        "n[,width][,rules]",
        Own,
        FunctionKind::Library(Library::WholeToText, 1, 2),
        "a whole number as text; the same as TEXT/CONVI",
    ),
    function(
        "TEXT/CLW",
        "",
        Own,
        FunctionKind::Library(Library::RecordText, 0, 0),
        "text of the current record, which must be one of text (PARTNO, PPRINT, INSERT, …)",
    ),
    function(
        "TEXT/PART",
        "t,from[,to]",
        Own,
        FunctionKind::Library(Library::Part, 2, 3),
        "characters `from` to `to` of a text, to its end when `to` is left out; `to` = `from` - 1 gives the empty text",
    ),
    function(
        "TEXT/RANGE",
        "t,from[,to]",
        Own,
        FunctionKind::Library(Library::Part, 2, 3),
        "the same as TEXT/PART",
    ),
    function(
        "TEXT/REPEAT",
        "t,n",
        Own,
        FunctionKind::Library(Library::Repeat, 2, 2),
        "a text n times, one after the other",
    ),
    function(
        "TEXT/LAST",
        "t,n",
        Own,
        FunctionKind::Library(Library::Last, 2, 2),
        "the last n characters of a text",
    ),
    function(
        "TEXT/OMIT",
        "t,x",
        Own,
        FunctionKind::Library(Library::Omit, 2, 2),
        "a text without any x in it",
    ),
    function(
        "TEXT/MODIFY",
        "t,old,new",
        Own,
        FunctionKind::Library(Library::Modify, 3, 3),
        "a text with `new` in the place of each `old`",
    ),
    function(
        "TEXT/UP",
        "t",
        Own,
        FunctionKind::Library(Library::Upper, 1, 1),
        "a text in upper case",
    ),
    function(
        "TEXT/LOW",
        "t",
        Own,
        FunctionKind::Library(Library::Lower, 1, 1),
        "a text in lower case",
    ),
    function(
        "TEXT/CONVI",
        "n[,width][,rules]",
        Own,
        FunctionKind::Library(Library::WholeToText, 1, 2),
        "a whole number as text, right in its width; rules: PLUS, ZEROS; too narrow a width is refused",
    ),
    function(
        "TEXT/CONVF",
        "x[,width[,decimals]][,rules]",
        Own,
        FunctionKind::Library(Library::ToText, 1, 3),
        "a number as text, right in its width (0: as wide as it is), shortest without `decimals`, else rounded half away from zero; rules: PLUS + before positive numbers, ZEROS zeros in place of blanks in front, TRIM no zeros at the end, POINT a point in every number, NOLEAD no zero before the point",
    ),
    function(
        "TEXT/READ",
        "unit",
        Own,
        FunctionKind::Library(Library::ReadLine, 1, 1),
        "the next line of a file open for reading; needs a folder granted",
    ),
    function(
        "FILEF",
        "unit,op[,name]",
        Own,
        FunctionKind::File,
        "acts on an outside file; op: READ, WRITE, APPEND (open the file), CLOSE, REWIND, DELETE, END (1 when no line is left to read); 0, or 1 when READ or DELETE finds no such file; units 1 and 2; needs a folder granted",
    ),
    function(
        "SPAWNF",
        "'command'",
        Own,
        FunctionKind::Library(Library::Spawn, 1, 1),
        "has the embedding program run a command, where it allows that, and gives its status",
    ),
    function(
        "SPWNF",
        "'command'",
        Own,
        FunctionKind::Library(Library::Spawn, 1, 1),
        "the same as SPAWNF",
    ),
    function(
        "DATEF",
        "[n]",
        Own,
        FunctionKind::Library(Library::Date, 0, 1),
        "date as text, 2026-01-31, or its year (1), month (2) or day (3); needs a clock granted",
    ),
    function(
        "TIMEF",
        "[n]",
        Own,
        FunctionKind::Library(Library::Time, 0, 1),
        "time as text, 12:30:00, or its hour (1), minute (2) or second (3); needs a clock granted",
    ),
    function(
        "ICODEF",
        "word",
        Published,
        FunctionKind::WordCode,
        "integer code of a vocabulary word, of user words too",
    ),
    function(
        "POSTF",
        "n,…",
        Published,
        FunctionKind::Postf,
        "post interface; see the table of POSTF numbers",
    ),
    extension(
        "COUPLF",
        "word[,default]",
        FunctionKind::Couplet,
        "the number after a minor word in the current record",
    ),
    extension(
        "HASF",
        "word",
        FunctionKind::HasWord,
        "1 when the current record has that minor word, else 0",
    ),
    extension(
        "NEXTF",
        "word",
        FunctionKind::NextMotion,
        "X, Y, Z, I, J or K of the next motion, without consuming it; RAPID: 1 when it is a rapid move, else 0",
    ),
    extension(
        "PREVF",
        "word",
        FunctionKind::PreviousMotion,
        "X, Y, Z, I, J or K of the previous motion; RAPID: 1 when it was a rapid move, else 0",
    ),
    extension(
        "TOOLF",
        "word",
        FunctionKind::ToolData,
        "DIAMTR: diameter of the tool in use as the CL file gives it, by CUTTER, `$$-> CUTTER` or TLDATA before or behind the tool change; EMPTY where it gives none; NEXT: number of the tool of the next tool change, EMPTY after the last one; asks for a first pass, as PROGF",
    ),
    extension(
        "PROGF",
        "word",
        FunctionKind::Totals(TotalsList::Program),
        "a number of the whole program, from a first pass over the CL file: TOOLS entries of the tool list, OPERS operations, UNITS millimeters in a unit of the CL file (1 or 25.4), TIME all minutes, CUTTIM minutes at feed, RAPTIM minutes at rapid traverse, CUTLEN and RAPLEN length of the path at feed and at rapid traverse, XMIN XMAX YMIN YMAX ZMIN ZMAX extents of the path of the tool's tip; lengths in the unit of the CL file; EMPTY where there is none, and for times of motions whose time is not known",
    ),
    extension(
        "TLISTF",
        "n,word",
        FunctionKind::Totals(TotalsList::Tools),
        "a number of entry n of the tool list, 1 to PROGF(TOOLS), each tool once in the order of the first changes: NUMBER, DIAMTR its diameter, LENGTH the length that LOADTL gives, TIME … ZMAX as for PROGF of all that is done with it; EMPTY where there is none",
    ),
    extension(
        "OPERF",
        "n,word",
        FunctionKind::Totals(TotalsList::Operations),
        "a number of operation n, 1 to PROGF(OPERS): TOOL number of its tool, FEATNO its number in the CAM system, TIME … ZMAX as for PROGF of the operation; EMPTY where there is none",
    ),
    extension(
        "TEXT/PROG",
        "",
        FunctionKind::Library(Library::TotalsText(TotalsList::Program), 0, 0),
        "the text of PARTNO, wherever it stands in the CL file; the empty text where there is none",
    ),
    extension(
        "TEXT/TLIST",
        "n",
        FunctionKind::Library(Library::TotalsText(TotalsList::Tools), 1, 1),
        "what the CL file calls the tool of entry n of the tool list: TPRINT, or TOOL PATH of NX; the empty text where it has no name",
    ),
    extension(
        "TEXT/OPER",
        "n",
        FunctionKind::Library(Library::TotalsText(TotalsList::Operations), 1, 1),
        "the name of operation n: the first PPRINT before its first motion, OPERATION NAME of CATIA, or TOOL PATH of NX; the empty text where it has none",
    ),
    extension("LASTF", "letter", FunctionKind::LastWritten, "last value written for a letter"),
    extension(
        "COMF",
        "'name'",
        FunctionKind::NamedCommon,
        "the value in force of a setting, by its name",
    ),
    extension(
        "OPTIONF",
        "'name'",
        FunctionKind::PostOption,
        "the value of an option of the post: 1 or 0 for yes and no, a number, a length in the unit of the CL file, or the text of a choice",
    ),
    extension("SIZEF", "name", FunctionKind::Size, "number of elements of an array or data table"),
    extension(
        "DATA",
        "name,v1,v2,…",
        FunctionKind::Statement,
        "declares a table of numbers and texts that is read as name(i) and can't be changed",
    ),
    extension(
        "WRITE",
        "unit,v1,v2,…",
        FunctionKind::Statement,
        "writes texts and numbers, one after the other, as a line of a file open for writing",
    ),
    extension(
        "ERROR",
        "item,…",
        FunctionKind::Statement,
        "refuses the input: the run ends with E0325, whose message is the texts and numbers one after the other, and there is no NC program",
    ),
    extension(
        "WARN",
        "item,…",
        FunctionKind::Statement,
        "adds the warning W0326, whose message is the texts and numbers one after the other; the run goes on",
    ),
];

/// True for the word of a statement of our own.
pub(crate) fn is_statement(word: &str) -> bool {
    let is_it =
        |builtin: &Builtin| builtin.name == word && matches!(builtin.kind, FunctionKind::Statement);
    BUILTINS.iter().any(is_it)
}

/// The index of a built-in function or of a form, `TEXT/UP`, in [`BUILTINS`].
pub(crate) fn find(name: &str) -> Option<usize> {
    let is_it = |builtin: &Builtin| {
        builtin.name == name && !matches!(builtin.kind, FunctionKind::Statement)
    };
    BUILTINS.iter().position(is_it)
}

#[cfg(test)]
mod tests;
