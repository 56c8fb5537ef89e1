//! A faster traversal with the eight-wide tree and obvhs, which gives the same results as the plain tree.
//!
//! The traversal is in f32: rays start where they enter the scene, and boxes are enlarged by the bound of
//! rounding errors, so that no primitive is missed. Primitives are intersected in f64.

use glam::{DVec3, Vec3, Vec3A};
use obvhs::{aabb::Aabb, cwbvh::CwBvh, ray};

use super::intersection::{Primitive, Ray};
use crate::acceleration::Bvh;

/// Size of obvhs' traversal stack in node groups.
const STACK: u32 = 32;

/// Enlargement of boxes on all sides relative to the scene's extent: more than the rounding errors of origins,
/// directions, planes and distances in a traversal, each half a unit in the last place.
const MARGIN: f64 = 32.0 * f32::EPSILON as f64;

/// The extent of the scene in the tree's units, in which obvhs' least distance of 1e-4 is far below any rounding.
const EXTENT: f64 = 1_048_576.0;

pub(super) struct Wide {
    tree: CwBvh,
    low: DVec3,
    high: DVec3,
    /// Units of the tree in one unit of the scene.
    scale: f64,
}

impl Wide {
    /// Builds the tree; `None` for a scene without extent or if the tree exceeds the stack.
    pub fn new(primitives: &[Primitive]) -> Option<Self> {
        let boxes = || primitives.iter().map(Primitive::bounds);
        let (low, high) = boxes().reduce(|(a, b), (low, high)| (a.min(low), b.max(high)))?;
        let extent = (high - low).max_element();
        if !(extent > 0.0 && extent.is_finite()) {
            return None;
        }
        let margin = MARGIN * extent;
        let scale = EXTENT / extent;
        // Relative to the centre, so that coordinates do not exceed the extent.
        let middle = 0.5 * (low + high);
        let unit = |p: DVec3| Vec3A::from((scale * (p - middle)).as_vec3());
        let boxes: Vec<_> =
            boxes().map(|(low, high)| Aabb { min: unit(low - margin), max: unit(high + margin) }).collect();
        let Bvh { nodes, order, stack } = Bvh::of_boxes(&boxes);
        let tree = CwBvh { nodes, primitive_indices: order, ..CwBvh::default() };
        (stack <= STACK).then_some(Self { tree, low: low - margin, high: high + margin, scale })
    }

    /// Visits all primitives whose box the ray hits before `reach`, which the visitor may shorten.
    pub fn visit(&self, ray: &Ray, primitives: &[Primitive], see: &mut dyn FnMut(&Primitive, &mut f64)) {
        let Some(entry) = self.entry(ray) else { return };
        let middle = 0.5 * (self.low + self.high);
        let origin = self.scale * (ray.origin + entry * ray.direction - middle);
        let mut reach = ray.t_max;
        let distance = |t: f64| ((self.scale * (t - entry)) as f32).next_up();
        // obvhs treats -0 inconsistently as a direction; adding 0 makes it +0.
        let direction = ray.direction.as_vec3() + Vec3::ZERO;
        let walk = ray::Ray::new(origin.as_vec3().into(), direction.into(), 0.0, distance(reach));
        self.tree.ray_traverse(walk, &mut ray::RayHit::none(), |_, place| {
            see(&primitives[self.tree.primitive_indices[place] as usize], &mut reach);
            distance(reach)
        });
    }

    /// Distance at which the ray enters the scene's box; `None` if it misses the box or ends before it.
    fn entry(&self, ray: &Ray) -> Option<f64> {
        let (mut near, mut far) = (0.0_f64, ray.t_max);
        for axis in 0..3 {
            let (low, high) = (self.low[axis] - ray.origin[axis], self.high[axis] - ray.origin[axis]);
            if ray.direction[axis] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (a, b) = (low / ray.direction[axis], high / ray.direction[axis]);
            (near, far) = (near.max(a.min(b)), far.min(a.max(b)));
        }
        (near <= far).then_some(near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{random::Random, reference::Tracer, scene::Scene, scene::builtin};

    fn rays(scene: &Scene, away: f64, seed: u64) -> impl Iterator<Item = Ray> {
        let (low, high) = scene.bounds().expect("something");
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let mut random = Random(seed);
        (0..20_000).map(move |index| {
            let target = random.inside(low, high);
            let origin = match index % 2 {
                0 => random.inside(low, high),
                _ => target + away * (high - low).length() * random.direction(),
            };
            // Includes rays along the axes, for which slab quotients are infinite.
            let direction = match index % 7 {
                0 => DVec3::AXES[index / 7 % 3] * if index % 3 == 0 { 1.0 } else { -1.0 },
                _ => (target - origin).normalize_or(DVec3::X),
            };
            Ray { origin, direction, t_max: f64::INFINITY, width: 0.0, growth: 0.0 }
        })
    }

    fn scaled(scene: &Scene, factor: f32) -> Scene {
        let mut scene = scene.clone();
        scene.positions.iter_mut().flatten().for_each(|corner| *corner *= factor);
        scene.spheres.iter_mut().for_each(|s| (s.center, s.radius) = (s.center * factor, s.radius * factor));
        scene
    }

    #[test]
    fn it_finds_what_the_plain_tree_finds() {
        for name in ["room", "cornell", "minray"] {
            for (factor, away) in [(1.0, 2.0), (1e-6, 100.0), (1e5, 1e4)] {
                let scene = scaled(&builtin(name).expect("built in"), factor);
                let (plain, wide) = (Tracer::new(&scene), Tracer::new(&scene).with_wide_tree());
                let mut hits = 0;
                for ray in rays(&scene, away, 7) {
                    let [right, found] =
                        [&plain, &wide].map(|tracer| tracer.first(&ray, None, |_| true).map(|c| c.t));
                    assert_eq!(found, right, "{name} x {factor}: {ray:?}");
                    hits += usize::from(right.is_some());
                    let ending = Ray { t_max: 0.999 * right.unwrap_or(1.0), ..ray };
                    assert_eq!(wide.first(&ending, None, |_| true), None, "{name} x {factor}: {ending:?}");
                }
                assert!(hits > 5_000, "{name} x {factor}: {hits}");
            }
        }
    }

    #[test]
    fn nothing_is_hit_in_nothing() {
        let tracer = Tracer::new(&Scene::default()).with_wide_tree();
        let ray = Ray { origin: DVec3::ZERO, direction: DVec3::X, t_max: 1.0, width: 0.0, growth: 0.0 };
        assert_eq!(tracer.first(&ray, None, |_| true), None);
    }
}
