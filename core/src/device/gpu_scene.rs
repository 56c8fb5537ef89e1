//! The scene's buffers and images on the device.

use std::sync::{Arc, OnceLock};

use glam::Vec3;

use crate::{
    Camera, Error, Features, Gpu, Result, Settings,
    acceleration::Bvh,
    device::atlas::Atlas,
    device::environment::{self, GpuEnvironment},
    device::material_records::Records,
    device::{SceneStorage, Tier, mirror::gpu_struct},
    scene::{
        self, ALBEDO_SIDE, Emitters, Environment, LightKind, LobeAlbedos, MAX_LIGHTS, Material, Scene,
        Thinness, WHITE, touching_solids,
    },
};

/// Coordinate that marks a sphere among the primitives; coordinates of triangles are at most
/// [`crate::scene::MAX_COORDINATE`].
pub const SPHERE_MARK: f32 = 3.0e38;
/// Mask of the object index in a primitive's surface word; the bits above hold flags.
pub const SURFACE_OBJECT: u32 = 0x00ff_ffff;
/// Surface flag: alpha is the share that the primitive covers.
pub const SURFACE_BLEND: u32 = 0x1000_0000;
/// Surface flag: rays other than shadow rays pass through the back of the triangle.
pub const SURFACE_SINGLE_SIDED: u32 = 0x2000_0000;
/// Surface flag: shadow rays ignore the primitive.
pub const SURFACE_NO_SHADOW: u32 = 0x4000_0000;
/// Surface flag: the alpha of the primitive's texture cuts holes.
pub const SURFACE_ALPHA: u32 = 0x8000_0000;
const MAX_OBJECTS: usize = SURFACE_OBJECT as usize + 1;

/// Flags of an object's material: unlit, thin-walled, with explicit weights, matte (only the base colour is read),
/// with alpha as its coverage, extended (the bits of `weights[0]` are the place of its record), bounding a solid that
/// transmits light, transmitting all light without a tint.
pub const OBJECT_UNLIT: u32 = 1;
pub const OBJECT_THIN: u32 = 2;
pub const OBJECT_WEIGHTS: u32 = 4;
pub const OBJECT_MATTE: u32 = 8;
pub const OBJECT_BLEND: u32 = 16;
pub const OBJECT_EXTENDED: u32 = 32;
pub const OBJECT_SOLID: u32 = 64;
pub const OBJECT_CLEAR: u32 = 128;
/// The bits from here on are a solid's priority, offset to be positive.
pub const OBJECT_PRIORITY_SHIFT: u32 = 24;

/// Kinds of lights: the irradiance of a point light falls off with the square of the distance, that of a
/// directional and of a constant one does not.
pub const LIGHT_DIRECTIONAL: u32 = 0;
pub const LIGHT_POINT: u32 = 1;
pub const LIGHT_CONSTANT: u32 = 2;

/// Limit of a light's irradiance, so that any sum over lights, lobes and rays stays finite in f32.
const MAX_IRRADIANCE: f32 = 1.0e30;

gpu_struct! {
    /// An object with its material, as shaders read it.
    pub struct Object {
        base_color: [f32; 3], alpha: f32,
        emission: [f32; 3], alpha_cutoff: f32,
        metallic: f32, roughness: f32, transmission: f32, ior: f32,
        weights: [f32; 3], flags: u32,
        base_color_texture: [u32; 4],
        metallic_roughness_texture: [u32; 4],
        emissive_texture: [u32; 4],
    }
}

/// Size of an object in units of four words.
const OBJECT_PARTS: usize = size_of::<Object>() / size_of::<[u32; 4]>();

gpu_struct! {
    /// A punctual light, as shaders read it.
    pub struct Light {
        position: [f32; 3], kind: u32,
        intensity: [f32; 3], radius: f32,
        direction: [f32; 3], inverse_range2: f32,
        cone_scale: f32, cone_offset: f32, limit: f32, padding: f32,
    }
}

/// Facts of a scene, besides its [`Features`], that kernels are specialized to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneFacts {
    /// Whether vertices have texture coordinates.
    pub has_texcoords: bool,
    /// Whether vertices have colours.
    pub has_colors: bool,
    /// Whether any primitive is emissive.
    pub emits: bool,
    /// Size of the traversal stack that the acceleration structure needs, in entries.
    pub bvh_stack: u32,
    /// Number of punctual lights.
    pub lights: u32,
    /// Number of objects.
    pub objects: u32,
    /// Number of probe points on thin features.
    pub probe_points: u32,
}

impl SceneFacts {
    /// Words of vertex attributes a primitive: six of texture coordinates, then six of colours. Without colours
    /// there are none, without either there is nothing.
    pub fn vertex_stride(texcoords: bool, colors: bool) -> u32 {
        match (texcoords, colors) {
            (false, false) => 0,
            (true, false) => 6,
            (_, true) => 12,
        }
    }
}

/// A scene on the device: geometry, acceleration structure, materials, lights and textures. Clones share the same
/// device memory, which is freed with the last one.
#[derive(Clone)]
pub struct GpuScene {
    nodes: SceneStorage,
    primitives: SceneStorage,
    shading: SceneStorage,
    vertices: SceneStorage,
    objects: SceneStorage,
    lights: wgpu::Buffer,
    probe_points: wgpu::Buffer,
    emitters: wgpu::Buffer,
    atlas: Arc<Atlas>,
    facts: SceneFacts,
    pub(crate) emitter_count: u32,
    /// Reciprocal of the sum of strength times area over all emitters; 0 without emitters.
    pub(crate) emitter_scale: f32,
    pub(crate) environment: Environment,
    environment_map: Option<Arc<GpuEnvironment>>,
    /// Table of the albedos of lobes, once a kernel reads it.
    lobe_albedos: Arc<OnceLock<wgpu::TextureView>>,
    auto_exposure: f32,
    /// The tier that the scene's data is laid out for.
    pub(crate) tier: Tier,
    features: Features,
    thinness: Arc<Thinness>,
    bounds: (Vec3, Vec3),
    /// Bounding boxes of the solids that touch others.
    solids: Arc<[(Vec3, Vec3)]>,
}

impl GpuScene {
    /// Builds the acceleration structure and uploads the scene; frees the memory of `scene`.
    ///
    /// # Errors
    /// [`Error::Missing`] if the device cannot hold the scene; [`Error::Scene`] if the scene is empty or invalid.
    pub fn upload(gpu: &Gpu, mut scene: Scene) -> Result<Self> {
        scene.validate()?;
        let bounds = scene.bounds().ok_or_else(|| Error::scene("scene", "nothing to trace in it"))?;
        if scene.lights.len() > MAX_LIGHTS || scene.objects.len() > MAX_OBJECTS {
            return Err(Error::scene(
                "scene",
                format!(
                    "{} lights and {} objects, the most are {MAX_LIGHTS} and {MAX_OBJECTS}",
                    scene.lights.len(),
                    scene.objects.len()
                ),
            ));
        }
        // Fails early, as building the tree of a scene that does not fit takes long.
        let primitive_count = scene.positions.len() + scene.spheres.len();
        gpu.check_corners("primitives", primitive_count)?;
        let features = Features::of(&scene);
        let auto_exposure = scene.auto_exposure();
        let solids = touching_solids(&scene).into();
        let thinness = Thinness::of(&scene);
        let probe_points: Vec<[f32; 3]> = thinness.probe_points().iter().map(|p| p.to_array()).collect();
        let emitting = Emitters::of(&scene);
        let bvh = Bvh::build(&scene);
        let atlas = Atlas::upload(gpu, &mut scene)?;
        let nodes = gpu.words("nodes", &bvh.nodes)?;
        log::debug!("{} primitives in {} nodes, stack of {}", bvh.order.len(), bvh.nodes.len(), bvh.stack);
        let Bvh { order, stack, nodes: tree } = bvh;
        drop(tree);
        let emitters = gpu.storage("emitters", &emitters(&emitting, &order))?;
        let primitives = gpu.corners("primitives", &primitives(&scene, &order))?;
        scene.positions = Vec::new();
        let shading = gpu.words("shading", &shading(&scene, &order))?;
        scene.normals = Vec::new();
        let has_texcoords = !scene.texcoords.is_empty();
        let has_colors = !scene.colors.is_empty();
        let vertices = gpu.vertices("vertices", &vertices(&scene, &order), order.len())?;
        let records = Records::of(&scene, &order, &atlas, (OBJECT_PARTS * scene.objects.len()) as u32);
        let objects = scene.objects.iter().map(|o| {
            let place = records.places[o.material as usize];
            object(&scene.materials[o.material as usize], &atlas, place)
        });
        let mut objects: Vec<_> =
            objects.flat_map(bytemuck::cast::<Object, [[u32; 4]; OBJECT_PARTS]>).collect();
        objects.extend(records.words);
        let mut lights = vec![Light::default(); MAX_LIGHTS];
        for (slot, each) in lights.iter_mut().zip(&scene.lights) {
            *slot = light(each);
        }
        let mut lights = bytemuck::cast_slice(&lights).to_vec();
        lights.extend([scene.lights.len() as u32, 0, 0, 0].iter().flat_map(|word| word.to_ne_bytes()));
        Ok(Self {
            nodes,
            primitives,
            shading,
            vertices,
            objects: gpu.words("objects", &objects)?,
            probe_points: gpu.storage("probe_points", &probe_points)?,
            lights: gpu.filled("lights", &lights, wgpu::BufferUsages::UNIFORM)?,
            atlas: Arc::new(atlas),
            emitters,
            emitter_count: emitting.primitives.len() as u32,
            emitter_scale: if emitting.total > 0.0 { (1.0 / emitting.total) as f32 } else { 0.0 },
            facts: SceneFacts {
                has_texcoords,
                has_colors,
                emits: !emitting.primitives.is_empty(),
                bvh_stack: stack,
                lights: scene.lights.len() as u32,
                objects: scene.objects.len() as u32,
                probe_points: thinness.probe_points().len() as u32,
            },
            environment: scene.environment,
            auto_exposure,
            environment_map: match &scene.environment_map {
                Some(map) => Some(Arc::new(GpuEnvironment::upload(gpu, map)?)),
                None => None,
            },
            lobe_albedos: Arc::default(),
            tier: gpu.tier,
            features,
            thinness: Arc::new(thinness),
            bounds,
            solids,
        })
    }

    /// The features that kernels must support for this scene.
    #[must_use]
    pub fn features(&self) -> Features {
        self.features
    }

    /// Whether objects may fall between the samples of a frame with that many rows of samples and that block size
    /// ([`Thinness::is_thin`]).
    #[must_use]
    pub fn is_thin(&self, rows: u32, block: u32) -> bool {
        self.thinness.is_thin(rows, block)
    }

    /// The other facts that kernels are specialized to.
    pub(crate) fn facts(&self) -> SceneFacts {
        self.facts
    }

    /// Bounding box of all primitives in world space: the least and the greatest corner.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        self.bounds
    }

    /// The exposure of frames with these settings, as a factor on all light.
    pub(crate) fn exposure(&self, settings: &Settings) -> f32 {
        settings.exposure.unwrap_or(self.auto_exposure).exp2()
    }

    /// These settings with the exposure that is meant by `auto`.
    pub(crate) fn exposed(&self, settings: &Settings) -> Settings {
        Settings { exposure: settings.exposure.or(Some(self.auto_exposure)), ..*settings }
    }

    /// Longest side of the bounding box, the unit of the distance tolerance (Kim 2016).
    #[must_use]
    pub fn longest_side(&self) -> f32 {
        (self.bounds.1 - self.bounds.0).max_element()
    }

    /// Whether rays of a camera may start inside of a solid that touches others: those of an orthographic camera start
    /// anywhere in a plane.
    pub(crate) fn may_be_in_solid(&self, camera: &Camera) -> bool {
        let reach = Vec3::splat(2.0 * camera.right.length().max(camera.up.length()));
        self.solids.iter().any(|(low, high)| {
            camera.orthographic
                || (low - reach).cmple(camera.origin).all() && (high + reach).cmpge(camera.origin).all()
        })
    }

    /// Whether solids touch, overlap or contain one another.
    pub(crate) fn nests_media(&self) -> bool {
        !self.solids.is_empty()
    }

    /// Names and bindings of all scene resources that shaders read, with or without the table of the albedos of lobes.
    pub(crate) fn resources(
        &self,
        gpu: &Gpu,
        lobe_albedos: bool,
    ) -> Result<Vec<(&'static str, wgpu::BindingResource<'_>)>> {
        let mut resources = vec![
            ("nodes", self.nodes.binding()),
            ("primitives", self.primitives.binding()),
            ("shading", self.shading.binding()),
            ("vertices", self.vertices.binding()),
            ("objects", self.objects.binding()),
            ("lights", self.lights.as_entire_binding()),
            ("probe_points", self.probe_points.as_entire_binding()),
            ("emitters", self.emitters.as_entire_binding()),
            ("atlas_color", wgpu::BindingResource::TextureView(&self.atlas.color)),
            ("atlas_data", wgpu::BindingResource::TextureView(&self.atlas.data)),
        ];
        resources.extend(self.environment_map.iter().flat_map(|map| map.resources()));
        if lobe_albedos {
            let table = self.lobe_albedos(gpu)?;
            resources.push(("lobe_albedos", wgpu::BindingResource::TextureView(table)));
        }
        Ok(resources)
    }

    fn lobe_albedos(&self, gpu: &Gpu) -> Result<&wgpu::TextureView> {
        if let Some(table) = self.lobe_albedos.get() {
            return Ok(table);
        }
        let albedos = LobeAlbedos::new();
        let level = (ALBEDO_SIDE as u32, bytemuck::cast_slice(&albedos.entries));
        let table = environment::texture(gpu, "lobe_albedos", wgpu::TextureFormat::Rgba32Float, &[level])?;
        Ok(self.lobe_albedos.get_or_init(|| table))
    }

    /// Sizes in bytes: everything except the acceleration structure, and the acceleration structure.
    #[must_use]
    pub fn bytes(&self) -> (u64, u64) {
        let buffers = [&self.lights, &self.probe_points, &self.emitters];
        let words = [&self.primitives, &self.shading, &self.vertices, &self.objects];
        let scene = buffers.iter().map(|b| b.size()).sum::<u64>()
            + words.iter().map(|w| w.bytes()).sum::<u64>()
            + self.atlas.bytes()
            + self.environment_map.as_ref().map_or(0, |map| map.bytes());
        (scene, self.nodes.bytes())
    }
}

fn primitives(scene: &Scene, order: &[u32]) -> Vec<[[f32; 3]; 3]> {
    let place = |&index: &u32| match scene.positions.get(index as usize) {
        Some(corners) => corners.map(|corner| corner.to_array()),
        None => {
            let s = scene.spheres[index as usize - scene.positions.len()];
            [s.center.to_array(), [s.radius, SPHERE_MARK, 0.0], [0.0; 3]]
        }
    };
    order.iter().map(place).collect()
}

/// The index of each emissive primitive in the tree's order, and the bits of its cumulative probability.
fn emitters(emitters: &Emitters, order: &[u32]) -> Vec<[u32; 2]> {
    if emitters.primitives.is_empty() {
        return Vec::new();
    }
    let mut places = vec![0; order.len()];
    for (place, index) in order.iter().enumerate() {
        places[*index as usize] = place as u32;
    }
    let pairs = emitters.primitives.iter().zip(&emitters.cumulative);
    pairs.map(|(index, share)| [places[*index as usize], share.to_bits()]).collect()
}

fn shading(scene: &Scene, order: &[u32]) -> Vec<[u32; 4]> {
    let flags = |object: u32| {
        let material = &scene.materials[scene.objects[object as usize].material as usize];
        let alpha = if material.alpha_cutoff.is_some() { SURFACE_ALPHA } else { 0 };
        let shadow = if material.casts_shadow { 0 } else { SURFACE_NO_SHADOW };
        let sides = if material.is_single_sided() { SURFACE_SINGLE_SIDED } else { 0 };
        let blend = if material.blends { SURFACE_BLEND } else { 0 };
        object | alpha | shadow | sides | blend
    };
    let place = |&index: &u32| match scene.normals.get(index as usize) {
        Some(&[a, b, c]) => [a, b, c, flags(scene.triangle_objects[index as usize])],
        None => {
            let object = scene.spheres[index as usize - scene.normals.len()].object;
            [0, 0, 0, flags(object) & !SURFACE_SINGLE_SIDED]
        }
    };
    order.iter().map(place).collect()
}

/// Vertex attributes by primitive: texture coordinates, then colours, two channels a word. All primitives have the
/// same stride; colours come with coordinates.
fn vertices(scene: &Scene, order: &[u32]) -> Vec<u32> {
    let (textured, colored) = (!scene.texcoords.is_empty(), !scene.colors.is_empty());
    let stride = SceneFacts::vertex_stride(textured, colored) as usize;
    let mut words = Vec::with_capacity(order.len() * stride);
    for &index in order {
        if stride > 0 {
            let corners = scene.texcoords.get(index as usize).copied().unwrap_or_default();
            words.extend(corners.iter().flat_map(|t| [t.x.to_bits(), t.y.to_bits()]));
        }
        if colored {
            let corners = scene.colors.get(index as usize).copied().unwrap_or([WHITE; 3]);
            words.extend(
                corners.as_flattened().chunks_exact(2).map(|two| u32::from(two[0]) | u32::from(two[1]) << 16),
            );
        }
    }
    words
}

/// `record` is the place of an extended material's record, else 0.
fn object(m: &Material, atlas: &Atlas, record: u32) -> Object {
    // Of a material without a base colour's texture, the second slot says how coordinates are stored.
    let first = if m.base_color_texture.is_none() && m.is_extended() { m.textures().next() } else { None };
    let flag = |set: bool, bit: u32| if set { bit } else { 0 };
    let priority = (i32::from(m.priority) - i32::from(i8::MIN)) as u32;
    Object {
        base_color: m.base_color.into(),
        alpha: m.alpha,
        emission: m.emission.into(),
        alpha_cutoff: m.alpha_cutoff.unwrap_or(0.0),
        metallic: m.metallic,
        roughness: m.roughness,
        transmission: m.transmission,
        ior: m.ior,
        weights: m
            .weights
            .map_or([f32::from_bits(record), 0.0, 0.0], |w| [w.diffuse, w.mirror, w.refraction]),
        flags: flag(m.unlit, OBJECT_UNLIT)
            | flag(m.thin, OBJECT_THIN)
            | flag(m.weights.is_some(), OBJECT_WEIGHTS)
            | flag(m.is_matte(), OBJECT_MATTE)
            | flag(m.blends, OBJECT_BLEND)
            | flag(record != 0, OBJECT_EXTENDED)
            | flag(m.is_solid(), OBJECT_SOLID | (priority << OBJECT_PRIORITY_SHIFT))
            | flag(m.is_clear(), OBJECT_CLEAR),
        base_color_texture: atlas.place(m.base_color_texture),
        metallic_roughness_texture: atlas.place(first.or(m.metallic_roughness_texture)),
        emissive_texture: atlas.place(m.emissive_texture),
    }
}

fn light(light: &scene::Light) -> Light {
    let inverse_range2 = |range: f32| if range.is_finite() { range.powi(-2).min(f32::MAX) } else { 0.0 };
    let intensity = light.intensity.min(Vec3::splat(MAX_IRRADIANCE));
    let common = Light {
        intensity: intensity.into(),
        limit: MAX_IRRADIANCE / intensity.max_element().max(1.0),
        radius: light.radius,
        cone_offset: 1.0,
        ..Light::default()
    };
    match &light.kind {
        LightKind::Directional { direction } => {
            Light { kind: LIGHT_DIRECTIONAL, direction: (*direction).into(), ..common }
        }
        LightKind::Point { position, range, falloff } => Light {
            kind: if *falloff { LIGHT_POINT } else { LIGHT_CONSTANT },
            position: (*position).into(),
            inverse_range2: inverse_range2(*range),
            ..common
        },
        LightKind::Spot { position, range, direction, cone } => {
            // KHR_lights_punctual, "Inner and Outer Cone Angles".
            let scale = 1.0 / (cone.start.cos() - cone.end.cos()).max(0.001);
            Light {
                kind: LIGHT_POINT,
                position: (*position).into(),
                direction: (*direction).into(),
                inverse_range2: inverse_range2(*range),
                cone_scale: scale,
                cone_offset: -cone.end.cos() * scale,
                ..common
            }
        }
    }
}
