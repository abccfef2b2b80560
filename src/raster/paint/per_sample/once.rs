//! Shading once per primitive and pixel: all samples that it covers there get the colour of one place.

use crate::color::Premultiplied16;
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::shape::Shape;
use crate::raster::coverage::shape_coverage::ShapeCoverage;
use crate::raster::paint::per_sample::PerSamplePainter;
use crate::raster::paint::sample_colors::ShadedColors;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::sampling::shading_rate::ShadingRate;
use crate::raster::shading::Shader;
use crate::raster::shading::context::ShadeContext;
use crate::raster::shading::once::ShadingPlace;
use crate::raster::span::SpanRect;

/// What waits to be shaded of one primitive.
#[derive(Debug, Default)]
pub(super) struct OnceQueue {
    /// Rows of pixels, what is covered there, and whether it is shaded in the middle of pixels.
    covered: Vec<(i32, Covered, bool)>,
    /// The middles of pixels, and other places, each on its grid, counted from the tile's first pixel.
    centres: Places,
    others: Places,
}

/// Places, and their colours once they are shaded.
#[derive(Debug, Default)]
struct Places {
    points: Vec<[u16; 2]>,
    colors: Vec<Premultiplied16>,
}

impl<'a> PerSamplePainter<'a> {
    /// Paints a shape with the shader that `shader` makes, on one grid or two.
    pub(super) fn shape_once(
        &mut self,
        shape: Shape<'_>,
        shape_coverage: &mut ShapeCoverage,
        shader: impl Fn(&ShadeContext<'a>) -> Shader<'a>,
    ) {
        let rect = self.layers.base().rect;
        let centre = ShadingPlace::centre(self.context.grid);
        let at_centres = self.context.on(centre.grid);
        let (mut prepared, mut painted) = (None, SpanRect::EMPTY);
        shape_coverage.each(shape, rect, |y, covered| {
            painted = painted.union(covered.pixels(y));
            let shader = prepared.get_or_insert_with(|| shader(&at_centres));
            match shader.constant() {
                Some(color) => self.fill(y, covered, color),
                None => self.note(y, covered, centre, shader.is_level()),
            }
        });
        self.layers.top().note_painted(painted.intersection(rect));
        let Some(at_centre) = prepared else {
            return;
        };
        let origin = [rect.x.start, rect.y.start];
        self.samples_shaded += self.once.centres.shade(&at_centre, &at_centres, origin);
        if !self.once.others.points.is_empty() {
            let context = self.context.on(self.context.grid.dense());
            self.samples_shaded += self.once.others.shade(&shader(&context), &context, origin);
        }
        self.paint_once(&at_centre);
    }

    /// Notes where to shade what is covered in row `y` of pixels: only for the first pixel of a run where all of them get the same
    /// colour.
    fn note(&mut self, y: i32, covered: Covered, centre: ShadingPlace, is_level: bool) {
        match covered {
            Covered::Whole(xs) => {
                let end = if is_level { xs.start + 1 } else { xs.end };
                for x in xs.start..end {
                    let point = self.point(centre, [x, y]);
                    self.once.centres.points.push(point);
                }
                self.once.covered.push((y, covered, true));
                if self.recorder.is_some() {
                    self.record_place(centre);
                }
            }
            Covered::Part(x, mask) => {
                let place = self.place_of([x, y], &mask, centre);
                let is_centre = place == centre;
                let point = self.point(place, [x, y]);
                if is_centre {
                    self.once.centres.points.push(point);
                } else {
                    self.once.others.points.push(point);
                }
                self.once.covered.push((y, covered, is_centre));
                self.record_place(place);
            }
        }
    }

    /// Where a primitive is shaded that covers these samples of a pixel.
    fn place_of(&mut self, pixel: [i32; 2], mask: &SampleMask, centre: ShadingPlace) -> ShadingPlace {
        if self.context.shading != ShadingRate::Centroid || mask.count() == self.samples_per_pixel() {
            return centre;
        }
        let places = self.positions.of_pixel(pixel, &mut self.memory);
        let (mut count, mut sums) = (0, [0; 2]);
        mask.each(|sample| {
            count += 1;
            for (sum, at) in sums.iter_mut().zip(places[sample]) {
                *sum += u32::from(at);
            }
        });
        ShadingPlace::centroid(self.context.grid, count, sums)
    }

    fn record_place(&mut self, place: ShadingPlace) {
        if let Some(recorder) = &mut self.recorder {
            recorder.shaded_at(place);
        }
    }

    /// A place in a pixel, on its grid, from the first pixel of the tile on.
    fn point(&self, place: ShadingPlace, [x, y]: [i32; 2]) -> [u16; 2] {
        let rect = self.layers.base().rect;
        let from_tile = [x - rect.x.start, y - rect.y.start];
        // No tile has more points of any grid along a side.
        let first = from_tile.map(|pixels| u16::try_from(pixels * place.grid.side()).unwrap_or(u16::MAX));
        [0, 1].map(|axis| first[axis].saturating_add(place.at[axis]))
    }

    /// Paints what was shaded by one paint.
    fn paint_once(&mut self, shader: &Shader<'_>) {
        let (opaque, is_level) = (shader.opaque, shader.is_level());
        let OnceQueue {
            covered,
            centres,
            others,
        } = &mut self.once;
        let (mut in_centres, mut in_others) = (centres.colors.as_slice(), others.colors.as_slice());
        let tile = self.layers.top();
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
            if let Some(recorder) = &mut self.recorder {
                recorder.paint(covered, |_| colors[0]);
            }
        }
    }
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
