//! Records a frame's passes into command buffers and fills its uniform constants.

use crate::{
    Camera, Gpu, GpuScene, Paths, Result, Settings, Tolerances,
    device::{Bound, Kernels, Timer, mirror::gpu_struct},
    frame::plan::{Extent, Part, Rows},
    frame::targets::{DISPATCH_BYTES, LIST_HEADER, Targets},
    passes::{Clears, FrameSpec, Output, TRACE_GROUP, denoise},
};

gpu_struct! {
    /// The camera's origin and basis vectors, from which kernels generate primary rays.
    pub struct FrameCamera {
        origin: [f32; 3], orthographic: f32,
        right: [f32; 3], inverse_height: f32,
        up: [f32; 3], padding_x: u32,
        forward: [f32; 3], padding_y: u32,
        eyes: [f32; 2], padding_z: [u32; 2],
    }
}

gpu_struct! {
    /// The range of samples or list entries that one dispatch processes.
    pub struct FramePart {
        first: u32, stride: u32, row: u32, end: u32,
        turn: u32, walk: u32, step: [i32; 2],
    }
}

gpu_struct! {
    /// Tolerances of the similarity checks, thresholds of the supersampling tests, and the focused range of
    /// objects.
    pub struct FrameTolerances {
        pos: f32, norm: f32, tex: f32, gcol: f32,
        tau_primary: [f32; 4], tau_secondary: [f32; 4],
        tau_col: f32, tau_least: f32, focus_first: u32, focus_last: u32,
        quincunx_threshold: f32, padding_x: u32, padding_y: u32, padding_z: u32,
    }
}

gpu_struct! {
    /// Constants of path tracing: foveation, emitters and the index of the sample.
    pub struct FramePaths {
        gaze: [f32; 2], stop: f32, emitter_scale: f32,
        emitters: u32, sample: u32, merged: u32, padding_x: u32,
    }
}

gpu_struct! {
    /// The uniform buffer of one dispatch.
    pub struct FrameUniform {
        camera: FrameCamera, part: FramePart, tolerances: FrameTolerances, paths: FramePaths,
        background: [f32; 3], min_weight: f32,
        ambient: [f32; 3], depth: u32,
        fallback_radiance: [f32; 3], seed: u32,
        size: [u32; 2], refresh_first: u32, refresh_count: u32,
        still: u32, exposure: f32, eye_in_solid: u32, padding_z: u32,
    }
}

gpu_struct! {
    /// What the counting kernels write for each pixel; [`crate::PixelRecord`] is its decoded form.
    pub struct PixelRecord {
        origin: u32, failed: u32, cost: u32, object: u32, depth: f32, normal: u32, edges: u32, strata: u32,
    }
}

/// Bytes between consecutive [`FrameUniform`]s: a multiple of WebGPU's default alignment of uniform buffer
/// offsets.
pub const FRAME_STRIDE: u64 = size_of::<FrameUniform>().next_multiple_of(256) as u64;

impl FrameUniform {
    /// Constants of a frame of `size` pixels. The fields of a single dispatch are left at their defaults
    /// ([`in_strides`]).
    pub fn new(scene: &GpuScene, settings: &Settings, size: [u32; 2], camera: &Camera) -> Self {
        let environment = &scene.environment;
        let t = &settings.thresholds;
        let exposure = scene.exposure(settings);
        let eye_in_solid = u32::from(scene.may_be_in_solid(camera));
        let extent = settings.method.eye(size).map(|side| side as f32);
        let gaze = [0, 1].map(|axis| settings.paths.gaze[axis] * extent[axis]);
        Self {
            camera: FrameCamera {
                origin: camera.origin.into(),
                orthographic: if camera.orthographic { 1.0 } else { 0.0 },
                right: camera.right.into(),
                inverse_height: 1.0 / size[1] as f32,
                up: camera.up.into(),
                forward: camera.forward.into(),
                eyes: eyes(&settings.paths, camera),
                ..Default::default()
            },
            part: FramePart::default(),
            tolerances: FrameTolerances {
                // Interpolated samples know no medium around the camera: all are traced.
                pos: if eye_in_solid == 0 { settings.tolerances.pos * scene.longest_side() } else { 0.0 },
                norm: settings.tolerances.norm,
                tex: settings.tolerances.tex,
                gcol: settings.tolerances.gcol,
                tau_primary: [t.poid, t.psn, t.psc, t.pte],
                tau_secondary: [t.soid, t.ssn, t.ssc, t.ste],
                tau_col: t.col,
                tau_least: t.values().into_iter().fold(1.0, f32::min),
                // Shifted by one like stored OIDs, where 0 means no hit; a miss is only in focus without a
                // focused range.
                focus_first: settings.focus.map_or(0, |focus| focus.first.saturating_add(1)),
                focus_last: settings.focus.map_or(u32::MAX, |focus| focus.last.saturating_add(1)),
                quincunx_threshold: settings.quincunx_threshold,
                ..Default::default()
            },
            paths: FramePaths {
                gaze,
                stop: settings.paths.foveation_max / farthest(gaze, extent),
                emitter_scale: scene.emitter_scale,
                emitters: scene.emitter_count,
                ..Default::default()
            },
            background: (exposure * environment.background).into(),
            min_weight: settings.min_weight,
            ambient: (exposure * environment.ambient).into(),
            depth: settings.depth,
            fallback_radiance: (exposure * environment.fallback_radiance).into(),
            exposure,
            seed: settings.seed,
            size,
            eye_in_solid,
            ..Default::default()
        }
    }
}

/// Offset of each eye from the camera along its right vector, and the horizontal shift of each eye's image
/// towards the convergence distance; both in lengths of the right vector.
fn eyes(paths: &Paths, camera: &Camera) -> [f32; 2] {
    let [right, forward] = [camera.right, camera.forward].map(|axis| axis.as_dvec3().length());
    let aside = 0.5 * f64::from(paths.eye_distance) / right;
    [aside, paths.convergence.map_or(0.0, |distance| aside * forward / f64::from(distance))].map(|x| x as f32)
}

/// Distance in pixels from the gaze to the farthest corner of one eye's image of `extent` pixels.
fn farthest(gaze: [f32; 2], extent: [f32; 2]) -> f32 {
    let [x, y] = [0, 1].map(|axis| gaze[axis].abs().max((extent[axis] - gaze[axis]).abs()));
    x.hypot(y)
}

/// The compiled kernels of a frame with their bindings and timestamps.
pub struct Passes {
    /// Bindings of every part of the plan, once for each history buffer that is written.
    bound: [Vec<Bound>; 2],
    timer: Timer,
}

impl Passes {
    /// Links, compiles and binds the kernels. `color` receives the colours, `inspection` the counters and
    /// records.
    pub fn new(
        gpu: &Gpu,
        scene: &GpuScene,
        targets: &Targets,
        spec: &FrameSpec,
        kernels: &mut Kernels,
        color: &wgpu::Texture,
        inspection: Option<&wgpu::Buffer>,
    ) -> Result<Self> {
        let passes = targets.plan.passes();
        let kernels = passes
            .iter()
            .map(|stage| kernels.get(gpu, stage.name, spec.sources(stage)))
            .collect::<Result<Vec<_>>>()?;
        let color = color.create_view(&wgpu::TextureViewDescriptor::default());
        let mut resources = scene.resources(gpu, spec.reads_lobe_albedos())?;
        resources.extend([
            ("attributes", targets.attributes.as_entire_binding()),
            ("list", targets.list.as_entire_binding()),
            ("dispatch", targets.dispatch.as_entire_binding()),
            ("samples", targets.samples.as_entire_binding()),
            ("gbuffer", targets.gbuffer.as_entire_binding()),
        ]);
        let name = match spec.output {
            Output::Display => Some("display"),
            Output::Linear => Some("linear"),
            Output::Samples | Output::Nowhere => None,
        };
        resources.extend(name.map(|name| (name, wgpu::BindingResource::TextureView(&color))));
        resources.extend(inspection.map(|buffer| ("inspection", buffer.as_entire_binding())));
        resources.push(("splats", targets.splats.as_entire_binding()));
        let bind = |side: usize, index: usize, part: &Part| {
            let mut resources = resources.clone();
            let filtered = part.filtered();
            resources.extend([
                ("atrous_buffer", targets.atrous_buffers[filtered].as_entire_binding()),
                ("atrous_buffer_before", targets.atrous_buffers[1 - filtered].as_entire_binding()),
                ("frame", targets.constants(index)),
                ("history", targets.histories[side].as_entire_binding()),
                ("history_before", targets.histories[1 - side].as_entire_binding()),
            ]);
            kernels[part.pass].bind(&gpu.device, &resources)
        };
        let bind_all = |side: usize| -> Result<Vec<_>> {
            let parts = targets.plan.parts.iter().enumerate();
            parts.map(|(index, part)| bind(side, index, part)).collect()
        };
        let [first, second] = gpu.checked("the bindings", None, |_| [0, 1].map(bind_all))?;
        let timed = passes.iter().map(|stage| (stage.name, stage.tracing)).collect();
        Ok(Self { bound: [first?, second?], timer: Timer::new(gpu, timed)? })
    }

    /// The command buffers of one frame, to be submitted in order; each is recorded when the iterator reaches it.
    /// The first one uploads the constants itself, so that a frame may be recorded before the preceding one is
    /// submitted, and clears the buffers `cleared`.
    ///
    /// # Errors
    /// The device failed.
    pub fn commands<'f>(
        &'f self,
        gpu: &'f Gpu,
        targets: &'f Targets,
        constants: &FrameUniform,
        tolerances: &Tolerances,
        side: usize,
        cleared: Vec<&'f wgpu::Buffer>,
    ) -> Result<impl ExactSizeIterator<Item = wgpu::CommandBuffer> + use<'f>> {
        let parts = in_strides(&targets.plan.parts, constants, tolerances);
        let parts = gpu.filled("constants", &parts, wgpu::BufferUsages::COPY_SRC)?;
        let submissions = targets.plan.submissions();
        let (count, refresh_count) = (submissions.len(), constants.refresh_count);
        Ok(submissions.into_iter().enumerate().map(move |(submission, of_submission)| {
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            if submission == 0 {
                encoder.copy_buffer_to_buffer(&parts, 0, &targets.frame, 0, parts.size());
                cleared.iter().for_each(|buffer| encoder.clear_buffer(buffer, 0, None));
            }
            for (index, part) in of_submission {
                self.record(&mut encoder, targets, &self.bound[side][index], &part, refresh_count);
            }
            if submission + 1 == count {
                self.timer.resolve(&mut encoder);
            }
            encoder.finish()
        }))
    }

    /// Denoises the last frame again after samples from elsewhere were added to its sums.
    ///
    /// # Errors
    /// The device failed.
    pub fn denoise(
        &self,
        gpu: &Gpu,
        targets: &Targets,
        constants: &FrameUniform,
        tolerances: &Tolerances,
    ) -> Result<()> {
        gpu.queue.write_buffer(&targets.frame, 0, &in_strides(&targets.plan.parts, constants, tolerances));
        let submissions = targets.plan.submissions().into_iter().map(|mut parts| {
            parts.retain(|(_, part)| denoise::STAGES.contains(&part.stage));
            parts
        });
        gpu.submit_all_and_wait(submissions.filter(|parts| !parts.is_empty()).map(|parts| {
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            for (index, part) in parts {
                self.record(&mut encoder, targets, &self.bound[0][index], &part, constants.refresh_count);
            }
            encoder.finish()
        }))
    }

    /// Timestamps of the last frame; waits for it.
    pub fn times(&self, gpu: &Gpu) -> Result<crate::FrameTime> {
        self.timer.read(gpu)
    }

    fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        bound: &Bound,
        part: &Part,
        refresh_count: u32,
    ) {
        if let [true, _] = part.bounds {
            for cleared in part.stage.clears {
                match cleared {
                    Clears::ListHeader => encoder.clear_buffer(&targets.list, 0, Some(LIST_HEADER)),
                    Clears::Attributes => encoder.clear_buffer(&targets.attributes, 0, None),
                    Clears::Reprojected => encoder.clear_buffer(&targets.splats, 0, None),
                }
            }
        }
        let mut pass = self.timer.part(encoder, part.pass, part.bounds);
        match part.extent {
            Extent::Groups(groups) => bound.dispatch(&mut pass, groups),
            Extent::Refreshed(tiles) => {
                bound.dispatch(&mut pass, [(tiles * refresh_count).div_ceil(TRACE_GROUP), 1]);
            }
            Extent::Chunk(chunk) => {
                let offset = DISPATCH_BYTES * u64::from(chunk);
                bound.dispatch_indirect(&mut pass, &targets.dispatch, offset);
            }
        }
    }
}

/// The uniforms of all parts, `FRAME_STRIDE` bytes apart. Tolerances follow the distance of the references.
fn in_strides(parts: &[Part], constants: &FrameUniform, tolerances: &Tolerances) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(parts.len() * FRAME_STRIDE as usize);
    for part in parts {
        let Rows { stride, row, end, turn } = part.rows;
        // The position is one that no stride changes, here in units of the scene.
        let Tolerances { pos: _, norm, tex, gcol } = tolerances.at(stride.max(2));
        let of_part = FrameUniform {
            part: FramePart { first: part.first, stride, row, end, turn, walk: part.walk, step: part.step },
            tolerances: FrameTolerances { norm, tex, gcol, ..constants.tolerances },
            ..*constants
        };
        bytes.extend_from_slice(bytemuck::bytes_of(&of_part));
        bytes.resize(bytes.len().next_multiple_of(FRAME_STRIDE as usize), 0);
    }
    bytes
}
