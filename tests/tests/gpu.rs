//! Tests that render, on the best adapter. Without one they fail: `sh desktop/setup.sh` installs lavapipe.

mod gpu {
    mod adaptive;
    mod agreement;
    mod ahead;
    mod checks;
    mod closed_forms;
    mod coverage;
    mod cpu_tracer;
    mod denoise;
    mod device;
    mod embedding;
    mod environment;
    mod extended;
    mod eyes;
    mod media;
    mod minray;
    mod mip;
    mod path;
    mod postcorrect;
    mod renderer;
    mod scenes;
    mod sequences;
    mod sides;
    mod stress;
    mod supersample;
    mod terminator;
    mod traversal;
}
