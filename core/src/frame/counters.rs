//! Counters that the inspecting kernels accumulate on the device. Each is declared once: its index in the buffer,
//! its WGSL constants, its key in the JSON and its displayed label follow from that line.

use serde::Serialize;

/// A group of counters that are adjacent in the buffer, as the generated WGSL constants name it.
pub struct Group {
    /// Names the WGSL constant `COUNTER_{name}`: the index of the group's first counter.
    pub name: &'static str,
    /// Names the WGSL constants `{prefix}_COUNT`, the number of counters, and `{prefix}_{NAME}`, each counter's
    /// position in the group, or its bit where `bits` is set.
    pub prefix: &'static str,
    /// Index of the group's first counter in the buffer.
    pub first: usize,
    /// Names of the counters, in order.
    pub names: &'static [&'static str],
    /// Whether the `{prefix}_{NAME}` constants are bits of a mask instead of positions.
    pub bits: bool,
}

/// All groups, in the order of their indices.
pub const GROUPS: [Group; 5] =
    [Rays::GROUP, Cost::GROUP, Samples::GROUP, FailedChecks::GROUP, Postcorrection::GROUP];

/// Length of the counter buffer in 32-bit words: a low and a high word for each 64-bit counter.
pub const COUNTER_WORDS: usize = 2 * Postcorrection::END;

/// Declares a struct of counters whose indices start at `first`. Fields in brackets are derived values, not
/// counters; they stand before or after the counters in the JSON.
macro_rules! counters {
    (
        $(#[$meta:meta])*
        $visibility:vis struct $name:ident, $group:literal, $prefix:literal, first $first:expr, bits $bits:literal {
            $([$(#[$head_doc:meta])* $head:ident: $head_type:ty])?
            $($(#[$doc:meta])* $field:ident $label:expr,)*
            $(; [$(#[$tail_doc:meta])* $tail:ident: $tail_type:ty])?
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
        $visibility struct $name {
            $($(#[$head_doc])* pub $head: $head_type,)?
            $($(#[$doc])* pub $field: u64,)*
            $($(#[$tail_doc])* pub $tail: $tail_type,)?
        }

        impl $name {
            /// Number of counters.
            pub const COUNT: usize = Self::NAMES.len();
            /// Names of the counters in the JSON, in the order of their indices.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];
            /// Index of the first counter in the buffer.
            const FIRST: usize = $first;
            /// Index after the last counter.
            const END: usize = Self::FIRST + Self::COUNT;
            const GROUP: Group = Group {
                name: $group,
                prefix: $prefix,
                first: Self::FIRST,
                names: Self::NAMES,
                bits: $bits,
            };

            /// Each counter's displayed label and value.
            #[must_use]
            pub fn labelled(&self) -> [(&'static str, u64); Self::COUNT] {
                [$(($label, self.$field)),*]
            }

            /// Takes this struct's counters out of the decoded buffer.
            fn read(counters: &[u64]) -> Self {
                let mut own = counters[Self::FIRST..Self::END].iter().copied();
                // The slice is as long as the struct has counters.
                Self {
                    $($head: Default::default(),)?
                    $($field: own.next().unwrap_or_default(),)*
                    $($tail: Default::default(),)?
                }
            }
        }
    };
}

counters! {
    /// Traced rays by kind.
    #[derive(Eq)]
    pub struct Rays, "RAYS", "RAY", first 0, bits false {
        /// Primary rays from the camera.
        primary "primary",
        /// Shadow rays from surfaces towards lights.
        shadow "shadow",
        /// Specularly reflected rays.
        reflection "reflected",
        /// Rays transmitted through refracting surfaces.
        refraction "refracted",
        /// Rays scattered by diffuse surfaces (path tracing only).
        diffuse "diffuse",
        ; [
            /// Sum over all kinds.
            total: u64
        ]
    }
}

counters! {
    /// Traversal work of all rays.
    pub struct Cost, "COST", "COST", first Rays::END, bits false {
        /// Visited nodes of the acceleration structure.
        node_visits "node visits",
        /// Ray intersection tests with triangles and spheres.
        primitive_tests "primitive tests",
        ; [
            /// Node visits plus primitive tests, divided by those of the full frame; `None` unless a full frame was
            /// measured too.
            traced_share: Option<f64>
        ]
    }
}

/// Declares [`Origin`] and the counters of samples by origin, [`Samples`].
macro_rules! origins {
    ($($(#[$doc:meta])* $variant:ident $field:ident $label:literal,)*) => {
        /// How the radiance of a sample, and of the pixel that shows it, was obtained.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u32)]
        #[non_exhaustive]
        pub enum Origin { $($(#[$doc])* $variant),* }

        impl Origin {
            /// All origins, in the order of their discriminants.
            pub const ALL: [Self; Samples::COUNT] = [$(Self::$variant),*];
        }

        counters! {
            /// Number of samples by origin.
            #[derive(Eq)]
            pub struct Samples, "ORIGINS", "ORIGIN", first Cost::END, bits false {
                [
                    /// All samples of the frame's grid, without extra ones.
                    total: u64
                ]
                $($(#[$doc])* $field $label,)*
            }
        }
    };
}

origins! {
    /// Traced for every base block (Kim 2016, Step-I).
    Base base "base",
    /// Traced in step A1, in the rows of the base samples (Kim 2016, Step-II-c).
    TracedA1 traced_a1 "traced A1",
    /// Traced in step A2, in the rows between them (Kim 2016, Step-III-c).
    TracedA2 traced_a2 "traced A2",
    /// Interpolated at first, then traced by postcorrection (Kim 2016, Step-IV).
    Postcorrected postcorrected "postcorrected",
    /// Traced in addition to a pixel's own sample (Jin 2009, 4.1.4); counts samples only, no pixel has this
    /// origin.
    Extra extra "extra",
    /// Interpolated between traced samples (Kim 2016, Step-II-a, Step-III-a).
    Interpolated interpolated "interpolated",
}

impl Samples {
    /// Number of samples whose primary ray was traced.
    #[must_use]
    pub fn traced(&self) -> u64 {
        self.labelled().iter().map(|(_, count)| count).sum::<u64>() - self.interpolated
    }
}

/// Declares [`Check`] and the counters of failed checks, [`FailedChecks`].
macro_rules! checks {
    ($($variant:ident $field:ident $letters:literal $what:literal,)*) => {
        /// A similarity check of two references (Kim 2016, Table 1).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u32)]
        pub enum Check { $(#[doc = concat!($letters, ", ", $what, ".")] $variant),* }

        impl Check {
            /// All checks, in the order of their bits.
            pub const ALL: [Self; FailedChecks::COUNT] = [$(Self::$variant),*];

            /// The check's abbreviation in the paper (Kim 2016, Table 1).
            #[must_use]
            pub fn letters(self) -> &'static str {
                match self { $(Self::$variant => $letters),* }
            }

            /// The quantity that the check compares.
            #[must_use]
            pub fn what(self) -> &'static str {
                match self { $(Self::$variant => $what),* }
            }
        }

        counters! {
            /// Number of adaptive samples that fail each check; a sample may fail several.
            #[derive(Eq)]
            pub struct FailedChecks, "FAILED", "CHECK", first Samples::END, bits true {
                $(#[doc = concat!($letters, ", ", $what, ".")] $field stringify!($field),)*
            }
        }
    };
}

checks! {
    Oid oid "G1" "object",
    Pos pos "G2" "distance",
    Norm norm "G3" "normal",
    Convex convex "G4" "convexity",
    Tex tex "TX" "texture seam",
    Shadow shadow "SH" "shadow bits",
    Gcol gcol "GC" "reflected and refracted radiance",
}

impl Check {
    /// The check's name on the command line and in the JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        FailedChecks::NAMES[self as usize]
    }

    /// The check's bit in [`crate::PixelRecord::failed`].
    #[must_use]
    pub fn bit(self) -> u32 {
        1 << self as u32
    }
}

counters! {
    /// Counters of postcorrection.
    struct Postcorrection, "POSTCORRECTION", "POSTCORRECTION", first FailedChecks::END, bits false {
        /// Samples that postcorrection marked for tracing.
        claimed "claimed",
    }
}

/// All counters of one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Traced rays by kind.
    pub rays: Rays,
    /// Samples by origin.
    pub samples: Samples,
    /// Traversal work of all rays.
    pub cost: Cost,
    /// Failed similarity checks of the adaptive method.
    pub failed_checks: FailedChecks,
}

impl Counts {
    /// RT ratio (Kim 2016): traced samples divided by the samples of the frame. May exceed 1 with extra samples.
    #[must_use]
    pub fn rt_ratio(&self) -> f64 {
        self.samples.traced() as f64 / (self.samples.total.max(1)) as f64
    }

    /// Decodes the words of the counter buffer for a frame of `samples` samples. Also returns how many samples
    /// postcorrection claimed and did not trace.
    pub(crate) fn decode(words: &[u32], samples: u64) -> (Self, u64) {
        let counters: Vec<u64> =
            words.chunks_exact(2).map(|pair| u64::from(pair[0]) | u64::from(pair[1]) << 32).collect();
        let (rays, found) = (Rays::read(&counters), Samples::read(&counters));
        let [(_, claimed)] = Postcorrection::read(&counters).labelled();
        let counts = Self {
            rays: Rays { total: rays.labelled().iter().map(|(_, count)| count).sum(), ..rays },
            samples: Samples {
                total: samples,
                // Postcorrected samples had been counted as interpolated before.
                interpolated: found.interpolated.saturating_sub(found.postcorrected),
                ..found
            },
            cost: Cost::read(&counters),
            failed_checks: FailedChecks::read(&counters),
        };
        (counts, claimed.saturating_sub(found.postcorrected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_follow_on_each_other_and_fill_the_buffer() {
        let mut next = 0;
        for group in GROUPS {
            assert_eq!(group.first, next, "{}", group.name);
            next += group.names.len();
        }
        assert_eq!(2 * next, COUNTER_WORDS);
    }

    /// Every counter is decoded into its own field: none is lost in the JSON and none is counted twice.
    #[test]
    fn every_counter_is_decoded_under_its_name() {
        let words: Vec<u32> =
            (0..COUNTER_WORDS as u32 / 2).flat_map(|index| [1000 + index, index % 3]).collect();
        let (counts, uncorrected) = Counts::decode(&words, 77);
        let json = serde_json::to_value(counts).unwrap();
        let value = |index: usize| u64::from(words[2 * index]) | u64::from(words[2 * index + 1]) << 32;
        let sections =
            [("RAYS", "rays"), ("COST", "cost"), ("ORIGINS", "samples"), ("FAILED", "failed_checks")];
        for group in GROUPS {
            let Some((_, section)) = sections.iter().find(|(name, _)| *name == group.name) else { continue };
            for (position, name) in group.names.iter().enumerate() {
                let mut expected = value(group.first + position);
                if *name == "interpolated" {
                    expected = expected.saturating_sub(counts.samples.postcorrected);
                }
                assert_eq!(json[section][name], expected, "{section}/{name}");
            }
        }
        assert_eq!(counts.samples.total, 77);
        assert_eq!(counts.rays.total, (0..Rays::COUNT).map(value).sum::<u64>());
        assert_eq!(uncorrected, value(Postcorrection::FIRST).saturating_sub(counts.samples.postcorrected));
    }

    #[test]
    fn traced_samples_are_all_but_interpolated_ones() {
        let samples = Samples {
            total: 100,
            base: 1,
            traced_a1: 2,
            traced_a2: 4,
            postcorrected: 8,
            extra: 16,
            interpolated: 32,
        };
        assert_eq!(samples.traced(), 31);
        assert!((Counts { samples, ..Counts::default() }.rt_ratio() - 0.31).abs() < 1e-12);
    }

    #[test]
    fn checks_and_origins_are_numbered_in_order() {
        assert!(Check::ALL.iter().enumerate().all(|(i, check)| check.bit() == 1 << i));
        assert!(Origin::ALL.iter().enumerate().all(|(i, origin)| *origin as usize == i));
        assert_eq!(Check::Tex.name(), "tex");
    }
}
