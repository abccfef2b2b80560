//! How a box of content fits a box of the picture: `viewBox` and `preserveAspectRatio`, of the document and of images.

use glam::{DAffine2, DVec2};
use svgtypes::{Align, AspectRatio};

/// A box: its corner with the smallest coordinates, and its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) corner: DVec2,
    pub(super) size: DVec2,
}

/// Centred and wholly visible: what SVG does where nothing is said.
pub(super) const DEFAULT_ASPECT: AspectRatio = AspectRatio {
    defer: false,
    align: Align::XMidYMid,
    slice: false,
};

impl Frame {
    /// From the text of a `viewBox`; `None` unless both sides are above zero.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let view_box: svgtypes::ViewBox = text.parse().ok()?;
        let frame = Self {
            corner: DVec2::new(view_box.x, view_box.y),
            size: DVec2::new(view_box.w, view_box.h),
        };
        let finite = [frame.corner, frame.size]
            .iter()
            .all(|v| v.abs().max_element() <= f64::from(f32::MAX));
        Some(frame).filter(|frame| finite && frame.size.min_element() > 0.0)
    }

    /// The map that brings `content` into this frame.
    pub(super) fn fit(self, content: Self, aspect: AspectRatio) -> DAffine2 {
        let stretch = self.size / content.size;
        let scale = match aspect {
            AspectRatio { align: Align::None, .. } => stretch,
            AspectRatio { slice: true, .. } => DVec2::splat(stretch.max_element()),
            AspectRatio { slice: false, .. } => DVec2::splat(stretch.min_element()),
        };
        let left_over = self.size - content.size * scale;
        let corner = self.corner + left_over * share(aspect.align) - content.corner * scale;
        DAffine2::from_scale_angle_translation(scale, 0.0, corner)
    }

    /// What two frames have in common.
    pub(super) fn intersection(self, other: Self) -> Self {
        let corner = self.corner.max(other.corner);
        let far = (self.corner + self.size).min(other.corner + other.size);
        Self {
            corner,
            size: (far - corner).max(DVec2::ZERO),
        }
    }

    /// The map from the unit square to this frame.
    pub(super) fn unit_map(self) -> DAffine2 {
        DAffine2::from_scale_angle_translation(self.size, 0.0, self.corner)
    }
}

/// Which share of the room left over lies left of and above the content.
fn share(align: Align) -> DVec2 {
    let (x, y) = match align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    };
    DVec2::new(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(x: f64, y: f64, width: f64, height: f64) -> Frame {
        Frame {
            corner: DVec2::new(x, y),
            size: DVec2::new(width, height),
        }
    }

    #[test]
    fn fit_by_aspect() {
        let content = frame(10.0, 20.0, 100.0, 50.0);
        let port = frame(1.0, 2.0, 200.0, 200.0);
        for (aspect, corner, far) in [
            ("xMidYMid meet", [1.0, 52.0], [201.0, 152.0]),
            ("xMinYMin", [1.0, 2.0], [201.0, 102.0]),
            ("xMaxYMax", [1.0, 102.0], [201.0, 202.0]),
            ("xMinYMin slice", [1.0, 2.0], [401.0, 202.0]),
            ("xMaxYMin slice", [-199.0, 2.0], [201.0, 202.0]),
            ("none", [1.0, 2.0], [201.0, 202.0]),
        ] {
            let map = port.fit(content, aspect.parse().expect(aspect));
            assert_eq!(
                map.transform_point2(content.corner),
                DVec2::from(corner),
                "{aspect}: corner"
            );
            assert_eq!(
                map.transform_point2(content.corner + content.size),
                DVec2::from(far),
                "{aspect}: far corner"
            );
        }
    }

    #[test]
    fn frame_needs_an_area() {
        assert_eq!(
            Frame::parse("1, 2 3,4"),
            Some(frame(1.0, 2.0, 3.0, 4.0)),
            "any separators"
        );
        for text in ["", "1 2 3", "0 0 0 1", "0 0 1 -1", "0 0 1e39 1", "0 0 nan 1"] {
            assert_eq!(Frame::parse(text), None, "{text:?}");
        }
    }
}
