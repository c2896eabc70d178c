//! Codes of NC programs that are read back (09xx).

fil_diag::codes! {
    /// Everything that reading an NC program refuses.
    pub enum NcCode {
        /// A character that begins no word.
        NotAWord = 901, Error, "not a word of an NC program",
            "A block is made of letters, each with a number; filpost does not guess anything else.",
            "Check that the file is an NC program of this control, and complete.";
        /// A letter whose number can't be read.
        BadNumber = 902, Error, "letter without a readable number",
            "The value of this word can't be read reliably.",
            "Check the number after the letter; a cut-off file often ends in one.";
        /// A comment that never ends.
        OpenComment = 903, Error, "comment is not closed",
            "The text after an open bracket may be a comment or a move.",
            "Close the comment; a cut-off file often ends in one.";
        /// A function that the machine's settings do not have.
        ForeignCode = 904, Error, "the machine does not have this function",
            "The effect of the function is unknown, and so is the move after it.",
            "Check that the program was written for this machine. If your machine has the function, and it moves nothing, list it: verify.allowed_functions = [\"G187\"] in machine.toml; [effects] says what others do.";
        /// A word that nothing in its block takes.
        NoMeaning = 905, Error, "word without meaning in its block",
            "No function of the block takes this word; a control would refuse it or use it in its own way.",
            "Look for a missing function or a wrong letter.";
        /// Two words where only one can hold.
        Twice = 906, Error, "two words of one kind in a block",
            "Only one of the two can apply, and controls differ in which.",
            "Keep one of them, or write two blocks.";
        /// Axis words while no motion function is in force.
        NoMotion = 907, Error, "axis words without a motion function",
            "Without an active motion function the move may be rapid, feed or an arc.",
            "Write G0, G1, G2 or G3 in this block; after a canned cycle it must be restated.";
        /// A motion at feed before any feed.
        NoFeed = 908, Error, "feed move without an F word",
            "The control would stop, or run at the last feed of another program.",
            "Write an F word; a new feed mode needs a new one.";
        /// An arc without center and radius, or without a known start.
        NoCenter = 909, Error, "arc without a center",
            "The path of an arc needs its start and a center or radius.",
            "Write I, J, K or the radius, and both axes of the plane before the first arc.";
        /// Start and end at different radii.
        ArcRadii = 910, Error, "arc start and end have different radii",
            "No circle about this center passes through both points: a word of the block is wrong or missing.",
            "Check the plane, the end point and the center.";
        /// A function without a word it needs.
        MissingWord = 911, Error, "function lacks a word",
            "The control would stop, or use the value of an earlier block.",
            "Write the word in the block of the function.";
        /// No end of program.
        CutOff = 912, Error, "the program has no end",
            "A program without an end code (M2, M30, M99) may have been cut off.",
            "Check that the file is complete.";
        /// Blocks after the end.
        AfterEnd = 913, Error, "blocks after the end of the program",
            "The control never reaches them; the file may hold two programs.",
            "Remove the blocks, or give a subprogram its number.";
        /// A call that leads nowhere, or for ever.
        BadCall = 914, Error, "subprogram call can't be followed",
            "The moves of the subprogram are part of the path.",
            "Check the number, and that the subprogram is in this file and ends with M99.";
        /// The text of a program changed between two readings of it.
        Changed = 915, Error, "program changed while it was read",
            "filpost does not keep a long program in memory and reads differing blocks again, so it would compare two states of the file.",
            "Wait until the program is written, and compare again.";
        /// A line that no control reads.
        LineTooLong = 916, Error, "line of the program is too long",
            "No control reads a block of more than a million bytes: this is not an NC program, or its line ends are missing.",
            "Give the NC program with line ends LF, or CR and LF.";
        /// A CL file whose unit nobody says.
        NoUnit = 940, Error, "unit of the CL file is not known",
            "Lengths have no meaning until the CL file, the machine or the user sets mm or inch.",
            "Put UNITS / MM or UNITS / INCHES first, give --units, or set units.mode of the machine.";
        /// A program that has next to nothing in common with the CL file.
        AnotherPart = 941, Error, "program belongs to another part",
            "The program has fewer than one in ten moves of the CL file; a list of all differences would be useless.",
            "Give the program made from this CL file, and its machine.";
    }
}
