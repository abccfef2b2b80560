//! What A is compared with, and how both share the window.

use std::path::PathBuf;
use std::sync::Arc;

use crate::color::ResolveSpace;
use crate::render::RenderSettings;
use crate::scene::DialectChoice;
use crate::viewer::ab::outside::OutsidePicture;
use crate::viewer::settings::picture::SettingChange;
use crate::viewer::settings::values::path;
use crate::viewer::settings::{Settings, picture};

impl Other {
    /// The same scene under these settings.
    pub(in crate::viewer) fn with(settings: &Settings) -> Self {
        Self::Settings {
            render: settings.render,
            dialect: settings.dialect,
        }
    }
}

impl Against {
    /// What a person writes: `settings`, `truth`, `truth stored`, `truth linear`, `none`, settings such as `sample-rate 16,
    /// dialect svg`, or the path of a picture; nothing for no text and for settings that are none.
    pub fn from_text(text: &str) -> Option<Self> {
        match text {
            "" => None,
            text if picture::are_meant(text) => picture::parse_changes(text).map(Self::Changed),
            "settings" => Some(Self::Settings),
            "truth" => Some(Self::Truth(None)),
            "truth stored" => Some(Self::Truth(Some(ResolveSpace::Stored))),
            "truth linear" => Some(Self::Truth(Some(ResolveSpace::Linear))),
            "none" => Some(Self::Nothing),
            text => Some(Self::File(path(text))),
        }
    }
}

/// What A is compared with.
#[derive(Clone, Debug, PartialEq)]
pub enum Other {
    /// The same scene under these settings, read in this dialect.
    Settings {
        /// Sampling, rules, background.
        render: RenderSettings,
        /// Where it is not A's, the scene is read a second time.
        dialect: DialectChoice,
    },
    /// The same scene with 256 samples per pixel that read textures at level zero, averaged in these values or in those
    /// of A; else as A.
    Truth(Option<ResolveSpace>),
    /// A picture from outside: A then has its size.
    Picture(Arc<OutsidePicture>),
}

/// What a command compares A with.
#[derive(Clone, Debug, PartialEq)]
pub enum Against {
    /// A copy of the settings of this moment.
    Settings,
    /// A copy of the settings of this moment with these changes.
    Changed(Vec<SettingChange>),
    /// The same scene with 256 samples per pixel, averaged in these values or in those of A.
    Truth(Option<ResolveSpace>),
    /// The PNG or JPEG in this file.
    File(PathBuf),
    /// Nothing: the comparison is closed.
    Nothing,
}

/// How A and B share the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Arrangement {
    /// A alone.
    #[default]
    Alone,
    /// A on the left of a line, B on its right.
    Wipe,
    /// The whole of both, each in its half.
    SideBySide,
    /// What differs, in colours.
    Difference,
    /// A and B in turn.
    Flip,
}

impl Arrangement {
    /// The names, as people are told them.
    pub(in crate::viewer) const FORM: &str = "alone|wipe|side|difference|flip";
    /// Every value, in the order of menus.
    pub const ALL: [Self; 5] = [Self::Alone, Self::Wipe, Self::SideBySide, Self::Difference, Self::Flip];

    /// The name used in the interface and in scripts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alone => "alone",
            Self::Wipe => "wipe",
            Self::SideBySide => "side",
            Self::Difference => "difference",
            Self::Flip => "flip",
        }
    }
}
