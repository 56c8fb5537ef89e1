//! Tests of the accepted arguments and of wrong usage.

use clap::CommandFactory;
use clap::error::ErrorKind;
use glimpse::glam::DVec3;
use glimpse::options::OPTIONS;
use glimpse::{
    Filter, Focus, Jitter, Mip, Postcorrect, Preset, Refine, Settings, Specialize, Thresholds, Tolerances,
    Unsampled,
};

use super::*;

fn parse(line: &str) -> Result<Arguments, clap::Error> {
    let words = std::iter::once("glimpse").chain(line.split_whitespace());
    Arguments::of(Arguments::command(), words.map(OsString::from).collect())
}

fn render(line: &str) -> RenderOptions {
    match parse(line).unwrap().command {
        Some(Command::Render(options)) => options,
        other => panic!("{other:?}"),
    }
}

fn bench(line: &str) -> Result<BenchOptions, String> {
    match parse(line).map_err(|error| error.to_string())?.command {
        Some(Command::Bench(options)) => Ok(options),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_varied_is_parsed_as_the_option_itself() {
    let options =
        bench("bench a.glb --block 4 --t-norm 0.5 --vary block=2,8 --vary t-norm=-0.9,.97 --depth 2");
    let options = options.unwrap();
    let combinations = options.frame.combinations(&options.vary).unwrap();
    let found: Vec<_> = combinations
        .iter()
        .map(|(f, _)| f.settings(Method::Adaptive).unwrap())
        .map(|s| (s.block, s.tolerances.norm, s.depth, s.tolerances.pos))
        .collect();
    let t_pos = Tolerances::default().pos;
    assert_eq!(found, [(2, -0.9, 2, t_pos), (2, 0.97, 2, t_pos), (8, -0.9, 2, t_pos), (8, 0.97, 2, t_pos)]);
    let named: Vec<_> = combinations[1].1.iter().map(|(o, v)| format!("{o}={v}")).collect();
    assert_eq!(named, ["block=2", "t-norm=.97"]);
    let every = "bench a.glb --vary postcorrect=off,on,Auto --vary specialize=auto,all --vary sampling=1,2";
    let options = bench(every).unwrap();
    assert_eq!(options.frame.combinations(&options.vary).unwrap().len(), 12);
    let flags = |line: &str| -> Vec<bool> {
        let options = bench(line).unwrap();
        let combinations = options.frame.combinations(&options.vary).unwrap();
        combinations.iter().map(|(frame, _)| frame.settings(Method::Adaptive).unwrap().supersample).collect()
    };
    assert_eq!(flags("bench --supersample a.glb --vary seed=1,2"), [true; 2], "what is typed stays");
    assert_eq!(flags("bench a.glb --vary supersample=false,true"), [false, true]);
}

#[test]
fn what_cannot_be_varied_is_named() {
    for (vary, named) in [
        ("block", "OPTION=VALUE"),
        ("blocks=2", "found blocks"),
        ("size=1x1,2x2", "found size"),
        ("block=2,x", "found x"),
        ("block=2,", "--block"),
        ("block=", "--block"),
        ("features=none", "none"),
        ("=2", "expected one of"),
    ] {
        let error = bench(&format!("bench a.glb --vary {vary}")).unwrap_err();
        assert!(error.contains("--vary") && error.contains(named), "{vary}: {error}");
    }
}

#[test]
fn the_definition_is_sound() {
    Arguments::command().debug_assert();
}

#[test]
fn the_defaults_are_those_of_the_settings() {
    let options = render("render a.glb -o b.png");
    assert_eq!(options.frame.settings(options.method).unwrap(), Settings::default());
    assert_eq!(options.size, Size([2560, 1440]));
    assert_eq!((options.frames, options.show, options.reference), (1, Show::Final, false));
    assert_eq!(FrameOptions::default().settings(Method::Adaptive).unwrap(), Settings::default());
    assert_eq!(FrameOptions::default(), options.frame);
}

#[test]
fn every_option_of_render_arrives() {
    let options = render(
        "render builtin:room -o x.EXR --size 640X480 --camera top --method full --t-pos 0.1 --t-norm -0.5 \
         --t-tex 0.2 --t-gcol 0.3 --depth 5 --min-weight 0 --specialize all --show check:tex --frames 7 \
         --reference --stats s.json --sampling 4 --block 8 --postcorrect scans --mip OFF \
         --preset textures --tau-col 0.25 --tau-ste 1 --focus 3-5 --refine on --unsampled bilinear --jitter on --filter tent --quincunx-threshold 0.3 --seed 9 --refresh-fraction 0.5 --exposure -1.5 --tonemap neutral",
    );
    let settings = options.frame.settings(options.method).unwrap();
    let mut tolerances = Tolerances::default();
    (tolerances.pos, tolerances.norm, tolerances.tex, tolerances.gcol) = (0.1, -0.5, 0.2, 0.3);
    assert_eq!(
        settings,
        Settings {
            method: Method::Full,
            tolerances,
            block: 8,
            sampling: 4,
            postcorrect: Postcorrect::Scans,
            mip: Mip::Off,
            depth: 5,
            min_weight: 0.0,
            refresh_fraction: 0.5,
            exposure: Some(-1.5),
            tonemap: glimpse::Tonemap::Neutral,
            specialize: Specialize::All,
            supersample: false,
            thresholds: Thresholds { col: 0.25, ste: 1.0, ..Preset::Textures.thresholds() },
            focus: Some(Focus { first: 3, last: 5 }),
            refine: Refine::On,
            unsampled: Unsampled::Bilinear,
            jitter: Jitter::On,
            filter: Filter::Tent,
            quincunx_threshold: 0.3,
            seed: 9,
            paths: glimpse::Paths::default(),
        }
    );
    assert_eq!(options.size, Size([640, 480]));
    assert_eq!(options.frame.camera.as_deref(), Some("top"));
    assert_eq!(
        (options.show, options.frames, options.reference),
        (Show::Check(glimpse::Check::Tex), 7, true)
    );
    assert!(options.output.linear);
}

#[test]
fn bare_view_and_scene_alone() {
    let Some(Command::View(bare)) = parse("").unwrap().command else { panic!("view") };
    assert!(bare.scene.is_none() && bare.size.is_none());
    for line in
        ["a.glb --adapter nv -vv --size 64x48", "view a.glb -v -v --size 64x48", "-vv a.glb --size 64x48"]
    {
        let arguments = parse(line).unwrap();
        assert_eq!(arguments.verbose, 2, "{line}");
        let Some(Command::View(view)) = arguments.command else { panic!("{line}") };
        assert_eq!(
            (view.scene.as_deref(), view.size),
            (Some(Path::new("a.glb")), Some(Size([64, 48]))),
            "{line}"
        );
    }
}

#[test]
fn a_word_that_is_neither_command_nor_scene_is_told_what_it_may_mean() {
    for (line, expected) in [
        ("rendr builtin:room -o a.png", "rendr: expected a command"),
        ("rendr builtin:room -o a.png", "did you mean `glimpse render`?"),
        ("room", "did you mean `builtin:room`?"),
        ("comprae a.png b.png", "did you mean `glimpse compare`?"),
        ("-v chcek a.toml", "did you mean `glimpse check`?"),
    ] {
        let error = parse(line).expect_err(line);
        assert!(error.to_string().contains(expected), "{line}: {error}");
        assert_eq!(error.exit_code(), 2);
    }
    let error = parse("zzz").unwrap_err().to_string();
    assert!(!error.contains("did you mean") && error.contains("builtin:NAME"), "{error}");
    for (line, expected) in [
        ("render builtin:room -o a.png --methd full", "'--method'"),
        ("render builtin:room -o a.png --method ful", "'full'"),
        ("render builtin:room -o a.png --show dept", "'depth'"),
        ("bench builtin:room --vary blok=2", "did you mean block?"),
        ("bench builtin:room --vary mip=onn", "did you mean on?"),
        ("stress slivrs", "'slivers'"),
    ] {
        let error = parse(line).expect_err(line).to_string();
        assert!(error.contains(expected), "{line}: {error}");
    }
}

#[test]
fn of_an_option_that_is_repeated_the_last_counts_and_variations_add_up() {
    let options = render(
        "render a.glb -o a.png --size 1x1 --depth 2 -o b.png --size 4x3 --depth 5 --stats a --stats b",
    );
    assert_eq!((options.size, options.stats), (Size([4, 3]), Some("b".into())));
    assert_eq!(options.output.path, Path::new("b.png"));
    assert_eq!(options.frame.settings(options.method).unwrap().depth, 5);
    assert_eq!(bench("bench a.glb --vary block=2 --vary depth=1,2").unwrap().vary.len(), 2);
    let Some(Command::View(view)) = parse("view a.glb --size 1x1 --size 2x2 -v -v").unwrap().command else {
        panic!("view")
    };
    assert_eq!(view.size, Some(Size([2, 2])));
}

#[test]
fn adapter_stands_before_or_after_the_command() {
    for line in ["--adapter llvm devices", "devices --adapter llvm"] {
        let arguments = parse(line).unwrap();
        assert_eq!(arguments.adapter.as_deref(), Some("llvm"));
        assert!(matches!(arguments.command, Some(Command::Devices(_))));
    }
}

#[test]
fn bench_compares_full_and_adaptive_unless_told() {
    let bench = |line| match parse(line).unwrap().command {
        Some(Command::Bench(options)) => options,
        other => panic!("{other:?}"),
    };
    let default = bench("bench a b");
    assert_eq!((default.scenes.len(), default.frames), (2, 5));
    assert_eq!(default.methods, [Method::Full, Method::Adaptive]);
    assert_eq!(bench("bench a --methods adaptive").methods, [Method::Adaptive]);
}

#[test]
fn wrong_usage_exits_with_two_and_says_what_was_expected() {
    for (line, expected) in [
        ("render a.glb -o b.png --size 0x9", "expected sides from 1 to 16384"),
        ("render a.glb -o b.png --size 16385x9", "expected sides from 1 to 16384"),
        ("render a.glb -o b.png --size 640", "expected WIDTHxHEIGHT"),
        ("render a.glb -o b.png --size 1x2x3", "expected WIDTHxHEIGHT"),
        ("render a.glb -o b.png --size=-1x2", "expected WIDTHxHEIGHT"),
        ("render a.glb -o b.png --size 99999999999x2", "expected WIDTHxHEIGHT"),
        ("render a.glb -o b.jpg", "ends in .png or .exr"),
        ("render a.glb -o png", "ends in .png or .exr"),
        ("render a.glb", "--output"),
        ("render a.glb -o b.png --method fast", "full, adaptive"),
        ("render a.glb -o b.png --show check:blue", "check:oid, check:pos, check:norm"),
        ("render a.glb -o b.png --frames 0", "0"),
        ("render a.glb -o b.png --depth=-1", "--depth"),
        ("render a.glb -o b.png --t-pos wide", "--t-pos"),
        ("render a.glb -o b.png --seed x", "--seed"),
        ("render a.glb -o b.png --supersample=often", "--supersample"),
        ("render a.glb -o b.png --samplin 2", "--sampling"),
        ("render a.glb -o b.png --method path --cpu-threads=-1", "--cpu-threads"),
        ("bench", "SCENE"),
        ("bench a --methods full,slow", "slow"),
        ("compare a.png", "<B>"),
        ("info", "SCENE"),
        ("a.glb b.glb", "b.glb"),
    ] {
        let error = parse(line).expect_err(line);
        let message = error.to_string();
        assert_eq!(error.exit_code(), 2, "{line}");
        assert!(message.contains(expected), "{line}: {message}");
    }
}

#[test]
fn values_that_parse_but_mean_nothing_are_named() {
    for (option, name) in [
        ("--t-pos NaN", "t-pos"),
        ("--t-norm inf", "t-norm"),
        ("--t-tex 0.6", "t-tex"),
        ("--t-gcol -1", "t-gcol"),
        ("--min-weight 2", "min-weight"),
        ("--depth 0", "depth"),
        ("--depth 65", "depth"),
        ("--method path --cpu-threads 1000", "cpu-threads"),
    ] {
        let options = render(&format!("render a.glb -o b.png {option}"));
        let error = options.frame.settings(options.method).unwrap_err();
        assert!(matches!(&error, glimpse::Error::Setting { option, .. } if option == name), "{error}");
    }
}

#[test]
fn help_and_version_are_no_failure() {
    assert_eq!(parse("--help").unwrap_err().kind(), ErrorKind::DisplayHelp);
    assert_eq!(parse("--version").unwrap_err().exit_code(), 0);
    for line in ["help", "help render", "render --help-all", "view -h"] {
        assert_eq!(parse(line).unwrap_err().kind(), ErrorKind::DisplayHelp, "{line}");
    }
    assert_eq!(parse("help rendr").unwrap_err().exit_code(), 2);
}

#[test]
fn reports_have_smaller_frames() {
    let report = |line: &str| match parse(line).unwrap().command {
        Some(Command::Report(options)) => options,
        other => panic!("{other:?}"),
    };
    let bare = report("report a.glb b.glb -o out");
    assert_eq!((bare.scenes.len(), bare.size, bare.frames), (2, Size([960, 540]), 5));
    assert_eq!(bare.table5_sizes, None, "those of the size");
    assert_eq!(report("report a.glb -o out --table5-sizes 64").table5_sizes, Some(vec![64]));
    for wrong in ["", "-o out", "a.glb", "a.glb -o out --table5-sizes 0"] {
        assert!(parse(&format!("report {wrong}")).is_err(), "{wrong}");
    }
}

#[test]
fn a_camera_of_ones_own_has_an_eye_and_a_target() {
    let look_at = render("render a.glb -o a.png --eye=-1,2e-3,3 --target 0,0,-1").frame.look_at;
    let camera = look_at.camera(DVec3::ZERO).unwrap().unwrap();
    assert_eq!(camera.origin.to_array(), [-1.0, 2e-3, 3.0]);
    assert!(!camera.orthographic && camera.forward.z < 0.0);
    for wrong in [
        "--eye 1,2,3",
        "--target 1,2,3",
        "--eye 1,2 --target 0,0,0",
        "--eye 1,2,nan --target 0,0,0",
        "--eye 1,2,3 --target 0,0,0 --camera 1",
        "--eye 1,2,3 --target 0,0,0 --fov 40 --ortho 2",
    ] {
        assert!(parse(&format!("render a.glb -o a.png {wrong}")).is_err(), "{wrong}");
    }
}

#[test]
fn what_a_method_does_not_know_is_an_error_alone_and_left_out_beside_others() {
    for (wrong, option) in [
        ("render a.glb -o b.png --method full --supersample", "supersample"),
        ("render a.glb -o b.png --filter tent", "filter"),
        ("render a.glb -o b.png --method quincunx --jitter on", "jitter"),
    ] {
        let options = render(wrong);
        let error = options.frame.settings(options.method).unwrap_err().to_string();
        assert!(error.starts_with(option), "{error}");
        options.frame.settings_beside(options.method).unwrap();
    }
    let both = render("render a.glb -o b.png --supersample --filter tent");
    assert!(both.frame.settings_beside(Method::Adaptive).unwrap().supersample);
    assert_eq!(both.frame.settings_beside(Method::Full).unwrap().filter, Filter::Tent);
}

#[test]
fn every_option_of_the_table_is_typed_by_its_present_and_by_its_old_name() {
    for option in OPTIONS.iter().filter(|option| option.name != "method") {
        for text in option.kind.examples() {
            let mut expected = Settings::for_method(Method::Adaptive);
            option.set(&mut expected, &text).unwrap();
            for name in [Some(option.name), option.old_name].into_iter().flatten() {
                let options = render(&format!("render a.glb -o b.png --{name}={text}"));
                let typed = options.frame.typed.settings(Method::Adaptive).unwrap();
                assert_eq!(typed, expected, "--{name}={text}");
                let varied = FrameOptions::default().with(name, &text).unwrap();
                assert_eq!(varied, options.frame, "--vary {name}={text}");
            }
        }
    }
    assert_eq!(render("render a.glb -o b.png --method fixed").method, Method::Full);
}

#[test]
fn old_names_are_not_shown() {
    let mut command = Arguments::command();
    let render = command.find_subcommand_mut("render").unwrap();
    let help = render.render_long_help().to_string();
    for option in OPTIONS {
        assert!(help.contains(&format!("--{}", option.name)), "{}", option.name);
        assert!(option.old_name.is_none_or(|old| !help.contains(&format!("--{old} "))), "{}", option.name);
    }
    assert!(help.contains("[default: 3, 64 with path, 64 with vr]"), "{help}");
}

#[test]
fn the_depth_is_the_methods_unless_it_is_typed() {
    let depth = |line: &str| {
        let options = render(&format!("render a.glb -o b.png {line}"));
        options.frame.settings(options.method).unwrap().depth
    };
    let lines = ["", "--method path", "--method path --depth 3", "--depth 5 --method vr"];
    assert_eq!(lines.map(depth), [3, 64, 3, 5]);
}

#[test]
fn only_what_changes_nothing_is_warned_of() {
    let told = |line: &str| {
        let options = render(&format!("render a.glb -o b.png {line}"));
        options.frame.warnings(&options.frame.settings(options.method).unwrap())
    };
    let typed = "--preset edges --tau-col 1 --block 4 --depth 2 --share 0.5";
    let warnings = told(typed);
    assert_eq!(warnings.len(), 3, "{warnings:?}");
    let tau = &warnings[2];
    assert!(tau.starts_with("--tau-col changes nothing with --method adaptive. There are extra"), "{tau}");
    let share = "--refresh-fraction changes nothing with --method adaptive. Only frameless and reproject keep pixels.";
    assert_eq!(warnings[0], share);
    assert_eq!(told(&format!("{typed} --supersample")), [share]);
    let warnings = told(&format!("{typed} --method supersample"));
    assert!(warnings[1].starts_with("--block changes nothing with --method supersample."), "{warnings:?}");
    assert_eq!(warnings.len(), 2);
}
