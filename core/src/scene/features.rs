//! Features of a scene, which decide the parts of the shaders that are linked.

use glam::Vec3;

use super::{Material, Scene, touching_solids};

/// Defines [`Features`] with the value that has all of them, and their names.
macro_rules! features {
    ($(#[$of_all:meta])* pub struct Features { $($(#[$doc:meta])* pub $name:ident: bool,)* }) => {
        $(#[$of_all])*
        pub struct Features { $($(#[$doc])* pub $name: bool,)* }

        impl Features {
            const EVERY: Self = Self { $($name: true,)* };
            const NONE: Self = Self { $($name: false,)* };

            /// The number of features.
            pub const COUNT: usize = [$(stringify!($name)),*].len();

            /// All features with their names in the statistics.
            #[must_use]
            pub fn list(&self) -> [(&'static str, bool); Self::COUNT] {
                [$((stringify!($name), self.$name)),*]
            }
        }
    };
}

features! {
/// Features that kernels need for a scene. `false` leaves the feature's code out of every kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Features {
    /// Some object is textured: texture coordinates are stored and check TX is linked.
    pub textures: bool,
    /// Some material is not matte: it is metallic, reflective, transmissive, emissive, unlit or has explicit
    /// weights. Of an environment map matte dielectrics reflect some light specularly too.
    pub glossy: bool,
    /// Some material has an emissive factor above zero.
    pub emission: bool,
    /// Some material has a metallic-roughness texture.
    pub metallic_roughness_textures: bool,
    /// Some material has an emissive texture.
    pub emissive_textures: bool,
    /// Some object has vertex colours.
    pub vertex_colors: bool,
    /// Some shading normals differ from face normals.
    pub smooth_normals: bool,
    /// Some material cuts holes by alpha.
    pub alpha_mask: bool,
    /// Some material covers in part what is behind it.
    pub coverage: bool,
    /// Some vertices have an alpha that coverage or holes depend on.
    pub vertex_alpha: bool,
    /// Some opaque surface has one side only: rays from behind pass through it.
    pub single_sided: bool,
    /// Some object casts no shadow, so that shadow rays must test flags.
    pub shadow_filter: bool,
    /// There are analytic spheres.
    pub spheres: bool,
    /// Some material reflects specularly.
    pub reflection: bool,
    /// Some material transmits light.
    pub refraction: bool,
    /// Rays go straight on through some surfaces: thin ones that transmit light, partial coverage, or boundaries
    /// between equal media.
    pub panes: bool,
    /// Solids that transmit light may touch, overlap or contain one another.
    pub nested_media: bool,
    /// The environment is a map instead of constant radiances.
    pub environment_map: bool,
    /// There are punctual lights: shadow rays and check SH are linked.
    pub lights: bool,
    /// There is more than one punctual light.
    pub several_lights: bool,
    /// Some material has more than its factors and the first three textures with common coordinates.
    pub extended_materials: bool,
    /// Some material or its clear coat has a normal map.
    pub normal_maps: bool,
    /// Some clear coat may have other normals than what it covers.
    pub coat_normals: bool,
    /// Some material reads tangents.
    pub tangents: bool,
    /// Some material is anisotropic.
    pub anisotropy: bool,
    /// Some material has a thin film.
    pub iridescence: bool,
    /// Some material transmits light diffusely.
    pub translucency: bool,
    /// Some solid refracts colours apart.
    pub dispersion: bool,
    /// Some texture slot does not read the first set of texture coordinates as they are.
    pub slot_coordinates: bool,
    /// Some material has a specular colour, specular-glossiness factors, a clear coat, sheen or absorption.
    pub layers: bool,
    /// Some material has a sheen.
    pub sheen: bool,
    /// Some material has a lobe that is neither diffuse nor a mirror, which paths sample.
    pub microfacets: bool,
}
}

impl Features {
    /// Derives the features that rendering this scene needs.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let used = || scene.objects.iter().filter_map(|o| scene.materials.get(o.material as usize));
        let nested_media = !touching_solids(scene).is_empty();
        Self {
            textures: used().any(|m| m.textures().next().is_some()),
            glossy: scene.environment_map.is_some()
                || used().any(|m| !m.is_matte() || m.unlit || m.blends || m.is_extended()),
            emission: used().any(|m| m.emission != Vec3::ZERO),
            metallic_roughness_textures: used().any(|m| m.metallic_roughness_texture.is_some()),
            emissive_textures: used().any(|m| m.emissive_texture.is_some()),
            vertex_colors: !scene.colors.is_empty(),
            smooth_normals: scene.normals.iter().any(|[a, b, c]| a != b || b != c),
            alpha_mask: used().any(|m| m.alpha_cutoff.is_some()),
            coverage: used().any(|m| m.blends),
            vertex_alpha: vertex_alpha(scene),
            single_sided: used().any(|m| m.is_single_sided()),
            shadow_filter: used().any(|m| !m.casts_shadow),
            spheres: !scene.spheres.is_empty(),
            reflection: used().any(|m| m.reflects()),
            refraction: used().any(|m| m.refracts()),
            panes: nested_media || used().any(|m| m.blends || m.thin && m.refracts()),
            nested_media,
            environment_map: scene.environment_map.is_some(),
            lights: !scene.lights.is_empty(),
            several_lights: scene.lights.len() > 1,
            extended_materials: used().any(Material::is_extended),
            normal_maps: used().any(Material::bends_normals),
            coat_normals: used().any(Material::has_coat_normals),
            tangents: used().any(Material::reads_tangents),
            anisotropy: used().any(Material::is_anisotropic),
            iridescence: used().any(Material::is_iridescent),
            translucency: used().any(Material::is_translucent),
            dispersion: used().any(Material::is_dispersive),
            slot_coordinates: used().any(|m| !m.coordinates.is_empty()),
            layers: used().any(Material::is_layered),
            sheen: used().any(Material::has_sheen),
            microfacets: used().any(Material::has_microfacets),
        }
    }

    /// All features switched on, for kernels that link every piece.
    #[must_use]
    pub fn all() -> Self {
        Self::all_beside(&Self::NONE)
    }

    /// All features switched on for a scene that needs these. The textures of an environment map, the table of lobes'
    /// albedos and lists of media exist only where they are needed, and the light of coats with normals of their own is
    /// added up in another order, which rounds otherwise.
    #[must_use]
    pub(crate) fn all_beside(needed: &Self) -> Self {
        Self {
            coat_normals: needed.coat_normals,
            environment_map: needed.environment_map,
            microfacets: needed.microfacets,
            nested_media: needed.nested_media,
            sheen: needed.sheen,
            ..Self::EVERY
        }
    }

    /// Those that decide what a primary ray hits, and the base colours of what it hits.
    #[must_use]
    pub(crate) fn of_preview(&self) -> Self {
        Self {
            textures: self.textures,
            vertex_colors: self.vertex_colors,
            alpha_mask: self.alpha_mask,
            single_sided: self.single_sided,
            spheres: self.spheres,
            ..Self::NONE
        }
    }

    /// Whether a sample may trace rays besides the primary one and shadow rays, so that their radiance is stored.
    #[must_use]
    pub fn secondary_rays(&self) -> bool {
        self.reflection || self.refraction || self.coverage
    }
}

/// Whether some vertex has an alpha below 1 that its material reads.
fn vertex_alpha(scene: &Scene) -> bool {
    let reads = |object: &u32| {
        let object = scene.objects.get(*object as usize);
        let material = object.and_then(|o| scene.materials.get(o.material as usize));
        material.is_some_and(|m| m.blends || m.alpha_cutoff.is_some())
    };
    let mut colors = scene.colors.iter().zip(&scene.triangle_objects);
    colors.any(|(corners, object)| corners.iter().any(|[.., alpha]| *alpha < u16::MAX) && reads(object))
}
