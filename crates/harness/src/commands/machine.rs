//! Options of commands that render.

use std::path::PathBuf;

use clap::Args;

/// Where things are on this machine.
#[derive(Args)]
pub(crate) struct Machine {
    /// Adapter whose name contains this
    #[arg(long, value_name = "NAME", env = "WGPU_ADAPTER_NAME")]
    pub(crate) adapter: Option<String>,
    /// Folder of the scene files' glTF assets
    #[arg(long, value_name = "DIR", env = "MANYLIGHTS_ASSETS")]
    pub(crate) assets: Option<PathBuf>,
}
