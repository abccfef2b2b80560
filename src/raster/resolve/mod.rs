//! Resolve filters: what the samples of a pixel, and of its neighbours, weigh in its colour.
//!
//! A filter is a [`Weigh`] in a file of its own; to add one, write it and add a line to the table below. All are products of
//! an axis each, and [`axis_weights`] has them as whole numbers: painters and the explanation of a pixel read those, and none
//! asks which filter it is. The box by its own radius takes a pixel's own samples only, all alike: it is the one that
//! painters know, since they may sum samples before all are painted. Every other one needs tiles that are painted with a
//! margin ([`super::tile_layout`]), whose samples are all kept until the tile is resolved.
//!
//! Some filters weigh samples far from the middle less than nothing. So a sum may lie beyond what a pixel can show: it is
//! clamped at last, opacity to `0..=1` and colours to the opacity.

pub(in crate::raster) mod axis_weights;
mod blackman_harris;
mod box_filter;
mod cubic;
mod gaussian;
mod lanczos;
mod tent;
mod weigh;

use std::num::NonZeroU16;

use crate::raster::resolve::cubic::Cubic;
use crate::raster::resolve::lanczos::Lanczos;
use crate::raster::resolve::weigh::Weigh;

/// Makes the enum of all filters, with their names.
macro_rules! filters {
    ($($(#[$doc:meta])* $kind:ident = $name:literal => $filter:expr,)+) => {
        /// Which samples a pixel is made of, and what each weighs.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub enum ResolveFilter {
            $($(#[$doc])* $kind,)+
        }

        impl ResolveFilter {
            /// Every value, in the order of menus.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$kind),+];

            /// The name used in the command line and the interface.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)+
                }
            }

            fn weigh(self) -> &'static dyn Weigh {
                match self {
                    $(Self::$kind => &$filter,)+
                }
            }
        }
    };
}

// The table of filters: a line for each.
filters! {
    /// The mean of the pixel's own samples.
    #[default]
    Box = "box" => box_filter::BoxFilter,
    /// Less and less up to a pixel away.
    Tent = "tent" => tent::Tent,
    /// A bell of half a pixel's deviation.
    Gaussian = "gaussian" => gaussian::Gaussian,
    /// The cubic B-spline: the softest.
    BSpline = "b-spline" => Cubic::B_SPLINE,
    /// The cubic of Catmull and Rom: sharp, and rings a little.
    CatmullRom = "catmull-rom" => Cubic::CATMULL_ROM,
    /// The cubic that Mitchell and Netravali recommend.
    Mitchell = "mitchell" => Cubic::MITCHELL,
    /// A windowed sine of two lobes.
    Lanczos2 = "lanczos2" => Lanczos(2.0),
    /// A windowed sine of three lobes: the sharpest, and rings most.
    Lanczos3 = "lanczos3" => Lanczos(3.0),
    /// A bell of four cosines.
    BlackmanHarris = "blackman-harris" => blackman_harris::BlackmanHarris,
}

/// How far a filter reaches where it is stretched: hundredths of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FilterRadius(NonZeroU16);

/// A filter and its radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizedFilter {
    filter: ResolveFilter,
    /// In pixels.
    radius: f64,
}

impl ResolveFilter {
    /// How far from a pixel's middle samples weigh anything, in pixels, where nobody asks for another radius.
    pub fn radius(self) -> f64 {
        self.weigh().radius()
    }

    /// The filter by its own radius, or stretched to another one.
    pub fn sized(self, radius: Option<FilterRadius>) -> SizedFilter {
        SizedFilter {
            filter: self,
            radius: radius.map_or_else(|| self.radius(), FilterRadius::pixels),
        }
    }
}

impl FilterRadius {
    /// The least: half a pixel's side, so that a pixel holds samples that weigh something.
    pub const MIN: f64 = 0.5;
    /// The greatest.
    pub const MAX: f64 = 4.0;

    /// So many pixels, to the nearest hundredth; `None` unless `pixels` is 0.5 to 4, before it is rounded.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most some hundreds"
    )]
    pub fn new(pixels: f64) -> Option<Self> {
        let inside = (Self::MIN..=Self::MAX).contains(&pixels);
        let hundredths = NonZeroU16::new((pixels * 100.0).round() as u16);
        hundredths.filter(|_| inside).map(Self)
    }

    /// In pixels.
    pub fn pixels(self) -> f64 {
        f64::from(self.0.get()) / 100.0
    }
}

impl Default for SizedFilter {
    fn default() -> Self {
        ResolveFilter::default().sized(None)
    }
}

impl SizedFilter {
    /// The most pixels beside its own that a pixel may take samples from, in each direction.
    pub const MOST_MARGIN: u32 = 4;

    /// Which filter.
    pub fn filter(self) -> ResolveFilter {
        self.filter
    }

    /// How far it reaches, in pixels.
    pub fn radius(self) -> f64 {
        self.radius
    }

    /// Whether a pixel takes the mean of its own samples.
    pub(crate) fn is_plain(self) -> bool {
        self == Self::default()
    }

    /// How many pixels beside its own a pixel takes samples from, in each direction.
    pub(crate) fn margin(self) -> u32 {
        // The middle of a pixel is half a pixel from its border.
        (0..Self::MOST_MARGIN)
            .find(|margin| f64::from(*margin) + 0.5 >= self.radius)
            .unwrap_or(Self::MOST_MARGIN)
    }

    /// By how much it is stretched.
    fn stretch(self) -> f64 {
        self.radius / self.filter.radius()
    }

    /// What a sample weighs by its distance from the pixel's middle along an axis, in pixels.
    fn weight(self, distance: f64) -> f64 {
        if distance < self.radius {
            self.filter.weigh().weight(distance / self.stretch())
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn margins_hold_all_that_weighs_anything() {
        for (filter, margin) in [
            (ResolveFilter::Box, 0),
            (ResolveFilter::Tent, 1),
            (ResolveFilter::Gaussian, 1),
            (ResolveFilter::Mitchell, 2),
            (ResolveFilter::Lanczos3, 3),
        ] {
            let sized = filter.sized(None);
            assert_eq!(sized.margin(), margin, "{filter:?}");
            assert_eq!(sized.is_plain(), filter == ResolveFilter::Box, "{filter:?}");
        }
        let widest = ResolveFilter::Tent.sized(FilterRadius::new(FilterRadius::MAX));
        assert_eq!(widest.margin(), SizedFilter::MOST_MARGIN, "the widest");
        let wide_box = ResolveFilter::Box.sized(FilterRadius::new(1.0));
        assert!(!wide_box.is_plain() && wide_box.margin() == 1, "a box of two pixels");
        for wrong in [0.0, 0.49, 0.496, 4.004, 4.01, -1.0, f64::NAN] {
            assert_eq!(FilterRadius::new(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn weights_are_those_of_the_papers() {
        let weight = |filter: ResolveFilter, distance| filter.sized(None).weight(distance);
        for (filter, distance, expected) in [
            (ResolveFilter::Box, 0.499, 1.0),
            (ResolveFilter::Box, 0.5, 0.0),
            (ResolveFilter::Tent, 0.25, 0.75),
            (ResolveFilter::BSpline, 0.0, 2.0 / 3.0),
            (ResolveFilter::BSpline, 1.0, 1.0 / 6.0),
            (ResolveFilter::CatmullRom, 0.0, 1.0),
            (ResolveFilter::CatmullRom, 1.0, 0.0),
            (ResolveFilter::CatmullRom, 1.5, -1.0 / 16.0),
            (ResolveFilter::Mitchell, 0.0, 8.0 / 9.0),
            (ResolveFilter::Mitchell, 1.0, 1.0 / 18.0),
            (ResolveFilter::Lanczos2, 1.0, 0.0),
            (ResolveFilter::Lanczos3, 1.5, -0.135_094_911_2),
            (ResolveFilter::BlackmanHarris, 0.0, 1.0),
            (ResolveFilter::BlackmanHarris, 1.499_999_9, 6e-5),
        ] {
            let found = weight(filter, distance);
            assert!((found - expected).abs() < 1e-9, "{filter:?} at {distance}: {found}");
        }
        let stretched = ResolveFilter::Tent.sized(FilterRadius::new(2.0));
        assert!((stretched.weight(1.0) - 0.5).abs() < 1e-12, "half way down");
    }
}
