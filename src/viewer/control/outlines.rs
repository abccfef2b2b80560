//! The contours of shapes over the picture.

use crate::scene::PrimitiveKind;
use crate::viewer::control::both::Both;

/// Most points of an outline that are drawn over the picture.
const MOST_POINTS: usize = 20_000;

impl Both<'_> {
    /// The contours of a primitive of the frame on the screen, in window pixels; closed, but for a line of two points. Of two
    /// pictures side by side they lie over the first.
    pub fn outline_of(&self, primitive: u32) -> Vec<Vec<[f64; 2]>> {
        let Some(frame) = self.frames.frame() else {
            return Vec::new();
        };
        let picture = &frame.picture;
        let Some(primitive) = picture.scene.primitives.get(primitive as usize) else {
            return Vec::new();
        };
        let zoom = f64::from(self.layout.zoom());
        let [left, top] = self.layout.panes().first.corner;
        let corner = glam::DVec2::new(left as f64, top as f64);
        let place = |points: &[glam::DVec2]| -> Vec<[f64; 2]> {
            let points = points.iter().take(MOST_POINTS);
            points
                .map(|point| ((picture.view.to_pixels(*point) + corner) * zoom).to_array())
                .collect()
        };
        match &primitive.kind {
            PrimitiveKind::Triangle { points, .. } => vec![place(points)],
            PrimitiveKind::Polygon { polygon, .. } => {
                let mut room = MOST_POINTS;
                let fits = |contour: &&[glam::DVec2]| {
                    let fits = contour.len() <= room;
                    room = room.saturating_sub(contour.len());
                    fits
                };
                polygon.contours().take_while(fits).map(place).collect()
            }
            PrimitiveKind::Hairline { ends, .. } => vec![place(ends)],
            PrimitiveKind::Point { at, .. } => {
                let [x, y] = (picture.view.to_pixels(*at).floor() + corner).to_array();
                let corner = |dx: f64, dy: f64| [(x + dx) * zoom, (y + dy) * zoom];
                vec![vec![
                    corner(0.0, 0.0),
                    corner(1.0, 0.0),
                    corner(1.0, 1.0),
                    corner(0.0, 1.0),
                ]]
            }
            PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => Vec::new(),
        }
    }
}
