//! Feeds bytes to the command line, one argument per line: the result is wrong usage with an explanation, or options
//! within their ranges.

#![no_main]

#[path = "../../../desktop/src/args.rs"]
#[allow(dead_code, reason = "the program reads every option, the target those with ranges")]
mod args;

use args::{Arguments, Command, FrameOptions, MAX_SIDE, Size};
use clap::CommandFactory;
use glimpse::options::{OPTIONS, Value};
use glimpse::{Error, MAX_DEPTH, Method};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let words = std::iter::once("glimpse").chain(text.split('\n'));
    match Arguments::of(Arguments::command(), words.map(Into::into).collect()) {
        Err(error) => assert!(!error.to_string().trim().is_empty()),
        Ok(arguments) => match &arguments.command {
            Some(Command::Render(options)) => {
                assert!((1..=100_000).contains(&options.frames));
                judge(options.size, &options.frame, options.method);
            }
            Some(Command::Bench(options)) => {
                assert!(!options.scenes.is_empty() && (1..=100_000).contains(&options.frames));
                options.methods.iter().for_each(|method| judge(options.size, &options.frame, *method));
            }
            _ => {}
        },
    }
});

fn judge(Size(sides): Size, options: &FrameOptions, method: Method) {
    assert!(sides.iter().all(|side| (1..=MAX_SIDE).contains(side)), "{sides:?}");
    match options.settings(method) {
        Ok(settings) => {
            settings.validate().expect("checked settings are valid");
            for option in OPTIONS {
                if let Value::Number(number) = option.get(&settings) {
                    assert!(number.is_finite(), "{}: {settings:?}", option.name);
                }
            }
            assert!((1..=MAX_DEPTH).contains(&settings.depth));
        }
        Err(error) => assert!(matches!(error, Error::Setting { .. }), "{error:?}"),
    }
}
