//! What the device is opened for.

use crate::Error;

/// The limits that a device is opened with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Limits {
    /// All that the adapter offers.
    #[default]
    Adapter,
    /// Those that WebGPU guarantees on every adapter: 128 MiB a storage binding, 64 KiB a uniform one,
    /// eight storage buffers a kernel, maps of 8192 texels.
    Default,
}

impl Limits {
    const VARIABLE: &'static str = "MANYLIGHTS_LIMITS";

    /// As `MANYLIGHTS_LIMITS` says: `default`, or nothing for those of the adapter.
    ///
    /// # Errors
    /// Another value.
    pub fn of_environment() -> Result<Self, Error> {
        match std::env::var_os(Self::VARIABLE) {
            None => Ok(Self::Adapter),
            Some(value) if value.is_empty() => Ok(Self::Adapter),
            Some(value) if value == "default" => Ok(Self::Default),
            Some(value) => Err(Error::new(format!(
                "{}={}: set it to `default`, or not at all for the adapter's own limits",
                Self::VARIABLE,
                value.display()
            ))),
        }
    }

    pub(crate) fn of(self, adapter: &wgpu::Adapter) -> wgpu::Limits {
        match self {
            Self::Adapter => adapter.limits(),
            Self::Default => wgpu::Limits::default(),
        }
    }
}
