//! Codes of the compiler and its lints (02xx) and of the machine (03xx).

fil_diag::codes! {
    /// What can be wrong with FIL before it runs.
    pub enum CompileCode {
        /// JUMPTO to a label that is not there.
        UnknownLabel = 201, Error, "unknown label",
            "A jump leads to a label of the same section, macro or global area; there is none of this name.",
            "Write `NAME)` before a statement of the same section.";
        /// Two statements with one label.
        LabelTwice = 202, Error, "duplicate label",
            "A jump to this label is ambiguous.",
            "Rename one of the labels.";
        /// Jump from outside into a DO.
        JumpIntoLoop = 203, Error, "jump into a loop",
            "A loop entered from outside has no last value and no step.",
            "Jump to the DO statement, or put the label outside of the loop.";
        /// `NAME(...)` that is neither function nor array.
        UnknownFunction = 204, Error, "unknown function or array",
            "The name is no built-in function, no array of RESERV and no function of the embedding program.",
            "Check its spelling, or reserve the array with RESERV/name,size.";
        /// Wrong number of arguments.
        WrongArguments = 205, Error, "wrong number of arguments",
            "The function, array, macro or POSTF number takes another number of arguments.",
            "`filpost explain NAME` shows the arguments.";
        /// POSTF number without a reading.
        UnknownPostf = 206, Error, "unknown POSTF number",
            "The meaning of this POSTF number is not published.",
            "If your manual documents the number, give it an operation in a file for --compat.";
        /// CALL of a macro that is not there.
        UnknownMacro = 207, Error, "unknown macro",
            "No FIL file defines a macro of this name.",
            "Check its spelling, or load the file that holds NAME=MACRO/….";
        /// A macro that calls itself.
        RecursiveMacro = 208, Error, "macro calls itself",
            "A macro has one set of parameters, so it can't call itself.",
            "Use a loop instead.";
        /// Macro, array or parameter defined twice.
        DefinedTwice = 209, Error, "name defined twice",
            "A macro, array or parameter of this name exists already.",
            "Rename one of the two.";
        /// Two sections with the same key.
        SectionTwice = 210, Error, "two sections for the same records",
            "Only one of the two could ever run.",
            "Put the statements of both into one section.";
        /// RESERV with a size that is no constant or too large.
        BadArraySize = 211, Error, "invalid array size",
            "The size must be a constant, at least 1 and within the limit.",
            "Write the size as a number.";
        /// An array without subscript, or a subscript on a plain name.
        ArrayMisuse = 212, Error, "array used as a plain name",
            "The name belongs to an array, a macro or a loop and is used as something else.",
            "Give the array a subscript, or use another name.";
        /// Form that the machine does not have yet.
        NotYet = 213, Error, "form not supported yet",
            "The meaning of this form is unknown, so filpost refuses it.",
            "`filpost explain WORD` shows the documented forms.";
        /// A FIL file that can't be included.
        IncludeFailed = 214, Error, "file can't be included",
            "INCLUD needs an existing file in the folder of the FIL file, and no file may include itself.",
            "Check the name and the folders the run may read.";
        /// Something too large for the bytecode.
        TooLarge = 215, Error, "program too large",
            "A section, macro or global area has too many operations or names, or is nested too deep.",
            "Split it into smaller sections or macros.";
        /// ICODEF or an extension without a word.
        WordExpected = 216, Error, "word expected",
            "This function takes a vocabulary word or a text as it is written, not a value.",
            "Write the word itself, as in ICODEF(MILL).";
        /// Assignment to one of the letters A to Z.
        LetterRedefined = 217, Warning, "address letter used as a variable",
            "A to Z are the addresses 1 to 26 in POSTN and REPEAT; from here on this one means something else.",
            "Use a name of two or more letters.";
        /// Our own POSTF reading is used.
        OwnReading = 218, Warning, "undocumented POSTF number",
            "No public source documents this number; filpost uses a meaning of its own choice.",
            "Compare it with your manual, and correct it in a file for --compat.";
        /// Extension of filpost under --strict.
        Extension = 219, Error, "function is a filpost extension",
            "The function is not part of FIL; --strict keeps scripts portable.",
            "Write it with POSTF, or run without --strict.";
        /// DATA with something else than constants.
        NotConstant = 222, Error, "value is not a constant",
            "DATA/ declares a table before anything runs, so it can hold only constant numbers and texts.",
            "Write DATA/name,v1,v2,… with constants, or reserve an array with RESERV and set it.";
        /// CIMFIL/OFF closes a block that sends the record on.
        OpenAroundRecord = 223, Doubt, "block still open after its record",
            "The section processes its record inside a block without an end. Where the block ends decides which records are lost.",
            "Add the missing ENDIF or ENDCAS where the block ends.";
        /// A variable where a word of the same name can be meant.
        NameOrWord = 224, Doubt, "variable replaces a vocabulary word or an address",
            "A statement sets this name, so its value would replace the vocabulary word or the address letter that the post word takes here.",
            "Rename the variable: its name must not be a vocabulary word or an address letter.";
        /// A word that is read as a variable.
        WordAsValue = 225, Doubt, "vocabulary word read as a variable",
            "Nothing sets this name, so it is EMPTY and never equals a word of a record.",
            "Write ICODEF(word) for the code of a word.";
        /// A post word that is most likely another statement.
        OtherStatement = 226, Doubt, "not a FIL statement",
            "The word is misspelled, belongs to another language, or has no effect in filpost; as a record it would only go to the post.",
            "Correct the spelling; docs/language.md lists the statements of FIL.";
        /// A macro that only the vendor's post calls.
        ReservedMacro = 227, Doubt, "macro is never called by the post",
            "A macro of this name edits the output of the post, but nothing calls it: no machine setting enables it, or filpost does not support it.",
            "Enable it in machine.toml, move its work into sections, or remove the macro.";
        /// A section whose key fits no record.
        NeverMatches = 228, Doubt, "section matches no record",
            "No record has these words or numbers in this order, so the section would never run.",
            "Write a major word and the minor words right after it, or a type and subtype of CLDATA.";
        /// A name of an added function that can't be taken.
        FunctionName = 229, Error, "added function has a reserved name",
            "A function of the embedding program can't have the name of a built-in function, statement, letter or CL word.",
            "Rename the function, for example with the name of your program as a prefix.";
        /// A name in a list of texts that would be written as it stands.
        NameInText = 247, Doubt, "variable without a value in a text",
            "A list of texts joins values, and nothing sets this name.",
            "Check its spelling, or put it between apostrophes.";
        /// A letter where its number is hardly meant.
        LetterAsValue = 251, Doubt, "address letter used as a value",
            "A to Z are the numbers 1 to 26, the addresses of POSTN and REPEAT, and are rarely intended as a value.",
            "Give the value a name of two letters or more. LASTF(X) is the last X written, POSTF(7,6) the X of a point.";
    }
}

fil_diag::codes! {
    /// What a check finds in FIL that would run. A run looks for misspelt words that
    /// decide what runs (W0242, W0244, W0246) as well, all others only a check.
    pub enum LintCode {
        /// A section with a way that sends nothing.
        Swallows = 220, Warning, "section can drop its record",
            "A section takes its record. This path has neither a post word nor POSTF(13), so the record has no effect.",
            "Call POSTF(13) where the post should process the record.";
        /// A name that no statement sets.
        NeverAssigned = 221, Warning, "variable is never set",
            "No statement of the loaded files gives this name a value, so it is EMPTY wherever it is read.",
            "Check its spelling; a vocabulary word is compared as ICODEF(word).";
        /// POSTF(7,n) behind the couplets of a record.
        ShiftingWord = 230, Warning, "position of this word in the record can shift",
            "The record has optional couplets; with one more or less before this word, POSTF(7,n) reads another word.",
            "Search the couplet by its word: COUPLF(word), or POSTF(9,4,ICODEF(word)) and the word after it.";
        /// A name that is read before it is set on some way.
        ReadEarly = 231, Warning, "variable read before it is set",
            "On some path to this statement the name has no value yet, so it is EMPTY (999999).",
            "Give it a first value in the global area.";
        /// A statement no way leads to.
        Unreachable = 232, Warning, "statement never runs",
            "Nothing reaches this statement: there is a jump or an endless loop before it.",
            "Remove it, or add a label and a jump to it.";
        /// Two WHEN parts for one value.
        SameWhen = 233, Warning, "WHEN repeats an earlier value",
            "An earlier WHEN of the same CASE has this value, so this branch does not run for it.",
            "Remove the value from one of the two.";
        /// A label no jump names.
        UnusedLabel = 234, Warning, "unused label",
            "No jump and no DO names this label.",
            "Remove it, or check the spelling of the jump to it.";
        /// A jump into a part of an IF or CASE.
        JumpIntoBlock = 235, Warning, "jump into a block",
            "The label is inside an IF or CASE and the jump is outside, so the condition is skipped.",
            "Put the label before or after the block.";
        /// A common location nothing is known of.
        UnnamedCommon = 236, Warning, "undocumented common location",
            "This location is not documented, so the post neither sets nor uses it.",
            "Check type and number: 1 is INTCOM, 2 RELCOM, 3 DBLCOM.";
        /// .EQ. or .NE. of computed reals.
        RealsCompared = 237, Warning, "computed reals compared for equality",
            "The value comes from arithmetic on reals; rounding can make two values differ that are equal on paper.",
            "Compare the difference with a tolerance: ABSF(AA-BB).LT.0.0001.";
        /// A loop without a way out.
        EndlessLoop = 238, Warning, "endless loop",
            "The loop has no exit; the run stops at the limit of iterations.",
            "Add a jump out of the loop, or a step other than 0.";
        /// POSTN or REPEAT of a letter the machine lacks.
        NoAddress = 239, Warning, "the machine does not write this letter",
            "POSTN or REPEAT uses an address that this machine does not write.",
            "Give the address a position in machine.toml, or use another letter.";
        /// A macro nobody calls.
        UnusedMacro = 240, Warning, "macro is never called",
            "No CALL of the loaded files names this macro.",
            "Remove it, or check the spelling of the CALL.";
        /// An array nobody uses.
        UnusedArray = 241, Warning, "array is not used",
            "No statement reads or sets an element of this array.",
            "Remove its RESERV, or check the spelling where it should be used.";
        /// A word near a known one.
        MisspeltWord = 242, Warning, "possibly misspelled word",
            "The word is unknown, and similar to a known one.",
            "Correct the word; if it is one of your own, allow it with a comment.";
        /// A variable with the name of a word.
        NameIsWord = 243, Warning, "variable has the name of a vocabulary word",
            "A post word that should take this word takes the value of the variable.",
            "Rename the variable: its name must not be a vocabulary word.";
        /// A section for a word that opens no statement.
        SectionNeverRuns = 244, Warning, "section may never run",
            "No known CL file has a statement that begins with this word.",
            "Check its spelling; if it is a word of your own, allow it with a comment.";
        /// A post word that the post does not carry out.
        NoHandler = 245, Warning, "the post does not carry out this word",
            "The statement makes a record that the post has no handler for.",
            "Use words that the post knows, or POSTN/OUT.";
        /// ICODEF of a word in no vocabulary.
        UnknownWord = 246, Warning, "unknown vocabulary word",
            "Only CL files with this exact word have its code.",
            "Check its spelling; if it is a word of your own, allow it with a comment.";
        /// ELSE right behind a one-line IF.
        LooseElse = 248, Warning, "ELSE after a one-line IF",
            "A one-line IF has no ELSE, so this one belongs to the IF around it.",
            "If the inner IF is meant, write IF(condition)THEN … ELSE … ENDIF; otherwise write CONTIN before the ELSE.";
        /// A letter in an expression.
        LetterInExpression = 249, Warning, "address letter in an expression",
            "No statement sets this letter, so it is the number of its address, 1 to 26.",
            "Give the value a name of two letters or more.";
        /// A WHEN without statements before another one.
        EmptyWhen = 250, Warning, "WHEN without statements",
            "A branch of a CASE does not continue into the next one, so nothing runs for these values.",
            "Write WHEN/a,b for a branch with several values, or CONTIN if nothing should run.";
        /// A text without quotes that has a call of a function in it.
        CallInText = 252, Warning, "function call in a text without quotes",
            "A text without quotes is written as it stands: the function is not called.",
            "Write the text in quotes, and the function after a comma: PPRINT/'TOOL ',POSTF(7,4).";
    }
}

fil_diag::codes! {
    /// What can go wrong while FIL runs.
    pub enum RunCode {
        /// SQRTF(-1), 1/0 and so on.
        Domain = 301, Error, "calculation has no finite result",
            "The operation has no finite result for these values.",
            "Test the values before this statement: IF(BB.NE.0)THEN.";
        /// A text where a number is needed, or the other way round.
        WrongType = 302, Error, "text and number mixed",
            "This operation needs the other kind of value.",
            "TEXT/CONVF writes a number as a text, SCALF reads a number from a text.";
        /// Subscript outside of its array.
        Subscript = 303, Error, "subscript out of range",
            "Subscripts are whole numbers from 1 to the size given in RESERV.",
            "Check the subscript or reserve a larger array.";
        /// Fuel is used up.
        OutOfFuel = 304, Error, "section runs too long",
            "The limit of loop iterations, calls and record reads is reached, probably by an endless loop.",
            "Check the condition that ends the loop, or raise the limit.";
        /// Calls too deep.
        CallDepth = 305, Error, "calls nested too deep",
            "The limit of macro calls within macro calls is reached.",
            "Reduce the nesting, or raise the limit.";
        /// Too much text.
        TextLimit = 306, Error, "too much text",
            "The limit of text in memory is reached.",
            "Make shorter texts, or raise the limit.";
        /// A DO step of 0.
        ZeroStep = 307, Error, "DO loop with a step of 0",
            "A loop with step 0 never ends.",
            "Give a step other than 0.";
        /// A condition that is neither 0 nor 1.
        NotLogical = 308, Error, "condition is not logical",
            "A condition is a comparison, or a value that is 1 for true and 0 for false.",
            "Compare the value: IF(X.NE.0)THEN.";
        /// A name that was never set.
        NeverSet = 309, Warning, "variable was never set",
            "The name has no value yet and is read as EMPTY (999999).",
            "Set it first, for example in the global area.";
        /// POSTF(7,n) past the end.
        PastEnd = 310, Warning, "word past the end of the record",
            "The record is shorter; the word is read as EMPTY (999999).",
            "Test POSTF(5), or look for the couplet with POSTF(9,…).";
        /// POSTF(8,...) and so on with a bad word number.
        BadWordNumber = 311, Error, "bad word number",
            "Words count from 1; words that can be changed count from 4 to the length of the record.",
            "Check the word number against `filpost cl --words`.";
        /// Reading on after the end.
        PastLastRecord = 312, Error, "read past the last record",
            "The section reads on although the CL file is at its end.",
            "Test the status of POSTF(14): it is 1 at the end.";
        /// POSTF of a record where there is none.
        NoRecord = 313, Error, "no current record",
            "The global area runs before the first record is read.",
            "Move the statement into a section.";
        /// POSTF(21) without POSTF(20).
        NothingSaved = 314, Error, "no saved record",
            "POSTF(21) restores what POSTF(20) saved; nothing was saved.",
            "Call POSTF(20) first.";
        /// Unknown number, arity or argument of POSTF at run time.
        BadPostf = 315, Error, "bad POSTF call",
            "The number or an argument of POSTF has no known meaning.",
            "`filpost explain POSTF` lists the numbers; `filpost explain POSTF(7)` shows one.";
        /// A word an extension looked for is not there.
        Missing = 316, Error, "nothing found and no default given",
            "The function finds nothing, and the call has no default.",
            "Give a default, or test with HASF first.";
        /// A function of the embedding program failed.
        HostFunction = 317, Error, "function failed",
            "A function of the embedding program refused the call.",
            "Read the function's message.";
        /// A position the text does not have.
        TextPosition = 318, Error, "position outside the text",
            "Characters of a text count from 1 to its length; a number of characters is whole and not negative, and an empty text can't be looked for.",
            "Test LNTHF and INDXF before this statement.";
        /// SCALF of something else than a number.
        NotANumber = 319, Error, "text is not a number",
            "A number has only digits, a sign, a decimal point, an exponent, and blanks around them.",
            "Take the part with the digits first: TEXT/PART.";
        /// A number TEXT/CONVI or TEXT/CONVF can't write.
        Conversion = 320, Error, "number does not fit the text format",
            "The number is EMPTY, not whole, or has too many digits for its width or for an exact value. It is not truncated.",
            "Give a larger width, or round the number first.";
        /// Files without a grant.
        FilesNotGranted = 321, Error, "file access is not granted",
            "A script reads and writes files only in folders that the user has granted.",
            "Grant a folder: --grant read=DIR or --grant write=DIR; in a program Builder::grant_read and grant_write.";
        /// The clock without a grant.
        ClockNotGranted = 322, Error, "clock access is not granted",
            "The same input must give the same program, so a script gets a date and time only if the user allows it.",
            "Set a time: --set-clock 2026-01-31T12:00:00; or allow the clock: --clock system; in a program Builder::clock.";
        /// SPAWNF without a grant.
        SpawnNotGranted = 323, Error, "running commands is not granted",
            "A script can't run other programs; the filpost command never allows it.",
            "Do the work before or after filpost; a program that embeds it may allow commands with Builder::allow_spawn.";
        /// FILEF, TEXT/READ or WRITE/ on a unit that is not open for that.
        FileUse = 324, Error, "wrong use of a file unit",
            "Units are 1 and 2. Open a unit, read or write it as it was opened, and close it before you open it again.",
            "`filpost explain FILEF` shows the calls; FILEF(unit,END) is 1 when no line is left.";
        /// ERROR/
        Refused = 325, Error, "the script refuses this input",
            "The script checked its input and gives the reason in its own words.",
            "Correct what the message names.";
        /// WARN/
        Warned = 326, Warning, "the script warns",
            "The script writes the NC program, but its author asks you to check this first.",
            "Check what the message names.";
    }
}

#[cfg(test)]
mod tests {
    use super::{CompileCode, LintCode, RunCode};

    #[test]
    fn numbers_stay_in_their_range_and_are_unique() {
        let tables =
            [(CompileCode::ALL, 201..300), (LintCode::ALL, 220..300), (RunCode::ALL, 301..400)];
        for (codes, range) in tables {
            for pair in codes.windows(2) {
                assert!(pair[0].number < pair[1].number);
            }
            assert!(codes.iter().all(|code| range.contains(&code.number)));
        }
    }
}
