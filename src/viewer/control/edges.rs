//! Pixels that an edge makes wrong: what a newcomer is shown first.

use glam::DVec2;

use crate::render::{Nearby, RenderSettings, Subject};
use crate::viewer::control::both::Both;
use crate::viewer::view::pointer::window_pixel;

/// Levels by which two pixels differ at least where two colours meet.
const EDGE: u8 = 48;
/// Levels from the truth above which nobody takes a pixel for right.
const WRONG: u8 = 24;
/// Pixels at edges that are compared with the truth, which takes some milliseconds each in a large scene.
const MOST_EDGES: usize = 40;

impl Both<'_> {
    /// A pixel near the middle of the free picture that an edge makes wrong; where none is, one that an edge goes through, one
    /// that differs from a neighbour, or the one in the middle.
    pub(in crate::viewer) fn edge(&self) -> [i64; 2] {
        let [corner, size] = self.layout.free_part();
        let middle = corner + size / 2.0;
        let edges = self.edges_near(middle, [corner, corner + size]);
        let wrong = edges.iter().find(|pixel| self.is_wrong(**pixel));
        let mixed = || edges.iter().find(|pixel| self.is_mixed(**pixel));
        let edge = wrong.or_else(mixed).or(edges.first());
        edge.map_or_else(|| window_pixel(middle), |edge| edge.map(i64::from))
    }

    /// Pixels on both sides of where neighbours differ, in a part of the frame given by two corners: some of those next to
    /// `middle`, the nearest first.
    fn edges_near(&self, middle: DVec2, [low, high]: [DVec2; 2]) -> Vec<[u32; 2]> {
        let Some(frame) = self.frames.frame() else {
            return Vec::new();
        };
        let inside = |[x, y]: [u32; 2]| {
            let at = DVec2::new(f64::from(x), f64::from(y));
            at.cmpge(low).all() && at.cmplt(high).all()
        };
        let differ = |[x, y]: [u32; 2], [u, v]: [u32; 2]| {
            let colors = frame.final_rgba(x, y).zip(frame.final_rgba(u, v));
            colors.is_some_and(|(a, b)| a.iter().zip(b).any(|(a, b)| a.abs_diff(b) >= EDGE))
        };
        let (width, height) = (frame.pixels.width(), frame.pixels.height());
        let mut edges: Vec<[u32; 2]> = (0..height)
            .flat_map(|y| (0..width).map(move |x| [x, y]))
            .flat_map(|[x, y]| [[x + 1, y], [x, y + 1]].map(|beside| [[x, y], beside]))
            .filter(|&[pixel, beside]| inside(pixel) && inside(beside) && differ(pixel, beside))
            .flatten()
            .collect();
        let distance = |[x, y]: [u32; 2]| DVec2::new(f64::from(x), f64::from(y)).distance_squared(middle);
        edges.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)).then(a.cmp(b)));
        edges.dedup();
        edges.truncate(MOST_EDGES);
        edges
    }

    /// Whether a pixel has another colour than the two beside it, or than those above and below: an edge that samples
    /// resolve goes through it.
    fn is_mixed(&self, [x, y]: [u32; 2]) -> bool {
        let Some(frame) = self.frames.frame() else { return false };
        let beside = |dx: i64, dy: i64| {
            let [x, y] = [i64::from(x) + dx, i64::from(y) + dy].map(|at| u32::try_from(at).ok());
            frame.final_rgba(x?, y?)
        };
        let own = beside(0, 0);
        let differs = |other: Option<[u8; 4]>| other.is_some() && other != own;
        let between = |[dx, dy]: [i64; 2]| differs(beside(dx, dy)) && differs(beside(-dx, -dy));
        between([1, 0]) || between([0, 1])
    }

    /// Whether a pixel is as far from the truth as can be seen.
    fn is_wrong(&self, [x, y]: [u32; 2]) -> bool {
        let (Some(entry), Some(context), Some(frame)) =
            (self.scene_list.current(), self.view_context(), self.frames.frame())
        else {
            return false;
        };
        let Some(scene) = entry.scene() else { return false };
        let view = entry.camera.transform(&context);
        let settings = &self.settings.render;
        let subject = Subject {
            scene,
            view: &view,
            settings,
        };
        let truth = RenderSettings {
            resolve: settings.resolve,
            ..settings.truth()
        };
        let color = frame.final_rgba(x, y);
        let true_color = Nearby::new(&subject, context.frame, [x, y]).pixel(&truth);
        color.zip(true_color).is_some_and(|([r, g, b, a], truth)| {
            let apart = |(a, b): (u8, u8)| a.abs_diff(b) >= WRONG;
            [a, r, g, b].into_iter().zip(truth.to_be_bytes()).any(apart)
        })
    }
}
