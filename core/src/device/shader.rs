//! Links WGSL files into one module per kernel.
//!
//! Files do not import each other: a kernel lists its files, and a feature is left out by listing another file
//! that defines the same functions. Resources have no binding numbers in WGSL; linking numbers them in textual
//! order and they are bound by name.

use std::{borrow::Cow, error::Error as _};

use wgpu::naga::{
    self, AddressSpace, ResourceBinding,
    front::wgsl,
    valid::{Capabilities, ModuleInfo, ValidationFlags, Validator},
};

/// One WGSL file or generated WGSL text.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Source {
    /// Path of the file relative to `core/src`, for error messages.
    pub file: &'static str,
    /// WGSL source code.
    pub text: Cow<'static, str>,
}

/// A kernel does not compile or its bindings do not match: a bug of this crate or of the driver.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShaderError {
    /// The WGSL compiler reported an error.
    #[error("{file}:{line}:{column}: {message}")]
    Invalid {
        /// The WGSL file with the error.
        file: &'static str,
        /// Line, counted from 1.
        line: usize,
        /// Column, counted from 1.
        column: usize,
        /// The message of the WGSL compiler.
        message: String,
    },
    /// The device or its driver rejected a module that is valid WGSL.
    #[error("kernel `{kernel}` does not compile on `{adapter}`: {message}")]
    Refused {
        /// Label of the kernel.
        kernel: String,
        /// Name of the adapter.
        adapter: String,
        /// The driver's message.
        message: String,
    },
    /// The given resources are not those that the shader uses.
    #[error("kernel `{kernel}`: bound {given:?}, the shader uses {used:?}")]
    Bindings {
        /// Label of the kernel.
        kernel: String,
        /// Names of the resources that were bound, sorted.
        given: Vec<String>,
        /// Names of the resources that the kernel uses, sorted.
        used: Vec<String>,
    },
}

/// A validated module linked from several WGSL files.
pub struct Linked {
    /// The module; its resources are numbered in bind group 0.
    pub module: naga::Module,
    /// The validator's results, such as which resources each function uses.
    pub info: ModuleInfo,
}

/// Concatenates the sources, numbers the resources and validates the module.
///
/// # Errors
/// [`ShaderError::Invalid`] with the file, line and column of the error.
pub fn link(sources: &[Source]) -> Result<Linked, ShaderError> {
    let text = Text::new(sources);
    let mut module = wgsl::parse_str(&text.joined)
        .map_err(|e| text.error(e.labels().next().map(|label| label.0), e.message().into()))?;
    let mut binding = 0;
    for (_, global) in module.global_variables.iter_mut() {
        if matches!(global.space, AddressSpace::Handle | AddressSpace::Uniform | AddressSpace::Storage { .. })
        {
            global.binding = Some(ResourceBinding { group: 0, binding });
            binding += 1;
        }
    }
    let info =
        Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).map_err(|e| {
            let inner = e.as_inner();
            let mut message = inner.to_string();
            let mut cause = inner.source();
            while let Some(error) = cause {
                message = format!("{message}: {error}");
                cause = error.source();
            }
            text.error(e.spans().last().map(|span| span.0), message)
        })?;
    Ok(Linked { module, info })
}

impl Linked {
    /// Names, declarations and binding numbers of the resources that the entry point `main` uses.
    pub fn used_resources(&self) -> impl Iterator<Item = (&str, &naga::GlobalVariable, u32)> {
        let entry = self.info.get_entry_point(0);
        self.module.global_variables.iter().filter_map(move |(handle, global)| {
            let name = global.name.as_deref()?;
            let number = global.binding?.binding;
            (!entry[handle].is_empty()).then_some((name, global, number))
        })
    }
}

/// Concatenated files that map positions back to the file they came from.
struct Text {
    joined: String,
    starts: Vec<(usize, &'static str)>,
}

impl Text {
    fn new(sources: &[Source]) -> Self {
        let mut text = Self { joined: String::new(), starts: Vec::new() };
        for source in sources {
            text.starts.push((text.joined.len(), source.file));
            text.joined.push_str(&source.text);
            text.joined.push('\n');
        }
        text
    }

    fn error(&self, span: Option<naga::Span>, message: String) -> ShaderError {
        let byte = span.and_then(|s| s.to_range()).map_or(0, |range| range.start);
        let index = self.starts.partition_point(|(start, _)| *start <= byte).saturating_sub(1);
        let (start, file) = self.starts.get(index).copied().unwrap_or((0, "(nothing linked)"));
        let before = &self.joined[start..byte];
        ShaderError::Invalid {
            file,
            line: before.matches('\n').count() + 1,
            column: before.len() - before.rfind('\n').map_or(0, |newline| newline + 1) + 1,
            message,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(file: &'static str, text: &'static str) -> Source {
        Source { file, text: text.into() }
    }

    #[test]
    fn mistakes_are_reported_where_they_stand() {
        let fine = source("a.wgsl", "fn one() -> f32 {\n  return 1.0;\n}");
        let cases = [
            ("fn main() {\n  let x = missing;\n}", "b.wgsl:2:11: "),
            ("fn main() -> f32 {\n  return 1u;\n}", "b.wgsl:2:"),
        ];
        for (text, expected) in cases {
            let error = link(&[fine.clone(), source("b.wgsl", text)]).err().map(|e| e.to_string());
            assert!(error.as_deref().is_some_and(|e| e.starts_with(expected)), "{error:?}");
        }
    }

    #[test]
    fn only_used_resources_count() {
        let text = "var<storage, read_write> a: array<u32>;\nvar<storage> b: array<u32>;\n\
                    @compute @workgroup_size(1) fn main() { a[0] = 1u; }";
        let linked = link(&[source("a.wgsl", text)]).expect("links");
        assert_eq!(linked.used_resources().map(|(name, ..)| name).collect::<Vec<_>>(), ["a"]);
    }
}
