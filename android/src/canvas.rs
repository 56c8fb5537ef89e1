//! Software rasteriser of the overlay, for devices whose graphics cannot run the ray tracer.

use std::collections::HashMap;

use egui::{
    ClippedPrimitive, Color32, ColorImage, ImageData, Pos2, Rect, TextureId, TexturesDelta,
    epaint::{ImageDelta, Mesh, Primitive, Vertex},
};

/// The overlay's textures, in main memory.
#[derive(Default)]
pub struct Canvas {
    textures: HashMap<TextureId, ColorImage>,
}

impl Canvas {
    /// Applies changes of textures, as a painter on a device does.
    pub fn update(&mut self, mut delta: TexturesDelta) {
        for (id, deltas) in delta.set.drain() {
            for ImageDelta { image: ImageData::Color(image), pos, .. } in deltas {
                match (pos, self.textures.get_mut(&id)) {
                    (Some(corner), Some(known)) => patch(known, corner, &image),
                    _ => drop(self.textures.insert(id, (*image).clone())),
                }
            }
        }
        for id in delta.free.drain() {
            self.textures.remove(&id);
        }
    }

    /// Replaces the whole texture of the overlay's fonts.
    pub fn load_fonts(&mut self, image: ColorImage) {
        self.textures.insert(TextureId::default(), image);
    }

    /// Draws on black into a picture of `size` pixels; premultiplied colours are blended in their sRGB encoding.
    pub fn paint(&self, jobs: &[ClippedPrimitive], pixels_per_point: f32, size: [usize; 2]) -> ColorImage {
        let mut picture = ColorImage::filled(size, Color32::BLACK);
        for ClippedPrimitive { clip_rect, primitive } in jobs {
            let Primitive::Mesh(mesh) = primitive else { continue };
            let Some(texture) = self.textures.get(&mesh.texture_id) else { continue };
            let clip = (*clip_rect * pixels_per_point)
                .intersect(Rect::from_min_size(Pos2::ZERO, egui::vec2(size[0] as f32, size[1] as f32)));
            for corners in triangles(mesh, pixels_per_point) {
                fill(&mut picture, texture, clip, corners);
            }
        }
        picture
    }
}

fn patch(known: &mut ColorImage, [left, top]: [usize; 2], image: &ColorImage) {
    let width = known.size[0];
    for (row, line) in image.pixels.chunks_exact(image.size[0].max(1)).enumerate() {
        let start = (top + row) * width + left;
        if let Some(place) = known.pixels.get_mut(start..start + line.len()) {
            place.copy_from_slice(line);
        }
    }
}

/// The triangles of a mesh, with corners in pixels.
fn triangles(mesh: &Mesh, scale: f32) -> impl Iterator<Item = [Vertex; 3]> {
    mesh.indices.chunks_exact(3).filter_map(move |indices| {
        let corner = |index: u32| {
            let vertex = mesh.vertices.get(index as usize)?;
            Some(Vertex { pos: vertex.pos * scale, ..*vertex })
        };
        Some([corner(indices[0])?, corner(indices[1])?, corner(indices[2])?])
    })
}

/// Twice the signed area of the triangle `a`, `b`, `p`.
fn edge(a: Pos2, b: Pos2, p: Pos2) -> f32 {
    (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)
}

fn fill(picture: &mut ColorImage, texture: &ColorImage, clip: Rect, corners: [Vertex; 3]) {
    let [a, b, c] = corners.map(|corner| corner.pos);
    let area = edge(a, b, c);
    if area == 0.0 || !area.is_finite() {
        return;
    }
    let bounds = Rect::from_points(&[a, b, c]).intersect(clip);
    let columns = bounds.min.x.floor().max(0.0) as usize..bounds.max.x.ceil().max(0.0) as usize;
    for y in bounds.min.y.floor().max(0.0) as usize..bounds.max.y.ceil().max(0.0) as usize {
        for x in columns.clone() {
            let middle = egui::pos2(x as f32 + 0.5, y as f32 + 0.5);
            let weights = [edge(b, c, middle), edge(c, a, middle), edge(a, b, middle)].map(|w| w / area);
            if clip.contains(middle) && weights.iter().all(|weight| *weight >= 0.0) {
                let under = &mut picture[(x, y)];
                *under = over(colour(texture, &corners, weights), *under);
            }
        }
    }
}

/// The interpolated colour of a triangle times its texel, premultiplied.
fn colour(texture: &ColorImage, corners: &[Vertex; 3], weights: [f32; 3]) -> [f32; 4] {
    let mut at = egui::Vec2::ZERO;
    let mut colour = [0.0; 4];
    for (corner, weight) in corners.iter().zip(weights) {
        at += weight * corner.uv.to_vec2();
        for (sum, channel) in colour.iter_mut().zip(corner.color.to_array()) {
            *sum += weight * f32::from(channel);
        }
    }
    let texel = |share: f32, side: usize| ((share * side as f32) as usize).min(side.saturating_sub(1));
    let [width, height] = texture.size;
    let texel = texture.pixels.get(texel(at.y, height) * width + texel(at.x, width));
    let texel = texel.copied().unwrap_or(Color32::TRANSPARENT).to_array();
    std::array::from_fn(|channel| colour[channel] * f32::from(texel[channel]) / 255.0)
}

fn over(colour: [f32; 4], under: Color32) -> Color32 {
    let through = 1.0 - colour[3] / 255.0;
    let [red, green, blue, _] = under.to_array();
    let mixed = |above: f32, below: u8| (above + through * f32::from(below)).round().clamp(0.0, 255.0) as u8;
    Color32::from_rgb(mixed(colour[0], red), mixed(colour[1], green), mixed(colour[2], blue))
}

#[cfg(test)]
mod tests {
    use egui::{Context, RawInput, pos2, vec2};

    use super::*;

    fn painted(size: [usize; 2], draw: impl FnMut(&mut egui::Ui)) -> ColorImage {
        let screen = Rect::from_min_size(pos2(0.0, 0.0), vec2(size[0] as f32, size[1] as f32));
        let context = Context::default();
        let input = RawInput { screen_rect: Some(screen), ..RawInput::default() };
        let output = context.run_ui(input, draw);
        let mut canvas = Canvas::default();
        canvas.update(output.textures_delta);
        canvas.paint(&context.tessellate(output.shapes, 1.0), 1.0, size)
    }

    #[test]
    fn a_rectangle_fills_its_pixels_and_no_other() {
        let rect = Rect::from_min_max(pos2(10.0, 20.0), pos2(30.0, 25.0));
        let picture = painted([64, 48], |ui| {
            ui.ctx().debug_painter().rect_filled(rect, 0.0, Color32::from_rgb(10, 200, 30));
        });
        for (index, pixel) in picture.pixels.iter().enumerate() {
            let middle = pos2((index % 64) as f32 + 0.5, (index / 64) as f32 + 0.5);
            let expected =
                if rect.contains(middle) { Color32::from_rgb(10, 200, 30) } else { Color32::BLACK };
            // The border is anti-aliased.
            let rim = rect.expand(1.0).contains(middle) && !rect.shrink(1.0).contains(middle);
            assert!(rim || *pixel == expected, "{middle}: {pixel:?}");
        }
        assert_eq!(picture[(20, 22)], Color32::from_rgb(10, 200, 30));
    }

    #[test]
    fn text_is_there() {
        let picture = painted([200, 60], |ui| {
            ui.label(egui::RichText::new("no Vulkan").size(30.0).color(Color32::WHITE));
        });
        let bright = picture.pixels.iter().filter(|pixel| pixel.r() > 128).count();
        assert!((200..4000).contains(&bright), "{bright} bright pixels");
        let empty = painted([200, 60], |_| ());
        assert!(empty.pixels.iter().all(|pixel| pixel.r() < 64));
    }
}
