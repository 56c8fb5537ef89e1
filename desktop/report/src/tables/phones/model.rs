//! The cost model: a roofline (Williams, Waterman, Patterson 2009, "Roofline: an insightful visual
//! performance model").
//!
//! A pass takes the longer of the times for its arithmetic and for its memory traffic:
//!
//! ```text
//! t = max(operations / (share x peak operations), (frame bytes + missed x scene bytes) / (share x peak bandwidth))
//! ```

use glimpse::Demand;

/// Peak rates of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Device {
    /// Billions of operations per second.
    pub gflops: f64,
    /// Billions of bytes per second.
    pub gigabytes: f64,
}

/// Shares of its peak rates that a device reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Share of the peak operations that is reached.
    pub arithmetic: f64,
    /// Share of the peak bandwidth that is reached.
    pub bandwidth: f64,
    /// Share of the scene bytes that miss the caches and come from memory.
    pub missed: f64,
}

/// What limits a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Arithmetic throughput.
    Arithmetic,
    /// Memory bandwidth.
    Memory,
}

/// Milliseconds of a pass, and what limits it.
pub fn milliseconds(load: &Demand, device: Device, reach: Reach) -> (f64, Bound) {
    // Billions per second are millions per millisecond.
    let arithmetic = load.operations / (device.gflops * reach.arithmetic) * 1e-6;
    let bytes = load.frame_bytes + reach.missed * load.scene_bytes;
    let memory = bytes / (device.gigabytes * reach.bandwidth) * 1e-6;
    if memory > arithmetic { (memory, Bound::Memory) } else { (arithmetic, Bound::Arithmetic) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOAD: Demand = Demand { operations: 40e9, scene_bytes: 8e9, frame_bytes: 0.2e9 };
    const PHONE: Device = Device { gflops: 1000.0, gigabytes: 50.0 };
    const REACH: Reach = Reach { arithmetic: 0.2, bandwidth: 0.8, missed: 0.1 };

    #[test]
    fn a_pass_takes_the_longer_of_its_two_times() {
        // 40 billion at 200 billion a second: 200 ms. 0.2 + 0.8 billion bytes at 40 billion a second: 25 ms.
        let (ms, bound) = milliseconds(&LOAD, PHONE, REACH);
        assert!((ms - 200.0).abs() < 1e-9 && bound == Bound::Arithmetic, "{ms}");
        let (ms, bound) = milliseconds(&LOAD, Device { gigabytes: 5.0, ..PHONE }, REACH);
        assert!((ms - 250.0).abs() < 1e-9 && bound == Bound::Memory, "{ms}");
        assert_eq!(milliseconds(&Demand::default(), PHONE, REACH).0, 0.0);
    }

    #[test]
    fn more_work_or_less_of_a_device_is_never_faster() {
        let time = |load: &Demand, device, reach| milliseconds(load, device, reach).0;
        // Where arithmetic decides, and where memory does.
        for gigabytes in [50.0, 5.0] {
            let device = Device { gigabytes, ..PHONE };
            let base = time(&LOAD, device, REACH);
            let slower = [
                time(&Demand { operations: 90e9, ..LOAD }, device, REACH),
                time(&Demand { scene_bytes: 90e9, ..LOAD }, device, REACH),
                time(&Demand { frame_bytes: 9e9, ..LOAD }, device, REACH),
                time(&LOAD, Device { gflops: 500.0, ..device }, REACH),
                time(&LOAD, Device { gigabytes: 0.5 * gigabytes, ..device }, REACH),
                time(&LOAD, device, Reach { arithmetic: 0.1, ..REACH }),
                time(&LOAD, device, Reach { bandwidth: 0.4, ..REACH }),
                time(&LOAD, device, Reach { missed: 0.9, ..REACH }),
            ];
            assert!(slower.iter().all(|ms| *ms >= base), "{gigabytes}: {slower:?}");
            assert!(slower.iter().filter(|ms| **ms > base).count() >= 3, "{gigabytes}: {slower:?}");
        }
    }
}
