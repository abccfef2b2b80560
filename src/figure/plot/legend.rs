//! The legend of a chart: what its lines are called, one below the other, each name whole.

use glam::DVec2;

use super::look::Look;
use super::unit::{INK, LETTERS, Unit};
use crate::figure::{Anchor, TextBlock, TextStyle};
use crate::plain;
use crate::raster::Framebuffer;

/// Room for a line before its name, and between rows, in units.
const LINE: f64 = 2.4;
const GAP: f64 = 0.4;
/// Around the legend, in units.
const MARGIN: f64 = 0.8;

/// Lines and their names, broken into rows that have room.
#[derive(Debug)]
pub(super) struct ChartLegend {
    heading: Option<TextBlock>,
    rows: Vec<(Look, TextBlock)>,
    /// Says how many lines there was no room for.
    more: Option<TextBlock>,
    width: u32,
    unit: Unit,
}

impl ChartLegend {
    /// The legend of the names of all series below their heading, beside a chart of this size; it takes a third of its width
    /// at most, and nothing where no series has a name.
    pub(super) fn new((heading, names): (&str, &[&str]), [width, height]: [u32; 2], unit: Unit) -> Self {
        let style = TextStyle::new(unit.letters(LETTERS), INK);
        let named = || names.iter().enumerate().filter(|(_, name)| !name.is_empty());
        let mut legend = Self {
            heading: None,
            rows: Vec::new(),
            more: None,
            width: 0,
            unit,
        };
        let longest = named().map(|(_, name)| whole_width(name, style)).max();
        let Some(longest) = longest else { return legend };
        let beside = unit.px(LINE + MARGIN);
        let wanted = longest.max(whole_width(heading, style).saturating_sub(unit.px(LINE)));
        let room = wanted.min((width / 3).saturating_sub(beside));
        legend.width = room + beside;
        if !heading.is_empty() {
            legend.heading = Some(TextBlock::new(&plain::line(heading), style, Some(room + unit.px(LINE))));
        }
        let block = |text: &str| TextBlock::new(&plain::line(text), style, Some(room));
        // What is left of the height, with a line for those that find no room.
        let mut left = height.saturating_sub(legend.top() + style.line_height() + unit.px(MARGIN));
        for (number, name) in named() {
            let name = block(name);
            let needed = name.size()[1] + unit.px(GAP);
            if needed > left {
                let missing = named().count() - legend.rows.len();
                legend.more = Some(block(&format!("and {missing} more")));
                break;
            }
            left -= needed;
            legend.rows.push((Look::of_series(number), name));
        }
        legend
    }

    /// Pixels that it takes of the chart's width.
    pub(super) fn width(&self) -> u32 {
        self.width
    }

    /// Where the first row begins.
    fn top(&self) -> u32 {
        let heading = self.heading.as_ref();
        self.unit.px(2.0) + heading.map_or(0, |heading| heading.size()[1] + self.unit.px(GAP))
    }

    /// Draws it from this column on.
    pub(super) fn draw(&self, picture: &mut Framebuffer, x: u32) {
        let unit = self.unit;
        let x = i64::from(x);
        if let Some(heading) = &self.heading {
            heading.draw(picture, [x, i64::from(unit.px(2.0))], Anchor::Left);
        }
        let names = x + i64::from(unit.px(LINE));
        let mut y = i64::from(self.top());
        for (look, name) in &self.rows {
            let [left, right] = [x as f64, names as f64 - unit.0 * 0.5];
            let middle = y as f64 + f64::from(TextStyle::new(unit.letters(LETTERS), INK).line_height()) / 2.0;
            let [from, to] = [left, right].map(|x| DVec2::new(x, middle));
            look.draw_line(picture, &[from, to], unit.line());
            look.draw_mark(picture, from.midpoint(to), unit.mark());
            name.draw(picture, [names, y], Anchor::Left);
            y += i64::from(name.size()[1] + unit.px(GAP));
        }
        if let Some(more) = &self.more {
            more.draw(picture, [names, y], Anchor::Left);
        }
    }
}

/// How wide a text is that is not broken.
fn whole_width(text: &str, style: TextStyle) -> u32 {
    TextBlock::new(&plain::line(text), style, None).size()[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn legend_of(names: &[&str]) -> ChartLegend {
        let size = [900, 600];
        ChartLegend::new(("pixel sampling, level sampling", names), size, Unit::of_picture(size))
    }

    #[test]
    fn legend_has_names_whole() {
        let long = "pixel sampling nearest, level sampling zero, resolve filter mitchell, sample rate 16";
        let legend = legend_of(&["nearest", long]);
        assert!(legend.width() <= 300, "beside a chart");
        let lines: Vec<&str> = legend.rows[1].1.lines().map(str::trim_end).collect();
        assert_eq!(lines.join(" "), long, "broken between words");
        let room = legend.width() - legend.unit.px(LINE + MARGIN);
        for (_, name) in &legend.rows {
            assert!(name.size()[0] <= room, "{name:?} in {room} pixels");
        }
        assert_eq!(legend_of(&["", ""]).width(), 0, "none where nothing has a name");
    }

    #[test]
    fn legend_says_what_it_has_no_room_for() {
        let names: Vec<String> = (0..60).map(|number| format!("line {number}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let legend = legend_of(&names);
        let more = legend.more.as_ref().expect("sixty lines");
        let told: Vec<&str> = more.lines().collect();
        assert_eq!(told, [format!("and {} more", 60 - legend.rows.len())], "the rest");
        assert!(legend.rows.len() > 10, "{} rows", legend.rows.len());
    }
}
