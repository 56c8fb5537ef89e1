//! The counters of the counting kernels. Each is declared once: its index in the buffer, its WGSL constants, its name in
//! the JSON and its label for people follow from that line.

use serde::Serialize;

/// Counters that lie side by side.
pub struct Group {
    /// `COUNTER_{name}` is the index of the first one in WGSL, `{prefix}_COUNT` how many there are, `{prefix}_{NAME}` the
    /// position of each, or its bit.
    pub name: &'static str,
    /// See above.
    pub prefix: &'static str,
    /// The first one's index.
    pub first: usize,
    /// Names of the counters, in order.
    pub names: &'static [&'static str],
    /// Kernels name sets of them: the constants are bits.
    pub bits: bool,
}

/// Every group.
pub const GROUPS: [Group; 5] =
    [Rays::GROUP, Cost::GROUP, Samples::GROUP, FailedChecks::GROUP, Postcorrection::GROUP];

/// Words of all counters, low and high.
pub const COUNTER_WORDS: usize = 2 * Postcorrection::END;

/// Declares a struct of counters, which follow on those of another struct in the buffer. Fields in brackets are no
/// counters; they stand before or after them in the JSON.
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
            /// How many counters it has.
            pub const COUNT: usize = Self::NAMES.len();
            /// Their names in the JSON, in the order of their indices.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];
            /// The first one's index.
            const FIRST: usize = $first;
            /// The index behind the last one's.
            const END: usize = Self::FIRST + Self::COUNT;
            const GROUP: Group = Group {
                name: $group,
                prefix: $prefix,
                first: Self::FIRST,
                names: Self::NAMES,
                bits: $bits,
            };

            /// Each counter with its label for people.
            #[must_use]
            pub fn labelled(&self) -> [(&'static str, u64); Self::COUNT] {
                [$(($label, self.$field)),*]
            }

            /// As all counters of the buffer say.
            fn read(counters: &[u64]) -> Self {
                let mut own = counters[Self::FIRST..Self::END].iter().copied();
                // The slice has as many as there are fields.
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
    /// Rays by kind.
    #[derive(Eq)]
    pub struct Rays, "RAYS", "RAY", first 0, bits false {
        /// Through pixels.
        primary "primary",
        /// Towards lights.
        shadow "shadow",
        /// Mirrored.
        reflection "reflected",
        /// Transmitted.
        refraction "refracted",
        /// Scattered, as paths go on from diffuse surfaces.
        diffuse "diffuse",
        ; [
            /// All of them.
            total: u64
        ]
    }
}

counters! {
    /// Work of the traversal.
    pub struct Cost, "COST", "COST", first Rays::END, bits false {
        /// Visited nodes of the acceleration structure.
        node_visits "node visits",
        /// Tested triangles and spheres.
        primitive_tests "primitive tests",
        ; [
            /// The part of the full frame's work that lies in the samples which this method traced; needs a full frame.
            traced_share: Option<f64>
        ]
    }
}

/// Declares [`Origin`] and [`Samples`], which counts by it.
macro_rules! origins {
    ($($(#[$doc:meta])* $variant:ident $field:ident $label:literal,)*) => {
        /// How a sample, and with it a pixel, came to be.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u32)]
        #[non_exhaustive]
        pub enum Origin { $($(#[$doc])* $variant),* }

        impl Origin {
            /// All of them, in the order of their discriminants.
            pub const ALL: [Self; Samples::COUNT] = [$(Self::$variant),*];
        }

        counters! {
            /// Samples by how they came to be.
            #[derive(Eq)]
            pub struct Samples, "ORIGINS", "ORIGIN", first Cost::END, bits false {
                [
                    /// Of the whole frame.
                    total: u64
                ]
                $($(#[$doc])* $field $label,)*
            }
        }
    };
}

origins! {
    /// Always traced (Kim 2016, Step-I).
    Base base "base",
    /// Traced in the rows of the base pixels (Step-II-c).
    TracedA1 traced_a1 "traced A1",
    /// Traced in the other rows (Step-III-c).
    TracedA2 traced_a2 "traced A2",
    /// Traced by postcorrection (Step-IV).
    Postcorrected postcorrected "postcorrected",
    /// Traced besides a pixel's own sample (Jin 2009, 4.1.4): no pixel is of this origin.
    Extra extra "extra",
    /// Not traced (Step-II-a, Step-III-a).
    Interpolated interpolated "interpolated",
}

impl Samples {
    /// Those whose primary ray was traced.
    #[must_use]
    pub fn traced(&self) -> u64 {
        self.labelled().iter().map(|(_, count)| count).sum::<u64>() - self.interpolated
    }
}

/// Declares [`Check`] and [`FailedChecks`], which counts by it.
macro_rules! checks {
    ($($variant:ident $field:ident $letters:literal $what:literal,)*) => {
        /// A similarity check of two references (Kim 2016, Table 1).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u32)]
        pub enum Check { $(#[doc = concat!($letters, ", ", $what, ".")] $variant),* }

        impl Check {
            /// All of them, in the order of their bits.
            pub const ALL: [Self; FailedChecks::COUNT] = [$(Self::$variant),*];

            /// Its letters in the paper.
            #[must_use]
            pub fn letters(self) -> &'static str {
                match self { $(Self::$variant => $letters),* }
            }

            /// What it compares.
            #[must_use]
            pub fn what(self) -> &'static str {
                match self { $(Self::$variant => $what),* }
            }
        }

        counters! {
            /// Adaptive samples by check that they fail (one sample may fail several).
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
    /// Its name on the command line and in the JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        FailedChecks::NAMES[self as usize]
    }

    /// Its bit in [`crate::PixelRecord::failed`].
    #[must_use]
    pub fn bit(self) -> u32 {
        1 << self as u32
    }
}

counters! {
    /// What postcorrection found.
    struct Postcorrection, "POSTCORRECTION", "POSTCORRECTION", first FailedChecks::END, bits false {
        /// Samples that it is to trace.
        claimed "claimed",
    }
}

/// The counters of one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Rays by kind.
    pub rays: Rays,
    /// Samples by origin.
    pub samples: Samples,
    /// Traversal work.
    pub cost: Cost,
    /// Failed checks.
    pub failed_checks: FailedChecks,
}

impl Counts {
    /// Kim 2016's RT ratio: traced samples over all samples of the frame; with extra samples, it may exceed 1.
    #[must_use]
    pub fn rt_ratio(&self) -> f64 {
        self.samples.traced() as f64 / (self.samples.total.max(1)) as f64
    }

    /// Of a frame of that many samples, from the words of the counters; and how many samples postcorrection claimed and did
    /// not trace.
    pub(crate) fn decode(words: &[u32], samples: u64) -> (Self, u64) {
        let counters: Vec<u64> =
            words.chunks_exact(2).map(|pair| u64::from(pair[0]) | u64::from(pair[1]) << 32).collect();
        let (rays, found) = (Rays::read(&counters), Samples::read(&counters));
        let [(_, claimed)] = Postcorrection::read(&counters).labelled();
        let counts = Self {
            rays: Rays { total: rays.labelled().iter().map(|(_, count)| count).sum(), ..rays },
            samples: Samples {
                total: samples,
                // What was traced again had been interpolated.
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

    /// Every counter reaches a field of its own: as the JSON shows them, no count is lost and none is taken twice.
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
