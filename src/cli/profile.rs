//! `rasterscope profile`: an edge in numbers, along a line across it, beside the truth.

use std::path::Path;

use serde::Serialize;

use super::failure::{Failure, print, print_json};
use super::options::profile::ProfileOptions;
use super::picture::{Picture, on_threads, spec};
use super::render::{guard_of, unwritable_by};
use super::rounded::rounded;
use crate::compare::{Edge, Line, LinePoint, Profile, ProfileChannel};
use crate::figure::{Guard, Named, NewFile, TableOf, save_files};
use crate::plain;
use crate::raster::Framebuffer;
use crate::render::{CancelToken, RenderSettings, Subject, draw_regions};
use crate::viewer::{Restored, SceneSource};

/// Version of the JSON's shape; a field that changes its meaning raises it, a new one does not.
const SHAPE: u32 = 1;
/// The columns of the table.
const COLUMNS: &str = "distance,x,y,red,green,blue,alpha,luma,true_red,true_green,true_blue,true_alpha,true_luma";

/// What `profile` answers; with `--json` in this shape.
#[derive(Debug, Serialize)]
struct Report {
    version: u32,
    scene: String,
    width: u32,
    height: u32,
    /// Columns and rows of the line's ends.
    line: [[i64; 2]; 2],
    channel: &'static str,
    picture: SideReport,
    /// The same with 256 samples per pixel.
    truth: SideReport,
    /// The line's pixels in order, as far as the picture has them.
    pixels: Vec<PixelReport>,
}

#[derive(Debug, Serialize)]
struct SideReport {
    /// How many different colours the line's pixels have.
    shades: usize,
    /// `null` where the first and the last quarter of the line are alike.
    edge: Option<EdgeReport>,
    /// Whether something changes between these.
    #[serde(skip)]
    changes: bool,
}

#[derive(Debug, Serialize)]
struct EdgeReport {
    /// The plateaus, in levels of 255.
    before: f64,
    behind: f64,
    /// Where a tenth of the step and nine tenths are reached, in pixels along the line.
    from: f64,
    to: f64,
    /// The 10-90 % width, in pixels along the line.
    width: f64,
    /// In parts of the step.
    overshoot: f64,
    undershoot: f64,
    /// Whether there is no other edge: then alone width, overshoot and undershoot are those of an edge.
    alone: bool,
    /// What the values do otherwise, in a few words.
    #[serde(skip)]
    more_than_an_edge: Option<&'static str>,
}

#[derive(Debug, Serialize)]
struct PixelReport {
    distance: f64,
    x: u32,
    y: u32,
    /// Red, green, blue, alpha.
    color: [u8; 4],
    truth: [u8; 4],
}

/// Measures the edge and prints what was found; writes the table where one was asked for.
pub(super) fn run(options: &ProfileOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    let mut guard = guard_of(options.force, restored).of_tables(TableOf::Profile);
    if let SceneSource::File(path) = SceneSource::from_address(&options.scene) {
        guard.protect(path);
    }
    if let Some(csv) = &options.csv {
        // Asked before the work as well.
        let target = guard.target(csv, Named::ByUser);
        target.map_err(|error| unwritable_by("--csv", csv, &error))?;
    }
    let size = options.picture.size.0;
    if options.line.points(size).is_empty() {
        return Err(outside(options.line, size));
    }
    let threads = options.picture.framing.threads;
    let profiles = on_threads(threads, || draw(options, restored, &mut guard))??;
    if let Some(csv) = &options.csv {
        save(csv, &profiles, &guard)?;
    }
    let report = Report::new(options, &profiles);
    if options.json {
        return print_json(&serde_json::to_string(&report).map_err(Failure::other)?);
    }
    print(&report.text())
}

fn outside(line: Line, [width, height]: [u32; 2]) -> Failure {
    let [[a, b], [c, d]] = line.ends;
    Failure::input(format!(
        "--line {a},{b},{c},{d}: outside the picture of {width}x{height} pixels; give places from 0,0 to {},{}",
        width - 1,
        height - 1
    ))
}

/// The picture's values along the line, and the truth's.
fn draw(options: &ProfileOptions, restored: Option<&Restored>, guard: &mut Guard) -> Result<[Profile; 2], Failure> {
    let picture = Picture::read(spec(&options.scene, &options.picture))?;
    picture.tell_changes(restored);
    picture.protect(guard);
    let own = picture.subject();
    let [width, height] = options.picture.size.0;
    let mut frame = Framebuffer::new(width, height);
    let regions = options.line.regions([width, height]);
    let profile = |settings: RenderSettings| {
        let subject = Subject {
            settings: &settings,
            ..own
        };
        // Nobody cancels.
        draw_regions(&subject, &mut frame, &regions, &CancelToken::default());
        Profile::of(&frame, options.line)
    };
    Ok([*own.settings, own.settings.truth()].map(profile))
}

/// Writes the table (RFC 4180; numbers only).
fn save(csv: &Path, profiles: &[Profile; 2], guard: &Guard) -> Result<(), Failure> {
    let mut table = format!("{COLUMNS}\r\n");
    for (point, own, truth) in pixels(profiles) {
        let cells = |pixel: u32| {
            let [a, r, g, b] = pixel.to_be_bytes();
            format!("{r},{g},{b},{a},{:.3}", ProfileChannel::Luma.value(pixel))
        };
        let [x, y] = point.at;
        let line = format!("{:.4},{x},{y},{},{}\r\n", point.distance, cells(own), cells(truth));
        table.push_str(&line);
    }
    save_files(&[NewFile::by_user(csv, table.into_bytes())], guard)
        .map_err(|(path, error)| unwritable_by("--csv", &path, &error))
}

/// Every pixel of the line with its colour and the true one.
fn pixels([own, truth]: &[Profile; 2]) -> impl Iterator<Item = (&LinePoint, u32, u32)> {
    let colors = own.colors().iter().zip(truth.colors());
    own.points()
        .iter()
        .zip(colors)
        .map(|(point, (own, truth))| (point, *own, *truth))
}

impl Report {
    fn new(options: &ProfileOptions, profiles: &[Profile; 2]) -> Self {
        let [picture, truth] = [0, 1].map(|side| SideReport::new(&profiles[side], options.channel));
        let rgba = |pixel: u32| {
            let [a, r, g, b] = pixel.to_be_bytes();
            [r, g, b, a]
        };
        let pixel = |(point, own, truth): (&LinePoint, u32, u32)| PixelReport {
            distance: rounded(point.distance),
            x: point.at[0],
            y: point.at[1],
            color: rgba(own),
            truth: rgba(truth),
        };
        let [width, height] = options.picture.size.0;
        Self {
            version: SHAPE,
            scene: SceneSource::from_address(&options.scene).address(),
            width,
            height,
            line: options.line.ends,
            channel: options.channel.name(),
            picture,
            truth,
            pixels: pixels(profiles).map(pixel).collect(),
        }
    }

    fn text(&self) -> String {
        let [[a, b], [c, d]] = self.line;
        let count = match self.pixels.len() {
            1 => "1 pixel".to_owned(),
            count => format!("{count} pixels"),
        };
        // The rest of the line lies outside; what is measured is of the part that does not.
        let whole = a.abs_diff(c).max(b.abs_diff(d)).saturating_add(1);
        let is_cut = u64::try_from(self.pixels.len()).is_ok_and(|count| count < whole);
        let cut = if is_cut { " of it in the picture" } else { "" };
        let head = format!(
            "{}: line from {a}, {b} to {c}, {d}, {count}{cut}, {} in levels of 255",
            plain::line(&self.scene),
            self.channel
        );
        let columns = "         shades  before  behind  10-90 % width  overshoot  undershoot";
        let mut lines = vec![
            head,
            columns.to_owned(),
            self.picture.line("picture"),
            self.truth.line("truth"),
        ];
        lines.extend(self.not_measured());
        lines.join("\n")
    }

    /// Why width, overshoot and undershoot are left out, for each side or for both.
    fn not_measured(&self) -> Vec<String> {
        let why = |side: &SideReport| side.edge.as_ref()?.more_than_an_edge;
        let line = |side: &str, values: &str| {
            format!(
                "In the {side} the values {values}: width, overshoot and undershoot would be those of no single edge."
            )
        };
        let [picture, truth] = [why(&self.picture), why(&self.truth)];
        match picture {
            Some(both) if picture == truth => vec![line("picture and in the truth", both)],
            _ => {
                let sides = [("picture", picture), ("truth", truth)].into_iter();
                sides.filter_map(|(side, why)| Some(line(side, why?))).collect()
            }
        }
    }
}

impl SideReport {
    fn new(profile: &Profile, channel: ProfileChannel) -> Self {
        Self {
            shades: profile.shades(),
            edge: profile.edge(channel).map(EdgeReport::new),
            changes: profile.changes_within(channel),
        }
    }

    fn line(&self, name: &str) -> String {
        let start = format!("{name:<7}  {:>6}", self.shades);
        let Some(edge) = &self.edge else {
            let why = if self.changes {
                "the first and the last quarter of the line are alike; let it begin and end farther from the edge"
            } else {
                "both ends of the line are alike"
            };
            return format!("{start}  no edge: {why}");
        };
        let start = format!("{start}  {:>6.1}  {:>6.1}", edge.before, edge.behind);
        if !edge.alone {
            let none = "\u{2013}";
            return format!("{start}  {none:>13}  {none:>9}  {none:>10}");
        }
        format!(
            "{start}  {:>10.2} px  {:>7.1} %  {:>8.1} %",
            edge.width,
            edge.overshoot * 100.0,
            edge.undershoot * 100.0
        )
    }
}

impl EdgeReport {
    fn new(edge: Edge) -> Self {
        let ([before, behind], [from, to]) = (edge.plateaus.map(rounded), edge.rise.map(rounded));
        Self {
            before,
            behind,
            from,
            to,
            width: rounded(edge.width()),
            overshoot: rounded(edge.overshoot),
            undershoot: rounded(edge.undershoot),
            alone: edge.is_alone(),
            more_than_an_edge: edge.more_than_an_edge(),
        }
    }
}
