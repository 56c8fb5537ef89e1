//! Samples from elsewhere in a frame of paths.

use super::Renderer;
use crate::{
    Camera, Denoise, Error, LinearImage, Result,
    passes::{FrameSpec, Output},
    planes::{Merge, MergePass, View},
    targets::texture,
};

impl Renderer {
    /// Adds what cores have finished of the last frame's view to what it shows; has them work on that view if it is new to
    /// them. Waits for no core.
    ///
    /// # Errors
    /// Settings that do not [take planes](crate::Settings::takes_planes); a device that failed.
    pub fn merge(&mut self, merge: &mut Merge) -> Result<()> {
        if !self.settings.takes_planes() {
            let expected = "path or vr where samples are merged, without stereo-reuse paper";
            return Err(Error::setting("method", expected, self.settings.method.name()));
        }
        let Some(camera) = self.sequence.camera() else { return Ok(()) };
        merge.show(&View::new(&camera, self.targets.size, &self.settings));
        merge.collect();
        let Some(plane) = merge.take() else { return Ok(()) };
        let pass = match self.merging.take() {
            Some(pass) => pass,
            None => self.merge_pass(Output::Display, &self.targets.display.clone())?,
        };
        self.sequence.merge(plane.samples);
        let step = self.sequence.again(&camera);
        let constants = self.constants(&camera, &step)?;
        let done = pass.run(&self.gpu, &constants, &plane.rgb);
        self.merging = Some(pass);
        done?;
        if self.settings.denoise() == Denoise::Off {
            return Ok(());
        }
        self.passes.remove_noise(&self.gpu, &self.targets, &constants, &self.settings.tolerances)
    }

    /// The last frame in linear radiance, from the sums that are there: cores' samples cannot be made again.
    pub(super) fn merged_image(&mut self, camera: &Camera) -> Result<LinearImage> {
        let constants = self.constants(camera, &self.sequence.again(camera))?;
        if self.settings.denoise() == Denoise::Off {
            let target = texture(&self.gpu, "linear", self.targets.size, wgpu::TextureFormat::Rgba32Float)?;
            // The buffer of planes is new, and zero.
            self.merge_pass(Output::Linear, &target)?.run(&self.gpu, &constants, &[])?;
            return self.read_linear(&target);
        }
        let (passes, target) = self.linear()?;
        passes.remove_noise(&self.gpu, &self.targets, &constants, &self.settings.tolerances)?;
        let image = self.read_linear(&target)?;
        self.linear = Some((passes, target));
        Ok(image)
    }

    fn merge_pass(&mut self, output: Output, color: &wgpu::Texture) -> Result<MergePass> {
        let spec = FrameSpec { output, ..FrameSpec::new(&self.scene, &self.settings) };
        MergePass::new(&self.gpu, &self.targets, &spec, &mut self.kernels, color)
    }
}
