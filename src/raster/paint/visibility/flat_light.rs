//! Tiles of flat colours, resolved into the means of their light: added up by surface.
//!
//! Where all surfaces are opaque and vectors are wide, the pixels that several share are resolved sixteen at once from floats
//! ([`NearLight`]); what that leaves open, and all others, by whole numbers.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x4, f32x16};

use crate::color::{Light, LightResolver, NearLight, SampleMean};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::visibility::buffer::VisibilityBuffer;
use crate::raster::paint::visibility::by_samples::BySamples;
use crate::raster::paint::visibility::flat_resolve::FlatResolve;
use crate::raster::paint::visibility::packed::{lanes, splat};
use crate::raster::paint::visibility::painter::VisibilityPainter;
use crate::raster::paint::visibility::resolve::each_shared;
use crate::raster::paint::visibility::surfaces::SurfaceTable;
use crate::raster::paint::visibility::two_surfaces::TwoSurfaces;
use crate::raster::surface_id::{MAX_SURFACES, ROW, SurfaceId, TWO_SURFACES};
use crate::simd;

/// Pixels that are resolved at once.
const LANES: usize = 16;
/// Numbers of a native vector with which that is worth it.
const LEAST_LANES: usize = 8;

impl VisibilityPainter<'_> {
    /// Resolves a tile of flat colours into the means of their light.
    pub(super) fn resolve_light(&mut self, block: &mut PixelBlock<'_>) {
        let SampleMean::Linear(resolver) = self.by_samples.mean else {
            return;
        };
        let BySamples {
            lights,
            near_lights,
            known,
            ..
        } = &mut self.by_samples;
        known.clear();
        lights.clear();
        near_lights.clear();
        let mut all_opaque = true;
        for surface in (0..self.surfaces.len()).map(|i| SurfaceId::try_from(i).unwrap_or(0)) {
            let color = self.surfaces.get(surface).flat;
            let light = Light::new(color);
            all_opaque &= color.is_opaque();
            lights.push(light);
            near_lights.push(light.weighted());
        }
        let (tile, surfaces) = (self.layers.base(), &self.surfaces);
        let flat = FlatLight {
            surfaces,
            lights,
            resolver,
            count: self.resolver.count(),
        };
        let near = NearFlat {
            flat: &flat,
            lights: near_lights,
            near: NearLight::of_exact(&resolver),
        };
        let Some(table) = surfaces.flat_resolve() else {
            for y in tile.rect.y.start..tile.rect.y.end {
                flat.row_of_many(tile, y, block.line(y));
            }
            return;
        };
        if all_opaque && dispatch!(simd::level(), simd => near.resolve(simd, tile, table, block)) {
            return;
        }
        for y in tile.rect.y.start..tile.rect.y.end {
            let (shown, line) = (tile.shown(y), block.line(y));
            table.row(shown.whole, line);
            each_shared(
                &shown,
                line,
                |two| known.pixel(two, || flat.two(two)),
                |x| flat.split(tile, x, y),
            );
        }
    }
}

/// The same of opaque colours, nearly: by floats.
struct NearFlat<'s> {
    flat: &'s FlatLight<'s>,
    /// Red, green and blue of each surface, and alpha.
    lights: &'s [[f32; 4]],
    near: NearLight<'s>,
}

/// Pixels that are to be resolved at once.
struct Batch {
    /// Columns of the tile, and rows.
    places: [[u16; 2]; LANES],
    sums: [[f32; 4]; LANES],
    count: usize,
}

impl NearFlat<'_> {
    /// All pixels of a tile; whether this machine does it: in narrow vectors it takes more instructions than to know the latest pixels.
    #[inline(always)]
    fn resolve<S: Simd>(
        &self,
        simd: S,
        tile: &VisibilityBuffer,
        table: &FlatResolve,
        block: &mut PixelBlock<'_>,
    ) -> bool {
        if S::u32s::LEN < LEAST_LANES {
            return false;
        }
        let mut batch = Batch {
            places: [[0; 2]; LANES],
            sums: [[0.0; 4]; LANES],
            count: 0,
        };
        let width = tile.rect.x.length();
        for (y, row) in (tile.rect.y.start..tile.rect.y.end).zip(0..) {
            let shown = tile.shown(y);
            table.row(shown.whole, block.line(y));
            let mut rest = shown.shared;
            while rest != 0 {
                let x = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                if x >= width {
                    break;
                }
                let surface = shown.whole[x % ROW];
                let sum = if surface == TWO_SURFACES {
                    self.two(simd, shown.two_surfaces.get(x))
                } else if usize::from(surface) > MAX_SURFACES {
                    self.split(simd, tile, x, y)
                } else {
                    continue;
                };
                batch.places[batch.count] = [u16::try_from(x).unwrap_or(u16::MAX), row];
                sum.store_array(&mut batch.sums[batch.count]);
                batch.count += 1;
                if batch.count == LANES {
                    self.put(simd, tile, &batch, block);
                    batch.count = 0;
                }
            }
        }
        self.put(simd, tile, &batch, block);
        true
    }

    /// The light of a pixel that shows two surfaces.
    #[inline(always)]
    fn two<S: Simd>(&self, simd: S, TwoSurfaces { mask, first, second }: TwoSurfaces) -> f32x4<S> {
        let of_second = mask.count_ones();
        let [of_first, of_second] = [self.flat.count - of_second, of_second].map(|count| count as f32);
        self.light(simd, first) * of_first + self.light(simd, second) * of_second
    }

    /// The light of the split pixel in column `x` of the tile and row `y`.
    #[inline(always)]
    fn split<S: Simd>(&self, simd: S, tile: &VisibilityBuffer, x: usize, y: i32) -> f32x4<S> {
        let mut sum = f32x4::splat(simd, 0.0);
        tile.each_packed(
            x,
            y,
            #[inline(always)]
            |word, used| {
                let shown = lanes(word);
                if word == splat(shown[0]) {
                    sum += self.light(simd, shown[0]) * used as f32;
                } else {
                    for surface in &shown[..used as usize] {
                        sum += self.light(simd, *surface);
                    }
                }
            },
        );
        sum
    }

    #[inline(always)]
    fn light<S: Simd>(&self, simd: S, surface: SurfaceId) -> f32x4<S> {
        f32x4::load_array_ref(simd, &self.lights[usize::from(surface)])
    }

    /// Puts the pixels of a batch.
    #[inline(always)]
    fn put<S: Simd>(&self, simd: S, tile: &VisibilityBuffer, batch: &Batch, block: &mut PixelBlock<'_>) {
        let [mut red, mut green, mut blue] = [[0.0; LANES]; 3];
        for (i, [r, g, b, _]) in batch.sums.iter().enumerate() {
            [red[i], green[i], blue[i]] = [*r, *g, *b];
        }
        let sums = [
            f32x16::simd_from(simd, red),
            f32x16::simd_from(simd, green),
            f32x16::simd_from(simd, blue),
        ];
        let (found, certain) = self.near.pixels(simd, sums);
        let found = found.to_array();
        for (i, (found, place)) in found.iter().zip(batch.places).enumerate().take(batch.count) {
            let pixel = if certain >> i & 1 == 1 {
                *found
            } else {
                self.flat.shared(tile, place)
            };
            block.put(place, pixel);
        }
    }
}

/// What pixels of flat colours are resolved by.
struct FlatLight<'s> {
    surfaces: &'s SurfaceTable<'s>,
    lights: &'s [Light],
    resolver: LightResolver,
    count: u32,
}

impl FlatLight<'_> {
    /// The pixel in this column and row of the tile, which several surfaces share.
    #[inline(never)]
    fn shared(&self, tile: &VisibilityBuffer, [column, row]: [u16; 2]) -> u32 {
        let (x, y) = (usize::from(column), tile.rect.y.start + i32::from(row));
        let shown = tile.shown(y);
        if shown.whole[x % ROW] == TWO_SURFACES {
            self.two(shown.two_surfaces.get(x))
        } else {
            self.split(tile, x, y)
        }
    }

    /// The pixel that shows two surfaces.
    #[inline]
    fn two(&self, TwoSurfaces { mask, first, second }: TwoSurfaces) -> u32 {
        let shown = self.surfaces.get(first);
        // What is all alike is its pixel.
        if shown.flat == self.surfaces.get(second).flat {
            return shown.pixel;
        }
        let of_second = mask.count_ones();
        let [first, second] = [first, second].map(|surface| self.lights[usize::from(surface)]);
        let mut sum = first.times(self.count - of_second);
        sum += second.times(of_second);
        self.resolver.pixel(sum)
    }

    /// The pixel in column `x` of the tile and row `y`, which is split.
    #[inline]
    fn split(&self, tile: &VisibilityBuffer, x: usize, y: i32) -> u32 {
        let (mut sum, mut first, mut differ) = (Light::default(), None, false);
        tile.each_packed(x, y, |word, used| {
            for surface in &lanes(word)[..used as usize] {
                sum += self.lights[usize::from(*surface)];
                let known = first.get_or_insert(*surface);
                differ |= known != surface && self.surfaces.get(*known).flat != self.surfaces.get(*surface).flat;
            }
        });
        match first {
            Some(surface) if !differ => self.surfaces.get(surface).pixel,
            _ => self.resolver.pixel(sum),
        }
    }

    /// A row where there are many surfaces.
    #[cold]
    fn row_of_many(&self, tile: &VisibilityBuffer, y: i32, line: &mut [u32]) {
        let row_of_two = tile.two_surfaces(y);
        for ((x, surface), pixel) in tile.row(y).iter().enumerate().zip(line) {
            *pixel = match *surface {
                TWO_SURFACES => self.two(row_of_two.get(x)),
                surface if usize::from(surface) < MAX_SURFACES => self.surfaces.get(surface).pixel,
                _ => self.split(tile, x, y),
            };
        }
    }
}
