//! The adapter's clock, and what comes back from it. Queries and read-back memory live as long as the
//! adapter: making them anew takes longer than a small pass.

use std::sync::{Mutex, MutexGuard};
use std::time::Instant;

use crate::timestamps::{PASSES_A_SUBMISSION, TIMESTAMP, Timestamps};
use crate::{Error, Gpu};

impl Gpu {
    /// Encodes `passes` passes, submits them, waits, and returns the seconds of each.
    ///
    /// # Errors
    /// Where a pass is invalid or the device was lost.
    pub(crate) fn timed(
        &self,
        passes: usize,
        encode: impl Fn(&mut wgpu::CommandEncoder, usize, Option<wgpu::ComputePassTimestampWrites<'_>>),
    ) -> Result<Vec<f64>, Error> {
        let mut seconds = Vec::with_capacity(passes);
        if let Some(timestamps) = &self.shared.timestamps {
            // One submission at a time writes them.
            let timestamps = locked(timestamps);
            for first in (0..passes).step_by(PASSES_A_SUBMISSION) {
                let end = passes.min(first + PASSES_A_SUBMISSION);
                seconds.extend(self.timed_by_adapter(
                    &timestamps,
                    end - first,
                    |encoder, index| {
                        encode(encoder, first + index, Some(timestamps.around(index)));
                    },
                )?);
            }
            return Ok(seconds);
        }
        for index in 0..passes {
            let mut encoder = self.device().create_command_encoder(&Default::default());
            let commands = self.checked("pass", || {
                encode(&mut encoder, index, None);
                encoder.finish()
            })?;
            let start = Instant::now();
            self.checked("pass", || self.shared.queue.submit([commands]))?;
            self.wait()?;
            seconds.push(start.elapsed().as_secs_f64());
        }
        Ok(seconds)
    }

    fn timed_by_adapter(
        &self,
        timestamps: &Timestamps,
        passes: usize,
        encode: impl Fn(&mut wgpu::CommandEncoder, usize),
    ) -> Result<Vec<f64>, Error> {
        let mut encoder = self.device().create_command_encoder(&Default::default());
        let size = 2 * passes as u64 * TIMESTAMP;
        self.checked("passes", || {
            for index in 0..passes {
                encode(&mut encoder, index);
            }
            let Timestamps { queries, resolved } = timestamps;
            encoder.resolve_query_set(queries, 0..2 * passes as u32, resolved, 0);
        })?;
        let ticks: Vec<u64> = self.read_back(encoder, &timestamps.resolved, size)?;
        let period = f64::from(self.shared.queue.get_timestamp_period()) * 1e-9;
        let seconds = |pair: &[u64]| pair[1].saturating_sub(pair[0]) as f64 * period;
        Ok(ticks.chunks_exact(2).map(seconds).collect())
    }

    /// Submits `encoder` and gives the first `size` bytes of `source` once all work has ended.
    ///
    /// # Errors
    /// Where the work is invalid or the device was lost.
    pub(crate) fn read_back<T: bytemuck::Pod>(
        &self,
        mut encoder: wgpu::CommandEncoder,
        source: &wgpu::Buffer,
        size: u64,
    ) -> Result<Vec<T>, Error> {
        let mut kept = locked(&self.shared.staging);
        // A failure leaves none, since it may leave it mapped.
        let staging = match kept.take() {
            Some(staging) if staging.size() >= size => staging,
            _ => self.checked("read-back", || {
                self.device().create_buffer(&wgpu::BufferDescriptor {
                    label: Some("read-back"),
                    size,
                    usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                })
            })?,
        };
        self.checked("read-back", || {
            encoder.copy_buffer_to_buffer(source, 0, &staging, 0, size);
            self.shared.queue.submit([encoder.finish()])
        })?;
        let (sender, receiver) = std::sync::mpsc::channel();
        staging.map_async(wgpu::MapMode::Read, ..size, move |result| {
            // The receiver waits below; it can only be gone after a panic there.
            let _ = sender.send(result);
        });
        self.wait()?;
        let failed = |e: String| Error::new(format!("read-back: {e}"));
        receiver.recv().map_err(|e| failed(e.to_string()))?.map_err(|e| failed(e.to_string()))?;
        let values = {
            let view = staging.get_mapped_range(..size).map_err(|e| failed(e.to_string()))?;
            let whole = view.len() / size_of::<T>() * size_of::<T>();
            bytemuck::pod_collect_to_vec(&view[..whole])
        };
        staging.unmap();
        *kept = Some(staging);
        Ok(values)
    }

    fn wait(&self) -> Result<(), Error> {
        self.device()
            .poll(wgpu::PollType::wait_indefinitely())
            .map(|_| ())
            .map_err(|e| Error::new(format!("waiting for the adapter: {e}")))
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|poison| poison.into_inner())
}
