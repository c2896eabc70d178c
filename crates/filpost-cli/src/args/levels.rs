//! `--allow`, `--warn` and `--deny`: they are read in the order in which they stand.

use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use filpost::{Level, LevelOf, Levels};

/// Levels of codes: the later option wins, a code over `all`.
#[derive(Clone, Debug, Default)]
pub struct LevelArgs {
    /// What the options set.
    pub levels: Levels,
    /// A change that `--audit` lists refuses the program.
    pub denies_audit: bool,
}

fn help(level: Level) -> &'static str {
    match level {
        Level::Allow => "Do not report a warning or doubt: its code, or `all` (may be given again)",
        Level::Warn => "Report a doubt as a warning: its code, or `all` (may be given again)",
        Level::Deny => {
            "Refuse the program for a warning or doubt: its code, or `all`; for a change that --audit \
             lists: `audit` (may be given again)"
        }
    }
}

/// What a level is given to.
#[derive(Clone, Copy, Debug)]
enum Named {
    Code(LevelOf),
    /// The changes that `--audit` lists.
    Audit,
}

fn named(name: &str) -> Result<Named, String> {
    if name == "audit" {
        return Ok(Named::Audit);
    }
    LevelOf::named(name).map(Named::Code).map_err(|diag| match &diag.hint {
        Some(hint) => format!("{}; {hint}", diag.message),
        None => diag.message,
    })
}

impl FromArgMatches for LevelArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut args = LevelArgs::default();
        args.update_from_arg_matches(matches)?;
        Ok(args)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        let mut said = Vec::new();
        for level in Level::ALL {
            let codes = matches.get_many::<Named>(level.name()).into_iter().flatten();
            let places = matches.indices_of(level.name()).into_iter().flatten();
            said.extend(places.zip(codes).map(|(place, code)| (place, *code, level)));
        }
        said.sort_by_key(|(place, ..)| *place);
        for (_, named, level) in said {
            match named {
                Named::Code(code) => code.set(&mut self.levels, level),
                Named::Audit => self.denies_audit = level == Level::Deny,
            }
        }
        Ok(())
    }
}

impl Args for LevelArgs {
    fn augment_args(command: Command) -> Command {
        Level::ALL.into_iter().fold(command, |command, level| {
            let arg = Arg::new(level.name()).long(level.name()).value_name("CODE");
            command.arg(arg.action(ArgAction::Append).value_parser(named).help(help(level)))
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(options: &[&str]) -> Levels {
        let command = LevelArgs::augment_args(Command::new("post"));
        let matches = command.try_get_matches_from([&["post"], options].concat()).expect("options");
        LevelArgs::from_arg_matches(&matches).expect("levels").levels
    }

    #[test]
    fn the_later_one_wins_and_a_code_over_all() {
        let code = filpost::allowable("E0532").expect("a doubt");
        let of = |options: &[&str]| levels(options).of_code(code);
        assert_eq!(of(&["--deny", "E0532", "--allow", "E0532"]), Level::Allow);
        assert_eq!(of(&["--allow", "E0532", "--deny", "E0532"]), Level::Deny);
        assert_eq!(of(&["--warn", "E0532", "--allow", "all"]), Level::Warn);
        assert_eq!(of(&["--warn", "all"]), Level::Warn);
    }

    #[test]
    fn an_error_that_stands_has_no_level() {
        let command = LevelArgs::augment_args(Command::new("post"));
        let wrong =
            command.try_get_matches_from(["post", "--allow", "E0506"]).expect_err("refused");
        assert!(wrong.to_string().contains("can't be done"), "{wrong}");
    }
}
