//! Samples from elsewhere in a frame of paths.

use super::Renderer;
use crate::{
    Camera, Denoise, Error, LinearImage, Result,
    cpu_tracer::{AccumulatePass, Accumulator, View},
    frame::targets::texture,
    passes::{FrameSpec, Output},
};

impl Renderer {
    /// Adds what cores have finished of the last frame's view to what it shows; has them work on that view if it is new to
    /// them. Waits for no core.
    ///
    /// # Errors
    /// Settings that do not [take planes](crate::Settings::accepts_cpu_samples); a device that failed.
    pub fn accumulate(&mut self, accumulator: &mut Accumulator) -> Result<()> {
        if !self.settings.accepts_cpu_samples() {
            let expected = "path or vr where samples are merged, without stereo-reuse paper";
            return Err(Error::setting("method", expected, self.settings.method.name()));
        }
        let Some(camera) = self.sequence.camera() else { return Ok(()) };
        accumulator.show(&View::new(&camera, self.targets.size, &self.settings));
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
        if self.settings.denoise() == Denoise::Off {
            return Ok(());
        }
        self.passes.denoise(&self.gpu, &self.targets, &constants, &self.settings.tolerances)
    }

    /// The last frame in linear radiance, from the sums that are there: cores' samples cannot be made again.
    pub(super) fn accumulated_image(&mut self, camera: &Camera) -> Result<LinearImage> {
        let constants = self.constants(camera, &self.sequence.again(camera))?;
        if self.settings.denoise() == Denoise::Off {
            let target = texture(&self.gpu, "linear", self.targets.size, wgpu::TextureFormat::Rgba32Float)?;
            // The buffer of planes is new, and zero.
            self.accumulate_pass(Output::Linear, &target)?.run(&self.gpu, &constants, &[])?;
            return self.read_linear(&target);
        }
        let (passes, target) = self.linear()?;
        passes.denoise(&self.gpu, &self.targets, &constants, &self.settings.tolerances)?;
        let image = self.read_linear(&target)?;
        self.linear = Some((passes, target));
        Ok(image)
    }

    fn accumulate_pass(&mut self, output: Output, color: &wgpu::Texture) -> Result<AccumulatePass> {
        let spec = FrameSpec { output, ..FrameSpec::new(&self.scene, &self.settings) };
        AccumulatePass::new(&self.gpu, &self.targets, &spec, &mut self.kernels, color)
    }
}
