//! `rasterscope board`: up to nine settings of one region beside the truth, in numbers and as a picture.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use serde::Serialize;

use super::failure::{Failure, print, print_error, print_json};
use super::options::board::BoardOptions;
use super::picture::{on_threads, read_scene, spec};
use super::render::{guard_of, name_for_png, unwritable};
use super::rounded::rounded;
use super::{interrupt, memory, progress};
use crate::figure::{Destination, Guard, Named, Record, save_picture};
use crate::raster::{Framebuffer, Region};
use crate::render::{Repeats, milliseconds};
use crate::scene::{DialectChoice, Scene};
use crate::viewer::{
    Axis, BoardCommandLine, BoardEntry, BoardMeasure, BoardPlace, BoardReport, BoardTile, MAX_ENTRIES, PictureSpec,
    Restored, SceneSource, picture,
};

/// Version of the JSON's shape; a field that changes its meaning raises it, a new one does not.
const SHAPE: u32 = 1;
/// Pixels along each side of the region that nobody chose.
const SIDE: u32 = 64;

/// Said below a table of zeros.
const NOTHING: &str = "\nNothing differs here: choose another part of the picture with --region X,Y,W,H.";

/// What `board --json` answers.
#[derive(Debug, Serialize)]
struct Report {
    version: u32,
    scene: String,
    width: u32,
    height: u32,
    /// Column, row, width and height of what is compared.
    region: [u32; 4],
    /// In which values the samples of the truth are averaged.
    truth_space: &'static str,
    sort: &'static str,
    /// The best first.
    entries: Vec<EntryReport>,
}

#[derive(Debug, Serialize)]
struct EntryReport {
    /// The settings that differ from those of the other options, by their names.
    settings: serde_json::Map<String, serde_json::Value>,
    rmse: f64,
    flip: f64,
    /// Of the whole frame: the median.
    time_ms: f64,
}

/// A board that was measured.
struct Measured {
    line: BoardCommandLine,
    place: BoardPlace,
    truth: Framebuffer,
    rows: Vec<(BoardEntry, BoardTile)>,
    /// As A reads it.
    scene: Arc<Scene>,
}

/// Measures, writes the picture where one was asked for, and prints the table.
pub(super) fn run(options: &BoardOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    let mut guard = guard_of(options.force, restored);
    if let SceneSource::File(path) = SceneSource::from_address(&options.scene) {
        guard.protect(path);
    }
    if let Some(output) = &options.output {
        name_for_png(output)?;
        // Asked before the work as well.
        let target = guard.target(output, Named::ByUser);
        target.map_err(|error| unwritable(output, &error))?;
    }
    let measured = on_threads(options.picture.framing.threads, || measure(options, restored))??;
    let report = measured.report();
    if let Some(output) = &options.output {
        measured.protect(&mut guard);
        let picture = report.picture(options.theme).map_err(Failure::Input)?;
        let record = measured.line.record(&measured.scene, output);
        save_picture(&picture, Some(&record), Destination::by_user(output), &guard)
            .map_err(|error| unwritable(output, &error))?;
    }
    if options.json {
        return print_json(&serde_json::to_string(&measured.told(&report)).map_err(Failure::other)?);
    }
    if options.table.csv {
        // A terminal wants no carriage returns.
        return print(report.table().csv().replace("\r\n", "\n").trim_end());
    }
    if options.table.markdown {
        return print(report.markdown().trim_end());
    }
    let nothing = if report.is_without_difference() { NOTHING } else { "" };
    print(&format!("{}\n{}{nothing}", report.table().text(), report.caption()))
}

/// The picture of a board and its record, for the file `output`, and what protects what it was drawn from.
pub(super) fn picture_of(options: &BoardOptions, output: &Path) -> Result<(Framebuffer, Record, Guard), Failure> {
    let measured = measure(options, None)?;
    let mut guard = Guard::default();
    measured.protect(&mut guard);
    let picture = measured.report().picture(options.theme).map_err(Failure::Input)?;
    Ok((picture, measured.line.record(&measured.scene, output), guard))
}

/// What A draws: the state that a board brings back.
pub(super) fn own(options: &BoardOptions) -> PictureSpec {
    PictureSpec {
        legend: false,
        ..spec(&options.scene, &options.picture)
    }
}

fn measure(options: &BoardOptions, restored: Option<&Restored>) -> Result<Measured, Failure> {
    let own = own(options);
    memory::ask_for(memory::pixels(own.size).saturating_mul(2))?;
    let region = region(options)?;
    let entries = entries(options, &own)?;
    let place = BoardPlace::new(own.clone(), region, options.truth_space);
    let stop = interrupt::token();
    let mut scenes = Scenes::new(&own, restored)?;
    progress::count(entries.len() + 1);
    let scene = Arc::clone(&scenes.own);
    let truth = place.draw_truth(&scene, &stop).ok_or_else(stopped)?;
    progress::done();
    let by = BoardMeasure {
        truth: &truth,
        repeats: Repeats {
            frames: options.frames,
            patience: Duration::MAX,
        },
        cancel: &stop,
    };
    let mut rows = Vec::new();
    for entry in &entries {
        let scene = scenes.read_in(entry.dialect)?;
        rows.push((*entry, place.measure(&scene, *entry, &by).ok_or_else(stopped)?));
        progress::done();
    }
    Ok(Measured {
        line: BoardCommandLine {
            own,
            entries,
            region,
            sort: options.sort,
            space: options.truth_space,
            ground: options.theme,
            frames: options.frames,
        },
        place,
        truth,
        rows,
        scene,
    })
}

fn stopped() -> Failure {
    interrupt::ended_with(" before everything was measured; nothing is written")
}

/// The region that was asked for, or one in the middle.
fn region(options: &BoardOptions) -> Result<Region, Failure> {
    let size = options.picture.size.0;
    let [width, height] = size;
    let Some(region) = options.region else {
        let [wide, high] = size.map(|side| side.min(SIDE));
        return Ok(Region {
            x: (width - wide) / 2,
            y: (height - high) / 2,
            width: wide,
            height: high,
        });
    };
    if region.intersection(Region::of_size(size)) == region {
        return Ok(region);
    }
    let Region { x, y, .. } = region;
    Err(Failure::input(format!(
        "--region {x},{y},{},{}: reaches outside the picture of {width}x{height} pixels; give one that lies inside, or a larger --size",
        region.width, region.height
    )))
}

/// The settings that are compared.
fn entries(options: &BoardOptions, own: &PictureSpec) -> Result<Vec<BoardEntry>, Failure> {
    let own = BoardEntry {
        render: own.render,
        dialect: own.dialect,
    };
    let mut entries: Vec<BoardEntry> = Vec::new();
    for text in &options.with {
        let entry = own.with(text).map_err(|problem| at_fault("--with", &problem))?;
        if let Some(problem) = entries.iter().find_map(|known| known.mistaken_for(entry)) {
            return Err(at_fault("--with", &problem));
        }
        if entries.iter().any(|known| known.is_like(entry)) {
            let problem = format!("{text} is on the board already; give every setting once");
            return Err(at_fault("--with", &problem));
        }
        entries.push(entry);
    }
    if let Some(text) = &options.vary {
        let varied = varied(text, own).map_err(|problem| at_fault("--vary", &problem))?;
        let is_new = |entry: &BoardEntry| !entries.iter().any(|known| known.is_like(*entry));
        let new: Vec<BoardEntry> = varied.into_iter().filter(is_new).collect();
        let known = || entries.iter().flat_map(|known| new.iter().map(move |new| (known, new)));
        if let Some(problem) = known().find_map(|(known, new)| known.mistaken_for(*new)) {
            return Err(at_fault("--vary", &problem));
        }
        entries.extend(new);
    }
    match entries.len() {
        0 => Err(Failure::input(
            "nothing to compare; give settings as --with \"sample-rate 16, pattern sobol\", or a setting as --vary pattern",
        )),
        count if count > MAX_ENTRIES => Err(Failure::input(format!(
            "a board holds at most {MAX_ENTRIES} settings, and these are {count}; give fewer, or name values: --vary pattern=grid,sobol"
        ))),
        _ => Ok(entries),
    }
}

fn at_fault(option: &str, problem: &str) -> Failure {
    Failure::input(format!("{option}: {problem}"))
}

/// The entries of `pattern`, of which the first nine are taken, or of `pattern=grid,sobol`.
fn varied(text: &str, own: BoardEntry) -> Result<Vec<BoardEntry>, String> {
    let Some((name, values)) = text.split_once('=') else {
        let name = text.trim();
        let setting = picture::known(name)?;
        let mut entries = own.vary(&Axis::first(setting))?;
        let count = entries.len();
        if count > MAX_ENTRIES {
            entries.truncate(MAX_ENTRIES);
            let besides = match setting.names_besides().as_slice() {
                [] => String::new(),
                names => format!(
                    ", also those that bring a number of samples of their own ({})",
                    names.join(", ")
                ),
            };
            print_error(&format!(
                "--vary {name}: the first {MAX_ENTRIES} of {count} values; name others as --vary {name}=VALUE,VALUE{besides}"
            ));
        }
        return Ok(entries);
    };
    own.vary_as_asked(&Axis::of(name.trim(), values)?)
}

/// The scene in every dialect that it was asked for.
struct Scenes {
    source: SceneSource,
    own_dialect: DialectChoice,
    own: Arc<Scene>,
    others: Vec<(DialectChoice, Arc<Scene>)>,
}

impl Scenes {
    fn new(own: &PictureSpec, restored: Option<&Restored>) -> Result<Self, Failure> {
        let scene = Arc::new(read_scene(&own.scene, own.dialect)?);
        if let Some(change) = restored.and_then(|restored| restored.changes(&scene.files)) {
            print_error(&change);
        }
        Ok(Self {
            source: own.scene.clone(),
            own_dialect: own.dialect,
            own: scene,
            others: Vec::new(),
        })
    }

    fn read_in(&mut self, dialect: DialectChoice) -> Result<Arc<Scene>, Failure> {
        if dialect == self.own_dialect {
            return Ok(Arc::clone(&self.own));
        }
        if let Some((_, scene)) = self.others.iter().find(|(known, _)| *known == dialect) {
            return Ok(Arc::clone(scene));
        }
        let scene = Arc::new(read_scene(&self.source, dialect)?);
        self.others.push((dialect, Arc::clone(&scene)));
        Ok(scene)
    }
}

impl Measured {
    fn report(&self) -> BoardReport<'_> {
        let rows = self.rows.iter().map(|(entry, tile)| (*entry, tile)).collect();
        BoardReport::new(&self.place, &self.truth, rows, self.line.sort)
    }

    /// Protects the scene and its textures from being written over.
    fn protect(&self, guard: &mut Guard) {
        self.line.own.scene.protect(&self.scene.files, guard);
    }

    /// For programs.
    fn told(&self, report: &BoardReport<'_>) -> Report {
        let own = BoardEntry {
            render: self.line.own.render,
            dialect: self.line.own.dialect,
        };
        let entry = |(entry, tile): &(BoardEntry, &BoardTile)| EntryReport {
            settings: entry
                .changes(own)
                .into_iter()
                .map(|(name, value)| (name.to_owned(), value.into()))
                .collect(),
            rmse: tile.numbers.rmse,
            flip: tile.numbers.flip,
            time_ms: rounded(milliseconds(tile.numbers.time)),
        };
        let ([width, height], region) = (self.place.truth.size, self.place.region);
        Report {
            version: SHAPE,
            scene: self.line.own.scene.address(),
            width,
            height,
            region: [region.x, region.y, region.width, region.height],
            truth_space: self.place.truth.render.resolve.name(),
            sort: self.line.sort.name(),
            entries: report.rows.iter().map(entry).collect(),
        }
    }
}
