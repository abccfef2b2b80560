//! The panel of a comparison: what A and B are, how they share the window, how far they are apart.

use egui::{Button, DragValue, Layout, RichText, Sense, Ui, pos2, vec2};

use super::compare_numbers;
use super::controls::{choice, command_button, finite, gave_up, heading, row, tip};
use super::look::CONTROL;
use crate::color::{Colormap, ResolveSpace};
use crate::compare::{Gain, Guess, Measure};
use crate::viewer::{AbCommand, Against, Arrangement, Command, CommandSpec, Other, Toggle, Viewer, commands};

/// Height of the legend's colours, in points.
const LEGEND: f32 = 12.0;
/// What closing a comparison does.
const CLOSE_TIP: &str = "Forgets B. The settings of A stay as they are.";
/// Gains below this have more digits.
const SMALL_GAIN: f32 = 0.01;
/// Colours that the legend shows.
const LEGEND_STEPS: u16 = 120;

/// Fills the panel. The buttons come first and always lie in the same place; what grows, shrinks or comes and goes with
/// them is below.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    heading(ui, title(viewer));
    controls(ui, viewer, commands);
    details(ui, viewer, commands);
}

/// Which of both is in front.
pub(super) fn title(viewer: &Viewer) -> &'static str {
    if viewer.ab().is_swapped() {
        "B against A"
    } else {
        "A against B"
    }
}

/// The ways to a comparison, and what is always at hand of one that is open: the row stays in its place.
pub(super) fn offer(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    row(ui, "Compare", |ui| {
        let is_open = viewer.ab().other().is_some();
        ui.spacing_mut().button_padding.x = 2.0;
        let width = ((ui.available_width() - CONTROL.x) / 3.0 - 4.0).floor();
        let keep = if is_open { "swap" } else { "keep" };
        let ways = [("swap", keep), ("truth", "truth"), ("compare-picture", "file")];
        for (id, text) in ways {
            let size = vec2(width, CONTROL.y);
            let button = ui.add_sized(size, Button::new(text)).on_hover_text(tip(id));
            let name = commands::find(id).map_or(id, |spec| spec.name);
            if button.accessible_name(name).clicked() {
                run(id, commands);
            }
        }
        let close = ui.add_enabled(is_open, Button::new("\u{d7}").min_size(CONTROL));
        let close = close
            .on_hover_text(CLOSE_TIP)
            .on_disabled_hover_text("There is no B yet");
        let close = close.accessible_name("End the comparison");
        if close.clicked() {
            commands.push(Command::Ab(AbCommand::Compare(Against::Nothing)));
        }
    });
}

/// What can be done with A and B, in three rows.
pub(super) fn controls(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let others = [
            ("swap", "Swap"),
            ("truth", "Truth"),
            ("compare-picture", "Picture \u{2026}"),
        ];
        for (id, text) in others {
            if command_button(ui, id, text).clicked() {
                run(id, commands);
            }
        }
        let close = ui
            .add(Button::new("Forget B").min_size(CONTROL))
            .on_hover_text(CLOSE_TIP);
        if close.accessible_name("Close comparison").clicked() {
            commands.push(Command::Ab(AbCommand::Compare(Against::Nothing)));
        }
    });
    arrangement(ui, viewer, commands);
    next_difference(ui, viewer, commands);
}

/// What A and B are, and how far they are apart.
pub(super) fn details(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    if viewer.ab().arrangement() == Arrangement::Difference {
        difference(ui, viewer, commands);
    }
    what(ui, viewer, commands);
    compare_numbers::show(ui, viewer);
    guess(ui, viewer);
}

/// What A and B are, the one in front first.
fn what(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    ui.add_space(2.0);
    if let Some(Other::Truth(_)) = viewer.ab().other() {
        truth(ui, viewer.ab().truth_space(), commands);
    }
    let mut sides = viewer.ab().sides(viewer.settings()).unwrap_or_default();
    if viewer.ab().is_swapped() {
        sides.reverse();
    }
    // Without words there is nothing behind the letters.
    let differ = viewer
        .ab()
        .words(viewer.settings())
        .is_none_or(|words| !words.is_empty());
    for side in sides.into_iter().filter(|_| differ) {
        ui.label(RichText::new(side).small());
    }
    if let Some(path) = viewer.ab().loading_picture() {
        let text = format!("reading {} …", path.display());
        ui.label(RichText::new(text).small().weak());
    }
    if viewer
        .ab()
        .words(viewer.settings())
        .is_some_and(|words| words.is_empty())
    {
        let hint = "Both have the same settings: change one, and A shows it.";
        ui.label(RichText::new(hint).small().color(ui.visuals().warn_fg_color));
    }
}

/// In which values the truth averages its samples.
fn truth(ui: &mut Ui, current: Option<ResolveSpace>, commands: &mut Vec<Command>) {
    let tip = "In which values the 256 samples of the truth are averaged. \
               As A: what differs then is sampling alone, and no gamma.";
    let values = std::iter::once((None, "as A".to_owned()));
    let values = values.chain(ResolveSpace::ALL.map(|space| (Some(space), space.name().to_owned())));
    let values: Vec<_> = values.collect();
    row(ui, "Averages", |ui| {
        let chosen = choice(ui, "The truth averages", tip, current, &values);
        commands.extend(chosen.map(|space| Command::Ab(AbCommand::SetTruthSpace(space))));
    });
}

/// Runs a command of the table.
fn run(id: &str, commands: &mut Vec<Command>) {
    commands.extend(commands::find(id).and_then(CommandSpec::command));
}

fn arrangement(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let values = Arrangement::ALL.map(|value| {
        let name = match value {
            Arrangement::Alone if viewer.ab().is_swapped() => "B",
            Arrangement::Alone => "A",
            Arrangement::Difference => "diff",
            other => other.name(),
        };
        (value, name.to_owned())
    });
    let tips = [tip("wipe"), tip("side"), tip("difference"), tip("flip")].join("\n");
    commands.extend(
        choice(ui, "Show", &tips, viewer.ab().arrangement(), &values)
            .map(AbCommand::Arrange)
            .map(Command::Ab),
    );
}

/// Which difference, how strong, and what its colours mean.
fn difference(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    heading(ui, "Difference");
    let style = viewer.ab().difference_style();
    let values = Measure::ALL.map(|value| (value, value.name().to_owned()));
    let chosen = choice(ui, "Difference", &tip("difference"), style.measure, &values);
    commands.extend(chosen.map(AbCommand::SetMeasure).map(Command::Ab));
    let gain = viewer.ab().difference_gain().unwrap_or(1.0);
    let normalized = style.gain == Gain::Normalize;
    row(ui, "Gain", |ui| {
        let mut value = gain;
        let field = DragValue::new(&mut value)
            .range(1e-6..=1e6)
            .speed(f64::from(gain) * 0.01)
            .max_decimals(if gain < SMALL_GAIN { 8 } else { 3 })
            .custom_parser(finite)
            .prefix("× ");
        let layout = Layout::centered_and_justified(ui.layout().main_dir());
        let width = ui.available_width() - 2.0 * (CONTROL.x + 4.0);
        let shown = ui.allocate_ui_with_layout(vec2(width, CONTROL.y), layout, |ui| {
            let tip = format!("{}\ndrag, or click and type", tip("gain"));
            let response = ui.add(field.clip_text(true).update_while_editing(false));
            let is_taken = !gave_up(ui, &response);
            response.on_hover_text(tip).accessible_name("Gain");
            is_taken
        });
        #[expect(clippy::float_cmp, reason = "a number that nobody touched is the same one")]
        if shown.inner && value != gain {
            commands.push(Command::Ab(AbCommand::SetGain(value)));
        }
        for (id, text) in [("weaker-difference", "÷2"), ("stronger-difference", "×2")] {
            if command_button(ui, id, text).clicked() {
                run(id, commands);
            }
        }
    });
    row(ui, "", |ui| {
        let mut on = normalized;
        let response = ui.checkbox(&mut on, "to the largest").on_hover_text(tip("normalize"));
        if response.accessible_name("Normalise").changed() {
            commands.push(Command::Ab(AbCommand::Normalize(if on {
                Toggle::On
            } else {
                Toggle::Off
            })));
        }
    });
    legend(ui, style.measure, gain, normalized);
    if style.measure == Measure::Signed {
        let other = if viewer.ab().is_swapped() { "A" } else { "B" };
        let text = format!("blue: {other} is darker; orange: {other} is lighter");
        ui.label(RichText::new(text).small().weak());
    }
}

/// The colours from end to end with the numbers that they stand for.
fn legend(ui: &mut Ui, measure: Measure, gain: f32, normalized: bool) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), LEGEND), Sense::hover());
    let map = measure.colormap();
    let step = rect.width() / f32::from(LEGEND_STEPS);
    for index in 0..LEGEND_STEPS {
        let part = (f32::from(index) + 0.5) / f32::from(LEGEND_STEPS);
        let value = match map {
            Colormap::Diverging => 2.0 * part - 1.0,
            Colormap::Sequential => part,
        };
        let [_, r, g, b] = map.color(value).to_be_bytes();
        let left = rect.left() + f32::from(index) * step;
        // Half a point more, so that no line is between two colours.
        let piece = egui::Rect::from_min_max(pos2(left, rect.top()), pos2(left + step + 0.5, rect.bottom()));
        let piece = piece.intersect(rect);
        ui.painter().rect_filled(piece, 0.0, egui::Color32::from_rgb(r, g, b));
    }
    let numbers = measure.marks(gain, normalized);
    let ink = ui.visuals().weak_text_color();
    let (row, _) = ui.allocate_exact_size(vec2(rect.width(), 14.0), Sense::hover());
    let last = numbers.len() - 1;
    for (index, text) in numbers.into_iter().enumerate() {
        let (x, align) = match index {
            0 => (row.left(), egui::Align2::LEFT_CENTER),
            index if index == last => (row.right(), egui::Align2::RIGHT_CENTER),
            _ => (row.center().x, egui::Align2::CENTER_CENTER),
        };
        let font = egui::FontId::proportional(11.0);
        ui.painter().text(pos2(x, row.center().y), align, text, font, ink);
    }
}

/// Pins the pixel that differs most, then the next.
fn next_difference(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let count = viewer
        .both()
        .measures()
        .map_or(0, |(measures, _)| measures.places.len());
    ui.horizontal(|ui| {
        let button = ui.add_enabled(count > 0, Button::new("Next difference").min_size(CONTROL));
        let button = button.on_hover_text(tip("next-difference"));
        if button.accessible_name("Next difference").clicked() {
            commands.push(Command::Ab(AbCommand::NextDifference));
        }
        if let Some(index) = viewer.pixels().pinned_difference() {
            let place = format!("place {} of {count}", index + 1);
            ui.label(RichText::new(place).small().weak());
        }
    });
}

/// Why a picture from outside differs, as far as that can be told.
fn guess(ui: &mut Ui, viewer: &Viewer) {
    let Some((measures, is_current)) = viewer.both().measures() else {
        return;
    };
    let is_outside = matches!(viewer.ab().other(), Some(Other::Picture(_)));
    if !is_outside || measures.levels.differing() == 0 {
        return;
    }
    heading(ui, "Guess at the cause");
    let Some(guess) = measures.guess.as_ref().filter(|_| is_current) else {
        ui.label(RichText::new("trying …").weak());
        return;
    };
    if guess.stopped {
        let text = format!("stopped after {} s: not all was tried", Guess::BUDGET.as_secs());
        let tip = "Drawing takes long here. A picture with fewer pixels or samples is guessed at sooner.";
        ui.label(RichText::new(text).small().weak()).on_hover_text(tip);
    }
    if guess.causes.is_empty() {
        ui.label(if guess.stopped {
            "no cause was found until then"
        } else {
            "no known cause explains the difference"
        });
        return;
    }
    for cause in &guess.causes {
        ui.label(cause.to_string());
    }
    // Rounded down, so that 100 % means all of it.
    let percent = (guess.explained() * 1000.0).floor() / 10.0;
    let tip = "A was drawn under every known cause; these make it most like B.";
    let text = format!("explains {percent} % of the squared difference");
    ui.label(RichText::new(text).small().weak()).on_hover_text(tip);
    if guess.leaves_a_part() {
        let tip = "At most three causes are tried together.";
        let text = "others, or more at once, may do as well";
        ui.label(RichText::new(text).small().weak()).on_hover_text(tip);
    }
}
