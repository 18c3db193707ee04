use std::collections::BTreeMap;

use serde::Serialize;

/// The adapter as results record it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AdapterReport {
    /// As the driver names it.
    pub name: String,
    /// PCI vendor id.
    pub vendor: u32,
    /// `DiscreteGpu`, `Cpu`, …
    pub device_type: String,
    /// `Vulkan`, `Metal`, …
    pub backend: String,
    /// Driver name.
    pub driver: String,
    /// Driver version and build.
    pub driver_info: String,
    /// The limits that bound pictures and light counts here.
    pub limits: BTreeMap<&'static str, u64>,
}

impl AdapterReport {
    pub(crate) fn new(info: &wgpu::AdapterInfo, limits: &wgpu::Limits) -> Self {
        let limits = BTreeMap::from([
            ("max_buffer_size", limits.max_buffer_size),
            ("max_storage_buffer_binding_size", limits.max_storage_buffer_binding_size),
            ("max_uniform_buffer_binding_size", limits.max_uniform_buffer_binding_size),
            ("max_texture_dimension_2d", limits.max_texture_dimension_2d.into()),
            (
                "max_compute_workgroups_per_dimension",
                limits.max_compute_workgroups_per_dimension.into(),
            ),
        ]);
        Self {
            name: info.name.clone(),
            vendor: info.vendor,
            device_type: format!("{:?}", info.device_type),
            backend: format!("{:?}", info.backend),
            driver: info.driver.clone(),
            driver_info: info.driver_info.clone(),
            limits,
        }
    }
}
