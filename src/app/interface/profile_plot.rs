//! The plot of an edge profile: values over the distance along the line.

use egui::{
    Align2, Color32, FontId, Pos2, Rangef, Rect, Response, RichText, Sense, Shape, Stroke, Ui, Vec2, pos2, vec2,
};

use crate::compare::{Edge, ProfileChannel};
use crate::viewer::{ProfileCurve, ProfileSide, Viewer};

/// Room for the numbers on the left and below, in points.
const AXES: Vec2 = vec2(26.0, 15.0);
/// Pixels that are farther apart, in points, have dots.
const DOTS: f32 = 6.0;
/// Fewest levels that the plot spans, so that grain does not look like an edge.
const LEAST_LEVELS: f64 = 8.0;
/// Points between two numbers of an axis at least.
const BETWEEN: f32 = 30.0;

/// Whose a curve is.
pub(super) fn name(side: ProfileSide) -> &'static str {
    match side {
        ProfileSide::A => "A",
        ProfileSide::B => "B",
        ProfileSide::Truth => "truth",
    }
}

/// How its line looks: blue and orange, which colour-blind eyes tell apart (Okabe and Ito 2008), and a broad grey below them.
pub(super) fn stroke(side: ProfileSide, dark: bool) -> Stroke {
    let (width, on_dark, on_light) = match side {
        ProfileSide::A => (1.8, Color32::from_rgb(86, 180, 233), Color32::from_rgb(0, 114, 178)),
        ProfileSide::B => (1.8, Color32::from_rgb(230, 159, 0), Color32::from_rgb(213, 94, 0)),
        ProfileSide::Truth => (3.5, Color32::from_gray(126), Color32::from_gray(168)),
    };
    Stroke::new(width, if dark { on_dark } else { on_light })
}

/// The part of the plane that the plot shows.
#[derive(Clone, Copy, Debug)]
struct Axes {
    rect: Rect,
    /// First and last distance.
    along: [f64; 2],
    /// Least and most level.
    levels: [f64; 2],
}

/// Draws the curves, and a line of words below them. Returns the pixel that the pointer is over.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, curves: &[ProfileCurve], size: Vec2) -> Option<[u32; 2]> {
    let channel = viewer.profile().channel();
    let (response, painter) = ui.allocate_painter(size, Sense::hover());
    let rect = Rect::from_min_max(
        response.rect.min + vec2(AXES.x, 4.0),
        response.rect.max - vec2(4.0, AXES.y),
    );
    let axes = Axes::new(rect, curves, channel);
    painter.rect_filled(rect, 0.0, ui.visuals().extreme_bg_color);
    axes.grid(ui);
    let dark = ui.visuals().dark_mode;
    let own = curves.iter().find(|curve| curve.side == ProfileSide::A);
    let clipped = painter.with_clip_rect(rect.expand(2.0));
    let edge = own.and_then(|curve| curve.profile.edge(channel));
    if let Some(edge) = edge.filter(Edge::is_alone) {
        let weak = Stroke::new(1.0, ui.visuals().weak_text_color());
        for distance in edge.rise {
            let x = axes.x(distance);
            clipped.extend(Shape::dotted_line(
                &[pos2(x, rect.top()), pos2(x, rect.bottom())],
                weak.color,
                4.0,
                1.0,
            ));
        }
    }
    let below = curves.iter().filter(|curve| curve.side == ProfileSide::Truth);
    let above = curves.iter().filter(|curve| curve.side != ProfileSide::Truth).rev();
    for curve in below.chain(above) {
        let mut stroke = stroke(curve.side, dark);
        if !curve.is_final {
            stroke.color = stroke.color.gamma_multiply(0.5);
        }
        let points = axes.points(curve, channel);
        if axes.spacing(curve) > DOTS && curve.side != ProfileSide::Truth {
            for point in &points {
                clipped.circle_filled(*point, 2.2, stroke.color);
            }
        }
        clipped.line(points, stroke);
    }
    let hovered = hovered(ui, &response, &axes, own);
    below_plot(ui, viewer, curves, hovered);
    response.accessible_name("Values along the line");
    let at = own.zip(hovered).and_then(|(curve, i)| curve.profile.points().get(i));
    at.map(|point| point.at)
}

/// The number of the pixel whose place in the plot is nearest to the pointer, and a line there.
fn hovered(ui: &Ui, response: &Response, axes: &Axes, own: Option<&ProfileCurve>) -> Option<usize> {
    let at = response.hover_pos().filter(|at| axes.rect.expand(3.0).contains(*at))?;
    let away = |distance: f64| (axes.x(distance) - at.x).abs();
    let points = own?.profile.points().iter().enumerate();
    let (i, point) = points.min_by(|a, b| away(a.1.distance).total_cmp(&away(b.1.distance)))?;
    let ink = Stroke::new(1.0, ui.visuals().strong_text_color());
    ui.painter().vline(axes.x(point.distance), axes.rect.y_range(), ink);
    Some(i)
}

/// The line of words below the plot: the pixel that is pointed at, or where the line lies.
fn below_plot(ui: &mut Ui, viewer: &Viewer, curves: &[ProfileCurve], hovered: Option<usize>) {
    let channel = viewer.profile().channel();
    let words = match (hovered, viewer.profile().line()) {
        (Some(i), _) => {
            let point = curves.first().and_then(|curve| curve.profile.points().get(i));
            let place = point.map_or(String::new(), |point| {
                format!("{}, {}, at {:.1} px:", point.at[0], point.at[1], point.distance)
            });
            let value = |curve: &ProfileCurve| {
                // A curve that waits for its picture may be that of another line.
                let is_here = curve.profile.points().get(i).map(|point| point.at) == point.map(|point| point.at);
                let pixel = curve.profile.colors().get(i).filter(|_| is_here)?;
                Some(format!("{} {:.0}", name(curve.side), channel.value(*pixel)))
            };
            let values: Vec<String> = curves.iter().filter_map(value).collect();
            format!("{place} {}", values.join(", "))
        }
        (None, Some(line)) => {
            let [[a, b], [c, d]] = line.ends;
            format!("From {a}, {b} to {c}, {d}; drag its ends, or another line")
        }
        (None, None) => String::new(),
    };
    // Beside the plot, whose values a tool tip would hide.
    let tip = "Point at the plot for the values of a pixel, of which none is interpolated. Between the dotted lines is the width of \
               A's edge.";
    ui.label(RichText::new(words).small().weak()).on_hover_text(tip);
}

impl Axes {
    fn new(rect: Rect, curves: &[ProfileCurve], channel: ProfileChannel) -> Self {
        let ends = |values: &mut dyn Iterator<Item = f64>| {
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(value), high.max(value)]
            })
        };
        let mut distances = curves
            .iter()
            .flat_map(|curve| curve.profile.points().iter().map(|point| point.distance));
        let along = ends(&mut distances);
        let mut values = curves.iter().flat_map(|curve| curve.profile.values(channel));
        let [low, high] = ends(&mut values);
        // A line outside the frame has no pixels.
        let along = if along[0] <= along[1] { along } else { [0.0, 1.0] };
        let [low, high] = if low <= high { [low, high] } else { [0.0, 255.0] };
        let spare = ((LEAST_LEVELS - (high - low)) / 2.0).max((high - low) * 0.08);
        Self {
            rect,
            along: [along[0], along[1].max(along[0] + 1.0)],
            levels: [low - spare, high + spare],
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a part of the plot's width")]
    fn x(&self, distance: f64) -> f32 {
        let [first, last] = self.along;
        self.rect.left() + ((distance - first) / (last - first)) as f32 * self.rect.width()
    }

    #[expect(clippy::cast_possible_truncation, reason = "a part of the plot's height")]
    fn y(&self, level: f64) -> f32 {
        let [low, high] = self.levels;
        self.rect.bottom() - ((level - low) / (high - low)) as f32 * self.rect.height()
    }

    fn points(&self, curve: &ProfileCurve, channel: ProfileChannel) -> Vec<Pos2> {
        let values = curve.profile.values(channel);
        let points = curve.profile.points().iter().zip(values);
        points
            .map(|(point, value)| pos2(self.x(point.distance), self.y(value)))
            .collect()
    }

    /// Points from a pixel to the next.
    fn spacing(&self, curve: &ProfileCurve) -> f32 {
        let count = curve.profile.points().len().max(2) - 1;
        self.rect.width() / count as f32
    }

    /// Lines and numbers of both axes.
    fn grid(&self, ui: &Ui) {
        let painter = ui.painter();
        let line = Stroke::new(1.0, ui.visuals().widgets.noninteractive.bg_stroke.color);
        let ink = ui.visuals().weak_text_color();
        let text = |at: Pos2, align: Align2, text: String, color: Color32| {
            painter.text(at, align, text, FontId::proportional(10.0), color);
        };
        for level in ticks(
            [self.levels[0].max(0.0), self.levels[1].min(255.0)],
            self.rect.height() / BETWEEN * 1.5,
        ) {
            let y = self.y(level);
            painter.hline(self.rect.x_range(), y, line);
            text(
                pos2(self.rect.left() - 4.0, y),
                Align2::RIGHT_CENTER,
                format!("{level:.0}"),
                ink,
            );
        }
        let below = self.rect.bottom() + 2.0;
        // Between the number before and the unit.
        let mut free = Rangef::new(f32::NEG_INFINITY, self.rect.right() - 12.0);
        for distance in ticks(self.along, self.rect.width() / BETWEEN) {
            let x = self.x(distance);
            painter.vline(x, self.rect.y_range(), line);
            // Far away there is a line of a thousand million pixels, and its numbers are as long.
            let number = painter.layout_no_wrap(format!("{distance:.0}"), FontId::proportional(10.0), ink);
            let half = number.size().x.max(20.0) / 2.0;
            if free.min <= x - half && x + half <= free.max {
                free.min = x + half + 2.0;
                painter.galley(pos2(x - number.size().x / 2.0, below), number, ink);
            }
        }
        text(
            pos2(self.rect.right() + 3.0, below),
            Align2::RIGHT_TOP,
            "px".to_owned(),
            ink,
        );
    }
}

/// Round numbers between two, about as many as there is room for.
fn ticks([low, high]: [f64; 2], room: f32) -> Vec<f64> {
    let least = (high - low) / f64::from(room.max(1.0));
    let mut steps = (0..).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10_f64.powi(power)));
    let step = steps.find(|step| *step >= least || *step > 1e9).unwrap_or(1.0);
    let first = (low / step).ceil();
    let all = (0..64_u8).map(|i| (first + f64::from(i)) * step);
    all.take_while(|tick| *tick <= high).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(
            ticks([0.0, 40.0], 8.0),
            [0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0]
        );
        assert_eq!(ticks([13.0, 240.0], 4.0), [100.0, 200.0]);
        assert_eq!(ticks([3.0, 3.5], 5.0), [3.0], "whole numbers at least");
        assert_eq!(ticks([0.0, 1e300], 5.0).len(), 64, "any numbers");
        assert!(ticks([f64::NAN, 1.0], 5.0).is_empty(), "none");
    }
}
