//! The machine of a program: where its settings come from, and what is laid over them.

use fil_diag::{Diag, suggest};
use fil_machine::post_options::{GivenOption, PostOptions};
use fil_machine::{Commons, contradictions, files as settings};

use crate::allow;
use crate::error::RunCode;
use crate::ready;
use crate::simulate::Setup;

/// Where the settings of the machine come from.
pub(crate) enum Machine {
    Ready(String),
    /// A ready post that nothing names: its options have the defaults of a base.
    Generic(String),
    Toml {
        name: String,
        text: String,
    },
    OptionFile {
        name: String,
        text: String,
    },
    Commons(Box<Commons>),
}

impl Machine {
    /// What messages call it.
    fn name(&self) -> Option<String> {
        match self {
            Machine::Ready(name)
            | Machine::Generic(name)
            | Machine::Toml { name, .. }
            | Machine::OptionFile { name, .. } => Some(name.clone()),
            Machine::Commons(_) => None,
        }
    }
}

/// What is laid over a machine.
pub(crate) struct Layers<'b> {
    pub(crate) over: &'b [(String, String)],
    pub(crate) settings: &'b [String],
    pub(crate) options: &'b [GivenOption],
    pub(crate) fil: &'b [(String, String)],
    pub(crate) without_effect: &'b [String],
}

impl Layers<'_> {
    /// All values of options, for a machine with this text; the later one counts.
    fn options(&self, machine: Option<&(&str, &str)>, is_base: bool) -> PostOptions {
        let over = self.over.iter().map(|(name, text)| (name.as_str(), text.as_str()));
        let texts = machine.copied().into_iter().chain(over);
        let of_settings = self.settings.iter().map(|setting| ("--set", setting.as_str()));
        let given = texts.chain(of_settings);
        let mut given: Vec<GivenOption> =
            given.flat_map(|(name, text)| settings::given_options(name, text)).collect();
        given.extend_from_slice(self.options);
        let legacy = self.over.iter().any(|(_, text)| settings::is_option_text(text));
        PostOptions::given(given, is_base || legacy)
    }
}

/// The post of a machine with what is laid over it, and the warnings of both.
///
/// # Errors
/// As [`commons_with`].
pub(crate) fn post(
    layers: &Layers<'_>,
    machine: Option<&Machine>,
) -> Result<(fil_post::Post, Vec<Diag>), Vec<Diag>> {
    let (commons, warnings) = commons_with(layers, machine)?;
    allow::refuse_unknown(commons.levels())?;
    let post = fil_post::Post::new(commons).map_err(|diag| vec![*diag])?;
    Ok((post, warnings))
}

/// A machine with what is laid over it, and the warnings of both.
///
/// # Errors
/// All that is wrong with them; options that are not declared; settings that contradict each
/// other, where each alone is right.
pub(crate) fn commons_with(
    layers: &Layers<'_>,
    machine: Option<&Machine>,
) -> Result<(Commons, Vec<Diag>), Vec<Diag>> {
    let generic = Machine::Generic(ready::GENERIC_MILL.into());
    let machine = machine.unwrap_or(&generic);
    let name = machine.name();
    let (mut commons, mut warnings) = commons_of(machine, layers)?;
    layers.without_effect.iter().for_each(|word| commons.list_without_effect(word));
    let mut errors = Vec::new();
    let over = layers.over.iter();
    let over = over.map(|(name, text)| settings::lay_over(&mut commons, name, text));
    let mut said: Vec<Result<Vec<Diag>, Vec<Diag>>> = over.collect();
    let fil = layers.fil.iter().map(|(name, text)| {
        settings::declare_fil_options(&mut commons, name, text).map(|()| Vec::new())
    });
    said.extend(fil);
    let set = layers.settings.iter();
    said.extend(set.map(|setting| settings::apply_setting(&mut commons, setting)));
    said.push(commons.options().refuse_unknown().map(|()| Vec::new()));
    said.push(Setup::of_machine(&commons, &|_, name| name.to_string()).map(|_| Vec::new()));
    for said in said {
        match said {
            Ok(said) => warnings.extend(said),
            Err(wrong) => errors.extend(wrong),
        }
    }
    if errors.is_empty() {
        let found = contradictions::all(&commons).into_iter();
        errors.extend(found.map(|diag| match &name {
            Some(name) => diag.note(format!("in the settings of {name}")),
            None => diag,
        }));
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    // An option file has the travel of its machine, whether or not it is asked for.
    if !matches!(machine, Machine::OptionFile { .. }) {
        warnings.extend(contradictions::unchecked(&commons));
    }
    Ok((commons, warnings))
}

fn commons_of(machine: &Machine, layers: &Layers<'_>) -> Result<(Commons, Vec<Diag>), Vec<Diag>> {
    let no_base = |_: &str| None;
    match machine {
        Machine::Commons(commons) => {
            let mut commons = (**commons).clone();
            commons.options_mut().give(layers.options(None, false));
            Ok((commons, Vec::new()))
        }
        Machine::Toml { name, text } => {
            let bases = |base: &str| ready::find(base).map(|post| post.machine);
            let options = layers.options(Some(&(name, text)), false);
            settings::read_toml_given(name, text, &bases, options)
        }
        Machine::OptionFile { name, text } => settings::read_option_file(name, text).map(|file| {
            let mut commons = file.commons;
            commons.options_mut().give(layers.options(None, true));
            (commons, file.warnings)
        }),
        Machine::Ready(name) | Machine::Generic(name) => {
            let post = ready::find(name).ok_or_else(|| {
                let title = format!("no ready post `{name}`");
                vec![Diag::new(RunCode::NoReadyPost, title).hint(meant(name))]
            })?;
            let options = layers.options(None, matches!(machine, Machine::Generic(_)));
            let read = settings::read_toml_given(post.name, post.machine, &no_base, options);
            read.map(|(mut commons, warnings)| {
                commons.options_mut().is_base = false;
                (commons, warnings)
            })
        }
    }
}

/// The ready posts that were perhaps meant by a name: the nearest, else those of the same maker.
fn meant(name: &str) -> String {
    let known = || ready::READY.iter().map(|post| post.name);
    let maker = name.split('-').next().unwrap_or_default().to_ascii_lowercase();
    let of_maker: Vec<&str> = known().filter(|post| post.starts_with(&maker)).collect();
    match suggest::did_you_mean(name, known()) {
        _ if name.contains(['/', '.']) => {
            format!("a machine.toml or an option file is given by --machine {name}")
        }
        Some(near) => format!("{near} `filpost posts` lists all of them."),
        None if maker.is_empty() || of_maker.is_empty() => {
            format!("there are {}", known().collect::<Vec<_>>().join(", "))
        }
        None => format!("did you mean {}?", of_maker.join(" or ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_post_names_those_that_were_perhaps_meant() {
        assert!(meant("fanuc-mil").starts_with("did you mean fanuc-mill?"));
        let haas = meant("Haas");
        assert!(haas.starts_with("did you mean haas-"), "{haas}");
        assert!(haas.contains(" or haas-trunnion") && !haas.contains("fanuc"), "{haas}");
        assert!(meant("kuka").starts_with("there are brother-mill"));
        assert!(meant("machine.toml").ends_with("--machine machine.toml"));
        assert!(meant("").starts_with("there are brother-mill"));
    }
}
