//! The time passed in by the shell, and durations measured with it.

use std::time::Duration;

/// Duration for which a notice is shown.
const NOTICE: Duration = Duration::from_secs(4);

/// Time of the current update, measured from an arbitrary fixed moment.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Clock {
    now: Duration,
    loading_since: Duration,
    notice_until: Duration,
}

impl Clock {
    /// Time of the current update.
    pub fn now(&self) -> Duration {
        self.now
    }

    /// Advances to the update at `now`; returns the time since the last one.
    pub fn advance(&mut self, now: Duration) -> Duration {
        let passed = now.saturating_sub(self.now);
        self.now = now;
        passed
    }

    /// Records that loading a scene starts now.
    pub fn loading_began(&mut self) {
        self.loading_since = self.now;
    }

    /// Seconds since loading of the last scene started.
    pub fn seconds_of_loading(&self) -> f64 {
        self.now.saturating_sub(self.loading_since).as_secs_f64()
    }

    /// Records that a notice is shown from now on.
    pub fn notice_began(&mut self) {
        self.notice_until = self.now + NOTICE;
    }

    /// Whether the last notice has been shown long enough.
    pub fn notice_is_over(&self) -> bool {
        self.now >= self.notice_until
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_notice_lasts_four_seconds() {
        let mut clock = Clock::default();
        assert_eq!(clock.advance(Duration::from_secs(2)), Duration::from_secs(2));
        clock.notice_began();
        clock.loading_began();
        assert_eq!(clock.advance(Duration::from_secs(5)), Duration::from_secs(3));
        assert!(!clock.notice_is_over());
        clock.advance(Duration::from_secs(6));
        assert!(clock.notice_is_over());
        assert_eq!(clock.seconds_of_loading(), 4.0);
    }
}
