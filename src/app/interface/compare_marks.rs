//! What lies over the picture while A and B share the window: the line of the wipe, and which picture is which.

use std::sync::Arc;

use egui::text::LayoutJob;
use egui::{Align2, Color32, CursorIcon, FontId, Galley, Pos2, Rangef, Rect, Sense, Stroke, Ui, Vec2, pos2, vec2};

use super::compare_letters;
use super::floating::things;
use super::pin;
use super::places::insets;
use crate::figure::{Anchor, Tag};
use crate::viewer::{Arrangement, Viewer};

/// Space inside a tag, in points.
const PADDING: Vec2 = vec2(Tag::PADDING[0], Tag::PADDING[1]);
/// Part of the picture's height that a tag takes at most; what is left of its words becomes dots.
const MOST_HEIGHT: f32 = 0.3;
/// Radius of the line's handle, in points.
const HANDLE: f32 = 9.0;
/// Free space between the handle and the ring of a pin, in points.
const RING_GAP: f32 = 5.0;

/// What lies over the picture for A and B, in points.
#[derive(Debug, Default)]
pub(super) struct Marks {
    /// Letters and tags.
    pub(super) labels: Vec<Rect>,
    /// What the parts of the line of the wipe take, as wide as its handle.
    pub(super) line: Vec<Rect>,
    /// The handle of that line.
    pub(super) handle: Option<Rect>,
}

/// Draws line, letters and tags inside `free`, the tags where nothing is `taken`.
pub(super) fn show(ui: &Ui, viewer: &Viewer, free: Rect, taken: &[Rect]) -> Marks {
    let scale = ui.pixels_per_point();
    #[expect(clippy::cast_possible_truncation, reason = "inside the window")]
    let line = viewer.both().wipe_line().map(|line| line as f32 / scale);
    let line_place = line.map(|x| Rect::from_x_y_ranges(x - HANDLE..=x + HANDLE, free.y_range()));
    let letters = compare_letters::show(ui, viewer, free, line_place);
    let (mut drawn, mut handle) = (Vec::new(), None);
    let taken = [taken, &letters, &things(viewer, scale)].concat();
    if viewer.ab().arrangement() == Arrangement::Wipe {
        let Some(line) = line else {
            return Marks::default();
        };
        let before = [insets(viewer, scale), letters.clone()].concat();
        (drawn, handle) = draw_line(ui, viewer, free, line, &before);
    }
    let tags = viewer.both().tags([free.left(), free.right()], line);
    let tags = tags
        .into_iter()
        .map(|tag| Words::new(tag, ui, free))
        .collect::<Vec<_>>();
    // Side by side both lie as high, if that keeps both clear.
    let places: Vec<Option<Rect>> = tags.iter().map(|words| words.place(free, &taken)).collect();
    let lowest = places.iter().flatten().map(Rect::top).fold(f32::NEG_INFINITY, f32::max);
    let tags = tags.iter().zip(&places).filter_map(|(words, place)| {
        let place = (*place)?;
        let level = place.translate(vec2(0.0, lowest - place.top()));
        let is_free = free.contains_rect(level) && taken.iter().all(|other| !other.intersects(level));
        Some(words.show(ui, if is_free { level } else { place }))
    });
    Marks {
        labels: tags.chain(letters).collect(),
        line: drawn,
        handle,
    }
}

/// The line with its handle; the pointer tells that it can be dragged. It passes behind the insets, where no hand can
/// take it, and behind their letters. Returns what its parts take, and the handle.
fn draw_line(ui: &Ui, viewer: &Viewer, free: Rect, x: f32, insets: &[Rect]) -> (Vec<Rect>, Option<Rect>) {
    if viewer.pixels().over_line() {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    if !free.x_range().contains(x) {
        return (Vec::new(), None);
    }
    let painter = ui.painter();
    let pieces = free_pieces(free, x, insets);
    for (width, color) in [(4.0, Color32::from_black_alpha(150)), (2.0, Color32::WHITE)] {
        for piece in &pieces {
            painter.vline(x, *piece, Stroke::new(width, color));
        }
    }
    let rings: Vec<Rect> = pin::rings(viewer, ui.pixels_per_point()).collect();
    let handle = handle_place(&pieces, x, &rings);
    if let Some(handle) = handle {
        draw_handle(ui, handle.center());
    }
    let taken = pieces
        .into_iter()
        .map(|piece| Rect::from_x_y_ranges(x - HANDLE..=x + HANDLE, piece));
    (taken.collect(), handle)
}

/// Where the handle goes: the middle of the longest piece of the line, moved along the line where that would lie on the ring
/// of a pin.
fn handle_place(pieces: &[Rangef], x: f32, rings: &[Rect]) -> Option<Rect> {
    let longest = pieces.iter().copied().max_by(|a, b| a.span().total_cmp(&b.span()))?;
    let at = |y| Rect::from_center_size(pos2(x, y), Vec2::splat(2.0 * HANDLE));
    let middle = at(longest.center());
    let is_free = |handle: &Rect| rings.iter().all(|ring| !ring.expand(RING_GAP).intersects(*handle));
    let ends = rings.iter().flat_map(|ring| {
        let away = HANDLE + RING_GAP + 1.0;
        [ring.top() - away, ring.bottom() + away]
    });
    let mut places: Vec<Rect> = std::iter::once(middle).chain(ends.map(at)).collect();
    places.sort_by(|a, b| {
        let moved = |place: &Rect| (place.center().y - longest.center()).abs();
        moved(a).total_cmp(&moved(b))
    });
    let on_line = |place: &Rect| longest.contains(place.top()) && longest.contains(place.bottom());
    places.into_iter().find(|place| on_line(place) && is_free(place))
}

fn draw_handle(ui: &Ui, middle: Pos2) {
    let painter = ui.painter();
    painter.circle(
        middle,
        HANDLE,
        Color32::WHITE,
        Stroke::new(1.5, Color32::from_black_alpha(170)),
    );
    let ink = Stroke::new(1.5, Color32::from_gray(40));
    for side in [-1.0, 1.0] {
        let tip = middle + vec2(5.5 * side, 0.0);
        for up in [-3.0, 3.0] {
            painter.line_segment([tip, tip + vec2(-3.0 * side, up)], ink);
        }
    }
}

/// The parts of the vertical line at `x` that lie behind no inset, from above.
fn free_pieces(free: Rect, x: f32, insets: &[Rect]) -> Vec<Rangef> {
    let crosses = |inset: &&Rect| inset.x_range().contains(x);
    let mut behind: Vec<Rangef> = insets.iter().filter(crosses).map(Rect::y_range).collect();
    behind.sort_by(|a, b| a.min.total_cmp(&b.min));
    let mut pieces = Vec::new();
    let mut top = free.top();
    for inset in behind {
        pieces.push(Rangef::new(top, inset.min.min(free.bottom())));
        top = top.max(inset.max);
    }
    pieces.push(Rangef::new(top, free.bottom()));
    pieces.retain(|piece| piece.max > piece.min);
    pieces
}

/// The words up to the first that does not fit in a line, and dots for the others: none is broken but behind a hyphen.
fn whole_words(text: &str, fits: impl Fn(&str) -> bool) -> String {
    let fits = |word: &&str| word.split_inclusive('-').all(&fits);
    let words: Vec<&str> = text.split(' ').take_while(fits).collect();
    let words = words.join(" ");
    if words.len() == text.len() {
        words
    } else {
        format!("{words} \u{2026}")
    }
}

/// A tag over the picture in the window, in points.
struct Words {
    tag: Tag,
    /// All words in as many lines as a tag may have, unless it is too narrow for words; then their first letter.
    galleys: Vec<Arc<Galley>>,
}

impl Words {
    fn new(tag: Tag, ui: &Ui, free: Rect) -> Self {
        let font = FontId::proportional(12.0);
        let line = ui.fonts_mut(|fonts| fonts.row_height(&font));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
        let rows = (free.height() * MOST_HEIGHT / line) as usize;
        let whole = (tag.room >= Tag::LEAST_WORDS).then(|| {
            let width = |word: &str| {
                let galley = ui
                    .painter()
                    .layout_no_wrap(word.to_owned(), font.clone(), Color32::WHITE);
                galley.size().x
            };
            let text = whole_words(&tag.text, |word| width(word) <= tag.room);
            let mut job = LayoutJob::simple(text, font.clone(), Color32::WHITE, tag.room);
            job.wrap.max_rows = rows.max(2);
            ui.painter().layout_job(job)
        });
        let first = tag.text.chars().next().map(String::from).unwrap_or_default();
        let letter = ui.painter().layout_no_wrap(first, font, Color32::WHITE);
        Self {
            galleys: whole.into_iter().chain([letter]).collect(),
            tag,
        }
    }

    /// Where the tag goes, as high up as nothing is in its way: with its words, or with the letter where they have no room;
    /// `None` where there is not even room for that.
    fn place(&self, free: Rect, taken: &[Rect]) -> Option<Rect> {
        let align = if self.tag.anchor == Anchor::Right {
            Align2::RIGHT_TOP
        } else {
            Align2::LEFT_TOP
        };
        let fitting = self
            .galleys
            .iter()
            .filter(|galley| galley.size().x <= self.tag.room + 1.0);
        let mut places = fitting.map(|galley| {
            let top = pos2(self.tag.x, free.top() + Tag::MARGIN);
            let mut place = align.anchor_size(top, galley.size() + 2.0 * PADDING);
            while let Some(other) = taken.iter().find(|other| other.intersects(place)) {
                place = place.translate(vec2(0.0, other.bottom() + Tag::MARGIN - place.top()));
            }
            place
        });
        places.find(|place| free.contains_rect(*place))
    }

    /// Draws the words that are as large as `place` on a dark ground, and returns that.
    fn show(&self, ui: &Ui, place: Rect) -> Rect {
        let fits = |galley: &&Arc<Galley>| (galley.size() + 2.0 * PADDING - place.size()).length() < 1.0;
        if let Some(galley) = self.galleys.iter().find(fits) {
            ui.painter().rect_filled(place, 5.0, Color32::from_black_alpha(190));
            ui.painter()
                .galley(place.min + PADDING, Arc::clone(galley), Color32::WHITE);
            if galley.elided || galley.text() != self.tag.text {
                let id = ui.scope_id().with(("tag", &self.tag.text));
                ui.interact(place, id, Sense::hover()).on_hover_text(&self.tag.text);
            }
        }
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::interface::compare_letters::LETTER;
    use crate::app::interface::places::points;
    use crate::texture::PixelSampling;
    use crate::viewer::{AbCommand, InspectorCommand, WindowCommand};
    use crate::viewer::{Against, Command, PixelRect, Toggle, ViewerOptions};

    #[test]
    fn line_passes_behind_insets() {
        let free = Rect::from_min_max(pos2(0.0, 10.0), pos2(400.0, 310.0));
        let inset = |top, bottom| Rect::from_min_max(pos2(100.0, top), pos2(200.0, bottom));
        let insets = [inset(150.0, 200.0), inset(10.0, 100.0)];
        let pieces = |x| free_pieces(free, x, &insets);
        assert_eq!(pieces(50.0), [Rangef::new(10.0, 310.0)], "beside the insets");
        let expected = [Rangef::new(100.0, 150.0), Rangef::new(200.0, 310.0)];
        assert_eq!(pieces(150.0), expected, "between and below them");
        let all = [inset(0.0, 400.0)];
        assert!(free_pieces(free, 150.0, &all).is_empty(), "nothing is free");
    }

    #[test]
    fn words_of_tags_are_whole() {
        let shown = |text, longest| whole_words(text, |word| word.len() <= longest);
        let text = "B: the truth, pattern hammersley";
        assert_eq!(shown(text, 10), text, "all fit");
        assert_eq!(shown(text, 9), "B: the truth, pattern \u{2026}", "no half of a word");
        assert_eq!(shown("A: jittered-same", 9), "A: jittered-same", "hyphens part words");
    }

    #[test]
    fn tags_of_a_wipe_stay_on_their_sides() {
        let window = [800, 600];
        let options = ViewerOptions {
            window,
            ..ViewerOptions::default()
        };
        let mut viewer = Viewer::new(options).expect("threads");
        let _ = viewer.apply(Command::Ab(AbCommand::Compare(Against::Truth(None))));
        let (ctx, area) = (egui::Context::default(), points(&PixelRect::of_size(window), 1.0));
        for part in [0.06, 0.1, 0.2, 0.5, 0.8, 0.94] {
            let _ = viewer.apply(Command::Ab(AbCommand::SetWipe(part)));
            viewer.finish();
            let line = viewer.both().wipe_line().expect("a wipe");
            let mut places = Marks::default();
            let input = egui::RawInput {
                screen_rect: Some(area),
                ..egui::RawInput::default()
            };
            let mut output = ctx.run_ui(input, |ui| places = show(ui, &viewer, area, &[]));
            output.textures_delta.clear();
            let [a, b] = places.labels[..] else {
                panic!("{places:?} with the line at {line}");
            };
            assert!(f64::from(a.right()) <= line && area.contains_rect(a), "{a:?} of {line}");
            assert!(f64::from(b.left()) >= line && area.contains_rect(b), "{b:?} of {line}");
        }
    }

    #[test]
    fn letters_and_tags_never_overlap() {
        let window = [800, 600];
        let options = ViewerOptions {
            window,
            ..ViewerOptions::default()
        };
        let mut viewer = Viewer::new(options).expect("threads");
        let mut free = PixelRect::of_size(window);
        free.height -= 26;
        for command in [
            Command::Window(WindowCommand::SetFreeArea(Some(free))),
            Command::Ab(AbCommand::Compare(Against::Settings)),
            // Side by side, B's tag ends where the letter of an inset in the upper right corner stands.
            Command::set("pixel-sampling", PixelSampling::Bilinear.name()).expect("a value"),
            Command::Inspector(InspectorCommand::Explanation(Toggle::Off)),
        ] {
            assert!(viewer.apply(command).is_empty(), "nothing to do");
        }
        viewer.finish();
        let (ctx, area) = (egui::Context::default(), points(&free, 1.0));
        let mut letters = 0;
        for arrangement in [Arrangement::Wipe, Arrangement::SideBySide, Arrangement::Difference] {
            for pin in [
                [20, 30],
                [20, 540],
                [380, 30],
                [380, 540],
                [300, 200],
                [780, 30],
                [780, 540],
            ] {
                for command in [
                    Command::Ab(AbCommand::Arrange(arrangement)),
                    Command::Inspector(InspectorCommand::Pin(pin)),
                ] {
                    assert!(viewer.apply(command).is_empty(), "nothing to do");
                }
                let mut places = Marks::default();
                let input = egui::RawInput {
                    screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(800.0, 600.0))),
                    ..egui::RawInput::default()
                };
                let mut output = ctx.run_ui(input, |ui| places = show(ui, &viewer, area, &[]));
                output.textures_delta.clear();
                let places = places.labels;
                letters += places
                    .iter()
                    .filter(|place| place.size() == Vec2::splat(LETTER))
                    .count();
                for (index, place) in places.iter().enumerate() {
                    let beside = places[..index].iter().all(|other| !other.intersects(*place));
                    assert!(beside, "{places:?} with {pin:?} in {arrangement:?}");
                }
            }
        }
        assert!(letters > 20, "{letters} letters");
    }
}
