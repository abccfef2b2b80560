//! The sheet that is put together of the picture in the window: its command line, and what its preview asks.

use std::sync::Arc;

use glam::DVec2;

use crate::figure::{Inset, InsetPlace, InsetSpec};
use crate::geometry::rounded_place;
use crate::viewer::control::recipes::Recipes;
use crate::viewer::export::restored::Grammar;
use crate::viewer::export::sheet::desk::SheetDesk;
use crate::viewer::export::sheet::preview::{KnownScene, SheetQuestion};
use crate::viewer::export::spec::{PictureSpec, output_name, shell_line};
use crate::viewer::inspector::Inspector;

/// A number of pixels, smaller by a factor up to 1.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "no more than it was"
)]
fn scaled(pixels: u32, factor: f64) -> u32 {
    (f64::from(pixels) * factor).round() as u32
}

impl Recipes<'_> {
    /// The `rasterscope sheet` command that makes the sheet, quoted for a POSIX shell; `None` without a scene or without pixels.
    pub fn sheet_command_line(&self, desk: &SheetDesk) -> Option<String> {
        let name = output_name(&self.both.scene_list.current()?.label);
        let name = name.strip_suffix(".png").unwrap_or(&name);
        Some(shell_line(&self.sheet_arguments(desk, &format!("{name}-sheet.png"))?))
    }

    /// What the preview of the sheet, or a saved one, is to show; none where no `grammar` reads its command line.
    pub(in crate::viewer) fn sheet_question(
        &self,
        desk: &SheetDesk,
        grammar: Option<Grammar>,
    ) -> Option<SheetQuestion> {
        Some(SheetQuestion {
            words: self.sheet_arguments(desk, "sheet.png")?,
            read: grammar?.sheet,
            known: self.known_scene()?,
            room: desk.room,
        })
    }

    /// The words of the command that makes the sheet.
    fn sheet_arguments(&self, desk: &SheetDesk, output: &str) -> Option<Vec<String>> {
        let draft = &desk.draft;
        let panel = draft.panel(self.picture_spec()?);
        let inset = self.sheet_inset(&panel);
        Some(draft.arguments(&panel, inset, output))
    }

    /// The inspector's inset in a panel, as large as the panel has room for.
    fn sheet_inset(&self, panel: &PictureSpec) -> Option<InsetSpec> {
        let (both, pixels) = (&self.both, &self.pixels);
        let pixel = pixels.pinned().filter(|_| pixels.inspector.magnifier.open)?;
        let (entry, context) = (both.scene_list.current()?, both.view_context()?);
        let place = if panel.size == both.layout.frame_size() {
            InsetPlace::Pixel(pixel)
        } else {
            let centre = DVec2::from(pixel.map(f64::from)) + 0.5;
            let view = entry.camera.transform(&context);
            InsetPlace::User(rounded_place(
                view.to_scene(centre),
                entry.camera.numbers(&context).scale,
            ))
        };
        let Inspector {
            region, magnification, ..
        } = pixels.inspector.magnifier;
        // In a smaller panel it is as much smaller as the picture, and hides no more of it.
        let ratio = |axis: usize| f64::from(panel.size[axis]) / f64::from(both.layout.frame_size()[axis].max(1));
        let least = *Inset::MAGNIFICATION.start();
        let magnification = scaled(magnification, ratio(0).min(ratio(1)).min(1.0)).max(least);
        let inset = InsetSpec::around(place, region, magnification);
        inset.fitted(panel.size, &panel.view.transform(context.canvas, panel.size))
    }

    /// The current scene, once it was read.
    pub(in crate::viewer) fn known_scene(&self) -> Option<KnownScene> {
        let both = &self.both;
        let entry = both.scene_list.current().filter(|entry| !entry.is_reading())?;
        Some(KnownScene {
            scene: Arc::clone(entry.scene()?),
            dialect: both
                .scene_list
                .dialect_of_picture(both.settings, both.scene_list.current()?.scene()),
            document: entry.document,
        })
    }
}
