//! What a user sets: small types with their names in menus, scripts and the command line.

pub(super) mod document;
pub mod notes;
pub mod patterns;
pub mod picture;
mod row;
mod table;
pub(super) mod values;

use crate::raster::SamplePattern;
use crate::render::RenderSettings;
use crate::scene::DialectChoice;

/// Everything about pictures that a user sets apart from scene and view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Sampling, rules, background.
    pub render: RenderSettings,
    /// In which dialect scenes are read.
    pub dialect: DialectChoice,
    /// The custom pattern that was chosen last and does not come with the program: lists go on offering it.
    pub own_pattern: Option<SamplePattern>,
    /// Window pixels per frame pixel.
    pub pixel_zoom: PixelZoom,
    /// Whether coarse pictures may stand in for slow ones while the view moves. Only windows show them: whatever is
    /// saved or read is final.
    pub progressive: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            render: RenderSettings::default(),
            dialect: DialectChoice::default(),
            own_pattern: None,
            pixel_zoom: PixelZoom::default(),
            progressive: true,
        }
    }
}

impl Settings {
    /// How a picture is drawn and its document read; what no picture shows has its default.
    pub fn of(render: RenderSettings, dialect: DialectChoice) -> Self {
        Self {
            render,
            dialect,
            own_pattern: Some(render.pattern).filter(|pattern| patterns::is_own(*pattern)),
            ..Self::default()
        }
    }
}

/// Window pixels along each side of a frame pixel: 1 to 8. Above 1 the frame is smaller than the window by this
/// factor and shown magnified, so that sampling is visible on a dense screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PixelZoom(u32);

/// Light or dark panels. The picture does not change with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Theme {
    /// Light text on dark panels.
    #[default]
    Dark,
    /// Dark text on light panels.
    Light,
}

/// What to do with something that is on or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Toggle {
    /// On if it was off, off if it was on.
    Flip,
    /// On.
    On,
    /// Off.
    Off,
}

impl PixelZoom {
    /// One frame pixel is one window pixel.
    pub const ONE: Self = Self(1);
    /// Every value, in the order of menus.
    pub const ALL: [Self; 6] = [Self(1), Self(2), Self(3), Self(4), Self(6), Self(8)];

    /// The zoom by `factor`, or `None` unless that is one of [`PixelZoom::ALL`].
    pub fn new(factor: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|zoom| zoom.0 == factor)
    }

    /// Window pixels per frame pixel.
    pub fn factor(self) -> u32 {
        self.0
    }

    /// The frame that covers a window of `window` pixels. No side exceeds [`Framebuffer::MAX_SIDE`].
    ///
    /// [`Framebuffer::MAX_SIDE`]: crate::raster::Framebuffer::MAX_SIDE
    pub fn frame_size(self, window: [u32; 2]) -> [u32; 2] {
        window.map(|side| side.div_ceil(self.0).min(crate::raster::Framebuffer::MAX_SIDE))
    }
}

impl Default for PixelZoom {
    fn default() -> Self {
        Self::ONE
    }
}

impl Theme {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 2] = [Self::Dark, Self::Light];

    /// The name used in the interface and in scripts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dark => "dark",
            Self::Light => "light",
        }
    }
}

impl Toggle {
    /// The names, as people are told them.
    pub(in crate::viewer) const FORM: &str = "on|off|flip";
    /// Every value.
    pub const ALL: [Self; 3] = [Self::Flip, Self::On, Self::Off];

    /// The name used in scripts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Flip => "flip",
            Self::On => "on",
            Self::Off => "off",
        }
    }

    /// What `state` becomes.
    pub fn of(self, state: bool) -> bool {
        match self {
            Self::Flip => !state,
            Self::On => true,
            Self::Off => false,
        }
    }
}
