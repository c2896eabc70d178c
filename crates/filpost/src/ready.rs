//! The posts that come with the crate: folders of `fil-scripts/posts/`.

use fil_nc::dialect::Family;

pub use filpost_posts::{READY, ReadyPost, find};

/// The post for a CL file that names none and is for a mill.
pub const GENERIC_MILL: &str = "fanuc-mill";

/// The post for a CL file that names none and is for a lathe.
pub const GENERIC_LATHE: &str = "fanuc-lathe";

#[doc(hidden)]
/// The post for an NC program whose machine nobody names, by the family that its text is of.
pub fn generic_for(family: Family) -> &'static str {
    match family {
        Family::WordAddress => GENERIC_MILL,
        Family::Klartext => "heidenhain-tnc640",
        Family::Sinumerik => "sinumerik-840d",
    }
}
