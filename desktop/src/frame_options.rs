//! The options of a frame: arguments made from the core's table of options.

use std::marker::PhantomData;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::error::ErrorKind;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use glimpse::options::{Choice, Kind, OPTIONS, OptionSpec};
use glimpse::{Method, Settings};

use super::{LookAtOptions, Size};

/// What every rendering command takes.
#[derive(Clone, Debug, PartialEq, Args)]
pub struct FrameOptions {
    /// Frame size in pixels, of each eye
    #[arg(long, value_name = "WxH", default_value = "2560x1440")]
    pub size: Size,
    /// A camera of the scene, by index or name [default: the first]
    #[arg(long, value_name = "INDEX_OR_NAME")]
    pub camera: Option<String>,
    #[command(flatten)]
    pub look_at: LookAtOptions,
    #[command(flatten)]
    pub typed: TypedOptions<ExceptMethod>,
}

impl Default for FrameOptions {
    fn default() -> Self {
        let (camera, look_at, typed) = (None, LookAtOptions::default(), TypedOptions::default());
        Self { size: Size([2560, 1440]), camera, look_at, typed }
    }
}

impl FrameOptions {
    /// The settings with one method, checked. Objects in focus by name are not known before the scene is.
    pub fn settings(&self, method: Method) -> glimpse::Result<Settings> {
        let settings = self.typed.settings(method)?;
        settings.validate()?;
        Ok(settings)
    }

    /// As [`FrameOptions::settings`] of one method of several, without what concerns the others alone.
    pub fn settings_beside(&self, method: Method) -> glimpse::Result<Settings> {
        let settings = self.typed.settings(method)?.without_foreign();
        settings.validate()?;
        Ok(settings)
    }

    /// A warning for each of the typed options that changes nothing.
    pub fn warnings(&self, settings: &Settings) -> Vec<String> {
        let method = settings.method.name();
        let idle = self.typed.0.iter().filter(|(option, _)| !option.applies(settings));
        idle.map(|(option, _)| {
            let reason = option.applicability.reason;
            format!("--{} changes nothing with --method {method}. {reason}", option.name)
        })
        .collect()
    }

    /// The objects in focus as they were typed.
    pub fn focus(&self) -> Option<&str> {
        let focus = self.typed.0.iter().find(|(option, _)| matches!(option.kind, Kind::Objects(_)));
        focus.map(|(_, text)| text.as_str())
    }
}

/// Which options of the table a command takes.
pub trait Selection {
    /// Is that one of them?
    fn contains(option: &OptionSpec) -> bool;
}

/// All but the method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExceptMethod;

impl Selection for ExceptMethod {
    fn contains(option: &OptionSpec) -> bool {
        option.name != METHOD
    }
}

/// How far rays are followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Recursion;

impl Selection for Recursion {
    fn contains(option: &OptionSpec) -> bool {
        ["depth", "min-weight"].contains(&option.name)
    }
}

const METHOD: &str = "method";

/// Options of the table that were typed, with their values, in the table's order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TypedOptions<S>(Vec<(&'static OptionSpec, String)>, PhantomData<S>);

impl<S: Selection> TypedOptions<S> {
    /// Those that the command takes.
    fn selected() -> impl Iterator<Item = &'static OptionSpec> {
        OPTIONS.iter().filter(|option| S::contains(option))
    }

    /// The method's defaults with what was typed, not checked.
    pub fn settings(&self, method: Method) -> glimpse::Result<Settings> {
        let mut settings = Settings::for_method(method);
        for (option, text) in &self.0 {
            set(option, &mut settings, text)?;
        }
        Ok(settings)
    }

    /// These with one more, as if it had been typed.
    ///
    /// # Errors
    /// One line that names the option, and what was expected of it.
    pub fn with(&self, name: &str, text: &str) -> Result<Self, String> {
        let option = Self::selected().find(|option| option.name == name || option.old_name == Some(name));
        let option = option.ok_or_else(|| {
            let names: Vec<_> = Self::selected().map(|option| option.name).collect();
            format!("expected one of {}, found {name}", names.join(", "))
        })?;
        set(option, &mut Settings::default(), text).map_err(|error| format!("--{error}"))?;
        let others = Self::selected().filter_map(|other| {
            if option == other {
                return Some((option, text.to_owned()));
            }
            self.0.iter().find(|(typed, _)| *typed == other).cloned()
        });
        Ok(Self(others.collect(), PhantomData))
    }
}

impl<S: Selection> Args for TypedOptions<S> {
    fn augment_args(command: Command) -> Command {
        command.args(Self::selected().map(argument))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<S: Selection> FromArgMatches for TypedOptions<S> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut typed = Self(Vec::new(), PhantomData);
        typed.update_from_arg_matches(matches)?;
        Ok(typed)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for option in Self::selected() {
            if let Some(text) = matches.get_one::<String>(option.name) {
                *self = self
                    .with(option.name, text)
                    .map_err(|reason| clap::Error::raw(ErrorKind::ValueValidation, format!("{reason}\n")))?;
            }
        }
        Ok(())
    }
}

/// Sets an option of settings. Objects may be named, which a scene is needed for: these are left alone.
fn set(option: &OptionSpec, settings: &mut Settings, text: &str) -> glimpse::Result<()> {
    match option.set(settings, text) {
        Err(_) if matches!(option.kind, Kind::Objects(_)) => Ok(()),
        result => result,
    }
}

/// The argument for an option of the table.
fn argument(option: &'static OptionSpec) -> Arg {
    let kind = &option.kind;
    let argument = Arg::new(option.name)
        .long(option.name)
        .aliases(option.old_name)
        .help(help(option))
        .help_heading(option.group.title())
        .value_name(if option.name == "focus" { "OBJECT" } else { kind.placeholder() })
        .value_parser(parser(option))
        .action(ArgAction::Set);
    match kind {
        Kind::Flag(_) => argument.num_args(0..=1).require_equals(true).default_missing_value("true"),
        Kind::Choice { .. } => argument.ignore_case(true),
        Kind::Point { .. } => argument.allow_hyphen_values(true),
        Kind::Integer { .. } | Kind::Number { .. } | Kind::OptionalNumber { .. } => {
            argument.allow_negative_numbers(true)
        }
        Kind::Objects(_) => argument,
    }
}

/// The sentence and the default.
fn help(option: &OptionSpec) -> String {
    format!("{} [default: {}]", option.summary.trim_end_matches('.'), default_text(option))
}

/// The default, with those of methods that have another.
pub fn default_text(option: &OptionSpec) -> String {
    let usual = option.default(Settings::default().method);
    let mut text = usual.to_string();
    for method in
        Method::ALL.into_iter().filter(|method| option.name != METHOD && option.default(*method) != usual)
    {
        text += &format!(", {} with {}", option.default(method), method.name());
    }
    text
}

fn parser(option: &'static OptionSpec) -> ValueParser {
    match &option.kind {
        Kind::Choice { choices, .. } => names(choices).into(),
        kind => ValueParser::from(move |text: &str| match set(option, &mut Settings::default(), text) {
            Ok(()) => Ok(text.to_owned()),
            Err(_) => Err(format!("expected {}", kind.expected())),
        }),
    }
}

fn names(choices: &'static [Choice]) -> PossibleValuesParser {
    PossibleValuesParser::new(
        choices
            .iter()
            .map(|choice| PossibleValue::new(choice.name).aliases(choice.old_name).help(choice.summary)),
    )
}

/// Reads the name of a method.
pub fn method_parser() -> impl TypedValueParser<Value = Method> {
    names(Method::CHOICES).try_map(|text| Method::named(&text).ok_or("expected the name of a method"))
}
