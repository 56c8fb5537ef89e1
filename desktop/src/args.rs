//! The command line: clap derives `--help` and CLI.md from the doc comments of the arguments.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::builder::{OsStringValueParser, PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{ArgAction, Args, FromArgMatches, Parser, Subcommand, ValueEnum};
use glimpse::options::{Group, similar};
use glimpse::scene::BUILTIN_NAMES;
use glimpse::{Method, Show};

#[path = "bounds_options.rs"]
mod bounds_options;
#[path = "environment_options.rs"]
mod environment_options;
#[path = "frame_options.rs"]
mod frame_options;
#[path = "look_at.rs"]
mod look_at;
#[path = "scene_options.rs"]
mod scene_options;
#[path = "vary.rs"]
mod vary;

pub use bounds_options::{BoundsOptions, DiffKind};
pub use environment_options::EnvironmentOptions;
#[cfg(test)]
pub use frame_options::default_text;
pub use frame_options::{FrameOptions, Recursion, TypedOptions, method_parser};
pub use look_at::LookAtOptions;
pub use scene_options::SceneOptions;
pub use vary::Variation;

/// Default of `--size`.
const FRAME_SIZE: &str = "2560x1440";

/// Description of `--show` that leaves most values to the full help.
const SHOW_HELP: &str = "What the picture shows: final, origin, cost, depth ...";

/// The largest width or height of a frame in pixels.
pub const MAX_SIDE: u32 = 16384;

/// Heading of the options that select what is read. Those of a frame stand under the [`Group`]s of the core's table.
const SCENE: &str = "Scene";

/// Heading of the options that select what is written.
const OUTPUT: &str = "Output";

/// Heading of the options that select what is measured.
const MEASUREMENT: &str = "Measurement";

/// Heading of the options of the window.
const WINDOW: &str = "Window";

/// Heading of the options of every command.
const PROGRAM: &str = "Program";

/// Adaptive ray tracing: rays where they matter, interpolation elsewhere.
#[derive(Debug, Parser)]
#[command(
    name = "glimpse",
    version,
    about,
    override_usage = "glimpse [view] [SCENE] [OPTIONS]\n       glimpse <COMMAND> ...",
    args_override_self = true,
    disable_help_flag = true,
    disable_help_subcommand = true,
    after_help = "Examples:\n  glimpse scene.glb\n  glimpse render scene.glb -o frame.png\n\n\
        `glimpse COMMAND --help` lists the options of a command."
)]
pub struct Arguments {
    /// What to do; without it, `view`
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Use the adapter whose name contains this text
    #[arg(long, global = true, help_heading = PROGRAM, value_name = "SUBSTRING")]
    pub adapter: Option<String>,
    /// Print all counters, and more on stderr (-vv, -vvv)
    #[arg(short, long, global = true, help_heading = PROGRAM, action = ArgAction::Count)]
    pub verbose: u8,
    /// Print errors and what was asked for, nothing else
    #[arg(short, long, global = true, help_heading = PROGRAM, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print the most useful options
    #[arg(short, long, global = true, help_heading = PROGRAM, action = ArgAction::HelpShort)]
    help: Option<bool>,
    /// Print all options with their values
    #[arg(long, global = true, hide_short_help = true, help_heading = PROGRAM, action = ArgAction::HelpLong)]
    help_all: Option<bool>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Show a scene
    #[command(after_help = "Examples:\n  glimpse view scene.glb\n  \
        glimpse view builtin:room --phone pixel-10 --script tour.script --headless")]
    View(ViewOptions),
    /// Render one frame into a file
    #[command(
        after_help = "Examples:\n  glimpse render scene.glb -o frame.png --size 1280x720 --reference\n  \
        glimpse render scene.glb -o paths.png --method path --samples 64"
    )]
    Render(RenderOptions),
    /// Measure the error of image A against image B
    #[command(after_help = "Examples:\n  glimpse compare frame.png reference.png\n  \
        glimpse compare frame.png reference.png --max-failed-pixels 4 --diff difference.png")]
    Compare(CompareOptions),
    /// Say what a scene holds and what is left out because of it
    #[command(after_help = "Examples:\n  glimpse info scene.glb\n  glimpse info builtin:room --json")]
    Info(InfoOptions),
    /// Render a scene, or all cases of a file, and compare with reference pictures
    #[command(after_help = "Examples:\n  glimpse check scene.glb reference.png --size 320x180\n  \
        glimpse check cases.toml --failures failed --junit results.xml")]
    Check(CheckOptions),
    /// List the graphics adapters
    #[command(after_help = "Examples:\n  glimpse devices\n  glimpse devices --json")]
    Devices(DevicesOptions),
    /// Compare the methods' times, interleaved in one run
    #[command(after_help = "Examples:\n  glimpse bench scene.glb --size 1280x720\n  \
        glimpse bench scene.glb --methods full,adaptive --vary block=2,4,8")]
    Bench(BenchOptions),
    /// Plot error against run time, and print the tables of Kim 2016
    #[command(after_help = "Examples:\n  glimpse report scene.glb -o report --size 160x90 --frames 2\n  \
        glimpse report builtin:room builtin:cornell -o report --tables 5,4")]
    Report(ReportOptions),
    /// Try stiff and extreme cases against the f64 reference
    #[command(
        after_help = "Examples:\n  glimpse stress --list\n  glimpse stress grazing slivers --rays 100000"
    )]
    Stress(StressOptions),
    /// Compile the kernels of scenes, so that later runs find them in the driver's cache
    #[command(after_help = "Examples:\n  glimpse warm\n  glimpse warm scene.glb --methods adaptive,path")]
    Warm(WarmOptions),
    /// Print a script that completes commands and options in a shell
    #[command(after_help = "Examples:\n  \
        glimpse completions bash > ~/.local/share/bash-completion/completions/glimpse\n  \
        glimpse completions fish > ~/.config/fish/completions/glimpse.fish")]
    Completions(CompletionsOptions),
    /// Print the manual page of the program or of a command
    #[command(after_help = "Examples:\n  glimpse man > glimpse.1\n  glimpse man render > glimpse-render.1")]
    Man(ManOptions),
    /// Print the help of a command
    #[command(after_help = "Examples:\n  glimpse help render\n  glimpse help bench")]
    Help(HelpOptions),
    /// What is no command, with the words that follow it.
    #[command(external_subcommand)]
    Other(Vec<OsString>),
}

impl Arguments {
    /// Parses the words of a command line, the first of which is the program's name, by a definition such as
    /// [`Arguments::command`](clap::CommandFactory::command). A scene in the place of a command is one to `view`, and so
    /// is the default scene where there is neither.
    ///
    /// # Errors
    /// Fails for wrong usage, and where help or the version is to be printed.
    pub fn of(mut definition: clap::Command, mut words: Vec<OsString>) -> Result<Self, clap::Error> {
        let mut parsed =
            |words: &[OsString]| Self::from_arg_matches(&definition.try_get_matches_from_mut(words)?);
        let arguments = parsed(&words)?;
        let place = |rest: usize| words.len() - rest;
        match &arguments.command {
            Some(Command::Other(rest)) => {
                let place = place(rest.len());
                if !is_scene_like(&words[place]) {
                    return Err(no_command(&words[place].to_string_lossy(), &definition));
                }
                words.insert(place, "view".into());
                parsed(&words)
            }
            Some(Command::Help(HelpOptions { command })) => {
                let asked = command.iter().map(OsString::from).chain(["--help".into()]);
                Self::of(definition, words[..1].iter().cloned().chain(asked).collect())
            }
            None => {
                words.push("view".into());
                parsed(&words)
            }
            Some(_) => Ok(arguments),
        }
    }
}

/// Whether a word can only be meant as a scene: it is no bare word, or there is a file of that name.
fn is_scene_like(word: &OsString) -> bool {
    let text = word.to_string_lossy();
    text == "-" || text.contains(['.', ':', '/', '\\']) || Path::new(word).exists()
}

fn no_command(word: &str, definition: &clap::Command) -> clap::Error {
    let commands = definition.get_subcommands().map(|command| format!("`glimpse {}`", command.get_name()));
    let scenes = BUILTIN_NAMES.iter().map(|name| format!("`builtin:{name}`"));
    let bare = |name: &str| name.trim_matches('`').rsplit([' ', ':']).next().unwrap_or_default().to_owned();
    let known: Vec<_> = commands.chain(scenes).collect();
    let names: Vec<_> = known.iter().map(|name| bare(name)).collect();
    let meant = similar(word, names.iter().map(String::as_str));
    let meant =
        meant.and_then(|name| names.iter().position(|known| known == name)).map(|index| &known[index]);
    let meant = meant.map_or_else(String::new, |name| format!("; did you mean {name}?"));
    let expected = "expected a command, a .glb or .gltf file, or builtin:NAME";
    clap::Error::raw(ErrorKind::InvalidSubcommand, format!("{word}: {expected}{meant}\n"))
}

/// `glimpse completions`
#[derive(Debug, Args)]
pub struct CompletionsOptions {
    /// The shell
    pub shell: Shell,
}

/// A shell that completes words of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Shell {
    /// GNU Bash
    Bash,
    /// Z shell
    Zsh,
    /// Fish
    Fish,
}

/// `glimpse man`
#[derive(Debug, Args)]
pub struct ManOptions {
    /// The command; without it, the page of the program
    pub command: Option<String>,
}

/// `glimpse help`
#[derive(Debug, Args)]
pub struct HelpOptions {
    /// The command; without it, all are listed
    pub command: Option<String>,
}

/// `glimpse view`
#[derive(Debug, Args)]
pub struct ViewOptions {
    /// A .glb or .gltf file, builtin:NAME, or - [default: builtin:room]
    #[arg(help_heading = SCENE, display_order = 0)]
    pub scene: Option<PathBuf>,
    /// Window size in pixels [default: 1280x720]
    #[arg(long, help_heading = WINDOW, value_name = "WxH", conflicts_with = "phone")]
    pub size: Option<Size>,
    /// Emulate this phone: the size of its screen and the limits of its graphics device
    #[arg(long, help_heading = WINDOW, value_name = "PROFILE", hide_possible_values = true)]
    pub phone: Option<String>,
    /// List the phones
    #[arg(long, help_heading = WINDOW)]
    pub list_phones: bool,
    /// Play a file of input, screenshots and expectations
    #[arg(long, help_heading = WINDOW, value_name = "FILE")]
    pub script: Option<PathBuf>,
    /// Play the script without a window
    #[arg(long, help_heading = WINDOW, requires = "script")]
    pub headless: bool,
    /// List the steps of scripts and the values that they can expect
    #[arg(long, help_heading = WINDOW)]
    pub script_help: bool,
    /// How the frame is made
    #[arg(long, help_heading = Group::Frame.title(), value_name = "NAME", value_parser = method_parser(),
        default_value = "adaptive", ignore_case = true)]
    pub method: Method,
    #[arg(long, help_heading = Group::Frame.title(), value_name = "WHAT", value_parser = show_parser(),
        hide_possible_values = true, help = SHOW_HELP, long_help = show_help(), default_value = "final")]
    pub show: Show,
    #[command(flatten)]
    pub frame: FrameOptions,
}

/// `glimpse render`
#[derive(Debug, Args)]
pub struct RenderOptions {
    /// A .glb or .gltf file, builtin:NAME, or - for stdin
    #[arg(help_heading = SCENE, display_order = 0)]
    pub scene: PathBuf,
    /// How the frame is made
    #[arg(long, help_heading = Group::Frame.title(), value_name = "NAME", value_parser = method_parser(),
        default_value = "adaptive", ignore_case = true)]
    pub method: Method,
    /// Frame size in pixels, of each eye
    #[arg(long, help_heading = Group::Frame.title(), value_name = "WxH", default_value = FRAME_SIZE)]
    pub size: Size,
    #[arg(long, help_heading = Group::Frame.title(), value_name = "WHAT", value_parser = show_parser(),
        hide_possible_values = true, help = SHOW_HELP, long_help = show_help(), default_value = "final")]
    pub show: Show,
    #[command(flatten)]
    pub frame: FrameOptions,
    /// The picture: .png, .exr for linear radiance, - for a PNG on stdout
    #[arg(short, long, help_heading = OUTPUT, value_name = "OUT", value_parser = OsStringValueParser::new().try_map(PictureFile::try_from))]
    pub output: PictureFile,
    /// Warm frames, of which medians are reported
    #[arg(long, help_heading = OUTPUT, value_name = "N", default_value_t = 1,
        value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Compare speed and error with method full
    #[arg(long, help_heading = OUTPUT)]
    pub reference: bool,
    /// Write the statistics as JSON
    #[arg(long, help_heading = OUTPUT, value_name = "FILE")]
    pub stats: Option<PathBuf>,
}

/// `glimpse compare`
#[derive(Debug, Args)]
pub struct CompareOptions {
    /// The image to judge, PNG or EXR
    #[arg(help_heading = "Pictures")]
    pub a: PathBuf,
    /// The reference
    #[arg(help_heading = "Pictures")]
    pub b: PathBuf,
    #[command(flatten)]
    pub bounds: BoundsOptions,
    /// Write a picture of A, B and their difference side by side
    #[arg(long, help_heading = OUTPUT, value_name = "OUT.png")]
    pub diff: Option<PathBuf>,
    /// What shows the difference
    #[arg(long, help_heading = OUTPUT, value_enum, value_name = "KIND", default_value = "error", requires = "diff")]
    pub diff_kind: DiffKind,
    /// Print JSON
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// `glimpse info`
#[derive(Debug, Args)]
pub struct InfoOptions {
    /// A .glb or .gltf file, builtin:NAME, or - for stdin
    #[arg(help_heading = SCENE, display_order = 0)]
    pub scene: PathBuf,
    #[command(flatten)]
    pub file: SceneOptions,
    /// Print JSON
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// `glimpse check`
#[derive(Clone, Debug, Args)]
pub struct CheckOptions {
    /// A scene, or a .toml file of cases
    #[arg(help_heading = SCENE, display_order = 0)]
    pub scene: PathBuf,
    /// The reference picture, PNG
    #[arg(help_heading = SCENE, display_order = 1)]
    pub reference: Option<PathBuf>,
    /// How the frame is made
    #[arg(long, help_heading = Group::Frame.title(), value_name = "NAME", value_parser = method_parser(),
        default_value = "adaptive", ignore_case = true)]
    pub method: Method,
    /// Frame size in pixels, of each eye
    #[arg(long, help_heading = Group::Frame.title(), value_name = "WxH", default_value = FRAME_SIZE)]
    pub size: Size,
    #[command(flatten)]
    pub frame: FrameOptions,
    #[command(flatten)]
    pub bounds: BoundsOptions,
    /// Write what is rendered as the references, and fail
    #[arg(long, help_heading = OUTPUT)]
    pub update: bool,
    /// Folder for pictures of failed cases
    ///
    /// NAME.png is the picture beside the reference and their difference
    #[arg(long, help_heading = OUTPUT, value_name = "DIR")]
    pub failures: Option<PathBuf>,
    /// Write the results as JUnit XML
    #[arg(long, help_heading = OUTPUT, value_name = "FILE")]
    pub junit: Option<PathBuf>,
}

/// `glimpse devices`
#[derive(Debug, Args)]
pub struct DevicesOptions {
    /// Print JSON
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// `glimpse bench`
#[derive(Debug, Args)]
pub struct BenchOptions {
    /// .glb or .gltf files, or builtin:NAME
    #[arg(required = true, help_heading = SCENE, display_order = 0, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// The methods to compare
    #[arg(long, help_heading = MEASUREMENT, value_name = "NAME", value_parser = method_parser(), value_delimiter = ',',
        default_value = "full,adaptive", ignore_case = true)]
    pub methods: Vec<Method>,
    /// Values of an option to compare
    ///
    /// Several --vary give every combination
    #[arg(long, help_heading = MEASUREMENT, action = ArgAction::Append, value_name = "OPTION=V1,V2,...")]
    pub vary: Vec<Variation>,
    /// Warm frames of each method
    #[arg(long, help_heading = MEASUREMENT, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Turn the camera to the right before each warm frame
    ///
    /// Each frame is compared with full
    #[arg(long, help_heading = MEASUREMENT, value_name = "DEGREES", value_parser = finite, allow_negative_numbers = true)]
    pub pan: Option<f64>,
    /// Frame size in pixels, of each eye
    #[arg(long, help_heading = Group::Frame.title(), value_name = "WxH", default_value = FRAME_SIZE)]
    pub size: Size,
    #[command(flatten)]
    pub frame: FrameOptions,
    /// Print JSON
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// `glimpse warm`
#[derive(Debug, Args)]
pub struct WarmOptions {
    /// .glb or .gltf files, or builtin:NAME
    #[arg(help_heading = SCENE, display_order = 0, value_name = "SCENE", default_value = "builtin:room")]
    pub scenes: Vec<PathBuf>,
    /// The methods whose kernels are compiled
    #[arg(long, help_heading = Group::Frame.title(), value_name = "NAME", value_parser = method_parser(),
        value_delimiter = ',', default_value = "adaptive,full", ignore_case = true)]
    pub methods: Vec<Method>,
    /// Frame size in pixels: kernels of small frames of thin things differ
    #[arg(long, help_heading = Group::Frame.title(), value_name = "WxH", default_value = FRAME_SIZE)]
    pub size: Size,
    #[command(flatten)]
    pub frame: FrameOptions,
}

fn finite(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.parse().ok();
    number.filter(|number| number.is_finite()).ok_or_else(|| "expected a finite number".to_owned())
}

/// `glimpse report`
#[derive(Debug, Args)]
pub struct ReportOptions {
    /// .glb or .gltf files, or builtin:NAME
    #[arg(required = true, help_heading = SCENE, display_order = 0, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// The folder for report.html, report.csv, the plots, and what was measured, from which an interrupted run goes on
    #[arg(short, long, help_heading = OUTPUT, value_name = "DIR")]
    pub output: PathBuf,
    /// Frame size of the plots and of the tables 4, missing, jin2 and jin7, in pixels
    #[arg(long, help_heading = Group::Frame.title(), value_name = "WxH", default_value = "960x540")]
    pub size: Size,
    /// A camera of each scene, by index or name [default: the first]
    #[arg(long, help_heading = SCENE, value_name = "INDEX_OR_NAME")]
    pub camera: Option<String>,
    #[command(flatten)]
    pub recursion: TypedOptions<Recursion>,
    /// Warm frames of each setting
    #[arg(long, help_heading = MEASUREMENT, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// The tables to measure for each scene: those of Kim 2016, missing objects, predictions for phones, those of Jin 2009 and of Kim & Sung 2021
    #[arg(long, help_heading = MEASUREMENT, value_name = "TABLE", value_delimiter = ',', default_value = "5,3a", ignore_case = true)]
    pub tables: Vec<String>,
    /// Sides of the square frames of table 5 [default: two for --size]
    ///
    /// 512,1024 at 960x540; tables 3 have the larger one of these defaults
    #[arg(long, help_heading = MEASUREMENT, value_name = "N", value_delimiter = ',',
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SIDE)))]
    pub table5_sizes: Option<Vec<u32>>,
}

/// `glimpse stress`
#[derive(Debug, Args)]
pub struct StressOptions {
    /// The cases [default: all]
    #[arg(help_heading = MEASUREMENT, value_name = "CASE", value_parser = case_parser())]
    pub cases: Vec<String>,
    /// List the cases
    #[arg(long, help_heading = MEASUREMENT)]
    pub list: bool,
    /// Rays of each case
    #[arg(long, help_heading = MEASUREMENT, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(1..=10_000_000_000))]
    pub rays: u64,
    /// Seed of all random numbers; the same seed gives the same rays
    #[arg(long, help_heading = MEASUREMENT, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Leave out a measure against rounding, to see which cases notice
    #[arg(long, help_heading = MEASUREMENT, value_enum, value_name = "MEASURE", value_delimiter = ',')]
    pub without: Vec<Measure>,
    /// Print JSON
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// A measure against rounding errors that `--without` disables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Measure {
    /// Exact decisions at the edges of triangles
    Watertight,
    /// Boxes widened by what rounding may move a ray
    Boxes,
    /// The distance of spawned rays from their surface
    Offset,
}

/// Parser of the names of stress cases.
fn case_parser() -> PossibleValuesParser {
    let cases = glimpse::stress::CASES.iter();
    PossibleValuesParser::new(cases.map(|case| PossibleValue::new(case.name).help(case.construction)))
}

fn show_parser() -> impl TypedValueParser<Value = Show> {
    PossibleValuesParser::new(Show::all().map(Show::name)).try_map(|name| name.parse::<Show>())
}

fn show_help() -> String {
    let names: Vec<_> = Show::all().map(Show::name).collect();
    format!("What the picture shows: {}", names.join(", "))
}

/// Value of `--size`: width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size(pub [u32; 2]);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides: Option<Vec<u32>> = text.split(['x', 'X']).map(|side| side.parse().ok()).collect();
        match sides.as_deref() {
            Some(&[width, height]) if [width, height].iter().all(|s| (1..=MAX_SIDE).contains(s)) => {
                Ok(Self([width, height]))
            }
            Some(&[_, _]) => Err(format!("expected sides from 1 to {MAX_SIDE}")),
            _ => Err("expected WIDTHxHEIGHT, for example 2560x1440".to_owned()),
        }
    }
}

/// Output file of a picture, whose extension selects the format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Whether to write linear radiance as OpenEXR instead of a PNG.
    pub linear: bool,
}

impl TryFrom<OsString> for PictureFile {
    type Error = String;

    fn try_from(name: OsString) -> Result<Self, String> {
        let path = PathBuf::from(name);
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            _ if path.as_os_str() == "-" => Ok(Self { path, linear: false }),
            Some("png") => Ok(Self { path, linear: false }),
            Some("exr") => Ok(Self { path, linear: true }),
            _ => Err("expected a name that ends in .png or .exr, or - for the standard output".to_owned()),
        }
    }
}

#[cfg(test)]
#[path = "args_tests.rs"]
mod tests;
