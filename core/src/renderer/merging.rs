//! Samples from elsewhere in a frame of paths.

use super::Renderer;
use crate::{
    Camera, Error, LinearImage, Result,
    passes::{Output, Variant},
    planes::{Merge, MergePass, View},
    targets::texture,
};

impl Renderer<'_> {
    /// Adds what cores have finished of the last frame's view to what it shows; has them work on that view if it is new to
    /// them. Waits for no core.
    ///
    /// # Errors
    /// Settings that do not [take planes](crate::Settings::takes_planes); a device that failed.
    pub fn merge(&mut self, merge: &mut Merge) -> Result<()> {
        if !self.settings.takes_planes() {
            let found = format!("--method {}", self.settings.method.name());
            let expected =
                "expected path or vr where planes are merged, with --denoise off and no --crossing paper";
            return Err(Error::setting(found, expected));
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
        let done = pass.run(self.gpu, &self.constants(&camera, &step)?, &plane.rgb);
        self.merging = Some(pass);
        done
    }

    /// The last frame in linear radiance, from the sums that are there: cores' samples cannot be made again.
    pub(super) fn merged_image(&mut self, camera: &Camera) -> Result<LinearImage> {
        let target = texture(self.gpu, "linear", self.targets.size, wgpu::TextureFormat::Rgba32Float)?;
        let pass = self.merge_pass(Output::Linear, &target)?;
        // The buffer of planes is new, and zero.
        pass.run(self.gpu, &self.constants(camera, &self.sequence.again(camera))?, &[])?;
        self.read_linear(&target)
    }

    fn merge_pass(&mut self, output: Output, color: &wgpu::Texture) -> Result<MergePass> {
        let variant = Variant { output, ..Variant::new(self.scene, &self.settings) };
        MergePass::new(self.gpu, &self.targets, &variant, &mut self.kernels, color)
    }
}
