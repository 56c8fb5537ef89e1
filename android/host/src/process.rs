//! Statistics of this process: threads, file descriptors, memory.

/// Names of the threads.
pub fn threads() -> Vec<String> {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    tasks
        .filter_map(|task| std::fs::read_to_string(task.path().join("comm")).ok())
        .map(|name| name.trim().to_owned())
        .collect()
}

/// Targets of the open file descriptors.
pub fn descriptors() -> Vec<String> {
    let links = std::fs::read_dir("/proc/self/fd").into_iter().flatten().flatten();
    // The descriptor by which the folder itself is read is closed when its link is read.
    let mut targets: Vec<String> = links
        .filter_map(|link| std::fs::read_link(link.path()).ok())
        .map(|target| target.to_string_lossy().into_owned())
        .filter(|target| !target.starts_with("/proc/"))
        .collect();
    targets.sort();
    targets
}

/// Memory use of the process in bytes.
#[derive(Clone, Copy, Debug)]
pub struct Memory {
    /// Heap memory in use: all arenas of malloc, and its mapped blocks.
    pub heap: u64,
    /// Resident memory.
    pub resident: u64,
}

impl Memory {
    /// The present memory use, after glibc has returned freed memory to the system.
    pub fn now() -> Self {
        // SAFETY: the function has no preconditions.
        unsafe { libc::malloc_trim(0) };
        // SAFETY: both functions only query.
        let (heap, page) = unsafe { (libc::mallinfo2(), libc::sysconf(libc::_SC_PAGESIZE)) };
        let statm = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
        let pages: u64 = statm.split_whitespace().nth(1).and_then(|n| n.parse().ok()).unwrap_or(0);
        Self { heap: (heap.uordblks + heap.hblkhd) as u64, resident: pages * page as u64 }
    }
}
