//! Charts: series of labelled points over a logarithmic axis, for what costs time and what it is worth.

mod legend;
mod look;
mod unit;

use std::sync::LazyLock;

use glam::DVec2;
use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea as _};
use plotters::element::Text;
use plotters::style::{BLACK, Color as _, FontStyle, IntoFont as _, WHITE, register_font};

use self::legend::ChartLegend;
use self::look::{Look, draw_words};
use self::unit::{LETTERS, Unit};
use super::axis::{Axis, Scale};
use super::beside::Beside;
use super::lines::{Stroke, draw_line};
use super::{PixelRect, TextBlock, TextStyle};
use crate::plain;
use crate::raster::Framebuffer;

/// What fonts are called here.
const FONT: &str = "sans-serif";
/// Heights of letters in units: of the numbers of axes, and of the words beside points.
const NUMBERS: f64 = 1.15;
const WORDS: f64 = 1.05;
/// Around the chart, and below it for numbers and words, in units.
const MARGIN: f64 = 0.8;
const BELOW: f64 = 3.4;
/// Straight `0xAARRGGBB` of what is behind all.
const PAPER: u32 = 0xffff_ffff;

/// Whether the typeface is there; it is part of the program.
static READY: LazyLock<bool> =
    LazyLock::new(|| register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT).is_ok());

/// A chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Above it.
    pub title: String,
    /// What grows to the right, on a logarithmic scale, and what upwards.
    pub axes: [String; 2],
    /// Above the names of lines in the legend: what they say, such as `pixel sampling`. May be empty.
    pub heading: String,
    /// Lines through points, each with its name in the legend.
    pub series: Vec<PlotSeries>,
}

/// Points that belong together, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotSeries {
    /// In the legend; a single series without a name has none.
    pub name: String,
    /// Where, above zero to the right, and the words beside the point. Points that are not finite are named
    /// below the chart instead.
    pub points: Vec<([f64; 2], String)>,
}

impl Plot {
    /// The points that are not finite, which no axis reaches: their words, and the name of their series.
    fn left_out(&self) -> Vec<String> {
        let of_series = |series: &PlotSeries| {
            let words = series.points.iter().filter(|point| !is_shown(point));
            let words: Vec<&str> = words.map(|(_, words)| words.as_str()).collect();
            let words = (!words.is_empty()).then(|| words.join(", "))?;
            Some(match series.name.as_str() {
                "" => words,
                name => format!("{words} of {name}"),
            })
        };
        self.series.iter().filter_map(of_series).collect()
    }
}

/// Draws a chart on white, `size` pixels wide and high.
///
/// # Errors
/// When there is no point to show or no room for the chart; in words.
pub fn draw_plot(plot: &Plot, size: [u32; 2]) -> Result<Framebuffer, String> {
    if size[0] < 160 || size[1] < 120 || size.iter().any(|side| *side > Framebuffer::MAX_SIDE) {
        return Err(format!(
            "a chart of {} x {} pixels has no room; take 1200 x 800",
            size[0], size[1]
        ));
    }
    if !*READY {
        return Err("the typeface of charts cannot be read".to_owned());
    }
    let ranges = ranges(plot).ok_or("there is no point to show")?;
    let mut bytes = vec![0; size[0] as usize * size[1] as usize * 3];
    let unit = Unit::of_picture(size);
    let names: Vec<&str> = plot.series.iter().map(|series| series.name.as_str()).collect();
    let legend = ChartLegend::new((&plot.heading, &names), size, unit);
    let area = size[0] - legend.width();
    let places = draw_axes(plot, (ranges, area), size, &mut bytes).map_err(|error| error.to_string())?;
    let mut picture = Framebuffer::new(size[0], size[1]);
    for (pixel, rgb) in picture.pixels_mut().iter_mut().zip(bytes.chunks_exact(3)) {
        *pixel = u32::from_be_bytes([0xFF, rgb[0], rgb[1], rgb[2]]);
    }
    legend.draw(&mut picture, area);
    draw_points(plot, &places, &mut picture, unit);
    Ok(picture)
}

/// The points that can be shown.
fn shown(series: &PlotSeries) -> impl Iterator<Item = &([f64; 2], String)> {
    series.points.iter().filter(|point| is_shown(point))
}

fn is_shown((place, _): &([f64; 2], String)) -> bool {
    place.iter().all(|value| value.is_finite()) && place[0] > 0.0
}

/// What both axes span: all points, and some room for their words.
fn ranges(plot: &Plot) -> Option<[[f64; 2]; 2]> {
    let points = || plot.series.iter().flat_map(shown).map(|(point, _)| *point);
    let ends = |axis: usize| {
        points().fold(None, |ends: Option<[f64; 2]>, point| {
            let [low, high] = ends.unwrap_or([point[axis]; 2]);
            Some([low.min(point[axis]), high.max(point[axis])])
        })
    };
    let ([left, right], [low, high]) = (ends(0)?, ends(1)?);
    let factor = (right / left).powf(0.08).max(1.2);
    let spare = ((high - low) * 0.08).max(high.abs() * 1e-3).max(1e-9);
    // What cannot be below zero has no room there.
    let bottom = if low >= 0.0 {
        (low - spare).max(0.0)
    } else {
        low - spare
    };
    Some([[left / factor, right * factor * factor], [bottom, high + spare]])
}

type Problem<'b> = DrawingAreaErrorKind<<BitMapBackend<'b> as DrawingBackend>::ErrorType>;
type Area<'b> = DrawingArea<BitMapBackend<'b>, Shift>;

/// Where points are drawn, and where each point of each series lies, in pixels.
struct Places {
    inside: PixelRect,
    points: Vec<Vec<[i64; 2]>>,
}

/// Draws all but points and legend into rows of three bytes a pixel; the chart is `area` pixels wide.
fn draw_axes<'b>(
    plot: &Plot,
    (ranges, area): ([[f64; 2]; 2], u32),
    size: [u32; 2],
    bytes: &'b mut [u8],
) -> Result<Places, Problem<'b>> {
    let unit = Unit::of_picture(size);
    let root = BitMapBackend::with_buffer(bytes, (size[0], size[1])).into_drawing_area();
    root.fill(&WHITE)?;
    let left_out = plot.left_out();
    let note = if left_out.is_empty() { 0 } else { unit.px(2.0) };
    let (upper, lower) = root.split_vertically(size[1] - note);
    draw_note(&left_out, &lower, unit)?;
    // The legend is beside the chart, where no point can be.
    let (area, _) = upper.split_horizontally(area);
    let Axes {
        level,
        upright,
        beside,
        right,
    } = axes(ranges, area.dim_in_pixel(), unit);
    let title = plain::line(&plot.title);
    // A long name is small rather than cut off.
    let room = f64::from(area.dim_in_pixel().0) - unit.0 * 2.0;
    let letters = 1.5 * (room / unit.width(&title, 1.5).max(1.0)).min(1.0);
    let mut chart = ChartBuilder::on(&area)
        .margin(unit.px(MARGIN))
        .margin_right(right)
        .caption(title, (FONT, unit.px(letters).max(8)).into_font())
        .x_label_area_size(unit.px(BELOW))
        .y_label_area_size(beside)
        .build_cartesian_2d(level, upright)?;
    chart
        .configure_mesh()
        .light_line_style(BLACK.mix(0.0))
        .bold_line_style(BLACK.mix(0.12))
        .x_desc(format!("{} (logarithmic scale)", plot.axes[0]))
        .y_desc(&plot.axes[1])
        .label_style((FONT, unit.px(NUMBERS)).into_font())
        .axis_desc_style((FONT, unit.px(1.25)).into_font())
        .draw()?;
    let (x, y) = chart.plotting_area().get_pixel_range();
    let length = |range: &std::ops::Range<i32>| u32::try_from(range.end - range.start).unwrap_or(0);
    let inside = PixelRect {
        x: x.start.into(),
        y: y.start.into(),
        width: length(&x),
        height: length(&y),
    };
    let pixel = |(at, _): &([f64; 2], String)| {
        let (x, y) = chart.backend_coord(&(at[0], at[1]));
        [x.into(), y.into()]
    };
    let points = plot.series.iter().map(|series| shown(series).map(pixel).collect());
    let points = points.collect();
    root.present()?;
    Ok(Places { inside, points })
}

/// Both axes, and what they need beside the chart, in pixels.
struct Axes {
    level: Axis,
    upright: Axis,
    /// For the numbers of the upright one.
    beside: u32,
    /// To the right, for half of the last number of the level one.
    right: u32,
}

/// Both axes with the ticks that an area has room for.
fn axes([across, up]: [[f64; 2]; 2], (width, height): (u32, u32), unit: Unit) -> Axes {
    let high = f64::from(height) - unit.0 * (MARGIN * 2.0 + BELOW + 2.0);
    let upright = Axis::new(Scale::Even, up, |_, apart| apart * high >= unit.0 * NUMBERS * 2.0);
    let widest = upright.ticks().iter().map(|tick| unit.width(&tick.label, NUMBERS));
    let beside = widest.fold(0.0, f64::max) / unit.0 + 2.8;
    let wide = f64::from(width) - unit.0 * (MARGIN * 2.0 + beside);
    let level = Axis::new(Scale::Logarithmic, across, |two, apart| {
        let [one, other] = two.map(|tick| unit.width(&tick.label, NUMBERS) / 2.0);
        apart * wide >= one + other + unit.0
    });
    let beyond = level.ticks().last().map(|last| {
        let half = unit.width(&last.label, NUMBERS) / 2.0;
        half / unit.0 - (1.0 - level.part(last.at)) * wide / unit.0
    });
    Axes {
        level,
        upright,
        beside: unit.px(beside),
        right: unit.px(beyond.unwrap_or(0.0).max(0.0) + MARGIN),
    }
}

/// Lines through points, their words, and above all the points.
fn draw_points(plot: &Plot, places: &Places, picture: &mut Framebuffer, unit: Unit) {
    // The middle of the pixel, where upright lines are sharp.
    let middle = |[x, y]: [i64; 2]| DVec2::new(x as f64, y as f64) + 0.5;
    let series = || places.points.iter().enumerate();
    for (number, points) in series() {
        let points: Vec<DVec2> = points.iter().copied().map(middle).collect();
        Look::of_series(number).draw_line(picture, &points, unit.line());
    }
    let all = places.points.iter().flatten().copied();
    let mut beside = Beside::new(places.inside, all, unit.px(0.3));
    for (series, (number, points)) in plot.series.iter().zip(series()) {
        let color = Look::of_series(number).color;
        for ((_, words), at) in shown(series).zip(points) {
            let words = plain::line(words);
            let [ink, paper] =
                [color, PAPER].map(|color| TextBlock::new(&words, TextStyle::new(unit.letters(WORDS), color), None));
            let [width, height] = ink.size();
            let place @ [x, y] = beside.place(*at, [width, height]);
            // What is far from its point is led to it.
            let nearest = [
                at[0].clamp(x, x + i64::from(width)),
                at[1].clamp(y, y + i64::from(height)),
            ];
            let (from, to) = (middle(*at), middle(nearest));
            if width > 0 && from.distance(to) > unit.0 {
                let width = 1.0;
                draw_line(picture, from, to, Stroke { color, halo: 0, width });
            }
            draw_words(picture, [&ink, &paper], place);
        }
    }
    for (number, points) in series() {
        for at in points {
            Look::of_series(number).draw_mark(picture, middle(*at), unit.mark());
        }
    }
}

/// Names the points that no axis can reach.
fn draw_note<'b>(left_out: &[String], area: &Area<'b>, unit: Unit) -> Result<(), Problem<'b>> {
    if left_out.is_empty() {
        return Ok(());
    }
    let (width, _) = area.dim_in_pixel();
    let text = format!("infinite, and left out: {}", left_out.join("; "));
    let letters = f64::from(width) / unit.width("x", LETTERS);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small number above zero"
    )]
    let text = plain::short_line(&text, (letters as usize).saturating_sub(6).max(16));
    let font = (FONT, unit.px(LETTERS)).into_font();
    let (x, y) = (unit.px(MARGIN), unit.px(0.2));
    let place = [x, y].map(|at| i32::try_from(at).unwrap_or(0));
    area.draw(&Text::new(text, (place[0], place[1]), font))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: &[[f64; 2]]) -> Plot {
        Plot {
            title: "quality".to_owned(),
            axes: ["time".to_owned(), "error".to_owned()],
            heading: String::new(),
            series: vec![PlotSeries {
                name: "nearest".to_owned(),
                points: points.iter().map(|point| (*point, "4".to_owned())).collect(),
            }],
        }
    }

    #[test]
    fn plot_puts_points_where_they_belong() {
        let mut plot = plot(&[[1.0, 0.2], [10.0, 0.1], [100.0, 0.0]]);
        // A legend has the colour, too.
        plot.series[0].name.clear();
        let picture = draw_plot(&plot, [600, 400]).expect("a chart");
        let color = Look::of_series(0).color;
        let columns: Vec<usize> = (0..600)
            .filter(|x| (0..400).any(|y| picture.pixels()[y * 600 + x] == color))
            .collect();
        assert!(!columns.is_empty(), "the series' colour");
        let rows = |columns: std::ops::Range<usize>| {
            let all = columns.flat_map(|x| (0..400).map(move |y| (x, y)));
            all.filter(|(x, y)| picture.pixels()[y * 600 + x] == color)
                .map(|(_, y)| y)
                .collect::<Vec<_>>()
        };
        let last = columns[columns.len() - 1];
        assert!(last > columns[0] + 200, "from the first to the last point");
        let (left, right) = (rows(columns[0]..columns[0] + 6), rows(last - 5..last + 1));
        assert!(left.iter().min() < right.iter().min(), "errors fall to the right");
    }

    #[test]
    fn plot_hides_no_point_behind_its_legend() {
        // The best and the dearest are in the upper corners, and one point is in the middle of the right side.
        let mut plot = plot(&[[1.0, 0.2], [100.0, 0.2], [100.0, 0.1], [100.0, 0.05]]);
        plot.series[0].name = "pixel sampling bilinear, level sampling linear".to_owned();
        let picture = draw_plot(&plot, [900, 600]).expect("a chart");
        let color = Look::of_series(0).color;
        // Dots are the only squares of six pixels a side in the colour of the series.
        let is_dot =
            |x: usize, y: usize| (0..6).all(|i| (0..6).all(|j| picture.pixels()[(y + j) * 900 + x + i] == color));
        let mut dots: Vec<(usize, usize)> = Vec::new();
        for (x, y) in (0..600 - 6).flat_map(|y| (0..900 - 6).map(move |x| (x, y))) {
            if is_dot(x, y) && dots.iter().all(|(a, b)| x.abs_diff(*a) > 9 || y.abs_diff(*b) > 9) {
                dots.push((x, y));
            }
        }
        assert_eq!(dots.len(), 5, "with the one of the legend: {dots:?}");
    }

    #[test]
    fn plot_names_what_no_axis_reaches() {
        let mut finite = plot(&[[1.0, 40.0], [2.0, 41.0]]);
        assert!(finite.left_out().is_empty(), "all are there");
        let before = draw_plot(&finite, [600, 400]).expect("a chart");
        let infinite = ([3.0, f64::INFINITY], "256".to_owned());
        finite.series[0].points.push(infinite);
        assert_eq!(finite.left_out(), ["256 of nearest"], "with its series");
        let after = draw_plot(&finite, [600, 400]).expect("a chart");
        // Below the numbers, to the left of the words in the middle.
        let has_words = |picture: &Framebuffer| {
            let mut rows = picture.pixels().chunks(600).skip(400 - 18);
            rows.any(|row| row[..150].iter().any(|pixel| *pixel != 0xFFFF_FFFF))
        };
        assert!(!has_words(&before) && has_words(&after), "told below");
    }

    #[test]
    fn plot_lines_stay_among_their_points() {
        // There and back: a line that turns so sharply had a mitre of any length.
        let mut plot = plot(&[[1.0, 0.2], [100.0, 0.2], [1.02, 0.200_01], [100.0, 0.1]]);
        plot.series[0].name.clear();
        for (_, words) in &mut plot.series[0].points {
            words.clear();
        }
        let picture = draw_plot(&plot, [600, 400]).expect("a chart");
        let is_coloured = |pixel: u32| {
            let [_, r, _, b] = pixel.to_be_bytes();
            b > r.saturating_add(60)
        };
        let columns = (0..600).filter(|x| (0..400).any(|y| is_coloured(picture.pixels()[y * 600 + x])));
        let columns: Vec<usize> = columns.collect();
        let dot = |x: usize| (0..400).filter(|y| is_coloured(picture.pixels()[y * 600 + x])).count();
        let (first, last) = (columns[0], columns[columns.len() - 1]);
        assert_eq!(last - first + 1, columns.len(), "from the first to the last");
        // Both ends are dots, which begin and end less high than they are.
        assert!(first > 60 && last < 590, "inside the axes: {first}, {last}");
        assert!(dot(first + 3) > 4 && dot(last - 3) > 4, "dots at both ends");
    }

    #[test]
    fn plot_has_room_for_its_last_number() {
        for right in [0.016, 0.0158, 0.02, 0.0199] {
            let unit = Unit::of_picture([600, 400]);
            let Axes {
                level, beside, right, ..
            } = axes([[0.01, right], [0.0, 1.0]], (600, 400), unit);
            let last = level.ticks().last().expect("a number");
            let wide = f64::from(600 - beside - right) - unit.0 * MARGIN;
            let end = 600.0 - f64::from(right) - (1.0 - level.part(last.at)) * wide;
            assert!(
                end + unit.width(&last.label, NUMBERS) / 2.0 <= 600.0,
                "{last:?} at {end}"
            );
        }
    }

    #[test]
    fn plot_survives_any_numbers() {
        for points in [
            vec![[1.0, 0.0]],
            vec![[1e-9, 1e300], [1e9, -1e300]],
            vec![[0.0, 1.0], [f64::NAN, 1.0], [2.0, f64::INFINITY], [3.0, 1.0]],
            vec![[5.0, 7.0], [5.0, 7.0]],
        ] {
            assert!(draw_plot(&plot(&points), [300, 200]).is_ok(), "{points:?}");
        }
        assert!(draw_plot(&plot(&[]), [300, 200]).is_err(), "nothing to show");
        assert!(draw_plot(&plot(&[[1.0, 1.0]]), [3, 2]).is_err(), "no room");
    }
}
