//! Thousands of events in random order: no panic, no error of the device, and no unbounded growth of memory.

use std::fmt::Write;

use crate::harness::ScriptHarness;

/// Number of events between measurements of the program's memory.
const SAMPLE: usize = 10;

/// Marsaglia's xorshift64 generator.
struct Dice(u64);

impl Dice {
    fn below(&mut self, sides: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % sides
    }

    fn of<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.below(words.len())]
    }

    fn share(&mut self) -> f64 {
        self.below(1000) as f64 / 999.0
    }

    /// A side from 1 to `most`; small sides are likely, so that many events fit into little time.
    fn side(&mut self, most: usize) -> usize {
        let most = [1, 3, most / 16, most / 8, most / 8, most / 4, most / 4, most][self.below(8)];
        1 + self.below(most)
    }
}

const KEYS: [&str; 38] = [
    "h",
    "f1",
    "s",
    "ctrl+c",
    "2",
    "3",
    "c",
    "r",
    "n",
    "m",
    "b",
    "g",
    "v",
    "x",
    "plus",
    "minus",
    "ctrl+plus",
    "ctrl+minus",
    "ctrl+0",
    "escape",
    "tab",
    "shift+tab",
    "enter",
    "space",
    "up",
    "down",
    "left",
    "right",
    "w",
    "a",
    "d",
    "q",
    "e",
    "home",
    "end",
    "f12",
    "f11",
    "alt+x",
];

const CHOICES: [&str; 34] = [
    "method full",
    "method adaptive",
    "method adaptive",
    "block 2",
    "block 4",
    "block 8",
    "postcorrect off",
    "postcorrect on",
    "postcorrect auto",
    "postcorrect scans",
    "t-pos 0",
    "t-pos 0.1",
    "t-norm 0.99",
    "t-tex 0.5",
    "t-gcol 0",
    "depth 1",
    "depth 3",
    "depth 6",
    "min-weight 0",
    "min-weight 0.2",
    "show final",
    "show origin",
    "show cost",
    "show oid",
    "split off",
    "split 0.3",
    "scale 0.25",
    "scale 1",
    "governor off",
    "governor 30",
    "governor 60",
    "overlay hidden",
    "overlay brief",
    "overlay full",
];

const FILES: [&str; 4] = ["gone.glb", "text.glb", "folder.glb", "picture.png"];

/// Small built-in scenes.
const SCENES: [&str; 3] = ["builtin:cornell", "builtin:minray", "builtin:furnace"];

/// The fingers that are down, and whether the app is paused.
#[derive(Default)]
struct State {
    fingers: [bool; 2],
    paused: bool,
}

impl State {
    fn touch(&mut self, dice: &mut Dice) -> String {
        let finger = dice.below(2);
        let down = self.fingers[finger];
        match (down, dice.below(3)) {
            (false, _) => {
                self.fingers[finger] = true;
                format!("touch {finger} begin {:.3},{:.3}", dice.share(), dice.share())
            }
            (true, 0) => {
                self.fingers[finger] = false;
                format!("touch {finger} end")
            }
            (true, _) => format!("touch {finger} move {:.3},{:.3} over 0.05", dice.share(), dice.share()),
        }
    }

    fn life(&mut self, dice: &mut Dice) -> String {
        let event = if self.paused {
            "resume"
        } else {
            dice.of(&[
                "pause",
                "lose-surface",
                "lose-device",
                "minimise",
                "restore",
                "fullscreen on",
                "fullscreen off",
                "rotate",
                "thermal 0.3",
                "thermal 1",
                "cost 500",
                "cost 20",
            ])
        };
        self.paused = event == "pause";
        event.to_owned()
    }

    /// Script that releases everything and restores the initial state.
    fn end(&self) -> String {
        let mut script = String::new();
        for finger in [0, 1].into_iter().filter(|finger| self.fingers[*finger]) {
            writeln!(script, "touch {finger} end").unwrap();
        }
        if self.paused {
            script += "resume\n";
        }
        for key in KEYS {
            writeln!(script, "let {key}").unwrap();
        }
        script += "release left\nrelease right\nrelease middle\nkey escape\nkey ctrl+0\n";
        for choice in
            ["method adaptive", "block 2", "postcorrect auto", "depth 3", "min-weight 0.05", "t-pos 0.03"]
        {
            writeln!(script, "set {choice}").unwrap();
        }
        script
            + "set show final\nset split off\nset governor 15\nset scale 1\nset overlay brief\nthermal 1\n\
            size 160x90\nopen builtin:cornell\nkey r\nwait 0.3\n"
    }

    fn event(&mut self, dice: &mut Dice) -> String {
        match dice.below(40) {
            0..8 => format!("move {:.3},{:.3} over {}", dice.share(), dice.share(), dice.of(&["0", "0.1"])),
            8..11 => format!("press {}", dice.of(&["left", "right", "middle"])),
            11..15 => format!("release {}", dice.of(&["left", "right", "middle"])),
            15..17 => format!("scroll {}", dice.below(7) as i64 - 3),
            17 => format!("pinch {}", dice.of(&["0.5", "0.9", "1.1", "2"])),
            18..21 => self.touch(dice),
            21..26 => format!("{} {}", dice.of(&["key", "key", "key", "hold", "let"]), dice.of(&KEYS)),
            26..31 => format!("set {}", dice.of(&CHOICES)),
            31..33 => format!("size {}x{}", dice.side(640), dice.side(480)),
            33..35 => format!("drop {}", dice.of(&FILES)),
            35 => format!("open {}", dice.of(&SCENES)),
            36..38 => self.life(dice),
            38 => "wait 0.1".to_owned(),
            _ => ["wait 0.3".to_owned(), format!("screenshot {}.png", dice.below(3))][dice.below(2)].clone(),
        }
    }
}

/// Plays the events of a seed in `rounds` rounds, the same ones each time. Returns the median memory in KiB
/// of each quarter of the run.
fn play(seed: u64, events: usize, rounds: usize) -> [u64; 4] {
    let mut script = "settle\n".to_owned();
    for _ in 0..rounds {
        let (mut dice, mut state) = (Dice(seed), State::default());
        for event in 1..=events {
            writeln!(script, "{}", state.event(&mut dice)).unwrap();
            if event % SAMPLE == 0 {
                script += "print problem\n";
            }
        }
        script += &state.end();
    }
    // Ordinary frames at the end, by which time the device has reported errors of earlier ones.
    script += "key escape\nopen builtin:minray\nset method full\nsettle\nset method adaptive\nsettle\n\
        expect problem =\nexpect scene = builtin:minray\n";
    let harness = ScriptHarness::with_window();
    std::fs::write(harness.path("text.glb"), "this is no scene at all").unwrap();
    std::fs::create_dir(harness.path("folder.glb")).unwrap();
    let mut samples = Vec::new();
    let ended =
        harness.plays_watched("builtin:cornell --size 160x90", &script, |id| samples.push(resident(id)));
    for problem in ended.told("problem") {
        assert!(problem.is_empty() || FILES.iter().any(|file| problem.contains(file)), "{problem}");
    }
    let quarter = samples.len() / 4;
    [0, 1, 2, 3].map(|i| median(&samples[i * quarter..(i + 1) * quarter]))
}

/// Resident memory in KiB.
fn resident(id: u32) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{id}/status")).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    line.trim().trim_end_matches(" kB").parse().unwrap()
}

fn median(samples: &[u64]) -> u64 {
    let mut sorted = samples.to_vec();
    sorted.sort_unstable();
    sorted[sorted.len() / 2]
}

/// Each combination of settings has its own kernels, which are kept while their scene is shown: new ones need
/// memory, but frames must not.
#[test]
fn two_thousand_events_do_no_harm() {
    let [_, second, _, last] = play(0x5EED, 2000, 1);
    assert!(last < second + second / 3, "resident memory grew from {second} KiB to {last} KiB");
}

/// All kernels exist after the first round. The allocator's reserve differs by a few percent between rounds,
/// which is less than if each event kept a picture of the smallest view.
#[test]
fn the_same_events_again_need_no_more_memory() {
    const EVENTS: u64 = 300;
    let [_, second, _, last] = play(0xCAFE, EVENTS as usize, 4);
    // From the middle of the second round to the middle of the last.
    let pictures = 2 * EVENTS * (160 * 90 * 4 / 1024);
    assert!(last < second + pictures, "resident memory grew from {second} KiB to {last} KiB");
}
