//! Choices that exclude each other, with the reasons shown to the user.

use glimpse::{Method, Preset, Settings, Show};

use crate::{AtRest, Choices, FrameRate, Lenses};

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

    /// Settings of the refined frame of a view at rest: the chosen ones with refinement, by [`Preset::Refined`]; `None` where
    /// that frame is the chosen one.
    #[must_use]
    pub fn refined(&self) -> Option<Settings> {
        let is_wanted = self.at_rest == AtRest::Refined && self.governed().is_some();
        (is_wanted && self.at_rest_inapplicable().is_none()).then(|| self.with_refinement())
    }

    fn with_refinement(&self) -> Settings {
        Settings { supersample: true, thresholds: Preset::Refined.thresholds(), ..self.settings }
    }

    /// Reason why frames of a view at rest are not refined; `None` if they can be.
    #[must_use]
    pub fn at_rest_inapplicable(&self) -> Option<&'static str> {
        let chosen = &self.settings;
        if self.governed().is_none() {
            Some("Without the governor, frames at rest are as all others.")
        } else if chosen.method != Method::Adaptive {
            Some("Only frames of method adaptive are refined.")
        } else if chosen.supersample {
            Some("The frames are chosen with extra samples.")
        } else if self.split.is_some() || self.show != Show::Final {
            Some("What is compared or visualised is the frame as it was chosen.")
        } else if self.with_refinement().validate().is_err() {
            Some("These settings have no refinement.")
        } else {
            None
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_at_rest_is_refined_where_it_is_no_other_one() {
        let usual = Choices::default();
        let refined = usual.refined().expect("refined settings");
        assert!(refined.refines() && refined.validate().is_ok());
        assert_eq!(
            Settings { supersample: false, thresholds: usual.settings.thresholds, ..refined },
            usual.settings
        );
        let with = |change: fn(&mut Choices)| {
            let mut choices = usual;
            change(&mut choices);
            choices.refined()
        };
        assert_eq!(with(|choices| choices.at_rest = AtRest::Chosen), None);
        assert_eq!(with(|choices| choices.governor = None), None);
        assert_eq!(with(|choices| choices.settings.method = Method::Full), None);
        assert_eq!(with(|choices| choices.settings.supersample = true), None);
        assert_eq!(with(|choices| choices.split = Some(0.5)), None);
        assert_eq!(with(|choices| choices.show = Show::Origin), None);
    }
}
