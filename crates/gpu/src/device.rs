use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock};

use crate::pipeline::{Binding, Kernel};
use crate::timestamps::Timestamps;
use crate::{AdapterReport, Error, Limits};

/// An open adapter. Clones share it.
#[derive(Clone)]
pub struct Gpu {
    pub(crate) shared: Arc<Shared>,
}

/// By their WGSL and their bindings.
type Kernels = HashMap<(String, Vec<Binding>), Arc<Kernel>>;

pub(crate) struct Shared {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) report: AdapterReport,
    pub(crate) opened_with: Limits,
    pub(crate) limits: wgpu::Limits,
    /// Where timestamps tell the time of a pass. Those of llvmpipe do not: it runs a dispatch at
    /// once and both timestamps later, when its rasteriser is flushed.
    pub(crate) timestamps: Option<Mutex<Timestamps>>,
    /// Where read-backs land; grows with the largest.
    pub(crate) staging: Mutex<Option<wgpu::Buffer>>,
    /// llvmpipe compiles at the first dispatch of a pipeline, so a pipeline
    /// that was warmed up must be the one that is timed.
    pub(crate) kernels: Mutex<Kernels>,
    pub(crate) visibility: OnceLock<wgpu::RenderPipeline>,
}

impl Gpu {
    /// Opens the adapter whose name contains `adapter` (case-insensitive); without it the one named by
    /// `WGPU_ADAPTER_NAME`, else the first of: discrete, integrated, any; with the limits that
    /// `MANYLIGHTS_LIMITS` names.
    ///
    /// # Errors
    /// No adapter, none of that name (those that exist are listed), unknown limits, or it refuses a
    /// device.
    pub fn new(adapter: Option<&str>) -> Result<Self, Error> {
        Self::with_limits(adapter, Limits::of_environment()?)
    }

    /// The same with limits of the caller.
    ///
    /// # Errors
    /// As [`Gpu::new`].
    pub fn with_limits(adapter: Option<&str>, opened_with: Limits) -> Result<Self, Error> {
        let instance =
            wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
        let wanted = adapter.map(str::to_owned).or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok());
        let adapter = choose(adapters, wanted.as_deref())?;
        let info = adapter.get_info();
        let timestamps = info.device_type != wgpu::DeviceType::Cpu
            && adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let limits = opened_with.of(&adapter);
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("manylights"),
            required_features: if timestamps {
                wgpu::Features::TIMESTAMP_QUERY
            } else {
                wgpu::Features::empty()
            },
            required_limits: limits.clone(),
            ..Default::default()
        });
        let (device, queue) = pollster::block_on(request)
            .map_err(|e| Error::new(format!("adapter `{}` gave no device: {e}", info.name)))?;
        let report = AdapterReport::new(&info, &limits);
        let shared = Shared {
            timestamps: timestamps.then(|| Mutex::new(Timestamps::new(&device))),
            staging: Mutex::default(),
            device,
            queue,
            report,
            opened_with,
            limits,
            kernels: Mutex::default(),
            visibility: OnceLock::new(),
        };
        Ok(Self { shared: Arc::new(shared) })
    }

    /// Name, driver and limits, for the provenance of results.
    pub fn report(&self) -> &AdapterReport {
        &self.shared.report
    }

    pub(crate) fn device(&self) -> &wgpu::Device {
        &self.shared.device
    }

    /// # Errors
    /// One line where `what` needs more than is allowed, in `unit`; `mend` says what to do about it.
    pub(crate) fn fits(
        &self,
        what: &str,
        [needed, allowed]: [u64; 2],
        unit: &str,
        mend: &str,
    ) -> Result<(), Error> {
        if needed <= allowed {
            return Ok(());
        }
        let (under, or_more) = match self.shared.opened_with {
            Limits::Adapter => ("", ", or another adapter"),
            Limits::Default => {
                (" under MANYLIGHTS_LIMITS=default", ", or the adapter's own limits")
            }
        };
        Err(Error::new(format!(
            "{what} needs {needed} {unit} and `{}`{under} allows {allowed}: {mend}{or_more}",
            self.report().name
        )))
    }

    /// Runs `work` and turns any validation or memory error of the device into an [`Error`].
    pub(crate) fn checked<T>(&self, what: &str, work: impl FnOnce() -> T) -> Result<T, Error> {
        let memory = self.device().push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device().push_error_scope(wgpu::ErrorFilter::Validation);
        let value = work();
        let invalid = pollster::block_on(validation.pop());
        let exhausted = pollster::block_on(memory.pop());
        match invalid.or(exhausted) {
            Some(error) => Err(Error::new(format!("{what}: {error}"))),
            None => Ok(value),
        }
    }
}

fn choose(adapters: Vec<wgpu::Adapter>, wanted: Option<&str>) -> Result<wgpu::Adapter, Error> {
    let names: Vec<_> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let rank = |adapter: &wgpu::Adapter| match adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        _ => 2,
    };
    let matches = |adapter: &wgpu::Adapter| {
        wanted.is_none_or(|wanted| {
            adapter.get_info().name.to_lowercase().contains(&wanted.to_lowercase())
        })
    };
    adapters.into_iter().filter(matches).min_by_key(rank).ok_or_else(|| match wanted {
        Some(wanted) if !names.is_empty() => {
            Error::new(format!("no adapter named `{wanted}`: there are {}", names.join(", ")))
        }
        _ => Error::new(
            "no GPU adapter: install a Vulkan driver (on Debian or Ubuntu without a GPU: \
             mesa-vulkan-drivers and libvulkan1; scripts/bench does it)",
        ),
    })
}
