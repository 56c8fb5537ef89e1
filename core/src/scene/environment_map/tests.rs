use super::*;

fn lattice(count: u32) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let y = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
        let phi = f64::from(i) * std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let r = (1.0 - y * y).sqrt();
        DVec3::new(r * phi.cos(), y, r * phi.sin())
    })
}

#[test]
fn directions_come_back_from_their_places() {
    for n in lattice(10_000) {
        assert!(direction(place(n)).distance(n) < 1e-12, "{n}");
    }
    assert_eq!(place(DVec3::Y), DVec2::splat(0.5));
}

#[test]
fn the_map_is_continuous_across_its_border() {
    let map = EnvironmentMap::of(256, 2, |n| DVec3::splat(2.0 + n.dot(DVec3::new(0.3, -0.8, 0.52))));
    for n in lattice(10_000) {
        let expected = 2.0 + n.dot(DVec3::new(0.3, -0.8, 0.52));
        let found = bilinear(map.texels(), map.side(), n).x;
        assert!((found - expected).abs() < 0.01, "{n}: {found}, {expected}");
    }
}

#[test]
fn an_image_is_seen_where_its_pixels_are() {
    // A pixel of 45 degrees at +X, one row below the horizon, is red.
    let image = LinearImage::from_fn(8, 4, |x, y| {
        image::Rgb(if (x, y) == (4, 2) { [9.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] })
    });
    let map = EnvironmentMap::from_equirectangular(&image).expect("a map");
    let angle = std::f64::consts::PI / 8.0;
    let center = DVec3::new(angle.cos() * angle.cos(), -angle.sin(), angle.cos() * angle.sin());
    assert!(bilinear(map.texels(), map.side(), center).x > 7.0);
    assert_eq!(bilinear(map.texels(), map.side(), DVec3::Y), DVec3::Y);
}

#[test]
fn wrong_images_are_named() {
    let error =
        |image: &LinearImage| EnvironmentMap::from_equirectangular(image).expect_err("no map").to_string();
    let square = error(&LinearImage::new(4, 4));
    assert!(square.contains("twice as wide") && square.contains("4x4"), "{square}");
    for value in [f32::NAN, -1.0, f32::INFINITY] {
        let mut image = LinearImage::new(4, 2);
        image.put_pixel(3, 1, image::Rgb([0.0, value, 0.0]));
        assert!(error(&image).contains("pixel 3, 1"), "{value}");
    }
}

#[test]
fn a_constant_map_is_constant_to_the_last_digit() {
    let radiance = Vec3::new(0.3, 1.7, 0.123_456_7);
    let map = EnvironmentMap::constant(radiance);
    assert_eq!(map.mean(), radiance);
    assert!(map.irradiance_over_pi().texels.iter().all(|l| *l == radiance));
    assert!(map.filtered().iter().all(|level| level.texels.iter().all(|l| *l == radiance)));
}

#[test]
fn a_sky_of_two_colours_lights_a_matte_surface_as_its_integral() {
    // Radiance 1 above the horizon: a surface tilted by an angle receives (1 + cos) / 2 of it.
    let map = EnvironmentMap::of(256, 2, |n| if n.y > 0.0 { DVec3::ONE } else { DVec3::ZERO });
    let irradiance = map.irradiance_over_pi();
    for n in lattice(500) {
        let found = bilinear(&irradiance.texels, irradiance.side, n).x;
        assert!((found - 0.5 * (1.0 + n.y)).abs() < 0.01, "{n}: {found}");
    }
}

/// A sun takes most of the light of a sky; the sides away from it must not see it.
#[test]
fn a_small_sun_lights_the_sides_that_face_it_alone() {
    let sun = DVec3::new(0.6, 0.64, 0.48).normalize();
    let map = EnvironmentMap::of(512, 2, |n| DVec3::splat(if n.dot(sun) > 0.9995 { 3e3 } else { 0.2 }));
    // Irradiance over pi of the sun on a surface that faces it.
    let straight = 2.0 * (1.0 - 0.9995) * (3e3 - 0.2);
    let irradiance = map.irradiance_over_pi();
    for n in lattice(500) {
        let found = bilinear(&irradiance.texels, irradiance.side, n).x;
        let expected = 0.2 + straight * n.dot(sun).max(0.0);
        assert!((found - expected).abs() < 0.02 * straight, "{n}: {found}, {expected}");
    }
}

#[test]
fn directions_are_drawn_as_often_as_they_are_bright() {
    let map = EnvironmentMap::of(256, 1, |n| DVec3::splat(if n.y > 0.9 { 40.0 } else { 0.1 }));
    let distribution = EnvironmentDistribution::of(&map);
    for (side, level) in &distribution.levels {
        let sum: f64 = level.iter().map(|probability| f64::from(*probability)).sum();
        assert!((sum - 1.0).abs() < 1e-5 && level.len() == (side * side) as usize, "{side}: {sum}");
    }
    // The integral of the radiance, estimated by directions drawn in proportion to it, has little variance.
    let count = 40_000;
    let mut sum = 0.0;
    for i in 0..count {
        let number = DVec2::new((f64::from(i) + 0.5) / f64::from(count), (f64::from(i) * 0.618_034).fract());
        let d = distribution.draw(number.as_vec2());
        sum += map.radiance(d).x / distribution.density(d);
    }
    let expected = f64::from(map.mean().x) * 4.0 * std::f64::consts::PI;
    assert!((sum / f64::from(count) / expected - 1.0).abs() < 0.01, "{sum}, {expected}");
    let dark = EnvironmentDistribution::of(&EnvironmentMap::constant(Vec3::ZERO));
    assert!(dark.density(DVec3::Y) > 0.0);
}

/// Half of a sky's light may come from a sun of half a degree: drawn directions meet it as often, and one that does
/// estimates its light within the share of its texels that it covers.
#[test]
fn a_sun_is_drawn_with_little_variance() {
    let sun = DVec3::new(0.3, 0.8, -0.5).normalize();
    let inside = |n: DVec3| n.dot(sun) > 0.25_f64.to_radians().cos();
    let map = EnvironmentMap::of(1024, 2, |n| DVec3::splat(if inside(n) { 1e5 } else { 0.5 }));
    let distribution = EnvironmentDistribution::of(&map);
    let count = 20_000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..count {
        let number = DVec2::new((f64::from(i) + 0.5) / f64::from(count), (f64::from(i) * 0.618_034).fract());
        let d = distribution.draw(number.as_vec2());
        // Of a surface that faces the sun.
        let estimate = map.radiance(d).x * d.dot(sun).max(0.0) / distribution.density(d);
        sum += estimate;
        squares += estimate * estimate;
    }
    let (mean, squares) = (sum / f64::from(count), squares / f64::from(count));
    let deviation = (squares / (mean * mean) - 1.0).sqrt();
    assert!(deviation < 0.8, "{deviation}");
}

#[test]
fn rough_reflection_keeps_the_mean_and_widens_with_roughness() {
    let spot = DVec3::new(0.6, 0.64, 0.48).normalize();
    let map = EnvironmentMap::of(256, 2, |n| DVec3::splat(if n.dot(spot) > 0.98 { 50.0 } else { 0.2 }));
    let levels = map.filtered();
    assert_eq!(levels.iter().map(|level| level.side).collect::<Vec<_>>(), [128, 64, 32, 16, 8]);
    let at_spot = levels.iter().map(|level| bilinear(&level.texels, level.side, spot).x);
    let peaks: Vec<_> = at_spot.collect();
    assert!(peaks.is_sorted_by(|a, b| a > b), "{peaks:?}");
    assert!(peaks[0] > 30.0, "a narrow lobe sees the spot: {peaks:?}");
    // The widest lobe is weighted by the cosine, as a matte surface; texels as wide as 22 degrees lower its peak.
    let irradiance = map.irradiance_over_pi();
    let matte = bilinear(&irradiance.texels, irradiance.side, spot).x;
    assert!((0.85..1.0).contains(&(peaks[4] / matte)), "{peaks:?}, {matte}");
}

#[test]
fn white_is_bright_in_the_studio_and_not_burnt_out() {
    let irradiance = EnvironmentMap::studio().irradiance_over_pi();
    let of = |n: DVec3| bilinear(&irradiance.texels, irradiance.side, n.normalize()).x;
    let (above, front, below) = (of(DVec3::Y), of(DVec3::Z), of(-DVec3::Y));
    assert!((0.8..1.3).contains(&above), "{above}");
    assert!((0.5..1.0).contains(&front), "{front}");
    assert!((0.15..0.5).contains(&below), "{below}");
}
