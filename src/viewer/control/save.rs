//! Screenshots and sheets: asked for now, made when the frame and the scene of this state are there.

use std::path::{Path, PathBuf};

use crate::viewer::chrome::Dialog;
use crate::viewer::control::copy::Copied;
use crate::viewer::control::recipes::Recipes;
use crate::viewer::export::naming::names_to_try;
use crate::viewer::export::saver::Work;
use crate::viewer::export::sheet::desk::SheetDesk;
use crate::viewer::export::sheet::preview::SheetQuestion;
use crate::viewer::export::sheet::saving::SheetJob;
use crate::viewer::export::spec::output_name;
use crate::viewer::export::state::Export;
use crate::viewer::state::Viewer;
use crate::viewer::{ExportCommand, SheetCommand};

/// What saves, and what it saves.
#[derive(Debug)]
pub(in crate::viewer) struct Saving<'a> {
    pub(in crate::viewer) recipes: Recipes<'a>,
    pub(in crate::viewer) export: &'a mut Export,
    pub(in crate::viewer) sheet: &'a mut SheetDesk,
}

/// What became of the screenshots that were asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Screenshots {
    /// There are none, or their frame is still to come.
    Wait,
    /// They are being saved.
    Saved,
    /// There is nothing to save.
    NoPicture,
}

impl Viewer {
    /// A file that does not exist yet, for the picture that is shown: named like its scene, where the last one was saved.
    /// `None` without a scene.
    pub fn new_picture_path(&self) -> Option<PathBuf> {
        let name = output_name(&self.scene_list.current()?.label);
        let stem = name.strip_suffix(".png").unwrap_or(&name);
        let folder = self.export.saver.folder_to_show();
        let mut paths = names_to_try(stem).map(|name| folder.join(format!("{name}.png")));
        let path = paths.find(|path| !path.exists())?;
        Some(path.strip_prefix(".").map_or_else(|_| path.clone(), Path::to_owned))
    }
}

impl Saving<'_> {
    /// What a command puts on the clipboard, if it does, or why it cannot; a screenshot is noted.
    pub(in crate::viewer) fn export(&mut self, command: ExportCommand) -> Option<Result<Copied, String>> {
        let recipes = &self.recipes;
        match command {
            // The program around the viewer does these.
            ExportCommand::WindowScreenshot | ExportCommand::OpenFolder => None,
            ExportCommand::Screenshot => {
                self.export
                    .saver
                    .ask(recipes.both.frames.drawing.newest_request(), None);
                None
            }
            ExportCommand::SaveAs(path) => {
                self.export
                    .saver
                    .ask(recipes.both.frames.drawing.newest_request(), Some(path));
                None
            }
            ExportCommand::Copy if recipes.pixels.inspector.magnifier.open => Copied::pixel(&recipes.pixels).map(Ok),
            ExportCommand::CopyPixel => Copied::pixel(&recipes.pixels).map(Ok),
            ExportCommand::Copy | ExportCommand::CopyPicture => Some(Copied::picture(recipes)),
            ExportCommand::CopyExplanation => Some(Copied::explanation(recipes)),
            ExportCommand::CopyCommandLine => Copied::command_line(recipes).map(Ok),
        }
    }

    /// The same for a command about the sheet.
    pub(in crate::viewer) fn change_sheet(&mut self, command: SheetCommand) -> Option<Result<Copied, String>> {
        match command {
            SheetCommand::Change(change) => self.sheet.draft.change(change),
            SheetCommand::SetRoom(room) => self.sheet.room = room,
            SheetCommand::Save => {
                self.sheet.draft.suit(self.recipes.both.settings.render.pattern);
                self.sheet.ask();
            }
            SheetCommand::CopyCommandLine => {
                self.sheet.draft.suit(self.recipes.both.settings.render.pattern);
                let line = self.recipes.sheet_command_line(self.sheet);
                return line.map(Copied::text).map(Ok);
            }
        }
        None
    }

    fn sheet_question(&self) -> Option<SheetQuestion> {
        self.recipes.sheet_question(self.sheet, self.export.grammar)
    }

    /// Saves the screenshots that wait, as soon as there is a final frame of the state when they were asked for, or of
    /// a later one.
    pub(in crate::viewer) fn save_screenshots(&mut self) -> Screenshots {
        let both = self.recipes.both;
        let (drawing, saver) = (&both.frames.drawing, &mut self.export.saver);
        let probed = self.recipes.pixels.inspector.samples.is_current();
        if !saver.is_waiting() || both.scene_list.is_reading() || !probed {
            return Screenshots::Wait;
        }
        let Some(frame) = drawing.final_frame(saver.since) else {
            if !drawing.is_current() {
                return Screenshots::Wait;
            }
            saver.waiting.clear();
            return Screenshots::NoPicture;
        };
        if both.ab.shows_both() && !both.ab.is_current() {
            return Screenshots::Wait;
        }
        let frame = self.recipes.shown_frame(frame);
        let recipe = self.recipes.recipe_of_frame(frame);
        for file in std::mem::take(&mut saver.waiting) {
            let shot = self.recipes.shot_of(frame, recipe.as_ref());
            saver.push(Work::Picture {
                shot,
                recipe: recipe.clone().map(Box::new),
                file,
            });
        }
        Screenshots::Saved
    }

    /// Sees to it that the preview of the sheet follows, while it is to be seen.
    pub(in crate::viewer) fn want_sheet(&mut self) {
        let is_open = self.recipes.pixels.chrome.dialog == Some(Dialog::Sheet);
        let is_seen = is_open && !self.sheet.room.contains(&0);
        let question = is_seen.then(|| self.sheet_question()).flatten();
        self.sheet.previews.want(question, |_| None);
    }

    /// Saves the sheets that wait for their scene; whether there are any.
    ///
    /// # Errors
    /// One line for the user when there is nothing to save.
    pub(in crate::viewer) fn save_sheets(&mut self) -> Result<bool, &'static str> {
        if self.sheet.waiting == 0 || self.recipes.both.scene_list.is_reading() {
            return Ok(false);
        }
        let jobs = std::mem::take(&mut self.sheet.waiting);
        let job = self.sheet_question().zip(self.recipes.picture_spec());
        let Some((question, spec)) = job else {
            return Err("no sheet to save: there is no picture; open a scene first");
        };
        for _ in 0..jobs {
            self.export.saver.push_sheet(SheetJob::new(&question, spec.clone()));
        }
        Ok(true)
    }
}
