//! The posts inside the crate: folders of `fil-scripts/posts/`.

use fil_nc::dialect::Family;

/// A ready post: the files of its folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadyPost {
    /// Name of the folder.
    pub name: &'static str,
    /// Text of `machine.toml`.
    pub machine: &'static str,
    /// Text of `README.md`.
    pub readme: &'static str,
}

macro_rules! ready {
    ($($name:literal),* $(,)?) => {
        &[$(ReadyPost {
            name: $name,
            machine: include_str!(concat!("../../../fil-scripts/posts/", $name, "/machine.toml")),
            readme: include_str!(concat!("../../../fil-scripts/posts/", $name, "/README.md")),
        },)*]
    };
}

/// All ready posts.
pub const READY: &[ReadyPost] = ready![
    "brother-mill",
    "fanuc-5x-head",
    "fanuc-5x-tables",
    "fanuc-lathe",
    "fanuc-mill",
    "fanuc-mill-a",
    "fanuc-mill-b",
    "fanuc-mill-turn",
    "grbl",
    "haas-lathe",
    "haas-mill",
    "haas-trunnion",
    "haas-trunnion-tcpc",
    "heidenhain-5x",
    "heidenhain-tnc640",
    "linuxcnc-5x",
    "linuxcnc-lathe",
    "linuxcnc-mill",
    "mach3-mill",
    "mach4-mill",
    "mazak-mill",
    "mitsubishi-mill",
    "okuma-lathe",
    "okuma-mill",
    "sinumerik-5x",
    "sinumerik-840d",
    "sinumerik-lathe",
];

/// The post for a CL file that names none and is for a mill.
pub const GENERIC_MILL: &str = "fanuc-mill";

/// The post for a CL file that names none and is for a lathe.
pub const GENERIC_LATHE: &str = "fanuc-lathe";

/// The post for an NC program whose machine nobody names, by the family that its text is of.
pub fn generic_for(family: Family) -> &'static str {
    match family {
        Family::WordAddress => GENERIC_MILL,
        Family::Klartext => "heidenhain-tnc640",
        Family::Sinumerik => "sinumerik-840d",
    }
}

/// The ready post of a name; letters in any case.
pub fn find(name: &str) -> Option<&'static ReadyPost> {
    READY.iter().find(|post| post.name.eq_ignore_ascii_case(name))
}
