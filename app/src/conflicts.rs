//! What cannot be chosen together.

use glimpse::Method;

use crate::{Choices, FrameRate, Lenses};

impl Choices {
    /// Why no frame can be made like this, for people; `None` if one can.
    #[must_use]
    pub fn conflict(&self) -> Option<String> {
        let settings = self.settings.validate().err().map(|error| error.to_string());
        settings.or_else(|| self.show.conflict(&self.settings).map(str::to_owned))
    }

    /// The rate that the governor holds, where it has a say.
    #[must_use]
    pub fn governed(&self) -> Option<FrameRate> {
        self.governor.filter(|_| self.governor_rests().is_none())
    }

    /// Why nothing can be governed; `None` if it can.
    #[must_use]
    pub fn governor_rests(&self) -> Option<&'static str> {
        let keeps = self.settings.method.has_history();
        keeps.then_some(
            "A frame of another size keeps nothing of the one before: this method is not governed.",
        )
    }

    /// Why nothing is bent for lenses; `None` if it is.
    #[must_use]
    pub fn lenses_inapplicable(&self) -> Option<&'static str> {
        match (self.settings.method, self.split) {
            (Method::Vr, None) => None,
            (Method::Vr, Some(_)) => Some("A split view is looked at without lenses."),
            _ => Some("Lenses are before the pictures of two eyes: method vr."),
        }
    }

    /// Are pictures bent for lenses?
    #[must_use]
    pub fn bends(&self) -> bool {
        self.lenses != Lenses::None && self.lenses_inapplicable().is_none()
    }

    /// Why the scale changes nothing; `None` if it does.
    #[must_use]
    pub fn scale_inapplicable(&self) -> Option<&'static str> {
        self.governed().map(|_| "The governor chooses the scale: switch it off first.")
    }
}
