//! Phones that can be emulated: displays and limits of graphics devices, with the source of every figure.

use std::collections::BTreeMap;

use serde::Deserialize;

const FILE: &str = include_str!("phones.toml");

/// A figure with its source.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sourced<T> {
    /// The figure.
    pub value: T,
    /// Source: a report, a page, `estimate` or `WebGPU default`.
    pub source: String,
}

/// A phone that can be emulated.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Phone {
    /// Name on the command line.
    pub name: String,
    /// Name of the product.
    pub model: String,
    /// Name of the graphics device.
    pub gpu: String,
    /// Similar devices that it stands for.
    pub family: String,
    /// Width and height of the display in pixels, in portrait.
    pub size: Sourced<[u32; 2]>,
    /// Refresh rate of the display in Hz.
    pub refresh_hz: Sourced<u32>,
    /// Pixels per point.
    pub scale: Sourced<f32>,
    /// Insets at the top, right, bottom and left in points, in portrait: the area of cutouts and system bars.
    pub insets: Sourced<[f32; 4]>,
    /// Published score in 3DMark Wild Life Extreme, if any, to compare the speed of phones.
    pub wild_life_extreme: Option<Sourced<u32>>,
    /// Peak rate of 32-bit floating point operations in GFLOP/s; a multiply-add counts as two.
    pub gflops: Sourced<f64>,
    /// Peak memory bandwidth in GB/s.
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
    /// All phones, in the order of the file.
    ///
    /// # Errors
    /// Fails if the table, which is part of the program, is invalid.
    pub fn all() -> Result<Vec<Self>, String> {
        parse(FILE)
    }

    /// Finds a phone by its name.
    ///
    /// # Errors
    /// Fails if the name is unknown; the message lists all names.
    pub fn named(name: &str) -> Result<Self, String> {
        let all = Self::all()?;
        let names: Vec<_> = all.iter().map(|phone| phone.name.as_str()).collect();
        let error = format!("expected one of {}, found {name}", names.join(", "));
        all.into_iter().find(|phone| phone.name == name).ok_or(error)
    }

    /// Limits of the graphics device; the WebGPU default for limits not in the table.
    #[must_use]
    pub fn limits(&self) -> wgpu::Limits {
        let mut limits = wgpu::Limits::default();
        for (name, figure) in &self.limits {
            // Names and ranges are checked when the table is read.
            let _ = limit(&mut limits, name, figure.value);
        }
        limits
    }

    /// Figures of [`Phone::limits`] with their sources, by the names of wgpu.
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

/// Sets a limit by its name in wgpu.
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

    /// Every peak is in the range of phones, and names its source or the basis of the estimate.
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

    /// Figures whose source is the WebGPU default have its value.
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
