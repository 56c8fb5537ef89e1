//! Thickness statistics of a scene's objects, by which `postcorrect auto` decides. Postcorrection (Kim 2016,
//! section 4) finds objects so thin that they fall between samples; the paper turns it off by hand for scenes
//! without any (section 6.2).
//!
//! A *thing* is a sphere or a connected component of an object's triangles, welded where positions are bitwise
//! equal. Its extents along the principal axes of its surface are `a >= b >= c`:
//!
//! - a rod, a wire or a plate is `b` thick: it only looks narrower when seen edge-on;
//! - a thing whose surface covers little of `a x b` is a frame, a grid or a bent wire. Its thickness is that of
//!   its surface unrolled along the outline of the box, `area / (4 (a + b))`, which is right within a factor of
//!   two for a single ring of strips or bars.
//!
//! The measure is the total length `a` of all things thinner than a given width: a few small things do not
//! justify a search in every frame, and a hundred short ones count like one long one. The camera is unknown when
//! a scene is loaded, so the width of a sample is taken at a distance of the scene's longest side.

//!
//! Things that may be small in a frame also get *probe points*. Postcorrection spreads from traced pixels to
//! their neighbours, so it cannot find things that lie entirely between samples; it traces the pixels onto which
//! probe points project.

#[cfg(test)]
mod tests;

use glam::{DMat3, DVec3, Vec3};

use super::{Scene, Sphere};

/// Number of histogram bins of half an octave each; the last one holds all widths below 2^-15.5 of the longest
/// side.
const BINS: usize = 32;

/// A thing whose surface covers a smaller part of its box `a x b` than this is a frame or a bent wire.
const SPARSE: f64 = 0.25;

/// Height of a frame at the assumed distance, in units of the longest side: a vertical field of view of 53
/// degrees.
const FRAME_HEIGHT: f32 = 1.0;

/// Total length of thin things, in units of the scene's longest side, from which the scene counts as thin.
const LEAST_LENGTH: f32 = 1.0;

/// Greatest thickness of things with probe points, in units of the longest side: ten pixels of 1,440 rows at half
/// the assumed distance.
const PROBE_POINT_THICKNESS: f64 = 1.0 / 256.0;

/// The most probe points per thing; longer things are hit by some sample.
const PROBE_POINTS_PER_THING: usize = 8;

/// The most probe points per scene, which bounds the rays that are traced without finding anything.
const MAX_PROBE_POINTS: usize = 1 << 16;

/// Histogram of the lengths of a scene's things by thickness, and probe points of the thin ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Thinness {
    /// Total length of things by thickness, in units of the longest side; bin i starts at a thickness of
    /// `2^(-i/2)` and goes down.
    lengths: [f32; BINS],
    /// Points on thin things, in world space.
    probe_points: Vec<Vec3>,
}

impl Thinness {
    /// Measures all triangles and spheres of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let mut thinness = Self::default();
        let Some((low, high)) = scene.bounds() else { return thinness };
        let longest = f64::from((high - low).max_element());
        if longest > 0.0 {
            for sphere in &scene.spheres {
                thinness.add(&Thing::sphere(sphere), longest);
            }
            each_component(scene, |triangles| {
                thinness.add(&Thing::of(triangles.iter().map(|t| &scene.positions[*t as usize])), longest);
            });
            let every = thinness.probe_points.len().div_ceil(MAX_PROBE_POINTS).max(1);
            thinness.probe_points = thinness.probe_points.into_iter().step_by(every).collect();
        }
        thinness
    }

    fn add(&mut self, thing: &Thing, longest: f64) {
        // A thickness of zero goes to the last bin.
        let bin = (-2.0 * (thing.thickness / longest).log2()).clamp(0.0, (BINS - 1) as f64);
        self.lengths[bin as usize] += (thing.length / longest) as f32;
        if thing.thickness < PROBE_POINT_THICKNESS * longest {
            self.probe_points.extend(thing.probe_points.iter().map(|point| point.as_vec3()));
        }
    }

    /// Points on things that may be small in a frame, in world space.
    #[must_use]
    pub fn probe_points(&self) -> &[Vec3] {
        &self.probe_points
    }

    /// Total length of all things thinner than `width`, both in units of the scene's longest side; `width` is
    /// rounded up to half an octave.
    #[must_use]
    pub fn length_below(&self, width: f32) -> f32 {
        let first = (-2.0 * width.log2()).floor().clamp(0.0, BINS as f32);
        self.lengths[first as usize..].iter().sum()
    }

    /// Whether things may fall between the base samples of a frame with `rows` rows of samples, one of which is
    /// traced per block of side `block`: whether things narrower than a block at the assumed distance are in
    /// total longer than the scene's longest side.
    #[must_use]
    pub fn is_thin(&self, rows: u32, block: u32) -> bool {
        self.length_below(FRAME_HEIGHT * block as f32 / rows.max(1) as f32) >= LEAST_LENGTH
    }
}

/// Extents of a connected component in the scene's unit of length.
struct Thing {
    thickness: f64,
    length: f64,
    /// Points on it, spread along its length.
    probe_points: Vec<DVec3>,
}

impl Thing {
    fn sphere(sphere: &Sphere) -> Self {
        let width = 2.0 * f64::from(sphere.radius);
        Self { thickness: width, length: width, probe_points: vec![sphere.center.as_dvec3()] }
    }

    /// Measures the connected component that consists of these triangles.
    fn of<'a>(triangles: impl Iterator<Item = &'a [Vec3; 3]> + Clone) -> Self {
        let (center, axes, extents, area) = box_around(triangles.clone());
        let mut order = [0, 1, 2];
        order.sort_by(|i, j| extents[*i].total_cmp(&extents[*j]));
        let [_, b, a] = order.map(|axis| extents[axis]);
        if area < SPARSE * a * b {
            // The centre of the box may not be on the surface.
            let middles: Vec<_> =
                triangles.map(|t| t.map(|p| p.as_dvec3())).map(|[a, b, c]| (a + b + c) / 3.0).collect();
            let every = middles.len().div_ceil(PROBE_POINTS_PER_THING).max(1);
            let probe_points = middles.into_iter().step_by(every).collect();
            return Self { thickness: (area / (4.0 * (a + b))).min(b), length: a, probe_points };
        }
        let count = if b > 0.0 { (a / (PROBE_POINTS_PER_THING as f64 * b)).ceil() } else { 1.0 };
        let count = count.clamp(1.0, PROBE_POINTS_PER_THING as f64);
        let along = |i: usize| center + ((i as f64 + 0.5) / count - 0.5) * a * axes.col(order[2]);
        Self { thickness: b, length: a, probe_points: (0..count as usize).map(along).collect() }
    }
}

/// The centre of the box along the principal axes, these axes, the extents along them, and the surface's area.
fn box_around<'a>(triangles: impl Iterator<Item = &'a [Vec3; 3]> + Clone) -> (DVec3, DMat3, [f64; 3], f64) {
    let corners = || triangles.clone().flatten().map(|p| p.as_dvec3());
    let origin = corners().next().unwrap_or_default();
    // Moments of the surface, which do not depend on its tessellation. A triangle's second moment is area / 12
    // times the sum over its corners plus nine times that of its centroid.
    let (mut area, mut first, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
    for [a, b, c] in triangles.clone().map(|t| t.map(|p| p.as_dvec3() - origin)) {
        let part = 0.5 * (b - a).cross(c - a).length();
        let middle = (a + b + c) / 3.0;
        area += part;
        first += part * middle;
        second += part / 12.0 * (square(a) + square(b) + square(c) + 9.0 * square(middle));
    }
    let axes =
        if area > 0.0 { principal_axes(second - square(first) * (1.0 / area)) } else { DMat3::IDENTITY };
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for p in corners() {
        let along = axes.transpose() * (p - origin);
        (low, high) = (low.min(along), high.max(along));
    }
    (origin + axes * (0.5 * (low + high)), axes, (high - low).to_array(), area)
}

fn square(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// The eigenvectors of a symmetric matrix, by Jacobi rotations.
fn principal_axes(mut m: DMat3) -> DMat3 {
    let mut axes = DMat3::IDENTITY;
    for _ in 0..6 {
        for [p, q] in [[0, 1], [0, 2], [1, 2]] {
            let off = m.col(p)[q];
            if off == 0.0 {
                continue;
            }
            let theta = (m.col(q)[q] - m.col(p)[p]) / (2.0 * off);
            let tangent = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let sine = tangent * cosine;
            let mut turn = DMat3::IDENTITY;
            (turn.col_mut(p)[p], turn.col_mut(q)[q]) = (cosine, cosine);
            (turn.col_mut(p)[q], turn.col_mut(q)[p]) = (-sine, sine);
            m = turn.transpose() * m * turn;
            axes *= turn;
        }
    }
    axes
}

/// Calls `visit` with the indices of the triangles of each connected component.
fn each_component(scene: &Scene, mut visit: impl FnMut(&[u32])) {
    let mut sets = joined(scene);
    // Sorts triangles by the root of their set (counting sort).
    let roots: Vec<u32> = (0..scene.positions.len() as u32).map(|t| sets.root(t)).collect();
    let mut starts = vec![0_u32; roots.len() + 1];
    for root in &roots {
        starts[*root as usize + 1] += 1;
    }
    for i in 1..starts.len() {
        starts[i] += starts[i - 1];
    }
    let mut order = vec![0_u32; roots.len()];
    for (triangle, root) in roots.iter().enumerate() {
        // `starts` of a root is the end of its set until all of its triangles are placed.
        order[starts[*root as usize] as usize] = triangle as u32;
        starts[*root as usize] += 1;
    }
    for component in order.chunk_by(|a, b| roots[*a as usize] == roots[*b as usize]) {
        visit(component);
    }
}

/// Disjoint sets of triangles of one object that share a corner.
fn joined(scene: &Scene) -> Sets {
    let mut sets = Sets((0..scene.positions.len() as u32).collect());
    let mut corners = Corners::new(3 * scene.positions.len());
    for (triangle, positions) in scene.positions.iter().enumerate() {
        let object = scene.triangle_objects[triangle];
        for (i, position) in positions.iter().enumerate() {
            let same = |other: u32| {
                let (other, j) = ((other / 3) as usize, (other % 3) as usize);
                scene.triangle_objects[other] == object && scene.positions[other][j] == *position
            };
            if let Some(other) =
                corners.find_or_insert(hash(*position, object), (3 * triangle + i) as u32, same)
            {
                sets.join(triangle as u32, other / 3);
            }
        }
    }
    sets
}

fn hash(position: Vec3, object: u32) -> u64 {
    // Adding zero turns negative zero into positive zero.
    let [x, y, z] = (position + 0.0).to_array().map(|x| u64::from(x.to_bits()));
    let mut h = (x | y << 32).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    h ^= h >> 29;
    h = (h ^ z ^ u64::from(object) << 32).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    h ^ h >> 32
}

/// A hash table of corners with linear probing; entries are 1 + the corner's index, 0 if empty.
struct Corners(Vec<u32>);

impl Corners {
    fn new(most: usize) -> Self {
        Self(vec![0; (most + most / 2 + 1).next_power_of_two()])
    }

    /// The corner that satisfies `same`; inserts `corner` and returns `None` if there is none.
    fn find_or_insert(&mut self, hash: u64, corner: u32, same: impl Fn(u32) -> bool) -> Option<u32> {
        let mask = self.0.len() - 1;
        let mut at = hash as usize & mask;
        while self.0[at] != 0 {
            if same(self.0[at] - 1) {
                return Some(self.0[at] - 1);
            }
            at = (at + 1) & mask;
        }
        self.0[at] = corner + 1;
        None
    }
}

/// Disjoint sets with path halving (Tarjan & van Leeuwen 1984).
struct Sets(Vec<u32>);

impl Sets {
    fn root(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            self.0[i as usize] = self.0[self.0[i as usize] as usize];
            i = self.0[i as usize];
        }
        i
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
