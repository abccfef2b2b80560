//! The side panel: settings above, the scenes and the reader's report below.
//!
//! In a high window the settings stay and the list of scenes scrolls by itself; in a low one all of it scrolls as one.
//! Which of both follows from the window's height and from what is known before anything is laid out, never from heights
//! that the last pass measured: those follow from the layout, and the panel would alternate between both for ever.

use egui::containers::scroll_area::ScrollSource;
use egui::style::ScrollStyle;
use egui::{Panel, ScrollArea, Ui};

use super::document::Readings;
use super::focus::FocusPanel;
use super::scenes::{self, Wishes};
use super::{Asked, Interface, SizedPanel, compare, document, look, panel_frame, sampling, view_numbers};
use crate::viewer::{SceneEntry, SceneSource, Viewer};

/// Height of everything above the scenes but the report where all of it is shown, in points.
const SETTINGS: f32 = 805.0;
/// What of it tells the times of the last redraw and what it filled, which pictures that must be alike leave out.
const TIMES: f32 = 80.0;
/// Height that the scenes have at least where their list scrolls by itself, in points.
const LEAST_LIST: f32 = 170.0;
/// Height of the reader's report, in points: a longer one scrolls in it, so that the scenes below stay where they are.
const REPORT: f32 = 96.0;
/// Longest report on the only scene in a panel that scrolls as a whole, in points: there is no list that it would push.
const LONG_REPORT: f32 = 240.0;

/// What the side panel remembers.
#[derive(Debug, Default)]
pub(super) struct PanelMemory {
    /// How many scenes the list has, and the first: what follows belongs to these.
    list: Option<(usize, SceneSource)>,
    readings: Readings,
    /// Whether a scene of the list has a report, or may have one: then all have the room for it, so that nothing moves from
    /// one to the next.
    reports: bool,
    /// The panel's height in the last pass, in points.
    height: f32,
    /// Whether the list is another one than in the last pass: then nothing is left of where the panel was scrolled to.
    is_new: bool,
}

impl PanelMemory {
    /// Takes in the current scene.
    fn follow(&mut self, viewer: &Viewer) {
        let list = viewer
            .scene_list()
            .scenes()
            .first()
            .map(|first| (viewer.scene_list().scenes().len(), &first.source));
        self.is_new = self.list.as_ref().map(|(count, first)| (*count, first)) != list;
        if self.is_new {
            *self = Self {
                is_new: true,
                list: list.map(|(count, first)| (count, first.clone())),
                height: self.height,
                readings: Readings::of_list(viewer.scene_list().scenes()),
                // Those of the gallery have nothing to report.
                reports: viewer.scene_list().scenes().iter().any(SceneEntry::is_file),
            };
        }
        self.reports |= document::has_report(viewer);
        self.readings.follow(viewer);
    }
}

impl Interface {
    pub(super) fn side_panel(&mut self, ui: &mut Ui, viewer: &Viewer, window: f32, asked: &mut Asked) {
        let panel = Panel::right("side panel")
            .resizable(false)
            .exact_size(self.widths.of(SizedPanel::Side, window))
            .frame(panel_frame(ui, look::scrolling_margin(4)))
            .show(ui, |ui| {
                FocusPanel::Side.head(ui);
                look::bars_beside(ui);
                self.panel.follow(viewer);
                let height = ui.available_height();
                let before = std::mem::replace(&mut self.panel.height, height);
                if !self.list_scrolls(height, viewer) {
                    // A list that hangs open keeps its place: scrolled under it, it would flip above its button.
                    let source = if self.list_is_open() {
                        ScrollSource::NONE
                    } else {
                        ScrollSource::ALL
                    };
                    let area = ScrollArea::vertical().id_salt("panel").auto_shrink(false);
                    let area = area.scroll_source(source);
                    area.show_viewport(ui, |ui, seen| {
                        self.settings(ui, viewer, asked);
                        // Scrolling to the scene would scroll the settings away.
                        self.scenes(ui, viewer, false, asked);
                        // A scene of the same list with less to say leaves the panel scrolled as far as it is.
                        let rest = seen.max.y - ui.min_rect().height();
                        if rest > 0.0 && (before - height).abs() < 0.5 && !self.panel.is_new {
                            ui.add_space(rest);
                        }
                    });
                    return;
                }
                look::beside_bar(ui, |ui| self.settings(ui, viewer, asked));
                self.scenes(ui, viewer, true, asked);
            });
        self.cover(ui, SizedPanel::Side, false, panel.response.rect);
    }

    /// Whether a panel of `height` points is so high that the list of scenes scrolls by itself.
    fn list_scrolls(&self, height: f32, viewer: &Viewer) -> bool {
        let settings = SETTINGS - if self.timed { 0.0 } else { TIMES };
        let report = if self.panel.reports { REPORT } else { 0.0 };
        height >= settings + self.panel.readings.height() + report + scenes::height(viewer).min(LEAST_LIST)
    }

    /// What lies above the scenes, as high for every scene. Its height.
    fn settings(&mut self, ui: &mut Ui, viewer: &Viewer, asked: &mut Asked) -> f32 {
        let top = ui.cursor().top();
        sampling::show(ui, viewer, &mut asked.commands);
        compare::offer(ui, viewer, &mut asked.commands);
        view_numbers::show(ui, viewer, &mut self.view, &mut asked.commands);
        ui.add_space(ui.spacing().item_spacing.y);
        document::timing(ui, viewer, self.timed);
        ui.cursor().top() - top
    }

    /// The scenes with their heading, and what there is to say about the current one: below the heading, whose arrows stay
    /// under the pointer. A list that scrolls by itself follows the current scene, and ends below a row.
    fn scenes(&mut self, ui: &mut Ui, viewer: &Viewer, own_scroll: bool, asked: &mut Asked) {
        ui.scope(|ui| {
            if own_scroll {
                ui.set_max_width(ui.available_width() - f32::from(look::BAR_ROOM));
            }
            scenes::title(ui, viewer, &mut asked.commands);
            let memory = &mut self.panel;
            if memory.readings.height() > 0.0 {
                // Its button must not hide in what scrolls.
                memory.readings.show(ui, viewer, &mut asked.commands);
            }
            if memory.reports {
                let room = match viewer.scene_list().scenes().len() {
                    1 if own_scroll => (ui.available_height() - scenes::all_rows(viewer)).max(REPORT),
                    1 => LONG_REPORT,
                    _ => REPORT,
                };
                report(ui, viewer, room);
            }
        });
        let mut requests = Wishes {
            follow: own_scroll,
            ..Wishes::default()
        };
        let thumbnails = &mut self.thumbnails;
        let mut list = |ui: &mut Ui| scenes::list(ui, viewer, thumbnails, &mut requests, &mut asked.commands);
        if own_scroll {
            let height = scenes::whole_rows(viewer, ui.available_height());
            let area = ScrollArea::vertical().id_salt("scenes").auto_shrink(false);
            area.max_height(height).show(ui, list);
        } else {
            list(ui);
        }
        asked.thumbnails.extend(requests.thumbnails);
    }
}

/// The reader's report, at most as high as there is `room`, and never lower than every scene of a list has it.
fn report(ui: &mut Ui, viewer: &Viewer, room: f32) {
    // A bar that is always to be seen tells that there is more.
    ui.spacing_mut().scroll = ScrollStyle {
        floating_width: 4.0,
        foreground_color: true,
        ..ScrollStyle::thin()
    };
    ui.scope(|ui| {
        let gap = ui.spacing().item_spacing.y;
        ui.set_min_height(REPORT - gap);
        ScrollArea::vertical()
            .id_salt("report")
            .auto_shrink([false, true])
            .max_height(room - gap)
            .show(ui, |ui| document::report(ui, viewer));
    });
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use egui::{Pos2, RawInput, Rect, vec2};

    use super::super::document::READINGS;
    use super::*;
    use crate::viewer::{AbCommand, Command, SceneCommand, ViewerOptions};

    /// Height of a part of the panel, which `lay_out` lays out.
    fn measured(mut lay_out: impl FnMut(&mut Interface, &mut Ui) -> f32) -> f32 {
        let mut interface = Interface::new(true);
        let ctx = interface.ctx().clone();
        let mut height = 0.0;
        // Fonts and sizes settle.
        for _ in 0..3 {
            let input = RawInput {
                screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(1000.0, 3000.0))),
                ..RawInput::default()
            };
            let mut output = ctx.run_ui(input, |ui| {
                let panel = Panel::right("side panel")
                    .exact_size(look::PANEL_WIDTH)
                    .frame(panel_frame(ui, look::scrolling_margin(4)));
                height = panel.show(ui, |ui| lay_out(&mut interface, ui)).inner;
            });
            output.textures_delta.clear();
        }
        height
    }

    fn viewer(paths: &[&str]) -> Viewer {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let options = ViewerOptions {
            paths: paths.iter().map(|path| root.join(path)).collect(),
            waker: Arc::new(|| {}),
            ..ViewerOptions::default()
        };
        let mut viewer = Viewer::new(options).expect("threads");
        viewer.finish();
        viewer
    }

    #[test]
    fn side_panel_knows_the_height_of_its_settings() {
        let mut viewer = viewer(&["svg/basic/test4.svg"]);
        let settings = |interface: &mut Interface, ui: &mut Ui, viewer: &Viewer| {
            look::beside_bar(ui, |ui| interface.settings(ui, viewer, &mut Asked::default()))
        };
        let whole = measured(|interface, ui| settings(interface, ui, &viewer));
        assert!(
            (SETTINGS - 6.0..=SETTINGS).contains(&whole),
            "{whole} points, not {SETTINGS}: all rows are shown"
        );
        let _ = viewer.apply(Command::Ab(AbCommand::Swap));
        viewer.finish();
        let meanwhile = measured(|interface, ui| settings(interface, ui, &viewer));
        assert!(
            (meanwhile - whole).abs() < 0.5,
            "{meanwhile} points: nothing moves when a comparison opens"
        );
        let height = measured(|_, ui| {
            ui.set_max_width(ui.available_width() - f32::from(look::BAR_ROOM));
            let top = ui.cursor().top();
            // The longest note takes two lines.
            crate::app::interface::controls::heading(ui, "Two readings");
            let _ = ui.button("The other reading");
            let note = "read as course, as other scenes of its folder are; as svg it is another picture";
            ui.label(egui::RichText::new(note).small());
            ui.cursor().top() - top
        });
        assert!(
            (READINGS - 12.0..=READINGS).contains(&height),
            "{height} points, not {READINGS}: the note and its button"
        );
    }

    #[test]
    fn side_panel_stays_as_high_while_scenes_are_read() {
        let settings = |viewer: &Viewer| {
            measured(|interface, ui| {
                ui.set_max_width(ui.available_width() - f32::from(look::BAR_ROOM));
                interface.settings(ui, viewer, &mut Asked::default())
            })
        };
        let near = |a: f32, b: f32| (a - b).abs() < 0.5;
        let mut viewer = viewer(&["svg/basic"]);
        let before = settings(&viewer);
        for _ in 0..viewer.scene_list().scenes().len() {
            let _ = viewer.apply(Command::Scenes(SceneCommand::Next));
            let meanwhile = settings(&viewer);
            assert!(
                near(meanwhile, before),
                "{meanwhile}, not {before} points: the arrows must stay under the pointer"
            );
            viewer.finish();
            let after = settings(&viewer);
            assert!(near(after, before), "{after}, not {before} points for another scene");
        }
    }

    #[test]
    fn side_panel_knows_the_height_of_the_scenes() {
        for paths in [&["svg/basic/test4.svg"][..], &["svg/basic"], &["svg"]] {
            let viewer = viewer(paths);
            let laid_out = measured(|interface, ui| {
                ui.set_max_width(ui.available_width() - f32::from(look::BAR_ROOM));
                let top = ui.cursor().top();
                interface.scenes(ui, &viewer, false, &mut Asked::default());
                ui.cursor().top() - top
            });
            let known = scenes::height(&viewer);
            assert!(
                (known - laid_out).abs() <= 6.0,
                "{paths:?}: {laid_out} points, not {known}"
            );
        }
    }
}
