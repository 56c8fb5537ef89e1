//! The life of an activity, as the Java side drives it: every callback of `ANativeActivity` with its order, its time
//! and what it hands over.

use std::ffi::{CStr, CString, c_int, c_void};
use std::os::unix::ffi::OsStrExt as _;
use std::path::Path;
use std::ptr;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::activity::{self, ANativeActivity, ANativeActivityCallbacks, ARect, Given, Told};
use crate::input::AInputQueue;
use crate::java::{self, Intent};
use crate::looper::ALooper_pollOnce;
use crate::window::{self, ANativeWindow};
use crate::{assets, bionic, configuration, report};

type OnCreate = unsafe extern "C" fn(*mut ANativeActivity, *const c_void, usize);

/// A callback may take this long before the run is ended.
const HANG: Duration = Duration::from_secs(60);

/// The app's library, loaded.
#[derive(Clone, Copy)]
pub struct Library {
    on_create: OnCreate,
}

impl Library {
    /// Loads the library as Android does: every symbol is resolved at once.
    ///
    /// # Errors
    /// What the dynamic linker says, or that the entry point is missing.
    pub fn load(path: &Path) -> Result<Self, String> {
        let name =
            CString::new(path.as_os_str().as_bytes()).map_err(|e| format!("{}: {e}", path.display()))?;
        // SAFETY: the library's initialisers run; the entry point has the type that Android gives it.
        unsafe {
            // Symbols that the host does not have come from these.
            for fallback in [c"libm.so.6", c"libgcc_s.so.1"] {
                libc::dlopen(fallback.as_ptr(), libc::RTLD_NOW | libc::RTLD_GLOBAL);
            }
            // The app's own dependencies, which are this host, win over glibc.
            let handle = libc::dlopen(name.as_ptr(), libc::RTLD_NOW | libc::RTLD_DEEPBIND);
            if handle.is_null() {
                return Err(CStr::from_ptr(libc::dlerror()).to_string_lossy().into_owned());
            }
            let entry = libc::dlsym(handle, c"ANativeActivity_onCreate".as_ptr());
            if entry.is_null() {
                return Err(format!("{}: exports no ANativeActivity_onCreate", path.display()));
            }
            Ok(Self { on_create: std::mem::transmute::<*mut c_void, OnCreate>(entry) })
        }
    }
}

/// Turns this thread's looper for at most `longest` until `done`; says whether it is done.
pub fn pump(longest: Duration, mut done: impl FnMut() -> bool) -> bool {
    let (start, longest) = (Instant::now(), report::allowed(longest));
    while !done() {
        if start.elapsed() > longest {
            return false;
        }
        // SAFETY: asks for no answers.
        unsafe { ALooper_pollOnce(5, ptr::null_mut(), ptr::null_mut(), ptr::null_mut()) };
    }
    true
}

/// An activity and what the system lent it.
pub struct Activity {
    native: Box<ANativeActivity>,
    _callbacks: Box<ANativeActivityCallbacks>,
    _paths: CString,
    queue: Option<Box<AInputQueue>>,
    window: Option<*mut ANativeWindow>,
    /// The callback that took the longest so far.
    slowest: (&'static str, Duration),
}

impl Activity {
    /// Creates an activity with an intent, the app's folder, and what an earlier one saved.
    pub fn create(library: Library, intent: Intent, files: &Path, saved: &[u8]) -> Self {
        let paths = CString::new(files.as_os_str().as_bytes()).unwrap_or_default();
        let mut callbacks = Box::new(ANativeActivityCallbacks::default());
        let native = Box::new(ANativeActivity {
            callbacks: &raw mut *callbacks,
            vm: java::vm(),
            env: java::environment(),
            clazz: java::new_activity(intent),
            internalDataPath: paths.as_ptr(),
            externalDataPath: paths.as_ptr(),
            sdkVersion: bionic::api_level(),
            instance: ptr::null_mut(),
            assetManager: assets::MANAGER,
            obbPath: paths.as_ptr(),
        });
        let mut activity = Self {
            native,
            _callbacks: callbacks,
            _paths: paths,
            queue: None,
            window: None,
            slowest: ("", Duration::ZERO),
        };
        activity::begin(&raw mut *activity.native);
        let state = if saved.is_empty() { ptr::null() } else { saved.as_ptr() };
        activity.timed("onCreate", |native| {
            // SAFETY: the structure and the state outlive the call.
            unsafe { (library.on_create)(native, state.cast(), saved.len()) }
        });
        activity
    }

    fn timed<T>(&mut self, name: &'static str, call: impl FnOnce(*mut ANativeActivity) -> T) -> T {
        let watch = report::watch(name, HANG);
        let start = Instant::now();
        let result = java::callback(|| call(&raw mut *self.native));
        let time = start.elapsed();
        drop(watch);
        if time > self.slowest.1 {
            self.slowest = (name, time);
        }
        result
    }

    fn tell(&mut self, name: &'static str, callback: impl Fn(&ANativeActivityCallbacks) -> Told) {
        // SAFETY: the app's callbacks for this very activity.
        self.timed(name, |native| unsafe {
            callback(&*(*native).callbacks).map(|callback| callback(native))
        });
    }

    fn give<T>(
        &mut self,
        name: &'static str,
        what: T,
        callback: impl Fn(&ANativeActivityCallbacks) -> Given<T>,
    ) {
        // SAFETY: the app's callbacks for this very activity; what is given lives until it is taken back.
        self.timed(name, |native| unsafe {
            callback(&*(*native).callbacks).map(|callback| callback(native, what))
        });
    }

    /// `onStart`, and the input queue, which NativeActivity makes at the first start.
    pub fn start(&mut self) {
        self.tell("onStart", |callbacks| callbacks.onStart);
        if self.queue.is_none() {
            let mut queue = Box::new(AInputQueue::new());
            let lent = &raw mut *queue;
            self.queue = Some(queue);
            self.give("onInputQueueCreated", lent, |callbacks| callbacks.onInputQueueCreated);
        }
    }

    /// `onResume`.
    pub fn resume(&mut self) {
        self.tell("onResume", |callbacks| callbacks.onResume);
    }

    /// `onPause`.
    pub fn pause(&mut self) {
        self.tell("onPause", |callbacks| callbacks.onPause);
    }

    /// `onStop`.
    pub fn stop(&mut self) {
        self.tell("onStop", |callbacks| callbacks.onStop);
    }

    /// `onLowMemory`.
    pub fn low_memory(&mut self) {
        self.tell("onLowMemory", |callbacks| callbacks.onLowMemory);
    }

    /// `onConfigurationChanged`.
    pub fn configuration_changed(&mut self) {
        self.tell("onConfigurationChanged", |callbacks| callbacks.onConfigurationChanged);
    }

    /// `onWindowFocusChanged`.
    pub fn focus(&mut self, focused: bool) {
        self.give("onWindowFocusChanged", c_int::from(focused), |callbacks| callbacks.onWindowFocusChanged);
    }

    /// `onSaveInstanceState`: what the app wants back when it is created again.
    pub fn save(&mut self) -> Vec<u8> {
        self.timed("onSaveInstanceState", |native| {
            let mut size = 0;
            // SAFETY: the app allocates the state with malloc and gives it away.
            unsafe {
                let Some(callback) = (*(*native).callbacks).onSaveInstanceState else { return Vec::new() };
                let state = callback(native, &raw mut size);
                if state.is_null() {
                    return Vec::new();
                }
                let bytes = std::slice::from_raw_parts(state.cast::<u8>(), size).to_vec();
                libc::free(state);
                bytes
            }
        })
    }

    /// A window of `size` appears.
    pub fn create_window(&mut self, size: [u32; 2]) {
        configuration::set_size(size);
        let window = window::create(size);
        self.window = Some(window);
        self.give("onNativeWindowCreated", window, |callbacks| callbacks.onNativeWindowCreated);
        self.redraw();
    }

    /// The window goes; the app must have let go of it when the callback returns.
    pub fn destroy_window(&mut self) {
        if let Some(window) = self.window.take() {
            self.give("onNativeWindowDestroyed", window, |callbacks| callbacks.onNativeWindowDestroyed);
            window::take_back(window);
        }
    }

    /// The display turns or the window changes: new configuration, new size, new place for the content.
    pub fn resize(&mut self, size: [u32; 2], content: ARect) {
        configuration::set_size(size);
        self.configuration_changed();
        let Some(window) = self.window else { return };
        window::resize(window, size);
        self.give("onNativeWindowResized", window, |callbacks| callbacks.onNativeWindowResized);
        self.give("onContentRectChanged", &raw const content, |callbacks| callbacks.onContentRectChanged);
        self.redraw();
    }

    /// `onNativeWindowRedrawNeeded`: the system wants a new picture.
    pub fn redraw(&mut self) {
        let Some(window) = self.window else { return };
        self.give("onNativeWindowRedrawNeeded", window, |callbacks| callbacks.onNativeWindowRedrawNeeded);
    }

    /// The input queue, once the activity was started.
    pub fn input(&self) -> Option<&AInputQueue> {
        self.queue.as_deref()
    }

    /// Whether all events that were sent are finished.
    pub fn input_is_finished(&self) -> bool {
        self.queue.as_ref().is_none_or(|queue| queue.unfinished.load(Ordering::SeqCst) == 0)
    }

    /// Whether the app has something to show that it has not shown.
    pub fn is_busy(&self) -> bool {
        !self.input_is_finished() || activity::keeps_screen_on((&raw const *self.native).cast_mut())
    }

    /// Whether the app asked to be ended.
    pub fn is_finished(&self) -> bool {
        activity::is_finished((&raw const *self.native).cast_mut()) || java::is_finished(self.native.clazz)
    }

    /// The callback that took the longest, and how long.
    pub fn slowest(&self) -> (&'static str, Duration) {
        self.slowest
    }

    /// Takes everything back and destroys the activity; answers how long `onDestroy` took.
    pub fn destroy(mut self) -> Duration {
        self.destroy_window();
        if let Some(mut queue) = self.queue.take() {
            self.give("onInputQueueDestroyed", &raw mut *queue, |callbacks| callbacks.onInputQueueDestroyed);
            self.queue = Some(queue);
        }
        let start = Instant::now();
        self.tell("onDestroy", |callbacks| callbacks.onDestroy);
        let time = start.elapsed();
        activity::end(&raw mut *self.native);
        java::end_activity(self.native.clazz);
        time
    }
}
