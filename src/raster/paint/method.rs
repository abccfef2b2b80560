//! Which painter a tile gets.

use rayon::prelude::*;

use crate::color::ResolveSpace;
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::list::chunk::Chunk;
use crate::raster::list::context::ListContext;
use crate::raster::resolve::SizedFilter;
use crate::raster::shading::sources::PaintSources;
use crate::raster::surface_id::{MAX_SURFACES, ROW};
use crate::raster::{SampleRate, ShadingRate};
use crate::rules::Rules;

/// How a tile is painted.
///
/// With one sample per pixel, and where everything is flat, all methods give the same bytes, so each tile takes the
/// fastest. Where samples of the grid are shaded, the visibility method rounds once per primitive and pixel, blending once
/// per sample: tiles that shade anything take the one or the other for the whole list, unless sums of what they shade are
/// those of its rounded samples. Off the grid, and in linear light, every sample is rounded for itself, and both give the same
/// bytes where nothing is to be seen through what is shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::raster) enum Method {
    /// Opaque primitives straight into the frame.
    Direct,
    /// What each sample shows, then its colour.
    Visibility,
    /// The colour of each sample, primitive by primitive.
    PerSample,
}

/// Which tiles must blend shaded samples one by one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Blended {
    /// None: nothing that is shaded is mixed with anything.
    Nowhere,
    /// Those in which something is mixed, and those where it would make a difference to sum up before rounding.
    WhereItMatters,
    /// All of them.
    Everywhere,
}

/// What the primitives of a list are like.
#[derive(Clone, Copy, Debug)]
pub(in crate::raster) struct Kinds {
    /// All are opaque, and none is in a layer.
    opaque: bool,
    /// None has more than one colour.
    flat: bool,
    /// Where samples that are shaded must be blended one by one.
    blended: Blended,
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
            blended: if shaded && rules == Rules::Course {
                // The course truncates every sample.
                Blended::Everywhere
            } else if !shaded_opaque || shaded && layers {
                // Layers do not know what would be below a sample that shows through.
                Blended::WhereItMatters
            } else {
                Blended::Nowhere
            },
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
        let exact = || all(|command, chunk| command.is_opaque() && rounds_each_sample(&command.work(chunk)));
        let all_flat = || self.flat || all(|command, chunk| !matches!(command.work(chunk), Work::Shaded(..)));
        if context.coverage.is_exact() {
            return Method::PerSample;
        }
        if context.shading == ShadingRate::Centroid && !all_flat() {
            // What a primitive covered of a pixel before others came over it decides where it is shaded.
            return Method::PerSample;
        }
        let rate_one = context.rate == SampleRate::ONE;
        if !filter.is_plain() {
            // What neighbours weigh, too, takes the colour of every sample; of what is flat surfaces tell it at last.
            return if all_flat() && has_room(context) {
                Method::Visibility
            } else {
                Method::PerSample
            };
        }
        if !context.is_grid() || space != ResolveSpace::Stored && !rate_one {
            return if context.rate.is_square() && (all_flat() || all_opaque()) {
                Method::Visibility
            } else {
                Method::PerSample
            };
        }
        if rate_one && all_opaque() {
            return Method::Direct;
        }
        let visibility = match self.blended {
            Blended::Nowhere => true,
            // One colour for all samples of a pixel is rounded before they are summed.
            Blended::WhereItMatters => all_flat() || exact() || context.shading.is_once() && all_opaque(),
            Blended::Everywhere => all_flat(),
        };
        if visibility {
            Method::Visibility
        } else {
            Method::PerSample
        }
    }
}

/// Whether a tile of surfaces holds what is painted for one, its margin too.
fn has_room(context: &ListContext) -> bool {
    let [width, height] = context.tiles.painted_sides();
    let samples = width * height * context.rate.samples() as usize;
    context.rate.is_square() && width <= ROW && samples <= MAX_SURFACES / 2
}

/// Whether the sum of a pixel's samples that show nothing else is that of their rounded colours.
fn rounds_each_sample(work: &Work<'_>) -> bool {
    match work {
        Work::Flat(..) => true,
        Work::Shaded(_, _, paint) => paint.rounds_each_sample(),
        Work::BeginLayer | Work::EndLayer(_) => false,
    }
}
