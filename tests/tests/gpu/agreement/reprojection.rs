//! A reprojected frame against the reference pixel by pixel, given the pixels of the frame before.

use glam::{DVec3, Vec3};
use glimpse::{
    Camera, Method, Origin, Renderer, Scene, Settings,
    reference::{Kept, ReferenceFrame},
    scene::builtin,
};
use glimpse_tests::{gallery, gpu, note};

use super::Pair;

/// Allowed share of pixels decided differently: points on the border of two pixels, or equally near.
const TIES: f64 = 0.001;

/// Number of ranks, of 256, of a tenth of the pixels.
const RENEWED: u32 = 26;

/// Distance assigned to the background.
const BEYOND: f64 = 1e30;

/// Depth 1: rays beyond the first hit are not followed, as their surfaces would not be reprojected.
fn settings(method: Method) -> Settings {
    Settings { method, depth: 1, ..Settings::default() }
}

fn frame(pair: &Pair, camera: Camera) -> ReferenceFrame<'_> {
    ReferenceFrame { reference: &pair.reference, camera, size: pair.size, settings: pair.settings }
}

/// Data of each pixel that a frame by full ray tracing keeps.
fn kept(pair: &Pair) -> Vec<Kept> {
    let camera = pair.test_scene.camera;
    let mut full =
        Renderer::new(gpu(), &pair.test_scene.scene, pair.size, &settings(Method::Full)).expect("a renderer");
    let (inspection, linear) = full.inspect_linear(&camera).expect("a frame");
    let frame = frame(pair, camera);
    let of_pixel = |(index, record): (usize, &glimpse::PixelRecord)| {
        let [x, y] = [index as u32 % pair.size[0], index as u32 / pair.size[0]];
        let depth = if record.object.is_some() { f64::from(record.depth) } else { BEYOND };
        let seen = record.object.is_some() || !camera.orthographic;
        let radiance = DVec3::from_array(linear.get_pixel(x, y).0.map(f64::from));
        Kept { point: seen.then(|| frame.position([x, y], depth)), radiance }
    };
    inspection.pixels.iter().enumerate().map(of_pixel).collect()
}

fn agree(name: &str, scene: Scene, moved: impl Fn(&Camera) -> Camera) {
    let pair = Pair::new(scene, [131, 83], settings(Method::Reproject));
    let camera = moved(&pair.test_scene.camera);
    let mut renderer =
        Renderer::new(gpu(), &pair.test_scene.scene, pair.size, &pair.settings).expect("a renderer");
    renderer.render(&pair.test_scene.camera).expect("a frame");
    renderer.render(&camera).expect("a frame");
    let shown = renderer.display_image().expect("a picture");
    let records = renderer.inspect(&camera).expect("counts").pixels;
    let expected = frame(&pair, camera).reprojected(&kept(&pair));
    let (mut reused, mut decided, mut colors) = (0, 0, 0);
    for (index, (record, expected)) in records.iter().zip(&expected).enumerate() {
        let [x, y] = [index as u32 % pair.size[0], index as u32 / pair.size[0]];
        let traced = record.origin == Origin::Base;
        if ReferenceFrame::refreshes([x, y], 0, RENEWED) {
            assert!(traced, "{name}: {x} {y} is not renewed");
            continue;
        }
        match expected {
            Some(radiance) if !traced => {
                reused += 1;
                let found = shown.get_pixel(x, y).0;
                let near = (0..3).all(|i| (encoded(radiance[i]) - f64::from(found[i])).abs() < 1.0);
                colors += u32::from(!near);
            }
            expected => decided += u32::from(traced != expected.is_none()),
        }
    }
    let total = records.len();
    note(&format!(
        "{name}, reprojection: {reused} of {total} shown again, {decided} decided in another way, {colors} of another colour"
    ));
    assert!(reused * 4 > total, "{name}: {reused} are shown again");
    assert!(f64::from(decided + colors) <= TIES * total as f64, "{name}: {decided} {colors}");
}

/// sRGB level from 0 to 255, before rounding.
fn encoded(radiance: f64) -> f64 {
    let c = radiance.clamp(0.0, 1.0);
    255.0 * if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

fn aside(camera: &Camera) -> Camera {
    let by = Vec3::new(0.013, 0.007, -0.021) * (camera.origin.length() + 0.1);
    Camera { origin: camera.origin + by, ..camera.panned(0.37) }
}

#[test]
fn room() {
    agree("room", builtin("room").expect("built in"), aside);
}

#[test]
fn cornell() {
    agree("cornell", builtin("cornell").expect("built in"), aside);
}

#[test]
fn textures() {
    agree("textures", gallery::textures(), |camera| camera.panned(0.21));
}

#[test]
fn orthographic() {
    agree("orthographic", gallery::orthographic(), aside);
}
