//! `glimpse compare`: the error of image A against image B, and whether it is within bounds.

use std::error::Error as _;
use std::path::Path;

use anyhow::{Context, anyhow};
use glimpse::metrics::{self, Bounds, ErrorReport, Violation};
use glimpse::{DisplayImage, Error, Picture, to_png};
use image::ImageError;
use serde::Serialize;

use crate::args::CompareOptions;
use crate::diff;
use crate::{files, output, summary};

/// What was measured of a picture against its reference.
#[derive(Serialize)]
pub struct Comparison {
    #[serde(flatten)]
    pub report: ErrorReport,
    /// Number of pixels of which a channel differs by more than the threshold.
    pub failed_pixels: u64,
    /// Bounds that do not hold.
    pub violations: Vec<Violation>,
}

impl Comparison {
    pub fn of(a: &DisplayImage, b: &DisplayImage, bounds: &Bounds) -> glimpse::Result<Self> {
        Self::reported(metrics::compare(a, b)?, a, b, bounds)
    }

    fn reported(
        report: ErrorReport,
        a: &DisplayImage,
        b: &DisplayImage,
        bounds: &Bounds,
    ) -> glimpse::Result<Self> {
        let failed_pixels = metrics::failed_pixels(a, b, bounds.threshold)?;
        Ok(Self { violations: bounds.violations(&report, failed_pixels), report, failed_pixels })
    }

    /// One line of what was measured.
    pub fn text(&self, bounds: &Bounds) -> String {
        let counted = output::counted(self.failed_pixels as usize, "pixel");
        format!("{}, {counted} beyond {}", summary::error(&self.report), bounds.threshold)
    }

    /// The bounds that do not hold, with what was found; `None` if all hold.
    pub fn complaint(&self) -> Option<String> {
        let lines: Vec<_> = self.violations.iter().map(|violation| format!("--{violation}")).collect();
        (!lines.is_empty()).then(|| lines.join("; "))
    }
}

/// Runs `glimpse compare`.
pub fn run(options: &CompareOptions) -> anyhow::Result<()> {
    let (a, b) = (options.a.as_path(), options.b.as_path());
    files::check(&options.diff.iter().map(std::path::PathBuf::as_path).collect::<Vec<_>>(), &[a, b])?;
    let bounds = options.bounds.bounds();
    let (comparison, [shown, reference]) = measure(a, b, &bounds)?;
    if let Some(path) = &options.diff {
        let picture = diff::picture(&shown, &reference, bounds.threshold, options.diff_kind)?;
        files::write(path, &to_png(&picture)?)?;
    }
    let text = if options.json { output::json(&comparison)? } else { comparison.text(&bounds) + "\n" };
    match &options.diff {
        Some(path) if files::is_standard(path) => output::print_aside(&text),
        _ => output::print(&text)?,
    }
    match comparison.complaint() {
        None => Ok(()),
        Some(complaint) => Err(anyhow!("{} against {}: {complaint}", a.display(), b.display())),
    }
}

/// Measures the error of display-encoded images, and the RMSE of linear radiance as well if both files
/// contain it. Returns the display-encoded images too.
fn measure(a: &Path, b: &Path, bounds: &Bounds) -> anyhow::Result<(Comparison, [DisplayImage; 2])> {
    let both = || format!("{} against {}", a.display(), b.display());
    let (a, b) = (read(a)?, read(b)?);
    let linear_rmse = match (&a, &b) {
        (Picture::Linear(a), Picture::Linear(b)) => {
            Some(metrics::linear_rmse(a, b).map_err(not_usage).with_context(both)?)
        }
        _ => None,
    };
    let (a, b) = (a.into_display(), b.into_display());
    let report = metrics::compare(&a, &b).map_err(not_usage).with_context(both)?;
    let comparison = Comparison::reported(ErrorReport { linear_rmse, ..report }, &a, &b, bounds)?;
    Ok((comparison, [a, b]))
}

/// Turns a mismatch between the images into an error that is not reported as wrong usage.
pub fn not_usage(error: Error) -> anyhow::Error {
    match error {
        Error::Setting { expected, found, .. } => anyhow!("expected {expected}, found {found}"),
        other => other.into(),
    }
}

/// What is found in the place of a picture.
fn fault(error: &ImageError) -> String {
    match error {
        ImageError::Unsupported(_) => "found neither".to_owned(),
        // The message itself repeats the format.
        ImageError::Decoding(decoding) => {
            format!(
                "found a damaged one: {}",
                decoding.source().map_or_else(|| decoding.to_string(), ToString::to_string)
            )
        }
        error => format!("found a damaged one: {error}"),
    }
}

/// Reads a picture.
pub fn read(path: &Path) -> anyhow::Result<Picture> {
    let bytes = files::read(path)?;
    let name = path.display();
    Picture::decode(&bytes).map_err(|error| match error {
        Error::Image(error) => anyhow!("{name}: expected a PNG or an EXR, {}", fault(&error)),
        error => not_usage(error).context(name.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use glimpse::{DisplayImage, LinearImage, to_exr, to_png};

    use super::*;

    #[test]
    fn files_of_both_kinds_are_measured() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, bytes: Vec<u8>| {
            let path = folder.path().join(name);
            files::write(&path, &bytes).unwrap();
            path
        };
        let linear = |v: f32| to_exr(&LinearImage::from_raw(9, 9, vec![v; 243]).unwrap()).unwrap();
        let grey = |v: u8| to_png(&DisplayImage::from_raw(9, 9, [v, v, v, 255].repeat(81)).unwrap()).unwrap();
        let (white, light) = (write("white.exr", linear(1.0)), write("light.exr", linear(3.0)));
        let (png, dim) = (write("white.png", grey(255)), write("dim.png", grey(250)));

        let measure = |a: &Path, b: &Path| measure(a, b, &Bounds::default()).map(|(found, _)| found.report);
        let report = measure(&white, &light).unwrap();
        assert_eq!((report.rmse, report.linear_rmse), (0.0, Some(2.0)), "clipped alike, radiance apart");
        assert_eq!(measure(&white, &png).unwrap().psnr_db, None);
        assert_eq!(measure(&dim, &white).unwrap().rmse, 5.0);

        let small = write("small.png", to_png(&DisplayImage::new(2, 3)).unwrap());
        let message = format!("{:#}", measure(&small, &png).unwrap_err());
        assert!(message.contains("small.png against") && message.contains("2x3 and 9x9"), "{message}");
        let nan = LinearImage::from_raw(9, 9, vec![f32::NAN; 243]).unwrap();
        let nan = write("nan.exr", to_exr(&nan).unwrap());
        for (a, b) in [(&nan, &png), (&png, &nan), (&nan, &white)] {
            let message = format!("{:#}", measure(a, b).unwrap_err());
            assert!(message.contains("nan.exr: expected finite radiance, found"), "{message}");
        }
        let text = write("text.png", b"no picture".to_vec());
        let message = format!("{:#}", measure(&text, &png).unwrap_err());
        assert!(message.ends_with("text.png: expected a PNG or an EXR, found neither"), "{message}");
        let cut = write("cut.png", files::read(&png).unwrap()[..60].to_vec());
        let message = crate::errors::told(&measure(&cut, &png).unwrap_err());
        assert_eq!(message.matches("PNG").count() + message.matches("Png").count(), 1, "{message}");
    }
}
