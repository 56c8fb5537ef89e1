//! Sends synthetic input through a real egui context without a window.

use egui::{
    Context, Modifiers, MouseWheelSource, MouseWheelUnit, RawInput, Rect, Sense, TouchDeviceId, TouchId,
    TouchPhase, pos2, vec2,
};

use super::*;
use crate::input_queue::InputQueue;

/// A simulated user of a view `height` points high and twice as wide, at 60 frames per second.
struct Hand {
    context: Context,
    gestures: Gestures,
    navigation: Navigation,
    height: f32,
    scale: f32,
    /// Share of the screen's width that the view covers, from the left.
    part: f32,
    frame: u32,
    modifiers: Modifiers,
}

const FRAME: Duration = Duration::from_micros(16_667);

impl Hand {
    fn new(height: f32, scale: f32, navigation: Navigation) -> Self {
        let (context, gestures) = (Context::default(), Gestures::default());
        let mut hand = Self {
            context,
            gestures,
            navigation,
            height,
            scale,
            part: 1.0,
            frame: 0,
            modifiers: Modifiers::NONE,
        };
        // egui knows the view's rectangle from its second frame on.
        hand.frame([]);
        hand.frame([]);
        hand
    }

    fn frame(&mut self, events: impl IntoIterator<Item = Event>) -> Vec<Motion> {
        self.frame += 1;
        let mut input = RawInput {
            screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(2.0 * self.height, self.height))),
            time: Some(f64::from(self.frame) * FRAME.as_secs_f64()),
            predicted_dt: FRAME.as_secs_f32(),
            events: std::iter::once(Event::ModifiersChanged(self.modifiers)).chain(events).collect(),
            ..RawInput::default()
        };
        input.viewports.entry(input.viewport_id).or_default().native_pixels_per_point = Some(self.scale);
        let mut motions = Vec::new();
        let (gestures, navigation, part) = (&mut self.gestures, self.navigation, self.part);
        let _ = self.context.run_ui(input, |ui| {
            let mut place = ui.ctx().content_rect();
            place.set_width(part * place.width());
            let view = ui.interact(place, egui::Id::unique("view"), Sense::click_and_drag());
            motions = gestures.read(&view, view.rect, navigation, FRAME);
        });
        motions
    }

    /// All updates that follow from events that arrive together.
    fn frames(&mut self, events: Vec<Event>) -> Vec<Motion> {
        let mut queue = InputQueue::default();
        let mut motions = Vec::new();
        let mut events = Some(events);
        while events.is_some() || queue.is_waiting() {
            let next = queue.next(events.take().unwrap_or_default());
            motions.extend(self.frame(next));
        }
        motions
    }

    /// Converts view heights from the centre into a position in points.
    fn at(&self, x: f32, y: f32) -> Pos2 {
        pos2((1.0 + x) * self.height, (0.5 - y) * self.height)
    }

    fn moved(&self, x: f32, y: f32) -> Event {
        Event::PointerMoved(self.at(x, y))
    }

    fn button(&self, button: PointerButton, pressed: bool, x: f32, y: f32) -> Event {
        Event::PointerButton { pos: self.at(x, y), button, pressed, modifiers: self.modifiers }
    }

    fn touch(&self, finger: u64, phase: TouchPhase, x: f32, y: f32) -> Event {
        Event::Touch {
            device_id: TouchDeviceId(0),
            id: TouchId::from(finger),
            phase,
            pos: self.at(x, y),
            force: None,
        }
    }

    fn key(&self, key: Key, pressed: bool) -> Event {
        Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: self.modifiers }
    }

    fn wheel(&self, lines: f32) -> Event {
        Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: vec2(0.0, lines),
            phase: TouchPhase::Move,
            source: MouseWheelSource::Wheel,
            modifiers: self.modifiers,
        }
    }

    /// Drags from the centre by view heights over ten frames, and releases.
    fn drag(&mut self, button: PointerButton, x: f32, y: f32) -> Vec<Motion> {
        let mut motions = self.frame([self.moved(0.0, 0.0), self.button(button, true, 0.0, 0.0)]);
        for i in 1..=10 {
            let share = i as f32 / 10.0;
            motions.extend(self.frame([self.moved(share * x, share * y)]));
        }
        motions.extend(self.frame([self.button(button, false, x, y)]));
        motions.extend(self.frame([]));
        motions
    }
}

/// The sums of all rotations, pans and dollies.
fn sum(motions: &[Motion]) -> (Vec2, Vec2, f32) {
    let mut sum = (Vec2::ZERO, Vec2::ZERO, 0.0);
    for motion in motions {
        match *motion {
            Motion::Turn { by } => sum.0 += by,
            Motion::Pan { by } => sum.1 += by,
            Motion::Dolly { by, .. } => sum.2 += by,
            _ => {}
        }
    }
    sum
}

fn near(found: Vec2, expected: Vec2, within: f32) {
    assert!((found - expected).length() <= within, "found {found}, expected {expected}");
}

#[test]
fn a_drag_means_the_same_on_every_screen() {
    for (height, scale) in [(400.0, 1.0), (1440.0, 1.0), (800.0, 3.5)] {
        for (button, shift, pans) in [
            (PointerButton::Primary, false, false),
            (PointerButton::Primary, true, true),
            (PointerButton::Secondary, false, true),
            (PointerButton::Middle, false, true),
        ] {
            let mut hand = Hand::new(height, scale, Navigation::Orbit);
            hand.modifiers.shift = shift;
            let (turned, panned, dollied) = sum(&hand.drag(button, 0.4, 0.2));
            let (dragged, other) = if pans { (panned, turned) } else { (turned, panned) };
            near(dragged, Vec2::new(0.4, 0.2), 1e-4);
            assert_eq!((other, dollied), (Vec2::ZERO, 0.0));
        }
    }
}

#[test]
fn a_gesture_between_two_updates_is_the_same_motion() {
    let press = |hand: &Hand, pressed, x| hand.button(PointerButton::Primary, pressed, x, 0.0);
    let mut slow = Hand::new(400.0, 1.0, Navigation::Orbit);
    let expected = slow.drag(PointerButton::Primary, 0.3, 0.0);
    let mut hand = Hand::new(400.0, 1.0, Navigation::Orbit);
    let events = vec![
        hand.moved(0.0, 0.0),
        press(&hand, true, 0.0),
        hand.moved(0.1, 0.0),
        hand.moved(0.3, 0.0),
        press(&hand, false, 0.3),
    ];
    assert_eq!(hand.frame(events.clone()), [], "egui alone loses it");
    let motions = hand.frames(events);
    near(sum(&motions).0, sum(&expected).0, 1e-4);

    let mut hand = Hand::new(400.0, 1.0, Navigation::Orbit);
    let pair = |hand: &Hand, phase, apart: f32| {
        [hand.touch(0, phase, -apart, 0.0), hand.touch(1, phase, apart, 0.0)]
    };
    let events =
        [(TouchPhase::Start, 0.1), (TouchPhase::Move, 0.2), (TouchPhase::Move, 0.3), (TouchPhase::End, 0.3)]
            .map(|(phase, apart)| pair(&hand, phase, apart));
    hand.frame([hand.moved(0.0, 0.0)]);
    let (_, _, dolly) = sum(&hand.frames(events.concat()));
    assert!((dolly - 3_f32.ln()).abs() < 1e-3, "{dolly}");
}

#[test]
fn the_wheel_goes_nearer_to_the_pointer_and_flies_faster() {
    for (ctrl, navigation) in [(false, Navigation::Orbit), (true, Navigation::Orbit), (true, Navigation::Fly)]
    {
        let mut hand = Hand::new(600.0, 1.0, navigation);
        hand.modifiers.ctrl = ctrl;
        hand.modifiers.command = ctrl;
        hand.frame([hand.moved(0.3, -0.1)]);
        let mut motions = hand.frame([hand.wheel(2.0)]);
        for _ in 0..60 {
            motions.extend(hand.frame([]));
        }
        let (turned, panned, dollied) = sum(&motions);
        assert_eq!((turned, panned), (Vec2::ZERO, Vec2::ZERO));
        assert!((dollied - 0.4).abs() < 0.01, "two notches are {dollied}");
        for motion in motions {
            let Motion::Dolly { at: Some(at), .. } = motion else { panic!("{motion:?}") };
            near(at, Vec2::new(0.3, -0.1), 1e-5);
        }
    }
    let mut hand = Hand::new(600.0, 1.0, Navigation::Fly);
    hand.frame([hand.moved(0.0, 0.0)]);
    let motions = hand.frame([hand.wheel(2.0)]);
    assert!(matches!(motions[..], [Motion::FlySpeed { by }] if by > 0.0), "{motions:?}");
}

#[test]
fn a_pinch_on_a_trackpad_dollies() {
    let mut hand = Hand::new(600.0, 1.0, Navigation::Orbit);
    hand.frame([hand.moved(0.1, 0.2)]);
    let motions = hand.frame([Event::Zoom(1.5)]);
    let [Motion::Dolly { by, at: Some(at) }] = motions[..] else { panic!("{motions:?}") };
    assert!((by - 1.5_f32.ln()).abs() < 1e-6);
    near(at, Vec2::new(0.1, 0.2), 1e-5);
}

/// The first finger is reported as the pointer too, as winit does.
#[test]
fn two_fingers_pan_and_dolly_and_never_turn() {
    use TouchPhase::{End, Move, Start};
    let mut hand = Hand::new(800.0, 2.0, Navigation::Orbit);
    let primary = PointerButton::Primary;
    let first =
        [hand.touch(1, Start, -0.1, 0.0), hand.moved(-0.1, 0.0), hand.button(primary, true, -0.1, 0.0)];
    assert_eq!(hand.frame(first), []);
    let mut alone = Vec::new();
    for i in 1..=5 {
        let x = -0.1 - 0.02 * i as f32;
        alone.extend(hand.frame([hand.touch(1, Move, x, 0.0), hand.moved(x, 0.0)]));
    }
    near(sum(&alone).0, Vec2::new(-0.1, 0.0), 1e-4);
    // The second finger comes down in the same frame in which the first moves.
    let second = [hand.touch(2, Start, 0.2, 0.0), hand.touch(1, Move, -0.25, 0.0), hand.moved(-0.25, 0.0)];
    assert_eq!(hand.frame(second), [], "the second finger must not move anything");
    let mut both = Vec::new();
    for i in 1..=8 {
        // The distance of the fingers grows from 0.45 to 0.9, and both move up by 0.16.
        let share = i as f32 / 8.0;
        let (y, left, right) = (0.16 * share, -0.25 - 0.225 * share, 0.2 + 0.225 * share);
        let events = [hand.touch(1, Move, left, y), hand.touch(2, Move, right, y), hand.moved(left, y)];
        both.extend(hand.frame(events));
    }
    let (turned, panned, dollied) = sum(&both);
    assert_eq!(turned, Vec2::ZERO);
    near(panned, Vec2::new(0.0, 0.16), 1e-4);
    assert!((dollied - 2_f32.ln()).abs() < 1e-4, "{dollied}");
    // One finger is lifted: the other moves nothing until it is lifted too.
    let mut leaving = hand.frame([hand.touch(2, End, 0.425, 0.16)]);
    for i in 1..=5 {
        let x = -0.475 + 0.05 * i as f32;
        leaving.extend(hand.frame([hand.touch(1, Move, x, 0.16), hand.moved(x, 0.16)]));
    }
    let last =
        [hand.touch(1, End, -0.225, 0.16), hand.button(primary, false, -0.225, 0.16), Event::PointerGone];
    leaving.extend(hand.frame(last));
    assert_eq!(leaving, [], "what is left of a pinch must not move anything");
    // The next touch rotates again.
    hand.frame([hand.touch(3, Start, 0.0, 0.0), hand.moved(0.0, 0.0), hand.button(primary, true, 0.0, 0.0)]);
    let again = hand.frame([hand.touch(3, Move, 0.1, 0.0), hand.moved(0.1, 0.0)]);
    near(sum(&again).0, Vec2::new(0.1, 0.0), 1e-4);
}

#[test]
fn a_double_tap_focuses_and_a_single_one_does_nothing() {
    let mut hand = Hand::new(600.0, 1.0, Navigation::Orbit);
    let mut tap = || {
        let primary = PointerButton::Primary;
        let mut motions = hand.frame([hand.moved(0.2, 0.1), hand.button(primary, true, 0.2, 0.1)]);
        motions.extend(hand.frame([hand.button(primary, false, 0.2, 0.1)]));
        motions
    };
    assert_eq!(tap(), []);
    let [Motion::Focus { at }] = tap()[..] else { panic!("no focus") };
    near(at, Vec2::new(0.2, 0.1), 1e-5);
}

#[test]
fn everything_is_in_reach_of_the_keyboard() {
    use Navigation::{Fly, Orbit};
    let drag = KEY_DRAG * FRAME.as_secs_f32();
    let dolly = KEY_DOLLY * FRAME.as_secs_f32();
    let left = Vec2::X * drag;
    let cases = [
        (Orbit, Key::ArrowLeft, false, Motion::Turn { by: left }),
        (Orbit, Key::ArrowUp, false, Motion::Turn { by: Vec2::Y * -drag }),
        (Orbit, Key::ArrowLeft, true, Motion::Pan { by: left }),
        (Orbit, Key::PageUp, false, Motion::Dolly { by: dolly, at: None }),
        (Orbit, Key::Minus, false, Motion::Dolly { by: -dolly, at: None }),
        (Fly, Key::ArrowLeft, false, Motion::Turn { by: left }),
        (Fly, Key::PageUp, false, Motion::FlySpeed { by: dolly }),
        (Fly, Key::W, false, Motion::Fly { along: Vec3::Z * STROLL }),
        (Fly, Key::S, true, Motion::Fly { along: Vec3::NEG_Z }),
        (Fly, Key::A, true, Motion::Fly { along: Vec3::NEG_X }),
        (Fly, Key::D, true, Motion::Fly { along: Vec3::X }),
        (Fly, Key::E, true, Motion::Fly { along: Vec3::Y }),
        (Fly, Key::Q, true, Motion::Fly { along: Vec3::NEG_Y }),
    ];
    for (navigation, key, shift, expected) in cases {
        let mut hand = Hand::new(600.0, 1.0, navigation);
        hand.modifiers.shift = shift;
        assert_eq!(hand.frame([hand.key(key, true)]), [expected], "{key:?}");
        assert_eq!(hand.frame([]), [expected], "{key:?} is still down");
        assert_eq!(hand.frame([hand.key(key, false)]), [], "{key:?} is up");
    }
}

#[test]
fn letters_fly_by_their_places() {
    let forward = [Motion::Fly { along: Vec3::Z * STROLL }];
    let mut hand = Hand::new(600.0, 1.0, Navigation::Fly);
    // On a French keyboard, Z is where a US keyboard has W, and W where it has Z.
    let z = |pressed| Event::Key {
        key: Key::Z,
        physical_key: Some(Key::W),
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    let w = Event::Key {
        key: Key::W,
        physical_key: Some(Key::Z),
        pressed: true,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    assert_eq!(hand.frame([w]), []);
    assert_eq!(hand.frame([z(true)]), forward);
    assert_eq!(hand.frame([]), forward, "held");
    assert_eq!(hand.frame([z(false)]), []);
    hand.frame([z(true)]);
    assert_eq!(hand.frame([Event::WindowFocused(false)]), [], "the release goes to another window");
}

#[test]
fn keys_with_control_are_commands_and_letters_fly_alone() {
    let mut hand = Hand::new(600.0, 1.0, Navigation::Orbit);
    assert_eq!(hand.frame([hand.key(Key::S, true)]), []);
    let mut hand = Hand::new(600.0, 1.0, Navigation::Fly);
    hand.modifiers.ctrl = true;
    assert_eq!(hand.frame([hand.key(Key::S, true)]), []);
}

/// egui sees two taps with two fingers as two clicks of the first finger.
#[test]
fn two_taps_with_two_fingers_are_no_double_tap() {
    use TouchPhase::{End, Start};
    let mut hand = Hand::new(600.0, 1.0, Navigation::Orbit);
    let primary = PointerButton::Primary;
    for _ in 0..2 {
        let down =
            [hand.touch(1, Start, 0.1, 0.0), hand.moved(0.1, 0.0), hand.button(primary, true, 0.1, 0.0)];
        assert_eq!(hand.frame(down), []);
        assert_eq!(hand.frame([hand.touch(2, Start, 0.3, 0.0)]), []);
        let up = [
            hand.touch(2, End, 0.3, 0.0),
            hand.touch(1, End, 0.1, 0.0),
            hand.button(primary, false, 0.1, 0.0),
        ];
        assert_eq!(hand.frame(up), []);
    }
}

#[test]
fn what_happens_beside_the_view_is_not_for_it() {
    for (part, is_over) in [(1.0, true), (0.4, false)] {
        let mut hand = Hand { part, ..Hand::new(600.0, 1.0, Navigation::Orbit) };
        hand.frame([hand.moved(0.5, 0.0)]);
        hand.frame([]);
        assert_eq!(!hand.frame([hand.wheel(1.0), Event::Zoom(1.2)]).is_empty(), is_over);
        assert_eq!(!hand.drag(PointerButton::Primary, 0.4, 0.2).is_empty(), is_over);
    }
}

#[test]
fn keys_are_for_what_has_the_focus() {
    let mut hand = Hand::new(600.0, 1.0, Navigation::Orbit);
    hand.context.memory_mut(|memory| memory.request_focus(egui::Id::unique("a name")));
    assert_eq!(hand.frame([hand.key(Key::PageUp, true)]), []);
    hand.context.memory_mut(|memory| memory.request_focus(egui::Id::unique("view")));
    assert_eq!(hand.frame([]).len(), 1);
}
