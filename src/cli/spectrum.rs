//! `rasterscope spectrum`: which waves a picture is made of, and which of them are aliases.

use std::path::Path;
use std::sync::Arc;

use serde::Serialize;

use super::failure::{Failure, print, print_json};
use super::options::spectrum::SpectrumOptions;
use super::picture::{Picture, on_threads, spec};
use super::render::{guard_of, name_for_png, unwritable, unwritable_by};
use super::rounded::rounded;
use crate::compare::{SpectrumAnalysis, SpectrumOf, SpectrumReading, Wave};
use crate::figure::{Destination, Guard, Named, NewFile, Record, TableOf, draw_spectrum, save_files, save_picture};
use crate::plain;
use crate::raster::{Framebuffer, Region};
use crate::scene::Scene;
use crate::viewer::{
    PictureSpec, Restored, SceneSource, SpectrumFound, SpectrumPlace, conditions_of, scene_title, spectrum_of,
};

/// Version of the JSON's shape; a field that changes its meaning raises it, a new one does not.
const SHAPE: u32 = 1;
/// The columns of the table.
const COLUMNS: &str =
    "across,down,wavelength,angle,decibels,amplitude,seen_across,seen_down,from_across,from_down,alias";

/// What `spectrum` answers; with `--json` in this shape.
#[derive(Debug, Serialize)]
struct Report {
    version: u32,
    scene: String,
    of: &'static str,
    width: u32,
    height: u32,
    /// Column, row, width and height of what was transformed: pixels, or texels of the level.
    region: [u32; 4],
    /// The mip level and its texture.
    #[serde(skip_serializing_if = "Option::is_none")]
    level: Option<String>,
    /// The highest frequency along an axis, in cycles per pixel or texel.
    reach: f64,
    /// The strongest waves, the strongest first.
    peaks: Vec<PeakReport>,
    /// The number that all pixels have, if they have one.
    #[serde(skip)]
    constant: Option<f64>,
}

#[derive(Debug, Serialize)]
struct PeakReport {
    /// To the right and down, in cycles per pixel or texel.
    frequency: [f64; 2],
    /// In pixels or texels.
    wavelength: f64,
    /// From stripe to stripe, in degrees clockwise from right.
    angle: f64,
    /// In levels of 255.
    amplitude: f64,
    decibels: f64,
    /// Of a texture: in cycles per pixel of the frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    in_pixels: Option<[f64; 2]>,
    /// Where pixels see it, if it is too fine for them; in cycles per pixel.
    #[serde(skip_serializing_if = "Option::is_none")]
    seen_at: Option<[f64; 2]>,
    /// The strongest finer wave of the scene that lands there, in cycles per pixel.
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<[f64; 2]>,
    /// The part of its power that finer waves account for.
    #[serde(skip_serializing_if = "Option::is_none")]
    alias: Option<f64>,
    /// Whether that is so much that the text tells of it.
    #[serde(skip)]
    is_alias: bool,
}

/// Finds the waves and prints what was found; writes the picture and the table where they were asked for.
pub(super) fn run(options: &SpectrumOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    let mut guard = guard_of(options.force, restored).of_tables(TableOf::Spectrum);
    if let SceneSource::File(path) = SceneSource::from_address(&options.scene) {
        guard.protect(path);
    }
    // Asked before the work as well.
    if let Some(output) = &options.output {
        name_for_png(output)?;
        let target = guard.target(output, Named::ByUser);
        target.map_err(|error| unwritable(output, &error))?;
    }
    if let Some(csv) = &options.csv {
        let target = guard.target(csv, Named::ByUser);
        target.map_err(|error| unwritable_by("--csv", csv, &error))?;
    }
    let region = region(options)?;
    let threads = options.picture.framing.threads;
    let (found, scene) = on_threads(threads, || find(options, region, restored, &mut guard))??;
    let report = Report::new(options, &found);
    if let Some(output) = &options.output {
        let picture = on_threads(threads, || draw_spectrum(&found.analysis, &report.heading(options)))?;
        let record = record(options, &scene, output);
        save_picture(&picture, Some(&record), Destination::by_user(output), &guard)
            .map_err(|error| unwritable(output, &error))?;
    }
    if let Some(csv) = &options.csv {
        save_files(&[NewFile::by_user(csv, report.table().into_bytes())], &guard)
            .map_err(|(path, error)| unwritable_by("--csv", &path, &error))?;
    }
    if options.json {
        return print_json(&serde_json::to_string(&report).map_err(Failure::other)?);
    }
    print(&report.text(options))
}

/// The picture of a spectrum and its record, for the file `output`, and what protects what it was drawn from.
pub(super) fn picture_of(options: &SpectrumOptions, output: &Path) -> Result<(Framebuffer, Record, Guard), Failure> {
    let mut guard = Guard::default();
    let (found, scene) = find(options, region(options)?, None, &mut guard)?;
    let heading = Report::new(options, &found).heading(options);
    let picture = draw_spectrum(&found.analysis, &heading);
    Ok((picture, record(options, &scene, output), guard))
}

/// The picture that is transformed: the state that a spectrum brings back.
pub(super) fn own(options: &SpectrumOptions) -> PictureSpec {
    PictureSpec {
        legend: false,
        ..spec(&options.scene, &options.picture)
    }
}

/// The command line that draws the spectrum again.
fn record(options: &SpectrumOptions, scene: &Scene, output: &Path) -> Record {
    let own = own(options);
    let mut words = own.options();
    words.push(format!("--of={}", options.of.name()));
    let region = options.region;
    words.extend(region.map(|Region { x, y, width, height }| format!("--region={x},{y},{width},{height}")));
    own.record_of_command(("spectrum", words), scene, output)
}

/// The region that was asked for, as far as the picture has it.
fn region(options: &SpectrumOptions) -> Result<Region, Failure> {
    let size @ [width, height] = options.picture.size.0;
    let all = Region::of_size(size);
    let Some(asked) = options.region else { return Ok(all) };
    let region = asked.intersection(all);
    if region.is_empty() {
        return Err(Failure::input(format!(
            "--region {},{},{},{}: outside the picture of {width}x{height} pixels; begin from 0,0 to {},{}",
            asked.x,
            asked.y,
            asked.width,
            asked.height,
            width - 1,
            height - 1
        )));
    }
    Ok(region)
}

fn find(
    options: &SpectrumOptions,
    region: Region,
    restored: Option<&Restored>,
    guard: &mut Guard,
) -> Result<(SpectrumFound, Arc<Scene>), Failure> {
    let picture = Picture::read(own(options))?;
    picture.tell_changes(restored);
    picture.protect(guard);
    let pixel = [region.x + region.width / 2, region.y + region.height / 2];
    let place = SpectrumPlace { region, pixel };
    let found = spectrum_of(&picture.subject(), options.picture.size.0, place, options.of);
    let found = found.ok_or_else(|| {
        let [x, y] = pixel;
        Failure::input(format!(
            "{}: pixel {x},{y}, in the middle of the region, shows no texture; give a --region around one that does",
            plain::line(&SceneSource::from_address(&options.scene).address())
        ))
    })?;
    Ok((found, picture.scene))
}

impl Report {
    fn new(options: &SpectrumOptions, found: &SpectrumFound) -> Self {
        let analysis = &found.analysis;
        let [width, height] = options.picture.size.0;
        let Region {
            x,
            y,
            width: columns,
            height: rows,
        } = analysis.region();
        let peaks = analysis.peaks(usize::from(options.peaks));
        Self {
            version: SHAPE,
            scene: SceneSource::from_address(&options.scene).address(),
            of: analysis.of().name(),
            width,
            height,
            region: [x, y, columns, rows],
            level: found.level.clone(),
            reach: analysis.reach(),
            constant: analysis.constant(),
            peaks: peaks.iter().map(|peak| PeakReport::new(peak, analysis)).collect(),
        }
    }

    /// What the picture says above: no folder, for one that is drawn again from elsewhere must be the same.
    fn heading(&self, options: &SpectrumOptions) -> String {
        let title = self.title(&scene_title(&SceneSource::from_address(&options.scene)));
        format!("{title}\n{}", conditions_of(&own(options)))
    }

    /// What it is of, and where.
    fn title(&self, scene: &str) -> String {
        let [x, y, columns, rows] = self.region;
        match (&self.level, self.of) {
            (Some(level), _) => format!("{}, {columns} x {rows} texels from {x}, {y}", plain::line(level)),
            (None, "difference") => format!("{scene} less the truth, {columns} x {rows} pixels from {x}, {y}"),
            (None, "scene") => format!("{scene} before sampling, {columns} x {rows} pixels from {x}, {y}"),
            (None, _) => format!("{scene}, {columns} x {rows} pixels from {x}, {y}"),
        }
    }

    fn text(&self, options: &SpectrumOptions) -> String {
        let title = self.title(&plain::line(&self.scene));
        let mut lines = vec![format!("{}: {title}", self.of)];
        let asked = options.region.unwrap_or(Region::of_size(options.picture.size.0));
        if self.level.is_none() && asked.width.max(asked.height) > SpectrumAnalysis::LONGEST {
            lines.push(format!(
                "The middle of the region: at most {0} x {0} pixels are transformed.",
                SpectrumAnalysis::LONGEST
            ));
        }
        if self.peaks.is_empty() {
            lines.push(self.no_waves().to_owned());
            return lines.join("\n");
        }
        let unit = if self.level.is_some() { "texel" } else { "pixel" };
        lines.push(format!("cycles per {unit}: across    down  wavelength   angle      dB"));
        lines.extend(self.peaks.iter().map(PeakReport::line));
        lines.join("\n")
    }

    /// Why there are none to list.
    fn no_waves(&self) -> &'static str {
        let is_difference = self.of == SpectrumOf::Difference.name();
        match (self.constant, is_difference) {
            (Some(0.0), true) => "No waves: the picture is the truth here.",
            (Some(_), true) => "No waves: all differs from the truth by the same.",
            (Some(_), false) => "No waves: all is of one colour.",
            (None, true) => {
                "No wave stands out: the error is that of edges, which are waves of every length, or slow shading."
            }
            (None, false) => "No wave stands out: there are edges, which are waves of every length, or slow shading.",
        }
    }

    /// The waves in RFC 4180; what is not there is empty.
    fn table(&self) -> String {
        let mut table = format!("{COLUMNS}\r\n");
        let pair = |pair: Option<[f64; 2]>| pair.map_or(",".to_owned(), |[x, y]| format!("{x},{y}"));
        for peak in &self.peaks {
            let [x, y] = peak.frequency;
            let PeakReport {
                wavelength,
                angle,
                decibels,
                amplitude,
                ..
            } = peak;
            let alias = peak.alias.map_or(String::new(), |alias| alias.to_string());
            let (seen, from) = (pair(peak.seen_at), pair(peak.from));
            let line = format!("{x},{y},{wavelength},{angle},{decibels},{amplitude},{seen},{from},{alias}\r\n");
            table.push_str(&line);
        }
        table
    }
}

impl PeakReport {
    fn new(peak: &SpectrumReading, analysis: &SpectrumAnalysis) -> Self {
        let Wave {
            frequency, amplitude, ..
        } = peak.wave;
        let is_texture = analysis.of() == SpectrumOf::Texture;
        let source = peak.source.filter(|(_, part)| *part > 0.0);
        Self {
            frequency: frequency.map(rounded),
            wavelength: rounded(peak.wave.wavelength()),
            angle: rounded(peak.wave.angle()),
            amplitude: rounded(amplitude),
            decibels: rounded(peak.wave.decibels()),
            in_pixels: is_texture.then_some(peak.in_pixels.map(rounded)),
            seen_at: peak.lands.map(|at| at.map(rounded)),
            from: source.map(|(wave, _)| wave.frequency.map(rounded)),
            alias: source.map(|(_, part)| rounded(part)),
            is_alias: peak.alias().is_some(),
        }
    }

    fn line(&self) -> String {
        let [x, y] = self.frequency;
        let numbers = format!(
            "{x:>24.4}  {y:>6.4}  {:>10.2}  {:>6.1}  {:>6.1}",
            self.wavelength, self.angle, self.decibels
        );
        let alias = self.from.filter(|_| self.is_alias);
        let words = [
            self.in_pixels.map(|[x, y]| format!("{x:.3}, {y:.3} per pixel")),
            self.seen_at.map(|[x, y]| format!("too fine: seen at {x:.3}, {y:.3}")),
            alias.map(|[x, y]| format!("alias of {x:.3}, {y:.3}")),
        ];
        let parts: Vec<String> = std::iter::once(numbers).chain(words.into_iter().flatten()).collect();
        parts.join("  ")
    }
}
