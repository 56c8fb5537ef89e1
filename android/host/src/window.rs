//! `ANativeWindow`: size, producer, and the pictures that the app draws without Vulkan.
//!
//! As on Android, a window has one producer at a time. An app that has drawn with the CPU stays the producer until the
//! window is destroyed, and a Vulkan surface can then not be created for it.

use std::collections::HashMap;
use std::ffi::{c_int, c_void};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{LazyLock, Mutex};

use crate::picture::Picture;
use crate::report;
use crate::sync::lock;

/// Opaque to the app; the address is the number of the window.
pub type ANativeWindow = c_void;

/// The producer of a window's pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Producer {
    Nobody,
    Vulkan,
    Cpu,
}

struct Window {
    size: [u32; 2],
    /// Size of the buffers, where the app has set it (`ANativeWindow_setBuffersGeometry`).
    geometry: Option<[u32; 2]>,
    format: i32,
    owners: u32,
    producer: Producer,
    is_taken_back: bool,
    /// The buffer that the app has locked for drawing.
    locked: Option<Vec<u32>>,
}

const FORMAT_RGBA: i32 = 1;
const FORMAT_RGBX: i32 = 2;

static WINDOWS: LazyLock<Mutex<HashMap<usize, Window>>> = LazyLock::new(Mutex::default);
static POSTED: Mutex<Option<Picture>> = Mutex::new(None);
static POSTS: AtomicU64 = AtomicU64::new(0);

/// Creates a window, which the system holds.
pub fn create(size: [u32; 2]) -> *mut ANativeWindow {
    static NEXT: AtomicU64 = AtomicU64::new(0x1000);
    let number = NEXT.fetch_add(0x10, Ordering::SeqCst) as usize;
    let window = Window {
        size,
        geometry: None,
        format: FORMAT_RGBX,
        owners: 1,
        producer: Producer::Nobody,
        is_taken_back: false,
        locked: None,
    };
    lock(&WINDOWS).insert(number, window);
    number as *mut ANativeWindow
}

/// Changes the size of the window in pixels.
pub fn resize(window: *mut ANativeWindow, size: [u32; 2]) {
    with(window, "resize", |window| window.size = size);
}

/// The system has released the window.
pub fn is_taken_back(window: *mut ANativeWindow) -> bool {
    lock(&WINDOWS).get(&(window as usize)).is_none_or(|window| window.is_taken_back)
}

/// Releases the window by the system; it exists as long as the app holds it.
pub fn take_back(window: *mut ANativeWindow) {
    with(window, "take back", |window| window.is_taken_back = true);
    release(window);
}

fn release(window: *mut ANativeWindow) {
    // SAFETY: the number is looked up, not dereferenced.
    unsafe { ANativeWindow_release(window) }
}

/// Number of windows with a holder.
pub fn held() -> usize {
    lock(&WINDOWS).len()
}

/// Size in pixels, where the window still exists.
pub fn size(window: *mut ANativeWindow) -> Option<[u32; 2]> {
    lock(&WINDOWS).get(&(window as usize)).map(|window| window.size)
}

/// Makes Vulkan the producer; returns whether that is possible.
pub fn connect_vulkan(window: *mut ANativeWindow) -> bool {
    with(window, "vkCreateAndroidSurfaceKHR", |window| {
        let free = window.producer == Producer::Nobody;
        if free {
            window.producer = Producer::Vulkan;
            window.owners += 1;
        }
        free
    })
    .unwrap_or(false)
}

/// Ends the production by Vulkan.
pub fn disconnect_vulkan(window: *mut ANativeWindow) {
    with(window, "vkDestroySurfaceKHR", |window| window.producer = Producer::Nobody);
    release(window);
}

/// Number of pictures that were drawn without Vulkan.
pub fn posts() -> u64 {
    POSTS.load(Ordering::SeqCst)
}

/// The last picture that was drawn without Vulkan.
pub fn posted() -> Option<Picture> {
    lock(&POSTED).clone()
}

fn with<T>(window: *mut ANativeWindow, what: &str, act: impl FnOnce(&mut Window) -> T) -> Option<T> {
    let mut windows = lock(&WINDOWS);
    let found = windows.get_mut(&(window as usize)).map(act);
    if found.is_none() {
        report::complain(format!("{what} with a window that nobody holds any more"));
    }
    found
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ANativeWindow_acquire(window: *mut ANativeWindow) {
    with(window, "ANativeWindow_acquire", |window| window.owners += 1);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ANativeWindow_release(window: *mut ANativeWindow) {
    let owners = with(window, "ANativeWindow_release", |window| {
        window.owners -= 1;
        window.owners
    });
    if owners == Some(0) {
        lock(&WINDOWS).remove(&(window as usize));
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ANativeWindow_getWidth(window: *mut ANativeWindow) -> i32 {
    with(window, "ANativeWindow_getWidth", |window| window.size[0] as i32).unwrap_or(-libc::EINVAL)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ANativeWindow_getHeight(window: *mut ANativeWindow) -> i32 {
    with(window, "ANativeWindow_getHeight", |window| window.size[1] as i32).unwrap_or(-libc::EINVAL)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ANativeWindow_getFormat(window: *mut ANativeWindow) -> i32 {
    with(window, "ANativeWindow_getFormat", |window| window.format).unwrap_or(-libc::EINVAL)
}

/// Sets the size and the format of buffers; zeros mean those of the window.
#[unsafe(no_mangle)]
unsafe extern "C" fn ANativeWindow_setBuffersGeometry(
    window: *mut ANativeWindow,
    width: i32,
    height: i32,
    format: i32,
) -> i32 {
    if !matches!(format, 0 | FORMAT_RGBA | FORMAT_RGBX)
        || (width == 0) != (height == 0)
        || width < 0
        || height < 0
    {
        report::complain(format!("ANativeWindow_setBuffersGeometry: {width}x{height}, format {format}"));
        return -libc::EINVAL;
    }
    with(window, "ANativeWindow_setBuffersGeometry", |window| {
        window.geometry = (width > 0).then_some([width as u32, height as u32]);
        window.format = if format == 0 { FORMAT_RGBX } else { format };
        0
    })
    .unwrap_or(-libc::EINVAL)
}

/// Accepts any transform: presented pictures are read before it is applied.
#[unsafe(no_mangle)]
extern "C" fn ANativeWindow_setBuffersTransform(_window: *mut ANativeWindow, _transform: i32) -> i32 {
    0
}

#[repr(C)]
struct ANativeWindow_Buffer {
    width: i32,
    height: i32,
    /// Length of a row in pixels.
    stride: i32,
    format: i32,
    bits: *mut c_void,
    reserved: [u32; 6],
}

/// Length of a row for a width, both in pixels; longer than the picture, as with real drivers.
fn stride(width: u32) -> u32 {
    width.next_multiple_of(16) + 16
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ANativeWindow_lock(
    window: *mut ANativeWindow,
    buffer: *mut ANativeWindow_Buffer,
    _dirty: *mut c_void,
) -> i32 {
    with(window, "ANativeWindow_lock", |window| {
        if window.producer == Producer::Vulkan || window.locked.is_some() {
            return -libc::EINVAL;
        }
        window.producer = Producer::Cpu;
        let [width, height] = window.geometry.unwrap_or(window.size);
        let stride = stride(width);
        let bits = window.locked.insert(vec![0; (stride * height) as usize]).as_mut_ptr();
        *buffer = ANativeWindow_Buffer {
            width: width as i32,
            height: height as i32,
            stride: stride as i32,
            format: window.format,
            bits: bits.cast(),
            reserved: [0; 6],
        };
        0
    })
    .unwrap_or(-libc::EINVAL)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ANativeWindow_unlockAndPost(window: *mut ANativeWindow) -> c_int {
    with(window, "ANativeWindow_unlockAndPost", |window| {
        let Some(pixels) = window.locked.take() else { return -libc::EINVAL };
        let [width, height] = window.geometry.unwrap_or(window.size);
        let rows = pixels.chunks_exact(stride(width) as usize).flat_map(|row| &row[..width as usize]);
        let rgb = rows.flat_map(|pixel| pixel.to_ne_bytes().into_iter().take(3)).collect();
        *lock(&POSTED) = Some(Picture { width, height, rgb });
        POSTS.fetch_add(1, Ordering::SeqCst);
        0
    })
    .unwrap_or(-libc::EINVAL)
}
