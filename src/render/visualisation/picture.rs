//! The picture itself.

use crate::render::visualisation::show::{Show, Source, Target};
use crate::render::{Legend, add};
use crate::scene::Scene;

pub(super) struct Picture;

impl Show for Picture {
    fn meaning(&self) -> &'static str {
        "the picture"
    }

    fn former_name(&self) -> Option<&'static str> {
        Some("color")
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        None
    }

    fn add(&self, source: &Source<'_>, (builder, screen): Target<'_, '_>, index: usize) {
        add(builder, screen, source.kind(index));
    }
}
