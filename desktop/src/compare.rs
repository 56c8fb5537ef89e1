//! `glimpse compare`: the error of image A against image B.

use std::path::Path;

use anyhow::{Context, anyhow};
use glimpse::metrics::{self, ErrorReport};
use glimpse::{Error, Picture};

use crate::args::CompareOptions;
use crate::{files, output, summary};

/// Runs `glimpse compare`.
pub fn run(options: &CompareOptions) -> anyhow::Result<()> {
    let report = measure(&options.a, &options.b)?;
    if options.json {
        output::print(&output::json(&report)?)
    } else {
        output::print(&(summary::error(&report) + "\n"))
    }
}

/// Measures the error of display-encoded images, and the RMSE of linear radiance as well if both files
/// contain it.
fn measure(a: &Path, b: &Path) -> anyhow::Result<ErrorReport> {
    let both = || format!("{} against {}", a.display(), b.display());
    let (a, b) = (read(a)?, read(b)?);
    let linear_rmse = match (&a, &b) {
        (Picture::Linear(a), Picture::Linear(b)) => {
            Some(metrics::linear_rmse(a, b).map_err(not_usage).with_context(both)?)
        }
        _ => None,
    };
    let report =
        metrics::compare(&a.into_display(), &b.into_display()).map_err(not_usage).with_context(both)?;
    Ok(ErrorReport { linear_rmse, ..report })
}

/// Turns a mismatch between the images into an error that is not reported as wrong usage.
fn not_usage(error: Error) -> anyhow::Error {
    match error {
        Error::Setting { expected, found, .. } => anyhow!("expected {expected}, found {found}"),
        other => other.into(),
    }
}

fn read(path: &Path) -> anyhow::Result<Picture> {
    let bytes = files::read(path)?;
    let name = path.display();
    Picture::decode(&bytes).map_err(|error| match error {
        Error::Image(_) => anyhow::Error::new(error).context(format!("{name}: expected a PNG or an EXR")),
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
        assert!(message.contains("text.png: expected a PNG or an EXR"), "{message}");
    }
}
