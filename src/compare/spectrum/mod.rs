//! The spectrum of a picture: which waves it is made of, which of them the scene has, and which are aliases of finer ones.
//!
//! ```text
//!            -1.5      -0.5       0.5       1.5    cycles per pixel
//!        -1.5  +---------+---------+---------+
//!              |  both   |  down   |  both   |     a wave of the scene out here, too fine for the pixels,
//!        -0.5  +---------+---------+---------+
//!              | across  |   box   | across  |     is seen in here, a whole cycle per pixel away
//!         0.5  +---------+---------+---------+
//! ```
//!
//! Frequencies have axes as pictures do, to the right and down, so that a wave runs the way in which its point lies from the
//! middle.

mod colors;
mod finer;
mod folding;
mod fourier;
mod luma;
mod waves;

use glam::{DAffine2, DVec2};

use crate::raster::{Framebuffer, Region};
use crate::render::{CancelToken, Subject, draw_regions};
use crate::texture::MipLevel;

pub use colors::{DECIBELS, scale_color};
pub use folding::Band;
use folding::folded;
use luma::LumaPlane;
use waves::Spectrum;
pub use waves::Wave;

/// What a spectrum is of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SpectrumOf {
    /// The frame, as its pixels are.
    #[default]
    Frame,
    /// The frame without the truth.
    Difference,
    /// The mip level that a pixel reads most of.
    Texture,
    /// The scene before pixels sample it: drawn finer.
    Scene,
}

impl SpectrumOf {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 4] = [Self::Frame, Self::Difference, Self::Texture, Self::Scene];

    /// The name used in the interface, in scripts and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Frame => "frame",
            Self::Difference => "difference",
            Self::Texture => "texture",
            Self::Scene => "scene",
        }
    }
}

/// By how many whole cycles per pixel along an axis waves are finer that are looked for where pixels cannot tell them from one in
/// the box: as far as the scene's spectrum reaches.
const TURNS: std::ops::RangeInclusive<i64> = -2..=2;

/// Where the scene's spectrum has a wave that lands somewhere in the box.
#[derive(Clone, Copy)]
struct FinerPlace {
    order: [i64; 2],
    band: Band,
}

/// Spectra of what a picture shows, and the scene's beside them.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumAnalysis {
    of: SpectrumOf,
    region: Region,
    own: Spectrum,
    /// The scene's, of the same region, where that is another.
    scene: Option<Spectrum>,
    /// From pixels of the frame to places from the corner of what was transformed, in its pixels or texels.
    placed: DAffine2,
}

/// What a spectrum has at a frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumReading {
    /// The wave there.
    pub wave: Wave,
    /// Its frequency in cycles per pixel of the frame: the wave's own, but for textures.
    pub in_pixels: [f64; 2],
    /// Where pixels that read one point each see it, in cycles per pixel, where that is elsewhere.
    pub lands: Option<[f64; 2]>,
    /// The strongest finer wave of the scene that lands here, unless it may be none of the scene's, and the part of this one's
    /// power that such waves account for, `0.0..=1.0`.
    pub source: Option<(Wave, f64)>,
}

impl SpectrumReading {
    /// The part of a wave's power from which on it is told to be an alias.
    const ALIAS: f64 = 0.5;

    /// [`SpectrumReading::source`], where the wave is told to be an alias: where most of it is made of finer ones.
    pub fn alias(&self) -> Option<(Wave, f64)> {
        self.source.filter(|(_, part)| *part >= Self::ALIAS)
    }
}

impl SpectrumAnalysis {
    /// The longest side that is transformed, in pixels or texels: of more, the middle is.
    pub const LONGEST: u32 = 512;

    /// The middle of `region`, with sides that are transformed.
    pub fn middle_of(region: Region) -> Region {
        let middle = |start: u32, side: u32| {
            let kept = side.min(Self::LONGEST);
            (start + (side - kept) / 2, kept)
        };
        let ((x, width), (y, height)) = (middle(region.x, region.width), middle(region.y, region.height));
        Region { x, y, width, height }
    }

    /// That of the middle of a region of the picture of `size` pixels, which is drawn for it; `None` where that holds no pixel.
    pub fn of_frame(subject: &Subject<'_>, size: [u32; 2], region: Region) -> Option<Self> {
        let region = within(size, region)?;
        let plane = drawn(subject, size, region)?;
        Self::new(SpectrumOf::Frame, region, plane).beside_scene(subject)
    }

    /// The same of what the picture differs from the truth by.
    pub fn of_difference(subject: &Subject<'_>, size: [u32; 2], region: Region) -> Option<Self> {
        let region = within(size, region)?;
        let truth = Subject {
            settings: &subject.settings.truth(),
            ..*subject
        };
        let plane = drawn(subject, size, region)?.minus(&drawn(&truth, size, region)?);
        Self::new(SpectrumOf::Difference, region, plane).beside_scene(subject)
    }

    /// The same of the scene, before pixels sample it: up to one and a half cycles per pixel.
    pub fn of_scene(subject: &Subject<'_>, size: [u32; 2], region: Region) -> Option<Self> {
        let region = within(size, region)?;
        let own = finer::scene(subject, region)?;
        Some(Self {
            of: SpectrumOf::Scene,
            region,
            own,
            scene: None,
            placed: from_corner(region),
        })
    }

    /// The same of a mip level's texels around the one that the middle of `pixel` falls on; `to_texels` leads from pixels to
    /// the level's texels.
    pub fn of_level(level: &MipLevel, pixel: [u32; 2], to_texels: DAffine2) -> Self {
        let at = to_texels.transform_point2(DVec2::from(pixel.map(f64::from)) + 0.5);
        let around = |at: f64, side: u32| {
            let kept = side.min(Self::LONGEST);
            let start = (at - f64::from(kept) / 2.0).clamp(0.0, f64::from(side - kept));
            (whole(start), kept)
        };
        let ((x, width), (y, height)) = (around(at.x, level.width()), around(at.y, level.height()));
        let region = Region { x, y, width, height };
        let plane = LumaPlane::of_level(level, region);
        Self {
            placed: from_corner(region) * to_texels,
            ..Self::new(SpectrumOf::Texture, region, plane)
        }
    }

    fn new(of: SpectrumOf, region: Region, plane: LumaPlane) -> Self {
        Self {
            of,
            region,
            own: Spectrum::of(plane),
            scene: None,
            placed: from_corner(region),
        }
    }

    fn beside_scene(self, subject: &Subject<'_>) -> Option<Self> {
        let scene = Some(finer::scene(subject, self.region)?);
        Some(Self { scene, ..self })
    }

    /// The number that all pixels have, in levels of 255, which is a difference of [`SpectrumOf::Difference`]; `None` where they
    /// differ. Only then are there waves.
    pub fn constant(&self) -> Option<f64> {
        self.own.constant()
    }

    /// What it is of.
    pub fn of(&self) -> SpectrumOf {
        self.of
    }

    /// What was transformed: pixels of the frame, or texels of the level.
    pub fn region(&self) -> Region {
        self.region
    }

    /// The highest frequency that is known along an axis, in cycles per pixel or texel.
    pub fn reach(&self) -> f64 {
        self.own.reach()
    }

    /// The corners of the box of frequencies that pixels can show, half a cycle per pixel along each axis, in cycles per pixel
    /// or texel; `None` where a pixel sees a single point of the texture.
    pub fn nyquist(&self) -> Option<[[f64; 2]; 4]> {
        let back = self.placed.matrix2.transpose().inverse();
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        let corners = corners.map(|corner| (back * DVec2::from(corner)).to_array());
        corners.iter().flatten().all(|at| at.is_finite()).then_some(corners)
    }

    /// A wave's value in the middle of a pixel of the frame, in levels of 255.
    pub fn value_at(&self, wave: &Wave, pixel: [u32; 2]) -> f64 {
        let middle = DVec2::from(pixel.map(f64::from)) + 0.5;
        wave.value_at(self.placed.transform_point2(middle).to_array())
    }

    /// What there is at a frequency in cycles per pixel or texel; `None` beyond the highest.
    pub fn at(&self, frequency: [f64; 2]) -> Option<SpectrumReading> {
        Some(self.reading(self.own.order(frequency)?))
    }

    /// The strongest wave of those whose frequency is at most `near` away along each axis, in the same unit; `None` beyond the
    /// highest, and where there is no wave.
    pub fn strongest_near(&self, frequency: [f64; 2], near: f64) -> Option<SpectrumReading> {
        let middle = self.own.order(frequency)?;
        let [across, down] = self.own.size().map(|side| near.abs() * f64::from(side));
        let [across, down] = [across, down].map(|reach| i64::from(whole(reach.min(64.0))));
        let places = (-down..=down).flat_map(|y| (-across..=across).map(move |x| [middle[0] + x, middle[1] + y]));
        let known = places.filter(|order| self.own.is_shown(*order));
        let strongest = known.max_by(|a, b| self.height(*a).total_cmp(&self.height(*b)));
        let reading = self.reading(strongest.unwrap_or(middle));
        Some(reading).filter(|reading| !reading.wave.is_nothing())
    }

    /// The strongest waves, at most `count`, the strongest first. Shading that is slower than three periods is none.
    pub fn peaks(&self, count: usize) -> Vec<SpectrumReading> {
        let peaks = self.own.peaks(count);
        peaks.into_iter().map(|order| self.reading(order)).collect()
    }

    fn reading(&self, order: [i64; 2]) -> SpectrumReading {
        let wave = self.own.wave(order);
        let in_pixels = self.in_pixels(order);
        let lands = Band::of(in_pixels).map(|_| folded(in_pixels));
        let source = self.finer(order).and_then(|(scene, places)| {
            let orders = places.map(|place| place.order);
            let strongest = orders.max_by(|a, b| scene.power(*a).total_cmp(&scene.power(*b)))?;
            let part = self.shares(order).iter().sum();
            (!scene.may_be_ghost(strongest)).then(|| (scene.wave(strongest), part))
        });
        SpectrumReading {
            wave,
            in_pixels,
            lands,
            source,
        }
    }

    /// So many periods across in cycles per pixel of the frame.
    fn in_pixels(&self, order: [i64; 2]) -> [f64; 2] {
        let frequency = self.own.frequency(order);
        if self.of == SpectrumOf::Texture {
            (self.placed.matrix2.transpose() * DVec2::from(frequency)).to_array()
        } else {
            frequency
        }
    }

    /// Of a place inside of the box the places of the finer waves that land there, and the scene that has them.
    fn finer(&self, order: [i64; 2]) -> Option<(&Spectrum, impl Iterator<Item = FinerPlace> + Clone)> {
        let scene = match self.of {
            SpectrumOf::Scene => Some(&self.own).filter(|own| Band::of(own.frequency(order)).is_none()),
            _ => self.scene.as_ref(),
        }?;
        let size = scene.size().map(i64::from);
        let turns = TURNS.flat_map(|y| TURNS.map(move |x| [x, y]));
        let places = turns.filter_map(move |turns| {
            let order = [0, 1].map(|axis| order[axis] + turns[axis] * size[axis]);
            // None inside of the box: the place itself, and at the box's border what is the same.
            let band = Band::of(scene.frequency(order))?;
            Some(FinerPlace { order, band })
        });
        Some((scene, places))
    }

    /// What of the power at a place comes from each band, in parts of it. The bands' parts are as the powers in the scene of the
    /// waves that land there; of a frame only what it has beyond the scene's own wave there is theirs.
    fn shares(&self, order: [i64; 2]) -> [f64; 3] {
        let Some((scene, places)) = self.finer(order) else {
            let band = Band::of(self.in_pixels(order));
            return Band::ALL.map(|other| if band == Some(other) { 1.0 } else { 0.0 });
        };
        let mut powers = [0.0; 3];
        for place in places {
            for (power, other) in powers.iter_mut().zip(Band::ALL) {
                *power += if place.band == other {
                    scene.power(place.order)
                } else {
                    0.0
                };
            }
        }
        let finer: f64 = powers.iter().sum();
        let (all, own) = (self.power(order), scene.power(order));
        let beyond = match self.of {
            SpectrumOf::Frame => (all - own).max(0.0),
            _ => all,
        };
        let share = |part: f64, of: f64| part / of.max(f64::MIN_POSITIVE);
        // Where there is more than finer waves can make of it, even two that add up, it is something else, such as grain.
        let all_bands = share(beyond, all)
            .min(share(finer, finer + own))
            .min(share(4.0 * finer, all));
        powers.map(|power| share(power, finer) * all_bands)
    }

    /// By how much a place stands out from those beside it.
    fn height(&self, order: [i64; 2]) -> f64 {
        self.power(order) - self.own.power(order) + self.own.height(order)
    }

    /// The power that is shown at a place: of the scene inside of the box that which pixels of one point each would have.
    fn power(&self, order: [i64; 2]) -> f64 {
        let own = self.own.power(order);
        match (self.of, self.finer(order)) {
            (SpectrumOf::Scene, Some((scene, places))) => {
                own + places.map(|place| scene.power(place.order)).sum::<f64>()
            }
            _ => own,
        }
    }
}

/// From pixels of a frame to places from the corner of a region.
fn from_corner(region: Region) -> DAffine2 {
    DAffine2::from_translation(-DVec2::new(f64::from(region.x), f64::from(region.y)))
}

/// The middle of what of a region lies in a frame.
fn within(size: [u32; 2], region: Region) -> Option<Region> {
    let region = SpectrumAnalysis::middle_of(region.intersection(Region::of_size(size)));
    (!region.is_empty()).then_some(region)
}

/// The luma of a region of the picture, which is drawn for it.
fn drawn(subject: &Subject<'_>, size: [u32; 2], region: Region) -> Option<LumaPlane> {
    let mut frame = Framebuffer::new(size[0], size[1]);
    draw_regions(subject, &mut frame, &[region], &CancelToken::default())?;
    Some(LumaPlane::of_frame(&frame, region))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates; a place in a level"
)]
fn whole(at: f64) -> u32 {
    at as u32
}

#[cfg(test)]
mod tests;
