//! JNI references: local ones, which belong to a frame of a thread, and global ones.

use std::collections::HashMap;
use std::ffi::c_void;
use std::sync::{Arc, LazyLock, Mutex};

use super::machine;
use super::object::{Object, Reference};
use crate::report;
use crate::sync::lock;

/// Kinds of references, numbered as `jobjectRefType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Until its frame ends.
    Local = 1,
    /// Until it is deleted.
    Global = 2,
    /// As global ones; nothing is ever collected here.
    Weak = 3,
}

struct Table {
    next: usize,
    objects: HashMap<usize, (Kind, Arc<Object>)>,
}

static TABLE: LazyLock<Mutex<Table>> =
    LazyLock::new(|| Mutex::new(Table { next: 0x1000, objects: HashMap::new() }));

/// A new reference to `object`; null stays null.
pub fn make(kind: Kind, object: Reference) -> *mut c_void {
    let Some(object) = object else { return std::ptr::null_mut() };
    let mut table = lock(&TABLE);
    table.next += 8;
    let handle = table.next;
    table.objects.insert(handle, (kind, object));
    drop(table);
    if kind == Kind::Local {
        machine::with_frames(|frames| match frames.last_mut() {
            Some(frame) => frame.push(handle),
            None => report::complain("a local reference was made on a thread without a frame".to_owned()),
        });
    }
    handle as *mut c_void
}

/// The object behind a reference; a reference that was deleted is complained of.
pub fn resolve(handle: *mut c_void) -> Reference {
    if handle.is_null() {
        return None;
    }
    let found = lock(&TABLE).objects.get(&(handle as usize)).map(|(_, object)| object.clone());
    if found.is_none() {
        report::complain(format!("reference {handle:p} was used after it was deleted"));
    }
    found
}

/// The kind of a reference, if it is one.
pub fn kind(handle: *mut c_void) -> Option<Kind> {
    lock(&TABLE).objects.get(&(handle as usize)).map(|(kind, _)| *kind)
}

/// Deletes a reference, which must be of this kind.
pub fn delete(kind: Kind, handle: *mut c_void) {
    if handle.is_null() {
        return;
    }
    let removed = lock(&TABLE).objects.remove(&(handle as usize));
    match removed {
        Some((found, _)) if found == kind => {}
        Some((found, _)) => report::complain(format!("a {found:?} reference was deleted as {kind:?}")),
        None => report::complain(format!("{kind:?} reference {handle:p} was deleted twice")),
    }
    if kind == Kind::Local {
        machine::with_frames(|frames| {
            for frame in frames.iter_mut() {
                frame.retain(|own| *own != handle as usize);
            }
        });
    }
}

/// Begins a frame of local references on this thread.
pub fn push_frame() {
    machine::with_frames(|frames| frames.push(Vec::new()));
}

/// Ends the last frame and all its references.
pub fn pop_frame() {
    match machine::with_frames(Vec::pop) {
        Some(frame) => forget(&frame),
        None => report::complain("a frame of local references was popped twice".to_owned()),
    }
}

/// Ends these references.
pub fn forget(handles: &[usize]) {
    let mut table = lock(&TABLE);
    for handle in handles {
        table.objects.remove(handle);
    }
}

/// Number of references of all threads, by kind: local, global and weak.
pub fn count() -> [usize; 3] {
    let table = lock(&TABLE);
    let of = |kind| table.objects.values().filter(|(k, _)| *k == kind).count();
    [of(Kind::Local), of(Kind::Global), of(Kind::Weak)]
}
