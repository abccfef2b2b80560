//! Shading once per primitive and pixel: all samples that it covers there get the colour of one place.

use crate::color::Premultiplied16;
use crate::raster::coverage::covered::Covered;
use crate::raster::paint::recorder::Recorder;
use crate::raster::paint::sample_colors::{SampleColors, ShadedColors};
use crate::raster::sampling::mask::SampleMask;
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::sampling::shading_rate::ShadingRate;
use crate::raster::shading::Shader;
use crate::raster::shading::context::ShadeContext;
use crate::raster::shading::once::ShadingPlace;
use crate::raster::span::{Span, SpanRect};

/// What waits to be shaded of one primitive in a tile.
#[derive(Debug)]
pub(super) struct OnceQueue<'a> {
    context: ShadeContext<'a>,
    /// The middle of a pixel.
    centre: ShadingPlace,
    /// Rows of pixels, what is covered there, and whether it is shaded in the middle of pixels.
    covered: Vec<(i32, Covered, bool)>,
    /// The middles of pixels, and other places, each on its grid, counted from the tile's first pixel.
    centres: Places,
    others: Places,
    memory: Vec<Position>,
}

/// Places, and their colours once they are shaded.
#[derive(Debug, Default)]
struct Places {
    points: Vec<[u16; 2]>,
    colors: Vec<Premultiplied16>,
}

impl<'a> OnceQueue<'a> {
    pub(super) fn new(context: ShadeContext<'a>) -> Self {
        Self {
            context,
            centre: ShadingPlace::centre(context.grid),
            covered: Vec::new(),
            centres: Places::default(),
            others: Places::default(),
            memory: Vec::new(),
        }
    }

    /// What a paint has to be prepared with to be shaded in the middle of pixels.
    pub(super) fn at_centres(&self) -> ShadeContext<'a> {
        self.context.on(self.centre.grid)
    }

    /// Notes where to shade what is covered in row `y` of pixels of a tile, and returns that place: in a run only for the first pixel
    /// where all of them get the same colour (`is_level`).
    pub(super) fn note(
        &mut self,
        tile: SpanRect,
        (y, covered): (i32, Covered),
        positions: &SamplePositions,
        is_level: bool,
    ) -> ShadingPlace {
        match covered {
            Covered::Whole(xs) => {
                let end = if is_level { xs.start + 1 } else { xs.end };
                let centre = self.centre;
                let points = (xs.start..end).map(|x| point(tile, centre, [x, y]));
                self.centres.points.extend(points);
                self.covered.push((y, covered, true));
                centre
            }
            Covered::Part(x, mask) => {
                let place = self.place_of([x, y], &mask, positions);
                let is_centre = place == self.centre;
                let places = if is_centre { &mut self.centres } else { &mut self.others };
                places.points.push(point(tile, place, [x, y]));
                self.covered.push((y, covered, is_centre));
                place
            }
        }
    }

    /// Where a primitive is shaded that covers these samples of a pixel.
    fn place_of(&mut self, pixel: [i32; 2], mask: &SampleMask, positions: &SamplePositions) -> ShadingPlace {
        if self.context.shading != ShadingRate::Centroid || mask.count() == positions.count() {
            return self.centre;
        }
        let places = positions.of_pixel(pixel, &mut self.memory);
        let (mut count, mut sums) = (0, [0; 2]);
        mask.each(|sample| {
            count += 1;
            for (sum, at) in sums.iter_mut().zip(places[sample]) {
                *sum += u32::from(at);
            }
        });
        ShadingPlace::centroid(self.context.grid, count, sums)
    }

    /// Shades what was noted in a tile whose first pixel is `origin`: with `at_centre`, and other places with what `shader` prepares
    /// for them. How many colours that took.
    pub(super) fn shade(
        &mut self,
        origin: [i32; 2],
        at_centre: &Shader<'a>,
        shader: impl Fn(&ShadeContext<'a>) -> Shader<'a>,
    ) -> u64 {
        let context = self.at_centres();
        let mut count = self.centres.shade(at_centre, &context, origin);
        self.others.colors.clear();
        if !self.others.points.is_empty() {
            let context = self.context.on(self.context.grid.dense());
            count += self.others.shade(&shader(&context), &context, origin);
        }
        count
    }

    /// Paints what was shaded by one paint, and forgets it.
    pub(super) fn paint(&mut self, tile: &mut SampleColors, shader: &Shader<'_>, mut recorder: Option<&mut Recorder>) {
        let (opaque, is_level) = (shader.opaque, shader.is_level());
        let Self {
            covered,
            centres,
            others,
            ..
        } = self;
        let (mut in_centres, mut in_others) = (centres.colors.as_slice(), others.colors.as_slice());
        for (y, covered, is_centre) in covered.drain(..) {
            let rest = if is_centre { &mut in_centres } else { &mut in_others };
            let count = match covered {
                Covered::Whole(xs) if !is_level => xs.length(),
                _ => 1,
            };
            let Some((colors, others)) = rest.split_at_checked(count) else {
                break;
            };
            *rest = others;
            match covered {
                Covered::Whole(xs) if is_level => tile.fill(xs, y, colors[0]),
                Covered::Whole(xs) => tile.fill_each(xs, y, ShadedColors { colors, opaque }),
                Covered::Part(x, mask) => tile.fill_mask(x, y, mask, colors[0]),
            }
            if let Some(recorder) = &mut recorder {
                recorder.paint(covered, |_| colors[0]);
            }
        }
    }
}

/// Makes one of all parts of the same pixel, which come apart where a row of samples has several spans of an outline; pixels have so
/// many samples.
pub(super) fn merge_parts(found: &mut Vec<(i32, Covered)>, samples: usize) {
    let pixel = |(y, covered): &(i32, Covered)| match covered {
        Covered::Part(x, _) => (*y, *x),
        Covered::Whole(xs) => (*y, xs.start),
    };
    found.sort_unstable_by_key(pixel);
    found.dedup_by(|(next_y, next), (y, kept)| match (next, kept) {
        (Covered::Part(next_x, next), Covered::Part(x, kept)) if (*next_y, *next_x) == (*y, *x) => {
            kept.merge(next);
            true
        }
        _ => false,
    });
    for (_, covered) in found {
        if let Covered::Part(x, mask) = covered
            && mask.count() == samples
        {
            *covered = Covered::Whole(Span { start: *x, end: *x + 1 });
        }
    }
}

/// A place in a pixel, on its grid, from the first pixel of a tile on.
fn point(tile: SpanRect, place: ShadingPlace, [x, y]: [i32; 2]) -> [u16; 2] {
    let from_tile = [x - tile.x.start, y - tile.y.start];
    // No tile has more points of any grid along a side.
    let first = from_tile.map(|pixels| u16::try_from(pixels * place.grid.side()).unwrap_or(u16::MAX));
    [0, 1].map(|axis| first[axis].saturating_add(place.at[axis]))
}

impl Places {
    /// Shades what was noted, in a tile whose first pixel is `origin`, and forgets where it was; how many places there were.
    fn shade(&mut self, shader: &Shader<'_>, context: &ShadeContext<'_>, origin: [i32; 2]) -> u64 {
        let Self { points, colors } = self;
        colors.clear();
        colors.resize(points.len(), Premultiplied16::TRANSPARENT);
        shader.points(context.samples_from(origin), points, colors);
        points.clear();
        colors.len() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_pixel_become_one_and_all_samples_a_whole_pixel() {
        let part = |y, x, bits| (y, Covered::Part(x, SampleMask::of_bits(bits)));
        let whole = |y, start, end| (y, Covered::Whole(Span { start, end }));
        let mut found = vec![
            part(3, 5, 0b0001),
            part(3, 6, 0b0011),
            whole(3, 7, 9),
            part(3, 5, 0b0100),
            part(3, 6, 0b1100),
            part(4, 5, 0b1000),
        ];
        merge_parts(&mut found, 4);
        let expected = [part(3, 5, 0b0101), whole(3, 6, 7), whole(3, 7, 9), part(4, 5, 0b1000)];
        assert_eq!(found, expected, "each pixel once");
    }
}
