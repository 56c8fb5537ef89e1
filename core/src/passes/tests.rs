//! Links every kernel of every variant, without a GPU.

use wgpu::naga::{AddressSpace, proc::Layouter};

use super::{
    FrameSpec, Output, Stage, Tracing, Work, adaptive, denoise, path, refine, stages, stereo, supersample,
};
use crate::{
    Denoise, DirectLight, Features, Filter, Foveation, Jitter, LightSelection, Method, Mip, Paths,
    Postcorrect, Refine, Robustness, Roulette, Sampler, Settings, Specialize, StereoReuse, Unsampled, device,
    device::environment,
    device::gpu_scene::{self, SceneFacts},
    device::{Tier, mirror::differences, shader::link},
    frame::counters::GROUPS,
    frame::recorder,
    probe,
};

fn features(bits: u32) -> Features {
    let bit = |i: u32| bits >> i & 1 != 0;
    Features {
        textures: bit(0),
        vertex_colors: bit(1),
        alpha_mask: bit(2),
        coverage: bit(3),
        vertex_alpha: bit(1),
        single_sided: bit(1),
        shadow_filter: bit(3),
        spheres: bit(4),
        reflection: bit(5),
        refraction: bit(6),
        lights: bit(7),
        smooth_normals: bit(4),
        metallic_roughness_textures: bit(0),
        emissive_textures: bit(0),
        emission: bit(2),
        glossy: bit(0) || bit(1) || bit(3) || bit(5) || bit(6),
        panes: bit(3) || bit(6),
        several_lights: bit(7),
        extended_materials: bit(1),
        normal_maps: bit(0) && bit(1),
        tangents: bit(1) && (bit(0) || bit(6)),
        anisotropy: bit(1) && bit(6),
        iridescence: bit(1) && bit(7),
        translucency: bit(1) && bit(2) && bit(5),
        coat_normals: bit(0) && bit(1) && bit(5),
        dispersion: bit(1) && bit(6),
        slot_coordinates: bit(0) && bit(1) && bit(2),
        layers: bit(1) && bit(5),
        environment_map: bit(3),
        microfacets: bit(2) && bit(5),
        nested_media: bit(3) && bit(6),
        sheen: bit(1) && bit(2) && bit(5),
    }
}

/// All combinations of features for kernels without counters; for counting kernels, linear output and several
/// samples per pixel only no feature, all features, and each feature alone.
fn variants() -> impl Iterator<Item = FrameSpec> {
    let make = |bits, inspect, output| FrameSpec {
        settings: Settings {
            method: Method::Adaptive,
            specialize: if bits == 255 { Specialize::All } else { Specialize::Auto },
            supersample: bits & 1 != 0,
            refine: if bits & 4 != 0 { Refine::On } else { Refine::Off },
            unsampled: if bits & 4 != 0 { Unsampled::Bilinear } else { Unsampled::Nearest },
            filter: if bits & 2 != 0 { Filter::Tent } else { Filter::Box },
            jitter: if bits & 8 != 0 { Jitter::On } else { Jitter::Auto },
            postcorrect: if bits & 8 != 0 { Postcorrect::Objects } else { Postcorrect::On },
            mip: if bits & 4 != 0 { Mip::Off } else { Mip::On },
            paths: Paths {
                direct_light: DirectLight::ALL[bits as usize % 3],
                lights: LightSelection::ALL[bits as usize / 8 % 3],
                sampler: if bits & 1 != 0 { Sampler::Random } else { Sampler::Sobol },
                foveation: Foveation::ALL[bits as usize % 3],
                denoise: Denoise::ALL[bits as usize / 2 % 3],
                roulette: if bits & 16 != 0 { Roulette::Off } else { Roulette::On },
                stereo_reuse: StereoReuse::ALL[bits as usize / 2 % 3],
                ..Paths::default()
            },
            ..Settings::default()
        },
        features: features(bits),
        scene: SceneFacts {
            has_texcoords: bits & 1 != 0,
            has_colors: bits & 2 != 0,
            emits: bits & 4 != 0,
            bvh_stack: 12,
            lights: 2,
            // With and without room for the shadow bits in the object's word.
            objects: if bits & 1 != 0 { 1 << 31 } else { 100 },
            probe_points: 0,
        },
        has_panes: bits & 72 != 0,
        tier: if bits & 8 != 0 { Tier::Cpu } else { Tier::Gpu },
        inspect,
        records: inspect,
        output,
        secondary: bits & 1 != 0 && bits & 104 != 0,
        preview: false,
        robustness: Robustness::default(),
    };
    let few = || (0..8).map(|i| 1 << i).chain([0, 255]);
    let timed = (0..256).map(move |bits| make(bits, false, Output::Display));
    let counting = few().map(move |bits| make(bits, true, Output::Display));
    let linear = few().map(move |bits| make(bits, false, Output::Linear));
    let several =
        [(false, Output::Display), (true, Output::Nowhere)].into_iter().flat_map(move |(inspect, output)| {
            few().map(move |bits| {
                let one = make(bits, inspect, output);
                one.with(Settings { sampling: 2, ..one.settings })
            })
        });
    timed.chain(counting).chain(linear).chain(several)
}

#[test]
fn every_kernel_links_within_the_limits_of_a_phone() {
    let mut mirrored = std::collections::HashSet::new();
    let mut kernels = 0;
    for variant in variants() {
        for stage in stages().filter(|stage| is_linked(&variant, stage)) {
            let variant = of_stage(variant, stage);
            let linked =
                link(&variant.sources(stage)).unwrap_or_else(|e| panic!("{stage:?} {variant:?}: {e}"));
            kernels += 1;
            let storage = linked
                .used_resources()
                .filter(|(_, global, _)| matches!(global.space, AddressSpace::Storage { .. }))
                .count();
            assert!(storage <= 8, "{stage:?} {variant:?}: {storage} storage buffers");
            let invocations: u32 = linked.module.entry_points[0].workgroup_size.iter().product();
            assert!(invocations <= 256, "{stage:?}: {invocations} invocations");
            assert!(workgroup_bytes(&linked.module) <= 16_384, "{stage:?}: workgroup memory");
            for mirror in [
                recorder::FrameUniform::MIRROR,
                recorder::FrameCamera::MIRROR,
                recorder::FramePart::MIRROR,
                recorder::FrameTolerances::MIRROR,
                recorder::FramePaths::MIRROR,
                recorder::PixelRecord::MIRROR,
                gpu_scene::Object::MIRROR,
                gpu_scene::Light::MIRROR,
                environment::EnvironmentUniform::MIRROR,
            ] {
                if let Some(found) = differences(&linked.module, &mirror) {
                    assert!(found.is_empty(), "{stage:?}: {found:?}");
                    mirrored.insert(mirror.name);
                }
            }
        }
    }
    let all = variants().count();
    let supersampling = variants().filter(|variant| variant.settings.supersamples()).count();
    assert_eq!(all, 256 + 4 * 10);
    let refining = variants().filter(|variant| variant.settings.refines()).count();
    assert_eq!(kernels, all * (stages().count() - 6) + 2 * supersampling + 4 * refining);
    assert!(supersampling > 100 && refining > 50);
    assert_eq!(mirrored.len(), 9, "every mirrored struct was compared: {mirrored:?}");
}

/// The variant with a method that links the stage: stages of paths need a path tracing method, for one eye or
/// two.
fn of_stage(variant: FrameSpec, stage: &Stage) -> FrameSpec {
    let of_paths = [path::STAGES, stereo::STAGES, denoise::STAGES].concat().contains(&stage);
    let paths = if variant.features.refraction { Method::Vr } else { Method::Path };
    let method = if of_paths { paths } else { variant.settings.method };
    variant.with(Settings { method, ..variant.settings })
}

/// Whether a variant links the stage; some need extra samples or their refinement.
fn is_linked(variant: &FrameSpec, stage: &Stage) -> bool {
    let of_extra = [&supersample::SUBPIXEL_TEST, &supersample::EXTRA_SAMPLES].contains(&stage);
    let of_refinement =
        [&refine::REFINE_TEST, &refine::REFINE, &refine::STRATUM_TEST, &refine::STRATA].contains(&stage);
    (!of_extra || variant.settings.supersamples()) && (!of_refinement || variant.settings.refines())
}

/// A stage's tracing class must agree with its kernel: it traces exactly if the kernel calls the traversal.
#[test]
fn stages_trace_where_their_kernels_call_the_traversal() {
    for stage in stages() {
        let variants: Vec<_> = variants().filter(|variant| is_linked(variant, stage)).step_by(37).collect();
        assert!(!variants.is_empty(), "{stage:?}");
        for variant in variants {
            let linked = link(&of_stage(variant, stage).sources(stage)).expect("links");
            let traverses = linked
                .module
                .functions
                .iter()
                .any(|(_, function)| function.name.as_deref() == Some("bvh_traverse"));
            assert_eq!(traverses, stage.tracing != Tracing::No, "{stage:?}");
            let listed = matches!(stage.work, Work::List | Work::Lines);
            assert!(
                stage.tracing == Tracing::No || (stage.tracing == Tracing::Listed) == listed,
                "{stage:?}"
            );
        }
    }
}

/// A counter that no kernel counts, or a check that none makes, would always be 0.
#[test]
fn every_counter_is_counted_by_some_kernel() {
    let counting: Vec<_> = variants().filter(|variant| variant.inspect).collect();
    let linked = |stage: &'static Stage| {
        let of = |variant: &FrameSpec| of_stage(*variant, stage).sources(stage);
        counting.iter().filter(move |variant| is_linked(variant, stage)).flat_map(of).collect::<Vec<_>>()
    };
    let sources: std::collections::HashMap<_, _> = stages()
        .flat_map(linked)
        .filter(|source| source.file != "(constants)")
        .map(|source| (source.file, source.text))
        .collect();
    for group in GROUPS {
        for name in group.names {
            let constant = format!("{}_{}", group.prefix, name.to_uppercase());
            assert!(sources.values().any(|text| text.contains(&constant)), "no kernel counts {constant}");
        }
    }
}

/// Names identify stages in timings, in reports and among compiled kernels.
#[test]
fn names_of_stages_are_distinct() {
    let names: std::collections::HashSet<_> = stages().map(|stage| stage.name).collect();
    assert_eq!(names.len(), stages().count());
    for stage in stages() {
        assert_eq!(Tracing::of_pass(stage.name), Some(stage.tracing));
    }
    assert_eq!(Tracing::of_pass("no such stage"), None);
}

/// Workgroup sizes must match the units in which dispatches of each shape of work are counted.
#[test]
fn workgroups_fit_the_shape_of_their_work() {
    for stage in stages() {
        let variant = variants().find(|variant| is_linked(variant, stage)).expect("one");
        let linked = link(&of_stage(variant, stage).sources(stage)).expect("links");
        let threads: u32 = linked.module.entry_points[0].workgroup_size.iter().product();
        match stage.work {
            Work::Tiles(super::PATH_TILE) => assert_eq!(threads, 64, "{stage:?}"),
            Work::Tiles(side) => assert_eq!(threads, side * side, "{stage:?}"),
            Work::List | Work::Lines | Work::Ranks => assert_eq!(threads, super::TRACE_GROUP, "{stage:?}"),
            Work::Fixed => {}
        }
    }
}

fn workgroup_bytes(module: &wgpu::naga::Module) -> u32 {
    let mut layouter = Layouter::default();
    layouter.update(module.to_ctx()).expect("layouts");
    let shared = module.global_variables.iter().filter(|(_, g)| g.space == AddressSpace::WorkGroup);
    shared.map(|(_, global)| layouter[global.ty].size).sum()
}

#[test]
fn probes_are_declared_alike_on_both_sides() {
    for variant in variants() {
        for (sources, result) in [
            (probe::trace_sources(&variant), Some(probe::ProbeHit::MIRROR)),
            (probe::count_sources(&variant), None),
            (probe::spawn_sources(&variant), Some(probe::ProbeSpawn::MIRROR)),
            (probe::shade_sources(&variant), Some(probe::ProbeSample::MIRROR)),
        ] {
            let linked = link(&sources).expect("links");
            for mirror in [Some(probe::ProbeRay::MIRROR), result].into_iter().flatten() {
                assert_eq!(differences(&linked.module, &mirror), Some(vec![]));
            }
        }
    }
}

#[test]
fn the_fresnel_probe_is_declared_alike_on_both_sides() {
    let linked = link(&probe::fresnel_sources()).expect("links");
    for mirror in [probe::ProbeBoundary::MIRROR, probe::ProbeFresnel::MIRROR] {
        assert_eq!(differences(&linked.module, &mirror), Some(vec![]));
    }
}

#[test]
fn a_swapped_field_is_noticed() {
    let mirror = device::mirror::Mirror {
        name: "FrameCamera",
        size: size_of::<recorder::FrameCamera>(),
        fields: &[device::mirror::Field { name: "orthographic", offset: 0 }],
    };
    let variant = variants().next().expect("one");
    let linked = link(&variant.sources(&adaptive::BASE)).expect("links");
    assert!(!differences(&linked.module, &mirror).expect("declared").is_empty());
}
