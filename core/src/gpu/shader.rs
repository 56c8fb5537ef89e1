//! WGSL files linked into one module per kernel.

/// A kernel that does not compile or is bound wrongly: a bug of this crate.
#[derive(Debug, thiserror::Error)]
pub enum ShaderError {
    /// The compiler's message at its place in the file.
    #[error("{file}:{line}:{column}: {message}")]
    Invalid {
        /// WGSL file.
        file: &'static str,
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
        /// The compiler's words.
        message: String,
    },
    /// The resources given are not those that the shader uses.
    #[error("kernel `{kernel}`: bound {given:?}, the shader uses {used:?}")]
    Bindings {
        /// The kernel's label.
        kernel: &'static str,
        /// Names given, sorted.
        given: Vec<String>,
        /// Names used, sorted.
        used: Vec<String>,
    },
}
