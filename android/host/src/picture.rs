//! Pictures in main memory: presented, expected, and compared.

use std::path::Path;

/// Pixels in rows from the top: red, green and blue of 8 bits each.
#[derive(Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Three bytes a pixel.
    pub rgb: Vec<u8>,
}

impl Picture {
    /// Reads a PNG file of 8 bits a channel.
    ///
    /// # Errors
    /// The file cannot be read or decoded; the message names it.
    pub fn read(path: &Path) -> Result<Self, String> {
        let wrong = |problem: &dyn std::fmt::Display| format!("{}: {problem}", path.display());
        let file = std::fs::File::open(path).map_err(|e| wrong(&e))?;
        let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(|e| wrong(&e))?;
        let size = reader.output_buffer_size().ok_or_else(|| wrong(&"too large"))?;
        let mut bytes = vec![0; size];
        let info = reader.next_frame(&mut bytes).map_err(|e| wrong(&e))?;
        let rgb = match info.color_type {
            png::ColorType::Rgb => bytes,
            png::ColorType::Rgba => {
                bytes.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
            }
            other => return Err(wrong(&format_args!("expected RGB or RGBA, found {other:?}"))),
        };
        Ok(Self { width: info.width, height: info.height, rgb })
    }

    /// Writes a PNG file.
    ///
    /// # Errors
    /// The file cannot be written; the message names it.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let wrong = |problem: &dyn std::fmt::Display| format!("{}: {problem}", path.display());
        let file = std::fs::File::create(path).map_err(|e| wrong(&e))?;
        let mut encoder = png::Encoder::new(std::io::BufWriter::new(file), self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(|e| wrong(&e))?;
        writer.write_image_data(&self.rgb).map_err(|e| wrong(&e))
    }

    /// All pixels are equal.
    pub fn is_of_one_colour(&self) -> bool {
        self.rgb.chunks_exact(3).all(|pixel| pixel == &self.rgb[..3])
    }

    /// Describes the difference to another picture; `None` where they are equal.
    pub fn difference(&self, other: &Self) -> Option<String> {
        if (self.width, self.height) != (other.width, other.height) {
            let [a, b] = [self, other].map(|picture| format!("{}x{}", picture.width, picture.height));
            return Some(format!("expected {b} pixels, found {a}"));
        }
        let pixels = self.rgb.chunks_exact(3).zip(other.rgb.chunks_exact(3)).filter(|(a, b)| a != b).count();
        let worst = self.rgb.iter().zip(&other.rgb).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
        let all = self.rgb.len() / 3;
        (pixels > 0).then(|| format!("{pixels} of {all} pixels differ, by {worst} of 255 at most"))
    }
}
