//! The front door: a scene to a picture, and to the reason for a pixel's colour, with one set of settings for both.

use crate::geometry::View;
use crate::inspect::{Explanation, Question};
use crate::memory::{self, OutOfMemory};
use crate::raster::Framebuffer;
use crate::render::{self, RenderSettings, Subject};
use crate::scene::Scene;

/// Everything that a picture depends on besides its scene. The defaults are those of the command line.
///
/// ```
/// use rasterscope::{SampleRate, Settings};
///
/// let mut settings = Settings::default();
/// settings.size = [640, 480];
/// settings.render.sample_rate = SampleRate::new(16).expect("at most 256");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Width and height of the picture in pixels, each 1 to [`Framebuffer::MAX_SIDE`]; 1024 x 1024 by default.
    pub size: [u32; 2],
    /// The part of the scene that the picture shows.
    pub view: View,
    /// How it is sampled, and what its pixels show.
    pub render: RenderSettings,
}

/// Why there is no picture, or no such pixel. Displays as one line with the cure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// A side of the picture is zero or too long.
    #[error("a picture of {0}x{1} pixels: each side has 1 to {max} pixels", max = Framebuffer::MAX_SIDE)]
    Size(u32, u32),
    /// The system has no room for so many pixels.
    #[error("{0}; draw fewer pixels")]
    Memory(#[from] OutOfMemory),
    /// The pixel to explain lies beside the picture.
    #[error("pixel {x},{y} is outside the picture of {width}x{height} pixels", x = pixel[0], y = pixel[1], width = size[0], height = size[1])]
    Outside {
        /// The pixel, `[x, y]`.
        pixel: [u32; 2],
        /// Width and height of the picture.
        size: [u32; 2],
    },
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            size: [1024, 1024],
            view: View::default(),
            render: RenderSettings::default(),
        }
    }
}

impl Settings {
    fn check_size(&self) -> Result<(), PictureError> {
        let [width, height] = self.size;
        let fits = self.size.iter().all(|side| (1..=Framebuffer::MAX_SIDE).contains(side));
        if fits {
            Ok(())
        } else {
            Err(PictureError::Size(width, height))
        }
    }
}

/// Draws a scene, on all threads of the current rayon pool. The picture is the same on any number of them, and byte for
/// byte the one of `rasterscope render` with the same settings, which adds insets and legends where they are asked for.
///
/// # Errors
/// When the picture's size is out of range, or the system has no memory for it.
pub fn draw(scene: &Scene, settings: &Settings) -> Result<Framebuffer, PictureError> {
    settings.check_size()?;
    let [width, height] = settings.size;
    memory::ask_for(u64::from(width) * u64::from(height) * u64::from(u32::BITS / 8))?;
    let mut picture = Framebuffer::new(width, height);
    let view = settings.view.transform(scene.canvas, settings.size);
    render::draw(scene, &view, &settings.render, &mut picture);
    Ok(picture)
}

/// Explains why the pixel in column and row `pixel` of the picture that [`draw`] makes has its colour, and which settings
/// would bring it nearer to the truth. The explanation displays as the text of `rasterscope inspect`.
///
/// # Errors
/// When the picture's size is out of range, or the pixel is outside the picture.
pub fn explain(scene: &Scene, settings: &Settings, pixel: [u32; 2]) -> Result<Explanation, PictureError> {
    settings.check_size()?;
    let size = settings.size;
    let view = settings.view.transform(scene.canvas, size);
    let question = Question {
        subject: Subject {
            scene,
            view: &view,
            settings: &settings.render,
        },
        file: &scene.name,
        size,
        pixel,
    };
    Explanation::advised(&question).ok_or(PictureError::Outside { pixel, size })
}
