//! What a frame's units of work ask of a device: arithmetic and bytes, from the code of the kernels that do them.

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

/// What some work asks of a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Demand {
    /// Arithmetic on one 32-bit number each; a quotient or a transcendental function counts as four, the rate at which
    /// graphics devices do them. A fused multiply-add would be two.
    pub operations: f64,
    /// Bytes read of the scene: nodes, primitives, materials, texels. Caches spare most of them.
    pub scene_bytes: f64,
    /// Bytes read and written of what is stored by sample: attributes, lists, colours.
    pub frame_bytes: f64,
}

impl Demand {
    /// So many times this.
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

/// What few tests need: an edge where rounding does not decide it, a triangle beyond the range of f32, and what is asked
/// about hits, of which a ray has one or two among many tests.
const RARE: [&str; 5] =
    ["triangle_edge_sign", "triangle_scaled_edges", "bvh_ahead", "bvh_nearer", "any_hit_accepts"];
/// What texture averages are made of, in loops of their own. They are taken for three rows of three points each, in the second
/// level of one texture.
const AVERAGES: [&str; 2] = ["texture_points", "texture_level"];
const TRAVERSAL: &str = "bvh_traverse";
const SHADOWS: &str = "shadow_bits";

/// Demands of the units of work that a frame's counters count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Demands {
    /// A traced sample, besides its rays.
    pub sample: Demand,
    /// A ray that is followed (primary, reflection, refraction) and the surface that it meets.
    pub followed_ray: Demand,
    /// A light, at each surface that a ray meets.
    pub light: Demand,
    /// Any ray's entry into the acceleration structure.
    pub ray: Demand,
    /// A visited node.
    pub node_visit: Demand,
    /// A tested primitive.
    pub primitive_test: Demand,
    /// A sample that is checked and interpolated.
    pub interpolated: Demand,
    /// A light, at each interpolated sample.
    pub interpolated_light: Demand,
}

impl Demands {
    /// Of frames of a scene with these settings.
    ///
    /// # Errors
    /// [`crate::Error::Shader`] where a kernel does not link.
    pub fn of(scene: &GpuScene, settings: &Settings) -> Result<Self> {
        // As a GPU has them.
        let spec = FrameSpec { tier: Tier::Gpu, ..FrameSpec::new(scene, settings) };
        Self::of_spec(&spec)
    }

    fn of_spec(spec: &FrameSpec) -> Result<Self> {
        let recipe = Recipe::of(spec.settings.method);
        let kernel = link(&spec.sources(recipe.traced))?;
        let of = |function, apart: &[&str]| count(&kernel, function, apart).unwrap_or_default();
        let tree = [RARE.as_slice(), &AVERAGES, &[TRAVERSAL]].concat();
        let [sample, followed, light] = of(None, &[tree.as_slice(), &[SHADOWS]].concat());
        // Its own loop is over lights.
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

/// A texture's average, besides what happens once.
fn average(kernel: &Linked) -> Demand {
    let of = |function| count(kernel, Some(function), &[]).unwrap_or_default();
    let [[points, row, point], [level, above, _]] = AVERAGES.map(of);
    points + row.times(3.0) + point.times(9.0) + level + above
}

/// What is not traced: at each sample, and there for each light.
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
    use crate::{Method, Specialize, scene::builtin};

    fn demands(scene: &str, method: Method) -> Demands {
        let settings = Settings { method, specialize: Specialize::Auto, ..Settings::default() };
        let spec = FrameSpec::of_scene(&builtin(scene).expect(scene), &settings);
        Demands::of_spec(&spec).expect("links")
    }

    /// The node of Ylitie 2017 has 80 bytes, a triangle of this crate 36: what the code reads of them is the check that the
    /// walk through it sees what happens where.
    #[test]
    fn a_node_is_read_once_a_visit_and_a_triangle_once_a_test() {
        for method in Method::ALL {
            let demands = demands("room", method);
            assert_eq!(demands.node_visit.scene_bytes, 80.0, "{method:?}");
            // And the number that tells a sphere from a triangle.
            assert_eq!(demands.primitive_test.scene_bytes, 36.0 + 4.0, "{method:?}");
            // Eight boxes of six planes, of which each is unpacked, converted, scaled and moved, in five operations.
            assert!((240.0..500.0).contains(&demands.node_visit.operations), "{demands:?}");
            // Three corners: moved and sheared in seven operations, multiplied in pairs in nine.
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
        // A pixel, its attributes, its entry in the list and the three numbers at the list's head.
        assert!(adaptive.sample.frame_bytes >= 4.0 + channels + 4.0, "{adaptive:?}");
        assert!(
            adaptive.interpolated.frame_bytes >= 4.0 + 3.0 * channels,
            "two references read, one written"
        );
        assert_eq!(adaptive.node_visit, full.node_visit);
        let checkerboard = demands("room", Method::Checkerboard);
        // Four neighbours (12 bytes each) and the pixel, and what the other half does beside it: its own sample, its pixel.
        assert_eq!(checkerboard.interpolated.frame_bytes, (4.0 * 12.0 + 4.0) + (12.0 + 4.0));
    }

    fn adaptive_channels() -> usize {
        FrameSpec::of_scene(&builtin("room").expect("room"), &Settings::default()).channels().len()
    }

    #[test]
    fn what_a_scene_does_not_need_costs_nothing() {
        let (room, wires) = (demands("room", Method::Full), demands("wires", Method::Full));
        assert!(wires.followed_ray.operations < room.followed_ray.operations, "{wires:?}");
        assert!(wires.followed_ray.scene_bytes < room.followed_ray.scene_bytes, "no textures");
    }

    /// A function of another name would be counted with every test.
    #[test]
    fn rare_functions_are_there() {
        let settings = Settings { method: Method::Full, ..Settings::default() };
        let kernel = link(
            &FrameSpec::of_scene(&builtin("room").expect("room"), &settings)
                .sources(&super::super::full::FULL),
        )
        .expect("links");
        for name in RARE.into_iter().chain(AVERAGES).chain([TRAVERSAL, SHADOWS]) {
            assert!(count(&kernel, Some(name), &[]).is_some(), "{name}");
        }
    }
}
