//! From user space to screen space: where corners lie, by whose rules, and how fine curves have to be.

use glam::DVec2;

use super::RenderSettings;
use crate::geometry::{Polygon, ViewTransform};
use crate::rules::Rules;

/// User space to screen space, by whose rules.
pub(super) struct Screen<'a> {
    view: &'a ViewTransform,
    pub(super) rules: Rules,
    covers_areas: bool,
    /// Pixels per canvas unit, in the direction in which there are most.
    scale: f64,
    samples_along_side: f64,
    /// Pixels of the frame.
    size: [u32; 2],
    /// Pixels that are painted on each side of it.
    margin: f64,
}

impl<'a> Screen<'a> {
    pub(super) fn new(view: &'a ViewTransform, settings: &RenderSettings, size: [u32; 2]) -> Self {
        Self {
            view,
            rules: settings.rules,
            covers_areas: settings.covers_areas(),
            scale: pixels_per_unit(view),
            samples_along_side: settings.sample_rate.side().into(),
            size,
            margin: settings.margin(),
        }
    }

    /// Calls `draw` with a polygon whose edges are fine enough for this view.
    pub(super) fn with_edges<T>(&self, polygon: &Polygon, draw: impl FnOnce(&Polygon) -> T) -> T {
        let finer = if polygon.curves().is_none() || !self.shows(polygon) {
            None
        } else if self.covers_areas {
            polygon.of_same_area(self.scale)
        } else {
            polygon.at_scale(self.scale * self.samples_along_side)
        };
        draw(finer.as_deref().unwrap_or(polygon))
    }

    /// The same with edges so much finer that the area in a pixel is known to three digits; those of many points stay the
    /// picture's.
    pub(super) fn with_true_edges<T>(&self, polygon: &Polygon, measure: impl FnOnce(&Polygon) -> T) -> T {
        /// They are cut into triangles.
        const MOST_POINTS: usize = 2_000;
        if self.covers_areas || polygon.points().len() > MOST_POINTS {
            return self.with_edges(polygon, measure);
        }
        measure(polygon.of_same_area(self.scale).as_deref().unwrap_or(polygon))
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

    pub(super) fn place(&self, point: DVec2) -> DVec2 {
        let exact = self.view.to_pixels(point);
        match self.rules {
            Rules::Standard => exact,
            Rules::Course | Rules::Float => exact.as_vec2().as_dvec2(),
        }
    }

    /// The four hairlines just outside the canvas, as the course draws them.
    pub(super) fn outline(&self, canvas: DVec2) -> [[DVec2; 2]; 4] {
        let corner = |x: f64, y: f64, dx: f64, dy: f64| self.place(DVec2::new(x, y)) + DVec2::new(dx, dy);
        let a = corner(0.0, 0.0, -1.0, 1.0);
        let b = corner(canvas.x, 0.0, 1.0, 1.0);
        let c = corner(0.0, canvas.y, -1.0, -1.0);
        let d = corner(canvas.x, canvas.y, 1.0, -1.0);
        [[a, b], [a, c], [d, b], [d, c]]
    }
}

/// Pixels per canvas unit, in the direction in which there are most.
fn pixels_per_unit(view: &ViewTransform) -> f64 {
    let matrix = view.scene_to_pixels.matrix2;
    matrix.x_axis.length().max(matrix.y_axis.length())
}
