//! The user's choices: everything that the overlay changes and that determines a frame.

use glimpse::{Paths, Settings, Show};

use crate::Lenses;

/// Everything that the user can choose while a scene is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choices {
    /// Rendering settings.
    pub settings: Settings,
    /// Quantity that the picture shows.
    pub show: Show,
    /// Position of the split, as a share of the width from 0 to 1: full ray tracing is shown to the right of
    /// it.
    pub split: Option<f32>,
    /// Lenses in front of the pictures for two eyes, against whose distortion they are distorted.
    pub lenses: Lenses,
    /// Ratio of the frame's side to the view's while the governor is off, within [`SCALES`].
    pub scale: f32,
    /// Frame rate that the governor holds while the camera moves, by scale, block size and tolerances; `None`
    /// turns it off.
    pub governor: Option<FrameRate>,
    /// Quality of the frame of a view at rest, while the governor is on.
    pub at_rest: AtRest,
    /// Navigation mode: the meaning of a drag.
    pub navigation: Navigation,
    /// Presentation mode of the display.
    pub vsync: Vsync,
    /// How much of the overlay is shown.
    pub overlay: Overlay,
    /// Whether the help page is open.
    pub help: bool,
    /// Ratio of the size of text and controls to the system's, within [`TEXT_SCALES`].
    pub text_scale: f32,
}

/// Samples per pixel of a path traced picture at rest.
const SAMPLES: u32 = 64;

/// Least and largest [`Choices::scale`].
pub const SCALES: [f32; 2] = [0.125, 1.0];

/// Least and largest [`Choices::text_scale`].
pub const TEXT_SCALES: [f32; 2] = [0.75, 2.0];

impl Default for Choices {
    fn default() -> Self {
        Self {
            settings: Settings {
                paths: Paths { samples: SAMPLES, ..Paths::default() },
                ..Settings::default()
            },
            show: Show::Final,
            split: None,
            lenses: Lenses::None,
            scale: 1.0,
            governor: Some(FrameRate::Thirty),
            at_rest: AtRest::Refined,
            navigation: Navigation::Orbit,
            vsync: Vsync::On,
            overlay: Overlay::Brief,
            help: false,
            text_scale: 1.0,
        }
    }
}

impl Choices {
    /// Splits the view in the middle, or ends the split.
    pub fn toggle_split(&mut self) {
        self.split = if self.split.is_some() { None } else { Some(0.5) };
    }
}

/// Frame rate that the governor holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameRate {
    /// 66.7 ms per frame, for devices that are CPUs.
    Fifteen,
    /// 33.3 ms per frame.
    Thirty,
    /// 16.7 ms per frame.
    Sixty,
}

impl FrameRate {
    /// The governor's choices with their names in scripts; `None` is off. Overlay and scripts follow from this table.
    pub const GOVERNOR: [(Option<Self>, &'static str); 4] =
        [(None, "off"), (Some(Self::Fifteen), "15"), (Some(Self::Thirty), "30"), (Some(Self::Sixty), "60")];

    /// Time of a frame in milliseconds.
    #[must_use]
    pub fn budget_ms(self) -> f64 {
        match self {
            Self::Fifteen => 1000.0 / 15.0,
            Self::Thirty => 1000.0 / 30.0,
            Self::Sixty => 1000.0 / 60.0,
        }
    }
}

/// Quality of the frame of a view at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtRest {
    /// As it was chosen.
    Chosen,
    /// First as it was chosen, then with extra samples where pixels differ from their neighbours: see
    /// [`Choices::refined`].
    Refined,
}

impl AtRest {
    /// Both, with their names in the overlay and in scripts.
    pub const NAMED: [(Self, &'static str); 2] = [(Self::Chosen, "chosen"), (Self::Refined, "refined")];
}

/// Navigation mode: the meaning of a drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Navigation {
    /// A drag rotates the camera around a point.
    Orbit,
    /// A drag rotates the camera around itself; keys move it.
    Fly,
}

/// Presentation mode of the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vsync {
    /// Each picture is shown at a refresh, in order.
    On,
    /// The newest picture is shown at each refresh.
    Newest,
    /// Pictures are shown immediately and may tear.
    Off,
}

/// How much of the overlay is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// Nothing but the picture.
    Hidden,
    /// One line with the frame time.
    Brief,
    /// All controls and readings.
    Full,
}

impl Overlay {
    /// The next state, in a circle.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Hidden => Self::Brief,
            Self::Brief => Self::Full,
            Self::Full => Self::Hidden,
        }
    }
}
