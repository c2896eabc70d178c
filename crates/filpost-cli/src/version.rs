//! What `filpost --version` says: which source made this command, and for what.

use std::env::consts::{ARCH, OS};
use std::sync::LazyLock;

/// Version and build facts, a line each. The same source, built in the same way, gives the
/// same text: there is no date in it.
pub static LONG: LazyLock<String> = LazyLock::new(|| {
    // A release tells the compiler its commit; other builds would be made anew for each one.
    let commit = option_env!("FILPOST_COMMIT").unwrap_or("not told to the build");
    let optimized = if cfg!(debug_assertions) { "debug" } else { "release" };
    format!(
        "{}\ncommit: {commit}\ntarget: {ARCH}-{OS}{}\nbuild: {optimized}{}",
        env!("CARGO_PKG_VERSION"),
        environment(),
        if cfg!(target_feature = "crt-static") { ", static" } else { "" },
    )
});

/// The C library the target stands on, as targets name it.
fn environment() -> &'static str {
    match () {
        () if cfg!(target_env = "gnu") => "-gnu",
        () if cfg!(target_env = "musl") => "-musl",
        () if cfg!(target_env = "msvc") => "-msvc",
        () => "",
    }
}
