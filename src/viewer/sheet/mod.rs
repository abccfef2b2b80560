//! Sheets: one picture for each combination of settings, in a labelled grid; by the command line, and put together in the
//! window with a preview of what that command line makes.

mod axes;
mod captions;
mod draft;
mod drawing;
mod files;
mod preview;
mod saving;

pub use axes::{Axis, AxisLists, Choice};
pub use captions::caption_of;
pub use draft::{PanelSize, SheetChange, SheetDraft, SheetSide};
pub use drawing::{Panel, SceneReader, Sheet, SheetRequest};
pub(super) use preview::{SheetQuestion, start};
pub(super) use saving::SheetJob;

use std::sync::Arc;

use glam::DVec2;

use self::preview::Previews;
use super::command_line::{output_name, shell_line};
use super::{Dialog, Effect, PictureSpec, Viewer};
use crate::figure::{InsetPlace, InsetSpec};
use crate::scene::{DialectChoice, Scene};

pub use preview::SheetPreview;

/// Reads the words of a `sheet` command, without the program's name, by the grammar of the command line.
pub type ReadSheet = fn(&[String]) -> Result<SheetRequest, String>;

/// The sheet that is being put together, and what is known of it.
#[derive(Debug)]
pub(super) struct SheetDesk {
    draft: SheetDraft,
    /// Device pixels that there are for the preview.
    room: [u32; 2],
    pub(super) previews: Previews,
    /// Sheets that were asked for while their scene was being read.
    waiting: u32,
}

/// A scene that is read already.
#[derive(Clone, Debug)]
pub(super) struct KnownScene {
    scene: Arc<Scene>,
    dialect: DialectChoice,
    /// Which document it is, and which reading of it.
    document: u64,
}

impl SheetDesk {
    pub(super) fn new(previews: Previews) -> Self {
        Self {
            draft: SheetDraft::default(),
            room: [0, 0],
            previews,
            waiting: 0,
        }
    }

    /// Whether everything that was asked for is there or at work.
    pub(super) fn is_current(&self) -> bool {
        self.waiting == 0 && self.previews.is_current()
    }
}

impl KnownScene {
    /// The scene as `dialect` reads it.
    fn read_in(&self, dialect: DialectChoice, spec: &PictureSpec) -> Result<Arc<Scene>, String> {
        if dialect == self.dialect {
            return Ok(Arc::clone(&self.scene));
        }
        let scene = spec.scene.read(dialect).map_err(|error| error.to_string())?;
        Ok(Arc::new(scene))
    }
}

impl Viewer {
    /// What the next sheet will be.
    pub fn sheet(&self) -> &SheetDraft {
        &self.sheet.draft
    }

    /// Whether there is a pinned pixel that the panels of a sheet can magnify.
    pub fn sheet_has_inset(&self) -> bool {
        self.inspector.open && self.pinned_pixel().is_some()
    }

    /// The `rasterscope sheet` command that makes the sheet, quoted for a POSIX shell; `None` without a scene or without pixels.
    pub fn sheet_command_line(&self) -> Option<String> {
        let name = output_name(&self.current()?.label);
        let name = name.strip_suffix(".png").unwrap_or(&name);
        Some(shell_line(&self.sheet_arguments(&format!("{name}-sheet.png"))?))
    }

    pub(super) fn change_sheet(&mut self, change: SheetChange) {
        self.sheet.draft.change(change);
    }

    pub(super) fn set_sheet_room(&mut self, room: [u32; 2]) {
        self.sheet.room = room;
    }

    /// Whether this room for the preview is another one than before.
    pub fn sheet_room_changes(&self, room: [u32; 2]) -> bool {
        self.sheet.room != room
    }

    pub(super) fn copy_sheet_command_line(&mut self) -> Vec<Effect> {
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
        let pixel = self.pinned_pixel().filter(|_| self.inspector.open)?;
        let (entry, sight) = (self.current()?, self.sight()?);
        let place = if panel.size == self.frame_size() {
            InsetPlace::Pixel(pixel)
        } else {
            let centre = DVec2::from(pixel.map(f64::from)) + 0.5;
            let view = entry.camera.transform(&sight);
            InsetPlace::User(rounded(view.to_scene(centre), entry.camera.numbers(&sight).scale))
        };
        let (region, magnification) = (self.inspector.region, self.inspector.magnification);
        let inset = InsetSpec::around(place, region, magnification);
        inset.fitted(panel.size, &panel.view.transform(sight.canvas, panel.size))
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
    pub(super) fn want_sheet(&mut self) {
        let open = self.screen.dialog == Some(Dialog::Sheet) && !self.sheet.room.contains(&0);
        let question = open.then(|| self.sheet_question()).flatten();
        self.sheet.previews.want(question, |_| None);
    }

    fn sheet_question(&self) -> Option<SheetQuestion> {
        Some(SheetQuestion {
            words: self.sheet_arguments("sheet.png")?,
            read: self.grammar?.sheet,
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
    pub(super) fn ask_for_sheet(&mut self) {
        self.sheet.waiting = self.sheet.waiting.saturating_add(1);
    }

    /// Saves the sheets that wait for their scene.
    pub(super) fn save_sheets_when_ready(&mut self) {
        if self.sheet.waiting == 0 || self.current().is_some_and(super::SceneEntry::is_reading) {
            return;
        }
        let jobs = std::mem::take(&mut self.sheet.waiting);
        let job = self.sheet_question().zip(self.picture_spec());
        let Some((question, spec)) = job else {
            self.messages
                .error("no sheet to save: there is no picture; open a scene first".to_owned());
            return;
        };
        for _ in 0..jobs {
            self.saver.push_sheet(SheetJob::new(&question, spec.clone()));
        }
    }
}

/// A place in user units with as many digits as tell pixels apart, where a unit has `scale` pixels.
fn rounded(place: DVec2, scale: f64) -> DVec2 {
    // A hundredth of a pixel.
    let digits = (scale.abs() * 100.0).log10().ceil().clamp(0.0, 12.0);
    let power = 10.0_f64.powf(digits);
    let rounded = (place * power).round() / power;
    if rounded.is_finite() { rounded } else { place }
}
