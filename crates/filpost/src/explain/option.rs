//! What an option of the ready posts does.

use crate::ready::READY;
use crate::{PostOption, Program};

/// Explains an option such as `preload`, for each of its meanings the posts that have it; `None`
/// for a name that no ready post has.
pub fn explain(name: &str) -> Option<String> {
    let mut meanings: Vec<(PostOption, Vec<&str>)> = Vec::new();
    for post in READY {
        let Ok(program) = Program::builder().ready(post.name).build() else { continue };
        let Some(option) = program.options().iter().find(|option| option.name == name) else {
            continue;
        };
        match meanings
            .iter_mut()
            .find(|(one, _)| (&one.help, &one.kind) == (&option.help, &option.kind))
        {
            Some((_, posts)) => posts.push(post.name),
            None => meanings.push((option.clone(), vec![post.name])),
        }
    }
    let text = |(option, posts): &(PostOption, Vec<&str>)| {
        format!("{}: {}.\n  {}", option.help, option.kind.values(), super::counted(posts))
    };
    let texts: Vec<String> = meanings.iter().map(text).collect();
    (!texts.is_empty()).then(|| {
        format!("{name}  option of ready posts\n\n{}\n\nSet it with `--option {name}=VALUE`, or in [options] of a machine.toml.", texts.join("\n"))
    })
}
