//! Charts: series of labelled points over a logarithmic axis, for what costs time and what it is worth.

use std::sync::LazyLock;

use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea as _};
use plotters::element::{Circle, PathElement, Text};
use plotters::series::LineSeries;
use plotters::style::{BLACK, Color as _, FontStyle, IntoFont as _, RGBColor, ShapeStyle, WHITE, register_font};

use super::PixelRect;
use super::axis::{Axis, Scale};
use super::beside::Beside;
use crate::plain;
use crate::raster::Framebuffer;

/// What fonts are called here.
const FONT: &str = "sans-serif";
/// Heights of letters in units: of legend and notes, and of the numbers of axes.
const LETTERS: f64 = 1.1;
const NUMBERS: f64 = 1.15;
/// Around the chart, and below it for numbers and words, in units.
const MARGIN: f64 = 0.8;
const BELOW: f64 = 3.4;
/// Colours of series (M. Okabe, K. Ito, "Color Universal Design", 2008), the palest left out.
const COLORS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xB2),
    RGBColor(0xD5, 0x5E, 0x00),
    RGBColor(0x00, 0x9E, 0x73),
    RGBColor(0xCC, 0x79, 0xA7),
    RGBColor(0xE6, 0x9F, 0x00),
    RGBColor(0x56, 0xB4, 0xE9),
    RGBColor(0x40, 0x40, 0x40),
];

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
    draw(plot, ranges, size, &mut bytes).map_err(|error| error.to_string())?;
    let mut picture = Framebuffer::new(size[0], size[1]);
    for (pixel, rgb) in picture.pixels_mut().iter_mut().zip(bytes.chunks_exact(3)) {
        *pixel = u32::from_be_bytes([0xFF, rgb[0], rgb[1], rgb[2]]);
    }
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
type Chart<'c, 'b> = ChartContext<'c, BitMapBackend<'b>, Cartesian2d<Axis, Axis>>;

/// Pixels of units of letters, which keep their part of the picture.
#[derive(Clone, Copy)]
struct Unit(f64);

impl Unit {
    fn of_picture([width, height]: [u32; 2]) -> Self {
        let [width, height] = [width, height].map(|side| f64::from(side.min(Framebuffer::MAX_SIDE)));
        Self((width.min(height * 1.5) / 60.0).max(8.0))
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most a picture's side"
    )]
    fn px(self, units: f64) -> u32 {
        (self.0 * units).round().max(0.0) as u32
    }

    /// About how wide a text of this height is: a letter is about half as wide as high.
    fn width(self, text: &str, height: f64) -> f64 {
        self.0 * height * 0.55 * text.chars().count() as f64
    }
}

fn draw<'b>(plot: &Plot, ranges: [[f64; 2]; 2], size: [u32; 2], bytes: &'b mut [u8]) -> Result<(), Problem<'b>> {
    let unit = Unit::of_picture(size);
    let root = BitMapBackend::with_buffer(bytes, (size[0], size[1])).into_drawing_area();
    root.fill(&WHITE)?;
    let left_out = plot.left_out();
    let note = if left_out.is_empty() { 0 } else { unit.px(2.0) };
    let (upper, lower) = root.split_vertically(size[1] - note);
    draw_note(&left_out, &lower, unit)?;
    // Beside the chart, where no point can be.
    let (area, legend) = upper.split_horizontally(size[0] - legend_width(plot, unit.px(LETTERS), size[0]));
    draw_legend(plot, &legend, unit.px(LETTERS))?;
    let ([level, upright], beside) = axes(ranges, area.dim_in_pixel(), unit);
    let title = plain::line(&plot.title);
    // A long name is small rather than cut off.
    let room = f64::from(area.dim_in_pixel().0) - unit.0 * 2.0;
    let letters = 1.5 * (room / unit.width(&title, 1.5).max(1.0)).min(1.0);
    let mut chart = ChartBuilder::on(&area)
        .margin(unit.px(MARGIN))
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
    draw_points(plot, &mut chart, &upper, unit)?;
    root.present()
}

/// Both axes with the ticks that an area has room for, and the pixels beside the chart that the numbers of the upright one
/// take.
fn axes([across, up]: [[f64; 2]; 2], (width, height): (u32, u32), unit: Unit) -> ([Axis; 2], u32) {
    let high = f64::from(height) - unit.0 * (MARGIN * 2.0 + BELOW + 2.0);
    let upright = Axis::new(Scale::Even, up, |_, apart| apart * high >= unit.0 * NUMBERS * 2.0);
    let widest = upright.ticks().iter().map(|tick| unit.width(&tick.label, NUMBERS));
    let beside = widest.fold(0.0, f64::max) / unit.0 + 2.8;
    let wide = f64::from(width) - unit.0 * (MARGIN * 2.0 + beside);
    let level = Axis::new(Scale::Logarithmic, across, |two, apart| {
        let [one, other] = two.map(|tick| unit.width(&tick.label, NUMBERS) / 2.0);
        apart * wide >= one + other + unit.0
    });
    ([level, upright], unit.px(beside))
}

/// Lines through points, the points, and their words.
fn draw_points<'b>(plot: &Plot, chart: &mut Chart<'_, 'b>, area: &Area<'b>, unit: Unit) -> Result<(), Problem<'b>> {
    let radius = unit.px(0.3);
    let colored = || plot.series.iter().zip(COLORS.into_iter().cycle());
    for (series, color) in colored() {
        let line = ShapeStyle::from(color).stroke_width(unit.px(0.12).max(1));
        let places = || shown(series).map(|(at, _)| (at[0], at[1]));
        chart.draw_series(LineSeries::new(places(), line))?;
        chart.draw_series(places().map(|at| Circle::new(at, radius, ShapeStyle::from(color).filled())))?;
    }
    let (x, y) = chart.plotting_area().get_pixel_range();
    let length = |range: &std::ops::Range<i32>| u32::try_from(range.end - range.start).unwrap_or(0);
    let inside = PixelRect {
        x: x.start.into(),
        y: y.start.into(),
        width: length(&x),
        height: length(&y),
    };
    let pixel = |at: &[f64; 2]| {
        let (x, y) = chart.backend_coord(&(at[0], at[1]));
        [x.into(), y.into()]
    };
    let points = plot.series.iter().flat_map(shown).map(|(at, _)| pixel(at));
    let mut beside = Beside::new(inside, points, radius);
    for (series, color) in colored() {
        for (at, words) in shown(series) {
            let words = plain::line(words);
            let style = (FONT, unit.px(1.05)).into_font().color(&color);
            let (width, height) = area.estimate_text_size(&words, &style)?;
            let place = beside.place(pixel(at), [width, height]);
            let place = place.map(|place| i32::try_from(place).unwrap_or(0));
            area.draw(&Text::new(words, (place[0], place[1]), style))?;
        }
    }
    Ok(())
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

/// Pixels that the legend takes of a chart's width, for letters of this height; none where no series has a name.
fn legend_width(plot: &Plot, letters: u32, width: u32) -> u32 {
    let longest = plot.series.iter().map(|series| series.name.chars().count()).max();
    let longest = u32::try_from(longest.unwrap_or(0)).unwrap_or(u32::MAX);
    match longest {
        0 => 0,
        // A letter is about half as wide as high. A line before the name, and room around both.
        longest => (longest.saturating_mul(letters) / 2)
            .saturating_add(letters * 3)
            .min(width / 3),
    }
}

/// The names of series, one below the other, each after a line of its colour; how many there was no room for.
fn draw_legend<'b>(plot: &Plot, area: &Area<'b>, letters: u32) -> Result<(), Problem<'b>> {
    let (_, height) = area.dim_in_pixel();
    let room = (height / (letters * 3 / 2).max(1)).saturating_sub(3) as usize;
    let named = || {
        plot.series
            .iter()
            .zip(COLORS.into_iter().cycle())
            .filter(|(series, _)| !series.name.is_empty())
    };
    let letters = i32::try_from(letters).unwrap_or(16);
    let row = |index: usize| letters * 5 / 2 + i32::try_from(index).unwrap_or(0) * letters * 3 / 2;
    for (index, (series, color)) in named().take(room).enumerate() {
        let y = row(index);
        let style = ShapeStyle::from(color).stroke_width((letters.unsigned_abs() / 9).max(1));
        area.draw(&PathElement::new(
            [(0, y + letters / 2), (letters * 3 / 2, y + letters / 2)],
            style,
        ))?;
        area.draw(&Text::new(
            plain::line(&series.name).into_owned(),
            (letters * 2, y),
            (FONT, letters).into_font(),
        ))?;
    }
    if let Some(more) = named().count().checked_sub(room).filter(|more| *more > 0) {
        let words = format!("and {more} more");
        area.draw(&Text::new(words, (letters * 2, row(room)), (FONT, letters).into_font()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: &[[f64; 2]]) -> Plot {
        Plot {
            title: "quality".to_owned(),
            axes: ["time".to_owned(), "error".to_owned()],
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
        let [r, g, b] = [0x00, 0x72, 0xB2];
        let color = u32::from_be_bytes([0xFF, r, g, b]);
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
        let color = COLORS[0];
        let color = u32::from_be_bytes([0xFF, color.0, color.1, color.2]);
        // Dots are the only squares of six pixels a side in the colour of the series.
        let is_dot =
            |x: usize, y: usize| (0..6).all(|i| (0..6).all(|j| picture.pixels()[(y + j) * 900 + x + i] == color));
        let mut dots: Vec<(usize, usize)> = Vec::new();
        for (x, y) in (0..600 - 6).flat_map(|y| (0..900 - 6).map(move |x| (x, y))) {
            if is_dot(x, y) && dots.iter().all(|(a, b)| x.abs_diff(*a) > 9 || y.abs_diff(*b) > 9) {
                dots.push((x, y));
            }
        }
        assert_eq!(dots.len(), 4, "{dots:?}");
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
