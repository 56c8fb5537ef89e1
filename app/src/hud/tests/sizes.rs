//! The overlay in windows of all sizes, from empty to the largest.

use egui::epaint::{MarginF32, Primitive};
use egui::{Rect, Role, SafeAreaInsets, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

use super::*;
use crate::{Show, TEXT_SCALES};

const SIZES: [[f32; 2]; 8] = [
    [1.0, 1.0],
    [16.0, 4000.0],
    [44.0, 44.0],
    [320.0, 480.0],
    [900.0, 60.0],
    [412.0, 915.0],
    [2560.0, 1440.0],
    [3840.0, 2160.0],
];

#[test]
fn a_window_that_is_too_small_to_read_shows_the_picture_alone() {
    for (width, buttons) in [(43.0, 0), (44.0, 1)] {
        let harness = shown(fixture(Overlay::Brief), [width, 400.0]);
        assert_eq!(harness.query_all_by_role(Role::Button).count(), buttons, "{width}");
    }
}

/// Asserts that all vertices have finite positions.
fn assert_finite(harness: &Harness<'_, HudFixture>) {
    let output = harness.output();
    let primitives = harness.ctx.tessellate(output.shapes.clone(), output.pixels_per_point);
    for primitive in primitives {
        let Primitive::Mesh(mesh) = primitive.primitive else { continue };
        assert!(mesh.vertices.iter().all(|vertex| vertex.pos.is_finite()), "a vertex is nowhere");
    }
}

fn everything(overlay: Overlay, text_scale: f32) -> HudFixture {
    let mut fixture = fixture(overlay);
    fixture.choices.text_scale = text_scale;
    fixture.choices.split = Some(0.3);
    fixture.choices.show = Show::Origin;
    fixture.touch = text_scale > 1.0;
    fixture.hud_state.busy = Some(busy([3, 7]));
    fixture.hud_state.notice = Some("wrote glimpse.png".to_owned());
    fixture
}

#[test]
fn every_overlay_fits_every_window() {
    for size in SIZES {
        for overlay in [Overlay::Hidden, Overlay::Brief, Overlay::Full] {
            for text_scale in TEXT_SCALES {
                assert_finite(&shown(everything(overlay, text_scale), size));
            }
        }
    }
}

#[test]
fn every_page_fits_every_window() {
    for size in SIZES {
        let mut fixture = everything(Overlay::Full, 2.0);
        fixture.choices.help = true;
        assert_finite(&shown(fixture, size));
        let mut fixture = everything(Overlay::Brief, 0.75);
        fixture.hud_state.problem = Some("line\n".repeat(200));
        assert_finite(&shown(fixture, size));
    }
}

#[test]
fn nothing_is_drawn_wrong_before_the_first_frame_or_of_numbers_that_are_none() {
    for overlay in [Overlay::Brief, Overlay::Full] {
        let mut empty = fixture(overlay);
        empty.hud_state = HudState { busy: Some(busy([0, 0])), ..HudState::default() };
        empty.scenes.clear();
        assert_finite(&shown(empty, [800.0, 3000.0]));
        let mut strange = fixture(overlay);
        strange.hud_state.frame_ms = [f32::NAN, f32::INFINITY, -1.0, 0.0].into();
        strange.hud_state.passes[0].ms = f64::NAN;
        strange.hud_state.counts = Some(Counts::default());
        strange.hud_state.psnr_db = Some(f64::INFINITY);
        strange.hud_state.busy = Some(Busy { seconds: f64::NAN, ..busy([9, 3]) });
        strange.choices.split = Some(7.0);
        assert_finite(&shown(strange, [800.0, 3000.0]));
    }
}

#[test]
fn fingers_have_large_targets() {
    let mut fixture = fixture(Overlay::Full);
    fixture.touch = true;
    fixture.choices.text_scale = TEXT_SCALES[0];
    let harness = shown(fixture, [412.0, 6000.0]);
    let mut seen = 0;
    for role in [Role::Button, Role::Slider, Role::SpinButton, Role::CheckBox, Role::DisclosureTriangle] {
        for node in harness.query_all_by_role(role) {
            let name = node.accesskit_node().label();
            assert!(node.rect().height() >= 43.99, "{name:?}: {:?}", node.rect());
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen}");
}

#[test]
fn the_overlay_keeps_clear_of_the_edges_that_the_device_covers() {
    let covered = MarginF32 { left: 30.0, right: 20.0, top: 50.0, bottom: 40.0 };
    let safe = Rect::from_min_max(pos2(30.0, 50.0), pos2(780.0, 960.0));
    for (overlay, name) in [(Overlay::Brief, "menu"), (Overlay::Full, "close overlay")] {
        let mut harness = shown(fixture(overlay), [800.0, 1000.0]);
        harness.input_mut().safe_area_insets = Some(SafeAreaInsets(covered));
        harness.run_steps(3);
        let rect = harness.get_by_label(name).rect();
        assert!(safe.shrink(7.0).contains_rect(rect), "{name}: {rect:?}");
    }
}

#[test]
fn the_method_is_seen_without_scrolling() {
    for size in [[1280.0, 720.0], [800.0, 600.0], [1920.0, 1080.0]] {
        let harness = shown(fixture(Overlay::Full), size);
        for choice in glimpse::Method::CHOICES {
            let rect = harness.get_by_label(&format!("method: {}", choice.name)).rect();
            assert!(rect.bottom() <= size[1] - 16.0, "{size:?}, {}: {rect:?}", choice.name);
        }
    }
}

#[test]
fn the_picture_has_the_room_that_the_panel_leaves() {
    for size in [[1280.0, 720.0], [800.0, 600.0], [3840.0, 2160.0]] {
        let harness = shown(fixture(Overlay::Full), size);
        let room = picture_room(&harness.ctx, &harness.state().choices);
        // The heading is inside of the panel's border and margin.
        let panel = harness.get_by_label("Glimpse").rect().left() - 13.0;
        assert_eq!(room, Rect::from_min_max(pos2(0.0, 0.0), pos2(panel - 8.0, size[1])), "{size:?}");
    }
    for (overlay, size) in [(Overlay::Brief, [1280.0, 720.0]), (Overlay::Full, [412.0, 915.0])] {
        let harness = shown(fixture(overlay), size);
        let room = picture_room(&harness.ctx, &harness.state().choices);
        assert_eq!(room, Rect::from_min_size(pos2(0.0, 0.0), size.into()), "{overlay:?}");
    }
}

#[test]
fn the_line_drops_what_does_not_fit() {
    let wide = shown(fixture(Overlay::Brief), [1000.0, 600.0]);
    wide.get_by_label_contains("960x540 (50 %)  adaptive");
    let narrow = shown(fixture(Overlay::Brief), [250.0, 600.0]);
    let line = narrow.get_by_label_contains("fps").rect();
    assert!(line.right() <= 250.0 && line.size().x > vec2(80.0, 0.0).x, "{line:?}");
    assert!(narrow.query_by_label_contains("adaptive").is_none());
}

#[test]
fn nothing_sticks_out_of_the_panel() {
    for (size, text_scale) in [([1280.0, 6000.0], 1.0), ([320.0, 9000.0], 1.0), ([412.0, 12_000.0], 2.0)] {
        let harness = shown(everything(Overlay::Full, text_scale), size);
        let right = size[0] - 8.0;
        let left = harness.get_by_label("Glimpse").rect().left();
        for role in [Role::Button, Role::Slider, Role::SpinButton, Role::CheckBox, Role::Label] {
            for node in harness.query_all_by_role(role).filter(|node| node.rect().left() >= left) {
                let name = (node.accesskit_node().label(), node.value());
                assert!(node.rect().right() <= right, "{size:?}, {name:?}: {:?}", node.rect());
            }
        }
    }
}

#[test]
fn the_line_stands_still_while_its_numbers_change() {
    let width = |ms: f32| {
        let mut fixture = fixture(Overlay::Brief);
        fixture.hud_state.frame_ms = [ms].into();
        shown(fixture, [1000.0, 600.0]).get_by_label_contains("fps").rect().width()
    };
    assert_eq!([width(1.0), width(16.7), width(130.0)], [width(8000.0); 3]);
}

#[test]
fn the_progress_of_a_frame_is_a_line_along_the_picture() {
    let rendered = |overlay, share| {
        let mut fixture = fixture(overlay);
        fixture.hud_state.rendered = share;
        shown(fixture, [1280.0, 720.0])
    };
    let harness = rendered(Overlay::Full, Some(0.25));
    let line = harness.get_by_label("rendered 25 %").rect();
    let room = picture_room(&harness.ctx, &harness.state().choices);
    assert!((line.width() - room.width()).abs() < 1.0 && line.bottom() <= 720.0, "{line:?} {room:?}");
    for (overlay, share) in
        [(Overlay::Hidden, Some(0.25)), (Overlay::Brief, None), (Overlay::Brief, Some(f32::NAN))]
    {
        let harness = rendered(overlay, share);
        assert!(harness.query_by_label_contains("rendered").is_none(), "{overlay:?} {share:?}");
    }
}
