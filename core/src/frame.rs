//! The frame: its passes in order and its constants.

use crate::{
    Camera, Gpu, GpuScene, Paths, Result, Settings, Tolerances,
    gpu::{Bound, Kernels, Timer, mirror::gpu_struct},
    passes::{Output, Stage, TRACE_GROUP, Variant},
    plan::{Extent, Part, Rows},
    targets::{DISPATCH_BYTES, LIST_HEADER, Targets},
};

gpu_struct! {
    /// The constants of a frame.
    pub struct Frame {
        origin: [f32; 3], orthographic: f32,
        right: [f32; 3], min_weight: f32,
        up: [f32; 3], pos_tolerance: f32,
        forward: [f32; 3], norm_tolerance: f32,
        background: [f32; 3], tex_tolerance: f32,
        ambient: [f32; 3], gcol_tolerance: f32,
        truncated: [f32; 3], depth: u32,
        size: [u32; 2], inverse_height: f32, first: u32,
        stride: u32, row: u32, end: u32, turn: u32,
        step: [i32; 2], walk: u32, seed: u32,
        tau_primary: [f32; 4], tau_secondary: [f32; 4],
        tau_col: f32, focus_first: u32, focus_last: u32, similar: f32,
        renewed_from: u32, renewed: u32, still: u32, tau_least: f32,
        gaze: [f32; 2], stop: f32, emitter_scale: f32,
        sample: u32, emitters: u32, eyes: [f32; 2],
        merged: u32, padding_x: u32, padding_y: u32, padding_z: u32,
    }
}

gpu_struct! {
    /// What the counting kernels write of a pixel.
    pub struct PixelRecord {
        origin: u32, failed: u32, cost: u32, object: u32, depth: f32, normal: u32, edges: u32, cells: u32,
    }
}

/// Bytes from one [`Frame`] to the next: a multiple of WebGPU's default for the alignment of uniform buffers.
pub const FRAME_STRIDE: u64 = size_of::<Frame>().next_multiple_of(256) as u64;

impl Frame {
    /// The constants of one frame of a scene, of so many samples; those of a part are still to come.
    pub fn new(scene: &GpuScene, settings: &Settings, size: [u32; 2], camera: &Camera) -> Self {
        let environment = &scene.environment;
        let t = &settings.thresholds;
        let extent = settings.method.eye(size).map(|side| side as f32);
        let gaze = [0, 1].map(|axis| settings.paths.gaze[axis] * extent[axis]);
        Self {
            origin: camera.origin.into(),
            orthographic: if camera.orthographic { 1.0 } else { 0.0 },
            right: camera.right.into(),
            min_weight: settings.min_weight,
            up: camera.up.into(),
            pos_tolerance: settings.tolerances.pos * scene.longest_side(),
            forward: camera.forward.into(),
            norm_tolerance: settings.tolerances.norm,
            background: environment.background.into(),
            tex_tolerance: settings.tolerances.tex,
            ambient: environment.ambient.into(),
            gcol_tolerance: settings.tolerances.gcol,
            truncated: environment.truncated.into(),
            depth: settings.depth,
            size,
            inverse_height: 1.0 / size[1] as f32,
            first: 0,
            stride: 0,
            row: 0,
            end: 0,
            turn: 0,
            step: [0; 2],
            walk: 0,
            seed: settings.seed,
            tau_primary: [t.poid, t.psn, t.psc, t.pte],
            tau_secondary: [t.soid, t.ssn, t.ssc, t.ste],
            tau_col: t.col,
            // As objects are stored: 0 is no hit, which is in no focus but everything's.
            focus_first: settings.focus.map_or(0, |focus| focus.first.saturating_add(1)),
            focus_last: settings.focus.map_or(u32::MAX, |focus| focus.last.saturating_add(1)),
            similar: settings.similar,
            renewed_from: 0,
            renewed: 0,
            still: 0,
            tau_least: t.values().into_iter().fold(1.0, f32::min),
            gaze,
            stop: settings.paths.p_max / farthest(gaze, extent),
            emitter_scale: scene.emitter_scale,
            sample: 0,
            emitters: scene.emitter_count,
            eyes: eyes(&settings.paths, camera),
            merged: 0,
            padding_x: 0,
            padding_y: 0,
            padding_z: 0,
        }
    }
}

/// How far the eyes are to the left and right of the camera, and how far their pictures are shifted for that, in lengths of
/// the camera's vector to the right.
fn eyes(paths: &Paths, camera: &Camera) -> [f32; 2] {
    let [right, forward] = [camera.right, camera.forward].map(|axis| axis.as_dvec3().length());
    let aside = 0.5 * f64::from(paths.eye_distance) / right;
    [aside, paths.convergence.map_or(0.0, |distance| aside * forward / f64::from(distance))].map(|x| x as f32)
}

/// From the gaze to the corner of the picture that is farthest from it, in pixels.
fn farthest(gaze: [f32; 2], extent: [f32; 2]) -> f32 {
    let [x, y] = [0, 1].map(|axis| gaze[axis].abs().max((extent[axis] - gaze[axis]).abs()));
    x.hypot(y)
}

/// The compiled passes of a method in one variant.
pub struct Passes {
    /// As many as the plan has parts, for each history that is written.
    bound: [Vec<Bound>; 2],
    timer: Timer,
}

impl Passes {
    /// Links, compiles and binds. `color` is where colours go, `inspection` where counting kernels write.
    pub fn new(
        gpu: &Gpu,
        scene: &GpuScene,
        targets: &Targets,
        variant: &Variant,
        kernels: &mut Kernels,
        color: &wgpu::Texture,
        inspection: Option<&wgpu::Buffer>,
    ) -> Result<Self> {
        let passes = targets.plan.passes();
        let kernels = passes
            .iter()
            .map(|stage| kernels.get(gpu, stage.name(), variant.sources(*stage)))
            .collect::<Result<Vec<_>>>()?;
        let color = color.create_view(&wgpu::TextureViewDescriptor::default());
        let mut resources = scene.resources();
        resources.extend([
            ("attributes", targets.attributes.as_entire_binding()),
            ("list", targets.list.as_entire_binding()),
            ("dispatch", targets.dispatch.as_entire_binding()),
            ("samples", targets.samples.as_entire_binding()),
            ("guides", targets.guides.as_entire_binding()),
        ]);
        let name = match variant.output {
            Output::Display => Some("display"),
            Output::Linear => Some("linear"),
            Output::Samples | Output::Nowhere => None,
        };
        resources.extend(name.map(|name| (name, wgpu::BindingResource::TextureView(&color))));
        resources.extend(inspection.map(|buffer| ("inspection", buffer.as_entire_binding())));
        resources.push(("landed", targets.landed.as_entire_binding()));
        let bind = |side: usize, index: usize, part: &Part| {
            let mut resources = resources.clone();
            let filtered = part.filtered();
            resources.extend([
                ("filtered", targets.filtered[filtered].as_entire_binding()),
                ("filtered_before", targets.filtered[1 - filtered].as_entire_binding()),
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
        let names: Vec<_> = passes.iter().map(|stage| stage.name()).collect();
        Ok(Self { bound: [first?, second?], timer: Timer::new(gpu, &names)? })
    }

    /// The command buffers of one frame with these constants, to be submitted in order; each is recorded when it is asked
    /// for. The constants are in the first of them and not written to the queue, so a frame may be recorded before the one
    /// that precedes it is submitted. `cleared` are buffers that the frame begins by clearing.
    ///
    /// # Errors
    /// A device that failed.
    pub fn commands<'f>(
        &'f self,
        gpu: &'f Gpu,
        targets: &'f Targets,
        constants: &Frame,
        tolerances: &Tolerances,
        side: usize,
        cleared: Vec<&'f wgpu::Buffer>,
    ) -> Result<impl ExactSizeIterator<Item = wgpu::CommandBuffer> + use<'f>> {
        let parts = in_strides(&targets.plan.parts, constants, tolerances);
        let parts = gpu.filled("constants", &parts, wgpu::BufferUsages::COPY_SRC)?;
        let submissions = targets.plan.submissions();
        let (count, renewed) = (submissions.len(), constants.renewed);
        Ok(submissions.into_iter().enumerate().map(move |(submission, of_submission)| {
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            if submission == 0 {
                encoder.copy_buffer_to_buffer(&parts, 0, &targets.frame, 0, parts.size());
                cleared.iter().for_each(|buffer| encoder.clear_buffer(buffer, 0, None));
            }
            for (index, part) in of_submission {
                self.record(&mut encoder, targets, &self.bound[side][index], &part, renewed);
            }
            if submission + 1 == count {
                self.timer.resolve(&mut encoder);
            }
            encoder.finish()
        }))
    }

    /// What is shown of the last frame's samples, now that others have been added: noise is removed once more.
    ///
    /// # Errors
    /// A device that failed.
    pub fn remove_noise(
        &self,
        gpu: &Gpu,
        targets: &Targets,
        constants: &Frame,
        tolerances: &Tolerances,
    ) -> Result<()> {
        gpu.queue.write_buffer(&targets.frame, 0, &in_strides(&targets.plan.parts, constants, tolerances));
        let submissions = targets.plan.submissions().into_iter().map(|mut parts| {
            parts.retain(|(_, part)| part.stage.removes_noise());
            parts
        });
        gpu.submit_all_and_wait(submissions.filter(|parts| !parts.is_empty()).map(|parts| {
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            for (index, part) in parts {
                self.record(&mut encoder, targets, &self.bound[0][index], &part, constants.renewed);
            }
            encoder.finish()
        }))
    }

    /// The timestamps of the frame that has just been waited for.
    pub fn times(&self, gpu: &Gpu) -> Result<crate::FrameTime> {
        self.timer.read(gpu)
    }

    fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        bound: &Bound,
        part: &Part,
        renewed: u32,
    ) {
        let [first, _] = part.bounds;
        if first
            && matches!(
                part.stage,
                Stage::Base
                    | Stage::SubpixelTest
                    | Stage::RefineTest
                    | Stage::QuincunxBase
                    | Stage::ReprojectDepth
            )
        {
            // The queue is empty.
            encoder.clear_buffer(&targets.list, 0, Some(LIST_HEADER));
        }
        if first && part.stage == Stage::QuincunxBase {
            // No sample is claimed.
            encoder.clear_buffer(&targets.attributes, 0, None);
        }
        if first && part.stage == Stage::ReprojectDepth {
            encoder.clear_buffer(&targets.landed, 0, None);
        }
        let mut pass = self.timer.part(encoder, part.pass, part.bounds);
        match part.extent {
            Extent::Groups(groups) => bound.dispatch(&mut pass, groups),
            Extent::Renewed(tiles) => {
                bound.dispatch(&mut pass, [(tiles * renewed).div_ceil(TRACE_GROUP), 1]);
            }
            Extent::Chunk(chunk) => {
                let offset = DISPATCH_BYTES * u64::from(chunk);
                bound.dispatch_indirect(&mut pass, &targets.dispatch, offset);
            }
        }
    }
}

/// The constants of every part, as the buffer holds them.
fn in_strides(parts: &[Part], constants: &Frame, tolerances: &Tolerances) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(parts.len() * FRAME_STRIDE as usize);
    for part in parts {
        let Rows { stride, row, end, turn } = part.rows;
        let Tolerances { norm: norm_tolerance, gcol: gcol_tolerance, .. } = tolerances.at(stride.max(2));
        let of_part = Frame {
            norm_tolerance,
            gcol_tolerance,
            first: part.first,
            stride,
            row,
            end,
            turn,
            step: part.step,
            walk: part.walk,
            ..*constants
        };
        bytes.extend_from_slice(bytemuck::bytes_of(&of_part));
        bytes.resize(bytes.len().next_multiple_of(FRAME_STRIDE as usize), 0);
    }
    bytes
}
