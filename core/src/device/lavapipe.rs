//! Checks for lavapipe settings that make Mesa's shader cache confuse compiled kernels.

use crate::{Error, Result};

const WIDTH: &str = "LP_NATIVE_VECTOR_WIDTH";
const DIRECTORY: &str = "MESA_SHADER_CACHE_DIR";
const DISABLE: &str = "MESA_SHADER_CACHE_DISABLE";

/// Refuses settings under which lavapipe silently renders wrong images. Its shader cache does not record for
/// which vector width kernels and texture reads were compiled (Mesa 25.0.7), and mixing widths produces stripes.
/// A chosen width therefore needs a cache directory of its own, or none.
pub(super) fn check_cache(driver: &str, is_set: impl Fn(&str) -> bool) -> Result<()> {
    if driver != "llvmpipe" || !is_set(WIDTH) || is_set(DIRECTORY) || is_set(DISABLE) {
        return Ok(());
    }
    let expected = format!("{DIRECTORY} set to a directory for this width of vectors alone");
    let found =
        "none, with which Mesa mixes up what it compiled for other widths, and pictures come out wrong";
    Err(Error::setting(WIDTH, expected, found))
}

/// Whether an environment variable is set.
#[expect(
    clippy::disallowed_methods,
    reason = "the driver reads it there too, so no argument can stand for it"
)]
pub(super) fn is_set(name: &str) -> bool {
    std::env::var_os(name).is_some_and(|value| !value.is_empty())
}

#[cfg(test)]
mod tests {
    use super::{DIRECTORY, DISABLE, WIDTH, check_cache};

    #[test]
    fn a_width_needs_a_directory_of_its_own() {
        let check =
            |driver, set: &[&str]| check_cache(driver, |name| set.contains(&name)).map_err(|e| e.to_string());
        let error = check("llvmpipe", &[WIDTH]).expect_err("compiled kernels are mixed up");
        assert!(error.starts_with(WIDTH) && error.contains(DIRECTORY), "{error}");
        for set in [&[][..], &[DIRECTORY], &[WIDTH, DIRECTORY], &[WIDTH, DISABLE]] {
            assert_eq!(check("llvmpipe", set), Ok(()), "{set:?}");
        }
        assert_eq!(check("radv", &[WIDTH]), Ok(()));
    }
}
