use bytemuck::Pod;

use crate::{Buffer, Error, Gpu};

/// Records that all lanes read alike, in uniform memory: batches behind dynamic offsets.
///
/// On lavapipe a gather over lights in a uniform buffer is ten times as fast as over the same lights
/// in a storage buffer, and NVIDIA's constant cache wants the same. Each batch is laid out as
/// `struct { count: u32, (padding to 16 bytes), records: array<T, CAPACITY> }`; the guaranteed 64 KiB
/// binding size bounds the capacity.
pub struct UniformBatches {
    pub(crate) buffer: Buffer,
    pub(crate) stride: u32,
    pub(crate) batch_size: u64,
    counts: Vec<u32>,
}

impl UniformBatches {
    /// Bytes before the records.
    const HEADER: usize = 16;

    /// Lays out `records` in order, `most` a batch, in batches that have room for `capacity`. No
    /// records: one batch of count 0.
    ///
    /// # Errors
    /// Where a batch or all of them exceed what the adapter holds.
    ///
    /// # Panics
    /// Where the record is no multiple of 16 bytes or `most` is not in
    /// 1..=`capacity`.
    pub fn new<T: Pod>(
        gpu: &Gpu,
        label: &str,
        records: &[T],
        capacity: usize,
        most: usize,
    ) -> Result<Self, Error> {
        let batch_size = Self::HEADER + capacity * size_of::<T>();
        assert!(size_of::<T>().is_multiple_of(16), "uniform arrays have a stride of 16 bytes");
        assert!((1..=capacity).contains(&most), "{most} records in a batch of {capacity}");
        let batches = records.len().div_ceil(most).max(1);
        let stride = stride(gpu, label, batch_size, batches)?;
        let mut bytes = vec![0_u8; batches * stride];
        let mut counts = vec![0; batches];
        for (index, chunk) in records.chunks(most).enumerate() {
            let batch = &mut bytes[index * stride..];
            counts[index] = chunk.len() as u32;
            batch[..4].copy_from_slice(&counts[index].to_le_bytes());
            let data: &[u8] = bytemuck::cast_slice(chunk);
            batch[Self::HEADER..][..data.len()].copy_from_slice(data);
        }
        let buffer = gpu.filled(label, &bytes, wgpu::BufferUsages::UNIFORM)?;
        Ok(Self { buffer, stride: stride as u32, batch_size: batch_size as u64, counts })
    }

    /// Batches of zeros, of `size` bytes each, that kernels fill: [`Self::buffer`] is their memory.
    ///
    /// # Errors
    /// Where a batch or all of them exceed what the adapter holds.
    pub fn zeroed(gpu: &Gpu, label: &str, size: usize, count: usize) -> Result<Self, Error> {
        let stride = stride(gpu, label, size, count)?;
        let buffer = gpu.made(label, (count * stride) as u64, wgpu::BufferUsages::UNIFORM)?;
        let counts = vec![0; count];
        Ok(Self { buffer, stride: stride as u32, batch_size: size as u64, counts })
    }

    /// All batches, [`Self::stride`] bytes each.
    pub fn buffer(&self) -> &Buffer {
        &self.buffer
    }

    /// Bytes from the start of a batch to that of the next.
    pub fn stride(&self) -> usize {
        self.stride as usize
    }

    /// Records in each batch.
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }
}

/// Bytes from batch to batch.
fn stride(gpu: &Gpu, label: &str, batch_size: usize, batches: usize) -> Result<usize, Error> {
    let limits = &gpu.shared.limits;
    let bindable = limits.max_uniform_buffer_binding_size;
    let mend = "make batches of fewer records";
    gpu.fits(&format!("a batch of {label}"), [batch_size as u64, bindable], "bytes", mend)?;
    let stride = batch_size.next_multiple_of(limits.min_uniform_buffer_offset_alignment as usize);
    // Offsets of batches have 32 bits.
    let largest = limits.max_buffer_size.min(u32::MAX.into());
    gpu.fits(label, [(batches * stride) as u64, largest], "bytes", "choose fewer lights")?;
    Ok(stride)
}
