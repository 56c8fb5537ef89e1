//! Stereo reuse of one eye's path samples in the other eye's image (Kim & Sung 2021, equations 1 to 6).

use glam::DVec3;

use super::{Material, Ray, Reference, ReferenceFrame, Rounding, Surface, lobes::Lobes};
use crate::{Method, StereoReuse};

/// Points coincide up to this distance, relative to the distance from the eye.
const NEAR: f64 = 1e-3;

/// Faces with at least this cosine between their normals are coplanar.
const CHANNEL: f64 = 0.999_999;

/// The contribution of a sample to a pixel of the other eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splat {
    /// Column and row of the pixel in the other eye's image.
    pub pixel: [u32; 2],
    /// Weight of the sample in that pixel, for each channel.
    pub share: DVec3,
}

/// The first surface of a path if it is a planar mirror without other lobes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mirror {
    object: u32,
    point: DVec3,
    face: DVec3,
    /// Reflectance of the mirror for each channel.
    share: DVec3,
}

impl Mirror {
    fn of(reference: &Reference, s: &Surface, m: &Material, lobes: &Lobes) -> Option<Self> {
        let share = lobes.only_mirror()?;
        let triangle = s.primitive < reference.scene.positions.len();
        let plain = m.emission == DVec3::ZERO && triangle && s.normal == s.face;
        plain.then_some(Self { object: s.object, point: s.position, face: s.face, share })
    }

    fn reflected(&self, point: DVec3) -> DVec3 {
        point - 2.0 * (point - self.point).dot(self.face) * self.face
    }
}

impl ReferenceFrame<'_> {
    /// Width and height of one eye's image.
    pub(super) fn eye_size(&self) -> [u32; 2] {
        self.settings.method.eye(self.size)
    }

    /// The side of the eye that sees a pixel (-1 left, 1 right), and the pixel's position in that eye's image.
    pub(super) fn eye([x, y]: [u32; 2], [width, _]: [u32; 2]) -> (f64, [u32; 2]) {
        if x < width { (-1.0, [x, y]) } else { (1.0, [x - width, y]) }
    }

    /// Offset of the eyes from the camera and shift of their images, as vectors along the camera's right axis.
    fn eyes(&self) -> [DVec3; 2] {
        let paths = &self.settings.paths;
        let (right, forward) = (self.camera.right.as_dvec3(), self.camera.forward.as_dvec3());
        let aside = 0.5 * f64::from(paths.eye_distance) * right.normalize();
        [
            aside,
            paths.convergence.map_or(DVec3::ZERO, |distance| aside * forward.length() / f64::from(distance)),
        ]
    }

    fn eye_origin(&self, side: f64) -> DVec3 {
        self.camera.origin.as_dvec3() + side * self.eyes()[0]
    }

    /// The primary ray of a path through a position in a pixel, and the length of its direction before
    /// normalisation, the unit of depths.
    pub(super) fn eye_ray(&self, pixel: [u32; 2], place: [f64; 2]) -> (Ray, f64) {
        if self.settings.method != Method::Vr {
            return self.ray_at([0, 1].map(|i| f64::from(pixel[i]) + place[i]), 1.0);
        }
        let size = self.eye_size();
        let (side, pixel) = Self::eye(pixel, size);
        let aside = 0.5 * f64::from(self.size[0] - size[0]);
        let (middle, length) =
            self.ray_at([f64::from(pixel[0]) + aside + place[0], f64::from(pixel[1]) + place[1]], 1.0);
        let [_, shift] = self.eyes();
        let along = middle.direction * length - side * shift;
        let growth = middle.growth * length / along.length();
        let (origin, direction) = (self.eye_origin(side), along.normalize());
        (Ray { origin, direction, growth, ..middle }, along.length())
    }

    /// The pixel in which the eye on this side sees a point.
    fn seen_by(&self, side: f64, point: DVec3) -> Option<[u32; 2]> {
        let camera = &self.camera;
        let [right, up, forward] = [camera.right, camera.up, camera.forward].map(|axis| axis.as_dvec3());
        let away = point - self.eye_origin(side);
        let depth = away.dot(forward) / forward.length_squared();
        let [_, shift] = self.eyes();
        let x = (away / depth + side * shift).dot(right) / right.length_squared();
        let y = away.dot(up) / up.length_squared() / depth;
        let ([width, height], rows) = (self.eye_size(), f64::from(self.size[1]));
        let at = [0.5 * (f64::from(width) + x * rows), 0.5 * (f64::from(height) - y * rows)];
        let first = if side > 0.0 { width } else { 0 };
        let end = [width.min(self.size[0] - first), height].map(f64::from);
        let inside = depth > 0.0 && [0, 1].into_iter().all(|i| at[i] >= 0.0 && at[i] < end[i]);
        inside.then_some([first + at[0] as u32, at[1] as u32])
    }

    /// The ray from the eye on this side to a point.
    fn eye_ray_to(&self, side: f64, point: DVec3) -> Ray {
        let (middle, length) = self.ray(self.size.map(|n| n / 2));
        let origin = self.eye_origin(side);
        let way = point - origin;
        let forward = self.camera.forward.as_dvec3();
        let depth = way.dot(forward) / forward.length_squared();
        let growth = middle.growth * length * depth / way.length();
        Ray { origin, direction: way.normalize_or_zero(), growth, ..middle }
    }

    /// Weight of a sample in its own pixel and its contribution to the other eye, from the surface at this level
    /// of its path; `mirror` is passed on from level to level.
    pub(super) fn stereo_splat(
        &self,
        (pixel, level): ([u32; 2], u32),
        ray: &Ray,
        (s, m, lobes): (&Surface, &Material, &Lobes),
        mirror: &mut Option<Mirror>,
        rounding: &mut Rounding,
    ) -> Option<(f64, Splat)> {
        let (side, _) = Self::eye(pixel, self.eye_size());
        if self.settings.paths.stereo_reuse == StereoReuse::Paper {
            let splat = (level == 1).then(|| self.copied(-side, ray, s, lobes, rounding))??;
            return Some((1.0, splat));
        }
        if level == 1 {
            *mirror = Mirror::of(self.reference, s, m, lobes);
            if mirror.is_some() {
                return None;
            }
        }
        if level > if mirror.is_some() { 2 } else { 1 } || !lobes.only_diffuse() {
            return None;
        }
        self.weighted(side, s, mirror.as_ref(), rounding)
    }

    /// Weighted reuse: both eyes find the point, this one with density 1 per pixel.
    fn weighted(
        &self,
        side: f64,
        s: &Surface,
        mirror: Option<&Mirror>,
        rounding: &mut Rounding,
    ) -> Option<(f64, Splat)> {
        let (point, face) = mirror.map_or((s.position, s.face), |mirror| {
            (mirror.reflected(s.position), mirror.reflected(mirror.point + s.face) - mirror.point)
        });
        let [here, there] = [side, -side].map(|side| face.dot(point - self.eye_origin(side)));
        if here * there <= 0.0 {
            return None;
        }
        let pixel = self.seen_by(-side, point)?;
        let share = self.sees(&self.eye_ray_to(-side, point), s, mirror, rounding)?;
        let own = here / (here + there);
        Some((own, Splat { pixel, share: share * there / (here + there) }))
    }

    /// Weight of the surface along the other eye's ray relative to this eye's; `None` if the ray does not reach
    /// it.
    fn sees(
        &self,
        ray: &Ray,
        s: &Surface,
        mirror: Option<&Mirror>,
        rounding: &mut Rounding,
    ) -> Option<DVec3> {
        let reference = self.reference;
        let Some(mirror) = mirror else {
            return self.meets(ray, None, s, rounding).then_some(DVec3::ONE);
        };
        let intersection = reference.first(ray, None, false, rounding)?;
        let z = reference.surface(ray, &intersection, rounding);
        let m = reference.material(z.object, z.texcoord, z.footprint, z.color, &z.maps);
        let (z, m) = reference.bumped(&z, m, ray.direction);
        let lobes = Lobes::of(reference, &z, &m, ray.direction, rounding);
        let other = Mirror::of(reference, &z, &m, &lobes)?;
        let apart = mirror.face.dot(z.position - mirror.point).abs();
        let coplanar = z.face.dot(mirror.face) > CHANNEL && apart < NEAR * intersection.t;
        if other.object != mirror.object || !coplanar {
            return None;
        }
        let on = z.spawn((s.position - z.position).normalize_or_zero(), (0.0, 0.0), rounding);
        let share = other.share / mirror.share;
        self.meets(&on, Some(z.primitive), s, rounding)
            .then(|| DVec3::select(mirror.share.cmpgt(DVec3::ZERO), share, DVec3::ZERO))
    }

    /// Whether the ray's first hit is this point of a surface.
    fn meets(&self, ray: &Ray, left: Option<usize>, s: &Surface, rounding: &mut Rounding) -> bool {
        let distance = s.position.distance(ray.origin);
        self.reference.first(ray, left, false, rounding).is_some_and(|hit| {
            let near = (hit.t / distance - 1.0).abs() < NEAR;
            hit.primitive == s.primitive || (hit.object == s.object && near)
        })
    }

    /// Unweighted reuse as in the paper: wherever the other eye sees the point, and where a reflected ray meets
    /// its image plane.
    fn copied(
        &self,
        other: f64,
        ray: &Ray,
        s: &Surface,
        lobes: &Lobes,
        rounding: &mut Rounding,
    ) -> Option<Splat> {
        let (mut seen, mut end) = (s.position, self.eye_origin(other));
        if lobes.mirrors() {
            let forward = self.camera.forward.as_dvec3();
            let direction = ray.direction - 2.0 * ray.direction.dot(s.normal) * s.normal;
            let distance = forward.dot(end + forward - s.position) / forward.dot(direction);
            if distance.is_nan() || distance <= 0.0 {
                return None;
            }
            end = s.position + distance * direction;
            seen = end;
        } else if lobes.diffuse == DVec3::ZERO {
            return None;
        }
        let pixel = self.seen_by(other, seen)?;
        let way = end - s.position;
        let free = Ray { t_max: way.length(), ..s.spawn(way.normalize_or_zero(), (0.0, 0.0), rounding) };
        let blocked = self.reference.unobstructed(&free, Some(s.primitive), rounding) == 0.0;
        (!blocked).then_some(Splat { pixel, share: DVec3::ONE })
    }
}
