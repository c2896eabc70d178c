//! Machines to begin from.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use filpost::{Commons, Error, OptionKind, Program, ready};

/// Where the search begins.
#[derive(Clone, Debug)]
pub enum Bases {
    /// Ready posts by their names; the search chooses one.
    Ready(Vec<String>),
    /// A program whose machine is kept as far as the pairs allow: an option file with its FIL, or
    /// an own post.
    Given {
        /// What reports call it.
        title: String,
        /// Machine and FIL.
        program: Program,
    },
}

impl Bases {
    /// All ready posts, the generic mill first: of posts that write the same it is the one to name.
    pub fn all() -> Bases {
        let mut names: Vec<String> = ready::READY.iter().map(|post| post.name.into()).collect();
        names.sort_by_key(|name| name != ready::GENERIC_MILL);
        Bases::Ready(names)
    }
}

/// A machine to begin from, built.
#[derive(Debug)]
pub(crate) struct Base {
    /// What reports call it.
    pub title: String,
    /// The ready post; `None` for a given program.
    pub post: Option<String>,
    /// Options of the post that are given.
    pub options: Vec<(String, String)>,
    /// Its machine and the FIL of the task.
    pub program: Program,
}

impl Base {
    /// A ready post with values of options.
    ///
    /// # Errors
    /// The post or the FIL can't be built.
    pub fn ready(
        post: &str,
        options: Vec<(String, String)>,
        fil: &[(String, String)],
    ) -> Result<Base, Error> {
        let mut builder = Program::builder().machine("machine.toml", &head(post, &options));
        for (name, text) in fil {
            builder = builder.fil(name, text);
        }
        let program = builder.build()?;
        Ok(Base { title: post.into(), post: Some(post.into()), options, program })
    }

    /// The settings of the base.
    pub fn commons(&self) -> &Commons {
        self.program.commons()
    }

    /// The same post with one other value of an option, for each value there is.
    pub fn with_other_options(&self, built: &Built<'_>) -> Vec<Arc<Base>> {
        let Some(post) = &self.post else { return Vec::new() };
        let mut others = Vec::new();
        for option in self.program.options() {
            let now = option.value.to_string();
            for value in values(&option.kind).into_iter().filter(|value| *value != now) {
                let mut options = self.options.clone();
                options.retain(|(name, _)| *name != option.name);
                let mut other = built.ready(post, &options);
                if other.as_ref().is_some_and(|other| !other.has(&option.name, &value)) {
                    options.push((option.name.clone(), value));
                    options.sort();
                    other = built.ready(post, &options);
                }
                others.extend(other);
            }
        }
        others
    }

    /// An option has a value, from the post, its style or the options of the base.
    fn has(&self, option: &str, value: &str) -> bool {
        let options = self.program.options();
        options.iter().any(|it| it.name == option && it.value.to_string() == value)
    }
}

/// The name of a ready post, with the options that it is given.
type WithOptions = (String, Vec<(String, String)>);

/// Ready posts with values of options, each built once.
pub(crate) struct Built<'t> {
    fil: &'t [(String, String)],
    bases: Mutex<BTreeMap<WithOptions, Option<Arc<Base>>>>,
}

impl<'t> Built<'t> {
    /// None yet; they will have the FIL of a task.
    pub fn new(fil: &'t [(String, String)]) -> Built<'t> {
        Built { fil, bases: Mutex::default() }
    }

    /// A ready post with values of options; `None` where it can't be built.
    fn ready(&self, post: &str, options: &[(String, String)]) -> Option<Arc<Base>> {
        let build = || Base::ready(post, options.to_vec(), self.fil).ok().map(Arc::new);
        let Ok(mut bases) = self.bases.lock() else { return build() };
        bases.entry((post.into(), options.to_vec())).or_insert_with(build).clone()
    }
}

/// The values of an option that are worth a trial.
fn values(kind: &OptionKind) -> Vec<String> {
    match kind {
        OptionKind::Bool => vec!["yes".into(), "no".into()],
        OptionKind::Choice(names) => names.clone(),
        OptionKind::Integer { .. } | OptionKind::Length { .. } | OptionKind::Text => Vec::new(),
    }
}

/// The first lines of a `machine.toml` over a ready post; its options, as keys of their own
/// tables, come with it.
pub(crate) fn head(post: &str, options: &[(String, String)]) -> String {
    let mut head = format!("base = {post:?}\n");
    for (name, value) in options {
        head.push_str(&format!("options.{name} = {value:?}\n"));
    }
    head
}
