//! Which painter a tile gets.

use rayon::prelude::*;

use crate::color::ResolveSpace;
use crate::raster::SampleRate;
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::list::chunk::Chunk;
use crate::raster::list::context::ListContext;
use crate::raster::resolve::SizedFilter;
use crate::raster::shading::sources::PaintSources;
use crate::rules::Rules;

/// How a tile is painted.
///
/// With one sample per pixel, and where everything is flat, all methods give the same bytes, so each tile takes the
/// fastest. Where samples of the grid are shaded, the visibility method rounds once per primitive and pixel, blending once
/// per sample: tiles that shade anything take the one or the other for the whole list. Off the grid, and in linear light,
/// every sample is rounded for itself, and both give the same bytes where nothing is to be seen through what is shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::raster) enum Method {
    /// Opaque primitives straight into the frame.
    Direct,
    /// What each sample shows, then its colour.
    Visibility,
    /// The colour of each sample, primitive by primitive.
    PerSample,
}

/// What the primitives of a list are like.
#[expect(
    clippy::struct_excessive_bools,
    reason = "what is so of all of a list, each on its own"
)]
#[derive(Clone, Copy, Debug)]
pub(in crate::raster) struct Kinds {
    /// All are opaque, and none is in a layer.
    opaque: bool,
    /// None has more than one colour.
    flat: bool,
    /// Samples that are shaded must be blended one by one.
    blended: bool,
}

impl Kinds {
    pub(in crate::raster) fn of(chunks: &[Chunk], sources: &PaintSources<'_>, rules: Rules) -> Self {
        let layers = chunks.iter().any(Chunk::has_layers);
        let translucent = chunks.iter().any(|chunk| chunk.translucent);
        // A few are looked at faster than another thread wakes up.
        let (shaded, shaded_opaque) = chunks
            .par_iter()
            .with_min_len(8)
            .map(|chunk| {
                let mut shaded = chunk.paints.iter().filter(|paint| paint.constant.is_none()).peekable();
                let any = shaded.peek().is_some();
                (any, shaded.all(|paint| paint.is_opaque(sources)))
            })
            .reduce(|| (false, true), |a, b| (a.0 || b.0, a.1 && b.1));
        Self {
            opaque: !translucent && shaded_opaque && !layers,
            flat: !shaded,
            // The course truncates every sample; layers do not know what would be below a sample that shows through.
            blended: !shaded_opaque || shaded && (layers || rules == Rules::Course),
        }
    }

    /// How a tile is painted of which these commands are to be seen, chunk by chunk; its samples are weighted by `filter` and
    /// averaged in `space`.
    pub(in crate::raster) fn method<'c, I: Iterator<Item = (&'c Chunk, &'c [TileCommand])> + Clone>(
        self,
        context: &ListContext,
        filter: SizedFilter,
        space: ResolveSpace,
        commands: &I,
    ) -> Method {
        let all = |is_so: fn(&TileCommand, &Chunk) -> bool| {
            let mut commands = commands.clone();
            commands.all(|(chunk, commands)| commands.iter().all(|command| is_so(command, chunk)))
        };
        let all_opaque = || self.opaque || all(|command, _| command.is_opaque());
        let all_flat = || self.flat || all(|command, chunk| !matches!(command.work(chunk), Work::Shaded(..)));
        let rate_one = context.rate == SampleRate::ONE;
        if !filter.is_plain() {
            // What neighbours weigh, too, takes the colour of every sample.
            return Method::PerSample;
        }
        if !context.is_grid() || space != ResolveSpace::Stored && !rate_one {
            return if context.rate.is_square() && (all_flat() || all_opaque()) {
                Method::Visibility
            } else {
                Method::PerSample
            };
        }
        if rate_one && all_opaque() {
            Method::Direct
        } else if !self.blended || all_flat() {
            Method::Visibility
        } else {
            Method::PerSample
        }
    }
}
