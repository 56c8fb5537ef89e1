//! What scenarios stand on: the loaded app, the activity that is played, and what is expected of it.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::Outcome;
use crate::activity::ARect;
use crate::java::{self, Intent};
use crate::life::{Activity, Library, pump};
use crate::options::Options;
use crate::picture::Picture;
use crate::{log, process, report, vulkan};

/// A picture, or a line of the log, comes within this time; software rendering compiles for seconds.
const TIMEOUT: Duration = Duration::from_secs(60);
/// A picture that did not change for this long is at rest.
const QUIET: Duration = Duration::from_millis(700);
/// Java's main thread may wait for the app this long in any callback but `onCreate` and `onDestroy`.
const JAVA_BOUND: Duration = Duration::from_secs(2);
/// Creating and destroying may take this long: pipelines in the making are finished first.
const LIFE_BOUND: Duration = Duration::from_secs(15);
/// After a callback, a present that is due comes within this time.
const PRESENT: Duration = Duration::from_secs(10);

/// See the module's text.
pub struct Harness {
    /// The command line.
    pub options: Options,
    /// What is played now.
    pub activity: Option<Activity>,
    /// Pixels of the display now.
    pub size: [u32; 2],
    library: Library,
    files: PathBuf,
    expected: Option<Arc<Picture>>,
    /// Presents before the activity that is played: their pictures are another's.
    before: u64,
    kept: u32,
}

impl Harness {
    /// Loads the app and what is expected of it.
    pub fn new(options: Options) -> Outcome<Self> {
        let app =
            std::fs::canonicalize(&options.app).map_err(|e| format!("{}: {e}", options.app.display()))?;
        let expected = options.expect.as_ref().map(|path| Picture::read(path)).transpose()?.map(Arc::new);
        let files = options
            .files
            .clone()
            .unwrap_or_else(|| std::env::temp_dir().join(format!("android-run-{}", std::process::id())));
        for folder in [Some(&files), options.keep.as_ref()].into_iter().flatten() {
            std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        }
        let library = Library::load(&app)?;
        let size = options.size;
        Ok(Self { options, activity: None, size, library, files, expected, before: 0, kept: 0 })
    }

    /// A step of the scenario: says what was done and how long it took, or ends the scenario.
    pub fn step<T>(&mut self, what: &str, act: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        let _watch = report::watch(what, TIMEOUT * 2);
        let start = Instant::now();
        let result = act(self).and_then(|result| self.check().map(|()| result));
        let result = result.map_err(|problem| format!("{what}: {problem}"))?;
        report::say(&format!(
            "ok    {}: {what} ({:.1} s)",
            self.options.scenario,
            start.elapsed().as_secs_f64()
        ));
        Ok(result)
    }

    /// What holds after every step.
    pub fn check(&self) -> Outcome {
        if let Some((name, time)) = self.activity.as_ref().map(Activity::slowest) {
            let bound = if name == "onCreate" { LIFE_BOUND } else { JAVA_BOUND };
            within(name, time, bound)?;
        }
        if let Some(thread) = java::ended_attached().first() {
            return Err(format!("the thread `{thread}` ended while it was attached to Java"));
        }
        match report::complaints().as_slice() {
            [] => Ok(()),
            complaints => Err(complaints.join("; ")),
        }
    }

    /// The intent of a start from the launcher, with the extras of the command line.
    pub fn intent(&self) -> Intent {
        let view = self.options.view.map(|[width, height]| format!("{width}x{height}"));
        let extras =
            [("view", view), ("scene", self.options.scene.clone()), ("set", self.options.set.clone())];
        let extras = extras.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?)));
        Intent {
            action: Some("android.intent.action.MAIN".to_owned()),
            extras: extras.collect::<HashMap<_, _>>(),
            ..Intent::default()
        }
    }

    /// Creates an activity and shows nothing of it yet.
    pub fn create(&mut self, intent: Intent, saved: &[u8]) {
        self.before = vulkan::presents();
        self.activity = Some(Activity::create(self.library, intent, &self.files, saved));
    }

    /// Creates an activity and brings it to the foreground.
    pub fn launch(&mut self, intent: Intent) {
        self.create(intent, &[]);
        let size = self.size;
        self.with(|activity| {
            activity.start();
            activity.resume();
            activity.create_window(size);
            activity.focus(true);
        });
    }

    /// The first step of most scenarios: starts the app, and waits for the picture that is expected of it.
    pub fn opens(&mut self) -> Outcome<Arc<Picture>> {
        let expected = self.expected()?;
        self.step("the expected picture is presented", |harness| {
            let intent = harness.intent();
            harness.launch(intent);
            harness.shows(&expected)
        })?;
        Ok(expected)
    }

    /// Acts on the activity, if there is one.
    pub fn with(&mut self, act: impl FnOnce(&mut Activity)) {
        if let Some(activity) = &mut self.activity {
            act(activity);
        }
    }

    /// Takes the activity from the foreground and destroys it.
    pub fn destroy(&mut self) -> Outcome {
        let Some(mut activity) = self.activity.take() else { return Ok(()) };
        activity.focus(false);
        activity.pause();
        activity.destroy_window();
        activity.stop();
        destroy(activity)
    }

    /// Turns the display, or resizes the window, with a cutout at the end that was at the top.
    pub fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
        let cutout = if size[0] > size[1] { [8, 0, 0, 0] } else { [0, 8, 0, 0] };
        java::with_world(|world| world.cutout = Some(cutout));
        let [width, height] = size.map(|side| side as i32);
        let content = ARect { left: cutout[0], top: cutout[1], right: width, bottom: height };
        self.with(|activity| activity.resize(size, content));
    }

    /// The picture that the command line expects.
    pub fn expected(&self) -> Outcome<Arc<Picture>> {
        self.expected.clone().ok_or_else(|| "expected the option --expect, found none".to_owned())
    }

    /// The last picture of the activity that is played.
    fn last(&self) -> Option<Arc<Picture>> {
        vulkan::last_presented().filter(|_| vulkan::presents() > self.before)
    }

    /// Waits until `picture` is what the activity presented last.
    pub fn shows(&mut self, picture: &Picture) -> Outcome {
        let shown = pump(TIMEOUT, || self.last().is_some_and(|last| *last == *picture));
        self.keep_last()?;
        match self.last() {
            _ if shown => Ok(()),
            None => Err("nothing was presented".to_owned()),
            Some(last) => {
                let difference = last.difference(picture).unwrap_or_else(|| "presented too late".to_owned());
                Err(format!("{difference}, in the last of {} pictures", vulkan::presents()))
            }
        }
    }

    /// Waits until what is presented no longer changes and the app lets the screen go dark; answers the picture.
    pub fn rest(&mut self) -> Outcome<Arc<Picture>> {
        let mut last = self.last();
        let mut since = Instant::now();
        let at_rest = pump(TIMEOUT, || {
            let now = self.last();
            if now != last {
                (last, since) = (now, Instant::now());
            }
            let busy = self.activity.as_ref().is_some_and(Activity::is_busy);
            last.is_some() && !busy && since.elapsed() > QUIET
        });
        self.keep_last()?;
        last.filter(|_| at_rest).ok_or_else(|| "the picture does not come to rest".to_owned())
    }

    /// One of the two presents that follow number `first` must be `picture`.
    pub fn shows_within_two(&mut self, first: u64, picture: &Picture) -> Outcome {
        // Taken at once: later ones push them out.
        let mut found = [None, None];
        let in_time = pump(PRESENT, || {
            for (number, found) in (first..).zip(&mut found) {
                *found = found.take().or_else(|| vulkan::picture(number));
            }
            found.iter().flatten().any(|found| **found == *picture) || found[1].is_some()
        });
        self.keep_last()?;
        let last = found.iter().flatten().last().ok_or_else(|| "no picture came".to_owned())?;
        let is_there = found.iter().flatten().any(|found| **found == *picture);
        match last.difference(picture).filter(|_| !is_there) {
            None => Ok(()),
            Some(difference) if in_time => Err(difference),
            Some(difference) => Err(format!("{difference}, and no second picture came")),
        }
    }

    /// Waits for a line of the log, from `mark` on, in which `find` finds something.
    pub fn log<T>(&self, mark: u64, what: &str, find: impl Fn(&str) -> Option<T>) -> Outcome<T> {
        let look = || log::since(mark).iter().find_map(|line| find(line));
        let mut found = None;
        pump(TIMEOUT, || {
            found = look();
            found.is_some()
        });
        found.ok_or_else(|| format!("expected {what} in the log, found none"))
    }

    /// Turns Java's main loop for a while.
    pub fn wait(&self, time: Duration) {
        pump(time, || false);
    }

    /// Sends the back key, and waits until the activity asks for its end; then ends it.
    pub fn back(&mut self) -> Outcome {
        super::hand::back(self);
        let asked = pump(PRESENT, || self.activity.as_ref().is_some_and(Activity::is_finished));
        match asked {
            true => self.destroy(),
            false => Err(format!("the activity was not finished within {} s", PRESENT.as_secs())),
        }
    }

    /// No thread of the app may be left.
    pub fn no_threads(&self) -> Outcome {
        let left = || -> Vec<String> {
            let own = |name: &String| name.starts_with("glimpse") || name == "android_main";
            process::threads().into_iter().filter(own).collect()
        };
        match pump(Duration::from_secs(5), || left().is_empty()) {
            true => Ok(()),
            false => Err(format!("these threads are left: {}", left().join(", "))),
        }
    }

    /// Keeps the last picture, if pictures are to be kept.
    fn keep_last(&mut self) -> Outcome {
        match vulkan::last_presented() {
            Some(last) => self.keep(&last),
            None => Ok(()),
        }
    }

    /// Keeps a picture, if pictures are to be kept.
    pub fn keep(&mut self, picture: &Picture) -> Outcome {
        let Some(folder) = &self.options.keep else { return Ok(()) };
        self.kept += 1;
        picture.write(&folder.join(format!(
            "{}-{:03}.png",
            self.options.scenario.replace(':', "-"),
            self.kept
        )))
    }

    /// Ends what is still played, and checks for the last time.
    pub fn finish(&mut self) -> Outcome {
        self.destroy()?;
        self.no_threads()?;
        self.check()
    }
}

/// Destroys an activity within the bound.
pub fn destroy(activity: Activity) -> Outcome {
    within("onDestroy", activity.destroy(), LIFE_BOUND)
}

fn within(what: &str, time: Duration, bound: Duration) -> Outcome {
    let bound = report::allowed(bound);
    match time > bound {
        true => Err(format!(
            "{what} kept Java's main thread waiting for {:.1} s, expected {} s at most",
            time.as_secs_f64(),
            bound.as_secs()
        )),
        false => Ok(()),
    }
}
