//! The only place where scene meets raster: transforms a scene's primitives and draws them into a frame.

mod extent;
mod legend;
mod nearby;
mod parts;
mod regions;
mod replay;
mod screen;
mod smoothed;
mod ties;
mod tiles;
mod timing;
mod visualisation;

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::color::{BlendMode, ResolveSpace, Rgba};
use crate::geometry::ViewTransform;
use crate::post::{self, PostProcess};
use crate::raster::{
    self, Chunk, ChunkBuilder, Compositing, Counters, DisplayList, FilterRadius, Framebuffer, Hidden, ListContext,
    PaintSources, PixelCoverage, PlacedGradient, RasterSettings, RasterTimes, ResolveFilter, SamplePattern, SampleRate,
    Seed, ShadingRate, SizedFilter,
};
use crate::rules::Rules;
use crate::scene::{Composite, Fill, Gradient, MaskKind, Paint, PrimitiveKind, Scene};
use crate::texture::{Anisotropy, LevelOfDetail, LevelSampling, PixelSampling, PyramidFilter, SamplingSettings, Wrap};

pub use extent::Extent;
pub use legend::{Legend, LegendKey};
pub use nearby::Nearby;
use parts::chunks;
pub use regions::{Subject, draw_regions, refine, resolved_part};
pub use replay::{Explainer, MissedPrimitive, Neighbourhood, OpenSample, replay};
use screen::Screen;
pub use smoothed::widened;
pub use ties::NotOwned;
pub use timing::{Repeats, median, milliseconds, time_draws, time_words};
use visualisation::Visualiser;
pub use visualisation::{ClampedPixels, Visualisation};

/// Everything about a picture that is neither scene nor view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// Samples per pixel.
    pub sample_rate: SampleRate,
    /// Where they lie. A rate that the pattern does not take is drawn as the nearest one that it takes.
    pub pattern: SamplePattern,
    /// Which of all possible ways, where chance decides about that.
    pub seed: Seed,
    /// How often primitives are shaded in a pixel.
    pub shading: ShadingRate,
    /// What tells how much of a pixel a primitive covers: samples, or its exact area, with which rate, pattern and shading rate are
    /// without effect. Pictures of something else than colours have samples, but for that of what was clamped.
    pub coverage: PixelCoverage,
    /// Inside a mip level.
    pub pixel_sampling: PixelSampling,
    /// What textures show beyond their borders. The tiles of patterns go on for ever, whatever this says.
    pub texture_wrap: Wrap,
    /// Between mip levels.
    pub level_sampling: LevelSampling,
    /// In which values coarser mip levels were averaged.
    pub pyramid: ResolveSpace,
    /// By which filter.
    pub pyramid_filter: PyramidFilter,
    /// Along a footprint.
    pub anisotropy: Anisotropy,
    /// How large a footprint counts.
    pub detail: LevelOfDetail,
    /// Whose conventions.
    pub rules: Rules,
    /// What samples weigh in a pixel: its own, and its neighbours'. Pictures of something else than colours are means of a
    /// pixel's own samples, but for that of what was clamped, and so are the tiles of patterns, whose texels are samples yet.
    pub resolve_filter: ResolveFilter,
    /// How far that filter reaches, where not as far as it does by itself.
    pub filter_radius: Option<FilterRadius>,
    /// In which values the samples of a pixel are averaged.
    pub resolve: ResolveSpace,
    /// What is done to the finished pixels; pictures of something else than colours are left as they are.
    pub post_process: PostProcess,
    /// What the pixels show.
    pub visualisation: Visualisation,
    /// What lies below the first primitive.
    pub background: Rgba,
    /// Whether a one-pixel black outline runs just outside the canvas.
    pub outline: bool,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            sample_rate: SampleRate::ONE,
            pattern: SamplePattern::default(),
            seed: Seed::default(),
            shading: ShadingRate::default(),
            coverage: PixelCoverage::default(),
            pixel_sampling: PixelSampling::default(),
            texture_wrap: Wrap::default(),
            level_sampling: LevelSampling::default(),
            pyramid: ResolveSpace::default(),
            pyramid_filter: PyramidFilter::default(),
            anisotropy: Anisotropy::default(),
            detail: LevelOfDetail::default(),
            rules: Rules::default(),
            resolve_filter: ResolveFilter::default(),
            filter_radius: None,
            resolve: ResolveSpace::default(),
            post_process: PostProcess::default(),
            visualisation: Visualisation::default(),
            background: Rgba::WHITE,
            outline: true,
        }
    }
}

impl RenderSettings {
    /// The truth about a picture: as many samples as there can be, each of which reads the texture itself. Rules,
    /// background, how a texture is continued between its texels and beyond its border, what samples weigh and in which
    /// values they are averaged are the picture's own: what is then left of a difference is sampling. Only [`Rules::Float`]
    /// gives way to the standard rules: no number of samples closes its pinholes.
    ///
    /// No two samples of a pixel share a column or a row: on a grid of 256, upright and level edges would have 17 shades, and lines
    /// thinner than a sixteenth of a pixel could be missed.
    #[must_use]
    pub fn truth(self) -> Self {
        Self {
            sample_rate: SampleRate::new(SampleRate::MAX).unwrap_or(self.sample_rate),
            pattern: SamplePattern::Hammersley,
            shading: ShadingRate::Sample,
            coverage: PixelCoverage::Sampled,
            level_sampling: LevelSampling::Zero,
            pyramid: ResolveSpace::default(),
            pyramid_filter: PyramidFilter::default(),
            anisotropy: Anisotropy::OFF,
            detail: LevelOfDetail::default(),
            post_process: PostProcess::None,
            rules: match self.rules {
                Rules::Float => Rules::Standard,
                rules @ (Rules::Standard | Rules::Course) => rules,
            },
            ..self
        }
    }

    /// The truth whose samples are averaged in these values; without any in the picture's own.
    #[must_use]
    pub fn truth_in(self, space: Option<ResolveSpace>) -> Self {
        Self {
            resolve: space.unwrap_or(self.resolve),
            ..self.truth()
        }
    }

    /// Whether exact areas of pixels are covered, and not samples.
    pub fn covers_areas(&self) -> bool {
        self.coverage.is_exact() && self.visualisation.resolves_pictures()
    }

    /// The settings with those values of the sampling that have an effect: one sample in the middle of each pixel, where areas
    /// are covered.
    #[must_use]
    pub fn in_effect(self) -> Self {
        if !self.covers_areas() {
            return Self {
                coverage: PixelCoverage::Sampled,
                ..self
            };
        }
        Self {
            sample_rate: SampleRate::ONE,
            pattern: SamplePattern::Grid,
            shading: ShadingRate::Sample,
            ..self
        }
    }

    /// What samples weigh, and how far.
    pub(crate) fn filter(&self) -> SizedFilter {
        self.resolve_filter.sized(self.filter_radius)
    }

    /// In which values the finished pixels of the picture are blended, where they are, whatever is shown instead.
    pub(crate) fn smoothing(&self) -> Option<post::Values> {
        (self.post_process == PostProcess::Smaa).then_some(post::Values {
            space: self.resolve,
            rules: self.rules,
        })
    }

    /// How many pixels beside its own a pixel takes samples from, in each direction.
    pub(crate) fn margin(&self) -> f64 {
        self.filter().margin().into()
    }
}

/// Where the time of one frame went, as wall time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameStats {
    /// User space to screen space, clipping and snapping.
    pub transform: Duration,
    /// Primitives to tiles.
    pub bin: Duration,
    /// Coverage and shading, tile by tile.
    pub raster: Duration,
    /// Samples to pixels, tile by tile, and what is done to all pixels after that.
    pub resolve: Duration,
    /// Triangles and polygons that reached the tiles.
    pub triangles: u64,
    /// What was done in the tiles.
    pub counters: Counters,
}

impl FrameStats {
    /// The whole frame.
    pub fn total(&self) -> Duration {
        self.transform + self.bin + self.raster + self.resolve
    }
}

/// Asks a drawing in another thread to give up.
#[derive(Debug, Default)]
pub struct CancelToken(AtomicBool);

impl CancelToken {
    /// From now on the drawing may stop half-way.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether [`CancelToken::cancel`] was called.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Draws `scene` into the whole of `frame`, on the current rayon pool.
pub fn draw(scene: &Scene, view: &ViewTransform, settings: &RenderSettings, frame: &mut Framebuffer) -> FrameStats {
    draw_cancellable(scene, view, settings, frame, &CancelToken::default()).unwrap_or_default()
}

/// As [`draw`], but gives up between tiles once `cancel` says so: then the frame is unfinished and the answer `None`.
pub fn draw_cancellable(
    scene: &Scene,
    view: &ViewTransform,
    settings: &RenderSettings,
    frame: &mut Framebuffer,
    cancel: &CancelToken,
) -> Option<FrameStats> {
    let subject = Subject { scene, view, settings };
    let size = [frame.width(), frame.height()];
    rasterized(&subject, size, |list| {
        let mut times = list.rasterize(frame, &cancel.0)?;
        times.resolve += smoothed::whole(settings, frame);
        Some(times)
    })
}

/// As [`draw_cancellable`], but resolves into `surface`: as many pixels as the frame's, row by row, opaque where the
/// background is. `frame` gets its copy of each row of tiles once that is painted.
///
/// # Panics
/// When the surface has another number of pixels.
pub fn draw_onto(
    subject: &Subject<'_>,
    surface: &mut [u32],
    frame: &mut Framebuffer,
    cancel: &CancelToken,
) -> Option<FrameStats> {
    let size = [frame.width(), frame.height()];
    rasterized(subject, size, |list| {
        if smoothed::of_frame(subject.settings).is_none() {
            return list.rasterize_onto(surface, frame, &cancel.0);
        }
        let mut times = list.rasterize(frame, &cancel.0)?;
        times.resolve += smoothed::whole(subject.settings, frame);
        surface.copy_from_slice(frame.pixels());
        Some(times)
    })
}

/// Makes the list of a frame of `size` pixels, and has it drawn.
fn rasterized(
    subject: &Subject<'_>,
    size: [u32; 2],
    rasterize: impl FnOnce(&DisplayList<'_>) -> Option<RasterTimes> + Send,
) -> Option<FrameStats> {
    // The way into the pool, which wakes a thread, is gone once for all steps.
    rayon::scope(|_| {
        let start = Instant::now();
        let list = display_list(subject, size);
        let transform = start.elapsed();
        let times = rasterize(&list)?;
        Some(FrameStats {
            transform,
            bin: times.bin,
            raster: times.raster,
            resolve: times.resolve,
            triangles: list.triangles(),
            counters: times.counters,
        })
    })
}

/// What paints a frame of `size` pixels: the picture, or what it shows instead.
fn display_list<'a>(subject: &Subject<'a>, size: [u32; 2]) -> DisplayList<'a> {
    let Subject { scene, view, settings } = *subject;
    let kind = settings.visualisation;
    if kind == Visualisation::Color {
        return picture_list(subject, size, Hidden::Dropped, |_| true);
    }
    let mut raster = raster_settings(settings);
    Visualiser::change(kind, &mut raster);
    let context = ListContext::new(size, &raster);
    let screen = Screen::new(view, settings, size);
    let visualiser = Visualiser::new(kind, scene, raster.sampling);
    let mut list = chunks(scene, |index, primitives| {
        let mut builder = visualiser.prepare(ChunkBuilder::new(&context, primitives.len()));
        for primitive in (index..).take(primitives.len()) {
            builder.set_source(number(primitive));
            visualiser.add(&mut builder, &screen, primitive);
        }
        builder.finish()
    });
    if visualiser.has_overlay() {
        let mut veil = ChunkBuilder::new(&context, 2);
        veil.untold(|veil| Visualiser::add_veil(veil, size, raster.background));
        list.push(veil.finish());
        list.extend(chunks(scene, |index, primitives| {
            let mut builder = ChunkBuilder::new(&context, primitives.len());
            for primitive in (index..).take(primitives.len()) {
                builder.set_source(number(primitive));
                builder.untold(|builder| visualiser.add_overlay(builder, &screen, primitive));
            }
            builder.finish()
        }));
    }
    if kind.has_outline() {
        list.extend(outline(scene, &context, &screen, settings));
    }
    DisplayList::new(context, raster, list, visualiser.sources(view, settings))
}

/// Transforms those primitives of a scene that are `wanted` to screen space, in parallel. It is the picture that they
/// paint, whatever the settings show instead.
fn picture_list<'a>(
    subject: &Subject<'a>,
    size: [u32; 2],
    hidden: Hidden,
    wanted: impl Fn(&PrimitiveKind) -> bool + Sync,
) -> DisplayList<'a> {
    let Subject { scene, view, settings } = *subject;
    let raster = raster_settings(settings);
    let context = ListContext::new(size, &raster);
    let screen = Screen::new(view, settings, size);
    let mut list = chunks(scene, |index, primitives| {
        let mut builder = ChunkBuilder::new(&context, primitives.len());
        if hidden == Hidden::Kept {
            builder = builder.with_hidden();
        }
        for (source, primitive) in (index..).zip(primitives) {
            if wanted(&primitive.kind) {
                builder.set_source(number(source));
                add(&mut builder, &screen, &primitive.kind);
            }
        }
        builder.finish()
    });
    list.extend(outline(scene, &context, &screen, settings));
    DisplayList::new(context, raster, list, sources(scene, view, settings))
}

/// What a scene's paints point to, where it is seen in this view with these settings.
fn sources<'a>(scene: &'a Scene, view: &ViewTransform, settings: &RenderSettings) -> PaintSources<'a> {
    let placed = |gradient: &'a Gradient| PlacedGradient {
        geometry: gradient.geometry,
        ramp: &gradient.ramp,
        from_pixels: (view.scene_to_pixels * gradient.to_user).inverse(),
    };
    PaintSources {
        textures: scene.textures.iter().map(AsRef::as_ref).collect(),
        gradients: scene.gradients.iter().map(placed).collect(),
        patterns: tiles::placed(&scene.patterns, view, settings),
    }
}

/// The outline of the canvas, where one is wanted.
fn outline(scene: &Scene, context: &ListContext, screen: &Screen<'_>, settings: &RenderSettings) -> Option<Chunk> {
    settings.outline.then(|| {
        let mut builder = ChunkBuilder::new(context, 4);
        builder.set_source(number(scene.primitives.len()));
        for ends in screen.outline(scene.canvas) {
            builder.hairline(ends, Rgba::BLACK);
        }
        builder.finish()
    })
}

/// What the settings mean to the rasterizer.
fn raster_settings(settings: &RenderSettings) -> RasterSettings {
    let settings = settings.in_effect();
    RasterSettings {
        rate: settings.sample_rate,
        pattern: settings.pattern,
        seed: settings.seed,
        shading: settings.shading,
        coverage: settings.coverage,
        sampling: SamplingSettings {
            pixel: settings.pixel_sampling,
            wrap: settings.texture_wrap,
            level: settings.level_sampling,
            pyramid: settings.pyramid,
            pyramid_filter: settings.pyramid_filter,
            anisotropy: settings.anisotropy,
            detail: settings.detail,
            sample_step: settings.pattern.nearest(settings.sample_rate).step(),
            rules: settings.rules,
        },
        filter: settings.filter(),
        space: settings.resolve,
        background: settings.background,
        recolor: None,
    }
}

/// The number of a primitive; the reader refuses scenes of more than `2^32`.
fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

fn add(builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, kind: &PrimitiveKind) {
    match kind {
        PrimitiveKind::Triangle { points, paint: own } => {
            builder.triangle(points.map(|p| screen.place(p)), &paint(own));
        }
        PrimitiveKind::Polygon { polygon: own, fill } => screen.with_edges(own, |polygon| {
            let paint = fill_paint(*fill);
            if own.is_crisp() {
                return builder.crisp_polygon(polygon, |p| screen.place(p), &paint);
            }
            match screen.rules.cut_polygons().then(|| polygon.triangles()).flatten() {
                // The course knows triangles only, whose edges it counts twice; first drafts leave them to nobody.
                Some(triangles) => {
                    for points in triangles {
                        builder.triangle(points.map(|p| screen.place(p)), &paint);
                    }
                }
                None => builder.polygon(polygon, |p| screen.place(p), &paint),
            }
        }),
        PrimitiveKind::Hairline { ends, color } => builder.hairline(ends.map(|p| screen.place(p)), *color),
        PrimitiveKind::Point { at, color } => builder.point(screen.place(*at), *color),
        PrimitiveKind::BeginLayer => builder.begin_layer(),
        PrimitiveKind::EndLayer { composite } => builder.end_layer(compositing(*composite)),
    }
}

/// How a layer is composited, as the rasterizer has it.
fn compositing(composite: Composite) -> Compositing {
    match composite {
        Composite::Over {
            opacity,
            blend: BlendMode::Normal,
        } => Compositing::with_opacity(opacity),
        Composite::Over { opacity, blend } => Compositing::blended(blend, opacity),
        Composite::Clip => Compositing::mask(false),
        Composite::Mask(kind) => Compositing::mask(kind == MaskKind::Luminance),
    }
}

/// What fills a polygon, as the rasterizer has it.
fn fill_paint(fill: Fill) -> raster::Paint {
    match fill {
        Fill::Solid(color) => raster::Paint::solid(color),
        Fill::Gradient(gradient) => raster::Paint::gradient(gradient.0),
        Fill::Pattern(pattern) => raster::Paint::pattern(pattern.0),
    }
}

/// A scene's paint as the rasterizer has it.
fn paint(paint: &Paint) -> raster::Paint {
    match *paint {
        Paint::Solid(color) => raster::Paint::solid(color),
        Paint::Vertex(colors) => raster::Paint::vertex(colors),
        Paint::Texture { texture, uv, opacity } => {
            raster::Paint::texture(texture.0, uv.map(|uv| uv.to_array()), opacity)
        }
    }
}
