//! `AAssetManager`, which reads the `assets` folder of the unpacked package.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::PathBuf;
use std::sync::Mutex;

use crate::sync::lock;

/// The address of the process's only asset manager; never dereferenced.
pub const MANAGER: *mut c_void = 0x10 as *mut c_void;

static FOLDER: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Sets the folder of the assets; without one, no asset is found.
pub fn open(folder: Option<PathBuf>) {
    *lock(&FOLDER) = folder;
}

/// An open asset file: its bytes and the position of the next read.
pub struct AAsset {
    bytes: Vec<u8>,
    position: usize,
}

/// An open asset folder: the names of its files.
pub struct AAssetDir {
    names: Vec<CString>,
    next: usize,
}

/// The path of an asset, whose name must be relative and without `..`.
unsafe fn path(name: *const c_char) -> Option<PathBuf> {
    let name = CStr::from_ptr(name).to_str().ok()?;
    let climbs = name.starts_with('/') || name.split('/').any(|part| part == "..");
    Some(lock(&FOLDER).as_ref()?.join(name)).filter(|_| !climbs)
}

#[unsafe(no_mangle)]
extern "C" fn AAssetManager_fromJava(_environment: *mut c_void, _manager: *mut c_void) -> *mut c_void {
    MANAGER
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAssetManager_open(
    _manager: *mut c_void,
    name: *const c_char,
    _mode: c_int,
) -> *mut AAsset {
    match path(name).and_then(|path| std::fs::read(path).ok()) {
        Some(bytes) => Box::into_raw(Box::new(AAsset { bytes, position: 0 })),
        None => std::ptr::null_mut(),
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAsset_close(asset: *mut AAsset) {
    drop(Box::from_raw(asset));
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAsset_getBuffer(asset: *mut AAsset) -> *const c_void {
    (*asset).bytes.as_ptr().cast()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAsset_getLength64(asset: *mut AAsset) -> i64 {
    (*asset).bytes.len() as i64
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAsset_getRemainingLength64(asset: *mut AAsset) -> i64 {
    ((*asset).bytes.len() - (*asset).position) as i64
}

#[unsafe(no_mangle)]
extern "C" fn AAsset_isAllocated(_asset: *mut AAsset) -> c_int {
    1
}

/// Always fails, as on Android for compressed assets, which have no file descriptor.
#[unsafe(no_mangle)]
extern "C" fn AAsset_openFileDescriptor64(_asset: *mut AAsset, _start: *mut i64, _length: *mut i64) -> c_int {
    -1
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAsset_read(asset: *mut AAsset, buffer: *mut c_void, count: usize) -> c_int {
    let AAsset { bytes, position } = &mut *asset;
    let rest = &bytes[*position..];
    let taken = count.min(rest.len());
    std::ptr::copy_nonoverlapping(rest.as_ptr(), buffer.cast(), taken);
    *position += taken;
    taken as c_int
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAsset_seek64(asset: *mut AAsset, offset: i64, whence: c_int) -> i64 {
    let AAsset { bytes, position } = &mut *asset;
    let from = match whence {
        libc::SEEK_CUR => *position as i64,
        libc::SEEK_END => bytes.len() as i64,
        _ => 0,
    };
    let to = from + offset;
    if !(0..=bytes.len() as i64).contains(&to) {
        return -1;
    }
    *position = to as usize;
    to
}

/// Opens a folder to list its files, without its folders, as on Android.
#[unsafe(no_mangle)]
unsafe extern "C" fn AAssetManager_openDir(_manager: *mut c_void, name: *const c_char) -> *mut AAssetDir {
    let entries = path(name).and_then(|path| std::fs::read_dir(path).ok()).into_iter().flatten().flatten();
    let files = entries.filter(|entry| entry.path().is_file());
    let mut names: Vec<CString> =
        files.filter_map(|file| CString::new(file.file_name().into_encoded_bytes()).ok()).collect();
    names.sort();
    Box::into_raw(Box::new(AAssetDir { names, next: 0 }))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAssetDir_getNextFileName(folder: *mut AAssetDir) -> *const c_char {
    let AAssetDir { names, next } = &mut *folder;
    *next += 1;
    names.get(*next - 1).map_or(std::ptr::null(), |name| name.as_ptr())
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAssetDir_rewind(folder: *mut AAssetDir) {
    (*folder).next = 0;
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AAssetDir_close(folder: *mut AAssetDir) {
    drop(Box::from_raw(folder));
}
