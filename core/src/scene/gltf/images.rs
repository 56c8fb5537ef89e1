//! Textures and their images: decoded when a material that is used shows them, once for each source.

use std::collections::HashMap;
use std::io::Cursor;

use gltf::json;
use json::texture::{MagFilter, WrappingMode};
use json::validation::Checked;

use super::accessors::Source;
use super::container::{self, Resolve};
use crate::scene::{Image8, Texture, Wrap};
use crate::{Error, Result};

/// The largest width and height.
const MAX_SIDE: u32 = 16_384;
/// The most bytes that one image may need while it is decoded.
const MAX_DECODED: u64 = 2 << 30;
/// The most bytes of all decoded images.
const MAX_TOTAL: u64 = 8 << 30;

#[derive(PartialEq, Eq, Hash)]
enum Origin {
    View(usize),
    Uri(String),
}

/// What is loaded already.
#[derive(Default)]
pub(super) struct Textures {
    pub textures: Vec<Texture>,
    pub images: Vec<Image8>,
    texture_of: HashMap<usize, Option<u32>>,
    image_of: HashMap<Origin, u32>,
}

impl Textures {
    /// The index of the scene's texture for the file's texture; `None` where that has no image which this
    /// program reads (its source is left to an extension).
    pub fn load(
        &mut self,
        source: &Source<'_>,
        resolve: &mut Resolve<'_>,
        index: usize,
    ) -> Result<Option<u32>> {
        if let Some(known) = self.texture_of.get(&index) {
            return Ok(*known);
        }
        let root = source.root;
        let what = format!("texture {index}");
        let json = root.textures.get(index).ok_or_else(|| {
            Error::scene(&what, format!("no such texture; the file has {}", root.textures.len()))
        })?;
        // The crate's stand-in for a source that is not there.
        let loaded = if json.source.value() == u32::MAX as usize {
            None
        } else {
            let image = self.image(source, resolve, json.source.value())?;
            let texture = sampler(root, json, &what)?;
            self.textures.push(Texture { image, ..texture });
            Some((self.textures.len() - 1) as u32)
        };
        self.texture_of.insert(index, loaded);
        Ok(loaded)
    }

    fn image(&mut self, source: &Source<'_>, resolve: &mut Resolve<'_>, index: usize) -> Result<u32> {
        let images = &source.root.images;
        let what = format!("image {index}");
        let json = images
            .get(index)
            .ok_or_else(|| Error::scene(&what, format!("no such image; the file has {}", images.len())))?;
        let origin = match (&json.buffer_view, &json.uri) {
            (Some(view), _) => Origin::View(view.value()),
            (None, Some(uri)) => Origin::Uri(uri.clone()),
            (None, None) => {
                return Err(Error::scene(what, "expected a buffer view or a URI, found neither"));
            }
        };
        if let Some(known) = self.image_of.get(&origin) {
            return Ok(*known);
        }
        let image = match &origin {
            Origin::View(view) => decode(container::view(source.root, source.buffers, *view)?, &what)?,
            Origin::Uri(uri) => decode(&container::fetch(uri, &what, resolve)?, &what)?,
        };
        let total: u64 = self.images.iter().chain([&image]).map(|i| i.rgba.len() as u64).sum();
        if total > MAX_TOTAL {
            return Err(Error::scene(what, format!("expected at most {MAX_TOTAL} bytes of decoded images")));
        }
        self.images.push(image);
        let place = (self.images.len() - 1) as u32;
        self.image_of.insert(origin, place);
        Ok(place)
    }
}

fn sampler(root: &json::Root, json: &json::Texture, what: &str) -> Result<Texture> {
    let Some(index) = json.sampler else {
        return Ok(Texture { image: 0, wrap: [Wrap::Repeat; 2], nearest: false });
    };
    let sampler = root.samplers.get(index.value()).ok_or_else(|| {
        Error::scene(
            what,
            format!("no such sampler: {}; the file has {}", index.value(), root.samplers.len()),
        )
    })?;
    let wrap = |mode: &Checked<WrappingMode>| match mode {
        Checked::Valid(WrappingMode::Repeat) => Ok(Wrap::Repeat),
        Checked::Valid(WrappingMode::MirroredRepeat) => Ok(Wrap::MirroredRepeat),
        Checked::Valid(WrappingMode::ClampToEdge) => Ok(Wrap::ClampToEdge),
        Checked::Invalid => {
            Err(Error::scene(what, "expected a wrap mode of 33071, 33648 or 10497, found another"))
        }
    };
    let nearest = matches!(sampler.mag_filter, Some(Checked::Valid(MagFilter::Nearest)));
    Ok(Texture { image: 0, wrap: [wrap(&sampler.wrap_s)?, wrap(&sampler.wrap_t)?], nearest })
}

fn decode(bytes: &[u8], what: &str) -> Result<Image8> {
    let fail = |e: image::ImageError| Error::scene(what, format!("cannot be decoded as PNG or JPEG: {e}"));
    let mut reader = image::ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|e| Error::scene(what, format!("cannot be read: {e}")))?;
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_DECODED);
    reader.limits(limits);
    let image = reader.decode().map_err(fail)?.into_rgba8();
    Ok(Image8 { width: image.width(), height: image.height(), rgba: image.into_raw() })
}
