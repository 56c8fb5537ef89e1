//! The `glimpse render` command that makes a frame again.

use glimpse::{Settings, Show, THRESHOLD_NAMES};

use crate::Job;

/// The command for this frame of a scene. `camera` are options of the command line.
pub fn command(scene: &str, camera: &str, job: &Job) -> String {
    let [width, height] = job.settings.method.eye(job.size);
    let mut words = vec![format!("glimpse render {} -o glimpse.png --size {width}x{height}", quoted(scene))];
    if !camera.is_empty() {
        words.push(camera.to_owned());
    }
    words.extend(options(&job.settings));
    if job.show != Show::Final {
        words.push(format!("--show {}", job.show.name()));
    }
    words.join(" ")
}

/// The options whose values are not the defaults.
fn options(settings: &Settings) -> Vec<String> {
    let usual = Settings::default();
    let (tolerances, usual_tolerances) = (settings.tolerances, usual.tolerances);
    let words = [
        (settings.method != usual.method, "method", settings.method.name().to_owned()),
        (settings.sampling != usual.sampling, "sampling", settings.sampling.to_string()),
        (settings.block != usual.block, "block", settings.block.to_string()),
        (settings.postcorrect != usual.postcorrect, "postcorrect", settings.postcorrect.name().to_owned()),
        (settings.mip != usual.mip, "mip", settings.mip.name().to_owned()),
        (tolerances.pos != usual_tolerances.pos, "t-pos", tolerances.pos.to_string()),
        (tolerances.norm != usual_tolerances.norm, "t-norm", tolerances.norm.to_string()),
        (tolerances.tex != usual_tolerances.tex, "t-tex", tolerances.tex.to_string()),
        (tolerances.gcol != usual_tolerances.gcol, "t-gcol", tolerances.gcol.to_string()),
        (settings.depth != settings.method.usual_depth(), "depth", settings.depth.to_string()),
        (settings.min_weight != usual.min_weight, "min-weight", settings.min_weight.to_string()),
        (settings.share != usual.share, "share", settings.share.to_string()),
    ];
    words
        .into_iter()
        .map(owned)
        .chain(samples(settings, &usual))
        .chain(paths(settings, &usual))
        .filter(|(differs, ..)| *differs)
        .map(|(_, name, value)| format!("--{name}={value}"))
        .collect()
}

/// Those about where samples go.
fn samples(settings: &Settings, usual: &Settings) -> Vec<(bool, String, String)> {
    let focus = settings.focus.map_or_else(String::new, |focus| format!("{}-{}", focus.first, focus.last));
    let words = [
        (settings.supersample != usual.supersample, "supersample", settings.supersample.to_string()),
        (settings.focus.is_some(), "focus", focus),
        (settings.refine != usual.refine, "refine", settings.refine.name().to_owned()),
        (settings.inactive != usual.inactive, "inactive", settings.inactive.name().to_owned()),
        (settings.jitter != usual.jitter, "jitter", settings.jitter.name().to_owned()),
        (settings.filter != usual.filter, "filter", settings.filter.name().to_owned()),
        (settings.similar != usual.similar, "similar", settings.similar.to_string()),
        (settings.seed != usual.seed, "seed", settings.seed.to_string()),
    ];
    let mut words: Vec<_> = words.into_iter().map(owned).collect();
    if let Some(preset) = settings.thresholds.preset() {
        let differs = settings.thresholds != usual.thresholds;
        words.push((differs, "preset".to_owned(), preset.name().to_owned()));
    } else {
        let thresholds = THRESHOLD_NAMES.into_iter().zip(settings.thresholds.values());
        words.extend(thresholds.map(|(name, value)| (true, format!("tau-{name}"), value.to_string())));
    }
    words
}

/// Those about paths, where there are any.
fn paths(settings: &Settings, usual: &Settings) -> Vec<(bool, String, String)> {
    if !settings.method.follows_paths() {
        return Vec::new();
    }
    let (paths, usual) = (&settings.paths, &usual.paths);
    let [x, y] = paths.gaze;
    let words = [
        (paths.samples != usual.samples, "samples", paths.samples.to_string()),
        (paths.stopping != usual.stopping, "stopping", paths.stopping.name().to_owned()),
        (paths.gaze != usual.gaze, "gaze", format!("{x},{y}")),
        (paths.crossing != usual.crossing, "crossing", paths.crossing.name().to_owned()),
        (paths.denoise != usual.denoise, "denoise", paths.denoise.name().to_owned()),
    ];
    words.into_iter().map(owned).collect()
}

fn owned((differs, name, value): (bool, &str, String)) -> (bool, String, String) {
    (differs, name.to_owned(), value)
}

/// As a shell takes it for one word.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use glimpse::{Camera, Method, Tolerances};

    use super::*;

    #[test]
    fn thresholds_are_said_by_name_where_they_have_one() {
        let with = |thresholds| Settings { supersample: true, thresholds, ..Settings::default() };
        let named = options(&with(glimpse::Preset::Edges.thresholds()));
        assert_eq!(named, ["--supersample=true", "--preset=edges"]);
        let unnamed = options(&with(glimpse::Thresholds::uniform(0.25)));
        assert_eq!(unnamed.len(), 10);
        assert_eq!(unnamed[9], "--tau-ste=0.25");
    }

    #[test]
    fn what_is_usual_is_not_said() {
        let camera = Camera::framing(Vec3::ZERO, Vec3::ONE);
        let settings = Settings::default();
        let mut job = Job { camera, size: [64, 32], settings, show: Show::Final, split: false, level: None };
        assert_eq!(
            command("builtin:room", "", &job),
            "glimpse render builtin:room -o glimpse.png --size 64x32"
        );
        job.settings.tolerances = Tolerances { norm: -0.5, ..settings.tolerances };
        job.settings.method = Method::Full;
        job.show = Show::Check(glimpse::Check::Pos);
        assert_eq!(
            command("it's my scene.glb", "--camera 2", &job),
            r"glimpse render 'it'\''s my scene.glb' -o glimpse.png --size 64x32 --camera 2 --method=full --t-norm=-0.5 --show check:pos"
        );
    }
}
