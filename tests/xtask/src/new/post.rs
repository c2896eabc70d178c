//! `cargo xtask new-post`.

use super::tree::{Tree, with_line};

/// Write the skeleton of a ready post
#[derive(clap::Args)]
pub struct Args {
    /// Its name, such as haas-mill
    pub name: String,
    /// The ready post that it begins from
    #[arg(long, default_value = "fanuc-mill")]
    pub base: String,
}

/// Writes the files.
///
/// # Errors
/// A name with other signs than small letters, digits and hyphens; a post that is there.
pub fn write(tree: &mut Tree, args: &Args) -> Result<String, String> {
    let Args { name, base } = args;
    let is_plain = |sign: char| sign.is_ascii_lowercase() || sign.is_ascii_digit() || sign == '-';
    if name.is_empty() || !name.chars().all(is_plain) {
        return Err(format!("`{name}`: a name has small letters, digits and hyphens"));
    }
    let Some(begins_from) = filpost::ready::find(base) else {
        return Err(format!("there is no ready post {base}"));
    };
    let folder = format!("fil-scripts/posts/{name}");
    // A ready post has all its settings: what changes in the base is no change of it.
    let named = |line: &str| match line.starts_with("name = ") {
        true => format!("name = \"{name}\"\n"),
        false => format!("{line}\n"),
    };
    let machine: String = begins_from.machine.lines().map(named).collect();
    tree.create(&format!("{folder}/machine.toml"), &machine)?;
    let row = format!("    \"{name}\",");
    tree.change("fil-scripts/posts.rs", |text| with_line(text, "ready![", "    \"", &row))?;
    let row = format!("| `{name}` | which machines and controls |");
    tree.change("docs/machine.md", |text| with_line(text, "| `brother-mill` |", "| `", &row))?;
    let cases = "corpus/posts";
    let case = tree.read(&format!("{cases}/{base}/production/case.toml"))?;
    tree.create(&format!("{folder}/README.md"), &readme(name, base, part(&case)))?;
    let case = case.replace(&format!("ready = \"{base}\""), &format!("ready = \"{name}\""));
    tree.create(&format!("{cases}/{name}/production/case.toml"), &case)?;
    Ok(format!(
        "{}\nTo do:\n\
         1. {folder}/machine.toml, a copy of {base}: change what differs (docs/reference/settings.md), each with its reason.\n\
         2. {folder}/README.md: what is assumed of the control, by which manual, and what is refused.\n\
         3. docs/machine.md: the machines in ten words.\n\
         4. The program: FILPOST_UPDATE=1 cargo test -p filpost-tests --test files posts/{name}; read it as the \
         operator would.\n\
         5. Its page: FILPOST_UPDATE=1 cargo test -p filpost-tests --test all reference:: puts the program there.\n\
         6. The judge: cargo test -p filpost-tests --test all verify::",
        tree.told()
    ))
}

/// Name of the CL file of a case, of those that the posts share.
fn part(case: &str) -> &str {
    let cl = case.lines().find_map(|line| line.strip_prefix("cl = \"../../cl/"));
    cl.and_then(|cl| cl.strip_suffix(".ncl\"")).unwrap_or("mill-two-tools")
}

fn readme(name: &str, base: &str, part: &str) -> String {
    format!(
        "# {name}\n\nFor which machines and controls; by which manual.\n\nIt began as a copy of `{base}`.\n\n## Assumed\n\n\
         - What the control must have set.\n\n## Refused\n\n- What this post does not do.\n\n\
         ## Its program\n\n`corpus/posts/cl/{part}.ncl` as the post writes it:\n\n```nc\n```\n\n\
         ![The path of {part}](../../../docs/paths/{part}.svg)\n"
    )
}
