//! What completes the program's words in a shell: its commands and options, the values of settings, the pages of the reference.

use std::ffi::OsString;

use clap::builder::PossibleValuesParser;
use clap::{Arg, Command, ValueEnum as _};
use clap_complete::Shell;

use super::help::PAGES;
use crate::plain;
use crate::viewer::PictureSetting;
use crate::viewer::picture::{self, Values};

/// What completes the program's words in a shell, where the words of a command line ask for it.
///
/// # Errors
/// One line where no shell is named, or one that there is nothing for.
pub(super) fn completions(words: &[OsString], program: &Command) -> Option<Result<String, String>> {
    let (_, [help, completions, shell @ ..]) = words.split_first()? else {
        return None;
    };
    if help != "help" || completions != "completions" || shell.len() > 1 {
        return None;
    }
    let shells: Vec<_> = Shell::value_variants().iter().map(ToString::to_string).collect();
    let shells = shells.join(", ");
    let Some(name) = shell.first().map(|name| name.to_string_lossy()) else {
        return Some(Err(format!("help completions: for which shell? Name one: {shells}")));
    };
    let Ok(shell) = Shell::from_str(&name, true) else {
        let name = plain::line(&name);
        return Some(Err(format!(
            "{name}: no completions for this shell; there are some for {shells}"
        )));
    };
    let mut script = Vec::new();
    let mut program = offering(program.clone());
    let name = program.get_name().to_owned();
    clap_complete::generate(shell, &mut program, name, &mut script);
    Some(Ok(with_files(&String::from_utf8_lossy(&script), shell)))
}

/// The program with all that is offered of its words.
fn offering(program: Command) -> Command {
    let help = help_of(&program);
    program
        .mut_subcommands(|command| command.mut_args(with_values))
        .disable_help_subcommand(true)
        .subcommand(help)
}

/// The values of a setting that have names.
fn values(setting: &PictureSetting) -> Vec<&'static str> {
    match setting.values {
        Values::Named(names) => names(),
        Values::NamedOrWritten { names, more, .. } => names().into_iter().chain(more()).collect(),
        Values::Open { .. } => Vec::new(),
    }
}

/// An option that offers values where its own form is more than names: a setting that takes files too, or a list.
fn with_values(option: Arg) -> Arg {
    let name = option.get_long().unwrap_or_default();
    let offered = match name {
        "vary" => picture::all()
            .filter(|setting| !setting.names().is_empty())
            .map(|setting| setting.option)
            .collect(),
        _ => picture::find(name).map_or_else(Vec::new, values),
    };
    if offered.is_empty() {
        return option;
    }
    option.value_parser(PossibleValuesParser::new(offered))
}

/// `help` with its commands and pages.
fn help_of(program: &Command) -> Command {
    let plain = |name: &str, about: String| Command::new(name.to_owned()).about(about).disable_help_flag(true);
    let commands: Vec<(String, String)> = program
        .get_subcommands()
        .map(|command| {
            let about = command.get_about().map(ToString::to_string).unwrap_or_default();
            (command.get_name().to_owned(), about)
        })
        .collect();
    let names = commands.iter().map(|(name, _)| name.clone());
    let of_command = Arg::new("command").value_parser(PossibleValuesParser::new(names));
    let of_shell = Arg::new("shell").value_parser(PossibleValuesParser::new(
        Shell::value_variants().iter().map(ToString::to_string),
    ));
    let pages = PAGES.iter().map(|(name, text)| {
        let title = text.lines().next().unwrap_or_default().trim_start_matches("# ");
        (*name, format!("The reference: {}", title.to_lowercase()))
    });
    Command::new("help")
        .about("Print the help of a command, or a page of the reference")
        .disable_help_flag(true)
        .disable_help_subcommand(true)
        .subcommands(commands.iter().map(|(name, about)| plain(name, about.clone())))
        .subcommands(pages.map(|(name, about)| plain(name, about)))
        .subcommand(plain("man", "A man page".to_owned()).arg(of_command))
        .subcommand(plain("completions", "What completes words in a shell".to_owned()).arg(of_shell))
}

/// A script that offers files too where a setting takes them beside its names: shells are told of one or the other.
fn with_files(script: &str, shell: Shell) -> String {
    let mut script = script.to_owned();
    let settings = picture::all().filter(|setting| matches!(setting.values, Values::NamedOrWritten { .. }));
    for setting in settings {
        let names = values(setting).join(" ");
        script = match shell {
            Shell::Bash => script.replace(
                &format!("compgen -W \"{names}\""),
                &format!("compgen -f -W \"{names}\""),
            ),
            Shell::Zsh => script.replace(&format!(":({names})'"), &format!(":{{compadd -- {names}; _files}}'")),
            Shell::Fish => {
                let option = format!(" -l {} ", setting.option);
                let lines = script.split_inclusive('\n').map(|line| {
                    if line.starts_with("complete ") && line.contains(&option) {
                        line.replacen(" -r -f -a ", " -r -F -a ", 1)
                    } else {
                        line.to_owned()
                    }
                });
                lines.collect()
            }
            _ => script,
        };
    }
    script
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;
    use crate::cli::arguments::Arguments;

    fn script(shell: &str) -> String {
        let words = ["rasterscope", "help", "completions", shell].map(OsString::from);
        let made = completions(&words, &Arguments::command()).expect("asked for");
        made.expect("a known shell")
    }

    #[test]
    fn completions_offer_pages_beside_commands() {
        let page = |name: &str| PAGES.iter().any(|(page, _)| *page == name);
        assert!(page("options") && page("json"), "as the help lists them");
        for (shell, marks) in [("bash", [" ", " "]), ("zsh", ["'", ":"]), ("fish", ["-a \"", "\""])] {
            // The last word of bash's ends with a quotation mark.
            let script = script(shell).replace('"', if shell == "bash" { " " } else { "\"" });
            let others = ["man", "completions", "render"];
            for name in PAGES.iter().map(|(name, _)| *name).chain(others) {
                let [before, after] = marks;
                assert!(script.contains(&format!("{before}{name}{after}")), "{shell}: {name}");
            }
        }
    }

    #[test]
    fn completions_offer_values_and_files() {
        let bash = script("bash");
        assert!(bash.contains("compgen -f -W \"grid "), "patterns and files");
        assert!(bash.contains("compgen -W \"nearest bilinear "), "names alone");
        let after = bash.split("--vary)").nth(1).expect("of a board");
        let line = after.lines().nth(1).expect("what is offered");
        assert!(line.contains("pattern") && line.contains("level-sampling"), "{line}");
        let zsh = script("zsh");
        assert!(zsh.contains(":{compadd -- grid "), "patterns and files");
        let lists = zsh.lines().filter(|line| line.contains("'--level-sampling="));
        assert!(lists.clone().count() > 9, "every command");
        assert!(
            lists.into_iter().all(|line| line.contains("(zero nearest ")),
            "lists too"
        );
        let fish = script("fish");
        assert!(
            fish.lines()
                .any(|line| line.contains(" -l pattern ") && line.contains(" -r -F -a ")),
            "files"
        );
    }

    #[test]
    fn completions_ask_for_a_shell() {
        let words = ["rasterscope", "help", "completions"].map(OsString::from);
        let asked = completions(&words, &Arguments::command()).expect("asked for");
        let line = asked.expect_err("no shell");
        assert!(line.contains("zsh") && line.contains("fish"), "{line}");
        let more = ["rasterscope", "help", "render"].map(OsString::from);
        assert!(completions(&more, &Arguments::command()).is_none(), "another page");
    }
}
