//! `rasterscope diff`: how far two pictures, or our drawing of a scene and a picture, are apart.

use std::path::Path;

use serde::Serialize;

use super::failure::{Failure, print, print_json};
use super::memory;
use super::options::diff::{DiffOptions, MAX_PIXELS};
use super::options::framing::PictureOptions;
use super::picture::spec;
use super::picture::{Picture, on_threads};
use super::render::{name_for_png, unwritable};
use super::rounded::rounded;
use super::size::FrameSize;
use crate::compare::{self, DifferenceStyle, Gain, Guess, Levels, Pair, Place};
use crate::figure::{Destination, Guard, Named, Record, save_picture};
use crate::geometry::View;
use crate::inspect::counted;
use crate::plain;
use crate::raster::Framebuffer;
use crate::render::CancelToken;
use crate::scene::{self, FolderResources};
use crate::viewer::{SceneSource, as_path, input_file, plain_record};

/// Version of the JSON's shape; a field that changes its meaning raises it, a new one does not.
const SHAPE: u32 = 1;
/// How many of the places that differ most are told.
const PLACES: usize = 5;

/// What `diff` answers; with `--json` in this shape. Differences are levels of 255.
#[derive(Debug, Serialize)]
struct Report {
    version: u32,
    a: String,
    b: String,
    width: u32,
    height: u32,
    /// Channels that count: 3, or 4 where a picture is not opaque.
    channels: u8,
    tolerance: u8,
    /// Whether no channel of any pixel differs by more than the tolerance; the exit status says the same.
    within_tolerance: bool,
    differing_pixels: u64,
    pixels_beyond_tolerance: u64,
    /// The largest difference of each channel; `null` where it is equal everywhere.
    largest: Channels,
    mae: f64,
    rmse: f64,
    /// In decibels; `null` for equal pictures, whose ratio is infinite.
    psnr: Option<f64>,
    ssim: f64,
    flip: f64,
    /// Pixels that differ most, the largest first, at most one from each block of 16 x 16 pixels.
    places: Vec<PlaceReport>,
    /// The difference picture; `null` where none was asked for.
    picture: Option<PictureReport>,
    /// Why a scene's drawing differs from the picture; `null` for two pictures, and where nothing differs.
    guess: Option<GuessReport>,
}

#[derive(Debug, Serialize)]
struct GuessReport {
    /// In words, the weightiest first; empty where nothing known explains the difference.
    causes: Vec<String>,
    /// The share of the squared difference that they explain together, from 0 to 1.
    explained: f64,
    /// Whether they leave so much that others may do as well.
    #[serde(skip)]
    leaves_a_part: bool,
    /// Whether time was up before everything was tried.
    stopped: bool,
}

#[derive(Debug, Serialize)]
struct Channels {
    red: Option<LargestReport>,
    green: Option<LargestReport>,
    blue: Option<LargestReport>,
    alpha: Option<LargestReport>,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct LargestReport {
    level: u8,
    x: u32,
    y: u32,
}

#[derive(Debug, Serialize)]
struct PlaceReport {
    x: u32,
    y: u32,
    /// Of red, green, blue, alpha.
    levels: [u8; 4],
}

#[derive(Debug, Serialize)]
struct PictureReport {
    file: String,
    mode: &'static str,
    gain: f64,
}

/// Compares the pictures, prints what was found, and fails where they differ.
pub(super) fn run(options: &DiffOptions) -> Result<(), Failure> {
    if let Some(output) = &options.output {
        name_for_png(output)?;
        // Asked before the work as well.
        let target = guard(options, None).target(output, Named::ByUser);
        target.map_err(|error| unwritable(output, &error))?;
    }
    let report = on_threads(options.framing.threads, || measure(options))??;
    if options.json {
        print_json(&serde_json::to_string(&report).map_err(Failure::other)?)?;
    } else {
        print(&report.text())?;
    }
    if report.within_tolerance {
        Ok(())
    } else {
        Err(Failure::Different)
    }
}

fn measure(options: &DiffOptions) -> Result<Report, Failure> {
    with_pair(options, |pair, ours| {
        let mut report = Report::new(pair, options);
        if let Some(output) = &options.output {
            report.picture = Some(save(pair, ours, output, options)?);
        }
        if let Some(ours) = ours.filter(|_| report.differing_pixels > 0) {
            let guess = compare::guess(&ours.subject(), pair.b(), Guess::BUDGET, &CancelToken::default());
            report.guess = guess.map(|guess| GuessReport::new(&guess));
        }
        Ok(report)
    })
}

/// The difference picture and its record, for the file `output`, and what protects its inputs.
pub(super) fn picture(options: &DiffOptions, output: &Path) -> Result<(Framebuffer, Record, Guard), Failure> {
    with_pair(options, |pair, ours| {
        let (frame, _) = shown(pair, options);
        let record = record(pair.size(), output, options, ours);
        Ok((frame, record, guard(options, ours)))
    })
}

/// Hands over both pictures; and what was drawn for it, where A is a scene.
fn with_pair<R>(
    options: &DiffOptions,
    work: impl FnOnce(Pair<'_>, Option<&Picture>) -> Result<R, Failure>,
) -> Result<R, Failure> {
    let [first, second] = [&options.a, &options.b];
    if is_scene(second) {
        return Err(Failure::input(format!(
            "{}: a scene can be the first of the two only; draw this one with `rasterscope render`",
            second.display()
        )));
    }
    if !is_scene(first) {
        refuse_drawing(options)?;
    }
    let b = Encoded::read(second, options.max_pixels)?;
    let frames = 1 + u64::from(options.output.is_some());
    memory::ask_for_comparing(memory::pixels(b.size).saturating_mul(frames))?;
    if is_scene(first) {
        let mut ours = Picture::read(spec(first, &drawing(options, b.size)))?;
        let theirs = b.decode(second)?;
        ours.draw();
        let pair = Pair::new(ours.frame(), &theirs).map_err(Failure::input)?;
        return work(pair, Some(&ours));
    }
    let a = Encoded::read(first, options.max_pixels)?;
    if a.size != b.size {
        let (ours, theirs) = (b.size, a.size);
        return Err(Failure::input(format!(
            "{}: {} x {} pixels, but {} has {} x {}; compare pictures of one size",
            second.display(),
            ours[0],
            ours[1],
            first.display(),
            theirs[0],
            theirs[1]
        )));
    }
    let (a, b) = (a.decode(first)?, b.decode(second)?);
    work(Pair::new(&a, &b).map_err(Failure::input)?, None)
}

/// Refuses options of drawing where nothing is drawn.
fn refuse_drawing(options: &DiffOptions) -> Result<(), Failure> {
    let view = (options.framing.view != View::Default).then_some("view");
    match options.sampling.given().first().copied().or(view) {
        Some(option) => Err(Failure::input(format!(
            "--{option}: of two pictures none is drawn; leave it out, or give a scene in place of {}",
            options.a.display()
        ))),
        None => Ok(()),
    }
}

/// Our drawing of the scene that is A, as large as B.
fn drawing(options: &DiffOptions, size: [u32; 2]) -> PictureOptions {
    PictureOptions {
        size: FrameSize(size),
        sampling: options.sampling.clone(),
        framing: options.framing.clone(),
    }
}

/// Whether a path names a scene and no picture.
pub(super) fn is_scene(path: &Path) -> bool {
    matches!(SceneSource::from_address(path), SceneSource::Gallery(_)) || scene::is_document(path)
}

/// The bytes of a picture that is not decoded yet, and its size.
struct Encoded {
    bytes: Vec<u8>,
    size: [u32; 2],
}

impl Encoded {
    /// Refuses more than `most` pixels.
    fn read(path: &Path, most: u64) -> Result<Self, Failure> {
        let bytes = FolderResources::read_file(path).map_err(|error| {
            let line = format!("{}: {error}; give a PNG or JPEG picture", path.display());
            if error.is_of_memory() {
                Failure::other(line)
            } else {
                Failure::input(line)
            }
        })?;
        let size = compare::encoded_size(&bytes).map_err(|error| unreadable(path, &error))?;
        let [width, height] = size;
        let pixels = u64::from(width) * u64::from(height);
        if pixels > most {
            return Err(Failure::input(format!(
                "{}: {width} x {height} pixels are more than {most}; compare smaller pictures, or allow as many with \
                 --max-pixels {pixels}",
                path.display()
            )));
        }
        Ok(Self { bytes, size })
    }

    fn decode(self, path: &Path) -> Result<Framebuffer, Failure> {
        compare::decode_picture(&self.bytes).map_err(|error| unreadable(path, &error))
    }
}

fn unreadable(path: &Path, error: &dyn std::fmt::Display) -> Failure {
    Failure::input(format!(
        "{}: cannot be read as a picture: {error}; give a whole PNG or JPEG",
        path.display()
    ))
}

/// The difference picture, and the gain that it has.
fn shown(pair: Pair<'_>, options: &DiffOptions) -> (Framebuffer, f32) {
    let style = DifferenceStyle {
        measure: options.mode,
        gain: if options.normalize {
            Gain::Normalize
        } else {
            Gain::Factor(options.gain)
        },
    };
    let mut frame = Framebuffer::default();
    let gain = pair.show(style, &mut frame);
    (frame, gain)
}

/// Protects both pictures, and the textures of one that was drawn.
fn guard(options: &DiffOptions, ours: Option<&Picture>) -> Guard {
    let mut guard = Guard::default().with(&options.a).with(&options.b);
    if let Some(ours) = ours {
        ours.protect(&mut guard);
    }
    guard
}

/// Saves the difference picture.
fn save(
    pair: Pair<'_>,
    ours: Option<&Picture>,
    output: &Path,
    options: &DiffOptions,
) -> Result<PictureReport, Failure> {
    let (frame, gain) = shown(pair, options);
    let record = record(pair.size(), output, options, ours);
    let guard = guard(options, ours);
    save_picture(&frame, Some(&record), Destination::by_user(output), &guard)
        .map_err(|error| unwritable(output, &error))?;
    Ok(PictureReport {
        file: output.display().to_string(),
        mode: options.mode.name(),
        gain: rounded(f64::from(gain)),
    })
}

/// The record of a difference picture: its command line compares two files, so that no scene comes back from it.
fn record(size: [u32; 2], output: &Path, options: &DiffOptions, ours: Option<&Picture>) -> Record {
    let path = |path: &Path| as_path(&path.display().to_string());
    let mut words = vec!["diff".to_owned(), path(&options.a), path(&options.b)];
    words.extend([
        "-o".to_owned(),
        path(output),
        "--mode".to_owned(),
        options.mode.name().to_owned(),
    ]);
    if options.normalize {
        words.push("--normalize".to_owned());
    } else {
        words.push(format!("--gain={}", options.gain));
    }
    if options.max_pixels != MAX_PIXELS {
        words.extend(["--max-pixels".to_owned(), options.max_pixels.to_string()]);
    }
    if is_scene(&options.a) {
        // The size is that of B.
        words.extend(spec(&options.a, &drawing(options, size)).options().drain(2..));
    }
    // A scene of the gallery is no file.
    let drawn = ours.map(|ours| ours.record(output));
    let (scene, textures) = drawn.map_or((None, Vec::new()), |drawn| (drawn.scene, drawn.textures));
    let a = scene.unwrap_or_else(|| input_file(&options.a, output));
    Record {
        inputs: vec![a, input_file(&options.b, output)],
        textures,
        ..plain_record(words, size)
    }
}

impl Report {
    fn new(pair: Pair<'_>, options: &DiffOptions) -> Self {
        let levels: Levels = pair.levels();
        let never = CancelToken::default();
        let [red, green, blue, alpha] = levels.largest.map(|largest| {
            largest.map(|largest| LargestReport {
                level: largest.level,
                x: largest.at[0],
                y: largest.at[1],
            })
        });
        let beyond = levels.beyond(options.tolerance);
        Self {
            version: SHAPE,
            a: options.a.display().to_string(),
            b: options.b.display().to_string(),
            width: pair.size()[0],
            height: pair.size()[1],
            channels: levels.channels,
            tolerance: options.tolerance,
            within_tolerance: beyond == 0,
            differing_pixels: levels.differing(),
            pixels_beyond_tolerance: beyond,
            largest: Channels {
                red,
                green,
                blue,
                alpha,
            },
            mae: levels.mae(),
            rmse: levels.rmse(),
            psnr: Some(levels.psnr()).filter(|ratio| ratio.is_finite()),
            // Nobody cancels, so that both are there.
            ssim: pair.ssim(&never).unwrap_or_default(),
            flip: pair.flip(&never).unwrap_or_default(),
            places: pair.places(PLACES).into_iter().map(PlaceReport::new).collect(),
            picture: None,
            guess: None,
        }
    }

    fn text(&self) -> String {
        let pixels = u64::from(self.width) * u64::from(self.height);
        let share = |count: u64| match count as f64 * 100.0 / pixels as f64 {
            share if count > 0 && share < 0.01 => "under 0.01 %".to_owned(),
            share => format!("{share:.2} %"),
        };
        let mut lines = vec![
            format!("A  {}\nB  {}", plain::line(&self.a), plain::line(&self.b)),
            format!("{} x {} pixels", self.width, self.height),
        ];
        if self.differing_pixels == 0 {
            let aside = match self.channels {
                3 => "",
                _ => "\nColours of transparent pixels are not compared.",
            };
            lines.push(format!(
                "The pictures are equal: all pixels, in 8 bits per channel.{aside}"
            ));
        }
        let count = |count| format!("{count} of {pixels} ({})", share(count));
        lines.push(format!("differing pixels   {}", count(self.differing_pixels)));
        if self.tolerance > 0 {
            let counted = count(self.pixels_beyond_tolerance);
            lines.push(format!("beyond {:3} levels  {counted}", self.tolerance));
        }
        lines.extend(self.largest.lines());
        let psnr = self
            .psnr
            .map_or("infinite".to_owned(), |ratio| format!("{ratio:.2} dB"));
        lines.push(format!("mean error         {:.4} levels of 255 (MAE)", self.mae));
        lines.push(format!("root mean square   {:.4} levels of 255 (RMSE)", self.rmse));
        lines.push(format!("PSNR               {psnr}"));
        lines.push(format!("SSIM               {:.6} (1: same structure)", self.ssim));
        lines.push(format!(
            "FLIP               {:.6} (0: nobody sees a difference)",
            self.flip
        ));
        if !self.places.is_empty() {
            let places: Vec<String> = self
                .places
                .iter()
                .map(|place| format!("({}, {})", place.x, place.y))
                .collect();
            lines.push(format!("differ most at     {}", places.join("\n                   ")));
        }
        if let Some(picture) = &self.picture {
            lines.push(format!(
                "{}: {} difference x {}",
                plain::line(&picture.file),
                picture.mode,
                picture.gain
            ));
        }
        lines.extend(self.guess.as_ref().map(GuessReport::text));
        lines.join("\n")
    }
}

impl GuessReport {
    fn new(guess: &Guess) -> Self {
        Self {
            causes: guess.causes.iter().map(ToString::to_string).collect(),
            explained: guess.explained(),
            leaves_a_part: guess.leaves_a_part(),
            stopped: guess.stopped,
        }
    }

    fn text(&self) -> String {
        let stopped = if self.stopped {
            let seconds = Guess::BUDGET.as_secs();
            format!("\n  (not all was tried in {seconds} s; a smaller picture takes less time)")
        } else {
            String::new()
        };
        if self.causes.is_empty() {
            let none = if self.stopped {
                "no cause was found until time was up"
            } else {
                "no known cause explains the difference"
            };
            return format!("guess at the cause {none}{stopped}");
        }
        // Rounded down, so that 100 % means all of it.
        let percent = (self.explained * 1000.0).floor() / 10.0;
        let others = if self.leaves_a_part {
            "\n  (a part is left: other causes, or more of them at once, may do as well)"
        } else {
            ""
        };
        format!(
            "guess at the cause explains {percent} % of the squared difference:\n  {}{others}{stopped}",
            self.causes.join("\n  and ")
        )
    }
}

impl Channels {
    /// One line for each channel that differs.
    fn lines(&self) -> impl Iterator<Item = String> {
        let named = [
            ("red", self.red),
            ("green", self.green),
            ("blue", self.blue),
            ("alpha", self.alpha),
        ];
        named.into_iter().filter_map(|(name, largest)| {
            let LargestReport { level, x, y } = largest?;
            let levels = counted(level.into(), "level");
            Some(format!("largest in {name:5}   {levels}, first at ({x}, {y})"))
        })
    }
}

impl PlaceReport {
    fn new(place: Place) -> Self {
        Self {
            x: place.at[0],
            y: place.at[1],
            levels: place.levels,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Cause;
    use crate::rules::Rules;

    #[test]
    fn guess_that_leaves_a_part_says_that_others_may_do_as_well() {
        let told = |after| {
            let guess = Guess {
                causes: vec![Cause::Rules(Rules::Course)],
                before: 100_000,
                after,
                stopped: false,
            };
            GuessReport::new(&guess).text()
        };
        let note = "may do as well";
        let some = told(300);
        assert!(some.contains("explains 99.7 %") && some.contains(note), "{some}");
        assert!(some.lines().all(|line| line.chars().count() <= 80), "{some}");
        for after in [0, 20] {
            assert!(!told(after).contains(note), "{after} is rounding: {}", told(after));
        }
    }
}
