//! KTX 2.0 images (KHR_texture_basisu): Basis Universal and, as exporters write them too, plain formats of 8 bits a
//! channel, also compressed by Zstandard.

use basisu::{DecodeFlags, TargetFormat, Transcoder};
use ruzstd::StreamingDecoder;
use ruzstd::io::Read as _;

const MAGIC: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// How the texels of the first level are stored.
#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    /// BasisLZ.
    Etc1s,
    /// Blocks of 16 bytes for 4 x 4 texels.
    Uastc,
    /// Bytes, as many for each texel.
    Plain(usize),
}

/// A file whose header was checked; of several levels the first one is read.
pub(super) struct Image<'b> {
    pub width: u32,
    pub height: u32,
    encoding: Encoding,
    file: &'b [u8],
    /// The first level, compressed where `zstd`.
    level: &'b [u8],
    zstd: bool,
}

/// Whether bytes begin as a KTX 2.0 file does.
pub(super) fn is_ktx2(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

fn word(bytes: &[u8], at: usize) -> Result<u32, String> {
    let word = bytes.get(at..).and_then(|rest| rest.first_chunk());
    word.copied().map(u32::from_le_bytes).ok_or_else(|| "it is truncated".to_owned())
}

fn long(bytes: &[u8], at: usize) -> Result<usize, String> {
    let long = u64::from(word(bytes, at)?) | u64::from(word(bytes, at + 4)?) << 32;
    usize::try_from(long).map_err(|_| "it is truncated".to_owned())
}

impl<'b> Image<'b> {
    pub fn open(file: &'b [u8]) -> Result<Self, String> {
        let mut words = [0; 9];
        for (i, slot) in words.iter_mut().enumerate() {
            *slot = word(file, 12 + 4 * i)?;
        }
        let [format, _, width, height, depth, layers, faces, _, scheme] = words;
        if width == 0 || height == 0 || depth > 1 || layers > 1 || faces != 1 {
            return Err(format!(
                "expected one picture of two dimensions, found {width} x {height} x {depth} texels, \
                 {layers} layers and {faces} faces"
            ));
        }
        let descriptor = word(file, 48)? as usize;
        let model = word(file, descriptor.saturating_add(12))? & 0xff;
        let encoding = match (format, model) {
            (0, 163) => Encoding::Etc1s,
            (0, 166) => Encoding::Uastc,
            (9 | 15, _) => Encoding::Plain(1),
            (16 | 22, _) => Encoding::Plain(2),
            (23 | 29, _) => Encoding::Plain(3),
            (37 | 43, _) => Encoding::Plain(4),
            _ => {
                return Err(format!(
                    "expected ETC1S, UASTC or 8-bit R, RG, RGB or RGBA, found format {format} of colour model {model}"
                ));
            }
        };
        let zstd = match (scheme, encoding) {
            (0, Encoding::Uastc | Encoding::Plain(_)) | (1, Encoding::Etc1s) => false,
            (2, Encoding::Uastc | Encoding::Plain(_)) => true,
            _ => return Err(format!("its supercompression {scheme} does not apply to its format {format}")),
        };
        let (start, length) = (long(file, 80)?, long(file, 88)?);
        let level = file.get(start..).and_then(|rest| rest.get(..length)).ok_or_else(|| {
            format!("expected {length} bytes from byte {start} on, found a file of {}", file.len())
        })?;
        let image = Self { width, height, encoding, file, level, zstd };
        let (found, expected) = (long(file, 96)?, image.stored());
        if zstd && (found != expected || window(level)? > expected.max(1 << 20)) {
            return Err(format!(
                "expected {expected} bytes in its first level, found {found} or a wider window"
            ));
        }
        Ok(image)
    }

    /// Bytes of the first level without Zstandard; 0 where the format does not say.
    fn stored(&self) -> usize {
        let (width, height) = (self.width as usize, self.height as usize);
        match self.encoding {
            Encoding::Etc1s => 0,
            Encoding::Uastc => width.div_ceil(4).saturating_mul(height.div_ceil(4)).saturating_mul(16),
            Encoding::Plain(channels) => width.saturating_mul(height).saturating_mul(channels),
        }
    }

    /// Decodes the first level to RGBA; one channel alone gives grey.
    pub fn rgba(&self) -> Result<Vec<u8>, String> {
        let Encoding::Plain(channels) = self.encoding else {
            let transcoder = Transcoder::new(self.file).map_err(|e| format!("{e:?}"))?;
            let rgba = transcoder.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE);
            return rgba.map_err(|e| format!("{e:?}"));
        };
        let mut inflated = Vec::new();
        let level = if self.zstd {
            inflated.resize(self.stored(), 0);
            let mut decoder = StreamingDecoder::new(self.level).map_err(|e| e.to_string())?;
            decoder.read_exact(&mut inflated).map_err(|e| e.to_string())?;
            &inflated
        } else {
            self.level
        };
        let texels = level.get(..self.stored()).ok_or("it is truncated")?.chunks_exact(channels);
        let rgba = texels.flat_map(|texel| match *texel {
            [grey] => [grey, grey, grey, 255],
            [red, green] => [red, green, 0, 255],
            [red, green, blue] => [red, green, blue, 255],
            [red, green, blue, alpha, ..] => [red, green, blue, alpha],
            [] => [0; 4],
        });
        Ok(rgba.collect())
    }
}

/// The bytes that a Zstandard frame refers back to (RFC 8878, section 3.1.1.1.2), which a decoder allocates.
fn window(frame: &[u8]) -> Result<usize, String> {
    let (magic, flags) = (word(frame, 0)?, frame.get(4).copied().unwrap_or_default());
    if magic != 0xfd2f_b528 {
        return Err("expected a frame of Zstandard, found other data".to_owned());
    }
    let at = |i: usize| frame.get(i).copied().ok_or_else(|| "it is truncated".to_owned());
    if flags & 0x20 == 0 {
        let window = at(5)?;
        let base = 1_usize << (10 + (window >> 3));
        return Ok(base + (base >> 3) * usize::from(window & 7));
    }
    // Without a window the content's size follows the dictionary's number.
    let start = 5 + [0, 1, 2, 4][usize::from(flags & 3)];
    let bytes = 1 << (flags >> 6);
    let size =
        (0..bytes).try_fold(0_u64, |size, i| Ok::<_, String>(size | u64::from(at(start + i)?) << (8 * i)))?;
    usize::try_from(size + if bytes == 2 { 256 } else { 0 }).map_err(|_| "it is too long".to_owned())
}
