use super::*;

const BOUNDS: (Vec3, Vec3) = (Vec3::new(-2.0, 0.0, -1.0), Vec3::new(2.0, 3.0, 1.0));

fn look_at_camera(lens: Lens) -> Camera {
    let look_at =
        LookAt { eye: Vec3::new(3.0, 2.5, 6.0), target: Vec3::new(0.0, 1.0, 0.0), up: Vec3::Y, lens };
    look_at.camera().expect("a camera")
}

fn perspective() -> Camera {
    look_at_camera(Lens::Perspective { vertical_fov_degrees: 50.0 })
}

fn orthographic() -> Camera {
    look_at_camera(Lens::Orthographic { height: 4.0 })
}

fn shifted() -> Camera {
    let straight = perspective();
    Camera { forward: straight.forward + 0.3 * straight.right, ..straight }
}

fn settle(control: &mut CameraControl) {
    for _ in 0..600 {
        control.advance(Duration::from_millis(16));
    }
    assert!(!control.is_moving(), "must settle within 10 s");
}

/// All components of a camera.
fn numbers(camera: &Camera) -> [f32; 12] {
    let [o, r, u, f] = [camera.origin, camera.right, camera.up, camera.forward].map(|v| v.to_array());
    std::array::from_fn(|i| [o, r, u, f][i / 3][i % 3])
}

fn bits(camera: &Camera) -> ([u32; 12], bool) {
    (numbers(camera).map(f32::to_bits), camera.orthographic)
}

fn distance(a: &Camera, b: &Camera) -> f32 {
    let (a, b) = (numbers(a), numbers(b));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// The position at which a camera sees a point, in picture heights from the centre.
fn seen(camera: &Camera, point: DVec3) -> DVec2 {
    let way = point - camera.origin.as_dvec3();
    let (right, up) = (camera.right.as_dvec3(), camera.up.as_dvec3());
    let depth = if camera.orthographic { 1.0 } else { way.dot(camera.forward.as_dvec3()) };
    DVec2::new(way.dot(right) / right.length_squared(), way.dot(up) / up.length_squared()) / (2.0 * depth)
}

/// The point in the plane of the target that is seen at a position.
fn point_at(control: &CameraControl, at: DVec2) -> DVec3 {
    let orbit_state = &control.orbit_state;
    orbit_state.target + (orbit_state.right() * at.x + orbit_state.up() * at.y) * orbit_state.height()
}

#[test]
fn the_camera_is_the_scenes_own_until_it_is_moved() {
    for home in [perspective(), orthographic(), shifted()] {
        let mut control = CameraControl::new(home, BOUNDS);
        control.advance(Duration::from_secs(1));
        control.reset();
        control.advance(Duration::from_secs(1));
        assert_eq!((bits(&control.camera()), control.command_line(DVec3::ZERO)), (bits(&home), None));
        assert!(!control.is_moving());
    }
}

#[test]
fn the_first_motion_does_not_jump() {
    for home in [perspective(), orthographic()] {
        let mut control = CameraControl::new(home, BOUNDS);
        control.apply(Motion::Turn { by: Vec2::X * 1e-6 }, Navigation::Orbit);
        control.advance(Duration::from_millis(16));
        assert!(control.command_line(DVec3::ZERO).is_some());
        assert!(distance(&control.camera(), &home) < 2e-5, "{:?}", control.camera());
    }
}

#[test]
fn the_way_back_ends_at_the_very_camera() {
    for home in [perspective(), orthographic(), shifted()] {
        let mut control = CameraControl::new(home, BOUNDS);
        control.apply(Motion::Turn { by: Vec2::new(0.3, 0.1) }, Navigation::Orbit);
        control.apply(Motion::Dolly { by: 0.7, at: None }, Navigation::Orbit);
        settle(&mut control);
        assert!(distance(&control.camera(), &home) > 0.1);
        for camera in [orthographic(), home] {
            control.go_to(camera);
            settle(&mut control);
            assert_eq!((bits(&control.camera()), control.command_line(DVec3::ZERO)), (bits(&camera), None));
        }
    }
}

#[test]
fn a_hand_on_the_way_back_stops_it() {
    let mut control = CameraControl::new(perspective(), BOUNDS);
    control.apply(Motion::Pan { by: Vec2::X }, Navigation::Orbit);
    settle(&mut control);
    control.reset();
    control.advance(Duration::from_millis(50));
    control.apply(Motion::Turn { by: Vec2::X * 0.01 }, Navigation::Orbit);
    settle(&mut control);
    assert!(control.command_line(DVec3::ZERO).is_some());
    assert!(distance(&control.camera(), &perspective()) > 0.1);
}

/// Camera after one second of a script at `frames` frames per second.
fn after_a_second(frames: u32, script: impl Fn(f32, f32) -> Vec<Motion>, navigation: Navigation) -> Camera {
    let mut control = CameraControl::new(perspective(), BOUNDS);
    let seconds = 1.0 / frames as f32;
    for frame in 0..frames {
        for motion in script(frame as f32 * seconds, seconds) {
            control.apply(motion, navigation);
        }
        control.advance(Duration::from_secs_f32(seconds));
    }
    assert!(control.is_moving(), "the lag must not be over: it is what is compared");
    control.camera()
}

#[test]
fn the_frame_rate_changes_nothing() {
    type Script = fn(f32, f32) -> Vec<Motion>;
    let scripts: [(&str, Script, f32); 6] = [
        ("turn", |_, s| vec![Motion::Turn { by: Vec2::new(0.8, 0.05) * s }], 1e-5),
        ("pan", |_, s| vec![Motion::Pan { by: Vec2::new(0.3, -0.6) * s }], 1e-5),
        ("dolly", |_, s| vec![Motion::Dolly { by: 1.2 * s, at: Some(Vec2::new(0.4, 0.1)) }], 1e-5),
        (
            "stopped",
            |t, s| if t < 0.799 { vec![Motion::Turn { by: Vec2::new(2.0, 0.1) * s }] } else { vec![] },
            1e-5,
        ),
        ("flight", |_, _| vec![Motion::Fly { along: Vec3::new(0.2, -0.1, 0.9) }], 1e-5),
        (
            "all",
            |_, s| {
                vec![
                    Motion::Turn { by: Vec2::new(0.8, 0.05) * s },
                    Motion::Pan { by: Vec2::new(0.3, -0.6) * s },
                    Motion::Dolly { by: 0.5 * s, at: Some(Vec2::new(0.4, 0.1)) },
                    Motion::Fly { along: Vec3::new(0.2, -0.1, 0.9) },
                ]
            },
            5e-3,
        ),
    ];
    for (name, script, within) in scripts {
        for navigation in [Navigation::Orbit, Navigation::Fly] {
            let cameras = [10, 60, 240].map(|frames| after_a_second(frames, script, navigation));
            assert!(distance(&cameras[0], &perspective()) > 0.05, "{name} must move");
            for camera in &cameras[1..] {
                let apart = distance(camera, &cameras[0]);
                assert!(apart < within, "{name}, {navigation:?}: {apart} apart");
            }
        }
    }
}

#[test]
fn motion_ends_and_still_frames_are_equal() {
    let mut control = CameraControl::new(perspective(), BOUNDS);
    control.apply(Motion::Turn { by: Vec2::new(0.4, -0.2) }, Navigation::Fly);
    control.apply(Motion::Fly { along: Vec3::ONE }, Navigation::Fly);
    control.apply(Motion::Dolly { by: 0.3, at: None }, Navigation::Fly);
    control.focus(Vec3::new(1.0, 1.0, 0.5));
    settle(&mut control);
    let still = bits(&control.camera());
    for _ in 0..100 {
        control.advance(Duration::from_millis(7));
        assert_eq!(bits(&control.camera()), still);
    }
}

#[test]
fn what_is_not_finite_asks_for_nothing() {
    for strange in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut control = CameraControl::new(perspective(), BOUNDS);
        let by = Vec2::new(0.1, strange);
        for motion in [
            Motion::Turn { by },
            Motion::Pan { by },
            Motion::Dolly { by: strange, at: None },
            Motion::FlySpeed { by: strange },
            Motion::Fly { along: by.extend(0.5) },
        ] {
            control.apply(motion, Navigation::Fly);
        }
        control.focus(by.extend(0.5));
        assert!(
            !control.is_moving()
                && control.command_line(DVec3::ZERO).is_none()
                && control.speed_exponent == 0.0,
            "{strange}"
        );
    }
}

#[test]
fn no_time_loses_no_motion() {
    let turned = |first: u64| {
        let mut control = CameraControl::new(perspective(), BOUNDS);
        control.apply(Motion::Turn { by: Vec2::new(0.4, -0.2) }, Navigation::Orbit);
        control.advance(Duration::from_millis(first));
        settle(&mut control);
        control.camera()
    };
    assert!(distance(&turned(0), &turned(16)) < 1e-6);
}

#[test]
fn the_orbit_keeps_its_distance_and_follows_the_hand() {
    let mut control = CameraControl::new(perspective(), BOUNDS);
    let (target, far) = (control.orbit_state.target, control.orbit_state.distance);
    // A point in front of the target.
    let front = target - control.orbit_state.forward() * 0.1;
    control.apply(Motion::Turn { by: Vec2::new(0.05, 0.05) }, Navigation::Orbit);
    settle(&mut control);
    let camera = control.camera();
    assert!(((camera.origin.as_dvec3() - target).length() - far).abs() < 1e-5);
    assert!(seen(&camera, target).length() < 1e-6, "the target stays in the middle");
    let front = seen(&camera, front);
    assert!(front.x > 1e-3 && front.y > 1e-3, "what is near must follow the hand: {front}");
}

#[test]
fn what_a_flying_eye_looks_at_follows_the_hand() {
    let mut control = CameraControl::new(perspective(), BOUNDS);
    let (eye, far) =
        (perspective().origin, control.orbit_state.target + control.orbit_state.forward() * 100.0);
    control.apply(Motion::Turn { by: Vec2::new(0.05, 0.05) }, Navigation::Fly);
    settle(&mut control);
    assert!((control.camera().origin - eye).length() < 1e-5, "the eye stays");
    let far = seen(&control.camera(), far);
    assert!((far - DVec2::splat(0.05)).length() < 0.01, "{far}");
}

#[test]
fn no_turn_goes_over_the_vertical() {
    for navigation in [Navigation::Orbit, Navigation::Fly] {
        for by in [-9.0, 9.0] {
            let mut control = CameraControl::new(perspective(), BOUNDS);
            control.apply(Motion::Turn { by: Vec2::Y * by }, navigation);
            settle(&mut control);
            let camera = control.camera();
            assert!(camera.forward.y.abs() > 0.999, "{by}");
            assert!(camera.up.y > 0.0, "upside down after {by}");
        }
    }
}

#[test]
fn what_is_under_the_pointer_stays_under_it() {
    for home in [perspective(), orthographic()] {
        let (from, by) = (DVec2::new(-0.3, 0.1), DVec2::new(0.25, -0.35));
        let mut control = CameraControl::new(home, BOUNDS);
        let point = point_at(&control, from);
        assert!((seen(&home, point) - from).length() < 1e-5);
        control.apply(Motion::Pan { by: by.as_vec2() }, Navigation::Orbit);
        settle(&mut control);
        assert!((seen(&control.camera(), point) - (from + by)).length() < 1e-5, "panned");

        let mut control = CameraControl::new(home, BOUNDS);
        control.apply(Motion::Dolly { by: 1.0, at: Some(from.as_vec2()) }, Navigation::Orbit);
        let before = control.orbit_state.height();
        while control.is_moving() {
            control.advance(Duration::from_millis(16));
            assert!((seen(&control.camera(), point) - from).length() < 1e-5, "on the way of a dolly");
        }
        let larger = before / control.orbit_state.height();
        assert!((larger - std::f64::consts::E).abs() < 1e-4, "{larger}");
    }
}

#[test]
fn a_dolly_never_goes_through_the_target_nor_out_of_the_scene() {
    for (by, bound) in [(100.0, 4.0 * 1e-4), (-100.0, 4.0 * 1e3)] {
        let mut control = CameraControl::new(perspective(), BOUNDS);
        let forward = control.orbit_state.forward();
        control.apply(Motion::Dolly { by, at: None }, Navigation::Orbit);
        settle(&mut control);
        assert!(
            (control.orbit_state.distance / bound - 1.0).abs() < 1e-9,
            "{}",
            control.orbit_state.distance
        );
        assert!((control.orbit_state.forward() - forward).length() < 1e-9);
    }
}

#[test]
fn focus_brings_a_point_to_the_middle_without_turning_or_coming_nearer() {
    for home in [perspective(), orthographic()] {
        let mut control = CameraControl::new(home, BOUNDS);
        let point = Vec3::new(1.2, 0.4, 0.9);
        let depth = |camera: &Camera| (point - camera.origin).dot(camera.forward);
        control.focus(point);
        assert!(distance(&control.camera(), &home) < 1e-5, "must not jump");
        settle(&mut control);
        let camera = control.camera();
        assert!(seen(&camera, point.as_dvec3()).length() < 1e-6);
        assert!((camera.forward - home.forward).length() < 1e-6);
        assert!((depth(&camera) - depth(&home)).abs() < 1e-5);
        // The orbit rotates around the point.
        control.apply(Motion::Turn { by: Vec2::new(0.7, 0.1) }, Navigation::Orbit);
        settle(&mut control);
        assert!(seen(&control.camera(), point.as_dvec3()).length() < 1e-6);
    }
}

#[test]
fn flight_is_measured_by_the_scene() {
    let fly = |bounds, speed_exponent| {
        let mut control = CameraControl::new(perspective(), bounds);
        control.apply(Motion::FlySpeed { by: speed_exponent }, Navigation::Fly);
        for _ in 0..100 {
            control.apply(Motion::Fly { along: Vec3::Z }, Navigation::Fly);
            control.advance(Duration::from_millis(10));
        }
        settle(&mut control);
        (control.camera().origin - perspective().origin).dot(perspective().forward)
    };
    // The distance lost to lag at the start is gained at the end.
    assert!((fly(BOUNDS, 0.0) - 1.0).abs() < 1e-3, "a quarter of four units: {}", fly(BOUNDS, 0.0));
    assert!((fly((BOUNDS.0 * 10.0, BOUNDS.1 * 10.0), 0.0) - 10.0).abs() < 1e-2);
    assert!((fly(BOUNDS, 2_f32.ln()) - 2.0).abs() < 1e-3);
}

/// Parses the options as the command line does: text, `f32`, pose.
fn parse(options: &str) -> LookAt {
    let value =
        |name: &str| options.split(' ').find_map(|option| option.strip_prefix(name)?.strip_prefix('='));
    let number = |text: &str| text.parse::<f32>().expect("a number");
    let point = |name: &str| {
        let numbers: Vec<_> = value(name).expect("an option").split(',').map(number).collect();
        Vec3::new(numbers[0], numbers[1], numbers[2])
    };
    let lens = value("--fov").map_or_else(
        || Lens::Orthographic { height: number(value("--ortho").expect("a lens")) },
        |fov| Lens::Perspective { vertical_fov_degrees: number(fov) },
    );
    LookAt { eye: point("--eye"), target: point("--target"), up: point("--up"), lens }
}

/// Marsaglia's xorshift generator, which gives the same motions on every platform.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn number(&mut self) -> f32 {
        let strange =
            [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE, -1e30, 1e-30, -0.0];
        match self.bits() % 40 {
            pick @ 0..8 => strange[pick as usize],
            _ => (self.bits() % 20_001) as f32 / 10_000.0 - 1.0,
        }
    }

    fn motion(&mut self) -> Motion {
        let by = Vec2::new(self.number(), self.number());
        match self.bits() % 6 {
            0 => Motion::Turn { by },
            1 => Motion::Pan { by },
            2 => Motion::Dolly { by: by.x, at: Some(Vec2::new(by.y, self.number())) },
            3 => Motion::Fly { along: by.extend(self.number()) },
            4 => Motion::FlySpeed { by: by.x },
            _ => Motion::Focus { at: by },
        }
    }
}

#[test]
fn no_motion_makes_a_camera_that_cannot_be_said() {
    let places = [
        BOUNDS,
        (Vec3::ZERO, Vec3::ZERO),
        (Vec3::splat(f32::INFINITY), Vec3::splat(f32::NEG_INFINITY)),
        (Vec3::splat(f32::NAN), Vec3::ONE),
        (Vec3::splat(-3e38), Vec3::splat(3e38)),
        (Vec3::splat(1e6), Vec3::splat(1e6 + 0.5)),
        (Vec3::splat(-1e-30), Vec3::splat(1e-30)),
    ];
    for (seed, bounds) in (1..).zip(places) {
        let mut random = Random(seed * 0x9E37_79B9_7F4A_7C15);
        let wide = Camera { right: Vec3::X * 1e9, up: Vec3::Y * 1e9, ..perspective() };
        let vast = Camera { orthographic: true, ..wide };
        let framing = Camera::framing(bounds.0, bounds.1);
        for home in [perspective(), orthographic(), shifted(), wide, vast, framing] {
            let mut control = CameraControl::new(home, bounds);
            for step in 0..500 {
                let navigation =
                    if random.bits().is_multiple_of(2) { Navigation::Orbit } else { Navigation::Fly };
                control.apply(random.motion(), navigation);
                match random.bits() % 50 {
                    0 => control.reset(),
                    1 => control.go_to(orthographic()),
                    2..5 => control.focus(Vec3::new(random.number(), random.number(), random.number())),
                    _ => {}
                }
                control.advance(Duration::from_millis(random.bits() % 40));
                let Some(options) = control.command_line(DVec3::ZERO) else { continue };
                let said = parse(&options).camera();
                let said = said.unwrap_or_else(|error| panic!("{bounds:?}, step {step}: {error}: {options}"));
                assert_eq!(bits(&said), bits(&control.camera()), "{options}");
                assert!(numbers(&said).iter().all(|number| number.is_finite()), "{options}");
            }
            settle(&mut control);
        }
    }
}
