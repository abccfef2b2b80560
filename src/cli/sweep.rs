//! `rasterscope sweep`: what each combination of settings costs, and how far its picture is from the truth.

mod files;

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use files::{chart_named, chart_of, check_outputs, check_targets, guard, unwritable};

use super::failure::{Failure, print, print_error};
use super::interrupt;
use super::memory::peak_of_drawing;
use super::options::lists::sampling;
use super::options::sweep::{Quality, SweepOptions};
use super::picture::{Picture, on_threads};
use super::render::unwritable_by;
use super::size::FrameSize;
use crate::compare::Pair;
use crate::figure::{
    Destination, Guard, NewFile, Plot, PlotSeries, Record, Table, draw_plot, save_files, save_picture,
};
use crate::raster::Framebuffer;
use crate::render::{CancelToken, Repeats, median, milliseconds};
use crate::scene::{DialectChoice, Scene};
use crate::viewer::{
    BoardNumbers, BoardSort, Choice, PictureSpec, Restored, SceneSource, as_path, picture, plain_record, scene_title,
};

/// Most combinations of a sweep.
const MAX_CHOICES: usize = 1000;
/// Pixels of the chart.
const CHART: [u32; 2] = [1500, 1000];
/// The setting of how many samples there are.
const RATE: &str = "sample-rate";
/// The columns of the table after those of the settings.
const COLUMNS: [&str; 7] = ["median_ms", "min_ms", "peak_mb", "rmse", "psnr_db", "ssim", "flip"];

/// What was measured of one combination.
#[derive(Clone, Copy, Debug)]
struct Row {
    median_ms: f64,
    min_ms: f64,
    /// Of a process that draws it and nothing else, where the system tells.
    peak_mb: Option<f64>,
    rmse: f64,
    psnr: f64,
    ssim: f64,
    flip: f64,
}

/// The combinations, and what was measured of them until Ctrl+C.
struct Sweep {
    specs: Vec<(Choice, PictureSpec)>,
    /// Of the first combinations.
    rows: Vec<Row>,
    record: Record,
}

/// What others are compared with.
struct Truth {
    spec: PictureSpec,
    frame: Framebuffer,
}

/// Measures every combination and writes table and chart.
pub(super) fn run(options: &SweepOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    let chart = chart_of(options);
    check_outputs(options, &chart)?;
    let mut guard = guard(options, restored)?;
    let specs = specs(options)?;
    let stop = interrupt::token();
    let measured = || measure(options, specs, restored, &stop, &mut guard);
    let sweep = on_threads(options.framing.threads, measured)??;
    let (done, all) = (sweep.rows.len(), sweep.specs.len());
    if done == 0 {
        let what = " before anything was measured; nothing is written";
        return Err(interrupt::ended_with(what));
    }
    // Minutes of work are in the tables; a chart that cannot be written must not cost them.
    sweep.write_tables(options, &guard)?;
    if done == all {
        print(&sweep.short_table(options).text())?;
        return sweep.write_chart(options, &chart, &guard);
    }
    if let Err(problem) = sweep.write_chart(options, &chart, &guard) {
        print_error(&problem.into_line());
    }
    let (are, table) = (if done == 1 { "is" } else { "are" }, options.csv.display());
    Err(interrupt::ended_with(&format!(
        ": {done} of {all} combinations {are} in {table}"
    )))
}

/// What each combination draws.
fn specs(options: &SweepOptions) -> Result<Vec<(Choice, PictureSpec)>, Failure> {
    let axes = &options.axes.0;
    if axes.count() > MAX_CHOICES {
        return Err(Failure::input(format!(
            "a sweep measures at most {MAX_CHOICES} combinations, and these lists make more; give fewer values"
        )));
    }
    let FrameSize(size) = options.size;
    let spec = |choice: Choice| {
        let sampling = sampling(&choice).map_err(Failure::Input)?;
        let spec = PictureSpec {
            scene: SceneSource::from_address(&options.scene),
            size,
            view: options.framing.view,
            render: sampling.settings(options.framing.view),
            dialect: options.axes.reading(&sampling),
            insets: Vec::new(),
            legend: false,
        };
        Ok((choice, spec))
    };
    axes.choices().into_iter().map(spec).collect()
}

fn measure(
    options: &SweepOptions,
    specs: Vec<(Choice, PictureSpec)>,
    restored: Option<&Restored>,
    stop: &CancelToken,
    guard: &mut Guard,
) -> Result<Sweep, Failure> {
    let mut scenes: Vec<(DialectChoice, Arc<Scene>)> = Vec::new();
    let mut truths: Vec<Truth> = Vec::new();
    let (mut rows, mut told) = (Vec::new(), Record::default());
    let bar = ProgressBar::new(specs.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    for (choice, spec) in &specs {
        bar.set_message(words(choice));
        let known = scenes.iter().find(|(dialect, _)| *dialect == spec.dialect);
        let scene = if let Some((_, scene)) = known {
            Arc::clone(scene)
        } else {
            let picture = Picture::read(spec.clone())?;
            picture.tell_changes(restored);
            picture.protect(guard);
            check_targets(options, guard)?;
            scenes.push((spec.dialect, Arc::clone(&picture.scene)));
            picture.scene
        };
        if rows.is_empty() {
            told = record(options, spec, &scene);
        }
        let mut picture = Picture::of(spec.clone(), Arc::clone(&scene));
        let repeats = Repeats {
            frames: options.frames,
            patience: Duration::MAX,
        };
        let row = picture.time_draws(repeats, stop).and_then(|times| {
            let truth = truth(&mut truths, &truth_of(options, spec), &scene, stop)?;
            let peak = peak_of_drawing(spec, options.framing.threads);
            row(times, peak, Pair::new(picture.frame(), truth).ok()?, stop)
        });
        // Half a combination is none.
        let Some(row) = row else { break };
        rows.push(row);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(Sweep {
        specs,
        rows,
        record: told,
    })
}

/// What the truth of a picture draws.
fn truth_of(options: &SweepOptions, spec: &PictureSpec) -> PictureSpec {
    PictureSpec {
        render: spec.render.truth_in(options.truth_space),
        ..spec.clone()
    }
}

/// A truth; drawn unless it is known. `None` when stopped.
fn truth<'t>(
    truths: &'t mut Vec<Truth>,
    spec: &PictureSpec,
    scene: &Arc<Scene>,
    stop: &CancelToken,
) -> Option<&'t Framebuffer> {
    if !truths.iter().any(|truth| truth.spec == *spec) {
        let mut picture = Picture::of(spec.clone(), Arc::clone(scene));
        picture.draw_unless(stop)?;
        // Lists rarely make several truths; two that alternate are not drawn again and again.
        truths.truncate(1);
        let frame = picture.into_frame();
        truths.insert(
            0,
            Truth {
                spec: spec.clone(),
                frame,
            },
        );
    }
    let known = truths.iter().find(|truth| truth.spec == *spec);
    known.filter(|_| !stop.is_cancelled()).map(|truth| &truth.frame)
}

/// What the times and the comparison of a picture with the truth say; `None` when stopped.
fn row(times: Vec<Duration>, peak_mb: Option<f64>, pair: Pair<'_>, stop: &CancelToken) -> Option<Row> {
    let levels = pair.levels();
    Some(Row {
        min_ms: milliseconds(times.iter().copied().min().unwrap_or_default()),
        median_ms: milliseconds(median(times)),
        peak_mb,
        rmse: levels.rmse(),
        psnr: levels.psnr(),
        ssim: pair.ssim(stop)?,
        flip: pair.flip(stop)?,
    })
}

/// The record of the chart: the command line that measures again.
fn record(options: &SweepOptions, first: &PictureSpec, scene: &Scene) -> Record {
    let mut words = vec![
        "sweep".to_owned(),
        as_path(&first.scene.address()),
        "--csv".to_owned(),
        as_path(&options.csv.display().to_string()),
    ];
    words.extend(options.axes.0.words());
    let [width, height] = first.size;
    words.extend([
        format!("--size={width}x{height}"),
        format!("--view={}", first.view_text()),
        format!("--frames={}", options.frames),
        format!("--quality={}", options.quality.name()),
    ]);
    words.extend(
        options
            .truth_space
            .map(|space| format!("--truth-space={}", space.name())),
    );
    let plain = plain_record(words, first.size);
    Record {
        arguments: plain.arguments,
        command_line: plain.command_line,
        differs: Some("a chart of times, which differ from run to run".to_owned()),
        ..first.record(scene, &chart_of(options))
    }
}

/// All values of a combination.
fn words(choice: &Choice) -> String {
    let words: Vec<String> = choice
        .iter()
        .map(|(name, value)| format!("{name} {}", short_value(name, value)))
        .collect();
    words.join(", ")
}

/// What people are shown of a value.
fn short_value<'v>(name: &str, value: &'v str) -> &'v str {
    picture::find(name).map_or(value, |setting| setting.short(value))
}

/// A value of a combination.
fn value<'c>(choice: &'c Choice, name: &str) -> &'c str {
    let known = choice.iter().find(|(known, _)| known == name);
    known.map_or("", |(_, value)| value)
}

impl Row {
    /// One of the numbers that tell how far a picture is from the truth.
    fn quality(&self, quality: Quality) -> f64 {
        match quality {
            Quality::Flip => self.flip,
            Quality::Ssim => self.ssim,
            Quality::Psnr => self.psnr,
            Quality::Rmse => self.rmse,
        }
    }

    /// What rows are sorted by.
    fn numbers(&self) -> BoardNumbers {
        BoardNumbers {
            rmse: self.rmse,
            flip: self.flip,
            time: Duration::from_secs_f64(self.median_ms / 1e3),
        }
    }

    /// The values of [`COLUMNS`]; empty where the system does not tell.
    fn cells(&self) -> [String; 7] {
        [
            format!("{:.4}", self.median_ms),
            format!("{:.4}", self.min_ms),
            self.peak_mb.map_or(String::new(), |peak| format!("{peak:.1}")),
            format!("{:.6}", self.rmse),
            format!("{:.4}", self.psnr),
            format!("{:.6}", self.ssim),
            format!("{:.6}", self.flip),
        ]
    }
}

impl Sweep {
    /// What was measured, in the order in which it is told.
    fn sorted(&self, sort: Option<BoardSort>) -> Vec<(&(Choice, PictureSpec), &Row)> {
        let mut rows: Vec<_> = self.specs.iter().zip(&self.rows).collect();
        if let Some(sort) = sort {
            rows.sort_by(|(_, a), (_, b)| sort.order(Some(&a.numbers()), Some(&b.numbers())));
        }
        rows
    }

    /// Names and values of the settings that are `told`, and what was measured.
    fn table(&self, options: &SweepOptions, told: impl Fn(&str) -> bool) -> Table {
        let of_choice = |choice: &Choice| -> Vec<(String, String)> {
            let told = choice.iter().filter(|(name, _)| told(name));
            told.map(|(name, value)| (name.clone(), short_value(name, value).to_owned()))
                .collect()
        };
        let first = self.specs.first();
        let named = first.map_or_else(Vec::new, |(choice, _)| of_choice(choice));
        let mut names: Vec<String> = named.into_iter().map(|(name, _)| name.replace('-', "_")).collect();
        let tells_rates = self.has_own_rates();
        names.extend(tells_rates.then(|| RATE.replace('-', "_")));
        names.extend(COLUMNS.map(str::to_owned));
        let rows = self.sorted(options.sort).into_iter();
        let lines = rows.map(|((choice, spec), row)| {
            let mut values: Vec<String> = of_choice(choice).into_iter().map(|(_, value)| value).collect();
            values.extend(tells_rates.then(|| spec.render.sample_rate.samples().to_string()));
            values.extend(row.cells());
            values
        });
        Table {
            lines: std::iter::once(names).chain(lines).collect(),
        }
    }

    /// The table for a reader, without settings that all rows share.
    fn short_table(&self, options: &SweepOptions) -> Table {
        self.table(options, |name| options.axes.0.axes().any(|axis| axis.name == name))
    }

    /// Whether patterns bring numbers of samples of their own, which no list tells.
    fn has_own_rates(&self) -> bool {
        let rate = |(_, spec): &(Choice, PictureSpec)| spec.render.sample_rate;
        let is_listed = |(choice, _): &(Choice, PictureSpec)| choice.iter().any(|(name, _)| name == RATE);
        let differ = self.specs.windows(2).any(|two| rate(&two[0]) != rate(&two[1]));
        differ && !self.specs.iter().any(is_listed)
    }

    /// Writes the tables, or none.
    fn write_tables(&self, options: &SweepOptions, guard: &Guard) -> Result<(), Failure> {
        let table = self.table(options, |_| true).csv();
        let mut files = vec![NewFile::by_user(&options.csv, table.into_bytes())];
        if let Some(markdown) = &options.markdown {
            let table = self.short_table(options).markdown();
            files.push(NewFile::by_user(markdown, table.into_bytes()));
        }
        save_files(&files, guard).map_err(|(path, error)| unwritable(&path, &error))
    }

    fn write_chart(&self, options: &SweepOptions, chart: &Path, guard: &Guard) -> Result<(), Failure> {
        match draw_plot(&self.plot(options), CHART) {
            Ok(picture) => {
                let (path, named) = (chart, chart_named(options));
                let saved = save_picture(&picture, Some(&self.record), Destination { path, named }, guard);
                saved.map_err(|error| unwritable_by("--plot", chart, &error))
            }
            // Signal to noise is infinite where pictures are equal.
            Err(problem) => {
                print_error(&format!("{}: no chart: {problem}", chart.display()));
                Ok(())
            }
        }
    }

    /// A line through all values of the first list, for each combination of the others.
    fn plot(&self, options: &SweepOptions) -> Plot {
        let axes: Vec<_> = options.axes.0.axes().collect();
        let first = axes.first();
        let rest = || axes.iter().skip(1);
        let measured: Vec<_> = self.specs.iter().zip(&self.rows).collect();
        let series = measured.chunks(first.map_or(1, |axis| axis.values.len())).map(|line| {
            let named = line.first().map(|((choice, _), _)| {
                let values: Vec<&str> = rest().map(|axis| axis.short(value(choice, &axis.name))).collect();
                values.join(", ")
            });
            let point = |((choice, _), row): &(&(Choice, PictureSpec), &Row)| {
                let words = first.map_or("", |axis| axis.short(value(choice, &axis.name)));
                ([row.median_ms, row.quality(options.quality)], words.to_owned())
            };
            PlotSeries {
                name: named.unwrap_or_default(),
                points: line.iter().map(point).collect(),
            }
        });
        let scene = scene_title(&SceneSource::from_address(&options.scene));
        Plot {
            title: first.map_or(scene.clone(), |axis| format!("{scene}: each point a {}", axis.title())),
            axes: [
                "milliseconds per frame, median".to_owned(),
                options.quality.title().to_owned(),
            ],
            heading: rest().map(|axis| axis.title()).collect::<Vec<_>>().join(", "),
            series: series.collect(),
        }
    }
}
