//! Charts: series of labelled points over a logarithmic axis, for what costs time and what it is worth.

use std::sync::LazyLock;

use plotters::backend::BitMapBackend;
use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::coord::combinators::IntoLogRange as _;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea as _};
use plotters::element::{Circle, PathElement, Text};
use plotters::series::LineSeries;
use plotters::style::{BLACK, Color as _, FontStyle, IntoFont as _, RGBColor, ShapeStyle, WHITE, register_font};

use crate::plain;
use crate::raster::Framebuffer;

/// What fonts are called here.
const FONT: &str = "sans-serif";
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
    /// Where, above zero to the right, and the words beside the point. Points that are not finite are left out.
    pub points: Vec<([f64; 2], String)>,
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
    let is_shown = |point: &&([f64; 2], String)| point.0.iter().all(|value| value.is_finite()) && point.0[0] > 0.0;
    series.points.iter().filter(is_shown)
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

type Problem<'b> = DrawingAreaErrorKind<<BitMapBackend<'b> as plotters::backend::DrawingBackend>::ErrorType>;

fn draw<'b>(
    plot: &Plot,
    [[left, right], [low, high]]: [[f64; 2]; 2],
    size: [u32; 2],
    bytes: &'b mut [u8],
) -> Result<(), Problem<'b>> {
    let [width, height] = size.map(|side| f64::from(side.min(Framebuffer::MAX_SIDE)));
    // Letters keep their part of the picture.
    let unit = (width.min(height * 1.5) / 60.0).max(8.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most a picture's side"
    )]
    let px = |units: f64| (unit * units).round() as u32;
    let root = BitMapBackend::with_buffer(bytes, (size[0], size[1])).into_drawing_area();
    root.fill(&WHITE)?;
    // Beside the chart, where no point can be.
    let (area, legend) = root.split_horizontally(size[0] - legend_width(plot, px(1.1), size[0]));
    draw_legend(plot, &legend, px(1.1))?;
    let mut chart = ChartBuilder::on(&area)
        .margin(px(0.8))
        .caption(plain::line(&plot.title), (FONT, px(1.5)).into_font())
        .x_label_area_size(px(3.4))
        .y_label_area_size(px(5.0))
        .build_cartesian_2d((left..right).log_scale(), low..high)?;
    chart
        .configure_mesh()
        .light_line_style(BLACK.mix(0.0))
        .bold_line_style(BLACK.mix(0.12))
        .x_desc(&plot.axes[0])
        .y_desc(&plot.axes[1])
        .label_style((FONT, px(1.15)).into_font())
        .axis_desc_style((FONT, px(1.25)).into_font())
        .x_label_formatter(&|value| short(*value))
        .y_label_formatter(&|value| short(*value))
        .draw()?;
    for (series, color) in plot.series.iter().zip(COLORS.into_iter().cycle()) {
        let line = ShapeStyle::from(color).stroke_width(px(0.12).max(1));
        let points: Vec<&([f64; 2], String)> = shown(series).collect();
        let places = points.iter().map(|(at, _)| (at[0], at[1]));
        chart.draw_series(LineSeries::new(places, line))?;
        let dots = points
            .iter()
            .map(|(at, _)| Circle::new((at[0], at[1]), px(0.3), ShapeStyle::from(color).filled()));
        chart.draw_series(dots)?;
        let words = points.iter().map(|(at, words)| {
            let place = (at[0] * (right / left).powf(0.012), at[1] + (high - low) * 0.022);
            Text::new(words.clone(), place, (FONT, px(1.05)).into_font().color(&color))
        });
        chart.draw_series(words)?;
    }
    root.present()
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
fn draw_legend<'b>(plot: &Plot, area: &DrawingArea<BitMapBackend<'b>, Shift>, letters: u32) -> Result<(), Problem<'b>> {
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

/// A number with as many digits as a reader needs.
fn short(value: f64) -> String {
    let digits: usize = match value.abs() {
        size if size >= 10.0 || size == 0.0 => 0,
        size if size >= 1.0 => 1,
        size if size >= 0.1 => 2,
        size if size >= 0.01 => 3,
        _ => 4,
    };
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
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

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (0.05, "0.05"),
            (0.1, "0.1"),
            (2.5, "2.5"),
            (20.0, "20"),
            (1000.0, "1000"),
        ] {
            assert_eq!(short(value), text, "{value}");
        }
    }
}
