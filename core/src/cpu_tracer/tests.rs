//! Tests that interleave the workers' steps on one thread; the order of the steps stands for the speed of the CPU
//! threads.

use glam::DVec3;

use super::*;
use crate::{
    Method, Mip, Paths,
    reference::{Reference, ReferenceFrame, Rounding},
    scene::builtin,
};

const SIZE: [u32; 2] = [4, 3];

/// Number of steps that trace one plane.
const ROWS: u32 = SIZE[1];

fn view_of(name: &str) -> (Reference, View) {
    let scene = builtin(name).expect("built in");
    let camera = *scene.camera(None).expect("a camera");
    let settings = Settings { method: Method::Path, depth: 4, ..Settings::default() };
    (Reference::new(&scene), View::new(&camera, SIZE, &settings))
}

/// The sum in f32 of a worker's samples, added in order.
fn sum(reference: &Reference, view: &View, samples: impl IntoIterator<Item = u32>) -> Vec<f32> {
    let frame = ReferenceFrame { reference, camera: view.camera, size: view.size, settings: view.settings };
    let mut sum = vec![0.0; 3 * (SIZE[0] * SIZE[1]) as usize];
    for sample in samples {
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
        let rgb = pixels
            .flat_map(|pixel| frame.path(pixel, sample, &mut Rounding::none()).radiance.as_vec3().to_array());
        sum.iter_mut().zip(rgb).for_each(|(sum, value): (&mut f32, f32)| *sum += value);
    }
    sum
}

#[test]
fn planes_are_the_samples_of_the_reference_each_once() {
    let (reference, view) = view_of("cornell");
    let (mut accumulator, mut workers) = Accumulator::new(&view, 1);
    for _ in 0..2 * ROWS {
        assert!(workers[0].step(&reference));
    }
    // One plane is in the channel and one waits in the worker; the accumulator has not collected yet.
    accumulator.collect();
    assert_eq!(
        accumulator.take(),
        Some(SampleImage { samples: 1, rgb: sum(&reference, &view, [FIRST_SAMPLE]) })
    );
    assert_eq!(accumulator.take(), None);
    assert!(workers[0].step(&reference));
    accumulator.collect();
    assert_eq!(
        accumulator.take(),
        Some(SampleImage { samples: 1, rgb: sum(&reference, &view, [FIRST_SAMPLE + 1]) })
    );
    // The worker has begun its third sample.
    accumulator.close();
    assert!(!workers[0].step(&reference) && !workers[0].step(&reference));
    assert_eq!(accumulator.sample_counts(), SampleCounts { begun: 3, merged: 2, given_up: 1 });
}

#[test]
fn a_plane_of_two_eyes_has_what_crosses_over() {
    let (reference, mut view) = view_of("cornell");
    view.settings.method = Method::Vr;
    let (mut accumulator, mut workers) = Accumulator::new(&view, 1);
    (0..ROWS).for_each(|_| assert!(workers[0].step(&reference)));
    accumulator.collect();
    let image = accumulator.take().expect("a sample");
    let frame =
        ReferenceFrame { reference: &reference, camera: view.camera, size: SIZE, settings: view.settings };
    let pixels = || (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
    let paths: Vec<_> =
        pixels().map(|pixel| (pixel, frame.path(pixel, FIRST_SAMPLE, &mut Rounding::none()))).collect();
    assert!(paths.iter().any(|(_, path)| path.splat.is_some()));
    for (pixel, found) in pixels().zip(image.rgb.chunks_exact(3)) {
        let counted = paths.iter().map(|(from, path)| {
            let own = if *from == pixel { path.own } else { 0.0 };
            let splat_here = path.splat.filter(|splat| splat.pixel == pixel);
            path.radiance * (splat_here.map_or(DVec3::ZERO, |splat| splat.share) + own)
        });
        let expected = counted.sum::<DVec3>();
        let off = (expected - DVec3::from_slice(&[0, 1, 2].map(|i| f64::from(found[i])))).length();
        assert!(off <= 1e-5 * (1.0 + expected.length()), "{pixel:?}: {found:?}, expected {expected}");
    }
}

#[test]
fn an_owner_that_seldom_comes_loses_nothing() {
    let (reference, view) = view_of("cornell");
    let (mut accumulator, mut workers) = Accumulator::new(&view, 1);
    for _ in 0..7 * ROWS {
        assert!(workers[0].step(&reference));
    }
    accumulator.close();
    accumulator.collect();
    assert!(!workers[0].step(&reference));
    drop(workers);
    accumulator.finish();
    let found = accumulator.take().expect("seven samples");
    let [first, others] =
        [sum(&reference, &view, [FIRST_SAMPLE]), sum(&reference, &view, FIRST_SAMPLE + 1..FIRST_SAMPLE + 7)];
    let expected: Vec<f32> = first.iter().zip(&others).map(|(a, b)| a + b).collect();
    assert_eq!(found, SampleImage { samples: 7, rgb: expected });
    assert_eq!(
        (accumulator.samples(), accumulator.sample_counts()),
        (vec![7], SampleCounts { begun: 7, merged: 7, given_up: 0 })
    );
}

/// A tick is one row of the fast workers and one frame of the GPU, after which the accumulator collects.
#[test]
fn a_core_ten_times_slower_delays_nobody() {
    const TICKS: u32 = 60 * ROWS;
    let (reference, view) = view_of("cornell");
    let alone = {
        let (mut accumulator, mut workers) = Accumulator::new(&view, 2);
        for _ in 0..TICKS {
            workers.iter_mut().for_each(|worker| assert!(worker.step(&reference)));
            accumulator.collect();
        }
        accumulator.samples()
    };
    assert_eq!(alone, [60, 60]);
    let (mut accumulator, mut workers) = Accumulator::new(&view, 3);
    for tick in 0..TICKS {
        for (index, worker) in workers.iter_mut().enumerate() {
            if index < 2 || tick % 10 == 9 {
                assert!(worker.step(&reference));
            }
        }
        accumulator.collect();
    }
    assert_eq!(accumulator.samples(), [60, 60, 6]);
    // Half a row into its next plane, the worker loses only that plane.
    assert!(workers[2].step(&reference));
    accumulator.close();
    workers.iter_mut().for_each(|worker| assert!(!worker.step(&reference)));
    accumulator.collect();
    assert_eq!(accumulator.sample_counts(), SampleCounts { begun: 127, merged: 126, given_up: 1 });
    let cpu_samples = accumulator.take().expect("cpu_samples");
    assert_eq!(cpu_samples.samples, 126);
    // Sample indices go to workers on request: the one of the first 127 that is missing from the sum is the last
    // worker's.
    let expected = sum(&reference, &view, FIRST_SAMPLE..FIRST_SAMPLE + 127);
    let is_missing = |sample: &u32| {
        let one = sum(&reference, &view, [*sample]);
        let off = expected
            .iter()
            .zip(&cpu_samples.rgb)
            .zip(&one)
            .map(|((all, merged), one)| (all - merged - one).abs());
        off.fold(0.0, f32::max) < 1e-3
    };
    assert_eq!((FIRST_SAMPLE..FIRST_SAMPLE + 127).filter(is_missing).count(), 1);
}

#[test]
fn planes_of_a_view_that_was_left_are_never_merged() {
    let (reference, view) = view_of("cornell");
    let elsewhere = View { camera: view.camera.panned(90.0), ..view };
    let (mut accumulator, mut workers) = Accumulator::new(&view, 2);
    // The first worker has one plane collected, one in the channel, one waiting and one begun; the other has one
    // begun.
    for _ in 0..ROWS {
        assert!(workers[0].step(&reference));
    }
    accumulator.collect();
    for _ in 0..2 * ROWS + 1 {
        assert!(workers[0].step(&reference));
    }
    assert!(workers[1].step(&reference));
    assert_eq!(accumulator.sample_counts(), SampleCounts { begun: 5, merged: 1, given_up: 0 });
    accumulator.show(&elsewhere);
    accumulator.collect();
    assert_eq!((accumulator.take(), accumulator.samples()), (None, vec![0, 0]));
    for _ in 0..ROWS {
        workers.iter_mut().for_each(|worker| assert!(worker.step(&reference)));
    }
    accumulator.collect();
    let expected = sum(&reference, &elsewhere, [FIRST_SAMPLE, FIRST_SAMPLE + 1]);
    assert_eq!(accumulator.take(), Some(SampleImage { samples: 2, rgb: expected }));
    assert_eq!(accumulator.sample_counts(), SampleCounts { begun: 7, merged: 2, given_up: 5 });
    // Neither the same view nor a change of settings that paths do not depend on is another view.
    accumulator.show(&elsewhere);
    accumulator.show(&View::new(&elsewhere.camera, SIZE, &Settings { block: 4, ..elsewhere.settings }));
    assert_eq!(accumulator.samples(), [1, 1]);
}

#[test]
fn threads_that_end_have_brought_everything() {
    let (reference, view) = view_of("furnace");
    let (mut accumulator, workers) = Accumulator::new(&view, 3);
    std::thread::scope(|scope| {
        for mut worker in workers {
            let reference = &reference;
            scope.spawn(move || while worker.step(reference) {});
        }
        while accumulator.samples().iter().sum::<u32>() < 50 {
            accumulator.collect();
            std::thread::yield_now();
        }
        accumulator.finish();
    });
    let SampleCounts { begun, merged, given_up } = accumulator.sample_counts();
    assert_eq!(begun, merged + given_up);
    assert!(given_up <= 3 && merged >= 50);
    let cpu_samples = accumulator.take().expect("cpu_samples");
    assert_eq!(u64::from(cpu_samples.samples), merged);
    // All radiances of the furnace scene are about 1.
    let mean =
        cpu_samples.rgb.iter().sum::<f32>() / cpu_samples.rgb.len() as f32 / cpu_samples.samples as f32;
    assert!((mean - 1.0).abs() < 0.1, "{mean}");
}

#[test]
fn a_view_of_no_pixels_ends_nobody() {
    let (reference, view) = view_of("cornell");
    for (size, steps) in [([0, 3], 3), ([3, 0], 1)] {
        let (mut accumulator, mut workers) = Accumulator::new(&View { size, ..view }, 1);
        (0..steps).for_each(|_| assert!(workers[0].step(&reference)));
        accumulator.collect();
        assert_eq!(accumulator.take(), Some(SampleImage { samples: 1, rgb: vec![] }));
    }
}

#[test]
fn whatever_paths_heed_makes_another_view() {
    let (_, view) = view_of("cornell");
    let Settings { depth, mip, seed, paths, .. } = view.settings;
    assert_eq!(mip, Mip::On);
    let others = [
        Settings { depth: depth + 1, ..view.settings },
        Settings { mip: Mip::Off, ..view.settings },
        Settings { seed: seed + 1, ..view.settings },
        Settings { paths: Paths { light_samples: 2, ..paths }, ..view.settings },
    ];
    for settings in others {
        assert_ne!(View::new(&view.camera, SIZE, &settings), view, "{settings:?}");
    }
    assert_ne!(View::new(&view.camera, [3, 4], &view.settings), view);
    assert_ne!(View::new(&view.camera.panned(1.0), SIZE, &view.settings), view);
}
