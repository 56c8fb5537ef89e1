//! Goldens are written only on request.

use std::path::Path;

use glimpse::DisplayImage;
use glimpse_tests::golden::Goldens;
use image::Rgba;

fn goldens(folder: &Path, update: bool) -> Goldens {
    Goldens {
        folder: folder.join("golden"),
        failures: folder.join("failures"),
        update,
        adapter: "an adapter".to_owned(),
        driver: "Mesa 25.0.7".to_owned(),
    }
}

fn grey(level: u8) -> DisplayImage {
    DisplayImage::from_pixel(24, 16, Rgba([level, level, level, 255]))
}

#[test]
fn a_missing_golden_fails_and_is_not_made() {
    let folder = tempfile::tempdir().unwrap();
    let error = goldens(folder.path(), false).check("room", &grey(100)).unwrap_err();
    assert!(error.contains("room.png") && error.contains("GLIMPSE_UPDATE_GOLDEN=1"), "{error}");
    assert!(!folder.path().join("golden").exists());
}

#[test]
fn writing_a_golden_fails_the_run_that_writes_it() {
    let folder = tempfile::tempdir().unwrap();
    let error = goldens(folder.path(), true).check("room", &grey(100)).unwrap_err();
    assert!(error.starts_with("wrote "), "{error}");
    goldens(folder.path(), false).check("room", &grey(100)).unwrap();

    let error = goldens(folder.path(), false).check("room", &grey(104)).unwrap_err();
    assert!(error.contains("384 pixels fail") && error.contains("  2: 384  4: 0"), "{error}");
    assert!(error.contains("made on an adapter, Mesa 25.0.7"), "{error}");
    for picture in ["room.actual.png", "room.difference.png"] {
        assert!(folder.path().join("failures").join(picture).is_file(), "{picture}");
    }
}

#[test]
fn an_update_keeps_the_tolerance() {
    let folder = tempfile::tempdir().unwrap();
    let toml = folder.path().join("golden/room.toml");
    goldens(folder.path(), true).check("room", &grey(100)).unwrap_err();
    let wider = std::fs::read_to_string(&toml).unwrap().replace("threshold = 2", "threshold = 9");
    std::fs::write(&toml, wider).unwrap();
    goldens(folder.path(), true).check("room", &grey(50)).unwrap_err();
    assert!(std::fs::read_to_string(&toml).unwrap().contains("threshold = 9"));
}

#[test]
fn a_golden_without_its_origin_fails() {
    let folder = tempfile::tempdir().unwrap();
    goldens(folder.path(), true).check("room", &grey(100)).unwrap_err();
    std::fs::remove_file(folder.path().join("golden/room.toml")).unwrap();
    let error = goldens(folder.path(), false).check("room", &grey(100)).unwrap_err();
    assert!(error.contains("room.toml"), "{error}");
}
