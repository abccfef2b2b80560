//! Which painter a tile gets.

use rayon::prelude::*;

use crate::color::{Premultiplied16, ResolveSpace};
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
/// fastest. Where samples of the grid are shaded, sums of them may be rounded once per primitive and pixel, or each sample for
/// itself: tiles that shade anything take the one or the other for the whole list, unless sums of what they shade are
/// those of its rounded samples. Off the grid, and in linear light, every sample is rounded for itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::raster) enum Method {
    /// Opaque primitives straight into the frame.
    Direct,
    /// What each sample shows, then its colour.
    Visibility(Rounding),
    /// The colour of each sample, primitive by primitive.
    PerSample,
}

/// What is rounded of samples that are shaded once it is known what they show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::raster) enum Rounding {
    /// The sum of those of a pixel that show the same opaque primitive.
    Sums,
    /// Each for itself: the bytes are those of [`Method::PerSample`], where there are no layers and all is painted on something
    /// opaque.
    Samples,
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
    /// What they are painted on.
    ground: Premultiplied16,
}

impl Kinds {
    /// Of these chunks, painted under `rules` on `ground`.
    pub(in crate::raster) fn of(
        chunks: &[Chunk],
        sources: &PaintSources<'_>,
        rules: Rules,
        ground: Premultiplied16,
    ) -> Self {
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
            ground,
        }
    }

    /// Whether every tile is painted by [`Method::Direct`].
    pub(in crate::raster) fn are_direct(self, context: &ListContext, filter: SizedFilter) -> bool {
        let plain = filter.is_plain() && context.is_grid() && !context.coverage.is_exact();
        let once = context.shading != ShadingRate::Centroid || self.flat;
        plain && once && context.rate == SampleRate::ONE && self.opaque
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
        // Light of what is not opaque may lose something on its way, and layers do not know what is below them.
        let in_one_layer = || self.ground.is_opaque() && all(|command, chunk| !is_layer_mark(&command.work(chunk)));
        let by_samples = || {
            if context.rate.is_square() && (all_opaque() || in_one_layer()) {
                Method::Visibility(Rounding::Samples)
            } else {
                Method::PerSample
            }
        };
        if context.coverage.is_exact() {
            return Method::PerSample;
        }
        if context.shading == ShadingRate::Centroid && !all_flat() {
            // What a primitive covered of a pixel before others came over it decides where it is shaded.
            return Method::PerSample;
        }
        let rate_one = context.rate == SampleRate::ONE;
        if !filter.is_plain() {
            // What neighbours weigh, too, takes the colour of every sample; surfaces tell which of these are seen.
            return if !has_room(context) {
                Method::PerSample
            } else if all_flat() {
                Method::Visibility(Rounding::Sums)
            } else {
                by_samples()
            };
        }
        if !context.is_grid() || space != ResolveSpace::Stored && !rate_one {
            return if context.rate.is_square() && all_flat() {
                Method::Visibility(Rounding::Sums)
            } else {
                by_samples()
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
            Method::Visibility(Rounding::Sums)
        } else if rate_one {
            Method::PerSample
        } else {
            by_samples()
        }
    }
}

/// Whether a tile of surfaces holds what is painted for one, its margin too.
fn has_room(context: &ListContext) -> bool {
    let [width, height] = context.tiles.painted_sides();
    let samples = width * height * context.rate.samples() as usize;
    context.rate.is_square() && width <= ROW && samples <= MAX_SURFACES / 2
}

/// Whether a layer begins or ends.
fn is_layer_mark(work: &Work<'_>) -> bool {
    matches!(work, Work::BeginLayer | Work::EndLayer(_))
}

/// Whether the sum of a pixel's samples that show nothing else is that of their rounded colours.
fn rounds_each_sample(work: &Work<'_>) -> bool {
    match work {
        Work::Flat(..) => true,
        Work::Shaded(_, _, paint) => paint.rounds_each_sample(),
        Work::BeginLayer | Work::EndLayer(_) => false,
    }
}
