//! The ripmap: an image at every width and at every height, each halved for itself down to one texel.
//!
//! ```text
//!      (0, 0)           (1, 0)   (2, 0)
//!      +--------------+ +------+ +--+      a footprint that is long along u reads a narrow level, one that is long along v
//!      |              | |      | |  |      a low one; one that lies across fits none of them
//!      +--------------+ +------+ +--+
//!      (0, 1)           (1, 1)             all levels together have four times as many texels as the first
//!      +--------------+ +------+
//! ```
//!
//! Source: Akenine-Moeller, Haines and Hoffman, "Real-Time Rendering", second edition, section 5.7.2: Hewlett-Packard's graphics
//! accelerators read textures so.

use std::borrow::Cow;

use rayon::prelude::*;

use super::pyramid::{ExactLevel, NumberedLevel, coarser};
use super::pyramid_values::PyramidValues;
use super::{LevelChoice, MipLevel, PyramidFilter};
use crate::color::ResolveSpace;

/// An image at every width and height.
#[derive(Clone, Debug)]
pub struct Ripmap {
    /// Row by row of ever lower levels, in each ever narrower ones.
    levels: Vec<MipLevel>,
    /// Levels of a row.
    widths: usize,
}

impl Ripmap {
    /// Builds every level from the first one, averaged in these values by this filter.
    pub(super) fn build(base: &MipLevel, space: ResolveSpace, filter: PyramidFilter) -> Self {
        let values = PyramidValues::new(space, filter);
        let halved = |level: &ExactLevel, [columns, rows]: [bool; 2]| {
            let size = [level.width, level.height];
            let next = |side: u32, halves: bool| if halves { (side / 2).max(1) } else { side };
            let sizes = [size, [next(size[0], columns), next(size[1], rows)]];
            coarser(
                filter,
                sizes,
                |y| Cow::Borrowed(level.row(y)),
                |mean| values.texel(mean),
            )
        };
        let widths = widths(base.width());
        let mut levels = Vec::new();
        let (mut widest, mut rounded) = (exact(&values, base), base.clone());
        loop {
            let is_last = widest.height == 1;
            let next = (!is_last).then(|| halved(&widest, [false, true]));
            levels.push(rounded);
            let mut narrower = widest;
            while narrower.width > 1 {
                let (exact, level) = halved(&narrower, [true, false]);
                levels.push(level);
                narrower = exact;
            }
            let Some(next) = next else {
                break;
            };
            (widest, rounded) = next;
        }
        Self { levels, widths }
    }

    /// All levels: number `j` times [`super::Texture::ripmap_widths`] plus `i` is halved `i` times in width and `j` times in height.
    pub fn levels(&self) -> &[MipLevel] {
        &self.levels
    }

    /// The levels of one height that are mixed along `u`, and the part of the second.
    pub(super) fn mixed(&self, along_u: LevelChoice, height: usize) -> (NumberedLevel<'_>, Option<NumberedLevel<'_>>) {
        let numbered = |width: usize| {
            let number = height * self.widths + width;
            NumberedLevel {
                level: &self.levels[number],
                number,
            }
        };
        let next = (along_u.next_weight > 0.0).then(|| numbered(along_u.level + 1));
        (numbered(along_u.level), next)
    }
}

/// How many levels of each height there are, of a first one so wide.
pub(super) fn widths(width: u32) -> usize {
    (width.ilog2() + 1) as usize
}

/// A level in the values that are averaged.
fn exact(values: &PyramidValues, level: &MipLevel) -> ExactLevel {
    let row = |row: &[[u8; 4]]| row.iter().map(|texel| values.value(*texel)).collect::<Vec<_>>();
    ExactLevel {
        width: level.width(),
        height: level.height(),
        texels: level.rows().flat_map_iter(row).collect(),
    }
}
