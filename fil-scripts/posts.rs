//! The posts that come with filpost: each folder of `posts/`, as texts.
//!
//! **Goal.** A first program for the control at hand, and a base for a machine of your own.
//!
//! **Model.** They are data: [`filpost`](https://crates.io/crates/filpost) reads and runs them. A
//! [`ReadyPost`] is a name, a `machine.toml` and a README that says what is assumed of the control.
//!
//! **Quick start.**
//!
//! ```
//! let post = filpost_posts::find("Haas-Mill").expect("a ready post");
//! assert!(post.machine.contains("[address]"));
//! assert!(post.readme().starts_with("# haas-mill"));
//! ```
//!
//! **Limits.** A ready post is made from manuals and judged by a checker, not by your machine: read
//! its README and dry-run the first program.

/// A ready post: the files of its folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadyPost {
    /// Name of the folder.
    pub name: &'static str,
    /// Text of `machine.toml`.
    pub machine: &'static str,
}

macro_rules! ready {
    ($($name:literal),* $(,)?) => {
        /// All ready posts.
        pub const READY: &[ReadyPost] = &[$(ReadyPost {
            name: $name,
            machine: include_str!(concat!("posts/", $name, "/machine.toml")),
        },)*];

        // Beside the table, so that a program that shows no README carries none.
        const READMES: &[(&str, &str)] =
            &[$(($name, include_str!(concat!("posts/", $name, "/README.md"))),)*];
    };
}

ready![
    "brother-mill",
    "centroid-mill",
    "dn-mill-turn",
    "fanuc-5x-head",
    "fanuc-5x-tables",
    "fanuc-lathe",
    "fanuc-mill",
    "fanuc-mill-a",
    "fanuc-mill-b",
    "fanuc-mill-turn",
    "fluidnc",
    "grbl",
    "haas-lathe",
    "haas-lathe-y",
    "haas-mill",
    "haas-mill-a",
    "haas-trunnion",
    "haas-trunnion-tcpc",
    "heidenhain-5x",
    "heidenhain-tnc640",
    "hurco-mill",
    "linuxcnc-5x",
    "linuxcnc-lathe",
    "linuxcnc-mill",
    "mach3-mill",
    "mach4-mill",
    "marlin-mill",
    "masso-mill",
    "mazak-5x",
    "mazak-mill",
    "mitsubishi-mill",
    "okuma-lathe",
    "okuma-mill",
    "robodrill-5x",
    "robodrill-a",
    "sinumerik-5x",
    "sinumerik-828d",
    "sinumerik-840d",
    "sinumerik-lathe",
    "sinumerik-mill-turn",
    "syntec-mill",
    "tormach-mill",
    "uccnc-mill",
];

impl ReadyPost {
    /// Text of `README.md`: what the post assumes of its control, and what it refuses.
    pub fn readme(&self) -> &'static str {
        READMES.iter().find(|(name, _)| *name == self.name).map_or("", |(_, text)| text)
    }
}

/// The ready post of a name; letters in any case.
pub fn find(name: &str) -> Option<&'static ReadyPost> {
    READY.iter().find(|post| post.name.eq_ignore_ascii_case(name))
}

/// The example of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::fs;

    use super::*;

    #[test]
    fn each_folder_is_a_post() {
        let folders = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/posts")).unwrap();
        let folders: BTreeSet<String> =
            folders.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        let posts: BTreeSet<String> = READY.iter().map(|post| post.name.to_string()).collect();
        assert_eq!(posts, folders);
    }

    #[test]
    fn each_post_has_its_own_readme() {
        for post in READY {
            let heading = format!("# {}\n", post.name);
            assert!(post.readme().starts_with(&heading), "{}", post.name);
        }
    }

    #[test]
    fn names_are_found_in_any_case() {
        assert_eq!(find("FANUC-Mill").map(|post| post.name), Some("fanuc-mill"));
        assert_eq!(find("fanuc"), None);
    }
}
