//! What an editor asks of a text.

#[cfg(feature = "post")]
mod assist;
#[cfg(feature = "navigate")]
mod navigate;

use fil_ide::{Position, Script};
use filpost::{Commons, Included, settings};

use crate::Misuse;
use crate::fields::{Fields, Named};

/// What language a text is in.
#[derive(Clone, Copy)]
enum Language {
    Fil,
    Cl,
    Machine,
}

/// An edited text, and a place in it.
pub(crate) struct Edited {
    language: Language,
    name: String,
    text: String,
    /// Line, counted from 0.
    line: u32,
    /// UTF-16 units from the start of the line.
    character: u32,
    /// The `machine.toml` that FIL runs on.
    machine: Option<String>,
    includes: Vec<Named>,
    /// The new name of what stands at the place.
    #[cfg_attr(
        not(feature = "navigate"),
        expect(dead_code, reason = "only names are changed to it")
    )]
    new: Option<String>,
}

impl Edited {
    pub fn read(mut fields: Fields) -> Result<Self, Misuse> {
        let language = match fields.needed("language")?.as_str() {
            "fil" => Language::Fil,
            "cl" => Language::Cl,
            "machine" => Language::Machine,
            other => {
                return Err(Misuse(format!("`language` must be fil, cl or machine, not {other}")));
            }
        };
        let count = |number: Option<u64>| u32::try_from(number.unwrap_or(0)).unwrap_or(u32::MAX);
        let edited = Edited {
            language,
            name: fields.needed("name")?,
            text: fields.needed("text")?,
            line: count(fields.number("line")?),
            character: count(fields.number("character")?),
            machine: fields.text("machine")?,
            includes: fields.files("includes")?,
            new: fields.text("new")?,
        };
        fields.end()?;
        Ok(edited)
    }

    fn position(&self) -> Position {
        Position { line: self.line, character: self.character }
    }

    fn with_script<T>(&self, ask: impl FnOnce(&Script) -> T) -> T {
        let mut includes = |_: &str, name: &str| {
            let found = self.includes.iter().find(|file| file.name == name);
            match found {
                Some(file) => Ok(Included { name: file.name.clone(), text: file.text.clone() }),
                None => Err(format!("there is no {name} here")),
            }
        };
        let machine: Option<Commons> = self.machine.as_ref().and_then(|text| {
            let ready = |base: &str| filpost::ready::find(base).map(|post| post.machine);
            settings::read_toml_with("machine.toml", text, &ready).ok().map(|(commons, _)| commons)
        });
        let files = [(self.name.as_str(), self.text.as_str())];
        ask(&Script::new(&files, &self.name, Some(&mut includes), machine.as_ref()))
    }
}
