//! Codes of this crate, 0101 and up.

fil_diag::codes! {
    /// What can be wrong with a FIL text.
    pub enum SyntaxCode {
        /// A statement that does not follow the grammar.
        Unexpected = 101, Error, "statement not understood",
            "The statement does not have any of the forms FIL knows.",
            "`filpost explain WORD` shows the forms of a statement.";
        /// A character without use.
        BadCharacter = 102, Error, "character without meaning",
            "Outside comments and texts a FIL file has only Latin letters, digits and a few signs.",
            "Look for a letter of another alphabet that looks like a Latin one, or put the text between apostrophes.";
        /// A text that does not end.
        UnclosedText = 103, Error, "closing apostrophe is missing",
            "A text ends with an apostrophe on the line where it begins.",
            "Add the closing apostrophe; an apostrophe inside a text is written twice.";
        /// `.XX.` that is no operator.
        UnknownOperator = 104, Error, "unknown operator",
            "Operators between points are .EQ. .NE. .LT. .LE. .GT. .GE. .AND. .OR. and .NOT.",
            "Write .EQ. for ==, .LE. for <=, .AND. for &&.";
        /// A number out of range.
        NumberTooLarge = 105, Error, "number too large",
            "A number must be less than about 1.8E308.",
            "Write a smaller number.";
        /// Brackets, operations or blocks too deep.
        TooDeep = 106, Error, "nested too deep",
            "The nesting of brackets, operations and blocks is limited, to protect memory.",
            "Split the expression with a variable, or move the inner blocks to a macro.";
        /// A line or statement too long.
        TooLong = 107, Error, "line or statement too long",
            "A line is limited to 16384 bytes and a statement with its continuations to 10000 words and signs.",
            "Check that this is a FIL file; break the line with $ or split the statement.";
        /// A file too large.
        FileTooLarge = 108, Error, "file too large",
            "A FIL file is limited to 64 MiB.",
            "Check that this is a FIL file.";
        /// Reading was given up.
        TooManyErrors = 109, Error, "too many errors",
            "Reading stops after 100 messages; the rest of the file was not checked.",
            "Correct the first errors; they may cause the others.";
        /// A section that does not say which records it takes.
        WrongSection = 110, Error, "section not understood",
            "A section begins with CIMFIL/ON and a major word with minor words, or a record type with its subtype, and ends with CIMFIL/OFF.",
            "Write CIMFIL/ON,CYCLE or CIMFIL/ON,5000,5.";
        /// Arguments of a statement that are not what it takes.
        WrongArguments = 111, Error, "wrong arguments",
            "The statement takes other arguments than these.",
            "`filpost explain WORD` shows the arguments of a statement.";
        /// A block without its end.
        UnclosedBlock = 112, Error, "block is not closed",
            "IF ends with ENDIF, CASE with ENDCAS, DO with the statement that bears its label.",
            "Add the missing ENDIF, ENDCAS or label.";
        /// The end or a part of a block that is not open.
        StrayWord = 113, Error, "no open block for this word",
            "The word belongs to a block, section or macro, but none is open here.",
            "Add the missing opening line or remove this one.";
        /// A section or macro without its end.
        UnclosedArea = 114, Error, "section or macro is not closed",
            "A section ends with CIMFIL/OFF, a macro with TERMAC.",
            "Add CIMFIL/OFF or TERMAC.";
        /// A section or macro inside another.
        NestedArea = 115, Error, "section or macro inside another",
            "Sections and macros can't be nested.",
            "Close the first one before the second.";
        /// A statement of a CASE before its first WHEN.
        BeforeWhen = 116, Error, "statement before the first WHEN",
            "A statement between CASE and the first WHEN would never run.",
            "Move the statement before CASE or into a WHEN branch.";
        /// A part after the one that takes all that is left.
        AfterLast = 117, Error, "branch after ELSE or WHEN/OTHER",
            "ELSE and WHEN/OTHER take all other cases; no branch can follow them.",
            "Move this branch before ELSE or WHEN/OTHER.";
        /// A DO whose label is in a wrong place.
        WrongDoEnd = 118, Error, "DO loop ends in the wrong place",
            "A DO ends at a simple statement with its label, in the same block, and two open DO can't share a label.",
            "End each DO with a labelled CONTIN of its own.";
        /// A label on a word that cannot have one.
        WrongLabel = 119, Error, "label is not allowed here",
            "A jump to this line would enter the middle of a block, or leave its section or macro.",
            "Put the label on the next statement.";
        /// A code page nobody knows.
        UnknownEncoding = 120, Error, "unknown encoding",
            "No text encoding has this name.",
            "Use utf-8, windows-1250 to windows-1258, koi8-r, shift_jis, gbk, big5, euc-kr, a console page such as cp437, cp850, cp852 or cp866, or leave the encoding out.";
        /// Bytes that are not text in the encoding asked for.
        WrongEncoding = 121, Error, "text is not in this encoding",
            "Some bytes are invalid in this encoding.",
            "Name another encoding, or leave it out and filpost finds it.";
        /// `;` within free text, and a statement behind it.
        StatementInText = 122, Doubt, "statement inside a text",
            "The text after this word ends at the end of the line, so what looks like a statement after the semicolon is text and would not run.",
            "Put the statement on a line of its own, or the text between apostrophes.";
        /// Sections after FINI.
        SectionAfterFini = 123, Doubt, "section after FINI",
            "FINI ends the file, so the section is not read and its records would go to the post unchanged.",
            "Move FINI to the end of the file, or remove what follows it.";
        /// `-A**B`
        SignBeforePower = 124, Doubt, "sign before a power",
            "In FIL a sign binds tighter than **, unlike in most languages, so -A**2 is the square of A.",
            "Write (-A)**B or -(A**B).";
        /// CIMFIL/OFF closes an open block.
        ClosedBySection = 150, Warning, "block closed by CIMFIL/OFF",
            "The block was still open at the end of its section and is taken to end there.",
            "Add the missing ENDIF or ENDCAS.";
        /// SIMFIL for CIMFIL.
        Misspelled = 151, Warning, "SIMFIL read as CIMFIL",
            "SIMFIL is a known misprint of CIMFIL.",
            "Write CIMFIL.";
        /// No FINI.
        MissingFini = 152, Warning, "FINI is missing",
            "A FIL file ends with FINI; without it the file may have been cut off.",
            "Add FINI as the last statement.";
        /// Text after FINI.
        AfterFini = 153, Warning, "text after FINI",
            "FINI ends the file; what follows is not read.",
            "Remove what follows, or move FINI to the end.";
        /// `;` within free text.
        SemicolonInText = 155, Warning, "semicolon is part of the text",
            "The text after this word ends at the end of the line, so the semicolon does not end the statement.",
            "Put a statement that follows on a line of its own, or the text between apostrophes.";
    }
}
