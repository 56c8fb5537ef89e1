//! Embeds the pictures of a scene, their differences from the reference and their FLIP maps as data URIs.

use anyhow::Context;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glimpse::metrics::flip_picture;
use glimpse::{DisplayImage, to_png};

use crate::scene::SceneReport;
use crate::store::Store;

/// Factor on the absolute differences in the error maps.
const GAIN: u8 = 8;

/// A picture of the page with its caption.
pub struct Figure {
    /// Data URI of a PNG.
    pub source: String,
    /// Caption, also the alternative text.
    pub caption: String,
}

/// The converged frame, then each stored picture of the ladder with its difference and its FLIP map.
pub fn of(store: &Store, scene: &SceneReport) -> anyhow::Result<Vec<Figure>> {
    let mut figures = Vec::new();
    for measured in scene.measured.iter().filter(|measured| measured.job.is_ladder()) {
        let Some(converged) = &measured.converged else { continue };
        let kept = |identity: &str| {
            let picture = store.picture(identity, measured.job.shown);
            picture.with_context(|| {
                format!("a picture of {} is gone: it was removed meanwhile", scene.prepared.name)
            })
        };
        let reference = kept(converged)?;
        figures.push(figure(&reference, "reference, 256 samples a pixel".to_owned())?);
        for (rung, identity) in measured.job.rungs.iter().zip(&measured.identities) {
            if rung.keeps_picture {
                let picture = kept(identity)?;
                let name = rung.label();
                figures.push(figure(&picture, name.clone())?);
                let caption = format!("{name}: difference from the reference x {GAIN}, by channel");
                figures.push(figure(&error_map(&picture, &reference), caption)?);
                let caption = format!("{name}: FLIP, from 0 (black) to 1 (yellow)");
                figures.push(figure(&flip_picture(&picture, &reference)?, caption)?);
            }
        }
    }
    Ok(figures)
}

fn figure(picture: &DisplayImage, caption: String) -> anyhow::Result<Figure> {
    let source = format!("data:image/png;base64,{}", BASE64_STANDARD.encode(to_png(picture)?));
    Ok(Figure { source, caption })
}

/// Absolute difference per channel, times [`GAIN`]; black where the pictures are equal.
fn error_map(a: &DisplayImage, b: &DisplayImage) -> DisplayImage {
    let mut map = a.clone();
    for (pixel, reference) in map.pixels_mut().zip(b.pixels()) {
        for channel in 0..3 {
            pixel.0[channel] = pixel.0[channel].abs_diff(reference.0[channel]).saturating_mul(GAIN);
        }
    }
    map
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_maps_show_differences_by_channel() {
        let a = DisplayImage::from_raw(2, 1, vec![10, 20, 30, 255, 0, 255, 7, 255]).unwrap();
        let b = DisplayImage::from_raw(2, 1, vec![10, 18, 35, 255, 255, 0, 7, 255]).unwrap();
        assert_eq!(error_map(&a, &b).into_raw(), [0, 16, 40, 255, 255, 255, 0, 255]);
    }

    #[test]
    fn figures_are_pngs_inside_of_the_page() {
        let figure = figure(&DisplayImage::new(1, 1), "c".to_owned()).unwrap();
        let bytes =
            BASE64_STANDARD.decode(figure.source.strip_prefix("data:image/png;base64,").unwrap()).unwrap();
        assert_eq!(bytes[1..4], *b"PNG");
    }
}
