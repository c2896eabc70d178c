//! Codes of the command line.

fil_diag::codes! {
    /// What the command refuses, beyond what the library does.
    pub enum CommandCode {
        /// `--deny-warnings`.
        Denied = 801, Error, "warnings are not allowed here",
            "The run was started with --deny-warnings and there were warnings.",
            "Mend what the warnings name, or leave --deny-warnings out.";
        /// Output over an input.
        OverInput = 802, Error, "the output would replace an input",
            "Two files of this run are the same file, or --map names a file that is there and is no line map.",
            "Choose another name for the output.";
        /// `filpost test` without cases.
        NoCases = 803, Error, "no regression cases",
            "A test run without cases would prove nothing.",
            "Name a folder that holds folders with a case.toml.";
        /// `filpost test --init` over a case.
        CaseExists = 804, Error, "the folder holds a case already",
            "A case that is there may be proof of something; it is not replaced.",
            "Choose another folder, or remove the old case.";
        /// Two files of one name in a case to be.
        SameName = 805, Error, "two files of the case have one name",
            "All files of a case lie in its folder.",
            "Give one of them another name.";
        /// `filpost trace` without a line.
        NoLine = 806, Error, "no line to trace",
            "A question is FILE:LINE, of an NC program also FILE:LINE:COLUMN.",
            "Put a colon and the number of the line after the name of the file.";
        /// A folder without CL files.
        NoClFiles = 807, Error, "no CL files in this folder",
            "Of a folder those files are posted that end as CL files do; folders in it are not looked into.",
            "Name the folder that holds the CL files, or name the files themselves.";
        /// `filpost new` over something.
        FolderExists = 808, Error, "the folder is there already",
            "A new post begins in a folder of its own; nothing that is there is written over.",
            "Choose another name.";
        /// `filpost new` of `..` or `/`.
        NoName = 809, Error, "no name for the new post",
            "The post has the name of its folder, and this path ends with none.",
            "Write the name of the folder: filpost new my-post.";
        /// `filpost test --init` with a folder that can't be copied.
        NotCopied = 810, Error, "the folder can't be part of a case",
            "A case holds a copy of the folder that its scripts read: files and folders, at most 1000 of them and 64 MB. A link could lead out of it.",
            "Grant a folder with the files that the scripts read, and nothing else.";
        /// `filpost machine show` of a name that no setting has.
        NoSetting = 811, Error, "no such setting",
            "A part of a name that begins no setting would show an empty list.",
            "`filpost machine show --all` lists every setting; `-m FILE` names the machine.";
    }
}
