//! The command line: clap derives `--help` and CLI.md from the doc comments of the arguments.

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, Parser, Subcommand, ValueEnum};
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

/// The largest width or height of a frame in pixels.
pub const MAX_SIDE: u32 = 16384;

/// Adaptive ray tracing: rays where they matter, interpolation elsewhere.
#[derive(Debug, Parser)]
#[command(name = "glimpse", version, about)]
pub struct Arguments {
    /// What to do; without it, `view`
    #[command(subcommand)]
    pub command: Option<Command>,
    /// A .glb or .gltf file, or builtin:NAME
    pub scene: Option<String>,
    /// Use the adapter whose name contains this text
    #[arg(long, global = true, display_order = 900, value_name = "SUBSTRING")]
    pub adapter: Option<String>,
    /// Say more on stderr (-v, -vv, -vvv)
    #[arg(short, long, global = true, display_order = 901, action = clap::ArgAction::Count)]
    pub verbose: u8,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Show a scene
    View(ViewOptions),
    /// Render one frame into a file
    Render(RenderOptions),
    /// Measure the error of image A against image B
    Compare(CompareOptions),
    /// Say what a scene holds and what is left out because of it
    Info(InfoOptions),
    /// Render a scene, or all cases of a file, and compare with reference pictures
    Check(CheckOptions),
    /// List the graphics adapters
    Devices(DevicesOptions),
    /// Compare the methods' times, interleaved in one run
    Bench(BenchOptions),
    /// Plot error against run time, and print the tables of Kim 2016
    Report(ReportOptions),
    /// Try stiff and extreme cases against the f64 reference
    Stress(StressOptions),
}

/// `glimpse view`
#[derive(Debug, Args)]
pub struct ViewOptions {
    /// A .glb or .gltf file, or builtin:NAME [default: builtin:room]
    pub scene: Option<String>,
    #[command(flatten)]
    pub file: SceneOptions,
    /// Window size in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", conflicts_with = "phone")]
    pub size: Size,
    /// Emulate this phone: the size of its screen and the limits of its graphics device
    #[arg(long, value_name = "PROFILE")]
    pub phone: Option<String>,
    /// Play a file of input, screenshots and expectations
    #[arg(long, value_name = "FILE")]
    pub script: Option<PathBuf>,
    /// Play the script without a window
    #[arg(long, requires = "script")]
    pub headless: bool,
    #[command(flatten)]
    pub environment: EnvironmentOptions,
}

impl Default for ViewOptions {
    fn default() -> Self {
        Self {
            scene: None,
            file: SceneOptions::default(),
            size: Size([1280, 720]),
            phone: None,
            script: None,
            headless: false,
            environment: EnvironmentOptions::default(),
        }
    }
}

/// `glimpse render`
#[derive(Debug, Args)]
pub struct RenderOptions {
    /// A .glb or .gltf file, or builtin:NAME
    pub scene: String,
    /// The picture: .png, or .exr for linear radiance
    #[arg(short, long, value_name = "OUT", value_parser = PictureFile::from_str)]
    pub output: PictureFile,
    #[command(flatten)]
    pub frame: FrameOptions,
    /// How the frame is made
    #[arg(long, value_name = "NAME", value_parser = method_parser(), default_value = "adaptive", ignore_case = true)]
    pub method: Method,
    #[arg(long, value_name = "WHAT", help = show_help(), default_value = "final")]
    pub show: Show,
    /// Render that many warm frames and report medians
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Render with method full too, and report speed and error against it
    #[arg(long)]
    pub reference: bool,
    /// Write the statistics as JSON
    #[arg(long, value_name = "FILE")]
    pub stats: Option<PathBuf>,
}

/// `glimpse compare`
#[derive(Debug, Args)]
pub struct CompareOptions {
    /// The image to judge, PNG or EXR
    pub a: PathBuf,
    /// The reference
    pub b: PathBuf,
    #[command(flatten)]
    pub bounds: BoundsOptions,
    /// Write a picture of A, B and their difference side by side
    #[arg(long, value_name = "OUT.png")]
    pub diff: Option<PathBuf>,
    /// What shows the difference
    #[arg(long, value_enum, value_name = "KIND", default_value = "error", requires = "diff")]
    pub diff_kind: DiffKind,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// `glimpse info`
#[derive(Debug, Args)]
pub struct InfoOptions {
    /// A .glb or .gltf file, or builtin:NAME
    pub scene: String,
    #[command(flatten)]
    pub file: SceneOptions,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// `glimpse check`
#[derive(Clone, Debug, Args)]
#[command(args_override_self = true)]
pub struct CheckOptions {
    /// A .glb or .gltf file, or builtin:NAME; or a .toml file of cases
    pub scene: String,
    /// The reference picture, PNG
    pub reference: Option<PathBuf>,
    #[command(flatten)]
    pub frame: FrameOptions,
    /// How the frame is made
    #[arg(long, value_name = "NAME", value_parser = method_parser(), default_value = "adaptive", ignore_case = true)]
    pub method: Method,
    #[command(flatten)]
    pub bounds: BoundsOptions,
    /// Write what is rendered as the references; the command fails nevertheless
    #[arg(long)]
    pub update: bool,
    /// Where a case fails, write its picture beside the reference and their difference: NAME.png in this folder
    #[arg(long, value_name = "DIR")]
    pub failures: Option<PathBuf>,
    /// Write the results as JUnit XML
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
}

/// `glimpse devices`
#[derive(Debug, Args)]
pub struct DevicesOptions {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// `glimpse bench`
#[derive(Debug, Args)]
pub struct BenchOptions {
    /// .glb or .gltf files, or builtin:NAME
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    #[command(flatten)]
    pub frame: FrameOptions,
    /// The methods to compare
    #[arg(long, value_name = "NAME", value_parser = method_parser(), value_delimiter = ',',
        default_value = "full,adaptive", ignore_case = true)]
    pub methods: Vec<Method>,
    /// Compare these values of an option too; several --vary give every combination
    #[arg(long, value_name = "OPTION=V1,V2,...")]
    pub vary: Vec<Variation>,
    /// Warm frames of each method
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Turn the camera to the right by this angle before each warm frame, and compare each frame with full
    #[arg(long, value_name = "DEGREES", value_parser = finite, allow_negative_numbers = true)]
    pub pan: Option<f64>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

fn finite(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.parse().ok();
    number.filter(|number| number.is_finite()).ok_or_else(|| "expected a finite number".to_owned())
}

/// `glimpse report`
#[derive(Debug, Args)]
pub struct ReportOptions {
    /// .glb or .gltf files, or builtin:NAME
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// The folder for report.html, report.csv, the plots, and what was measured, from which an interrupted run goes on
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Frame size of the plots and of the tables 4, missing, jin2 and jin7, in pixels
    #[arg(long, value_name = "WxH", default_value = "960x540")]
    pub size: Size,
    /// A camera of each scene, by index or name [default: the first]
    #[arg(long, value_name = "INDEX_OR_NAME")]
    pub camera: Option<String>,
    #[command(flatten)]
    pub recursion: TypedOptions<Recursion>,
    /// Warm frames of each setting
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// The tables to measure for each scene: those of Kim 2016, missing objects, predictions for phones, those of Jin 2009 and of Kim & Sung 2021
    #[arg(long, value_name = "TABLE", value_delimiter = ',', default_value = "5,3a", ignore_case = true)]
    pub tables: Vec<String>,
    /// Sides of the square frames of table 5
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "512,1024",
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SIDE)))]
    pub table5_sizes: Vec<u32>,
}

/// `glimpse stress`
#[derive(Debug, Args)]
pub struct StressOptions {
    /// The cases [default: all]
    #[arg(value_name = "CASE")]
    pub cases: Vec<String>,
    /// Rays of each case
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(1..=10_000_000_000))]
    pub rays: u64,
    /// Seed of all random numbers; the same seed gives the same rays
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Leave out a measure against rounding, to see which cases notice
    #[arg(long, value_enum, value_name = "MEASURE", value_delimiter = ',')]
    pub without: Vec<Measure>,
    /// Print JSON
    #[arg(long)]
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

impl FromStr for PictureFile {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let path = PathBuf::from(text);
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("png") => Ok(Self { path, linear: false }),
            Some("exr") => Ok(Self { path, linear: true }),
            _ => Err("expected a name that ends in .png or .exr".to_owned()),
        }
    }
}

#[cfg(test)]
#[path = "args_tests.rs"]
mod tests;
