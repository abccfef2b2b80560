//! Magnifiers of two pictures in one figure, each at a place that is given, with its letter and its scale below, a frame around what
//! it magnifies and leader lines between both.
//!
//! ```text
//!   +-------+ +-------+
//!   |       | |       |
//!   |       | |       |          +-+
//!   |  A 20x| |  B 20x|----------| |
//!   +-------+ +-------+          +-+
//! ```

use super::callout::{Scale, draw_plate};
use super::leaders::leaders;
use super::lines::{draw_frame, draw_line};
use super::paint::outer;
use super::{Inset, PixelRect, TextBlock};
use crate::raster::Framebuffer;

/// A magnifier in a figure.
#[derive(Clone, Copy)]
pub struct Magnifier<'a> {
    /// Whose it is.
    pub letter: &'a str,
    /// What it magnifies, and how large.
    pub inset: Inset,
    /// Where its upper left corner is to lie.
    pub corner: [i64; 2],
    /// Where the figure shows what it magnifies, if it does.
    pub region: Option<PixelRect>,
    /// The pixels that it magnifies: straight red, green, blue, alpha.
    pub rgba: &'a dyn Fn(u32, u32) -> Option<[u8; 4]>,
}

impl std::fmt::Debug for Magnifier<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { letter, inset, .. } = self;
        f.debug_struct("Magnifier")
            .field("letter", letter)
            .field("inset", inset)
            .finish_non_exhaustive()
    }
}

impl Magnifier<'_> {
    /// Its words, and where all of it goes: at its corner, or as near as it is inside with its words.
    fn laid_out(&self, picture: [u32; 2], scale: &Scale) -> (TextBlock, PixelRect) {
        /// Free space beside the words, in pixels.
        const BESIDE: u32 = 8;
        let [width, height] = self.inset.size();
        let text = format!("{} {}\u{d7}", self.letter, self.inset.magnification);
        let words = scale.words_within(&text, width.saturating_sub(BESIDE));
        let height = height + words.size()[1];
        let inside = |at: i64, length: u32, side: u32| at.min(i64::from(side) - i64::from(length)).max(0);
        let place = PixelRect {
            x: inside(self.corner[0], width, picture[0]),
            y: inside(self.corner[1], height, picture[1]),
            width,
            height,
        };
        (words, place)
    }
}

/// Draws magnifiers, and gives what nothing else may hide.
pub fn add_magnifiers(picture: &mut Framebuffer, magnifiers: &[Magnifier<'_>]) -> Vec<PixelRect> {
    let size = [picture.width(), picture.height()];
    let scale = Scale::of(size);
    let laid_out: Vec<(TextBlock, PixelRect)> = magnifiers.iter().map(|one| one.laid_out(size, &scale)).collect();
    let regions = magnifiers.iter().map(|one| one.region);
    let placed = regions
        .zip(&laid_out)
        .filter_map(|(region, (_, place))| Some((region?, *place)));
    let placed: Vec<(PixelRect, PixelRect)> = placed.collect();
    // Those of A and B may magnify the same pixels, side by side: no line passes between both.
    let mut connected: Vec<(PixelRect, PixelRect)> = Vec::new();
    for (region, place) in &placed {
        match connected.iter_mut().find(|(known, _)| known == region) {
            Some((_, around)) => *around = around.union(place),
            None => connected.push((*region, *place)),
        }
    }
    for (region, around) in &connected {
        for [from, to] in leaders(&outer(region), around) {
            draw_line(picture, from, to, scale.stroke());
        }
    }
    for (region, _) in &placed {
        draw_frame(picture, region, scale.stroke());
    }
    for (magnifier, (words, place)) in magnifiers.iter().zip(&laid_out) {
        let grid = magnifier.inset.draw_pixels(magnifier.rgba, &[]);
        draw_plate(picture, &grid, place, words);
    }
    let places = laid_out.into_iter().map(|(_, place)| place);
    places.chain(placed.into_iter().map(|(region, _)| region)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn magnifier<'a>(
        letter: &'a str,
        corner: [i64; 2],
        rgba: &'a dyn Fn(u32, u32) -> Option<[u8; 4]>,
    ) -> Magnifier<'a> {
        Magnifier {
            letter,
            inset: Inset::new([300, 200], 9, 20).without_detail(),
            corner,
            region: Some(PixelRect {
                x: 296,
                y: 196,
                width: 9,
                height: 9,
            }),
            rgba,
        }
    }

    #[test]
    fn magnifiers_lie_where_they_are_put_with_their_letters_below() {
        let ground = 0xff40_6080;
        let drawn = |letter: &str| {
            let mut picture = Framebuffer::new(640, 480);
            picture.pixels_mut().fill(ground);
            let rgba = |_, _| Some([250, 240, 10, 255]);
            let taken = add_magnifiers(&mut picture, &[magnifier(letter, [400, 20], &rgba)]);
            (picture, taken)
        };
        let (picture, taken) = drawn("A");
        let [place, region] = taken[..] else {
            panic!("{taken:?}")
        };
        assert_eq!([place.x, place.y], [400, 20], "its place");
        let [width, height] = Inset::new([300, 200], 9, 20).without_detail().size();
        assert!(place.width == width && place.height > height, "words below: {place:?}");
        let [x, y] = [region.x + 4, region.y + 4].map(|at| u32::try_from(at).expect("inside"));
        assert_eq!(
            picture.rgba(x, y),
            Some([0x40, 0x60, 0x80, 255]),
            "what it magnifies stays"
        );
        assert!(drawn("B").0 != picture, "the letter is to be read");
    }

    #[test]
    fn magnifiers_stay_inside_with_their_words() {
        let mut picture = Framebuffer::new(640, 480);
        let rgba = |_, _| None;
        for corner in [[600, 470], [-9, -9]] {
            let taken = add_magnifiers(&mut picture, &[magnifier("A", corner, &rgba)]);
            let all = PixelRect::of_size([640, 480]);
            assert!(taken.iter().all(|rect| rect.intersection(&all) == *rect), "{taken:?}");
        }
    }
}
