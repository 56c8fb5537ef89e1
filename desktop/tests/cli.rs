//! Runs the program without a graphics device where none is needed: exit codes, and one line for each
//! failure.

#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use std::path::Path;
use std::process::{Command, Output};

use glimpse::{DisplayImage, to_png};

fn glimpse(folder: &Path, line: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_glimpse"))
        .args(line.split_whitespace())
        .current_dir(folder)
        .env_remove("RUST_LOG")
        .output()
        .unwrap()
}

fn grey(path: &Path, level: u8) {
    let image = DisplayImage::from_raw(16, 9, [level, level, level, 255].repeat(16 * 9)).unwrap();
    std::fs::write(path, to_png(&image).unwrap()).unwrap();
}

#[test]
fn failures_are_one_line_and_a_code() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("empty.png"), b"").unwrap();
    for (line, code, expected) in [
        ("compare gone.png gone.png", 1, "cannot read gone.png"),
        ("compare empty.png empty.png", 1, "empty.png: expected a PNG or an EXR"),
        ("render gone.glb -o a.png", 1, "cannot read gone.glb"),
        ("render builtin:room -o gone/a.png", 1, "gone/a.png: its folder does not exist"),
        ("render builtin:room -o a.png --stats gone/a.json", 1, "gone/a.json: its folder does not exist"),
        ("render builtin:attic -o a.png", 2, "there are room"),
        ("render builtin:room -o a.png --t-tex NaN", 2, "--t-tex"),
        ("render builtin:room -o a.exr --show depth", 2, "--show"),
        (
            "render builtin:room -o a.png --cores 2",
            2,
            "--cpu-threads 2: expected 0 with method adaptive: only path and vr add samples up",
        ),
        (
            "render builtin:room -o a.png --method path --samples 2 --cpu-threads 2",
            2,
            "--samples 2: expected more than the 2",
        ),
        ("bench builtin:room --cpu-threads 2", 2, "--cpu-threads 2: expected path or vr among --methods"),
        ("bench builtin:room gone.glb", 1, "cannot read gone.glb"),
        ("warm builtin:room gone.glb", 1, "cannot read gone.glb"),
        ("report builtin:minray gone.glb -o out", 1, "cannot read gone.glb"),
        ("report builtin:minray -o empty.png", 1, "empty.png: expected a folder, found a file"),
        ("report builtin:minray -o out --camera 7", 2, "--camera 7"),
        ("report builtin:minray -o out --depth 0", 2, "--depth"),
        ("info model.stl", 2, "model.stl: expected a .glb or .gltf"),
        ("rendr", 2, "rendr: expected"),
    ] {
        let output = glimpse(folder.path(), line);
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{line}: {stderr}");
        assert!(stderr.starts_with("glimpse: error: ") && stderr.contains(expected), "{line}: {stderr}");
        assert_eq!(stderr.lines().count(), 1, "{line}: {stderr}");
        assert!(output.stdout.is_empty(), "{line}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing was written");
}

#[test]
fn options_that_do_not_exist_are_wrong_usage() {
    let folder = tempfile::tempdir().unwrap();
    for line in
        ["report builtin:room", "render builtin:room", "render builtin:room -o a.jpg", "devices --sampling 2"]
    {
        let output = glimpse(folder.path(), line);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{line}");
    }
}

#[test]
fn stress_judges_cases_and_notices_what_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let run = |line: &str, code| {
        let output = glimpse(folder.path(), line);
        assert_eq!(output.status.code(), Some(code), "{line}: {output:?}");
        output
    };
    let output = run("stress slivers critical --rays 2000 --seed 7 --json", 0);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for (case, name) in json["cases"].as_array().unwrap().iter().zip(["slivers", "critical"]) {
        assert_eq!((case["case"].as_str(), case["failures"].as_u64()), (Some(name), Some(0)));
        assert!(case["rays"].as_u64() >= Some(2000) && case["passed"] == true, "{case}");
    }
    assert!(json["adapter"]["name"].is_string() && json["seed"] == 7);
    let output = run("stress vertices --rays 2000 --without watertight", 1);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("vertices") && text.contains("worst: "), "{text}");
    let stderr = String::from_utf8(run("stress waterproof", 2).stderr).unwrap();
    assert!(stderr.contains("waterproof") && stderr.contains("watertight"), "{stderr}");
}

/// The number of samples does not depend on the number of timed frames.
#[test]
fn warming_says_how_many_kernels_there_were() {
    let folder = tempfile::tempdir().unwrap();
    let output = glimpse(folder.path(), "warm builtin:furnace --methods full --size 16x16");
    assert!(output.status.success(), "{output:?}");
    // Of the preview, of frames and of counters.
    assert_eq!(String::from_utf8_lossy(&output.stdout), "builtin:furnace: 3 kernels of full\n");
}

#[test]
fn a_picture_of_paths_has_the_samples_that_were_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let picture = |name: &str, options: &str| {
        let line = format!("render builtin:cornell -o {name} --size 40x30 --method path {options}");
        let output = glimpse(folder.path(), &line);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        std::fs::read(folder.path().join(name)).unwrap()
    };
    let one = picture("a.png", "--samples 1");
    assert!(one == picture("b.png", "--samples 1 --frames 5"));
    assert!(one != picture("c.png", "--samples 2"));
}

#[test]
fn options_that_change_nothing_are_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let line =
        "render builtin:cornell -o a.png --size 40x30 --method path --samples 1 --tau-col 0.1 --depth 3";
    let output = glimpse(folder.path(), line);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let said = String::from_utf8(output.stdout).unwrap();
    let warnings: Vec<_> = said.lines().filter(|line| line.starts_with("warning ")).collect();
    let expected =
        "warning   --tau-col changes nothing with --method path. There are extra samples with method";
    assert!(warnings.len() == 1 && warnings[0].starts_with(expected), "{said}");
}

#[test]
fn cpu_threads_and_the_gpu_bring_a_pictures_samples_together() {
    let folder = tempfile::tempdir().unwrap();
    let line = "render builtin:cornell -o a.exr --size 70x40 --method path --samples 60 --denoise atrous --cpu-threads 2 --stats a.json";
    let output = glimpse(folder.path(), line);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let said = String::from_utf8(output.stdout).unwrap();
    let json = std::fs::read(folder.path().join("a.json")).unwrap();
    let sides = serde_json::from_slice::<serde_json::Value>(&json).unwrap()["sides"].take();
    let samples = |side: &serde_json::Value| side["samples"].as_u64().unwrap();
    let cpu_threads = sides["cpu_threads"].as_array().unwrap();
    // The timed frame and the warm-up frame before it took one sample each; each CPU thread may add more while
    // the last frame is rendered.
    let brought = samples(&sides["gpu"]) + cpu_threads.iter().map(samples).sum::<u64>();
    assert!(cpu_threads.len() == 2 && brought >= 58, "{sides}");
    assert!(sides["given_up"].as_u64() <= Some(2) && sides["samples_per_s"].as_f64() > Some(0.0), "{sides}");
    assert!(said.contains(&format!("sides     GPU {} sample", samples(&sides["gpu"]))), "{said}");
    assert!(said.contains("CPU thread 1 "), "{said}");
}

#[test]
fn compare_prints_the_errors() {
    let folder = tempfile::tempdir().unwrap();
    grey(&folder.path().join("a.png"), 100);
    grey(&folder.path().join("b.png"), 105);
    let text = |line| {
        let output = glimpse(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}");
        assert!(output.stderr.is_empty(), "{line}");
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(text("compare a.png b.png").starts_with("RMSE 5.000, PSNR 34.15 dB, SSIM 0.99"));
    assert!(text("compare a.png a.png").contains("PSNR infinite, SSIM 1.00000, FLIP 0.00000"));
    let json: serde_json::Value = serde_json::from_str(&text("compare a.png b.png --json")).unwrap();
    assert_eq!((&json["rmse"], &json["worst_tile_rmse"]), (&5.0.into(), &5.0.into()));
    assert_eq!(json["worst_tile"], serde_json::json!([0, 0]));
    for name in ["psnr_db", "ssim", "flip_mean", "flip_p99"] {
        assert!(json[name].is_number(), "{name}");
    }
    let equal: serde_json::Value = serde_json::from_str(&text("compare a.png a.png --json")).unwrap();
    assert!(equal["psnr_db"].is_null(), "infinite");
}

#[test]
fn a_report_is_complete_and_is_not_measured_again() {
    let folder = tempfile::tempdir().unwrap();
    let line = "report builtin:wires -o out/new --size 32x24 --frames 1 --tables 5,missing --table5-sizes 16";
    let run = || {
        let output = glimpse(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        assert!(output.stderr.is_empty(), "{output:?}");
        let read = |name: &str| std::fs::read_to_string(folder.path().join("out/new").join(name)).unwrap();
        let files = ["report.csv", "report.html", "wires-time.svg", "wires-rays.svg"].map(read);
        (String::from_utf8(output.stdout).unwrap(), files)
    };
    let (said, first) = run();
    assert!(!said.contains("already") && said.contains("builtin:wires: "), "{said}");
    let rows = first[0].lines().count() - 1;
    assert!(
        rows > 20 && first[0].lines().filter(|l| l.contains(",tables,")).count() == 6 + 7,
        "{}",
        first[0]
    );
    assert!(first[1].contains("Table 5: resolution and sampling") && first[1].contains(">16x16<"));
    let (said, again) = run();
    assert!(said.starts_with(&format!("{rows} of {rows} measurements are in out/new already")), "{said}");
    assert!(again == first, "times that are measured again differ");
    // Only damaged records are measured again.
    let measured = folder.path().join("out/new/measured");
    let record = std::fs::read_dir(measured).unwrap().map(|e| e.unwrap().path());
    let mut records = record.filter(|path| path.extension().is_some_and(|e| e == "json"));
    let missing = |path: &std::path::PathBuf| -> serde_json::Value {
        serde_json::from_slice::<serde_json::Value>(&std::fs::read(path).unwrap()).unwrap()["missing"].take()
    };
    // A record that needs the objects shown by full ray tracing, which are not stored.
    let record = records.find(|path| missing(path)["pixels_shown"].as_u64() > Some(0)).unwrap();
    let lost = missing(&record);
    std::fs::write(&record, "{").unwrap();
    let output = glimpse(folder.path(), line);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.starts_with(&format!("{} of {rows} measurements", rows - 1)), "{said}");
    assert!(String::from_utf8(output.stderr).unwrap().contains("is made again"));
    assert_eq!(missing(&record), lost);
}
