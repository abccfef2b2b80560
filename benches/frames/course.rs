//! Flat scenes side by side with a rasterizer as the course teaches it.
//!
//! The course's own solutions are C++ programs with windows, which cannot stand here; this is their method, written anew:
//! one thread; a colour of three floats for every sample of the frame; for every triangle all samples of its bounding
//! box, each put into three line equations; in the end the mean of each pixel's samples.

use glam::DVec2;
use rasterscope::color::Rgba;
use rasterscope::geometry::View;
use rasterscope::scene::{Fill, Paint, PrimitiveKind, Scene};

use crate::ours::{Ours, pool, settings};
use crate::race::{Budget, Rival, Timing, race};
use crate::scenes::FRAMES;
use crate::scenes::flat::{self, FlatScene};
use crate::table::{Row, ratio, say_times, times};

/// Samples along each side of a pixel.
const SIDE: u32 = 4;

/// A triangle in samples, and its straight colour.
struct Triangle {
    corners: [[f32; 2]; 3],
    color: [f32; 3],
    alpha: f32,
}

/// The course's rasterizer.
struct Course {
    triangles: Vec<Triangle>,
    /// Samples in a row, and rows of samples.
    size: [u32; 2],
    samples: Vec<[f32; 3]>,
    frame: Vec<[u8; 3]>,
}

impl Course {
    /// Cuts the polygons into triangles, which is not timed.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the course's coordinates are 32-bit floats"
    )]
    fn new(read: &Scene, size: [u32; 2]) -> Self {
        let view = View::Canvas.transform(read.canvas, size);
        let placed = |corners: &[DVec2; 3], color: Rgba| Triangle {
            corners: corners.map(|corner| {
                let at = view.to_pixels(corner) * f64::from(SIDE);
                [at.x as f32, at.y as f32]
            }),
            color: [color.r, color.g, color.b],
            alpha: color.a,
        };
        let mut triangles = Vec::new();
        for primitive in &read.primitives {
            match &primitive.kind {
                PrimitiveKind::Polygon {
                    polygon,
                    fill: Fill::Solid(color),
                } => {
                    let corners = polygon.triangles().unwrap_or_default();
                    triangles.extend(corners.iter().map(|corners| placed(corners, *color)));
                }
                PrimitiveKind::Triangle {
                    points,
                    paint: Paint::Solid(color),
                } => triangles.push(placed(points, *color)),
                other => unreachable!("a scene of polygons: {other:?}"),
            }
        }
        let samples = size.map(|side| side * SIDE);
        Self {
            triangles,
            size: samples,
            samples: vec![[1.0; 3]; samples[0] as usize * samples[1] as usize],
            frame: vec![[0; 3]; size[0] as usize * size[1] as usize],
        }
    }

    fn draw(&mut self) {
        self.samples.fill([1.0; 3]);
        for triangle in &self.triangles {
            fill(triangle, self.size, &mut self.samples);
        }
        self.resolve();
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the course truncates colours of 0 to 1"
    )]
    fn resolve(&mut self) {
        let (width, side) = (self.size[0] as usize, SIDE as usize);
        let rows = self.samples.chunks_exact(width * side);
        for (pixels, rows) in self.frame.chunks_exact_mut(width / side).zip(rows) {
            for (x, pixel) in pixels.iter_mut().enumerate() {
                let mut sum = [0.0; 3];
                for row in rows.chunks_exact(width) {
                    for sample in &row[x * side..(x + 1) * side] {
                        for (sum, value) in sum.iter_mut().zip(sample) {
                            *sum += value;
                        }
                    }
                }
                *pixel = sum.map(|sum: f32| (sum / (SIDE * SIDE) as f32 * 255.0) as u8);
            }
        }
    }
}

/// Looks at every sample of the bounding box.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cut to the frame, negative numbers to 0"
)]
fn fill(triangle: &Triangle, size: [u32; 2], samples: &mut [[f32; 3]]) {
    let [a, b, c] = triangle.corners;
    let span = |axis: usize| {
        let [a, b, c] = [a[axis], b[axis], c[axis]];
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        least as usize..(most.ceil() as usize).min(size[axis] as usize)
    };
    let edges = [[a, b], [b, c], [c, a]];
    for y in span(1) {
        let row = &mut samples[y * size[0] as usize..][..size[0] as usize];
        for x in span(0) {
            let at = [x as f32 + 0.5, y as f32 + 0.5];
            let sides =
                edges.map(|[from, to]| (at[1] - from[1]) * (to[0] - from[0]) - (at[0] - from[0]) * (to[1] - from[1]));
            if sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0) {
                for (value, color) in row[x].iter_mut().zip(triangle.color) {
                    *value += (color - *value) * triangle.alpha;
                }
            }
        }
    }
}

/// How far our picture is from the course's, in steps of a byte, as mean over all channels.
fn distance(ours: &Ours<'_>, course: &Course) -> f64 {
    let channels = |pixel: &u32| {
        let [_, r, g, b] = pixel.to_be_bytes();
        [r, g, b]
    };
    let pairs = ours.frame().pixels().iter().map(channels).zip(&course.frame);
    let sum: u64 = pairs
        .flat_map(|(ours, theirs)| [0, 1, 2].map(|i| u64::from(ours[i].abs_diff(theirs[i]))))
        .sum();
    sum as f64 / (3 * course.frame.len()) as f64
}

fn race_on(scene: &FlatScene, size: [u32; 2], budget: Budget) -> Vec<Timing> {
    let read = scene.read();
    let mut ours = Ours::new(&read, size, settings(SIDE * SIDE), pool(2));
    let mut course = Course::new(&read, size);
    let timings = race(
        &mut [
            Rival::new(|| {
                ours.draw();
            }),
            Rival::new(|| course.draw()),
        ],
        budget,
    );
    let distance = distance(&ours, &course);
    assert!(distance < 1.0, "{}: {distance} from the course's picture", scene.name);
    say_times(scene.name, size, &["ours@16", "course@16"], &timings);
    timings
}

/// The row of the course.
pub(crate) fn course(budget: Budget) -> Vec<Row> {
    let mut columns = [Vec::new(), Vec::new()];
    for size in FRAMES {
        for scene in flat::all(size) {
            for (column, timing) in columns.iter_mut().zip(race_on(&scene, size, budget)) {
                column.push(timing);
            }
        }
    }
    vec![Row {
        work: "flat scenes, rate 16, against a rasterizer as the course teaches it",
        must: "100x as fast",
        aim: "",
        here: times(ratio(&columns[1], &columns[0])),
        part: "course",
    }]
}
