//! Choices that exclude each other, with the reasons shown to the user.

use glimpse::Method;

use crate::{Choices, FrameRate, Lenses};

impl Choices {
    /// Reason why no frame can be rendered with these choices; `None` if one can.
    #[must_use]
    pub fn conflict(&self) -> Option<String> {
        let settings = self.settings.validate().err().map(|error| error.to_string());
        settings.or_else(|| self.show.conflict(&self.settings).map(str::to_owned))
    }

    /// Frame rate that the governor holds; `None` if it is off or does not apply to the method.
    #[must_use]
    pub fn governed(&self) -> Option<FrameRate> {
        self.governor.filter(|_| self.governor_rests().is_none())
    }

    /// Reason why the governor does not apply; `None` if it does.
    #[must_use]
    pub fn governor_rests(&self) -> Option<&'static str> {
        let keeps = self.settings.method.has_history();
        keeps.then_some(
            "A frame of another size keeps nothing of the one before: this method is not governed.",
        )
    }

    /// Reason why pictures are not distorted for lenses; `None` if lenses apply.
    #[must_use]
    pub fn lenses_inapplicable(&self) -> Option<&'static str> {
        match (self.settings.method, self.split) {
            (Method::Vr, None) => None,
            (Method::Vr, Some(_)) => Some("A split view is looked at without lenses."),
            _ => Some("Lenses are before the pictures of two eyes: method vr."),
        }
    }

    /// Whether pictures are distorted for lenses.
    #[must_use]
    pub fn bends(&self) -> bool {
        self.lenses != Lenses::None && self.lenses_inapplicable().is_none()
    }

    /// Reason why the scale has no effect; `None` if it has one.
    #[must_use]
    pub fn scale_inapplicable(&self) -> Option<&'static str> {
        self.governed().map(|_| "The governor chooses the scale: switch it off first.")
    }
}
