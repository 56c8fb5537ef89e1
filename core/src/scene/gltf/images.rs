//! Textures and images; an image is decoded once, when a used material needs it.

use std::collections::HashMap;
use std::io::Cursor;

use gltf::json;
use image::{DynamicImage, ImageDecoder as _, ImageError, ImageFormat, ImageReader};
use json::texture::{MagFilter, WrappingMode};
use json::validation::Checked;

use super::CONTENT_BYTES;
use super::accessors::Source;
use super::budget::Budget;
use super::container::{self, External};
use super::jpeg;
#[cfg(feature = "ktx2")]
use super::ktx2;
use crate::scene::{Image8, Texture, Wrap};
use crate::{Error, Result};

/// The largest width and height, from the limits of common WebGPU devices.
const MAX_SIDE: u32 = 16_384;

/// The most texels of all images of a scene: 4 GiB when decoded.
pub(super) const MAX_TEXELS: u64 = 1 << 30;

/// The most texels per byte of an image file. Deflate expands a byte to at most 1032 (RFC 1951: 258 for two
/// bits), and a byte of PNG data holds at most 8 texels; JPEG needs at least a bit for 8 x 8 texels.
const TEXELS_PER_BYTE: u64 = 8 * 1032;

/// Memory for each texel while an image is decoded: 16 bits a channel, and the image that is kept.
const DECODING_BYTES: u64 = 16;

/// Formats of image files that can be decoded, besides KTX 2.0.
const FORMATS: &[ImageFormat] = &[
    ImageFormat::Png,
    ImageFormat::Jpeg,
    #[cfg(feature = "webp")]
    ImageFormat::WebP,
];

/// The formats for messages.
const NAMES: &str = match (cfg!(feature = "webp"), cfg!(feature = "ktx2")) {
    (true, true) => "PNG, JPEG, WebP, KTX 2.0",
    (true, false) => "PNG, JPEG, WebP",
    (false, true) => "PNG, JPEG, KTX 2.0",
    (false, false) => "PNG, JPEG",
};

/// Why a texture has no image: extensions that are not read define other sources than the core's.
const NOT_READ: &str = match (cfg!(feature = "webp"), cfg!(feature = "ktx2")) {
    (true, true) => "it has no image in PNG, JPEG, WebP or KTX 2.0",
    (true, false) => "it has no image in PNG, JPEG or WebP",
    (false, true) => "it has no image in PNG, JPEG or KTX 2.0",
    (false, false) => "it has no image in PNG or JPEG",
};

/// A texture of the scene, or why there is none.
pub(super) type Loaded = std::result::Result<u32, &'static str>;

/// Extensions of textures that name another image than the core's.
const EXTENSIONS: &[&str] = &[
    #[cfg(feature = "ktx2")]
    "KHR_texture_basisu",
    #[cfg(feature = "webp")]
    "EXT_texture_webp",
];

/// Memory that a decoder may use besides the image, for a row and for a colour profile, whose size must be
/// bounded too.
const DECODER_BYTES: u64 = 4 << 20;

#[derive(PartialEq, Eq, Hash)]
enum Origin {
    View(usize),
    Uri(String),
}

/// The textures and images loaded so far.
pub(super) struct Textures {
    pub textures: Vec<Texture>,
    pub images: Vec<Image8>,
    /// A sentence for each image whose file is missing.
    pub warnings: Vec<String>,
    /// Number of texels that may still be decoded.
    room: u64,
    texture_of: HashMap<usize, Loaded>,
    image_of: HashMap<Origin, Option<u32>>,
}

impl Textures {
    /// No textures yet, with a limit of `room` texels.
    pub fn new(room: u64) -> Self {
        let (textures, images, warnings) = (Vec::new(), Vec::new(), Vec::new());
        Self { textures, images, warnings, room, texture_of: HashMap::new(), image_of: HashMap::new() }
    }

    /// The scene's texture for a texture of the file, loaded on first use, or why it has no image.
    pub fn load(&mut self, source: &Source<'_>, external: &mut External<'_>, index: usize) -> Result<Loaded> {
        if let Some(known) = self.texture_of.get(&index) {
            return Ok(*known);
        }
        let root = source.root;
        let what = format!("texture {index}");
        let json = root.textures.get(index).ok_or_else(|| {
            Error::scene(&what, format!("no such texture; the file has {}", root.textures.len()))
        })?;
        let image = match image_of(json, &what)? {
            None => Err(NOT_READ),
            Some(index) => self.image(source, external, index)?.ok_or("its image is missing"),
        };
        let texture = sampler(root, json, &what)?;
        let loaded = image.map(|image| {
            self.textures.push(Texture { image, ..texture });
            (self.textures.len() - 1) as u32
        });
        self.texture_of.insert(index, loaded);
        Ok(loaded)
    }

    /// The scene's image for an image of the file; `None`, with a warning, if its file is missing.
    pub fn image(
        &mut self,
        source: &Source<'_>,
        external: &mut External<'_>,
        index: usize,
    ) -> Result<Option<u32>> {
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
        let fetched;
        let bytes = match &origin {
            Origin::View(view) => Some(source.view(*view)?),
            Origin::Uri(uri) => {
                fetched = match external.fetch(uri, &what) {
                    Err(error) if container::data_of(uri).is_none() => {
                        self.warnings.push(error.to_string());
                        None
                    }
                    fetched => Some(fetched?),
                };
                fetched.as_deref()
            }
        };
        source.budget.needs(&what, CONTENT_BYTES * bytes.map_or(0, <[u8]>::len) as u64)?;
        let image = bytes.map(|bytes| self.decode(bytes, source.budget, &what)).transpose()?;
        let place = image.map(|image| {
            self.images.push(image);
            (self.images.len() - 1) as u32
        });
        self.image_of.insert(origin, place);
        Ok(place)
    }

    /// Decodes an image. Before it allocates, it checks the size in the header against the length of the data and
    /// the limits.
    fn decode(&mut self, bytes: &[u8], budget: &Budget, what: &str) -> Result<Image8> {
        let fail = |reason: String| Error::scene(what, reason);
        if !cfg!(feature = "images") {
            return Err(fail("cannot be decoded: glimpse was built without its feature `images`".to_owned()));
        }
        #[cfg(feature = "ktx2")]
        if ktx2::is_ktx2(bytes) {
            let undecodable = |e: String| fail(format!("cannot be decoded as KTX 2.0: {e}"));
            let image = ktx2::Image::open(bytes).map_err(undecodable)?;
            let (width, height) = (image.width, image.height);
            if width.max(height) > MAX_SIDE {
                return Err(fail(format!(
                    "expected a side of at most {MAX_SIDE}, found {width} x {height} texels"
                )));
            }
            self.reserve(width, height, budget, what)?;
            return Ok(Image8 { width, height, rgba: image.rgba().map_err(undecodable)? });
        }
        let undecodable = |e: ImageError| fail(format!("cannot be decoded: {e}"));
        let format =
            image::guess_format(bytes).ok().filter(|format| FORMATS.contains(format)).ok_or_else(|| {
                fail(format!("cannot be decoded: expected one of {NAMES}, found another format"))
            })?;
        let bytes = match format {
            // Decoders fill in truncated data silently.
            ImageFormat::Jpeg => jpeg::whole(bytes).ok_or_else(|| {
                fail("cannot be decoded: the JPEG is truncated, it has no end marker".to_owned())
            })?,
            _ => bytes,
        };
        let held = bytes.len() as u64 * TEXELS_PER_BYTE;
        let mut limits = image::Limits::no_limits();
        limits.max_image_width = Some(MAX_SIDE);
        limits.max_image_height = Some(MAX_SIDE);
        limits.max_alloc = Some(DECODER_BYTES);
        let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
        reader.limits(limits);
        let decoder = reader.into_decoder().map_err(undecodable)?;
        let (width, height) = decoder.dimensions();
        let texels = u64::from(width) * u64::from(height);
        // WebP stores an area of one colour in no bits at all.
        if texels > held && format != ImageFormat::WebP {
            return Err(fail(format!(
                "its header says {width} x {height} texels, {} bytes cannot hold more than {held}",
                bytes.len()
            )));
        }
        self.reserve(width, height, budget, what)?;
        let image = DynamicImage::from_decoder(decoder).map_err(undecodable)?.into_rgba8();
        Ok(Image8 { width, height, rgba: image.into_raw() })
    }

    /// Takes the texels of an image from the room that is left.
    fn reserve(&mut self, width: u32, height: u32, budget: &Budget, what: &str) -> Result<()> {
        let texels = u64::from(width) * u64::from(height);
        self.room = self.room.checked_sub(texels).ok_or_else(|| {
            let reason = format!(
                "expected at most {MAX_TEXELS} texels of all images, found {texels} where {} are left",
                self.room
            );
            Error::scene(what, reason)
        })?;
        budget.needs(what, DECODING_BYTES * texels)?;
        budget.claim(what, 4 * texels)
    }
}

/// The image of a texture: that of an extension before that of the core; `None` without any that can be decoded.
fn image_of(json: &json::Texture, what: &str) -> Result<Option<usize>> {
    let others = json.extensions.as_ref().map(|extensions| &extensions.others);
    let named =
        others.and_then(|others| EXTENSIONS.iter().find_map(|name| Some((*name, others.get(*name)?))));
    if let Some((name, source)) = named.and_then(|(name, extension)| Some((name, extension.get("source")?))) {
        let index = source.as_u64().and_then(|index| usize::try_from(index).ok());
        let wrong =
            || Error::scene(format!("{what}, {name}"), format!("expected an image's index, found {source}"));
        return index.ok_or_else(wrong).map(Some);
    }
    // The `gltf` crate's placeholder for a missing source.
    Ok(Some(json.source.value()).filter(|index| *index != u32::MAX as usize))
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

#[cfg(test)]
mod tests {
    use super::super::tests::png;
    use super::*;

    #[test]
    fn images_share_the_room_that_there_is() {
        let mut textures = Textures::new(100);
        let budget = Budget::new(Some(16 * 100));
        let mut decode = |side| textures.decode(&png(side, side, [1; 4]), &budget, "image 0");
        assert_eq!(decode(9).unwrap().rgba.len(), 4 * 81);
        assert!(decode(4).is_ok(), "19 are left");
        let error = decode(2).unwrap_err().to_string();
        assert!(
            error.contains("image 0: expected at most") && error.contains("4 where 3 are left"),
            "{error}"
        );
        assert!(decode(1).is_ok(), "what was refused took nothing");
    }
}
