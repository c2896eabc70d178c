//! Arguments of `filpost studio`.

use std::path::PathBuf;

use clap::Args;

/// Arguments of `filpost studio`.
#[derive(Debug, Args)]
#[command(
    after_long_help = "The page works on this computer only, for anyone who has its address, and opens only the files in the \
    folder. It ends with Ctrl-C, or when you close its page."
)]
pub struct StudioArgs {
    /// Folder of the post: machine.toml, post.fil, cases; it is made if it is not there
    #[arg(default_value = ".")]
    pub folder: PathBuf,
    /// Port to listen on; 0 takes any that is free
    #[arg(long, default_value_t = 0)]
    pub port: u16,
    /// Print the address and open no browser
    #[arg(long)]
    pub no_open: bool,
}
