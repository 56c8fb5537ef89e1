//! Options of a frame: clap arguments generated from the core's table of options.

use std::marker::PhantomData;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::error::ErrorKind;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use glimpse::options::{Choice, Kind, OPTIONS, OptionSpec, suggestion};
use glimpse::{Method, Settings};

use super::{EnvironmentOptions, LookAtOptions, SCENE, SceneOptions};

/// What every rendering command takes.
#[derive(Clone, Debug, Default, PartialEq, Args)]
pub struct FrameOptions {
    /// Camera by index or name [default: the first]
    #[arg(long, help_heading = SCENE, value_name = "INDEX_OR_NAME")]
    pub camera: Option<String>,
    #[command(flatten)]
    pub look_at: LookAtOptions,
    #[command(flatten)]
    pub environment: EnvironmentOptions,
    #[command(flatten)]
    pub file: SceneOptions,
    #[command(flatten)]
    pub typed: TypedOptions<ExceptMethod>,
}

impl FrameOptions {
    /// Validated settings with one method. Objects named in `--focus` are not set, as they need the scene.
    pub fn settings(&self, method: Method) -> glimpse::Result<Settings> {
        let settings = self.typed.settings(method)?;
        settings.validate()?;
        Ok(settings)
    }

    /// Validated settings for one of several methods, without options that affect only other methods.
    pub fn settings_beside(&self, method: Method) -> glimpse::Result<Settings> {
        let settings = self.typed.settings(method)?.without_foreign();
        settings.validate()?;
        Ok(settings)
    }

    /// A warning for each typed option that has no effect with these settings.
    pub fn warnings(&self, settings: &Settings) -> Vec<String> {
        let method = settings.method.name();
        let idle = self.typed.0.iter().filter(|(option, _)| !option.applies(settings));
        idle.map(|(option, _)| {
            let reason = option.applicability.reason;
            format!("--{} changes nothing with --method {method}. {reason}", option.name)
        })
        .collect()
    }

    /// Objects in focus as typed.
    pub fn focus(&self) -> Option<&str> {
        let focus = self.typed.0.iter().find(|(option, _)| matches!(option.kind, Kind::Objects(_)));
        focus.map(|(_, text)| text.as_str())
    }
}

/// The options of the table that a command accepts.
pub trait Selection {
    /// Whether the command accepts the option.
    fn contains(option: &OptionSpec) -> bool;
}

/// All options but the method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExceptMethod;

impl Selection for ExceptMethod {
    fn contains(option: &OptionSpec) -> bool {
        option.name != METHOD
    }
}

/// Only the options that limit ray recursion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Recursion;

impl Selection for Recursion {
    fn contains(option: &OptionSpec) -> bool {
        ["depth", "min-weight"].contains(&option.name)
    }
}

const METHOD: &str = "method";

/// Typed options with their values, in the order of the table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TypedOptions<S>(Vec<(&'static OptionSpec, String)>, PhantomData<S>);

impl<S: Selection> TypedOptions<S> {
    /// Options of the table that the command accepts.
    fn selected() -> impl Iterator<Item = &'static OptionSpec> {
        OPTIONS.iter().filter(|option| S::contains(option))
    }

    /// Defaults of the method with the typed values applied, not validated.
    pub fn settings(&self, method: Method) -> glimpse::Result<Settings> {
        self.over(Settings::for_method(method))
    }

    /// Settings with the typed values applied, not validated.
    pub fn over(&self, mut settings: Settings) -> glimpse::Result<Settings> {
        for (option, text) in &self.0 {
            set(option, &mut settings, text)?;
        }
        Ok(settings)
    }

    /// These options with one more value, as if typed.
    ///
    /// # Errors
    /// Fails with one line that names the option and the expected values.
    pub fn with(&self, name: &str, text: &str) -> Result<Self, String> {
        let option = Self::selected().find(|option| option.name == name || option.old_name == Some(name));
        let option = option.ok_or_else(|| {
            let names: Vec<_> = Self::selected().map(|option| option.name).collect();
            let suggestion = suggestion(name, names.iter().copied());
            format!("expected one of {}{suggestion}, found {name}", names.join(", "))
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

/// Sets an option. Object names are accepted without effect, as resolving them needs a scene.
fn set(option: &OptionSpec, settings: &mut Settings, text: &str) -> glimpse::Result<()> {
    match option.set(settings, text) {
        Err(_) if matches!(option.kind, Kind::Objects(_)) => Ok(()),
        result => result,
    }
}

/// Makes the clap argument for an option of the table.
fn argument(option: &'static OptionSpec) -> Arg {
    let kind = &option.kind;
    let argument = Arg::new(option.name)
        .long(option.name)
        .aliases(option.old_name)
        .help(help(option, clause(option.summary)))
        .long_help(help(option, option.summary))
        .help_heading(option.group.title())
        .hide_short_help(!option.essential)
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

/// Help text: a description of the option and its default.
fn help(option: &OptionSpec, description: &str) -> String {
    format!("{} [default: {}]", description.trim_end_matches('.'), default_text(option))
}

/// The part of a sentence before its first semicolon.
fn clause(sentence: &str) -> &str {
    sentence.split(';').next().unwrap_or(sentence)
}

/// Default of the option, followed by the methods with other defaults.
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

/// Parser of a method's name.
pub fn method_parser() -> impl TypedValueParser<Value = Method> {
    names(Method::CHOICES).try_map(|text| Method::named(&text).ok_or("expected the name of a method"))
}
