//! What a user sets: small types with their names in menus, scripts and the command line.

use crate::color::Rgba;
use crate::render::RenderSettings;
use crate::rules::Rules;
use crate::scene::DialectChoice;
use crate::texture::{Anisotropy, LevelOfDetail};

/// Everything about pictures that a user sets apart from scene and view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Sampling, rules, background.
    pub render: RenderSettings,
    /// In which dialect scenes are read.
    pub dialect: DialectChoice,
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
            pixel_zoom: PixelZoom::default(),
            progressive: true,
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

/// Where samples lie, how they are averaged and what they show, where that is not the default: few words each, such as
/// `pattern halton` or `resolve linear`.
pub fn sample_words(render: &RenderSettings) -> Vec<String> {
    let default = RenderSettings::default();
    let words = [
        (render.pattern != default.pattern).then(|| format!("pattern {}", render.pattern.name())),
        (render.resolve != default.resolve).then(|| format!("resolve {}", render.resolve.name())),
        (render.visualisation != default.visualisation).then(|| format!("visualise {}", render.visualisation.name())),
    ];
    words.into_iter().flatten().collect()
}

/// How textures are read beyond pixel and level sampling, where it differs from the default: few words each, such as
/// `anisotropy 16` or `level 2`.
pub fn texture_words(render: &RenderSettings) -> Vec<String> {
    let (taps, detail, default) = (render.anisotropy, render.detail, LevelOfDetail::default());
    let words = [
        (taps != Anisotropy::OFF).then(|| format!("anisotropy {}", taps.taps())),
        detail.fixed.map(|level| format!("level {}", level.level())),
        (detail.bias != default.bias).then(|| format!("bias {:+}", detail.bias.levels())),
        (detail.derivatives != default.derivatives).then(|| format!("level per {}", detail.derivatives.name())),
    ];
    words.into_iter().flatten().collect()
}

/// Every setting by its name, with its value in words, always in the same order: what tells two pictures apart.
pub(super) fn settings_words(render: &RenderSettings) -> Vec<(&'static str, String)> {
    // Named one by one, so that no setting that is added can be forgotten here. The outline follows the view.
    let RenderSettings {
        sample_rate,
        pattern,
        pixel_sampling,
        level_sampling,
        anisotropy,
        detail,
        rules,
        resolve,
        visualisation,
        background,
        outline: _,
    } = render;
    let LevelOfDetail {
        bias,
        fixed,
        derivatives,
    } = detail;
    let level = fixed.map_or("auto".to_owned(), |level| level.level().to_string());
    vec![
        ("sample rate", sample_rate.samples().to_string()),
        ("pattern", pattern.name().to_owned()),
        ("pixel sampling", pixel_sampling.name().to_owned()),
        ("level sampling", level_sampling.name().to_owned()),
        ("anisotropy", anisotropy.taps().to_string()),
        ("level", level),
        ("bias", format!("{:+}", bias.levels())),
        ("level per", derivatives.name().to_owned()),
        ("resolve", resolve.name().to_owned()),
        ("visualise", visualisation.name().to_owned()),
        ("rules", rules.name().to_owned()),
        ("background", background_name(*background)),
    ]
}

/// As `--background` takes it.
pub(super) fn background_name(color: Rgba) -> String {
    if color == Rgba::WHITE {
        return "white".to_owned();
    }
    match color.to_bytes(Rules::Standard) {
        [_, _, _, 0] => "transparent".to_owned(),
        [r, g, b, _] => format!("#{r:02x}{g:02x}{b:02x}"),
    }
}

/// The value after `current` in `all`, the first after the last.
pub(super) fn next_of<T: Copy + PartialEq>(all: &[T], current: T) -> T {
    let at = all.iter().position(|value| *value == current).unwrap_or(0);
    all.get(at + 1).or(all.first()).copied().unwrap_or(current)
}
