//! Finds materials in alpha mode BLEND that are opaque all the same, as many exporters write them.

use crate::scene::Scene;

/// Makes materials opaque whose factor, texture and vertices all have an alpha of 1: no ray need go on behind them.
pub(super) fn drop_of_opaque(scene: &mut Scene) {
    let mut clear = vec![false; scene.materials.len()];
    for (corners, object) in scene.colors.iter().zip(&scene.triangle_objects) {
        if corners.iter().any(|[.., alpha]| *alpha < u16::MAX) {
            clear[scene.objects[*object as usize].material as usize] = true;
        }
    }
    for (material, clear) in scene.materials.iter_mut().zip(clear) {
        let image =
            material.base_color_texture.map(|t| &scene.images[scene.textures[t as usize].image as usize]);
        let holes = || image.is_some_and(|image| image.rgba.chunks_exact(4).any(|texel| texel[3] < u8::MAX));
        material.blends &= clear || material.alpha < 1.0 || holes();
    }
}
