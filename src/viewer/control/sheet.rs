//! The sheet that is being put together: changed by commands, previewed, saved when the frame is there.

use crate::viewer::export::sheet::draft::{SheetChange, SheetDraft};
use crate::viewer::export::sheet::preview::{SheetPreview, SheetQuestion};
use crate::viewer::export::sheet::saving::SheetJob;
use std::sync::Arc;

use glam::DVec2;

use crate::figure::{InsetPlace, InsetSpec};
use crate::viewer::chrome::Dialog;
use crate::viewer::command::Effect;
use crate::viewer::export::sheet::preview::KnownScene;
use crate::viewer::export::spec::{PictureSpec, output_name, shell_line};
use crate::viewer::state::Viewer;

/// A place in user units with as many digits as tell pixels apart, where a unit has `scale` pixels.
fn rounded(place: DVec2, scale: f64) -> DVec2 {
    // A hundredth of a pixel.
    let digits = (scale.abs() * 100.0).log10().ceil().clamp(0.0, 12.0);
    let power = 10.0_f64.powf(digits);
    let rounded = (place * power).round() / power;
    if rounded.is_finite() { rounded } else { place }
}

impl Viewer {
    /// What the next sheet will be.
    pub fn sheet(&self) -> &SheetDraft {
        &self.sheet.draft
    }

    /// Whether there is a pinned pixel that the panels of a sheet can magnify.
    pub fn sheet_has_inset(&self) -> bool {
        self.inspector.magnifier.open && self.pinned_pixel().is_some()
    }

    /// The `rasterscope sheet` command that makes the sheet, quoted for a POSIX shell; `None` without a scene or without pixels.
    pub fn sheet_command_line(&self) -> Option<String> {
        let name = output_name(&self.current()?.label);
        let name = name.strip_suffix(".png").unwrap_or(&name);
        Some(shell_line(&self.sheet_arguments(&format!("{name}-sheet.png"))?))
    }

    pub(in crate::viewer) fn change_sheet(&mut self, change: SheetChange) {
        self.sheet.draft.change(change);
    }

    pub(in crate::viewer) fn set_sheet_room(&mut self, room: [u32; 2]) {
        self.sheet.room = room;
    }

    /// Whether this room for the preview is another one than before.
    pub fn sheet_room_changes(&self, room: [u32; 2]) -> bool {
        self.sheet.room != room
    }

    pub(in crate::viewer) fn copy_sheet_command_line(&mut self) -> Vec<Effect> {
        match self.sheet_command_line() {
            Some(line) => self.copy_text(line),
            None => Vec::new(),
        }
    }

    /// The words of the command that makes the sheet.
    fn sheet_arguments(&self, output: &str) -> Option<Vec<String>> {
        let draft = &self.sheet.draft;
        let panel = draft.panel(self.picture_spec()?);
        let inset = self.sheet_inset(&panel);
        Some(draft.arguments(&panel, inset, output))
    }

    /// The inspector's inset in a panel, as large as the panel has room for.
    fn sheet_inset(&self, panel: &PictureSpec) -> Option<InsetSpec> {
        let pixel = self.pinned_pixel().filter(|_| self.inspector.magnifier.open)?;
        let (entry, context) = (self.current()?, self.view_context()?);
        let place = if panel.size == self.frame_size() {
            InsetPlace::Pixel(pixel)
        } else {
            let centre = DVec2::from(pixel.map(f64::from)) + 0.5;
            let view = entry.camera.transform(&context);
            InsetPlace::User(rounded(view.to_scene(centre), entry.camera.numbers(&context).scale))
        };
        let (region, magnification) = (self.inspector.magnifier.region, self.inspector.magnifier.magnification);
        let inset = InsetSpec::around(place, region, magnification);
        inset.fitted(panel.size, &panel.view.transform(context.canvas, panel.size))
    }

    /// The current scene, once it was read.
    fn known_scene(&self) -> Option<KnownScene> {
        let entry = self.current().filter(|entry| !entry.is_reading())?;
        Some(KnownScene {
            scene: Arc::clone(entry.scene()?),
            dialect: self.dialect_of_picture(),
            document: entry.document,
        })
    }

    /// Sees to it that the preview follows, while it is to be seen.
    pub(in crate::viewer) fn want_sheet(&mut self) {
        let open = self.chrome.dialog == Some(Dialog::Sheet) && !self.sheet.room.contains(&0);
        let question = open.then(|| self.sheet_question()).flatten();
        self.sheet.previews.want(question, |_| None);
    }

    fn sheet_question(&self) -> Option<SheetQuestion> {
        Some(SheetQuestion {
            words: self.sheet_arguments("sheet.png")?,
            read: self.export.grammar?.sheet,
            known: self.known_scene()?,
            room: self.sheet.room,
        })
    }

    /// The preview of the sheet, or why there is none, in one line; that of an earlier state while the new one is drawn, which
    /// `true` tells.
    pub fn sheet_preview(&self) -> Option<(&Result<SheetPreview, String>, bool)> {
        let previews = &self.sheet.previews;
        Some((previews.newest()?, !previews.is_current()))
    }

    /// Grows with every other preview.
    pub fn sheet_preview_number(&self) -> u64 {
        self.sheet.previews.number()
    }

    /// Saves the sheet with its panels, once its scene was read.
    pub(in crate::viewer) fn ask_for_sheet(&mut self) {
        self.sheet.waiting = self.sheet.waiting.saturating_add(1);
    }

    /// Saves the sheets that wait for their scene.
    pub(in crate::viewer) fn save_sheets_when_ready(&mut self) {
        if self.sheet.waiting == 0
            || self
                .current()
                .is_some_and(crate::viewer::library::SceneEntry::is_reading)
        {
            return;
        }
        let jobs = std::mem::take(&mut self.sheet.waiting);
        let job = self.sheet_question().zip(self.picture_spec());
        let Some((question, spec)) = job else {
            self.chrome
                .messages
                .error("no sheet to save: there is no picture; open a scene first".to_owned());
            return;
        };
        for _ in 0..jobs {
            self.export.saver.push_sheet(SheetJob::new(&question, spec.clone()));
        }
    }
}
