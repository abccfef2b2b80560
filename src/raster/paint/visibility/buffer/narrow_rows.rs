//! Painting rows of pixels with 2 x 2 or 4 x 4 samples, four pixels on an edge at a time: [`VisibilityBuffer::paint`] and
//! [`VisibilityBuffer::change`] with few instructions.

use std::ops::Range;

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use crate::raster::coverage::narrow_rows::{Ends, TileRow, Window, each_window};
use crate::raster::paint::visibility::buffer::VisibilityBuffer;
use crate::raster::paint::visibility::packed::{lanes, splat};
use crate::raster::paint::visibility::two_surfaces::{
    Group, GroupMask, PixelIndex, TwoSurfaceGroup, group, put, word_at,
};
use crate::raster::sampling::mask::SampleMask;
use crate::raster::surface_id::{ROW, SurfaceId, TWO_SURFACES};

/// The highest bit of each of four surfaces: set for every shared pixel, and for surfaces of high numbers.
const PERHAPS_SHARED: u64 = 0x8000_8000_8000_8000;

impl VisibilityBuffer {
    /// Lets the samples that a row of pixels covers show `surface`.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for each row of pixels would cost as much as the rest"
    )]
    pub(crate) fn paint_row<S: Simd, const SIDE: usize>(
        &mut self,
        simd: S,
        row: &TileRow<'_, SIDE>,
        surface: SurfaceId,
    ) {
        // Those covered in part may be shared from now on, and full ones are not.
        let shared = &mut self.shared[row.y];
        *shared |= bits(&row.touched);
        let any_full = !row.full.is_empty();
        if any_full {
            *shared &= !bits(&row.full);
        }
        each_partial_window(
            simd,
            row,
            #[inline(always)]
            |window| self.paint_group(simd, row.y, window, surface),
        );
        // Last: surfaces that were just written as vectors are read slowly.
        if any_full {
            fill(&mut self.whole[row.y], row.full.clone(), surface);
        }
    }

    /// Lets the samples that a row of pixels covers show what `change` makes of what they show.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for each row of pixels would cost as much as the rest"
    )]
    pub(crate) fn change_row<S: Simd, const SIDE: usize>(
        &mut self,
        simd: S,
        row: &TileRow<'_, SIDE>,
        mut change: impl FnMut(SurfaceId) -> SurfaceId,
    ) {
        self.shared[row.y] |= bits(&row.touched);
        each_partial_window(
            simd,
            row,
            #[inline(always)]
            |window| self.change_group(simd, row.y, window, &mut change),
        );
        self.change_whole(row.y, row.full.clone(), &mut change);
    }

    /// Lets the samples of a window show `surface`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn paint_group<S: Simd>(&mut self, simd: S, y: usize, Window { x, live, masks }: Window, surface: SurfaceId) {
        let whole = &mut self.whole[y];
        let word = word_at(whole, x);
        if word & live & PERHAPS_SHARED != 0 {
            return self.paint_shared_group(PixelIndex { y, x }, masks, surface);
        }
        let number = |number| Group::splat(simd, number);
        let (shown, covered) = (group(simd, word), group(simd, masks));
        let painted = in_part(simd, covered) & !shown.simd_eq(number(surface));
        put(whole, x, painted.select(number(TWO_SURFACES), shown));
        let two = TwoSurfaceGroup {
            masks: covered,
            firsts: shown,
            seconds: number(surface),
        };
        self.two_surfaces.set_group(simd, PixelIndex { y, x }, painted, two);
    }

    /// As [`VisibilityBuffer::paint_group`] pixel by pixel.
    #[inline(never)]
    fn paint_shared_group(&mut self, PixelIndex { y, x }: PixelIndex, masks: u64, surface: SurfaceId) {
        for (x, covered) in (x..).zip(lanes(masks)) {
            if covered != 0 {
                self.paint_samples(PixelIndex { y, x }, u64::from(covered), surface);
            }
        }
    }

    /// Lets the samples of a window show what `change` makes of what they show.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn change_group<S: Simd>(
        &mut self,
        simd: S,
        y: usize,
        Window { x, live, masks }: Window,
        change: &mut impl FnMut(SurfaceId) -> SurfaceId,
    ) {
        let whole = &mut self.whole[y];
        let word = word_at(whole, x);
        let [first, ..] = lanes(word >> (live.trailing_zeros() % 64));
        if first >= TWO_SURFACES || (word ^ splat(first)) & live != 0 {
            return self.change_shared_group(PixelIndex { y, x }, masks, change);
        }
        if masks == 0 {
            return;
        }
        let number = |number| Group::splat(simd, number);
        let (shown, covered) = (group(simd, word), group(simd, masks));
        let changed = in_part(simd, covered);
        put(whole, x, changed.select(number(TWO_SURFACES), shown));
        let two = TwoSurfaceGroup {
            masks: covered,
            firsts: shown,
            seconds: number(change(first)),
        };
        self.two_surfaces.set_group(simd, PixelIndex { y, x }, changed, two);
    }

    /// As [`VisibilityBuffer::change_group`] pixel by pixel.
    fn change_shared_group(
        &mut self,
        PixelIndex { y, x }: PixelIndex,
        masks: u64,
        change: &mut impl FnMut(SurfaceId) -> SurfaceId,
    ) {
        for (x, covered) in (x..).zip(lanes(masks)) {
            if covered != 0 {
                self.change_samples(PixelIndex { y, x }, SampleMask::of_bits(covered.into()), change);
            }
        }
    }
}

/// Calls `visit` with windows that hold each of the pixels once that a row covers in part.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
#[expect(
    clippy::redundant_closure,
    reason = "a reference to `visit` would not be inlined into vectors"
)]
fn each_partial_window<S: Simd, const SIDE: usize>(simd: S, row: &TileRow<'_, SIDE>, mut visit: impl FnMut(Window)) {
    if row.full.is_empty() {
        return each_window(simd, row, row.touched.clone(), Ends::Both, visit);
    }
    let (before, after) = row.beside_full();
    each_window(
        simd,
        row,
        before,
        Ends::Left,
        #[inline(always)]
        |window| visit(window),
    );
    each_window(
        simd,
        row,
        after,
        Ends::Right,
        #[inline(always)]
        |window| visit(window),
    );
}

/// A bit for each of some pixels of a row, at least one.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
fn bits(xs: &Range<usize>) -> u64 {
    u64::MAX >> ((ROW - xs.len()) % ROW) << (xs.start % ROW)
}

/// Which of four masks name some samples.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn in_part<S: Simd>(simd: S, masks: Group<S>) -> GroupMask<S> {
    !masks.simd_eq(Group::splat(simd, 0))
}

/// Lets some surfaces of a row be the same one.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
#[expect(clippy::cast_possible_truncation, reason = "places in a row of 64")]
fn fill(surfaces: &mut [SurfaceId; ROW], range: Range<usize>, surface: SurfaceId) {
    // The whole row: a loop of unknown length would cost more than the vectors that a row takes.
    let (start, length) = (range.start as SurfaceId, range.len() as SurfaceId);
    for (at, shown) in (0..).zip(surfaces) {
        let inside = SurfaceId::wrapping_sub(at, start) < length;
        *shown = if inside { surface } else { *shown };
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use fearless_simd::dispatch;

    use super::*;
    use crate::raster::coverage::narrow_rows::each_row;
    use crate::raster::coverage::pixel_rows::each_covered;
    use crate::raster::coverage::polygon_rows::{RowSpans, SpanStore};
    use crate::raster::coverage::span_rows::StoredRows;
    use crate::raster::paint::visibility::buffer::Run;
    use crate::raster::span::{Span, SpanRect};
    use crate::simd;

    /// What all samples of a tile show, pixel by pixel.
    fn samples(tile: &VisibilityBuffer) -> Vec<Vec<SurfaceId>> {
        let count = tile.side * tile.side;
        let mut all = Vec::new();
        for y in tile.rect.y.start..tile.rect.y.end {
            for (run, xs) in tile.found_runs(y) {
                for x in xs {
                    all.push(match run {
                        Run::Whole(surface) => vec![surface; count],
                        Run::TwoSurfacePixels => {
                            let two = tile.two_surfaces(y).get(x);
                            let surface = |i: u64| {
                                if two.mask >> i & 1 == 1 { two.second } else { two.first }
                            };
                            (0..).take(count).map(surface).collect()
                        }
                        Run::Split => tile.samples(x, y).collect(),
                    });
                }
            }
        }
        all
    }

    /// Spans in the sample rows of a tile and around it, few or several in each.
    fn shape(u: &mut Unstructured<'_>, rect: SpanRect, side: i32) -> Result<(Span, Vec<Vec<Span>>)> {
        let start = u.int_in_range(0..=rect.y.end * side - 1)?;
        let rows = Span {
            start,
            end: u.int_in_range(start + 1..=rect.y.end * side + 3)?,
        };
        let (several, steep) = (u.ratio(1, 3)?, u.int_in_range(-6..=6)?);
        let (mut from, mut to) = (u.int_in_range(-9..=300)?, u.int_in_range(-9..=400)?);
        let mut all = Vec::new();
        for _ in rows.start..rows.end {
            from += steep + u.int_in_range(-1..=1)?;
            to -= steep;
            let mut spans = Vec::new();
            let mut column = from.max(0);
            for _ in 0..if several { u.int_in_range(0..=3)? } else { 1 } {
                let end = if several { column + u.int_in_range(1..=90)? } else { to };
                if end > column {
                    spans.push(Span { start: column, end });
                }
                column = end.max(column) + u.int_in_range(1..=9)?;
            }
            if spans.is_empty() {
                spans.push(Span::EMPTY);
            }
            all.push(spans);
        }
        Ok((rows, all))
    }

    /// Paints a shape of a surface, or changes what it covers, in four and pixel by pixel.
    fn paint_both<const SIDE: usize>(
        level: simd::Level,
        tiles: &mut [VisibilityBuffer; 2],
        spans: RowSpans<'_>,
        surface: Option<SurfaceId>,
    ) {
        let [quick, slow] = tiles;
        let rect = quick.rect;
        let change = |surface: SurfaceId| surface % 200 * 7 % 101;
        let side = i32::try_from(SIDE).expect("few samples");
        let rows = || StoredRows::<SIDE>::new(spans, side, rect);
        dispatch!(level, simd => each_row(simd, &mut rows(), rect, |row| match surface {
            Some(surface) => quick.paint_row::<_, SIDE>(simd, row, surface),
            None => quick.change_row::<_, SIDE>(simd, row, change),
        }));
        each_covered(&mut rows(), side, rect.x, |y, covered| match surface {
            Some(surface) => slow.paint(y, covered, surface),
            None => slow.change(y, covered, change),
        });
    }

    #[test]
    fn groups_paint_what_is_painted_pixel_by_pixel_on_every_level() {
        let mut split = 0;
        arbtest::arbtest(|u| {
            let mut extent = |most: i32| {
                let start = u.int_in_range(0..=3)?;
                let end = start + u.int_in_range(1..=most)?;
                Ok(Span { start, end })
            };
            let rect = SpanRect {
                x: extent(64)?,
                y: extent(40)?,
            };
            let levels = simd::tested();
            let (name, level) = u.choose(&levels)?;
            let side = *u.choose(&[2, 4])?;
            let mut tiles = [VisibilityBuffer::new(side), VisibilityBuffer::new(side)];
            for tile in &mut tiles {
                tile.reset(rect, 1);
            }
            for _ in 0..u.int_in_range(1..=6)? {
                let (rows, spans) = shape(u, rect, side)?;
                let surface = if u.ratio(1, 3)? {
                    None
                } else {
                    Some(*u.choose(&[2, 3, 4, 40_000])?)
                };
                let mut store = SpanStore::default();
                let stored = store.put(rows, &spans);
                match side {
                    2 => paint_both::<2>(*level, &mut tiles, store.get(stored), surface),
                    _ => paint_both::<4>(*level, &mut tiles, store.get(stored), surface),
                }
                let [quick, slow] = &tiles;
                assert_eq!(
                    samples(quick),
                    samples(slow),
                    "{name}: {rect:?}, {surface:?} in {rows:?} {spans:?}"
                );
            }
            let [quick, _] = &tiles;
            for y in rect.y.start..rect.y.end {
                for (x, surface) in quick.row(y).iter().enumerate() {
                    let shared = quick.shown(y).shared >> x & 1 == 1;
                    assert!(*surface < TWO_SURFACES || shared, "what is shared has a bit");
                }
                split += quick.found_runs(y).filter(|(run, _)| *run == Run::Split).count();
            }
            Ok(())
        })
        .budget_ms(1500);
        assert!(split > 20, "some pixels were split: {split}");
    }

    #[test]
    fn surfaces_are_filled_from_start_to_end() {
        for start in 0..=ROW {
            for end in start..=ROW {
                let mut surfaces: [SurfaceId; ROW] =
                    std::array::from_fn(|i| SurfaceId::try_from(100 + i).expect("a surface"));
                let mut expected = surfaces;
                expected[start..end].fill(9);
                fill(&mut surfaces, start..end, 9);
                assert_eq!(surfaces, expected, "{start} to {end}");
            }
        }
    }
}
