//! The lines that people read: times per scene, and the table of the README, row by row as it was asked for.

use std::fmt::Write as _;
use std::io::Write as _;

use crate::race::{Timing, geometric_mean};

/// One row of the table: what was asked for and what came out.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) work: &'static str,
    pub(crate) must: &'static str,
    pub(crate) aim: &'static str,
    /// The result, by medians and by minima.
    pub(crate) here: String,
    /// The part of the benchmark that makes this row.
    pub(crate) part: &'static str,
}

/// Prints a line at once; a reader who has gone away is no reason to stop.
pub(crate) fn say(line: &str) {
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

/// Prints each rival's times of one scene.
pub(crate) fn say_times(scene: &str, [width, height]: [u32; 2], names: &[&str], timings: &[Timing]) {
    let mut line = format!("{scene:14} {width:4}x{height:4}");
    for (name, Timing { median, min }) in names.iter().zip(timings) {
        let _ = write!(line, "  {name} {median:.3} ({min:.3})");
    }
    say(&line);
}

/// How many times as long `theirs` take as `ours`, as geometric mean over frames: by medians, by minima.
pub(crate) fn ratio(theirs: &[Timing], ours: &[Timing]) -> [f64; 2] {
    let mean = |time: fn(&Timing) -> f64| {
        geometric_mean(theirs.iter().zip(ours).map(|(theirs, ours)| time(theirs) / time(ours)))
    };
    [mean(|timing| timing.median), mean(|timing| timing.min)]
}

/// A ratio for people: `1.74x (minima 1.70x)`.
pub(crate) fn times([median, min]: [f64; 2]) -> String {
    format!("{median:.2}x (minima {min:.2}x)")
}

/// The rows as Markdown.
pub(crate) fn markdown(rows: &[Row]) -> String {
    let mut text = "| work | must | aim | here | command |\n| --- | --- | --- | --- | --- |\n".to_owned();
    for Row {
        work,
        must,
        aim,
        here,
        part,
    } in rows
    {
        let _ = writeln!(
            text,
            "| {work} | {must} | {aim} | {here} | `cargo bench --bench frames -- {part}` |"
        );
    }
    text
}
