//! False-colour images of the per-pixel records of an inspection.

use crate::{Check, DisplayImage, Error, Method, Origin, PixelRecord, Result, Settings, THRESHOLD_NAMES};

/// What an image displays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Show {
    /// The rendered frame.
    Final,
    /// Each pixel's [`Origin`] as a colour.
    Origin,
    /// Pixels that fail a similarity check, in red.
    Check(Check),
    /// Number of subpixels of each pixel that get extra samples (Jin 2009, Figure 1).
    Active,
    /// Pixels with an attribute that differs from a neighbour's, in red; the index is one of [`THRESHOLD_NAMES`].
    Attribute(usize),
    /// Node visits and primitive tests of each pixel, on a logarithmic scale.
    Cost,
    /// View depth of the first hit.
    Depth,
    /// Shading normal of the first hit.
    Normal,
    /// Object (OID) of the first hit, as a hashed colour.
    Oid,
}

impl Show {
    /// All images, in the order in which user interfaces list them.
    pub fn all() -> impl Iterator<Item = Self> {
        [Self::Final, Self::Origin]
            .into_iter()
            .chain(Check::ALL.map(Self::Check))
            .chain([Self::Cost, Self::Depth, Self::Normal, Self::Oid, Self::Active])
            .chain((0..THRESHOLD_NAMES.len()).map(Self::Attribute))
    }

    /// The image's name as a value of the option `show`.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Final => "final".to_owned(),
            Self::Origin => "origin".to_owned(),
            Self::Check(check) => format!("check:{}", check.name()),
            Self::Active => "active".to_owned(),
            Self::Attribute(attribute) => format!("attr:{}", THRESHOLD_NAMES[attribute]),
            Self::Cost => "cost".to_owned(),
            Self::Depth => "depth".to_owned(),
            Self::Normal => "normal".to_owned(),
            Self::Oid => "oid".to_owned(),
        }
    }
}

impl Show {
    /// Why frames with these settings have no data to display, as a sentence; `None` if they have.
    #[must_use]
    pub fn conflict(self, settings: &Settings) -> Option<&'static str> {
        let method = settings.method;
        match self {
            Self::Final => None,
            _ if settings.sampling > 1 => {
                Some("What is shown instead of the frame is about pixels of one sample.")
            }
            Self::Active if !settings.supersamples() && method != Method::Quincunx => {
                Some("Active pixels are those of the methods supersample and quincunx, and of supersample.")
            }
            Self::Attribute(_) if !settings.supersamples() => Some(
                "Attributes are compared where there are extra samples: method supersample, or supersample.",
            ),
            Self::Check(_) | Self::Depth | Self::Normal | Self::Oid => method.lacks_surfaces(),
            _ => None,
        }
    }
}

impl std::str::FromStr for Show {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::all().find(|show| show.name() == text).ok_or_else(|| {
            let names: Vec<_> = Self::all().map(Self::name).collect();
            format!("expected one of {}", names.join(", "))
        })
    }
}

type Rgb = [u8; 3];

/// Name, name of the colour and sRGB colour of pixels of an origin; `None` for the origin that no pixel has.
fn origin_color(origin: Origin) -> Option<(&'static str, &'static str, Rgb)> {
    match origin {
        Origin::Base => Some(("base", "white", [240, 240, 240])),
        Origin::TracedA1 => Some(("traced in A1", "orange", [240, 150, 30])),
        Origin::TracedA2 => Some(("traced in A2", "magenta", [210, 30, 130])),
        Origin::Postcorrected => Some(("postcorrected", "green", [60, 200, 80])),
        Origin::Interpolated => Some(("interpolated", "dark blue", [20, 50, 90])),
        Origin::Extra => None,
    }
}

/// Colours of pixels by the number of active subpixels (Jin 2009, Figure 1).
const ACTIVE: [(&str, Rgb); 5] = [
    ("black", [0, 0, 0]),
    ("red", [255, 0, 0]),
    ("green", [0, 255, 0]),
    ("blue", [0, 0, 255]),
    ("white", [255, 255, 255]),
];
const FAILED: Rgb = [255, 30, 20];
const NOTHING: Rgb = [0, 0, 0];
/// The colour ramp of [`false_color`], from the least value to the greatest.
const RAMP: [Rgb; 5] = [[10, 10, 40], [60, 40, 160], [200, 50, 110], [250, 150, 40], [255, 255, 200]];

/// The image and a legend of one line. `pixels` are the records of `frame`, row by row from the top left.
///
/// # Errors
/// `pixels` lacks records because the device could not hold them all.
pub fn picture(show: Show, frame: &DisplayImage, pixels: &[PixelRecord]) -> Result<(DisplayImage, String)> {
    let (width, height) = frame.dimensions();
    if show != Show::Final && pixels.len() as u64 != u64::from(width) * u64::from(height) {
        let expected = format!("final: records of {width}x{height} pixels exceed a binding of the device");
        return Err(Error::setting("show", expected, show.name()));
    }
    Ok(match show {
        Show::Final => (frame.clone(), String::new()),
        Show::Origin => origin(frame, pixels),
        Show::Check(check) => failing(frame, pixels, check),
        Show::Active => active(frame, pixels),
        Show::Attribute(attribute) => differing(frame, pixels, attribute),
        Show::Cost => cost(frame, pixels),
        Show::Depth => depth(frame, pixels),
        Show::Normal => {
            let legend = "normals, red x, green y, blue z, from -1 to 1; black is no hit".to_owned();
            (painted(frame, pixels, |_, p| normal(p)), legend)
        }
        Show::Oid => {
            let legend = "objects, a colour each; black is no hit".to_owned();
            (painted(frame, pixels, |_, p| p.object.map_or(NOTHING, hashed)), legend)
        }
    })
}

/// Formats a number with thousands separators: 1234567 as `1,234,567`.
#[must_use]
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

fn origin(frame: &DisplayImage, pixels: &[PixelRecord]) -> (DisplayImage, String) {
    let entry = |origin| {
        let (name, color, _) = origin_color(origin)?;
        let count = pixels.iter().filter(|pixel| pixel.origin == origin).count() as u64;
        Some(format!("{name} {color} ({})", grouped(count)))
    };
    let legend: Vec<_> = Origin::ALL.into_iter().filter_map(entry).collect();
    let color = |origin| origin_color(origin).map_or(NOTHING, |(_, _, color)| color);
    (painted(frame, pixels, |_, p| color(p.origin)), legend.join(", "))
}

fn active(frame: &DisplayImage, pixels: &[PixelRecord]) -> (DisplayImage, String) {
    let subpixels = |p: &PixelRecord| p.active.count_ones() as usize;
    let mut counts = [0_u64; 5];
    for pixel in pixels {
        counts[subpixels(pixel)] += 1;
    }
    let entry = |number: usize| format!("{number} {} ({})", ACTIVE[number].0, grouped(counts[number]));
    let legend: Vec<_> = (0..ACTIVE.len()).map(entry).collect();
    let legend = format!("quarters of a pixel with extra samples: {}", legend.join(", "));
    (painted(frame, pixels, |_, p| ACTIVE[subpixels(p)].1), legend)
}

fn differing(frame: &DisplayImage, pixels: &[PixelRecord], attribute: usize) -> (DisplayImage, String) {
    let what = format!("whose attribute {} differs from a neighbour's", THRESHOLD_NAMES[attribute]);
    marked(frame, pixels, &what, |p| p.differing & (1 << attribute) != 0)
}

fn failing(frame: &DisplayImage, pixels: &[PixelRecord], check: Check) -> (DisplayImage, String) {
    let what = format!("that fail check {} ({}, {})", check.name(), check.letters(), check.what());
    marked(frame, pixels, &what, |p| p.failed & check.bit() != 0)
}

/// Draws the selected pixels in red over a dimmed grey frame.
fn marked(
    frame: &DisplayImage,
    pixels: &[PixelRecord],
    what: &str,
    is: impl Fn(&PixelRecord) -> bool,
) -> (DisplayImage, String) {
    let count = pixels.iter().filter(|p| is(p)).count() as u64;
    let legend = format!("red: {} pixels {what}", grouped(count));
    (painted(frame, pixels, |color, p| if is(p) { FAILED } else { dimmed(color) }), legend)
}

fn cost(frame: &DisplayImage, pixels: &[PixelRecord]) -> (DisplayImage, String) {
    let least = pixels.iter().map(|p| p.cost).min().unwrap_or(0);
    let most = pixels.iter().map(|p| p.cost).max().unwrap_or(0);
    let position = |cost: u32| {
        let log = |v: u32| f64::from(v).ln_1p();
        if most > least { (log(cost) - log(least)) / (log(most) - log(least)) } else { 0.0 }
    };
    let legend = format!(
        "node visits and primitive tests a pixel, logarithmic from dark blue ({}) over red to light yellow ({})",
        grouped(least.into()),
        grouped(most.into())
    );
    (painted(frame, pixels, |_, p| false_color(position(p.cost))), legend)
}

fn depth(frame: &DisplayImage, pixels: &[PixelRecord]) -> (DisplayImage, String) {
    let finite = || pixels.iter().map(|p| p.depth).filter(|d| d.is_finite());
    let (near, far) = (finite().fold(f32::INFINITY, f32::min), finite().fold(f32::NEG_INFINITY, f32::max));
    if near > far {
        return (painted(frame, pixels, |_, _| NOTHING), "depth: no ray hits anything".to_owned());
    }
    let grey = |depth: f32| {
        let position = if far > near { (depth - near) / (far - near) } else { 0.0 };
        [(255.0 - 215.0 * position).round() as u8; 3]
    };
    let legend = format!("depth, light at {near:.4} to dark at {far:.4}; black is no hit");
    let image = painted(frame, pixels, |_, p| if p.depth.is_finite() { grey(p.depth) } else { NOTHING });
    (image, legend)
}

fn painted(
    frame: &DisplayImage,
    pixels: &[PixelRecord],
    color: impl Fn(Rgb, &PixelRecord) -> Rgb,
) -> DisplayImage {
    let mut image = frame.clone();
    for (shown, pixel) in image.pixels_mut().zip(pixels) {
        let [r, g, b, _] = shown.0;
        let [r, g, b] = color([r, g, b], pixel);
        shown.0 = [r, g, b, 255];
    }
    image
}

fn normal(pixel: &PixelRecord) -> Rgb {
    if pixel.normal == [0.0; 3] {
        return NOTHING;
    }
    pixel.normal.map(|n| (255.0 * (0.5 + 0.5 * n)).round() as u8)
}

fn dimmed([r, g, b]: Rgb) -> Rgb {
    let luma = 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b);
    [(0.5 * luma) as u8; 3]
}

fn false_color(position: f64) -> Rgb {
    let steps = (RAMP.len() - 1) as f64;
    let scaled = position.clamp(0.0, 1.0) * steps;
    let low = (scaled.floor() as usize).min(RAMP.len() - 2);
    let part = scaled - low as f64;
    std::array::from_fn(|i| {
        let (from, to) = (f64::from(RAMP[low][i]), f64::from(RAMP[low + 1][i]));
        (from + part * (to - from)).round() as u8
    })
}

/// A colour of an object from Wang's integer hash of its OID; every channel is at least 64.
fn hashed(object: u32) -> Rgb {
    let mut h = (object ^ 61) ^ (object >> 16);
    h = h.wrapping_mul(9);
    h ^= h >> 4;
    h = h.wrapping_mul(0x27d4_eb2d);
    h ^= h >> 15;
    [h, h >> 8, h >> 16].map(|bits| 64 + ((bits & 0xff) * 3 / 4) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HIT: PixelRecord = PixelRecord {
        origin: Origin::Base,
        failed: 0,
        cost: 10,
        active: 0b0101,
        differing: 0b10,
        strata: 0,
        object: Some(3),
        depth: 2.0,
        normal: [0.0, 0.0, 1.0],
    };
    const MISS: PixelRecord = PixelRecord {
        origin: Origin::Interpolated,
        failed: 1 << 4,
        cost: 0,
        active: 0,
        differing: 0,
        strata: 0,
        object: None,
        depth: f32::INFINITY,
        normal: [0.0; 3],
    };

    fn shown(show: Show) -> ([Rgb; 2], String) {
        let frame = DisplayImage::from_raw(2, 1, vec![200, 200, 200, 255, 100, 100, 100, 255]).unwrap();
        let (image, legend) = picture(show, &frame, &[HIT, MISS]).unwrap();
        let rgb = |x| {
            let [r, g, b, a] = image.get_pixel(x, 0).0;
            assert_eq!(a, 255);
            [r, g, b]
        };
        ([rgb(0), rgb(1)], legend)
    }

    #[test]
    fn each_picture_shows_what_it_is_named_for() {
        let (colors, legend) = shown(Show::Origin);
        assert_eq!(colors, [[240; 3], [20, 50, 90]]);
        assert!(legend.contains("base white (1)") && legend.contains("traced in A1 orange (0)"), "{legend}");

        let (colors, legend) = shown(Show::Check(Check::Tex));
        assert_eq!(colors, [[100, 100, 100], FAILED]);
        assert_eq!(legend, "red: 1 pixels that fail check tex (TX, texture seam)");
        assert_eq!(shown(Show::Check(Check::Oid)).0, [[100; 3], [50; 3]]);

        let (colors, legend) = shown(Show::Cost);
        assert_eq!(colors, [RAMP[4], RAMP[0]]);
        assert!(legend.contains("(0)") && legend.contains("(10)"), "{legend}");

        let (colors, legend) = shown(Show::Active);
        assert_eq!(colors, [ACTIVE[2].1, ACTIVE[0].1]);
        assert!(legend.contains("2 green (1)") && legend.contains("4 white (0)"), "{legend}");
        let (colors, legend) = shown(Show::Attribute(1));
        assert_eq!(colors, [FAILED, [50; 3]]);
        assert_eq!(legend, "red: 1 pixels whose attribute poid differs from a neighbour's");

        assert_eq!(shown(Show::Depth).0, [[255; 3], NOTHING]);
        assert_eq!(shown(Show::Normal).0, [[128, 128, 255], NOTHING]);
        assert_eq!(shown(Show::Oid).0[1], NOTHING);
        assert_eq!(shown(Show::Final).0, [[200; 3], [100; 3]]);
    }

    #[test]
    fn colours_of_origins_are_distinct() {
        let colors: Vec<_> = Origin::ALL.into_iter().filter_map(origin_color).collect();
        assert_eq!(colors.len(), Origin::ALL.len() - 1, "all but extra samples");
        for (i, a) in colors.iter().enumerate() {
            assert!(colors[..i].iter().all(|b| a.2 != b.2 && a.0 != b.0));
        }
    }

    #[test]
    fn neighbouring_objects_differ_and_none_is_black() {
        for object in 0..1000 {
            assert_ne!(hashed(object), hashed(object + 1));
            assert!(hashed(object).iter().all(|c| *c >= 64));
        }
    }

    #[test]
    fn an_empty_view_has_a_depth_picture() {
        let frame = DisplayImage::from_raw(1, 1, vec![9; 4]).unwrap();
        assert!(picture(Show::Depth, &frame, &[MISS]).unwrap().1.contains("no ray hits"));
        let without = picture(Show::Depth, &frame, &[]).unwrap_err().to_string();
        assert!(without.contains("show: expected final"), "{without}");
    }
}
