//! Resolve filters: what the samples of a pixel, and of its neighbours, weigh in its colour.
//!
//! What is resolved and what is explained ask the same [`ResolveFilter`]. A filter is a [`Weigh`] in a file of its own; to
//! add one, write it and add a line to the table below. Painters sum the samples of a pixel before they know the weights,
//! which is right where all weigh alike: a filter that is not [even](Weigh::is_even), or reaches neighbours, needs a painter
//! that adds up weighted samples, and tiles that are painted with a margin.

mod box_filter;
mod weigh;

use crate::color::{LightResolver, Resolver};
use crate::raster::resolve::weigh::Weigh;
use crate::rules::Rules;

/// Makes the enum of all filters.
macro_rules! filters {
    ($($(#[$doc:meta])* $kind:ident => $filter:expr,)+) => {
        /// Which samples a pixel is made of, and what each weighs.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub(crate) enum ResolveFilter {
            $($(#[$doc])* $kind,)+
        }

        impl ResolveFilter {
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
    Box => box_filter::BoxFilter,
}

impl ResolveFilter {
    /// What samples at these positions in a pixel weigh, `(0, 0)` its top left corner, `(1, 1)` the bottom right; together 1.
    pub(crate) fn weights(self, positions: &[[f64; 2]]) -> Vec<f64> {
        let weigh = self.weigh();
        let all: Vec<f64> = positions
            .iter()
            .map(|[x, y]| weigh.weight([x - 0.5, y - 0.5]))
            .collect();
        let total: f64 = all.iter().sum();
        all.into_iter().map(|weight| weight / total).collect()
    }

    /// What makes a pixel of the sum of its samples, of which there are `count`.
    pub(crate) fn resolver(self, count: u32, rules: Rules) -> Resolver {
        debug_assert!(self.weigh().is_even(), "a sum knows no weights");
        Resolver::new(count, rules)
    }

    /// What makes a pixel of the light of its samples, of which there are `count`.
    pub(crate) fn light_resolver(self, count: usize, rules: Rules) -> LightResolver {
        debug_assert!(self.weigh().is_even(), "a sum knows no weights");
        LightResolver::new(u32::try_from(count).unwrap_or(u32::MAX), rules)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Premultiplied16, ResolveSpace};

    #[test]
    fn weights_are_those_of_the_mean() {
        let positions = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75]];
        let third = 1.0 / 3.0;
        assert_eq!(ResolveFilter::Box.weights(&positions), [third; 3]);
        let samples = [0, 0, 255].map(|value| Premultiplied16::from_bytes([value, value, value, 255]));
        let pixel = ResolveSpace::Stored.resolve(&samples, Rules::Standard);
        assert_eq!(pixel, 0xFF55_5555, "a third of white");
        let sum = [65_280, 65_280, 65_280, 3 * 65_280];
        assert_eq!(
            ResolveFilter::Box.resolver(3, Rules::Standard).pixel(sum),
            pixel,
            "by its sum"
        );
    }
}
