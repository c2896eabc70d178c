//! Another revision: built beside the target folder of this one, and run on its inputs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::record::{self, Key, Record};
use super::{Args, SEEDS, random, text_of, write};

/// What shows that a revision has this command.
const COMMAND: &str = "tests/xtask/src/shadow/mod.rs";

/// The command of another revision.
pub struct Base {
    binary: PathBuf,
    folder: PathBuf,
}

/// Builds the command of a revision, or finds it built. Revisions share one checkout and one
/// target folder, so that only what differs between them is compiled.
///
/// # Errors
/// A revision that is not there, has no such command, or can't be built.
pub fn build(revision: &str) -> Result<Base, String> {
    let name = git(
        filpost_tests::root(),
        &[
            "rev-parse",
            "--verify",
            "--quiet",
            "--end-of-options",
            &format!("{revision}^{{commit}}"),
        ],
    )
    .map_err(|_| format!("there is no revision {revision}"))?;
    if git(filpost_tests::root(), &["cat-file", "-e", &format!("{name}:{COMMAND}")]).is_err() {
        return Err(format!(
            "{revision} has no `cargo xtask shadow` yet. Where its programs are in a record file \
             (`--record FILE`, of a revision that makes the same ones), `--against FILE` compares \
             with that"
        ));
    }
    let folder = target().join("shadow");
    let binary = folder.join("commands").join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    if !binary.is_file() {
        compile(&name, &folder, &binary)?;
    }
    Ok(Base { binary, folder })
}

fn target() -> PathBuf {
    let chosen = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = chosen.unwrap_or_else(|| "target".into());
    filpost_tests::root().join(target)
}

fn compile(name: &str, folder: &Path, binary: &Path) -> Result<(), String> {
    eprintln!("building {name}");
    let tree = folder.join("tree");
    if tree.join(".git").is_file() {
        git(&tree, &["checkout", "--quiet", "--force", "--detach", name])?;
    } else {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let path = tree.display().to_string();
        // The entry of a folder that is gone may still be there.
        git(
            filpost_tests::root(),
            &["worktree", "add", "--quiet", "--force", "--force", "--detach", &path, name],
        )?;
    }
    let built = folder.join("target");
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
    cargo.args(["build", "--quiet", "--locked", "-p", "filpost-xtask"]).current_dir(&tree);
    cargo.env("CARGO_TARGET_DIR", &built).env("CARGO_INCREMENTAL", "1");
    done(&mut cargo)?;
    let made = built.join("debug").join(format!("filpost-xtask{}", std::env::consts::EXE_SUFFIX));
    let commands = binary.parent().unwrap_or(folder);
    let kept = fs::create_dir_all(commands).and_then(|()| fs::copy(&made, binary));
    kept.map(drop).map_err(|error| format!("{}: {error}", made.display()))
}

/// Runs git in a folder; gives what it prints.
fn git(folder: &Path, args: &[&str]) -> Result<String, String> {
    let mut git = Command::new("git");
    let output = git.args(args).current_dir(folder).stdin(Stdio::null()).output();
    let output = output.map_err(|error| format!("git: {error}"))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(format!("git {}: {}", args.join(" "), said.trim()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_string())
}

fn done(command: &mut Command) -> Result<(), String> {
    let status = command.stdin(Stdio::null()).status();
    let status = status.map_err(|error| format!("{command:?}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?}: {status}")) }
}

impl Base {
    /// Runs the command on the inputs of this checkout.
    ///
    /// # Errors
    /// A run that ends with an error.
    pub fn run(&self, args: &Args) -> Result<BTreeMap<Key, Record>, String> {
        let [programs, records] = ["programs.json", "base.txt"].map(|name| self.folder.join(name));
        write(&programs, &random::write(&random::programs(args.seeds.unwrap_or(SEEDS)))?)?;
        let mut command = Command::new(&self.binary);
        command.arg("shadow").arg("--record").arg(&records);
        command.arg("--inputs").arg(filpost_tests::root()).arg("--programs").arg(&programs);
        command.arg("--jobs").arg(args.jobs.to_string());
        for (option, names) in [("--post", &args.post), ("--suite", &args.suite)] {
            names.iter().for_each(|name| {
                command.arg(option).arg(name);
            });
        }
        done(&mut command)?;
        record::read(&text_of(&records)?)
    }
}
