//! Where the scene lies on the screen: the named views, and the map from user space to pixels.

use std::fmt;

use glam::{DAffine2, DMat2, DVec2};

/// Margin of the default view: the window's shorter side shows this many times the canvas's longer side.
const DEFAULT_MARGIN: f64 = 1.2;

/// A view as a user asks for it, independent of the frame's size.
///
/// ```
/// use rasterscope::View;
/// use rasterscope::glam::DVec2;
///
/// // Two pixels per canvas unit around a point of the scene.
/// let view = View::At {
///     center: DVec2::new(500.0, 375.0),
///     scale: 2.0,
///     rotation: 0.0,
/// };
/// # assert_ne!(view, View::Default);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum View {
    /// The course's: canvas centred, 1.2 times its longer side spans the shorter side of the frame.
    #[default]
    Default,
    /// The canvas exactly fills the frame, no outline. The aspect ratio gives way where it must.
    Canvas,
    /// A free view.
    At {
        /// The user-space point in the centre of the frame.
        center: DVec2,
        /// Pixels per canvas unit, above zero.
        scale: f64,
        /// Clockwise on the screen, in degrees.
        rotation: f64,
    },
}

/// A place in canvas units with as many digits as tell hundredths of a pixel apart, where a unit has `scale` pixels.
pub fn rounded_place(place: DVec2, scale: f64) -> DVec2 {
    let digits = (scale.abs() * 100.0).log10().ceil();
    DVec2::new(rounded(place.x, digits), rounded(place.y, digits))
}

/// A number with so many digits behind its point.
fn rounded(number: f64, digits: f64) -> f64 {
    let power = 10.0_f64.powf(digits.clamp(0.0, 12.0));
    let rounded = (number * power).round() / power;
    if rounded.is_finite() { rounded } else { number }
}

/// As `--view` takes it, to the last digit.
impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Default => f.write_str("default"),
            Self::Canvas => f.write_str("canvas"),
            Self::At {
                center,
                scale,
                rotation,
            } => {
                write!(f, "{},{},{scale}", center.x, center.y)?;
                if *rotation != 0.0 {
                    write!(f, ",{rotation}")?;
                }
                Ok(())
            }
        }
    }
}

impl View {
    /// The map to pixels for a canvas of `canvas` canvas units in a frame of `size` pixels.
    pub fn transform(self, canvas: DVec2, size: [u32; 2]) -> ViewTransform {
        let frame = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        match self {
            Self::Default => {
                let scale = Self::default_scale(canvas, size);
                ViewTransform::around(canvas / 2.0, scale, 0.0, frame)
            }
            Self::Canvas => ViewTransform {
                scene_to_pixels: DAffine2::from_scale(frame / canvas),
            },
            Self::At {
                center,
                scale,
                rotation,
            } => ViewTransform::around(center, scale, rotation, frame),
        }
    }

    /// The same view with no more digits than can be seen: a hundredth of a pixel.
    #[must_use]
    pub fn rounded(self) -> Self {
        match self {
            Self::At {
                center,
                scale,
                rotation,
            } => Self::At {
                center: rounded_place(center, scale),
                // A millionth of it moves nothing by a hundredth in a frame of ten thousand pixels.
                scale: rounded(scale, 6.0 - scale.abs().log10().ceil()),
                rotation: rounded(rotation, 4.0),
            },
            named => named,
        }
    }

    /// Pixels per canvas unit of the default view.
    pub fn default_scale(canvas: DVec2, size: [u32; 2]) -> f64 {
        f64::from(size[0].min(size[1])) / (DEFAULT_MARGIN * canvas.max_element())
    }
}

/// The affine map from user space to screen space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewTransform {
    /// User space to pixels.
    pub scene_to_pixels: DAffine2,
}

impl ViewTransform {
    /// `center` lands in the middle of a frame of `frame` pixels, at `scale` pixels per unit, turned clockwise by
    /// `rotation` degrees.
    pub fn around(center: DVec2, scale: f64, rotation: f64, frame: DVec2) -> Self {
        let matrix = DMat2::from_scale_angle(DVec2::splat(scale), rotation.to_radians());
        Self {
            scene_to_pixels: DAffine2::from_mat2_translation(matrix, frame / 2.0 - matrix * center),
        }
    }

    /// The pixel position of a user-space point.
    pub fn to_pixels(&self, point: DVec2) -> DVec2 {
        self.scene_to_pixels.transform_point2(point)
    }

    /// The user-space point at a pixel position.
    pub fn to_scene(&self, pixel: DVec2) -> DVec2 {
        self.scene_to_pixels.inverse().transform_point2(pixel)
    }
}
