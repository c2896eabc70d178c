//! Codes of the command line.

fil_diag::codes! {
    /// What the command refuses, beyond what the library does.
    pub enum CommandCode {
        /// `--deny-warnings`.
        Denied = 801, Error, "warnings are not allowed here",
            "The run was started with --deny-warnings and there were warnings.",
            "Correct what the warnings name, or run without --deny-warnings.";
        /// Output over an input.
        OverInput = 802, Error, "the output would replace an input",
            "Two files of this run are the same file, or --map names an existing file that is not a line map.",
            "Choose another name for the output.";
        /// `filpost test` without cases.
        NoCases = 803, Error, "no regression cases",
            "A test run without cases would prove nothing.",
            "Name a folder that contains folders with a case.toml.";
        /// `filpost test --init` over a case.
        CaseExists = 804, Error, "folder already holds a case",
            "An existing case is never replaced.",
            "Choose another folder, or remove the old case.";
        /// Two files of one name in a case to be.
        SameName = 805, Error, "two files of the case have the same name",
            "All files of a case are in one folder.",
            "Rename one of them.";
        /// `filpost trace` without a line.
        NoLine = 806, Error, "no line to trace",
            "The argument is FILE:LINE; for an NC program also FILE:LINE:COLUMN.",
            "Write a colon and the line number after the file name.";
        /// A folder without CL files.
        NoClFiles = 807, Error, "no CL files in this folder",
            "In a folder, filpost posts the files with the extensions of CL files, but not those in subfolders.",
            "Name the folder of the CL files, or the files themselves.";
        /// `filpost new` over something.
        FolderExists = 808, Error, "folder already exists",
            "A new post needs a new folder; existing files are never overwritten.",
            "Choose another name.";
        /// `filpost new` of `..` or `/`.
        NoName = 809, Error, "no name for the new post",
            "The post gets the name of its folder, and this path does not end with a name.",
            "Write the name of the folder: filpost new my-post.";
        /// `filpost test --init` with a folder that can't be copied.
        NotCopied = 810, Error, "folder can't be copied into a case",
            "A case has a copy of the folder that its scripts read: at most 1000 files and folders and 64 MB, and no links, which could lead out of it.",
            "Grant a folder with the files that the scripts read, and nothing else.";
        /// `filpost machine show` of a name that no setting has.
        NoSetting = 811, Error, "no such setting",
            "No name of a setting begins with this text.",
            "`filpost machine show --all` lists every setting; `-m FILE` names the machine.";
        /// `filpost studio` without its program.
        NoStudio = 812, Error, "the studio is not installed",
            "The studio is a separate program, filpost-studio, which is neither next to this command nor in a folder of PATH.",
            "Put filpost-studio of the release next to filpost, or run `cargo install --locked --path crates/filpost-studio`.";
        /// `--audit` with a finding, or with `--deny audit` a change.
        Audit = 813, Error, "the audit refuses this program",
            "A block of the program has a fault or breaks a rule; with --deny audit, changes by a script or INSERT are refused too.",
            "Correct what the audit names; without --audit the program is written as it is.";
    }
}

const _: () =
    assert!(filpost::are_unique_beside(CommandCode::ALL), "a number is that of another crate");
