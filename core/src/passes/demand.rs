//! Cost model: the arithmetic and memory traffic of a frame's units of work, counted from the code of its
//! kernels.

use std::ops::{Add, AddAssign};

use serde::{Deserialize, Serialize};

use super::{FrameSpec, Recipe, operations::count, recipe::Loops};
use crate::{
    GpuScene, Result, Settings,
    device::{
        Tier,
        shader::{Linked, link},
    },
};

/// Arithmetic and memory traffic of some work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Demand {
    /// Operations on single 32-bit numbers. A quotient or a transcendental function counts as four, from its rate
    /// on GPUs; a fused multiply-add would count as two.
    pub operations: f64,
    /// Bytes read of nodes, primitives, materials and texels. Caches serve most of them.
    pub scene_bytes: f64,
    /// Bytes read and written of per-sample data: attributes, lists, colours.
    pub frame_bytes: f64,
}

impl Demand {
    /// The demand of `count` times this work.
    #[must_use]
    pub fn times(self, count: f64) -> Self {
        Self {
            operations: count * self.operations,
            scene_bytes: count * self.scene_bytes,
            frame_bytes: count * self.frame_bytes,
        }
    }
}

impl Add for Demand {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            operations: self.operations + other.operations,
            scene_bytes: self.scene_bytes + other.scene_bytes,
            frame_bytes: self.frame_bytes + other.frame_bytes,
        }
    }
}

impl AddAssign for Demand {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// Functions that a traversal calls only in a few of its primitive tests, so they are left out: edge signs that
/// rounding does not decide, triangles beyond the range of f32, and the handling of hits, of which a ray has one
/// or two.
const RARE: [&str; 6] = [
    "triangle_edge_sign",
    "triangle_scaled_edges",
    "bvh_ahead",
    "bvh_nearer",
    "side_stops",
    "any_hit_accepts",
];
/// Functions that average textures and have loops of their own. The model assumes three rows of three points
/// each, on level 2 of one texture.
const AVERAGES: [&str; 2] = ["texture_points", "texture_level"];
const TRAVERSAL: &str = "bvh_traverse";
const SHADOWS: &str = "shadow_bits";

/// Demands of each unit of work that the counters of a frame count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Demands {
    /// A traced sample, without its rays.
    pub sample: Demand,
    /// A primary, reflected or refracted ray and the shading of the surface that it hits.
    pub followed_ray: Demand,
    /// The evaluation of one light at one shaded surface.
    pub light: Demand,
    /// The setup of a traversal, for a ray of any kind.
    pub ray: Demand,
    /// A visited node of the acceleration structure.
    pub node_visit: Demand,
    /// A ray intersection test with a triangle or a sphere.
    pub primitive_test: Demand,
    /// A sample that passes the similarity checks and is interpolated.
    pub interpolated: Demand,
    /// The evaluation of one light at one interpolated sample.
    pub interpolated_light: Demand,
}

impl Demands {
    /// Demands of a scene's frames with these settings.
    ///
    /// # Errors
    /// [`crate::Error::Shader`] if a kernel does not link.
    pub fn of(scene: &GpuScene, settings: &Settings) -> Result<Self> {
        // The model describes GPUs, whatever device is used.
        let spec = FrameSpec { tier: Tier::Gpu, ..FrameSpec::new(scene, settings) };
        Self::of_spec(&spec)
    }

    fn of_spec(spec: &FrameSpec) -> Result<Self> {
        let recipe = Recipe::of(spec.settings.method);
        let kernel = link(&spec.sources(recipe.traced))?;
        let of = |function, apart: &[&str]| count(&kernel, function, apart).unwrap_or_default();
        let tree = [RARE.as_slice(), &AVERAGES, &[TRAVERSAL]].concat();
        let [sample, followed, light] = of(None, &[tree.as_slice(), &[SHADOWS]].concat());
        // The outermost loop of this function is over lights.
        let [surface, shadow, _] = of(Some(SHADOWS), &tree);
        let [ray, node_visit, primitive_test] = of(Some(TRAVERSAL), &RARE);
        let (interpolated, interpolated_light) = between(spec, recipe)?;
        Ok(Self {
            sample,
            followed_ray: followed + surface + average(&kernel),
            light: light + shadow,
            ray,
            node_visit,
            primitive_test,
            interpolated,
            interpolated_light,
        })
    }
}

/// A texture average, without the parts outside of its loops.
fn average(kernel: &Linked) -> Demand {
    let of = |function| count(kernel, Some(function), &[]).unwrap_or_default();
    let [[points, row, point], [level, above, _]] = AVERAGES.map(of);
    points + row.times(3.0) + point.times(9.0) + level + above
}

/// Demand of one sample that is not traced, and the part of it that recurs for each light.
fn between(spec: &FrameSpec, recipe: &Recipe) -> Result<(Demand, Demand)> {
    let (mut sample, mut light) = (Demand::default(), Demand::default());
    for (stage, loops) in recipe.interpolated {
        let kernel = link(&spec.sources(stage))?;
        let [once, inner, deeper] = count(&kernel, None, &AVERAGES).unwrap_or_default();
        sample += once + average(&kernel);
        match loops {
            Loops::OverLights => light += inner + deeper,
            Loops::Repeated(turns) => sample += inner.times(*turns),
        }
    }
    Ok((sample, light))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Method, Specialize,
        scene::{Thinness, builtin},
    };

    fn spec(scene: &str, settings: &Settings) -> FrameSpec {
        let scene = builtin(scene).expect(scene);
        FrameSpec::of_scene(&scene, &Thinness::of(&scene), settings)
    }

    fn demands(scene: &str, method: Method) -> Demands {
        let settings = Settings { method, specialize: Specialize::Auto, ..Settings::default() };
        Demands::of_spec(&spec(scene, &settings)).expect("links")
    }

    /// The node of Ylitie et al. 2017 has 80 bytes and a triangle of this crate 36. Reading exactly these shows
    /// that the counter attributes work to the right loops.
    #[test]
    fn a_node_is_read_once_a_visit_and_a_triangle_once_a_test() {
        for method in Method::ALL {
            let demands = demands("room", method);
            assert_eq!(demands.node_visit.scene_bytes, 80.0, "{method:?}");
            // 4 more bytes for the mark that distinguishes spheres from triangles.
            assert_eq!(demands.primitive_test.scene_bytes, 36.0 + 4.0, "{method:?}");
            // Eight boxes of six planes: unpacking, conversion, scaling and translation take five operations per
            // plane.
            assert!((240.0..500.0).contains(&demands.node_visit.operations), "{demands:?}");
            // Three corners: translation and shear in seven operations, products of pairs in nine.
            assert!((48.0..250.0).contains(&demands.primitive_test.operations), "{demands:?}");
            assert!(demands.ray.operations > 0.0 && demands.ray.scene_bytes == 0.0, "{demands:?}");
            assert!(demands.followed_ray.operations > demands.light.operations, "{demands:?}");
            assert!(demands.light.operations > 0.0, "{demands:?}");
        }
    }

    #[test]
    fn what_a_method_stores_is_counted() {
        let full = demands("room", Method::Full);
        assert_eq!((full.sample.frame_bytes, full.interpolated), (4.0, Demand::default()), "a pixel");
        let adaptive = demands("room", Method::Adaptive);
        let channels = 4.0 * f64::from(u8::try_from(adaptive_channels()).expect("few"));
        // The pixel, its attributes, its list entry and the three words of the list's header.
        assert!(adaptive.sample.frame_bytes >= 4.0 + channels + 4.0, "{adaptive:?}");
        assert!(
            adaptive.interpolated.frame_bytes >= 4.0 + 3.0 * channels,
            "two references read, one written"
        );
        assert_eq!(adaptive.node_visit, full.node_visit);
        let checkerboard = demands("room", Method::Checkerboard);
        // Four neighbours of 12 bytes and the pixel; the branch for traced pixels reads its sample and writes its
        // pixel.
        assert_eq!(checkerboard.interpolated.frame_bytes, (4.0 * 12.0 + 4.0) + (12.0 + 4.0));
    }

    fn adaptive_channels() -> usize {
        spec("room", &Settings::default()).channels().len()
    }

    #[test]
    fn what_a_scene_does_not_need_costs_nothing() {
        let (room, wires) = (demands("room", Method::Full), demands("wires", Method::Full));
        assert!(wires.followed_ray.operations < room.followed_ray.operations, "{wires:?}");
        assert!(wires.followed_ray.scene_bytes < room.followed_ray.scene_bytes, "no textures");
    }

    /// Fails if a function is renamed: it would then be counted with every test.
    #[test]
    fn rare_functions_are_there() {
        let settings = Settings { method: Method::Full, ..Settings::default() };
        let kernel = link(&spec("room", &settings).sources(&super::super::full::FULL)).expect("links");
        for name in RARE.into_iter().chain(AVERAGES).chain([TRAVERSAL, SHADOWS]) {
            assert!(count(&kernel, Some(name), &[]).is_some(), "{name}");
        }
    }
}
