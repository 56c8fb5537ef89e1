//! Phones that the emulator can be: displays, and limits of graphics devices with the source of every figure.

use std::collections::BTreeMap;

use serde::Deserialize;

const FILE: &str = include_str!("phones.toml");

/// A figure and where it was published.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sourced<T> {
    /// The figure.
    pub value: T,
    /// Where it is from: a report, a page, `estimate` or `WebGPU default`.
    pub source: String,
}

/// A phone.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Phone {
    /// As it is asked for.
    pub name: String,
    /// As it is sold.
    pub model: String,
    /// Its graphics device.
    pub gpu: String,
    /// The devices that it stands for.
    pub family: String,
    /// Pixels of the display in portrait.
    pub size: Sourced<[u32; 2]>,
    /// Refreshes of the display per second.
    pub refresh_hz: Sourced<u32>,
    /// Pixels per point.
    pub scale: Sourced<f32>,
    /// Points at the top, right, bottom and left in portrait that are covered or belong to the system.
    pub insets: Sourced<[f32; 4]>,
    /// 3DMark Wild Life Extreme, where it was published: how fast phones are over each other.
    pub wild_life_extreme: Option<Sourced<u32>>,
    /// Peak of 32-bit floating point: billions of operations a second, a multiply-add as two.
    pub gflops: Sourced<f64>,
    /// Peak of the memory: billions of bytes a second.
    pub gigabytes: Sourced<f64>,
    limits: BTreeMap<String, Sourced<u64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Phones {
    sources: BTreeMap<String, String>,
    phone: Vec<Phone>,
}

impl Phone {
    /// All of them, in the order of the file.
    ///
    /// # Errors
    /// What is wrong with the file, which is part of the program.
    pub fn all() -> Result<Vec<Self>, String> {
        parse(FILE)
    }

    /// The one of that name.
    ///
    /// # Errors
    /// Names all that there are.
    pub fn named(name: &str) -> Result<Self, String> {
        let all = Self::all()?;
        let names: Vec<_> = all.iter().map(|phone| phone.name.as_str()).collect();
        let error = format!("expected one of {}, found {name}", names.join(", "));
        all.into_iter().find(|phone| phone.name == name).ok_or(error)
    }

    /// What its graphics device allows; where the file says nothing, the WebGPU default.
    #[must_use]
    pub fn limits(&self) -> wgpu::Limits {
        let mut limits = wgpu::Limits::default();
        for (name, figure) in &self.limits {
            // Names and ranges were checked when the file was read.
            let _ = limit(&mut limits, name, figure.value);
        }
        limits
    }

    /// The figures behind [`Phone::limits`], by wgpu's names.
    pub fn limit_sources(&self) -> impl Iterator<Item = (&str, &Sourced<u64>)> {
        self.limits.iter().map(|(name, figure)| (name.as_str(), figure))
    }

    fn resolve(&mut self, sources: &BTreeMap<String, String>) -> Result<(), String> {
        let name = &self.name;
        let keys = [
            &mut self.size.source,
            &mut self.refresh_hz.source,
            &mut self.scale.source,
            &mut self.insets.source,
            &mut self.gflops.source,
            &mut self.gigabytes.source,
        ];
        let keys = keys.into_iter().chain(self.wild_life_extreme.iter_mut().map(|score| &mut score.source));
        for key in keys.chain(self.limits.values_mut().map(|figure| &mut figure.source)) {
            let source = sources.get(key.as_str());
            *key = source
                .cloned()
                .ok_or_else(|| format!("{name}: expected an entry of [sources], found {key}"))?;
        }
        for (limit_name, figure) in &self.limits {
            limit(&mut wgpu::Limits::default(), limit_name, figure.value)
                .map_err(|error| format!("{name}: {limit_name}: {error}"))?;
        }
        Ok(())
    }
}

fn parse(text: &str) -> Result<Vec<Phone>, String> {
    let Phones { sources, mut phone } =
        toml::from_str(text).map_err(|error| format!("phones.toml: {error}"))?;
    for phone in &mut phone {
        phone.resolve(&sources).map_err(|error| format!("phones.toml: {error}"))?;
    }
    Ok(phone)
}

/// Sets a limit by its name.
fn limit(limits: &mut wgpu::Limits, name: &str, value: u64) -> Result<(), String> {
    let small = || u32::try_from(value).map_err(|_| format!("expected at most {}, found {value}", u32::MAX));
    match name {
        "max_buffer_size" => limits.max_buffer_size = value,
        "max_storage_buffer_binding_size" => limits.max_storage_buffer_binding_size = value,
        "max_storage_buffers_per_shader_stage" => limits.max_storage_buffers_per_shader_stage = small()?,
        "max_compute_workgroup_storage_size" => limits.max_compute_workgroup_storage_size = small()?,
        "max_compute_invocations_per_workgroup" => limits.max_compute_invocations_per_workgroup = small()?,
        "max_compute_workgroup_size_x" => limits.max_compute_workgroup_size_x = small()?,
        "max_compute_workgroup_size_y" => limits.max_compute_workgroup_size_y = small()?,
        "max_compute_workgroup_size_z" => limits.max_compute_workgroup_size_z = small()?,
        "max_compute_workgroups_per_dimension" => limits.max_compute_workgroups_per_dimension = small()?,
        "max_texture_dimension_2d" => limits.max_texture_dimension_2d = small()?,
        "max_texture_array_layers" => limits.max_texture_array_layers = small()?,
        "min_uniform_buffer_offset_alignment" => limits.min_uniform_buffer_offset_alignment = small()?,
        "min_storage_buffer_offset_alignment" => limits.min_storage_buffer_offset_alignment = small()?,
        _ => return Err("expected a limit of the graphics device".to_owned()),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_family_has_a_phone_that_can_run_the_kernels() {
        let phones = Phone::all().expect("the file");
        for family in [
            "Adreno 6xx",
            "Adreno 7xx",
            "Adreno 8xx",
            "Mali-G7x",
            "Mali-G6xx",
            "Mali-G7xx Immortalis",
            "Xclipse",
            "PowerVR",
        ] {
            assert!(phones.iter().any(|phone| phone.family == family), "{family}");
        }
        for phone in &phones {
            let mut lacks = Vec::new();
            let need = wgpu::Limits::default();
            need.check_limits_with_fail_fn(&phone.limits(), false, |name, need, have| {
                lacks.push((name, need, have))
            });
            assert_eq!(lacks, [], "{}", phone.name);
        }
    }

    #[test]
    fn figures_are_plausible_and_say_where_they_are_from() {
        for phone in Phone::all().expect("the file") {
            let name = &phone.name;
            let [width, height] = phone.size.value;
            assert!(
                (720..=1440).contains(&width) && (16 * width..=23 * width).contains(&(9 * height)),
                "{name}"
            );
            assert!((60..=165).contains(&phone.refresh_hz.value), "{name}");
            // Phones are 360 to 480 points wide.
            assert!((360.0..=480.0).contains(&(width as f32 / phone.scale.value)), "{name}");
            assert!(phone.insets.value.iter().all(|inset| (0.0..64.0).contains(inset)), "{name}");
            assert_eq!(phone.limit_sources().count(), 13, "{name}");
            for (limit, figure) in phone.limit_sources() {
                let published =
                    ["/", "vulkan.gpuinfo.org", "wgpu 30"].iter().any(|of| figure.source.contains(of));
                assert!(published || figure.source.starts_with("WebGPU default"), "{name}: {limit}");
            }
        }
    }

    /// Every peak is of the size that phones have, and names a page, or what it is estimated from.
    #[test]
    fn peaks_are_published_or_say_what_they_are_estimated_from() {
        let phones = Phone::all().expect("the file");
        for phone in &phones {
            assert!((200.0..5000.0).contains(&phone.gflops.value), "{}", phone.name);
            assert!((10.0..100.0).contains(&phone.gigabytes.value), "{}", phone.name);
            for source in [&phone.gflops.source, &phone.gigabytes.source] {
                let page = [".com/", ".net/", ".ua/"].iter().any(|of| source.contains(of));
                assert!(page, "{}: {source}", phone.name);
            }
        }
        let published = |phone: &&Phone| {
            [&phone.gflops.source, &phone.gigabytes.source]
                .iter()
                .all(|source| !source.starts_with("estimate"))
        };
        assert!(phones.iter().filter(published).count() >= 4, "estimates are the exception");
    }

    /// What is said to be the WebGPU default is it.
    #[test]
    fn defaults_are_those_of_webgpu() {
        for phone in Phone::all().expect("the file") {
            for (name, figure) in phone.limit_sources() {
                if figure.source.starts_with("WebGPU default") {
                    let mut limits = wgpu::Limits::default();
                    limit(&mut limits, name, figure.value).expect("a limit");
                    assert_eq!(limits, wgpu::Limits::default(), "{}: {name}", phone.name);
                }
            }
        }
    }

    #[test]
    fn names_are_unique_and_unknown_ones_are_answered_with_all() {
        let phones = Phone::all().expect("the file");
        for phone in &phones {
            assert_eq!(Phone::named(&phone.name).as_ref(), Ok(phone));
        }
        let error = Phone::named("brick").expect_err("no such phone");
        assert!(error.starts_with("expected one of ") && error.contains("found brick"), "{error}");
        for phone in &phones {
            assert!(error.contains(&phone.name), "{error}");
        }
    }

    #[test]
    fn limits_are_those_of_the_file() {
        let limits = Phone::named("pixel-6").expect("a phone").limits();
        assert_eq!(limits.max_storage_buffer_binding_size, 268_435_456);
        assert_eq!(limits.max_compute_invocations_per_workgroup, 512);
        assert_eq!(limits.max_texture_dimension_2d, 16_384);
        assert_eq!(limits.min_storage_buffer_offset_alignment, 64);
        assert_eq!(limits.max_bind_groups, wgpu::Limits::default().max_bind_groups);
    }

    #[test]
    fn mistakes_in_the_file_are_named() {
        let broken = |from: &str, to: &str| {
            assert!(FILE.contains(from), "{from} is not in the file");
            parse(&FILE.replacen(from, to, 1)).expect_err("must be refused")
        };
        let source = broken(r#"source = "density""#, r#"source = "hearsay""#);
        assert!(source.contains("redmi-note-12") && source.contains("hearsay"), "{source}");
        let name = broken("max_texture_array_layers", "max_textures");
        assert!(name.contains("redmi-note-12") && name.contains("max_textures"), "{name}");
        let large = broken(
            "max_texture_dimension_2d = { value = 16384",
            "max_texture_dimension_2d = { value = 4294967296",
        );
        assert!(large.contains("max_texture_dimension_2d") && large.contains("4294967296"), "{large}");
        let field = broken("\ngpu = ", "\ncpu = ");
        assert!(field.contains("cpu"), "{field}");
    }
}
