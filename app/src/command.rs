//! The `glimpse render` command that reproduces a frame.

use glimpse::{Settings, Show};

use crate::{App, Job};

/// The command that renders the job's frame of a scene. `camera` contains the camera's options of the command
/// line.
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

/// Options that differ from their defaults and affect the frame.
fn options(settings: &Settings) -> Vec<String> {
    let told = settings.differences().into_iter().filter(|(option, _)| option.applies(settings));
    told.map(|(option, value)| format!("--{}={value}", option.name)).collect()
}

/// Quotes a word for the shell if necessary.
fn quoted(word: &str) -> String {
    if word.contains(char::REPLACEMENT_CHARACTER) {
        return quoted_bytes(App::file_path(word).as_os_str().as_encoded_bytes());
    }
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// Quotes bytes that are not UTF-8, as bash, ksh and zsh read them.
fn quoted_bytes(bytes: &[u8]) -> String {
    let quoted: String = bytes
        .iter()
        .map(|byte| match byte {
            b'\'' | b'\\' => format!("\\{}", char::from(*byte)),
            b' '..=b'~' => char::from(*byte).to_string(),
            _ => format!("\\x{byte:02x}"),
        })
        .collect();
    format!("$'{quoted}'")
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use glimpse::options::OPTIONS;
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
        let mut job = Job {
            camera,
            size: [64, 32],
            settings,
            show: Show::Final,
            split: false,
            level: None,
            is_refined: false,
        };
        assert_eq!(
            command("builtin:room", "", &job),
            "glimpse render builtin:room -o glimpse.png --size 64x32"
        );
        job.settings.tolerances = Tolerances { norm: -0.5, ..settings.tolerances };
        job.show = Show::Check(glimpse::Check::Pos);
        assert_eq!(
            command("it's my scene.glb", "--camera 2", &job),
            r"glimpse render 'it'\''s my scene.glb' -o glimpse.png --size 64x32 --camera 2 --t-norm=-0.5 --show check:pos"
        );
        // Full ray tracing has no tolerances.
        job.settings.method = Method::Full;
        assert!(command("a", "", &job).ends_with("--size 64x32 --method=full --show check:pos"));
    }

    #[cfg(unix)]
    #[test]
    fn names_that_are_no_text_are_quoted_by_their_bytes() {
        assert_eq!(quoted("a\u{fffd}ff it's"), r"$'a\xff it\'s'");
    }

    #[test]
    fn every_option_is_copied_where_it_changes_the_frame() {
        for option in OPTIONS {
            for value in option.kind.examples() {
                for method in Method::ALL {
                    let supersample = method == Method::Adaptive;
                    let mut settings = Settings { supersample, ..Settings::for_method(method) };
                    option.set(&mut settings, &value).unwrap();
                    if settings.validate().is_err() || !option.applies(&settings) {
                        continue;
                    }
                    let mut made = Settings::default();
                    for word in options(&settings) {
                        let (name, value) = word.trim_start_matches("--").split_once('=').unwrap();
                        made.set(name, value).unwrap();
                    }
                    assert_eq!(made, settings, "{} {value}", option.name);
                }
            }
        }
    }
}
