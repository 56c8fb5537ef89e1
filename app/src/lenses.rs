//! Predistorts the picture to cancel the distortion of a headset's lenses.

use egui::{Color32, Mesh, Pos2, Rect, TextureId, Vec2, epaint::Vertex, pos2, vec2};
use glimpse::Camera;

/// The lenses of a headset, one centred in front of each eye's picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lenses {
    /// No lenses: the pictures are not distorted.
    None,
    /// The lenses of Google's Cardboard of 2014.
    Cardboard,
}

/// Number of squares along each side of the mesh of an eye's picture.
const SQUARES: u16 = 32;

impl Lenses {
    /// All kinds of lenses.
    pub const ALL: [Self; 2] = [Self::None, Self::Cardboard];

    /// Name in the overlay and in scripts.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Cardboard => "cardboard",
        }
    }

    /// Coefficients a and b of the radial distortion: a point at r on the screen is seen at r (1 + a r^2 + b r^4), both
    /// as tangents of angles from the lens's axis.
    fn coefficients(self) -> [f32; 2] {
        match self {
            Self::None => [0.0, 0.0],
            // Source: googlevr/cardboard, sdk/qrcode/cardboard_v1/cardboard_v1.h.
            Self::Cardboard => [0.441, 0.156],
        }
    }

    fn magnified(self, r: f32) -> f32 {
        let [a, b] = self.coefficients();
        1.0 + r * r * (a + r * r * b)
    }

    fn seen(self, r: f32) -> f32 {
        r * self.magnified(r)
    }

    /// Inverts the distortion: the tangent on the screen of a point that is seen at the tangent `seen`.
    fn placed(self, seen: f32) -> f32 {
        let [a, b] = self.coefficients();
        // Newton's method from above the root: the function is convex there, so the iteration decreases to
        // the root without passing it.
        let above = seen.min((seen / b).powf(0.2));
        (0..8).fold(above, |r, _| r - (self.seen(r) - seen) / (1.0 + r * r * (3.0 * a + r * r * 5.0 * b)))
    }
}

/// The distorted pictures of two eyes, side by side. Each is centred in its half of the undistorted picture,
/// as large as fits there.
pub struct Bent {
    lenses: Lenses,
    picture: Rect,
    /// Points of the overlay for a unit tangent: in the undistorted picture, and at the centre of a lens.
    flat: f32,
    bent: f32,
}

impl Bent {
    /// Computes the scales for `camera`, whose frame fills `picture` (in points) with both eyes side by side.
    pub fn new(lenses: Lenses, picture: Rect, camera: &Camera) -> Self {
        let half = 0.5 * vec2(0.5 * picture.width(), picture.height());
        let flat = half.y * camera.forward.length() / camera.up.length();
        // The side nearer to the centre keeps its position.
        let nearer = half.min_elem();
        Self { lenses, picture, flat, bent: nearer / lenses.placed(nearer / flat) }
    }

    /// A mesh that shows the texture of both eyes, of `texels` width and height, distorted.
    pub fn mesh(&self, texture: TextureId, texels: [u32; 2]) -> Mesh {
        let mut mesh = Mesh::with_texture(texture);
        // Texture coordinates stay half a texel from the border, so that interpolation does not mix the eyes.
        let inset = vec2(0.5, 0.5) / vec2(0.5 * texels[0] as f32, texels[1] as f32);
        for (left, eye) in [(0.0, self.eye(0)), (0.5, self.eye(1))] {
            let first = mesh.vertices.len() as u32;
            for step in (0..=SQUARES).flat_map(|y| (0..=SQUARES).map(move |x| vec2(x.into(), y.into()))) {
                let share = step / f32::from(SQUARES);
                let pos = self.on_screen(eye, eye.lerp_inside(share));
                let uv = share.clamp(inset, Vec2::splat(1.0) - inset);
                mesh.vertices.push(Vertex { pos, uv: pos2(left + 0.5 * uv.x, uv.y), color: Color32::WHITE });
            }
            let row = u32::from(SQUARES) + 1;
            for corner in (0..row - 1).flat_map(|y| (0..row - 1).map(move |x| first + y * row + x)) {
                mesh.add_triangle(corner, corner + 1, corner + row);
                mesh.add_triangle(corner + 1, corner + row, corner + row + 1);
            }
        }
        mesh
    }

    /// Point of the undistorted picture that is seen at a point of the screen, within the same eye's half.
    pub fn without(&self, at: Pos2) -> Pos2 {
        let eye = self.eye(usize::from(at.x >= self.picture.center().x));
        let away = at - eye.center();
        let magnified = self.lenses.magnified(away.length() / self.bent);
        eye.clamp(eye.center() + magnified * self.flat / self.bent * away)
    }

    /// Position on the screen of a point of an eye's undistorted picture.
    fn on_screen(&self, eye: Rect, at: Pos2) -> Pos2 {
        let away = at - eye.center();
        let magnified = self.lenses.magnified(self.lenses.placed(away.length() / self.flat));
        eye.center() + self.bent / (magnified * self.flat) * away
    }

    fn eye(&self, index: usize) -> Rect {
        let (left, right) = self.picture.split_left_right_at_fraction(0.5);
        [left, right][index]
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    const PICTURE: Rect = Rect { min: pos2(10.0, 20.0), max: pos2(1290.0, 740.0) };

    /// Lenses before a camera with a field of view of 90 degrees.
    fn bent(lenses: Lenses) -> Bent {
        let camera = Camera {
            origin: Vec3::ZERO,
            right: (PICTURE.width() / PICTURE.height()) * Vec3::X,
            up: Vec3::Y,
            forward: Vec3::NEG_Z,
            orthographic: false,
        };
        Bent::new(lenses, PICTURE, &camera)
    }

    #[test]
    fn lenses_undo_what_is_bent() {
        for lenses in Lenses::ALL {
            for r in [0.0, 1e-3, 0.3, 1.0, 2.0, 10.0] {
                let found = lenses.placed(lenses.seen(r));
                assert!((found - r).abs() <= 1e-5 * r, "{lenses:?}, {r}: {found}");
            }
        }
        // 1 + 0.441 + 0.156.
        assert!((Lenses::Cardboard.seen(1.0) - 1.597).abs() < 1e-6);
    }

    #[test]
    fn without_lenses_everything_stays() {
        let mesh = bent(Lenses::None).mesh(TextureId::default(), [1280, 720]);
        assert!(mesh.is_valid());
        let place = |v: &Vertex| PICTURE.lerp_inside(v.uv.to_vec2());
        // Borders are moved by half a texel.
        assert!(mesh.vertices.iter().all(|v| v.pos.distance(place(v)) < 0.75));
        assert!((mesh.calc_bounds().size() - PICTURE.size()).length() < 1e-2);
    }

    #[test]
    fn what_is_seen_through_a_lens_is_straight_again() {
        let bent = bent(Lenses::Cardboard);
        let mesh = bent.mesh(TextureId::default(), [1280, 720]);
        for vertex in &mesh.vertices {
            assert!(PICTURE.expand(1e-2).contains(vertex.pos), "{:?}", vertex.pos);
            let flat = PICTURE.lerp_inside(vertex.uv.to_vec2());
            let found = bent.without(vertex.pos);
            assert!(found.distance(flat) < 0.75, "{found} {flat}");
        }
        // The nearer sides touch the borders, the corners are drawn inward, the centre is magnified.
        let bounds = mesh.calc_bounds();
        let upright = 2.0 * bent.bent * Lenses::Cardboard.placed(1.0);
        assert!((bounds.width() - PICTURE.width()).abs() < 1e-2 && (bounds.height() - upright).abs() < 1e-2);
        assert!(upright < PICTURE.height() - 25.0, "{upright}");
        let corner = mesh.vertices[0].pos;
        assert!(corner.x > PICTURE.min.x + 30.0 && corner.y > bounds.min.y + 30.0, "{corner} {bounds}");
        assert!(bent.bent > 1.1 * bent.flat, "{} {}", bent.bent, bent.flat);
    }
}
