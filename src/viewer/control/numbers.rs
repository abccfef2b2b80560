//! Pixels in numbers: for the status line, the inset's labels and the clipboard.

use glam::DVec2;

use crate::figure::is_dark;
use crate::viewer::control::pointing::Pointing;
use crate::viewer::inspector::status::Status;
use crate::viewer::inspector::{PixelLabel, PlacedInset};

impl Pointing<'_> {
    /// The pixel that the status line tells about: under the pointer, else pinned.
    pub fn status(&self) -> Option<Status> {
        let pin_is_newer = self.pointer.pins_before != self.inspector.magnifier.pins;
        let newer = self.pinned().filter(|_| pin_is_newer);
        self.status_of(newer.or(self.hovered()).or(self.pinned())?)
    }

    /// A frame pixel in numbers; `None` before the scene was read.
    pub fn status_of(&self, pixel: [u32; 2]) -> Option<Status> {
        let context = self.both.view_context()?;
        let camera = &self.both.scene_list.current()?.camera;
        let centre = DVec2::from(pixel.map(f64::from)) + 0.5;
        Some(Status {
            pixel,
            user: camera.transform(&context).to_scene(centre),
            rgba: self
                .both
                .frames
                .frame()
                .and_then(|frame| frame.final_rgba(pixel[0], pixel[1])),
            scale: camera.numbers(&context).scale,
        })
    }

    /// The same pixel of B in numbers; `None` without B.
    pub fn other_status_of(&self, pixel: [u32; 2]) -> Option<Status> {
        let [x, y] = pixel;
        Some(Status {
            rgba: Some(self.both.ab.other_final_rgba(x, y)?),
            ..self.status_of(pixel)?
        })
    }

    /// The numbers to write on the inset's pixels when a character is `[width, height]` window pixels; none where
    /// they do not fit, and none on the pixel in the middle where its samples are drawn there.
    pub fn pixel_labels(&self, character: [f32; 2]) -> Vec<PixelLabel> {
        let has_marks = !self.inspector.pixel_samples().is_empty();
        let fits = |placed: &PlacedInset| placed.labels_fit(character);
        let own = self.inspector.inset.filter(fits).zip(self.both.frames.frame());
        let labels = own.map(|(placed, frame)| {
            let has_marks = has_marks && !placed.inset.has_detail();
            self.labels_of(&placed, &|x, y| frame.final_rgba(x, y), has_marks)
        });
        let other = |x, y| self.both.ab.other_final_rgba(x, y);
        let other_inset = self.inspector.other_inset.filter(fits);
        let others = other_inset.map(|placed| self.labels_of(&placed, &other, false));
        labels.into_iter().chain(others).flatten().collect()
    }

    /// The numbers on one inset's pixels, but on the pixel in the middle where it has marks.
    fn labels_of(
        &self,
        placed: &PlacedInset,
        rgba: &dyn Fn(u32, u32) -> Option<[u8; 4]>,
        has_marks: bool,
    ) -> Vec<PixelLabel> {
        let source = placed.inset.source();
        let marked = Some(placed.inset.center).filter(|_| has_marks);
        let all = (source.y..source.bottom()).flat_map(|y| (source.x..source.right()).map(move |x| [x, y]));
        let label = |pixel: [i64; 2]| {
            let block = placed.block(pixel)?;
            let pixel = self.both.layout.in_frame(pixel)?;
            let rgba = rgba(pixel[0], pixel[1])?;
            Some(PixelLabel {
                pixel,
                block,
                rgba,
                dark: is_dark(rgba),
            })
        };
        all.filter(|pixel| marked != Some(*pixel)).filter_map(label).collect()
    }

    /// How many different colours the inspector's region shows: where that is an edge, its shades and both sides. `None`
    /// while the inspector is closed or the frame is not final.
    pub fn region_colors(&self) -> Option<usize> {
        let (shown, frame) = (self.inspector.inset?.inset.source(), self.both.frames.frame()?);
        if frame.preview.is_some() {
            return None;
        }
        let place = |start: i64, offset: u32| u32::try_from(start + i64::from(offset)).ok();
        let rows = (0..shown.height).filter_map(|row| place(shown.y, row));
        let mut colors: Vec<_> = rows
            .flat_map(|y| (0..shown.width).filter_map(move |column| Some((place(shown.x, column)?, y))))
            .filter_map(|(x, y)| frame.pixels.rgba(x, y))
            .collect();
        colors.sort_unstable();
        colors.dedup();
        Some(colors.len())
    }
}
