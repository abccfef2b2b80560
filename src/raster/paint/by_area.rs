//! Primitives that cover areas of pixels, each of which holds one colour: shaded once, in the middle of a pixel, and composited
//! with it by their alpha times the area.

use crate::color::Premultiplied16;
use crate::raster::coverage::area::row::CoveredArea;
use crate::raster::paint::recorder::Recorder;
use crate::raster::paint::sample_colors::{SampleColors, ShadedColors};
use crate::raster::shading::Shader;
use crate::raster::shading::context::ShadeContext;
use crate::raster::span::SpanRect;

/// What one primitive covers of a tile, and waits to be shaded.
#[derive(Debug, Default)]
pub(super) struct AreaQueue {
    /// Rows of pixels, and what is covered there.
    covered: Vec<(i32, CoveredArea)>,
    /// The middles of these pixels, and their colours.
    points: Vec<[u16; 2]>,
    colors: Vec<Premultiplied16>,
}

impl AreaQueue {
    /// Notes what is covered in row `y` of the tile `rect`.
    pub(super) fn note(&mut self, rect: SpanRect, y: i32, covered: CoveredArea) {
        // No tile has more pixels along a side.
        let inside = |distance: i32| u16::try_from(distance).unwrap_or(u16::MAX);
        let row = inside(y - rect.y.start);
        let columns = covered.xs.start..covered.xs.end;
        self.points.extend(columns.map(|x| [inside(x - rect.x.start), row]));
        self.covered.push((y, covered));
    }

    /// Shades what was noted, all pixels together, and paints it; how many pixels these were.
    pub(super) fn paint(
        &mut self,
        tile: &mut SampleColors,
        context: &ShadeContext<'_>,
        shader: &Shader<'_>,
        mut recorder: Option<&mut Recorder>,
    ) -> u64 {
        let Self {
            covered,
            points,
            colors,
        } = self;
        colors.clear();
        colors.resize(points.len(), Premultiplied16::TRANSPARENT);
        let SpanRect { x, y } = tile.rect;
        shader.points(context.samples_from([x.start, y.start]), points, colors);
        let mut rest = colors.as_slice();
        for (y, covered) in covered.drain(..) {
            let (colors, others) = rest.split_at(covered.xs.length());
            rest = others;
            let opaque = shader.opaque;
            tile.fill_area_each(y, covered, ShadedColors { colors, opaque });
            if let Some(recorder) = &mut recorder {
                for color in colors {
                    recorder.paint_area(covered.area, *color);
                }
            }
        }
        points.clear();
        colors.len() as u64
    }
}
