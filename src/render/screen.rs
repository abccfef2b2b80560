//! From user space to screen space: where corners lie, by whose rules, and how fine curves have to be.

use glam::DVec2;

use super::RenderSettings;
use crate::geometry::{Polygon, ViewTransform};
use crate::rules::Rules;

/// For how many samples along a side of a pixel curves are fine enough where areas are covered. An edge lies on one side of its
/// curve, at most a tenth of the distance between them, and so takes two thirds of that from a pixel: over its diagonal
/// `255 * sqrt(2) * 2/3 * 0.1 / 512`, less than a twentieth of a level.
const FOR_AREAS: f64 = 512.0;

/// For how many samples along a side of a pixel curves are fine enough.
fn samples_along_side(settings: &RenderSettings) -> f64 {
    if settings.covers_areas() {
        FOR_AREAS
    } else {
        settings.sample_rate.side().into()
    }
}

/// User space to screen space, by whose rules.
pub(super) struct Screen<'a> {
    view: &'a ViewTransform,
    pub(super) rules: Rules,
    covers_areas: bool,
    /// Samples per canvas unit, in the direction in which there are most.
    scale: f64,
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
            scale: pixels_per_unit(view) * samples_along_side(settings),
            size,
            margin: settings.margin(),
        }
    }

    /// Calls `draw` with a polygon whose edges are fine enough for this view.
    pub(super) fn with_edges<T>(&self, polygon: &Polygon, draw: impl FnOnce(&Polygon) -> T) -> T {
        let finer = if polygon.curves().is_some() && self.shows(polygon) {
            polygon.at_scale(self.scale)
        } else {
            None
        };
        draw(finer.as_deref().unwrap_or(polygon))
    }

    /// The same with edges so much finer that the area in a pixel is known to three digits; those of many points stay the
    /// picture's, and so do those of a picture that covers areas, which are finer still.
    pub(super) fn with_true_edges<T>(&self, polygon: &Polygon, measure: impl FnOnce(&Polygon) -> T) -> T {
        /// Of a pixel's side.
        const TOLERANCE: f64 = 5e-4;
        /// They become several times as many, and are cut into triangles.
        const MOST_POINTS: usize = 2_000;
        let is_coarse = !self.covers_areas && polygon.points().len() <= MOST_POINTS;
        match polygon.curves().filter(|_| is_coarse) {
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
