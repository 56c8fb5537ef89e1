//! What the kernel and glibc say about this process: threads, descriptors, memory.

/// Names of the threads, as the kernel has them.
pub fn threads() -> Vec<String> {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    tasks
        .filter_map(|task| std::fs::read_to_string(task.path().join("comm")).ok())
        .map(|name| name.trim().to_owned())
        .collect()
}

/// What the open file descriptors lead to.
pub fn descriptors() -> Vec<String> {
    let links = std::fs::read_dir("/proc/self/fd").into_iter().flatten().flatten();
    // The folder that is read here is gone when its link is looked at by name.
    let mut targets: Vec<String> = links
        .filter_map(|link| std::fs::read_link(link.path()).ok())
        .map(|target| target.to_string_lossy().into_owned())
        .filter(|target| !target.starts_with("/proc/"))
        .collect();
    targets.sort();
    targets
}

/// Memory of the process, in bytes.
#[derive(Clone, Copy, Debug)]
pub struct Memory {
    /// In use by the heap: all arenas of malloc, and what it maps by the piece.
    pub heap: u64,
    /// Resident.
    pub resident: u64,
}

impl Memory {
    /// Of this moment, after what glibc keeps of freed memory was given back.
    pub fn now() -> Self {
        // SAFETY: no conditions.
        unsafe { libc::malloc_trim(0) };
        // SAFETY: both are queries without arguments that matter.
        let (heap, page) = unsafe { (libc::mallinfo2(), libc::sysconf(libc::_SC_PAGESIZE)) };
        let statm = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
        let pages: u64 = statm.split_whitespace().nth(1).and_then(|n| n.parse().ok()).unwrap_or(0);
        Self { heap: (heap.uordblks + heap.hblkhd) as u64, resident: pages * page as u64 }
    }
}
