//! Images to colours: decoding, pyramid, level of detail, sampling.

mod anisotropic_filter;
mod anisotropy;
mod area;
mod area_filter;
mod area_trace;
mod bilinear;
mod bilinear_values;
mod block_filter;
mod block_weights;
mod box_means;
mod box_sums;
mod course_sampler;
mod covered;
mod cubic;
mod decode;
mod detail_settings;
mod ellipse;
mod ewa_filter;
mod few_texels;
mod filter;
mod filter_plan;
mod filtered_samples;
mod fixed_point;
mod folded_blocks;
mod footprint;
mod level_choice;
mod level_of_detail;
mod light_bytes;
mod nearest_counts;
mod nearest_light;
mod nearest_means;
mod nearest_samples;
mod nearest_scattered;
mod nearest_sums;
mod nearest_values;
#[cfg(test)]
mod oracle;
mod pixel_filter;
mod pyramid;
mod pyramid_filter;
mod pyramid_values;
mod ripmap;
mod ripmap_filter;
mod sample_blocks;
mod sample_filter;
mod sample_offsets;
mod sample_places;
mod settings;
mod shared_blocks;
mod simd_channels;
mod summed_area;
mod tent_weights;
mod texel_blocks;
mod texel_coordinates;
mod tile;
mod trace;
mod uv_map;
mod wrap;

pub use anisotropy::{Anisotropy, Taps};
pub use area::{Area, TexelBox};
pub use area_filter::AreaFilter;
pub use course_sampler::Sampler;
pub use cubic::Cubic;
pub use decode::{DecodeError, Memory, Run, decode_rows};
pub use detail_settings::{Derivatives, FixedLevel, FootprintExtent, LevelOfDetail, LodBias};
pub use ellipse::Ellipse;
pub use filter::{Filter, SampleGrid};
pub use filter_plan::PixelList;
pub use footprint::Footprint;
pub use level_choice::LevelChoice;
pub use level_of_detail::Reading;
pub use nearest_values::{ByteValues, ValueList};
pub use pixel_filter::PixelWork;
pub use pyramid::{MAX_SIDE, MipLevel, MipPyramid};
pub use pyramid_filter::PyramidFilter;
pub use ripmap::Ripmap;
pub use settings::SamplingSettings;
pub use summed_area::{BoxRead, SummedAreaTable};
pub use tile::{Tile, TileBudget, TileCache, TileRead};
pub use trace::{TapRead, TexelRead, TextureReads};
pub use uv_map::UvMap;
pub use wrap::Wrap;

use std::sync::{Arc, OnceLock};

use crate::color::ResolveSpace;

/// How a colour is found inside one mip level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PixelSampling {
    /// The texel that contains the point.
    #[default]
    Nearest,
    /// The four texels whose centres surround the point, weighted by distance.
    Bilinear,
    /// The 4 x 4 texels around the point by the cubic of Catmull and Rom, which is Keys's: through the texels, sharp, and rings.
    CatmullRom,
    /// The same by the cubic B-spline: never below zero, and soft.
    BSpline,
    /// The same by the cubic that Mitchell and Netravali recommend: a little of both.
    Mitchell,
}

/// Which mip level, or levels, are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LevelSampling {
    /// Level 0, however small the picture; unless a user fixes another level.
    #[default]
    Zero,
    /// The level nearest to the level of detail.
    Nearest,
    /// The two neighbouring levels, mixed by the fraction of the level of detail.
    Linear,
    /// All texels under the ellipse that a pixel is on the texture, by a Gaussian, of the level whose texels its minor axis is
    /// one to two of: elliptical weighted average (Greene and Heckbert, "Creating raster Omnimax images from multiple
    /// perspective views using the elliptical weighted average filter", 1986).
    Ewa,
    /// The mean of the box around the footprint, from a table of sums (Crow, "Summed-area tables for texture mapping", 1984).
    SummedArea,
    /// Levels that are halved in width and height each for itself, one of each axis, mixed along both.
    Ripmap,
}

/// An image that primitives are painted with.
#[derive(Clone, Debug)]
pub struct Texture {
    /// Its name in the document, or the file it came from: for messages and tool tips.
    pub name: String,
    /// The image at every resolution, levels averaged over their texels in stored values.
    pub pyramid: MipPyramid,
    /// The same by other filters and in linear light, once somebody asks for them: by filter, then by space.
    others: [[OnceLock<MipPyramid>; ResolveSpace::ALL.len()]; PyramidFilter::ALL.len()],
    /// Levels of all widths and heights, once somebody asks for them: likewise.
    ripmaps: [[OnceLock<Arc<Ripmap>>; ResolveSpace::ALL.len()]; PyramidFilter::ALL.len()],
    /// Sums of texels, once somebody asks for them: by space.
    summed: [OnceLock<Arc<SummedAreaTable>>; ResolveSpace::ALL.len()],
    /// How colours are to be found in its levels, whatever the settings say (`image-rendering` of SVG).
    pub asks: Option<PixelSampling>,
}

impl PixelSampling {
    /// Every value, in the order of menus and of the key that steps through them.
    pub const ALL: [Self; 5] = [
        Self::Nearest,
        Self::Bilinear,
        Self::CatmullRom,
        Self::BSpline,
        Self::Mitchell,
    ];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Bilinear => "bilinear",
            Self::CatmullRom => "catmull-rom",
            Self::BSpline => "b-spline",
            Self::Mitchell => "mitchell",
        }
    }

    /// The kernel that weighs texels, where that is a cubic one.
    pub const fn cubic(self) -> Option<Cubic> {
        match self {
            Self::Nearest | Self::Bilinear => None,
            Self::CatmullRom => Some(Cubic::CATMULL_ROM),
            Self::BSpline => Some(Cubic::B_SPLINE),
            Self::Mitchell => Some(Cubic::MITCHELL),
        }
    }
}

impl LevelSampling {
    /// Every value, in the order of menus and of the key that steps through them.
    pub const ALL: [Self; 6] = [
        Self::Zero,
        Self::Nearest,
        Self::Linear,
        Self::Ewa,
        Self::SummedArea,
        Self::Ripmap,
    ];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Zero => "zero",
            Self::Nearest => "nearest",
            Self::Linear => "linear",
            Self::Ewa => "ewa",
            Self::SummedArea => "summed-area",
            Self::Ripmap => "ripmap",
        }
    }

    /// Whether a sample weighs an area of the texture, instead of texels around a point or several taps.
    #[inline]
    pub const fn weighs_area(self) -> bool {
        matches!(self, Self::Ewa | Self::SummedArea | Self::Ripmap)
    }
}

impl Texture {
    /// A texture that is read as the settings say.
    pub fn new(name: &str, pyramid: MipPyramid) -> Self {
        Self {
            name: name.to_owned(),
            pyramid,
            others: Default::default(),
            ripmaps: Default::default(),
            summed: Default::default(),
            asks: None,
        }
    }

    /// The same, in whose levels colours are found as it asks itself.
    #[must_use]
    pub fn asking(self, asks: Option<PixelSampling>) -> Self {
        Self { asks, ..self }
    }

    /// The image at every resolution, levels averaged in these values by this filter.
    #[inline]
    pub fn pyramid_in(&self, space: ResolveSpace, filter: PyramidFilter) -> &MipPyramid {
        if (space, filter) == (ResolveSpace::Stored, PyramidFilter::Box) {
            return &self.pyramid;
        }
        self.others[filter as usize][space as usize].get_or_init(|| {
            let base = self.pyramid.levels()[0].clone();
            match space {
                ResolveSpace::Stored => MipPyramid::build_by(base, filter),
                ResolveSpace::Linear => MipPyramid::build_in_light(base, filter),
            }
        })
    }

    /// Levels of all widths and heights, averaged in these values by this filter; built when first asked for.
    pub fn ripmap(&self, space: ResolveSpace, filter: PyramidFilter) -> &Ripmap {
        self.ripmaps[filter as usize][space as usize]
            .get_or_init(|| Arc::new(Ripmap::build(self.tabled(), space, filter)))
    }

    /// Sums of texels in these values; built when first asked for.
    pub fn summed_area(&self, space: ResolveSpace) -> &SummedAreaTable {
        self.summed[space as usize].get_or_init(|| Arc::new(SummedAreaTable::build(self.tabled(), space)))
    }

    /// How many levels of each height its ripmap has, built or not.
    pub fn ripmap_widths(&self) -> usize {
        ripmap::widths(self.tabled_size()[0])
    }

    /// Width and height in texels of the level that its ripmap and its sums are made of: the base, unless that is very large.
    pub fn tabled_size(&self) -> [u32; 2] {
        [self.tabled().width(), self.tabled().height()]
    }

    /// The level that tables are made of.
    fn tabled(&self) -> &MipLevel {
        &self.pyramid.levels()[area::tabled_level(&self.pyramid)]
    }

    /// The settings by which this texture is read, where they are others than these.
    #[inline]
    pub fn own_sampling(&self, settings: &SamplingSettings) -> Option<SamplingSettings> {
        self.asks.map(|pixel| SamplingSettings { pixel, ..*settings })
    }

    /// Decodes a PNG or JPEG and builds its pyramid.
    ///
    /// # Errors
    /// When the bytes are no such image, are damaged, or are larger than 16 384 texels a side.
    pub fn decode(name: &str, bytes: &[u8]) -> Result<Self, DecodeError> {
        Ok(Self::new(name, MipPyramid::build(decode::decode(bytes)?)))
    }

    /// As [`Texture::decode`], but every texel counts as opaque: the image's own alpha is dropped. Also says whether it had
    /// any.
    ///
    /// # Errors
    /// As [`Texture::decode`].
    pub fn decode_opaque(name: &str, bytes: &[u8]) -> Result<(Self, bool), DecodeError> {
        let (base, dropped) = decode::decode_opaque(bytes)?;
        Ok((Self::new(name, MipPyramid::build(base)), dropped))
    }

    /// Width and height of an image in texels, from its header alone.
    ///
    /// # Errors
    /// When the bytes are neither PNG nor JPEG, or the size is above the limits.
    pub fn size_of_encoded(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
        decode::size(bytes)
    }

    /// What an encoded image takes in memory as a texture of `size`.
    pub fn memory_of_encoded(bytes: &[u8], size: [u32; 2]) -> Memory {
        Memory::of(bytes, size)
    }

    /// The magenta checker that stands for a texture that could not be read.
    pub fn missing(name: &str) -> Self {
        const SIDE: u32 = 64;
        const CELL: u32 = 8;
        let texels = (0..SIDE * SIDE)
            .map(|i| {
                let odd = (i % SIDE / CELL + i / SIDE / CELL) % 2 == 1;
                if odd { [255, 0, 255, 255] } else { [40, 0, 40, 255] }
            })
            .collect();
        Self::new(name, MipPyramid::build(MipLevel::new(SIDE, SIDE, texels)))
    }
}
