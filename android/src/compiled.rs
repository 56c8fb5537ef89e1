//! The driver's pipeline cache, stored in the app's folder between starts.

use std::{
    hash::{DefaultHasher, Hasher},
    io,
    path::{Path, PathBuf},
};

use glimpse::Gpu;

/// Size of the checksum in front of the driver's data, in bytes.
const CHECKSUM: usize = 8;

/// Loads the stored pipeline cache into a device.
pub fn with_compiled(gpu: Gpu, folder: Option<&Path>) -> Gpu {
    let before = folder.and_then(|folder| std::fs::read(file(folder)).ok());
    let before = before.as_deref().and_then(checked);
    log::info!("kernels compiled before: {} bytes", before.map_or(0, <[u8]>::len));
    #[allow(unsafe_code, reason = "the checksum vouches for the bytes")]
    // SAFETY: the data was written by `keep`, as the checksum confirms.
    unsafe {
        gpu.with_compiled(before)
    }
}

/// Stores the device's pipeline cache.
pub fn keep(gpu: &Gpu, folder: &Path) -> io::Result<()> {
    let Some(compiled) = gpu.compiled() else { return Ok(()) };
    let mut bytes = checksum(&compiled).to_vec();
    bytes.extend(compiled);
    let file = file(folder);
    // Written beside the file and renamed, so that a process that is killed leaves the file before.
    let next = file.with_extension("next");
    std::fs::write(&next, bytes)?;
    std::fs::rename(&next, &file)
}

fn file(folder: &Path) -> PathBuf {
    folder.join("kernels.compiled")
}

fn checked(bytes: &[u8]) -> Option<&[u8]> {
    let (sum, compiled) = bytes.split_at_checked(CHECKSUM)?;
    (checksum(compiled) == sum).then_some(compiled)
}

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM] {
    let mut hasher = DefaultHasher::new();
    hasher.write(bytes);
    hasher.finish().to_le_bytes()
}
