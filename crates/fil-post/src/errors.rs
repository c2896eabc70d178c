//! Codes of the post (05xx) and of machine settings (06xx).

fil_diag::codes! {
    /// Everything the post refuses or warns about.
    pub enum PostCode {
        /// A value with too many digits.
        Overflow = 501, Error, "value does not fit its address",
            "A number that lost its leading digits would move the machine somewhere else.",
            "Check the CL value and the format of the address (digits before and after the point).";
        /// A word for an address the machine lacks.
        NoAddress = 502, Error, "the machine has no such address",
            "The block needs a letter that has no tape position on this machine.",
            "Give the address a position in machine.toml, or don't write that word.";
        /// Motion without position.
        ArcStart = 503, Error, "arc without a start point",
            "An arc starts where the motion before it ended, and no motion came before.",
            "Put a GOTO or FROM before the CIRCLE.";
        /// Radii disagree.
        ArcRadius = 504, Error, "the radii of the arc disagree",
            "Start and end of an arc must lie at the same distance from its center.",
            "Check center, start and end of the CIRCLE and the GOTO after it.";
        /// CIRCLE without GOTO.
        ArcEnd = 505, Error, "CIRCLE without an end point",
            "A CIRCLE takes its end from the GOTO that follows at once.",
            "Put the GOTO of the end point after the CIRCLE.";
        /// A word form.
        WordForm = 506, Error, "form of this post word is not understood",
            "What can't be read for sure is not guessed: the block would be a guess too.",
            "Compare the record with the documented forms of the word.";
        /// A missing code.
        NoCode = 507, Error, "the machine has no code for this",
            "The setting that holds the preparatory or auxiliary function is absent.",
            "Set the code in machine.toml, or take the record with a FIL section.";
        /// Unreachable tool axis.
        ToolAxis = 508, Error, "the machine can't reach this tool axis",
            "No position of its rotary axes brings the tool into that direction.",
            "Check the rotary axes of the machine and their limits, or the part frame.";
        /// Feed motion without feed.
        NoFeed = 509, Error, "feed motion without a feed",
            "A feed motion needs a feed, and none was given before it.",
            "Put a FEDRAT before the first GOTO that is not rapid.";
        /// Axis limit.
        AxisLimit = 510, Error, "axis limit exceeded",
            "The motion leaves the travel of the machine.",
            "Check the part's position and the limits in machine.toml.";
        /// Sequence of cycle.
        CycleForm = 511, Error, "cycle can't be carried out",
            "A value the cycle needs is missing or makes no sense.",
            "Give DEPTH, a feed and CLEAR (and STEP for DEEP and BRKCHP).";
        /// Unknown major word.
        UnknownWord = 551, Warning, "word without effect",
            "The post has no handler for this major word; the record passes without output.",
            "Write a FIL section for it, or check its spelling.";
        /// Unknown minor word or ignored part.
        IgnoredPart = 552, Warning, "part of the record has no effect",
            "The post acts on the record but not on this part of it.",
            "Remove the part, or take the record with a FIL section.";
        /// Feed or speed clamped.
        Clamped = 553, Warning, "value brought within the machine's limits",
            "The feed or speed asked for lies outside the range of the machine.",
            "Check the value in the CL file and the limits in machine.toml.";
        /// Arc output as lines.
        ArcLines = 554, Warning, "arc written as short lines",
            "The arc lies in no plane of the machine, or its radius is above the maximum.",
            "Nothing to do if the chord tolerance suits; see circle.chord_tolerance.";
        /// Text outside ASCII.
        TapeText = 555, Warning, "text on the tape that is not ASCII",
            "Many controls read ASCII only and stop at other characters.",
            "Write the message in ASCII if the control is not known to read UTF-8.";
        /// Unknown common location.
        CommonLocation = 601, Error, "no such common location",
            "The commons have a fixed range of locations.",
            "Check the location number.";
        /// Value that the common can't hold.
        CommonValue = 602, Error, "the common can't hold this value",
            "INTCOM holds whole numbers, and no common holds what is not finite.",
            "Check the value that is stored.";
        /// machine.toml syntax.
        MachineSyntax = 603, Error, "machine.toml can't be read",
            "The file is not valid TOML.",
            "Correct the line shown.";
        /// Unknown key.
        UnknownSetting = 604, Error, "unknown machine setting",
            "A setting that is not understood could change how the machine moves.",
            "Check the spelling of the key; `filpost machine show` lists all of them.";
        /// Wrong type or choice.
        SettingValue = 605, Error, "machine setting has a wrong value",
            "The value is not of the setting's kind or not among its choices.",
            "See the setting's choices with `filpost machine show`.";
        /// Bad option file.
        OptionFile = 606, Error, "option file can't be read",
            "An option file is a list of pairs, location and value, under INTCOM, RELCOM and DBLCOM.",
            "Check that the file is an option file (.pNN) and whole.";
        /// A setting nobody reads.
        UnusedSetting = 651, Warning, "setting without effect",
            "The location is known, but this post does not act on it.",
            "Remove the setting, or do its work in a FIL section.";
        /// Import of a value we can't be sure of.
        DoubtfulImport = 652, Warning, "imported value of uncertain meaning",
            "The numbers of this choice are not published; ours may differ from the vendor's.",
            "Compare the output with a program the machine has run, and set the key by name.";
    }
}
