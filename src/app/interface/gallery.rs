//! The page of all scenes: large pictures under the names of their folders, found by typing a part of a name.

use egui::{Context, Key, Modifiers, RichText, ScrollArea, Sense, Ui, vec2};

use super::dialogs::{ALL_SCENES, Dialogs};
use super::look;
use super::modal::{beside, modal};
use super::scenes::{self, Cell, Pictures, Wishes};
use crate::viewer::{Command, SceneCommand, Viewer, WindowCommand};

/// Width of a picture at least, in points; as many stand side by side as have room.
const LEAST_WIDTH: f32 = 148.0;
/// Height of a picture, and of the room for its name, in points.
const CELL: Cell = Cell {
    picture: 116.0,
    name: 30.0,
    name_lines: 2,
};
/// Between two pictures, in points.
const GAP: f32 = 8.0;
/// Width of the page at most, in points.
const WIDTH: f32 = 1000.0;
/// Height of what the page has besides its pictures, in points.
const REST: f32 = 120.0;

/// Height of the pictures in sight at least, in points: in a low window less than one.
const LEAST_HEIGHT: f32 = 64.0;

/// A folder with the scenes that were found in it, by rows.
type Group = (Option<String>, Vec<Vec<usize>>);

impl Dialogs {
    /// Shows all scenes. One is chosen by the mouse, by the arrows, or by typing a part of its name; returns those whose
    /// pictures are in sight and missing.
    pub(super) fn gallery(
        &mut self,
        ctx: &Context,
        viewer: &Viewer,
        just_opened: bool,
        commands: &mut Vec<Command>,
    ) -> Vec<usize> {
        let turn = arrows(ctx);
        let screen = ctx.content_rect();
        let mut wishes = Wishes::default();
        let modal = modal(ALL_SCENES).show(ctx, |ui| {
            let width = (screen.width() - 60.0).min(WIDTH);
            ui.set_width(width);
            ui.heading("Scenes");
            let enter = self.line(ui, "Scene", "part of a name or of a folder", just_opened);
            ui.add_space(2.0);
            let room = width - f32::from(look::BAR_ROOM);
            let columns = ((room + GAP) / (LEAST_WIDTH + GAP)).floor().max(1.0);
            let cell = ((room + GAP) / columns - GAP).floor();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
            let groups = found(viewer, &self.text, columns as usize);
            let rows: Vec<&Vec<usize>> = groups.iter().flat_map(|(_, rows)| rows).collect();
            if just_opened {
                self.chosen = viewer.scene_list().current_index();
            }
            let chosen = step(&rows, self.chosen, turn);
            let moves = just_opened || turn != Turn::default();
            self.chosen = chosen.unwrap_or(self.chosen);
            let mut taken = chosen.filter(|_| enter);
            let height = (screen.height() * 0.86 - REST).max(LEAST_HEIGHT);
            look::bars_beside(ui);
            // What another text finds begins at its beginning.
            let area = ScrollArea::vertical()
                .id_salt(("scenes", &self.text))
                .auto_shrink(false);
            area.max_height(height).min_scrolled_height(height).show(ui, |ui| {
                if groups.is_empty() {
                    ui.label(RichText::new("no scene of that name").weak());
                }
                let mut pictures = Pictures {
                    thumbnails: &mut self.thumbnails,
                    requests: &mut wishes,
                    cell: CELL,
                    chosen,
                };
                for (heading, rows) in &groups {
                    if let Some(heading) = heading {
                        ui.label(RichText::new(heading).strong());
                    }
                    for row in rows {
                        let clicked = row_of(ui, viewer, (row, cell), moves, &mut pictures);
                        taken = clicked.or(taken);
                    }
                    ui.add_space(GAP);
                }
            });
            if let Some(scene) = taken {
                let show = Command::Scenes(SceneCommand::Show(scene));
                commands.extend([Command::Window(WindowCommand::CloseDialog), show]);
            }
        });
        if beside(&modal.backdrop_response) {
            commands.push(Command::Window(WindowCommand::CloseDialog));
        }
        wishes.thumbnails
    }
}

/// Scenes beside each other, each so wide; which was clicked.
fn row_of(
    ui: &mut Ui,
    viewer: &Viewer,
    (row, width): (&[usize], f32),
    moves: bool,
    pictures: &mut Pictures<'_>,
) -> Option<usize> {
    let mut clicked = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        for scene in row {
            // Arrows choose it, and Tab stays with the line.
            let (rect, response) = ui.allocate_exact_size(vec2(width, CELL.height()), Sense::CLICK);
            if moves && pictures.chosen == Some(*scene) {
                response.scroll_to_me(None);
            }
            if ui.is_rect_visible(rect) && scenes::show_picture(ui, viewer, *scene, response, pictures) {
                clicked = Some(*scene);
            }
        }
    });
    clicked
}

/// The scenes whose labels hold every word of `text`, by folders and rows.
fn found(viewer: &Viewer, text: &str, columns: usize) -> Vec<Group> {
    let scenes = viewer.scene_list().scenes();
    let text = text.to_lowercase();
    let holds_all = |scene: &usize, heading: &str| {
        let label = format!("{heading}/{}", scenes[*scene].label).to_lowercase();
        text.split_whitespace().all(|word| label.contains(word))
    };
    let groups = scenes::groups(scenes).into_iter().filter_map(|(heading, range)| {
        let name = heading.as_deref().unwrap_or_default();
        let found: Vec<usize> = range.filter(|scene| holds_all(scene, name)).collect();
        let rows: Vec<Vec<usize>> = found.chunks(columns).map(<[usize]>::to_vec).collect();
        (!rows.is_empty()).then_some((heading, rows))
    });
    groups.collect()
}

/// Which arrows were pressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Turn {
    right: i32,
    down: i32,
}

/// Takes the arrows from the line of text, which needs none: what is typed here is short.
fn arrows(ctx: &Context) -> Turn {
    ctx.input_mut(|input| {
        let mut pressed = |key| i32::from(input.consume_key(Modifiers::NONE, key));
        let right = pressed(Key::ArrowRight) - pressed(Key::ArrowLeft);
        let down = pressed(Key::ArrowDown) - pressed(Key::ArrowUp);
        Turn { right, down }
    })
}

/// The scene that arrows lead to from `chosen`; the first where that was not found, none where nothing was.
fn step(rows: &[&Vec<usize>], chosen: usize, Turn { right, down }: Turn) -> Option<usize> {
    let all: Vec<usize> = rows.iter().copied().flatten().copied().collect();
    let Some(at) = all.iter().position(|scene| *scene == chosen) else {
        return all.first().copied();
    };
    let moved = |at: usize, by: i32, count: usize| at.saturating_add_signed(by as isize).min(count - 1);
    if down != 0 {
        let row = rows.iter().position(|row| row.contains(&chosen))?;
        let column = rows[row].iter().position(|scene| *scene == chosen)?;
        let row = rows[moved(row, down, rows.len())];
        return row.get(column).or(row.last()).copied();
    }
    all.get(moved(at, right, all.len())).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::ViewerOptions;

    #[test]
    fn arrows_lead_through_rows_of_several_folders() {
        let rows = [vec![0, 1, 2], vec![3], vec![4, 5]];
        let rows: Vec<&Vec<usize>> = rows.iter().collect();
        let go = |from, right, down| step(&rows, from, Turn { right, down }).expect("a scene");
        assert_eq!(
            [go(0, 1, 0), go(2, 1, 0), go(3, -1, 0)],
            [1, 3, 2],
            "on in reading order"
        );
        assert_eq!([go(0, -1, 0), go(5, 1, 0)], [0, 5], "the ends");
        assert_eq!([go(1, 0, 1), go(3, 0, 1), go(5, 0, -1)], [3, 4, 3], "the nearest below");
        assert_eq!([go(1, 0, -1), go(4, 0, 1)], [1, 4], "no row there");
        assert_eq!(go(9, 0, 0), 0, "the first where the chosen one was not found");
        assert_eq!(step(&[], 0, Turn::default()), None);
    }

    #[test]
    fn words_find_scenes_by_name_and_folder() {
        let viewer = Viewer::new(ViewerOptions::default()).expect("threads");
        let scenes = viewer.scene_list().scenes();
        let labels = |text: &str| -> Vec<&str> {
            let groups = found(&viewer, text, 4);
            assert!(
                groups.iter().all(|(heading, _)| heading.is_some()),
                "under their folders"
            );
            let rows = groups.into_iter().flat_map(|(_, rows)| rows);
            let rows: Vec<Vec<usize>> = rows.collect();
            assert!(rows.iter().all(|row| (1..=4).contains(&row.len())), "{rows:?}");
            rows.concat()
                .into_iter()
                .map(|scene| scenes[scene].label.as_str())
                .collect()
        };
        assert_eq!(labels("").len(), scenes.len(), "all");
        let zones = ["study/01_zone_plate.svg", "study/06_zone_texture.svg"];
        assert_eq!(labels("ZONE"), zones);
        assert_eq!(labels("zone study"), zones, "each word anywhere");
        assert!(labels("study").len() > 10 && labels("study").iter().all(|label| label.starts_with("study/")));
        assert!(labels("no such scene").is_empty());
    }
}
