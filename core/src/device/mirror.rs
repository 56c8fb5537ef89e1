//! Rust structs that shaders read; a test compares their layouts with the WGSL declarations.

/// A field that Rust and WGSL both declare.
#[cfg(test)]
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// The field's name in Rust and WGSL.
    pub name: &'static str,
    /// Offset in bytes from the start of the struct.
    pub offset: usize,
}

/// The layout of a Rust struct that WGSL declares under the same name.
#[cfg(test)]
#[derive(Clone, Copy, Debug)]
pub struct Mirror {
    /// The struct's name in Rust and WGSL.
    pub name: &'static str,
    /// Size in bytes.
    pub size: usize,
    /// The fields in order of declaration.
    pub fields: &'static [Field],
}

macro_rules! gpu_struct {
    ($(#[$meta:meta])* $vis:vis struct $name:ident { $($(#[$field_meta:meta])* $field:ident : $type:ty),* $(,)? }) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
        $vis struct $name { $($(#[$field_meta])* pub $field: $type),* }
        impl $name {
            /// The struct's layout, compared with the WGSL declaration.
            #[cfg(test)]
            pub(crate) const MIRROR: $crate::device::mirror::Mirror = $crate::device::mirror::Mirror {
                name: stringify!($name),
                size: size_of::<$name>(),
                fields: &[$($crate::device::mirror::Field {
                    name: stringify!($field),
                    offset: core::mem::offset_of!($name, $field),
                }),*],
            };
        }
    };
}
pub(crate) use gpu_struct;

/// The differences between the layouts of a Rust struct and the WGSL struct of the same name; `None` if the
/// module does not declare it.
#[cfg(test)]
pub fn differences(module: &wgpu::naga::Module, mirror: &Mirror) -> Option<Vec<String>> {
    let (_, found) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(mirror.name))?;
    let wgpu::naga::TypeInner::Struct { members, span } = &found.inner else {
        return Some(vec![format!("{}: not a struct in WGSL", mirror.name)]);
    };
    let mut differences = Vec::new();
    if *span as usize != mirror.size {
        differences.push(format!("{}: {} bytes in Rust, {span} in WGSL", mirror.name, mirror.size));
    }
    let wgsl: Vec<_> =
        members.iter().map(|m| (m.name.as_deref().unwrap_or("?"), m.offset as usize)).collect();
    let rust: Vec<_> = mirror.fields.iter().map(|f| (f.name, f.offset)).collect();
    if wgsl != rust {
        differences.push(format!("{}: fields {rust:?} in Rust, {wgsl:?} in WGSL", mirror.name));
    }
    Some(differences)
}
