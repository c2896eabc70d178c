//! Names that completions propose; any other text is taken too.

use std::sync::OnceLock;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::{Arg, Command, Error};
use filpost::locations::TABLE;
use filpost::ready::READY;

/// A text whose completions are names.
#[derive(Clone, Copy, Debug)]
pub struct OneOf(fn() -> Vec<&'static str>);

impl TypedValueParser for OneOf {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &std::ffi::OsStr,
    ) -> Result<String, Error> {
        StringValueParser::new().parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.0)().into_iter().map(PossibleValue::new)))
    }
}

/// Ready posts.
pub fn post() -> OneOf {
    OneOf(|| READY.iter().map(|post| post.name).collect())
}

/// Settings.
pub fn setting() -> OneOf {
    OneOf(|| TABLE.iter().map(|row| row.name).collect())
}

/// Subjects of `filpost explain`: codes, ready posts and settings.
pub fn subject() -> OneOf {
    static CODES: OnceLock<Vec<String>> = OnceLock::new();
    OneOf(|| {
        let codes = CODES
            .get_or_init(|| filpost::all_codes().into_iter().map(filpost::Code::name).collect());
        let posts = READY.iter().map(|post| post.name);
        codes
            .iter()
            .map(String::as_str)
            .chain(posts)
            .chain(TABLE.iter().map(|row| row.name))
            .collect()
    })
}
