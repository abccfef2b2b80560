//! The card of an edge profile: what A, B and the truth have along the line, and what is measured of it.
//!
//! ```text
//!    Edge profile                     x
//!    [ luma ] [ red ] [ green ] [ blue ]
//!    200 |        :     ____---         values over the distance along the line;
//!    100 |        :  _-'                between both dotted lines is the width of A's edge
//!      0 |____---'
//!        0      10      20      30 px
//!            shades  10-90 %  over  under
//!    - A          5  1.60 px   0 %    0 %
//! ```

use egui::{Align, Align2, Area, Button, Frame, Id, Layout, Order, Pos2, Rect, RichText, Sense, Ui, Vec2, vec2};

use super::board::told_of_all;
use super::controls::{choice, tip};
use super::corner::{APART, CardCorner, below_title, wide_enough};
use super::floating::things;
use super::focus::FocusPanel;
use super::look::CONTROL;
use super::profile_line::END;
use super::profile_plot;
use crate::compare::{Edge, ProfileChannel};
use crate::render::RenderSettings;
use crate::viewer::{Command, ProfileCommand, ProfileCurve, ProfileSide, Toggle, Viewer, picture};

/// Free space around the card, in points.
const MARGIN: f32 = 10.0;
/// Widths that its contents have at least and at most, in points.
const WIDTHS: [f32; 2] = [236.0, 340.0];
/// The same of the plot's heights.
const HEIGHTS: [f32; 2] = [64.0, 140.0];
/// What frame, title, values and the line below the plot take of the height, in points.
const BESIDES: f32 = 116.0;
/// Width of the card around its contents, in points.
const FRAME: f32 = 14.0;
/// Height of the title with what is around the card's contents, in points.
const HEAD: f32 = 46.0;
/// Height of a row of numbers, in points, and with the space below it.
const LINE: f32 = 16.0;
const ROW: f32 = 21.0;
/// Width of the names before the numbers, in points.
const NAMES: f32 = 60.0;
/// Width of the column of shades, in points.
const COUNTS: f32 = 46.0;
/// The same where columns are narrow: then the heads need it.
const NARROWER: [f32; 2] = [52.0, 38.0];
/// Width of the other columns from which on their numbers have units beside them, in points; else the heads name the units.
const WITH_UNITS: f32 = 58.0;
/// The heads of narrow columns.
const NARROW: [&str; 4] = ["shades", "10\u{2013}90 px", "over %", "under %"];
/// Pieces of the line that give way or are given way to, each by itself.
const PARTS: u8 = 32;
/// What the columns of numbers are.
const COLUMNS: [(&str, &str); 4] = [
    (
        "shades",
        "How many different colours the pixels on the line have. More of them make an edge smoother.",
    ),
    (
        "10\u{2013}90 %",
        "How far it is along the line from a tenth of the step to nine tenths, straight between pixels. From one pixel to \
         the next it is 0.8 pixels; a wide filter makes more.",
    ),
    (
        "over",
        "How far the lightest pixel on the line is above the lighter end, in parts of the step. Filters with weights below \
         zero ring.",
    ),
    (
        "under",
        "How far the darkest pixel on the line is below the darker end, in parts of the step. What would be below black is \
         black.",
    ),
];

/// Where the card is.
#[derive(Debug, Default)]
pub(super) struct ProfileCard {
    corner: CardCorner,
}

/// What the card and the line take, and what is pointed at.
#[derive(Clone, Debug, Default)]
pub(super) struct Shown {
    /// Where they lie, in points: other words give way.
    pub(super) taken: Vec<Rect>,
    /// Where the card alone is.
    pub(super) card: Option<Rect>,
    /// The pixel of the line that the pointer is over in the plot.
    pub(super) pixel: Option<[u32; 2]>,
}

impl ProfileCard {
    /// Shows it in a corner of what is `free`, beside the line.
    pub(super) fn show(&mut self, ui: &Ui, viewer: &Viewer, free: Rect, commands: &mut Vec<Command>) -> Shown {
        if !viewer.profile().is_open() {
            *self = Self::default();
            return Shown::default();
        }
        let curves = viewer.profile().curves();
        let free = wide_enough(free, WIDTHS[0] + FRAME + 2.0 * MARGIN, ui.ctx().content_rect());
        let room = free.shrink(MARGIN);
        let width = (free.width() * 0.4).clamp(WIDTHS[0], WIDTHS[1]);
        let height = (free.height() * 0.24).clamp(HEIGHTS[0], HEIGHTS[1]);
        let rows = (1 + curves.len()) as f32 * ROW;
        let hint = hint(&curves);
        let false_colors = false_colors(viewer);
        let size = if hint.is_some() {
            vec2(width + FRAME, 64.0)
        } else {
            let words = if false_colors.is_some() { ROW } else { 0.0 };
            vec2(width + FRAME, height + rows + words + BESIDES)
        };
        let corner = self.choose(ui, viewer, room, size);
        let mut pixel = None;
        let id = Id::unique("edge profile");
        let area = Area::new(id)
            .order(Order::Middle)
            .fixed_pos(corner.pos_in_rect(&room))
            .pivot(corner)
            .constrain_to(free)
            .fade_in(false)
            .show(ui.ctx(), |ui| {
                FocusPanel::Profile.head_of_area(ui, id);
                Frame::popup(ui.style()).show(ui, |ui| {
                    let sizes = [size, room.size()].map(|size| size - vec2(FRAME, HEAD));
                    ui.set_width(sizes[0].x.min(sizes[1].x));
                    head(ui, commands);
                    if let Some(hint) = hint {
                        ui.label(RichText::new(hint).small().weak());
                        return;
                    }
                    below_title(ui, sizes, |ui| {
                        channels(ui, viewer.profile().channel(), commands);
                        pixel = profile_plot::show(ui, viewer, &curves, vec2(width, height));
                        numbers(ui, &curves, viewer.profile().channel());
                        if let Some(words) = &false_colors {
                            ui.label(RichText::new(words).small().weak());
                        }
                    });
                });
            });
        self.corner.drawn(ui.ctx(), area.response.rect);
        let line = along(viewer, ui.pixels_per_point());
        // Each pane has its own.
        let pieces = line.chunks(usize::from(PARTS) + 1).flat_map(|line| line.windows(2));
        let line = pieces.map(|piece| Rect::from_two_pos(piece[0], piece[1]).expand(APART / 2.0));
        Shown {
            taken: line.chain([area.response.rect]).collect(),
            card: Some(area.response.rect),
            pixel,
        }
    }

    /// The corner where it lies, beside the line. Where it covers some of the line anywhere: where it leaves the ends free, which
    /// can be dragged, then where it covers least.
    fn choose(&mut self, ui: &Ui, viewer: &Viewer, room: Rect, size: Vec2) -> Align2 {
        let scale = ui.pixels_per_point();
        let line = along(viewer, scale);
        let things = things(viewer, scale);
        // It may be higher than was thought.
        let size = size.max(self.corner.drawn_size());
        self.corner.choose(size, room, |place| {
            let others = things.iter().filter(|other| other.intersects(place)).count();
            (hidden(&line, place), others)
        })
    }
}

/// How much of a line's pieces, as [`along`] has them, a card hides that needs this place with what is to be free around it: how
/// many ends, how many points itself, how many with what is around it.
fn hidden(line: &[Pos2], place: Rect) -> [usize; 3] {
    let card = place.shrink(APART);
    let inside = |rect: Rect| line.iter().filter(|at| rect.contains(**at)).count();
    let panes = line.chunks(usize::from(PARTS) + 1);
    let ends = panes.flat_map(|line| line.first().into_iter().chain(line.last()));
    let ends = ends.filter(|end| card.expand(END).contains(**end)).count();
    [ends, inside(card), inside(place)]
}

/// What false colours are measured; `None` where they are those of the scene.
fn false_colors(viewer: &Viewer) -> Option<String> {
    let (settings, ab) = (viewer.settings(), viewer.ab());
    let words = picture::false_colors(settings)?;
    let has_them = |other: RenderSettings| other.visualisation == settings.render.visualisation;
    let all = ab.other().is_none() || ab.other_settings(settings).is_some_and(has_them);
    Some(if all {
        told_of_all(&words)
    } else {
        format!("In A: {words}.")
    })
}

/// What is said where there is nothing to plot.
fn hint(curves: &[ProfileCurve]) -> Option<&'static str> {
    if curves.is_empty() {
        return Some("Drag a line across an edge in the picture. The wheel still zooms, and Esc ends this.");
    }
    let is_out = curves.iter().all(|curve| curve.profile.points().is_empty());
    is_out.then_some("The line is out of sight: it comes back with the view. Or drag another one.")
}

/// Places along the line in the window, in points: [`PARTS`] and one for each pane.
fn along(viewer: &Viewer, scale: f32) -> Vec<Pos2> {
    let places = viewer.profile().places();
    let points = places.iter().flat_map(|place| {
        let [from, to] = place.ends;
        (0..=PARTS).map(move |part| from.lerp(to, f64::from(part) / f64::from(PARTS)))
    });
    points.map(|at| super::profile_line::in_points(at, scale)).collect()
}

/// The title, and what closes the card.
fn head(ui: &mut Ui, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.label(RichText::new("Edge profile").strong())
            .on_hover_text(tip("profile"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let close = ui.add(Button::new("\u{d7}").min_size(CONTROL));
            let close = close.on_hover_text(
                "Ends drawing lines: a drag moves the picture again. The line comes back with the card.",
            );
            if close.accessible_name("Close the edge profile").clicked() {
                commands.push(Command::Profile(ProfileCommand::Show(Toggle::Off)));
            }
        });
    });
}

/// What of colours is plotted.
fn channels(ui: &mut Ui, current: ProfileChannel, commands: &mut Vec<Command>) {
    let values = ProfileChannel::ALL.map(|channel| (channel, channel.name().to_owned()));
    let tip =
        "What is plotted and measured: 0.299 R + 0.587 G + 0.114 B, or one of these. Stored values, on white paper.";
    let chosen = choice(ui, "Profile of", tip, current, &values);
    commands.extend(chosen.map(ProfileCommand::SetChannel).map(Command::Profile));
}

/// A row of numbers for each curve, and what is to be said of them.
fn numbers(ui: &mut Ui, curves: &[ProfileCurve], channel: ProfileChannel) {
    let columns = |[names, counts]: [f32; 2]| {
        let width = ((ui.available_width() - names - counts) / (COLUMNS.len() - 1) as f32).floor();
        [names, counts, width, width, width]
    };
    let is_narrow = columns([NAMES, COUNTS])[2] < WITH_UNITS;
    let widths = columns(if is_narrow { NARROWER } else { [NAMES, COUNTS] });
    let heads = if is_narrow {
        NARROW
    } else {
        COLUMNS.map(|(name, _)| name)
    };
    row(ui, widths, |_| {}, heads.map(|head| RichText::new(head).small().weak()));
    let edges: Vec<Option<Edge>> = curves.iter().map(|curve| curve.profile.edge(channel)).collect();
    for (curve, edge) in curves.iter().zip(&edges) {
        let percent = |part: f64| measure(part * 100.0, 1, if is_narrow { "" } else { " %" });
        // Of several edges the numbers are those of none.
        let alone = edge.filter(Edge::is_alone);
        let cells = [
            Some(curve.profile.shades().to_string()),
            alone.map(|edge| measure(edge.width(), 2, if is_narrow { "" } else { " px" })),
            alone.map(|edge| percent(edge.overshoot)),
            alone.map(|edge| percent(edge.undershoot)),
        ];
        let cells = cells.map(|cell| {
            let text = RichText::new(cell.unwrap_or_else(|| "\u{2013}".to_owned())).monospace();
            // Of another picture.
            if curve.is_final { text } else { text.weak().italics() }
        });
        row(ui, widths, |ui| sign(ui, curve.side), cells);
    }
    if let Some(note) = not_measured(curves, &edges, channel) {
        ui.label(RichText::new(note).small().color(ui.visuals().warn_fg_color));
    }
}

/// Why numbers are left out.
fn not_measured(curves: &[ProfileCurve], edges: &[Option<Edge>], channel: ProfileChannel) -> Option<String> {
    if edges.iter().any(Option::is_none) {
        let changes = curves.iter().any(|curve| curve.profile.changes_within(channel));
        let why = if changes {
            "No width, over or under where the first and the last quarter of the line are alike: let it begin and end farther from the edge."
        } else {
            "No width, over or under where both ends of the line are alike."
        };
        return Some(why.to_owned());
    }
    let more: Vec<(&str, &str)> = curves
        .iter()
        .zip(edges)
        .filter_map(|(curve, edge)| Some((profile_plot::name(curve.side), edge.as_ref()?.more_than_an_edge()?)))
        .collect();
    let (_, values) = more.first()?;
    let names: Vec<&str> = more
        .iter()
        .filter(|(_, other)| other == values)
        .map(|(name, _)| *name)
        .collect();
    Some(format!(
        "No width, over or under where values {values}: {}.",
        names.join(", ")
    ))
}

/// A number with its unit; one of three digits before the point has no more than one behind it, so that it fits its column.
fn measure(value: f64, digits: usize, unit: &str) -> String {
    let digits = if value < 99.95 { digits } else { digits - 1 };
    format!("{value:.digits$}{unit}")
}

/// A row of the table: whose it is, and its cells, each with its width and its column's tip.
fn row(ui: &mut Ui, [names, widths @ ..]: [f32; 5], first: impl FnOnce(&mut Ui), cells: [RichText; 4]) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let mut cell = |width: f32, layout: Layout, contents: &mut dyn FnMut(&mut Ui)| {
            ui.allocate_ui_with_layout(vec2(width, LINE), layout, |ui| {
                ui.set_min_size(vec2(width, LINE));
                contents(ui);
            });
        };
        let mut first = Some(first);
        cell(names, Layout::left_to_right(Align::Center), &mut |ui| {
            if let Some(first) = first.take() {
                first(ui);
            }
        });
        for ((text, (_, tip)), width) in cells.into_iter().zip(COLUMNS).zip(widths) {
            cell(width, Layout::right_to_left(Align::Center), &mut |ui| {
                ui.label(text.clone()).on_hover_text(tip);
            });
        }
    });
}

/// How a curve's line looks, and whose it is.
fn sign(ui: &mut Ui, side: ProfileSide) {
    let (rect, _) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
    let stroke = profile_plot::stroke(side, ui.visuals().dark_mode);
    ui.painter().hline(rect.x_range(), rect.center().y, stroke);
    ui.add_space(6.0);
    ui.label(profile_plot::name(side));
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn cards_rather_hide_some_of_a_line_than_its_ends() {
        let (from, to) = (pos2(100.0, 50.0), pos2(300.0, 50.0));
        let line: Vec<Pos2> = (0..=PARTS)
            .map(|part| from.lerp(to, f32::from(part) / f32::from(PARTS)))
            .collect();
        let over = |left: f32, right: f32| {
            let card = Rect::from_min_max(pos2(left, 0.0), pos2(right, 200.0));
            hidden(&line, card.expand(APART))
        };
        assert_eq!(over(320.0, 400.0), [0; 3], "beside it");
        assert!(over(120.0, 280.0) < over(290.0, 400.0), "most of it, and no end");
        assert!(over(303.0, 400.0) > over(307.0, 400.0), "the ring of an end");
        assert!(over(270.0, 290.0) < over(260.0, 290.0), "less of it");
    }
}
