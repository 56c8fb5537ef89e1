//! Replays of synthetic loads with a simulated clock.

use std::f64::consts::TAU;

use glimpse::{Postcorrect, Settings, Tolerances};

use super::{ladder::Level, *};

/// Pixels of a view of 1080x2400.
const VIEW: f64 = 1080.0 * 2400.0;

const BUDGETS: [f64; 2] = [1000.0 / 30.0, 1000.0 / 60.0];

/// Costs of scenes in nanoseconds per pixel at the best level: 5 fits 60 frames per second at full size, 300
/// only the last levels.
const SCENES: [f64; 6] = [5.0, 12.0, 30.0, 75.0, 150.0, 300.0];

/// Marsaglia's xorshift generator, which gives the same noise on every platform.
struct Noise(u64);

impl Noise {
    /// Uniformly distributed in [-1, 1).
    fn even(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Time of a frame on the simulated device. It differs from the governor's model: blocks of 4 gain less, and each frame
/// has a constant cost.
fn frame_ms(level: usize, ns: f64, slower: f64) -> f64 {
    let Level { scale, block, .. } = LADDER[level];
    let work = if block > 2 { 0.92 } else { 1.0 };
    slower * (0.4 + ns * 1e-6 * VIEW * f64::from(scale).powi(2) * work)
}

/// Slowdown of the device after `seconds` seconds. The amounts follow published stress tests (3DMark Wild
/// Life Extreme, 20 runs of a minute: a Galaxy S23 Ultra falls from 3,886 to 2,794 points, an iPhone 15 Pro
/// Max from 3,608 to 2,681), the shapes stepwise thermal governors, which lower clocks by steps of a table
/// and raise them once the device is cool again.
fn load(trace: &str, seconds: f64) -> f64 {
    match trace {
        "cool" => 1.0,
        // Falls to a sustained 72 % within a minute and a half, in steps.
        "steps" => [1.0, 1.1, 1.24, 1.39][(seconds / 22.0) as usize % 4],
        "ramp" => 1.0 + 0.9 * (seconds / 90.0).min(1.0),
        // Heats up to a trip point every 20 s.
        "saw tooth" => 1.0 + 0.6 * (seconds / 20.0).fract(),
        // Something else uses the device for a third of a second, every 12 s.
        "other load" => {
            if seconds % 12.0 > 11.65 {
                1.6
            } else {
                1.0
            }
        }
        // Single frames take three times as long.
        "hiccups" => {
            if (seconds % 9.0) > 9.0 - 0.016 {
                3.0
            } else {
                1.0
            }
        }
        "breathing" => 1.2 + 0.2 * (seconds * TAU / 15.0).sin(),
        _ => unreachable!("no trace {trace}"),
    }
}

const TRACES: [&str; 7] = ["cool", "steps", "ramp", "saw tooth", "other load", "hiccups", "breathing"];

/// Statistics of a replay.
#[derive(Debug, Default)]
struct Run {
    frames: u32,
    late: u32,
    scale: f64,
    /// Times of level changes in seconds.
    changes: Vec<f64>,
}

impl Run {
    fn late_share(&self) -> f64 {
        f64::from(self.late) / f64::from(self.frames)
    }

    fn mean_scale(&self) -> f64 {
        self.scale / f64::from(self.frames)
    }
}

/// Replays 90 seconds of a load with 15 % noise, with the level chosen by `choose`.
fn replay(
    budget_ms: f64,
    ns: f64,
    trace: &str,
    seed: u64,
    mut choose: impl FnMut(Duration, Option<FrameReport>) -> usize,
) -> Run {
    let (mut now, mut noise, mut run) =
        (Duration::ZERO, Noise(seed * 0x9E37_79B9_7F4A_7C15 + 1), Run::default());
    let (mut last, mut before) = (None, None);
    while now.as_secs() < 90 {
        let level = choose(now, last);
        let scale = f64::from(LADDER[level].scale);
        let slower = load(trace, now.as_secs_f64()) * (1.0 + 0.15 * noise.even());
        let ms = frame_ms(level, ns, slower);
        last = Some(FrameReport { level: Some(level), pixels: (VIEW * scale * scale) as u64, ms });
        run.frames += 1;
        run.late += u32::from(ms > budget_ms);
        run.scale += scale;
        if before.is_some_and(|before| before != level) {
            run.changes.push(now.as_secs_f64());
        }
        before = Some(level);
        // A frame is displayed for whole refresh periods.
        now += Duration::from_secs_f64((ms / budget_ms).ceil() * budget_ms * 1e-3);
    }
    run
}

fn governed(budget_ms: f64, ns: f64, trace: &str, seed: u64) -> Run {
    let mut governor = Governor::new(budget_ms);
    replay(budget_ms, ns, trace, seed, |now, last| {
        governor.next(now, last, true).level.expect("a level while moving")
    })
}

/// The best fixed level that is in time throughout, if there is one.
fn best_fixed(budget_ms: f64, ns: f64, trace: &str, seed: u64) -> Option<f64> {
    (0..LADDER.len())
        .map(|level| replay(budget_ms, ns, trace, seed, |_, _| level))
        .find(|run| run.late_share() <= 0.01)
        .map(|run| run.mean_scale())
}

#[test]
fn frames_are_in_time_and_no_smaller_than_they_must_be() {
    let mut runs = 0;
    for budget_ms in BUDGETS {
        for ns in SCENES {
            for trace in TRACES {
                for seed in 1..4 {
                    let Some(fixed) = best_fixed(budget_ms, ns, trace, seed) else { continue };
                    let run = governed(budget_ms, ns, trace, seed);
                    let what = format!("{ns} ns, {budget_ms:.1} ms, {trace}, seed {seed}");
                    assert!(run.late_share() <= 0.01, "{what}: {} of {} are late", run.late, run.frames);
                    let scale = run.mean_scale();
                    assert!(scale >= 0.8 * fixed, "{what}: scale {scale:.3}, {fixed:.3} would do");
                    runs += 1;
                }
            }
        }
    }
    assert!(runs > 200, "the budget must be reachable in most of them: {runs}");
}

#[test]
fn a_constant_load_settles() {
    for budget_ms in BUDGETS {
        // Small steps of cost, so that for some of them two levels are both feasible.
        for step in 0..60 {
            let ns = 5.0 * 1.07_f64.powi(step);
            let run = governed(budget_ms, ns, "cool", step as u64 + 1);
            let after: Vec<_> = run.changes.iter().copied().filter(|&at| at > 20.0).collect();
            let pumps = after.windows(2).any(|pair| pair[1] - pair[0] < 10.0);
            assert!(!pumps, "{ns} ns, {budget_ms:.1} ms: changes at {after:.1?}");
        }
    }
}

/// The levels of a number of frames, one every 20 ms, of a view of a million pixels; `ms` gives the time of a frame of
/// a level.
fn levels(governor: &mut Governor, frames: u32, ms: impl Fn(u32, usize) -> f64) -> Vec<usize> {
    let mut last = None;
    (0..frames)
        .map(|frame| {
            let now = Duration::from_millis(20) * frame;
            let level = governor.next(now, last, true).level.expect("a level while moving");
            let pixels = (1e6 * LADDER[level].area()) as u64;
            last = Some(FrameReport { level: Some(level), pixels, ms: ms(frame, level) });
            level
        })
        .collect()
}

#[test]
fn a_level_that_was_tried_in_vain_is_left_alone() {
    // Levels with blocks of 2 take twice the modelled time: level 5 is the best that fits, and level 4 seems to.
    let dear =
        |_, level: usize| 30.0 * LADDER[level].share() * if LADDER[level].block == 2 { 3.0 } else { 1.0 };
    let levels = levels(&mut Governor::new(20.0), 90 * 50, dear);
    let trials = levels.windows(2).filter(|pair| pair[0] == 5 && pair[1] == 4).count();
    assert!((2..=4).contains(&trials), "{trials} trials in 90 s");
    let left = levels.windows(2).filter(|pair| pair[0] == 4 && pair[1] != 4);
    assert!(
        left.clone().all(|pair| pair[1] == 5),
        "back to where it came from: {:?}",
        left.collect::<Vec<_>>()
    );
    let well = levels.iter().filter(|level| (5..=7).contains(*level)).count();
    assert!(well > levels.len() * 98 / 100, "{well} of {} frames", levels.len());
}

#[test]
fn a_single_hiccup_changes_nothing_and_a_second_one_is_believed() {
    let run = |slow: std::ops::Range<u32>| {
        let ms =
            |frame, level: usize| LADDER[level].share() * if slow.contains(&frame) { 90.0 } else { 30.0 };
        let levels = levels(&mut Governor::new(20.0), 500, ms);
        (levels[399], *levels[400..].iter().max().expect("frames"))
    };
    let (before, after) = run(400..401);
    assert_eq!(after, before, "one slow frame");
    let (before, after) = run(400..402);
    assert!(after > before, "two slow frames");
}

/// Slow frames lower the level immediately, fast ones raise it slowly.
#[test]
fn down_at_once_and_up_by_single_levels() {
    let mut governor = Governor::new(20.0);
    let mut now = Duration::ZERO;
    let mut frame = |governor: &mut Governor, level: usize, ms| {
        now += Duration::from_millis(20);
        let area = LADDER[level].area();
        let report = FrameReport { level: Some(level), pixels: (1e6 * area) as u64, ms };
        governor.next(now, Some(report), true).level.expect("a level")
    };
    let start = governor.next(Duration::ZERO, None, true).level.expect("a level");
    let down = frame(&mut governor, start, 70.0);
    let share = |level: usize| LADDER[level].share();
    assert!(70.0 * share(down) / share(start) <= 20.0, "level {down} is not down far enough");
    assert!(70.0 * share(down - 1) / share(start) > 0.8 * 20.0, "level {down} is down too far");
    let mut level = down;
    let mut frames = 0;
    while level > 0 {
        let next = frame(&mut governor, level, 1.0);
        assert!(next == level || next + 1 == level, "from {level} to {next}");
        frames += 1;
        assert!(frames < 1000, "must arrive");
        level = next;
    }
    assert!(frames >= 12 * down as u32, "{frames} frames for {down} levels is no sustained headroom");
}

#[test]
fn reports_of_frames_that_were_on_their_way_do_not_count_twice() {
    let mut governor = Governor::new(20.0);
    let first = governor.next(Duration::ZERO, None, true).level.expect("a level");
    let late = FrameReport { level: Some(first), pixels: 1_000_000, ms: 30.0 };
    let down = governor.next(Duration::from_millis(30), Some(late), true).level.expect("a level");
    assert!(down > first);
    let again = governor.next(Duration::from_millis(60), Some(late), true).level;
    assert_eq!(again, Some(down));
}

#[test]
fn a_larger_view_is_foreseen() {
    let mut governor = Governor::new(20.0);
    let mut level = governor.next(Duration::ZERO, None, true).level.expect("a level");
    for i in 1..400 {
        let area = LADDER[level].area();
        let report = FrameReport { level: Some(level), pixels: (1e6 * area) as u64, ms: 18.0 * area };
        level = governor.next(Duration::from_millis(20 * i), Some(report), true).level.expect("a level");
    }
    assert_eq!(level, 0);
    let report = FrameReport { level: Some(0), pixels: 4_000_000, ms: 72.0 };
    let hiccup = governor.next(Duration::from_secs(9), Some(report), true).level.expect("a level");
    assert!(LADDER[hiccup].area() * 72.0 <= 20.0, "as much a pixel as before is no hiccup: level {hiccup}");
}

#[test]
fn rest_is_refined_and_motion_goes_on_where_it_was() {
    let mut governor = Governor::new(20.0);
    let slow = |level| FrameReport { level, pixels: 500_000, ms: 40.0 };
    let first = governor.next(Duration::ZERO, None, true).level;
    let moving = governor.next(Duration::from_millis(40), Some(slow(first)), true);
    assert_eq!(governor.next(Duration::from_millis(60), None, false), moving, "a short stop is no rest");
    let rest = governor.next(Duration::from_millis(300), None, false);
    assert_eq!((rest.level, rest.scale), (None, 1.0));
    let chosen = Settings { block: 8, ..Settings::default() };
    assert_eq!(rest.settings(&chosen), chosen);
    // A frame at rest has no time limit.
    let slow = FrameReport { level: None, pixels: 2_592_000, ms: 9000.0 };
    for i in 0..5 {
        assert_eq!(governor.next(Duration::from_secs(10 + i), Some(slow), true), moving);
    }
}

#[test]
fn a_hot_device_gets_less_to_do() {
    let run = |thermal| {
        let mut governor = Governor::new(20.0);
        governor.set_thermal(thermal);
        governor.set_thermal(f32::NAN);
        let run = replay(20.0, 30.0, "cool", 1, |now, last| {
            governor.next(now, last, true).level.expect("a level while moving")
        });
        (governor.limit_ms(), run.mean_scale())
    };
    let (cool, hot) = (run(1.0), run(0.5));
    assert_eq!((cool.0, hot.0), (20.0, 10.0));
    let area = (hot.1 / cool.1).powi(2);
    assert!((0.35..0.65).contains(&area), "half the time must be about half the pixels: {area}");
}

#[test]
fn little_memory_bounds_the_scale() {
    let mut governor = Governor::new(20.0);
    let run = |governor: &mut Governor| {
        replay(20.0, 1.0, "cool", 1, |now, last| governor.next(now, last, true).level.expect("a level"))
            .mean_scale()
    };
    assert!(run(&mut governor) > 0.9);
    for scale in [0.5, 0.25, 0.125, 0.125] {
        governor.trim();
        assert!((run(&mut governor) - f64::from(scale)).abs() < 0.03 * f64::from(scale), "{scale}");
        let rest = governor.next(Duration::from_secs(1000), None, false);
        assert_eq!((rest.level, rest.scale), (None, scale));
    }
}

#[test]
fn reports_that_say_nothing_are_ignored() {
    let mut governor = Governor::new(20.0);
    let first = governor.next(Duration::ZERO, None, true);
    let report = |level, pixels, ms| Some(FrameReport { level: Some(level), pixels, ms });
    for report in [
        report(3, 1_000_000, f64::NAN),
        report(3, 1_000_000, f64::INFINITY),
        report(3, 1_000_000, -5.0),
        report(3, 0, 5.0),
        report(99, 1_000_000, 500.0),
    ] {
        assert_eq!(governor.next(Duration::from_secs(1), report, true), first);
    }
}

#[test]
fn the_ladder_goes_down() {
    let (first, last) = (&LADDER[0], &LADDER[LADDER.len() - 1]);
    assert_eq!((first.scale, first.block, first.relax), (1.0, 2, 1.0));
    assert_eq!((last.scale, last.block), (0.125, 4));
    for pair in LADDER.windows(2) {
        let area = pair[1].area() / pair[0].area();
        assert!((0.68..0.82).contains(&area), "{area}");
        assert!(pair[1].relax >= pair[0].relax && pair[1].work <= pair[0].work);
        assert_eq!((pair[1].scale * 64.0).fract(), 0.0, "a multiple of 1/64");
    }
}

#[test]
fn every_level_is_valid_and_looser_than_what_was_chosen() {
    let usual = Tolerances::default();
    let strange = Tolerances { pos: f32::MAX, norm: -1.0, gcol: f32::MAX, ..usual };
    let strictest = Tolerances { pos: 0.0, norm: 2.0, gcol: 0.0, ..usual };
    for tolerances in [usual, strange, strictest] {
        let chosen = Settings { tolerances, ..Settings::default() };
        for (index, level) in LADDER.iter().enumerate() {
            let quality =
                Quality { level: Some(index), scale: level.scale, block: level.block, relax: level.relax };
            let settings = quality.settings(&chosen);
            settings.validate().unwrap_or_else(|error| panic!("level {index}: {error}"));
            let t = settings.tolerances;
            assert!(t.pos >= tolerances.pos && t.norm <= tolerances.norm);
            assert!(t.tex <= tolerances.tex && t.gcol >= tolerances.gcol);
            assert_eq!(settings.postcorrect, Postcorrect::Off, "nothing is repaired for one frame");
            let repaired = Settings { postcorrect: chosen.postcorrect, ..settings };
            assert!(index > 0 || repaired == chosen, "the best level is what was chosen");
        }
    }
    // Tolerances that make every check fail still do so when they are relaxed.
    let quality = Quality { level: Some(10), scale: 0.25, block: 4, relax: 2.0 };
    let settings = quality.settings(&Settings { tolerances: strictest, ..Settings::default() });
    assert_eq!(
        (settings.tolerances.pos, settings.tolerances.norm, settings.tolerances.gcol),
        (0.0, 2.0, 0.0)
    );
}

#[test]
fn sizes_are_rounded_and_never_nothing() {
    let quality = |scale| Quality { level: Some(1), scale, block: 2, relax: 1.0 };
    assert_eq!(quality(0.875).pixels(1080), 945);
    assert_eq!(quality(0.125).pixels(3), 1);
    assert_eq!(quality(1.0).pixels(u32::MAX), u32::MAX);
}
