//! Another renderer, as a student might write it: triangle by triangle into a buffer of samples, in floats, without the
//! engine's snapping, tiles or spans. It makes mistakes on request, and does what other renderers do.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small pictures in plain arithmetic"
)]

use glam::{DAffine2, DVec2};
use rasterscope::color::ResolveSpace;
use rasterscope::geometry::{FillRule, Polygon, ViewTransform};
use rasterscope::post::PostProcess;
use rasterscope::raster::{Framebuffer, PixelCoverage, ShadingRate};
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;
use rasterscope::scene::{Fill, Paint, PrimitiveKind, Scene};
use rasterscope::texture::Texture;

use super::brute_force::{Color, filtered, hairline, premultiply, to_light, to_stored};
use super::smaa::Picture;

/// What it does otherwise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foreign {
    /// Where a sample lies in its cell, along both axes.
    pub(crate) at: f64,
    /// Samples along a side of a pixel.
    pub(crate) side: u32,
    /// Everything is drawn so many pixels further to the right and down.
    pub(crate) shift: [f64; 2],
    pub(crate) truncates: bool,
    /// In which values samples are averaged.
    pub(crate) resolve: ResolveSpace,
    /// Reads textures upside down.
    pub(crate) flips_v: bool,
    /// By the course's, edges belong to everybody, samples are truncated, texels are addressed by `w - 1`.
    pub(crate) rules: Rules,
    /// Colours are those of the pixel's centre, wherever samples lie.
    pub(crate) shading: ShadingRate,
    /// By exact areas, shapes are blended by the part of a pixel that they cover, in the colour of its centre.
    pub(crate) coverage: PixelCoverage,
    /// What is done to finished pixels.
    pub(crate) post_process: PostProcess,
    /// How textures are read.
    pub(crate) reads: RenderSettings,
}

/// Samples, row by row.
struct Samples {
    width: i64,
    height: i64,
    colors: Vec<Color>,
}

impl Foreign {
    /// One that does as `settings` say.
    pub(crate) fn new(settings: RenderSettings) -> Self {
        Self {
            at: 0.5,
            side: settings.sample_rate.side(),
            shift: [0.0; 2],
            truncates: false,
            resolve: ResolveSpace::Stored,
            flips_v: false,
            rules: Rules::Standard,
            shading: ShadingRate::Sample,
            coverage: PixelCoverage::Sampled,
            post_process: PostProcess::None,
            reads: settings,
        }
    }

    fn is_course(&self) -> bool {
        self.rules == Rules::Course
    }

    fn is_linear(&self) -> bool {
        self.resolve == ResolveSpace::Linear
    }

    /// Draws a scene without layers on white.
    pub(crate) fn draw(&self, scene: &Scene, view: &ViewTransform, [width, height]: [u32; 2]) -> Framebuffer {
        let to_pixels = DAffine2::from_translation(DVec2::from(self.shift)) * view.scene_to_pixels;
        let place = |point: DVec2| {
            let exact = to_pixels.transform_point2(point);
            if self.is_course() {
                exact.as_vec2().as_dvec2()
            } else {
                exact
            }
        };
        assert!(
            !self.coverage.is_exact() || self.side == 1,
            "an area is that of a pixel"
        );
        let side = i64::from(self.side);
        let (columns, rows) = (i64::from(width) * side, i64::from(height) * side);
        let mut samples = Samples {
            width: columns,
            height: rows,
            colors: vec![[1.0; 4]; usize::try_from(columns * rows).expect("a small picture")],
        };
        for primitive in &scene.primitives {
            match &primitive.kind {
                PrimitiveKind::Triangle { points, paint } => {
                    self.triangle(&mut samples, points.map(place), |weights, corners| match paint {
                        Paint::Solid(color) => premultiply(*color),
                        Paint::Vertex(colors) => {
                            let all = colors.map(|color| [color.r, color.g, color.b, color.a].map(f64::from));
                            let [r, g, b, a] = mixed(weights, all);
                            [r * a, g * a, b * a, a]
                        }
                        Paint::Texture { texture, uv, opacity } => {
                            let uv = uv.map(|uv| DVec2::new(f64::from(uv.x), f64::from(uv.y)));
                            let color = self.texel(&scene.textures[texture.0 as usize], (weights, corners), uv);
                            color.map(|channel| channel * f64::from(*opacity))
                        }
                    });
                }
                PrimitiveKind::Polygon {
                    polygon,
                    fill: Fill::Solid(color),
                } if self.is_course() => {
                    for points in polygon.triangles().expect("a plain polygon") {
                        self.triangle(&mut samples, points.map(place), |_, _| premultiply(*color));
                    }
                }
                PrimitiveKind::Polygon {
                    polygon,
                    fill: Fill::Solid(color),
                } => {
                    let color = premultiply(*color);
                    let points: Vec<DVec2> = polygon.points().iter().map(|point| place(*point)).collect();
                    self.each(&mut samples, &points, |at| {
                        encloses(polygon, &place, at).then_some(color)
                    });
                }
                PrimitiveKind::Hairline { ends, color } => {
                    for pixel in hairline(ends.map(place)) {
                        self.pixel(&mut samples, pixel, premultiply(*color));
                    }
                }
                PrimitiveKind::Point { at, color } => {
                    let at = place(*at).floor();
                    self.pixel(&mut samples, (at.x as i64, at.y as i64), premultiply(*color));
                }
                PrimitiveKind::Polygon { fill, .. } => panic!("no {fill:?} here"),
                PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => panic!("no layers here"),
            }
        }
        self.resolve(&samples, [width, height])
    }

    fn triangle(&self, samples: &mut Samples, corners: [DVec2; 3], color: impl Fn([f64; 3], [DVec2; 3]) -> Color) {
        let [a, b, c] = corners;
        let area = (b - a).perp_dot(c - a);
        if area == 0.0 {
            return;
        }
        self.each(samples, &corners, |at| {
            let edges = [(b, c), (c, a), (a, b)];
            let weights_at = |at: DVec2| edges.map(|(from, to)| (to - from).perp_dot(at - from) / area);
            for (from, to) in edges {
                let edge = (to - from) * area.signum();
                let value = (to - from).perp_dot(at - from) * area.signum();
                let owns = self.is_course() || edge.y < 0.0 || (edge.y == 0.0 && edge.x > 0.0);
                if value < 0.0 || (value == 0.0 && !owns) {
                    return None;
                }
            }
            let is_once = self.shading.is_once() || self.coverage.is_exact();
            let shaded = if is_once { at.floor() + 0.5 } else { at };
            Some(color(weights_at(shaded), corners))
        });
    }

    /// Blends a colour into each sample around some points that has one.
    fn each(&self, samples: &mut Samples, points: &[DVec2], color: impl Fn(DVec2) -> Option<Color>) {
        let side = f64::from(self.side);
        let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min) * side - 2.0;
        let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max) * side + 2.0;
        for j in (low.y.floor() as i64).max(0)..(high.y.ceil() as i64).min(samples.height) {
            for i in (low.x.floor() as i64).max(0)..(high.x.ceil() as i64).min(samples.width) {
                let at = |x: f64, y: f64| DVec2::new(i as f64 + x, j as f64 + y) / side;
                if self.coverage.is_exact() {
                    const PARTS: u32 = 16;
                    let place = |k: u32| (f64::from(k) + 0.5) / f64::from(PARTS);
                    let places = (0..PARTS).flat_map(|y| (0..PARTS).map(move |x| at(place(x), place(y))));
                    let covered: Vec<Color> = places.filter_map(&color).collect();
                    if let Some(color) = covered.first() {
                        let part = covered.len() as f64 / f64::from(PARTS * PARTS);
                        self.blend(samples, [i, j], color.map(|channel| channel * part));
                    }
                } else if let Some(color) = color(at(self.at, self.at)) {
                    self.blend(samples, [i, j], color);
                }
            }
        }
    }

    /// Fills all samples of a pixel.
    fn pixel(&self, samples: &mut Samples, (x, y): (i64, i64), color: Color) {
        let side = i64::from(self.side);
        for (i, j) in (0..side).flat_map(|j| (0..side).map(move |i| (i, j))) {
            let at = [x * side + i, y * side + j];
            if x >= 0 && y >= 0 && at[0] < samples.width && at[1] < samples.height {
                self.blend(samples, at, color);
            }
        }
    }

    fn blend(&self, samples: &mut Samples, [i, j]: [i64; 2], above: Color) {
        let below = &mut samples.colors[(j * samples.width + i) as usize];
        *below = std::array::from_fn(|k| above[k] + below[k] * (1.0 - above[3]));
        if self.is_course() {
            *below = below.map(|channel| (channel * 255.0 + 1e-9).floor() / 255.0);
        }
    }

    fn texel(&self, texture: &Texture, (weights, corners): ([f64; 3], [DVec2; 3]), uv: [DVec2; 3]) -> Color {
        let uv = uv.map(|uv| DVec2::new(uv.x, if self.flips_v { 1.0 - uv.y } else { uv.y }));
        let here = uv[0] * weights[0] + uv[1] * weights[1] + uv[2] * weights[2];
        if self.is_course() {
            let level = &texture.pyramid.levels()[0];
            let size = DVec2::new(f64::from(level.width()), f64::from(level.height()));
            let at = (here * (size - 1.0)).round();
            return level
                .texel(at.x as i32, at.y as i32)
                .map(|byte| f64::from(byte) / 255.0);
        }
        let [a, b, c] = corners;
        let area = (b - a).perp_dot(c - a);
        let per = |gradient: fn(DVec2) -> f64| {
            (uv[0] * gradient(c - b) + uv[1] * gradient(a - c) + uv[2] * gradient(b - a)) / area
        };
        filtered(texture, here, [per(|edge| -edge.y), per(|edge| edge.x)], &self.reads)
    }

    fn resolve(&self, samples: &Samples, [width, height]: [u32; 2]) -> Framebuffer {
        let mut frame = Framebuffer::new(width, height);
        let side = self.side as usize;
        let half = if self.truncates || self.is_course() {
            1e-9
        } else {
            0.5 + 1e-9
        };
        for (index, pixel) in frame.pixels_mut().iter_mut().enumerate() {
            let (x, y) = (index % width as usize * side, index / width as usize * side);
            let mut sum = [0.0; 3];
            for (i, j) in (0..side).flat_map(|j| (0..side).map(move |i| (i, j))) {
                let color = samples.colors[(y + j) * samples.width as usize + x + i];
                for (sum, channel) in sum.iter_mut().zip(color) {
                    *sum += if self.is_linear() { to_light(channel) } else { channel };
                }
            }
            let bytes = sum.map(|sum| {
                let mean = sum / (side * side) as f64;
                let mean = if self.is_linear() { to_stored(mean) } else { mean };
                (mean * 255.0 + half).floor() as u8
            });
            *pixel = u32::from_be_bytes([255, bytes[0], bytes[1], bytes[2]]);
        }
        if self.post_process == PostProcess::Smaa {
            self.smooth(&mut frame);
        }
        frame
    }

    fn smooth(&self, frame: &mut Framebuffer) {
        let size = [frame.width(), frame.height()].map(u32::cast_signed);
        let straight = |pixel: &u32| {
            let [a, r, g, b] = pixel.to_be_bytes();
            [r, g, b, a]
        };
        let picture = Picture {
            size,
            pixels: frame.pixels().iter().map(straight).collect(),
        };
        let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
        for (pixel, [x, y]) in frame.pixels_mut().iter_mut().zip(places) {
            let [r, g, b, a] = picture.smoothed(x, y, self.resolve)[0].map(|channel| (channel + 0.5).floor() as u8);
            *pixel = u32::from_be_bytes([a, r, g, b]);
        }
    }
}

fn mixed(weights: [f64; 3], colors: [Color; 3]) -> Color {
    std::array::from_fn(|k| (0..3).map(|i| weights[i] * colors[i][k]).sum())
}

/// Whether contours wind around a point.
fn encloses(polygon: &Polygon, place: &impl Fn(DVec2) -> DVec2, at: DVec2) -> bool {
    let mut winding = 0;
    for contour in polygon.contours() {
        for (from, to) in contour.iter().zip(contour.iter().cycle().skip(1)) {
            let (from, to) = (place(*from), place(*to));
            let (top, bottom, around) = if from.y < to.y { (from, to, 1) } else { (to, from, -1) };
            let left = (bottom - top).perp_dot(at - top) <= 0.0;
            if top.y <= at.y && at.y < bottom.y && left {
                winding += around;
            }
        }
    }
    match polygon.rule() {
        FillRule::NonZero => winding != 0,
        FillRule::EvenOdd => winding % 2 != 0,
    }
}
