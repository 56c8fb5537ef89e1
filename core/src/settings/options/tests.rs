//! Tests that the table has every option and that setting a value and reading it agree.

use super::*;
use crate::{DirectLight, Filter, Foveation, Jitter, Paths, StereoReuse};

/// Settings in which every option differs from `settings`.
fn all_changed(settings: &Settings) -> Settings {
    let mut changed = *settings;
    for option in OPTIONS {
        let other = option.kind.examples().into_iter().find(|text| {
            let mut tried = changed;
            option.set(&mut tried, text).unwrap();
            option.get(&tried) != option.get(settings)
        });
        option.set(&mut changed, &other.unwrap_or_else(|| panic!("{}", option.name))).unwrap();
    }
    changed
}

/// A field that no row of the table sets keeps its line in the debug output.
#[test]
fn every_field_of_the_settings_is_an_option() {
    let fields = |settings: &Settings| -> Vec<String> {
        let text = format!("{settings:#?}");
        let leaf =
            |line: &&str| !line.ends_with(['{', '[', '(']) && !line.trim().starts_with(['}', ']', ')']);
        text.lines().filter(leaf).map(str::to_owned).collect()
    };
    let usual = Settings::default();
    let changed = fields(&all_changed(&usual));
    let kept: Vec<_> = fields(&usual).into_iter().filter(|line| changed.contains(line)).collect();
    assert_eq!(kept, Vec::<String>::new(), "no row of the table sets these");
}

#[test]
fn names_are_told_apart() {
    let all = OPTIONS.iter().flat_map(|option| [Some(option.name), option.old_name]).flatten();
    let mut names: Vec<_> = all.collect();
    let before = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), before);
    for option in OPTIONS {
        assert!(option.name.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{}", option.name);
        assert!(option.summary.ends_with('.') && option.summary.len() > 10, "{}", option.name);
        let everywhere = Method::ALL.into_iter().all(|method| option.applies(&Settings::for_method(method)));
        assert_eq!(option.applicability.reason.is_empty(), everywhere, "{}", option.name);
    }
}

#[test]
fn every_option_has_a_group() {
    let grouped: usize = Group::ALL.iter().map(|group| group.options().count()).sum();
    assert_eq!(grouped, OPTIONS.len());
    assert!(Group::ALL.iter().all(|group| group.options().next().is_some()));
}

#[test]
fn what_is_set_is_told_back_and_within_the_range() {
    for option in OPTIONS {
        for text in option.kind.examples() {
            let mut settings = Settings::default();
            option.set(&mut settings, &text).unwrap();
            option.check(&settings).unwrap();
            assert_eq!(option.get(&settings).to_string(), text, "{}", option.name);
        }
    }
}

#[test]
fn published_values_can_be_set() {
    for option in OPTIONS {
        let Some(Published { value, .. }) = option.published else { continue };
        let mut settings = Settings::default();
        option.set(&mut settings, value).unwrap();
        option.check(&settings).unwrap();
    }
}

#[test]
fn differences_make_the_same_settings_again() {
    for method in Method::ALL {
        let mut wanted = all_changed(&Settings::default()).with_method(method);
        wanted.thresholds.ste = 0.125;
        wanted.paths.convergence = Some(1e-3);
        let mut made = Settings::default();
        for (option, value) in wanted.differences() {
            option.set(&mut made, &value.to_string()).unwrap();
        }
        assert_eq!(made, wanted);
    }
    assert!(Settings::default().differences().is_empty());
}

#[test]
fn old_names_and_values_are_still_read() {
    let renamed = [
        ("crossing", "paper"),
        ("shining", "emitters"),
        ("direct", "walk"),
        ("stopping", "compensated"),
        ("p-max", "0.25"),
        ("stop-after", "3"),
        ("share", "0.5"),
        ("similar", "0.2"),
        ("inactive", "bilinear"),
        ("features", "all"),
        ("cores", "2"),
        ("method", "fixed"),
    ];
    for (name, value) in renamed {
        let mut settings = Settings::default();
        settings.set(name, value).unwrap();
        assert_ne!(settings, Settings::default(), "{name}");
    }
    let mut settings = Settings::default();
    settings.set("direct", "light").unwrap();
    assert_eq!(settings.paths.direct_light, DirectLight::Nee);
    assert_eq!(DirectLight::ALL.map(DirectLight::name), ["bsdf", "nee", "mis"]);
}

#[test]
fn the_depth_follows_the_method_unless_it_was_chosen() {
    let mut settings = Settings::default();
    settings.set("method", "path").unwrap();
    assert_eq!(settings, Settings::for_method(Method::Path));
    assert_eq!(settings.depth, 64);
    settings.set("method", "full").unwrap();
    assert_eq!(settings.depth, 3);
    settings.set("depth", "5").unwrap();
    assert_eq!(settings.with_method(Method::Vr).depth, 5);
}

#[test]
fn another_method_leaves_behind_what_it_does_not_take() {
    let tent = Settings { filter: Filter::Tent, jitter: Jitter::On, ..Settings::for_method(Method::Full) };
    let tent = Settings { sampling: 2, ..tent };
    tent.validate().unwrap();
    let adaptive = tent.with_method(Method::Adaptive);
    assert_eq!((adaptive.filter, adaptive.jitter, adaptive.sampling), (Filter::Box, Jitter::Auto, 2));
    adaptive.validate().unwrap();
    let error = tent.with_method(Method::Checkerboard).validate().unwrap_err().to_string();
    assert_eq!(error, "sampling: expected 1 with method checkerboard, found 2");
    let error = tent.with_method(Method::Path).validate().unwrap_err().to_string();
    assert!(
        error.contains("sampling: expected 1 with method path") && error.contains("`samples`"),
        "{error}"
    );
}

#[test]
fn what_no_frame_can_have_is_told_by_name() {
    let refused = [
        ("t-pos", "-1", "a number of at least 0"),
        ("t-pos", "inf", "a number of at least 0"),
        ("t-norm", "2.5", "a number from -1 to 2"),
        ("t-tex", "NaN", "a number from 0 to 0.5"),
        ("t-gcol", "-0.5", "a number of at least 0"),
        ("min-weight", "2", "a number from 0 to 1"),
        ("quincunx-threshold", "-0.5", "a number from 0 to 1"),
        ("tau-ssn", "1.5", "a number from 0 to 1"),
        ("refresh-fraction", "0", "a number above 0 and at most 1"),
        ("block", "3", "2, 4 or 8"),
        ("depth", "65", "a whole number, 1 to 64"),
        ("depth", "0", "a whole number, 1 to 64"),
        ("sampling", "17", "a whole number, 1 to 16"),
        ("samples", "0", "a whole number of at least 1"),
        ("light-samples", "65", "a whole number, 1 to 64"),
        ("gaze", "0.5,NaN", "two numbers X,Y, each from -1000 to 1000"),
        ("foveation-max", "1", "a number of at least 0 and below 1"),
        ("eye-distance", "inf", "a number from 0 to 1e18"),
        ("convergence", "0", "a number above 0 and at most 1e18 or none"),
        ("cpu-threads", "257", "a whole number, 0 to 256"),
        ("focus", "3-1", "indices FIRST-LAST, the first not behind the last, one index or none"),
        ("supersample", "true", "false with method full: only adaptive takes it"),
        ("filter", "tent", "box with method vr, which has no even grid of samples"),
        ("jitter", "on", "auto or off with method quincunx, whose samples have fixed places"),
        ("cpu-threads", "2", "0 with method full: only path and vr add samples up"),
    ];
    for (name, value, expected) in refused {
        let method = [Method::Full, Method::Vr, Method::Quincunx]
            .into_iter()
            .find(|method| expected.contains(&format!("method {}", method.name())))
            .unwrap_or(Method::Adaptive);
        let mut settings = Settings::for_method(method);
        settings.set(name, value).unwrap();
        let error = settings.validate().expect_err(name).to_string();
        assert_eq!(error, format!("{name}: expected {expected}, found {value}"));
    }
    let paper = Paths { cpu_threads: 1, stereo_reuse: StereoReuse::Paper, ..Paths::default() };
    let error = Settings { paths: paper, ..Settings::for_method(Method::Vr) }.validate().unwrap_err();
    assert!(error.to_string().contains("0 with stereo-reuse paper"), "{error}");
}

#[test]
fn what_has_no_form_of_a_value_changes_nothing() {
    let refused = [
        ("method", "maybe"),
        ("depth", "-1"),
        ("depth", "4294967296"),
        ("t-pos", "wide"),
        ("supersample", "often"),
        ("gaze", "1"),
        ("gaze", "1,2,3"),
        ("focus", "chair"),
        ("convergence", ""),
    ];
    for (name, value) in refused {
        let mut settings = Settings::default();
        let error = settings.set(name, value).expect_err(name);
        let Error::Setting { option, found, .. } = &error else { panic!("{error}") };
        assert_eq!((option.as_str(), found.as_str()), (name, value));
        assert_eq!(settings, Settings::default());
    }
    let error = Settings::default().set("color", "red").unwrap_err().to_string();
    assert!(error.contains("one of method, sampling") && error.contains("found color"), "{error}");
}

#[test]
fn statistics_have_every_option_by_its_present_name() {
    let mut settings = Settings::for_method(Method::Vr);
    (settings.paths.direct_light, settings.paths.foveation) = (DirectLight::Bsdf, Foveation::Paper);
    let json = serde_json::to_value(settings).unwrap();
    assert_eq!(json.as_object().unwrap().len(), OPTIONS.len());
    assert_eq!(json["direct"], "bsdf");
    assert_eq!(json["foveation"], "paper");
    assert_eq!(json["stereo_reuse"], "weighted");
    assert_eq!(json["gaze"], serde_json::json!([0.5, 0.5]));
    assert!(json["convergence"].is_null() && json["exposure"].is_null() && json["supersample"] == false);
}
