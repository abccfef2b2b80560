//! Which pixels a texel contributes to: the way of explanations backwards, for the pixels around one.
//!
//! Every pixel is drawn again as [`super::Explanation`] does it, and what its visible fragments read of textures is
//! gathered by texel. Pixels are taken ring by ring, so that there is always an answer about those nearby, and as far
//! out as stays fast: how much work a pixel is, is counted and not timed, lest the answer depend on the machine.

use std::collections::HashMap;

use rayon::prelude::*;

use super::seen::seen_fragments;
use crate::raster::{Attributes, PieceShape, Region};
use crate::render::{Neighbourhood, Subject};
use crate::texture::TextureReads;

/// Rings around the pixel in the middle at most.
const MOST_RINGS: u32 = 64;
/// Rings that are looked at whatever they cost: the pixels next to the middle.
const LEAST_RINGS: u32 = 3;
/// Work after which no further ring is begun, in points of textures that are read.
const MOST_WORK: usize = 400_000;
/// What a pixel costs besides, and what its ops do, in the same measure.
const WORK_OF_PIXEL: usize = 20;
const OPS_PER_WORK: usize = 16;

/// A texel of a scene's textures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TexelPlace {
    /// Index into the scene's textures.
    pub texture: u32,
    /// Number of its mip level; 0 is the base.
    pub level: usize,
    /// Column and row.
    pub at: [u32; 2],
}

/// A pixel that reads a texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContributedPixel {
    /// The pixel, `[x, y]`.
    pub pixel: [u32; 2],
    /// The mean over its samples of the texel's part of what their visible fragments read; above `1.0` only where several
    /// that shine through read the same texel.
    pub weight: f64,
}

/// The texels that the pixels of a square read.
#[derive(Clone, Debug, PartialEq)]
pub struct Contributions {
    /// The pixels that were looked at.
    pub searched: Region,
    by_texel: HashMap<TexelPlace, Vec<ContributedPixel>>,
}

/// What one pixel reads, and how much work it was.
#[derive(Default)]
struct Reads {
    texels: HashMap<TexelPlace, f64>,
    work: usize,
}

impl Contributions {
    /// What the pixels around `pixel` read, in a frame of `size` pixels; `None` where the pixel lies outside.
    pub fn around(subject: &Subject<'_>, size: [u32; 2], pixel: [u32; 2]) -> Option<Self> {
        let whole = square(size, pixel, MOST_RINGS)?;
        let neighbourhood = Neighbourhood::new(*subject, size, whole);
        let mut found = Self {
            searched: Region::default(),
            by_texel: HashMap::new(),
        };
        let mut work = 0;
        for ring in 0..=MOST_RINGS {
            let square = square(size, pixel, ring)?;
            if square == found.searched || (ring > LEAST_RINGS && work >= MOST_WORK) {
                break;
            }
            let before = found.searched;
            let pixels = (square.y..square.bottom()).flat_map(|y| (square.x..square.right()).map(move |x| [x, y]));
            let fresh: Vec<[u32; 2]> = pixels.filter(|pixel| !contains(before, *pixel)).collect();
            let read: Vec<Reads> = fresh.par_iter().map(|pixel| reads(&neighbourhood, *pixel)).collect();
            for (pixel, reads) in fresh.into_iter().zip(read) {
                work += reads.work;
                for (place, weight) in reads.texels {
                    found
                        .by_texel
                        .entry(place)
                        .or_default()
                        .push(ContributedPixel { pixel, weight });
                }
            }
            found.searched = square;
        }
        for contributed in found.by_texel.values_mut() {
            contributed.sort_by_key(|contributed| [contributed.pixel[1], contributed.pixel[0]]);
        }
        Some(found)
    }

    /// The pixels that read a texel, row by row.
    pub fn of(&self, texel: TexelPlace) -> &[ContributedPixel] {
        self.by_texel.get(&texel).map_or(&[], Vec::as_slice)
    }

    /// Every texel that any of the pixels reads, in no order.
    pub fn texels(&self) -> impl Iterator<Item = TexelPlace> {
        self.by_texel.keys().copied()
    }
}

/// The pixels of a frame within some rings around one; `None` outside the frame.
fn square(size: [u32; 2], pixel: [u32; 2], rings: u32) -> Option<Region> {
    let side = |at: u32, size: u32| {
        let start = at.saturating_sub(rings);
        let end = at.saturating_add(rings).saturating_add(1).min(size);
        (at < size).then(|| (start, end - start))
    };
    let (x, width) = side(pixel[0], size[0])?;
    let (y, height) = side(pixel[1], size[1])?;
    Some(Region { x, y, width, height })
}

fn contains(region: Region, [x, y]: [u32; 2]) -> bool {
    (region.x..region.right()).contains(&x) && (region.y..region.bottom()).contains(&y)
}

/// What the visible fragments of a pixel read.
fn reads(neighbourhood: &Neighbourhood<'_>, pixel: [u32; 2]) -> Reads {
    let mut reads = Reads {
        work: WORK_OF_PIXEL + neighbourhood.ops() / OPS_PER_WORK,
        ..Reads::default()
    };
    let Some(replay) = neighbourhood.replay(pixel) else {
        return reads;
    };
    let seen = seen_fragments(&replay);
    let pieces = neighbourhood.explainer(pixel).pieces(&replay.painted);
    for ((op, seen), piece) in replay.painted.iter().zip(&seen).zip(pieces) {
        let Some(PieceShape::Triangle {
            samples,
            texture: Some(usage),
            ..
        }) = piece.map(|piece| piece.shape)
        else {
            continue;
        };
        for (fragment, _) in op.fragments.iter().zip(seen).filter(|(_, seen)| **seen) {
            if let Some(Attributes::Texture { reads: found, .. }) =
                samples.get(fragment.sample).map(|sample| &sample.attributes)
            {
                reads.add(usage.texture, found, replay.samples[fragment.sample].weight);
            }
        }
    }
    reads
}

impl Reads {
    fn add(&mut self, texture: u32, found: &TextureReads, share: f64) {
        // An area is one place, and as much work as its texels.
        self.work += found.taps.len().max(found.texels.len() / 4);
        for texel in &found.texels {
            let place = TexelPlace {
                texture,
                level: texel.level,
                at: texel.at,
            };
            *self.texels.entry(place).or_default() += texel.weight * share;
        }
    }
}
