//! Where a submission's timestamps are written.

/// A set of timestamps holds 4096, two a pass.
pub(crate) const PASSES_A_SUBMISSION: usize = 1024;
/// Bytes of one.
pub(crate) const TIMESTAMP: u64 = size_of::<u64>() as u64;

/// Timestamps of one submission.
pub(crate) struct Timestamps {
    pub(crate) queries: wgpu::QuerySet,
    pub(crate) resolved: wgpu::Buffer,
}

impl Timestamps {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let count = 2 * PASSES_A_SUBMISSION as u32;
        let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("timestamps"),
            ty: wgpu::QueryType::Timestamp,
            count,
        });
        let resolved = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("timestamps"),
            size: u64::from(count) * TIMESTAMP,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        Self { queries, resolved }
    }

    /// At the beginning and the end of a pass.
    pub(crate) fn around(&self, pass: usize) -> wgpu::ComputePassTimestampWrites<'_> {
        let first = 2 * pass as u32;
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + 1),
        }
    }
}
