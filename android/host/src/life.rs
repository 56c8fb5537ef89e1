//! Drives the life cycle of an activity as the Java side does: calls the callbacks of `ANativeActivity` in their order,
//! with their arguments, and limits their time.

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

/// Time limit of a callback, after which the run is ended.
const HANG: Duration = Duration::from_secs(60);

/// The loaded library of the app, by the entry point that creates its activity.
#[derive(Clone, Copy)]
pub struct Library {
    on_create: OnCreate,
}

impl Library {
    /// Loads the library and resolves all symbols at once, as Android does.
    ///
    /// # Errors
    /// The dynamic linker failed, or the library has no entry point.
    pub fn load(path: &Path) -> Result<Self, String> {
        let name =
            CString::new(path.as_os_str().as_bytes()).map_err(|e| format!("{}: {e}", path.display()))?;
        // SAFETY: runs the library's initialisers; the entry point has the type that Android defines.
        unsafe {
            // Libraries that define the remaining symbols.
            for fallback in [c"libm.so.6", c"libgcc_s.so.1"] {
                libc::dlopen(fallback.as_ptr(), libc::RTLD_NOW | libc::RTLD_GLOBAL);
            }
            // With RTLD_DEEPBIND, the app's own dependencies, which are this library, take precedence over glibc.
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

/// Polls this thread's looper until `done` or for at most `longest`; returns whether it is done.
pub fn pump(longest: Duration, mut done: impl FnMut() -> bool) -> bool {
    let (start, longest) = (Instant::now(), report::allowed(longest));
    while !done() {
        if start.elapsed() > longest {
            return false;
        }
        // SAFETY: null pointers are allowed for results that are not needed.
        unsafe { ALooper_pollOnce(5, ptr::null_mut(), ptr::null_mut(), ptr::null_mut()) };
    }
    true
}

/// An activity and the objects that the system gives it.
pub struct Activity {
    native: Box<ANativeActivity>,
    _callbacks: Box<ANativeActivityCallbacks>,
    _paths: CString,
    queue: Option<Box<AInputQueue>>,
    window: Option<*mut ANativeWindow>,
    /// Name and time of the callback that took the longest.
    slowest: (&'static str, Duration),
}

impl Activity {
    /// Creates an activity with an intent, the app's folder, and the state that an earlier activity saved.
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
        // SAFETY: a callback that the app set for this activity.
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
        // SAFETY: a callback that the app set for this activity; its argument lives until it is destroyed below.
        self.timed(name, |native| unsafe {
            callback(&*(*native).callbacks).map(|callback| callback(native, what))
        });
    }

    /// Calls `onStart`, and at the first start hands over the input queue, as NativeActivity does.
    pub fn start(&mut self) {
        self.tell("onStart", |callbacks| callbacks.onStart);
        if self.queue.is_none() {
            let mut queue = Box::new(AInputQueue::new());
            let lent = &raw mut *queue;
            self.queue = Some(queue);
            self.give("onInputQueueCreated", lent, |callbacks| callbacks.onInputQueueCreated);
        }
    }

    /// Calls `onResume`.
    pub fn resume(&mut self) {
        self.tell("onResume", |callbacks| callbacks.onResume);
    }

    /// Calls `onPause`.
    pub fn pause(&mut self) {
        self.tell("onPause", |callbacks| callbacks.onPause);
    }

    /// Tells the activity that it is no longer visible: calls `onStop`.
    pub fn stop(&mut self) {
        self.tell("onStop", |callbacks| callbacks.onStop);
    }

    /// Calls `onLowMemory`.
    pub fn low_memory(&mut self) {
        self.tell("onLowMemory", |callbacks| callbacks.onLowMemory);
    }

    /// Calls `onConfigurationChanged`.
    pub fn configuration_changed(&mut self) {
        self.tell("onConfigurationChanged", |callbacks| callbacks.onConfigurationChanged);
    }

    /// Calls `onWindowFocusChanged`.
    pub fn focus(&mut self, focused: bool) {
        self.give("onWindowFocusChanged", c_int::from(focused), |callbacks| callbacks.onWindowFocusChanged);
    }

    /// Calls `onSaveInstanceState`; returns the state for the next creation.
    pub fn save(&mut self) -> Vec<u8> {
        self.timed("onSaveInstanceState", |native| {
            let mut size = 0;
            // SAFETY: the app allocated the state with malloc and gave up its ownership.
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

    /// Creates a window of `size` pixels.
    pub fn create_window(&mut self, size: [u32; 2]) {
        configuration::set_size(size);
        let window = window::create(size);
        self.window = Some(window);
        self.give("onNativeWindowCreated", window, |callbacks| callbacks.onNativeWindowCreated);
        self.redraw();
    }

    /// Destroys the window, which the app must have released when the callback returns.
    pub fn destroy_window(&mut self) {
        if let Some(window) = self.window.take() {
            self.give("onNativeWindowDestroyed", window, |callbacks| callbacks.onNativeWindowDestroyed);
            window::take_back(window);
        }
    }

    /// Resizes or rotates the window: changes configuration, size and content rectangle.
    pub fn resize(&mut self, size: [u32; 2], content: ARect) {
        configuration::set_size(size);
        self.configuration_changed();
        let Some(window) = self.window else { return };
        window::resize(window, size);
        self.give("onNativeWindowResized", window, |callbacks| callbacks.onNativeWindowResized);
        self.give("onContentRectChanged", &raw const content, |callbacks| callbacks.onContentRectChanged);
        self.redraw();
    }

    /// Calls `onNativeWindowRedrawNeeded`.
    pub fn redraw(&mut self) {
        let Some(window) = self.window else { return };
        self.give("onNativeWindowRedrawNeeded", window, |callbacks| callbacks.onNativeWindowRedrawNeeded);
    }

    /// The input queue; `None` before the first start.
    pub fn input(&self) -> Option<&AInputQueue> {
        self.queue.as_deref()
    }

    /// All events that were sent are finished.
    pub fn input_is_finished(&self) -> bool {
        self.queue.as_ref().is_none_or(|queue| queue.unfinished.load(Ordering::SeqCst) == 0)
    }

    /// Input events are not finished, or the app keeps the screen on because its frames change.
    pub fn is_busy(&self) -> bool {
        !self.input_is_finished() || activity::keeps_screen_on((&raw const *self.native).cast_mut())
    }

    /// The app has asked to be finished.
    pub fn is_finished(&self) -> bool {
        activity::is_finished((&raw const *self.native).cast_mut()) || java::is_finished(self.native.clazz)
    }

    /// Name and time of the callback that took the longest.
    pub fn slowest(&self) -> (&'static str, Duration) {
        self.slowest
    }

    /// Destroys window, input queue and activity; returns the time that `onDestroy` took.
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
