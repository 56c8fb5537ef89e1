//! `glimpse completions` and `glimpse man`: what shells and `man` read, from the definition of the command line.

use clap_complete::shells;

use crate::args::Shell;
use crate::definition::definition;
use crate::errors::Usage;
use crate::output;

const PROGRAM: &str = "glimpse";

/// Runs `glimpse completions`.
pub fn completions(shell: Shell) -> anyhow::Result<()> {
    output::write_out(&script(shell))
}

fn script(shell: Shell) -> Vec<u8> {
    let (mut definition, mut script) = (definition(), Vec::new());
    match shell {
        Shell::Bash => clap_complete::generate(shells::Bash, &mut definition, PROGRAM, &mut script),
        Shell::Zsh => clap_complete::generate(shells::Zsh, &mut definition, PROGRAM, &mut script),
        Shell::Fish => clap_complete::generate(shells::Fish, &mut definition, PROGRAM, &mut script),
    }
    script
}

/// Runs `glimpse man`.
pub fn manual_page(command: Option<&str>) -> anyhow::Result<()> {
    output::write_out(&page(command)?)
}

fn page(name: Option<&str>) -> anyhow::Result<Vec<u8>> {
    let mut definition = definition();
    definition.build();
    let described = match name {
        None => definition,
        Some(name) => match definition.find_subcommand(name) {
            Some(command) => command.clone().name(format!("{PROGRAM}-{name}")),
            None => {
                let names: Vec<_> = definition.get_subcommands().map(|command| command.get_name()).collect();
                let meant = glimpse::options::suggestion(name, names.iter().copied());
                let expected = format!("{name}: expected one of {}{meant}", names.join(", "));
                return Err(Usage(expected).into());
            }
        },
    };
    let mut page = Vec::new();
    clap_mangen::Man::new(described).render(&mut page)?;
    Ok(page)
}

#[cfg(test)]
mod tests {
    use std::io::Write;
    use std::process::{Command, Stdio};

    use clap::ValueEnum;
    use glimpse::options::OPTIONS;

    use super::*;

    #[test]
    fn every_shell_is_told_every_command_option_and_name() {
        for shell in Shell::value_variants() {
            let script = String::from_utf8(script(*shell)).unwrap();
            let commands = definition();
            let commands = commands.get_subcommands().map(|command| command.get_name().to_owned());
            let options = OPTIONS.iter().map(|option| option.name.to_owned());
            let names = ["pixel-10", "check:oid", "atrous"].map(str::to_owned);
            for word in commands.chain(options).chain(names) {
                // The Z shell reads colons as separators.
                let word = if *shell == Shell::Zsh { word.replace(':', "\\:") } else { word };
                assert!(script.contains(&word), "{shell:?}: no {word}");
            }
        }
    }

    #[test]
    fn bash_reads_its_script() {
        let bash = Command::new("bash").arg("-n").stdin(Stdio::piped()).spawn();
        let Ok(mut bash) = bash else { return println!("SKIPPED: no bash") };
        bash.stdin.take().unwrap().write_all(&script(Shell::Bash)).unwrap();
        assert!(bash.wait().unwrap().success());
    }

    #[test]
    fn pages_have_the_options_of_their_command() {
        let page = |name| String::from_utf8(page(name).unwrap()).unwrap();
        let (program, render) = (page(None), page(Some("render")));
        assert!(program.contains(".TH glimpse 1") && program.contains("render"), "{program}");
        assert!(render.contains("glimpse\\-render"), "{render}");
        for option in OPTIONS {
            assert!(render.contains(&option.name.replace('-', "\\-")), "{}", option.name);
        }
        let error = super::page(Some("rendr")).unwrap_err().to_string();
        assert!(error.contains("(did you mean render?)"), "{error}");
    }
}
