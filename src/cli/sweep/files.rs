//! The files of a sweep: where they go, and what must not be replaced by them.

use std::io;
use std::path::{Path, PathBuf};

use crate::cli::failure::Failure;
use crate::cli::options::sweep::SweepOptions;
use crate::cli::render::{guard_of, name_for_png, unwritable_by};
use crate::figure::{Guard, Named, Record, TableOf};
use crate::viewer::{Restored, SceneSource};

/// Where the chart goes.
pub(super) fn chart_of(options: &SweepOptions) -> PathBuf {
    let beside = || options.csv.with_extension("png");
    options.plot.clone().unwrap_or_else(beside)
}

/// Says before minutes of work what would fail after it.
pub(super) fn check_outputs(options: &SweepOptions, chart: &Path) -> Result<(), Failure> {
    let is_stream = std::fs::metadata(&options.csv).is_ok_and(|found| !found.is_file() && !found.is_dir());
    if options.plot.is_none() && is_stream {
        return Err(Failure::input(format!(
            "{}: no file, beside which a chart could lie; say with --plot where the chart goes",
            options.csv.display()
        )));
    }
    name_for_png(chart)?;
    let files: Vec<&Path> = outputs(options, chart).map(|(path, _)| path).collect();
    for (number, file) in files.iter().enumerate() {
        if files[..number].contains(file) {
            return Err(Failure::input(format!(
                "{}: tables and chart cannot be one file; end --csv in .csv, --markdown in .md",
                file.display()
            )));
        }
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
        if folder.is_some_and(|folder| !folder.is_dir()) {
            return Err(unwritable(file, &io::Error::from(io::ErrorKind::NotFound)));
        }
    }
    Ok(())
}

/// The files that are written, and who named them.
fn outputs<'o>(options: &'o SweepOptions, chart: &'o Path) -> impl Iterator<Item = (&'o Path, Named)> {
    let markdown = options.markdown.as_deref().map(|path| (path, Named::ByUser));
    let tables = [(options.csv.as_path(), Named::ByUser)].into_iter().chain(markdown);
    tables.chain([(chart, chart_named(options))])
}

/// A table or chart could not be written.
pub(super) fn unwritable(path: &Path, error: &io::Error) -> Failure {
    unwritable_by("--csv, --markdown or --plot", path, error)
}

/// Who chose the name of the chart.
pub(super) fn chart_named(options: &SweepOptions) -> Named {
    options.plot.as_ref().map_or(Named::ByProgram, |_| Named::ByUser)
}

/// Protects what is read, and says before minutes of work what must not be replaced.
pub(super) fn guard(options: &SweepOptions, restored: Option<&Restored>) -> Result<Guard, Failure> {
    let mut guard = guard_of(options.force, restored).of_tables(TableOf::Sweep);
    if let SceneSource::File(path) = SceneSource::from_address(&options.scene) {
        guard.protect(path);
    }
    check_targets(options, &guard)?;
    let chart = chart_of(options);
    if options.plot.is_none() && !options.force && is_of_another_command(&chart) {
        let chart = chart.display();
        return Err(Failure::input(format!(
            "{chart}: this picture is not a chart of a sweep, and would be lost; choose another place with --plot, or --force \
             replaces it"
        )));
    }
    Ok(guard)
}

/// Says before anything is measured which of the files would not be written.
pub(super) fn check_targets(options: &SweepOptions, guard: &Guard) -> Result<(), Failure> {
    for (path, named) in outputs(options, &chart_of(options)) {
        guard.target(path, named).map_err(|error| unwritable(path, &error))?;
    }
    Ok(())
}

/// Whether a picture is one of this program, and something else than a chart: nobody said that it may be replaced.
fn is_of_another_command(path: &Path) -> bool {
    let record = Record::of_file(path).ok().flatten();
    record.is_some_and(|record| record.arguments.first().is_none_or(|verb| verb != "sweep"))
}
