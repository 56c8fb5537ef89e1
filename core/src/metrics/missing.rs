//! Missing objects (Kim 2016, section 4): objects that full ray tracing shows and a frame does not.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use crate::PixelRecord;

/// Objects and pixels that a frame lost against full ray tracing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Missing {
    /// Number of objects that full ray tracing shows in at least one pixel.
    pub objects_shown: u64,
    /// Objects among them that have no pixel in the frame.
    pub objects_lost: u64,
    /// Number of pixels in which full ray tracing shows an object.
    pub pixels_shown: u64,
    /// Pixels among them that show another object in the frame, or none.
    pub pixels_lost: u64,
    /// Share of an object's pixels that are lost, averaged over objects: a wire counts as much as a wall.
    pub mean_share_lost: f64,
}

impl Missing {
    /// Compares the records of a frame with those of full ray tracing, pixel by pixel; `None` for frames of different
    /// sizes, or without records.
    #[must_use]
    pub fn of(full: &[PixelRecord], frame: &[PixelRecord]) -> Option<Self> {
        if full.is_empty() || full.len() != frame.len() {
            return None;
        }
        // Pixels by object: shown by full tracing, and lost of these.
        let mut of_object: HashMap<u32, [u64; 2]> = HashMap::new();
        for (reference, pixel) in full.iter().zip(frame) {
            let Some(object) = reference.object else { continue };
            let [shown, lost] = of_object.entry(object).or_default();
            *shown += 1;
            *lost += u64::from(pixel.object != Some(object));
        }
        let mut missing = Self { objects_shown: of_object.len() as u64, ..Self::default() };
        let elsewhere: std::collections::HashSet<u32> = frame.iter().filter_map(|p| p.object).collect();
        // In the order of the objects, so that the sum is the same every time.
        let mut objects: Vec<_> = of_object.into_iter().collect();
        objects.sort_unstable();
        for (object, [shown, lost]) in objects {
            missing.pixels_shown += shown;
            missing.pixels_lost += lost;
            missing.objects_lost += u64::from(!elsewhere.contains(&object));
            missing.mean_share_lost += lost as f64 / shown as f64;
        }
        missing.mean_share_lost /= missing.objects_shown.max(1) as f64;
        Some(missing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Origin;

    fn pixels(objects: &[Option<u32>]) -> Vec<PixelRecord> {
        let record = |object: &Option<u32>| PixelRecord {
            active: 0,
            differing: 0,
            strata: 0,
            origin: Origin::Base,
            failed: 0,
            cost: 0,
            object: *object,
            depth: 1.0,
            normal: [0.0, 0.0, 1.0],
        };
        objects.iter().map(record).collect()
    }

    #[test]
    fn a_frame_misses_nothing_of_itself() {
        let frame = pixels(&[Some(3), None, Some(1), Some(1)]);
        let expected = Missing { objects_shown: 2, pixels_shown: 3, ..Missing::default() };
        assert_eq!(Missing::of(&frame, &frame), Some(expected));
    }

    #[test]
    fn objects_are_lost_where_nothing_of_them_is_left() {
        // 7 is gone, half of 1 shows 2 or nothing, what shows too much loses nothing.
        let full = pixels(&[Some(7), Some(1), Some(1), Some(1), Some(1), Some(2), None]);
        let frame = pixels(&[Some(2), Some(1), Some(1), Some(2), None, Some(2), Some(2)]);
        let expected = Missing {
            objects_shown: 3,
            objects_lost: 1,
            pixels_shown: 6,
            pixels_lost: 3,
            mean_share_lost: (1.0 + 0.5 + 0.0) / 3.0,
        };
        assert_eq!(Missing::of(&full, &frame), Some(expected));
    }

    #[test]
    fn an_object_that_moved_is_not_lost() {
        let missing = Missing::of(&pixels(&[Some(1), None]), &pixels(&[None, Some(1)])).expect("one size");
        assert_eq!((missing.objects_lost, missing.pixels_lost), (0, 1));
    }

    #[test]
    fn frames_of_different_sizes_and_those_without_records_are_not_compared() {
        assert_eq!(Missing::of(&pixels(&[None]), &[]), None);
        assert_eq!(Missing::of(&[], &[]), None);
    }
}
