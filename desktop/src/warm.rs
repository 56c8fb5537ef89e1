//! `glimpse warm`: compiles the kernels of scenes, so that later runs find them in the driver's cache.

use glimpse::{Gpu, Purpose, Renderer};
use glimpse_measure::output::Verbosity;

use crate::args::{Size, WarmOptions};
use crate::focus::FrameRequest;
use crate::measure::Workbench;
use crate::output;
use crate::progress::Progress;
use crate::scene_file;

/// Runs `glimpse warm`.
pub fn run(options: &WarmOptions, adapter: Option<&str>, verbosity: Verbosity) -> anyhow::Result<()> {
    let request = |method: &_| FrameRequest::beside(&options.frame, *method);
    let requests = options.methods.iter().map(request).collect::<glimpse::Result<Vec<_>>>()?;
    options.scenes.iter().try_for_each(scene_file::check)?;
    options.frame.environment.surroundings().check()?;
    let Size(size) = options.size;
    let gpu = Gpu::headless(adapter)?;
    for name in &options.scenes {
        let progress = Progress::new(verbosity, 0);
        let workbench = Workbench::set(&gpu, name, &options.frame, &requests, &progress)?;
        let purposes = [Purpose::Preview, Purpose::Frame, Purpose::Counters];
        let mut compiled = 0;
        for settings in &workbench.methods {
            for purpose in purposes {
                let mut kernels = Renderer::compilation(&gpu, &workbench.scene, size, settings, purpose)?;
                compiled += kernels.total();
                progress.steps(kernels.total() as u64);
                while kernels.remaining() > 0 {
                    progress.doing(&format!("compiling for {}", settings.method.name()));
                    kernels.compile_next()?;
                    progress.step();
                }
            }
        }
        drop(progress);
        if verbosity != Verbosity::Quiet {
            let methods: Vec<_> = workbench.methods.iter().map(|settings| settings.method.name()).collect();
            let kernels = output::counted(compiled, "kernel");
            output::print(&format!("{}: {kernels} of {}\n", name.display(), methods.join(", ")))?;
        }
    }
    Ok(())
}
