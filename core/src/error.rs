//! What can go wrong, once and for all: bad input, a device that cannot, a shader that does not compile.

/// The error of every fallible function of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scene cannot be used. `what` names the file's element (`mesh 3 primitive 0, POSITION`),
    /// `reason` says what was expected and what was found.
    #[error("{what}: {reason}")]
    Scene {
        /// The element of the scene.
        what: String,
        /// What was expected and what was found.
        reason: String,
    },
    /// An option, or another input of a call, has a value that it cannot have: `depth: expected a whole number, 1 to 64,
    /// found 0`.
    #[error("{option}: expected {expected}, found {found}")]
    Setting {
        /// The name of the option, as in [`crate::options::OPTIONS`], or of the input.
        option: String,
        /// What it can be.
        expected: String,
        /// What it is.
        found: String,
    },
    /// No adapter fits; the text lists those that are there.
    #[error("no graphics adapter: {0}")]
    NoAdapter(String),
    /// The adapter lacks something that this scene or frame needs.
    #[error("{what} needs {need}, the adapter `{adapter}` has {have}")]
    Missing {
        /// What needs it.
        what: String,
        /// How much of it.
        need: String,
        /// How much there is.
        have: String,
        /// The adapter's name.
        adapter: String,
    },
    /// A kernel does not compile or is bound wrongly.
    #[error(transparent)]
    Shader(#[from] crate::device::shader::ShaderError),
    /// The device is gone: its driver reset it, it was unplugged, or [`crate::Gpu::destroy`] was called. Everything
    /// made from it is gone too; a new [`crate::Gpu`], upload and renderer make the same pictures again.
    #[error("the graphics device `{adapter}` was lost ({reason})")]
    Lost {
        /// The adapter's name.
        adapter: String,
        /// The driver's words.
        reason: String,
    },
    /// The device has no memory left for this. What was there before is still usable.
    #[error(
        "the graphics device `{adapter}` is out of memory for {what}{}",
        .bytes.map_or_else(String::new, |bytes| format!(" ({bytes} bytes)"))
    )]
    OutOfMemory {
        /// What was being made.
        what: String,
        /// Its size, where it is known.
        bytes: Option<u64>,
        /// The adapter's name.
        adapter: String,
    },
    /// The device was not done in time; see [`crate::Gpu::with_timeout`]. It may be slow or hung.
    #[error("the graphics device `{adapter}` was not done after {} s", .waited.as_secs_f32())]
    Timeout {
        /// The adapter's name.
        adapter: String,
        /// How long it was waited for.
        waited: std::time::Duration,
    },
    /// The device failed at run time in another way: a bug of this crate or of the driver.
    #[error("the graphics device failed: {0}")]
    Device(String),
    /// An image cannot be read or written.
    #[error("image: {0}")]
    Image(#[from] image::ImageError),
}

impl Error {
    /// An error about an element of the scene.
    pub fn scene(what: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Scene { what: what.into(), reason: reason.into() }
    }

    /// An error about an option or another input.
    pub fn setting(option: impl Into<String>, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self::Setting { option: option.into(), expected: expected.into(), found: found.into() }
    }
}

/// The result of every fallible function of this crate.
pub type Result<T, E = Error> = std::result::Result<T, E>;
