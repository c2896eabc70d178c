//! The table of FIL's statements, for `explain` and the reference.

use crate::postf::Grade;

/// A statement of FIL.
#[derive(Debug, PartialEq, Eq)]
pub struct Statement {
    /// The word it is known by.
    pub word: &'static str,
    /// How it is written, one form a line.
    pub form: &'static str,
    /// What it does.
    pub doc: &'static str,
    /// How sure its form and meaning are.
    pub grade: Grade,
    /// A small file that uses it.
    pub example: &'static str,
}

/// The words statements begin with; a post word that differs little from one of them
/// is most likely a misspelt statement.
pub(crate) const WORDS: &[&str] = &[
    "CALL", "CASE", "CIMFIL", "CONTIN", "DATA", "ELSE", "ELSEIF", "ENDCAS", "ENDIF", "ERROR",
    "FINI", "INCLUD", "JUMPTO", "POSTN", "PRINT", "REDEF", "REPEAT", "RESERV", "TERMAC", "WHEN",
    "WRITE",
];

/// Statements that filpost does not carry out, or that are written otherwise, with what
/// to write. Sent to the post as records they would do nothing.
pub(crate) const ELSEWHERE: &[(&str, &str)] = &[
    ("CONTINUE", "write CONTIN"),
    ("ELIF", "write ELSEIF(condition)THEN"),
    ("ENDCASE", "write ENDCAS"),
    ("ENDDO", "a DO ends with the statement that bears its label: label) CONTIN"),
    ("ENDMAC", "write TERMAC"),
    ("ENDWHILE", "loops are DO/label,… or JUMPTO/label"),
    ("EXIT", "write JUMPTO/label"),
    ("JUMP", "write JUMPTO/label"),
    ("LOOPND", "loops are DO/label,… or JUMPTO/label"),
    ("LOOPST", "loops are DO/label,… or JUMPTO/label"),
    ("OTHER", "the part of a CASE for all that is left is WHEN/OTHER"),
    ("OTHERWISE", "the part of a CASE for all that is left is WHEN/OTHER"),
    ("READ", "FILEF opens a file, name=TEXT/READ,unit reads a line of it"),
    ("RETURN", "write JUMPTO/label to a label before CIMFIL/OFF or TERMAC"),
    ("SYN", "filpost does not carry out SYN; write the word itself"),
    ("THEN", "put THEN after the condition, on the same line: IF(condition)THEN"),
];

/// All statements but post words, which have a table of their own in the post.
pub const STATEMENTS: &[Statement] = &[
    Statement {
        word: "CIMFIL",
        form: "CIMFIL/ON,major[,minor…]\nCIMFIL/ON,type[,subtype]\nCIMFIL/ON,ALL\nCIMFIL/OFF",
        doc: "A section: it is run for each CL record with that major word and these minor \
              words right after it, or of that CLDATA type. The section takes the record; the \
              post acts on it only through POSTF(13). More minor words beat fewer. ALL takes \
              what no other section takes.",
        grade: Grade::Published,
        example: "CIMFIL/ON,LOADTL\nOPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    },
    Statement {
        word: "IF",
        form: "IF(condition)THEN … ELSEIF(condition)THEN … ELSE … ENDIF\nIF(condition)statement\n\
               IF(value)l1,l2,l3",
        doc: "Runs the first arm whose condition holds; or one statement; or jumps to l1, l2 or \
              l3 when the value is negative, zero or positive.",
        grade: Grade::Published,
        example: "AA=3\nIF(AA.GT.2)THEN\nBB=1\nELSE\nBB=2\nENDIF\nIF(BB.EQ.1)AA=0\nFINI\n",
    },
    Statement {
        word: "JUMPTO",
        form: "JUMPTO/label\nlabel) statement",
        doc: "Jumps to the statement with that label, in the same section, macro or global area.",
        grade: Grade::Inferred,
        example: "NN=0\nLA) NN=NN+1\nIF(NN.LT.5)JUMPTO/LA\nFINI\n",
    },
    Statement {
        word: "DO",
        form: "DO/label,variable=from,to[,step]\nlabel) CONTIN",
        doc: "Runs the statements down to the label for each value from `from` to `to`, both \
              included. It tests before the first pass; afterwards the variable holds the first \
              value past the end.",
        grade: Grade::Published,
        example: "SUM=0\nDO/LA,II=1,10,2\nSUM=SUM+II\nLA) CONTIN\nFINI\n",
    },
    Statement {
        word: "CONTIN",
        form: "label) CONTIN",
        doc: "Does nothing; it carries a label.",
        grade: Grade::Published,
        example: "DO/LA,II=1,3\nXX=II\nLA) CONTIN\nFINI\n",
    },
    Statement {
        word: "CASE",
        form: "CASE/value\nWHEN/value[,value…]\nWHEN/OTHER\nENDCAS",
        doc: "Runs the first WHEN part that has the value, or OTHER; no part runs on into the \
              next. Numbers and texts can be compared.",
        grade: Grade::Published,
        example: "CIMFIL/ON,CYCLE\nCASE/POSTF(7,4)\nWHEN/ICODEF(TAP),ICODEF(REAM)\nOPSTOP\n\
                  WHEN/OTHER\nENDCAS\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    },
    Statement {
        word: "MACRO",
        form: "name=MACRO/p,q=default … TERMAC\nCALL/name,value,q=value",
        doc: "Statements under a name, with parameters of their own. Arguments go by position or \
              by name; a macro can call others, but not itself.",
        grade: Grade::Inferred,
        example: "SAFE=MACRO/ZZ,STP=0\nIF(STP.EQ.1)OPSTOP\nPOSTN/OUT,G,0,Z,ZZ\nTERMAC\n\
                  CIMFIL/ON,LOADTL\nCALL/SAFE,100,STP=1\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    },
    Statement {
        word: "CALL",
        form: "CALL/name[,value…][,parameter=value…]",
        doc: "Runs a macro; see MACRO.",
        grade: Grade::Inferred,
        example: "HELLO=MACRO/TT='HELLO'\nPPRINT/TT\nTERMAC\nCIMFIL/ON,PARTNO\nDMY=POSTF(13)\n\
                  CALL/HELLO\nCIMFIL/OFF\nFINI\n",
    },
    Statement {
        word: "RESERV",
        form: "RESERV/name,n[,name,n…]",
        doc: "An array with the elements name(1) to name(n), of numbers or texts. A subscript \
              outside of it is an error.",
        grade: Grade::Inferred,
        example: "RESERV/DIA,20\nDIA(3)=12.5\nHALF=DIA(3)/2\nFINI\n",
    },
    Statement {
        word: "TEXT",
        form: "name=TEXT/item[,item…]\nname=TEXT/FORM,arguments",
        doc: "Joins texts and numbers to a text, or takes one of the forms of TEXT/.",
        grade: Grade::Inferred,
        example: "NN=7\nTT=TEXT/'TOOL ',NN\nUU=TEXT/UP,TT\nFINI\n",
    },
    Statement {
        word: "INCLUD",
        form: "INCLUD/file",
        doc: "Reads another file at this place. Its name counts from the folder of this file and \
              must not lead out of the folders of the FIL files. A file that includes itself is \
              refused.",
        grade: Grade::Inferred,
        example: "",
    },
    Statement {
        word: "REPLAC",
        form: "REPLAC/'old','new'[,'old','new'…]\nREPLAC/OFF",
        doc: "Has texts replaced in each line of the tape that comes, comments too: words are \
              found whole, M6 not in M60. OFF ends it. A text that stood in no line is warned of.",
        grade: Grade::Own,
        example: "REPLAC/'M8','M50','G54','G55'\nCIMFIL/ON,END\nREPLAC/OFF\nDMY=POSTF(13)\n\
                  CIMFIL/OFF\nFINI\n",
    },
    Statement {
        word: "PRINT",
        form: "PRINT/ON\nPRINT/OFF[,IN]",
        doc: "Switches the input listing of the vendor's post; accepted without effect.",
        grade: Grade::Published,
        example: "PRINT/OFF,IN\nFINI\n",
    },
    Statement {
        word: "REDEF",
        form: "REDEF/ON\nREDEF/OFF",
        doc: "Permits names to be set again; accepted without effect, names can always be set again.",
        grade: Grade::Published,
        example: "REDEF/ON\nFINI\n",
    },
    Statement {
        word: "FINI",
        form: "FINI",
        doc: "The last statement of a file. Without it there is a warning, after it nothing is read.",
        grade: Grade::Published,
        example: "AA=1\nFINI\n",
    },
];
