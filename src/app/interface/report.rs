//! Sections and lines of a report.

use std::collections::BTreeMap;

use egui::collapsing_header::CollapsingState;
use egui::text::{LayoutJob, TextFormat};
use egui::{CollapsingHeader, CollapsingResponse, Context, FontId, Id, Response, RichText, Ui};

/// Letters of the report, in points.
const SIZE: f32 = 12.0;

/// Width of a letter that is as wide as all others, in its sizes; a little more than that.
const MONOSPACE: f32 = 0.62;

/// Sections that the user folded (`false`) or unfolded, by their names.
pub(in crate::app) type Sections = BTreeMap<String, bool>;

/// Where egui keeps the sections.
fn sections_id() -> Id {
    Id::unique("folded sections")
}

/// What the user folded and unfolded.
pub(super) fn sections(ctx: &Context) -> Sections {
    ctx.data(|data| data.get_temp(sections_id())).unwrap_or_default()
}

/// Sections begin as they were left.
pub(super) fn set_sections(ctx: &Context, sections: Sections) {
    ctx.data_mut(|data| data.insert_temp(sections_id(), sections));
}

/// A part of a report that can be folded: `open` at first, then as the user left it.
pub(super) fn section(ui: &mut Ui, id: &str, title: &str, open: bool, contents: impl FnOnce(&mut Ui)) {
    let left = |ui: &Ui| {
        ui.data_mut(|data| {
            let sections: &mut Sections = data.get_temp_mut_or_default(sections_id());
            sections.get(id).copied()
        })
    };
    let section = CollapsingHeader::new(RichText::new(title).size(12.0))
        .id_salt(id)
        .default_open(left(ui).unwrap_or(open))
        .show(ui, contents);
    let header = &section.header_response;
    if header.clicked()
        && let Some(state) = CollapsingState::load(ui.ctx(), header.id)
    {
        ui.data_mut(|data| {
            let sections: &mut Sections = data.get_temp_mut_or_default(sections_id());
            sections.insert(id.to_owned(), state.is_open());
        });
    }
    bring_into_sight(ui, &section);
}

/// What a click unfolds below the last visible line comes into sight while it grows, as far as it fills the lower half: the
/// title stays under the pointer where it can, so that another click folds it again.
pub(super) fn bring_into_sight<R>(ui: &Ui, section: &CollapsingResponse<R>) {
    let (header, grows) = (&section.header_response, section.openness < 1.0);
    let opens = || CollapsingState::load(ui.ctx(), header.id).is_some_and(|state| state.is_open());
    if let Some(body) = &section.body_response
        && (header.clicked() || grows)
        && opens()
    {
        let mut wanted = header.rect.union(body.rect);
        wanted.max.y = wanted.max.y.min(header.rect.bottom() + ui.clip_rect().height() / 2.0);
        ui.scroll_to_rect(wanted, None);
    }
}

/// Whether a line is numbers, or percentages, and nothing else: a row of a table.
fn is_row(line: &str) -> bool {
    let mut words = line.split_whitespace();
    words.clone().count() > 1 && words.all(|word| word.trim_end_matches('%').parse::<f64>().is_ok())
}

/// Lines of the report. What stands before a gap is a name, and drawn weaker than what it names.
pub(super) fn lines(ui: &mut Ui, lines: &[String]) -> Response {
    /// Longest name, in bytes.
    const NAME: usize = 18;
    let (weak, normal) = (ui.visuals().weak_text_color(), ui.visuals().text_color());
    let mut job = LayoutJob::default();
    let mut append = |text: &str, font: FontId, color| {
        let format = TextFormat {
            line_height: Some(SIZE + 4.5),
            ..TextFormat::simple(font, color)
        };
        job.append(text, 0.0, format);
    };
    // Rows of numbers keep their columns, in letters that are small enough.
    let longest = lines.iter().filter(|line| is_row(line)).map(String::len).max();
    let width = ui.available_width() / longest.unwrap_or(1) as f32;
    let of_rows = FontId::monospace((width / MONOSPACE).clamp(SIZE / 2.0, SIZE - 1.0));
    for (i, line) in lines.iter().enumerate() {
        if i > 0 {
            append("\n", FontId::proportional(SIZE), normal);
        }
        if is_row(line) {
            append(line, of_rows.clone(), normal);
            continue;
        }
        let mut add = |text: &str, color| append(text, FontId::proportional(SIZE), color);
        match line
            .trim_start()
            .split_once("  ")
            .filter(|(name, _)| name.len() <= NAME)
        {
            Some((name, value)) => {
                add(name, weak);
                add("   ", weak);
                add(value.trim_start(), normal);
            }
            None => add(line.trim_start(), normal),
        }
    }
    ui.label(job)
}
