use bytemuck::Pod;
use wgpu::util::DeviceExt as _;

use crate::{Error, Gpu};

/// Memory on the adapter; a clone is the same memory.
#[derive(Clone)]
pub struct Buffer {
    pub(crate) raw: wgpu::Buffer,
}

impl Buffer {
    /// Bytes.
    pub fn size(&self) -> u64 {
        self.raw.size()
    }
}

impl Gpu {
    /// A storage buffer with the given contents (one zero element where it would be empty).
    ///
    /// # Errors
    /// Where it is larger than the adapter binds.
    pub fn storage<T: Pod>(&self, label: &str, data: &[T]) -> Result<Buffer, Error> {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let empty = vec![0_u8; size_of::<T>().next_multiple_of(4)];
        let contents = if bytes.is_empty() { &empty } else { bytes };
        self.allowed(label, contents.len() as u64)?;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        self.filled(label, contents, usage)
    }

    /// A storage buffer of zeros.
    ///
    /// # Errors
    /// Where it is larger than the adapter binds.
    pub fn zeroed(&self, label: &str, size: u64) -> Result<Buffer, Error> {
        self.made(label, size, wgpu::BufferUsages::empty())
    }

    /// The same with another usage beside.
    pub(crate) fn made(
        &self,
        label: &str,
        size: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<Buffer, Error> {
        self.allowed(label, size)?;
        let raw = self.checked(label, || {
            self.device().create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size.max(16),
                usage: usage
                    | wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })?;
        Ok(Buffer { raw })
    }

    /// Sets a buffer that was made of zeros to zeros again, after all work before.
    ///
    /// # Errors
    /// Where the device was lost.
    pub fn clear(&self, buffer: &Buffer) -> Result<(), Error> {
        self.checked("clear", || {
            let mut encoder = self.device().create_command_encoder(&Default::default());
            encoder.clear_buffer(&buffer.raw, 0, None);
            self.shared.queue.submit([encoder.finish()]);
        })
    }

    /// A uniform buffer with the given contents.
    ///
    /// # Errors
    /// Where the adapter refuses it.
    pub fn uniform<T: Pod>(&self, label: &str, data: &T) -> Result<Buffer, Error> {
        self.filled(label, bytemuck::bytes_of(data), wgpu::BufferUsages::UNIFORM)
    }

    pub(crate) fn filled(
        &self,
        label: &str,
        contents: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Result<Buffer, Error> {
        let raw = self.checked(label, || {
            self.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents,
                usage,
            })
        })?;
        Ok(Buffer { raw })
    }

    /// The contents of a storage buffer, once all work before has ended.
    ///
    /// # Errors
    /// Where the device was lost.
    pub fn read<T: Pod>(&self, buffer: &Buffer) -> Result<Vec<T>, Error> {
        let encoder = self.device().create_command_encoder(&Default::default());
        self.read_back(encoder, &buffer.raw, buffer.size())
    }

    fn allowed(&self, label: &str, size: u64) -> Result<(), Error> {
        let limits = &self.shared.limits;
        let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        self.fits(label, [size, most], "bytes", "choose a lower resolution or less work")
    }
}
