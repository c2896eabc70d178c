//! Codes of numbers and axes on the tape (0501 to 0510) and of machine settings (06xx).

fil_diag::codes! {
    /// Everything a machine description refuses or warns about.
    pub enum MachineCode {
        /// A value with too many digits.
        Overflow = 501, Error, "value does not fit its address",
            "A number without its leading digits would move the machine somewhere else.",
            "Check the CL value and the format of the address (digits before and after the point).";
        /// A word for an address the machine lacks.
        NoAddress = 502, Error, "the machine has no such address",
            "The block needs a letter that has no position in the block layout of this machine.",
            "Give the address a position in machine.toml, or don't write that word.";
        /// Unreachable tool axis.
        ToolAxis = 508, Error, "the machine can't reach this tool axis",
            "No position of the rotary axes points the tool in that direction.",
            "Check the rotary axes of the machine and their limits, or the orientation of the part.";
        /// Axis limit.
        AxisLimit = 510, Error, "axis limit exceeded",
            "The move leaves the travel of the machine.",
            "Check the part's position and the limits in machine.toml.";
        /// A number that rounding would change.
        Inexact = 512, Error, "address can't hold this number",
            "A rounded tool or code number is another tool or code; a rounded lead, feed or peck moves the machine differently than programmed.",
            "Give the address more digits after the point (its format in machine.toml), or correct the value.";
        /// Unknown common location.
        CommonLocation = 601, Error, "no such common location",
            "The commons have a fixed range of locations.",
            "Check the location number.";
        /// Value that the common can't hold.
        CommonValue = 602, Error, "the common can't hold this value",
            "INTCOM holds whole numbers, and no common holds what is not finite.",
            "Check the value that is stored.";
        /// machine.toml syntax.
        MachineSyntax = 603, Error, "machine settings can't be read",
            "A machine.toml, and each `--set key=value`, must be valid TOML.",
            "Correct the line shown.";
        /// Unknown key.
        UnknownSetting = 604, Error, "unknown machine setting",
            "A setting that is not understood could change how the machine moves.",
            "Check the spelling of the key; `filpost machine show --all` lists all of them.";
        /// Wrong type or choice.
        SettingValue = 605, Error, "machine setting has a wrong value",
            "The value is not of the setting's kind or not among its choices.",
            "See the setting's choices with `filpost machine show --all`.";
        /// Bad option file.
        OptionFile = 606, Error, "option file can't be read",
            "An option file is a list of pairs, location and value, under INTCOM, RELCOM and DBLCOM.",
            "Check that the file is an option file (.pNN) and whole.";
        /// Settings that contradict each other.
        Contradiction = 607, Error, "settings contradict each other",
            "No program can follow both settings.",
            "Correct one of the settings; `filpost machine show --all` lists them.";
        /// The option file of a lathe.
        LatheOptionFile = 608, Error, "option file of a lathe",
            "An option file lists only the differences from the vendor's own machine, and the vendor's lathe has never been published. Over a mill it would describe another machine.",
            "Name the lathe under it: `-p fanuc-lathe -m FILE` posts with it, `filpost machine import -p fanuc-lathe FILE` writes all of it as a machine.toml. Then check diameters, feeds and threads.";
        /// The machine described twice.
        DescribedTwice = 609, Error, "conflicting machine descriptions",
            "The rotary axes listed in an option file differ from the axes that are given, so one of the two describes another machine.",
            "Correct the axis chain, or correct or remove the setting that lists it.";
        /// A value for an option that the post lacks.
        UnknownOption = 610, Error, "unknown option of the post",
            "The post does not have this option, so the program would not be the one you asked for.",
            "`filpost posts NAME` lists the options of a post.";
        /// A value that an option does not take.
        OptionValue = 611, Error, "option of the post has a wrong value",
            "The value is not of the option's type or not among its choices.",
            "`filpost posts NAME` lists the options of a post with their values.";
        /// A wrong declaration of an option.
        OptionDeclaration = 612, Error, "wrong declaration of a post option",
            "An option has a type (bool, integer, length, choice, text), a default, a group and a help line.",
            "Correct the declaration; docs/machine.md shows one of each type.";
        /// A setting nobody reads.
        UnusedSetting = 651, Warning, "setting without effect",
            "Nothing reads this setting: the NC program is the same without it.",
            "Remove the setting, or do its work in a FIL section.";
        /// Import of a value we can't be sure of.
        DoubtfulImport = 652, Warning, "imported value of uncertain meaning",
            "The numbers of this choice are not published; ours may differ from the vendor's.",
            "Compare the output with a program the machine has run, and set the key by name.";
        /// An old name.
        RenamedSetting = 653, Warning, "setting has a new name",
            "The old name was wrong or misleading. It still works.",
            "Write the new name.";
    }
}
