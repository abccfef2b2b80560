//! What a frame shows, and a frame: final, or a preview that stands in for it.

use std::fmt;
use std::sync::Arc;

use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, Region};
use crate::render::{FrameStats, RenderSettings, Subject};
use crate::scene::Scene;

/// All that decides a frame's pixels.
#[derive(Clone, Debug)]
pub struct Picture {
    /// What is drawn.
    pub scene: Arc<Scene>,
    /// Which document it is, and which reading of the file: one number for both dialects that A and B read it in.
    pub document: u64,
    /// From where.
    pub view: ViewTransform,
    /// How.
    pub settings: RenderSettings,
    /// Width and height in frame pixels.
    pub size: [u32; 2],
}

/// A frame.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Its pixels.
    pub pixels: Framebuffer,
    /// What they show, or will show.
    pub picture: Picture,
    /// Where the time went, of what was drawn last.
    pub stats: FrameStats,
    /// How far the pixels are from final; `None` when all are what [`crate::render::draw`] makes of the picture.
    pub preview: Option<Preview>,
}

/// What stands in for a final frame.
#[derive(Clone, Debug)]
pub struct Preview {
    /// How it was made.
    pub quality: PreviewQuality,
    /// The parts that are final already.
    pub(in crate::viewer) exact: ExactCells,
}

/// How a preview was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PreviewQuality {
    /// One sample per pixel.
    RateOne,
    /// One sample for a square with this many pixels along each side.
    Coarse(u32),
    /// The frame before, moved by whole pixels, with its uncovered strips drawn.
    Moved,
    /// The frame before, drawn with other settings.
    Earlier,
}

/// Sides of the cells of [`ExactCells`], in pixels.
const CELL: u32 = 8;

/// Which pixels of a frame are final, by cells of 8x8 pixels.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct ExactCells {
    size: [u32; 2],
    columns: u32,
    exact: Vec<bool>,
}

impl Picture {
    /// In the renderer's terms.
    pub(in crate::viewer) fn subject(&self) -> Subject<'_> {
        Subject {
            scene: &self.scene,
            view: &self.view,
            settings: &self.settings,
        }
    }

    /// Whether both show the same scene from the same place in the same size: then their pixels can be compared.
    pub(in crate::viewer) fn is_seen_as(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene) && self.is_in_place_of(other)
    }

    /// Whether both show the same document, perhaps in two dialects, from the same place in the same size.
    pub(in crate::viewer) fn shows_document_of(&self, other: &Self) -> bool {
        self.document == other.document && self.is_in_place_of(other)
    }

    fn is_in_place_of(&self, other: &Self) -> bool {
        self.view == other.view && self.size == other.size
    }
}

impl PartialEq for Picture {
    /// Scenes are never changed, so the same scene is the same memory.
    fn eq(&self, other: &Self) -> bool {
        self.is_seen_as(other) && self.settings == other.settings
    }
}

impl Frame {
    /// The colour of a pixel, straight `[r, g, b, a]`, if it is final; `None` outside the frame too.
    pub fn final_rgba(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        let is_final = self
            .preview
            .as_ref()
            .is_none_or(|preview| preview.exact.contains([x, y]));
        self.pixels.rgba(x, y).filter(|_| is_final)
    }
}

impl fmt::Display for PreviewQuality {
    /// In few words, such as `rate 1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RateOne => f.write_str("rate 1"),
            Self::Coarse(side) => write!(f, "1/{side} size"),
            Self::Moved => f.write_str("moved"),
            Self::Earlier => f.write_str("earlier settings"),
        }
    }
}

impl ExactCells {
    /// For a frame of `size` pixels, none of them final.
    pub(in crate::viewer) fn new(size: [u32; 2]) -> Self {
        let [columns, rows] = size.map(|side| side.div_ceil(CELL));
        Self {
            size,
            columns,
            exact: vec![false; columns as usize * rows as usize],
        }
    }

    /// The pixels of `region` are final now. Cells that it holds in part stay as they are.
    pub(in crate::viewer) fn mark(&mut self, region: Region) {
        let span = |start: u32, end: u32, side: u32| {
            let last = if end >= side { side.div_ceil(CELL) } else { end / CELL };
            start.div_ceil(CELL)..last
        };
        for row in span(region.y, region.bottom(), self.size[1]) {
            for column in span(region.x, region.right(), self.size[0]) {
                self.exact[(row * self.columns + column) as usize] = true;
            }
        }
    }

    /// Whether a pixel is final.
    pub(in crate::viewer) fn contains(&self, [x, y]: [u32; 2]) -> bool {
        let inside = x < self.size[0] && y < self.size[1];
        inside && self.exact[((y / CELL) * self.columns + x / CELL) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_cells_promise_nothing_that_is_not() {
        arbtest::arbtest(|u| {
            let size = [u.int_in_range(0..=70)?, u.int_in_range(0..=50)?];
            let mut cells = ExactCells::new(size);
            let mut regions = Vec::new();
            for _ in 0..u.int_in_range(0..=3)? {
                let (x, y) = (u.int_in_range(0..=size[0])?, u.int_in_range(0..=size[1])?);
                let region = Region {
                    x,
                    y,
                    width: u.int_in_range(0..=size[0] - x)?,
                    height: u.int_in_range(0..=size[1] - y)?,
                };
                cells.mark(region);
                regions.push(region);
            }
            for y in 0..=size[1] {
                for x in 0..=size[0] {
                    let pixel = Region::of_pixel([x, y]);
                    let drawn = regions.iter().any(|region| !region.intersection(pixel).is_empty());
                    assert!(
                        drawn || !cells.contains([x, y]),
                        "{x}, {y} of {size:?} with {regions:?}"
                    );
                }
            }
            cells.mark(Region::of_size(size));
            let all = (0..size[1]).all(|y| (0..size[0]).all(|x| cells.contains([x, y])));
            assert!(all, "the whole frame of {size:?}");
            Ok(())
        })
        .budget_ms(300);
    }
}
