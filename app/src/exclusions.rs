//! What cannot be chosen together.

use glimpse::Method;

use crate::{Choices, FrameRate, Lenses, Show};

impl Choices {
    /// Why no frame can be made like this, for people; `None` if one can.
    #[must_use]
    pub fn conflict(&self) -> Option<&'static str> {
        let several = self.settings.sampling > 1;
        match (self.settings.method, self.show) {
            (Method::Checkerboard, _) if several => Some("A checkerboard has one sample a pixel."),
            (method, _) if several && method.keeps_frames() => Some("Pixels that are kept have one sample."),
            (method, _) if several && (method.takes_one_sample() || self.settings.supersample) => {
                Some("Extra samples are added to one sample a pixel.")
            }
            (_, show) if several && show != Show::Final => {
                Some("What is shown instead of the frame is about pixels of one sample.")
            }
            (Method::Checkerboard, Show::Check(_) | Show::Depth | Show::Normal | Show::Oid) => {
                Some("A checkerboard averages every second pixel: no surface belongs to an average.")
            }
            (method, Show::Active) if !self.settings.supersamples() && method != Method::Quincunx => {
                Some("Active pixels are those of the methods supersample and quincunx.")
            }
            (_, Show::Attribute(_)) if !self.settings.supersamples() => {
                Some("Attributes are compared where there are extra samples: method supersample.")
            }
            (method, Show::Check(_) | Show::Depth | Show::Normal | Show::Oid) if method.keeps_frames() => {
                Some("Of pixels that are kept only the colour is known.")
            }
            _ => None,
        }
    }

    /// The rate that the governor holds, where it has a say: a frame of another size keeps nothing of the one before.
    #[must_use]
    pub fn governed(&self) -> Option<FrameRate> {
        self.governor.filter(|_| !self.settings.method.keeps_frames())
    }

    /// Why the share of renewed pixels changes nothing; `None` if it does.
    #[must_use]
    pub fn share_rests(&self) -> Option<&'static str> {
        let method = self.settings.method;
        let renews = method.keeps_frames() && !method.follows_paths();
        (!renews).then_some("Only frameless and reproject keep pixels.")
    }

    /// Why what concerns paths changes nothing; `None` if it does.
    #[must_use]
    pub fn paths_rest(&self) -> Option<&'static str> {
        (!self.settings.method.follows_paths()).then_some("The methods path and vr follow paths.")
    }

    /// Why nothing is bent for lenses; `None` if it is.
    #[must_use]
    pub fn lenses_rest(&self) -> Option<&'static str> {
        match (self.settings.method, self.split) {
            (Method::Vr, None) => None,
            (Method::Vr, Some(_)) => Some("A split view is looked at without lenses."),
            _ => Some("Lenses are before the pictures of two eyes: method vr."),
        }
    }

    /// Are pictures bent for lenses?
    #[must_use]
    pub fn bends(&self) -> bool {
        self.lenses != Lenses::None && self.lenses_rest().is_none()
    }

    /// Why the knobs of the adaptive method change nothing; `None` if they do.
    #[must_use]
    pub fn tolerances_rest(&self) -> Option<&'static str> {
        (self.settings.method != Method::Adaptive).then_some("The adaptive method alone interpolates.")
    }

    /// Why no extra samples can be added to the frame; `None` if they can.
    #[must_use]
    pub fn supersample_rests(&self) -> Option<&'static str> {
        (self.settings.method != Method::Adaptive)
            .then_some("Extra samples are added to the adaptive method.")
    }

    /// Why thresholds change nothing; `None` if they do.
    #[must_use]
    pub fn thresholds_rest(&self) -> Option<&'static str> {
        (!self.settings.supersamples()).then_some("Thresholds are about extra samples: method supersample.")
    }

    /// Why the scale changes nothing; `None` if it does.
    #[must_use]
    pub fn scale_rests(&self) -> Option<&'static str> {
        self.governed().map(|_| "The governor chooses the scale: switch it off first.")
    }
}
