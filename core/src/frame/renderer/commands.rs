//! A frame as a series of command buffers for the caller to submit.

use std::iter::FusedIterator;

use crate::{
    Camera,
    frame::sequence::{Sequence, Step},
};

/// The command buffers of one frame, in the order in which they must be submitted; see
/// [`Renderer::frame`](crate::Renderer::frame). The iterator's length is the number of remaining command buffers.
#[must_use = "a frame is rendered by submitting its command buffers"]
pub struct FrameCommands<'r> {
    commands: Box<dyn ExactSizeIterator<Item = wgpu::CommandBuffer> + 'r>,
    sequence: &'r mut Sequence,
    step: Step,
    camera: Camera,
    is_begun: bool,
}

impl<'r> FrameCommands<'r> {
    pub(super) fn new(
        commands: impl ExactSizeIterator<Item = wgpu::CommandBuffer> + 'r,
        sequence: &'r mut Sequence,
        step: Step,
        camera: &Camera,
    ) -> Self {
        Self { commands: Box::new(commands), sequence, step, camera: *camera, is_begun: false }
    }
}

impl Iterator for FrameCommands<'_> {
    type Item = wgpu::CommandBuffer;

    fn next(&mut self) -> Option<Self::Item> {
        let next = self.commands.next()?;
        self.is_begun = true;
        if self.commands.len() == 0 {
            self.sequence.done(self.step, &self.camera);
        }
        Some(next)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.commands.size_hint()
    }
}

impl ExactSizeIterator for FrameCommands<'_> {}
impl FusedIterator for FrameCommands<'_> {}

impl Drop for FrameCommands<'_> {
    fn drop(&mut self) {
        if self.is_begun && self.commands.len() > 0 {
            self.sequence.give_up();
        }
    }
}
