//! `--cpu-threads`: CPU threads that trace samples of paths alongside the GPU.

use std::panic::resume_unwind;
use std::thread;
use std::time::{Duration, Instant};

use glimpse::cpu_tracer::{Accumulator, View, Worker};
use glimpse::reference::Reference;
use glimpse::{Camera, Error, Renderer};
use serde::Serialize;

use crate::focus::FrameRequest;

/// Samples contributed by the GPU and by each CPU thread to a picture, and how busy they were.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sides {
    /// Elapsed time until the picture was complete, in milliseconds.
    pub wall_ms: f64,
    /// Samples per pixel and second of GPU and CPU together.
    pub samples_per_s: f64,
    /// Contribution of the GPU.
    pub gpu: Side,
    /// Contribution of each CPU thread.
    pub cpu_threads: Vec<Side>,
    /// Samples of the CPU threads that were unfinished and discarded when the picture was complete.
    pub given_up: u64,
}

/// Contribution of the GPU or of a CPU thread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Side {
    /// Completed samples per pixel.
    pub samples: u32,
    /// Share of the elapsed time spent tracing, 0 to 1.
    pub utilisation: f64,
}

/// Checks that samples remain for the CPU threads, as the GPU alone renders the `frames` timed frames.
///
/// # Errors
/// Fails if the timed frames take all samples.
pub fn check(requests: &[FrameRequest], frames: u32) -> glimpse::Result<()> {
    // One more frame warms up the GPU: drivers finish compiling in it.
    let alone = frames.saturating_add(1);
    let all = requests.iter().map(|request| &request.settings.paths);
    let idle = all.into_iter().find(|paths| paths.cpu_threads > 0 && paths.samples <= alone);
    idle.map_or(Ok(()), |paths| {
        let expected = format!("more than the {alone} of the timed frames, with --cpu-threads");
        Err(Error::setting("samples", expected, paths.samples.to_string()))
    })
}

/// A path traced picture that has only some of its samples.
pub struct Unfinished<'a> {
    /// Renderer of the picture.
    pub renderer: &'a mut Renderer,
    /// Camera of the picture.
    pub camera: &'a Camera,
    /// Width and height of one eye's picture in pixels.
    pub size: [u32; 2],
    /// Scene for the CPU threads; `None` without them.
    pub reference: Option<&'a Reference>,
    /// Number of CPU threads.
    pub cpu_threads: u32,
}

impl Unfinished<'_> {
    /// Renders exactly the samples that the picture is to have, however many frames were timed. Returns
    /// `None` if no samples remained for the CPU threads. `doing` is called with the number of samples so
    /// far.
    ///
    /// # Errors
    /// Fails if the device fails.
    pub fn finish(self, doing: impl Fn(u32)) -> glimpse::Result<Option<Sides>> {
        let Self { renderer, camera, size, reference, cpu_threads } = self;
        if !renderer.settings().method.is_path_traced() {
            return Ok(None);
        }
        let wanted = renderer.settings().paths.samples;
        if renderer.samples() > wanted {
            // More frames were timed than the picture has samples.
            renderer.restart();
            (0..wanted).try_for_each(|_| renderer.render(camera).map(drop))?;
        }
        if renderer.is_settled() {
            return Ok(None);
        }
        let picture = renderer.settings().method.picture(size);
        let view = View::new(camera, picture, renderer.settings());
        let (accumulator, workers) = Accumulator::new(&view, cpu_threads as usize);
        let start = Instant::now();
        thread::scope(|scope| {
            // If an error leaves this scope early, dropping the accumulator ends the threads.
            let mut accumulator = accumulator;
            let threads: Vec<_> = match reference {
                Some(scene) => {
                    workers.into_iter().map(|worker| scope.spawn(move || trace(worker, scene))).collect()
                }
                None => Vec::new(),
            };
            let (mut samples, mut gpu_ms) = (0, 0.0);
            while !renderer.is_settled() {
                doing(renderer.samples());
                gpu_ms += renderer.render(camera)?.ms;
                samples += 1;
                if cpu_threads > 0 {
                    renderer.accumulate(&mut accumulator)?;
                }
            }
            accumulator.finish();
            if cpu_threads > 0 {
                renderer.accumulate(&mut accumulator)?;
            }
            let wall = start.elapsed();
            let busy = threads.into_iter().map(|t| t.join().unwrap_or_else(|panic| resume_unwind(panic)));
            Ok(Some(Sides::of(samples, gpu_ms, &accumulator, busy, wall)))
        })
    }
}

/// Traces until the picture is complete and returns the time spent tracing.
fn trace(mut worker: Worker, reference: &Reference) -> Duration {
    let mut busy = Duration::ZERO;
    loop {
        let start = Instant::now();
        if !worker.step(reference) {
            return busy;
        }
        busy += start.elapsed();
    }
}

impl Sides {
    fn of(
        samples: u32,
        gpu_ms: f64,
        accumulator: &Accumulator,
        busy: impl Iterator<Item = Duration>,
        wall: Duration,
    ) -> Self {
        let wall_s = wall.as_secs_f64();
        let of_core =
            |(samples, busy): (u32, Duration)| Side { samples, utilisation: busy.as_secs_f64() / wall_s };
        let merged: u32 = accumulator.samples().iter().sum();
        Self {
            wall_ms: 1000.0 * wall_s,
            samples_per_s: f64::from(samples.saturating_add(merged)) / wall_s,
            gpu: Side { samples, utilisation: gpu_ms / (1000.0 * wall_s) },
            cpu_threads: accumulator.samples().into_iter().zip(busy).map(of_core).collect(),
            given_up: accumulator.sample_counts().given_up,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glimpse::Method;

    use crate::args::FrameOptions;

    fn request(samples: u32, cpu_threads: u32) -> FrameRequest {
        let options = FrameOptions::default().with("samples", &samples.to_string());
        let options =
            options.and_then(|options| options.with("cpu-threads", &cpu_threads.to_string())).unwrap();
        FrameRequest::of(&options, Method::Path).unwrap()
    }

    #[test]
    fn cores_without_samples_to_bring_are_told() {
        for fine in [request(1, 0), request(5, 2)] {
            assert!(check(&[fine], 3).is_ok());
        }
        let error = check(&[request(5, 2), request(4, 2)], 3).unwrap_err().to_string();
        assert_eq!(
            error,
            "samples: expected more than the 4 of the timed frames, with --cpu-threads, found 4"
        );
    }

    #[test]
    fn shares_are_of_the_time_that_both_took() {
        let options = FrameOptions::default();
        let camera = *glimpse::scene::builtin("cornell").unwrap().camera(None).unwrap();
        let settings = options.settings(Method::Path).unwrap();
        let (accumulator, _workers) = Accumulator::new(&View::new(&camera, [4, 3], &settings), 2);
        let busy = [1000, 500].map(Duration::from_millis).into_iter();
        let sides = Sides::of(6, 1500.0, &accumulator, busy, Duration::from_secs(2));
        let text = "GPU 6 samples (75 % busy), CPU thread 0 0 samples (50 % busy), CPU thread 1 0 samples (25 % busy) in 2000 ms, \
                    3.000 samples/s";
        assert_eq!(crate::summary::sides(&sides), text);
    }

    #[test]
    fn cores_trace_paths_alone() {
        let options = FrameOptions::default().with("cpu-threads", "2").unwrap();
        let error = FrameRequest::of(&options, Method::Adaptive).unwrap_err().to_string();
        let expected = "0 with method adaptive: only path and vr add samples up";
        assert_eq!(error, format!("cpu-threads: expected {expected}, found 2"));
        let beside = |method| FrameRequest::beside(&options, method).unwrap().settings.paths.cpu_threads;
        assert_eq!([Method::Full, Method::Path].map(beside), [0, 2]);
    }
}
