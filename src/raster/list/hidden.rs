//! Hidden primitives are dropped before they are drawn: commands below an opaque shape that covers all of their samples.
//!
//! A document may paint its canvas anew a hundred thousand times, and each time would be sorted into every tile. Where a
//! tile lies inside such a shape, its painter starts with the last one anyway; along the shape's border, and along the
//! diagonal of two triangles that make a rectangle, it would paint them all. So a chunk that is being filled looks back a
//! little from every large convex shape. What is dropped is counted as a triangle of the picture all the same.

use crate::geometry::edge::{EdgeTest, doubled_area};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::list::chunk::{Chunk, DrawCommand};
use crate::raster::list::context::ListContext;
use crate::raster::span::SpanRect;
use crate::rules::Rules;

/// How many commands before a shape are looked at.
const LOOK_BACK: usize = 32;

/// Most corners of a shape that is looked at: four that turn one way are convex, more might wind around twice.
pub(crate) const MOST_CORNERS: usize = 4;

/// What becomes of hidden primitives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hidden {
    /// They are dropped where that is found out cheaply.
    Dropped,
    /// They are kept, to tell what was painted.
    Kept,
}

/// Drops commands of a chunk that are wholly hidden by samples `cover`, all of which the last `above` commands hide.
pub(crate) fn drop_hidden(chunk: &mut Chunk, context: &ListContext, cover: SpanRect, above: usize) {
    let end = chunk.commands.len().saturating_sub(above);
    let first = end.saturating_sub(LOOK_BACK);
    // What was painted before a layer, or in it, is not below what comes after.
    let is_mark = |command: &DrawCommand| matches!(command, DrawCommand::BeginLayer(_) | DrawCommand::EndLayer(_));
    let mark = chunk.commands[first..end].iter().rposition(is_mark);
    let first = mark.map_or(first, |mark| first + mark + 1);
    let mut kept = first;
    for i in first..end {
        let command = chunk.commands[i];
        let samples = chunk.sample_box(command, context);
        if samples.is_some_and(|samples| !holds(cover, samples)) {
            (chunk.commands[kept], chunk.sources[kept]) = (command, chunk.sources[i]);
            kept += 1;
        }
    }
    chunk.commands.drain(kept..end);
    chunk.sources.drain(kept..end);
}

fn holds(outer: SpanRect, inner: SpanRect) -> bool {
    inner.intersection(outer) == inner
}

/// Whether samples are so many that looking back costs little beside painting them.
pub(crate) fn is_large(samples: SpanRect, context: &ListContext) -> bool {
    let [width, height] = context.tiles.sides_log2();
    let side = context.grid.side();
    samples.x.end - samples.x.start >= side << width && samples.y.end - samples.y.start >= side << height
}

/// Whether a shape of three or four corners is convex and covers all of some samples: those at their corners, and so all.
pub(crate) fn covers(corners: &[GridPoint], samples: SpanRect, grid: SubpixelGrid, rules: Rules) -> bool {
    let count = corners.len();
    let corner = |i: usize| corners[i % count];
    let turn = |i: usize| doubled_area([corner(i), corner(i + 1), corner(i + 2)]).signum();
    let way = turn(0);
    if way == 0 || (1..count).any(|i| turn(i) != way) {
        return false;
    }
    let SpanRect { x: columns, y: rows } = samples;
    [columns.start, columns.end - 1].into_iter().all(|column| {
        [rows.start, rows.end - 1].into_iter().all(|row| {
            let point = GridPoint {
                x: grid.sample_coordinate(column),
                y: grid.sample_coordinate(row),
            };
            (0..count).all(|i| {
                let (from, to) = (corner(i), corner(i + 1));
                let (from, to) = if way > 0 { (from, to) } else { (to, from) };
                EdgeTest::clockwise(from, to, point).is_inside(rules)
            })
        })
    })
}

/// The corners of what two triangles make together that share an edge, in the order around it.
pub(crate) fn joined(a: [GridPoint; 3], b: [GridPoint; 3]) -> Option<[GridPoint; 4]> {
    let own = (0..3).find(|i| !b.contains(&a[*i]))?;
    let other = b.into_iter().find(|corner| !a.contains(corner))?;
    let (next, last) = (a[(own + 1) % 3], a[(own + 2) % 3]);
    (b.contains(&next) && b.contains(&last)).then_some([a[own], next, other, last])
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::sync::atomic::AtomicBool;

    use arbtest::arbitrary::{Result, Unstructured};
    use glam::DVec2;

    use crate::color::{ResolveSpace, Rgba};
    use crate::geometry::{FillRule, Polygon};
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::random::{any_filter, check_until, fill, noise};
    use crate::raster::shading::Paint;
    use crate::raster::{DisplayList, Framebuffer, RasterSettings, SamplePattern, SampleRate};
    use crate::rules::Rules;
    use crate::texture::SamplingSettings;

    const SIZE: [u32; 2] = [150, 90];

    /// An opaque quadrilateral, as a polygon or as two triangles; mostly upright, mostly over much of the frame.
    fn cover(builder: &mut ChunkBuilder<'_>, u: &mut Unstructured<'_>) -> Result<()> {
        let mut near = |at: f64| Ok(at + f64::from(u.int_in_range(-40..=40)?) / 4.0);
        let (x, y) = ([near(4.0)?, near(140.0)?], [near(4.0)?, near(84.0)?]);
        let mut points = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]].map(DVec2::from_array);
        if u.ratio(1, 4)? {
            let corner = u.choose_index(4)?;
            points[corner] += DVec2::new(f64::from(u.int_in_range(-300..=300)?), 30.0);
        }
        let color = Rgba::from_bytes([u.arbitrary()?, u.arbitrary()?, u.arbitrary()?, 255]);
        let [a, b, c, d] = points;
        if u.arbitrary()? {
            let polygon = Polygon::new([points.to_vec()], FillRule::NonZero);
            builder.polygon(&polygon, |point| point, &Paint::solid(color));
        } else {
            builder.triangle([a, b, c], &Paint::solid(color));
            builder.triangle([c, d, a], &Paint::solid(color));
        }
        Ok(())
    }

    #[test]
    fn hidden_ops_are_dropped_and_the_bytes_stay() {
        let texture = noise();
        let (all, kept) = (Cell::new(0), Cell::new(0));
        let are_fewer = || kept.get() < all.get();
        check_until(1500, are_fewer, |u| {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let settings = RasterSettings {
                rate: SampleRate::new(*u.choose(&[1, 4, 9, 16])?).expect("a rate"),
                pattern,
                sampling: SamplingSettings {
                    rules: *u.choose(&Rules::ALL)?,
                    ..SamplingSettings::default()
                },
                filter: any_filter(u)?,
                space: *u.choose(&ResolveSpace::ALL)?,
                ..RasterSettings::default()
            };
            let seed: Vec<u8> = (0..1200).map(|_| u.arbitrary()).collect::<Result<_>>()?;
            let draw = |keep: bool| -> Result<(Framebuffer, u64)> {
                let context = super::ListContext::new(SIZE, &settings);
                let mut u = Unstructured::new(&seed);
                let mut builder = ChunkBuilder::new(&context, 12);
                if keep {
                    builder = builder.with_hidden();
                }
                for source in 0..4 {
                    builder.set_source(source);
                    fill(&mut builder, &mut u)?;
                    cover(&mut builder, &mut u)?;
                }
                let chunk = builder.finish();
                assert_eq!(chunk.commands.len(), chunk.sources.len(), "each command has its source");
                let list = DisplayList::new(context, settings, vec![chunk], vec![&texture].into());
                let count = if keep { &all } else { &kept };
                count.set(count.get() + list.commands());
                let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
                list.rasterize(&mut frame, &AtomicBool::new(false))
                    .expect("not cancelled");
                Ok((frame, list.triangles()))
            };
            let (with, without) = (draw(true)?, draw(false)?);
            assert_eq!(with.1, without.1, "all triangles are counted");
            assert!(with.0 == without.0, "{settings:?}");
            Ok(())
        });
        assert!(are_fewer(), "{} of {} commands are kept", kept.get(), all.get());
    }
}
