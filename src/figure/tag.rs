//! Tags over a picture: words on a dark ground that tell which part of it is whose.
//!
//! ```text
//!   +----------------+----------------+
//!   |  [A: rate 1]   |  [B: rate 16]  |
//!   |                |                |
//! ```

use super::legend::size_of_words;
use super::paint::{blend, for_each_index};
use super::{Anchor, PixelRect, TextBlock, TextStyle};
use crate::raster::Framebuffer;

const WORDS: u32 = 0xffff_ffff;
const GROUND: u32 = 0xff00_0000;
/// How much of what lies below a tag its ground hides.
const OPACITY: f32 = 0.75;
/// Height of the em square, in pixels at size 1.
const TEXT: f32 = 13.0;
/// Part of the picture's height that a tag takes at most.
const MOST_HEIGHT: f64 = 0.3;

/// What a tag says, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Tag {
    /// The words; where there is no room for them, their first letter stands for all.
    pub text: String,
    /// Its left or right end.
    pub x: f32,
    /// Which end lies there.
    pub anchor: Anchor,
    /// How wide the words may be.
    pub room: f32,
}

impl Tag {
    /// Free space between a tag and what is beside it, in the unit of a tag's lengths.
    pub const MARGIN: f32 = 10.0;
    /// Space to the left and right of its words, and above and below.
    pub const PADDING: [f32; 2] = [8.0, 4.0];
    /// Where there is less room for words, the letter stands alone.
    pub const LEAST_WORDS: f32 = 48.0;
}

/// Draws tags along the upper edge of a picture, below what is `spared` there, and returns where they lie, in pixels. `x` and
/// `room` are in pixels divided by [`tag_unit`] of the picture. Those without room are left out.
pub fn add_tags(picture: &mut Framebuffer, tags: &[Tag], spared: &[PixelRect]) -> Vec<PixelRect> {
    let size = [picture.width(), picture.height()];
    let unit = tag_unit(size);
    let all = PixelRect::of_size(size);
    let mut placed = Vec::new();
    for tag in tags {
        let first = tag.text.chars().next().map(String::from).unwrap_or_default();
        let whole = Some(tag.text.as_str()).filter(|_| tag.room >= Tag::LEAST_WORDS);
        let drawn = whole.into_iter().chain([first.as_str()]).find_map(|text| {
            let words = TextBlock::new(text, TextStyle::new(TEXT * unit, WORDS), Some(pixels(tag.room * unit)));
            let taken: Vec<PixelRect> = spared.iter().chain(&placed).copied().collect();
            let rect = place(tag, &words, &all, &taken)?;
            Some((words, rect))
        });
        if let Some((words, rect)) = drawn {
            let width = picture.width() as usize;
            for_each_index(&rect, width, |index| {
                let below = &mut picture.pixels_mut()[index];
                *below = blend(*below, GROUND, OPACITY);
            });
            let [right, down] = Tag::PADDING.map(|side| i64::from(pixels(side * unit)));
            words.draw(picture, [rect.x + right, rect.y + down], Anchor::Left);
            placed.push(rect);
        }
    }
    placed
}

/// Pixels of a picture for each unit of a tag's lengths: 1 where words are as large as in the window, more in large pictures.
pub fn tag_unit(picture: [u32; 2]) -> f32 {
    size_of_words(picture)
}

/// Where a tag with these words goes.
fn place(tag: &Tag, words: &TextBlock, all: &PixelRect, taken: &[PixelRect]) -> Option<PixelRect> {
    let unit = tag_unit([all.width, all.height]);
    let [width, height] = words.size();
    if f64::from(height) > f64::from(all.height) * MOST_HEIGHT || width > pixels(tag.room * unit) + 1 {
        return None;
    }
    let [beside, above] = Tag::PADDING.map(|side| 2 * pixels(side * unit));
    let margin = i64::from(pixels(Tag::MARGIN * unit));
    let end = i64::from(pixels(tag.x * unit));
    let mut rect = PixelRect {
        x: end,
        y: margin,
        width: width + beside,
        height: height + above,
    };
    if tag.anchor == Anchor::Right {
        rect.x -= i64::from(rect.width);
    }
    while let Some(other) = taken.iter().find(|other| rect.overlaps(other)) {
        rect.y = other.bottom() + margin;
    }
    (rect.intersection(all) == rect).then_some(rect)
}

/// Whole pixels of a length in a picture.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a picture"
)]
fn pixels(length: f32) -> u32 {
    length.round().clamp(0.0, Framebuffer::MAX_SIDE as f32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tag(text: &str, x: f32, anchor: Anchor, room: f32) -> Tag {
        Tag {
            text: text.to_owned(),
            x,
            anchor,
            room,
        }
    }

    #[test]
    fn tags_lie_at_their_ends_and_beside_what_is_spared() {
        let mut picture = Framebuffer::new(800, 800);
        let tags = [
            tag("A: sample rate 1", 390.0, Anchor::Right, 300.0),
            tag("B: sample rate 16", 410.0, Anchor::Left, 300.0),
        ];
        let spared = PixelRect {
            x: 350,
            y: 5,
            width: 30,
            height: 60,
        };
        let placed = add_tags(&mut picture, &tags, &[spared]);
        let [a, b] = placed[..] else { panic!("{placed:?}") };
        assert_eq!((a.right(), b.x), (390, 410));
        assert_eq!((a.y, b.y), (75, 10), "A's below what is spared");
        let white = |rect: PixelRect| {
            let inside = (rect.y..rect.bottom()).flat_map(|y| (rect.x..rect.right()).map(move |x| [x, y]));
            let at = |at: i64| u32::try_from(at).unwrap_or_default();
            inside
                .filter(|[x, y]| picture.rgba(at(*x), at(*y)).is_some_and(|rgba| rgba[0] > 200))
                .count()
        };
        assert!(white(a) > 50 && white(b) > 50, "words are to be read");
    }

    #[test]
    fn tags_give_way_to_their_letter_and_vanish_at_last() {
        let words = "A: sample rate 1, pixel bilinear";
        let lie_in = |size: [u32; 2], room: f32| {
            let mut picture = Framebuffer::new(size[0], size[1]);
            add_tags(&mut picture, &[tag(words, 10.0, Anchor::Left, room)], &[])
        };
        let whole = lie_in([800, 800], 400.0)[0];
        let letter = lie_in([800, 800], 30.0)[0];
        assert!(whole.width > 150 && letter.width < 40, "{whole:?}, {letter:?}");
        assert!(lie_in([24, 24], 4.0).is_empty(), "no room");
        let large = lie_in([3200, 3200], 400.0)[0];
        assert!(large.width > 3 * whole.width, "{large:?} of a large picture");
    }
}
