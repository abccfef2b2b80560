//! Which sides of pixels are edges: where luma differs, unless something beside differs much more.

use rayon::prelude::*;

/// The edge between a pixel and the one on its left.
pub(super) const LEFT: u8 = 1;
/// The edge between a pixel and the one above it.
pub(super) const TOP: u8 = 2;

/// The least difference of luma that is an edge, `0.0..=1.0`.
pub const THRESHOLD: f64 = 0.1;
/// An edge is dropped where luma differs by more than this many times as much beside it: the eye sees that one only.
pub const FACTOR: i32 = 2;

/// Columns and rows around the frame that have no edges, so that nobody has to ask where it ends.
const PADDING: usize = 2;
const PADDING_PIXELS: i32 = 2;

/// Weights of red, green and blue in luma (ITU-R BT.709), in parts of 10 000.
const WEIGHTS: [i32; 3] = [2126, 7152, 722];
/// The luma of opaque white.
const WHITE: i32 = 10_000 * 255 * 255;
/// [`THRESHOLD`] in the same measure.
const LEAST: i32 = WHITE / 10;

/// Pixels that are passed over at once where none has an edge.
pub(super) const CHUNK: usize = 16;
/// Rows that a thread takes at once.
pub(super) const BAND: usize = 32;

/// The luma of a stored colour weighted by its opacity, and that opacity: both `0..=WHITE`.
#[inline]
fn luma(pixel: u32) -> [i32; 2] {
    let [a, r, g, b] = pixel.to_be_bytes().map(i32::from);
    let luma = WEIGHTS[0] * r + WEIGHTS[1] * g + WEIGHTS[2] * b;
    [luma * a, a * (WHITE / 255)]
}

/// How far two pixels are apart, `0..=WHITE`.
#[inline]
fn distance(a: [i32; 2], b: [i32; 2]) -> i32 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// How far two pixels `0xAARRGGBB` are apart as edges measure it, `0.0..=1.0`.
pub(super) fn contrast(a: u32, b: u32) -> f64 {
    f64::from(distance(luma(a), luma(b))) / f64::from(WHITE)
}

/// What [`luma`] tells of a row of pixels.
#[derive(Clone, Debug, Default)]
struct LumaRow([Vec<i32>; 2]);

impl LumaRow {
    fn fill(&mut self, pixels: &[u32]) {
        for (part, of) in self.0.iter_mut().zip([0, 1]) {
            part.clear();
            part.extend(pixels.iter().map(|pixel| luma(*pixel)[of]));
        }
    }

    #[inline]
    fn at(&self, x: usize) -> [i32; 2] {
        [self.0[0][x], self.0[1][x]]
    }

    /// Whether any pixel differs enough from the one on its left or above: marks those sides.
    fn mark(&self, above: Option<&Self>, flags: &mut [u8]) {
        let [luma, opacity] = &self.0;
        let far = |a: i32, b: i32, c: i32, d: i32| (a - b).abs().max((c - d).abs()) >= LEAST;
        let left = luma.iter().zip(&luma[1..]).zip(opacity.iter().zip(&opacity[1..]));
        for (flag, ((a, b), (c, d))) in flags[1..].iter_mut().zip(left) {
            *flag = u8::from(far(*a, *b, *c, *d)) * LEFT;
        }
        if let Some(Self([above, opacity_above])) = above {
            let pairs = luma.iter().zip(above).zip(opacity.iter().zip(opacity_above));
            for (flag, ((a, b), (c, d))) in flags.iter_mut().zip(pairs) {
                *flag |= u8::from(far(*a, *b, *c, *d)) * TOP;
            }
        }
    }
}

/// The rows around one: two above it, itself, and the one below; none beyond the frame.
struct Rows<'a>([Option<&'a LumaRow>; 4]);

impl Rows<'_> {
    /// Drops those of a pixel's marked edges beside which luma differs much more.
    fn adapted(&self, x: usize, marked: u8) -> u8 {
        let [above_above, above, Some(row), below] = self.0 else {
            return 0;
        };
        let from = |pixel: [i32; 2], other: Option<[i32; 2]>| other.map_or(0, |other| distance(pixel, other));
        let in_row = |x: Option<usize>| x.filter(|x| *x < row.0[0].len()).map(|x| row.at(x));
        let in_column = |row: Option<&LumaRow>| row.map(|row| row.at(x));
        let own = row.at(x);
        let (left, top) = (in_row(x.checked_sub(1)), in_column(above));
        let (to_left, to_top) = (from(own, left), from(own, top));
        let beyond_left = left.map_or(0, |left| from(left, in_row(x.checked_sub(2))));
        let beyond_top = top.map_or(0, |top| from(top, in_column(above_above)));
        let right_or_bottom = from(own, in_row(Some(x + 1))).max(from(own, in_column(below)));
        let others = right_or_bottom.max(beyond_left).max(beyond_top);
        let most = to_left.max(to_top).max(others);
        let kept = |side: u8, distance: i32| if FACTOR * distance >= most { marked & side } else { 0 };
        kept(LEFT, to_left) | kept(TOP, to_top)
    }
}

/// The edges of a frame or a part of one: [`LEFT`] and [`TOP`] of each pixel.
#[derive(Debug)]
pub(super) struct Edges {
    pub(super) size: [usize; 2],
    stride: usize,
    flags: Vec<u8>,
}

impl Edges {
    /// Of `pixels` `0xAARRGGBB`, row by row.
    pub(super) fn new(pixels: &[u32], size: [usize; 2]) -> Self {
        let [width, height] = size;
        let stride = width + 2 * PADDING;
        let mut flags = vec![0; stride * (height + 2 * PADDING)];
        let own = &mut flags[PADDING * stride..][..height * stride];
        own.par_chunks_mut(BAND * stride).enumerate().for_each(|(band, flags)| {
            let mut window: [LumaRow; 4] = Default::default();
            let row = |y: usize| &pixels[y * width..][..width];
            let first = band * BAND;
            for (before, luma) in window.iter_mut().skip(1).enumerate() {
                // Those before the first row, it itself; the one after it comes below.
                if let Some(y) = (first + before).checked_sub(2).filter(|y| *y < height) {
                    luma.fill(row(y));
                }
            }
            for (y, flags) in (first..).zip(flags.chunks_exact_mut(stride)) {
                window.rotate_left(1);
                if y + 1 < height {
                    window[3].fill(row(y + 1));
                }
                let rows = window.each_ref();
                let seen = |k: usize| (y + k).checked_sub(2).filter(|y| *y < height).map(|_| rows[k]);
                let rows = Rows([0, 1, 2, 3].map(seen));
                mark(&rows, &mut flags[PADDING..][..width]);
            }
        });
        Self { size, stride, flags }
    }

    /// A row, and the one column after its last, which has no edges. The row below the last has none either.
    #[inline]
    pub(super) fn row(&self, y: usize) -> &[u8] {
        let start = (y + PADDING) * self.stride + PADDING;
        &self.flags[start..=start + self.size[0]]
    }

    /// The edges of a pixel; none beyond the frame.
    #[inline]
    pub(super) fn at(&self, [x, y]: [i32; 2]) -> u8 {
        let place = |at: i32| usize::try_from(at + PADDING_PIXELS);
        match (place(x), place(y)) {
            (Ok(x), Ok(y)) if x < self.stride => self.flags.get(y * self.stride + x).copied().unwrap_or(0),
            _ => 0,
        }
    }
}

/// The edges of one row.
fn mark(rows: &Rows<'_>, flags: &mut [u8]) {
    let Rows([_, above, Some(row), _]) = rows else {
        return;
    };
    row.mark(*above, flags);
    // Most pixels have no edges.
    for (start, flags) in (0..).step_by(CHUNK).zip(flags.chunks_mut(CHUNK)) {
        if flags.iter().fold(0, |any, flags| any | flags) != 0 {
            for (x, flags) in (start..).zip(flags).filter(|(_, flags)| **flags != 0) {
                *flags = rows.adapted(x, *flags);
            }
        }
    }
}
