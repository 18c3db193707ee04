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
        self.allowed(label, size)?;
        let raw = self.checked(label, || {
            self.device().create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size.max(16),
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        })?;
        Ok(Buffer { raw })
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
        let size = buffer.size();
        let staging = self.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.device().create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&buffer.raw, 0, &staging, 0, size);
        self.shared.queue.submit([encoder.finish()]);
        let bytes = self.mapped(&staging)?;
        let whole = bytes.len() / size_of::<T>() * size_of::<T>();
        Ok(bytemuck::pod_collect_to_vec(&bytes[..whole]))
    }

    pub(crate) fn mapped(&self, staging: &wgpu::Buffer) -> Result<Vec<u8>, Error> {
        let (sender, receiver) = std::sync::mpsc::channel();
        staging.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver waits below; it can only be gone after a panic there.
            let _ = sender.send(result);
        });
        self.wait()?;
        let failed = |e: String| Error::new(format!("read-back: {e}"));
        receiver.recv().map_err(|e| failed(e.to_string()))?.map_err(|e| failed(e.to_string()))?;
        let view = staging.get_mapped_range(..).map_err(|e| failed(e.to_string()))?;
        Ok(view.to_vec())
    }

    pub(crate) fn wait(&self) -> Result<(), Error> {
        self.device()
            .poll(wgpu::PollType::wait_indefinitely())
            .map(|_| ())
            .map_err(|e| Error::new(format!("waiting for the adapter: {e}")))
    }

    fn allowed(&self, label: &str, size: u64) -> Result<(), Error> {
        let limits = &self.shared.limits;
        let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if size <= most {
            return Ok(());
        }
        Err(Error::new(format!(
            "{label} needs {size} bytes and `{}` binds at most {most}: choose a lower resolution \
             or another adapter",
            self.report().name
        )))
    }
}
