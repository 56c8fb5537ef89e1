//! Chooses among more lights than a scene may have.

use glam::Vec3;

use crate::scene::{Light, LightKind, MAX_LIGHTS};

/// Radius of an imported light in units of the scene's longest side. Files place lights inside fixtures and flush
/// with ceilings, and the extension defines no size.
const FIXTURE: f32 = 0.01;

/// Keeps as many lights of a scene with these bounds as it may have, with a warning, and sets their radius.
pub(super) fn complete(lights: &mut Vec<Light>, warnings: &mut Vec<String>, (low, high): (Vec3, Vec3)) {
    if lights.len() > MAX_LIGHTS {
        warnings
            .push(format!("{} lights: the {MAX_LIGHTS} that light the scene most are kept", lights.len()));
        brightest(lights, low, high);
    }
    for light in lights {
        light.radius = FIXTURE * (high - low).max_element();
    }
}

/// Keeps the [`MAX_LIGHTS`] lights with the largest irradiance, in their order.
fn brightest(lights: &mut Vec<Light>, low: Vec3, high: Vec3) {
    let irradiances: Vec<f64> = lights.iter().map(|light| irradiance(light, low, high)).collect();
    let mut order: Vec<_> = (0..lights.len()).collect();
    order.sort_by(|a, b| irradiances[*b].total_cmp(&irradiances[*a]));
    let mut kept = vec![false; lights.len()];
    order.iter().take(MAX_LIGHTS).for_each(|light| kept[*light] = true);
    let mut kept = kept.into_iter();
    lights.retain(|_| kept.next() == Some(true));
}

/// Irradiance of a light in the middle of the scene, or at the point of the scene's box that is nearest to it if that
/// is farther than a tenth of the longest side.
fn irradiance(light: &Light, low: Vec3, high: Vec3) -> f64 {
    let brightness = f64::from(light.intensity.element_sum());
    let (position, range) = match &light.kind {
        LightKind::Directional { .. } => return brightness,
        LightKind::Point { position, range, .. } | LightKind::Spot { position, range, .. } => {
            (*position, *range)
        }
    };
    let distance = position.distance(position.clamp(low, high)).max(0.1 * (high - low).max_element());
    if distance > range { 0.0 } else { brightness / f64::from(distance).powi(2) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_too_many_lights_the_brightest_are_kept_in_their_order() {
        let at = |x: f32, intensity: f32, range: f32| Light {
            kind: LightKind::Point { position: Vec3::X * x, range, falloff: true },
            intensity: Vec3::splat(intensity),
            radius: 0.0,
        };
        let mut lights = vec![at(9.0, 1.0, f32::INFINITY), at(1.0, 2.0, f32::INFINITY), at(1.0, 100.0, 1e-9)];
        let direction = -Vec3::Y;
        let kind = LightKind::Directional { direction };
        lights.push(Light { kind, intensity: Vec3::splat(0.1), radius: 0.0 });
        lights.extend((0..MAX_LIGHTS - 2).map(|i| at(0.5, 3.0 + i as f32, f32::INFINITY)));
        let expected: Vec<_> = lights[1..2].iter().chain(&lights[3..]).cloned().collect();
        lights.swap(0, 2);
        brightest(&mut lights, Vec3::splat(-0.5), Vec3::splat(0.5));
        assert_eq!(lights, expected);
    }
}
