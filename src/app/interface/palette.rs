//! What the command palette finds: commands, values of settings, and scenes.

use egui::{AtomExt as _, Button, Color32, Response, RichText, Sense, TextStyle, Ui};

use super::look::CONTROL;
use super::menu::capitalized;
use crate::viewer::{Command, CommandSpec, PictureSetting, SceneCommand, Viewer, commands, picture};

/// Height of an entry, and of the gap below it, in points.
pub(super) const ENTRY: f32 = CONTROL.y + 2.0;
pub(super) const BETWEEN_ENTRIES: f32 = 1.0;
/// Below this many letters only commands are found: nearly everything has them in its name.
const LEAST_LETTERS: usize = 2;

/// A line of the palette.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    /// What stands on the left.
    pub(super) name: String,
    /// Its keys, the form of its argument, or of what kind it is.
    note: String,
    /// What it does.
    pub(super) does: Does,
}

/// What choosing a line does.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Does {
    /// A command of the table, perhaps with an argument still to be typed.
    Command(&'static CommandSpec),
    /// This at once.
    Run(Command),
}

impl PartialEq for CommandSpec {
    /// No two of the table have the same word.
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Entry {
    fn of_command(spec: &'static CommandSpec) -> Self {
        let note = match spec.argument {
            Some(argument) if spec.keys.is_empty() => argument.usage().into_owned(),
            _ => spec.keys_text(),
        };
        Self {
            name: spec.name.to_owned(),
            note,
            does: Does::Command(spec),
        }
    }

    /// The line itself.
    pub(super) fn show(&self, ui: &mut Ui, chosen: bool) -> Response {
        // Where both do not fit, the end of what may follow gives way; that of the name only where it is longer than the line.
        let font = TextStyle::Button.resolve(ui.style());
        let name = ui.painter().layout_no_wrap(self.name.clone(), font, Color32::WHITE);
        let room = ui.available_width() - 2.0 * ui.spacing().button_padding.x;
        let note = RichText::new(&self.note).small().atom_shrink(name.size().x < room);
        let button = Button::selectable(chosen, &self.name).right_text(note).truncate();
        // Arrows choose it, whatever Tab does.
        let button = button.sense(Sense::CLICK);
        ui.add_sized([ui.available_width(), ENTRY], button)
            .accessible_name(&self.name)
    }
}

/// What the typed text may mean, best first, and what follows a command's word.
pub(super) fn find(text: &str, viewer: &Viewer) -> (String, Vec<Entry>) {
    let text = text.trim_start();
    let wanted = text.trim_end().to_lowercase();
    if let Some((spec, argument)) = with_argument(text) {
        // "Rotate l" is not 'Rotate by "l"'.
        let names_another = !argument.trim().is_empty() && begins_name(&wanted);
        if !names_another {
            return (argument.to_owned(), vec![Entry::of_command(spec)]);
        }
    }
    let mut found: Vec<(usize, Entry)> = commands::all()
        .iter()
        .filter_map(|spec| Some((rank(spec, &wanted)?, Entry::of_command(spec))))
        .collect();
    if wanted.chars().count() >= LEAST_LETTERS {
        let others = picture::all()
            .flat_map(|setting| values(setting, viewer))
            .chain(scenes(viewer));
        found.extend(others.filter_map(|entry| Some((rank_of_name(&entry.name, &wanted)?, entry))));
    }
    found.sort_by_key(|(rank, _)| *rank);
    (String::new(), found.into_iter().map(|(_, entry)| entry).collect())
}

/// The command whose word or name the text begins with, and what follows it.
fn with_argument(text: &str) -> Option<(&'static CommandSpec, &str)> {
    // A name may be written as options are: `sample-rate`.
    let after = |name: &str| {
        let (head, rest) = text.split_at_checked(name.len())?;
        let head = if name.contains(' ') {
            head.replace('-', " ")
        } else {
            head.to_owned()
        };
        let rest = rest.strip_prefix(char::is_whitespace)?;
        head.eq_ignore_ascii_case(name).then_some(rest)
    };
    let takes_one = commands::all().iter().filter(|spec| spec.argument.is_some());
    let mut found = takes_one.filter_map(|spec| {
        let name = spec.name.trim_end_matches([' ', '\u{2026}']);
        // A single word may as well be the first of what is looked for.
        let by_name = || after(name).filter(|_| name.contains(' '));
        // Of both the longer one is meant, which leaves less.
        let rest = [after(spec.id), by_name()].into_iter().flatten();
        Some((spec, rest.min_by_key(|rest| rest.len())?))
    });
    // Of two names the longer one is meant.
    let first = found.next()?;
    Some(found.fold(
        first,
        |best, next| if next.1.len() < best.1.len() { next } else { best },
    ))
}

/// Whether a command's name begins like this.
fn begins_name(wanted: &str) -> bool {
    commands::all()
        .iter()
        .any(|spec| spec.name.to_lowercase().starts_with(wanted))
}

/// The values of a setting that can be listed.
fn values(setting: &'static PictureSetting, viewer: &Viewer) -> impl Iterator<Item = Entry> {
    let now = setting.value(viewer.settings());
    let offered = setting.offered(viewer.settings());
    offered.into_iter().filter_map(move |value| {
        let change = setting.to(&value).ok()?;
        Some(Entry {
            name: format!("{}: {}", capitalized(setting.label), setting.short(&value)),
            note: if value == now { "set" } else { "setting" }.to_owned(),
            does: Does::Run(Command::Set(change)),
        })
    })
}

fn scenes(viewer: &Viewer) -> impl Iterator<Item = Entry> {
    let shown = viewer.scene_list().current_index();
    let scenes = viewer.scene_list().scenes().iter().enumerate();
    scenes.map(move |(index, entry)| Entry {
        name: format!("Scene {}", entry.label),
        note: if index == shown { "shown" } else { "scene" }.to_owned(),
        does: Does::Run(Command::Scenes(SceneCommand::Show(index))),
    })
}

/// How well a command fits what was typed: the lower the better, `None` not at all.
fn rank(spec: &CommandSpec, wanted: &str) -> Option<usize> {
    let name = spec.name.to_lowercase();
    if name == wanted || spec.id == wanted {
        return Some(0);
    }
    if name.starts_with(wanted) || spec.id.starts_with(wanted) || spec.sought_as.contains(&wanted) {
        return Some(1);
    }
    if name.contains(wanted) || spec.id.contains(wanted) {
        return Some(2);
    }
    let is_sought = || spec.sought_as.iter().any(|word| word.starts_with(wanted));
    if spec.help.to_lowercase().contains(wanted) || is_sought() {
        return Some(4);
    }
    // The letters in their order, with others between them.
    let mut letters = name.chars();
    wanted
        .chars()
        .all(|letter| letters.any(|other| other == letter))
        .then_some(5)
}

/// How well a name fits what was typed: all its words are there, best where the name has them as they were typed.
fn rank_of_name(name: &str, wanted: &str) -> Option<usize> {
    let name = name.to_lowercase();
    if name.contains(wanted) {
        return Some(2);
    }
    wanted.split_whitespace().all(|word| name.contains(word)).then_some(3)
}

#[cfg(test)]
mod tests {
    use egui::Context;

    use super::*;
    use crate::viewer::ViewerOptions;

    #[test]
    fn palette_breaks_no_name() {
        let ctx = Context::default();
        for width in [480.0, 320.0] {
            for spec in commands::all() {
                let mut output = ctx.run_ui(egui::RawInput::default(), |ui| {
                    ui.set_width(width);
                    Entry::of_command(spec).show(ui, false);
                });
                let named = output.shapes.iter().any(|clipped| match &clipped.shape {
                    egui::Shape::Text(text) => {
                        text.galley.text() == spec.name && text.galley.rows.len() == 1 && !text.galley.elided
                    }
                    _ => false,
                });
                output.textures_delta.clear();
                assert!(named, "{} in one line of {width} points", spec.name);
            }
        }
    }

    #[test]
    fn palette_grows_by_no_name() {
        let entry = Entry {
            name: "n".repeat(250),
            note: "scene".to_owned(),
            does: Does::Run(Command::Scenes(SceneCommand::Show(0))),
        };
        let mut taken = 0.0;
        Context::default()
            .run_ui(egui::RawInput::default(), |ui| {
                ui.set_width(480.0);
                taken = entry.show(ui, false).rect.width();
            })
            .textures_delta
            .clear();
        assert!(taken <= 480.0, "{taken} points");
    }

    #[test]
    fn palette_finds_more_than_commands() {
        let viewer = Viewer::new(ViewerOptions::default()).expect("threads");
        let names = |text: &str| -> Vec<String> {
            let (_, found) = find(text, &viewer);
            found.into_iter().map(|entry| entry.name).collect()
        };
        for (text, first) in [
            ("seam", "Scene study/05_seams.svg"),
            ("bilinear", "Pixel sampling: bilinear"),
            ("halton", "Pattern: halton"),
            ("six tasks", "Lesson: six tasks"),
            ("points", "Sample pattern by itself"),
            ("checker fan", "Scene study/08_checker_fan.svg"),
        ] {
            let found = names(text);
            assert_eq!(found.first().map(String::as_str), Some(first), "{text}: {found:?}");
        }
        for (text, name) in [
            ("keep", "Swap A and B"),
            ("fourier", "Spectrum"),
            ("moire", "Spectrum"),
            ("Moir\u{e9}", "Spectrum"),
            ("aliasing", "Spectrum"),
        ] {
            let found = names(text);
            assert!(found.iter().take(3).any(|known| known == name), "{text}: {found:?}");
        }
        let all = names("");
        assert_eq!(all.len(), commands::all().len(), "untyped, the commands only");
        let (argument, found) = find("rate 16", &viewer);
        assert_eq!(
            (argument.as_str(), found.len()),
            ("16", 1),
            "a command with its argument"
        );
        assert!(names("no such thing at all").is_empty(), "nothing");
        for spec in commands::all() {
            let found = names(spec.name);
            assert_eq!(
                found.first().map(String::as_str),
                Some(spec.name),
                "by its whole name: {found:?}"
            );
        }
        for (text, argument) in [
            ("Rotate by 33", "33"),
            ("rotate 33", "33"),
            ("seed of random patterns 7", "7"),
            ("Zoom by 3 100,100", "3 100,100"),
            ("Go to pixel 5,5", "5,5"),
            ("sample-rate 16", "16"),
            ("rate ", ""),
        ] {
            let (rest, found) = find(text, &viewer);
            assert_eq!((rest.as_str(), found.len()), (argument, 1), "{text}: {found:?}");
        }
        assert!(
            names("rotate l").contains(&"Rotate left".to_owned()),
            "the start of a name"
        );
    }
}
