//! Adds path samples that the CPU has traced to a frame.

use super::Renderer;
use crate::{
    Camera, Denoise, Error, LinearImage, Result,
    cpu_tracer::{AccumulatePass, Accumulator, View},
    frame::targets::texture,
    passes::{FrameSpec, Output},
};

impl Renderer {
    /// Adds the samples that CPU threads have finished for the last frame's view to that frame, and starts them
    /// on the view if it has changed. Does not wait for any thread.
    ///
    /// # Errors
    /// The settings do not [accept CPU samples](crate::Settings::accepts_cpu_samples), or the device failed.
    pub fn accumulate(&mut self, accumulator: &mut Accumulator) -> Result<()> {
        if !self.spec.settings.accepts_cpu_samples() {
            let expected = "path or vr where samples are merged, without stereo-reuse paper";
            return Err(Error::setting("method", expected, self.spec.settings.method.name()));
        }
        let Some(camera) = self.sequence.camera() else { return Ok(()) };
        accumulator.show(&View::new(&camera, self.targets.size, &self.spec.settings));
        accumulator.collect();
        let Some(image) = accumulator.take() else { return Ok(()) };
        let pass = match self.accumulating.take() {
            Some(pass) => pass,
            None => self.accumulate_pass(Output::Display, &self.targets.display.clone())?,
        };
        self.sequence.accumulate(image.samples);
        let step = self.sequence.again(&camera);
        let constants = self.constants(&camera, &step)?;
        let done = pass.run(&self.gpu, &constants, &image.rgb);
        self.accumulating = Some(pass);
        done?;
        if self.spec.settings.denoise() == Denoise::Off {
            return Ok(());
        }
        self.passes.denoise(&self.gpu, &self.targets, &constants, &self.spec.settings.tolerances)
    }

    /// The last frame in linear radiance, read from its accumulated sums, as CPU samples cannot be traced again.
    pub(super) fn accumulated_image(&mut self, camera: &Camera) -> Result<LinearImage> {
        let constants = self.constants(camera, &self.sequence.again(camera))?;
        if self.spec.settings.denoise() == Denoise::Off {
            let target = texture(&self.gpu, "linear", self.targets.size, wgpu::TextureFormat::Rgba32Float)?;
            // The buffer of planes has just been created and holds zeros.
            self.accumulate_pass(Output::Linear, &target)?.run(&self.gpu, &constants, &[])?;
            return self.read_linear(&target);
        }
        let (passes, target) = self.linear()?;
        passes.denoise(&self.gpu, &self.targets, &constants, &self.spec.settings.tolerances)?;
        let image = self.read_linear(&target)?;
        self.linear = Some((passes, target));
        Ok(image)
    }

    fn accumulate_pass(&mut self, output: Output, color: &wgpu::Texture) -> Result<AccumulatePass> {
        let spec = FrameSpec { output, ..FrameSpec::new(&self.scene, &self.spec.settings) };
        AccumulatePass::new(&self.gpu, &self.targets, &spec, &mut self.kernels, color)
    }
}
