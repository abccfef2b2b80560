//! Words on pictures: measured, broken into lines, drawn with antialiased edges.
//!
//! A character that the chosen typeface lacks is taken from the other one; what both lack stands as the box of a missing
//! glyph. Positions are whole pixels and the arithmetic is the same on every machine, so that pictures with words can be
//! compared byte for byte.

use std::sync::LazyLock;

use ab_glyph::{
    Font as _, FontRef, Glyph, GlyphId, Outline, OutlineCurve, OutlinedGlyph, Point, PxScale, Rect, ScaleFont as _,
    point,
};

use super::PixelRect;
use super::paint::blend;
use crate::raster::Framebuffer;

/// Both typefaces in the order of [`Typeface`]; they are part of the program, so that each is there.
static FACES: LazyLock<Vec<FontRef<'static>>> = LazyLock::new(|| {
    let files = [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR];
    files
        .into_iter()
        .filter_map(|file| FontRef::try_from_slice(file).ok())
        .collect()
});

/// From one baseline to the next, in parts of the size.
const LINE: f32 = 1.3;
/// How far a slanted letter leans to the right, in parts of its height: about 12 degrees, as italics do.
const SLANT: f32 = 0.21;
/// Thin strokes fade where they cover part of a pixel; half coverage is raised by a quarter of this.
const STRENGTH: f32 = 0.6;

/// Which letters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Typeface {
    /// Proportional, for captions: Ubuntu Light.
    #[default]
    Text,
    /// All characters of one width, for columns of numbers and for code: Hack.
    Code,
    /// The proportional one at a slant, for emphasis.
    Slanted,
}

/// Which point of a block of text stands at the place it is drawn at; its lines are flush there too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Anchor {
    /// The upper left corner.
    #[default]
    Left,
    /// The middle of the upper edge.
    Center,
    /// The upper right corner.
    Right,
}

/// How text looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    /// The letters.
    pub typeface: Typeface,
    /// Height of the em square in pixels: capitals are about 0.7 of it. Brought into [`TextStyle::SIZE`].
    pub size: f32,
    /// Straight `0xAARRGGBB`.
    pub color: u32,
}

impl TextStyle {
    /// Smallest and largest text.
    pub const SIZE: std::ops::RangeInclusive<f32> = 4.0..=512.0;

    /// Proportional text of a size in pixels and a straight `0xAARRGGBB`.
    pub const fn new(size: f32, color: u32) -> Self {
        Self {
            typeface: Typeface::Text,
            size,
            color,
        }
    }

    /// The size within its range.
    fn em(self) -> f32 {
        // A size that is no number becomes the smallest.
        self.size.max(*Self::SIZE.start()).min(*Self::SIZE.end())
    }

    /// Pixels from the top of one line to the top of the next.
    pub fn line_height(self) -> u32 {
        whole_pixels(self.em() * LINE)
    }

    /// The typeface, then the other one.
    fn faces(self) -> impl Iterator<Item = &'static FontRef<'static>> {
        let first = usize::from(self.typeface == Typeface::Code);
        FACES.iter().skip(first).chain(FACES.iter().take(first))
    }

    /// The face and the glyph of a character: a face that has it, else the box of the chosen face.
    fn glyph(self, character: char) -> Option<(&'static FontRef<'static>, GlyphId)> {
        let mut glyphs = self.faces().map(|face| (face, face.glyph_id(character)));
        let missing = self.faces().next().map(|face| (face, GlyphId(0)));
        glyphs.find(|(_, glyph)| *glyph != GlyphId(0)).or(missing)
    }

    fn scale(self, face: &FontRef<'_>) -> PxScale {
        // The crate's scale is the height from ascent to descent; the unit of a size is the em.
        let em = face.units_per_em().unwrap_or(1000.0);
        PxScale::from(self.em() * face.height_unscaled() / em)
    }

    /// How far the pen moves over a character after `before`.
    fn advance(self, before: Option<char>, character: char) -> f32 {
        let Some((face, glyph)) = self.glyph(character) else {
            return 0.0;
        };
        let scaled = face.as_scaled(self.scale(face));
        let kern = before.and_then(|before| {
            let (other, before) = self.glyph(before)?;
            std::ptr::eq(other, face).then(|| scaled.kern(before, glyph))
        });
        kern.unwrap_or(0.0) + scaled.h_advance(glyph)
    }

    /// Width of a line in pixels, not rounded.
    pub(super) fn advance_of(self, line: &str) -> f32 {
        let pairs = std::iter::once(None).chain(line.chars().map(Some)).zip(line.chars());
        pairs.map(|(before, character)| self.advance(before, character)).sum()
    }
}

/// Text broken into lines, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct TextBlock {
    style: TextStyle,
    lines: Vec<Line>,
}

#[derive(Clone, Debug, PartialEq)]
struct Line {
    text: String,
    /// Pixels, rounded up.
    width: u32,
}

impl TextBlock {
    /// Breaks `text` at its line breaks, and where `width` pixels are given also between words, so that no line is wider;
    /// a word that is wider than that is broken between characters, each line keeping one at least.
    pub fn new(text: &str, style: TextStyle, width: Option<u32>) -> Self {
        let lines = text.split('\n').flat_map(|paragraph| {
            let paragraph: String = paragraph.chars().filter_map(shown).collect();
            match width {
                Some(width) => broken(&paragraph, style, width),
                None => vec![paragraph],
            }
        });
        let lines = lines.map(|text| Line {
            width: whole_pixels(style.advance_of(&text)),
            text,
        });
        Self {
            style,
            lines: lines.collect(),
        }
    }

    /// Width of the widest line and height of all, in pixels.
    pub fn size(&self) -> [u32; 2] {
        let width = self.lines.iter().map(|line| line.width).max().unwrap_or(0);
        let count = u32::try_from(self.lines.len()).unwrap_or(u32::MAX);
        [width, self.style.line_height().saturating_mul(count)]
    }

    /// The lines as they were broken.
    pub fn lines(&self) -> impl Iterator<Item = &str> {
        self.lines.iter().map(|line| line.text.as_str())
    }

    /// The rectangle that the block takes when it is drawn at `place`. Slanted or wide glyphs may reach a little beyond.
    pub fn rect(&self, [x, y]: [i64; 2], anchor: Anchor) -> PixelRect {
        let [width, height] = self.size();
        PixelRect {
            x: x - before(anchor, width),
            y,
            width,
            height,
        }
    }

    /// Draws the block with its anchor at `place`, in pixels from the picture's upper left corner. What lies outside the
    /// picture is left out.
    pub fn draw(&self, picture: &mut Framebuffer, [x, y]: [i64; 2], anchor: Anchor) {
        let step = i64::from(self.style.line_height());
        let mut top = y;
        for line in &self.lines {
            if top > i64::from(picture.height()) {
                return;
            }
            if top > -step {
                draw_line(picture, &line.text, self.style, [x - before(anchor, line.width), top]);
            }
            top = top.saturating_add(step);
        }
    }
}

/// Pixels of `width` that lie to the left of the anchor.
fn before(anchor: Anchor, width: u32) -> i64 {
    i64::from(match anchor {
        Anchor::Left => 0,
        Anchor::Center => width / 2,
        Anchor::Right => width,
    })
}

/// What stands for a character: a tab is a space; what steers a terminal, the direction of writing or the joining of
/// letters has no shape, and stands as a replacement character so that it cannot hide in a caption.
fn shown(character: char) -> Option<char> {
    match character {
        '\r' => None,
        '\t' => Some(' '),
        _ if character.is_control() || is_invisible(character) => Some(char::REPLACEMENT_CHARACTER),
        _ => Some(character),
    }
}

/// Formatting characters of Unicode (category Cf) that turn up in names.
fn is_invisible(character: char) -> bool {
    matches!(
        character,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}'
    )
}

/// `paragraph` in lines no wider than `width` pixels.
fn broken(paragraph: &str, style: TextStyle, width: u32) -> Vec<String> {
    let (limit, mut lines, mut line) = (width as f32, Vec::new(), String::new());
    for word in paragraph.split(' ') {
        let separator = if line.is_empty() { "" } else { " " };
        let longer = format!("{line}{separator}{word}");
        if style.advance_of(&longer) <= limit {
            line = longer;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        // The pen is followed here, so that a very long word costs no more than its length.
        let (mut pen, mut last) = (0.0, None);
        for character in word.chars() {
            let advance = style.advance(last, character);
            while !line.is_empty() && pen + advance > limit {
                // Behind a hyphen, if the line has one; else wherever it ends.
                let rest = line
                    .rfind('-')
                    .map_or(String::new(), |hyphen| line.split_off(hyphen + 1));
                lines.push(std::mem::replace(&mut line, rest));
                (pen, last) = (style.advance_of(&line), line.chars().last());
            }
            pen += style.advance(last, character);
            line.push(character);
            last = Some(character);
        }
    }
    lines.push(line);
    lines
}

/// Draws one line with its upper left corner at `place`.
fn draw_line(picture: &mut Framebuffer, text: &str, style: TextStyle, [x, y]: [i64; 2]) {
    let Some(main) = style.faces().next() else { return };
    let scaled = main.as_scaled(style.scale(main));
    // The face's own lines are of other heights; the letters stand in the middle of ours.
    let spare = style.line_height() as f32 - scaled.height();
    let baseline = (spare / 2.0 + scaled.ascent()).round();
    let (mut pen, mut last) = (0.0, None);
    for character in text.chars() {
        let Some((face, id)) = style.glyph(character) else {
            return;
        };
        let scale = style.scale(face);
        let kerned = style.advance(last, character) - style.advance(None, character);
        let glyph = id.with_scale_and_position(scale, point(pen + kerned, baseline));
        let outlined = match style.typeface {
            Typeface::Text | Typeface::Code => face.outline_glyph(glyph),
            Typeface::Slanted => slanted(face, glyph),
        };
        if let Some(outlined) = outlined {
            draw_glyph(picture, &outlined, style.color, [x, y]);
        }
        pen += style.advance(last, character);
        last = Some(character);
        if x.saturating_add(i64::from(whole_pixels(pen))) > i64::from(picture.width()) {
            return;
        }
    }
}

/// The outline of a glyph that leans to the right.
fn slanted(face: &FontRef<'_>, glyph: Glyph) -> Option<OutlinedGlyph> {
    let Outline { bounds, curves } = face.outline(glyph.id)?;
    // Glyphs are described with the baseline at 0 and the height upwards.
    let lean = |at: Point| point(at.x + SLANT * at.y, at.y);
    let curves = curves.into_iter().map(|curve| match curve {
        OutlineCurve::Line(from, to) => OutlineCurve::Line(lean(from), lean(to)),
        OutlineCurve::Quad(from, by, to) => OutlineCurve::Quad(lean(from), lean(by), lean(to)),
        OutlineCurve::Cubic(from, a, b, to) => OutlineCurve::Cubic(lean(from), lean(a), lean(b), lean(to)),
    });
    let (low, high) = (bounds.min.y.min(bounds.max.y), bounds.min.y.max(bounds.max.y));
    let outline = Outline {
        bounds: Rect {
            min: point(bounds.min.x + SLANT * low, bounds.min.y),
            max: point(bounds.max.x + SLANT * high, bounds.max.y),
        },
        curves: curves.collect(),
    };
    let factor = face.as_scaled(glyph.scale).scale_factor();
    Some(OutlinedGlyph::new(glyph, outline, factor))
}

/// Blends a glyph over the picture, `corner` being where its coordinates start.
fn draw_glyph(picture: &mut Framebuffer, glyph: &OutlinedGlyph, color: u32, corner: [i64; 2]) {
    let bounds = glyph.px_bounds();
    #[expect(clippy::cast_possible_truncation, reason = "whole numbers of a few thousand pixels")]
    let [left, top] = [bounds.min.x as i64 + corner[0], bounds.min.y as i64 + corner[1]];
    glyph.draw(|x, y, coverage| {
        let at = [left + i64::from(x), top + i64::from(y)];
        if coverage > 0.0 && PixelRect::of_size([picture.width(), picture.height()]).contains(at) {
            let index = at[1] * i64::from(picture.width()) + at[0];
            if let Some(pixel) = usize::try_from(index)
                .ok()
                .and_then(|i| picture.pixels_mut().get_mut(i))
            {
                *pixel = blend(*pixel, color, strengthened(coverage.min(1.0)));
            }
        }
    });
}

/// Coverage of a glyph as opacity; nothing and all stay what they are.
fn strengthened(coverage: f32) -> f32 {
    coverage + STRENGTH * coverage * (1.0 - coverage)
}

/// A length in pixels, rounded up.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates; lengths are not negative"
)]
fn whole_pixels(length: f32) -> u32 {
    length.ceil() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: u32 = 0xff00_0000;

    fn white(width: u32, height: u32) -> Framebuffer {
        let mut picture = Framebuffer::new(width, height);
        picture.pixels_mut().fill(0xffff_ffff);
        picture
    }

    /// Columns of the picture that are not white.
    fn inked(picture: &Framebuffer) -> Vec<usize> {
        let width = picture.width() as usize;
        let is_inked = |x: &usize| {
            picture
                .pixels()
                .iter()
                .skip(*x)
                .step_by(width)
                .any(|p| *p != 0xffff_ffff)
        };
        (0..width).filter(is_inked).collect()
    }

    #[test]
    fn text_every_character_of_the_faces_is_seen() {
        assert_eq!(FACES.len(), 2, "both faces can be read");
        let style = TextStyle::new(24.0, BLACK);
        let (mut seen, mut missing) = (0, 0);
        for character in (0..0x1_1000_u32).filter_map(char::from_u32) {
            let Some(stands) = shown(character).filter(|stands| !stands.is_whitespace()) else {
                continue;
            };
            let (face, glyph) = style.glyph(stands).expect("there are faces");
            assert!(face.outline(glyph).is_some(), "{character:?} vanishes");
            assert!(style.advance(None, stands) >= 0.0, "{character:?} goes backwards");
            seen += 1;
            missing += u32::from(glyph == GlyphId(0));
        }
        assert!(seen - missing > 1500, "letters that have a shape: {seen} - {missing}");
    }

    #[test]
    fn text_stands_where_its_rectangle_says() {
        let block = TextBlock::new("mip level 3\nHO", TextStyle::new(20.0, BLACK), None);
        let [width, height] = block.size();
        assert_eq!(height, 2 * 26, "two lines");
        for (anchor, x) in [(Anchor::Left, 10), (Anchor::Center, 100), (Anchor::Right, 190)] {
            let mut picture = white(200, 60);
            block.draw(&mut picture, [x, 4], anchor);
            let (columns, rect) = (inked(&picture), block.rect([x, 4], anchor));
            let [first, last] =
                [columns.first(), columns.last()].map(|x| i64::try_from(*x.expect("ink")).expect("small"));
            assert!(
                first >= rect.x && last < rect.right(),
                "{anchor:?}: {first}..={last} in {rect:?}"
            );
            assert!(
                last - first > i64::from(width) - 5,
                "{anchor:?}: it is as wide as it says"
            );
        }
    }

    #[test]
    fn text_at_a_slant_leans_to_the_right_and_is_as_wide() {
        let upright = TextStyle::new(40.0, BLACK);
        let style = TextStyle {
            typeface: Typeface::Slanted,
            ..upright
        };
        let block = TextBlock::new("l", style, None);
        assert_eq!(
            block.size(),
            TextBlock::new("l", upright, None).size(),
            "the pen goes as far"
        );
        let mut picture = white(60, 60);
        block.draw(&mut picture, [20, 4], Anchor::Left);
        let width = picture.width() as usize;
        let rows = picture.pixels().chunks(width);
        let places: Vec<usize> = rows
            .filter_map(|row| row.iter().position(|pixel| *pixel != 0xffff_ffff))
            .collect();
        let (Some(top), Some(bottom)) = (places.first(), places.last()) else {
            panic!("ink");
        };
        assert!(*top > bottom + 3, "{top} above {bottom}");
        // Its ends are level.
        let stroke = &places[1..places.len() - 1];
        assert!(
            stroke.windows(2).all(|rows| rows[1] <= rows[0]),
            "an even stroke: {places:?}"
        );
    }

    #[test]
    fn text_breaks_between_words_and_keeps_every_letter() {
        let style = TextStyle::new(16.0, BLACK);
        let text = "the quick brown fox jumps overthelazydogwithoutasinglespace and 16 samples";
        for width in [0, 1, 20, 50, 90, 200, 5000] {
            let block = TextBlock::new(text, style, Some(width));
            let letters = |text: &str| text.replace(' ', "");
            assert_eq!(letters(&block.lines().collect::<String>()), letters(text), "at {width}");
            let fits = |line: &str| style.advance_of(line) <= width as f32 + 0.01 || line.chars().count() == 1;
            assert!(
                block.lines().all(fits),
                "at {width}: {:?}",
                block.lines().collect::<Vec<_>>()
            );
        }
        assert_eq!(
            TextBlock::new(text, style, Some(5000)).lines().count(),
            1,
            "no need to break"
        );
        assert_eq!(TextBlock::new("", style, Some(9)).size(), [0, 21], "an empty line");
        let hyphen = TextBlock::new("jittered-same", style, Some(80));
        let lines: Vec<&str> = hyphen.lines().collect();
        assert_eq!(lines, ["jittered-", "same"], "behind the hyphen");
    }

    #[test]
    fn text_blends_over_what_is_there() {
        let mut picture = Framebuffer::new(60, 40);
        TextBlock::new("H", TextStyle::new(30.0, 0xff20_4060), None).draw(&mut picture, [5, 0], Anchor::Left);
        assert!(picture.pixels().contains(&0xff20_4060), "full coverage is the colour");
        assert!(
            picture
                .pixels()
                .iter()
                .all(|pixel| *pixel == 0 || pixel & 0x00ff_ffff == 0x0020_4060),
            "over nothing the edges keep the colour and lose opacity"
        );
    }

    #[test]
    fn text_survives_any_place_size_and_words() {
        arbtest::arbtest(|u| {
            let text: String = u.arbitrary()?;
            let size = f32::from_bits(u.arbitrary()?);
            let typeface = *u.choose(&[Typeface::Text, Typeface::Code])?;
            let style = TextStyle {
                typeface,
                size,
                color: u.arbitrary()?,
            };
            let block = TextBlock::new(&text, style, u.arbitrary()?);
            let mut picture = Framebuffer::new(u.int_in_range(0..=40)?, u.int_in_range(0..=40)?);
            let near = u.arbitrary()?;
            let mut place = || {
                Ok(if near {
                    u.int_in_range(-60..=60)?
                } else {
                    i64::from(u.arbitrary::<i32>()?)
                })
            };
            block.draw(&mut picture, [place()?, place()?], Anchor::Center);
            Ok(())
        })
        .budget_ms(300);
    }
}
