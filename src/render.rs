//! The only place where scene meets raster: transforms a scene's primitives and draws them into a frame.

mod legend;
mod nearby;
mod regions;
mod replay;
mod tiles;
mod visualisation;

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use glam::DVec2;
use rayon::prelude::*;

use crate::color::{BlendMode, ResolveSpace, Rgba};
use crate::geometry::{Polygon, ViewTransform};
use crate::raster::{
    self, Chunk, ChunkBuilder, Compositing, Counters, DisplayList, FilterRadius, Framebuffer, Hidden, ListContext,
    PaintSources, PlacedGradient, RasterSettings, RasterTimes, ResolveFilter, SamplePattern, SampleRate, Seed,
    SizedFilter,
};
use crate::rules::Rules;
use crate::scene::{Composite, Fill, Gradient, MaskKind, Paint, Primitive, PrimitiveKind, Scene};
use crate::texture::{Anisotropy, LevelOfDetail, LevelSampling, PixelSampling, SamplingSettings};

pub use legend::{Legend, LegendKey};
pub use nearby::Nearby;
pub use regions::{Subject, draw_regions, refine};
pub use replay::{Explainer, Neighbourhood, OpenSample, replay};
pub use visualisation::Visualisation;
use visualisation::Visualiser;

/// Everything about a picture that is neither scene nor view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// Samples per pixel.
    pub sample_rate: SampleRate,
    /// Where they lie. A rate that the pattern does not take is drawn as the nearest one that it takes.
    pub pattern: SamplePattern,
    /// Which of all possible ways, where chance decides about that.
    pub seed: Seed,
    /// Inside a mip level.
    pub pixel_sampling: PixelSampling,
    /// Between mip levels.
    pub level_sampling: LevelSampling,
    /// Along a footprint.
    pub anisotropy: Anisotropy,
    /// How large a footprint counts.
    pub detail: LevelOfDetail,
    /// Whose conventions.
    pub rules: Rules,
    /// What samples weigh in a pixel: its own, and its neighbours'. Pictures of something else than colours are means of a
    /// pixel's own samples, and so are the tiles of patterns, whose texels are samples yet.
    pub resolve_filter: ResolveFilter,
    /// How far that filter reaches, where not as far as it does by itself.
    pub filter_radius: Option<FilterRadius>,
    /// In which values the samples of a pixel are averaged.
    pub resolve: ResolveSpace,
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
            pixel_sampling: PixelSampling::default(),
            level_sampling: LevelSampling::default(),
            anisotropy: Anisotropy::default(),
            detail: LevelOfDetail::default(),
            rules: Rules::default(),
            resolve_filter: ResolveFilter::default(),
            filter_radius: None,
            resolve: ResolveSpace::default(),
            visualisation: Visualisation::default(),
            background: Rgba::WHITE,
            outline: true,
        }
    }
}

impl RenderSettings {
    /// The truth about a picture: as many samples as there can be, each of which reads the texture itself. Rules,
    /// background, how a texture is continued between its texels, what samples weigh and in which values they are averaged
    /// are the picture's own: what is then left of a difference is sampling. Only [`Rules::Float`] gives way to the standard
    /// rules: no number of samples closes its pinholes.
    #[must_use]
    pub fn truth(self) -> Self {
        Self {
            sample_rate: SampleRate::new(SampleRate::MAX).unwrap_or(self.sample_rate),
            pattern: SamplePattern::Grid,
            level_sampling: LevelSampling::Zero,
            anisotropy: Anisotropy::OFF,
            detail: LevelOfDetail::default(),
            rules: match self.rules {
                Rules::Float => Rules::Standard,
                rules @ (Rules::Standard | Rules::Course) => rules,
            },
            ..self
        }
    }

    /// What samples weigh, and how far.
    pub(crate) fn filter(&self) -> SizedFilter {
        self.resolve_filter.sized(self.filter_radius)
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
    /// Samples to pixels, tile by tile.
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
    rasterized(&subject, size, |list| list.rasterize(frame, &cancel.0))
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
    rasterized(subject, size, |list| list.rasterize_onto(surface, frame, &cancel.0))
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

/// Fewest points that are worth another thread.
const MIN_POINTS: usize = 192;

/// Most primitives of a part, and fewest of one of a large scene.
const MAX_PRIMITIVES: usize = 65_536;
const LARGE: usize = 1024;

/// Parts into which a large scene is cut; a small one into as many as there are threads, since tiles have to look at all
/// of them.
const PARTS: usize = 64;

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
        Visualiser::add_veil(&mut veil, size, raster.background);
        list.push(veil.finish());
        list.extend(chunks(scene, |index, primitives| {
            let mut builder = ChunkBuilder::new(&context, primitives.len());
            for primitive in (index..).take(primitives.len()) {
                builder.set_source(number(primitive));
                visualiser.add_overlay(&mut builder, &screen, primitive);
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
        patterns: scene
            .patterns
            .iter()
            .map(|pattern| tiles::placed(pattern, view, settings))
            .collect(),
    }
}

/// What `make` makes of each part of a scene, in painter's order: of the number of its first primitive and its primitives.
fn chunks(scene: &Scene, make: impl Fn(usize, &[Primitive]) -> Chunk + Sync) -> Vec<Chunk> {
    let parts = parts(&scene.primitives, rayon::current_num_threads());
    let make = |part: Range<usize>| make(part.start, &scene.primitives[part]);
    parts.into_par_iter().map(make).collect()
}

/// Cuts primitives into parts for several threads: those of a small scene have about as many points each, those of a large
/// one as many primitives.
fn parts(primitives: &[Primitive], threads: usize) -> Vec<Range<usize>> {
    let count = primitives.len();
    if count > LARGE * threads {
        let length = (count / PARTS).clamp(LARGE, MAX_PRIMITIVES);
        return (0..count)
            .step_by(length)
            .map(|start| start..count.min(start + length))
            .collect();
    }
    let points = |primitive: &Primitive| match &primitive.kind {
        PrimitiveKind::Triangle { points, .. } => points.len(),
        PrimitiveKind::Polygon { polygon, .. } => polygon.points().len(),
        _ => 1,
    };
    let all: usize = primitives.iter().map(points).sum();
    let most = all.div_ceil(threads).max(MIN_POINTS);
    let (mut parts, mut start, mut held) = (Vec::with_capacity(threads), 0, 0);
    for (i, primitive) in primitives.iter().enumerate() {
        held += points(primitive);
        if held >= most {
            parts.push(start..i + 1);
            (start, held) = (i + 1, 0);
        }
    }
    if start < count {
        parts.push(start..count);
    }
    parts
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
    RasterSettings {
        rate: settings.sample_rate,
        pattern: settings.pattern,
        seed: settings.seed,
        sampling: SamplingSettings {
            pixel: settings.pixel_sampling,
            level: settings.level_sampling,
            anisotropy: settings.anisotropy,
            detail: settings.detail,
            sample_step: settings.pattern.nearest(settings.sample_rate).step(),
            rules: settings.rules,
        },
        filter: settings.filter(),
        space: settings.resolve,
        background: settings.background,
        palette: None,
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

/// Pixels per user unit, in the direction in which there are most.
fn pixels_per_unit(view: &ViewTransform) -> f64 {
    let matrix = view.scene_to_pixels.matrix2;
    matrix.x_axis.length().max(matrix.y_axis.length())
}

/// User space to screen space, by whose rules.
struct Screen<'a> {
    view: &'a ViewTransform,
    rules: Rules,
    /// Samples per user unit, in the direction in which there are most.
    scale: f64,
    /// Pixels of the frame.
    size: [u32; 2],
    /// Pixels that are painted on each side of it.
    margin: f64,
}

impl<'a> Screen<'a> {
    fn new(view: &'a ViewTransform, settings: &RenderSettings, size: [u32; 2]) -> Self {
        Self {
            view,
            rules: settings.rules,
            scale: pixels_per_unit(view) * f64::from(settings.sample_rate.side()),
            size,
            margin: settings.margin(),
        }
    }

    /// Calls `draw` with a polygon whose edges are fine enough for this view.
    fn with_edges<T>(&self, polygon: &Polygon, draw: impl FnOnce(&Polygon) -> T) -> T {
        let finer = if polygon.curves().is_some() && self.shows(polygon) {
            polygon.at_scale(self.scale)
        } else {
            None
        };
        draw(finer.as_deref().unwrap_or(polygon))
    }

    /// The same with edges so much finer that the area in a pixel is known to three digits; those of many points stay the
    /// picture's.
    fn with_true_edges<T>(&self, polygon: &Polygon, measure: impl FnOnce(&Polygon) -> T) -> T {
        /// Of a pixel's side.
        const TOLERANCE: f64 = 5e-4;
        /// They become several times as many, and are cut into triangles.
        const MOST_POINTS: usize = 2_000;
        match polygon.curves().filter(|_| polygon.points().len() <= MOST_POINTS) {
            // Not remembered by the polygon: frames would have to find theirs again.
            Some(curves) => {
                let tolerance = TOLERANCE / pixels_per_unit(self.view);
                measure(&Polygon::new(curves.flattened(tolerance), polygon.rule()))
            }
            None => self.with_edges(polygon, measure),
        }
    }

    /// Whether any of a polygon may lie in what is painted.
    fn shows(&self, polygon: &Polygon) -> bool {
        let [low, high] = polygon.bounds();
        let corners =
            [low, high, DVec2::new(low.x, high.y), DVec2::new(high.x, low.y)].map(|corner| self.place(corner));
        let [first, last] = corners
            .iter()
            .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[first, last], corner| {
                [first.min(*corner), last.max(*corner)]
            });
        first.cmple(DVec2::from(self.size.map(f64::from)) + self.margin).all()
            && last.cmpge(DVec2::splat(-self.margin)).all()
    }

    fn place(&self, point: DVec2) -> DVec2 {
        let exact = self.view.to_pixels(point);
        match self.rules {
            Rules::Standard => exact,
            Rules::Course | Rules::Float => exact.as_vec2().as_dvec2(),
        }
    }

    /// The four hairlines just outside the canvas, as the course draws them.
    fn outline(&self, canvas: DVec2) -> [[DVec2; 2]; 4] {
        let corner = |x: f64, y: f64, dx: f64, dy: f64| self.place(DVec2::new(x, y)) + DVec2::new(dx, dy);
        let a = corner(0.0, 0.0, -1.0, 1.0);
        let b = corner(canvas.x, 0.0, 1.0, 1.0);
        let c = corner(0.0, canvas.y, -1.0, -1.0);
        let d = corner(canvas.x, canvas.y, 1.0, -1.0);
        [[a, b], [a, c], [d, b], [d, c]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{DialectChoice, NoResources, ReadOptions, read};

    /// A scene of polygons with so many corners each.
    fn scene(corners: impl Iterator<Item = usize>) -> Scene {
        let polygon = |count: usize| format!("<polygon points='{}'/>", "1,2 7,3 5,8 ".repeat(count.div_ceil(3)));
        let polygons = corners.map(polygon).collect::<Vec<_>>().concat();
        let document = format!("<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'>{polygons}</svg>");
        let options = ReadOptions {
            dialect: DialectChoice::Svg,
        };
        read(document.as_bytes(), "polygons", options, &NoResources).expect("a good document")
    }

    fn points(primitives: &[Primitive]) -> usize {
        let of = |primitive: &Primitive| match &primitive.kind {
            PrimitiveKind::Polygon { polygon, .. } => polygon.points().len(),
            PrimitiveKind::Triangle { points, .. } => points.len(),
            _ => 0,
        };
        primitives.iter().map(of).sum()
    }

    #[test]
    fn parts_hold_each_primitive_once_and_small_scenes_as_many_points_in_each() {
        let small = scene((0..90).map(|i| if i < 80 { 3 } else { 240 }));
        let few = scene([30].into_iter());
        let large = scene((0..5000).map(|_| 6));
        for threads in 1..=4 {
            for scene in [&small, &few, &large] {
                let parts = parts(&scene.primitives, threads);
                let all: Vec<usize> = parts.iter().cloned().flatten().collect();
                assert_eq!(
                    all,
                    (0..scene.primitives.len()).collect::<Vec<_>>(),
                    "each once, in order"
                );
            }
            let parts_of_small = parts(&small.primitives, threads);
            assert_eq!(parts_of_small.len(), threads, "one for each thread");
            let share = points(&small.primitives) / threads;
            for part in parts_of_small {
                let held = points(&small.primitives[part]);
                assert!(
                    held.abs_diff(share) <= 240 * threads,
                    "{held} points of {share} by {threads}"
                );
            }
            assert_eq!(
                parts(&few.primitives, threads).len(),
                1,
                "nobody is woken up for so little"
            );
        }
    }
}
