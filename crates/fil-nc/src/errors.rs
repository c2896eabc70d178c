//! Codes of NC programs that are read back (09xx).

fil_diag::codes! {
    /// Everything that reading an NC program refuses.
    pub enum NcCode {
        /// A character that begins no word.
        NotAWord = 901, Error, "not a word of an NC program",
            "A block is made of letters, each with a number; what is not one is not guessed.",
            "Check that the file is an NC program of this control, and not cut off.";
        /// A letter with a number that is none.
        BadNumber = 902, Error, "a letter without a readable number",
            "The value of this word can't be read for sure.",
            "Check the number after the letter; a file that was cut off often ends in one.";
        /// A comment that never ends.
        OpenComment = 903, Error, "comment not closed",
            "What follows an open bracket may be comment or motion.",
            "Close the comment; a file that was cut off often ends in one.";
    }
}
