//! What cannot be chosen together.

use glimpse::Method;

use crate::{Choices, Show};

impl Choices {
    /// Why no frame can be made like this, for people; `None` if one can.
    #[must_use]
    pub fn conflict(&self) -> Option<&'static str> {
        let several = self.settings.sampling > 1;
        match (self.settings.method, self.show) {
            (Method::Checkerboard, _) if several => Some("A checkerboard has one sample a pixel."),
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
            _ => None,
        }
    }

    /// Why the knobs of the adaptive method change nothing; `None` if they do.
    #[must_use]
    pub fn tolerances_rest(&self) -> Option<&'static str> {
        (self.settings.method != Method::Adaptive).then_some("The adaptive method alone interpolates.")
    }

    /// Why the scale changes nothing; `None` if it does.
    #[must_use]
    pub fn scale_rests(&self) -> Option<&'static str> {
        self.governor.map(|_| "The governor chooses the scale: switch it off first.")
    }
}
