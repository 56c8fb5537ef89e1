//! Golden frames: `golden/NAME.png`, with `golden/NAME.toml`, which records how it was made and the allowed
//! difference. A missing golden is a failure; `GLIMPSE_UPDATE_GOLDEN=1` writes what was rendered, and still
//! fails, so that no run both makes and passes a golden.

use std::{
    fs,
    path::{Path, PathBuf},
};

use glimpse::DisplayImage;
use serde::{Deserialize, Serialize};

use crate::{
    compare::{Tolerance, compare, difference_image},
    workspace,
};

/// The command that writes the goldens.
pub const COMMAND: &str = "GLIMPSE_UPDATE_GOLDEN=1 cargo test --release -p glimpse-tests --test gpu golden";

/// Default for new goldens. On the adapter that made the golden there is no difference; this leaves room for
/// the rounding of other processors. A wrong pixel still shows in the worst tile.
pub const TOLERANCE: Tolerance = Tolerance { threshold: 2, max_failed_pixels: 4, worst_tile_rmse: 0.5 };

/// Contents of `NAME.toml`: the origin of a golden and the allowed difference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Origin {
    /// Name of the adapter that rendered the golden.
    pub adapter: String,
    /// Driver of the adapter with its version.
    pub driver: String,
    /// Command that renders the golden again.
    pub command: String,
    /// Bounds of the comparison.
    pub tolerance: Tolerance,
}

/// The folder of the goldens, and whether to compare or to update them.
pub struct Goldens {
    /// Folder of the goldens.
    pub folder: PathBuf,
    /// Folder for the pictures of a failure.
    pub failures: PathBuf,
    /// Whether to write goldens instead of comparing with them.
    pub update: bool,
    /// Name of the current adapter.
    pub adapter: String,
    /// Driver of the adapter with its version.
    pub driver: String,
}

impl Goldens {
    /// The goldens of this project; the environment selects whether to update them.
    #[must_use]
    pub fn of_project(info: &wgpu::AdapterInfo) -> Self {
        Self {
            folder: workspace().join("tests/golden"),
            failures: workspace().join("target/golden-failures"),
            update: std::env::var("GLIMPSE_UPDATE_GOLDEN").is_ok_and(|value| value == "1"),
            adapter: info.name.clone(),
            driver: info.driver_info.clone(),
        }
    }

    /// Compares a frame with the golden of this name.
    ///
    /// # Errors
    /// If the frame differs, there is no golden, or one was written.
    pub fn check(&self, name: &str, actual: &DisplayImage) -> Result<(), String> {
        let picture = self.folder.join(format!("{name}.png"));
        let origin = self.folder.join(format!("{name}.toml"));
        if self.update {
            return Err(self.write(&picture, &origin, actual));
        }
        let expected = image::open(&picture)
            .map_err(|e| format!("{}: {e}\nto make it: {COMMAND}", picture.display()))?
            .into_rgba8();
        let origin = read_origin(&origin)?;
        compare(actual, &expected, &origin.tolerance).map(|_| ()).map_err(|difference| {
            let kept = self.keep_failure(name, actual, &expected);
            format!(
                "{name} is not as it was\n{difference}\ngolden made on {}, {}; this is {}, {}\n{kept}",
                origin.adapter, origin.driver, self.adapter, self.driver
            )
        })
    }

    fn write(&self, picture: &Path, origin: &Path, actual: &DisplayImage) -> String {
        let tolerance = read_origin(origin).map_or(TOLERANCE, |old| old.tolerance);
        let made = Origin {
            adapter: self.adapter.clone(),
            driver: self.driver.clone(),
            command: COMMAND.to_owned(),
            tolerance,
        };
        let written = fs::create_dir_all(&self.folder)
            .map_err(|e| e.to_string())
            .and_then(|()| glimpse::to_png(actual).map_err(|e| e.to_string()))
            .and_then(|bytes| fs::write(picture, bytes).map_err(|e| e.to_string()))
            .and_then(|()| toml::to_string(&made).map_err(|e| e.to_string()))
            .and_then(|text| fs::write(origin, text).map_err(|e| e.to_string()));
        match written {
            Ok(()) => {
                format!("wrote {}: look at it, then run without GLIMPSE_UPDATE_GOLDEN", picture.display())
            }
            Err(error) => format!("cannot write {}: {error}", picture.display()),
        }
    }

    fn keep_failure(&self, name: &str, actual: &DisplayImage, expected: &DisplayImage) -> String {
        let keep = |suffix: &str, picture: &DisplayImage| {
            let path = self.failures.join(format!("{name}.{suffix}.png"));
            fs::create_dir_all(&self.failures)
                .map_err(|e| e.to_string())
                .and_then(|()| glimpse::to_png(picture).map_err(|e| e.to_string()))
                .and_then(|bytes| fs::write(&path, bytes).map_err(|e| e.to_string()))
                .map_or_else(
                    |e| format!("cannot write {}: {e}", path.display()),
                    |()| path.display().to_string(),
                )
        };
        format!(
            "see {}\nand {}",
            keep("actual", actual),
            keep("difference", &difference_image(actual, expected))
        )
    }
}

fn read_origin(path: &Path) -> Result<Origin, String> {
    let text = fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    toml::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))
}
