//! Wishes about extra samples: which differences between pixels are worth some (Jin 2009).

/// How strong a contrast must be, by what differs between neighbouring pixels, for a subpixel to get extra
/// samples (Jin 2009, Table 1), each from 0, always, to 1, never.
///
/// Where several attributes differ the smallest counts, where none does that of the colour. All equal to `col` is the
/// colour measure alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Nothing but the colour.
    pub col: f32,
    /// Primary hit: object.
    pub poid: f32,
    /// Primary hit: surface normal.
    pub psn: f32,
    /// Primary hit: number of lights that do not reach it.
    pub psc: f32,
    /// Primary hit: it is textured, whatever its neighbours are.
    pub pte: f32,
    /// Secondary hit: object.
    pub soid: f32,
    /// Secondary hit: surface normal.
    pub ssn: f32,
    /// Secondary hit: number of lights that do not reach it.
    pub ssc: f32,
    /// Secondary hit: it is textured.
    pub ste: f32,
}

/// The names of [`Thresholds`], in order.
pub const THRESHOLD_NAMES: [&str; 9] = ["col", "poid", "psn", "psc", "pte", "soid", "ssn", "ssc", "ste"];

impl Thresholds {
    /// One threshold for everything: the colour measure alone.
    #[must_use]
    pub const fn uniform(col: f32) -> Self {
        Self::paper(col, col, col)
    }

    /// The paper's: of colour and textures, of shadows, of objects and normals.
    const fn paper(alpha: f32, shadow: f32, geometry: f32) -> Self {
        Self {
            col: alpha,
            poid: geometry,
            psn: geometry,
            psc: shadow,
            pte: alpha,
            soid: geometry,
            ssn: geometry,
            ssc: shadow,
            ste: alpha,
        }
    }

    /// In the order of [`THRESHOLD_NAMES`].
    #[must_use]
    pub fn values(&self) -> [f32; 9] {
        let t = self;
        [t.col, t.poid, t.psn, t.psc, t.pte, t.soid, t.ssn, t.ssc, t.ste]
    }
}

impl Default for Thresholds {
    fn default() -> Self {
        Preset::Balanced.thresholds()
    }
}

choices! {
    /// Thresholds by name.
    pub enum Preset {
        /// The paper's default (Table 2, tau_alpha = 0.6).
        Balanced = "balanced": "Edges and shadows, textures where they are strong (Jin 2009, Table 2)",
        /// Strict about textures too (Table 2, tau_alpha = 0.1).
        Textures = "textures": "Textures too",
        /// Edges alone, of objects and in mirrors (Table 2, Fairy Forest with tau_alpha = tau_beta = 1).
        Edges = "edges": "Edges alone",
        /// The colour measure alone (Figure 7, tau_col = 0.1).
        Color = "color": "Colours alone, whatever their cause",
        /// Edges and shadows wherever they show, textures where they are strong: ours, for [`Refine::On`] and averaged textures.
        Refined = "refined": "Edges and shadows wherever they show, textures where they are strong: for refine on",
    }
}

impl Preset {
    /// What it stands for.
    #[must_use]
    pub const fn thresholds(self) -> Thresholds {
        match self {
            Self::Balanced => Thresholds { poid: 0.05, soid: 0.05, ..Thresholds::paper(0.6, 0.06, 0.06) },
            Self::Textures => Thresholds { poid: 0.05, soid: 0.05, ..Thresholds::paper(0.1, 0.06, 0.06) },
            Self::Edges => Thresholds { poid: 0.05, soid: 0.05, ..Thresholds::paper(1.0, 1.0, 0.06) },
            Self::Color => Thresholds::uniform(0.1),
            Self::Refined => Thresholds { col: 0.04, ..Thresholds::paper(0.3, 0.04, 0.04) },
        }
    }
}

/// The objects whose differences count: the first and the last of a run of [`crate::Scene::objects`] (Jin 2009, section 5,
/// "Fairy focused"). Elsewhere the colour decides alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Focus {
    /// Index of the first object.
    pub first: u32,
    /// Index of the last object.
    pub last: u32,
}

choices! {
    /// What stands for the subpixels that get no extra samples.
    pub enum Unsampled {
        /// The sample at the pixel's centre.
        Nearest = "nearest": "The sample at the pixel's centre",
        /// The four centres around them, bilinearly (Jin 2009, section 6): softer textures, softer everything.
        Bilinear = "bilinear": "The centres around it, bilinearly (Jin 2009, section 6)",
    }
}

choices! {
    /// How a pixel follows from samples (lecture, "Supersampling").
    pub enum Filter {
        /// The mean of its own.
        Box = "box": "The mean of its own samples",
        /// Those of the neighbours too, the less the farther off: smoother edges, softer textures.
        Tent = "tent": "The neighbours' samples too, the less the farther off",
    }
}

choices! {
    /// Where in its cell a sample lies.
    pub enum Jitter {
        /// Anywhere for extra samples (Jin 2009, 4.1.4), in the centre for all others.
        Auto = "auto": "Extra samples do, others lie in the centre",
        /// Anywhere: noise in the place of aliasing (lecture, "Jittered sampling").
        On = "on": "All do: noise in the place of aliasing",
        /// In the centre.
        Off = "off": "None do",
    }
}

choices! {
    /// Which samples pixels get that differ from their neighbours.
    pub enum Refine {
        /// [`Refine::On`] after an adaptive frame, [`Refine::Off`] as a method of its own.
        Auto = "auto": "On after the adaptive method, off with method supersample",
        /// One in each subpixel, and where they show what no pixel around a neighbour does, of the neighbour; then four to
        /// twelve more, where quarters differ by twice the least of the thresholds.
        On = "on": "Whole pixels, step by step",
        /// Four in each quarter that differs (Jin 2009, 4.1.4).
        Off = "off": "Subpixels that differ (Jin 2009)",
    }
}
