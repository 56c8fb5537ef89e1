//! What a person has chosen: everything that the overlay changes and a frame is made by.

use glimpse::{Paths, Settings, Show};

use crate::Lenses;

/// Everything that can be chosen while a scene is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choices {
    /// How frames are made.
    pub settings: Settings,
    /// What the picture shows.
    pub show: Show,
    /// Full ray tracing to the right of this share of the width, 0 to 1.
    pub split: Option<f32>,
    /// What two eyes' pictures are looked at through.
    pub lenses: Lenses,
    /// Pixels of a frame along a side, over those of the view, while nothing governs it: [`SCALES`].
    pub scale: f32,
    /// Holds a frame time by scale, block and tolerances while the camera moves.
    pub governor: Option<FrameRate>,
    /// What dragging does.
    pub navigation: Navigation,
    /// When a picture goes to the screen.
    pub vsync: Vsync,
    /// How much of the overlay is shown.
    pub overlay: Overlay,
    /// The page of keys and gestures is open.
    pub help: bool,
    /// Size of the overlay's text and controls, over the system's: [`TEXT_SCALES`].
    pub text_scale: f32,
}

/// Samples of paths that a resting picture is to have.
const SAMPLES: u32 = 64;

/// The least and the largest [`Choices::scale`].
pub const SCALES: [f32; 2] = [0.125, 1.0];

/// The least and the largest [`Choices::text_scale`].
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
            navigation: Navigation::Orbit,
            vsync: Vsync::On,
            overlay: Overlay::Brief,
            help: false,
            text_scale: 1.0,
        }
    }
}

impl Choices {
    /// Splits the view in the middle, or no longer.
    pub fn toggle_split(&mut self) {
        self.split = if self.split.is_some() { None } else { Some(0.5) };
    }
}

/// Frames a second that the governor holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameRate {
    /// 66.7 ms a frame: for devices that are CPUs.
    Fifteen,
    /// 33.3 ms a frame.
    Thirty,
    /// 16.7 ms a frame.
    Sixty,
}

impl FrameRate {
    /// The time of a frame in milliseconds.
    #[must_use]
    pub fn budget_ms(self) -> f64 {
        match self {
            Self::Fifteen => 1000.0 / 15.0,
            Self::Thirty => 1000.0 / 30.0,
            Self::Sixty => 1000.0 / 60.0,
        }
    }
}

/// What dragging does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Navigation {
    /// Turns the camera around a point.
    Orbit,
    /// Turns the camera around itself; keys move it.
    Fly,
}

/// When a picture goes to the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vsync {
    /// With the display's refresh, each in turn.
    On,
    /// With the display's refresh, the newest.
    Newest,
    /// At once; pictures may tear.
    Off,
}

/// How much of the overlay is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// The picture alone.
    Hidden,
    /// A line with the frame time.
    Brief,
    /// Everything.
    Full,
}

impl Overlay {
    /// The one that follows, in a circle.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Hidden => Self::Brief,
            Self::Brief => Self::Full,
            Self::Full => Self::Hidden,
        }
    }
}
