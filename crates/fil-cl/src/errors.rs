//! Codes of this crate: 04xx.

fil_diag::codes! {
    /// What can be wrong with a CL file or with a record.
    pub enum ClCode {
        /// The input could not be read.
        ReadFailed = 401, Error, "CL file cannot be read",
            "The operating system reported an error while reading the file.",
            "Check that the file exists, is readable and is not being written.";
        /// Bytes that no text has.
        BinaryData = 402, Error, "not a CL text file",
            "The line has control characters, as in a binary CL file or a file in UTF-16.",
            "Give the text form of the CL file (Creo writes NAME.ncl.N).";
        /// A statement longer than the limit.
        StatementTooLong = 403, Error, "statement too long",
            "A statement longer than the limit is a sign of a damaged file.",
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
            "GOTO, FROM, GODLTA and CIRCLE take only numbers, and a fixed number of them.",
            "Check the statement for missing or extra values.";
        /// A motion that is not yet computed.
        UncomputedMotion = 408, Error, "motion without computed points",
            "The statement describes the move by geometry; its points are not in the file, and leaving it out would make a wrong path.",
            "Write the CL file again with points or with CIRCLE arcs (Creo: CIRC_INTERPOLATION other than APT_FORMAT; other systems than NX: no NURBS output).";
        /// Going back in a stream.
        NotSeekable = 409, Error, "streamed input can't be rewound",
            "The CL data come from a stream, which can be read only once.",
            "Give the CL file by its name.";
        /// A record number outside the file.
        NoSuchRecord = 410, Error, "no such CL record",
            "Records are numbered from 1 to the last record of the file.",
            "Check the record number.";
        /// Too many different words.
        TooManyWords = 411, Error, "too many different words",
            "A CL file has a few hundred different words; more than the limit is a sign of damage.",
            "Check that the file is a CL file.";
        /// A record that has no text form.
        Unwritable = 412, Error, "record has no text form",
            "The record holds something that a CL statement can't express: it would read back as another record.",
            "Check the section that made or changed the record.";
        /// The output could not be written.
        WriteFailed = 413, Error, "CL file cannot be written",
            "The operating system reported an error while writing the file.",
            "Check the disk space and the permissions.";
        /// A last line that has no end.
        LineCutOff = 414, Error, "last line may be cut off",
            "The file ends without a line end, in an unfinished statement: more digits, items or text may be lost.",
            "Compare the end of the file with the CAM system's. If it is complete, end the last line.";
        /// Signs of two CAM systems in one text.
        TwoDialects = 415, Error, "CL text mixes two dialects",
            "Dialects differ in the direction of arcs, so filpost reads a text in one dialect only.",
            "Choose the dialect with --dialect.";
        /// Values that could be a tool axis, one point or several.
        UnclearPoints = 416, Error, "points and tool axis are ambiguous",
            "Six values of a GOTO are a point and a tool axis of length 1; several points in one GOTO are read only if they can be nothing else.",
            "Write each point in a GOTO of its own.";
        /// A CIRCLE of another dialect.
        ForeignArc = 417, Error, "arc is not in the form of this dialect",
            "The axis of a CIRCLE means the opposite direction in some dialects; the number of its values shows which one it is.",
            "Choose the dialect of the CAM system with --dialect.";
        /// A statement that lacks an item.
        MissingItem = 418, Error, "item is missing",
            "The statement is incomplete without the item, which may be in a lost line.",
            "Check the statement; it continues in the next line if its line ends in $.";
        /// A text that may be a block or a note.
        UnclearText = 419, Error, "INSERT may be a block or a note",
            "The CAM system writes both notes and NC blocks with INSERT. A note in the program would move the machine, and a block left out would be missing.",
            "Write a note as PPRINT / text, and a block of words with a G or an M.";
        /// A unit that the statement does not settle.
        UnclearUnit = 420, Error, "unit is ambiguous",
            "The CAM system writes the same word in files of either unit.",
            "Name the unit in the statement.";
        /// Points of a frame that the file does not settle.
        UnclearFrame = 421, Error, "coordinate system of the points is ambiguous",
            "The points are in a coordinate system that turns with the table. It is known only for one position of the table in a file, and for a rotation about X or Y that brings the tool along TLAXIS.",
            "Post each position of the table from a file of its own, with TLAXIS and ROTABL before the first motion.";
        /// A spline that is not read.
        BadSpline = 425, Error, "spline can't be read",
            "A spline is converted to lines if its knots, its control points and the numbers of its NURBS agree, and the tool is at its start; anything else could be another curve.",
            "Write the CL file again with lines and arcs instead of splines.";
    }
}
