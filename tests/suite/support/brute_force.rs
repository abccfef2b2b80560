//! The brute-force renderer: every sample against every primitive, in 64-bit floats, without tiles, spans, bins or
//! compressed samples. It shares no arithmetic with the engine, only the rules: it is the oracle of everything fast.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::float_cmp,
    reason = "the oracle states the rules in plain arithmetic on small numbers"
)]

use glam::DVec2;
use rasterscope::color::BlendMode;
use rasterscope::color::Spread;
use rasterscope::color::{ResolveSpace, Rgba};
use rasterscope::geometry::{FillRule, View, ViewTransform};
use rasterscope::raster::{Framebuffer, PixelCoverage, SamplePattern, SampleRate, ShadingRate};
use rasterscope::render::{RenderSettings, Subject, replay};
use rasterscope::rules::Rules;
use rasterscope::scene::{Composite, Dialect, Fill, MaskKind, Paint, PrimitiveKind, Scene};
use rasterscope::texture::{
    Derivatives, FixedLevel, FootprintExtent, LevelSampling, MipLevel, PixelSampling, Texture, Wrap,
};

use crate::support::{area_filters, areas, resolve_filters};

/// Premultiplied, `0.0..=1.0`.
pub(crate) type Color = [f64; 4];

/// The edges of a polygon.
struct Outline {
    edges: Vec<[(i128, i128); 2]>,
    rule: FillRule,
    fill: Fill,
}

struct Triangle<'a> {
    corners: [(i128, i128); 3],
    /// By the float rules, the corners in pixels.
    float: Option<[(f32, f32); 3]>,
    fill: Filling<'a>,
}

enum Filling<'a> {
    Flat(Rgba),
    Paint(&'a Paint),
}

/// A pixel and its samples, as points of a lattice.
struct Pixel<'p> {
    at: [i64; 2],
    /// Counted from its first point.
    places: &'p [[u32; 2]],
    /// Points along one side of a pixel, and fractional bits between two of them.
    side: u32,
    bits: u32,
}

enum Step<'a> {
    Triangle(Triangle<'a>),
    Outline(Outline),
    Pixels(Vec<(i64, i64)>, Rgba),
    BeginLayer,
    EndLayer(Composite),
}

/// Draws a scene under the standard rules or those of first drafts. Coordinates must stay small.
pub(crate) fn draw(scene: &Scene, view: &ViewTransform, settings: &RenderSettings, size: [u32; 2]) -> Framebuffer {
    let settings = &of_areas(*settings);
    let (side, bits) = lattice(settings);
    let units = f64::from(side << bits);
    let steps: Vec<Step<'_>> = scene
        .primitives
        .iter()
        .flat_map(|primitive| steps_of(&primitive.kind, view, units, settings.rules))
        .collect();
    let margin = resolve_filters::margin(settings);
    let [width, height] = size.map(i64::from);
    let mut samples = Vec::new();
    for y in -margin..height + margin {
        for x in -margin..width + margin {
            let places = places(settings, [x, y]);
            let pixel = Pixel {
                at: [x, y],
                places: &places,
                side,
                bits,
            };
            let of_pixel = |place: &[u32; 2]| {
                let [right, down] = *place;
                let color = sample_color(&steps, (scene, view), settings, (&pixel, *place));
                let averaged = match settings.resolve {
                    ResolveSpace::Stored => color,
                    ResolveSpace::Linear => each_straight(color, to_light),
                };
                (
                    [right, down].map(|at| (f64::from(at) + 0.5) / f64::from(side)),
                    averaged,
                )
            };
            samples.push(places.iter().map(of_pixel).collect::<Vec<_>>());
        }
    }
    let mut frame = Framebuffer::new(size[0], size[1]);
    for y in 0..height {
        for x in 0..width {
            let (mut sum, mut total) = ([0.0; 4], 0.0);
            for below in -margin..=margin {
                for right in -margin..=margin {
                    let index = (y + below + margin) * (width + 2 * margin) + x + right + margin;
                    for (place, color) in &samples[index as usize] {
                        let offset = [place[0] + right as f64 - 0.5, place[1] + below as f64 - 0.5];
                        let weight = resolve_filters::weight(settings, offset);
                        total += weight;
                        for (sum, channel) in sum.iter_mut().zip(color) {
                            *sum += channel * weight;
                        }
                    }
                }
            }
            let own = &samples[((y + margin) * (width + 2 * margin) + x + margin) as usize];
            if total < own.len() as f64 / 8.0 {
                // Weights below zero outweigh the others: the filter says nothing of this pixel.
                (sum, total) = ([0.0; 4], own.len() as f64);
                for (k, channel) in own.iter().flat_map(|(_, color)| color.iter().enumerate()) {
                    sum[k] += channel;
                }
            }
            let alpha = (sum[3] / total).clamp(0.0, 1.0);
            let [r, g, b, _] = sum.map(|sum| (sum / total).clamp(0.0, alpha));
            let mut mean = [r, g, b, alpha];
            if settings.resolve == ResolveSpace::Linear {
                mean = each_straight(mean, to_stored);
            }
            frame.pixels_mut()[(y * width + x) as usize] = to_pixel(mean);
        }
    }
    frame
}

/// Where areas are covered, a pixel is one sample in its middle.
fn of_areas(settings: RenderSettings) -> RenderSettings {
    match settings.coverage {
        PixelCoverage::Sampled => settings,
        PixelCoverage::Exact => RenderSettings {
            sample_rate: SampleRate::ONE,
            pattern: SamplePattern::Grid,
            shading: ShadingRate::Sample,
            ..settings
        },
    }
}

/// A premultiplied colour whose straight channels, but for alpha, go through a curve.
fn each_straight([r, g, b, alpha]: Color, curve: fn(f64) -> f64) -> Color {
    let through = |channel: f64| {
        if alpha > 0.0 {
            curve(channel / alpha) * alpha
        } else {
            0.0
        }
    };
    [through(r), through(g), through(b), alpha]
}

/// IEC 61966-2-1, and its inverse.
pub(crate) fn to_light(stored: f64) -> f64 {
    if stored <= 0.040_45 {
        stored / 12.92
    } else {
        ((stored + 0.055) / 1.055).powf(2.4)
    }
}

pub(crate) fn to_stored(light: f64) -> f64 {
    if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    }
}

/// Points of the lattice that samples lie on along one side of a pixel, and fractional bits between two of them.
fn lattice(settings: &RenderSettings) -> (u32, u32) {
    let side = settings.sample_rate.side();
    match settings.pattern {
        SamplePattern::Grid => (side, 14 - side.next_power_of_two().trailing_zeros()),
        // One sample in the middle is a grid.
        SamplePattern::Rotated | SamplePattern::R2 | SamplePattern::Hammersley
            if settings.sample_rate == SampleRate::ONE =>
        {
            (1, 14)
        }
        SamplePattern::Custom(custom) if matches!(custom.samples(), [one] if one.place == [128; 2] && one.weight == 1) => {
            (1, 14)
        }
        _ => (256, 6),
    }
}

/// The samples of a pixel as points of the lattice, counted from the pixel's first.
fn places(settings: &RenderSettings, pixel: [i64; 2]) -> Vec<[u32; 2]> {
    let (count, n) = (settings.sample_rate.samples(), settings.sample_rate.side());
    let side = f64::from(lattice(settings).0);
    let on_lattice = |place: [f64; 2]| place.map(|at| (at * side + 1e-9).floor() as u32);
    let cell = |i: u32| [f64::from(i % n), f64::from(i / n)];
    let of = |place: &dyn Fn(u32) -> [f64; 2]| (0..count).map(|i| on_lattice(place(i))).collect();
    let n = f64::from(n);
    match settings.pattern {
        SamplePattern::Grid => of(&|i| cell(i).map(|at| (at + 0.5) / n)),
        SamplePattern::Rotated => of(&|i| {
            let [column, row] = cell(i);
            [(column + (row + 0.5) / n) / n, (row + (n - 1.0 - column + 0.5) / n) / n]
        }),
        SamplePattern::Halton => of(&|i| [2, 3].map(|base| radical_inverse(i + 1, base))),
        SamplePattern::Hammersley => of(&|i| [(f64::from(i) + 0.5) / f64::from(count), radical_inverse(i + 1, 2)]),
        SamplePattern::R2 => of(&|i| {
            let g = 1.324_717_957_244_746_f64;
            [g, g * g].map(|step| (0.5 + f64::from(i) / step).fract())
        }),
        SamplePattern::Custom(custom) => {
            let repeated = custom
                .samples()
                .iter()
                .flat_map(|sample| (0..sample.weight).map(|_| sample.place));
            let places: Vec<[u32; 2]> = repeated.map(|place| place.map(u32::from)).collect();
            if lattice(settings).0 == 1 { vec![[0, 0]] } else { places }
        }
        // Where they lie is nobody else's business: tests about cells look at them. Of pixels beyond the frame nobody asks.
        SamplePattern::Jittered
        | SamplePattern::JitteredSame
        | SamplePattern::MultiJittered
        | SamplePattern::Random
        | SamplePattern::BlueNoise
        | SamplePattern::Sobol
        | SamplePattern::SobolSame => {
            let empty = Scene::empty(DVec2::ONE, Dialect::Svg);
            let view = View::Default.transform(DVec2::ONE, [64, 64]);
            let subject = Subject {
                scene: &empty,
                view: &view,
                settings,
            };
            let pixel = if settings.pattern.differs_by_pixel() {
                pixel.map(|at| u32::try_from(at).expect("in the frame"))
            } else {
                [0, 0]
            };
            let found = replay(&subject, [64, 64], pixel).expect("a small frame");
            found.samples.iter().map(|sample| on_lattice(sample.position)).collect()
        }
    }
}

/// The digits of a number, mirrored at the point.
fn radical_inverse(number: u32, base: u32) -> f64 {
    let (mut rest, mut weight, mut sum) = (number, 1.0, 0.0);
    while rest > 0 {
        weight /= f64::from(base);
        sum += f64::from(rest % base) * weight;
        rest /= base;
    }
    sum
}

/// The steps of a primitive; first drafts cut polygons into triangles and place their corners in 32 bits.
fn steps_of<'a>(kind: &'a PrimitiveKind, view: &ViewTransform, units: f64, rules: Rules) -> Vec<Step<'a>> {
    let float = |points: &[DVec2; 3]| {
        points.map(|point| {
            let at = view.to_pixels(point);
            (at.x as f32, at.y as f32)
        })
    };
    // Attributes, too, follow from the corners in 32 bits.
    let snap = |(x, y): (f32, f32)| {
        let on_grid = |at: f32| (f64::from(at) * units + 0.5).floor() as i128;
        (on_grid(x), on_grid(y))
    };
    let triangle = |points: &[DVec2; 3], fill| {
        Step::Triangle(Triangle {
            corners: float(points).map(snap),
            float: Some(float(points)),
            fill,
        })
    };
    match kind {
        _ if rules == Rules::Standard => vec![step(kind, view, units)],
        PrimitiveKind::Triangle { points, paint } => vec![triangle(points, Filling::Paint(paint))],
        PrimitiveKind::Polygon {
            polygon,
            fill: Fill::Solid(color),
        } => {
            let Some(triangles) = polygon.triangles() else {
                return vec![step(kind, view, units)];
            };
            triangles
                .iter()
                .map(|points| triangle(points, Filling::Flat(*color)))
                .collect()
        }
        _ => vec![step(kind, view, units)],
    }
}

fn step<'a>(kind: &'a PrimitiveKind, view: &ViewTransform, units: f64) -> Step<'a> {
    let snap = |point: DVec2| {
        let scaled = (view.to_pixels(point) * units + 0.5).floor();
        (scaled.x as i128, scaled.y as i128)
    };
    match kind {
        PrimitiveKind::Triangle { points, paint } => Step::Triangle(Triangle {
            corners: points.map(snap),
            float: None,
            fill: Filling::Paint(paint),
        }),
        PrimitiveKind::Polygon { polygon, fill } => {
            let mut edges = Vec::new();
            for contour in polygon.contours() {
                let next = contour.iter().cycle().skip(1);
                edges.extend(contour.iter().zip(next).map(|(from, to)| [snap(*from), snap(*to)]));
            }
            Step::Outline(Outline {
                edges,
                rule: polygon.rule(),
                fill: *fill,
            })
        }
        PrimitiveKind::Point { at, color } => {
            let at = view.to_pixels(*at).floor();
            Step::Pixels(vec![(at.x as i64, at.y as i64)], *color)
        }
        PrimitiveKind::Hairline { ends, color } => Step::Pixels(hairline(ends.map(|end| view.to_pixels(end))), *color),
        PrimitiveKind::BeginLayer => Step::BeginLayer,
        PrimitiveKind::EndLayer { composite } => Step::EndLayer(*composite),
    }
}

/// The course's digital differential analyser.
pub(crate) fn hairline(ends: [DVec2; 2]) -> Vec<(i64, i64)> {
    let mut ends = ends.map(|end| (end.x as f32, end.y as f32));
    if ends[0].0 > ends[1].0 {
        ends.swap(0, 1);
    }
    let [(x0, y0), (x1, y1)] = ends;
    let slope = (y1 - y0) / (x1 - x0);
    let (mut x, mut y) = (x0, y0);
    let mut pixels = Vec::new();
    while x.floor() <= x1.floor() && (y - y0).abs() <= (y1 - y0).abs() {
        pixels.push((x.floor() as i64, y.floor() as i64));
        if slope.abs() <= 1.0 {
            x += 1.0;
            y += slope;
        } else if x0 == x1 {
            y += if y1 < y0 { -1.0 } else { 1.0 };
        } else {
            x += 1.0 / slope.abs();
            y += slope.signum();
        }
    }
    pixels
}

fn sample_color(
    steps: &[Step<'_>],
    (scene, view): (&Scene, &ViewTransform),
    settings: &RenderSettings,
    (pixel, place): (&Pixel<'_>, [u32; 2]),
) -> Color {
    let sample = pixel.sample(place);
    let mut layers = vec![premultiply(settings.background)];
    for step in steps {
        let painted = match step {
            Step::BeginLayer => {
                layers.push([0.0; 4]);
                continue;
            }
            Step::EndLayer(composite) => {
                let layer = layers.pop().expect("layers are balanced");
                let below = layers.last_mut().expect("the base");
                *below = composited(layer, *below, *composite);
                continue;
            }
            Step::Pixels(pixels, color) => {
                let [x, y] = pixel.at;
                pixels.contains(&(x, y)).then(|| premultiply(*color))
            }
            Step::Outline(Outline { edges, rule, fill }) if settings.coverage == PixelCoverage::Exact => {
                let middle = [0, 1].map(|axis| pixel.at[axis] as f64 + 0.5);
                let above = filled(*fill, scene, view.to_scene(DVec2::from_array(middle)));
                let below = layers.last_mut().expect("the base");
                *below = covered(*below, above, areas::in_pixel(edges, *rule, pixel.at), settings.resolve);
                continue;
            }
            Step::Triangle(triangle) if settings.coverage == PixelCoverage::Exact => {
                let [a, b, c] = triangle.corners;
                let area = areas::in_pixel(&[[a, b], [b, c], [c, a]], FillRule::NonZero, pixel.at);
                // A line encloses nothing, but for rounding, and has no colour.
                if triangle.edges(sample).0 != 0 && area > 0.0 {
                    let above = triangle.color(scene, settings, sample, pixel);
                    let below = layers.last_mut().expect("the base");
                    *below = covered(*below, above, area, settings.resolve);
                }
                continue;
            }
            Step::Outline(outline) => outline.encloses(sample).then(|| {
                let (x, y) = pixel.shaded_at(settings.shading, sample, |sample| outline.encloses(sample));
                let at = DVec2::new(x as f64, y as f64) / f64::from(pixel.side << pixel.bits);
                filled(outline.fill, scene, view.to_scene(at))
            }),
            Step::Triangle(triangle) => triangle.covers(sample, pixel).then(|| {
                let at = pixel.shaded_at(settings.shading, sample, |sample| triangle.covers(sample, pixel));
                triangle.color(scene, settings, at, pixel)
            }),
        };
        if let (Some(above), Some(below)) = (painted, layers.last_mut()) {
            *below = std::array::from_fn(|k| above[k] + below[k] * (1.0 - above[3]));
        }
    }
    layers[0]
}

/// What a pixel shows of which a part is painted over.
fn covered(below: Color, above: Color, area: f64, space: ResolveSpace) -> Color {
    let over: Color = std::array::from_fn(|k| above[k] + below[k] * (1.0 - above[3]));
    let mean = |a: Color, b: Color| -> Color { std::array::from_fn(|k| a[k] * (1.0 - area) + b[k] * area) };
    match space {
        ResolveSpace::Stored => mean(below, over),
        ResolveSpace::Linear => {
            let [below, over] = [below, over].map(|color| each_straight(color, to_light));
            each_straight(mean(below, over), to_stored)
        }
    }
}

/// What a layer leaves of what is below it.
fn composited(layer: Color, below: Color, composite: Composite) -> Color {
    match composite {
        Composite::Over { opacity, blend } => {
            let above = layer.map(|channel| channel * f64::from(opacity));
            let (upper, lower) = (above[3], below[3]);
            let mixed = |k: usize| {
                let (a, b) = (above[k] / upper, below[k] / lower);
                let mixed = match blend {
                    BlendMode::Multiply => a * b,
                    BlendMode::Screen => 1.0 - (1.0 - a) * (1.0 - b),
                    BlendMode::Difference => (a - b).abs(),
                    BlendMode::Exclusion => a + b - 2.0 * a * b,
                    _ => a,
                };
                (1.0 - lower) * above[k] + (1.0 - upper) * below[k] + upper * lower * mixed
            };
            if upper == 0.0 || lower == 0.0 {
                return std::array::from_fn(|k| above[k] + below[k]);
            }
            [mixed(0), mixed(1), mixed(2), upper + lower - upper * lower]
        }
        Composite::Clip | Composite::Mask(MaskKind::Alpha) => below.map(|channel| channel * layer[3]),
        Composite::Mask(MaskKind::Luminance) => {
            let kept = 0.2125 * layer[0] + 0.7154 * layer[1] + 0.0721 * layer[2];
            below.map(|channel| channel * kept)
        }
    }
}

/// The colour of a fill at a point of user space.
fn filled(fill: Fill, scene: &Scene, at: DVec2) -> Color {
    let gradient = match fill {
        Fill::Solid(color) => return premultiply(color),
        Fill::Gradient(gradient) => &scene.gradients[gradient.0 as usize],
        Fill::Pattern(_) => panic!("no patterns here"),
    };
    let at = gradient.to_user.inverse().transform_point2(at);
    let Some(place) = gradient.geometry.at(at) else {
        return [0.0; 4];
    };
    let place = match gradient.ramp.spread() {
        Spread::Pad => place.clamp(0.0, 1.0),
        Spread::Repeat => place.rem_euclid(1.0),
        Spread::Reflect if place.rem_euclid(2.0) > 1.0 => 2.0 - place.rem_euclid(2.0),
        Spread::Reflect => place.rem_euclid(2.0),
    };
    let stops = gradient.ramp.stops();
    let mut color = stops[0].color;
    for pair in stops.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|stop| f64::from(stop.offset));
        if place >= to {
            color = pair[1].color;
        } else if place >= from {
            let weight = ((place - from) / (to - from)) as f32;
            let mix = |a: f32, b: f32| a + (b - a) * weight;
            let (a, b) = (pair[0].color, pair[1].color);
            color = Rgba {
                r: mix(a.r, b.r),
                g: mix(a.g, b.g),
                b: mix(a.b, b.b),
                a: mix(a.a, b.a),
            };
        }
    }
    premultiply(color)
}

impl Pixel<'_> {
    /// A sample in units of the sub-pixel grid.
    fn sample(&self, place: [u32; 2]) -> (i128, i128) {
        let at = |axis: usize| {
            let index = self.at[axis] * i64::from(self.side) + i64::from(place[axis]);
            (i128::from(index) << self.bits) + (1 << (self.bits - 1))
        };
        (at(0), at(1))
    }

    /// Where a primitive is shaded for a sample that it covers, as it does all of those that `covers` says.
    fn shaded_at(
        &self,
        shading: ShadingRate,
        sample: (i128, i128),
        covers: impl Fn((i128, i128)) -> bool,
    ) -> (i128, i128) {
        let units = i128::from(self.side << self.bits);
        let corner = self.at.map(|at| i128::from(at) * units);
        let centre = (corner[0] + units / 2, corner[1] + units / 2);
        let covered = self
            .places
            .iter()
            .map(|place| self.sample(*place))
            .filter(|sample| covers(*sample));
        let covered: Vec<(i128, i128)> = covered.collect();
        match shading {
            ShadingRate::Sample => sample,
            ShadingRate::Centre => centre,
            ShadingRate::Centroid if covered.len() == self.places.len() => centre,
            ShadingRate::Centroid => {
                // To the middle of a cell, of which up to 256 lie along a side of the pixel.
                let mut cells = i128::from(self.side);
                while cells * 2 <= 256 {
                    cells *= 2;
                }
                let cell = units / cells;
                let count = covered.len() as i128;
                let mean = |of: fn(&(i128, i128)) -> i128| {
                    let sum: i128 = covered.iter().map(of).sum();
                    sum.div_euclid(count * cell) * cell + cell / 2
                };
                (mean(|at| at.0), mean(|at| at.1))
            }
        }
    }
}

impl Outline {
    /// Whether a sample lies inside: how often the edges left of it wind around it. An edge counts in the rows from its
    /// top up to its bottom, and to the right of itself.
    fn encloses(&self, (x, y): (i128, i128)) -> bool {
        let mut winding = 0;
        for [from, to] in &self.edges {
            let (top, bottom, around) = if from.1 < to.1 { (from, to, 1) } else { (to, from, -1) };
            let left_of_sample = (bottom.0 - top.0) * (y - top.1) <= (bottom.1 - top.1) * (x - top.0);
            if top.1 <= y && y < bottom.1 && left_of_sample {
                winding += around;
            }
        }
        match self.rule {
            FillRule::NonZero => winding != 0,
            FillRule::EvenOdd => winding % 2 != 0,
        }
    }
}

impl Triangle<'_> {
    /// Twice its area, and for each corner what is twice that of the triangle between a point and the other two, and whether the
    /// point is inside of their edge if it lies on it.
    fn edges(&self, point: (i128, i128)) -> (i128, [(i128, bool); 3]) {
        let cross =
            |a: (i128, i128), b: (i128, i128), p: (i128, i128)| (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0);
        let [a, b, c] = self.corners;
        let area = cross(a, b, c);
        let edges = [(b, c), (c, a), (a, b)].map(|(from, to)| {
            let (dx, dy) = ((to.0 - from.0) * area.signum(), (to.1 - from.1) * area.signum());
            let top_left = dy < 0 || (dy == 0 && dx > 0);
            (cross(from, to, point) * area.signum(), top_left)
        });
        (area.abs(), edges)
    }

    /// Whether a sample lies inside.
    fn covers(&self, sample: (i128, i128), pixel: &Pixel<'_>) -> bool {
        let (area, edges) = self.edges(sample);
        match self.float {
            Some(corners) => {
                let place = |at: i128| (at as f64 / f64::from(pixel.side << pixel.bits)) as f32;
                area != 0 && is_inside_in_floats(corners, (place(sample.0), place(sample.1)))
            }
            None => area != 0 && edges.iter().all(|(value, on)| *value > 0 || *value == 0 && *on),
        }
    }

    /// The colour at a point, inside or not.
    fn color(&self, scene: &Scene, settings: &RenderSettings, at: (i128, i128), pixel: &Pixel<'_>) -> Color {
        let (area, edges) = self.edges(at);
        let weights = edges.map(|(value, _)| value as f64 / area as f64);
        let paint = match self.fill {
            Filling::Flat(color) => return premultiply(color),
            Filling::Paint(paint) => paint,
        };
        match paint {
            Paint::Solid(color) => premultiply(*color),
            Paint::Vertex(colors) => {
                let mix = |channel: fn(&Rgba) -> f32| {
                    (0..3).map(|k| weights[k] * f64::from(channel(&colors[k]))).sum::<f64>()
                };
                let mix = |channel| mix(channel).clamp(0.0, 1.0);
                let alpha = mix(|c| c.a);
                [mix(|c| c.r) * alpha, mix(|c| c.g) * alpha, mix(|c| c.b) * alpha, alpha]
            }
            Paint::Texture { texture, uv, opacity } => {
                let uv = uv.map(|uv| DVec2::new(f64::from(uv.x), f64::from(uv.y)));
                let here = uv[0] * weights[0] + uv[1] * weights[1] + uv[2] * weights[2];
                let texture = &scene.textures[texture.0 as usize];
                let per_pixel = self.uv_per_pixel(uv, f64::from(pixel.side << pixel.bits));
                filtered(texture, here, per_pixel, settings).map(|channel| channel * f64::from(*opacity))
            }
        }
    }

    /// `(u, v)` changes by this to the right and down: from the change of barycentric weights per pixel.
    fn uv_per_pixel(&self, uv: [DVec2; 3], units: f64) -> [DVec2; 2] {
        let [a, b, c] = self.corners.map(|(x, y)| DVec2::new(x as f64, y as f64) / units);
        let area = (b - a).perp_dot(c - a);
        let per = |gradient: fn(DVec2) -> f64| {
            (uv[0] * gradient(c - b) + uv[1] * gradient(a - c) + uv[2] * gradient(b - a)) / area
        };
        [per(|edge| -edge.y), per(|edge| edge.x)]
    }
}

/// First drafts: inside where all three line equations have one sign, and nobody looks beyond the box.
fn is_inside_in_floats(corners: [(f32, f32); 3], at: (f32, f32)) -> bool {
    let line = |a: (f32, f32), b: (f32, f32)| (b.0 - a.0) * (at.1 - a.1) - (b.1 - a.1) * (at.0 - a.0);
    let [a, b, c] = corners;
    let values = [line(a, b), line(b, c), line(c, a)];
    let beyond = |of: fn((f32, f32)) -> f32| {
        corners.iter().all(|corner| of(*corner) < of(at)) || corners.iter().all(|corner| of(*corner) > of(at))
    };
    let one_sign = values.iter().all(|value| *value > 0.0) || values.iter().all(|value| *value < 0.0);
    one_sign && !beyond(|point| point.0) && !beyond(|point| point.1)
}

/// The mean of the taps along the longer side of the footprint.
pub(crate) fn filtered(texture: &Texture, uv: DVec2, per_pixel: [DVec2; 2], settings: &RenderSettings) -> Color {
    if settings.level_sampling.weighs_area() {
        return area_filters::filtered(texture, uv, per_pixel, settings);
    }
    let base = &texture.pyramid.levels()[0];
    let size = DVec2::new(f64::from(base.width()), f64::from(base.height()));
    let step = match settings.detail.derivatives {
        Derivatives::Pixel => 1.0,
        Derivatives::Sample => 1.0 / f64::from(settings.sample_rate.samples()).sqrt(),
    };
    let [right, down] = per_pixel.map(|side| side * step);
    let lengths = [right, down].map(|side| (side * size).length());
    let (along, long, short) = if lengths[0] > lengths[1] {
        (right, lengths[0], lengths[1])
    } else {
        (down, lengths[1], lengths[0])
    };
    let most = f64::from(settings.anisotropy.taps());
    let ratio = (long / short).min(most).min(long);
    let (taps, ratio) = if ratio > 1.001 {
        ((ratio - 0.001).ceil() as u32, ratio)
    } else {
        (1, 1.0)
    };
    let fixed = settings.detail.fixed.map(FixedLevel::level);
    let area = (right * size).perp_dot(down * size).abs();
    let computed = match settings.detail.extent {
        FootprintExtent::Area if taps == 1 => area.sqrt().log2(),
        FootprintExtent::Shorter if taps == 1 => least_step([right * size, down * size]).log2(),
        _ => (long / ratio).log2(),
    };
    let lod = fixed.unwrap_or(computed) + settings.detail.bias.levels();
    let mut sum = [0.0; 4];
    for tap in 1..=taps {
        let place = f64::from(tap) / f64::from(taps + 1) - 0.5;
        for (sum, channel) in sum.iter_mut().zip(tapped(texture, uv + along * place, lod, settings)) {
            *sum += channel / f64::from(taps);
        }
    }
    // What weights below zero bring is cut off once everything is added.
    let alpha = sum[3].clamp(0.0, 1.0);
    [
        sum[0].clamp(0.0, alpha),
        sum[1].clamp(0.0, alpha),
        sum[2].clamp(0.0, alpha),
        alpha,
    ]
}

/// The length of the shortest step of one pixel in any direction: the eigenvalue of the steps' Gram matrix.
fn least_step([right, down]: [DVec2; 2]) -> f64 {
    let (a, b, c) = (right.length_squared(), right.dot(down), down.length_squared());
    let spread = ((a - c) / 2.0).hypot(b);
    // The greater one is exact where the smaller one cancels.
    let greater = f64::midpoint(a, c) + spread;
    (a * c - b * b).max(0.0).sqrt() / greater.sqrt()
}

fn tapped(texture: &Texture, uv: DVec2, lod: f64, settings: &RenderSettings) -> Color {
    let levels = texture.pyramid_in(settings.pyramid, settings.pyramid_filter).levels();
    let last = levels.len() - 1;
    let lod = lod.clamp(0.0, last as f64);
    let read = |level: usize| {
        read_level(
            &levels[level.min(last)],
            uv,
            texture.asks.unwrap_or(settings.pixel_sampling),
            settings.texture_wrap,
        )
    };
    match settings.level_sampling {
        LevelSampling::Zero if settings.detail.fixed.is_none() => read(0),
        LevelSampling::Zero | LevelSampling::Nearest => read((lod + 0.5).floor() as usize),
        LevelSampling::Ewa | LevelSampling::SummedArea | LevelSampling::Ripmap => unreachable!("they weigh areas"),
        LevelSampling::Linear => {
            let (fine, coarse) = (read(lod.floor() as usize), read(lod.floor() as usize + 1));
            std::array::from_fn(|k| fine[k] * (1.0 - lod.fract()) + coarse[k] * lod.fract())
        }
    }
}

pub(super) fn read_level(level: &MipLevel, uv: DVec2, sampling: PixelSampling, wrap: Wrap) -> Color {
    // Copies of the texture side by side.
    let inside = |at: f64, side: u32| {
        let (at, side) = (at as i32, side.cast_signed());
        let (copy, within) = (at.div_euclid(side), at.rem_euclid(side));
        match wrap {
            Wrap::Clamp => at,
            Wrap::Repeat => within,
            Wrap::Mirror if copy % 2 == 0 => within,
            Wrap::Mirror => side - 1 - within,
        }
    };
    let texel = |x: f64, y: f64| {
        let texel = level.texel(inside(x, level.width()), inside(y, level.height()));
        texel.map(|byte| f64::from(byte) / 255.0)
    };
    let at = uv * DVec2::new(f64::from(level.width()), f64::from(level.height()));
    match sampling {
        PixelSampling::Nearest => texel(at.x.floor(), at.y.floor()),
        PixelSampling::CatmullRom | PixelSampling::BSpline | PixelSampling::Mitchell => {
            let corner = (at - 0.5).floor();
            let mut sum = [0.0; 4];
            for (dx, dy) in (0..16).map(|i| (f64::from(i % 4 - 1), f64::from(i / 4 - 1))) {
                let centre = corner + DVec2::new(dx, dy) + 0.5;
                let weight = cubic(sampling, at.x - centre.x) * cubic(sampling, at.y - centre.y);
                for (sum, channel) in sum.iter_mut().zip(texel(corner.x + dx, corner.y + dy)) {
                    *sum += channel * weight;
                }
            }
            sum
        }
        PixelSampling::Bilinear => {
            let corner = (at - 0.5).floor();
            let weight = at - 0.5 - corner;
            let mut sum = [0.0; 4];
            for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                let wx = if dx > 0.0 { weight.x } else { 1.0 - weight.x };
                let wy = if dy > 0.0 { weight.y } else { 1.0 - weight.y };
                for (sum, channel) in sum.iter_mut().zip(texel(corner.x + dx, corner.y + dy)) {
                    *sum += channel * wx * wy;
                }
            }
            sum
        }
    }
}

/// The kernels as their papers print them, each by itself: Keys with `a = -1/2`, the B-spline's blending function, and
/// Mitchell and Netravali's recommendation multiplied out.
fn cubic(sampling: PixelSampling, distance: f64) -> f64 {
    let x = distance.abs();
    let near = x < 1.0;
    match sampling {
        PixelSampling::CatmullRom if near => 1.5 * x.powi(3) - 2.5 * x.powi(2) + 1.0,
        PixelSampling::CatmullRom => -0.5 * x.powi(3) + 2.5 * x.powi(2) - 4.0 * x + 2.0,
        PixelSampling::BSpline if near => 0.5 * x.powi(3) - x.powi(2) + 2.0 / 3.0,
        PixelSampling::BSpline => (2.0 - x).powi(3) / 6.0,
        PixelSampling::Mitchell if near => (21.0 * x.powi(3) - 36.0 * x.powi(2) + 16.0) / 18.0,
        PixelSampling::Mitchell => (-7.0 * x.powi(3) + 36.0 * x.powi(2) - 60.0 * x + 32.0) / 18.0,
        PixelSampling::Nearest | PixelSampling::Bilinear => unreachable!("no cubic kernel"),
    }
}

pub(crate) fn premultiply(color: Rgba) -> Color {
    // A byte over 255 errs by 1e-6 of a level in 32 bits: enough for a mean that is a half to be none.
    let exact = |channel: f32| {
        let byte = (f64::from(channel) * 255.0).round();
        if channel == (byte / 255.0) as f32 {
            byte / 255.0
        } else {
            f64::from(channel)
        }
    };
    let [r, g, b, a] = [color.r, color.g, color.b, color.a].map(exact);
    [r * a, g * a, b * a, a]
}

/// Straight bytes, rounded to nearest.
fn to_pixel([r, g, b, a]: Color) -> u32 {
    // Sums err by 1e-13; filters' whole-number weights make means that lie 1e-10 below a half, and those are no ties.
    let byte = |channel: f64| (channel.clamp(0.0, 1.0) * 255.0 + 0.5 + 1e-11).floor() as u32;
    let straight = |channel: f64| if a > 0.0 { byte(channel / a) } else { 0 };
    byte(a) << 24 | straight(r) << 16 | straight(g) << 8 | straight(b)
}
