//! Texts for the clipboard: a pixel in words, and the command line that makes the picture.

use crate::figure::{InsetPlace, InsetSpec};
use crate::viewer::command::Effect;
use crate::viewer::export::spec::{PictureSpec, output_name, shell_line};
use crate::viewer::state::Viewer;

impl Viewer {
    pub(in crate::viewer) fn copy_pixel(&mut self) -> Vec<Effect> {
        // In the inset the pointer reads pixels that the user looks at; elsewhere it is where it happens to be.
        let in_inset = self.hovered_pixel().filter(|_| self.pointer_over_inset());
        let pinned = in_inset.or(self.pinned_pixel());
        let pixel = pinned.or(self.hovered_pixel()).or(self.inspected_pixel());
        match pixel.and_then(|pixel| self.status_of(pixel)) {
            Some(status) => {
                let other = self
                    .other_status_of(status.pixel)
                    .and_then(|other| other.decimal_text());
                let other = other.map_or(String::new(), |other| format!("  B {other}"));
                self.copy_text(format!("{status}{other}"))
            }
            None => Vec::new(),
        }
    }

    pub(in crate::viewer) fn copy_command_line(&mut self) -> Vec<Effect> {
        match self.command_line() {
            Some(line) => self.copy_text(line),
            None => Vec::new(),
        }
    }

    pub(in crate::viewer) fn copy_text(&mut self, text: String) -> Vec<Effect> {
        self.chrome.messages.done(format!("copied: {text}"));
        vec![Effect::CopyText(text)]
    }

    /// The `rasterscope render` command that makes the current picture, quoted for a POSIX shell; `None` without a
    /// scene or without pixels. Options that have their default value are left out, but for size and view.
    pub fn command_line(&self) -> Option<String> {
        let output = output_name(&self.current()?.label);
        Some(shell_line(&self.picture_spec()?.arguments(&output)))
    }

    /// What decides the current picture; `None` without a scene or without pixels.
    pub(in crate::viewer) fn picture_spec(&self) -> Option<PictureSpec> {
        let (entry, size) = (self.current()?, self.frame_size());
        (!size.contains(&0)).then(|| PictureSpec {
            scene: entry.source.clone(),
            size,
            view: entry.camera.view(),
            render: self.settings.render,
            dialect: self.dialect_of_picture(),
            legend: true,
            insets: self.inset_spec().into_iter().collect(),
        })
    }

    /// The inspector's inset as figures carry it: as large as the frame has room for. `None` while it is not to be seen, or
    /// where there is no room at all.
    fn inset_spec(&self) -> Option<InsetSpec> {
        let pixel = self.inspector.inset.and(self.inspected_pixel())?;
        let (entry, context) = (self.current()?, self.view_context()?);
        let (region, magnification) = (self.inspector.magnifier.region, self.inspector.magnifier.magnification);
        let spec = InsetSpec::around(InsetPlace::Pixel(pixel), region, magnification);
        spec.fitted(self.frame_size(), &entry.camera.transform(&context))
    }
}
