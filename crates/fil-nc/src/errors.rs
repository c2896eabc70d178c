//! Codes of NC programs that are read back (09xx).

fil_diag::codes! {
    /// Everything that reading an NC program refuses.
    pub enum NcCode {
        /// A character that begins no word.
        NotAWord = 901, Error, "not a word of an NC program",
            "A block is made of letters, each with a number; what is not one is not guessed.",
            "Check that the file is an NC program of this control, and not cut off.";
        /// A letter whose number can't be read.
        BadNumber = 902, Error, "a letter without a readable number",
            "The value of this word can't be read for sure.",
            "Check the number after the letter; a file that was cut off often ends in one.";
        /// A comment that never ends.
        OpenComment = 903, Error, "comment not closed",
            "What follows an open bracket may be comment or motion.",
            "Close the comment; a file that was cut off often ends in one.";
        /// A function that the machine's settings do not have.
        ForeignCode = 904, Error, "a function that this machine does not have",
            "What the function would do is not known, so the motion after it is not known either.",
            "Check that the program was written for this machine.";
        /// A word that nothing in its block takes.
        NoMeaning = 905, Error, "a word without meaning in its block",
            "No function of the block takes this word; a control would refuse it or use it in its own way.",
            "Look for a function that was lost, or a wrong letter.";
        /// Two words where only one can hold.
        Twice = 906, Error, "two words of one kind in a block",
            "Only one of the two can hold, and controls differ in which.",
            "Keep one of them, or write two blocks.";
        /// Axis words while no motion function is in force.
        NoMotion = 907, Error, "axis words without a motion function",
            "Without a function in force it is not known whether this is rapid, feed or an arc.",
            "Write the motion function in this block; after a canned cycle it must be said again.";
        /// A motion at feed before any feed.
        NoFeed = 908, Error, "a motion at feed without a feed",
            "The control would stop, or run at the last feed of another program.",
            "Write an F word; a change of the feed mode asks for a new one.";
        /// An arc without center and radius, or without a known start.
        NoCenter = 909, Error, "an arc without a center",
            "Center or radius, and the start of the arc, are needed to know its path.",
            "Write I, J, K or the radius, and both axes of the plane before the first arc.";
        /// Start and end at different radii.
        ArcRadii = 910, Error, "an arc whose start and end have different radii",
            "There is no circle through both about this center; a word of the block is wrong or lost.",
            "Check the plane, the end point and the center.";
        /// A function without a word it needs.
        MissingWord = 911, Error, "a function without a word that it needs",
            "The control would stop, or use the value of an earlier block.",
            "Write the word in the block of the function.";
        /// No end of program.
        CutOff = 912, Error, "the program has no end",
            "A program that stops without its end code was perhaps cut off on its way.",
            "Check that the whole file is there.";
        /// Blocks after the end.
        AfterEnd = 913, Error, "blocks after the end of the program",
            "The control never gets there; perhaps two programs are in one file.",
            "Take the blocks away, or give a subprogram its number.";
        /// A call that leads nowhere, or for ever.
        BadCall = 914, Error, "a subprogram call that can't be followed",
            "The motions of the subprogram are part of the path.",
            "Check the number, and that the subprogram is in this file and ends with M99.";
        /// The text of a program changed between two readings of it.
        Changed = 915, Error, "the program changed while it was read",
            "A long program is not kept in memory, its blocks are read again where they differ; what is compared would be of two states of the file.",
            "Wait until the program is written, and compare again.";
        /// A line that no control reads.
        LineTooLong = 916, Error, "a line of the program is too long",
            "A line is kept in memory as a whole, and no control reads a block of more than a million bytes: this is no NC program, or its line ends got lost.",
            "Give the NC program; line ends that got lost on the way to the control are LF, or CR and LF.";
        /// A CL file whose unit nobody says.
        NoUnit = 940, Error, "the unit of the CL file is not known",
            "Lengths mean nothing before the CL file, the machine or the user says mm or inch.",
            "Put UNITS / MM or UNITS / INCHES first, give --units, or set units.mode of the machine.";
        /// A program that has next to nothing in common with the CL file.
        AnotherPart = 941, Error, "a program of another part",
            "Fewer than one in ten motions of the CL file are in the program; a list of all differences would say nothing.",
            "Give the program that was made from this CL file, and the machine it was made for.";
    }
}
