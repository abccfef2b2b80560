//! Everything that decides how primitives become pixels.

use crate::color::{ResolveSpace, Rgba};
use crate::raster::resolve::SizedFilter;
use crate::raster::sampling::pattern::{SamplePattern, Seed};
use crate::raster::sampling::pixel_coverage::PixelCoverage;
use crate::raster::sampling::rate::SampleRate;
use crate::raster::sampling::shading_rate::ShadingRate;
use crate::texture::SamplingSettings;

/// Everything that decides how primitives become pixels.
#[derive(Clone, Copy, Debug)]
pub struct RasterSettings {
    /// Samples per pixel.
    pub rate: SampleRate,
    /// Where they lie; where the pattern does not take the rate, it has the nearest one that it takes.
    pub pattern: SamplePattern,
    /// Where they lie by chance: which chance.
    pub seed: Seed,
    /// How often primitives are shaded in a pixel.
    pub shading: ShadingRate,
    /// What tells how much of a pixel a primitive covers. Exact areas leave one value per pixel: rate, pattern and shading rate
    /// are without effect then.
    pub coverage: PixelCoverage,
    /// How textures are read, and by whose rules.
    pub sampling: SamplingSettings,
    /// What samples weigh in a pixel, its own and its neighbours'.
    pub filter: SizedFilter,
    /// In which values samples are averaged.
    pub space: ResolveSpace,
    /// What lies below the first primitive.
    pub background: Rgba,
    /// What becomes of resolved pixels, where they do not stay as they are.
    pub recolor: Option<Recolor>,
}

/// What resolved pixels become.
#[derive(Clone, Copy, Debug)]
pub enum Recolor {
    /// The red of each is a number and becomes the colour of that index.
    Palette(&'static [u32; 256]),
    /// Each is told by how many levels its colour was beyond what a pixel can show before it was clamped: below nothing, and above
    /// everything. Both are zero where samples do not weigh less than nothing.
    Clamped(fn([f64; 2], u32) -> u32),
}

impl Recolor {
    /// What a pixel becomes whose colour was not clamped.
    pub(in crate::raster) fn unclamped(self, pixel: u32) -> u32 {
        match self {
            Self::Palette(palette) => {
                let [_, red, ..] = pixel.to_be_bytes();
                palette[usize::from(red)]
            }
            Self::Clamped(color) => color([0.0; 2], pixel),
        }
    }
}

/// One sample in the middle of each pixel, on white.
impl Default for RasterSettings {
    fn default() -> Self {
        Self {
            rate: SampleRate::ONE,
            pattern: SamplePattern::default(),
            seed: Seed::default(),
            shading: ShadingRate::default(),
            coverage: PixelCoverage::default(),
            sampling: SamplingSettings::default(),
            filter: SizedFilter::default(),
            space: ResolveSpace::default(),
            background: Rgba::WHITE,
            recolor: None,
        }
    }
}

impl RasterSettings {
    /// How many samples a pixel has, a rate that the pattern takes, and where they lie: one in the middle, where areas count.
    pub(crate) fn sampled(&self) -> (SampleRate, SamplePattern) {
        if self.coverage.is_exact() {
            return (SampleRate::ONE, SamplePattern::Grid);
        }
        let rate = self.pattern.nearest(self.rate);
        (rate, self.pattern.simplest(rate))
    }
}
