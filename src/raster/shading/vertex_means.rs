//! Pixels of interpolated colours, from the places of all their samples: the same as by shading each sample for itself.
//!
//! Means of stored values are sums of the rounded colours, made for eight samples at once and never written down. In linear
//! light most pixels follow from the middle of their samples and from how far these are spread around it
//! ([`crate::color::ValueSpread`]); what that leaves open is shaded sample by sample.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8, u64x8};

use crate::color::{LightResolver, Premultiplied16, Resolver, SampleMean, ValueSpread};
use crate::raster::SampleRate;
use crate::raster::attributes::Planes;
use crate::raster::sampling::positions::Position;
use crate::raster::shading::context::PlacedPixels;
use crate::raster::shading::kernel::{LANES, ONE, columns_and_rows, first_sample, low_word, whole};
use crate::raster::shading::vertex_kernel::point_kernel;
use crate::simd;
use crate::texture::SampleGrid;

/// Blocks of [`LANES`] samples of a pixel: memory for more than are needed would have to be cleared.
const FEW: usize = 8;
const MANY: usize = SampleRate::MAX as usize / LANES;

/// Where fewer samples are shaded together, most lanes would be empty.
const FEWEST: usize = 4;

/// How the samples of [`LANES`] pixels are spread, in points of the lattice.
struct PlaceSpreads {
    /// Of columns and of rows.
    mean: [[f64; LANES]; 2],
    /// The mean squares of how far columns and rows are from there, and between these the mean of their products.
    squares: [[f64; LANES]; 3],
    /// No column and no row is farther away.
    reach: [[f64; LANES]; 2],
}

/// The pixels of opaque colours, whose planes are in units of [`Premultiplied16`]; whether there is a short way to them.
pub(super) fn means(planes: &Planes<3>, pixels: PlacedPixels<'_>, mean: &SampleMean, values: &mut [u32]) -> bool {
    if pixels.count < FEWEST {
        return false;
    }
    match mean {
        SampleMean::Stored(resolver) if pixels.count <= FEW * LANES => {
            dispatch!(simd::level(), simd => stored::<_, FEW>(simd, planes, pixels, resolver, values));
        }
        SampleMean::Stored(resolver) => {
            dispatch!(simd::level(), simd => stored::<_, MANY>(simd, planes, pixels, resolver, values));
        }
        SampleMean::Linear(resolver) => {
            dispatch!(simd::level(), simd => linear(simd, planes, pixels, resolver, values));
        }
    }
    true
}

/// Means of stored values.
#[inline(always)]
fn stored<S: Simd, const BLOCKS: usize>(
    simd: S,
    planes: &Planes<3>,
    placed: PlacedPixels<'_>,
    resolver: &Resolver,
    values: &mut [u32],
) {
    let alpha = resolver.count() * u32::from(Premultiplied16::ONE);
    let mut columns = Columns::<BLOCKS>::EMPTY;
    if placed.are_same() {
        columns.fill(placed.inside);
    }
    for (i, (place, value)) in placed.pixels.places.iter().zip(values).enumerate() {
        if !placed.are_same() {
            columns.fill(placed.inside(i));
        }
        let first = from_pivot(planes, placed.pixels.grid, *place);
        let [r, g, b] = columns.sums(simd, planes, first);
        *value = resolver.pixel([r, g, b, alpha]);
    }
}

/// Means of light.
#[inline(always)]
fn linear<S: Simd>(
    simd: S,
    planes: &Planes<3>,
    placed: PlacedPixels<'_>,
    resolver: &LightResolver,
    values: &mut [u32],
) {
    let mut spread = PlaceSpreads::of_all(placed.inside(0));
    let grid = placed.pixels.grid;
    let (first, side) = (first_sample(grid), f64::from(grid.side));
    for (block, values) in values.chunks_mut(LANES).enumerate() {
        let at = block * LANES;
        let places = &placed.pixels.places[at..at + values.len()];
        if !placed.are_same() {
            for i in 0..places.len() {
                spread.set(i, placed.inside(at + i));
            }
        }
        let [columns, rows] = columns_and_rows(simd, places);
        let right = columns * side + (first[0] - planes.pivot[0]) + f64x8::simd_from(simd, spread.mean[0]);
        let down = rows * side + (first[1] - planes.pivot[1]) + f64x8::simd_from(simd, spread.mean[1]);
        let (mut pixels, mut certain) = (u64x8::splat(simd, 0xFF), u64::MAX);
        for k in 0..3 {
            let (dx, dy) = (planes.dx[k], planes.dy[k]);
            let [xx, xy, yy] = &spread.squares;
            let squares = f64x8::simd_from(simd, *xx) * (dx * dx)
                + f64x8::simd_from(simd, *xy) * (2.0 * dx * dy)
                + f64x8::simd_from(simd, *yy) * (dy * dy);
            let [right_reach, down_reach] = &spread.reach;
            let channel = ValueSpread {
                mean: down * dy + planes.at_pivot[k] + right * dx,
                squares,
                reach: f64x8::simd_from(simd, *right_reach) * dx.abs() + f64x8::simd_from(simd, *down_reach) * dy.abs(),
            };
            let (bytes, of_channel) = channel.bytes_of_light(simd);
            certain &= of_channel;
            pixels = pixels << 8 | bytes;
        }
        let pixels = pixels.to_array();
        for (i, value) in values.iter_mut().enumerate() {
            *value = if certain >> i & 1 == 1 {
                low_word(pixels[i])
            } else {
                let inside = placed.inside(at + i);
                one_by_one(simd, planes, grid, (places[i], inside), resolver)
            };
        }
    }
}

/// The pixel at a place, by the light of each of its samples.
#[inline(never)]
fn one_by_one<S: Simd>(
    simd: S,
    planes: &Planes<3>,
    grid: SampleGrid,
    (place, inside): ([u16; 2], &[Position]),
    resolver: &LightResolver,
) -> u32 {
    let mut points = [[0; 2]; SampleRate::MAX as usize];
    let mut colors = [Premultiplied16::TRANSPARENT; SampleRate::MAX as usize];
    let side = u16::try_from(grid.side).unwrap_or(u16::MAX);
    for (point, inside) in points.iter_mut().zip(inside) {
        *point = [0, 1].map(|axis| place[axis].wrapping_mul(side).wrapping_add(inside[axis].into()));
    }
    let colors = &mut colors[..inside.len()];
    point_kernel(simd, planes, grid, &points[..inside.len()], colors);
    resolver.opaque_mean(colors)
}

/// How far the first point of a pixel's lattice lies from the pivot: exactly, since both are binary fractions.
#[inline(always)]
fn from_pivot(planes: &Planes<3>, grid: SampleGrid, place: [u16; 2]) -> [f64; 2] {
    let (first, side) = (first_sample(grid), f64::from(grid.side));
    [
        first[0] + f64::from(place[0]) * side - planes.pivot[0],
        first[1] + f64::from(place[1]) * side - planes.pivot[1],
    ]
}

/// The columns and rows of a pixel's samples, [`LANES`] at a time.
struct Columns<const BLOCKS: usize> {
    at: [[[f64; LANES]; 2]; BLOCKS],
    /// All bits where a lane has a sample.
    used: [[u64; LANES]; BLOCKS],
    blocks: usize,
}

impl<const BLOCKS: usize> Columns<BLOCKS> {
    const EMPTY: Self = Self {
        at: [[[0.0; LANES]; 2]; BLOCKS],
        used: [[0; LANES]; BLOCKS],
        blocks: 0,
    };

    #[inline(always)]
    fn fill(&mut self, places: &[Position]) {
        let (blocks, rest) = places.as_chunks::<LANES>();
        self.blocks = places.len().div_ceil(LANES);
        for ((places, at), used) in blocks.iter().zip(&mut self.at).zip(&mut self.used) {
            for (i, [column, row]) in places.iter().enumerate() {
                at[0][i] = f64::from(*column);
                at[1][i] = f64::from(*row);
            }
            *used = [u64::MAX; LANES];
        }
        if !rest.is_empty() {
            let (at, used) = (&mut self.at[blocks.len()], &mut self.used[blocks.len()]);
            *used = [0; LANES];
            for (i, [column, row]) in rest.iter().enumerate() {
                (at[0][i], at[1][i], used[i]) = (f64::from(*column), f64::from(*row), u64::MAX);
            }
        }
    }

    /// The sums of red, green and blue at all samples, each rounded.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "256 times a channel is less than 2^32")]
    fn sums<S: Simd>(&self, simd: S, planes: &Planes<3>, first: [f64; 2]) -> [u32; 3] {
        let number = |value| f64x8::splat(simd, value);
        let mut sums = [u64x8::splat(simd, 0); 3];
        for (at, used) in self.at.iter().zip(&self.used).take(self.blocks) {
            let [right, down] = [0, 1].map(
                #[inline(always)]
                |axis| f64x8::simd_from(simd, at[axis]) + first[axis],
            );
            let used = u64x8::simd_from(simd, *used);
            for (k, sum) in sums.iter_mut().enumerate() {
                // In the order of `Planes::at`.
                let value = number(planes.at_pivot[k]) + down * planes.dy[k] + right * planes.dx[k];
                *sum += whole(simd, value, ONE) & used;
            }
        }
        let mut all = [0; 3];
        for (all, sum) in all.iter_mut().zip(sums) {
            let (low, high) = sum.split();
            let (low, high) = (low + high).split();
            let [first, second] = (low + high).to_array();
            *all = (first + second) as u32;
        }
        all
    }
}

impl PlaceSpreads {
    /// Of samples that lie there in every pixel.
    #[inline(always)]
    fn of_all(places: &[Position]) -> Self {
        let mut spread = Self {
            mean: [[0.0; LANES]; 2],
            squares: [[0.0; LANES]; 3],
            reach: [[0.0; LANES]; 2],
        };
        spread.set(0, places);
        spread.mean = spread.mean.map(|[first, ..]| [first; LANES]);
        spread.squares = spread.squares.map(|[first, ..]| [first; LANES]);
        spread.reach = spread.reach.map(|[first, ..]| [first; LANES]);
        spread
    }

    /// In the pixel of a lane.
    #[inline(always)]
    fn set(&mut self, lane: usize, places: &[Position]) {
        let (mut sums, mut squares) = ([0_u32; 2], [0_u32; 3]);
        let (mut least, mut most) = ([u8::MAX; 2], [0_u8; 2]);
        for [column, row] in places {
            let (x, y) = (u32::from(*column), u32::from(*row));
            sums[0] += x;
            sums[1] += y;
            squares[0] += x * x;
            squares[1] += x * y;
            squares[2] += y * y;
            (least[0], least[1]) = (least[0].min(*column), least[1].min(*row));
            (most[0], most[1]) = (most[0].max(*column), most[1].max(*row));
        }
        let per_sample = 1.0 / places.len().max(1) as f64;
        for axis in 0..2 {
            let mean = f64::from(sums[axis]) * per_sample;
            self.mean[axis][lane] = mean;
            self.reach[axis][lane] = (mean - f64::from(least[axis])).max(f64::from(most[axis]) - mean);
        }
        let [x, y] = [self.mean[0][lane], self.mean[1][lane]];
        for (i, product) in [x * x, x * y, y * y].into_iter().enumerate() {
            self.squares[i][lane] = f64::from(squares[i]) * per_sample - product;
        }
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::color::ResolveSpace;
    use crate::geometry::edge::doubled_area;
    use crate::geometry::subpixel::GridPoint;
    use crate::raster::sampling::positions::{SamplePositions, lattice};
    use crate::raster::shading::context::Pixels;
    use crate::raster::{SamplePattern, Seed};
    use crate::rules::Rules;

    /// A pattern's samples at some pixels, and planes through random colours on a random triangle.
    struct Case {
        pattern: SamplePattern,
        rate: SampleRate,
        planes: Planes<3>,
        grid: SampleGrid,
        places: Vec<[u16; 2]>,
        inside: Vec<Position>,
    }

    impl Case {
        /// `None` where the triangle has no area.
        fn new(u: &mut Unstructured<'_>) -> Result<Option<Self>> {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rates: &[u32] = if pattern.needs_square() {
                &[4, 9, 16, 64]
            } else {
                &[5, 16, 33, 70]
            };
            let rate = SampleRate::new(*u.choose(rates)?).expect("a rate");
            let positions = SamplePositions::new(pattern, rate, Seed::default());
            let subpixels = lattice(pattern, rate);
            let far = *u.choose(&[2_000, 40_000, 2_000_000])?;
            let mut corner = || -> Result<GridPoint> {
                let mut at = || u.int_in_range(-far..=far);
                Ok(GridPoint { x: at()?, y: at()? })
            };
            let corners = [corner()?, corner()?, corner()?];
            if doubled_area(corners) == 0 {
                return Ok(None);
            }
            let mut unit = || -> Result<f32> { Ok(f32::from(u.arbitrary::<u8>()?) / 255.0) };
            let values = [
                [unit()?, unit()?, unit()?],
                [unit()?, 0.0, unit()?],
                [unit()?, unit()?, 1.0],
            ];
            let grid = SampleGrid {
                side: subpixels.side().cast_unsigned(),
                origin: [u.int_in_range(-20..=20)?, 2],
            };
            let places: Vec<[u16; 2]> = (0..9).map(|i| [i * 3 % 7, i % 4]).collect();
            let pixels = if positions.are_same() { 1 } else { places.len() };
            let mut inside = Vec::new();
            for place in &places[..pixels] {
                let pixel = [0, 1].map(|i| grid.origin[i] + i32::from(place[i]));
                inside.extend_from_slice(positions.of_pixel(pixel, &mut Vec::new()));
            }
            Ok(Some(Self {
                pattern,
                rate,
                planes: Planes::new(subpixels, &corners, values).scaled(ONE),
                grid,
                places,
                inside,
            }))
        }

        fn placed(&self) -> PlacedPixels<'_> {
            PlacedPixels {
                pixels: Pixels {
                    grid: self.grid,
                    places: &self.places,
                },
                count: self.rate.samples() as usize,
                inside: &self.inside,
            }
        }

        /// Pixel `i`, sample by sample.
        fn one_by_one(&self, i: usize, mean: &SampleMean) -> u32 {
            let side = u16::try_from(self.grid.side).expect("at most 256");
            let inside = self.placed().inside(i).iter();
            let points: Vec<[u16; 2]> = inside
                .map(|inside| [0, 1].map(|axis| self.places[i][axis] * side + u16::from(inside[axis])))
                .collect();
            let mut colors = vec![Premultiplied16::TRANSPARENT; points.len()];
            dispatch!(simd::level(), simd => point_kernel(simd, &self.planes, self.grid, &points, &mut colors));
            mean.pixel(&colors)
        }
    }

    #[test]
    fn pixels_are_those_of_their_samples_one_by_one() {
        let mut pixels_met = 0;
        arbtest::arbtest(|u| {
            let Some(case) = Case::new(u)? else {
                return Ok(());
            };
            for (space, rules) in [
                (ResolveSpace::Stored, Rules::Standard),
                (ResolveSpace::Linear, Rules::Standard),
                (ResolveSpace::Linear, Rules::Float),
            ] {
                let mean = SampleMean::new(space, case.rate.samples(), rules);
                let expected: Vec<u32> = (0..case.places.len()).map(|i| case.one_by_one(i, &mean)).collect();
                for (name, level) in simd::tested() {
                    let mut found = vec![0; expected.len()];
                    dispatch!(level, simd => match &mean {
                        SampleMean::Stored(resolver) if case.rate.samples() <= 64 => {
                            stored::<_, FEW>(simd, &case.planes, case.placed(), resolver, &mut found);
                        }
                        SampleMean::Stored(resolver) => {
                            stored::<_, MANY>(simd, &case.planes, case.placed(), resolver, &mut found);
                        }
                        SampleMean::Linear(resolver) => linear(simd, &case.planes, case.placed(), resolver, &mut found),
                    });
                    pixels_met += found.len();
                    assert_eq!(
                        found, expected,
                        "{name}, {:?}, {space:?}: {:?}",
                        case.pattern, case.planes
                    );
                }
            }
            Ok(())
        })
        .budget_ms(800);
        assert!(pixels_met > 0, "something was compared");
    }
}
