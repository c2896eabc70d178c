//! Codes of this crate: 04xx.

fil_diag::codes! {
    /// What can be wrong with a CL file or with a record.
    pub enum ClCode {
        /// The input could not be read.
        ReadFailed = 401, Error, "CL file cannot be read",
            "The operating system refused to read on.",
            "Check that the file exists, is readable and is not being written.";
        /// Bytes that no text has.
        BinaryData = 402, Error, "not a CL text",
            "The line holds control characters, as in a binary CL file or a file in UTF-16.",
            "Give the text form of the CL file (Creo writes NAME.ncl.N).";
        /// A statement longer than the limit.
        StatementTooLong = 403, Error, "statement too long",
            "A statement longer than the limit is taken for damage, not for CL data.",
            "Check whether the line ends or continuation signs of the file are damaged.";
        /// A `$` that nothing follows.
        OpenContinuation = 404, Error, "statement is cut off",
            "The line ends in $ and should go on in the next line, but does not.",
            "The file may have been cut off while it was written: write it again.";
        /// An item that looks like a number and is none.
        BadNumber = 405, Error, "not a number",
            "The item begins like a number but is not a finite decimal number.",
            "Correct the number in the CL file or in the command that makes it.";
        /// An item or a statement that is neither a number nor a name.
        BadWord = 406, Error, "not a CL word",
            "A CL statement is MAJOR / item, item, ...; an item is a number or a name.",
            "Check the spelling, the commas and the slash.";
        /// Coordinates of a wrong number or kind.
        BadPoint = 407, Error, "wrong coordinates",
            "GOTO, FROM, GODLTA and CIRCLE take numbers only, and a certain number of them.",
            "Check the statement for missing or surplus values.";
        /// A motion that is not yet computed.
        UncomputedMotion = 408, Error, "motion is not in points",
            "The statement describes the motion by geometry; its points are not in the file, \
             and leaving it out would make a wrong path.",
            "Write the CL file again with points or with CIRCLE arcs (Creo: CIRC_INTERPOLATION \
             other than APT_FORMAT; NX: no NURBS output).";
        /// Going back in a stream.
        NotSeekable = 409, Error, "input cannot go back",
            "The CL data come from a stream, which can be read only once and forwards.",
            "Give the CL file by its name.";
        /// A record number outside the file.
        NoSuchRecord = 410, Error, "no such CL record",
            "Records are numbered from 1 to the last record of the file.",
            "Check the record number.";
        /// Too many different words.
        TooManyWords = 411, Error, "too many different words",
            "A CL file has some hundred different words; more than the limit are taken for damage.",
            "Check that the file is a CL file.";
        /// A record that has no text form.
        Unwritable = 412, Error, "record has no text form",
            "The record holds something a CL statement cannot say, so that it would read back as \
             another record.",
            "Check the section that made or changed the record.";
        /// The output could not be written.
        WriteFailed = 413, Error, "CL file cannot be written",
            "The operating system refused to write on.",
            "Check the disk space and the permissions.";
    }
}
