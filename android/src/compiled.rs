//! What the driver has compiled, kept in the app's own folder from one start to the next.

use std::{
    hash::{DefaultHasher, Hasher},
    io,
    path::{Path, PathBuf},
};

use glimpse::Gpu;

/// Bytes of the checksum before the driver's own.
const CHECKSUM: usize = 8;

/// The device, with what was compiled before.
pub fn with_compiled(gpu: Gpu, folder: Option<&Path>) -> Gpu {
    let before = folder.and_then(|folder| std::fs::read(file(folder)).ok());
    let before = before.as_deref().and_then(checked);
    log::info!("kernels compiled before: {} bytes", before.map_or(0, <[u8]>::len));
    #[allow(unsafe_code, reason = "the checksum vouches for the bytes")]
    // SAFETY: they were written by `keep`, and the checksum says that they are what it wrote.
    unsafe {
        gpu.with_compiled(before)
    }
}

/// Keeps what the driver has compiled.
pub fn keep(gpu: &Gpu, folder: &Path) -> io::Result<()> {
    let Some(compiled) = gpu.compiled() else { return Ok(()) };
    let mut bytes = checksum(&compiled).to_vec();
    bytes.extend(compiled);
    let file = file(folder);
    // A process that ends in the middle leaves what was there.
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
