//! Settings of selective supersampling (Jin 2009): which differences between pixels get extra samples.

/// Contrast thresholds for extra samples in a subpixel, by the attribute that differs between neighbouring pixels
/// (Jin 2009, Table 1). 0 always gives extra samples, 1 never.
///
/// If several attributes differ, the smallest of their thresholds applies; if none does, that of the colour. With
/// all equal to `col` only the colour decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Threshold where no attribute but the colour differs.
    pub col: f32,
    /// Primary hit: different objects.
    pub poid: f32,
    /// Primary hit: different surface normals.
    pub psn: f32,
    /// Primary hit: different numbers of shadowed lights.
    pub psc: f32,
    /// Primary hit: a textured surface, with or without a difference.
    pub pte: f32,
    /// Secondary hit: different objects.
    pub soid: f32,
    /// Secondary hit: different surface normals.
    pub ssn: f32,
    /// Secondary hit: different numbers of shadowed lights.
    pub ssc: f32,
    /// Secondary hit: a textured surface.
    pub ste: f32,
}

/// Names of the fields of [`Thresholds`], in order.
pub const THRESHOLD_NAMES: [&str; 9] = ["col", "poid", "psn", "psc", "pte", "soid", "ssn", "ssc", "ste"];

impl Thresholds {
    /// The same threshold for all attributes, which makes only the colour decide.
    #[must_use]
    pub const fn uniform(col: f32) -> Self {
        Self::paper(col, col, col)
    }

    /// The paper's parameters: `alpha` for colour and textures, `shadow` for shadows, `geometry` for objects and
    /// normals.
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

    /// The thresholds in the order of [`THRESHOLD_NAMES`].
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
    /// Named sets of thresholds.
    pub enum Preset {
        /// The paper's default (Jin 2009, Table 2, tau_alpha = 0.6).
        Balanced = "balanced": "Edges and shadows, textures where they are strong (Jin 2009, Table 2)",
        /// Stricter for textures (Jin 2009, Table 2, tau_alpha = 0.1).
        Textures = "textures": "Textures too",
        /// Edges of objects only, also in mirrors (Jin 2009, Table 2, Fairy Forest with tau_alpha = tau_beta =
        /// 1).
        Edges = "edges": "Edges alone",
        /// Colour only (Jin 2009, Figure 7, tau_col = 0.1).
        Color = "color": "Colours alone, whatever their cause",
        /// Visible edges and shadows, and strong textures. Our own values, for [`Refine::On`] with averaged
        /// textures.
        Refined = "refined": "Edges and shadows wherever they show, textures where they are strong: for refine on",
    }
}

impl Preset {
    /// The thresholds of the preset.
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

/// The range of [`crate::Scene::objects`] whose attributes are compared (Jin 2009, section 5, "Fairy focused");
/// elsewhere only the colour decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Focus {
    /// Index of the first object.
    pub first: u32,
    /// Index of the last object.
    pub last: u32,
}

choices! {
    /// The colour of subpixels without extra samples.
    pub enum Unsampled {
        /// The colour of the sample at the pixel's centre.
        Nearest = "nearest": "The sample at the pixel's centre",
        /// Bilinear interpolation of the four nearest pixel centres (Jin 2009, section 6), which blurs textures
        /// and edges.
        Bilinear = "bilinear": "The centres around it, bilinearly (Jin 2009, section 6)",
    }
}

choices! {
    /// The reconstruction filter from samples to pixels (lecture, "Supersampling").
    pub enum Filter {
        /// The mean of the pixel's own samples.
        Box = "box": "The mean of its own samples",
        /// A tent filter that also covers the neighbours' samples, with weights that fall with distance: smoother
        /// edges, softer textures.
        Tent = "tent": "The neighbours' samples too, the less the farther off",
    }
}

choices! {
    /// Where samples lie within their cells.
    pub enum Jitter {
        /// At a random position for extra samples (Jin 2009, 4.1.4), in the centre for all others.
        Auto = "auto": "Extra samples do, others lie in the centre",
        /// At a random position for all samples, which turns aliasing into noise (lecture, "Jittered sampling").
        On = "on": "All do: noise in the place of aliasing",
        /// In the centre.
        Off = "off": "None do",
    }
}

choices! {
    /// How extra samples are distributed over pixels that differ from their neighbours.
    pub enum Refine {
        /// [`Refine::On`] with the adaptive method, [`Refine::Off`] with method `supersample`.
        Auto = "auto": "On after the adaptive method, off with method supersample",
        /// One sample in each subpixel first. Where these show colours that no pixel around a neighbour has, the
        /// neighbour gets them as well. Then four to twelve more where subpixels differ by twice the smallest
        /// threshold.
        On = "on": "Whole pixels, step by step",
        /// Four samples in each subpixel that differs (Jin 2009, 4.1.4).
        Off = "off": "Subpixels that differ (Jin 2009)",
    }
}
