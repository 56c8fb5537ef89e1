//! Timestamp queries around the passes of a frame.

use super::Gpu;
use crate::{FrameTime, PassTime, Result, passes::Tracing};

/// Queries for a fixed list of passes; does nothing if the adapter has no timestamps or not enough queries.
pub struct Timer {
    passes: Vec<(&'static str, Tracing)>,
    queries: Option<Queries>,
}

struct Queries {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Nanoseconds per tick of the timestamp counter.
    period: f32,
}

impl Timer {
    /// Creates queries for passes of these names and classes, in order of execution.
    ///
    /// # Errors
    /// The device is out of memory.
    pub fn new(gpu: &Gpu, passes: Vec<(&'static str, Tracing)>) -> Result<Self> {
        let count = 2 * passes.len() as u32;
        let timed = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let queries = if timed && count <= wgpu::QUERY_SET_MAX_QUERIES {
            Some(gpu.checked("the timer", Some(8 * u64::from(count)), |device| Queries {
                set: device.create_query_set(&wgpu::QuerySetDescriptor {
                    label: Some("timer"),
                    ty: wgpu::QueryType::Timestamp,
                    count,
                }),
                resolved: device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("timer"),
                    size: u64::from(count) * 8,
                    usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                    mapped_at_creation: false,
                }),
                period: gpu.queue.get_timestamp_period(),
            })?)
        } else {
            None
        };
        Ok(Self { passes, queries })
    }

    /// Begins the compute pass with this index, between timestamps.
    pub fn pass<'e>(&self, encoder: &'e mut wgpu::CommandEncoder, index: usize) -> wgpu::ComputePass<'e> {
        self.part(encoder, index, [true, true])
    }

    /// Begins one dispatch of the pass with this index, which may be the first and may be the last. A pass lasts
    /// from the beginning of its first dispatch to the end of its last one, gaps included, as the frame waits for
    /// those as well.
    pub fn part<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        index: usize,
        [first, last]: [bool; 2],
    ) -> wgpu::ComputePass<'e> {
        let queries = self.queries.as_ref().filter(|_| first || last);
        let timestamp_writes = queries.map(|queries| wgpu::ComputePassTimestampWrites {
            query_set: &queries.set,
            beginning_of_pass_write_index: first.then_some(2 * index as u32),
            end_of_pass_write_index: last.then_some(2 * index as u32 + 1),
        });
        encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(self.passes[index].0),
            timestamp_writes,
        })
    }

    /// Resolves the queries and copies them for readback; call it after the last pass.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(queries) = &self.queries {
            encoder.resolve_query_set(&queries.set, 0..2 * self.passes.len() as u32, &queries.resolved, 0);
        }
    }

    /// GPU times of the last completed frame, with passes of the same name added up; empty without timestamps.
    ///
    /// # Errors
    /// The device failed.
    pub fn read(&self, gpu: &Gpu) -> Result<FrameTime> {
        let Some(queries) = &self.queries else { return Ok(FrameTime::default()) };
        let bytes = gpu.read_buffer(&queries.resolved)?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let ms = |from: u64, to: u64| to.saturating_sub(from) as f64 * f64::from(queries.period) * 1e-6;
        let mut passes: Vec<PassTime> = Vec::new();
        for (&(name, tracing), t) in self.passes.iter().zip(ticks.chunks_exact(2)) {
            let ms = ms(t[0], t[1]);
            match passes.iter_mut().find(|pass| pass.name == name) {
                Some(pass) => pass.ms += ms,
                None => passes.push(PassTime { name, tracing, ms }),
            }
        }
        Ok(FrameTime {
            ms: ms(ticks.first().copied().unwrap_or(0), ticks.last().copied().unwrap_or(0)),
            passes,
        })
    }
}
