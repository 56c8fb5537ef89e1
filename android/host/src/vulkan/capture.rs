//! What was presented: every picture is read back before the driver gets it.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use ash::vk;

use super::device::Device;
use crate::picture::Picture;
use crate::sync::lock;

/// How many of the last pictures are kept.
const KEPT: usize = 8;

struct Presented {
    count: u64,
    last: VecDeque<Arc<Picture>>,
}

static PRESENTED: Mutex<Presented> = Mutex::new(Presented { count: 0, last: VecDeque::new() });

/// How many pictures were presented.
pub fn presents() -> u64 {
    lock(&PRESENTED).count
}

/// The last picture that was presented.
pub fn last_presented() -> Option<Arc<Picture>> {
    lock(&PRESENTED).last.back().cloned()
}

/// The picture that was presented as number `number`, counted from 0, if it is still kept.
pub fn picture(number: u64) -> Option<Arc<Picture>> {
    let presented = lock(&PRESENTED);
    let first = presented.count - presented.last.len() as u64;
    presented.last.get(usize::try_from(number.checked_sub(first)?).ok()?).cloned()
}

/// Keeps a picture that is presented.
pub fn keep(picture: Picture) {
    let mut presented = lock(&PRESENTED);
    presented.count += 1;
    presented.last.push_back(Arc::new(picture));
    if presented.last.len() > KEPT {
        presented.last.pop_front();
    }
}

/// What reading back takes, made once for a swapchain.
pub struct Staging {
    buffer: vk::Buffer,
    memory: vk::DeviceMemory,
    bytes: *const u8,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    fence: vk::Fence,
}

impl Staging {
    /// For pictures of this size, four bytes a pixel.
    pub unsafe fn new(device: &Device, extent: vk::Extent2D) -> Result<Self, vk::Result> {
        let functions = &device.functions;
        let size = u64::from(extent.width) * u64::from(extent.height) * 4;
        let info = vk::BufferCreateInfo::default().size(size).usage(vk::BufferUsageFlags::TRANSFER_DST);
        let buffer = functions.create_buffer(&info, None)?;
        let needs = functions.get_buffer_memory_requirements(buffer);
        let visible = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        let kind = device.memory.memory_types_as_slice().iter().enumerate().find(|(index, kind)| {
            needs.memory_type_bits & (1 << index) != 0 && kind.property_flags.contains(visible)
        });
        let kind = kind.map_or(0, |(index, _)| index as u32);
        let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(kind);
        let memory = functions.allocate_memory(&info, None)?;
        functions.bind_buffer_memory(buffer, memory, 0)?;
        let bytes = functions.map_memory(memory, 0, size, vk::MemoryMapFlags::empty())?.cast();
        let info = vk::CommandPoolCreateInfo::default()
            .queue_family_index(device.family)
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
        let pool = functions.create_command_pool(&info, None)?;
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        let commands = functions.allocate_command_buffers(&info)?[0];
        let fence = functions.create_fence(&vk::FenceCreateInfo::default(), None)?;
        Ok(Self { buffer, memory, bytes, pool, commands, fence })
    }

    /// Gives everything back.
    pub unsafe fn destroy(self, functions: &ash::Device) {
        functions.destroy_fence(self.fence, None);
        functions.destroy_command_pool(self.pool, None);
        functions.destroy_buffer(self.buffer, None);
        functions.free_memory(self.memory, None);
    }

    /// Waits for `waits` and reads an image that is ready to be presented; it is ready again afterwards.
    pub unsafe fn read(
        &self,
        functions: &ash::Device,
        queue: vk::Queue,
        waits: &[vk::Semaphore],
        image: vk::Image,
        extent: vk::Extent2D,
    ) -> Result<Picture, vk::Result> {
        self.record(functions, image, extent)?;
        let stages = vec![vk::PipelineStageFlags::ALL_COMMANDS; waits.len()];
        let commands = [self.commands];
        let submit = vk::SubmitInfo::default()
            .wait_semaphores(waits)
            .wait_dst_stage_mask(&stages)
            .command_buffers(&commands);
        functions.queue_submit(queue, &[submit], self.fence)?;
        functions.wait_for_fences(&[self.fence], true, u64::MAX)?;
        functions.reset_fences(&[self.fence])?;
        let vk::Extent2D { width, height } = extent;
        let pixels = std::slice::from_raw_parts(self.bytes, width as usize * height as usize * 4);
        let rgb = pixels.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        Ok(Picture { width, height, rgb })
    }

    unsafe fn record(
        &self,
        functions: &ash::Device,
        image: vk::Image,
        extent: vk::Extent2D,
    ) -> Result<(), vk::Result> {
        let colour = vk::ImageSubresourceRange {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            level_count: 1,
            layer_count: 1,
            ..Default::default()
        };
        let barrier = |from, to| {
            let barrier = vk::ImageMemoryBarrier::default()
                .image(image)
                .old_layout(from)
                .new_layout(to)
                .subresource_range(colour)
                .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
                .dst_access_mask(vk::AccessFlags::MEMORY_READ);
            let all = vk::PipelineStageFlags::ALL_COMMANDS;
            let none = vk::DependencyFlags::empty();
            functions.cmd_pipeline_barrier(self.commands, all, all, none, &[], &[], &[barrier]);
        };
        let (presented, read) = (vk::ImageLayout::PRESENT_SRC_KHR, vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
        let layers = vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            layer_count: 1,
            ..Default::default()
        };
        let region = vk::BufferImageCopy::default().image_extent(extent.into()).image_subresource(layers);
        functions.begin_command_buffer(self.commands, &vk::CommandBufferBeginInfo::default())?;
        barrier(presented, read);
        functions.cmd_copy_image_to_buffer(self.commands, image, read, self.buffer, &[region]);
        barrier(read, presented);
        functions.end_command_buffer(self.commands)
    }
}
