//! Tiles of patterns: pictures that go on for ever in both directions.
//!
//! ```text
//!      +----+----+----+
//!      | P  | P  | P  |      a point of the pattern is a point of its tile: the whole part of
//!      +----+----+----+      each coordinate says which copy, and the rest where in it
//!      | P  | P  | P  |
//! ```
//!
//! A tile is drawn for the view that shows it, one texel for each pixel, so that there are no mip levels.

use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec2;

use super::{Cubic, PixelSampling};
use crate::color::Premultiplied16;

/// Sizes of a tile that are kept: the picture's, and those of thumbnails beside it.
const KEPT: usize = 4;

/// Room for the tiles of all patterns that a view shows together: those of many large ones are coarser.
#[derive(Clone, Copy, Debug)]
pub struct TileBudget;

impl TileBudget {
    /// Largest side of a tile in texels; one that is shown larger is stretched.
    pub const MAX_SIDE: f64 = 4096.0;
    /// Texels of all tiles of a view: 512 MB.
    pub const TEXELS: f64 = 67_108_864.0;

    /// How many texels tiles with these sides have together.
    pub fn wanted(sides: impl IntoIterator<Item = DVec2>) -> f64 {
        let texels = |sides: DVec2| sides.min(DVec2::splat(Self::MAX_SIDE)).element_product();
        sides.into_iter().filter(|sides| sides.is_finite()).map(texels).sum()
    }

    /// Which part of their sides tiles with so many texels together can have.
    pub fn part(wanted: f64) -> f64 {
        (Self::TEXELS / wanted).sqrt().min(1.0)
    }
}

/// A picture that is repeated.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    size: [u32; 2],
    texels: Vec<Premultiplied16>,
}

/// The texels that are read at a point, and the colour that they make.
#[derive(Clone, Debug, PartialEq)]
pub struct TileRead {
    /// Column and row of the copy in which the point lies.
    pub copy: [i64; 2],
    /// The texels, whose weights are 1 together.
    pub texels: Vec<TileTexelRead>,
    /// What they make.
    pub color: Premultiplied16,
}

/// A texel that is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TileTexelRead {
    /// Column and row.
    pub at: [u32; 2],
    /// Its part of the colour.
    pub weight: f64,
    /// Its own colour.
    pub color: Premultiplied16,
}

impl Tile {
    /// From straight pixels `0xAARRGGBB`, row by row; `None` where they are not so many, or none.
    pub fn new(size: [u32; 2], pixels: &[u32]) -> Option<Self> {
        let [width, height] = size.map(|side| side as usize);
        if pixels.is_empty() || width.checked_mul(height) != Some(pixels.len()) {
            return None;
        }
        let texel = |pixel: &u32| {
            let [a, r, g, b] = pixel.to_be_bytes();
            let of = |channel: u8| u32::from(channel) * u32::from(a) * u32::from(Premultiplied16::PER_BYTE);
            let channel = |value: u8| u16::try_from((of(value) + 127) / 255).unwrap_or(Premultiplied16::ONE);
            Premultiplied16([channel(r), channel(g), channel(b), channel(255)])
        };
        Some(Self {
            size,
            texels: pixels.iter().map(texel).collect(),
        })
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The colour at a point, `(0, 0)` one corner of a copy and `(1, 1)` the opposite one.
    #[inline]
    pub fn color(&self, at: DVec2, sampling: PixelSampling) -> Premultiplied16 {
        let texels = self.in_texels(at);
        match sampling {
            PixelSampling::Nearest => self.texel(self.wrapped(texels)),
            PixelSampling::Bilinear => self.mixed(&self.cell(texels)),
            PixelSampling::CatmullRom => self.kept(texels, Cubic::CATMULL_ROM),
            PixelSampling::BSpline => self.kept(texels, Cubic::B_SPLINE),
            PixelSampling::Mitchell => self.kept(texels, Cubic::MITCHELL),
        }
    }

    /// As [`Tile::color`], with what was read.
    pub fn read(&self, at: DVec2, sampling: PixelSampling) -> TileRead {
        let texels = self.in_texels(at);
        let read = match sampling {
            PixelSampling::Nearest => vec![(self.wrapped(texels), 1.0)],
            PixelSampling::Bilinear => self.cell(texels).to_vec(),
            PixelSampling::CatmullRom => self.block(texels, Cubic::CATMULL_ROM).to_vec(),
            PixelSampling::BSpline => self.block(texels, Cubic::B_SPLINE).to_vec(),
            PixelSampling::Mitchell => self.block(texels, Cubic::MITCHELL).to_vec(),
        };
        TileRead {
            copy: at.floor().to_array().map(whole),
            color: self.color(at, sampling),
            texels: read
                .into_iter()
                .filter(|(_, weight)| *weight != 0.0 || sampling.cubic().is_none())
                .map(|(at, weight)| TileTexelRead {
                    at,
                    weight,
                    color: self.texel(at),
                })
                .collect(),
        }
    }

    /// A point in texels of its copy.
    #[inline]
    fn in_texels(&self, at: DVec2) -> DVec2 {
        (at - at.floor()) * DVec2::from(self.size.map(f64::from))
    }

    /// The texel in which a point lies, beyond the copy's border one of the next copy.
    #[inline]
    fn wrapped(&self, texels: DVec2) -> [u32; 2] {
        let of = |value: f64, side: u32| {
            let within = whole(value.floor()).rem_euclid(i64::from(side));
            u32::try_from(within).unwrap_or(0)
        };
        [of(texels.x, self.size[0]), of(texels.y, self.size[1])]
    }

    /// The four texels around a point, and their weights.
    #[inline]
    fn cell(&self, texels: DVec2) -> [([u32; 2], f64); 4] {
        let corner = texels - 0.5;
        let (low, part) = (corner.floor(), corner - corner.floor());
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(right, down)| {
            let along = |part: f64, far: f64| if far > 0.0 { part } else { 1.0 - part };
            let weight = along(part.x, right) * along(part.y, down);
            (self.wrapped(low + DVec2::new(right, down)), weight)
        })
    }

    /// The 4 x 4 texels around a point, and their weights.
    fn block(&self, texels: DVec2, cubic: Cubic) -> [([u32; 2], f64); 16] {
        let corner = texels - 0.5;
        let (low, part) = (corner.floor(), corner - corner.floor());
        let (columns, rows) = (cubic.weights(part.x), cubic.weights(part.y));
        let mut block = [([0; 2], 0.0); 16];
        let places = (0..4_u8).flat_map(|y| (0..4_u8).map(move |x| [x, y]));
        for (read, [x, y]) in block.iter_mut().zip(places) {
            let at = low + DVec2::new(f64::from(x), f64::from(y)) - 1.0;
            *read = (self.wrapped(at), columns[usize::from(x)] * rows[usize::from(y)]);
        }
        block
    }

    /// The colour of a block; what weights below zero bring beyond a colour is clamped.
    fn kept(&self, texels: DVec2, cubic: Cubic) -> Premultiplied16 {
        let Premultiplied16([r, g, b, alpha]) = self.mixed(&self.block(texels, cubic));
        let alpha = alpha.min(Premultiplied16::ONE);
        Premultiplied16([r.min(alpha), g.min(alpha), b.min(alpha), alpha])
    }

    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a mean of 16-bit channels fits 16 bits; what is beyond them is cut off"
    )]
    fn mixed(&self, cell: &[([u32; 2], f64)]) -> Premultiplied16 {
        let mut sum = [0.5; 4];
        for (at, weight) in cell {
            for (sum, channel) in sum.iter_mut().zip(self.texel(*at).0) {
                *sum += f64::from(channel) * weight;
            }
        }
        Premultiplied16(sum.map(|channel| channel as u16))
    }

    #[inline]
    fn texel(&self, [x, y]: [u32; 2]) -> Premultiplied16 {
        self.texels[y as usize * self.size[0] as usize + x as usize]
    }
}

/// A whole number; what is none, or far too large, is the nearest one.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "casts of floats saturate, as is wanted")]
fn whole(value: f64) -> i64 {
    value as i64
}

/// A pattern's tiles for the views that showed it last, so that each is drawn once.
#[derive(Debug, Default)]
pub struct TileCache(Mutex<Vec<(String, Arc<Tile>)>>);

impl TileCache {
    /// The tile that is kept under `key`, or else what `draw` makes, which is kept then.
    pub fn get(&self, key: &str, draw: impl FnOnce() -> Option<Tile>) -> Option<Arc<Tile>> {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, tile)) = kept().iter().find(|(known, _)| known == key) {
            return Some(Arc::clone(tile));
        }
        // Without the lock: what is drawn may take a while, and use threads that want it too.
        let tile = Arc::new(draw()?);
        let mut kept = kept();
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((key.to_owned(), Arc::clone(&tile)));
        Some(tile)
    }
}

impl TileCache {
    /// Forgets the tiles.
    pub fn clear(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clear();
    }
}

impl Clone for TileCache {
    /// An empty one.
    fn clone(&self) -> Self {
        Self::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tile() -> Tile {
        Tile::new([2, 1], &[0xFFFF_0000, 0xFF00_00FF]).expect("two texels")
    }

    #[test]
    fn copies_go_on_for_ever() {
        let tile = tile();
        let [red, blue] = [[255, 0, 0, 255], [0, 0, 255, 255]].map(Premultiplied16::from_bytes);
        for (x, color) in [(0.1, red), (0.6, blue), (7.1, red), (-0.1, blue), (-3.9, red)] {
            assert_eq!(tile.color(DVec2::new(x, 5.5), PixelSampling::Nearest), color, "at {x}");
        }
        let read = tile.read(DVec2::new(-0.1, 5.5), PixelSampling::Nearest);
        let texel = TileTexelRead {
            at: [1, 0],
            weight: 1.0,
            color: blue,
        };
        assert_eq!((read.copy, read.texels), ([-1, 5], vec![texel]));
    }

    #[test]
    fn bilinear_reads_go_across_the_border_of_copies() {
        let tile = tile();
        let read = tile.read(DVec2::new(1.0, 0.5), PixelSampling::Bilinear);
        let weights: f64 = read.texels.iter().map(|texel| texel.weight).sum();
        assert!((weights - 1.0).abs() < 1e-12);
        assert_eq!(read.color, Premultiplied16([32_640, 0, 32_640, 65_280]), "half of each");
    }

    #[test]
    fn texels_are_premultiplied_and_sizes_checked() {
        let half = Tile::new([1, 1], &[0x80FF_0000]).expect("a texel");
        assert_eq!(
            half.color(DVec2::ZERO, PixelSampling::Nearest).0,
            [32_768, 0, 0, 32_768]
        );
        assert_eq!((Tile::new([2, 2], &[0; 3]), Tile::new([0, 0], &[])), (None, None));
    }

    #[test]
    fn few_tiles_have_their_texels_and_many_share_the_room() {
        let part = |count: usize, side: f64| {
            TileBudget::part(TileBudget::wanted(std::iter::repeat_n(DVec2::splat(side), count)))
        };
        for (count, side) in [(0, 0.0), (4, 4096.0), (4, 1e9), (67, 1000.0), (10_000, 80.0)] {
            assert!((part(count, side) - 1.0).abs() < f64::EPSILON, "{count} of {side}");
        }
        for (count, side) in [(16, 4096.0), (300, 1000.0), (100_000, 50.0)] {
            let coarser = part(count, side) * side;
            let together = TileBudget::wanted(std::iter::repeat_n(DVec2::splat(coarser), count));
            assert!(together <= TileBudget::TEXELS * 1.001, "{count} of {side}: {together}");
        }
    }

    #[test]
    fn a_cache_draws_each_size_once() {
        let cache = TileCache::default();
        let mut drawn = 0;
        for _ in 0..3 {
            cache.get("8x8", || {
                drawn += 1;
                Some(tile())
            });
        }
        assert_eq!(drawn, 1);
        cache.clear();
        cache.get("8x8", || {
            drawn += 1;
            Some(tile())
        });
        assert_eq!(drawn, 2, "it was forgotten");
        assert_eq!(cache.get("9x9", || None), None, "nothing to keep");
    }
}
