//! A storm of random events: no panic, a correct picture after each resume, no growth.

use super::harness::Harness;
use super::{Outcome, hand};
use crate::input::KEY_VOLUME_UP;
use crate::life::{Activity, pump};
use crate::process::Memory;
use crate::{report, thermal, vulkan};
use std::time::Duration;

/// Memory may grow by this share of the early state.
const DRIFT: f64 = 0.01;
/// The share of the events after which the early state is taken.
const WARM_UP: f64 = 0.25;

/// Numbers that look random and follow from a seed (Steele, Lea, Flood 2014: SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: u64) -> u64 {
        self.next() % end
    }

    fn chance(&mut self, one_in: u64) -> bool {
        self.below(one_in) == 0
    }

    /// A place on the screen, away from its edges.
    fn place(&mut self) -> [f32; 2] {
        [0; 2].map(|_| 0.2 + 0.6 * self.below(1000) as f32 / 1000.0)
    }
}

struct Storm<'a> {
    harness: &'a mut Harness,
    random: Random,
    /// Events that were sent.
    events: u64,
    /// Resumes after which the picture was compared.
    compared: u64,
}

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    let (events, seed) = (harness.options.events, harness.options.seed);
    harness.opens()?;
    let mut storm = Storm { harness, random: Random(seed), events: 0, compared: 0 };
    let mut early = None;
    let mut next = 0;
    while storm.events < events {
        if storm.events >= next {
            report::say(&format!("      {} events, {} compared", storm.events, storm.compared));
            next += events.div_ceil(10);
        }
        if early.is_none() && storm.events as f64 >= WARM_UP * events as f64 {
            early = Some(storm.quiet()?);
        }
        let at = storm.events;
        storm.one().map_err(|problem| format!("after {at} events (seed {seed}): {problem}"))?;
    }
    let last = storm.quiet()?;
    let (events, compared) = (storm.events, storm.compared);
    harness.step(&format!("{events} events, {compared} resumes compared"), |_| Ok(()))?;
    harness.step("memory does not grow", |_| grows(early.unwrap_or(last), last))
}

fn grows(early: Memory, last: Memory) -> Outcome {
    let mib = |bytes: u64| bytes as f64 / 1024.0 / 1024.0;
    let drift = last.heap as f64 / early.heap as f64 - 1.0;
    report::say(&format!(
        "      heap {:.2} -> {:.2} MiB ({:+.2} %), resident {:.1} -> {:.1} MiB",
        mib(early.heap),
        mib(last.heap),
        drift * 100.0,
        mib(early.resident),
        mib(last.resident)
    ));
    match drift < DRIFT {
        true => Ok(()),
        false => {
            Err(format!("the heap grew by {:.2} %, expected less than {} %", drift * 100.0, DRIFT * 100.0))
        }
    }
}

impl Storm<'_> {
    /// One thing happens, and what holds after it is checked.
    fn one(&mut self) -> Outcome {
        let harness = &mut *self.harness;
        match self.random.below(100) {
            0..50 => self.gesture(),
            50..55 => {
                hand::press(harness, KEY_VOLUME_UP);
                self.events += 2;
            }
            55..60 => {
                harness.with(Activity::low_memory);
                self.events += 1;
            }
            60..66 => {
                harness.with(|activity| {
                    activity.focus(false);
                    activity.focus(true);
                });
                self.events += 2;
            }
            66..70 => {
                harness.with(Activity::configuration_changed);
                self.events += 1;
            }
            70..76 => {
                thermal::set_headroom([0.4, 0.8, 0.95, 1.05][self.random.below(4) as usize]);
                self.events += 1;
            }
            76..84 => {
                harness.resize([harness.size[1], harness.size[0]]);
                self.events += 4;
            }
            84..99 => self.background()?,
            _ => self.recreate()?,
        }
        let pause = self.random.below(30);
        self.harness.wait(Duration::from_millis(pause));
        self.checked()
    }

    /// What [`Harness::step`] checks, without a line on the output.
    fn checked(&mut self) -> Outcome {
        let answers = || self.harness.activity.as_ref().is_none_or(Activity::input_is_finished);
        if !pump(Duration::from_secs(5), answers) {
            return Err("input was not handled within 5 s".to_owned());
        }
        self.harness.check()
    }

    fn gesture(&mut self) {
        let (from, to) = (self.random.place(), self.random.place());
        let moves = 1 + self.random.below(6) as u32;
        match self.random.below(8) {
            0 => {
                hand::pinch(self.harness, 0.2 + from[0] / 2.0, 0.2 + to[0] / 2.0, moves);
                self.events += u64::from(moves) + 4;
            }
            1 => {
                hand::drag_in_a_batch(self.harness, from, to);
                self.events += 3;
            }
            2 => {
                hand::cancelled_drag(self.harness);
                self.events += 2;
            }
            _ => {
                hand::drag(self.harness, from, to, moves);
                self.events += u64::from(moves) + 2;
            }
        }
    }

    /// To the background and back; if the view was at rest before, the same picture comes within two presents.
    fn background(&mut self) -> Outcome {
        let before = if self.random.chance(2) { Some(self.harness.rest()?) } else { None };
        let (stops, idles) = (self.random.chance(2), self.random.below(100));
        self.harness.with(|activity| {
            activity.focus(false);
            activity.pause();
            if stops {
                activity.save();
                activity.stop();
            }
            activity.destroy_window();
        });
        self.harness.wait(Duration::from_millis(idles));
        let (first, size) = (vulkan::presents(), self.harness.size);
        self.harness.with(|activity| {
            if stops {
                activity.start();
            }
            activity.resume();
            activity.create_window(size);
            activity.focus(true);
        });
        self.events += if stops { 10 } else { 7 };
        match before {
            Some(before) => {
                self.compared += 1;
                self.harness.shows_within_two(first, &before)
            }
            None => Ok(()),
        }
    }

    fn recreate(&mut self) -> Outcome {
        self.harness.destroy()?;
        self.harness.no_threads()?;
        self.harness.size = self.harness.options.size;
        let (intent, expected) = (self.harness.intent(), self.harness.expected()?);
        self.harness.launch(intent);
        self.events += 9;
        self.harness.shows(&expected)
    }

    /// The state in which memory is compared: as the app was started, and at rest.
    fn quiet(&mut self) -> Outcome<Memory> {
        let size = self.harness.options.size;
        if self.harness.size != size {
            self.harness.resize(size);
        }
        thermal::set_headroom(0.4);
        self.harness.rest()?;
        self.harness.wait(Duration::from_secs(2));
        Ok(Memory::now())
    }
}
