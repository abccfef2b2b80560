//! One entry of a board in pixels and numbers: a region of its frame, beside the same region of the truth.

use crate::color::ResolveSpace;
use crate::compare::Pair;
use crate::raster::{Framebuffer, Region};
use crate::render::{CancelToken, RenderSettings, Repeats, Subject, draw_regions, median, time_draws};
use crate::scene::Scene;
use crate::viewer::ab::sides::truth_words;
use crate::viewer::board::entry::BoardEntry;
use crate::viewer::board::numbers::BoardNumbers;
use crate::viewer::export::spec::PictureSpec;
use crate::viewer::settings::{Settings, picture};

/// What all entries of a board are drawn of, and the truth that they are compared with.
#[derive(Clone, Debug, PartialEq)]
pub struct BoardPlace {
    /// Scene, size and view; its settings are those of the truth, and the outline is that of every entry.
    pub truth: PictureSpec,
    /// The pixels of the frame that are shown and compared.
    pub region: Region,
}

/// What entries are measured by.
#[derive(Clone, Copy, Debug)]
pub struct BoardMeasure<'a> {
    /// The region of the truth.
    pub truth: &'a Framebuffer,
    /// How often frames are drawn for their time.
    pub repeats: Repeats,
    /// Gives the work up.
    pub cancel: &'a CancelToken,
}

/// An entry as it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct BoardTile {
    /// The region's pixels.
    pub pixels: Framebuffer,
    /// What was measured of it.
    pub numbers: BoardNumbers,
    /// How many frames its time is the median of.
    pub frames: usize,
}

impl BoardPlace {
    /// The region of a picture whose settings are A's; the truth is averaged in `space`, or as A is.
    pub fn new(own: PictureSpec, region: Region, space: Option<ResolveSpace>) -> Self {
        Self {
            truth: PictureSpec {
                render: own.render.truth_in(space),
                legend: false,
                insets: Vec::new(),
                ..own
            },
            region,
        }
    }

    /// What decides an entry's picture.
    pub fn spec(&self, entry: BoardEntry) -> PictureSpec {
        PictureSpec {
            render: RenderSettings {
                outline: self.truth.render.outline,
                ..entry.render
            },
            dialect: entry.dialect,
            ..self.truth.clone()
        }
    }

    /// What the truth is, in words such as `256 samples in stored values`; a filter is told where it is not the box as it is,
    /// as captions tell it.
    pub fn truth_words(&self) -> String {
        let settings = Settings::of(self.truth.render, self.truth.dialect);
        let filters = ["resolve-filter", "filter-radius"]
            .into_iter()
            .filter_map(picture::find);
        let filters = filters.filter(|setting| !setting.is_default(&settings));
        let words = filters.map(|setting| setting.words(&settings));
        let all: Vec<String> = std::iter::once(truth_words(self.truth.render.resolve))
            .chain(words)
            .collect();
        all.join(", ")
    }

    /// The region in words, such as `64 x 64 pixels from 100, 80`.
    pub fn region_words(&self) -> String {
        let Region { x, y, width, height } = self.region;
        format!("{width} \u{d7} {height} pixels from {x}, {y}")
    }

    /// The region of the truth; `None` once `cancel` says so.
    pub fn draw_truth(&self, scene: &Scene, cancel: &CancelToken) -> Option<Framebuffer> {
        let [width, height] = self.truth.size;
        let mut frame = Framebuffer::new(width, height);
        let view = self.truth.view.transform(scene.canvas, self.truth.size);
        let subject = Subject {
            scene,
            view: &view,
            settings: &self.truth.render,
        };
        draw_regions(&subject, &mut frame, &[self.region], cancel)?;
        Some(frame.cut(self.region))
    }

    /// Draws an entry of `scene`, which was read in its dialect, and compares its region with that of the truth; `None` once
    /// that is cancelled.
    pub fn measure(&self, scene: &Scene, entry: BoardEntry, by: &BoardMeasure<'_>) -> Option<BoardTile> {
        let BoardMeasure { truth, repeats, cancel } = *by;
        let spec = self.spec(entry);
        let [width, height] = spec.size;
        let mut frame = Framebuffer::new(width, height);
        let view = spec.view.transform(scene.canvas, spec.size);
        let subject = Subject {
            scene,
            view: &view,
            settings: &spec.render,
        };
        let times = time_draws(&subject, &mut frame, repeats, cancel)?;
        let frames = times.len();
        let pixels = frame.cut(self.region);
        let pair = Pair::new(truth, &pixels).ok()?;
        let numbers = BoardNumbers {
            rmse: pair.levels().rmse(),
            flip: pair.flip(cancel)?,
            time: median(times),
        };
        Some(BoardTile {
            pixels,
            numbers,
            frames,
        })
    }
}
