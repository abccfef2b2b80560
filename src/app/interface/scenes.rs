//! The list of scenes: thumbnails under the names of their folders.

use std::ffi::OsStr;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use egui::{Align2, Color32, ColorImage, CornerRadius, FontId, Rect, RichText, Role, Sense, StrokeKind, TextureHandle};
use egui::{TextureOptions, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::controls::{at_end, command_button, heading, tip};
use super::focus;
use crate::figure::shrunk;
use crate::raster::Framebuffer;
use crate::viewer::{Command, Dialog, SceneCommand, SceneEntry, SceneSource, Toggle, Viewer, WindowCommand};

/// Thumbnails side by side.
const COLUMNS: usize = 3;
/// Height of a thumbnail, in points.
const PICTURE_HEIGHT: f32 = 62.0;
/// Height of the name below it, in points.
const NAME_HEIGHT: f32 = 16.0;
/// Between two thumbnails, in points.
const GAP: f32 = 6.0;
/// Height of a row of thumbnails with the gap below it, in points.
const ROW: f32 = PICTURE_HEIGHT + NAME_HEIGHT + GAP;
/// Height of a folder's name with the gap below it, in points.
const FOLDER: f32 = 13.0 + GAP;

/// Thumbnails as textures of exactly the size in which they are shown.
#[derive(Debug, Default)]
pub(super) struct Thumbnails {
    textures: Vec<Option<Thumbnail>>,
    /// The scene that the list was last scrolled to.
    shown: Option<usize>,
}

struct Thumbnail {
    source: Arc<Framebuffer>,
    room: [u32; 2],
    texture: TextureHandle,
}

impl std::fmt::Debug for Thumbnail {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Thumbnail")
            .field("room", &self.room)
            .finish_non_exhaustive()
    }
}

impl Thumbnails {
    /// The texture of a scene's thumbnail shrunk into `room` device pixels.
    fn texture(&mut self, ui: &Ui, index: usize, source: &Arc<Framebuffer>, room: [u32; 2]) -> &TextureHandle {
        if self.textures.len() <= index {
            self.textures.resize_with(index + 1, || None);
        }
        let slot = &mut self.textures[index];
        let stale = slot
            .as_ref()
            .is_none_or(|old| !Arc::ptr_eq(&old.source, source) || old.room != room);
        if stale {
            *slot = None;
        }
        let thumbnail = slot.get_or_insert_with(|| Thumbnail {
            source: Arc::clone(source),
            room,
            texture: ui.ctx().load_texture(
                format!("scene {index}"),
                shrunk_image(source, room),
                TextureOptions::NEAREST,
            ),
        });
        &thumbnail.texture
    }
}

/// What the list is to do, and what it asks for.
#[derive(Debug, Default)]
pub(super) struct Wishes {
    /// Whether it scrolls to a scene that has become the current one.
    pub(super) follow: bool,
    /// Scenes whose thumbnails are in sight and missing.
    pub(super) thumbnails: Vec<usize>,
}

/// The heading of the list, with buttons to step through it.
pub(super) fn title(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.vertical(|ui| heading(ui, "Scenes"));
        let words = viewer
            .scene_list()
            .current()
            .and_then(|entry| entry.scene()?.words.as_ref());
        let about = ui.add_enabled_ui(words.is_some(), |ui| command_button(ui, "about", "About"));
        if about.inner.clicked() {
            commands.push(Command::Window(WindowCommand::About(Toggle::Flip)));
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            // The only scene has no neighbours; a lesson's steps are many on one scene, too.
            let leads_on = viewer.scene_list().scenes().len() > 1 || viewer.lesson().is_some();
            at_end(ui, &["‹", "›"], |ui| {
                for (id, text) in [("previous-scene", "‹"), ("next-scene", "›")] {
                    let button = ui.add_enabled_ui(leads_on, |ui| command_button(ui, id, text));
                    if button.inner.clicked() {
                        commands
                            .extend(crate::viewer::commands::find(id).and_then(crate::viewer::CommandSpec::command));
                    }
                }
            });
            let place = format!(
                "{} of {}",
                viewer.scene_list().current_index() + 1,
                viewer.scene_list().scenes().len()
            );
            let place = egui::Button::new(RichText::new(place).weak().small()).frame(false);
            let all = ui.add(place).on_hover_text(tip("all-scenes"));
            if all.accessible_name("All scenes").clicked() {
                commands.push(Command::Window(WindowCommand::ToggleDialog(Dialog::Scenes)));
            }
        });
    });
}

/// Height of the list with its heading, in points, known before it is laid out.
pub(super) fn height(viewer: &Viewer) -> f32 {
    /// The heading.
    const TITLE: f32 = 32.0;
    TITLE + rows_height(viewer)
}

/// Height of the list without its heading, in points, with the gap below its last row.
fn rows_height(viewer: &Viewer) -> f32 {
    let heights = groups(viewer.scene_list().scenes())
        .into_iter()
        .map(|(heading, scenes)| {
            let rows = scenes.len().div_ceil(COLUMNS) as f32;
            let name = if heading.is_some() { FOLDER } else { 0.0 };
            name + rows * ROW
        });
    heights.sum()
}

/// Height of all rows of the list, in points.
pub(super) fn all_rows(viewer: &Viewer) -> f32 {
    rows_height(viewer) - GAP
}

/// The height of as many whole rows as a list of at most so many points shows from its beginning on.
pub(super) fn whole_rows(viewer: &Viewer, height: f32) -> f32 {
    let mut top = 0.0;
    let mut whole = None;
    for (heading, scenes) in groups(viewer.scene_list().scenes()) {
        if heading.is_some() {
            top += FOLDER;
        }
        for _ in 0..scenes.len().div_ceil(COLUMNS) {
            top += ROW;
            // The gap below it hides what the next one begins with.
            whole = Some(top - GAP).filter(|end| *end <= height).or(whole);
        }
    }
    whole.unwrap_or(height)
}

/// The list itself.
pub(super) fn list(
    ui: &mut Ui,
    viewer: &Viewer,
    thumbnails: &mut Thumbnails,
    requests: &mut Wishes,
    commands: &mut Vec<Command>,
) {
    let width = ((ui.available_width() - GAP * (COLUMNS - 1) as f32) / COLUMNS as f32).floor();
    let cell = vec2(width, IN_LIST.height());
    ui.spacing_mut().item_spacing = vec2(GAP, GAP);
    let mut pictures = Pictures {
        thumbnails,
        requests,
        cell: IN_LIST,
        chosen: None,
    };
    for (heading, scenes) in groups(viewer.scene_list().scenes()) {
        if let Some(heading) = heading {
            ui.label(RichText::new(heading).weak().small());
        }
        let end = scenes.end;
        for first in scenes.step_by(COLUMNS) {
            ui.horizontal(|ui| {
                for scene in first..(first + COLUMNS).min(end) {
                    if picture(ui, viewer, scene, cell, &mut pictures) {
                        commands.push(Command::Scenes(SceneCommand::Show(scene)));
                    }
                }
            });
        }
    }
}

/// Scenes of one folder that follow each other, under the folder's name. Files that were opened one by one have no folder in
/// their labels: beside others they stand under the name of the folder that they lie in, and without a heading while there
/// is nothing else.
pub(super) fn groups(scenes: &[SceneEntry]) -> Vec<(Option<String>, Range<usize>)> {
    let mut groups = Vec::new();
    let mut start = 0;
    for alike in scenes.chunk_by(|a, b| folder(a) == folder(b)) {
        let heading = match folder(&alike[0]) {
            (label, _) if !label.is_empty() => Some(label.to_owned()),
            _ if alike.len() == scenes.len() => None,
            (_, place) => {
                let name = place.and_then(Path::file_name).map(OsStr::to_string_lossy);
                Some(name.map_or("opened".to_owned(), std::borrow::Cow::into_owned))
            }
        };
        groups.push((heading, start..start + alike.len()));
        start += alike.len();
    }
    groups
}

/// How high the place of a scene is, in points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// The picture.
    pub(super) picture: f32,
    /// The room for the name below it.
    pub(super) name: f32,
    /// Lines that the name may take; what is left of it becomes dots.
    pub(super) name_lines: usize,
}

impl Cell {
    /// All of it.
    pub(super) fn height(self) -> f32 {
        self.picture + self.name
    }
}

/// What places of the panel's list are like.
const IN_LIST: Cell = Cell {
    picture: PICTURE_HEIGHT,
    name: NAME_HEIGHT,
    name_lines: 1,
};

/// The pictures of scenes in small, and what is wanted of them.
pub(super) struct Pictures<'a> {
    pub(super) thumbnails: &'a mut Thumbnails,
    pub(super) requests: &'a mut Wishes,
    /// What their places are like.
    pub(super) cell: Cell,
    /// The one that arrows have chosen.
    pub(super) chosen: Option<usize>,
}

/// One scene: picture and name. True when it was clicked.
fn picture(ui: &mut Ui, viewer: &Viewer, index: usize, cell: Vec2, pictures: &mut Pictures<'_>) -> bool {
    let Pictures {
        thumbnails, requests, ..
    } = pictures;
    let (rect, response) = ui.allocate_exact_size(cell, Sense::click());
    let current = index == viewer.scene_list().current_index();
    if current && requests.follow && thumbnails.shown != Some(index) {
        // What a hand clicks stays below the pointer.
        let in_sight = ui.is_rect_visible(rect);
        response.scroll_to_me((!in_sight).then_some(egui::Align::Center));
        thumbnails.shown = Some(index);
    }
    if !ui.is_rect_visible(rect) {
        return false;
    }
    show_picture(ui, viewer, index, response, pictures)
}

/// Shows a scene where its place is: picture, name, and more under the pointer. True when it was clicked.
pub(super) fn show_picture(
    ui: &Ui,
    viewer: &Viewer,
    index: usize,
    response: egui::Response,
    pictures: &mut Pictures<'_>,
) -> bool {
    let entry = &viewer.scene_list().scenes()[index];
    paint(ui, viewer, index, &response, pictures);
    let key = if index < 9 {
        format!(" ({})", index + 1)
    } else {
        String::new()
    };
    let tip = match entry.failure() {
        Some(message) => message.to_owned(),
        None => format!("{}{key}", entry.label),
    };
    // Where nothing gives it the focus, it has its place and its press from here.
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Scene {}", entry.label)));
    response.on_hover_text(tip).clicked()
}

/// Paints one scene: its thumbnail, its frame, its name.
fn paint(ui: &Ui, viewer: &Viewer, index: usize, response: &egui::Response, pictures: &mut Pictures<'_>) {
    let Pictures {
        thumbnails,
        requests,
        cell,
        chosen,
    } = pictures;
    let entry = &viewer.scene_list().scenes()[index];
    let (rect, current) = (response.rect, index == viewer.scene_list().current_index());
    let visuals = ui.visuals();
    let frame = Rect::from_min_size(rect.min, vec2(rect.width(), cell.picture));
    ui.painter().rect_filled(frame, CornerRadius::same(4), Color32::WHITE);
    if let Some(source) = &entry.thumbnail {
        let scale = ui.pixels_per_point();
        let texture = thumbnails.texture(ui, index, source, room(frame.size() - Vec2::splat(6.0), scale));
        let size = texture.size_vec2() / scale;
        let corner = ((frame.center() - size / 2.0) * scale).round() / scale;
        let unit = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter()
            .image(texture.id(), Rect::from_min_size(corner, size), unit, Color32::WHITE);
    } else if entry.failure().is_some() {
        ui.painter().text(
            frame.center(),
            Align2::CENTER_CENTER,
            "!",
            FontId::proportional(20.0),
            visuals.error_fg_color,
        );
    } else {
        requests.thumbnails.push(index);
    }
    let line = if current {
        egui::Stroke::new(2.0, visuals.selection.bg_fill)
    } else if response.hovered() {
        egui::Stroke::new(1.0, visuals.widgets.hovered.fg_stroke.color)
    } else {
        visuals.widgets.noninteractive.bg_stroke
    };
    ui.painter()
        .rect_stroke(frame, CornerRadius::same(4), line, StrokeKind::Inside);
    if *chosen == Some(index) {
        focus::ring_inside(ui.painter(), frame);
    }
    let color = if current {
        visuals.strong_text_color()
    } else {
        visuals.weak_text_color()
    };
    let below = Rect::from_min_max(pos2(rect.left(), frame.bottom() + 1.0), rect.max);
    name_below(ui, below, (name(entry), cell.name_lines), color);
}

/// The name in the middle of its room, in as many lines as it may take.
fn name_below(ui: &Ui, room: Rect, (name, lines): (&str, usize), color: Color32) {
    let mut job = egui::text::LayoutJob::simple_singleline(name.to_owned(), FontId::proportional(11.0), color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(room.width());
    job.wrap.max_rows = lines;
    job.halign = egui::Align::Center;
    let galley = ui.painter().layout_job(job);
    ui.painter().galley(room.center_top(), galley, color);
}

/// The folder part of a scene's label; where there is none, the folder that its file lies in.
fn folder(entry: &SceneEntry) -> (&str, Option<&Path>) {
    match (entry.label.rsplit_once(['/', '\\']), &entry.source) {
        (Some((folder, _)), _) => (folder, None),
        (None, SceneSource::File(path)) => ("", path.parent()),
        (None, SceneSource::Gallery(_)) => ("", None),
    }
}

/// The file's name without its ending.
fn name(entry: &SceneEntry) -> &str {
    let file = entry.label.rsplit(['/', '\\']).next().unwrap_or(&entry.label);
    let bare = file.strip_suffix(".svg").or_else(|| file.strip_suffix(".svgz"));
    bare.unwrap_or(file)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to small positive numbers first; NaN becomes 0"
)]
fn room(points: Vec2, scale: f32) -> [u32; 2] {
    [points.x, points.y].map(|side| (side * scale).clamp(1.0, 4096.0) as u32)
}

/// The picture shrunk to fit `room`, for egui.
fn shrunk_image(source: &Framebuffer, room: [u32; 2]) -> ColorImage {
    image_of(&shrunk(source, room))
}

/// An opaque picture, for egui.
pub(super) fn image_of(picture: &Framebuffer) -> ColorImage {
    let color = |pixel: &u32| {
        let [_, r, g, b] = pixel.to_be_bytes();
        Color32::from_rgb(r, g, b)
    };
    let size = [picture.width(), picture.height()].map(|side| side as usize);
    ColorImage::new(size, picture.pixels().iter().map(color).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::ViewerOptions;

    #[test]
    fn opened_files_stand_under_their_own_heading() {
        let viewer = Viewer::new(ViewerOptions::default()).expect("threads");
        let gallery = viewer.scene_list().scenes().to_vec();
        let opened = |path: &str| {
            let mut entry = gallery[0].clone();
            (entry.source, entry.label) = (SceneSource::File(path.into()), "mine.svg".to_owned());
            entry
        };
        let headings = |scenes: &[SceneEntry]| -> Vec<Option<String>> {
            let groups = groups(scenes);
            let count: usize = groups.iter().map(|(_, scenes)| scenes.len()).sum();
            assert_eq!(count, scenes.len(), "every scene once");
            groups.into_iter().map(|(heading, _)| heading).collect()
        };
        let before = headings(&gallery);
        assert_eq!(
            before.last(),
            Some(&Some("hardcore".to_owned())),
            "the last of the gallery"
        );
        let with = |paths: &[&str]| {
            let scenes = [gallery.clone(), paths.iter().map(|path| opened(path)).collect()].concat();
            headings(&scenes)[before.len()..].to_vec()
        };
        let name = |name: &str| Some(name.to_owned());
        assert_eq!(with(&["/home/me/robots/mine.svg"]), [name("robots")], "its folder");
        assert_eq!(
            with(&["/a/b/1.svg", "/a/b/2.svg", "/a/c/3.svg"]),
            [name("b"), name("c")]
        );
        assert_eq!(with(&["mine.svg"]), [name("opened")], "a folder without a name");
        assert_eq!(headings(&[opened("/a/b/mine.svg")]), [None], "alone it needs none");
    }
}
