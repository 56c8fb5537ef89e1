// Throw-away Whitted raycaster with a median-split BVH.
use glam::{Vec2, Vec3};
use glimpse::scene::*;
struct Bvh {
    nodes: Vec<(Vec3, Vec3, u32, u32)>,
    prims: Vec<u32>,
}
fn build(s: &Scene) -> Bvh {
    let mut b = Bvh { nodes: vec![], prims: (0..s.positions.len() as u32).collect() };
    fn rec(b: &mut Bvh, s: &Scene, lo: usize, hi: usize) -> u32 {
        let (mut l, mut h) = (Vec3::MAX, Vec3::MIN);
        for &p in &b.prims[lo..hi] {
            for v in s.positions[p as usize] {
                l = l.min(v);
                h = h.max(v);
            }
        }
        let me = b.nodes.len() as u32;
        b.nodes.push((l, h, lo as u32, hi as u32));
        if hi - lo > 4 {
            let d = h - l;
            let ax = if d.x > d.y && d.x > d.z {
                0
            } else if d.y > d.z {
                1
            } else {
                2
            };
            let c = |p: u32| {
                let t = s.positions[p as usize];
                t[0][ax] + t[1][ax] + t[2][ax]
            };
            b.prims[lo..hi].sort_by(|a, q| c(*a).total_cmp(&c(*q)));
            let mid = (lo + hi) / 2;
            rec(b, s, lo, mid);
            let r = rec(b, s, mid, hi);
            b.nodes[me as usize].2 = r;
            b.nodes[me as usize].3 = u32::MAX;
        }
        me
    }
    if !b.prims.is_empty() {
        let n = b.prims.len();
        rec(&mut b, s, 0, n);
    }
    b
}
struct Hit {
    t: f32,
    n: Vec3,
    g: Vec3,
    uv: Vec2,
    obj: u32,
}
fn lin(c: u8) -> f32 {
    let c = c as f32 / 255.;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}
fn tex(s: &Scene, t: u32, uv: Vec2) -> [f32; 4] {
    let t = &s.textures[t as usize];
    let im = &s.images[t.image as usize];
    let w = |v: f32, n: u32| ((v - v.floor()) * n as f32) as u32 % n;
    let o = ((w(uv.y, im.height) * im.width + w(uv.x, im.width)) * 4) as usize;
    [lin(im.rgba[o]), lin(im.rgba[o + 1]), lin(im.rgba[o + 2]), im.rgba[o + 3] as f32 / 255.]
}
struct R<'a> {
    s: &'a Scene,
    b: Bvh,
}
impl R<'_> {
    fn mat(&self, o: u32) -> &Material {
        &self.s.materials[self.s.objects[o as usize].material as usize]
    }
    fn hit(&self, o: Vec3, d: Vec3, tmax: f32, shadow: bool) -> Option<Hit> {
        let s = self.s;
        let mut best: Option<Hit> = None;
        let mut tm = tmax;
        for sp in &s.spheres {
            if shadow && !self.mat(sp.object).casts_shadow {
                continue;
            }
            let oc = o - sp.center;
            let b = oc.dot(d);
            let c = oc.length_squared() - sp.radius * sp.radius;
            let q = b * b - c;
            if q > 0. {
                let q = q.sqrt();
                for t in [-b - q, -b + q] {
                    if t > 1e-4 && t < tm {
                        tm = t;
                        let n = (o + d * t - sp.center) / sp.radius;
                        best = Some(Hit { t, n, g: n, uv: Vec2::ZERO, obj: sp.object });
                        break;
                    }
                }
            }
        }
        let inv = 1.0 / d;
        let mut st = vec![];
        if !self.b.nodes.is_empty() {
            st.push(0u32);
        }
        while let Some(i) = st.pop() {
            let (l, h, a, e) = self.b.nodes[i as usize];
            let (t0, t1) = ((l - o) * inv, (h - o) * inv);
            let (n, f) = (t0.min(t1).max_element().max(0.), t0.max(t1).min_element() * 1.00001 + 1e-6);
            if n > f || n > tm {
                continue;
            }
            if e == u32::MAX {
                st.push(i + 1);
                st.push(a);
                continue;
            }
            for &p in &self.b.prims[a as usize..e as usize] {
                let t = s.positions[p as usize];
                let (e1, e2) = (t[1] - t[0], t[2] - t[0]);
                let pv = d.cross(e2);
                let det = e1.dot(pv);
                if det.abs() < 1e-14 {
                    continue;
                }
                let tv = o - t[0];
                let u = tv.dot(pv) / det;
                if !(0. ..=1.).contains(&u) {
                    continue;
                }
                let qv = tv.cross(e1);
                let v = d.dot(qv) / det;
                if v < 0. || u + v > 1. {
                    continue;
                }
                let tt = e2.dot(qv) / det;
                if tt < 1e-4 || tt >= tm {
                    continue;
                }
                let ob = s.triangle_objects[p as usize];
                let m = self.mat(ob);
                if shadow && !m.casts_shadow {
                    continue;
                }
                let w = [1. - u - v, u, v];
                let uv = if s.texcoords.is_empty() {
                    Vec2::ZERO
                } else {
                    let c = s.texcoords[p as usize];
                    c[0] * w[0] + c[1] * w[1] + c[2] * w[2]
                };
                if let (Some(c), Some(tx)) = (m.alpha_cutoff, m.base_color_texture) {
                    if tex(s, tx, uv)[3] < c {
                        continue;
                    }
                }
                let nn = s.normals[p as usize];
                let n: Vec3 = (0..3).map(|k| octahedral_decode(nn[k]) * w[k]).sum();
                tm = tt;
                best = Some(Hit { t: tt, n: n.normalize(), g: e1.cross(e2).normalize(), uv, obj: ob });
            }
        }
        best
    }
    fn trace(&self, o: Vec3, d: Vec3, depth: u32) -> Vec3 {
        let env = &self.s.environment;
        if depth == 0 {
            return env.truncated;
        }
        let Some(h) = self.hit(o, d, 1e30, false) else { return env.background };
        let m = self.mat(h.obj);
        let p = o + d * h.t;
        let outside = h.g.dot(d) < 0.;
        let g = if outside { h.g } else { -h.g };
        let mut n = if h.n.dot(g) < 0. { -h.n } else { h.n };
        if n.dot(d) > -1e-3 {
            n = g;
        }
        let mut c = m.base_color;
        if let Some(t) = m.base_color_texture {
            let t = tex(self.s, t, h.uv);
            c *= Vec3::new(t[0], t[1], t[2]);
        }
        if m.unlit {
            return c;
        }
        let eta = if m.thin || outside { 1. / m.ior } else { m.ior };
        let cos = -n.dot(d);
        let k = 1. - eta * eta * (1. - cos * cos);
        let fr = if k <= 0. {
            1.
        } else {
            let ct = k.sqrt();
            let (a, b) = (1.0, 1.0 / eta);
            let rs = (a * cos - b * ct) / (a * cos + b * ct);
            let rp = (b * cos - a * ct) / (b * cos + a * ct);
            0.5 * (rs * rs + rp * rp)
        };
        let f0 = ((m.ior - 1.) / (m.ior + 1.)).powi(2);
        let sch = (1. - cos).powi(5);
        let mut f = Vec3::splat(fr) * (1. - m.metallic) + (c + (Vec3::ONE - c) * sch) * m.metallic;
        let mut gg = (1. - 2. * m.roughness).max(0.);
        let mut diff = c * (1. - m.metallic) * (1. - m.transmission) * (1. - f0);
        let mut refr = c * m.transmission * (1. - fr) * (1. - m.metallic);
        if let Some(w) = m.weights {
            f = Vec3::splat(w.mirror);
            gg = 1.;
            diff = c * w.diffuse;
            refr = if k > 0. { Vec3::splat(w.refraction) } else { Vec3::ZERO };
        }
        let mut out = m.emission + (diff + f * (1. - gg)) * env.ambient;
        let r0 = f0 * (1. - m.metallic) * Vec3::ONE + c * m.metallic;
        let a2 = m.roughness.max(0.05).powi(4);
        let ex = 2. / a2 - 2.;
        for l in &self.s.lights {
            let (dir, dist, e) = match &l.kind {
                LightKind::Directional { direction } => (-*direction, 1e30, 1.),
                LightKind::Point { position, falloff, .. } => {
                    let v = *position - p;
                    let q = v.length();
                    (v / q, q - l.radius, if *falloff { 1. / (q * q) } else { 1. })
                }
                LightKind::Spot { position, direction, cone, .. } => {
                    let v = *position - p;
                    let q = v.length();
                    let a = (-v / q).dot(*direction);
                    let s = ((a - cone.end.cos()) / (cone.start.cos() - cone.end.cos())).clamp(0., 1.);
                    (v / q, q, s * s / (q * q))
                }
            };
            let nl = n.dot(dir);
            if nl <= 0. || e == 0. || g.dot(dir) <= 0. {
                continue;
            }
            if self.hit(p + g * 1e-4, dir, dist, true).is_some() {
                continue;
            }
            let hv = (dir - d).normalize();
            let lobe =
                if m.roughness > 0.0 { (ex + 2.) / 8. * n.dot(hv).max(0.).powf(ex.max(0.)) } else { 0. };
            out += (diff + r0 * lobe.min(200.)) * l.intensity * (e * nl / std::f32::consts::PI);
        }
        let fm = f * gg;
        if fm.max_element() > 0.004 {
            out += fm * self.trace(p + g * 1e-4, d + 2. * cos * n, depth - 1);
        }
        if refr.max_element() > 0.004 {
            let dd = if m.thin {
                d
            } else if k > 0. {
                (d * eta + n * (eta * cos - k.sqrt())).normalize()
            } else {
                return out;
            };
            out += refr * self.trace(p - g * 1e-4, dd, depth - 1);
        }
        out
    }
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let s = builtin(&a[1]).unwrap();
    let (w, h): (u32, u32) = (a[3].parse().unwrap(), a[4].parse().unwrap());
    println!("{} tris {} objs {} mats", s.positions.len(), s.objects.len(), s.materials.len());
    let c = *s.camera(Some(&a[2])).unwrap();
    let r = R { b: build(&s), s: &s };
    let mut px = vec![0u8; (w * h * 3) as usize];
    let (mut lo, mut hi) = (f32::MAX, f32::MIN);
    let ss: u32 = a.get(6).map_or(1, |v| v.parse().unwrap());
    for j in 0..h {
        for i in 0..w {
            let mut v = Vec3::ZERO;
            for k in 0..ss * ss {
                let (dx, dy) = ((k % ss) as f32 + 0.5, (k / ss) as f32 + 0.5);
                let y = 1. - 2. * (j as f32 + dy / ss as f32) / h as f32;
                let x = (2. * (i as f32 + dx / ss as f32) - w as f32) / h as f32;
                v += r
                    .trace(
                        c.origin,
                        (c.forward + x * c.right + y * c.up).normalize(),
                        if a[1] == "minray" { 3 } else { 6 },
                    )
                    .min(Vec3::splat(2.0))
                    / (ss * ss) as f32;
            }
            lo = lo.min(v.min_element());
            hi = hi.max(v.max_element());
            for k in 0..3 {
                let x = v[k].clamp(0., 1.);
                px[((j * w + i) * 3) as usize + k] =
                    ((if x <= 0.0031308 { 12.92 * x } else { 1.055 * x.powf(1. / 2.4) - 0.055 }) * 255.)
                        .round() as u8;
            }
        }
    }
    println!("range {lo} {hi}");
    image::save_buffer(&a[5], &px, w, h, image::ExtendedColorType::Rgb8).unwrap();
}
