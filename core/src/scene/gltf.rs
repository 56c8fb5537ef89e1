//! glTF 2.0 into [`Scene`].
use super::Scene;

pub(super) fn read(
    _bytes: &[u8],
    _resolve: &mut dyn FnMut(&str) -> std::result::Result<Vec<u8>, String>,
) -> crate::Result<Scene> {
    unimplemented!()
}
