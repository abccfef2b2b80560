//! Drawings as people have them, the gallery's and others of the size of real files: paths, strokes, dashes, text, gradients,
//! clips and blend modes, side by side with resvg and `vello_cpu`.
//!
//! All three start from the document as usvg resolves it, with the same typefaces; reading is outside of the time.

use std::path::Path;
use std::sync::Arc;

use rasterscope::scene::{DialectChoice, NoResources, ReadOptions, read};
use resvg::usvg;
use resvg::usvg::fontdb;
use resvg::usvg::tiny_skia_path::PathSegment;
use vello_cpu::kurbo::{Affine, BezPath, Cap, Join, Shape as _, Stroke};
use vello_cpu::peniko::color::{AlphaColor, DynamicColor, Srgb};
use vello_cpu::peniko::{BlendMode, ColorStop, Compose, Extend, Fill, Gradient, Mix};
use vello_cpu::{PaintType, RenderContext};

use crate::ours::{Ours, pool, settings};
use crate::peers::vello_by;
use crate::race::{Budget, Rival, Timing, race};
use crate::scenes::documents;
use crate::table::{Row, ratio, say_times, times};

/// The gallery's drawings that `vello_cpu` has everything for: no patterns, no masks.
const DRAWINGS: [&str; 5] = [
    "vector/01_icon_sheet.svg",
    "vector/02_city_map.svg",
    "vector/03_plot.svg",
    "vector/04_poster.svg",
    "vector/05_small_print.svg",
];

/// The rivals, in the order in which they run.
const NAMES: [&str; 5] = ["ours@16", "resvg-aa", "vello/1", "vello/1+1", "vello/1+2"];

const SIZE: [u32; 2] = [1024, 1024];

/// The rows of drawings, and of documents of the size that people have.
pub(crate) fn drawings(budget: Budget) -> Vec<Row> {
    let gallery = DRAWINGS.map(|name| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg").join(name);
        (name, std::fs::read_to_string(path).expect("a file of the gallery"))
    });
    let mut rows = race_all(
        &gallery,
        budget,
        [
            "drawings (icons, map, plot, poster, page of text), rate 16, against resvg",
            "the same against vello_cpu's analytic antialiasing (its best number of threads)",
        ],
    );
    rows.extend(race_all(
        &documents::all(),
        budget,
        [
            "documents (a map of 5 MB, a plot of 100 000 segments, a page of 10 000 glyphs), rate 16, against resvg",
            "the same documents against vello_cpu, likewise",
        ],
    ));
    rows
}

/// Times documents that people name.
pub(crate) fn files(paths: &[&Path], budget: Budget) {
    for path in paths {
        let document = std::fs::read_to_string(path).expect("a file that can be read");
        say_times(&path.display().to_string(), SIZE, &NAMES, &race_on(&document, budget));
    }
}

fn race_all(
    documents: &[(&str, String)],
    budget: Budget,
    [against_resvg, against_vello]: [&'static str; 2],
) -> Vec<Row> {
    let mut columns = vec![Vec::new(); NAMES.len()];
    for (name, document) in documents {
        let timings = race_on(document, budget);
        say_times(name, SIZE, &NAMES, &timings);
        for (column, timing) in columns.iter_mut().zip(timings) {
            column.push(timing);
        }
    }
    let [ours, resvg, vellos @ ..] = columns.as_slice() else {
        return Vec::new();
    };
    let best: Vec<Timing> = (0..ours.len())
        .map(|i| Timing {
            median: vellos
                .iter()
                .map(|column| column[i].median)
                .fold(f64::INFINITY, f64::min),
            min: vellos.iter().map(|column| column[i].min).fold(f64::INFINITY, f64::min),
        })
        .collect();
    let row = |work, must, here| Row {
        work,
        must,
        aim: "",
        here,
        part: "drawings",
    };
    vec![
        row(against_resvg, "1x as fast", times(ratio(resvg, ours))),
        row(against_vello, "0.77x as fast", times(ratio(&best, ours))),
    ]
}

fn race_on(document: &str, budget: Budget) -> Vec<Timing> {
    let tree = tree(document);
    let options = ReadOptions {
        dialect: DialectChoice::Svg,
    };
    let read = read(document.as_bytes(), "", options, &NoResources).expect("a scene");
    let mut ours = Ours::new(&read, SIZE, settings(16), pool(2));
    let mut rivals = vec![
        Rival::new(move || {
            ours.draw();
        }),
        resvg(&tree),
    ];
    rivals.extend((0..3).map(|workers| vello(&tree, workers)));
    race(&mut rivals, budget)
}

/// The document with the typefaces that the program brings.
fn tree(document: &str) -> usvg::Tree {
    let mut fonts = fontdb::Database::new();
    for face in [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR] {
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(face)));
    }
    let options = usvg::Options {
        fontdb: Arc::new(fonts),
        ..usvg::Options::default()
    };
    usvg::Tree::from_str(document, &options).expect("a good document")
}

/// Pixels per user unit, right and down.
fn scale(tree: &usvg::Tree) -> [f32; 2] {
    #[expect(clippy::cast_precision_loss, reason = "small frames")]
    let [width, height] = SIZE.map(|side| side as f32);
    [width / tree.size().width(), height / tree.size().height()]
}

fn resvg(tree: &usvg::Tree) -> Rival<'_> {
    let [x, y] = scale(tree);
    let transform = tiny_skia::Transform::from_scale(x, y);
    let mut frame = tiny_skia::Pixmap::new(SIZE[0], SIZE[1]).expect("a small frame");
    Rival::new(move || {
        frame.fill(tiny_skia::Color::WHITE);
        resvg::render(tree, transform, &mut frame.as_mut());
    })
}

/// `vello_cpu`; its commands are made before the clock starts, as our scene is.
fn vello(tree: &usvg::Tree, workers: u16) -> Rival<'_> {
    let [x, y] = scale(tree).map(f64::from);
    let mut steps = Vec::new();
    group(tree.root(), Affine::scale_non_uniform(x, y), &mut steps);
    vello_by(SIZE, workers, move |context| {
        for step in &steps {
            step.run(context);
        }
    })
}

/// What `vello_cpu` is told.
enum Step {
    Fill(Affine, BezPath, PaintType, Affine, Fill),
    Stroke(Affine, BezPath, PaintType, Affine, Stroke),
    Layer(Affine, Option<BezPath>, BlendMode, f32),
    Pop,
}

impl Step {
    fn run(&self, context: &mut RenderContext) {
        match self {
            Self::Fill(to_frame, path, paint, paint_to_user, rule) => {
                context.set_transform(*to_frame);
                context.set_paint(paint.clone());
                context.set_paint_transform(*paint_to_user);
                context.set_fill_rule(*rule);
                context.fill_path(path);
            }
            Self::Stroke(to_frame, path, paint, paint_to_user, stroke) => {
                context.set_transform(*to_frame);
                context.set_paint(paint.clone());
                context.set_paint_transform(*paint_to_user);
                context.set_stroke(stroke.clone());
                context.stroke_path(path);
            }
            Self::Layer(to_frame, clip, blend, opacity) => {
                context.set_transform(*to_frame);
                context.set_fill_rule(Fill::NonZero);
                context.push_layer(clip.as_ref(), Some(*blend), Some(*opacity), None, None);
            }
            Self::Pop => context.pop_layer(),
        }
    }
}

fn group(group: &usvg::Group, around: Affine, steps: &mut Vec<Step>) {
    assert!(group.mask().is_none(), "a drawing without masks");
    let to_frame = around * affine(group.transform());
    let clip = group.clip_path().map(|clip| {
        let mut inside = BezPath::new();
        outlines(clip.root(), affine(clip.transform()), &mut inside);
        inside
    });
    let opacity = group.opacity().get();
    let is_layer = group.isolate() || clip.is_some() || opacity < 1.0 || group.blend_mode() != usvg::BlendMode::Normal;
    if is_layer {
        let blend = BlendMode::new(mix(group.blend_mode()), Compose::SrcOver);
        steps.push(Step::Layer(to_frame, clip, blend, opacity));
    }
    for node in group.children() {
        match node {
            usvg::Node::Group(inner) => self::group(inner, to_frame, steps),
            usvg::Node::Path(path) => shape(path, to_frame, steps),
            usvg::Node::Text(text) => self::group(text.flattened(), to_frame, steps),
            usvg::Node::Image(_) => panic!("a drawing without images"),
        }
    }
    if is_layer {
        steps.push(Step::Pop);
    }
}

fn outlines(group: &usvg::Group, around: Affine, outline: &mut BezPath) {
    let to_clip = around * affine(group.transform());
    for node in group.children() {
        match node {
            usvg::Node::Group(inner) => outlines(inner, to_clip, outline),
            usvg::Node::Path(path) => outline.extend(to_clip * bez(path)),
            usvg::Node::Text(text) => outlines(text.flattened(), to_clip, outline),
            usvg::Node::Image(_) => {}
        }
    }
}

fn shape(path: &usvg::Path, to_frame: Affine, steps: &mut Vec<Step>) {
    let fill = path.fill().map(|fill| {
        let (paint, paint_to_user) = paint(fill.paint(), fill.opacity().get());
        let rule = match fill.rule() {
            usvg::FillRule::NonZero => Fill::NonZero,
            usvg::FillRule::EvenOdd => Fill::EvenOdd,
        };
        Step::Fill(to_frame, bez(path), paint, paint_to_user, rule)
    });
    let stroke = path.stroke().map(|stroke| {
        let (paint, paint_to_user) = paint(stroke.paint(), stroke.opacity().get());
        Step::Stroke(to_frame, bez(path), paint, paint_to_user, style(stroke))
    });
    let steps_of_path = match path.paint_order() {
        usvg::PaintOrder::FillAndStroke => [fill, stroke],
        usvg::PaintOrder::StrokeAndFill => [stroke, fill],
    };
    steps.extend(steps_of_path.into_iter().flatten());
}

fn style(stroke: &usvg::Stroke) -> Stroke {
    let dashes = stroke.dasharray().unwrap_or_default().iter().copied().map(f64::from);
    Stroke::new(stroke.width().get().into())
        .with_caps(match stroke.linecap() {
            usvg::LineCap::Butt => Cap::Butt,
            usvg::LineCap::Round => Cap::Round,
            usvg::LineCap::Square => Cap::Square,
        })
        .with_join(match stroke.linejoin() {
            usvg::LineJoin::Miter | usvg::LineJoin::MiterClip => Join::Miter,
            usvg::LineJoin::Round => Join::Round,
            usvg::LineJoin::Bevel => Join::Bevel,
        })
        .with_miter_limit(stroke.miterlimit().get().into())
        .with_dashes(stroke.dashoffset().into(), dashes)
}

fn paint(paint: &usvg::Paint, opacity: f32) -> (PaintType, Affine) {
    let of_gradient = |gradient: &usvg::BaseGradient, drawn: Gradient| {
        let extend = match gradient.spread_method() {
            usvg::SpreadMethod::Pad => Extend::Pad,
            usvg::SpreadMethod::Reflect => Extend::Reflect,
            usvg::SpreadMethod::Repeat => Extend::Repeat,
        };
        let stops: Vec<ColorStop> = gradient
            .stops()
            .iter()
            .map(|stop| ColorStop {
                offset: stop.offset().get(),
                color: DynamicColor::from_alpha_color(color(stop.color(), stop.opacity().get() * opacity)),
            })
            .collect();
        (
            drawn.with_extend(extend).with_stops(stops.as_slice()).into(),
            affine(gradient.transform()),
        )
    };
    match paint {
        usvg::Paint::Color(solid) => (color(*solid, opacity).into(), Affine::IDENTITY),
        usvg::Paint::LinearGradient(linear) => {
            let [from, to] = [(linear.x1(), linear.y1()), (linear.x2(), linear.y2())];
            let ends = [from, to].map(|(x, y)| (f64::from(x), f64::from(y)));
            of_gradient(linear, Gradient::new_linear(ends[0], ends[1]))
        }
        usvg::Paint::RadialGradient(radial) => {
            let focus = (f64::from(radial.fx()), f64::from(radial.fy()));
            let center = (f64::from(radial.cx()), f64::from(radial.cy()));
            let drawn = Gradient::new_two_point_radial(focus, radial.fr().get(), center, radial.r().get());
            of_gradient(radial, drawn)
        }
        usvg::Paint::Pattern(_) => panic!("a drawing without patterns"),
    }
}

fn color(color: usvg::Color, opacity: f32) -> AlphaColor<Srgb> {
    AlphaColor::from_rgba8(color.red, color.green, color.blue, 255).with_alpha(opacity)
}

fn affine(transform: usvg::Transform) -> Affine {
    let usvg::Transform { sx, kx, ky, sy, tx, ty } = transform;
    Affine::new([sx, ky, kx, sy, tx, ty].map(f64::from))
}

fn bez(path: &usvg::Path) -> BezPath {
    let mut bez = BezPath::new();
    let point = |at: resvg::usvg::tiny_skia_path::Point| (f64::from(at.x), f64::from(at.y));
    for segment in path.data().segments() {
        match segment {
            PathSegment::MoveTo(to) => bez.move_to(point(to)),
            PathSegment::LineTo(to) => bez.line_to(point(to)),
            PathSegment::QuadTo(control, to) => bez.quad_to(point(control), point(to)),
            PathSegment::CubicTo(first, second, to) => bez.curve_to(point(first), point(second), point(to)),
            PathSegment::Close => bez.close_path(),
        }
    }
    debug_assert!(bez.bounding_box().is_finite(), "usvg's coordinates are");
    bez
}

fn mix(mode: usvg::BlendMode) -> Mix {
    use usvg::BlendMode as Theirs;
    match mode {
        Theirs::Normal | Theirs::PlusLighter => Mix::Normal,
        Theirs::Multiply => Mix::Multiply,
        Theirs::Screen => Mix::Screen,
        Theirs::Overlay => Mix::Overlay,
        Theirs::Darken => Mix::Darken,
        Theirs::Lighten => Mix::Lighten,
        Theirs::ColorDodge => Mix::ColorDodge,
        Theirs::ColorBurn => Mix::ColorBurn,
        Theirs::HardLight => Mix::HardLight,
        Theirs::SoftLight => Mix::SoftLight,
        Theirs::Difference => Mix::Difference,
        Theirs::Exclusion => Mix::Exclusion,
        Theirs::Hue => Mix::Hue,
        Theirs::Saturation => Mix::Saturation,
        Theirs::Color => Mix::Color,
        Theirs::Luminosity => Mix::Luminosity,
    }
}
