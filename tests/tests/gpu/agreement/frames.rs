//! Frames of the renderer, compared with the reference pixel by pixel.

use glam::{DVec3, Vec3};
use glimpse::{
    Inspection, LinearImage, Method, Origin, PixelRecord, Postcorrect, Renderer, Settings,
    reference::{Attributes, Ray, Reference, ReferenceFrame, Rounding},
    scene::OCTAHEDRAL_ERROR,
};
use glimpse_tests::{
    TestScene,
    agreement::{Answer, Outcome, Tally, judge},
    assert_same, gpu,
};

use super::{EPSILON, Pair};

/// Tolerance of normals: the error of the stored ones, plus rounding.
const NORMAL: f64 = 1.5 * OCTAHEDRAL_ERROR as f64;

/// A frame of the device, and the reference for its pixels.
pub struct Frames<'a> {
    frame: ReferenceFrame<'a>,
    linear: LinearImage,
    inspection: Inspection,
}

impl Pair {
    pub fn frames(&self, method: Method) -> Frames<'_> {
        self.frames_with(Settings { method, ..self.settings })
    }

    pub fn frames_with(&self, settings: Settings) -> Frames<'_> {
        let settings = Settings { postcorrect: Postcorrect::On, ..settings };
        let test_scene = &self.test_scene;
        let mut renderer =
            Renderer::new(gpu(), &test_scene.scene, self.size, &settings).expect("the kernels compile");
        let (inspection, linear) = renderer.inspect_linear(&test_scene.camera).expect("the frame is counted");
        Frames {
            frame: ReferenceFrame {
                reference: &self.reference,
                camera: self.test_scene.camera,
                size: self.size,
                settings,
            },
            linear,
            inspection,
        }
    }
}

impl Frames<'_> {
    /// The same pixels against another reference or other settings.
    pub fn against<'a>(&self, reference: &'a Reference, settings: Settings) -> Frames<'a> {
        Frames {
            frame: ReferenceFrame { reference, settings, camera: self.frame.camera, size: self.frame.size },
            linear: self.linear.clone(),
            inspection: self.inspection.clone(),
        }
    }

    /// Asserts that kernels without counters compute the same bits.
    pub fn assert_same_uncounted(&self, test_scene: &TestScene) {
        let ReferenceFrame { size, settings, .. } = &self.frame;
        assert_same(&test_scene.frame(*size, settings), &self.linear, &format!("{settings:?}"));
    }

    fn pixels(&self) -> Vec<[u32; 2]> {
        let [width, height] = self.frame.size;
        (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).collect()
    }

    fn tally(&self, judge: impl Fn([u32; 2]) -> Outcome + Sync) -> Tally {
        Tally::of(&self.pixels(), |pixel| match judge(*pixel) {
            Outcome::Wrong(line) => Outcome::Wrong(format!("{pixel:?}: {line}")),
            outcome => outcome,
        })
    }

    fn record(&self, [x, y]: [u32; 2]) -> &PixelRecord {
        &self.inspection.pixels[(y * self.frame.size[0] + x) as usize]
    }

    fn found_color(&self, [x, y]: [u32; 2]) -> Answer<3> {
        let pixel = self.linear.get_pixel(x, y).0.map(f64::from);
        Answer::radiance(DVec3::from_array(pixel))
    }

    /// Object, depth and normal of the first hit.
    fn found_hit(&self, pixel: [u32; 2]) -> Answer<4> {
        let record = self.record(pixel);
        let normal = Vec3::from(record.normal).as_dvec3();
        self.hit(pixel, record.object, f64::from(record.depth), normal)
    }

    fn exact_hit(&self, pixel: [u32; 2], a: &Attributes) -> Answer<4> {
        self.hit(pixel, a.object, a.depth, a.normal)
    }

    fn hit(&self, pixel: [u32; 2], object: Option<u32>, depth: f64, normal: DVec3) -> Answer<4> {
        let (ray, length) = self.frame.ray(pixel);
        let span = self.span(&ray) / length;
        Answer {
            labels: [object.map_or(0, |o| o + 1), 0],
            values: [depth, normal.x, normal.y, normal.z],
            tolerances: [8.0 * EPSILON * span, NORMAL, NORMAL, NORMAL],
        }
    }

    /// Magnitude of the numbers from which a distance along a ray is computed.
    fn span(&self, ray: &Ray) -> f64 {
        ray.origin.abs().max_element() + self.frame.reference.longest_side()
    }

    pub fn traced_colors(&self) -> Tally {
        self.tally(|p| judge(&self.found_color(p), |r| Answer::radiance(self.frame.traced(p, r).color)))
    }

    pub fn traced_hits(&self) -> Tally {
        self.tally(|p| judge(&self.found_hit(p), |r| self.exact_hit(p, &self.frame.traced(p, r).attributes)))
    }

    /// Failed checks, given the origins of the pixels of earlier steps.
    pub fn decisions(&self) -> Tally {
        self.tally(|p| {
            let bits = |failed| Answer::<0> { labels: [failed, 0], values: [], tolerances: [] };
            judge(&bits(self.record(p).failed), |r| {
                bits(self.frame.adaptive(p, Some(&|q| self.record(q).origin), r).failed)
            })
        })
    }

    /// Pixels that postcorrection traces, given their origins and those of their neighbours.
    pub fn corrections(&self) -> Tally {
        self.tally(|p| {
            let bit = |corrects| Answer::<0> { labels: [u32::from(corrects), 0], values: [], tolerances: [] };
            judge(&bit(self.record(p).origin == Origin::Postcorrected), |r| {
                bit(self.frame.postcorrects(p, &|q| self.record(q).origin, r))
            })
        })
    }

    pub fn adaptive_hits(&self) -> Tally {
        self.tally(|p| {
            judge(&self.found_hit(p), |r| {
                self.exact_hit(p, &self.frame.adaptive(p, Some(&|q| self.record(q).origin), r).attributes)
            })
        })
    }

    pub fn adaptive_colors(&self) -> Tally {
        self.tally(|p| {
            judge(&self.found_color(p), |r| {
                Answer::radiance(self.frame.adaptive(p, Some(&|q| self.record(q).origin), r).color)
            })
        })
    }

    pub fn checkerboard_colors(&self) -> Tally {
        self.tally(|p| judge(&self.found_color(p), |r| Answer::radiance(self.frame.checkerboard(p, r))))
    }

    /// Active subpixels, and the attributes that differ between pixels.
    pub fn tested(&self) -> Tally {
        self.tally(|p| {
            let labels =
                |active, differing| Answer::<0> { labels: [active, differing], values: [], tolerances: [] };
            let record = self.record(p);
            judge(&labels(record.active, record.differing), |r| {
                let tested = self.frame.tested(p, r);
                labels(tested.active, tested.differing)
            })
        })
    }

    /// Colours of pixels from their samples, given the active quarters.
    pub fn supersampled_colors(&self) -> Tally {
        self.tally(|p| {
            judge(&self.found_color(p), |r| {
                Answer::radiance(self.frame.supersampled(p, self.record(p).active, r))
            })
        })
    }

    /// Round in which each pixel is refined, given the rounds of its neighbours, and the samples that it
    /// gets.
    pub fn refinements(&self) -> Tally {
        self.tally(|p| {
            let labels = |round: Option<u32>, samples| Answer::<0> {
                labels: [round.map_or(0, |round| round + 1), samples],
                values: [],
                tolerances: [],
            };
            let record = self.record(p);
            judge(&labels(record.round(), record.strata), |r| {
                let refinement = self.frame.refinement(p, &|q| self.record(q).round(), r);
                labels(refinement.round, refinement.strata)
            })
        })
    }

    /// Colours of pixels from their samples, given which samples they got.
    pub fn refined_colors(&self) -> Tally {
        self.tally(|p| {
            judge(&self.found_color(p), |r| Answer::radiance(self.frame.refined(p, self.record(p).strata, r)))
        })
    }

    /// Divided quads of a quincunx frame.
    pub fn divided(&self) -> Tally {
        self.tally(|p| {
            let label = |divided| Answer::<0> { labels: [divided, 0], values: [], tolerances: [] };
            judge(&label(self.found_divided(p)), |r| label(self.frame.quincunx(p, None, r).divided))
        })
    }

    /// Colours of a quincunx frame, given the divided quads.
    pub fn quincunx_colors(&self) -> Tally {
        self.tally(|p| {
            let divided = self.found_divided(p);
            judge(&self.found_color(p), |r| Answer::radiance(self.frame.quincunx(p, Some(divided), r).color))
        })
    }

    fn found_divided(&self, pixel: [u32; 2]) -> u32 {
        let record = self.record(pixel);
        record.active | record.differing << 4
    }

    /// Number of pixels whose origin differs from that in the reference's own adaptive frame.
    pub fn other_origins(&self) -> usize {
        let other = self.tally(|p| {
            let found = match self.record(p).origin {
                Origin::Postcorrected => Origin::Interpolated,
                origin => origin,
            };
            let same = self.frame.adaptive(p, None, &mut Rounding::none()).origin == found;
            if same { Outcome::Same(0.0) } else { Outcome::Wrong(String::new()) }
        });
        other.wrong.len()
    }
}
