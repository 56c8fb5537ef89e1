//! Tests of the overlay above a picture, with simulated input and without drawing.

mod choices;
mod files;
mod input;
mod sizes;

use egui::{Rect, Response, Sense, Vec2};
use egui_kittest::Harness;
use glimpse::{Counts, Memory, PassTime, Rays, Samples, Tracing};

use super::{Hud, UserRequest, picture_room};
use crate::{Busy, Choices, HudState, Overlay};

/// Input of the overlay, and the requests that it returned.
struct HudFixture {
    choices: Choices,
    hud_state: HudState,
    scenes: Vec<String>,
    touch: bool,
    user_requests: Vec<UserRequest>,
    /// Number of clicks and drags that reached the picture.
    picture: u32,
}

fn fixture(overlay: Overlay) -> HudFixture {
    HudFixture {
        choices: Choices { overlay, ..Choices::default() },
        hud_state: hud_state(),
        scenes: crate::scenes().chain(["/tmp/kitchen.glb".to_owned()]).collect(),
        touch: false,
        user_requests: Vec::new(),
        picture: 0,
    }
}

fn shown(fixture: HudFixture, size: impl Into<Vec2>) -> Harness<'static, HudFixture> {
    let mut harness = Harness::builder().with_size(size).with_max_steps(20).build_ui_state(frame, fixture);
    // Areas find their size in the first pass.
    harness.run_steps(3);
    harness
}

fn frame(ui: &mut egui::Ui, fixture: &mut HudFixture) {
    let picture: Response =
        ui.interact(Rect::EVERYTHING, ui.scope_id().with("picture"), Sense::click_and_drag());
    fixture.picture += u32::from(picture.clicked() || picture.dragged());
    let picture = picture_room(ui.ctx(), &fixture.choices);
    let hud = Hud {
        choices: &mut fixture.choices,
        hud_state: &fixture.hud_state,
        scenes: &fixture.scenes,
        picture,
        touch: fixture.touch,
    };
    fixture.user_requests.extend(hud.show(ui.ctx()));
}

/// A state with a value in every field.
fn hud_state() -> HudState {
    let mut hud_state = HudState {
        scene: "builtin:room".to_owned(),
        primitives: 1_414_172,
        cameras: vec!["main".to_owned(), String::new()],
        warnings: vec![
            "material `glass` of mesh 3: the extension KHR_materials_volume is left out".to_owned(),
        ],
        not_shown: vec!["KHR_materials_sheen, once: material 3 `cloth`".to_owned()],
        features: vec!["textures", "reflection"],
        left_out: vec!["refraction"],
        adapter: "llvmpipe (LLVM 15.0.7, 256 bits), Mesa 25.0.7".to_owned(),
        passes: ["base", "similarity_a1", "trace_a1"]
            .map(|name| PassTime { name, tracing: Tracing::of_pass(name).unwrap(), ms: 3.25 })
            .to_vec(),
        size: [960, 540],
        view: [1920, 1080],
        counts: Some(Counts {
            rays: Rays {
                primary: 160_000,
                shadow: 300_000,
                reflection: 20_000,
                total: 480_000,
                ..Rays::default()
            },
            samples: Samples { total: 518_400, base: 129_600, interpolated: 358_400, ..Samples::default() },
            ..Counts::default()
        }),
        psnr_db: Some(41.25),
        memory: Memory { scene: 1 << 24, bvh: 1 << 23, targets: 1 << 25, total: 57 << 20 },
        legend: "base white (3), interpolated dark blue (4)".to_owned(),
        governor: "holds 33.3 ms at a scale of 0.5".to_owned(),
        ..HudState::default()
    };
    (0..300).for_each(|frame| hud_state.push_frame(20.0 + (frame % 30) as f32));
    hud_state
}

fn busy(step: [u32; 2]) -> Busy {
    Busy { what: "loading a scene with a rather long name.glb".to_owned(), seconds: 3.5, unit: "step", step }
}
