//! Emissive primitives as a distribution to sample points from.

use super::Scene;

/// The emissive primitives of a scene as a discrete distribution.
///
/// Points are sampled with density `strength / total` per unit of area, where `strength` is the sum of the
/// channels of the object's emission factor, without its texture: the density is constant over an object.
#[derive(Clone, Debug, Default)]
pub struct Emitters {
    /// Each emissive primitive: triangles by index, then spheres as `triangles + index`.
    pub primitives: Vec<u32>,
    /// Cumulative distribution over the primitives; the last value is 1.
    pub cumulative: Vec<f32>,
    /// Sum of strength times area over all emissive primitives.
    pub total: f64,
}

impl Emitters {
    /// Collects the emissive primitives of a scene whose area is greater than zero.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let strength = |object: u32| {
            let material = &scene.materials[scene.objects[object as usize].material as usize];
            let emission = material.emission.as_dvec3();
            if material.unlit { 0.0 } else { emission.element_sum() }
        };
        let triangles = scene.positions.iter().zip(&scene.triangle_objects).map(|(corners, &object)| {
            let [a, b, c] = corners.map(|corner| corner.as_dvec3());
            (strength(object), 0.5 * (b - a).cross(c - a).length())
        });
        let spheres = scene.spheres.iter().map(|sphere| {
            let area = 4.0 * std::f64::consts::PI * f64::from(sphere.radius).powi(2);
            (strength(sphere.object), area)
        });
        let powers = triangles.chain(spheres).map(|(strength, area)| strength * area);
        let emissive: Vec<(usize, f64)> = powers.enumerate().filter(|(_, power)| *power > 0.0).collect();
        let total = emissive.iter().map(|(_, power)| power).sum();
        let mut so_far = 0.0;
        let mut cumulative: Vec<f32> = emissive
            .iter()
            .map(|(_, power)| {
                so_far += power;
                (so_far / total) as f32
            })
            .collect();
        if let Some(last) = cumulative.last_mut() {
            *last = 1.0;
        }
        Self { primitives: emissive.iter().map(|(index, _)| *index as u32).collect(), cumulative, total }
    }

    /// Index into `primitives` of the primitive that a uniform number in [0, 1) selects.
    #[must_use]
    pub fn draw(&self, number: f32) -> usize {
        self.cumulative.partition_point(|share| *share <= number).min(self.primitives.len().saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn an_emitter_is_drawn_as_often_as_it_is_strong() {
        let scene = builtin("room").expect("built in");
        let emitters = Emitters::of(&scene);
        assert!(emitters.primitives.len() > 2);
        let mut drawn = vec![0_u32; emitters.primitives.len()];
        let count = 100_000;
        for i in 0..count {
            drawn[emitters.draw((i as f32 + 0.5) / count as f32)] += 1;
        }
        let mut before = 0.0;
        for (share, drawn) in emitters.cumulative.iter().zip(drawn) {
            let expected = f64::from(share - before) * f64::from(count);
            assert!((expected - f64::from(drawn)).abs() <= 2.0, "{drawn} instead of {expected}");
            before = *share;
        }
    }

    #[test]
    fn a_scene_without_emitters_has_none() {
        let emitters = Emitters::of(&builtin("minray").map_or_else(Scene::default, |mut scene| {
            scene.materials.iter_mut().for_each(|m| m.emission = glam::Vec3::ZERO);
            scene
        }));
        assert!(emitters.primitives.is_empty());
        assert_eq!(emitters.total, 0.0);
    }
}
