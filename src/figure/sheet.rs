//! Sheets: panels in a grid with what differs above and beside them, a caption below, on light or dark ground.
//!
//! ```text
//!            header   header   header
//!  row label  panel    panel    panel
//!  row label  panel    panel    panel
//!  legend
//!  caption, as wide as the sheet
//! ```
//!
//! All lengths follow from the width of the panels, so that a sheet of any size reads the same when it is printed equally
//! wide: at 16 cm the text has 8 points.

use super::paint::{copy, fill, outer};
use super::{Anchor, PixelRect, TextBlock, TextStyle, draw_legend};
use crate::raster::Framebuffer;
use crate::render::Legend;

/// Width of a sheet that fills a page: 16 cm at 300 dots per inch.
pub const PAGE_WIDTH: u32 = 1890;
/// The width of all panels over the size of text.
const TEXT_PER_WIDTH: f32 = 54.0;
/// Smallest and largest text, in pixels.
const TEXT_SIZE: std::ops::RangeInclusive<f32> = 11.0..=160.0;
/// Width of the row labels, in text sizes.
const LABEL_WIDTH: f32 = 6.0;
/// Room between panels, in text sizes.
const GAP: f32 = 0.6;
/// Most pixels of a sheet.
const MAX_PIXELS: u64 = 64 << 20;

/// Ground and ink of a sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ground {
    /// Dark ink on white, for print.
    #[default]
    Light,
    /// Light ink on black, for slides.
    Dark,
}

impl Ground {
    /// Every value.
    pub const ALL: [Self; 2] = [Self::Light, Self::Dark];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Light => "light",
            Self::Dark => "dark",
        }
    }

    /// Opaque `0xAARRGGBB` behind everything.
    pub const fn color(self) -> u32 {
        match self {
            Self::Light => 0xffff_ffff,
            Self::Dark => 0xff14_1619,
        }
    }

    /// Of the text.
    pub const fn ink(self) -> u32 {
        match self {
            Self::Light => 0xff18_1c20,
            Self::Dark => 0xffec_ebe6,
        }
    }

    /// Of the lines around panels.
    const fn rule(self) -> u32 {
        match self {
            Self::Light => 0xffa8_acb0,
            Self::Dark => 0xff5a_5e64,
        }
    }
}

/// What a sheet says, and the size of its panels.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetPlan {
    /// Width and height of every panel.
    pub panel: [u32; 2],
    /// What stands above the columns; as many as there are columns.
    pub columns: Vec<String>,
    /// What stands beside the rows, empty where nothing does; as many as there are rows.
    pub rows: Vec<String>,
    /// What stands above each panel instead of the columns, row by row; empty where the columns say it all.
    pub headers: Vec<String>,
    /// What stands below.
    pub caption: String,
    /// Width and height of a legend above the caption.
    pub legend: Option<[u32; 2]>,
    /// Light or dark.
    pub ground: Ground,
}

/// Where everything of a sheet goes.
#[derive(Debug)]
pub struct SheetLayout<'a> {
    plan: &'a SheetPlan,
    size: [u32; 2],
    style: TextStyle,
    gap: u32,
    /// Left edge of the first column.
    left: u32,
    /// Height of what stands above panels: of the first row, and of the others.
    header_heights: [u32; 2],
    caption: TextBlock,
    /// Upper edges of the panels' rows, then that of the legend, then that of the caption.
    tops: Vec<u32>,
}

impl SheetPlan {
    /// The side of square panels with which a sheet of `columns` columns is as wide as a page.
    pub fn page_panel(columns: u32, labelled: bool) -> u32 {
        let columns = columns.max(1);
        // Margins, labels and gaps are measured in text sizes, and so are the panels.
        let label = if labelled { LABEL_WIDTH } else { 0.0 };
        let gaps = (columns - 1) as f32 * GAP;
        let size = PAGE_WIDTH as f32 / (TEXT_PER_WIDTH + 2.0 + label + gaps);
        (whole(size * TEXT_PER_WIDTH) / columns).max(1)
    }

    /// Where everything goes.
    ///
    /// # Errors
    /// One line when the sheet is larger than a picture may be.
    pub fn layout(&self) -> Result<SheetLayout<'_>, String> {
        let [columns, rows] =
            [self.columns.len(), self.rows.len()].map(|count| u32::try_from(count).unwrap_or(u32::MAX));
        let [width, height] = self.panel.map(u64::from);
        let least = [width * u64::from(columns), height * u64::from(rows)];
        let too_large = |[width, height]: [u64; 2]| {
            let side = u64::from(Framebuffer::MAX_SIDE);
            (width > side || height > side || width * height > MAX_PIXELS).then(|| {
                format!(
                    "the sheet would have {width}x{height} pixels; more than {side} a side or {} million in all are too many: give \
                     a smaller --size or fewer values",
                    MAX_PIXELS >> 20
                )
            })
        };
        if let Some(problem) = too_large(least) {
            return Err(problem);
        }
        let size = text_size(self.panel[0] * columns);
        let style = TextStyle::new(size, self.ground.ink());
        let (margin, gap) = (whole(size), whole(size * GAP));
        let labelled = self.rows.iter().any(|label| !label.is_empty());
        let left = margin + if labelled { whole(size * LABEL_WIDTH) } else { 0 };
        let whole_width = left + columns * (self.panel[0] + gap) - gap.min(columns * gap) + margin;
        let mut layout = SheetLayout {
            plan: self,
            size: [whole_width, 0],
            style,
            gap,
            left,
            header_heights: [0; 2],
            caption: TextBlock::new(&self.caption, style, Some(whole_width - 2 * margin)),
            tops: Vec::new(),
        };
        layout.place(margin);
        match too_large(layout.size.map(u64::from)) {
            Some(problem) => Err(problem),
            None => Ok(layout),
        }
    }
}

impl SheetLayout<'_> {
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Fills in all heights.
    fn place(&mut self, margin: u32) {
        let plan = self.plan;
        let tallest = |texts: &[String]| {
            let heights = texts
                .iter()
                .filter(|text| !text.is_empty())
                .map(|text| self.header(text).size()[1]);
            heights.max().unwrap_or(0)
        };
        self.header_heights = if plan.headers.is_empty() {
            [tallest(&plan.columns), 0]
        } else {
            [tallest(&plan.headers); 2]
        };
        let mut top = margin;
        for row in 0..plan.rows.len() {
            top += self.header_heights[usize::from(row > 0)];
            self.tops.push(top);
            top += plan.panel[1] + self.gap;
        }
        self.tops.push(top);
        if let Some([_, height]) = plan.legend {
            top += height + self.gap;
        }
        self.tops.push(top);
        self.size[1] = top + self.caption.size()[1] + margin;
    }

    fn header(&self, text: &str) -> TextBlock {
        TextBlock::new(text, self.style, Some(self.plan.panel[0]))
    }

    /// What stands beside the rows: in smaller letters where a word would have to be broken.
    fn labels(&self) -> Vec<TextBlock> {
        /// Of the usual size.
        const SMALLEST: f32 = 0.8;
        let width = self.style.size * (LABEL_WIDTH - GAP);
        let words = self.plan.rows.iter().flat_map(|text| text.split_inclusive([' ', '-']));
        let widest = words
            .map(|word| self.style.advance_of(word.trim_end()))
            .fold(width - 1.0, f32::max);
        let style = TextStyle {
            // Down to whole pixels and a little less: a word that fits exactly is broken where sums are rounded otherwise.
            size: self.style.size * ((width - 1.0) / widest).clamp(SMALLEST, 1.0),
            ..self.style
        };
        let label = |text: &String| TextBlock::new(text, style, Some(whole(width)));
        self.plan.rows.iter().map(label).collect()
    }

    /// Left edge of a column.
    fn column(&self, column: usize) -> u32 {
        let column = u32::try_from(column).unwrap_or(0);
        self.left + column * (self.plan.panel[0] + self.gap)
    }

    /// Where the panel with this number goes, row by row.
    fn panel(&self, number: usize) -> PixelRect {
        let columns = self.plan.columns.len().max(1);
        PixelRect {
            x: self.column(number % columns).into(),
            y: self.tops.get(number / columns).copied().unwrap_or(0).into(),
            width: self.plan.panel[0],
            height: self.plan.panel[1],
        }
    }

    /// Draws the sheet: `panels` row by row, and the legend.
    pub fn draw(&self, panels: &[&Framebuffer], legend: Option<&Framebuffer>) -> Framebuffer {
        let [width, height] = self.size;
        let mut sheet = Framebuffer::new(width, height);
        fill(&mut sheet, &PixelRect::of_size(self.size), self.plan.ground.color());
        for (number, panel) in panels.iter().enumerate() {
            let place = self.panel(number);
            fill(&mut sheet, &outer(&place), self.plan.ground.rule());
            put(&mut sheet, panel, [place.x, place.y]);
            if let Some(text) = self.plan.headers.get(number) {
                self.draw_header(&mut sheet, text, &place);
            }
        }
        if self.plan.headers.is_empty() {
            for (number, text) in self.plan.columns.iter().enumerate() {
                self.draw_header(&mut sheet, text, &self.panel(number));
            }
        }
        for (row, label) in self.labels().iter().enumerate() {
            let y = i64::from(self.tops[row]) + (i64::from(self.plan.panel[1]) - i64::from(label.size()[1])) / 2;
            label.draw(&mut sheet, [whole(self.style.size).into(), y], Anchor::Left);
        }
        let [.., below, caption] = self.tops.as_slice() else {
            return sheet;
        };
        if let Some(legend) = legend {
            put(&mut sheet, legend, [self.left.into(), i64::from(*below)]);
        }
        let margin = whole(self.style.size).into();
        self.caption
            .draw(&mut sheet, [margin, i64::from(*caption)], Anchor::Left);
        sheet
    }

    /// What stands above a panel: in the middle, its last line next to the panel.
    fn draw_header(&self, sheet: &mut Framebuffer, text: &str, panel: &PixelRect) {
        let block = self.header(text);
        let top = panel.y - i64::from(block.size()[1]) - i64::from(self.gap / 8);
        block.draw(sheet, [panel.x + i64::from(panel.width / 2), top], Anchor::Center);
    }
}

/// Puts a picture over the sheet; what is not opaque lets its ground through, what lies outside is left out.
fn put(sheet: &mut Framebuffer, picture: &Framebuffer, [x, y]: [i64; 2]) {
    let place = PixelRect {
        x,
        y,
        width: picture.width(),
        height: picture.height(),
    };
    let shown = place.intersection(&PixelRect::of_size([sheet.width(), sheet.height()]));
    let width = sheet.width() as usize;
    for row in shown.y..shown.bottom() {
        for column in shown.x..shown.right() {
            let [from_x, from_y, to_x, to_y] =
                [column - x, row - y, column, row].map(|side| usize::try_from(side).unwrap_or(0));
            let pixel = picture.pixels()[from_y * picture.width() as usize + from_x];
            let target = &mut sheet.pixels_mut()[to_y * width + to_x];
            *target = super::paint::blend(*target, pixel, 1.0);
        }
    }
}

/// Legends side by side, in rows no wider than `width` where they fit, on `ground`; `None` for none. Their text is a little
/// smaller than that of a sheet with panels of this `width`.
pub fn draw_legends(legends: &[Legend], width: u32, ground: Ground) -> Option<Framebuffer> {
    /// Text of a legend of size 1.
    const LEGEND_TEXT: f32 = 13.0;
    let size = text_size(width);
    let drawn: Vec<Framebuffer> = legends
        .iter()
        .map(|legend| draw_legend(legend, size * 0.85 / LEGEND_TEXT))
        .collect();
    let gap = whole(size * GAP);
    let (mut places, mut corner, mut row) = (Vec::new(), [0; 2], 0);
    for legend in &drawn {
        if corner[0] > 0 && corner[0] + legend.width() > width {
            corner = [0, corner[1] + row + gap];
            row = 0;
        }
        places.push(corner);
        corner[0] += legend.width() + gap;
        row = row.max(legend.height());
    }
    let ends = places.iter().zip(&drawn).map(|([x, _], legend)| x + legend.width());
    let size = [ends.max()?, corner[1] + row].map(|side| side.min(Framebuffer::MAX_SIDE));
    let mut all = Framebuffer::new(size[0], size[1]);
    all.pixels_mut().fill(ground.color());
    for ([x, y], legend) in places.into_iter().zip(&drawn) {
        copy(legend, &mut all, [x.into(), y.into()]);
    }
    Some(all)
}

/// The size of text on a sheet whose panels side by side have this width.
fn text_size(width: u32) -> f32 {
    let size = width as f32 / TEXT_PER_WIDTH;
    size.max(*TEXT_SIZE.start()).min(*TEXT_SIZE.end())
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates; lengths are not negative"
)]
fn whole(length: f32) -> u32 {
    length.round() as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::SamplePattern;

    #[test]
    fn limits_are_those_of_the_help_page() {
        let page = include_str!("../cli/help/figures.md").replace('\n', " ");
        let (millions, side) = (MAX_PIXELS >> 20, Framebuffer::MAX_SIDE);
        let line = format!("at most {millions} million pixels and {side} a side");
        assert!(page.contains(&line), "{line}");
    }

    fn plan(columns: usize, rows: usize, panel: [u32; 2]) -> SheetPlan {
        SheetPlan {
            panel,
            columns: (0..columns).map(|i| format!("sample rate {i}")).collect(),
            rows: (0..rows).map(|i| format!("pixel sampling {i}")).collect(),
            headers: Vec::new(),
            caption: "What all of it shows, in a line that is broken to the width of the sheet.".to_owned(),
            legend: None,
            ground: Ground::Light,
        }
    }

    #[test]
    fn labels_break_no_pattern_in_a_word() {
        for columns in 1..5 {
            let side = SheetPlan::page_panel(columns, true);
            let mut plan = plan(columns as usize, 1, [side; 2]);
            for pattern in SamplePattern::ALL {
                plan.rows = vec![format!("pattern {}", pattern.name())];
                let layout = plan.layout().expect("small");
                let label = &layout.labels()[0];
                let whole: Vec<&str> = plan.rows[0].split_inclusive([' ', '-']).map(str::trim_end).collect();
                // Several parts of a name may share a line.
                let is_broken = |word: &&str| !word.split_inclusive('-').all(|part| whole.contains(&part));
                let broken = label.lines().flat_map(|line| line.split(' ')).find(is_broken);
                assert_eq!(broken, None, "{label:?} beside {columns} columns");
            }
        }
    }

    #[test]
    fn sheets_hold_every_panel_as_it_is() {
        let plan = plan(3, 2, [100, 80]);
        let layout = plan.layout().expect("small");
        let panels: Vec<Framebuffer> = (0..6_u32)
            .map(|i| {
                let mut panel = Framebuffer::new(100, 80);
                panel.pixels_mut().fill(0xff00_0000 | (0x0020_1000 * (i + 1)));
                panel
            })
            .collect();
        let sheet = layout.draw(&panels.iter().collect::<Vec<_>>(), None);
        assert_eq!([sheet.width(), sheet.height()], layout.size(), "as promised");
        for (number, panel) in panels.iter().enumerate() {
            let place = layout.panel(number);
            let color = panel.pixels()[0];
            let count = sheet.pixels().iter().filter(|pixel| **pixel == color).count();
            assert_eq!(count, 8000, "every pixel of panel {number} at {place:?}");
        }
        let known = [Ground::Light.color(), Ground::Light.rule()];
        let is_ink = |pixel: &&u32| !known.contains(pixel) && panels.iter().all(|panel| panel.pixels()[0] != **pixel);
        let ink = sheet.pixels().iter().filter(is_ink).count();
        assert!(ink > 1000, "with words: {ink}");
    }

    #[test]
    fn sheets_of_a_page_are_as_wide_as_a_page() {
        for columns in 1..=6 {
            for labelled in [false, true] {
                let side = SheetPlan::page_panel(columns, labelled);
                let mut plan = plan(columns as usize, 2, [side, side]);
                if !labelled {
                    plan.rows = vec![String::new(); 2];
                }
                let [width, _] = plan.layout().expect("a page").size();
                assert!(width.abs_diff(PAGE_WIDTH) < 40, "{columns} columns: {width}");
            }
        }
    }

    #[test]
    fn sheets_have_a_largest_size() {
        for (columns, rows, panel) in [(3, 1, [8000, 10]), (1, 3, [10, 8000]), (2, 2, [5000, 5000])] {
            let problem = plan(columns, rows, panel)
                .layout()
                .map(|layout| layout.size())
                .expect_err("too large");
            assert!(
                problem.contains("smaller --size") && !problem.contains('\n'),
                "{problem}"
            );
        }
    }

    #[test]
    fn sheets_say_what_single_panels_show() {
        let mut plan = plan(2, 2, [100, 80]);
        plan.rows = vec![String::new(); 2];
        plan.headers = (0..3).map(|i| format!("sample rate {i}")).collect();
        let layout = plan.layout().expect("small");
        assert!(layout.header_heights[1] > 0, "room above the second row too");
        let sheet = layout.draw(&[&Framebuffer::new(100, 80); 3], None);
        assert_eq!([sheet.width(), sheet.height()], layout.size(), "a cell may be empty");
    }
}
