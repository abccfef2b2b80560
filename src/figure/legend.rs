//! The legend of a visualisation as a picture, and its place in a corner of the picture that it explains.

use super::paint::{copy, fill, inner};
use super::{Anchor, Corner, PixelRect, TextBlock, TextStyle, corners};
use crate::raster::Framebuffer;
use crate::render::{Legend, LegendKey};

/// Colours of the box, as those of insets.
const BORDER_COLOR: u32 = 0xff20_2428;
const GROUND_COLOR: u32 = 0xfff4_f4f2;
const TEXT_COLOR: u32 = 0xff20_2428;

/// Lengths in pixels at size 1.
const PADDING: f32 = 9.0;
const SCALE_WIDTH: f32 = 264.0;
const SCALE_HEIGHT: f32 = 14.0;
const TICK: f32 = 4.0;
const SWATCH: f32 = 12.0;
const GAP: f32 = 6.0;
const FIELD: f32 = 72.0;
const TEXT: f32 = 13.0;

/// The shorter side of a picture whose legend has size 1, in pixels.
const FULL_SIDE: f32 = 800.0;
/// How small and how large legends become.
const SIZES: (f32, f32) = (0.75, 6.0);

/// Draws a legend; a `size` of 1 has text of 13 pixels.
pub fn draw_legend(legend: &Legend, size: f32) -> Framebuffer {
    let layout = Layout::new(legend, size);
    let mut picture = Framebuffer::new(layout.size[0], layout.size[1]);
    let all = PixelRect::of_size(layout.size);
    fill(&mut picture, &all, BORDER_COLOR);
    fill(&mut picture, &inner(&all, layout.px(1.0)), GROUND_COLOR);
    for part in &layout.parts {
        part.draw(&mut picture, &layout);
    }
    picture
}

/// How large words are that belong to a picture of so many pixels: 1 as in the window.
pub(super) fn size_of_words(picture: [u32; 2]) -> f32 {
    let side = picture[0].min(picture[1]) as f32;
    let size = (side / FULL_SIDE * 4.0).round() / 4.0;
    size.clamp(SIZES.0, SIZES.1)
}

/// Legends for a picture of `picture` pixels, and where they go: into corners of `area`, over none of the rectangles that
/// `spared` holds and not over each other. Those for which there is no room, even small, are left out.
pub fn place_legends(
    legends: &[Legend],
    picture: [u32; 2],
    area: &PixelRect,
    spared: &[PixelRect],
) -> Vec<(PixelRect, Framebuffer)> {
    let size = size_of_words(picture);
    let mut taken = spared.to_vec();
    let mut placed = Vec::new();
    for legend in legends {
        let place = |size: f32| {
            let drawn = Layout::new(legend, size).size;
            let free = |rect: &PixelRect| taken.iter().all(|taken| !rect.overlaps(taken));
            let mut rects = corners(area, drawn, Corner::BottomLeft).map(|(_, rect)| rect);
            // A legend explains a picture; it is not to hide most of it.
            rects
                .find(free)
                .filter(|_| drawn[1] <= area.height / 2)
                .map(|rect| (rect, size))
        };
        if let Some((rect, size)) = place(size).or_else(|| place(SIZES.0)) {
            taken.push(rect);
            placed.push((rect, draw_legend(legend, size)));
        }
    }
    placed
}

/// Draws legends into the corners of a picture, as [`place_legends`] places them; how many there was room for.
pub fn add_legends(picture: &mut Framebuffer, legends: &[Legend], spared: &[PixelRect]) -> usize {
    let all = PixelRect::of_size([picture.width(), picture.height()]);
    let placed = place_legends(legends, [picture.width(), picture.height()], &all, spared);
    for (rect, drawn) in &placed {
        copy(drawn, picture, [rect.x, rect.y]);
    }
    placed.len()
}

/// What a legend is made of, each part in its place.
struct Layout<'a> {
    scale: f32,
    size: [u32; 2],
    parts: Vec<Part<'a>>,
}

enum Part<'a> {
    Words(TextBlock, [i64; 2], Anchor),
    /// A rectangle of one colour with a thin border.
    Swatch(PixelRect, u32),
    /// Colours from left to right.
    Scale(PixelRect, &'a [u32]),
    /// The mark below a place of a scale.
    Tick(PixelRect),
    /// A square whose pixel at parts of its width and height has this colour, if any.
    Field(PixelRect, &'a LegendKey),
}

impl<'a> Layout<'a> {
    fn new(legend: &'a Legend, scale: f32) -> Self {
        let mut layout = Self {
            scale: if scale.is_finite() {
                scale.clamp(0.25, 16.0)
            } else {
                1.0
            },
            size: [0; 2],
            parts: Vec::new(),
        };
        let x = i64::from(layout.px(PADDING));
        let title = layout.words(legend.title);
        let mut y = x;
        let height = title.size()[1];
        layout.add(Part::Words(title, [x, y], Anchor::Left));
        y += i64::from(height + layout.px(GAP / 2.0));
        let mut swatches: Vec<(u32, &str)> = Vec::new();
        let mut left = x;
        let top = y;
        match &legend.key {
            LegendKey::Scale(colors, ticks) => y = layout.scale(colors, ticks, [x, y]),
            LegendKey::Swatches(known) => swatches.extend(known.iter().map(|(color, name)| (*color, name.as_str()))),
            key @ (LegendKey::Triangle(_) | LegendKey::Square(_)) => {
                let side = layout.px(FIELD);
                let rect = PixelRect {
                    x,
                    y,
                    width: side,
                    height: side,
                };
                layout.add(Part::Field(rect, key));
                left = rect.right() + i64::from(layout.px(2.0 * GAP));
                match key {
                    LegendKey::Triangle(corners) => swatches.extend(corners),
                    LegendKey::Square([u, v]) => {
                        swatches.extend([*u, *v, (0xff00_0000, "u = v = 0"), (0xffff_ffff, "u = v = 1")]);
                    }
                    _ => {}
                }
            }
        }
        // What stands beside a field stands in one column.
        let width = if left > x { 0 } else { layout.px(SCALE_WIDTH) };
        swatches.extend(&legend.others);
        layout.swatches(&swatches, [left, y], width);
        if left > x {
            let bottom = top + i64::from(layout.px(FIELD));
            layout.reach([left, bottom]);
        }
        layout.size = layout.size.map(|side| side + layout.px(PADDING));
        layout
    }

    /// A length in pixels.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few hundred pixels at most"
    )]
    fn px(&self, length: f32) -> u32 {
        (length * self.scale).round().max(1.0) as u32
    }

    fn words(&self, text: &str) -> TextBlock {
        TextBlock::new(text, TextStyle::new(TEXT * self.scale, TEXT_COLOR), None)
    }

    /// The picture holds the point, but for the padding.
    fn reach(&mut self, point: [i64; 2]) {
        for (side, end) in self.size.iter_mut().zip(point) {
            *side = (*side).max(u32::try_from(end).unwrap_or(0));
        }
    }

    fn add(&mut self, part: Part<'a>) {
        let rect = match &part {
            Part::Words(words, at, anchor) => words.rect(*at, *anchor),
            Part::Swatch(rect, _) | Part::Scale(rect, _) | Part::Tick(rect) | Part::Field(rect, _) => *rect,
        };
        self.reach([rect.right(), rect.bottom()]);
        self.parts.push(part);
    }

    /// A scale and its labels; where what comes below may begin.
    fn scale(&mut self, colors: &'a [u32], ticks: &[(f32, String)], [x, y]: [i64; 2]) -> i64 {
        let rect = PixelRect {
            x,
            y,
            width: self.px(SCALE_WIDTH),
            height: self.px(SCALE_HEIGHT),
        };
        self.add(Part::Scale(rect, colors));
        let below = rect.bottom() + i64::from(self.px(TICK));
        let mut end = below;
        for (part, label) in ticks {
            let last = i64::from(rect.width) - i64::from(self.px(1.0));
            #[expect(clippy::cast_possible_truncation, reason = "inside a few hundred pixels")]
            let at = x + (part.clamp(0.0, 1.0) * last as f32).round() as i64;
            self.add(Part::Tick(PixelRect {
                x: at,
                y: rect.bottom(),
                width: self.px(1.0),
                height: self.px(TICK),
            }));
            let anchor = match part {
                ..=0.0 => Anchor::Left,
                1.0.. => Anchor::Right,
                _ => Anchor::Center,
            };
            let words = self.words(label);
            let flush = if anchor == Anchor::Right { rect.right() } else { at };
            end = below + i64::from(words.size()[1]);
            self.add(Part::Words(words, [flush, below], anchor));
        }
        end + i64::from(self.px(GAP / 2.0))
    }

    /// Swatches with their names from left to right, in rows of at most `width` pixels.
    fn swatches(&mut self, swatches: &[(u32, &str)], [left, top]: [i64; 2], width: u32) {
        let (side, gap) = (self.px(SWATCH), i64::from(self.px(GAP)));
        let (mut x, mut y) = (left, top);
        for (color, name) in swatches {
            let words = self.words(name);
            let [length, height] = words.size();
            let end = x + i64::from(side) + gap + i64::from(length);
            if x > left && end > left + i64::from(width) {
                (x, y) = (left, y + i64::from(height) + gap / 3);
            }
            let rect = PixelRect {
                x,
                y: y + (i64::from(height) - i64::from(side)) / 2,
                width: side,
                height: side,
            };
            self.add(Part::Swatch(rect, *color));
            let at = rect.right() + gap;
            self.add(Part::Words(words, [at, y], Anchor::Left));
            x = at + i64::from(length) + 2 * gap;
        }
    }
}

impl Part<'_> {
    fn draw(&self, picture: &mut Framebuffer, layout: &Layout<'_>) {
        match self {
            Self::Words(words, at, anchor) => words.draw(picture, *at, *anchor),
            Self::Tick(rect) => fill(picture, rect, TEXT_COLOR),
            Self::Swatch(rect, color) => {
                fill(picture, rect, BORDER_COLOR);
                fill(picture, &inner(rect, layout.px(1.0)), *color);
            }
            Self::Scale(rect, colors) => {
                for column in 0..rect.width {
                    let index = column as usize * colors.len() / rect.width as usize;
                    let line = PixelRect {
                        x: rect.x + i64::from(column),
                        width: 1,
                        ..*rect
                    };
                    fill(picture, &line, colors.get(index).copied().unwrap_or(GROUND_COLOR));
                }
            }
            Self::Field(rect, key) => {
                for (x, y) in (0..rect.height).flat_map(|y| (0..rect.width).map(move |x| (x, y))) {
                    let part = |at: u32| (at as f32 + 0.5) / rect.width as f32;
                    if let Some(color) = field_color(key, [part(x), part(y)]) {
                        let pixel = PixelRect {
                            x: rect.x + i64::from(x),
                            y: rect.y + i64::from(y),
                            width: 1,
                            height: 1,
                        };
                        fill(picture, &pixel, color);
                    }
                }
            }
        }
    }
}

/// The colour at parts of a field's width and height.
fn field_color(key: &LegendKey, [x, y]: [f32; 2]) -> Option<u32> {
    match key {
        LegendKey::Triangle(corners) => {
            // The first corner is on top, the second lower left, the third lower right.
            let third = x - (1.0 - y) / 2.0;
            let weights = [1.0 - y, y - third, third];
            let inside = weights.iter().all(|weight| *weight >= 0.0);
            inside.then(|| sum(corners.map(|(color, _)| color), weights))
        }
        LegendKey::Square(axes) => {
            let [u, v] = axes.map(|(color, _)| color);
            Some(sum([u, v], [x, y]))
        }
        LegendKey::Scale(..) | LegendKey::Swatches(_) => None,
    }
}

/// Colours added up by their weights.
fn sum<const N: usize>(colors: [u32; N], weights: [f32; N]) -> u32 {
    let channel = |index: usize| {
        let parts = colors.iter().zip(weights);
        let sum: f32 = parts
            .map(|(color, weight)| f32::from(color.to_be_bytes()[index]) * weight)
            .sum();
        crate::color::unit_to_byte(sum / 255.0, crate::rules::Rules::Standard)
    };
    u32::from_be_bytes([0xff, channel(1), channel(2), channel(3)])
}
