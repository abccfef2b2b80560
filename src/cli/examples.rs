//! Examples of each command, which its help and its man page end with.

use clap::Command;

/// Commands with their examples: a line to type, and what it does.
pub(super) const EXAMPLES: [(&str, &[(&str, &str)]); 14] = [
    (
        "view",
        &[
            ("rasterscope drawing.svg", "open a file"),
            (
                "rasterscope scenes/ --sample-rate 16",
                "a folder, with 16 samples per pixel",
            ),
            (
                "rasterscope drawing.svg --against sample-rate=1",
                "beside it the same with one sample",
            ),
        ],
    ),
    (
        "render",
        &[
            (
                "rasterscope render drawing.svg -o drawing.png --size 800x600",
                "one picture",
            ),
            (
                "rasterscope render scenes/ -o pictures --sample-rate 16",
                "every scene in a folder",
            ),
            (
                "rasterscope render drawing.svg -o tip.png --inset 120,80:16@8:auto",
                "with 16x16 pixels around 120,80 magnified eight times",
            ),
        ],
    ),
    (
        "sheet",
        &[
            (
                "rasterscope sheet drawing.svg --sample-rate 1,4,16 -o rates.png",
                "three sample rates side by side",
            ),
            (
                "rasterscope sheet drawing.svg --pattern grid,jittered --sample-rate 4,16 -o patterns.png",
                "two patterns in columns, two rates in rows",
            ),
        ],
    ),
    (
        "sweep",
        &[(
            "rasterscope sweep drawing.svg --sample-rate 1,4,16 --pattern grid,rotated --csv quality.csv",
            "time and distance from the truth of six combinations",
        )],
    ),
    (
        "board",
        &[
            (
                "rasterscope board drawing.svg --sample-rate 16 --vary pattern=grid,sobol,r2 -o patterns.png",
                "which of three patterns is nearest to the truth",
            ),
            (
                "rasterscope board drawing.svg --with A --with resolve-filter=mitchell --markdown",
                "two settings, as a table for documents",
            ),
        ],
    ),
    (
        "writeup",
        &[(
            "rasterscope writeup course -o figures",
            "every figure of the course's write-up",
        )],
    ),
    (
        "rerun",
        &[
            ("rasterscope rerun shot.png --check", "does it still look the same?"),
            (
                "rasterscope rerun shot.png -o again.png",
                "draw it again into another file",
            ),
        ],
    ),
    (
        "inspect",
        &[
            (
                "rasterscope inspect drawing.svg --pixel 120,80",
                "why that pixel has its colour",
            ),
            (
                "rasterscope inspect drawing.svg --pixel 120,80 --sample-rate 16 --json",
                "the same for programs",
            ),
        ],
    ),
    (
        "diff",
        &[
            (
                "rasterscope diff a.png b.png -o difference.png",
                "where two pictures differ",
            ),
            (
                "rasterscope diff drawing.svg other.png",
                "our drawing against another renderer's",
            ),
        ],
    ),
    (
        "lesson",
        &[
            ("rasterscope lesson six-tasks", "in the window"),
            ("rasterscope lesson own.toml --slides slides", "its steps as pictures"),
        ],
    ),
    (
        "bench",
        &[(
            "rasterscope bench drawing.svg --sample-rate 16 --frames 100 --json",
            "milliseconds per stage",
        )],
    ),
    (
        "pattern",
        &[
            ("rasterscope pattern --sample-rate 16", "all patterns beside each other"),
            ("rasterscope pattern sobol --seed 7 --json", "one, with all its points"),
            (
                "rasterscope pattern msaa-8 own.toml",
                "graphics hardware's beside one of a file",
            ),
        ],
    ),
    (
        "profile",
        &[
            (
                "rasterscope profile drawing.svg --line 100,80,140,80 --sample-rate 16",
                "how wide the edge between those pixels is",
            ),
            (
                "rasterscope profile drawing.svg --line 100,80,140,80 --csv edge.csv",
                "and every pixel's values in a table",
            ),
        ],
    ),
    (
        "spectrum",
        &[
            (
                "rasterscope spectrum drawing.svg --of scene -o spectrum.png",
                "which waves of the scene are too fine for the pixels, and where they land",
            ),
            (
                "rasterscope spectrum drawing.svg --region 300,200,128,128 --json",
                "the strongest waves of a part of the frame",
            ),
        ],
    ),
];

/// The program with the examples at the end of its commands' help.
pub(super) fn with_examples(program: Command) -> Command {
    EXAMPLES.into_iter().fold(program, |program, (name, examples)| {
        program.mut_subcommand(name, |command| {
            let before = command.get_after_help().map(|text| format!("{text}\n\n"));
            command.after_help(before.unwrap_or_default() + &text(examples))
        })
    })
}

fn text(examples: &[(&str, &str)]) -> String {
    let lines = examples.iter().map(|(line, what)| format!("  {line}\n      {what}\n"));
    format!("Examples:\n{}", lines.collect::<String>().trim_end())
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;

    use super::*;
    use crate::cli::restore::parse;

    #[test]
    fn examples_are_read_as_the_command_that_they_are_of() {
        for (name, examples) in EXAMPLES {
            for (line, _) in examples {
                let read = parse(line.split(' ').map(OsString::from));
                let (arguments, _) = read.unwrap_or_else(|failure| panic!("{line}: {failure:?}"));
                let verb = format!("{:?}", arguments.verb).to_lowercase();
                assert!(verb.starts_with(name), "{line}: {verb}");
            }
        }
    }
}
